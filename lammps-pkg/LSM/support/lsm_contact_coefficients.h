// SPDX-License-Identifier: GPL-2.0-or-later
// Coefficients of contacts whose particles have numbers of their own

#ifndef LMP_LSM_CONTACT_COEFFICIENTS_H
#define LMP_LSM_CONTACT_COEFFICIENTS_H

#include "lsm_law_table.h"
#include "lsm_type_pairs.h"
#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LSMContacts;

/// Where a coefficient of two types is a property of particles, a contact has the mean of the
/// numbers of its two particles. The coefficients of all pairs that may touch are kept by the place
/// of the pair, so that the loop over contacts reads them as it reads those of types. The numbers
/// of particles are those at the last build of the neighbor list, when ghosts receive theirs.
class LSMContactCoefficients : protected Pointers {
 public:
  LSMContactCoefficients(LAMMPS *_lmp, const LSMLawTable &_table) : Pointers(_lmp), table(_table) {}

  /// Before a run: whether a coefficient is a property. Stops LAMMPS if a property does not exist,
  /// or if a particle of types that are `on` has a number out of range.
  bool init(const LSMTypePairs<int> &on);
  /// Notes the numbers of all particles.
  void read();
  /// Brings the coefficients of all pairs up to date; checks numbers as init() does when they are
  /// read again.
  /// \param stiffness, retardation  of types
  void follow(const LSMContacts &, const LSMTypePairs<int> &on,
              const LSMTypePairs<double> &stiffness, const LSMTypePairs<double> &retardation);
  /// The coefficients of types have changed.
  void outdate() { known = 0; }
  /// The coefficients of a contact of two particles.
  std::vector<double> values(int i, int j) const;

  const LSMTypePairs<double> &stiffness() const { return k; }
  const LSMTypePairs<double> &retardation() const { return delay; }
  const LSMTypePairs<double> *coefficients() const { return coefficient; }

 private:
  const LSMLawTable &table;
  std::vector<std::vector<double>> numbers;    // by property, then by particle
  // by place of the pair
  LSMTypePairs<double> k, delay, coefficient[LSMLawTable::MAX_PARAMETERS];
  int known = 0;     // pairs that have theirs
  int begun = -1;    // see LSMContacts::begun()
  bigint build = -1;

  void check_properties(const LSMTypePairs<int> &on) const;
  void check_particles(const LSMTypePairs<int> &on) const;
  std::string complaint(int i, int itype, int jtype) const;
};

}    // namespace LAMMPS_NS

#endif
