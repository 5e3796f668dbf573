"""What comes back from an open end: sound pulses, straight and oblique, at rest and in a stream, and a vortex.

The inputs and the measurement are those of examples/pulse_exit.
"""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import minimize

import test_relax as strained
from open_boundaries import Channel, dump

HERE = Path(__file__).resolve().parents[2] / "examples" / "pulse_exit"
spec = importlib.util.spec_from_file_location("pulse_exit", HERE / "run.py")
example = importlib.util.module_from_spec(spec)
spec.loader.exec_module(example)


def run(lammps, name, job, ranks=1):
    """An input of the example with other values of its variables."""
    text = "".join(f'variable {key} index "{value}"\n' for key, value in {**job, "out": "run"}.items())
    return lammps(text + (HERE / f"in.{name}").read_text(), ranks=ranks)


def reflection(lammps, job, ranks=1):
    run(lammps, "pulse_exit", job, ranks)
    return example.Pulse(lammps.folder, "run", job)


@pytest.mark.parametrize("width", [8, 16])
@pytest.mark.parametrize("stream", [0.0, 0.1])
def test_pulse_leaves(lammps, width, stream):
    assert reflection(lammps, example.pulse("lagged", width, stream)).reflection < example.BARS[width]


def test_hexagonal_rows(lammps):
    job = {**example.pulse("lagged", 8, 0.1), "arrangement": "hex"}
    assert reflection(lammps, job, ranks=2).reflection < example.BARS[8]


@pytest.mark.parametrize("outlet, least, most", [("characteristic", 0.1, 0.4), ("fixed", 0.5, 1.05)])
def test_pulse_that_does_not_leave(lammps, outlet, least, most):
    """Without the lag, the particles of the zone are not compressed as those of the wave are; fixed, they reflect it."""
    assert least < reflection(lammps, example.pulse(outlet, 8, 0.0)).reflection < most


@pytest.mark.parametrize("angle", [30, 45])
def test_oblique(lammps, angle):
    """As much as from a condition that is right for waves along its normal, and a twentieth more."""
    job = example.pulse("lagged", 1.2 * 16, 0.0, angle, 16, 14 * 16)
    assert reflection(lammps, job, ranks=2).reflection < np.tan(np.radians(angle / 2)) ** 2 + 0.05


def test_ranks(lammps):
    job = {**example.pulse("lagged", 8, 0.1), "amplitude": 1e-3}    # round-off is that of the mean pressure, not of the pulse
    one, four = (reflection(lammps, job, ranks) for ranks in (1, 4))
    np.testing.assert_allclose(four.back, one.back, rtol=0, atol=1e-9 * np.abs(one.there).max())


def test_vortex_leaves(lammps):
    job = {"condition": "lagged", "outlet": "velocity 1.0 0.0 0.0 pressure 0.0", "length": 8, "width": 6, "end": 10}
    run(lammps, "pulse_exit_vortex", job)
    t, energy = np.loadtxt(lammps.path("run.history.txt"))[:, 1:3].T
    assert energy[t > 7.5].mean() < example.LEFT * energy[t < 1.25].mean()


# ---------------------------------------------------------------------------------------------
# relaxing fluids


def relaxing_wave(lammps, pb, omega_tau, outlet="velocity 0.0 0.0 0.0 pressure {pb}", g=0.5, tau=10.0, length=70.0):
    """Sound of one frequency that goes to an outlet: what comes back of it, at the plane."""
    channel = Channel(length=length, width=9, support=4.0, zone=11.0)
    omega, amplitude, dt = omega_tau / tau, 1e-4, 0.4
    speed = np.sqrt(1.0 + g * 1j * omega_tau / (1.0 + 1j * omega_tau))
    periods = int(np.ceil(2.0 * length * omega / (2 * np.pi))) + 2
    per_period = int(np.ceil(2 * np.pi / omega / dt / 40)) * 40
    dt = 2 * np.pi / omega / per_period
    text = channel.text(lammps, f"velocity v_u 0.0 0.0 pressure {pb}", outlet.format(pb=pb), timestep=dt, options="shear none bulk none",
                        coeff=f"1.0 1.0 0.0 0.0 {{R}} pb {pb} relax {g * tau} {tau}",
                        before=f"variable u equal {amplitude}*sin({omega}*step*{dt})*(1-exp(-step*{dt}*{omega}))\n")
    text = text.replace("atom_style sph/bulk", "atom_style sph/bulk relax 1")
    strained.write(channel.particles(), lammps.path("box.data"), [-1.0])
    lammps(text + f"run {per_period * (periods - 1)}\n" + dump("out.dump", per_period // 40, "") + f"run {per_period}\n")
    frames = list(lammps.frames("out.dump"))[:40]
    phase = np.exp(-1j * omega * dt * np.array([frame.step for frame in frames]))
    x, u = frames[0]["x"][:, 0], 2 * np.mean([frame["v"][:, 0] * a for frame, a in zip(frames, phase)], axis=0)
    x, u = x.reshape(-1, 9).mean(axis=1), u.reshape(-1, 9).mean(axis=1)  # columns of the lattice
    near = (x > 5.0) & (x < length - 1.0)

    def fit(k):
        waves = np.exp(-1j * np.outer(x[near] - length, [k, -k]))
        amplitudes, *_ = np.linalg.lstsq(waves, u[near], rcond=None)
        return amplitudes, np.sqrt(np.mean(np.abs(waves @ amplitudes - u[near]) ** 2))

    k = omega / speed
    found = minimize(lambda part: fit(k * complex(*part))[1], [1.0, 0.0], method="Nelder-Mead", options={"xatol": 1e-5, "fatol": 1e-14}).x
    (there, back), rest = fit(k * complex(*found))
    print(pb, omega_tau, abs(back / there), "wave number", found, "rest", rest / abs(there))
    assert rest < 0.1 * abs(there)
    c_m = np.sqrt(1.0 + 0.5 * g)
    return abs(back / there), abs((speed - c_m) / (speed + c_m))


@pytest.mark.parametrize("pb", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("omega_tau", [0.3, 1.0])
def test_relaxing_fluid_under_a_background_pressure(lammps, pb, omega_tau):
    """The zone is as dense as the fluid in front of it: the reflection is that of an end that is matched to one speed of sound."""
    found, theory = relaxing_wave(lammps, pb, omega_tau)
    print(theory)
    assert found < theory + 0.003
