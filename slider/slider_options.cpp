// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>
#include <stdexcept>

#include "files/file_error.h"
#include "files/line_reader.h"
#include "files/output_claim.h"
#include "files/replaced_file.h"
#include "files/text.h"
#include "picker_options.h"
#include "slider_stiffness.h"

namespace Slider {

namespace {

using LSM::excludes, LSM::needs, LSM::shown;
using LSM::OptionGroup, LSM::Rule;

const char *const description =
    "Block-slider: a periodic chain of N blocks on a rough surface, coupled by springs K_c and "
    "pulled\n"
    "by a plate of speed V through leaf springs K_l; friction mu_0i / (1 + v), no back-slip\n"
    "(Weatherley and Abe 2004, Sect. 3, after Carlson et al. 1991). Writes a catalogue of the "
    "drops\n"
    "of potential energy (PE). All quantities are in model units. The sign of friction in Eq. 5 is\n"
    "read so that friction resists motion. †: not printed in the paper, chosen here.";

std::int64_t whole(const std::string &option, double value, std::int64_t least) {
  if (!(value >= static_cast<double>(least)) || value > 9e15 || value != std::floor(value))
    refuse(option, value, fmt::format("a whole number of at least {}", least));
  return static_cast<std::int64_t>(value);
}

/// The options of slider_cli and the variables that they set.
class CommandLine {
 public:
  CommandLine() {
    run_.catalogue = "slider_catalogue.csv";
    run_.filter.warmup = 12000.0;
    run_.checkpoint_interval = 1000000;
    p_.friction.dynamic = 0.8;
    LSM::set_up(app_, SLIDER_VERSION);
    const auto checked = [this](std::string &path) {
      check_config(path);
      s_.config = path;
      return std::string();
    };
    app_.set_config("--config", "",
                    "File of 'option = value' lines; the command line has precedence")
        ->check(CLI::Validator(checked, ""));
    app_.allow_config_extras(false);
    app_.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    add_model();
    add_integration();
    add_events();
    add_files();
  }

  Settings read(std::vector<std::string> arguments) {
    if (const auto status = LSM::parse(app_, std::move(arguments))) std::exit(*status);
    interpret();
    set_header();
    return s_;
  }

 private:
  void add_model() {
    OptionGroup group(&app_, "Model (defaults are the paper's values)");
    group.add("--blocks", p_.blocks, "Number of blocks N");
    CLI::Option *const kl = group.add("--kl", p_.kl, "Leaf spring to the plate K_l (force/length)");
    group.add("--coupling", coupling_,
              "What couples the blocks: chain, the springs K_c (paper); † antiplane or inplane, "
              "an elastic block on either side of the fault (slider/laws-and-coupling.md); or a "
              "file, lines 'wavenumber,stiffness' from 0 (the leaf spring) to pi (radians per "
              "block), in place of K_c = 1 and K_l");
    group.add("--width", strip_.width,
              "Thickness of each elastic block, which gives K_l (in blocks) †", shown("from --kl"),
              excludes(kl));
    group.add("--radiation", p_.radiation,
              "Force on a block per velocity by the waves that it sends out, G / 2 c_s for shear "
              "waves into both sides (Rice 1993; force/velocity) †");
    group.add("--mass", p_.mass,
              "Mass of a block M, which divides friction, too (in Eq. 5 it is 1). 0: no inertia "
              "(quasi-dynamic) †, needs --radiation, --law coulomb and a --coupling other than "
              "chain");
    group.add("--velocity", p_.velocity, "Driving velocity of the plate V (length/time)");
    group.add("--friction-range", friction_,
              "Static coefficients mu_0i are uniform in [LOW, HIGH) (force)", LSM::values(2));
    group.add("--correlation-length", p_.landscape.length,
              "The static coefficient of a block is drawn anew after each slip of this length, as "
              "on a rough surface; 0: never (length) †");
    LSM::add_seed(group, s_.seed, "Seed of the coefficients");
    group.choose("--law", p_.friction.law,
                 "Friction of a moving block: velocity-weakening, mu_0i / (1 + v), Eq. 6; † "
                 "coulomb, R mu_0i with the R of --dynamic-friction");
    group.add("--dynamic-friction", p_.friction.dynamic,
              "Dynamic over static coefficient, of coulomb †");
  }

  void add_integration() {
    OptionGroup group(&app_, "Integration");
    paper_option_ = group.flag(
        "--paper", paper_,
        "As printed in the paper, with our time step: --scheme printed --dt 0.01 --steps "
        "1e7 --picker literal --picker-lambda 0.99 --warmup 0");
    const Rule not_paper = excludes(paper_option_);
    CLI::Option *const steps =
        add_whole(group, "--steps", run_.steps, 1, "Number of time steps (instead of --time)",
                  shown("1e7 with --paper, else from --time"));
    group.add("--time", time_, "Model time to run for (time)", excludes(steps), not_paper);
    group.add("--dt", p_.dt, "Time step h (time) †", not_paper);
    group.choose(
        "--scheme", p_.scheme,
        "printed: Eqs. 7 and 8, order 1, for the paper's chain and Eq. 6 only, unstable in the "
        "long run: warns above dt 0.01, refused at 0.12 and above; a block that stops in a step "
        "moves by h v/2; † verlet (order 2), and without inertia (--mass 0) always "
        "adams-bashforth",
        not_paper);
    group.flag("--unstable", unstable_, "Run the printed scheme above these limits");
    group.add(
        "--leap", run_.leap_speed,
        "Slow loading without time steps, a leap †, once no block has been faster than this for "
        "50 time units; 1e-3 is accurate for V up to 1e-3; 0: no leaps (length/time)");
  }

  void add_events() {
    OptionGroup group(&app_, "Events");
    const Rule not_paper = excludes(paper_option_);
    group.choose(
        "--events", run_.events,
        "Definition of an event: pe, a drop of the PE of the whole chain (paper); ruptures, a set "
        "of sliding blocks connected in space and time †, whose size is the work of the springs "
        "on the blocks; they can overlap in time, and are written in the order in which they end");
    picker_.prefix = "picker-";
    const LSM::PickerOptions::Added picker = picker_.add_to(group);
    shown("exponential")(*picker.reading);
    shown("from --picker-memory-time")(*picker.lambda);
    shown("1")(*picker.memory_time);
    shown("0")(*picker.min_size);
    for (CLI::Option *const option : {picker.reading, picker.lambda, picker.memory_time})
      not_paper(*option);
    group.add("--warmup", run_.filter.warmup, "Drop events that start before this time (time) †",
              not_paper);
    group.flag("--without-plate-drops", without_plate_drops_,
               "Leave out drops of PE larger than the largest mu_0 times slip_moment: blocks that "
               "have slipped too far wait for the plate, and PE falls meanwhile †");
  }

  void take_columns(const std::string &list) {
    std::vector<std::string_view> words;
    LSM::text::split(list, words);
    for (const std::string_view word : words) {
      if (word != "centroid" && word != "length")
        throw std::invalid_argument("--columns = '" + list +
                                    "', expected centroid, length or both separated by a comma");
      (word == "centroid" ? run_.x_centroid : run_.rupture_length) = true;
    }
  }

  void add_files() {
    OptionGroup group(&app_, "Files");
    group.add("--catalogue", run_.catalogue, "Catalogue to write");
    group.call<std::string>(
        "--columns", [this](const std::string &list) { take_columns(list); },
        "Columns besides slip_moment (sum of the slips of all blocks): centroid, length, or both "
        "separated by a comma");
    group.add("--pe-series", run_.series, "Series of PE to write (default: none)");
    add_whole(group, "--pe-stride", run_.series_stride, 1,
              "Steps between samples of the series (steps)");
    CLI::Option *const checkpoint =
        group.add("--checkpoint", run_.checkpoint,
                  "Checkpoint to write, also on SIGINT and SIGTERM (default: none)");
    add_whole(group, "--checkpoint-interval", run_.checkpoint_interval, 0,
              "Steps between checkpoints; 0: only when interrupted and at the end (steps)");
    group.flag("--resume", run_.resume,
               "Continue from the checkpoint, a finished run also for longer", needs(checkpoint));
    group.flag("--overwrite", run_.overwrite,
               "Replace catalogue, series and checkpoint of an earlier run");
    group.add("--json", s_.summary, "JSON summary to write; - is standard output");
    group.flag("--progress", run_.progress, "Show the progress on standard error every second");
  }

  /// Refuses keys that appear twice, as CLI11 would silently take the last one.
  /// \throws LSM::FileError
  void check_config(const std::string &path) const {
    using LSM::text::in_quotes;
    using LSM::text::trim;
    LSM::files::LineReader in(path);
    std::set<std::string> keys;
    for (std::string_view line; in.next(line);) {
      const bool marked = in.line() == 1 && in.begin() > 0;
      if (marked || line.find('\0') != std::string_view::npos)
        throw LSM::FileError(path +
                             (marked ? ": begins with a byte order mark" : ": not a text file") +
                             ", expected lines 'option = value'");
      const std::string_view said = trim(line);
      if (said.empty() || std::string_view("#;[").find(said.front()) != std::string_view::npos)
        continue;
      const std::size_t equals = std::min(said.find('='), said.size());
      const std::string key(trim(said.substr(0, equals)));
      if (!keys.insert(key).second) in.fail(in_quotes(key) + " given twice, expected once");
      const std::string_view value = trim(said.substr(std::min(equals + 1, said.size())));
      const CLI::Option *option = app_.get_option_no_throw("--" + key);
      if (option && option->get_items_expected_max() == 1 && !value.empty() &&
          value.find_first_of("\"'#;") == std::string_view::npos &&
          value.find_first_of(" \t,[") != std::string_view::npos)
        in.fail(in_quotes(key) + " is " + in_quotes(value) +
                ", expected one value (in quotes if it has blanks or commas)");
    }
  }

  void interpret() {
    const Law law = p_.friction.law;
    if (given("--dynamic-friction") && law == Law::velocity_weakening)
      throw std::invalid_argument("--dynamic-friction needs --law coulomb");
    if (without_plate_drops_ && run_.events != Events::pe)
      throw std::invalid_argument("--without-plate-drops needs --events pe");
    run_.keep_by_plate = !without_plate_drops_;
    if (run_.catalogue.empty())
      throw std::invalid_argument("--catalogue is empty, expected a file name");
    if (paper_) {
      p_.scheme = Scheme::printed;
      p_.dt = 0.01;
      run_.filter.warmup = 0.0;
      picker_.reading = "literal";
      picker_.lambda = 0.99;
    }
    set_coupling();
    if (p_.mass == 0.0 && !given("--scheme")) p_.scheme = Scheme::adams_bashforth;
    check(p_, unstable_);
    if (run_.leap_speed > 0.0 &&
        (!p_.by_springs() || p_.radiation > 0.0 || p_.landscape.length > 0.0))
      throw std::invalid_argument(
          "--leap needs --coupling chain without --radiation and --correlation-length");
    for (const auto &[option, value] :
         {std::pair("--leap", run_.leap_speed), {"--warmup", run_.filter.warmup}})
      if (!(value >= 0.0) || !std::isfinite(value)) refuse(option, value, "a finite number >= 0");
    if (!given("--steps")) {
      if (!std::isfinite(time_) || !(time_ > 0.0)) refuse("--time", time_, "a positive number");
      run_.steps = paper_ ? 10000000 : whole("--time / --dt", std::round(time_ / p_.dt), 1);
    }
    if (!picker_.says_lambda()) picker_.memory_time = 1.0;
    run_.picker = picker_.over(run_.picker, p_.dt);
    run_.filter = picker_.over(run_.filter);
    const double low = friction_[0], high = friction_[1];
    if (!(low >= 0.0) || !(high >= low) || !std::isfinite(high))
      throw std::invalid_argument(fmt::format(
          "--friction-range = {} {}, expected finite numbers 0 <= LOW <= HIGH", low, high));
    p_.landscape = {p_.landscape.length, low, high, s_.seed};
    run_.mu = random_friction(p_.blocks, low, high, s_.seed);
    if (by_file()) s_.inputs.push_back(coupling_);
  }

  bool by_file() const {
    Coupling named;
    return !from_string(coupling_, named);
  }

  /// Sets the stiffness of the coupling and of the leaf spring.
  void set_coupling() {
    Coupling coupling = Coupling::chain;
    const bool named = from_string(coupling_, coupling);
    if (given("--width") && coupling == Coupling::chain)
      throw std::invalid_argument("--width needs --coupling antiplane or inplane");
    if (p_.blocks < 1) return;  // refused by check()
    if (!named) {
      if (!std::ifstream(coupling_))
        throw std::invalid_argument(
            fmt::format("--coupling = '{}', expected {}, or a readable file", coupling_,
                        LSM::choices(coupling)));
      if (given("--kl"))
        throw std::invalid_argument(
            fmt::format("--kl and --coupling {} exclude each other", coupling_));
      p_.modes = read_modes(coupling_, p_.blocks);
      p_.kl = p_.modes.front();
    } else if (coupling != Coupling::chain) {
      for (const auto &[option, value] :
           {std::pair("--kl", p_.kl), {"--width", given("--width") ? strip_.width : 1.0}})
        if (!std::isfinite(value) || !(value > 0.0))
          refuse(option, value, "a positive finite number");
      strip_ = given("--width") ? strip_of_width(coupling, p_.kc, strip_.width)
                                : strip_of_leaf_spring(coupling, p_.kc, p_.kl);
      p_.kl = strip_.modulus / strip_.width;
      p_.modes = modes_of(coupling, strip_, p_.blocks);
    }
  }

  /// Collects everything that influences the result, for the headers of the files.
  void set_header() {
    const auto add = [this](const char *key, const auto &value, bool used = true) {
      if (used) run_.header.emplace_back(key, fmt::format("{}", value));
    };
    const Law law = p_.friction.law;
    const bool leaps = run_.leap_speed > 0.0, ruptures = run_.events == Events::ruptures;
    add("program", "slider_cli " SLIDER_VERSION);
    add("blocks", p_.blocks);
    const bool strip = strip_.modulus > 0.0;
    add("kc", p_.kc, !by_file());
    add("kl", p_.kl);
    if (by_file()) add("coupling", named_with_checksum(coupling_));
    add("coupling", coupling_, strip);
    add("modulus", strip_.modulus, strip);
    add("width", strip_.width, strip);
    add("radiation", p_.radiation, p_.radiation > 0.0);
    add("mass", p_.mass);
    add("velocity", p_.velocity);
    add("friction_low", friction_[0]);
    add("friction_high", friction_[1]);
    add("correlation_length", p_.landscape.length, p_.landscape.length > 0.0);
    add("seed", s_.seed);
    add("law", to_string(law), law != Law::velocity_weakening);
    add("dynamic_friction", p_.friction.dynamic, law != Law::velocity_weakening);
    add("scheme", to_string(p_.scheme));
    add("dt", p_.dt);
    add("steps", run_.steps);
    add("leap", run_.leap_speed, leaps);
    add("leap_calm", leap_calm, leaps);
    add("events", to_string(run_.events), ruptures);
    add("rupture_gap", 0, ruptures);  // readers know this key
    add("picker", to_string(run_.picker.reading), !ruptures);
    add("lambda", run_.picker.lambda, !ruptures);
    add("min_size", run_.filter.min_size);
    add("keep_nonpositive", run_.filter.keep_nonpositive ? "yes" : "no");
    add("warmup", run_.filter.warmup);
    add("plate_drops", "left out", without_plate_drops_);
  }

  /// Adds an option whose value is a whole number, which may be written as 1e7.
  template <class... Rules>
  static CLI::Option *add_whole(OptionGroup group, const std::string &name, std::int64_t &value,
                                std::int64_t least, const std::string &help,
                                const Rules &...rules) {
    const auto take = [name, &value, least](double x) { value = whole(name, x, least); };
    return group.call<double>(name, take, help, shown(std::to_string(value)), rules...);
  }
  bool given(const std::string &option) const { return app_.count(option) > 0; }

  CLI::App app_{description, "slider_cli"};
  Settings s_;
  RunOptions &run_ = s_.run;
  Parameters &p_ = s_.run.parameters;
  LSM::PickerOptions picker_;
  std::vector<double> friction_ = {0.5, 1.0};
  std::string coupling_ = "chain";
  Strip strip_;
  double time_ = 1e5;
  CLI::Option *paper_option_ = nullptr;
  bool paper_ = false, unstable_ = false, without_plate_drops_ = false;
};

}  // namespace

Settings parse(std::vector<std::string> arguments, const std::atomic<int> *stop) {
  Settings s = CommandLine().read(std::move(arguments));
  s.run.stop = stop;
  return s;
}

void check_files(Settings s) {
  const std::string summary = s.summary == "-" ? std::string() : s.summary;
  std::vector<LSM::Output> outputs = outputs_of(s.run);
  outputs.push_back({"--json", summary});
  const std::string problem = LSM::bad_outputs(outputs);
  if (!problem.empty()) throw std::invalid_argument(problem);
  std::set<std::string> inputs;
  s.inputs.push_back(s.config);
  for (const std::string &path : s.inputs)
    if (!path.empty() && std::ifstream(path)) inputs.insert(LSM::file_identity(path));
  for (const LSM::Output &output : outputs)
    if (!output.path.empty() && inputs.count(LSM::file_identity(output.path)) > 0)
      throw std::invalid_argument(output.what + " " + output.path +
                                  " is read by this run, expected another name for the output");
  const std::string kept = LSM::why_kept(summary, LSM::begins_with("{\n  \"parameters\": {"));
  if (!kept.empty() && !s.run.overwrite) throw std::invalid_argument(kept);
}

}  // namespace Slider
