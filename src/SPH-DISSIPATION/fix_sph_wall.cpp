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
#include "math_extra.h"
#include "memory.h"
#include "modify.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exclusions.h"
#include "sph_dissipation_extension.h"
#include "sph_dissipation_wall_checks.h"
#include "sph_dissipation_wall_motion.h"
#include "update.h"

#include <algorithm>
#include <cstring>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

FixSPHWall::FixSPHWall(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), motion(new WallMotion(lmp, fmt::format("Fix {}", style))),
    exclusions(new Exclusions(lmp)), gravity{0.0, 0.0, 0.0}, move(true), slip(false), spin(ZERO),
    rate(0.0), noise(false), checked(false), total(), total_all(), total_summed(false)
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
      motion->set_velocity(arg + iarg + 1);
      iarg += 4;
    } else if (keyword == "rotate") {
      needs(7);
      motion->set_rotation(arg + iarg + 1);
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

  if (domain->dimension == 2 && gravity[2] != 0.0)
    error->all(FLERR, "Fix {}: velocity and gravity must lie in the plane in 2d", style);
  if (group->dynamic[igroup])
    error->all(FLERR, "Fix {} cannot use dynamic group {}", style, group->names[igroup]);

  time_integrate = 1;
  restart_global = motion->rotates();
  create_attribute = 1;
  vector_flag = peratom_flag = 1;
  size_vector = size_peratom_cols = 6;
  global_freq = peratom_freq = 1;
  extvector = 1;
  maxexchange = 6;

  FixSPHWall::grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++) FixSPHWall::set_arrays(i);
  atom->add_callback(Atom::GROW);
}

/* ---------------------------------------------------------------------- */

FixSPHWall::~FixSPHWall()
{
  if (auto *fluid = PairSPHBulk::find(force)) fluid->remove_boundary(this);
  atom->delete_callback(id, Atom::GROW);
  memory->destroy(array_atom);
  delete exclusions;
  delete motion;
}

/* ---------------------------------------------------------------------- */

int FixSPHWall::setmask()
{
  return PRE_EXCHANGE | INITIAL_INTEGRATE | POST_FORCE | MIN_PRE_EXCHANGE | MIN_POST_FORCE;
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::init()
{
  PairSPHBulk *pair = PairSPHBulk::find(force);
  if (!pair) error->all(FLERR, "Fix {} requires pair style sph/bulk or sph/micropolar", style);
  if (domain->deform_vremap)
    error->all(FLERR, "Fix {} cannot be used when fix deform remaps velocities", style);

  noise = pair->has_noise();
  if (noise && (slip || spin != ZERO))
    error->all(FLERR,
               "Fix {}: only slip no and spin zero can be used with temp of the pair style: what "
               "other walls do to the fluid is no friction that a noise can be in balance with",
               style);

  motion->init();
  pair->add_boundary(this);

  // no pairs of wall particles in the neighbor lists

  std::vector<Exclusions::Groups> walls;
  for (const auto &ifix : modify->get_fix_by_style("^sph/wall$"))
    walls.push_back({igroup, ifix->igroup});
  exclusions->set(walls);

  check_wall_particles(lmp, this);
  check_wall_interacts(lmp, this, pair, !checked);
}

/* ----------------------------------------------------------------------
   before the exchange of atoms, so that ghost atoms get the velocity with their borders;
   in a minimization nothing moves
------------------------------------------------------------------------- */

void FixSPHWall::setup_pre_exchange()
{
  if (update->whichflag == 2)
    motion->rest();
  else
    motion->start();
  set_velocity();
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::setup(int vflag)
{
  if (!checked) check_wall_thickness(lmp, this, PairSPHBulk::find(force));
  checked = true;
  post_force(vflag);
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::min_setup(int vflag)
{
  min_post_force(vflag);
}

/* ----------------------------------------------------------------------
   rigid motion by the mean velocity of the step; fix sph/bulk then copies the velocity
   to the extrapolated one
------------------------------------------------------------------------- */

void FixSPHWall::initial_integrate(int /*vflag*/)
{
  motion->advance();

  if (move) {
    double rotation[3][3], shift[3];
    motion->last_step(rotation, shift);
    double **x = atom->x;
    for (int i = 0; i < atom->nlocal; i++) {
      if (!(atom->mask[i] & groupbit)) continue;
      double r[3], rotated[3];
      from_point(i, r);
      MathExtra::matvec(rotation, r, rotated);
      for (int d = 0; d < 3; d++) x[i][d] += shift[d] + (rotated[d] - r[d]);
    }
    motion->move_point();
  }
  set_velocity();
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::set_velocity()
{
  double w[3], r[3];
  motion->angular_velocity(w);
  double **v = atom->v;
  double **vest = atom->vest;
  double **omega = atom->omega;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    from_point(i, r);
    motion->velocity_at(r, v[i]);
    for (int d = 0; d < 3; d++) {
      vest[i][d] = v[i][d];
      if (omega) omega[i][d] = w[d];
    }
  }
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::move_surface(Surface *surface, bool before)
{
  double w[3], rotation[3][3], shift[3], turned[3];
  motion->angular_velocity(w);
  const bool turns = before && motion->rotates() && move && update->whichflag == 1;
  if (turns) motion->last_step(rotation, shift);
  for (int i = 0; i < atom->nlocal + atom->nghost; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    std::copy(w, w + 3, surface[i].omega);
    if (!turns) continue;
    MathExtra::matvec(rotation, surface[i].normal, turned);
    std::copy(turned, turned + 3, surface[i].normal);
  }
}

/* ----------------------------------------------------------------------
   what the particles of the wall bring into the pair forces.  An extrapolated pressure has no
   energy: in a minimization, they have none, and the forces are the gradient of that of the fluid.
------------------------------------------------------------------------- */

void FixSPHWall::set_boundary(Engine &engine, const Surface *surfaces, const BoundarySum *sums)
{
  if (update->whichflag == 2) return;

  double w[3];
  motion->angular_velocity(w);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const BoundarySum &sum = sums[i];
    Particle &particle = engine.particle[i];
    if (engine.spin) std::copy(w, w + 3, engine.spin[i].w);
    if (!(sum.weight > 0.0)) continue;
    const double norm = 1.0 / sum.weight;

    double r[3], acceleration[3];
    from_point(i, r);
    motion->acceleration_at(r, acceleration);

    // with thermal noise: motion, volume, and friction of the wall itself, for which the friction
    // matrix is symmetric, and the pressure without that of the friction

    double pressure = sum.pressure * norm;
    if (noise)
      pressure -= sum.zeta_term * norm;
    else {
      atom->rho[i] = sum.rho * norm;
      atom->vfrac[i] = particle.vol = atom->rmass[i] / atom->rho[i];
    }
    for (int d = 0; d < 3; d++)
      pressure += sum.rho * norm * (gravity[d] - acceleration[d]) * sum.r[d] * norm;
    const double c_inv = particle.vol / engine.weight(i);
    particle.g = pressure * c_inv * c_inv;
    engine.zeta_term[i] = noise ? 0.0 : sum.zeta_term * norm;
    if (!noise) extend_motion(surfaces[i], sum, particle, engine.spin ? engine.spin + i : nullptr);
  }
}

/* ----------------------------------------------------------------------
   velocity and spin of the fluid go on behind the surface as its condition says
------------------------------------------------------------------------- */

void FixSPHWall::extend_motion(const Surface &surface, const BoundarySum &sum, Particle &particle,
                               SPHDissipation::Spin *omega) const
{
  const double norm = 1.0 / sum.weight;
  const double stretch = std::max(CLOSEST_MEAN * surface.spacing / (norm * sum.d), 1.0);
  const double norm_d = norm * stretch;
  const DistanceMeans distance = {norm_d * sum.d, norm_d * stretch * sum.d2,
                                  norm_d * stretch * stretch * sum.d3};
  const double *const normal = surface.normal;
  const double depth = surface.depth;

  // across the surface the velocity is zero, with a slope that is zero where the fluid sticks: the
  // image of the mean is enough, and does not ask for a smaller time step

  const double mirrored = std::min(depth / distance.d, 1.0);
  const double across = MathExtra::dot3(sum.u, normal) * norm;
  const double across_d = MathExtra::dot3(sum.ud, normal) * norm_d;
  double slope[3];
  for (int d = 0; d < 3; d++) {
    const double u = sum.u[d] * norm - across * normal[d];
    const double ud = sum.ud[d] * norm_d - across_d * normal[d];
    const Extension along = slip ? distance.free(u, ud) : distance.stuck(u, ud);
    slope[d] = slip ? distance.straight_slope(u, ud) : along.slope;
    particle.u[d] += along.behind(depth) - mirrored * across * normal[d];
  }
  if (!omega) return;

  // the vorticity relative to the wall is normal x slope

  double surface_spin[3] = {0.0, 0.0, 0.0};
  if (spin == RATE) MathExtra::cross3(normal, slope, surface_spin);
  for (int d = 0; d < 3; d++) {
    const double at_surface = 0.5 * rate * surface_spin[d];
    const double s = sum.w[d] * norm - at_surface;
    const double sd = sum.wd[d] * norm_d - at_surface * distance.d;
    const Extension beyond = (spin == FREE) ? distance.free(s, sd) : distance.stuck(s, sd);
    omega->w[d] += at_surface + beyond.behind(depth);
  }
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::post_force(int /*vflag*/)
{
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
   the minimizer moves particles along their forces: not those of the wall
------------------------------------------------------------------------- */

void FixSPHWall::min_post_force(int vflag)
{
  post_force(vflag);
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) std::fill_n(atom->f[i], 3, 0.0);
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
   vector from the point on the axis to a particle
------------------------------------------------------------------------- */

void FixSPHWall::from_point(int i, double *r) const
{
  domain->unmap(atom->x[i], atom->image[i], r);
  MathExtra::sub3(r, motion->axis_point(), r);
}

/* ----------------------------------------------------------------------
   the point on the axis has moved with the wall
------------------------------------------------------------------------- */

void FixSPHWall::write_restart(FILE *fp)
{
  if (comm->me != 0) return;
  double buf[WallMotion::NRESTART];
  motion->pack_restart(buf);
  const int size = sizeof(buf);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(buf, sizeof(double), WallMotion::NRESTART, fp);
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::restart(char *buf)
{
  motion->restart(reinterpret_cast<double *>(buf));
}

/* ----------------------------------------------------------------------
   force and couple on each particle; only those of the wall have some to take along
------------------------------------------------------------------------- */

void FixSPHWall::grow_arrays(int nmax)
{
  memory->grow(array_atom, nmax, 6, "sph/wall:array_atom");
}

void FixSPHWall::set_arrays(int i)
{
  std::fill_n(array_atom[i], 6, 0.0);
}

void FixSPHWall::copy_arrays(int i, int j, int /*delflag*/)
{
  std::copy_n(array_atom[i], 6, array_atom[j]);
}

int FixSPHWall::pack_exchange(int i, double *buf)
{
  if (!(atom->mask[i] & groupbit)) return 0;
  std::copy_n(array_atom[i], 6, buf);
  return 6;
}

int FixSPHWall::unpack_exchange(int i, double *buf)
{
  set_arrays(i);
  if (!(atom->mask[i] & groupbit)) return 0;
  std::copy_n(buf, 6, array_atom[i]);
  return 6;
}

/* ---------------------------------------------------------------------- */

double FixSPHWall::memory_usage()
{
  return 6.0 * atom->nmax * sizeof(double);
}
