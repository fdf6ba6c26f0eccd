// SPDX-License-Identifier: GPL-2.0-or-later
/// \file pe_drops.h
/// Events as drops of the potential energy (PE) of the whole model (the paper's), with the places
/// of their slip †.
#ifndef LSM_PE_DROPS_H
#define LSM_PE_DROPS_H

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "events/event_kind.h"

namespace LSM {

/// Sums the moment of each bin since the open event began, and locates the event by it.
class EventLocator {
 public:
  /// \param bin_width > 0
  /// \param fraction bins with at most this fraction of the largest moment are not ruptured
  EventLocator(double bin_width, double fraction) : bin_width_(bin_width), fraction_(fraction) {}

  void add(const std::vector<BinSlip> &slips);
  void clear() { moment_.clear(); }

  /// Sets slip moment, centroid and rupture length. The centroid is the circular mean of the bins.
  /// \param x0 where the fault begins
  /// \param length its period
  void locate(double x0, double length, Event &event) const;

  /// State for restarts: pairs of bin and moment.
  std::vector<double> state() const;
  /// Reads the pairs from index `at` on.
  void set_state(const std::vector<double> &saved, std::size_t at);

 private:
  double bin_width_, fraction_;
  std::map<int, double> moment_;
};

/// Picks events from PE and locates them.
class PeDropFinder : public EventFinder {
 public:
  /// \throws std::invalid_argument for settings out of range
  PeDropFinder(const PickerSettings &settings, double bin_width, double fraction)
      : picker_(of_all_sizes(settings)), locator_(bin_width, fraction) {}

  void add_sample(const EventSample &sample, const Report &report) override;
  std::int64_t open() const override { return picker_.in_event() ? 1 : 0; }
  // An event that ended at this step is known only one step later.
  std::int64_t known_until(std::int64_t step) const override { return step - 1; }

  void change_picker(const PickerSettings &settings, double ratio) override;
  void leave_out_jump(double jump) override { picker_.leave_out_jump(jump); }

  std::vector<double> state() const override;
  void set_state(const std::vector<double> &saved) override;

 private:
  // The picker reports events of all sizes, as the stream decides which of them are written.
  static PickerSettings of_all_sizes(PickerSettings settings);

  EventPicker picker_;
  EventLocator locator_;
};

class PeDrops : public EventKind {
 public:
  bool location = false;   ///< slip moment, centroid and rupture length of each event
  double fraction = 0.05;  ///< bins with at most this fraction of the largest slip are not ruptured

  const char *name() const override { return "pe"; }
  Keywords keywords() override;
  bool picks_pe() const override { return true; }
  bool wants_slips() const override { return location; }
  std::string asked_by() const override { return "location yes"; }

  void describe(const EventSettings &settings, double, const AddParameter &add,
                CatalogueInfo &info) const override;
  std::unique_ptr<EventFinder> finder(const EventSettings &settings,
                                      const FaultGrid &) const override;
};

}  // namespace LSM

#endif
