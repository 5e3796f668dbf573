"""Every input on every page of the manual runs as printed; searches find the page that answers; pages are short.

A code block of language LAMMPS that sets up a box and runs is an input of its own; of a long run whose results the page does not
tell, ./sphd test runs the first fifth, ./sphd test --all the whole. Any other one is a fragment: its parts
(between empty lines) are commands for a fluid that is there already, and LAMMPS must take them. Blocks below the heading
Syntax, and those with types I J, have words in place of values and are left out.
"""

import os
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
RUN_ELSEWHERE = ("Howto_sph_tutorial",)    # by examples/tutorial
PAGES = sorted(page for page in (ROOT / "doc" / "src").glob("*.rst") if page.stem not in RUN_ELSEWHERE)

# what the fragments take for granted

GROUPS = ("fluid", "floor", "top", "moving", "rotor", "ground", "inlet", "outlet", "west", "nozzle", "lid", "plate", "piston",
          "wheel", "water", "walls", "body")
EQUAL = {"rc": 3.0, "dx": 1.0, "U": 0.1, "mu": 0.5, "kappa": 1.0, "rho0": 1.0, "b": 0.5, "p": 0.0}
ATOM = {"target": 1.0, "u": 0.1}
SPIN = re.compile(r"sph/micropolar|sph/torque|sph/angmom|omega|inertia|spin|centroid|mu_r")
SOLID = re.compile(r"\b64 64 64\b|0\.0 0\.0 1\.0 0\.4|-9\.81|wendland/c4 eos tait")    # three dimensions
FLUID = {False: "1.0 10.0 0.5 2.0 3.0", True: "1.0 10.0 0.5 2.0 0.2 0.1 {gamma2} 3.0"}    # {gamma2}: -gamma1 in two dimensions
PLACEHOLDERS = re.compile(r"\bI [IJ]\b")
LATE = re.compile(r"^(units|dimension|boundary|atom_style|plugin)\b", re.MULTILINE)    # no commands for a box that is there


def blocks(page):
    """(line number, heading, text, what follows up to the next block) of the LAMMPS code blocks of a page"""
    lines = page.read_text().splitlines()
    heading, number = "", 0
    while number < len(lines):
        if number and re.match(r"(=+|\"+|-+|\^+|_+)$", lines[number]):
            heading = lines[number - 1]
        start = re.match(r"( *)\.\. code-block:: LAMMPS$", lines[number])
        number += 1
        if not start:
            continue
        first = number
        indent = start[1] + "   "
        while number < len(lines) and (not lines[number].strip() or lines[number].startswith(indent)):
            number += 1
        rest = "\n".join(lines[number:]).split(".. code-block::")[0]
        yield first, heading, "\n".join(line[len(indent):] for line in lines[first:number]).strip() + "\n", rest


def is_input(text):
    return re.search(r"^\s*create_box\b", text, re.MULTILINE) and re.search(r"^\s*run\b", text, re.MULTILINE)


def collect():
    whole, parts = [], []
    for page in PAGES:
        for line, heading, text, rest in blocks(page):
            name = f"{page.stem}:{line}"
            if re.search(r"^ *read_data ", text, re.MULTILINE) and is_input(text):
                continue    # it needs a file: test_fill.py
            if is_input(text):
                finds = re.search(r"The input finds ([^:;(]*?)(?:[:;(]|\.\s)", rest)
                whole.append(pytest.param(text, re.findall(r"\d+\.\d+", finds[1]) if finds else [], id=name))
            elif heading != "Syntax" and not LATE.search(text) and not PLACEHOLDERS.search(text):
                parts += [pytest.param(part, id=f"{name}-{number}") for number, part in enumerate(re.split(r"\n\n+", text))]
    return whole, parts


INPUTS, FRAGMENTS = collect()


def fluid_for(text):
    """A small fluid; with the variables, groups and regions that a fragment may use."""
    spin, solid = bool(SPIN.search(text)), bool(SOLID.search(text))
    style = "sph/micropolar" if spin else "sph/bulk"
    types = 2 if re.search(r"pair_coeff [12] 2\b", text) else 1
    z = "-6 6" if solid else "-0.5 0.5"
    file = re.search(r"(fluids|gases)\.sph", text)
    room = " relax 2" if re.search(r"gases\.sph| relax | vibration |d_rho_relaxed|kappa_r", text) else ""
    room += " solute" if re.search(r" solute |d_solute", text) else ""
    room += " thixotropy" if re.search(r" thixotropy |d_structure", text) else ""
    lines = [f"units {'si' if file else 'lj'}", f"dimension {3 if solid else 2}", f"atom_style {style}{room}", "atom_modify map yes",
             f"region box block -6 6 -6 6 {z} units box", f"create_box {types} box",
             f"lattice {'sc' if solid else 'sq'} 1.0", "create_atoms 1 box", "set group all mass 1.0",
             "region tube cylinder z 0 0 3 INF INF units box"]
    lines += [f"variable {name} equal {value}" for name, value in EQUAL.items()]
    lines += [f"variable {name} atom {value}" for name, value in ATOM.items()]
    lines += [f"group {name} union all" for name in GROUPS]
    if spin:
        lines.append("set group all d_inertia 0.2")
    if "pair_style" not in text:
        volume = " volume mass" if "sph/refine" in text or "area" in text else ""
        surface = " density continuity" if "sph/rho" in text else ""
        lines += [f"pair_style {style}{volume}{surface}"]
    if "pair_style" not in text and not re.match(r"pair_coeff [1*]", text):
        lines += ["pair_coeff * * " + FLUID[spin].format(gamma2="0.05" if solid else "-0.1")]
    if "sph/refine" in text or "f_size" in text:
        lines += [f"fix fluid all {style}"]
    if "f_lid" in text:
        lines += ["fix lid lid sph/wall"]
    if "f_size" in text:
        lines += ["fix size all sph/refine 10 spacing 1.0"]
    return "\n".join(lines) + "\n"


# -- Search --------------------------------------------------------------------------------------------------------

# what readers type, and the page that answers

ANSWERS = {
    "BibTeX": "Howto_sph_citing", "cite": "Howto_sph_citing",
    "tensile": "Howto_sph_troubleshooting", "tensile instability": "Howto_sph_troubleshooting", "pairing": "Howto_sph_troubleshooting",
    "CFL": "Howto_sph_numbers", "Courant": "Howto_sph_numbers", "WCSPH": "Howto_sph_numbers", "weakly compressible": "Howto_sph_numbers",
    "acoustics": "Howto_sph_numbers",
    "install": "Build_SPH_DISSIPATION", "cluster": "Howto_sph_clusters", "Slurm": "Howto_sph_clusters", "Spack": "Howto_sph_clusters", "conda": "Howto_sph_clusters",
    "movie": "Howto_sph_looking", "ParaView": "Howto_sph_looking",
    "convert": "Howto_sph_comparison", "GPU": "Howto_sph_kokkos",
    "SDPD": "Howto_sph_fluctuations", "fluctuating hydrodynamics": "Howto_sph_fluctuations", "fluctuation-dissipation": "Howto_sph_fluctuations",
    "no-slip": "Howto_sph_walls", "boundary condition": "Howto_sph_walls",
    "dam break": "Howto_sph_surface", "sloshing": "Howto_sph_surface", "water level": "Howto_sph_surface", "pressure tap": "Howto_sph_surface",
    "acoustic streaming": "Howto_sph_streaming", "Stokes drift": "Howto_sph_streaming",
    "floating body": "Howto_sph_bodies", "buoyancy": "Howto_sph_bodies",
    "non-reflecting": "Howto_sph_open", "buffer zone": "Howto_sph_open",
    "adaptive particle refinement": "Howto_sph_refine", "variable resolution": "Howto_sph_refine",
}


def found_first(text):
    """index entries and headings: Sphinx's search ranks a page whose entry or heading is the word itself above all others"""
    entries = re.findall(r"^\.\. index:: (.*)$", text, re.MULTILINE)
    headings = re.findall(r"^(.+)\n(?:=+|\"+|-+|\^+)$", text, re.MULTILINE)
    return {word.strip().lower() for word in headings + re.split("[,;]", ",".join(entries))}


@pytest.mark.parametrize("word, page", ANSWERS.items())
def test_search_finds_the_page_that_answers(word, page):
    texts = {path.stem: path.read_text() for path in (ROOT / "doc" / "src").glob("*.rst")}
    assert [name for name, text in texts.items() if word.lower() in found_first(text)] == [page]
    assert re.search(rf"\b{word}", re.sub(r"^\.\. index::.*", "", texts[page], flags=re.MULTILINE), re.IGNORECASE), "the page does not say it"


# -- Pages on a code host ------------------------------------------------------------------------------------------

README = (ROOT / "README.md").read_text()


@pytest.mark.parametrize("page", sorted(set(re.findall(r"doc/src/(\w+)\.rst", README))))
def test_first_lines_are_plain_text(page):
    """README links the sources of pages, and a code host shows the roles of Sphinx as they are: there are none between the title and the first
    directive or section."""
    text = re.sub(r"^\.\. index::.*\n\n?", "", (ROOT / "doc" / "src" / f"{page}.rst").read_text(), flags=re.MULTILINE)
    first = re.split(r"^\.\. |^\"\"\"|^---|^\^\^\^", text, maxsplit=1, flags=re.MULTILINE)[0]
    assert not re.search(r":\w+:`", first), first


# -- Links ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("page", sorted((ROOT / "doc" / "src").glob("*.rst")), ids=lambda page: page.stem)
def test_links_lead_to_pages(page):
    """pages of this manual, or those of LAMMPS's manual that doc/src/_ext/lammps_pages.py lists"""
    extension = (ROOT / "doc" / "src" / "_ext" / "lammps_pages.py").read_text()
    known = set(re.search(r'MANUAL_PAGES = frozenset\("""(.*?)"""', extension, re.DOTALL)[1].split())
    known |= {path.stem for path in page.parent.glob("*.rst")}
    assert not set(re.findall(r":doc:`(?:[^`<]*<)?(\w+)>?`", page.read_text(encoding="utf-8"))) - known


# -- Length --------------------------------------------------------------------------------------------------------

LONGEST = 6000
REFERENCE = ("theory_sph_", "Howto_sph_messages")    # to look something up
NO_TEXT = re.compile(r"^( *)\.\. (?:code-block|parsed-literal|math|figure|image|index|contents|toctree|_).*\n(?:\s*\n|\1 +.*\n)*", re.MULTILINE)


@pytest.mark.parametrize("page", [page for page in sorted((ROOT / "doc" / "src").glob("*.rst")) if not page.stem.startswith(REFERENCE)],
                         ids=lambda page: page.stem)
def test_page_is_short(page):
    """words that a reader reads: without blocks of code and formulas"""
    text = re.sub(r":math:`[^`]*`|<[^<>`]*>(?=`)", "", NO_TEXT.sub("\n", page.read_text(encoding="utf-8")))
    assert len(re.findall(r"[A-Za-z][A-Za-z'-]+", text)) <= LONGEST


# -- Runs ----------------------------------------------------------------------------------------------------------


@pytest.fixture(autouse=True)
def potentials(monkeypatch):
    monkeypatch.setenv("LAMMPS_POTENTIALS", str(ROOT / "potentials"))


# of LAMMPS, about masses
WARNED = {"hybrid sph/bulk bond": "Atom style hybrid defines both"}


@pytest.mark.parametrize("text, finds", INPUTS)
def test_inputs_run(lammps, text, finds):
    """... without a warning; finds: the numbers after "The input finds", which are in the last line of output, rounded"""
    if not finds and not os.environ.get("SPHD_ALL"):
        text = re.sub(r"^(\s*run +)(\d{4,})\b", lambda run: f"{run[1]}{int(run[2]) // 5}", text, flags=re.MULTILINE)
    result = lammps(text, timeout=300)
    assert "Loop time" in result.log
    assert all(any(words in text and warning in line for words, warning in WARNED.items()) for line in result.warnings), result.warnings
    for number in finds:
        last = [abs(float(column[-1])) for column in result.thermo()[-1].values()]
        assert any(round(value, len(number.partition(".")[2])) == float(number) for value in last), (number, last)


# inputs that print what they measure beside theory: relative errors at the end, within which a page says that they are
BESIDE_THEORY = {("pair_sph_bulk_heat", 0): {("v_front", "v_theory"): 0.01}, ("pair_sph_bulk_heat", 1): {("c_wave[1]", "v_heated"): 0.012, ("c_wave[2]", "v_dyed"): 0.005},
                 ("pair_sph_bulk", 0): {("f_mean", "v_theory"): 0.015}, ("pair_sph_micropolar", 0): {("v_mean", "v_theory"): 0.01, ("c_half", "v_spun"): 0.04},
                 ("pair_sph_bulk_noise", 0): {("f_mean[1]", "v_theory"): 0.01, ("f_mean[2]", "v_theory"): 0.25}}


@pytest.mark.parametrize("page, number", [("pair_sph_bulk_heat", 0), ("pair_sph_bulk_heat", 1), ("pair_sph_bulk", 0), ("pair_sph_micropolar", 0),
                                          pytest.param("pair_sph_bulk_noise", 0, marks=pytest.mark.long)])
def test_measured_beside_theory(lammps, page, number):
    text = [text for _, _, text, _ in blocks(ROOT / "doc" / "src" / f"{page}.rst") if is_input(text)][number]
    table = lammps(text, timeout=300).thermo()[-1]
    for (measured, theory), error in BESIDE_THEORY[page, number].items():
        assert table[measured][-1] == pytest.approx(table[theory][-1], rel=error), measured


def test_table_of_the_log(lammps):
    """The page has the table that its input prints, but for the instructions of the loops."""
    page = ROOT / "doc" / "src" / "pair_sph_bulk_output.rst"
    ((_, _, text, _),) = blocks(page)
    table = re.search(r"code-block:: none\n\n((?:   .*\n)+)", page.read_text())[1].splitlines()
    log = [re.sub(r"(support radius 3),.*", r"\1", line).strip() for line in lammps(text).log.splitlines()]
    assert len(table) > 8 and all(re.sub(r"(support radius 3),.*", r"\1", line).strip() in log for line in table)


def test_streaming_in_a_box_of_unequal_sides(lammps):
    """k = 1.5 q: without the part of the wave in the mean, and with velocities by the places of the displaced particles."""
    (text,) = (text for _, _, text, _ in blocks(ROOT / "doc" / "src" / "Howto_sph_streaming.rst") if "v_ratio" in text)
    found = [lammps(text.replace("equal 0.010", f"equal {0.002 * ratio}").replace("0 48 0 28", "0 48 0 42")).thermo()[-1]["v_ratio"][-1] for ratio in (5, 15)]
    assert found == pytest.approx([5, 15], rel=0.015)


@pytest.mark.parametrize("text", FRAGMENTS)
def test_fragments_are_taken(lammps, text):
    commands = "\n".join(line for line in text.splitlines() if line.strip())
    lammps(fluid_for(commands) + commands + "\n")


def test_inputs_of_the_tutorial_are_files():
    texts = [text for _, _, text, _ in blocks(ROOT / "doc" / "src" / "Howto_sph_tutorial.rst")]
    assert len(texts) == len(list((ROOT / "examples" / "tutorial").glob("in.*")))
    for number, text in enumerate(texts, 1):
        assert (ROOT / "examples" / "tutorial" / f"in.{number}").read_text() == text, number
