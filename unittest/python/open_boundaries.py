"""Channels with open ends for the tests of fix sph/open: particle sets, input text, accounts."""

import re

import numpy as np

from helpers import Particles

SPACING = {"sq": (1.0, 1.0), "hex": (np.sqrt(2 / np.sqrt(3)), np.sqrt(np.sqrt(3) / 2)),
           "hexrows": (np.sqrt(np.sqrt(3) / 2), np.sqrt(2 / np.sqrt(3)))}
SKIN = 0.53  # not a multiple of what a stream travels in a step: then lists are built in the same step on all processors


def frame(direction, dim=2):
    """Unit vectors: along the stream, across it, and across both."""
    along = np.zeros(3)
    along[:len(direction)] = direction
    along /= np.linalg.norm(along)
    across = np.array([-along[1], along[0], 0.0]) if dim == 2 or abs(along[2]) < 0.5 else np.array([1.0, 0.0, 0.0])
    across /= np.linalg.norm(across)
    return along, across, np.cross(along, across)


class Channel:
    """Fluid between two open planes at 0 and `length` along a direction, particles one spacing apart.

    kind: sq, hex with rows straight along the stream, hexrows with rows across it; box: "straight" (periodic
    across), "triclinic" (periodic across, at any angle), "walls" (solid on both sides), "free" (nothing)."""

    def __init__(self, length=16, width=8, zone=8.0, support=3.0, kind="sq", direction=(1, 0), dim=2, box="straight",
                 layers=3, start=0.25):
        self.length, self.zone, self.support, self.dim, self.box = float(length), zone, support, dim, box
        self.along, self.across, self.third = frame(direction, dim)
        b = self.pitch = np.array(SPACING[kind][:2]) if dim == 2 else np.ones(2)
        self.width = width * b[1] * (2 if kind != "sq" else 1) / (2 if kind != "sq" else 1)
        count = int(np.ceil((self.length + 2 * zone) / b[0])) + 2
        s = (np.arange(count) + start) * b[0] - np.ceil(zone / b[0]) * b[0]
        t = np.arange(width + (2 * layers if box == "walls" else 0)) + 0.5 - (layers if box == "walls" else 0)
        grid = np.stack(np.meshgrid(s, t, indexing="ij"), axis=-1).reshape(-1, 2)
        row = np.floor(grid[:, 1]).astype(int) if kind == "hex" else np.round((grid[:, 0] - s[0]) / b[0]).astype(int)
        if kind == "hex":
            grid[:, 0] += 0.5 * b[0] * (row % 2)
        if kind == "hexrows":
            grid[:, 1] += 0.5 * (row % 2)
        grid[:, 1] *= b[1]
        levels = np.arange(width) + 0.5 if dim == 3 else np.zeros(1)
        self.place = np.concatenate([np.column_stack([grid, np.full(len(grid), z)]) for z in levels])
        inside = (self.place[:, 0] > -zone) & (self.place[:, 0] < self.length + zone)
        self.place = self.place[inside]
        solid = (self.place[:, 1] < 0.0) | (self.place[:, 1] > self.width)
        part = np.where(solid, 3, np.where(self.place[:, 0] < 0.0, 0, np.where(self.place[:, 0] > self.length, 2, 1)))
        order = np.argsort(part, kind="stable")
        self.place, self.part = self.place[order], part[order]

    def x(self, place):
        return place @ np.array([self.along, self.across, self.third])

    def particles(self, velocity=None, mass=1.0, esph=0.0):
        x = self.x(self.place)
        number = len(x)
        lo, hi, tilt = np.full(3, -0.5), np.full(3, 0.5), None
        ends = np.array([-self.zone - 2.0, self.length + self.zone + 2.0])
        if self.box == "triclinic":
            cos, sin = self.along[0], -self.along[1]
            lo[:2], hi[:2] = (ends[0] / cos, 0.0), (ends[1] / cos, self.width * cos)
            tilt = (self.width * sin, 0.0, 0.0)
            x = x - self.width * np.array([sin, cos, 0.0]) * np.floor(x[:, 1:2] / hi[1])
        elif self.box == "straight":
            axis = int(np.argmax(np.abs(self.along)))
            corners = np.sort(ends * self.along[axis])
            for d in range(self.dim):
                lo[d], hi[d] = 0.0, self.width
            lo[axis], hi[axis] = corners
            for d in range(self.dim):
                if d != axis:
                    x[:, d] -= self.width * np.floor(x[:, d] / self.width)
        else:
            lo[:self.dim], hi[:self.dim] = x.min(axis=0)[:self.dim] - 4.0, x.max(axis=0)[:self.dim] + 4.0
        v = np.zeros((number, 3)) if velocity is None else velocity(self.place)
        return Particles(self.dim, x, v @ np.array([self.along, self.across, self.third]), np.full(number, mass),
                         np.full(number, esph), np.ones(number, dtype=int), lo, hi, tilt)

    @property
    def boundary(self):
        if self.box in ("walls", "free"):
            return "f f p" if self.dim == 2 else "f f f"
        if self.box == "triclinic":
            return "f p p"
        return " ".join("f" if d == int(np.argmax(np.abs(self.along))) else "p" for d in range(3))

    def groups(self):
        names = ("in", "fluid", "out", "wall")
        ids = np.arange(1, len(self.part) + 1)
        return "".join(f"group {name} id {ids[self.part == k][0]}:{ids[self.part == k][-1]}\n"
                       for k, name in enumerate(names) if (self.part == k).any())

    def vector(self, u, v=0.0, w=0.0):
        return " ".join(repr(float(c)) for c in u * self.along + v * self.across + w * self.third)

    def plane(self, end):
        """Arguments of fix sph/open up to its keywords."""
        sign, s = (1.0, 0.0) if end == "in" else (-1.0, self.length)
        numbers = [*(s * self.along), *(sign * self.along), self.zone]
        return f"{end} sph/open fluid " + " ".join(repr(float(c)) for c in numbers)

    def text(self, lammps, inlet, outlet, velocity=None, coeff="1.0 1.0 0.1 0.2 {R}", style="sph/bulk", options="",
             newton="on", integrate="density rho0", timestep=0.3, name="box.data", wall="slip free", before="",
             esph=0.0, mass=1.0, spin=0.0, after_read=""):
        write(self.particles(velocity, mass, esph), lammps.path(name), style, spin)
        walls = f"fix W wall sph/wall {wall}\n" if self.box == "walls" else ""
        return (f"units lj\ndimension {self.dim}\nboundary {self.boundary}\nnewton {newton}\natom_style {style}\n{before}"
                f"read_data {name}\n{self.groups()}{after_read}pair_style {style} {options}\n"
                f"pair_coeff * * {coeff.format(R=self.support)}\nneighbor {SKIN} bin\n{walls}"
                f"fix 1 fluid {style} {integrate}\nfix in {self.plane('in')} {inlet}\nfix out {self.plane('out')} {outlet}\n"
                f"timestep {timestep}\nthermo_modify norm no format float %.17g\n")


def write(particles, path, style, spin):
    """A data file, for sph/micropolar with the same spin for all particles and no moment of inertia."""
    particles.write(path)
    if style == "sph/bulk":
        return
    head, atoms, velocities = re.split(r"Atoms.*\n\n|\nVelocities\n\n", path.read_text())
    lines = [line.split() for line in atoms.splitlines() if line]
    path.write_text(head + f"Atoms # {style}\n\n" + "".join(" ".join(w[:3] + ["0.0"] + w[3:]) + "\n" for w in lines)
                    + "\nVelocities\n\n" + "".join(f"{line} 0.0 0.0 {spin}\n" for line in velocities.splitlines()))


def dump(name, every, fields=""):
    return (f"compute RHO all property/atom rho\ndump D all custom {every} {name} id x y z xu yu zu vx vy vz mass c_RHO {fields}\n"
            "dump_modify D sort id format float %.17g\n")


# ---------------------------------------------------------------------------------------------
# accounts: names of the vector of the fix

ENTRIES = ["n", "m", "px", "py", "pz", "lx", "ly", "lz", "ke", "e"]
IN = {name: k + 1 for k, name in enumerate(ENTRIES)}
OUT = {name: k + 11 for k, name in enumerate(ENTRIES)}
IMPULSE = {name: k + 21 for k, name in enumerate(["px", "py", "pz", "lx", "ly", "lz", "work"])}


def columns(*fixes, entries=28):
    return " ".join(f"f_{name}[{k}]" for name in fixes for k in range(1, entries + 1))


def account(table, name, fixes=("in", "out")):
    """What the zones say has come to the fluid of a total: carried in less carried out plus impulse."""
    total = 0.0
    for fix in fixes:
        total = total + table[f"f_{fix}[{IN[name]}]"] - table[f"f_{fix}[{OUT[name]}]"]
        if name in IMPULSE:
            total = total + table[f"f_{fix}[{IMPULSE[name]}]"]
    return total


def errors(result):
    return re.sub(r"\s+", " ", result.error)
