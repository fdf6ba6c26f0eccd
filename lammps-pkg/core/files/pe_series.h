// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/pe_series.h
/// Time series of the total elastic potential energy (PE), Sect. 4.1 of Weatherley and Abe (2004).
/// PE is kept in double precision, as its change per step is about 1e-9 of its value.
///
/// Binary: 16 bytes "lsm-pe-series-1\n", int64 length of the header, the header (lines
/// "# key = value": model, dt, step0, time0, stride, then the others), then records of int64 step
/// and double pe; everything little-endian. time = time0 + (step - step0) dt.
///
/// If steps and time are not proportional (fix lsm/leap), the header has "times = own", and a
/// record is int64 step, double time, double pe.
#ifndef LSM_PE_SERIES_H
#define LSM_PE_SERIES_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/binary_io.h"
#include "files/input_bytes.h"
#include "files/parameters.h"

namespace LSM {

/// Header of a PE series.
struct PeSeriesInfo : files::FileHeader {
  static constexpr std::string_view magic = "lsm-pe-series-1\n";
  static constexpr const char *what = "PE series";

  double dt = 1.0;              ///< time step of the simulation (model time), > 0
  std::int64_t step0 = 0;       ///< step of time0, usually that of the first sample
  double time0 = 0.0;           ///< time at step0
  std::int64_t stride = 1;      ///< steps between samples, >= 1
  bool explicit_times = false;  ///< each sample has its own time; time() does not apply

  /// Steps are subtracted as doubles (exact below 2^53), so that no header can cause an overflow.
  double time(std::int64_t step) const;

  template <class Self, class F>
  static void visit(Self &self, F &&f) {
    f("dt", self.dt);
    f("step0", self.step0);
    f("time0", self.time0);
    f("stride", self.stride);
  }
  files::Parameters header() const;
  std::string read(const files::Parameters &all);
  std::string problem() const;
  std::int64_t record_bytes() const { return explicit_times ? 24 : 16; }
};

/// Reads a PE series sample by sample.
class PeSeriesReader : public binary_io::RecordReader<PeSeriesInfo> {
 public:
  explicit PeSeriesReader(std::unique_ptr<files::Bytes> in, bool lenient = false)
      : RecordReader(std::move(in), lenient) {}

  /// Reads the next sample; returns false at the end of the file. Checks that steps increase and
  /// numbers are finite.
  /// \throws FileError
  bool next(std::int64_t &step, double &time, double &pe);

 private:
  bool has_last_ = false;
  std::int64_t last_step_ = 0;
  double last_time_ = 0.0;
};

/// Writes a PE series. Samples are collected and handed to the operating system in blocks of whole
/// samples; flush() before writing a restart, or find_cut() finds samples missing.
class PeSeriesWriter : public binary_io::RecordWriter<PeSeriesInfo> {
 public:
  ~PeSeriesWriter();

  /// \throws as begin()
  void create(const std::string &path, const PeSeriesInfo &info);

  /// Inspects the series of a run restarted from last_step, which cut() will continue: checks that
  /// the header is what create() would write, and finds the first sample after last_step or a
  /// truncated last one.
  /// \throws FileError naming the first parameter that differs, the first bad line, or the samples
  /// missing before last_step.
  void find_cut(const std::string &path, const PeSeriesInfo &info, std::int64_t last_step);

  /// Adds a sample at the time given by its step.
  /// \throws FileError as the function below
  /// \throws std::logic_error for a series with explicit_times
  void write(std::int64_t step, double pe);

  /// Adds a sample.
  /// \param time used with explicit_times only
  /// \throws FileError if a number is not finite, steps or times do not increase, or a block cannot
  /// be written.
  void write(std::int64_t step, double time, double pe);

  /// Hands all samples so far to the operating system.
  /// \throws FileError
  void flush();

  /// Closes the file. The destructor does this, too, but ignores errors.
  /// \throws FileError
  void close();

  std::int64_t rows() const { return rows_; }  ///< samples so far, kept ones included

 private:
  static constexpr std::size_t buffer_limit = 1 << 16;

  void start();

  std::int64_t rows_ = 0, last_step_ = 0;
  double last_time_ = 0.0;
  std::string buffer_;
};

}  // namespace LSM

#endif
