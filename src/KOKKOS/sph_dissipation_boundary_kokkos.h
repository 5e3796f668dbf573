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

// Boundary particles on the device, as class BoundaryStage on the host

#include "pointers.h"
#include "sph_dissipation_arrays_kokkos.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_sums_kokkos.h"
#include "sph_dissipation_wall_terms.h"

#include <vector>

namespace LAMMPS_NS {
class Pair;

namespace SPHDissipation {
  // The boundary particles, owned ones first, and their values, by the number in this list unless noted

  template <class DeviceType> struct BoundaryDataKokkos {
    int nowned, nall;
    int symmetric,
        summed;    // bits of the groups with symmetric friction; with sums over the fluid
    Kokkos::View<int *, DeviceType> particles;
    Kokkos::View<int *, DeviceType> number;    // of each owned and ghost particle; -1: no boundary
    Kokkos::View<Surface *, DeviceType> surface;
    Kokkos::View<BoundarySum *, DeviceType> sum;             // of owned particles
    Kokkos::View<BoundaryHeatSum *, DeviceType> heat_sum;    // of owned; empty if nothing conducts
    Kokkos::View<NearKernel *, DeviceType> near;
    Kokkos::View<Excess *, DeviceType> excess;    // of each owned and ghost particle

    // body that the fluid moves, 0: a wall; of owned particles, number density from the other particles of the body

    Kokkos::View<int *, DeviceType> body;
    Kokkos::View<double *, DeviceType> of_body;

    // with repulsion: contact kernels; filled part of the contact support of each owned and ghost particle; energy of owned
    // particles of the fluid in the forces of walls

    Kokkos::View<NearKernel *, DeviceType> contact;
    Kokkos::View<double *, DeviceType> occupied, energy;

    // fluid particles that may have boundary particles in their support until the next neighbor list

    Kokkos::View<int *, DeviceType> rows;
    int nrows;

    // Return the number of entries of loops over pairs of fluid and boundary: first the particles in rows, then the owned
    // boundary particles; each entry sums up its own pairs

    int size() const { return nrows + nowned; }
    KOKKOS_INLINE_FUNCTION bool is_wall(int k) const { return k >= nrows; }
    KOKKOS_INLINE_FUNCTION int particle(int k) const
    {
      return is_wall(k) ? particles(k - nrows) : rows(k);
    }
  };

  // Pairs of a loop: those with symmetric friction, by the entries of BoundaryDataKokkos::size()

  template <class DeviceType> struct SurfacePairsKokkos {
    BoundaryDataKokkos<DeviceType> boundary;

    KOKKOS_INLINE_FUNCTION int particle(const LoopDataKokkos<DeviceType> &, int k) const
    {
      return boundary.particle(k);
    }

    // Call function(j, r, rsq, V_i, V_j, surface_factor()) for each pair

    template <class Function>
    KOKKOS_FORCEINLINE_FUNCTION void for_each(const LoopDataKokkos<DeviceType> &data, int k,
                                              const Function &function) const
    {
      const bool is_wall = boundary.is_wall(k);
      const int i = boundary.particle(k);
      for_neighbors(data, i, [&](int j, const double *r, double rsq) {
        const int w = is_wall ? i : j, f = is_wall ? j : i;
        if (!(data.mask[w] & boundary.symmetric) || boundary.number(f) >= 0) return;
        const double vol_w = data.reference_volume(w), vol_f = data.particle[f].vol;
        const double to_wall = is_wall ? 1.0 : -1.0;
        const double from_fluid[3] = {to_wall * r[0], to_wall * r[1], to_wall * r[2]};
        function(
            j, r, rsq, is_wall ? vol_w : vol_f, is_wall ? vol_f : vol_w,
            surface_factor(boundary.surface(boundary.number(w)), from_fluid, data.par.support));
      });
    }
  };

  // Symmetric friction, as BoundaryStage::add_friction(), in the frame of the boundary, with all heat for the fluid

  template <class DeviceType, class K, class Form> struct SurfaceFrictionKokkos {
    LoopDataKokkos<DeviceType> data;
    SurfacePairsKokkos<DeviceType> pairs;

    template <bool VIRIAL> KOKKOS_INLINE_FUNCTION int row(int k, double *virial) const
    {
      const auto &boundary = pairs.boundary;
      const bool is_wall = boundary.is_wall(k);
      const int i = boundary.particle(k);
      double total[3] = {0.0, 0.0, 0.0}, torque[3] = {0.0, 0.0, 0.0}, heat[NCHANNEL] = {};
      pairs.for_each(
          data, k,
          [&](int j, const double *r, double rsq, double vol_i, double vol_j, double factor) {
            const int w = is_wall ? i : j;
            PairState pair = {};
            double turn[3];
            cross_product(boundary.surface(boundary.number(w)).omega, r, turn);
            for (int d = 0; d < 3; d++) {
              pair.r[d] = r[d];
              pair.u[d] = data.particle[i].u[d] - data.particle[j].u[d] - turn[d];
            }
            const double slope =
                factor * data.par.slope_norm * K::slope(square_root(rsq) / data.par.support);
            pair.coeff = data.pair[data.type[i] * data.par.ntypes_1 + data.type[j]].a;
            pair.approach = dot(pair.r, pair.u);
            pair.vv = volumes_slope(rsq, vol_i, vol_j, slope);
            if constexpr (Form::CENTRAL)
              pair.by_metric = pair.vv / (metric_of<Form::BY_DISTANCE>(rsq) + TINY);
            Form::add_central(pair);
            for (int d = 0; d < 3; d++) pair.f[d] = pair.central * pair.r[d];
            if constexpr (Form::SPINS) {
              double own[3], other[3];
              for (int d = 0; d < 3; d++) {
                own[d] = data.spin[i].w[d] - data.spin[w].w[d];
                other[d] = data.spin[j].w[d] - data.spin[w].w[d];
                pair.s[d] = own[d] - other[d];
              }
              slip_velocity(own, other, pair.r, pair.u);
            }
            Form::add_vector(pair);
            for (int d = 0; d < 3; d++) total[d] += pair.f[d];
            if constexpr (Form::SPINS)
              for (int d = 0; d < 3; d++) torque[d] += pair.t[d] - pair.spin[d];
            for (int c = 0; c < NCHANNEL; c++) heat[c] += 2.0 * pair.heat[c];
            if constexpr (VIRIAL) add_virial(pair.r, pair.f, virial);
          });
      for (int d = 0; d < 3; d++) data.f(i, d) += total[d];
      if constexpr (Form::SPINS)
        for (int d = 0; d < 3; d++) data.torque(i, d) += torque[d];
      for (int c = 0; c < NCHANNEL && !is_wall; c++) {
        data.heat(i, c) += heat[c];
        data.desph[i] += heat[c];
      }
      return i;
    }
  };

  // Repulsion of the surfaces, as BoundaryStage::repel(): after pass 2, when ghosts have `occupied` of their owners.  With
  // noise, the pressure of walls has an energy as well

  template <class DeviceType, class K> struct RepulsionKokkos {
    LoopDataKokkos<DeviceType> data;
    BoundaryDataKokkos<DeviceType> boundary;
    double thermal_stiffness;    // with thermal noise

    template <bool VIRIAL> KOKKOS_INLINE_FUNCTION int row(int k, double *virial) const
    {
      const bool is_wall = boundary.is_wall(k);
      const int i = boundary.particle(k);
      const bool presses = data.par.thermal;
      const double s_i = is_wall ? 0.0 : beyond_surface(boundary.occupied(i));
      double energy = is_wall ? 0.0 : energy_of_repulsion(repulsion(i), s_i);
      if (!is_wall) boundary.energy(i) = energy;
      if (!is_wall && !presses && !(s_i > 0.0)) return i;
      const Particle &pi = data.particle[i];
      double total[3] = {0.0, 0.0, 0.0}, heat = 0.0;
      for_neighbors(data, i, [&](int j, const double *r, double rsq) {
        if ((boundary.number(j) >= 0) == is_wall) return;
        const double force = is_wall ? push(j, i, rsq) : push(i, j, rsq);
        const Particle &pj = data.particle[j];
        double pressing = 0.0;
        if (presses && !is_wall && !(data.mask[j] & data.body_bits)) {
          const double q = Kokkos::sqrt(rsq) / data.par.support;
          const double ww = data.weight[i * data.each] * data.weight[j * data.each] * pj.g;
          pressing = ww * data.par.slope_norm * K::slope(q);
          energy += ww * data.par.weight_norm * K::shape(q);
        }
        const double f[3] = {force * r[0], force * r[1], force * r[2]};
        for (int d = 0; d < 3; d++) {
          total[d] += f[d];
          heat -= (f[d] + pressing * r[d]) * (pi.u[d] - pj.u[d]);
        }
        if constexpr (VIRIAL) add_virial(f, r, virial);
      });
      for (int d = 0; d < 3; d++) data.f(i, d) += total[d];
      if (is_wall) return i;
      data.desph[i] += heat;
      boundary.energy(i) = energy;
      return i;
    }

    KOKKOS_INLINE_FUNCTION Repulsion repulsion(int fluid) const
    {
      if (data.par.thermal) return {thermal_stiffness, 0.0};
      return repulsion_of_surface(data.rmass[fluid], data.types[data.type[fluid]].eos.c0);
    }

    // Return the force of a pair over its distance

    KOKKOS_INLINE_FUNCTION double push(int fluid, int wall, double rsq) const
    {
      const double s = beyond_surface(boundary.occupied(fluid));
      if (!(s > 0.0)) return 0.0;
      return force_of_repulsion(repulsion(fluid), s, boundary.contact(boundary.number(wall)),
                                Kokkos::sqrt(rsq));
    }
  };

  // Heat of surfaces, see BoundaryStageKokkos::add_surface_heat()

  template <class DeviceType, class K> struct SurfaceHeatKokkos {
    LoopDataKokkos<DeviceType> data;
    BoundaryDataKokkos<DeviceType> boundary;
    double *flow;

    KOKKOS_INLINE_FUNCTION void operator()(int k) const
    {
      const FlowRow *const heat = data.flow[HEAT_FLOW];
      const bool is_wall = boundary.is_wall(k);
      const int i = boundary.particle(k);
      if (is_wall && heat[i].flux == 0.0) return;
      const double to_wall = is_wall ? 1.0 : -1.0;
      double total = 0.0;    // heat per time of the fluid
      for_neighbors(data, i, [&](int j, const double *from_j, double rsq) {
        if ((boundary.number(j) >= 0) == is_wall) return;
        const int f = is_wall ? j : i, w = is_wall ? i : j;
        if (heat[w].flux == 0.0 || !(heat[f].coefficient > 0.0)) return;
        const double r[3] = {to_wall * from_j[0], to_wall * from_j[1], to_wall * from_j[2]};
        const double slope = data.par.slope_norm * K::slope(Kokkos::sqrt(rsq) / data.par.support);
        total += surface_heat(heat[w].flux, data.particle[f].vol, r, slope,
                              boundary.surface(boundary.number(w)));
      });
      flow[i] -= to_wall * total;
    }
  };

  // Interface of a fix with boundary particles on the device: functions of class Boundary

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
    BoundaryStageKokkos(class LAMMPS *lmp, Pair *pair, DeviceSpace<DeviceType> &space,
                        BoundaryStage &stage) :
        Pointers(lmp),
        pair(pair), space(space), stage(stage)
    {
    }

    // After the pressures, before pass 2: set the values of all boundary particles, and the excess, for the heat in pass 2
    void run();

    // For ViscousStage, see BoundaryStage; with viscous, no boundary on a device has symmetric friction

    int bits() const { return stage.bits(); }
    bool has_mean_pressure() const { return stage.has_mean_pressure(); }
    void note_pressures();
    void extend(bool increments);
    void add_linear_friction() {}

    // After the conduction: add the heat of surfaces to the heat per time that particles get, as
    // BoundaryStage::add_surface_heat()

    void add_surface_heat(const LoopDataKokkos<DeviceType> &, double *flow);

    // Return the boundary particles of the last run()
    const BoundaryDataKokkos<DeviceType> &particles() const { return boundary; }

    double memory_usage() const;

    // public, because CUDA requires this of functions with lambdas

    void set_excess(LoopDataKokkos<DeviceType> &);
    void find_particles(const LoopDataKokkos<DeviceType> &);
    void end_friction(const LoopDataKokkos<DeviceType> &);
    void find_rows(const LoopDataKokkos<DeviceType> &, int inum);
    template <class K> void find_surface(const LoopDataKokkos<DeviceType> &);
    template <class K> void sum_fluid(const LoopDataKokkos<DeviceType> &);
    template <class K> void check(const LoopDataKokkos<DeviceType> &);

   private:
    typedef Kokkos::RangePolicy<DeviceType> Range;

    Pair *pair;
    DeviceSpace<DeviceType> &space;
    BoundaryStage &stage;
    BoundaryDataKokkos<DeviceType> boundary = {};
    std::vector<BoundaryKokkos<DeviceType> *> boundaries;
    Kokkos::View<int *, DeviceType> pushes;    // see BoundaryStage, by number
    int listed_bits = 0;         // of the groups of the boundary particles in the lists
    bigint surface_step = -1;    // step of the normals of the surface
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
