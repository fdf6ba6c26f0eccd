// SPDX-License-Identifier: GPL-2.0-or-later
/// \file velocity_weakening.h
/// Friction of the block-slider, Eq. (6) of Weatherley & Abe 2004 (after Carlson et al. 1991): the
/// strength is mu fn / (1 + v / vc), printed with vc = 1. The slider uses the same function.
#ifdef LSM_FRICTION_LAW
LSM_FRICTION_LAW(VelocityWeakening)
#endif
#ifndef LSM_LAW_VELOCITY_WEAKENING_H
#define LSM_LAW_VELOCITY_WEAKENING_H

#include "friction_law.h"

namespace LSM {

struct VelocityWeakening : FrictionLaw {
  struct Coefficients {
    double kt, mu, vc;
  };
  static constexpr const char *name = "velocity-weakening";
  static constexpr Parameter parameters[] = {{"kt", Parameter::positive},
                                             {"mu", Parameter::not_negative},
                                             {"vc", Parameter::positive, 1.0}};
  static constexpr bool needs_time = true;

  /// Eq. (6): friction at speed v, in units of vc, where it is mu0 at rest.
  template <class Number>
  [[gnu::always_inline]] static Number friction(const Number &mu0, const Number &v) {
    return mu0 / (1.0 + v);
  }

  /// The velocity is that of the particles, which have inertia, in the middle of the step. With the
  /// slip velocity, friction would rise as the spring relaxes, and no contact could slide steadily.
  static double elongation(const Coefficients &c, FrictionContact &s, double *) {
    const double strength = friction(c.mu * s.fn, s.speed() / c.vc);
    return stick_or_slide(c.kt, s, strength, strength);
  }
};

}  // namespace LSM

#endif
