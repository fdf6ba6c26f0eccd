// SPDX-License-Identifier: GPL-2.0-or-later
#include "estimation.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>

#include "gsl_owners.h"

namespace LSM::postproc {

namespace {

Numbers numbers_of(const gsl_vector *x) { return {x->data, x->data + x->size}; }

int residuals(const gsl_vector *x, void *residual, gsl_vector *f) {
  const Numbers p = numbers_of(x);
  Numbers slope(p.size());
  for (std::size_t i = 0; i < f->size; ++i) {
    const double value = (*static_cast<const Residual *>(residual))(i, p, slope);
    if (!std::isfinite(value)) return GSL_EDOM;
    gsl_vector_set(f, i, value);
  }
  return GSL_SUCCESS;
}

int jacobian(const gsl_vector *x, void *residual, gsl_matrix *j) {
  const Numbers p = numbers_of(x);
  Numbers slope(p.size());
  for (std::size_t i = 0; i < j->size1; ++i) {
    (*static_cast<const Residual *>(residual))(i, p, slope);
    for (std::size_t k = 0; k < p.size(); ++k) {
      if (!std::isfinite(slope[k])) return GSL_EDOM;
      gsl_matrix_set(j, i, k, slope[k]);
    }
  }
  return GSL_SUCCESS;
}

}  // namespace

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

LeastSquares least_squares(const Numbers &weights, const std::vector<Numbers> &starts,
                           const Residual &residual) {
  const std::size_t n = weights.size(), count = starts.front().size();
  gsl_multifit_nlinear_fdf functions{};
  functions.f = residuals;
  functions.df = jacobian;
  functions.n = n;
  functions.p = count;
  functions.params = const_cast<Residual *>(&residual);
  const gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  const Gsl<gsl_multifit_nlinear_workspace> work(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, n, count),
      gsl_multifit_nlinear_free);
  const gsl_vector_const_view w = gsl_vector_const_view_array(weights.data(), n);
  LeastSquares best;
  for (const Numbers &start : starts) {
    const gsl_vector_const_view first = gsl_vector_const_view_array(start.data(), count);
    if (gsl_multifit_nlinear_winit(&first.vector, &w.vector, &functions, work.get()) != GSL_SUCCESS)
      continue;
    int info = 0;
    const int status =
        gsl_multifit_nlinear_driver(500, 1e-10, 1e-10, 0.0, nullptr, nullptr, &info, work.get());
    const gsl_vector *const f = gsl_multifit_nlinear_residual(work.get());
    double chi2 = HUGE_VAL;
    gsl_blas_ddot(f, f, &chi2);
    if (!(chi2 < best.chi2)) continue;
    best.chi2 = chi2;
    best.p = numbers_of(gsl_multifit_nlinear_position(work.get()));
    // GSL_ENOPROG: rounding prevents a further decrease, so this is the minimum.
    best.converged = status == GSL_SUCCESS || status == GSL_ENOPROG;
    const gsl_matrix *const j = gsl_multifit_nlinear_jac(work.get());
    SymmetricMatrix information(count);
    gsl_matrix_view square = gsl_matrix_view_array(information.entries.data(), count, count);
    gsl_blas_dgemm(CblasTrans, CblasNoTrans, 1.0, j, j, 0.0, &square.matrix);
    best.covariance = covariance_of(information);
  }
  return best;
}

}  // namespace LSM::postproc
