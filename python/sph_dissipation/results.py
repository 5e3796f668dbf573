# SPDX-License-Identifier: GPL-2.0-only
"""Readers of what LAMMPS writes. Numbers have the units of the input; columns are arrays of numpy."""
import gzip
import math
import re
import warnings
import zlib

ITEM = re.compile(r"ITEM: (NUMBER OF|BOX BOUNDS|GRID SIZE|GRID CELLS|\w+)")


def lines_of(path):
    """Lines of a text file, also of one that gzip has packed, as LAMMPS does for names that end in .gz."""
    with open(path, "rb") as file:
        packed = file.read(2) == b"\x1f\x8b"
    with (gzip.open if packed else open)(path, "rt", encoding="utf-8-sig") as file:
        try:
            yield from file
        except EOFError:    # packed, and cut
            pass
        except (UnicodeDecodeError, gzip.BadGzipFile, zlib.error):
            raise ValueError(f"{path} is not a text file") from None


def whole_numbers(path, what, text):
    words = text.split()
    if not words or not all(re.fullmatch("[0-9]+", word) for word in words):
        raise ValueError(f"{path}: {what} must be whole numbers, not '{text.strip()}'")
    return list(map(int, words))


def cut(path, step):
    warnings.warn(f"{path}: the output of step {step} is cut, and left out", stacklevel=3)


def parts(path):
    """Name, head, and lines of each part ITEM: of a text dump, in their order."""
    name, head, rows = "", "", []
    for line in lines_of(path):
        item = ITEM.search(line) if "ITEM: " in line else None
        if item:
            if item.start():    # LAMMPS has appended to a file that was cut
                rows.append(line[:item.start()])
            if name:
                yield name, head, rows
            name, head, rows = item[1], line, []
        elif name:
            rows.append(line)
        else:
            break
    if not name:
        raise ValueError(f"{path} is not a text dump of LAMMPS, which begins with ITEM:")
    yield name, head, rows


def each_table(path, kinds=("ATOMS", "ENTRIES")):
    """Step, names of the columns, rows of words, and {name: head and lines} of the other parts, of each whole frame of a text dump.
    A frame is cut if LAMMPS was killed, or has not written all of it yet."""
    step, last, other, found = None, "0", {}, False
    for kind, head, lines in parts(path):
        if kind == "TIMESTEP":
            if step:
                cut(path, step)
            other = {}
            step = lines[0].strip() if lines and lines[0].endswith("\n") else "unknown"
        elif kind not in ("ATOMS", "ENTRIES", "GRID CELLS"):
            other[kind] = [head, *lines]
        elif step:
            if kind in kinds:
                found = True
                size = other.get("GRID SIZE" if kind == "GRID CELLS" else "NUMBER OF", [])[1:]
                if not size:
                    raise ValueError(f"{path}: ITEM: {kind} without the number of its lines")
                count = math.prod(whole_numbers(path, f"the number of lines of ITEM: {kind}", size[0]))
                names, rows = head.split()[1 + len(kind.split()):], [line.split() for line in lines[:count]]
                if len(rows) < count or not (head, *lines)[count].endswith("\n") or len({len(row) for row in rows}) > 1:
                    cut(path, step)
                elif rows and len(rows[0]) != len(names):
                    raise ValueError(f"{path}: {len(names)} names of columns for {len(rows[0])} values; names must have no spaces")
                else:
                    yield whole_numbers(path, "the step", step)[0], names, rows, other
                if any(line.strip() for line in lines[count:]):
                    cut(path, f"after {step}")
            step, last, other = None, step, {}
    if step or other:
        cut(path, step or f"after {last}")
    elif not found:
        raise ValueError(f"{path} has no ITEM: {' or '.join(kinds)}")


def columns(names, rows):
    """{name: values} of rows of words: numbers, or text where a word is none."""
    import numpy as np

    try:
        return dict(zip(names, np.array(rows, dtype=float).reshape(len(rows), len(names)).T))
    except ValueError:
        table = np.array(rows).T
        return {name: values if any(map(is_text, values)) else values.astype(float) for name, values in zip(names, table)}


def is_text(word):
    try:
        float(word)
    except ValueError:
        return True
    return False


def each_frame(path):
    """Step and {column: values} of each whole frame of a text dump, in their order; a warning names one that is cut."""
    for step, names, rows, _ in each_table(path):
        yield step, columns(names, rows)


def frames(path):
    """The frames of a text dump: {step: {column: values}}, one value per particle."""
    return dict(each_frame(path))


def each_average(path):
    """Step and {column: values} of each whole output of fix ave/chunk, one value per chunk, or of fix ave/time with mode vector."""
    names, rows, count, step = None, [], 0, None
    for line in lines_of(path):
        before, comment, after = line.partition("#")
        words = before.split()
        if step is not None and (comment or len(words) != len(names) or not line.endswith("\n")):
            cut(path, step)
            step = None
        elif step is not None:
            rows.append(words)
        elif words:
            if names is None or len(words) < 2 or not re.fullmatch("[0-9]+", words[0] + words[1]):
                raise ValueError(f"{path} has no output of fix ave/chunk, nor of fix ave/time with mode vector; series() reads that of scalars")
            step, count, rows = int(words[0]), int(words[1]), []
        if comment:
            names = after.split()    # the last such line has those of the rows
        if step is not None and len(rows) == count:
            yield step, columns(names, rows)
            step = None
    if names is None:
        raise ValueError(f"{path} has no output of fix ave/chunk, nor of fix ave/time with mode vector; series() reads that of scalars")
    if step is not None:
        cut(path, step)


def averages(path):
    """The outputs of fix ave/chunk, or of fix ave/time with mode vector: {step: {column: values}}."""
    return dict(each_average(path))


def series(path):
    """The output of fix ave/time of scalars, such as gauges: {column: values}, with the steps in the first column.
    The names are those of the last line of comments; LAMMPS repeats them where a run appends."""
    names, rows, nothing = None, [], ValueError(f"{path} has no output of fix ave/time of scalars")
    for line in lines_of(path):
        before, comment, after = line.partition("#")
        words = before.split()
        if comment:
            if "Number-of-" in after:
                raise ValueError(f"{path} has vectors or chunks, which averages() reads")
            if rows and after.split()[:1] == names[:1] and after.split() != names:
                raise ValueError(f"{path} has two outputs with different columns")
            if not rows:
                names = after.split()
        if not words:
            continue
        if names is None or not re.fullmatch("[0-9]+", words[0]) or any(map(is_text, words)):
            raise nothing
        if comment or len(words) != len(names) or not line.endswith("\n"):
            cut(path, words[0])
        else:
            rows.append(words)
    if not rows:
        raise nothing
    return columns(names, rows)


def read_array(path):
    """The outputs of fix ave/time with mode vector: [array[row, column]]."""
    import numpy as np

    return [np.array([*found.values()][1:]).T for _, found in each_average(path)]


def read_grid(path):
    """Frames of a dump of style grid whose first columns are ix iy iz: [(box lengths, array[ix, iy, iz, column])].
    In two dimensions the third column may have any number."""
    import numpy as np

    found = []
    for step, _, rows, other in each_table(path, ["GRID CELLS"]):
        count = whole_numbers(path, "ITEM: GRID SIZE", other["GRID SIZE"][1])
        try:
            length = np.array([float(high) - float(low) for low, high, *_ in map(str.split, other["BOX BOUNDS"][1:])])
            rows = np.array(rows, dtype=float)
            places = rows[:, :3].astype(int) - 1
            if len(count) != 3 or len(length) != 3:
                raise ValueError
        except (KeyError, IndexError, ValueError):
            raise ValueError(f"{path}: step {step} has not the form of a dump of style grid with columns ix iy iz") from None
        field, seen = np.full((*count, rows.shape[1] - 3), np.nan), np.zeros(count, dtype=bool)
        places = tuple((places % count).T)
        field[places], seen[places] = rows[:, 3:], True
        if not seen.all():
            raise ValueError(f"{path}: step {step} has not all cells of its grid, or columns that are not ix iy iz")
        found.append((length, field))
    return found


def progress(log):
    """Last step in the text of a log file, and step at which this run ends; (None, None) before the first output."""
    start = re.split(r"^run\s+(\d+)(.*)$", log, flags=re.MULTILINE)[-3:]
    tables = thermo(start[-1]) if len(start) == 3 else []
    if not tables or "Step" not in tables[-1]:
        return None, None
    first, last = int(tables[0]["Step"][0]), int(tables[-1]["Step"][-1])
    return last, int(start[0]) + (0 if "upto" in start[1] else first)


def thermo(log):
    """Thermodynamic output of every run in the text of a log file, as far as it goes: [{column: values}]."""
    if log and "\n" not in log:
        raise ValueError(f"thermo() takes the text of a log, as open(name).read() has it, not {log}")
    found = []
    text = log[:log.rfind("\n") + 1]    # the last line of a run under way may be cut
    for part in re.split(r"^(?:Loop time|Per MPI rank memory allocation).*\n", text, flags=re.MULTILINE):
        names, rows = table_of(part)
        if rows:
            found.append(columns(names, rows))
    return found


def table_of(text):
    """Names of the columns and rows of words of the output of one run. Its styles: one line, which is that of custom, yaml, or multi."""
    keywords = re.search(r"^keywords: \[(.*)\]$", text, re.MULTILINE)
    if keywords:
        return re.findall(r"'(.*?)'", keywords[1]), [row.replace(",", " ").split() for row in re.findall(r"^ +- \[(.*)\]$", text, re.MULTILINE)]
    records = re.split(r"^-+ Step +(\d+) -+ CPU = +\S+ \(sec\) -+\n", text, flags=re.MULTILINE)[1:]
    if records:
        rows = [{"Step": step, **dict(re.findall(r"(\S+) += +(\S+)", body))} for step, body in zip(records[::2], records[1::2])]
        return list(rows[0]), [list(row.values()) for row in rows if len(row) == len(rows[0])]
    first, head = text.partition("\n")[0], ""
    lines = iter(text.splitlines())
    for line in lines:
        width = len(line.split())
        begins = head and (head == first or head != head.strip())    # LAMMPS puts names into the middle of their columns
        if begins and is_row(line, width) and not is_row(head, len(head.split())):
            names = next((names for names in (head.split(), re.split(r"\s\s+", head.strip())) if len(names) == width), None)
            if names is None and head == first:
                raise ValueError(f"thermo(): the names of {width} columns are not clear in \"{head.strip()}\"; take names without spaces")
            if names:
                return names, [row.split() for row in [line, *lines] if is_row(row, width)]
        if not line.startswith("WARNING"):
            head = line
    return [], []


def is_row(line, count):
    """whether these are so many numbers"""
    words = line.split()
    return len(words) == count > 0 and not any(map(is_text, words))


def exponents(interval, values, count):
    """s of the modes exp(s t) of a series without noise, by linear prediction: each value from as many before as there are modes."""
    import numpy as np

    rows = np.lib.stride_tricks.sliding_window_view(values, count + 1)
    factors = np.linalg.lstsq(rows[:, :count], rows[:, count], rcond=1e-10)[0]
    return np.log(np.roots([1, *-factors[::-1]]).astype(complex)) / interval
