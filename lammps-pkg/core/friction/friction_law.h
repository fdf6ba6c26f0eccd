// SPDX-License-Identifier: GPL-2.0-or-later
/// \file friction_law.h
/// The interface of friction laws. Every law acts through a tangential spring of stiffness kt (*):
/// in each step it determines how far the spring stays stretched, and the rest of the displacement
/// is slip. Functions that the block-slider uses as well are templates for numbers and SIMD
/// vectors. They are always inlined, as functions compiled for other instruction sets pass such
/// vectors differently. README.md of the package explains how to add a law.
#ifndef LSM_FRICTION_LAW_H
#define LSM_FRICTION_LAW_H

#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace LSM {

/// One contact in one step, as seen by its law. Members that a law does not need are not set.
struct FrictionContact {
  double fn;  ///< magnitude of the normal force now; 0 when contact was lost: all of xi is released
  double xi;  ///< elongation of the tangential spring before the step
  double dxi;  ///< tangential displacement of particle i relative to j in this step
  /// time that the displacement took, may be 0 where dxi is; set if the law needs_time
  double time;
  bool sliding;  ///< in: whether the contact slid in the step before, set if the law needs_sliding;
                 ///< out: slides now

  double trial() const { return xi + dxi; }  ///< elongation if nothing slips
  double speed() const { return time > 0.0 ? std::fabs(dxi) / time : 0.0; }
};

/// A coefficient of a law by its name in pair_coeff. The first one of each law is "kt"; the order
/// is that of the members of the law's Coefficients, which are doubles.
struct Parameter {
  enum Range { positive, not_negative };
  static constexpr double required = -1.0, as_least = -2.0;

  const char *name;
  Range range;
  double otherwise =
      required;    ///< value where it is not given; as_least: that of parameter `least`
  int least = -1;  ///< index of the parameter that it must not fall below, or -1
};

/// Defaults of a law, which derives from this and hides what differs. A law also has a name,
/// Coefficients, their parameters[], and
///   static double elongation(const Coefficients &c, FrictionContact &s, double *state),
/// which returns the new elongation and sets s.sliding; if not sliding, the elongation must be the
/// trial one.
struct FrictionLaw {
  static constexpr bool needs_time = false;     ///< s.time, for velocities
  static constexpr bool needs_sliding = false;  ///< s.sliding of the step before
  static constexpr int state_size =
      0;  ///< numbers kept for each contact, the same seen from both particles
  static constexpr bool named =
      true;  ///< pair_coeff gives 'name value' after kt, not values in order

  /// Sets the state of a new contact.
  template <class Coefficients>
  static void begin(const Coefficients &, double * /*state*/) {}
  /// Whether the law supports these coefficients. Laws of the same name are tried in the order of
  /// the list.
  template <class Coefficients>
  static bool fits(const Coefficients &) {
    return true;
  }
};

namespace friction_detail {
template <class Law, class Value, std::size_t... n>
typename Law::Coefficients coefficients_of(const Value &value, std::index_sequence<n...>) {
  static_assert(sizeof(typename Law::Coefficients) == sizeof...(n) * sizeof(double),
                "as many parameters as coefficients");
  return {value(n)...};
}
}  // namespace friction_detail

/// Coefficients of a law, of which value(n) is the n-th.
template <class Law, class Value>
typename Law::Coefficients coefficients_of(const Value &value) {
  return friction_detail::coefficients_of<Law>(
      value, std::make_index_sequence<std::size(Law::parameters)>());
}

/// Elongation of a contact that sticks while the force of the spring is at most `strength`, and
/// otherwise slides at the force `dynamic`.
inline double stick_or_slide(double kt, FrictionContact &s, double strength, double dynamic) {
  const double trial = s.trial();
  s.sliding = kt * std::fabs(trial) > strength;
  return s.sliding ? std::copysign(dynamic / kt, trial) : trial;
}

/// What one step did to a contact.
struct FrictionStep {
  double xi;          ///< elongation of the tangential spring afterwards
  double force;       ///< kt xi; the force on particle i is -force along the tangent
  double slip;        ///< irreversible part of the displacement, with sign
  double dissipated;  ///< work lost to friction in this step
  bool sliding;       ///< whether the contact slides now
};

/// Dissipated work counts the slip only, with the mean of the tangential force before and after the
/// step: the trapezoidal rule, as the energy balance of velocity Verlet requires.
template <class Law>
inline FrictionStep friction_step(const typename Law::Coefficients &c, FrictionContact s,
                                  double *state = nullptr) {
  const double xi = Law::elongation(c, s, state);
  if (!s.sliding) return {xi, c.kt * xi, 0.0, 0.0, false};
  const double slip = s.trial() - xi;
  return {xi, c.kt * xi, slip, 0.5 * c.kt * (s.xi + xi) * slip, s.sliding};
}

}  // namespace LSM

#endif
