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

// The two pair loops, compiled once per instruction set: a source file includes what stands
// below, switches the compiler to the instruction set, defines LOOPS and includes this file.
// Nothing else may be included after the switch, or inline functions of other headers would be
// compiled for a processor that a user may not have.

namespace LAMMPS_NS {
namespace SPHDissipation {
  namespace LOOPS {

    // added to r and r^2 before dividing: two particles at the same point, r_ij = 0, exert no force
    // on each other

    constexpr double TINY = 1.0e-300;

    // out = sqrt(in); n is a multiple of BLOCK.  Compilers vectorize sqrt() only where it need not
    // set errno, hence the intrinsics.

    inline void square_roots(const double *in, double *out, int n)
    {
#if defined(LOOPS_AVX512)
      for (int k = 0; k < n; k += 8)
        _mm512_storeu_pd(out + k, _mm512_sqrt_pd(_mm512_loadu_pd(in + k)));
#elif defined(LOOPS_AVX2)
      for (int k = 0; k < n; k += 4)
        _mm256_storeu_pd(out + k, _mm256_sqrt_pd(_mm256_loadu_pd(in + k)));
#elif defined(__SSE2__)
      for (int k = 0; k < n; k += 2) _mm_storeu_pd(out + k, _mm_sqrt_pd(_mm_loadu_pd(in + k)));
#else
      for (int k = 0; k < n; k++) out[k] = std::sqrt(in[k]);
#endif
    }

    // sum of n entries, a multiple of BLOCK, with one partial sum for each lane of a vector

    inline double sum(const double *in, int n)
    {
      double lane[BLOCK] = {};
      for (int k = 0; k < n; k += BLOCK)
        for (int l = 0; l < BLOCK; l++) lane[l] += in[k + l];
      return ((lane[0] + lane[1]) + (lane[2] + lane[3])) +
          ((lane[4] + lane[5]) + (lane[6] + lane[7]));
    }

    // pass 1: c_i = sum_j W, cdot_i = -sum_j F r_ij.u_ij

    template <class K> void density_loop(LoopData &data)
    {
      const Particle *const particle = data.particle;
      DensitySum *const density = data.density;
      const double support_sq = data.support * data.support;
      const double support_inv = 1.0 / data.support;
      const double weight_norm = data.weight_norm;
      const double slope_norm = data.slope_norm;
      double *const radius = data.scratch;
      double *const weight = radius + data.stride;
      double *const flux = weight + data.stride;

      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        const int *const jlist = data.firstneigh[i];
        const int jnum = data.numneigh[i];
        const Particle pi = particle[i];
        int *const neighbor = data.neighbor + data.first[ii];
        double *const slope = data.slope + data.first[ii];
        double *const approach = data.approach + data.first[ii];

        // keep the pairs inside the support; slope[] holds r^2 until F overwrites it

        int n = 0;
        for (int jj = 0; jj < jnum; jj++) {
          const int j = jlist[jj] & NEIGHMASK;
          const Particle &pj = particle[j];
          const double dx = pi.x[0] - pj.x[0];
          const double dy = pi.x[1] - pj.x[1];
          const double dz = pi.x[2] - pj.x[2];
          const double rsq = dx * dx + dy * dy + dz * dz;
          neighbor[n] = j;
          slope[n] = rsq;
          approach[n] =
              dx * (pi.u[0] - pj.u[0]) + dy * (pi.u[1] - pj.u[1]) + dz * (pi.u[2] - pj.u[2]);
          n += (rsq < support_sq) ? 1 : 0;
        }
        data.count[ii] = n;
        const int nblock = round_up(n);
        for (int k = n; k < nblock; k++) {
          slope[k] = support_sq;
          approach[k] = 0.0;
        }

        square_roots(slope, radius, nblock);

        SPH_INDEPENDENT
        for (int k = 0; k < nblock; k++) {
          const double q = radius[k] * support_inv;
          weight[k] = weight_norm * K::shape(q);
          slope[k] = slope_norm * K::slope(q);
          flux[k] = slope[k] * approach[k];
        }

        for (int k = 0; k < n; k++) {
          density[neighbor[k]].c += weight[k];
          density[neighbor[k]].cdot -= flux[k];
        }
        density[i].c += sum(weight, nblock);
        density[i].cdot -= sum(flux, nblock);
      }
    }

    // pass 2: pressure, shear and bulk forces and the heating of shear (half to each partner)
    // VOLUME: the bulk form P1 (64) with its own pair weights, and D_i = -sum_j V_j F r_ij.u_ij, by
    // which it heats; the form P1 (18) acts through g and heats by cdot
    // MICROPOLAR: torques, too; half of the torque of a pair force to each partner, P3 (12), (18)

    template <Shear SHEAR, bool VOLUME> void force_loop(LoopData &data)
    {
      constexpr bool SPIN = (SHEAR == Shear::MICROPOLAR);
      constexpr bool ALONG_R =
          (SHEAR == Shear::MG || SHEAR == Shear::MG_FR || SHEAR == Shear::ESPANOL || SPIN);
      constexpr bool ALONG_U = (SHEAR == Shear::MORRIS || SHEAR == Shear::ESPANOL || SPIN);

      const Particle *const particle = data.particle;
      ForceSum *const force = data.force;

      double *column[NSCRATCH];
      for (int c = 0; c < NSCRATCH; c++) column[c] = data.scratch + (bigint) c * data.stride;
      double *const dx = column[0];
      double *const dy = column[1];
      double *const dz = column[2];
      double *const ux = column[3];
      double *const uy = column[4];
      double *const uz = column[5];
      double *const fx = column[6];
      double *const fy = column[7];
      double *const fz = column[8];
      double *const vol = column[9];
      double *const g = column[10];
      double *const along_r = column[11];
      double *const metric = column[12];
      double *const zeta_term = column[13];
      double *const heat = column[14];
      double *const flux = column[15];
      double *const along_u = column[16];
      double *const xi1 = column[17];
      double *const xi2 = column[18];
      double *const wx = column[19];
      double *const wy = column[20];
      double *const wz = column[21];
      double *const tx = column[22];
      double *const ty = column[23];
      double *const tz = column[24];
      double *const sx = column[25];
      double *const sy = column[26];
      double *const sz = column[27];
      double *const heat_vortex = column[28];
      double *const heat_spin = column[29];

      auto set_coeff = [=](int k, const PairCoeff &coeff) {
        if (ALONG_R) along_r[k] = coeff.along_r;
        if (ALONG_U) along_u[k] = coeff.along_u;
        if (SPIN) {
          xi1[k] = coeff.xi1;
          xi2[k] = coeff.xi2;
        }
      };
      if (data.uniform)
        for (int k = 0; k < data.stride; k++) set_coeff(k, data.coeff[data.ntypes_1 + 1]);

      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        const Particle pi = particle[i];
        const int n = data.count[ii];
        const int nblock = round_up(n);
        const int *const neighbor = data.neighbor + data.first[ii];
        const double *const slope = data.slope + data.first[ii];
        const double *const approach = data.approach + data.first[ii];
        const double zeta_term_i = VOLUME ? data.zeta_term[i] : 0.0;
        const Spin spin_i = SPIN ? data.spin[i] : Spin();

        for (int k = 0; k < n; k++) {
          const Particle &pj = particle[neighbor[k]];
          dx[k] = pi.x[0] - pj.x[0];
          dy[k] = pi.x[1] - pj.x[1];
          dz[k] = pi.x[2] - pj.x[2];
          vol[k] = pj.vol;
          g[k] = pj.g;
          if (ALONG_U) {
            ux[k] = pi.u[0] - pj.u[0];
            uy[k] = pi.u[1] - pj.u[1];
            uz[k] = pi.u[2] - pj.u[2];
          }
          if (SPIN) {
            const Spin &spin_j = data.spin[neighbor[k]];
            wx[k] = spin_j.w[0];
            wy[k] = spin_j.w[1];
            wz[k] = spin_j.w[2];
          }
          if (VOLUME) zeta_term[k] = data.zeta_term[neighbor[k]];
        }
        for (int k = n; k < nblock; k++) {
          dx[k] = dy[k] = dz[k] = vol[k] = g[k] = 0.0;
          if (ALONG_U) ux[k] = uy[k] = uz[k] = 0.0;
          if (SPIN) wx[k] = wy[k] = wz[k] = 0.0;
          if (VOLUME) zeta_term[k] = 0.0;
        }
        if ((ALONG_R || ALONG_U) && !data.uniform) {
          const PairCoeff *const coeff = data.coeff + data.type[i] * data.ntypes_1;
          for (int k = 0; k < n; k++) set_coeff(k, coeff[data.type[neighbor[k]]]);
          for (int k = n; k < nblock; k++) set_coeff(k, PairCoeff());
        }
        if (ALONG_R || ALONG_U)
          for (int k = 0; k < nblock; k++)
            metric[k] = dx[k] * dx[k] + dy[k] * dy[k] + dz[k] * dz[k];
        if (SHEAR == Shear::MG_FR) square_roots(metric, metric, nblock);

        SPH_INDEPENDENT
        for (int k = 0; k < nblock; k++) {
          const double vv_slope = pi.vol * vol[k] * slope[k];
          double central = (pi.g + g[k]) * slope[k];
          double heat_shear = 0.0;

          if (ALONG_R) {
            const double drag = along_r[k] * vv_slope * approach[k] / (metric[k] + TINY);
            central -= drag;
            heat_shear = 0.5 * drag * approach[k];
          }
          if (VOLUME) {
            central += (zeta_term_i + zeta_term[k]) * vv_slope;
            flux[k] = slope[k] * approach[k];
          }
          double fxk = central * dx[k];
          double fyk = central * dy[k];
          double fzk = central * dz[k];
          if (ALONG_U) {
            double uxk = ux[k], uyk = uy[k], uzk = uz[k];
            if (SPIN) {
              const double mx = 0.5 * (spin_i.w[0] + wx[k]);
              const double my = 0.5 * (spin_i.w[1] + wy[k]);
              const double mz = 0.5 * (spin_i.w[2] + wz[k]);
              uxk -= my * dz[k] - mz * dy[k];
              uyk -= mz * dx[k] - mx * dz[k];
              uzk -= mx * dy[k] - my * dx[k];
            }
            const double drag = (metric[k] > 0.0) ? along_u[k] * vv_slope : 0.0;
            fxk -= drag * uxk;
            fyk -= drag * uyk;
            fzk -= drag * uzk;
            const double heat_u = 0.5 * drag * (uxk * uxk + uyk * uyk + uzk * uzk);
            if (SPIN) {
              heat_vortex[k] = heat_u;
              tx[k] = 0.5 * drag * (dy[k] * uzk - dz[k] * uyk);
              ty[k] = 0.5 * drag * (dz[k] * uxk - dx[k] * uzk);
              tz[k] = 0.5 * drag * (dx[k] * uyk - dy[k] * uxk);
            } else
              heat_shear += heat_u;
          }
          if (SPIN) {
            const double sxk = spin_i.w[0] - wx[k];
            const double syk = spin_i.w[1] - wy[k];
            const double szk = spin_i.w[2] - wz[k];
            const double along = dx[k] * sxk + dy[k] * syk + dz[k] * szk;
            const double drag1 = xi1[k] * vv_slope * along / (metric[k] + TINY);
            const double drag2 = (metric[k] > 0.0) ? xi2[k] * vv_slope : 0.0;
            sx[k] = drag1 * dx[k] + drag2 * sxk;
            sy[k] = drag1 * dy[k] + drag2 * syk;
            sz[k] = drag1 * dz[k] + drag2 * szk;
            heat_spin[k] = 0.5 * (drag1 * along + drag2 * (sxk * sxk + syk * syk + szk * szk));
          }
          fx[k] = fxk;
          fy[k] = fyk;
          fz[k] = fzk;
          heat[k] = heat_shear;
        }

        for (int k = 0; k < n; k++) {
          ForceSum &fj = force[neighbor[k]];
          fj.f[0] -= fx[k];
          fj.f[1] -= fy[k];
          fj.f[2] -= fz[k];
          fj.heat += heat[k];
          if (VOLUME) data.divergence[neighbor[k]] -= pi.vol * flux[k];
          if (SPIN) {
            TorqueSum &tj = data.torque[neighbor[k]];
            tj.t[0] += tx[k] + sx[k];
            tj.t[1] += ty[k] + sy[k];
            tj.t[2] += tz[k] + sz[k];
            tj.heat_vortex += heat_vortex[k];
            tj.heat_spin += heat_spin[k];
          }
        }
        force[i].f[0] += sum(fx, nblock);
        force[i].f[1] += sum(fy, nblock);
        force[i].f[2] += sum(fz, nblock);
        force[i].heat += sum(heat, nblock);
        if (SPIN) {
          TorqueSum &ti = data.torque[i];
          ti.t[0] += sum(tx, nblock) - sum(sx, nblock);
          ti.t[1] += sum(ty, nblock) - sum(sy, nblock);
          ti.t[2] += sum(tz, nblock) - sum(sz, nblock);
          ti.heat_vortex += sum(heat_vortex, nblock);
          ti.heat_spin += sum(heat_spin, nblock);
        }
        if (VOLUME) {
          for (int k = 0; k < nblock; k++) flux[k] *= vol[k];
          data.divergence[i] -= sum(flux, nblock);
        }

        if (data.tally)
          for (int k = 0; k < n; k++) {
            const double force_on_i[3] = {fx[k], fy[k], fz[k]};
            const double rij[3] = {dx[k], dy[k], dz[k]};
            data.tally->tally(i, neighbor[k], force_on_i, rij);
          }
      }
    }

    inline Loop choose_density_loop(Kernel kernel)
    {
      switch (kernel) {
        case Kernel::WENDLAND_C4:
          return density_loop<WendlandC4>;
        case Kernel::WENDLAND_C6:
          return density_loop<WendlandC6>;
        case Kernel::CUBIC:
          return density_loop<CubicSpline>;
        case Kernel::QUINTIC:
          return density_loop<QuinticSpline>;
        case Kernel::LUCY:
          return density_loop<Lucy>;
        default:
          return density_loop<WendlandC2>;
      }
    }

    template <bool VOLUME> Loop choose_shear(Shear shear)
    {
      switch (shear) {
        case Shear::MG:
          return force_loop<Shear::MG, VOLUME>;
        case Shear::MG_FR:
          return force_loop<Shear::MG_FR, VOLUME>;
        case Shear::MORRIS:
          return force_loop<Shear::MORRIS, VOLUME>;
        case Shear::ESPANOL:
          return force_loop<Shear::ESPANOL, VOLUME>;
        case Shear::MICROPOLAR:
          return force_loop<Shear::MICROPOLAR, VOLUME>;
        default:
          return force_loop<Shear::NONE, VOLUME>;
      }
    }

    inline Loop choose_force_loop(Shear shear, Bulk bulk)
    {
      return (bulk == Bulk::VOLUME) ? choose_shear<true>(shear) : choose_shear<false>(shear);
    }

  }    // namespace LOOPS
}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
