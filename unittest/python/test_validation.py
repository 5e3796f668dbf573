"""The table of the page about validation is what the examples have written last.

WHERE says for each row in which file of the example a number stands, by a pattern whose group 1 it is: the published or exact
number (or the two of a range, or None where it is 1, or a curve) and that of the particles.
"""

import csv
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "doc" / "src" / "Howto_sph_validation.rst").read_text(encoding="utf-8")
with open(ROOT / "examples" / "examples.csv", encoding="utf-8") as table:
    EXAMPLES = {row["example"]: row for row in csv.DictReader(table)}

N = r"(-?\d+(?:\.\d+)?(?:e[-+]?\d+)?)"
NUSSELT = rf"^Ra = {{}}, .*: Nu {N}"
DRAG = "^{},{},(?:[^,]*,){{{}}}" + N
CAVITY = "^{},100,(?:[^,]*,){{{}}}" + N

WHERE = {
    "Drop with a free surface": (None, ("results.txt", rf"^ *20 +{N}")),
    "Dam break, arrival at the far wall": (("results.txt", rf"^experiment\D*?, Buchner +{N}"), ("results.txt", rf"^n60 +60 +{N}")),
    "Dam break, pressure on the wall, 3 < t < 4": (("results.txt", rf"^experiment.* {N}, \S+$"), ("results.txt", rf"^n60 +60 +\S+ +{N}")),
    "Dam break, pressure on the wall, 4 < t < 5": (("results.txt", rf"^experiment.*, {N}$"), ("results.txt", rf"^n60 +60 +\S+ +\S+ +{N}")),
    "Absorption in air, 1 kHz": (("results.txt", rf"^ *50 % +1000\.09 +\S+ +{N}"), ("results.txt", rf"^ *50 % +1000\.09 +{N}")),
    "Absorption in air, 10 kHz": (("results.txt", rf"^ *10 % +10003\.90 +\S+ +{N}"), ("results.txt", rf"^ *10 % +10003\.90 +{N}")),
    "Cavity, Re = 100, velocity": (None, ("cavity.csv", CAVITY.format("re100", 0))),
    "Cavity, Re = 400": (None, ("cavity.csv", CAVITY.format("re400", 0))),
    "Cavity, Re = 1000, the same": (None, ("cavity.csv", CAVITY.format("re1000", 0))),
    "Cavity, Re = 1000, stream function": (("reference.py", r"psi of the vortex.*, " + N + r"\),?$"), ("cavity.csv", CAVITY.format("re1000", 10))),
    "Heated cavity, Ra = 1e3": (("devahldavis1983.csv", rf"^1e3,{N}"), ("results.txt", NUSSELT.format("1e3"))),
    "Heated cavity, Ra = 1e4": (("devahldavis1983.csv", rf"^1e4,{N}"), ("results.txt", NUSSELT.format("1e4"))),
    "Heated cavity, Ra = 1e5, Nusselt": (("devahldavis1983.csv", rf"^1e5,{N}"), ("results.txt", NUSSELT.format("1e5"))),
    "Heated cavity, Ra = 1e5, largest": (("devahldavis1983.csv", rf"^1e5,[^,]*,{N}"), ("results.txt", rf"^Ra = 1e5, .*, u {N}")),
    "Cylinder, Re = 20": (("cylinder.csv", DRAG.format(20, "drag", 4), DRAG.format(20, "drag", 5)), ("cylinder.csv", DRAG.format(20, "drag", 3))),
    "Cylinder, Re = 40": (("cylinder.csv", DRAG.format(40, "drag", 4), DRAG.format(40, "drag", 5)), ("cylinder.csv", DRAG.format(40, "drag", 3))),
    "Cylinder, Re = 100, mean drag": (("cylinder.csv", DRAG.format(100, "drag", 4), DRAG.format(100, "drag", 5)), ("cylinder.csv", DRAG.format(100, "drag", 3))),
    "Cylinder, Re = 100, Strouhal": (("cylinder.csv", DRAG.format(100, "strouhal", 4), DRAG.format(100, "strouhal", 5)),
                                     ("cylinder.csv", DRAG.format(100, "strouhal", 3))),
    "Sound pulse": (None, ("results.txt", rf"^kappa=0\.02 +512 +{N}")),
    "The same with the quintic kernel": (None, ("results.txt", rf"^kappa=0\.02, quintic +256 +{N}")),
    "Pipe with open ends, :math:`\\sigma` = 0": (None, ("errors.csv", rf"^sigma 0,0,30,[^,]*,[^,]*,{N}")),
    "Pipe with open ends, :math:`\\sigma` = 10": (None, ("errors.csv", rf"^sigma 10,10,34,[^,]*,[^,]*,{N}")),
    "Pipe with open ends, :math:`\\sigma` = -1": (None, ("errors.csv", rf"^sigma -1,-1,38,[^,]*,[^,]*,{N}")),
    "Taylor-Green vortex": (None, ("taylor_green.csv", rf"^100,0,64,10,[^,]*,{N}")),
    "Carbon dioxide, largest absorption": (("results.txt", rf"^largest absorption of CO2: .* theory {N} Np"), ("results.txt", rf"^largest absorption of CO2: {N} Np")),
    "Carbon dioxide, frequency": (("results.txt", rf"^largest absorption of CO2: .* at {N} kHz$"), ("results.txt", rf"^largest absorption of CO2: \S+ Np at {N} kHz,")),
    "Water, damping": (None, ("results.txt", rf"^water: damping/Stokes.*: {N},")),
    "Toluene, the same": (None, ("results.txt", rf"^toluene: damping/Stokes.*: {N},")),
    "Nitrogen that conducts heat": (None, ("results_kirchhoff.txt", rf"^N2 +bcc +all +\S+ +\S+ +\S+ +{N}")),
    "Acoustic streaming": (("streaming.csv", rf"^hex,160,(10),"), ("streaming.csv", rf"^hex,160,10,{N}")),
    "Moving square, Re = 100": (None, ("moving_square.csv", rf"^40,total,{N}")),
    "Moving square, largest": (("results.txt", rf"^n40: .*, finite volumes {N},"), ("results.txt", rf"^n40: largest drag coefficient {N},")),
    "Square array of discs": (None, ("sedimentation.csv", rf"^array64,(?:[^,]*,){{9}}{N}")),
    "Dense square array": (None, ("sedimentation.csv", rf"^dense32,(?:[^,]*,){{9}}{N}")),
    "Disc in the flow between plates": (("run.py", rf"^PLACE, NEAR = {N}"), ("migration.csv", rf"^migration2,[^,]*,{N}")),
    "The same disc": (("run.py", rf"^PLACE, NEAR = {N}"), ("migration.csv", rf"^migration4,[^,]*,{N}")),
    "Mean force of sound": (("radiation_force.csv", rf"^wall,1,1,0\.6,10,4\.25,[^,]*,{N}"), ("radiation_force.csv", rf"^wall,1,1,0\.6,10,4\.25,{N}")),
    "The same on a drop": (("radiation_force.csv", rf"^drop,2,1,0\.6,6,4\.25,[^,]*,{N}"), ("radiation_force.csv", rf"^drop,2,1,0\.6,6,4\.25,{N}")),
    "Shock of Mach number 2, thickness": (None, ("results.txt", rf"^0\.016 +bulk term, sdirk2 +\d+ +{N}")),
    "Shock of Mach number 2 with conduction": (None, ("results_becker.txt", rf"^2\.0 +4/3 mu, no kappa +\d+ +{N}")),
    "Onset of convection": (("run.py", rf"^CRITICAL = {N}"), ("results.txt", rf"^critical Rayleigh number {N}$")),
    "Two slabs": (("results.txt", rf"^sph/bulk +two heat capacities +{N}"), ("results.txt", rf"^sph/bulk +two heat capacities +\S+ +{N}")),
    "Couette flow": (None, ("results.txt", rf"^circular, n = 40: .*exact one {N}")),
    "Channel flow": (None, ("results.txt", rf"^newtonian, n = 50: error of u {N}")),
    "Two fluids in a rotating cup": (None, ("results.txt", rf"^eta2/eta1 = 0\.2, n = 32: Omega_in = {N} with mg")),
    "Sloshing": (None, ("results.txt", rf"^tank +25 +{N}")),
    "Waves of a paddle, *kh* = 1.5, height": (None, ("results.txt", rf"^waves +20 +1\.5 +{N}")),
    "Waves of a paddle, *kh* = 1.5, length": (None, ("results.txt", rf"^waves +20 +1\.5 +\S+ +{N}")),
    "Floating box, frequency": (None, ("results.txt", rf"^heave +25 +{N}")),
    "Floating box, draft": (("floating.csv", rf"^heavy,25,0\.9,,,[^,]*,{N}"), ("floating.csv", rf"^heavy,25,0\.9,,,{N}")),
    "Standing wave, frequency": (None, ("results.txt", rf"^ *50 +100 +\S+ +{N}")),
    "Standing wave, viscous decay": (None, ("results.txt", rf"^ *50 +100 +{N}")),
    "Overdamped sound": (None, ("results.txt", rf"^1000 +rkl2 +\S+ +\S+ +\S+ +{N}")),
    "Oscillating drop": (None, ("oscillating_drop.csv", rf"^kappa_50,50,1,{N}")),
    "Drop in another fluid, Laplace": (None, ("results.txt", rf"^r1 +\S+ +\S+ +{N}")),
    "Drop in another fluid, frequency": (None, ("results.txt", rf"^mean +\S+ +{N}")),
    "Drop on a wall": (("results.txt", r"^ +(120) +"), ("results.txt", rf"^ +120 +{N}")),
    "Rising bubble, largest speed": (("results.txt", rf"^TP2D +\S+ +\S+ +{N}"), ("results.txt", rf"^n80 +\S+ +\S+ +{N}")),
    "Rising bubble, height": (("results.txt", rf"^TP2D +\S+ +\S+ +\S+ +\S+ +{N}"), ("results.txt", rf"^n80 +\S+ +\S+ +\S+ +\S+ +{N}")),
    "Rising bubble, smallest": (("results.txt", rf"^TP2D +{N}"), ("results.txt", rf"^n80 +{N}")),
    "Gas at rest": (None, ("results.txt", r"^gamma 1\.6667, kappa/mu 1, diffusivity 0\.45:(?:.*\n){5}.*Brillouin lines.*\): " + N)),
    "Disc in a fluctuating fluid": (None, ("results.txt", rf"^ *10 .* {N}  \S+$")),
    "Couple of a sphere": (None, ("results.txt", rf"^0\.22266 +\S+ +{N}$")),
    "Velocity of a sphere after a kick": (None, ("results.txt", rf"^ +4 +{N}$")),
    "Sphere in a cubic array": (("results.txt", rf"^0\.22512 +\S+ +\S+ +{N}"), ("results.txt", rf"^0\.22512 +\S+ +{N}")),
    "Beam of bonds under a column of water": (None, ("results.txt", rf"^fine: deflection over theory: {N}")),
    "The same, frequency over theory": (None, ("results.txt", rf"^fine: frequency over theory: {N}")),
    "Rubber gate of a tank": (("results.txt", rf"^largest x of the tip, mm: .*, wanted {N} to"), ("results.txt", rf"^largest x of the tip, mm: {N},")),
    "Gas below a piston": (("results.txt", rf"^monatomic gas, piston of mass 4, height of the piston: .* exact {N};"),
                           ("results.txt", rf"^monatomic gas, piston of mass 4, height of the piston: {N} ")),
}


def rows():
    table = re.search(r"^\.\. list-table::\n(.*?)\n\n(?=\S)", PAGE, re.MULTILINE | re.DOTALL)[1]
    for row in re.split(r"^   \* - ", table, flags=re.MULTILINE)[2:]:
        cells = [" ".join(cell.split()) for cell in re.split(r"^     -", row, flags=re.MULTILINE)]
        if any(cells[1:]):    # no heading
            yield [*cells[:-1], cells[-1].strip("`")]


ROWS = {cells[0]: cells[1:] for cells in rows()}


def find(example, file, pattern):
    found = re.findall(pattern, (ROOT / "examples" / example / file).read_text(encoding="utf-8"), re.MULTILINE)
    assert len(found) == 1, (file, pattern, found)
    return float(found[0])


def as_printed(value, text):
    """the value with as many digits as the text has"""
    return f"{value:.{len(text.partition('.')[2])}f}"


def test_each_row_has_its_place():
    places = [[start for start in WHERE if name.startswith(start)] for name in ROWS]
    assert all(len(found) == 1 for found in places), places
    assert {found[0] for found in places} == set(WHERE)


@pytest.mark.parametrize("name", ROWS)
def test_row_is_that_of_the_files(name):
    published, here, error, resolution, time, example = ROWS[name]
    (known, measured), = (places for start, places in WHERE.items() if name.startswith(start))
    value = find(example, *measured)
    assert here == as_printed(value, here)
    if published == "curve":
        assert known is None and float(here) < 0.1
        assert error == as_printed(100 * value, error.split()[0]) + " %"
    else:
        texts = published.split(" to ")
        wanted = [find(example, known[0], pattern) for pattern in known[1:]] if known else [1.0]
        assert texts == [as_printed(one, text) for one, text in zip(wanted, texts, strict=True)]
        nearest = min(max(value, wanted[0]), wanted[-1])
        if value == nearest and len(wanted) == 2:
            assert error == "in the range"
        else:
            percent = as_printed(100 * (value / nearest - 1), error.split()[0])
            assert error.lstrip("+").replace("-0.0 ", "0.0 ") == percent.replace("-0.0", "0.0") + " %"
            assert error.startswith("+") == (float(percent) > 0)
    assert time == EXAMPLES[example]["processor time"]


@pytest.mark.parametrize("name", ROWS)
def test_resolution_is_one_of_the_example(name):
    _, _, _, resolution, _, example = ROWS[name]
    folder = ROOT / "examples" / example
    text = "\n".join(path.read_text(encoding="utf-8") for pattern in ("README.md", "results*.txt", "*.csv", "in.*", "run.py") for path in folder.glob(pattern))
    for number in re.findall(r"\d+(?:\.\d+)?", resolution):
        assert re.search(rf"(?<![\d.]){re.escape(number)}(?![\d.]\d)", text), number


def test_there_are_enough_published_rows():
    published = PAGE[:PAGE.index("**Exact solutions")].count("\n   * - ") - 4    # without headings
    assert published >= 12
