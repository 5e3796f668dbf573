"""Numbers and pictures of the manual are those of the examples.

A table of numbers that a README has stands behind a comment: .. numbers of examples/NAME/README.md
"""

import re
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import pictures  # noqa: E402

NUMBER = r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
TABLE = re.compile(r"^\.\. numbers of (\S+)\n\n((?:(?: .*)?\n|\.\. list-table.*\n)+)", re.MULTILINE)


def tables():
    for page in sorted((ROOT / "doc" / "src").glob("*.rst")):
        for number, table in enumerate(TABLE.finditer(page.read_text())):
            rows = re.sub(r"^ +:.*:.*$", "", table[2], flags=re.MULTILINE)
            rows = re.sub(r":math:`(.*?)`|``.*?``|\{|\}", r"\1", rows)
            yield pytest.param(table[1], rows, id=f"{page.stem}-{number}")


@pytest.mark.parametrize("source, rows", tables())
def test_numbers_are_those_of_the_source(source, rows):
    known = set(re.findall(NUMBER, (ROOT / source).read_text()))
    known |= {number.lstrip("+-") for number in known}
    wanted = re.findall(NUMBER, re.sub(r"^ +(?:\* )?- ", "", rows, flags=re.MULTILINE))
    assert len(wanted) > 2
    assert not [number for number in wanted if number not in known]


@pytest.mark.parametrize("name, source", pictures.SOURCES.items())
def test_pictures_are_those_of_the_examples(name, source):
    """If not: tools/pictures.py makes them anew."""
    picture = pictures.PICTURES / name
    assert picture.stat().st_size < 100_000
    theirs = np.array(pictures.reduced(source).convert("RGB"), dtype=float)
    ours = np.array(Image.open(picture).convert("RGB"), dtype=float)
    assert ours.shape == theirs.shape
    assert np.abs(ours - theirs).mean() < 1.0    # of 255, for other versions of the library


def test_commands_below_pictures():
    """Each figure of the start page names the example that draws it."""
    page = (ROOT / "doc" / "src" / "Howto_sph_overview.rst").read_text()
    figures = re.findall(r"^\.\. figure:: JPG/(\S+)\n(?: .*\n|\n)+", page, re.MULTILINE)
    captions = re.split(r"^\.\. figure:: JPG/", page, flags=re.MULTILINE)[1:]
    assert sorted(figures) == sorted(pictures.SOURCES)
    for name, caption in zip(figures, captions):
        assert f"``./sphd run {pictures.SOURCES[name].split('/')[0]}``" in re.split(r"\n\n(?=\S)", caption)[0]


@pytest.mark.parametrize("document", ["README.md", "CONTRIBUTING.md"])
def test_files_named_are_there(document):
    text = (ROOT / document).read_text()
    named = set(re.findall(r"\]\((?!http)([^)#]+)\)", text)) | set(re.findall(r"`((?:src|doc|unittest|tools|examples)/[\w./-]+)`", text))
    assert len(named) > 10
    for name in sorted(named):
        assert (ROOT / name).exists(), name
