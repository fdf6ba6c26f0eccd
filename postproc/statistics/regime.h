// SPDX-License-Identifier: GPL-2.0-or-later
/// \file regime.h
/// Whether a fault shows stick-slip or creep: characteristics of a PE series † (the paper only
/// shows its Fig. 8: PE rises steadily while the fault is locked and drops suddenly in an event).
#ifndef LSM_POSTPROC_REGIME_H
#define LSM_POSTPROC_REGIME_H

#include <cstdint>
#include <string>
#include <vector>

#include "files/pe_series.h"

namespace LSM::postproc {

/// Characteristics of a PE series. Rates are changes of PE per unit of time over consecutive
/// windows.
struct Regime {
  double window = 0.0;       ///< length of a window (model time)
  std::int64_t windows = 0;  ///< number of windows
  /// Rate at which PE rises: mean over the windows with a rise, weighted by the rise.
  double rise = 0.0;
  /// Rate at which PE falls, likewise.
  double fall = 0.0;
  /// fall / rise: 1 for a series that falls as it rises, large for a saw-tooth.
  double saw_tooth = 0.0;
  /// Fastest fall over the 99 % quantile of the rises; it grows with the length of the series.
  double drop_over_load = 0.0;
  double time_in_events = 0.0;  ///< share of the time that is within picked events
  double mean_duration = 0.0;   ///< mean duration of picked events (model time)
  double above = 0.0;           ///< limit of saw_tooth for stick-slip at this length
};

/// Default length of a window (model time) †: long compared with the periods of single discs
/// (about 1), short compared with large events (10 and more).
constexpr double regime_window = 3.0;

/// Value of Regime::saw_tooth above which a fault is said to stick-slip †: 3 up to length 120,
/// chosen from the regime map of the fault. A longer fault has n = length / 120 parts that slip
/// independently and whose PE adds up, so that the value falls about as 1/sqrt(n) towards the 1 of
/// a creeping fault. The limit does likewise: 1 + 2/sqrt(n).
/// \param length length of the fault; NaN if unknown (the limit is then 3)
double stick_slip_above(double length);

/// Computes a Regime from the samples of a series, in one pass.
class RegimeMeter {
 public:
  /// \param window length of a window (model time), > 0; rounded to whole samples
  /// \param spacing time between samples, > 0
  /// \param length length of the fault, for stick_slip_above()
  RegimeMeter(double window, double spacing, double length);
  /// Adds the next sample.
  void add(double pe);
  /// Adds an event that was picked.
  void event(double t_start, double t_end);
  /// \throws DegenerateData unless PE both rose and fell over a window
  Regime result() const;

 private:
  std::int64_t per_window_, samples_ = 0, events_ = 0;
  double spacing_, length_, before_ = 0.0, in_events_ = 0.0;
  std::vector<double> changes_;
};

/// Length of the fault from the header of its series; NaN for models other than faults.
double length_of(const PeSeriesInfo &info);

/// Name of the regime: "stick-slip" or "creep".
std::string name_of(const Regime &regime);

}  // namespace LSM::postproc

#endif
