// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>

#include "lsm_output_claim.h"
#include "picker_options.h"
#include "whole_number.h"

namespace Slider {

namespace {

const char *const description =
    "Block-slider: a periodic chain of N blocks on a rough surface, coupled by springs K_c and "
    "pulled\n"
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
    "other friction laws (--law), ruptures as another kind of events (--events ruptures).\n"
    "The sign of friction in Eq. 5 is read so that friction resists motion.";

std::int64_t whole(const std::string &option, double value, double least) {
  if (!(value >= least) || value > 9e15 || value != std::floor(value))
    throw std::invalid_argument(
        fmt::format("{} = {}, expected a whole number of at least {}", option, value, least));
  return static_cast<std::int64_t>(value);
}

std::string number(double x) { return fmt::format("{}", x); }

template <class Enum>
void choose(const char *option, const std::string &word, Enum &value) {
  if (!from_string(word, value))
    throw std::invalid_argument(
        fmt::format("{} = '{}', expected {}", option, word, LSM::choices(value)));
}

void add_model(CLI::App &app, Settings &s) {
  Parameters &p = s.run.parameters;
  app.option_defaults()->group("Model (defaults are the paper's values)");
  app.add_option("--blocks", p.blocks, "Number of blocks N");
  app.add_option("--kc", p.kc, "Spring between neighbours K_c (force/length)");
  app.add_option("--kl", p.kl, "Leaf spring to the plate K_l (force/length)");
  app.add_option("--mass", p.mass, "Mass of a block M");
  app.add_option("--velocity", p.velocity, "Driving velocity of the plate V (length/time)");
  auto *range = app.add_option("--friction-range", s.friction,
                               "Static coefficients mu_0i are uniform in [LOW, HIGH) (force)")
                    ->expected(2);
  app.add_option("--friction-file", s.friction_file,
                 "File with one static coefficient per line, one line per block")
      ->excludes(range);
  app.add_option("--seed", s.seed, "Seed of the coefficients")->check(LSM::whole_number());
  app.add_option("--law", s.law,
                 "Friction of a moving block: velocity-weakening, mu_0i / (1 + v), Eq. 6; ours: "
                 "coulomb, R mu_0i with the R of --dynamic-friction; slip-weakening, from mu_0i to "
                 "R mu_0i over the slip of --slip-distance since the block last rested");
  app.add_option("--dynamic-friction", s.dynamic,
                 "Dynamic over static coefficient, of coulomb and slip-weakening (ours)");
  app.add_option("--slip-distance", s.distance,
                 "Slip over which slip-weakening weakens (length; ours)");
}

void add_integration(CLI::App &app, Settings &s) {
  Parameters &p = s.run.parameters;
  app.option_defaults()->group("Integration");
  app.add_flag("--paper", s.paper,
               "As printed in the paper, with our time step: --scheme printed --dt 0.01 --steps "
               "1e7 --picker literal --picker-lambda 0.99 --warmup 0");
  auto *steps = app.add_option("--steps", s.steps, "Number of time steps (instead of --time)");
  steps->default_str("1e7 with --paper, else from --time");
  app.add_option("--time", s.time, "Model time to run for (time)")->excludes(steps);
  app.add_option("--dt", p.dt, "Time step h (time; ours, the paper gives none)");
  app.add_option("--scheme", s.scheme,
                 "printed: Eqs. 7 and 8, order 1, unstable in the long run: warns above dt 0.01, "
                 "refused at 0.12 and above; ours: semi-implicit (order 1), verlet (order 2)");
  app.add_flag("--force", s.force, "Run the printed scheme above these limits");
  app.add_option("--kernel", s.kernel,
                 "active (only moving chunks of blocks) or dense (all blocks; same catalogue)");
  app.add_option(
      "--leap", s.run.leap_speed,
      "Leap over slow loading (ours): once no block has been faster than this for the time "
      "--leap-calm, blocks at their limit creep without steps, in the limit of a slow plate, "
      "until some are about to exceed it; 1e-3 is accurate for V up to 1e-3; 0: no leaps. Model "
      "time and steps continue (length/time)");
  app.add_option("--leap-calm", s.run.leap_calm,
                 "Time without a faster block before each leap, long enough for a runaway of "
                 "blocks to become visible (time)");
}

void add_events(CLI::App &app, Settings &s) {
  const std::string events = "Events";
  app.option_defaults()->group(events);
  app.add_option(
      "--events", s.events,
      "Definition of an event: pe, a drop of the PE of the whole chain (paper); ruptures, a set "
      "of sliding blocks connected in space and time (ours). Ruptures far apart stay separate in "
      "long chains, and ruptures can overlap in time; their size is the work of the springs on "
      "the blocks, they are written in the order in which they end, and the options of the "
      "picker do not apply");
  app.add_option("--rupture-gap", s.rupture_gap,
                 "With --events ruptures: time for which a block at rest still connects, in "
                 "addition to one time step (time; ours)");
  s.picker.prefix = "picker-";
  const LSM::AddedPickerOptions picker = LSM::add_picker_options(&app, s.picker, events);
  picker.reading->default_str("exponential");
  picker.lambda->default_str("from --picker-memory-time");
  picker.memory_time->default_str("1");
  picker.min_size->default_str("0");
  app.add_option("--warmup", s.run.warmup, "Drop events that start before this time (time; ours)");
  for (CLI::Option *option :
       {app.get_option("--time"), app.get_option("--dt"), app.get_option("--scheme"),
        picker.reading, picker.lambda, picker.memory_time, app.get_option("--warmup")})
    option->excludes(app.get_option("--paper"));
}

void add_files(CLI::App &app, Settings &s) {
  app.option_defaults()->group("Files");
  app.add_option("--catalogue", s.run.catalogue, "Catalogue to write");
  app.add_option("--columns", s.columns,
                 "Further columns: centroid, length, or both separated by a comma; slip_moment "
                 "(sum of the slips of all blocks) is always written");
  app.add_option("--pe-series", s.run.series, "Series of PE to write (default: none)");
  app.add_option("--pe-stride", s.stride, "Steps between samples of the series (steps)");
  app.add_option("--checkpoint", s.run.checkpoint,
                 "Checkpoint to write, also on SIGINT and SIGTERM (default: none)");
  app.add_option("--checkpoint-interval", s.interval,
                 "Steps between checkpoints; 0: only when interrupted and at the end (steps)");
  app.add_flag("--resume", s.run.resume,
               "Continue from the checkpoint; the catalogue ends as if never interrupted");
  app.add_flag("--overwrite", s.run.overwrite,
               "Replace catalogue, series and checkpoint of an earlier run, which is refused "
               "otherwise; with --resume, those of runs of an ensemble that have no checkpoint");
  app.add_option("--json", s.summary, "JSON summary to write; - is standard output");
  app.add_flag("--progress", s.run.progress, "Show the progress on standard error every second");
}

void add_ensemble(CLI::App &app, Settings &s) {
  app.option_defaults()->group("Several runs");
  app.add_option(
      "--ensemble", s.ensemble,
      "A number of runs with successive seeds, or a file with the options of one run per "
      "line; '{run}' in output names is replaced by the run's number, from 1, or put "
      "before the extension");
  app.add_option("--threads", s.threads, "Runs at a time; 0: one per core")
      ->check(LSM::whole_number(4096));
}

/// What is wrong with a file of 'option = value' lines, or "": CLI11 silently takes the last of two
/// values.
std::string bad_config(const CLI::App &app, const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (text.find('\0') != std::string::npos)
    return path + ": not a text file, expected lines 'option = value'";
  if (text.compare(0, 3, "\xef\xbb\xbf") == 0)
    return path + ": begins with a byte order mark, expected lines 'option = value'";
  std::set<std::string> keys;
  std::istringstream lines(text);
  std::string line;
  for (std::int64_t number = 1; std::getline(lines, line); ++number) {
    const std::string_view said = LSM::text_io::trim(line);
    if (said.empty() || std::string_view("#;[").find(said.front()) != std::string_view::npos)
      continue;
    const std::size_t equals = std::min(said.find('='), said.size());
    const std::string key(LSM::text_io::trim(said.substr(0, equals)));
    const std::string where = LSM::text_io::where(path, number);
    if (!keys.insert(key).second)
      return where + LSM::text_io::in_quotes(key) + " given twice, expected once";
    const CLI::Option *option = app.get_option_no_throw("--" + key);
    const std::string_view value =
        LSM::text_io::trim(said.substr(std::min(equals + 1, said.size())));
    if (option && option->get_items_expected_max() == 1 && !value.empty() &&
        value.find_first_of("\"'#;") == std::string_view::npos &&
        value.find_first_of(" \t,[") != std::string_view::npos)
      return where + LSM::text_io::in_quotes(key) + " is " + LSM::text_io::in_quotes(value) +
             ", expected one value (in quotes if it has blanks)";
  }
  return {};
}

/// \throws Done; std::invalid_argument
void read_arguments(CLI::App &app, std::vector<std::string> arguments) {
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
}

void interpret_law(Settings &s, const CLI::App &app) {
  Friction &friction = s.run.parameters.friction;
  if (!from_string(s.law, friction.law))
    throw std::invalid_argument("--law = '" + s.law +
                                "', expected velocity-weakening, coulomb or slip-weakening (with "
                                "other laws of pair_style lsm/friction no block rests)");
  if (app.count("--dynamic-friction") > 0 && friction.law == Law::velocity_weakening)
    throw std::invalid_argument("--dynamic-friction needs --law coulomb or slip-weakening");
  if (app.count("--slip-distance") > 0 && friction.law != Law::slip_weakening)
    throw std::invalid_argument("--slip-distance needs --law slip-weakening");
  if (friction.law != Law::velocity_weakening) friction.dynamic = s.dynamic;
  if (friction.law == Law::slip_weakening) friction.dc = s.distance;
}

void interpret_integration(Settings &s, const CLI::App &app) {
  Parameters &p = s.run.parameters;
  if (s.paper) {
    s.scheme = "printed";
    p.dt = 0.01;
    s.run.warmup = 0.0;
  }
  choose("--scheme", s.scheme, p.scheme);
  choose("--kernel", s.kernel, s.run.kernel);
  choose("--events", s.events, s.run.events);
  check(p, s.force);
  if (app.count("--leap-calm") > 0 && app.count("--leap") == 0)
    throw std::invalid_argument("--leap-calm needs --leap");
  check_leaps(s.run);
  if (app.count("--steps") > 0 || s.paper) {
    s.run.steps = whole("--steps", s.steps, 1);
  } else {
    if (!std::isfinite(s.time) || !(s.time > 0.0))
      throw std::invalid_argument("--time = " + number(s.time) + ", expected a positive number");
    const double n = std::round(s.time / p.dt);
    s.run.steps = whole("--time / --dt", n, 1);
  }
}

void interpret_events(Settings &s, const CLI::App &app) {
  if (s.paper) {
    s.picker.reading = "literal";
    s.picker.lambda = 0.99;
  }
  if (!s.picker.says_lambda()) s.picker.memory_time = 1.0;
  s.run.picker = s.picker.over(s.run.picker, s.run.parameters.dt);
  if (!(s.run.warmup >= 0.0) || !std::isfinite(s.run.warmup))
    throw std::invalid_argument("--warmup = " + number(s.run.warmup) +
                                ", expected a finite number >= 0");
  const bool ruptures = s.run.events == Events::ruptures;
  if (app.count("--rupture-gap") > 0 && !ruptures)
    throw std::invalid_argument("--rupture-gap needs --events ruptures");
  const double gap_steps = std::round(s.rupture_gap / s.run.parameters.dt);
  if (!(s.rupture_gap >= 0.0) || !(gap_steps < 1e15))
    throw std::invalid_argument("--rupture-gap = " + number(s.rupture_gap) +
                                ", expected a number >= 0 and less than 1e15 time steps");
  s.run.rupture_memory = 1 + static_cast<std::int64_t>(gap_steps);
}

void interpret_files(Settings &s) {
  s.run.series_stride = whole("--pe-stride", s.stride, 1);
  s.run.checkpoint_interval = whole("--checkpoint-interval", s.interval, 0);
  std::stringstream words(s.columns);
  for (std::string word; std::getline(words, word, ',');) {
    if (word == "centroid")
      s.run.x_centroid = true;
    else if (word == "length")
      s.run.rupture_length = true;
    else
      throw std::invalid_argument("--columns = '" + s.columns +
                                  "', expected centroid, length or both separated by a comma");
  }
  if (s.run.catalogue.empty())
    throw std::invalid_argument("--catalogue is empty, expected a file name");
  if (s.run.resume && s.run.checkpoint.empty())
    throw std::invalid_argument("--resume needs --checkpoint FILE");
}

void set_friction(Settings &s) {
  const Parameters &p = s.run.parameters;
  if (!s.friction_file.empty()) {
    s.run.mu = read_friction(s.friction_file);
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
    s.run.mu = random_friction(p.blocks, s.friction[0], s.friction[1], s.seed);
  }
}

// FNV-1a, as in all earlier catalogues.
std::uint64_t friction_checksum(const std::vector<double> &mu) {
  std::uint64_t sum = 14695981039346656037ULL;
  const auto *bytes = reinterpret_cast<const unsigned char *>(mu.data());
  for (std::size_t i = 0; i < mu.size() * sizeof(double); ++i)
    sum = (sum ^ bytes[i]) * 1099511628211ULL;
  return sum;
}

/// Everything that shapes the result, for the headers of the files.
void set_header(Settings &s) {
  const Parameters &p = s.run.parameters;
  auto &h = s.run.header;
  const auto add = [&h](std::initializer_list<std::pair<std::string, std::string>> some) {
    h.insert(h.end(), some);
  };
  add({{"program", std::string("slider_cli ") + SLIDER_VERSION},
       {"blocks", std::to_string(p.blocks)},
       {"kc", number(p.kc)},
       {"kl", number(p.kl)},
       {"mass", number(p.mass)},
       {"velocity", number(p.velocity)}});
  if (s.friction_file.empty())
    add({{"friction_low", number(s.friction[0])},
         {"friction_high", number(s.friction[1])},
         {"seed", std::to_string(s.seed)}});
  else  // The coefficients count, not the path of the file.
    add({{"friction_checksum", fmt::format("{:016x}", friction_checksum(s.run.mu))}});
  if (p.friction.law != Law::velocity_weakening)
    add({{"law", s.law}, {"dynamic_friction", number(p.friction.dynamic)}});
  if (p.friction.law == Law::slip_weakening) add({{"slip_distance", number(p.friction.dc)}});
  add({{"scheme", to_string(p.scheme)},
       {"dt", number(p.dt)},
       {"steps", std::to_string(s.run.steps)}});
  if (s.run.leap_speed > 0.0)
    add({{"leap", number(s.run.leap_speed)}, {"leap_calm", number(s.run.leap_calm)}});
  if (s.run.events == Events::ruptures)
    add({{"events", "ruptures"}, {"rupture_gap", number(s.rupture_gap)}});
  else
    add({{"picker", to_string(s.run.picker.reading)}, {"lambda", number(s.run.picker.lambda)}});
  add({{"min_size", number(s.run.picker.min_size)},
       {"keep_nonpositive", s.run.picker.keep_nonpositive ? "yes" : "no"},
       {"warmup", number(s.run.warmup)}});
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

}  // namespace

Settings parse(std::vector<std::string> arguments, const std::atomic<int> *stop) {
  Settings s;
  s.run.catalogue = "slider_catalogue.csv";
  s.run.warmup = 12000.0;
  s.run.stop = stop;
  CLI::App app(description, "slider_cli");
  app.set_version_flag("--version", std::string(SLIDER_VERSION));
  app.set_config("--config", "", "File of 'option = value' lines; the command line has precedence")
      ->check(CLI::Validator([&app](std::string &path) { return bad_config(app, path); }, ""));
  app.allow_config_extras(false);
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.option_defaults()->always_capture_default();
  app.get_formatter()->column_width(34);

  add_model(app, s);
  add_integration(app, s);
  add_events(app, s);
  add_files(app, s);
  add_ensemble(app, s);
  read_arguments(app, std::move(arguments));
  if (app.get_config_ptr()->count() > 0) s.config = app.get_config_ptr()->as<std::string>();
  interpret_law(s, app);
  interpret_integration(s, app);
  interpret_events(s, app);
  interpret_files(s);
  set_friction(s);
  set_header(s);
  return s;
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
    if (!std::ifstream(base.ensemble))
      throw std::invalid_argument("--ensemble = '" + base.ensemble +
                                  "', expected a number of runs or a readable file");
    LSM::text_io::LineReader in(base.ensemble);
    for (std::string_view line; in.next(line);) {
      std::istringstream words{std::string(line)};
      std::vector<std::string> extra;
      for (std::string word; words >> word && word[0] != '#';) extra.push_back(word);
      if (!extra.empty()) runs.push_back(extra);
    }
    if (runs.empty())
      throw std::invalid_argument(base.ensemble + ": no run found, expected options on each line");
  }
  std::vector<Settings> all;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    std::vector<std::string> words = arguments;
    words.insert(words.end(), runs[k].begin(), runs[k].end());
    try {
      all.push_back(parse(words, base.run.stop));
    } catch (const std::invalid_argument &e) {
      throw std::invalid_argument(fmt::format("run {} of the ensemble: {}", k + 1, e.what()));
    }
    Settings &s = all.back();
    const bool given = std::find(runs[k].begin(), runs[k].end(), "--catalogue") != runs[k].end();
    if (!given) s.run.catalogue = numbered(s.run.catalogue, k + 1);
    s.run.series = numbered(s.run.series, k + 1);
    s.run.checkpoint = numbered(s.run.checkpoint, k + 1);
    // Runs not reached before the interruption start anew.
    if (s.run.resume && !std::ifstream(s.run.checkpoint)) s.run.resume = false;
    try {
      check_replaced(s.run);
    } catch (const std::runtime_error &e) {
      throw std::runtime_error(fmt::format("run {} of the ensemble: {}", k + 1, e.what()));
    }
  }
  return all;
}

void check_files(const std::vector<Settings> &all) {
  std::vector<LSM::Output> outputs;
  for (std::size_t k = 0; k < all.size(); ++k)
    for (LSM::Output &output : outputs_of(all[k].run)) {
      if (all.size() > 1)
        output.what = fmt::format("run {} of the ensemble: {}", k + 1, output.what);
      outputs.push_back(std::move(output));
    }
  const Settings &any = all.front();
  if (any.summary != "-") outputs.push_back({"--json", any.summary});
  const std::string problem = LSM::bad_outputs(outputs);
  if (!problem.empty()) throw std::invalid_argument(problem);
  std::set<std::string> inputs;
  for (const Settings &s : all)
    for (const std::string &path : {s.friction_file, s.config, s.ensemble})
      if (!path.empty() && std::ifstream(path)) inputs.insert(LSM::file_identity(path));
  for (const LSM::Output &output : outputs)
    if (!output.path.empty() && inputs.count(LSM::file_identity(output.path)) > 0)
      throw std::invalid_argument(output.what + " " + output.path +
                                  " is read by this run, expected another name for the output");
}

}  // namespace Slider
