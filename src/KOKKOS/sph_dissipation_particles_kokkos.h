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
#include "atom_vec_sph_micropolar_kokkos.h"
#include "sph_dissipation_integrate.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // What the integrator does to particles on the device; the views of fields that there are not are
  // empty.

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
    bool spinning;

    ParticlesKokkos(AtomKokkos *atoms)
    {
      x = atoms->k_x.template view<DeviceType>();
      v = atoms->k_v.template view<DeviceType>();
      f = atoms->k_f.template view<DeviceType>();
      mask = atoms->k_mask.template view<DeviceType>();
      rmass = atoms->k_rmass.template view<DeviceType>();
      auto *bulk = dynamic_cast<AtomVecSPHBulkKokkos *>(atoms->avec);
      esph = bulk->k_esph.template view<DeviceType>();
      desph = bulk->k_desph.template view<DeviceType>();
      desph_before = bulk->k_desph_before.template view<DeviceType>();
      vest = bulk->k_vest.template view<DeviceType>();
      auto *micropolar = dynamic_cast<AtomVecSPHMicropolarKokkos *>(atoms->avec);
      spinning = (micropolar != nullptr);
      if (!spinning) return;
      omega = atoms->k_omega.template view<DeviceType>();
      torque = atoms->k_torque.template view<DeviceType>();
      inertia = micropolar->k_inertia.template view<DeviceType>();
      omegaest = micropolar->k_omegaest.template view<DeviceType>();
    }

    KOKKOS_INLINE_FUNCTION void begin(const TimeStep &step, int i) const
    {
      const double dtfm = step.dtf / rmass(i);
      step.begin_energy(desph(i), esph(i), desph_before(i));
      for (int d = 0; d < 3; d++) step.begin(dtfm, f(i, d), x(i, d), v(i, d), vest(i, d));
      if (!spinning) return;
      const double dti = step.dtf * TimeStep::inverse_inertia(rmass(i), inertia(i));
      for (int d = 0; d < 3; d++) step.begin_spin(dti, torque(i, d), omega(i, d), omegaest(i, d));
    }

    KOKKOS_INLINE_FUNCTION void end(const TimeStep &step, int i) const
    {
      const double dtfm = step.dtf / rmass(i);
      step.end_energy(desph(i), desph_before(i), esph(i));
      for (int d = 0; d < 3; d++) step.end(dtfm, f(i, d), v(i, d));
      if (!spinning) return;
      const double dti = step.dtf * TimeStep::inverse_inertia(rmass(i), inertia(i));
      for (int d = 0; d < 3; d++) step.end(dti, torque(i, d), omega(i, d));
    }

    KOKKOS_INLINE_FUNCTION void follow(const TimeStep &step, int i) const
    {
      for (int d = 0; d < 3; d++) vest(i, d) = step.keep * v(i, d);
      if (!spinning) return;
      for (int d = 0; d < 3; d++) omegaest(i, d) = omega(i, d);
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
