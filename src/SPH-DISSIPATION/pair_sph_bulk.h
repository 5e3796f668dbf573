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

#ifdef PAIR_CLASS
// clang-format off
PairStyle(sph/bulk,PairSPHBulk);
// clang-format on
#else

#ifndef LMP_PAIR_SPH_BULK_H
#define LMP_PAIR_SPH_BULK_H

#include "pair.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {
namespace SPHDissipation {
  class Fluid;

  // Return the fluid of the pair style, of any name, alone or in pair_style hybrid.  Without one, return nullptr, or stop
  // with a message in the name of the user, "Fix sph/wall".  Do not keep the pointer: another pair style has another fluid.

  Fluid *find_fluid(class Force *);
  Fluid *find_fluid(class LAMMPS *, const std::string &user);
}    // namespace SPHDissipation

// Interface of LAMMPS to a Fluid

class PairSPHBulk : public Pair {
 public:
  PairSPHBulk(class LAMMPS *);
  ~PairSPHBulk() override;

  void compute(int, int) override;
  void finish() override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void *extract(const char *, int &) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  void write_data(FILE *) override;
  void write_data_all(FILE *) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  double memory_usage() override;

  std::unique_ptr<SPHDissipation::Fluid> fluid;

 protected:
  PairSPHBulk(class LAMMPS *, bool spins);

 private:
  class StressTally;

  void allocate();
  void cite();
  void sum_virial_by_pairs();
};

}    // namespace LAMMPS_NS

#endif
#endif
