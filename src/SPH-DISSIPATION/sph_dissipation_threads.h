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

#ifndef LMP_SPH_DISSIPATION_THREADS_H
#define LMP_SPH_DISSIPATION_THREADS_H

// Threads that share the work of one process.  No LAMMPS include.

#include <cstddef>
#include <cstring>
#include <functional>
#include <numeric>
#include <type_traits>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Return the memory in bytes of vectors and of objects with memory_usage(); for vectors of these, sum over the elements

  template <class T> auto bytes_of(const T &one) -> decltype(one.memory_usage())
  {
    return one.memory_usage();
  }

  template <class T> double bytes_of(const std::vector<T> &list)
  {
    if constexpr (std::is_trivially_copyable<T>::value)
      return static_cast<double>(list.capacity()) * sizeof(T);
    else
      return std::accumulate(list.begin(), list.end(), 0.0, [](double sum, const T &one) {
        return sum + bytes_of(one);
      });
  }

  template <class... One> double bytes(const One &...one)
  {
    return (... + bytes_of(one));
  }

  // Team of threads, here of one thread; the team of the KOKKOS package derives from this class.

  class Threads {
   public:
    virtual ~Threads() = default;
    virtual int size() const { return 1; }

    // Run task(k) on each thread k < size()
    virtual void run(const std::function<void(int)> &task) { task(0); }

    // Run task(k, from, to) on each thread k, with its part of 0 ... n - 1, the same in each call
    template <class Task> void in_parts(int n, const Task &task)
    {
      const int parts = size();
      if (parts == 1) return task(0, 0, n);
      const auto begin = [=](int k) {
        return static_cast<int>(static_cast<long long>(n) * k / parts);
      };
      run([&](int k) {
        task(k, begin(k), begin(k + 1));
      });
    }

    // Run task(i) for each i < n
    template <class Task> void for_each(int n, const Task &task)
    {
      in_parts(n, [&](int, int from, int to) {
        for (int i = from; i < to; i++) task(i);
      });
    }

    // Return the sum of what add(i, total) adds to total, for each i < n
    template <class Sum, class Add> Sum sum(int n, const Add &add)
    {
      std::vector<Sum> part(size());
      in_parts(n, [&](int k, int from, int to) {
        Sum total = 0;
        for (int i = from; i < to; i++) add(i, total);
        part[k] = total;
      });
      return std::accumulate(part.begin() + 1, part.end(), part[0]);
    }
  };

  // Sums by particle to which several threads add: the first thread adds to the result, each other thread to its own rows,
  // which all threads then add to the result.  Row: double, or a struct of doubles

  template <class Row> class ThreadSums {
   public:
    // Run task(k, sum) on each thread k, which adds to rows sum[0] ... sum[n - 1]; add all rows up in total
    template <class Task> void run(Threads &threads, Row *total, std::size_t n, const Task &task)
    {
      begin(threads);
      threads.run([&](int k) {
        task(k, (k > 0) ? zeroed(k, nullptr, n) : total);
      });
      add_up(threads, total, static_cast<int>(n));
    }

    // Do the same if thread k adds only to the rows of the particles touched[k], each listed once
    template <class Task>
    void run(Threads &threads, Row *total, std::size_t n,
             const std::vector<std::vector<int>> &touched, const Task &task)
    {
      begin(threads);
      threads.run([&](int k) {
        if (k == 0) return task(0, total);
        auto &own = others[k - 1];
        if (own.size() < n) own.resize(n);
        for (const int i : touched[k]) own[i] = Row();
        task(k, own.data());
      });
      for (std::size_t k = 1; k <= others.size(); k++)
        threads.for_each(static_cast<int>(touched[k].size()), [&](int m) {
          const int i = touched[k][m];
          add_row(total[i], others[k - 1][i]);
        });
    }

    // Parts of run(), for a task with several sums: begin(), zeroed() on each thread, add_up()

    void begin(const Threads &threads) { others.resize(threads.size() - 1); }

    // Return n rows of zeros for thread k; total for the first one
    Row *zeroed(int k, Row *total, std::size_t n)
    {
      if (k > 0) {
        if (others[k - 1].size() < n) others[k - 1].resize(n);
        total = others[k - 1].data();
      }
      memset(static_cast<void *>(total), 0, n * sizeof(Row));
      return total;
    }
    void add_up(Threads &threads, Row *total, int n) const
    {
      if (others.empty()) return;
      threads.for_each(n, [&](int i) {
        for (const auto &other : others) add_row(total[i], other[i]);
      });
    }

    double memory_usage() const { return bytes(others); }

   private:
    std::vector<std::vector<Row>> others;

    static void add_row(Row &to, const Row &from)
    {
      auto *const sum = reinterpret_cast<double *>(&to);
      const auto *const term = reinterpret_cast<const double *>(&from);
      for (std::size_t k = 0; k < sizeof(Row) / sizeof(double); k++) sum[k] += term[k];
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
