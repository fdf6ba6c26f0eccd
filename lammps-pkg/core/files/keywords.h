// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/keywords.h
/// Keywords of an input in a table: where their values go and what they must be.
#ifndef LSM_KEYWORDS_H
#define LSM_KEYWORDS_H

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace LSM {

/// What a number must be; positive: of whole numbers at least 1; fraction: at least 0 and less
/// than 1.
enum class Must { anything, positive, not_negative, fraction };

/// The value is one of some words, whose place in the list is taken.
struct Words {
  int *place;
  std::vector<const char *> list;
};

/// What is done with so many values.
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
