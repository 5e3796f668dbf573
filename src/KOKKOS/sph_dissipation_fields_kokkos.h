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

#ifndef LMP_SPH_DISSIPATION_FIELDS_KOKKOS_H
#define LMP_SPH_DISSIPATION_FIELDS_KOKKOS_H

// A per-atom array on host and device, with the functions that an atom style calls for all arrays.

#include "atom_vec_kokkos.h"
#include "memory_kokkos.h"
#include "sph_dissipation_columns_kokkos.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  class FieldKokkos {
   public:
    typedef Kokkos::BinSort<AtomVecKokkos::KeyViewType, AtomVecKokkos::BinOp> Sorter;

    const uint64_t mask;    // bit in the masks of sync() and modified()
    const bool own;         // belongs to the package, not to class AtomKokkos

    FieldKokkos(uint64_t mask, bool own) : mask(mask), own(own) {}
    virtual ~FieldKokkos() = default;
    virtual void grow(MemoryKokkos *, int) = 0;
    virtual void destroy(MemoryKokkos *) = 0;
    virtual void sync(ExecutionSpace) = 0;
    virtual void modified(ExecutionSpace) = 0;
    virtual void sync_pinned(AtomVecKokkos &, ExecutionSpace, int async_flag) = 0;
    virtual void sort(Sorter &) = 0;
    virtual void add_to(ColumnsKokkos &, ExecutionSpace) const = 0;
  };

  // View: a dual view, or one that LAMMPS also transforms between the layouts of host and device; Pointer: of the CPU styles

  template <class View, class Pointer> class FieldOfKokkos : public FieldKokkos {
   public:
    FieldOfKokkos(uint64_t mask, bool own, View &view, Pointer &pointer) :
        FieldKokkos(mask, own), view(view), pointer(pointer)
    {
    }
    void grow(MemoryKokkos *memory, int n) override
    {
      memory->grow_kokkos(view, pointer, n, "atom:field");
    }
    void destroy(MemoryKokkos *memory) override { memory->destroy_kokkos(view, pointer); }
    void sync(ExecutionSpace space) override
    {
      if (space == Device) return view.sync_device();
      if constexpr (TRANSFORMS)
        if (space == HostKK) return view.sync_hostkk();
      view.sync_host();
    }
    void modified(ExecutionSpace space) override
    {
      if (space == Device) return view.modify_device();
      if constexpr (TRANSFORMS)
        if (space == HostKK) return view.modify_hostkk();
      view.modify_host();
    }
    void sync_pinned(AtomVecKokkos &avec, ExecutionSpace space, int async_flag) override
    {
      if (!(space == Device ? view.need_sync_device() : view.need_sync_host())) return;
      if constexpr (TRANSFORMS)
        avec.perform_pinned_copy_transform(view, space, async_flag);
      else
        avec.perform_pinned_copy(view, space, async_flag);
    }
    void sort(Sorter &sorter) override { sorter.sort(LMPDeviceType(), view.view_device()); }
    void add_to(ColumnsKokkos &columns, ExecutionSpace space) const override
    {
      if constexpr (std::is_same_v<typename View::value_type, double>) {
        if (space == Device)
          columns.add(view.view_device());
        else
          columns.add(view.view_host());
      }
    }

   private:
    static constexpr bool TRANSFORMS = requires(View v) { v.sync_hostkk(); };
    View &view;
    Pointer &pointer;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
