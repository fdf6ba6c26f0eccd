// SPDX-License-Identifier: GPL-2.0-or-later
#include "fault/energy_ledger.h"

#include <gtest/gtest.h>

#include <vector>

#include "files/state.h"

namespace {

using LSM::EnergyLedger;
using LSM::EnergyTerms;
using LSM::StateReader;
using LSM::StateWriter;

EnergyTerms terms(double kinetic, double potential, double friction, double viscosity,
                  double broken, double plates) {
  return {kinetic, potential, friction, viscosity, broken, plates, potential};
}

TEST(EnergyLedger, WhatThePlatesDoIsStoredOrLost) {
  EnergyLedger ledger;
  EXPECT_FALSE(ledger.begun());
  ledger.begin(terms(1.0, 2.0, 0.0, 0.0, 0.0, 0.0));
  EXPECT_TRUE(ledger.begun());
  EXPECT_EQ(ledger.residual(terms(1.5, 3.0, 0.25, 0.125, 0.0625, 1.9375)), 0.0);
  EXPECT_EQ(ledger.residual(terms(1.5, 3.0, 0.25, 0.125, 0.0625, 0.9375)), 1.0);
  EXPECT_EQ(ledger.residual(terms(1.5, 3.0, 0.25, 0.125, 0.0, 1.9375)), -0.0625);
}

TEST(EnergyLedger, WorkFromOutsideIsStoredOrLeaves) {
  EnergyLedger ledger;
  ledger.begin(EnergyTerms());
  EnergyTerms now = terms(0.5, 1.0, 0.25, 0.0, 0.0, 0.0);
  now.outside = 2.0;
  EXPECT_EQ(ledger.residual(now), -0.25);
  now.absorbed = 0.25;
  EXPECT_EQ(ledger.residual(now), 0.0);
}

TEST(EnergyLedger, ScaleHasNoSignAndOnlyWhatCounts) {
  EnergyTerms now = terms(1.0, 100.0, 2.0, 4.0, 8.0, 16.0);
  now.counted_pe = -32.0;
  EXPECT_EQ(now.scale(), 1.0 + 2.0 + 4.0 + 32.0);
}

TEST(EnergyLedger, AJumpBetweenTwoRunsIsLeftOut) {
  EnergyLedger ledger;
  ledger.begin(terms(1.0, 2.0, 0.0, 0.0, 0.0, 0.0));
  const EnergyTerms end = terms(1.0, 2.5, 0.5, 0.0, 0.0, 0.75);
  EXPECT_EQ(ledger.residual(end), 0.25);
  ledger.end_run(100, end);
  const EnergyTerms displaced = terms(1.0, 6.5, 0.5, 0.0, 0.0, 0.75);
  const auto now = [&] { return displaced; };
  EXPECT_EQ(ledger.leave_out_jump(101, 1e-20, now), 0.0);  // that run did not end here
  EXPECT_EQ(ledger.residual(displaced), 4.25);
  EXPECT_EQ(ledger.leave_out_jump(100, 1e-20, now), 4.0);
  EXPECT_EQ(ledger.residual(displaced), 0.25);  // the earlier error remains
}

TEST(EnergyLedger, RoundingIsNoJump) {
  EnergyLedger ledger;
  ledger.begin(terms(1.0, 1.0, 0.0, 0.0, 0.0, 0.0));
  ledger.end_run(1, terms(1.0, 1.0, 0.0, 0.0, 0.0, 0.0));
  const auto changed = [](double by) {
    return [by] { return terms(1.0, 1.0 + by, 0.0, 0.0, 0.0, 0.0); };
  };
  EXPECT_EQ(ledger.leave_out_jump(1, 0.0, changed(1e-9)), 0.0);
  EXPECT_EQ(ledger.leave_out_jump(1, 1e-8, changed(9e-9)), 0.0);
  EXPECT_NEAR(ledger.leave_out_jump(1, 0.0, changed(3e-9)), 3e-9, 1e-15);
}

TEST(EnergyLedger, NothingIsAskedForWithoutABegin) {
  EnergyLedger ledger;
  ledger.end_run(5, {});
  EXPECT_EQ(ledger.leave_out_jump(5, 0.0,
                                  [] {
                                    ADD_FAILURE() << "energies asked for";
                                    return EnergyTerms();
                                  }),
            0.0);
}

TEST(EnergyLedger, GoesOnFromARestart) {
  EnergyLedger first;
  first.begin(terms(1.0, 2.0, 0.0, 0.0, 0.0, 0.0));
  EnergyTerms at_restart = terms(1.0, 2.0, 0.5, 0.25, 0.125, 1.0);
  at_restart.within = 0.0625;
  std::vector<double> file;
  StateWriter to(file);
  const EnergyLedger kept = first.for_restart(at_restart);
  EnergyLedger::visit(kept, to);
  EXPECT_EQ(file.size(), 5u);
  EnergyLedger second;
  StateReader from(file);
  EnergyLedger::visit(second, from);
  EXPECT_TRUE(second.begun());
  // Styles count from 0 again; integrators and plates restore their own work from the restart file.
  const EnergyTerms now = second.with_earlier_works(terms(1.0, 2.0, 0.0, 0.25, 0.0, 1.0));
  EXPECT_EQ(now.friction, 0.5);
  EXPECT_EQ(now.broken, 0.125);
  EXPECT_EQ(now.within, 0.0625);
  EXPECT_EQ(second.residual(now), first.residual(at_restart));
}

}  // namespace
