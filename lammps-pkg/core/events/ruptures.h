// SPDX-License-Identifier: GPL-2.0-or-later
/// \file ruptures.h
/// Events of a fault as ruptures: sets of slipping contacts connected along the fault and in time
/// (*) (the paper picks drops of the total potential energy, PE).
///
/// Contacts are summed in bins along the fault, or in cells of a plane, and in intervals of so many
/// steps. A bin slips in an interval if its mean slip velocity exceeds a given one. It is then
/// connected with the bins at most gap + 1 from it in each direction (periodic, where the fault is)
/// that slip in the same interval or in one of the `memory` intervals before it; see
/// events/slip_sets.h. Unlike drops of the total PE, ruptures far apart on a long fault remain
/// separate.
#ifndef LSM_RUPTURES_H
#define LSM_RUPTURES_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "events/fault_sums.h"
#include "events/slip_sets.h"
#include "files/event.h"

namespace LSM {

/// Slip of one bin or cell.
struct BinSlip {
  std::int64_t bin = 0;
  double slip = 0.0;
  double dip = 0.0;  ///< slip along dip, on a plane
  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state(self.bin, self.slip);
  }
};

/// A rupture in units of bins and intervals.
struct FaultRupture : SlipPatch {
  std::int64_t hypocentre = 0;            ///< bin that slipped most in the first interval
  double first_slip = 0.0;                ///< slip of this bin in that interval
  double slip = 0.0;                      ///< sum over the bins and intervals
  double slip_cos = 0.0, slip_sin = 0.0;  ///< absolute slips times the direction on the ring
  double work = 0.0;
  double t_start = 0.0, t_end = 0.0;
  double pe_start = 0.0, pe_end = 0.0;
  double stress_after = 0.0;  ///< mean over its row in the first interval after its end

  std::vector<BinSlip> places;  ///< slip of each of its bins that slipped, in order of the bins

  // On a plane; the numbers above are along strike.
  double slip_dip = 0.0;                ///< sum over the cells and intervals
  double dip_cos = 0.0, dip_sin = 0.0;  ///< as slip_cos and slip_sin, along dip
  double most_slip = 0.0;               ///< of a cell in an interval
  double stress_after_dip = 0.0;

  void add_slip(const BinSlip &more);
  void absorb(const FaultRupture &later);

  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state(self.step_start, self.step_end, self.first, self.begin, self.length, self.hypocentre,
          self.first_slip, self.slip, self.slip_cos, self.slip_sin, self.work, self.t_start,
          self.t_end, self.pe_start, self.pe_end, self.stress_after);
    state.list(self.places);
  }
  /// What a rupture on a plane has besides.
  template <class Self, class State>
  static void visit_plane(Self &self, State &state) {
    state(self.dip_begin, self.dip_length, self.slip_dip, self.dip_cos, self.dip_sin,
          self.most_slip, self.stress_after_dip);
    for (auto &place : self.places) state(place.dip);
  }
};

/// State of the fault at the end of an interval.
struct FaultMoment {
  std::int64_t intervals = 0;  ///< number of intervals so far
  double pe = 0.0;
  std::vector<float> stress;  ///< as FaultRow::stress
};

/// Connects slips of a fault to ruptures. Call begin(), then add() for each interval. Ruptures are
/// reported in order of their ends; while one is, rupture() or plane_rupture() describe it.
class RuptureFinder {
 public:
  using Report = std::function<void(const FaultRupture &)>;

  /// \throws std::invalid_argument for settings out of range
  RuptureFinder(const FaultGrid &grid, const RuptureSettings &settings);

  /// Sets the state before the first interval.
  void begin(double time, double pe, const FaultRow &row);
  /// Adds the next interval, with time and PE at its end.
  void add(double time, double pe, const FaultRow &row, const Report &report);
  /// Reports open ruptures as if they ended now.
  void each_open_as_ended(const Report &report) const;

  /// A rupture, of a line or of a plane, as an event without number.
  Rupture rupture(const FaultRupture &r) const;
  PlaneRupture plane_rupture(const FaultRupture &r) const;

  /// Whether something slipped in the last interval, or a rupture was open when it began, so that
  /// the slip history gives it a record of its own.
  bool active() const { return active_; }
  FaultMoment last_interval() const { return {sets_.step(), pe_, before_}; }
  std::int64_t open() const { return sets_.open(); }

  std::vector<double> state() const;

  /// Continues exactly where the saved state ended; the settings must be the same.
  /// \throws std::invalid_argument if no such finder can be in that state
  void set_state(const std::vector<double> &numbers);

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
    state(step, self.active_, self.time_, self.pe_);
    const std::size_t numbers =
        self.grid_.components() * static_cast<std::size_t>(self.grid_.cells());
    const auto room = [numbers](auto &row) {
      if constexpr (!std::is_const_v<Self>) row.resize(numbers);
    };
    room(self.before_);
    state.fixed(self.before_);
    state.list(self.snapshots_, [&room](auto &snapshot) { room(snapshot.stress); });
    state.list(sets.open);
    state.list(sets.recent);
    if (self.grid_.plane)
      for (auto &rupture : sets.open) FaultRupture::visit_plane(rupture, state);
  }

  /// The stresses before a rupture began.
  const std::vector<float> &snapshot(std::int64_t interval) const;

  /// Mean stress where a rupture slipped: on a line of its row of bins, on a plane of its cells.
  FaultVector mean(const std::vector<float> &stress, const FaultRupture &r) const;
  void note_stress_after(FaultRupture &r, const std::vector<float> &stress) const;

  /// Drops the snapshots that no open rupture needs.
  void forget();

  FaultGrid grid_;
  RuptureSettings settings_;
  SlipSets<FaultRupture> sets_;
  MeanPlace centroid_, centroid_dip_;
  std::vector<float> before_;     // stresses of the previous interval
  double time_ = 0.0, pe_ = 0.0;  // at its end
  bool active_ = false;
  std::vector<Snapshot> snapshots_;  // before open ruptures began, in order of time
};

}  // namespace LSM

#endif
