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

#include "sph_dissipation_boundary_kokkos.h"

#include "atom_kokkos.h"
#include "atom_vec_sph_bulk_kokkos.h"
#include "neighbor.h"
#include "pair.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_masks_kokkos.h"
#include "sph_dissipation_sums_kokkos.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

template <class DeviceType>
BoundaryStageKokkos<DeviceType>::BoundaryStageKokkos(LAMMPS *lmp, Pair *pair,
                                                     BoundaryStage &stage) :
    Pointers(lmp),
    pair(pair), stage(stage), boundary(), bits(0), surface_step(-1), nrows(0)
{
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
void BoundaryStageKokkos<DeviceType>::run(LoopDataKokkos<DeviceType> &data, int inum)
{
  const bool found = (neighbor->ago == 0 || bits != stage.bits());
  with_kernel(data.par.kernel, [&](auto kernel) {
    typedef decltype(kernel) K;
    if (found) {
      find_particles(data);
      find_rows(data, inum);
      find_surface<K>(data);
      boundaries.clear();
      for (Boundary *one : stage.all())
        boundaries.push_back(dynamic_cast<BoundaryKokkos<DeviceType> *>(one));
    }

    const bool before = (!found && surface_step != update->ntimestep);
    surface_step = update->ntimestep;
    for (auto *one : boundaries) one->move_surface_kokkos(boundary, before);
    sum_fluid<K>(data);
    check<K>(data);
  });
  for (auto *one : boundaries) one->set_boundary_kokkos(boundary, data);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
void BoundaryStageKokkos<DeviceType>::find_particles(const LoopDataKokkos<DeviceType> &data)
{
  bits = stage.bits();
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  const int some = bits;
  const ParticleRows fluid = data;
  auto all_of = [&](int n) {
    int found = 0;
    Kokkos::parallel_reduce(
        "sph:boundary", Range(0, n),
        KOKKOS_LAMBDA(int i, int &total) { total += (fluid.mask[i] & some) ? 1 : 0; }, found);
    return found;
  };
  boundary.nowned = all_of(nlocal);
  boundary.nall = all_of(nall);

  boundary.number = {};
  boundary.number = decltype(boundary.number)(Kokkos::NoInit("sph:boundary_number"), nall);
  auto number = boundary.number;
  boundary.particles = decltype(boundary.particles)(Kokkos::NoInit("sph:boundary"), boundary.nall);
  boundary.surface =
      decltype(boundary.surface)(Kokkos::NoInit("sph:boundary_surface"), boundary.nall);
  boundary.sum = decltype(boundary.sum)(Kokkos::NoInit("sph:boundary_sum"), boundary.nowned);
  boundary.near = decltype(boundary.near)(Kokkos::NoInit("sph:boundary_near"), boundary.nall);

  boundary.excess = {};
  boundary.excess = decltype(boundary.excess)("sph:boundary_excess", nall);

  const bool repels = fluid.par.continuity;
  const double contact_norm = ContactKernel::norm(fluid.par.dim);
  boundary.contact = {};
  boundary.occupied = {};
  if (repels) {
    boundary.contact =
        decltype(boundary.contact)(Kokkos::NoInit("sph:boundary_contact"), boundary.nall);
    boundary.occupied = decltype(boundary.occupied)("sph:boundary_occupied", nall);
  }

  auto particles = boundary.particles;
  auto near = boundary.near;
  auto contact = boundary.contact;
  Kokkos::parallel_scan(
      "sph:boundary", Range(0, nall), KOKKOS_LAMBDA(int i, int &k, bool last) {
        const bool is_boundary = fluid.mask[i] & some;
        if (last) {
          number(i) = is_boundary ? k : -1;
          if (is_boundary) {
            particles(k) = i;
            const double volume = fluid.particle[i].vol;
            near(k) = near_kernel(fluid.par.dim, fluid.par.support, fluid.par.weight_norm, volume);
            if (repels)
              contact(k) = contact_kernel(fluid.par.dim, fluid.par.support, contact_norm, volume);
          }
        }
        if (is_boundary) k++;
      });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
void BoundaryStageKokkos<DeviceType>::find_rows(const LoopDataKokkos<DeviceType> &data, int inum)
{
  auto ilist = data.ilist;
  auto numneigh = data.numneigh;
  auto neighbors = data.neighbors;
  auto number = boundary.number;
  if ((int) rows.extent(0) < inum) {
    rows = {};
    rows = decltype(rows)(Kokkos::NoInit("sph:boundary_rows"), atom->nmax);
  }
  auto found = rows;
  auto excess = boundary.excess;
  Kokkos::parallel_scan(
      "sph:boundary_rows", Range(0, inum),
      KOKKOS_LAMBDA(int ii, int &k, bool last) {
        const int i = ilist(ii);
        if (number(i) >= 0) return;
        const int jnum = numneigh(i);
        for (int jj = 0; jj < jnum; jj++)
          if (number(neighbors(i, jj) & NEIGHMASK) >= 0) {
            if (last) {
              found(k) = i;
              excess(i).crosses = 1.0;
            }
            k++;
            return;
          }
      },
      nrows);
}

/* ----------------------------------------------------------------------
   Vectors toward the fluid on the device, as SurfaceStage::find_sides(); the rest on the host: it needs
   pairs of boundary particles, which the neighbor list does not have, only when this is built, and for
   boundary particles alone
------------------------------------------------------------------------- */

template <class DeviceType>
template <class K>
void BoundaryStageKokkos<DeviceType>::find_surface(const LoopDataKokkos<DeviceType> &data)
{
  Kokkos::View<double *[3], Kokkos::LayoutRight, DeviceType> side("sph:boundary_side",
                                                                  boundary.nowned);
  auto particles = boundary.particles;
  auto number = boundary.number;
  auto loop = data;
  Kokkos::parallel_for(
      "sph:boundary_side", Range(0, boundary.nowned), KOKKOS_LAMBDA(int k) {
        for_neighbors(loop, particles(k), [&](int j, const double *r, double rsq) {
          if (number(j) >= 0) return;
          const double slope = loop.par.slope_norm * K::slope(Kokkos::sqrt(rsq) / loop.par.support);
          for (int d = 0; d < 3; d++) side(k, d) -= slope * r[d];
        });
      });
  const auto h_side = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), side);

  auto *const atomKK = (AtomKokkos *) atom;
  atomKK->modified(pair->execution_space, VFRAC_MASK);
  atomKK->sync(Host, X_MASK | MASK_MASK | VFRAC_MASK);
  const ExecutionSpace space = pair->execution_space;
  pair->execution_space = Host;    // where it communicates
  const Surface *const surface =
      stage.find_surface(std::vector<double>(h_side.data(), h_side.data() + h_side.size()));
  pair->execution_space = space;

  auto h_surface = Kokkos::create_mirror_view(boundary.surface);
  const auto h_particles =
      Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), boundary.particles);
  for (int k = 0; k < boundary.nall; k++) h_surface(k) = surface[h_particles(k)];
  Kokkos::deep_copy(boundary.surface, h_surface);
}

/* ----------------------------------------------------------------------
   as BoundaryStage::set_excess(): on the device, no boundary has symmetric friction
------------------------------------------------------------------------- */

template <class DeviceType>
void BoundaryStageKokkos<DeviceType>::set_excess(LoopDataKokkos<DeviceType> &data)
{
  data.excess = boundary.excess.data();
  if (update->whichflag == 2) return;
  auto vest = AtomVecSPHBulkKokkos::of(atom).k_vest.template view<DeviceType>();
  auto particles = boundary.particles;
  auto surface = boundary.surface;
  auto excess = boundary.excess;
  const LoopDataKokkos<DeviceType> loop = data;
  Kokkos::parallel_for(
      "sph:boundary_excess", Range(0, boundary.nall), KOKKOS_LAMBDA(int k) {
        const int i = particles(k);
        Excess &one = excess(i);
        one.is_boundary = one.crosses = 1.0;
        for (int d = 0; d < 3; d++) {
          one.u[d] = loop.particle[i].u[d] - vest(i, d);
          if (loop.spin) one.w[d] = loop.spin[i].w[d] - surface(k).omega[d];
        }
      });
}

/* ----------------------------------------------------------------------
   each boundary particle sums up its own fluid
------------------------------------------------------------------------- */

template <class DeviceType>
template <class K>
void BoundaryStageKokkos<DeviceType>::sum_fluid(const LoopDataKokkos<DeviceType> &data)
{
  auto particles = boundary.particles;
  auto number = boundary.number;
  auto surface = boundary.surface;
  auto sum = boundary.sum;
  const bool with_heat = stage.conducts();
  if (with_heat && (int) boundary.heat_sum.extent(0) != boundary.nowned)
    boundary.heat_sum =
        decltype(boundary.heat_sum)(Kokkos::NoInit("sph:boundary_heat_sum"), boundary.nowned);
  auto heat_sum = boundary.heat_sum;
  auto loop = data;
  Kokkos::parallel_for(
      "sph:boundary_sum", Range(0, boundary.nowned), KOKKOS_LAMBDA(int k) {
        const Particle w = loop.particle[particles(k)];
        const Surface s = surface(k);
        BoundarySum total = {};
        BoundaryHeatSum heat = {};
        const double conductivity = loop.types[loop.type[particles(k)]].flow[HEAT_FLOW];
        for_neighbors(loop, particles(k), [&](int j, const double *r, double rsq) {
          if (number(j) >= 0) return;
          const Particle &f = loop.particle[j];
          const double kernel_weight =
              loop.par.weight_norm * K::shape(Kokkos::sqrt(rsq) / loop.par.support);
          const double height = add_fluid(f, w, r, kernel_weight, s, loop.rho[j],
                                          loop.weight[j * loop.each], loop.zeta_term[j], total);
          if (loop.spin) add_fluid_spin(loop.spin[j].w, f.vol * kernel_weight, height, s, total);
          if (with_heat)
            add_fluid_heat(loop.flow[HEAT_FLOW][j], f.vol * kernel_weight,
                           loop.par.slope_norm * K::slope(Kokkos::sqrt(rsq) / loop.par.support),
                           height, conductivity, heat);
        });
        sum(k) = total;
        if (with_heat) heat_sum(k) = heat;
      });
}

// heat per time that the particle f of the fluid gets by the boundary particle w, r = x_w - x_f

namespace {
template <class DeviceType, class K> struct SurfaceHeat {
  LoopDataKokkos<DeviceType> loop;
  Kokkos::View<int *, DeviceType> number;
  Kokkos::View<Surface *, DeviceType> surface;

  KOKKOS_INLINE_FUNCTION double operator()(int f, int w, const double *r, double rsq) const
  {
    const double flux = loop.flow[HEAT_FLOW][w].flux;
    if (flux == 0.0 || !(loop.flow[HEAT_FLOW][f].coefficient > 0.0)) return 0.0;
    const double slope = loop.par.slope_norm * K::slope(Kokkos::sqrt(rsq) / loop.par.support);
    return surface_heat(flux, loop.particle[f].vol, r, slope, surface(number(w)));
  }
};
}    // namespace

/* ----------------------------------------------------------------------
   each particle sums up its own pairs
------------------------------------------------------------------------- */

template <class DeviceType>
void BoundaryStageKokkos<DeviceType>::add_surface_heat(const LoopDataKokkos<DeviceType> &data,
                                                       double *flow)
{
  with_kernel(data.par.kernel, [&](auto kernel) {
    sum_surface_heat<decltype(kernel)>(data, flow);
  });
}

template <class DeviceType>
template <class K>
void BoundaryStageKokkos<DeviceType>::sum_surface_heat(const LoopDataKokkos<DeviceType> &data,
                                                       double *flow)
{
  auto list = rows;
  auto particles = boundary.particles;
  auto number = boundary.number;
  auto surface = boundary.surface;
  auto loop = data;
  const SurfaceHeat<DeviceType, K> heat_of = {loop, number, surface};
  Kokkos::parallel_for(
      "sph:surface_heat", Range(0, nrows), KOKKOS_LAMBDA(int k) {
        const int i = list(k);
        double total = 0.0;
        for_neighbors(loop, i, [&](int j, const double *r, double rsq) {
          if (number(j) < 0) return;
          const double to_wall[3] = {-r[0], -r[1], -r[2]};
          total += heat_of(i, j, to_wall, rsq);
        });
        loop.desph[i] += total;
      });
  Kokkos::parallel_for(
      "sph:surface_heat_given", Range(0, boundary.nowned), KOKKOS_LAMBDA(int k) {
        const int i = particles(k);
        if (loop.flow[HEAT_FLOW][i].flux == 0.0) return;
        double total = 0.0;
        for_neighbors(loop, i, [&](int j, const double *r, double rsq) {
          if (number(j) < 0) total += heat_of(j, i, r, rsq);
        });
        flow[i] = -total;
        loop.desph[i] -= total;
      });
}

/* ----------------------------------------------------------------------
   how much of the support of a particle of the fluid boundary particles fill; the first particle that is inside a wall
   stops the run
------------------------------------------------------------------------- */

template <class DeviceType>
template <class K>
void BoundaryStageKokkos<DeviceType>::check(const LoopDataKokkos<DeviceType> &data)
{
  auto list = rows;
  auto number = boundary.number;
  auto near = boundary.near;
  auto contact = boundary.contact;
  auto occupied = boundary.occupied;
  const bool repels = data.par.continuity;
  auto loop = data;
  int first;
  Kokkos::parallel_reduce(
      "sph:boundary_check", Range(0, nrows),
      KOKKOS_LAMBDA(int k, int &smallest) {
        const int i = list(k);
        double filled = 0.0, touched = 0.0;
        for_neighbors(loop, i, [&](int j, const double *, double rsq) {
          if (number(j) < 0) return;
          const double distance = Kokkos::sqrt(rsq);
          filled += near(number(j)).template at<K>(distance);
          if (repels) touched += contact(number(j)).template at<ContactKernel>(distance);
        });
        if (repels) occupied(i) = touched;
        if (filled > INSIDE_WALL && i < smallest) smallest = i;
      },
      Kokkos::Min<int>(first));
  if (first >= atom->nlocal) return;
  ((AtomKokkos *) atom)->sync(Host, TAG_MASK | X_MASK | V_MASK);
  stage.stop_for(first);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
RepulsionKokkos<DeviceType>
BoundaryStageKokkos<DeviceType>::repulsion(const LoopDataKokkos<DeviceType> &data) const
{
  return {data, boundary, rows, nrows};
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double BoundaryStageKokkos<DeviceType>::memory_usage() const
{
  return (double) (boundary.number.extent(0) + rows.extent(0)) * sizeof(int) +
      (double) boundary.nall * (sizeof(int) + sizeof(Surface) + sizeof(NearKernel)) +
      (double) boundary.nowned * sizeof(BoundarySum) +
      (double) boundary.excess.extent(0) * sizeof(Excess) +
      (double) boundary.contact.extent(0) * sizeof(NearKernel) +
      (double) boundary.occupied.extent(0) * sizeof(double) +
      (double) boundary.heat_sum.extent(0) * sizeof(BoundaryHeatSum);
}

/* ---------------------------------------------------------------------- */

namespace LAMMPS_NS {
namespace SPHDissipation {
  template class BoundaryStageKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
  template class BoundaryStageKokkos<LMPHostType>;
#endif
}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
