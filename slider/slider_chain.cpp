// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "numerics/random.h"

namespace Slider {

Chain::Chain(const Parameters &p, const std::vector<double> &mu, bool dense, InstructionSet set)
    : plate_step_(p.velocity * p.dt),
      function_(step_function(p, set)),
      forces_(mode_forces(p)),
      first_mu_(mu),
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
  const std::size_t room = whole_chunks(mu.size()) + 2 * chunk_size;
  const auto blocks_of = [room](Array &array, double value) {
    array.assign(room, value);
    return array.data() + chunk_size;
  };
  ChainView view{p};
  view.u = blocks_of(u_, 0.0);
  view.v = blocks_of(v_, 0.0);
  view.force = blocks_of(force_, 0.0);
  double *const limits = blocks_of(mu_, 1e300);
  std::copy(mu.begin(), mu.end(), limits);
  view.mu = limits;
  if (p.scheme == Scheme::adams_bashforth) view.ahead = blocks_of(ahead_, 0.0);
  if (!p.by_springs()) {
    view.forces = forces_.get();
    view.of_modes = forces_->arrays();
    view.change = blocks_of(change_, 0.0);
  }
  if (p.landscape.length > 0.0) {
    cells_.resize(mu.size());
    ends_.resize(whole_chunks(mu.size()));
  }
  return view;
}

namespace {

// Returns a random number in [0, 1) that is a function of seed, block and a counter, so that no
// state of a generator has to be saved.
double hashed(std::uint64_t seed, std::uint64_t block, std::uint64_t number) {
  const std::uint64_t bits = LSM::splitmix64(LSM::splitmix64(seed ^ block) ^ number);
  return static_cast<double>(bits >> 11) * 0x1.0p-53;
}

}  // namespace

// Gives a block another strength if it has left its cell of the landscape, and returns whether it
// has. All cells but the first are one correlation length long.
bool Chain::draw_strength(int i) {
  std::int64_t &cell = cells_[static_cast<std::size_t>(i)];
  double &left_at = ends_[static_cast<std::size_t>(i)];
  if (view_.u[i] < left_at) return false;
  const Landscape &way = view_.landscape;
  const auto block = static_cast<std::uint64_t>(i);
  const double first = hashed(way.seed, block, 0);
  const auto end = [&] { return way.length * (first + static_cast<double>(cell)); };
  cell = std::max(cell, static_cast<std::int64_t>(view_.u[i] / way.length - first));
  while (!(view_.u[i] < end())) ++cell;
  left_at = end();
  if (cell > 0)
    mu_[static_cast<std::size_t>(i + chunk_size)] =
        way.low + (way.high - way.low) * hashed(way.seed, block, static_cast<std::uint64_t>(cell));
  return cell > 0;
}

void Chain::take_step() {
  const std::vector<std::int32_t> &list = active_.list();
  StepSums sums;
  if (!list.empty())
    sums = function_(view_, list.data(), static_cast<int>(list.size()),
                     plate_step_ * static_cast<double>(step_ + 1), active_.hot());
  account_.add(sums, ++step_);
  moved_ += sums.hot;
  if (cells_.empty() || !(sums.slip > 0.0)) return;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::int64_t i = static_cast<std::int64_t>(list[k]) * chunk_size;
    const double *const u = view_.u + i, *const end = ends_.data() + i;
    bool left = false;
    for (int l = 0; l < chunk_size; ++l) left |= u[l] >= end[l];
    if (!left) continue;
    for (int l = 0; l < chunk_size; ++l)
      // A block whose strength has become lower may move in the next step.
      if (u[l] >= end[l] && draw_strength(static_cast<int>(i) + l))
        active_.hot()[k] = static_cast<std::uint8_t>(active_.hot()[k] | 1U << l);
  }
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
  if (view_.ahead) s.ahead.assign(view_.ahead, view_.ahead + view_.blocks);
  return s;
}

void Chain::set_state(const ChainState &s) {
  const std::size_t n = static_cast<std::size_t>(view_.blocks);
  if (s.u.size() != n || s.v.size() != n || (!s.ahead.empty() && s.ahead.size() != n) || s.step < 0)
    throw std::invalid_argument("saved chain does not fit --blocks");
  account_.restore(s);
  step_ = s.step;
  moved_ = s.moved;
  std::copy(s.u.begin(), s.u.end(), view_.u);
  std::copy(s.v.begin(), s.v.end(), view_.v);
  for (std::size_t i = 0; view_.ahead && i < n; ++i)
    view_.ahead[i] = s.ahead.empty() ? view_.dt * s.v[i] : s.ahead[i];
  restart();
}

// Recomputes strengths, forces and the active set from u, v and the step.
void Chain::restart() {
  double *const u = view_.u;
  u[-1] = u[view_.blocks - 1];
  u[view_.blocks] = u[0];
  if (forces_) forces_->find(u);
  for (int i = 0; i < view_.blocks; ++i) view_.force[i] = view_.pull(i, plate());
  if (!cells_.empty()) {
    std::fill(cells_.begin(), cells_.end(), 0);
    std::fill(ends_.begin(), ends_.end(), std::numeric_limits<double>::max());
    std::fill_n(ends_.begin(), view_.blocks, std::numeric_limits<double>::lowest());
    std::copy(first_mu_.begin(), first_mu_.end(), mu_.begin() + chunk_size);
    for (int i = 0; i < view_.blocks; ++i) draw_strength(i);
  }
  active_.restart(step_);
}

}  // namespace Slider
