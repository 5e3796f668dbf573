/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "configuration.h"

#include <algorithm>
#include <cmath>

static constexpr double SPACING = 0.35;
static constexpr double REST_DENSITY = 1.2;

/* ---------------------------------------------------------------------- */

DenseReference::Box Configuration::reference_box() const
{
  DenseReference::Box box;
  box.lattice = DenseReference::Matrix::Zero(dim, dim);
  for (int k = 0; k < dim; k++)
    box.lattice(k, k) = static_cast<DenseReference::Real>(hi[k]) - lo[k];
  if (dim > 1) box.lattice(0, 1) = tilt[0];
  if (dim > 2) {
    box.lattice(0, 2) = tilt[1];
    box.lattice(1, 2) = tilt[2];
  }
  box.periodic = {periodic, periodic, periodic};
  return box;
}

DenseReference::Particles Configuration::reference_particles() const
{
  DenseReference::Particles particles;
  particles.x.resize(dim, size());
  particles.v.resize(dim, size());
  for (int i = 0; i < size(); i++) {
    for (int k = 0; k < dim; k++) {
      particles.x(k, i) = x[3 * i + k];
      particles.v(k, i) = v[3 * i + k];
    }
  }
  if (!spin.empty()) {
    const int rows = dim == 3 ? 3 : 1;
    particles.spin.resize(rows, size());
    for (int i = 0; i < size(); i++)
      for (int k = 0; k < rows; k++) particles.spin(k, i) = spin[3 * i + 3 - rows + k];
  }
  particles.mass.assign(mass.begin(), mass.end());
  particles.energy.assign(energy.begin(), energy.end());
  particles.type = type;
  particles.wall = wall;
  return particles;
}

/* ---------------------------------------------------------------------- */

static double default_support(int dim)
{
  const double spacings[3] = {4.1, 3.1, 2.4};
  return spacings[dim - 1] * SPACING;
}

static void add_particle(Configuration &config, const std::array<double, 3> &x, Random &random)
{
  config.x.insert(config.x.end(), x.begin(), x.end());
  for (int k = 0; k < 3; k++) config.v.push_back(k < config.dim ? random() : 0.0);
  const double mass = REST_DENSITY * std::pow(SPACING, config.dim) * (1.0 + 0.4 * random());
  config.mass.push_back(mass);
  config.energy.push_back(mass * (2.0 + random()));
  config.type.push_back(1 + std::min(2, static_cast<int>(1.5 * (random() + 1.0))));
}

Configuration periodic_fluid(int dim, bool triclinic, unsigned seed)
{
  const int cells_of_dim[3][3] = {{121, 1, 1}, {16, 13, 1}, {7, 6, 5}};
  const int *cells = cells_of_dim[dim - 1];

  Random random(seed);
  Configuration config;
  config.dim = dim;
  config.periodic = true;
  config.support = default_support(dim);
  for (int k = 0; k < 3; k++) {
    // the line of particles has y = 0 in a box that is wider than the support
    config.lo[k] = k < dim ? -0.3 * SPACING * cells[k] : (k == 1 ? -2.0 : -0.5);
    config.hi[k] = k < dim ? config.lo[k] + SPACING * cells[k] : -config.lo[k];
  }
  config.tilt = {0.0, 0.0, 0.0};
  if (triclinic) config.tilt = {0.3 * (config.hi[0] - config.lo[0]), 0.0, 0.0};
  if (triclinic && dim == 3)
    for (int k = 1; k < 3; k++)
      config.tilt[k] = (k == 1 ? -0.2 : 0.25) * (config.hi[k - 1] - config.lo[k - 1]);

  for (int c = 0; c < cells[2]; c++) {
    for (int b = 0; b < cells[1]; b++) {
      for (int a = 0; a < cells[0]; a++) {
        const int cell[3] = {a, b, c};
        // fractional coordinates, jittered by 0.3 of a cell and kept off the faces of the box
        double s[3] = {0.0, 0.0, 0.0};
        for (int k = 0; k < dim; k++) s[k] = (cell[k] + 0.5 + 0.3 * random()) / cells[k];
        std::array<double, 3> x = {0.0, 0.0, 0.0};
        for (int k = 0; k < dim; k++) x[k] = config.lo[k] + s[k] * (config.hi[k] - config.lo[k]);
        if (dim > 1) x[0] += config.tilt[0] * s[1];
        if (dim > 2) {
          x[0] += config.tilt[1] * s[2];
          x[1] += config.tilt[2] * s[2];
        }
        add_particle(config, x, random);
      }
    }
  }
  return config;
}

/* ---------------------------------------------------------------------- */

Configuration free_drop(int dim, unsigned seed)
{
  const double radii[3] = {60.0, 8.0, 3.7};
  const double radius = radii[dim - 1] * SPACING;

  Random random(seed);
  Configuration config;
  config.dim = dim;
  config.periodic = false;
  config.support = default_support(dim);
  config.tilt = {0.0, 0.0, 0.0};
  for (int k = 0; k < 3; k++) {
    config.lo[k] = k < dim ? -1.3 * radius : (k == 1 ? -2.0 : -0.5);
    config.hi[k] = -config.lo[k];
  }

  const int reach = static_cast<int>(std::ceil(radii[dim - 1]));
  for (int c = (dim > 2 ? -reach : 0); c <= (dim > 2 ? reach : 0); c++) {
    for (int b = (dim > 1 ? -reach : 0); b <= (dim > 1 ? reach : 0); b++) {
      for (int a = -reach; a <= reach; a++) {
        const int cell[3] = {a, b, c};
        std::array<double, 3> x = {0.0, 0.0, 0.0};
        for (int k = 0; k < dim; k++) x[k] = SPACING * (cell[k] + 0.3 * random());
        if (std::hypot(x[0], x[1], x[2]) < radius) add_particle(config, x, random);
      }
    }
  }
  return config;
}

Configuration by_mass(Configuration config)
{
  config.volume_by_mass = true;
  return config;
}

void add_spins(Configuration &config, unsigned seed)
{
  Random random(seed);
  config.spin.resize(config.x.size());
  for (std::size_t k = 0; k < config.spin.size(); k++)
    config.spin[k] = (config.dim == 3 || k % 3 == 2) ? 2.0 * random() : 0.0;
}

Configuration within(const Configuration &full, double radius)
{
  Configuration config = full;
  for (auto *field : {&config.x, &config.v, &config.mass, &config.energy, &config.spin})
    field->clear();
  config.type.clear();
  for (int i = 0; i < full.size(); i++) {
    const double *x = &full.x[3 * i];
    if (std::hypot(x[0], x[1], x[2]) > radius) continue;
    config.x.insert(config.x.end(), x, x + 3);
    config.v.insert(config.v.end(), &full.v[3 * i], &full.v[3 * i] + 3);
    if (!full.spin.empty())
      config.spin.insert(config.spin.end(), &full.spin[3 * i], &full.spin[3 * i] + 3);
    config.mass.push_back(full.mass[i]);
    config.energy.push_back(full.energy[i]);
    config.type.push_back(full.type[i]);
  }
  return config;
}

void set_rigid_motion(Configuration &config, const std::array<double, 3> &translation,
                      const std::array<double, 3> &omega)
{
  for (int i = 0; i < config.size(); i++) {
    const double *x = &config.x[3 * i];
    for (int k = 0; k < config.dim; k++) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      config.v[3 * i + k] = translation[k] + omega[l] * x[m] - omega[m] * x[l];
    }
  }
}

/* ---------------------------------------------------------------------- */

std::vector<DenseReference::Fluid> test_fluids()
{
  DenseReference::Fluid water{1.2, 2.0, 0.5, 1.9};
  water.pb = 0.7;
  DenseReference::Fluid thick{1.1, 1.7, 0.9, 3.1};
  thick.pb = -0.3;
  thick.gamma = 3.5;
  DenseReference::Fluid thin{1.3, 2.2, 0.2, 0.25};
  return {water, thick, thin};
}
