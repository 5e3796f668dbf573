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

#ifndef LMP_SPH_DISSIPATION_NOISE_H
#define LMP_SPH_DISSIPATION_NOISE_H

#include "sph_dissipation_noise_data.h"
#include "sph_dissipation_stages.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Thermal noise: random forces and torques of the pairs, and a random pressure of each particle.  The impulses of a step
  // have the covariance 2 kB T Gamma dt, with the friction matrix Gamma of all viscous terms together (theory page).
  //
  // zeta_i >= 0: random pressure sqrt(2 kT zeta/(V dt)) xi_i
  // zeta_i < 0: each partner owns half of the coefficient of (u.e)^2 of a pair, a_ij F V_i V_j, and has its own number xi_ij
  // for the pair.  With gamma_ij = (c_j/c_i) sqrt(V_j F r^2/a_ij), D_i = sum_j gamma_ij^2, and
  // eta_i = sum_j gamma_ij xi_ij, the numbers
  //   chi_ij = xi_ij - s_i gamma_ij eta_i/D_i,  s_i = 1 - sqrt(1 + 2 zeta_i D_i)
  // have the covariance 1 + 2 zeta_i gamma_i gamma_i^T.  D_i is the bound of LimitStage.
  //
  // temp energy: each particle has the temperature T_i of its heat (internal energy less elastic energy).  The noise of a
  // pair has T_ij = 2 T_i T_j/(T_i + T_j), and its friction is smaller, so that exp(S/k) prod dS_i is stationary; conduction
  // has a random flow, see the theory page.  Friction with a wall has temperature and heat of the fluid particle alone; a
  // wall with a temperature is a heat bath for the flow.  Pass 2 also conducts the heat, since it has all values of a pair.

  class NoiseStage : public Stage {
   public:
    NoiseStage(class LAMMPS *lmp, Engine &engine, Exchange &exchange, NoiseClock &clock) :
        Stage(lmp, engine, exchange), clock(clock)
    {
    }

    // Once in each step, before run(), which a step may call more than once: set the step of the random numbers; with temp
    // energy, find whether masses of the fluid differ; not_fluid as below

    void begin_step(int not_fluid);

    // Before pass 2: add the random pressure to Particle::g; return the noise of pairs and single particles, for pass 2.
    // bound = of LimitStage, nullptr without; not_fluid = bits of the groups of boundary particles, which have no random
    // pressure; continued = the first forces of this run repeat the last forces of the last run

    StepNoise run(const double *bound, int not_fluid, bool continued);

    // Parts of run() for a device.  prepare(): set the form, the keys, and the step of the random numbers; return
    // 2 kT/dt, without T with temp energy.  set_coeffs(): set the factors by pair of types from this number; return false if
    // there is no friction between pairs

    double prepare(int not_fluid);
    bool set_coeffs(double factor);
    const NoiseForm &form_of_pairs() const { return form; }
    const NoiseData &numbers_of_pairs() const { return data; }
    const std::vector<NoiseCoeff> &coefficients() const { return coeff; }

    // With temp energy and unequal masses, after pass 2 and ForceStage::collect(): add to the heating the share of each pair
    // in the work of pressures and friction at the mean velocities of the kick; subtract the heat that each particle pays
    // for its own kick, see the theory page

    void share_work();
    bool shares_work() const { return data.unequal; }

    // Return the noise of the states of owned particles, for StateStage::advance() in the next step

    const std::vector<double> &draw_for_states();

    double memory_usage() const override;

   private:
    NoiseClock &clock;
    NoiseForm form = {};
    NoiseData data = {}, surface_data = {};
    std::vector<NoiseCoeff> coeff, surface_coeff;
    std::vector<NoiseRow> row;
    std::vector<double> mobility;
    std::vector<double> tag, reach, share, eta, pressure, drag, drag_force;
    std::vector<double> numbers, change, flow;
    std::vector<Acceleration> acceleration;
    bool cold_arrival = false;    // particles without heat have come in this run

    void count_step();
    void find_masses(int not_fluid);
    void check_box() const;
    void set_tags();
    void set_temperatures(bool continued, int not_fluid);
    void find_cold_arrivals(int not_fluid);
    void warn_of_cold(bigint number) const;
    bool is_negative(int i) const;
    void add_pressure(double factor, int not_fluid);
    const double *draw_drag(double factor, int not_fluid);
    void set_shares(const double *bound, int not_fluid);
    void set_surface_noise();
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
