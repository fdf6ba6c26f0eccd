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
#include <thread>
#include <vector>

#include "files/output_file.h"
#include "slider_kernels.h"
#include "slider_options.h"
#include "standard_streams.h"

namespace {

using Slider::Settings;

// Set by the signal handler and read by all threads of an ensemble.
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
  if (s.run.parameters.radiation > 0.0) {
    j["kinetic"] = r.kinetic;
    j["radiated"] = r.radiated;
  }
  j["moving_fraction"] = static_cast<double>(r.moved) / (steps * s.run.parameters.blocks);
  j["steps_jumped"] = r.jumped;
  if (s.run.leap_speed > 0.0) {
    j["leaps"] = r.leaps;
    j["steps_leapt"] = r.leapt;
  }
  j["kernel"] = Slider::to_string(s.run.kernel);
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

/// Calls task(0) to task(count - 1) in parallel. A task must not throw.
/// \param threads number of threads; 0: one per core
template <class Task>
void for_each_index(std::size_t count, std::size_t threads, const Task &task) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < count; k = next++) task(k);
  };
  if (threads == 0) threads = std::thread::hardware_concurrency();
  std::vector<std::thread> pool;
  for (std::size_t k = 1; k < std::min(threads, count); ++k) pool.emplace_back(work);
  work();
  for (auto &thread : pool) thread.join();
}

/// Carries out one run or those of an ensemble.
/// \return exit status
int run_all(const std::vector<Settings> &all, const Settings &base) {
  if (base.summary != "-") Slider::probe(base.summary);
  std::vector<Slider::RunResult> results(all.size());
  std::vector<std::string> errors(all.size());
  for_each_index(all.size(), base.threads, [&](std::size_t k) {
    const int stopped_by = stop_signal;
    if (stopped_by != 0 && all[k].run.checkpoint.empty()) {
      results[k].interrupted = stopped_by;
      return;
    }
    try {
      results[k] = Slider::run(all[k].run);
    } catch (const std::bad_alloc &) {
      errors[k] = "out of memory, expected fewer --blocks";
    } catch (const std::exception &e) {
      errors[k] = e.what();
    }
  });
  nlohmann::ordered_json j = nlohmann::ordered_json::array();
  int status = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Slider::RunResult &r = results[k];
    const std::string name =
        base.ensemble.empty() ? "" : fmt::format("run {} of the ensemble: ", k + 1);
    if (!errors[k].empty()) {
      fmt::print(stderr, "slider_cli: {}{}\n", name, errors[k]);
      status = 1;
      continue;
    }
    if (base.summary != "-") {
      fmt::print("{}: {} events in {} steps, {:.3g} s\n", all[k].run.catalogue, r.events, r.steps,
                 r.seconds);
      if (r.by_plate > 0)
        fmt::print(
            "{} drops of PE by the plate, not by slip, {}\n", r.by_plate,
            all[k].run.keep_by_plate ? "are among them (--without-plate-drops)" : "were left out");
    }
    if (r.interrupted != 0) {
      fmt::print(
          stderr, "slider_cli: {}stopped by signal {} at step {}; {}\n", name, r.interrupted,
          r.steps,
          all[k].run.checkpoint.empty() ? "no --checkpoint was given" : "continue with --resume");
      if (status == 0) status = 128 + r.interrupted;
    }
    j.push_back(summary(all[k], r));
  }
  if (base.ensemble.empty() && status == 1) return status;
  if (base.ensemble.empty()) j = j.at(0);
  const std::string text =
      j.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  if (base.summary == "-")
    std::cout << text;
  else if (!base.summary.empty())
    LSM::files::write_file(base.summary, text);
  return status;
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
    const std::vector<Settings> all = settings.ensemble.empty()
                                          ? std::vector<Settings>{settings}
                                          : Slider::ensemble(settings, arguments);
    Slider::check_files(all);
    const int status = run_all(all, settings);
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
