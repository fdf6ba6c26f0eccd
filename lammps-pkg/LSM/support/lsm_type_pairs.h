// SPDX-License-Identifier: GPL-2.0-or-later
// Coefficients of pairs of particle types

#ifndef LMP_LSM_TYPE_PAIRS_H
#define LMP_LSM_TYPE_PAIRS_H

#include <vector>

namespace LAMMPS_NS {

/// A value for each pair of types, in the form that LAMMPS expects.
template <class Value> class LSMTypePairs {
 public:
  /// Zeros for types below n.
  void create(int n)
  {
    values_.assign(n * n, Value{});
    rows_.resize(n);
    for (int i = 0; i < n; i++) rows_[i] = &values_[i * n];
  }
  Value *operator[](int i) const { return rows_[i]; }
  /// The same by its place, which is that of all values of as many types.
  int place(int i, int j) const { return static_cast<int>(i * rows_.size()) + j; }
  const Value &at(int place) const { return values_[place]; }
  Value **data() { return rows_.data(); }
  /// The same without types, as a list of values by their place.
  void clear()
  {
    rows_.clear();
    values_.clear();
  }
  void add(const Value &value) { values_.push_back(value); }

 private:
  std::vector<Value> values_;
  std::vector<Value *> rows_;
};

}    // namespace LAMMPS_NS

#endif
