// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_chain.h
/// The chain of blocks, stepped chunk by chunk: all chunks
/// (the dense oracle) or only those where something moves or may start to (the active set).
///
/// Both give the same numbers to the last digit: a chunk left out would have added zeros to sums
/// kept in fixed lanes.
///
/// The potential energy of all springs,
///   PE = sum_i K_c/2 (U_{i+1} - U_i)^2 + K_l/2 (X - U_i)^2,
/// is quadratic, so its change over a step is exactly minus the work of the mean spring force on
/// the blocks plus that of the mean plate force on the plate; only moving blocks enter (ours).
#ifndef SLIDER_CHAIN_H
#define SLIDER_CHAIN_H

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <new>
#include <queue>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "lsm_sum.h"
#include "slider_creep.h"
#include "slider_kernels.h"
#include "slider_parameters.h"

namespace Slider {

/// What is needed to go on from a step, besides the parameters.
struct ChainState {
  std::int64_t step = 0;
  double slip_sum = 0.0, slip_compensation = 0.0;  ///< sum of all U_i
  double pe_sum = 0.0, pe_compensation = 0.0;
  std::int64_t quiet_since = -1;                 ///< step since which no block moved; -1: one does
  double pe_anchor = 0.0, loading_anchor = 0.0;  ///< PE and sum (X - U_i) at quiet_since
  std::int64_t moved = 0;                        ///< block-steps with motion so far
  double dpe = 0.0;                              ///< change of PE over the last step
  std::vector<double> u, v;
  /// where blocks last rested, if the law needs it; empty: where they are
  std::vector<double> rest;
};

/// PE of all springs, summed directly; used to set and to check the work formula.
inline double direct_energy(const Parameters &p, const std::vector<double> &u, double plate) {
  LSM::NeumaierSum sum;
  for (int i = 0; i < p.blocks; ++i) {
    const double stretch =
        u[static_cast<std::size_t>(i + 1 < p.blocks ? i + 1 : 0)] - u[static_cast<std::size_t>(i)];
    const double leaf = plate - u[static_cast<std::size_t>(i)];
    sum.add(0.5 * p.kc * stretch * stretch + 0.5 * p.kl * leaf * leaf);
  }
  return sum.value();
}

/// Memory on cache lines, so that a chunk never lies across two. Long arrays ask for huge pages: of
/// a long chain every active chunk lies on ordinary pages of its own, one for each array, more than
/// the processor remembers.
template <class T>
struct LineAllocator {
  using value_type = T;
  LineAllocator() = default;
  template <class U>
  LineAllocator(const LineAllocator<U> &) {}
  static constexpr std::size_t line = 64, huge_page = std::size_t(1) << 21;
  static std::align_val_t alignment(std::size_t n) {
    return std::align_val_t(n * sizeof(T) < 2 * huge_page ? line : huge_page);
  }
  T *allocate(std::size_t n) {
    void *const p = ::operator new(n * sizeof(T), alignment(n));
#ifdef MADV_HUGEPAGE
    if (alignment(n) == std::align_val_t(huge_page)) madvise(p, n * sizeof(T), MADV_HUGEPAGE);
#endif
    return static_cast<T *>(p);
  }
  void deallocate(T *p, std::size_t n) { ::operator delete(p, alignment(n)); }
  bool operator==(const LineAllocator &) const { return true; }
  bool operator!=(const LineAllocator &) const { return false; }
};

class Chain {
 public:
  /// \param dense step all chunks, always
  Chain(const Parameters &p, const std::vector<double> &mu, bool dense, InstructionSet set)
      : p_(p), dense_(dense), plate_step_(p.velocity * p.dt) {
    if (mu.size() != static_cast<std::size_t>(p.blocks))
      throw std::invalid_argument("number of friction coefficients differs from --blocks");
    function_ = step_function(p.scheme, p.friction.law, set);
    chunks_ = (p.blocks + chunk_size - 1) / chunk_size;
    const std::size_t room = static_cast<std::size_t>(chunks_ + 2) * chunk_size;
    for (auto *a : {&u_, &v_, &force_}) a->assign(room, 0.0);
    mu_.assign(room, 1e300);
    std::copy(mu.begin(), mu.end(), mu_.begin() + chunk_size);
    view_.u = u_.data() + chunk_size;
    view_.v = v_.data() + chunk_size;
    view_.force = force_.data() + chunk_size;
    view_.mu = mu_.data() + chunk_size;
    if (p.friction.needs_rest()) {
      rest_.assign(room, 0.0);
      view_.rest = rest_.data() + chunk_size;
    }
    view_.dynamic = p.friction.dynamic;
    view_.dc = p.friction.dc;
    view_.blocks = p.blocks;
    view_.kc = p.kc;
    view_.kl = p.kl;
    view_.mass = p.mass;
    view_.dt = p.dt;
    const std::size_t n = static_cast<std::size_t>(chunks_);
    hot_.assign(n, 0);
    wake_.assign(n, 0);
    list_.reserve(n);
    next_list_.reserve(3 * n + 1);
    last_edge_ = static_cast<std::uint8_t>(1U << ((p.blocks - 1) % chunk_size));
    start();
  }
  Chain(const Chain &) = delete;
  Chain &operator=(const Chain &) = delete;

  std::int64_t step() const { return step_; }
  double time() const { return static_cast<double>(step_) * p_.dt; }
  double plate() const { return plate_step_ * static_cast<double>(step_); }
  double pe() const { return pe_value_; }
  double dpe() const { return dpe_; }                ///< change of PE over the last step
  double slip_sum() const { return slip_.value(); }  ///< sum of all displacements
  std::int64_t moved() const { return moved_; }
  int active_chunks() const { return static_cast<int>(list_.size()); }

  /// Displacements and velocities, one per block.
  std::vector<double> displacements() const { return {view_.u, view_.u + p_.blocks}; }
  std::vector<double> velocities() const { return {view_.v, view_.v + p_.blocks}; }

  /// One time step.
  void advance() { advance(Unwatched()); }

  /// One time step, the same to the last digit; watch learns which blocks slid in it, in ascending
  /// order, and the work of the springs on each of them, (F_old + F_new) du / 2 (see
  /// RuptureTracker).
  template <class Watch>
  void advance(Watch &&watch) {
    constexpr bool watches = std::decay_t<Watch>::watches;
    const double loading_old = loading();
    [[maybe_unused]] const double pe_old = pe_value_;
    if (!list_.empty()) {
      if constexpr (watches) {
        du_.resize(v_.size(), 0.0);
        keep_forces();
      }
      view_.du = watches ? du_.data() + chunk_size : nullptr;
      sums_ = function_(view_, list_.data(), static_cast<int>(list_.size()),
                        plate_step_ * static_cast<double>(step_ + 1), hot_.data());
    } else {
      sums_ = StepSums();
    }
    ++step_;
    if (sums_.slip == 0.0 && sums_.work == 0.0) {
      quiet_step(loading_old);
    } else {
      if (quiet_since_ >= 0) {
        pe_ = LSM::NeumaierSum(pe_value_);
        quiet_since_ = -1;
      }
      slip_.add(sums_.slip);
      dpe_ = 0.5 * p_.kl * plate_step_ * (loading_old + loading()) - sums_.work;
      pe_.add(dpe_);
      pe_value_ = pe_.value();
    }
    moved_ += sums_.hot;
    if constexpr (watches) {
      watch.begin_step(step_, pe_old);
      if (quiet_since_ < 0) tell(watch);
    }
    if (!dense_) update_list();
  }

  /// Up to which step nothing can move; step() itself if something does or may.
  std::int64_t quiet_until() {
    if (dense_ || !list_.empty() || quiet_since_ < 0) return step_;
    drop_stale();
    return queue_.empty() ? std::numeric_limits<std::int64_t>::max() : queue_.top().first - 1;
  }

  /// Change of PE per step over a quiet step that starts at the given step.
  double quiet_change(std::int64_t at) const {
    const double loading_at = loading(at);
    return p_.kl * plate_step_ * (loading_at + 0.5 * blocks() * plate_step_);
  }

  /// Goes to a step no later than quiet_until() without looking at those between.
  void jump(std::int64_t to) {
    step_ = to - 1;
    advance();
  }

  /// Velocity of the fastest block.
  double fastest() const {
    double v = 0.0;
    for (const std::int32_t c : list_)
      for (int l = 0; l < chunk_size; ++l) v = std::max(v, view_.v[c * chunk_size + l]);
    return v;
  }

  /// Creeps on without steps (see Creep), all blocks at rest at its end: to the step at which
  /// blocks are about to get fast, or PE begins or ceases to fall, or to last. \param least steps
  /// that are worth it \param falls,rises whether PE may fall, or rise, in it \return false, and
  /// nothing done, if they are not
  bool leap(std::int64_t last, std::int64_t least, double fast, bool falls, bool rises) {
    if (last - step_ < least) return false;
    Creep creep(p_, view_.mu, view_.u, plate(), fast);
    const double most = plate_step_ * static_cast<double>(last - step_);
    leap_from_ = step_;
    leap_pieces_.clear();
    const auto allowed = [&] { return creep.pe_rate() < 0.0 ? falls : rises; };
    if (creep.begins_fast() || !allowed()) return false;
    for (;;) {
      note_piece(creep);
      const double to = std::min(most, creep.next());
      const double turn = creep.way() - creep.pe_rate() / creep.pe_slope();
      if (!rises && turn < to) {
        creep.to(turn);
        break;
      }
      if (to == most) {
        creep.to(most);
        break;
      }
      if (creep.join() || !allowed()) break;
    }
    const double steps = std::ceil(creep.way() / plate_step_);
    const std::int64_t landing = std::min(last, step_ + static_cast<std::int64_t>(steps));
    if (landing - step_ < least) return false;
    const double way = plate_step_ * static_cast<double>(landing - step_);
    while (creep.next() < way) {
      note_piece(creep);
      creep.join();
    }
    note_piece(creep);
    creep.to(std::max(way, creep.way()));
    land(creep, landing);
    return true;
  }
  /// PE at a step within the last leap; steps must ascend.
  double pe_in_leap(std::int64_t at) {
    const double way = plate_step_ * static_cast<double>(at - leap_from_);
    while (leap_piece_ + 1 < leap_pieces_.size() && leap_pieces_[leap_piece_ + 1].way <= way)
      ++leap_piece_;
    const LeapPiece &piece = leap_pieces_[leap_piece_];
    const double on = way - piece.way;
    return leap_pe_ + piece.pe + on * (piece.pe_rate + 0.5 * piece.pe_slope * on);
  }

  ChainState state() const {
    ChainState s;
    s.step = step_;
    s.slip_sum = slip_.sum();
    s.slip_compensation = slip_.compensation();
    s.pe_sum = pe_.sum();
    s.pe_compensation = pe_.compensation();
    s.quiet_since = quiet_since_;
    s.pe_anchor = pe_anchor_;
    s.loading_anchor = loading_anchor_;
    s.moved = moved_;
    s.dpe = dpe_;
    s.u = displacements();
    s.v = velocities();
    if (view_.rest) s.rest.assign(view_.rest, view_.rest + p_.blocks);
    return s;
  }

  /// Goes on from a saved state.
  void set_state(const ChainState &s) {
    const std::size_t n = static_cast<std::size_t>(p_.blocks);
    if (s.u.size() != n || s.v.size() != n || (!s.rest.empty() && s.rest.size() != n) || s.step < 0)
      throw std::invalid_argument("saved chain does not fit --blocks");
    step_ = s.step;
    slip_ = LSM::NeumaierSum(s.slip_sum, s.slip_compensation);
    pe_ = LSM::NeumaierSum(s.pe_sum, s.pe_compensation);
    quiet_since_ = s.quiet_since;
    pe_anchor_ = s.pe_anchor;
    loading_anchor_ = s.loading_anchor;
    moved_ = s.moved;
    dpe_ = s.dpe;
    std::copy(s.u.begin(), s.u.end(), view_.u);
    std::copy(s.v.begin(), s.v.end(), view_.v);
    if (view_.rest) {
      const auto &rest = s.rest.empty() ? s.u : s.rest;
      std::copy(rest.begin(), rest.end(), view_.rest);
    }
    if (quiet_since_ >= 0)
      pe_value_ = quiet_energy();
    else
      pe_value_ = pe_.value();
    activate();
  }

  /// Starts from given displacements (one per block) at rest, at step 0 (ours; the paper has 0).
  void set_displacements(const std::vector<double> &u) {
    ChainState s;
    s.u = u;
    s.v.assign(static_cast<std::size_t>(p_.blocks), 0.0);
    LSM::NeumaierSum sum;
    for (double x : u) sum.add(x);
    s.slip_sum = sum.sum();
    s.slip_compensation = sum.compensation();
    s.pe_sum = direct_energy(p_, u, 0.0);
    set_state(s);
  }

 private:
  struct Unwatched {
    static constexpr bool watches = false;
  };

  // A straight piece of a leap.
  struct LeapPiece {
    double way, pe, pe_rate, pe_slope;
  };
  void note_piece(const Creep &creep) {
    leap_pieces_.push_back({creep.way(), creep.pe(), creep.pe_rate(), creep.pe_slope()});
  }

  void land(Creep &creep, std::int64_t landing) {
    leap_piece_ = 0;
    leap_pe_ = pe_value_;
    pe_ = LSM::NeumaierSum(pe_value_);
    pe_.add(creep.pe());
    pe_value_ = pe_.value();
    dpe_ = plate_step_ * creep.pe_rate();
    slip_ = LSM::NeumaierSum();
    for (int i = 0; i < p_.blocks; ++i) {
      view_.u[i] = creep.displacement(i);
      slip_.add(view_.u[i]);
    }
    std::fill(view_.v, view_.v + p_.blocks, 0.0);
    if (view_.rest) std::copy(view_.u, view_.u + p_.blocks, view_.rest);
    quiet_since_ = -1;
    step_ = landing;
    activate();
  }

  // The kernel replaces the forces that the work is reckoned with.
  void keep_forces() {
    old_force_.resize(list_.size() * chunk_size);
    double *to = old_force_.data();
    for (const std::int32_t c : list_) {
      const double *from = view_.force + static_cast<std::int64_t>(c) * chunk_size;
      to = std::copy(from, from + chunk_size, to);
    }
  }

  template <class Watch>
  void tell(Watch &watch) const {
    const double *old = old_force_.data();
    for (const std::int32_t c : list_) {
      const int first = c * chunk_size;
      for (int l = 0; l < chunk_size; ++l, ++old) {
        const double slip = view_.du[first + l];
        if (slip != 0.0) watch.slide(first + l, 0.5 * (*old + view_.force[first + l]) * slip, slip);
      }
    }
  }

  double blocks() const { return static_cast<double>(p_.blocks); }
  double loading(std::int64_t at) const {
    return blocks() * (plate_step_ * static_cast<double>(at)) - slip_.value();
  }
  /// sum (X - U_i)
  double loading() const { return loading(step_); }

  // In quiet stretches PE follows from their first step, not from the step before, so that it does
  // not matter which steps are looked at.
  double quiet_energy() const {
    const double travel = plate_step_ * static_cast<double>(step_ - quiet_since_);
    return pe_anchor_ + p_.kl * travel * (loading_anchor_ + 0.5 * blocks() * travel);
  }
  void quiet_step(double loading_old) {
    if (quiet_since_ < 0) {
      quiet_since_ = step_ - 1;
      pe_anchor_ = pe_value_;
      loading_anchor_ = loading_old;
    }
    dpe_ = p_.kl * plate_step_ * (loading_old + 0.5 * blocks() * plate_step_);
    pe_value_ = quiet_energy();
  }

  void start() {
    ChainState s;
    s.u.assign(static_cast<std::size_t>(p_.blocks), 0.0);
    s.v = s.u;
    set_state(s);
  }

  double spring_force(int i, double plate_at) const {
    const double *u = view_.u;
    return p_.kc * ((u[i - 1] - u[i]) + (u[i + 1] - u[i])) + p_.kl * (plate_at - u[i]);
  }

  // Last step, counted from step 0, after which chunk c need not stay idle: no later than two steps
  // before its first block can start, rounding included. The plate only adds to the forces.
  std::int64_t wake_step(int c) const {
    double first = std::numeric_limits<double>::max(), scale = 0.0;
    for (int i = c * chunk_size; i < (c + 1) * chunk_size && i < p_.blocks; ++i) {
      const double *u = view_.u;
      const double coupling = p_.kc * ((u[i - 1] - u[i]) + (u[i + 1] - u[i]));
      const double plate_at = u[i] + (view_.mu[i] - coupling) / p_.kl;
      first = std::min(first, plate_at);
      scale = std::max({scale, std::fabs(plate_at),
                        std::fabs(u[i]) * (1.0 + p_.kc / p_.kl) + view_.mu[i] / p_.kl});
    }
    const double steps =
        (first - 64.0 * std::numeric_limits<double>::epsilon() * scale) / plate_step_;
    if (!(steps < 4e18)) return std::numeric_limits<std::int64_t>::max();
    return static_cast<std::int64_t>(std::floor(steps * (1.0 - 1e-15))) - 2;
  }

  // Sets forces and the active set afresh from u, v and the step.
  void activate() {
    view_.u[-1] = view_.u[p_.blocks - 1];
    view_.u[p_.blocks] = view_.u[0];
    list_.clear();
    queue_ = Queue();
    std::fill(wake_.begin(), wake_.end(), 0);
    for (int i = 0; i < p_.blocks; ++i) view_.force[i] = spring_force(i, plate());
    std::vector<std::int32_t> wanted;
    for (int c = 0; c < chunks_; ++c) {
      bool hot = dense_;
      for (int i = c * chunk_size; i < (c + 1) * chunk_size && i < p_.blocks; ++i)
        hot = hot || view_.v[i] > 0.0 || view_.force[i] > view_.mu[i];
      if (dense_) {
        list_.push_back(c);
      } else if (hot) {
        for (int d : {c > 0 ? c - 1 : chunks_ - 1, c, c + 1 < chunks_ ? c + 1 : 0})
          wanted.push_back(d);
      }
    }
    if (dense_) return;
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    list_ = wanted;
    list_.reserve(static_cast<std::size_t>(chunks_));
    for (int c = 0, k = 0; c < chunks_; ++c) {
      if (k < static_cast<int>(list_.size()) && list_[static_cast<std::size_t>(k)] == c)
        ++k;
      else
        idle_.push_back(c);
    }
    settle_idle(list_);
  }

  // A chunk is active while a block in it moves or is about to, or the nearest block of a
  // neighbouring chunk is so, or it has to be watched because its first block will soon start.
  void update_list() {
    // Without branches on the lanes, which would be mispredicted half of the time.
    auto &next = next_list_;
    next.resize(3 * list_.size() + 1);
    std::size_t n = 0;
    std::int32_t back = -1;
    const auto want = [&](std::int32_t c, bool wanted) {
      next[n] = c;
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
    next.resize(n);
    if (!list_.empty()) {
      const std::int32_t last = chunks_ - 1;
      const bool want_last = list_.front() == 0 && hot_[0] & 1U;
      const bool want_first = list_.back() == last && hot_[list_.size() - 1] & last_edge_;
      if (want_last && (next.empty() || next.back() != last)) next.push_back(last);
      if (want_first && (next.empty() || next.front() != 0)) next.insert(next.begin(), 0);
    }
    if (next != list_) change_list_to_next();
    if (step_ + 1 >= next_wake_) wake_due();
  }

  void change_list_to_next() {
    idle_.clear();
    std::size_t k = 0;
    for (const std::int32_t c : next_list_) {
      while (k < list_.size() && list_[k] < c) idle_.push_back(list_[k++]);
      if (k < list_.size() && list_[k] == c)
        ++k;
      else
        wake_[static_cast<std::size_t>(c)] = 0;
    }
    idle_.insert(idle_.end(), list_.begin() + static_cast<std::ptrdiff_t>(k), list_.end());
    settle_idle(next_list_);
    list_.swap(next_list_);
  }

  // Puts the chunks in idle_ to sleep until their wake step, or back into the list if that is now.
  void settle_idle(std::vector<std::int32_t> &list) {
    for (std::int32_t c : idle_) {
      const std::int64_t at = wake_step(c);
      if (at <= step_ + 1) {
        wake_[static_cast<std::size_t>(c)] = 0;
        extra_.push_back(c);
      } else {
        wake_[static_cast<std::size_t>(c)] = at;
        if (at < std::numeric_limits<std::int64_t>::max()) queue_.emplace(at, c);
      }
    }
    idle_.clear();
    add_extra(list);
    next_wake_ = queue_.empty() ? std::numeric_limits<std::int64_t>::max() : queue_.top().first;
    if (queue_.size() > 64 + 8 * static_cast<std::size_t>(chunks_)) rebuild_queue();
  }

  // All at once: inserting one by one would cost the length of the list each time.
  void add_extra(std::vector<std::int32_t> &list) {
    if (extra_.empty()) return;
    std::sort(extra_.begin(), extra_.end());
    const auto middle = static_cast<std::ptrdiff_t>(list.size());
    list.insert(list.end(), extra_.begin(), extra_.end());
    std::inplace_merge(list.begin(), list.begin() + middle, list.end());
    extra_.clear();
  }

  void drop_stale() {
    while (!queue_.empty() &&
           wake_[static_cast<std::size_t>(queue_.top().second)] != queue_.top().first)
      queue_.pop();
    next_wake_ = queue_.empty() ? std::numeric_limits<std::int64_t>::max() : queue_.top().first;
  }

  void rebuild_queue() {
    queue_ = Queue();
    for (std::int32_t c = 0; c < chunks_; ++c) {
      const std::int64_t at = wake_[static_cast<std::size_t>(c)];
      if (at > 0 && at < std::numeric_limits<std::int64_t>::max()) queue_.emplace(at, c);
    }
  }

  void wake_due() {
    drop_stale();
    while (!queue_.empty() && queue_.top().first <= step_ + 1) {
      const std::int32_t c = queue_.top().second;
      queue_.pop();
      wake_[static_cast<std::size_t>(c)] = 0;
      extra_.push_back(c);
      drop_stale();
    }
    add_extra(list_);
  }

  using Entry = std::pair<std::int64_t, std::int32_t>;
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>>;

  Parameters p_;
  bool dense_;
  double plate_step_;
  StepFunction function_ = nullptr;
  int chunks_ = 0;
  std::uint8_t last_edge_ = 0;
  std::vector<double, LineAllocator<double>> u_, v_, force_, du_, mu_, rest_;
  std::vector<double> old_force_;  // of the listed chunks, if someone watches
  ChainView view_;
  std::int64_t step_ = 0;
  LSM::NeumaierSum slip_, pe_;
  double pe_value_ = 0.0, dpe_ = 0.0;
  std::int64_t quiet_since_ = -1;
  double pe_anchor_ = 0.0, loading_anchor_ = 0.0;
  std::int64_t moved_ = 0;
  std::vector<LeapPiece> leap_pieces_;  // of the last leap
  std::size_t leap_piece_ = 0;
  std::int64_t leap_from_ = 0;
  double leap_pe_ = 0.0;
  StepSums sums_;
  std::vector<std::uint8_t> hot_;
  std::vector<std::int32_t> list_, next_list_, idle_, extra_;
  std::vector<std::int64_t> wake_;  // 0: in the list; else the step to wake up
  Queue queue_;
  std::int64_t next_wake_ = 0;
};

}  // namespace Slider

#endif
