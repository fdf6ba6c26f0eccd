// SPDX-License-Identifier: GPL-2.0-or-later
// Keywords of a style and their values, from tables of what there is

#ifndef LMP_LSM_KEYWORD_READER_H
#define LMP_LSM_KEYWORD_READER_H

#include "lsm_keywords.h"
#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

/// Goes through the words after a style's name. Any error stops LAMMPS with one line.
class LSMKeywordReader : protected Pointers {
 public:
  /// style: as messages begin, "Fix lsm/leap"; the words begin at arg[first]
  LSMKeywordReader(LAMMPS *, const std::string &style, int first, int narg, char **arg);

  /// Goes on to the next keyword. False: there is none.
  bool next();
  const std::string &key() const { return key_; }
  /// The keyword has so many values: to be called before they are asked for, if the keyword is not read from a table.
  void need(int values);
  const char *text(int n = 1) const { return arg_[at_ + n]; }
  /// Reads the value if the keyword is in the table.
  bool read(const LSM::Keywords &);
  /// The last value.
  double number(LSM::Must) const;

  [[noreturn]] void refuse(const std::string &expected) const;
  [[noreturn]] void stop(const std::string &message) const;
  /// also: keywords that are in no table, separated by a comma and a blank
  [[noreturn]] void unknown(const LSM::Keywords &, const std::string &also = "") const;

 private:
  const std::string style_;
  int at_, narg_;
  char **arg_;
  int used_ = 0;    // words of the keyword, with itself
  std::string key_;

  int whole_number(LSM::Must) const;
  int place_in(const std::vector<const char *> &) const;
};

}    // namespace LAMMPS_NS

#endif
