// SPDX-License-Identifier: GPL-2.0-or-later
/// \file regime.h
/// Does a fault stick and slip, or creep? Numbers of a PE series † (the paper shows its Fig. 8
/// only: PE rises steadily while the fault is locked and drops at once in an event).
#ifndef LSM_POSTPROC_REGIME_H
#define LSM_POSTPROC_REGIME_H

#include <cstdint>
#include <string>
#include <vector>

#include "files/pe_series.h"

namespace LSM::postproc {

/// Numbers of the shape of a PE series. Rates are changes of PE per unit of time over consecutive
/// windows.
struct Regime {
  double window = 0.0;       ///< length of a window (model time)
  std::int64_t windows = 0;  ///< how many there were
  double rise = 0.0;  ///< rate at which PE rises: mean over rising windows, weighted by their rise
  double fall = 0.0;  ///< rate at which it falls, likewise
  double saw_tooth =
      0.0;  ///< fall / rise: 1 for a series that goes up as it goes down, large for a saw-tooth
  double drop_over_load =
      0.0;  ///< fastest fall / 99 % quantile of the rises; grows with the length of the series
  double time_in_events = 0.0;  ///< share of the time within picked events
  double mean_duration = 0.0;   ///< mean duration of picked events (model time)
  double above = 0.0;           ///< saw-tooth numbers above this are stick-slip, for this length
};

/// Default window †: long beside the periods of single discs (about 1), short beside large
/// events (10 and more).
constexpr double regime_window = 3.0;

/// Saw-tooth numbers above this are called stick-slip †: 3 up to length 120, chosen from the
/// regime map of the fault. PE of a longer fault sums over more parts that slip on their own, n =
/// length / 120 of them: the number falls about as 1/sqrt(n), to 1 as for a creeping one, and so
/// does the limit, 1 + 2/sqrt(n). \param length of the fault, NaN if not known (then 3)
double stick_slip_above(double length);

/// Collects a Regime from the samples of a series.
class RegimeMeter {
 public:
  /// \param window length of a window (model time), > 0; rounded to whole samples
  /// \param spacing time between samples, > 0
  /// \param length  of the fault, for stick_slip_above
  RegimeMeter(double window, double spacing, double length);
  /// The next sample.
  void add(double pe);
  /// An event that was picked.
  void event(double t_start, double t_end);
  /// \throws std::runtime_error if PE did not both rise and fall over a window
  Regime result() const;

 private:
  std::int64_t per_window_, samples_ = 0, events_ = 0;
  double spacing_, length_, before_ = 0.0, in_events_ = 0.0;
  std::vector<double> changes_;
};

/// Length of a fault from the header of its series; NaN for other models.
double length_of(const PeSeriesInfo &info);

/// "stick-slip" or "creep".
std::string name_of(const Regime &regime);

}  // namespace LSM::postproc

#endif
