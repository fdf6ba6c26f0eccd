// SPDX-License-Identifier: GPL-2.0-or-later
#include "json_output.h"

#include <unistd.h>

#include <cstdio>

#include <fmt/format.h>

#include "new_file.h"

namespace LSM::postproc {

void JsonOutput::add_to(CLI::App *command) {
  command
      ->add_option_function<std::string>(
          "--json",
          [this](const std::string &path) {
            path_ = path;
            if (path != "-") return;
            standard_output_ = dup(STDOUT_FILENO);
            dup2(STDERR_FILENO, STDOUT_FILENO);
          },
          "Also write the numbers to this file, as JSON; -: to standard output, everything else to "
          "standard error")
      ->type_name("FILE")
      ->default_str("");
}

void JsonOutput::check(const std::vector<std::string> &inputs) const {
  if (!path_.empty() && path_ != "-") refuse_input(path_, inputs);
}

void JsonOutput::write() const {
  if (path_.empty()) return;
  const std::string text = found_.dump(2) + "\n";
  if (path_ != "-") {
    write_file(path_, text);
    fmt::print("wrote {}\n", path_);
    return;
  }
  std::FILE *const out = fdopen(standard_output_, "w");
  const bool written = out && std::fputs(text.c_str(), out) >= 0;
  if ((out && std::fclose(out) != 0) || !written)
    throw FileError("cannot write to standard output");
}

}  // namespace LSM::postproc
