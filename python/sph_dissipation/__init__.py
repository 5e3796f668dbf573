# SPDX-License-Identifier: GPL-2.0-only
"""SPH-DISSIPATION for Python: fluids and gases, inputs with the numbers that follow from them, and readers of what LAMMPS writes.

    fluids      Fluid of potentials/*.sph, humid air, sound in them, SI units
    plan        an input for a fluid, a length, and a velocity, or for sound; python3 -m sph_dissipation.plan is ./sphd plan
    fill        particles in and around a closed STL file; python3 -m sph_dissipation.fill is ./sphd fill
    flow_means  means over the periods of a wave, and period_means
    thermo ...  readers: logs, dumps, averages of fixes
    STYLE, ...  style of the figures, for matplotlib
"""
from . import fluids    # noqa: F401
from .figures import STYLE, pyplot, save    # noqa: F401
from .means import flow_means, period_means    # noqa: F401
from .results import averages, each_average, each_frame, exponents, frames, progress, read_array, read_grid, thermo    # noqa: F401
