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

#ifndef LMP_SPH_DISSIPATION_ARRAYS_KOKKOS_H
#define LMP_SPH_DISSIPATION_ARRAYS_KOKKOS_H

// Loops and arrays of host and device

#include "kokkos_type.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Call function(i) for each i < n, on DeviceType

  template <class DeviceType, class Function>
  void for_each(const char *name, int n, const Function &function)
  {
    Kokkos::parallel_for(name, Kokkos::RangePolicy<DeviceType>(0, n), function);
  }

  // Call function with an object of the class for the host (HostKK) or for the device

  template <class Function> void on(ExecutionSpace space, Function &&function)
  {
    if (space == HostKK)
      function(LMPHostType());
    else
      function(LMPDeviceType());
  }

  // Free the old array, and allocate one of n entries without values

  template <class View> void renew(View &view, const char *name, int n)
  {
    view = View();
    view = View(Kokkos::NoInit(name), n);
  }

  // Renew the array if it has fewer than n entries; return a pointer to the first entry

  template <class View> auto *reach(View &view, const char *name, int n)
  {
    if ((int) view.extent(0) < n) renew(view, name, n);
    return view.data();
  }

  template <class... View> double bytes_of(const View &...view)
  {
    return (... + ((double) view.size() * sizeof(typename View::non_const_value_type)));
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
