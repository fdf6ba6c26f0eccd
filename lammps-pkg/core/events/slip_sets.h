// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/slip_sets.h
/// Sets of sliding places that are connected in space and time, assembled as the slips occur.
/// Places are blocks of a chain or bins along a fault, and form a ring; or they are cells of a
/// plane, rings of rings, and sets are patches (SlipPatch).
///
/// A place that slides in step n is connected with the places at most `reach` from it that slide in
/// step n or in one of the `memory` steps before it; on a plane in both directions, so that
/// neighbours across a corner are connected. A set ends when no sliding place can connect
/// with it any more; two sets that meet become one.
#ifndef LSM_SLIP_SETS_H
#define LSM_SLIP_SETS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace LSM {

/// Members common to all sets; derived classes add the rest.
struct SlipSet {
  std::int64_t step_start = 0;  ///< the step before the first in which a place slid
  std::int64_t step_end = 0;    ///< the last step in which a place slid
  std::int64_t first = 0;       ///< lowest of the places that slid first
  /// The places that slid and the gaps between them: `length` consecutive places from `begin` on.
  std::int64_t begin = 0, length = 0;

  /// The order in which sets are reported.
  bool operator<(const SlipSet &other) const {
    return std::tie(step_end, step_start, first) <
           std::tie(other.step_end, other.step_start, other.first);
  }
};

/// A set on a plane: `begin` and `length` are along strike; the rows that slid and the gaps between
/// them are `dip_length` consecutive ones from `dip_begin` on.
struct SlipPatch : SlipSet {
  std::int64_t dip_begin = 0, dip_length = 0;
};

/// Extends a row of places by another row and the gap of at most `gap` places between them. A row
/// whose ends are no farther apart than `gap` covers the whole ring.
inline void extend(std::int64_t &row_begin, std::int64_t &row_length, std::int64_t begin,
                   std::int64_t length, std::int64_t places, std::int64_t gap) {
  if (row_length == places) return;
  const std::int64_t behind = (begin - row_begin + places) % places;  // from row_begin to begin
  std::int64_t n = std::max(row_length, behind + length);
  const std::int64_t other = std::max(length, places - behind + row_length);
  if (behind > row_length && other <= n) {
    n = other;
    row_begin = begin;
  }
  if (places - n <= gap) {
    n = places;
    row_begin = 0;
  }
  row_length = n;
}

/// A place whose slip may still connect with later ones.
struct RecentSlip {
  std::int64_t place = 0, step = 0;
  std::int64_t set = 0;  ///< index of its set

  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state(self.place, self.step, self.set);
  }
};

/// The state between steps.
template <class Set>
struct SlipSetsState {
  std::vector<Set> open;
  std::vector<RecentSlip> recent;
};

/// Combines slips to sets. Set is derived from SlipSet or SlipPatch and has absorb(const Set
/// &later), which adds the values of the derived class; the members of SlipSet and SlipPatch are
/// merged here.
///
/// Call begin_step(), slide() for each place that slides in ascending order, end_step(). The result
/// depends on nothing but these calls. Memory: some words per place and per open set.
template <class Set>
class SlipSets {
 public:
  /// \param rows places along dip, for patches; place i of row k has the number i * rows + k
  SlipSets(int places, int reach, std::int64_t memory, int rows = 1)
      : places_(places),
        rows_(rows),
        reach_(std::min(reach, std::max(1, places / 2))),
        reach_dip_(std::min(reach, rows / 2)),
        memory_(memory) {
    if (places < 1 || rows < 1 || reach < 1)
      throw std::invalid_argument("rupture reach less than one place");
    if (memory < 1) throw std::invalid_argument("rupture memory less than one step");
    last_.assign(static_cast<std::size_t>(places) * static_cast<std::size_t>(rows), never);
    owner_.assign(last_.size(), 0);
  }

  void begin_step(std::int64_t step) { step_ = step; }

  /// Adds place i, which slides.
  /// \param begun called with the set of the place if it is new
  /// \return the set of the place, valid until the next call
  template <class Begun>
  Set &slide(int i, Begun &&begun) {
    return slide(i, 0, begun);
  }
  /// \param row of the place, for patches
  template <class Begun>
  Set &slide(int i, int row, Begun &&begun) {
    std::int32_t mine = none;
    const auto meet = [&](int j) {
      if (last_[index(j)] < step_ - memory_) return;
      const std::int32_t other = owner_[index(j)] = root(owner_[index(j)]);
      if (mine == none) {
        mine = other;
        extend_by(nodes_[index(mine)].set, place_at(i, row));
      } else if (mine != other) {
        mine = join(mine, other);
      }
    };
    for (int d = -reach_; d <= reach_; ++d) {
      const int j = around(i + d, places_);
      if constexpr (patches)
        for (int e = -reach_dip_; e <= reach_dip_; ++e) meet(j * rows_ + around(row + e, rows_));
      else
        meet(j);
    }
    const int place = patches ? i * rows_ + row : i;
    if (mine == none) {
      mine = start(place, i, row);
      begun(nodes_[index(mine)].set);
    }
    Set &set = nodes_[index(mine)].set;
    set.step_end = step_;
    last_[index(place)] = step_;
    owner_[index(place)] = mine;
    return set;
  }

  /// Ends the step. Calls look(Set &) for each open set, then finished(const Set &) for each set
  /// that has ended, in order of step_end, step_start, first place.
  template <class Look, class Finished>
  void end_step(Look &&look, Finished &&finished) {
    if (open_.empty()) return;
    finished_.clear();
    std::size_t kept = 0;
    for (const std::int32_t k : open_) {
      Node &node = nodes_[index(k)];
      if (node.parent != k) continue;  // joined with another one
      look(node.set);
      if (node.set.step_end > step_ - memory_) {
        open_[kept++] = k;
        continue;
      }
      finished_.push_back(node.set);
      for (std::int32_t m = k; m != none; m = nodes_[index(m)].next) free_.push_back(m);
    }
    open_.resize(kept);
    if (finished_.empty()) return;
    std::sort(finished_.begin(), finished_.end());
    for (const Set &set : finished_) finished(set);
  }

  /// Whether no set is open.
  bool idle() const { return open_.empty(); }
  /// Sets that are open; after end_step().
  std::int64_t open() const { return static_cast<std::int64_t>(open_.size()); }
  int places() const { return places_; }
  std::int64_t memory() const { return memory_; }
  std::int64_t step() const { return step_; }

  /// Calls f(const Set &) for each open set; after end_step().
  template <class F>
  void each_open(F &&f) const {
    for (const std::int32_t k : open_) f(nodes_[index(k)].set);
  }

  /// After end_step().
  SlipSetsState<Set> state() const {
    SlipSetsState<Set> s;
    std::vector<std::int64_t> place(nodes_.size(), -1);
    for (const std::int32_t k : open_) {
      place[index(k)] = static_cast<std::int64_t>(s.open.size());
      s.open.push_back(nodes_[index(k)].set);
    }
    for (int i = 0; i < places_ * rows_ && !open_.empty(); ++i) {
      if (last_[index(i)] > step_ - memory_)
        s.recent.push_back({i, last_[index(i)], place[index(root(owner_[index(i)]))]});
    }
    return s;
  }

  /// Continues after the given step.
  /// \throws std::invalid_argument if no sets can be in that state
  void set_state(const SlipSetsState<Set> &s, std::int64_t step) {
    step_ = step;
    nodes_.clear();
    open_.clear();
    free_.clear();
    std::fill(last_.begin(), last_.end(), never);
    const std::invalid_argument bad("saved ruptures are inconsistent");
    const auto count = static_cast<std::int64_t>(s.open.size());
    if (count > static_cast<std::int64_t>(last_.size())) throw bad;
    for (const Set &set : s.open) {
      const auto k = static_cast<std::int32_t>(nodes_.size());
      nodes_.push_back({k, none, k, set});
      open_.push_back(k);
    }
    for (const RecentSlip &r : s.recent) {
      if (r.place < 0 || r.place >= static_cast<std::int64_t>(last_.size()) || r.set < 0 ||
          r.set >= count || r.step > step)
        throw bad;
      last_[static_cast<std::size_t>(r.place)] = r.step;
      owner_[static_cast<std::size_t>(r.place)] = static_cast<std::int32_t>(r.set);
    }
  }

 private:
  static constexpr bool patches = std::is_base_of_v<SlipPatch, Set>;
  static constexpr std::int32_t none = -1;
  static constexpr std::int64_t never = INT64_MIN / 2;

  // A set that was merged into another one remains as a node that refers to it until that one ends,
  // as places may still refer to the node.
  struct Node {
    std::int32_t parent, next, tail;  // next and tail: chain of all nodes joined with a root
    Set set;
  };

  template <class Integer>
  static std::size_t index(Integer i) {
    return static_cast<std::size_t>(i);
  }

  std::int32_t root(std::int32_t k) const {
    while (nodes_[index(k)].parent != k) k = nodes_[index(k)].parent;
    return k;
  }

  static int around(int i, int places) { return i < 0 ? i + places : i >= places ? i - places : i; }

  static SlipPatch place_at(std::int64_t i, std::int64_t row) {
    SlipPatch place;
    place.begin = i;
    place.dip_begin = row;
    place.length = place.dip_length = 1;
    return place;
  }

  template <class Other>
  void extend_by(Set &set, const Other &other) const {
    extend(set.begin, set.length, other.begin, other.length, places_, reach_ - 1);
    if constexpr (patches)
      extend(set.dip_begin, set.dip_length, other.dip_begin, other.dip_length, rows_,
             reach_dip_ - 1);
  }

  std::int32_t start(int place, int i, [[maybe_unused]] int row) {
    std::int32_t k;
    if (free_.empty()) {
      k = static_cast<std::int32_t>(nodes_.size());
      nodes_.emplace_back();
    } else {
      k = free_.back();
      free_.pop_back();
    }
    Set set;
    set.step_start = step_ - 1;
    set.first = place;
    set.begin = i;
    set.length = 1;
    if constexpr (patches) {
      set.dip_begin = row;
      set.dip_length = 1;
    }
    if (places_ <= reach_) extend_by(set, place_at(i, row));
    nodes_[index(k)] = {k, none, k, set};
    open_.push_back(k);
    return k;
  }

  std::int32_t join(std::int32_t a, std::int32_t b) {
    const Set &x = nodes_[index(a)].set, &y = nodes_[index(b)].set;
    if (std::tie(y.step_start, y.first) < std::tie(x.step_start, x.first)) std::swap(a, b);
    Node &into = nodes_[index(a)], &joined = nodes_[index(b)];
    extend_by(into.set, joined.set);
    into.set.step_end = std::max(into.set.step_end, joined.set.step_end);
    into.set.absorb(joined.set);
    joined.parent = a;
    nodes_[index(into.tail)].next = b;
    into.tail = joined.tail;
    return a;
  }

  int places_, rows_, reach_, reach_dip_;
  std::int64_t memory_;
  std::int64_t step_ = 0;
  std::vector<std::int64_t> last_;   // step in which a place slid last
  std::vector<std::int32_t> owner_;  // its set then
  std::vector<Node> nodes_;
  std::vector<std::int32_t> open_, free_;
  std::vector<Set> finished_;
};

}  // namespace LSM

#endif
