// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LSM_UNIT_EIGENVALUES_H
#define LSM_UNIT_EIGENVALUES_H

#include <cstddef>
#include <vector>

namespace unit {

using Matrix = std::vector<std::vector<double>>;

/// Whether a value is above all eigenvalues of a symmetric matrix: value - matrix has a Cholesky
/// factor.
inline bool above_all(Matrix a, double value) {
  for (std::size_t n = 0; n < a.size(); ++n) {
    for (double &x : a[n]) x = -x;
    a[n][n] += value;
  }
  for (std::size_t n = 0; n < a.size(); ++n) {
    if (!(a[n][n] > 0.0)) return false;
    for (std::size_t m = n + 1; m < a.size(); ++m) {
      if (a[n][m] == 0.0) continue;
      const double factor = a[n][m] / a[n][n];
      for (std::size_t k = m; k < a.size(); ++k) a[m][k] -= factor * a[n][k];
    }
  }
  return true;
}

}  // namespace unit

#endif
