// SPDX-License-Identifier: GPL-2.0-or-later
/// \file series_input.h
/// How PE series are read, and which samples.
#ifndef LSM_POSTPROC_SERIES_INPUT_H
#define LSM_POSTPROC_SERIES_INPUT_H

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include "files/pe_series.h"

namespace LSM::postproc {

/// Which samples of a PE series to use.
struct SeriesOptions {
  bool lenient = false;  ///< drop and report a truncated last sample
  double from_time = -std::numeric_limits<double>::infinity();  ///< first time used
  double to_time = std::numeric_limits<double>::infinity();     ///< last time used
};

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

}  // namespace LSM::postproc

#endif
