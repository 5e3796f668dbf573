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

#include "sph_dissipation_exchange.h"

#include "comm.h"
#include "error.h"
#include "force.h"
#include "pair.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

Exchange::Exchange(LAMMPS *lmp, Pair *pair, int forward, int reverse) : Pointers(lmp), pair(pair)
{
  pair->comm_forward = forward;
  pair->comm_reverse = reverse;
}

/* ----------------------------------------------------------------------
   return # of values per atom, for which LAMMPS has made room at the start of the run
------------------------------------------------------------------------- */

int Exchange::set_fields(std::initializer_list<Field> next, int most)
{
  fields = next;
  int nvalues = 0;
  for (const auto &one : fields) nvalues += one.width;
  if (nvalues > most)
    error->all(FLERR,
               "Pair style {} communicates {} values per atom, more than the {} it announced",
               force->pair_style, nvalues, most);
  return nvalues;
}

/* ---------------------------------------------------------------------- */

void Exchange::forward(std::initializer_list<Field> next)
{
  comm->forward_comm(pair, set_fields(next, pair->comm_forward));
}

/* ---------------------------------------------------------------------- */

void Exchange::reverse(std::initializer_list<Field> next)
{
  if (force->newton_pair) comm->reverse_comm(pair, set_fields(next, pair->comm_reverse));
}

/* ---------------------------------------------------------------------- */

int Exchange::pack_forward(int n, const int *list, double *buf) const
{
  double *out = buf;
  for (const auto &one : fields)
    for (int k = 0; k < n; k++) {
      const double *const value = one.first + list[k] * one.stride;
      for (int d = 0; d < one.width; d++) *out++ = value[d];
    }
  return static_cast<int>(out - buf);
}

/* ---------------------------------------------------------------------- */

void Exchange::unpack_forward(int n, int nfirst, const double *buf) const
{
  for (const auto &one : fields)
    for (int i = nfirst; i < nfirst + n; i++) {
      double *const value = one.first + i * one.stride;
      for (int d = 0; d < one.width; d++) value[d] = *buf++;
    }
}

/* ---------------------------------------------------------------------- */

int Exchange::pack_reverse(int n, int nfirst, double *buf) const
{
  double *out = buf;
  for (const auto &one : fields)
    for (int i = nfirst; i < nfirst + n; i++) {
      const double *const value = one.first + i * one.stride;
      for (int d = 0; d < one.width; d++) *out++ = value[d];
    }
  return static_cast<int>(out - buf);
}

/* ---------------------------------------------------------------------- */

void Exchange::unpack_reverse(int n, const int *list, const double *buf) const
{
  for (const auto &one : fields)
    for (int k = 0; k < n; k++) {
      double *const value = one.first + list[k] * one.stride;
      for (int d = 0; d < one.width; d++) value[d] += *buf++;
    }
}
