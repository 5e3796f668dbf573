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
#include "sph_dissipation_table.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {
  class Boundary;
  class Engine;
  class FluidModel;
}    // namespace SPHDissipation

// Particle fluid with independent shear and bulk viscosity: pressure of an equation of state,
// shear force by pairs, bulk force through the rate of change of the particle volume.

class PairSPHBulk : public Pair {
 public:
  PairSPHBulk(class LAMMPS *);
  ~PairSPHBulk() override;

  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
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

  // the fluid's pair style, of whatever name, alone or in hybrid/overlay; nullptr if there is none

  static PairSPHBulk *find(class Force *);

  // heat of the dissipative forces of the last step, per owned and ghost atom as this rank summed
  // it (with newton on, the sums of the ghosts belong to their owners), and its sum on this rank
  // by channel; energy per time; heat may be nullptr
  enum Channel { SHEAR, BULK, VORTEX, SPIN, NCHANNEL };
  void heating(double *heat, double *power) const;

  // from the init() of a fix, in every run: its particles are a boundary, not fluid

  void add_boundary(SPHDissipation::Boundary *);
  bool is_boundary(int i) const;    // owned or ghost particle

  // from the init() of a fix, in every run: it shifts particles to where they are less crowded.
  // Then crowding() of an owned particle, 1/length, points there.

  void request_crowding() { crowding_requested = true; }
  const double *crowding(int i) const;

  double support_radius() const { return support; }
  int dimension() const { return dim; }    // of the kernel
  double reference_density(int) const;     // of a type

 protected:
  class StressTally;

  const std::string fluid_style;        // also of the atom style and the integrator
  SPHDissipation::FluidModel *model;    // what pair_style and pair_coeff set
  int dim;                              // dimension of the kernel
  double support;                       // support radius rc
  bool announced;                       // the table of coefficients is up to date
  bool warned_step;                     // the warning about the time step was given
  SPHDissipation::Engine *engine;       // the two pair loops

  std::vector<SPHDissipation::Boundary *> boundaries;
  int boundary_bits;    // of the groups of all boundaries
  bool crowding_requested;

  // what is communicated between the passes

  enum class Stage {
    DENSITY,
    BOUND,
    BOUNDARY_SUM,
    BOUNDARY_STATE,
    GRADIENT,
    VORTICITY,
    BOUNDARY_SPIN,
    CROWDING
  };
  Stage stage;

  PairSPHBulk(class LAMMPS *, const std::string &, const std::vector<std::string> &);

  virtual void allocate();

  // what depends on the viscosities that a style has

  using Columns = SPHDissipation::Columns;
  virtual SPHDissipation::Shear default_shear() const;
  virtual SPHDissipation::PairCoeff pair_coefficients(int, int) const;
  virtual double intrinsic_kappa_of(int, int) const;
  virtual void check_pair(int, int);
  virtual Columns table_columns(int, int, double, double) const;
  virtual Columns viscous_steps(int, int, double, double) const;
  virtual double **extrapolated_spin() { return nullptr; }
  virtual void add_torques(int) {}
  virtual void spin_heat(int, double *) const {}

  virtual void check_setup();
  void derive_coeffs();
  void announce();
  void particle_volume();
  void particle_state();
  void check_boundary() const;
  void extrapolate_to_boundary();
  double bulk_heat(int) const;
  void forward_stage(Stage);
  void reverse_stage(Stage);
  int forward_size() const;
  int reverse_size() const;
  double &comm_value(int, int);
};

}    // namespace LAMMPS_NS

#endif
#endif
