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

#include "sph_dissipation_rigid.h"

#include "comm.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_engine.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ----------------------------------------------------------------------
   Call function(motions, first row) for the motions of each boundary with bodies.
------------------------------------------------------------------------- */

template <class Function> void RigidStage::for_motions(const Function &function) const
{
  int first = 0;
  for (auto one : boundary.all())
    if (RigidMotions *const motions = one->rigid_motions()) {
      function(*motions, first);
      first += RigidMotions::WIDTH * motions->size();
    }
}

/* ---------------------------------------------------------------------- */

void RigidStage::find(bool starts)
{
  for (std::vector<double> *one : {&rows.mass, &rows.before, &rows.guess, &rows.others})
    one->clear();
  for_motions([&](RigidMotions &motions, int) {
    motions.append(starts, rows);
  });
  values.resize(count());
}

int RigidStage::size() const
{
  return (comm->me == 0) ? count() : 0;
}

/* ---------------------------------------------------------------------- */

void RigidStage::send(const double *mine)
{
  if (comm->me == 0) std::copy_n(mine, count(), values.begin());
  if (count()) MPI_Bcast(values.data(), count(), MPI_DOUBLE, 0, world);
}

void RigidStage::velocities(const double *mine,
                            const std::function<void(int, const double *)> &function)
{
  send(mine);
  for_motions([&](RigidMotions &motions, int first) {
    motions.velocities(&values[first], function);
  });
}

void RigidStage::act(const double *mine)
{
  send(mine);
  for_motions([&](RigidMotions &motions, int first) {
    motions.act(&values[first]);
  });
}

/* ---------------------------------------------------------------------- */

const double *RigidStage::forces(const std::function<const double *(int)> &force)
{
  std::fill(values.begin(), values.end(), 0.0);
  for_motions([&](RigidMotions &motions, int first) {
    motions.add_forces(force, &values[first]);
  });
  if (count()) MPI_Allreduce(MPI_IN_PLACE, values.data(), count(), MPI_DOUBLE, MPI_SUM, world);
  return values.data();
}

/* ---------------------------------------------------------------------- */

double RigidStage::memory_usage() const
{
  return bytes(rows.mass, rows.before, rows.guess, rows.others, values);
}
