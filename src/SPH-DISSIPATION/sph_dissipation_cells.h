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

#ifndef LMP_SPH_DISSIPATION_CELLS_H
#define LMP_SPH_DISSIPATION_CELLS_H

#include "lmptype.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Some of the particles, sorted into cubic cells, to find those within a radius of a place.  For pairs that are not in the
  // neighbor lists.

  class Cells {
   public:
    Cells(double **x, std::vector<int> members, double size) :
        x(x), size(size), lo(), ncell{1, 1, 1}, member(std::move(members))
    {
      for (int d = 0; d < 3 && !member.empty(); d++) {
        double hi = lo[d] = x[member[0]][d];
        for (const int i : member) {
          lo[d] = std::min(lo[d], x[i][d]);
          hi = std::max(hi, x[i][d]);
        }
        ncell[d] = cell_of(hi, d) + 1;
      }

      // counting sort: the members of cell c are member[start[c]] to member[start[c + 1] - 1]

      start.assign(ncell[0] * ncell[1] * ncell[2] + 1, 0);
      std::vector<bigint> cell(member.size());
      for (std::size_t m = 0; m < member.size(); m++) {
        const double *const at = x[member[m]];
        cell[m] = (cell_of(at[2], 2) * ncell[1] + cell_of(at[1], 1)) * ncell[0] + cell_of(at[0], 0);
        start[cell[m] + 1]++;
      }
      for (std::size_t c = 1; c < start.size(); c++) start[c] += start[c - 1];
      std::vector<int> sorted(member.size()), next(start.begin(), start.end() - 1);
      for (std::size_t m = 0; m < member.size(); m++) sorted[next[cell[m]]++] = member[m];
      member = std::move(sorted);
    }

    // Call function(j, x_j - place, |x_j - place|^2) for each member j within the radius, also for one at the place

    template <class Function>
    void near(const double *place, double radius, Function &&function) const
    {
      bigint from[3], to[3];
      for (int d = 0; d < 3; d++) {
        from[d] = std::max(cell_of(place[d] - radius, d), bigint(0));
        to[d] = std::min(cell_of(place[d] + radius, d), ncell[d] - 1);
      }
      for (bigint c = from[2]; c <= to[2]; c++)
        for (bigint b = from[1]; b <= to[1]; b++) {
          if (from[0] > to[0]) continue;
          const bigint row = (c * ncell[1] + b) * ncell[0];
          for (int m = start[row + from[0]]; m < start[row + to[0] + 1]; m++) {
            const int j = member[m];
            double r[3], rsq = 0.0;
            for (int d = 0; d < 3; d++) {
              r[d] = x[j][d] - place[d];
              rsq += r[d] * r[d];
            }
            if (rsq < radius * radius) function(j, r, rsq);
          }
        }
    }

   private:
    double **x;
    double size, lo[3];
    bigint ncell[3];
    std::vector<int> member, start;

    bigint cell_of(double place, int d) const
    {
      return static_cast<bigint>(std::floor((place - lo[d]) / size));
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
