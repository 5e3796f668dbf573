/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the SPH-DISSIPATION authors
------------------------------------------------------------------------- */

#include "compute_sph_gauge.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "math_extra.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_kernel.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_model.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

ComputeSPHGauge::ComputeSPHGauge(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg)
{
  if (!Fields::of(atom))
    error->all(FLERR, "Compute {} requires atom style sph/bulk or sph/micropolar", style);

  const int dim = domain->dimension;
  for (Keywords key(lmp, fmt::format("Compute {}", style), 3, narg, arg); key.next();) {
    const bool pressure = key.is("pressure", "x y z"), level = key.is("level", "x y z");
    if (!pressure && !level) continue;
    Gauge gauge = {{}, -1};
    for (int d = 0; d < 3; d++)
      if (level && strcmp(key.word(d), "NULL") == 0) {
        if (gauge.axis >= 0 || d >= dim)
          error->all(FLERR, "Compute {} level: NULL must stand for one coordinate of the box",
                     style);
        gauge.axis = d;
      } else {
        gauge.place[d] = key.number(d);
        if (d >= dim && gauge.place[d] != 0.0)
          error->all(FLERR, "Compute {} {}: z must be 0 in 2d", style, key.name());
      }
    if (level && gauge.axis < 0)
      error->all(FLERR, "Compute {} level: NULL must stand for the coordinate along the level",
                 style);
    gauges.push_back(gauge);
  }
  if (gauges.empty()) error->all(FLERR, "Compute {} needs at least one pressure or level", style);

  vector_flag = 1;
  size_vector = static_cast<int>(gauges.size());
  extvector = 0;
  vector = new double[size_vector];
}

/* ---------------------------------------------------------------------- */

ComputeSPHGauge::~ComputeSPHGauge()
{
  delete[] vector;
}

/* ---------------------------------------------------------------------- */

void ComputeSPHGauge::init()
{
  const int dim = find_fluid(lmp, fmt::format("Compute {}", style))->dimension();
  if (dim != domain->dimension)
    error->all(FLERR, "Compute {} needs a kernel of the dimension of the simulation, not dim {}",
               style, dim);
  for (const Gauge &gauge : gauges)
    for (int d = 0; d < dim; d++)
      if (domain->periodicity[d] && d != gauge.axis &&
          std::fabs(gauge.place[d] - domain->boxlo[d] - 0.5 * domain->prd[d]) >
              1.5 * domain->prd[d])
        error->all(FLERR,
                   "Compute {}: place {:g} is outside of the periodic box by more than its length",
                   style, gauge.place[d]);
}

/* ----------------------------------------------------------------------
   Pressure: sum_f V_f p_f W / (1 - sum_w V_w W).  So space without fluid has the pressure 0, and the part of the kernel in
   walls does not count.  Level: sum_f V_f W_(n-1), the length of the fluid along the axis, with the kernel of the dimension
   across.
------------------------------------------------------------------------- */

void ComputeSPHGauge::compute_vector()
{
  invoked_vector = update->ntimestep;
  constexpr double LEAST = 0.01;    // of the kernel outside of walls; below, the place is in a wall

  const Fluid *const fluid = find_fluid(lmp, fmt::format("Compute {}", style));
  if (!fluid->has_forces())
    error->all(FLERR, "Compute {} needs the densities of the present particles: use run 0 first",
               style);
  const FluidModel &model = *fluid->model;
  const double support = fluid->support_radius();
  const auto pressure = fluid->pressures();

  const int n = size_vector;
  std::vector<double> mine(2 * n, 0.0), sum(2 * n);    // of the fluid, of walls
  for (int i = 0; i < atom->nlocal; i++) {
    const int type = atom->type[i];
    if (!fluid->has_type(type)) continue;
    const bool wall = fluid->is_boundary(i);
    if (!wall && !(atom->mask[i] & groupbit)) continue;
    for (int k = 0; k < n; k++) {
      const Gauge &gauge = gauges[k];
      const bool level = gauge.axis >= 0;
      if (level && wall) continue;
      double place[3], image[3], r[3];
      std::copy_n(gauge.place, 3, place);
      if (level) place[gauge.axis] = atom->x[i][gauge.axis];
      domain->closest_image(place, atom->x[i], image);
      MathExtra::sub3(image, place, r);
      if (level) r[gauge.axis] = 0.0;
      const double rsq = MathExtra::lensq3(r);
      if (rsq >= support * support) continue;
      const double W = kernel_weight(model.choice.kernel, fluid->dimension() - (level ? 1 : 0),
                                     std::sqrt(rsq), support);
      if (wall)
        mine[n + k] += atom->rmass[i] / model.coeffs[type].eos.rho0 * W;
      else
        mine[k] += atom->vfrac[i] * W * (level ? 1.0 : pressure(i));
    }
  }
  MPI_Allreduce(mine.data(), sum.data(), 2 * n, MPI_DOUBLE, MPI_SUM, world);
  for (int k = 0; k < n; k++) {
    const double free = 1.0 - sum[n + k];
    vector[k] = (free > LEAST) ? sum[k] / free : 0.0;
  }
}
