// SPDX-License-Identifier: GPL-2.0-or-later
/// \file series_input.h
/// How commands read PE series: which samples they use, and how events are picked from them.
#ifndef LSM_POSTPROC_SERIES_INPUT_H
#define LSM_POSTPROC_SERIES_INPUT_H

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include "files/pe_series.h"
#include "options.h"
#include "picker_options.h"

namespace LSM::postproc {

/// Which samples of a PE series to use.
struct SeriesOptions {
  bool lenient = false;  ///< drop and report a truncated last sample
  double from_time = -std::numeric_limits<double>::infinity();  ///< first time used
  double to_time = std::numeric_limits<double>::infinity();     ///< last time used

  /// Adds --lenient.
  /// \param window whether to add --from and --to as well
  void add_to(OptionGroup group, bool window);
};

/// Adds the argument of commands that read one series.
void add_series(OptionGroup group, std::string &path);

/// A PE series that is read in one pass.
class SeriesInput {
 public:
  using Use = std::function<void(std::int64_t step, double time, double pe)>;

  /// \throws FileError
  /// \throws std::invalid_argument for an impossible window
  SeriesInput(const std::string &path, const SeriesOptions &options);

  const PeSeriesInfo &info() const { return reader_.info(); }

  /// Reads the samples up to the end of the window. Reports a truncated last sample on standard
  /// error (lenient).
  /// \param use called with each sample, also with those before the window, which a picker needs
  /// \return number of samples within the window
  /// \throws FileError
  std::int64_t read(const Use &use);
  /// As read().
  /// \throws std::runtime_error if there are fewer than three samples within the window
  std::int64_t read_some(const Use &use);

 private:
  std::string path_;
  SeriesOptions options_;
  PeSeriesReader reader_;
};

/// Adds the options of the picker to a command.
void add_picker_options(CLI::App *command, PickerOptions &options);

/// Settings of picker and filter from the options. Those not given come from the header of the
/// series, so that picking afterwards repeats what the run picked, or else are the defaults. The
/// filter has no warm-up.
/// \throws std::invalid_argument naming the option that is out of range
PickerSettings picker_settings(const PickerOptions &options, const PeSeriesInfo &info);
FilterSettings filter_settings(const PickerOptions &options, const PeSeriesInfo &info);

}  // namespace LSM::postproc

#endif
