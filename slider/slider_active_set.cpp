// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_active_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Slider {

ActiveSet::ActiveSet(const ChainView &view, double plate_step, bool dense)
    : view_(view),
      plate_step_(plate_step),
      dense_(dense),
      chunks_((view.blocks + chunk_size - 1) / chunk_size),
      last_edge_(static_cast<std::uint8_t>(1U << ((view.blocks - 1) % chunk_size))) {
  const auto n = static_cast<std::size_t>(chunks_);
  hot_.assign(n, 0);
  wake_.assign(n, 0);
  list_.reserve(n);
  next_list_.reserve(n + 1);
  wanted_.assign(n + 2, 0);
}

void ActiveSet::list_all() {
  list_.clear();
  for (std::int32_t c = 0; c < chunks_; ++c) list_.push_back(c);
}

// Empties the list if no chunk has to be stepped in the next step.
void ActiveSet::rest_together(std::int64_t step) {
  std::int64_t first = never;
  for (const std::int32_t c : list_) first = std::min(first, wake_step(c));
  if (first <= step + 1) return;
  list_.clear();
  next_wake_ = first;
}

void ActiveSet::restart(std::int64_t step) {
  if (!view_.by_springs()) {
    list_all();
    std::fill(hot_.begin(), hot_.end(), 0);
    bool any = dense_;
    for (int i = 0; i < view_.blocks; ++i) {
      if (!(view_.v[i] > 0.0 || view_.force[i] > view_.mu[i])) continue;
      hot_[static_cast<std::size_t>(i / chunk_size)] |=
          static_cast<std::uint8_t>(1U << (i % chunk_size));
      any = true;
    }
    if (!any) rest_together(step);
    return;
  }
  list_.clear();
  queue_ = Queue();
  std::fill(wake_.begin(), wake_.end(), 0);
  std::vector<bool> wanted(wake_.size(), dense_);
  for (int i = 0; i < view_.blocks && !dense_; ++i) {
    if (!(view_.v[i] > 0.0 || view_.force[i] > view_.mu[i])) continue;
    const int c = i / chunk_size;
    for (const int d : {c > 0 ? c - 1 : chunks_ - 1, c, c + 1 < chunks_ ? c + 1 : 0})
      wanted[static_cast<std::size_t>(d)] = true;
  }
  for (std::int32_t c = 0; c < chunks_; ++c)
    (wanted[static_cast<std::size_t>(c)] ? list_ : idle_).push_back(c);
  settle_idle(step);
}

// Returns the last step up to which chunk c may stay idle, at least two steps before any of its
// blocks can start, so that rounding cannot matter. Only the plate changes the forces until then.
std::int64_t ActiveSet::wake_step(int c) const {
  double first = std::numeric_limits<double>::max(), scale = 0.0;
  for (int i = c * chunk_size; i < (c + 1) * chunk_size && i < view_.blocks; ++i) {
    const double *u = view_.u;
    const double plate_at = u[i] + (view_.mu[i] - view_.coupling(i)) / view_.kl;
    first = std::min(first, plate_at);
    scale = std::max({scale, std::fabs(plate_at),
                      std::fabs(u[i]) * (1.0 + view_.kc / view_.kl) + view_.mu[i] / view_.kl});
  }
  const double steps =
      (first - 64.0 * std::numeric_limits<double>::epsilon() * scale) / plate_step_;
  if (!(steps < 4e18)) return never;
  return static_cast<std::int64_t>(std::floor(steps * (1.0 - 1e-15))) - 2;
}

// A chunk is active while one of its blocks, or the nearest block of a neighbouring chunk, moves or
// is about to move, or if one of its blocks will start soon.
void ActiveSet::update(std::int64_t step) {
  if (dense_) return;
  if (!view_.by_springs()) {
    if (!list_.empty()) {
      const auto hot = [](std::uint8_t lanes) { return lanes != 0; };
      if (std::none_of(hot_.begin(), hot_.end(), hot)) rest_together(step);
    } else if (step + 1 >= next_wake_) {
      list_all();
    }
    return;
  }
  // Branches on the lanes would be mispredicted half of the time.
  std::size_t n = 0;
  std::int32_t back = -1;
  const auto want = [&](std::int32_t c, bool wanted) {
    wanted_[n] = c;
    wanted = wanted && back < c;
    n += wanted;
    back = wanted ? c : back;
  };
  for (std::size_t k = 0; k < list_.size(); ++k) {
    const std::uint8_t h = hot_[k];
    const std::int32_t c = list_[k];
    want(c - 1, h & 1U);
    want(c, h);
    want(c + 1, h & 0x80U);
  }
  if (back == chunks_) --n;
  auto &next = next_list_;
  next.assign(wanted_.data(), wanted_.data() + n);
  if (!list_.empty()) {
    const std::int32_t last = chunks_ - 1;
    const bool want_last = list_.front() == 0 && hot_[0] & 1U;
    const bool want_first = list_.back() == last && hot_[list_.size() - 1] & last_edge_;
    if (want_last && (next.empty() || next.back() != last)) next.push_back(last);
    if (want_first && (next.empty() || next.front() != 0)) next.insert(next.begin(), 0);
  }
  if (next != list_) change_list_to_next(step);
  if (step + 1 >= next_wake_) wake_due(step);
}

void ActiveSet::change_list_to_next(std::int64_t step) {
  idle_.clear();
  const std::int32_t *old = list_.data();
  const std::int32_t *const end = old + list_.size();
  for (const std::int32_t c : next_list_) {
    while (old != end && *old < c) idle_.push_back(*old++);
    if (old != end && *old == c)
      ++old;
    else
      wake(c) = 0;
  }
  idle_.insert(idle_.end(), old, end);
  list_.swap(next_list_);
  settle_idle(step);
}

// Removes the chunks in idle_ from the list until their wake step, or keeps them if it has come.
void ActiveSet::settle_idle(std::int64_t step) {
  for (const std::int32_t c : idle_) {
    const std::int64_t at = wake_step(c);
    const bool now = at <= step + 1;
    wake(c) = now ? 0 : at;
    if (now)
      extra_.push_back(c);
    else if (at < never)
      queue_.emplace(at, c);
  }
  idle_.clear();
  add_extra();
  next_wake_ = queue_.empty() ? never : queue_.top().first;
  if (queue_.size() <= 64 + 8 * wake_.size()) return;
  // Most entries are outdated by now.
  queue_ = Queue();
  for (std::int32_t c = 0; c < chunks_; ++c)
    if (wake(c) > 0 && wake(c) < never) queue_.emplace(wake(c), c);
}

// Inserts all at once, as each single insertion would cost the length of the list.
void ActiveSet::add_extra() {
  if (extra_.empty()) return;
  std::sort(extra_.begin(), extra_.end());
  const auto middle = list_.insert(list_.end(), extra_.begin(), extra_.end());
  std::inplace_merge(list_.begin(), middle, list_.end());
  extra_.clear();
}

std::int64_t ActiveSet::next_wake() {
  if (!view_.by_springs()) return next_wake_;
  while (!queue_.empty() && wake(queue_.top().second) != queue_.top().first) queue_.pop();
  next_wake_ = queue_.empty() ? never : queue_.top().first;
  return next_wake_;
}

void ActiveSet::wake_due(std::int64_t step) {
  while (next_wake() <= step + 1) {
    const std::int32_t c = queue_.top().second;
    queue_.pop();
    wake(c) = 0;
    extra_.push_back(c);
  }
  add_extra();
}

}  // namespace Slider
