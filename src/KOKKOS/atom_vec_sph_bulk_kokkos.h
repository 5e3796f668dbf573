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

#ifdef ATOM_CLASS
// clang-format off
AtomStyle(sph/bulk/kk,AtomVecSPHBulkKokkos);
AtomStyle(sph/bulk/kk/device,AtomVecSPHBulkKokkos);
AtomStyle(sph/bulk/kk/host,AtomVecSPHBulkKokkos);
// clang-format on
#else

#ifndef LMP_ATOM_VEC_SPH_BULK_KOKKOS_H
#define LMP_ATOM_VEC_SPH_BULK_KOKKOS_H

#include "atom_vec_kokkos.h"
#include "atom_vec_sph_bulk.h"

#include <memory>

namespace LAMMPS_NS {
namespace SPHDissipation {
  struct ColumnsKokkos;
  class FieldKokkos;
  struct RowsKokkos;
}    // namespace SPHDissipation

// This class has views of the fields for which class AtomKokkos has none.  They migrate with the particles by LAMMPS's
// functions for "bonus" data, and have their own bits in the masks of sync() and modified().  The pair style sums the forces
// of ghost atoms itself.

class AtomVecSPHBulkKokkos : public AtomVecSPHBulk, public AtomVecKokkos {
 public:
  AtomVecSPHBulkKokkos(class LAMMPS *, bool spins = false);
  ~AtomVecSPHBulkKokkos() override;

  // Return the atom style, for a pair style or fix with /kk
  static AtomVecSPHBulkKokkos &of(class Atom *);

  void process_args(int, char **) override;
  void init() override;
  void grow(int) override;
  void grow_pointers() override;
  void set_size_exchange() override;
  void sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &) override;
  void sync(ExecutionSpace, uint64_t) override;
  void modified(ExecutionSpace, uint64_t) override;
  void sync_pinned(ExecutionSpace, uint64_t, int async_flag = 0) override;

  void pack_comm_bonus_kokkos(const int &, const DAT::tdual_int_1d &,
                              const DAT::tdual_double_2d_lr &, int vel_flag = 0) override;
  void unpack_comm_bonus_kokkos(const int &, const int &, const DAT::tdual_double_2d_lr &,
                                int vel_flag = 0) override;
  void pack_comm_self_bonus_kokkos(const int &, const DAT::tdual_int_1d &, const int) override;
  void pack_comm_self_fused_bonus_kokkos(const int &, const DAT::tdual_int_2d_lr &,
                                         const DAT::tdual_int_1d &, const DAT::tdual_int_1d &,
                                         const DAT::tdual_int_1d &) override;
  void pack_border_bonus_kokkos(int, DAT::tdual_int_1d, DAT::tdual_double_2d_lr &, ExecutionSpace,
                                int vel_flag = 0) override;
  void unpack_border_bonus_kokkos(const int &, const int &, const DAT::tdual_double_2d_lr &,
                                  ExecutionSpace, int vel_flag = 0) override;
  void pack_exchange_bonus_kokkos(const int &, DAT::tdual_double_2d_lr &, DAT::tdual_int_1d,
                                  DAT::tdual_int_1d, DAT::tdual_int_1d, ExecutionSpace) override;
  void unpack_exchange_bonus_kokkos(DAT::tdual_double_2d_lr &, int, ExecutionSpace,
                                    DAT::tdual_int_1d &) override;

  typedef Kokkos::DualView<double *, Kokkos::LayoutRight, LMPDeviceType> tdual_field;
  typedef Kokkos::DualView<double *[3], Kokkos::LayoutRight, LMPDeviceType> tdual_field_3;

  tdual_field k_rho, k_drho, k_vfrac, k_esph, k_desph, k_desph_before;
  tdual_field k_rho_sum, k_vol_rate, k_vol_rate_before, k_vol_heat, k_vol_support, k_shear_rate,
      k_shear_mu;
  tdual_field_3 k_vest, k_trace;
  tdual_field k_inertia;    // k_inertia and k_omegaest are empty without spins
  tdual_field_3 k_omegaest;
  tdual_field k_state[SPHDissipation::MOST_STATES];    // empty without room

  // Return the columns of the fields of real numbers with these bits
  SPHDissipation::ColumnsKokkos columns(uint64_t mask, ExecutionSpace) const;

 private:
  enum Occasion { COMM, BORDER, EXCHANGE, NOCCASION };

  // In the constructor: add a field of class AtomKokkos (ATOM), or of this class (OWN) with the messages that have it

  enum Owner { ATOM, OWN };
  template <class View, class Pointer>
  void add_field(uint64_t, View &, Pointer &, Owner, const std::vector<Occasion> & = {});

  std::vector<std::unique_ptr<SPHDissipation::FieldKokkos>> fields;

  // Own fields in each kind of message, in the order of the strings of the CPU style: so messages of host and device have
  // the same size

  std::vector<SPHDissipation::FieldKokkos *> sent[NOCCASION];
  uint64_t sent_mask(Occasion) const;
  SPHDissipation::ColumnsKokkos columns(Occasion, ExecutionSpace) const;
  SPHDissipation::RowsKokkos rows(Occasion, ExecutionSpace, const DAT::tdual_double_2d_lr &,
                                  int vel_flag) const;

  ExecutionSpace space_of_comm() const;
  void pack(Occasion, ExecutionSpace, int n, const DAT::tdual_int_1d &,
            const DAT::tdual_double_2d_lr &, int vel_flag);
  void unpack(Occasion, ExecutionSpace, int n, int first, const DAT::tdual_double_2d_lr &,
              int vel_flag);
  template <class Task> void change(Occasion, ExecutionSpace, const Task &);
  void clear_heating();
};

}    // namespace LAMMPS_NS

#endif
#endif
