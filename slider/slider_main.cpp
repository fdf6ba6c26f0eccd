// SPDX-License-Identifier: GPL-2.0-or-later
// slider_cli: the block-slider of Weatherley and Abe (2004), Sect. 3, on the command line.
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "slider_run.h"

namespace {

// Written by a signal handler, read by all threads of an ensemble.
std::atomic<int> stop_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler must not wait for a lock");
extern "C" void note_signal(int number) { stop_signal.store(number, std::memory_order_relaxed); }

const char *const description =
    "Block-slider: a periodic chain of N blocks on a rough surface, coupled by springs K_c and "
    "drawn\n"
    "by a plate of speed V through leaf springs K_l; friction mu_0i / (1 + v), no back-slip\n"
    "(Weatherley and Abe 2004, Sect. 3, after Carlson et al. 1991). Writes a catalogue of the "
    "drops\n"
    "of potential energy (PE). All quantities are in model units.\n"
    "As printed in the paper: Eqs. 5 and 6, K_c = 1, K_l = 0.01, M = 1, V = 0.01, mu_0 in [0.5, "
    "1),\n"
    "1e7 steps, schemes of Eqs. 7 and 8 (--scheme printed), lambda = 0.99. Ours: the other "
    "schemes,\n"
    "the time step (the paper gives none), the reading 'exponential' of the event picker, "
    "warm-up,\n"
    "other laws of friction (--law), ruptures as another kind of events (--events ruptures).\n"
    "The sign of friction in Eq. 5 is read so that friction resists motion.";

struct Settings {
  Slider::RunOptions run;
  std::string scheme = "verlet", kernel = "active", isa = "auto", picker = "exponential";
  std::string events = "pe";
  double steps = 1e7, time = 1e5;
  double lambda = 0.99, memory_steps = 100.0, memory_time = 1.0;
  std::vector<double> friction = {0.5, 1.0};
  std::string friction_file, law = "velocity-weakening";
  double dynamic = 0.8, distance = 0.1;
  std::uint64_t seed = 1;
  std::string columns, series_format = "text", summary, ensemble;
  double stride = 1, interval = 1e6, rupture_gap = 0.0;
  unsigned threads = 0;
  bool paper = false, force = false, fresh_catalogue = true;
};

// Help or version was asked for; what is to be printed, and nothing more to do.
struct Done {
  std::string text;
};

std::int64_t whole(const std::string &option, double value, double least) {
  if (!(value >= least) || value > 9e15 || value != std::floor(value))
    throw std::invalid_argument(
        fmt::format("{} = {}, expected a whole number of at least {}", option, value, least));
  return static_cast<std::int64_t>(value);
}

std::string number(double x) { return fmt::format("{}", x); }

Settings parse(std::vector<std::string> arguments) {
  Settings s;
  s.run.catalogue = "slider_catalogue.csv";
  s.run.warmup = 12000.0;
  Slider::Parameters &p = s.run.parameters;
  CLI::App app(description, "slider_cli");
  app.set_version_flag("--version", std::string(SLIDER_VERSION));
  app.set_config("--config", "", "File of 'option = value' lines; the command line has precedence");
  app.allow_config_extras(false);
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.option_defaults()->always_capture_default();
  app.get_formatter()->column_width(34);

  const std::string model = "Model (defaults are the paper's values)";
  app.add_option("--blocks", p.blocks, "Number of blocks N")->group(model);
  app.add_option("--kc", p.kc, "Spring between neighbours K_c (force/length)")->group(model);
  app.add_option("--kl", p.kl, "Leaf spring to the plate K_l (force/length)")->group(model);
  app.add_option("--mass", p.mass, "Mass of a block M")->group(model);
  app.add_option("--velocity", p.velocity, "Driving velocity of the plate V (length/time)")
      ->group(model);
  auto *range = app.add_option("--friction-range", s.friction,
                               "Static coefficients mu_0i are uniform in [LOW, HIGH) (force)")
                    ->expected(2)
                    ->group(model);
  app.add_option("--friction-file", s.friction_file,
                 "File with one static coefficient per line, one line per block")
      ->excludes(range)
      ->group(model);
  app.add_option("--seed", s.seed, "Seed of the coefficients")->group(model);
  auto *law = app.add_option("--law", s.law,
                             "Friction of a moving block: velocity-weakening, mu_0i / (1 + v), Eq. 6; ours: "
                             "coulomb, R mu_0i with the R of --dynamic-friction; slip-weakening, from mu_0i to "
                             "R mu_0i over the slip of --slip-distance since the block last rested");
  law->group(model);
  auto *dynamic = app.add_option("--dynamic-friction", s.dynamic,
                                 "Dynamic over static coefficient, of coulomb and slip-weakening (ours)");
  dynamic->group(model);
  auto *distance = app.add_option("--slip-distance", s.distance,
                                  "Slip over which slip-weakening weakens (length; ours)");
  distance->group(model);

  const std::string how = "Integration";
  auto *paper = app.add_flag("--paper", s.paper,
                             "Exactly what is printed: --scheme printed --dt 0.01 --steps 1e7 "
                             "--picker literal --picker-lambda 0.99 --warmup 0");
  paper->group(how);
  auto *steps = app.add_option("--steps", s.steps, "Number of time steps (instead of --time)");
  steps->group(how);
  steps->default_str("1e7 with --paper, else from --time");
  app.add_option("--time", s.time, "Model time to run for (time)")
      ->excludes(steps)
      ->excludes(paper)
      ->group(how);
  auto *dt = app.add_option("--dt", p.dt, "Time step h (time; ours, the paper gives none)");
  dt->excludes(paper)->group(how);
  app.add_option(
         "--scheme", s.scheme,
         "printed: Eqs. 7 and 8, order 1, unstable in the long run: warns above dt 0.01, "
         "refused from 0.12; ours: semi-implicit (order 1), verlet (order 2), rk4 (order 4, "
         "located stick/slip switches), reference (adaptive GSL rk8pd, short runs)")
      ->excludes(paper)
      ->group(how);
  app.add_flag("--force", s.force, "Run the printed scheme at time steps where it is unsound")
      ->group(how);
  app.add_option("--kernel", s.kernel,
                 "For the first three schemes: active (only moving chunks of blocks), dense (all "
                 "blocks; same catalogue), scalar (the straightforward loop)")
      ->group(how);
  app.add_option("--isa", s.isa,
                 "Instruction set: auto, avx512, avx2, x86-64; all give the same catalogue")
      ->group(how);

  const std::string events = "Events";
  app.add_option("--events", s.events,
                 "What an event is: pe, a drop of the PE of the whole chain (paper); ruptures, a "
                 "set of sliding blocks connected in space and time (ours): each is local, so "
                 "those far apart stay apart in long chains, and events can overlap. Their size is "
                 "the work of the springs on the blocks; they are written in the order in which "
                 "they end; the options of the picker have no effect on them")
      ->group(events);
  auto *gap = app.add_option("--rupture-gap", s.rupture_gap,
                             "With --events ruptures: time for which a block at rest still "
                             "connects, beyond the one time step that forces take (time; ours)");
  gap->group(events);
  app.add_option("--picker", s.picker,
                 "Reading of the smoothed change of PE: exponential, average (ours), literal")
      ->excludes(paper)
      ->group(events);
  auto *lambda =
      app.add_option("--picker-lambda", s.lambda, "Leakiness lambda per step (paper: 0.99)");
  lambda->excludes(paper)->group(events);
  lambda->default_str("from --picker-memory-time");
  auto *memory_steps = app.add_option("--picker-memory-steps", s.memory_steps,
                                      "Memory of the picker, lambda = 1 - 1/steps (steps)");
  memory_steps->excludes(paper)->excludes(lambda)->group(events);
  memory_steps->default_str("from --picker-memory-time");
  app.add_option("--picker-memory-time", s.memory_time,
                 "Memory of the picker, lambda = exp(-dt/time) (time; ours)")
      ->excludes(paper)
      ->excludes(lambda)
      ->excludes(memory_steps)
      ->group(events);
  app.add_option("--min-size", s.run.picker.min_size, "Smallest event written (energy)")
      ->group(events);
  app.add_flag("--keep-nonpositive", s.run.picker.keep_nonpositive,
               "Write events of size <= 0, too")
      ->group(events);
  app.add_option("--warmup", s.run.warmup, "Drop events that start before this time (time; ours)")
      ->excludes(paper)
      ->group(events);

  const std::string files = "Files";
  app.add_option("--catalogue", s.run.catalogue, "Catalogue to write")->group(files);
  app.add_option("--columns", s.columns,
                 "Further columns: centroid, length, or both with a comma; slip_moment (sum of the "
                 "slips of all blocks) is always there")
      ->group(files);
  app.add_option("--pe-series", s.run.series, "Series of PE to write (default: none)")
      ->group(files);
  app.add_option("--pe-stride", s.stride, "Steps between samples of the series (steps)")
      ->group(files);
  app.add_option("--pe-format", s.series_format, "Format of the series: text or binary")
      ->group(files);
  app.add_option("--checkpoint", s.run.checkpoint,
                 "Checkpoint to write, also on SIGINT and SIGTERM (default: none)")
      ->group(files);
  app.add_option("--checkpoint-interval", s.interval,
                 "Steps between checkpoints; 0: only when interrupted and at the end (steps)")
      ->group(files);
  app.add_flag("--resume", s.run.resume,
               "Go on from the checkpoint; the catalogue ends as if never interrupted")
      ->group(files);
  app.add_flag("--overwrite", s.run.overwrite,
               "Replace catalogue, series and checkpoint of an earlier run, which is refused "
               "otherwise; with --resume, those of runs of an ensemble that have no checkpoint")
      ->group(files);
  app.add_option("--json", s.summary, "JSON summary to write; - is standard output")->group(files);
  app.add_flag("--progress", s.run.progress, "Report on standard error every second")->group(files);

  const std::string many = "Several runs";
  app.add_option(
         "--ensemble", s.ensemble,
         "A number of runs with successive seeds, or a file with the options of one run per "
         "line; '{run}' in output names is replaced by the run's number, from 1, or put "
         "before the extension")
      ->group(many);
  app.add_option("--threads", s.threads, "Runs at a time; 0: one per core")->group(many);

  std::reverse(arguments.begin(), arguments.end());
  try {
    app.parse(arguments);
  } catch (const CLI::CallForHelp &) {
    throw Done{app.help()};
  } catch (const CLI::CallForVersion &e) {
    throw Done{std::string(e.what()) + "\n"};
  } catch (const CLI::ParseError &e) {
    std::string what = e.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    throw std::invalid_argument(what + " (--help lists the options)");
  }

  if (s.paper) {
    s.scheme = "printed";
    s.picker = "literal";
    p.dt = 0.01;
    s.run.warmup = 0.0;
  }
  auto choice = [](const char *option, const std::string &word, auto &value, const char *expected) {
    if (!from_string(word, value))
      throw std::invalid_argument(fmt::format("{} = '{}', expected {}", option, word, expected));
  };
  choice("--scheme", s.scheme, p.scheme, "printed, semi-implicit, verlet, rk4 or reference");
  choice("--law", s.law, p.friction.law,
         "velocity-weakening, coulomb or slip-weakening (with others no block rests: they are laws of "
         "pair_style lsm/friction)");
  using Slider::Law;
  if (dynamic->count() > 0 && p.friction.law == Law::velocity_weakening)
    throw std::invalid_argument("--dynamic-friction needs --law coulomb or slip-weakening");
  if (distance->count() > 0 && p.friction.law != Law::slip_weakening)
    throw std::invalid_argument("--slip-distance needs --law slip-weakening");
  if (p.friction.law != Law::velocity_weakening) p.friction.dynamic = s.dynamic;
  if (p.friction.law == Law::slip_weakening) p.friction.dc = s.distance;
  choice("--isa", s.isa, s.run.isa, "auto, avx512, avx2 or x86-64");
  choice("--events", s.events, s.run.events, "pe or ruptures");
  choice("--picker", s.picker, s.run.picker.reading, "exponential, average or literal");
  if (s.kernel == "active")
    s.run.kernel = Slider::Kernel::active;
  else if (s.kernel == "dense")
    s.run.kernel = Slider::Kernel::dense;
  else if (s.kernel == "scalar")
    s.run.kernel = Slider::Kernel::scalar;
  else
    throw std::invalid_argument("--kernel = '" + s.kernel + "', expected active, dense or scalar");
  Slider::check(p, s.force);
  Slider::check_events(s.run);
  Slider::resolve(s.run.isa);

  if (steps->count() > 0 || s.paper) {
    s.run.steps = whole("--steps", s.steps, 1);
  } else {
    if (!std::isfinite(s.time) || !(s.time > 0.0))
      throw std::invalid_argument("--time = " + number(s.time) + ", expected a positive number");
    const double n = std::round(s.time / p.dt);
    s.run.steps = whole("--time / --dt", n, 1);
  }
  if (s.paper || lambda->count() > 0) {
    s.run.picker.lambda = s.lambda;
    if (!(s.lambda >= 0.0 && s.lambda < 1.0))
      throw std::invalid_argument("--picker-lambda = " + number(s.lambda) +
                                  ", expected at least 0 and less than 1");
  } else if (memory_steps->count() > 0) {
    if (!(s.memory_steps >= 1.0 && s.memory_steps < 1e15))
      throw std::invalid_argument("--picker-memory-steps = " + number(s.memory_steps) +
                                  ", expected at least 1");
    s.run.picker.lambda = 1.0 - 1.0 / s.memory_steps;
  } else {
    if (!std::isfinite(s.memory_time) || !(s.memory_time > 0.0))
      throw std::invalid_argument("--picker-memory-time = " + number(s.memory_time) +
                                  ", expected a positive number");
    s.run.picker.lambda = LSM::lambda_from_memory_time(s.memory_time, p.dt);
    if (!(s.run.picker.lambda < 1.0))
      throw std::invalid_argument("--picker-memory-time = " + number(s.memory_time) +
                                  ", expected less than 1e16 time steps");
  }
  if (!(s.run.picker.min_size >= 0.0) || !std::isfinite(s.run.picker.min_size))
    throw std::invalid_argument("--min-size = " + number(s.run.picker.min_size) +
                                ", expected a finite number >= 0");
  if (!(s.run.warmup >= 0.0) || !std::isfinite(s.run.warmup))
    throw std::invalid_argument("--warmup = " + number(s.run.warmup) +
                                ", expected a finite number >= 0");
  const bool ruptures = s.run.events == Slider::Events::ruptures;
  if (gap->count() > 0 && !ruptures)
    throw std::invalid_argument("--rupture-gap needs --events ruptures");
  const double gap_steps = std::round(s.rupture_gap / p.dt);
  if (!(s.rupture_gap >= 0.0) || !(gap_steps < 1e15))
    throw std::invalid_argument("--rupture-gap = " + number(s.rupture_gap) +
                                ", expected a number >= 0 and less than 1e15 time steps");
  s.run.rupture_memory = 1 + static_cast<std::int64_t>(gap_steps);
  s.run.series_stride = whole("--pe-stride", s.stride, 1);
  s.run.checkpoint_interval = whole("--checkpoint-interval", s.interval, 0);
  if (s.series_format != "text" && s.series_format != "binary")
    throw std::invalid_argument("--pe-format = '" + s.series_format + "', expected text or binary");
  s.run.series_binary = s.series_format == "binary";
  std::stringstream words(s.columns);
  for (std::string word; std::getline(words, word, ',');) {
    if (word == "centroid")
      s.run.x_centroid = true;
    else if (word == "length")
      s.run.rupture_length = true;
    else
      throw std::invalid_argument("--columns = '" + s.columns +
                                  "', expected centroid, length or both with a comma");
  }
  if (s.run.catalogue.empty())
    throw std::invalid_argument("--catalogue is empty, expected a file name");
  if (s.run.resume && s.run.checkpoint.empty())
    throw std::invalid_argument("--resume needs --checkpoint FILE");

  if (!s.friction_file.empty()) {
    s.run.mu = Slider::read_friction(s.friction_file);
    if (s.run.mu.size() != static_cast<std::size_t>(p.blocks))
      throw std::invalid_argument(
          fmt::format("{}: {} coefficients, expected {} as given by --blocks", s.friction_file,
                      s.run.mu.size(), p.blocks));
  } else {
    if (!(s.friction[0] >= 0.0) || !(s.friction[1] >= s.friction[0]) ||
        !std::isfinite(s.friction[1]))
      throw std::invalid_argument(
          fmt::format("--friction-range = {} {}, expected finite numbers 0 <= LOW <= HIGH",
                      s.friction[0], s.friction[1]));
    s.run.mu = Slider::random_friction(p.blocks, s.friction[0], s.friction[1], s.seed);
  }

  auto &h = s.run.header;
  h.emplace_back("program", std::string("slider_cli ") + SLIDER_VERSION);
  h.emplace_back("blocks", std::to_string(p.blocks));
  h.emplace_back("kc", number(p.kc));
  h.emplace_back("kl", number(p.kl));
  h.emplace_back("mass", number(p.mass));
  h.emplace_back("velocity", number(p.velocity));
  if (s.friction_file.empty()) {
    h.emplace_back("friction_low", number(s.friction[0]));
    h.emplace_back("friction_high", number(s.friction[1]));
    h.emplace_back("seed", std::to_string(s.seed));
  } else {
    // The coefficients count, not where the file lies.
    std::string bytes(reinterpret_cast<const char *>(s.run.mu.data()),
                      s.run.mu.size() * sizeof(double));
    h.emplace_back("friction_checksum", fmt::format("{:016x}", Slider::detail::checksum(bytes)));
  }
  if (p.friction.law != Law::velocity_weakening) {
    h.emplace_back("law", s.law);
    h.emplace_back("dynamic_friction", number(p.friction.dynamic));
    if (p.friction.law == Law::slip_weakening)
      h.emplace_back("slip_distance", number(p.friction.dc));
  }
  h.emplace_back("scheme", Slider::to_string(p.scheme));
  h.emplace_back("dt", number(p.dt));
  h.emplace_back("steps", std::to_string(s.run.steps));
  if (ruptures) {
    h.emplace_back("events", "ruptures");
    h.emplace_back("rupture_gap", number(s.rupture_gap));
  } else {
    h.emplace_back("picker", LSM::to_string(s.run.picker.reading));
    h.emplace_back("lambda", number(s.run.picker.lambda));
  }
  h.emplace_back("min_size", number(s.run.picker.min_size));
  h.emplace_back("keep_nonpositive", s.run.picker.keep_nonpositive ? "yes" : "no");
  h.emplace_back("warmup", number(s.run.warmup));
  s.run.stop = &stop_signal;
  return s;
}

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
  j["kernel"] = Slider::to_string(s.run.kernel);
  j["instruction_set"] = Slider::to_string(Slider::resolve(s.run.isa));
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
  const std::string written = path + ".new";
  std::ofstream out(written);
  out << j.dump(2) << '\n';
  out.close();
  if (!out || std::rename(written.c_str(), path.c_str()) != 0) {
    std::remove(written.c_str());
    throw std::runtime_error(path + ": cannot be written, expected a writable file for --json");
  }
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

std::string numbered(const std::string &path, std::size_t run) {
  if (path.empty() || path == "-") return path;
  const std::string text = std::to_string(run);
  const std::size_t mark = path.find("{run}");
  if (mark != std::string::npos) return path.substr(0, mark) + text + path.substr(mark + 5);
  const std::size_t slash = path.find_last_of('/');
  const std::size_t dot = path.find_last_of('.');
  const bool extension =
      dot != std::string::npos && (slash == std::string::npos || dot > slash + 1);
  const std::size_t at = extension ? dot : path.size();
  return path.substr(0, at) + "-" + text + path.substr(at);
}

std::vector<Settings> ensemble(const Settings &base, const std::vector<std::string> &arguments) {
  std::vector<std::vector<std::string>> runs;
  char *end = nullptr;
  const long count = std::strtol(base.ensemble.c_str(), &end, 10);
  if (*end == '\0') {
    if (count < 1 || count > 100000)
      throw std::invalid_argument("--ensemble = " + base.ensemble + ", expected 1 to 100000 runs");
    for (long k = 0; k < count; ++k)
      runs.push_back({"--seed", std::to_string(base.seed + static_cast<std::uint64_t>(k))});
  } else {
    std::ifstream in(base.ensemble);
    if (!in)
      throw std::invalid_argument("--ensemble = '" + base.ensemble +
                                  "', expected a number of runs or a readable file");
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::vector<std::string> extra;
      for (std::string word; words >> word && word[0] != '#';) extra.push_back(word);
      if (!extra.empty()) runs.push_back(extra);
    }
    if (runs.empty())
      throw std::invalid_argument(base.ensemble + ": no run found, expected options on each line");
  }
  std::vector<Settings> all;
  std::set<std::string> outputs;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    std::vector<std::string> words = arguments;
    words.insert(words.end(), runs[k].begin(), runs[k].end());
    try {
      all.push_back(parse(words));
    } catch (const std::invalid_argument &e) {
      throw std::invalid_argument(fmt::format("run {} of the ensemble: {}", k + 1, e.what()));
    }
    Settings &s = all.back();
    const bool given = std::find(runs[k].begin(), runs[k].end(), "--catalogue") != runs[k].end();
    if (!given) s.run.catalogue = numbered(s.run.catalogue, k + 1);
    s.run.series = numbered(s.run.series, k + 1);
    s.run.checkpoint = numbered(s.run.checkpoint, k + 1);
    for (const std::string &path : {s.run.catalogue, s.run.series, s.run.checkpoint})
      if (!path.empty() && !outputs.insert(path).second)
        throw std::invalid_argument(
            fmt::format("run {} of the ensemble: {} is written by another "
                        "run, expected a file of its own",
                        k + 1, path));
    // Those never reached before the interruption start afresh.
    if (s.run.resume && !std::ifstream(s.run.checkpoint)) s.run.resume = false;
    try {
      Slider::check_replaced(s.run);
    } catch (const std::runtime_error &e) {
      throw std::runtime_error(fmt::format("run {} of the ensemble: {}", k + 1, e.what()));
    }
  }
  return all;
}

int run_all(std::vector<Settings> &all, const Settings &base) {
  if (base.summary != "-") Slider::probe(base.summary, "--json");
  std::vector<Slider::RunResult> results(all.size());
  std::vector<std::string> errors(all.size());
  std::atomic<std::size_t> next{0};
  auto work = [&] {
    for (std::size_t k = next++; k < all.size(); k = next++) {
      const int stopped_by = stop_signal;
      if (stopped_by != 0 && all[k].run.checkpoint.empty()) {
        results[k].interrupted = stopped_by;
        continue;
      }
      try {
        results[k] = Slider::run(all[k].run);
      } catch (const std::exception &e) {
        errors[k] = e.what();
      }
    }
  };
  std::size_t threads = base.threads ? base.threads : std::thread::hardware_concurrency();
  threads = std::max<std::size_t>(1, std::min(threads, all.size()));
  std::vector<std::thread> pool;
  for (std::size_t k = 1; k < threads; ++k) pool.emplace_back(work);
  work();
  for (auto &thread : pool) thread.join();
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
  if (s.summary != "-") Slider::probe(s.summary, "--json");
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
    fmt::print(stderr, "slider_cli: stopped by signal {} at step {}; go on with --resume\n",
               r.interrupted, r.steps);
  return 128 + r.interrupted;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    Settings settings = parse(arguments);
    std::signal(SIGINT, note_signal);
    std::signal(SIGTERM, note_signal);
    warn(settings);
    if (settings.ensemble.empty()) return run_one(settings);
    std::vector<Settings> all = ensemble(settings, arguments);
    return run_all(all, settings);
  } catch (const Done &done) {
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
