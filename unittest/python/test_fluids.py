"""potentials/fluids.sph, and pair_coeff with a file of fluids: good ones and bad ones."""

import re
from pathlib import Path

import pytest

from helpers import lattice

FLUIDS = Path(__file__).resolve().parents[2] / "potentials" / "fluids.sph"
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


def deck(pair_coeff, units="si"):
    """Input of a small lattice; pair_coeff holds whole lines."""
    return (f"units {units}\natom_style sph/bulk\nread_data box.data\npair_style sph/bulk\n{pair_coeff}\n"
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
    assert set(SHIPPED) >= {"water", "methanol", "ethanol", "2-propanol", "toluene", "hexane", "mercury",
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
    "unknown name": (spoilt("water", "Water"), r"No fluid water in .*my\.fluids.*: honey Water"),
    "empty": ("# UNITS: si\n", r"No fluid water in .*my\.fluids"),
    "other units": (spoilt("UNITS: si", "UNITS: cgs"), r"my\.fluids requires cgs units but si units are in use"),
    "missing file": (None, r"Cannot open file of fluids my\.fluids, .*LAMMPS_POTENTIALS: No such file"),
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("name", BAD)
def test_bad_file(box, name, ranks):
    content, message = BAD[name]
    if content is not None:
        box.path("my.fluids").write_text(content)
    result = box(deck("pair_coeff * * my.fluids water 2.5\n"), ranks=ranks, check=False, timeout=60)
    assert result.code != 0, f"accepted:\n{result.output[-2000:]}"
    assert re.search(message, result.error), result.error or result.output[-2000:]
    assert not re.search(r"segmentation|signal \d+ ", result.output, re.IGNORECASE), result.output[-2000:]


@pytest.mark.parametrize("arguments, message", [
    ("my.fluids water", "pair_coeff"),
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
