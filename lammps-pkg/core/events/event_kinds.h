// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_kinds.h
/// The list of all kinds of events.
#ifndef LSM_EVENT_KINDS_H
#define LSM_EVENT_KINDS_H

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "events/event_kind.h"

namespace LSM {

template <class... Kinds>
std::vector<std::shared_ptr<EventKind>> one_of_each() {
  return {std::make_shared<Kinds>()...};
}

/// A new kind goes to the end: its place is its number in restart files.
std::vector<std::shared_ptr<EventKind>> all_event_kinds();

/// Returns null if no kind has that name.
std::shared_ptr<EventKind> make_event_kind(std::string_view name);

std::size_t number_of(const EventKind &wanted);

/// Joins the names of the kinds for which wanted(kind) holds, as "a or b".
template <class Wanted>
std::string names_of_kinds(Wanted &&wanted) {
  std::string names;
  for (const auto &kind : all_event_kinds())
    if (wanted(*kind)) names += (names.empty() ? "" : " or ") + std::string(kind->name());
  return names;
}
}  // namespace LSM

#endif
