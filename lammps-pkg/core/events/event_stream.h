// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/event_stream.h
/// Turns samples into files, on rank 0: PE goes to the series, sums over the contacts of the fault
/// to the slip history, and both to the finder of events, which fill the catalogue.
#ifndef LSM_EVENT_STREAM_H
#define LSM_EVENT_STREAM_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "events/block_sampler.h"
#include "events/event_headers.h"
#include "events/slip_recorder.h"
#include "files/output_claim.h"
#include "files/state.h"

namespace LSM {

/// A run that cannot continue; the message is a complete sentence for the user.
class EventStreamError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// State of a stream in a restart file, read from the numbers of EventStream::state().
struct SavedStream {
  std::size_t kind = 0;           ///< number of the kind of events
  PickerState picker;             ///< of the rate of PE
  FaultGrid grid;                 ///< only step0, interval, bins, time0 and dt
  PickerState counts;             ///< only the numbers of events
  std::vector<double> open_sums;  ///< of the interval that was not complete
  std::vector<double> finder;     ///< EventFinder::state()
  std::vector<double> history;    ///< SlipHistoryWriter::state(), empty if there was none

  template <class Self, class State>
  static void visit(Self &self, State &state) {
    auto &grid = self.grid;
    auto &counts = self.counts;
    state.raw(self.picker);
    state(grid.step0, grid.time0, grid.dt, grid.interval, grid.bins);
    state(counts.events, counts.dropped_nonpositive, counts.dropped_small, counts.last_size);
    state.list(self.open_sums);
    state.list(self.finder);
    state.list(self.history);
  }

  /// Reads the state of events of the given kind from index `at` on. Returns false if the numbers
  /// are not such a state.
  bool read(const std::vector<double> &from, std::size_t at, std::size_t of_kind);

  /// Whether open events can continue with this kind and grid. If not, they are lost, but event
  /// numbers continue.
  bool continues_with(std::size_t other_kind, const FaultGrid &other) const;
};

class EventStream {
 public:
  using TimeOfStep = std::function<double(std::int64_t step)>;

  /// \throws std::invalid_argument for settings out of range
  explicit EventStream(const EventSettings &settings);

  /// Starts a fault before its first interval.
  /// \throws std::invalid_argument
  void set_grid(const FaultGrid &grid);

  /// Continues from a restart file. To be called after set_grid().
  /// \throws std::invalid_argument
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

  /// Adds the samples of a block. time_of(step) is model time; the fault begins at x0.
  /// \throws EventStreamError or what the writers throw, at the first offending sample
  void add_block(const GatheredBlock &block, const TimeOfStep &time_of, double x0, double length);

  /// Writes open events with their end so far; nothing may be added afterwards.
  void write_unfinished();

  /// Hands all samples so far to the operating system.
  void flush() { series_.flush(); }

  /// Adapts the picker to another time step, see EventPicker::change().
  void change_picker(const PickerSettings &settings, double ratio);
  void leave_out_jump(double jump);

  /// The picker of all PE samples, used for the rate of PE only; events come from the finder.
  const EventPicker &picker() const { return picker_; }
  /// Counts of events.
  const PickerState &counts() const { return counts_; }
  /// Events that have begun and not ended.
  std::int64_t open() const { return finder_ ? finder_->open() : 0; }

 private:
  bool resumes(const std::string &file) const;

  void check_files(bool from_restart) const;

  void open_files(std::int64_t step, bool from_restart, const SceneInfo &scene,
                  const StepClock &clock);
  void add_sample(const EventSample &sample);
  void add_interval(std::int64_t step, double pe, const double *sums, const TimeOfStep &time_of);

  void finish(Event event);

  EventSettings settings_;
  std::size_t kind_;
  EventPicker picker_;
  FaultGrid grid_;  // of kinds that want the fault in intervals
  std::unique_ptr<EventFinder> finder_;
  PickerState counts_;      // only the numbers of events
  bool continues_ = false;  // with the state of a restart file
  std::vector<double> saved_history_;

  OutputClaim claim_;  // outlives the writers
  CatalogueWriter catalogue_;
  PeSeriesWriter series_;
  SlipHistoryWriter history_;
  SlipHistoryInfo history_info_;
};

}  // namespace LSM

#endif
