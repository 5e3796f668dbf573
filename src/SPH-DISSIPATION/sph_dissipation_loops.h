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

    // added to r and r^2 before dividing: two particles at the same point have r_ij = 0 and
    // exert no force on each other

    constexpr double TINY = 1.0e-300;

    // the compiler vectorizes sqrt() only if it need not set errno

#if defined(__GNUC__) && !defined(__clang__)
    __attribute__((optimize("no-math-errno")))
#endif
    inline void
    square_roots(const double *in, double *out, int n)
    {
      for (int k = 0; k < n; k++) out[k] = std::sqrt(in[k]);
    }

    inline double sum_block(const double *lane)
    {
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
      double *SPH_RESTRICT const radius = data.scratch;
      double *SPH_RESTRICT const weight = radius + data.stride;
      double *SPH_RESTRICT const flux = weight + data.stride;

      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        const int *const jlist = data.firstneigh[i];
        const int jnum = data.numneigh[i];
        const Particle pi = particle[i];
        int *SPH_RESTRICT const neighbor = data.neighbor + data.first[ii];
        double *SPH_RESTRICT const slope = data.slope + data.first[ii];
        double *SPH_RESTRICT const approach = data.approach + data.first[ii];

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

        double csum[BLOCK] = {}, fluxsum[BLOCK] = {};
        for (int k0 = 0; k0 < nblock; k0 += BLOCK)
          for (int l = 0; l < BLOCK; l++) {
            const int k = k0 + l;
            const double q = radius[k] * support_inv;
            const double w = weight_norm * K::shape(q);
            const double f = slope_norm * K::slope(q);
            const double fu = f * approach[k];
            slope[k] = f;
            weight[k] = w;
            flux[k] = fu;
            csum[l] += w;
            fluxsum[l] += fu;
          }

        for (int k = 0; k < n; k++) {
          density[neighbor[k]].c += weight[k];
          density[neighbor[k]].cdot -= flux[k];
        }
        density[i].c += sum_block(csum);
        density[i].cdot -= sum_block(fluxsum);
      }
    }

    // pass 2: pressure, shear and bulk forces and the heating of shear (half to each partner)
    // VOLUME: the bulk form P1 (64) with its own pair weights and heating; the form P1 (18)
    // acts through g and heats per particle, outside this loop

    template <Shear SHEAR, bool VOLUME> void force_loop(LoopData &data)
    {
      constexpr bool CENTRAL = (SHEAR == Shear::MG || SHEAR == Shear::MG_FR);
      constexpr bool MORRIS = (SHEAR == Shear::MORRIS);

      const Particle *const particle = data.particle;
      ForceSum *const force = data.force;

      double *SPH_RESTRICT column[NSCRATCH];
      for (int c = 0; c < NSCRATCH; c++) column[c] = data.scratch + (bigint) c * data.stride;
      double *SPH_RESTRICT const dx = column[0];
      double *SPH_RESTRICT const dy = column[1];
      double *SPH_RESTRICT const dz = column[2];
      double *SPH_RESTRICT const ux = column[3];
      double *SPH_RESTRICT const uy = column[4];
      double *SPH_RESTRICT const uz = column[5];
      double *SPH_RESTRICT const fx = column[6];
      double *SPH_RESTRICT const fy = column[7];
      double *SPH_RESTRICT const fz = column[8];
      double *SPH_RESTRICT const vol = column[9];
      double *SPH_RESTRICT const g = column[10];
      double *SPH_RESTRICT const factor = column[11];
      double *SPH_RESTRICT const metric = column[12];
      double *SPH_RESTRICT const zeta_term = column[13];
      double *SPH_RESTRICT const heat = column[14];
      double *SPH_RESTRICT const heat_bulk = column[15];

      if (data.one_mu) {
        const double factor_one = data.shear_factor * data.mu[1][1];
        for (int k = 0; k < data.stride; k++) factor[k] = factor_one;
      }

      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        const Particle pi = particle[i];
        const int n = data.count[ii];
        const int nblock = round_up(n);
        const int *SPH_RESTRICT const neighbor = data.neighbor + data.first[ii];
        const double *SPH_RESTRICT const slope = data.slope + data.first[ii];
        const double *SPH_RESTRICT const approach = data.approach + data.first[ii];
        const double zeta_term_i = VOLUME ? data.zeta_term[i] : 0.0;

        for (int k = 0; k < n; k++) {
          const Particle &pj = particle[neighbor[k]];
          dx[k] = pi.x[0] - pj.x[0];
          dy[k] = pi.x[1] - pj.x[1];
          dz[k] = pi.x[2] - pj.x[2];
          vol[k] = pj.vol;
          g[k] = pj.g;
          if (MORRIS) {
            ux[k] = pi.u[0] - pj.u[0];
            uy[k] = pi.u[1] - pj.u[1];
            uz[k] = pi.u[2] - pj.u[2];
          }
          if (VOLUME) zeta_term[k] = data.zeta_term[neighbor[k]];
        }
        for (int k = n; k < nblock; k++) {
          dx[k] = dy[k] = dz[k] = vol[k] = g[k] = 0.0;
          if (MORRIS) ux[k] = uy[k] = uz[k] = 0.0;
          if (VOLUME) zeta_term[k] = 0.0;
        }
        if ((CENTRAL || MORRIS) && !data.one_mu) {
          const double *const mu = data.mu[data.type[i]];
          for (int k = 0; k < n; k++) factor[k] = data.shear_factor * mu[data.type[neighbor[k]]];
          for (int k = n; k < nblock; k++) factor[k] = 0.0;
        }
        if (CENTRAL)
          for (int k = 0; k < nblock; k++)
            metric[k] = dx[k] * dx[k] + dy[k] * dy[k] + dz[k] * dz[k];
        if (SHEAR == Shear::MG_FR) square_roots(metric, metric, nblock);

        double sum[4][BLOCK] = {};
        for (int k0 = 0; k0 < nblock; k0 += BLOCK)
          for (int l = 0; l < BLOCK; l++) {
            const int k = k0 + l;
            const double vv_slope = pi.vol * vol[k] * slope[k];
            double central = (pi.g + g[k]) * slope[k];
            double heat_shear = 0.0;

            if (CENTRAL) {
              const double drag = factor[k] * vv_slope * approach[k] / (metric[k] + TINY);
              central -= drag;
              heat_shear = 0.5 * drag * approach[k];
            }
            if (VOLUME) central += (zeta_term_i + zeta_term[k]) * vv_slope;
            fx[k] = central * dx[k];
            fy[k] = central * dy[k];
            fz[k] = central * dz[k];
            if (MORRIS) {
              const double drag = factor[k] * vv_slope;
              fx[k] -= drag * ux[k];
              fy[k] -= drag * uy[k];
              fz[k] -= drag * uz[k];
              heat_shear = 0.5 * drag * (ux[k] * ux[k] + uy[k] * uy[k] + uz[k] * uz[k]);
            }
            heat[k] = heat_shear;

            sum[0][l] += fx[k];
            sum[1][l] += fy[k];
            sum[2][l] += fz[k];
            sum[3][l] += heat_shear;
            if (VOLUME) {
              heat_bulk[k] = -vv_slope * approach[k];
              sum[3][l] += zeta_term_i * heat_bulk[k];
            }
          }

        for (int k = 0; k < n; k++) {
          ForceSum &fj = force[neighbor[k]];
          fj.f[0] -= fx[k];
          fj.f[1] -= fy[k];
          fj.f[2] -= fz[k];
          fj.heat += VOLUME ? heat[k] + zeta_term[k] * heat_bulk[k] : heat[k];
        }
        for (int d = 0; d < 3; d++) force[i].f[d] += sum_block(sum[d]);
        force[i].heat += sum_block(sum[3]);

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
