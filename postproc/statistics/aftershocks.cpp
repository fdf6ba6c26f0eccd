// SPDX-License-Identifier: GPL-2.0-or-later
#include "aftershocks.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multimin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "log_histogram.h"
#include "lsm_random.h"
#include "lsm_sum.h"
#include "replicas.h"
#include "samples.h"

namespace LSM::postproc {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t fewest = 20;

// Integral of (t + c)^-p from a to b, p near 1 included.
double omori_integral(double a, double b, double c, double p) {
  const double low = std::log(a + c), high = std::log(b + c), q = 1.0 - p;
  const double z = q * (high - low);
  return std::exp(q * low) * (high - low) *
         (std::fabs(z) < 1e-8 ? 1.0 + 0.5 * z : std::expm1(z) / z);
}

// ln L as a function of the numbers of aftershocks and background events expected, c and p.
class Likelihood {
 public:
  explicit Likelihood(const Sequences &s)
      : first_(s.first), window_(s.window), n_(static_cast<double>(s.times.size())) {
    // Of many, those within 3 % are taken together by the mean and the variance of their
    // logarithms, in which the logarithm of the rate hardly bends: an evaluation costs no more for
    // more of them.
    together_ = n_ > static_cast<double>(largest_exact_sample);
    const double width = together_ ? 1.03 : 1.0;
    for (std::size_t i = 0; i < s.times.size();) {
      std::size_t end = i + 1;
      while (end < s.times.size() && s.times[end] <= width * s.times[i]) ++end;
      Cell cell{s.times[i], static_cast<double>(end - i), 0.0};
      if (together_ && end > i + 1 && cell.time > 0.0) {
        NeumaierSum sum, squares;  // of ln(time / first time of the cell)
        for (std::size_t k = i; k < end; ++k) {
          const double ratio = std::log(s.times[k] / s.times[i]);
          sum.add(ratio);
          squares.add(ratio * ratio);
        }
        const double mean = sum.value() / cell.count;
        cell.time *= std::exp(mean);
        cell.variance = std::max(0.0, squares.value() / cell.count - mean * mean);
      }
      cells_.push_back(cell);
      i = end;
    }
  }

  double operator()(double aftershocks, double background, double c, double p) const {
    const double scale = aftershocks / omori_integral(first_, window_, c, p);
    const double flat = background / (window_ - first_);
    if (!std::isfinite(scale)) return -HUGE_VAL;
    NeumaierSum sum;
    for (const Cell &cell : cells_) {
      const double decaying = scale * std::exp(-p * std::log(cell.time + c));
      double value = std::log(decaying + flat);
      if (together_) {
        // half the second derivative of ln rate by ln t, times the variance of ln t
        const double share = decaying / (decaying + flat), q = cell.time / (cell.time + c);
        value -= 0.5 * cell.variance * p * q * share * (1.0 - q - p * q * (1.0 - share));
      }
      sum.add(cell.count * value);
    }
    return sum.value() - aftershocks - background;
  }
  double constant() const { return n_ * std::log(n_ / (window_ - first_)) - n_; }
  double n() const { return n_; }

 private:
  /// Times that are taken as one, and the variance of their logarithms.
  struct Cell {
    double time, count, variance;
  };

  std::vector<Cell> cells_;
  double first_, window_, n_;
  bool together_ = false;
};

// What is searched: at the maximum as many events are expected as there are, so one share is
// enough.
struct Search {
  const Likelihood *likelihood;
  double hold_c;  // NaN: fitted
  bool background;
  double least_ln_c, most_ln_c;

  // Order: logit of the share of aftershocks (if there is a background), ln c (if fitted), p.
  std::size_t size() const { return 1U + (background ? 1U : 0U) + (std::isnan(hold_c) ? 1U : 0U); }
  struct Point {
    double share, c, p;
  };
  Point at(const gsl_vector *x) const {
    std::size_t i = 0;
    Point point{1.0, hold_c, 0.0};
    if (background) point.share = 1.0 / (1.0 + std::exp(-gsl_vector_get(x, i++)));
    if (std::isnan(hold_c)) point.c = std::exp(gsl_vector_get(x, i++));
    point.p = gsl_vector_get(x, i);
    return point;
  }
  double cost(const gsl_vector *x) const {
    const Point point = at(x);
    if (std::isnan(hold_c) && !(std::log(point.c) >= least_ln_c && std::log(point.c) <= most_ln_c))
      return 1e300;
    if (!(std::fabs(point.p) < 20.0)) return 1e300;
    const double n = likelihood->n();
    const double value = (*likelihood)(n * point.share, n * (1.0 - point.share), point.c, point.p);
    return std::isfinite(value) ? -value : 1e300;
  }
};

struct Maximum {
  Search::Point point{1.0, nan, nan};
  double log_likelihood = -HUGE_VAL;
};

/// From a start to where the simplex is smaller than tolerance.
Maximum climb(const Search &search, double share, double ln_c, double p, double tolerance) {
  const std::size_t size = search.size();
  gsl_multimin_function function;
  function.n = size;
  function.params = const_cast<Search *>(&search);
  function.f = [](const gsl_vector *x, void *data) {
    return static_cast<const Search *>(data)->cost(x);
  };
  const Gsl<gsl_vector> x = gsl_vector_of(size), step = gsl_vector_of(size);
  std::size_t i = 0;
  if (search.background) {
    gsl_vector_set(step.get(), i, 1.0);
    share = std::clamp(share, 1e-9, 1.0 - 1e-9);
    gsl_vector_set(x.get(), i++, std::log(share / (1.0 - share)));
  }
  if (std::isnan(search.hold_c)) {
    gsl_vector_set(step.get(), i, 1.0);
    gsl_vector_set(x.get(), i++, ln_c);
  }
  gsl_vector_set(step.get(), i, 0.3);
  gsl_vector_set(x.get(), i, p);
  const Gsl<gsl_multimin_fminimizer> work(
      gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, size),
      gsl_multimin_fminimizer_free);
  gsl_multimin_fminimizer_set(work.get(), &function, x.get(), step.get());
  for (int k = 0; k < 500; ++k)
    if (gsl_multimin_fminimizer_iterate(work.get()) != GSL_SUCCESS ||
        gsl_multimin_fminimizer_size(work.get()) < tolerance)
      break;
  gsl_vector_memcpy(x.get(), gsl_multimin_fminimizer_x(work.get()));
  return {search.at(x.get()), -gsl_multimin_fminimizer_minimum(work.get())};
}

// Covariance of the variables of a function at its maximum, by central differences; empty if the
// function has none there.
template <class Function>
std::vector<double> covariance_at_maximum(const Function &f, const std::vector<double> &x,
                                          const std::vector<double> &step) {
  const std::size_t n = x.size();
  std::vector<double> information(n * n);
  const auto shifted = [&](std::size_t i, double a, std::size_t j, double b) {
    std::vector<double> at = x;
    at[i] += a * step[i];
    at[j] += b * step[j];
    return f(at);
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const double second = i == j ? (shifted(i, 1, i, 0) - 2.0 * f(x) + shifted(i, -1, i, 0))
                                   : 0.25 * (shifted(i, 1, j, 1) - shifted(i, 1, j, -1) -
                                             shifted(i, -1, j, 1) + shifted(i, -1, j, -1));
      information[i * n + j] = information[j * n + i] = -second / (step[i] * step[j]);
    }
  gsl_matrix_view matrix = gsl_matrix_view_array(information.data(), n, n);
  if (gsl_linalg_cholesky_decomp1(&matrix.matrix) != GSL_SUCCESS ||
      gsl_linalg_cholesky_invert(&matrix.matrix) != GSL_SUCCESS)
    return {};
  return information;
}

double error_of(const std::vector<double> &gradient, const std::vector<double> &covariance) {
  double variance = 0.0;
  const std::size_t n = gradient.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      variance += gradient[i] * covariance[i * n + j] * gradient[j];
  return std::sqrt(variance);
}

}  // namespace

std::vector<Shock> shocks_of(const EventTable &table) {
  std::vector<Shock> shocks;
  shocks.reserve(table.events.size());
  for (const Event &event : table.events)
    shocks.push_back({event.t_start, event.t_end, event.size});
  return shocks;
}

Sequences stack_sequences(const std::vector<Shock> &events, const SequenceRule &rule) {
  if (!(rule.window > 0.0) || !std::isfinite(rule.window))
    throw std::invalid_argument("window after main shocks: expected a positive finite time");
  if (!(rule.first >= 0.0) || !(rule.first < rule.window))
    throw std::invalid_argument(
        "first time after main shocks: expected 0 or more, below the window");
  Sequences stack;
  stack.first = rule.first;
  stack.window = rule.window;
  std::size_t earliest = 0;  // of the window; it moves on with the main shocks
  for (std::size_t k = 0; k < events.size(); ++k) {
    const Shock main = events[k];
    if (!(main.size >= rule.main_size)) continue;
    const double from = main.start - rule.window, to = main.end + rule.window;
    if (from < events.front().start || to > events.back().start) continue;
    while (events[earliest].start < from) ++earliest;
    std::size_t last = earliest;
    bool largest = true;
    for (; largest && last < events.size() && events[last].start <= to; ++last)
      largest = last == k || events[last].size < main.size ||
                (events[last].size == main.size && last > k);
    if (!largest) continue;
    ++stack.main_shocks;
    for (std::size_t i = earliest; i < last; ++i) {
      const Shock &other = events[i];
      if (other.size < rule.least_size || i == k) continue;
      // Those that overlap may begin before the main shock and yet start after its end.
      if (other.start >= main.end + rule.first)
        stack.times.push_back(std::min(other.start - main.end, rule.window));
      // Events that overlap with the main shock are neither before nor after it.
      if (i < k && main.start - other.end >= rule.first)
        stack.before.push_back(main.start - other.end);
    }
  }
  std::sort(stack.times.begin(), stack.times.end());
  return stack;
}

double OmoriFit::rate(double t) const {
  return degenerate ? constant : K * std::pow(t + c, -p) + background;
}

namespace {

// Without the care of GSL's errors, whose handler is one for all threads.
OmoriFit fit_quietly(const Sequences &s, double hold_c) {
  if (!(s.window > s.first && s.first >= 0.0) || s.main_shocks < 0 ||
      (!s.times.empty() &&
       (s.main_shocks == 0 || s.times.front() < s.first || s.times.back() > s.window)))
    throw std::invalid_argument("Omori fit: times outside the window, or without a main shock");
  const bool held = !std::isnan(hold_c);
  if (held && (!std::isfinite(hold_c) || !(hold_c >= 0.0) || !(hold_c + s.first > 0.0)))
    throw std::invalid_argument("Omori fit: c held at " + std::to_string(hold_c) +
                                ", expected 0 or more (0 needs a first time above 0)");
  OmoriFit fit;
  fit.n = static_cast<std::int64_t>(s.times.size());
  const double shocks = static_cast<double>(s.main_shocks), span = s.window - s.first;
  if (fit.n > 0) {
    fit.constant = static_cast<double>(fit.n) / (shocks * span);
    fit.se_constant = std::sqrt(static_cast<double>(fit.n)) / (shocks * span);
  }
  if (fit.n < fewest) {
    fit.why = std::to_string(fit.n) + " events after " + std::to_string(s.main_shocks) +
              " main shocks, at least " + std::to_string(fewest) + " events needed";
    return fit;
  }
  const Likelihood likelihood(s);
  // Below a thousandth of the first time values of c are indistinguishable.
  const auto positive = std::upper_bound(s.times.begin(), s.times.end(), 0.0);
  const double shortest = positive == s.times.end() ? s.window : std::max(*positive, s.first);
  Search search{&likelihood, hold_c, true, std::log(1e-3 * shortest), std::log(s.window)};
  Maximum best;
  const double middle = s.times[s.times.size() / 4];
  for (const double share : {0.3, 0.8})
    for (const double c : {0.1 * middle, middle}) {
      const double ln_c = std::clamp(std::log(std::max(c, 1e-300)), search.least_ln_c + 0.1,
                                     search.most_ln_c - 0.1);
      const Maximum found = climb(search, share, ln_c, 1.1, 0.02);
      if (found.log_likelihood > best.log_likelihood) best = found;
      if (held) break;
    }
  // Less than half an event of background: at the border, where there is no curvature.
  const bool background = (1.0 - best.point.share) * likelihood.n() >= 0.5;
  search.background = background;
  const double ln_c = std::log(best.point.c > 0.0 ? best.point.c : 1.0);
  best = climb(search, best.point.share, ln_c, best.point.p, 1e-7);
  const auto [share, c, p] = best.point;
  fit.likelihood_ratio = std::max(0.0, 2.0 * (best.log_likelihood - likelihood.constant()));

  // Errors in ln(aftershocks), p, [ln c], [ln(background)].
  std::vector<double> x = {std::log(share * likelihood.n()), p}, step = {1e-2, 1e-3};
  if (!held) {
    x.push_back(std::log(c));
    step.push_back(1e-2);
  }
  if (background) {
    x.push_back(std::log((1.0 - share) * likelihood.n()));
    step.push_back(1e-2);
  }
  const auto unpack = [&](const std::vector<double> &at) {
    return std::array<double, 4>{std::exp(at[0]), background ? std::exp(at.back()) : 0.0,
                                 held ? hold_c : std::exp(at[2]), at[1]};
  };
  const std::vector<double> covariance = covariance_at_maximum(
      [&](const std::vector<double> &at) {
        const auto [aftershocks, flat, c_at, p_at] = unpack(at);
        return likelihood(aftershocks, flat, c_at, p_at);
      },
      x, step);
  const double needed = held ? 5.99 : 7.81;
  if (!(fit.likelihood_ratio > needed))
    fit.why = "no decay: a constant rate fits as well";
  else if (!held &&
           !(std::log(c) > search.least_ln_c + 0.01 && std::log(c) < search.most_ln_c - 0.01))
    fit.why = std::log(c) < 0.5 * (search.least_ln_c + search.most_ln_c)
                  ? "c is too short for these times; hold it, or use a later --first"
                  : "c is as long as the window";
  else if (!(p > 0.0))
    fit.why = "the rate rises with time";
  else if (covariance.empty())
    fit.why = "no maximum of the likelihood";
  if (!fit.why.empty()) return fit;
  const std::size_t n = x.size();
  fit.se_p = std::sqrt(covariance[n + 1]);
  const double se_ln_c = held ? 0.0 : std::sqrt(covariance[2 * n + 2]);
  if (!(fit.se_p < 0.5 && se_ln_c < 1.5)) {
    fit.why = "K, c and p trade against each other";
    fit.se_p = nan;
    return fit;
  }
  fit.degenerate = false;
  fit.p = p;
  fit.c = c;
  fit.se_c = c * se_ln_c;
  const auto ln_K = [&](const std::vector<double> &at) {
    const auto [aftershocks, flat, c_at, p_at] = unpack(at);
    return std::log(aftershocks / (shocks * omori_integral(s.first, s.window, c_at, p_at)));
  };
  std::vector<double> gradient(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> up = x, down = x;
    up[i] += step[i];
    down[i] -= step[i];
    gradient[i] = (ln_K(up) - ln_K(down)) / (2.0 * step[i]);
  }
  fit.K = std::exp(ln_K(x));
  fit.se_K = fit.K * error_of(gradient, covariance);
  fit.background = (1.0 - share) * likelihood.n() / (shocks * span);
  if (background) fit.se_background = fit.background * std::sqrt(covariance[n * n - 1]);
  return fit;
}

}  // namespace

OmoriFit fit_omori(const Sequences &sequences, double hold_c) {
  const QuietGsl quiet;
  return fit_quietly(sequences, hold_c);
}

std::vector<Shock> poisson_catalogue(const std::vector<Shock> &events, bool overlapping,
                                     std::uint64_t seed) {
  const std::size_t n = events.size();
  if (n < 2) return events;
  Random random(seed);
  const auto exponential = [&random] { return -std::log1p(-random.uniform()); };
  std::vector<Shock> out = events;
  shuffle(out, random);
  const double first = events.front().start, last = events.back().start;
  std::vector<double> starts(n);
  double time = overlapping ? 0.0 : first;
  if (overlapping) {
    // Ordered uniform numbers are sums of exponential ones over the sum of one more of them.
    for (double &start : starts) start = time += exponential();
    time += exponential();
    for (double &start : starts) start = std::min(last, first + (last - first) * (start / time));
  } else {
    NeumaierSum gaps;
    for (std::size_t i = 1; i < n; ++i) gaps.add(events[i].start - events[i - 1].end);
    const double mean = gaps.value() / static_cast<double>(n - 1);
    for (std::size_t i = 0; i < n; ++i) {
      starts[i] = time;
      time += out[i].end - out[i].start + mean * exponential();
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    out[i].end = starts[i] + (out[i].end - out[i].start);
    out[i].start = starts[i];
  }
  return out;
}

Aftershocks aftershocks_of(const EventTable &table, const SequenceRule &rule, double hold_c,
                           double factor, int replicas, std::uint64_t seed) {
  if (replicas < 0) throw std::invalid_argument("--replicas: expected 0 or more");
  const std::vector<Shock> events = shocks_of(table);
  const bool overlapping = table.info.overlapping();
  Aftershocks result;
  result.rule = rule;
  result.sequences = stack_sequences(events, rule);
  result.fit = fit_omori(result.sequences, hold_c);
  const auto histogram_of = [factor, &rule](const std::vector<double> &times) {
    return LogHistogram(times, factor).bins(rule.first, rule.window);
  };
  const auto same_lo = [](double a, double b) { return std::fabs(a - b) < 1e-9 * a; };
  const auto count_in = [&](const std::vector<double> &times, double lo) {
    for (const LogBin &bin : histogram_of(times))
      if (same_lo(bin.lo, lo)) return bin.count;
    return std::int64_t{0};
  };
  const auto shocks = static_cast<double>(result.sequences.main_shocks);
  std::vector<double> around = result.sequences.times;
  around.insert(around.end(), result.sequences.before.begin(), result.sequences.before.end());
  for (const LogBin &bin : histogram_of(around)) {
    const double exposure = shocks * (bin.hi - bin.lo);
    const std::int64_t after = count_in(result.sequences.times, bin.lo);
    const auto count = static_cast<double>(after);
    result.bins.push_back(
        {bin.lo, bin.hi, bin.centre, after, count / exposure, std::sqrt(count) / exposure});
    result.bins.back().before = count_in(result.sequences.before, bin.lo);
  }
  struct Replica {
    bool used = false, as_large = false;
    std::vector<double> rates;
  };
  std::vector<Replica> all(static_cast<std::size_t>(replicas));
  const std::size_t bins = result.bins.size();
  const QuietGsl quiet;
  for_each_replica(replicas, [&](int k) {
    const Sequences other =
        stack_sequences(poisson_catalogue(events, overlapping, seed_of_replica(seed, k)), rule);
    if (other.main_shocks == 0) return;
    Replica &replica = all[static_cast<std::size_t>(k)];
    replica.used = true;
    // 0 where there are too few events to fit.
    replica.as_large = fit_quietly(other, hold_c).likelihood_ratio >= result.fit.likelihood_ratio;
    replica.rates.resize(bins);
    for (const LogBin &bin : histogram_of(other.times))
      for (std::size_t i = 0; i < bins; ++i)
        if (same_lo(bin.lo, result.bins[i].lo))
          replica.rates[i] = static_cast<double>(bin.count) /
                             (static_cast<double>(other.main_shocks) * (bin.hi - bin.lo));
  });
  std::vector<NeumaierSum> sums(bins), squares(bins);
  int as_large = 0, used = 0;
  for (const Replica &replica : all) {
    if (!replica.used) continue;
    ++used;
    if (replica.as_large) ++as_large;
    for (std::size_t i = 0; i < bins; ++i) {
      sums[i].add(replica.rates[i]);
      squares[i].add(replica.rates[i] * replica.rates[i]);
    }
  }
  for (std::size_t i = 0; used > 1 && i < result.bins.size(); ++i) {
    RateBin &bin = result.bins[i];
    bin.poisson = sums[i].value() / used;
    bin.scatter = std::sqrt(std::max(0.0, squares[i].value() - used * bin.poisson * bin.poisson) /
                            (used - 1));
  }
  if (used > 0 && !std::isnan(result.fit.likelihood_ratio))
    result.p = (as_large + 1.0) / (used + 1.0);
  return result;
}

}  // namespace LSM::postproc
