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
FixStyle(sph/refine,FixSPHRefine);
// clang-format on
#else

#ifndef LMP_FIX_SPH_REFINE_H
#define LMP_FIX_SPH_REFINE_H

#include "fix.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {
  class Fluid;
  class RefineEvent;
  class RefineBalance;
  class Value;
}    // namespace SPHDissipation

// Splits particles of the fluids sph/bulk and sph/micropolar that are larger than a target, merges particles that are
// smaller, and sums up the changes of momentum, energy, and other quantities.

class FixSPHRefine : public Fix {
 public:
  FixSPHRefine(class LAMMPS *, int, char **);
  ~FixSPHRefine() override;
  int setmask() override;
  void init() override;
  void init_list(int /*id*/, NeighList *ptr) override { list = ptr; }
  void post_integrate() override;
  void post_force(int) override;
  double compute_vector(int) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  double memory_usage() override;

 private:
  bool by_spacing = false;    // the target is a spacing, else a volume
  std::string target_word;    // target in the input
  const std::unique_ptr<SPHDissipation::Value> target;
  double largest_volume = 0.0;    // target that leaves enough neighbors
  std::unique_ptr<SPHDissipation::RefineBalance> balance;
  std::unique_ptr<SPHDissipation::RefineEvent> event;
  SPHDissipation::Fluid *fluid = nullptr;
  class NeighList *list = nullptr;
  double split_above, merge_below;    // volume over target
  double wait = -1.0;                 // time between two events of a particle; < 0: R/c0
  double fraction = 1.0;              // part of the particles that may have an event at once
  double **past = nullptr;            // last event of each particle
  int not_fluid = 0;                  // bits of the groups of walls and open zones
  bigint last_step = -1;              // step of the last call of this fix
  bigint event_step = -1;             // step of the last events
  bool postponed = false;             // the last check waits for the next step
  bool totals_known = false;
  bool set_up = false;    // setup() has run since the fix was defined
  std::vector<double> totals;

  void check_setup();
  void check_overlap();
  double target_volume(double value) const;
  bool is_target(double value) const;
  void check_target(double value, const std::string &where) const;
  void evaluate_target();
  typedef std::function<double(int, double)> Sound;
  double waiting(const Sound &, int i) const;
  bool is_fluid(int i) const;
  bool may_change(const Sound &, int i) const;
  void count_anew(bigint step);
  double list_volume() const;
  void set_items();
  bool wanted(bigint &nfluid);
};

}    // namespace LAMMPS_NS

#endif
#endif
