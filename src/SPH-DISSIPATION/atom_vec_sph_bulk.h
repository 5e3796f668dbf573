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

#ifdef ATOM_CLASS
// clang-format off
AtomStyle(sph/bulk,AtomVecSPHBulk);
// clang-format on
#else

#ifndef LMP_ATOM_VEC_SPH_BULK_H
#define LMP_ATOM_VEC_SPH_BULK_H

#include "atom_vec.h"
#include "sph_dissipation_fields.h"

namespace LAMMPS_NS {

// Per-atom arrays of a particle fluid: mass (rmass), internal energy (esph) and its rate (desph), velocity extrapolated to
// the end of the step (vest); from the last force computation, density rho = m c, its rate drho = m dc/dt, volume vfrac = V
// = 1/c.  With spins, also spin (omega, angular velocity) and torque.  Class Fields has the others.  Arguments: keywords
// that make room for states, see StateList; rho: data files have the density.

class AtomVecSPHBulk : virtual public AtomVec, public SPHDissipation::Fields {
 public:
  AtomVecSPHBulk(class LAMMPS *);
  ~AtomVecSPHBulk() override;

  void process_args(int, char **) override;
  void grow_pointers() override;
  void force_clear(int, size_t) override;
  void data_atom_post(int) override;
  void pack_data(double **) override;
  void pack_data_pre(int) override;
  void pack_data_post(int ilocal) override { share_columns(ilocal, false); }
  void unpack_restart_init(int) override;
  int property_atom(const std::string &) override;
  void pack_property_atom(int, double *, int, int) override;
  double memory_usage() override;

 protected:
  AtomVecSPHBulk(class LAMMPS *, bool spins, bool in_views = false);

  // Add an array that class Atom has no member for: name of the field, pointer that this class keeps up to date

  void add_array(const std::string &name, double **vector) { add_array(name, vector, nullptr, 0); }
  void add_array(const std::string &name, double ***array, int cols)
  {
    add_array(name, nullptr, array, cols);
  }

  class Atom *const owner;    // of the arrays
  const bool in_views;        // a derived class has all arrays in views
  void add_columns(int narg, char **arg);
  void show_custom_vectors();    // sets the pointers of the custom properties

 private:
  void add_spins();
  void share_columns(int, bool) const;
  void warn_of_lost_densities() const;
  void check_data_line(int) const;
  double state_value(int, int) const;          // for output
  std::vector<double> temperatures() const;    // of owned particles

  struct OwnArray {
    std::string name;
    int index;          // of the custom property
    int cols;           // 0: vector
    double **vector;    // pointer that this class keeps up to date, or array
    double ***array;
  };
  std::vector<OwnArray> own_arrays;
  int nmax_own = 0;    // allocated size of the own arrays
  void add_array(const std::string &, double **, double ***, int);

  double *rmass = nullptr, *rho = nullptr, *drho = nullptr, *vfrac = nullptr;
  double *esph = nullptr, *desph = nullptr;
  double **vest = nullptr;
};

}    // namespace LAMMPS_NS

#endif
#endif
