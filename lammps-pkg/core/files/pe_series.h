// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/pe_series.h
/// Time series of the total elastic potential energy (PE), Sect. 4.1 of Weatherley and Abe (2004).
/// PE is kept in double precision: the sign of its change per step matters at
/// 1e-9 of its value.
///
/// Binary: 16 bytes "lsm-pe-series-1\n", int64 length of the header, the header (lines
/// "# key = value": model, dt, step0, time0, stride, then the others), then records of int64 step
/// and double pe; everything little-endian. time = time0 + (step - step0) dt.
///
/// If steps and time are not proportional (fix lsm/leap), the header has "times = own", and a
/// record is int64 step, double time, double pe. `postproc series --export` makes a text of it.
#ifndef LSM_PE_SERIES_H
#define LSM_PE_SERIES_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/binary_io.h"
#include "files/text_io.h"

namespace LSM {

/// Header of a PE series.
struct PeSeriesInfo : text_io::FileHeader {
  static constexpr std::string_view magic = "lsm-pe-series-1\n";
  static constexpr const char *what = "PE series";

  double dt = 1.0;              ///< time step of the simulation (model time), > 0
  std::int64_t step0 = 0;       ///< step of time0, usually that of the first sample
  double time0 = 0.0;           ///< time at step0
  std::int64_t stride = 1;      ///< steps between samples, >= 1
  bool explicit_times = false;  ///< each sample has its own time; time() does not apply

  /// Steps are subtracted as doubles (exact below 2^53), so that no header can make this overflow.
  double time(std::int64_t step) const {
    return time0 + (static_cast<double>(step) - static_cast<double>(step0)) * dt;
  }

  template <class Self, class F>
  static void visit(Self &self, F &&f) {
    f("dt", self.dt);
    f("step0", self.step0);
    f("time0", self.time0);
    f("stride", self.stride);
  }
  text_io::Parameters header() const {
    text_io::Parameters all = binary_io::numbers_of(*this);
    if (explicit_times) all.emplace_back("times", "own");
    all.insert(all.end(), parameters.begin(), parameters.end());
    return all;
  }
  std::string read(const text_io::Parameters &all) {
    const std::string *const times = text_io::find(all, "times");
    explicit_times = times != nullptr;
    if (!times || *times == "own") return {};
    return "parameter 'times' is " + text_io::in_quotes(*times) + ", expected 'own' or none";
  }
  std::string fault() const {
    if (model != "lsm" && model != "block-slider")
      return "model is " + text_io::in_quotes(model) + ", expected 'lsm' or 'block-slider'";
    if (!std::isfinite(dt) || !(dt > 0.0))
      return "dt is " + text_io::number(dt) + ", expected a positive number";
    if (!std::isfinite(time0))
      return "time0 is " + text_io::number(time0) + ", expected a finite number";
    if (stride < 1) return "stride is " + text_io::number(stride) + ", expected at least 1";
    return {};
  }
  std::int64_t record_bytes() const { return explicit_times ? 24 : 16; }
};

/// Reads a PE series sample by sample.
class PeSeriesReader : public binary_io::RecordReader<PeSeriesInfo> {
 public:
  explicit PeSeriesReader(std::unique_ptr<text_io::Bytes> in, bool lenient = false)
      : RecordReader(std::move(in), lenient) {}

  /// Next sample; false at the end of the file. Steps increase, numbers are finite.
  /// \throws FileError
  bool next(std::int64_t &step, double &time, double &pe) {
    using binary_io::from_bytes;
    const bool own = info().explicit_times;
    const char *const record = next_record();
    if (!record) return false;
    step = from_bytes<std::int64_t>(record);
    time = own ? from_bytes<double>(record + 8) : info().time(step);
    pe = from_bytes<double>(record + (own ? 16 : 8));
    if (!std::isfinite(time))
      fail("time of step " + std::to_string(step) + " is not finite, expected a finite number");
    if (!std::isfinite(pe)) fail("pe is not finite, expected a finite number");
    if (has_last_ && step <= last_step_)
      fail("step " + std::to_string(step) + " after step " + std::to_string(last_step_) +
           ", expected increasing steps");
    if (has_last_ && time < last_time_)
      fail("time " + text_io::number(time) + " after time " + text_io::number(last_time_) +
           ", expected increasing times");
    last_step_ = step;
    last_time_ = time;
    has_last_ = true;
    return true;
  }

 private:
  bool has_last_ = false;
  std::int64_t last_step_ = 0;
  double last_time_ = 0.0;
};

/// Writes a PE series. Samples are collected and handed to the operating system in blocks of whole
/// samples; flush() before writing a restart, or find_cut() finds samples missing.
class PeSeriesWriter : public binary_io::RecordWriter<PeSeriesInfo> {
 public:
  ~PeSeriesWriter() {
    try {
      close();
    } catch (...) {
      // call close() to learn of errors.
    }
  }

  /// \throws as begin()
  void create(const std::string &path, const PeSeriesInfo &info) {
    close();
    begin(path, info);
    start();
  }

  /// Looks at the series of a run restarted from last_step, which cut() goes on with: checks that
  /// the header is what create() would write (parameters named in ignore may differ; their old
  /// values stay), and finds the first sample after last_step or an incomplete last one. \throws
  /// FileError naming the first parameter that differs, the first bad line, or the samples missing
  /// before last_step.
  void find_cut(const std::string &path, const PeSeriesInfo &info, std::int64_t last_step,
                const std::vector<std::string> &ignore = {}) {
    close();
    PeSeriesReader reader(text_io::open_plain(path), true);
    compare(path, reader.info(), info, ignore);
    start();
    std::int64_t step = 0, length = reader.end();
    double time = 0.0, pe = 0.0;
    // Steps increase, so the first one to drop is where the file is cut.
    while (reader.next(step, time, pe) && step <= last_step) {
      last_step_ = step;
      last_time_ = time;
      length = reader.end();
      ++rows_;
    }
    const std::int64_t reached = rows_ > 0 ? last_step_ : info.step0;
    if (reached < last_step && last_step - info.stride >= reached)
      refuse(path, "samples end at step " + std::to_string(reached) +
                       ", expected them up to step " + std::to_string(last_step));
    file_.keep(path, length);
  }

  /// Adds a sample at the time given by its step. \throws as below; std::logic_error for a series
  /// with explicit_times
  void write(std::int64_t step, double pe) {
    if (info_.explicit_times) throw std::logic_error("PE series: a sample needs its time");
    write(step, info_.time(step), pe);
  }

  /// Adds a sample. \param time counts with explicit_times only
  /// \throws FileError if a number is not finite, steps or times do not increase, or a block
  /// cannot be written.
  void write(std::int64_t step, double time, double pe) {
    if (!file_.is_open()) throw FileError("PE series is not open");
    if (!info_.explicit_times) time = info_.time(step);
    const auto refuse = [&](const std::string &what) {
      throw FileError(file_.path() + ": cannot write step " + std::to_string(step) + what);
    };
    if (!std::isfinite(time)) refuse(": time is not finite, expected a finite number");
    if (rows_ > 0 && info_.explicit_times && time < last_time_)
      refuse(": time " + text_io::number(time) + " after time " + text_io::number(last_time_) +
             ", expected increasing times");
    if (!std::isfinite(pe)) refuse(": pe is not finite, expected a finite number");
    if (rows_ > 0 && step <= last_step_)
      refuse(" after step " + std::to_string(last_step_) + ", expected increasing steps");
    binary_io::append_bytes(buffer_, step);
    if (info_.explicit_times) binary_io::append_bytes(buffer_, time);
    binary_io::append_bytes(buffer_, pe);
    last_step_ = step;
    last_time_ = time;
    ++rows_;
    if (buffer_.size() >= buffer_limit) flush();
  }

  /// Passes all samples so far to the system. \throws FileError
  void flush() {
    if (buffer_.empty()) return;
    file_.write(buffer_);
    buffer_.clear();
  }

  /// \throws FileError. Also done on destruction, silently.
  void close() {
    if (!file_.is_open()) return;
    flush();
    file_.close();
  }

  std::int64_t rows() const { return rows_; }  ///< samples so far, kept ones included

 private:
  static constexpr std::size_t buffer_limit = 1 << 16;

  void start() {
    rows_ = 0;
    buffer_.clear();
    buffer_.reserve(buffer_limit + 128);
  }

  std::int64_t rows_ = 0, last_step_ = 0;
  double last_time_ = 0.0;
  std::string buffer_;
};

}  // namespace LSM

#endif
