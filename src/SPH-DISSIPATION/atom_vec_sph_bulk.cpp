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

#include "atom_vec_sph_bulk.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "memory.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_model.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// Names for compute property/atom, in the order of their index, those of spins last; "temperature" is a name of LAMMPS

static constexpr const char *PROPERTY[] = {
    "numden", "dnumden", "vol",       "rho",        "esph",     "desph",
    "tsph",   "offset",  "surface",   "shear_rate", "vestx",    "vesty",
    "vestz",  "inertia", "omegaestx", "omegaesty",  "omegaestz"};
enum { NUMDEN, DNUMDEN, VOL, RHO, ESPH, DESPH, TSPH, OFFSET, SURFACE, SHEAR_RATE, VESTX };
enum { INERTIA = VESTX + 3, OMEGAESTX, NPROPERTY = OMEGAESTX + 3 };    // then the states

static constexpr int CUSTOM_DOUBLE = 1;    // data type of Atom::add_custom()

/* ---------------------------------------------------------------------- */

AtomVecSPHBulk::AtomVecSPHBulk(LAMMPS *lmp) : AtomVecSPHBulk(lmp, false) {}

/* ---------------------------------------------------------------------- */

AtomVecSPHBulk::AtomVecSPHBulk(LAMMPS *lmp, bool spins, bool in_views) :
    AtomVec(lmp), Fields(spins), owner(atom), in_views(in_views)
{
  molecular = Atom::ATOMIC;
  mass_type = PER_ATOM;
  forceclearflag = 1;

  atom->rmass_flag = 1;
  atom->esph_flag = 1;
  atom->vest_flag = 1;

  for (const auto &field : atom->peratom)
    if (field.name == "desph_before")
      error->all(FLERR,
                 "Atom style hybrid of sph/bulk and sph/micropolar: use one of the two, "
                 "sph/micropolar has all that sph/bulk has");
  add_array("desph_before", &desph_before);
  add_array("rho_sum", &rho_sum);
  add_array("vol_rate", &vol_rate);
  add_array("vol_rate_before", &vol_rate_before);
  add_array("vol_heat", &vol_heat);
  add_array("vol_support", &vol_support);
  add_array("shear_rate", &shear_rate);
  add_array("shear_mu", &shear_mu);
  add_array("trace", &trace, NTRACE);

  // Fields of each AtomVec method, but for its default fields; the order matters in fields_data_atom and fields_data_vel
  // alone, which must match data files.  In every step, the pair style computes rho, drho, vfrac of owned and ghost atoms,
  // with density continuity from rho and rho_sum of the last step; restart files have vest and desph_before of the last step

  fields_grow = {"rmass", "rho", "drho", "vfrac", "esph", "desph", "vest"};
  const std::vector<std::string> kept = {"rho_sum",     "vol_rate",   "vol_rate_before", "vol_heat",
                                         "vol_support", "shear_rate", "shear_mu",        "trace"};
  fields_copy = {"rmass", "rho", "drho", "vfrac", "esph", "desph", "vest", "desph_before"};
  fields_comm = {"vest"};
  fields_comm_vel = {"vest"};
  fields_reverse = {"desph"};
  fields_border = {"rmass", "esph", "vest"};
  fields_border_vel = {"rmass", "esph", "vest"};
  fields_exchange = {"rmass", "rho", "esph", "vest", "desph_before"};
  for (auto *list : {&fields_copy, &fields_exchange})
    list->insert(list->end(), kept.begin(), kept.end());
  fields_restart = fields_exchange;
  fields_create = fields_copy;
  fields_data_atom = {"id", "type", "rmass", "esph", "x"};
  fields_data_vel = {"id", "v"};

  if (has_spins) add_spins();
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulk::process_args(int narg, char **arg)
{
  add_columns(narg, arg);
  setup_fields();
}

/* ----------------------------------------------------------------------
   Make room for states, and a column for the density.  Data files have them before the position: lines of velocities have no
   room, because the buffer of WriteData::velocities() has a limited width.
------------------------------------------------------------------------- */

void AtomVecSPHBulk::add_columns(int narg, char **arg)
{
  const std::string style = has_spins ? "sph/micropolar" : "sph/bulk";
  const auto insert = [this](const std::string &name) {
    fields_data_atom.insert(fields_data_atom.end() - 1, name);
  };
  for (int iarg = 0; iarg < narg; iarg++)
    if (field_name(arg[iarg]) == "rho") density_in_files = true;
  if (density_in_files) insert("rho");
  for (int iarg = 0; iarg < narg; iarg++) {
    const std::string keyword = field_name(arg[iarg]);
    if (keyword == "rho") continue;
    const auto owner =
        std::find_if(state_table().begin(), state_table().end(), [&](const StateInfo &one) {
          return one.has_column() && keyword == one.keyword && !room(one);
        });
    if (owner == state_table().end()) {
      std::vector<std::string> known = {"rho"};
      for (const StateInfo &one : state_table())
        if (one.has_column()) known.emplace_back(one.keyword);
      unknown_word(lmp, arg[iarg], fmt::format("Unknown atom_style {} keyword: {}", style, keyword),
                   known);
    }
    int n = 1;
    if (owner->most > 1) {
      demand_words(lmp, "atom_style " + style + " " + keyword, narg - ++iarg, "N");
      n = utils::inumeric(FLERR, arg[iarg], false, lmp);
      if (n < 1 || n > owner->most)
        error->all(FLERR, "Atom_style {} {} must be 1 to {}, not {}", style, keyword, owner->most,
                   arg[iarg]);
    }
    for (const StateInfo &one : state_table())
      for (int slot = one.first; slot < one.first + std::min(n, one.most); slot++) {
        if (one.owner != owner->first) continue;
        const std::string name = state_name(slot);
        slots.push_back(slot);
        add_array(name, &state[slot]);
        for (auto *list : {&fields_copy, &fields_exchange, &fields_restart, &fields_create})
          list->push_back(name);
        for (auto *list : {&fields_comm, &fields_comm_vel, &fields_border, &fields_border_vel})
          if (one.ghosts) list->push_back(name);
        if (one.has_column()) insert(name);
      }
  }
}

/* ----------------------------------------------------------------------
   Put a state without its own column in data files into the last column of another channel (used), or clear that column.
------------------------------------------------------------------------- */

void AtomVecSPHBulk::share_columns(int ilocal, bool used) const
{
  for (const StateInfo &one : state_table())
    if (!one.has_column() && room(one) && state[one.first][ilocal] > 0.0)
      state[one.owner + room(state_info(one.owner)) - 1][ilocal] = used ? state[one.first][ilocal]
                                                                        : 0.0;
}

/* ----------------------------------------------------------------------
   Warn of densities that a data file does not have; style hybrid calls pack_data_pre() alone.
------------------------------------------------------------------------- */

void AtomVecSPHBulk::pack_data(double **buf)
{
  warn_of_lost_densities();
  AtomVec::pack_data(buf);
}

void AtomVecSPHBulk::warn_of_lost_densities() const
{
  const Fluid *const fluid = find_fluid(force);
  if (fluid && fluid->model->choice.continuity && !density_in_files && comm->me == 0)
    error->warning(FLERR,
                   "Data file without the densities of density continuity, which become rho0: use "
                   "atom_style {} rho, or write_restart",
                   fluid->style);
}

void AtomVecSPHBulk::pack_data_pre(int ilocal)
{
  if (ilocal == 0 && atom->avec != this) warn_of_lost_densities();
  share_columns(ilocal, true);
  if (!slots.empty()) check_data_line(ilocal);
}

/* ----------------------------------------------------------------------
   Stop if the line of an atom exceeds the buffer of read_data, which would drop the rest.  With style hybrid, the fields are
   those of hybrid.
------------------------------------------------------------------------- */

void AtomVecSPHBulk::check_data_line(int ilocal) const
{
  constexpr std::size_t OTHERS = 100;    // with fewer characters of states a line is short enough
  constexpr std::size_t INTEGER = 12;

  std::size_t length = 0;
  for (int slot : slots) length += fmt::format(" {:.16}", state[slot][ilocal]).size();
  if (length < OTHERS) return;

  imageint *const image = &atom->image[ilocal];
  length = fmt::format("{} {} {} {} {}", atom->tag ? atom->tag[ilocal] : 0, atom->type[ilocal],
                       (*image & IMGMASK) - IMGMAX, (*image >> IMGBITS & IMGMASK) - IMGMAX,
                       (*image >> IMG2BITS) - IMGMAX)
               .size();
  for (const auto &name : atom->avec->fields_data_atom) {
    if (name == "id" || name == "type") continue;
    const auto field =
        std::find_if(atom->peratom.begin(), atom->peratom.end(), [&](const auto &one) {
          return one.name == name;
        });
    if (field == atom->peratom.end()) continue;
    if (field->datatype != Atom::DOUBLE)
      length += INTEGER * std::max(field->cols, 1);
    else if (field->cols == 0)
      length += fmt::format(" {:.16}", (*(double **) field->address)[ilocal]).size();
    else
      for (int d = 0; d < field->cols; d++)
        length += fmt::format(" {}", (*(double ***) field->address)[ilocal][d]).size();
  }
  if (length > MOST_OF_DATA_LINE)
    error->one(FLERR,
               "Cannot write a data file: the line of atom {} has {} characters, and read_data "
               "takes {}, which is too few for its states; use write_restart",
               atom->tag ? atom->tag[ilocal] : 0, length, MOST_OF_DATA_LINE);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulk::add_spins()
{
  add_array("inertia", &inertia);
  add_array("omegaest", &omegaest, 3);

  atom->omega_flag = 1;
  atom->torque_flag = 1;

  fields_grow.insert(fields_grow.end(), {"omega", "torque"});
  for (auto *fields : {&fields_copy, &fields_create})
    fields->insert(fields->end(), {"omega", "torque", "inertia", "omegaest"});
  fields_exchange.insert(fields_exchange.end(), {"omega", "inertia", "omegaest"});
  for (auto *fields : {&fields_comm, &fields_comm_vel, &fields_border, &fields_border_vel})
    fields->push_back("omegaest");
  fields_reverse.push_back("torque");
  fields_restart.insert(fields_restart.end(), {"omega", "inertia", "omegaest"});
  fields_data_atom = {"id", "type", "rmass", "inertia", "esph", "x"};
  fields_data_vel = {"id", "v", "omega"};
}

/* ----------------------------------------------------------------------
   Remove the arrays through owner, not through atom: when replicate deletes the old atom style, atom is the new one.
------------------------------------------------------------------------- */

AtomVecSPHBulk::~AtomVecSPHBulk()
{
  auto &fields = owner->peratom;
  for (const auto &own : own_arrays) {
    fields.erase(std::remove_if(fields.begin(), fields.end(),
                                [&](const auto &field) {
                                  return field.name == own.name;
                                }),
                 fields.end());
    if (in_views && !own.cols) owner->dvector[own.index] = nullptr;    // memory of the views
    owner->remove_custom(own.index, CUSTOM_DOUBLE, own.cols);
  }
}

/* ----------------------------------------------------------------------
   Add an array that class Atom has no member for, with one value per atom or with columns.  Class Atom owns the array as a
   custom property, which the library and other commands can read.  The array is not in fields_grow: style hybrid deletes its
   sub-styles before it frees such arrays.  Do not call add_custom() of class AtomKokkos for a vector: that function would sync the
   atom style before the atom style is constructed.
------------------------------------------------------------------------- */

void AtomVecSPHBulk::add_array(const std::string &name, double **vector, double ***array, int cols)
{
  int flag, known_cols;
  if (atom->find_custom(name.c_str(), flag, known_cols) >= 0)
    error->all(FLERR, "Atom style needs a custom property {}, which is there already", name);
  const int index = cols ? atom->add_custom(name.c_str(), CUSTOM_DOUBLE, cols)
                         : atom->Atom::add_custom(name.c_str(), CUSTOM_DOUBLE, cols);
  own_arrays.push_back({name, index, cols, vector, array});
  atom->add_peratom(name, array ? (void *) array : (void *) vector, Atom::DOUBLE, cols);
}

/* ----------------------------------------------------------------------
   Set the pointers of this class to the arrays, after they have grown; grow the own arrays.  Command replicate needs the
   pointers when it calls pack_restart(), while two atom styles exist.
------------------------------------------------------------------------- */

void AtomVecSPHBulk::grow_pointers()
{
  const int n = nmax_own = std::max(nmax_own, owner->nmax);
  if (in_views) show_custom_vectors();
  for (const auto &own : own_arrays) {
    if (in_views) {
      if (!own.cols) continue;
      double **&rows = owner->darray[own.index];
      rows = (double **) memory->srealloc(rows, n * sizeof(double *), "atom:own");
      std::copy_n(*own.array, owner->nmax, rows);
    } else if (own.cols)
      *own.array = memory->grow(owner->darray[own.index], n, own.cols, "atom:own");
    else
      *own.vector = memory->grow(owner->dvector[own.index], n, "atom:own");
  }

  rmass = atom->rmass;
  rho = atom->rho;
  drho = atom->drho;
  vfrac = atom->vfrac;
  esph = atom->esph;
  desph = atom->desph;
  vest = atom->vest;
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulk::show_custom_vectors()
{
  for (const auto &own : own_arrays)
    if (!own.cols) owner->dvector[own.index] = *own.vector;
}

/* ----------------------------------------------------------------------
   Clear the heating from atom n on; nbytes = # of bytes to clear in a per-atom vector.
------------------------------------------------------------------------- */

void AtomVecSPHBulk::force_clear(int n, size_t nbytes)
{
  memset(&desph[n], 0, nbytes);
}

/* ----------------------------------------------------------------------
   Check the numbers of an atom from a data file, and set all others.
------------------------------------------------------------------------- */

void AtomVecSPHBulk::data_atom_post(int ilocal)
{
  if (!(rmass[ilocal] > 0.0))
    error->one(FLERR, "Invalid mass {} in Atoms section of data file: mass must be > 0",
               rmass[ilocal]);
  if (density_in_files && !(rho[ilocal] >= 0.0))
    error->one(FLERR, "Invalid density {} in Atoms section of data file: must be >= 0",
               rho[ilocal]);
  if (!density_in_files) rho[ilocal] = 0.0;
  rho_sum[ilocal] = vol_rate[ilocal] = vol_rate_before[ilocal] = vol_heat[ilocal] =
      vol_support[ilocal] = shear_rate[ilocal] = shear_mu[ilocal] = 0.0;
  std::fill_n(trace[ilocal], NTRACE, 0.0);
  unpack_restart_init(ilocal);
  desph_before[ilocal] = vest[ilocal][0] = vest[ilocal][1] = vest[ilocal][2] = 0.0;
  for (int slot : slots)
    if (!state_info(slot).has_column()) state[slot][ilocal] = -1.0;
  if (!has_spins) return;
  if (!(inertia[ilocal] >= 0.0))
    error->one(FLERR, "Invalid inertia {} in Atoms section of data file: must be >= 0",
               inertia[ilocal]);
  for (int d = 0; d < 3; d++) omegaest[ilocal][d] = atom->omega[ilocal][d] = 0.0;
}

/* ----------------------------------------------------------------------
   Set the numbers to 0 that restart files do not have, since the force computation sets them.
------------------------------------------------------------------------- */

void AtomVecSPHBulk::unpack_restart_init(int ilocal)
{
  drho[ilocal] = vfrac[ilocal] = desph[ilocal] = 0.0;
  if (!has_spins) return;
  for (int d = 0; d < 3; d++) atom->torque[ilocal][d] = 0.0;
}

/* ----------------------------------------------------------------------
   Return the index of a named atom property; -1 if this atom style does not have the name.
------------------------------------------------------------------------- */

int AtomVecSPHBulk::property_atom(const std::string &name)
{
  const int n = has_spins ? NPROPERTY : INERTIA;
  for (int index = 0; index < n; index++)
    if (field_name(name) == PROPERTY[index]) return index;
  for (int slot : slots)
    if (name == state_name(slot)) return NPROPERTY + slot;
  return -1;
}

/* ----------------------------------------------------------------------
   Pack an atom property into buf for ComputePropertyAtom; index = from property_atom().
------------------------------------------------------------------------- */

void AtomVecSPHBulk::pack_property_atom(int index, double *buf, int nvalues, int groupbit)
{
  const int *mask = atom->mask;
  const int nlocal = atom->nlocal;
  if (index == SURFACE &&
      !(find_fluid(lmp, "Compute property/atom surface")->model->choice.delta > 0.0))
    error->all(FLERR,
               "Compute property/atom surface needs a pair style with density continuity and delta "
               "> 0");
  if (index == SHEAR_RATE &&
      !find_fluid(lmp, "Compute property/atom shear_rate")->model->has_rheology())
    error->all(FLERR,
               "Compute property/atom shear_rate needs a pair style with power, carreau, cross, "
               "yield, smagorinsky, arrhenius, or thixotropy of pair_coeff");
  const std::vector<double> temperature = (index == TSPH) ? temperatures() : std::vector<double>();

  // arrays in the order of the names

  const double *const array[VESTX] = {
      nullptr, nullptr,     vfrac,     rho, esph, desph, temperature.data(),
      nullptr, vol_support, shear_rate};

  for (int i = 0, n = 0; i < nlocal; i++, n += nvalues) {
    buf[n] = 0.0;
    if (!(mask[i] & groupbit)) continue;
    switch (index) {
      case NUMDEN:
        buf[n] = rho[i] / rmass[i];
        break;
      case DNUMDEN:
        buf[n] = drho[i] / rmass[i];
        break;
      case OFFSET:
        buf[n] = (rho_sum[i] > 0.0) ? (rho[i] - rho_sum[i]) / rmass[i] : 0.0;
        break;
      default:
        buf[n] = (index >= NPROPERTY) ? state_value(index - NPROPERTY, i)
            : (index < VESTX)         ? array[index][i]
            : (index < INERTIA)       ? vest[i][index - VESTX]
            : (index == INERTIA)      ? inertia[i]
                                      : omegaest[i][index - OMEGAESTX];
    }
  }
}

/* ----------------------------------------------------------------------
   Return a state for output: 0 if a negative number marks an unknown state; amounts may be negative.
------------------------------------------------------------------------- */

double AtomVecSPHBulk::state_value(int slot, int i) const
{
  const double value = state[slot][i];
  return (state_info(slot).kind == StateKind::EXTENSIVE) ? value : std::max(value, 0.0);
}

/* ----------------------------------------------------------------------
   Return the temperatures of owned particles, from the pair style, which has the heat capacities.
------------------------------------------------------------------------- */

std::vector<double> AtomVecSPHBulk::temperatures() const
{
  const char *const name = PROPERTY[TSPH];
  const Fluid *const fluid = find_fluid(lmp, fmt::format("Compute property/atom {}", name));
  if (!fluid->is_set_up())
    error->all(FLERR,
               "Compute property/atom {} needs the coefficients of the present pair style: use run "
               "0 first",
               name);
  std::vector<double> result(atom->nlocal);
  fluid->temperatures(result.data());
  return result;
}

/* ----------------------------------------------------------------------
   Return bytes.  Style hybrid does not call this function: there the own arrays are not counted.
------------------------------------------------------------------------- */

double AtomVecSPHBulk::memory_usage()
{
  double bytes = AtomVec::memory_usage();
  for (const auto &own : own_arrays)
    bytes += (double) nmax_own * std::max(own.cols, 1) * sizeof(double);
  return bytes;
}
