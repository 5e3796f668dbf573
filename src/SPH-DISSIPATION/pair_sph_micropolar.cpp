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

#include "pair_sph_micropolar.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_coeffs.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_table.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

enum { MU, MU_R, GAMMA1, GAMMA2 };    // numbers of VISCOSITIES
const std::string PairSPHMicropolar::NAME = "sph/micropolar";
const std::vector<std::string> PairSPHMicropolar::VISCOSITIES = {"mu", "mu_r", "gamma1", "gamma2"};

/* ---------------------------------------------------------------------- */

PairSPHMicropolar::PairSPHMicropolar(LAMMPS *lmp) :
    PairSPHBulk(lmp, NAME, VISCOSITIES), smallest_inertia(0.0)
{
}

/* ---------------------------------------------------------------------- */

Shear PairSPHMicropolar::default_shear() const
{
  return Shear::MICROPOLAR;
}

/* ---------------------------------------------------------------------- */

PairCoeff PairSPHMicropolar::pair_coefficients(int i, int j) const
{
  return micropolar_coefficients(dim, model->viscosity(MU, i, j), model->viscosity(MU_R, i, j),
                                 model->viscosity(GAMMA1, i, j), model->viscosity(GAMMA2, i, j));
}

/* ---------------------------------------------------------------------- */

double PairSPHMicropolar::intrinsic_kappa_of(int i, int j) const
{
  return intrinsic_kappa_micropolar(dim, model->viscosity(MU, i, j), model->viscosity(MU_R, i, j));
}

/* ----------------------------------------------------------------------
   torques that begin during a run would meet particles whose inertia nobody has checked
------------------------------------------------------------------------- */

void *PairSPHMicropolar::extract(const char *name, int &ndim)
{
  if (strcmp(name, "mu") != 0 && model->is_viscosity(name) >= 0 && !has_torques()) return nullptr;
  return PairSPHBulk::extract(name, ndim);
}

/* ---------------------------------------------------------------------- */

bool PairSPHMicropolar::has_torques() const
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = 1; j <= atom->ntypes; j++)
      for (int k : {MU_R, GAMMA1, GAMMA2})
        if (model->viscosity(k, i, j) != 0.0) return true;
  return false;
}

/* ---------------------------------------------------------------------- */

void PairSPHMicropolar::check_setup()
{
  if (model->dimension() == 1)
    error->all(FLERR, Error::NOLASTLINE, "Pair_style {} needs dim 2 or 3: no spin in dim 1",
               fluid_style);
  PairSPHBulk::check_setup();

  if (domain->dimension != 2) return;
  const auto tilted = first_particle(lmp, [this](int i) {
    const double *const omega = atom->omega[i];
    return !model->coeffs[atom->type[i]].other && (omega[0] != 0.0 || omega[1] != 0.0);
  });
  if (!tilted.empty())
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style {}: spin must be along z in 2d, which that of {} is not", fluid_style,
               tilted);
}

/* ---------------------------------------------------------------------- */

void PairSPHMicropolar::find_smallest_inertia()
{
  const double *const inertia = spin_inertia();
  double smallest = UNLIMITED_STEP;
  for (int i = 0; i < atom->nlocal; i++)
    if (inertia[i] > 0.0 && !model->coeffs[atom->type[i]].other)
      smallest = std::min(smallest, inertia[i]);
  MPI_Allreduce(&smallest, &smallest_inertia, 1, MPI_DOUBLE, MPI_MIN, world);
}

/* ---------------------------------------------------------------------- */

void PairSPHMicropolar::check_pair(int i, int j)
{
  const double mu = model->viscosity(MU, i, j), mu_r = model->viscosity(MU_R, i, j);
  const double gamma1 = model->viscosity(GAMMA1, i, j), gamma2 = model->viscosity(GAMMA2, i, j);
  if (const char *violated = inadmissible(dim, mu, 0.0, mu_r, gamma1, gamma2))
    error->all(FLERR, Error::NOLASTLINE,
               "Pair_coeff {}, not mu = {} mu_r = {} gamma1 = {} gamma2 = {} of types {} {}",
               violated, mu, mu_r, gamma1, gamma2, j, i);
}

/* ---------------------------------------------------------------------- */

Columns PairSPHMicropolar::table_columns(int i, int j, double kappa, double zeta) const
{
  const PairCoeff coeff = pair_coefficients(i, j);
  return {{"mu", model->viscosity(MU, i, j)},
          {"kappa", kappa},
          {"mu_r", model->viscosity(MU_R, i, j)},
          {"gamma1", model->viscosity(GAMMA1, i, j)},
          {"gamma2", model->viscosity(GAMMA2, i, j)},
          {"zeta", zeta},
          {"zeta1", coeff.along_r},
          {"zeta2", coeff.along_u},
          {"xi1", coeff.xi1},
          {"xi2", coeff.xi2}};
}

/* ---------------------------------------------------------------------- */

Columns PairSPHMicropolar::viscous_steps(int i, int j, double hsq, double rho) const
{
  const PairCoeff coeff = pair_coefficients(i, j);
  const double rho_inertia = rho * smallest_inertia;
  return {{"shear", micropolar_step(dim, hsq, rho, coeff.along_r, coeff.along_u)},
          {"vortex", vortex_step(rho_inertia, coeff.along_u)},
          {"spin", micropolar_step(dim, hsq, rho_inertia, coeff.xi1, coeff.xi2)}};
}

/* ---------------------------------------------------------------------- */

double **PairSPHMicropolar::extrapolated_spin()
{
  return Fields::of(atom)->omegaest;
}

const double *PairSPHMicropolar::spin_inertia()
{
  return Fields::of(atom)->inertia;
}
