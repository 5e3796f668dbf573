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

#ifndef LMP_SPH_DISSIPATION_KEYWORDS_H
#define LMP_SPH_DISSIPATION_KEYWORDS_H

#include <initializer_list>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;

namespace SPHDissipation {

  // Return the place of a word among the words of the input's command, which an error marks; Error::NOPOINTER for a word from
  // elsewhere, such as a data file

  int place(LAMMPS *, const char *word);

  // Stop at an unknown word.  text = beginning of the message; names = the known words, which the message lists, the nearest
  // word first

  [[noreturn]] void unknown_word(LAMMPS *, const char *word, const std::string &text,
                                 std::vector<std::string> names);

  // Stop if a command or keyword has fewer words than names, which has them in their order

  void demand_words(LAMMPS *, const std::string &command, int given, const std::string &names);

  // The keywords at the end of a command: each is a name and some words.  A message lists the names that is() has asked for.
  //
  //   for (Keywords key(lmp, "Fix sph/dt", 4, narg, arg); key.next();)
  //     if (key.is("min")) smallest = key.positive();
  //
  // Stops for an unknown keyword, which is() has never found, and for a keyword with too few words.

  class Keywords {
   public:
    // Begin in front of arg[first]; owner: for messages.
    Keywords(LAMMPS *lmp, const std::string &owner, int first, int narg, char **arg) :
        lmp(lmp), owner(owner), narg(narg), arg(arg), at(first), end(first)
    {
    }

    bool next();        // Go to the next keyword; false if there is none.
    void end_here();    // Stop at a word, of a command without keywords.
    // is(): if the keyword has this name, go behind its words.  more(): go behind more words.  values = names of the words
    bool is(const std::string &name, const std::string &values = "value");
    void more(const std::string &values);

    const std::string &name() const { return keyword; }
    char **words() const { return arg + at; }
    const char *word(int k = 0) const { return arg[at + k]; }
    double number(int k = 0) const;
    int whole_number() const;
    double positive() const;                                        // > 0
    int choice(std::initializer_list<const char *> words) const;    // index of the word among these
    void demand(bool good, const std::string &what) const;    // error "must be what, not word"

   private:
    LAMMPS *const lmp;
    const std::string owner;
    const int narg;
    char **const arg;
    int at, end;            // range of the words of the keyword
    std::string keyword;    // empty: in front of the first keyword
    bool known = true;
    std::vector<std::string> names;    // that is() has asked for
    std::string wanted;                // names of the words of the keyword
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
