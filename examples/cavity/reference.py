#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The lid-driven cavity of an incompressible micropolar fluid by finite differences.

Unknowns are the streamfunction psi, the vorticity w and the spin W (microrotation), all of second order
in space on a grid that is finer at the walls, Newton's method with a sparse direct solver, steady or in
time (BDF2).  Unit square, lid velocity 1, density 1:

    laplace psi = -w,   u = psi_y,   v = -psi_x
    Dw/Dt   = (mu + mu_r) laplace w - 2 mu_r laplace W
    I DW/Dt = -2 mu_r (2 W - w) + gamma1 laplace W

Walls: no slip; W = 0 if gamma1 > 0.  With gamma1 = 0 the wall has no say in W, and with I = 0 as well
W = w/2: the fluid is Newtonian with the viscosity mu.

    python3 reference.py              order of convergence, comparison with the table of Ghia, Ghia and Shin
    python3 reference.py --check      the same; exit with 1 if a figure of merit is missed
    python3 reference.py --write      the reference curves of this example (*.csv), half an hour
"""

import argparse
import csv
import sys
import time
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline, RectBivariateSpline
from scipy.sparse import bmat, csr_matrix, diags, identity, kron
from scipy.sparse.linalg import splu

HERE = Path(__file__).resolve().parent
STRETCH = 0.8       # spacing at the walls: 1 - STRETCH times the mean, in the middle 1 + STRETCH

# name: mu, mu_r, gamma1, I.  Eringen's mu_E = 1/400 and K = kappa_E/mu_E = 3 are mu = mu_E + kappa_E/2, mu_r = kappa_E/2
CASES = {
    "re100": (1 / 100, 0.0, 0.0, 0.0),
    "re400": (1 / 400, 0.0, 0.0, 0.0),
    "re1000": (1 / 1000, 0.0, 0.0, 0.0),
    "k3": (2.5 / 400, 1.5 / 400, 2.5 / 400, 1.0),
    "re160": (2.5 / 400, 0.0, 0.0, 0.0),
}
END = {"re100": 30.0, "re400": 60.0, "re1000": 80.0, "k3": 60.0, "re160": 40.0}
INNER = (0.1, 0.9)      # the stress on the lid is like 1/distance at its corners


class Cavity:
    """n x n cells; fields are arrays [y, x] of (n + 1)^2 nodes."""

    def __init__(self, n, mu, mu_r=0.0, gamma1=0.0, inertia=0.0, lid=1.0):
        self.n, self.mu, self.mu_r, self.gamma1, self.inertia = n, mu, mu_r, gamma1, inertia
        self.micropolar = mu_r > 0
        h = 1 / n
        s = np.arange(n + 1) * h
        self.s = s
        self.x = s - STRETCH * np.sin(2 * np.pi * s) / (2 * np.pi)
        slope = 1 - STRETCH * np.cos(2 * np.pi * s)
        half = 1 - STRETCH * np.cos(2 * np.pi * (s[:-1] + 0.5 * h))
        self.weight = slope * h
        self.weight[[0, -1]] *= 0.5
        inside = np.ones(n + 1)
        inside[[0, -1]] = 0
        first = diags([-0.5 / h / slope[1:], 0.5 / h / slope[:-1]], [-1, 1])
        left, right = np.append(0, 1 / half) / (slope * h * h), np.append(1 / half, 0) / (slope * h * h)
        second = diags([left[1:], -(left + right), right[:-1]], [-1, 0, 1])
        one = identity(n + 1)
        self.dx, self.dy = kron(one, first).tocsr(), kron(first, one).tocsr()
        self.laplace = (kron(one, second) + kron(second, one)).tocsr()
        fluid = np.outer(inside, inside).ravel()
        self.fluid = diags(fluid)
        corner = np.outer(1 - inside, 1 - inside).ravel()
        self.wall = diags(1 - fluid)
        self.corner = diags(corner)
        self.lid = lid(self.x) if callable(lid) else np.full(n + 1, lid)
        top = np.zeros((n + 1, n + 1))
        top[-1, 1:-1] = self.lid[1:-1]
        # vorticity of the wall: the laplacian there, psi of a ghost node from the velocity of the wall (Thom)
        factor = 2 / (slope[0] * half[0] * h * h)
        size = (n + 1) ** 2
        index = np.arange(size).reshape(n + 1, n + 1)
        rows, columns = [], []
        for edge, neighbor in ((index[0, 1:-1], index[1, 1:-1]), (index[-1, 1:-1], index[-2, 1:-1]),
                               (index[1:-1, 0], index[1:-1, 1]), (index[1:-1, -1], index[1:-1, -2])):
            rows.append(edge)
            columns.append(neighbor)
        rows, columns = np.concatenate(rows), np.concatenate(columns)
        self.thom = csr_matrix((np.full(len(rows), factor), (rows, columns)), (size, size))
        self.thom_lid = (factor * h * slope[0] * top).ravel()
        self.size = size
        self.source = None          # for the check with a manufactured solution: of w and W
        self.spin_wall = None

    def step(self, fields, old=None, older=None, dt=None, tolerance=1e-10):
        """Newton's method for the steady state, or for one time step."""
        f = fields.copy()
        count = 3 if self.micropolar else 2
        nu = self.mu + self.mu_r
        for _ in range(30):
            psi, w, spin = f
            u, v = self.dy @ psi, -(self.dx @ psi)
            advect = diags(u) @ self.dx + diags(v) @ self.dy
            rate, change = 0.0, np.zeros_like(f)
            if dt:
                if older is None:
                    rate, change = 1 / dt, -old / dt
                else:
                    rate, change = 1.5 / dt, (-2 * old + 0.5 * older) / dt

            def lap(a):
                return self.laplace @ a

            def carried(a):     # what a change of psi carries
                return diags(self.dx @ a) @ self.dy - diags(self.dy @ a) @ self.dx

            r_psi = self.fluid @ (lap(psi) + w) + self.wall @ psi
            r_w = self.fluid @ (rate * w + change[1] + advect @ w - nu * lap(w) + 2 * self.mu_r * lap(spin))
            if self.source is not None:
                r_w -= self.fluid @ self.source[0]
            r_w += self.wall @ w + self.thom @ psi + self.thom_lid
            blocks = [[self.fluid @ self.laplace + self.wall, self.fluid],
                      [self.fluid @ carried(w) + self.thom,
                       self.fluid @ (rate * identity(self.size) + advect - nu * self.laplace) + self.wall]]
            residual = [r_psi, r_w]
            if self.micropolar:
                inertia = self.inertia
                r_s = self.fluid @ (inertia * (rate * spin + change[2] + advect @ spin) + 2 * self.mu_r * (2 * spin - w) - self.gamma1 * lap(spin))
                if self.source is not None:
                    r_s -= self.fluid @ self.source[1]
                b_psi = self.fluid @ (inertia * carried(spin))
                b_w = self.fluid * (-2 * self.mu_r)
                b_s = self.fluid @ (inertia * (rate * identity(self.size) + advect) + 4 * self.mu_r * identity(self.size)
                                    - self.gamma1 * self.laplace)
                if self.gamma1 > 0:
                    r_s += self.wall @ spin
                    b_s = b_s + self.wall
                else:
                    r_s += self.wall @ (2 * spin - w)
                    b_w, b_s = b_w - self.wall, b_s + 2 * self.wall
                residual.append(r_s)
                blocks[0].append(None)
                blocks[1].append(self.fluid @ (2 * self.mu_r * self.laplace))
                blocks.append([b_psi, b_w, b_s])
            delta = splu(bmat(blocks, format="csc")).solve(-np.concatenate(residual)).reshape(count, -1)
            f[:count] += delta
            if np.abs(delta[0]).max() < tolerance * np.abs(f[0]).max():
                break
        else:
            raise RuntimeError("Newton's method has not converged")
        if not self.micropolar:
            f[2] = 0.5 * f[1]
        return f

    def rest(self):
        return np.zeros((3, self.size))

    def steady(self, start=None):
        """From a given state, or from rest with the viscosities lowered step by step."""
        if start is not None:
            self.keep(self.step(start))
            return self
        mu, mu_r, gamma1 = self.mu, self.mu_r, self.gamma1
        f = self.rest()
        for factor in [2.0**k for k in range(10, -1, -1) if mu * 2.0**k < 0.02] or [1.0]:
            self.mu, self.mu_r, self.gamma1 = mu * factor, mu_r * factor, gamma1 * factor
            f = self.step(f)
        self.keep(f)
        return self

    def transient(self, end, dt):
        """From rest; the kinetic energy over time."""
        old, older, t = self.rest(), None, [0.0]
        energy = [0.0]
        while t[-1] < end - 0.5 * dt:
            f = self.step(2 * old - older if older is not None else old, old, older, dt, 1e-6)
            old, older = f, old
            self.keep(f)
            t.append(t[-1] + dt)
            energy.append(self.energy())
        return np.array(t), np.array(energy)

    def keep(self, f):
        shape = (self.n + 1, self.n + 1)
        self.fields = f
        self.psi, self.w, self.spin = (a.reshape(shape) for a in f)
        self.u, self.v = (self.dy @ f[0]).reshape(shape), -(self.dx @ f[0]).reshape(shape)
        for a in (self.u, self.v):
            a[[0, -1]] = 0
            a[:, [0, -1]] = 0
        self.u[-1] = self.lid

    def energy(self):
        return 0.5 * self.weight @ (self.u**2 + self.v**2) @ self.weight

    def at(self, field, x, y):
        return RectBivariateSpline(self.x, self.x, field, s=0)(y, x)

    def profiles(self, s):
        """u and spin along x = 1/2, v along y = 1/2."""
        return self.at(self.u, 0.5, s)[:, 0], self.at(self.v, s, 0.5)[0], self.at(self.spin, 0.5, s)[:, 0]

    def lid_stress(self):
        """Shear stress at the lid, with which the fluid holds it back."""
        return -(self.mu + self.mu_r) * self.w[-1] + 2 * self.mu_r * self.spin[-1]

    def lid_force(self, a=INNER[0], b=INNER[1]):
        stress = self.lid_stress()[1:-1]
        return CubicSpline(self.x[1:-1], stress).integrate(a, b)

    def vortex(self):
        """Extremum of psi: value, x, y, vorticity."""
        j, i = np.unravel_index(np.abs(self.psi).argmax(), self.psi.shape)
        spline = RectBivariateSpline(self.x, self.x, self.psi, s=0)
        y, x = self.x[j], self.x[i]
        for _ in range(20):
            g = np.array([spline.ev(y, x, dx=1), spline.ev(y, x, dy=1)])
            h = np.array([[spline.ev(y, x, dx=2), spline.ev(y, x, dx=1, dy=1)],
                          [spline.ev(y, x, dx=1, dy=1), spline.ev(y, x, dy=2)]])
            y, x = np.array([y, x]) - np.linalg.solve(h, g)
        return float(spline.ev(y, x)), x, y, self.at(self.w, x, y)[0, 0]


def ghia(re):
    """(y, u), (x, v) of Ghia, Ghia and Shin (1982), without the value that is off its column."""
    lines = [line for line in (HERE / "ghia1982.csv").read_text().splitlines() if not line.startswith("#")]
    columns = np.genfromtxt(lines, delimiter=",", names=True)[::-1]
    use = np.isfinite(columns[f"v_re{re}"])
    return (columns["y"], columns[f"u_re{re}"]), (columns["x"][use], columns[f"v_re{re}"][use])


def deviation(profile_u, profile_v, re):
    """Root mean square over both profiles, and the largest; without the ends, which are the walls."""
    (y, u), (x, v) = ghia(re)
    differences = np.concatenate([profile_u(y[1:-1]) - u[1:-1], profile_v(x[1:-1]) - v[1:-1]])
    return np.sqrt((differences**2).mean()), np.abs(differences).max()


def manufactured(n):
    """Largest error of psi, w and W for given fields and the sources that belong to them (all terms in use)."""
    mu, mu_r, gamma1, inertia = 0.02, 0.03, 0.05, 0.7
    p = np.polynomial.Polynomial
    a, b = 16 * p([0, 0, 1, -2, 1]), p([0, 0, -1, 1])       # of x: both ends at rest; of y: moves at y = 1
    c, d = p([0, 1, -1]), p([0, 2, -1, -1])                 # of the spin

    def at(x, y, terms):
        """Sum of the terms (f, k, g, l): f^(k)(x) g^(l)(y)."""
        return sum(s * np.outer(g.deriv(m)(y) if m else g(y), f.deriv(k)(x) if k else f(x)) for s, f, k, g, m in terms)

    cavity = Cavity(n, mu, mu_r, gamma1, inertia, lid=lambda x: a(x) * b.deriv()(1.0))
    x = cavity.x
    psi, u, v = at(x, x, [(1, a, 0, b, 0)]), at(x, x, [(1, a, 0, b, 1)]), at(x, x, [(-1, a, 1, b, 0)])
    w = [(-1, a, 2, b, 0), (-1, a, 0, b, 2)]
    spin = [(1, c, 0, d, 0)]

    def derived(terms, k, m):
        return at(x, x, [(s, f, i + k, g, j + m) for s, f, i, g, j in terms])

    def laplace(terms):
        return derived(terms, 2, 0) + derived(terms, 0, 2)

    cavity.source = [(u * derived(w, 1, 0) + v * derived(w, 0, 1) - (mu + mu_r) * laplace(w) + 2 * mu_r * laplace(spin)).ravel(),
                     (inertia * (u * derived(spin, 1, 0) + v * derived(spin, 0, 1)) + 2 * mu_r * (2 * at(x, x, spin) - at(x, x, w))
                      - gamma1 * laplace(spin)).ravel()]
    cavity.keep(cavity.step(cavity.rest()))
    inner = slice(1, -1)
    return [np.abs(found - exact)[inner, inner].max() / np.abs(exact).max()
            for found, exact in ((cavity.psi, psi), (cavity.w, at(x, x, w)), (cavity.spin, at(x, x, spin)))]


def orders(values):
    return [np.log2((b - a) / (c - b)) for a, b, c in zip(values, values[1:], values[2:])]


def extrapolated(coarse, fine):
    """Of second order, from n/2 and n cells."""
    return fine + (fine - coarse) / 3


class Reference:
    """Steady state of one case from n/2 and n cells, extrapolated; `error` is a third of the difference."""

    def __init__(self, name, n):
        pair = [Cavity(m, *CASES[name]).steady() for m in (n // 2, n)]
        self.fine = pair[1]
        self.s = np.linspace(0, 1, 201)
        self.profiles = extrapolated(*(np.array(c.profiles(self.s)) for c in pair))
        self.grid = np.linspace(0, 1, 51)
        self.psi = extrapolated(*(c.at(c.psi, self.grid, self.grid) for c in pair))
        self.lid_x = np.linspace(0.01, 0.99, 197)
        self.lid = extrapolated(*(CubicSpline(c.x[1:-1], c.lid_stress()[1:-1])(self.lid_x) for c in pair))
        numbers = [np.array([c.energy(), c.lid_force(), c.lid_force(0.02, 0.98), *c.vortex()]) for c in pair]
        self.numbers = extrapolated(*numbers)
        self.error = np.abs(self.numbers - numbers[1])


def check(missed):
    def merit(what, value, lower, upper):
        ok = lower <= value <= upper
        line = f"{what}: {value:.4g}, wanted {lower:.4g} to {upper:.4g}"
        print(line + ("  ok" if ok else "  MISSED"))
        if not ok:
            missed.append(line)

    print("manufactured micropolar solution, n = 16, 32, 64: relative errors of psi, w, W")
    errors = np.array([manufactured(n) for n in (16, 32, 64)])
    for n, row in zip((16, 32, 64), errors):
        print(f"  n = {n}: " + ", ".join(f"{value:.2e}" for value in row))
    for name, order in zip(("psi", "w", "W"), np.log2(errors[1] / errors[2])):
        merit(f"order of convergence of {name}, all terms", order, 1.9, 2.2)

    # the table has errors of its own: the extrema of v at Re = 100 and 1000 are 0.008 and 0.012 from those of spectral solutions
    for re, limit, largest in ((100, 0.006, 0.012), (400, 0.004, 0.009), (1000, 0.01, 0.025)):
        print(f"\nRe = {re}, K = 0")
        mu = 1 / re
        ladder = [Cavity(n, mu).steady() for n in (24, 48, 96)]
        for cavity in ladder:
            rms, most = deviation(lambda y: cavity.at(cavity.u, 0.5, y)[:, 0], lambda x: cavity.at(cavity.v, x, 0.5)[0], re)
            psi, x, y, w = cavity.vortex()
            print(f"  n = {cavity.n}: deviation from Ghia rms {rms:.4f}, max {most:.4f}; kinetic energy {cavity.energy():.6f}, "
                  f"vortex psi {psi:.6f}, w {w:.5f} at {x:.4f}, {y:.4f}; lid {cavity.lid_force():.6f}")
        # the table lists points: what the extrapolated solution has there
        pair = ladder[-2:]
        rms, most = deviation(lambda y: extrapolated(*(c.at(c.u, 0.5, y)[:, 0] for c in pair)),
                              lambda x: extrapolated(*(c.at(c.v, x, 0.5)[0] for c in pair)), re)
        merit("extrapolated profiles against Ghia, rms", rms, 0, limit)
        merit("extrapolated profiles against Ghia, largest", most, 0, largest)
        merit("order of the kinetic energy", orders([c.energy() for c in ladder])[0], 1.5, 3.0)
        merit("order of the vortex's psi", orders([c.vortex()[0] for c in ladder])[0], 1.5, 3.0)
        if re == 1000:
            fine = np.linspace(0, 1, 2001)
            u = extrapolated(*(c.at(c.u, 0.5, fine)[:, 0] for c in pair))
            v = extrapolated(*(c.at(c.v, fine, 0.5)[0] for c in pair))
            for what, value, spectral in (("psi of the vortex", extrapolated(*(c.vortex()[0] for c in pair)), -0.1189366),
                                          ("smallest u", u.min(), -0.3885698), ("largest v", v.max(), 0.3769447),
                                          ("smallest v", v.min(), -0.5270771)):
                merit(f"{what} over that of Botella and Peyret (1998), {spectral}, minus 1", abs(value / spectral - 1), 0, 0.01)

    print("\nmicropolar, K = 3")
    ladder = [Cavity(n, *CASES["k3"]).steady() for n in (24, 48, 96)]
    for cavity in ladder:
        psi, x, y, w = cavity.vortex()
        print(f"  n = {cavity.n}: kinetic energy {cavity.energy():.6f}, vortex psi {psi:.6f}, w {w:.5f} at {x:.4f}, {y:.4f}; "
              f"lid {cavity.lid_force():.6f}")
    merit("order of the kinetic energy", orders([c.energy() for c in ladder])[0], 1.5, 3.0)
    merit("order of the force on the inner lid", orders([c.lid_force() for c in ladder])[0], 1.0, 3.0)
    mu, mu_r = CASES["k3"][:2]
    with_spin, newtonian = Cavity(48, mu, mu_r).steady(), Cavity(48, mu).steady()
    merit("no spin diffusion, no inertia, minus the Newtonian cavity at Re = 160: largest difference of u",
          np.abs(with_spin.u - newtonian.u).max(), 0, 1e-8)
    return missed


def young_spin(s, end=10.0, n=64):
    """Spin along x = 1/2 in the case k3 at a time before it is steady."""
    pair = [Cavity(m, *CASES["k3"]) for m in (n // 2, n)]
    for cavity in pair:
        cavity.transient(end, 0.1)
    return extrapolated(*(cavity.profiles(s)[2] for cavity in pair))


def write(n, transient):
    with open(HERE / "reference.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", "mu", "mu_r", "gamma1", "I", "kinetic_energy", "lid_0.1_0.9", "lid_0.02_0.98", "psi", "x", "y", "w", "error_kinetic_energy", "error_lid_0.1_0.9"])
        profiles, lids, psis, header = [], [], [], ["s"]
        for name, numbers in CASES.items():
            begin = time.monotonic()
            reference = Reference(name, n)
            writer.writerow([name, *numbers, *(f"{value:.6f}" for value in reference.numbers), *(f"{value:.1e}" for value in reference.error[:2])])
            u, v, spin = reference.profiles
            columns = {"u": u, "v": v, **({"spin": spin} if name == "k3" else {})}
            profiles += columns.values()
            header += [f"{key}_{name}" for key in columns]
            lids.append(reference.lid)
            psis.append(reference.psi)
            print(f"{name}: {reference.numbers}, error {reference.error}, {time.monotonic() - begin:.0f} s", flush=True)
    # the spin diffuses slowly: what it is at t = 10
    profiles.append(young_spin(reference.s))
    header.append("spin_k3_10")
    save = {"delimiter": ",", "fmt": "%.6g", "comments": ""}
    np.savetxt(HERE / "reference_profiles.csv", np.column_stack([reference.s, *profiles]), header=",".join(header), **save)
    np.savetxt(HERE / "reference_lid.csv", np.column_stack([reference.lid_x, *lids]), header=",".join(["x", *CASES]), **save)
    x, y = np.meshgrid(reference.grid, reference.grid)
    np.savetxt(HERE / "reference_psi.csv", np.column_stack([x.ravel(), y.ravel(), *(psi.ravel() for psi in psis)]),
               delimiter=",", fmt="%.4g", comments="", header=",".join(["x", "y", *CASES]))
    dt, rows = 0.1, {}
    for name in CASES:
        begin = time.monotonic()
        curves = [Cavity(m, *CASES[name]).transient(END[name], dt) for m in (transient // 2, transient)]
        rows[name] = extrapolated(curves[0][1], curves[1][1])
        print(f"{name}: kinetic energy {rows[name][-1]:.6f} at {END[name]}, {time.monotonic() - begin:.0f} s", flush=True)
    length = max(len(row) for row in rows.values())
    table = np.full((length, len(rows) + 1), np.nan)
    table[:, 0] = dt * np.arange(length)
    for k, row in enumerate(rows.values(), 1):
        table[:len(row), k] = row
    np.savetxt(HERE / "reference_energy.csv", table[::2], header=",".join(["t", *rows]), **save)


def main():
    parser = argparse.ArgumentParser(description="Finite differences for the lid-driven cavity.")
    parser.add_argument("--check", action="store_true", help="exit with 1 if a figure of merit is missed")
    parser.add_argument("--write", action="store_true", help="compute the reference curves of this example")
    args = parser.parse_args()
    if args.write:
        write(256, 80)
        return 0
    missed = check([])
    if missed:
        print("\n  ".join(["missed:", *missed]))
    return 1 if args.check and missed else 0


if __name__ == "__main__":
    sys.exit(main())
