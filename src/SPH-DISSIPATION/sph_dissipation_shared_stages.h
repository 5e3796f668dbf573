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

#ifndef LMP_SPH_DISSIPATION_SHARED_STAGES_H
#define LMP_SPH_DISSIPATION_SHARED_STAGES_H

// Functions of the stages that run on the host and on a device, see HostSpace; included by sph_dissipation_host_stages.cpp
// and the sources of src/KOKKOS that run stages

#include "atom.h"
#include "force.h"
#include "neighbor.h"
#include "sph_dissipation_kernel.h"
#include "sph_dissipation_pair_sums.h"
#include "sph_dissipation_stages.h"
#include "update.h"

#include <algorithm>

namespace LAMMPS_NS {
namespace SPHDissipation {

  template <class Space> int SharedStage<Space>::nall() const
  {
    return atom->nlocal + atom->nghost;
  }

  /* ---------------------------------------------------------------------- */

  template <class Space>
  void DensityStage<Space>::run(NeighList *list, double **vest, double **omegaest, int not_fluid,
                                bool slopes_read)
  {
    Space &space = this->space;
    space.sum_density(list, vest, omegaest, slopes_read);
    const ParticleRows rows = space.rows();
    if (rows.par.continuity)
      space.for_each(
          "sph:offset", rows.nlocal, SPH_LAMBDA(int i) { rows.add_offset(i, not_fluid); });
    send(false, 0, 0, 0);
  }

  template <class Space>
  void DensityStage<Space>::run(NeighList *list, double **vest, double **omegaest, bool at_rest,
                                double missing, int not_fluid, bool slopes_read)
  {
    Space &space = this->space;
    const Parameters &par = space.parameters();
    const bool states = par.states, completes = par.own_temperatures, continuity = par.continuity;
    const int flows = par.loops_of_flows;
    if (!states && !flows && !completes) return run(list, vest, omegaest, not_fluid, slopes_read);
    space.sum_density(list, vest, omegaest, slopes_read);
    const ParticleRows rows = space.rows();
    space.for_each(
        "sph:states", rows.nlocal, SPH_LAMBDA(int i) {
          if (continuity) rows.add_offset(i, not_fluid);
          rows.set_density(i);
          if (states) rows.set_state_pressure(i, not_fluid, at_rest);
          if (completes) rows.complete_energy(i, missing, not_fluid);
          if (!flows) return;
          rows.set_flow_values(i);
          rows.set_flows(i, not_fluid);
        });
    send(states, flows, not_fluid, rows.nlocal);
  }

  // Thermal pressure needs the energy of ghosts

  template <class Space>
  void DensityStage<Space>::send(bool with_states, int flows, int not_fluid, int first)
  {
    Space &space = this->space;
    const ParticleRows rows = space.rows();
    std::vector<Field> fields = {field(rows.density, &rows.density->c, 2),
                                 {rows.esph, 1, rows.par.thermal_pressure ? 1 : 0},
                                 {rows.state_pressure, 1, with_states ? 1 : 0}};
    for (int k = 0; k < Flows::NUMBER; k++)
      if (flows >> k & 1) fields.push_back(field(rows.flow[k], &rows.flow[k]->value, 1));
    space.forward(fields);
    space.for_each(
        "sph:volume", this->nall() - first, SPH_LAMBDA(int k) {
          rows.set_density(first + k);
          if (flows) rows.set_flows(first + k, not_fluid);
        });
  }

  /* ---------------------------------------------------------------------- */

  template <class Space> void LimitStage<Space>::run()
  {
    double *const of = Space::reach(bound, "sph:bound", this->atom->nmax);
    this->space.sum_pairs("sph:bound", BoundSum{of});
    this->space.forward({{of, 1, 1}});
  }

  /* ---------------------------------------------------------------------- */

  template <class Space> void ViscosityStage<Space>::run(int walls)
  {
    this->space.set_shear_rates(walls);
    const ParticleRows rows = this->space.rows();
    this->space.for_each(
        "sph:viscosity", rows.nlocal, SPH_LAMBDA(int i) {
          rows.set_viscosity(i, walls);
          rows.shear_mu[i] = rows.viscosity[i];
        });
    this->space.forward({{rows.viscosity, 1, 1}});
  }

  template <class Space> void ViscosityStage<Space>::keep()
  {
    const ParticleRows rows = this->space.rows();
    this->space.for_each(
        "sph:viscosity", rows.nlocal, SPH_LAMBDA(int i) { rows.viscosity[i] = rows.shear_mu[i]; });
    this->space.forward({{rows.viscosity, 1, 1}});
  }

  /* ---------------------------------------------------------------------- */

  template <class Space> bigint PressureStage<Space>::run(const double *bound, int not_fluid)
  {
    const ParticleRows rows = this->space.rows();
    this->space.for_each(
        "sph:pressure", this->nall(),
        SPH_LAMBDA(int i) { rows.set_pressure(i, bound, not_fluid); });
    if (!bound) return 0;
    return this->space.template sum<bigint>(
        "sph:beyond", rows.nlocal, SPH_LAMBDA(int i, bigint &nbeyond) {
          if (rows.is_fluid(i, not_fluid) && rows.is_beyond(i, bound)) nbeyond++;
        });
  }

  template <class Space>
  void PressureStage<Space>::set_bulk_term(const double *bound, int not_fluid) const
  {
    const ParticleRows rows = this->space.rows();
    this->space.for_each(
        "sph:bulk_term", this->nall(),
        SPH_LAMBDA(int i) { rows.set_bulk_term(i, bound, not_fluid); });
  }

  /* ---------------------------------------------------------------------- */

  template <class Space>
  void StateStage<Space>::advance(int not_fluid, int walls, const double *noise, int end) const
  {
    const StateRows states = this->space.states();
    const int *const mask = this->space.mask();
    const int nlocal = this->atom->nlocal;
    this->space.for_each(
        "sph:states", nlocal, SPH_LAMBDA(int i) {
          if (states.types[states.type[i]].other || (mask[i] & walls))
            states.forget(i);
          else if (mask[i] & not_fluid)
            states.relax(i);
          else
            states.advance(i, noise ? noise + i : nullptr, nlocal, end);
        });
  }

  /* ---------------------------------------------------------------------- */

  template <class Space> void FlowStage<Space>::run(const std::function<void()> &add_more)
  {
    Space &space = this->space;
    const Parameters &par = space.parameters();
    for (int k = 0; k < Flows::NUMBER; k++) {
      if (!(par.loops_of_flows >> k & 1)) continue;
      double *const rate = space.sum_flow(k);
      if (k != HEAT_FLOW) {
        space.reverse({{rate, 1, 1}});
        continue;
      }
      add_more();
      double *const desph = space.rows().desph;
      space.for_each(
          "sph:flow", space.nforce(), SPH_LAMBDA(int i) { desph[i] += rate[i]; });
    }
  }

  template <class Space> double FlowStage<Space>::received(int groupbit) const
  {
    const double *const heat = this->space.flow_rate(HEAT_FLOW);
    const int *const mask = this->space.mask();
    return this->space.template sum<double>(
        "sph:received_heat", this->space.nforce(), SPH_LAMBDA(int i, double &total) {
          if (mask[i] & groupbit) total += heat[i];
        });
  }

  /* ---------------------------------------------------------------------- */

  template <class Space> void DiffusionStage<Space>::set_rows(int not_fluid, int integrated)
  {
    const ParticleRows of = this->space.rows();
    const int n = this->nall();
    DiffusionRow *const row = Space::reach(rows, "sph:diffusion_row", n + BLOCK);
    double *const impedance = Space::reach(impedances, "sph:impedance", n + BLOCK);
    this->space.for_each(
        "sph:diffusion_row", n + BLOCK, SPH_LAMBDA(int i) {
          if (i < n) return of.set_diffusion(i, not_fluid, integrated, row[i], impedance[i]);
          row[i] = DiffusionRow();
          impedance[i] = 1.0;
        });
  }

  template <class Space> void DiffusionStage<Space>::add_heat(int not_fluid, int integrated) const
  {
    const ParticleRows rows = this->space.rows();
    this->space.for_each(
        "sph:diffusion_heat", rows.nlocal, SPH_LAMBDA(int i) {
          if (!rows.diffuses(i, not_fluid, integrated)) rows.vol_rate[i] = rows.vol_heat[i] = 0.0;
          rows.desph[i] += rows.vol_heat[i];
        });
  }

  /* ----------------------------------------------------------------------
     Return the number of steps between two shifts: at most the time in which sound crosses the support radius.
  ------------------------------------------------------------------------- */

  template <class Space> int ShiftStage<Space>::interval() const
  {
    constexpr int MOST = 8;
    const Parameters &par = this->space.parameters();
    double fastest = 0.0;
    for (int i = 1; i < par.ntypes_1; i++) fastest = std::max(fastest, par.type[i].eos.c0);
    const double way = fastest * this->update->dt;
    return (MOST * way <= par.support) ? MOST : std::max(1, static_cast<int>(par.support / way));
  }

  template <class Space> ShiftLaw ShiftStage<Space>::law() const
  {
    const Parameters &par = this->space.parameters();
    return {par.dim, par.support, interval() * this->update->dt,
            kernel_slope_integral(par.kernel, par.dim, par.support), par.continuity};
  }

  template <class Space> template <class K> void ShiftStage<Space>::set_rows(const ShiftLaw &law)
  {
    const ParticleRows of = this->space.rows();
    const VectorField v = this->space.v();
    ShiftRow *const row = rows.data();
    this->space.for_each(
        "sph:shift_row", this->nall(), SPH_LAMBDA(int i) {
          row[i] = ShiftRow();
          row[i].mass = of.rmass[i];
          row[i].contact = contact_inverse<K>(law.dim, law.support, of.particle[i].vol);
          for (int d = 0; d < 3; d++) row[i].v[d] = v.at(i, d) - of.particle[i].u[d];
        });
    for (const ShiftMover mover : movers)
      this->space.for_each(
          "sph:shift_mover", this->nall(), SPH_LAMBDA(int i) {
            if (of.mask[i] & mover.groupbit)
              let_shift(mover, law.support, of.particle[i].vol, row[i]);
          });
  }

  template <class Space> void ShiftStage<Space>::run(double keep)
  {
    Space &space = this->space;
    const ShiftLaw law = this->law();
    ShiftRow *const row = Space::reach(rows, "sph:shift_row", this->nall());
    with_kernel(space.parameters().kernel, [&](auto kernel) {
      set_rows<decltype(kernel)>(law);
    });
    const ShiftPairs pairs = {law, row};
    space.sum_pairs("sph:crowding", CrowdingSum{pairs});
    space.forward({field(row, row->q, 6)});
    space.sum_pairs("sph:exchange", ExchangeSum{pairs});
    space.forward({field(row, row->d, 3)});
    space.sum_pairs("sph:return_tensor", ReturnTensorSum{pairs});
    space.forward({field(row, row->w, 3)});
    space.sum_pairs("sph:return",
                    ReturnSum{pairs, space.x(), space.v(), space.vest(), space.energies(),
                              this->update->dt, keep, this->force->mvv2e});
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
