#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Makes examples/README.md and the manual's page Howto_sph_gallery.rst of the table examples/examples.csv.

    gallery.py       after a change of the table, of the title of an example, or of the styles in its inputs

A new example is one line of the table: topic, name of its folder, dimension, particles of its largest run, processor time of all of it,
picture in its folder, and what it shows.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
EXAMPLES, PAGES = ROOT / "examples", ROOT / "doc" / "src"
sys.path.insert(0, str(EXAMPLES))
from run_lammps import table      # noqa: E402
from upstream import STYLES      # noqa: E402

README = EXAMPLES / "README.md"
PAGE = PAGES / "Howto_sph_gallery.rst"
# topics of the page that come first, flows that one sees at once; the others follow in the order of the table
FLOWS = ("Free surfaces", "Open boundaries", "Bodies", "Two fluids", "Turbulence", "Angular momentum", "Walls", "Heat")


def styles(name):
    """Styles of the package in the inputs of an example, in alphabetical order."""
    inputs = [*(EXAMPLES / name).glob("in.*")] or [PAGES / f"Howto_sph_{name}.rst"]
    text = re.sub(r"#.*", "", "\n".join(path.read_text(encoding="utf-8") for path in inputs)).replace("sph/${style}", "sph/bulk sph/micropolar")
    return sorted(set(re.findall(r"\bsph/[a-z]+", text)) & {style for styles in STYLES.values() for style in styles})


def title(name):
    return (EXAMPLES / name / "README.md").read_text(encoding="utf-8").partition("\n")[0].lstrip("# ")


def topics():
    """[(topic, rows of the table)], in their order there"""
    found = {}
    for row in table().values():
        found.setdefault(row["topic"], []).append(row)
    return found.items()


def readme():
    text = ["# Examples", "",
            "`./sphd run NAME` builds LAMMPS with the package, runs an example, compares it with its reference, and draws its figures;",
            "`--help` behind it lists what it takes, `--no-run` draws the figures again.",
            "Particles are those of the largest run, the processor time is that of all runs together on one core of about 3.6 GHz.",
            "Inputs run alone, too: `build/lmp -in examples/NAME/in.NAME`, the tutorial's as `in.1` to `in.8`; compressible_turbulence first needs the files of its `field.py`.",
            "A log in a folder is of the run that gave its results; this version can word a line of the log in another way.", "",
            "`tools/gallery.py` makes this page of [examples.csv](examples.csv).", ""]
    for topic, rows in topics():
        text += [f"## {topic}", "", "| | example | shows | dimension | particles | processor time | styles |", "|---|---|---|---|---|---|---|"]
        for row in rows:
            name = row["example"]
            text.append(f'| <img src="{name}/{row["picture"]}" width="240" alt="{title(name)}"> | [{name}]({name}) | {row["shows"]} '
                        f'| {row["dimension"]} | {row["particles"]} | {row["processor time"]} | {", ".join(styles(name))} |')
        text.append("")
    return "\n".join(text)


def page():
    """a grid of small pictures, pages.css; a click on one shows all of it, as Sphinx does for pictures with a width"""
    text = [".. tools/gallery.py makes this page of examples/examples.csv", "", "Gallery", "=======", "",
            "Each picture is that of an example, which the command below it runs, compares with its reference, and draws.",
            "Particles are those of the largest run; the processor time is that of all runs together.", "A click on a picture enlarges it.",
            ":doc:`Howto_sph_looking` says how to make pictures of a flow of your own.", ""]
    for topic, rows in sorted(topics(), key=lambda item: FLOWS.index(item[0]) if item[0] in FLOWS else len(FLOWS)):
        text += [topic, '"' * len(topic), "", ".. container:: gallery", ""]
        for row in rows:
            name = row["example"]
            text += [f"   .. figure:: ../../examples/{name}/{row['picture']}", "      :width: 100%", f"      :alt: {title(name)}", "",
                     f"      **{title(name)}**: {row['shows']}.", f"      Dimension {row['dimension']}, {row['particles']} particles, {row['processor time']}.",
                     f"      Styles: {', '.join(f'*{style}*' for style in styles(name))}.", f"      ``./sphd run {name}``", ""]
    return "\n".join(text)


def main():
    README.write_text(readme(), encoding="utf-8")
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
