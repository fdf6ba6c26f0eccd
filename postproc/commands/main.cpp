// SPDX-License-Identifier: GPL-2.0-or-later
// postproc: from catalogues and potential energy series to the paper's figures and Table 1.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <map>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "command.h"
#include "files/text.h"
#include "replicas.h"
#include "standard_streams.h"

namespace {

const char *const description =
    "Analysis of event catalogues and potential energy (PE) series of the lattice solid fault and\n"
    "of the block-slider, after Weatherley and Abe (2004), 'the paper'. All quantities are in "
    "model\n"
    "units. 'postproc COMMAND --help' lists the options of a command. †: not in the paper, "
    "chosen here.";

/// Where commands and options of earlier versions are.
const std::map<std::string_view, std::string_view> moved = {
    {"rupture", "python3 -m lsm.ruptures"},      {"report", "inputs/studies/report.py"},
    {"units", "units() of Python's module lsm"}, {"spectrum", "spectrum() of Python's module lsm"},
    {"rates", "rates() of Python's module lsm"}, {"summary", "python3 -m lsm.summary"},
    {"--scaling", "python3 -m lsm.scaling"}};

int fail(std::string what) {
  std::replace(what.begin(), what.end(), '\n', ' ');
  fmt::print(stderr, "postproc: {}\n", what);
  return 1;
}

/// Finds the command whose name has the smallest edit distance to the given word.
template <class Commands>
std::string nearest(std::string_view word, const Commands &commands) {
  std::string best;
  std::size_t fewest = std::string::npos;
  for (const auto &command : commands) {
    const std::string &name = command.first;
    std::vector<std::size_t> row(name.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < word.size(); ++i) {
      std::size_t corner = std::exchange(row[0], i + 1);
      for (std::size_t k = 0; k < name.size(); ++k) {
        const std::size_t changed = corner + (word[i] == name[k] ? 0 : 1);
        corner = row[k + 1];
        row[k + 1] = std::min({changed, row[k] + 1, row[k + 1] + 1});
      }
    }
    if (row.back() >= fewest) continue;
    fewest = row.back();
    best = name;
  }
  return best;
}

/// Shows on a terminal the progress of a long Monte Carlo test.
class Progress {
 public:
  void operator()(int done, int count) {
    const auto now = Clock::now();
    if (done == 1) {
      begin_ = printed_ = now;
      shown_ = false;
    }
    if (done == count && shown_) {
      fmt::print(stderr, "\r\033[K");
    } else if (now - begin_ > std::chrono::seconds(1) &&
               now - printed_ > std::chrono::milliseconds(200)) {
      fmt::print(stderr, "\rMonte Carlo replica {} of {}", done, count);
      shown_ = true;
      printed_ = now;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_, printed_;
  bool shown_ = false;
};

}  // namespace

int main(int argc, char **argv) {
  using namespace LSM::postproc;
  LSM::occupy_standard_streams();
  if (isatty(STDERR_FILENO)) watch_replicas(Progress());
  try {
    CLI::App app(description, "postproc");
    LSM::set_up(app, "postproc " POSTPROC_VERSION);
    app.require_subcommand(1);
    const auto commands = all_commands();
    for (const auto &[name, command] : commands) {
      CLI::App *const sub = app.add_subcommand(name, command->help());
      command->add_all_options(sub);
      sub->callback([command = command] { command->run(); });
    }
    app.footer(
        "Exit status: 0, or 1 after one line on standard error that begins with 'postproc:'.");
    for (int i = 1; i < argc; ++i)
      if (const auto place = moved.find(argv[i]);
          place != moved.end() && (i == 1 || argv[i][0] == '-'))
        return fail(fmt::format("'{}' has left, see {}", place->first, place->second));
    if (argc > 1 && argv[1][0] != '-' &&
        std::none_of(commands.begin(), commands.end(),
                     [argv](const auto &command) { return command.first == argv[1]; }))
      return fail("unknown command " + LSM::text::in_quotes(argv[1]) + ", did you mean '" +
                  nearest(argv[1], commands) + "'? (--help lists the options)");
    if (const auto status = LSM::parse(app, {argv + 1, argv + argc})) return *status;
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      return fail("cannot write to standard output");
    return 0;
  } catch (const std::exception &e) {
    return fail(e.what());
  }
}
