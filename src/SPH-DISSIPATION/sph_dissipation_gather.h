/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifndef LMP_SPH_DISSIPATION_GATHER_H
#define LMP_SPH_DISSIPATION_GATHER_H

#include <mpi.h>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // what all processors have, in their order

  template <class T>
  std::vector<T> gather_all(MPI_Comm world, const std::vector<T> &mine, MPI_Datatype type)
  {
    int nprocs, n = static_cast<int>(mine.size()), total = 0;
    MPI_Comm_size(world, &nprocs);
    std::vector<int> counts(nprocs), starts(nprocs);
    MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
    for (int p = 0; p < nprocs; p++) {
      starts[p] = total;
      total += counts[p];
    }
    std::vector<T> all(total);
    MPI_Allgatherv(mine.data(), n, type, all.data(), counts.data(), starts.data(), type, world);
    return all;
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
