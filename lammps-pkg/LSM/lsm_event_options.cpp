/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "lsm_event_options.h"

#include "error.h"
#include "pointers.h"
#include "utils.h"

using namespace LAMMPS_NS;

/// A keyword and its values.
class LSMEventOptions::Reader : protected Pointers {
 public:
  std::string key;
  int used = 0;    // words taken, with the keyword

  Reader(LAMMPS *_lmp, int at, int narg, char **arg) :
      Pointers(_lmp), at_(at), narg_(narg), arg_(arg)
  {
  }

  bool next()
  {
    at_ += used;
    if (at_ >= narg_) return false;
    key = arg_[at_];
    need(1);
    used = 2;
    return true;
  }
  void need(int values)
  {
    if (at_ + values >= narg_)
      error->all(FLERR, "Compute lsm/events keyword {} needs {} value{}", key, values,
                 values > 1 ? "s" : "");
    used = values + 1;
  }
  const char *text(int n = 1) const { return arg_[at_ + n]; }
  double number() const { return utils::numeric(FLERR, text(), false, lmp); }
  double positive() const
  {
    const double value = number();
    if (!(value > 0.0)) refuse("> 0");
    return value;
  }
  double no_less_than_zero() const
  {
    const double value = number();
    if (!(value >= 0.0)) refuse(">= 0");
    return value;
  }
  double part() const
  {
    const double value = number();
    if (!(value >= 0.0 && value < 1.0)) refuse("at least 0 and less than 1");
    return value;
  }
  int count() const
  {
    const int value = utils::inumeric(FLERR, text(), false, lmp);
    if (value < 1) refuse("at least 1");
    return value;
  }
  bool yes() const { return utils::logical(FLERR, text(), false, lmp) != 0; }
  void refuse(const std::string &expected) const
  {
    error->all(FLERR, "Compute lsm/events {} is {}, but must be {}", key, text(), expected);
  }
  [[noreturn]] void unknown() const
  {
    error->all(
        FLERR,
        "Unknown compute lsm/events keyword '{}'; accepted are events, catalogue, series, "
        "stride, "
        "picker, lambda, memory, minsize, nonpositive, block, tangential, location, bin, "
        "fraction, history, slipping, driving, interval, gap, pause, modulus, quiet, unfinished, "
        "ledger, "
        "tolerance, strainlimit, check, emergency, resume, overwrite, progress and parameter",
        key);
  }
  /// 0 and 1 as the words for them, for one of two.
  bool is_first(const char *what, const char *first, const char *second, int n = 1) const
  {
    const std::string word = text(n);
    if (word != first && word != second)
      error->all(FLERR, "Compute lsm/events {} is '{}', but must be {} or {}", what, word, first,
                 second);
    return word == first;
  }
  [[noreturn]] void stop(const std::string &message) const
  {
    error->all(FLERR, "Compute lsm/events {}", message);
  }

 private:
  int at_, narg_;
  char **arg_;
};

/* ---------------------------------------------------------------------- */

LSMEventOptions::LSMEventOptions(LAMMPS *lmp, int first, int narg, char **arg)
{
  Reader in(lmp, first, narg, arg);
  std::string only_ruptures;
  while (in.next()) {
    if (read_ruptures(in))
      only_ruptures = in.key;
    else if (!read_events(in) && !read_files(in) && !read_run(in))
      in.unknown();
  }
  if (!only_ruptures.empty() && !events.ruptures)
    in.stop("keyword " + only_ruptures + " needs events ruptures");
  if (events.ruptures && events.location)
    in.stop("location yes needs events pe; ruptures have columns of their own");
}

/* ---------------------------------------------------------------------- */

bool LSMEventOptions::read_events(Reader &in)
{
  if (in.key == "events") {
    events.ruptures = !in.is_first("events", "pe", "ruptures");
  } else if (in.key == "picker") {
    if (!LSM::from_string(in.text(), events.picker.reading))
      in.stop(
          fmt::format("picker is '{}', but must be exponential, average or literal", in.text()));
  } else if (in.key == "lambda") {
    events.picker.lambda = in.part();
  } else if (in.key == "memory") {
    memory_time = in.positive();
  } else if (in.key == "minsize") {
    events.picker.min_size = in.no_less_than_zero();
  } else if (in.key == "nonpositive") {
    events.picker.keep_nonpositive = in.yes();
  } else if (in.key == "tangential") {
    events.tangential = in.yes();
  } else if (in.key == "location") {
    events.location = in.yes();
  } else if (in.key == "bin") {
    events.bin_width = in.positive();
  } else if (in.key == "fraction") {
    events.bin_fraction = in.part();
  } else
    return false;
  return true;
}

/* ----------------------------------------------------------------------
   what only ruptures have
------------------------------------------------------------------------- */

bool LSMEventOptions::read_ruptures(Reader &in)
{
  if (in.key == "history") {
    events.history_file = in.text();
  } else if (in.key == "slipping") {
    events.slipping = in.no_less_than_zero();
  } else if (in.key == "driving") {
    events.driving = in.positive();
  } else if (in.key == "interval") {
    events.interval = in.count();
  } else if (in.key == "gap") {
    const double value = in.no_less_than_zero();
    events.gap = static_cast<int>(MIN(value, 1e6));
    if (events.gap != value) in.refuse("a number of bins");
  } else if (in.key == "pause") {
    events.pause = in.no_less_than_zero();
  } else if (in.key == "modulus") {
    events.modulus = in.positive();
  } else if (in.key == "quiet") {
    events.quiet = in.count();
  } else if (in.key == "unfinished") {
    unfinished = in.yes();
  } else
    return false;
  return true;
}

/* ---------------------------------------------------------------------- */

bool LSMEventOptions::read_files(Reader &in)
{
  if (in.key == "catalogue") {
    events.catalogue_file = in.text();
  } else if (in.key == "series") {
    in.need(2);
    events.series_file = in.text();
    events.series_binary = in.is_first("series format", "binary", "text", 2);
  } else if (in.key == "stride") {
    events.series_stride = in.count();
  } else if (in.key == "resume") {
    events.resume = in.yes();
  } else if (in.key == "overwrite") {
    events.overwrite = in.yes();
  } else if (in.key == "parameter") {
    in.need(2);
    events.parameters.emplace_back(in.text(1), in.text(2));
  } else
    return false;
  return true;
}

/* ---------------------------------------------------------------------- */

bool LSMEventOptions::read_run(Reader &in)
{
  if (in.key == "block") {
    block = in.count();
  } else if (in.key == "ledger") {
    ledger = in.yes();
  } else if (in.key == "tolerance") {
    watchdog.tolerance = in.positive();
    ledger = true;
  } else if (in.key == "strainlimit") {
    watchdog.strain_limit = in.positive();
  } else if (in.key == "check") {
    watchdog.every = in.count();
  } else if (in.key == "emergency") {
    emergency_file = in.text();
    if (emergency_file.find_first_of("*%") != std::string::npos)
      in.refuse("the name of one file, without * and %");
  } else if (in.key == "progress") {
    progress = in.yes();
  } else
    return false;
  return true;
}
