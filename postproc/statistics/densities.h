// SPDX-License-Identifier: GPL-2.0-or-later
/// \file densities.h
/// Densities of event sizes in logarithmic bins, one curve per catalogue (paper: Figs. 7, 12, 13).
#ifndef LSM_POSTPROC_DENSITIES_H
#define LSM_POSTPROC_DENSITIES_H

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "event_table.h"
#include "log_histogram.h"
#include "power_law.h"

namespace LSM::postproc {

/// Density of the sizes of one catalogue.
struct SizeDensity {
  std::string label, model;
  double length = 0.0;       ///< see EventTable::length()
  double largest = 0.0;      ///< largest size in the catalogue
  std::int64_t events = 0;   ///< number of events in the bins
  std::vector<LogBin> bins;  ///< with Poisson errors; empty if no event is in the range
};

/// Bins the sizes of each catalogue. Where magnitudes are in bins of their own, a bin of sizes
/// holds a whole number of these, the nearest to usual_bin_factor, from the smallest size on: any
/// others would hold now more, now fewer of them. \param threshold smallest size \return densities
/// in the order of the catalogues \throws DegenerateData if no catalogue has an event of this size,
/// or all sizes are equal
std::vector<SizeDensity> size_densities(const std::vector<EventTable> &tables,
                                        const Threshold &threshold);

/// The same for one catalogue, which may have no events.
SizeDensity size_density(const EventTable &table, const Threshold &threshold = {});

/// Amplitude C of the density C s^-alpha of all events in the bins, for a law that was fitted to
/// some of them.
double amplitude_of(const PowerLawFit &law, const SizeDensity &density);

}  // namespace LSM::postproc

#endif
