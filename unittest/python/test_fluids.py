"""potentials/fluids.sph and gases.sph, and pair_coeff with a file of fluids: good ones and bad ones."""

import math
import re
from pathlib import Path

import pytest

from helpers import lattice
from sph_dissipation import fluids as tool

ROOT = Path(__file__).resolve().parents[2]
FLUIDS = ROOT / "potentials" / "fluids.sph"
GASES = ROOT / "potentials" / "gases.sph"
R = 8.31446261815324
COLUMNS = ("temperature", "rho", "c", "mu", "kappa")


def lines_of(path):
    """{name: (line number, columns as text)} of a file of fluids, read without LAMMPS."""
    known = {}
    for number, line in enumerate(path.read_text().splitlines(), 1):
        words = line.split("#")[0].split()
        if words:
            assert words[0] not in known
            known[words[0]] = (number, dict(zip(COLUMNS, words[1:], strict=True)))
    return known


SHIPPED = lines_of(FLUIDS)


SHIPPED_GASES = {name: columns for name, (columns, _) in tool.rows(GASES).items()}


def processes(gas):
    """[(kappa_r, tau)]"""
    return [(gas[f"kappa_r{k}"], gas[f"tau{k}"]) for k in (1, 2) if gas[f"kappa_r{k}"]]


def deck(pair_coeff, units="si", room=""):
    """Input of a small lattice; pair_coeff holds whole lines."""
    return (f"units {units}\natom_style sph/bulk{room}\nread_data box.data\npair_style sph/bulk\n{pair_coeff}\n"
            "fix 1 all sph/bulk\ntimestep 1e-9\nrun 0\n")


@pytest.fixture
def box(lammps):
    lattice(3, 6).write(lammps.path("box.data"), ntypes=2)
    return lammps


def table(result):
    """Rows of the table of viscosities: {types: (mu, kappa)}."""
    rows = re.findall(r"^ +(\d-\d) +(\S+) +(\S+) ", result.log, re.MULTILINE)
    return {types: (float(mu), float(kappa)) for types, mu, kappa in rows}


def test_the_file_has_the_fluids_that_the_manual_names():
    assert set(SHIPPED) >= {"water", "methanol", "ethanol", "2-propanol", "toluene", "benzene", "seawater", "hexane", "mercury",
                            "argon/gas", "argon/liquid", "air", "CO2", "N2O"}
    head = FLUIDS.read_text().splitlines()[0]
    assert re.match(r"# DATE: \d{4}-\d\d-\d\d UNITS: si CONTRIBUTOR: .+ CITATION: ", head)


def test_every_fluid_has_a_comment_with_its_sources():
    """The lines above a fluid, up to an empty one, say where each of its columns comes from."""
    text = FLUIDS.read_text().splitlines()
    for name, (number, _) in SHIPPED.items():
        above = []
        while text[number - 2 - len(above)].startswith("#"):
            above.append(text[number - 2 - len(above)])
        for column in ("rho", r"\bc\b", "mu", "kappa"):
            assert re.search(column, " ".join(above)), f"{name}: no source of {column}"


@pytest.mark.parametrize("name", SHIPPED)
def test_fluid_of_the_shipped_file(box, name):
    """The table shows mu and kappa as asked for, all columns arrive with every digit."""
    _, text = SHIPPED[name]
    expected = {column: float(word) for column, word in text.items()}
    result = box(deck(f"pair_coeff * * {FLUIDS} {name} 2.5 pb 3.0\n") + "write_data out.data pair ii\n")
    mu, kappa = table(result)["1-1"]
    assert mu == pytest.approx(expected["mu"], rel=1e-3)  # the table has four digits
    assert kappa == pytest.approx(expected["kappa"], rel=1e-3, abs=1e-3 * expected["mu"])
    written = box.path("out.data").read_text().split("PairIJ Coeffs" if "PairIJ" in text else "Pair Coeffs")[1]
    first = next(line.split() for line in written.splitlines() if line.startswith("1 "))
    assert [float(word) for word in first[1:6]] == [expected[key] for key in ("rho", "c", "mu", "kappa")] + [2.5]
    assert first[6:8] == ["pb", "3"]


@pytest.mark.parametrize("ranks", [1, 2])
def test_two_fluids_touch(box, ranks):
    """Each type has its own fluid, the pair the harmonic mean of mu; every rank knows the coefficients."""
    result = box(deck(f"pair_coeff 1 1 {FLUIDS} water 2.5\npair_coeff 2 2 {FLUIDS} toluene 2.5\n"), ranks=ranks)
    water, toluene = (float(SHIPPED[name][1]["mu"]) for name in ("water", "toluene"))
    assert table(result)["1-2"][0] == pytest.approx(2.0 * water * toluene / (water + toluene), rel=1e-3)


def test_gamma_of_a_fluid(box):
    box(deck(f"pair_coeff * * {FLUIDS} water 2.5 gamma 7.15\n").replace("sph/bulk\npair", "sph/bulk eos tait\npair")
        + "write_data out.data pair ii\n")
    assert re.search(r"^1 997\.0.* gamma 7\.15", box.path("out.data").read_text(), re.MULTILINE)


GOOD = """# DATE: 2026-11-21 UNITS: si CONTRIBUTOR: a test CITATION: none
# name temperature rho c mu kappa

honey   300 1400 2000 10.0 1.0
water   300 1000 1500 1e-3 2.7e-3   # a comment behind
"""


def spoilt(old, new):
    assert GOOD.count(old) == 1
    return GOOD.replace(old, new)


BAD = {
    "no number": (spoilt("1500", "fast"), r"my\.fluids:5: 'fast' is not a number"),
    "no number in the temperature": (spoilt("water   300", "water   cold"), r"my\.fluids:5: 'cold' is not a number"),
    "number with a unit": (spoilt("2.7e-3", "2.7mPas"), r"my\.fluids:5: '2.7mPas' is not a number"),
    "missing column": (spoilt("2.7e-3", ""), r"my\.fluids:5: .*6 columns .*not 5"),
    "extra column": (spoilt("2.7e-3", "2.7e-3 1.4"), r"my\.fluids:5: .*6 columns .*not 7"),
    "negative rho": (spoilt("1000", "-1000"), r"my\.fluids:5: rho must be > 0, not -1000"),
    "zero rho": (spoilt("1000", "0"), r"my\.fluids:5: rho must be > 0, not 0"),
    "zero c": (spoilt("1500", "0.0"), r"my\.fluids:5: c must be > 0, not 0\.0"),
    "negative mu": (spoilt("1e-3 ", "-1e-3 "), r"my\.fluids:5: mu must be >= 0, not mu = -1e-3"),
    "negative kappa": (spoilt("2.7e-3", "-2.7e-3"), r"my\.fluids:5: kappa must be >= 0, not .*kappa = -2\.7e-3"),
    "nan": (spoilt("2.7e-3", "nan"), r"my\.fluids:5: .*nan"),
    "infinite": (spoilt("1500", "1e999"), r"my\.fluids:5: .*1e999"),
    "fault in the line of another fluid": (spoilt("1400", "heavy"), r"my\.fluids:4: 'heavy' is not a number"),
    "duplicate": (GOOD + "\nwater 300 999 1500 1e-3 1e-3\n", r"my\.fluids:7: fluid water .*already in line 5"),
    "duplicate of another fluid": (GOOD + "honey 300 999 1500 1e-3 1e-3\n",
                                   r"my\.fluids:6: fluid honey .*already in line 4"),
    "unknown name": (spoilt("water", "wader"), r"No fluid water in .*my\.fluids; use wader or honey"),
    "empty": ("# UNITS: si\n", r"File my\.fluids has no fluids"),
    "garbage": ("\x01\x02\u00ff" * 999, r"my\.fluids:1: a fluid has 6 columns"),
    "a folder": ("", r"Cannot read file of fluids my\.fluids: Is a directory"),
    "other units": (spoilt("UNITS: si", "UNITS: cgs"), r"my\.fluids requires cgs units but si units are in use"),
    "missing file": (None, r"Cannot open file of fluids my\.fluids, .*LAMMPS_POTENTIALS: No such file"),
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("name", BAD)
def test_bad_file(box, name, ranks):
    content, message = BAD[name]
    if name == "a folder":
        box.path("my.fluids").mkdir()
    elif content is not None:
        box.path("my.fluids").write_text(content)
    result = box(deck("pair_coeff * * my.fluids water 2.5\n"), ranks=ranks, check=False, timeout=60)
    assert result.code != 0, f"accepted:\n{result.output[-2000:]}"
    assert re.search(message, result.error), result.error or result.output[-2000:]
    assert not re.search(r"segmentation|signal \d+ ", result.output, re.IGNORECASE), result.output[-2000:]


@pytest.mark.parametrize("arguments, message", [
    ("my.fluids water", "needs the support radius rc behind its name"),
    ("my.fluids water wide", "'?wide'?"),
    ("my.fluids water 0.0", "rc must be > 0"),
    ("my.fluids water 2.5 pc 1.0", "Unknown pair_coeff keyword .*pc"),
    ("my.fluids water 2.5 pb", "pb"),
])
def test_bad_arguments_behind_a_good_file(box, arguments, message):
    box.path("my.fluids").write_text(GOOD)
    result = box(deck(f"pair_coeff * * {arguments}\n"), check=False, timeout=60)
    assert result.code != 0, f"accepted:\n{result.output[-2000:]}"
    assert re.search(message, result.error), result.error or result.output[-2000:]


def test_names_in_any_case(box):
    """... if no name is the same in both; files of the package are found in any folder."""
    both = GOOD + GOOD.splitlines()[4].replace("water", "Water").replace("1000", "999") + "\n"
    for file, name, rho in [(GOOD, "WATER", "1000"), (both, "Water", "999"), (both, "water", "1000"), (both, "WATER", "1000")]:
        box.path("my.fluids").write_text(file)
        box(deck(f"pair_coeff * * my.fluids {name} 2.5\nwrite_data out.data pair ii\n"))
        assert re.search(rf"^1 {rho} 1500 ", box.path("out.data").read_text(), re.MULTILINE), (name, rho)
    assert not box.path("fluids.sph").exists()
    box(deck("pair_coeff * * fluids.sph Water 2.5\n"))


def test_the_good_file_is_good(box):
    """What the bad ones are made from."""
    box.path("my.fluids").write_text(GOOD)
    result = box(deck("pair_coeff 1 1 my.fluids water 2.5\npair_coeff 2 2 my.fluids honey 2.5\n"))
    assert table(result)["1-1"] == (1e-3, 2.7e-3)
    assert table(result)["2-2"] == (10.0, 1.0)
    # masses of 1 are not those of water; nothing else is wrong
    assert all("is far from its rho0" in line for line in result.warnings), result.warnings


@pytest.mark.parametrize("ranks", [1, 2])
def test_lines_of_any_length(box, ranks):
    """A comment or a number that stands behind the 1023rd character of its line belongs to that line."""
    long = " " * 1500
    content = (f"# UNITS: si {'x' * 1100} oil 1 2 3 4 5\n# {'y ' * 5000}\n"
               f"water 300 1000{long}1500 1e-3 2.7e-3 # {'z ' * 800}\nhoney 300 1400 2000 10.0 1.0")
    box.path("my.fluids").write_text(content)
    result = box(deck("pair_coeff 1 1 my.fluids water 2.5\npair_coeff 2 2 my.fluids honey 2.5\n"), ranks=ranks)
    assert table(result)["1-1"] == (1e-3, 2.7e-3)
    assert table(result)["2-2"] == (10.0, 1.0)
    box.path("my.fluids").write_text(content.replace("1400", "heavy"))
    result = box(deck("pair_coeff * * my.fluids water 2.5\n"), ranks=ranks, check=False)
    assert re.search(r"my\.fluids:4: 'heavy' is not a number", result.error), result.error


def test_the_file_of_gases():
    """It has the gases that the manual names, each with a source of kappa; its numbers agree with each other."""
    assert set(SHIPPED_GASES) == {"He", "Ar", "N2", "O2", "CO2", "N2O", "CH4", "air/0", "air/10", "air/50"}
    text = GASES.read_text()
    assert re.match(r"# DATE: \d{4}-\d\d-\d\d UNITS: si CONTRIBUTOR: .+ CITATION: ", text)
    for name, gas in SHIPPED_GASES.items():
        if "air" not in name:
            assert re.search(rf"^# kappa: .*\n(# .*\n)*{name} ", text, re.MULTILINE), name
        cp = gas["cp"] / R
        assert gas["gamma"] == pytest.approx(cp / (cp - 1), rel=1e-5)
        assert 0.64 < gas["mu"] * gas["cp"] / gas["M"] / gas["k"] < 0.78    # Prandtl number
        # the modulus of all processes takes gamma to that of translation and rotation
        water = (0.0289644 - gas["M"]) / (0.0289644 - 0.0180153) if "air" in name else 0.0
        frozen = {"He": 2.5, "Ar": 2.5, "CH4": 4.0}.get(name, 3.5 + 0.5 * water)
        moduli = sum(kappa_r / tau for kappa_r, tau in processes(gas)) / gas["pressure"]
        if processes(gas):
            assert gas["gamma"] + moduli == pytest.approx(frozen / (frozen - 1), abs=1e-5)
        else:
            assert cp == pytest.approx(frozen, abs=2e-3)


@pytest.mark.parametrize("name, wave_numbers, tau_v", [
    ("N2", [2330], None), ("O2", [1556], 9.76e-2), ("CO2", [667, 667, 1333, 2349], 7.1e-6), ("N2O", [589, 589, 1285, 2224], 1.5e-6),
    ("CH4", 3 * [1306] + 2 * [1534] + [2917] + 3 * [3019], 1.26e-6)])
def test_vibrations(name, wave_numbers, tau_v):
    """cp, kappa_r, and tau are those of harmonic vibrations (Einstein) that take up energy with tau_v."""
    gas = SHIPPED_GASES[name]
    theta = [1.438776877 * wave_number / gas["temperature"] for wave_number in wave_numbers]
    vibration = sum(x * x * math.exp(x) / (math.exp(x) - 1) ** 2 for x in theta)
    cv = (3.0 if name == "CH4" else 2.5) + vibration
    assert gas["cp"] / R == pytest.approx(cv + 1, rel=2e-5)
    if tau_v:
        ((kappa_r, tau),) = processes(gas)
        assert tau == pytest.approx(tau_v * (cv - vibration) / cv, rel=5e-5)
        assert kappa_r == pytest.approx(gas["pressure"] * tau_v * vibration / cv**2, rel=5e-5)


@pytest.mark.parametrize("name", SHIPPED_GASES)
def test_gas_of_the_shipped_file(box, name):
    """Density and speed of sound are those of an ideal gas, the processes follow rc, all with every digit."""
    gas = SHIPPED_GASES[name]
    room = f" relax {len(processes(gas))}" if processes(gas) else ""
    head, atoms, rest = re.fullmatch(r"(.*Atoms [^\n]*\n\n)(.*?\n)(\nVelocities.*)", box.path("box.data").read_text(), re.S).groups()
    state = ["0"] * len(processes(gas))    # before the position
    lines = [" ".join([*line.split()[:-3], *state, *line.split()[-3:]]) + "\n" for line in atoms.splitlines()]
    box.path("box.data").write_text(head + "".join(lines) + rest)
    result = box(deck(f"pair_coeff * * {GASES} {name} 2.5 pb 3.0\n", room=room) + "write_data out.data pair ii\n")
    mu, kappa = table(result)["1-1"]
    assert (mu, kappa) == (pytest.approx(gas["mu"], rel=1e-3), pytest.approx(gas["kappa"], rel=1e-3, abs=1e-3 * gas["mu"]))
    written = box.path("out.data").read_text().split("Pair Coeffs")[1]
    first = next(line.split() for line in written.splitlines() if line.startswith("1 "))
    rho = gas["pressure"] * gas["M"] / (R * gas["temperature"])
    c = math.sqrt(gas["gamma"] * R * gas["temperature"] / gas["M"])
    assert [float(word) for word in first[1:6]] == pytest.approx([rho, c, gas["mu"], gas["kappa"], 2.5], rel=1e-15)
    assert first[first.index("pb") + 1] == "3"
    expected = [number for process in processes(gas) for number in process]
    given = first[first.index("relax") + 1:] if expected else []
    assert [float(word) for word in given[: len(expected)]] == expected
    assert ("relax" in first) == bool(expected)


def iso_9613(frequency, humidity, temperature, pressure):
    """Absorption of sound in air, dB/m, and the part of shear, conduction, and rotation: ISO 9613-1:1993."""
    p, t = pressure / 101325, temperature / 293.15
    h = humidity * 10 ** (-6.8346 * (273.16 / temperature) ** 1.261 + 4.6151) / p
    oxygen = p * (24 + 4.04e4 * h * (0.02 + h) / (0.391 + h))
    nitrogen = p * t**-0.5 * (9 + 280 * h * math.exp(-4.170 * (t ** (-1 / 3) - 1)))
    classical = 1.84e-11 / p * t**0.5
    relaxing = t**-2.5 * (
        0.01275 * math.exp(-2239.1 / temperature) / (oxygen + frequency**2 / oxygen)
        + 0.1068 * math.exp(-3352 / temperature) / (nitrogen + frequency**2 / nitrogen))
    return 8.686 * frequency**2 * (classical + relaxing), 8.686 * frequency**2 * classical


def decibels(fluid, frequency):
    """per meter, with heat conduction"""
    return 20 / math.log(10) * fluid.wave_number(frequency, fluid.conduction).imag


def test_names_in_any_case():
    for name in (*SHIPPED, *SHIPPED_GASES, "air/30/283.15/90e3"):
        assert tool.find(name) == tool.find(name.upper()) == tool.find(name.lower())
    names = [*SHIPPED, *SHIPPED_GASES]
    assert len({name.lower() for name in names}) == len(set(names))
    with pytest.raises(KeyError, match="water methanol"):
        tool.find("Honey")


def francois_garrison(frequency, temperature, salinity, acidity):
    """Absorption of sound in sea water at the surface, dB/m: J. Acoust. Soc. Am. 72, 1879 (1982)."""
    f, kelvin, c = frequency / 1e3, temperature + 273, 1412 + 3.21 * temperature + 1.19 * salinity
    boric, sulfate = 2.8 * math.sqrt(salinity / 35) * 10 ** (4 - 1245 / kelvin), 8.17 * 10 ** (8 - 1990 / kelvin) / (1 + 1.8e-3 * (salinity - 35))
    water = 3.964e-4 - 1.146e-5 * temperature + 1.45e-7 * temperature**2 - 6.5e-10 * temperature**3
    relaxing = [8.86 / c * 10 ** (0.78 * acidity - 5) * boric / (f**2 + boric**2),
                21.44 * salinity / c * (1 + 0.025 * temperature) * sulfate / (f**2 + sulfate**2)]
    return f**2 * (sum(relaxing) + water) / 1e3


def test_sound_in_sea_water():
    """With the processes that the comment of its line names, at all frequencies; without them, at those for which kappa holds."""
    sea = tool.find("seawater")
    words = re.search(r"relax ([-\d.e ]+)$", FLUIDS.read_text(), re.MULTILINE)[1].split()
    numbers = [float(word) for word in words]
    relaxing = tool.Fluid(sea.rho, sea.c, sea.mu, sea.kappa, list(zip(numbers[::2], numbers[1::2])))
    for frequency in (500, 5e3, 5e4, 5e5, 5e6, 5e7):
        expected = francois_garrison(frequency, 25, 35, 8)
        assert decibels(relaxing, frequency) == pytest.approx(expected, rel=0.01)
        assert (decibels(sea, frequency) == pytest.approx(expected, rel=0.02)) == (frequency >= sea.valid[0])


def test_humid_air():
    """The lines of the file are those of sph_dissipation.fluids, and the absorption that follows from them, with heat conduction, is
    that of the standard: 4.665 dB/km at 1 kHz, 20 C, 50 %."""
    for humidity in (0, 10, 50):
        assert SHIPPED_GASES[f"air/{humidity}"] == pytest.approx(tool.humid_air(humidity), rel=5e-6)
    for humidity, expected in {0: (1.327, 1.530, 11.60), 10: (0.771, 14.09, 175.8), 50: (0.440, 4.665, 105.3)}.items():
        fluid = tool.find(f"air/{humidity}")
        for frequency, number in zip((125, 1000, 8000), expected, strict=True):
            assert 1000 * iso_9613(frequency, humidity, 293.15, 101325)[0] == pytest.approx(number, rel=2e-3)
            assert 1000 * decibels(fluid, frequency) == pytest.approx(number, rel=3e-3)
    for humidity, temperature, pressure in [(5, 263.15, 101325), (80, 303.15, 101325), (30, 283.15, 80e3), (100, 293.15, 110e3)]:
        fluid = tool.find(f"air/{humidity}/{temperature}/{pressure}")
        for frequency in (50, 500, 2000, 10000):
            total, classical = iso_9613(frequency, humidity, temperature, pressure)
            # its 1.84e-11 sqrt(T) is a fit
            assert decibels(fluid, frequency) == pytest.approx(total, abs=2e-3 * total + 0.02 * classical)


def test_sound_in_gases():
    """CO2 absorbs most per wavelength at 29.9 kHz, 0.1315, and its speed goes from 270.1 to 281.7 m/s; water as Stokes has it."""
    gas = tool.find("CO2")
    absorption = {f: 2 * math.pi * gas.wave_number(f).imag / gas.wave_number(f).real for f in range(25000, 35000, 100)}
    peak = max(absorption, key=absorption.get)
    assert (peak, absorption[peak]) == (pytest.approx(29900, abs=200), pytest.approx(0.1315, abs=2e-4))
    assert 2 * math.pi * 10 / gas.wave_number(10).real == pytest.approx(270.1, abs=0.05)
    assert 2 * math.pi * 1e6 / gas.wave_number(1e6).real == pytest.approx(281.7, abs=0.05)
    water = tool.find("water")
    stokes = (2 * math.pi * 1e6) ** 2 * (4 / 3 * water.mu + water.kappa) / (2 * water.rho * water.c**3)
    assert water.wave_number(1e6).imag == pytest.approx(stokes, rel=1e-6)


GOOD_GASES = """# UNITS: si
columns name pressure kappa gamma M temperature shade mu tau1 kappa_r1 # any order, others are not read
haze 1e5 1e-5 1.4 0.02 300 - 2e-5 - -
fog  2e5 2e-5 1.3 0.04 290 7 3e-5 1e-3 0.5
"""


def spoilt_gas(old, new):
    assert GOOD_GASES.count(old) == 1
    return GOOD_GASES.replace(old, new)


BAD_GASES = {
    "missing column": (spoilt_gas(" mu ", " "), r"my\.fluids:2: there is no column mu"),
    "missing column of the gas law": (spoilt_gas(" M ", " mass "), r"my\.fluids:2: there is no column M"),
    "rho without c": (spoilt_gas(" shade ", " rho "), r"my\.fluids:2: there is no column c"),
    "process without time": (spoilt_gas(" tau1", ""), r"my\.fluids:2: there is no column tau1"),
    "process without viscosity": (spoilt_gas(" kappa_r1", " kappa_r2"), r"my\.fluids:2: there is no column kappa_r1"),
    "column twice": (spoilt_gas(" shade", " mu"), r"my\.fluids:2: there are two columns mu"),
    "no name": (spoilt_gas(" name", ""), r"my\.fluids:2: the first column must be name"),
    "too few": (spoilt_gas("300 - 2e-5", "300 2e-5"), r"my\.fluids:3: a fluid has 10 columns \(name pressure kappa .*\), not 9"),
    "no number": (spoilt_gas("0.04", "heavy"), r"my\.fluids:4: 'heavy' is not a number"),
    "no number in a column that is not read": (spoilt_gas(" 7 ", " dark "), r"my\.fluids:4: 'dark' is not a number"),
    "no M": (spoilt_gas("0.02", "-"), r"my\.fluids:3: M must be > 0, not -"),
    "no mu": (spoilt_gas("3e-5", "-"), r"my\.fluids:4: mu must be >= 0, not mu = - kappa = 2e-5"),
    "zero temperature": (spoilt_gas("290", "0"), r"my\.fluids:4: temperature must be > 0, not 0"),
    "negative gamma": (spoilt_gas("1.3", "-1.3"), r"my\.fluids:4: gamma must be > 0, not -1\.3"),
    "zero pressure": (spoilt_gas("2e5", "0"), r"my\.fluids:4: pressure must be > 0, not 0"),
    "negative kappa": (spoilt_gas("1e-5", "-1e-5"), r"my\.fluids:3: kappa must be >= 0, not mu = 2e-5 kappa = -1e-5"),
    "time of no process": (spoilt_gas("2e-5 - -", "2e-5 1.0 -"), r"my\.fluids:3: kappa_r1 must be > 0, not -"),
    "process of no time": (spoilt_gas("1e-3 0.5", "- 0.5"), r"my\.fluids:4: tau1 must be > 0, not -"),
    "zero tau": (spoilt_gas("1e-3 0.5", "0 0.5"), r"my\.fluids:4: tau1 must be > 0, not 0"),
    "duplicate": (GOOD_GASES.replace("fog ", "haze"), r"my\.fluids:4: fluid haze stands already in line 3"),
    "unknown name": (spoilt_gas("haze", "hale"), r"No fluid haze in file my\.fluids; use hale or fog"),
}


@pytest.mark.parametrize("name", BAD_GASES)
def test_bad_file_of_gases(box, name):
    content, message = BAD_GASES[name]
    box.path("my.fluids").write_text(content)
    result = box(deck("pair_coeff * * my.fluids haze 2.5\n"), check=False, timeout=60)
    assert result.code != 0, f"accepted:\n{result.output[-2000:]}"
    assert re.search(message, result.error), result.error or result.output[-2000:]


@pytest.mark.parametrize("ranks", [1, 2])
def test_good_file_of_gases(box, ranks):
    """Columns in any order; also those of fluids.sph; more than one line that names columns."""
    box.path("my.fluids").write_text(GOOD_GASES + "columns name c mu rho kappa\nhoney 2000 10.0 1400 1.0\n")
    result = box(deck("pair_coeff 1 1 my.fluids haze 2.5\npair_coeff 2 2 my.fluids honey 2.5\n") + "write_data out.data pair ii\n", ranks=ranks)
    assert table(result)["1-1"] == (2e-5, 1e-5) and table(result)["2-2"] == (10.0, 1.0)
    written = box.path("out.data").read_text().split("Pair Coeffs")[1].splitlines()
    haze, honey = ([float(word) for word in line.split()[1:6]] for line in written[2:4])
    rho = 1e5 * 0.02 / (R * 300)
    assert haze == pytest.approx([rho, math.sqrt(1.4e5 / rho), 2e-5, 1e-5, 2.5], rel=1e-15) and honey == [1400, 2000, 10.0, 1.0, 2.5]


def test_the_python_package_refuses_the_same(tmp_path):
    """... with the same words; it does not look at units."""
    path = tmp_path / "my.fluids"
    for content, message in [*BAD.values(), *BAD_GASES.values()]:
        if message.startswith(r"my\.fluids:"):
            path.write_text(content)
            with pytest.raises(ValueError, match=f"^{re.escape(str(tmp_path))}/{message}"):
                tool.read(path)
    path.write_text(GOOD + GOOD_GASES + "columns name c mu rho kappa\nwine 2000 10.0 1400 1.0\n")
    assert list(tool.read(path)) == ["honey", "water", "haze", "fog", "wine"]
    assert tool.read(path)["haze"].conduction == 0.0 and len(tool.read(path)["fog"].relax) == 1
    # a gas of single atoms has no rotation, up to whose frequency a constant would hold
    path.write_text("columns name pressure kappa gamma M temperature mu\nsteam 1e5 1e-5 1.6666666666666667 0.02 300 2e-5\n")
    assert tool.read(path)["steam"].valid == (0.0, math.inf)


def test_a_gas_needs_si_units(box):
    box.path("my.fluids").write_text(GOOD_GASES.replace("# UNITS: si\n", ""))
    result = box(deck("pair_coeff * * my.fluids haze 2.5\n", units="lj"), check=False, timeout=60)
    assert re.search(r"my\.fluids:2: a gas without a column rho needs units si", result.error), result.error


def test_table_of_gases_on_the_page():
    """Bulk viscosities over mu, and the frequency up to which a constant holds, rounded as printed."""
    page = (ROOT / "doc" / "src" / "Howto_sph_viscosities.rst").read_text().split("\nGases\n")[1].split("\nSpin\n")[0]
    names = {"He, Ar": "Ar", "dry air": "air/0", "air, humidity 10 %": "air/10", "air, humidity 50 %": "air/50"}
    rows = re.findall(r"^   \* - (.*)\n     - (.*)\n     - (.*)\n     - (.*)\n     - (.*)\n", page, re.MULTILINE)[1:]
    assert {names.get(row[0], row[0]) for row in rows} | {"He"} == set(SHIPPED_GASES)
    for name, total, rotation, times, frequency in rows:
        gas = tool.find(names.get(name, name))
        units = {"ms": 1e-3, r":math:`\mu\mathrm{s}`": 1e-6, "Hz": 1.0, "kHz": 1e3, "MHz": 1e6}
        number = [float(word.split()[0]) * units[word.split()[1]] for word in [*times.split(", "), frequency] if word.split()[1] in units]
        assert float(total) == pytest.approx(gas.constant().kappa / gas.mu, rel=1e-2 if "e" in total else 0.0, abs=5e-3 if "." in total else 0.5)
        assert float(rotation) == pytest.approx(gas.kappa / gas.mu, abs=5e-3)
        expected = [tau for _, tau in gas.relax] + [gas.constant().valid[1]]
        assert number == (pytest.approx(expected, rel=3e-2) if expected[-1] < math.inf else [])


def test_kappa_of_a_file_is_that_of_three_dimensions(box):
    plane = box("units si\ndimension 2\natom_style sph/bulk\nregion box block 0 1 0 1 -0.5 0.5\ncreate_box 1 box\npair_style sph/bulk\n"
                + f"pair_coeff * * {FLUIDS} water 0.5\n")
    number = re.search(r"WARNING: Pair_coeff .* water: kappa (\S+) of the file is that of three dimensions; sound in 2d is damped as there with kappa (\S+),", plane.output)
    assert number and float(number[2]) > float(number[1])
    missing = box("units si\natom_style sph/bulk\nregion box block 0 1 0 1 0 1\ncreate_box 1 box\npair_style sph/bulk\n"
                  + f"pair_coeff * * {FLUIDS} water\n", check=False)
    assert missing.code and "water: a fluid of a file needs the support radius rc behind its name" in missing.error


def test_copy_without_the_files(monkeypatch, tmp_path):
    """... says what to do."""
    monkeypatch.setattr(tool, "POTENTIALS", tmp_path / "potentials")
    with pytest.raises(FileNotFoundError, match="copy with cp -rL, or install with pip"):
        tool.find("water")
