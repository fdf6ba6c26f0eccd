// SPDX-License-Identifier: GPL-2.0-or-later
/// \file magnitudes.h
/// Magnitudes of the models' events † (neither the paper nor the models define any), and the usual
/// statistics of seismology: b-value, its error, magnitude of completeness.
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

/// Sizes of earthquakes, and magnitudes of models, by M = (2/3) log10(size): an energy in units of
/// that of M = 0 (Gutenberg & Richter 1956).
double size_of_magnitude(double magnitude);
double magnitude_of_size(double size);

/// Magnitudes are decimal numbers, which binary ones only approximate: 0.35 / 0.1 is
/// 3.4999999999999996, and 2.3 in single precision is 2.2999999523. Hence this tolerance, in
/// magnitudes at limits and where bins are recognized, in widths at the edges of bins.
constexpr double magnitude_tolerance = 1e-6;

/// Whether a magnitude is at or above a limit, to magnitude_tolerance.
inline bool reaches(double magnitude, double limit) {
  return magnitude >= limit - magnitude_tolerance;
}

/// The magnitude that was typed: the number of up to three decimals that is as near as
/// magnitude_tolerance, as it is after single precision, or else the magnitude itself.
double as_typed(double magnitude);

/// Number of the bin of a magnitude: of the nearest multiple of width > 0, halves upwards.
inline double bin_of(double magnitude, double width) {
  return std::floor(magnitude / width + 0.5 + magnitude_tolerance);
}
/// The double nearest to a number of up to nine decimals, as if it had been typed.
inline double nearest_decimal(double number) {
  return std::round(number * 1e9) / 1e9 + 0.0;  // -0 becomes 0
}

/// Bins to whose centres, offset + n width, magnitudes were rounded before they were written.
struct MagnitudeBins {
  double width = 0.0;   ///< 0: none, magnitudes are continuous
  double offset = 0.0;  ///< from 0 up to the width
  double share = 0.0;   ///< of the magnitudes that are centres
  /// A width of which many more magnitudes are multiples than by chance, as agencies change their
  /// practice, and their share; 0: there is none.
  double wider = 0.0, share_of_wider = 0.0;

  bool has_centre(double magnitude) const {
    return std::fabs(magnitude - binned(magnitude)) < magnitude_tolerance;
  }
  /// Rounds to the nearest centre, halves upwards; width 0: leaves the magnitude as it is.
  double binned(double magnitude) const;
  /// The first centre that a limit leaves in.
  double first_from(double limit) const;
};

/// Recognizes the bins of a catalogue †. Their step is the widest of 0.1, 0.01 and 0.001 of which
/// at least 95 % of the magnitudes are multiples, or, of 20 magnitudes or more, the widest step up
/// to 1 of which 95 % differ by multiples, with any offset. If not all do, those that do have to be
/// three times as many as the others even without those in any bins 2, 3, 5 or 7 times as wide, so
/// that neither a change of practice nor a narrow range is taken for bins. `wider` is 0.1 or 0.01
/// if more than a quarter of the magnitudes are its multiples, and half as many again, and five
/// standard deviations more, than by chance.
MagnitudeBins recognized_bins(const std::vector<double> &magnitudes);

/// b-value of the Gutenberg-Richter law N(M) ~ 10^(-b M) for M >= completeness.
struct BValue {
  double b = NAN;
  double error = NAN;  ///< standard error after Shi & Bolt
  std::int64_t n = 0;  ///< magnitudes (for b-positive: differences) used
  bool degenerate = true;
  std::string why;  ///< reason, one line
};

/// Estimates b from the magnitudes at or above completeness (to magnitude_tolerance; in bins: from
/// the bin centred there on). Width 0: b = 1 / (ln 10 (mean - completeness)) (Aki); otherwise b =
/// ln(1 + width / (mean - completeness)) / (ln 10 width) (Tinti & Mulargia), for magnitudes that
/// differ from completeness by multiples of width. Error: ln 10 b^2 sqrt(sum (M - mean)^2 / (n (n -
/// 1))). No upper limit is assumed, so a roll-off raises b. Degenerate: fewer than 10 magnitudes,
/// or all equal.
BValue b_value(const std::vector<double> &magnitudes, double completeness, double width = 0.0);

/// b-positive: b from the differences between each magnitude and the one before it that are at
/// least width. Their density falls with the same b, and they suffer less from the events that are
/// missed just after large ones.
/// \param magnitudes in order of time; those below completeness are left out
BValue b_positive(const std::vector<double> &magnitudes, double completeness, double width = 0.0);

/// Magnitude of completeness by maximum curvature: centre of the fullest bin (the lowest of equal
/// ones) plus 0.2, after Woessner & Wiemer.
/// \param bins of a width > 0
/// \return NaN without magnitudes
double maximum_curvature(const std::vector<double> &magnitudes, const MagnitudeBins &bins);

/// Number of events in the bin centred at a magnitude, and in it and all bins above.
struct MagnitudeCount {
  double magnitude;
  std::int64_t count, from_here_on;
};
/// Counts the magnitudes in bins of a width > 0, from the first to the last bin with an event.
/// \throws std::invalid_argument if that needs 1e5 bins or more
std::vector<MagnitudeCount> magnitude_counts(const std::vector<double> &magnitudes,
                                             const MagnitudeBins &bins);

}  // namespace LSM::postproc

#endif
