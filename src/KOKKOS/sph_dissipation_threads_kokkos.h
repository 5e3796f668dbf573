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

#ifndef LMP_SPH_DISSIPATION_THREADS_KOKKOS_H
#define LMP_SPH_DISSIPATION_THREADS_KOKKOS_H

#include "kokkos_type.h"
#include "sph_dissipation_threads.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // the threads of the KOKKOS package on the host

  class ThreadsKokkos : public Threads {
   public:
    int size() const override { return LMPHostType().concurrency(); }
    void run(const std::function<void(int)> &task) override
    {
      Kokkos::parallel_for("sph:threads", Kokkos::RangePolicy<LMPHostType>(0, size()), [&](int k) {
        task(k);
      });
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
