/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Thermal noise of the dense reference: one column per random number.

#include "dense_reference.h"

#include <cmath>

using namespace DenseReference;

System::Coefficients System::coefficients(const Pair &p, const std::string &form) const
{
  const Real weight = p.F * V(p.i) * V(p.j);
  if (has_spins(form)) {
    const PairViscosity visc = micropolar_viscosity(atoms.type[p.i], atoms.type[p.j]);
    return {weight * (central(p, form, visc) + visc.zeta2), weight * visc.zeta2, weight * (visc.xi1 + visc.xi2),
            weight * visc.xi2};
  }
  const SmallMatrix block = shear_block(p, form);
  const SmallVector e = p.r / p.dist;
  const Real along = e.dot(block * e);
  return {along, n > 1 ? (block.trace() - along) / (n - 1) : 0.0L, 0.0L, 0.0L};
}

static SmallVector cross(const SmallVector &a, const SmallVector &b)
{
  if (a.size() == 2) {
    SmallVector z(1);
    z(0) = a(0) * b(1) - a(1) * b(0);
    return z;
  }
  SmallVector c(3);
  c << a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0);
  return c;
}

Noise System::noise(const std::string &form, bool has_bulk, bool limited, Real kT) const
{
  const bool spins = has_spins(form);
  const int s = (n == 3) ? 3 : 1;
  const int dof = N * n + (spins ? N * s : 0);
  const bool along_alone = (form.rfind("mg", 0) == 0 || form == "none");
  const bool across = (n > 1 && !along_alone);
  std::vector<Eigen::Triplet<Real>> entries;
  Noise result;
  auto add = [&](int low, int high, int index, bool surface = false) {
    result.numbers.push_back({low, high, surface, index});
    return static_cast<int>(result.numbers.size()) - 1;
  };
  auto put = [&](int row, int column, const SmallVector &values) {
    for (int k = 0; k < values.size(); k++) entries.emplace_back(row + k, column, values(k));
  };

  // impulse on i and its opposite on j; half of the torque that balances it on both

  auto push = [&](int column, const Pair &p, const SmallVector &impulse) {
    put(n * p.i, column, impulse);
    put(n * p.j, column, -impulse);
    if (!spins) return;
    const SmallVector torque = -0.5L * cross(p.r, impulse);
    put(N * n + s * p.i, column, torque);
    put(N * n + s * p.j, column, torque);
  };

  Vector zeta_of = Vector::Zero(N);
  bool directed = false;
  const Vector limit = limited ? zeta_limit(form) : Vector::Zero(N);
  for (int k = 0; k < N && has_bulk; k++) {
    const Real z = zeta(atoms.type[k], form);
    if (limited && z < 0.0L) directed = true;
    if (!is_wall(k)) zeta_of(k) = limited ? std::max(z, limit(k)) : z;
  }

  // pressure

  const Sparse rows = density_rate_rows();
  for (int k = 0; k < N; k++) {
    if (!(zeta_of(k) > 0.0L)) continue;
    const int column = add(k, -1, 0);
    const Real amplitude = std::sqrt(2.0L * kT * zeta_of(k) / V(k)) * V(k) / c(k);
    for (Sparse::InnerIterator row(rows, k); row; ++row)
      entries.emplace_back(row.col(), column, -amplitude * row.value());
  }

  // pairs, from the particle with the lower number

  const bool vector = (across && n == 3);
  const int base_of_pairs = (vector && (spins || directed)) ? NoiseNumber::HALVES : 0;
  const int last = along_alone ? 1 : vector ? base_of_pairs + 7 : 3;
  std::vector<std::vector<std::pair<const Pair *, int>>> own(
      N);    // pairs of i and the column of its number
  auto add_pair = [&](const Pair &p, Real factor, bool surface) {
    const Coefficients plain = coefficients(p, form);
    const Coefficients a = {factor * plain.along, factor * plain.across, factor * plain.spin_along,
                            factor * plain.spin_across};
    const bool both = directed && !surface;    // have a number
    const int base = (vector && (spins || both)) ? NoiseNumber::HALVES : 0;
    const int first = vector ? base + 3 : 0;
    const SmallVector e = p.r / p.dist;
    if (both) {
      own[p.i].emplace_back(&p, add(p.i, p.j, first));
      own[p.j].emplace_back(&p, add(p.i, p.j, last));
    } else if (!vector) {
      push(add(p.i, p.j, first, surface), p, std::sqrt(2.0L * kT * a.along) * e);
    }
    if (!across) return;
    const SmallMatrix dyad = e * e.transpose();
    const SmallMatrix complement = SmallMatrix::Identity(n, n) - dyad;
    if (n == 2) {
      SmallVector t(2);
      t << -e(1), e(0);
      push(add(p.i, p.j, 1, surface), p, std::sqrt(2.0L * kT * a.across) * t);
    } else {
      const Real along = both ? 0.0L : std::sqrt(2.0L * kT * a.along);
      for (int k = 0; k < 3; k++)
        push(add(p.i, p.j, base + k, surface), p,
             along * dyad.col(k) + std::sqrt(2.0L * kT * a.across) * complement.col(k));
    }
    if (!spins) return;
    for (int k = 0; k < s; k++) {
      const int column = add(p.i, p.j, n == 2 ? 2 : base + 4 + k, surface);
      SmallVector spin(s);
      if (n == 2)
        spin(0) = std::sqrt(2.0L * kT * a.spin_across);
      else
        spin = std::sqrt(2.0L * kT * a.spin_along) * dyad.col(k) +
            std::sqrt(2.0L * kT * a.spin_across) * complement.col(k);
      put(N * n + s * p.i, column, spin);
      put(N * n + s * p.j, column, -spin);
    }
  };
  for (const auto &p : pairs) {
    if (p.i > p.j || form == "none") continue;
    add_pair(p, directed ? 1.0L : p.factor, false);
    if (directed && p.factor != 1.0L) add_pair(p, p.factor - 1.0L, true);
  }

  // zeta < 0: half of the friction of each pair along e together with the bulk term of the particle

  for (int i = 0; i < N; i++) {
    Real norm = 0.0L;
    std::vector<Real> gamma;
    std::vector<SmallVector> impulse;
    for (const auto &entry : own[i]) {
      const Pair &p = *entry.first;
      const int j = p.i + p.j - i;
      const Real along = coefficients(p, form).along;
      gamma.push_back(std::sqrt(V(i) / along) * w(j) * p.F * p.dist / c(i));
      impulse.push_back(std::sqrt(kT * along) * p.r / p.dist);
      norm += gamma.back() * gamma.back();
    }
    const Real rest = std::max(1.0L + 2.0L * std::min(zeta_of(i), 0.0L) * norm, 0.0L);
    const Real shrink = norm > 0.0L ? (1.0L - (rest > 1.0e-16L ? std::sqrt(rest) : 0.0L)) / norm
                                    : 0.0L;
    for (std::size_t k = 0; k < own[i].size(); k++)
      for (std::size_t l = 0; l < own[i].size(); l++) {
        const Real share = (k == l ? 1.0L : 0.0L) - shrink * gamma[k] * gamma[l];
        push(own[i][k].second, *own[i][l].first, share * impulse[l]);
      }
  }

  result.B.resize(dof, static_cast<int>(result.numbers.size()));
  result.B.setFromTriplets(entries.begin(), entries.end());
  return result;
}
