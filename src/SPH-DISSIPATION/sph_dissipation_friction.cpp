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

#include "sph_dissipation_fluid.h"

#include "atom.h"
#include "error.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_model.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// The friction of a fluid without and with spins: its coefficients, and what follows from them

enum { MU, MU_R, GAMMA1, GAMMA2 };    // numbers of the viscosities

/* ---------------------------------------------------------------------- */

std::vector<std::string> Fluid::viscosity_names(bool spins)
{
  if (spins) return {"mu", "mu_r", "gamma1", "gamma2"};
  return {"mu"};
}

/* ---------------------------------------------------------------------- */

Shear Fluid::default_shear() const
{
  return spins ? Shear::MICROPOLAR : Shear::MG;
}

/* ---------------------------------------------------------------------- */

PairCoeff Fluid::pair_coefficients(int i, int j) const
{
  if (spins)
    return micropolar_coefficients(dim, model->viscosity(MU, i, j), model->viscosity(MU_R, i, j),
                                   model->viscosity(GAMMA1, i, j), model->viscosity(GAMMA2, i, j));
  return shear_coefficients(model->choice.shear, dim, model->viscosity(MU, i, j),
                            kernel_mean_radius(model->choice.kernel, dim, support));
}

/* ---------------------------------------------------------------------- */

double Fluid::intrinsic_kappa_of(int i, int j) const
{
  if (spins)
    return intrinsic_kappa_micropolar(dim, model->viscosity(MU, i, j),
                                      model->viscosity(MU_R, i, j));
  return intrinsic_kappa(model->choice.shear, dim, model->viscosity(MU, i, j));
}

/* ---------------------------------------------------------------------- */

double Fluid::bulk_viscosity(int type) const
{
  return (model->choice.bulk == Bulk::NONE) ? intrinsic_kappa_of(type, type)
                                            : model->coeffs[type].kappa;
}

/* ---------------------------------------------------------------------- */

bool Fluid::has_torques() const
{
  if (!spins) return false;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = 1; j <= atom->ntypes; j++)
      for (int k : {MU_R, GAMMA1, GAMMA2})
        if (model->viscosity(k, i, j) != 0.0) return true;
  return false;
}

/* ---------------------------------------------------------------------- */

void Fluid::check_pair(int i, int j) const
{
  const double mu = model->viscosity(MU, i, j);
  if (!spins) {
    if (model->choice.shear == Shear::NONE && mu != 0.0)
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair_coeff mu must be 0 with shear none, not {} for types {} {}", mu, j, i);
    return;
  }
  const double mu_r = model->viscosity(MU_R, i, j);
  const double gamma1 = model->viscosity(GAMMA1, i, j), gamma2 = model->viscosity(GAMMA2, i, j);
  if (const char *violated = inadmissible(dim, mu, 0.0, mu_r, gamma1, gamma2))
    error->all(FLERR, Error::NOLASTLINE,
               "Pair_coeff {}, not mu = {} mu_r = {} gamma1 = {} gamma2 = {} of types {} {}",
               violated, mu, mu_r, gamma1, gamma2, j, i);
}

/* ---------------------------------------------------------------------- */

Columns Fluid::table_columns(int i, int j, double kappa, double zeta) const
{
  const PairCoeff coeff = pair_coefficients(i, j);
  if (!spins)
    return {{"mu", model->viscosity(MU, i, j)},
            {"kappa", kappa},
            {"zeta", zeta},
            {"shear_coeff", std::max(coeff.along_r, coeff.along_u)}};
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

Columns Fluid::viscous_steps(int i, int j, double hsq, double rho) const
{
  if (!spins)
    return {{"shear", shear_step(model->choice.shear, hsq, model->viscosity(MU, i, j) / rho)}};
  const PairCoeff coeff = pair_coefficients(i, j);
  const double rho_inertia = rho * smallest_inertia;
  return {{"shear", micropolar_step(dim, hsq, rho, coeff.along_r, coeff.along_u)},
          {"vortex", vortex_step(rho_inertia, coeff.along_u)},
          {"spin", micropolar_step(dim, hsq, rho_inertia, coeff.xi1, coeff.xi2)}};
}

/* ---------------------------------------------------------------------- */

void Fluid::find_smallest_inertia()
{
  if (!spins) return;
  const double *const inertia = spin_inertia();
  double smallest = UNLIMITED_STEP;
  for (int i = 0; i < atom->nlocal; i++)
    if (inertia[i] > 0.0 && has_type(atom->type[i])) smallest = std::min(smallest, inertia[i]);
  MPI_Allreduce(&smallest, &smallest_inertia, 1, MPI_DOUBLE, MPI_MIN, world);
}

/* ---------------------------------------------------------------------- */

double **Fluid::extrapolated_spin() const
{
  return spins ? Fields::of(atom)->omegaest : nullptr;
}

const double *Fluid::spin_inertia() const
{
  return spins ? Fields::of(atom)->inertia : nullptr;
}
