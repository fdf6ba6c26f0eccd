// SPDX-License-Identifier: GPL-2.0-or-later
#include "slip_window.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace LSM::postproc {

void Outline::absorb(const Outline &later) {
  slip += later.slip;
  for (const auto &[bin, span] : later.bins) {
    const auto [at, added] = bins.emplace(bin, span);
    if (added) continue;
    at->second.first = std::min(at->second.first, span.first);
    at->second.second = std::max(at->second.second, span.second);
  }
}

HistoryWindow history_window(const SlipHistoryInfo &info, const std::vector<SlipRecord> &records,
                             double from, double to) {
  HistoryWindow window;
  window.info = info;
  const FaultGrid &grid = window.info.grid;
  const double least = slipping_above(grid, window.info.ruptures.velocity);
  SlipSets<Outline> sets(grid.bins, window.info.ruptures.gap + 1, window.info.ruptures.memory);
  const auto keep = [&window, &grid](const Outline &found) {
    Outline outline = found;
    outline.step_start = grid.step0 + found.step_start * grid.interval;
    outline.step_end = grid.step0 + found.step_end * grid.interval;
    for (auto &bin : outline.bins) {
      bin.second.first = grid.step0 + (bin.second.first - 1) * grid.interval;
      bin.second.second = grid.step0 + bin.second.second * grid.interval;
    }
    window.outlines.push_back(std::move(outline));
  };
  const auto nothing = [](Outline &) {};
  std::int64_t last = 0;
  for (const SlipRecord &record : records) {
    if (grid.time(record.step_end) < from) continue;
    if (grid.time(record.step_begin) > to) break;
    window.records.push_back(record);
    last = (record.step_end - grid.step0) / grid.interval;
    if (record.step_end - record.step_begin != grid.interval) continue;  // nothing slips in others
    sets.begin_step(last);
    for (int b = 0; b < grid.bins; ++b) {
      const double slip = record.row.slip[static_cast<std::size_t>(b)];
      if (!(std::fabs(slip) > least)) continue;
      Outline &outline = sets.slide(b, nothing);
      outline.slip += slip;
      outline.bins.emplace(b, std::make_pair(last, last)).first->second.second = last;
    }
    sets.end_step(nothing, keep);
  }
  // Open ones as well: a picture shows what there is.
  sets.begin_step(last + window.info.ruptures.memory + 1);
  sets.end_step(nothing, keep);
  if (window.records.empty() || window.records.front().step_begin == window.records.back().step_end)
    throw std::runtime_error("nothing in the window of time");
  window.from = std::max(from, grid.time(window.records.front().step_begin));
  window.to = std::min(to, grid.time(window.records.back().step_end));
  std::stable_sort(window.outlines.begin(), window.outlines.end(),
                   [](const Outline &a, const Outline &b) { return a.slip > b.slip; });
  return window;
}

}  // namespace LSM::postproc
