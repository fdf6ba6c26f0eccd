// SPDX-License-Identifier: GPL-2.0-or-later
// Spontaneous mode II rupture between two elastic half-spaces by a spectral boundary integral
// method: the reference for the ruptures of the lattice, without mesh, borders, or waves computed
// in the blocks.
//
// On the fault (Perrin, Rice and Zheng 1995; Geubelle and Rice 1995; Cochard and Rice 1997)
//   tau(x, t) = tau0 + f(x, t) - mu / (2 cs) V,
// where f has the Fourier coefficients
//   F(k, t) = -(mu |k| / 2) integral_0^t C(|k| cs s) D(k, t - s) |k| cs ds,
//   C(T) = J1(T) / T + 4 T (W(kappa T) - W(T)) + 3 J0(T) - (4 / kappa) J0(kappa T),
//   W(T) = 1 - integral_0^T J1(u) / u du, kappa = cp / cs, D: slip.
// D is taken as linear in each time step, over which the kernel is integrated; slip is integrated
// by Heun's scheme, the state of rate-and-state friction over each step at its mean slip rate.
//
//   lsm_boundary_integral PROBLEM SPACING END EVERY [ratio=R] [barrier=S] > CSV, with PROBLEM
//   tpv205, tpv3 or tpv101, in metres and seconds; R is cp / cs, sqrt 3 unless given, at an
//   unchanged cs; S multiplies weakening and Dc of slip weakening from 6 to 9 km on both sides.

#include <fftw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double rho = 2670.0, cp = 6000.0, mu_static = 0.677, mu_dynamic = 0.525, dc = 0.4;
constexpr double normal_stress = 120e6, half_fault = 15000.0, period = 102400.0;
// of TPV101: reference, evolution effect, slip over which the state evolves, reference velocity
constexpr double f0 = 0.6, b = 0.012, length = 0.02, v0 = 1e-6;
const double cs = cp / std::sqrt(3.0), mu = rho * cs * cs;

/// C, tabulated on a fine grid.
class Kernel {
 public:
  Kernel(double end, double kappa) {
    const auto n = static_cast<std::size_t>(kappa * end / step) + 3;
    std::vector<double> w(n);
    w[0] = 1.0;
    const auto slope = [](double u) { return u > 0.0 ? j1(u) / u : 0.5; };
    for (std::size_t i = 1; i < n; ++i) {
      const double a = static_cast<double>(i - 1) * step;
      w[i] = w[i - 1] - step / 6.0 * (slope(a) + 4.0 * slope(a + 0.5 * step) + slope(a + step));
    }
    const auto at = [&w](double u) {
      const auto i = static_cast<std::size_t>(u / step);
      const double part = u / step - static_cast<double>(i);
      return w[i] + part * (w[i + 1] - w[i]);
    };
    for (double u = 0.0; u < end + 2.0 * step; u = step * static_cast<double>(values_.size()))
      values_.push_back(slope(u) + 4.0 * u * (at(kappa * u) - at(u)) + 3.0 * j0(u) -
                        4.0 / kappa * j0(kappa * u));
  }
  double operator()(double u) const {
    const auto i = static_cast<std::size_t>(u / step);
    const double part = u / step - static_cast<double>(i);
    return values_[i] + part * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr double step = 0.002;
  std::vector<double> values_;
};

struct Problem {
  bool patches = false;     ///< of higher and lower stress, TPV205
  bool rate_state = false;  ///< TPV101
  double kappa = cp / cs;
  double barrier = 1.0;
};

class Fault {
 public:
  Fault(const Problem &problem, double spacing, double end)
      : problem_(problem),
        n_(static_cast<std::size_t>(std::lround(period / spacing))),
        modes_(n_ / 2 + 1),
        dx_(period / static_cast<double>(n_)),
        dt_(0.4 * dx_ / cs),
        steps_(static_cast<std::size_t>(std::ceil(end / dt_))),
        slip(n_),
        rate(n_),
        initial_(n_),
        added_(n_),
        factor_(n_),
        a_(n_),
        state_(n_),
        breaks_(n_),
        real_(n_),
        spectrum_(modes_),
        past_(modes_) {
    for (std::size_t i = 0; i < n_; ++i) {
      const double at = x(i), e = 0.01 * dx_;
      // A place at the edge of a patch gets the mean of both sides.
      const auto within = [at, e](double lo, double hi) {
        return 0.5 * ((at > lo + e && at < hi - e) + (at > lo - e && at < hi + e));
      };
      const double left = within(-9000.0, -6000.0), right = within(6000.0, 9000.0);
      initial_[i] = 70e6 + 11.6e6 * within(-1500.0, 1500.0);
      if (problem.patches) initial_[i] += 8e6 * left - 8e6 * right;
      factor_[i] = 1.0 + (problem.barrier - 1.0) * (left + right);
      breaks_[i] = std::fabs(at) < half_fault - e;
      if (problem.rate_state) begin_state(i);
    }
    auto *const out = reinterpret_cast<fftw_complex *>(spectrum_.data());
    const auto size = static_cast<int>(n_);
    forward_ = fftw_plan_dft_r2c_1d(size, real_.data(), out, FFTW_ESTIMATE);
    back_ = fftw_plan_dft_c2r_1d(size, out, real_.data(), FFTW_ESTIMATE);
    make_weights(problem.kappa);
    for (auto &part : history_) part.assign(modes_ * (steps_ + 2), 0.0);
  }
  Fault(const Fault &) = delete;
  ~Fault() {
    fftw_destroy_plan(forward_);
    fftw_destroy_plan(back_);
  }

  double x(std::size_t i) const {
    return (static_cast<double>(i) - 0.5 * static_cast<double>(n_)) * dx_;
  }
  std::size_t nearest(double at) const {
    return static_cast<std::size_t>(std::lround(at / dx_ + 0.5 * static_cast<double>(n_)));
  }
  double dt() const { return dt_; }
  std::size_t steps() const { return steps_; }

  /// Computes the slip rates of a step, then the slip of the next step.
  void step(std::size_t n) {
    find_rate(n, slip, state_, rate);
    std::vector<double> tried = slip, state = state_, then(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      tried[i] += dt_ * rate[i];
      state[i] = evolved(state_[i], rate[i]);
    }
    find_rate(n + 1, tried, state, then);
    after_.resize(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      const double mean = 0.5 * (rate[i] + then[i]);
      after_[i] = slip[i] + dt_ * mean;
      state_[i] = evolved(state_[i], mean);
    }
  }
  void advance() { slip = after_; }

 private:
  /// TPV101: a, the stress added within the first second, and the state that holds 75 MPa at
  /// 1e-12 m/s.
  void begin_state(std::size_t i) {
    const double at = std::fabs(x(i)), r = at / 3000.0, taper = at - half_fault;
    const double inside = taper <= 0.0 ? 1.0
                          : taper >= 3000.0
                              ? 0.0
                              : 0.5 * (1.0 + std::tanh(3000.0 / (taper - 3000.0) + 3000.0 / taper));
    a_[i] = 0.008 + 0.008 * (1.0 - inside);
    initial_[i] = 75e6;
    added_[i] = r < 1.0 ? 25e6 * std::exp(r * r / (r * r - 1.0)) : 0.0;
    const double force = std::log(2.0 * std::sinh(initial_[i] / (a_[i] * normal_stress)));
    state_[i] = length / v0 * std::exp((a_[i] * (force - std::log(1e-12 / v0)) - f0) / b);
  }
  /// The state after a step at this slip rate, by the ageing law.
  double evolved(double state, double v) const {
    const double part = std::fabs(v) * dt_ / length;
    return part > 1e-12 ? state * std::exp(-part) - std::expm1(-part) * dt_ / part : state + dt_;
  }
  /// The slip rate at which rate-and-state friction and radiation carry the load: with q = friction
  /// / (a normal stress), q + w sinh q = load / (a normal stress).
  double sliding(std::size_t i, double load, double state) const {
    const double unit = a_[i] * normal_stress, wanted = std::fabs(load) / unit;
    const double v = 2.0 * v0 * std::exp(-(f0 + b * std::log(v0 * state / length)) / a_[i]);
    const double w = mu / (2.0 * cs) * v / unit;
    double q = std::min(wanted, std::asinh(wanted / w));  // not below the root
    for (int n = 0; n < 60; ++n) {
      const double change = (q + w * std::sinh(q) - wanted) / (1.0 + w * std::cosh(q));
      q -= change;
      if (std::fabs(change) <= 1e-13 * q) break;
    }
    return std::copysign(v * std::sinh(q), load);
  }

  /// Computes the weights of the slip m steps ago: integrals of the kernel times a hat function.
  void make_weights(double kappa) {
    const Kernel kernel(pi / dx_ * cs * dt_ * static_cast<double>(steps_ + 2), kappa);
    weights_.assign(modes_ * (steps_ + 2), 0.0);
    constexpr std::array<double, 4> place = {0.06943184420297371, 0.33000947820757187,
                                             0.66999052179242813, 0.93056815579702629};
    constexpr std::array<double, 4> weight = {0.17392742256872693, 0.32607257743127307,
                                              0.32607257743127307, 0.17392742256872693};
    for (std::size_t k = 1; k < modes_; ++k) {
      const double q = 2.0 * pi * static_cast<double>(k) / period, turn = q * cs * dt_;
      double *const w = &weights_[k * (steps_ + 2)];
      for (std::size_t m = 0; m <= steps_; ++m)
        for (std::size_t g = 0; g < place.size(); ++g) {
          const double part =
              0.5 * mu * q * turn * weight[g] * kernel(turn * (static_cast<double>(m) + place[g]));
          w[m] += part * (1.0 - place[g]);
          w[m + 1] += part * place[g];
        }
    }
  }

  /// Computes the slip rate of step n for the slip d, which is stored in the history.
  void find_rate(std::size_t n, const std::vector<double> &d, const std::vector<double> &state,
                 std::vector<double> &v) {
    real_ = d;
    fftw_execute(forward_);
    const std::size_t row = steps_ + 2;
    for (std::size_t k = 0; k < modes_; ++k) {
      // The history is stored in reverse order, so that it is multiplied by the weights in order.
      history_[0][k * row + row - 1 - n] = spectrum_[k].real();
      history_[1][k * row + row - 1 - n] = spectrum_[k].imag();
    }
    for (std::size_t k = 1; k < modes_; ++k) {
      const double *const w = &weights_[k * row];
      // What earlier steps give is the same for the slip that is tried and for that of the step.
      for (int part : {0, 1}) {
        if (past_step_ == n) break;
        const double *const h = &history_[static_cast<std::size_t>(part)][k * row + row - 1 - n];
        double lane[8] = {0.0};
        std::size_t m = 1;
        for (; m + 8 <= n + 1; m += 8)
          for (std::size_t l = 0; l < 8; ++l) lane[l] += w[m + l] * h[m + l];
        for (; m <= n; ++m) lane[0] += w[m] * h[m];
        reinterpret_cast<double(&)[2]>(past_[k])[part] =
            ((lane[0] + lane[1]) + (lane[2] + lane[3])) +
            ((lane[4] + lane[5]) + (lane[6] + lane[7]));
      }
      spectrum_[k] = -(past_[k] + w[0] * spectrum_[k]) / static_cast<double>(n_);
    }
    past_step_ = n;
    spectrum_[0] = 0.0;
    fftw_execute(back_);
    const double t = std::min(1.0, static_cast<double>(n) * dt_);
    const double share = t > 0.0 ? std::exp((t - 1.0) * (t - 1.0) / (t * (t - 2.0))) : 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      const double load = initial_[i] + share * added_[i] + real_[i];
      if (problem_.rate_state) {
        v[i] = sliding(i, load, state[i]);
        continue;
      }
      const double left = 1.0 - std::min(1.0, d[i] / (factor_[i] * dc));
      const double friction = mu_dynamic + (mu_static - mu_dynamic) * factor_[i] * left;
      v[i] = breaks_[i] ? std::max(0.0, (load - normal_stress * friction) * 2.0 * cs / mu) : 0.0;
    }
  }

  Problem problem_;
  std::size_t n_, modes_;
  double dx_, dt_;
  std::size_t steps_;

 public:
  std::vector<double> slip, rate;

 private:
  std::vector<double> initial_, added_, factor_, a_, state_, after_;
  std::vector<char> breaks_;
  std::vector<double> real_;
  std::vector<std::complex<double>> spectrum_, past_;
  std::size_t past_step_ = 0;  // of which past_ is
  fftw_plan forward_, back_;
  std::vector<double> weights_;
  std::array<std::vector<double>, 2> history_;  // by mode, then by step, the latest first
};

/// Samples of a place. Printed are as few as linear interpolation needs for an error below a
/// thousandth.
struct Station {
  std::size_t place;
  std::vector<std::array<double, 3>> all;  // time, slip, slip rate

  void print(const std::string &name, double x) const {
    double most[2] = {0.0, 0.0};
    for (const auto &s : all)
      for (std::size_t c : {0, 1}) most[c] = std::max(most[c], std::fabs(s[c + 1]));
    std::size_t last = 0;
    const auto write = [&](std::size_t n) {
      std::printf("%s,%g,%.6g,%.5g,%.5g\n", name.c_str(), x, all[n][0], all[n][1], all[n][2]);
      last = n;
    };
    write(0);
    for (std::size_t n = 2; n < all.size(); ++n) {
      bool straight = true;
      for (std::size_t m = last + 1; m < n && straight; ++m)
        for (std::size_t c : {1, 2}) {
          const double part = (all[m][0] - all[last][0]) / (all[n][0] - all[last][0]);
          const double line = all[last][c] + part * (all[n][c] - all[last][c]);
          straight = straight && std::fabs(line - all[m][c]) <= 2e-3 * most[c - 1];
        }
      if (!straight) write(n - 1);
    }
    write(all.size() - 1);
  }
};

}  // namespace

int main(int argc, char **argv) {
  const std::string name = argc > 4 ? argv[1] : "";
  Problem problem;
  problem.patches = name == "tpv205";
  problem.rate_state = name == "tpv101";
  bool known = problem.patches || problem.rate_state || name == "tpv3";
  const double spacing = known ? std::atof(argv[2]) : 0.0, end = known ? std::atof(argv[3]) : 0.0;
  const double every = known ? std::atof(argv[4]) : 0.0;
  std::string more;
  for (int n = 5; n < argc; ++n) {
    more += std::string(n > 5 ? ", " : "") + argv[n];
    known = known && (std::sscanf(argv[n], "ratio=%lf", &problem.kappa) == 1 ||
                      std::sscanf(argv[n], "barrier=%lf", &problem.barrier) == 1);
  }
  if (!(known && spacing >= 5.0 && spacing <= 1000.0 && end > 0.0 && end <= 12.0 &&
        every >= 100.0 && problem.kappa > 1.2 && problem.kappa < 5.0 && problem.barrier >= 1.0)) {
    std::fprintf(stderr,
                 "usage: lsm_boundary_integral tpv205|tpv3|tpv101 SPACING END EVERY [ratio=R] "
                 "[barrier=S]: spacing 5 to 1000 m, end up to 12 s, stations every so many metres, "
                 "at least 100, ratio of the wave speeds 1.2 to 5, barrier at least 1\n");
    return 1;
  }
  Fault fault(problem, spacing, end);
  std::vector<Station> stations;
  const double reach = problem.rate_state ? half_fault + 3000.0 : half_fault;
  const int side = static_cast<int>(reach / every);
  for (int n = -side; n <= side; ++n)
    if (std::fabs(n * every) < reach) stations.push_back({fault.nearest(n * every), {}});
  for (std::size_t n = 0; n <= fault.steps(); ++n) {
    fault.step(n);
    for (Station &s : stations)
      s.all.push_back(
          {static_cast<double>(n) * fault.dt(), fault.slip[s.place], fault.rate[s.place]});
    fault.advance();
  }
  char curve[64];
  std::snprintf(curve, sizeof curve, "boundary integral %g m", spacing);
  std::printf(
      "# %s: spectral boundary integral, spacing %g m (tests/accuracy/boundary_integral.cpp); m, "
      "s\n",
      name.c_str(), spacing);
  if (!more.empty()) std::printf("# %s\n", more.c_str());
  std::printf("curve,x,t,slip,slip_rate\n");
  for (const Station &s : stations) s.print(curve, fault.x(s.place));
  return 0;
}
