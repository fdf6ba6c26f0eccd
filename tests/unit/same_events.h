// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LSM_UNIT_SAME_EVENTS_H
#define LSM_UNIT_SAME_EVENTS_H

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "files/event.h"

namespace unit {

/// Expects the same events, but for a relative error of their numbers.
/// \param of_places  error of centroids, which lie in a ring of this period (0: none)
template <class Kind>
void expect_same_events(const std::vector<Kind> &a, const std::vector<Kind> &b,
                        double tolerance = 0.0, double of_places = 0.0, double period = 0.0) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    SCOPED_TRACE("event " + std::to_string(n));
    EXPECT_EQ(a[n].step_start, b[n].step_start);
    EXPECT_EQ(a[n].step_end, b[n].step_end);
    const auto close = [tolerance](double x, double y) {
      EXPECT_NEAR(x, y, tolerance * std::fabs(y));
    };
    close(a[n].t_start, b[n].t_start);
    close(a[n].t_end, b[n].t_end);
    close(a[n].pe_start, b[n].pe_start);
    close(a[n].pe_end, b[n].pe_end);
    // a difference of two energies, or of two stresses
    const bool drop = a[n].size == a[n].pe_start - a[n].pe_end;
    EXPECT_NEAR(a[n].size, b[n].size, tolerance * std::fabs(drop ? b[n].pe_start : b[n].size));
    each_table(&b[n], [&](const auto &table) {
      for (const auto &column : table) {
        SCOPED_TRACE(column.name);
        const double x = a[n].*column.number, y = b[n].*column.number;
        if (column.name == "x_centroid")
          EXPECT_NEAR(period > 0.0 ? std::remainder(x - y, period) : x - y, 0.0, of_places);
        else if (column.name == "stress_drop")
          EXPECT_NEAR(x, y, tolerance);
        else
          close(x, y);
      }
    });
  }
}

}  // namespace unit

#endif
