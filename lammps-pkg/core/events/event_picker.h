// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/event_picker.h
/// Picks stick-slip events from a time series of the total elastic potential energy (PE), as in
/// Sect. 4.1 of Weatherley and Abe (2004). Shared by the lattice solid and the block-slider model.
#ifndef LSM_EVENT_PICKER_H
#define LSM_EVENT_PICKER_H

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "files/event.h"

namespace LSM {

struct PickerSettings {
  PickerReading reading = PickerReading::exponential;
  double lambda = 0.99;  ///< leakiness per sample, 0 <= lambda < 1 (paper: 0.99)
};

/// Leakiness that gives the exponential reading the memory memory_time, whatever the sampling
/// interval dt (same units): exp(-dt/memory_time) (*).
/// \throws std::invalid_argument unless both are positive and finite.
inline double lambda_from_memory_time(double memory_time, double dt) {
  if (!std::isfinite(memory_time) || !(memory_time > 0.0))
    throw std::invalid_argument("picker memory time must be a positive number");
  if (!std::isfinite(dt) || !(dt > 0.0))
    throw std::invalid_argument("time between picker samples must be a positive number");
  return std::exp(-dt / memory_time);
}

/// The whole state of a picker besides its settings. Plain old data without padding, so it can be
/// copied byte by byte into a restart file of the same machine type.
struct PickerState {
  std::int64_t samples = 0;   ///< samples pushed so far
  std::int64_t step = 0;      ///< last sample
  double time = 0.0;          ///< last sample
  double pe = 0.0;            ///< last sample
  double rate = 0.0;          ///< A
  std::int64_t in_event = 0;  ///< 1 from beginning to end of an event
  std::int64_t step_start = 0;
  double t_start = 0.0;
  double pe_start = 0.0;
};
static_assert(std::is_trivially_copyable<PickerState>::value, "PickerState goes into restarts");
static_assert(sizeof(PickerState) == 9 * 8, "PickerState must have no padding");

/// Picks events from PE samples that are pushed in order of time.
///
/// With x = PE(t+1) - PE(t) and A updated with x, an event begins at sample t when A turns from
/// >= 0 to < 0, and ends at sample t when A turns to > 0; A == 0 keeps an open event open. The
/// size, PE(start) - PE(end), comes from the raw series. The first sample only sets PE; A starts at
/// 0. An event still open after the last sample is not reported.
class EventPicker {
 public:
  /// \throws std::invalid_argument if a setting is out of range.
  explicit EventPicker(PickerSettings settings) : settings_(settings) {
    if (!(settings_.lambda >= 0.0 && settings_.lambda < 1.0))
      throw std::invalid_argument("picker lambda must be at least 0 and less than 1");
  }

  /// Adds the sample PE(step) = pe. Returns true, and fills out, if an event ended at the sample
  /// before this one; otherwise out is unchanged. EventFilter decides which events are written, and
  /// gives them their numbers.
  /// Samples may be a decimated series; steps and times are reported as given.
  /// \throws std::invalid_argument (and drops the sample) if step or time do not advance or a
  /// number is not finite, e.g. because a simulation blew up.
  bool push(std::int64_t step, double time, double pe, Event &out) {
    return push_change(step, time, pe, pe - state_.pe, out);
  }

  /// As push(), with the change dpe since the previous sample given by the caller, who may know it
  /// more accurately than the difference of two large sums. pe is used for the sizes and may be the
  /// accumulated dpe. The dpe of the first sample is ignored.
  bool push_change(std::int64_t step, double time, double pe, double dpe, Event &out) {
    check(step, time, pe, dpe);
    const bool first = state_.samples == 0;
    bool ended = false;
    if (!first) {
      update_rate(dpe);
      if (state_.in_event) {
        if (state_.rate > 0.0) {
          state_.in_event = 0;
          ended = true;
          out = finished();
        }
      } else if (state_.rate < 0.0) {
        state_.in_event = 1;
        state_.step_start = state_.step;
        state_.t_start = state_.time;
        state_.pe_start = state_.pe;
      }
    }
    ++state_.samples;
    state_.step = step;
    state_.time = time;
    state_.pe = pe;
    return ended;
  }

  bool in_event() const { return state_.in_event != 0; }
  /// The smoothed change of PE per sample, A, after the last push.
  double rate() const { return state_.rate; }
  const PickerState &state() const { return state_; }
  /// Continues from a saved state, even within an event; the settings must be those of that state.
  /// \throws std::invalid_argument if no picker can be in that state.
  void set_state(const PickerState &state) {
    const bool sane =
        state.samples >= 0 && (state.in_event == 0 || state.in_event == 1) &&
        std::isfinite(state.time) && std::isfinite(state.pe) && std::isfinite(state.rate) &&
        (state.in_event == 0 || (state.rate <= 0.0 && std::isfinite(state.t_start) &&
                                 std::isfinite(state.pe_start) && state.step_start < state.step));
    if (!sane) throw std::invalid_argument("saved picker state is inconsistent");
    state_ = state;
  }

  /// Continues with other settings. The rate is a change per step, so it scales with the time step.
  void change(const PickerSettings &settings, double ratio) {
    PickerState state = state_;
    state.rate *= ratio;
    *this = EventPicker(settings);
    set_state(state);
  }
  /// Accounts for a change of PE between two samples that is not due to the model.
  void leave_out_jump(double jump) {
    state_.pe += jump;
    state_.pe_start += jump;
  }

  const PickerSettings &settings() const { return settings_; }

 private:
  void check(std::int64_t step, double time, double pe, double dpe) const {
    const bool first = state_.samples == 0;
    if (!std::isfinite(pe) || (!first && !std::isfinite(dpe)))
      throw std::invalid_argument("potential energy at step " + std::to_string(step) +
                                  " is not a finite number");
    if (!std::isfinite(time))
      throw std::invalid_argument("time at step " + std::to_string(step) +
                                  " is not a finite number");
    if (first) return;
    if (step <= state_.step)
      throw std::invalid_argument("potential energy sample at step " + std::to_string(step) +
                                  " after step " + std::to_string(state_.step) +
                                  ", expected increasing steps");
    if (time < state_.time)
      throw std::invalid_argument("time goes back at step " + std::to_string(step) +
                                  ", expected increasing times");
  }

  void update_rate(double x) {
    const double lambda = settings_.lambda;
    switch (settings_.reading) {
      case PickerReading::exponential:
        state_.rate = lambda * state_.rate + (1.0 - lambda) * x;
        break;
      case PickerReading::average:
        state_.rate = (x + lambda * state_.rate) / (1.0 + lambda);
        break;
      case PickerReading::literal:
        // The number of samples before this one is one more than the index of the change.
        state_.rate =
            (x + lambda * state_.rate) / (1.0 + lambda * static_cast<double>(state_.samples - 1));
        break;
    }
  }

  /// The event that ended at the sample in state_. In exact arithmetic its size is positive, as the
  /// changes within an event add up to a weighted sum of negative A. Rounding of a large PE can
  /// make it zero or negative.
  Event finished() const {
    Event out;
    out.t_start = state_.t_start;
    out.t_end = state_.time;
    out.step_start = state_.step_start;
    out.step_end = state_.step;
    out.size = state_.pe_start - state_.pe;
    out.pe_start = state_.pe_start;
    out.pe_end = state_.pe;
    return out;
  }

  PickerSettings settings_;
  PickerState state_;
};

}  // namespace LSM

#endif
