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
#include "lsm_sum.h"
#include "lsm_text_io.h"
#include "replicas.h"
#include "truncated_family.h"

namespace LSM::postproc {

namespace {

using text_io::number;

constexpr std::int64_t least_events = 10;

// Logarithms of a sample in ascending order and their running sums, so that the exponent of any
// range costs two look-ups.
class LogSample {
 public:
  explicit LogSample(std::vector<double> logs) : y_(std::move(logs)) {
    NeumaierSum sum;
    sums_.reserve(y_.size() + 1);
    sums_.push_back(0.0);
    for (double y : y_) {
      sum.add(y);
      sums_.push_back(sum.value());
    }
  }

  const std::vector<double> &y() const { return y_; }
  std::size_t size() const { return y_.size(); }
  double front() const { return y_.front(); }
  double back() const { return y_.back(); }
  double sum(std::size_t first, std::size_t last) const { return sums_[last] - sums_[first]; }
  double count(std::size_t first, std::size_t last) const {
    return static_cast<double>(last - first);
  }
  /// A range that is asked for, as far as the sample can tell its ends.
  double lower_end(double lower) const { return lower; }
  double upper_end(double upper) const { return upper; }
  /// Index of the first value at or above y, or above it.
  std::size_t first_from(double y) const {
    return static_cast<std::size_t>(std::lower_bound(y_.begin(), y_.end(), y) - y_.begin());
  }
  std::size_t first_above(double y) const {
    return static_cast<std::size_t>(std::upper_bound(y_.begin(), y_.end(), y) - y_.begin());
  }

  SortedValues points(std::size_t first, std::size_t last) const {
    return {y_.data() + first, last - first};
  }

 private:
  std::vector<double> y_, sums_;
};

// The same by cells: ranges begin and end at edges, and an index is that of an edge.
class CountedLogs {
 public:
  CountedLogs(const Cells &cells, const std::vector<double> &counts)
      : edges_(cells.edges()), below_(edges_.size()), sums_(edges_.size()) {
    NeumaierSum sum;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      sum.add(counts[i] * cells.centres()[i]);
      below_[i + 1] = below_[i] + counts[i];
      sums_[i + 1] = sum.value();
    }
  }

  std::size_t size() const { return static_cast<std::size_t>(below_.back()); }
  double front() const { return *(edge(std::upper_bound(below_.begin(), below_.end(), 0.0)) - 1); }
  double back() const {
    return *edge(std::lower_bound(below_.begin(), below_.end(), below_.back()));
  }
  double sum(std::size_t first, std::size_t last) const { return sums_[last] - sums_[first]; }
  double count(std::size_t first, std::size_t last) const { return below_[last] - below_[first]; }
  double lower_end(double lower) const { return edges_[first_from(lower)]; }
  double upper_end(double upper) const {
    return std::isfinite(upper) ? edges_[first_above(upper)] : upper;
  }
  /// Index of the first edge at or above y, or of the last one at or below it.
  std::size_t first_from(double y) const {
    const auto at = std::lower_bound(edges_.begin(), edges_.end() - 1, y - rounding);
    return static_cast<std::size_t>(at - edges_.begin());
  }
  std::size_t first_above(double y) const {
    const auto at = std::upper_bound(edges_.begin() + 1, edges_.end(), y + rounding);
    return static_cast<std::size_t>(at - edges_.begin()) - 1;
  }
  CountedEdges points(std::size_t first, std::size_t last) const {
    return {edges_.data() + first, below_.data() + first, last - first + 1};
  }

 private:
  static constexpr double rounding = 1e-12;  // of logarithms

  std::vector<double>::const_iterator edge(std::vector<double>::const_iterator below) const {
    return edges_.begin() + (below - below_.begin());
  }

  const std::vector<double> &edges_;
  std::vector<double> below_, sums_;
};

// Power law on [lower, lower + length] in logarithms: density in u ~ exp(b u).
struct Law {
  double lower, length, b;

  bool finite() const { return std::isfinite(length); }
  // Logarithm of the integral of exp(b u).
  double log_z() const {
    return finite() ? std::log(length) + log_normalisation(b * length) : -std::log(-b);
  }
  double cdf(double y) const {
    const double u = y - lower;
    if (!finite()) return -std::expm1(b * u);
    const double z = b * length;
    if (std::fabs(z) < 1e-12) return u / length;
    if (z < 0.0) return std::expm1(b * u) / std::expm1(z);
    // The same without overflow.
    return std::exp(b * (u - length)) * std::expm1(-b * u) / std::expm1(-z);
  }
  double quantile(double probability) const {
    if (!finite()) return lower + std::log1p(-probability) / b;
    const double z = b * length;
    if (std::fabs(z) < 1e-12) return lower + probability * length;
    double u = 0.0;
    if (z < 0.0)
      u = std::log1p(probability * std::expm1(z)) / b;
    else  // counted from the upper end, where exp(z) does not overflow
      u = length + std::log1p((probability - 1.0) * -std::expm1(-z)) / b;
    return lower + std::clamp(u, 0.0, length);
  }
};

struct Estimate {
  std::size_t first, last;  // indices of the range
  Law law;
  double mean_u;
  bool usable;  // an interior optimum exists
};

template <class Sample>
Estimate estimate(const Sample &sample, double lower, double upper) {
  const std::size_t first = sample.first_from(lower), last = sample.first_above(upper);
  lower = sample.lower_end(lower);
  upper = sample.upper_end(upper);
  Estimate e{first, last, {lower, upper - lower, 0.0}, 0.0, false};
  if (last <= first || !(sample.count(first, last) > 0.0)) return e;
  e.mean_u = sample.sum(first, last) / sample.count(first, last) - lower;
  if (e.law.finite()) {
    const double mean = e.mean_u / e.law.length;
    e.usable = mean > 1e-9 && mean < 1.0 - 1e-9;
    if (e.usable) e.law.b = tilt_of_mean(mean) / e.law.length;
  } else {
    e.usable = e.mean_u > 1e-9;
    if (e.usable) e.law.b = -1.0 / e.mean_u;
  }
  return e;
}

double standard_error(const Estimate &e) {
  const auto n = static_cast<double>(e.last - e.first);
  if (!e.law.finite()) return -e.law.b / std::sqrt(n);
  return 1.0 / (e.law.length * std::sqrt(n * tilted_variance(e.law.b * e.law.length)));
}

// Kolmogorov-Smirnov distance between the sample and the law on the range, exact up to give_up.
template <class Sample>
double distance(const Sample &sample, const Estimate &e,
                double give_up = std::numeric_limits<double>::infinity()) {
  const auto cdf = [&e](double y) { return e.law.cdf(y); };
  return KsDistance(sample.points(e.first, e.last), cdf)(give_up);
}

struct Range {
  double lo = 0.0, hi = 0.0;
  double distance = std::numeric_limits<double>::infinity();
};

// Candidate number k of a search between the logarithms first and last.
double candidate(double first, double last, int k, int count) {
  if (k == count - 1) return last;
  return first + (last - first) * k / (count - 1);
}

// The range, in logarithms, of least distance; infinite distance if none qualifies.
template <class Sample>
Range best_range(const Sample &sample, const RangeSearch &search) {
  Range best;
  if (sample.size() == 0) return best;
  const double first = sample.front(), last = sample.back();
  const double log_ratio = std::log(search.min_ratio);
  const int lowers = search.lower ? search.candidates : 1;
  const int uppers = search.upper ? search.candidates : 1;
  for (int i = 0; i < lowers; ++i) {
    const double lower =
        search.lower ? candidate(first, last, i, search.candidates) : std::log(search.lo);
    for (int j = 0; j < uppers; ++j) {
      const double upper =
          search.upper ? candidate(first, last, j, search.candidates) : std::log(search.hi);
      if (!(upper > lower) || upper - lower < log_ratio) continue;
      const Estimate e = estimate(sample, lower, upper);
      if (!e.usable || sample.count(e.first, e.last) < static_cast<double>(search.min_events))
        continue;
      const double d = distance(sample, e, best.distance);
      if (d < best.distance) best = {lower, upper, d};
    }
  }
  return best;
}

void check_sorted(const std::vector<double> &sorted) {
  if (!std::is_sorted(sorted.begin(), sorted.end()))
    throw std::invalid_argument("power law: sample is not in ascending order");
}

// Logarithms of the values in [lo, hi] that are positive and finite.
LogSample logs_between(const std::vector<double> &sorted, double lo, double hi) {
  const auto first = lo > 0.0 ? std::lower_bound(sorted.begin(), sorted.end(), lo)
                              : std::upper_bound(sorted.begin(), sorted.end(), 0.0);
  const auto last =
      std::upper_bound(first, sorted.end(), std::min(hi, std::numeric_limits<double>::max()));
  std::vector<double> logs(first, last);
  for (double &y : logs) y = std::log(y);
  return LogSample(std::move(logs));
}

void check_range(double lo, double hi) {
  if (!(lo > 0.0 && std::isfinite(lo) && hi > lo))
    throw std::invalid_argument("power law: range " + number(lo) + " to " + number(hi) +
                                ", expected 0 < lower < upper");
}

void check_search(const RangeSearch &search) {
  const std::string what = "search for a power-law range: ";
  if (!search.lower && !search.upper)
    throw std::invalid_argument(what + "neither cut is searched, expected at least one");
  if (search.candidates < 2 || search.min_events < least_events || !(search.min_ratio > 1.0))
    throw std::invalid_argument(what +
                                "expected at least 2 candidates, at least 10 events, and a ratio "
                                "of the cuts above 1");
  if (!search.lower || search.lo != 0.0) check_range(search.lo, search.hi);
  if (!(search.hi > 0.0))
    throw std::invalid_argument(what + "upper limit " + number(search.hi) +
                                ", expected a positive number");
}

// Appends count numbers drawn from [0, 1), already in ascending order, turned into values: the
// gaps between ordered uniform numbers are exponential variables over their sum.
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

// Cells of what replicas are drawn from: the law within its range, the data outside of it.
Cells cells_of(const LogSample &data, const Law &law, const double (&parts)[3]) {
  const double upper = law.lower + law.length;
  const auto n = static_cast<double>(data.size());
  const auto survival = [&](double y) {
    if (y < law.lower || y > upper) return 1.0 - static_cast<double>(data.first_from(y)) / n;
    return parts[2] + parts[1] * (1.0 - law.cdf(y));
  };
  std::vector<double> edges = {law.lower};
  // Just beyond the data, so that the least and the greatest are within a cell.
  const auto room = [](double y) { return 1e-9 * (1.0 + std::fabs(y)); };
  if (parts[0] > 0.0) edges.insert(edges.begin(), data.front() - room(data.front()));
  if (law.finite()) edges.push_back(upper);
  if (!law.finite() || parts[2] > 0.0) {
    // Without an end, to where a thousandth of a value is left.
    const double end =
        law.finite() ? data.back() : std::max(data.back(), law.quantile(1.0 - 1e-3 / n));
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
  check_sorted(sorted);
  check_range(lo, hi);
  const LogSample sample = logs_between(sorted, lo, hi);
  PowerLawFit fit;
  fit.lo = lo;
  fit.hi = hi;
  fit.n = static_cast<std::int64_t>(sample.size());
  if (fit.n < least_events) {
    fit.why = number(fit.n) + " events in the range, at least 10 needed";
    return fit;
  }
  if (sample.y().front() == sample.y().back()) {
    fit.why = "all events in the range have the same size";
    return fit;
  }
  const Estimate e = estimate(sample, std::log(lo), std::log(hi));
  if (!e.usable) {
    fit.why = "all events lie at one edge of the range";
    return fit;
  }
  const double error = standard_error(e);
  if (!(error <= std::max(1.0, std::fabs(e.law.b)))) {
    fit.why =
        "the range is too narrow for " + number(fit.n) + " events: the exponent is not determined";
    return fit;
  }
  const auto n = static_cast<double>(fit.n);
  fit.degenerate = false;
  fit.alpha = 1.0 - e.law.b;
  fit.standard_error = error;
  fit.ks = distance(sample, e);
  fit.log_likelihood = n * (e.law.b * e.mean_u - e.law.log_z()) - sample.sum(0, sample.size());
  return fit;
}

PowerLawFit search_range(const std::vector<double> &sorted, const RangeSearch &search) {
  check_sorted(sorted);
  check_search(search);
  const LogSample sample = logs_between(sorted, search.lo, search.hi);
  const Range range = best_range(sample, search);
  PowerLawFit fit;
  if (std::isfinite(range.distance)) {
    // Cuts at extremes of the sample must still contain them after exp(log(x)).
    double lo = search.lower ? std::exp(range.lo) : search.lo;
    double hi = search.upper ? std::exp(range.hi) : search.hi;
    const auto smallest = search.lo > 0.0
                              ? std::lower_bound(sorted.begin(), sorted.end(), search.lo)
                              : std::upper_bound(sorted.begin(), sorted.end(), 0.0);
    if (search.lower && range.lo == sample.y().front()) lo = *smallest;
    if (search.upper && range.hi == sample.y().back())
      hi = *(smallest + static_cast<std::ptrdiff_t>(sample.size()) - 1);
    fit = fit_power_law(sorted, lo, hi);
  } else {
    fit.lo = search.lo;
    fit.hi = search.hi;
    fit.n = static_cast<std::int64_t>(sample.size());
    fit.why = "no range holds " + number(search.min_events) + " events over a ratio of " +
              number(search.min_ratio);
  }
  fit.searched = true;
  fit.search = search;
  return fit;
}

double p_value(const PowerLawFit &fit, const std::vector<double> &sorted, int replicas,
               std::uint64_t seed) {
  check_sorted(sorted);
  if (fit.degenerate) throw std::invalid_argument("p-value of a degenerate power law: " + fit.why);
  if (replicas < 1)
    throw std::invalid_argument("p-value: " + std::to_string(replicas) +
                                " replicas, expected at least 1");
  const Law law{std::log(fit.lo), std::log(fit.hi) - std::log(fit.lo), 1.0 - fit.alpha};
  const LogSample data = fit.searched ? logs_between(sorted, fit.search.lo, fit.search.hi)
                                      : logs_between(sorted, fit.lo, fit.hi);
  const std::size_t first = data.first_from(std::log(fit.lo));
  const std::size_t last = data.first_above(std::log(fit.hi));
  const auto n = static_cast<double>(data.size());
  const double parts[3] = {static_cast<double>(first) / n, static_cast<double>(last - first) / n,
                           static_cast<double>(data.size() - last) / n};
  // Distance of the best fit to a sample, found as that of the data was.
  const auto distance_of = [&](const auto &sample) {
    if (fit.searched) return best_range(sample, fit.search).distance;
    const Estimate e = estimate(sample, law.lower, law.lower + law.length);
    return e.usable ? distance(sample, e) : std::numeric_limits<double>::infinity();
  };
  if (data.size() > static_cast<std::size_t>(largest_exact_sample)) {
    const Cells cells = cells_of(data, law, parts);
    const double found = distance_of(CountedLogs(cells, cells.count(data.y())));
    return share_of_replicas(replicas, [&](int replica) {
      const Rng rng = generator(seed_of_replica(seed, replica));
      return distance_of(CountedLogs(cells, cells.draw(rng.get(), data.size()))) >= found;
    });
  }
  const auto draw = [&](gsl_rng *rng) {
    std::vector<double> logs;
    logs.reserve(data.size());
    unsigned int counts[3];
    gsl_ran_multinomial(rng, 3, static_cast<unsigned int>(data.size()), parts, counts);
    append_resampled(logs, data.y(), 0, first, counts[0], rng);
    append_ordered(logs, counts[1], rng, [&](double u) { return law.quantile(u); });
    append_resampled(logs, data.y(), last, data.size(), counts[2], rng);
    return logs;
  };
  return share_of_samples(replicas, seed, draw, [&](std::vector<double> logs) {
    return distance_of(LogSample(std::move(logs))) >= fit.ks;
  });
}

std::vector<Comparison> compare(const std::vector<double> &sorted, const PowerLawFit &fit) {
  check_sorted(sorted);
  if (fit.degenerate)
    throw std::invalid_argument("comparison with a degenerate power law: " + fit.why);
  const LogSample sample = logs_between(sorted, fit.lo, fit.hi);
  const std::vector<double> &y = sample.y();
  const auto n = static_cast<double>(y.size());
  const double lower = std::log(fit.lo), length = std::log(fit.hi) - lower;
  const double b = 1.0 - fit.alpha;
  const double log_z = Law{lower, length, b}.log_z();

  // Ratio of likelihoods in u = ln(x / lo); the change of variables is the same on both sides.
  const auto vuong = [&](Comparison &result, const auto &rival_log_density) {
    NeumaierSum sum, squares;
    const auto difference = [&](double u) { return b * u - log_z - rival_log_density(u); };
    for (double value : y) sum.add(difference(value - lower));
    const double mean = sum.value() / n;
    for (double value : y) squares.add(std::pow(difference(value - lower) - mean, 2));
    const double deviation = std::sqrt(squares.value() / n);
    result.log_likelihood_ratio = sum.value();
    if (deviation > 0.0) result.normalised = sum.value() / (std::sqrt(n) * deviation);
    result.p = std::erfc(std::fabs(result.normalised) / std::sqrt(2.0));
  };
  const auto mean_of = [&](const auto &f) {
    NeumaierSum sum;
    for (double value : y) sum.add(f(value - lower));
    return sum.value() / n;
  };

  Comparison exponential;
  exponential.rival = "exponential";
  {
    // The exponential in t = (x - lo) / width has the form of the power law in u.
    const double width = std::isfinite(fit.hi) ? fit.hi - fit.lo : fit.lo;
    const double mean = mean_of([&](double u) { return std::expm1(u); }) * fit.lo / width;
    const double z = std::isfinite(fit.hi) ? tilt_of_mean(mean) : -1.0 / mean;
    const double log_norm = std::isfinite(fit.hi) ? log_normalisation(z) : -std::log(-z);
    const double log_jacobian = std::log(fit.lo / width);
    vuong(exponential, [&](double u) {
      return z * std::expm1(u) * fit.lo / width - log_norm + u + log_jacobian;
    });
    exponential.parameters = {{"rate", -z / width}};
  }

  const double mean_u = mean_of([](double u) { return u; });
  Comparison normal;
  normal.rival = "log-normal";
  {
    const TiltedFit rival =
        fit_tilted({0.0}, mean_u, mean_of([](double u) { return u * u; }), length);
    if (rival.border || !rival.converged) {
      normal.degenerate = true;
      normal.why = rival.border ? "the best log-normal is its limit, the power law itself"
                                : "no optimum found";
    } else {
      const double norm = rival.b * mean_u - rival.c * mean_of([](double u) { return u * u; }) -
                          rival.log_likelihood;
      vuong(normal, [&](double u) { return rival.b * u - rival.c * u * u - norm; });
      // In ln x; mu is that of the untruncated normal and can lie far below the range.
      normal.parameters = {{"mu", lower + rival.b / (2.0 * rival.c)},
                           {"sigma", 1.0 / std::sqrt(2.0 * rival.c)}};
    }
  }

  Comparison cut_off;
  cut_off.rival = "power law with exponential cut-off";
  cut_off.nested = true;
  {
    const TiltedFit rival =
        fit_tilted({1.0}, mean_u, mean_of([](double u) { return std::exp(u); }), length);
    if (rival.border || !rival.converged) {
      cut_off.degenerate = true;
      cut_off.why =
          rival.border ? "the best cut-off is infinite: the power law itself" : "no optimum found";
    } else {
      const double gain = n * (rival.log_likelihood - (b * mean_u - log_z));
      cut_off.log_likelihood_ratio = -gain;
      cut_off.normalised = -2.0 * gain;
      cut_off.p = gsl_cdf_chisq_Q(std::max(0.0, 2.0 * gain), 1.0);
      cut_off.parameters = {{"alpha", 1.0 - rival.b}, {"cut-off", fit.lo / rival.c}};
    }
  }
  return {exponential, normal, cut_off};
}

double power_law_cdf(double x, double alpha, double lo, double hi) {
  check_range(lo, hi);
  const double lower = std::log(lo);
  return Law{lower, std::log(hi) - lower, 1.0 - alpha}.cdf(std::log(x));
}

double power_law_quantile(double probability, double alpha, double lo, double hi) {
  check_range(lo, hi);
  const double lower = std::log(lo);
  return std::exp(Law{lower, std::log(hi) - lower, 1.0 - alpha}.quantile(probability));
}

}  // namespace LSM::postproc
