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

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(sph/spectrum,ComputeSPHSpectrum);
// clang-format on
#else

#ifndef LMP_COMPUTE_SPH_SPECTRUM_H
#define LMP_COMPUTE_SPH_SPECTRUM_H

#include "sph_dissipation_grid.h"

namespace LAMMPS_NS {

// Spectra of the solenoidal and the dilatational motion, of vorticity and density, by FFT of the fields on a grid; sums of
// the spectra, and the power that both motions dissipate.

class ComputeSPHSpectrum : public SPHDissipation::GridCompute {
 public:
  ComputeSPHSpectrum(class LAMMPS *, int, char **);
  ~ComputeSPHSpectrum() override;
  void init() override;
  void reset_grid() override;
  void compute_vector() override;
  void compute_array() override { compute_vector(); }
  double memory_usage() override;

 private:
  bool deconvolve = false;
  int nshell = 0;    // shells asked for, 0: all
  bool micropolar, checked = false;
  std::unique_ptr<SPHDissipation::FourierGrid> fourier;
  std::vector<std::vector<std::complex<double>>>
      modes;                         // one array per field, see compute_vector()
  std::vector<double> raise;         // factor of each mode
  std::vector<double> raised_for;    // box, support radius, kernel

  double shell_width() const;
  int last_shell() const;
  void transform_fields();
  template <class Function> void for_modes(Function &&) const;
  void set_raise();
  void sum_modes();
  void set_dissipation();
};

}    // namespace LAMMPS_NS

#endif
#endif
