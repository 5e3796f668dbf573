# SPDX-License-Identifier: GPL-2.0-only
"""Fluids of potentials/*.sph, air of any humidity, and small sound in them, in SI units.

    python3 python/sph_dissipation/fluids.py air/50 air/30/283.15/90e3    # lines of gases.sph: humidity in percent, K, Pa
"""
import cmath
import math
import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

POTENTIALS = Path(__file__).with_name("potentials")
GAS_CONSTANT = 8.31446261815324
COLUMNS = ["name", "temperature", "rho", "c", "mu", "kappa"]    # of a file that does not name them
STEADY = 0.1    # omega tau up to which the kappa of a process, kappa_r/(1 + (omega tau)^2), is constant within one percent


@dataclass
class Fluid:
    """Numbers of pair_coeff, kappa in three dimensions, without that of the processes."""

    rho: float
    c: float                        # of frequency 0
    mu: float
    kappa: float
    relax: list = field(default_factory=list)    # (kappa_r, tau) of each process
    valid: tuple = (0.0, math.inf)  # lowest and highest frequency for which all this holds
    measured: bool = False          # it is not known to fail above, but was not measured
    conduction: float = 0.0         # k (1/cv - 1/cp), Pa s, which adds to the longitudinal viscosity of a sound wave

    def constant(self):
        """the same with all of the bulk viscosity at once, for low frequencies"""
        below = min([self.valid[1]] + [STEADY / (2 * math.pi * tau) for _, tau in self.relax])
        return Fluid(self.rho, self.c, self.mu, self.kappa + sum(kappa for kappa, _ in self.relax), [], (self.valid[0], below),
                     self.measured, self.conduction)

    def stiffness(self, s, extra=0.0):
        """rho c^2(s)/rho of a plane wave exp(s t); extra: added to the longitudinal viscosity 4 mu/3 + kappa.
        L. D. Landau, E. M. Lifshitz, Fluid Mechanics, section 81"""
        moduli = sum(kappa / self.rho * s / (1 + s * tau) for kappa, tau in self.relax)
        return self.c**2 + moduli + s * (4 / 3 * self.mu + self.kappa + extra) / self.rho

    def wave_number(self, frequency, extra=0.0):
        """complex k of a wave exp(i k x - i omega t) that a source drives: k.imag is the absorption, 1/m"""
        omega = 2 * math.pi * frequency
        return omega / cmath.sqrt(self.stiffness(-1j * omega, extra))

    def standing_wave(self, wavelength):
        """s of a wave exp(s t) of this length: s.imag is its frequency times 2 pi, s.real < 0 its decay.  By iteration of
        s^2 = -k^2 c^2(s), which converges for waves that outlive a period; None for others."""
        k = 2 * math.pi / wavelength
        s = 1j * k * self.c
        for _ in range(500):
            new = (s + 1j * k * cmath.sqrt(self.stiffness(s))) / 2
            if abs(new - s) < 1e-14 * abs(s):
                return new
            s = new
        return None


def gas(columns):
    """Fluid of the columns {name: value} of a gas: ideal gas law.  The kappa of rotation holds up to a frequency, too:
    its relaxation time is that of a process between 5/3 p, all but translation frozen, and the stiffness with rotation."""
    p, kappa = columns["pressure"], columns["kappa"]
    rho = p * columns["M"] / (GAS_CONSTANT * columns["temperature"])
    relax = [(columns[name], columns["tau" + name[7:]]) for name in columns if name.startswith("kappa_r") and columns[name]]
    modulus = 5 / 3 * p - columns["gamma"] * p - sum(kappa_r / tau for kappa_r, tau in relax)
    below = STEADY / (2 * math.pi * kappa / modulus) if kappa and modulus > 0 else math.inf
    conduction, cp = 0.0, columns.get("cp")
    if cp and cp > GAS_CONSTANT and columns.get("k"):    # pair_coeff does without these columns
        conduction = columns["k"] * columns["M"] * (1 / (cp - GAS_CONSTANT) - 1 / cp)
    return Fluid(rho, math.sqrt(columns["gamma"] * p / rho), columns["mu"], kappa, relax, (0.0, below), False, conduction)


def humid_air(humidity, temperature=293.15, pressure=101325.0):
    """Columns of gases.sph of air with a relative humidity in percent, K, Pa. ValueError where the formulas do not hold.

    ISO 9613-1:1993 (H. E. Bass et al., J. Acoust. Soc. Am. 97, 680 (1995)): the vapor pressure, the relaxation
    frequencies 1/(2 pi tau), and what each process adds to the absorption, alpha = A f^2/(fr + f^2/fr).  For a weak process
    alpha = pi g f^2/(c^3 (fr + f^2/fr)), so g = A c^3/pi, and kappa_r = rho g tau.  ISO 9613-1 has 343.2 m/s at 20 C, which is
    the speed c of dry air with gamma = 1.4, above both relaxations; gamma is that of frequency 0.
    mu, k: Sutherland's formula, F. M. White, Viscous Fluid Flow (2006), of dry air; a vapor pressure of two percent changes them
    by less than one.  kappa: 0.6 mu, M. Greenspan, J. Acoust. Soc. Am. 31, 155 (1959).
    """
    if not 0 <= humidity <= 100:
        raise ValueError(f"a humidity of 0 to 100 percent, not {humidity:g}")
    if not 253 <= temperature <= 323.15:
        raise ValueError(f"ISO 9613-1 holds from 253 to 323 K, not at {temperature:g}")
    if not 0 < pressure <= 2e5:
        raise ValueError(f"ISO 9613-1 holds up to 200e3 Pa, not at {pressure:g}")
    t, p = temperature / 293.15, pressure / 101325
    vapor = humidity / p * 10 ** (-6.8346 * (273.16 / temperature) ** 1.261 + 4.6151)    # molar percentage
    if vapor > 100:
        raise ValueError(f"there is no air of this humidity at {temperature:g} K and {pressure:g} Pa, at which water boils")
    frequencies = (p * (24 + 4.04e4 * vapor * (0.02 + vapor) / (0.391 + vapor)),       # O2, N2
                   p / math.sqrt(t) * (9 + 280 * vapor * math.exp(-4.170 * (t ** (-1 / 3) - 1))))
    strengths = (0.01275 * math.exp(-2239.1 / temperature) * t**-2.5, 0.1068 * math.exp(-3352 / temperature) * t**-2.5)
    water = vapor / 100
    mass = 0.0289644 * (1 - water) + 0.0180153 * water
    cp = 3.5 + 0.5 * water    # over R: translation and rotation
    gamma, rho = cp / (cp - 1), pressure * mass / (GAS_CONSTANT * temperature)
    c = math.sqrt(gamma * pressure / rho)
    moduli = [strength * c**3 / math.pi for strength in strengths]
    gamma -= sum(moduli) * rho / pressure
    mu = 1.716e-5 * (temperature / 273) ** 1.5 * (273 + 111) / (temperature + 111)
    columns = {"temperature": temperature, "pressure": pressure, "M": mass, "mu": mu,
               "k": 0.0241 * (temperature / 273) ** 1.5 * (273 + 194) / (temperature + 194),
               "cp": GAS_CONSTANT * gamma / (gamma - 1), "gamma": gamma, "kappa": 0.6 * mu}
    for number, (g, frequency) in enumerate(zip(moduli, frequencies), 1):
        tau = 1 / (2 * math.pi * frequency)
        columns |= {f"kappa_r{number}": rho * g * tau, f"tau{number}": tau}
    return columns


def rows(path):
    """{name: ({column: number, or None for -}, comment)} of a file of fluids; ValueError with the place of what pair_coeff refuses"""
    found, line_of, columns = {}, {}, COLUMNS
    try:
        lines = Path(path).read_text(encoding="utf-8").splitlines()
    except UnicodeDecodeError:
        raise ValueError(f"{path} is not a text file") from None
    for number, line in enumerate(lines, 1):
        words, _, comment = line.partition("#")
        words = words.split()
        try:
            if words[:1] == ["columns"]:
                columns = named_columns(words[1:])
            elif words:
                if len(words) != len(columns):
                    raise ValueError(f"a fluid has {len(columns)} columns ({' '.join(columns)}), not {len(words)}")
                value = {column: number_of(word) for column, word in zip(columns[1:], words[1:])}
                check(value, dict(zip(columns, words)))
                if words[0] in found:
                    raise ValueError(f"fluid {words[0]} stands already in line {line_of[words[0]]}")
                found[words[0]], line_of[words[0]] = (value, comment), number
        except ValueError as error:
            raise ValueError(f"{path}:{number}: {error}") from None
    return found


def number_of(word):
    """None for -"""
    try:
        number = None if word == "-" else float(word)
    except ValueError:
        number = math.nan
    if number is not None and not math.isfinite(number):
        raise ValueError(f"'{word}' is not a number")
    return number


def named_columns(columns):
    if columns[:1] != ["name"]:
        raise ValueError("the first column must be name")
    needed = COLUMNS[2:] if "rho" in columns else ["temperature", "pressure", "M", "gamma", "mu", "kappa"]
    for column in columns:
        if columns.count(column) > 1:
            raise ValueError(f"there are two columns {column}")
        process = re.fullmatch(r"(kappa_r|tau)([0-9]+)", column)
        if process:
            needed = [*needed, f"kappa_r{process[2]}", f"tau{process[2]}"]
    for column in needed:
        if column not in columns:
            raise ValueError(f"there is no column {column}")
    return columns


def check(value, text):
    """numbers of a fluid by the names of their columns, and how they are written"""
    positive = ["rho", "c"] if "rho" in value else ["pressure", "M", "temperature", "gamma"]
    for name in value:
        tau = f"tau{name[7:]}"
        if name.startswith("kappa_r") and (value[name], value[tau]) != (None, None):
            positive += [name, tau]
    for name in positive:
        if not (value[name] or 0.0) > 0.0:
            raise ValueError(f"{name} must be > 0, not {text[name]}")
    for name in ("mu", "kappa"):
        if value[name] is None or value[name] < 0.0:
            raise ValueError(f"{name} must be >= 0, not mu = {text['mu']} kappa = {text['kappa']}")


def read(path):
    """{name: Fluid} of a file of fluids"""
    fluids = {}
    for name, (value, comment) in rows(path).items():
        fluids[name] = one = Fluid(*(value[column] for column in COLUMNS[2:])) if "rho" in value else gas(value)
        valid = re.match(r" kappa (measured )?(above|below) ([0-9.e+-]+)$", comment)
        if valid:
            limit = float(valid[3])
            one.valid, one.measured = ((0.0, limit) if valid[2] == "below" else (limit, math.inf)), bool(valid[1])
    return fluids


def find(name):
    """Fluid of this name in any case: of gases.sph, of fluids.sph, or air/HUMIDITY[/TEMPERATURE[/PRESSURE]]; KeyError with all names,
    ValueError if there is no such air"""
    if not POTENTIALS.exists():    # it is a link, and only the folder of the Python package was copied
        raise FileNotFoundError(f"no files of fluids in {POTENTIALS}, a link to potentials of the repository; copy with cp -rL, or install with pip")
    known = {**read(POTENTIALS / "fluids.sph"), **read(POTENTIALS / "gases.sph")}
    in_any_case = {one.lower(): fluid for one, fluid in known.items()}
    if name.lower() in in_any_case:
        return in_any_case[name.lower()]
    if not name.lower().startswith("air/"):
        raise KeyError(" ".join(known))
    return gas(air_of(name.lower()))


def air_of(name):
    """columns of air/HUMIDITY[/TEMPERATURE[/PRESSURE]]; ValueError if it is no such name"""
    word, *numbers = name.split("/")
    try:
        numbers = [float(number) for number in numbers]
    except ValueError:
        numbers = []
    if word != "air" or not 1 <= len(numbers) <= 3:
        raise ValueError("air/HUMIDITY[/TEMPERATURE[/PRESSURE]] in percent, K, Pa")
    return humid_air(*numbers)


if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    from sph_dissipation import program

    with program("fluids"):
        for argument in sys.argv[1:]:
            try:
                print(" ".join([argument, *(f"{value:.6g}" for value in air_of(argument).values())]))
            except ValueError as error:
                raise SystemExit(f"fluids: no fluid {argument}: {error}") from None
