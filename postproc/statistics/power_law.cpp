// SPDX-License-Identifier: GPL-2.0-or-later
#include "power_law.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "files/text.h"
#include "gsl_owners.h"
#include "magnitudes.h"
#include "monte_carlo.h"
#include "numerics/sum.h"
#include "sample.h"
#include "samples.h"
#include "truncated_family.h"

namespace LSM::postproc {

namespace {

using text::number;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t least_events = 10;

// Lower edge of the bin that is centred at the multiple of step next to y.
double edge_below(double y, double step) { return step * (std::round(y / step) - 0.5); }

// Power law truncated to an interval of logarithms; the density of u is proportional to exp(b u).
struct TruncatedPowerLaw {
  double lower;
  Exponential of_u;

  TruncatedPowerLaw(const PowerLawFit &fit, double b)
      : lower(end(fit.lo, fit.step, -0.5)), of_u{end(fit.hi, fit.step, 0.5) - lower, b, fit.step} {}
  // The logarithm of an end of the range; in bins, of an edge of the bin that is centred there.
  static double end(double of, double step, double half) {
    const double y = std::log(of);
    return step > 0.0 ? step * (std::round(y / step) + half) : y;
  }
  double upper() const { return lower + of_u.length; }
  double cdf(double y) const { return of_u.cdf(y - lower); }
  double quantile(double probability) const { return lower + of_u.quantile(probability); }

  // The law on the same interval with the largest likelihood for a sample; none if that is at an
  // end of all laws.
  std::optional<TruncatedPowerLaw> refitted(const Sample &sample) const {
    const double mean_u = sample.mean([](double y) { return y; }) - lower, step = of_u.step;
    const double unit = of_u.finite() ? of_u.length - step : 1.0;
    const double mean = (mean_u - 0.5 * step) / unit;
    if (!(mean > 1e-9) || (of_u.finite() && !(mean < 1.0 - 1e-9))) return {};
    TruncatedPowerLaw best = *this;
    best.of_u = Exponential::of_mean(mean_u, of_u.length, step);
    return best;
  }
};

// Positive finite values in [lo, hi].
std::vector<double> between(const std::vector<double> &sorted, double lo, double hi) {
  if (!std::is_sorted(sorted.begin(), sorted.end()))
    throw std::invalid_argument("power law: sample is not in ascending order");
  const auto first = std::lower_bound(sorted.begin(), sorted.end(), lo);
  return {first,
          std::upper_bound(first, sorted.end(), std::min(hi, std::numeric_limits<double>::max()))};
}

// Logarithms of the values in the range of a fit; with a step, of those in the bins whose centres
// lie there, as these centres.
std::vector<double> logs_in(const PowerLawFit &fit, const std::vector<double> &sorted) {
  const double step = fit.step;
  std::vector<double> logs = between(sorted, fit.lo * std::exp(-step), fit.hi * std::exp(step));
  for (double &y : logs) y = std::log(y);
  if (!(step > 0.0)) return logs;
  const double first = std::ceil(std::log(fit.lo) / step - magnitude_tolerance),
               last = std::floor(std::log(fit.hi) / step + magnitude_tolerance);
  std::vector<double> centres;
  for (const double y : logs)
    if (const double bin = bin_of(y, step); bin >= first && bin <= last)
      centres.push_back(bin * step);
  return centres;
}

// Logarithms in ascending order as a sample; with a step, as counts from the first to the last bin.
Sample sample_of(const std::vector<double> &logs, double step) {
  if (!(step > 0.0)) return Sample(logs);
  std::vector<double> edges, centres, counts;
  auto at = logs.begin();
  for (double bin = bin_of(logs.front(), step); at != logs.end(); ++bin) {
    const auto end = std::find_if(at, logs.end(), [&](double y) { return bin_of(y, step) > bin; });
    edges.push_back(edge_below(bin * step, step));
    centres.push_back(bin * step);
    counts.push_back(static_cast<double>(end - at));
    at = end;
  }
  edges.push_back(edge_below(centres.back() + step, step));
  return {edges, centres, counts};
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

// Draws values of the law in ascending order: ordered uniform numbers are partial sums of
// exponential variables divided by their total.
std::vector<double> draw(const TruncatedPowerLaw &law, std::size_t count, gsl_rng *rng) {
  const auto exponential = [rng] { return -std::log(gsl_rng_uniform_pos(rng)); };
  std::vector<double> drawn(count);
  double sum = 0.0;
  // Two numbers before and one behind are left out, so that seeds keep their samples.
  for (int i = 0; i < 2; ++i) exponential();
  for (double &y : drawn) y = sum += exponential();
  sum += exponential();
  exponential();
  for (double &y : drawn) y = law.quantile(y / sum);
  return drawn;
}

// Edges that cells of the law must have.
std::vector<double> edges_of(const TruncatedPowerLaw &law, double largest, double n) {
  // Without an upper end, up to where a thousandth of a value is expected.
  const double step = law.of_u.step,
               end = law.of_u.finite()
                         ? law.upper()
                         : std::max(largest + 0.5 * step, law.quantile(1.0 - 1e-3 / n));
  if (!(step > 0.0))  // slightly beyond the data, so that the extreme value lies within a cell
    return {law.lower, law.of_u.finite() ? end : end + 1e-9 * (1.0 + std::fabs(end))};
  std::vector<double> edges;
  for (double edge = law.lower; edge < end + 0.5 * step; edge += step)
    edges.push_back(edge_below(edge + 0.5 * step, step));
  return edges;
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
  const std::vector<double> logs = logs_in(fit, sorted);
  fit.n = static_cast<std::int64_t>(logs.size());
  if (fit.n < least_events)
    return without_numbers(fit, number(fit.n) + " events in the range, at least 10 needed");
  if (logs.back() - logs.front() <= 0.5 * step)
    return without_numbers(fit, "all events in the range have the same size");
  const auto n = static_cast<double>(fit.n);
  const Sample sample = sample_of(logs, step);
  const auto law = TruncatedPowerLaw(fit, 0.0).refitted(sample);
  if (!law) return without_numbers(fit, "all events lie at one edge of the range");
  const double b = law->of_u.b, mean = sample.mean([](double y) { return y; });
  const double error = 1.0 / std::sqrt(n * law->of_u.variance());
  if (!(error <= std::max(1.0, std::fabs(b))))
    return without_numbers(fit, "the range is too narrow for " + number(fit.n) +
                                    " events: the exponent is not determined");
  fit.degenerate = false;
  fit.alpha = 1.0 - b;
  fit.standard_error = error;
  fit.ks = sample.distance([&law](double y) { return law->cdf(y); });
  // In bins, of the integral of the density over each; otherwise of the density of the values.
  const double of_values = step > 0.0 ? Exponential{step, b}.log_z() - 0.5 * step * b : -mean;
  fit.log_likelihood = n * (b * (mean - law->lower) - law->of_u.log_z() + of_values);
  return fit;
}

double p_value(const PowerLawFit &fit, const std::vector<double> &sorted, int replicas,
               std::uint64_t seed) {
  if (fit.degenerate) throw std::invalid_argument("p-value of a degenerate power law: " + fit.why);
  const TruncatedPowerLaw law(fit, 1.0 - fit.alpha);
  const std::vector<double> logs = logs_in(fit, sorted);
  FittedLaw fitted;
  fitted.survival = [law](double y) { return 1.0 - law.cdf(y); };
  fitted.draw = [law, n = logs.size()](gsl_rng *rng) { return draw(law, n, rng); };
  fitted.refit = [law](const Sample &sample) {
    const auto best = law.refitted(sample);
    return best ? [best](double y) { return best->cdf(y); } : FittedLaw::Function();
  };
  fitted.edges = edges_of(law, logs.back(), static_cast<double>(logs.size()));
  fitted.in_bins = fit.step > 0.0;
  return share_of_worse_fits(fitted, logs, fit.ks, replicas, seed);
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
// likelihood of a bin is the integral of the density over it, by the points of a quadrature; a
// value that is known is a bin of a single point.
class Contest {
 public:
  Contest(const std::vector<double> &sorted, const PowerLawFit &fit)
      : lo_(fit.lower_end()),
        hi_(fit.upper_end()),
        law_(fit, 1.0 - fit.alpha),
        points_(fit.step > 0.0 ? most_points : 1) {
    const std::vector<double> logs = logs_in(fit, sorted);
    n_ = static_cast<double>(logs.size());
    const Gsl<gsl_integration_glfixed_table> rule(gsl_integration_glfixed_table_alloc(points_),
                                                  gsl_integration_glfixed_table_free);
    for (auto at = logs.begin(); at != logs.end();) {
      const auto end = points_ > 1 ? std::upper_bound(at, logs.end(), *at) : at + 1;
      counts_.push_back(static_cast<double>(end - at));
      const double u = *at - law_.lower, from = u - 0.5 * fit.step;
      for (std::size_t i = 0; i < points_; ++i) {
        u_.push_back(u);
        weights_.push_back(1.0);
        if (points_ > 1)
          gsl_integration_glfixed_point(from, from + fit.step, i, &u_.back(), &weights_.back(),
                                        rule.get());
      }
      at = end;
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
        points_ == 1
            ? n_ * (rival.fit.log_likelihood - (law_.of_u.b * rival.mean_u - law_.of_u.log_z()))
            : -n_ * mean([&](std::size_t bin) { return advantage(bin, rival); });
    return {name,
            {{"alpha", 1.0 - rival.fit.b}, {"cut-off", lo_ / rival.fit.c}},
            -gain,
            -2.0 * gain,
            gsl_cdf_chisq_Q(std::max(0.0, 2.0 * gain), 1.0)};
  }

 private:
  static constexpr std::size_t most_points = 16;

  static Comparison undecided(const char *name, const Tilted &rival, const char *border) {
    Comparison out;
    out.rival = name;
    out.degenerate = true;
    out.why = rival.fit.converged ? border : "no optimum found";
    return out;
  }

  // The logarithm of the integral of a density over a bin, and with it the mean of a function
  // there.
  template <class LogDensity, class F>
  std::pair<double, double> integral(std::size_t bin, const LogDensity &density, const F &f) const {
    const double *const u = &u_[bin * points_];
    if (points_ == 1) return {density(*u), f(*u)};
    double logs[most_points], top = -infinity, sum = 0.0, of_f = 0.0;
    for (std::size_t i = 0; i < points_; ++i) top = std::max(top, logs[i] = density(u[i]));
    for (std::size_t i = 0; i < points_; ++i) {
      const double p = weights_[bin * points_ + i] * std::exp(logs[i] - top);
      sum += p;
      of_f += p * f(u[i]);
    }
    return {top + std::log(sum), of_f / sum};
  }

  // Mean of a function of the bin of a value.
  template <class F>
  double mean(const F &f) const {
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
    double last = fit([&](const auto &f) {
      return mean([&](std::size_t bin) { return integral(bin, flat, f).second; });
    });
    for (int i = 0; points_ > 1 && i < 200; ++i) {
      const double next = fit([&](const auto &f) {
        return mean([&](std::size_t bin) { return integral(bin, density, f).second; });
      });
      if (std::fabs(next - last) <= 1e-9 * std::fabs(next)) return;
      last = next;
    }
  }
  static double flat(double) { return 0.0; }

  // By how much the logarithm of the likelihood of a bin is larger for the power law.
  template <class LogDensity>
  double advantage(std::size_t bin, const LogDensity &rival) const {
    const double b = law_.of_u.b, log_z = law_.of_u.log_z();
    const auto law = [b, log_z](double u) { return b * u - log_z; };
    return integral(bin, law, flat).first - integral(bin, rival, flat).first;
  }

  // Vuong's test in u: the Jacobian of the change of variables cancels in the likelihood ratio.
  template <class LogDensity>
  Comparison vuong(const char *name, std::vector<std::pair<std::string, double>> parameters,
                   const LogDensity &rival) const {
    const double average = mean([&](std::size_t bin) { return advantage(bin, rival); });
    const double deviation = std::sqrt(
        mean([&](std::size_t bin) { return std::pow(advantage(bin, rival) - average, 2); }));
    const double normalised = deviation > 0.0 ? std::sqrt(n_) * average / deviation : 0.0;
    return {name, std::move(parameters), n_ * average, normalised,
            std::erfc(std::fabs(normalised) / std::sqrt(2.0))};
  }

  double lo_, hi_;
  TruncatedPowerLaw law_;
  std::size_t points_;               // of the quadrature in a bin
  std::vector<double> u_, weights_;  // of the points, bin by bin
  std::vector<double> counts_;       // of the values in each bin
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
