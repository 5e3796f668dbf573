/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// fix sph/refine refuses particles with bonds, also in a LAMMPS without the package that has them:
// its particles are declared to be of a molecular style.

#include "atom.h"
#include "exceptions.h"
#include "input.h"
#include "lammps.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <string>

using namespace LAMMPS_NS;

// the error that LAMMPS raises, empty without one

static std::string error_of(LAMMPS &lmp, const std::string &line)
{
  try {
    lmp.input->one(line);
  } catch (const LAMMPSException &error) {
    return error.what();
  }
  return "";
}

TEST(Refine, molecules)
{
  const char *args[] = {"test", "-log", "none", "-screen", "none", "-nocite"};
  LAMMPS lmp(6, const_cast<char **>(args), MPI_COMM_WORLD);
  for (const char *line :
       {"dimension 2", "atom_style sph/bulk", "region box block 0 9 0 9 -0.5 0.5",
        "create_box 1 box", "create_atoms 1 single 4 4 0", "create_atoms 1 single 5 4 0",
        "set group all mass 1.0", "pair_style sph/bulk volume mass",
        "pair_coeff 1 1 1.0 10.0 0.5 2.0 3.0", "fix FLUID all sph/bulk"})
    ASSERT_EQ(error_of(lmp, line), "");

  for (const int molecular : {Atom::MOLECULAR, Atom::TEMPLATE}) {
    lmp.atom->molecular = molecular;
    EXPECT_NE(error_of(lmp, "fix R all sph/refine 1 volume 1.0").find("molecules or bonds"),
              std::string::npos);
    lmp.atom->molecular = Atom::ATOMIC;
  }
  EXPECT_EQ(error_of(lmp, "fix R all sph/refine 1 volume 1.0"), "");
}
