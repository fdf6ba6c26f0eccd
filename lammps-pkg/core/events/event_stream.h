// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/event_stream.h
/// From samples to files, on the rank that has all of them: PE goes to the series, sums of the
/// fault's contacts to the slip history, both to the finder of the kind of events, and its events
/// to the catalogue.
#ifndef LSM_EVENT_STREAM_H
#define LSM_EVENT_STREAM_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "events/block_sampler.h"
#include "events/event_headers.h"
#include "files/output_claim.h"
#include "events/slip_recorder.h"
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

  /// From index `at` of the numbers on, of the kind with this number. False: this is no such state.
  bool read(const std::vector<double> &from, std::size_t at, std::size_t of_kind) {
    if (from.size() < at) return false;
    kind = of_kind;
    try {
      StateReader in(from, at);
      visit(*this, in);
      return in.left() == 0;
    } catch (const std::invalid_argument &) {
      return false;
    }
  }

  /// Whether events of this kind on this grid can continue; if not, their numbers do, and open
  /// events are lost.
  bool continues_with(std::size_t other_kind, const FaultGrid &other) const {
    return kind == other_kind && grid.dt == other.dt && grid.interval == other.interval &&
           grid.bins == other.bins;
  }
};

class EventStream {
 public:
  /// \throws std::invalid_argument for settings out of range
  explicit EventStream(const EventSettings &settings)
      : settings_(settings), kind_(number_of(*settings.kind)), picker_(settings.picker) {
    if (!settings.kind->wants_intervals()) finder_ = settings.kind->finder(settings, grid_);
  }

  /// A fault before its first interval. \throws std::invalid_argument
  void set_grid(const FaultGrid &grid) {
    grid_ = grid;
    finder_ = settings_.kind->finder(settings_, grid);
    continues_ = false;
  }

  /// Continues from a restart file, after set_grid(). \throws std::invalid_argument
  void set_state(const SavedStream &saved) {
    picker_.set_state(saved.picker);
    if (saved.kind != kind_) return;
    counts_ = saved.counts;
    if (!saved.continues_with(kind_, grid_)) return;
    grid_.step0 = saved.grid.step0;
    grid_.time0 = saved.grid.time0;
    finder_ = settings_.kind->finder(settings_, grid_);
    finder_->set_state(saved.finder);
    saved_history_ = saved.history;
    continues_ = true;
  }

  /// For restarts: numbers for SavedStream. open_sums: of the interval that is not complete.
  std::vector<double> state(const std::vector<double> &open_sums) const {
    SavedStream now;
    now.picker = picker_.state();
    now.grid = grid_;
    now.counts = counts_;
    now.open_sums = open_sums;
    now.finder = finder_->state();
    if (history_.is_open()) now.history = history_.state();
    std::vector<double> out;
    StateWriter to(out);
    SavedStream::visit(now, to);
    return out;
  }

  /// Starts the files or continues them; anything that prevents it is found before the first one is
  /// touched. from_restart: set_state() was called; clock: for the series; others: files that
  /// something else writes. \throws EventStreamError or what the writers throw
  void begin_files(std::int64_t step, bool from_restart, const SceneInfo &scene,
                   const StepClock &clock, const std::vector<Output> &others = {}) {
    OutputClaim claim = claim_outputs(files_of(settings_), others);
    open_files(step, from_restart, scene, clock);
    claim_ = std::move(claim);
  }

  /// The fault before its first interval, with the sums of its contacts over the ranks.
  void begin_fault(double pe, const std::vector<double> &sums) {
    const FaultRow row = fault_row(grid_, sums.data(), 1);
    finder_->begin(pe, row);
    if (!settings_.history_file.empty())
      history_.create(settings_.history_file, history_info_, grid_.step0, pe, row.stress);
  }

  /// The samples of a block. time_of(step): model time; the fault begins at x0 and has that length.
  /// \throws EventStreamError or what the writers throw, at the first offending sample
  template <class TimeOf>
  void add_block(const GatheredBlock &block, TimeOf &&time_of, double x0, double length) {
    const bool with_slips = settings_.kind->wants_slips();
    const bool with_intervals = settings_.kind->wants_intervals();
    std::vector<std::vector<BinSlip>> slips;
    if (with_slips) slips = block.slip_by_step();
    const double *sums = block.intervals.data();
    for (int n = 0; n < block.count; ++n) {
      const std::int64_t step = block.first + n;
      const double pe = block.total(n);
      add_sample({step, time_of(step), pe,
                  with_slips ? &slips[static_cast<std::size_t>(n)] : nullptr, x0, length});
      if (!with_intervals || !grid_.ends_interval(step)) continue;
      add_interval(step, pe, sums, time_of);
      sums += fault_fields * static_cast<std::size_t>(grid_.bins);
    }
  }

  /// Writes open events with their end so far; nothing may be added afterwards.
  void write_unfinished() {
    finder_->each_open_as_ended([this](const Event &event) { finish(event); });
  }

  /// Hands all samples so far to the operating system.
  void flush() { series_.flush(); }

  /// Another time step, see EventPicker::change().
  void change_picker(const PickerSettings &settings, double ratio) {
    settings_.picker = settings;
    picker_.change(settings, ratio);
    if (finder_) finder_->change_picker(settings, ratio);
  }
  void leave_out_jump(double jump) {
    picker_.leave_out_jump(jump);
    if (finder_) finder_->leave_out_jump(jump);
  }

  /// Of all PE samples, for the rate of PE; events come from the finder.
  const EventPicker &picker() const { return picker_; }
  /// Numbers of events.
  const PickerState &counts() const { return counts_; }
  /// Events that have begun and not ended.
  std::int64_t open() const { return finder_ ? finder_->open() : 0; }

 private:
  bool resumes(const std::string &file) const {
    std::error_code code;
    return settings_.resume && !file.empty() && std::filesystem::exists(file, code);
  }

  void check_files(bool from_restart) const {
    const std::string who = "Compute lsm/events ";
    const std::string &name = settings_.name;
    for (const auto &[key, file] : files_of(settings_)) {
      if (file.empty()) continue;
      if (resumes(file) && !from_restart)
        throw EventStreamError(who + "resume yes: file " + file +
                               " exists, but the restart file holds no picker state of compute " +
                               name + "; read a restart written while it was active");
      if (resumes(file) && !continues_ && file != settings_.series_file)
        throw EventStreamError(who + "resume yes: file " + file +
                               " exists, but the restart file holds no " + settings_.kind->name() +
                               " of compute " + name +
                               " with these bins and intervals; give another name, or replace it "
                               "with overwrite yes and resume no");
      if (!resumes(file) && !settings_.overwrite && text_io::holds_data(file))
        throw EventStreamError(who + key + ": file " + file +
                               " exists; give another name, or replace it with overwrite yes" +
                               (from_restart ? ", or continue it with resume yes" : ""));
      const std::string problem = text_io::why_not_writable(file);
      if (!problem.empty()) throw EventStreamError(problem);
    }
  }

  void open_files(std::int64_t step, bool from_restart, const SceneInfo &scene,
                  const StepClock &clock) {
    check_files(from_restart);
    const std::vector<std::string> free_to_change = {"program", "ranks", "links"};
    const std::string &catalogue = settings_.catalogue_file, &series = settings_.series_file,
                      &history = settings_.history_file;
    const CatalogueInfo catalogue_info =
        catalogue_header(settings_, *settings_.kind, scene, grid_.width);
    const PeSeriesInfo series_info = series_header(settings_, scene, clock);
    history_info_ = history_header(settings_, scene, grid_);
    if (resumes(catalogue))
      catalogue_.find_cut(catalogue, catalogue_info, finder_->known_until(step), free_to_change,
                          counts().events);
    if (resumes(series)) series_.find_cut(series, series_info, step, free_to_change);
    if (resumes(history)) history_.find_cut(history, history_info_, saved_history_, free_to_change);

    // All fit.
    if (resumes(catalogue))
      catalogue_.cut();
    else if (!catalogue.empty())
      catalogue_.create(catalogue, catalogue_info);
    if (resumes(series))
      series_.cut();
    else if (!series.empty())
      series_.create(series, series_info);
    if (resumes(history)) {
      history_.cut();
    } else if (!history.empty() && continues_) {
      const FaultMoment last = finder_->last_interval();
      history_.create(history, history_info_, grid_.step0 + last.intervals * grid_.interval,
                      last.pe, last.stress);
    }
  }

  void add_sample(const EventSample &sample) {
    if (!std::isfinite(sample.pe)) {
      series_.flush();
      throw EventStreamError("Potential energy is not finite at step " +
                             std::to_string(sample.step) +
                             "; the catalogue ends with the last event before it. Use a smaller "
                             "time step or start from an earlier restart");
    }
    if (series_.is_open() && sample.step % settings_.series_stride == 0)
      series_.write(sample.step, sample.time, sample.pe);
    Event drop;
    picker_.push(sample.step, sample.time, sample.pe, drop);
    finder_->add_sample(sample, [this](const Event &event) { finish(event); });
  }

  template <class TimeOf>
  void add_interval(std::int64_t step, double pe, const double *sums, TimeOf &&time_of) {
    const FaultRow row = fault_row(grid_, sums, grid_.interval);
    finder_->add(pe, row, [this, &time_of](Event event) {
      if (settings_.explicit_times) {
        event.t_start = time_of(event.step_start);
        event.t_end = time_of(event.step_end);
      }
      finish(event);
    });
    if (history_.is_open()) history_.add(step, pe, row, finder_->active());
  }

  void finish(Event event) {
    if (is_left_out(event.size, settings_.picker, counts_)) return;
    event.id = ++counts_.events;
    counts_.last_size = event.size;
    if (catalogue_.is_open()) catalogue_.write(event);
  }

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
