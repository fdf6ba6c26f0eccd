// SPDX-License-Identifier: GPL-2.0-or-later
/// \file rates.h
/// Rates of events and of the energy or moment that they release, in bins of time †.
#ifndef LSM_POSTPROC_RATES_H
#define LSM_POSTPROC_RATES_H

#include <cstdint>
#include <vector>

namespace LSM::postproc {

/// Start time of an event, and its size or moment.
struct Release {
  double time, quantity;
};

/// Number of events and their total size or moment in one bin of time.
struct ReleaseBin {
  double from, to;  ///< from <= start < to
  std::int64_t events = 0;
  double released = 0.0;
  double event_rate() const { return static_cast<double>(events) / (to - from); }
  double release_rate() const { return released / (to - from); }
};

/// Bins the events by their starts, from the first to the last one, including empty bins.
/// \param width of the bins, > 0; their edges are multiples of it
/// \throws std::invalid_argument for more than a million bins
std::vector<ReleaseBin> rates_of(const std::vector<Release> &events, double width);

}  // namespace LSM::postproc

#endif
