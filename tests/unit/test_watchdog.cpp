// SPDX-License-Identifier: GPL-2.0-or-later
#include "fault/watchdog.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using LSM::EnergyLedger;
using LSM::EnergyTerms;
using LSM::Watchdog;

const double nan = std::numeric_limits<double>::quiet_NaN();

EnergyTerms not_asked() {
  ADD_FAILURE() << "energies asked for";
  return {};
}

TEST(Watchdog, LooksEverySoManySteps) {
  Watchdog watchdog({0.5, 0.0, 100});
  EXPECT_TRUE(watchdog.due(0));
  EXPECT_FALSE(watchdog.due(99));
  EXPECT_TRUE(watchdog.due(300));
}

TEST(Watchdog, StrainedLinks) {
  Watchdog watchdog({0.5, 0.0, 100});
  EnergyLedger ledger;
  EXPECT_EQ(watchdog.check(true, 0.5, ledger, not_asked).what, "");
  const auto found = watchdog.check(true, 0.5126, ledger, not_asked);
  EXPECT_EQ(found.what, "a link is strained by 0.5126, above strainlimit 0.5");
  EXPECT_TRUE(found.finite);
}

TEST(Watchdog, NotFinite) {
  Watchdog watchdog({0.5, 0.0, 100});
  EnergyLedger ledger;
  EXPECT_EQ(Watchdog::comparable(0.25), 0.25);
  for (const double strain : {nan, std::numeric_limits<double>::infinity()}) {
    const auto found = watchdog.check(true, Watchdog::comparable(strain), ledger, not_asked);
    EXPECT_EQ(found.what, "the potential energy is not finite");
    EXPECT_FALSE(found.finite);
  }
  EXPECT_EQ(watchdog.check(false, 0.0, ledger, not_asked).what,
            "the potential energy is not finite");
}

TEST(Watchdog, WithinAStepOnlyWhatCannotWaitStops) {
  Watchdog watchdog({0.5, 0.0, 1000});
  // Two discs at a distance of 2, ghosts up to 3.6: at a strain of 0.8 the partner is out of reach.
  EXPECT_EQ(watchdog.check_links(0.3, 2.0, 3.6), "");
  EXPECT_FALSE(watchdog.due(1));
  EXPECT_EQ(watchdog.check_links(0.7, 2.0, 3.6), "");
  EXPECT_TRUE(watchdog.due(1));  // at the end of this step
  EXPECT_NE(watchdog.check(true, 0.7, EnergyLedger(), not_asked).what, "");
  EXPECT_FALSE(watchdog.due(1));
  EXPECT_EQ(watchdog.check_links(0.9, 2.0, 3.6),
            "a link is strained by 0.9, above strainlimit 0.5");
  watchdog.reset();
  EXPECT_FALSE(watchdog.due(1));
  EXPECT_EQ(watchdog.check_links(Watchdog::comparable(nan), 2.0, 3.6), "positions are not finite");
}

TEST(Watchdog, LedgerOutOfBalance) {
  EnergyTerms now;
  now.kinetic = 1.0;
  EnergyLedger ledger;
  ledger.begin(now);
  now.kinetic = 0.98;
  now.counted_pe = -1.02;  // a scale of 2, and 0.02 lost
  const auto terms = [&] { return now; };
  EXPECT_EQ(Watchdog({0.5, 0.011, 1}).check(true, 0.0, ledger, terms).what, "");
  const auto found = Watchdog({0.5, 0.009, 1}).check(true, 0.0, ledger, terms);
  EXPECT_EQ(found.what, "the energy ledger is out of balance by -0.02 of 2, above tolerance 0.009");
  EXPECT_TRUE(found.finite);
}

}  // namespace
