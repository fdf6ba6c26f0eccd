// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_ruptures.h
/// Events of a fault as ruptures: sets of slipping contacts connected along the fault and in time
/// (ours; the paper picks drops of the total potential energy, PE).
///
/// The contacts are taken together in bins along the fault and in intervals of so many steps. A bin
/// slips in an interval if its mean slip velocity exceeds a given one. It is then connected with
/// the bins at most gap + 1 from it (periodic) that slip in the same interval or in one of the
/// `memory` intervals before it; see lsm_slip_sets.h. Unlike drops of the total PE, ruptures far
/// apart on a long fault stay apart.
///
/// What is known of a bin and interval is kept with the precision of a float: the slip history
/// holds the numbers that the ruptures were found from, and sums over several ranks, which differ
/// in the order of the additions, are the same numbers.
#ifndef LSM_RUPTURES_H
#define LSM_RUPTURES_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "lsm_event_picker.h"
#include "lsm_slip_sets.h"

namespace LSM {

/// How the fault is divided, and the times of the intervals.
struct FaultGrid {
  int bins = 1;
  double x0 = 0.0;            ///< lower edge of the first bin
  double width = 1.0;         ///< of a bin; the fault has the length bins * width
  std::int64_t step0 = 0;     ///< begin of the first interval
  std::int64_t interval = 1;  ///< steps
  double time0 = 0.0;         ///< time at step0
  double dt = 1.0;            ///< time of a step
  bool ring = true;           ///< periodic; else the fault has two ends

  double length() const { return bins * width; }
  double duration() const { return static_cast<double>(interval) * dt; }  ///< of an interval
  double time(std::int64_t step) const {
    return time0 + (static_cast<double>(step) - static_cast<double>(step0)) * dt;
  }
  bool ends_interval(std::int64_t step) const {
    return step > step0 && (step - step0) % interval == 0;
  }
  double centre(std::int64_t bin) const { return x0 + (static_cast<double>(bin) + 0.5) * width; }
};

/// What the bins of the fault did in one interval. Slip and stress are positive in the direction in
/// which the fault is driven.
struct FaultRow {
  std::vector<float> slip;    ///< mean slip of the contacts along the fault
  std::vector<float> work;    ///< work lost to friction
  std::vector<float> stress;  ///< shear force of the contacts per length, mean over the interval
  FaultRow() = default;
  explicit FaultRow(int bins)
      : slip(static_cast<std::size_t>(bins)), work(slip.size()), stress(slip.size()) {}
};

/// Sums of the contacts in the bins over an interval; those of several ranks can be added.
class FaultSums {
 public:
  static constexpr std::size_t fields = 4;  ///< slip, contacts, work, force

  FaultSums() = default;
  explicit FaultSums(const FaultGrid &grid)
      : grid_(grid), values_(fields * static_cast<std::size_t>(grid.bins)) {}

  /// A contact in one step. Slip and force along the fault; share: 1, or 0.5 where another rank
  /// counts the contact as well.
  void add(double x, double slip, double work, double force, double share) {
    double along = (x - grid_.x0) / grid_.length();
    along = grid_.ring ? along - std::floor(along) : std::max(along, 0.0);
    const int bin = std::min(static_cast<int>(along * grid_.bins), grid_.bins - 1);
    double *const sums = &values_[fields * static_cast<std::size_t>(bin)];
    sums[0] += share * slip;
    sums[1] += share;
    sums[2] += share * work;
    sums[3] += share * force;
  }

  std::vector<double> &values() { return values_; }
  void clear() { std::fill(values_.begin(), values_.end(), 0.0); }

 private:
  FaultGrid grid_;
  std::vector<double> values_;
};

/// The row of an interval of so many steps from FaultSums::values(). A bin without contacts moves
/// as its neighbours with contacts: linear between the nearest two (periodic).
inline FaultRow fault_row(const FaultGrid &grid, const double *sums, std::int64_t steps) {
  FaultRow row(grid.bins);
  const auto bins = static_cast<std::size_t>(grid.bins);
  const auto count = static_cast<double>(steps);
  std::vector<std::size_t> held;  // bins with contacts
  for (std::size_t b = 0; b < bins; ++b) {
    const double *const s = sums + FaultSums::fields * b;
    row.work[b] = static_cast<float>(s[2]);
    row.stress[b] = static_cast<float>(s[3] / (count * grid.width));
    if (!(s[1] > 0.0)) continue;
    row.slip[b] = static_cast<float>(s[0] / s[1] * count);
    held.push_back(b);
  }
  if (held.empty()) return row;
  if (!grid.ring) {
    std::fill(row.slip.begin(), row.slip.begin() + static_cast<std::ptrdiff_t>(held.front()),
              row.slip[held.front()]);
    std::fill(row.slip.begin() + static_cast<std::ptrdiff_t>(held.back()), row.slip.end(),
              row.slip[held.back()]);
  }
  for (std::size_t k = 0; k + (grid.ring ? 0 : 1) < held.size(); ++k) {
    const std::size_t left = held[k];
    const std::size_t right = k + 1 < held.size() ? held[k + 1] : held[0] + bins;
    const double a = row.slip[left], b = row.slip[right % bins];
    const auto distance = static_cast<double>(right - left);
    for (std::size_t open = left + 1; open < right; ++open)
      row.slip[open % bins] =
          static_cast<float>(a + (b - a) * (static_cast<double>(open - left) / distance));
  }
  return row;
}

struct RuptureSettings {
  double velocity = 0.0;    ///< bins whose slip velocity exceeds this slip
  int gap = 0;              ///< bins that may lie between two that are connected
  std::int64_t memory = 1;  ///< intervals over which bins are connected, at least 1
  double modulus = 1.0;     ///< shear modulus
};

/// Slip of a bin in an interval above which it slips; the same number wherever ruptures are found.
inline double slipping_above(const FaultGrid &grid, double velocity) {
  return velocity * grid.duration();
}

/// What is known of a rupture; its places are bins and its steps are intervals.
struct FaultRupture : SlipSet {
  std::int64_t hypocentre = 0;            ///< bin that slipped most in the first interval
  double first_slip = 0.0;                ///< its slip then
  double slip = 0.0;                      ///< sum over the bins and intervals
  double slip_cos = 0.0, slip_sin = 0.0;  ///< sizes of the slips times the direction on the ring
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
};

/// Puts the slips of a fault together to ruptures. Call begin(), then add() for each interval.
class RuptureFinder {
 public:
  /// \throws std::invalid_argument for settings out of range
  RuptureFinder(const FaultGrid &grid, const RuptureSettings &settings)
      : grid_(grid),
        settings_(settings),
        // places behind the end in which nothing slides keep the ends apart
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

  /// The state before the first interval: total PE and the stresses of the bins.
  void begin(double pe, const FaultRow &row) {
    before_ = row.stress;
    pe_ = pe;
  }

  /// The next interval, with PE at its end. Calls finished(const Event &) for each rupture that has
  /// come to its end, in order of step_end. Event::id is left to the caller.
  template <class Finished>
  void add(double pe, const FaultRow &row, Finished &&finished) {
    const std::int64_t n = sets_.step() + 1;
    const double least = slipping_above(grid_, settings_.velocity);
    sets_.begin_step(n);
    active_ = !sets_.idle();  // until the interval after the end, whose stress is wanted
    for (int b = 0; b < grid_.bins; ++b) {
      const auto i = static_cast<std::size_t>(b);
      const double slip = row.slip[i], size = std::fabs(slip);
      if (!(size > least)) continue;
      active_ = true;
      FaultRupture &r = sets_.slide(b, [this, n](FaultRupture &begun) {
        begun.pe_start = pe_;
        begun.hypocentre = begun.first_place;
        snapshots_.emplace(n - 1, before_);
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
        [&](const FaultRupture &r) { finished(event(r)); });
    forget();
    before_ = row.stress;
    pe_ = pe;
  }

  /// Calls f(const Event &) for each open rupture as if it ended now, in the order of add().
  template <class F>
  void each_open_as_ended(F &&f) const {
    std::vector<FaultRupture> all;
    sets_.each_open([&all](const FaultRupture &r) { all.push_back(r); });
    std::sort(all.begin(), all.end(), [](const FaultRupture &a, const FaultRupture &b) {
      return std::tie(a.step_end, a.step_start, a.first_place) <
             std::tie(b.step_end, b.step_start, b.first_place);
    });
    for (FaultRupture &r : all) {
      if (r.step_end == sets_.step()) r.stress_after = mean(before_, r);
      f(event(r));
    }
  }

  /// Something slipped in the last interval, or a rupture was open when it began.
  bool active() const { return active_; }
  std::int64_t intervals() const { return sets_.step(); }  ///< added so far
  /// At the end of the last interval.
  double pe() const { return pe_; }
  const std::vector<float> &stress() const { return before_; }
  std::int64_t open() const {
    std::int64_t count = 0;
    sets_.each_open([&count](const FaultRupture &) { ++count; });
    return count;
  }

  /// For restarts: whole numbers below 2^53 among them.
  std::vector<double> state() const {
    const SlipSetsState<FaultRupture> s = sets_.state();
    std::vector<double> out;
    const auto whole = [&out](std::int64_t value) { out.push_back(static_cast<double>(value)); };
    whole(grid_.bins);
    whole(sets_.step());
    whole(active_ ? 1 : 0);
    out.push_back(pe_);
    append(out, before_);
    whole(static_cast<std::int64_t>(snapshots_.size()));
    for (const auto &[n, stress] : snapshots_) {
      whole(n);
      append(out, stress);
    }
    whole(static_cast<std::int64_t>(s.open.size()));
    for (const FaultRupture &r : s.open) {
      for (const std::int64_t value :
           {r.step_start, r.step_end, r.first_place, r.begin, r.length, r.hypocentre})
        whole(value);
      for (const double value : {r.first_slip, r.slip, r.slip_cos, r.slip_sin, r.work, r.pe_start,
                                 r.pe_end, r.stress_after})
        out.push_back(value);
    }
    whole(static_cast<std::int64_t>(s.recent.size()));
    for (const RecentSlip &r : s.recent)
      for (const std::int64_t value : {r.place, r.step, r.set}) whole(value);
    return out;
  }

  /// Goes on to the last digit; the settings must be those the state was saved under.
  /// \throws std::invalid_argument if it cannot be that of such a fault
  void set_state(const std::vector<double> &saved) {
    Reader in{saved};
    if (in.whole() != grid_.bins)
      throw std::invalid_argument("saved ruptures are of another number of bins");
    const std::int64_t step = in.whole();
    active_ = in.whole() != 0;
    pe_ = in.next();
    before_ = in.stresses(grid_.bins);
    snapshots_.clear();
    for (std::int64_t k = in.whole(); k > 0; --k) {
      const std::int64_t n = in.whole();
      snapshots_[n] = in.stresses(grid_.bins);
    }
    SlipSetsState<FaultRupture> s;
    for (std::int64_t k = in.whole(); k > 0; --k) {
      FaultRupture r;
      for (std::int64_t *value :
           {&r.step_start, &r.step_end, &r.first_place, &r.begin, &r.length, &r.hypocentre})
        *value = in.whole();
      for (double *value : {&r.first_slip, &r.slip, &r.slip_cos, &r.slip_sin, &r.work, &r.pe_start,
                            &r.pe_end, &r.stress_after})
        *value = in.next();
      if (snapshots_.find(r.step_start) == snapshots_.end())
        throw std::invalid_argument("saved ruptures are inconsistent");
      s.open.push_back(r);
    }
    for (std::int64_t k = in.whole(); k > 0; --k) {
      RecentSlip r;
      for (std::int64_t *value : {&r.place, &r.step, &r.set}) *value = in.whole();
      s.recent.push_back(r);
    }
    if (in.at != saved.size()) throw std::invalid_argument("saved ruptures are inconsistent");
    sets_.set_state(s, step);
  }

 private:
  static constexpr double pi = 3.14159265358979323846;

  struct Reader {
    const std::vector<double> &from;
    std::size_t at = 0;
    double next() {
      if (at >= from.size()) throw std::invalid_argument("saved ruptures are incomplete");
      return from[at++];
    }
    std::int64_t whole() { return static_cast<std::int64_t>(next()); }
    std::vector<float> stresses(int bins) {
      std::vector<float> out;
      for (int b = 0; b < bins; ++b) out.push_back(static_cast<float>(next()));
      return out;
    }
  };

  static void append(std::vector<double> &out, const std::vector<float> &values) {
    out.insert(out.end(), values.begin(), values.end());
  }

  double mean(const std::vector<float> &values, const SlipSet &row) const {
    double sum = 0.0;
    for (std::int64_t k = 0; k < row.length; ++k)
      sum += values[static_cast<std::size_t>((row.begin + k) % grid_.bins)];
    return sum / static_cast<double>(row.length);
  }

  /// Stresses that no open rupture began with.
  void forget() {
    if (snapshots_.empty()) return;
    std::vector<std::int64_t> wanted;
    sets_.each_open([&wanted](const FaultRupture &r) { wanted.push_back(r.step_start); });
    for (auto it = snapshots_.begin(); it != snapshots_.end();)
      it = std::find(wanted.begin(), wanted.end(), it->first) == wanted.end() ? snapshots_.erase(it)
                                                                              : std::next(it);
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
    double along = grid_.ring ? std::atan2(r.slip_sin, r.slip_cos) / (2.0 * pi)
                              : r.slip_cos / r.slip_sin / grid_.bins;
    if (along < 0.0) along += 1.0;
    if (!(along < 1.0)) along = 0.0;  // of -1e-17
    e.x_centroid = grid_.x0 + along * grid_.length();
    e.rupture_length = static_cast<double>(r.length) * grid_.width;
    e.x_hypocentre = grid_.centre(r.hypocentre);
    e.x_begin = grid_.x0 + static_cast<double>(r.begin) * grid_.width;
    e.mean_slip = r.slip / static_cast<double>(r.length);
    e.stress_drop = mean(snapshots_.at(r.step_start), r) - r.stress_after;
    return e;
  }

  FaultGrid grid_;
  RuptureSettings settings_;
  SlipSets<FaultRupture> sets_;
  std::vector<double> cosine_, sine_;  // direction of a bin on the ring; without ring place and 1
  std::vector<float> before_;          // stresses of the interval before
  double pe_ = 0.0;                    // at its end
  bool active_ = false;
  std::map<std::int64_t, std::vector<float>> snapshots_;  // stresses before open ruptures began
};

}  // namespace LSM

#endif
