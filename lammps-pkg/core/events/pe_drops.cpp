// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/pe_drops.h"

#include <algorithm>
#include <cmath>

#include "files/state.h"
#include "numerics/circular_mean.h"
#include "numerics/constants.h"

namespace LSM {

void EventLocator::add(const std::vector<BinSlip> &slips) {
  for (const BinSlip &s : slips) moment_[static_cast<int>(s.bin)] += s.moment;
}

void EventLocator::locate(double x0, double length, Event &event) const {
  double largest = 0.0, sum = 0.0, c = 0.0, s = 0.0;
  for (const auto &[bin, moment] : moment_) {
    const double angle = 2.0 * pi * (bin + 0.5) * bin_width_ / length;
    largest = std::max(largest, moment);
    sum += moment;
    c += moment * std::cos(angle);
    s += moment * std::sin(angle);
  }
  int ruptured = 0;
  for (const auto &bin : moment_)
    if (bin.second > fraction_ * largest) ++ruptured;
  event.slip_moment = sum;
  event.x_centroid = x0 + part_of_ring(s, c) * length;
  event.rupture_length = std::min(ruptured * bin_width_, length);
}

std::vector<double> EventLocator::state() const {
  std::vector<double> out;
  for (const auto &[bin, moment] : moment_) {
    out.push_back(bin);
    out.push_back(moment);
  }
  return out;
}

void EventLocator::set_state(const std::vector<double> &saved, std::size_t at) {
  moment_.clear();
  for (std::size_t n = at; n + 1 < saved.size(); n += 2)
    moment_[static_cast<int>(saved[n])] = saved[n + 1];
}

void PeDropFinder::add_sample(const EventSample &sample, const Report &report) {
  Event event;
  const bool was_open = picker_.in_event();
  if (picker_.push(sample.step, sample.time, sample.pe, event)) {
    if (sample.slips) locator_.locate(sample.x0, sample.length, event);
    report(event);
  }
  if (!sample.slips) return;
  if (was_open && !picker_.in_event()) locator_.clear();
  if (picker_.in_event()) locator_.add(*sample.slips);
}

void PeDropFinder::change_picker(const PickerSettings &settings, double ratio) {
  picker_.change(of_all_sizes(settings), ratio);
}

std::vector<double> PeDropFinder::state() const {
  std::vector<double> out;
  StateWriter(out).raw(picker_.state());
  const std::vector<double> places = locator_.state();
  out.insert(out.end(), places.begin(), places.end());
  return out;
}

void PeDropFinder::set_state(const std::vector<double> &saved) {
  PickerState state;
  StateReader in(saved);
  in.raw(state);
  picker_.set_state(state);
  locator_.set_state(saved, saved.size() - in.left());
}

PickerSettings PeDropFinder::of_all_sizes(PickerSettings settings) {
  settings.min_size = 0.0;
  settings.keep_nonpositive = true;
  return settings;
}

Keywords PeDrops::keywords() {
  return {{"location", &location}, {"fraction", &fraction, Must::fraction}};
}

void PeDrops::describe(const EventSettings &settings, double, const AddParameter &add,
                       CatalogueInfo &info) const {
  add("picker", to_string(settings.picker.reading));
  add("lambda", text_io::number(settings.picker.lambda));
  add_sizes(settings, add);
  if (location) {
    add("slip_bin", text_io::number(settings.bin_width));
    add("rupture_fraction", text_io::number(fraction));
  }
  info.slip_moment = info.x_centroid = info.rupture_length = location;
}

std::unique_ptr<EventFinder> PeDrops::finder(const EventSettings &settings,
                                             const FaultGrid &) const {
  return std::make_unique<PeDropFinder>(settings.picker, settings.bin_width, fraction);
}

}  // namespace LSM
