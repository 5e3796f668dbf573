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

// The styles of SPH-DISSIPATION as a plugin. LAMMPS registers pair, fix and compute styles from plugins, but no atom
// styles: those are entered here into the map of the current Atom object, which "clear" and "replicate" replace.

// the one symbol that LAMMPS must find in this file, see CMakeLists.txt
#pragma GCC visibility push(default)
#include "lammpsplugin.h"
#pragma GCC visibility pop

#include "atom.h"
#include "comm.h"
#include "command.h"
#include "error.h"
#include "input.h"
#include "library.h"
#include "version.h"

#include "style_atom.h"
#include "style_compute.h"
#include "style_fix.h"
#include "style_pair.h"

#include <map>
#include <string>

using namespace LAMMPS_NS;

namespace {
template <class T> AtomVec *atom_creator(LAMMPS *lmp)
{
  return new T(lmp);
}

template <class T> Pair *pair_creator(LAMMPS *lmp)
{
  return new T(lmp);
}

template <class T> Fix *fix_creator(LAMMPS *lmp, int narg, char **arg)
{
  return new T(lmp, narg, arg);
}

template <class T> Compute *compute_creator(LAMMPS *lmp, int narg, char **arg)
{
  return new T(lmp, narg, arg);
}

std::map<std::string, Atom::AtomVecCreator> all_atom_styles()
{
  std::map<std::string, Atom::AtomVecCreator> styles;
#define ATOM_CLASS
#define AtomStyle(key, Class) styles[#key] = &atom_creator<Class>
#include "style_atom.h"
#undef AtomStyle
#undef ATOM_CLASS
  return styles;
}

const std::map<std::string, Atom::AtomVecCreator> ATOM_STYLES = all_atom_styles();

/* ----------------------------------------------------------------------
   replicate copies the system into a new Atom object, which does not know
   atom styles from plugins: say so instead of "unrecognized atom style"
------------------------------------------------------------------------- */

Input::CommandCreator lammps_replicate = nullptr;

class PluginReplicate : public Command {
 public:
  PluginReplicate(LAMMPS *lmp) : Command(lmp) {}

  void command(int narg, char **arg) override
  {
    for (const auto &style : ATOM_STYLES)
      if (atom->style_match(style.first.c_str()))
        error->all(FLERR, "Cannot replicate atom style {} loaded from a plugin: build LAMMPS with the "
                   "SPH-DISSIPATION package, or create all particles at once", style.first);
    Command *original = lammps_replicate(lmp);
    original->command(narg, arg);
    delete original;
  }
};

Command *replicate_creator(LAMMPS *lmp)
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
  for (const auto &style : ATOM_STYLES) {
    const auto known = atom_styles.find(style.first);
    if ((known != atom_styles.end()) && (known->second != style.second)) {
      if (lmp->comm->me == 0)
        lmp->error->warning(FLERR, "This LAMMPS has the SPH-DISSIPATION package: its plugin is not loaded");
      return;
    }
    atom_styles[style.first] = style.second;
  }

  auto &commands = *lmp->input->command_map;
  if (commands["replicate"] != &replicate_creator) {
    lammps_replicate = commands["replicate"];
    commands["replicate"] = &replicate_creator;
  }

  auto register_plugin = (lammpsplugin_regfunc) regfunc;
  lammpsplugin_t plugin;
  plugin.version = LAMMPS_VERSION;
  plugin.author = "the SPH-DISSIPATION authors";
  plugin.handle = handle;

#define PAIR_CLASS
#define PairStyle(key, Class)                                          \
  plugin.style = "pair";                                               \
  plugin.name = #key;                                                  \
  plugin.info = "SPH-DISSIPATION pair style " #key;                    \
  plugin.creator.v1 = (lammpsplugin_factory1 *) &pair_creator<Class>;  \
  (*register_plugin)(&plugin, lmp)
#include "style_pair.h"
#undef PairStyle
#undef PAIR_CLASS

#define FIX_CLASS
#define FixStyle(key, Class)                                          \
  plugin.style = "fix";                                               \
  plugin.name = #key;                                                 \
  plugin.info = "SPH-DISSIPATION fix style " #key;                    \
  plugin.creator.v2 = (lammpsplugin_factory2 *) &fix_creator<Class>;  \
  (*register_plugin)(&plugin, lmp)
#include "style_fix.h"
#undef FixStyle
#undef FIX_CLASS

#define COMPUTE_CLASS
#define ComputeStyle(key, Class)                                          \
  plugin.style = "compute";                                               \
  plugin.name = #key;                                                     \
  plugin.info = "SPH-DISSIPATION compute style " #key;                    \
  plugin.creator.v2 = (lammpsplugin_factory2 *) &compute_creator<Class>;  \
  (*register_plugin)(&plugin, lmp)
#include "style_compute.h"
#undef ComputeStyle
#undef COMPUTE_CLASS
}
