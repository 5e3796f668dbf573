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

#ifndef LMP_SPH_DISSIPATION_MODEL_H
#define LMP_SPH_DISSIPATION_MODEL_H

#include "pointers.h"
#include "sph_dissipation_coeffs.h"
#include "sph_dissipation_eos.h"
#include "sph_dissipation_kernel.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // negative coefficients of the bulk term beyond the bound of a particle: let be, count, cut off

  enum class Limit { NO, COUNT, YES };

  // choices of the pair_style command, as a restart file holds them

  struct Settings {
    Kernel kernel = Kernel::WENDLAND_C2;
    Eos eos = Eos::LINEAR;
    Shear shear = Shear::MG;
    Bulk bulk = Bulk::DENSITY;
    int dim = 0;    // 0: dimension of the simulation
    Limit limit = Limit::NO;
  };

  // what pair_coeff I I sets and what follows from it

  struct TypeCoeff {
    static constexpr int MAXVISCOSITY = 4;

    EosParams eos;
    double viscosity[MAXVISCOSITY] = {};    // mu, and what a derived style adds
    double kappa = 0.0;
    double rc = 0.0;
    double gamma = 0.0;    // 0: default of the equation of state
    int intrinsic = 0;     // 1: kappa is what the shear term gives
    double zeta = 0.0;     // coefficient of the bulk term
  };

  // The fluids as the commands of a pair style describe them: the choices of pair_style, the
  // coefficients of each type and the viscosities of each pair of types of pair_coeff; in and out of
  // restart and data files.  setflag is that of class Pair: which types and pairs of types are set.

  class FluidModel : protected Pointers {
   public:
    FluidModel(class LAMMPS *, const std::string &style,
               const std::vector<std::string> &viscosities);
    ~FluidModel() override;
    void allocate();

    // arguments of the commands; without keyword shear the shear form is default_shear

    void settings(int narg, char **arg, Shear default_shear);
    void coeff(int narg, char **arg, int **setflag);

    // dimension of the kernel and support radius of all types; errors if there is none that fits

    int dimension() const;
    double common_support(int **setflag) const;
    std::string summary(int dim, double support) const;    // one line for the log

    // exponent of the equation of state of type i, its viscosities with types up to i; call for types
    // in ascending order

    void mix(int i);

    // coefficient of the bulk term of type i, whose shear term gives the bulk viscosity intrinsic

    void set_bulk(int i, double intrinsic, bool warn);

    void write_settings(FILE *) const;
    void read_settings(FILE *);
    void write_coeffs(FILE *, int **setflag) const;
    void read_coeffs(FILE *, int **setflag);
    void write_data(FILE *) const;
    void write_data_all(FILE *) const;

    // k = 0 is the shear viscosity, more follow in the order of their names

    double viscosity(int k, int i, int j) const { return pair_viscosity[k][i][j]; }
    bool is_mixed(int i, int j) const { return !viscosity_set[0][i][j]; }

    Settings choice;
    TypeCoeff *coeffs;    // by type, from 1

   private:
    const std::string style;
    const std::vector<std::string> viscosity_names;
    double ***pair_viscosity;    // by viscosity and type pair
    int ***viscosity_set;        // 1 if set by pair_coeff, 0 if mixed from the types

    int nviscosity() const { return static_cast<int>(viscosity_names.size()); }
    int is_viscosity(const std::string &) const;
    int type_coeff(int, char **, int, int, int, int, int **);
    int fluid_coeff(int, char **, int, int, int, int, int **);
    int unlike_coeff(int, char **, int, int, int, int, int **);
    std::string type_line(int) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
