// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_creep.h
/// Quasi-static creep of the chain: motion under slow loading while no block slips faster than
/// about the plate, solved without time steps (ours). README.md explains why blocks creep.
///
/// In the limit of a slow plate a block at its limit creeps at constant force, so that the blocks
/// at their limit follow the plate linearly: the displacement of block i is r_i times that of the
/// plate, with K r = K_l on the creeping blocks and r = 0 on all others. K is an M-matrix: all r_i
/// are positive and grow with each block that joins, so that no block leaves until something runs
/// away, and the motion consists of linear pieces from one block that joins to the next.
///
/// A group of neighbouring creeping blocks stick-slips about the mean: it oscillates once about the
/// creep, from rest to rest, and friction that falls with velocity makes the oscillation grow.
/// Creep is the mean of these slips. With x the shape of an oscillation and
///   k = x K x - x W x,  d = x G x,  m = M x x,  W = weakening with slip, G = mu_0i (Eq. 6),
/// it grows as exp(a t), a = d / 2 m, and turns after pi / w, w^2 = k / m - a^2, at 1 + e^(pi a /
/// w) times the velocity of creep; if k < m a^2 it does not turn but runs away. It stays below 1 +
/// g times the velocity of creep if k >= q m a^2 for all x, q = 1 + (pi / ln g)^2, that is, if (K -
/// W) / q - s G + s^2 M is positive definite for all s.
#ifndef SLIDER_CREEP_H
#define SLIDER_CREEP_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <vector>

#include "slider_parameters.h"

namespace Slider {

/// Creep from one state, the plate moving forward; all displacements are relative to that state.
class Creep {
 public:
  static constexpr double never = std::numeric_limits<double>::infinity();

  /// \param mu strengths at rest, one per block \param u displacements \param plate its position
  /// \param fast velocity that no block must reach
  Creep(const Parameters &p, const double *mu, const double *u, double plate, double fast)
      : p_(p), mu_(mu), n_(p.blocks), fast_(fast / p.velocity) {
    const std::size_t n = static_cast<std::size_t>(n_);
    blocks_.resize(n);
    stack_.reserve(n);
    double loading = 0.0;
    for (int i = 0; i < n_; ++i) {
      Block &b = at(i);
      b.u = u[i];
      b.force = p.kc * ((u[before(i)] - u[i]) + (u[after(i)] - u[i])) + p.kl * (plate - u[i]);
      b.creeps = b.force >= mu[i];
      creeping_ += b.creeps;
      loading += plate - u[i];
    }
    pe_rate_ = p.kl * loading;
    slope_ = p.kl * n_;
    for (int i = 0; i < n_; ++i) {
      // Runs are found at their first block; a full ring has none.
      if (at(i).creeps && (!at(before(i)).creeps || (creeping_ == n_ && i == 0)))
        begins_fast_ = gets_fast(i, solve(i)) || begins_fast_;
    }
    for (int i = 0; i < n_; ++i)
      if (!at(i).creeps) expect(i);
  }

  int creeping() const { return creeping_; }
  /// Whether blocks that are at their limit from the beginning become fast.
  bool begins_fast() const { return begins_fast_; }
  /// Displacement of the plate at which the next block reaches its limit; never: there is none.
  double next() {
    while (!queue_.empty() && stale(queue_.top())) queue_.pop();
    return queue_.empty() ? never : queue_.top().way;
  }
  /// Advances to next(). Returns whether the group that the block joins becomes fast.
  bool join() {
    next();
    const Coming coming = queue_.top();
    queue_.pop();
    to(coming.way);
    Block &b = at(coming.block);
    settle(b);
    b.creeps = true;
    b.rate = 0.0;
    ++creeping_;
    int first = coming.block;
    while (at(before(first)).creeps && before(first) != coming.block) first = before(first);
    const int length = solve(first);
    if (length < n_) {
      expect(before(first));
      expect(after((first + length - 1) % n_));
    }
    return gets_fast(first, length);
  }

  double way() const { return way_; }
  /// Advances by less than next().
  void to(double way) {
    pe_ += (way - way_) * (pe_rate_ + 0.5 * slope_ * (way - way_));
    pe_rate_ += slope_ * (way - way_);
    way_ = way;
  }
  /// Derivative of PE with respect to the displacement of the plate: now, and its derivative on the
  /// present piece.
  double pe_rate() const { return pe_rate_; }
  double pe_slope() const { return slope_; }
  /// Change of PE since the beginning.
  double pe() const { return pe_; }

  double displacement(int i) {
    settle(at(i));
    return at(i).u;
  }

  /// Whether the group of creeping blocks that begins with first becomes fast.
  bool gets_fast(int first, int length) {
    double rate = 0.0, low = never, high = 0.0;
    for (int k = 0; k < length; ++k) {
      const int i = (first + k) % n_;
      rate = std::max(rate, at(i).rate);
      low = std::min(low, mu_[i]);
      high = std::max(high, mu_[i]);
    }
    // From rest, the oscillation adds to the creep.
    const double growth = fast_ / rate - 1.0;
    if (!(growth > 1.0)) return true;
    const Friction &law = p_.friction;
    switch (law.law) {
      case Law::coulomb:
        return law.dynamic < 1.0;
      case Law::slip_weakening:
        return law.dynamic < 1.0 && !holds(first, length, 0.0, (1.0 - law.dynamic) / law.dc, 1.0);
      case Law::velocity_weakening:
        break;
    }
    const double turn = pi / std::log(growth), softer = 1.0 / (1.0 + turn * turn);
    // The minimum is at s = a, between these.
    constexpr int tries = 9;
    for (int k = 0; k < tries; ++k) {
      const double s = (low + (high - low) * k / (tries - 1)) / (2.0 * p_.mass);
      if (!holds(first, length, s, s, softer)) return true;
    }
    return false;
  }

 private:
  static constexpr double pi = 3.14159265358979323846;

  struct Block {
    double u = 0.0, force = 0.0;  ///< at the way
    double way = 0.0;
    double rate = 0.0;  ///< of u if it creeps, else of force
    std::uint32_t version = 0;
    bool creeps = false;
  };
  struct Coming {
    double way;
    int block;
    std::uint32_t version;
    bool operator>(const Coming &o) const { return way != o.way ? way > o.way : block > o.block; }
  };

  Block &at(int i) { return blocks_[static_cast<std::size_t>(i)]; }
  int before(int i) const { return i > 0 ? i - 1 : n_ - 1; }
  int after(int i) const { return i + 1 < n_ ? i + 1 : 0; }
  bool stale(const Coming &c) { return at(c.block).creeps || at(c.block).version != c.version; }

  void settle(Block &b) {
    (b.creeps ? b.u : b.force) += b.rate * (way_ - b.way);
    b.way = way_;
  }

  /// New rates of the group of creeping blocks that begins with first; returns its length.
  int solve(int first) {
    stack_.clear();
    const double diagonal = 2.0 * p_.kc + p_.kl;
    double pivot = diagonal, value = p_.kl;
    int i = first;
    do {
      if (!stack_.empty()) {
        const double factor = p_.kc / pivot;
        pivot = diagonal - factor * p_.kc;
        value = p_.kl + factor * value;
      }
      stack_.push_back({pivot, value});
      i = after(i);
    } while (i != first && at(i).creeps);
    const int length = static_cast<int>(stack_.size());
    double rate = 0.0;
    for (int k = length - 1; k >= 0; --k) {
      const Row &row = stack_[static_cast<std::size_t>(k)];
      // The whole ring moves as one.
      rate = length == n_ ? 1.0 : (row.value + p_.kc * rate) / row.pivot;
      Block &b = at((first + k) % n_);
      settle(b);
      // dPE = K_l sum (X - U_i) dX - sum F_i dU_i
      pe_rate_ -= b.force * (rate - b.rate);
      slope_ -= p_.kl * (rate - b.rate);
      b.rate = rate;
    }
    return length;
  }

  /// When a block at rest reaches its limit.
  void expect(int i) {
    Block &b = at(i);
    settle(b);
    const Block &left = at(before(i)), &right = at(after(i));
    b.rate = p_.kl + p_.kc * ((left.creeps ? left.rate : 0.0) + (right.creeps ? right.rate : 0.0));
    ++b.version;
    queue_.push({way_ + std::max(0.0, (mu_[i] - b.force) / b.rate), i, b.version});
  }

  /// Whether M s^2 + K softer - w mu is positive definite on a group: all pivots are positive.
  bool holds(int first, int length, double s, double w, double softer) const {
    const double inertia = p_.mass * s * s, kc = softer * p_.kc, kl = softer * p_.kl;
    if (length == n_) {
      // A ring: it suffices that this holds for the leaf springs alone.
      for (int i = 0; i < n_; ++i)
        if (!(kl + inertia - w * mu_[i] > 0.0)) return false;
      return true;
    }
    double pivot = never;
    for (int k = 0; k < length; ++k) {
      pivot = 2.0 * kc + kl + inertia - w * mu_[(first + k) % n_] - kc * kc / pivot;
      if (!(pivot > 0.0)) return false;
    }
    return true;
  }

  struct Row {
    double pivot, value;
  };

  const Parameters &p_;
  const double *mu_;
  int n_;
  double fast_;  // over the velocity of the plate
  std::vector<Block> blocks_;
  std::vector<Row> stack_;
  std::priority_queue<Coming, std::vector<Coming>, std::greater<Coming>> queue_;
  int creeping_ = 0;
  bool begins_fast_ = false;
  double way_ = 0.0, pe_ = 0.0, pe_rate_ = 0.0, slope_ = 0.0;
};

}  // namespace Slider

#endif
