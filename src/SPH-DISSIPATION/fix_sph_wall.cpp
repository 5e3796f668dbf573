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

#include "fix_sph_wall.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "input.h"
#include "math_extra.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_engine.h"
#include "update.h"
#include "variable.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

FixSPHWall::FixSPHWall(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), point{0.0, 0.0, 0.0}, axis{0.0, 0.0, 1.0}, gravity{0.0, 0.0, 0.0},
    rotates(false), move(true), slip(false), spin(ZERO), rate(0.0), pair(nullptr),
    thickness_checked(false), nmax(0), total(), total_all(), total_summed(false)
{
  for (int iarg = 3; iarg < narg;) {
    const std::string keyword = arg[iarg];
    auto needs = [&](int n) {
      if (iarg + n >= narg)
        utils::missing_cmd_args(FLERR, fmt::format("fix {} {}", style, keyword), error);
    };
    auto unknown = [&](const char *word) {
      error->all(FLERR, "Unknown fix {} {} value: {}", style, keyword, word);
    };

    if (keyword == "velocity") {
      needs(3);
      for (int d = 0; d < 3; d++) value_argument(velocity[d], arg[iarg + 1 + d]);
      iarg += 4;
    } else if (keyword == "rotate") {
      needs(7);
      for (int d = 0; d < 3; d++) {
        point[d] = utils::numeric(FLERR, arg[iarg + 1 + d], false, lmp);
        axis[d] = utils::numeric(FLERR, arg[iarg + 4 + d], false, lmp);
      }
      if (!(MathExtra::len3(axis) > 0.0))
        error->all(FLERR, "Fix {} rotate: the direction of the axis must not be zero", style);
      MathExtra::norm3(axis);
      value_argument(spin_rate, arg[iarg + 7]);
      rotates = true;
      iarg += 8;
    } else if (keyword == "move") {
      needs(1);
      move = utils::logical(FLERR, arg[iarg + 1], false, lmp);
      iarg += 2;
    } else if (keyword == "slip") {
      needs(1);
      if (strcmp(arg[iarg + 1], "no") == 0)
        slip = false;
      else if (strcmp(arg[iarg + 1], "free") == 0)
        slip = true;
      else
        unknown(arg[iarg + 1]);
      iarg += 2;
    } else if (keyword == "spin") {
      needs(1);
      if (strcmp(arg[iarg + 1], "zero") == 0) {
        spin = ZERO;
      } else if (strcmp(arg[iarg + 1], "free") == 0) {
        spin = FREE;
      } else if (strcmp(arg[iarg + 1], "rate") == 0) {
        needs(2);
        spin = RATE;
        rate = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
        iarg++;
      } else
        unknown(arg[iarg + 1]);
      iarg += 2;
    } else if (keyword == "gravity") {
      needs(3);
      for (int d = 0; d < 3; d++) gravity[d] = utils::numeric(FLERR, arg[iarg + 1 + d], false, lmp);
      iarg += 4;
    } else
      error->all(FLERR, "Unknown fix {} keyword: {}", style, keyword);
  }

  if (domain->dimension == 2) {
    if (velocity[2].name || velocity[2].now != 0.0 || gravity[2] != 0.0)
      error->all(FLERR, "Fix {}: velocity and gravity must lie in the plane in 2d", style);
    if (axis[0] != 0.0 || axis[1] != 0.0)
      error->all(FLERR, "Fix {}: the axis of rotation must be along z in 2d", style);
  }

  if (group->dynamic[igroup])
    error->all(FLERR, "Fix {} cannot use dynamic group {}", style, group->names[igroup]);

  time_integrate = 1;
  restart_global = 1;
  vector_flag = peratom_flag = 1;
  size_vector = size_peratom_cols = 6;
  global_freq = peratom_freq = 1;
  extvector = 1;
}

/* ---------------------------------------------------------------------- */

FixSPHWall::~FixSPHWall()
{
  if (auto *fluid = PairSPHBulk::find(force)) fluid->remove_boundary(this);
  for (auto value : {&velocity[0], &velocity[1], &velocity[2], &spin_rate}) delete[] value->name;
  memory->destroy(array_atom);
}

/* ---------------------------------------------------------------------- */

int FixSPHWall::setmask()
{
  return PRE_EXCHANGE | INITIAL_INTEGRATE | POST_FORCE;
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::init()
{
  pair = PairSPHBulk::find(force);
  if (!pair) error->all(FLERR, "Fix {} requires pair style sph/bulk or sph/micropolar", style);
  if (domain->deform_vremap)
    error->all(FLERR, "Fix {} cannot be used when fix deform remaps velocities", style);

  for (auto value : {&velocity[0], &velocity[1], &velocity[2], &spin_rate}) {
    if (!value->name) continue;
    value->variable = input->variable->find(value->name);
    if (value->variable < 0)
      error->all(FLERR, "Variable {} for fix {} does not exist", value->name, style);
    if (!input->variable->equalstyle(value->variable))
      error->all(FLERR, "Variable {} for fix {} is not an equal-style variable", value->name,
                 style);
  }

  check_group();
  pair->add_boundary(this);

  // no pairs of wall particles in the neighbor lists

  auto exclude = [&](int other) {
    for (int n = 0; n < neighbor->nex_group; n++)
      if ((neighbor->ex1_group[n] == igroup && neighbor->ex2_group[n] == other) ||
          (neighbor->ex1_group[n] == other && neighbor->ex2_group[n] == igroup))
        return;
    neighbor->modify_params(
        fmt::format("exclude group {} {}", group->names[igroup], group->names[other]));
  };
  for (const auto &ifix : modify->get_fix_by_style("^sph/wall$")) exclude(ifix->igroup);
}

/* ----------------------------------------------------------------------
   particles of the wall belong to this fix alone
------------------------------------------------------------------------- */

void FixSPHWall::check_group()
{
  if (group->count(igroup) == 0)
    error->all(FLERR, "Fix {} group {} has no particles", style, group->names[igroup]);

  for (const auto &ifix : modify->get_fix_list()) {
    if (!ifix->time_integrate || ifix == this) continue;
    tagint shared = 0, shared_all;
    for (int i = 0; i < atom->nlocal; i++)
      if ((atom->mask[i] & groupbit) && (atom->mask[i] & ifix->groupbit)) shared = atom->tag[i];
    MPI_Allreduce(&shared, &shared_all, 1, MPI_LMP_TAGINT, MPI_MAX, world);
    if (shared_all)
      error->all(FLERR, "Particle {} of the wall of fix {} {} is also moved by fix {} {}",
                 shared_all, id, style, ifix->id, ifix->style);
  }
}

/* ----------------------------------------------------------------------
   before the exchange of atoms, so that ghost atoms get the velocity with their borders
------------------------------------------------------------------------- */

void FixSPHWall::setup_pre_exchange()
{
  evaluate_all();
  for (auto value : {&velocity[0], &velocity[1], &velocity[2], &spin_rate})
    value->before = value->now;
  set_velocity();
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::setup(int vflag)
{
  if (!thickness_checked) check_thickness();
  thickness_checked = true;
  post_force(vflag);
}

/* ----------------------------------------------------------------------
   rigid motion by the mean velocity of the step; fix sph/bulk then copies the velocity
   to the extrapolated one
------------------------------------------------------------------------- */

void FixSPHWall::initial_integrate(int /*vflag*/)
{
  evaluate_all();

  if (move) {
    const double dt = update->dt;
    const double angle = 0.5 * dt * (spin_rate.before + spin_rate.now);
    double quaternion[4], rotation[3][3], shift[3];
    MathExtra::axisangle_to_quat(axis, angle, quaternion);
    MathExtra::quat_to_mat(quaternion, rotation);
    for (int d = 0; d < 3; d++) shift[d] = 0.5 * dt * (velocity[d].before + velocity[d].now);

    double **x = atom->x;
    for (int i = 0; i < atom->nlocal; i++) {
      if (!(atom->mask[i] & groupbit)) continue;
      double r[3], rotated[3];
      from_point(i, r);
      MathExtra::matvec(rotation, r, rotated);
      for (int d = 0; d < 3; d++) x[i][d] += shift[d] + (rotated[d] - r[d]);
    }
    if (rotates)
      for (int d = 0; d < 3; d++) point[d] += shift[d];
  }
  set_velocity();
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::set_velocity()
{
  double w[3], r[3];
  angular_velocity(w);
  double **v = atom->v;
  double **vest = atom->vest;
  double **omega = atom->omega;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    from_point(i, r);
    MathExtra::cross3(w, r, v[i]);
    for (int d = 0; d < 3; d++) {
      v[i][d] += velocity[d].now;
      vest[i][d] = v[i][d];
      if (omega) omega[i][d] = w[d];
    }
  }
}

/* ----------------------------------------------------------------------
   what the particles of the wall bring into the pair forces
------------------------------------------------------------------------- */

void FixSPHWall::set_boundary(Engine &engine, const BoundarySum *sums)
{
  const double dtinv = 1.0 / update->dt;
  double w[3], wdot[3], a0[3];
  angular_velocity(w);
  for (int d = 0; d < 3; d++) {
    wdot[d] = (spin_rate.now - spin_rate.before) * dtinv * axis[d];
    a0[d] = (velocity[d].now - velocity[d].before) * dtinv;
  }

  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const BoundarySum &sum = sums[i];
    Particle &particle = engine.particle[i];
    if (engine.spin) std::copy(w, w + 3, engine.spin[i].w);
    if (!(sum.weight > 0.0)) continue;
    const double norm = 1.0 / sum.weight;

    double r[3], to_fluid[3], turn[3], centripetal[3], euler[3], wall_there[3];
    from_point(i, r);
    MathExtra::cross3(w, r, turn);
    MathExtra::cross3(w, turn, centripetal);
    MathExtra::cross3(wdot, r, euler);

    // velocity of the wall, as a rigid body, where the velocity of the fluid is known

    for (int d = 0; d < 3; d++) to_fluid[d] = -sum.r[d] * norm;
    MathExtra::cross3(w, to_fluid, wall_there);

    atom->rho[i] = sum.rho * norm;
    atom->vfrac[i] = particle.vol = atom->rmass[i] / atom->rho[i];
    double pressure = sum.pressure * norm;
    for (int d = 0; d < 3; d++)
      pressure -= atom->rho[i] * (gravity[d] - a0[d] - centripetal[d] - euler[d]) * to_fluid[d];
    particle.g = pressure * particle.vol * particle.vol;
    engine.zeta_term[i] = sum.zeta_term * norm;
    for (int d = 0; d < 3; d++) {
      const double relative = sum.u[d] * norm - (particle.u[d] + wall_there[d]);
      particle.u[d] += slip ? relative : -relative;
    }
    if (engine.spin && spin != RATE)
      for (int d = 0; d < 3; d++) {
        const double fluid = sum.w[d] * norm;
        engine.spin[i].w[d] = (spin == FREE) ? fluid : 2.0 * w[d] - fluid;
      }
  }
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::set_boundary_spin(Engine &engine, const BoundarySum *sums, double **vorticity)
{
  double w[3];
  angular_velocity(w);
  for (int i = 0; i < atom->nlocal; i++) {
    const BoundarySum &sum = sums[i];
    if (!(atom->mask[i] & groupbit) || !(sum.weight > 0.0)) continue;
    for (int d = 0; d < 3; d++) {
      const double surface = w[d] + rate * (0.5 * vorticity[i][d] / sum.weight - w[d]);
      engine.spin[i].w[d] = 2.0 * surface - sum.w[d] / sum.weight;
    }
  }
}

/* ---------------------------------------------------------------------- */

bool FixSPHWall::boundary_vorticity() const
{
  return spin == RATE;
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::post_force(int /*vflag*/)
{
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(array_atom);
    memory->create(array_atom, nmax, 6, "sph/wall:array_atom");
  }

  double **f = atom->f;
  double **torque = atom->torque;
  std::fill(total, total + 6, 0.0);
  total_summed = false;
  for (int i = 0; i < atom->nlocal; i++) {
    double *const one = array_atom[i];
    std::fill(one, one + 6, 0.0);
    if (!(atom->mask[i] & groupbit)) continue;
    double r[3], moment[3];
    from_point(i, r);
    MathExtra::cross3(r, f[i], moment);
    for (int d = 0; d < 3; d++) {
      one[d] = f[i][d];
      if (torque) one[3 + d] = torque[i][d];
      total[d] += one[d];
      total[3 + d] += moment[d] + one[3 + d];
    }
  }
}

/* ----------------------------------------------------------------------
   force and torque of the fluid on the wall
------------------------------------------------------------------------- */

double FixSPHWall::compute_vector(int n)
{
  if (!total_summed) MPI_Allreduce(total, total_all, 6, MPI_DOUBLE, MPI_SUM, world);
  total_summed = true;
  return total_all[n];
}

/* ----------------------------------------------------------------------
   number, or variable v_name
------------------------------------------------------------------------- */

void FixSPHWall::value_argument(Value &value, const char *word)
{
  delete[] value.name;
  value.name = nullptr;
  if (utils::strmatch(word, "^v_"))
    value.name = utils::strdup(word + 2);
  else
    value.now = value.before = utils::numeric(FLERR, word, false, lmp);
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::evaluate(Value &value)
{
  value.before = value.now;
  if (value.name) value.now = input->variable->compute_equal(value.variable);
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::evaluate_all()
{
  bool any = spin_rate.name;
  for (const auto &value : velocity) any = any || value.name;
  if (!any) return;
  modify->clearstep_compute();
  for (auto &value : velocity) evaluate(value);
  evaluate(spin_rate);
  modify->addstep_compute(update->ntimestep + 1);
}

/* ----------------------------------------------------------------------
   vector from the point on the axis to a particle
------------------------------------------------------------------------- */

void FixSPHWall::from_point(int i, double *r) const
{
  domain->unmap(atom->x[i], atom->image[i], r);
  MathExtra::sub3(r, point, r);
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::angular_velocity(double *w) const
{
  for (int d = 0; d < 3; d++) w[d] = spin_rate.now * axis[d];
}

/* ----------------------------------------------------------------------
   warn if the wall does not fill the support of the fluid at its surface.  The first
   layer is what has fluid at the distance of the particle spacing; how deep the wall
   goes below it, as seen within the support radius, must be that minus one spacing.
   The neighbor lists have no pairs of wall particles, hence the bins.
------------------------------------------------------------------------- */

void FixSPHWall::check_thickness()
{
  double **x = atom->x;
  const int nall = atom->nlocal + atom->nghost;
  const double support = pair->support_radius();
  const int dim = pair->dimension();

  double lo[3];
  bigint nbin[3];
  for (int d = 0; d < 3; d++) {
    double hi = lo[d] = nall ? x[0][d] : 0.0;
    for (int i = 0; i < nall; i++) {
      lo[d] = std::min(lo[d], x[i][d]);
      hi = std::max(hi, x[i][d]);
    }
    nbin[d] = static_cast<bigint>((hi - lo[d]) / support) + 1;
  }
  auto bin_of = [&](int i, int d) {
    return static_cast<bigint>((x[i][d] - lo[d]) / support);
  };
  std::vector<int> head(nbin[0] * nbin[1] * nbin[2], -1), next(nall);
  for (int i = 0; i < nall; i++) {
    int &first = head[(bin_of(i, 2) * nbin[1] + bin_of(i, 1)) * nbin[0] + bin_of(i, 0)];
    next[i] = first;
    first = i;
  }

  // for each particle j within the support radius of particle i

  auto for_neighbors = [&](int i, auto &&function) {
    bigint from[3], to[3];
    for (int d = 0; d < 3; d++) {
      from[d] = std::max(bin_of(i, d) - 1, bigint(0));
      to[d] = std::min(bin_of(i, d) + 1, nbin[d] - 1);
    }
    for (bigint c = from[2]; c <= to[2]; c++)
      for (bigint b = from[1]; b <= to[1]; b++)
        for (bigint a = from[0]; a <= to[0]; a++)
          for (int j = head[(c * nbin[1] + b) * nbin[0] + a]; j >= 0; j = next[j]) {
            double r[3];
            MathExtra::sub3(x[j], x[i], r);
            const double rsq = MathExtra::lensq3(r);
            if (j != i && rsq < support * support) function(j, r, sqrt(rsq));
          }
  };

  double worst[2] = {0.0, 0.0}, worst_all[2];    // spacing - depth, spacing over depth of bad ones
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double spacing = pow(atom->rmass[i] / pair->reference_density(atom->type[i]), 1.0 / dim);

    double nearest = support, normal[3] = {0.0, 0.0, 0.0};
    for_neighbors(i, [&](int j, const double *r, double distance) {
      if (pair->is_boundary(j)) return;
      nearest = std::min(nearest, distance);
      const double weight = (support - distance) * (support - distance) / distance;
      for (int d = 0; d < 3; d++) normal[d] += weight * r[d];
    });
    if (nearest > 1.25 * spacing || !(MathExtra::len3(normal) > 0.0)) continue;
    MathExtra::norm3(normal);

    double depth = 0.0;
    for_neighbors(i, [&](int j, const double *r, double) {
      if (pair->is_boundary(j)) depth = std::max(depth, -MathExtra::dot3(normal, r));
    });
    const double missing = support - (depth + spacing);
    if (missing > 0.5 * spacing) {
      worst[0] = std::max(worst[0], missing);
      worst[1] = std::max(worst[1], ceil(support / spacing - 1.0e-6));
    }
  }
  MPI_Allreduce(worst, worst_all, 2, MPI_DOUBLE, MPI_MAX, world);
  if (worst_all[0] > 0.0 && comm->me == 0)
    error->warning(FLERR,
                   "The wall of fix {} {} is thinner than the support radius {:g}, by {:.3g}: it "
                   "needs {:g} layers of particles",
                   id, style, support, worst_all[0], worst_all[1]);
}

/* ----------------------------------------------------------------------
   the point on the axis has moved with the wall
------------------------------------------------------------------------- */

void FixSPHWall::write_restart(FILE *fp)
{
  if (comm->me == 0) {
    const int size = 3 * sizeof(double);
    fwrite(&size, sizeof(int), 1, fp);
    fwrite(point, sizeof(double), 3, fp);
  }
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::restart(char *buf)
{
  const auto *stored = reinterpret_cast<double *>(buf);
  std::copy(stored, stored + 3, point);
}

/* ---------------------------------------------------------------------- */

double FixSPHWall::memory_usage()
{
  return 6.0 * nmax * sizeof(double);
}
