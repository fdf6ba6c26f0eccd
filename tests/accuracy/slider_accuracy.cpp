// SPDX-License-Identifier: GPL-2.0-or-later
// Block-slider: error against run time of one event and of long runs for every scheme, and the
// growth rate of the printed scheme. Writes slider_event.csv, slider_growth.csv and
// slider_long.csv. Usage: lsm_accuracy_slider FOLDER full|quick
#include <chrono>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "event_statistics.h"
#include "events/event_picker.h"
#include "slider_chain.h"
#include "switching_chain.h"

using namespace Slider;

namespace {

constexpr double event_time = 51.2;
constexpr AnyScheme rk4 = Located::rk4, reference = Located::reference;
constexpr AnyScheme all_schemes[] = {Scheme::printed, Scheme::verlet, rk4};

class Table {
 public:
  Table(const std::string &path, const char *columns) : file_(std::fopen(path.c_str(), "w")) {
    if (!file_) throw std::runtime_error(path + ": cannot be written");
    std::fprintf(file_, "%s\n", columns);
  }
  ~Table() { std::fclose(file_); }
  Table(const Table &) = delete;
  Table &operator=(const Table &) = delete;
  std::FILE *file() { return file_; }

 private:
  std::FILE *file_;
};

/// Smallest wall-clock time of a call in seconds; short calls are repeated.
double seconds(const std::function<void()> &work) {
  double best = HUGE_VAL, total = 0.0;
  for (int n = 0; n < 3 || (total < 0.2 && n < 200); ++n) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const double took =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best = std::min(best, took);
    total += took;
    if (total > 5.0) break;
  }
  return best;
}

/// A chain with the plate at 0, shortly before a large event.
struct Start {
  Parameters p;
  std::vector<double> mu, u, v;
  double pe = 0.0;
};

/// Of several states, the one from which PE falls most within the time of the comparison.
Start before_large_event() {
  Start start;
  start.p.blocks = 128;
  start.p.dt = 0.02;
  start.mu = random_friction(start.p.blocks, 0.5, 1.0, 3);
  Chain chain(start.p, start.mu, false);
  Start best = start;
  double most = 0.0;
  while (chain.time() < 20000.0) {
    const double before = chain.pe(), plate = chain.plate();
    start.u = chain.displacements();
    start.v = chain.velocities();
    for (int n = 0; n * start.p.dt < event_time; ++n) chain.advance();
    if (chain.time() < 12000.0 || before - chain.pe() <= most) continue;
    most = before - chain.pe();
    best = start;
    for (double &u : best.u) u -= plate;
    best.pe = direct_energy(best.p, best.u, 0.0);
  }
  return best;
}

/// Puts a chain into the state.
template <class C>
void put(C &chain, const Start &start) {
  ChainState s;
  s.u = start.u;
  s.v = start.v;
  s.pe_sum = start.pe;
  LSM::NeumaierSum slip;
  for (double u : start.u) slip.add(u);
  s.slip_sum = slip.value();
  chain.set_state(s);
}

struct Outcome {
  std::vector<double> u;
  double pe = 0.0;
};

Outcome run(const Start &start, const AnyScheme &scheme, double h, double time) {
  Parameters p = start.p;
  p.dt = h;
  return with_chain(p, start.mu, scheme, [&](auto &chain) -> Outcome {
    put(chain, start);
    for (long n = 0; n < std::lround(time / h); ++n) chain.advance();
    return {chain.displacements(), direct_energy(p, chain.displacements(), p.velocity * time)};
  });
}

void one_event(const std::string &folder, bool quick) {
  const Start start = before_large_event();
  const double time = event_time;
  const Outcome exact = run(start, reference, 0.1, time);
  const double size = start.pe - exact.pe;
  double slip = 0.0;
  for (std::size_t i = 0; i < exact.u.size(); ++i) slip = std::max(slip, exact.u[i] - start.u[i]);

  auto profile_error = [&](const std::vector<double> &u) {
    double worst = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i)
      worst = std::max(worst, std::fabs(u[i] - exact.u[i]));
    return worst / slip;
  };
  Table table(folder + "/slider_event.csv", "scheme,dt,seconds,error_profile,error_size");
  const Outcome again = run(start, reference, 0.025, time);
  std::fprintf(table.file(), "# blocks %d, time %g, largest slip %.6g, drop of PE %.6g\n",
               start.p.blocks, time, slip, size);
  std::fprintf(table.file(),
               "# reference against itself with another step: %.3g of the largest slip\n",
               profile_error(again.u));
  for (const AnyScheme &scheme : all_schemes)
    for (double h = 0.4; h > (quick ? 0.01 : 0.0015); h /= 2.0) {
      if (scheme == rk4 && h < 0.006) continue;  // below the rounding error of the reference
      const Outcome o = run(start, scheme, h, time);
      const double took = seconds([&] { run(start, scheme, h, time); });
      std::fprintf(table.file(), "%s,%.6g,%.4g,%.4g,%.4g\n", name_of(scheme), h, took,
                   profile_error(o.u), std::fabs(start.pe - o.pe - size) / size);
    }
}

/// Two blocks without friction oscillate against each other while both drift forward, so that the
/// rule against back-slip never acts: the shortest wave of the chain, w^2 = (4 K_c + K_l) / M.
void growth(const std::string &folder) {
  Table table(folder + "/slider_growth.csv", "scheme,dt,growth_rate,theory");
  for (Scheme scheme : {Scheme::printed, Scheme::verlet})
    for (double h : {0.005, 0.01, 0.02, 0.05, 0.1}) {
      Parameters p;
      p.blocks = 2;
      p.velocity = 1.0;
      p.scheme = scheme;
      p.dt = h;
      const double w2 = (4.0 * p.kc + p.kl) / p.mass, w = std::sqrt(w2);
      Chain chain(p, {0.0, 0.0}, false);
      ChainState s = chain.state();
      const double amplitude = 1e-8;
      s.u = {0.0, 0.0};
      s.v = {p.velocity + amplitude * w, p.velocity - amplitude * w};
      s.quiet_since = -1;
      chain.set_state(s);
      // Energy of the antisymmetric motion, averaged over ten periods at the beginning and the end.
      const long window = std::lround(10.0 * 2.0 * 3.14159265358979 / w / h);
      const long apart = std::lround(2.0 / (h * w2 / 4.0) / h);  // in theory two e-foldings
      auto energy = [&] {
        double sum = 0.0;
        for (long n = 0; n < window; ++n) {
          chain.advance();
          const auto u = chain.displacements(), v = chain.velocities();
          sum += 0.25 * ((v[0] - v[1]) * (v[0] - v[1]) + w2 * (u[0] - u[1]) * (u[0] - u[1]));
        }
        return sum / static_cast<double>(window);
      };
      const double first = energy();
      for (long n = 0; n < apart; ++n) chain.advance();
      const double second = energy();
      const double rate =
          0.5 * std::log(second / first) / (static_cast<double>(window + apart) * h);
      std::fprintf(table.file(), "%s,%g,%.6g,%.6g\n", to_string(scheme), h, rate,
                   scheme == Scheme::printed ? h * w2 / 4.0 : 0.0);
    }
}

void long_runs(const std::string &folder, bool quick) {
  const double time = quick ? 40000.0 : 200000.0, warmup = 12000.0;
  Table table(
      folder + "/slider_long.csv",
      "scheme,dt,seconds,events,mean_size,mean_error,star,star_error,alpha_small,alpha_small_error,"
      "alpha_large,alpha_large_error");
  std::fprintf(table.file(), "# 256 blocks, time %g, events of size 1e-3 and more after time %g\n",
               time, warmup);
  auto one = [&](const AnyScheme &scheme, double h, double end) {
    Parameters p;
    p.blocks = 256;
    p.dt = h;
    const auto mu = random_friction(p.blocks, 0.5, 1.0, 1);
    LSM::PickerSettings settings;
    settings.lambda = LSM::lambda_from_memory_time(1.0, h);
    LSM::EventPicker picker(settings);
    std::vector<double> sizes;
    const auto start = std::chrono::steady_clock::now();
    with_chain(p, mu, scheme, [&](auto &chain) {
      const auto last = static_cast<std::int64_t>(std::lround(end / h));
      LSM::Event event;
      picker.push_change(0, 0.0, chain.pe(), 0.0, event);
      while (chain.step() < last) {
        chain.advance();
        if (picker.push_change(chain.step(), chain.time(), chain.pe(), chain.dpe(), event) &&
            event.t_start >= warmup && event.size >= 1e-3)
          sizes.push_back(event.size);
      }
    });
    const double took =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto mean = Accuracy::mean(sizes), star = Accuracy::characteristic_size(sizes),
               small = Accuracy::exponent(sizes, 0.01, 1.0),
               large = Accuracy::exponent(sizes, 1.0, 100.0);
    std::fprintf(table.file(), "%s,%g,%.3f,%zu,%.4g,%.2g,%.4g,%.2g,%.3f,%.3f,%.3f,%.3f\n",
                 name_of(scheme), h, took, sizes.size(), mean.value, mean.error, star.value,
                 star.error, small.value, small.error, large.value, large.error);
    std::fflush(table.file());
  };
  for (Scheme scheme : {Scheme::printed, Scheme::verlet})
    for (double h : {0.2, 0.1, 0.05, 0.02, 0.01}) {
      if (scheme == Scheme::printed && h > 0.1) continue;  // overflows
      one(scheme, h, time);
    }
  one(rk4, 0.1, quick ? 20000.0 : time);
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 3 || (std::string(argv[2]) != "full" && std::string(argv[2]) != "quick")) {
    std::fprintf(stderr, "usage: lsm_accuracy_slider FOLDER full|quick\n");
    return 2;
  }
  try {
    const bool quick = std::string(argv[2]) == "quick";
    one_event(argv[1], quick);
    growth(argv[1]);
    long_runs(argv[1], quick);
  } catch (const std::exception &e) {
    std::fprintf(stderr, "lsm_accuracy_slider: %s\n", e.what());
    return 1;
  }
  return 0;
}
