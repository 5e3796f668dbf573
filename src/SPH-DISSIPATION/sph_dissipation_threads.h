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

#ifndef LMP_SPH_DISSIPATION_THREADS_H
#define LMP_SPH_DISSIPATION_THREADS_H

// Threads of one process that share its work.  No LAMMPS include.

#include <functional>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Here there is one; those of the KOKKOS package derive from it.

  class Threads {
   public:
    virtual ~Threads() = default;
    virtual int size() const { return 1; }

    // task(k) on each thread k < size()
    virtual void run(const std::function<void(int)> &task) { task(0); }

    // task(i) for each i < n, the same part of them on the same thread
    template <class Task> void for_each(int n, const Task &task)
    {
      const auto part = [&](int k, int parts) {
        const auto to = static_cast<int>(static_cast<long long>(n) * (k + 1) / parts);
        for (auto i = static_cast<int>(static_cast<long long>(n) * k / parts); i < to; i++) task(i);
      };
      const int parts = size();
      if (parts == 1) return part(0, 1);
      run([&](int k) {
        part(k, parts);
      });
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
