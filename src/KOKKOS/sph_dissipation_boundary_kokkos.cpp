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
#include "sph_dissipation_masks.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

template <class DeviceType> void BoundaryStageKokkos<DeviceType>::run()
{
  LoopDataKokkos<DeviceType> &data = *space.data;
  const bool found = (neighbor->ago == 0 || listed_bits != stage.bits());
  with_kernel(data.par.kernel, [&](auto kernel) {
    typedef decltype(kernel) K;
    if (found) {
      find_particles(data);
      find_rows(data, pair->list->inum);
      find_surface<K>(data);
      boundaries.clear();
      for (Boundary *one : stage.all())
        boundaries.push_back(dynamic_cast<BoundaryKokkos<DeviceType> *>(one));
    }
    const bool before = (!found && surface_step != update->ntimestep);
    surface_step = update->ntimestep;
    for (auto *one : boundaries) one->move_surface_kokkos(boundary, before);
    check<K>(data);
  });
  extend(false);
  set_excess(data);
}

/* ----------------------------------------------------------------------
   Set the values of owned boundary particles, and send them to ghosts.  The message is redundant for ghosts of the fluid.
------------------------------------------------------------------------- */

template <class DeviceType> void BoundaryStageKokkos<DeviceType>::extend(bool increments)
{
  LoopDataKokkos<DeviceType> &data = *space.data;
  const bool bodies_begin = data.par.continuity && update->setupflag;
  boundary.summed = bodies_begin ? bits() : bits() & ~stage.bits_of_bodies();
  with_kernel(data.par.kernel, [&](auto kernel) {
    sum_fluid<decltype(kernel)>(data);
  });
  for (auto *one : boundaries) one->set_boundary_kokkos(boundary, data);
  if (increments) {
    const ParticleRows rows = data;
    const auto walls = boundary;
    const auto pushing = pushes;
    for_each<DeviceType>(
        "sph:increments", walls.nowned, KOKKOS_LAMBDA(int k) {
          const int i = walls.particles(k);
          const BoundarySum &sum = walls.sum(k);
          if (!(sum.weight > 0.0)) return;
          rows.particle[i].g = pressure_term(pushing(k) ? sum.pressure / sum.weight : 0.0,
                                             rows.vfrac[i], rows.weight[i * rows.each]);
        });
  }
  if (boundary.symmetric) end_friction(data);
  std::vector<Field> fields = {field(data.particle, data.particle->u, 5),    // u, vol and g
                               {data.zeta_term, 1, 1}};
  if (data.spin) fields.push_back(field(data.spin, data.spin->w, 3));
  FlowRow *const heat = data.flow[HEAT_FLOW];
  if (stage.conducts()) fields.push_back(field(heat, &heat->vol, 4));
  if (boundary.occupied.extent(0)) fields.push_back({boundary.occupied.data(), 1, 1});
  space.forward(fields);
}

template <class DeviceType> void BoundaryStageKokkos<DeviceType>::note_pressures()
{
  if ((int) pushes.extent(0) != boundary.nowned)
    renew(pushes, "sph:boundary_pushes", boundary.nowned);
  const ParticleRows rows = *space.data;
  const auto walls = boundary;
  const auto pushing = pushes;
  for_each<DeviceType>(
      "sph:boundary_pushes", walls.nowned, KOKKOS_LAMBDA(int k) {
        pushing(k) = (rows.particle[walls.particles(k)].g > 0.0 || rows.par.tension) ? 1 : 0;
      });
}

/* ----------------------------------------------------------------------
   Turn off the friction of pass 2 where it is symmetric, see BoundaryStage::extend().
------------------------------------------------------------------------- */

template <class DeviceType>
void BoundaryStageKokkos<DeviceType>::end_friction(const LoopDataKokkos<DeviceType> &data)
{
  const ParticleRows rows = data;
  const auto walls = boundary;
  for_each<DeviceType>(
      "sph:no_friction", walls.nowned, KOKKOS_LAMBDA(int k) {
        const int i = walls.particles(k);
        if (rows.mask[i] & walls.symmetric) rows.particle[i].vol = 0.0;
      });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
void BoundaryStageKokkos<DeviceType>::find_particles(const LoopDataKokkos<DeviceType> &data)
{
  listed_bits = stage.bits();
  boundary.symmetric = stage.bits_of_symmetric_friction();
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost, some = listed_bits;
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

  renew(boundary.number, "sph:boundary_number", nall);
  renew(boundary.particles, "sph:boundary", boundary.nall);
  renew(boundary.surface, "sph:boundary_surface", boundary.nall);
  renew(boundary.sum, "sph:boundary_sum", boundary.nowned);
  renew(boundary.near, "sph:boundary_near", boundary.nall);
  boundary.excess = {};
  boundary.excess = decltype(boundary.excess)("sph:boundary_excess", nall);

  const bool repels = fluid.par.continuity || fluid.par.thermal;
  const double contact_norm = ContactKernel::norm(fluid.par.dim);
  boundary.contact = {};
  boundary.occupied = boundary.energy = {};
  if (repels) {
    renew(boundary.contact, "sph:boundary_contact", boundary.nall);
    boundary.occupied = decltype(boundary.occupied)("sph:boundary_occupied", nall);
    boundary.energy = decltype(boundary.energy)("sph:boundary_energy", nlocal);
  }

  const auto walls = boundary;
  Kokkos::parallel_scan(
      "sph:boundary", Range(0, nall), KOKKOS_LAMBDA(int i, int &k, bool last) {
        const bool is_boundary = fluid.mask[i] & some;
        if (last) {
          walls.number(i) = is_boundary ? k : -1;
          if (is_boundary) {
            walls.particles(k) = i;
            const double volume = fluid.particle[i].vol;
            walls.near(k) =
                near_kernel(fluid.par.dim, fluid.par.support, fluid.par.weight_norm, volume);
            if (repels)
              walls.contact(k) =
                  contact_kernel(fluid.par.dim, fluid.par.support, contact_norm, volume);
          }
        }
        if (is_boundary) k++;
      });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
void BoundaryStageKokkos<DeviceType>::find_rows(const LoopDataKokkos<DeviceType> &data, int inum)
{
  if ((int) boundary.rows.extent(0) < inum) renew(boundary.rows, "sph:boundary_rows", atom->nmax);
  const auto loop = data;
  const auto walls = boundary;
  Kokkos::parallel_scan(
      "sph:boundary_rows", Range(0, inum),
      KOKKOS_LAMBDA(int ii, int &k, bool last) {
        const int i = loop.ilist(ii);
        if (walls.number(i) >= 0) return;
        const int jnum = loop.numneigh(i);
        for (int jj = 0; jj < jnum; jj++)
          if (walls.number(loop.neighbors(i, jj) & NEIGHMASK) >= 0) {
            if (last) {
              walls.rows(k) = i;
              walls.excess(i).crosses = 1.0;
            }
            k++;
            return;
          }
      },
      boundary.nrows);
}

/* ----------------------------------------------------------------------
   Find the surface when the neighbor list is new: vectors toward the fluid on the device, as SurfaceStage::find_sides(); the
   rest on the host, since the neighbor list does not have the pairs of boundary particles.
------------------------------------------------------------------------- */

template <class DeviceType>
template <class K>
void BoundaryStageKokkos<DeviceType>::find_surface(const LoopDataKokkos<DeviceType> &data)
{
  Kokkos::View<double *[3], Kokkos::LayoutRight, DeviceType> side("sph:boundary_side",
                                                                  boundary.nowned);
  const auto loop = data;
  const auto walls = boundary;
  for_each<DeviceType>(
      "sph:boundary_side", walls.nowned, KOKKOS_LAMBDA(int k) {
        for_neighbors(loop, walls.particles(k), [&](int j, const double *r, double rsq) {
          if (walls.number(j) >= 0) return;
          const double slope = loop.par.slope_norm * K::slope(Kokkos::sqrt(rsq) / loop.par.support);
          for (int d = 0; d < 3; d++) side(k, d) -= slope * r[d];
        });
      });
  const auto h_side = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), side);

  auto *const atomKK = (AtomKokkos *) atom;
  atomKK->modified(pair->execution_space, VFRAC_MASK);
  const bool bodies = stage.has_bodies();
  const uint64_t shapes = (stage.bits_of_elastic_bodies() && !data.par.continuity) ? OFFSET_MASK
                                                                                   : EMPTY_MASK;
  atomKK->sync(Host, X_MASK | MASK_MASK | VFRAC_MASK | MOLECULE_MASK | shapes);
  const ExecutionSpace space = pair->execution_space;
  pair->execution_space = Host;    // communicate on the host
  const Surface *const surface =
      stage.find_surface(std::vector<double>(h_side.data(), h_side.data() + h_side.size()));
  pair->execution_space = space;

  auto h_surface = Kokkos::create_mirror_view(boundary.surface);
  const auto h_particles =
      Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), boundary.particles);
  for (int k = 0; k < boundary.nall; k++) h_surface(k) = surface[h_particles(k)];
  Kokkos::deep_copy(boundary.surface, h_surface);
  if (!bodies) return;
  atomKK->modified(Host, shapes);
  renew(boundary.body, "sph:boundary_body", boundary.nall);
  renew(boundary.of_body, "sph:boundary_of_body", boundary.nowned);
  const auto body = Kokkos::create_mirror_view(boundary.body);
  const auto of_body = Kokkos::create_mirror_view(boundary.of_body);
  for (int k = 0; k < boundary.nall; k++) body(k) = stage.body(h_particles(k));
  for (int k = 0; k < boundary.nowned; k++) of_body(k) = stage.density_of_body(h_particles(k));
  Kokkos::deep_copy(boundary.body, body);
  Kokkos::deep_copy(boundary.of_body, of_body);
}

/* ----------------------------------------------------------------------
   Set the excess of the boundary particles without symmetric friction.
------------------------------------------------------------------------- */

template <class DeviceType>
void BoundaryStageKokkos<DeviceType>::set_excess(LoopDataKokkos<DeviceType> &data)
{
  data.excess = boundary.excess.data();
  if (update->whichflag == 2) return;
  auto vest = AtomVecSPHBulkKokkos::of(atom).k_vest.template view<DeviceType>();
  const auto loop = data;
  const auto walls = boundary;
  for_each<DeviceType>(
      "sph:boundary_excess", walls.nall, KOKKOS_LAMBDA(int k) {
        const int i = walls.particles(k);
        walls.excess(i).crosses = 1.0;
        if (loop.mask[i] & walls.symmetric) return;
        SPHDissipation::set_excess(walls.excess(i), loop.particle[i], &vest(i, 0),
                                   loop.spin ? loop.spin[i].w : nullptr, walls.surface(k));
      });
}

/* ----------------------------------------------------------------------
   Sum up the fluid around each owned boundary particle.
------------------------------------------------------------------------- */

template <class DeviceType>
template <class K>
void BoundaryStageKokkos<DeviceType>::sum_fluid(const LoopDataKokkos<DeviceType> &data)
{
  const bool with_heat = stage.conducts();
  if (with_heat && (int) boundary.heat_sum.extent(0) != boundary.nowned)
    renew(boundary.heat_sum, "sph:boundary_heat_sum", boundary.nowned);
  const auto loop = data;
  const auto walls = boundary;
  for_each<DeviceType>(
      "sph:boundary_sum", walls.nowned, KOKKOS_LAMBDA(int k) {
        const int i = walls.particles(k);
        if (!(loop.mask[i] & walls.summed) && !with_heat) return;
        const Particle w = loop.particle[i];
        const Surface s = walls.surface(k);
        BoundarySum total = {};
        BoundaryHeatSum heat = {};
        const double conductivity = loop.types[loop.type[i]].flow[HEAT_FLOW];
        for_neighbors(loop, i, [&](int j, const double *r, double rsq) {
          if (walls.number(j) >= 0) return;
          const Particle &f = loop.particle[j];
          const double kernel_weight =
              loop.par.weight_norm * K::shape(Kokkos::sqrt(rsq) / loop.par.support);
          const double height =
              add_fluid(f, w, r, kernel_weight, s, loop.rho[j], loop.weight[j * loop.each],
                        loop.reference_volume(j), loop.zeta_term[j], total);
          if (loop.spin) add_fluid_spin(loop.spin[j].w, f.vol * kernel_weight, height, s, total);
          if (with_heat)
            add_fluid_heat(loop.flow[HEAT_FLOW][j], f.vol * kernel_weight,
                           loop.par.slope_norm * K::slope(Kokkos::sqrt(rsq) / loop.par.support),
                           height, conductivity, heat);
        });
        walls.sum(k) = total;
        if (with_heat) walls.heat_sum(k) = heat;
      });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
void BoundaryStageKokkos<DeviceType>::add_surface_heat(const LoopDataKokkos<DeviceType> &data,
                                                       double *flow)
{
  with_kernel(data.par.kernel, [&](auto kernel) {
    typedef decltype(kernel) K;
    for_each<DeviceType>("sph:surface_heat", boundary.size(),
                         SurfaceHeatKokkos<DeviceType, K>{data, boundary, flow});
  });
}

/* ----------------------------------------------------------------------
   Return whether particle i is inside of one body, or of walls, alone, see BoundaryStage::is_inside().
------------------------------------------------------------------------- */

template <class K, class DeviceType>
static KOKKOS_INLINE_FUNCTION bool is_inside(const LoopDataKokkos<DeviceType> &loop,
                                             const BoundaryDataKokkos<DeviceType> &walls, int i)
{
  bool inside = false;
  for_neighbors(loop, i, [&](int j, const double *, double) {
    if (inside || walls.number(j) < 0) return;
    double part = 0.0;
    for_neighbors(loop, i, [&](int k, const double *, double rsq) {
      const int wall = walls.number(k);
      if (wall >= 0 && walls.body(wall) == walls.body(walls.number(j)))
        part += part_filled<K>(walls.near(wall), Kokkos::sqrt(rsq));
    });
    inside = part > INSIDE_WALL;
  });
  return inside;
}

/* ----------------------------------------------------------------------
   Find the parts of the near and contact supports of fluid particles that boundary particles fill; stop the run at the first
   particle inside a wall.
------------------------------------------------------------------------- */

template <class DeviceType>
template <class K>
void BoundaryStageKokkos<DeviceType>::check(const LoopDataKokkos<DeviceType> &data)
{
  const auto loop = data;
  const auto walls = boundary;
  const bool repels = walls.occupied.extent(0), bodies = stage.has_bodies();
  int first;
  Kokkos::parallel_reduce(
      "sph:boundary_check", Range(0, walls.nrows),
      KOKKOS_LAMBDA(int k, int &smallest) {
        const int i = walls.rows(k);
        double filled = 0.0, touched = 0.0;
        for_neighbors(loop, i, [&](int j, const double *, double rsq) {
          const int wall = walls.number(j);
          if (wall < 0) return;
          const double distance = Kokkos::sqrt(rsq);
          filled += part_filled<K>(walls.near(wall), distance);
          if (repels) touched += part_filled<ContactKernel>(walls.contact(wall), distance);
        });
        if (repels) walls.occupied(i) = touched;
        if (filled > INSIDE_WALL && i < smallest && (!bodies || is_inside<K>(loop, walls, i)))
          smallest = i;
      },
      Kokkos::Min<int>(first));
  if (first >= atom->nlocal) return;
  ((AtomKokkos *) atom)->sync(Host, TAG_MASK | X_MASK | V_MASK);
  stage.stop_for(first);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double BoundaryStageKokkos<DeviceType>::memory_usage() const
{
  return bytes_of(boundary.number, boundary.rows, boundary.particles, boundary.surface,
                  boundary.near, boundary.sum, boundary.excess, boundary.contact, boundary.occupied,
                  boundary.energy, boundary.body, boundary.of_body, boundary.heat_sum);
}

/* ---------------------------------------------------------------------- */

template class SPHDissipation::BoundaryStageKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class SPHDissipation::BoundaryStageKokkos<LMPHostType>;
#endif
