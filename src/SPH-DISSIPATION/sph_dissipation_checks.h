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

  // Kind of a particle, on which its pairs in neighbor lists depend: type and bits of groups

  using Kind = std::pair<int, int>;
  std::set<Kind> all_kinds(LAMMPS *);    // kinds of the particles of all ranks
  bool in_neighbor_lists(LAMMPS *, const Kind &, const Kind &);    // have pairs of two kinds

  // Return the name of the first particle of all ranks with wrong(i), "particle 17" by its ID, if it has one; empty without
  // such a particle; found = value(i) of this particle

  std::string first_particle(LAMMPS *, const std::function<bool(int)> &wrong);
  std::string first_particle(LAMMPS *, const std::function<bool(int)> &wrong,
                             const std::function<double(int)> &value, double &found);

  // Return the number of particles of all ranks with counts(i)

  bigint count_particles(LAMMPS *, const std::function<bool(int)> &counts);

  // Stop if a fix was defined after the last run was set up: it cannot take part in a run with pre no

  void check_set_up(LAMMPS *, const Fix *, bool set_up);

  // Stop if the data of a fix in a restart file do not begin with -format, of the present version

  void check_format(LAMMPS *, const Fix *, double first, int format);

  // Return true in the rerun command, which reads only positions and velocities of particles

  bool is_rerun(LAMMPS *);

  // Checks what a particle fluid needs from the rest of the simulation.  All ranks call the checks; errors name the pair
  // style.

  class FluidChecks : protected Pointers {
   public:
    FluidChecks(LAMMPS *lmp, const std::string &style, const FluidModel &model) :
        Pointers(lmp), style(style), model(model)
    {
    }

    // Refuse rerun if forces or energies depend on states of the particles that rerun cannot read
    void rerun() const;

    // Check atom style, integrator, units, special bonds; refuse other pair and atom styles that do not fit
    void styles() const;

    // Check that pairs of fluid particles of one type are not excluded
    void fluid_lists() const;

    // Check what thermal noise needs: IDs of particles, a constant time step > 0, no minimization
    void noise() const;

    // Check that the support radius fits into the ghost cutoff and, for dim = 1, into the box around the line of particles
    void support(int dim, double support) const;

    // Warn of a skin of the neighbor list that exceeds the support radius
    void skin(int dim, double support) const;

    // Check that spins of the fluid are along z in 2d
    void spins() const;

    // Warn of settings with which a free surface is pressed outward, turns, or gains energy
    void surface() const;

    // Check that particles have room for the states of their type; warn of times far below the time step
    void room() const;
    void state_times() const;

    // Check that masses of fluid and of integrated particles are positive; also during a run, for fixes that insert
    // particles with a mass of zero
    void masses() const;

    // Warn of states that belong to positions, masses, or types from before commands since the last run; densities_follow:
    // densities change with the positions
    void kept_states(const Changes &, bool densities_follow) const;

    // Warn of densities of owned particles that differ much from the densities before, by changed positions
    void followed_densities(const std::vector<double> &before) const;

    // Check that masses, velocities, spins, and all states are finite, as LAMMPS checks positions, and that densities and
    // inertia are not negative
    void numbers() const;

    // Check, before the first forces, that states per mass are not negative, but for the mark -1 of a data file
    void states() const;

    // Warn of particles of one fluid with different masses, if volume number gives them equal volumes
    void sizes(int boundary_bits) const;

    // Warn of a fluid without the internal energy that its equation of state needs.  Particles with one of boundary_bits in
    // their mask are not fluid.
    void energies(const std::function<double(int i)> &heat, int boundary_bits) const;

    // Warn of pairs of particles in the same place, of fluid or of fluid and walls, if there are more than before; return the
    // number of these pairs
    bigint places(const Engine &, double support, bigint before) const;

   private:
    const std::string &style;
    const FluidModel &model;

    void line_of_particles(double support) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
