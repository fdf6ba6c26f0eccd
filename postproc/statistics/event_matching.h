// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_matching.h
/// Whether the same events occur in two catalogues, for example of one fault under two settings.
/// The paper does not address this question (†).
#ifndef LSM_POSTPROC_EVENT_MATCHING_H
#define LSM_POSTPROC_EVENT_MATCHING_H

#include <cstdint>

#include "event_table.h"

namespace LSM::postproc {

/// When two events count as the same; their sizes must also differ by less than a factor of 2.
struct MatchRule {
  /// Smallest event of either catalogue that is considered (energy).
  double least_size = 0.0;
  double within = 0.0;  ///< their start times differ by less than this, > 0
};

/// Numbers of events in two catalogues and of their matches.
struct EventMatches {
  std::int64_t first = 0, second = 0;  ///< events of at least least_size in the common time
  std::int64_t same = 0;               ///< events of the first catalogue with a match
  double chance = 0.0;  ///< number of matches by chance: mean of `same` over seven shifts
};

/// Counts the events that two catalogues share. In order of time, each event of the first takes the
/// nearest event of the second that is still free. The number of matches by chance is found by
/// shifting the first catalogue cyclically by k / 8 of the common time, k = 1 to 7.
/// \throws std::invalid_argument if a catalogue is empty or they have no time in common
EventMatches match_events(const EventTable &first, const EventTable &second, const MatchRule &rule);

}  // namespace LSM::postproc

#endif
