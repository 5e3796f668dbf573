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

#include "sph_dissipation_surface.h"

#include "atom.h"
#include "math_extra.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static constexpr double RESIDUAL = SurfacePlane::RESIDUAL;
static constexpr double SINGLE = -HUGE_VAL;    // depth of a particle of a body with a single layer

static double edge(double rsq, double radius)
{
  return SurfacePlane::edge(rsq, radius);
}

/* ---------------------------------------------------------------------- */

void SurfaceStage::run(int bits, const BoundaryPairs &pairs, const std::vector<double> &body_in)
{
  body = body_in.empty() ? nullptr : body_in.data();
  begin();
  find_sides(pairs);
  find(bits);
}

/* ---------------------------------------------------------------------- */

void SurfaceStage::run(int bits, const std::vector<double> &sides,
                       const std::vector<double> &body_in)
{
  body = body_in.empty() ? nullptr : body_in.data();
  begin();
  const double *side = sides.data();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & bits)) continue;
    std::copy_n(side, 3, surface[i].normal);
    side += 3;
  }
  find(bits);
}

/* ---------------------------------------------------------------------- */

void SurfaceStage::begin()
{
  surface.resize(atom->nmax);
  engine.for_each(atom->nlocal + atom->nghost, [&](int i) {
    surface[i] = Surface();
  });
}

/* ----------------------------------------------------------------------
   Find the surface near particles with one of these bits.  Before, normals of owned particles are vectors toward the fluid.
------------------------------------------------------------------------- */

void SurfaceStage::find(int bits)
{
  const int dim = engine.constants().dim;
  std::vector<int> owned, all, outer;
  const double support = engine.constants().support;
  double spacing = 0.0, last = 0.0, factor = 0.0;
  for (int i = 0; i < atom->nlocal + atom->nghost; i++) {
    if (!(atom->mask[i] & bits)) continue;
    const double own = spacing_of(dim, atom->vfrac[i]);
    surface[i].spacing = own;
    if (conducts && own != last)
      factor =
          flux_factor(kernel_lattice_sums(engine.constants().kernel, dim, support, last = own));
    surface[i].flux_volume = factor * atom->vfrac[i];
    spacing = std::max(spacing, own);
    all.push_back(i);
    if (i < atom->nlocal) owned.push_back(i);
  }

  const double radius = (spacing > 0.0) ? SurfacePlane::radius(support, spacing) : support;
  find_outer_layer(Cells(atom->x, all, radius), owned);
  Surface *const first = surface.data();
  const Field normal = field(first, first->normal, 3), depth = field(first, &first->depth, 1);
  exchange.forward({normal, depth});

  for (const int i : all)
    if (MathExtra::lensq3(surface[i].normal) > 0.0) outer.push_back(i);
  find_depth(Cells(atom->x, outer, 0.5 * support), owned);
  exchange.forward({normal, depth});
  find_curvature(Cells(atom->x, all, radius), owned);
  exchange.forward(
      {depth, field(first, &first->curvature, 1), field(first, &first->flat_depth, 1)});
}

/* ----------------------------------------------------------------------
   Set the normal of a boundary particle to a vector toward the fluid; zero if no fluid is within the support.
------------------------------------------------------------------------- */

void SurfaceStage::find_sides(const BoundaryPairs &pairs)
{
  engine.team().run([&](int k) {
    pairs.of_thread[k].visit([&](const BoundaryPair &pair) {
      const double *const f = engine.particle[pair.fluid].x;
      const double *const w = engine.particle[pair.wall].x;
      for (int d = 0; d < 3; d++) surface[pair.wall].normal[d] += pair.slope * (f[d] - w[d]);
    });
  });
  exchange.reverse({field(surface.data(), surface.data()->normal, 3)});
}

/* ---------------------------------------------------------------------- */

template <class Task> void SurfaceStage::for_each(const std::vector<int> &owned, const Task &task)
{
  engine.for_each(static_cast<int>(owned.size()), [&](int k) {
    task(owned[k]);
  });
}

/* ----------------------------------------------------------------------
   Set normal and depth of the outer layer; other layers, and layers on the far side from the fluid, get the normal 0.  So do
   bodies of a single layer: the surface is on both sides.
------------------------------------------------------------------------- */

void SurfaceStage::find_outer_layer(const Cells &cells, const std::vector<int> &owned)
{
  const double support = engine.constants().support;
  const int dim = engine.constants().dim;
  for_each(owned, [&](int i) {
    Surface &s = surface[i];
    const bool of_body = body && body[i] > 0.0;
    if (!of_body && MathExtra::lensq3(s.normal) == 0.0) return;    // no fluid in the support
    const SurfacePlane plane(cells, atom->x[i], s.spacing, support, dim, [&](int j) {
      return together(i, j) ? atom->vfrac[j] : 0.0;
    });
    const bool thin =
        of_body && plane.length < SurfacePlane::THIN * SurfacePlane::WIDTH * s.spacing;
    const bool faces = of_body ||
        MathExtra::dot3(plane.inward, s.normal) <
            -RESIDUAL * RESIDUAL * plane.length * MathExtra::len3(s.normal);
    const bool outer = plane.outer && plane.directed && faces && !thin;
    for (int d = 0; d < 3; d++) s.normal[d] = outer ? -plane.inward[d] / plane.length : 0.0;
    s.depth = (thin && plane.outer) ? SINGLE : plane.depth;
  });
}

/* ----------------------------------------------------------------------
   Set depth and normal of all layers as the mean over the tangential planes of the outer layer, each weighted by the inverse
   eighth power of its distance: planes far away on a curved surface or round a corner do not matter.  A particle without
   planes, half way between opposite ones, or of a single layer gets the normal 0 and the depth CLOSEST_MEAN spacings.
------------------------------------------------------------------------- */

void SurfaceStage::find_depth(const Cells &cells, const std::vector<int> &owned)
{
  const double support = engine.constants().support;
  std::vector<Surface> found(owned.size());
  const auto nowned = static_cast<int>(owned.size());
  engine.for_each(nowned, [&](int k) {
    const int i = owned[k];
    Surface s = surface[i];
    const bool single = (s.depth == SINGLE);
    const double soft = CLOSEST * s.spacing;
    double weights = 0.0, depth = 0.0, normal[3] = {0.0, 0.0, 0.0};
    cells.near(atom->x[i], support, [&](int j, const double *r, double rsq) {
      if (!together(i, j)) return;
      const Surface &plane = surface[j];
      const double inverse = 1.0 / (rsq + soft * soft);
      const double weight = inverse * inverse * inverse * inverse * edge(rsq, support);
      weights += weight;
      depth += weight * (MathExtra::dot3(plane.normal, r) + plane.depth);
      for (int d = 0; d < 3; d++) normal[d] += weight * plane.normal[d];
    });
    const double length = MathExtra::len3(normal);
    if (length > RESIDUAL * weights && !single) {
      s.depth = std::max(depth / weights, 0.0);
      for (int d = 0; d < 3; d++) s.normal[d] = normal[d] / length;
    } else {
      s.depth = CLOSEST_MEAN * s.spacing;
      s.normal[0] = s.normal[1] = s.normal[2] = 0.0;
    }
    found[k] = s;
  });
  for (int k = 0; k < nowned; k++) surface[owned[k]] = found[k];
}

/* ----------------------------------------------------------------------
   Set the curvature, the divergence of the normals over the dimensions of the surface, by least squares from the normals
   around a particle; 0 in concave edges, where normals turn too much for the mean normal of surface_heat().  A convex wall
   fills the Gaussian of SurfacePlane less than a half space, so that the depth comes out too small: add the length by theory,
   from the curvature at the surface.  The whole length is added up to the curvature STRONG/spacing, and nothing at edges,
   from twice this curvature on.
------------------------------------------------------------------------- */

void SurfaceStage::find_curvature(const Cells &cells, const std::vector<int> &owned)
{
  constexpr double HOLLOW = -0.25, STRONG = 0.25;    // curvatures times the spacing
  constexpr double FLAT = 1e-9;                      // all particles around are on the normal
  const double support = engine.constants().support;
  const int dim = engine.constants().dim;
  for_each(owned, [&](int i) {
    Surface &s = surface[i];
    s.flat_depth = s.depth;
    if (!(MathExtra::lensq3(s.normal) > 0.0)) return;
    const double radius = SurfacePlane::radius(support, s.spacing);
    double turn = 0.0, norm = 0.0;
    cells.near(atom->x[i], radius, [&](int j, const double *r, double rsq) {
      if (!together(i, j)) return;
      const Surface &other = surface[j];
      const double along = MathExtra::dot3(r, s.normal);
      const double weight = edge(rsq, radius);
      turn += weight *
          (MathExtra::dot3(other.normal, r) - along * MathExtra::dot3(other.normal, s.normal));
      norm += weight * (rsq - along * along);
    });
    if (!(norm > FLAT * s.spacing * s.spacing)) return;
    const double curvature = turn / norm;
    s.curvature = (curvature * s.spacing > HOLLOW) ? curvature : 0.0;
    const double width = SurfacePlane::WIDTH * s.spacing;
    const double bend = s.curvature / std::max(1.0 + s.curvature * s.depth, 0.5);
    const double known = std::clamp(2.0 - fabs(bend) * s.spacing / STRONG, 0.0, 1.0);
    s.depth = std::max(s.depth + 0.5 * (dim - 1) * width * width * known * bend, 0.0);
  });
}
