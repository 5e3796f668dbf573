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

#ifdef FIX_CLASS
// clang-format off
FixStyle(sph/open,FixSPHOpen);
// clang-format on
#else

#ifndef LMP_FIX_SPH_OPEN_H
#define LMP_FIX_SPH_OPEN_H

#include "fix.h"

#include "sph_dissipation_boundary.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {
  class Fields;
  class Fluid;
  class OpenCondition;
  class OpenBalance;
  class OpenPlane;
  class ZoneLattice;
  class OpenSamples;
  class OpenValues;
  struct OpenState;
}    // namespace SPHDissipation

// Open boundary of the fluids sph/bulk and sph/micropolar, a buffer zone: moves the particles of the zone, sets their state
// to the prescribed state or to the state of the fluid, turns them into fluid and back, and sums their balance.
// M. Lastiwka, M. Basa, N. J. Quinlan, Int. J. Numer. Meth. Fluids 61, 709 (2009).

class FixSPHOpen : public Fix, public SPHDissipation::OpenZone {
 public:
  FixSPHOpen(class LAMMPS *, int, char **);
  ~FixSPHOpen() override;
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup_pre_neighbor() override { pre_neighbor(); }
  void setup(int) override;
  void initial_integrate(int) override;
  void post_integrate() override;
  void pre_neighbor() override { find_members(); }
  void pre_exchange() override;
  void final_integrate() override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  double memory_usage() override;

  int zone_bit() const override { return groupbit; }
  int fluid_bit() const override { return fluidbit; }
  bool zone_near(const double *, double) const override;
  const std::vector<int> &zone_particles() const override { return members; }
  bool zone_varies() const override;
  void measure(const SPHDissipation::OpenStage &, std::vector<double> &) override;
  void set_states(SPHDissipation::OpenStage &, const double *) override;
  void set_impact(const SPHDissipation::OpenImpact &) override;

 protected:
  SPHDissipation::Fluid *fluid = nullptr;
  std::vector<int> members;    // owned particles of the zone, and fluid that may reach the zone

  bool has_lost_members() const;

 private:
  std::unique_ptr<SPHDissipation::OpenPlane> plane;
  std::unique_ptr<SPHDissipation::OpenValues> values;
  std::unique_ptr<SPHDissipation::OpenSamples> samples;
  std::unique_ptr<SPHDissipation::OpenCondition> condition;
  std::unique_ptr<SPHDissipation::ZoneLattice> lattice;
  std::unique_ptr<SPHDissipation::OpenBalance> balance;
  class FixSPHBulk *integrator = nullptr;    // moves the fluid
  SPHDissipation::Fields *fields = nullptr;
  std::string fluid_name;    // name of the group of the fluid
  int fluidbit = 0;
  double radius = 0.0;    // of the fluid measured around a node of the plane
  double area = 0.0;      // cross section of a row; 0: the zone has a spacing
  double my_longest = 0.0,
         longest = 0.0;    // largest time of sound per support radius near the plane
  bool is_new = false;     // no forces have been computed with this zone
  bool supersonic = false, gap = false;    // true: a warning was given
  bool set_up = false;                     // setup has run since the fix was defined
  bool totals_known = false;
  std::vector<double> totals;
  std::vector<double> waves_before;    // from a restart file, until init()

  // Owned particles of a zone with heat, in ascending order, with their states in the last forces; sums: the densities of
  // these particles by sums over neighbors.  Both are valid until particles change sides
  std::vector<std::pair<int, SPHDissipation::OpenState>> states;
  std::vector<double> sums;

  void set_times(const double *crossings);
  void measure_sound(std::vector<double> &);
  void find_members();
  void warn_of_other_plane();
  void enter(int i, const double *v);
  void compress(int i);
  void leave(int i);
  void set_velocity(int i);
  void set_spin(int i);
  void keep_states();
  void warn(double nsupersonic);
  void set_state(SPHDissipation::OpenStage &, int i);

  // in fix_sph_open_checks.cpp

  void check_groups(int fluid_group);
  class FixSPHBulk *find_integrator(int fluid_group);
  void check_places();
  void check_region();
  void check_lists();
  void check_heat();
  void check_length();
  void warn_of_cold_zone();
  void warn_of_styles();
  void warn_of_masses();
  void warn_of_density();
  bool warn_of_gap();
};

}    // namespace LAMMPS_NS

#endif
#endif
