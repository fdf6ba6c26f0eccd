// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_event_stream.h
/// From samples to files, on the rank that has them all: PE to the series, to the picker and its
/// events to the catalogue; sums of the fault's contacts to ruptures, their catalogue and the slip
/// history.
#ifndef LSM_EVENT_STREAM_H
#define LSM_EVENT_STREAM_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "lsm_block_sampler.h"
#include "lsm_event_settings.h"
#include "lsm_output_claim.h"
#include "lsm_slip_recorder.h"

namespace LSM {

/// A run that cannot go on; the message is a sentence of its own, for the user.
class EventStreamError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a restart file holds of a picker, of ruptures and of an open event, read from the numbers
/// that EventStream::state() gave.
struct SavedStream {
  PickerState picker;
  bool ruptures = false;           ///< the events were ruptures; only then:
  FaultGrid grid;                  ///< only step0, interval, bins, time0 and dt
  PickerState counts;              ///< only the numbers of events
  std::vector<double> open_sums;   ///< of the interval that was not complete
  std::vector<double> finder;      ///< RuptureFinder::state()
  std::vector<double> history;     ///< SlipHistoryWriter::state(), empty if there was none
  std::vector<double> open_event;  ///< EventLocator::state()

  static constexpr std::size_t picker_words = sizeof(PickerState) / sizeof(double);
  static constexpr std::size_t rupture_words = 9;

  /// From place `at` of the numbers on. with_ruptures: the events were ruptures. False: this is no
  /// such state.
  bool read(const std::vector<double> &from, std::size_t at, bool with_ruptures) {
    if (from.size() < at + picker_words) return false;
    std::memcpy(static_cast<void *>(&picker), &from[at], sizeof picker);
    at += picker_words;
    ruptures = with_ruptures;
    if (!ruptures) {
      open_event.assign(from.begin() + static_cast<std::ptrdiff_t>(at), from.end());
      return true;
    }
    if (at + rupture_words > from.size()) return false;
    const double *const saved = &from[at];
    grid.step0 = static_cast<std::int64_t>(saved[0]);
    grid.time0 = saved[1];
    grid.dt = saved[2];
    grid.interval = static_cast<std::int64_t>(saved[3]);
    grid.bins = static_cast<int>(saved[4]);
    counts.events = static_cast<std::int64_t>(saved[5]);
    counts.dropped_nonpositive = static_cast<std::int64_t>(saved[6]);
    counts.dropped_small = static_cast<std::int64_t>(saved[7]);
    counts.last_size = saved[8];
    at += rupture_words;
    for (std::vector<double> *list : {&open_sums, &finder, &history}) {
      if (at >= from.size()) return false;
      const auto length = static_cast<std::size_t>(from[at++]);
      if (length > from.size() - at) return false;
      const auto begin = from.begin() + static_cast<std::ptrdiff_t>(at);
      list->assign(begin, begin + static_cast<std::ptrdiff_t>(length));
      at += length;
    }
    return at == from.size();
  }

  /// Whether ruptures on that grid can go on; else their numbers do, and what was open is lost.
  bool goes_on_with(const FaultGrid &other) const {
    return ruptures && grid.dt == other.dt && grid.interval == other.interval &&
           grid.bins == other.bins;
  }
};

class EventStream {
 public:
  /// \throws std::invalid_argument for settings out of range
  explicit EventStream(const EventSettings &settings)
      : settings_(settings),
        picker_(settings.picker),
        locator_(settings.bin_width, settings.bin_fraction) {}

  /// A fault whose first interval is still to come. \throws std::invalid_argument
  void set_grid(const FaultGrid &grid) {
    grid_ = grid;
    finder_ = std::make_unique<RuptureFinder>(grid, settings_.rupture_settings(grid.dt));
    ruptures_go_on_ = false;
  }

  /// Goes on from a restart file, after set_grid(). \throws std::invalid_argument
  void set_state(const SavedStream &saved) {
    picker_.set_state(saved.picker);
    locator_.set_state(saved.open_event, 0);
    if (!settings_.ruptures) return;
    rupture_counts_ = saved.counts;
    if (!saved.goes_on_with(grid_)) return;
    grid_.step0 = saved.grid.step0;
    grid_.time0 = saved.grid.time0;
    finder_ = std::make_unique<RuptureFinder>(grid_, settings_.rupture_settings(grid_.dt));
    finder_->set_state(saved.finder);
    saved_history_ = saved.history;
    ruptures_go_on_ = true;
  }

  /// For restarts: numbers for SavedStream. open_sums: of the interval that is not complete.
  std::vector<double> state(const std::vector<double> &open_sums) const {
    std::vector<double> out(SavedStream::picker_words);
    std::memcpy(out.data(), &picker_.state(), sizeof(PickerState));
    if (!settings_.ruptures) {
      const std::vector<double> open_event = locator_.state();
      out.insert(out.end(), open_event.begin(), open_event.end());
      return out;
    }
    out.insert(out.end(),
               {static_cast<double>(grid_.step0), grid_.time0, grid_.dt,
                static_cast<double>(grid_.interval), static_cast<double>(grid_.bins),
                static_cast<double>(rupture_counts_.events),
                static_cast<double>(rupture_counts_.dropped_nonpositive),
                static_cast<double>(rupture_counts_.dropped_small), rupture_counts_.last_size});
    const std::vector<double> written =
        history_ && history_->is_open() ? history_->state() : std::vector<double>();
    for (const auto &list : {open_sums, finder_->state(), written}) {
      out.push_back(static_cast<double>(list.size()));
      out.insert(out.end(), list.begin(), list.end());
    }
    return out;
  }

  /// Begins the files, or goes on with them: what is in the way is found before the first one is
  /// touched. from_restart: set_state() was called; clock: for the series; others: files that
  /// something else writes. \throws EventStreamError or what the writers throw
  void begin_files(std::int64_t step, bool from_restart, const SceneInfo &scene,
                   const StepClock &clock, const std::vector<Output> &others = {}) {
    claim_.claim({{"catalogue", settings_.catalogue_file},
                  {"series", settings_.series_file},
                  {"history", settings_.history_file}},
                 others);
    try {
      open_files(step, from_restart, scene, clock);
    } catch (...) {
      claim_.release();
      throw;
    }
  }

  /// The fault before its first interval, with the sums of its contacts over the ranks.
  void begin_fault(double pe, const std::vector<double> &sums) {
    const FaultRow row = fault_row(grid_, sums.data(), 1);
    finder_->begin(pe, row);
    if (history_)
      history_->create(settings_.history_file, history_info_, grid_.step0, pe, row.stress);
  }

  /// The samples of a block. time_of(step): model time; the fault begins at x0 and has that length.
  /// \throws EventStreamError or what the writers throw, at the first sample that is at fault
  template <class TimeOf>
  void add_block(const GatheredBlock &block, TimeOf &&time_of, double x0, double length) {
    std::vector<std::vector<BinSlip>> slips;
    if (settings_.location) slips = block.slip_by_step();
    const double *sums = block.intervals.data();
    for (int n = 0; n < block.count; ++n) {
      const std::int64_t step = block.first + n;
      const double pe = block.total(n);
      add_sample(step, time_of(step), pe,
                 settings_.location ? &slips[static_cast<std::size_t>(n)] : nullptr, x0, length);
      if (!settings_.ruptures || !grid_.ends_interval(step)) continue;
      add_interval(step, pe, sums, time_of);
      sums += FaultSums::fields * static_cast<std::size_t>(grid_.bins);
    }
  }

  /// Writes open ruptures with the end that they have by now; nothing may be added afterwards.
  void write_unfinished() {
    if (finder_) finder_->each_open_as_ended([this](const Event &rupture) { finish(rupture); });
  }

  /// Hands all samples so far to the system.
  void flush() {
    if (series_) series_->flush();
  }

  /// Another time step: the picker goes on with these settings; its rate is one per step, so it is
  /// multiplied by the ratio of the steps.
  void change_picker(const PickerSettings &settings, double ratio) {
    settings_.picker = settings;
    PickerState state = picker_.state();
    state.rate *= ratio;
    picker_ = EventPicker(settings);
    picker_.set_state(state);
  }
  /// PE changed by that much since the last sample, without a step.
  void leave_out_jump(double jump) {
    PickerState state = picker_.state();
    state.pe += jump;
    state.pe_start += jump;
    picker_.set_state(state);
  }

  const EventPicker &picker() const { return picker_; }
  /// Numbers of events of the kind that is written.
  const PickerState &counts() const {
    return settings_.ruptures ? rupture_counts_ : picker_.state();
  }
  /// Events, or ruptures, that have begun and not ended.
  std::int64_t open() const {
    return settings_.ruptures ? finder_->open() : picker_.in_event() ? 1 : 0;
  }

 private:
  /// Step up to which the ends of events are known at a restart.
  std::int64_t last_known_end(std::int64_t step) const {
    // A rupture is known to have ended when its pause is over.
    if (settings_.ruptures)
      return interval_end(finder_->intervals() - settings_.rupture_settings(grid_.dt).memory);
    // An event that ended at the restart step is only known one step later, and comes again.
    return step - 1;
  }

  bool goes_on(const std::string &file) const {
    std::error_code code;
    return settings_.resume && !file.empty() && std::filesystem::exists(file, code);
  }

  std::int64_t interval_end(std::int64_t intervals) const {
    return grid_.step0 + intervals * grid_.interval;
  }

  void check_files(bool from_restart) const {
    const std::string who = "Compute lsm/events ";
    const std::string &name = settings_.name;
    for (const auto &[file, key] :
         {std::pair<const std::string &, const char *>{settings_.catalogue_file, "catalogue"},
          {settings_.series_file, "series"},
          {settings_.history_file, "history"}}) {
      if (file.empty()) continue;
      if (goes_on(file) && !from_restart)
        throw EventStreamError(who + "resume yes: file " + file +
                               " exists, but the restart file holds no picker state of compute " +
                               name + "; read a restart written while it was active");
      if (goes_on(file) && settings_.ruptures && !ruptures_go_on_ && file != settings_.series_file)
        throw EventStreamError(who + "resume yes: file " + file +
                               " exists, but the restart file holds no ruptures of compute " +
                               name +
                               " with these bins and intervals; give another name, or replace it "
                               "with overwrite yes and resume no");
      if (!goes_on(file) && !settings_.overwrite && text_io::holds_data(file))
        throw EventStreamError(who + key + ": file " + file +
                               " exists; give another name, or replace it with overwrite yes" +
                               (from_restart ? ", or go on with it with resume yes" : ""));
      const std::string problem = text_io::why_not_writable(file);
      if (!problem.empty()) throw EventStreamError(problem);
    }
  }

  void open_files(std::int64_t step, bool from_restart, const SceneInfo &scene,
                  const StepClock &clock) {
    check_files(from_restart);
    const bool catalogue_goes_on = goes_on(settings_.catalogue_file);
    const bool series_goes_on = goes_on(settings_.series_file);
    const std::vector<std::string> free_to_change = {"program", "ranks", "links"};
    const CatalogueInfo catalogue_info =
        catalogue_header(settings_, scene, settings_.ruptures, grid_.width);
    PeSeriesInfo series_info;
    if (!settings_.catalogue_file.empty()) {
      catalogue_ = std::make_unique<CatalogueWriter>();
      if (catalogue_goes_on)
        catalogue_->find_cut(settings_.catalogue_file, catalogue_info, last_known_end(step),
                             free_to_change, counts().events);
    }
    if (!settings_.series_file.empty()) {
      series_info = series_header(settings_, scene, clock);
      series_ = std::make_unique<PeSeriesWriter>();
      if (series_goes_on)
        series_->find_cut(settings_.series_file, series_info, settings_.series_binary, step,
                          free_to_change);
    }
    if (!settings_.history_file.empty()) {
      history_info_ = history_header(settings_, scene, grid_);
      history_ = std::make_unique<SlipHistoryWriter>();
      if (goes_on(settings_.history_file))
        history_->resume(settings_.history_file, history_info_, saved_history_, free_to_change);
    }

    // All fit.
    if (catalogue_)
      catalogue_goes_on ? static_cast<void>(catalogue_->cut())
                        : catalogue_->create(settings_.catalogue_file, catalogue_info);
    if (series_)
      series_goes_on ? static_cast<void>(series_->cut())
                     : series_->create(settings_.series_file, series_info, settings_.series_binary);
    if (history_ && !history_->is_open() && ruptures_go_on_)
      history_->create(settings_.history_file, history_info_, interval_end(finder_->intervals()),
                       finder_->pe(), finder_->stress());
  }

  void add_sample(std::int64_t step, double time, double pe, const std::vector<BinSlip> *slips,
                  double x0, double length) {
    if (!std::isfinite(pe)) {
      if (series_) series_->flush();
      throw EventStreamError("Potential energy is not finite at step " + std::to_string(step) +
                             "; the catalogue ends with the last event before it. Use a smaller "
                             "time step or start from an earlier restart");
    }
    if (series_ && step % settings_.series_stride == 0) series_->write(step, time, pe);

    Event event;
    const bool was_open = picker_.in_event();
    const bool ended = picker_.push(step, time, pe, event);
    if (ended && slips) locator_.locate(x0, length, event);
    if (ended && catalogue_ && !settings_.ruptures) catalogue_->write(event);
    if (!slips) return;
    if (was_open && !picker_.in_event()) locator_.clear();
    if (picker_.in_event()) locator_.add(*slips);
  }

  template <class TimeOf>
  void add_interval(std::int64_t step, double pe, const double *sums, TimeOf &&time_of) {
    const FaultRow row = fault_row(grid_, sums, grid_.interval);
    finder_->add(pe, row, [this, &time_of](Event rupture) {
      if (settings_.own_times) {
        rupture.t_start = time_of(rupture.step_start);
        rupture.t_end = time_of(rupture.step_end);
      }
      finish(rupture);
    });
    if (history_) history_->add(step, pe, row, finder_->active());
  }

  void finish(Event rupture) {
    if (!(rupture.size > 0.0)) {
      if (!settings_.picker.keep_nonpositive) {
        ++rupture_counts_.dropped_nonpositive;
        return;
      }
    } else if (rupture.size < settings_.picker.min_size) {
      ++rupture_counts_.dropped_small;
      return;
    }
    rupture.id = ++rupture_counts_.events;
    rupture_counts_.last_size = rupture.size;
    if (catalogue_) catalogue_->write(rupture);
  }

  EventSettings settings_;
  EventPicker picker_;
  EventLocator locator_;

  FaultGrid grid_;
  std::unique_ptr<RuptureFinder> finder_;
  PickerState rupture_counts_;  // only the numbers of events
  bool ruptures_go_on_ = false;
  std::vector<double> saved_history_;

  OutputClaim claim_;  // outlives the writers
  std::unique_ptr<CatalogueWriter> catalogue_;
  std::unique_ptr<PeSeriesWriter> series_;
  std::unique_ptr<SlipHistoryWriter> history_;
  SlipHistoryInfo history_info_;
};

}  // namespace LSM

#endif
