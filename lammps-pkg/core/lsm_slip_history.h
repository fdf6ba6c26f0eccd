// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_slip_history.h
/// Slip of a fault in space and time, for pictures and for finding its ruptures again (ours): the
/// bins of lsm_fault_grid.h, interval by interval while anything slips; quiet intervals are merged.
///
/// Binary: 16 bytes "lsm-slip-hist-1\n", int64 length of the header, the header (lines
/// "# key = value"), then records of
///
///     int64 step_begin, int64 step_end   the steps of the record
///     double pe                          total potential energy at step_end
///     bins times float slip              slip since step_begin
///     bins times float work              work lost to friction since step_begin
///     bins times float stress            shear stress, mean over the last interval
///
/// everything little-endian. The first record is the state before the first interval (step_begin =
/// step_end, no slip); every other record begins where the previous one ended.
#ifndef LSM_SLIP_HISTORY_H
#define LSM_SLIP_HISTORY_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "lsm_binary_io.h"
#include "lsm_fault_grid.h"
#include "lsm_text_io.h"

namespace LSM {

/// Header of a slip history.
struct SlipHistoryInfo {
  std::string model = "lsm";
  FaultGrid grid;
  RuptureSettings ruptures;
  double driving = 0.0;    ///< velocity of one side of the fault relative to the other
  std::int64_t quiet = 1;  ///< intervals in a record while nothing slips, at most
  text_io::Parameters parameters;

  /// Value of one of the other parameters, or nullptr.
  const std::string *find(std::string_view key) const { return text_io::find(parameters, key); }
};

/// The fault between two steps.
struct SlipRecord {
  std::int64_t step_begin = 0, step_end = 0;
  double pe = 0.0;
  FaultRow row;
};

namespace slip_history_detail {

constexpr std::string_view magic = "lsm-slip-hist-1\n";
constexpr std::int64_t most_bins = 1 << 20;

/// Calls f(name, double &) or f(name, std::int64_t &) for each number of a header, in the order of
/// the file.
template <class Info, class F>
void each_number(Info &info, F &&f) {
  auto bins = static_cast<std::int64_t>(info.grid.bins);
  f("bins", bins);
  if constexpr (!std::is_const_v<Info>)
    info.grid.bins = bins > 0 && bins <= most_bins ? static_cast<int>(bins) : 0;
  f("x0", info.grid.x0);
  f("bin", info.grid.width);
  f("step0", info.grid.step0);
  f("interval", info.grid.interval);
  f("time0", info.grid.time0);
  f("dt", info.grid.dt);
  f("slip_velocity", info.ruptures.velocity);
  auto gap = static_cast<std::int64_t>(info.ruptures.gap);
  f("gap", gap);
  if constexpr (!std::is_const_v<Info>)
    info.ruptures.gap = gap >= 0 && gap <= most_bins ? static_cast<int>(gap) : -1;
  f("memory_intervals", info.ruptures.memory);
  f("modulus", info.ruptures.modulus);
  f("driving", info.driving);
  f("quiet", info.quiet);
}

inline text_io::Parameters header(const SlipHistoryInfo &info) {
  text_io::Parameters all = {{"model", info.model}};
  each_number(info, [&all](const char *name, const auto &value) {
    all.emplace_back(name, text_io::number(value));
  });
  all.insert(all.end(), info.parameters.begin(), info.parameters.end());
  return all;
}

/// What is wrong with the numbers of a header, or "".
inline std::string fault(const SlipHistoryInfo &info) {
  const FaultGrid &grid = info.grid;
  if (info.model != "lsm") return "model is " + text_io::in_quotes(info.model) + ", expected 'lsm'";
  if (grid.bins < 1) return "bins is not a number of bins, expected 1 to 1048576";
  for (const auto &[name, value] : {std::pair<const char *, double>{"bin", grid.width},
                                    {"dt", grid.dt},
                                    {"modulus", info.ruptures.modulus}})
    if (!(value > 0.0))
      return std::string(name) + " is " + text_io::number(value) + ", expected a positive number";
  for (const auto &[name, value] :
       {std::pair<const char *, std::int64_t>{"interval", grid.interval},
        {"memory_intervals", info.ruptures.memory},
        {"quiet", info.quiet}})
    if (value < 1)
      return std::string(name) + " is " + text_io::number(value) + ", expected at least 1";
  if (info.ruptures.gap < 0) return "gap is out of range, expected 0 to 1048576";
  if (!(info.ruptures.velocity >= 0.0))
    return "slip_velocity is " + text_io::number(info.ruptures.velocity) + ", expected at least 0";
  return {};
}

/// Sorts the pairs of a header into info; returns what is wrong, or "".
inline std::string interpret(const text_io::Parameters &all, SlipHistoryInfo &info) {
  info = SlipHistoryInfo();
  std::vector<std::string> known = {"model"};
  std::string problem = text_io::take(all, "model", info.model);
  each_number(info, [&](const char *name, auto &value) {
    known.emplace_back(name);
    if (problem.empty()) problem = text_io::take(all, name, value);
  });
  if (!problem.empty()) return problem;
  for (const auto &parameter : all)
    if (std::find(known.begin(), known.end(), parameter.first) == known.end())
      info.parameters.push_back(parameter);
  const std::string *ends = info.find("ends");
  info.grid.ring = !ends || *ends != "open";
  return fault(info);
}

inline std::int64_t record_bytes(const SlipHistoryInfo &info) {
  return 24 + 12 * static_cast<std::int64_t>(info.grid.bins);
}

}  // namespace slip_history_detail

/// Reads a slip history record by record. Anything unexpected throws; only a truncated last record,
/// as a killed run leaves it, is dropped if asked to (lenient).
class SlipHistoryReader {
 public:
  /// \throws FileError if the file cannot be read or its header is not as it should be.
  explicit SlipHistoryReader(const std::string &path, bool lenient = false,
                             text_io::OpenBytes open = text_io::open_plain)
      : path_(path) {
    using namespace slip_history_detail;
    std::unique_ptr<text_io::Bytes> in = open(path);
    const binary_io::Header header = binary_io::read_header(*in, magic, "slip history");
    const std::string problem = interpret(header.parameters, info_);
    if (!problem.empty()) throw FileError(path + ": " + problem);
    records_ = binary_io::Records(std::move(in), header, record_bytes(info_), lenient);
  }

  const SlipHistoryInfo &info() const { return info_; }
  const std::string &path() const { return path_; }
  bool torn() const { return records_.torn(); }  ///< a truncated last record is dropped (lenient)
  std::int64_t records() const { return records_.total(); }

  /// Next record; false at the end of the file. \throws FileError
  bool next(SlipRecord &record) {
    using binary_io::from_bytes;
    const char *at = records_.next();
    if (!at) return false;
    record.step_begin = from_bytes<std::int64_t>(at);
    record.step_end = from_bytes<std::int64_t>(at + 8);
    record.pe = from_bytes<double>(at + 16);
    at += 24;
    if (!std::isfinite(record.pe)) records_.fail("pe is not finite, expected a finite number");
    for (std::vector<float> *values : {&record.row.slip, &record.row.work, &record.row.stress}) {
      values->resize(static_cast<std::size_t>(info_.grid.bins));
      for (float &value : *values) {
        value = from_bytes<float>(at);
        at += 4;
        if (!std::isfinite(value))
          records_.fail("slip, work or stress of a bin is not finite, expected finite numbers");
      }
    }
    check_steps(record);
    last_end_ = record.step_end;
    has_last_ = true;
    return true;
  }

 private:
  friend class SlipHistoryWriter;

  void check_steps(const SlipRecord &record) const {
    const std::string steps =
        "steps " + std::to_string(record.step_begin) + " to " + std::to_string(record.step_end);
    const auto fail = [this](const std::string &what) { records_.fail(what); };
    if (!has_last_) {
      if (record.step_begin != record.step_end)
        fail(steps + ", expected the state before the first interval");
    } else if (record.step_begin != last_end_) {
      fail(steps + " after step " + std::to_string(last_end_) + ", expected records without gaps");
    } else if (record.step_end <= record.step_begin) {
      fail(steps + ", expected increasing steps");
    }
    // Differences of any two steps, even nonsensical ones, are below 2^64.
    const auto since =
        static_cast<std::uint64_t>(record.step_end) - static_cast<std::uint64_t>(info_.grid.step0);
    if (record.step_end < info_.grid.step0 ||
        since % static_cast<std::uint64_t>(info_.grid.interval) != 0)
      fail(steps + ", expected whole intervals of " + std::to_string(info_.grid.interval) +
           " steps from step " + std::to_string(info_.grid.step0));
    if (!std::isfinite(info_.grid.time(record.step_end)))
      fail("time of " + steps + " is not finite, expected a finite number");
  }

  std::string path_;
  SlipHistoryInfo info_;
  binary_io::Records records_;
  std::int64_t last_end_ = 0;
  bool has_last_ = false;
};

/// Writes a slip history. Each record is on its way to disk when it is complete.
class SlipHistoryWriter {
 public:
  /// Starts a new file, replacing an older one (which stays if the new one cannot be written), with
  /// the state at the given step. \throws FileError; std::invalid_argument for a header that
  /// could not be read back.
  void create(const std::string &path, const SlipHistoryInfo &info, std::int64_t step, double pe,
              const std::vector<float> &stress) {
    using namespace slip_history_detail;
    check(info);
    file_.create(path, binary_io::header_bytes(magic, header(info)));
    start(info, step);
    SlipRecord first;
    first.step_begin = first.step_end = step;
    first.pe = pe;
    first.row = FaultRow(info.grid.bins);
    first.row.stress = stress;
    put(first);
  }

  /// Goes on with the history of a run restarted with the given state(): checks that the header
  /// says what create() would write (parameters named in ignore may differ; their old values stay),
  /// and drops every record after that state and a torn last one. The file is left as it was if
  /// this throws. \throws FileError
  void resume(const std::string &path, const SlipHistoryInfo &info,
              const std::vector<double> &saved, const std::vector<std::string> &ignore = {}) {
    using namespace slip_history_detail;
    check(info);
    file_.close();
    const auto bins = static_cast<std::size_t>(info.grid.bins);
    if (saved.size() != 4 + 3 * bins)
      throw FileError(path + ": cannot resume: the saved state is of another fault");
    SlipHistoryReader reader(path, true);
    const std::string problem = text_io::difference(header(reader.info()), header(info), ignore);
    if (!problem.empty()) throw FileError(path + ": cannot resume: " + problem);
    const auto wanted = static_cast<std::int64_t>(saved[0]);
    std::int64_t reached = 0, length = 0;
    SlipRecord record;
    while (reader.next(record) && record.step_end <= wanted) {
      reached = record.step_end;
      length = reader.records_.end();
    }
    if (length == 0 || reached != wanted)
      throw FileError(
          path + ": cannot resume: " +
          (length == 0 ? "no records" : "records end at step " + std::to_string(reached)) +
          ", expected them up to step " + std::to_string(wanted));
    file_.append(path, length);
    start(info, wanted);
    pending_ = static_cast<std::int64_t>(saved[1]);
    last_.step_end = static_cast<std::int64_t>(saved[2]);
    last_.pe = saved[3];
    for (std::size_t b = 0; b < bins; ++b) {
      slip_[b] = saved[4 + b];
      work_[b] = saved[4 + bins + b];
      last_.row.stress[b] = static_cast<float>(saved[4 + 2 * bins + b]);
    }
  }

  /// The next interval, which ends at the given step. active: something slips, or did so until a
  /// moment ago. \throws FileError
  void add(std::int64_t step_end, double pe, const FaultRow &row, bool active) {
    if (active) finish();
    for (std::size_t b = 0; b < slip_.size(); ++b) {
      slip_[b] += static_cast<double>(row.slip[b]);
      work_[b] += static_cast<double>(row.work[b]);
    }
    last_.step_end = step_end;
    last_.pe = pe;
    last_.row.stress = row.stress;
    ++pending_;
    if (active || pending_ >= info_.quiet) finish();
  }

  /// For restarts, after any add().
  std::vector<double> state() const {
    std::vector<double> out = {static_cast<double>(begin_), static_cast<double>(pending_),
                               static_cast<double>(last_.step_end), last_.pe};
    out.insert(out.end(), slip_.begin(), slip_.end());
    out.insert(out.end(), work_.begin(), work_.end());
    out.insert(out.end(), last_.row.stress.begin(), last_.row.stress.end());
    return out;
  }

  /// \throws FileError. Also done on destruction, silently. What belongs to a record that is
  /// not complete is lost.
  void close() { file_.close(); }
  bool is_open() const { return file_.is_open(); }

 private:
  static void check(const SlipHistoryInfo &info) {
    const std::string problem = slip_history_detail::fault(info);
    if (!problem.empty()) throw std::invalid_argument("slip history header: " + problem);
    text_io::check_parameters(slip_history_detail::header(info));
  }

  void start(const SlipHistoryInfo &info, std::int64_t step) {
    info_ = info;
    begin_ = step;
    pending_ = 0;
    last_.row = FaultRow(info.grid.bins);
    slip_.assign(last_.row.slip.size(), 0.0);
    work_ = slip_;
  }

  /// Writes what was added since the last record.
  void finish() {
    if (pending_ == 0) return;
    last_.step_begin = begin_;
    for (std::size_t b = 0; b < slip_.size(); ++b) {
      last_.row.slip[b] = static_cast<float>(slip_[b]);
      last_.row.work[b] = static_cast<float>(work_[b]);
      slip_[b] = work_[b] = 0.0;
    }
    put(last_);
    begin_ = last_.step_end;
    pending_ = 0;
  }

  void put(const SlipRecord &record) {
    std::string bytes;
    bytes.reserve(static_cast<std::size_t>(slip_history_detail::record_bytes(info_)));
    binary_io::append_bytes(bytes, record.step_begin);
    binary_io::append_bytes(bytes, record.step_end);
    binary_io::append_bytes(bytes, record.pe);
    for (const std::vector<float> *values :
         {&record.row.slip, &record.row.work, &record.row.stress})
      for (const float value : *values) {
        if (!std::isfinite(value))
          throw FileError(file_.path() + ": cannot write step " + std::to_string(record.step_end) +
                          ": slip, work or stress is not finite");
        binary_io::append_bytes(bytes, value);
      }
    file_.write(bytes);
  }

  text_io::OutputFile file_;
  SlipHistoryInfo info_;
  std::int64_t begin_ = 0;    // of the record being assembled
  std::int64_t pending_ = 0;  // intervals in it
  std::vector<double> slip_, work_;
  SlipRecord last_;
};

}  // namespace LSM

#endif
