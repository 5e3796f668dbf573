/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Independent dense reference of the sph/bulk and sph/micropolar fluids. It shares no code with the package: pairs are
// found by brute force over all periodic images, kernels are polynomials that are built, normalised
// and differentiated by machine, and the viscous force is the product of one matrix of the whole
// system with the velocities. Everything is in long double, so its error is far below the
// package's round-off.
//
// P1 = Bonet Avalos, Antuono, Colagrossi, Souto-Iglesias, Phys. Rev. E 101, 013302 (2020)

#ifndef SPHD_DENSE_REFERENCE_H
#define SPHD_DENSE_REFERENCE_H

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace DenseReference {

using Real = long double;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Sparse = Eigen::SparseMatrix<Real, Eigen::RowMajor>;

// of one particle or pair: up to three components, on the stack

using SmallVector = Eigen::Matrix<Real, Eigen::Dynamic, 1, Eigen::ColMajor, 3, 1>;
using SmallMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;

// coefficients in ascending powers

class Polynomial {
 public:
  Polynomial() = default;
  explicit Polynomial(std::vector<Real> c) : coeff(std::move(c)) {}
  Real operator()(Real x) const;
  Polynomial operator*(const Polynomial &other) const;
  Polynomial operator+(const Polynomial &other) const;
  Polynomial scaled(Real factor) const;
  Polynomial derivative() const;
  Polynomial antiderivative() const;                            // zero at x = 0
  static Polynomial linear_power(Real a, Real b, int power);    // (a + b x)^power

 private:
  std::vector<Real> coeff;
};

// Gauss-Legendre quadrature of a polynomial over [a, b], 20 points

Real integrate(const Polynomial &f, Real a, Real b);

// kernel of compact support in n dimensions, W(r >= support) = 0

class Kernel {
 public:
  Kernel(const std::string &name, int n, Real support);
  Real W(Real r) const;
  Real F(Real r) const;          // -W'(r)/r
  Real mean_distance() const;    // integral of r W over all space
  Real slope_moment(int power) const;    // integral of r^power F over all space

 private:
  struct Piece {
    Real end;    // piece reaches up to q = end
    Polynomial shape, slope;
  };
  Real moment(int power) const;
  const Piece &piece(Real q) const;
  int n;
  Real support, norm;
  std::vector<Piece> pieces;
};

const std::vector<std::string> &kernel_names();

// one type of fluid, as in pair_coeff; mu and kappa are physical viscosities

struct Fluid {
  Real rho0, c0, mu, kappa;
  bool intrinsic = false;    // kappa is what the shear term gives
  Real pb = 0.0;
  Real gamma = 0.0;    // 0 = default of the equation of state
};

// what a micropolar fluid has in addition: vortex viscosity and spin viscosities

struct SpinFluid {
  Real mu_r = 0.0, gamma1 = 0.0, gamma2 = 0.0;
};

// n columns of a lattice vector each; non-periodic directions have no images. Particles lie inside.

struct Box {
  Matrix lattice;
  std::array<bool, 3> periodic;
};

struct Particles {
  Matrix x, v;    // n rows, one column per particle
  Matrix spin;    // n = 3: three rows, n = 2: one row, the z component; empty without spin
  std::vector<Real> mass, energy;
  std::vector<int> type;    // from 1
  // with reference volume, without bulk term and pairs among each other, with the friction of the distances from
  // the surface; or empty
  std::vector<bool> wall;
  int size() const { return static_cast<int>(mass.size()); }
};

// forms of a fluid with spins: micropolar, micropolar/fr2

inline bool has_spins(const std::string &form)
{
  return form.rfind("micropolar", 0) == 0;
}

struct Model {
  std::string kernel = "wendland/c2";
  int n = 3;
  Real support = 1.0;
  bool volume_by_mass = false;    // reference volumes w = m/rho0, else w = 1
  std::vector<Fluid> fluids;
  std::map<std::pair<int, int>, Real> mu_unlike;    // explicit shear viscosity of two types
  std::vector<SpinFluid> spins;                     // one per type of a micropolar fluid, or none
  std::map<std::pair<int, int>, SpinFluid> spin_unlike;
};

// viscous part of the force: f = -R u, its pairwise split and the heat it makes

struct Viscous {
  Matrix R;
  Vector force;
  Vector heating;    // one per particle
};

// Dissipative part of a micropolar fluid but for its bulk term. R acts on all velocities followed by
// all spins; the heat of each pair form goes half to either partner.

struct Micropolar {
  Matrix R;
  Vector force, torque;
  Vector central, vortex, spin;    // heating by (e.u*)^2, by u*^2 and by differences of spin
};

// Random numbers of the thermal noise and what they do: impulses of all velocities followed by all spins, in the square
// root of the time, are B times the numbers. A number belongs to a particle (pressure) or to two, low < high.

struct NoiseNumber {
  static constexpr int HALVES = 4;
  int low, high;    // high < 0: pressure
  bool surface;     // of what a surface adds, where each partner of a pair has a number
  int index;    // of the numbers of the pair: four of a word each, or, from HALVES on, eight of half a word
};

struct Noise {
  Sparse B;
  std::vector<NoiseNumber> numbers;
};

class System {
 public:
  System(const Model &model, const Box &box, const Particles &particles);

  int size() const { return N; }
  Vector numden() const { return c.cwiseQuotient(w); }    // 1/V and its rate
  Vector dnumden() const { return cdot.cwiseQuotient(w); }
  const Vector &volume() const { return V; }
  Vector density() const;
  Vector pressure(const std::string &eos) const;
  Vector elastic_energy(const std::string &eos) const;    // per particle
  Vector conservative_force(const std::string &eos) const;
  Vector compression_power(const std::string &eos) const;    // p V cdot/c, per particle

  Viscous shear(const std::string &form) const;
  Micropolar micropolar(const std::string &form = "micropolar") const;
  Viscous bulk(const std::string &form, const std::string &shear_form, bool limited = false,
               bool matrix = true) const;    // without the matrix R: half of the time of many tests

  // with B B^T = 2 kT times the friction matrix of shear, micropolar, and bulk terms (dense_noise.cpp)
  Noise noise(const std::string &shear_form, bool has_bulk, bool limited, Real kT) const;

  // half of r_ij (x) f_ij of every pair to each partner: 6 rows xx yy zz xy xz yz (rows of absent
  // directions are zero), one column per particle

  Matrix virial(const std::string &eos, const std::string &shear_form,
                const std::string &bulk_form) const;

  // particles whose zeta < 0 is beyond what their pairs' shear terms make up for
  int beyond_limit(const std::string &shear_form) const;

  // bulk coefficient of a type that complements the shear term to the wanted kappa

  Real zeta(int type, const std::string &shear_form) const;
  bool is_wall(int i) const { return !atoms.wall.empty() && atoms.wall[i]; }
  Real mu(int itype, int jtype) const;

  Vector velocity() const;             // all velocities stacked
  Vector velocity_and_spin() const;    // and all spins behind them

 private:
  struct Pair {    // every ordered pair (i, image of j) in the support
    int i, j;
    SmallVector r;    // from j to i
    Real dist, F;
    Real factor = 1.0L;    // of the friction
  };
  std::vector<Pair> solid;    // the same of wall particles, themselves among them
  void find_factors();

  struct PairViscosity {
    Real zeta1, zeta2, xi1, xi2;
  };
  PairViscosity micropolar_viscosity(int itype, int jtype) const;
  Real central(const Pair &, const std::string &form, const PairViscosity &) const;
  mutable std::map<std::pair<int, int>, PairViscosity> known_viscosity;
  struct Coefficients {    // of a pair: before (e.u*)^2 and its complement, likewise for the spins
    Real along, across, spin_along, spin_across;
  };
  Coefficients coefficients(const Pair &pair, const std::string &form) const;
  SmallMatrix shear_block(const Pair &pair, const std::string &form) const;
  Real bulk_amplitude(int k, const std::string &form, const std::string &shear_form) const;
  Vector zeta_limit(const std::string &shear_form) const;    // per particle, negative
  Sparse density_rate_rows() const;                          // cdot = rows * u

  Model model;
  Particles atoms;
  Kernel kernel;
  Real mean_distance;
  int N, n;
  std::vector<Pair> pairs;
  Vector w, c, cdot, V;    // c = sum of w_j W, V = w/c
};

}    // namespace DenseReference

#endif
