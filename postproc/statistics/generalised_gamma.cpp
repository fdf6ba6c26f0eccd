// SPDX-License-Identifier: GPL-2.0-or-later
#include "generalised_gamma.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_sf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "estimation.h"
#include "files/text.h"
#include "monte_carlo.h"
#include "sample.h"
#include "samples.h"
#include "truncated_family.h"

namespace LSM::postproc {

namespace {

using text::number;

// Internally, theta is measured in units of a reference (v = ln theta - reference), and the
// parameters are gamma, v0 = ln(B^(1/delta)) - reference and ln delta: ln f = ln C + (gamma - 1)
// v - s with s = exp(delta (v - v0)). In these variables it does not depend on the unit of time
// whether a fit is degenerate (except for the criterion on ln B). Parameters that may be held come
// last: ln delta, or the scale and ln delta.
enum Parameter { log_c, shape, scale, log_delta, parameters };
using Vector = std::array<double, parameters>;

constexpr double delta_min = 0.1, delta_max = 10.0;

const char *const no_fall_off =
    "no exponential fall-off in the data: no better than a pure power law";
const char *const singular =
    "the information matrix is singular: the parameters trade against each other";

// Smallest gain of the fall-off over a pure power law, in 2 ln L or chi square: the 95 % point of
// chi square with as many degrees of freedom as the fall-off has parameters (B and delta, or B
// alone).
double least_gain(bool delta_fixed) { return delta_fixed ? 3.84 : 5.99; }

// Why delta is not inside its interval, or "".
std::string outside(double delta) {
  if (delta <= delta_min * (1.0 + 1e-9))
    return "delta runs below 0.1, towards a log-normal density";
  if (delta >= delta_max * (1.0 - 1e-9))
    return "delta runs above 10, towards a power law with a sharp end";
  return {};
}

// Covariance of all parameters: that of the fitted ones from `first` on, and 0 for the others.
Covariance of_all(const Covariance &fitted, std::size_t first) {
  Covariance all(parameters);
  for (std::size_t i = 0; i < fitted.n; ++i)
    for (std::size_t j = 0; j < fitted.n; ++j) all(first + i, first + j) = fitted(i, j);
  return all;
}

// Gradient of ln B = delta (v0 + reference).
Numbers slope_of_log_b(const Vector &p, double reference) {
  const double delta = std::exp(p[log_delta]);
  return {0.0, 0.0, delta, delta * (p[scale] + reference)};
}

// Why the data do not determine the parameters, or "".
std::string ridge(const Vector &p, const Covariance &covariance, double reference) {
  const auto trade = [](const char *name, double error) {
    return fmt::format("the parameters trade against each other: standard error of {} is {:.2g}",
                       name, error);
  };
  const double gamma_error = covariance.error(shape), delta_error = covariance.error(log_delta);
  if (!(gamma_error <= 0.25 * std::max(1.0, std::fabs(p[shape]))))
    return trade("gamma", gamma_error);
  if (!(delta_error <= 0.25)) return trade("ln delta", delta_error);
  const double error = covariance.error(slope_of_log_b(p, reference));
  if (!(error <= 1.0)) return trade("ln B in this unit of time", error);
  return {};
}

// Fills in parameters and errors in the unit of the data, or the reason why there are none.
// slope_c: gradient of ln C.
void report(const Vector &p, const Numbers &slope_c, const Covariance &covariance, double reference,
            GeneralisedGammaFit &fit) {
  fit.why = ridge(p, covariance, reference);
  if (!fit.why.empty()) return;
  fit.degenerate = false;
  fit.gamma = p[shape];
  fit.delta = std::exp(p[log_delta]);
  fit.B = std::exp(fit.delta * (p[scale] + reference));
  fit.C = std::exp(p[log_c]);
  fit.se_gamma = covariance.error(shape);
  fit.se_delta = fit.delta * covariance.error(log_delta);
  fit.se_B = fit.B * covariance.error(slope_of_log_b(p, reference));
  fit.se_C = fit.C * covariance.error(slope_c);
}

void check_delta(double fixed) {
  if (!std::isnan(fixed) && !(fixed >= delta_min && fixed <= delta_max))
    throw std::invalid_argument("generalised gamma: delta fixed at " + number(fixed) +
                                ", expected a number between 0.1 and 10");
}

// ---- maximum likelihood

// A law for v, truncated on the left at `lower`; -infinity: not truncated.
struct GammaLaw {
  double lower;
  double delta = 1.0, gamma = 0.0;
  double v0 = 0.0;                    // infinite: no fall-off, a power law
  double log_likelihood = -HUGE_VAL;  // of a sample per value, for the density in v

  bool truncated() const { return std::isfinite(lower); }
  // Survival function up to a constant factor; it underflows where exp(delta (v - v0)) exceeds 700.
  double tail(double v) const {
    if (std::isinf(v0)) return std::exp(gamma * (v - lower));
    const double s = std::exp(delta * (v - v0)), k = gamma / delta;
    if (s > 700.0) return 0.0;
    return k > 0.0 ? gsl_sf_gamma_inc_Q(k, s) : gsl_sf_gamma_inc(k, s);
  }
  // Probability of exceeding v, as a function of v; and that of not exceeding it.
  FittedLaw::Function survival() const {
    return [law = *this, all = truncated() ? tail(lower) : 1.0](double v) {
      return law.tail(v) / all;
    };
  }
  FittedLaw::Function cdf() const {
    return [above = survival()](double v) { return 1.0 - above(v); };
  }
  // A value beyond which the probability is negligible.
  double end() const {
    const double s = truncated() ? std::exp(delta * (lower - v0)) : 0.0,
                 k = std::max(gamma / delta, 0.0);
    return v0 + std::log(std::max(s, k) + 8.0 * std::sqrt(k) + 40.0) / delta;
  }
};

// The derivatives of ln f but for ln C with respect to gamma, the scale and ln delta, with w =
// delta (v - v0) and s = exp(w); and s w^2. Those of second order are combinations of these.
auto slopes_of(const GammaLaw &law) {
  return [delta = law.delta, v0 = law.v0](double v) -> Vector {
    const double w = delta * (v - v0), s = std::exp(w);
    return {v, delta * s, -s * w, s * w * w};
  };
}

// Likelihood of a sample of logarithms from `lower` on.
struct GammaLikelihood {
  const Sample &sample;
  double lower;
  double mean_v = sample.mean([](double v) { return v; });

  // Log-likelihood per value of the power law without a fall-off; only for a truncated sample.
  double power_law() const { return -std::log(mean_v - lower) - 1.0; }

  // The best law for a given delta.
  GammaLaw at(double delta) const {
    GammaLaw law{lower, delta};
    const double origin = law.truncated() ? lower : 0.0;
    const double mean_t = sample.mean([&](double v) { return std::exp(delta * (v - origin)); });
    if (law.truncated()) {
      const TiltedFit fit = fit_tilted({delta}, mean_v - lower, mean_t, HUGE_VAL);
      if (!fit.converged) return law;
      law.gamma = fit.b;
      law.v0 = lower - std::log(fit.c) / delta;
      law.log_likelihood = fit.log_likelihood;
      return law;
    }
    // theta^delta has a gamma distribution of shape k = gamma / delta. As ln k - psi(k) falls from
    // infinity to 0, there is exactly one solution, which is found by Newton's method in ln k.
    const double target = std::log(mean_t) - delta * mean_v;
    if (!(target > 1e-12)) return law;
    double k = 0.5 / target + 0.2;
    for (int i = 0; i < 100; ++i) {
      const double slope = 1.0 - k * gsl_sf_psi_1(k);
      const double step = (std::log(k) - gsl_sf_psi(k) - target) / slope;
      k *= std::exp(std::clamp(-step, -2.0, 2.0));
      if (std::fabs(step) < 1e-14) break;
    }
    const double log_b = std::log(mean_t / k);
    law.gamma = k * delta;
    law.v0 = log_b / delta;
    law.log_likelihood = std::log(delta) - k * log_b - gsl_sf_lngamma(k) + law.gamma * mean_v - k;
    return law;
  }

  // As a function of gamma, the scale and, if it is free, ln delta.
  Likelihood operator()(const GammaLaw &law, std::size_t free) const {
    const auto &[from, delta, gamma, v0, ignored] = law;
    if (!(delta >= delta_min && delta <= delta_max && (gamma > 0.0 || law.truncated()))) return {};
    const auto slopes = slopes_of(law);
    const double mode = gamma > 0.0 ? v0 + std::log(gamma / delta) / delta : lower;
    const TabulatedDensity table =
        tabulate([&law](double v) { return law.gamma * v - std::exp(law.delta * (v - law.v0)); },
                 std::max(mode, lower), lower, HUGE_VAL, 1.0 / delta);
    const Vector of_data = sample.mean_of(slopes);
    const auto of_law = table.mean_of([&](double v) -> std::array<double, 10> {
      const auto [x, y, z, more] = slopes(v);
      return {x, y, z, more, x * x, x * y, y * y, x * z, y * z, z * z};
    });
    Likelihood out{sample.n() * (gamma * mean_v - of_data[1] / delta - table.log_z), Numbers(free),
                   SymmetricMatrix(free)};
    Vector change;
    for (std::size_t i = 0; i < change.size(); ++i) change[i] = of_law[i] - of_data[i];
    const double scale_delta = change[1] - delta * change[2], delta_delta = change[2] - change[3];
    const double second[] = {0.0, 0.0, -delta * change[1], 0.0, scale_delta, delta_delta};
    for (std::size_t i = 0, k = 0; i < free; ++i) {
      out.score[i] = -sample.n() * change[i];
      for (std::size_t j = 0; j <= i; ++j, ++k)
        out.information.set(i, j, sample.n() * (of_law[4 + k] - of_law[i] * of_law[j] + second[k]));
    }
    return out;
  }

  // The best law near another one, if there is one.
  GammaLaw best_near(const GammaLaw &near) const {
    const auto law_of = [this](const Numbers &p) {
      return GammaLaw{lower, std::exp(p[2]), p[0], p[1]};
    };
    const Maximum top = maximise([&](const Numbers &p) { return (*this)(law_of(p), 3); },
                                 {near.gamma, near.v0, std::log(near.delta)});
    GammaLaw law = law_of(top.p);
    if (top.converged) law.log_likelihood = top.at.value / sample.n();
    return law;
  }

  // Best delta in (delta_min, delta_max): from the best of a coarse scan, since there may be
  // several maxima.
  GammaLaw best() const {
    constexpr int steps = 20;
    std::vector<GammaLaw> scan;
    for (int i = 0; i <= steps; ++i)
      scan.push_back(at(delta_min * std::pow(delta_max / delta_min, i / double{steps})));
    const auto top = std::max_element(scan.begin(), scan.end(), [](const auto &a, const auto &b) {
      return a.log_likelihood < b.log_likelihood;
    });
    const bool inside = top != scan.begin() && top != scan.end() - 1 && !std::isinf(top->v0);
    return inside ? best_near(*top) : *top;
  }
};

// A function that draws from the law.
std::function<double(gsl_rng *)> sampler_of(const GammaLaw &law) {
  // Without truncation, exp(delta (v - v0)) is a gamma variable of shape k. It is drawn as a
  // logarithm, since it underflows for small k.
  if (!law.truncated())
    return [law, k = law.gamma / law.delta](gsl_rng *rng) {
      const double u = gsl_rng_uniform_pos(rng);
      return law.v0 + (std::log(gsl_ran_gamma(rng, k + 1.0, 1.0)) + std::log(u) / k) / law.delta;
    };
  // A truncated law may have k <= 0 and then no gamma variable: interpolate the distribution
  // function, tabulated so finely that linear interpolation is off by less than 1e-5.
  constexpr std::size_t points = 8192;
  const double width = (law.end() - law.lower) / (points - 1);
  const auto cdf_at = law.cdf();
  std::vector<double> at, cdf;
  for (std::size_t i = 0; i < points; ++i) {
    at.push_back(law.lower + width * static_cast<double>(i));
    cdf.push_back(cdf_at(at.back()));
  }
  cdf.front() = 0.0;
  return
      [at, cdf](gsl_rng *rng) { return interpolate(cdf, at, gsl_rng_uniform(rng) * cdf.back()); };
}

// Logarithms of the values from lo on; throws for values that have none.
std::vector<double> logs_from(double lo, const std::vector<double> &values) {
  std::vector<double> v;
  for (double value : values) {
    if (!std::isfinite(value) || (lo == 0.0 && value <= 0.0))
      throw std::invalid_argument("generalised gamma: value " + number(value) + ", expected a " +
                                  (lo == 0.0 ? "positive" : "finite") + " number");
    if (value >= lo) v.push_back(std::log(value));
  }
  return v;
}

// Why the best law does not belong to the family, or "".
std::string no_density(const GammaLikelihood &likelihood, const GammaLaw &best, bool delta_fixed) {
  // Tested first, since data from a pure power law drive the parameters to a boundary or along a
  // ridge.
  if (best.truncated() &&
      2.0 * likelihood.sample.n() * (best.log_likelihood - likelihood.power_law()) <
          least_gain(delta_fixed))
    return no_fall_off;
  if (!std::isfinite(best.log_likelihood)) return "no optimum found";
  const std::string why = delta_fixed ? "" : outside(best.delta);
  if (why.empty() && !best.truncated() && best.gamma < 0.05)
    return "gamma is at its limit 0, beyond which only a fit truncated on the left exists";
  return why;
}

void report(const GammaLikelihood &likelihood, const GammaLaw &best, double reference,
            GeneralisedGammaFit &fit) {
  const Covariance covariance =
      covariance_of(likelihood(best, fit.delta_fixed ? 2 : 3).information);
  if (covariance.n == 0) {
    fit.why = singular;
    return;
  }
  // The slopes of ln C are minus the means of those of ln f over the law, or over the sample.
  const Vector slopes = likelihood.sample.mean_of(slopes_of(best));
  const double log_c =
      best.log_likelihood - best.gamma * likelihood.mean_v + slopes[1] / best.delta;
  report({log_c - best.gamma * reference, best.gamma, best.v0, std::log(best.delta)},
         {0.0, -slopes[0] - reference, -slopes[1], -slopes[2]}, of_all(covariance, shape),
         reference, fit);
}

// ---- least squares

constexpr std::int64_t fewest_counts = 5;

// Leaves out bins with fewer counts, as their logarithms are biased.
std::vector<LogBin> usable(const std::vector<LogBin> &bins) {
  std::vector<LogBin> used;
  std::copy_if(bins.begin(), bins.end(), std::back_inserter(used),
               [](const LogBin &bin) { return bin.count >= fewest_counts; });
  return used;
}

struct BinnedDensity {
  std::array<double, 5> v, log_weight;  // Gauss-Legendre points in v; weights over the bin width
  double log_density;
};

std::vector<BinnedDensity> binned_densities(const std::vector<LogBin> &bins, double reference) {
  const Gsl<gsl_integration_glfixed_table> rule(gsl_integration_glfixed_table_alloc(5),
                                                gsl_integration_glfixed_table_free);
  std::vector<BinnedDensity> out;
  for (const LogBin &bin : bins) {
    BinnedDensity one;
    // Weighted with the count, the logarithm of a Poisson number exceeds that of its mean by 0.5 /
    // count on average.
    one.log_density = std::log(bin.density) - 0.5 / static_cast<double>(bin.count);
    for (std::size_t k = 0; k < one.v.size(); ++k) {
      double weight = 0.0;
      gsl_integration_glfixed_point(std::log(bin.lo) - reference, std::log(bin.hi) - reference, k,
                                    &one.v[k], &weight, rule.get());
      // In v, C theta^(gamma-1) d theta becomes C theta^gamma dv, with theta in units of
      // exp(reference).
      one.log_weight[k] = std::log(weight / (bin.hi - bin.lo));
    }
    out.push_back(one);
  }
  return out;
}

// Logarithm of the model averaged over the bin; slope receives its derivatives.
double log_average(const BinnedDensity &bin, const Vector &p, Numbers &slope) {
  const double delta = std::exp(p[log_delta]);
  std::array<double, 5> terms;
  for (std::size_t k = 0; k < terms.size(); ++k)
    terms[k] = bin.log_weight[k] + p[log_c] + p[shape] * bin.v[k] -
               std::exp(std::min(700.0, delta * (bin.v[k] - p[scale])));
  const double top = *std::max_element(terms.begin(), terms.end());
  double total = 0.0;
  Vector sums{};
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const double term = std::exp(terms[k] - top);
    const double w = delta * (bin.v[k] - p[scale]), s = std::exp(std::min(700.0, w));
    total += term;
    sums[log_c] += term;
    sums[shape] += term * bin.v[k];
    sums[log_delta] -= term * s * w;
    sums[scale] += term * delta * s;
  }
  for (std::size_t a = 0; a < slope.size(); ++a) slope[a] = sums[a] / total;
  return top + std::log(total);
}

// All parameters: the free ones from p, the others from held.
Vector completed(const Numbers &p, Vector held) {
  std::copy(p.begin(), p.end(), held.begin());
  return held;
}

}  // namespace

GeneralisedGammaFit fit_maximum_likelihood(const std::vector<double> &values, double lo,
                                           double delta) {
  check_delta(delta);
  GeneralisedGammaFit fit;
  fit.lo = lo;
  fit.delta_fixed = !std::isnan(delta);
  std::vector<double> v = logs_from(lo, values);
  fit.n = static_cast<std::int64_t>(v.size());
  if (fit.n < 20) return without_numbers(fit, number(fit.n) + " values, at least 20 needed");
  const double reference = Sample(v).mean([](double v_i) { return v_i; });
  for (double &v_i : v) v_i -= reference;
  const auto [least, greatest] = std::minmax_element(v.begin(), v.end());
  if (!(*greatest - *least > 1e-9)) return without_numbers(fit, "all values are equal");
  Sample sample(std::move(v));
  const GammaLikelihood likelihood{sample, lo > 0.0 ? std::log(lo) - reference : -HUGE_VAL};
  const GammaLaw best = fit.delta_fixed ? likelihood.at(delta) : likelihood.best();
  fit.why = no_density(likelihood, best, fit.delta_fixed);
  if (fit.why.empty()) report(likelihood, best, reference, fit);
  if (std::isfinite(best.log_likelihood))
    fit.log_likelihood = sample.n() * (best.log_likelihood - likelihood.mean_v - reference);
  if (!fit.why.empty()) return fit;
  sample.sort();
  fit.ks = sample.distance(best.cdf());
  return fit;
}

GeneralisedGammaFit fit_least_squares(const std::vector<LogBin> &bins, double delta) {
  check_delta(delta);
  GeneralisedGammaFit fit;
  fit.delta_fixed = !std::isnan(delta);
  const std::vector<LogBin> used = usable(bins);
  const int free_parameters = fit.delta_fixed ? log_delta : parameters;
  fit.dof = static_cast<int>(used.size()) - free_parameters;
  double sum = 0.0;
  for (const LogBin &bin : used) {
    fit.n += bin.count;
    sum += static_cast<double>(bin.count) * std::log(bin.centre);
  }
  if (fit.dof < 1)
    return without_numbers(fit, std::to_string(used.size()) + " bins with at least " +
                                    number(fewest_counts) + " counts, more than " +
                                    std::to_string(free_parameters) + " needed");
  fit.lo = used.front().lo;
  const double reference = sum / static_cast<double>(fit.n);
  const std::vector<BinnedDensity> data = binned_densities(used, reference);
  // Weighted residuals are normal, with an information that does not depend on them.
  const auto solve = [&](const std::vector<Numbers> &starts, const Vector &held) {
    const auto likelihood = [&](const Numbers &p) {
      Likelihood at{0.0, Numbers(p.size()), SymmetricMatrix(p.size())};
      Numbers slope(p.size());
      for (std::size_t i = 0; i < data.size(); ++i) {
        const double off = data[i].log_density - log_average(data[i], completed(p, held), slope);
        const auto weight = static_cast<double>(used[i].count);
        at.value -= 0.5 * weight * off * off;
        for (std::size_t a = 0; a < p.size(); ++a) {
          at.score[a] += weight * off * slope[a];
          for (std::size_t b = 0; b < p.size(); ++b)
            at.information(a, b) += weight * slope[a] * slope[b];
        }
      }
      return at;
    };
    Maximum best;
    for (const Numbers &start : starts)
      if (Maximum found = maximise(likelihood, start); found.at.value > best.at.value)
        best = std::move(found);
    return best;
  };

  const double last = std::log(used.back().hi) - reference;
  const double first_c = std::log(used.front().density);
  // Pure power law: the scale is held so far beyond the data that there is no fall-off.
  const Maximum power_law = solve({{first_c, 0.5}}, {0.0, 0.0, last + 1000.0, 0.0});
  std::vector<Numbers> starts;
  for (const double v0 : {0.0, 0.5 * last, last}) {
    if (fit.delta_fixed) starts.push_back({first_c, 0.5, v0});
    for (const double start : {0.5, 1.0, 2.0})
      if (!fit.delta_fixed) starts.push_back({first_c, 0.5, v0, std::log(start)});
  }
  const Vector held = {0.0, 0.0, 0.0, std::log(delta)};
  const Maximum best = solve(starts, held);
  // Tested first, since data from a pure power law drive the parameters to a boundary or along a
  // ridge.
  if (power_law.converged &&
      2.0 * (best.at.value - power_law.at.value) < least_gain(fit.delta_fixed))
    fit.why = no_fall_off;
  else if (!fit.delta_fixed && !best.p.empty())
    fit.why = outside(std::exp(best.p[log_delta]));
  if (fit.why.empty() && best.p.empty()) fit.why = "no optimum found";
  if (!fit.why.empty()) return fit;
  Covariance covariance = covariance_of(best.at.information);
  if (covariance.n == 0) return without_numbers(fit, singular);
  const double chi2 = -2.0 * best.at.value;
  for (double &entry : covariance.entries) entry *= std::max(1.0, chi2 / fit.dof);
  // From ln C in units of exp(reference) to ln C in the unit of the data.
  Vector p = completed(best.p, held);
  p[log_c] -= p[shape] * reference;
  const Covariance all = of_all(covariance, log_c);
  if (!best.converged && ridge(p, all, reference).empty())
    return without_numbers(fit, "no optimum found");
  report(p, {1.0, -reference, 0.0, 0.0}, all, reference, fit);
  if (!fit.degenerate) fit.chi2 = chi2;
  return fit;
}

double p_value(const GeneralisedGammaFit &fit, const std::vector<double> &values, int replicas,
               std::uint64_t seed) {
  if (fit.degenerate)
    throw std::invalid_argument("p-value of a degenerate generalised gamma density: " + fit.why);
  if (fit.dof > 0) return gsl_cdf_chisq_Q(fit.chi2, fit.dof);
  if (replicas == 0) return NAN;
  // The distance does not depend on the unit of time, so the one in which B is 1 is used.
  const double unit = std::log(fit.B) / fit.delta;
  std::vector<double> v = logs_from(fit.lo, values);
  for (double &v_i : v) v_i -= unit;
  std::sort(v.begin(), v.end());
  const GammaLaw law{fit.lo > 0.0 ? std::log(fit.lo) - unit : -HUGE_VAL, fit.delta, fit.gamma};
  FittedLaw fitted;
  fitted.survival = law.survival();
  fitted.draw = [n = v.size(), sampler = sampler_of(law)](gsl_rng *rng) {
    std::vector<double> drawn(n);
    for (double &v_i : drawn) v_i = sampler(rng);
    return drawn;
  };
  // Any optimum counts as the fit of a replica, even if it would be called degenerate for data.
  fitted.refit = [&](const Sample &sample) {
    const GammaLikelihood replica{sample, law.lower};
    GammaLaw best = replica.at(fit.delta);
    if (!fit.delta_fixed) {
      best = replica.best_near(best);
      if (!std::isfinite(best.log_likelihood)) best = replica.best();
    }
    return std::isfinite(best.log_likelihood) ? best.cdf() : FittedLaw::Function();
  };
  // Without truncation, a thousandth of a value is expected below the first edge.
  const double first =
      law.truncated() ? law.lower : std::log(1e-3 / static_cast<double>(v.size())) / fit.gamma;
  fitted.edges = {first, law.end()};
  return share_of_worse_fits(fitted, v, fit.ks, replicas, seed);
}

}  // namespace LSM::postproc
