// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_table.h
/// The events of a catalogue, and the smallest size that estimators use.
#ifndef LSM_POSTPROC_EVENT_TABLE_H
#define LSM_POSTPROC_EVENT_TABLE_H

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "files/catalogue.h"

namespace LSM::postproc {

/// Events smaller than this are left out of the paper's Figs. 12 and 13 (model energy units).
constexpr double paper_threshold = 1e-4;

/// Sizes or times from lo to hi.
struct Range {
  double lo, hi;
};

/// One catalogue.
struct EventTable {
  std::string path, label, region;  ///< region: of earthquakes, or empty
  CatalogueInfo info;
  std::vector<EventSummary> events;  ///< in order of t_start
  std::vector<Event> details;  ///< all columns of the largest of them: of as many as asked for
  double in_events = 0.0;      ///< sum of the durations (model time)
  double last_end = 0.0;       ///< t_end of the last event (model time)
  double model_time = 1.0;     ///< model time in the unit of the times, see --displacement
  /// Smaller events are missing: a smallest size given, the picker's min_size in the header, or the
  /// smallest earthquake (energy).
  double complete_from = 0.0;
  /// The largest `completeness` in the headers of the catalogues of this model that were loaded
  /// together, so that their curves begin at the same size, and the file that has it (energy).
  double completeness = 0.0;
  std::string completeness_path;
  std::int64_t skipped_lines = 0;    ///< bad lines skipped (lenient)
  std::int64_t left_out_small = 0;   ///< events below min_size
  std::int64_t left_out_time = 0;    ///< events outside [from_time, to_time)
  std::vector<std::string> repairs;  ///< what was skipped, counted by kind (lenient)

  /// Whether these are earthquakes: times in days, sizes 10^(1.5 M).
  bool earthquakes() const { return info.model == "seismicity"; }
  /// "model time" or "days".
  const char *time_unit() const { return earthquakes() ? "days" : "model time"; }

  /// Kind of the events by its name (core/events): "pe" unless the header says another.
  std::string kind() const;

  /// Fault length, or the number of blocks of a chain, from the header; NaN if it has neither.
  double length() const;

  /// Time in which the picker of these events forgets, in the unit of the times: of the reading
  /// 'exponential' its step over -ln(lambda), of 'average' as long as its factor says. NaN: events
  /// of no picker, or of one whose memory has no length.
  double picker_memory() const;

  /// Velocity of one side against the other by the header (model units): `driving` of ruptures,
  /// else of a fault twice the velocity of a plate, of a chain that of its plate; NaN: not given.
  double plate_velocity() const;

  /// Part of the time from the first start to the last end that lies within events; NaN if there is
  /// none, or events may overlap (kinds other than drops of PE).
  /// Ruptures at the same time at different places are one drop of the PE of the whole model, and
  /// so one event: the longer the model, the larger this part and the more events are joined.
  double share_in_events() const;
};

/// One number of each event.
template <class Row, class Part>
std::vector<double> column(const std::vector<Row> &events, double Part::*number) {
  std::vector<double> out;
  out.reserve(events.size());
  for (const Row &event : events) out.push_back(event.*number);
  return out;
}

/// The same of the events of at least a size, and how many these are.
std::vector<double> column_from(const EventTable &table, double least,
                                double EventSummary::*number);
std::int64_t events_from(const EventTable &table, double least);

/// Size below which events are left out, and why there.
struct SmallestSize {
  enum class Origin {
    given,     ///< by the user
    paper,     ///< that of the paper's Figs. 12 and 13
    header,    ///< `completeness` in the header of source, a path
    catalogue  ///< smaller events are missing in source, a label, or in the catalogue itself
  };
  double size = paper_threshold;
  Origin origin = Origin::paper;
  std::string source = {};
};

/// Which smallest size was asked for.
class Threshold {
 public:
  /// The paper's, or the completeness of the catalogues where that is larger.
  Threshold() = default;
  /// The one that was given.
  Threshold(double size) : size_(size), given_(true) {}
  bool given() const { return given_; }
  double given_or_paper() const { return size_; }
  double of(const EventTable &table) const { return in(table).size; }
  SmallestSize in(const EventTable &table) const;
  /// As in(), but not below where the events of the table begin.
  SmallestSize complete_in(const EventTable &table) const;

 private:
  double size_ = paper_threshold;
  bool given_ = false;
};

}  // namespace LSM::postproc

#endif
