// SPDX-License-Identifier: GPL-2.0-or-later
#include "picture_options.h"

namespace LSM::postproc {

void add_picture_options(CLI::App *command, PictureOptions &picture, const std::string &base) {
  picture.output = base;
  command
      ->add_option("-o,--output", picture.output,
                   "BASE of the files written: BASE.csv (table), BASE.gp (gnuplot script), "
                   "BASE.png and BASE.svg")
      ->type_name("BASE")
      ->capture_default_str();
  command->add_flag("--no-picture", picture.no_picture,
                    "Write the table and the script, do not run gnuplot");
}

PictureOptions named(const PictureOptions &options, const std::string &name) {
  PictureOptions one = options;
  one.output += name;
  return one;
}

}  // namespace LSM::postproc
