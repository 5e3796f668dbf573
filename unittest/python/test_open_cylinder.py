"""Flow past a cylinder between an inlet, an outlet and free-slip sides: a small version of examples/cylinder."""

import importlib.util
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parents[2] / "examples" / "cylinder"
sys.path.insert(0, str(HERE))
spec = importlib.util.spec_from_file_location("cylinder", HERE / "run.py")
example = importlib.util.module_from_spec(spec)
spec.loader.exec_module(example)


def test_drag(lammps):
    """Against finite elements in the same domain; the particles are too coarse for more."""
    job = {**example.QUICK, "out": "run"}
    text = "".join(f"variable {key} index {value}\n" for key, value in job.items())
    result = lammps(text + (HERE / "in.cylinder").read_text(), ranks=2, timeout=500)
    found = example.Run(lammps.folder, "run", job["Re"], job["mean"])
    wanted = next(row for row in example.table(HERE / "reference.csv") if row["domain"] == "small" and row["Re"] == job["Re"])
    assert abs(found.drag / wanted["drag"] - 1) < example.QUICK_DRAG
    assert abs(found.lift_t[found.t > found.t[-1] - job["mean"]].mean()) < 0.05 * found.drag
    # what enters also leaves, and the stream has the velocity asked for
    number = result.thermo()[-1]["v_particles"]
    assert np.ptp(number) < 0.01 * number.mean()
