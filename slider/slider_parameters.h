// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_parameters.h
/// Parameters of the block-slider model of Weatherley and Abe (2004), Sect. 3, and their limits.
#ifndef SLIDER_PARAMETERS_H
#define SLIDER_PARAMETERS_H

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "lsm_names.h"
#include "lsm_random.h"
#include "lsm_text_io.h"
#include "slider_laws.h"

namespace Slider {

using LSM::from_string;
using LSM::to_string;

/// Schemes of a time step. All but printed are ours.
enum class Scheme {
  printed,        ///< Eqs. 7 and 8: x += h v + h^2/2 a, v += h a, force of the old time
  semi_implicit,  ///< v += h a, x += h v (symplectic Euler), order 1
  verlet          ///< velocity Verlet, friction of the new velocity solved in closed form, order 2
};

constexpr std::array<LSM::Named<Scheme>, 3> names_of(Scheme) {
  return {{{Scheme::printed, "printed"},
           {Scheme::semi_implicit, "semi-implicit"},
           {Scheme::verlet, "verlet"}}};
}

/// Parameters of one chain, in model units (paper values unless marked ours).
struct Parameters {
  int blocks = 1928;
  double kc = 1.0;         ///< coupling spring K_c
  double kl = 0.01;        ///< leaf spring K_l
  double mass = 1.0;       ///< mass M of a block
  double velocity = 0.01;  ///< driving velocity V_pl of the plate
  double dt = 0.05;        ///< time step (ours; not in the paper)
  Scheme scheme = Scheme::verlet;
  Friction friction = {};  ///< Eq. 6
};

/// Highest angular frequency of the sliding chain without friction: its shortest wave.
inline double highest_frequency(const Parameters &p) {
  const double pi = 3.14159265358979323846;
  const double phase = 2.0 * pi * (p.blocks / 2) / p.blocks;
  return std::sqrt((2.0 * p.kc * (1.0 - std::cos(phase)) + p.kl) / p.mass);
}

/// Time step above which the scheme is unstable for an undamped spring. The printed scheme is
/// unstable at any step (growth rate h w^2 / 4); its limit is where this exceeds the dissipation by
/// friction, 0.12 for the paper's springs.
inline double stability_limit(const Parameters &p) {
  return (p.scheme == Scheme::printed ? 0.12 * std::sqrt(4.01) : 2.0) / highest_frequency(p);
}

/// Time step above which the growth of the printed scheme changes the statistics (measured).
inline double printed_warning_limit(const Parameters &p) {
  return 0.01 * std::sqrt(4.01) / highest_frequency(p);
}

/// \throws std::invalid_argument with one line naming the option, its value and what is expected.
inline void check(const Parameters &p, bool force) {
  auto fail = [](const std::string &option, double value, const std::string &expected) {
    char text[64];
    std::snprintf(text, sizeof text, "%.6g", value);
    throw std::invalid_argument(option + " = " + text + ", expected " + expected);
  };
  if (p.blocks < 1) fail("--blocks", p.blocks, "at least 1");
  if (p.blocks > 100000000) fail("--blocks", p.blocks, "at most 100000000");
  auto positive = [&](const char *option, double value) {
    if (!std::isfinite(value) || !(value > 0.0)) fail(option, value, "a positive finite number");
  };
  if (!std::isfinite(p.kc) || p.kc < 0.0) fail("--kc", p.kc, "a finite number >= 0");
  positive("--kl", p.kl);
  positive("--mass", p.mass);
  positive("--velocity", p.velocity);
  positive("--dt", p.dt);
  if (!(p.friction.dynamic >= 0.0 && p.friction.dynamic <= 1.0))
    fail("--dynamic-friction", p.friction.dynamic, "at least 0 and at most 1");
  positive("--slip-distance", p.friction.dc);
  const double limit = stability_limit(p);
  if (p.scheme == Scheme::printed) {
    if (p.dt >= limit * (1.0 - 1e-12) && !force)
      fail("--dt", p.dt,
           "less than " + std::to_string(limit) +
               " for the printed scheme, which is unstable there (--force runs it nevertheless)");
  } else if (p.dt > limit) {
    fail("--dt", p.dt,
         "at most " + std::to_string(limit) + ", the stability limit of the " +
             to_string(p.scheme) + " scheme for these springs");
  }
}

/// Static coefficients mu_0i, uniform in [low, high) and drawn in the order of the blocks.
inline std::vector<double> random_friction(int blocks, double low, double high,
                                           std::uint64_t seed) {
  LSM::Random random(seed);
  std::vector<double> mu(static_cast<std::size_t>(blocks));
  for (double &m : mu) m = random.uniform(low, high);
  return mu;
}

/// One static coefficient per line; blank lines and lines starting with # are skipped.
/// \throws std::runtime_error "file:line: what, expected ..."
inline std::vector<double> read_friction(const std::string &path) {
  LSM::text_io::LineReader in(path);
  std::vector<double> mu;
  for (std::string_view line; in.next(line);) {
    const std::string_view word = LSM::text_io::trim(line);
    if (word.empty() || word.front() == '#') continue;
    double value = 0.0;
    if (!LSM::text_io::parse(word, value) || value < 0.0)
      in.fail(LSM::text_io::in_quotes(word) + ", expected one friction coefficient >= 0");
    mu.push_back(value);
  }
  if (mu.empty()) throw std::runtime_error(path + ": no coefficient found, expected one per line");
  return mu;
}

}  // namespace Slider

#endif
