// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_force_laws.h
/// Force laws of the Lattice Solid Model (Weatherley & Abe 2004, Eqs. 1 to 3), free of any program.
///
/// Lengths, energies and stiffnesses are in model units; a positive force is attraction along the line
/// of centres. The rest length of a pair is the sum of the two radii (ours: nothing per link is stored).
#ifndef LSM_FORCE_LAWS_H
#define LSM_FORCE_LAWS_H

#include <cmath>

namespace LSM {

/// Linear spring along the line of centres, Eqs. (1) and (2).
struct Spring {
  /// Attractive force at the given stretch r - r0.
  static double force(double k, double stretch) { return k * stretch; }
  /// Elastic energy at the given stretch r - r0.
  static double energy(double k, double stretch) { return 0.5 * k * stretch * stretch; }
};

/// Eq. (1): a link holds while r <= r_cut; here r_cut = ratio * r0.
inline bool link_is_broken(double r, double r0, double ratio) { return r > ratio * r0; }

/// Eq. (2): magnitude of the repulsion of an unlinked pair, zero when apart.
inline double contact_normal_force(double k, double r, double r0)
{
  return r < r0 ? k * (r0 - r) : 0.0;
}

/// Part of a step that a new contact lasted, when the distance fell from r_before >= r0 to r < r0 evenly.
/// The tangential spring of the contact takes this share of the step's displacement.
inline double share_in_contact(double r_before, double r, double r0)
{
  return r_before > r ? (r0 - r) / (r_before - r) : 0.0;
}

/// Coefficients of the tangential law of one pair of particle types.
struct FrictionCoefficients {
  double k_t;          ///< stiffness of the tangential spring (ours)
  double mu_dynamic;   ///< dynamic friction coefficient, Eq. (3)
  double mu_static;    ///< static friction coefficient, at least mu_dynamic (ours)
};

/// What one increment of tangential displacement did to a contact.
struct FrictionStep {
  double xi;           ///< elongation of the tangential spring afterwards
  double force;        ///< k_t xi; the force on particle i is -force along the tangent
  double slip;         ///< irreversible part of the displacement, with sign
  double dissipated;   ///< work lost to friction in this increment
  bool sliding;        ///< whether the contact slides now
};

/// Coulomb friction (Eq. 3) with a tangential spring.
///
/// \param xi        elongation before the increment
/// \param dxi       tangential displacement of particle i relative to j in this step
/// \param fn        magnitude of the normal force now (0 when contact was lost: all of xi is released)
/// \param sliding   whether the contact slid in the step before; only used when HAS_STATIC
///
/// Dissipated work counts the slipping part of the increment only, with the mean of the tangential
/// force before and after it: this is the trapezoidal rule that velocity Verlet's energy balance needs.
/// HAS_STATIC = false leaves out the test for a higher static coefficient.
template <bool HAS_STATIC>
inline FrictionStep friction_step(const FrictionCoefficients &c, double xi, double dxi, double fn,
                                  bool sliding)
{
  const double trial = xi + dxi;
  const double pull = c.k_t * std::fabs(trial);
  const double dynamic_limit = c.mu_dynamic * fn;
  double limit = dynamic_limit;
  if (HAS_STATIC && !sliding) limit = c.mu_static * fn;
  if (pull <= limit) return {trial, c.k_t * trial, 0.0, 0.0, false};

  const double xi_new = std::copysign(dynamic_limit / c.k_t, trial);
  const double slip = trial - xi_new;
  return {xi_new, c.k_t * xi_new, slip, 0.5 * c.k_t * (xi + xi_new) * slip, true};
}

/// Effective size of a contact for the slip moment (ours): twice the reduced radius.
inline double contact_size(double ri, double rj) { return 2.0 * ri * rj / (ri + rj); }

}    // namespace LSM

#endif
