// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "read_series.h"
#include "unit_files.h"

namespace {

using LSM::FileError;
using LSM::PeSeriesInfo;
using LSM::PeSeriesReader;
using LSM::PeSeriesWriter;
using unit::expect_error;
using unit::read_series;
using unit::resume;
using unit::slurp;
using unit::spill;

PeSeriesInfo some_info() {
  PeSeriesInfo info;
  info.model = "block-slider";
  info.dt = 0.25;
  info.step0 = 100;
  info.time0 = 7.0;
  info.stride = 2;
  info.parameters = {{"seed", "5"}, {"N", "256"}};
  return info;
}

double some_pe(std::int64_t step) { return 1e4 + 1.0 / static_cast<double>(step); }

const std::string pairs =
    "# model = block-slider\n"
    "# dt = 0.25\n"
    "# step0 = 100\n"
    "# time0 = 7\n"
    "# stride = 2\n"
    "# seed = 5\n"
    "# N = 256\n";

class PeSeries : public unit::Files {
 protected:
  std::string file() const { return path("pe.dat"); }

  /// Writes samples at steps 100, 102, ..., last.
  void write_series(std::int64_t last, const PeSeriesInfo &info = some_info()) {
    PeSeriesWriter writer;
    writer.create(file(), info);
    for (std::int64_t step = 100; step <= last; step += 2) writer.write(step, some_pe(step));
    writer.close();
  }

  /// Expects that a run restarted from a step does not go on with the file, which stays as it is.
  void not_resumed(const PeSeriesInfo &info, std::int64_t step, const std::string &message) {
    const std::string before = slurp(file());
    PeSeriesWriter writer;
    expect_error<FileError>([&] { resume(writer, file(), info, step); }, file() + message);
    EXPECT_EQ(slurp(file()), before);
  }
};

// ---- format ----

TEST_F(PeSeries, FormatToTheByte) {
  PeSeriesWriter writer;
  writer.create(file(), some_info());
  writer.write(0x0102, -2.0);
  writer.close();
  ASSERT_LT(pairs.size(), 256U);
  std::string expected = "lsm-pe-series-1\n";
  ASSERT_EQ(expected.size(), 16U);
  expected += static_cast<char>(pairs.size());
  expected += std::string(7, '\0') + pairs;
  expected += std::string("\x02\x01\0\0\0\0\0\0", 8);  // little-endian
  expected += std::string("\0\0\0\0\0\0\0\xc0", 8);    // sign and exponent last
  EXPECT_EQ(slurp(file()), expected);
}

// ---- samples with times of their own ----

PeSeriesInfo leaping() {
  PeSeriesInfo info = some_info();
  info.explicit_times = true;
  return info;
}

TEST_F(PeSeries, OwnTimesToTheByte) {
  PeSeriesWriter writer;
  writer.create(file(), leaping());
  writer.write(0x0102, 2.0, -2.0);
  writer.close();
  const std::string bytes = slurp(file());
  EXPECT_EQ(bytes.substr(bytes.size() - 24), std::string("\x02\x01\0\0\0\0\0\0", 8) +
                                                 std::string("\0\0\0\0\0\0\0\x40", 8) +
                                                 std::string("\0\0\0\0\0\0\0\xc0", 8));
}

TEST_F(PeSeries, OwnTimesComeBackAndGoOn) {
  const auto time_of = [](std::int64_t step) {
    return 7.0 + 0.1 * static_cast<double>(step * step);
  };
  PeSeriesWriter writer;
  writer.create(file(), leaping());
  for (std::int64_t step = 100; step <= 120; step += 2)
    writer.write(step, time_of(step), some_pe(step));
  writer.close();
  const std::string before = slurp(file());
  {
    PeSeriesWriter again;
    EXPECT_EQ(resume(again, file(), leaping(), 110), 6);
    expect_error<FileError>([&] { again.write(112, time_of(108), 1.0); }, "after time");
    for (std::int64_t step = 112; step <= 120; step += 2)
      again.write(step, time_of(step), some_pe(step));
  }
  EXPECT_EQ(slurp(file()), before);
  const auto samples = read_series(file());
  ASSERT_EQ(samples.size(), 11U);
  for (const auto &sample : samples) {
    EXPECT_EQ(sample.time, time_of(sample.step));
    EXPECT_EQ(sample.pe, some_pe(sample.step));
  }
  not_resumed(some_info(), 110, ": cannot resume: parameter 'times'");
}

TEST_F(PeSeries, OwnTimesOutOfOrderAreRefused) {
  PeSeriesWriter writer;
  writer.create(file(), leaping());
  EXPECT_THROW(writer.write(100, 1.0), std::logic_error);
  EXPECT_THROW(writer.write(100, std::nan(""), 1.0), FileError);
  writer.write(100, 8.0, 1.0);
  EXPECT_THROW(writer.write(102, 7.5, 1.0), FileError);
  writer.write(102, 8.0, 2.0);
  writer.close();
  EXPECT_EQ(read_series(file()).size(), 2U);
  // The same file, changed without the writer.
  std::string bytes = slurp(file());
  bytes[bytes.size() - 10] = '\x1c';  // 8 becomes 7
  spill(file(), bytes);
  expect_error<FileError>([&] { read_series(file()); }, "expected increasing times");
}

TEST_F(PeSeries, ComesBackToTheLastBit) {
  const double values[] = {0.1,
                           1.0 / 3.0,
                           -0.0,
                           std::numeric_limits<double>::denorm_min(),
                           std::numeric_limits<double>::max(),
                           1e4 + 1e-11};
  PeSeriesWriter writer;
  writer.create(file(), some_info());
  std::int64_t step = 98;
  for (double value : values) writer.write(step += 2, value);
  EXPECT_EQ(writer.rows(), 6);
  writer.close();
  PeSeriesReader reader(LSM::files::open_plain(file()));
  EXPECT_EQ(reader.info().model, "block-slider");
  EXPECT_EQ(reader.info().dt, 0.25);
  EXPECT_EQ(reader.info().step0, 100);
  EXPECT_EQ(reader.info().time0, 7.0);
  EXPECT_EQ(reader.info().stride, 2);
  EXPECT_EQ(reader.info().parameters, some_info().parameters);
  EXPECT_EQ(*reader.info().find("N"), "256");
  const std::vector<unit::Sample> samples = read_series(file());
  ASSERT_EQ(samples.size(), 6U);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(samples[i].step, 100 + 2 * static_cast<std::int64_t>(i));
    EXPECT_EQ(samples[i].time, 7.0 + 0.5 * static_cast<double>(i));
    EXPECT_EQ(samples[i].pe, values[i]);
    EXPECT_EQ(std::signbit(samples[i].pe), std::signbit(values[i]));
  }
}

TEST_F(PeSeries, FlushMakesSamplesVisible) {
  PeSeriesWriter writer;
  writer.create(file(), some_info());
  for (std::int64_t step = 100; step < 120; step += 2) writer.write(step, some_pe(step));
  writer.flush();
  EXPECT_EQ(read_series(file()).size(), 10U);
  // A reader gets whole samples only, however much has been written so far.
  for (std::int64_t step = 120; step < 30000; step += 2) writer.write(step, some_pe(step));
  EXPECT_GT(read_series(file()).size(), 1000U);
}

// ---- bad files ----

TEST_F(PeSeries, BadFiles) {
  write_series(104);
  const std::string good = slurp(file());
  const std::size_t data = good.size() - 3 * 16;
  const auto refused = [&](const std::string &text, const std::string &message) {
    spill(file(), text);
    expect_error<FileError>([&] { read_series(file()); }, file() + message);
  };
  for (std::size_t cut = 1; cut < 16; ++cut)
    refused(good.substr(0, good.size() - cut), ": truncated record 3 at the end");
  for (std::size_t cut : {std::size_t(16), std::size_t(20), std::size_t(24), data - 1})
    refused(good.substr(0, cut), ": file ends within the binary header");
  std::string bad = good;
  bad[14] = '2';
  refused(bad, ": PE series of another version, expected version 1");
  for (const std::string other : {"", "a,b\n", "# lsm-pe-series 1\n# dt = 1\nstep,time,pe\n"})
    refused(other, ": not a PE series, expected a file that begins with 'lsm-pe-series-1'");
  bad = good;
  bad[23] = '\x80';  // negative length of the header
  refused(bad, ": file ends within the binary header");
  bad = good;
  bad[22] = '\x10';  // enormous length
  refused(bad, ": file ends within the binary header");
  bad = good;
  bad.replace(data + 16, 16, good.substr(data, 16));
  refused(bad, ": record 2: step 100 after step 100, expected increasing steps");
  bad = good;
  bad.replace(data + 24, 8, std::string("\0\0\0\0\0\0\xf8\x7f", 8));
  refused(bad, ": record 2: pe is not finite, expected a finite number");
  bad = good;
  bad.replace(bad.find("# dt = 0.25"), 11, "# dx = 0.25");
  refused(bad, ": parameter 'dt' is missing in the header");
  for (const auto &[from, to, message] :
       {std::array<std::string, 3>{"# dt = 0.25", "# dt = x.25",
                                   ": header line 2: dt is 'x.25', expected a positive number"},
        {"# dt = 0.25", "# dt = 0.00", ": header line 2: dt is '0.00', expected a positive number"},
        {"# stride = 2", "# stride = 0", ": stride is 0, expected at least 1"},
        {"# seed = 5", "# step0= 5", ": header line 6: parameter 'step0' given twice"},
        {"# model = block-slider", "# model = block_slider", ": model is 'block_slider'"}}) {
    bad = good;
    bad.replace(bad.find(from), from.size(), to);
    refused(bad, message);
  }
  bad = good;
  bad.replace(bad.find("# seed = 5"), 10, "# seed : 5");
  refused(bad, ": header line 6: header line '# seed : 5', expected '# key = value'");
}

// ---- writing ----

TEST_F(PeSeries, WriterRefusesWhatNoReaderWouldTake) {
  PeSeriesWriter writer;
  EXPECT_THROW(writer.write(100, 1.0), FileError);
  writer.create(file(), some_info());
  writer.write(100, 1.0);
  EXPECT_THROW(writer.write(100, 1.0), FileError);
  expect_error<FileError>([&] { writer.write(102, std::numeric_limits<double>::quiet_NaN()); },
                          "cannot write step 102: pe is not finite");
  writer.write(102, 1.0);
  writer.close();
  EXPECT_EQ(read_series(file()).size(), 2U);
}

TEST_F(PeSeries, WriterRefusesBadHeaders) {
  PeSeriesWriter writer;
  const auto refused = [&](auto &&spoil) {
    PeSeriesInfo info = some_info();
    spoil(info);
    EXPECT_THROW(writer.create(file(), info), std::invalid_argument);
  };
  refused([](PeSeriesInfo &info) { info.model = ""; });
  refused([](PeSeriesInfo &info) { info.dt = 0.0; });
  refused([](PeSeriesInfo &info) { info.dt = std::numeric_limits<double>::infinity(); });
  refused([](PeSeriesInfo &info) { info.time0 = std::numeric_limits<double>::quiet_NaN(); });
  refused([](PeSeriesInfo &info) { info.stride = 0; });
  refused([](PeSeriesInfo &info) { info.parameters.emplace_back("dt", "1"); });
  refused([](PeSeriesInfo &info) { info.parameters.emplace_back("a", "1\n2"); });
  EXPECT_FALSE(std::filesystem::exists(file()));
}

// ---- resuming ----

TEST_F(PeSeries, ResumeGoesOnAsIfNeverInterrupted) {
  write_series(20000);
  const std::string expected = slurp(file());
  for (std::int64_t at : {98, 100, 102, 103, 5000, 15000})
    for (std::size_t torn : {0, 1, 5, 15}) {
      SCOPED_TRACE(at);
      write_series(15000);
      spill(file(), slurp(file()) + std::string(torn, '\x70'));
      PeSeriesWriter writer;
      const std::int64_t kept = (at - 98) / 2;
      EXPECT_EQ(resume(writer, file(), some_info(), at), kept);
      if (kept > 0) {
        EXPECT_THROW(writer.write(100 + 2 * (kept - 1), 1.0), FileError);
      }
      for (std::int64_t step = 100 + 2 * kept; step <= 20000; step += 2)
        writer.write(step, some_pe(step));
      writer.close();
      EXPECT_EQ(slurp(file()), expected);
    }
}

TEST_F(PeSeries, ResumeNamesTheParameterThatDiffers) {
  write_series(110);
  const auto refused = [&](auto &&change, const std::string &message) {
    PeSeriesInfo info = some_info();
    change(info);
    not_resumed(info, 104, ": cannot resume: parameter " + message);
  };
  refused([](PeSeriesInfo &info) { info.dt = 0.5; }, "'dt' is '0.25' in the file, expected '0.5'");
  refused([](PeSeriesInfo &info) { info.stride = 1; }, "'stride' is '2' in the file, expected '1'");
  PeSeriesInfo info = some_info();
  info.parameters.emplace_back("ranks", "2");
  PeSeriesWriter writer;
  EXPECT_EQ(resume(writer, file(), info, 104), 3);
  writer.close();
}

TEST_F(PeSeries, ResumeStopsAtAMissingOrBadSampleAndLosesNothing) {
  write_series(104);
  not_resumed(some_info(), 106,
              ": cannot resume: samples end at step 104, expected them up to step 106");
  std::string bytes = slurp(file());
  bytes.replace(bytes.size() - 24, 8, std::string("\0\0\0\0\0\0\xf8\x7f", 8));
  spill(file(), bytes);
  not_resumed(some_info(), 104, ": record 2: pe is not finite");
}

}  // namespace
