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
#include "sph_dissipation_noise_data.h"
#include "sph_dissipation_settings.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct Parameters;
  struct TypePair;

  // Coefficients of a type from pair_coeff I I, and numbers derived from these

  struct TypeCoeff {
    TypeCoeff();

    EosParams eos;
    double viscosity[NVISCOSITY] = {};
    std::vector<double> keywords;    // coefficients of the channels, see TypeCoeffs
    double kappa = 0.0;
    double rc = 0.0;
    double gamma = 0.0;    // 0: default of the equation of state
    double cv = 0.0;       // heat capacity per mass; 0: cv of pair_style
    int intrinsic = 0;     // 1: kappa is the bulk viscosity of the shear term
    int other = 0;         // 1: the type belongs to another style of pair_style hybrid
  };

  // Settings of pair_style, and coefficients of types and of pairs of types from pair_coeff; writes and reads restart files,
  // writes data files.  setflag of class Pair: which types and pairs of types have coefficients.

  class FluidModel : protected Pointers {
   public:
    FluidModel(class LAMMPS *, const std::string &style, bool spins);
    ~FluidModel() override;
    void allocate();

    // read the arguments of pair_style and pair_coeff

    void settings(int narg, char **arg);
    void coeff(int narg, char **arg, int **setflag);

    // Return the dimension of the kernel, and the support radius of all types; stop if the box or the types do not fit

    int dimension() const;
    double common_support(int **setflag) const;
    std::string summary(int dim, double support) const;    // one line for the log

    // extract(): return the array by type pair of a coefficient that other commands may vary in a run, see Pair::extract();
    // other commands set the entries i <= j.  adopt(): take the new values, and return whether any value is new.

    void *extract(const char *name, int &dim);
    bool adopt();

    // Derive the parameters of the loops from the coefficients, for a kernel of dimension dim with this support radius; stop
    // if a fluid would not dissipate

    void derive(int dim, double support);
    const Parameters &parameters() const { return *par; }
    const Constants &constants() const;    // of the derived parameters
    bool conducts(int type) const;
    double stiffness(int type, double dt) const;    // of the states, see BaseState
    double diffusion_rate() const;    // of volume: fastest mode at reference densities
    void set_step(double dt);         // sets the numbers of the states for this time step

    // Return the input of the coefficients of a pair of types; return the bulk viscosity of the pair's terms

    TypePair pair_fluid(int i, int j) const;
    double intrinsic_kappa(int i, int j) const;
    double bulk_viscosity(int type) const    // in effect
    {
      return (choice.bulk == Bulk::NONE) ? intrinsic_kappa(type, type) : coeffs[type].kappa;
    }
    void warn_of_ignored() const;    // kappa without bulk term, gamma of linear

    void write_settings(FILE *) const;
    void read_settings(FILE *);
    void write_coeffs(FILE *, int **setflag) const;
    void read_coeffs(FILE *, int **setflag);
    void write_data(FILE *) const;
    void write_data_all(FILE *) const;

    double viscosity(int k, int i, int j) const { return variables[k].value[i][j]; }
    int nviscosity() const { return number_of_viscosities(spins); }
    bool has_torques() const;               // any viscosity of the spins is not 0
    double heat_capacity(int type) const    // per mass
    {
      return (coeffs[type].cv > 0.0) ? coeffs[type].cv : choice.heat_capacity;
    }
    // Return the temperature at a heat per mass, 0 without heat capacity; return the heat at a temperature
    double temperature(int type, double q) const;
    double heat(int type, double T) const;
    bool has_temperatures() const;       // any type has a heat capacity
    bool heat_acts(int type) const;      // on pressure, viscosity, or states, or by conduction
    bool has_rheology() const;           // mu of any type is not constant
    bool has_pair_energy() const;        // pairs of any types have an energy
    bool has_noise_of_states() const;    // with temp, states of any type have noise
    bool is_mixed(int i, int j) const { return !is_given[0][i][j]; }

    // Return a keyword of this type with any of these requirements, see enum Requirement, or nullptr
    const char *keyword_that_needs(int requirements, int type) const;

    // Return a hash of settings and coefficients; the hash at the last forces, 0 before the first ones
    std::uint64_t hash() const;
    std::uint64_t hash_of_forces = 0;

    Settings choice;
    NoiseClock clock;
    int diffusion_age = 0;    // steps since the diffusion of volume was evaluated
    int shift_age =
        0;    // steps since the particles were shifted, 0 if they shift in the next step
    std::string simd =
        "auto";    // pair loops; not in restart files, which another machine may read
    TypeCoeff *coeffs = nullptr;    // by type, from 1
    bool has_type(int type) const
    {
      return !coeffs[type].other;
    }                       // particles of the type are of this fluid
    bool shared = false;    // some types belong to other styles

   private:
    // Coefficient that extract() returns: first viscosities, then coefficients of unlike types, then of types (the
    // value for two types is only the mean); known = last value from the model

    struct Variable {
      std::string name;
      double **value;
      double **known;
    };

    enum { C0, KAPPA, PB, NOTHER };    // variables between variables of pairs and of channels

    const std::string style;
    const bool spins;
    const std::unique_ptr<Parameters> par;
    std::vector<Variable> variables;
    const std::vector<TypeKeyword> keywords;    // of types, of all channels
    const std::vector<std::pair<std::string, int>> of_types,
        of_pairs;    // names and numbers of coefficients of types, of unlike types
    double ***pair_given = nullptr;    // value from pair_coeff, by variable and type pair
    int ***is_given = nullptr;         // 1: pair_coeff gave it; 0: it is mixed from the types

    int npair() const { return nviscosity() + static_cast<int>(of_pairs.size()); }
    const char *inadmissible_keywords(const TypeCoeff &) const;
    int variable_of_pairs(const std::string &name) const;    // number in variables, or -1
    const TypeKeyword *keyword(const std::string &name) const;
    bool is_type_keyword(const std::string &name) const;
    bool varies_no_flow(const char *name) const;    // true: name belongs to a flow that no type has
    bool is_of_pair_energy(const char *name) const;
    bool is_of_missing_group(int coefficient, int type) const;
    double &type_value(int, int);
    double pair_value(int, int, int);
    void publish(int, int);
    void mix(int);
    void check_pair(int, int) const;
    void check_balance(int) const;
    void check_keywords(int) const;
    void check_rheology(int) const;
    bool is_alike(int, int) const;
    int type_coeff(int, char **, int, int, int, int, int **);
    int number_of_values(const TypeKeyword &, int narg, char **arg) const;
    int fluid_coeff(int, char **, int, int, int, int, int **);
    int unlike_coeff(int, char **, int, int, int, int, int **);
    void set_choice(const std::string &keyword, const char *word);
    void set_temperature(char **words, bool energy);
    void set_surface(const char *delta, const char *tension);
    std::string names_of_numbers() const;
    [[noreturn]] void unknown_keyword(const char *word, const std::vector<std::string> &) const;
    int format_number() const;    // of restart files
    std::string type_line(int) const;
    void put_line(FILE *, const std::string &line, const std::string &what) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
