// SPDX-License-Identifier: GPL-2.0-or-later
// Matches the events of two catalogues: an example by hand, and matches by chance.
#include <gtest/gtest.h>

#include <vector>

#include "event_matching.h"
#include "event_tables.h"
#include "numerics/random.h"

using namespace LSM::postproc;

namespace {

EventTable events(const std::vector<double> &starts, const std::vector<double> &sizes) {
  EventTable table;
  table.events = events_of(starts, sizes);
  table.last_end = starts.back();
  return table;
}

EventTable random_events(std::uint64_t seed, int n) {
  LSM::Random random(seed);
  std::vector<double> starts, sizes;
  for (int i = 0; i < n; ++i) {
    starts.push_back((starts.empty() ? 0.0 : starts.back()) + 2.0 * random.uniform());
    sizes.push_back(1.0);
  }
  return events(starts, sizes);
}

}  // namespace

TEST(EventMatching, ByHand) {
  MatchRule rule;
  rule.least_size = 1.0;
  rule.within = 1.0;
  // 10 matches 10.5, which is nearer than 9.2; nothing is left for 10.8; 20 is three times as
  // large, 30 is too far, 40 matches, 50 is too small, 60 and 90 are not in both.
  const EventTable first = events({0, 10, 10.8, 20, 30, 40, 50, 60}, {9, 1, 1, 3, 1, 1, 0.5, 1});
  const EventTable second =
      events({5, 9.2, 10.5, 20, 31.5, 40, 50, 55}, {1, 1, 1, 1, 1, 1.9, 1, 1});
  const EventMatches matches = match_events(first, second, rule);
  EXPECT_EQ(matches.first, 5);  // from 5 to 55 (exclusive), of size 1 and more
  EXPECT_EQ(matches.second, 7);
  EXPECT_EQ(matches.same, 2);
  EXPECT_EQ(match_events(first, first, rule).same, 6);
}

TEST(EventMatching, ChanceOfIndependentCatalogues) {
  MatchRule rule;
  rule.least_size = 1.0;
  rule.within = 0.1;
  const EventTable first = random_events(1, 20000), second = random_events(2, 20000);
  const EventMatches matches = match_events(first, second, rule);
  // Both have a rate of 1: there is an event within 0.1 on either side in a share of 0.18 to 0.2 of
  // the cases, with and without a shift.
  EXPECT_NEAR(matches.chance / static_cast<double>(matches.first), 0.18, 0.02);
  EXPECT_NEAR(static_cast<double>(matches.same), matches.chance, 4.0 * 60.0);
  EXPECT_EQ(match_events(first, first, rule).same, match_events(first, first, rule).first);
}

TEST(EventMatching, NoCommonTime) {
  MatchRule rule;
  rule.least_size = rule.within = 1.0;
  const EventTable table = events({0, 1, 2}, {1, 1, 1});
  EXPECT_THROW(match_events(table, events({5, 6}, {1, 1}), rule), std::invalid_argument);
  EXPECT_THROW(match_events(table, EventTable{}, rule), std::invalid_argument);
}
