// SPDX-License-Identifier: GPL-2.0-or-later
/// \file units.h
/// SI units for the lattice solid fault †: the paper has model units only. Length, P-wave speed and
/// density of a rock define the units of length, time and mass, and all others follow.
#ifndef LSM_POSTPROC_UNITS_H
#define LSM_POSTPROC_UNITS_H

#include <cmath>

#include "magnitudes.h"

namespace LSM::postproc {

/// SI values of the units of the model. As the fault is two-dimensional, energies and moments are
/// those of a slice of a given thickness.
struct ModelUnits {
  double length = 0.0;     ///< m per model length, the radius of the largest discs
  double p_speed = 0.0;    ///< P-wave speed, m/s
  double density = 0.0;    ///< kg/m^3
  double thickness = 0.0;  ///< m, across the plane of the model

  /// Model values of the packing by create_lsm_fault with its defaults: wave speeds as measured;
  /// density is the mass of the discs (radius squared each) over the area of the blocks.
  static constexpr double model_p_speed = 2.00, model_s_speed = 1.05, model_density = 0.286;

  double velocity() const { return p_speed / model_p_speed; }                          ///< m/s
  double time() const { return length / velocity(); }                                  ///< s
  double stress() const { return density / model_density * velocity() * velocity(); }  ///< Pa
  double energy() const { return stress() * length * length * thickness; }             ///< J
  double s_speed() const { return velocity() * model_s_speed; }                        ///< m/s
  double shear_modulus() const { return density * s_speed() * s_speed(); }             ///< Pa
  /// Seismic moment (N m) for 1 in model units of slip times length along the fault.
  double moment() const { return shear_modulus() * length * length * thickness; }
};

/// Moment magnitude Mw = (2/3) (log10 M0 - 9.1), M0 in N m (Hanks & Kanamori 1979, J. Geophys. Res.
/// 84, 2348, with IASPEI's constant).
/// \param unit N m per unit of the moments to be converted
inline MagnitudeScale moment_magnitude(double unit) {
  return {MagnitudeScale::slope * (std::log10(unit) - 9.1)};
}
/// Energy magnitude Me = (2/3) (log10 E - 4.4), E in J (Choy & Boatwright 1995, J. Geophys. Res.
/// 100, 18205). It is an upper limit: their E is the radiated energy, whereas a drop of PE also
/// contains the work of friction.
/// \param unit J per unit of the energies to be converted
inline MagnitudeScale energy_magnitude(double unit) {
  return {MagnitudeScale::slope * (std::log10(unit) - 4.4)};
}

}  // namespace LSM::postproc

#endif
