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

#ifndef LMP_SPH_DISSIPATION_SPACE_H
#define LMP_SPH_DISSIPATION_SPACE_H

#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  class BoundaryStage;

  // Where a stage runs: its arrays, its loops, and its messages.  A stage that runs on the host and on a device is a template
  // over its space, HostSpace or DeviceSpace (src/KOKKOS); sph_dissipation_shared_stages.h has the functions of both.

  class HostSpace : protected Pointers {
   public:
    template <class T> using Array = std::vector<T>;
    typedef BoundaryStage Boundaries;

    HostSpace(class LAMMPS *lmp, Engine &engine, Exchange &exchange) :
        Pointers(lmp), engine(engine), exchange(exchange)
    {
    }

    // Atoms that forces and heat go to: owned ones and, with newton on, ghosts
    int nforce() const;

    const Parameters &parameters() const { return engine.parameters(); }
    const ParticleRows &rows() const { return engine.rows(); }
    StateRows states() const;    // of the owned atoms as they are now
    const int *mask() const;
    VectorField x() const, v() const, vest() const;
    VectorField omega() const, omegaest() const;    // empty without spins, as the next one
    const double *inertia() const;
    double *energies() const;    // internal energies of atoms
    Spin *spins() const { return engine.has_spin() ? engine.spin : nullptr; }    // of the loops

    // Give an array at least n entries; return the first one
    template <class T> static T *reach(Array<T> &array, const char *, std::size_t n)
    {
      if (array.size() < n) array.resize(n);
      return array.data();
    }
    template <class... One> static double bytes_of(const One &...one) { return bytes(one...); }

    // Call function(i) for each i < n; return the sum of what add(i, total) adds to total
    template <class Function> void for_each(const char *, int n, const Function &function) const
    {
      engine.for_each(n, function);
    }
    template <class Sum, class Add> Sum sum(const char *, int n, const Add &add) const
    {
      return engine.team().sum<Sum>(n, add);
    }

    // Send owned atoms to their ghosts; add ghosts, to which pairs have added, to their owners
    void forward(const std::vector<Field> &fields) { exchange.forward(fields); }
    void reverse(const std::vector<Field> &fields) { exchange.reverse(fields); }

    // Sums over pairs, complete for owned atoms: pass 1; one of sph_dissipation_pair_sums.h; the rates of shear; the amounts
    // that atoms get by flow k, on ghosts the part that belongs to their owners

    void sum_density(NeighList *, double **vest, double **omegaest, bool slopes_read);
    template <class Sum> void sum_pairs(const char *, const Sum &);
    void set_shear_rates(int not_fluid);
    double *sum_flow(int k);

    // sum_rates(): the rates of densities at the velocities of the rows.  sum_friction(): the linear friction at these
    // velocities.  forces(), torques(): of the last pass 2, or of the friction, on owned atoms after collect_forces()
    void sum_rates();
    void sum_friction(NeighList *, int not_fluid);
    void collect_forces();
    VectorField forces() const, torques() const;
    double *flow_rate(int k) { return engine.flow_rate[k].data(); }    // of the last sum_flow()
    void forget_flows();

    double memory_usage() const { return bytes(scratch); }

    Engine &engine;
    Exchange &exchange;

   private:
    std::vector<double> scratch;    // sums of owned and ghost atoms
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
