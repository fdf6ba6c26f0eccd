// SPDX-License-Identifier: GPL-2.0-or-later
/// \file series_input.h
/// PE series as the commands use them: which samples, and how events are picked from them.
#ifndef LSM_POSTPROC_SERIES_INPUT_H
#define LSM_POSTPROC_SERIES_INPUT_H

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include "files/pe_series.h"
#include "options.h"
#include "picker_options.h"
#include "series_figures.h"

namespace LSM::postproc {

/// Which samples of a PE series to use.
struct SeriesOptions {
  bool lenient = false;  ///< drop a truncated last sample, and say so
  double from_time = -std::numeric_limits<double>::infinity();  ///< first time used
  double to_time = std::numeric_limits<double>::infinity();     ///< last time used

  /// Adds --lenient and, if window, --from and --to.
  void add_to(OptionGroup group, bool window);
};

/// Adds the series of commands that take one.
void add_series(OptionGroup group, std::string &path);

/// A PE series that is read in one pass.
class SeriesInput {
 public:
  using Use = std::function<void(std::int64_t step, double time, double pe)>;

  /// \throws FileError; std::invalid_argument for an impossible window.
  SeriesInput(const std::string &path, const SeriesOptions &options);

  const PeSeriesInfo &info() const { return reader_.info(); }
  /// Model time between samples.
  double spacing() const { return info().dt * static_cast<double>(info().stride); }

  /// Path, model and length.
  SeriesRegime about() const;

  /// Calls use with each sample from the first to the one that ends the window, those before the
  /// window too: a picker needs them. States a truncated last sample on standard error (lenient).
  /// Returns the number of samples within the window. \throws FileError
  std::int64_t read(const Use &use = nullptr);
  /// The same of at least three samples within the window. \throws std::runtime_error
  std::int64_t read_some(const Use &use);

 private:
  std::string path_;
  SeriesOptions options_;
  PeSeriesReader reader_;
};

/// Adds the options of the picker to a command.
void add_picker_options(CLI::App *command, PickerOptions &options);

/// The picker that the options ask for. What is not given comes from the header of the series, so
/// that picking afterwards repeats what the run picked; what is not there either has the defaults
/// of PickerSettings.
/// \throws std::invalid_argument naming the option that is out of range
PickerSettings picker_settings(const PickerOptions &options, const PeSeriesInfo &info);

}  // namespace LSM::postproc

#endif
