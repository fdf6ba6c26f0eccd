// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "station_curves.h"

using namespace LSM;

namespace {

/// Slip rate that rises from 0 to `top` between the times 1 and 2, sampled at intervals of h.
StationCurve ramp(double top, double h, double end = 4.0) {
  StationCurve c{1.0, {}, {}, {}};
  for (double t = 0.0; t < end + 1e-9; t += h) {
    const double up = std::min(std::max(t - 1.0, 0.0), 1.0);
    c.t.push_back(t);
    c.rate.push_back(top * up);
    c.slip.push_back(top * (0.5 * up * up + std::max(t - 2.0, 0.0)));
  }
  return c;
}

}  // namespace

TEST(StationCurves, ArrivalIsBetweenSamples) {
  EXPECT_NEAR(arrival(ramp(2.0, 0.25), 1.1), 1.55, 1e-12);
  EXPECT_TRUE(std::isnan(arrival(ramp(2.0, 0.25), 2.5)));
}

TEST(StationCurves, MisfitOfAMultiple) {
  const StationMisfit m = misfit(ramp(2.2, 0.01), ramp(2.0, 0.05), 1.0, 100.0);
  EXPECT_NEAR(m.slip_l2, 0.1, 1e-3);
  EXPECT_NEAR(m.rate_l2, 0.1, 1e-3);
  EXPECT_NEAR(m.end_slip / m.reference_end_slip, 1.1, 1e-9);
  EXPECT_NEAR(m.peak / m.reference_peak, 1.1, 1e-9);
  EXPECT_NEAR(m.arrival - m.reference_arrival, 1.0 / 2.2 - 1.0 / 2.0, 1e-9);
}

TEST(StationCurves, OnlyTimesThatBothHaveCount) {
  const StationMisfit m = misfit(ramp(2.0, 0.01, 2.5), ramp(2.0, 0.05), 1.0, 100.0);
  EXPECT_NEAR(m.end_slip, 2.0 * (0.5 + 0.5), 1e-9);
  EXPECT_NEAR(m.reference_end_slip, m.end_slip, 1e-9);
  EXPECT_NEAR(misfit(ramp(2.0, 0.01), ramp(2.0, 0.05), 1.0, 1.5).end_slip, 0.25, 1e-9);
  EXPECT_THROW(misfit(ramp(2.0, 0.01), ramp(2.0, 0.05), 1.0, -1.0), std::invalid_argument);
}

TEST(StationCurves, SummaryIsRootMeanSquare) {
  StationMisfit a, b;
  a.arrival = 1.3;
  b.arrival = 1.0;
  a.reference_arrival = b.reference_arrival = 0.9;
  a.end_slip = 1.1;
  b.end_slip = 1.9;
  a.reference_end_slip = 1.0;
  b.reference_end_slip = 2.0;
  a.peak = a.reference_peak = b.reference_peak = 1.0;
  b.peak = 0.8;
  const MisfitSummary s = summary({a, b});
  EXPECT_NEAR(s.arrival, std::sqrt((0.16 + 0.01) / 2), 1e-12);
  EXPECT_NEAR(s.largest_arrival, 0.4, 1e-12);
  EXPECT_NEAR(s.end_slip, std::sqrt(0.02 / 5.0), 1e-12);
  EXPECT_NEAR(s.largest_end_slip, 0.1, 1e-12);
  EXPECT_NEAR(s.peak, std::sqrt(0.04 / 2), 1e-12);
  EXPECT_NEAR(order(0.4, 0.1, 200.0, 100.0), 2.0, 1e-12);
}
