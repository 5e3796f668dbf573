/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "lammps_driver.h"

#include "atom.h"
#include "compute.h"
#include "exceptions.h"
#include "force.h"
#include "input.h"
#include "lammps.h"
#include "library.h"
#include "modify.h"
#include "pair.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

using namespace LAMMPS_NS;

// numbers must reach LAMMPS's parser without loss

static std::string exact(double value)
{
  char text[32];
  snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

/* ---------------------------------------------------------------------- */

LammpsDriver::LammpsDriver() : natoms(0)
{
  std::vector<std::string> words = {"test", "-log", "none", "-screen", "none", "-nocite"};
  if (const char *switches = getenv("SPHD_SWITCHES"))    // of an accelerator package
    for (const auto &word : utils::split_words(switches)) words.push_back(word);
  std::vector<char *> args;
  for (auto &word : words) args.push_back(&word[0]);
  lmp = std::make_unique<LAMMPS>(static_cast<int>(args.size()), args.data(), MPI_COMM_WORLD);
}

LammpsDriver::~LammpsDriver() = default;

LammpsDriver &lammps()
{
  static std::unique_ptr<LammpsDriver> driver;
  // LAMMPS must go before MPI_Finalize(): the main program's environment deletes it
  static struct Closer : public ::testing::Environment{void TearDown() override{driver.reset();
}
}
*closer = nullptr;
if (!closer) ::testing::AddGlobalTestEnvironment(closer = new Closer);
if (!driver) driver = std::make_unique<LammpsDriver>();
return *driver;
}

int LammpsDriver::rank()
{
  int me;
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  return me;
}

int LammpsDriver::ranks()
{
  int n;
  MPI_Comm_size(MPI_COMM_WORLD, &n);
  return n;
}

// ranks sleep while rank 0 computes a reference: waiting MPI calls would take a processor of another test

static void sleep_until_all_are_here()
{
  MPI_Request request;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  int done = 0;
  for (int turn = 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE), !done; turn++)
    if (turn > 10) std::this_thread::sleep_for(std::chrono::microseconds(50));
}

void LammpsDriver::broadcast(std::vector<double> &values)
{
  sleep_until_all_are_here();
  MPI_Bcast(values.data(), values.size(), MPI_DOUBLE, 0, MPI_COMM_WORLD);
}

// the loops that a pair style accepts here

std::vector<std::string> LammpsDriver::instruction_sets()
{
  std::vector<std::string> found;
  lmp->input->one("clear");
  for (const std::string name : {"none", "avx2", "avx512"}) {
    try {
      lmp->input->one("pair_style sph/bulk simd " + name);
      found.push_back(name);
    } catch (LAMMPSException &) {
      // not this processor
    }
  }
  return found;
}

bool LammpsDriver::command(const std::string &line)
{
  sleep_until_all_are_here();
  try {
    lmp->input->one(line);
  } catch (LAMMPSException &e) {
    ADD_FAILURE() << line << ": " << e.what();
    return false;
  }
  return true;
}

/* ---------------------------------------------------------------------- */

void LammpsDriver::create_box(const Configuration &config, const Layout &layout,
                              const std::string &style)
{
  command("clear");
  command("units lj");
  command("atom_style " + style);
  command(layout.newton ? "newton on" : "newton off");
  command("processors " + layout.processors);
  command("dimension " + std::to_string(config.box_dim()));
  std::string boundary = "boundary";
  for (int k = 0; k < 3; k++) boundary += (k >= config.dim || config.periodic) ? " p" : " f";
  command(boundary);

  std::string region = config.triclinic() ? "region box prism" : "region box block";
  for (int k = 0; k < 3; k++) region += " " + exact(config.lo[k]) + " " + exact(config.hi[k]);
  if (config.triclinic())
    for (const double tilt : config.tilt) region += " " + exact(tilt);
  command(region);
  command("create_box " +
          std::to_string(*std::max_element(config.type.begin(), config.type.end())) + " box");
  command("neighbor 0.1 bin");
}

void LammpsDriver::create_particles(const Configuration &config)
{
  natoms = config.size();
  std::vector<tagint> id(natoms);
  for (int i = 0; i < natoms; i++) id[i] = i + 1;
  const int created = lammps_create_atoms(lmp.get(), natoms, id.data(), config.type.data(),
                                          config.x.data(), config.v.data(), nullptr, 0);
  EXPECT_EQ(created, natoms);
}

void LammpsDriver::create(const Configuration &config, const Layout &layout)
{
  simd = layout.simd;
  const std::string style = config.spin.empty() ? "sph/bulk" : "sph/micropolar";
  create_box(config, layout, style);
  create_particles(config);
  const Atom *atom = lmp->atom;
  for (int i = 0; i < atom->nlocal; i++) {
    atom->rmass[i] = config.mass[atom->tag[i] - 1];
    atom->esph[i] = config.energy[atom->tag[i] - 1];
    if (!config.spin.empty())
      for (int d = 0; d < 3; d++) atom->omega[i][d] = config.spin[3 * (atom->tag[i] - 1) + d];
  }
  if (layout.tiled) {
    command("comm_style tiled");
    command("balance 1.0 rcb");
  }
  command("fix integrator all " + style + (config.spin.empty() ? "" : " inertia 0.2 0.01"));
  if (!config.spin.empty()) command("compute dissipation all sph/dissipation");
  command("compute property all property/atom numden dnumden vol rho esph");
  command("compute stress all stress/atom NULL virial");
  command("compute energy all pe/atom pair");
  command("compute sum all reduce sum c_stress[1] c_energy");
}

void LammpsDriver::create_lammps_sph(const Configuration &config,
                                     const std::vector<double> &density)
{
  create_box(config, Layout(), "sph");
  create_particles(config);
  for (int type = 1; type <= lmp->atom->ntypes; type++) {
    const auto first = std::find(config.type.begin(), config.type.end(), type);
    command("mass " + std::to_string(type) + " " + exact(config.mass[first - config.type.begin()]));
  }
  Atom *atom = lmp->atom;
  for (int i = 0; i < atom->nlocal; i++) {
    const int k = atom->tag[i] - 1;
    atom->rho[i] = density[k];
    atom->esph[i] = config.energy[k];
    for (int d = 0; d < 3; d++) atom->vest[i][d] = config.v[3 * k + d];
  }
  command("fix integrator all sph");
}

/* ---------------------------------------------------------------------- */

void LammpsDriver::pair_style(const DenseReference::Model &model, const std::string &eos,
                              const std::string &shear, const std::string &bulk,
                              const std::string &keywords)
{
  const bool micropolar = !model.spins.empty();
  command("pair_style sph/" + std::string(micropolar ? "micropolar" : "bulk") + " kernel " +
          model.kernel + " dim " + std::to_string(model.n) + " eos " + eos +
          " shear " + (shear == "micropolar" ? "mg" : shear == "micropolar/fr2" ? "mg/fr2" : shear) +
          " bulk " + bulk + " simd " + simd +
          (model.volume_by_mass ? " volume mass " : " ") + keywords);
  auto spin_words = [](const DenseReference::SpinFluid &spin, bool named) {
    return std::string(named ? " mu_r " : " ") + exact(spin.mu_r) + (named ? " gamma1 " : " ") +
        exact(spin.gamma1) + (named ? " gamma2 " : " ") + exact(spin.gamma2);
  };
  for (std::size_t type = 1; type <= model.fluids.size(); type++) {
    const auto &fluid = model.fluids[type - 1];
    const std::string name = std::to_string(type);
    std::string line = "pair_coeff " + name + " " + name + " " + exact(fluid.rho0) + " " +
        exact(fluid.c0) + " " + exact(shear == "none" ? 0.0 : fluid.mu) + " " +
        (fluid.intrinsic ? "intrinsic" : exact(fluid.kappa)) +
        (micropolar ? spin_words(model.spins[type - 1], false) : "") + " " + exact(model.support);
    if (fluid.pb != 0.0L) line += " pb " + exact(fluid.pb);
    if (fluid.gamma != 0.0L) line += " gamma " + exact(fluid.gamma);
    command(line);
  }
  for (const auto &entry : model.mu_unlike)
    command("pair_coeff " + std::to_string(entry.first.first) + " " +
            std::to_string(entry.first.second) + " mu " +
            exact(shear == "none" ? 0.0 : entry.second));
  for (const auto &entry : model.spin_unlike)
    command("pair_coeff " + std::to_string(entry.first.first) + " " +
            std::to_string(entry.first.second) + spin_words(entry.second, true));
}

std::vector<double> LammpsDriver::gather(int width,
                                         const std::function<double(int, int)> &value) const
{
  std::vector<double> mine(width * natoms, 0.0), all(width * natoms, 0.0);
  for (int i = 0; i < lmp->atom->nlocal; i++)
    for (int k = 0; k < width; k++) mine[width * (lmp->atom->tag[i] - 1) + k] = value(i, k);
  MPI_Reduce(mine.data(), all.data(), width * natoms, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  return all;
}

Computed LammpsDriver::run0(bool with_virial)
{
  Computed result;
  const bool ours = lmp->modify->get_compute_by_id("property") != nullptr;
  if (ours)
    command(with_virial ? "thermo_style custom step pe press c_sum[1] c_sum[2]"
                        : "thermo_style custom step");
  if (!command("run 0 post no")) {
    result.force.assign(3 * natoms, std::nan(""));
    return result;
  }

  const Atom *atom = lmp->atom;
  result.force = gather(3, [=](int i, int k) {
    return atom->f[i][k];
  });
  result.desph = gather(1, [=](int i, int) {
    return atom->desph[i];
  });
  if (!ours) return result;
  if (Compute *dissipation = lmp->modify->get_compute_by_id("dissipation")) {
    result.torque = gather(3, [=](int i, int k) {
      return atom->torque[i][k];
    });
    dissipation->compute_vector();
    result.power.assign(dissipation->vector, dissipation->vector + dissipation->size_vector);
  }

  Compute *property = lmp->modify->get_compute_by_id("property");
  property->compute_peratom();
  auto column = [&](int k) {
    return gather(1, [=](int i, int) {
      return property->array_atom[i][k];
    });
  };
  result.numden = column(0);
  result.dnumden = column(1);
  result.volume = column(2);
  result.density = column(3);
  result.energy = column(4);
  MPI_Allreduce(lmp->force->pair->pvector, &result.beyond_limit, 1, MPI_DOUBLE, MPI_SUM,
                MPI_COMM_WORLD);
  if (!with_virial) return result;

  double mine[7], all[7];
  std::copy(lmp->force->pair->virial, lmp->force->pair->virial + 6, mine);
  mine[6] = lmp->force->pair->eng_vdwl;
  MPI_Allreduce(mine, all, 7, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  std::copy(all, all + 6, result.total_virial);
  result.total_energy = all[6];

  // LAMMPS's stress per atom is minus the virial
  const Compute *stress = lmp->modify->get_compute_by_id("stress");
  result.atom_virial = gather(6, [=](int i, int k) {
    return -stress->array_atom[i][k];
  });
  const Compute *energy = lmp->modify->get_compute_by_id("energy");
  result.atom_energy = gather(1, [=](int i, int) {
    return energy->vector_atom[i];
  });
  return result;
}
