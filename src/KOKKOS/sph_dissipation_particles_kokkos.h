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

#ifndef LMP_SPH_DISSIPATION_PARTICLES_KOKKOS_H
#define LMP_SPH_DISSIPATION_PARTICLES_KOKKOS_H

#include "atom_kokkos.h"
#include "atom_vec_sph_bulk_kokkos.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Arrays on the device, see TimeStep.

  template <class DeviceType> struct ParticlesKokkos {
    typedef Kokkos::View<double *, Kokkos::LayoutRight, DeviceType> t_field;
    typedef Kokkos::View<double *[3], Kokkos::LayoutRight, DeviceType> t_field_3;
    typedef ArrayTypes<DeviceType> AT;

    typename AT::t_kkfloat_1d_3_lr x;
    typename AT::t_kkfloat_1d_3 v, omega;
    typename AT::t_kkacc_1d_3 f, torque;
    typename AT::t_int_1d mask;
    typename AT::t_kkfloat_1d rmass;
    t_field esph, desph, desph_before, inertia;
    t_field_3 vest, omegaest;
    bool has_spins;

    ParticlesKokkos(AtomKokkos *atoms)
    {
      x = atoms->k_x.template view<DeviceType>();
      v = atoms->k_v.template view<DeviceType>();
      f = atoms->k_f.template view<DeviceType>();
      mask = atoms->k_mask.template view<DeviceType>();
      rmass = atoms->k_rmass.template view<DeviceType>();
      const auto &avec = AtomVecSPHBulkKokkos::of(atoms);
      esph = avec.k_esph.template view<DeviceType>();
      desph = avec.k_desph.template view<DeviceType>();
      desph_before = avec.k_desph_before.template view<DeviceType>();
      vest = avec.k_vest.template view<DeviceType>();
      has_spins = avec.has_spins;
      if (!has_spins) return;
      omega = atoms->k_omega.template view<DeviceType>();
      torque = atoms->k_torque.template view<DeviceType>();
      inertia = avec.k_inertia.template view<DeviceType>();
      omegaest = avec.k_omegaest.template view<DeviceType>();
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
