// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_matching.h
/// Do the same events happen in two catalogues, of the same fault under two settings for example?
/// The paper does not ask (†).
#ifndef LSM_POSTPROC_EVENT_MATCHING_H
#define LSM_POSTPROC_EVENT_MATCHING_H

#include <cstdint>

#include "event_table.h"

namespace LSM::postproc {

/// When two events are the same: the ratio of their sizes is below 2, too.
struct MatchRule {
  double least_size = 0.0;  ///< smallest event of the first catalogue that is looked for (energy)
  double within = 0.0;      ///< their starts are less than this apart, > 0
};

struct EventMatches {
  std::int64_t first = 0, second = 0;  ///< events of least_size and more in the common time
  std::int64_t same = 0;               ///< of the first, those that the second has
  double chance = 0.0;                 ///< mean of `same` over seven shifts of the first
};

/// Each event of the first, in order of time, takes the nearest one of the second that is free.
/// Shifted catalogues wrap around: k / 8 of the common time, k = 1 to 7.
/// \throws std::invalid_argument for catalogues without a common time
EventMatches match_events(const EventTable &first, const EventTable &second, const MatchRule &rule);

}  // namespace LSM::postproc

#endif
