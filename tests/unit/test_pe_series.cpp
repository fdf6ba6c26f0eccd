// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lsm_pe_series.h"
#include "unit_files.h"

namespace {

using LSM::FileError;
using LSM::PeSeriesInfo;
using LSM::PeSeriesReader;
using LSM::PeSeriesWriter;
using unit::contains;
using unit::message_of;
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

struct Sample {
  std::int64_t step;
  double time, pe;
};

std::vector<Sample> read_all(const std::string &path) {
  PeSeriesReader reader(path);
  std::vector<Sample> samples;
  Sample sample{};
  while (reader.next(sample.step, sample.time, sample.pe)) samples.push_back(sample);
  return samples;
}

const std::string pairs =
    "# model = block-slider\n"
    "# dt = 0.25\n"
    "# step0 = 100\n"
    "# time0 = 7\n"
    "# stride = 2\n"
    "# seed = 5\n"
    "# N = 256\n";
const std::string text_header = "# lsm-pe-series 1\n" + pairs + "step,time,pe\n";

class PeSeries : public unit::Files {
 protected:
  std::string file() const { return path("pe.dat"); }

  /// Samples at steps 100, 102, ..., last.
  void write_series(bool binary, std::int64_t last, const PeSeriesInfo &info = some_info()) {
    PeSeriesWriter writer;
    writer.create(file(), info, binary);
    for (std::int64_t step = 100; step <= last; step += 2) writer.write(step, some_pe(step));
    writer.close();
  }
};

/// Everything that has to hold for both formats.
class PeSeriesBoth : public PeSeries, public ::testing::WithParamInterface<bool> {};
INSTANTIATE_TEST_SUITE_P(Format, PeSeriesBoth, ::testing::Bool(), [](const auto &format) {
  return std::string(format.param ? "binary" : "text");
});

// ---- format ----

TEST_F(PeSeries, TextToTheByte) {
  PeSeriesWriter writer;
  writer.create(file(), some_info(), false);
  writer.write(100, 0.1);
  writer.write(102, -3.0);
  writer.close();
  EXPECT_EQ(slurp(file()), text_header + "100,7,0.10000000000000001\n102,7.5,-3\n");
}

TEST_F(PeSeries, BinaryToTheByte) {
  PeSeriesWriter writer;
  writer.create(file(), some_info(), true);
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
  info.own_times = true;
  return info;
}

TEST_F(PeSeries, OwnTimesToTheByte) {
  PeSeriesWriter writer;
  writer.create(file(), leaping(), false);
  writer.write(100, 7.0, 0.5);
  writer.write(102, 1000.25, -3.0);
  writer.close();
  std::string header = text_header;
  header.insert(header.find("# seed"), "# times = own\n");
  EXPECT_EQ(slurp(file()), header + "100,7,0.5\n102,1000.25,-3\n");
  writer.create(file(), leaping(), true);
  writer.write(0x0102, 2.0, -2.0);
  writer.close();
  const std::string bytes = slurp(file());
  EXPECT_EQ(bytes.substr(bytes.size() - 24), std::string("\x02\x01\0\0\0\0\0\0", 8) +
                                                 std::string("\0\0\0\0\0\0\0\x40", 8) +
                                                 std::string("\0\0\0\0\0\0\0\xc0", 8));
}

TEST_P(PeSeriesBoth, OwnTimesComeBackAndGoOn) {
  const auto time_of = [](std::int64_t step) {
    return 7.0 + 0.1 * static_cast<double>(step * step);
  };
  PeSeriesWriter writer;
  writer.create(file(), leaping(), GetParam());
  for (std::int64_t step = 100; step <= 120; step += 2)
    writer.write(step, time_of(step), some_pe(step));
  writer.close();
  const std::string before = slurp(file());
  {
    PeSeriesWriter again;
    EXPECT_EQ(again.resume(file(), leaping(), GetParam(), 110), 6);
    EXPECT_TRUE(contains(message_of<FileError>([&] { again.write(112, time_of(108), 1.0); }),
                         "after time"));
    for (std::int64_t step = 112; step <= 120; step += 2)
      again.write(step, time_of(step), some_pe(step));
  }
  EXPECT_EQ(slurp(file()), before);
  const auto samples = read_all(file());
  ASSERT_EQ(samples.size(), 11U);
  for (const auto &sample : samples) {
    EXPECT_EQ(sample.time, time_of(sample.step));
    EXPECT_EQ(sample.pe, some_pe(sample.step));
  }
  PeSeriesWriter other;
  EXPECT_TRUE(
      contains(message_of<FileError>([&] { other.resume(file(), some_info(), GetParam(), 110); }),
               "cannot resume: parameter 'times'"));
  EXPECT_EQ(slurp(file()), before);
}

TEST_P(PeSeriesBoth, OwnTimesOutOfOrderAreRefused) {
  PeSeriesWriter writer;
  writer.create(file(), leaping(), GetParam());
  EXPECT_THROW(writer.write(100, 1.0), std::logic_error);
  EXPECT_THROW(writer.write(100, std::nan(""), 1.0), FileError);
  writer.write(100, 8.0, 1.0);
  EXPECT_THROW(writer.write(102, 7.5, 1.0), FileError);
  writer.write(102, 8.0, 2.0);
  writer.close();
  EXPECT_EQ(read_all(file()).size(), 2U);
  // The same by hand, past the writer.
  std::string bytes = slurp(file());
  if (GetParam())
    bytes[bytes.size() - 10] = '\x1c';  // 8 becomes 7
  else
    bytes.replace(bytes.rfind("102,8,"), 6, "102,7,");
  spill(file(), bytes);
  EXPECT_TRUE(
      contains(message_of<FileError>([&] { read_all(file()); }), "expected increasing times"));
}

TEST_F(PeSeries, OtherTimesAreRefused) {
  std::string text = text_header;
  text.insert(text.find("# seed"), "# times = none\n");
  spill(file(), text + "100,7,0.5\n");
  EXPECT_TRUE(contains(message_of<FileError>([&] { read_all(file()); }),
                       "parameter 'times' is 'none', expected 'own'"));
}

TEST_P(PeSeriesBoth, ComesBackToTheLastBit) {
  const double values[] = {0.1,
                           1.0 / 3.0,
                           -0.0,
                           std::numeric_limits<double>::denorm_min(),
                           std::numeric_limits<double>::max(),
                           1e4 + 1e-11};
  PeSeriesWriter writer;
  writer.create(file(), some_info(), GetParam());
  std::int64_t step = 100;
  for (double value : values) {
    writer.write(step, value);
    step += 2;
  }
  EXPECT_EQ(writer.rows(), 6);
  writer.close();
  PeSeriesReader reader(file());
  EXPECT_EQ(reader.binary(), GetParam());
  EXPECT_EQ(reader.info().model, "block-slider");
  EXPECT_EQ(reader.info().dt, 0.25);
  EXPECT_EQ(reader.info().step0, 100);
  EXPECT_EQ(reader.info().time0, 7.0);
  EXPECT_EQ(reader.info().stride, 2);
  EXPECT_EQ(reader.info().parameters, some_info().parameters);
  EXPECT_EQ(*reader.info().find("N"), "256");
  const std::vector<Sample> samples = read_all(file());
  ASSERT_EQ(samples.size(), 6U);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(samples[i].step, 100 + 2 * static_cast<std::int64_t>(i));
    EXPECT_EQ(samples[i].time, 7.0 + 0.5 * static_cast<double>(i));
    EXPECT_EQ(samples[i].pe, values[i]);
    EXPECT_EQ(std::signbit(samples[i].pe), std::signbit(values[i]));
  }
}

TEST_F(PeSeries, TimeThatDoesNotFollowFromTheStepIsRefused) {
  write_series(false, 110);
  std::string text = slurp(file());
  const std::string sample = "\n102,7.5,";
  ASSERT_NE(text.find(sample), std::string::npos);
  text.replace(text.find(sample), sample.size(), "\n102,7.5000019073486328,");
  spill(file(), text);
  EXPECT_TRUE(contains(message_of<FileError>([&] { read_all(file()); }),
                       "time 7.5000019073486328 at step 102, expected 7.5 from time0"));
}

TEST_P(PeSeriesBoth, ManyBlocks) {
  const std::int64_t last = 100 + 2 * 20000;
  write_series(GetParam(), last);
  const std::vector<Sample> samples = read_all(file());
  ASSERT_EQ(samples.size(), 20001U);
  for (const Sample &sample : samples) {
    ASSERT_EQ(sample.pe, some_pe(sample.step));
    ASSERT_EQ(sample.time, 7.0 + 0.25 * static_cast<double>(sample.step - 100));
  }
}

TEST_P(PeSeriesBoth, TimesThatAreNoBinaryFractions) {
  PeSeriesInfo info = some_info();
  info.dt = 0.03;
  info.time0 = 0.1;
  info.step0 = 0;
  write_series(GetParam(), 20000, info);
  for (const Sample &sample : read_all(file()))
    ASSERT_DOUBLE_EQ(sample.time, 0.1 + 0.03 * static_cast<double>(sample.step));
}

TEST_P(PeSeriesBoth, NoSamples) {
  write_series(GetParam(), 0);
  EXPECT_TRUE(read_all(file()).empty());
}

TEST_P(PeSeriesBoth, LocaleDoesNotMatter) {
  write_series(GetParam(), 3000);
  const std::string expected = slurp(file());
  const unit::CommaLocale locale;
  write_series(GetParam(), 3000);
  EXPECT_EQ(slurp(file()), expected);
  EXPECT_EQ(read_all(file()).size(), 1451U);
}

TEST_P(PeSeriesBoth, FlushMakesSamplesVisible) {
  PeSeriesWriter writer;
  writer.create(file(), some_info(), GetParam());
  for (std::int64_t step = 100; step < 120; step += 2) writer.write(step, some_pe(step));
  writer.flush();
  EXPECT_EQ(read_all(file()).size(), 10U);
  // Whole samples only, whatever has been handed over so far.
  for (std::int64_t step = 120; step < 30000; step += 2) writer.write(step, some_pe(step));
  EXPECT_GT(read_all(file()).size(), 1000U);
}

// ---- bad files ----

struct Bad {
  const char *name;
  std::string text, message;
};

TEST_F(PeSeries, BadTextFiles) {
  const std::string good = "100,7,1\n";
  const std::vector<Bad> all = {
      {"empty", "", ":1: empty file, expected '# lsm-pe-series 1'"},
      {"other", "a,b\n", ":1: not a PE series, expected '# lsm-pe-series 1'"},
      {"version", "# lsm-pe-series 3\n", ":1: PE series version '3', expected version 1"},
      {"ends in header", "# lsm-pe-series 1\n# dt = 1\n", ":2: file ends within the header"},
      {"no model", "# lsm-pe-series 1\n# dt = 1\nstep,time,pe\n", ":3: parameter 'model' is miss"},
      {"note", "# lsm-pe-series 1\n# note\n", ":2: header line '# note', expected '# key = value'"},
      {"twice", "# lsm-pe-series 1\n# dt = 1\n# dt = 1\n", ":3: parameter 'dt' given twice"},
      {"dt",
       "# lsm-pe-series 1\n# model = lsm\n# dt = x\n# step0 = 0\n# time0 = 0\n# stride = 1\n"
       "step,time,pe\n",
       ":7: parameter 'dt' is 'x', expected a finite number"},
      {"dt sign",
       "# lsm-pe-series 1\n# model = lsm\n# dt = 0\n# step0 = 0\n# time0 = 0\n# stride = "
       "1\nstep,time,pe\n",
       ":7: dt is 0, expected a positive number"},
      {"stride",
       "# lsm-pe-series 1\n# model = lsm\n# dt = 1\n# step0 = 0\n# time0 = 0\n# stride = "
       "0\nstep,time,pe\n",
       ":7: stride is 0, expected at least 1"},
      {"columns", "# lsm-pe-series 1\n" + pairs + "step,pe\n", ":9: column names 'step,pe', expec"},
      {"torn columns", "# lsm-pe-series 1\n" + pairs + "step,time,pe", ":9: truncated line of col"},
      {"two columns", text_header + good + "102,7.5\n",
       ":11: 2 columns, expected 3 (step,time,pe)"},
      {"nan", text_header + good + "102,7.5,nan\n", ":11: column 'pe' is 'nan', expected a finite"},
      {"step", text_header + good + "1e2,7.5,1\n", ":11: column 'step' is '1e2', expected an int"},
      {"time", text_header + good + "102,,1\n", ":11: column 'time' is '', expected a finite"},
      {"order", text_header + good + "100,7,1\n", ":11: step 100 after step 100, expected increa"},
      {"clock", text_header + good + "102,7.6,1\n",
       ":11: time 7.5999999999999996 at step 102, exp"},
      {"torn", text_header + good + "102,7.5,1", ":11: truncated last line, expected 3 columns"}};
  for (const Bad &bad : all) {
    SCOPED_TRACE(bad.name);
    spill(file(), bad.text);
    EXPECT_TRUE(contains(message_of<FileError>([&] { read_all(file()); }), file() + bad.message));
  }
}

TEST_F(PeSeries, BadBinaryFiles) {
  write_series(true, 104);
  const std::string good = slurp(file());
  const std::size_t data = good.size() - 3 * 16;
  const auto refused = [&](const std::string &text, const std::string &message) {
    spill(file(), text);
    EXPECT_TRUE(contains(message_of<FileError>([&] { read_all(file()); }), file() + message));
  };
  for (std::size_t cut = 1; cut < 16; ++cut)
    refused(good.substr(0, good.size() - cut), ": truncated record 3 at the end");
  for (std::size_t cut : {std::size_t(16), std::size_t(20), std::size_t(24), data - 1})
    refused(good.substr(0, cut), ": file ends within the binary header");
  std::string bad = good;
  bad[14] = '2';
  refused(bad, ": binary PE series of another version, expected version 1");
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
  bad = good;
  bad.replace(bad.find("# seed = 5"), 10, "# seed : 5");
  refused(bad, ": header line 6: header line '# seed : 5', expected '# key = value'");
}

TEST_F(PeSeries, NoFile) {
  EXPECT_TRUE(contains(message_of<FileError>([&] { read_all(file()); }),
                       file() + ": cannot open: No such file"));
  EXPECT_THROW(read_all(folder_.string()), FileError);
}

// ---- writing ----

TEST_P(PeSeriesBoth, WriterRefusesWhatNoReaderWouldTake) {
  PeSeriesWriter writer;
  EXPECT_THROW(writer.write(100, 1.0), FileError);
  writer.create(file(), some_info(), GetParam());
  writer.write(100, 1.0);
  EXPECT_THROW(writer.write(100, 1.0), FileError);
  EXPECT_TRUE(contains(
      message_of<FileError>([&] { writer.write(102, std::numeric_limits<double>::quiet_NaN()); }),
      "cannot write step 102: pe is not finite"));
  writer.write(102, 1.0);
  writer.close();
  EXPECT_EQ(read_all(file()).size(), 2U);
}

TEST_P(PeSeriesBoth, WriterRefusesBadHeaders) {
  PeSeriesWriter writer;
  const auto refused = [&](auto &&spoil) {
    PeSeriesInfo info = some_info();
    spoil(info);
    EXPECT_THROW(writer.create(file(), info, GetParam()), std::invalid_argument);
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

TEST_P(PeSeriesBoth, FailedCreateKeepsTheOldFile) {
  write_series(GetParam(), 110);
  const std::string before = slurp(file());
  std::filesystem::create_directory(file() + ".new");
  PeSeriesWriter writer;
  EXPECT_THROW(writer.create(file(), some_info(), GetParam()), FileError);
  EXPECT_EQ(slurp(file()), before);
}

TEST_P(PeSeriesBoth, FullDiskShowsAtTheLatestOnClose) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  PeSeriesWriter writer;
  EXPECT_TRUE(
      contains(message_of<FileError>([&] { writer.create("/dev/full", some_info(), GetParam()); }),
               "/dev/full: cannot write: "));
}

// ---- resuming ----

TEST_P(PeSeriesBoth, ResumeGoesOnAsIfNeverInterrupted) {
  write_series(GetParam(), 20000);
  const std::string expected = slurp(file());
  for (std::int64_t at : {100, 102, 103, 5000, 15000}) {
    SCOPED_TRACE(at);
    write_series(GetParam(), 15000);
    PeSeriesWriter writer;
    const std::int64_t kept = (at - 100) / 2 + 1;
    EXPECT_EQ(writer.resume(file(), some_info(), GetParam(), at), kept);
    EXPECT_THROW(writer.write(100 + 2 * (kept - 1), 1.0), FileError);
    for (std::int64_t step = 100 + 2 * kept; step <= 20000; step += 2)
      writer.write(step, some_pe(step));
    writer.close();
    EXPECT_EQ(slurp(file()), expected);
  }
}

TEST_P(PeSeriesBoth, LookingForThePlaceToCutChangesNothing) {
  write_series(GetParam(), 110);
  const std::string before = slurp(file());
  PeSeriesWriter writer;
  writer.find_cut(file(), some_info(), GetParam(), 105);
  EXPECT_EQ(slurp(file()), before);
  EXPECT_EQ(writer.cut(), 3);
  writer.write(106, 1.0);
  writer.close();
  EXPECT_EQ(read_all(file()).size(), 4U);
}

TEST_P(PeSeriesBoth, ResumeBeforeTheFirstSample) {
  write_series(GetParam(), 110);
  PeSeriesWriter writer;
  EXPECT_EQ(writer.resume(file(), some_info(), GetParam(), 99), 0);
  writer.write(100, 1.0);
  writer.close();
  EXPECT_EQ(read_all(file()).size(), 1U);
}

TEST_P(PeSeriesBoth, ResumeDropsATornLastSample) {
  write_series(GetParam(), 110);
  const std::string expected = slurp(file());
  for (std::size_t length : {1, 5, 15}) {
    spill(file(), expected + std::string("112,10,10000.00892857").substr(0, length));
    PeSeriesWriter writer;
    EXPECT_EQ(writer.resume(file(), some_info(), GetParam(), 111), 6);
    writer.close();
    EXPECT_EQ(slurp(file()), expected);
  }
}

TEST_P(PeSeriesBoth, ResumeNamesTheParameterThatDiffers) {
  write_series(GetParam(), 110);
  const std::string before = slurp(file());
  const auto refused = [&](auto &&change, const std::string &message) {
    PeSeriesInfo info = some_info();
    change(info);
    PeSeriesWriter writer;
    EXPECT_TRUE(
        contains(message_of<FileError>([&] { writer.resume(file(), info, GetParam(), 104); }),
                 file() + ": cannot resume: parameter " + message));
    EXPECT_EQ(slurp(file()), before);
  };
  refused([](PeSeriesInfo &info) { info.dt = 0.5; }, "'dt' is '0.25' in the file, expected '0.5'");
  refused([](PeSeriesInfo &info) { info.stride = 1; }, "'stride' is '2' in the file, expected '1'");
  refused([](PeSeriesInfo &info) { info.model = "lsm"; }, "'model' is 'block-slider' in the file");
  refused([](PeSeriesInfo &info) { info.parameters[0].second = "6"; },
          "'seed' is '5' in the file, expected '6'");
  refused([](PeSeriesInfo &info) { info.parameters.emplace_back("V", "1"); },
          "'V' is missing in the file, expected '1'");
  PeSeriesInfo info = some_info();
  info.parameters[0].second = "6";
  PeSeriesWriter writer;
  EXPECT_EQ(writer.resume(file(), info, GetParam(), 104, {"seed"}), 3);
  writer.close();
  EXPECT_THROW(writer.resume(file(), some_info(), !GetParam(), 104), FileError);
}

TEST_P(PeSeriesBoth, ResumeTellsOfMissingSamples) {
  write_series(GetParam(), 110);
  const std::string before = slurp(file());
  PeSeriesWriter writer;
  EXPECT_TRUE(
      contains(message_of<FileError>([&] { writer.resume(file(), some_info(), GetParam(), 112); }),
               file() + ": cannot resume: samples end at step 110, expected them up to step 112"));
  EXPECT_EQ(slurp(file()), before);
}

TEST_F(PeSeries, ResumeStopsAtABadLineAndLosesNothing) {
  const std::string text = text_header + "100,7,1\n102,7.5,nan\n104,8,1\n";
  spill(file(), text);
  PeSeriesWriter writer;
  EXPECT_TRUE(
      contains(message_of<FileError>([&] { writer.resume(file(), some_info(), false, 104); }),
               file() + ":11: column 'pe' is 'nan'"));
  EXPECT_EQ(slurp(file()), text);
}

}  // namespace
