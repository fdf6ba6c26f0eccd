// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/ruptures.h"

#include <algorithm>
#include <cmath>

#include "files/state.h"

namespace LSM {

void FaultRupture::add_slip(const BinSlip &more) {
  auto at = std::lower_bound(places.begin(), places.end(), more.bin,
                             [](const BinSlip &place, std::int64_t b) { return place.bin < b; });
  if (at == places.end() || at->bin != more.bin) at = places.insert(at, {more.bin, 0.0, 0.0});
  at->slip += more.slip;
  at->dip += more.dip;
}

void FaultRupture::absorb(const FaultRupture &later) {
  if (later.step_start == step_start && later.first_slip > first_slip) {
    hypocentre = later.hypocentre;
    first_slip = later.first_slip;
  }
  slip += later.slip;
  slip_cos += later.slip_cos;
  slip_sin += later.slip_sin;
  work += later.work;
  for (const BinSlip &place : later.places) add_slip(place);
  slip_dip += later.slip_dip;
  dip_cos += later.dip_cos;
  dip_sin += later.dip_sin;
  most_slip = std::max(most_slip, later.most_slip);
}

namespace {

/// Places of an axis. Extra places in which nothing slides keep the two ends of an open fault
/// apart.
int places_of(const FaultAxis &axis, int gap) { return axis.bins + (axis.ring ? 0 : gap + 1); }

}  // namespace

RuptureFinder::RuptureFinder(const FaultGrid &grid, const RuptureSettings &settings)
    : grid_(grid),
      settings_(settings),
      sets_(places_of(grid.strike(), settings.gap), settings.gap + 1, settings.memory,
            grid.plane ? places_of(grid.dip(), settings.gap) : 1),
      centroid_(grid.strike()),
      centroid_dip_(grid.dip()) {
  if (!(settings.velocity >= 0.0) || !(settings.modulus > 0.0) || settings.gap < 0)
    throw std::invalid_argument(
        "rupture settings out of range, expected a velocity and a gap of at least 0 and a "
        "modulus above 0");
}

void RuptureFinder::begin(double time, double pe, const FaultRow &row) {
  before_ = row.stress;
  time_ = time;
  pe_ = pe;
}

void RuptureFinder::add(double time, double pe, const FaultRow &row, const Report &report) {
  const std::int64_t n = sets_.step() + 1;
  const double least = slipping_above(grid_, settings_.velocity);
  sets_.begin_step(n);
  active_ = !sets_.idle();  // also in the interval after a rupture, whose stress is needed
  for (int b = 0; b < grid_.cells(); ++b) {
    const auto i = static_cast<std::size_t>(b);
    const FaultVector slip = FaultVector::of(grid_, row.slip, i);
    const double size = slip.size();
    if (!(size > least)) continue;
    active_ = true;
    const int along = b / grid_.rows, down = b % grid_.rows;
    FaultRupture &r = sets_.slide(along, down, [this, n, b](FaultRupture &begun) {
      begun.t_start = time_;
      begun.pe_start = pe_;
      begun.hypocentre = b;
      if (snapshots_.empty() || snapshots_.back().interval != n - 1)
        snapshots_.push_back({n - 1, before_});
    });
    if (r.step_start == n - 1 && size > r.first_slip) {
      r.hypocentre = b;
      r.first_slip = size;
    }
    r.slip += slip.strike;
    r.slip_dip += slip.dip;
    r.most_slip = std::max(r.most_slip, size);
    r.add_slip({b, slip.strike, slip.dip});
    r.slip_cos += size * centroid_.cosine(static_cast<std::size_t>(along));
    r.slip_sin += size * centroid_.sine(static_cast<std::size_t>(along));
    r.dip_cos += size * centroid_dip_.cosine(static_cast<std::size_t>(down));
    r.dip_sin += size * centroid_dip_.sine(static_cast<std::size_t>(down));
    r.work += row.work[i];
  }
  sets_.end_step(
      [&](FaultRupture &r) {
        if (r.step_end == n) {
          r.t_end = time;
          r.pe_end = pe;
        }
        if (r.step_end == n - 1) note_stress_after(r, row.stress);
      },
      report);
  forget();
  before_ = row.stress;
  time_ = time;
  pe_ = pe;
}

void RuptureFinder::each_open_as_ended(const Report &report) const {
  std::vector<FaultRupture> all;
  sets_.each_open([&all](const FaultRupture &r) { all.push_back(r); });
  std::sort(all.begin(), all.end());
  for (FaultRupture &r : all) {
    if (r.step_end == sets_.step()) note_stress_after(r, before_);
    report(r);
  }
}

std::vector<double> RuptureFinder::state() const {
  std::vector<double> out;
  StateWriter to(out);
  const SlipSetsState<FaultRupture> sets = sets_.state();
  const std::int64_t step = sets_.step();
  visit(*this, step, sets, to);
  return out;
}

void RuptureFinder::set_state(const std::vector<double> &numbers) {
  StateReader in(numbers);
  SlipSetsState<FaultRupture> sets;
  std::int64_t step = 0;
  visit(*this, step, sets, in);
  if (in.left() != 0) throw std::invalid_argument("saved ruptures are inconsistent");
  for (const FaultRupture &r : sets.open) snapshot(r.step_start);
  sets_.set_state(sets, step);
}

const std::vector<float> &RuptureFinder::snapshot(std::int64_t interval) const {
  for (const Snapshot &s : snapshots_)
    if (s.interval == interval) return s.stress;
  throw std::invalid_argument("saved ruptures are inconsistent");
}

FaultVector RuptureFinder::mean(const std::vector<float> &stress, const FaultRupture &r) const {
  FaultVector sum;
  const auto add = [&](std::int64_t cell) {
    const FaultVector one = FaultVector::of(grid_, stress, static_cast<std::size_t>(cell));
    sum.strike += one.strike;
    sum.dip += one.dip;
  };
  if (grid_.plane)
    for (const BinSlip &place : r.places) add(place.bin);
  else
    for (std::int64_t k = 0; k < r.length; ++k) add((r.begin + k) % grid_.bins);
  const auto count = static_cast<double>(grid_.plane ? r.places.size() : r.length);
  return {sum.strike / count, sum.dip / count};
}

void RuptureFinder::note_stress_after(FaultRupture &r, const std::vector<float> &stress) const {
  const FaultVector after = mean(stress, r);
  r.stress_after = after.strike;
  r.stress_after_dip = after.dip;
}

void RuptureFinder::forget() {
  if (snapshots_.empty()) return;
  std::vector<std::int64_t> wanted;
  sets_.each_open([&wanted](const FaultRupture &r) { wanted.push_back(r.step_start); });
  const auto unwanted = [&wanted](const Snapshot &s) {
    return std::find(wanted.begin(), wanted.end(), s.interval) == wanted.end();
  };
  snapshots_.erase(std::remove_if(snapshots_.begin(), snapshots_.end(), unwanted),
                   snapshots_.end());
}

Rupture RuptureFinder::rupture(const FaultRupture &r) const {
  Rupture e;
  e.step_start = grid_.step0 + r.step_start * grid_.interval;
  e.step_end = grid_.step0 + r.step_end * grid_.interval;
  e.t_start = r.t_start;
  e.t_end = r.t_end;
  e.size = r.work;
  e.pe_start = r.pe_start;
  e.pe_end = r.pe_end;
  e.slip_moment = settings_.modulus * r.slip * grid_.width;
  e.x_centroid = centroid_.of(r.slip_cos, r.slip_sin);
  e.rupture_length = static_cast<double>(r.length) * grid_.width;
  e.x_hypocentre = grid_.centre(r.hypocentre / grid_.rows);
  e.x_begin = grid_.strike().edge(r.begin);
  e.mean_slip = r.slip / static_cast<double>(r.length);
  for (const BinSlip &place : r.places)
    e.peak_slip = std::max(e.peak_slip, FaultVector{place.slip, place.dip}.size());
  e.stress_drop = mean(snapshot(r.step_start), r).strike - r.stress_after;
  return e;
}

PlaneRupture RuptureFinder::plane_rupture(const FaultRupture &r) const {
  PlaneRupture e{rupture(r)};
  const FaultAxis dip = grid_.dip();
  const FaultVector slip = {r.slip, r.slip_dip};
  const auto cells = static_cast<double>(r.places.size());
  e.moment_strike = settings_.modulus * slip.strike * grid_.area();
  e.moment_dip = settings_.modulus * slip.dip * grid_.area();
  e.slip_moment = settings_.modulus * slip.size() * grid_.area();
  e.mean_slip = slip.size() / cells;
  e.rupture_area = cells * grid_.area();
  e.rupture_width = static_cast<double>(r.dip_length) * dip.width;
  e.z_centroid = centroid_dip_.of(r.dip_cos, r.dip_sin);
  e.z_hypocentre = dip.centre(r.hypocentre % grid_.rows);
  e.z_begin = dip.edge(r.dip_begin);
  e.peak_slip_rate = r.most_slip / grid_.duration();
  const FaultVector before = mean(snapshot(r.step_start), r);
  e.stress_drop = slip.size() > 0.0 ? ((before.strike - r.stress_after) * slip.strike +
                                       (before.dip - r.stress_after_dip) * slip.dip) /
                                          slip.size()
                                    : 0.0;
  return e;
}

}  // namespace LSM
