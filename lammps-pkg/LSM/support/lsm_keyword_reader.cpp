// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_keyword_reader.h"

#include "error.h"
#include "files/names.h"
#include "input.h"
#include "utils.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;
using LSM::Must;

int LAMMPS_NS::lsm_place(LAMMPS *lmp, const char *word)
{
  const Input *const line = lmp->input;
  for (int i = 0; line && i < line->narg; i++)
    if (line->arg[i] == word) return i;
  return Error::NOPOINTER;
}

LSMKeywordReader::LSMKeywordReader(LAMMPS *_lmp, const std::string &style, int first, int narg,
                                   char **arg) :
    Pointers(_lmp),
    style_(style), at_(first), narg_(narg), arg_(arg)
{
}

std::string LSMKeywordReader::in_messages() const
{
  std::string style = style_;
  style[0] = static_cast<char>(std::tolower(style[0]));
  return style;
}

bool LSMKeywordReader::next()
{
  at_ += used_;
  if (at_ >= narg_) return false;
  key_ = arg_[at_];
  seen_.insert(key_);
  used_ = 1;
  return true;
}

void LSMKeywordReader::need(int values)
{
  if (at_ + values >= narg_)
    utils::missing_cmd_args(FLERR,
                            fmt::format("{} {} ({})", in_messages(), key_,
                                        values > 1 ? fmt::format("{} values", values) : "a value"),
                            error);
  used_ = values + 1;
}

bool LSMKeywordReader::read(const LSM::Keywords &table)
{
  for (const LSM::Keyword &keyword : table) {
    if (key_ != keyword.name) continue;
    const auto *const action = std::get_if<LSM::Action>(&keyword.value);
    need(action ? action->values : keyword.second ? 2 : 1);
    std::visit(
        [&](const auto &to) {
          take(to, keyword.must);
        },
        keyword.value);
    if (keyword.second) *keyword.second = number(keyword.must, 2);
    return true;
  }
  return false;
}

void LSMKeywordReader::read_all(const LSM::Keywords &table)
{
  while (next())
    if (!read(table)) unknown(table);
}

void LSMKeywordReader::require(const std::vector<const char *> &keys) const
{
  for (const char *key : keys)
    if (!has(key)) stop(std::string(key) + " is missing; needed are " + LSM::either(keys, " and "));
}

double LSMKeywordReader::number(Must must, int n) const
{
  if (!utils::is_double(text(n))) refuse("a number", n);
  const double value = utils::numeric(FLERR, text(n), false, lmp);
  if (must == Must::positive && !(value > 0.0)) refuse("> 0", n);
  if (must == Must::not_negative && !(value >= 0.0)) refuse(">= 0", n);
  if (must == Must::fraction && !(value >= 0.0 && value < 1.0))
    refuse("at least 0 and less than 1", n);
  return value;
}

void LSMKeywordReader::take(double *to, Must must) const
{
  *to = number(must, 1);
}

void LSMKeywordReader::take(int *to, Must must) const
{
  const int least = must == Must::positive ? 1 : 0;
  const double value = number(Must::anything, 1);
  if (!(value >= least) || value != std::floor(value) || value > std::numeric_limits<int>::max())
    refuse("a whole number of at least " + std::to_string(least));
  *to = static_cast<int>(value);
}

void LSMKeywordReader::take(std::uint64_t *to, Must must) const
{
  const bigint least = must == Must::positive ? 1 : 0;
  const bool whole = utils::is_integer(text());
  const bigint value = whole ? utils::bnumeric(FLERR, text(), false, lmp) : 0;
  if (!whole || value < least) refuse("a whole number of at least " + std::to_string(least));
  *to = static_cast<std::uint64_t>(value);
}

void LSMKeywordReader::take(bool *to, Must /*must*/) const
{
  // the same words as LAMMPS accepts, but the message names the keyword
  const std::string word = text();
  *to = word == "yes" || word == "on" || word == "true" || word == "1";
  if (!*to && word != "no" && word != "off" && word != "false" && word != "0")
    stop(key_ + " is '" + word + "', but must be yes or no", 1);
}

void LSMKeywordReader::take(const LSM::Words &to, Must /*must*/) const
{
  const auto at = std::find(to.list.begin(), to.list.end(), std::string(text()));
  if (at == to.list.end())
    stop(key_ + " is '" + text() + "', but must be " + LSM::either(to.list), 1);
  *to.place = static_cast<int>(at - to.list.begin());
}

void LSMKeywordReader::refuse(const std::string &expected, int n) const
{
  const std::string which = used_ > 2 ? " value " + std::to_string(n) : "";
  stop(key_ + which + " is " + text(n) + ", but must be " + expected, n);
}

int LSMKeywordReader::place(int n) const
{
  return at_ + n < narg_ ? lsm_place(lmp, arg_[at_ + n]) : static_cast<int>(Error::NOPOINTER);
}

void LSMKeywordReader::stop(const std::string &message, int n) const
{
  error->all(FLERR, place(n), "{} {}", style_, message);
}

void LSMKeywordReader::unknown(const LSM::Keywords &table) const
{
  std::vector<std::string> accepted;
  for (const LSM::Keyword &keyword : table) accepted.emplace_back(keyword.name);
  error->all(FLERR, place(), "Unknown {} keyword '{}'; accepted are {}", in_messages(), key_,
             utils::join_words(accepted, ", "));
}
