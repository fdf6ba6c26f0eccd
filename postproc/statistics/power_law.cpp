// SPDX-License-Identifier: GPL-2.0-or-later
#include "power_law.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "files/text.h"
#include "magnitudes.h"
#include "monte_carlo.h"
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

// Vuong's test of the power law against a rival in u = ln(x / lo), where the Jacobian of the change
// of variables cancels; log_density: of the rival in u.
template <class LogDensity>
Comparison vuong(const char *name, std::vector<std::pair<std::string, double>> parameters,
                 const Sample &u, const Exponential &law, const LogDensity &log_density) {
  const auto advantage = [&, log_z = law.log_z()](double u_i) {
    return law.b * u_i - log_z - log_density(u_i);
  };
  const double average = u.mean(advantage), n = u.n();
  const double deviation =
      std::sqrt(u.mean([&](double u_i) { return std::pow(advantage(u_i) - average, 2); }));
  const double normalised = deviation > 0.0 ? std::sqrt(n) * average / deviation : 0.0;
  return {name, std::move(parameters), n * average, normalised,
          std::erfc(std::fabs(normalised) / std::sqrt(2.0))};
}

Comparison undecided(const char *name, std::string why) {
  return {name, {}, 0.0, 0.0, 1.0, true, std::move(why)};
}

}  // namespace

std::vector<Comparison> compare(const std::vector<double> &sorted, const PowerLawFit &fit) {
  if (fit.degenerate)
    throw std::invalid_argument("comparison with a degenerate power law: " + fit.why);
  const char *const names[] = {"exponential", "log-normal", "power law with exponential cut-off"};
  std::vector<Comparison> out;
  if (fit.step > 0.0) {
    for (const char *const name : names)
      out.push_back(undecided(name, "only without bins of magnitudes (--magnitude-bin 0)"));
    return out;
  }
  const TruncatedPowerLaw power_law(fit, 1.0 - fit.alpha);
  const Exponential &law = power_law.of_u;
  std::vector<double> logs = logs_in(fit, sorted);
  for (double &y : logs) y -= power_law.lower;
  const Sample u(std::move(logs));

  // In t = (x - lo) / width, an exponential has the same form as the power law in u.
  const double width = law.finite() ? fit.hi - fit.lo : fit.lo, scale = fit.lo / width;
  const Exponential of_t = Exponential::of_mean(
      u.mean([](double u_i) { return std::expm1(u_i); }) * scale, law.finite() ? 1.0 : infinity);
  out.push_back(vuong(names[0], {{"rate", -of_t.b / width}}, u, law,
                      [&, norm = of_t.log_z() - std::log(scale)](double u_i) {
                        return of_t.b * std::expm1(u_i) * scale - norm + u_i;
                      }));

  const double mean_u = u.mean([](double u_i) { return u_i; });
  for (const double rate : {0.0, 1.0}) {
    const double mean_t = u.mean(Tilt{rate});
    const TiltedFit rival = fit_tilted({rate}, mean_u, mean_t, law.length);
    const char *const name = names[rate > 0.0 ? 2 : 1];
    if (!rival.converged) {
      out.push_back(undecided(name, "no optimum found"));
    } else if (!(rival.c > 0.0)) {
      out.push_back(
          undecided(name, rate > 0.0 ? "the best cut-off is infinite: the power law itself"
                                     : "the best log-normal is its limit, the power law itself"));
    } else if (rate > 0.0) {
      const double gain = u.n() * (rival.log_likelihood - (law.b * mean_u - law.log_z()));
      out.push_back({name,
                     {{"alpha", 1.0 - rival.b}, {"cut-off", fit.lo / rival.c}},
                     -gain,
                     -2.0 * gain,
                     gsl_cdf_chisq_Q(std::max(0.0, 2.0 * gain), 1.0)});
    } else {
      // Parameters of ln x: mu is that of the untruncated normal and may lie far below the range.
      const double norm = rival.b * mean_u - rival.c * mean_t - rival.log_likelihood;
      out.push_back(vuong(name,
                          {{"mu", power_law.lower + rival.b / (2.0 * rival.c)},
                           {"sigma", 1.0 / std::sqrt(2.0 * rival.c)}},
                          u, law,
                          [&](double u_i) { return rival.b * u_i - rival.c * u_i * u_i - norm; }));
    }
  }
  return out;
}

}  // namespace LSM::postproc
