// SPDX-License-Identifier: GPL-2.0-or-later
/// \file estimation.h
/// Maximum likelihood: what all fits with several parameters share.
#ifndef LSM_POSTPROC_ESTIMATION_H
#define LSM_POSTPROC_ESTIMATION_H

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace LSM::postproc {

using Numbers = std::vector<double>;

/// Symmetric matrix of n parameters, stored row by row.
struct SymmetricMatrix {
  explicit SymmetricMatrix(std::size_t count = 0) : n(count), entries(count * count) {}
  double &operator()(std::size_t i, std::size_t j) { return entries[i * n + j]; }
  double operator()(std::size_t i, std::size_t j) const { return entries[i * n + j]; }
  /// Sets two entries that are equal.
  void set(std::size_t i, std::size_t j, double value) { (*this)(i, j) = (*this)(j, i) = value; }

  std::size_t n;
  Numbers entries;
};

/// Covariance matrix of parameters; empty (n = 0) if the data do not determine them.
struct Covariance : SymmetricMatrix {
  using SymmetricMatrix::SymmetricMatrix;
  /// Standard error of parameter i.
  double error(std::size_t i) const { return std::sqrt((*this)(i, i)); }
  /// Standard error of a function of the parameters with this gradient.
  double error(const Numbers &gradient) const;
};

/// Inverts an information matrix.
/// \return an empty matrix if the information is singular within rounding (reciprocal condition
/// number of at most 1e-10 after scaling)
Covariance covariance_of(const SymmetricMatrix &information);

/// Logarithm of a likelihood at some parameters, its gradient, and minus its second derivatives (or
/// their mean). Without a finite value the others may be left out.
struct Likelihood {
  double value = -HUGE_VAL;
  Numbers score = {};
  SymmetricMatrix information = SymmetricMatrix();
};
using LikelihoodAt = std::function<Likelihood(const Numbers &p)>;

/// Result of maximise().
struct Maximum {
  Numbers p;
  Likelihood at;
  bool converged = false;  ///< whether the last step gained at most 1e-8
};

/// Newton's method (with the mean information: Fisher's method of scoring), damped as by Levenberg
/// and Marquardt wherever the likelihood would not increase.
Maximum maximise(const LikelihoodAt &likelihood, const Numbers &start);

}  // namespace LSM::postproc

#endif
