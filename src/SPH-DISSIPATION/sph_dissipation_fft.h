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

#ifndef LMP_SPH_DISSIPATION_FFT_H
#define LMP_SPH_DISSIPATION_FFT_H

#include "pointers.h"

#include <complex>
#include <memory>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {
  class ParticleGrid;

  // Fourier transform of a field on the points of a grid, by the distributed FFT of LAMMPS's KSPACE
  // package, if LAMMPS is built with it.

  class FourierGrid : protected Pointers {
   public:
    FourierGrid(class LAMMPS *, const ParticleGrid &);
    ~FourierGrid() override;

    static bool available();

    // amplitudes a_k of f = sum_k a_k exp(i k.x), x from the first point: mode (i,j,k) of the box is
    // where the point (i,j,k) is, i.e. on the processor and at the place in the array

    void transform(const double *field, std::complex<double> *modes);
    double memory_usage() const;

   private:
    struct Plan;    // knows LAMMPS's FFTs
    std::unique_ptr<Plan> plan;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
