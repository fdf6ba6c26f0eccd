// SPDX-License-Identifier: GPL-2.0-or-later
/// \file ruptures.h
/// Events of a fault as ruptures: sets of slipping contacts connected along the fault and in time
/// † (the paper picks drops of the total potential energy, PE).
///
/// Contacts are summed in bins along the fault and in intervals of so many steps. A bin
/// slips in an interval if its mean slip velocity exceeds a given one. It is then connected with
/// the bins at most gap + 1 from it (periodic) that slip in the same interval or in one of the
/// `memory` intervals before it; see events/slip_sets.h. Unlike drops of the total PE, ruptures far
/// apart on a long fault remain separate.
#ifndef LSM_RUPTURES_H
#define LSM_RUPTURES_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "events/event_kind.h"
#include "numerics/circular_mean.h"
#include "events/slip_sets.h"
#include "files/state.h"

namespace LSM {

/// What is known of a rupture; its places are bins and its steps are intervals.
struct FaultRupture : SlipSet {
  std::int64_t hypocentre = 0;            ///< bin that slipped most in the first interval
  double first_slip = 0.0;                ///< its slip then
  double slip = 0.0;                      ///< sum over the bins and intervals
  double slip_cos = 0.0, slip_sin = 0.0;  ///< absolute slips times the direction on the ring
  double work = 0.0;
  double pe_start = 0.0, pe_end = 0.0;
  double stress_after = 0.0;  ///< mean over its row in the first interval after its end

  void absorb(const FaultRupture &later) {
    if (later.step_start == step_start && later.first_slip > first_slip) {
      hypocentre = later.hypocentre;
      first_slip = later.first_slip;
    }
    slip += later.slip;
    slip_cos += later.slip_cos;
    slip_sin += later.slip_sin;
    work += later.work;
  }

  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state(self.step_start, self.step_end, self.first, self.begin, self.length, self.hypocentre,
          self.first_slip, self.slip, self.slip_cos, self.slip_sin, self.work, self.pe_start,
          self.pe_end, self.stress_after);
  }
};

/// Connects the slips of a fault to ruptures. Call begin(), then add() for each interval.
class RuptureFinder : public EventFinder {
 public:
  /// \throws std::invalid_argument for settings out of range
  RuptureFinder(const FaultGrid &grid, const RuptureSettings &settings)
      : grid_(grid),
        settings_(settings),
        // places beyond the end, in which nothing slides, keep the ends apart
        sets_(grid.bins + (grid.ring ? 0 : settings.gap + 1), settings.gap + 1, settings.memory) {
    if (!(settings.velocity >= 0.0) || !(settings.modulus > 0.0) || settings.gap < 0)
      throw std::invalid_argument(
          "rupture settings out of range, expected a velocity and a gap of at least 0 and a "
          "modulus above 0");
    const double circle = 2.0 * pi / grid.bins;
    for (int b = 0; b < grid.bins; ++b) {
      cosine_.push_back(grid.ring ? std::cos(circle * (b + 0.5)) : b + 0.5);
      sine_.push_back(grid.ring ? std::sin(circle * (b + 0.5)) : 1.0);
    }
  }

  void begin(double pe, const FaultRow &row) override {
    before_ = row.stress;
    pe_ = pe;
  }

  void add(double pe, const FaultRow &row, const Report &report) override {
    const std::int64_t n = sets_.step() + 1;
    const double least = slipping_above(grid_, settings_.velocity);
    sets_.begin_step(n);
    active_ = !sets_.idle();  // until the interval after the end, whose stress is needed
    for (int b = 0; b < grid_.bins; ++b) {
      const auto i = static_cast<std::size_t>(b);
      const double slip = row.slip[i], size = std::fabs(slip);
      if (!(size > least)) continue;
      active_ = true;
      FaultRupture &r = sets_.slide(b, [this, n](FaultRupture &begun) {
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
      r.slip_cos += size * cosine_[i];
      r.slip_sin += size * sine_[i];
      r.work += row.work[i];
    }
    sets_.end_step(
        [&](FaultRupture &r) {
          if (r.step_end == n) r.pe_end = pe;
          if (r.step_end == n - 1) r.stress_after = mean(row.stress, r);
        },
        [&](const FaultRupture &r) { report(event(r)); });
    forget();
    before_ = row.stress;
    pe_ = pe;
  }

  void each_open_as_ended(const Report &report) const override {
    std::vector<FaultRupture> all;
    sets_.each_open([&all](const FaultRupture &r) { all.push_back(r); });
    std::sort(all.begin(), all.end());
    for (FaultRupture &r : all) {
      if (r.step_end == sets_.step()) r.stress_after = mean(before_, r);
      report(event(r));
    }
  }

  /// Something slipped in the last interval, or a rupture was open when it began.
  bool active() const override { return active_; }
  FaultMoment last_interval() const override { return {sets_.step(), pe_, before_}; }
  // A rupture is known to have ended when its pause is over.
  std::int64_t known_until(std::int64_t) const override {
    return grid_.step0 + (sets_.step() - settings_.memory) * grid_.interval;
  }
  std::int64_t open() const override { return sets_.open(); }

  std::vector<double> state() const override {
    std::vector<double> out;
    StateWriter to(out);
    const SlipSetsState<FaultRupture> sets = sets_.state();
    const std::int64_t step = sets_.step();
    visit(*this, step, sets, to);
    return out;
  }

  /// Continues to the last digit; the settings must be those of the saved state.
  void set_state(const std::vector<double> &numbers) override {
    StateReader in(numbers);
    SlipSetsState<FaultRupture> sets;
    std::int64_t step = 0;
    visit(*this, step, sets, in);
    if (in.left() != 0) throw std::invalid_argument("saved ruptures are inconsistent");
    for (const FaultRupture &r : sets.open) snapshot(r.step_start);
    sets_.set_state(sets, step);
  }

 private:
  /// The stresses at the end of an interval.
  struct Snapshot {
    std::int64_t interval = 0;
    std::vector<float> stress;
    template <class Self, class State>
    static void visit(Self &self, State &state) {
      state(self.interval);
      state.fixed(self.stress);
    }
  };

  template <class Self, class Step, class Sets, class State>
  static void visit(Self &self, Step &step, Sets &sets, State &state) {
    auto bins = self.grid_.bins;
    state(bins);
    if (bins != self.grid_.bins)
      throw std::invalid_argument("saved ruptures are of another number of bins");
    state(step, self.active_, self.pe_);
    const auto room = [bins](auto &row) {
      if constexpr (!std::is_const_v<Self>) row.resize(static_cast<std::size_t>(bins));
    };
    room(self.before_);
    state.fixed(self.before_);
    state.list(self.snapshots_, [&room](auto &snapshot) { room(snapshot.stress); });
    state.list(sets.open);
    state.list(sets.recent);
  }

  /// The stresses that a rupture began with.
  const std::vector<float> &snapshot(std::int64_t interval) const {
    for (const Snapshot &s : snapshots_)
      if (s.interval == interval) return s.stress;
    throw std::invalid_argument("saved ruptures are inconsistent");
  }

  double mean(const std::vector<float> &values, const SlipSet &row) const {
    double sum = 0.0;
    for (std::int64_t k = 0; k < row.length; ++k)
      sum += values[static_cast<std::size_t>((row.begin + k) % grid_.bins)];
    return sum / static_cast<double>(row.length);
  }

  /// Stresses from before every open rupture.
  void forget() {
    if (snapshots_.empty()) return;
    std::vector<std::int64_t> wanted;
    sets_.each_open([&wanted](const FaultRupture &r) { wanted.push_back(r.step_start); });
    const auto unwanted = [&wanted](const Snapshot &s) {
      return std::find(wanted.begin(), wanted.end(), s.interval) == wanted.end();
    };
    snapshots_.erase(std::remove_if(snapshots_.begin(), snapshots_.end(), unwanted),
                     snapshots_.end());
  }

  Event event(const FaultRupture &r) const {
    Event e;
    e.step_start = grid_.step0 + r.step_start * grid_.interval;
    e.step_end = grid_.step0 + r.step_end * grid_.interval;
    e.t_start = grid_.time(e.step_start);
    e.t_end = grid_.time(e.step_end);
    e.size = r.work;
    e.pe_start = r.pe_start;
    e.pe_end = r.pe_end;
    e.slip_moment = settings_.modulus * r.slip * grid_.width;
    const double along =
        grid_.ring ? part_of_ring(r.slip_sin, r.slip_cos) : r.slip_cos / r.slip_sin / grid_.bins;
    e.x_centroid = grid_.x0 + along * grid_.length();
    e.rupture_length = static_cast<double>(r.length) * grid_.width;
    e.x_hypocentre = grid_.centre(r.hypocentre);
    e.x_begin = grid_.x0 + static_cast<double>(r.begin) * grid_.width;
    e.mean_slip = r.slip / static_cast<double>(r.length);
    e.stress_drop = mean(snapshot(r.step_start), r) - r.stress_after;
    return e;
  }

  FaultGrid grid_;
  RuptureSettings settings_;
  SlipSets<FaultRupture> sets_;
  std::vector<double> cosine_, sine_;  // direction of a bin on the ring; without ring place and 1
  std::vector<float> before_;          // stresses of the interval before
  double pe_ = 0.0;                    // at its end
  bool active_ = false;
  std::vector<Snapshot> snapshots_;  // before open ruptures began, in order of time
};

class Ruptures : public EventKind {
 public:
  double slipping = 5.0;  ///< multiple of the driving velocity above which a bin slips
  int gap = 1;            ///< bins that may lie between two that are connected
  double pause = 3.0;     ///< time over which slips are connected

  const char *name() const override { return "ruptures"; }
  Keywords keywords() override {
    return {{"slipping", &slipping, Must::not_negative},
            {"gap", &gap, Must::not_negative},
            {"pause", &pause, Must::not_negative}};
  }
  bool wants_intervals() const override { return true; }

  void describe(const EventSettings &settings, double slip_bin, const AddParameter &add,
                CatalogueInfo &info) const override {
    using text_io::number;
    add_sizes(settings, add);
    add("events", name());
    add("driving", number(settings.driving));
    add("slipping", number(slipping));
    add("slip_velocity", number(slipping * settings.driving));
    add("slip_bin", number(slip_bin));
    add("interval", std::to_string(settings.interval));
    add("gap", std::to_string(gap));
    add("pause", number(pause));
    add("modulus", number(settings.modulus));
    info.slip_moment = info.x_centroid = info.rupture_length = true;
    info.x_hypocentre = info.x_begin = info.mean_slip = info.stress_drop = true;
  }
  RuptureSettings rupture_settings(const EventSettings &settings, double dt) const override {
    RuptureSettings s;
    s.velocity = slipping * settings.driving;
    s.gap = gap;
    s.memory = std::max<std::int64_t>(
        1, static_cast<std::int64_t>(std::llround(pause / (settings.interval * dt))));
    s.modulus = settings.modulus;
    return s;
  }
  std::unique_ptr<EventFinder> finder(const EventSettings &settings,
                                      const FaultGrid &grid) const override {
    return std::make_unique<RuptureFinder>(grid, rupture_settings(settings, grid.dt));
  }
};

}  // namespace LSM

#endif
