// SPDX-License-Identifier: GPL-2.0-or-later
/// \file table.h
/// A table that is filled once and written as CSV and JSON for programs, and as text for people.
#ifndef LSM_POSTPROC_TABLE_H
#define LSM_POSTPROC_TABLE_H

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "log_histogram.h"
#include "samples.h"

namespace LSM::postproc {

/// Replaces whatever is not valid UTF-8 by U+FFFD, as labels and file names may be anything.
std::string valid_utf8(std::string_view text);

using Cell = std::variant<double, std::int64_t, std::string, Measured>;

struct Column {
  std::string name;                    ///< for programs; empty: a column for people only
  std::optional<std::string> heading;  ///< for people; none: a column for programs only
  int digits = 4;         ///< significant digits of numbers without an error, for people
  bool measured = false;  ///< has errors: a column for people, NAME and NAME_error for programs
};
using Columns = std::vector<Column>;

/// Numbers and texts in columns, added row by row.
class Table {
 public:
  /// A table of columns for programs only. It is not printed.
  explicit Table(const std::vector<std::string> &names);
  explicit Table(std::string_view names);  ///< separated by commas
  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  void comment(std::string_view text);  ///< adds a line above the table
  void comment(const std::vector<std::string> &lines) {
    for (const std::string &line : lines) comment(line);
  }
  Table &add(double value) { return put(value); }
  Table &add(std::int64_t value) { return put(value); }
  Table &add(std::string_view text) { return put(valid_utf8(text)); }
  /// Fills the next cell if its column is `measured`, otherwise two cells: the number and its
  /// error.
  Table &add(const Measured &number);
  /// Fills the six columns bin_lo, bin_hi, centre, count, density and error.
  Table &add(const LogBin &bin) {
    return put(bin.lo).put(bin.hi).put(bin.centre).put(bin.count).put(bin.density).put(bin.error);
  }
  template <class Integer, std::enable_if_t<std::is_integral_v<Integer>, int> = 0>
  Table &add(Integer value) {
    return add(static_cast<std::int64_t>(value));
  }
  /// Ends the row.
  /// \throws std::logic_error unless it has one cell per column
  void end_row();
  /// Adds the remaining cells of a row, or all of them, and ends it.
  template <class... Cells>
  void row(const Cells &...cells) {
    (add(cells), ...);
    end_row();
  }
  std::int64_t rows() const { return rows_; }

  /// Comments that begin with '#', the column names, and the rows. Text is quoted where necessary,
  /// numbers have all their digits, and NaN is an empty field. An apostrophe protects text that a
  /// spreadsheet would take for a formula.
  std::string csv() const;
  /// Whether a CSV file that begins with `head` has the same columns as this table.
  bool like(std::string_view head) const;
  nlohmann::ordered_json json() const;  ///< an object per row, NaN as null; no comments
  /// Text for a terminal: comments, and aligned columns without those that are empty. The leading
  /// cells of a row that repeat the row above are blank. A few wide rows are printed as columns.
  std::string text() const;
  /// Writes the CSV by write_file().
  /// \throws FileError
  void write(const std::string &path) const;

 protected:
  template <class Content>
  Table &put(Content &&cell) {
    cells_.emplace_back(std::forward<Content>(cell));
    return *this;
  }
  std::vector<Column> columns_;

 private:
  /// The line of column names of the CSV.
  std::string column_line() const;
  /// Whether any column has a heading for people.
  bool for_people() const;
  /// The columns that people see, each beginning with its heading. Columns without content are left
  /// out, except the first one.
  std::vector<std::vector<std::string>> shown_columns() const;

  std::vector<std::string> comments_;
  std::vector<Cell> cells_;  ///< row by row
  std::int64_t rows_ = 0;
};

/// A table with a row per object of type Thing. Each column has a function or member that makes its
/// cells from an object. Columns are in the order in which they are declared.
template <class Thing>
class TableOf : public Table {
 public:
  TableOf() : Table(std::vector<std::string>()) {}

  /// Declares a column for people and programs.
  template <class Make>
  void column(std::string name, std::string heading, const Make &make, int digits = 4) {
    declare({std::move(name), std::move(heading), digits}, make);
  }
  /// Declares a column for programs only.
  template <class Make>
  void data(std::string name, const Make &make) {
    declare({std::move(name), {}}, make);
  }
  /// Declares a column for people only.
  template <class Make>
  void show(std::string heading, const Make &make, int digits = 4) {
    declare({{}, std::move(heading), digits}, make);
  }
  void row(const Thing &thing) {
    for (const auto &add_cell : add_cells_) add_cell(*this, thing);
    end_row();
  }

 private:
  template <class Make>
  void declare(Column column, const Make &make) {
    using Made = std::decay_t<std::invoke_result_t<Make, const Thing &>>;
    column.measured = std::is_same_v<Made, Measured>;
    columns_.push_back(std::move(column));
    add_cells_.push_back(
        [make](TableOf &table, const Thing &thing) { table.add(std::invoke(make, thing)); });
  }
  std::vector<std::function<void(TableOf &, const Thing &)>> add_cells_;
};

/// Replaces the characters that HTML reserves by entities, and what is not valid UTF-8 by U+FFFD.
std::string html_escape(std::string_view text);

}  // namespace LSM::postproc

#endif
