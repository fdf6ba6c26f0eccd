// SPDX-License-Identifier: GPL-2.0-or-later
/// \file linear_spring.h
/// Linear spring along the line of centres, Eqs. (1) and (2) of Weatherley & Abe 2004: links that
/// may break, contacts that only repel. A positive force is attraction. The rest length of a
/// pair is the sum of the two radii (*) (nothing per link is stored).
#ifndef LSM_LAW_LINEAR_SPRING_H
#define LSM_LAW_LINEAR_SPRING_H

namespace LSM {

// Templates take one number or, in the loop over links, a SIMD vector; always inlined, as functions
// with other instruction sets pass such vectors differently.

struct Spring {
  /// Attractive force at the given stretch r - r0.
  template <class Number>
  [[gnu::always_inline]] static Number force(double k, const Number &stretch) {
    return k * stretch;
  }
  /// Elastic energy at the given stretch r - r0.
  static double energy(double k, double stretch) { return 0.5 * k * stretch * stretch; }
};

/// Kelvin-Voigt: a dashpot parallel to the spring, whose viscosity is the stiffness times a
/// retardation time (*). Attractive force at the given rate of the stretch.
struct Dashpot {
  template <class Number>
  [[gnu::always_inline]] static Number force(double viscosity, const Number &rate) {
    return viscosity * rate;
  }
};

/// Eq. (1): whether a link holds, which it does while r <= r_cut; here r_cut = ratio * r0.
template <class Number>
[[gnu::always_inline]] inline auto link_is_broken(const Number &r, const Number &r0, double ratio) {
  return r > ratio * r0;
}

/// Eq. (2): magnitude of the repulsion of an unlinked pair, zero when apart.
inline double contact_normal_force(double k, double r, double r0) {
  return r < r0 ? k * (r0 - r) : 0.0;
}

/// Repulsion by the dashpot of an unlinked pair. Spring and dashpot together never attract.
/// \param rate of change of the distance
/// \param spring repulsion by the spring
inline double contact_dashpot_force(double viscosity, double rate, double spring) {
  const double dashpot = -Dashpot::force(viscosity, rate);
  return dashpot < -spring ? -spring : dashpot;
}

}  // namespace LSM

#endif
