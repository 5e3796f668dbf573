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

  // Most characters of a line of a data file that read_data reads
  constexpr std::size_t MOST_OF_DATA_LINE = 254;

  // Return the states of all channels; return the states of the channel with this place
  const std::vector<StateInfo> &state_table();
  const StateInfo &state_info(int slot);

  constexpr int NTRACE = 3;    // numbers per particle that store hashes, see leave_traces()

  // Arrays of the fluid by particle, beyond class Atom.  The atom style derives from this class and keeps the pointers up to
  // date; class Atom owns the arrays, as custom properties of the same names.

  class Fields {
   public:
    // Return the fields of the atom style, also of a sub-style of hybrid, or nullptr where no particle is of the
    // fluid.  Command replicate creates another atom style: do not keep the pointer longer than a
    // run.

    static Fields *of(Atom *);

    // Return the fields, or nullptr where the particles do not spin

    static Fields *with_spins(Atom *);

    const bool has_spins;

    // rate of the internal energy at the beginning of the step, see TimeStep; in an open zone see OpenCondition
    double *desph_before = nullptr;

    double *inertia = nullptr;    // moment of inertia per mass, length^2; nullptr without spins
    double **omegaest =
        nullptr;    // spin at the end of the step, extrapolated; nullptr without spins

    // States of channels, by place in the list States; nullptr without room.  0: new particle.  Negative, STRAIN: minus the
    // ratio of the state to the density that the next forces find.  -1, from a data file: the number is in the column of
    // another channel
    double *state[MOST_STATES] = {};
    std::vector<int> slots;    // places with room

    int room(const StateInfo &) const;    // number of states of a channel with room
    static std::string state_name(int slot);

    // Return the name of the field for the word of the set command, sph/rho or sph/e; return other names unchanged
    static std::string field_name(const std::string &name)
    {
      return (name == "sph/rho") ? "rho" : (name == "sph/e") ? "esph" : name;
    }

    // Density continuity.  rho_sum: the sum in rho at the last forces, negative for bodies, see ParticleRows::add_offset();
    // 0: no sum yet (a new particle also has rho = 0, which stands for rho0).  Last evaluation of the diffusion: rates of
    // volume and internal energy, filled part of the support (1 inside of the fluid); rate of the volume before.  With
    // density sum, vol_support is the part that an elastic body has filled in its first shape (0: not known)
    double *rho_sum = nullptr, *vol_rate = nullptr, *vol_rate_before = nullptr;
    double *vol_heat = nullptr, *vol_support = nullptr;
    // rate of shear and mu at the last forces, if any mu is not constant; else 0
    double *shear_rate = nullptr, *shear_mu = nullptr;
    bool density_in_files = false;    // data files have a column rho

    // At the end of a run or minimization: the trace of each particle (0: none); number of particles with a trace, largest
    // extent of the box, hash of the box, step
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
