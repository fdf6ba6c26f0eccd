// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_active_set.h
/// Decides which chunks of a chain are stepped: all, or those in which a block moves or may start
/// to move. For every other chunk, the positions give the time before which none of its blocks can
/// start. Blocks coupled by modes all act on each other, so that either all chunks are stepped or
/// none.
#ifndef SLIDER_ACTIVE_SET_H
#define SLIDER_ACTIVE_SET_H

#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "slider_kernels.h"

namespace Slider {

class ActiveSet {
 public:
  /// \param plate_step displacement of the plate in a step
  /// \param dense whether all chunks are stepped in every step
  ActiveSet(const ChainView &view, double plate_step, bool dense);

  /// The chunks to step, in ascending order.
  const std::vector<std::int32_t> &list() const { return list_; }
  /// For each listed chunk, the lanes that move or are about to move, which a kernel fills in.
  std::uint8_t *hot() { return hot_.data(); }

  /// Determines the list anew from displacements, velocities and forces after the given step.
  void restart(std::int64_t step);
  /// Updates the list after a step.
  void update(std::int64_t step);
  /// The first step in which a chunk that is not listed has to be stepped.
  std::int64_t next_wake();

 private:
  static constexpr std::int64_t never = INT64_MAX;
  using Entry = std::pair<std::int64_t, std::int32_t>;
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>>;

  std::int64_t wake_step(int chunk) const;
  void list_all();
  void rest_together(std::int64_t step);
  void change_list_to_next(std::int64_t step);
  void settle_idle(std::int64_t step);
  void add_extra();
  void wake_due(std::int64_t step);
  std::int64_t &wake(std::int32_t chunk) { return wake_[static_cast<std::size_t>(chunk)]; }

  ChainView view_;
  double plate_step_;
  bool dense_;
  int chunks_;
  std::uint8_t last_edge_;  // the lane of the last block of the chain
  std::vector<std::uint8_t> hot_;
  std::vector<std::int32_t> list_, next_list_, idle_, extra_;
  std::vector<std::int32_t> wanted_;  // chunks, with one past the last and room for one more
  std::vector<std::int64_t> wake_;    // 0: in the list; else the step in which it joins the list
  Queue queue_;                       // of the steps in wake_ and of outdated ones
  std::int64_t next_wake_ = 0;
};

}  // namespace Slider

#endif
