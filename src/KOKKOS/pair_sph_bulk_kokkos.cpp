/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the SPH-DISSIPATION authors
------------------------------------------------------------------------- */

#include "pair_sph_bulk_kokkos.h"

#include "atom.h"
#include "atom_masks.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_deform.h"
#include "fix_sph_bulk.h"
#include "force.h"
#include "modify.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "sph_dissipation_boundary_kokkos.h"
#include "sph_dissipation_fluid_kokkos.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_open_stage.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

template <class DeviceType>
PairSPHBulkKokkos<DeviceType>::PairSPHBulkKokkos(LAMMPS *lmp, bool spins) :
    PairSPHBulk(lmp, spins), device(new FluidKokkos<DeviceType>(lmp, this, spins))
{
  fluid.reset(device);
  kokkosable = 1;
  execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  centroidstressflag = CENTROID_NOTAVAIL;
  no_virial_fdotr_compute = 1;    // with a full list, ghosts have no forces
}

/* ----------------------------------------------------------------------
   Choose the loops, here alone: on a GPU, those for single pairs over full neighbor lists; on the host, those of the CPU
   style for vectors of pairs over half lists.  On the host with one thread and bench/in.bench, the time per step over that
   of LAMMPS's CPU styles is 0.20 with the loops of the CPU style, 1.2 with those of a GPU.  The style sph/bulk/kk/device
   always has the loops of a GPU; tests run them on the host.
------------------------------------------------------------------------- */

template <class DeviceType> bool PairSPHBulkKokkos<DeviceType>::runs_on_device() const
{
  if (!std::is_same_v<DeviceType, LMPDeviceType>) return false;
  return !std::is_same_v<LMPHostType, LMPDeviceType> ||
      utils::strmatch(force->pair_style, "/kk/device$");
}

/* ----------------------------------------------------------------------
   Return the setting that the device has no code for; empty if there is none.
------------------------------------------------------------------------- */

template <class DeviceType> std::string PairSPHBulkKokkos<DeviceType>::on_host_because() const
{
  const auto &choice = fluid->model->choice;
  if (choice.thermal &&
      (choice.own_temperatures || choice.limit != Limit::NO || fluid->model->has_noise_of_states()))
    return "keyword temp";
  if (update->whichflag == 2) return "a minimization";
  for (const auto &ifix : modify->get_fix_list()) {
    auto *one = dynamic_cast<Boundary *>(ifix);
    if (one && one->contact()) return fmt::format("fix {} contact", ifix->style);
    if (one && !dynamic_cast<BoundaryKokkos<DeviceType> *>(ifix))
      return fmt::format("fix {}", ifix->style);
    auto *integrator = dynamic_cast<FixSPHBulk *>(ifix);
    if (integrator && integrator->has_viscous_stage()) {
      const std::string because = viscous_on_host_because();
      const bool there = integrator->kokkosable &&
          integrator->execution_space == ExecutionSpaceFromDevice<DeviceType>::space;
      if (!there || !because.empty()) return fmt::format("fix {} viscous{}", ifix->style, because);
    }
    if (integrator && integrator->shifts_particles() && !integrator->kokkosable)
      return fmt::format("fix {} shift", ifix->style);
  }
  return "";
}

/* ----------------------------------------------------------------------
   Return what the device has no code for in a fluid with large viscosities; empty if there is nothing.
------------------------------------------------------------------------- */

template <class DeviceType>
std::string PairSPHBulkKokkos<DeviceType>::viscous_on_host_because() const
{
  for (int i = 1; i <= atom->ntypes; i++)
    if (fluid->model->conducts(i)) return " with conduction of heat";
  for (int k = 0; k < modify->nfix; k++) {    // a caller goes through get_fix_list()
    const auto *one = dynamic_cast<Boundary *>(modify->fix[k]);
    if (one && one->has_bodies()) return " with bodies";
    if (one && fluid->model->choice.thermal) return " with temp and walls";
    if (dynamic_cast<OpenZone *>(modify->fix[k])) return " with open ends";
    const auto *deform = dynamic_cast<FixDeform *>(modify->fix[k]);
    if (deform && deform->remapflag == Domain::V_REMAP) return " with fix deform remap v";
  }
  return "";
}

/* ----------------------------------------------------------------------
   Warn once of each fix for which LAMMPS copies all particles in every step; host and device may have one memory.
------------------------------------------------------------------------- */

template <class DeviceType> void PairSPHBulkKokkos<DeviceType>::warn_of_copies()
{
  using namespace FixConst;
  if (std::is_same_v<LMPHostType, LMPDeviceType> || comm->me != 0) return;
  constexpr int IN_EACH_STEP =
      INITIAL_INTEGRATE | POST_INTEGRATE | PRE_FORCE | PRE_REVERSE | POST_FORCE | FINAL_INTEGRATE;
  for (int k = 0; k < modify->nfix; k++) {
    const Fix &one = *modify->fix[k];
    const int mask = modify->fmask[k];
    const bool acts = (mask & IN_EACH_STEP) || ((mask & END_OF_STEP) && one.nevery == 1);
    if (one.kokkosable || !acts || one.datamask_read != ALL_MASK) continue;
    if (!copying.insert(one.id).second) continue;
    error->warning(
        FLERR,
        "Fix {} of style {} has no suffix kk and acts in every step: LAMMPS copies all "
        "particles to the host and back for it; use a fix with the suffix, or fewer steps",
        one.id, one.style);
  }
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void PairSPHBulkKokkos<DeviceType>::init_style()
{
  if (force->pair != this)
    error->all(FLERR, Error::NOLASTLINE, "Pair style {}/kk cannot be used in pair_style hybrid",
               fluid->style);
  if (neighbor->includegroup)    // neighbor lists of KOKKOS ignore the group
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style {}/kk cannot be used with neigh_modify include", fluid->style);
  const std::string reason = runs_on_device() ? on_host_because() : "";
  const bool on_device = runs_on_device() && reason.empty();
  device->choose(on_device);
  PairSPHBulk::init_style();
  if (!on_device) {
    if (comm->me == 0 && !reason.empty())
      error->warning(FLERR,
                     "Pair style {}/kk computes on the host, as the style without suffix does, "
                     "because of {}",
                     fluid->style, reason);
    execution_space = Host;
    datamask_read = ALL_MASK;
    datamask_modify =
        F_MASK | TORQUE_MASK | DESPH_MASK | VEST_MASK | OMEGAEST_MASK | FLUID_SET_ON_HOST;
    no_virial_fdotr_compute = 0;
    return;
  }
  warn_of_copies();
  execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  datamask_read = device->space.read_mask();
  datamask_modify = device->space.modified_mask();
  no_virial_fdotr_compute = 1;

  auto *request = neighbor->find_request(static_cast<Pair *>(this));
  request->set_kokkos_device(1);
  request->enable_full();
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
int PairSPHBulkKokkos<DeviceType>::pack_forward_comm_kokkos(int n, DAT::tdual_int_1d to,
                                                            DAT::tdual_double_1d &buf, int, int *)
{
  const ColumnsKokkos &sent = device->space.sent;
  pack_columns<DeviceType>(sent, {buf.template view<DeviceType>().data(), sent.n}, n,
                           to.template view<DeviceType>());
  return n * sent.n;
}

template <class DeviceType>
void PairSPHBulkKokkos<DeviceType>::unpack_forward_comm_kokkos(int n, int nfirst,
                                                               DAT::tdual_double_1d &buf)
{
  const ColumnsKokkos &sent = device->space.sent;
  unpack_columns<DeviceType>(sent, {buf.template view<DeviceType>().data(), sent.n}, n,
                             ParticlesFrom{nfirst});
}

/* ---------------------------------------------------------------------- */

namespace LAMMPS_NS {
template class PairSPHBulkKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class PairSPHBulkKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
