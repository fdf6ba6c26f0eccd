// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/drop_locator.h
/// How far a fault along a line slipped during drops of PE, and where (*) (the paper does not
/// locate events).
#ifndef LSM_DROP_LOCATOR_H
#define LSM_DROP_LOCATOR_H

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "events/fault_sums.h"
#include "files/event.h"

namespace LSM {

/// Slip of each bin from the begin to the end of a drop: the displacement of its faces, which is
/// interpolated linearly within the interval in which the drop begins, and in that in which it
/// ends. Those of drops and of the times between them hence add up to the slip history.
///
/// The end of a drop lies within an interval, so that it is reported when that interval is
/// complete.
class DropLocator {
 public:
  using Report = std::function<void(const Drop &)>;

  /// \param fraction bins with at most this fraction of the largest slip did not rupture
  DropLocator(const FaultGrid &grid, double modulus, double fraction);

  /// Takes a drop that ended, in order of time.
  void add(const Drop &drop, const Report &report);
  /// Forgets the drop that was open: it ended and is not written.
  void forget_open() { std::fill(open_.begin(), open_.end(), 0.0); }
  /// Adds the interval that ends at a step.
  /// \param begun step at which the drop began that is open at its end, if one is
  void add_interval(std::int64_t step, const FaultRow &row, std::optional<std::int64_t> begun,
                    const Report &report);
  /// Reports the drops that ended in the interval that is not complete.
  /// \param step, row what is known of that interval: its steps up to `step`
  void finish(std::int64_t step, const FaultRow &row, const Report &report);

  std::vector<double> state() const;
  /// \throws std::invalid_argument if no such locator can be in that state
  void set_state(const std::vector<double> &saved);

 private:
  struct Waiting {
    Drop drop;
    std::vector<double> slip;  // of each bin
    template <class Self, class State>
    static void visit(Self &self, State &state) {
      auto &e = self.drop;
      state(e.t_start, e.t_end, e.step_start, e.step_end, e.size, e.pe_start, e.pe_end);
      state(e.friction_work, e.friction_total);
      state.list(self.slip);
    }
  };
  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state(self.end_);
    state.list(self.open_);
    state.list(self.waiting_);
  }

  /// Share of the interval from end_ to `step` that lies between two steps.
  double part_of(std::int64_t from, std::int64_t to, std::int64_t step) const;
  /// Adds the slip in that share.
  void add_part(std::vector<double> &slip, std::int64_t from, std::int64_t to, std::int64_t step,
                const FaultRow &row) const;
  Drop located(const Waiting &one) const;

  FaultGrid grid_;
  MeanPlace centroid_;
  double modulus_, fraction_;
  std::int64_t end_;          // of the last complete interval
  std::vector<double> open_;  // slip of each bin in the open drop until then
  std::vector<Waiting> waiting_;
};

}  // namespace LSM

#endif
