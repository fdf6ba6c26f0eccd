// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_parameters.h
/// Parameters of the block-slider model of Weatherley and Abe (2004), Sect. 3, and their limits.
/// The friction laws are those of lammps-pkg/core/friction under which a block stays at rest until
/// its force exceeds a strength that does not change while it rests. README.md explains why there
/// are no others.
#ifndef SLIDER_PARAMETERS_H
#define SLIDER_PARAMETERS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "friction/coulomb.h"
#include "friction/velocity_weakening.h"
#include "numerics/constants.h"
#include "files/names.h"
#include "numerics/random.h"

namespace Slider {

using LSM::from_string;
using LSM::to_string;

/// Schemes of a time step. All but printed are †.
enum class Scheme {
  printed,  ///< Eqs. 7 and 8: x += h v + h^2/2 a, v += h a, force of the old time
  verlet,   ///< velocity Verlet, friction of the new velocity solved in closed form, order 2
  /// no inertia: v from the balance of springs, friction and radiation, x by the two-step formula
  /// of Adams and Bashforth, order 2
  adams_bashforth
};

constexpr std::array<LSM::Named<Scheme>, 3> names_of(Scheme) {
  return {{{Scheme::printed, "printed"},
           {Scheme::verlet, "verlet"},
           {Scheme::adams_bashforth, "adams-bashforth"}}};
}

enum class Law {
  velocity_weakening,  ///< Eq. 6
  coulomb              ///< static and dynamic friction †
};
constexpr std::array<LSM::Named<Law>, 2> names_of(Law) {
  return {{{Law::velocity_weakening, LSM::VelocityWeakening::name},
           {Law::coulomb, LSM::CoulombStatic::name}}};
}

/// A friction law with its coefficients. The static strength mu is a property of each block.
struct Friction {
  Law law = Law::velocity_weakening;
  double dynamic = 1.0;  ///< coulomb: ratio of dynamic to static strength
};

/// A rough surface whose strength varies with displacement †: the strength of a block is drawn anew
/// from [low, high) each time it has slipped by the given length.
struct Landscape {
  double length = 0.0;  ///< correlation length; 0: strengths are constant
  double low = 0.5, high = 1.0;
  std::uint64_t seed = 1;
};

/// Parameters of one chain, in model units (paper values unless marked †).
struct Parameters {
  int blocks = 1928;
  double kc = 1.0;         ///< coupling spring K_c, which has 1 in the paper: the unit of stiffness
  double kl = 0.01;        ///< leaf spring K_l
  double mass = 1.0;       ///< mass M of a block; 0: no inertia †
  double velocity = 0.01;  ///< driving velocity V_pl of the plate
  double dt = 0.05;        ///< time step † (not in the paper)
  Scheme scheme = Scheme::verlet;
  Friction friction = {};  ///< Eq. 6
  double radiation = 0.0;  ///< damping by radiated waves: force on a block per velocity †
  /// Stiffness of the modes 0 to blocks / 2 in place of the springs K_c †. It includes the leaf
  /// spring, which is the stiffness of mode 0. Empty: springs.
  std::vector<double> modes = {};
  Landscape landscape = {};

  bool by_springs() const { return modes.empty(); }
};

/// Stiffness of the chain for a wave with this phase between neighbours.
inline double stiffness_of_springs(const Parameters &p, double phase) {
  return 2.0 * p.kc * (1.0 - std::cos(phase)) + p.kl;
}

/// Time step above which the scheme is unstable for an undamped spring, or radiation alone would
/// reverse velocities. The printed scheme is unstable at any step h (growth rate h w^2 / 4); its
/// limit is the step at which this exceeds the dissipation by friction, 0.12 for the paper's
/// springs.
inline double stability_limit(const Parameters &p) {
  // The shortest wave of the sliding chain without friction is the stiffest.
  const double stiffest = p.by_springs()
                              ? stiffness_of_springs(p, 2.0 * LSM::pi * (p.blocks / 2) / p.blocks)
                              : *std::max_element(p.modes.begin(), p.modes.end());
  if (p.scheme == Scheme::adams_bashforth) return p.radiation / stiffest;
  const double highest = std::sqrt(stiffest / p.mass), damping = p.radiation / p.mass;
  const double limit = (p.scheme == Scheme::printed ? 0.12 * std::sqrt(4.01) : 2.0) / highest;
  return damping > 0.0 ? std::min(limit, 2.0 / damping) : limit;
}

/// Checks that there is a step for scheme, law and coupling.
/// \throws std::invalid_argument naming the scheme and what it needs
inline void check_scheme(const Parameters &p) {
  const bool weakening = p.friction.law == Law::velocity_weakening;
  if (p.scheme == Scheme::printed && (!weakening || !p.by_springs() || p.radiation > 0.0))
    throw std::invalid_argument(
        "--scheme printed needs --coupling chain and --law velocity-weakening, without "
        "--radiation");
  const bool balances = p.scheme == Scheme::adams_bashforth;
  if (balances != (p.mass == 0.0) || (balances && (weakening || p.by_springs())))
    throw std::invalid_argument(
        "--mass 0 and --scheme adams-bashforth need each other, --law coulomb and a --coupling "
        "other than chain");
}

/// Rejects the value of an option.
/// \throws std::invalid_argument always, with one line: the option, its value and what is expected
[[noreturn]] inline void refuse(const std::string &option, double value,
                                const std::string &expected) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6g", value);
  throw std::invalid_argument(option + " = " + text + ", expected " + expected);
}

/// Checks that all parameters are within their limits.
/// \param force whether the printed scheme may be run with an unstable time step
/// \throws std::invalid_argument as refuse()
inline void check(const Parameters &p, bool force) {
  if (p.blocks < 1 || p.blocks > 100000000) refuse("--blocks", p.blocks, "1 to 100000000");
  if (!std::isfinite(p.radiation) || p.radiation < 0.0)
    refuse("--radiation", p.radiation, "a finite number >= 0");
  if (!std::isfinite(p.mass) || p.mass < 0.0) refuse("--mass", p.mass, "a finite number >= 0");
  if (p.mass == 0.0 && p.radiation == 0.0)
    refuse("--mass", p.mass, "a positive number, or --radiation to balance the springs");
  // cells are counted in 64 bits
  if (!std::isfinite(p.landscape.length) || (p.landscape.length < 1e-9 && p.landscape.length != 0))
    refuse("--correlation-length", p.landscape.length, "0, or a finite number of at least 1e-9");
  for (const auto &[option, value] :
       {std::pair("--kl", p.kl), {"--velocity", p.velocity}, {"--dt", p.dt}})
    if (!std::isfinite(value) || !(value > 0.0)) refuse(option, value, "a positive finite number");
  if (!(p.friction.dynamic >= 0.0 && p.friction.dynamic <= 1.0))
    refuse("--dynamic-friction", p.friction.dynamic, "at least 0 and at most 1");
  check_scheme(p);
  const double limit = stability_limit(p);
  if (p.scheme == Scheme::printed) {
    if (p.dt >= limit * (1.0 - 1e-12) && !force)
      refuse(
          "--dt", p.dt,
          "less than " + std::to_string(limit) +
              " for the printed scheme, which is unstable there (--unstable runs it nevertheless)");
  } else if (p.dt > limit) {
    refuse("--dt", p.dt,
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

}  // namespace Slider

#endif
