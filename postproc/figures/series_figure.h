// SPDX-License-Identifier: GPL-2.0-or-later
/// \file series_figure.h
/// A PE series with the events picked from it (paper: Figs. 8 to 11).
#ifndef LSM_POSTPROC_SERIES_FIGURE_H
#define LSM_POSTPROC_SERIES_FIGURE_H

#include <array>
#include <cstdint>
#include <string>

#include "lsm_event_picker.h"
#include "numbers.h"
#include "plot.h"

namespace LSM::postproc {

using Values = std::array<double, 3>;  // PE, change, smoothed change

/// Thins curves to at most two rows for each column of the picture: the smallest and the largest
/// value in it, in the order in which they came, so that short drops stay visible.
class Thinner {
 public:
  Thinner(Table &table, std::int64_t samples, std::int64_t columns)
      : table_(table), samples_(samples), columns_(columns) {}

  void add(double time, const Values &values);
  void end_column();

  std::array<Extent, 3> ranges;  ///< of all samples

 private:
  struct Extremes {
    Extent range;
    bool rising = true;
  };
  Table &table_;
  std::int64_t samples_, columns_, count_ = 0, column_ = -1, in_column_ = 0;
  double first_time_ = 0.0, last_time_ = 0.0;
  std::array<Extremes, 3> extremes_;
};

/// The picture: PE, its change and the smoothed change from t0 to t1, with BASE-events.csv if
/// events.
std::string series_script(const std::string &title, const std::array<Extent, 3> &ranges, double t0,
                          double t1, bool events, const PickerSettings &picker);

}  // namespace LSM::postproc

#endif
