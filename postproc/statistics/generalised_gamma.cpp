// SPDX-License-Identifier: GPL-2.0-or-later
#include "generalised_gamma.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_sf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "cells.h"
#include "ks_distance.h"
#include "lsm_sum.h"
#include "lsm_text_io.h"
#include "replicas.h"
#include "truncated_family.h"

namespace LSM::postproc {

namespace {

using text_io::number;

// Inside, theta is measured in units of a reference (v = ln theta - reference) and the parameters
// are gamma, ln delta and v0 = ln(B^(1/delta)) - reference: ln f = ln C + (gamma - 1) v - s with
// s = exp(delta (v - v0)). Judged in these, a fit is degenerate or not whatever the unit of time.
enum Parameter { log_c, shape, log_delta, scale, parameters };
using Vector = std::array<double, parameters>;
using Matrix = std::array<Vector, parameters>;
using Mask = std::array<bool, parameters>;

constexpr double delta_min = 0.1, delta_max = 10.0;

const char *const no_fall_off =
    "no exponential fall-off in the data: no better than a pure power law";

// What the fall-off has to gain over a pure power law in 2 ln L or chi square: the 95 % point of
// chi square with as many degrees of freedom as it has parameters (B and delta, or B alone).
double least_gain(bool delta_fixed) { return delta_fixed ? 3.84 : 5.99; }

// Reason why delta is not inside its interval, or "".
std::string outside(double delta) {
  if (delta <= delta_min * (1.0 + 1e-9))
    return "delta runs below 0.1, towards a log-normal density";
  if (delta >= delta_max * (1.0 - 1e-9))
    return "delta runs above 10, towards a power law with a sharp end";
  return {};
}

// Inverse of the information of the free parameters; false if it is singular within rounding.
bool invert(const Matrix &information, const Mask &free, Matrix &covariance) {
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < parameters; ++i)
    if (free[i]) index.push_back(i);
  const std::size_t n = index.size();
  const Gsl<gsl_matrix> scaled(gsl_matrix_alloc(n, n), gsl_matrix_free),
      copy(gsl_matrix_alloc(n, n), gsl_matrix_free);
  const auto root = [&](std::size_t i) { return std::sqrt(information[index[i]][index[i]]); };
  for (std::size_t i = 0; i < n; ++i) {
    if (!(root(i) > 0.0 && std::isfinite(root(i)))) return false;
    for (std::size_t j = 0; j < n; ++j)
      gsl_matrix_set(scaled.get(), i, j, information[index[i]][index[j]] / (root(i) * root(j)));
  }
  gsl_matrix_memcpy(copy.get(), scaled.get());
  const Gsl<gsl_vector> eigenvalues = gsl_vector_of(n);
  const Gsl<gsl_eigen_symm_workspace> work(gsl_eigen_symm_alloc(n), gsl_eigen_symm_free);
  gsl_eigen_symm(copy.get(), eigenvalues.get(), work.get());
  const double smallest = gsl_vector_min(eigenvalues.get());
  if (!(smallest > 1e-10 * gsl_vector_max(eigenvalues.get()))) return false;
  gsl_linalg_cholesky_decomp1(scaled.get());
  gsl_linalg_cholesky_invert(scaled.get());
  covariance = {};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      covariance[index[i]][index[j]] = gsl_matrix_get(scaled.get(), i, j) / (root(i) * root(j));
  return true;
}

double error_of(const Vector &slope, const Matrix &covariance) {
  double variance = 0.0;
  for (std::size_t i = 0; i < parameters; ++i)
    for (std::size_t j = 0; j < parameters; ++j) variance += slope[i] * slope[j] * covariance[i][j];
  return std::sqrt(std::max(0.0, variance));
}

// Derivatives of ln B = delta (v0 + reference).
Vector slope_of_log_b(const Vector &p, double reference) {
  const double delta = std::exp(p[log_delta]);
  return {0.0, 0.0, delta * (p[scale] + reference), delta};
}

// Reason why the parameters are not determined by the data, or "".
std::string ridge(const Vector &p, const Matrix &covariance, double reference) {
  const auto trade = [](const char *name, double error) {
    return fmt::format("the parameters trade against each other: standard error of {} is {:.2g}",
                       name, error);
  };
  const double gamma_error = std::sqrt(covariance[shape][shape]);
  const double delta_error = std::sqrt(covariance[log_delta][log_delta]);
  if (!(gamma_error <= 0.25 * std::max(1.0, std::fabs(p[shape]))))
    return trade("gamma", gamma_error);
  if (!(delta_error <= 0.25)) return trade("ln delta", delta_error);
  const double error = error_of(slope_of_log_b(p, reference), covariance);
  if (!(error <= 1.0)) return trade("ln B in this unit of time", error);
  return {};
}

// Parameters and errors in the unit of the data. slope_c: derivatives of ln C.
void report(const Vector &p, const Vector &slope_c, const Matrix &covariance, double reference,
            GeneralisedGammaFit &fit) {
  fit.degenerate = false;
  fit.gamma = p[shape];
  fit.delta = std::exp(p[log_delta]);
  fit.B = std::exp(fit.delta * (p[scale] + reference));
  fit.C = std::exp(p[log_c]);
  fit.se_gamma = std::sqrt(covariance[shape][shape]);
  fit.se_delta = fit.delta * std::sqrt(covariance[log_delta][log_delta]);
  fit.se_B = fit.B * error_of(slope_of_log_b(p, reference), covariance);
  fit.se_C = fit.C * error_of(slope_c, covariance);
}

void check_options(const GeneralisedGammaOptions &options) {
  const double delta = options.fix_delta;
  if (!std::isnan(delta) && !(delta >= delta_min && delta <= delta_max))
    throw std::invalid_argument("generalised gamma: delta fixed at " + number(delta) +
                                ", expected a number between 0.1 and 10");
  if (options.min_count < 1)
    throw std::invalid_argument("generalised gamma: minimum count " + number(options.min_count) +
                                ", expected at least 1");
}

// ---- maximum likelihood

struct Profile {
  double delta = 1.0, gamma = 0.0, v0 = 0.0;
  double log_likelihood = -HUGE_VAL;  // per value, density in v
  bool border = false;                // best without any fall-off
};

// What is left of a law beyond v, without its constant. s = exp(delta (v - v0)) beyond 700
// underflows.
double tail(double k, double s) {
  if (s > 700.0) return 0.0;
  return k > 0.0 ? gsl_sf_gamma_inc_Q(k, s) : gsl_sf_gamma_inc(k, s);
}

// Kolmogorov-Smirnov distance of points to the law.
template <class Points>
double distance(const Points &points, double lower, double gamma, double delta, double v0) {
  if (std::isinf(v0)) {  // the power law at the border
    const auto cdf = [&](double v) { return -std::expm1(gamma * (v - lower)); };
    return KsDistance(points, cdf)();
  }
  const double k = gamma / delta;
  const auto survival = [&](double v) { return tail(k, std::exp(delta * (v - v0))); };
  const double all = std::isfinite(lower) ? survival(lower) : 1.0;
  return KsDistance(points, [&](double v) { return 1.0 - survival(v) / all; })();
}

// Sample of logarithms; profile(delta) has the best gamma and scale for a given delta.
class Likelihood {
 public:
  Likelihood(std::vector<double> v, double lower)
      : v_(std::move(v)), lower_(lower), n_(static_cast<double>(v_.size())) {
    mean_v_ = mean([](double v_i) { return v_i; });
  }
  // By cells.
  Likelihood(const std::vector<double> &centres, const std::vector<double> &counts, double lower)
      : lower_(lower), n_(std::accumulate(counts.begin(), counts.end(), 0.0)) {
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (!(counts[i] > 0.0)) continue;
      v_.push_back(centres[i]);
      counts_.push_back(counts[i]);
    }
    mean_v_ = mean([](double v_i) { return v_i; });
  }

  template <class F>
  double mean(F f) const {
    NeumaierSum sum;
    if (counts_.empty())
      for (double v : v_) sum.add(f(v));
    else
      for (std::size_t i = 0; i < v_.size(); ++i) sum.add(counts_[i] * f(v_[i]));
    return sum.value() / n_;
  }
  double mean_v() const { return mean_v_; }
  bool truncated() const { return std::isfinite(lower_); }

  // Per value, of the power law that is left when the fall-off goes; needs the truncation.
  double power_law() const { return -std::log(mean_v_ - lower_) - 1.0; }

  Profile profile(double delta) const {
    Profile result;
    result.delta = delta;
    if (truncated()) {
      const double lower = lower_;
      const double mean_t = mean([&](double v) { return std::exp(delta * (v - lower)); });
      const TiltedFit fit = fit_tilted({delta}, mean_v_ - lower, mean_t, HUGE_VAL);
      result.border = fit.border;
      if (!fit.converged) return result;
      result.gamma = fit.b;
      result.v0 = fit.border ? HUGE_VAL : lower - std::log(fit.c) / delta;
      result.log_likelihood = fit.log_likelihood;
      return result;
    }
    // w = theta^delta has a gamma distribution of shape k = gamma / delta; ln k - psi(k) falls
    // from infinity to 0, so there is always one solution, found by Newton's method in ln k.
    const double mean_w = mean([&](double v) { return std::exp(delta * v); });
    const double target = std::log(mean_w) - delta * mean_v_;
    if (!(target > 1e-12)) return result;
    double k = 0.5 / target + 0.2;
    for (int i = 0; i < 100; ++i) {
      const double slope = 1.0 - k * gsl_sf_psi_1(k);
      const double step = (std::log(k) - gsl_sf_psi(k) - target) / slope;
      k *= std::exp(std::clamp(-step, -2.0, 2.0));
      if (std::fabs(step) < 1e-14) break;
    }
    const double log_b = std::log(mean_w / k);
    result.gamma = k * delta;
    result.v0 = log_b / delta;
    result.log_likelihood =
        std::log(delta) - k * log_b - gsl_sf_lngamma(k) + result.gamma * mean_v_ - k;
    return result;
  }

  // Best delta in (delta_min, delta_max): a coarse scan, since there may be several maxima, then
  // Brent's method around the best.
  Profile best() const {
    constexpr int steps = 20;
    const double first = std::log(delta_min), width = std::log(delta_max / delta_min) / steps;
    std::vector<Profile> scan;
    for (int i = 0; i <= steps; ++i) scan.push_back(profile(std::exp(first + i * width)));
    const auto top = std::max_element(scan.begin(), scan.end(), [](const auto &a, const auto &b) {
      return a.log_likelihood < b.log_likelihood;
    });
    const Profile result = *top;
    if (top == scan.begin() || top == scan.end() - 1 || result.border) return result;
    gsl_function function;
    function.params = const_cast<Likelihood *>(this);
    function.function = [](double x, void *self) {
      return -static_cast<const Likelihood *>(self)->profile(std::exp(x)).log_likelihood;
    };
    const Gsl<gsl_min_fminimizer> minimiser(gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent),
                                            gsl_min_fminimizer_free);
    const double x = std::log(result.delta);
    if (gsl_min_fminimizer_set_with_values(minimiser.get(), &function, x, -top->log_likelihood,
                                           x - width, -(top - 1)->log_likelihood, x + width,
                                           -(top + 1)->log_likelihood) != GSL_SUCCESS)
      return result;
    for (int i = 0; i < 50; ++i) {
      if (gsl_min_fminimizer_iterate(minimiser.get()) != GSL_SUCCESS) break;
      if (gsl_min_fminimizer_x_upper(minimiser.get()) -
              gsl_min_fminimizer_x_lower(minimiser.get()) <
          1e-7)
        break;
    }
    return profile(std::exp(gsl_min_fminimizer_x_minimum(minimiser.get())));
  }

  double lower() const { return lower_; }

  // With delta held at a value, or free (NaN).
  Profile best(double held) const { return std::isnan(held) ? best() : profile(held); }

  // Ascending, from here on.
  const std::vector<double> &sort() {
    std::sort(v_.begin(), v_.end());
    return v_;
  }

 private:
  std::vector<double> v_, counts_;  // no counts: one of each
  double lower_, n_, mean_v_ = 0.0;
};

// Derivatives of ln f at v without the constant: first in slope, second in curvature.
void derivatives(double v, double delta, double v0, Vector &slope, Matrix &curvature) {
  const double w = delta * (v - v0), s = std::exp(w);
  slope = {0.0, v, -s * w, delta * s};
  curvature = {};
  curvature[log_delta][log_delta] = -s * w * (1.0 + w);
  curvature[log_delta][scale] = curvature[scale][log_delta] = delta * s * (1.0 + w);
  curvature[scale][scale] = -delta * delta * s;
}

// Where next to nothing is left of a law cut off below s, in units in which B is 1.
double end_of(double s, double k, double delta) {
  return std::log(std::max(s, k) + 8.0 * std::sqrt(k) + 40.0) / delta;
}

// Draws v = ln theta - v0 from a fitted density.
class Sampler {
 public:
  Sampler(double gamma, double delta, double lower) : delta_(delta), k_(gamma / delta) {
    if (std::isinf(lower)) return;
    // Truncated, where k may be 0 or less: the distribution on so many points that a straight line
    // from one to the next is off by less than 1e-5.
    constexpr std::size_t points = 8192;
    const double s = std::exp(delta * lower), k = std::max(k_, 0.0);
    const double last = end_of(s, k, delta);
    const auto survival = [&](double v) { return tail(k_, std::exp(delta * v)); };
    const double all = survival(lower);
    for (std::size_t i = 0; i < points; ++i) {
      at_.push_back(lower + (last - lower) * static_cast<double>(i) / (points - 1));
      cdf_.push_back(1.0 - survival(at_.back()) / all);
    }
    cdf_.front() = 0.0;
  }

  double operator()(gsl_rng *rng) const {
    if (at_.empty()) {
      // A gamma variable of shape k, in logarithms since it underflows where k is small.
      const double u = gsl_rng_uniform_pos(rng);
      return (std::log(gsl_ran_gamma(rng, k_ + 1.0, 1.0)) + std::log(u) / k_) / delta_;
    }
    const double u = gsl_rng_uniform(rng) * cdf_.back();
    const auto above = std::upper_bound(cdf_.begin() + 1, cdf_.end() - 1, u);
    const auto i = static_cast<std::size_t>(above - cdf_.begin());
    const double share = (u - cdf_[i - 1]) / (cdf_[i] - cdf_[i - 1]);
    return at_[i - 1] + std::clamp(share, 0.0, 1.0) * (at_[i] - at_[i - 1]);
  }

 private:
  double delta_, k_;
  std::vector<double> at_, cdf_;
};

// The test of a fit to many values: data and replicas by the same cells, in units in which B is 1.
class CellTest {
 public:
  CellTest(const GeneralisedGammaFit &fit, double lower, double held)
      : lower_(lower), held_(held), cells_(cells_of(fit, lower)) {}

  const Cells &cells() const { return cells_; }

  // Distance of the law that fits counts best.
  double distance(const std::vector<double> &counts) const {
    const Profile best = Likelihood(cells_.centres(), counts, lower_).best(held_);
    if (!std::isfinite(best.log_likelihood)) return HUGE_VAL;
    std::vector<double> below(counts.size() + 1);
    std::partial_sum(counts.begin(), counts.end(), below.begin() + 1);
    return postproc::distance(CountedEdges(cells_.edges().data(), below.data(), below.size()),
                              lower_, best.gamma, best.delta, best.v0);
  }

 private:
  static Cells cells_of(const GeneralisedGammaFit &fit, double lower) {
    const double delta = fit.delta, k = fit.gamma / delta;
    const auto n = static_cast<double>(fit.n);
    const bool truncated = std::isfinite(lower);
    // A thousandth of a value is below the first edge.
    const double first = truncated ? lower : std::log(1e-3 / n) / fit.gamma;
    const double s = truncated ? std::exp(delta * lower) : 0.0;
    const double all = truncated ? tail(k, s) : 1.0;
    return Cells([&](double v) { return tail(k, std::exp(delta * v)) / all; },
                 {first, end_of(s, std::max(k, 0.0), delta)}, n);
  }

  double lower_, held_;
  Cells cells_;
};

// Left truncation in units in which B is 1, on which distances do not depend.
double scaled_lower(const GeneralisedGammaFit &fit) {
  return fit.lo > 0.0 ? std::log(fit.lo) - std::log(fit.B) / fit.delta : -HUGE_VAL;
}

double held_delta(const GeneralisedGammaFit &fit) {
  return fit.delta_fixed ? fit.delta : std::numeric_limits<double>::quiet_NaN();
}

// ---- least squares

struct BinnedData {
  struct Bin {
    std::array<double, 5> v, log_weight;  // Gauss-Legendre points in v, weights over the bin width
    double log_density, weight;
  };
  std::vector<Bin> bins;
  Mask free;
  Vector start;

  Vector expand(const gsl_vector *x) const {
    Vector p = start;
    for (std::size_t i = 0, k = 0; i < parameters; ++i)
      if (free[i]) p[i] = gsl_vector_get(x, k++);
    return p;
  }
};

// ln of the model averaged over the bin, and its derivatives.
double log_average(const BinnedData::Bin &bin, const Vector &p, Vector &slope) {
  const double delta = std::exp(p[log_delta]);
  std::array<double, 5> terms;
  for (std::size_t k = 0; k < terms.size(); ++k)
    terms[k] = bin.log_weight[k] + p[log_c] + p[shape] * bin.v[k] -
               std::exp(std::min(700.0, delta * (bin.v[k] - p[scale])));
  const double top = *std::max_element(terms.begin(), terms.end());
  double total = 0.0;
  slope = {};
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const double term = std::exp(terms[k] - top);
    const double w = delta * (bin.v[k] - p[scale]), s = std::exp(std::min(700.0, w));
    total += term;
    slope[log_c] += term;
    slope[shape] += term * bin.v[k];
    slope[log_delta] -= term * s * w;
    slope[scale] += term * delta * s;
  }
  for (double &value : slope) value /= total;
  return top + std::log(total);
}

int residuals(const gsl_vector *x, void *data, gsl_vector *f) {
  const auto &binned = *static_cast<const BinnedData *>(data);
  const Vector p = binned.expand(x);
  Vector slope;
  for (std::size_t i = 0; i < binned.bins.size(); ++i) {
    const double value = log_average(binned.bins[i], p, slope) - binned.bins[i].log_density;
    if (!std::isfinite(value)) return GSL_EDOM;
    gsl_vector_set(f, i, value);
  }
  return GSL_SUCCESS;
}

int jacobian(const gsl_vector *x, void *data, gsl_matrix *j) {
  const auto &binned = *static_cast<const BinnedData *>(data);
  const Vector p = binned.expand(x);
  Vector slope;
  for (std::size_t i = 0; i < binned.bins.size(); ++i) {
    log_average(binned.bins[i], p, slope);
    for (std::size_t c = 0, k = 0; c < parameters; ++c) {
      if (!binned.free[c]) continue;
      if (!std::isfinite(slope[c])) return GSL_EDOM;
      gsl_matrix_set(j, i, k++, slope[c]);
    }
  }
  return GSL_SUCCESS;
}

struct Solution {
  Vector p;
  double chi2 = HUGE_VAL;
  bool converged = false;
};

Solution solve(BinnedData &data) {
  const auto free = static_cast<std::size_t>(std::count(data.free.begin(), data.free.end(), true));
  const std::size_t n = data.bins.size();
  Solution solution;
  gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  const Gsl<gsl_multifit_nlinear_workspace> work(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, n, free),
      gsl_multifit_nlinear_free);
  const Gsl<gsl_vector> x = gsl_vector_of(free), weights = gsl_vector_of(n);
  for (std::size_t i = 0, k = 0; i < parameters; ++i)
    if (data.free[i]) gsl_vector_set(x.get(), k++, data.start[i]);
  for (std::size_t i = 0; i < n; ++i) gsl_vector_set(weights.get(), i, data.bins[i].weight);
  gsl_multifit_nlinear_fdf functions{};
  functions.f = residuals;
  functions.df = jacobian;
  functions.n = n;
  functions.p = free;
  functions.params = &data;
  if (gsl_multifit_nlinear_winit(x.get(), weights.get(), &functions, work.get()) != GSL_SUCCESS)
    return solution;
  int info = 0;
  const int status =
      gsl_multifit_nlinear_driver(500, 1e-10, 1e-10, 0.0, nullptr, nullptr, &info, work.get());
  // Without progress: the residuals cannot fall further within rounding.
  solution.converged = status == GSL_SUCCESS || status == GSL_ENOPROG;
  solution.p = data.expand(gsl_multifit_nlinear_position(work.get()));
  const gsl_vector *f = gsl_multifit_nlinear_residual(work.get());
  gsl_blas_ddot(f, f, &solution.chi2);
  return solution;
}

}  // namespace

GeneralisedGammaFit fit_maximum_likelihood(const std::vector<double> &values, double lo,
                                           const GeneralisedGammaOptions &options) {
  check_options(options);
  const QuietGsl quiet;
  if (!(lo >= 0.0 && std::isfinite(lo)))
    throw std::invalid_argument("generalised gamma: left truncation " + number(lo) +
                                ", expected a finite number of at least 0");
  GeneralisedGammaFit fit;
  fit.lo = lo;
  fit.delta_fixed = !std::isnan(options.fix_delta);
  std::vector<double> v;
  for (double value : values) {
    if (!std::isfinite(value) || (lo == 0.0 && value <= 0.0))
      throw std::invalid_argument("generalised gamma: value " + number(value) + ", expected a " +
                                  (lo == 0.0 ? "positive" : "finite") + " number");
    if (value >= lo) v.push_back(std::log(value));
  }
  fit.n = static_cast<std::int64_t>(v.size());
  const auto n = static_cast<double>(v.size());
  if (fit.n < 20) {
    fit.why = number(fit.n) + " values, at least 20 needed";
    return fit;
  }
  NeumaierSum sum;
  for (double v_i : v) sum.add(v_i);
  const double reference = sum.value() / n;
  for (double &v_i : v) v_i -= reference;
  const auto [least, greatest] = std::minmax_element(v.begin(), v.end());
  if (!(*greatest - *least > 1e-9)) {
    fit.why = "all values are equal";
    return fit;
  }

  Likelihood likelihood(std::move(v), lo > 0.0 ? std::log(lo) - reference : -HUGE_VAL);
  const Profile best = likelihood.best(options.fix_delta);
  // Compared first: a power law drives the rest to the border or along the ridge.
  if (likelihood.truncated() &&
      2.0 * n * (best.log_likelihood - likelihood.power_law()) < least_gain(fit.delta_fixed)) {
    fit.why = no_fall_off;
    return fit;
  }
  if (!std::isfinite(best.log_likelihood)) {
    fit.why = "no optimum found";
    return fit;
  }
  if (!fit.delta_fixed) fit.why = outside(best.delta);
  if (!fit.why.empty()) return fit;
  if (!likelihood.truncated() && best.gamma < 0.05) {
    fit.why = "gamma is at its limit 0, beyond which only a fit truncated on the left exists";
    return fit;
  }

  const double delta = best.delta, v0 = best.v0, gamma = best.gamma;
  const double mode = gamma > 0.0 ? v0 + std::log(gamma / delta) / delta : -HUGE_VAL;
  const TabulatedDensity table =
      tabulate([&](double x) { return gamma * x - std::exp(delta * (x - v0)); },
               std::max(mode, likelihood.lower()), likelihood.lower(), HUGE_VAL, 1.0 / delta);
  // Observed information per value: minus the second derivatives of the log-likelihood.
  Vector slope, mean_slope{};
  Matrix curvature, information{};
  for (std::size_t i = 0; i < table.u.size(); ++i) {
    derivatives(table.u[i], delta, v0, slope, curvature);
    for (std::size_t a = 0; a < parameters; ++a) {
      mean_slope[a] += table.p[i] * slope[a];
      for (std::size_t b = 0; b < parameters; ++b)
        information[a][b] += table.p[i] * (slope[a] * slope[b] + curvature[a][b]);
    }
  }
  for (std::size_t a = 0; a < parameters; ++a)
    for (std::size_t b = 0; b < parameters; ++b) information[a][b] -= mean_slope[a] * mean_slope[b];
  const auto subtract = [&](std::size_t a, std::size_t b) {
    information[a][b] -= likelihood.mean([&](double x) {
      derivatives(x, delta, v0, slope, curvature);
      return curvature[a][b];
    });
  };
  subtract(log_delta, log_delta);
  subtract(log_delta, scale);
  subtract(scale, scale);
  information[scale][log_delta] = information[log_delta][scale];
  for (Vector &row : information)
    for (double &entry : row) entry *= n;

  Matrix covariance{};
  if (!invert(information, {false, true, !fit.delta_fixed, true}, covariance)) {
    fit.why = "the information matrix is singular: the parameters trade against each other";
    return fit;
  }
  const Vector p = {-table.log_z - gamma * reference, gamma, std::log(delta), v0};
  fit.why = ridge(p, covariance, reference);
  if (!fit.why.empty()) return fit;
  Vector slope_c{};
  for (std::size_t a = shape; a < parameters; ++a) slope_c[a] = -mean_slope[a];
  slope_c[shape] -= reference;
  report(p, slope_c, covariance, reference, fit);
  fit.log_likelihood = n * (best.log_likelihood - likelihood.mean_v() - reference);
  std::vector<double> sorted = likelihood.sort();
  fit.ks =
      distance(SortedValues(sorted.data(), sorted.size()), likelihood.lower(), gamma, delta, v0);
  if (fit.n > largest_exact_sample) {
    for (double &v_i : sorted) v_i -= v0;
    const CellTest test(fit, scaled_lower(fit), held_delta(fit));
    fit.ks_by_cells = test.distance(test.cells().count(sorted));
  }
  return fit;
}

GeneralisedGammaFit fit_least_squares(const std::vector<LogBin> &bins,
                                      const GeneralisedGammaOptions &options) {
  check_options(options);
  const QuietGsl quiet;
  GeneralisedGammaFit fit;
  fit.delta_fixed = !std::isnan(options.fix_delta);
  std::vector<LogBin> used;
  for (const LogBin &bin : bins) {
    if (!(bin.lo > 0.0 && bin.hi > bin.lo && std::isfinite(bin.hi) && bin.count >= 0 &&
          bin.density >= 0.0))
      throw std::invalid_argument("generalised gamma: bin " + number(bin.lo) + " to " +
                                  number(bin.hi) + ", expected 0 < lower < upper and a density");
    if (bin.count >= options.min_count && bin.density > 0.0) used.push_back(bin);
  }
  double sum = 0.0;
  for (const LogBin &bin : used) {
    fit.n += bin.count;
    sum += static_cast<double>(bin.count) * std::log(bin.centre);
  }
  const int free_parameters = fit.delta_fixed ? 3 : 4;
  fit.dof = static_cast<int>(used.size()) - free_parameters;
  if (fit.dof < 1) {
    fit.why = std::to_string(used.size()) + " bins with at least " + number(options.min_count) +
              " counts, more than " + std::to_string(free_parameters) + " needed";
    return fit;
  }
  fit.lo = used.front().lo;
  const double reference = sum / static_cast<double>(fit.n);

  BinnedData data;
  const Gsl<gsl_integration_glfixed_table> rule(gsl_integration_glfixed_table_alloc(5),
                                                gsl_integration_glfixed_table_free);
  for (const LogBin &bin : used) {
    BinnedData::Bin entry;
    // Weighted with its count, the logarithm of a Poisson number is half a count too large on
    // average.
    entry.log_density = std::log(bin.density) - 0.5 / static_cast<double>(bin.count);
    entry.weight = static_cast<double>(bin.count);
    for (std::size_t k = 0; k < 5; ++k) {
      double weight = 0.0;
      gsl_integration_glfixed_point(std::log(bin.lo) - reference, std::log(bin.hi) - reference, k,
                                    &entry.v[k], &weight, rule.get());
      // ln C goes with theta^(gamma-1) d theta = theta^gamma dv, in units of exp(reference).
      entry.log_weight[k] = std::log(weight / (bin.hi - bin.lo));
    }
    data.bins.push_back(entry);
  }

  // The pure power law: fall-off far beyond the data.
  const double last = std::log(used.back().hi) - reference;
  data.free = {true, true, false, false};
  data.start = {std::log(used.front().density), 0.5, 0.0, last + 1000.0};
  const Solution power_law = solve(data);

  Solution best;
  for (const double delta : {0.5, 1.0, 2.0}) {
    for (const double v0 : {0.0, 0.5 * last, last}) {
      data.free = {true, true, !fit.delta_fixed, true};
      data.start = {std::log(used.front().density), 0.5,
                    std::log(fit.delta_fixed ? options.fix_delta : delta), v0};
      const Solution solution = solve(data);
      if (solution.chi2 < best.chi2) best = solution;
    }
    if (fit.delta_fixed) break;
  }
  // Compared first: a power law drives the rest to the border or along the ridge.
  if (power_law.converged && power_law.chi2 - best.chi2 < least_gain(fit.delta_fixed)) {
    fit.why = no_fall_off;
    return fit;
  }
  if (!fit.delta_fixed) fit.why = outside(std::exp(best.p[log_delta]));
  if (!best.converged && fit.why.empty()) fit.why = "no optimum found";
  if (!fit.why.empty()) return fit;
  Matrix information{}, covariance{};
  for (const BinnedData::Bin &bin : data.bins) {
    Vector slope;
    log_average(bin, best.p, slope);
    for (std::size_t a = 0; a < parameters; ++a)
      for (std::size_t b = 0; b < parameters; ++b)
        information[a][b] += bin.weight * slope[a] * slope[b];
  }
  if (!invert(information, data.free, covariance)) {
    fit.why = "the information matrix is singular: the parameters trade against each other";
    return fit;
  }
  const double inflation = std::max(1.0, best.chi2 / fit.dof);
  for (Vector &row : covariance)
    for (double &entry : row) entry *= inflation;
  fit.why = ridge(best.p, covariance, reference);
  if (!fit.why.empty()) return fit;
  // From ln C in units of exp(reference) to that in the unit of the data.
  Vector p = best.p;
  p[log_c] -= p[shape] * reference;
  report(p, {1.0, -reference, 0.0, 0.0}, covariance, reference, fit);
  fit.chi2 = best.chi2;
  return fit;
}

double p_value(const GeneralisedGammaFit &fit, int replicas, std::uint64_t seed) {
  if (fit.degenerate)
    throw std::invalid_argument("p-value of a degenerate generalised gamma density: " + fit.why);
  if (replicas < 0)
    throw std::invalid_argument("p-value: " + std::to_string(replicas) +
                                " replicas, expected at least 0");
  if (fit.dof > 0) return gsl_cdf_chisq_Q(fit.chi2, fit.dof);
  if (replicas == 0) return std::numeric_limits<double>::quiet_NaN();
  const QuietGsl quiet;
  const double lower = scaled_lower(fit), held = held_delta(fit);
  const auto n = static_cast<std::size_t>(fit.n);
  // Whether the data would have been called degenerate does not matter: any optimum is a fit.
  if (fit.n > largest_exact_sample) {
    const CellTest test(fit, lower, held);
    return share_of_replicas(replicas, [&](int replica) {
      const Rng rng = generator(seed_of_replica(seed, replica));
      return !(test.distance(test.cells().draw(rng.get(), n)) < fit.ks_by_cells);
    });
  }
  const Sampler sampler(fit.gamma, fit.delta, lower);
  const auto draw = [&](gsl_rng *rng) {
    std::vector<double> v(n);
    for (double &v_i : v) v_i = sampler(rng);
    return v;
  };
  return share_of_samples(replicas, seed, draw, [&](std::vector<double> v) {
    Likelihood likelihood(std::move(v), lower);
    const Profile best = likelihood.best(held);
    const bool fitted = std::isfinite(best.log_likelihood);
    const std::vector<double> &sorted = likelihood.sort();
    return !fitted || !(distance(SortedValues(sorted.data(), n), lower, best.gamma, best.delta,
                                 best.v0) < fit.ks);
  });
}

}  // namespace LSM::postproc
