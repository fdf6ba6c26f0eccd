// SPDX-License-Identifier: GPL-2.0-or-later
// postproc: from catalogues and potential energy series to the paper's figures and Table 1.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "command.h"
#include "files/text.h"
#include "standard_streams.h"

namespace {

const char *const description =
    "Analysis of event catalogues and potential energy (PE) series of the lattice solid fault and\n"
    "of the block-slider, after Weatherley and Abe (2004), 'the paper'. All quantities are in "
    "model\n"
    "units. 'postproc COMMAND --help' lists the options of a command. †: not in the paper, "
    "chosen here.";

int fail(std::string what) {
  std::replace(what.begin(), what.end(), '\n', ' ');
  fmt::print(stderr, "postproc: {}\n", what);
  return 1;
}

}  // namespace

int main(int argc, char **argv) {
  using namespace LSM::postproc;
  LSM::occupy_standard_streams();
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
    if (argc > 1 && argv[1][0] != '-' &&
        std::none_of(commands.begin(), commands.end(),
                     [argv](const auto &command) { return command.first == argv[1]; })) {
      std::string names;
      for (const auto &[name, command] : commands) names += (names.empty() ? "" : ", ") + name;
      return fail("unknown command " + LSM::text::in_quotes(argv[1]) + ", expected one of " +
                  names);
    }
    if (const auto status = LSM::parse(app, {argv + 1, argv + argc})) return *status;
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      return fail("cannot write to standard output");
    return 0;
  } catch (const std::exception &e) {
    return fail(e.what());
  }
}
