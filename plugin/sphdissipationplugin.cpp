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

// The styles of SPH-DISSIPATION as a plugin. LAMMPS registers pair and fix styles from plugins, but no atom styles:
// those are entered here into the map of the current Atom object, where "clear" and "replicate" lose them.

// the one symbol that LAMMPS must find in this file, see CMakeLists.txt
#pragma GCC visibility push(default)
#include "lammpsplugin.h"
#pragma GCC visibility pop

#include "atom.h"
#include "atom_vec_sph_bulk.h"
#include "command.h"
#include "comm.h"
#include "error.h"
#include "fix_sph_bulk.h"
#include "input.h"
#include "library.h"
#include "pair_sph_bulk.h"
#include "version.h"

#include <cstring>
#include <string>

using namespace LAMMPS_NS;

namespace {
constexpr char AUTHOR[] = "The SPH-DISSIPATION developers";

AtomVec *atom_vec_sph_bulk(LAMMPS *lmp)
{
  return new AtomVecSPHBulk(lmp);
}

Pair *pair_sph_bulk(LAMMPS *lmp)
{
  return new PairSPHBulk(lmp);
}

Fix *fix_sph_bulk(LAMMPS *lmp, int narg, char **arg)
{
  return new FixSPHBulk(lmp, narg, arg);
}

/* ----------------------------------------------------------------------
   replicate copies the system into a new Atom object, which does not know
   atom styles from plugins: say so instead of "unknown atom style"
------------------------------------------------------------------------- */

Input::CommandCreator lammps_replicate = nullptr;

class PluginReplicate : public Command {
 public:
  PluginReplicate(LAMMPS *lmp) : Command(lmp) {}

  void command(int narg, char **arg) override
  {
    if (dynamic_cast<AtomVecSPHBulk *>(atom->style_match("sph/bulk")))
      error->all(FLERR, "Cannot replicate atom style sph/bulk loaded from a plugin: "
                        "build LAMMPS with the SPH-DISSIPATION package, or create all particles at once");
    Command *original = lammps_replicate(lmp);
    original->command(narg, arg);
    delete original;
  }
};

Command *plugin_replicate(LAMMPS *lmp)
{
  return new PluginReplicate(lmp);
}

/* ----------------------------------------------------------------------
   why the host cannot run this plugin; asked through its C library interface,
   since classes of another version may look different in memory
------------------------------------------------------------------------- */

std::string mismatch(void *lmp)
{
  const int host = lammps_version(lmp);
  const int ours = utils::date2num(LAMMPS_VERSION);
  if (host != ours)
    return "was compiled for LAMMPS version " + std::to_string(ours) + ", but this is version " + std::to_string(host);
  if (lammps_extract_setting(lmp, "tagint") != (int) sizeof(tagint))
    return "was compiled for other LAMMPS_SIZES (smallbig or bigbig) than this LAMMPS";
  return "";
}
}    // namespace

extern "C" void lammpsplugin_init(void *ptr, void *handle, void *regfunc)
{
  const std::string problem = mismatch(ptr);
  if (!problem.empty()) {
    const std::string message =
        "The plugin with SPH-DISSIPATION " + problem + ": compile it with the source of this LAMMPS";
    lammps_error(ptr, LMP_ERROR_ALL, message.c_str());
  }

  auto *lmp = (LAMMPS *) ptr;
  auto &atom_styles = *lmp->atom->avec_map;
  const auto known = atom_styles.find("sph/bulk");
  if ((known != atom_styles.end()) && (known->second != &atom_vec_sph_bulk)) {
    if (lmp->comm->me == 0)
      lmp->error->warning(FLERR, "This LAMMPS has the SPH-DISSIPATION package: its plugin is not loaded");
    return;
  }
  atom_styles["sph/bulk"] = &atom_vec_sph_bulk;

  auto &commands = *lmp->input->command_map;
  if (commands["replicate"] != &plugin_replicate) {
    lammps_replicate = commands["replicate"];
    commands["replicate"] = &plugin_replicate;
  }

  auto register_plugin = (lammpsplugin_regfunc) regfunc;
  lammpsplugin_t plugin;
  plugin.version = LAMMPS_VERSION;
  plugin.author = AUTHOR;
  plugin.handle = handle;

  plugin.style = "pair";
  plugin.name = "sph/bulk";
  plugin.info = "SPH-DISSIPATION pair style sph/bulk";
  plugin.creator.v1 = (lammpsplugin_factory1 *) &pair_sph_bulk;
  (*register_plugin)(&plugin, lmp);

  plugin.style = "fix";
  plugin.info = "SPH-DISSIPATION fix style sph/bulk";
  plugin.creator.v2 = (lammpsplugin_factory2 *) &fix_sph_bulk;
  (*register_plugin)(&plugin, lmp);
}
