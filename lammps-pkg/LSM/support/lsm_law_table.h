// SPDX-License-Identifier: GPL-2.0-or-later
// The friction laws at run time, and the coefficients of one of them for
// each pair of particle types

#ifndef LMP_LSM_LAW_TABLE_H
#define LMP_LSM_LAW_TABLE_H

#include "friction/friction_law.h"
#include "lsm_type_pairs.h"
#include "pointers.h"

#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LSMRestartFile;

/// A friction law at run time. Each line of the list in core/friction/friction_laws.h makes one.
struct LSMLaw {
  const char *name;
  const LSM::Parameter *parameters;
  int count;
  int state_size;
  bool needs_time;
  bool named;
  bool (*fits)(const double *);
  void (*begin)(const double *, double *);
};

class LSMLawTable : protected Pointers {
 public:
  /// All laws, in the order of the list.
  static const std::vector<LSMLaw> &all();
  /// The first law of a name, or null.
  static const LSMLaw *find(const std::string &name);
  static std::string names();

  LSMLawTable(LAMMPS *_lmp) : Pointers(_lmp), law(&all()[0]) {}
  const LSMLaw *law;    ///< the first one of the name that was chosen

  void create();    ///< as many types as there are now
  const LSMTypePairs<double> &operator[](int p) const { return coefficient[p]; }
  static constexpr int MAX_PARAMETERS = 8;
  std::vector<double> values(int i, int j) const;
  /// Whether the law supports the coefficients of two types, whatever particles have.
  bool fits(const LSMLaw &, int i, int j) const;
  /// Properties of particles in place of numbers, such as "d_mu", in the order of their numbers.
  const std::vector<std::string> &properties() const { return properties_; }
  /// The number of the property that is a coefficient of two types, -1 if there is none.
  int property(int p, int i, int j) const { return by_particle[p][i][j] - 1; }
  bool has_property(int i, int j) const;
  /// The coefficient of a name, except one that follows another; null if there is none.
  double **find_coefficient(const char *name);

  /// The words that pair_coeff expects after the types, for messages.
  std::string expected() const;
  /// Parses the words of pair_coeff after the types and the stiffness. Errors stop LAMMPS with one
  /// line.
  void parse(int narg, char **arg);
  /// Sets the parsed coefficients for two types.
  void set(int i, int j);
  /// Copies the coefficients of types i and j to j and i, and updates those that follow others, as
  /// fix adapt may have changed coefficients.
  void mirror(int i, int j);
  /// What is wrong with values that are out of range, or "".
  /// \param where follows the names of coefficients
  /// \param skip  some of the values are not known, as particles have them
  std::string complaint(const std::vector<double> &, const std::string &where,
                        bool skip = false) const;
  /// Stops LAMMPS if a value of two types is out of range.
  void check(int i, int j) const;

  void keep(LSMRestartFile &, int i, int j);
  void print(FILE *, int i, int j) const;

 private:
  LSMTypePairs<double> coefficient[MAX_PARAMETERS];    // by parameter of the law, then by types
  LSMTypePairs<int>
      given[MAX_PARAMETERS];    // 1 if the parameter was given, else it has another's value
  // number of the property that particles have in its place, from 1 on, or 0; such a coefficient is
  // BY_PARTICLE, which nobody gives
  LSMTypePairs<int> by_particle[MAX_PARAMETERS];
  static constexpr double BY_PARTICLE = -std::numeric_limits<double>::max();
  std::vector<std::string> properties_;
  std::vector<double> parsed;
  std::vector<int> parsed_property;
  std::vector<bool> parsed_given;

  int find_property(const std::string &name);
  void check_range(const std::vector<double> &, const std::string &where) const;
  bool optional(int p) const { return law->parameters[p].otherwise != LSM::Parameter::required; }
};

}    // namespace LAMMPS_NS

#endif
