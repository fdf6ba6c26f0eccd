// SPDX-License-Identifier: GPL-2.0-or-later
#include "finite_size.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "estimation.h"
#include "files/text.h"
#include "numerics/sum.h"
#include "replicas.h"

namespace LSM::postproc {

namespace {

using text::number;

// AICc: chi2 + 2 k with the correction for few points (Hurvich & Tsai 1989, Biometrika 76, 297).
double corrected_aic(double chi2, int k, int points) {
  return chi2 + 2.0 * k + 2.0 * k * (k + 1.0) / (points - k - 1.0);
}

// Usable points: logarithms of length and of s*, and the weights of the latter.
struct LogPoints {
  Numbers x, y, weight;
};

// ln s* of saturating growth, and its derivatives with respect to ln s_inf, ln L_c and D.
double saturating(double log_length, const Numbers &p, double sharpness, Numbers &slope) {
  const double below = p[1] - log_length, D = p[2], z = sharpness * D * below;
  const double small = std::exp(-std::fabs(z));  // ln(1 + e^z) without overflow
  const double share = (z > 0.0 ? 1.0 : small) / (1.0 + small);
  slope = {1.0, -share * D, -share * below};
  return p[0] - (std::max(z, 0.0) + std::log1p(small)) / sharpness;
}

// Logarithms of the distinct lengths, in ascending order.
Numbers steps_of(Numbers x) {
  std::sort(x.begin(), x.end());
  x.erase(
      std::unique(x.begin(), x.end(), [](double one, double next) { return next - one < 1e-9; }),
      x.end());
  return x;
}

// Starting values with a sharp bend at each interior length, as chi2 may have several minima.
std::vector<Numbers> bends_at(const Numbers &steps, const LogPoints &points) {
  std::vector<Numbers> bends;
  for (std::size_t step = 1; step + 1 < steps.size(); ++step) {
    Numbers bent = points.x;
    for (double &x : bent) x = std::min(x - steps[step], 0.0);
    double constant = 0.0, slope = 0.0, unused[4];
    gsl_fit_wlinear(bent.data(), 1, points.weight.data(), 1, points.y.data(), 1, bent.size(),
                    &constant, &slope, &unused[0], &unused[1], &unused[2], &unused[3]);
    bends.push_back({constant, steps[step], slope});
  }
  return bends;
}

Saturation fit_saturation(const LogPoints &points, double sharpness) {
  Saturation fit;
  fit.m = sharpness;
  const std::size_t n = points.x.size();
  if (n < 5) return without_numbers(fit, std::to_string(n) + " usable points, at least 5 needed");
  const Numbers steps = steps_of(points.x);
  if (steps.size() < 4)
    return without_numbers(fit,
                           std::to_string(steps.size()) + " different lengths, at least 4 needed");
  const LeastSquares best = least_squares(
      points.weight, bends_at(steps, points), [&](std::size_t i, const Numbers &p, Numbers &slope) {
        return saturating(points.x[i], p, sharpness, slope) - points.y[i];
      });
  if (best.p.empty() || !(best.p[1] > steps[1] && best.p[1] < steps[steps.size() - 2]))
    fit.why = "no end of growth with two lengths on either side of it";
  else if (!best.converged || best.covariance.n == 0)
    fit.why = "no minimum of chi2";
  else if (!(best.p[2] > 1.96 * best.covariance.error(2)))
    fit.why = "no significant growth up to where it would end";
  if (!fit.why.empty()) return fit;
  fit.degenerate = false;
  fit.chi2 = best.chi2;
  fit.aicc = corrected_aic(fit.chi2, 3, static_cast<int>(n));
  fit.s_inf = std::exp(best.p[0]);
  const double scale = error_scale(fit.chi2, static_cast<int>(n) - 3);
  fit.se_s_inf = scale * fit.s_inf * best.covariance.error(0);
  fit.L_c = std::exp(best.p[1]);
  fit.se_L_c = scale * fit.L_c * best.covariance.error(1);
  fit.D = best.p[2];
  fit.se_D = scale * best.covariance.error(2);
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
  // The correlation is taken to end where five lags in a row are not significant.
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
  // Flat-top lag window of twice that width.
  const std::size_t width = std::min(2 * std::max<std::size_t>(end, 1), last);
  while (r.size() <= width) r.push_back(covariance(r.size()));
  double spectrum = r[0], slope = 0.0;
  for (std::size_t lag = 1; lag <= width; ++lag) {
    const double t = static_cast<double>(lag) / static_cast<double>(width);
    const double weighted = 2.0 * std::min(1.0, 2.0 * (1.0 - t)) * r[lag];
    spectrum += weighted;
    slope += static_cast<double>(lag) * weighted;
  }
  // An estimate of 0 or less is a small spectrum hidden by noise: use the longest block.
  if (!(spectrum > 0.0)) return longest;
  return std::clamp(std::cbrt(1.5 * std::pow(slope / spectrum, 2) * n), shortest, longest);
}

namespace {

// Events on a ring of time, with cumulative sums so that those of any stretch cost two look-ups.
class Ring {
 public:
  Ring(const std::vector<double> &times, const std::vector<double> &sizes) : times_(times) {
    const auto n = static_cast<double>(times.size());
    // The gap that closes the ring is as long as the mean interval.
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
  // Sums over the events in [from, from + length); 0 <= from < duration, length <= duration.
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

// Why these events have no meaningful characteristic size, or "".
std::string too_few_or_equal(const std::vector<double> &times, const std::vector<double> &sizes) {
  if (sizes.size() < 10)
    return std::to_string(sizes.size()) + " events above the threshold, at least 10 needed";
  const auto [least, greatest] = std::minmax_element(sizes.begin(), sizes.end());
  if (*least == *greatest) return "all events have the same size";
  if (!std::isnormal(*least * *least)) return "the squares of sizes are too small for numbers";
  if (!(times.back() > times.front())) return "all events begin at the same time";
  return {};
}

// Block length from the autocorrelation of the influences of the events on the ratio.
double block_of(const std::vector<double> &times, const Ring &ring,
                const std::vector<double> &influences) {
  // As many bins as events, so that on average each holds one.
  std::vector<double> bins(influences.size(), 0.0);
  const auto count = static_cast<double>(bins.size());
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const double at = (times[i] - times.front()) / ring.duration() * count;
    bins[std::min(static_cast<std::size_t>(at), bins.size() - 1)] += influences[i];
  }
  return block_length(bins) * ring.duration() / count;
}

// Number of blocks of the requested length that make up the catalogue.
int blocks_in(const Ring &ring, double block, std::size_t events) {
  // Blocks shorter than a hundredth of the mean interval would hardly ever hold two events.
  const double shortest = 0.01 * ring.duration() / static_cast<double>(events);
  if (!(block >= shortest && block <= 0.5 * ring.duration()))
    throw std::invalid_argument(
        "characteristic size: block of " + number(block) + ", expected 0 or " + number(shortest) +
        " to half of the catalogue, which is " + number(ring.duration()) + " long");
  return static_cast<int>(std::round(ring.duration() / block));
}

// s* of one bootstrap sample: blocks of time that begin anywhere, or single events.
double resampled(const Ring &ring, const std::vector<double> &sizes, const SizePoint &point,
                 gsl_rng *rng) {
  NeumaierSum s, s2;
  while (!(s.value() > 0.0)) {  // a sample without events has no ratio
    for (int i = 0; i < point.blocks; ++i) {
      const Ring::Sums part = ring.over(gsl_rng_uniform(rng) * ring.duration(), point.block);
      s.add(part.s);
      s2.add(part.s2);
    }
    for (std::size_t i = 0; point.blocks == 0 && i < sizes.size(); ++i) {
      const double size = sizes[gsl_rng_uniform_int(rng, sizes.size())];
      s.add(size);
      s2.add(size * size);
    }
  }
  return s2.value() / s.value();
}

}  // namespace

SizePoint characteristic_size(const std::vector<double> &t_start,
                              const std::vector<double> &all_sizes, double threshold, double length,
                              const Resampling &resampling) {
  std::vector<double> times, sizes;
  for (std::size_t i = 0; i < all_sizes.size(); ++i) {
    const double size = all_sizes[i];
    if (!(size > 0.0 && size >= threshold && std::isfinite(size))) continue;
    sizes.push_back(size);
    times.push_back(t_start[i]);
  }
  SizePoint point;
  point.length = length;
  point.n = static_cast<std::int64_t>(sizes.size());
  point.why = too_few_or_equal(times, sizes);
  if (!point.why.empty()) return point;
  point.degenerate = false;
  const Ring ring(times, sizes);
  point.s_star = ring.all().s2 / ring.all().s;
  // Influence of each event: its contribution to the deviation of the ratio, to first order.
  std::vector<double> influences;
  for (double size : sizes)
    influences.push_back((size * size - point.s_star * size) / ring.all().s);
  point.error_independent =
      std::sqrt(gsl_stats_tss_m(influences.data(), 1, influences.size(), 0.0));
  point.block = std::isnan(resampling.block) ? block_of(times, ring, influences) : resampling.block;
  if (point.block > 0.0) {
    point.blocks = blocks_in(ring, point.block, sizes.size());
    point.block = ring.duration() / point.blocks;
  }
  const Rng rng = generator(resampling.seed);
  std::vector<double> deviations;
  for (int replica = 0; replica < resampling.replicas; ++replica)
    deviations.push_back(resampled(ring, sizes, point, rng.get()) - point.s_star);
  point.error = gsl_stats_sd(deviations.data(), 1, deviations.size());
  return point;
}

double error_scale(double chi2, int freedom) {
  return freedom > 0 && gsl_cdf_chisq_Q(chi2, freedom) < 0.01 ? std::sqrt(chi2 / freedom) : 1.0;
}

const char *to_string(SizeDependence dependence) {
  constexpr const char *names[] = {"power law in the length", "no dependence on the length",
                                   "undecided", "growth that ends at a length"};
  return names[static_cast<int>(dependence)];
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
  if (fit.points < 4)
    return without_numbers(fit, std::to_string(fit.points) + " usable lengths, at least 4 needed");
  const auto [shortest, longest] = std::minmax_element(x.begin(), x.end());
  if (*longest - *shortest < 1e-9) return without_numbers(fit, "all models have the same length");
  fit.degenerate = false;
  double log_a = 0.0, variance_a = 0.0, covariance = 0.0, variance_d = 0.0;
  gsl_fit_wlinear(x.data(), 1, weight.data(), 1, y.data(), 1, x.size(), &log_a, &fit.D, &variance_a,
                  &covariance, &variance_d, &fit.chi2);
  fit.A = std::exp(log_a);
  const double scale = error_scale(fit.chi2, fit.points - 2);
  fit.se_A = scale * fit.A * std::sqrt(variance_a);
  fit.se_D = scale * std::sqrt(variance_d);

  fit.constant = std::exp(gsl_stats_wmean(weight.data(), 1, y.data(), 1, y.size()));
  fit.se_constant = fit.constant / std::sqrt(std::accumulate(weight.begin(), weight.end(), 0.0));
  fit.chi2_constant = gsl_stats_wtss(weight.data(), 1, y.data(), 1, y.size());

  fit.aicc = corrected_aic(fit.chi2, 2, fit.points);
  fit.aicc_constant = corrected_aic(fit.chi2_constant, 1, fit.points);
  for (const double sharpness : {1.0, 2.0, Saturation::sharpness, 8.0, 16.0})
    fit.bends.push_back(fit_saturation(usable, sharpness));
  fit.saturation = fit.bends[2];
  if (fit.saturation.aicc < std::min(fit.aicc, fit.aicc_constant) - 2.0)
    fit.preferred = SizeDependence::saturates;
  else if (fit.aicc < fit.aicc_constant - 2.0)
    fit.preferred = SizeDependence::power_law;
  else if (fit.aicc_constant < fit.aicc - 2.0 && std::fabs(fit.D) < 1.96 * std::sqrt(variance_d))
    fit.preferred = SizeDependence::none;
  return fit;
}

bool fits_poorly(const ScalingFit &fit) {
  if (fit.preferred == SizeDependence::power_law)
    return error_scale(fit.chi2, fit.points - 2) > 1.0;
  return fit.preferred == SizeDependence::saturates &&
         error_scale(fit.saturation.chi2, fit.points - 3) > 1.0;
}

BendRange bends_as_good(const ScalingFit &fit) {
  Extent chi2;
  for (const Saturation &end : fit.bends)
    if (!end.degenerate) chi2.add(end.chi2);
  BendRange range;
  for (const Saturation &end : fit.bends) {
    if (end.degenerate || !(end.chi2 <= chi2.lo + 4.0)) continue;
    range.m.add(end.m);
    range.L_c.add(end.L_c);
    range.D.add(end.D);
  }
  return range;
}

}  // namespace LSM::postproc
