// SPDX-License-Identifier: GPL-2.0-or-later
/// \file magnitudes.h
/// Magnitudes of the models' events † (neither the paper nor the models know any), and the
/// statistics of them that seismologists use: b-value, its error, magnitude of completeness.
///
/// Sources: Aki 1965, Bull. Earthq. Res. Inst. 43, 237 (b by maximum likelihood); Tinti & Mulargia
/// 1987, Bull. Seismol. Soc. Am. 77, 2125 (magnitudes in bins); Shi & Bolt 1982, ibid. 72, 1677
/// (error); van der Elst 2021, J. Geophys. Res. Solid Earth 126, e2020JB021027 (b-positive); Wiemer
/// & Wyss 2000, Bull. Seismol. Soc. Am. 90, 859 and Woessner & Wiemer 2005, ibid. 95, 684 (maximum
/// curvature). SeismoStats 1.0 (Swiss Seismological Service) has the same estimators.
#ifndef LSM_POSTPROC_MAGNITUDES_H
#define LSM_POSTPROC_MAGNITUDES_H

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace LSM::postproc {

/// M = slope log10(size) + constant. The slope 2/3 is that between magnitude and the logarithm of
/// radiated energy or seismic moment; the constant is free, as the models have no unit of energy.
struct MagnitudeScale {
  double slope = 2.0 / 3.0;
  double constant = 0.0;
  double of(double size) const;  ///< size > 0
};

/// The multiple of width that is nearest, halves upwards; width 0: as it is.
double binned(double magnitude, double width);

/// Gutenberg-Richter law N(M) ~ 10^(-b M) for M >= completeness.
struct BValue {
  double b = NAN;
  double error = NAN;  ///< Shi & Bolt
  std::int64_t n = 0;  ///< magnitudes (b-positive: differences) that were used
  bool degenerate = true;
  std::string why;  ///< reason, one line
};

/// b of the magnitudes from completeness on (in bins: from the bin centred there).
/// Width 0: 1 / (ln 10 (mean - completeness)) (Aki); else ln(1 + width / (mean - completeness)) /
/// (ln 10 width) (Tinti & Mulargia), for magnitudes that are multiples of width away from it.
/// Error: ln 10 b^2 sqrt(sum (M - mean)^2 / (n (n - 1))). Unbounded above: a roll-off raises b.
/// Degenerate: fewer than 10 magnitudes, or all equal.
BValue b_value(const std::vector<double> &magnitudes, double completeness, double width = 0.0);

/// b of the differences between each magnitude and the one before it that are at least width, of
/// the magnitudes from completeness on in order of time. Their density falls with the same b, and
/// they miss less of what is lost just after large events.
BValue b_positive(const std::vector<double> &magnitudes, double completeness, double width = 0.0);

/// Centre of the fullest bin of a width > 0 (the lower one of equals) plus 0.2, after Woessner &
/// Wiemer. NaN without a magnitude.
double maximum_curvature(const std::vector<double> &magnitudes, double width);

/// Events in the bin centred at a magnitude, and from it on.
struct MagnitudeCount {
  double magnitude;
  std::int64_t count, from_here_on;
};
/// From the first to the last bin with an event, in bins of a width > 0.
std::vector<MagnitudeCount> magnitude_counts(const std::vector<double> &magnitudes, double width);

}  // namespace LSM::postproc

#endif
