// SPDX-License-Identifier: GPL-2.0-or-later
#include "aftershocks.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multimin.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "estimation.h"
#include "log_histogram.h"
#include "numerics/random.h"
#include "numerics/sum.h"
#include "monte_carlo.h"
#include "samples.h"

namespace LSM::postproc {

namespace {

constexpr std::int64_t fewest_aftershocks = 20;

// Integral of (t + c)^-p from a to b, accurate also for p near 1.
double omori_integral(double a, double b, double c, double p) {
  const double low = std::log(a + c), high = std::log(b + c), q = 1.0 - p;
  const double z = q * (high - low);
  return std::exp(q * low) * (high - low) *
         (std::fabs(z) < 1e-8 ? 1.0 + 0.5 * z : std::expm1(z) / z);
}

// ln L as a function of the expected numbers of aftershocks and background events, and of c and p.
class OmoriLikelihood {
 public:
  explicit OmoriLikelihood(const Sequences &s)
      : first_(s.first), window_(s.window), n_(static_cast<double>(s.times.size())) {
    // To bound the cost of an evaluation, the times of a large sample are taken together in groups
    // 3 % wide, each represented by the mean and the variance of ln t. Over such a width ln(rate)
    // is so nearly linear in ln t that a second-order expansion suffices.
    const double width = n_ > static_cast<double>(largest_exact_sample) ? 1.03 : 1.0;
    for (std::size_t i = 0; i < s.times.size();) {
      std::size_t end = i + 1;
      while (end < s.times.size() && s.times[end] <= width * s.times[i]) ++end;
      Group group{s.times[i], static_cast<double>(end - i), 0.0};
      if (group.time < s.times[end - 1] && group.time > 0.0) {
        NeumaierSum sum, squares;  // of ln(time / first time of the group)
        for (std::size_t k = i; k < end; ++k) {
          const double ratio = std::log(s.times[k] / s.times[i]);
          sum.add(ratio);
          squares.add(ratio * ratio);
        }
        const double mean = sum.value() / group.count;
        group.time *= std::exp(mean);
        group.variance = std::max(0.0, squares.value() / group.count - mean * mean);
      }
      groups_.push_back(group);
      i = end;
    }
  }

  double operator()(double aftershocks, double background, double c, double p) const {
    const double scale = aftershocks / omori_integral(first_, window_, c, p);
    const double flat = background / (window_ - first_);
    if (!std::isfinite(scale)) return -HUGE_VAL;
    NeumaierSum sum;
    for (const Group &group : groups_) {
      const double decaying = scale * std::exp(-p * std::log(group.time + c));
      double value = std::log(decaying + flat);
      if (group.variance > 0.0) {
        // half the second derivative of ln(rate) with respect to ln t, times the variance of ln t
        const double share = decaying / (decaying + flat), q = group.time / (group.time + c);
        value -= 0.5 * group.variance * p * q * share * (1.0 - q - p * q * (1.0 - share));
      }
      sum.add(group.count * value);
    }
    return sum.value() - aftershocks - background;
  }
  double constant() const { return n_ * std::log(n_ / (window_ - first_)) - n_; }
  double n() const { return n_; }

 private:
  /// Times taken together, and the variance of their logarithms.
  struct Group {
    double time, count, variance;
  };

  std::vector<Group> groups_;
  double first_, window_, n_;
};

// A candidate law. The amplitude is expressed by the share of aftershocks in all expected events.
struct OmoriLaw {
  double share = 1.0, c = NAN, p = NAN;  // share: of aftershocks in all expected events
  double log_likelihood = -HUGE_VAL;
};

// Maximises the likelihood. At the maximum the expected number of events equals the observed one,
// so the share of aftershocks alone determines both amplitudes.
struct Search {
  const OmoriLikelihood &likelihood;
  double hold_c;  // NaN: c is fitted
  double least_ln_c, most_ln_c;
  bool background = true;

  // Free variables in this order: logit of the share (with a background), ln c (if fitted), p.
  Numbers variables_of(const OmoriLaw &law) const {
    Numbers x;
    const double share = std::clamp(law.share, 1e-9, 1.0 - 1e-9);
    if (background) x.push_back(std::log(share / (1.0 - share)));
    if (std::isnan(hold_c)) x.push_back(std::log(law.c));
    x.push_back(law.p);
    return x;
  }
  OmoriLaw law_at(const gsl_vector *x) const {
    std::size_t i = 0;
    OmoriLaw law{1.0, hold_c, 0.0};
    if (background) law.share = 1.0 / (1.0 + std::exp(-gsl_vector_get(x, i++)));
    if (std::isnan(hold_c)) law.c = std::exp(gsl_vector_get(x, i++));
    law.p = gsl_vector_get(x, i);
    const double n = likelihood.n();
    const bool c_within =
        !std::isnan(hold_c) || (std::log(law.c) >= least_ln_c && std::log(law.c) <= most_ln_c);
    if (c_within && std::fabs(law.p) < 20.0)
      law.log_likelihood = likelihood(n * law.share, n * (1.0 - law.share), law.c, law.p);
    return law;
  }

  // Nelder-Mead search from a given law until the simplex is smaller than the tolerance.
  OmoriLaw climb(const OmoriLaw &from, double tolerance) const {
    Numbers first = variables_of(from), steps(first.size(), 1.0);
    steps.back() = 0.3;
    gsl_multimin_function function;
    function.n = first.size();
    function.params = const_cast<Search *>(this);
    function.f = [](const gsl_vector *x, void *search) {
      const double value = static_cast<const Search *>(search)->law_at(x).log_likelihood;
      return std::isfinite(value) ? -value : 1e300;
    };
    const Gsl<gsl_multimin_fminimizer> work(
        gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, function.n),
        gsl_multimin_fminimizer_free);
    const gsl_vector_view x = gsl_vector_view_array(first.data(), first.size()),
                          step = gsl_vector_view_array(steps.data(), steps.size());
    gsl_multimin_fminimizer_set(work.get(), &function, &x.vector, &step.vector);
    for (int k = 0; k < 500; ++k)
      if (gsl_multimin_fminimizer_iterate(work.get()) != GSL_SUCCESS ||
          gsl_multimin_fminimizer_size(work.get()) < tolerance)
        break;
    return law_at(gsl_multimin_fminimizer_x(work.get()));
  }

  // Best law. If less than half an event is attributed to the background, the maximum is on the
  // boundary, where ln L has no curvature to give an error, and the background is dropped.
  OmoriLaw best(double middle) {
    OmoriLaw top;
    for (const double share : {0.3, 0.8})
      for (const double c : {0.1 * middle, middle}) {
        const double ln_c =
            std::clamp(std::log(std::max(c, 1e-300)), least_ln_c + 0.1, most_ln_c - 0.1);
        const OmoriLaw found = climb({share, std::exp(ln_c), 1.1}, 0.02);
        if (found.log_likelihood > top.log_likelihood) top = found;
        if (!std::isnan(hold_c)) break;
      }
    background = (1.0 - top.share) * likelihood.n() >= 0.5;
    return climb(top, 1e-7);
  }

  // Why the law is not an acceptable decay, or "".
  std::string no_decay(const OmoriLaw &law, double likelihood_ratio) const {
    const bool held = !std::isnan(hold_c);
    const double ln_c = std::log(law.c);
    if (!(likelihood_ratio > (held ? 5.99 : 7.81))) return "no decay: a constant rate fits as well";
    if (!held && !(ln_c > least_ln_c + 0.01 && ln_c < most_ln_c - 0.01))
      return ln_c < 0.5 * (least_ln_c + most_ln_c)
                 ? "c is too short for these times; hold it, or count later events only"
                 : "c is as long as the window";
    return law.p > 0.0 ? "" : "the rate rises with time";
  }
};

// Observed information: minus the second derivatives of ln L, by central differences.
template <class Function>
SymmetricMatrix information_at(const Function &f, const Numbers &x) {
  constexpr double step = 1e-3;
  SymmetricMatrix information(x.size());
  const auto shifted = [&](std::size_t i, double a, std::size_t j, double b) {
    Numbers at = x;
    at[i] += a * step;
    at[j] += b * step;
    return f(at);
  };
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const double second = i == j ? (shifted(i, 1, i, 0) - 2.0 * f(x) + shifted(i, -1, i, 0))
                                   : 0.25 * (shifted(i, 1, j, 1) - shifted(i, 1, j, -1) -
                                             shifted(i, -1, j, 1) + shifted(i, -1, j, -1));
      information(i, j) = information(j, i) = -second / (step * step);
    }
  return information;
}

// Fills in the parameters and their standard errors, or the reason why there are none.
void report(const OmoriLaw &law, const Search &search, const Sequences &s, OmoriFit &fit) {
  const bool held = !std::isnan(search.hold_c);
  const double n = search.likelihood.n(), shocks = static_cast<double>(s.main_shocks);
  const auto per_K = [&](double c, double p) {
    return shocks * omori_integral(s.first, s.window, c, p);
  };
  // Variables in this order: ln K, p, ln c (if fitted), ln(background events) (if there are any).
  Numbers x = {std::log(law.share * n / per_K(law.c, law.p)), law.p};
  if (!held) x.push_back(std::log(law.c));
  if (search.background) x.push_back(std::log((1.0 - law.share) * n));
  const Covariance covariance = covariance_of(information_at(
      [&](const Numbers &at) {
        const double c = held ? search.hold_c : std::exp(at[2]);
        const double flat = search.background ? std::exp(at.back()) : 0.0;
        return search.likelihood(std::exp(at[0]) * per_K(c, at[1]), flat, c, at[1]);
      },
      x));
  if (covariance.n == 0 || !(covariance.error(1) < 0.5 && (held || covariance.error(2) < 1.5))) {
    fit.why = "K, c and p trade against each other";
    return;
  }
  fit.degenerate = false;
  fit.K = {std::exp(x[0]), std::exp(x[0]) * covariance.error(0)};
  fit.p = {law.p, covariance.error(1)};
  fit.c = {law.c, held ? 0.0 : law.c * covariance.error(2)};
  const double background = (1.0 - law.share) * n / (shocks * (s.window - s.first));
  fit.background = {background,
                    search.background ? background * covariance.error(x.size() - 1) : NAN};
}

}  // namespace

Sequences stack_sequences(const std::vector<EventSummary> &events, const SequenceRule &rule) {
  if (!(rule.window > 0.0) || !std::isfinite(rule.window))
    throw std::invalid_argument("window after main shocks: expected a positive finite time");
  if (!(rule.first >= 0.0) || !(rule.first < rule.window))
    throw std::invalid_argument(
        "first time after main shocks: expected 0 or more, below the window");
  Sequences stack;
  stack.first = rule.first;
  stack.window = rule.window;
  std::size_t earliest = 0;  // index of the first event in the window, which only moves forward
  double longest = 0.0;
  for (const EventSummary &event : events) longest = std::max(longest, event.t_end - event.t_start);
  for (std::size_t k = 0; k < events.size(); ++k) {
    const EventSummary main = events[k];
    if (!(main.size >= rule.main_size)) continue;
    const double from = main.t_start - rule.window, to = main.t_end + rule.window;
    if (from < events.front().t_start || to > events.back().t_start) continue;
    while (is_before(events[earliest].t_start, from)) ++earliest;
    std::size_t last = earliest;
    bool largest = true;
    for (; largest && last < events.size() && !is_before(to, events[last].t_start); ++last)
      largest = last == k || events[last].size < main.size ||
                (events[last].size == main.size && last > k);
    if (!largest) continue;
    ++stack.main_shocks;
    for (std::size_t i = earliest; i < last; ++i) {
      const EventSummary &other = events[i];
      // Which of two that start together came first is not known.
      if (other.size < rule.least_size || other.t_start == main.t_start) continue;
      // An event of a catalogue with overlaps may precede the main shock in order and yet start
      // after the main shock has ended.
      if (!is_before(other.t_start, main.t_end + rule.first))
        stack.times.push_back(std::min(other.t_start - main.t_end, rule.window));
    }
    // Those before it count from their end on, so that they may have begun before the window; an
    // event that overlaps with the main shock is neither before nor after it.
    for (std::size_t i = k; i-- > 0 && !is_before(events[i].t_start, from - longest);) {
      const EventSummary &other = events[i];
      if (other.size >= rule.least_size && other.t_start < main.t_start &&
          !is_before(other.t_end, from) && !is_before(main.t_start - rule.first, other.t_end))
        stack.before.push_back(std::min(main.t_start - other.t_end, rule.window));
    }
  }
  std::sort(stack.times.begin(), stack.times.end());
  std::sort(stack.before.begin(), stack.before.end());
  return stack;
}

double OmoriFit::rate(double t) const {
  return degenerate ? constant.value : K.value * std::pow(t + c.value, -p.value) + background.value;
}

OmoriFit fit_omori(const Sequences &s, double hold_c) {
  if (!std::isnan(hold_c) && !(hold_c >= 0.0 && std::isfinite(hold_c) && hold_c + s.first > 0.0))
    throw std::invalid_argument("Omori fit: c held at " + std::to_string(hold_c) +
                                ", expected 0 or more (0 needs a first time above 0)");
  OmoriFit fit;
  fit.n = static_cast<std::int64_t>(s.times.size());
  const double exposure = static_cast<double>(s.main_shocks) * (s.window - s.first);
  const auto n = static_cast<double>(fit.n);
  if (fit.n > 0) fit.constant = {n / exposure, std::sqrt(n) / exposure};
  if (fit.n < fewest_aftershocks)
    return without_numbers(fit, std::to_string(fit.n) + " events after " +
                                    std::to_string(s.main_shocks) + " main shocks, at least " +
                                    std::to_string(fewest_aftershocks) + " events needed");
  const OmoriLikelihood likelihood(s);
  // With c far below the shortest time the laws are indistinguishable, hence the lower limit of c.
  const auto positive = std::upper_bound(s.times.begin(), s.times.end(), 0.0);
  const double shortest = positive == s.times.end() ? s.window : std::max(*positive, s.first);
  Search search{likelihood, hold_c, std::log(1e-3 * shortest), std::log(s.window)};
  const OmoriLaw law = search.best(s.times[s.times.size() / 4]);
  fit.likelihood_ratio = std::max(0.0, 2.0 * (law.log_likelihood - likelihood.constant()));
  fit.why = search.no_decay(law, fit.likelihood_ratio);
  if (fit.why.empty()) report(law, search, s, fit);
  return fit;
}

std::vector<EventSummary> poisson_catalogue(const std::vector<EventSummary> &events,
                                            bool overlapping, std::uint64_t seed) {
  const std::size_t n = events.size();
  if (n < 2) return events;
  Random random(seed);
  const auto exponential = [&random] { return -std::log1p(-random.uniform()); };
  std::vector<EventSummary> out = events;
  shuffle(out, random);
  const double first = events.front().t_start, last = events.back().t_start;
  std::vector<double> starts(n);
  double time = overlapping ? 0.0 : first;
  if (overlapping) {
    // The ordered uniform numbers are partial sums of n + 1 exponential ones divided by their
    // total.
    for (double &start : starts) start = time += exponential();
    time += exponential();
    for (double &start : starts) start = std::min(last, first + (last - first) * (start / time));
  } else {
    NeumaierSum gaps;
    for (std::size_t i = 1; i < n; ++i) gaps.add(events[i].t_start - events[i - 1].t_end);
    const double mean = gaps.value() / static_cast<double>(n - 1);
    for (std::size_t i = 0; i < n; ++i) {
      starts[i] = time;
      time += out[i].t_end - out[i].t_start + mean * exponential();
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    out[i].t_end = starts[i] + (out[i].t_end - out[i].t_start);
    out[i].t_start = starts[i];
  }
  return out;
}

namespace {

template <class Bin>
std::int64_t count_in(const Bin &bin, const std::vector<double> &ascending) {
  return std::lower_bound(ascending.begin(), ascending.end(), bin.hi) -
         std::lower_bound(ascending.begin(), ascending.end(), bin.lo);
}

std::vector<RateBin> rate_bins(const Sequences &sequences, const SequenceRule &rule,
                               double factor) {
  std::vector<double> around = sequences.times;
  around.insert(around.end(), sequences.before.begin(), sequences.before.end());
  std::vector<RateBin> bins;
  for (const LogBin &bin : log_histogram(around, factor, rule.first, rule.window)) {
    const double exposure = static_cast<double>(sequences.main_shocks) * (bin.hi - bin.lo);
    const std::int64_t after = count_in(bin, sequences.times);
    const auto count = static_cast<double>(after);
    bins.push_back(
        {bin.lo, bin.hi, bin.centre, after, count / exposure, std::sqrt(count) / exposure});
    bins.back().before = count_in(bin, sequences.before);
  }
  return bins;
}

// Result for one Poisson catalogue.
struct Replica {
  bool used = false, as_large = false;
  std::vector<double> rates;
};

// Fills in the p-value and, for each bin, the mean rate and its scatter over the replicas.
void compare(const std::vector<Replica> &replicas, Aftershocks &result) {
  double as_large = 0.0, used = 0.0;
  for (const Replica &replica : replicas) {
    used += replica.used;
    as_large += replica.as_large;
  }
  for (std::size_t i = 0; used > 1.0 && i < result.bins.size(); ++i) {
    std::vector<double> rates;
    for (const Replica &replica : replicas)
      if (replica.used) rates.push_back(replica.rates[i]);
    result.bins[i].poisson = mean_of(rates);
    result.bins[i].scatter = gsl_stats_sd(rates.data(), 1, rates.size());
  }
  if (used > 0.0 && !std::isnan(result.fit.likelihood_ratio))
    result.p = (as_large + 1.0) / (used + 1.0);
}

}  // namespace

Aftershocks aftershocks_of(const EventTable &table, const SequenceRule &rule, double hold_c,
                           double factor, int replicas, std::uint64_t seed) {
  Aftershocks result;
  result.rule = rule;
  result.sequences = stack_sequences(table.events, rule);
  result.fit = fit_omori(result.sequences, hold_c);
  result.bins = rate_bins(result.sequences, rule, factor);
  std::vector<Replica> all(static_cast<std::size_t>(replicas));
  for_each_replica(replicas, [&](int k) {
    const Sequences other = stack_sequences(
        poisson_catalogue(table.events, table.info.overlapping(), seed_of_replica(seed, k)), rule);
    if (other.main_shocks == 0) return;
    Replica &replica = all[static_cast<std::size_t>(k)];
    replica.used = true;
    // The likelihood ratio of a replica with too few events is NaN, which compares as smaller.
    replica.as_large = fit_omori(other, hold_c).likelihood_ratio >= result.fit.likelihood_ratio;
    for (const RateBin &bin : result.bins)
      replica.rates.push_back(static_cast<double>(count_in(bin, other.times)) /
                              (static_cast<double>(other.main_shocks) * (bin.hi - bin.lo)));
  });
  compare(all, result);
  return result;
}

}  // namespace LSM::postproc
