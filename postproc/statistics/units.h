// SPDX-License-Identifier: GPL-2.0-or-later
/// \file units.h
/// SI units of the lattice solid fault †: the paper has model units only. Length, speed of
/// P-waves and density of a rock give those of length, time and mass; everything else follows.
#ifndef LSM_POSTPROC_UNITS_H
#define LSM_POSTPROC_UNITS_H

#include "magnitudes.h"

namespace LSM::postproc {

/// What a unit of the model is in SI. The fault is two-dimensional: energies and moments are those
/// of a slice of some thickness.
struct ModelUnits {
  double length = 0.0;     ///< m in a model length, the radius of the largest discs
  double p_speed = 0.0;    ///< of P-waves, m/s
  double density = 0.0;    ///< kg/m^3
  double thickness = 0.0;  ///< m, across the plane of the model

  /// Of the packing by create_lsm_fault with its defaults: wave speeds as measured, density the
  /// mass of the discs (radius squared each) over the area of the blocks.
  static constexpr double model_p_speed = 2.08, model_s_speed = 1.06, model_density = 0.286;

  double velocity() const { return p_speed / model_p_speed; }                          ///< m/s
  double time() const { return length / velocity(); }                                  ///< s
  double stress() const { return density / model_density * velocity() * velocity(); }  ///< Pa
  double energy() const { return stress() * length * length * thickness; }             ///< J
  double s_speed() const { return velocity() * model_s_speed; }                        ///< m/s
  double shear_modulus() const { return density * s_speed() * s_speed(); }             ///< Pa
  /// Seismic moment (N m) of a slip times a length along the fault of 1 in model units.
  double moment() const { return shear_modulus() * length * length * thickness; }
};

/// Mw = (2/3) (log10 M0 - 9.1), M0 in N m (Hanks & Kanamori 1979, J. Geophys. Res. 84, 2348, with
/// IASPEI's constant), of quantities that are moments in a unit.
MagnitudeScale moment_magnitude(double unit);
/// Me = (2/3) (log10 E - 4.4), E in J (Choy & Boatwright 1995, J. Geophys. Res. 100, 18205), of
/// quantities that are energies in a unit. Theirs is the radiated energy; a drop of PE contains the
/// work of friction as well, so that this is an upper limit.
MagnitudeScale energy_magnitude(double unit);

}  // namespace LSM::postproc

#endif
