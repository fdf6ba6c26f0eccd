// SPDX-License-Identifier: GPL-2.0-or-later
/// \file coulomb.h
/// Coulomb friction, Eq. (3) of Weatherley & Abe 2004, with a tangential spring (*).
#ifdef LSM_FRICTION_LAW
LSM_FRICTION_LAW(Coulomb)
LSM_FRICTION_LAW(CoulombStatic)
#endif
#ifndef LSM_LAW_COULOMB_H
#define LSM_LAW_COULOMB_H

#include "friction_law.h"

namespace LSM {

/// A contact sticks up to the tangential force mu fn, and slides at mu fn.
struct Coulomb : FrictionLaw {
  struct Coefficients {
    double kt, mu, mu_static;
  };
  static constexpr const char *name = "coulomb";
  static constexpr Parameter parameters[] = {
      {"kt", Parameter::positive},
      {"mu", Parameter::not_negative},
      {"mu_static", Parameter::not_negative, Parameter::as_least, 1}};
  static constexpr bool named = false;

  static bool fits(const Coefficients &c) { return c.mu_static <= c.mu; }
  static double elongation(const Coefficients &c, FrictionContact &s, double *) {
    return stick_or_slide(c.kt, s, c.mu * s.fn, c.mu * s.fn);
  }
};

/// Coulomb friction with a static coefficient above the dynamic one (*), which applies to contacts
/// that did not slide in the step before.
struct CoulombStatic : Coulomb {
  static constexpr bool needs_sliding = true;

  /// The block-slider uses this, too.
  template <class Number, class Truth>
  [[gnu::always_inline]] static Number friction(const Number &mu_static, const Number &mu,
                                                const Truth &sliding) {
    return sliding ? mu : mu_static;
  }

  static bool fits(const Coefficients &) { return true; }
  static double elongation(const Coefficients &c, FrictionContact &s, double *) {
    return stick_or_slide(c.kt, s, friction(c.mu_static, c.mu, s.sliding) * s.fn, c.mu * s.fn);
  }
};

}  // namespace LSM

#endif
