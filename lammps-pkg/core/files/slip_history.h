// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/slip_history.h
/// Slip of a fault in space and time, for pictures and for finding ruptures again with other
/// settings (*). Bins and intervals are those of files/fault_grid.h; intervals without slip are
/// merged.
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
/// everything little-endian. The history of a plane is of version 2, "lsm-slip-hist-2\n": it has
/// bins times bins_dip cells, those of the first bin along strike first, from the lowest up; slip
/// and stress of each have two components, along strike and dip. The first record is the state
/// before the first interval (step_begin = step_end, no slip); every other record begins where the
/// previous one ended.
#ifndef LSM_SLIP_HISTORY_H
#define LSM_SLIP_HISTORY_H

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/binary_io.h"
#include "files/fault_grid.h"
#include "files/input_bytes.h"
#include "files/parameters.h"
#include "files/state.h"

namespace LSM {

/// Header of a slip history.
struct SlipHistoryInfo : files::FileHeader {
  static constexpr std::string_view magic = "lsm-slip-hist-1\n";
  static constexpr const char *what = "slip history";
  static constexpr int most_bins = 1 << 20;  ///< of a plane cells
  static constexpr int versions = 2;

  FaultGrid grid;
  RuptureSettings ruptures;
  double driving = 0.0;    ///< velocity of one side of the fault relative to the other
  std::int64_t quiet = 1;  ///< intervals in a record while nothing slips, at most

  SlipHistoryInfo() { model = "lsm"; }
  int version() const { return grid.plane ? 2 : 1; }
  void set_version(int version) { grid.plane = version == 2; }

  template <class Self, class F>
  static void visit(Self &self, F &&f) {
    f("bins", self.grid.bins);
    f("x0", self.grid.x0);
    f("bin", self.grid.width);
    f("step0", self.grid.step0);
    f("interval", self.grid.interval);
    f("time0", self.grid.time0);
    f("dt", self.grid.dt);
    f("slip_velocity", self.ruptures.velocity);
    f("gap", self.ruptures.gap);
    f("memory_intervals", self.ruptures.memory);
    f("modulus", self.ruptures.modulus);
    f("driving", self.driving);
    f("quiet", self.quiet);
    if (!self.grid.plane) return;
    f("bins_dip", self.grid.rows);
    f("z0", self.grid.z0);
    f("bin_dip", self.grid.height);
  }
  files::Parameters header() const;
  std::string read(const files::Parameters &all);
  std::string problem() const;
  std::int64_t record_bytes() const {
    return 24 + 4 * static_cast<std::int64_t>((2 * grid.components() + 1) *
                                              static_cast<std::size_t>(grid.cells()));
  }
};

/// What the fault did between two steps.
struct SlipRecord {
  std::int64_t step_begin = 0, step_end = 0;
  double pe = 0.0;
  FaultRow row;
};

/// Reads a slip history record by record.
class SlipHistoryReader : public binary_io::RecordReader<SlipHistoryInfo> {
 public:
  explicit SlipHistoryReader(std::unique_ptr<files::Bytes> in, bool lenient = false)
      : RecordReader(std::move(in), lenient) {}

  /// Reads the next record. Returns false at the end of the file.
  /// \throws FileError
  bool next(SlipRecord &record);

 private:
  void check_steps(const SlipRecord &record) const;

  std::int64_t last_end_ = 0;
  bool has_last_ = false;
};

/// Writes a slip history. Each record is handed to the operating system once it is complete; an
/// incomplete one is lost on close().
class SlipHistoryWriter : public binary_io::RecordWriter<SlipHistoryInfo> {
 public:
  /// Starts a file with the state at the given step.
  /// \throws as begin()
  void create(const std::string &path, const SlipHistoryInfo &info, std::int64_t step, double pe,
              const std::vector<float> &stress);

  /// Inspects the history of a run restarted with the given state(), which cut() will continue:
  /// checks that the header is what create() would write, and finds the first record after that
  /// state, or a truncated last one.
  /// \throws FileError
  void find_cut(const std::string &path, const SlipHistoryInfo &info,
                const std::vector<double> &saved);

  /// Adds the interval that ends at the given step. An `active` interval, in which something slips
  /// or did so shortly before, gets a record of its own.
  /// \throws FileError
  void add(std::int64_t step_end, double pe, const FaultRow &row, bool active);

  /// Returns the state for a restart file. May be called after any add().
  std::vector<double> state() const;

 private:
  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state(self.begin_, self.pending_, self.last_.step_end, self.last_.pe);
    state.fixed(self.slip_);
    state.fixed(self.work_);
    state.fixed(self.last_.row.stress);
  }

  void start(std::int64_t step);

  /// Writes what was added since the last record.
  void finish();
  void put(const SlipRecord &record);

  std::int64_t begin_ = 0;    // first step of the record being assembled
  std::int64_t pending_ = 0;  // intervals in it
  std::vector<double> slip_, work_;
  SlipRecord last_;
};

}  // namespace LSM

#endif
