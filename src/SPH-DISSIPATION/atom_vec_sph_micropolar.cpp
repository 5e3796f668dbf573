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

#include "atom_vec_sph_micropolar.h"

#include "atom.h"
#include "error.h"

using namespace LAMMPS_NS;

// names known to compute property/atom beyond those of sph/bulk, and the first index they get

static constexpr const char *PROPERTY[] = {"inertia", "omegaestx", "omegaesty", "omegaestz"};
enum { INERTIA, OMEGAESTX, OMEGAESTY, OMEGAESTZ, NPROPERTY };
static constexpr int FIRST = 100;

/* ---------------------------------------------------------------------- */

AtomVecSPHMicropolar::AtomVecSPHMicropolar(LAMMPS *lmp) : AtomVecSPHMicropolar(lmp, COMPLETE) {}

/* ---------------------------------------------------------------------- */

AtomVecSPHMicropolar::AtomVecSPHMicropolar(LAMMPS *lmp, Complete complete) :
    AtomVec(lmp), AtomVecSPHBulk(lmp, TO_BE_EXTENDED), inertia(nullptr), omegaest(nullptr)
{
  add_array("inertia", &inertia);
  add_array("omegaest", &omegaest, 3);

  atom->omega_flag = 1;
  atom->torque_flag = 1;

  fields_grow.insert(fields_grow.end(), {"omega", "torque"});
  for (auto *fields : {&fields_copy, &fields_create})
    fields->insert(fields->end(), {"omega", "torque", "inertia", "omegaest"});
  fields_exchange.insert(fields_exchange.end(), {"omega", "inertia", "omegaest"});
  for (auto *fields : {&fields_comm, &fields_comm_vel, &fields_border, &fields_border_vel})
    fields->push_back("omegaest");
  fields_reverse.push_back("torque");
  fields_restart.insert(fields_restart.end(), {"omega", "inertia", "omegaest"});
  fields_data_atom = {"id", "type", "rmass", "inertia", "esph", "x"};
  fields_data_vel = {"id", "v", "omega"};

  if (complete == COMPLETE) setup_fields();
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHMicropolar::data_atom_post(int ilocal)
{
  AtomVecSPHBulk::data_atom_post(ilocal);
  if (!(inertia[ilocal] >= 0.0))
    error->one(FLERR, "Invalid inertia {} in Atoms section of data file: must be >= 0",
               inertia[ilocal]);
  for (int d = 0; d < 3; d++) omegaest[ilocal][d] = atom->omega[ilocal][d] = 0.0;
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHMicropolar::clear_derived(int ilocal)
{
  AtomVecSPHBulk::clear_derived(ilocal);
  for (int d = 0; d < 3; d++) atom->torque[ilocal][d] = 0.0;
}

/* ---------------------------------------------------------------------- */

int AtomVecSPHMicropolar::property_atom(const std::string &name)
{
  for (int index = 0; index < NPROPERTY; index++)
    if (name == PROPERTY[index]) return FIRST + index;
  return AtomVecSPHBulk::property_atom(name);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHMicropolar::pack_property_atom(int index, double *buf, int nvalues, int groupbit)
{
  if (index < FIRST) return AtomVecSPHBulk::pack_property_atom(index, buf, nvalues, groupbit);

  const int *mask = atom->mask;
  for (int i = 0, n = 0; i < atom->nlocal; i++, n += nvalues) {
    if (!(mask[i] & groupbit))
      buf[n] = 0.0;
    else if (index == FIRST + INERTIA)
      buf[n] = inertia[i];
    else
      buf[n] = omegaest[i][index - FIRST - OMEGAESTX];
  }
}
