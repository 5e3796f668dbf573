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

// The formulas of the smoothing kernels, see sph_dissipation_kernel.h, for one distance q or, in the pair loops, for a
// vector of distances.  Included in more than one namespace, hence without guard and namespace: functions that take vectors
// must be compiled for a processor with these vectors.

struct WendlandC2 {
  static constexpr const char *name = "wendland/c2";
  static double norm(int n)
  {
    return (n == 1) ? 1.5 : (n == 2) ? 7.0 / KERNEL_PI : 10.5 / KERNEL_PI;
  }
  template <class Real> static SPH_FUNCTION Real shape(Real q)
  {
    const Real a = (1.0 - q) * (1.0 - q);
    return a * a * (1.0 + 4.0 * q);
  }
  template <class Real> static SPH_FUNCTION Real slope(Real q)
  {
    const Real a = 1.0 - q;
    return 20.0 * a * a * a;
  }
};

struct WendlandC4 {
  static constexpr const char *name = "wendland/c4";
  static double norm(int n)
  {
    return (n == 1) ? 27.0 / 16.0 : (n == 2) ? 9.0 / KERNEL_PI : 495.0 / (32.0 * KERNEL_PI);
  }
  template <class Real> static SPH_FUNCTION Real shape(Real q)
  {
    const Real a = (1.0 - q) * (1.0 - q);
    return a * a * a * (1.0 + q * (6.0 + q * (35.0 / 3.0)));
  }
  template <class Real> static SPH_FUNCTION Real slope(Real q)
  {
    const Real a = (1.0 - q) * (1.0 - q);
    return (56.0 / 3.0) * a * a * (1.0 - q) * (1.0 + 5.0 * q);
  }
};

struct WendlandC6 {
  static constexpr const char *name = "wendland/c6";
  static double norm(int n)
  {
    return (n == 1) ? 1.875 : (n == 2) ? 78.0 / (7.0 * KERNEL_PI) : 1365.0 / (64.0 * KERNEL_PI);
  }
  template <class Real> static SPH_FUNCTION Real shape(Real q)
  {
    const Real a = (1.0 - q) * (1.0 - q);
    return a * a * a * a * (1.0 + q * (8.0 + q * (25.0 + q * 32.0)));
  }
  template <class Real> static SPH_FUNCTION Real slope(Real q)
  {
    const Real a = (1.0 - q) * (1.0 - q);
    return 22.0 * a * a * a * (1.0 - q) * (1.0 + q * (7.0 + q * 16.0));
  }
};

struct Lucy {
  static constexpr const char *name = "lucy";
  static double norm(int n)
  {
    return (n == 1) ? 1.25 : (n == 2) ? 5.0 / KERNEL_PI : 105.0 / (16.0 * KERNEL_PI);
  }
  template <class Real> static SPH_FUNCTION Real shape(Real q)
  {
    const Real a = 1.0 - q;
    return a * a * a * (1.0 + 3.0 * q);
  }
  template <class Real> static SPH_FUNCTION Real slope(Real q)
  {
    return 12.0 * (1.0 - q) * (1.0 - q);
  }
};

struct CubicSpline {
  static constexpr const char *name = "cubic";
  static double norm(int n)
  {
    return (n == 1) ? 4.0 / 3.0 : (n == 2) ? 40.0 / (7.0 * KERNEL_PI) : 8.0 / KERNEL_PI;
  }
  template <class Real> static SPH_FUNCTION Real shape(Real q)
  {
    const Real s = 2.0 * q;
    const Real b = 2.0 - s;
    const Real inner = 1.0 - s * s * (1.5 - 0.75 * s);
    const Real outer = 0.25 * b * b * b;
    return (s < 1.0) ? inner : outer;
  }
  template <class Real> static SPH_FUNCTION Real slope(Real q)
  {
    const Real s = 2.0 * q;
    const Real b = 2.0 - s;
    const Real inner = 4.0 * (3.0 - 2.25 * s);
    const Real outer = 3.0 * b * b / (s < 1.0 ? 1.0 : s);
    return (s < 1.0) ? inner : outer;
  }
};

struct QuinticSpline {
  static constexpr const char *name = "quintic";
  static double norm(int n)
  {
    return (n == 1) ? 1.0 / 40.0
        : (n == 2)  ? 63.0 / (478.0 * KERNEL_PI)
                    : 27.0 / (120.0 * KERNEL_PI);
  }
  template <class Real> static SPH_FUNCTION Real shape(Real q)
  {
    const Real s = 3.0 * q;
    const Real a = 3.0 - s;
    const Real b = (s < 2.0) ? 2.0 - s : 0.0;
    const Real c = (s < 1.0) ? 1.0 - s : 0.0;
    const Real a2 = a * a, b2 = b * b, c2 = c * c;
    return a2 * a2 * a - 6.0 * (b2 * b2 * b) + 15.0 * (c2 * c2 * c);
  }
  template <class Real> static SPH_FUNCTION Real slope(Real q)
  {
    const Real s = 3.0 * q;
    const Real a = 3.0 - s;
    const Real b = (s < 2.0) ? 2.0 - s : 0.0;
    const Real a2 = a * a, b2 = b * b;
    const Real inner = 9.0 * (120.0 - s * s * (120.0 - 50.0 * s));
    const Real outer = 45.0 * (a2 * a2 - 6.0 * (b2 * b2)) / (s < 1.0 ? 1.0 : s);
    return (s < 1.0) ? inner : outer;
  }
};

// Call function(KernelClass()) for the kernel chosen at run time; device code may call it with a function that runs there

#ifdef __CUDACC__
#pragma nv_exec_check_disable
#endif
template <class Function> SPH_INLINE auto with_kernel(Kernel kernel, Function &&function)
{
  switch (kernel) {
    case Kernel::WENDLAND_C4:
      return function(WendlandC4());
    case Kernel::WENDLAND_C6:
      return function(WendlandC6());
    case Kernel::CUBIC:
      return function(CubicSpline());
    case Kernel::QUINTIC:
      return function(QuinticSpline());
    case Kernel::LUCY:
      return function(Lucy());
    default:
      return function(WendlandC2());
  }
}
