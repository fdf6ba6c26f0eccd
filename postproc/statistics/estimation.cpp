// SPDX-License-Identifier: GPL-2.0-or-later
#include "estimation.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>

#include <algorithm>
#include <utility>

#include "gsl_owners.h"

namespace LSM::postproc {

double Covariance::error(const Numbers &gradient) const {
  double variance = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) variance += gradient[i] * gradient[j] * (*this)(i, j);
  return std::sqrt(std::max(0.0, variance));
}

Covariance covariance_of(const SymmetricMatrix &information) {
  Covariance inverse(information.n);
  inverse.entries = information.entries;
  gsl_matrix_view view = gsl_matrix_view_array(inverse.entries.data(), inverse.n, inverse.n);
  gsl_matrix *const m = &view.matrix;
  const Gsl<gsl_vector> scale = gsl_vector_of(inverse.n), work = gsl_vector_of(3 * inverse.n);
  double condition = 0.0;
  if (gsl_linalg_cholesky_decomp2(m, scale.get()) != GSL_SUCCESS ||
      gsl_linalg_cholesky_rcond(m, &condition, work.get()) != GSL_SUCCESS || !(condition > 1e-10) ||
      gsl_linalg_cholesky_invert(m) != GSL_SUCCESS)
    return {};
  gsl_matrix_scale_rows(m, scale.get());
  gsl_matrix_scale_columns(m, scale.get());
  return inverse;
}

Maximum maximise(const LikelihoodAt &likelihood, const Numbers &start) {
  constexpr double enough = 1e-20;
  Maximum best{start, likelihood(start)};
  double damping = 0.0;
  for (int i = 0; i < 500 && damping < 1e12 && std::isfinite(best.at.value); ++i) {
    SymmetricMatrix damped = best.at.information;
    for (std::size_t k = 0; k < damped.n; ++k) damped(k, k) += damping * std::fabs(damped(k, k));
    const Covariance inverse = covariance_of(damped);
    Numbers next = best.p;
    double gain = 0.0;
    for (std::size_t k = 0; k < inverse.n; ++k)
      for (std::size_t l = 0; l < inverse.n; ++l) {
        const double step = inverse(k, l) * best.at.score[l];
        next[k] += step;
        gain += best.at.score[k] * step;
      }
    Likelihood there = inverse.n > 0 ? likelihood(next) : Likelihood();
    // Near the maximum the gain is lost in rounding.
    if (there.value >= best.at.value - 1e-14 * (1.0 + std::fabs(best.at.value))) {
      best = {std::move(next), std::move(there), gain <= 1e-8};
      if (gain <= enough) break;
      damping = damping > 1e-3 ? 0.1 * damping : 0.0;
    } else {
      damping = std::max(1e-3, 10.0 * damping);
    }
  }
  return best;
}

}  // namespace LSM::postproc
