// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slip_weakening.h
/// Linear slip weakening (Ida 1972, Andrews 1976): the strength falls from mu_static fn to mu fn
/// over the slip dc. A contact at rest forgets its slip with the time constant `heal` (*) (0:
/// never, as in Andrews). The block-slider uses the same strength.
#ifdef LSM_FRICTION_LAW
LSM_FRICTION_LAW(SlipWeakening)
#endif
#ifndef LSM_LAW_SLIP_WEAKENING_H
#define LSM_LAW_SLIP_WEAKENING_H

#include "friction_law.h"

namespace LSM {

struct SlipWeakening : FrictionLaw {
  struct Coefficients {
    double kt, mu, mu_static, dc, heal;
  };
  static constexpr const char *name = "slip-weakening";
  static constexpr Parameter parameters[] = {
      {"kt", Parameter::positive},
      {"mu", Parameter::not_negative},
      {"mu_static", Parameter::not_negative, Parameter::required, 1},
      {"dc", Parameter::positive},
      {"heal", Parameter::not_negative, 0.0}};
  static constexpr bool needs_time = true;  // to heal
  static constexpr int state_size = 1;      // slip, at most dc

  static void begin(const Coefficients &, double *slip) { *slip = 0.0; }

  template <class Number>
  [[gnu::always_inline]] static Number strength(const Number &mu_static, const Number &mu,
                                                const Number &dc, const Number &slip) {
    return slip < dc ? mu_static - (mu_static - mu) * (slip / dc) : mu;
  }

  /// The strength is that after the slip of the step: kt (|trial| - x) = strength(slip + x) is
  /// solved for x. Where strength falls faster than the spring relaxes, nothing stops the slip
  /// before mu fn.
  static double elongation(const Coefficients &c, FrictionContact &s, double *slip) {
    const double fall = (c.mu_static - c.mu) * s.fn / c.dc;
    const double excess =
        c.kt * std::fabs(s.trial()) - s.fn * strength(c.mu_static, c.mu, c.dc, *slip);
    s.sliding = excess > 0.0;
    if (!s.sliding) {
      if (c.heal > 0.0) *slip *= std::exp(-s.time / c.heal);
      return s.trial();
    }
    const double x = c.kt > fall ? excess / (c.kt - fall) : c.dc;
    const bool weakest = *slip + x >= c.dc;
    *slip = weakest ? c.dc : *slip + x;
    return std::copysign(weakest ? c.mu * s.fn / c.kt : std::fabs(s.trial()) - x, s.trial());
  }
};

}  // namespace LSM

#endif
