// SPDX-License-Identifier: GPL-2.0-or-later
/// \file table.h
/// A table that is filled once and written as CSV and JSON for programs, as text and HTML for
/// people.
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

/// Text with what is no UTF-8 in it replaced by U+FFFD: labels and names of files may be anything.
std::string valid_utf8(std::string_view text);

using Cell = std::variant<double, std::int64_t, std::string, Measured>;

struct Column {
  std::string name;                    ///< for programs; empty: only for people
  std::optional<std::string> heading;  ///< for people; none: only for programs
  int digits = 4;                      ///< significant ones for people, of numbers without an error
  bool measured = false;               ///< one column for people, NAME and NAME_error for programs
};
using Columns = std::vector<Column>;

/// Numbers and texts in columns.
class Table {
 public:
  /// Columns for programs. Nothing of them is printed, and a page has them as they are.
  explicit Table(const std::vector<std::string> &names);
  explicit Table(std::string_view names);  ///< separated by commas
  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  void comment(std::string_view text);  ///< a line above the table
  void comment(const std::vector<std::string> &lines) {
    for (const std::string &line : lines) comment(line);
  }
  Table &add(double value) { return put(value); }
  Table &add(std::int64_t value) { return put(value); }
  Table &add(std::string_view text) { return put(valid_utf8(text)); }
  /// One cell of a column of measured numbers, else the columns of the number and of its error.
  Table &add(const Measured &number);
  /// The columns bin_lo, bin_hi, centre, count, density and error.
  Table &add(const LogBin &bin) {
    return put(bin.lo).put(bin.hi).put(bin.centre).put(bin.count).put(bin.density).put(bin.error);
  }
  template <class Integer, std::enable_if_t<std::is_integral_v<Integer>, int> = 0>
  Table &add(Integer value) {
    return add(static_cast<std::int64_t>(value));
  }
  /// Ends the row. \throws std::logic_error unless it has one field per column.
  void end_row();
  /// The rest of a row, or a complete one.
  template <class... Cells>
  void row(const Cells &...cells) {
    (add(cells), ...);
    end_row();
  }
  std::int64_t rows() const { return rows_; }

  /// Comments that begin with '#', column names, rows. Text is quoted where it has to be; numbers
  /// have all their digits; NaN is an empty field. An apostrophe stands before a text that a
  /// spreadsheet would take for a formula.
  std::string csv() const;
  /// Whether a CSV that begins so has the same columns.
  bool like(std::string_view head) const;
  nlohmann::ordered_json json() const;  ///< an object per row; NaN is null; without the comments
  /// For a terminal: comments and aligned columns, those without any content left out. A cell that
  /// repeats the row above, as all before it do, is blank. Few wide rows are turned on their side.
  std::string text() const;
  std::string html() const;  ///< the same as an element of a page, without the comments
  /// The CSV, see write_file(). \throws FileError
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
  /// Whether columns were chosen for people.
  bool for_people() const;
  /// What people see, column by column, each with its heading first; but for the first one, those
  /// that were chosen and hold nothing are left out.
  std::vector<std::vector<std::string>> shown_columns(std::string_view plus_minus) const;

  std::vector<std::string> comments_;
  std::vector<Cell> cells_;  ///< row by row
  std::int64_t rows_ = 0;
};

/// A table of what is known of things: each column says how its cells are made of a thing, by a
/// function or a member. Columns stand in the order in which they are declared.
template <class Thing>
class TableOf : public Table {
 public:
  TableOf() : Table(std::vector<std::string>()) {}

  template <class Make>
  void column(std::string name, std::string heading, const Make &make, int digits = 4,
              bool measured = false) {
    declare({std::move(name), std::move(heading), digits, measured}, make);
  }
  /// A column for programs only.
  template <class Make>
  void data(std::string name, const Make &make) {
    declare({std::move(name), {}}, make);
  }
  /// A column for people only.
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
    column.measured = column.measured || std::is_same_v<Made, Measured>;
    columns_.push_back(std::move(column));
    add_cells_.push_back([make](TableOf &table, const Thing &thing) {
      if constexpr (std::is_same_v<Made, Cell>)
        table.put(std::invoke(make, thing));
      else
        table.add(std::invoke(make, thing));
    });
  }
  std::vector<std::function<void(TableOf &, const Thing &)>> add_cells_;
};

/// Text with the characters that HTML reserves replaced.
std::string html_escape(std::string_view text);

}  // namespace LSM::postproc

#endif
