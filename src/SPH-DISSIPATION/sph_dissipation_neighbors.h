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

#ifndef LMP_SPH_DISSIPATION_NEIGHBORS_H
#define LMP_SPH_DISSIPATION_NEIGHBORS_H

#include "npair.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Builds the half neighbor list of the fluid with the pairs of LAMMPS's own: within the cutoff and the skin, not
  // excluded, of the types that pair_style hybrid leaves to the fluid.  The particles are sorted into cells of half the
  // reach; the candidates of a cell are copied into columns, relative to its corner and in single precision, where whole
  // vectors of them are tested for each particle of the cell.  Those too close to the bound for single precision are
  // tested in double precision.  Of two owned particles the one in the lower cell has the pair, so that half of the cells are
  // looked at for them.  With newton on, an owned particle has its pairs with the ghosts that have come from above; where the
  // communication of LAMMPS is not by bricks, IDs tell which processor has the pair.

  class NeighborSearch : public NPair {
   public:
    NeighborSearch(class LAMMPS *lmp, Exchange &messages) : NPair(lmp), exchange(messages) {}

    // what the settings of a run have that is left to LAMMPS, or empty
    std::string left_to_lammps() const;

    // start of a run: lists are to be built, for particles up to the distance support plus the skin
    void init(const LoopSet *, Threads *, double support);

    // the list of the pair style, requested as an occasional one, for the particles where they were when LAMMPS built its
    // perpetual lists; returns whether it was built now
    bool update(NeighList *);

    void build(NeighList *) override;
    double memory_usage() const;    // bytes

   private:
    // cells next to that of a particle, in a row along x: from first to last

    struct CellRow {
      int y, z, first, last;
    };

    // particles sorted into cells; those of cell c are the entries start[c] to start[c + 1] - 1

    struct Sorted {
      std::vector<int> start, index;
      std::vector<double> x[3];
    };

    struct Candidates {
      CandidateColumns columns;    // of x, index
      std::vector<float> x[3];
      std::vector<int> index;
    };

    // what one thread finds

    struct Part {
      Candidates owned, ghosts;      // of one cell
      std::vector<int> neighbors;    // of all of its rows of the list
      std::vector<int> far;          // of one row: those beyond the support
      std::vector<int> rows;         // their particles
      std::vector<bigint> offset;    // of their neighbors
    };

    Exchange &exchange;
    const LoopSet *loops = nullptr;
    Threads *threads = nullptr;
    double support = 0.0, cutoff = 0.0;
    bigint ncalls = -1, lastcall = -1;    // of class Neighbor, when the list was built
    bool skips = false;    // pair_style hybrid gives pairs of types of the fluid to others
    bool by_id = false;    // has_pair() tells which pairs with ghosts are wanted
    double lo[3] = {}, size[3] = {};    // of the cells
    int ncell[3] = {};
    std::vector<CellRow> all_rows, upper_rows;
    std::vector<int> members;    // nowned owned particles of the fluid, then ghosts
    int nowned = 0;
    std::vector<int> cell;     // of each of those that are being sorted
    std::vector<int> order;    // cells with owned particles, in that of the rows
    Sorted owned, ghosts;
    std::vector<Part> parts;

    void find_members(const NeighList *);
    void choose_cells();
    void find_rows();
    void sort(Sorted &, int from, int to);    // of the members
    void order_cells();
    void search(std::size_t from, std::size_t to, NeighList *,
                Part &) const;    // of cells in their order
    void find_candidates(const Sorted &, const std::vector<CellRow> &, const int *place,
                         const double *corner, Candidates &) const;
    int check(int i, int *found, int n) const;
    bool is_wanted(const NeighList *, int i, int j) const;
    bool has_exclusions(int i) const;
    bool has_pair(int i, int j) const;

    // keeps those of which keep(j) is true; returns how many

    template <class Keep> static int filter(int *found, int n, const Keep &keep)
    {
      int kept = 0;
      for (int k = 0; k < n; k++)
        if (keep(found[k])) found[kept++] = found[k];
      return kept;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
