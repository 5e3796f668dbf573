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

#include "sph_dissipation_traces.h"

#include "atom.h"
#include "domain.h"
#include "lammps.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fields.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// Bits of a hash.  EACH hashes, and a bit that marks them, make a whole number that a double represents exactly

static constexpr int BITS = 17, EACH = 3;
static constexpr std::uint64_t LIMIT = std::uint64_t(1) << BITS;

namespace {

class Hash {
 public:
  void add(std::uint64_t word)
  {
    number = (number ^ word) * 0x9E3779B97F4A7C15;    // twice: the low bits of 1.0 are 0
    number = (number ^ (number >> 32)) * 0xBF58476D1CE4E5B9;
    number ^= number >> 32;
  }
  void add(double value)
  {
    std::uint64_t bits;
    value += 0.0;    // -0 is 0
    memcpy(&bits, &value, sizeof(bits));
    add(bits);
  }
  std::uint64_t short_one() const { return number % LIMIT; }
  std::uint64_t number = 0;
};

class Tracer {
 public:
  Tracer(LAMMPS *lmp, const Fields &fields) :
      lmp(lmp), atom(lmp->atom), fields(fields),
      fine(0.75487766624669276 * 16777216.0 /
           fields.end.length)    // no rational number, as on lattices
  {
  }

  // Set the trace of a particle; positions count with the digits that restart files keep, and modulo periods

  void find(int i, Traced what, double *trace) const
  {
    Hash hash[NTRAIT];
    double place[3];
    find_image(atom->x[i], place);
    for (const double x : place) hash[PLACE].add(std::floor(x * fine + 0.5));
    hash[TYPE].add(std::uint64_t(atom->type[i]));
    hash[MASS].add(atom->rmass[i]);
    if (what == Traced::ALL) {
      for (int d = 0; d < 3; d++) hash[VELOCITY].add(atom->v[i][d]);
      for (int d = 0; fields.has_spins && d < 3; d++) hash[SPIN].add(atom->omega[i][d]);
      hash[DENSITY].add(atom->rho[i]);
      hash[ENERGY].add(atom->esph[i]);
      for (const int slot : fields.slots) hash[STATES].add(fields.state[slot][i]);
    }
    for (int c = 0; c < NTRACE; c++) {
      std::uint64_t number = 1;
      for (int k = EACH * c; k < EACH * (c + 1); k++)
        number = number * LIMIT + (k < NTRAIT ? hash[k].short_one() : 0);
      trace[c] = static_cast<double>(number);
    }
  }

 private:
  LAMMPS *const lmp;
  const Atom *const atom;

  // Find the image in the box as Domain::remap(), but in one step, for positions that are far away or not finite

  void find_image(const double *x, double *image) const
  {
    Domain *const domain = lmp->domain;
    double from[3] = {x[0], x[1], x[2]}, to[3];
    if (domain->triclinic) domain->x2lamda(from, to);
    double *const place = domain->triclinic ? to : from;
    for (int d = 0; d < 3; d++) {
      if (!domain->periodicity[d]) continue;
      const double lo = domain->triclinic ? 0.0 : domain->boxlo[d];
      const double period = domain->triclinic ? 1.0 : domain->prd[d];
      for (int twice = 0; twice < 2; twice++)    // the first sum may be the upper bound
        place[d] -= period * std::floor((place[d] - lo) / period);
    }
    if (domain->triclinic)
      domain->lamda2x(to, image);
    else
      std::copy_n(from, 3, image);
  }

  const Fields &fields;
  const double fine;
};

// Return true if the hashes of a trait differ

bool differ(const double *one, const double *other, int trait)
{
  const int shift = BITS * (EACH - 1 - trait % EACH);
  const auto a = static_cast<std::uint64_t>(one[trait / EACH]);
  const auto b = static_cast<std::uint64_t>(other[trait / EACH]);
  return ((a ^ b) >> shift) % LIMIT != 0;
}

// Return a hash of the box, without boundaries that follow the particles

bigint hash_of_box(const Domain *domain)
{
  constexpr std::uint64_t EXACT = (std::uint64_t(1) << 52) - 1;    // exact in a restart file
  Hash hash;
  for (int d = 0; d < 3; d++) {
    hash.add(std::uint64_t(domain->periodicity[d]));
    if (!domain->periodicity[d]) continue;
    hash.add(domain->boxlo[d]);
    hash.add(domain->boxhi[d]);
  }
  for (const double tilt : {domain->xy, domain->xz, domain->yz}) hash.add(tilt);
  return static_cast<bigint>(hash.number & EXACT);
}

}    // namespace

/* ---------------------------------------------------------------------- */

void SPHDissipation::leave_traces(LAMMPS *lmp, const std::function<Traced(int)> &traced)
{
  Fields &fields = *Fields::of(lmp->atom);
  const Domain *const domain = lmp->domain;
  fields.end.length = std::max({domain->xprd, domain->yprd, domain->zprd});
  fields.end.box = hash_of_box(domain);
  fields.end.step = lmp->update->ntimestep;
  const Tracer tracer(lmp, fields);
  bigint mine = 0;
  for (int i = 0; i < lmp->atom->nlocal; i++) {
    const Traced what = traced(i);
    if (what == Traced::NOTHING)
      std::fill_n(fields.trace[i], NTRACE, 0.0);
    else {
      tracer.find(i, what, fields.trace[i]);
      mine++;
    }
  }
  fields.end.number = over_all(lmp->world, mine, MPI_SUM);
}

/* ---------------------------------------------------------------------- */

Changes SPHDissipation::find_changes(LAMMPS *lmp, const std::function<Traced(int)> &traced)
{
  const Fields &fields = *Fields::of(lmp->atom);
  Changes changes;
  changes.known = (fields.end.number > 0);
  if (!changes.known) return changes;
  enum { STAYED = NTRAIT, CAME, NCOUNT };
  bigint mine[NCOUNT] = {}, all[NCOUNT];
  const Tracer tracer(lmp, fields);
  for (int i = 0; i < lmp->atom->nlocal; i++) {
    const Traced what = traced(i);
    if (what == Traced::NOTHING) continue;
    const double *const before = fields.trace[i];
    if (before[0] == 0.0) {
      mine[CAME]++;
      continue;
    }
    mine[STAYED]++;
    double now[NTRACE];
    tracer.find(i, what, now);
    for (int trait = 0; trait < NTRAIT; trait++) mine[trait] += differ(before, now, trait);
  }
  MPI_Allreduce(mine, all, NCOUNT, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  for (int trait = 0; trait < NTRAIT; trait++) changes.of[trait] = (all[trait] > 0);
  changes.particles = (all[CAME] > 0 || all[STAYED] != fields.end.number);
  changes.box = (fields.end.box != hash_of_box(lmp->domain));
  changes.step = (fields.end.step != lmp->update->ntimestep);
  return changes;
}
