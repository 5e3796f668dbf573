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

#ifndef LMP_SPH_DISSIPATION_EXCHANGE_H
#define LMP_SPH_DISSIPATION_EXCHANGE_H

#include "pointers.h"
#include "sph_dissipation_threads.h"

#include <cstddef>
#include <mpi.h>
#include <type_traits>
#include <vector>

namespace LAMMPS_NS {
class Pair;

namespace SPHDissipation {

  // A field of width doubles for each atom; the numbers of atom i begin at first + i * stride

  struct Field {
    double *first;
    std::size_t stride;
    int width;
  };

  // Return the field that begins with a member of an array of structs: field(array, array->member, width)

  template <class T> Field field(T *, double *member, int width)
  {
    static_assert(sizeof(T) % sizeof(double) == 0, "a struct of doubles");
    return {member, sizeof(T) / sizeof(double), width};
  }

  // Gather the values of all processors, in their order.  (Not const: LAMMPS's stand-in for MPI reads no constants.)

  template <class T>
  std::vector<T> gather_all(MPI_Comm world, std::vector<T> mine, MPI_Datatype type)
  {
    int nprocs, n = static_cast<int>(mine.size()), total = 0;
    MPI_Comm_size(world, &nprocs);
    std::vector<int> counts(nprocs), starts(nprocs);
    MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
    for (int p = 0; p < nprocs; p++) {
      starts[p] = total;
      total += counts[p];
    }
    std::vector<T> all(total);
    MPI_Allgatherv(mine.data(), n, type, all.data(), counts.data(), starts.data(), type, world);
    return all;
  }

  // Reduce a number over all processors; op: MPI_SUM, MPI_MIN, ...

  template <class T> T over_all(MPI_Comm world, T mine, MPI_Op op)
  {
    static_assert(std::is_same<T, double>::value || std::is_same<T, int>::value ||
                      (std::is_integral<T>::value && sizeof(T) == sizeof(long long)),
                  "MPI_INT, MPI_LONG_LONG, or MPI_DOUBLE");
    const MPI_Datatype whole = (sizeof(T) == sizeof(int)) ? MPI_INT : MPI_LONG_LONG;
    MPI_Allreduce(MPI_IN_PLACE, &mine, 1, std::is_integral<T>::value ? whole : MPI_DOUBLE, op,
                  world);
    return mine;
  }

  // The communication of a pair style between owned and ghost atoms: a stage names the fields, and the pair style calls the
  // packing for LAMMPS.  Fields that are wider than one message go in several messages.

  class Exchange : protected Pointers {
   public:
    Exchange(class LAMMPS *lmp, Pair *pair) : Pointers(lmp), pair(pair) {}
    void set_threads(Threads *team) { threads = team; }    // the caller owns the team
    static constexpr int ROOM =
        24;    // most values per atom in a message; the pair style requests this room

    // Send owned atoms to their ghosts; add ghosts to their owners (newton on); bits = of the groups that are sent, 0: all
    void forward(const std::vector<Field> &, int bits = 0);
    void reverse(const std::vector<Field> &, int bits = 0);

    // Return the ghosts whose last step in the communication by bricks, along x, then y, then z, was downwards.  A particle
    // next to such a ghost is, on the processor of the other, a ghost whose last step was upwards.  Sends empty messages
    const std::vector<int> &ghosts_from_above();

    int pack_forward(int n, const int *list, double *buf) const;
    void unpack_forward(int n, int nfirst, const double *buf);
    int pack_reverse(int n, int nfirst, double *buf) const;
    void unpack_reverse(int n, const int *list, const double *buf) const;

   private:
    Pair *pair;
    std::vector<Field> fields;
    int chosen = 0;    // bits of the groups whose atoms are in the messages, 0: all
    std::vector<int> from_above;
    int nreceived = -1;    // messages so far, in ghosts_from_above(); else -1
    mutable Threads one_thread;
    Threads *threads = &one_thread;

    template <class Index, class Copy>
    int for_each(int n, const Index &index, const Copy &copy) const;

    template <class Send> void in_parts(const std::vector<Field> &, const Send &);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
