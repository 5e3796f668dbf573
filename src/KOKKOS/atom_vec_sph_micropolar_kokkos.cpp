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

#include "atom_vec_sph_micropolar_kokkos.h"

#include "atom_kokkos.h"
#include "sph_dissipation_masks_kokkos.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

AtomVecSPHMicropolarKokkos::AtomVecSPHMicropolarKokkos(LAMMPS *lmp) :
    AtomVec(lmp), AtomVecSPHBulk(lmp, IN_VIEWS), AtomVecSPHBulkKokkos(lmp, TO_BE_EXTENDED),
    AtomVecSPHMicropolar(lmp, TO_BE_EXTENDED)
{
  AtomKokkos &atoms = *atomKK;
  add_field(OMEGA_MASK, atoms.k_omega, atoms.omega);
  add_field(TORQUE_MASK, atoms.k_torque, atoms.torque);
  add_own_field(INERTIA_MASK, k_inertia, inertia, {EXCHANGE});
  add_own_field(OMEGAEST_MASK, k_omegaest, omegaest, {COMM, BORDER, EXCHANGE});
  setup_views();
}

/* ---------------------------------------------------------------------- */

AtomVecSPHMicropolarKokkos::~AtomVecSPHMicropolarKokkos()
{
  free_views();
}
