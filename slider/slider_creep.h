// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_creep.h
/// Quasi-static creep of the chain: motion under slow loading while no block slips faster than
/// about the plate, solved without time steps †. README.md explains why blocks creep.
///
/// In the limit of a slow plate a block at its limit creeps at constant force, so that the blocks
/// at their limit follow the plate linearly: the displacement of block i is r_i times that of the
/// plate, with K r = K_l on the creeping blocks and r = 0 on all others. K is an M-matrix: all r_i
/// are positive and grow with each block that begins to creep, so that none stops until some block
/// runs away, and the motion is piecewise linear, with a new piece whenever a block begins to
/// creep.
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
#include <limits>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "slider_parameters.h"

namespace Slider {

/// Creep from a given state as the plate moves forward. Displacements of blocks and plate (`way`)
/// are relative to that state.
class Creep {
 public:
  static constexpr double never = std::numeric_limits<double>::infinity();

  /// A linear piece of the motion, which begins when the plate has moved by `way`.
  struct Piece {
    double way = 0.0;
    double pe = 0.0;                    ///< change of PE since the beginning
    double pe_rate = 0.0, slope = 0.0;  ///< first and second derivative of PE by that of the plate

    /// Change of PE while the plate moves on by a displacement within the piece.
    double change(double on) const { return on * (pe_rate + 0.5 * slope * on); }
  };

  /// \param mu strengths at rest, one per block
  /// \param u displacements
  /// \param plate its position
  /// \param fast velocity that no block must reach
  Creep(const Parameters &p, const double *mu, const double *u, double plate, double fast)
      : p_(p), mu_(mu), n_(p.blocks), fast_(fast / p.velocity) {
    blocks_.resize(static_cast<std::size_t>(n_));
    rows_.reserve(blocks_.size());
    double loading = 0.0;
    for (int i = 0; i < n_; ++i) {
      Block &b = at(i);
      b.u = u[i];
      b.force = p.kc * ((u[before(i)] - u[i]) + (u[after(i)] - u[i])) + p.kl * (plate - u[i]);
      b.creeps = b.force >= mu[i];
      creeping_ += b.creeps;
      loading += plate - u[i];
    }
    now_.pe_rate = p.kl * loading;
    now_.slope = p.kl * n_;
    for (int i = 0; i < n_; ++i) {
      // Each group is handled once, at its first block, or at block 0 if all blocks of the ring
      // creep.
      if (at(i).creeps && (!at(before(i)).creeps || (creeping_ == n_ && i == 0)))
        begins_fast_ = gets_fast(i, solve(i)) || begins_fast_;
    }
    for (int i = 0; i < n_; ++i)
      if (!at(i).creeps) expect(i);
  }

  int creeping() const { return creeping_; }
  /// Whether blocks that are at their limit from the beginning become fast.
  bool begins_fast() const { return begins_fast_; }
  const Piece &now() const { return now_; }
  /// Displacement of the plate at which the next block reaches its limit, or `never`.
  double next() const { return due_.empty() ? never : due_.begin()->first; }
  /// Advances to next(), where a block joins a group.
  /// \return whether this group becomes fast
  bool join() {
    const auto [way, joining] = *due_.begin();
    due_.erase(due_.begin());
    to(way);
    Block &b = at(joining);
    settle(b);
    b.creeps = true;
    b.rate = 0.0;
    ++creeping_;
    int first = joining;
    while (at(before(first)).creeps && before(first) != joining) first = before(first);
    const int length = solve(first);
    if (length < n_) {
      expect(before(first));
      expect(after((first + length - 1) % n_));
    }
    return gets_fast(first, length);
  }
  /// Advances to a displacement of the plate below next().
  void to(double way) {
    const double on = way - now_.way;
    now_.pe += now_.change(on);
    now_.pe_rate += now_.slope * on;
    now_.way = way;
  }
  double displacement(int i) {
    settle(at(i));
    return at(i).u;
  }

 private:
  struct Block {
    double u = 0.0, force = 0.0;  ///< when the plate had moved by `way`
    double way = 0.0;
    double rate = 0.0;   ///< derivative by `way`: of u if it creeps, else of the force
    double due = never;  ///< displacement of the plate at which it reaches its limit
    bool creeps = false;
  };

  Block &at(int i) { return blocks_[static_cast<std::size_t>(i)]; }
  int before(int i) const { return i > 0 ? i - 1 : n_ - 1; }
  int after(int i) const { return i + 1 < n_ ? i + 1 : 0; }

  void settle(Block &b) {
    (b.creeps ? b.u : b.force) += b.rate * (now_.way - b.way);
    b.way = now_.way;
  }

  /// Computes the rates of the group of creeping blocks that begins with `first`.
  /// \return length of the group
  int solve(int first) {
    rows_.clear();
    const double diagonal = 2.0 * p_.kc + p_.kl;
    double pivot = diagonal, value = p_.kl;
    int i = first;
    do {
      if (!rows_.empty()) {
        const double factor = p_.kc / pivot;
        pivot = diagonal - factor * p_.kc;
        value = p_.kl + factor * value;
      }
      rows_.emplace_back(pivot, value);
      i = after(i);
    } while (i != first && at(i).creeps);
    const int length = static_cast<int>(rows_.size());
    double rate = 0.0;
    for (int k = length - 1; k >= 0; --k) {
      std::tie(pivot, value) = rows_[static_cast<std::size_t>(k)];
      // If all blocks creep, they move with the plate.
      rate = length == n_ ? 1.0 : (value + p_.kc * rate) / pivot;
      Block &b = at((first + k) % n_);
      settle(b);
      // dPE = K_l sum (X - U_i) dX - sum F_i dU_i
      now_.pe_rate -= b.force * (rate - b.rate);
      now_.slope -= p_.kl * (rate - b.rate);
      b.rate = rate;
    }
    return length;
  }

  /// Computes when a block at rest will reach its limit.
  void expect(int i) {
    Block &b = at(i);
    settle(b);
    const Block &left = at(before(i)), &right = at(after(i));
    b.rate = p_.kl + p_.kc * ((left.creeps ? left.rate : 0.0) + (right.creeps ? right.rate : 0.0));
    due_.erase({b.due, i});
    b.due = now_.way + std::max(0.0, (mu_[i] - b.force) / b.rate);
    due_.emplace(b.due, i);
  }

  /// Whether the group of creeping blocks that begins with `first` becomes fast.
  bool gets_fast(int first, int length) {
    double rate = 0.0, low = never, high = 0.0;
    for (int k = 0; k < length; ++k) {
      const int i = (first + k) % n_;
      rate = std::max(rate, at(i).rate);
      low = std::min(low, mu_[i]);
      high = std::max(high, mu_[i]);
    }
    // As blocks start from rest, the velocity of the oscillation adds to that of creep.
    const double growth = fast_ / rate - 1.0;
    if (!(growth > 1.0)) return true;
    const Friction &law = p_.friction;
    if (law.law == Law::coulomb) return law.dynamic < 1.0;
    const double turn = LSM::pi / std::log(growth), softer = 1.0 / (1.0 + turn * turn);
    // The minimum is at s = a, which lies between those of the weakest and the strongest block.
    constexpr int tries = 9;
    for (int k = 0; k < tries; ++k) {
      const double s = (low + (high - low) * k / (tries - 1)) / (2.0 * p_.mass);
      if (!holds(first, length, s, softer)) return true;
    }
    return false;
  }

  /// Whether M s^2 + K softer - s mu is positive definite on a group, that is, has positive pivots.
  bool holds(int first, int length, double s, double softer) const {
    const double inertia = p_.mass * s * s, kc = softer * p_.kc, kl = softer * p_.kl;
    if (length == n_) {
      // On a ring it suffices that this holds for the leaf springs alone.
      for (int i = 0; i < n_; ++i)
        if (!(kl + inertia - s * mu_[i] > 0.0)) return false;
      return true;
    }
    double pivot = never;
    for (int k = 0; k < length; ++k) {
      pivot = 2.0 * kc + kl + inertia - s * mu_[(first + k) % n_] - kc * kc / pivot;
      if (!(pivot > 0.0)) return false;
    }
    return true;
  }

  const Parameters &p_;
  const double *mu_;
  int n_;
  double fast_;  // in units of the velocity of the plate
  std::vector<Block> blocks_;
  std::vector<std::pair<double, double>>
      rows_;                              // of the system that solve() eliminates: pivot, value
  std::set<std::pair<double, int>> due_;  // Block::due and number of each block at rest
  int creeping_ = 0;
  bool begins_fast_ = false;
  Piece now_;
};

}  // namespace Slider

#endif
