// SPDX-License-Identifier: GPL-2.0-or-later
#include "station_curves.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "samples.h"

namespace LSM {

using postproc::interpolate;

double arrival(const StationCurve &curve, double rate) {
  for (std::size_t n = 0; n < curve.t.size(); ++n) {
    if (!(curve.rate[n] > rate)) continue;
    if (n == 0) return curve.t[0];
    const double part = (rate - curve.rate[n - 1]) / (curve.rate[n] - curve.rate[n - 1]);
    return curve.t[n - 1] + part * (curve.t[n] - curve.t[n - 1]);
  }
  return NAN;
}

StationMisfit misfit(const StationCurve &curve, const StationCurve &reference, double rate,
                     double until) {
  const double from = std::max(curve.t.front(), reference.t.front());
  const double to = std::min({curve.t.back(), reference.t.back(), until});
  if (!(to > from)) throw std::invalid_argument("no time in common with the reference");
  StationMisfit m;
  m.x = curve.x;
  m.arrival = arrival(curve, rate);
  m.reference_arrival = arrival(reference, rate);
  m.end_slip = interpolate(curve.t, curve.slip, to);
  m.reference_end_slip = interpolate(reference.t, reference.slip, to);

  // Sampled at the times of the finer curve, so that no detail of either is missed.
  const std::vector<double> &times = curve.t.size() > reference.t.size() ? curve.t : reference.t;
  double slip_off = 0.0, slip_all = 0.0, rate_off = 0.0, rate_all = 0.0;
  double before = from;
  for (const double t : times) {
    if (t <= from || t > to) continue;
    const double share = t - before;
    before = t;
    const double slip = interpolate(reference.t, reference.slip, t);
    const double velocity = interpolate(reference.t, reference.rate, t);
    const double own = interpolate(curve.t, curve.rate, t);
    slip_off += share * std::pow(interpolate(curve.t, curve.slip, t) - slip, 2);
    slip_all += share * slip * slip;
    rate_off += share * std::pow(own - velocity, 2);
    rate_all += share * velocity * velocity;
    m.peak = std::max(m.peak, own);
    m.reference_peak = std::max(m.reference_peak, velocity);
  }
  m.slip_l2 = std::sqrt(slip_off / slip_all);
  m.rate_l2 = std::sqrt(rate_off / rate_all);
  return m;
}

MisfitSummary summary(const std::vector<StationMisfit> &stations) {
  MisfitSummary s;
  double arrivals = 0.0, off = 0.0, all = 0.0;
  for (const StationMisfit &m : stations) {
    const double late = m.arrival - m.reference_arrival;
    if (std::isfinite(late)) {
      arrivals += 1.0;
      s.arrival += late * late;
      s.largest_arrival = std::max(s.largest_arrival, std::fabs(late));
    }
    const double more = m.end_slip - m.reference_end_slip;
    off += more * more;
    all += m.reference_end_slip * m.reference_end_slip;
    s.largest_end_slip = std::max(s.largest_end_slip, std::fabs(more / m.reference_end_slip));
    s.slip_l2 += m.slip_l2 * m.slip_l2;
    s.rate_l2 += m.rate_l2 * m.rate_l2;
    s.peak += std::pow(m.peak / m.reference_peak - 1.0, 2);
  }
  const auto n = static_cast<double>(stations.size());
  s.arrival = std::sqrt(s.arrival / arrivals);
  s.end_slip = std::sqrt(off / all);
  s.slip_l2 = std::sqrt(s.slip_l2 / n);
  s.rate_l2 = std::sqrt(s.rate_l2 / n);
  s.peak = std::sqrt(s.peak / n);
  return s;
}

double order(double coarse_error, double fine_error, double coarse_spacing, double fine_spacing) {
  return std::log(coarse_error / fine_error) / std::log(coarse_spacing / fine_spacing);
}

bool same_place(double a, double b) {
  return std::fabs(a - b) <= 1e-9 * std::max(1.0, std::fabs(b));
}

StationCurve at_place(const NamedCurves &run, double x) {
  const auto right = std::find_if(run.stations.begin(), run.stations.end(),
                                  [x](const auto &s) { return s.x >= x || same_place(s.x, x); });
  if (right == run.stations.end() || (right == run.stations.begin() && !same_place(right->x, x)))
    throw std::invalid_argument(
        fmt::format("{}: no slip at x = {:.8g}, which runs from {:.8g} to "
                    "{:.8g}",
                    run.name, x, run.stations.front().x, run.stations.back().x));
  if (same_place(right->x, x)) return *right;
  const StationCurve &a = *(right - 1), &b = *right;
  const double part = (x - a.x) / (b.x - a.x);
  StationCurve between = a;
  between.x = x;
  for (std::size_t n = 0; n < a.t.size(); ++n) {
    between.slip[n] += part * (b.slip[n] - a.slip[n]);
    between.rate[n] += part * (b.rate[n] - a.rate[n]);
  }
  return between;
}

std::vector<double> common_places(const std::vector<NamedCurves> &references, std::size_t most) {
  std::vector<double> common;
  for (const StationCurve &station : references.front().stations)
    if (std::all_of(references.begin(), references.end(), [&station](const NamedCurves &r) {
          return std::any_of(r.stations.begin(), r.stations.end(),
                             [&station](const auto &s) { return same_place(s.x, station.x); });
        }))
      common.push_back(station.x);
  std::sort(common.begin(), common.end());
  std::vector<double> some;
  const std::size_t n = std::min(common.size(), most);
  for (std::size_t k = 0; k < n; ++k)
    some.push_back(common[n > 1 ? k * (common.size() - 1) / (n - 1) : 0]);
  return some;
}

}  // namespace LSM
