/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "dense_reference.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace DenseReference;

static constexpr Real PI = 3.14159265358979323846264338327950288L;

/* ---------------------------------------------------------------------- */

Real Polynomial::operator()(Real x) const
{
  Real value = 0.0;
  for (auto it = coeff.rbegin(); it != coeff.rend(); ++it) value = value * x + *it;
  return value;
}

Polynomial Polynomial::operator*(const Polynomial &other) const
{
  if (coeff.empty() || other.coeff.empty()) return Polynomial();
  std::vector<Real> result(coeff.size() + other.coeff.size() - 1, 0.0);
  for (std::size_t i = 0; i < coeff.size(); i++)
    for (std::size_t j = 0; j < other.coeff.size(); j++) result[i + j] += coeff[i] * other.coeff[j];
  return Polynomial(result);
}

Polynomial Polynomial::operator+(const Polynomial &other) const
{
  std::vector<Real> result(std::max(coeff.size(), other.coeff.size()), 0.0);
  for (std::size_t i = 0; i < coeff.size(); i++) result[i] += coeff[i];
  for (std::size_t i = 0; i < other.coeff.size(); i++) result[i] += other.coeff[i];
  return Polynomial(result);
}

Polynomial Polynomial::scaled(Real factor) const
{
  return *this * Polynomial({factor});
}

Polynomial Polynomial::derivative() const
{
  std::vector<Real> result;
  for (std::size_t i = 1; i < coeff.size(); i++) result.push_back(i * coeff[i]);
  return Polynomial(result);
}

Polynomial Polynomial::antiderivative() const
{
  std::vector<Real> result(1, 0.0);
  for (std::size_t i = 0; i < coeff.size(); i++) result.push_back(coeff[i] / (i + 1));
  return Polynomial(result);
}

Polynomial Polynomial::linear_power(Real a, Real b, int power)
{
  Polynomial result({1.0L});
  for (int i = 0; i < power; i++) result = result * Polynomial({a, b});
  return result;
}

/* ---------------------------------------------------------------------- */

Real DenseReference::integrate(const Polynomial &f, Real a, Real b)
{
  constexpr int points = 20;
  Real sum = 0.0;
  for (int k = 0; k < points; k++) {
    // Newton iteration for the k-th root of the Legendre polynomial
    Real x = std::cos(PI * (k + 0.75L) / (points + 0.5L)), slope = 1.0;
    for (int iter = 0; iter < 30; iter++) {
      Real p0 = 1.0, p1 = x;
      for (int m = 2; m <= points; m++) {
        const Real p2 = ((2 * m - 1) * x * p1 - (m - 1) * p0) / m;
        p0 = p1;
        p1 = p2;
      }
      slope = points * (x * p1 - p0) / (x * x - 1.0L);
      x -= p1 / slope;
    }
    const Real weight = 2.0L / ((1.0L - x * x) * slope * slope);
    sum += weight * f(0.5L * (a + b) + 0.5L * (b - a) * x);
  }
  return 0.5L * (b - a) * sum;
}

/* ---------------------------------------------------------------------- */

const std::vector<std::string> &DenseReference::kernel_names()
{
  static const std::vector<std::string> names = {"wendland/c2", "wendland/c4", "wendland/c6",
                                                 "cubic",       "quintic",     "lucy"};
  return names;
}

// Wendland functions are (1-q)^l with the operator f -> integral from q to 1 of t f(t) dt applied
// k times; Lucy's kernel is the one of l = 2, k = 1

static Polynomial wendland(int l, int k)
{
  Polynomial f = Polynomial::linear_power(1.0, -1.0, l);
  for (int i = 0; i < k; i++) {
    const Polynomial primitive = (f * Polynomial({0.0L, 1.0L})).antiderivative();
    f = Polynomial({primitive(1.0L)}) + primitive.scaled(-1.0L);
  }
  return f;
}

// central B-spline of an even order k with knots at the integers, one polynomial of s = q k/2 per
// interval: the sum over j of (-1)^j binomial(k,j) (k/2-j-s)^(k-1) over terms with k/2-j-s > 0

static Polynomial spline_piece(int order, int interval)
{
  const int half = order / 2;
  Polynomial f;
  Real binomial = 1.0;
  for (int j = 0; j < half - interval; j++) {
    f = f +
        Polynomial::linear_power(half - j, -half, order - 1).scaled(j % 2 ? -binomial : binomial);
    binomial *= static_cast<Real>(order - j) / (j + 1);
  }
  return f;
}

Kernel::Kernel(const std::string &name, int _n, Real _support) : n(_n), support(_support), norm(1.0)
{
  auto add = [this](Real end, const Polynomial &shape) {
    pieces.push_back({end, shape, shape.derivative()});
  };
  auto add_spline = [&add](int order) {
    const int half = order / 2;
    for (int m = 0; m < half; m++) add((m + 1.0L) / half, spline_piece(order, m));
  };

  if (name == "lucy")
    add(1.0, wendland(2, 1));
  else if (name == "wendland/c2")
    add(1.0, wendland(3, 1));
  else if (name == "wendland/c4")
    add(1.0, wendland(4, 2));
  else if (name == "wendland/c6")
    add(1.0, wendland(5, 3));
  else if (name == "cubic")
    add_spline(4);
  else if (name == "quintic")
    add_spline(6);
  else
    throw std::invalid_argument("kernel " + name);

  norm = 1.0L / moment(0);
}

// integral of r^power W over space

Real Kernel::moment(int power) const
{
  const Real sphere[3] = {2.0L, 2.0L * PI, 4.0L * PI};
  std::vector<Real> radial(n + power, 0.0L);
  radial.back() = 1.0L;
  Real sum = 0.0, begin = 0.0;
  for (const auto &p : pieces) {
    sum += integrate(p.shape * Polynomial(radial), begin, p.end);
    begin = p.end;
  }
  return norm * sphere[n - 1] * sum * std::pow(support, static_cast<Real>(n + power));
}

Real Kernel::mean_distance() const
{
  return moment(1);
}

Real Kernel::slope_moment(int power) const
{
  const Real sphere[3] = {2.0L, 2.0L * PI, 4.0L * PI};
  std::vector<Real> radial(n + power - 1, 0.0L);
  radial.back() = -1.0L;
  Real sum = 0.0, begin = 0.0;
  for (const auto &p : pieces) {
    sum += integrate(p.slope * Polynomial(radial), begin, p.end);
    begin = p.end;
  }
  return norm * sphere[n - 1] * sum * std::pow(support, static_cast<Real>(n + power - 2));
}

const Kernel::Piece &Kernel::piece(Real q) const
{
  for (const auto &p : pieces)
    if (q < p.end) return p;
  return pieces.back();
}

Real Kernel::W(Real r) const
{
  const Real q = r / support;
  return q < 1.0L ? norm * piece(q).shape(q) : 0.0L;
}

Real Kernel::F(Real r) const
{
  const Real q = r / support;
  return q < 1.0L ? -norm * piece(q).slope(q) / (support * r) : 0.0L;
}

/* ---------------------------------------------------------------------- */

System::System(const Model &_model, const Box &box, const Particles &particles) :
    model(_model), atoms(particles), kernel(model.kernel, model.n, model.support),
    mean_distance(kernel.mean_distance()), N(particles.size()), n(model.n)
{
  // fractional coordinates of two particles differ by less than 1, those of points within the
  // support by no more than the support over the height of the cell, 1/|row of the inverse|

  const Matrix inverse = box.lattice.inverse();
  std::array<int, 3> range = {0, 0, 0};
  for (int k = 0; k < n; k++)
    if (box.periodic[k]) range[k] = static_cast<int>(1.0L + model.support * inverse.row(k).norm());

  w = Vector::Ones(N);
  if (model.volume_by_mass)
    for (int i = 0; i < N; i++) w(i) = atoms.mass[i] / model.fluids[atoms.type[i] - 1].rho0;
  c = Vector::Zero(N);
  cdot = Vector::Zero(N);
  for (int i = 0; i < N; i++) {
    for (int j = 0; j < N; j++) {
      for (int a = -range[0]; a <= range[0]; a++) {
        for (int b = -range[1]; b <= range[1]; b++) {
          for (int d = -range[2]; d <= range[2]; d++) {
            const Real shift[3] = {static_cast<Real>(a), static_cast<Real>(b),
                                   static_cast<Real>(d)};
            Real r[3] = {0.0L, 0.0L, 0.0L}, rsq = 0.0L;
            for (int k = 0; k < n; k++) {
              r[k] = atoms.x(k, i) - atoms.x(k, j);
              for (int l = 0; l < n; l++) r[k] -= shift[l] * box.lattice(k, l);
              rsq += r[k] * r[k];
            }
            if (rsq >= model.support * model.support) continue;
            const Real dist = std::sqrt(rsq);
            if (is_wall(i) && is_wall(j))
              solid.push_back({i, j, Eigen::Map<const Vector>(r, n), dist, 0.0L});
            if (i != j && is_wall(i) && is_wall(j)) continue;
            c(i) += w(j) * kernel.W(dist);
            if (dist == 0.0L) continue;    // the particle itself, or another one at the same point
            pairs.push_back({i, j, Eigen::Map<const Vector>(r, n), dist, kernel.F(dist)});
          }
        }
      }
    }
  }
  V = w.cwiseQuotient(c);
  for (int i = 0; i < N; i++)
    if (is_wall(i)) V(i) = atoms.mass[i] / model.fluids[atoms.type[i] - 1].rho0;
  cdot = density_rate_rows() * velocity();
  if (!solid.empty()) find_factors();
}

// 1 up to close to the radius, then a smooth step down to 0

static Real fading(Real dist, Real radius)
{
  const Real t = std::min((1.0L - dist * dist / (radius * radius)) / 0.03L, 1.0L);
  return 3.0L * t * t - 2.0L * t * t * t;
}

// (d + h)/d with the distances d of the fluid and h of the wall particle from the surface.  The outer layer of a wall is what a
// Gaussian does not find surrounded and what looks at the fluid; the surface is the mean of the planes that touch it, and what
// a curved surface fills less of the Gaussian than a plane.

void System::find_factors()
{
  std::vector<SmallVector> side(N, SmallVector::Zero(n)), inward = side, plane = side,
                                                          normal = side;
  Vector filled = Vector::Zero(N), plane_depth = filled, depth = filled, weights = filled;
  auto spacing = [&](int i) {
    return std::pow(V(i), 1.0L / n);
  };
  for (const auto &p : pairs)
    if (is_wall(p.i) && !is_wall(p.j)) side[p.i] -= p.F * p.r;
  for (const auto &p : solid) {
    const Real width = 0.7L * spacing(p.i), radius = std::min(model.support, 3.0L * spacing(p.i));
    if (!(p.dist < radius)) continue;
    const Real part = V(p.j) * std::exp(-0.5L * p.dist * p.dist / (width * width)) /
        std::pow(2.0L * PI * width * width, 0.5L * n) * fading(p.dist, radius);
    filled(p.i) += part;
    inward[p.i] -= part * p.r;
  }
  for (int i = 0; i < N; i++) {
    if (!is_wall(i)) continue;
    const Real length = inward[i].norm(), width = 0.7L * spacing(i);
    if (filled(i) < 0.85L && length > 0.01L * width &&
        inward[i].dot(side[i]) < -0.01L * length * side[i].norm()) {
      plane[i] = -inward[i] / length;
      plane_depth(i) = (filled(i) - 0.5L) * std::sqrt(2.0L * PI) * width;
    }
  }
  for (const auto &p : solid) {
    if (!(plane[p.j].norm() > 0.5L)) continue;
    const Real soft = 0.25L * spacing(p.i);
    const Real share =
        std::pow(p.dist * p.dist + soft * soft, -4.0L) * fading(p.dist, model.support);
    weights(p.i) += share;
    normal[p.i] += share * plane[p.j];
    depth(p.i) += share * (plane_depth(p.j) - plane[p.j].dot(p.r));
  }
  for (int i = 0; i < N; i++) {
    if (!is_wall(i)) continue;
    const Real length = normal[i].norm();
    const bool known = length > 0.1L * weights(i);
    depth(i) = known ? std::max(depth(i) / weights(i), 0.0L) : 0.45L * spacing(i);
    normal[i] = known ? SmallVector(normal[i] / length) : SmallVector::Zero(n);
  }
  Vector turn = Vector::Zero(N), room = turn;
  for (const auto &p : solid) {
    const Real radius = std::min(model.support, 3.0L * spacing(p.i));
    if (!(p.dist < radius)) continue;
    const SmallVector along = normal[p.i] * normal[p.i].dot(p.r) - p.r;
    turn(p.i) += fading(p.dist, radius) * along.dot(normal[p.j]);
    room(p.i) += fading(p.dist, radius) * along.squaredNorm();
  }
  for (int i = 0; i < N; i++) {
    if (!is_wall(i) || !(normal[i].norm() > 0.5L) || !(room(i) > 0.0L)) continue;
    const Real width = 0.7L * spacing(i), bend = turn(i) / room(i) * spacing(i);
    if (!(bend > -0.25L)) continue;
    const Real at_surface = bend / std::max(1.0L + bend * depth(i) / spacing(i), 0.5L);
    const Real known = std::clamp(2.0L - std::abs(at_surface) / 0.25L, 0.0L, 1.0L);
    depth(i) =
        std::max(depth(i) + 0.5L * (n - 1) * width * width * known * at_surface / spacing(i), 0.0L);
  }
  for (auto &p : pairs) {
    if (is_wall(p.i) == is_wall(p.j)) continue;
    const int wall = is_wall(p.i) ? p.i : p.j;
    const SmallVector to_fluid = is_wall(p.i) ? SmallVector(-p.r) : p.r;
    const Real least = normal[wall].norm() > 0.5L ? 0.05L * model.support : 0.5L * spacing(wall);
    const Real d = std::max(normal[wall].dot(to_fluid) - depth(wall), least);
    p.factor = (d + depth(wall)) / d;
  }
}

Vector System::velocity() const
{
  return Eigen::Map<const Vector>(atoms.v.data(), N * n);
}

Vector System::velocity_and_spin() const
{
  Vector q(N * n + atoms.spin.size());
  q << velocity(), Eigen::Map<const Vector>(atoms.spin.data(), atoms.spin.size());
  return q;
}

// row k: derivative of cdot_k with respect to all velocities

Sparse System::density_rate_rows() const
{
  std::vector<Eigen::Triplet<Real>> entries;
  for (const auto &p : pairs) {
    for (int a = 0; a < n; a++) {
      const Real entry = w(p.j) * p.F * p.r(a);
      entries.emplace_back(p.i, n * p.i + a, -entry);
      entries.emplace_back(p.i, n * p.j + a, entry);
    }
  }
  Sparse rows(N, N * n);
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

Vector System::density() const
{
  Vector rho(N);
  for (int i = 0; i < N; i++) rho(i) = atoms.mass[i] / V(i);
  return rho;
}

static Real exponent(const Fluid &fluid, const std::string &eos)
{
  if (fluid.gamma > 0.0L) return fluid.gamma;
  return eos == "tait" ? 7.0L : 1.4L;
}

Vector System::pressure(const std::string &eos) const
{
  const Vector rho = density();
  Vector p(N);
  for (int i = 0; i < N; i++) {
    const Fluid &fluid = model.fluids[atoms.type[i] - 1];
    const Real gamma = exponent(fluid, eos);
    if (eos == "linear")
      p(i) = fluid.c0 * fluid.c0 * (rho(i) - fluid.rho0);
    else if (eos == "tait")
      p(i) =
          fluid.rho0 * fluid.c0 * fluid.c0 / gamma * (std::pow(rho(i) / fluid.rho0, gamma) - 1.0L);
    else if (eos == "ideal")
      p(i) = (gamma - 1.0L) * rho(i) *
          (atoms.energy[i] / atoms.mass[i] - fluid.pb * (1.0L / fluid.rho0 - 1.0L / rho(i)));
    else
      throw std::invalid_argument("eos " + eos);
    p(i) += fluid.pb;
  }
  return p;
}

// mass times the integral of p/rho^2 from rho0 to rho, of the ideal gas that of its background pressure alone

Vector System::elastic_energy(const std::string &eos) const
{
  const Vector rho = density();
  Vector energy = Vector::Zero(N);
  for (int i = 0; i < N; i++) {
    const Fluid &fluid = model.fluids[atoms.type[i] - 1];
    const Real cc = fluid.c0 * fluid.c0, inverse = 1.0L / fluid.rho0 - 1.0L / rho(i);
    Real e = fluid.pb * inverse;
    if (eos == "linear") {
      e += cc * (std::log(rho(i) / fluid.rho0) - fluid.rho0 * inverse);
    } else if (eos == "tait") {
      const Real gamma = exponent(fluid, eos), B = fluid.rho0 * cc / gamma;
      e += B / std::pow(fluid.rho0, gamma) / (gamma - 1.0L) *
          (std::pow(rho(i), gamma - 1.0L) - std::pow(fluid.rho0, gamma - 1.0L));
      e -= B * inverse;
    }
    energy(i) = atoms.mass[i] * e;
  }
  return energy;
}

Vector System::conservative_force(const std::string &eos) const
{
  // -dE/dr, E = sum m e(rho), dE = sum p V/c dc: the rows of cdot are also the gradients of the c_k
  const Vector weight = -pressure(eos).cwiseProduct(V).cwiseQuotient(c);
  return density_rate_rows().transpose() * weight;
}

Vector System::compression_power(const std::string &eos) const
{
  return pressure(eos).cwiseProduct(V).cwiseQuotient(c).cwiseProduct(cdot);
}

/* ---------------------------------------------------------------------- */

static Real harmonic_mean(Real a, Real b)
{
  return a == 0.0L || b == 0.0L ? 0.0L : 2.0L / (1.0L / a + 1.0L / b);
}

Real System::mu(int itype, int jtype) const
{
  const auto found = model.mu_unlike.find(std::minmax(itype, jtype));
  if (found != model.mu_unlike.end()) return found->second;
  return harmonic_mean(model.fluids[itype - 1].mu, model.fluids[jtype - 1].mu);
}

Real System::zeta(int type, const std::string &shear_form) const
{
  const Fluid &fluid = model.fluids[type - 1];
  if (fluid.intrinsic) return 0.0L;
  // second viscosity of the shear term alone: mu (lap u + 2 grad div u) for mg, mu lap u for morris
  Real lambda = 0.0L;
  if (shear_form.rfind("mg", 0) == 0) lambda = fluid.mu;
  if (shear_form == "morris") lambda = -fluid.mu;
  if (has_spins(shear_form)) lambda = fluid.mu - model.spins[type - 1].mu_r;
  if (shear_form == "espanol") lambda = -fluid.mu * (n + 1) / (n + 3);
  const Real shear_kappa = shear_form == "none" ? 0.0L : lambda + 2.0L * fluid.mu / n;
  return fluid.kappa - shear_kappa;
}

// force on i is minus this block times the velocity difference

SmallMatrix System::shear_block(const Pair &p, const std::string &form) const
{
  if (form == "none") return SmallMatrix::Zero(n, n);
  const Real viscosity = mu(atoms.type[p.i], atoms.type[p.j]);
  const Real weight = viscosity * V(p.i) * V(p.j) * p.F;
  const SmallMatrix dyad = p.r * p.r.transpose() / p.r.squaredNorm();
  if (form == "mg") return 2.0L * (n + 2) * weight * dyad;
  if (form == "mg/fr")    // P1 eqs. (15), (49)
    return 2.0L * n * (n + 2) / ((n + 1) * mean_distance) * weight * p.dist * dyad;
  if (form == "mg/fr2")    // the same mean over directions as mg: 2 (n+2) n = 2 n (n+2) <r^2>/<r^2>, n = integral of F r^2
    return 2.0L * (n + 2) * n / kernel.slope_moment(4) * weight * p.r * p.r.transpose();
  if (form == "morris") return 2.0L * weight * SmallMatrix::Identity(n, n);
  if (form == "espanol")
    return 2.0L * (n + 2) / (n + 3) * weight * (SmallMatrix::Identity(n, n) + dyad);
  throw std::invalid_argument("shear " + form);
}

Viscous System::shear(const std::string &form) const
{
  Viscous result;
  result.R = Matrix::Zero(N * n, N * n);
  result.heating = Vector::Zero(N);
  for (const auto &p : pairs) {
    const SmallMatrix block = p.factor * shear_block(p, form);
    result.R.block(n * p.i, n * p.i, n, n) += block;
    result.R.block(n * p.i, n * p.j, n, n) -= block;
    const SmallVector u = atoms.v.col(p.i) - atoms.v.col(p.j);
    result.heating(p.i) += 0.5L * u.dot(block * u);
  }
  result.force = -(result.R * velocity());
  return result;
}

// Four flows whose dissipation per volume is known for the continuum,
//   spin 1 along z in fluid at rest: 4 mu_r
//   u_x = y, spin half of the vorticity: mu
//   transverse wave of the spin, per slope squared: gamma1
//   longitudinal one: 2 gamma1 + gamma2
// and for the pair forms, with integrals over the kernel and over directions e: half of the
// integral of F [zeta1 (e.u*)^2 + zeta2 u*^2], likewise with xi.

System::PairViscosity System::micropolar_viscosity(int itype, int jtype) const
{
  const auto known = known_viscosity.find({itype, jtype});
  if (known != known_viscosity.end()) return known->second;
  const SpinFluid &a = model.spins[itype - 1], &b = model.spins[jtype - 1];
  SpinFluid fluid{harmonic_mean(a.mu_r, b.mu_r), harmonic_mean(a.gamma1, b.gamma1),
                  harmonic_mean(a.gamma2, b.gamma2)};
  const auto found = model.spin_unlike.find(std::minmax(itype, jtype));
  if (found != model.spin_unlike.end()) fluid = found->second;

  // means of ex^2, ex^2 ey^2, ex^4 over directions
  constexpr int points = 32;
  Real azimuth[3] = {0.0L, 0.0L, 0.0L};
  for (int k = 0; k < points; k++) {
    const Real x = std::cos(2.0L * PI * k / points), y = std::sin(2.0L * PI * k / points);
    azimuth[0] += x * x / points;
    azimuth[1] += x * x * y * y / points;
    azimuth[2] += x * x * x * x / points;
  }
  if (n == 3) {
    const Polynomial sine_squared({1.0L, 0.0L, -1.0L});
    azimuth[0] *= 0.5L * integrate(sine_squared, -1.0L, 1.0L);
    for (int k = 1; k < 3; k++)
      azimuth[k] *= 0.5L * integrate(sine_squared * sine_squared, -1.0L, 1.0L);
  }
  const Real half = 0.5L * kernel.slope_moment(2);
  const Real xx = half * azimuth[0], xxyy = half * azimuth[1], xxxx = half * azimuth[2];

  PairViscosity result;
  // |spin x r|^2 = x^2 + y^2
  result.zeta2 = 4.0L * fluid.mu_r / (2.0L * xx);
  // r.u*/r = x y/r, |u*|^2 = (x^2 + y^2)/4
  result.zeta1 = (mu(itype, jtype) - result.zeta2 * 0.5L * xx) / xxyy;
  if (n == 2) {
    result.xi1 = 0.0L;
    result.xi2 = fluid.gamma1 / xx;
  } else {
    // gamma1 = xi1 xxyy + xi2 xx, 2 gamma1 + gamma2 = xi1 xxxx + xi2 xx
    result.xi1 = (fluid.gamma1 + fluid.gamma2) / (xxxx - xxyy);
    result.xi2 = (fluid.gamma1 - result.xi1 * xxyy) / xx;
  }
  known_viscosity[{itype, jtype}] = result;
  return result;
}

// coefficient of (e.u*)^2: with the weight F r^2 unless it is negative

Real System::central(const Pair &p, const std::string &form, const PairViscosity &visc) const
{
  if (form == "micropolar" || visc.zeta1 < 0.0L) return visc.zeta1;
  return visc.zeta1 * p.r.squaredNorm() * kernel.slope_moment(2) / kernel.slope_moment(4);
}

// the power is q.R q with q = velocities and spins: each ordered pair brings half of its form

Micropolar System::micropolar(const std::string &form) const
{
  const int s = (n == 3) ? 3 : 1, dof = N * (n + s);
  const Vector q = velocity_and_spin();
  Micropolar result;
  result.R = Matrix::Zero(dof, dof);
  result.central = result.vortex = result.spin = Vector::Zero(N);

  std::map<std::pair<int, int>, PairViscosity> viscosity;
  const int ntypes = static_cast<int>(model.fluids.size());
  for (int a = 1; a <= ntypes; a++)
    for (int b = 1; b <= ntypes; b++) viscosity[{a, b}] = micropolar_viscosity(a, b);

  for (const auto &p : pairs) {
    const PairViscosity &visc = viscosity[{atoms.type[p.i], atoms.type[p.j]}];
    const Real weight = p.factor * p.F * V(p.i) * V(p.j);

    // columns: velocities of i and j, spins of i and j
    std::vector<int> columns;
    for (const int base : {n * p.i, n * p.j})
      for (int a = 0; a < n; a++) columns.push_back(base + a);
    for (const int base : {N * n + s * p.i, N * n + s * p.j})
      for (int a = 0; a < s; a++) columns.push_back(base + a);

    // u* = u_i - u_j - (spin_i + spin_j)/2 x r
    Matrix slip = Matrix::Zero(n, 2 * (n + s)), difference = Matrix::Zero(s, 2 * (n + s));
    for (int a = 0; a < n; a++) {
      slip(a, a) = 1.0L;
      slip(a, n + a) = -1.0L;
    }
    Matrix cross = Matrix::Zero(n, s);    // spin x r = cross * spin
    if (n == 2) {
      cross << -p.r(1), p.r(0);
    } else {
      cross << 0.0L, p.r(2), -p.r(1), -p.r(2), 0.0L, p.r(0), p.r(1), -p.r(0), 0.0L;
    }
    slip.block(0, 2 * n, n, s) = slip.block(0, 2 * n + s, n, s) = -0.5L * cross;
    for (int a = 0; a < s; a++) {
      difference(a, 2 * n + a) = 1.0L;
      difference(a, 2 * n + s + a) = -1.0L;
    }

    const Vector e = p.r / p.dist;
    const Matrix along = e.transpose() * slip;
    Matrix spin_form = visc.xi2 * difference.transpose() * difference;
    if (n == 3) {
      const Matrix spin_along = e.transpose() * difference;
      spin_form += visc.xi1 * spin_along.transpose() * spin_along;
    }
    const Matrix forms[3] = {weight * central(p, form, visc) * along.transpose() * along,
                             weight * visc.zeta2 * slip.transpose() * slip, weight * spin_form};

    const int width = static_cast<int>(columns.size());
    Vector local(width);
    for (int a = 0; a < width; a++) local(a) = q(columns[a]);
    Vector *const heat[3] = {&result.central, &result.vortex, &result.spin};
    for (int k = 0; k < 3; k++) {
      (*heat[k])(p.i) += 0.5L * local.dot(forms[k] * local);
      for (int a = 0; a < width; a++)
        for (int b = 0; b < width; b++) result.R(columns[a], columns[b]) += 0.5L * forms[k](a, b);
    }
  }
  const Vector total = -(result.R * q);
  result.force = total.head(N * n);
  result.torque = total.tail(N * s);
  return result;
}

// what particle k puts into the bulk forces of its pairs, divided by its cdot

Real System::bulk_amplitude(int k, const std::string &form, const std::string &shear_form) const
{
  const Real z = zeta(atoms.type[k], shear_form);
  if (form == "none" || is_wall(k)) return 0.0L;
  if (form == "density") return z * V(k) / (c(k) * c(k));
  if (form == "volume") return z / c(k);
  throw std::invalid_argument("bulk " + form);
}

// With w = F V_i V_j a (u.e)^2 the shear dissipation of a pair, the Cauchy-Schwarz inequality says
// V (cdot/c)^2 <= (sum of w) (sum of V/c^2 w_j^2 F^2 r^2 / (F V_i V_j a)): each pair can make up for both of
// its particles if the zeta of each is above minus half of the inverse of the last sum.

Vector System::zeta_limit(const std::string &shear_form) const
{
  Vector sum = Vector::Zero(N);
  for (const auto &p : pairs) {
    const Real along = coefficients(p, shear_form).along;
    const Real share = w(p.j) * p.F / c(p.i);
    sum(p.i) += V(p.i) * share * share * p.r.squaredNorm() / along;
  }
  return -0.5L * sum.cwiseInverse();
}

int System::beyond_limit(const std::string &shear_form) const
{
  const Vector limit = zeta_limit(shear_form);
  int count = 0;
  for (int k = 0; k < N; k++)
    if (zeta(atoms.type[k], shear_form) < limit(k)) count++;
  return count;
}

Viscous System::bulk(const std::string &form, const std::string &shear_form, bool limited,
                     bool matrix) const
{
  Vector amplitude(N);
  for (int k = 0; k < N; k++) amplitude(k) = bulk_amplitude(k, form, shear_form);
  if (limited) {
    const Vector limit = zeta_limit(shear_form);
    for (int k = 0; k < N; k++) {
      const Real z = zeta(atoms.type[k], shear_form);
      if (z < limit(k)) amplitude(k) *= limit(k) / z;
    }
  }

  // the dissipation of particle k is amplitude_k times its cdot (right) times another rate (left):
  // cdot again for P1 eq. (18), the rate with each pair weighted by V_i V_j for P1 eq. (64)

  const Sparse right = density_rate_rows();
  Sparse left = right;
  if (form == "volume") {
    std::vector<Eigen::Triplet<Real>> entries;
    for (const auto &p : pairs) {
      for (int a = 0; a < n; a++) {
        const Real entry = p.F * p.r(a) * V(p.i) * V(p.j);
        entries.emplace_back(p.i, n * p.i + a, -entry);
        entries.emplace_back(p.i, n * p.j + a, entry);
      }
    }
    left.setFromTriplets(entries.begin(), entries.end());
  }

  Viscous result;
  const Vector rate = right * velocity();
  result.force = -(left.transpose() * amplitude.cwiseProduct(rate));
  result.heating = amplitude.cwiseProduct(rate).cwiseProduct(left * velocity());
  if (!matrix) return result;

  // sum over particles of amplitude times the outer product of both rows

  result.R = Matrix::Zero(N * n, N * n);
  for (int k = 0; k < N; k++) {
    if (amplitude(k) == 0.0L) continue;
    const int begin = left.outerIndexPtr()[k], end = left.outerIndexPtr()[k + 1];
    for (Sparse::InnerIterator b(right, k); b; ++b) {
      Real *const column = &result.R(0, b.col());
      const Real factor = amplitude(k) * b.value();
      for (int a = begin; a < end; a++)
        column[left.innerIndexPtr()[a]] += factor * left.valuePtr()[a];
    }
  }
  return result;
}

Matrix System::virial(const std::string &eos, const std::string &shear_form,
                      const std::string &bulk_form) const
{
  static const int first[6] = {0, 1, 2, 0, 0, 1}, second[6] = {0, 1, 2, 1, 2, 2};
  const Vector p = pressure(eos);
  Matrix result = Matrix::Zero(6, N);
  for (const auto &pair : pairs) {
    const int i = pair.i, j = pair.j;
    const bool by_pair = bulk_form == "volume";
    Real central = w(j) * p(i) * V(i) / c(i) + w(i) * p(j) * V(j) / c(j);
    central += (by_pair ? V(i) * V(j) : w(j)) * bulk_amplitude(i, bulk_form, shear_form) * cdot(i);
    central += (by_pair ? V(i) * V(j) : w(i)) * bulk_amplitude(j, bulk_form, shear_form) * cdot(j);
    const SmallVector f = central * pair.F * pair.r -
        shear_block(pair, shear_form) * (atoms.v.col(i) - atoms.v.col(j));
    for (int k = 0; k < 6; k++)
      if (second[k] < n) result(k, i) += 0.5L * pair.r(first[k]) * f(second[k]);
  }
  return result;
}
