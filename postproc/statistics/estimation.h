// SPDX-License-Identifier: GPL-2.0-or-later
/// \file estimation.h
/// Common parts of fits with several parameters: standard errors from the information matrix, and
/// least squares.
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

/// Residual of datum i at the parameters p; its derivatives are written to slope.
using Residual = std::function<double(std::size_t i, const Numbers &p, Numbers &slope)>;

/// Result of least_squares(); p is empty if no start led to finite residuals.
struct LeastSquares {
  Numbers p;
  Covariance covariance;  ///< from the curvature of chi square at p
  double chi2 = HUGE_VAL;
  bool converged = false;
};

/// Minimises the weighted sum of squared residuals by the Levenberg-Marquardt method.
/// \param weights one for each datum
/// \param starts initial parameters to try, at least one
/// \return the best minimum that was reached from any start
LeastSquares least_squares(const Numbers &weights, const std::vector<Numbers> &starts,
                           const Residual &residual);

}  // namespace LSM::postproc

#endif
