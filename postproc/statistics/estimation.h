// SPDX-License-Identifier: GPL-2.0-or-later
/// \file estimation.h
/// What fits of several parameters have in common: errors from their information, least squares.
#ifndef LSM_POSTPROC_ESTIMATION_H
#define LSM_POSTPROC_ESTIMATION_H

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace LSM::postproc {

using Numbers = std::vector<double>;

/// A symmetric matrix of n parameters, row by row.
struct SymmetricMatrix {
  explicit SymmetricMatrix(std::size_t count = 0) : n(count), entries(count * count) {}
  double &operator()(std::size_t i, std::size_t j) { return entries[i * n + j]; }
  double operator()(std::size_t i, std::size_t j) const { return entries[i * n + j]; }

  std::size_t n;
  Numbers entries;
};

/// Of parameters; empty (n = 0) if the data do not determine them.
struct Covariance : SymmetricMatrix {
  using SymmetricMatrix::SymmetricMatrix;
  double error(std::size_t i) const { return std::sqrt((*this)(i, i)); }
  /// Of a function of the parameters with these derivatives.
  double error(const Numbers &gradient) const;
};

/// Inverse of an information matrix; empty if that is singular within rounding (reciprocal
/// condition number of at most 1e-10 after scaling).
Covariance covariance_of(const SymmetricMatrix &information);

/// Residual of datum i at p; slope: its derivatives.
using Residual = std::function<double(std::size_t i, const Numbers &p, Numbers &slope)>;

struct LeastSquares {
  Numbers p;
  Covariance covariance;  ///< from the curvature at p
  double chi2 = HUGE_VAL;
  bool converged = false;
};

/// Least sum of weighted squares that Levenberg and Marquardt's method reaches from several starts.
LeastSquares least_squares(const Numbers &weights, const std::vector<Numbers> &starts,
                           const Residual &residual);

}  // namespace LSM::postproc

#endif
