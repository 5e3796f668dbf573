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

#include "sph_dissipation_viscous_keywords.h"

#include "error.h"
#include "sph_dissipation_solvers.h"
#include "utils.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

int ViscousKeywords::argument(int iarg, int narg, char **arg)
{
  const std::string keyword = arg[iarg];
  if (keyword != "viscous" && keyword != "scheme" && keyword != "stages" &&
      keyword != "tolerance" && keyword != "iterations")
    return 0;
  const int nwords = (keyword == "iterations") ? 3 : 2;
  if (iarg + nwords > narg)
    utils::missing_cmd_args(FLERR, fmt::format("fix {} {}", style, keyword), error);
  const std::string word = arg[iarg + 1];

  if (keyword == "viscous") {
    if (word == "explicit")
      chosen.mode = Viscous::EXPLICIT;
    else if (word == "rkl2")
      chosen.mode = Viscous::RKL2;
    else if (word == "implicit")
      chosen.mode = Viscous::IMPLICIT;
    else
      error->all(FLERR, "Fix {} viscous must be explicit, rkl2, or implicit, not {}", style, word);
    return nwords;
  }

  if (keyword == "stages") {
    rkl2_only = keyword;
    chosen.stages = (word == "auto") ? 0 : utils::inumeric(FLERR, word, false, lmp);
    if (word != "auto" &&
        (chosen.stages < RKL2::FEWEST || chosen.stages > RKL2::MOST || chosen.stages % 2 == 0))
      error->all(FLERR, "Fix {} stages must be auto or an odd number from {} to {}, not {}", style,
                 static_cast<int>(RKL2::FEWEST), static_cast<int>(RKL2::MOST), word);
    return nwords;
  }

  implicit_only = keyword;
  if (keyword == "scheme") {
    if (word == "trapezoidal")
      chosen.scheme = Scheme::TRAPEZOIDAL;
    else if (word == "sdirk2")
      chosen.scheme = Scheme::SDIRK2;
    else if (word == "euler")
      chosen.scheme = Scheme::EULER;
    else
      error->all(FLERR, "Fix {} scheme must be trapezoidal, sdirk2, or euler, not {}", style, word);
  } else if (keyword == "tolerance") {
    chosen.tolerance = utils::numeric(FLERR, word, false, lmp);
    if (!(chosen.tolerance > 0.0) || !(chosen.tolerance < 1.0))
      error->all(FLERR, "Fix {} tolerance must be > 0 and < 1, not {}", style, word);
  } else {
    const std::string otherwise = arg[iarg + 2];
    chosen.iterations = utils::inumeric(FLERR, word, false, lmp);
    if (chosen.iterations < 1)
      error->all(FLERR, "Fix {} iterations must be >= 1, not {}", style, word);
    if (otherwise != "warn" && otherwise != "error")
      error->all(FLERR, "Fix {} iterations must end with warn or error, not {}", style, otherwise);
    chosen.must_converge = (otherwise == "error");
  }
  return nwords;
}

/* ---------------------------------------------------------------------- */

const ViscousSettings &ViscousKeywords::settings() const
{
  if (chosen.mode != Viscous::RKL2 && !rkl2_only.empty())
    error->all(FLERR, "Fix {} {} is for viscous rkl2 only", style, rkl2_only);
  if (chosen.mode != Viscous::IMPLICIT && !implicit_only.empty())
    error->all(FLERR, "Fix {} {} is for viscous implicit only", style, implicit_only);
  return chosen;
}
