// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_table.h
/// The events of a catalogue, and the smallest size that estimators use.
#ifndef LSM_POSTPROC_EVENT_TABLE_H
#define LSM_POSTPROC_EVENT_TABLE_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/catalogue.h"
#include "magnitudes.h"
#include "samples.h"

namespace LSM::postproc {

/// Events below this size are left out of the paper's Figs. 12 and 13 (model energy units).
constexpr double paper_threshold = 1e-4;

/// Value of CatalogueInfo::model for earthquakes.
constexpr std::string_view seismicity = "seismicity";

/// Whether a time lies before a limit. Times are computed, from steps or from dates, and limits are
/// typed: those that differ by their rounding only, four units in the last place, are equal.
inline bool is_before(double time, double limit) {
  return limit - time > 4.0 * std::numeric_limits<double>::epsilon() * std::fabs(time);
}

/// One catalogue.
struct EventTable {
  std::string path, label, region;  ///< region: of earthquakes; else empty
  CatalogueInfo info;
  std::vector<EventSummary> events;  ///< in order of t_start
  /// The largest of the events, as many as were requested, with all columns.
  std::vector<EventRow> details;
  /// Of earthquakes, as in the file and in the order of the events, from which their sizes follow;
  /// empty for models.
  std::vector<double> magnitudes;
  /// Bins that estimators take the magnitudes of earthquakes for; of width 0 for models.
  MagnitudeBins bins;
  bool bins_given = false;  ///< by the user, not recognized
  double in_events = 0.0;   ///< sum of the durations of all events (model time)
  double last_end = 0.0;    ///< t_end of the last event (model time)
  double model_time = 1.0;  ///< a unit of model time in the unit of the times, see --displacement
  /// Size (energy) below which events are missing: the smallest size requested, the picker's
  /// min_size in the header, or the size of the smallest earthquake.
  double complete_from = 0.0;
  /// Largest `completeness` (energy) in the headers of all catalogues of this model that were
  /// loaded together, so that their curves begin at the same size, and the path of the file that
  /// has it.
  double completeness = 0.0;
  std::string completeness_path;
  std::int64_t skipped_lines = 0;    ///< malformed lines that were skipped (lenient)
  std::int64_t left_out_small = 0;   ///< events below min_size
  std::int64_t left_out_time = 0;    ///< events outside [from_time, to_time)
  std::int64_t left_out_where = 0;   ///< events for which --where does not hold
  std::vector<std::string> repairs;  ///< what was skipped, with counts by kind (lenient)

  /// Whether this is a catalogue of earthquakes: times in days, sizes 10^(1.5 M).
  bool earthquakes() const { return info.model == seismicity; }
  /// Ratio of the sizes in successive bins of magnitudes, as its natural logarithm; 0: no bins, or
  /// bins too fine to matter.
  double size_step() const {
    return bins.width >= 1e-4 ? std::log(size_of_magnitude(bins.width)) : 0.0;
  }
  /// Size whose logarithm is that of the centre of a bin.
  double size_unit() const { return size_step() > 0.0 ? size_of_magnitude(bins.offset) : 1.0; }
  /// Unit of the times: "model time" or "days".
  const char *time_unit() const { return earthquakes() ? "days" : "model time"; }

  /// Name of the kind of events (core/events); "pe" unless the header says otherwise.
  std::string kind() const;

  /// Length of the fault, or number of blocks of a chain, from the header.
  /// \return NaN if the header has neither
  double length() const;

  /// Memory of the picker in the unit of the times. For the reading 'exponential' it is the
  /// sampling step over -ln(lambda), for 'average' the time with the same decay per step.
  /// \return NaN if no picker found the events or its memory has no length
  double picker_memory() const;
};

/// One member of each event, in the order of the events.
template <class Row, class Part>
std::vector<double> column(const std::vector<Row> &events, double Part::*number) {
  std::vector<double> out;
  out.reserve(events.size());
  for (const Row &event : events) out.push_back(event.*number);
  return out;
}

/// The same for events of at least a given size.
std::vector<double> column_from(const EventTable &table, double least,
                                double EventSummary::*number);

/// \throws DegenerateData if no table has an event, with the number that the options left out
void expect_events(const std::vector<EventTable> &tables);

/// Size below which events are left out, and the reason for it.
struct SmallestSize {
  double size = paper_threshold;
  std::string why = "that of the paper's Figs. 12 and 13";
};

/// The smallest size that was asked for.
struct Threshold {
  /// Without it, the paper's threshold or the completeness of the catalogues, if that is larger.
  std::optional<double> given;
  Threshold() = default;
  Threshold(double size) : given(size) {}
  /// Smallest size that is used of a catalogue, never below the size from which the catalogue is
  /// complete, and where it comes from.
  SmallestSize of(const EventTable &table) const;
};

}  // namespace LSM::postproc

#endif
