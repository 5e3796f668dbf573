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
#include "force.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ----------------------------------------------------------------------
   call send(# of values per atom) for each message, with the fields that are in it
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

void Exchange::forward(const std::vector<Field> &next)
{
  in_parts(next, [this](int nvalues) {
    comm->forward_comm(pair, nvalues);
  });
}

/* ---------------------------------------------------------------------- */

void Exchange::reverse(const std::vector<Field> &next)
{
  if (!force->newton_pair) return;
  in_parts(next, [this](int nvalues) {
    comm->reverse_comm(pair, nvalues);
  });
}

/* ----------------------------------------------------------------------
   class CommBrick sends downwards and upwards in turn, along x, y, z
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
   copy(field, k, its values in the message) for each field and k < n; returns the length of the message
------------------------------------------------------------------------- */

template <class Copy> int Exchange::for_each(int n, const Copy &copy) const
{
  int begin = 0;
  for (const auto &one : fields) {
    threads->for_each(n, [&](int k) {
      copy(one, k, begin + k * one.width);
    });
    begin += n * one.width;
  }
  return begin;
}

/* ---------------------------------------------------------------------- */

int Exchange::pack_forward(int n, const int *list, double *buf) const
{
  return for_each(n, [=](const Field &one, int k, int at) {
    const double *const value = one.first + list[k] * one.stride;
    for (int d = 0; d < one.width; d++) buf[at + d] = value[d];
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
  for_each(n, [=](const Field &one, int k, int at) {
    double *const value = one.first + (nfirst + k) * one.stride;
    for (int d = 0; d < one.width; d++) value[d] = buf[at + d];
  });
}

/* ---------------------------------------------------------------------- */

int Exchange::pack_reverse(int n, int nfirst, double *buf) const
{
  return for_each(n, [=](const Field &one, int k, int at) {
    const double *const value = one.first + (nfirst + k) * one.stride;
    for (int d = 0; d < one.width; d++) buf[at + d] = value[d];
  });
}

/* ----------------------------------------------------------------------
   a particle stands in list once
------------------------------------------------------------------------- */

void Exchange::unpack_reverse(int n, const int *list, const double *buf) const
{
  for_each(n, [=](const Field &one, int k, int at) {
    double *const value = one.first + list[k] * one.stride;
    for (int d = 0; d < one.width; d++) value[d] += buf[at + d];
  });
}
