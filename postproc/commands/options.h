// SPDX-License-Identifier: GPL-2.0-or-later
/// \file options.h
/// Options shared by several commands.
#ifndef LSM_POSTPROC_OPTIONS_H
#define LSM_POSTPROC_OPTIONS_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "event_table.h"
#include "files/catalogue.h"
#include "files/output_claim.h"
#include "magnitudes.h"
#include "option_group.h"
#include "size_figures.h"
#include "units.h"

namespace LSM::postproc {

/// A size, or the magnitude M2.5 of an event of size 10^(1.5 x 2.5).
Rule size_or_magnitude();

/// Adds --p-speed and --s-speed.
void add_wave_speeds(OptionGroup group, double &p_speed, double &s_speed);

/// Adds --block of a bootstrap. \param text for parse_block()
void add_block(OptionGroup group, std::string &text);
/// Resampling::block from "auto" or a time. \throws std::invalid_argument naming --block
double parse_block(const std::string &text);

/// "LO:HI" with LO < HI, numbers or magnitudes as M2.5; an end left out is -infinity or infinity.
/// \throws std::invalid_argument naming the option
Range parse_range(const std::string &option, std::string_view text);

/// "SLOPE" or "SLOPE:LO:HI". \throws std::invalid_argument
PowerLine parse_guide(std::string_view text);

/// \throws std::invalid_argument unless an option was given for all of something or not at all
void expect_each(const char *option, std::size_t given, const char *of, std::size_t count);

/// Name of each input: the one given, or that of its file. \param input what one of them is
/// \throws std::invalid_argument unless there is one for each
std::vector<std::string> labels_of(const std::vector<std::string> &paths,
                                   const std::vector<std::string> &given, const char *input);

/// What the units of the fault are in SI.
struct UnitOptions {
  std::optional<double> length, p_speed, density, thickness;

  /// Adds --unit-length, --p-speed, --density and --thickness.
  void add_to(OptionGroup group);
  bool given() const { return length || p_speed || density || thickness; }
  /// \throws std::invalid_argument if one of the first three is missing
  ModelUnits units() const;
  /// The same for one catalogue. \throws also std::runtime_error if its model has no medium
  ModelUnits units(const std::string &path, const CatalogueInfo &info) const;
};

/// How the commands make magnitudes of events.
struct MagnitudeOptions {
  UnitOptions units;
  std::optional<double> slope, constant;
  double bin = 0.0;  ///< width of the bins; 0: none

  /// Adds --magnitude-slope, --magnitude-constant, --magnitude-bin and add_quantity_to().
  void add_to(OptionGroup group);
  /// Adds --magnitude-of and the units.
  void add_quantity_to(OptionGroup group);
  /// \throws std::invalid_argument for options that contradict each other
  void check() const;
  /// Name of the column from which the magnitude is made.
  std::string of() const { return of_moment() ? "slip_moment" : "size"; }
  bool of_moment() const { return made_of_ == "moment" || (made_of_.empty() && units.given()); }
  double quantity(const Event &event) const { return of_moment() ? event.slip_moment : event.size; }
  /// Mw or Me in SI units, else M.
  std::string type() const;
  /// The formula, for people.
  std::string text() const;
  /// \throws std::runtime_error if a catalogue lacks the column
  void require(const std::string &path, const CatalogueInfo &info) const;
  /// N m or J in a unit of it. \throws as scale()
  double si_unit(const std::string &path, const CatalogueInfo &info) const;
  /// That of one catalogue. \throws std::runtime_error if it lacks the column, or has no units
  MagnitudeScale scale(const std::string &path, const CatalogueInfo &info) const;
  void take_size() { made_of_ = "size"; }
  double slope_used() const { return slope.value_or(MagnitudeScale().slope); }

 private:
  std::string made_of_;
};

/// The file that a command writes in addition to its results.
struct OutputOption {
  std::string path;

  /// Adds --output. \param what is written
  void add_to(OptionGroup group, const std::string &what);
  Output output() const { return {"--output", path}; }
};

/// Option --json: one JSON object with each table by its name, an array with an object for each
/// row.
class JsonOutput {
 public:
  /// With "-" as the file, standard output has only JSON: the text of the command goes to standard
  /// error.
  void add_to(CLI::App *command);
  /// No path, if nothing is written or it goes to standard output.
  Output output() const { return {"--json", path_ == "-" ? std::string() : path_}; }
  /// \throws FileError if it would replace what is no JSON, unless overwrite; once there are
  /// results, also what is no JSON with the same first name, and where it cannot be written
  void check(bool overwrite, const nlohmann::ordered_json *found = nullptr) const;
  /// Writes it, if --json was given. \throws FileError
  void write(const nlohmann::ordered_json &found) const;

 private:
  static std::string text_of(const nlohmann::ordered_json &found);

  std::string path_;
  int standard_output_ = -1;  ///< where it led before, with "-"
};

}  // namespace LSM::postproc

#endif
