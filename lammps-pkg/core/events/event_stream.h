// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/event_stream.h
/// Turns samples into files, on rank 0. Each PE sample goes to the series and the picker, whose
/// drops pass the filter to the catalogue. If slip is recorded, sums over the faces and contacts of
/// the fault go to the locator of drops (of a line, not of a plane), to the finder of ruptures and
/// to the slip history.
#ifndef LSM_EVENT_STREAM_H
#define LSM_EVENT_STREAM_H

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "events/block_sampler.h"
#include "events/drop_locator.h"
#include "events/event_filter.h"
#include "events/event_headers.h"
#include "events/ruptures.h"
#include "files/output_claim.h"
#include "files/state.h"
#include "numerics/sum.h"

namespace LSM {

/// A run that cannot continue; the message is a complete sentence for the user.
class EventStreamError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What friction takes up on the whole fault, step by step.
struct FrictionWork {
  NeumaierSum total;      ///< until the last sample
  double at_start = 0.0;  ///< until the open drop began

  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state(self.total, self.at_start);
  }
};

/// State of a stream in a restart file, read from the numbers of EventStream::state().
struct SavedStream {
  PickerState picker;
  FilterCounts drops, ruptures;
  FaultGrid grid;                 ///< only step0, interval, bins, time0 and dt
  FrictionWork friction;          ///< since the first interval
  std::vector<double> open_sums;  ///< of the interval that was not complete
  std::vector<double> locator;    ///< DropLocator::state(), empty if drops were not located
  std::vector<double> finder;     ///< RuptureFinder::state(), empty if there was none
  std::vector<double> history;    ///< SlipHistoryWriter::state(), empty if there was none

  template <class Self, class State>
  static void visit(Self &self, State &state) {
    auto &grid = self.grid;
    state.raw(self.picker);
    state(self.drops, self.ruptures);
    state(grid.step0, grid.time0, grid.dt, grid.interval, grid.bins);
    state(self.friction);
    state.list(self.open_sums);
    state.list(self.locator);
    state.list(self.finder);
    state.list(self.history);
  }

  /// Reads the state from index `at` on. Returns false if the numbers are not such a state.
  bool read(const std::vector<double> &from, std::size_t at);

  /// Whether slip was recorded.
  bool has_slip() const { return !locator.empty() || !finder.empty(); }
  /// Whether slip continues with this grid, as it is when recording begins at the step of the
  /// restart file. If not, the slip of an open drop so far and open ruptures are lost, but events
  /// and their numbers continue.
  bool continues_with(const FaultGrid &other, bool finds_ruptures) const;
  /// The grid, whose intervals continue to count from the first one.
  FaultGrid continued(FaultGrid other) const;
};

/// What was picked so far: numbers for the screen, all of which are doubles.
struct Picked {
  double events = 0.0, last_size = 0.0, rate = 0.0, in_event = 0.0;  ///< drops of PE
  double ruptures = 0.0, last_work = 0.0, open_ruptures = 0.0;
};

class EventStream {
 public:
  using TimeOfStep = std::function<double(std::int64_t step)>;

  /// \throws std::invalid_argument for settings out of range
  explicit EventStream(const EventSettings &settings);

  /// Starts a fault before its first interval, if slip is recorded.
  /// \throws std::invalid_argument
  void set_grid(const FaultGrid &grid);

  /// Continues from a restart file. To be called after set_grid(), whose grid is the continued()
  /// one if slip continues with it. \throws std::invalid_argument
  void set_state(const SavedStream &saved);

  /// Returns the numbers of a SavedStream. open_sums are the sums of the incomplete interval.
  std::vector<double> state(const std::vector<double> &open_sums) const;

  /// Starts or continues the files. Anything that prevents it is found before the first file is
  /// touched. from_restart says that set_state() was called; `others` are files that something else
  /// writes.
  /// \throws EventStreamError or what the writers throw
  void begin_files(std::int64_t step, bool from_restart, const SceneInfo &scene,
                   const StepClock &clock, const std::vector<Output> &others = {});

  /// Records the fault before its first interval, with the sums over its contacts of all ranks.
  void begin_fault(double pe, const std::vector<double> &sums);

  /// Adds the samples of a block. time_of(step) is model time.
  /// \throws EventStreamError or what the writers throw, at the first offending sample
  void add_block(const GatheredBlock &block, const TimeOfStep &time_of);

  /// Notes the sums of the interval that was not complete at the end of a run, for write_rest().
  void end_run(std::int64_t step, const std::vector<double> &open_sums);
  /// Writes what is held back until the present interval is complete: drops that ended in it and,
  /// if requested, open ruptures with their end so far. Nothing may be added afterwards.
  void write_rest(bool open_ruptures);

  /// Hands all samples so far to the operating system.
  void flush() { series_.flush(); }

  /// Adapts the picker to another time step, see EventPicker::change().
  void change_picker(const PickerSettings &settings, double ratio);
  void leave_out_jump(double jump) { picker_.leave_out_jump(jump); }

  Picked picked() const;
  const EventPicker &picker() const { return picker_; }
  /// Counts of drops of PE and of ruptures that are written.
  const FilterCounts &drops() const { return drops_.counts(); }
  const FilterCounts &ruptures() const { return ruptures_.counts(); }
  /// Ruptures that have begun and not ended.
  std::int64_t open_ruptures() const { return finder_ ? finder_->open() : 0; }

 private:
  bool resumes(const std::string &file) const;
  bool records_slip() const { return locator_ || finder_; }

  void check_files(bool from_restart) const;

  void open_files(std::int64_t step, bool from_restart, const SceneInfo &scene,
                  const StepClock &clock);
  void add_sample(std::int64_t step, double time, double pe, double friction);
  void add_interval(std::int64_t step, double time, double pe, const double *sums);

  void write_drop(Drop drop);
  void write_rupture(const FaultRupture &rupture);

  EventSettings settings_;
  EventPicker picker_;
  EventFilter drops_, ruptures_;
  FaultGrid grid_;                       // if slip is recorded
  std::optional<DropLocator> locator_;   // the same, along a line
  std::optional<RuptureFinder> finder_;  // if ruptures or slip history are recorded
  FrictionWork friction_;
  bool slip_continues_ = false;  // with the state of a restart file
  std::vector<double> saved_history_;
  std::int64_t last_step_ = 0;     // of the last run
  std::vector<double> last_sums_;  // of the incomplete interval at its end

  OutputClaim claim_;  // outlives the writers
  CatalogueWriter catalogue_, rupture_catalogue_;
  PeSeriesWriter series_;
  SlipHistoryWriter history_;
  SlipHistoryInfo history_info_;
};

}  // namespace LSM

#endif
