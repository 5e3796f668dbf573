"""The source files stand in layers, and include those of their own layer and of lower ones only: the table of the design
page says which file is in which layer."""

import re
from fnmatch import fnmatch
from functools import lru_cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ROOT / "src" / "SPH-DISSIPATION"
PAGE = ROOT / "doc" / "src" / "design_sph_dissipation.rst"
LAYERS = ("styles", "fluid", "stages", "engine", "physics")


@lru_cache
def patterns():
    """Names of files, without extension, by layer; from the table "layers" of the page."""
    text = PAGE.read_text()
    found = {}
    for layer in LAYERS:
        row = re.search(rf"^   \* - {layer}$(.*?)(?=^   \* - |^\S)", text, re.M | re.S)
        assert row, f"the design page has no row for the layer {layer}"
        found[layer] = re.findall(r"``([\w*]+)``", row[1])
    return found


def layer_of(name):
    stem = Path(name).stem
    return [layer for layer in LAYERS if any(fnmatch(stem, one) for one in patterns()[layer])]


def files():
    return sorted(path.name for path in SOURCES.iterdir() if path.suffix in (".h", ".cpp"))


@lru_cache
def includes(name):
    return re.findall(r'^\s*#include "([^"]+)"', (SOURCES / name).read_text(), re.M)


def test_each_file_is_in_one_layer():
    wrong = {name: layer_of(name) for name in files() if len(layer_of(name)) != 1}
    assert not wrong
    for layer, names in patterns().items():
        for one in names:
            assert any(fnmatch(Path(name).stem, one) for name in files()), f"{layer}: no file {one}"


def test_arrows_point_downwards():
    upwards = [(name, other) for name in files() for other in includes(name) if other in files()
               and LAYERS.index(layer_of(other)[0]) < LAYERS.index(layer_of(name)[0])]
    assert not upwards


def test_physics_knows_nothing_of_lammps():
    foreign = [(name, other) for name in files() if layer_of(name) == ["physics"] for other in includes(name)
               if other not in files()]
    assert not foreign


def test_no_cycle():
    """A header and its source file count as one."""
    graph = {}
    for name in files():
        graph.setdefault(Path(name).stem, set()).update(
            Path(other).stem for other in includes(name) if other in files() and Path(other).stem != Path(name).stem)
    done = {}

    def visit(stem, path):
        assert done.get(stem) != "open", f"cycle: {' -> '.join(path[path.index(stem):] + [stem])}"
        if stem in done:
            return
        done[stem] = "open"
        for other in sorted(graph[stem]):
            visit(other, path + [stem])
        done[stem] = "closed"

    for stem in graph:
        visit(stem, [])


def test_a_state_is_one_file():
    """The header of its channel: no other source file names it, but the list, by the header."""
    states = {name: header.name for header in SOURCES.glob("sph_dissipation_channel_*.h")
              for name in re.findall(r'FIELD = "(\w+)"', header.read_text())}
    assert set(states) >= {"rho_relaxed", "tvib"}
    no_code = re.compile(r'//.*|/\*(?:.|\n)*?\*/|"[^"\n]*"')    # comments, and strings, of which messages have spaces
    texts = {path: no_code.sub(lambda m: m[0] if m[0][0] == '"' and " " not in m[0] else "", path.read_text()) for path in (ROOT / "src").rglob("*")
             if path.suffix in (".h", ".cpp") and path.name != "sph_dissipation_channel_list.h"}
    for name, header in states.items():
        assert [path.name for path, text in texts.items() if re.search(rf"\b(d_)?{name}\b", text)] == [header]


def test_a_channel_is_one_file():
    """Its header, and the list: no other source file names it."""
    headers = {name: header.name for header in SOURCES.glob("sph_dissipation_channel_*.h")
               for name in re.findall(r"^ChannelClass\((\w+)\)", header.read_text(), re.M)}
    assert {"ShearChannel", "BulkChannel", "RelaxChannel", "HeatChannel"} <= set(headers)
    lists = {"sph_dissipation_channels.h", *headers.values()}
    named = {path.name: names for path in (ROOT / "src").rglob("*")
             if path.suffix in (".h", ".cpp") and path.name not in lists
             and (names := [name for name in headers if re.search(rf"\b{name}\b", path.read_text())])}
    assert not named


def test_conductivity_is_in_few_files():
    """Nearly all code calls it the coefficient of a flow."""
    named = [path.name for path in (ROOT / "src").rglob("*")
             if path.suffix in (".h", ".cpp") and "conductivity" in path.read_text().lower()]
    assert len(named) <= 8, named


def test_a_formula_is_in_few_objects():
    """A change of a channel compiles the files with loops, the coefficients, and the table again, no others."""
    sources = set(files())

    def add_included(name, found):
        for other in sources.intersection(includes(name)) - found:
            found.add(other)
            add_included(other, found)
        return found

    compiled = [name for name in files()
                if name.endswith(".cpp") and "sph_dissipation_channel_list.h" in add_included(name, set())]
    assert 3 < len(compiled) <= 15, compiled


def walks():
    """The stations (file, names) of each walk, from the tables of the section "A stranger's walk"."""
    section = re.search(r"^A stranger's walk\n-+\n(.*?)^[^\n]+\n-{3,}\n", PAGE.read_text(), re.M | re.S)[1]
    return [[(file, re.findall(r"``([\w:]+(?:\(\))?)``", names))
             for file, names in re.findall(r"^   \* - ``([\w.]+)``\n     - (.*?)\n     - ", table, re.M | re.S)]
            for table in section.split(".. list-table::")[1:]]


def test_walks_are_short():
    assert [len({file for file, _ in walk}) for walk in walks()] == [4, 3]


@pytest.mark.parametrize(("file", "name"), [(file, name) for walk in walks() for file, names in walk for name in names])
def test_station_is_in_its_file(file, name):
    text = (SOURCES / file).read_text()
    *owner, last = name.removesuffix("()").split("::")
    structs = owner if name.endswith("()") else [last]
    if file.endswith(".h"):
        assert all(re.search(rf"\b(?:struct|class) {one}\b[^;]*?{{", text) for one in structs)
    if name.endswith("()"):
        function = name.removesuffix("()") if file.endswith(".cpp") else last
        assert re.search(rf"\b{function}\([^;{{}}]*\)[^;{{}}]*\n? *{{", text), f"{file} does not define {name}"


def stages_of_page():
    """Needs and leaves of each stage, from the table of the section "The stages of the forces"."""
    page = PAGE.with_name("design_sph_stages.rst").read_text()
    rows = re.findall(r"^   \* - ([a-z ]+)\n     - ([A-Z_ ]+|none)\n     - ([A-Z_ ]+|none)\n", page, re.M)
    return {name: (needs.replace("none", "").split(), leaves.replace("none", "").split()) for name, needs, leaves in rows}


def test_stages_are_those_of_the_page():
    """In the order in which the page has them, which is that of the first list with all of them."""
    text = (SOURCES / "sph_dissipation_fluid.cpp").read_text()
    function = text[text.index("void Fluid::list_stages()"):text.index("void Fluid::finish()")]
    data = r"([A-Z_]+(?: \| [A-Z_]+)*)"
    found = {name: tuple(words.replace("NOTHING", "").replace("|", "").split() for words in (needs, leaves))
             for name, needs, leaves in re.findall(rf'add\([^"]*"([a-z ]+)",\s*{data},\s*{data},', function)}
    assert len(found) > 20 and found == stages_of_page()
    constants = re.search(r"static constexpr int (NOTHING = 0.*?);", text, re.S)[1]
    values = [int(value) for value in re.findall(r"= (\d+)", constants)]
    assert values == [0, *(2**k for k in range(len(values) - 1))]


def test_a_device_replaces_stages():
    text = (ROOT / "src" / "KOKKOS" / "sph_dissipation_fluid_kokkos.cpp").read_text()
    names = re.findall(r'\{"([a-z ]+)",', text)
    assert len(names) > 5 and set(names) < set(stages_of_page())
