// SPDX-License-Identifier: GPL-2.0-or-later
// slider_cli: the block-slider of Weatherley and Abe (2004), Sect. 3, on the command line.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "files/output_file.h"
#include "slider_kernels.h"
#include "slider_options.h"
#include "standard_streams.h"

namespace {

using Slider::Settings;

std::atomic<int> stop_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler must not wait for a lock");
extern "C" void note_signal(int number) { stop_signal.store(number, std::memory_order_relaxed); }

nlohmann::ordered_json summary(const Settings &s, const Slider::RunResult &r) {
  nlohmann::ordered_json j;
  for (const auto &[key, value] : s.run.header) j["parameters"][key] = value;
  const auto steps = static_cast<double>(r.steps);
  j["catalogue"] = s.run.catalogue;
  j["steps"] = r.steps;
  j["time"] = steps * s.run.parameters.dt;
  j["events"] = r.events;
  j["events_before_warmup"] = r.before_warmup;
  j["events_nonpositive"] = r.dropped_nonpositive;
  j["events_below_min_size"] = r.dropped_small;
  if (s.run.events == Slider::Events::pe) j["events_by_plate"] = r.by_plate;
  j["largest_event"] = r.largest;
  j["mean_slip"] = r.mean_slip;
  j["pe"] = r.pe;
  j["pe_direct"] = r.pe_direct;
  j["moving_fraction"] = static_cast<double>(r.moved) / (steps * s.run.parameters.blocks);
  j["steps_jumped"] = r.jumped;
  if (s.run.leap_speed > 0.0) {
    j["leaps"] = r.leaps;
    j["steps_leapt"] = r.leapt;
  }
  j["instruction_set"] = Slider::to_string(Slider::widest_instruction_set());
  j["seconds"] = r.seconds;
  j["nanoseconds_per_step"] =
      r.seconds * 1e9 / std::max(1.0, steps - static_cast<double>(r.first_step));
  j["interrupted"] = r.interrupted != 0;
  return j;
}

void warn(const Slider::Parameters &p) {
  // Above this, growing oscillations of the printed scheme were found to change the statistics.
  const double limit = Slider::stability_limit(p) / 12.0;
  if (p.scheme == Slider::Scheme::printed && p.dt > limit * (1.0 + 1e-12))
    fmt::print(stderr,
               "slider_cli: warning: --dt = {} with the printed scheme, expected at most {:.6g}: "
               "its growing oscillations change the statistics\n",
               p.dt, limit);
}

/// Carries out the run.
/// \return exit status
int run(const Settings &s) {
  if (s.summary != "-") Slider::probe(s.summary);
  const Slider::RunResult r = Slider::run(s.run);
  if (s.summary != "-") {
    fmt::print("{}: {} events in {} steps, {:.3g} s\n", s.run.catalogue, r.events, r.steps,
               r.seconds);
    if (r.by_plate > 0)
      fmt::print("{} drops of PE by the plate, not by slip, {}\n", r.by_plate,
                 s.run.keep_by_plate ? "are among them (--without-plate-drops)" : "were left out");
  }
  if (r.interrupted != 0)
    fmt::print(stderr, "slider_cli: stopped by signal {} at step {}; {}\n", r.interrupted, r.steps,
               s.run.checkpoint.empty() ? "no --checkpoint was given" : "continue with --resume");
  const std::string text =
      summary(s, r).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  if (s.summary == "-")
    std::cout << text;
  else if (!s.summary.empty())
    LSM::files::write_file(s.summary, text);
  return r.interrupted != 0 ? 128 + r.interrupted : 0;
}

}  // namespace

int main(int argc, char **argv) {
  LSM::occupy_standard_streams();
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const Settings settings = Slider::parse(arguments, &stop_signal);
    for (const int number : {SIGINT, SIGTERM}) {
      struct sigaction act {};
      act.sa_handler = note_signal;
      // SA_RESTART is not set, or a signal could not interrupt opening a pipe that nobody reads.
      sigaction(number, &act, nullptr);
    }
    warn(settings.run.parameters);
    Slider::check_files(settings);
    const int status = run(settings);
    if (settings.summary == "-" && !std::cout.flush())
      throw std::runtime_error("--json -: cannot write to standard output");
    return status;
  } catch (const std::bad_alloc &) {
    fmt::print(stderr, "slider_cli: out of memory, expected fewer --blocks\n");
  } catch (const std::exception &e) {
    fmt::print(stderr, "slider_cli: {}\n", e.what());
  }
  return 1;
}
