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

  // Builds the half neighbor list of the fluid with the same pairs as LAMMPS: within the cutoff and the skin, not excluded,
  // of types that pair_style hybrid leaves to the fluid.  The search sorts the particles into cells of half the cutoff of the
  // list, copies the candidates of a cell into columns, relative to the corner of the cell and in single precision, and tests
  // whole vectors of candidates for each particle of the cell; candidates too close to the cutoff in double precision.
  // The owned particle in the lower cell has a pair of two owned particles: so the search looks at half of the cells.  With
  // newton on, an owned particle has its pairs with the ghosts from above; if the communication of LAMMPS is not by bricks,
  // IDs decide which processor has a pair.

  class NeighborSearch : public NPair {
   public:
    NeighborSearch(class LAMMPS *lmp, Exchange &messages) : NPair(lmp), exchange(messages) {}

    // Return the setting because of which LAMMPS must build the list; empty if there is none
    std::string left_to_lammps() const;

    // Start a run with lists of pairs up to the distance support + skin
    void init(const LoopSet *, Threads *, double support);

    // Build the list of the pair style, an occasional list for LAMMPS, if LAMMPS has built the perpetual lists since the last
    // call; return whether the list is new
    bool update(NeighList *);

    void build(NeighList *) override;
    double memory_usage() const;    // bytes

   private:
    // Cells near the cell of a particle, in a row along x from first to last, relative to the cell of the particle

    struct CellRow {
      int y, z, first, last;
    };

    // Particles sorted into cells; cell c has the entries start[c] to start[c + 1] - 1

    struct Sorted {
      std::vector<int> start, index;
      std::vector<double> x[3];
    };

    struct Candidates {
      CandidateColumns columns;    // point to x and index
      std::vector<float> x[3];
      std::vector<int> index;
    };

    // Results of one thread

    struct Part {
      Candidates owned, ghosts;      // of one cell
      std::vector<int> neighbors;    // of all rows of the list of this thread
      std::vector<int> far;          // neighbors of one particle beyond the support
      std::vector<int> rows;         // particle of each row of the list
      std::vector<bigint> offset;    // first neighbor of each row
    };

    Exchange &exchange;
    const LoopSet *loops = nullptr;
    Threads *threads = nullptr;
    double support = 0.0, cutoff = 0.0;
    bigint ncalls = -1, lastcall = -1;    // of class Neighbor, when the list was built
    bool skips = false;    // pair_style hybrid gives pairs of types of the fluid to others
    bool by_id = false;    // has_pair() selects the pairs with ghosts
    double lo[3] = {}, size[3] = {};    // corner of the first cell, size of a cell
    int ncell[3] = {};
    std::vector<CellRow> all_rows, upper_rows;
    std::vector<int> members;    // nowned owned particles of the fluid, then ghosts
    int nowned = 0;
    std::vector<int> cell;     // cell of each particle in sort()
    std::vector<int> order;    // cells with owned particles, in the order of the rows
    Sorted owned, ghosts;
    std::vector<Part> parts;

    void find_members(const NeighList *);
    void choose_cells();
    void find_rows();
    void sort(Sorted &, int from, int to);    // sorts members from ... to - 1 into cells
    void order_cells();
    void search(std::size_t from, std::size_t to, NeighList *,
                Part &) const;    // cells order[from] ... order[to - 1]
    void find_candidates(const Sorted &, const std::vector<CellRow> &, const int *place,
                         const double *corner, Candidates &) const;
    int check(int i, int *found, int n) const;
    bool is_wanted(const NeighList *, int i, int j) const;
    bool has_exclusions(int i) const;
    bool has_pair(int i, int j) const;

    // Keep the entries j of found for which keep(j) is true; return the number of these entries

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
