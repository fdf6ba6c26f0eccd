// SPDX-License-Identifier: GPL-2.0-or-later
/// \file size_fits.h
/// Exponents of the event sizes (paper: Sect. 4.2), and whether the roll-off moves with the length
/// of the fault, the question the paper left open.
#ifndef LSM_POSTPROC_SIZE_FITS_H
#define LSM_POSTPROC_SIZE_FITS_H

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "event_table.h"
#include "finite_size.h"
#include "power_law.h"

namespace LSM::postproc {

struct SizeFitSettings {
  std::vector<Range> ranges;  ///< of sizes (model energy); none: paper_range() of each catalogue
  bool search = false;        ///< the range that search_range() finds, too
  Threshold threshold;        ///< smallest size of paper_range() and of the search
  int replicas = 100;         ///< of the Monte Carlo p-value; 0: none
  std::uint64_t seed = 1;
  bool compare = true;  ///< with the rivals of compare()
};

/// One catalogue on one range.
struct SizeFit {
  std::string label, model;
  std::size_t catalogue = 0;  ///< index among the catalogues
  double completeness = 0.0;  ///< in the header of the catalogue; 0: not given
  PowerLawFit fit;
  Measured p;  ///< of the Monte Carlo estimate; NaN: not computed
  std::vector<Comparison> comparisons;
};

/// Three decades, over which the paper saw its power law, from a smallest size on.
inline Range paper_range(double smallest) { return {smallest, 1000.0 * smallest}; }

/// Exponent of ascending sizes on a range without those below `least`: there events are missing,
/// which would pass for a flatter law. \throws std::invalid_argument for impossible settings
PowerLawFit fit_from(const std::vector<double> &sorted, const Range &range, double least);

/// Every catalogue on every range. \throws std::invalid_argument for impossible settings
std::vector<SizeFit> fit_sizes(const std::vector<EventTable> &tables,
                               const SizeFitSettings &settings);

/// Characteristic sizes of the catalogues of one model against their lengths.
struct Scaling {
  std::string model;
  std::string stiffness;  ///< block-slider: kl of the header; "" if there is none
  std::string kind;       ///< of the events, see EventTable::kind()
  SmallestSize threshold;
  std::vector<std::string> labels;
  std::vector<SizePoint> points;
  ScalingFit fit;

  bool drawable() const;  ///< has a point that is not degenerate
  bool by_event() const;  ///< errors are not those of blocks of time
};

/// One per model, stiffness of the leaf springs and kind of events, catalogues without a length
/// left out.
std::vector<Scaling> scale_sizes(const std::vector<EventTable> &tables, const Threshold &threshold,
                                 const Resampling &resampling);

}  // namespace LSM::postproc

#endif
