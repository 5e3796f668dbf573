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

#ifndef LMP_SPH_DISSIPATION_CHECKS_H
#define LMP_SPH_DISSIPATION_CHECKS_H

#include "pointers.h"

#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {
class Fix;
class LAMMPS;

namespace SPHDissipation {
  struct Changes;
  class Engine;
  class FluidModel;

  // Particles alike in all that decides whether they have pairs: type and bits of groups

  using Kind = std::pair<int, int>;
  std::set<Kind> all_kinds(LAMMPS *);    // those of the particles of all ranks
  bool in_neighbor_lists(LAMMPS *, const Kind &, const Kind &);    // pairs of two kinds

  // the first of the particles of all ranks for which wrong(i) holds, by its ID if particles have
  // one: "particle 17"; empty if there is none; and, if asked for, a value of it

  std::string first_particle(LAMMPS *, const std::function<bool(int)> &wrong);
  std::string first_particle(LAMMPS *, const std::function<bool(int)> &wrong,
                             const std::function<double(int)> &value, double &found);

  // how many there are

  bigint count_particles(LAMMPS *, const std::function<bool(int)> &counts);

  // a fix that was defined after the last run was set up cannot take part in a run with pre no

  void check_set_up(LAMMPS *, const Fix *, bool set_up);

  // the data of a fix in a restart file begin with the number -format of its version

  void check_format(LAMMPS *, const Fix *, double first, int format);

  // the rerun command is executed: it reads positions and velocities of particles, and no more

  bool is_rerun(LAMMPS *);

  // What a particle fluid needs from the rest of the simulation.  Called by all ranks; errors name the
  // pair style.

  class FluidChecks : protected Pointers {
   public:
    FluidChecks(LAMMPS *lmp, const std::string &style, const FluidModel &model) :
        Pointers(lmp), style(style), model(model)
    {
    }

    // no state of the particles that rerun cannot read, where forces and energies depend on it
    void rerun() const;

    // atom style, integrator, units, special bonds; no other pair style that cannot be there
    void styles() const;

    // no pairs of fluid particles of one type are excluded
    void fluid_lists() const;

    // what thermal noise needs: IDs of particles, a constant time step > 0, no minimization
    void noise() const;

    // the support radius fits into the ghost cutoff and, for dim = 1, into the box around the line on
    // which the particles lie
    void support(int dim, double support) const;

    // spins of the fluid's particles are along z in 2d
    void spins() const;

    // warnings about a free surface that the settings press outward or turn
    void surface() const;

    // particles have room for the states of their type; warning about times far below the time step
    void room() const;
    void state_times() const;

    // all masses of fluid and of integrated particles are positive; also during a run, for fixes that
    // insert particles, whose mass is zero at first
    void masses() const;

    // warning about states that are those of other positions, masses, or types than the commands since the last run have
    // given the particles; densities_follow: their sums change with the positions
    void kept_states(const Changes &, bool densities_follow) const;

    // warning about densities of owned particles that the positions have changed much, from what they were before
    void followed_densities(const std::vector<double> &before) const;

    // masses, velocities, spins, and all states are finite numbers, as LAMMPS wants of positions; densities and inertia are
    // not negative
    void numbers() const;

    // states per mass are not negative, but for the mark of a data file: before the first forces turn negative ones into others
    void states() const;

    // warning about particles of one fluid whose sizes differ, if their volumes are those of equal ones
    void sizes(int boundary_bits) const;

    // warnings about a fluid that exerts no forces: no internal energy with an equation of state that
    // needs it, no neighbors inside the support.  Particles with one of boundary_bits in their mask
    // are no fluid.
    void energies(const std::function<double(int i)> &heat, int boundary_bits) const;
    void neighbors(const Engine &, int boundary_bits, int dim, double support) const;

    // warning about pairs of particles, of fluid or of fluid and walls, in the same place; returns how many there are, of
    // which before were told
    bigint places(const Engine &, double support, bigint before) const;

   private:
    const std::string &style;
    const FluidModel &model;

    void line_of_particles(double support) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
