// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/event_stream.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

namespace LSM {

bool SavedStream::read(const std::vector<double> &from, std::size_t at) {
  if (from.size() < at) return false;
  try {
    StateReader in(from, at);
    visit(*this, in);
    return in.left() == 0;
  } catch (const std::invalid_argument &) {
    return false;
  }
}

bool SavedStream::continues_with(const FaultGrid &other, bool finds_ruptures) const {
  return has_slip() && finder.empty() != finds_ruptures && grid.dt == other.dt &&
         grid.interval == other.interval && grid.bins == other.bins &&
         open_sums.size() == fields_of(other) * static_cast<std::size_t>(other.cells());
}

FaultGrid SavedStream::continued(FaultGrid other) const {
  other.step0 = grid.step0;
  other.time0 = grid.time0;
  return other;
}

EventStream::EventStream(const EventSettings &settings)
    : settings_(settings),
      picker_(settings.picker),
      drops_(settings.drops),
      ruptures_(settings.ruptures) {}

void EventStream::set_grid(const FaultGrid &grid) {
  grid_ = grid;
  if (!grid.plane) locator_.emplace(grid, settings_.modulus, settings_.fraction);
  if (settings_.finds_ruptures()) finder_.emplace(grid, settings_.rupture_settings(grid.dt));
  friction_ = {};
  slip_continues_ = false;
}

void EventStream::set_state(const SavedStream &saved) {
  picker_.set_state(saved.picker);
  drops_.set_counts(saved.drops);
  ruptures_.set_counts(saved.ruptures);
  if (!records_slip() || !saved.continues_with(grid_, finder_.has_value())) return;
  if (locator_) locator_->set_state(saved.locator);
  if (finder_) finder_->set_state(saved.finder);
  friction_ = saved.friction;
  saved_history_ = saved.history;
  slip_continues_ = true;
}

std::vector<double> EventStream::state(const std::vector<double> &open_sums) const {
  SavedStream now;
  now.picker = picker_.state();
  now.drops = drops();
  now.ruptures = ruptures();
  now.grid = grid_;
  now.friction = friction_;
  now.open_sums = open_sums;
  if (locator_) now.locator = locator_->state();
  if (finder_) now.finder = finder_->state();
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
  if (!finder_) return;
  const FaultRow row = fault_row(grid_, sums.data(), 1);
  finder_->begin(grid_.time0, pe, row);
  if (!settings_.history_file.empty())
    history_.create(settings_.history_file, history_info_, grid_.step0, pe, row.stress);
}

void EventStream::add_block(const GatheredBlock &block, const TimeOfStep &time_of) {
  last_sums_.clear();
  const double *sums = block.intervals.data();
  for (int n = 0; n < block.count; ++n) {
    const std::int64_t step = block.first + n;
    const double time = time_of(step), pe = block.total(n);
    add_sample(step, time, pe,
               block.friction.empty() ? 0.0 : block.friction[static_cast<std::size_t>(n)]);
    if (!records_slip() || !grid_.ends_interval(step)) continue;
    add_interval(step, time, pe, sums);
    sums += fields_of(grid_) * static_cast<std::size_t>(grid_.cells());
  }
}

void EventStream::end_run(std::int64_t step, const std::vector<double> &open_sums) {
  last_step_ = step;
  last_sums_ = open_sums;
}

void EventStream::write_rest(bool open_ruptures) {
  // After an error within a run the slip of the incomplete interval is not known.
  const std::int64_t steps = last_sums_.empty() ? 0 : (last_step_ - grid_.step0) % grid_.interval;
  if (locator_ && steps > 0)
    locator_->finish(last_step_, fault_row(grid_, last_sums_.data(), steps),
                     [this](const Drop &drop) { write_drop(drop); });
  if (finder_ && open_ruptures)
    finder_->each_open_as_ended([this](const FaultRupture &r) { write_rupture(r); });
}

Picked EventStream::picked() const {
  return {static_cast<double>(drops().events),
          drops().last_size,
          picker_.rate(),
          picker_.in_event() ? 1.0 : 0.0,
          static_cast<double>(ruptures().events),
          ruptures().last_size,
          static_cast<double>(open_ruptures())};
}

void EventStream::change_picker(const PickerSettings &settings, double ratio) {
  settings_.picker = settings;
  picker_.change(settings, ratio);
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
    const bool of_slip = key == "catalogue" ? locator_.has_value() : records_slip();
    if (resumes(file) && of_slip && !slip_continues_ && file != settings_.series_file)
      throw EventStreamError(who + "resume yes: file " + file +
                             " exists, but the restart file holds no slip of compute " + name +
                             " with these bins and intervals; give another name, or replace it "
                             "with overwrite yes and resume no");
    if (!resumes(file) && !settings_.overwrite && files::holds_data(file))
      throw EventStreamError(who + key + ": file " + file +
                             " exists; give another name, or replace it with overwrite yes" +
                             (from_restart ? ", or continue it with resume yes" : ""));
    const std::string problem = files::why_not_writable(file);
    if (!problem.empty()) throw EventStreamError(problem);
  }
}

void EventStream::open_files(std::int64_t step, bool from_restart, const SceneInfo &scene,
                             const StepClock &clock) {
  check_files(from_restart);
  const std::string &catalogue = settings_.catalogue_file, &series = settings_.series_file,
                    &ruptures = settings_.ruptures_file, &history = settings_.history_file;
  const CatalogueInfo drops_info = drops_header(settings_, scene, grid_),
                      ruptures_info = ruptures_header(settings_, scene, grid_);
  const PeSeriesInfo series_info = series_header(settings_, scene, clock);
  history_info_ = history_header(settings_, scene, grid_);
  if (resumes(catalogue)) catalogue_.find_cut(catalogue, drops_info, drops().events);
  if (resumes(ruptures))
    rupture_catalogue_.find_cut(ruptures, ruptures_info, this->ruptures().events);
  if (resumes(series)) series_.find_cut(series, series_info, step);
  if (resumes(history)) history_.find_cut(history, history_info_, saved_history_);

  // All files can be continued, so now they may be changed.
  if (resumes(catalogue))
    catalogue_.cut();
  else if (!catalogue.empty())
    catalogue_.create(catalogue, drops_info);
  if (resumes(ruptures))
    rupture_catalogue_.cut();
  else if (!ruptures.empty())
    rupture_catalogue_.create(ruptures, ruptures_info);
  if (resumes(series))
    series_.cut();
  else if (!series.empty())
    series_.create(series, series_info);
  if (resumes(history)) {
    history_.cut();
  } else if (!history.empty() && slip_continues_) {
    const FaultMoment last = finder_->last_interval();
    history_.create(history, history_info_, grid_.step0 + last.intervals * grid_.interval, last.pe,
                    last.stress);
  }
}

void EventStream::add_sample(std::int64_t step, double time, double pe, double friction) {
  if (!std::isfinite(pe)) {
    series_.flush();
    throw EventStreamError("Potential energy is not finite at step " + std::to_string(step) +
                           "; the catalogue ends with the last event before it. Use a smaller "
                           "time step or start from an earlier restart");
  }
  if (series_.is_open() && step % settings_.series_stride == 0) series_.write(step, time, pe);
  // A drop begins and ends at the sample before the one that shows it.
  const double until_now = friction_.total.value();
  friction_.total.add(friction);
  Drop drop;
  const bool open = picker_.in_event(), ended = picker_.push(step, time, pe, drop);
  if (!open) friction_.at_start = until_now;
  if (!ended) return;
  drop.friction_work = until_now - friction_.at_start;
  drop.friction_total = until_now;
  if (!drops_.passes(drop)) {
    if (locator_) locator_->forget_open();
    return;
  }
  if (locator_)
    locator_->add(drop, [this](const Drop &located) { write_drop(located); });
  else
    write_drop(drop);
}

void EventStream::add_interval(std::int64_t step, double time, double pe, const double *sums) {
  const FaultRow row = fault_row(grid_, sums, grid_.interval);
  std::optional<std::int64_t> begun;
  if (picker_.in_event()) begun = picker_.state().step_start;
  if (locator_)
    locator_->add_interval(step, row, begun, [this](const Drop &drop) { write_drop(drop); });
  if (!finder_) return;
  finder_->add(time, pe, row, [this](const FaultRupture &r) { write_rupture(r); });
  if (history_.is_open()) history_.add(step, pe, row, finder_->active());
}

void EventStream::write_drop(Drop drop) {
  drops_.number(drop);
  if (catalogue_.is_open()) catalogue_.write(drop);
}

void EventStream::write_rupture(const FaultRupture &found) {
  const auto write = [this](auto rupture) {
    if (!ruptures_.passes(rupture)) return;
    ruptures_.number(rupture);
    if (rupture_catalogue_.is_open()) rupture_catalogue_.write(rupture);
  };
  if (grid_.plane)
    write(finder_->plane_rupture(found));
  else
    write(finder_->rupture(found));
}

}  // namespace LSM
