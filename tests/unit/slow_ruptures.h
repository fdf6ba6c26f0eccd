// SPDX-License-Identifier: GPL-2.0-or-later
// Finds the ruptures of a slip history by a search through all of space and time, independently of
// the finder under test.
#ifndef LSM_UNIT_SLOW_RUPTURES_H
#define LSM_UNIT_SLOW_RUPTURES_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "files/event.h"
#include "files/slip_history.h"

namespace unit {

struct SlowRuptures {
  std::vector<LSM::Rupture> events;  ///< those known to have ended, without identifiers
  std::vector<std::set<std::pair<std::int64_t, int>>> cells;  ///< (interval, bin) of each
  double slip_in_ruptures = 0.0;  ///< sum over bins and intervals, of all ruptures
  double slip_elsewhere = 0.0;
};

/// \param records all records of a history, including the first one
inline SlowRuptures slow_ruptures(const LSM::SlipHistoryInfo &info,
                                  const std::vector<LSM::SlipRecord> &records) {
  const LSM::FaultGrid &grid = info.grid;
  const int bins = grid.bins;
  const double length = grid.width * bins, pi = 3.14159265358979323846;
  const double least = info.ruptures.velocity * grid.dt * static_cast<double>(grid.interval);
  const auto interval_of = [&grid](std::int64_t step) {
    return (step - grid.step0) / grid.interval;
  };
  // The record that ends with an interval, and the slipping bins.
  std::vector<std::pair<std::int64_t, std::size_t>> ends;
  std::set<std::pair<std::int64_t, int>> left;
  SlowRuptures out;
  for (std::size_t k = 0; k < records.size(); ++k) {
    const LSM::SlipRecord &r = records[k];
    ends.emplace_back(interval_of(r.step_end), k);
    for (int b = 0; b < bins; ++b) {
      const double slip = r.row.slip[static_cast<std::size_t>(b)];
      const bool slides = r.step_end - r.step_begin == grid.interval && std::fabs(slip) > least;
      if (slides) left.emplace(interval_of(r.step_end), b);
      (slides ? out.slip_in_ruptures : out.slip_elsewhere) += slip;
    }
  }
  const auto record_at = [&](std::int64_t n) -> const LSM::SlipRecord * {
    const auto found =
        std::lower_bound(ends.begin(), ends.end(), std::make_pair(n, std::size_t{0}));
    return found != ends.end() && found->first == n ? &records[found->second] : nullptr;
  };
  const std::int64_t last = ends.empty() ? 0 : ends.back().first;
  const int reach = std::min(info.ruptures.gap + 1, std::max(1, bins / 2));

  while (!left.empty()) {
    std::set<std::pair<std::int64_t, int>> cells = {*left.begin()};
    std::vector<std::pair<std::int64_t, int>> todo = {*left.begin()};
    left.erase(left.begin());
    while (!todo.empty()) {
      const auto [n, b] = todo.back();
      todo.pop_back();
      for (std::int64_t m = n - info.ruptures.memory; m <= n + info.ruptures.memory; ++m)
        for (int d = -reach; d <= reach; ++d) {
          const auto there = left.find({m, ((b + d) % bins + bins) % bins});
          if (there == left.end()) continue;
          cells.insert(*there);
          todo.push_back(*there);
          left.erase(there);
        }
    }
    const std::int64_t first = cells.begin()->first, end = cells.rbegin()->first;
    if (end + info.ruptures.memory > last) continue;  // still open

    std::set<int> rows;
    LSM::Rupture e;
    std::map<int, double> of_bins;
    double slip = 0.0, c = 0.0, s = 0.0, most = 0.0;
    int where = 0;
    for (const auto &[n, b] : cells) {
      const LSM::FaultRow &row = record_at(n)->row;
      const double one = row.slip[static_cast<std::size_t>(b)];
      rows.insert(b);
      slip += one;
      of_bins[b] += one;
      e.size += row.work[static_cast<std::size_t>(b)];
      c += std::fabs(one) * std::cos(2.0 * pi * (b + 0.5) / bins);
      s += std::fabs(one) * std::sin(2.0 * pi * (b + 0.5) / bins);
      if (n == first && std::fabs(one) > most) {
        most = std::fabs(one);
        where = b;
      }
    }
    // The largest gap in the ring of bins is outside the rupture.
    int hole = bins - 1, begin = *rows.begin();
    for (auto it = rows.begin(); rows.size() > 1 && it != rows.end(); ++it) {
      const auto next = std::next(it);
      const int empty = (next == rows.end() ? *rows.begin() + bins : *next) - *it - 1;
      if (it != rows.begin() && empty <= hole) continue;
      hole = empty;
      begin = next == rows.end() ? *rows.begin() : *next;
    }
    if (hole < reach) hole = begin = 0;
    const int ruptured = bins - hole;
    double before = 0.0, after = 0.0;
    for (int k = 0; k < ruptured; ++k) {
      const auto b = static_cast<std::size_t>((begin + k) % bins);
      before += static_cast<double>(record_at(first - 1)->row.stress[b]) / ruptured;
      after += static_cast<double>(record_at(end + 1)->row.stress[b]) / ruptured;
    }
    e.step_start = grid.step0 + (first - 1) * grid.interval;
    e.step_end = grid.step0 + end * grid.interval;
    e.t_start = grid.time(e.step_start);
    e.t_end = grid.time(e.step_end);
    e.pe_start = record_at(first - 1)->pe;
    e.pe_end = record_at(end)->pe;
    e.slip_moment = info.ruptures.modulus * slip * grid.width;
    e.x_centroid = std::atan2(s, c) / (2.0 * pi) * length;
    if (e.x_centroid < 0.0) e.x_centroid += length;
    e.x_centroid += grid.x0;
    e.rupture_length = ruptured * grid.width;
    e.x_hypocentre = grid.x0 + (where + 0.5) * grid.width;
    e.x_begin = grid.x0 + begin * grid.width;
    e.mean_slip = slip / ruptured;
    for (const auto &[b, one] : of_bins) e.peak_slip = std::max(e.peak_slip, std::fabs(one));
    e.stress_drop = before - after;
    out.events.push_back(e);
    out.cells.push_back(cells);
  }
  // Sort the events as in a catalogue.
  std::vector<std::size_t> order(out.events.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&out](std::size_t a, std::size_t b) {
    const LSM::Rupture &x = out.events[a], &y = out.events[b];
    const int u = out.cells[a].begin()->second, v = out.cells[b].begin()->second;
    return std::tie(x.step_end, x.step_start, u) < std::tie(y.step_end, y.step_start, v);
  });
  SlowRuptures sorted = out;
  for (std::size_t k = 0; k < order.size(); ++k) {
    sorted.events[k] = out.events[order[k]];
    sorted.cells[k] = out.cells[order[k]];
  }
  return sorted;
}

}  // namespace unit

#endif
