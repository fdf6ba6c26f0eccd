// SPDX-License-Identifier: GPL-2.0-or-later
/// \file catalogue_input.h
/// Catalogues as the commands use them: the columns that count, and the options that choose events.
#ifndef LSM_POSTPROC_CATALOGUE_INPUT_H
#define LSM_POSTPROC_CATALOGUE_INPUT_H

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "lsm_catalogue.h"
#include "numbers.h"

namespace LSM::postproc {

/// Which catalogues to read, and which of their events.
struct CatalogueOptions {
  std::vector<std::string> paths;
  std::vector<std::string> labels;  ///< one per path, or none: labels are made from the headers
  bool lenient = false;             ///< repair what can be repaired, and say so
  double min_size = 0.0;            ///< events of smaller size are left out (energy)
  double from_time = -std::numeric_limits<double>::infinity();  ///< first t_start kept
  double to_time = std::numeric_limits<double>::infinity();     ///< first t_start left out

  /// Adds the catalogue arguments, --label, --lenient, --min-size, --from and --to to a command.
  void add_to(CLI::App *command);
};

/// The events of one catalogue, by column.
struct EventTable {
  std::string path, label;
  CatalogueInfo info;
  std::vector<double> t_start, size;  ///< in order of t_start
  double in_events = 0.0;             ///< sum of the durations (model time)
  double last_end = 0.0;              ///< t_end of the last event (model time)
  /// Smaller events are missing: --min-size, or the picker's min_size in the header (energy).
  double complete_from = 0.0;
  /// The largest `completeness` in the headers of the catalogues of this model and kind of event that
  /// were loaded together, so that their curves begin at the same size, and the file that has it (energy).
  double completeness = 0.0;
  std::string completeness_path;
  std::int64_t skipped_lines = 0;    ///< bad lines passed over (lenient)
  std::int64_t left_out_small = 0;   ///< events below min_size
  std::int64_t left_out_time = 0;    ///< events outside [from_time, to_time)
  std::vector<std::string> repairs;  ///< what was passed over, counted by kind (lenient)

  /// Fault length, or the number of blocks of a chain, from the header; NaN if it has neither.
  double length() const;

  /// Part of the time from the first start to the last end that lies within events; NaN if there is
  /// none, or events may overlap (`events = ruptures`).
  /// Ruptures at the same time at different places are one drop of the PE of the whole model, and
  /// so one event: the longer the model, the larger this part and the more events are joined.
  double share_in_events() const;
};

/// The smallest size of the events that a command uses.
class Threshold {
 public:
  /// The paper's, or the completeness of the catalogues where that is larger.
  Threshold() = default;
  /// The one that was given.
  Threshold(double size) : size_(size), given_(true) {}
  bool given() const { return given_; }
  double given_or_paper() const { return size_; }
  double of(const EventTable &table) const {
    return given_ ? size_ : std::max(size_, table.completeness);
  }
  /// "0.01, completeness in the header of x.csv"
  std::string text(const EventTable &table) const;
  /// One line for each model in tables.
  std::vector<std::string> texts(const std::vector<EventTable> &tables) const;

 private:
  double size_ = paper_threshold;
  bool given_ = false;
};

/// Adds --threshold. \param what beside "smallest size of"
CLI::Option *add_threshold(CLI::App *command, Threshold &threshold, const std::string &what);

/// Gives each event of a catalogue that the options choose to use, which need not keep it; returns
/// the table without the columns. \throws CatalogueError "file:line: what, expected ..."
EventTable read_events(const std::string &path, const CatalogueOptions &options,
                       const std::function<void(const Event &)> &use);

/// Reads one catalogue. \throws CatalogueError "file:line: what, expected ..."
EventTable load_catalogue(const std::string &path, const CatalogueOptions &options);

/// \throws std::invalid_argument for impossible times, sizes or numbers of labels.
void check(const CatalogueOptions &options);

/// What was repaired, on standard error.
void state_repairs(const EventTable &table);

/// Reads all options.paths, labels them, and states repairs on standard error.
/// \throws CatalogueError; std::invalid_argument for impossible options.
std::vector<EventTable> load_catalogues(const CatalogueOptions &options);

}  // namespace LSM::postproc

#endif
