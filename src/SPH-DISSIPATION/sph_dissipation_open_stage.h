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

#ifndef LMP_SPH_DISSIPATION_OPEN_STAGE_H
#define LMP_SPH_DISSIPATION_OPEN_STAGE_H

#include "sph_dissipation_boundary.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_stages.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Forces, work and heat of a buffer zone on the fluid in one force computation

  struct OpenImpact {
    double force[3], torque[3];    // torque about the origin, of forces and couples
    double power;                  // work and heat

    // Add the force, or the couple, on a particle of the fluid; heat = heat of all channels but the first.
    void add(const Particle &, const ForceSum &, double heat);
    void add(const Spin &, const double *couple);
  };

  // Groups of the zones and of their fluids, on host and device.  The zone of a particle is 0 in a fluid, k in zone k - 1, -1
  // elsewhere.  Groups of owned particles change between two neighbor lists; ghosts get the group that their owner has now.

  struct OpenGroups {
    static constexpr int MOST = 32;    // each zone has a group of its own
    int n = 0, fluid[MOST], zone[MOST];

    SPH_FUNCTION double zone_of(int mask) const
    {
      double of = -1.0;
      for (int k = 0; k < n; k++)
        if (mask & zone[k])
          of = k + 1.0;
        else if (of < 0.0 && (mask & fluid[k]))
          of = 0.0;
      return of;
    }
    SPH_FUNCTION int mask_in(double zone_of, int mask) const
    {
      if (zone_of > 0.0) {
        const int k = static_cast<int>(zone_of) - 1;
        return (mask & ~fluid[k]) | zone[k];
      }
      for (int k = 0; k < n && zone_of == 0.0; k++)
        if (mask & zone[k]) mask = (mask & ~zone[k]) | fluid[k];
      return mask;
    }
  };

  // Sets density and pressure in the pair forces of particles of buffer zones, and sums the impact of the zones on the fluid,
  // over the pairs of a particle of a zone and a particle of the fluid.

  class OpenStage : public Stage {
   public:
    using Stage::Stage;

    void add(OpenZone *);       // no effect if the zone is there
    void remove(OpenZone *);    // no effect if the zone is not there
    bool empty() const { return zones.empty(); }
    int bits() const { return zone_bits; }    // groups of all zones
    int bits_of(int fluid_bit) const;         // groups of the zones whose fluid has this bit
    double state_energy(int i) const;         // energy of the states, at the last densities

    // For OpenZone::set_states(): set density and pressure of a particle, which keeps its bulk term; set the temperature of a
    // particle in conduction, if the fluid conducts heat
    void set_state(int i, double rho, double pressure);
    void set_temperature(int i, double temperature);
    const Particle &particle(int i) const { return engine.particle[i]; }
    double state_pressure(int i) const    // pressure of states
    {
      return engine.constants().states ? engine.state_pressure[i] : 0.0;
    }

    // run() in parts, for a device: set_states() sets the owned particles of the zones; groups() has what ghosts need
    void set_states();
    OpenGroups groups() const;
    const std::vector<OpenZone *> &all() const { return zones; }

    void run();                       // after the pressures, before BoundaryStage::run()
    void sum_impacts(NeighList *);    // after pass 2
    double memory_usage() const override
    {
      return bytes(pairs, side, rows, zone_of, forces, divergence, flow);
    }

   private:
    std::vector<OpenZone *> zones;
    int zone_bits = 0;

    std::vector<double> zone_of;    // of owned and ghost particles, see OpenGroups

    std::vector<std::vector<int>> rows;    // rows of the neighbor list near the plane of each zone

    PairSubset pairs;    // pairs of fluid and one zone

    // Sums over these pairs; zero outside of impact(): so the time of impact() is proportional to the number of pairs.
    std::vector<ForceSum> forces;
    ChannelSums side;
    std::vector<double> divergence, flow;

    void update_ghosts(const OpenGroups &);
    void find_rows(NeighList *);
    OpenImpact impact(NeighList *, std::size_t);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
