// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/ruptures.h"

#include <algorithm>
#include <cmath>

#include "files/state.h"

namespace LSM {

void FaultRupture::add_slip(std::int64_t bin, double slip) {
  auto at = std::lower_bound(places.begin(), places.end(), bin,
                             [](const BinSlip &place, std::int64_t b) { return place.bin < b; });
  if (at == places.end() || at->bin != bin) at = places.insert(at, {bin, 0.0});
  at->slip += slip;
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
  for (const BinSlip &place : later.places) add_slip(place.bin, place.slip);
}

RuptureFinder::RuptureFinder(const FaultGrid &grid, const RuptureSettings &settings)
    : grid_(grid),
      settings_(settings),
      // Extra places in which nothing slides keep the two ends of an open fault apart.
      sets_(grid.bins + (grid.ring ? 0 : settings.gap + 1), settings.gap + 1, settings.memory),
      centroid_(grid) {
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
  for (int b = 0; b < grid_.bins; ++b) {
    const auto i = static_cast<std::size_t>(b);
    const double slip = row.slip[i], size = std::fabs(slip);
    if (!(size > least)) continue;
    active_ = true;
    FaultRupture &r = sets_.slide(b, [this, n](FaultRupture &begun) {
      begun.t_start = time_;
      begun.pe_start = pe_;
      begun.hypocentre = begun.first;
      if (snapshots_.empty() || snapshots_.back().interval != n - 1)
        snapshots_.push_back({n - 1, before_});
    });
    if (r.step_start == n - 1 && size > r.first_slip) {
      r.hypocentre = b;
      r.first_slip = size;
    }
    r.slip += slip;
    r.add_slip(b, slip);
    r.slip_cos += size * centroid_.cosine(i);
    r.slip_sin += size * centroid_.sine(i);
    r.work += row.work[i];
  }
  sets_.end_step(
      [&](FaultRupture &r) {
        if (r.step_end == n) {
          r.t_end = time;
          r.pe_end = pe;
        }
        if (r.step_end == n - 1) r.stress_after = mean(row.stress, r);
      },
      [&](const FaultRupture &r) { report(event(r)); });
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
    if (r.step_end == sets_.step()) r.stress_after = mean(before_, r);
    report(event(r));
  }
}

std::int64_t RuptureFinder::known_until() const {
  return grid_.step0 + (sets_.step() - settings_.memory) * grid_.interval;
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

double RuptureFinder::mean(const std::vector<float> &values, const SlipSet &row) const {
  double sum = 0.0;
  for (std::int64_t k = 0; k < row.length; ++k)
    sum += values[static_cast<std::size_t>((row.begin + k) % grid_.bins)];
  return sum / static_cast<double>(row.length);
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

Event RuptureFinder::event(const FaultRupture &r) const {
  Event e;
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
  e.x_hypocentre = grid_.centre(r.hypocentre);
  e.x_begin = grid_.x0 + static_cast<double>(r.begin) * grid_.width;
  e.mean_slip = r.slip / static_cast<double>(r.length);
  for (const BinSlip &place : r.places) e.peak_slip = std::max(e.peak_slip, std::fabs(place.slip));
  e.stress_drop = mean(snapshot(r.step_start), r) - r.stress_after;
  return e;
}

}  // namespace LSM
