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
    // Nothing slips in records of several intervals.
    if (record.step_end - record.step_begin != grid.interval) continue;
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
  // Ruptures that have not ended are closed as well, as the picture is to show all that is there.
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

VelocityImage::VelocityImage(const HistoryWindow &window, std::int64_t most_rows)
    : bins(window.info.grid.bins), columns(std::min<std::int64_t>(bins, 1000)) {
  const FaultGrid &grid = window.info.grid;
  const double duration = window.to - window.from;
  const double intervals = std::max(1.0, std::ceil(duration / grid.duration() - 1e-9));
  rows = static_cast<std::int64_t>(std::min(intervals, static_cast<double>(most_rows)));
  row_height = duration / static_cast<double>(rows);
  column_width = grid.length() / static_cast<double>(columns);
  values.assign(static_cast<std::size_t>(rows * columns), 0.0);
  for (const SlipRecord &record : window.records) {
    const double begin = grid.time(record.step_begin), end = grid.time(record.step_end);
    if (!(end > begin)) continue;
    const auto first = static_cast<std::int64_t>(
        std::max(0.0, std::floor((begin - window.from) / row_height + 1e-6)));
    const auto beyond = std::min<std::int64_t>(
        rows, static_cast<std::int64_t>(std::ceil((end - window.from) / row_height - 1e-6)));
    for (std::int64_t b = 0; b < bins; ++b) {
      const double velocity = std::fabs(record.row.slip[static_cast<std::size_t>(b)]) /
                              (end - begin) / window.info.driving;
      for (std::int64_t row = first; row < beyond; ++row) {
        double &value = values[static_cast<std::size_t>(row * columns + b * columns / bins)];
        value = std::max(value, velocity);
      }
    }
  }
}

double VelocityImage::at(std::int64_t row, std::int64_t column, std::int64_t shift) const {
  const std::int64_t from = (column + shift * columns / bins) % columns;
  return values[static_cast<std::size_t>(row * columns + from)];
}

std::vector<ClosedLine> closed_lines(const FaultGrid &grid, const Outline &outline,
                                     std::int64_t shift) {
  struct Column {
    double place, begin, end;
  };
  std::vector<std::vector<Column>> parts;
  std::pair<std::int64_t, std::int64_t> span = outline.bins.begin()->second;
  const std::int64_t begin = outline.length == grid.bins ? shift : outline.begin;
  for (std::int64_t k = 0; k < outline.length; ++k) {
    const std::int64_t bin = (begin + k) % grid.bins;
    const auto found = outline.bins.find(bin);
    // A bin in a gap takes the times of the preceding bin.
    if (found != outline.bins.end()) span = found->second;
    const auto place = static_cast<double>((bin - shift + grid.bins) % grid.bins);
    if (parts.empty() || place < parts.back().back().place) parts.emplace_back();
    parts.back().push_back({place, grid.time(span.first), grid.time(span.second)});
  }
  std::vector<ClosedLine> lines;
  for (const std::vector<Column> &part : parts) {
    ClosedLine line;
    for (const Column &column : part) {
      line.emplace_back(column.place, column.begin);
      line.emplace_back(column.place + 1.0, column.begin);
    }
    for (auto column = part.rbegin(); column != part.rend(); ++column) {
      line.emplace_back(column->place + 1.0, column->end);
      line.emplace_back(column->place, column->end);
    }
    line.push_back(line.front());
    lines.push_back(std::move(line));
  }
  return lines;
}

namespace {

/// Adds the slip of a record to that of each bin.
/// \return the largest absolute slip of a bin in the record
double add_slip(std::vector<double> &slip, const SlipRecord &record) {
  double most = 0.0;
  for (std::size_t b = 0; b < slip.size(); ++b) {
    slip[b] += static_cast<double>(record.row.slip[b]);
    most = std::max(most, std::fabs(static_cast<double>(record.row.slip[b])));
  }
  return most;
}

}  // namespace

std::vector<SlipLine> slip_lines(const HistoryWindow &window, double locked, double slipping) {
  const FaultGrid &grid = window.info.grid;
  const double least = slipping_above(grid, window.info.ruptures.velocity);
  std::vector<double> slip(static_cast<std::size_t>(grid.bins), 0.0);
  double next_locked = window.from, next_slipping = window.from;
  std::vector<SlipLine> lines;
  for (const SlipRecord &record : window.records) {
    const bool slips =
        add_slip(slip, record) > least && record.step_end - record.step_begin == grid.interval;
    const double time = grid.time(record.step_end);
    if (time < (slips ? next_slipping : next_locked)) continue;
    lines.push_back({time, slips, slip});
    if (slips) next_slipping = time + slipping;
    while (!slips && next_locked <= time) next_locked += locked;
  }
  return lines;
}

std::vector<double> slip_between(const HistoryWindow &window, std::int64_t begin,
                                 std::int64_t end) {
  std::vector<double> slip(static_cast<std::size_t>(window.info.grid.bins), 0.0);
  for (const SlipRecord &record : window.records)
    if (record.step_begin >= begin && record.step_end <= end) add_slip(slip, record);
  return slip;
}

}  // namespace LSM::postproc
