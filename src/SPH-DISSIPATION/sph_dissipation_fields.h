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

#ifndef LMP_SPH_DISSIPATION_FIELDS_H
#define LMP_SPH_DISSIPATION_FIELDS_H

#include "lmptype.h"
#include "sph_dissipation_states.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class Atom;

namespace SPHDissipation {

  // characters of a line of a data file that read_data takes
  constexpr std::size_t MOST_OF_DATA_LINE = 254;

  // the states of all channels; those of the channel that has this place
  const std::vector<StateInfo> &state_table();
  const StateInfo &state_info(int slot);

  constexpr int NTRACE = 3;    // numbers of a particle in which hashes are, see leave_traces()

  // What the fluid keeps of a particle beyond class Atom, per atom.  The atom style derives from
  // this class and keeps the pointers up to date; class Atom owns the arrays, as custom properties
  // of the same names.

  class Fields {
   public:
    // Return the fields of the atom style, also of a sub-style of hybrid, or nullptr where no particle is of the
    // fluid.  Command replicate creates another atom style: do not keep the pointer longer than a
    // run.

    static Fields *of(Atom *);

    // Return the same, or nullptr where the particles do not spin

    static Fields *with_spins(Atom *);

    const bool has_spins;

    // rate of the internal energy when the step began, see TimeStep; of a particle of an open zone, see OpenCondition
    double *desph_before = nullptr;

    double *inertia = nullptr;    // moment of inertia per mass, length^2; nullptr without spins
    double **omegaest =
        nullptr;    // spin at the end of the step, extrapolated; nullptr without spins

    // States of channels, by their place in the list States; nullptr where there is no room.  Of a new particle 0; of
    // StateKind::STRAIN also minus the factor by which it differs from the density that the next forces find; -1 of a particle
    // from a data file where the file has it in the column of another one
    double *state[MOST_STATES] = {};
    std::vector<int> slots;    // places of those that there is room for

    int room(const StateInfo &) const;    // number of them, of a channel
    static std::string state_name(int slot);

    // Of density continuity: the part of rho that is the sum of the last forces, negative of a body, see
    // ParticleRows::add_offset(); 0 of a density that waits for its first sum (that of a new particle is 0, which means
    // rho0).  Of the last evaluation of the diffusion the rate of the volume, that of the internal energy, and how full the
    // support is; the rate of the volume of the evaluation before
    double *rho_sum = nullptr, *vol_rate = nullptr, *vol_rate_before = nullptr;
    double *vol_heat = nullptr, *vol_support = nullptr;
    double *shear_rate =
        nullptr;    // of the last forces, if any viscosity depends on it, otherwise 0
    bool density_in_files = false;    // data files have a column rho

    // When a run or a minimization ends: the trace of each particle, of others 0; how many have one, the largest extent of the
    // box, a hash of the box, the step
    double **trace = nullptr;
    struct {
      bigint number = 0;    // 0: there was no run
      double length = 0.0;
      bigint box = 0, step = 0;
    } end;

   protected:
    explicit Fields(bool spins) : has_spins(spins) {}
    ~Fields() = default;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
