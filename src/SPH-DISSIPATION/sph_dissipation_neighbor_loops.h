/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

// The loops of the neighbor search; sph_dissipation_loops.h includes this file inside its namespace.

SPH_INLINE void take_candidates(const PlaceColumns &from, int begin, int end, const double *corner,
                                double scale, CandidateColumns &to)
{
  for (int d = 0; d < 3; d++) {
    const double *const x = from.x[d] + begin;
    float *const out = to.x[d] + to.n;
    for (int k = 0; k < end - begin; k += LANES)
      store_floats(out + k, (load(x + k) - all(corner[d])) * all(scale));
  }
  copy_indices(to.index + to.n, from.index + begin, end - begin);
  to.n += end - begin;
}

SPH_INLINE void near(const CandidateColumns &from, const float *place, const Reach &reach,
                     Found &found)
{
  const Floats x = all_floats(place[0]), y = all_floats(place[1]), z = all_floats(place[2]);
  const Floats close = all_floats(reach.close), safe = all_floats(reach.safe);
  const Floats bound = all_floats(reach.bound);
  int nclose = 0, nfar = 0, doubt = 0;
  for (int k = 0; k < from.n; k += FLOATS) {
    const Floats dx = x - load_floats(from.x[0] + k);
    const Floats dy = y - load_floats(from.x[1] + k);
    const Floats dz = z - load_floats(from.x[2] + k);
    const Floats rsq = dx * dx + dy * dy + dz * dz;
    int inside = bits_below(rsq, bound);
    if (from.n - k < FLOATS) inside &= (1 << (from.n - k)) - 1;
    const int is_close = inside & bits_below(rsq, close), is_far = inside & ~is_close;
    doubt |= is_far & ~bits_below(rsq, safe);
    pack_indices(found.close + nclose, from.index + k, is_close);
    pack_indices(found.far + nfar, from.index + k, is_far);
    nclose += count_bits(is_close);
    nfar += count_bits(is_far);
  }
  found.nclose = nclose;
  found.nfar = nfar;
  found.doubt = doubt;
}
