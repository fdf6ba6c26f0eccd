// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_ruptures.h
/// Events as ruptures: sets of sliding blocks connected in space and time (ours; the paper picks
/// drops of the potential energy (PE) of the whole chain).
///
/// Block i slides in step n if the step changes its displacement. It is then connected with the
/// blocks i - 1, i and i + 1 (periodic) that slide in step n or in one of the memory steps before
/// it. A rupture is a connected set of such pairs (i, n): it ends when no block that slides is
/// connected with it any more, and two that meet become one. One step of memory is what causes can
/// do: a block that stops in step n pushes its neighbour over its limit for step n + 1.
///
/// Unlike drops of the total PE, ruptures far apart in a long chain stay apart.
#ifndef SLIDER_RUPTURES_H
#define SLIDER_RUPTURES_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "lsm_event_picker.h"

namespace Slider {

/// What is known of a rupture. Plain data without padding, for checkpoints. Energies, times and
/// slips in model units.
struct Rupture {
  std::int64_t step_start = 0;   ///< the step before the first in which a block slid
  std::int64_t step_end = 0;     ///< the last step in which a block slid
  std::int64_t first_block = 0;  ///< lowest of those that slid first
  /// The blocks that slid are, being connected, length in a row (periodic) from begin on.
  std::int64_t begin = 0, length = 0;
  double size = 0.0;                      ///< work of all springs on the blocks
  double slip = 0.0;                      ///< sum of the slips of all blocks
  double slip_cos = 0.0, slip_sin = 0.0;  ///< slips times the direction of the block on the ring
  double pe_start = 0.0, pe_end = 0.0;    ///< PE of the whole chain at step_start, step_end
};
static_assert(std::is_trivially_copyable<Rupture>::value, "Rupture goes into checkpoints");

/// A block that slid not too long ago to be connected with the next one.
struct RecentSlip {
  std::int64_t block = 0, step = 0;
  std::int64_t rupture = 0;  ///< index of its rupture
};

/// Everything a tracker has to remember between steps.
struct RuptureState {
  std::vector<Rupture> open;
  std::vector<RecentSlip> recent;
};

/// Puts slips together to ruptures as they come. Memory: some words per block and per open rupture.
///
/// Call begin_step(), slide() for each block that slides in ascending order, end_step(). The result
/// depends on nothing but these calls; a tracker restored by set_state() goes on to the last digit.
class RuptureTracker {
 public:
  static constexpr bool watches = true;

  /// \param memory steps, see above; at least 1
  /// \param centroid whether x_centroid is wanted
  RuptureTracker(int blocks, std::int64_t memory, bool centroid)
      : blocks_(blocks), memory_(memory) {
    if (blocks < 1 || memory < 1) throw std::invalid_argument("rupture memory less than one step");
    last_.assign(static_cast<std::size_t>(blocks), never);
    owner_.assign(last_.size(), 0);
    if (!centroid) return;
    const double circle = 2.0 * pi / blocks;
    for (int i = 0; i < blocks; ++i) {
      cosine_.push_back(std::cos(circle * i));
      sine_.push_back(std::sin(circle * i));
    }
  }

  /// The step that leads to the given one, from PE pe_before.
  void begin_step(std::int64_t step, double pe_before) {
    step_ = step;
    pe_before_ = pe_before;
  }

  /// Block i slides by slip > 0; the springs do the given work on it.
  void slide(int i, double work, double slip) {
    std::int32_t mine = none;
    const int left = i > 0 ? i - 1 : blocks_ - 1, right = i + 1 < blocks_ ? i + 1 : 0;
    for (const int j : {left, i, right}) {
      if (last_[index(j)] < step_ - memory_) continue;
      const std::int32_t other = owner_[index(j)] = root(owner_[index(j)]);
      if (mine == none) {
        mine = other;
        extend(nodes_[index(mine)].rupture, i, 1);
      } else if (mine != other) {
        mine = join(mine, other);
      }
    }
    if (mine == none) mine = start(i);
    Rupture &r = nodes_[index(mine)].rupture;
    r.step_end = step_;
    r.size += work;
    r.slip += slip;
    if (!cosine_.empty()) {
      r.slip_cos += slip * cosine_[index(i)];
      r.slip_sin += slip * sine_[index(i)];
    }
    last_[index(i)] = step_;
    owner_[index(i)] = mine;
  }

  /// Ends the step with PE pe. Calls finished(const Rupture &) for each rupture that nothing can be
  /// connected with any more, in order of step_end, step_start, first block.
  template <class Finished>
  void end_step(double pe, Finished &&finished) {
    if (open_.empty()) return;
    finished_.clear();
    std::size_t kept = 0;
    for (const std::int32_t k : open_) {
      Node &node = nodes_[index(k)];
      if (node.parent != k) continue;  // joined with another one
      if (node.rupture.step_end == step_) node.rupture.pe_end = pe;
      if (node.rupture.step_end > step_ - memory_) {
        open_[kept++] = k;
        continue;
      }
      finished_.push_back(node.rupture);
      for (std::int32_t m = k; m != none; m = nodes_[index(m)].next) free_.push_back(m);
    }
    open_.resize(kept);
    if (finished_.empty()) return;
    std::sort(finished_.begin(), finished_.end(), [](const Rupture &a, const Rupture &b) {
      return std::tie(a.step_end, a.step_start, a.first_block) <
             std::tie(b.step_end, b.step_start, b.first_block);
    });
    for (const Rupture &r : finished_) finished(r);
  }

  /// No rupture is open.
  bool idle() const { return open_.empty(); }
  std::int64_t memory() const { return memory_; }

  /// The row of a catalogue, without its number.
  LSM::Event event(const Rupture &r, double dt) const {
    LSM::Event e;
    e.step_start = r.step_start;
    e.step_end = r.step_end;
    e.t_start = dt * static_cast<double>(r.step_start);
    e.t_end = dt * static_cast<double>(r.step_end);
    e.size = r.size;
    e.pe_start = r.pe_start;
    e.pe_end = r.pe_end;
    e.slip_moment = r.slip;
    e.rupture_length = static_cast<double>(r.length);
    if (r.slip_cos != 0.0 || r.slip_sin != 0.0) {
      e.x_centroid = std::atan2(r.slip_sin, r.slip_cos) * (blocks_ / (2.0 * pi));
      if (e.x_centroid < 0.0) e.x_centroid += blocks_;
    }
    return e;
  }

  /// After end_step().
  RuptureState state() const {
    RuptureState s;
    std::vector<std::int64_t> place(nodes_.size(), -1);
    for (const std::int32_t k : open_) {
      place[index(k)] = static_cast<std::int64_t>(s.open.size());
      s.open.push_back(nodes_[index(k)].rupture);
    }
    for (int i = 0; i < blocks_ && !open_.empty(); ++i) {
      if (last_[index(i)] > step_ - memory_)
        s.recent.push_back({i, last_[index(i)], place[index(root(owner_[index(i)]))]});
    }
    return s;
  }

  /// Goes on after the given step. \throws std::invalid_argument if no tracker can be in that
  /// state.
  void set_state(const RuptureState &s, std::int64_t step) {
    step_ = step;
    nodes_.clear();
    open_.clear();
    free_.clear();
    std::fill(last_.begin(), last_.end(), never);
    const std::invalid_argument bad("saved ruptures are inconsistent");
    const auto count = static_cast<std::int64_t>(s.open.size());
    if (count > blocks_) throw bad;
    for (const Rupture &r : s.open) {
      const auto k = static_cast<std::int32_t>(nodes_.size());
      nodes_.push_back({k, none, k, r});
      open_.push_back(k);
    }
    for (const RecentSlip &r : s.recent) {
      if (r.block < 0 || r.block >= blocks_ || r.rupture < 0 || r.rupture >= count || r.step > step)
        throw bad;
      last_[static_cast<std::size_t>(r.block)] = r.step;
      owner_[static_cast<std::size_t>(r.block)] = static_cast<std::int32_t>(r.rupture);
    }
  }

 private:
  static constexpr double pi = 3.14159265358979323846;
  static constexpr std::int32_t none = -1;
  static constexpr std::int64_t never = INT64_MIN / 2;

  // Ruptures joined with another one stay as nodes that lead to it until it ends, as blocks may
  // still name them.
  struct Node {
    std::int32_t parent, next, tail;  // next and tail: chain of all nodes joined with a root
    Rupture rupture;
  };

  template <class Integer>
  static std::size_t index(Integer i) {
    return static_cast<std::size_t>(i);
  }

  std::int32_t root(std::int32_t k) const {
    while (nodes_[index(k)].parent != k) k = nodes_[index(k)].parent;
    return k;
  }

  std::int32_t start(int i) {
    std::int32_t k;
    if (free_.empty()) {
      k = static_cast<std::int32_t>(nodes_.size());
      nodes_.emplace_back();
    } else {
      k = free_.back();
      free_.pop_back();
    }
    Rupture r;
    r.step_start = step_ - 1;
    r.first_block = i;
    r.begin = i;
    r.length = 1;
    r.pe_start = pe_before_;
    nodes_[index(k)] = {k, none, k, r};
    open_.push_back(k);
    return k;
  }

  /// Adds a row of blocks that overlaps with that of r or touches it.
  void extend(Rupture &r, std::int64_t begin, std::int64_t length) const {
    if (r.length == blocks_) return;
    const std::int64_t behind = (begin - r.begin + blocks_) % blocks_;  // from r.begin to begin
    std::int64_t n;
    if (behind <= r.length) {
      n = std::max(r.length, behind + length);
    } else {
      n = std::max(length, blocks_ - behind + r.length);
      r.begin = begin;
    }
    if (n >= blocks_) r.begin = 0;
    r.length = std::min<std::int64_t>(n, blocks_);
  }

  std::int32_t join(std::int32_t a, std::int32_t b) {
    const Rupture &x = nodes_[index(a)].rupture, &y = nodes_[index(b)].rupture;
    if (std::tie(y.step_start, y.first_block) < std::tie(x.step_start, x.first_block))
      std::swap(a, b);
    Node &into = nodes_[index(a)], &gone = nodes_[index(b)];
    Rupture &r = into.rupture;
    const Rupture &g = gone.rupture;
    extend(r, g.begin, g.length);
    r.step_end = std::max(r.step_end, g.step_end);
    r.size += g.size;
    r.slip += g.slip;
    r.slip_cos += g.slip_cos;
    r.slip_sin += g.slip_sin;
    gone.parent = a;
    nodes_[index(into.tail)].next = b;
    into.tail = gone.tail;
    return a;
  }

  int blocks_;
  std::int64_t memory_;
  std::int64_t step_ = 0;
  double pe_before_ = 0.0;
  std::vector<double> cosine_, sine_;
  std::vector<std::int64_t> last_;   // step in which a block slid last
  std::vector<std::int32_t> owner_;  // its rupture then
  std::vector<Node> nodes_;
  std::vector<std::int32_t> open_, free_;
  std::vector<Rupture> finished_;
};

}  // namespace Slider

#endif
