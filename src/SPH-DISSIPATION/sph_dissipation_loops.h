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

// The pair loops, compiled once per instruction set: a source file includes the headers below, switches the compiler to the
// instruction set, defines LOOPS (the namespace), LOOPS_SET and LOOPS_NAME, and includes this file.  Include nothing else
// after the switch: inline functions of other headers would be compiled for a processor that a user may not have.

#include "sph_dissipation_simd.h"
#include "sph_dissipation_words.h"

namespace LAMMPS_NS {
namespace SPHDissipation {
  namespace LOOPS {

#include "sph_dissipation_kernel_shapes.h"
#include "sph_dissipation_pair_terms.h"

    // Fetch the rows of the neighbors two blocks ahead into the cache

    constexpr int AHEAD = 2 * LANES;

    template <int N> SPH_INLINE void fetch_ahead(const double *row, const Offset *j)
    {
      for (int l = 0; l < LANES; l++) prefetch(at<N>(row, j[l + AHEAD]));
    }

    // A row: the struct of one particle or of its sums, read as WIDTH numbers

    template <class Row> constexpr int WIDTH = sizeof(Row) / sizeof(double);

    template <class Row> SPH_INLINE const double *numbers(const Row *row)
    {
      return reinterpret_cast<const double *>(row);
    }
    template <class Row> SPH_INLINE double *numbers(Row *row)
    {
      return reinterpret_cast<double *>(row);
    }

    // Pass 2 computes F of pairs without spins again: with wide vectors this is faster than reading it from memory

    constexpr bool COMPUTES_SLOPES = LANES == 8;

    // Pass 1: sum c_i = sum_j w_j W, cdot_i = -sum_j w_j F r_ij.u_ij, with w = 1 unless WEIGHTED.  Store the pairs for pass
    // 2; SLOPES: also F of each pair; SQUARES: also F (e.u)^2 (mg/fr2: F (r.u)^2).  q = r/support, at most 1, where W and F
    // are zero: so spare particles, which are far away, add nothing

    template <class K, bool WEIGHTED, bool SLOPES, bool SQUARES> void density_loop(LoopData &data)
    {
      const Particle *const particle = data.particle;
      const Parameters &par = *data.par;
      const double weight_norm = par.weight_norm, slope_norm = par.slope_norm;
      const Vec support_sq = all(par.support * par.support), one = all(1.0);
      const double support_inv = 1.0 / par.support;
      const bool by_square = (par.shear == Shear::MG_FR2);
      bigint next = data.begin;

      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        const int *const jlist = data.firstneigh[i];
        const int jnum = data.numneigh[i];
        const Particle pi = particle[i];
        Offset *const neighbor = data.neighbor + next;
        double *const slope = SLOPES ? data.slope + next : nullptr;
        double *const square = SQUARES ? data.square + next : nullptr;
        int n = 0;
        Vec total[2] = {all(0.0), all(0.0)};

        copy_neighbors(neighbor, jlist, jnum, data.spare);

        for (int jj = 0; jj < jnum; jj += LANES) {
          const Offset *const j = neighbor + jj;
          Vec pj[6];
          load_4_columns<WIDTH<Particle>>(numbers(particle), j, pj);
          const Vec dx = pi.x[0] - pj[0], dy = pi.x[1] - pj[1], dz = pi.x[2] - pj[2];
          const Vec rsq = dx * dx + dy * dy + dz * dz;
          const int inside = bits_below(rsq, support_sq);
          if (!inside) continue;

          load_2_columns<WIDTH<Particle>>(numbers(particle) + 4, j, pj + 4);
          const Vec ux = pj[3] - pi.u[0], uy = pj[4] - pi.u[1], uz = pj[5] - pi.u[2];
          const Vec approach = dx * ux + dy * uy + dz * uz;
          const Vec q = smaller(square_root(rsq) * support_inv, one);
          const Vec f = slope_norm * K::slope(q);
          Vec sums[2] = {weight_norm * K::shape(q), f * approach};
          if constexpr (WEIGHTED) {
            const Vec weight = gather(data.weight, j);
            for (int c = 0; c < 2; c++) {
              total[c] += weight * sums[c];
              sums[c] *= data.weight[i];
            }
          } else
            for (int c = 0; c < 2; c++) total[c] += sums[c];
          add_2_columns<WIDTH<DensitySum>>(numbers(data.density), j, sums);

          if constexpr (SLOPES) pack(slope + n, f, inside);
          if constexpr (SQUARES) {
            const Vec metric = by_square ? one : rsq + TINY;
            pack(square + n, f * approach * (approach / metric), inside);
          }
          pack(neighbor + n, j, inside);
          n += count_bits(inside);
        }
        data.density[i].c += sum(total[0]);
        data.density[i].cdot += sum(total[1]);

        // fill up the last block with spare particles and F = 0

        if constexpr (SLOPES) store(slope + n, all(0.0));
        if constexpr (SQUARES) store(square + n, all(0.0));
        for (int l = 0; l < LANES; l++) neighbor[n + l] = offset_of(data.spare + l);
        data.count[ii] = n;
        data.first[ii] = next;
        next += (n + LANES - 1) / LANES * LANES;
      }
      for (int k = 0; k < AHEAD; k++) data.neighbor[next + k] = offset_of(data.spare);
    }

    // Sum cdot alone, over the pairs of pass 1

    template <bool WEIGHTED> void rate_loop(LoopData &data)
    {
      const Particle *const particle = data.particle;
      double *const cdot = numbers(data.density) + 1;

      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        const Particle pi = particle[i];
        const Offset *const neighbor = data.neighbor + data.first[ii];
        const double *const slope_of = data.slope + data.first[ii];
        Vec total = all(0.0);

        for (int k = 0; k < data.count[ii]; k += LANES) {
          const Offset *const j = neighbor + k;
          Vec pj[6];
          load_4_columns<WIDTH<Particle>>(numbers(particle), j, pj);
          load_2_columns<WIDTH<Particle>>(numbers(particle) + 4, j, pj + 4);
          fetch_ahead<WIDTH<Particle>>(numbers(particle), j);
          const Vec dx = pi.x[0] - pj[0], dy = pi.x[1] - pj[1], dz = pi.x[2] - pj[2];
          const Vec ux = pi.u[0] - pj[3], uy = pi.u[1] - pj[4], uz = pi.u[2] - pj[5];
          const Vec flux = load(slope_of + k) * (dx * ux + dy * uy + dz * uz);
          if constexpr (WEIGHTED) {
            total -= gather(data.weight, j) * flux;
            add_column<WIDTH<DensitySum>>(cdot, j, -data.weight[i] * flux);
          } else {
            total -= flux;
            add_column<WIDTH<DensitySum>>(cdot, j, -flux);
          }
        }
        data.density[i].cdot += sum(total);
      }
    }

    // Add sum_j V_j F (e.u)^2 (mg/fr2: sum_j V_j F (r.u)^2) to rate[i], over the pairs of pass 1

    inline void shear_rate_loop(const LoopData &data, const double *vol, double *rate)
    {
      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        const Offset *const neighbor = data.neighbor + data.first[ii];
        const double *const square_of = data.square + data.first[ii];
        Vec total = all(0.0);

        for (int k = 0; k < data.count[ii]; k += LANES) {
          const Offset *const j = neighbor + k;
          const Vec square = load(square_of + k);
          total += gather(vol, j) * square;
          add_column<1>(rate, j, vol[i] * square);
        }
        rate[i] += sum(total);
      }
    }

    // Coefficients of all pairs of types, a Row of N numbers for each pair.  If there are at most as many types as lanes,
    // the vector of_types[i][k] has number k of type i with all types.
    template <class Row> struct CoeffTable {
      static constexpr int N = WIDTH<Row>;
      const Row *const row;
      const int *const type;
      const int ntypes_1;
      const bool few;
      double of_types[LANES][N][LANES];

      CoeffTable(const Row *row, const LoopData &data) :
          row(row), type(data.type), ntypes_1(data.par->ntypes_1),
          few(!data.par->uniform && ntypes_1 <= LANES + 1)
      {
        if (!few) return;
        for (int i = 1; i < ntypes_1; i++)
          for (int j = 1; j < ntypes_1; j++)
            for (int k = 0; k < N; k++)
              of_types[i % LANES][k][j % LANES] = numbers(row + i * ntypes_1 + j)[k];
      }
    };

    // Coefficients of a block of pairs: load() loads the coefficients that Used::uses(); before, of type 1 with itself
    template <class Row, class Used> struct Coeffs {
      static constexpr int N = WIDTH<Row>;
      Vec a[N];
      SPH_INLINE Coeffs(const CoeffTable<Row> &table)
      {
        for (int k = 0; k < N; k++) a[k] = all(numbers(table.row + table.ntypes_1 + 1)[k]);
      }
      SPH_INLINE void load(const CoeffTable<Row> &table, int i, const Offset *j)
      {
        if (table.few) {
          const Indices types = indices_of(table.type, j);
          const auto *const of_type = table.of_types[table.type[i] % LANES];
          for (int k = 0; k < N; k++)
            if (Used::uses(k)) a[k] = pick(of_type[k], types);
          return;
        }
        Offset pair[LANES];
        for (int l = 0; l < LANES; l++) pair[l] = offset_of(N * table.type[index_of(j[l])]);
        const double *const of_type = numbers(table.row + table.type[i] * table.ntypes_1);
        for (int k = 0; k < N; k++)
          if (Used::uses(k)) a[k] = gather(of_type + k, pair);
      }
    };

    // Pass force f on i and r = r_ij of the first n pairs of a block to the tally, one pair after the other

    inline void tally_block(PairTally *tally, int i, const Offset *j, int n, const Vec *f,
                            const Vec *r)
    {
      double f_lane[3][LANES], r_lane[3][LANES];
      for (int d = 0; d < 3; d++) {
        store(f_lane[d], f[d]);
        store(r_lane[d], r[d]);
      }
      for (int l = 0; l < LANES && l < n; l++) {
        const double force_on_i[3] = {f_lane[0][l], f_lane[1][l], f_lane[2][l]};
        const double rij[3] = {r_lane[0][l], r_lane[1][l], r_lane[2][l]};
        tally->tally(i, index_of(j[l]), force_on_i, rij);
      }
    }

#include "sph_dissipation_noise_loops.h"

    // Computes F of pairs as pass 1 does

    struct PairSlope {
      const Kernel kernel;
      const double support_inv, norm;

      explicit PairSlope(const Constants &par) :
          kernel(par.kernel), support_inv(1.0 / par.support), norm(par.slope_norm)
      {
      }
      SPH_INLINE Vec operator()(Vec rsq) const
      {
        const Vec q = smaller(square_root(rsq) * support_inv, all(1.0));
        return norm * LOOPS::with_kernel(kernel, At{q});
      }

     private:
      struct At {
        const Vec q;
        template <class K> SPH_INLINE Vec operator()(K) const { return K::slope(q); }
      };
    };

    // Return the force of cohesion along r_ij, over r, of pairs whose strengths are 1

    SPH_INLINE Vec cohesion_slope(const CohesionData &cohesion, Vec rsq)
    {
      const Vec distance = square_root(rsq);
      Vec part[2];
      for (int m = 0; m < 2; m++)
        part[m] = cohesion.slope_norm[m] *
            WendlandC6::slope(smaller(distance * cohesion.support_inv[m], all(1.0)));
      return part[0] - part[1];
    }

    // Set pair to a block of pairs of one particle, and vol and g to the neighbors' values; return F = slope_of(r^2)

    template <class Form, class Slope>
    SPH_INLINE Vec load_pair(PairState &pair, const Particle &pi, const Particle *particle,
                             const Offset *j, Slope &&slope_of, Vec &vol, Vec &g)
    {
      Vec pj[8];
      load_4_columns<WIDTH<Particle>>(numbers(particle), j, pj);
      load_4_columns<WIDTH<Particle>>(numbers(particle) + 4, j, pj + 4);
      for (int d = 0; d < 3; d++) {
        pair.r[d] = pi.x[d] - pj[d];
        pair.u[d] = pi.u[d] - pj[3 + d];
      }
      vol = pj[6];
      g = pj[7];
      const Vec rsq = dot(pair.r, pair.r), slope = slope_of(rsq);
      pair.vv = volumes_slope(rsq, pi.vol, vol, slope);
      pair.approach = dot(pair.r, pair.u);
      const Vec nothing = all(-0.0);    // compilers drop an addition to -0
      pair.heat[0] = Form::heats(0) ? nothing : all(0.0);
      for (int c = 1; c < NCHANNEL; c++)
        if (Form::heats(c)) pair.heat[c] = nothing;
      if constexpr (Form::SPINS)
        for (int d = 0; d < 3; d++) pair.t[d] = pair.spin[d] = nothing;
      return slope;
    }

    // Give the fluid all heat of pairs with a boundary.  The function is not inline and has a copy of the pair: otherwise
    // the loops would keep all pairs in memory instead of registers

    template <class Form>
    SPH_NOINLINE void give_boundary_heat(PairState &pair, const Excess *excess, int i,
                                         const Offset *j)
    {
      constexpr int N = WIDTH<Excess>;
      const Excess &own = excess[i];
      Vec other[N];
      load_4_columns<N>(numbers(excess), j, other);
      PairState more = pair;
      for (int d = 0; d < 3; d++) more.u[d] = own.u[d] - other[d];
      more.approach = dot(pair.r, more.u);
      if constexpr (Form::SPINS) {
        load_4_columns<N>(numbers(excess) + 4, j, other + 4);
        slip_velocity(own.w, other + 4, pair.r, more.u);
        for (int d = 0; d < 3; d++) more.s[d] = own.w[d] - other[4 + d];
      }
      add_boundary_heat<Form>(pair, more, own.is_boundary + other[3]);
    }

    // Sums of torque, and of heat of all channels but the first, in the columns of ChannelSums.  add() adds a block of pairs
    // to the neighbors' sums and to the totals; add_total() adds the totals to the sums of particle i

    template <class Form> struct SideSums {
      static constexpr ChannelColumns COLUMNS = {Form::SPINS, Form::channels()};
      static constexpr int N = COLUMNS.width();
      Vec total[N + 1];

      SPH_INLINE SideSums()
      {
        for (int k = 0; k < N; k++) total[k] = all(0.0);
      }
      SPH_INLINE void add(double *row, const Offset *j, const PairState &pair)
      {
        Vec on_j[N + 1];
        if constexpr (Form::SPINS)
          for (int d = 0; d < 3; d++) {
            on_j[d] = pair.t[d] + pair.spin[d];
            total[d] += pair.t[d] - pair.spin[d];
          }
        for (int c = 1; c < NCHANNEL; c++)
          if (Form::heats(c)) {
            on_j[COLUMNS.heat(c)] = pair.heat[c];
            total[COLUMNS.heat(c)] += pair.heat[c];
          }
        constexpr int FOURS = N / 4 * 4;
        for (int k = 0; k < FOURS; k += 4) add_4_columns<N>(row + k, j, on_j + k);
        for (int k = FOURS; k < N; k++) add_column<N>(row + k, j, on_j[k]);
      }
      SPH_INLINE void add_total(double *row, int i) const
      {
        for (int k = 0; k < N; k++) row[i * N + k] += sum(total[k]);
      }
    };

    template <class Form> SPH_INLINE void fetch_ahead(const LoopData &data, const Offset *j)
    {
      fetch_ahead<WIDTH<Particle>>(numbers(data.particle), j);
      if constexpr (Form::SPINS) {    // without spins, the force is in the cache anyway
        fetch_ahead<WIDTH<Spin>>(numbers(data.spin), j);
        fetch_ahead<WIDTH<ForceSum>>(numbers(data.force), j);
        fetch_ahead<SideSums<Form>::N>(data.side, j);
      }
    }

    // Pass 2: sum forces and torques of the pressure and of the channels, and their heat, half to each partner
    // Form: the terms of the pairs
    // VOLUME: the bulk form P1 (64) with separate pair weights, and D_i = -sum_j V_j F r_ij.u_ij for its heat; else the form
    // P1 (18), whose force is a part of g and whose heat follows from cdot
    // Noise: random forces and torques of the pairs; Noise::ENERGY: the heat pays for the work of random forces

    template <class Form, bool VOLUME, bool WEIGHTED, class Noise = NoNoise>
    void force_loop(LoopData &data)
    {
      const Particle *const particle = data.particle;
      const bool uniform = data.par->uniform;
      const double *const weight = (data.par->volume == Volume::MASS) ? data.weight : nullptr;
      const CoeffTable<PairCoeff> table(data.par->pair.data(), data);
      Coeffs<PairCoeff, Form> coeffs(table);
      constexpr bool AGAIN = COMPUTES_SLOPES && !Form::SPINS && !Noise::ON;
      constexpr bool CONTINUED = (Form::CENTRAL || Form::VECTOR) && !Noise::ON;
      const bool again = !data.slope;    // pass 1 has left no F
      const PairSlope slope_again(*data.par);
      const double *const strength = data.cohesion.strength;
      const typename Noise::Table noise_table(data);
      Noise noise(data, noise_table);

      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        noise.begin(ii);
        const Particle pi = particle[i];
        const Spin spin_i = Form::SPINS ? data.spin[i] : Spin();
        const double zeta_term_i = VOLUME ? data.zeta_term[i] : 0.0;
        const double mu_i = Form::BY_RATE ? data.viscosity[i] : 0.0;
        const int n = data.count[ii];
        const bool crosses = CONTINUED && data.excess && data.excess[i].crosses != 0.0;
        const Offset *const neighbor = data.neighbor + data.first[ii];
        const double *const slope_of = again ? nullptr : data.slope + data.first[ii];
        Vec total_f[4] = {all(0.0), all(0.0), all(0.0), all(0.0)};
        Vec total_flux = all(0.0);
        SideSums<Form> side;

        for (int k = 0; k < n; k += LANES) {
          const Offset *const j = neighbor + k;
          PairState pair;
          pair.coeff = coeffs.a;
          Vec vol, g;
          const Vec slope = load_pair<Form>(
              pair, pi, particle, j,
              [&](Vec rsq) {
                return (AGAIN && again) ? slope_again(rsq) : load(slope_of + k);
              },
              vol, g);
          fetch_ahead<Form>(data, j);
          const Vec rsq = dot(pair.r, pair.r);

          pair.central = pressing_term(pi.g, g, slope);
          Vec pressing = slope;
          if (WEIGHTED && weight) {
            const Vec weights = weight[i] * gather(weight, j);
            pair.central *= weights;
            pressing *= weights;
          }
          if (strength)
            pair.central += strength[i] * gather(strength, j) * cohesion_slope(data.cohesion, rsq);
          const Vec by_pressure = pair.central;
          Vec given = all(0.0);    // heat that j gives i

          if ((Form::CENTRAL || Form::VECTOR) && !uniform) coeffs.load(table, i, j);
          const Vec metric = metric_of<Form::BY_DISTANCE>(rsq);
          Vec inverse = all(0.0);
          pair.by_metric = all(0.0);
          if constexpr (Noise::VECTOR) {
            inverse = 1.0 / (rsq + TINY);
            pair.by_metric = pair.vv * inverse;
          } else if constexpr (Form::CENTRAL || Noise::ON)
            pair.by_metric =
                pair.vv * (1.0 / (metric + TINY));    // the division does not wait for F
          if constexpr (Noise::ON) {
            noise.draw(j, pair.r[0], pair.r[1], pair.r[2], slope, pair.vv, metric, pair.by_metric,
                       inverse);
            pair.central += noise.central;
          }
          if constexpr (Form::BY_RATE) {
            pair.mu[0] = all(mu_i);
            pair.mu[1] = gather(data.viscosity, j);
          }
          const Vec vv_slope = pair.vv;
          if constexpr (Noise::ENERGY) {
            pair.vv *= noise.friction;
            pair.by_metric *= noise.friction;
          }
          Form::add_central(pair);
          if constexpr (VOLUME) {
            pair.central += volume_term(zeta_term_i, gather(data.zeta_term, j), vv_slope);
            const Vec flux = slope * pair.approach;
            total_flux += flux * vol;
            add_column<1>(data.divergence, j, -pi.vol * flux);
          }
          for (int d = 0; d < 3; d++) pair.f[d] = pair.central * pair.r[d];
          if constexpr (Noise::ON) noise.add_force(pair.f[0], pair.f[1], pair.f[2]);
          if constexpr (Form::SPINS) {
            Vec w[4];
            load_4_columns<WIDTH<Spin>>(numbers(data.spin), j, w);
            slip_velocity(spin_i.w, w, pair.r, pair.u);
            for (int d = 0; d < 3; d++) pair.s[d] = spin_i.w[d] - w[d];
          }
          Form::add_vector(pair);

          if constexpr (Form::SPINS) {
            if constexpr (Noise::ENERGY)
              pair.heat[Form::of_spins()] -=
                  0.5 * noise.spin_power(pair.s[0], pair.s[1], pair.s[2]);
            if constexpr (Noise::ON) noise.add_torque(pair.t, pair.spin);
            if constexpr (Noise::ENERGY) given = noise.given_by_torque(pair.t, pair.spin);
          }
          if constexpr (CONTINUED)
            if (crosses) {
              PairState copy = pair;
              give_boundary_heat<Form>(copy, data.excess, i, j);
              for (int c = 0; c < NCHANNEL; c++)
                if (Form::heats(c)) pair.heat[c] = copy.heat[c];
            }
          if constexpr (side.N > 0) side.add(data.side, j, pair);
          Vec heat = pair.heat[0];
          for (int d = 0; d < 3; d++) total_f[d] += pair.f[d];
          Vec heat_j = heat;
          if constexpr (Noise::ENERGY) {
            const Vec work = 0.5 * noise.power(pair.approach, pair.u[0], pair.u[1], pair.u[2]);
            Vec square = noise.central * (pair.central - by_pressure) * rsq;
            if constexpr (Form::VECTOR || !Noise::CENTRAL_ONLY) {
              Vec random[3], viscous[3];
              for (int d = 0; d < 3; d++) {
                random[d] = noise.central * pair.r[d];
                viscous[d] = pair.f[d] - by_pressure * pair.r[d];
              }
              noise.add_force(random[0], random[1], random[2]);
              square = dot(random, viscous);
            }
            given += noise.given(square, rsq, pressing);
            if constexpr (Noise::CONDUCTS) {
              // A wall gives its half of the heat to the fluid.  For pairs with a wall, the factor zero removes the heat
              // given so far without loss of digits, however large this heat is.
              Vec half = heat - work;
              for (int c = 1; c < NCHANNEL; c++)
                if (Form::heats(c)) half += pair.heat[c];
              given = (1.0 - noise.wall * noise.wall) * given + noise.flow + noise.wall * half;
            }
            heat -= work - given;
            heat_j -= work + given;
          }
          total_f[3] += heat;
          const Vec on_j[4] = {-pair.f[0], -pair.f[1], -pair.f[2], heat_j};
          add_4_columns<WIDTH<ForceSum>>(numbers(data.force), j, on_j);
          if (data.tally) tally_block(data.tally, i, j, n - k, pair.f, pair.r);
        }

        ForceSum &fi = data.force[i];
        for (int d = 0; d < 3; d++) fi.f[d] += sum(total_f[d]);
        fi.heat += sum(total_f[3]);
        if constexpr (side.N > 0) side.add_total(data.side, i);
        if constexpr (VOLUME) data.divergence[i] -= sum(total_flux);
      }
    }

    // Add the heat that i gets from j to noise.total, see NoiseStage::share_work(): from the work of both pressures (not of
    // random pressures) and of the friction of the pair, at the mean velocities of the kick.  PairNoise::given_by_torque()
    // returns the part with the square of the torques of the pair

    template <class Form> void work_loop(const LoopData &data, const NoiseData &noise)
    {
      const Particle *const particle = data.particle;
      const double *const weight = (data.par->volume == Volume::MASS) ? data.weight : nullptr;
      const CoeffTable<PairCoeff> table(data.par->pair.data(), data);
      Coeffs<PairCoeff, Form> coeffs(table);
      const double quarter = 0.25 * noise.dt;

      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        const NoiseRow &own = noise.row[i];
        if (own.temperature < 0.0) continue;
        const Particle pi = particle[i];
        const Acceleration &mine = noise.acceleration[i];
        const Vec a_i[3] = {all(mine.v[0]), all(mine.v[1]), all(mine.v[2])};
        const int n = data.count[ii];
        const Offset *const neighbor = data.neighbor + data.first[ii];
        const double *const slope_of = data.slope + data.first[ii];
        Vec total = all(0.0);

        for (int k = 0; k < n; k += LANES) {
          const Offset *const j = neighbor + k;
          PairState pair;
          pair.coeff = coeffs.a;
          Vec vol, g, a_j[4], other[4];
          const Vec slope = load_pair<Form>(
              pair, pi, particle, j,
              [&](Vec) {
                return load(slope_of + k);
              },
              vol, g);
          load_4_columns<WIDTH<Acceleration>>(numbers(noise.acceleration), j, a_j);
          load_4_columns<WIDTH<NoiseRow>>(numbers(noise.row), j, other);
          fetch_ahead<WIDTH<Particle>>(numbers(particle), j);
          fetch_ahead<WIDTH<Acceleration>>(numbers(noise.acceleration), j);
          fetch_ahead<WIDTH<NoiseRow>>(numbers(noise.row), j);
          if (!data.par->uniform) coeffs.load(table, i, j);
          const OwnTemperatures both(all(own.temperature),
                                     larger(other[NoiseRow::TEMPERATURE], all(0.0)));
          pair.vv *= both.friction(own.softness + other[NoiseRow::SOFTNESS]);
          pair.by_metric = pair.vv / (metric_of<Form::BY_DISTANCE>(dot(pair.r, pair.r)) + TINY);
          pair.central = all(0.0);
          Form::add_central(pair);
          for (int d = 0; d < 3; d++) pair.f[d] = pair.central * pair.r[d];
          if constexpr (Form::SPINS) {
            Vec w[4];
            load_4_columns<WIDTH<Spin>>(numbers(data.spin), j, w);
            slip_velocity(data.spin[i].w, w, pair.r, pair.u);
            for (int d = 0; d < 3; d++) pair.s[d] = data.spin[i].w[d] - w[d];
          }
          Form::add_vector(pair);

          Vec pressing = slope;
          if (weight) pressing *= weight[i] * gather(weight, j);
          Vec heat = 2.0 * pressing *
                  ((pi.g - own.pressure) * dot(pair.r, a_j) +
                   (g - other[NoiseRow::PRESSURE]) * dot(pair.r, a_i)) +
              dot(pair.f, a_i) + dot(pair.f, a_j);
          if constexpr (Form::SPINS) {
            Vec turn[4];
            load_4_columns<WIDTH<Acceleration>>(numbers(noise.acceleration) + 4, j, turn);
            for (int d = 0; d < 3; d++) {
              const Vec on_i = pair.t[d] - pair.spin[d], on_j = pair.t[d] + pair.spin[d];
              heat +=
                  on_i * (mine.w[d] - mine.by_inertia * on_i) - on_j * (turn[d] - a_j[3] * on_j);
            }
          }
          heat *= quarter *
              (1.0 - if_positive(-other[NoiseRow::TEMPERATURE], all(1.0)));    // 0 with walls
          total += heat;
          add_column<1>(noise.total, j, -heat);
        }
        noise.total[i] += sum(total);
      }
    }

    // Add the flow of each pair to the rates of both particles, after pass 2; ALIKE: all particles with a volume have the
    // same coefficient

    template <bool ALIKE> void flow_loop(const LoopData &data, const FlowRow *row, double *rate)
    {
      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        const FlowRow own = row[i];
        const double minus = -own.vol;    // the loop adds up what the neighbors get
        const Vec own_mean = all(minus * own.coefficient);
        const int n = data.count[ii];
        const Offset *const neighbor = data.neighbor + data.first[ii];
        const double *const slope_of = data.slope + data.first[ii];
        Vec total = all(0.0);

        for (int k = 0; k < n; k += LANES) {
          const Offset *const j = neighbor + k;
          Vec other[4], mean = own_mean;
          if constexpr (ALIKE)
            load_2_columns<WIDTH<FlowRow>>(numbers(row), j, other);
          else {
            load_4_columns<WIDTH<FlowRow>>(numbers(row), j, other);
            mean = minus * mean_coefficient(own.coefficient, other[2]);
          }
          const Vec given = flow_of_pair(mean, other[0] * load(slope_of + k), own.value, other[1]);
          total -= given;
          add_column<1>(rate, j, given);
        }
        rate[i] += sum(total);
      }
    }

    inline FlowLoop choose_flow_loop(bool alike)
    {
      return alike ? flow_loop<true> : flow_loop<false>;
    }

    // Diffusion of volume, after pass 2, see sph_dissipation_diffusion_terms.h: return F over the mean impedance, without
    // the common factor of all a_ij.  ALIKE: all particles have the same impedance: return F

    template <bool ALIKE>
    SPH_INLINE Vec diffusion_slope(const DiffusionData &data, double own, const Offset *j,
                                   Vec slope)
    {
      if constexpr (ALIKE)
        return slope;
      else
        return slope_by_impedance(slope, own, gather(data.impedance, j));
    }

    // Sum the terms of pressure_gradient(), width_of_sums() numbers for each particle

    template <int DIM, bool ALIKE>
    void diffusion_sums(const LoopData &data, const DiffusionData &diffusion, double *sums)
    {
      typedef DiffusionPlaces<DIM> At;
      constexpr int N = At::NSUM, FOURS = N / 4 * 4, WIDTH = width_of_sums(DIM, ALIKE);
      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        const double *const own = diffusion.row[i].a;
        if (own[At::VOL] == 0.0) continue;
        const double impedance = ALIKE ? 0.0 : diffusion.impedance[i];
        const int n = data.count[ii];
        const Offset *const neighbor = data.neighbor + data.first[ii];
        const double *const slope_of = data.slope + data.first[ii];
        Vec total[N], on_j[N], other[8], r[DIM];
        for (int k = 0; k < N; k++) total[k] = all(0.0);
        Vec unlike[At::NTENSOR];
        for (int k = 0; k < At::NTENSOR; k++) unlike[k] = all(0.0);

        for (int k = 0; k < n; k += LANES) {
          const Offset *const j = neighbor + k;
          load_4_columns<8>(diffusion.row[0].a, j, other);
          if constexpr (DIM == 3) load_4_columns<8>(diffusion.row[0].a + 4, j, other + 4);
          fetch_ahead<8>(diffusion.row[0].a, j);
          fetch_ahead<WIDTH>(sums, j);
          for (int d = 0; d < DIM; d++) r[d] = own[d] - other[d];
          const Vec slope = diffusion_slope<ALIKE>(diffusion, impedance, j, load(slope_of + k));
          const Vec difference = own[At::P] - other[At::P];
          gradient_terms<DIM>(slope, difference, r, on_j);
          for (int m = 0; m < N; m++) {
            total[m] += other[At::VOL] * on_j[m];
            on_j[m] *= own[At::VOL];
          }
          for (int m = 0; m < FOURS; m += 4) add_4_columns<WIDTH>(sums + m, j, on_j + m);
          for (int m = FOURS; m < N; m++) add_column<WIDTH>(sums + m, j, on_j[m]);

          // skip blocks without pairs of two impedances: few blocks have such pairs

          if constexpr (!ALIKE) {
            const Vec its = gather(diffusion.impedance, j), more = its - all(impedance);
            if (!bits_below(all(0.0), if_positive(slope, larger(more, -more)))) continue;
            const Vec rest = load(slope_of + k) * more / (its + all(impedance));
            for (int d = 0, m = 0; d < DIM; d++)
              for (int e = d; e < DIM; e++, m++) {
                const Vec term = rest * r[d] * r[e];
                unlike[m] += other[At::VOL] * term;
                add_column<WIDTH>(sums + N + m, j, -own[At::VOL] * term);
              }
          }
        }
        for (int k = 0; k < N; k++) sums[i * WIDTH + k] += sum(total[k]);
        for (int k = 0; k < At::NTENSOR && !ALIKE; k++) sums[i * WIDTH + N + k] += sum(unlike[k]);
      }
    }

    // Sum (dV_i/dt)/V_i and the residual R_i, two numbers for each particle, without the common factor of all a_ij

    template <int DIM, bool ALIKE>
    void diffusion_flow(const LoopData &data, const DiffusionData &diffusion, double *flow)
    {
      typedef DiffusionPlaces<DIM> At;
      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        const double *const own = diffusion.row[i].a;
        if (own[At::VOL] == 0.0) continue;
        const double impedance = ALIKE ? 0.0 : diffusion.impedance[i];
        const int n = data.count[ii];
        const Offset *const neighbor = data.neighbor + data.first[ii];
        const double *const slope_of = data.slope + data.first[ii];
        Vec total[2] = {all(0.0), all(0.0)}, on_j[2], other[8], r[DIM];

        for (int k = 0; k < n; k += LANES) {
          const Offset *const j = neighbor + k;
          load_4_columns<8>(diffusion.row[0].a, j, other);
          if constexpr (DIM == 3)
            load_4_columns<8>(diffusion.row[0].a + 4, j, other + 4);
          else
            load_2_columns<8>(diffusion.row[0].a + 4, j, other + 4);
          fetch_ahead<8>(diffusion.row[0].a, j);
          fetch_ahead<2>(flow, j);
          const Vec slope = diffusion_slope<ALIKE>(diffusion, impedance, j, load(slope_of + k));
          for (int d = 0; d < DIM; d++) r[d] = own[d] - other[d];
          const Vec difference = own[At::P] - other[At::P];
          const Vec by_i = without_gradient<DIM>(difference, own + At::G, r);
          const Vec by_j = without_gradient<DIM>(difference, other + At::G, r);
          const Vec from_j = slope * other[At::VOL], chi = 0.5 * (by_i + by_j);
          const Vec from_i = own[At::VOL] * slope;
          total[0] += from_j * chi;
          total[1] += from_j * by_i * by_i;
          on_j[0] = -from_i * chi;
          on_j[1] = from_i * by_j * by_j;
          add_2_columns<2>(flow, j, on_j);
        }
        for (int k = 0; k < 2; k++) flow[2 * i + k] += sum(total[k]);
      }
    }

    template <bool ALIKE> DiffusionLoop choose_diffusion(DiffusionPart part, int dim)
    {
      if (part == DiffusionPart::SUMS)
        return (dim == 3) ? diffusion_sums<3, ALIKE>
            : (dim == 2)  ? diffusion_sums<2, ALIKE>
                          : diffusion_sums<1, ALIKE>;
      return (dim == 3) ? diffusion_flow<3, ALIKE>
          : (dim == 2)  ? diffusion_flow<2, ALIKE>
                        : diffusion_flow<1, ALIKE>;
    }

    inline DiffusionLoop choose_diffusion_loop(DiffusionPart part, int dim, bool alike)
    {
      return alike ? choose_diffusion<true>(part, dim) : choose_diffusion<false>(part, dim);
    }

    template <bool WEIGHTED, bool SQUARES> Loop choose_density(Kernel kernel, bool slopes)
    {
      return LOOPS::with_kernel(kernel, [=](auto k) -> Loop {
        using K = decltype(k);
        if constexpr (COMPUTES_SLOPES)
          if (!slopes) return density_loop<K, WEIGHTED, false, SQUARES>;
        return density_loop<K, WEIGHTED, true, SQUARES>;
      });
    }

    inline Loop choose_density_loop(Kernel kernel, Volume volume, bool slopes, bool squares)
    {
      if (volume == Volume::MASS)
        return squares ? choose_density<true, true>(kernel, slopes)
                       : choose_density<true, false>(kernel, slopes);
      return squares ? choose_density<false, true>(kernel, slopes)
                     : choose_density<false, false>(kernel, slopes);
    }

    inline Loop choose_rate_loop(Volume volume)
    {
      return (volume == Volume::MASS) ? rate_loop<true> : rate_loop<false>;
    }

#include "sph_dissipation_boundary_loops.h"
#include "sph_dissipation_neighbor_loops.h"

    // True for forms whose loops always have weights (1 with volume number).  So have the loops of the bulk form volume, of
    // viscosities that are not constant, and of the noise

    template <class F>
    constexpr bool IS_FULL =
        std::is_same<F, FullForm>::value || std::is_same<F, FullSpinForm>::value;

    inline Loop choose_force_loop(const Terms &terms, Bulk bulk, Volume volume)
    {
      Loop loop = nullptr;
      with_form(terms, [&](auto form) {
        using F = decltype(form);
        if constexpr (F::BY_RATE)    // not with the bulk form volume
          loop = force_loop<F, false, true>;
        else
          loop = (bulk == Bulk::VOLUME)  ? force_loop<F, true, true>
              : (volume == Volume::MASS) ? force_loop<F, false, true>
                                         : force_loop<F, false, IS_FULL<F>>;
      });
      return loop;
    }

    inline int channels_of(const Terms &terms)
    {
      int bits = 0;
      with_form(terms, [&](auto form) {
        bits = form.channels();
      });
      return bits;
    }

    // Choose the loop with noise.  Forms that only act along e have no numbers across e; the bulk form volume has no noise;
    // without friction, only temp energy has noise

    template <class F, NoiseKind KIND> Loop choose_noise(int dim)
    {
      constexpr bool FRICTION = F::VECTOR || F::CENTRAL;
      if constexpr (F::BY_RATE)    // has no noise
        return nullptr;
      else if constexpr (F::VECTOR)
        return (dim == 3) ? force_loop<F, false, true, PairNoise<3, F::SPINS, KIND, F::BY_SQUARE>>
                          : force_loop<F, false, true, PairNoise<2, F::SPINS, KIND, F::BY_SQUARE>>;
      else if constexpr (FRICTION || KIND == NoiseKind::ENERGY || KIND == NoiseKind::CONDUCTION)
        return force_loop<F, false, true, PairNoise<0, false, KIND, F::BY_SQUARE>>;
      else
        return nullptr;
    }

    inline Loop choose_noisy_force_loop(const NoiseForm &form)
    {
      Loop loop = nullptr;
      with_form(form.terms, [&](auto terms) {
        using F = decltype(terms);
        loop = (form.kind == NoiseKind::DIRECTED) ? choose_noise<F, NoiseKind::DIRECTED>(form.dim)
            : (form.kind == NoiseKind::ENERGY)    ? choose_noise<F, NoiseKind::ENERGY>(form.dim)
            : (form.kind == NoiseKind::CONDUCTION)
            ? choose_noise<F, NoiseKind::CONDUCTION>(form.dim)
            : choose_noise<F, NoiseKind::PLAIN>(form.dim);
      });
      return loop;
    }

    inline NoiseLoop choose_eta_loop(const NoiseForm &form)
    {
      NoiseLoop loop = nullptr;
      with_form(form.terms, [&](auto terms) {
        using F = decltype(terms);
        constexpr int ACROSS = F::VECTOR ? 2 : 0;
        loop = (F::VECTOR && form.dim == 3) ? eta_loop<F::BY_DISTANCE, F::BY_SQUARE, 3>
                                            : eta_loop<F::BY_DISTANCE, F::BY_SQUARE, ACROSS>;
      });
      return loop;
    }

    inline NoiseLoop choose_work_loop(const NoiseForm &form)
    {
      NoiseLoop loop = nullptr;
      with_form(form.terms, [&](auto terms) {
        if constexpr (!decltype(terms)::BY_RATE) loop = work_loop<decltype(terms)>;
      });
      return loop;
    }

  }    // namespace LOOPS

  const LoopSet LOOPS_SET = {LOOPS_NAME,
                             LOOPS::COMPUTES_SLOPES,
                             LOOPS::choose_density_loop,
                             LOOPS::choose_rate_loop,
                             LOOPS::shear_rate_loop,
                             LOOPS::choose_force_loop,
                             LOOPS::channels_of,
                             LOOPS::choose_noisy_force_loop,
                             LOOPS::choose_eta_loop,
                             LOOPS::choose_work_loop,
                             LOOPS::particle_numbers,
                             LOOPS::choose_flow_loop,
                             LOOPS::choose_diffusion_loop,
                             LOOPS::choose_boundary_loops,
                             LOOPS::surface_slope_loop,
                             LOOPS::take_candidates,
                             LOOPS::near};

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
