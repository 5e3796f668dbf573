"""Every warning and error of the package says its cure, or has an entry on the page of warnings and errors.

A cure is what to use, set, or give. Errors found while a command is read also need none if they say what they want: a name that
is unknown, what a number must be, what is required.

Entries of that page are "*Warning: TEXT*" or "*Error: TEXT*", where dots stand for what varies. An entry that the package
does not print any more is found, too.
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
