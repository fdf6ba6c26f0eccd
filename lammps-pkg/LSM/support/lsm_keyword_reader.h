// SPDX-License-Identifier: GPL-2.0-or-later
// Keywords of a style and their values, from tables of what there is

#ifndef LMP_LSM_KEYWORD_READER_H
#define LMP_LSM_KEYWORD_READER_H

#include "files/keywords.h"
#include "pointers.h"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Index of a word in the last input line, for messages that point to it, or Error::NOPOINTER if it
/// is not of that line, as coefficients in data files and arguments of internal fixes are not.
int lsm_place(LAMMPS *, const char *word);

/// Reads the words after a style's name. Any error stops LAMMPS with one line.
class LSMKeywordReader : protected Pointers {
 public:
  /// \param style begins messages, such as "Fix lsm/leap"
  /// \param first index of the first word in arg
  LSMKeywordReader(LAMMPS *, const std::string &style, int first, int narg, char **arg);

  /// Advances to the next keyword. Returns false if there is none.
  bool next();
  const std::string &key() const { return key_; }
  /// Stops unless the keyword has this many values. Needed only for keywords not in a table.
  void need(int values);
  const char *text(int n = 1) const { return arg_[at_ + n]; }
  /// Reads the values if the keyword is in the table.
  bool read(const LSM::Keywords &);
  /// Reads all keywords, which have to be in the table.
  void read_all(const LSM::Keywords &);
  /// Whether a keyword was among those read so far.
  bool has(const std::string &key) const { return seen_.count(key) > 0; }
  /// Stops if one of these keywords is missing.
  void require(const std::vector<const char *> &keys) const;
  /// The last value of the keyword.
  double number(LSM::Must must) const { return number(must, used_ - 1); }

  /// Stops because of a value.
  /// \param expected what the value should be
  /// \param n index of the value, from 1
  [[noreturn]] void refuse(const std::string &expected, int n = 1) const;
  /// Stops because of the n-th value, or 0: the keyword.
  [[noreturn]] void stop(const std::string &message, int n = 0) const;
  [[noreturn]] void unknown(const LSM::Keywords &) const;

 private:
  const std::string style_;
  int at_, narg_;
  char **arg_;
  int used_ = 0;    // number of words of the keyword, including itself
  std::string key_;
  std::set<std::string> seen_;

  double number(LSM::Must, int n) const;
  std::string in_messages() const;    // the style, within a sentence
  /// Index in the input line of the keyword, or of its n-th value.
  int place(int n = 0) const;
  void take(double *, LSM::Must) const;
  void take(int *, LSM::Must) const;
  void take(std::uint64_t *, LSM::Must) const;
  void take(bool *, LSM::Must) const;
  void take(std::string *to, LSM::Must) const { *to = text(); }
  void take(const LSM::Words &, LSM::Must) const;
  void take(const LSM::Action &to, LSM::Must) const { to.take(); }
};

}    // namespace LAMMPS_NS

#endif
