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

#include "atom.h"
#include "comm.h"
#include "force.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ----------------------------------------------------------------------
   Call send(# of values per atom) for each message, with its fields in this->fields.
------------------------------------------------------------------------- */

template <class Send> void Exchange::in_parts(const std::vector<Field> &next, const Send &send)
{
  int room = ROOM;
  fields.clear();
  for (Field rest : next)
    while (rest.width > 0) {
      const int width = std::min(rest.width, room);
      fields.push_back({rest.first, rest.stride, width});
      rest.first += width;
      rest.width -= width;
      room -= width;
      if (room > 0) continue;
      send(ROOM);
      room = ROOM;
      fields.clear();
    }
  if (room < ROOM) send(ROOM - room);
}

/* ---------------------------------------------------------------------- */

void Exchange::forward(const std::vector<Field> &next, int bits)
{
  chosen = bits;
  in_parts(next, [this](int nvalues) {
    comm->forward_comm(pair, nvalues);
  });
}

/* ---------------------------------------------------------------------- */

void Exchange::reverse(const std::vector<Field> &next, int bits)
{
  if (!force->newton_pair) return;
  chosen = bits;
  in_parts(next, [this](int nvalues) {
    comm->reverse_comm(pair, nvalues);
  });
}

/* ----------------------------------------------------------------------
   Class CommBrick sends downwards and upwards in turn, along x, y, z: every second message comes from above.
------------------------------------------------------------------------- */

const std::vector<int> &Exchange::ghosts_from_above()
{
  fields.clear();
  from_above.clear();
  nreceived = 0;
  comm->forward_comm(pair, 1);
  nreceived = -1;
  return from_above;
}

/* ----------------------------------------------------------------------
   Call copy(values, place in the message, width) for each field and each chosen atom index(k), k < n; return the length of
   the message.  Groups are the same for an atom and its ghosts.
------------------------------------------------------------------------- */

template <class Index, class Copy>
int Exchange::for_each(int n, const Index &index, const Copy &copy) const
{
  int begin = 0;
  for (const auto &one : fields) {
    if (!chosen) {
      threads->for_each(n, [&](int k) {
        copy(one.first + index(k) * one.stride, begin + k * one.width, one.width);
      });
      begin += n * one.width;
    } else
      for (int k = 0; k < n; k++) {
        const int i = index(k);
        if (!(atom->mask[i] & chosen)) continue;
        copy(one.first + i * one.stride, begin, one.width);
        begin += one.width;
      }
  }
  return begin;
}

/* ---------------------------------------------------------------------- */

int Exchange::pack_forward(int n, const int *list, double *buf) const
{
  return for_each(
      n,
      [=](int k) {
        return list[k];
      },
      [=](const double *value, int at, int width) {
        for (int d = 0; d < width; d++) buf[at + d] = value[d];
      });
}

/* ---------------------------------------------------------------------- */

void Exchange::unpack_forward(int n, int nfirst, const double *buf)
{
  if (nreceived >= 0) {
    if (nreceived++ % 2 == 0)
      for (int k = 0; k < n; k++) from_above.push_back(nfirst + k);
    return;
  }
  for_each(
      n,
      [=](int k) {
        return nfirst + k;
      },
      [=](double *value, int at, int width) {
        for (int d = 0; d < width; d++) value[d] = buf[at + d];
      });
}

/* ---------------------------------------------------------------------- */

int Exchange::pack_reverse(int n, int nfirst, double *buf) const
{
  return for_each(
      n,
      [=](int k) {
        return nfirst + k;
      },
      [=](const double *value, int at, int width) {
        for (int d = 0; d < width; d++) buf[at + d] = value[d];
      });
}

/* ----------------------------------------------------------------------
   Threads may add at the same time: a particle stands in list once.
------------------------------------------------------------------------- */

void Exchange::unpack_reverse(int n, const int *list, const double *buf) const
{
  for_each(
      n,
      [=](int k) {
        return list[k];
      },
      [=](double *value, int at, int width) {
        for (int d = 0; d < width; d++) value[d] += buf[at + d];
      });
}
