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

#include <string>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Builds the half neighbor list of the fluid with the pairs of LAMMPS's own: within the cutoff and the skin, not
  // excluded, of the types that pair_style hybrid leaves to the fluid.  The particles are sorted into cells of half the
  // reach; the candidates of a cell are copied into columns, relative to its corner and in single precision, where whole
  // vectors of them are tested for each particle of the cell.  Those too close to the bound for single precision are
  // tested in double precision.  Newton on in an orthogonal box: of two particles in different cells the list of the lower
  // cell has the pair, so that half of the cells are looked at.  As those of LAMMPS, the cells fill the whole box and are the
  // same on all processors, and a periodic image is in a cell of its own.

  class NeighborSearch : public NPair {
   public:
    explicit NeighborSearch(class LAMMPS *);

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
    // cells next to that of a particle, in a row along x: from x - reach to x + reach; in its own row x + 1 to x + reach
    struct CellRow {
      int y, z, reach;
    };

    // what one thread finds

    struct Part {
      CandidateColumns candidates;    // of x, index
      std::vector<float> x[3];
      std::vector<int> index;
      std::vector<int> neighbors;    // of all of its rows of the list
      std::vector<int> rows;         // their particles
      std::vector<bigint> offset;    // of their neighbors
    };

    const LoopSet *loops;
    Threads *threads;
    double cutoff;
    bigint ncalls, lastcall;    // of class Neighbor, when the list was built
    bool halved;                // the order of the cells tells which list has a pair
    bool skips;                 // pair_style hybrid gives pairs of types of the fluid to others
    double lo[3], hi[3], size[3];
    int nbox[3];     // cells in the box
    int first[3];    // lowest cell of this processor
    int ncell[3];    // cells of this processor
    std::vector<CellRow> rows;
    std::vector<int> start;      // first entry of each cell in sorted
    std::vector<int> cell;       // of each entry, before they are sorted
    std::vector<int> members;    // particles of the fluid
    std::vector<double> sorted_x[3];
    std::vector<int> sorted_index;
    PlaceColumns sorted;    // of sorted_x, sorted_index
    std::vector<Part> parts;

    int cell_of(double x, int d) const;
    void find_members(const NeighList *);
    void choose_cells();
    void find_rows();
    void sort();
    void search(int from, int to, NeighList *, Part &) const;
    void find_candidates(const int *place, const double *corner, Part &) const;
    int add_own_cell(int p, int end, int *found) const;
    int check(int i, int *found, int n) const;
    int filter(const NeighList *, int i, int *found, int n) const;
    bool has_exclusions(int i) const;
    bool has_pair(int i, int j) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
