// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_condition.h
/// Conditions on the columns of a catalogue, as --where takes them: "peak_slip > 0.001". Where a
/// catalogue has friction_work and friction_total, `excess` † counts as a column: the work of
/// friction within the event, less that in as much time between events, over the size. It is 1 if
/// friction takes up what the springs lose, and 0 if it does no more than between events, so that
/// the energy goes to the load of the plates or to waves.
#ifndef LSM_POSTPROC_EVENT_CONDITION_H
#define LSM_POSTPROC_EVENT_CONDITION_H

#include <optional>
#include <string>
#include <vector>

#include "files/catalogue.h"

namespace LSM::postproc {

/// A column compared with a number.
struct EventCondition {
  std::string column;
  bool (*holds)(double found, double number) = nullptr;
  double number = 0.0;
  bool from_below = false;  ///< whether it leaves out all that is below the number
};

/// Reads a condition.
/// \throws std::invalid_argument
EventCondition parse_condition(const std::string &text);

/// Conditions on the events of one catalogue, all of which have to hold.
class EventConditions {
 public:
  /// \param path of the catalogue, for messages
  /// \throws FileError if the catalogue does not have one of the columns
  EventConditions(const std::vector<std::string> &texts, const CatalogueInfo &info,
                  const std::string &path);
  /// Whether one of the conditions needs the power of friction between events.
  bool needs_friction_between() const;
  /// Adds what friction does between two events that follow each other.
  void add_friction_between(const EventRow &before, const EventRow &after);
  /// Whether there is time between the events that were added.
  bool has_friction_between() const { return time_between_ > 0.0; }
  bool hold(const EventRow &event) const;
  /// The size below which conditions on the size leave out all events; 0 without such a condition.
  double least_size() const;

 private:
  struct One {
    EventCondition condition;
    std::optional<CatalogueColumn> column;  ///< none: excess
  };
  double value(const One &one, const EventRow &event) const;

  CatalogueInfo info_;
  std::vector<One> all_;
  double friction_between_ = 0.0, time_between_ = 0.0;
};

}  // namespace LSM::postproc

#endif
