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

#ifndef LMP_SPH_DISSIPATION_OPEN_ROWS_H
#define LMP_SPH_DISSIPATION_OPEN_ROWS_H

#include "pointers.h"

#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

namespace SPHDissipation {

  class OpenPlane;

  // The particles near the far end of a buffer zone, of all processors, also those not of the zone

  class OpenBand : protected Pointers {
   public:
    // those between two heights
    OpenBand(class LAMMPS *, const OpenPlane &, int groupbit, double lo, double hi);

    // one of the zone behind x, not farther beside it than this
    bool has_behind(const double *x, double beside) const;

    // distance of the nearest one of the zone behind x, or in front of it, not farther beside it than
    // this; infinite if there is none
    double next(const double *x, double beside, bool behind) const;

    // any one behind x, not farther beside it than this
    bool has_any_behind(const double *x, double beside) const;

    // any one, or one that is not of the zone, closer to x than this
    bool has_near(const double *x, double distance) const;
    bool has_other_near(const double *x, double distance) const;

   private:
    const OpenPlane &plane;
    std::vector<double> place;    // 3 each
    std::vector<char> of_zone;
    std::vector<std::vector<int>> at_node;    // of the plane

    int nearest_node(const double *x) const;
    template <class Function> bool any(const double *x, double reach, Function &&function) const;
  };

  // Creates and deletes the particles at the far end of a buffer zone, before neighbor lists are built
  // anew.  Particles stand in rows along the normal of the plane: a copy of the last one of a row comes
  // behind it as it moves on, those beyond the end are deleted.  Results do not depend on the number of
  // processors.

  class OpenRows : protected Pointers {
   public:
    OpenRows(class LAMMPS *, const std::string &owner, const OpenPlane &, int groupbit);

    void set_spacing(double a) { given_spacing = a; }
    bool has_spacing() const { return given_spacing > 0.0; }

    // distance of an owned particle from the next one of its row; instead of a spacing
    typedef std::function<double(int i)> Distance;
    void set_distance(Distance f) { distance = std::move(f); }
    bool by_distance() const { return static_cast<bool>(distance); }

    // Measure distance and width of the rows of a zone that is new: until the first renew().
    void init(double support, int fluid_bit);
    bool are_new() const { return unknown_sides; }
    double width() const { return 2.0 * half_width; }    // of a row
    double largest_spacing() const;                      // now, of all processors

    // Note that particles have moved along the normal, by this at most.
    void note_motion(double most) { moved += most; }

    // Delete and create particles.  Calls refresh(those) with owned particles that are new or have moved,
    // to set their velocities and to make their distances known.
    typedef std::function<void(const std::vector<int> &)> Refresh;
    void renew(const Refresh &refresh);

    static constexpr int NSTATE = 3;
    void pack(double *) const;    // for the restart file
    void unpack(const double *);

   private:
    const std::string owner;
    const OpenPlane &plane;
    const int groupbit;
    int fluidbit;
    double given_spacing, spacing, half_width, support;
    double moved;
    tagint highest;        // tag that was ever given
    bool unknown_end;      // it is not known how far the rows reach
    bool unknown_sides;    // nor whether there is something else among them
    Distance distance;

    double step(int i) const;    // from an owned particle to the next one of its row
    double my_largest_spacing() const;
    double end() const;    // height where the zone ends
    void interrupt_ids();
    void find_rows();
    void remove_beyond();
    std::vector<int> last_ones(const OpenBand &) const;
    // removed = particles of this processor that nobody has counted yet, change = of all processors
    bool fill(std::vector<int> &last, const OpenBand &, const Refresh &, bigint &removed,
              bigint &change);
    void check_alone(const OpenBand &) const;
    void check_lattice(const OpenBand &, double largest) const;
    void check_seat(const double *x, const OpenBand &) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
