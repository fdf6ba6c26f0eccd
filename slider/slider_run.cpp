// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "lsm_circular_mean.h"
#include "lsm_text_io.h"
#include "slider_chain.h"
#include "slider_checkpoint.h"
#include "slider_output.h"
#include "slider_ruptures.h"

namespace Slider {

void check_leaps(const RunOptions &o) {
  const auto fail = [](const char *option, double value, const char *expected) {
    char text[64];
    std::snprintf(text, sizeof text, "%.6g", value);
    throw std::invalid_argument(std::string(option) + " = " + text + ", expected " + expected);
  };
  if (!(o.leap_speed >= 0.0) || !std::isfinite(o.leap_speed))
    fail("--leap", o.leap_speed, "a finite number >= 0");
  if (o.leap_speed == 0.0) return;
  if (!(o.leap_calm > 0.0) || !(o.leap_calm < 1e15 * o.parameters.dt))
    fail("--leap-calm", o.leap_calm, "a positive number, less than 1e15 time steps");
}

void probe(const std::string &path) {
  const std::string problem = path.empty() ? path : LSM::text_io::why_not_writable(path);
  if (!problem.empty()) throw LSM::FileError(problem);
}

std::vector<LSM::Output> outputs_of(const RunOptions &o) {
  return {{"--catalogue", o.catalogue}, {"--pe-series", o.series}, {"--checkpoint", o.checkpoint}};
}

void check_replaced(const RunOptions &o) {
  if (o.resume || o.overwrite) return;
  for (const auto &[option, path] : outputs_of(o))
    if (LSM::text_io::holds_data(path))
      throw std::runtime_error(path + ": exists, expected a new file for " + option +
                               "; --overwrite replaces it, --resume continues it");
}

namespace {

using Clock = std::chrono::steady_clock;

/// The parts of a run.
struct Parts {
  const RunOptions &o;
  Chain &chain;
  RunState &state;
  Outputs &outputs;
  RunResult &result;
};

/// When to leap: a block moves, so that there is nothing to jump over, and none has been fast for a
/// while. Only the state of the chain decides, at the same steps in every run, so that a run
/// continued from a checkpoint leaps where the uninterrupted one does.
class Leaps : Parts {
 public:
  explicit Leaps(const Parts &parts) : Parts(parts) {
    const double dt = o.parameters.dt;
    calm_ = std::max<std::int64_t>(1, std::llround(o.leap_calm / dt));
    look_ = std::max<std::int64_t>(1, std::llround(1.0 / dt));
    next_ = o.leap_speed > 0.0 ? 0 : std::numeric_limits<std::int64_t>::max();
  }

  /// Whether a leap may begin here. \param at_rest also when nothing moves
  bool due(bool at_rest) {
    const std::int64_t step = chain.step();
    if (step < next_) return false;
    next_ = (step / look_ + 1) * look_;
    if (step % look_ != 0) return false;
    const double v = chain.fastest();
    if (v > o.leap_speed) state.calm_since = step;
    return (v > 0.0 || at_rest) && step - state.calm_since >= calm_;
  }
  /// See Chain::leap(). A leap shorter than the calm period that has to follow is not worth it.
  bool leap(bool falls, bool rises) {
    const std::int64_t from = chain.step();
    const bool done = chain.leap(o.steps, calm_, o.leap_speed, falls, rises);
    state.calm_since = chain.step();
    if (!done) return false;
    ++result.leaps;
    result.leapt += chain.step() - from;
    for (std::int64_t s = outputs.next_sample(from); s < chain.step(); s = outputs.next_sample(s))
      outputs.sample(s, chain.pe_in_leap(s));
    return true;
  }

 private:
  std::int64_t calm_ = 1, look_ = 1, next_ = 0;
};

/// Shared by both kinds of events.
class Recorder : protected Parts {
 protected:
  explicit Recorder(const Parts &parts) : Parts(parts), leaps_(parts) {}

  /// An event that has ended; false: it is not written, as the warm-up had not ended before it.
  bool count(LSM::Event &e) {
    if (e.t_start < o.warmup) {
      ++state.before_warmup;
      return false;
    }
    e.id = ++state.events;
    state.largest = std::max(state.largest, e.size);
    return true;
  }

  Leaps leaps_;
};

/// Events are drops of the PE of the whole chain.
class PeRecorder : Recorder {
 public:
  /// Number of samples after its end at which an event is found.
  static constexpr std::int64_t late = 1;

  explicit PeRecorder(const Parts &parts) : Recorder(parts), picker_(o.picker) {
    // After so many steps the picker has forgotten its initial state, to the last digit.
    const double memory = o.picker.reading == LSM::PickerReading::exponential
                              ? 45.0 / std::max(1.0 - o.picker.lambda, 1e-15)
                              : 100.0;
    replay_ = static_cast<std::int64_t>(std::min(memory, 1e15)) + 1;
  }

  void begin() {
    LSM::Event none;
    picker_.push_change(0, 0.0, chain.pe(), 0.0, none);
  }
  void restore() { picker_.set_state(state.picker); }
  void save() { state.picker = picker_.state(); }

  /// One step, or several in which nothing slides, up to limit at most.
  void advance(std::int64_t limit) {
    if (!picker_.in_event() && chain.quiet_until() > chain.step() + replay_ && jump(limit)) return;
    if (leaps_.due(picker_.in_event()) && leap()) return;
    chain.advance();
    const bool before = picker_.in_event();
    const bool report =
        picker_.push_change(chain.step(), o.parameters.dt * static_cast<double>(chain.step()),
                            chain.pe(), chain.dpe(), event_);
    // Slip is sampled one step late at both ends; the error is below that of a time step.
    if (picker_.in_event() && !before) open();
    if (report) finish();
  }

 private:
  bool located() const { return o.x_centroid || o.rupture_length; }

  /// Nothing slips: only the plate changes PE, and as long as it raises PE no event can begin. With
  /// an event open the steps are taken one by one. False: no jump is worth it.
  bool jump(std::int64_t limit) {
    const std::int64_t last = std::min(chain.quiet_until(), limit);
    // The next due sample is taken by a step.
    const std::int64_t to = std::min(last, outputs.next_sample(chain.step()) - 1) - replay_;
    if (!(to > chain.step() && picker_.rate() >= 0.0 && chain.quiet_change(chain.step()) > 0.0))
      return false;
    const std::int64_t from = chain.step();
    result.jumped += to - from;
    chain.jump(to);
    gone_on(from);
    return true;
  }

  /// PE rises, or within an event falls, from the beginning of a leap to its end.
  bool leap() {
    const bool falls = picker_.in_event();
    const std::int64_t from = chain.step();
    if ((picker_.rate() < 0.0) != falls || !leaps_.leap(falls, !falls)) return false;
    gone_on(from);
    return true;
  }

  /// The picker has had the same change of PE in each step since the given one.
  void gone_on(std::int64_t from) {
    LSM::PickerState s = picker_.state();
    s.samples += chain.step() - from;
    s.step = chain.step();
    s.time = o.parameters.dt * static_cast<double>(s.step);
    s.pe = chain.pe();
    s.rate = chain.dpe();
    if (o.picker.reading == LSM::PickerReading::literal)
      s.rate /= 1.0 + o.picker.lambda * static_cast<double>(s.samples - 2);
    // A leap to where PE begins or ceases to fall may end up to a step later; the next step shows
    // it.
    s.rate = s.in_event != 0 ? std::min(s.rate, 0.0) : std::max(s.rate, 0.0);
    picker_.set_state(s);
  }

  void open() {
    state.slip_start = chain.slip_sum();
    if (located()) state.u_start = chain.displacements();
  }

  void finish() {
    if (!count(event_)) return;
    event_.slip_moment = chain.slip_sum() - state.slip_start;
    if (located()) locate();
    outputs.event(event_);
  }

  void locate() {
    const std::vector<double> u = chain.displacements();
    LSM::CircularMean mean(static_cast<double>(u.size()));
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double slip = u[i] - state.u_start[i];
      if (slip > 0.0) event_.rupture_length += 1.0;
      mean.add(static_cast<double>(i), slip);
    }
    event_.x_centroid = mean.position();
  }

  LSM::EventPicker picker_;
  LSM::Event event_;
  std::int64_t replay_ = 0;
};

/// Events are ruptures, see slider_ruptures.h.
class RuptureRecorder : Recorder {
 public:
  explicit RuptureRecorder(const Parts &parts)
      : Recorder(parts),
        late(o.rupture_memory),
        tracker_(o.parameters.blocks, o.rupture_memory, o.x_centroid) {}

  /// Number of steps after its end at which a rupture is found: its memory.
  const std::int64_t late;

  void begin() {}
  void restore() { tracker_.set_state(state.ruptures, chain.step()); }
  void save() { state.ruptures = tracker_.state(); }

  /// One step, or several in which nothing slides, up to limit at most.
  void advance(std::int64_t limit) {
    if (tracker_.idle() && chain.quiet_until() > chain.step() + 1) {
      const std::int64_t to =
          std::min({chain.quiet_until(), limit, outputs.next_sample(chain.step())});
      result.jumped += to - chain.step() - 1;
      chain.jump(to);
      return;
    }
    if (leaps_.due(false) && leaps_.leap(true, true)) {
      // Slip within a leap is no rupture, and a rupture before the leap has ended.
      tracker_.begin_step(chain.step(), chain.pe());
    } else {
      chain.advance(tracker_);
    }
    if (!std::isfinite(chain.dpe()) || !std::isfinite(chain.pe()))
      throw std::runtime_error("potential energy at step " + std::to_string(chain.step()) +
                               " is not a finite number");
    tracker_.end_step(chain.pe(), [this](const Rupture &rupture) { finish(rupture); });
  }

 private:
  void finish(const Rupture &rupture) {
    LSM::Event e = tracker_.event(rupture, o.parameters.dt);
    // Counted as by the picker, for checkpoints.
    if (LSM::is_left_out(e.size, o.picker, state.picker)) return;
    if (!count(e)) return;
    outputs.event(e);
  }

  RuptureTracker tracker_;
};

/// Everything that shapes the result, as "key = value".
std::vector<std::string> settings_of(const RunOptions &o) {
  std::vector<std::string> lines;
  for (const auto &[key, value] : o.header) lines.push_back(key + " = " + value);
  lines.emplace_back("kernel = active or dense");
  return lines;
}

template <class Kind>
RunResult run_chain(const RunOptions &o) {
  const Clock::time_point begin = Clock::now();
  Chain chain(o.parameters, o.mu, o.kernel == Kernel::dense);
  RunState state;
  RunResult result;
  Outputs outputs(o);
  Kind recorder({o, chain, state, outputs, result});
  const std::vector<std::string> settings = settings_of(o);
  if (o.resume) {
    state = read_checkpoint(o.checkpoint, settings);
    chain.set_state(state.chain);
    recorder.restore();
    outputs.resume(chain.step(), state.events, recorder.late);
  } else {
    outputs.create(chain.pe());
    recorder.begin();
  }
  result.first_step = chain.step();

  const auto save = [&] {
    outputs.flush();
    state.chain = chain.state();
    recorder.save();
    write_checkpoint(o.checkpoint, settings, state);
  };
  const bool checkpoints = !o.checkpoint.empty();
  const std::int64_t interval = checkpoints ? o.checkpoint_interval : 0;
  // Steps between checks of signals and the clock.
  const std::int64_t look = std::max<std::int64_t>(16, 200000 / (o.parameters.blocks + 100));
  Clock::time_point told = begin;
  while (chain.step() < o.steps) {
    std::int64_t limit = o.steps;
    if (interval > 0) limit = std::min(limit, (chain.step() / interval + 1) * interval);
    const std::int64_t pause = std::min(limit, chain.step() + look);
    while (chain.step() < pause) {
      recorder.advance(limit);
      outputs.sample(chain.step(), chain.pe());
    }
    // A leap may end beyond the limit.
    if (interval > 0 && chain.step() >= limit && chain.step() < o.steps) save();
    const int stopped_by = o.stop ? o.stop->load(std::memory_order_relaxed) : 0;
    if (stopped_by != 0 && chain.step() < o.steps) {
      result.interrupted = stopped_by;
      if (checkpoints) save();
      break;
    }
    if (!o.progress || Clock::now() - told < std::chrono::seconds(1)) continue;
    told = Clock::now();
    std::fprintf(stderr, "step %lld of %lld, %lld events\n", static_cast<long long>(chain.step()),
                 static_cast<long long>(o.steps), static_cast<long long>(state.events));
  }
  if (checkpoints && result.interrupted == 0) save();
  recorder.save();
  outputs.close();

  result.steps = chain.step();
  result.events = state.events;
  result.before_warmup = state.before_warmup;
  result.dropped_nonpositive = state.picker.dropped_nonpositive;
  result.dropped_small = state.picker.dropped_small;
  result.moved = chain.moved();
  result.pe = chain.pe();
  result.pe_direct = direct_energy(o.parameters, chain.displacements(), chain.plate());
  result.mean_slip = chain.slip_sum() / o.parameters.blocks;
  result.largest_event = state.largest;
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return result;
}

}  // namespace

RunResult run(const RunOptions &o) {
  return o.events == Events::ruptures ? run_chain<RuptureRecorder>(o) : run_chain<PeRecorder>(o);
}

}  // namespace Slider
