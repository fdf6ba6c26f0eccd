// SPDX-License-Identifier: GPL-2.0-or-later
#include "regime.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samples.h"

namespace LSM::postproc {

double stick_slip_above(double length) {
  constexpr double shortest = 120.0;
  return length > shortest ? 1.0 + 2.0 * std::sqrt(shortest / length) : 3.0;
}

double length_of(const PeSeriesInfo &info) {
  double length = NAN;
  if (const std::string *text = info.find("length")) text::parse(*text, length);
  return length;
}

RegimeMeter::RegimeMeter(double window, double spacing, double length)
    : per_window_(std::max<std::int64_t>(1, std::llround(window / spacing))),
      spacing_(spacing),
      length_(length) {}

void RegimeMeter::add(double pe) {
  if (samples_ % per_window_ == 0) {
    if (samples_ > 0) changes_.push_back(pe - before_);
    before_ = pe;
  }
  ++samples_;
}

void RegimeMeter::event(double t_start, double t_end) {
  in_events_ += t_end - t_start;
  ++events_;
}

Regime RegimeMeter::result() const {
  Regime r;
  r.above = stick_slip_above(length_);
  r.window = static_cast<double>(per_window_) * spacing_;
  r.windows = static_cast<std::int64_t>(changes_.size());
  std::vector<double> rises, falls;
  for (const double x : changes_) (x > 0.0 ? rises : falls).push_back(std::fabs(x));
  const double fastest = falls.empty() ? 0.0 : *std::max_element(falls.begin(), falls.end());
  if (changes_.empty())
    throw DegenerateData(fmt::format(
        "the series is shorter than two windows of {} time units: too short to tell a regime by",
        r.window));
  if (rises.empty() || !(fastest > 0.0))
    throw DegenerateData(
        fmt::format("PE only {} over {} windows of {} time units: no events to tell a regime by",
                    rises.empty() ? "falls" : "rises", r.windows, r.window));
  const auto quantile =
      rises.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(rises.size() - 1));
  std::nth_element(rises.begin(), quantile, rises.end());
  r.rise = self_weighted_mean(rises) / r.window;
  r.fall = self_weighted_mean(falls) / r.window;
  r.saw_tooth = r.fall / r.rise;
  r.drop_over_load = fastest / *quantile;
  r.time_in_events = in_events_ / (static_cast<double>(samples_ - 1) * spacing_);
  r.mean_duration = events_ > 0 ? in_events_ / static_cast<double>(events_) : 0.0;
  return r;
}

std::string name_of(const Regime &regime) {
  return regime.saw_tooth > regime.above ? "stick-slip" : "creep";
}

}  // namespace LSM::postproc
