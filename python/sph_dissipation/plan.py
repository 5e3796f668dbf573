# SPDX-License-Identifier: GPL-2.0-only
"""Prints a complete LAMMPS input for a fluid, a length, and a velocity, with the numbers that follow from them.

    ./sphd plan --fluid CO2 --frequency 30e3 --run --plot                # writes in.sound, runs it, draws measured beside theory: sound.png
    ./sphd plan --fluid water --length 1e-3 --velocity 0.01 > in.flow
    ./sphd plan --rho 1 --mu 0.01 --kappa 0.02 --length 1 --velocity 1 --dim 3 --particles 32
    ./sphd plan --fluid CO2 --frequency 30e3                             # sound: a standing wave, by frequency or --wavelength
    ./sphd plan --fluid water --column 0.6 --tank 3.22                   # a column of water that falls into a tank: a dam break
    ./sphd plan --rho 1 --mu 0.1 --channel 1 --velocity 1 --yield 0.2    # a channel between two walls, here of a fluid with a yield stress
    ./sphd plan --rho 1 --mu 0.5 --length 16 --velocity 0.1 --c 3 --particles 16 --temperature 0.02
    ./sphd plan --rho 1 --mu 0.07 --kappa 0.2 --colloid 2 --temperature 0.001   # a sphere in a fluid with thermal noise

With --fluid, a name of potentials/gases.sph or fluids.sph in any case, or air/HUMIDITY[/TEMPERATURE[/PRESSURE]] (percent, K, Pa), all
numbers are in SI units; else in the units of --units. The input is a periodic box, filled with a stream; the flow is to be put in its place. With
--wavelength, --frequency, or --c real it is filled with a standing wave of sound, as long as the box. What the choices are made by
is in the manual, "Choosing numbers". With --column the input is a tank with a free surface, see "Free surfaces" there, with --channel
a flow between two walls, with --colloid a sphere that thermal noise moves. All of these inputs, but that of a flow, print what is
measured beside theory.
"""
import argparse
import cmath
import difflib
import importlib
import itertools
import math
import os
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

from . import fluids, program

ROOT = Path(__file__).resolve().parents[2]

# square of the stability length over that of rc, in 2 and 3 dimensions: eq. "hstab" of the theory page
STABILITY = {
    "wendland/c2": (1 / 4, 1 / 4),
    "wendland/c4": (7 / 36, 21 / 110),
    "wendland/c6": (49 / 312, 2 / 13),
    "cubic": (49 / 160, 7 / 24),
    "quintic": (0.20117845, 7 / 36),
    "lucy": (7 / 20, 1 / 3),
}
# eq. "timestep" of the theory page: the safety factor S, and the factor G of the bulk term
SAFETY, BULK_RATE = 0.9, 1.6
# of each form of the shear term: the factor G, and kappa0/mu of eq. "limits"
SHEAR = {
    "mg": (21, lambda n: 1 + 2 / n),
    "mg/fr": (17, lambda n: 1 + 2 / n),
    "mg/fr2": (15, lambda n: 1 + 2 / n),
    "morris": (8, lambda n: 2 / n - 1),
    "espanol": (10, lambda n: (3 - n) * (n + 2) / (n * (n + 3))),
}
# the kernels W, up to a factor, of q = r/rc: sph_dissipation_kernel_shapes.h
SHAPES = {
    "wendland/c2": lambda q: (1 - q)**4 * (1 + 4 * q),
    "wendland/c4": lambda q: (1 - q)**6 * (1 + 6 * q + 35 / 3 * q**2),
    "wendland/c6": lambda q: (1 - q)**8 * (1 + 8 * q + 25 * q**2 + 32 * q**3),
    "cubic": lambda q: sum(c * (b - 2 * q)**3 for b, c in ((2, 1), (1, -4)) if 2 * q.real < b),
    "quintic": lambda q: sum(c * (b - 3 * q)**5 for b, c in ((3, 1), (2, -6), (1, 15)) if 3 * q.real < b),
    "lucy": lambda q: (1 - q)**3 * (1 + 3 * q),
}
BOLTZMANN = {"lj": 1.0, "si": 1.380649e-23}
# lattice constant in particle distances, particles and edges of its cell: area or volume of a particle = 1
LATTICE = {2: ("hex", math.sqrt(2 / math.sqrt(3)), 2, (1, math.sqrt(3))), 3: ("bcc", 2 ** (1 / 3), 2, (1, 1, 1))}


BREAKUP = 4               # Reynolds number of a channel over its rows of particles, from which on the rows may break up
STIFF = 10.0      # times the step of sound, from which rate of the viscous terms on they get a solver of their own,
STIFFER = 300.0   # and from which on one that damps fast motions at once; see the page about large viscosities
MOST = 2**31 - 1          # steps of LAMMPS's run command, and IDs of particles
MOST_NEIGHBORS = 1e5      # of a particle
GRAVITY = {"lj": 1.0, "si": 9.81}
TANK = 5.366              # length over the height of the column, of the experiment of examples/dam_break
DAMPING = 0.15            # kappa of a free surface over rho0 c0 rc/2, see the page about free surfaces
DELTA = 0.1               # of density continuity, its default


SOUND_MACH = 1e-5         # of a wave, if no velocity is given: so small that it is linear


def relax_words(fluid):
    """of pair_coeff"""
    return " relax" + "".join(f" {word:.6g}" for pair in fluid.relax for word in pair)


def slope(shape, q):
    """derivative, by a complex step"""
    return shape(complex(q, 1e-30)).imag / 1e-30


def lattice_sums(dim, kernel, support, shear, k):
    """Factors (q/k)^2 on the bulk viscosity, S on the longitudinal viscosity of the shear term, and P on c^2 under the pressure rho c^2, for a
    wave along x of a lattice with particle distance 1: sums over the neighbors of one particle, which are 1 in the continuum."""
    shape, (_, constant, _, edges) = SHAPES[kernel], LATTICE[dim]
    reach = range(-int(support) - 2, int(support) + 3)
    basis = [(0.0,) * dim, (0.5,) * dim]
    near = [tuple(constant * edge * (i + b) for edge, i, b in zip(edges, cell, part)) for cell in itertools.product(reach, repeat=dim) for part in basis]
    near = [(r[0], math.hypot(*r)) for r in near if 0 < math.hypot(*r) < support]
    volume = 1 / (shape(0j).real + sum(shape(complex(r / support)).real for _, r in near))

    def moment(power):
        return sum(shape(complex((j + 0.5) / 2000)).real * ((j + 0.5) / 2000)**power for j in range(2000))

    eta = 2 * dim * (dim + 2) / ((dim + 1) * support * moment(dim) / moment(dim - 1))
    square = 2 * dim / (support**2 * moment(dim + 1) / moment(dim - 1))
    forms = {"mg": lambda r, c: 2 * (dim + 2) * c, "mg/fr": lambda r, c: eta * r * c, "mg/fr2": lambda r, c: square * r**2 * c, "morris": lambda r, c: 2.0,
             "espanol": lambda r, c: 2 * (dim + 2) / (dim + 3) * (1 + c)}
    q = friction = elastic = 0.0
    for x, r in near:
        first, d = slope(shape, r / support) / support, 1e-5
        second = (slope(shape, r / support + d) - slope(shape, r / support - d)) / (2 * d * support**2) if r < support * (1 - d) else 0.0
        c, wave = (x / r)**2, 1 - math.cos(k * x)
        q -= first / r * x * math.sin(k * x)
        friction -= first / r * forms[shear](r, c) * wave
        elastic += (second * c + first / r * (1 - c)) * wave
    square = (volume * q / k)**2
    return square, volume * friction / k**2 / (SHEAR[shear][1](dim) + 2 - 2 / dim), 2 * volume * elastic / k**2 - square


@dataclass
class Plan:
    """All that follows from the arguments."""

    args: argparse.Namespace
    walls = False    # a flow between two walls

    def __post_init__(self):
        args = self.args
        self.dim, self.units = args.dim, "si" if args.fluid else args.units or "lj"
        self.wave = args.c == "real" or bool(args.wavelength or args.frequency)
        self.name = "sound" if self.wave else "column" if args.column else "channel" if self.walls else "colloid" if args.colloid else "flow"    # of the files
        # mg/fr2 and wendland/c2 are right at three spacings in a flow whose particles are shifted.  A free surface and noise need mg, which
        # dissipates there with any kappa.  c6 smooths a wave less; under the pressure pb, a lattice of it is stable, with 6 spacings for ten periods
        flows = not (self.wave or args.column or args.temperature is not None)
        args.shear = args.shear or ("mg/fr2" if flows else "mg")
        args.kernel = args.kernel or ("wendland/c6" if self.wave else "quintic" if self.walls else "wendland/c2")
        three = flows and (args.shear, args.kernel) == ("mg/fr2", "quintic" if self.walls else "wendland/c2")
        args.support = args.support or (6.0 if self.wave else 3.0 if three or args.colloid else 4.0)
        args.particles = args.particles or (12 if args.colloid else 50)
        self.set_fluid()
        self.set_length()
        self.set_relaxation()
        self.rho, self.mu, plane = self.fluid.rho, self.fluid.mu, self.fluid.mu / 3 if args.fluid and self.dim == 2 else 0.0
        self.kappa = None if self.fluid.kappa is None else self.fluid.kappa + plane    # the plane flow of the real fluid
        intrinsic = SHEAR[args.shear][1](self.dim) * self.mu
        if self.kappa is None and intrinsic < 0.0:
            raise SystemExit(f"plan: shear {args.shear} has no bulk viscosity of its own in {self.dim}d, give --kappa")
        self.zeta = 0.0 if self.kappa is None else self.kappa - intrinsic
        self.set_sound_speed()
        self.set_particles()
        self.set_time_step()
        self.steps = math.ceil((args.time or 10 * args.length / (self.c0 if self.wave else args.velocity)) / self.dt)
        if self.steps > MOST:
            raise SystemExit(f"plan: these are {self.steps:.2g} steps of {self.dt:g}, more than LAMMPS can run; take a lower speed of "
                             "sound (--c), a shorter --time, or a larger length")
        if self.number > MOST:
            raise SystemExit(f"plan: these are {float(self.number):.3g} particles, and LAMMPS numbers at most {MOST}; take less --particles")

    def set_particles(self):
        args = self.args
        name, constant, per_cell, edges = LATTICE[self.dim]
        nearest = constant * (1.0 if self.dim == 2 else math.sqrt(3) / 2)
        if args.support <= nearest:
            raise SystemExit(f"plan: --support {args.support:g} reaches no neighbor of this lattice, the nearest are at {nearest:.3g}; take 4 or more")
        neighbors = (math.pi if self.dim == 2 else 4 / 3 * math.pi) * args.support**self.dim
        if neighbors > MOST_NEIGHBORS:
            raise SystemExit(f"plan: --support {args.support:g} gives a particle {neighbors:.2g} neighbors; take 4 to 10")
        self.cells = [max(round(args.particles / (constant * edge)), 1) for edge in edges]    # whole ones; exactly one wave along x
        self.dx = args.length / (constant * self.cells[0] * edges[0] if self.wave else args.particles)
        self.rc = args.support * self.dx
        self.lattice = f"{name} {1 / self.dx**self.dim:.8g}" if self.units == "lj" else f"{name} {constant * self.dx:.8g}"
        self.number = per_cell * math.prod(self.cells)
        width = constant * min(n * e for n, e in zip(self.cells, edges))
        if width < 2 * args.support:
            raise SystemExit(f"plan: a lattice of {args.particles} particles across is {width:.3g} distances wide, less than two support "
                             f"radii, {2 * args.support:g}")

    def set_fluid(self):
        args = self.args
        self.c_fluid = None
        if args.fluid:
            try:
                self.real = fluids.find(args.fluid)
            except KeyError as known:
                names = known.args[0].split()
                near = difflib.get_close_matches(args.fluid.lower(), [name.lower() for name in names])
                names.sort(key=lambda name: (near.index(name.lower()) if name.lower() in near else len(near), name.lower()))
                raise SystemExit(f"plan: no fluid {args.fluid} in gases.sph and fluids.sph, which have: {' '.join(names)}; for another one give "
                                 f"--rho, --mu, --kappa, {'--c, ' if self.wave else ''}and --units si") from None
            except ValueError as error:
                raise SystemExit(f"plan: no fluid {args.fluid}: {error}") from None
            self.c_fluid = self.real.c
        else:
            self.real = fluids.Fluid(args.rho, None, args.mu, args.kappa)
        if self.wave and args.c in (None, "real") and not args.fluid:
            raise SystemExit("plan: --c real is for --fluid; sound in another one needs its speed after --c, for instance --c 1920")
        if self.wave and self.real.kappa is None:
            raise SystemExit("plan: sound is damped by the bulk viscosity as well: give --kappa; 0 is for Stokes' hypothesis")
        if self.wave:
            self.real.c = self.c_fluid if args.c in (None, "real") else args.c

    def set_length(self):
        """of the box, and the velocity, of a wave"""
        args = self.args
        if args.frequency:
            args.wavelength = 2 * math.pi / self.real.wave_number(args.frequency).real if args.fluid else self.real.c / args.frequency
        if args.wavelength:
            args.length, args.velocity = args.wavelength, args.velocity or SOUND_MACH * self.real.c
        self.frequency = args.frequency or (self.real.c if self.wave else args.velocity) / args.length

    def set_relaxation(self):
        """all of the bulk viscosity is a constant at low frequencies, and in flows unless --relax is given"""
        if self.args.relax and not self.real.relax:
            raise SystemExit("plan: --relax is for a gas of gases.sph with relaxing processes")
        constant = self.real.constant() if self.real.relax else self.real
        fast = self.frequency > constant.valid[1]
        self.fluid = self.real if self.args.relax or (fast and self.wave) else constant

    def set_sound_speed(self):
        u, wanted = self.args.velocity, self.args.c
        if self.wave:
            self.c0 = self.real.c
        else:
            self.c0 = wanted or 10 * u
            if not wanted and self.c_fluid and self.c0 > self.c_fluid:
                self.c0 = self.c_fluid

    def set_time_step(self):
        """the limits of the pair style's table, eqs. "timestep" and "combined" of the theory page"""
        args = self.args
        hsq = STABILITY[args.kernel][self.dim - 2] * self.rc**2
        nu = self.mu / self.rho
        self.limits = {
            "acoustic": self.acoustic(hsq),
            "shear": SAFETY / SHEAR[args.shear][0] * hsq / nu if nu else math.inf,
            "bulk": SAFETY / BULK_RATE * self.rho * hsq / abs(self.zeta) if self.zeta else math.inf,
        }
        self.rate = 1 / self.limits["shear"] + 1 / self.limits["bulk"]    # of the fastest viscous mode
        self.explicit = min(self.limits["acoustic"], 1 / self.rate if self.rate else math.inf)
        self.stiffness = self.rate * self.limits["acoustic"]
        self.viscous = ""
        if args.temperature is None and self.stiffness > STIFF:
            self.viscous = "viscous rkl2" if self.stiffness < STIFFER else "viscous implicit scheme sdirk2"
        self.largest = self.limits["acoustic"] if self.viscous else self.explicit
        self.dt = float(f"{args.fraction * self.largest:.3g}")
        if args.temperature is not None:
            self.dt = float(f"{min(self.largest / 3, 0.095 / self.rate if self.rate else math.inf):.3g}")

    def acoustic(self, hsq):
        """with processes the step that is as long as their stiffness, which falls with it, allows"""
        step = 0.0
        for _ in range(100 if self.fluid.relax else 1):
            stiffness = sum(kappa / self.rho * (-math.expm1(-step / tau) / step if step else 1 / tau) for kappa, tau in self.fluid.relax)
            step = 0.25 * math.sqrt(hsq) / (math.sqrt(self.c0**2 + stiffness) + self.args.velocity)
        return step

    def thermal_mach(self):
        energy = BOLTZMANN[self.units] * self.args.temperature
        return math.sqrt(energy / (self.rho * self.dx**self.dim)) / self.c0

    def notes(self):
        args = self.args
        lines = [f"{args.fluid or 'fluid'}, {self.dim}d, length {args.length:.6g}, velocity {args.velocity:g}, units {self.units}{self.kappa_note()}"]
        self.theory, self.part = "", None    # v_theory in the input; amplitude and exponent
        lines += self.frequency_notes()
        lines += self.wave_notes() if self.wave else self.flow_notes()
        steps = ", ".join(f"{name} {step:.4g}" for name, step in self.limits.items() if step < math.inf)
        lines.append(f"largest stable step {self.largest:.4g}: {steps}")
        if self.viscous:
            lines.append(f"viscous terms       their rate times the step {self.rate * self.dt:.3g}: {self.viscous}, with the step of sound; "
                         f"explicit {self.explicit:.4g}")
            if not self.wave and self.stiffness > STIFF > self.limits["acoustic"] / self.limits["shear"]:
                lines.append("                    NOTE: slow flows hardly feel kappa; with intrinsic in its place they need no such solver")
        if args.temperature is not None:
            lines.append(f"thermal noise       viscous rate times step {self.rate * self.dt:.3g}, thermal speed over c0 {self.thermal_mach():.2g}"
                         + ("; NOTE: above 0.1, raise c0 or the particle size" if self.thermal_mach() > 0.1 else ""))
        lines.append(f"particles           {self.number}, {args.particles} across; steps {self.steps}")
        return lines

    def kappa_note(self):
        """what is taken where no bulk viscosity is given"""
        if self.real.kappa is not None:
            return ""
        return f"; kappa NOT GIVEN: {SHEAR[self.args.shear][1](self.dim) * self.mu:.4g}, what shear {self.args.shear} brings along"

    def flow_notes(self):
        args = self.args
        lines = [f"Reynolds number     {self.rho * args.velocity * args.length / self.mu:.4g}" if self.mu else "no shear viscosity",
                 f"Mach number         {args.velocity / self.c0:.3g} with c0 = {self.c0:g}: the density varies by about {(args.velocity / self.c0) ** 2:.1g}"]
        if self.c_fluid and self.c0 != self.c_fluid:
            lines.append(f"                    of the fluid itself {args.velocity / self.c_fluid:.3g}, c = {self.c_fluid:g}")
        if args.velocity > 0.3 * self.c0:
            lines.append("                    NOTE: the flow is compressible")
        if self.mu:
            lines.append(f"times               passage {args.length / args.velocity:.4g}, viscous {self.rho * args.length**2 / self.mu:.4g}")
        return lines

    def frequency_notes(self):
        """which frequencies the bulk viscosity holds for, and the relaxing one in its place"""
        args, lines = self.args, []
        if self.fluid.relax:
            slow = self.real.constant()
            lines.append(f"bulk viscosity      relaxes; the constant {slow.kappa:.4g} in its place holds below {slow.valid[1]:.4g} Hz")
        (above, below), frequency = self.fluid.valid, self.frequency
        if above <= frequency <= below:
            return lines
        where = f"below {below:.4g}" if frequency > below else f"above {above:.4g}"
        lines.append(f"NOTE                kappa of {args.fluid} {'was measured' if self.fluid.measured else 'holds'} {where} Hz, "
                     f"this has {frequency:.3g}")
        if self.real.relax and not self.fluid.relax:
            kappa = self.kappa - self.fluid.kappa + self.real.kappa
            lines += ["                    in its place --relax takes the bulk viscosity that relaxes:",
                      f"                    atom_style  sph/bulk relax {len(self.real.relax)}",
                      f"                    pair_coeff  * * {self.rho:.6g} {self.c0:.6g} {self.mu:.6g} {kappa:.6g} {self.rc:.6g}"
                      f"{relax_words(self.real)}"]
        elif args.fluid == "air":
            lines.append("                    air that relaxes: air/0, air/50, ..., the humidity in percent")
        return lines

    def wave_notes(self):
        longitudinal = self.zeta + (SHEAR[self.args.shear][1](self.dim) + 2 - 2 / self.dim) * self.mu
        wave = replace(self.fluid, c=self.c0, kappa=longitudinal - 4 / 3 * self.mu)
        s = wave.standing_wave(self.args.length)
        lines = []
        if not self.args.fluid and self.dim == 2:
            lines.append(f"bulk viscosity      {self.kappa:.4g} in two dimensions; a liquid with this one in three has kappa + mu/3 = {self.kappa + self.mu / 3:.4g} here")
        lines.append("pressure            with pb the particles are a crystal: right for sound, not for shear")
        if s is None or abs(s.real) > 2 * s.imag:
            return lines + ["NOTE                the wave does not outlive a period"]
        # all of the wave of velocity U at the start, when no strain is there yet, is U sum exp(s t)/D'(s) over the roots of
        # D = s + nu k^2 + k^2 c^2/s + sum k^2 g/(s + 1/tau); those that do not oscillate are small, and left out
        square = (2 * math.pi / self.args.length)**2
        slope = 1 - square * self.c0**2 / s**2 - sum(square * kappa / self.rho / tau / (s + 1 / tau)**2 for kappa, tau in self.fluid.relax)
        part = 2 * self.args.velocity / slope
        self.part = part, s
        self.theory = (f"variable        theory equal {abs(part):.6g}*exp({s.real:.6g}*time)*cos({s.imag:.6g}*time"
                       f"{math.atan2(part.imag, part.real):+.4g})\n")
        k = wave.wave_number(s.imag / (2 * math.pi))
        more = wave.wave_number(s.imag / (2 * math.pi), wave.conduction).imag / k.imag - 1 if k.imag else 0.0
        lines.append(f"sound               frequency {s.imag / (2 * math.pi):.4g}, speed {s.imag / k.real:.5g}, absorption of a driven wave "
                     f"{2 * math.pi * k.imag / k.real:.4g} per wavelength, {20 / math.log(10) * k.imag:.4g} dB{'/m' if self.units == 'si' else ' per unit of length'}"
                     + (f"; heat conduction, which this input leaves out, adds {100 * more:.2g} %" if more else ""))
        errors = ", ".join(f"{name} {100 * error:+.2g} %" for name, error in self.wave_errors(s).items())
        lines.append(f"errors              {errors}, of kernel, lattice, and step" if errors else
                     "NOTE                the kernel smooths this wave away: take more particles, or a smaller support")
        decay = f", decay of its amplitude {-1 / s.real:.4g}" if s.real else ""
        return lines + [f"times               period of the wave {2 * math.pi / s.imag:.4g}{decay}"]

    def scaled(self, factor):
        """the same particles in a smaller box"""
        args = argparse.Namespace(**vars(self.args))
        args.particles = max(int(args.particles * factor), math.ceil(2 * args.support) + 2)
        args.length = self.dx * args.particles
        args.wavelength, args.frequency = args.wavelength and args.length, None
        return Plan(args)

    def wave_errors(self, s):
        """relative, of frequency and decay rate, s being the exponent in the continuum; sums over the lattice, and the step of velocity Verlet.
        Empty if the particles have no such wave."""
        form = SHEAR[self.args.shear][1](self.dim) + 2 - 2 / self.dim
        square, friction, pressure = lattice_sums(self.dim, self.args.kernel, self.args.support, self.args.shear, 2 * math.pi * self.dx / self.args.length)
        particles = replace(self.fluid, c=self.c0 * math.sqrt(max(pressure, 0.0)), kappa=square * self.zeta + friction * form * self.mu - 4 / 3 * self.mu,
                            relax=[(square * kappa, tau) for kappa, tau in self.fluid.relax])
        found = particles.standing_wave(self.args.length) if pressure > 0.0 else None
        if found is None:
            return {}
        errors = {"frequency": found.imag / s.imag - 1 + (s.imag * self.dt)**2 / 24}
        return errors | ({"decay": found.real / s.real - 1} if s.real else {})

    def skin(self):
        """of the neighbor list, with the least time per step at this velocity (page of pair_style sph/bulk)"""
        if self.wave or self.args.temperature is not None:
            return 0.3 * self.dx
        return min(0.5 * self.rc, math.sqrt(10 / (3 * self.dim) * self.args.velocity * self.dt * self.rc))

    def input(self, time=""):
        args, notes = self.args, self.notes() + ([time] if time else [])
        noise = "" if args.temperature is None else (" limit yes" if self.zeta < 0.0 else "") + f" temp {args.temperature:g} 4711"
        kappa = "intrinsic" if self.kappa is None else f"{self.kappa:.6g}"
        shift = "" if args.temperature is not None or self.wave else " shift auto    # with a free surface: no density rho0"
        viscous = f" {self.viscous}" if self.viscous else ""
        pressure = f" pb {self.rho * self.c0**2:.6g}" if self.wave else ""
        relax, room = ("", "") if not self.fluid.relax else (relax_words(self.fluid), f" relax {len(self.fluid.relax)}")
        flow = f"velocity        all set {args.velocity:g} 0.0 0.0 units box    # put the flow here\n"
        output = "thermo_style    custom step time ke press cpuremain\n"
        if self.wave:
            flow = (f'variable        wave atom sin(2.0*PI*x/lx)\nvariable        ux atom {args.velocity:g}*v_wave\n'
                    "velocity        all set v_ux NULL NULL units box    # put another wave here\n")
            output = ("variable        part atom 2.0*vx*v_wave\ncompute         amplitude all reduce ave v_part\n"
                      f"{self.theory}thermo_style    custom step time c_amplitude {'v_theory ' if self.theory else ''}press cpuremain\n")
        box = " ".join(f"0 {n}" for n in self.cells) + (" -0.5 0.5" if self.dim == 2 else "")
        return "".join(f"# {line}\n" for line in notes) + f"""
units           {self.units}
dimension       {self.dim}
atom_style      sph/bulk{room}

lattice         {self.lattice}
region          box block {box}
create_box      1 box
create_atoms    1 box
set             group all mass {self.rho * self.dx**self.dim:.8g}
{flow}
neighbor        {self.skin():.4g} bin
pair_style      sph/bulk kernel {args.kernel} shear {args.shear}{noise}
pair_coeff      * * {self.rho:.6g} {self.c0:.6g} {self.mu:.6g} {kappa} {self.rc:.6g}{relax}{pressure}    # rho0 c0 mu kappa rc
fix             1 all sph/bulk density rho0{viscous}{shift}

timestep        {self.dt:.3g}
{output}{self.ends()}"""

    def ends(self):
        """what all inputs end with"""
        return (f"dump            1 all custom {max(self.steps // 20, 1)} {self.name}.dump id type x y z vx vy vz\n"
                f"thermo          {max(self.steps // 100, 1)}\nrun             {self.steps}\n")

    def measured(self, thermo):
        """lines, from the columns of the log"""
        if not self.part:
            return []
        import numpy as np

        # a exp(s t), whose s is corrected by the fitted b of (a + b t) exp(s t); after a period, when slower modes are gone
        s = self.part[1]
        late = thermo["Time"] > 2 * math.pi / s.imag
        time, values = thermo["Time"][late], thermo["c_amplitude"][late]
        if len(time) < 20:
            return []
        for _ in range(20):
            mode = np.exp(s * time)
            a, b, c, d = np.linalg.lstsq(np.column_stack([mode.real, -mode.imag, time * mode.real, -time * mode.imag]), values, rcond=None)[0]
            s += complex(c, d) / complex(a, b)
        return [beside("frequency", s.imag / (2 * math.pi), self.part[1].imag / (2 * math.pi)), beside("rate of decay", -s.real, -self.part[1].real)]

    def figure(self, plt, thermo):
        """of what is measured beside theory, from the columns of the log"""
        figure, axes = plt.subplots()
        if self.part:
            part, s = self.part
            times = [thermo["Time"][-1] * k / 2000 for k in range(2001)]
            axes.plot(times, [(part * cmath.exp(s * time)).real for time in times], "k-", label="theory")
        axes.plot(thermo["Time"], thermo["c_amplitude"], "o", label="measured")
        axes.set(xlabel=self.label("time", "s"), ylabel=self.label("amplitude of the velocity", "m/s"))
        axes.legend()
        return figure

    def label(self, name, unit):
        return f"{name} ({unit})" if self.units == "si" else name


class Column(Plan):
    """A column of liquid at one end of a tank, with a free surface."""

    def set_length(self):
        args = self.args
        self.gravity = args.gravity or GRAVITY[self.units]
        args.length = args.column
        self.dx, self.support = args.column / args.particles, args.support
        self.width = max(round((args.width or 2 * args.column) / self.dx), 1)            # in spacings
        self.tank = max(round((args.tank or args.column * TANK) / self.dx), self.width)
        self.falls = self.tank > self.width
        args.velocity = (2.0 if self.falls else 1.0) * math.sqrt(self.gravity * args.column)
        args.time = args.time or 10 * math.sqrt(args.column / self.gravity)
        self.frequency = 0.0

    def set_sound_speed(self):
        self.c0 = self.args.c or 10 * self.args.velocity
        if self.args.kappa is None:    # the sound is that of the particles, not of the fluid
            self.kappa = DAMPING * self.rho * self.c0 * 0.5 * self.args.support * self.dx
            self.zeta = self.kappa - SHEAR[self.args.shear][1](self.dim) * self.mu

    def set_particles(self):
        args = self.args
        self.layer = math.sqrt(self.mu / self.rho * math.sqrt(args.column / self.gravity))    # of friction with the walls
        self.slip = "free" if self.layer < self.dx else "no"
        self.rc = args.support * self.dx
        self.layers = math.ceil(args.support)
        self.height = 5 * args.column if self.falls else 1.5 * args.column
        self.lattice = f"{'sq' if self.dim == 2 else 'sc'} {1 / self.dx**self.dim if self.units == 'lj' else self.dx:.8g}"
        self.depth = 1 if self.dim == 2 else max(2 * self.layers, args.particles // 2)    # of a periodic slab
        ends = 2 if self.falls else 1    # floor and lid
        rows = round(self.height / self.dx) + ends * self.layers
        self.number = self.depth * (self.width * args.particles + 2 * self.layers * rows + ends * self.tank * self.layers)

    def set_time_step(self):
        super().set_time_step()
        hsq = STABILITY[self.args.kernel][self.dim - 2] * self.rc**2
        self.limits["diffusion"] = SAFETY / (7.0 * DELTA * 0.5 * self.rc / hsq * self.c0)
        rates = self.rate + 1 / self.limits["diffusion"]
        self.explicit = min(self.limits["acoustic"], 1 / rates)
        self.largest = min(self.limits["acoustic"], self.limits["diffusion"]) if self.viscous else self.explicit
        self.dt = float(f"{self.args.fraction * self.largest:.3g}")

    def kappa_note(self):
        return "" if self.args.fluid or self.args.kappa is not None else f"; kappa NOT GIVEN: {self.kappa:.4g}, which damps sound"

    def frequency_notes(self):
        return []

    def flow_notes(self):
        fall = "falls" if self.falls else "rests"
        return [f"column              {self.width * self.dx:.4g} wide, {self.args.column:.4g} high, {fall} in a tank {self.tank * self.dx:.4g} long",
                f"walls               slip {self.slip}: friction reaches {self.layer:.2g} in (H/g)^(1/2), {self.layer / self.dx:.2g} spacings",
                f"speed of sound      {self.c0:.4g}, ten times the largest velocity; kappa damps its sound and does not slow the flow",
                f"time                {self.args.time:.4g}; gravity {self.gravity:g}; unit (H/g)^(1/2) = {math.sqrt(self.args.column / self.gravity):.4g}"]

    def scaled(self, factor):
        args = argparse.Namespace(**vars(self.args))
        args.particles = max(int(args.particles * factor), 4)
        args.column, args.width, args.tank = args.particles * self.dx, self.width * factor * self.dx, self.tank * factor * self.dx
        return Column(args)

    def input(self, time=""):
        args, dx, wall = self.args, self.dx, self.layers * self.dx
        z = "-0.5 0.5" if self.dim == 2 else f"0 {self.depth * dx:.8g}"
        origin = "0.5 0.5 0.0" if self.dim == 2 else "0.5 0.5 0.5"
        length, width, g = self.tank * dx, self.width * dx, self.gravity
        top, lid = (self.height + wall, f"{self.height:.8g}") if self.falls else (self.height, "INF")    # of the domain; of the tank
        depth = 1 if self.dim == 2 else self.depth * dx
        theory = (f"{width:.8g}+{2 * math.sqrt(g * args.column):.8g}*time    # Ritter's front, an upper bound" if self.falls else
                  f"{self.rho * g * args.column**2 / 2 * depth:.8g}    # at rest")
        return "".join(f"# {line}\n" for line in self.notes() + ([time] if time else [])) + f"""
units           {self.units}
dimension       {self.dim}
boundary        f f p
atom_style      sph/bulk

lattice         {self.lattice} origin {origin}
region          domain block {-wall:.8g} {length + wall:.8g} {-wall:.8g} {top:.8g} {z} units box
create_box      2 domain
region          column block 0 {width:.8g} 0 {args.column:.8g} INF INF units box
region          tank block 0 {length:.8g} 0 {lid} INF INF units box side out
create_atoms    1 region column
create_atoms    2 region tank
group           water type 1
group           walls type 2
set             group all mass {self.rho * dx**self.dim:.8g}

neighbor        {self.skin():.4g} bin
pair_style      sph/bulk kernel {args.kernel} shear {args.shear} density continuity
pair_coeff      * * {self.rho:.6g} {self.c0:.6g} {self.mu:.6g} {self.kappa:.6g} {self.rc:.6g}    # rho0 c0 mu kappa rc
variable        start atom {self.rho:.8g}*(1.0+{g:.8g}*({args.column:.8g}-y)/{self.c0:.8g}^2)    # hydrostatic
set             group water sph/rho v_start
fix             g water gravity {g:.8g} vector 0 -1 0
fix             w walls sph/wall slip {self.slip} gravity 0 {-g:.8g} 0
fix             1 water sph/bulk{f' {self.viscous}' if self.viscous else ''}

timestep        {self.dt:.3g}
variable        front equal bound(water,xmax)+{0.5 * dx:.8g}
region          far block {length:.8g} INF INF INF INF INF units box
compute         push walls reduce/region far sum f_w[1]    # force on the far wall
compute         water water property/atom rho vol
variable        p atom {2 * self.c0**2 / self.rc:.8g}*(c_water[1]-{self.rho:.8g})*(c_water[1]>{self.rho:.8g})*c_water[2]*(x>{length - 0.5 * self.rc:.8g})
compute         mean water reduce sum v_p                  # ... by the pressure of the water within rc/2 of it
variable        theory equal {theory}
thermo_style    custom step time v_front c_push c_mean v_theory cpuremain
thermo_modify   norm no
{self.ends()}"""

    def measured(self, thermo):
        push, mean = thermo["c_push"], thermo["c_mean"]
        if not self.falls:
            return [beside("mean force on the far wall", push[1:].mean(), thermo["v_theory"][0])]
        wet = thermo["v_front"] > (self.tank - 0.5) * self.dx
        if not wet.any():
            return []
        first, ritter = wet.argmax(), (self.tank - self.width) * self.dx / (2 * math.sqrt(self.gravity * self.args.column))
        return [f"the front is at the far wall at {thermo['Time'][first]:.4g}; Ritter's front, which is faster, at {ritter:.4g}",
                beside("mean force on this wall from then on", push[first:].mean(), mean[first:].mean(), "by the pressure in the water")]

    def figure(self, plt, thermo):
        figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
        left.plot(thermo["Time"], thermo["v_front"], label="front")
        right.plot(thermo["Time"], thermo["c_push"], label="on the wall")
        right.plot(thermo["Time"], thermo["c_mean"], label="by the pressure in the water")
        axes, name = (left, "Ritter's front, an upper bound") if self.falls else (right, "hydrostatic")
        axes.plot(thermo["Time"], thermo["v_theory"], "k--", label=name)
        left.set(xlabel=self.label("time", "s"), ylabel=self.label("front", "m"), ylim=(0, 1.05 * self.tank * self.dx))
        right.set(xlabel=self.label("time", "s"), ylabel=self.label("force on the far wall", "N/m" if self.dim == 2 else "N"))
        for axes in (left, right):
            axes.legend()
        return figure


class Channel(Plan):
    """A flow between two walls, along which a force drives the fluid, which may have a yield stress."""

    walls = True

    def set_length(self):
        args = self.args
        args.length, self.frequency = args.channel, args.velocity / args.channel
        self.stress = args.yield_stress or 0.0
        self.slowest = args.channel / args.velocity * 50.0    # m of the keyword yield

    def set_particles(self):
        args = self.args
        self.row = args.channel / args.particles                   # distance of the rows
        self.along = self.row * 2 / math.sqrt(3)                   # ... of the particles in a row
        self.dx = math.sqrt(self.row * self.along)
        self.rc = args.support * self.dx
        if args.support <= LATTICE[2][1]:
            raise SystemExit(f"plan: --support {args.support:g} reaches no neighbor in a row, the nearest are at {LATTICE[2][1]:.3g}; take 3 or more")
        self.columns = max(12, math.ceil(2 * self.rc / self.along) + 1)
        self.layers = math.ceil(self.rc / self.row)
        self.lattice = f"hex {1 / self.dx**2:.8g}" if self.units == "lj" else f"hex {self.along:.8g}"
        self.number = self.columns * (args.particles + 2 * self.layers)
        # the stress tau at the wall drives the fluid: 2 mu U tau = H/2 (tau - tau_y)^2
        half, viscous = args.channel / 2, self.mu * args.velocity / (args.channel / 2)
        self.at_wall = self.stress + viscous + math.sqrt(viscous * (viscous + 2 * self.stress))
        self.plug = self.stress / self.at_wall                     # part of the channel that moves as a whole
        self.pressure = 0.01 * self.rho * self.c0**2
        args.time = args.time or 0.7 * self.rho * args.channel**2 / self.mu
        self.force = self.at_wall / half / self.rho                # per mass

    def set_time_step(self):
        constant, self.mu = self.mu, self.mu + self.stress * self.slowest
        super().set_time_step()
        self.mu = constant
        if self.viscous and self.stress:
            self.viscous = "viscous rkl2"    # which mu that is not constant needs

    def flow_notes(self):
        args = self.args
        yields = f", yield stress {self.stress:g}: {100 * self.plug:.2g} % of the channel moves as a plug" if self.stress else ""
        reynolds = self.rho * args.velocity * args.channel / self.mu
        rows = math.ceil(reynolds / BREAKUP)
        note = [f"NOTE                take --particles {rows}: fewer rows may break up, and the flow rate may be wrong by 10 percent"] if rows > args.particles else []
        return [f"Reynolds number     {reynolds:.4g}, Mach number {args.velocity / self.c0:.3g}{yields}", *note,
                f"force               {self.force:.5g} per mass, which gives the stress {self.at_wall:.5g} at the walls",
                f"theory              mean velocity {self.mean():.5g} in the end, from rest within 0.1 % after {0.7 * self.rho * args.channel**2 / self.mu:.4g}"]

    def mean(self):
        return self.args.velocity * (2 + self.plug) / 3

    def profile(self, y):
        """velocity at the distance y from the middle, over half of the width"""
        return self.args.velocity * (1 - max(0.0, (abs(y) - self.plug) / (1 - self.plug))**2)

    def scaled(self, factor):
        args = argparse.Namespace(**vars(self.args))
        args.particles = max(int(args.particles * factor), 4)
        args.channel = self.row * args.particles
        return Channel(args)

    def input(self, time=""):
        args, thick, height = self.args, self.layers * self.row, self.args.channel
        length = self.columns * self.along
        kappa = "intrinsic" if self.kappa is None else f"{self.kappa:.6g}"
        law = f" yield {self.stress:.6g} {self.slowest:.6g}" if self.stress else ""
        return "".join(f"# {line}\n" for line in self.notes() + ([time] if time else [])) + f"""
units           {self.units}
dimension       2
boundary        p f p
atom_style      sph/bulk

lattice         {self.lattice} origin 0.25 0.25 0.0    # walls halfway between two rows
region          box block 0 {length:.8g} {-thick:.8g} {height + thick:.8g} -0.5 0.5 units box
create_box      1 box
create_atoms    1 box
set             group all mass {self.rho * self.dx**2:.8g}
region          fluid block INF INF 0 {height:.8g} INF INF units box
group           fluid region fluid
group           walls subtract all fluid

neighbor        {self.skin():.4g} bin
pair_style      sph/bulk kernel {args.kernel} shear {args.shear}
pair_coeff      * * {self.rho:.6g} {self.c0:.6g} {self.mu:.6g} {kappa} {self.rc:.6g} pb {self.pressure:.6g}{law}    # rho0 c0 mu kappa rc
fix             1 fluid sph/bulk density rho0{f' {self.viscous}' if self.viscous else ''}
fix             drive fluid gravity {self.force:.8g} vector 1 0 0
fix             walls walls sph/wall

timestep        {self.dt:.3g}
variable        mean equal vcm(fluid,x)
variable        theory equal {self.mean():.6g}
variable        stress equal f_walls[1]/{2 * length:.8g}    # at the walls
variable        balance equal {self.at_wall:.6g}            # ... in the end
thermo_style    custom step time v_mean v_theory v_stress v_balance cpuremain
{self.ends()}"""

    def measured(self, thermo):
        return [beside("mean velocity", thermo["v_mean"][-1], self.mean()), beside("stress at the walls", thermo["v_stress"][-20:].mean(), self.at_wall)]

    def figure(self, plt, thermo):
        from . import each_frame
        *_, (_, last) = each_frame(f"{self.name}.dump")
        figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
        left.plot(thermo["Time"], thermo["v_mean"], label="measured")
        left.plot(thermo["Time"], thermo["v_theory"], "k--", label="theory, in the end")
        left.set(xlabel=self.label("time", "s"), ylabel=self.label("mean velocity", "m/s"))
        height = self.args.channel
        y = last["y"][(last["y"] > 0) & (last["y"] < height)]
        right.plot(last["vx"][(last["y"] > 0) & (last["y"] < height)], y, "o", label="measured")
        places = [height * k / 200 for k in range(201)]
        right.plot([self.profile(2 * place / height - 1) for place in places], places, "k-", label="theory")
        right.set(xlabel=self.label("velocity at the end", "m/s"), ylabel=self.label("place across the channel", "m"))
        for axes in (left, right):
            axes.legend()
        return figure


class Colloid(Plan):
    """A sphere in a fluid with thermal noise, in a periodic box."""

    SPACINGS = 2.0    # in the radius

    def set_length(self):
        args = self.args
        self.dx = args.colloid / self.SPACINGS
        args.length, self.frequency = args.particles * self.dx, 0.0
        self.energy = BOLTZMANN[self.units] * args.temperature
        args.velocity = math.sqrt(self.energy / (self.real.rho * self.dx**3))    # thermal, of a particle

    def set_particles(self):
        args = self.args
        self.rc = args.support * self.dx
        if args.particles < 2 * args.support:
            raise SystemExit(f"plan: a box of {args.particles} spacings is less than two support radii, {2 * args.support:g}, wide; take more --particles")
        self.lattice = f"sc {1 / self.dx**3 if self.units == 'lj' else self.dx:.8g}"
        self.number = args.particles**3
        middle = (args.particles / 2,) * 3    # of the box, where a particle is none: they are at half spacings
        self.inside = sum(math.dist((i + 0.5, j + 0.5, k + 0.5), middle) < self.SPACINGS for i, j, k in itertools.product(range(args.particles), repeat=3))
        self.spread = args.length**2 * self.rho / (4 * math.pi**2 * self.mu)    # time in which momentum spreads through the box
        args.time = args.time or 25 * self.spread

    def set_time_step(self):
        super().set_time_step()
        self.dt = float(f"{min(self.dt, 0.046 / self.rate):.3g}")    # next to a body the rate is twice as large

    def flow_notes(self):
        radius, mass = self.args.colloid, self.inside * self.rho * self.dx**3
        nu, friction = self.mu / self.rho, 6 * math.pi * radius
        diffusion = self.energy / (friction * self.mu)
        time, wanted = radius**2 / diffusion, math.sqrt(100 * self.energy * self.rho / friction)
        thermal = math.sqrt(self.energy / mass)
        return [f"colloid             radius {radius:g}, {self.inside} particles, in a box {self.args.length:.4g} wide",
                f"Mach number         {self.thermal_mach():.2g} of the particles, sqrt(kT/m)/c0, {thermal / self.c0:.2g} of the colloid",
                f"Reynolds number     {thermal * radius / nu:.2g} of the colloid, at its thermal velocity {thermal:.3g}",
                f"Schmidt number      {nu / diffusion:.3g}, viscosity over diffusion; 100 with mu = {wanted:.3g}",
                f"diffusion           {diffusion:.4g} by Stokes and Einstein; over its radius in {time:.3g}, {time / self.dt:.2g} steps",
                f"times               momentum spreads through the box in {self.spread:.4g}"]

    def scaled(self, factor):
        return self    # the box stays small

    def input(self, time=""):
        args = self.args
        kappa = "intrinsic" if self.kappa is None else f"{self.kappa:.6g}"
        every = max(self.steps // 20, 10) // 10 * 10
        middle = " ".join([f"{args.particles / 2:g}"] * 3)
        return "".join(f"# {line}\n" for line in self.notes() + ([time] if time else [])) + f"""
units           {self.units}
atom_style      sph/bulk

lattice         {self.lattice} origin 0.5 0.5 0.5
region          box block 0 {args.particles} 0 {args.particles} 0 {args.particles}
create_box      2 box
create_atoms    1 box
region          ball sphere {middle} {self.SPACINGS:g}
set             region ball type 2
set             group all mass {self.rho * self.dx**3:.8g}
group           fluid type 1
group           ball type 2

neighbor        {self.skin():.4g} bin
pair_style      sph/bulk kernel {args.kernel} shear {args.shear}{' limit yes' if self.zeta < 0.0 else ''} temp {args.temperature:g} 4711
pair_coeff      * * {self.rho:.6g} {self.c0:.6g} {self.mu:.6g} {kappa} {self.rc:.6g}    # rho0 c0 mu kappa rc
fix             1 fluid sph/bulk density rho0
fix             2 ball rigid single
fix             3 ball sph/wall move rigid

timestep        {self.dt:.3g}
variable        K equal mass(ball)*(vcm(ball,x)^2+vcm(ball,y)^2+vcm(ball,z)^2)/{3 * self.energy:.6g}    # over that of theory without a box
fix             K all ave/time 10 {every // 10} {every} v_K ave running
variable        theory equal 1.0-mass(ball)/mass(all)    # since the total momentum is zero
variable        t equal time
variable        x equal xcm(ball,x)                      # path, not wrapped into the box
variable        y equal xcm(ball,y)
variable        z equal xcm(ball,z)
fix             path all ave/time 10 1 10 v_t v_x v_y v_z file colloid.path
thermo_style    custom step time f_K v_theory cpuremain
thermo          {every}
dump            1 all custom {every} {self.name}.dump id type x y z vx vy vz
run             {self.steps}
"""

    def measured(self, thermo):
        memory = self.inside * self.rho * self.dx**3 / (6 * math.pi * self.mu * self.args.colloid)    # of the velocity, by Stokes's drag
        chance = math.sqrt(2 / 3 * memory / thermo["Time"][-1])
        return [beside("kinetic energy of the colloid over 3 kT/2", thermo["f_K"][-1], thermo["v_theory"][-1])
                + f", with a statistical error of about {100 * chance:.1g} %"]

    def figure(self, plt, thermo):
        figure, axes = plt.subplots()
        axes.plot(thermo["Time"][1:], thermo["f_K"][1:], "o-", label="mean since the start")
        axes.plot(thermo["Time"][1:], thermo["v_theory"][1:], "k--", label="theory")
        axes.set(xlabel=self.label("time", "s"), ylabel="kinetic energy of the colloid over 3 kT/2", ylim=(0, None))
        axes.legend()
        return figure


def beside(what, measured, reference, name="theory"):
    return f"{what} {measured:.4g}, {name} {reference:.4g}" + (f": {100 * (measured / reference - 1):+.2g} %" if reference else "")


def measured_time(plan, lmp):
    """seconds of one core per particle and step; of a box that is smaller, if it is large; None: takes too long"""
    most = 30000
    small = plan.scaled((most / plan.number) ** (1 / plan.dim)) if plan.number > most else plan
    steps = 10 if small.viscous else max(10, min(200, 400000 // small.number))
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "in.plan").write_text(re.sub(r"^run .*", f"run {steps}", small.input(), flags=re.MULTILINE))
        try:
            done = subprocess.run([str(lmp), "-in", "in.plan", "-nocite", "-log", "none"], cwd=folder,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True, errors="replace",
                                  check=False, timeout=60, env={**os.environ, "OMP_NUM_THREADS": "1"})
        except subprocess.TimeoutExpired:
            return None
    loop = re.search(r"^Loop time of (\S+) on", done.stdout, re.MULTILINE)
    share = re.search(r"([\d.]+)% CPU use", done.stdout)    # others may use the machine, too
    if done.returncode or not loop or not share:
        errors = re.findall(r"^ERROR.*", done.stdout, re.MULTILINE)
        raise SystemExit(f"plan: {lmp} does not run this input: " + (errors[0] if errors else f"\n{done.stdout[-1000:]}"))
    return float(loop[1]) * min(float(share[1]) / 100, 1.0) / steps / small.number


def duration(seconds):
    for size, name in ((86400, "days"), (3600, "hours"), (60, "minutes")):
        if seconds >= 2 * size:
            return f"{seconds / size:.2g} {name}"
    return f"{seconds:.2g} seconds"


def number_of(text):
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be a number without a unit, such as 40e3, not {text}") from None


def positive(text):
    number = number_of(text)
    if not (0.0 < number < math.inf):
        raise argparse.ArgumentTypeError(f"must be > 0, not {text}")
    return number


def not_negative(text):
    number = number_of(text)
    if not (0.0 <= number < math.inf):
        raise argparse.ArgumentTypeError(f"must be >= 0, not {text}")
    return number


def sound_speed(text):
    return text if text == "real" else positive(text)


def arguments(argv):
    parser = argparse.ArgumentParser(prog="./sphd plan", description=__doc__.partition("\n")[0], epilog=__doc__.partition("\n\n")[2],
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fluid", help="name in potentials/gases.sph or fluids.sph, in any case, or air/HUMIDITY[/TEMPERATURE[/PRESSURE]]")
    parser.add_argument("--rho", type=positive, help="density")
    parser.add_argument("--mu", type=not_negative, help="shear viscosity")
    parser.add_argument("--kappa", type=not_negative, help="bulk viscosity in --dim dimensions (default: what the shear term brings along, with --column what damps sound; waves of sound need it)")
    parser.add_argument("--units", choices=BOLTZMANN, help="without --fluid (default: lj)")
    parser.add_argument("--length", type=positive, help="of the flow; the box is as wide")
    parser.add_argument("--velocity", type=positive, help=f"the largest of the flow, or of the wave (default: {SOUND_MACH:g} of the speed of sound)")
    parser.add_argument("--wavelength", type=positive, help="sound of this wavelength")
    parser.add_argument("--frequency", type=positive, help="sound of this frequency")
    parser.add_argument("--column", type=positive, metavar="H", help="a column of this height at one end of a tank, with a free surface: a dam break")
    parser.add_argument("--width", type=positive, help="of the column (default: twice the height)")
    parser.add_argument("--tank", type=positive, help=f"length of the tank (default: {TANK} of the height); as long as the column: a tank at rest")
    parser.add_argument("--colloid", type=positive, metavar="R", help="a sphere of this radius in a fluid with noise of --temperature, in three dimensions")
    parser.add_argument("--gravity", type=positive, help="(default: 9.81, or 1 with units lj)")
    parser.add_argument("--channel", type=positive, metavar="H", help="a channel of this height between two walls, with the largest velocity --velocity")
    parser.add_argument("--yield", type=positive, metavar="TAU", dest="yield_stress", help="yield stress of the fluid in a channel, a Bingham fluid")
    parser.add_argument("--relax", action="store_true", help="bulk viscosity that relaxes (default: for sound above the frequency up to which a constant holds)")
    parser.add_argument("--c", type=sound_speed, help="speed of sound of the particles, or the word real: a wave of sound (default: ten times the velocity)")
    parser.add_argument("--dim", type=int, choices=(2, 3), help="dimensions (default: 2, with --colloid 3)")
    parser.add_argument("--particles", type=int, metavar="N", help="across the length (default: 50, with --colloid 12)")
    parser.add_argument("--support", type=positive, help="support radius over particle distance (default: 3 with mg/fr2 and for a colloid, else 4, for sound 6)")
    parser.add_argument("--kernel", choices=STABILITY, metavar="NAME", help="(default: wendland/c2, for sound wendland/c6, for a channel quintic)")
    parser.add_argument("--shear", choices=SHEAR, metavar="FORM", help="form of the shear term (default: mg/fr2; mg with noise, a free surface, or sound)")
    parser.add_argument("--temperature", type=not_negative, metavar="T", help="of thermal noise")
    parser.add_argument("--fraction", type=positive, help="time step over the largest stable one, without noise (default: 0.5, with --column 0.95)")
    parser.add_argument("--time", type=positive, help="to simulate (default: ten passages of the length)")
    parser.add_argument("--run", action="store_true", help="write the input in.NAME (another one there becomes in.NAME.1), run it, print what it measures beside theory, and keep log.NAME; NAME: sound, column, channel, colloid, or flow")
    parser.add_argument("--plot", action="store_true", help="... and draw what is measured beside theory: NAME.png")
    parser.add_argument("--lmp", type=Path, default=ROOT / "build" / "lmp", help="LAMMPS that is timed (default: build/lmp)")
    args = parser.parse_args(argv)
    for word in ("rho", "mu", "kappa") if args.fluid else ():
        if getattr(args, word) is not None:
            parser.error(f"--{word} cannot be given with --fluid: give one of them")
    if not args.fluid and args.rho is None:
        parser.error("give --fluid, or --rho" + (", --mu, --kappa, and --c" if args.wavelength or args.frequency else " and --mu"))
    if args.fluid and args.units:
        parser.error("--fluid is in SI units: leave --units out")
    if not args.fluid and args.mu is None:
        parser.error("--mu is missing")
    kind = "--column" if args.column else "--channel" if args.channel else "--colloid" if args.colloid else ""
    if kind:
        others = {"--length": args.length, "--wavelength": args.wavelength, "--frequency": args.frequency, "--relax": args.relax}
        others |= {"--velocity": args.velocity if kind != "--channel" else None, "--channel": args.channel if kind != "--channel" else None,
                   "--colloid": args.colloid if kind != "--colloid" else None, "--temperature": args.temperature if kind != "--colloid" else None,
                   "--dim 3": kind == "--channel" and args.dim == 3}
        for word, value in others.items():
            if value:
                parser.error(f"{word} is not for {kind}")
    if args.column:
        if args.shear in ("morris", "espanol"):
            parser.error(f"--shear {args.shear} is not for --column: it exerts a torque at a free surface")
        if args.c == "real":
            parser.error("--c real is not for --column, whose liquid is nearly incompressible")
        if args.tank and args.width and args.tank < args.width:
            parser.error("--tank is shorter than the column is wide")
        if args.tank and not args.width and args.tank < 2.01 * args.column:    # would be filled
            parser.error("--tank is not longer than the column is wide, 2 times --column: give --width, for water at rest that of --tank")
    elif args.width or args.tank or args.gravity:
        parser.error("--width, --tank, and --gravity are for --column")
    elif args.channel:
        if not args.velocity:
            parser.error("--channel needs --velocity, the largest one in the middle")
        if not args.mu and not args.fluid:
            parser.error("--channel needs a fluid with a shear viscosity")
        if args.c == "real":
            parser.error("--c real is not for --channel, whose flow is nearly incompressible")
        if args.yield_stress and args.shear not in (None, "mg", "mg/fr2"):
            parser.error(f"--yield is for --shear mg and mg/fr2, not {args.shear}")
    elif args.colloid:
        if args.dim == 2:
            parser.error("--dim 2 is not for --colloid; the page Howto_sph_bodies has the input of a disc, \"A colloid\"")
        args.dim = 3
        if not args.temperature or args.mu == 0.0:
            parser.error("--colloid needs --temperature above 0, and a fluid with a shear viscosity")
        if args.c == "real":
            parser.error("--c real is not for --colloid, whose fluid is nearly incompressible")
    elif bool(args.wavelength) + bool(args.frequency) + (args.length is not None) != 1 or args.length and not args.velocity:
        parser.error("give --length and --velocity, or --wavelength, or --frequency, or --column, or --channel, or --colloid")
    if args.yield_stress and not args.channel:
        parser.error("--yield is for --channel")
    if args.plot and not (kind or args.wavelength or args.frequency or args.c == "real"):
        parser.error("--plot draws what a theory tells: it is for sound, --column, --channel, and --colloid")
    args.dim = args.dim or 2
    args.fraction = args.fraction or (0.95 if args.column else 0.5)
    if args.particles is not None and args.particles < 1:
        parser.error("--particles must be > 0")
    if args.fraction > 1.0:
        parser.error("--fraction must not be above 1")
    return args


def plan_of(args):
    return (Column if args.column else Channel if args.channel else Colloid if args.colloid else Plan)(args)


def printed(args):
    try:
        plan = plan_of(args)
        numbers = plan.input()
    except (ArithmeticError, ValueError):
        numbers = "nan"
    if re.search(r"\b(inf|nan)\b", numbers):
        raise SystemExit("plan: numbers as large or small as these are beyond what a computer calculates with; take other units")
    time = "run time            not measured, there is no LAMMPS at build/lmp; ./sphd build makes it"
    if plan.args.lmp.exists() and not (plan.args.lmp.is_file() and os.access(plan.args.lmp, os.X_OK)):
        raise SystemExit(f"plan: {plan.args.lmp} is no program that can be run")
    if plan.args.lmp.exists():
        time = "run time            not measured, a short run takes more than a minute on this machine"
        each = measured_time(plan, plan.args.lmp.resolve())
        if each is not None:
            time = f"run time            about {duration(each * plan.number * plan.steps)} of one core, from a short run on this machine"
    return plan.input(time), plan


def run(text, plan):
    """writes the input in the working folder, runs it, prints what it measures, and draws its figure"""
    name, lmp = plan.name, plan.args.lmp
    if not lmp.exists():
        raise SystemExit(f"plan: --run needs LAMMPS, and there is none at {lmp}; ./sphd build makes it")
    from . import pyplot, save, thermo
    importlib.import_module("numpy")    # what is missing is missed before the run
    plt = pyplot() if plan.args.plot else None
    file = Path(f"in.{name}")
    if file.exists() and file.read_text(encoding="utf-8").split("\n\n", 1)[1:] != text.split("\n\n", 1)[1:]:
        old = next(old for old in (Path(f"in.{name}.{k}") for k in itertools.count(1)) if not old.exists())
        file.rename(old)
        print(f"plan: {file} was another input; it is now {old}")
    file.write_text(text, encoding="utf-8")
    print(text.partition("\n\n")[0], flush=True)
    if subprocess.run([str(lmp.resolve()), "-in", str(file), "-log", f"log.{name}", "-nocite"], stdin=subprocess.DEVNULL, check=False).returncode:
        raise SystemExit(f"plan: LAMMPS has stopped with an error; the input is {file}")
    (table,) = thermo(Path(f"log.{name}").read_text(encoding="utf-8", errors="replace"))
    for line in plan.measured(table):
        print(f"plan: {line}")
    written = [str(file), f"log.{name}", f"{name}.dump"]
    if plan.args.plot:
        written.append(str(save(plan.figure(plt, table), f"{name}.png")))
    print(f"plan: wrote {', '.join(written)}")


def main(argv=None):
    args = arguments(argv)
    args.run = args.run or args.plot
    with program("plan"):
        text, plan = printed(args)
        if args.run:
            run(text, plan)
        else:
            print(text, end="")


if __name__ == "__main__":
    main()
