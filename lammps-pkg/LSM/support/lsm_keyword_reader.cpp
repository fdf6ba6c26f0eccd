// SPDX-License-Identifier: GPL-2.0-or-later

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
  used_ = 1;
  return true;
}

void LSMKeywordReader::need(int values)
{
  if (at_ + values >= narg_)
    error->all(FLERR, "{} keyword {} needs {}", style_, key_,
               values > 1 ? std::to_string(values) + " values" : "a value");
  used_ = values + 1;
}

bool LSMKeywordReader::read(const LSM::Keywords &table)
{
  for (const LSM::Keyword &keyword : table) {
    if (key_ != keyword.name) continue;
    if (auto flag = std::get_if<LSM::Flag>(&keyword.value)) {
      *flag->value = true;
      return true;
    }
    need(1);
    if (auto to = std::get_if<double *>(&keyword.value))
      **to = number(keyword.must);
    else if (auto whole = std::get_if<int *>(&keyword.value))
      **whole = whole_number(keyword.must);
    else if (auto yes = std::get_if<bool *>(&keyword.value))
      **yes = utils::logical(FLERR, text(), false, lmp) != 0;
    else if (auto words = std::get_if<LSM::Words>(&keyword.value))
      *words->place = place_in(words->list);
    else
      *std::get<std::string *>(keyword.value) = text();
    return true;
  }
  return false;
}

double LSMKeywordReader::number(Must must) const
{
  const double value = utils::numeric(FLERR, text(used_ - 1), false, lmp);
  if (must == Must::positive && !(value > 0.0)) refuse("> 0");
  if (must == Must::not_negative && !(value >= 0.0)) refuse(">= 0");
  if (must == Must::part && !(value >= 0.0 && value < 1.0)) refuse("at least 0 and less than 1");
  return value;
}

int LSMKeywordReader::whole_number(Must must) const
{
  const double number = utils::numeric(FLERR, text(), false, lmp);
  const double least = must == Must::positive ? 1.0 : 0.0;
  if (!(number >= least) || number != std::floor(number) ||
      number > std::numeric_limits<int>::max())
    refuse(must == Must::positive ? "a whole number of at least 1"
                                  : "a whole number of at least 0");
  return static_cast<int>(number);
}

int LSMKeywordReader::place_in(const std::vector<const char *> &list) const
{
  std::string all;
  for (size_t n = 0; n < list.size(); n++) {
    if (list[n] == std::string(text())) return static_cast<int>(n);
    all += (n == 0 ? "" : n + 1 < list.size() ? ", " : " or ") + std::string(list[n]);
  }
  stop(key_ + " is '" + text() + "', but must be " + all);
}

void LSMKeywordReader::refuse(const std::string &expected) const
{
  stop(key_ + " is " + text(used_ - 1) + ", but must be " + expected);
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
