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

#ifndef LMP_SPH_DISSIPATION_COLUMNS_KOKKOS_H
#define LMP_SPH_DISSIPATION_COLUMNS_KOKKOS_H

// Copies the package's own fields to other particles, and in and out of the buffers of LAMMPS: the pack and unpack functions
// of AtomVecKokkos do not have these fields.

#include "sph_dissipation_arrays_kokkos.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_states.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Columns of numbers: number c of particle i is base[c][i * stride[c]]

  struct ColumnsKokkos {
    // All fields of a particle: x, v, f, rmass, rho, drho, vfrac, esph, desph, vest, desph_before, rho_sum, vol_rate,
    // vol_rate_before, vol_heat, vol_support, shear_rate, shear_mu, trace, omega, torque, inertia, omegaest, states; or a
    // message of a stage
    static constexpr int ALL = 3 * 3 + 6 + 3 + 1 + 7 + 3 + 3 * 2 + 1 + 3 + MOST_STATES;
    static constexpr int MOST = (ALL > Exchange::ROOM) ? ALL : Exchange::ROOM;
    int n = 0;
    double *base[MOST];
    int stride[MOST];

    void add(double *first, int step)
    {
      if (n == MOST) Kokkos::abort("SPH-DISSIPATION: particles have more columns than MOST");
      base[n] = first;
      stride[n++] = step;
    }
    void add(const Field &field)
    {
      for (int d = 0; d < field.width; d++) add(field.first + d, static_cast<int>(field.stride));
    }
    template <class View> void add(const View &view)
    {
      if constexpr (View::rank == 1)
        add(view.data(), 1);
      else
        for (int d = 0; d < (int) view.extent(1); d++)
          add(view.data() + d * view.stride(1), view.stride(0));
    }
    KOKKOS_INLINE_FUNCTION double &at(int c, int i) const
    {
      return base[c][(bigint) i * stride[c]];
    }
    KOKKOS_INLINE_FUNCTION void copy(int from, int to) const
    {
      for (int c = 0; c < n; c++) at(c, to) = at(c, from);
    }
    KOKKOS_INLINE_FUNCTION void pack(int i, double *to) const
    {
      for (int c = 0; c < n; c++) to[c] = at(c, i);
    }
    KOKKOS_INLINE_FUNCTION void unpack(int i, const double *from) const
    {
      for (int c = 0; c < n; c++) at(c, i) = from[c];
    }
  };

  // Rows of a buffer with the columns

  struct RowsKokkos {
    double *first;    // begin of the columns in the first row
    int width;        // numbers in a row
    KOKKOS_INLINE_FUNCTION double *row(int k) const { return first + (bigint) k * width; }
  };

  // The functions below run on DeviceType, in whose memory all pointers must be.  Pack the particles list(k), k < n

  template <class DeviceType, class List>
  void pack_columns(const ColumnsKokkos &columns, const RowsKokkos &buf, int n, const List &list)
  {
    for_each<DeviceType>(
        "sph:pack", n, KOKKOS_LAMBDA(int k) { columns.pack(list(k), buf.row(k)); });
  }

  // Unpack row k to particle place(k), unless place(k) is negative

  template <class DeviceType, class List>
  void unpack_columns(const ColumnsKokkos &columns, const RowsKokkos &buf, int n, const List &place)
  {
    for_each<DeviceType>(
        "sph:unpack", n, KOKKOS_LAMBDA(int k) {
          if (place(k) >= 0) columns.unpack(place(k), buf.row(k));
        });
  }

  // List of the particles first, first + 1, ...

  struct ParticlesFrom {
    int first;
    KOKKOS_INLINE_FUNCTION int operator()(int k) const { return first + k; }
  };

  // Copy the columns of the particles of a list to the particles from nfirst on

  template <class DeviceType, class List>
  void copy_columns(const ColumnsKokkos &columns, int n, const List &list, int nfirst)
  {
    for_each<DeviceType>(
        "sph:copy", n, KOKKOS_LAMBDA(int k) { columns.copy(list(k), nfirst + k); });
  }

  // Do the same for all swaps of a single processor at once, see CommKokkos::forward_comm()

  template <class DeviceType, class Lists, class Ints>
  void copy_columns_of_swaps(const ColumnsKokkos &columns, int n, const Lists &lists,
                             const Ints &sendnum_scan, const Ints &firstrecv,
                             const Ints &owner_of_ghost)
  {
    for_each<DeviceType>(
        "sph:copy", n, KOKKOS_LAMBDA(int k) {
          int swap = 0;
          while (k >= sendnum_scan(swap)) swap++;
          const int i = (swap > 0) ? k - sendnum_scan(swap - 1) : k;
          const int nlocal = firstrecv(0);
          int j = lists(swap, i);
          if (j >= nlocal) j = owner_of_ghost(j - nlocal);
          columns.copy(j, firstrecv(swap) + i);
        });
  }

  // Pack particles that leave, and move others to their places

  template <class DeviceType, class List>
  void pack_leaving_columns(const ColumnsKokkos &columns, const RowsKokkos &buf, int n,
                            const List &list, const List &replacement)
  {
    for_each<DeviceType>(
        "sph:leave", n, KOKKOS_LAMBDA(int k) {
          columns.pack(list(k), buf.row(k));
          if (replacement(k) >= 0) columns.copy(replacement(k), list(k));
        });
  }

  // Copies fields of some particles between device and host

  template <class DeviceType> class SomeParticlesKokkos {
   public:
    Kokkos::View<int *, DeviceType> list;
    ColumnsKokkos there, here;    // the fields on the device, and the same fields on the host

    void set(const std::vector<int> &particles)
    {
      if (particles == on_host) return;
      on_host = particles;
      renew(list, "sph:some", size());
      Kokkos::deep_copy(
          list,
          Kokkos::View<const int *, LMPHostType, Kokkos::MemoryUnmanaged>(on_host.data(), size()));
    }
    void add(double *device, double *host, int width = 1)    // columns of an array of rows
    {
      there.add(Field{device, static_cast<std::size_t>(width), width});
      here.add(Field{host, static_cast<std::size_t>(width), width});
    }
    void get()
    {
      grow();
      pack_columns<DeviceType>(there, {packed.data(), there.n}, size(), list);
      Kokkos::deep_copy(copy, packed);
      for (int k = 0; k < size(); k++) here.unpack(on_host[k], &copy(k * here.n));
    }
    void put()
    {
      for (int k = 0; k < size(); k++) here.pack(on_host[k], &copy(k * here.n));
      Kokkos::deep_copy(packed, copy);
      unpack_columns<DeviceType>(there, {packed.data(), there.n}, size(), list);
    }
    int size() const { return static_cast<int>(on_host.size()); }
    double memory_usage() const { return bytes_of(list, packed, copy) + bytes(on_host); }

   private:
    std::vector<int> on_host;
    Kokkos::View<double *, DeviceType> packed;
    decltype(Kokkos::create_mirror_view(packed)) copy;

    void grow()
    {
      if (static_cast<int>(packed.extent(0)) == size() * there.n) return;
      renew(packed, "sph:some_packed", size() * there.n);
      copy = Kokkos::create_mirror_view(packed);
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
