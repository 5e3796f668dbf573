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

#include "sph_dissipation_grid.h"

#include "error.h"

// LAMMPS has this file only with the KSPACE package

#if __has_include("fft3d_wrap.h")
#include "fft3d_wrap.h"
#define SPH_DISSIPATION_FFT
#endif

#include <type_traits>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

#ifdef SPH_DISSIPATION_FFT

namespace {
constexpr int NOT_SCALED = 0, NOT_PERMUTED = 0, POINT_TO_POINT = 0, BLOCKING = 0;

// Create an FFT; LAMMPS 4 Feb 2025 has no choice of blocking messages

template <class FFT, class... Bounds>
FFT *create_fft(LAMMPS *lmp, MPI_Comm world, int *nbuf, Bounds... bounds)
{
  if constexpr (std::is_constructible_v<FFT, LAMMPS *, MPI_Comm, Bounds..., int, int, int *, int,
                                        int>)
    return new FFT(lmp, world, bounds..., NOT_SCALED, NOT_PERMUTED, nbuf, POINT_TO_POINT, BLOCKING);
  else
    return new FFT(lmp, world, bounds..., NOT_SCALED, NOT_PERMUTED, nbuf, POINT_TO_POINT);
}
}    // namespace

struct FourierGrid::Plan {
  bigint npoint;
  int nbuf;    // complex numbers that the FFT holds itself
  double scale;
  std::vector<FFT_SCALAR> work;
  std::unique_ptr<FFT3d> fft;
};

/* ---------------------------------------------------------------------- */

FourierGrid::FourierGrid(LAMMPS *lmp, const ParticleGrid &grid) :
    Pointers(lmp), plan(std::make_unique<Plan>())
{
  const int *const n = grid.count, *const lo = grid.lo, *const hi = grid.hi;
  plan->fft.reset(create_fft<FFT3d>(lmp, world, &plan->nbuf, n[0], n[1], n[2], lo[0], hi[0], lo[1],
                                    hi[1], lo[2], hi[2], lo[0], hi[0], lo[1], hi[1], lo[2], hi[2]));
  plan->npoint = grid.npoint();
  plan->scale = 1.0 / (static_cast<double>(n[0]) * n[1] * n[2]);
  plan->work.resize(2 * plan->npoint);
}

/* ---------------------------------------------------------------------- */

void FourierGrid::transform(const double *field, std::complex<double> *modes)
{
  std::vector<FFT_SCALAR> &work = plan->work;
  for (bigint k = 0; k < plan->npoint; k++) {
    work[2 * k] = static_cast<FFT_SCALAR>(field[k]);
    work[2 * k + 1] = 0.0;
  }
  plan->fft->compute(work.data(), work.data(), FFT3d::FORWARD);
  for (bigint k = 0; k < plan->npoint; k++)
    modes[k] = {plan->scale * work[2 * k], plan->scale * work[2 * k + 1]};
}

/* ---------------------------------------------------------------------- */

double FourierGrid::memory_usage() const
{
  return ((double) plan->work.size() + 2.0 * plan->nbuf) * sizeof(FFT_SCALAR);
}

#else

struct FourierGrid::Plan {};

FourierGrid::FourierGrid(LAMMPS *lmp, const ParticleGrid &) : Pointers(lmp) {}

void FourierGrid::transform(const double *, std::complex<double> *)
{
  error->all(FLERR, "Fourier transforms need the KSPACE package");
}

double FourierGrid::memory_usage() const
{
  return 0.0;
}

#endif

/* ---------------------------------------------------------------------- */

FourierGrid::~FourierGrid() = default;

/* ---------------------------------------------------------------------- */

bool FourierGrid::available()
{
#ifdef SPH_DISSIPATION_FFT
  return true;
#else
  return false;
#endif
}
