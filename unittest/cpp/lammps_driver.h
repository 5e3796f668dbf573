/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Runs LAMMPS as a library on a test configuration and collects what it computes on rank 0, sorted
// by particle.

#ifndef SPHD_LAMMPS_DRIVER_H
#define SPHD_LAMMPS_DRIVER_H

#include "configuration.h"
#include "dense_reference.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

// on rank 0: all particles by ascending ID; on other ranks without meaning

struct Computed {
  std::vector<double> force;    // 3 per particle
  std::vector<double> desph, numden, dnumden, volume, density, energy;
  std::vector<double> torque;    // 3 per particle, micropolar fluids only
  std::vector<double> power;     // dissipation: shear, bulk, vortex, spin; likewise
  std::vector<double> atom_energy, atom_virial;    // virial: 6 per particle
  double beyond_limit = 0.0;    // number of particles with too negative a bulk coefficient
  double total_energy = 0.0, total_virial[6] = {};
};

// how the particles are spread over the ranks

struct Layout {
  bool newton = true;
  std::string processors = "* * *";
  bool tiled = false;
  std::string simd = "auto";    // instruction set of the pair loops
};

class LammpsDriver {
 public:
  LammpsDriver();
  ~LammpsDriver();

  // false, and a test failure, if LAMMPS raised an error
  bool command(const std::string &line);

  // names of the instruction sets whose loops can run here
  std::vector<std::string> instruction_sets();

  // a new box with the particles of the configuration and an integrator
  void create(const Configuration &config, const Layout &layout);

  // the same box for LAMMPS's own SPH styles, with masses by type and given densities
  void create_lammps_sph(const Configuration &config, const std::vector<double> &density);

  // pair_style of these settings and the fluids of the model; sph/micropolar, which has no choice
  // of shear, if the model has spin viscosities
  void pair_style(const DenseReference::Model &model, const std::string &eos,
                  const std::string &shear, const std::string &bulk,
                  const std::string &keywords = "");

  Computed run0(bool with_virial = false);

  static int rank();
  static int ranks();
  static void broadcast(std::vector<double> &values);    // from rank 0, sizes already equal

 private:
  void create_box(const Configuration &config, const Layout &layout, const std::string &style);
  void create_particles(const Configuration &config);
  std::vector<double> gather(int width, const std::function<double(int, int)> &value) const;

  std::unique_ptr<LAMMPS_NS::LAMMPS> lmp;
  int natoms;
  std::string simd;
};

// the one instance of all tests of an executable

LammpsDriver &lammps();

#endif
