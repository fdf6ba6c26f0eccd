// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/event_stream.h"

#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

namespace LSM {

bool SavedStream::read(const std::vector<double> &from, std::size_t at, std::size_t of_kind) {
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

bool SavedStream::continues_with(std::size_t other_kind, const FaultGrid &other) const {
  return kind == other_kind && grid.dt == other.dt && grid.interval == other.interval &&
         grid.bins == other.bins;
}

EventStream::EventStream(const EventSettings &settings)
    : settings_(settings), kind_(number_of(*settings.kind)), picker_(settings.picker) {
  if (!settings.kind->wants_intervals()) finder_ = settings.kind->finder(settings, grid_);
}

void EventStream::set_grid(const FaultGrid &grid) {
  grid_ = grid;
  finder_ = settings_.kind->finder(settings_, grid);
  continues_ = false;
}

void EventStream::set_state(const SavedStream &saved) {
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

std::vector<double> EventStream::state(const std::vector<double> &open_sums) const {
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

void EventStream::begin_files(std::int64_t step, bool from_restart, const SceneInfo &scene,
                              const StepClock &clock, const std::vector<Output> &others) {
  OutputClaim claim = claim_outputs(files_of(settings_), others);
  open_files(step, from_restart, scene, clock);
  claim_ = std::move(claim);
}

void EventStream::begin_fault(double pe, const std::vector<double> &sums) {
  const FaultRow row = fault_row(grid_, sums.data(), 1);
  finder_->begin(pe, row);
  if (!settings_.history_file.empty())
    history_.create(settings_.history_file, history_info_, grid_.step0, pe, row.stress);
}

void EventStream::add_block(const GatheredBlock &block, const TimeOfStep &time_of, double x0,
                            double length) {
  const bool with_slips = settings_.kind->wants_slips();
  const bool with_intervals = settings_.kind->wants_intervals();
  std::vector<std::vector<BinSlip>> slips;
  if (with_slips) slips = block.slip_by_step();
  const double *sums = block.intervals.data();
  for (int n = 0; n < block.count; ++n) {
    const std::int64_t step = block.first + n;
    const double pe = block.total(n);
    add_sample({step, time_of(step), pe, with_slips ? &slips[static_cast<std::size_t>(n)] : nullptr,
                x0, length});
    if (!with_intervals || !grid_.ends_interval(step)) continue;
    add_interval(step, pe, sums, time_of);
    sums += fault_fields * static_cast<std::size_t>(grid_.bins);
  }
}

void EventStream::write_unfinished() {
  finder_->each_open_as_ended([this](const Event &event) { finish(event); });
}

void EventStream::change_picker(const PickerSettings &settings, double ratio) {
  settings_.picker = settings;
  picker_.change(settings, ratio);
  if (finder_) finder_->change_picker(settings, ratio);
}

void EventStream::leave_out_jump(double jump) {
  picker_.leave_out_jump(jump);
  if (finder_) finder_->leave_out_jump(jump);
}

bool EventStream::resumes(const std::string &file) const {
  std::error_code code;
  return settings_.resume && !file.empty() && std::filesystem::exists(file, code);
}

void EventStream::check_files(bool from_restart) const {
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

void EventStream::open_files(std::int64_t step, bool from_restart, const SceneInfo &scene,
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

  // All files can be continued, so now they may be changed.
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
    history_.create(history, history_info_, grid_.step0 + last.intervals * grid_.interval, last.pe,
                    last.stress);
  }
}

void EventStream::add_sample(const EventSample &sample) {
  if (!std::isfinite(sample.pe)) {
    series_.flush();
    throw EventStreamError("Potential energy is not finite at step " + std::to_string(sample.step) +
                           "; the catalogue ends with the last event before it. Use a smaller "
                           "time step or start from an earlier restart");
  }
  if (series_.is_open() && sample.step % settings_.series_stride == 0)
    series_.write(sample.step, sample.time, sample.pe);
  Event drop;
  picker_.push(sample.step, sample.time, sample.pe, drop);
  finder_->add_sample(sample, [this](const Event &event) { finish(event); });
}

void EventStream::add_interval(std::int64_t step, double pe, const double *sums,
                               const TimeOfStep &time_of) {
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

void EventStream::finish(Event event) {
  if (is_left_out(event.size, settings_.picker, counts_)) return;
  event.id = ++counts_.events;
  counts_.last_size = event.size;
  if (catalogue_.is_open()) catalogue_.write(event);
}

}  // namespace LSM
