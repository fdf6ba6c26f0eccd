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

#include "lsm_text_io.h"
#include "slider_kernels.h"
#include "slider_options.h"

namespace {

using Slider::Settings;

// Written by a signal handler, read by all threads of an ensemble.
std::atomic<int> stop_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler must not wait for a lock");
extern "C" void note_signal(int number) { stop_signal.store(number, std::memory_order_relaxed); }

nlohmann::ordered_json summary(const Settings &s, const Slider::RunResult &r) {
  nlohmann::ordered_json j;
  for (const auto &[key, value] : s.run.header) j["parameters"][key] = value;
  j["catalogue"] = s.run.catalogue;
  j["steps"] = r.steps;
  j["time"] = static_cast<double>(r.steps) * s.run.parameters.dt;
  j["events"] = r.events;
  j["events_before_warmup"] = r.before_warmup;
  j["events_nonpositive"] = r.dropped_nonpositive;
  j["events_below_min_size"] = r.dropped_small;
  j["largest_event"] = r.largest_event;
  j["mean_slip"] = r.mean_slip;
  j["pe"] = r.pe;
  j["pe_direct"] = r.pe_direct;
  j["moving_fraction"] =
      static_cast<double>(r.moved) / (static_cast<double>(r.steps) * s.run.parameters.blocks);
  j["steps_jumped"] = r.jumped;
  if (s.run.leap_speed > 0.0) {
    j["leaps"] = r.leaps;
    j["steps_leapt"] = r.leapt;
  }
  j["kernel"] = Slider::to_string(s.run.kernel);
  j["instruction_set"] = Slider::to_string(Slider::widest_instruction_set());
  j["seconds"] = r.seconds;
  j["nanoseconds_per_step"] =
      r.seconds * 1e9 / static_cast<double>(std::max<std::int64_t>(1, r.steps - r.first_step));
  j["interrupted"] = r.interrupted != 0;
  return j;
}

void write_json(const std::string &path, const nlohmann::ordered_json &j) {
  if (path == "-") {
    std::cout << j.dump(2) << '\n';
    return;
  }
  LSM::text_io::write_file(path, j.dump(2) + "\n");
}

void warn(const Settings &s) {
  const Slider::Parameters &p = s.run.parameters;
  if (p.scheme == Slider::Scheme::printed &&
      p.dt > Slider::printed_warning_limit(p) * (1.0 + 1e-12))
    fmt::print(
        stderr,
        "slider_cli: warning: --dt = {} with the printed scheme, expected at most {:.6g}: its "
        "growing oscillations change the statistics\n",
        p.dt, Slider::printed_warning_limit(p));
}

/// Calls task(0) to task(count - 1), that many at a time; 0: one per core. A task must not throw.
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
    } catch (const std::exception &e) {
      errors[k] = e.what();
    }
  });
  nlohmann::ordered_json j = nlohmann::ordered_json::array();
  bool failed = false, interrupted = false;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!errors[k].empty()) {
      fmt::print(stderr, "slider_cli: run {} of the ensemble: {}\n", k + 1, errors[k]);
      failed = true;
      continue;
    }
    interrupted = interrupted || results[k].interrupted != 0;
    if (base.summary != "-")
      fmt::print("{}: {} events in {} steps\n", all[k].run.catalogue, results[k].events,
                 results[k].steps);
    j.push_back(summary(all[k], results[k]));
  }
  if (!base.summary.empty()) write_json(base.summary, j);
  if (failed) return 1;
  return interrupted ? 128 + stop_signal : 0;
}

int run_one(const Settings &s) {
  if (s.summary != "-") Slider::probe(s.summary);
  const Slider::RunResult r = Slider::run(s.run);
  if (s.summary != "-")
    fmt::print("{}: {} events in {} steps, {:.3g} s\n", s.run.catalogue, r.events, r.steps,
               r.seconds);
  if (!s.summary.empty()) write_json(s.summary, summary(s, r));
  if (r.interrupted == 0) return 0;
  if (s.run.checkpoint.empty())
    fmt::print(stderr, "slider_cli: stopped by signal {} at step {}; no --checkpoint was given\n",
               r.interrupted, r.steps);
  else
    fmt::print(stderr, "slider_cli: stopped by signal {} at step {}; continue with --resume\n",
               r.interrupted, r.steps);
  return 128 + r.interrupted;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const Settings settings = Slider::parse(arguments, &stop_signal);
    std::signal(SIGINT, note_signal);
    std::signal(SIGTERM, note_signal);
    warn(settings);
    if (settings.ensemble.empty()) {
      Slider::check_files({settings});
      return run_one(settings);
    }
    const std::vector<Settings> all = Slider::ensemble(settings, arguments);
    Slider::check_files(all);
    return run_all(all, settings);
  } catch (const Slider::Done &done) {
    std::cout << done.text;
    return 0;
  } catch (const std::bad_alloc &) {
    fmt::print(stderr, "slider_cli: out of memory, expected fewer --blocks\n");
    return 1;
  } catch (const std::exception &e) {
    fmt::print(stderr, "slider_cli: {}\n", e.what());
    return 1;
  }
}
