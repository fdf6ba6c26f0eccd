// SPDX-License-Identifier: GPL-2.0-or-later
#include "slip_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace LSM::postproc {

namespace {

/// The bins of an axis in which a rupture slipped, from its begin and length.
FaultAxis part_of(const FaultAxis &all, double begin, double length) {
  return {std::clamp(static_cast<int>(std::lround(length / all.width)), 1, all.bins), begin,
          all.width, false};
}

/// Adds records to a map, one after the other.
class MapMaker {
 public:
  MapMaker(SlipMap &map, const SlipHistoryInfo &info, const Event &event, double least)
      : map_(map),
        info_(info),
        begin_(event.t_start),
        least_(least),
        slip_(size(map)),
        rates_(size(map)) {
    map.slip.assign(slip_.size(), 0.0);
    map.time.assign(slip_.size(), std::numeric_limits<double>::quiet_NaN());
    map.rate = map.slip;
    // Before it began the rupture slipped nowhere, in the middle of the interval before it.
    middle_ = -0.5 * info.grid.duration();
    const FaultAxis strike = info.grid.strike(), dip = info.grid.dip();
    for (int k = 0; k < map.dip.bins; ++k)
      for (int b = 0; b < map.strike.bins; ++b)
        cells_.push_back(static_cast<std::size_t>(strike.bin(map.strike.centre(b))) *
                             static_cast<std::size_t>(dip.bins) +
                         static_cast<std::size_t>(dip.bin(map.dip.centre(k))));
  }

  void add(const SlipRecord &record) {
    const FaultGrid &grid = info_.grid;
    const double from = grid.time(record.step_begin) - begin_,
                 to = grid.time(record.step_end) - begin_, middle = 0.5 * (from + to);
    FaultVector sum;
    for (std::size_t n = 0; n < cells_.size(); ++n) {
      const FaultVector more = FaultVector::of(grid, record.row.slip, cells_[n]);
      slip_[n].strike += more.strike;
      slip_[n].dip += more.dip;
      sum.strike += more.strike;
      sum.dip += more.dip;
      const double rate = more.size() / (to - from), before = rates_[n];
      if (std::isnan(map_.time[n]) && rate > least_)
        map_.time[n] =
            std::max(0.0, before < least_
                              ? middle_ + (middle - middle_) * (least_ - before) / (rate - before)
                              : middle);
      map_.rate[n] = std::max(map_.rate[n], rate);
      map_.slip[n] = slip_[n].size();
      rates_[n] = rate;
    }
    middle_ = middle;
    const double unit = info_.ruptures.modulus * grid.area() / (to - from);
    map_.moment.push_back({middle, {unit * sum.strike, unit * sum.dip}});
  }

 private:
  static std::size_t size(const SlipMap &map) {
    return static_cast<std::size_t>(map.strike.bins) * static_cast<std::size_t>(map.dip.bins);
  }

  SlipMap &map_;
  const SlipHistoryInfo &info_;
  double begin_, least_;
  double middle_ = 0.0;  // of the record before
  std::vector<FaultVector> slip_;
  std::vector<double> rates_;       // in the record before
  std::vector<std::size_t> cells_;  // numbers in the history
};

}  // namespace

SlipMap slip_map(SlipHistoryReader &reader, const Event &event, double least) {
  const SlipHistoryInfo &info = reader.info();
  SlipMap map{part_of(info.grid.strike(), event.x_begin, event.rupture_length),
              part_of(info.grid.dip(), event.z_begin, event.rupture_width),
              event.x_hypocentre,
              event.z_hypocentre,
              {},
              {},
              {},
              {}};
  // A hypocentre across the seam is as far from the begin as its row is long.
  if (map.x_first < map.strike.begin) map.x_first += info.grid.strike().length();
  if (map.z_first < map.dip.begin) map.z_first += info.grid.dip().length();
  MapMaker maker(map, info, event, least);
  std::int64_t end = 0;
  for (SlipRecord record; reader.next(record) && record.step_end <= event.step_end;) {
    if (record.step_begin < event.step_start || record.step_begin == record.step_end) continue;
    maker.add(record);
    end = record.step_end;
  }
  if (map.moment.empty() || end != event.step_end)
    throw std::runtime_error("does not have all of rupture " + std::to_string(event.id) +
                             ", expected its slip until step " + std::to_string(event.step_end));
  const double most = *std::max_element(map.rate.begin(), map.rate.end());
  if (!(most > least))
    throw std::runtime_error(
        fmt::format("rupture {} slips at {:.6g} at most, expected an arrival below it, not {:.6g}",
                    event.id, most, least));
  return map;
}

std::vector<ContourPiece> contours(const SlipMap &map, const std::vector<double> &values,
                                   double spacing) {
  std::vector<ContourPiece> pieces;
  const auto row = static_cast<std::size_t>(map.strike.bins);
  const auto triangle = [&](std::array<std::size_t, 3> at) {
    if (std::any_of(at.begin(), at.end(), [&](std::size_t k) { return std::isnan(values[k]); }))
      return;
    std::sort(at.begin(), at.end(),
              [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    const auto [low, middle, high] = at;
    for (double k = std::floor(values[low] / spacing) + 1.0; k * spacing <= values[high]; ++k) {
      ContourPiece piece{k * spacing, {}, {}};
      const auto cut = [&](std::size_t end, std::size_t a, std::size_t b) {
        const double part = (piece.level - values[a]) / (values[b] - values[a]);
        piece.x[end] = map.x(a) + part * (map.x(b) - map.x(a));
        piece.z[end] = map.z(a) + part * (map.z(b) - map.z(a));
      };
      cut(0, low, high);
      if (piece.level <= values[middle])
        cut(1, low, middle);
      else
        cut(1, middle, high);
      if (piece.x[0] != piece.x[1] || piece.z[0] != piece.z[1]) pieces.push_back(piece);
    }
  };
  for (std::size_t k = 0; k + 1 < static_cast<std::size_t>(map.dip.bins); ++k)
    for (std::size_t b = 0; b + 1 < row; ++b) {
      const std::size_t corner = k * row + b;
      triangle({corner, corner + 1, corner + row});
      triangle({corner + 1, corner + row, corner + row + 1});
    }
  return pieces;
}

}  // namespace LSM::postproc
