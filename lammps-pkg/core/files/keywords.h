// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/keywords.h
/// Tables of the keywords of a style: where their values go and which values are allowed.
#ifndef LSM_KEYWORDS_H
#define LSM_KEYWORDS_H

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace LSM {

/// The allowed range of a number. `positive` means at least 1 for integers; `fraction` means at
/// least 0 and less than 1.
enum class Must { anything, positive, not_negative, fraction };

/// The value is one of the words in the list; its index is stored.
struct Words {
  int *place;
  std::vector<const char *> list;
};

/// A function that reads this many values itself.
struct Action {
  int values;
  std::function<void()> take;
};

struct Keyword {
  const char *name;
  std::variant<double *, int *, std::uint64_t *, bool *, std::string *, Words, Action> value;
  Must must = Must::anything;  ///< of each number
  double *second = nullptr;    ///< where a second value goes
};
using Keywords = std::vector<Keyword>;

}  // namespace LSM

#endif
