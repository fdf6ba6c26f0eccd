// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/event_kinds.h"

#include "events/pe_drops.h"
#include "events/ruptures.h"

namespace LSM {

std::vector<std::shared_ptr<EventKind>> all_event_kinds() {
  return one_of_each<PeDrops, Ruptures>();
}

std::shared_ptr<EventKind> make_event_kind(std::string_view name) {
  for (auto &kind : all_event_kinds())
    if (kind->name() == name) return kind;
  return {};
}

std::size_t number_of(const EventKind &wanted) {
  std::size_t number = 0;
  for (const auto &kind : all_event_kinds()) {
    if (std::string_view(kind->name()) == wanted.name()) break;
    ++number;
  }
  return number;
}

}  // namespace LSM
