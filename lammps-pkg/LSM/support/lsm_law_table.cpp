// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_law_table.h"

#include "atom.h"
#include "error.h"
#include "lsm_restart_file.h"

#include "friction/friction_laws.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <limits>

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
    by_particle[p].create(atom->ntypes + 1);
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
  parsed_property.assign(law->count, 0);
  for (int iarg = 1, p = 1; iarg < narg; iarg += each, p++) {
    if (law->named) {
      for (p = 1; p < law->count && strcmp(arg[iarg], law->parameters[p].name) != 0; p++) {}
      if (p == law->count || parsed_given[p])
        refuse(fmt::format(", got {}'{}'", p == law->count ? "" : "a second ", arg[iarg]));
    }
    const std::string value = arg[iarg + each - 1];
    if (value.substr(0, 2) == "d_") {
      parsed_property[p] = find_property(value);
      parsed[p] = BY_PARTICLE;
    } else
      parsed[p] = utils::numeric(FLERR, value, false, lmp);
    parsed_given[p] = true;
  }
  for (int p = 1; p < law->count; p++) {
    if (parsed_given[p]) continue;
    const Parameter &one = law->parameters[p];
    if (!optional(p)) refuse(std::string(", but ") + one.name + " is missing");
    const bool follows = one.otherwise == Parameter::as_least;
    parsed[p] = follows ? parsed[one.least] : one.otherwise;
    if (follows) parsed_property[p] = parsed_property[one.least];
  }
  check_range(parsed, "");
}

void LSMLawTable::set(int i, int j)
{
  for (int p = 0; p < law->count; p++) {
    coefficient[p][i][j] = parsed[p];
    given[p][i][j] = parsed_given[p];
    by_particle[p][i][j] = parsed_property[p];
  }
}

void LSMLawTable::mirror(int i, int j)
{
  for (int p = 0; p < law->count; p++) {
    const Parameter &one = law->parameters[p];
    if (!given[p][i][j] && one.otherwise == Parameter::as_least)
      coefficient[p][i][j] = coefficient[one.least][i][j];
    coefficient[p][j][i] = coefficient[p][i][j];
    by_particle[p][j][i] = by_particle[p][i][j];
  }
}

std::string LSMLawTable::complaint(const std::vector<double> &values, const std::string &where,
                                   bool skip) const
{
  const auto unknown = [&](int p) {
    return skip && values[p] == BY_PARTICLE;
  };
  for (int p = 0; p < law->count; p++) {
    if (unknown(p)) continue;
    const Parameter &one = law->parameters[p];
    const double value = values[p];
    const bool positive = one.range == Parameter::positive;
    if (!(value >= 0.0) || (positive && value == 0.0))
      return fmt::format("Pair lsm/friction {}{} is {}, but must be {} 0", one.name, where, value,
                         positive ? ">" : ">=");
    if (one.least >= 0 && !unknown(one.least) && value < values[one.least])
      return fmt::format("Pair lsm/friction {}{} is {}, but must be at least {} = {}", one.name,
                         where, value, law->parameters[one.least].name, values[one.least]);
  }
  return "";
}

void LSMLawTable::check_range(const std::vector<double> &values, const std::string &where) const
{
  const std::string wrong = complaint(values, where, true);
  if (!wrong.empty()) error->all(FLERR, wrong);
}

void LSMLawTable::check(int i, int j) const
{
  for (int p = 0; p < law->count; p++)
    if (by_particle[p][i][j] && coefficient[p][i][j] != BY_PARTICLE)
      error->all(FLERR,
                 "Pair lsm/friction {} of types {} {} is {}, a property of particles, which fix "
                 "adapt does not change; use the command set",
                 law->parameters[p].name, i, j, properties_[property(p, i, j)]);
  check_range(values(i, j), fmt::format(" of types {} {}", i, j));
}

bool LSMLawTable::has_property(int i, int j) const
{
  for (int p = 0; p < law->count; p++)
    if (by_particle[p][i][j]) return true;
  return false;
}

bool LSMLawTable::fits(const LSMLaw &which, int i, int j) const
{
  std::vector<double> all = values(i, j);
  for (int p = 0; p < law->count; p++)
    if (by_particle[p][i][j])
      all[p] = given[p][i][j] && law->parameters[p].least >= 0
          ? std::numeric_limits<double>::infinity()
          : 0.0;
  return which.fits(all.data());
}

// the number of a property, from 1 on
int LSMLawTable::find_property(const std::string &name)
{
  const auto before = std::find(properties_.begin(), properties_.end(), name) - properties_.begin();
  if (before == static_cast<std::ptrdiff_t>(properties_.size())) properties_.push_back(name);
  return static_cast<int>(before) + 1;
}

void LSMLawTable::keep(LSMRestartFile &file, int i, int j)
{
  for (int p = 0; p < law->count; p++) {
    double &value = coefficient[p][i][j];
    file(value);
    const int least = law->parameters[p].least;
    if (file.reads) given[p][i][j] = least < 0 || value > coefficient[least][i][j];
    if (value != BY_PARTICLE) continue;
    int &property = by_particle[p][i][j];
    std::string name = file.reads ? "" : properties_[property - 1];
    file.list(name);
    if (!file.reads) continue;
    property = find_property(name);
    if (least >= 0) given[p][i][j] = property != by_particle[least][i][j];
  }
}

void LSMLawTable::print(FILE *fp, int i, int j) const
{
  for (int p = 0; p < law->count; p++) {
    // a coefficient that follows another has to go on following it when it is read again
    if (law->parameters[p].otherwise == LSM::Parameter::as_least && !given[p][i][j]) continue;
    if (p > 0 && law->named) fprintf(fp, " %s", law->parameters[p].name);
    if (by_particle[p][i][j])
      fprintf(fp, " %s", properties_[property(p, i, j)].c_str());
    else
      fprintf(fp, " %.17g", coefficient[p][i][j]);
  }
}
