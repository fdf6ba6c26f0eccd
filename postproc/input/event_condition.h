// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_condition.h
/// Conditions on the columns of a catalogue, as --where takes them: "peak_slip > 0.001".
#ifndef LSM_POSTPROC_EVENT_CONDITION_H
#define LSM_POSTPROC_EVENT_CONDITION_H

#include <string>
#include <vector>

#include "files/catalogue.h"

namespace LSM::postproc {

/// A column compared with a number.
struct EventCondition {
  enum class Is { less, at_most, more, at_least, equal, different };
  std::string column;
  Is is = Is::equal;
  double number = 0.0;
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
  bool hold(const Event &event) const;

 private:
  struct One {
    EventCondition condition;
    CatalogueColumn column;
  };
  std::vector<One> all_;
};

}  // namespace LSM::postproc

#endif
