"""The numbers of a table on a page of the manual are those of the README that it names.

Such a table stands behind a comment: .. numbers of examples/NAME/README.md
"""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
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
