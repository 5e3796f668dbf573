"""The ideal gas: its pressure follows the internal energy, to second order in the time step."""

import numpy as np

from helpers import header

TIME = 6.0


def kinetic_energy(lammps, steps):
    """Kinetic energy of a standing sound wave after a fixed time."""
    result = lammps(header(2) + f"""
lattice sq 1.0
region box block 0 24 0 8 -0.5 0.5
create_box 1 box
create_atoms 1 box
set group all mass 1.0
set group all sph/e 2.5
variable wave atom 0.1*sin(2*PI*x/24)
velocity all set v_wave NULL NULL
pair_style sph/bulk eos ideal
pair_coeff * * 1.0 1.2 0.01 0.02 4.0
fix FLUID all sph/bulk
timestep {TIME / steps}
compute E all sph/energy
thermo_style custom step c_E[1]
thermo_modify norm no format float %.15g
run {steps}
""")
    return result.thermo()[-1]["c_E[1]"][-1]


def test_trajectories_are_second_order_in_the_time_step(lammps):
    energies = np.array([kinetic_energy(lammps, steps) for steps in (40, 80, 160, 320)])
    changes = np.abs(np.diff(energies))
    orders = np.log2(changes[:-1] / changes[1:])
    assert (orders > 1.95).all(), orders
