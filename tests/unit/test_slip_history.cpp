// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "read_series.h"
#include "unit_files.h"

namespace {

using LSM::FaultRow;
using LSM::FileError;
using LSM::SlipHistoryInfo;
using LSM::SlipHistoryWriter;
using LSM::SlipRecord;
using unit::expect_error;
using unit::slurp;
using unit::spill;

SlipHistoryInfo some_info() {
  SlipHistoryInfo info;
  info.grid.bins = 3;
  info.grid.width = 2.5;
  info.grid.step0 = 100;
  info.grid.interval = 10;
  info.grid.time0 = 6.0;
  info.grid.dt = 0.0625;
  info.ruptures.velocity = 0.005;
  info.ruptures.gap = 1;
  info.ruptures.memory = 2;
  info.ruptures.modulus = 0.4375;
  info.driving = 0.0005;
  info.quiet = 4;
  info.parameters = {{"seed", "7"}};
  return info;
}

FaultRow some_row(int n) {
  FaultRow row(3);
  for (std::size_t b = 0; b < 3; ++b) {
    row.slip[b] = 0.25F * static_cast<float>(n) + static_cast<float>(b);
    row.work[b] = 2.0F * row.slip[b];
    row.stress[b] = 3.0F + row.slip[b];
  }
  return row;
}

std::vector<SlipRecord> read(const std::string &path, bool lenient = false) {
  return unit::read_history(path, lenient).records;
}

void resume(SlipHistoryWriter &writer, const std::string &path, const SlipHistoryInfo &info,
            const std::vector<double> &state) {
  writer.find_cut(path, info, state);
  writer.cut();
}

class SlipHistory : public unit::Files {
 protected:
  std::string file() const { return path("slip.bin"); }
  bool active(int n) const { return n >= 7 && n <= 9; }

  /// Adds the intervals first + 1 to last, which are quiet except 7, 8 and 9.
  void go_on(SlipHistoryWriter &writer, int first, int last) const {
    for (int n = first + 1; n <= last; ++n)
      writer.add(100 + 10 * n, -0.5 * n, some_row(n), active(n));
  }
  void create(SlipHistoryWriter &writer) const {
    writer.create(file(), some_info(), 100, 1.5, some_row(0).stress);
  }
};

TEST_F(SlipHistory, EveryIntervalWhileActiveAndFewElse) {
  SlipHistoryWriter writer;
  create(writer);
  go_on(writer, 0, 15);
  writer.close();
  const std::vector<SlipRecord> records = read(file());
  const std::vector<std::pair<int, int>> expected = {{0, 0}, {0, 4}, {4, 6}, {6, 7},
                                                     {7, 8}, {8, 9}, {9, 13}};
  ASSERT_EQ(records.size(), expected.size());
  for (std::size_t k = 0; k < records.size(); ++k) {
    const auto [from, to] = expected[k];
    EXPECT_EQ(records[k].step_begin, 100 + 10 * from);
    EXPECT_EQ(records[k].step_end, 100 + 10 * to);
    EXPECT_EQ(records[k].pe, k == 0 ? 1.5 : -0.5 * to);
    for (std::size_t b = 0; b < 3; ++b) {
      float slip = 0.0F;  // sums of halves and quarters are exact
      for (int n = from + 1; n <= to; ++n) slip += some_row(n).slip[b];
      EXPECT_EQ(records[k].row.slip[b], slip);
      EXPECT_EQ(records[k].row.work[b], 2.0F * slip);
      EXPECT_EQ(records[k].row.stress[b], some_row(to).stress[b]);
    }
  }
}

TEST_F(SlipHistory, HeaderComesBack) {
  // Written again, it is the same file; its bytes are those of the next test.
  SlipHistoryWriter writer;
  create(writer);
  writer.close();
  const SlipHistoryInfo info = unit::read_history(file()).info;
  writer.create(path("again.bin"), info, 100, 1.5, some_row(0).stress);
  writer.close();
  EXPECT_EQ(slurp(path("again.bin")), slurp(file()));
}

TEST_F(SlipHistory, FormatToTheByte) {
  SlipHistoryWriter writer;
  SlipHistoryInfo info = some_info();
  info.grid.bins = 1;
  info.parameters.clear();
  writer.create(file(), info, 100, 1.0, {0.5F});
  writer.close();
  const std::string lines =
      "# model = lsm\n# bins = 1\n# x0 = 0\n# bin = 2.5\n# step0 = 100\n# interval = 10\n"
      "# time0 = 6\n# dt = 0.0625\n# slip_velocity = 0.0050000000000000001\n# gap = 1\n"
      "# memory_intervals = 2\n# modulus = 0.4375\n# driving = 0.00050000000000000001\n"
      "# quiet = 4\n";
  std::string bytes = "lsm-slip-hist-1\n";
  bytes += static_cast<char>(lines.size() & 0xff);
  bytes += static_cast<char>(lines.size() >> 8);
  bytes += std::string(6, '\0') + lines;
  for (int k = 0; k < 2; ++k) bytes += std::string("\x64") + std::string(7, '\0');
  bytes +=
      std::string("\0\0\0\0\0\0\xf0\x3f", 8) + std::string(8, '\0') + std::string("\0\0\0\x3f", 4);
  EXPECT_EQ(slurp(file()), bytes);
}

TEST_F(SlipHistory, ThoseOfAPlaneAreOfVersion2) {
  SlipHistoryInfo info = some_info();
  info.grid.plane = true;
  info.grid.rows = 2;
  info.grid.z0 = -3.0;
  info.grid.height = 1.5;
  info.parameters = {{"ends_dip", "open"}, {"ends", "open"}};
  FaultRow row(info.grid);
  for (std::size_t n = 0; n < row.slip.size(); ++n) row.slip[n] = static_cast<float>(n);
  row.work[4] = 0.5F;
  SlipHistoryWriter writer;
  writer.create(file(), info, 100, 1.5, row.slip);
  writer.add(110, 1.0, row, true);
  writer.close();
  const std::string bytes = slurp(file());
  EXPECT_EQ(bytes.substr(0, 16), "lsm-slip-hist-2\n");
  EXPECT_TRUE(unit::contains(
      bytes, "# bins_dip = 2\n# z0 = -3\n# bin_dip = 1.5\n# ends_dip = open\n# ends = open\n"));
  const auto [read_info, records] = unit::read_history(file());
  const LSM::FaultGrid &grid = read_info.grid;
  EXPECT_TRUE(grid.plane);
  EXPECT_FALSE(grid.ring || grid.ring_dip);
  EXPECT_EQ(grid.cells(), 6);
  EXPECT_EQ(grid.z0, -3.0);
  EXPECT_EQ(grid.height, 1.5);
  EXPECT_EQ(read_info.record_bytes(), 24 + 4 * 5 * 6);
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].row.stress, row.slip);
  EXPECT_EQ(records[1].row.slip, row.slip);
  EXPECT_EQ(records[1].row.work, row.work);

  for (const auto &[from, to, part] :
       std::vector<std::tuple<std::string, std::string, std::string>>{
           {"# bins_dip = 2", "# bins_dip = 0", "bins_dip is 0, expected 1 to 349525 with 3 bins"},
           {"# bin_dip = 1.5", "# bin_dip = 0.0", "bin_dip is 0, expected a positive number"},
           {"# z0 = -3", "# zo = -3", "parameter 'z0' is missing in the header"},
           {"hist-2", "hist-3", "another version, expected version 1 to 2"}}) {
    std::string changed = bytes;
    spill(file(), changed.replace(changed.find(from), from.size(), to));
    expect_error<FileError>([&] { read(file()); }, part);
  }
}

TEST_F(SlipHistory, ResumedEqualsUninterrupted) {
  SlipHistoryWriter writer;
  create(writer);
  go_on(writer, 0, 15);
  writer.close();
  const std::string whole = slurp(file());
  for (int stop = 0; stop <= 15; ++stop) {
    SCOPED_TRACE(stop);
    SlipHistoryWriter before;
    create(before);
    go_on(before, 0, stop);
    const std::vector<double> state = before.state();
    go_on(before, stop, 13);  // what comes after the restart file is dropped
    before.close();
    spill(file(), slurp(file()) + "torn");
    SlipHistoryWriter after;
    resume(after, file(), some_info(), state);
    go_on(after, stop, 15);
    after.close();
    EXPECT_EQ(slurp(file()), whole);
  }
}

TEST_F(SlipHistory, ResumeRefusesWhatDoesNotFit) {
  SlipHistoryWriter writer;
  create(writer);
  go_on(writer, 0, 5);
  const std::vector<double> early = writer.state();
  go_on(writer, 5, 15);
  const std::vector<double> late = writer.state();
  writer.close();
  const std::string whole = slurp(file());

  SlipHistoryInfo other = some_info();
  other.ruptures.gap = 2;
  expect_error<FileError>(
      [&] { resume(writer, file(), other, late); },
      "slip.bin: cannot resume: parameter 'gap' is '1' in the file, expected '2'");
  other = some_info();
  other.parameters.emplace_back("program", "of another version");
  EXPECT_NO_THROW(resume(writer, file(), other, late));
  writer.close();
  other = some_info();
  other.grid.bins = 4;
  expect_error<FileError>([&] { resume(writer, file(), other, late); },
                          "saved state is of another fault");
  EXPECT_EQ(slurp(file()), whole);

  create(writer);
  writer.close();
  const std::string begun = slurp(file());
  expect_error<FileError>([&] { resume(writer, file(), some_info(), early); },
                          "cannot resume: records end at step 100, expected them up to step 140");
  EXPECT_EQ(slurp(file()), begun);
  spill(file(), begun.substr(0, begun.size() - 1));
  expect_error<FileError>([&] { resume(writer, file(), some_info(), early); },
                          "cannot resume: no records, expected them up to step 140");
}

TEST_F(SlipHistory, BadFilesAreRefusedWithARecordAndAReason) {
  SlipHistoryWriter writer;
  create(writer);
  go_on(writer, 0, 9);
  writer.close();
  const std::string good = slurp(file());
  const std::size_t size = 24 + 12 * 3, records = 6, first = good.size() - records * size;
  EXPECT_EQ(read(file()).size(), records);

  const auto expect = [&](const std::string &bytes, const std::string &part) {
    spill(file(), bytes);
    expect_error<FileError>([&] { read(file()); }, part);
  };
  expect("", "slip.bin: not a slip history");
  expect("event_id,t_start,t_end\n", "not a slip history");
  expect("lsm-slip-hist-3\n" + good.substr(16), "another version, expected version 1 to 2");
  expect(good.substr(0, 30), "file ends within the binary header");
  expect(good.substr(0, good.size() - 7), "truncated record 6 at the end, expected 60 bytes");
  EXPECT_EQ(read(file(), true).size(), records - 1);

  const auto with = [&](const std::string &from, const std::string &to) {
    std::string bytes = good;
    bytes.replace(bytes.find(from), from.size(), to);
    return bytes;
  };
  expect(with("# bins = 3", "# bins = 0"), "bins is not a number of bins");
  expect(with("# bins = 3", "# bims = 3"), "parameter 'bins' is missing in the header");
  expect(with("# gap = 1", "# gap = x"), "gap is 'x', expected a whole number");
  expect(with("# dt = 0.0625", "# dt = -.0625"),
         "header line 8: dt is '-.0625', expected a positive number");
  expect(with("# seed = 7", "# quiet = 7"), "parameter 'quiet' given twice");
  expect(with("# model = lsm", "# model = ism"), "model is 'ism', expected 'lsm'");
  expect(with("# interval = 10", "# interval = 00"), "interval is 0, expected at least 1");

  std::string bytes = good;
  bytes[first + 3 * size] ^= 1;  // step_begin of the fourth
  expect(bytes, "record 4: steps 161 to 170 after step 160, expected records without gaps");
  bytes = good;
  bytes[first + 8] ^= 2;  // step_end of the first
  expect(bytes, "record 1: steps 100 to 102, expected the state before the first interval");
  bytes = good;
  bytes[first + 3 * size + 8] ^= 1;  // step_end of the fourth
  expect(bytes, "record 4: steps 160 to 171, expected whole intervals of 10 steps from step 100");
  bytes = good;
  bytes.erase(first + size, size);
  expect(bytes, "record 2: steps 140 to 160 after step 100");
  for (std::size_t at : {std::size_t{16}, std::size_t{24}, std::size_t{36}, std::size_t{59}}) {
    bytes = good;
    for (std::size_t k = 0; k < 8 && at + k < size; ++k) bytes[first + 2 * size + at + k] = '\xff';
    if (at == 59) {
      bytes[first + 2 * size + 58] = '\x80';
      bytes[first + 2 * size + 59] = '\x7f';
    }
    expect(bytes, at == 16 ? "record 3: pe is not finite" : "record 3: slip, work or stress");
  }
}

TEST_F(SlipHistory, WhatCouldNotBeReadIsNotWritten) {
  SlipHistoryWriter writer;
  SlipHistoryInfo bad = some_info();
  bad.ruptures.memory = 0;
  EXPECT_THROW(writer.create(file(), bad, 100, 0.0, {1.0F, 1.0F, 1.0F}), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(file()));
  create(writer);
  FaultRow row = some_row(1);
  row.slip[2] = std::numeric_limits<float>::infinity();
  expect_error<FileError>([&] { writer.add(110, 0.0, row, true); }, "cannot write step 110");
}

}  // namespace
