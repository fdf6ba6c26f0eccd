// SPDX-License-Identifier: GPL-2.0-or-later
/// \file rate_state.h
/// Rate-and-state friction, fn (mu + a ln(v/v0) + b ln(v0 theta/dc)), in the form that holds at v =
/// 0, too (Rice and Ben-Zion 1996): fn a arsinh(v/(2 v0) exp((mu + b ln(v0 theta/dc))/a)). The
/// state theta evolves by the ageing law (Dieterich 1979), theta' = 1 - v theta/dc, or the slip law
/// (Ruina 1983), theta' = -(v theta/dc) ln(v theta/dc).
#ifdef LSM_FRICTION_LAW
LSM_FRICTION_LAW(RateStateAgeing)
LSM_FRICTION_LAW(RateStateSlip)
#endif
#ifndef LSM_LAW_RATE_STATE_H
#define LSM_LAW_RATE_STATE_H

#include "friction_law.h"

namespace LSM {

template <class Evolution>
struct RateState : FrictionLaw {
  struct Coefficients {
    double kt, mu, a, b, dc, v0, theta;
  };
  static constexpr const char *name = Evolution::name;
  static constexpr Parameter parameters[] = {{"kt", Parameter::positive},
                                             {"mu", Parameter::not_negative},
                                             {"a", Parameter::positive},
                                             {"b", Parameter::not_negative},
                                             {"dc", Parameter::positive},
                                             {"v0", Parameter::positive},
                                             {"theta", Parameter::not_negative, 0.0}};
  static constexpr bool needs_time = true;
  static constexpr int state_size = 1;  // theta

  /// Unless theta is given, a contact begins in the state after long sliding at v0 (*).
  static void begin(const Coefficients &c, double *theta) {
    *theta = c.theta > 0.0 ? c.theta : c.dc / c.v0;
  }

  /// Slip never stops. The velocity at which friction and spring balance at the end of the step is
  /// solved for, as an explicit one would be unstable: with q = force/(fn a), 2 v0 sinh(q) exp(-E)
  /// time = trial - q fn a/kt. Theta is that at the beginning; over the step it evolves exactly for
  /// that velocity.
  static double elongation(const Coefficients &c, FrictionContact &s, double *theta) {
    s.sliding = true;
    if (!(s.fn > 0.0)) return 0.0;
    if (!(s.time > 0.0)) return s.trial();
    const double unit = s.fn * c.a / c.kt, most = std::fabs(s.trial()) / unit;
    const double E = (c.mu + c.b * std::log(c.v0 * *theta / c.dc)) / c.a;
    const double w = std::log(2.0 * c.v0 * s.time / unit) - E;  // q + exp(w) sinh(q) = most
    const double z = std::log(2.0 * most) - w;
    double q = std::fmin(
        most, z > 40.0 ? z : std::log1p(std::exp(z)));  // above the root: Newton is monotone
    for (int n = 0; n < 40; n++) {
      const double up = 0.5 * std::exp(w + q), down = 0.5 * std::exp(w - q);
      const double change = (q + (up - down) - most) / (1.0 + (up + down));
      q -= change;
      if (std::fabs(change) <= 1e-9 * q) break;
    }
    const double v = c.v0 * (std::exp(q - E) - std::exp(-q - E));
    if (v * s.time > 1e-200 * c.dc)
      *theta = Evolution::evolved(*theta, v, c.dc, s.time);
    else
      *theta = Evolution::rested(*theta, s.time);
    return std::copysign(q * unit, s.trial());
  }
};

/// Ageing law (Dieterich 1979): theta grows at rest.
struct AgeingEvolution {
  static constexpr const char *name = "rate-state-ageing";
  static double rested(double theta, double time) { return theta + time; }
  static double evolved(double theta, double v, double dc, double time) {
    return theta * std::exp(-v * time / dc) - dc / v * std::expm1(-v * time / dc);
  }
};
using RateStateAgeing = RateState<AgeingEvolution>;

/// Slip law (Ruina 1983): theta changes with slip only.
struct SlipEvolution {
  static constexpr const char *name = "rate-state-slip";
  static double rested(double theta, double) { return theta; }
  static double evolved(double theta, double v, double dc, double time) {
    return theta * std::exp(std::expm1(-v * time / dc) * std::log(v * theta / dc));
  }
};
using RateStateSlip = RateState<SlipEvolution>;

}  // namespace LSM

#endif
