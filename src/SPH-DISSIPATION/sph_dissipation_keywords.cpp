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

#include "sph_dissipation_keywords.h"

#include "error.h"
#include "input.h"
#include "lammps.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

int SPHDissipation::place(LAMMPS *lmp, const char *word)
{
  for (int iarg = 0; iarg < lmp->input->narg; iarg++)
    if (lmp->input->arg[iarg] == word) return iarg;
  return Error::NOPOINTER;
}

/* ----------------------------------------------------------------------
   Return the least number of insertions, deletions, and replacements of characters that turn word a into word b.
------------------------------------------------------------------------- */

static int distance(const std::string &a, const std::string &b)
{
  std::vector<int> row(b.size() + 1);
  for (std::size_t l = 0; l <= b.size(); l++) row[l] = static_cast<int>(l);
  for (const char letter : a) {
    int diagonal = row[0]++;
    for (std::size_t l = 0; l < b.size(); l++) {
      const int replaced = diagonal + (letter != b[l] ? 1 : 0);
      diagonal = row[l + 1];
      row[l + 1] = std::min({row[l] + 1, diagonal + 1, replaced});
    }
  }
  return row.back();
}

/* ---------------------------------------------------------------------- */

void SPHDissipation::unknown_word(LAMMPS *lmp, const char *word, const std::string &text,
                                  std::vector<std::string> names)
{
  if (names.empty())
    lmp->error->all(FLERR, place(lmp, word), "{}: there are no keywords; use no more words", text);
  const auto nearest =
      std::min_element(names.begin(), names.end(), [&](const auto &one, const auto &other) {
        return distance(word, one) < distance(word, other);
      });
  std::rotate(names.begin(), nearest, nearest + 1);
  std::string list = names[0];
  for (std::size_t k = 1; k < names.size(); k++)
    list += (k + 1 < names.size() ? ", " : names.size() > 2 ? ", or " : " or ") + names[k];
  lmp->error->all(FLERR, place(lmp, word), "{}; use {}", text, list);
}

/* ---------------------------------------------------------------------- */

void SPHDissipation::demand_words(LAMMPS *lmp, const std::string &command, int given,
                                  const std::string &names)
{
  const int needed = static_cast<int>(utils::count_words(names));
  if (given < needed)
    lmp->error->all(FLERR, Error::NOPOINTER,
                    "Illegal {} command: missing argument(s), {} of {} given; give {}", command,
                    given, needed, names);
}

/* ---------------------------------------------------------------------- */

bool Keywords::next()
{
  if (!known)
    unknown_word(lmp, arg[at - 1],
                 fmt::format("Unknown {} keyword: {}", utils::lowercase(owner), keyword), names);
  if (end >= narg) return false;
  keyword = arg[end];
  at = ++end;
  known = false;
  names.clear();
  return true;
}

/* ---------------------------------------------------------------------- */

void Keywords::end_here()
{
  while (next()) {}
}

/* ---------------------------------------------------------------------- */

bool Keywords::is(const std::string &name, const std::string &values)
{
  names.push_back(name);
  if (keyword != name) return false;
  known = true;
  end = at;
  wanted.clear();
  more(values);
  return true;
}

void Keywords::more(const std::string &values)
{
  wanted += (wanted.empty() ? "" : " ") + values;
  end = at + static_cast<int>(utils::count_words(wanted));
  demand_words(lmp, fmt::format("{} {}", utils::lowercase(owner), keyword), narg - at, wanted);
}

/* ---------------------------------------------------------------------- */

double Keywords::number(int k) const
{
  return utils::numeric(FLERR, word(k), false, lmp);
}

int Keywords::whole_number() const
{
  return utils::inumeric(FLERR, word(), false, lmp);
}

double Keywords::positive() const
{
  const double value = number();
  demand(value > 0.0, "> 0");
  return value;
}

/* ---------------------------------------------------------------------- */

int Keywords::choice(std::initializer_list<const char *> words) const
{
  std::string all;
  for (const char *const *one = words.begin(); one != words.end(); one++) {
    if (strcmp(*one, word()) == 0) return static_cast<int>(one - words.begin());
    if (one != words.begin()) all += (words.size() > 2) ? ", " : " ";
    if (one == words.end() - 1) all += "or ";
    all += *one;
  }
  demand(false, all);
  return -1;
}

/* ---------------------------------------------------------------------- */

void Keywords::demand(bool good, const std::string &what) const
{
  if (!good)
    lmp->error->all(FLERR, place(lmp, word()), "{} {} must be {}, not {}", owner, keyword, what,
                    word());
}
