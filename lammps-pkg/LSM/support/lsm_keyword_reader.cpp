/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "lsm_keyword_reader.h"

#include "error.h"
#include "utils.h"

#include <cctype>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;
using LSM::Must;

LSMKeywordReader::LSMKeywordReader(LAMMPS *_lmp, const std::string &style, int first, int narg,
                                   char **arg) :
    Pointers(_lmp),
    style_(style), at_(first), narg_(narg), arg_(arg)
{
}

bool LSMKeywordReader::next()
{
  at_ += used_;
  if (at_ >= narg_) return false;
  key_ = arg_[at_];
  need(1);
  return true;
}

void LSMKeywordReader::need(int values)
{
  if (at_ + values >= narg_)
    error->all(FLERR, "{} keyword {} needs {}", style_, key_,
               values > 1 ? std::to_string(values) + " values" : "a value");
  used_ = values + 1;
}

/* ---------------------------------------------------------------------- */

bool LSMKeywordReader::read(const LSM::Keywords &table) const
{
  for (const LSM::Keyword &keyword : table) {
    if (key_ != keyword.name) continue;
    if (auto number = std::get_if<double *>(&keyword.value))
      read_number(**number, keyword.must);
    else if (auto whole = std::get_if<int *>(&keyword.value))
      read_whole(**whole, keyword.must);
    else if (auto yes = std::get_if<bool *>(&keyword.value))
      **yes = utils::logical(FLERR, text(), false, lmp) != 0;
    else
      *std::get<std::string *>(keyword.value) = text();
    return true;
  }
  return false;
}

void LSMKeywordReader::read_number(double &value, Must must) const
{
  value = utils::numeric(FLERR, text(), false, lmp);
  if (must == Must::positive && !(value > 0.0)) refuse("> 0");
  if (must == Must::not_negative && !(value >= 0.0)) refuse(">= 0");
  if (must == Must::part && !(value >= 0.0 && value < 1.0)) refuse("at least 0 and less than 1");
}

void LSMKeywordReader::read_whole(int &value, Must must) const
{
  const double number = utils::numeric(FLERR, text(), false, lmp);
  const double least = must == Must::positive ? 1.0 : 0.0;
  if (!(number >= least) || number != std::floor(number) ||
      number > std::numeric_limits<int>::max())
    refuse(must == Must::positive ? "a whole number of at least 1"
                                  : "a whole number of at least 0");
  value = static_cast<int>(number);
}

/* ---------------------------------------------------------------------- */

void LSMKeywordReader::refuse(const std::string &expected) const
{
  stop(key_ + " is " + text() + ", but must be " + expected);
}

void LSMKeywordReader::stop(const std::string &message) const
{
  error->all(FLERR, "{} {}", style_, message);
}

void LSMKeywordReader::unknown(const LSM::Keywords &table, const std::string &also) const
{
  std::string accepted = also;
  for (const LSM::Keyword &keyword : table)
    accepted += (accepted.empty() ? "" : ", ") + std::string(keyword.name);
  std::string style = style_;
  style[0] = static_cast<char>(std::tolower(style[0]));
  error->all(FLERR, "Unknown {} keyword '{}'; accepted are {}", style, key_, accepted);
}
