// SPDX-License-Identifier: GPL-2.0-or-later
#include "finite_size.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lsm_sum.h"
#include "lsm_text_io.h"
#include "replicas.h"

namespace LSM::postproc {

namespace {

using text_io::number;

// chi2 + 2 k with the correction for few points (Hurvich & Tsai 1989, Biometrika 76, 297).
double corrected_aic(double chi2, int k, int points) {
  return chi2 + 2.0 * k + 2.0 * k * (k + 1.0) / (points - k - 1.0);
}

// Usable points: logarithms of length and s*, weights of the latter.
struct LogPoints {
  std::vector<double> x, y, weight;
  double sharpness = Saturation::sharpness;
};

// Parameters ln s_inf, ln L_c, D. Either array may be null.
int saturating(const gsl_vector *p, const LogPoints &points, gsl_vector *residuals,
               gsl_matrix *jacobian) {
  const double a = gsl_vector_get(p, 0), c = gsl_vector_get(p, 1), D = gsl_vector_get(p, 2);
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double below = c - points.x[i], z = points.sharpness * D * below;
    if (!std::isfinite(z)) return GSL_EDOM;
    const double small = std::exp(-std::fabs(z));  // ln(1 + e^z) without overflow
    if (residuals)
      gsl_vector_set(residuals, i,
                     a - (std::max(z, 0.0) + std::log1p(small)) / points.sharpness - points.y[i]);
    if (!jacobian) continue;
    const double share = (z > 0.0 ? 1.0 : small) / (1.0 + small);
    gsl_matrix_set(jacobian, i, 0, 1.0);
    gsl_matrix_set(jacobian, i, 1, -share * D);
    gsl_matrix_set(jacobian, i, 2, -share * below);
  }
  return GSL_SUCCESS;
}

Saturation fit_saturation(LogPoints points, double sharpness) {
  Saturation fit;
  fit.m = points.sharpness = sharpness;
  const std::size_t n = points.x.size();
  if (n < 5) {
    fit.why = std::to_string(n) + " usable points, at least 5 needed";
    return fit;
  }
  std::vector<double> steps = points.x;
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end(),
                          [](double one, double next) { return next - one < 1e-9; }),
              steps.end());
  if (steps.size() < 4) {
    fit.why = std::to_string(steps.size()) + " different lengths, at least 4 needed";
    return fit;
  }

  const QuietGsl quiet;
  gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  const Gsl<gsl_multifit_nlinear_workspace> work(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, n, 3),
      gsl_multifit_nlinear_free);
  gsl_multifit_nlinear_fdf functions{};
  functions.f = [](const gsl_vector *p, void *data, gsl_vector *f) {
    return saturating(p, *static_cast<const LogPoints *>(data), f, nullptr);
  };
  functions.df = [](const gsl_vector *p, void *data, gsl_matrix *j) {
    return saturating(p, *static_cast<const LogPoints *>(data), nullptr, j);
  };
  functions.n = n;
  functions.p = 3;
  functions.params = &points;
  const gsl_vector_const_view weights = gsl_vector_const_view_array(points.weight.data(), n);
  double best[3] = {}, covariance[9] = {};
  gsl_matrix_view covariances = gsl_matrix_view_array(covariance, 3, 3);
  bool converged = false;
  fit.chi2 = HUGE_VAL;
  // From a sharp bend at each length inside, as chi2 may have several minima.
  for (std::size_t start = 1; start + 1 < steps.size(); ++start) {
    std::vector<double> bent = points.x;
    for (double &x : bent) x = std::min(x - steps[start], 0.0);
    double p[3] = {0.0, steps[start], 0.0}, unused[4];
    gsl_fit_wlinear(bent.data(), 1, points.weight.data(), 1, points.y.data(), 1, n, &p[0], &p[2],
                    &unused[0], &unused[1], &unused[2], &unused[3]);
    const gsl_vector_const_view first = gsl_vector_const_view_array(p, 3);
    if (gsl_multifit_nlinear_winit(&first.vector, &weights.vector, &functions, work.get()) !=
        GSL_SUCCESS)
      continue;
    int info = 0;
    const int status =
        gsl_multifit_nlinear_driver(200, 1e-10, 1e-10, 0.0, nullptr, nullptr, &info, work.get());
    const gsl_vector *const f = gsl_multifit_nlinear_residual(work.get());
    double chi2 = HUGE_VAL;
    gsl_blas_ddot(f, f, &chi2);
    if (!(chi2 < fit.chi2)) continue;
    fit.chi2 = chi2;
    for (std::size_t i = 0; i < 3; ++i)
      best[i] = gsl_vector_get(gsl_multifit_nlinear_position(work.get()), i);
    // Without progress: the residuals cannot fall further within rounding.
    converged = (status == GSL_SUCCESS || status == GSL_ENOPROG) &&
                gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(work.get()), 0.0,
                                           &covariances.matrix) == GSL_SUCCESS;
  }

  fit.aicc = corrected_aic(fit.chi2, 3, static_cast<int>(n));
  if (!std::isfinite(fit.chi2) || !(best[1] > steps[1] && best[1] < steps[steps.size() - 2]))
    fit.why = "no end of growth with two lengths on either side of it";
  else if (!converged)
    fit.why = "no minimum of chi2";
  else if (!(best[2] > 1.96 * std::sqrt(covariance[8])))
    fit.why = "no significant growth up to where it would end";
  if (!fit.why.empty()) {
    fit.chi2 = fit.aicc = fit.D;
    return fit;
  }
  fit.degenerate = false;
  fit.s_inf = std::exp(best[0]);
  fit.se_s_inf = fit.s_inf * std::sqrt(covariance[0]);
  fit.L_c = std::exp(best[1]);
  fit.se_L_c = fit.L_c * std::sqrt(covariance[4]);
  fit.D = best[2];
  fit.se_D = std::sqrt(covariance[8]);
  return fit;
}

}  // namespace

double block_length(const std::vector<double> &values) {
  const auto n = static_cast<double>(values.size());
  const double longest = std::max(1.0, n / 10.0);
  const double shortest = std::min(std::cbrt(n), longest);
  const auto covariance = [&](std::size_t lag) {
    NeumaierSum sum;
    for (std::size_t i = 0; i + lag < values.size(); ++i) sum.add(values[i] * values[i + lag]);
    return sum.value() / n;
  };
  // The correlation is taken to end before the first five lags in a row without a significant one.
  constexpr std::size_t quiet = 5;
  const std::size_t last =
      std::min(static_cast<std::size_t>(std::ceil(std::sqrt(n))) + quiet, values.size() / 2);
  std::vector<double> r = {covariance(0)};
  if (!(r[0] > 0.0)) return shortest;
  const double significant = 2.0 * std::sqrt(std::log10(n) / n) * r[0];
  std::size_t end = 0;
  for (std::size_t lag = 1; lag <= last; ++lag) {
    r.push_back(covariance(lag));
    if (std::fabs(r[lag]) >= significant) end = lag;
    if (lag >= end + quiet) break;
  }
  // Flat-top window over twice that.
  const std::size_t width = std::min(2 * std::max<std::size_t>(end, 1), last);
  while (r.size() <= width) r.push_back(covariance(r.size()));
  double spectrum = r[0], slope = 0.0;
  for (std::size_t lag = 1; lag <= width; ++lag) {
    const double t = static_cast<double>(lag) / static_cast<double>(width);
    const double weighted = 2.0 * std::min(1.0, 2.0 * (1.0 - t)) * r[lag];
    spectrum += weighted;
    slope += static_cast<double>(lag) * weighted;
  }
  // A spectrum of 0 or less is noise about a small one: the longest block.
  if (!(spectrum > 0.0)) return longest;
  return std::clamp(std::cbrt(1.5 * std::pow(slope / spectrum, 2) * n), shortest, longest);
}

namespace {

// Events on a ring of time, with running sums so that those of any stretch cost two look-ups.
class Ring {
 public:
  Ring(const std::vector<double> &times, const std::vector<double> &sizes) : times_(times) {
    const auto n = static_cast<double>(times.size());
    // The gap where the ends are joined is as long as the others on average.
    duration_ = (times.back() - times.front()) * n / (n - 1.0);
    NeumaierSum s, s2;
    sums_.push_back({0.0, 0.0});
    for (double size : sizes) {
      s.add(size);
      s2.add(size * size);
      sums_.push_back({s.value(), s2.value()});
    }
  }
  struct Sums {
    double s, s2;
  };
  double duration() const { return duration_; }
  Sums all() const { return sums_.back(); }
  // Of the events in [from, from + length), 0 <= from < duration, length <= duration.
  Sums over(double from, double length) const {
    const Sums first = before(from), wrapped = before(from + length - duration_);
    const Sums last = from + length > duration_ ? Sums{all().s + wrapped.s, all().s2 + wrapped.s2}
                                                : before(from + length);
    return {last.s - first.s, last.s2 - first.s2};
  }

 private:
  Sums before(double time) const {
    return sums_[static_cast<std::size_t>(
        std::lower_bound(times_.begin(), times_.end(), times_.front() + time) - times_.begin())];
  }
  const std::vector<double> &times_;
  std::vector<Sums> sums_;
  double duration_;
};

}  // namespace

SizePoint characteristic_size(const std::vector<double> &t_start, const std::vector<double> &sizes,
                              double threshold, double length, const Resampling &resampling) {
  const std::string what = "characteristic size: ";
  const int replicas = resampling.replicas;
  if (replicas < 2)
    throw std::invalid_argument(what + std::to_string(replicas) + " replicas, expected at least 2");
  if (t_start.size() != sizes.size() || !std::is_sorted(t_start.begin(), t_start.end()))
    throw std::invalid_argument(what + "expected one time for each size, in ascending order");
  if (!std::isnan(resampling.block) &&
      !(resampling.block >= 0.0 && std::isfinite(resampling.block)))
    throw std::invalid_argument(what + "block of " + number(resampling.block) +
                                ", expected a finite time of at least 0");
  if (!(threshold >= 0.0 && std::isfinite(threshold)))
    throw std::invalid_argument(what + "threshold " + number(threshold) +
                                ", expected a finite number of at least 0");
  if (!(length > 0.0 && std::isfinite(length)))
    throw std::invalid_argument(what + "length " + number(length) +
                                ", expected a positive finite number");
  std::vector<double> kept, times;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double size = sizes[i];
    if (!(size > 0.0 && size >= threshold && std::isfinite(size))) continue;
    kept.push_back(size);
    times.push_back(t_start[i]);
  }
  SizePoint point;
  point.length = length;
  point.n = static_cast<std::int64_t>(kept.size());
  if (point.n < 10) {
    point.why = number(point.n) + " events above the threshold, at least 10 needed";
    return point;
  }
  const auto [least, greatest] = std::minmax_element(kept.begin(), kept.end());
  if (*least == *greatest) {
    point.why = "all events have the same size";
    return point;
  }

  if (!(times.back() > times.front())) {
    point.why = "all events begin at the same time";
    return point;
  }

  const auto ratio = [&](const auto &next) {
    NeumaierSum sum, squares;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const double size = next(i);
      sum.add(size);
      squares.add(size * size);
    }
    return squares.value() / sum.value();
  };
  const Ring ring(times, kept);
  point.s_star = ratio([&](std::size_t i) { return kept[i]; });
  // What an event adds to the deviation of the ratio, to first order.
  const auto influence = [&](double size) {
    return (size * size - point.s_star * size) / ring.all().s;
  };
  NeumaierSum influences;
  for (double size : kept) influences.add(std::pow(influence(size), 2));
  point.error_independent = std::sqrt(influences.value());

  point.block = resampling.block;
  if (std::isnan(point.block)) {
    // As many bins as events: one in each on average.
    std::vector<double> bins(kept.size(), 0.0);
    const auto count = static_cast<double>(bins.size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const double at = (times[i] - times.front()) / ring.duration() * count;
      bins[std::min(static_cast<std::size_t>(at), bins.size() - 1)] += influence(kept[i]);
    }
    point.block = block_length(bins) * ring.duration() / count;
  }
  if (point.block > 0.0) {
    // Below a hundredth of the mean interval hardly any block would have two events.
    const double shortest = 0.01 * ring.duration() / static_cast<double>(kept.size());
    if (!(point.block >= shortest && point.block <= 0.5 * ring.duration()))
      throw std::invalid_argument(what + "block of " + number(point.block) + ", expected 0 or " +
                                  number(shortest) + " to half of the catalogue, which is " +
                                  number(ring.duration()) + " long");
    point.blocks = static_cast<int>(std::round(ring.duration() / point.block));  // a whole number
    point.block = ring.duration() / point.blocks;
  }

  point.degenerate = false;
  const Rng rng = generator(resampling.seed);
  const auto event_by_event = [&] {
    return ratio([&](std::size_t) { return kept[gsl_rng_uniform_int(rng.get(), kept.size())]; });
  };
  const auto block_by_block = [&] {
    NeumaierSum s, s2;
    while (!(s.value() > 0.0)) {  // a draw without an event has no ratio
      for (int i = 0; i < point.blocks; ++i) {
        const double from = gsl_rng_uniform(rng.get()) * ring.duration();
        const Ring::Sums part = ring.over(from, point.block);
        s.add(part.s);
        s2.add(part.s2);
      }
    }
    return s2.value() / s.value();
  };
  NeumaierSum sum, squares;
  for (int replica = 0; replica < replicas; ++replica) {
    const double deviation =
        (point.blocks > 0 ? block_by_block() : event_by_event()) - point.s_star;
    sum.add(deviation);
    squares.add(deviation * deviation);
  }
  const double mean = sum.value() / replicas;
  point.error = std::sqrt(std::max(0.0, squares.value() - replicas * mean * mean) / (replicas - 1));
  return point;
}

const char *to_string(SizeDependence dependence) {
  switch (dependence) {
    case SizeDependence::power_law:
      return "power law in the length";
    case SizeDependence::none:
      return "no dependence on the length";
    case SizeDependence::saturates:
      return "growth that ends at a length";
    default:
      return "undecided";
  }
}

ScalingFit fit_scaling(const std::vector<SizePoint> &points) {
  LogPoints usable;
  std::vector<double> &x = usable.x, &y = usable.y, &weight = usable.weight;
  for (const SizePoint &point : points) {
    if (point.degenerate || !(point.error > 0.0)) continue;
    x.push_back(std::log(point.length));
    y.push_back(std::log(point.s_star));
    weight.push_back(std::pow(point.s_star / point.error, 2));
  }
  ScalingFit fit;
  fit.points = static_cast<int>(x.size());
  if (fit.points < 4) {
    fit.why = std::to_string(fit.points) + " usable lengths, at least 4 needed";
    return fit;
  }
  const auto [shortest, longest] = std::minmax_element(x.begin(), x.end());
  if (*longest - *shortest < 1e-9) {
    fit.why = "all models have the same length";
    return fit;
  }
  fit.degenerate = false;
  double log_a = 0.0, variance_a = 0.0, covariance = 0.0, variance_d = 0.0;
  gsl_fit_wlinear(x.data(), 1, weight.data(), 1, y.data(), 1, x.size(), &log_a, &fit.D, &variance_a,
                  &covariance, &variance_d, &fit.chi2);
  fit.A = std::exp(log_a);
  fit.se_A = fit.A * std::sqrt(variance_a);
  fit.se_D = std::sqrt(variance_d);

  double total = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    total += weight[i];
    mean += weight[i] * y[i];
  }
  mean /= total;
  fit.constant = std::exp(mean);
  fit.se_constant = fit.constant / std::sqrt(total);
  fit.chi2_constant = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
    fit.chi2_constant += weight[i] * (y[i] - mean) * (y[i] - mean);

  fit.aicc = corrected_aic(fit.chi2, 2, fit.points);
  fit.aicc_constant = corrected_aic(fit.chi2_constant, 1, fit.points);
  for (const double sharpness : {1.0, 2.0, Saturation::sharpness, 8.0, 16.0})
    fit.bends.push_back(fit_saturation(usable, sharpness));
  fit.saturation = fit.bends[2];
  if (fit.saturation.aicc < std::min(fit.aicc, fit.aicc_constant) - 2.0)
    fit.preferred = SizeDependence::saturates;
  else if (fit.aicc < fit.aicc_constant - 2.0)
    fit.preferred = SizeDependence::power_law;
  else if (fit.aicc_constant < fit.aicc - 2.0 && std::fabs(fit.D) < 1.96 * fit.se_D)
    fit.preferred = SizeDependence::none;
  return fit;
}

}  // namespace LSM::postproc
