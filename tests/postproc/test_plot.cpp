// SPDX-License-Identifier: GPL-2.0-or-later
// Tables, scripts and pictures: labels and file names with special characters, and behaviour
// without gnuplot.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "event_tables.h"
#include "new_file.h"
#include "numbers.h"
#include "options.h"
#include "plot.h"
#include "unit_files.h"

using namespace LSM::postproc;
using unit::contains;
using unit::message_of;
using unit::slurp;

namespace {

class Plot : public unit::Files {
 protected:
  /// A picture of two points with the given title in its key.
  Figure figure(const std::string &title) const {
    Figure result{Table("x,y"), {}, {400, 300}};
    result.table.add(1.0).add(2.0).end_row();
    result.table.add(10.0).add(200.0).end_row();
    result.script = axis("x", "x", true, 1.0, 10.0) + axis("y", "y", true, 2.0, 200.0) +
                    "plot table using 1:2 with linespoints lt 1 title " + quote(title) + "\n";
    return result;
  }
  PictureOptions output(const std::string &name) const {
    PictureOptions options;
    options.output = path(name);
    return options;
  }
};

/// Sets PATH to a folder without programs for the lifetime of the object.
class EmptyPath {
 public:
  EmptyPath() : before_(std::getenv("PATH")) { setenv("PATH", "/nonexistent", 1); }
  ~EmptyPath() { setenv("PATH", before_.c_str(), 1); }
  EmptyPath(const EmptyPath &) = delete;
  EmptyPath &operator=(const EmptyPath &) = delete;

 private:
  std::string before_;
};

TEST(Table, RowsOfAnyCells) {
  Table table("name,whole,flag,number");
  table.add("a, b");
  table.row(std::size_t{3}, true, 0.125);
  table.row("c", -1, false, std::nan(""));
  EXPECT_EQ(table.csv(), "name,whole,flag,number\n\"a, b\",3,1,0.125\nc,-1,0,\n");
  EXPECT_EQ(table.text(), "");
  EXPECT_THROW(table.row("too few"), std::logic_error);
}

TEST(Table, ThreeRenderersOfOneTable) {
  struct Line {
    std::string label;
    Measured b;
    const char *why, *from;
  };
  TableOf<Line> table;
  table.column("label", "catalogue", &Line::label);
  table.show("from", &Line::from);
  table.column("b", "slope γ", &Line::b);
  table.show("nothing", [](auto &) { return ""; });
  table.column("why", "degenerate", &Line::why);
  table.data("empty", [](auto &) { return ""; });
  table.comment("b: Aki");
  table.row({"one <1>", {1.25, 0.024}, "", "M 2"});
  table.row({"one <1>", {0.5, std::nan("")}, "too few, \"all\" equal", "M 3"});
  EXPECT_EQ(table.csv(),
            "# b: Aki\nlabel,b,b_error,why,empty\none <1>,1.25,0.024,,\n"
            "one <1>,0.5,,\"too few, \"\"all\"\" equal\",\n");
  EXPECT_EQ(table.json().dump(),
            "[{\"label\":\"one <1>\",\"b\":1.25,\"b_error\":0.024,\"why\":\"\",\"empty\":\"\"},"
            "{\"label\":\"one <1>\",\"b\":0.5,\"b_error\":null,"
            "\"why\":\"too few, \\\"all\\\" equal\",\"empty\":\"\"}]");
  EXPECT_EQ(table.text(),
            "b: Aki\n"
            "  catalogue  from  slope γ         degenerate\n"
            "  one <1>    M 2   1.250 +- 0.024\n"
            "             M 3   0.5             too few, \"all\" equal\n");
}

// Tables of many columns and few rows are printed transposed, which is easier to read.
TEST(Table, WideTextIsTurnedOnItsSide) {
  Columns columns;
  for (int k = 0; k < 30; ++k) {
    const std::string name = "column_" + std::to_string(k);
    columns.push_back({name, name});
  }
  Table table(columns);
  for (int k = 0; k < 30; ++k) table.add(k);
  table.end_row();
  EXPECT_EQ(table.text().find("  column_0   0\n  column_1   1\n"), 0U);
}

TEST_F(Plot, FolderNameMayHoldQuotesAndBlanks) {
  const PictureOptions options = output("new folder/a 'b' \"c\" {d}_`e`");
  make(figure("t"), options);
  for (const char *extension : {".csv", ".gp", ".png", ".svg"})
    EXPECT_TRUE(std::filesystem::exists(options.output + extension)) << extension;
  EXPECT_EQ(slurp(options.output + ".png").substr(1, 3), "PNG");
  EXPECT_TRUE(contains(slurp(options.output + ".svg"), "</svg>"));
}

TEST_F(Plot, ScriptDrawsAgainWhereItIs) {
  const PictureOptions options = output("again");
  make(figure("t"), options);
  std::filesystem::create_directory(path("elsewhere"));
  for (const char *extension : {".csv", ".gp"})
    std::filesystem::rename(options.output + extension, path("elsewhere/again") + extension);
  const std::string command = "cd '" + path("elsewhere") + "' && gnuplot again.gp";
  ASSERT_EQ(std::system(command.c_str()), 0);
  // Without the title, in which gnuplot names itself.
  const auto drawing = [](const std::string &svg) { return svg.substr(svg.find("<desc>")); };
  EXPECT_EQ(drawing(slurp(path("elsewhere/again.svg"))), drawing(slurp(options.output + ".svg")));
}

TEST_F(Plot, WithoutGnuplotTableAndScriptAreThere) {
  const EmptyPath nothing;
  const PictureOptions options = output("none");
  const Figure picture = figure("t");
  const std::string message = message_of<PlotError>([&] { make(picture, options); });
  EXPECT_TRUE(contains(message, "none.gp: gnuplot not found"));
  EXPECT_TRUE(contains(message, "table and script are written"));
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(options.output + ".gp"));
  EXPECT_TRUE(std::filesystem::exists(options.output + ".csv"));
  EXPECT_FALSE(std::filesystem::exists(options.output + ".png"));
}

TEST_F(Plot, FailureIsReportedAndLeavesNoPicture) {
  const PictureOptions options = output("bad");
  Figure picture = figure("t");
  picture.script = "plot 'no-such-file.csv' using 1:2\n";
  const std::string message = message_of<PlotError>([&] { make(picture, options); });
  EXPECT_TRUE(contains(message, "bad.gp: gnuplot failed"));
  EXPECT_TRUE(contains(message, "no-such-file.csv"));
  EXPECT_FALSE(std::filesystem::exists(options.output + ".png"));
  EXPECT_FALSE(std::filesystem::exists(options.output + ".svg"));
}

TEST_F(Plot, TableDoesNotDependOnTheLocale) {
  const unit::CommaLocale comma;
  Table table("value");
  table.add(1234.5).end_row();
  EXPECT_EQ(table.csv(), "value\n1234.5\n");
  EXPECT_EQ(with_error(1234.5, 0.25), "1234.50 +- 0.25");
  EXPECT_TRUE(
      contains(axis("x", "x", true, 0.5, 2000.0), "set xrange [0.10000000000000001:10000]"));
}

TEST_F(Plot, AxisOfPowersOfTen) {
  EXPECT_TRUE(contains(axis("x", "x", true, 1e-4, 1e3), "[0.0001"));
  EXPECT_TRUE(contains(axis("x", "x", true, 1e-4, 1e3), ":1000]"));
  // A range too short for powers of ten ends at multiples of 1, 2 or 5.
  const std::string brief = axis("y", "y", true, 1100.0, 1900.0);
  EXPECT_TRUE(contains(brief, "set yrange [1000:2000]"));
  EXPECT_TRUE(contains(
      brief,
      "(\"1000\" 1000, \"1200\" 1200, \"1400\" 1400, \"1600\" 1600, \"1800\" 1800, \"2000\" 2000)"));
  EXPECT_TRUE(contains(axis("y", "y", true, 0.28, 0.46),
                       "(\"0.2\" 0.2, \"0.3\" 0.3, \"0.4\" 0.4, \"0.5\" 0.5)"));
  EXPECT_TRUE(contains(axis("y", "y", true, 11.0, 190.0),
                       "(\"10\" 10, \"20\" 20, \"50\" 50, \"100\" 100, \"200\" 200)"));
}

TEST_F(Plot, NumbersWithErrors) {
  EXPECT_EQ(with_error(1.0734, 0.0241), "1.073 +- 0.024");
  EXPECT_EQ(with_error(-0.126, 0.091, " ± "), "-0.126 ± 0.091");
  EXPECT_EQ(with_error(3990.2, 3037.0), "3990 +- 3037");
  EXPECT_EQ(with_error(3.14e-5, 2.2e-6), "(3.14 +- 0.22)e-05");
  EXPECT_EQ(with_error(2.0, 0.0), "2");
  EXPECT_EQ(with_error(std::nan(""), 1.0), "-");
}

TEST_F(Plot, Ranges) {
  const Range range = parse_range("--range", "1e-3:2");
  EXPECT_EQ(range.lo, 1e-3);
  EXPECT_EQ(range.hi, 2.0);
  EXPECT_TRUE(std::isinf(parse_range("--range", "1:").hi));
  for (const char *bad : {"", "1", "2:1", "1:1", "a:2", "1:2:3", "nan:1"})
    EXPECT_TRUE(contains(message_of<std::invalid_argument>([bad] { parse_range("--range", bad); }),
                         "expected LO:HI"))
        << bad;
}

}  // namespace
