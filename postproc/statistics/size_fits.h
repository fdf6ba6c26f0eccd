// SPDX-License-Identifier: GPL-2.0-or-later
/// \file size_fits.h
/// Exponents of the event sizes (paper: Sect. 4.2), and the form of their roll-off.
#ifndef LSM_POSTPROC_SIZE_FITS_H
#define LSM_POSTPROC_SIZE_FITS_H

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "event_table.h"
#include "generalised_gamma.h"
#include "power_law.h"
#include "samples.h"

namespace LSM::postproc {

/// What fit_sizes() fits.
struct SizeFitSettings {
  std::vector<Range> ranges;  ///< of sizes (model energy); empty: paper_range() of each catalogue
  Threshold threshold;        ///< smallest size for paper_range()
  int replicas = 100;         ///< for the Monte Carlo p-value; 0: none
  std::uint64_t seed = 1;
  bool compare = true;  ///< also fit the other laws of compare()
};

/// Fit of one catalogue on one range.
struct SizeFit {
  std::string label, model;
  std::size_t catalogue = 0;  ///< index of the catalogue
  double completeness = 0.0;  ///< from the header of the catalogue; 0: not given
  PowerLawFit fit;
  Measured p;  ///< Monte Carlo p-value; NaN: not computed
  std::vector<Comparison> comparisons;
};

/// Three decades from a smallest size on, the extent of the power law in the paper.
inline Range paper_range(double smallest) { return {smallest, 1000.0 * smallest}; }

/// Sizes in ascending order and in units of table.size_unit(), so that the logarithms of those in
/// bins are multiples of table.size_step(), as power_law.h needs them.
std::vector<double> sorted_sizes(const EventTable &table);

/// Fits the exponent on a range without the sizes below table.complete_from, where events are
/// missing: their absence would look like a flatter law.
/// \param sorted those of sorted_sizes()
/// \return the fit to these, in their units
/// \throws std::invalid_argument for impossible settings
PowerLawFit fit_from(const std::vector<double> &sorted, const Range &range,
                     const EventTable &table);

/// Fits each catalogue on each range.
/// \throws std::invalid_argument for impossible settings
std::vector<SizeFit> fit_sizes(const std::vector<EventTable> &tables,
                               const SizeFitSettings &settings);

/// Roll-off of the sizes, s^-alpha exp(-(s / s_c)^power), by maximum likelihood above `least`.
struct RollOff {
  GeneralisedGammaFit free;         ///< fit to the sizes: gamma = 1 - alpha, delta = power
  GeneralisedGammaFit exponential;  ///< the same with power 1
  /// Twice the gain in ln L of the exponential roll-off over a pure power law, also where it is too
  /// small for a fit; NaN if either has no optimum.
  double gain = NAN;
};
/// \param least smallest size that is used (energy)
RollOff roll_off(const EventTable &table, double least);

}  // namespace LSM::postproc

#endif
