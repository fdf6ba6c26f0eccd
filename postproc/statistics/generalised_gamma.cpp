// SPDX-License-Identifier: GPL-2.0-or-later
#include "generalised_gamma.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_sf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
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
using Matrix = std::array<Vector, parameters>;

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

// Likelihood of a sample of logarithms from `lower` on, maximised over gamma and the scale for each
// delta.
struct ProfileLikelihood {
  const Sample &sample;
  double lower;
  double mean_v = sample.mean([](double v) { return v; });

  // Log-likelihood per value of the power law without a fall-off; only for a truncated sample.
  double power_law() const { return -std::log(mean_v - lower) - 1.0; }

  GammaLaw at(double delta) const {
    GammaLaw law{lower, delta};
    if (law.truncated()) {
      const double mean_t = sample.mean([&](double v) { return std::exp(delta * (v - lower)); });
      const TiltedFit fit = fit_tilted({delta}, mean_v - lower, mean_t, HUGE_VAL);
      if (!fit.converged) return law;
      law.gamma = fit.b;
      law.v0 = lower - std::log(fit.c) / delta;
      law.log_likelihood = fit.log_likelihood;
      return law;
    }
    // w = theta^delta has a gamma distribution of shape k = gamma / delta. As ln k - psi(k) falls
    // from infinity to 0, there is exactly one solution, which is found by Newton's method in ln k.
    const double mean_w = sample.mean([&](double v) { return std::exp(delta * v); });
    const double target = std::log(mean_w) - delta * mean_v;
    if (!(target > 1e-12)) return law;
    double k = 0.5 / target + 0.2;
    for (int i = 0; i < 100; ++i) {
      const double slope = 1.0 - k * gsl_sf_psi_1(k);
      const double step = (std::log(k) - gsl_sf_psi(k) - target) / slope;
      k *= std::exp(std::clamp(-step, -2.0, 2.0));
      if (std::fabs(step) < 1e-14) break;
    }
    const double log_b = std::log(mean_w / k);
    law.gamma = k * delta;
    law.v0 = log_b / delta;
    law.log_likelihood = std::log(delta) - k * log_b - gsl_sf_lngamma(k) + law.gamma * mean_v - k;
    return law;
  }

  // Best delta in (delta_min, delta_max): a coarse scan, since there may be several maxima, then
  // Brent's method around the best one.
  GammaLaw best() const {
    constexpr int steps = 20;
    const double first = std::log(delta_min), width = std::log(delta_max / delta_min) / steps;
    std::vector<GammaLaw> scan;
    for (int i = 0; i <= steps; ++i) scan.push_back(at(std::exp(first + i * width)));
    const auto top = std::max_element(scan.begin(), scan.end(), [](const auto &a, const auto &b) {
      return a.log_likelihood < b.log_likelihood;
    });
    if (top == scan.begin() || top == scan.end() - 1 || std::isinf(top->v0)) return *top;
    return between(*(top - 1), *top, *(top + 1), 1e-7);
  }

  // The same for a replica: searches outwards from the best delta of the data. The tolerance only
  // has to keep the error far below that of the distance to be computed.
  GammaLaw best_near(double delta) const {
    constexpr double width = 0.15;
    const auto beside = [this, delta](int k) { return at(delta * std::exp(k * width)); };
    GammaLaw low = beside(-1), middle = at(delta), high = beside(1);
    for (int k = 1; std::isfinite(middle.log_likelihood) && !std::isinf(middle.v0); ++k) {
      if (middle.log_likelihood >= low.log_likelihood &&
          middle.log_likelihood >= high.log_likelihood)
        return between(low, middle, high, 1e-4);
      if (k == 8) break;
      const bool up = high.log_likelihood > low.log_likelihood;
      const double next = (up ? high : low).delta * std::exp(up ? width : -width);
      if (!(next > delta_min && next < delta_max)) break;
      (up ? low : high) = std::exchange(middle, up ? high : low);
      (up ? high : low) = at(next);
    }
    return best();
  }

 private:
  // Brent's method between two values of delta that bracket a better one.
  GammaLaw between(const GammaLaw &low, const GammaLaw &middle, const GammaLaw &high,
                   double tolerance) const {
    gsl_function function;
    function.params = const_cast<ProfileLikelihood *>(this);
    function.function = [](double x, void *self) {
      return -static_cast<const ProfileLikelihood *>(self)->at(std::exp(x)).log_likelihood;
    };
    const Gsl<gsl_min_fminimizer> minimiser(gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent),
                                            gsl_min_fminimizer_free);
    gsl_min_fminimizer *const work = minimiser.get();
    if (gsl_min_fminimizer_set_with_values(
            work, &function, std::log(middle.delta), -middle.log_likelihood, std::log(low.delta),
            -low.log_likelihood, std::log(high.delta), -high.log_likelihood) != GSL_SUCCESS)
      return middle;
    for (int i = 0; i < 50 && gsl_min_fminimizer_iterate(work) == GSL_SUCCESS; ++i)
      if (gsl_min_fminimizer_x_upper(work) - gsl_min_fminimizer_x_lower(work) < tolerance) break;
    return at(std::exp(gsl_min_fminimizer_x_minimum(work)));
  }
};

// Derivatives of ln f, apart from ln C, with respect to the parameters.
struct Derivatives {
  Derivatives(double v, const GammaLaw &law) {
    const double delta = law.delta, w = delta * (v - law.v0), s = std::exp(w);
    first = {0.0, v, delta * s, -s * w};
    second[log_delta][log_delta] = -s * w * (1.0 + w);
    second[log_delta][scale] = second[scale][log_delta] = delta * s * (1.0 + w);
    second[scale][scale] = -delta * delta * s;
  }
  Vector first;
  Matrix second{};
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
std::string no_density(const ProfileLikelihood &likelihood, const GammaLaw &best,
                       bool delta_fixed) {
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

// Observed information of the sample on the free parameters; ln C follows from them by
// normalisation.
// \param mean_slope receives the means of the first derivatives over the law
SymmetricMatrix information_at(const GammaLaw &law, const Sample &sample,
                               const TabulatedDensity &table, bool delta_fixed,
                               Numbers &mean_slope) {
  for (std::size_t a = shape; a < parameters; ++a)
    mean_slope[a] = table.mean([&](double v) { return Derivatives(v, law).first[a]; });
  SymmetricMatrix information(delta_fixed ? 2 : 3);
  for (std::size_t i = 0; i < information.n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const std::size_t a = shape + i, b = shape + j;
      const double of_law = table.mean([&](double v) {
        const Derivatives at(v, law);
        return at.first[a] * at.first[b] + at.second[a][b];
      });
      const double of_data =
          b == shape ? 0.0
                     : sample.mean([&](double v) { return Derivatives(v, law).second[a][b]; });
      information(i, j) = information(j, i) =
          sample.n() * (of_law - mean_slope[a] * mean_slope[b] - of_data);
    }
  return information;
}

void report(const Sample &sample, const GammaLaw &best, double reference,
            GeneralisedGammaFit &fit) {
  const auto &[lower, delta, gamma, v0, log_likelihood] = best;
  const double mode = gamma > 0.0 ? v0 + std::log(gamma / delta) / delta : -HUGE_VAL;
  const TabulatedDensity table =
      tabulate([&best](double x) { return best.gamma * x - std::exp(best.delta * (x - best.v0)); },
               std::max(mode, lower), lower, HUGE_VAL, 1.0 / delta);
  Numbers slope_c(parameters);
  const Covariance covariance =
      covariance_of(information_at(best, sample, table, fit.delta_fixed, slope_c));
  if (covariance.n == 0) {
    fit.why = singular;
    return;
  }
  for (double &slope : slope_c) slope = -slope;
  slope_c[shape] -= reference;
  report({-table.log_z - gamma * reference, gamma, v0, std::log(delta)}, slope_c,
         of_all(covariance, shape), reference, fit);
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
  const ProfileLikelihood likelihood{sample, lo > 0.0 ? std::log(lo) - reference : -HUGE_VAL};
  const GammaLaw best = fit.delta_fixed ? likelihood.at(delta) : likelihood.best();
  fit.why = no_density(likelihood, best, fit.delta_fixed);
  if (fit.why.empty()) report(sample, best, reference, fit);
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
  Numbers weights;
  for (const LogBin &bin : used) weights.push_back(static_cast<double>(bin.count));
  const auto solve = [&](const std::vector<Numbers> &starts, const Vector &held) {
    return least_squares(weights, starts, [&](std::size_t i, const Numbers &p, Numbers &slope) {
      return log_average(data[i], completed(p, held), slope) - data[i].log_density;
    });
  };

  const double last = std::log(used.back().hi) - reference;
  const double first_c = std::log(used.front().density);
  // Pure power law: the scale is held so far beyond the data that there is no fall-off.
  const LeastSquares power_law = solve({{first_c, 0.5}}, {0.0, 0.0, last + 1000.0, 0.0});
  std::vector<Numbers> starts;
  for (const double v0 : {0.0, 0.5 * last, last}) {
    if (fit.delta_fixed) starts.push_back({first_c, 0.5, v0});
    for (const double start : {0.5, 1.0, 2.0})
      if (!fit.delta_fixed) starts.push_back({first_c, 0.5, v0, std::log(start)});
  }
  const Vector held = {0.0, 0.0, 0.0, std::log(delta)};
  LeastSquares best = solve(starts, held);
  // Tested first, since data from a pure power law drive the parameters to a boundary or along a
  // ridge.
  if (power_law.converged && power_law.chi2 - best.chi2 < least_gain(fit.delta_fixed))
    fit.why = no_fall_off;
  else if (!fit.delta_fixed && !best.p.empty())
    fit.why = outside(std::exp(best.p[log_delta]));
  if (fit.why.empty() && !best.converged) fit.why = "no optimum found";
  if (fit.why.empty() && best.covariance.n == 0) fit.why = singular;
  if (!fit.why.empty()) return fit;
  for (double &entry : best.covariance.entries) entry *= std::max(1.0, best.chi2 / fit.dof);
  // From ln C in units of exp(reference) to ln C in the unit of the data.
  Vector p = completed(best.p, held);
  p[log_c] -= p[shape] * reference;
  report(p, {1.0, -reference, 0.0, 0.0}, of_all(best.covariance, log_c), reference, fit);
  if (!fit.degenerate) fit.chi2 = best.chi2;
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
    const ProfileLikelihood replica{sample, law.lower};
    const GammaLaw best = fit.delta_fixed ? replica.at(fit.delta) : replica.best_near(fit.delta);
    return std::isfinite(best.log_likelihood) ? best.cdf() : FittedLaw::Function();
  };
  // Without truncation, a thousandth of a value is expected below the first edge.
  const double first =
      law.truncated() ? law.lower : std::log(1e-3 / static_cast<double>(v.size())) / fit.gamma;
  fitted.edges = {first, law.end()};
  return share_of_worse_fits(fitted, v, fit.ks, replicas, seed);
}

}  // namespace LSM::postproc
