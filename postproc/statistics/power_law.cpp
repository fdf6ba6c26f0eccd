// SPDX-License-Identifier: GPL-2.0-or-later
#include "power_law.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cells.h"
#include "ks_distance.h"
#include "files/text.h"
#include "numerics/sum.h"
#include "replicas.h"
#include "samples.h"
#include "truncated_family.h"

namespace LSM::postproc {

namespace {

using text_io::number;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t least_events = 10;

// Settings of the search for a range.
constexpr int candidates = 60;
constexpr double least_in_range = 50.0, least_ratio = 10.0;

// Logarithms of a sample in ascending order with cumulative sums, so that the exponent of any range
// costs two look-ups. For a sample in cells, ranges begin and end at edges, and indices are of
// edges.
class LogSample {
 public:
  explicit LogSample(std::vector<double> logs) : y_(std::move(logs)) {
    below_.reserve(y_.size() + 1);
    sums_.reserve(y_.size() + 1);
    for (double y : y_) add(y, 1.0);
  }
  LogSample(const Cells &cells, const std::vector<double> &counts)
      : y_(cells.edges()), by_cells_(1) {
    for (std::size_t i = 0; i < counts.size(); ++i) add(cells.centres()[i], counts[i]);
  }

  const std::vector<double> &y() const { return y_; }
  std::size_t size() const { return static_cast<std::size_t>(below_.back()); }
  double front() const {
    const auto some = std::upper_bound(below_.begin(), below_.end(), 0.0);
    return *(y_.begin() + (some - below_.begin()) - 1);
  }
  double back() const {
    const auto all = std::lower_bound(below_.begin(), below_.end(), below_.back());
    return *(y_.begin() + (all - below_.begin()) - (by_cells_ ? 0 : 1));
  }
  double sum(std::size_t first, std::size_t last) const { return sums_[last] - sums_[first]; }
  double count(std::size_t first, std::size_t last) const { return below_[last] - below_[first]; }
  /// Index of the first value, or edge, at or above y.
  std::size_t first_from(double y) const {
    const auto at = std::lower_bound(y_.begin(), y_.end() - by_cells_, y - by_cells_ * rounding);
    return static_cast<std::size_t>(at - y_.begin());
  }
  /// Index of the first value above y, or of the last edge at or below it.
  std::size_t first_above(double y) const {
    const auto at = std::upper_bound(y_.begin() + by_cells_, y_.end(), y + by_cells_ * rounding);
    return static_cast<std::size_t>(at - y_.begin() - by_cells_);
  }
  /// A requested range as far as the sample can resolve it: in cells, moved to the next edges
  /// inside.
  double lower_end(double lower) const { return by_cells_ ? y_[first_from(lower)] : lower; }
  double upper_end(double upper) const {
    return by_cells_ && std::isfinite(upper) ? y_[first_above(upper)] : upper;
  }

  SamplePoints points(std::size_t first, std::size_t last) const {
    if (by_cells_) return {y_.data() + first, last - first + 1, below_.data() + first};
    return {y_.data() + first, last - first};
  }

 private:
  static constexpr double rounding = 1e-12;  // tolerance for the logarithms of edges

  void add(double y, double count) {
    sum_.add(count * y);
    sums_.push_back(sum_.value());
    below_.push_back(below_.back() + count);
  }

  std::vector<double> y_, below_{0.0}, sums_{0.0};
  NeumaierSum sum_;
  int by_cells_ = 0;
};

// Power law truncated to an interval of logarithms; the density of u is proportional to exp(b u).
struct Law {
  double lower;
  Exponential of_u;

  Law(double from, double to, double b = 0.0) : lower(from), of_u{to - from, b} {}
  Law(const PowerLawFit &fit) : Law(std::log(fit.lo), std::log(fit.hi), 1.0 - fit.alpha) {}
  double upper() const { return lower + of_u.length; }
  double cdf(double y) const { return of_u.cdf(y - lower); }
  double quantile(double probability) const { return lower + of_u.quantile(probability); }
};

struct Estimate {
  std::size_t first, last;  // indices of the range in the sample
  Law law;
  double mean_u = 0.0;
  bool usable = false;  // whether the likelihood has an interior maximum
};

Estimate estimate(const LogSample &sample, double lower, double upper) {
  Estimate e{sample.first_from(lower), sample.first_above(upper),
             Law(sample.lower_end(lower), sample.upper_end(upper))};
  if (e.last <= e.first || !(sample.count(e.first, e.last) > 0.0)) return e;
  e.mean_u = sample.sum(e.first, e.last) / sample.count(e.first, e.last) - e.law.lower;
  const double unit = e.law.of_u.finite() ? e.law.of_u.length : 1.0, mean = e.mean_u / unit;
  e.usable = mean > 1e-9 && (!e.law.of_u.finite() || mean < 1.0 - 1e-9);
  if (e.usable) e.law.of_u = Exponential::of_mean(e.mean_u, e.law.of_u.length);
  return e;
}

// Kolmogorov-Smirnov distance between sample and law on the range; above give_up only a lower
// bound.
double distance(const LogSample &sample, const Estimate &e, double give_up = infinity) {
  const auto cdf = [&e](double y) { return e.law.cdf(y); };
  return KsDistance(sample.points(e.first, e.last), cdf)(give_up);
}

struct Range {
  double lo = 0.0, hi = 0.0;
  double distance = infinity;
};

// Range (in logarithms) with the smallest distance, which is infinite if no range qualifies.
Range best_range(const LogSample &sample) {
  Range best;
  if (sample.size() == 0) return best;
  const double first = sample.front(), last = sample.back();
  const auto cut = [first, last](int k) {
    return k == candidates - 1 ? last : first + (last - first) * k / (candidates - 1);
  };
  for (int i = 0; i < candidates; ++i)
    for (int j = i + 1; j < candidates; ++j) {
      if (cut(j) - cut(i) < std::log(least_ratio)) continue;
      const Estimate e = estimate(sample, cut(i), cut(j));
      if (!e.usable || sample.count(e.first, e.last) < least_in_range) continue;
      const double d = distance(sample, e, best.distance);
      if (d < best.distance) best = {cut(i), cut(j), d};
    }
  return best;
}

// Positive finite values in [lo, hi].
std::vector<double> between(const std::vector<double> &sorted, double lo, double hi) {
  if (!std::is_sorted(sorted.begin(), sorted.end()))
    throw std::invalid_argument("power law: sample is not in ascending order");
  const auto first = lo > 0.0 ? std::lower_bound(sorted.begin(), sorted.end(), lo)
                              : std::upper_bound(sorted.begin(), sorted.end(), 0.0);
  return {first,
          std::upper_bound(first, sorted.end(), std::min(hi, std::numeric_limits<double>::max()))};
}

LogSample logs_of(std::vector<double> values) {
  for (double &y : values) y = std::log(y);
  return LogSample(std::move(values));
}

// Appends `count` uniform numbers from [0, 1), in ascending order, each transformed to a value:
// ordered uniform numbers are partial sums of exponential variables divided by their total.
template <class Transform>
void append_ordered(std::vector<double> &out, std::size_t count, gsl_rng *rng,
                    Transform transform) {
  const std::size_t start = out.size();
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    sum -= std::log(gsl_rng_uniform_pos(rng));
    out.push_back(sum);
  }
  sum -= std::log(gsl_rng_uniform_pos(rng));
  for (std::size_t i = start; i < out.size(); ++i) out[i] = transform(out[i] / sum);
}

// Cells of the distribution that replicas are drawn from: the law inside its range, the data
// outside.
Cells cells_of(const LogSample &data, const Law &law, const double (&parts)[3]) {
  const auto n = static_cast<double>(data.size());
  const auto survival = [&](double y) {
    if (y < law.lower || y > law.upper()) return 1.0 - static_cast<double>(data.first_from(y)) / n;
    return parts[2] + parts[1] * (1.0 - law.cdf(y));
  };
  std::vector<double> edges = {law.lower};
  // Edges slightly beyond the data, so that the extreme values lie within a cell.
  const auto room = [](double y) { return 1e-9 * (1.0 + std::fabs(y)); };
  if (parts[0] > 0.0) edges.insert(edges.begin(), data.front() - room(data.front()));
  if (law.of_u.finite()) edges.push_back(law.upper());
  if (!law.of_u.finite() || parts[2] > 0.0) {
    // Without an upper end, up to where a thousandth of a value is expected.
    const double end =
        law.of_u.finite() ? data.back() : std::max(data.back(), law.quantile(1.0 - 1e-3 / n));
    edges.push_back(end + room(end));
  }
  return Cells(survival, edges, n);
}

void append_resampled(std::vector<double> &out, const std::vector<double> &y, std::size_t first,
                      std::size_t last, std::size_t count, gsl_rng *rng) {
  append_ordered(out, count, rng, [&](double uniform) {
    const auto offset = static_cast<std::size_t>(uniform * static_cast<double>(last - first));
    return y[std::min(first + offset, last - 1)];
  });
}

}  // namespace

PowerLawFit fit_power_law(const std::vector<double> &sorted, double lo, double hi) {
  if (!(lo > 0.0 && std::isfinite(lo) && hi > lo))
    throw std::invalid_argument("power law: range " + number(lo) + " to " + number(hi) +
                                ", expected 0 < lower < upper");
  const LogSample sample = logs_of(between(sorted, lo, hi));
  PowerLawFit fit;
  fit.lo = lo;
  fit.hi = hi;
  fit.n = static_cast<std::int64_t>(sample.size());
  if (fit.n < least_events)
    return without_numbers(fit, number(fit.n) + " events in the range, at least 10 needed");
  if (sample.front() == sample.back())
    return without_numbers(fit, "all events in the range have the same size");
  const auto n = static_cast<double>(fit.n);
  const Estimate e = estimate(sample, std::log(lo), std::log(hi));
  if (!e.usable) return without_numbers(fit, "all events lie at one edge of the range");
  const double b = e.law.of_u.b;
  const double error = 1.0 / std::sqrt(n * e.law.of_u.variance());
  if (!(error <= std::max(1.0, std::fabs(b))))
    return without_numbers(fit, "the range is too narrow for " + number(fit.n) +
                                    " events: the exponent is not determined");
  fit.degenerate = false;
  fit.alpha = 1.0 - b;
  fit.standard_error = error;
  fit.ks = distance(sample, e);
  fit.log_likelihood = n * (b * e.mean_u - e.law.of_u.log_z()) - sample.sum(0, sample.size());
  return fit;
}

PowerLawFit search_range(const std::vector<double> &sorted, double least) {
  const std::vector<double> values = between(sorted, least, infinity);
  const LogSample sample = logs_of(values);
  const Range range = best_range(sample);
  PowerLawFit fit;
  if (std::isfinite(range.distance)) {
    // Ends at the extremes of the sample must still include them after exp(log(x)) has been
    // rounded.
    fit = fit_power_law(sorted, range.lo == sample.front() ? values.front() : std::exp(range.lo),
                        range.hi == sample.back() ? values.back() : std::exp(range.hi));
  } else {
    fit.lo = least;
    fit.hi = infinity;
    fit.n = static_cast<std::int64_t>(sample.size());
    fit.why = "no range holds " + number(least_in_range) + " events over a ratio of " +
              number(least_ratio);
  }
  fit.searched = true;
  fit.least = least;
  return fit;
}

double p_value(const PowerLawFit &fit, const std::vector<double> &sorted, int replicas,
               std::uint64_t seed) {
  if (fit.degenerate) throw std::invalid_argument("p-value of a degenerate power law: " + fit.why);
  const Law law(fit);
  const LogSample data = logs_of(fit.searched ? between(sorted, fit.least, infinity)
                                              : between(sorted, fit.lo, fit.hi));
  const std::size_t first = data.first_from(std::log(fit.lo));
  const std::size_t last = data.first_above(std::log(fit.hi));
  const auto n = static_cast<double>(data.size());
  const double parts[3] = {static_cast<double>(first) / n, static_cast<double>(last - first) / n,
                           static_cast<double>(data.size() - last) / n};
  // Distance between a sample and its best fit, found as for the data.
  const auto distance_of = [&](const LogSample &sample) {
    if (fit.searched) return best_range(sample).distance;
    const Estimate e = estimate(sample, law.lower, law.upper());
    return e.usable ? distance(sample, e) : infinity;
  };
  if (data.size() > static_cast<std::size_t>(largest_exact_sample)) {
    const Cells cells = cells_of(data, law, parts);
    return cells.share_as_far(data.y(), replicas, seed,
                              [&](const std::vector<double> &counts, double) {
                                return distance_of(LogSample(cells, counts));
                              });
  }
  const Rng stream = generator(seed);
  gsl_rng *const rng = stream.get();
  const auto draw = [&] {
    std::vector<double> logs;
    logs.reserve(data.size());
    unsigned int counts[3];
    gsl_ran_multinomial(rng, 3, static_cast<unsigned int>(data.size()), parts, counts);
    append_resampled(logs, data.y(), 0, first, counts[0], rng);
    append_ordered(logs, counts[1], rng, [&](double u) { return law.quantile(u); });
    append_resampled(logs, data.y(), last, data.size(), counts[2], rng);
    return logs;
  };
  return share_of_draws(replicas, draw, [&](std::vector<double> logs) {
    return distance_of(LogSample(std::move(logs))) >= fit.ks;
  });
}

namespace {

// Comparisons of a power law with other laws for the same sample, in u = ln(x / lo).
class Contest {
 public:
  Contest(const std::vector<double> &sorted, const PowerLawFit &fit)
      : lo_(fit.lo), hi_(fit.hi), law_(fit), u_(between(sorted, fit.lo, fit.hi)) {
    for (double &u : u_) u = std::log(u) - law_.lower;
    mean_u_ = mean_of([](double u) { return u; });
  }

  // In t = (x - lo) / width, an exponential has the same form as the power law in u.
  Comparison exponential() const {
    const bool finite = law_.of_u.finite();
    const double width = finite ? hi_ - lo_ : lo_, scale = lo_ / width;
    const Exponential rival = Exponential::of_mean(
        mean_of([](double u) { return std::expm1(u); }) * scale, finite ? 1.0 : infinity);
    const double norm = rival.log_z() - std::log(scale);
    return vuong("exponential", {{"rate", -rival.b / width}},
                 [&](double u) { return rival.b * std::expm1(u) * scale - norm + u; });
  }

  Comparison log_normal() const {
    const double mean_t = mean_of([](double u) { return u * u; });
    const TiltedFit rival = fit_tilted({0.0}, mean_u_, mean_t, law_.of_u.length);
    if (!decided(rival))
      return undecided("log-normal", rival,
                       "the best log-normal is its limit, the power law itself");
    const double norm = rival.b * mean_u_ - rival.c * mean_t - rival.log_likelihood;
    // Parameters of ln x: mu is that of the untruncated normal and may lie far below the range.
    return vuong(
        "log-normal",
        {{"mu", law_.lower + rival.b / (2.0 * rival.c)}, {"sigma", 1.0 / std::sqrt(2.0 * rival.c)}},
        [&](double u) { return rival.b * u - rival.c * u * u - norm; });
  }

  Comparison cut_off() const {
    const char *const name = "power law with exponential cut-off";
    const TiltedFit rival =
        fit_tilted({1.0}, mean_u_, mean_of([](double u) { return std::exp(u); }), law_.of_u.length);
    if (!decided(rival))
      return undecided(name, rival, "the best cut-off is infinite: the power law itself");
    const double gain = static_cast<double>(u_.size()) *
                        (rival.log_likelihood - (law_.of_u.b * mean_u_ - law_.of_u.log_z()));
    return {name,
            {{"alpha", 1.0 - rival.b}, {"cut-off", lo_ / rival.c}},
            -gain,
            -2.0 * gain,
            gsl_cdf_chisq_Q(std::max(0.0, 2.0 * gain), 1.0)};
  }

 private:
  static bool decided(const TiltedFit &rival) { return rival.converged && rival.c > 0.0; }
  static Comparison undecided(const char *name, const TiltedFit &rival, const char *border) {
    Comparison out;
    out.rival = name;
    out.degenerate = true;
    out.why = rival.converged ? border : "no optimum found";
    return out;
  }

  template <class F>
  double mean_of(const F &f) const {
    NeumaierSum sum;
    for (double u : u_) sum.add(f(u));
    return sum.value() / static_cast<double>(u_.size());
  }

  // Vuong's test in u: the Jacobian of the change of variables cancels in the likelihood ratio.
  template <class LogDensity>
  Comparison vuong(const char *name, std::vector<std::pair<std::string, double>> parameters,
                   const LogDensity &rival) const {
    const auto n = static_cast<double>(u_.size());
    const double log_z = law_.of_u.log_z();
    const auto difference = [&](double u) { return law_.of_u.b * u - log_z - rival(u); };
    const double mean = mean_of(difference);
    const double deviation =
        std::sqrt(mean_of([&](double u) { return std::pow(difference(u) - mean, 2); }));
    const double normalised = deviation > 0.0 ? std::sqrt(n) * mean / deviation : 0.0;
    return {name, std::move(parameters), n * mean, normalised,
            std::erfc(std::fabs(normalised) / std::sqrt(2.0))};
  }

  double lo_, hi_;
  Law law_;
  std::vector<double> u_;
  double mean_u_ = 0.0;
};

}  // namespace

std::vector<Comparison> compare(const std::vector<double> &sorted, const PowerLawFit &fit) {
  if (fit.degenerate)
    throw std::invalid_argument("comparison with a degenerate power law: " + fit.why);
  const Contest contest(sorted, fit);
  return {contest.exponential(), contest.log_normal(), contest.cut_off()};
}

}  // namespace LSM::postproc
