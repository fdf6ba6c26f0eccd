// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_pe_series.h
/// Time series of the total elastic potential energy (PE), Sect. 4.1 of Weatherley and Abe (2004).
/// The format is ours. PE is kept in double precision: the sign of its change per step matters at
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

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lsm_binary_io.h"
#include "lsm_text_io.h"

namespace LSM {

/// Header of a PE series.
struct PeSeriesInfo {
  std::string model;        ///< "lsm" or "block-slider"
  double dt = 1.0;          ///< time step of the simulation (model time), > 0
  std::int64_t step0 = 0;   ///< step of time0, usually that of the first sample
  double time0 = 0.0;       ///< time at step0
  std::int64_t stride = 1;  ///< steps between samples, >= 1
  bool own_times = false;   ///< each sample has its own time; time() does not apply
  std::vector<std::pair<std::string, std::string>> parameters;

  /// Steps are subtracted as doubles (exact below 2^53), so that no header can make this overflow.
  double time(std::int64_t step) const {
    return time0 + (static_cast<double>(step) - static_cast<double>(step0)) * dt;
  }
  /// Value of one of the other parameters, or nullptr.
  const std::string *find(std::string_view key) const { return text_io::find(parameters, key); }
};

namespace pe_series_detail {

constexpr std::string_view magic = "lsm-pe-series-1\n";
constexpr std::string_view times_key = "times", own_times = "own";
inline std::int64_t record_bytes(const PeSeriesInfo &info) { return info.own_times ? 24 : 16; }

inline text_io::Parameters header(const PeSeriesInfo &info) {
  text_io::Parameters all = {{"model", info.model},
                             {"dt", text_io::number(info.dt)},
                             {"step0", text_io::number(info.step0)},
                             {"time0", text_io::number(info.time0)},
                             {"stride", text_io::number(info.stride)}};
  if (info.own_times) all.emplace_back(times_key, own_times);
  all.insert(all.end(), info.parameters.begin(), info.parameters.end());
  return all;
}

/// What is wrong with the numbers of a header, or "".
inline std::string fault(const PeSeriesInfo &info) {
  if (info.model != "lsm" && info.model != "block-slider")
    return "model is " + text_io::in_quotes(info.model) + ", expected 'lsm' or 'block-slider'";
  if (!std::isfinite(info.dt) || !(info.dt > 0.0))
    return "dt is " + text_io::number(info.dt) + ", expected a positive number";
  if (!std::isfinite(info.time0))
    return "time0 is " + text_io::number(info.time0) + ", expected a finite number";
  if (info.stride < 1) return "stride is " + text_io::number(info.stride) + ", expected at least 1";
  return {};
}

inline void check_info(const PeSeriesInfo &info) {
  const std::string problem = fault(info);
  if (!problem.empty()) throw std::invalid_argument("PE series header: " + problem);
  text_io::check_parameters(header(info));
}

/// Sorts the pairs of a header into info; returns what is wrong, or "".
inline std::string interpret(const text_io::Parameters &all, PeSeriesInfo &info) {
  info = PeSeriesInfo();
  for (const std::string &problem :
       {text_io::take(all, "model", info.model), text_io::take(all, "dt", info.dt),
        text_io::take(all, "step0", info.step0), text_io::take(all, "time0", info.time0),
        text_io::take(all, "stride", info.stride)})
    if (!problem.empty()) return problem;
  if (const std::string *times = text_io::find(all, times_key)) {
    if (*times != own_times)
      return "parameter 'times' is " + text_io::in_quotes(*times) + ", expected 'own' or none";
    info.own_times = true;
  }
  const text_io::Parameters known = header(info);
  for (const auto &parameter : all)
    if (!text_io::find(known, parameter.first)) info.parameters.push_back(parameter);
  return fault(info);
}

}  // namespace pe_series_detail

/// Reads a PE series sample by sample. Anything unexpected throws; only a truncated last sample, as
/// a killed run leaves it, is dropped if asked to (lenient).
class PeSeriesReader {
 public:
  /// \throws FileError if the file cannot be read or its header is not as it should be.
  explicit PeSeriesReader(const std::string &path, bool lenient = false,
                          text_io::OpenBytes open = text_io::open_plain)
      : path_(path) {
    using namespace pe_series_detail;
    std::unique_ptr<text_io::Bytes> in = open(path);
    const binary_io::Header found = binary_io::read_header(*in, magic, "PE series");
    const std::string problem = interpret(found.parameters, info_);
    if (!problem.empty()) throw FileError(path + ": " + problem);
    records_ = binary_io::Records(std::move(in), found, record_bytes(info_), lenient);
  }

  const PeSeriesInfo &info() const { return info_; }
  const std::string &path() const { return path_; }
  bool torn() const { return records_.torn(); }  ///< a truncated last sample is dropped (lenient)

  /// Next sample; false at the end of the file. Steps increase, numbers are finite.
  /// \throws FileError
  bool next(std::int64_t &step, double &time, double &pe) {
    using binary_io::from_bytes;
    const char *const record = records_.next();
    if (!record) return false;
    step = from_bytes<std::int64_t>(record);
    time = info_.own_times ? from_bytes<double>(record + 8) : info_.time(step);
    pe = from_bytes<double>(record + (info_.own_times ? 16 : 8));
    if (!std::isfinite(time))
      records_.fail("time of step " + std::to_string(step) +
                    " is not finite, expected a finite number");
    if (!std::isfinite(pe)) records_.fail("pe is not finite, expected a finite number");
    if (has_last_ && step <= last_step_)
      records_.fail("step " + std::to_string(step) + " after step " + std::to_string(last_step_) +
                    ", expected increasing steps");
    if (has_last_ && time < last_time_)
      records_.fail("time " + text_io::number(time) + " after time " + text_io::number(last_time_) +
                    ", expected increasing times");
    last_step_ = step;
    last_time_ = time;
    has_last_ = true;
    return true;
  }

 private:
  friend class PeSeriesWriter;

  std::string path_;
  PeSeriesInfo info_;
  bool has_last_ = false;
  std::int64_t last_step_ = 0;
  double last_time_ = 0.0;
  binary_io::Records records_;
};

/// Writes a PE series. Samples are collected and handed to the operating system in blocks of whole
/// samples; flush() before writing a restart, or resume() finds samples missing.
class PeSeriesWriter {
 public:
  PeSeriesWriter() = default;
  PeSeriesWriter(const PeSeriesWriter &) = delete;
  PeSeriesWriter &operator=(const PeSeriesWriter &) = delete;
  ~PeSeriesWriter() {
    try {
      close();
    } catch (...) {
      // call close() to learn of errors.
    }
  }

  /// Starts a new file, replacing an older one (which stays if the new one cannot be written).
  /// \throws FileError; std::invalid_argument for a header that could not be read back.
  void create(const std::string &path, const PeSeriesInfo &info) {
    using namespace pe_series_detail;
    check_info(info);
    close();
    file_.create(path, binary_io::header_bytes(magic, header(info)));
    start(info, 0, 0);
  }

  /// Continues the series of a run restarted from last_step: checks that the header is what
  /// create() would write (parameters named in ignore may differ; their old values stay), drops
  /// every sample after last_step and an incomplete last one. Returns the number of samples kept.
  /// The file is unchanged if this throws. \throws FileError naming the first parameter that
  /// differs, the first bad line, or the samples missing before last_step.
  std::int64_t resume(const std::string &path, const PeSeriesInfo &info, std::int64_t last_step,
                      const std::vector<std::string> &ignore = {}) {
    find_cut(path, info, last_step, ignore);
    return cut();
  }

  /// All of resume() but the change of the file, which cut() does: where more than one file goes
  /// on, nothing is cut before all of them are found to fit.
  void find_cut(const std::string &path, const PeSeriesInfo &info, std::int64_t last_step,
                const std::vector<std::string> &ignore = {}) {
    using namespace pe_series_detail;
    check_info(info);
    close();
    PeSeriesReader reader(path, true);
    const std::string problem = text_io::difference(header(reader.info()), header(info), ignore);
    if (!problem.empty()) throw FileError(path + ": cannot resume: " + problem);
    std::int64_t kept = 0, last = 0, step = 0, length = reader.records_.end();
    double time = 0.0, pe = 0.0, last_time = 0.0;
    // Steps increase, so the first one to drop is where the file is cut.
    while (reader.next(step, time, pe) && step <= last_step) {
      last = step;
      last_time = time;
      length = reader.records_.end();
      ++kept;
    }
    const std::int64_t reached = kept > 0 ? last : info.step0;
    if (reached < last_step && last_step - info.stride >= reached)
      throw FileError(path + ": cannot resume: samples end at step " + std::to_string(reached) +
                      ", expected them up to step " + std::to_string(last_step));
    cut_path_ = path;
    cut_length_ = length;
    start(info, kept, last);
    last_time_ = last_time;
  }

  /// Goes on with the file that find_cut() looked at. Returns the number of samples kept.
  std::int64_t cut() {
    file_.append(cut_path_, cut_length_);
    return rows_;
  }

  /// Adds a sample at the time given by its step. \throws as below; std::logic_error for a series
  /// with own_times
  void write(std::int64_t step, double pe) {
    if (info_.own_times) throw std::logic_error("PE series: a sample needs its time");
    write(step, info_.time(step), pe);
  }

  /// Adds a sample. \param time counts with own_times only
  /// \throws FileError if a number is not finite, steps or times do not increase, or a block
  /// cannot be written.
  void write(std::int64_t step, double time, double pe) {
    if (!file_.is_open()) throw FileError("PE series is not open");
    if (!info_.own_times) time = info_.time(step);
    const auto refuse = [&](const std::string &what) {
      throw FileError(file_.path() + ": cannot write step " + std::to_string(step) + what);
    };
    if (!std::isfinite(time)) refuse(": time is not finite, expected a finite number");
    if (rows_ > 0 && info_.own_times && time < last_time_)
      refuse(": time " + text_io::number(time) + " after time " + text_io::number(last_time_) +
             ", expected increasing times");
    if (!std::isfinite(pe)) refuse(": pe is not finite, expected a finite number");
    if (rows_ > 0 && step <= last_step_)
      refuse(" after step " + std::to_string(last_step_) + ", expected increasing steps");
    binary_io::append_bytes(buffer_, step);
    if (info_.own_times) binary_io::append_bytes(buffer_, time);
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

  bool is_open() const { return file_.is_open(); }
  std::int64_t rows() const { return rows_; }  ///< samples so far, kept ones included

 private:
  static constexpr std::size_t buffer_limit = 1 << 16;

  void start(const PeSeriesInfo &info, std::int64_t rows, std::int64_t last_step) {
    info_ = info;
    rows_ = rows;
    last_step_ = last_step;
    buffer_.clear();
    buffer_.reserve(buffer_limit + 128);
  }

  text_io::OutputFile file_;
  PeSeriesInfo info_;
  std::int64_t rows_ = 0, last_step_ = 0;
  double last_time_ = 0.0;
  std::string buffer_;
  std::string cut_path_;
  std::int64_t cut_length_ = 0;
};

}  // namespace LSM

#endif
