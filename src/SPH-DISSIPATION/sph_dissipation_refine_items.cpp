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

#include "sph_dissipation_refine_items.h"

#include "atom.h"
#include "comm.h"

#include <algorithm>
#include <cstddef>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static constexpr int place(std::size_t bytes)
{
  return static_cast<int>(bytes / sizeof(double));
}

/* ---------------------------------------------------------------------- */

void RefineItems::resize()
{
  items.assign(atom->nlocal + atom->nghost, RefineItem());
}

/* ---------------------------------------------------------------------- */

void RefineItems::forward(int first_in, int count_in)
{
  first = first_in;
  count = count_in;
  comm->forward_comm(fix, count);
}

/* ---------------------------------------------------------------------- */

void RefineItems::forward_all()
{
  forward(0, SIZE);
  const int nall = atom->nlocal + atom->nghost;
  for (int i = atom->nlocal; i < nall; i++) std::copy_n(atom->x[i], 3, items[i].lump.x);
}

void RefineItems::forward_choice()
{
  forward(place(offsetof(RefineItem, choice)), 1);
}

void RefineItems::forward_settled()
{
  forward(place(offsetof(RefineItem, settled)), 1);
}

void RefineItems::forward_withheld()
{
  forward(place(offsetof(RefineItem, withheld)), 1);
}

void RefineItems::forward_point()
{
  forward(place(offsetof(RefineItem, mass)), 7);
}

void RefineItems::forward_rotation()
{
  const int from = place(offsetof(RefineItem, gives));
  forward(from, SIZE - from);
}

/* ---------------------------------------------------------------------- */

int RefineItems::pack(int n, const int *list, double *buf) const
{
  for (int k = 0; k < n; k++) {
    const double *const row = reinterpret_cast<const double *>(&items[list[k]]) + first;
    buf = std::copy_n(row, count, buf);
  }
  return n * count;
}

/* ---------------------------------------------------------------------- */

void RefineItems::unpack(int n, int from, const double *buf)
{
  for (int i = from; i < from + n; i++, buf += count)
    std::copy_n(buf, count, reinterpret_cast<double *>(&items[i]) + first);
}
