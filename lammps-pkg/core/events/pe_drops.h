// SPDX-License-Identifier: GPL-2.0-or-later
/// \file pe_drops.h
/// Events as drops of the potential energy (PE) of the whole model (the paper's), with the places
/// of their slip †.
#ifndef LSM_PE_DROPS_H
#define LSM_PE_DROPS_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "events/event_kind.h"
#include "numerics/circular_mean.h"
#include "files/state.h"

namespace LSM {

/// Moment of the bins since the open event began, and what follows from it for the event.
class EventLocator {
 public:
  /// bin_width > 0; fraction: bins with at most this fraction of the largest moment are not
  /// ruptured.
  EventLocator(double bin_width, double fraction) : bin_width_(bin_width), fraction_(fraction) {}

  void add(const std::vector<BinSlip> &slips) {
    for (const BinSlip &s : slips) moment_[static_cast<int>(s.bin)] += s.moment;
  }
  void clear() { moment_.clear(); }

  /// Sets slip moment, centroid and rupture length; the fault begins at x0 and has this length as
  /// its period. Centroid: circular mean of the bins over the period.
  void locate(double x0, double length, Event &event) const {
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

  /// For restarts: pairs of bin and moment.
  std::vector<double> state() const {
    std::vector<double> out;
    for (const auto &[bin, moment] : moment_) {
      out.push_back(bin);
      out.push_back(moment);
    }
    return out;
  }
  /// The pairs in saved, starting at index `at`.
  void set_state(const std::vector<double> &saved, std::size_t at) {
    moment_.clear();
    for (std::size_t n = at; n + 1 < saved.size(); n += 2)
      moment_[static_cast<int>(saved[n])] = saved[n + 1];
  }

 private:
  double bin_width_, fraction_;
  std::map<int, double> moment_;
};

/// The picker, and the places of its events.
class PeDropFinder : public EventFinder {
 public:
  /// \throws std::invalid_argument for settings out of range
  PeDropFinder(const PickerSettings &settings, double bin_width, double fraction)
      : picker_(of_all_sizes(settings)), locator_(bin_width, fraction) {}

  void add_sample(const EventSample &sample, const Report &report) override {
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
  std::int64_t open() const override { return picker_.in_event() ? 1 : 0; }
  // An event that ended at this step is known only one step later.
  std::int64_t known_until(std::int64_t step) const override { return step - 1; }

  void change_picker(const PickerSettings &settings, double ratio) override {
    picker_.change(of_all_sizes(settings), ratio);
  }
  void leave_out_jump(double jump) override { picker_.leave_out_jump(jump); }

  std::vector<double> state() const override {
    std::vector<double> out;
    StateWriter(out).raw(picker_.state());
    const std::vector<double> places = locator_.state();
    out.insert(out.end(), places.begin(), places.end());
    return out;
  }
  void set_state(const std::vector<double> &saved) override {
    PickerState state;
    StateReader in(saved);
    in.raw(state);
    picker_.set_state(state);
    locator_.set_state(saved, saved.size() - in.left());
  }

 private:
  // Which of them are written is decided where events are written.
  static PickerSettings of_all_sizes(PickerSettings settings) {
    settings.min_size = 0.0;
    settings.keep_nonpositive = true;
    return settings;
  }

  EventPicker picker_;
  EventLocator locator_;
};

class PeDrops : public EventKind {
 public:
  bool location = false;   ///< slip moment, centroid and rupture length of each event
  double fraction = 0.05;  ///< bins with at most this fraction of the largest slip are not ruptured

  const char *name() const override { return "pe"; }
  Keywords keywords() override {
    return {{"location", &location}, {"fraction", &fraction, Must::fraction}};
  }
  bool picks_pe() const override { return true; }
  bool wants_slips() const override { return location; }
  std::string asked_by() const override { return "location yes"; }

  void describe(const EventSettings &settings, double, const AddParameter &add,
                CatalogueInfo &info) const override {
    add("picker", to_string(settings.picker.reading));
    add("lambda", text_io::number(settings.picker.lambda));
    add_sizes(settings, add);
    if (location) {
      add("slip_bin", text_io::number(settings.bin_width));
      add("rupture_fraction", text_io::number(fraction));
    }
    info.slip_moment = info.x_centroid = info.rupture_length = location;
  }
  std::unique_ptr<EventFinder> finder(const EventSettings &settings,
                                      const FaultGrid &) const override {
    return std::make_unique<PeDropFinder>(settings.picker, settings.bin_width, fraction);
  }
};

}  // namespace LSM

#endif
