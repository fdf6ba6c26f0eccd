// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_run.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
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

void probe(const std::string &path, const std::string &option) {
  if (path.empty()) return;
  const std::string trial = path + ".new";
  std::FILE *file = std::fopen(trial.c_str(), "wb");
  if (!file)
    throw std::runtime_error(path + ": " + std::strerror(errno) +
                             ", expected a writable file for " + option);
  std::fclose(file);
  std::remove(trial.c_str());
}

std::vector<LSM::Output> outputs_of(const RunOptions &o) {
  return {{"--catalogue", o.catalogue}, {"--pe-series", o.series}, {"--checkpoint", o.checkpoint}};
}

void check_replaced(const RunOptions &o) {
  if (o.resume || o.overwrite) return;
  for (const auto &[option, path] : outputs_of(o))
    if (LSM::text_io::holds_data(path))
      throw std::runtime_error(path + ": exists, expected a new file for " + option +
                               "; --overwrite replaces it, --resume goes on with it");
}

namespace {

using Clock = std::chrono::steady_clock;

/// What a recorder has to tell at the end.
struct Counts {
  std::int64_t dropped_nonpositive = 0, dropped_small = 0;
};

/// When to leap: a block moves, so that there is nothing to jump over, and none has been fast for a
/// while. Nothing but the state of the chain decides, looked at in the same steps in any run, so
/// that one that goes on from a checkpoint leaps where the other did.
class Leaps {
 public:
  Leaps(const RunOptions &o, Chain &chain, RunState &state, Outputs &outputs, RunResult &result)
      : chain_(chain), state_(state), outputs_(outputs), result_(result), steps_(o.steps) {
    const double dt = o.parameters.dt;
    bound_ = o.leap_speed;
    calm_ = std::max<std::int64_t>(1, std::llround(o.leap_calm / dt));
    look_ = std::max<std::int64_t>(1, std::llround(1.0 / dt));
    next_ = bound_ > 0.0 ? 0 : std::numeric_limits<std::int64_t>::max();
  }

  /// Whether a leap may begin here. \param at_rest also when nothing moves
  bool due(bool at_rest) {
    const std::int64_t step = chain_.step();
    if (step < next_) return false;
    next_ = (step / look_ + 1) * look_;
    if (step % look_ != 0) return false;
    const double v = chain_.fastest();
    if (v > bound_) state_.calm_since = step;
    return (v > 0.0 || at_rest) && step - state_.calm_since >= calm_;
  }
  /// See Chain::leap(). A leap shorter than the calm that has to follow is worth nothing.
  bool leap(bool falls, bool rises) {
    const std::int64_t from = chain_.step();
    const bool done = chain_.leap(steps_, calm_, bound_, falls, rises);
    state_.calm_since = chain_.step();
    if (!done) return false;
    ++result_.leaps;
    result_.leapt += chain_.step() - from;
    for (std::int64_t s = outputs_.next_sample(from); s < chain_.step();
         s = outputs_.next_sample(s))
      outputs_.sample(s, chain_.pe_in_leap(s));
    return true;
  }

 private:
  Chain &chain_;
  RunState &state_;
  Outputs &outputs_;
  RunResult &result_;
  std::int64_t steps_, calm_ = 1, look_ = 1, next_ = 0;
  double bound_ = 0.0;
};

/// Events are drops of the PE of the whole chain.
class PeRecorder {
 public:
  /// Samples after its end in which an event is found.
  static constexpr std::int64_t late = 1;

  PeRecorder(const RunOptions &o, Chain &chain, RunState &state, Outputs &outputs,
             RunResult &result)
      : o_(o),
        chain_(chain),
        state_(state),
        outputs_(outputs),
        result_(result),
        leaps_(o, chain, state, outputs, result),
        picker_(o.picker) {
    // After so many steps the picker has forgotten what it was started with, to the last digit.
    const double memory = o.picker.reading == LSM::PickerReading::exponential
                              ? 45.0 / std::max(1.0 - o.picker.lambda, 1e-15)
                              : 100.0;
    replay_ = static_cast<std::int64_t>(std::min(memory, 1e15)) + 1;
  }

  void begin() {
    LSM::Event none;
    picker_.push_change(0, 0.0, chain_.pe(), 0.0, none);
  }
  void restore() { picker_.set_state(state_.picker); }
  void save() { state_.picker = picker_.state(); }
  Counts counts() const { return {picker_.dropped_nonpositive(), picker_.dropped_small()}; }

  /// One step, or several in which nothing slides, up to limit at most.
  void advance(std::int64_t limit) {
    if (!picker_.in_event() && chain_.quiet_until() > chain_.step() + replay_ && jump(limit))
      return;
    if (leaps_.due(picker_.in_event()) && leap()) return;
    chain_.advance();
    const bool before = picker_.in_event();
    const bool report =
        picker_.push_change(chain_.step(), o_.parameters.dt * static_cast<double>(chain_.step()),
                            chain_.pe(), chain_.dpe(), event_);
    // Slip is taken one sample late at both ends, which is less than a time step's worth.
    if (picker_.in_event() && !before) open();
    if (report) finish();
  }

 private:
  bool located() const { return o_.x_centroid || o_.rupture_length; }

  /// Nothing slips: the plate alone changes PE, and as long as it raises PE no event can commence.
  /// With an event open the steps are taken one by one. False: no jump is worth it.
  bool jump(std::int64_t limit) {
    const std::int64_t last = std::min(chain_.quiet_until(), limit);
    // The sample that is due next is taken by a step.
    const std::int64_t to = std::min(last, outputs_.next_sample(chain_.step()) - 1) - replay_;
    if (!(to > chain_.step() && picker_.rate() >= 0.0 && chain_.quiet_change(chain_.step()) > 0.0))
      return false;
    const std::int64_t from = chain_.step();
    result_.jumped += to - from;
    chain_.jump(to);
    gone_on(from);
    return true;
  }

  /// PE rises, or within an event falls, from the beginning of a leap to its end.
  bool leap() {
    const bool falls = picker_.in_event();
    const std::int64_t from = chain_.step();
    if ((picker_.rate() < 0.0) != falls || !leaps_.leap(falls, !falls)) return false;
    gone_on(from);
    return true;
  }

  /// The picker has seen the same change of PE in each step since the given one.
  void gone_on(std::int64_t from) {
    LSM::PickerState s = picker_.state();
    s.samples += chain_.step() - from;
    s.step = chain_.step();
    s.time = o_.parameters.dt * static_cast<double>(s.step);
    s.pe = chain_.pe();
    s.rate = chain_.dpe();
    if (o_.picker.reading == LSM::PickerReading::literal)
      s.rate /= 1.0 + o_.picker.lambda * static_cast<double>(s.samples - 2);
    // A leap to where PE begins or ceases to fall ends up to a step behind; the next step tells.
    s.rate = s.in_event != 0 ? std::min(s.rate, 0.0) : std::max(s.rate, 0.0);
    picker_.set_state(s);
  }

  void open() {
    state_.slip_start = chain_.slip_sum();
    if (located()) state_.u_start = chain_.displacements();
  }

  void finish() {
    if (event_.t_start < o_.warmup) {
      ++state_.before_warmup;
      return;
    }
    event_.id = ++state_.events;
    event_.slip_moment = chain_.slip_sum() - state_.slip_start;
    if (located()) locate();
    state_.largest = std::max(state_.largest, event_.size);
    outputs_.event(event_);
  }

  void locate() {
    const std::vector<double> u = chain_.displacements();
    LSM::CircularMean mean(static_cast<double>(u.size()));
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double slip = u[i] - state_.u_start[i];
      if (slip > 0.0) event_.rupture_length += 1.0;
      mean.add(static_cast<double>(i), slip);
    }
    event_.x_centroid = mean.position();
  }

  const RunOptions &o_;
  Chain &chain_;
  RunState &state_;
  Outputs &outputs_;
  RunResult &result_;
  Leaps leaps_;
  LSM::EventPicker picker_;
  LSM::Event event_;
  std::int64_t replay_ = 0;
};

/// Events are ruptures, see slider_ruptures.h.
class RuptureRecorder {
 public:
  RuptureRecorder(const RunOptions &o, Chain &chain, RunState &state, Outputs &outputs,
                  RunResult &result)
      : late(o.rupture_memory),
        o_(o),
        chain_(chain),
        state_(state),
        outputs_(outputs),
        result_(result),
        leaps_(o, chain, state, outputs, result),
        tracker_(o.parameters.blocks, o.rupture_memory, o.x_centroid) {}

  /// Steps after its end in which a rupture is found: when its memory is over.
  const std::int64_t late;

  void begin() {}
  void restore() { tracker_.set_state(state_.ruptures, chain_.step()); }
  void save() { state_.ruptures = tracker_.state(); }
  // Counted where the picker does, for checkpoints.
  Counts counts() const { return {state_.picker.dropped_nonpositive, state_.picker.dropped_small}; }

  /// One step, or several in which nothing slides, up to limit at most.
  void advance(std::int64_t limit) {
    if (tracker_.idle() && chain_.quiet_until() > chain_.step() + 1) {
      const std::int64_t to =
          std::min({chain_.quiet_until(), limit, outputs_.next_sample(chain_.step())});
      result_.jumped += to - chain_.step() - 1;
      chain_.jump(to);
      return;
    }
    if (leaps_.due(false) && leaps_.leap(true, true)) {
      // What slides in a leap is no rupture, and one that slid before it has ended there.
      tracker_.begin_step(chain_.step(), chain_.pe());
    } else {
      chain_.advance(tracker_);
    }
    if (!std::isfinite(chain_.dpe()) || !std::isfinite(chain_.pe()))
      throw std::runtime_error("potential energy at step " + std::to_string(chain_.step()) +
                               " is not a finite number");
    tracker_.end_step(chain_.pe(), [this](const Rupture &rupture) { finish(rupture); });
  }

 private:
  void finish(const Rupture &rupture) {
    LSM::Event e = tracker_.event(rupture, o_.parameters.dt);
    if (LSM::is_left_out(e.size, o_.picker, state_.picker)) return;
    if (e.t_start < o_.warmup) {
      ++state_.before_warmup;
      return;
    }
    e.id = ++state_.events;
    state_.largest = std::max(state_.largest, e.size);
    outputs_.event(e);
  }

  const RunOptions &o_;
  Chain &chain_;
  RunState &state_;
  Outputs &outputs_;
  RunResult &result_;
  Leaps leaps_;
  RuptureTracker tracker_;
};

/// Everything that shapes the result, as "key = value".
std::vector<std::string> settings_of(const RunOptions &o) {
  std::vector<std::string> lines;
  for (const auto &[key, value] : o.header) lines.push_back(key + " = " + value);
  lines.emplace_back("kernel = active or dense");
  return lines;
}

/// Says on standard error how far the run is, once a second.
class Progress {
 public:
  explicit Progress(const RunOptions &o) : on_(o.progress), steps_(o.steps) {}
  void tell(std::int64_t step, std::int64_t events) {
    if (!on_ || !(Clock::now() - told_ > std::chrono::seconds(1))) return;
    told_ = Clock::now();
    std::fprintf(stderr, "step %lld of %lld, %lld events\n", static_cast<long long>(step),
                 static_cast<long long>(steps_), static_cast<long long>(events));
  }

 private:
  bool on_;
  std::int64_t steps_;
  Clock::time_point told_ = Clock::now();
};

template <class Recorder>
RunResult run_chain(const RunOptions &o) {
  const Clock::time_point begin = Clock::now();
  Chain chain(o.parameters, o.mu, o.kernel == Kernel::dense, InstructionSet::automatic);
  RunState state;
  RunResult result;
  Outputs outputs(o);
  Recorder recorder(o, chain, state, outputs, result);
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
  // Signals and the clock are looked at so often only.
  const std::int64_t look = std::max<std::int64_t>(16, 200000 / (o.parameters.blocks + 100));
  Progress progress(o);
  while (chain.step() < o.steps) {
    std::int64_t limit = o.steps;
    if (interval > 0) limit = std::min(limit, (chain.step() / interval + 1) * interval);
    const std::int64_t pause = std::min(limit, chain.step() + look);
    while (chain.step() < pause) {
      recorder.advance(limit);
      outputs.sample(chain.step(), chain.pe());
    }
    // A leap may go beyond the limit.
    if (interval > 0 && chain.step() >= limit && chain.step() < o.steps) save();
    const int stopped_by = o.stop ? o.stop->load(std::memory_order_relaxed) : 0;
    if (stopped_by != 0 && chain.step() < o.steps) {
      result.interrupted = stopped_by;
      if (checkpoints) save();
      break;
    }
    progress.tell(chain.step(), state.events);
  }
  if (checkpoints && result.interrupted == 0) save();
  outputs.close();

  result.steps = chain.step();
  result.events = state.events;
  result.before_warmup = state.before_warmup;
  result.dropped_nonpositive = recorder.counts().dropped_nonpositive;
  result.dropped_small = recorder.counts().dropped_small;
  result.moved = chain.moved();
  result.pe = chain.pe();
  const double plate = o.parameters.velocity * o.parameters.dt * static_cast<double>(chain.step());
  result.pe_direct = direct_energy(o.parameters, chain.displacements(), plate);
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
