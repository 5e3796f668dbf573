# SPDX-License-Identifier: GPL-2.0-only
"""Readers of what LAMMPS writes. Numbers have the units of the input; columns are arrays of numpy."""
import re


def each_table(path):
    """Step, names of the columns, and rows of words of each frame of a text dump of atoms or of local data, in their order."""
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("ITEM: TIMESTEP"):
                step = int(next(file))
            elif line.startswith("ITEM: NUMBER OF"):
                count = int(next(file))
            elif line.startswith(("ITEM: ATOMS", "ITEM: ENTRIES")):
                yield step, line.split()[2:], [next(file).split() for _ in range(count)]


def columns(names, rows):
    """{name: numbers} of rows of words."""
    import numpy as np

    return dict(zip(names, np.array(rows, dtype=float).reshape(len(rows), len(names)).T))


def each_frame(path):
    """Step and {column: values} of each frame of a text dump, in their order."""
    for step, names, rows in each_table(path):
        yield step, columns(names, rows)


def frames(path):
    """The frames of a text dump: {step: {column: values}}, one value per particle."""
    return dict(each_frame(path))


def each_average(path):
    """Step and {column: values} of each output of fix ave/chunk, one value per chunk, or of fix ave/time with mode vector."""
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("#"):
                names = line.split()[1:]    # the last such line has those of the rows
            else:
                step, count = line.split()[:2]
                yield int(step), columns(names, [next(file).split() for _ in range(int(count))])


def averages(path):
    """The outputs of fix ave/chunk, or of fix ave/time with mode vector: {step: {column: values}}."""
    return dict(each_average(path))


def read_array(path):
    """The outputs of fix ave/time with mode vector: [array[row, column]]."""
    import numpy as np

    return [np.column_stack([*found.values()][1:]) for _, found in each_average(path)]


def read_grid(path):
    """Frames of a dump of style grid whose first columns are ix iy iz: [(box lengths, array[ix, iy, iz, column])].
    In two dimensions the third column may have any number."""
    import numpy as np

    found = []
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("ITEM: BOX"):
                length = np.array([np.diff(list(map(float, next(file).split())))[0] for _ in range(3)])
            elif line.startswith("ITEM: GRID SIZE"):
                count = tuple(map(int, next(file).split()))
            elif line.startswith("ITEM: GRID CELLS"):
                rows = np.array([next(file).split() for _ in range(np.prod(count))], dtype=float)
                place = (rows[:, :3].astype(int) - 1) % count
                field = np.full((*count, rows.shape[1] - 3), np.nan)
                field[tuple(place.T)] = rows[:, 3:]
                assert not np.isnan(field).any()
                found.append((length, field))
    return found


def progress(log):
    """Last step in the text of a log file, and step at which this run ends; (None, None) before the first output."""
    start = re.split(r"^run\s+(\d+)(.*)$", log, flags=re.MULTILINE)[-3:]
    rows = re.findall(r"^ *(\d+) +[-\d.]\S*.*$", start[-1].partition("Step")[2], re.MULTILINE) if len(start) == 3 else []
    if not rows:
        return None, None
    return int(rows[-1]), int(start[0]) + (0 if "upto" in start[1] else int(rows[0]))


def thermo(log):
    """Thermodynamic output of every run in the text of a log file: [{column: values}]."""
    found = []
    for head, body in re.findall(r"^ *(Step .*?)\n(.*?)^Loop time", log, re.MULTILINE | re.DOTALL):
        rows = [line.split() for line in body.splitlines() if re.match(r"^\s*\d+(\s+[-+.\deEnaif]+)*\s*$", line)]
        found.append(columns(head.split(), rows))
    return found


def exponents(interval, values, count):
    """s of the modes exp(s t) of a series without noise, by linear prediction: each value from as many before as there are modes."""
    import numpy as np

    rows = np.lib.stride_tricks.sliding_window_view(values, count + 1)
    factors = np.linalg.lstsq(rows[:, :count], rows[:, count], rcond=1e-10)[0]
    return np.log(np.roots([1, *-factors[::-1]]).astype(complex)) / interval
