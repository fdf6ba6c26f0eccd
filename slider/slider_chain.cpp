// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_chain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace Slider {

Chain::Chain(const Parameters &p, const std::vector<double> &mu, bool dense, InstructionSet set)
    : plate_step_(p.velocity * p.dt),
      function_(step_function(p.scheme, p.friction.law, set)),
      view_(view_of(p, mu)),
      active_(view_, plate_step_, dense),
      account_(p) {
  ChainState s;
  s.u.assign(mu.size(), 0.0);
  s.v = s.u;
  set_state(s);
}

ChainView Chain::view_of(const Parameters &p, const std::vector<double> &mu) {
  if (mu.size() != static_cast<std::size_t>(p.blocks))
    throw std::invalid_argument("number of friction coefficients differs from --blocks");
  const std::size_t room = (mu.size() + chunk_size - 1) / chunk_size * chunk_size + 2 * chunk_size;
  const auto blocks_of = [room](Array &array, double value) {
    array.assign(room, value);
    return array.data() + chunk_size;
  };
  ChainView view{p};
  view.u = blocks_of(u_, 0.0);
  view.v = blocks_of(v_, 0.0);
  view.force = blocks_of(force_, 0.0);
  if (p.friction.needs_rest()) view.rest = blocks_of(rest_, 0.0);
  double *const limits = blocks_of(mu_, 1e300);
  std::copy(mu.begin(), mu.end(), limits);
  view.mu = limits;
  return view;
}

void Chain::take_step() {
  const std::vector<std::int32_t> &list = active_.list();
  StepSums sums;
  if (!list.empty())
    sums = function_(view_, list.data(), static_cast<int>(list.size()),
                     plate_step_ * static_cast<double>(step_ + 1), active_.hot());
  account_.add(sums, ++step_);
  moved_ += sums.hot;
}

void Chain::keep_chunks() {
  kept_.resize(active_.list().size());
  Kept *kept = kept_.data();
  for (const std::int32_t c : active_.list()) {
    std::copy_n(view_.u + c * chunk_size, chunk_size, kept->u);
    std::copy_n(view_.force + c * chunk_size, chunk_size, kept++->force);
  }
}

double Chain::fastest() const {
  double v = 0.0;
  for (const std::int32_t c : active_.list())
    for (int l = 0; l < chunk_size; ++l) v = std::max(v, view_.v[c * chunk_size + l]);
  return v;
}

bool Chain::leap(std::int64_t last, std::int64_t least, double fast, bool falls, bool rises) {
  if (last - step_ < least) return false;
  Creep creep(view_, view_.mu, view_.u, plate(), fast);
  const double most = plate_step_ * static_cast<double>(last - step_);
  const auto allowed = [&] { return creep.now().pe_rate < 0.0 ? falls : rises; };
  if (creep.begins_fast() || !allowed()) return false;
  leap_pieces_.clear();
  for (;;) {
    const Creep::Piece &piece = leap_pieces_.emplace_back(creep.now());
    const double to = std::min(most, creep.next());
    const double turn = piece.way - piece.pe_rate / piece.slope;
    const bool turns = !rises && turn < to;
    if (turns || to == most) {
      creep.to(turns ? turn : most);
      break;
    }
    if (creep.join() || !allowed()) break;
  }
  const double steps = std::ceil(creep.now().way / plate_step_);
  const std::int64_t landing = std::min(last, step_ + static_cast<std::int64_t>(steps));
  if (landing - step_ < least) return false;
  const double way = plate_step_ * static_cast<double>(landing - step_);
  for (; creep.next() < way; creep.join()) leap_pieces_.push_back(creep.now());
  leap_pieces_.push_back(creep.now());
  creep.to(std::max(way, creep.now().way));
  leap_from_ = step_;
  leap_pe_ = pe();
  for (int i = 0; i < view_.blocks; ++i) view_.u[i] = creep.displacement(i);
  std::fill(view_.v, view_.v + view_.blocks, 0.0);
  if (view_.rest) std::copy(view_.u, view_.u + view_.blocks, view_.rest);
  account_.leap(creep.now().pe, plate_step_ * creep.now().pe_rate, view_.u);
  step_ = landing;
  restart();
  return true;
}

double Chain::pe_in_leap(std::int64_t at) const {
  const double way = plate_step_ * static_cast<double>(at - leap_from_);
  const auto later =
      std::upper_bound(leap_pieces_.begin() + 1, leap_pieces_.end(), way,
                       [](double place, const Creep::Piece &piece) { return place < piece.way; });
  const Creep::Piece &piece = *(later - 1);
  return leap_pe_ + piece.pe + piece.change(way - piece.way);
}

ChainState Chain::state() const {
  ChainState s;
  account_.save(s);
  s.step = step_;
  s.moved = moved_;
  s.u = displacements();
  s.v = velocities();
  if (view_.rest) s.rest.assign(view_.rest, view_.rest + view_.blocks);
  return s;
}

void Chain::set_state(const ChainState &s) {
  const std::size_t n = static_cast<std::size_t>(view_.blocks);
  if (s.u.size() != n || s.v.size() != n || (!s.rest.empty() && s.rest.size() != n) || s.step < 0)
    throw std::invalid_argument("saved chain does not fit --blocks");
  account_.restore(s);
  step_ = s.step;
  moved_ = s.moved;
  std::copy(s.u.begin(), s.u.end(), view_.u);
  std::copy(s.v.begin(), s.v.end(), view_.v);
  const std::vector<double> &rest = s.rest.empty() ? s.u : s.rest;
  if (view_.rest) std::copy(rest.begin(), rest.end(), view_.rest);
  restart();
}

// Recomputes forces and the active set from u, v and the step.
void Chain::restart() {
  double *const u = view_.u;
  u[-1] = u[view_.blocks - 1];
  u[view_.blocks] = u[0];
  for (int i = 0; i < view_.blocks; ++i)
    view_.force[i] =
        view_.kc * ((u[i - 1] - u[i]) + (u[i + 1] - u[i])) + view_.kl * (plate() - u[i]);
  active_.restart(step_);
}

}  // namespace Slider
