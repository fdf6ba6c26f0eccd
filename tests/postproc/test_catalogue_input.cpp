// SPDX-License-Identifier: GPL-2.0-or-later
#include "catalogue_input.h"
#include "event_tables.h"
#include "size_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "numbers.h"
#include "unit_files.h"

using namespace LSM;
using namespace LSM::postproc;
using unit::contains;
using unit::expect_error;
using unit::spill;

namespace {

const std::string columns = "event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end";

class CatalogueInput : public unit::Files {
 protected:
  /// Writes a catalogue and returns its path. The rows begin in line 4.
  std::string file(const std::string &rows, const std::string &parameter = "length = 120",
                   const std::string &model = "lsm") {
    const std::string name = path("c" + std::to_string(++count_) + ".csv");
    spill(name, "# lsm-catalogue 1\n# model = " + model + "\n# " + parameter + "\n" + columns +
                    "\n" + rows);
    return name;
  }

  CatalogueOptions lenient() const {
    CatalogueOptions options;
    options.lenient = true;
    return options;
  }

  int count_ = 0;
};

const std::string good =
    "1,1,2,10,20,0.5,1,0.5\n"
    "2,3,4,30,40,1e-5,1,1\n"
    "3,5,6,50,60,0.25,1,0.75\n"
    "4,7,8,70,80,-0.125,1,1.125\n";

TEST_F(CatalogueInput, RupturesAreSortedByTheirStarts) {
  const std::string rows =
      "1,2,3,20,30,0.5,1,0.5\n"
      "2,2.5,3,25,30,0.25,1,1\n"
      "3,1,4,10,40,0.125,1,0.75\n";
  const EventTable table =
      load_catalogue(file(rows, "events = ruptures", "block-slider"), CatalogueOptions());
  EXPECT_EQ(starts(table), (std::vector<double>{1, 2, 2.5}));
  EXPECT_EQ(ends(table), (std::vector<double>{4, 3, 3}));
  EXPECT_EQ(sizes(table), (std::vector<double>{0.125, 0.5, 0.25}));
  EXPECT_EQ(table.last_end, 4.0);
}

TEST_F(CatalogueInput, TimesAsTheWayOfThePlate) {
  CatalogueOptions options;
  options.displacement = true;
  options.from_time = 1.0;  // as plate displacements, too
  options.to_time = 3.5;
  const EventTable table = load_catalogue(file(good, "velocity = -0.5"), options);
  EXPECT_EQ(starts(table), (std::vector<double>{1.5, 2.5}));
  EXPECT_EQ(ends(table), (std::vector<double>{2.0, 3.0}));
  EXPECT_EQ(table.in_events, 1.0);
  for (const char *parameter : {"length = 120", "velocity = 0", "velocity = fast"})
    EXPECT_THROW(load_catalogue(file(good, parameter), options), FileError) << parameter;
}

TEST_F(CatalogueInput, ColumnsOfTheEventsChosen) {
  const std::string name = file(good);
  CatalogueOptions options;
  options.min_size = -1.0;
  const EventTable all = load_catalogue(name, options);
  EXPECT_EQ(sizes(all), (std::vector<double>{0.5, 1e-5, 0.25, -0.125}));
  EXPECT_EQ(starts(all), (std::vector<double>{1, 3, 5, 7}));

  options.min_size = 1e-4;
  options.from_time = 1.0;
  options.to_time = 5.0;  // leaves out the first start
  const EventTable some = load_catalogue(name, options);
  EXPECT_EQ(sizes(some), std::vector<double>{0.5});
  EXPECT_EQ(some.left_out_small, 1);
  EXPECT_EQ(some.left_out_time, 2);
  EXPECT_EQ(load_catalogue(name, CatalogueOptions()).events.size(), 3u);  // none of size < 0
}

// More than one block of 2^18 bytes, with a line that is longer than a block.
TEST_F(CatalogueInput, EventsTakeNoMoreMemoryThanTheirUse) {
  std::string rows;
  for (int i = 1; i <= 20000; ++i) {
    const std::string end = std::to_string(2 * i + 1), size = std::to_string(i * 37 % 20000 + 1);
    rows += std::to_string(i) + "," + std::to_string(2 * i) + "," + end + "," +
            std::to_string(20 * i) + "," + end + "0," + size + "," + size + ",0\n";
  }
  const std::string name = file(rows, "note = " + std::string(300000, 'x'));
  CatalogueOptions options;
  const EventTable table = load_catalogue(name, options);
  ASSERT_EQ(table.events.size(), 20000u);
  EXPECT_LE(sizeof(table.events.front()), 40u);
  EXPECT_TRUE(table.details.empty());
  EXPECT_EQ(table.info.find("note")->size(), 300000u);
  for (int i = 1; i <= 20000; ++i) {
    EXPECT_EQ(table.events[static_cast<std::size_t>(i) - 1].t_start, 2.0 * i);
    EXPECT_EQ(table.events[static_cast<std::size_t>(i) - 1].size, i * 37 % 20000 + 1);
  }

  options.details = 30;
  const std::vector<EventRow> largest = load_catalogue(name, options).details;
  ASSERT_EQ(largest.size(), 30u);
  for (const EventRow &event : largest) {
    EXPECT_GT(event.size, 19970.0);
    EXPECT_EQ(event.t_start, 2.0 * static_cast<double>(event.id));
    EXPECT_EQ(event.step_end, 10 * (2 * event.id + 1));
  }
  EXPECT_TRUE(
      std::is_sorted(largest.begin(), largest.end(),
                     [](const EventRow &a, const EventRow &b) { return a.t_start < b.t_start; }));
}

TEST_F(CatalogueInput, KnowsWhereItIsComplete) {
  const std::string name = file(good, "min_size = 0.01");
  EXPECT_EQ(load_catalogue(file(good), {}).complete_from, 0.0);
  for (const auto &[given, found] : {std::pair{0.0, 0.01}, {0.001, 0.01}, {0.1, 0.1}}) {
    CatalogueOptions options;
    options.min_size = given;
    EXPECT_EQ(load_catalogue(name, options).complete_from, found);
  }
}

TEST_F(CatalogueInput, CompletenessIsTheDefaultThreshold) {
  CatalogueOptions options;
  options.paths = {file(good), file(good, "completeness = 0.003"),
                   file(good, "completeness = 0.002"), file(good, "blocks = 3", "block-slider"),
                   file(good, "completeness = 1e-5", "block-slider")};
  const std::vector<EventTable> tables = load_catalogues(options);
  const Threshold none, given(0.25);
  // All catalogues of a model have the same threshold, which is never below the paper's.
  for (std::size_t i : {0, 1, 2}) {
    EXPECT_EQ(none.of(tables[i]).size, 0.003);
    EXPECT_EQ(postproc::text(none.of(tables[i])),
              "0.003, completeness in the header of " + options.paths[1]);
    EXPECT_EQ(tables[i].complete_from, 0.0);  // nothing is left out for it
  }
  for (std::size_t i : {3, 4}) {
    EXPECT_EQ(none.of(tables[i]).size, 1e-4);
    EXPECT_EQ(postproc::text(none.of(tables[i])), "0.0001, that of the paper's Figs. 12 and 13");
  }
  for (const EventTable &table : tables) EXPECT_EQ(given.of(table).size, 0.25);
  EXPECT_EQ(postproc::text(given.of(tables[0])), "0.25, as given");
  EXPECT_EQ(Threshold(0.0).of(tables[0]).size, 0.0);
  EXPECT_EQ(texts(none, tables),
            (std::vector<std::string>{
                "smallest size, fault: " + postproc::text(none.of(tables[0])),
                "smallest size, block-slider: 0.0001, that of the paper's Figs. 12 and 13"}));
}

// That events may overlap does not mean that they are ruptures.
TEST_F(CatalogueInput, KindsOfEventsAreToldApart) {
  CatalogueOptions options;
  options.paths = {file(good, "length = 8\n# events = ruptures\n# completeness = 0.003"),
                   file(good, "length = 8\n# events = place"), file(good, "length = 8")};
  const std::vector<EventTable> tables = load_catalogues(options);
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(tables[0].kind(), "ruptures");
  EXPECT_EQ(tables[1].kind(), "place");
  EXPECT_EQ(tables[2].kind(), "pe");
  EXPECT_EQ(tables[0].completeness, 0.003);
  EXPECT_EQ(tables[1].completeness, 0.0);
}

TEST_F(CatalogueInput, CompletenessHasToBeASize) {
  for (const std::string bad : {"small", "-1", "nan", "inf", "1e-4 (measured)"}) {
    const std::string name = file(good, "completeness = " + bad);
    expect_error<FileError>(
        [&] { load_catalogue(name, {}); },
        name + ":3: completeness is '" + bad + "', expected a finite size of at least 0");
    const EventTable table = load_catalogue(name, lenient());
    EXPECT_EQ(table.completeness, 0.0);
    EXPECT_EQ(table.skipped_lines, 1);
    LSM::CatalogueInfo info;
    info.model = "lsm";
    info.parameters = {{"completeness", bad}};
    EXPECT_THROW(LSM::CatalogueWriter().create(path("out.csv"), info), std::invalid_argument);
  }
}

TEST_F(CatalogueInput, LengthAndLabelsFromTheHeader) {
  CatalogueOptions options;
  options.paths = {file(good), file(good, "blocks = 256", "block-slider"), file(good, "seed = 1"),
                   file(good)};
  std::vector<EventTable> tables = load_catalogues(options);
  EXPECT_EQ(tables[0].length(), 120.0);
  EXPECT_EQ(tables[1].length(), 256.0);
  EXPECT_TRUE(std::isnan(tables[2].length()));
  EXPECT_EQ(tables[0].label, "fault, length 120 (c1)");
  EXPECT_EQ(tables[1].label, "block-slider, N = 256");
  EXPECT_EQ(tables[2].label, "c3");
  EXPECT_EQ(tables[3].label, "fault, length 120 (c4)");

  options.labels = {"a", "b", "c", "d"};
  EXPECT_EQ(load_catalogues(options)[3].label, "d");
  options.labels.pop_back();
  expect_error<std::invalid_argument>([&] { load_catalogues(options); },
                                      "--label given 3 times, expected once per catalogue (4)");
  options.labels.clear();
  options.from_time = options.to_time = 1.0;
  EXPECT_THROW(load_catalogues(options), std::invalid_argument);
}

TEST_F(CatalogueInput, BadLinesAreErrorsOrCountedByKind) {
  const std::string rows =
      "1,1,2,10,20,0.5,1,0.5\n"
      "2,3,nan,30,40,0.5,1,0.5\n"  // line 6: number
      "3,3,4,30,40,0.5,1\n"        // columns
      "4,0.5,4,30,40,0.5,1,0.5\n"  // order: starts within the first
      "5,3,4,30,40,x,1,0.5\n"      // number
      "6,3,4,30,40,0.25,1,0.75\n"
      "6,5,6,50,60,0.25,1,0.75\n"  // order: identifier again
      "7,7,8,70,80,0.25,1,0.7";    // truncated
  const std::string name = file(rows);
  expect_error<FileError>([&] { load_catalogue(name, CatalogueOptions()); },
                          name + ":6: column 't_end' is 'nan', expected a finite number");
  const EventTable table = load_catalogue(name, lenient());
  EXPECT_EQ(sizes(table), (std::vector<double>{0.5, 0.25}));
  EXPECT_EQ(table.skipped_lines, 6);
  ASSERT_EQ(table.repairs.size(), 5u);
  EXPECT_EQ(table.repairs[0], name + ": passed over a truncated last line: 1");
  EXPECT_EQ(table.repairs[1], name + ": passed over lines with too few or too many columns: 1");
  EXPECT_EQ(table.repairs[2],
            name + ": passed over lines with something else than finite numbers: 2");
  EXPECT_EQ(table.repairs[3], name + ": passed over events out of order: 2");
  EXPECT_TRUE(contains(table.repairs[4], name + ":6: "));
  EXPECT_TRUE(load_catalogue(file(good), lenient()).repairs.empty());
}

}  // namespace
