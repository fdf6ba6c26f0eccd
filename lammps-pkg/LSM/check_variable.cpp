// SPDX-License-Identifier: GPL-2.0-or-later

#include "check_variable.h"

#include "comm.h"
#include "error.h"
#include "info.h"
#include "input.h"
#include "variable.h"

#include "lsm_names.h"
#include "lsm_text_io.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

using namespace LAMMPS_NS;

// a name misspelt on the command line is a variable that nothing reads
void CheckVariable::warn_of_others(int narg, char **arg)
{
  if (comm->me != 0) return;
  // of another type in each version of LAMMPS
  int count = 0;
  const auto names = Info(lmp).get_variable_names(count);
  for (int n = 0; n < count; n++) {
    const std::string name = names[n];
    if (std::none_of(arg, arg + narg, [&name](const char *known) { return name == known; }))
      error->warning(FLERR, "Variable {} is not used by this script", name);
  }
}

// check_variable * among NAME ...
// check_variable NAME words WORD ... | above NUMBER | whole NUMBER | file
void CheckVariable::command(int narg, char **arg)
{
  const std::string kind = narg > 1 ? arg[1] : "";
  if (kind == "among" && strcmp(arg[0], "*") == 0) {
    warn_of_others(narg - 2, arg + 2);
    return;
  }
  const bool ranged = kind == "above" || kind == "whole";
  if (!(ranged && narg == 3) && !(kind == "words" && narg > 2) && !(kind == "file" && narg == 2))
    error->all(FLERR,
               "check_variable expects a name and 'words' with words, 'above' or 'whole' with a "
               "number, or 'file'; or * and 'among' with names");
  const char *const text = input->variable->retrieve(arg[0]);
  if (!text) error->all(FLERR, "check_variable: there is no variable {}", arg[0]);
  const std::string value = text;

  bool good = false;
  std::string expected;
  if (kind == "words") {
    const std::vector<std::string> words(arg + 2, arg + narg);
    good = std::find(words.begin(), words.end(), value) != words.end();
    expected = LSM::either(words);
  } else if (kind == "file") {
    good = !value.empty() && value.front() != '-' &&
           value.find_first_of(" \t\n\"'&#$*%") == std::string::npos;
    expected = "a file name without blanks, quotes, &, #, $, * and %, not beginning with - "
               "(./-name is accepted)";
  } else {
    const double least = utils::numeric(FLERR, arg[2], false, lmp);
    double number = 0.0;
    good = LSM::text_io::parse(value, number) &&
           (kind == "above" ? number > least : number >= least && number == std::floor(number));
    expected =
        (kind == "above" ? "a number above " : "a whole number of at least ") + std::string(arg[2]);
  }
  if (!good) error->all(FLERR, "Variable {} is '{}', but must be {}", arg[0], value, expected);
}
