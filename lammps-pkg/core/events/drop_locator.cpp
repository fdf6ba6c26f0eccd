// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/drop_locator.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "files/state.h"

namespace LSM {

DropLocator::DropLocator(const FaultGrid &grid, double modulus, double fraction)
    : grid_(grid),
      centroid_(grid.strike()),
      modulus_(modulus),
      fraction_(fraction),
      end_(grid.step0),
      open_(static_cast<std::size_t>(grid.bins), 0.0) {}

void DropLocator::add(const Drop &drop, const Report &report) {
  waiting_.push_back({drop, open_});
  forget_open();
  if (drop.step_end > end_) return;
  report(located(waiting_.back()));
  waiting_.pop_back();
}

void DropLocator::add_interval(std::int64_t step, const FaultRow &row,
                               std::optional<std::int64_t> begun, const Report &report) {
  finish(step, row, report);
  if (begun) add_part(open_, *begun, step, step, row);
  end_ = step;
}

void DropLocator::finish(std::int64_t step, const FaultRow &row, const Report &report) {
  for (Waiting &one : waiting_) {
    add_part(one.slip, one.drop.step_start, one.drop.step_end, step, row);
    report(located(one));
  }
  waiting_.clear();
}

double DropLocator::part_of(std::int64_t from, std::int64_t to, std::int64_t step) const {
  const std::int64_t inside = std::min(to, step) - std::max(from, end_);
  return inside <= 0 ? 0.0 : static_cast<double>(inside) / static_cast<double>(step - end_);
}

void DropLocator::add_part(std::vector<double> &slip, std::int64_t from, std::int64_t to,
                           std::int64_t step, const FaultRow &row) const {
  const double part = part_of(from, to, step);
  if (part == 0.0) return;
  for (std::size_t b = 0; b < slip.size(); ++b) slip[b] += part * static_cast<double>(row.slip[b]);
}

Drop DropLocator::located(const Waiting &one) const {
  Drop e = one.drop;
  double sum = 0.0, largest = 0.0, cosines = 0.0, sines = 0.0;
  for (std::size_t b = 0; b < one.slip.size(); ++b) {
    const double slip = one.slip[b], size = std::fabs(slip);
    sum += slip;
    largest = std::max(largest, size);
    cosines += size * centroid_.cosine(b);
    sines += size * centroid_.sine(b);
  }
  const auto ruptured = std::count_if(one.slip.begin(), one.slip.end(), [&](double slip) {
    return std::fabs(slip) > fraction_ * largest;
  });
  e.slip_moment = modulus_ * sum * grid_.width;
  e.x_centroid = centroid_.of(cosines, sines);
  e.rupture_length = static_cast<double>(ruptured) * grid_.width;
  e.peak_slip = largest;
  return e;
}

std::vector<double> DropLocator::state() const {
  std::vector<double> out;
  StateWriter to(out);
  visit(*this, to);
  return out;
}

void DropLocator::set_state(const std::vector<double> &saved) {
  DropLocator read = *this;
  StateReader in(saved);
  visit(read, in);
  bool sane = in.left() == 0 && read.open_.size() == open_.size() &&
              (read.end_ - grid_.step0) % grid_.interval == 0;
  for (const Waiting &one : read.waiting_) sane = sane && one.slip.size() == open_.size();
  if (!sane) throw std::invalid_argument("saved slip of drops is inconsistent");
  *this = std::move(read);
}

}  // namespace LSM
