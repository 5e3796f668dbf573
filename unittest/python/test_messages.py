"""Every warning and error of the package says its cure, or has an entry on the page of warnings and errors.

A cure is what to use, set, or give. Errors found while a command is read also need none if they say what they want: a name that
is unknown, what a number must be, what is required.

Entries of that page are "*Warning: TEXT*" or "*Error: TEXT*", where dots stand for what varies. An entry that the package
does not print any more is found, too.

What cannot be used together is an error of the sources and stands in a sentence of a page: each has the other.
"""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "doc" / "src" / "Howto_sph_messages.rst"
SOURCES = sorted((ROOT / "src" / "SPH-DISSIPATION").glob("*.[ch]*"))
STRINGS = r'\s*"((?:[^"\\]|\\.)*)"'


def literal(text):
    """adjacent string literals at the beginning of a text"""
    found = ""
    while match := re.match(STRINGS, text):
        found += match[1]
        text = text[match.end():]
    return found


def messages():
    """(kind, text, place) of all messages in the sources"""
    for file in SOURCES:
        text = file.read_text()
        for call in re.finditer(r"error->(all|one|warning)\(\s*FLERR,(?:\s*(?:Error::\w+|place\([^\"]*\)),)?\s*", text):
            place = f"{file.name}:{text.count(chr(10), 0, call.start()) + 1}"
            found = literal(text[call.end():])
            if not found:    # the message is in a variable
                name = re.match(r"\w+", text[call.end():])[0]
                *_, made = re.finditer(rf"\b{name}\s*=\s*fmt::format\(", text[:call.start()])
                found = literal(text[made.end():])
            assert found, f"cannot read the message at {place}"
            yield call[1], found, place


def pattern(message):
    """what an entry of the page must be for this message; a value may be dots or anything else"""
    return ".+".join(re.escape(part) for part in re.split(r"\{[^}]*\}", message))


CURE = re.compile(r"(?:[;:.,] |\bor )(?:use|take|give|set|choose|make|limit|build|write|export)\b", re.IGNORECASE)
# errors found on all ranks while a command is read
PLAIN = re.compile(r"^Unknown |does not exist|\bmust\b|requires|needs at least one|needs two numbers|is neither of|is not an equal|"
                   r"of invalid style")
ALL = list(messages())
ENTRIES = re.findall(r"^\*(Warning|Error): (.+)\*$", PAGE.read_text().replace("\\", ""), re.MULTILINE)


def needs_entry(kind, message):
    return not CURE.search(message) and (kind != "all" or not PLAIN.search(message))


@pytest.mark.parametrize("kind, message", [pytest.param(kind, message, id=place) for kind, message, place in ALL
                                           if needs_entry(kind, message)])
def test_message_is_on_the_page(kind, message):
    wanted = "Warning" if kind == "warning" else "Error"
    assert any(re.fullmatch(pattern(message), text) for name, text in ENTRIES if name == wanted), f"no entry for: {message}"


@pytest.mark.parametrize("kind, text", ENTRIES)
def test_entry_is_a_message(kind, text):
    kinds = ("warning",) if kind == "Warning" else ("all", "one")
    assert any(re.fullmatch(pattern(message), text) for name, message, _ in ALL if name in kinds), "the package does not print this"


# -- What cannot be used together -----------------------------------------------------------------------------------


def keywords(*needs):
    """of pair_coeff with one of these requirements (enum Requirement)"""
    found = []
    for file in SOURCES:
        for name, words in re.findall(r'\{"(\w+)",\s+"[^"]*",\s+\w+,\s+\w+,\s+([A-Z_ |]+)(?:, true)?\}', file.read_text()):
            if set(words.split(" | ")) & set(needs):
                found.append(f"*{name}*")
    assert found
    return found


def test_names_of_numbers():
    """... of the keywords of pair_coeff, which a message about too few of them has, are those of the pages, in their order and number."""
    page = "".join(path.read_text() for path in (ROOT / "doc" / "src").glob("pair_sph_bulk*.rst"))
    rows = [row for file in SOURCES for row in re.findall(r'\{"(\w+)",\s+"([^"]*)",\s+(\w+),\s+\w+,\s+[A-Z_ |]+(?:, true)?\}', file.read_text())]
    assert len(rows) == 16
    for name, words, count in rows:
        assert name == "conductivity" or re.search(rf"^ +\*{name}\* values? = {words} (?:\.\.\. )?= ", page, re.MULTILINE), name
        assert not count.isdigit() or int(count) == len(words.split()), name


def refused_by(file, function):
    """words behind refuse( in a function"""
    body = re.search(rf"::{function}\(.*?\n}}\n", (ROOT / "src" / "SPH-DISSIPATION" / file).read_text(), re.DOTALL)[0]
    return [literal(text) for text in re.findall(rf"refuse\((?:[^;\"]*?,)?(?:fmt::format\()?((?:{STRINGS})+)", body) for text in [text[0]]]


LAWS = "iscosities that are not constant"
OPEN, WALL, FLUID, PAIR, NOISE, RHEOLOGY = "fix_sph_open", "fix_sph_wall", "fix_sph_bulk", "pair_sph_bulk", "pair_sph_bulk_noise", "pair_sph_bulk_rheology"

# beginning of a message: (page, words that a sentence there has), ...; a list of words: each has a sentence with the others
REFUSALS = {
    "Fix {} shift cannot be used with temp": [(FLUID, "*shift*", "*temp*"), (NOISE, "*temp*", "*shift*")],
    "Fix {} density rho0 cannot be used with density continuity": [(FLUID, "*density rho0*", "*density continuity*"), (PAIR, "*density continuity*", "*density rho0*")],
    "Fix {} viscous rkl2 or implicit cannot be used in a minimization": [(FLUID, "*viscous rkl2*", "*implicit*", "minimization")],
    "Fix {} viscous rkl2, or implicit with scheme sdirk2 or euler, cannot": [(FLUID, "They cannot", "fix dt/reset")],
    "Fix {} viscous implicit cannot be used with {} of pair_coeff": [(FLUID, "*viscous implicit*", keywords("MELTS")), ("pair_sph_bulk_heat", "*viscous implicit*", keywords("MELTS"))],
    "Fix {} viscous implicit cannot be used with a viscosity that": [(FLUID, "*viscous implicit*", keywords("RHEOLOGY")),
                                                                    (RHEOLOGY, LAWS, "*viscous implicit*")],
    "Fix {} cannot be used in a minimization": [(OPEN, "*fix sph/open*", "minimization")],
    "Fix {} cannot be used with rerun: snapshots have neither": [(OPEN, "*fix sph/open*", "rerun")],
    "Fix {} cannot be used with temp of the pair style": [(OPEN, "*fix sph/open*", "*temp*"), (NOISE, "*temp*", "*fix sph/open*")],
    "Fix {} cannot be used with {} of pair_coeff": [(OPEN, "*fix sph/open*", keywords("NO_OPEN_ENDS")), ("pair_sph_bulk_relax", "*vibration*", "Fix sph/open")],
    "Fix {} energy cannot be used with {} of pair_coeff": [(OPEN, "*energy* cannot", sorted({*keywords("HEAT_CAPACITY")} - {*keywords("NO_OPEN_ENDS")}))],
    "Fix {} cannot use dynamic group": [(OPEN, "group", "dynamic"), (WALL, "group", "dynamic")],
    "Fix {} cannot be used with atom_modify first": [(OPEN, "*atom_modify first*")],
    "{} cannot be used with fix {}, which changes the box": [(OPEN, "The box must not change")],
    "Fix {} cannot be used with molecules or bonds": [("fix_sph_refine", "without bonds")],
    "Fix {} cannot be used with rerun: snapshots have no masses": [("fix_sph_refine", "rerun", "masses")],
    "Fix {} cannot be used when fix deform remaps velocities": [(WALL, "*fix sph/wall*", "*fix deform remap v*")],
    "Fix {} heat flux cannot be used with temp energy": [(WALL, "*heat flux*", "*temp energy*"), (NOISE, "*temp energy*", "*heat flux*")],
    "Fix {} cannot be used with temp energy and eos ideal or gruneisen": [(page, "*temp energy*", "*fix sph/wall*", ["*eos ideal*", "*gruneisen*"]) for page in (WALL, NOISE)],
    "Fix {} move {} cannot be used with {}": [
        (WALL, "*move rigid* and *move elastic*", ["minimization", "*gravity* without *density continuity*", "*rerun*", "*sph/micropolar*", "*shear morris* and *espanol*", "*bulk volume*",
                                "*temp energy*", "*eos ideal*", "*gruneisen*", "vortex viscosity", "*interdrag*", LAWS, "*fix sph/open*", "*fix sph/torque*",
                                "*velocity*", "*rotate*", "*slip*", "*spin*"]),
        *((page, "*move elastic*", ["*viscous rkl2*", "*implicit*"]) for page in (WALL, FLUID)),
        (RHEOLOGY, LAWS, "*move rigid*"), (OPEN, "*fix sph/open*", "*move rigid*"), (PAIR, "*interdrag*", "*move rigid*"), (NOISE, "*temp energy*", "*move rigid*")],
    "Fix {} {} move rigid cannot be used with the thermostat": [(WALL, "*move rigid*", "thermostats")],
    "Pair style {} {} cannot be used with rerun": [(PAIR, "Rerun", ["*eos ideal*", "*temp energy*"]), (NOISE, "*temp energy*", "rerun")],
    "Pair style {} with {} of type {} cannot be used with rerun": [
        (PAIR, "Rerun", sorted({*keywords("HEAT_CAPACITY")} - {*keywords("EOS_IDEAL")})), (RHEOLOGY, ["*arrhenius*", "*solid*"], "rerun"), (RHEOLOGY, keywords("NO_RERUN"), "rerun"), (PAIR, "Rerun", keywords("NO_RERUN")),
        ("pair_sph_bulk_heat", "rerun", ["*conductivity*", "*gruneisen*", "*melt*"])],
    "Pair style {} density continuity cannot be used with rerun": [(PAIR, "Rerun", "*density continuity*")],
    "Pair style {} cannot be combined with another sph/bulk or sph/micropolar": [(PAIR, "can be part of a hybrid style once")],
    "Atom style {} cannot be combined with atom style {}": [(page, ["*sph*", "*rheo*", "*rheo/thermal*", "*mdpd*"], "atom_style hybrid") for page in (PAIR, "atom_style_sph_bulk")],
    "Pair style {} cannot be combined with pair style {}": [(PAIR, "the pair styles of LAMMPS's SPH and DPD-SMOOTH packages")],
    "Pair style {} with temp cannot be used in a minimization": [(NOISE, "*temp*", "minimization")],
    "Pair style {} with temp cannot be used with fix {}": [(NOISE, "*temp*", ["*fix dt/reset*", "*fix sph/dt*"])],
    "Pair style {} with eos ideal cannot be used in a minimization": [(PAIR, "*eos ideal*", "to minimize is an error")],
    "Pair style {} with gruneisen cannot be used in a minimization": [(PAIR, "*gruneisen*", "to minimize is an error"), ("pair_sph_bulk_heat", "*gruneisen*", "minimize")],
    "Pair_style {} temp cannot be used with bulk volume": [(NOISE, "*temp*", "*bulk volume*"), (PAIR, "*bulk volume*", "*temp*")],
    "Pair_style {} temp cannot be used with eos ideal": [(NOISE, "*temp T seed*", "*eos ideal*")],
    "Pair_style {} density continuity cannot be used with eos ideal": [(PAIR, "*density continuity*", "*eos ideal*")],
    "Pair style {}: viscosities that are not constant cannot be used with {}": [(RHEOLOGY, LAWS, "*interdrag*"), (PAIR, "*interdrag*", LAWS)],
    "Pair style {} shear mg/fr cannot be used with {}": [(PAIR, "*interdrag*", "*shear mg/fr*")],
    "Pair style {} temp energy cannot be used with a drag": [(PAIR, "*drag*", "*temp energy*"), (NOISE, "*temp energy*", "*drag*")],
    "Pair style {} temp with dim 1 cannot be used with a drag": [(PAIR, "*drag*", "*temp* and *dim 1*")],
    "Pair style {} temp energy cannot be used with kappa": [(NOISE, "*temp energy*", "*kappa*")],
    "Pair style {} temp cannot be used with {} of pair_coeff": [
        (NOISE, "*temp*", keywords("NO_NOISE")), (NOISE, "*temp T seed*", ["*conductivity*", "*gruneisen*"]), ("pair_sph_bulk_heat", "*temp T seed*", ["*conductivity*", "*gruneisen*", "*melt*"]),
        ("pair_sph_bulk_relax", "*vibration*", "*temp*"), ("pair_sph_bulk_heat", "*solute*", "*temp*"), (RHEOLOGY, ["*arrhenius*", "*solid*"], "*temp*")],
    "Pair_coeff {} of type {} cannot be used with eos {}": [("pair_sph_bulk_relax", "*eos ideal* are required"), ("pair_sph_bulk_heat", "*gruneisen*", "with *eos linear* and *tait*"), ("pair_sph_bulk_heat", "*melt*", "*eos ideal*")],
    "cannot be used with limit of pair_style": [(RHEOLOGY, LAWS, "*limit*")],
    "cannot be used with temp of pair_style": [(RHEOLOGY, LAWS, "*temp*"), (NOISE, "*temp*", LAWS)],
    "cannot be used with a mu of the unlike types": [(RHEOLOGY, LAWS, "a *mu* of unlike types")],
    # other words for the same
    "requires pair style sph/bulk with shear mg or mg/fr2 and bulk density": [(RHEOLOGY, "*sph/bulk*", "*shear mg* or *mg/fr2*", "*bulk density*")],
    "requires dim 2 or 3: on a line": [(RHEOLOGY, "two or three dimensions")],
    "Pair style {} with temp needs fix {} viscous": [(FLUID, "*temp T seed*", "*explicit*", "*trapezoidal*")],
    "Pair style {} with temp energy needs fix {} viscous explicit": [(FLUID, "*temp energy*", "*explicit*"), (NOISE, "*temp energy*", "*viscous rkl2* and *implicit*")],
    "Pair_style {} temp with density continuity requires delta 0": [(PAIR, "*density continuity*", "*temp* needs *delta 0*")],
    "Pair_coeff {} of type {} with density continuity requires tension": [(PAIR, "*density continuity*", "*gruneisen* needs *tension yes*")],
    "Pair style {} temp requires limit yes": [(NOISE, "*temp T seed*", "*kappa*", "*limit yes*")],
    "Pair_style {} limit requires bulk density": [(PAIR, "*limit*", "*bulk density*")],
    "Fix {}: only slip no and spin zero can be used with temp": [(NOISE, "*temp*", "*slip no*", "*spin zero*")],
    "Fix {} requires pair_style {} volume mass": [("fix_sph_refine", "*volume mass*")],
}
REFUSING = re.compile(r"cannot (?:be (?:used|combined) (?:with|in|when)|use dynamic)\b|requires (?:limit|bulk|delta|tension|dim|pair_style \{\})|needs fix \{\} viscous|can be used with temp")


def sentences(page):
    """of paragraphs and points of a list, with links as their words"""
    blocks, block = [], []    # without the signs of points, and without what is bold
    for line in [*(ROOT / "doc" / "src" / f"{page}.rst").read_text().splitlines(), ""]:
        if not line.strip() or re.match(r" *(\* |- |\.\. )", line):
            blocks.append(" ".join(block))
            block = []
        block.append(re.sub(r"^\* |\*\*", "", line.strip()))
    links = re.compile(r":(?:doc|ref):`([^<`]*?)(?:\s+<[^>]*>)?`")
    return [one for block in blocks for one in re.split(r"(?<=[.;])\s+(?=[A-Z*`])", links.sub(r"\1", block))]


def places():
    """(message, page, words) of each sentence that there must be"""
    for message, rows in REFUSALS.items():
        for page, *words in rows:
            several = next((one for one in words if isinstance(one, list)), [None])
            for one in several:
                yield message, page, [word if not isinstance(word, list) else one for word in words]


TEXTS = {page: sentences(page) for page in {page for _, page, _ in places()}}
NEED = re.compile(r"cannot|\bnor\b|need|must|require|can be|without|does not|error|[Ww]ith")


@pytest.mark.parametrize("message, page, words", [pytest.param(*row, id=" ".join(row[2])) for row in places()])
def test_page_lists_what_is_refused(message, page, words):
    assert any(all(word in sentence for word in words) and NEED.search(sentence) for sentence in TEXTS[page]), f"{page} does not say: {message}"


def test_each_refusal_is_on_a_page():
    """... and those of lists in the sources have all of their members there."""
    texts = [text for kind, text, _ in ALL if kind != "warning" and REFUSING.search(text)]
    assert len(texts) > 40
    laws = refused_by("sph_dissipation_model_mix.cpp", "check_rheology")
    assert len(laws) == 5
    for text in texts + laws:
        assert any(text.startswith(message) for message in REFUSALS), f"no row of REFUSALS, with what a page says of it: {text}"
    for message in REFUSALS:
        assert any(text.startswith(message) for text in texts + laws), f"no error of the package: {message}"
    # bodies: as many reasons as the sources have, but for two in one and the keywords of the command
    bodies = refused_by("fix_sph_wall_checks.cpp", "check_bodies")
    (listed,) = (words for _, _, words in REFUSALS["Fix {} move {} cannot be used with {}"][:1])
    for text in bodies:
        assert any(re.split(" and | without ", word.replace("*", ""))[0] in text for word in listed), text


# what a sentence about it may name besides the two: reasons, explanations, and what LAMMPS itself refuses
BESIDES = {"*hybrid*", "*simd*", "*esph*", "*rho0*", "*include*", "*atom_style hybrid*", "*sph*", "*rheo*", "*rheo/thermal*", "*mdpd*", "*thermo_modify temp*", "*Masses*",
           "*pb*", "*compute pair/local*", "*eos ideal*", "*temperature*", "*temp energy*", "*fix sph/refine*", "*pair_coeff*", "*pair_coeff I J*"}


@pytest.mark.parametrize("page", [path.stem for path in sorted((ROOT / "doc" / "src").glob("*.rst")) if not path.stem.startswith(("Howto_sph_messages", "theory"))])
def test_page_refuses_what_the_code_refuses(page):
    """Each word of a list of what cannot be used stands in a row whose words are all in the sentence."""
    rows = [words for _, _, words in places()]
    for sentence in sentences(page):
        if not re.search(r"cannot be (?:used|combined)|(?:is|are) refused", sentence) or re.search("what (?:else )?(?:they )?cannot", sentence):
            continue
        for word in re.findall(r"\*[^*]+\*", sentence):
            assert word in BESIDES or any(any(word in part for part in row) and all(part in sentence for part in row) for row in rows), (word, sentence)
