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

#include "atom_vec_sph_bulk.h"

#include "atom.h"
#include "error.h"

#include <cstring>

using namespace LAMMPS_NS;

// names known to compute property/atom, in the order of their index

static constexpr const char *PROPERTY[] = {"numden", "dnumden", "vol",   "rho",  "esph",
                                           "desph",  "vestx",   "vesty", "vestz"};
enum { NUMDEN, DNUMDEN, VOL, RHO, ESPH, DESPH, VESTX, VESTY, VESTZ, NPROPERTY };

/* ---------------------------------------------------------------------- */

AtomVecSPHBulk::AtomVecSPHBulk(LAMMPS *lmp) : AtomVecSPHBulk(lmp, COMPLETE) {}

/* ---------------------------------------------------------------------- */

AtomVecSPHBulk::AtomVecSPHBulk(LAMMPS *lmp, Complete complete) :
    AtomVec(lmp), rmass(nullptr), rho(nullptr), drho(nullptr), vfrac(nullptr), esph(nullptr),
    desph(nullptr), heatflow(nullptr), vest(nullptr)
{
  molecular = Atom::ATOMIC;
  mass_type = PER_ATOM;
  forceclearflag = 1;

  atom->rmass_flag = 1;
  atom->esph_flag = 1;
  atom->vest_flag = 1;

  // strings with peratom variables to include in each AtomVec method
  // strings cannot contain fields in corresponding AtomVec default strings
  // order of fields in a string does not matter
  // except: fields_data_atom & fields_data_vel must match data file
  // heatflow holds desph of the previous step for the integrator
  // rho, drho, vfrac are computed anew in every step, for owned and ghost atoms, by the
  // pair style; vest is set from the velocity at the start of every run

  fields_grow = {"rmass", "rho", "drho", "vfrac", "esph", "desph", "heatflow", "vest"};
  fields_copy = {"rmass", "rho", "drho", "vfrac", "esph", "desph", "heatflow", "vest"};
  fields_comm = {"vest"};
  fields_comm_vel = {"vest"};
  fields_reverse = {"desph"};
  fields_border = {"rmass", "esph", "vest"};
  fields_border_vel = {"rmass", "esph", "vest"};
  fields_exchange = {"rmass", "rho", "drho", "vfrac", "esph", "heatflow", "vest"};
  fields_restart = {"rmass", "esph"};
  fields_create = {"rmass", "rho", "drho", "vfrac", "esph", "desph", "heatflow", "vest"};
  fields_data_atom = {"id", "type", "rmass", "esph", "x"};
  fields_data_vel = {"id", "v"};

  if (complete == COMPLETE) setup_fields();
}

/* ----------------------------------------------------------------------
   set local copies of all grow ptrs used by this class, except defaults
   needed in replicate when 2 atom classes exist and it calls pack_restart()
------------------------------------------------------------------------- */

void AtomVecSPHBulk::grow_pointers()
{
  rmass = atom->rmass;
  rho = atom->rho;
  drho = atom->drho;
  vfrac = atom->vfrac;
  esph = atom->esph;
  desph = atom->desph;
  heatflow = atom->heatflow;
  vest = atom->vest;
}

/* ----------------------------------------------------------------------
   clear extra forces starting at atom N
   nbytes = # of bytes to clear for a per-atom vector
------------------------------------------------------------------------- */

void AtomVecSPHBulk::force_clear(int n, size_t nbytes)
{
  memset(&desph[n], 0, nbytes);
}

/* ----------------------------------------------------------------------
   modify what AtomVec::data_atom() just unpacked
   or initialize other atom quantities
------------------------------------------------------------------------- */

void AtomVecSPHBulk::data_atom_post(int ilocal)
{
  if (!(rmass[ilocal] > 0.0))
    error->one(FLERR, "Invalid mass {} in Atoms section of data file: mass must be > 0",
               rmass[ilocal]);
  clear_derived(ilocal);
}

/* ----------------------------------------------------------------------
   initialize what AtomVec::unpack_restart() did not unpack
------------------------------------------------------------------------- */

void AtomVecSPHBulk::unpack_restart_init(int ilocal)
{
  clear_derived(ilocal);
}

/* ----------------------------------------------------------------------
   zero the quantities that only a force computation or an integrator can set
------------------------------------------------------------------------- */

void AtomVecSPHBulk::clear_derived(int ilocal)
{
  rho[ilocal] = drho[ilocal] = vfrac[ilocal] = desph[ilocal] = heatflow[ilocal] = 0.0;
  vest[ilocal][0] = vest[ilocal][1] = vest[ilocal][2] = 0.0;
}

/* ----------------------------------------------------------------------
   assign an index to named atom property and return index
   return -1 if name is unknown to this atom style
------------------------------------------------------------------------- */

int AtomVecSPHBulk::property_atom(const std::string &name)
{
  for (int index = 0; index < NPROPERTY; index++)
    if (name == PROPERTY[index]) return index;
  return -1;
}

/* ----------------------------------------------------------------------
   pack per-atom data into buf for ComputePropertyAtom
   index maps to data specific to this atom style
------------------------------------------------------------------------- */

void AtomVecSPHBulk::pack_property_atom(int index, double *buf, int nvalues, int groupbit)
{
  const int *mask = atom->mask;
  const int nlocal = atom->nlocal;

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
      case VOL:
        buf[n] = vfrac[i];
        break;
      case RHO:
        buf[n] = rho[i];
        break;
      case ESPH:
        buf[n] = esph[i];
        break;
      case DESPH:
        buf[n] = desph[i];
        break;
      default:
        buf[n] = vest[i][index - VESTX];
    }
  }
}
