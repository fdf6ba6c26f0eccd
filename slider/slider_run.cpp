// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "files/file_error.h"
#include "files/output_file.h"
#include "files/replaced_file.h"
#include "numerics/circular_mean.h"
#include "slider_chain.h"
#include "slider_checkpoint.h"
#include "slider_output.h"
#include "slider_ruptures.h"

namespace Slider {

void probe(const std::string &path) {
  const std::string problem = path.empty() ? path : LSM::files::why_not_writable(path);
  if (!problem.empty()) throw LSM::FileError(problem);
}

std::vector<LSM::Output> outputs_of(const RunOptions &o) {
  return {{"--catalogue", o.catalogue}, {"--pe-series", o.series}, {"--checkpoint", o.checkpoint}};
}

void check_replaced(const RunOptions &o) {
  if (o.resume || o.overwrite) return;
  for (const auto &[option, path] : outputs_of(o))
    if (!LSM::why_kept(path).empty())
      throw std::runtime_error(path + ": exists, expected a new file for " + option +
                               "; --overwrite replaces it, --resume continues it");
}

namespace {

using Clock = std::chrono::steady_clock;

/// The common part of runs with both kinds of events.
class Run {
 public:
  explicit Run(const RunOptions &options)
      : o_(options),
        chain_(o_.parameters, o_.mu, o_.dense),
        filter_(o_.filter),
        outputs_(o_),
        calm_(std::max<std::int64_t>(1, std::llround(leap_calm / o_.parameters.dt))),
        look_(std::max<std::int64_t>(1, std::llround(1.0 / o_.parameters.dt))) {
    if (o_.leap_speed == 0.0) next_look_ = std::numeric_limits<std::int64_t>::max();
  }
  virtual ~Run() = default;
  Run(const Run &) = delete;
  Run &operator=(const Run &) = delete;

  RunResult execute();

 protected:
  virtual void restore() = 0;
  virtual void save() = 0;
  /// Takes one step, or several in which nothing slides, but none beyond `limit`.
  virtual void advance(std::int64_t limit) = 0;

  /// Whether a leap may begin here: some block moves, so that quiet steps cannot be jumped over,
  /// but none has been fast for a while. This depends only on the state of the chain and is checked
  /// at fixed steps, so that a run continued from a checkpoint leaps where the uninterrupted one
  /// does.
  /// \param at_rest whether to leap when nothing moves, too
  bool may_leap(bool at_rest) {
    const std::int64_t step = chain_.step();
    if (step < next_look_) return false;
    next_look_ = (step / look_ + 1) * look_;
    if (step % look_ != 0) return false;
    const double v = chain_.fastest();
    if (v > o_.leap_speed) state_.calm_since = step;
    return (v > 0.0 || at_rest) && step - state_.calm_since >= calm_;
  }
  /// Leaps if it is worthwhile, see Chain::leap(). A leap should not be shorter than the calm
  /// period that has to pass before the next one.
  bool leap(bool falls, bool rises) {
    const std::int64_t from = chain_.step();
    const bool done = chain_.leap(o_.steps, calm_, o_.leap_speed, falls, rises);
    state_.calm_since = chain_.step();
    if (!done) return false;
    ++result_.leaps;
    result_.leapt += chain_.step() - from;
    for (auto s = outputs_.next_sample(from); s < chain_.step(); s = outputs_.next_sample(s))
      outputs_.sample(s, chain_.pe_in_leap(s));
    return true;
  }

  /// Writes an event that has passed the filter.
  template <class Kind>
  void write(Kind e) {
    filter_.number(e);
    state_.largest = std::max(state_.largest, e.size);
    outputs_.event(e);
  }

  const Clock::time_point begin_ = Clock::now();
  const RunOptions &o_;
  Chain chain_;
  LSM::EventFilter filter_;
  Outputs outputs_;
  RunState state_;
  RunResult result_;

 private:
  void begin();
  void keep_state();
  void announce();

  std::vector<std::string> settings_;         // everything that influences the result
  std::int64_t calm_, look_, next_look_ = 0;  // in steps
  std::int64_t eventless_until_ = 0, announced_at_ = 100000;
};

/// A run whose events are drops of the PE of the whole chain.
class PeRun : public Run {
 public:
  explicit PeRun(const RunOptions &options)
      : Run(options),
        picker_(o_.picker),
        strongest_(o_.parameters.landscape.length > 0.0
                       ? o_.parameters.landscape.high
                       : *std::max_element(o_.mu.begin(), o_.mu.end())) {
    picker_.push_change(0, 0.0, chain_.pe(), 0.0, event_);
    // After this many steps the initial state of the picker has decayed below rounding.
    const double memory = o_.picker.reading == LSM::PickerReading::exponential
                              ? 45.0 / std::max(1.0 - o_.picker.lambda, 1e-15)
                              : 100.0;
    replay_ = static_cast<std::int64_t>(std::min(memory, 1e15)) + 1;
  }

 private:
  void restore() override { picker_.set_state(state_.picker); }
  void save() override { state_.picker = picker_.state(); }

  void advance(std::int64_t limit) override {
    const std::int64_t from = chain_.step();
    const bool falls = picker_.in_event();
    // Within a leap PE only rises, or within an event only falls.
    if ((!falls && jump(limit)) ||
        (may_leap(falls) && (picker_.rate() < 0.0) == falls && leap(falls, !falls))) {
      extrapolate_picker(from);
      return;
    }
    chain_.advance();
    const bool ended =
        picker_.push_change(chain_.step(), o_.parameters.dt * static_cast<double>(chain_.step()),
                            chain_.pe(), chain_.dpe(), event_);
    // Slip is sampled one step late at both ends, which matters less than the error of the scheme.
    if (picker_.in_event() && !falls) {
      state_.slip_start = chain_.slip_sum();
      if (located()) state_.u_start = chain_.displacements();
    }
    if (!ended || !filter_.passes(event_)) return;
    LSM::Drop drop{event_};
    drop.slip_moment = chain_.slip_sum() - state_.slip_start;
    if (is_by_plate(drop, strongest_)) {
      ++state_.by_plate;
      if (!o_.keep_by_plate) return;
    }
    if (located()) locate(drop);
    write(drop);
  }

  /// Jumps over steps in which nothing slips: only the plate changes PE then, and no event can
  /// begin while it raises PE. During an event, steps are taken one by one. Returns false if there
  /// is nothing to jump over.
  bool jump(std::int64_t limit) {
    const std::int64_t from = chain_.step();
    const std::int64_t quiet = chain_.quiet_until();
    if (quiet <= from + replay_) return false;
    // The next sample of the series is taken by an ordinary step.
    const std::int64_t to = std::min({quiet, limit, outputs_.next_sample(from) - 1}) - replay_;
    if (!(to > from && picker_.rate() >= 0.0 && chain_.quiet_change(from) > 0.0)) return false;
    result_.jumped += to - from;
    chain_.jump(to);
    return true;
  }

  /// Brings the picker up to date after steps that all had the same change of PE.
  void extrapolate_picker(std::int64_t from) {
    LSM::PickerState s = picker_.state();
    s.samples += chain_.step() - from;
    s.step = chain_.step();
    s.time = o_.parameters.dt * static_cast<double>(s.step);
    s.pe = chain_.pe();
    s.rate = chain_.dpe();
    if (o_.picker.reading == LSM::PickerReading::literal)
      s.rate /= 1.0 + o_.picker.lambda * static_cast<double>(s.samples - 2);
    // A leap to where PE begins or ceases to fall may end up to one step later, as the next step
    // will show.
    s.rate = s.in_event != 0 ? std::min(s.rate, 0.0) : std::max(s.rate, 0.0);
    picker_.set_state(s);
  }

  bool located() const { return o_.x_centroid || o_.rupture_length; }

  void locate(LSM::Drop &drop) const {
    const std::vector<double> u = chain_.displacements();
    LSM::CircularMean mean(static_cast<double>(u.size()));
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double slip = u[i] - state_.u_start[i];
      if (slip > 0.0) drop.rupture_length += 1.0;
      mean.add(static_cast<double>(i), slip);
    }
    drop.x_centroid = mean.position();
  }

  LSM::EventPicker picker_;
  LSM::Event event_;
  double strongest_;
  std::int64_t replay_ = 0;
};

/// A run whose events are ruptures, see slider_ruptures.h.
class RuptureRun : public Run {
 public:
  explicit RuptureRun(const RunOptions &options)
      : Run(options), tracker_(o_.parameters.blocks, 1, o_.x_centroid) {}

 private:
  void restore() override { tracker_.set_state(state_.ruptures, chain_.step()); }
  void save() override { state_.ruptures = tracker_.state(); }

  void advance(std::int64_t limit) override {
    if (tracker_.idle() && chain_.quiet_until() > chain_.step() + 1) {
      const std::int64_t to =
          std::min({chain_.quiet_until(), limit, outputs_.next_sample(chain_.step())});
      result_.jumped += to - chain_.step() - 1;
      chain_.jump(to);
      return;
    }
    if (may_leap(false) && leap(true, true)) {
      // Slip within a leap is not counted as a rupture, and ruptures before it have ended.
      tracker_.begin_step(chain_.step(), chain_.pe());
    } else {
      chain_.advance(tracker_);
    }
    if (!std::isfinite(chain_.dpe()) || !std::isfinite(chain_.pe()))
      throw std::runtime_error("potential energy at step " + std::to_string(chain_.step()) +
                               " is not a finite number");
    tracker_.end_step(chain_.pe(), [this](const Rupture &rupture) {
      const LSM::Rupture e = tracker_.event(rupture, o_.parameters.dt);
      if (filter_.passes(e)) write(e);
    });
  }

  RuptureTracker tracker_;
};

/// Starts new files or continues those of a checkpoint.
void Run::begin() {
  for (const auto &[key, value] : o_.header) settings_.push_back(key + " = " + value);
  if (o_.resume) {
    state_ = read_checkpoint(o_.checkpoint, settings_);
    if (state_.chain.step > o_.steps)
      throw std::runtime_error(
          fmt::format("{}: cannot resume: {} steps are done, expected at least "
                      "as many with --steps or --time, not {}",
                      o_.checkpoint, state_.chain.step, o_.steps));
    chain_.set_state(state_.chain);
    filter_.set_counts(state_);
    restore();
    outputs_.resume(chain_.step(), state_.events);
  } else {
    outputs_.create(chain_.pe());
  }
  result_.first_step = chain_.step();
}

void Run::keep_state() {
  static_cast<LSM::FilterCounts &>(state_) = filter_.counts();
  save();
  if (o_.checkpoint.empty()) return;
  outputs_.flush();
  state_.chain = chain_.state();
  write_checkpoint(o_.checkpoint, settings_, state_);
}

/// Announces once how large the catalogue will become, while the run can still be stopped.
void Run::announce() {
  const std::int64_t events = filter_.counts().events;
  if (events == 0) eventless_until_ = chain_.step();
  if (o_.catalogue.empty() || events < announced_at_) return;
  announced_at_ = std::numeric_limits<std::int64_t>::max();
  const double grows = static_cast<double>(o_.steps - eventless_until_) /
                       static_cast<double>(chain_.step() - eventless_until_);
  std::error_code unknown;  // a pipe has no size
  const auto bytes = std::filesystem::file_size(o_.catalogue, unknown);
  const std::string size =
      unknown ? "" : fmt::format(", {:.0f} MB", 1e-6 * grows * static_cast<double>(bytes));
  fmt::print(stderr,
             "slider_cli: {}: {} events at step {} of {}, at this rate {:.2g} in all{}; --min-size "
             "leaves small ones out\n",
             o_.catalogue, events, chain_.step(), o_.steps, grows * static_cast<double>(events),
             size);
}

RunResult Run::execute() {
  begin();
  const std::int64_t interval = o_.checkpoint.empty() ? 0 : o_.checkpoint_interval;
  // Steps between checks of signals and the clock.
  const std::int64_t look = std::max<std::int64_t>(16, 200000 / (o_.parameters.blocks + 100));
  Clock::time_point shown = begin_;
  while (chain_.step() < o_.steps && result_.interrupted == 0) {
    std::int64_t limit = o_.steps;
    if (interval > 0) limit = std::min(limit, (chain_.step() / interval + 1) * interval);
    const std::int64_t pause = std::min(limit, chain_.step() + look);
    while (chain_.step() < pause) {
      advance(limit);
      outputs_.sample(chain_.step(), chain_.pe());
    }
    if (chain_.step() >= o_.steps) break;
    // A leap may end beyond the limit.
    if (interval > 0 && chain_.step() >= limit) keep_state();
    announce();
    if (o_.stop) result_.interrupted = o_.stop->load(std::memory_order_relaxed);
    if (!o_.progress || Clock::now() - shown < std::chrono::seconds(1)) continue;
    shown = Clock::now();
    std::fprintf(stderr, "step %lld of %lld, %lld events\n", static_cast<long long>(chain_.step()),
                 static_cast<long long>(o_.steps), static_cast<long long>(filter_.counts().events));
  }
  keep_state();
  outputs_.close();
  static_cast<EventCounts &>(result_) = state_;
  result_.steps = chain_.step();
  result_.moved = chain_.moved();
  result_.pe = chain_.pe();
  result_.pe_direct = direct_energy(o_.parameters, chain_.displacements(), chain_.plate());
  result_.mean_slip = chain_.slip_sum() / o_.parameters.blocks;
  result_.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  return result_;
}

}  // namespace

RunResult run(const RunOptions &o) {
  return o.events == Events::ruptures ? RuptureRun(o).execute() : PeRun(o).execute();
}

}  // namespace Slider
