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

  // choices of the pair_style command

  struct Settings {
    Settings();

    Kernel kernel;
    Eos eos;
    Shear shear;
    Bulk bulk;
    int dim;    // 0: dimension of the simulation
    Limit limit;
    Volume volume;
    bool thermal;             // thermal noise
    double temperature;       // of it
    bool own_temperatures;    // each particle has that of its internal energy instead
    double heat_capacity;     // per mass, of types that have none of their own
    int seed;
  };

  // the step of the last random numbers, and what is added to a step to get numbers that no step before had

  struct NoiseClock {
    bigint step = -1, offset = 0;
  };

  // what pair_coeff I I sets and what follows from it

  struct TypeCoeff {
    TypeCoeff();
    static constexpr int MAXVISCOSITY = 4;

    EosParams eos;
    double viscosity[MAXVISCOSITY];    // mu, and what a derived style adds
    double kappa;
    double rc;
    double gamma;     // 0: default of the equation of state
    double cv;        // heat capacity per mass; 0: that of the pair style
    int intrinsic;    // 1: kappa is what the shear term gives
    int other;        // 1: its particles belong to another style of pair_style hybrid
    double zeta;      // coefficient of the bulk term
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

    // Coefficients that other commands may vary during a run, see Pair::extract(): arrays by type
    // pair, of which they set the entries i <= j.  adopt() takes over what they
    // have set and says whether there was anything.

    void *extract(const char *name, int &dim);
    bool adopt();

    // exponent of the equation of state of type i, its viscosities with types up to i; call for types
    // in ascending order

    void mix(int i);

    // coefficient of the bulk term of type i, whose shear term gives the bulk viscosity intrinsic

    void set_bulk(int i, double intrinsic);
    void check_balance(int i, double intrinsic) const;    // of its noise and its friction
    void warn_of_ignored(int i,
                         double intrinsic) const;    // kappa without bulk term, gamma of linear

    void write_settings(FILE *) const;
    void read_settings(FILE *, Shear default_shear);
    void write_coeffs(FILE *, int **setflag) const;
    void read_coeffs(FILE *, int **setflag);
    void write_data(FILE *) const;
    void write_data_all(FILE *) const;

    // k = 0 is the shear viscosity, more follow in the order of their names

    double viscosity(int k, int i, int j) const { return variables[k].value[i][j]; }
    int is_viscosity(const std::string &name) const;    // its k, or -1
    double heat_capacity(int type) const;               // per mass
    bool is_mixed(int i, int j) const { return !viscosity_set[0][i][j]; }

    Settings choice;
    NoiseClock clock;
    std::string simd;    // pair loops to use; not in restart files, which may go to another machine
    TypeCoeff *coeffs;    // by type, from 1
    bool shared;          // there are types of other styles

   private:
    // what extract() gives out: the viscosities, then coefficients of types, whose value for two types
    // is the mean and has no other meaning; known = value when the model set it last

    struct Variable {
      std::string name;
      double **value;
      double **known;
    };

    enum { C0, KAPPA, PB };    // the variables after the viscosities

    const std::string style;
    const std::vector<std::string> viscosity_names;
    std::vector<Variable> variables;
    double ***pair_viscosity;    // by viscosity and type pair: what pair_coeff gave
    int ***viscosity_set;        // 1 if it did, 0 if the value is mixed from the types

    int nviscosity() const { return static_cast<int>(viscosity_names.size()); }
    double &type_value(int, int);
    double pair_value(int, int, int);
    void publish(int, int);
    int type_coeff(int, char **, int, int, int, int, int **);
    int fluid_coeff(int, char **, int, int, int, int, int **);
    int unlike_coeff(int, char **, int, int, int, int, int **);
    int place(const char *) const;
    std::string type_line(int) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
