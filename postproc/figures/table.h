// SPDX-License-Identifier: GPL-2.0-or-later
/// \file table.h
/// A table that is filled once and written as CSV and JSON for programs, as text and HTML for
/// people.
#ifndef LSM_POSTPROC_TABLE_H
#define LSM_POSTPROC_TABLE_H

#include <cstdint>
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

/// A column as people see it.
struct Shown {
  std::string heading, column;
  int digits = 4;                         ///< significant ones, of numbers without an error
  std::string error = column + "_error";  ///< column of its standard errors, if there is one
};

/// Numbers and texts in named columns.
class Table {
 public:
  /// Columns whose names begin with '!' are for people only.
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}
  explicit Table(std::string_view columns);  ///< names separated by commas

  /// Chooses what people see of it, in which order. Without that nothing is printed, and a page has
  /// all columns.
  void show(std::vector<Shown> columns) { shown_ = std::move(columns); }
  void comment(std::string_view text);  ///< a line above the table
  void comment(const std::vector<std::string> &lines) {
    for (const std::string &line : lines) comment(line);
  }
  Table &add(double value) { return put(value); }
  Table &add(std::int64_t value) { return put(value); }
  Table &add(std::string_view text) { return put(valid_utf8(text)); }
  Table &add(const Measured &number) { return put(number.value).put(number.error); }
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

 private:
  using Cell = std::variant<double, std::int64_t, std::string>;

  template <class Content>
  Table &put(Content &&cell) {
    cells_.emplace_back(std::forward<Content>(cell));
    return *this;
  }
  /// The line of column names of the CSV.
  std::string column_line() const;
  bool for_people(std::size_t column) const { return columns_[column][0] == '!'; }
  /// What people see, column by column, each with its heading first; but for the first one, those
  /// that were chosen and hold nothing are left out.
  std::vector<std::vector<std::string>> shown_columns(std::string_view plus_minus) const;

  std::vector<std::string> comments_, columns_;
  std::vector<Shown> shown_;
  std::vector<Cell> cells_;  ///< row by row
  std::int64_t rows_ = 0;
};

/// Text with the characters that HTML reserves replaced.
std::string html_escape(std::string_view text);

}  // namespace LSM::postproc

#endif
