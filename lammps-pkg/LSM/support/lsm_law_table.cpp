// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_law_table.h"

#include "atom.h"
#include "error.h"
#include "lsm_restart_file.h"

#include "friction/friction_laws.h"

#include <cstring>
#include <iterator>

using namespace LAMMPS_NS;
using LSM::Parameter;

template <class Law> static auto from(const double *values)
{
  static_assert(std::size(Law::parameters) <= LSMLawTable::MAX_PARAMETERS, "there is no room");
  return LSM::coefficients_of<Law>([values](std::size_t n) {
    return values[n];
  });
}

template <class Law> static LSMLaw entry()
{
  return {Law::name,
          Law::parameters,
          static_cast<int>(std::size(Law::parameters)),
          Law::state_size,
          Law::needs_time,
          Law::named,
          [](const double *values) {
            return Law::fits(from<Law>(values));
          },
          [](const double *values, double *state) {
            Law::begin(from<Law>(values), state);
          }};
}

const std::vector<LSMLaw> &LSMLawTable::all()
{
  static const std::vector<LSMLaw> laws = {
#define LSM_FRICTION_LAW(law) entry<LSM::law>(),
#include "friction/friction_laws.h"
#undef LSM_FRICTION_LAW
  };
  return laws;
}

const LSMLaw *LSMLawTable::find(const std::string &name)
{
  for (const LSMLaw &one : all())
    if (name == one.name) return &one;
  return nullptr;
}

std::string LSMLawTable::names()
{
  std::string text;
  for (const LSMLaw &one : all())
    if (find(one.name) == &one) text += (text.empty() ? "" : ", ") + std::string(one.name);
  return text;
}

void LSMLawTable::create()
{
  for (int p = 0; p < law->count; p++) {
    coefficient[p].create(atom->ntypes + 1);
    given[p].create(atom->ntypes + 1);
  }
}

std::vector<double> LSMLawTable::values(int i, int j) const
{
  std::vector<double> all;
  for (int p = 0; p < law->count; p++) all.push_back(coefficient[p][i][j]);
  return all;
}

double **LSMLawTable::find_coefficient(const char *name)
{
  for (int p = 0; p < law->count; p++)
    if (strcmp(name, law->parameters[p].name) == 0 &&
        law->parameters[p].otherwise != Parameter::as_least)
      return coefficient[p].data();
  return nullptr;
}

// 'k kt mu [mu_static]', or 'k kt mu VALUE ... [theta VALUE]'
std::string LSMLawTable::expected() const
{
  std::string text = "k kt";
  for (int p = 1; p < law->count; p++) {
    const std::string words = law->parameters[p].name + std::string(law->named ? " VALUE" : "");
    text += optional(p) ? " [" + words + "]" : " " + words;
  }
  return text;
}

void LSMLawTable::parse(int narg, char **arg)
{
  const auto refuse = [this](const std::string &what) {
    error->all(FLERR, "Pair style lsm/friction {}expects 'pair_coeff I J {} [kelvin-voigt TIME]'{}",
               law->named ? law->name + std::string(" ") : "", expected(), what);
  };
  const int each = law->named ? 2 : 1;
  if (narg < 1 || narg > 1 + each * (law->count - 1) || (narg - 1) % each)
    refuse(" or 'pair_coeff I J off'");
  parsed.assign(law->count, utils::numeric(FLERR, arg[0], false, lmp));
  parsed_given.assign(law->count, false);
  parsed_given[0] = true;
  for (int iarg = 1, p = 1; iarg < narg; iarg += each, p++) {
    if (law->named) {
      for (p = 1; p < law->count && strcmp(arg[iarg], law->parameters[p].name) != 0; p++) {}
      if (p == law->count || parsed_given[p])
        refuse(fmt::format(", got {}'{}'", p == law->count ? "" : "a second ", arg[iarg]));
    }
    parsed[p] = utils::numeric(FLERR, arg[iarg + each - 1], false, lmp);
    parsed_given[p] = true;
  }
  for (int p = 1; p < law->count; p++) {
    if (parsed_given[p]) continue;
    const Parameter &one = law->parameters[p];
    if (!optional(p)) refuse(std::string(", but ") + one.name + " is missing");
    parsed[p] = one.otherwise == Parameter::as_least ? parsed[one.least] : one.otherwise;
  }
  check(parsed, "");
}

void LSMLawTable::set(int i, int j)
{
  for (int p = 0; p < law->count; p++) {
    coefficient[p][i][j] = parsed[p];
    given[p][i][j] = parsed_given[p];
  }
}

void LSMLawTable::mirror(int i, int j)
{
  for (int p = 0; p < law->count; p++) {
    const Parameter &one = law->parameters[p];
    if (!given[p][i][j] && one.otherwise == Parameter::as_least)
      coefficient[p][i][j] = coefficient[one.least][i][j];
    coefficient[p][j][i] = coefficient[p][i][j];
  }
}

void LSMLawTable::check(const std::vector<double> &values, const std::string &where) const
{
  for (int p = 0; p < law->count; p++) {
    const Parameter &one = law->parameters[p];
    const double value = values[p];
    const bool positive = one.range == Parameter::positive;
    if (!(value >= 0.0) || (positive && value == 0.0))
      error->all(FLERR, "Pair lsm/friction {}{} is {}, but must be {} 0", one.name, where, value,
                 positive ? ">" : ">=");
    if (one.least >= 0 && value < values[one.least])
      error->all(FLERR, "Pair lsm/friction {}{} is {}, but must be at least {} = {}", one.name,
                 where, value, law->parameters[one.least].name, values[one.least]);
  }
}

void LSMLawTable::keep(LSMRestartFile &file, int i, int j)
{
  for (int p = 0; p < law->count; p++) {
    double &value = coefficient[p][i][j];
    file(value);
    const int least = law->parameters[p].least;
    if (file.reads) given[p][i][j] = least < 0 || value > coefficient[least][i][j];
  }
}

void LSMLawTable::print(FILE *fp, int i, int j) const
{
  for (int p = 0; p < law->count; p++) {
    // a coefficient that follows another has to go on following it when it is read again
    if (law->parameters[p].otherwise == LSM::Parameter::as_least && !given[p][i][j]) continue;
    if (p > 0 && law->named) fprintf(fp, " %s", law->parameters[p].name);
    fprintf(fp, " %.17g", coefficient[p][i][j]);
  }
}
