// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <limits>
#include <regex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "read_catalogue.h"
#include "same_events.h"
#include "unit_files.h"
#include "files/file_error.h"

namespace {

using LSM::CatalogueInfo;
using LSM::CatalogueWriter;
using LSM::FileError;
using LSM::Rupture;
using unit::contains;
using unit::expect_error;
using unit::message_of;
using unit::resume;
using unit::slurp;
using unit::spill;

CatalogueInfo some_info() {
  CatalogueInfo info;
  info.model = "lsm";
  info.parameters = {{"seed", "7"}, {"lambda", "0.99"}, {"program", "lsm 0.1 = a = b"}};
  return info;
}

/// Event n lasts from step 100 n to step 100 n + 10.
Rupture some_event(std::int64_t id) {
  Rupture event;
  event.id = id;
  event.step_start = 100 * id;
  event.step_end = 100 * id + 10;
  event.t_start = 0.03 * static_cast<double>(event.step_start);
  event.t_end = 0.03 * static_cast<double>(event.step_end);
  event.pe_start = 10.0 + 1.0 / 3.0;
  event.pe_end = 10.0 + 0.1 / static_cast<double>(id);
  event.size = event.pe_start - event.pe_end;
  event.slip_moment = 0.7 * static_cast<double>(id);
  event.x_centroid = -1.25;
  event.rupture_length = 3.0;
  event.x_hypocentre = 0.5;
  event.x_begin = -0.75;
  event.mean_slip = 0.125 * static_cast<double>(id);
  event.stress_drop = -0.25;
  return event;
}

const std::string header =
    "# lsm-catalogue 1\n"
    "# model = lsm\n"
    "# seed = 7\n"
    "# lambda = 0.99\n"
    "# program = lsm 0.1 = a = b\n";
const std::string columns = "event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end\n";

class CatalogueFile : public unit::Files {
 protected:
  std::string file() const { return path("events.csv"); }

  void write_events(int count, const CatalogueInfo &info = some_info()) {
    CatalogueWriter writer;
    writer.create(file(), info);
    for (int id = 1; id <= count; ++id) writer.write(some_event(id));
    writer.close();
  }

  /// Expects that a reader refuses this text.
  void refused(const std::string &text, const std::string &message, bool lenient = false) {
    spill(file(), text);
    EXPECT_TRUE(contains(message_of<FileError>([&] { unit::read_catalogue(file(), lenient); }),
                         file() + message))
        << text;
  }

  /// Expects that a run restarted after so many events does not go on with the file, which stays as
  /// it is.
  void not_resumed(const CatalogueInfo &info, std::int64_t events, const std::string &message) {
    const std::string before = slurp(file());
    CatalogueWriter writer;
    expect_error<FileError>([&] { resume(writer, file(), info, events); }, file() + message);
    EXPECT_FALSE(writer.is_open());
    EXPECT_EQ(slurp(file()), before);
  }
};

using CatalogueRead = CatalogueFile;
using CatalogueWrite = CatalogueFile;
using CatalogueResume = CatalogueFile;

// ---- format ----

TEST(Text, NumbersAreFiniteAndNothingElse) {
  double number = 7.0;
  for (const char *text : {"nan", "inf", "-inf", "1e999", "", " 1", "1 ", "1,5", "0x1"})
    EXPECT_FALSE(LSM::text::parse(text, number)) << "'" << text << "'";
  EXPECT_EQ(number, 7.0);
  EXPECT_TRUE(LSM::text::parse("-1e-3", number));
  EXPECT_EQ(number, -1e-3);
  int whole = 7;
  EXPECT_FALSE(LSM::text::parse("2.5", whole));
  EXPECT_EQ(whole, 7);
  EXPECT_TRUE(LSM::text::parse("-12", whole));
  EXPECT_EQ(whole, -12);
}

TEST_F(CatalogueWrite, FormatToTheByte) {
  CatalogueWriter writer;
  writer.create(file(), some_info());
  Rupture event;
  event.id = 1;
  event.t_start = 0.25;
  event.t_end = 3.0;
  event.step_start = 10;
  event.step_end = 120;
  event.size = 0.1;
  event.pe_start = 1e-7;
  event.pe_end = -2.5e20;
  writer.write(event);
  writer.close();
  EXPECT_EQ(slurp(file()), header + columns +
                               "1,0.25,3,10,120,0.10000000000000001,9.9999999999999995e-08,"
                               "-2.5e+20\n");
}

/// The columns that follow those of all catalogues, as a line and as read by a reader of the kind.
template <class Kind>
void expect_columns(const std::string &file, const Kind &event, const std::string &names) {
  CatalogueInfo info = some_info();
  each_table(&event, [&info](const auto &table) { LSM::add_names(info.columns, table); });
  CatalogueWriter writer;
  writer.create(file, info);
  writer.write(event);
  writer.close();
  EXPECT_TRUE(contains(slurp(file), ",pe_end" + names + "\n")) << slurp(file);
  const auto read = unit::read_catalogue<Kind>(file);
  EXPECT_EQ(read.info.columns, info.columns);
  ASSERT_EQ(read.events.size(), 1U);
  Kind expected = event, found = read.events[0];
  for (const std::string_view column : info.columns)
    EXPECT_EQ(*LSM::number_in(found, column), *LSM::number_in(expected, column)) << column;
}

TEST_F(CatalogueWrite, EachKindOfEventsHasItsColumns) {
  const Rupture rupture = some_event(2);
  const std::string of_ruptures =
      ",slip_moment,x_centroid,rupture_length,x_hypocentre,x_begin,mean_slip,stress_drop,peak_slip";
  expect_columns<LSM::Event>(file(), rupture, "");
  expect_columns<LSM::Drop>(file(), {rupture, 1.4, -1.25, 3.0, 0.5, 0.25, 0.75},
                            ",slip_moment,x_centroid,rupture_length,peak_slip,friction_work,"
                            "friction_total");
  expect_columns(file(), rupture, of_ruptures);
  expect_columns<LSM::PlaneRupture>(
      file(), {rupture, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0},
      of_ruptures +
          ",moment_strike,moment_dip,z_centroid,rupture_width,rupture_area,"
          "z_hypocentre,z_begin,peak_slip_rate");
}

TEST_F(CatalogueWrite, AColumnThatTheEventDoesNotHaveIsRefused) {
  CatalogueInfo info = some_info();
  info.columns = {"stress_drop"};
  CatalogueWriter writer;
  writer.create(file(), info);
  EXPECT_THROW(writer.write(LSM::Drop{}), std::invalid_argument);
  writer.write(some_event(1));
}

TEST_F(CatalogueWrite, NumbersComeBackToTheLastBit) {
  const double awkward[] = {0.1,
                            1.0 / 3.0,
                            -0.0,
                            1e-300,
                            std::numeric_limits<double>::denorm_min(),
                            std::numeric_limits<double>::max(),
                            123456789.01234567,
                            -2.2250738585072014e-308};
  CatalogueWriter writer;
  writer.create(file(), some_info());
  std::vector<LSM::Event> written;
  for (double value : awkward) {
    written.push_back(some_event(static_cast<std::int64_t>(written.size()) + 1));
    written.back().size = value;
    written.back().pe_end = -value;
  }
  written.push_back(some_event(static_cast<std::int64_t>(written.size()) + 1));
  written.back().step_end = std::numeric_limits<std::int64_t>::max();
  for (const LSM::Event &event : written) writer.write(event);
  writer.close();
  const auto read = unit::read_catalogue(file()).events;
  unit::expect_same_events(read, written);
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].id, written[i].id);
    EXPECT_EQ(std::signbit(read[i].size), std::signbit(written[i].size));
  }
}

TEST_F(CatalogueWrite, LocaleDoesNotMatter) {
  write_events(3);
  const std::string expected = slurp(file());
  const unit::CommaLocale locale;
  write_events(3);
  EXPECT_EQ(slurp(file()), expected);
  const auto catalogue = unit::read_catalogue(file());
  ASSERT_EQ(catalogue.events.size(), 3U);
  EXPECT_EQ(catalogue.events[2].size, some_event(3).size);
}

TEST_F(CatalogueWrite, HeaderComesBack) {
  CatalogueInfo info = some_info();
  info.model = "block-slider";
  info.parameters.emplace_back("note", "  blanks around go, commas, and = stay ");
  info.parameters.emplace_back("empty", "");
  write_events(0, info);
  const auto catalogue = unit::read_catalogue(file());
  EXPECT_TRUE(catalogue.events.empty());
  EXPECT_EQ(catalogue.info.model, "block-slider");
  ASSERT_EQ(catalogue.info.parameters.size(), 5U);
  EXPECT_EQ(catalogue.info.parameters[0].first, "seed");
  ASSERT_NE(catalogue.info.find("note"), nullptr);
  EXPECT_EQ(*catalogue.info.find("note"), "blanks around go, commas, and = stay");
  EXPECT_EQ(*catalogue.info.find("program"), "lsm 0.1 = a = b");
  EXPECT_EQ(*catalogue.info.find("empty"), "");
  EXPECT_EQ(catalogue.info.find("nothing"), nullptr);
}

TEST_F(CatalogueWrite, RefusesHeadersThatWouldNotReadBack) {
  CatalogueWriter writer;
  CatalogueInfo info = some_info();
  info.model = "spring";
  EXPECT_THROW(writer.create(file(), info), std::invalid_argument);
  const std::pair<std::string, std::string> bad[] = {{"", "1"},       {"a=b", "1"},  {" a", "1"},
                                                     {"a\nb", "1"},   {"a", "1\n2"}, {"seed", "8"},
                                                     {"model", "lsm"}};
  for (const auto &parameter : bad) {
    SCOPED_TRACE(parameter.first);
    info = some_info();
    info.parameters.push_back(parameter);
    EXPECT_THROW(writer.create(file(), info), std::invalid_argument);
  }
  EXPECT_FALSE(std::filesystem::exists(file()));
}

// ---- safety of what is written ----

TEST_F(CatalogueWrite, EachEventIsInTheFileAtOnce) {
  CatalogueWriter writer;
  writer.create(file(), some_info());
  EXPECT_EQ(unit::read_catalogue(file()).events.size(), 0U);
  for (int id = 1; id <= 5; ++id) {
    writer.write(some_event(id));
    EXPECT_EQ(unit::read_catalogue(file()).events.size(), static_cast<std::size_t>(id));
  }
  EXPECT_EQ(writer.rows(), 5);
}

TEST_F(CatalogueWrite, CreateFollowsLinks) {
  spill(path("target.csv"), "old");
  std::filesystem::create_symlink("target.csv", file());
  write_events(1);
  EXPECT_TRUE(std::filesystem::is_symlink(file()));
  EXPECT_EQ(unit::read_catalogue(path("target.csv")).events.size(), 1U);
}

TEST_F(CatalogueWrite, FailedCreateKeepsTheOldFile) {
  write_events(3);
  const std::string before = slurp(file());
  std::filesystem::create_directory(file() + ".new");  // where the temporary file would be
  CatalogueWriter writer;
  expect_error<FileError>([&] { writer.create(file(), some_info()); },
                          file() + ": cannot open for writing: ");
  EXPECT_EQ(slurp(file()), before);
  EXPECT_FALSE(writer.is_open());
  EXPECT_THROW(writer.write(some_event(1)), FileError);
}

TEST_F(CatalogueWrite, RefusesEventsNoReaderWouldTake) {
  CatalogueWriter writer;
  writer.create(file(), some_info());
  writer.write(some_event(2));
  Rupture event = some_event(3);
  event.size = std::numeric_limits<double>::quiet_NaN();
  expect_error<FileError>([&] { writer.write(event); },
                          "cannot write event 3: column 'size' is not finite");
  EXPECT_THROW(writer.write(some_event(1)), FileError);
  EXPECT_THROW(writer.write(some_event(2)), FileError);
  writer.write(some_event(3));
  EXPECT_EQ(unit::read_catalogue(file()).events.size(), 2U);
}

// ---- strict and lenient reading ----

struct Bad {
  std::string text;     // the file
  std::string message;  // after the path
};

const std::string row1 = "1,1,2,10,20,0.5,3,2.5\n";
const std::string row2 = "2,3,4,30,40,0.5,3,2.5\n";
const std::string row3 = "3,5,6,50,60,0.5,3,2.5\n";

/// Bad rows, which are placed between two good ones, in line 8 of the file.
const std::vector<Bad> bad_rows = {
    {"2,3,4,30,40,0.5,3\n", ":8: 7 columns, expected 8 (event_id,"},
    {"2,3,4,30,40,0.5,3,2.5,1\n", ":8: 9 columns, expected 8 "},
    {"\n", ":8: 0 columns, expected 8 "},
    {"2,3,4,30,40,nan,3,2.5\n", ":8: column 'size' is 'nan', expected a finite number"},
    {"2,3,four,30,40,0.5,3,2.5\n", ":8: column 't_end' is 'four', expected a finite"},
    {"2,3,4,30,40,0.5\r,3,2.5\n", ":8: column 'size' is '0.5?', expected a"},
    {"2,3,4,30.5,40,0.5,3,2.5\n",
     ":8: column 'step_start' is '30.5', expected "
     "an integer"},
    {"2,3,2.5,30,40,0.5,3,2.5\n", ":8: t_end 2.5 is before t_start 3, "},
    {"2,3,4,30,29,0.5,3,2.5\n", ":8: step_end 29 is before step_start "},
    {"2,1.5,4,30,40,0.5,3,2.5\n",
     ":8: t_start 1.5 is before the end of the previous event 2, expected events in order"},
    {"2,3,4,19,40,0.5,3,2.5\n", ":8: step_start 19 is before the end of the "},
    {"1,3,4,30,40,0.5,3,2.5\n", ":8: event_id 1 after event_id 1, expected incr"}};

TEST_F(CatalogueRead, StrictRefusesBadRows) {
  for (const Bad &bad : bad_rows) refused(header + columns + row1 + bad.text + row3, bad.message);
  // All columns may be there, but the last number may lack digits.
  for (const char *tail : {"2,3,4,30,40,0.5,3,2.5", "2,3,4,3", "2"})
    refused(header + columns + row1 + tail,
            ":8: truncated last line, expected 8 columns and a line end");
}

TEST_F(CatalogueRead, RupturesMayOverlapInOrderOfTheirEnds) {
  const std::string ruptures = header + "# events = ruptures\n" + columns;
  // One event that started first but ended last, and two that end at the same time.
  const std::string rows =
      "1,2,3,20,30,0.5,3,2.5\n"
      "2,2.5,3,25,30,0.5,3,2.5\n"
      "3,1,4,10,40,0.5,3,2.5\n";
  spill(file(), ruptures + rows);
  const auto catalogue = unit::read_catalogue(file());
  EXPECT_TRUE(catalogue.info.overlapping());
  ASSERT_EQ(catalogue.events.size(), 3U);
  EXPECT_EQ(catalogue.events[2].t_start, 1.0);
  spill(file(), header + "# events = of a kind to come\n" + columns + rows);
  EXPECT_EQ(unit::read_catalogue(file()).events.size(), 3U);
  // Without the parameter, and for drops of PE, this is an error.
  refused(header + columns + rows, ":8: t_start 2.5 is before the end of the previous event 3, ");
  refused(header + "# events = pe\n" + columns + rows, ":9: t_start 2.5 is before the end of the ");
  // Events must be in the order of their ends.
  const std::string said = " is before the end of the previous event 4, 40, expected ruptures in ";
  refused(ruptures + rows + "4,2,3.5,20,50,0.5,3,2.5\n",
          ":11: end at t_end 3.5, step_end 50" + said);
  refused(ruptures + rows + "4,2,4.5,20,35,0.5,3,2.5\n",
          ":11: end at t_end 4.5, step_end 35" + said);
  refused(ruptures + rows + "3,2,5,20,50,0.5,3,2.5\n", ":11: event_id 3 after event_id 3");
}

TEST_F(CatalogueRead, LineEndsOfWindowsAndByteOrderMarks) {
  write_events(3);
  const std::string plain = slurp(file()), mark = "\xef\xbb\xbf",
                    windows = std::regex_replace(plain, std::regex("\n"), "\r\n");
  for (const std::string &text : {mark + plain, windows, mark + windows}) {
    spill(file(), text);
    const auto catalogue = unit::read_catalogue(file());
    ASSERT_EQ(catalogue.events.size(), 3U);
    EXPECT_EQ(catalogue.events[2].size, some_event(3).size);
    EXPECT_EQ(*catalogue.info.find("seed"), "7");
    // Appending to it would mix two kinds of line ends.
    not_resumed(some_info(), 2, ": cannot resume: Windows line ends or a byte order mark, expec");
  }
  for (const char *utf16 : {"\xff\xfe#\0", "\xfe\xff\0#"})
    refused(std::string(utf16, 4), ": text in UTF-16, expected UTF-8");
}

TEST_F(CatalogueRead, CompressedFilesAreRefusedByName) {
  const std::string xz{'\xfd', '7', 'z', 'X', 'Z', '\0'};
  const std::pair<std::string, std::string> files[] = {
      {"\x1f\x8b\b", "gzip"}, {xz, "xz"}, {"BZh9", "bzip2"}, {"\x28\xb5\x2f\xfd", "zstd"}};
  for (const auto &[begin, program] : files)
    refused(begin + "and more", ": compressed by " + program + ", expected a file that is not");
}

// If each key were compared with all keys before it, this test would run into its time limit.
TEST_F(CatalogueRead, LongHeader) {
  CatalogueInfo info = some_info();
  for (int i = 0; i < 300000; ++i) info.parameters.emplace_back("key" + std::to_string(i), "1");
  write_events(2, info);
  const auto catalogue = unit::read_catalogue(file());
  EXPECT_EQ(catalogue.info.parameters, info.parameters);
  CatalogueWriter writer;
  EXPECT_EQ(resume(writer, file(), info, 2), 2);
}

// A small compressed file may unpack to any header, which no reader repairs and no program writes.
TEST_F(CatalogueRead, HeaderWithoutEnd) {
  CatalogueInfo info = some_info();
  std::string text = header, repeated = header;
  for (int i = 0; i < 2000; ++i) {
    info.parameters.emplace_back("key" + std::to_string(i), std::string(5000, 'x'));
    text += "# key" + std::to_string(i) + " = " + std::string(5000, 'x') + "\n";
    repeated += "# key = " + std::string(5000, 'x') + "\n";
  }
  for (const std::string &lines : {text, repeated}) {
    spill(file(), lines + columns + row1);
    const std::string problem = message_of<FileError>([&] { unit::read_catalogue(file(), true); });
    EXPECT_EQ(problem.find(file() + ":16"), 0U) << problem;
    EXPECT_TRUE(contains(problem, "header longer than 8388608 bytes, expected a line of column "));
  }
  CatalogueWriter writer;
  EXPECT_EQ(message_of<std::invalid_argument>([&] { writer.create(file(), info); }),
            "file header: longer than 8388608 bytes");
}

TEST_F(CatalogueResume, RupturesAreInOrderOfTheirEnds) {
  CatalogueInfo info = some_info();
  info.parameters.emplace_back("events", "ruptures");
  CatalogueWriter writer;
  writer.create(file(), info);
  Rupture event;
  for (const std::int64_t end : {30, 30, 40, 55}) {
    event.id += 1;
    event.step_end = end;
    event.t_end = static_cast<double>(end);
    writer.write(event);  // all start at 0
  }
  event.id += 1;
  event.step_end = 54;
  EXPECT_THROW(writer.write(event), FileError);
  writer.close();
  CatalogueWriter again;
  EXPECT_EQ(resume(again, file(), info, 3), 3);
  EXPECT_EQ(unit::read_catalogue(file()).events.size(), 3U);
}

TEST_F(CatalogueRead, LenientSkipsAndCountsBadRows) {
  spill(file(), header + columns + row1 + row2 + row3);
  const auto good = unit::read_catalogue(file(), true);
  EXPECT_EQ(good.events.size(), 3U);
  EXPECT_EQ(good.skipped, 0);
  EXPECT_EQ(good.first_problem, "");
  std::string text = header + columns + row1;
  for (const Bad &bad : bad_rows) text += bad.text;
  spill(file(), text + row3 + "4,7,8,70,80,0.5,3,2.");
  const auto catalogue = unit::read_catalogue(file(), true);
  ASSERT_EQ(catalogue.events.size(), 2U);
  EXPECT_EQ(catalogue.events[0].id, 1);
  EXPECT_EQ(catalogue.events[1].id, 3);
  EXPECT_EQ(catalogue.skipped, static_cast<std::int64_t>(bad_rows.size()) + 1);
  EXPECT_TRUE(contains(catalogue.first_problem, file() + ":8: 7 columns, expected 8"));
}

const std::vector<Bad> bad_headers = {
    {"", ":1: empty file, expected '# lsm-catalogue 1'"},
    {"# lsm-catalogue 2\n# model = lsm\n" + columns,
     ":1: catalogue version '2', expected version 1"},
    {"time,size\n1,2\n", ":1: not a catalogue, expected '# lsm-catalogue 1'"},
    {"# lsm-catalogue 1\n# seed = 7\n" + columns, ":3: no model in the header, expec"},
    {"# lsm-catalogue 1\n# model = sand\n" + columns,
     ":2: model is 'sand', expected 'lsm' or 'block-slider'"},
    {header, ":5: file ends within the header, expected a line of column names"},
    {header + row1, ":6: column 'event_id' is missing, expected 'event_id,t_s"},
    {header + "event_id,t_start,t_end,step_start,step_end,size,pe_start\n",
     ":6: column 'pe_end' is missing, expected 'event_id,t_start,"},
    {header + columns.substr(0, columns.size() - 1) + ",size\n",
     ":6: column 'size' is there twice, expected once"},
    {header + columns.substr(0, columns.size() - 1), ":6: truncated line of column names"}};

TEST_F(CatalogueRead, BadHeadersAreRefusedEvenIfLenient) {
  for (const Bad &bad : bad_headers)
    for (bool lenient : {false, true}) refused(bad.text, bad.message, lenient);
}

TEST_F(CatalogueRead, ColumnsAreFoundByName) {
  const std::string odd =
      "depth,size,event_id,t_end,x_centroid,t_start,step_start,step_end,pe_start,note,pe_end,"
      "slip_moment\n";
  spill(file(),
        header + odd + "deep,0.5,1,2,7,1,10,20,3,,2.5,4\n-,0.25,2,4,8,3,30,40,3,a b,2.75,5\n");
  const auto catalogue = unit::read_catalogue<Rupture>(file());
  ASSERT_EQ(catalogue.events.size(), 2U);
  const Rupture &event = catalogue.events[1];
  EXPECT_EQ(event.id, 2);
  EXPECT_EQ(event.t_start, 3.0);
  EXPECT_EQ(event.step_end, 40);
  EXPECT_EQ(event.size, 0.25);
  EXPECT_EQ(event.pe_end, 2.75);
  EXPECT_EQ(event.x_centroid, 8.0);
  EXPECT_EQ(event.slip_moment, 5.0);
  EXPECT_EQ(catalogue.info.columns, (std::vector<std::string_view>{"x_centroid", "slip_moment"}));
  // Messages about bad rows name the columns of the file; a run continues only files that have its
  // own columns.
  refused(header + odd + "deep,0.5,1,2,7,1,10,20,3,,2.5\n",
          ":7: 11 columns, expected 12 (depth,size,event_id,");
  spill(file(), header + odd);
  not_resumed(unit::read_catalogue(file()).info, 1,
              ": cannot resume: columns are 'depth,size,event_id,");
}

TEST_F(CatalogueRead, OddHeaderLinesAreRefusedOrSkipped) {
  const std::string start = "# lsm-catalogue 1\n# model = lsm\n# seed = 7\n";
  const Bad odd[] = {{"# just a note\n", ":4: header line '# just a note', expected "},
                     {"# = 3\n", ":4: header line '# = 3', expected '# key = value'"},
                     {"# seed = 8\n", ":4: parameter 'seed' given twice, expected once"},
                     {"# model = lsm\n", ":4: parameter 'model' given twice"}};
  for (const Bad &bad : odd) {
    refused(start + bad.text + columns + row1, bad.message);
    const auto catalogue = unit::read_catalogue(file(), true);
    EXPECT_EQ(catalogue.events.size(), 1U);
    EXPECT_EQ(catalogue.skipped, 1);
    EXPECT_EQ(*catalogue.info.find("seed"), "7");
  }
}

TEST_F(CatalogueRead, MessagesStayOnOneLine) {
  spill(file(), header + columns + "1,\x01\x1b" + std::string(5000, 'z') + ",2,10,20,0.5,3,2.5\n");
  const std::string message = message_of<FileError>([&] { unit::read_catalogue(file()); });
  EXPECT_TRUE(contains(message, "is '??zzz"));
  EXPECT_LT(message.size(), file().size() + 200);
}

// ---- resuming ----

TEST_F(CatalogueResume, GoesOnAsIfNeverInterrupted) {
  write_events(6);
  const std::string expected = slurp(file());
  for (const int kept : {0, 1, 3, 5})
    for (const std::string torn : {"", "6,12,12.3,400,410,0.5", "6", ",,,,,,,,,,", "\x01\x02"}) {
      SCOPED_TRACE(std::to_string(kept) + torn);
      write_events(5);
      spill(file(), slurp(file()) + torn);
      CatalogueWriter writer;
      EXPECT_EQ(resume(writer, file(), some_info(), kept), kept);
      for (int id = kept + 1; id <= 6; ++id) writer.write(some_event(id));
      writer.close();
      EXPECT_EQ(slurp(file()), expected);
    }
}

TEST_F(CatalogueResume, GoesOnWithAFileThatAContinuedRunBegan) {
  // Events 1 to 24 are in another file.
  CatalogueWriter begun;
  begun.create(file(), some_info());
  begun.close();
  EXPECT_EQ(resume(begun, file(), some_info(), 24), 0);
  for (int id : {25, 26, 27}) begun.write(some_event(id));
  begun.close();
  CatalogueWriter writer;
  EXPECT_EQ(resume(writer, file(), some_info(), 26), 2);
  writer.close();
  not_resumed(some_info(), 27, ": cannot resume: 26 events up to the checkpoint, expected 27");
}

TEST_F(CatalogueResume, LookingForThePlaceToCutChangesNothing) {
  write_events(3);
  spill(file(), slurp(file()) + "4,12");
  const std::string before = slurp(file());
  CatalogueWriter writer;
  writer.find_cut(file(), some_info(), 1);
  EXPECT_EQ(slurp(file()), before);
  writer.cut();
  EXPECT_EQ(writer.rows(), 1);
  writer.write(some_event(2));
  writer.close();
  EXPECT_EQ(unit::read_catalogue(file()).events.size(), 2U);
}

TEST_F(CatalogueResume, KeepsOrderOverTheSeam) {
  write_events(3);
  CatalogueWriter writer;
  resume(writer, file(), some_info(), 3);
  EXPECT_THROW(writer.write(some_event(3)), FileError);
  writer.write(some_event(4));
  EXPECT_EQ(unit::read_catalogue(file()).events.size(), 4U);
}

TEST_F(CatalogueResume, NamesTheParameterThatDiffers) {
  write_events(3);
  const auto differs = [&](const std::string &message, auto change) {
    CatalogueInfo info = some_info();
    change(info);
    not_resumed(info, 1, ": cannot resume: " + message);
  };
  differs("parameter 'lambda' is '0.99' in the file, expected '0.98'",
          [](CatalogueInfo &info) { info.parameters[1].second = "0.98"; });
  differs("parameter 'mu' is missing in the file, expected '0.6'",
          [](CatalogueInfo &info) { info.parameters.emplace_back("mu", "0.6"); });
  differs("parameter 'seed' is '7' in the file, expected no such parameter",
          [](CatalogueInfo &info) { info.parameters.erase(info.parameters.begin()); });
  differs("parameter 'model' is 'lsm' in the file, expected 'block-slider'",
          [](CatalogueInfo &info) { info.model = "block-slider"; });
  differs("columns are 'event_id,", [](CatalogueInfo &info) { info.columns = {"slip_moment"}; });
}

TEST_F(CatalogueResume, WhatMayChangeKeepsItsValue) {
  write_events(3);
  CatalogueInfo info = some_info();
  info.parameters[2].second = "lsm 0.2";
  info.parameters.emplace_back("ranks", "2");
  std::swap(info.parameters[0], info.parameters[2]);  // their order does not matter
  CatalogueWriter writer;
  EXPECT_EQ(resume(writer, file(), info, 1), 1);
  writer.close();
  EXPECT_EQ(*unit::read_catalogue(file()).info.find("program"), "lsm 0.1 = a = b");
}

TEST_F(CatalogueResume, BadRowBeforeTheRestartLosesNothing) {
  spill(file(), header + columns + row1 + "2,3,4,30,40,0.5\n" + row3);
  not_resumed(some_info(), 3, ":8: 6 columns, expected 8");
}

TEST_F(CatalogueResume, NothingToGoOnWith) {
  CatalogueWriter writer;
  EXPECT_THROW(resume(writer, file(), some_info(), 0), FileError);
  EXPECT_FALSE(std::filesystem::exists(file()));
  spill(file(), "");
  EXPECT_THROW(resume(writer, file(), some_info(), 0), FileError);
  spill(file(), "something else\n");
  EXPECT_THROW(resume(writer, file(), some_info(), 0), FileError);
  EXPECT_EQ(slurp(file()), "something else\n");
}

}  // namespace
