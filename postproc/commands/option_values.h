// SPDX-License-Identifier: GPL-2.0-or-later
/// \file option_values.h
/// Values of options that are more than one number or word.
#ifndef LSM_POSTPROC_OPTION_VALUES_H
#define LSM_POSTPROC_OPTION_VALUES_H

#include <cstdint>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include "event_table.h"
#include "size_densities.h"

namespace LSM::postproc {

/// Check of an option that is a number of 0 or more.
CLI::Validator zero_or_more();

/// Adds --seed of the random numbers of a command.
CLI::Option *add_seed(CLI::App *command, std::uint64_t &seed);

/// Turns M2.5 into the size of an event of magnitude 2.5, 10^(1.5 M), for options that are a size.
CLI::Validator size_or_magnitude();

/// "LO:HI" with LO < HI; an end left out is -infinity or infinity.
/// \throws std::invalid_argument naming the option
Range parse_range(const std::string &option, std::string_view text);

/// "SLOPE" or "SLOPE:LO:HI". \throws std::invalid_argument
PowerLine parse_guide(std::string_view text);

/// Adds --p-speed and --s-speed.
void add_wave_speeds(CLI::App *command, double &p_speed, double &s_speed, const std::string &group);

/// Resampling::block from "auto" or a time. \throws std::invalid_argument naming --block
double parse_block(const std::string &text);
constexpr const char *block_help =
    "Length of the stretches of time that are resampled for these errors, since events come in "
    "sequences (model time): auto, from the correlation of each catalogue (Politis and White "
    "2004); "
    "or 0, events one by one as if independent";

}  // namespace LSM::postproc

#endif
