// SPDX-License-Identifier: GPL-2.0-or-later
#include "power_law.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cells.h"
#include "gsl_owners.h"
#include "ks_distance.h"
#include "files/text.h"
#include "magnitudes.h"
#include "numerics/sum.h"
#include "replicas.h"
#include "samples.h"
#include "truncated_family.h"

namespace LSM::postproc {

namespace {

using text::number;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t least_events = 10;

// Settings of the search for a range.
constexpr int candidates = 60;
constexpr double least_in_range = 50.0, least_ratio = 10.0;

// Lower edge of the bin that is centred at the multiple of step next to y.
double edge_below(double y, double step) { return step * (std::round(y / step) - 0.5); }

// Logarithms of a sample in ascending order with cumulative sums, so that the exponent of any range
// costs two look-ups. For a sample in cells, ranges begin and end at edges, and indices are of
// edges. Cells of equal width `step` are the bins in which the data are known; without a step,
// cells only save time.
class LogSample {
 public:
  LogSample(std::vector<double> logs, double step) : y_(std::move(logs)), step_(step) {
    if (step > 0.0 && !y_.empty()) {
      count_in_bins();
      return;
    }
    below_.reserve(y_.size() + 1);
    sums_.reserve(y_.size() + 1);
    for (double y : y_) add(y, 1.0);
  }
  LogSample(const Cells &cells, const std::vector<double> &counts, double step)
      : y_(cells.edges()), by_cells_(1), step_(step) {
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
  /// inside, which in bins may lie beyond the data.
  double lower_end(double lower) const {
    if (step_ > 0.0) return edge_below(step_ * std::ceil(lower / step_ + 0.5 - rounding), step_);
    return by_cells_ ? y_[first_from(lower)] : lower;
  }
  double upper_end(double upper) const {
    if (!std::isfinite(upper)) return upper;
    if (step_ > 0.0) return edge_below(step_ * std::floor(upper / step_ + 0.5 + rounding), step_);
    return by_cells_ ? y_[first_above(upper)] : upper;
  }
  double step() const { return step_; }

  SamplePoints points(std::size_t first, std::size_t last) const {
    if (by_cells_) return {y_.data() + first, last - first + 1, below_.data() + first};
    return {y_.data() + first, last - first};
  }

 private:
  static constexpr double rounding = 1e-12;  // tolerance for the logarithms of edges

  void count_in_bins() {
    const std::vector<double> logs = std::move(y_);
    by_cells_ = 1;
    const double first = bin_of(logs.front(), step_), last = bin_of(logs.back(), step_);
    y_.clear();
    auto at = logs.begin();
    for (double bin = first; bin <= last; ++bin) {
      const auto end =
          std::find_if(at, logs.end(), [&](double y) { return bin_of(y, step_) > bin; });
      y_.push_back(edge_below(bin * step_, step_));
      add(bin * step_, static_cast<double>(end - at));
      at = end;
    }
    y_.push_back(edge_below((last + 1.0) * step_, step_));
  }

  void add(double y, double count) {
    sum_.add(count * y);
    sums_.push_back(sum_.value());
    below_.push_back(below_.back() + count);
  }

  std::vector<double> y_, below_{0.0}, sums_{0.0};
  NeumaierSum sum_;
  int by_cells_ = 0;
  double step_ = 0.0;
};

// Power law truncated to an interval of logarithms; the density of u is proportional to exp(b u).
struct Law {
  double lower;
  Exponential of_u;

  Law(double from, double to, double b = 0.0, double step = 0.0)
      : lower(from), of_u{to - from, b, step} {}
  Law(const PowerLawFit &fit)
      : Law(std::log(fit.lo) - 0.5 * fit.step, std::log(fit.hi) + 0.5 * fit.step, 1.0 - fit.alpha,
            fit.step) {}
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
  const double step = sample.step(), unit = e.law.of_u.finite() ? e.law.of_u.length - step : 1.0,
               mean = (e.mean_u - 0.5 * step) / unit;
  e.usable = mean > 1e-9 && (!e.law.of_u.finite() || mean < 1.0 - 1e-9);
  if (e.usable) e.law.of_u = Exponential::of_mean(e.mean_u, e.law.of_u.length, step);
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

std::vector<double> logs_of(std::vector<double> values) {
  for (double &y : values) y = std::log(y);
  return values;
}

// Logarithms of the values in [lo, hi]; with a step, of those in the bins whose centres lie there,
// as these centres.
std::vector<double> logs_between(const std::vector<double> &sorted, double lo, double hi,
                                 double step) {
  if (!(step > 0.0)) return logs_of(between(sorted, lo, hi));
  std::vector<double> centres;
  const double first = std::ceil(std::log(lo) / step - magnitude_tolerance),
               last = std::floor(std::log(hi) / step + magnitude_tolerance);
  for (const double y : logs_of(between(sorted, lo * std::exp(-step), hi * std::exp(step))))
    if (const double bin = bin_of(y, step); bin >= first && bin <= last)
      centres.push_back(bin * step);
  return centres;
}

// Moves the ends of a range to the centres of the first and last bin whose centres are inside.
// Returns whether these are two bins.
bool move_to_centres(PowerLawFit &fit) {
  const double first = std::log(fit.lo) / fit.step, last = std::log(fit.hi) / fit.step;
  const double lowest = std::ceil(first - magnitude_tolerance),
               highest = std::floor(last + magnitude_tolerance);
  if (lowest - first > magnitude_tolerance) fit.lo = std::exp(lowest * fit.step);
  if (last - highest > magnitude_tolerance) fit.hi = std::exp(highest * fit.step);
  return lowest < highest;
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
    if (y < law.lower || y > law.upper()) return 1.0 - data.count(0, data.first_from(y)) / n;
    return parts[2] + parts[1] * (1.0 - law.cdf(y));
  };
  if (const double step = data.step(); step > 0.0) {
    const double end =
        law.of_u.finite() ? law.upper() : std::max(data.back(), law.quantile(1.0 - 1e-3 / n));
    std::vector<double> edges;
    for (double edge = edge_below(std::min(data.front(), law.lower) + 0.5 * step, step);
         edge < std::max(end, data.back()) + 0.5 * step; edge += step)
      edges.push_back(edge_below(edge + 0.5 * step, step));
    return Cells(survival, edges, n, true);
  }
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

PowerLawFit fit_power_law(const std::vector<double> &sorted, double lo, double hi, double step) {
  if (!(lo > 0.0 && std::isfinite(lo) && hi > lo))
    throw std::invalid_argument("power law: range " + number(lo) + " to " + number(hi) +
                                ", expected 0 < lower < upper");
  PowerLawFit fit;
  fit.lo = lo;
  fit.hi = hi;
  fit.step = step;
  if (step > 0.0 && !move_to_centres(fit))
    return without_numbers(fit, "fewer than two bins of magnitudes in the range");
  const LogSample sample(logs_between(sorted, fit.lo, fit.hi, step), step);
  fit.n = static_cast<std::int64_t>(sample.size());
  if (fit.n < least_events)
    return without_numbers(fit, number(fit.n) + " events in the range, at least 10 needed");
  if (sample.back() - sample.front() <= 1.5 * step)
    return without_numbers(fit, "all events in the range have the same size");
  const auto n = static_cast<double>(fit.n);
  const Estimate e = estimate(sample, std::log(fit.lo) - 0.5 * step, std::log(fit.hi) + 0.5 * step);
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
  if (step > 0.0)
    fit.log_likelihood =
        n * (b * (e.mean_u - 0.5 * step) + Exponential{step, b}.log_z() - e.law.of_u.log_z());
  else
    fit.log_likelihood = n * (b * e.mean_u - e.law.of_u.log_z()) - sample.sum(0, sample.size());
  return fit;
}

PowerLawFit search_range(const std::vector<double> &sorted, double least, double step) {
  const std::vector<double> values = between(sorted, least, infinity);
  const LogSample sample(logs_between(sorted, least, infinity, step), step);
  const Range range = best_range(sample);
  PowerLawFit fit;
  if (std::isfinite(range.distance) && step > 0.0) {
    fit = fit_power_law(sorted, std::exp(sample.lower_end(range.lo) + 0.5 * step),
                        std::exp(sample.upper_end(range.hi) - 0.5 * step), step);
  } else if (std::isfinite(range.distance)) {
    // Ends at the extremes of the sample must still include them after exp(log(x)) has been
    // rounded.
    fit = fit_power_law(sorted, range.lo == sample.front() ? values.front() : std::exp(range.lo),
                        range.hi == sample.back() ? values.back() : std::exp(range.hi));
  } else {
    fit.lo = least;
    fit.hi = infinity;
    fit.step = step;
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
  const double step = fit.step;
  const std::vector<double> logs = logs_between(sorted, fit.searched ? fit.least : fit.lo,
                                                fit.searched ? infinity : fit.hi, step);
  const LogSample data(logs, step);
  const std::size_t first = data.first_from(law.lower);
  const std::size_t last = data.first_above(std::log(fit.hi) + 0.5 * step);
  const auto n = static_cast<double>(data.size());
  const double below = data.count(0, first), inside = data.count(first, last);
  const double parts[3] = {below / n, inside / n, (n - below - inside) / n};
  // Distance between a sample and its best fit, found as for the data.
  const auto distance_of = [&](const LogSample &sample) {
    if (fit.searched) return best_range(sample).distance;
    const Estimate e = estimate(sample, law.lower, law.upper());
    return e.usable ? distance(sample, e) : infinity;
  };
  if (step > 0.0 || data.size() > static_cast<std::size_t>(largest_exact_sample)) {
    const Cells cells = cells_of(data, law, parts);
    return cells.share_as_far(logs, replicas, seed, [&](const std::vector<double> &counts, double) {
      return distance_of(LogSample(cells, counts, step));
    });
  }
  const Rng stream = generator(seed);
  gsl_rng *const rng = stream.get();
  const auto draw = [&] {
    std::vector<double> drawn;
    drawn.reserve(data.size());
    unsigned int counts[3];
    gsl_ran_multinomial(rng, 3, static_cast<unsigned int>(data.size()), parts, counts);
    append_resampled(drawn, data.y(), 0, first, counts[0], rng);
    append_ordered(drawn, counts[1], rng, [&](double u) { return law.quantile(u); });
    append_resampled(drawn, data.y(), last, data.size(), counts[2], rng);
    return drawn;
  };
  return share_of_draws(replicas, draw, [&](std::vector<double> drawn) {
    return distance_of(LogSample(std::move(drawn), 0.0)) >= fit.ks;
  });
}

namespace {

// A rival exp(b u - c T(u)) as a logarithm of its density.
struct Tilted {
  Statistic statistic;
  TiltedFit fit = {};
  double mean_u = 0.0, norm = 0.0;

  double operator()(double u) const {
    return statistic.rate > 0.0 ? fit.b * u - fit.c * std::exp(u) - norm
                                : fit.b * u - fit.c * u * u - norm;
  }
  // Fits to means, and returns a number that no longer changes at the maximum.
  auto fitting(double length) {
    return [this, length](const auto &mean) {
      mean_u = mean([](double u) { return u; });
      const double mean_t = mean([this](double u) { return statistic(u); });
      fit = fit_tilted(statistic, mean_u, mean_t, length);
      norm = fit.b * mean_u - fit.c * mean_t - fit.log_likelihood;
      return fit.b;
    };
  }
  bool decided() const { return fit.converged && fit.c > 0.0; }
};

// Comparisons of a power law with other laws for the same sample, in u = ln(x / lower end). The
// likelihood of a bin is the integral of the density over it, by the points of a quadrature.
class Contest {
 public:
  Contest(const std::vector<double> &sorted, const PowerLawFit &fit)
      : lo_(fit.lower_end()), hi_(fit.upper_end()), law_(fit) {
    if (fit.step > 0.0) {
      spread_over_bins(logs_between(sorted, fit.lo, fit.hi, fit.step), fit.step);
    } else {
      u_ = logs_of(between(sorted, fit.lo, fit.hi));
      for (double &u : u_) u -= law_.lower;
      n_ = static_cast<double>(u_.size());
    }
  }

  // In t = (x - lo) / width, an exponential has the same form as the power law in u.
  Comparison exponential() const {
    const bool finite = law_.of_u.finite();
    const double width = finite ? hi_ - lo_ : lo_, scale = lo_ / width;
    Exponential rival{};
    double norm = 0.0;
    const auto density = [&](double u) { return rival.b * std::expm1(u) * scale - norm + u; };
    find(density, [&](const auto &mean) {
      rival = Exponential::of_mean(mean([](double u) { return std::expm1(u); }) * scale,
                                   finite ? 1.0 : infinity);
      norm = rival.log_z() - std::log(scale);
      return rival.b;
    });
    return vuong("exponential", {{"rate", -rival.b / width}}, density);
  }

  Comparison log_normal() const {
    Tilted rival{{0.0}};
    find(rival, rival.fitting(law_.of_u.length));
    if (!rival.decided())
      return undecided("log-normal", rival,
                       "the best log-normal is its limit, the power law itself");
    // Parameters of ln x: mu is that of the untruncated normal and may lie far below the range.
    return vuong("log-normal",
                 {{"mu", law_.lower + rival.fit.b / (2.0 * rival.fit.c)},
                  {"sigma", 1.0 / std::sqrt(2.0 * rival.fit.c)}},
                 rival);
  }

  Comparison cut_off() const {
    const char *const name = "power law with exponential cut-off";
    Tilted rival{{1.0}};
    find(rival, rival.fitting(law_.of_u.length));
    if (!rival.decided())
      return undecided(name, rival, "the best cut-off is infinite: the power law itself");
    const double gain =
        weights_.empty()
            ? n_ * (rival.fit.log_likelihood - (law_.of_u.b * rival.mean_u - law_.of_u.log_z()))
            : -n_ * mean_of_bins([&](std::size_t bin) { return advantage(bin, rival); });
    return {name,
            {{"alpha", 1.0 - rival.fit.b}, {"cut-off", lo_ / rival.fit.c}},
            -gain,
            -2.0 * gain,
            gsl_cdf_chisq_Q(std::max(0.0, 2.0 * gain), 1.0)};
  }

 private:
  static constexpr std::size_t points = 16;  // of the quadrature in a bin

  static Comparison undecided(const char *name, const Tilted &rival, const char *border) {
    Comparison out;
    out.rival = name;
    out.degenerate = true;
    out.why = rival.fit.converged ? border : "no optimum found";
    return out;
  }

  void spread_over_bins(const std::vector<double> &centres, double step) {
    static const Gsl<gsl_integration_glfixed_table> rule(
        gsl_integration_glfixed_table_alloc(points), gsl_integration_glfixed_table_free);
    n_ = static_cast<double>(centres.size());
    for (auto at = centres.begin(); at != centres.end();) {
      const auto end = std::upper_bound(at, centres.end(), *at);
      counts_.push_back(static_cast<double>(end - at));
      const double from = *at - 0.5 * step - law_.lower;
      for (std::size_t i = 0; i < points; ++i) {
        u_.emplace_back();
        weights_.emplace_back();
        gsl_integration_glfixed_point(from, from + step, i, &u_.back(), &weights_.back(),
                                      rule.get());
      }
      at = end;
    }
  }

  // The logarithm of the integral of a density over a bin, and with it the mean of a function
  // there.
  template <class LogDensity, class F>
  std::pair<double, double> integral(std::size_t bin, const LogDensity &density, const F &f) const {
    double logs[points], top = -infinity, sum = 0.0, of_f = 0.0;
    for (std::size_t i = 0; i < points; ++i) {
      logs[i] = density(u_[bin * points + i]);
      top = std::max(top, logs[i]);
    }
    for (std::size_t i = 0; i < points; ++i) {
      const double p = weights_[bin * points + i] * std::exp(logs[i] - top);
      sum += p;
      of_f += p * f(u_[bin * points + i]);
    }
    return {top + std::log(sum), of_f / sum};
  }

  template <class F>
  double mean_of_bins(const F &f) const {
    NeumaierSum sum;
    for (std::size_t bin = 0; bin < counts_.size(); ++bin) sum.add(counts_[bin] * f(bin));
    return sum.value() / n_;
  }

  // Fits a rival. `fit` gets a function that returns the means over the sample. Within bins, these
  // are the means under the rival itself, which changes with them: the algorithm of expectation and
  // maximization (Dempster, Laird & Rubin 1977) ends at the maximum of the likelihood of the
  // counts.
  template <class LogDensity, class FitToMeans>
  void find(const LogDensity &density, const FitToMeans &fit) const {
    if (weights_.empty()) {
      fit([this](const auto &f) { return mean_of(f); });
      return;
    }
    const auto flat = [](double) { return 0.0; };
    double last = fit([&](const auto &f) {
      return mean_of_bins([&](std::size_t bin) { return integral(bin, flat, f).second; });
    });
    for (int i = 0; i < 200; ++i) {
      const double next = fit([&](const auto &f) {
        return mean_of_bins([&](std::size_t bin) { return integral(bin, density, f).second; });
      });
      if (std::fabs(next - last) <= 1e-9 * std::fabs(next)) return;
      last = next;
    }
  }

  template <class F>
  double mean_of(const F &f) const {
    NeumaierSum sum;
    for (double u : u_) sum.add(f(u));
    return sum.value() / static_cast<double>(u_.size());
  }

  // By how much the logarithm of the likelihood of a bin is larger for the power law.
  template <class LogDensity>
  double advantage(std::size_t bin, const LogDensity &rival) const {
    const auto flat = [](double) { return 0.0; };
    const double b = law_.of_u.b, log_z = law_.of_u.log_z();
    const auto law = [b, log_z](double u) { return b * u - log_z; };
    return integral(bin, law, flat).first - integral(bin, rival, flat).first;
  }

  // Vuong's test in u: the Jacobian of the change of variables cancels in the likelihood ratio.
  template <class LogDensity>
  Comparison vuong(const char *name, std::vector<std::pair<std::string, double>> parameters,
                   const LogDensity &rival) const {
    const double log_z = law_.of_u.log_z();
    const auto difference = [&](double u) { return law_.of_u.b * u - log_z - rival(u); };
    const auto average = [&](const auto &change) {
      return weights_.empty()
                 ? mean_of([&](double u) { return change(difference(u)); })
                 : mean_of_bins([&](std::size_t bin) { return change(advantage(bin, rival)); });
    };
    const double mean = average([](double one) { return one; });
    const double deviation =
        std::sqrt(average([mean](double one) { return std::pow(one - mean, 2); }));
    const double normalised = deviation > 0.0 ? std::sqrt(n_) * mean / deviation : 0.0;
    return {name, std::move(parameters), n_ * mean, normalised,
            std::erfc(std::fabs(normalised) / std::sqrt(2.0))};
  }

  double lo_, hi_;
  Law law_;
  std::vector<double> u_;                 // values; in bins, points of the quadrature
  std::vector<double> weights_, counts_;  // in bins: of the points, and of the values in each bin
  double n_ = 0.0;
};

}  // namespace

std::vector<Comparison> compare(const std::vector<double> &sorted, const PowerLawFit &fit) {
  if (fit.degenerate)
    throw std::invalid_argument("comparison with a degenerate power law: " + fit.why);
  const Contest contest(sorted, fit);
  return {contest.exponential(), contest.log_normal(), contest.cut_off()};
}

}  // namespace LSM::postproc
