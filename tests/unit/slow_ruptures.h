// SPDX-License-Identifier: GPL-2.0-or-later
// Finds the ruptures of a slip history, or of a pattern on a plane, by a search through all of
// space and time, independently of the finder under test.
#ifndef LSM_UNIT_SLOW_RUPTURES_H
#define LSM_UNIT_SLOW_RUPTURES_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "files/event.h"
#include "files/slip_history.h"

namespace unit {

using Cell = std::tuple<std::int64_t, int, int>;  ///< interval, bin, row

/// The cells of each rupture: they are close in space, and follow each other within the memory.
inline std::vector<std::set<Cell>> connected(std::set<Cell> left, const LSM::FaultGrid &grid,
                                             const LSM::RuptureSettings &settings) {
  const auto close = [&settings](int a, int b, int places, bool ring) {
    const int d = std::abs(a - b), reach = settings.gap + 1;
    return d <= reach || (ring && places - d <= reach);
  };
  std::vector<std::set<Cell>> all;
  while (!left.empty()) {
    std::vector<Cell> found = {left.extract(left.begin()).value()};
    for (std::size_t k = 0; k < found.size(); ++k) {
      const auto [n, bin, row] = found[k];
      auto at = left.lower_bound({n - settings.memory, 0, 0});
      while (at != left.end() && std::get<0>(*at) <= n + settings.memory)
        if (close(std::get<1>(*at), bin, grid.bins, grid.ring) &&
            close(std::get<2>(*at), row, grid.rows, grid.ring_dip)) {
          found.push_back(*at);
          at = left.erase(at);
        } else {
          ++at;
        }
    }
    all.emplace_back(found.begin(), found.end());
  }
  return all;
}

/// First place and length of the shortest row of places that has all of some; the whole ring if no
/// hole in it is wider than a gap.
inline std::pair<int, int> span_of(const std::set<int> &places, int count, bool ring, int gap) {
  if (!ring) return {*places.begin(), *places.rbegin() - *places.begin() + 1};
  int widest = -1, begin = 0;
  for (auto at = places.begin(); at != places.end(); ++at) {
    const auto next = std::next(at) == places.end() ? places.begin() : std::next(at);
    const int empty = *next - *at - 1 + (next == places.begin() ? count : 0);
    if (empty <= widest) continue;
    widest = empty;
    begin = *next;
  }
  if (widest <= std::min(gap, std::max(0, count / 2 - 1))) return {0, count};
  return {begin, count - widest};
}

struct SlowRuptures {
  std::vector<LSM::Rupture> events;  ///< those known to have ended, without identifiers
  double slip_in_ruptures = 0.0;     ///< sum over bins and intervals, of all ruptures
  double slip_elsewhere = 0.0;
};

/// \param records all records of a history of a ring, including the first one
inline SlowRuptures slow_ruptures(const LSM::SlipHistoryInfo &info,
                                  const std::vector<LSM::SlipRecord> &records) {
  const LSM::FaultGrid &grid = info.grid;
  const int bins = grid.bins;
  const double length = grid.width * bins, pi = 3.14159265358979323846;
  const double least = info.ruptures.velocity * grid.dt * static_cast<double>(grid.interval);
  // The record that ends with an interval, and the slipping bins.
  std::map<std::int64_t, const LSM::SlipRecord *> record_at;
  std::set<Cell> slides;
  SlowRuptures out;
  for (const LSM::SlipRecord &r : records) {
    const std::int64_t n = (r.step_end - grid.step0) / grid.interval;
    record_at[n] = &r;
    for (int b = 0; b < bins; ++b) {
      const double slip = r.row.slip[static_cast<std::size_t>(b)];
      const bool one = r.step_end - r.step_begin == grid.interval && std::fabs(slip) > least;
      if (one) slides.emplace(n, b, 0);
      (one ? out.slip_in_ruptures : out.slip_elsewhere) += slip;
    }
  }
  std::map<std::tuple<std::int64_t, std::int64_t, int>, LSM::Rupture> sorted;  // as in a catalogue
  for (const std::set<Cell> &cells : connected(slides, grid, info.ruptures)) {
    const std::int64_t first = std::get<0>(*cells.begin()), end = std::get<0>(*cells.rbegin());
    if (end + info.ruptures.memory > record_at.rbegin()->first) continue;  // still open

    LSM::Rupture e;
    std::set<int> places;
    std::map<int, double> of_bins;
    double slip = 0.0, c = 0.0, s = 0.0, most = 0.0;
    int where = 0;
    for (const auto &[n, b, row] : cells) {
      const double one = record_at.at(n)->row.slip[static_cast<std::size_t>(b)];
      places.insert(b);
      slip += one;
      of_bins[b] += one;
      e.size += record_at.at(n)->row.work[static_cast<std::size_t>(b)];
      c += std::fabs(one) * std::cos(2.0 * pi * (b + 0.5) / bins);
      s += std::fabs(one) * std::sin(2.0 * pi * (b + 0.5) / bins);
      if (n == first && std::fabs(one) > most) {
        most = std::fabs(one);
        where = b;
      }
    }
    const auto [begin, ruptured] = span_of(places, bins, true, info.ruptures.gap);
    for (int k = 0; k < ruptured; ++k) {
      const auto b = static_cast<std::size_t>((begin + k) % bins);
      e.stress_drop += (static_cast<double>(record_at.at(first - 1)->row.stress[b]) -
                        static_cast<double>(record_at.at(end + 1)->row.stress[b])) /
                       ruptured;
    }
    e.step_start = grid.step0 + (first - 1) * grid.interval;
    e.step_end = grid.step0 + end * grid.interval;
    e.t_start = grid.time(e.step_start);
    e.t_end = grid.time(e.step_end);
    e.pe_start = record_at.at(first - 1)->pe;
    e.pe_end = record_at.at(end)->pe;
    e.slip_moment = info.ruptures.modulus * slip * grid.width;
    e.x_centroid = std::atan2(s, c) / (2.0 * pi) * length;
    if (e.x_centroid < 0.0) e.x_centroid += length;
    e.x_centroid += grid.x0;
    e.rupture_length = ruptured * grid.width;
    e.x_hypocentre = grid.x0 + (where + 0.5) * grid.width;
    e.x_begin = grid.x0 + begin * grid.width;
    e.mean_slip = slip / ruptured;
    for (const auto &[b, one] : of_bins) e.peak_slip = std::max(e.peak_slip, std::fabs(one));
    sorted[{e.step_end, e.step_start, std::get<1>(*cells.begin())}] = e;
  }
  for (const auto &one : sorted) out.events.push_back(one.second);
  return out;
}

}  // namespace unit

#endif
