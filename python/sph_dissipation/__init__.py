# SPDX-License-Identifier: GPL-2.0-only
"""SPH-DISSIPATION for Python: fluids and gases, inputs with the numbers that follow from them, and readers of what LAMMPS writes.

    fluids      Fluid of potentials/*.sph, humid air, sound in them, SI units
    plan        an input for a flow, for sound, a channel, a dam break, or a colloid; python3 -m sph_dissipation.plan is ./sphd plan
    fill        particles in and around a closed STL file; python3 -m sph_dissipation.fill is ./sphd fill
    flow_means  means over the periods of a wave, and period_means
    thermo ...  readers: logs, dumps, averages of fixes
    STYLE, ...  style of the figures, for matplotlib
"""
import sys
from contextlib import contextmanager

from . import fluids    # noqa: F401
from .figures import STYLE, pyplot, save    # noqa: F401
from .means import flow_means, period_means    # noqa: F401
from .results import averages, each_average, each_frame, exponents, frames, progress, read_array, read_grid, series, thermo    # noqa: F401


@contextmanager
def program(name):
    """What a program of this package does: failures of files, of memory, and of its output end it with one line."""
    try:
        yield
        if sys.stdout:
            sys.stdout.flush()
    except BrokenPipeError:    # the reader of the output has enough
        sys.stdout = None
        raise SystemExit(1) from None
    except OSError as error:
        if not error.filename:
            sys.stdout = None    # else Python writes once more, and complains
        raise SystemExit(f"{name}: {error.filename + ': ' if error.filename else ''}{error.strerror or error}") from None
    except MemoryError:
        raise SystemExit(f"{name}: the memory of this machine is not enough") from None
    except ImportError as error:
        raise SystemExit(f"{name}: needs {error.name}, which this Python does not have; ./sphd {name} finds one that does") from None
    except KeyboardInterrupt:
        raise SystemExit(f"{name}: interrupted") from None
