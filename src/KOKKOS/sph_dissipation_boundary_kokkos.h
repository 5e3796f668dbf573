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

#ifndef LMP_SPH_DISSIPATION_BOUNDARY_KOKKOS_H
#define LMP_SPH_DISSIPATION_BOUNDARY_KOKKOS_H

// Boundary particles on the device, as class BoundaryStage has them on the host

#include "kokkos_type.h"
#include "pointers.h"

#include "sph_dissipation_boundary.h"
#include "sph_dissipation_loops_kokkos.h"
#include "sph_dissipation_wall_terms.h"

#include <vector>

namespace LAMMPS_NS {
class Pair;

namespace SPHDissipation {
  class BoundaryStage;

  // The boundary particles, owned ones first, and what belongs to them by their number in this list

  template <class DeviceType> struct BoundaryDataKokkos {
    int nowned, nall;
    Kokkos::View<int *, DeviceType> particles;
    Kokkos::View<int *, DeviceType> number;    // of each owned and ghost particle; -1: it is fluid
    Kokkos::View<Surface *, DeviceType> surface;
    Kokkos::View<BoundarySum *, DeviceType> sum;             // of owned ones
    Kokkos::View<BoundaryHeatSum *, DeviceType> heat_sum;    // the same; empty if nothing conducts
    Kokkos::View<NearKernel *, DeviceType> near;
  };

  // As class Boundary, whose functions these are on the device

  template <class DeviceType> class BoundaryKokkos {
   public:
    virtual void move_surface_kokkos(const BoundaryDataKokkos<DeviceType> &, bool before) = 0;
    virtual void set_boundary_kokkos(const BoundaryDataKokkos<DeviceType> &,
                                     const LoopDataKokkos<DeviceType> &) = 0;

   protected:
    ~BoundaryKokkos() = default;
  };

  template <class DeviceType> class BoundaryStageKokkos : protected Pointers {
   public:
    BoundaryStageKokkos(class LAMMPS *, Pair *, BoundaryStage &);

    // after the pressures, before pass 2: sets the values of owned boundary particles for it, which
    // the pair style sends to ghosts
    void run(LoopDataKokkos<DeviceType> &, int inum);

    // after the conduction: heat of surfaces, as BoundaryStage::add_surface_heat(); flow is set of boundary particles,
    // the heat per time that they get, and heating of LAMMPS of the fluid

    void add_surface_heat(const LoopDataKokkos<DeviceType> &, double *flow);

    double memory_usage() const;

    // public because CUDA asks for it of functions with lambdas

    void find_particles(const LoopDataKokkos<DeviceType> &);
    void find_rows(const LoopDataKokkos<DeviceType> &, int inum);
    template <class K> void find_surface(const LoopDataKokkos<DeviceType> &);
    template <class K> void sum_fluid(const LoopDataKokkos<DeviceType> &);
    template <class K> void check(const LoopDataKokkos<DeviceType> &);
    template <class K> void sum_surface_heat(const LoopDataKokkos<DeviceType> &, double *flow);

   private:
    typedef Kokkos::RangePolicy<DeviceType> Range;

    Pair *pair;
    BoundaryStage &stage;
    BoundaryDataKokkos<DeviceType> boundary;
    std::vector<BoundaryKokkos<DeviceType> *> boundaries;
    int bits;               // of the groups that the lists are for
    bigint surface_step;    // that the normals of the surface are for

    // particles of the fluid that may have boundary particles in their support until the list is
    // built anew

    Kokkos::View<int *, DeviceType> rows;
    int nrows;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
