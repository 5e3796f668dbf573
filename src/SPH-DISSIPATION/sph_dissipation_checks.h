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

#include "lmptype.h"

#include <functional>
#include <set>
#include <string>
#include <utility>

namespace LAMMPS_NS {
class Fix;
class LAMMPS;

namespace SPHDissipation {
  class Engine;
  class FluidModel;

  // Particles alike in all that decides whether they have pairs: type and bits of groups

  using Kind = std::pair<int, int>;
  std::set<Kind> all_kinds(LAMMPS *);    // those of the particles of all ranks
  bool in_neighbor_lists(LAMMPS *, const Kind &, const Kind &);    // pairs of two kinds

  // What a particle fluid needs from the rest of the simulation.  Called by all ranks; errors name the
  // pair style.

  // the first of the particles of all ranks for which wrong(i) holds, by its ID if particles have
  // one: "particle 17"; empty if there is none

  std::string first_particle(LAMMPS *, const std::function<bool(int)> &wrong);

  // how many there are

  bigint count_particles(LAMMPS *, const std::function<bool(int)> &counts);

  // a fix that was defined after the last run was set up cannot take part in a run with pre no

  void check_set_up(LAMMPS *, const Fix *, bool set_up);

  // the rerun command is executed: it reads positions and velocities of particles, and no more

  bool is_rerun(LAMMPS *);

  // no state of the particles that rerun cannot read, where forces and energies depend on it

  void check_rerun(LAMMPS *, const std::string &style, const FluidModel &);

  // atom style, integrator, units, special bonds; no other pair style that cannot be there

  void check_styles(LAMMPS *, const std::string &style);

  // no pairs of fluid particles of one type are excluded

  void check_fluid_lists(LAMMPS *, const std::string &style, const FluidModel &);

  // what thermal noise needs: IDs of particles, a constant time step > 0, no minimization

  void check_noise(LAMMPS *, const std::string &style);

  // the support radius fits into the ghost cutoff and, for dim = 1, into the box around the line on
  // which the particles lie

  void check_support(LAMMPS *, const std::string &style, const FluidModel &, int dim,
                     double support);

  // spins of the fluid's particles are along z in 2d

  void check_spins(LAMMPS *, const std::string &style, const FluidModel &);

  // the data of a fix in a restart file begin with the number -format of its version

  void check_format(LAMMPS *, const Fix *, double first, int format);

  // warnings about a free surface that the settings press outward or turn
  void check_surface(class LAMMPS *, const std::string &style, const FluidModel &);

  // particles have room for the states of their type; warning about times far below the time step

  void check_room(LAMMPS *, const std::string &style, const FluidModel &);
  void check_state_times(LAMMPS *, const std::string &style, const FluidModel &);

  // all masses of fluid and of integrated particles are positive; also during a run, for fixes that
  // insert particles, whose mass is zero at first

  void check_masses(LAMMPS *, const std::string &style, const FluidModel &);

  // velocities, spins, and internal energies are finite numbers, as LAMMPS wants of positions

  void check_numbers(LAMMPS *, const std::string &style, const FluidModel &);

  // warning about particles of one fluid whose sizes differ, if their volumes are those of equal ones

  void check_sizes(LAMMPS *, const std::string &style, const FluidModel &, int boundary_bits);

  // warnings about a fluid that exerts no forces: no internal energy
  // with an equation of state that needs it, no neighbors inside the support.  Particles with one of boundary_bits in their mask are
  // no fluid.

  void check_energies(LAMMPS *, const std::string &style, const FluidModel &,
                      const std::function<double(int i)> &heat, int boundary_bits);
  void check_neighbors(LAMMPS *, const std::string &style, const FluidModel &, const Engine &,
                       int boundary_bits, int dim, double support);

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
