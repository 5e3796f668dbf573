#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Incompressible flow past a cylinder between free-slip sides by finite elements: what particles in the same domain should find.

    python3 reference.py --check        the wide domain against published values, on a coarse mesh
    python3 reference.py --write        all of them, into reference.csv (about half an hour)

Biquadratic velocities and bilinear pressure on quadrilaterals between the circle and the rectangle. Diameter, density and the
velocity at the inlet are 1; the outlet is free of traction. Steady flow by Newton's method; in time by backward differences of
second order, with the convection extrapolated.
"""

import argparse
import csv
import sys
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

HERE = Path(__file__).resolve().parent
GAUSS = np.array([-np.sqrt(0.6), 0.0, np.sqrt(0.6)]), np.array([5.0, 8.0, 5.0]) / 9
# name: width, distance of the inlet and of the outlet from the axis
DOMAINS = {"particles": (12.0, 6.0, 10.0), "wide": (120.0, 60.0, 60.0), "small": (8.0, 4.0, 6.0)}
MESH = {"fine": (96, 56), "coarse": (64, 36)}      # elements around and away from the circle
# duration and kick of the vortex streets on the coarse mesh: until they are periodic
STREETS = {"particles": (100.0, 0.2), "wide": (75.0, 0.5), "small": (45.0, 0.5)}
STEP = 0.01


def quadratic(s):
    return np.stack([s * (s - 1) / 2, 1 - s * s, s * (s + 1) / 2]), np.stack([s - 0.5, -2 * s, s + 0.5])


def linear(s):
    return np.stack([(1 - s) / 2, (1 + s) / 2])


class Mesh:
    """Elements in rings around the circle; the outermost ends at the rectangle. Node (i, j) has the number j around + i."""

    def __init__(self, domain, size):
        width, up, down = domain
        n, m = size
        right, left = n * 3 // 8 // 2 * 2, n // 8 // 2 * 2
        side = (n - right - left) // 2
        # corners of the rectangle, counterclockwise from the lower right one, and where their rays leave the circle
        corners = np.array([(down, -width / 2), (down, width / 2), (-up, width / 2), (-up, -width / 2), (down, -width / 2)])
        angles = np.radians([-65.0, 65.0, 140.0, 220.0, 295.0])
        outer, angle = [], []
        for k, count in enumerate((right, side, left, side)):
            s = np.arange(2 * count) / (2 * count)
            # points closer to each other in the wake
            bent = 0.5 + (s - 0.5) * (0.25 + 3.0 * (s - 0.5)**2) if k == 0 else s
            outer.append(corners[k] + (corners[k + 1] - corners[k]) * bent[:, None])
            angle.append(angles[k] + (angles[k + 1] - angles[k]) * s)
        outer, angle = np.concatenate(outer), np.concatenate(angle)
        self.around, self.out = 2 * n, 2 * m + 1
        inner = 0.5 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        # thickness of the elements grows by the same factor outwards, from 0.02 at the circle
        low, high = 1.0, 2.0
        for _ in range(60):
            factor = 0.5 * (low + high)
            low, high = (factor, high) if 0.02 * (factor**m - 1) / (factor - 1) < max(up, down) else (low, factor)
        grown = (factor ** np.arange(m + 1) - 1) / (factor**m - 1)
        grown = np.interp(np.arange(self.out) / 2, np.arange(m + 1), grown)
        self.x = (inner + (outer - inner) * grown[:, None, None]).reshape(-1, 2)
        i, j = np.meshgrid(2 * np.arange(n), 2 * np.arange(m), indexing="ij")
        i, j = i.ravel(), j.ravel()
        self.q2 = np.stack([(j + b) * self.around + (i + a) % self.around for b in range(3) for a in range(3)], axis=1)
        self.q1 = np.stack([(j // 2 + b) * n + (i // 2 + a) % n for b in range(2) for a in range(2)], axis=1)
        self.nodes, self.pressures = self.around * self.out, n * (m + 1)
        self.circle = np.arange(self.around)
        edge = np.arange(self.around) + self.around * (self.out - 1)
        x, y = self.x[edge].T
        self.inlet = edge[np.isclose(x, -up)]
        self.sides = edge[np.isclose(np.abs(y), width / 2)]

        # shape functions and their derivatives in x and y at the points of quadrature
        a, b = (v.ravel() for v in np.meshgrid(GAUSS[0], GAUSS[0]))
        weight = np.outer(GAUSS[1], GAUSS[1]).ravel()
        (fa, da), (fb, db) = quadratic(a), quadratic(b)
        self.N = np.einsum("bq,aq->baq", fb, fa).reshape(9, -1)
        d = np.stack([np.einsum("bq,aq->baq", fb, da).reshape(9, -1), np.einsum("bq,aq->baq", db, fa).reshape(9, -1)])
        self.P = np.einsum("bq,aq->baq", linear(b), linear(a)).reshape(4, -1)
        jacobian = np.einsum("dkq,ekc->eqdc", d, self.x[self.q2])
        self.w = -np.linalg.det(jacobian) * weight      # i goes around, j outwards: left-handed
        assert self.w.min() > 0
        self.D = np.einsum("eqcd,dkq->ecqk", np.linalg.inv(jacobian), d)


class Flow:
    def __init__(self, Re, domain, size):
        self.mesh = mesh = Mesh(domain, size)
        self.nu = 1.0 / Re
        n = mesh.nodes
        self.size = 2 * n + mesh.pressures
        mass = np.einsum("eq,kq,lq->ekl", mesh.w, mesh.N, mesh.N, optimize=True)
        stiff = np.einsum("eq,ecqk,ecql->ekl", mesh.w, mesh.D, mesh.D, optimize=True)
        div = np.einsum("eq,ecqk,pq->ecpk", mesh.w, mesh.D, mesh.P, optimize=True)
        self.mass = self._square(mass, 0, 0) + self._square(mass, n, n)
        self.stiff = self._square(stiff, 0, 0) + self._square(stiff, n, n)
        b = sum(coo_matrix((-div[:, c].ravel(), ((2 * n + np.repeat(mesh.q1, 9, 1)).ravel(), (c * n + np.tile(mesh.q2, 4)).ravel())),
                           shape=(self.size, self.size)).tocsr() for c in range(2))
        self.stokes = self.nu * self.stiff + b + b.T
        fixed = np.concatenate([mesh.circle, n + mesh.circle, mesh.inlet, n + mesh.inlet, n + mesh.sides])
        self.free = np.setdiff1d(np.arange(self.size), fixed)
        self.start = np.zeros(self.size)
        self.start[:n] = 1.0
        self.start[mesh.circle] = 0.0

    def _square(self, local, row, column):
        q = self.mesh.q2
        return coo_matrix((local.ravel(), ((row + np.repeat(q, 9, 1)).ravel(), (column + np.tile(q, 9)).ravel())),
                          shape=(self.size, self.size)).tocsr()

    def _fields(self, state):
        mesh, n = self.mesh, self.mesh.nodes
        u = state[:2 * n].reshape(2, n)[:, mesh.q2]
        return np.einsum("cek,kq->ceq", u, mesh.N), np.einsum("cek,edqk->cdeq", u, mesh.D, optimize=True)

    def convection(self, state):
        """Weak form of (u grad) u."""
        mesh, n = self.mesh, self.mesh.nodes
        u, grad = self._fields(state)
        local = np.einsum("deq,cdeq,eq,kq->cek", u, grad, mesh.w, mesh.N, optimize=True)
        found = np.zeros(self.size)
        for c in range(2):
            found[:2 * n] += np.bincount((c * n + mesh.q2).ravel(), local[c].ravel(), 2 * n)
        return found

    def _tangent(self, state):
        mesh, n = self.mesh, self.mesh.nodes
        u, grad = self._fields(state)
        along = np.einsum("deq,edql,kq,eq->ekl", u, mesh.D, mesh.N, mesh.w, optimize=True)
        tangent = self._square(along, 0, 0) + self._square(along, n, n)
        for c in range(2):
            for d in range(2):
                local = np.einsum("eq,kq,lq,eq->ekl", grad[c, d], mesh.N, mesh.N, mesh.w, optimize=True)
                tangent = tangent + self._square(local, c * n, d * n)
        return tangent

    def force(self, residual):
        """Drag and lift coefficient from what is left of the momentum equation on the circle."""
        n = self.mesh.nodes
        return -2 * residual[self.mesh.circle].sum(), -2 * residual[n + self.mesh.circle].sum()

    def steady(self, start=None):
        """By Newton's method, near the end with the last tangent; start: the flow of another Reynolds number on this mesh."""
        state, near = (self.start if start is None else start).copy(), False
        for step in range(25):
            residual = self.stokes @ state + self.convection(state)
            if not near:
                lu = splu((self.stokes + self._tangent(state))[self.free][:, self.free].tocsc())
            change = lu.solve(residual[self.free])
            state[self.free] -= change
            near = np.abs(change).max() < 0.1
            if np.abs(change).max() < 1e-8:
                break
        else:
            raise RuntimeError("no steady flow found")
        return state, self.force(self.stokes @ state + self.convection(state))[0]

    def wake(self, state):
        """Length of the closed wake behind the cylinder: where the velocity on the axis changes sign."""
        mesh = self.mesh
        axis = np.argmin(np.abs(mesh.x[:mesh.around, 1]) + (mesh.x[:mesh.around, 0] < 0)) + mesh.around * np.arange(mesh.out)
        x, u = mesh.x[axis, 0], state[axis]
        k = np.flatnonzero((u[1:-1] < 0) & (u[2:] >= 0))[0] + 1
        return x[k] + (x[k + 1] - x[k]) * u[k] / (u[k] - u[k + 1]) - 0.5

    def unsteady(self, end, kick, dt=STEP):
        """Drag and lift over time; the cylinder is turned for a moment, which starts the vortex street."""
        old = now = self.start.copy()
        n, circle = self.mesh.nodes, self.mesh.circle
        first = splu((self.mass / dt + self.stokes)[self.free][:, self.free].tocsc())
        later = splu((1.5 * self.mass / dt + self.stokes)[self.free][:, self.free].tocsc())
        bent_old, found = None, []
        for step in range(1, round(end / dt) + 1):
            bent = self.convection(now)
            new = now.copy()
            turn = kick * np.sin(np.pi * step * dt / 2) if step * dt < 4 else 0.0
            new[circle], new[n + circle] = -turn * self.mesh.x[circle, 1], turn * self.mesh.x[circle, 0]
            new[2 * n:] = 0.0
            if step == 1:
                rest, factor, lu = self.mass @ now / dt - bent, 1.0, first
            else:
                rest, factor, lu = self.mass @ (2 * now - 0.5 * old) / dt - 2 * bent + bent_old, 1.5, later
            new[self.free] = 0.0
            held = factor / dt * (self.mass @ new) + self.stokes @ new
            new[self.free] = lu.solve((rest - held)[self.free])
            if step % 5 == 0:
                found.append((step * dt, *self.force(factor / dt * (self.mass @ new) + self.stokes @ new - rest)))
            old, now, bent_old = now, new, bent
        return np.array(found)


def shedding(t, drag, lift, span=30.0):
    """Mean drag, amplitude of the lift, and Strouhal number over the last whole periods of this span; noise does no harm."""
    late = t > t[-1] - span
    t, drag, lift = t[late], drag[late], lift[late] - lift[late].mean()
    # the frequency to which the lift fits best, under a bell that makes the ends of the span of no account
    bell = np.sin(np.pi * (t - t[0]) / (t[-1] - t[0]))**2
    tried = np.arange(0.1, 0.3, 1e-4)
    strouhal = tried[np.argmax(np.abs(np.exp(2j * np.pi * np.outer(tried, t)) @ (bell * lift)))]
    whole = t > t[-1] - np.floor((t[-1] - t[0]) * strouhal) / strouhal
    phase = 2 * np.pi * strouhal * t[whole]
    lift = np.linalg.lstsq(np.stack([np.cos(phase), np.sin(phase)], axis=1), lift[whole], rcond=None)[0]
    return drag[whole].mean(), np.hypot(*lift), strouhal


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="compute all and write reference.csv")
    parser.add_argument("--check", action="store_true", help="on the coarse mesh, against published values and reference.csv")
    args = parser.parse_args()
    if args.write:
        with open(HERE / "reference.csv", "w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["domain", "Re", "drag", "wake", "lift", "strouhal"])
            for name, domain in DOMAINS.items():
                for Re in (20, 40):
                    flow = Flow(Re, domain, MESH["fine"])
                    state, drag = flow.steady()
                    writer.writerow([name, Re, f"{drag:.5f}", f"{flow.wake(state):.5f}", "", ""])
                drag, lift, strouhal = shedding(*Flow(100, domain, MESH["coarse"]).unsteady(*STREETS[name]).T)
                writer.writerow([name, 100, f"{drag:.5f}", "", f"{lift:.5f}", f"{strouhal:.5f}"])
                file.flush()
    if not args.check:
        return 0
    with open(HERE / "reference.csv") as file:
        stored = {(row["domain"], int(row["Re"])): row for row in csv.DictReader(file)}
    wrong = False
    # Fornberg, J. Fluid Mech. 98, 819 (1980), in a wider domain yet
    states = {}
    for name, Re, drag, wake in (("wide", 20, 2.000, 0.91), ("wide", 40, 1.498, 2.24), ("small", 40, None, None)):
        flow = Flow(Re, DOMAINS[name], MESH["coarse"])
        state, found = flow.steady(states.get(name))
        states[name] = state
        length, row = flow.wake(state), stored[name, Re]
        good = abs(found / float(row["drag"]) - 1) < 1e-3 and abs(length / float(row["wake"]) - 1) < 2e-3
        if drag is not None:
            good = good and abs(found / drag - 1) < 0.015 and abs(length / wake - 1) < 0.015
        print(f"{name}, Re = {Re}: drag {found:.4f}, wake {length:.4f}; stored {row['drag']}, {row['wake']}; published {drag}, {wake}",
              "ok" if good else "WRONG")
        wrong = wrong or not good
    return wrong


if __name__ == "__main__":
    sys.exit(main())
