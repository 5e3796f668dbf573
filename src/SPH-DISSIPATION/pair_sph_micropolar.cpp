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
#include "atom_vec_sph_micropolar.h"
#include "domain.h"
#include "error.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_table.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

const std::string PairSPHMicropolar::NAME = "sph/micropolar";
/* ---------------------------------------------------------------------- */

PairSPHMicropolar::PairSPHMicropolar(LAMMPS *lmp) : PairSPHBulk(lmp, NAME, true) {}

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

AtomVecSPHMicropolar *PairSPHMicropolar::spinning() const
{
  return dynamic_cast<AtomVecSPHMicropolar *>(atom->style_match(fluid_style.c_str()));
}

double **PairSPHMicropolar::extrapolated_spin()
{
  return spinning()->omegaest;
}

const double *PairSPHMicropolar::spin_inertia()
{
  return spinning()->inertia;
}
