// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_chain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace Slider {

Chain::Chain(const Parameters &p, const std::vector<double> &mu, bool dense, InstructionSet set)
    : p_(p),
      plate_step_(p.velocity * p.dt),
      function_(step_function(p.scheme, p.friction.law, set)),
      view_(view_of(mu)),
      active_(view_, plate_step_, dense),
      account_(p) {
  ChainState s;
  s.u.assign(mu.size(), 0.0);
  s.v = s.u;
  set_state(s);
}

ChainView Chain::view_of(const std::vector<double> &mu) {
  if (mu.size() != static_cast<std::size_t>(p_.blocks))
    throw std::invalid_argument("number of friction coefficients differs from --blocks");
  const std::size_t room = (mu.size() + chunk_size - 1) / chunk_size * chunk_size + 2 * chunk_size;
  for (Array *a : {&u_, &v_, &force_}) a->assign(room, 0.0);
  mu_.assign(room, 1e300);
  std::copy(mu.begin(), mu.end(), mu_.begin() + chunk_size);
  ChainView view;
  view.u = u_.data() + chunk_size;
  view.v = v_.data() + chunk_size;
  view.force = force_.data() + chunk_size;
  view.mu = mu_.data() + chunk_size;
  if (p_.friction.needs_rest()) {
    rest_.assign(room, 0.0);
    view.rest = rest_.data() + chunk_size;
  }
  view.dynamic = p_.friction.dynamic;
  view.dc = p_.friction.dc;
  view.blocks = p_.blocks;
  view.kc = p_.kc;
  view.kl = p_.kl;
  view.mass = p_.mass;
  view.dt = p_.dt;
  return view;
}

void Chain::take_step() {
  const std::vector<std::int32_t> &list = active_.list();
  const double loading = account_.loading(step_);
  StepSums sums;
  if (!list.empty())
    sums = function_(view_, list.data(), static_cast<int>(list.size()),
                     plate_step_ * static_cast<double>(step_ + 1), active_.hot());
  ++step_;
  account_.add(sums, step_, loading);
  moved_ += sums.hot;
}

// The kernel replaces the forces that the work is computed from.
void Chain::keep_slips() {
  du_.resize(v_.size(), 0.0);
  view_.du = du_.data() + chunk_size;
  old_force_.resize(active_.list().size() * chunk_size);
  double *to = old_force_.data();
  for (const std::int32_t c : active_.list()) {
    const double *from = view_.force + static_cast<std::int64_t>(c) * chunk_size;
    to = std::copy(from, from + chunk_size, to);
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
  leap_piece_ = 0;
  leap_pe_ = pe();
  for (int i = 0; i < p_.blocks; ++i) view_.u[i] = creep.displacement(i);
  std::fill(view_.v, view_.v + p_.blocks, 0.0);
  if (view_.rest) std::copy(view_.u, view_.u + p_.blocks, view_.rest);
  account_.leap(creep.pe(), plate_step_ * creep.pe_rate(), view_.u);
  step_ = landing;
  restart();
  return true;
}

double Chain::pe_in_leap(std::int64_t at) {
  const double way = plate_step_ * static_cast<double>(at - leap_from_);
  while (leap_piece_ + 1 < leap_pieces_.size() && leap_pieces_[leap_piece_ + 1].way <= way)
    ++leap_piece_;
  const LeapPiece &piece = leap_pieces_[leap_piece_];
  const double on = way - piece.way;
  return leap_pe_ + piece.pe + on * (piece.pe_rate + 0.5 * piece.pe_slope * on);
}

ChainState Chain::state() const {
  ChainState s;
  account_.save(s);
  s.step = step_;
  s.moved = moved_;
  s.u = displacements();
  s.v = velocities();
  if (view_.rest) s.rest.assign(view_.rest, view_.rest + p_.blocks);
  return s;
}

void Chain::set_state(const ChainState &s) {
  const std::size_t n = static_cast<std::size_t>(p_.blocks);
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

void Chain::set_displacements(const std::vector<double> &u) {
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

// Recomputes forces and the active set from u, v and the step.
void Chain::restart() {
  double *const u = view_.u;
  u[-1] = u[p_.blocks - 1];
  u[p_.blocks] = u[0];
  for (int i = 0; i < p_.blocks; ++i)
    view_.force[i] = p_.kc * ((u[i - 1] - u[i]) + (u[i + 1] - u[i])) + p_.kl * (plate() - u[i]);
  active_.restart(step_);
}

}  // namespace Slider
