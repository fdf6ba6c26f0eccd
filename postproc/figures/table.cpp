// SPDX-License-Identifier: GPL-2.0-or-later
#include "table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "lsm_text_io.h"
#include "new_file.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::vector<std::string> names_in(std::string_view text) {
  std::vector<std::string_view> names;
  text_io::split(text, names);
  return {names.begin(), names.end()};
}

std::string csv_field(double value) {
  return std::isnan(value) ? std::string() : text_io::number(value);
}

std::string csv_field(std::int64_t value) { return text_io::number(value); }

std::string csv_field(const std::string &text) {
  if (text.find_first_of(",\"#\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quoted + '"';
}

std::string plain(const std::variant<double, std::int64_t, std::string> &cell) {
  const auto *const text = std::get_if<std::string>(&cell);
  return text ? *text : text_io::number(std::get<std::int64_t>(cell));
}

bool has_content(const Rows &rows, std::size_t column) {
  return std::any_of(rows.begin() + 1, rows.end(), [column](const auto &row) {
    return !row[column].empty() && row[column] != "-";
  });
}

/// The rows with only those columns in which something stands.
Rows without_empty_columns(const Rows &rows) {
  Rows out(rows.size());
  for (std::size_t k = 0; k < rows.front().size(); ++k)
    if (has_content(rows, k))
      for (std::size_t i = 0; i < rows.size(); ++i) out[i].push_back(rows[i][k]);
  return out;
}

/// Characters as they are shown, each in one column of a terminal.
std::size_t width_of(const std::string &text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & '\xc0') != '\x80'; }));
}

std::vector<std::size_t> widths_of(const Rows &rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto &row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width_of(row[k]));
  return widths;
}

std::size_t sum_of(const std::vector<std::size_t> &widths) {
  std::size_t sum = 0;
  for (const std::size_t width : widths) sum += width + 2;
  return sum;
}

Rows turned(const Rows &rows) {
  Rows out(rows.front().size());
  for (const auto &row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) out[k].push_back(row[k]);
  return out;
}

void blank_repeated(Rows &rows) {
  for (std::size_t i = rows.size() - 1; i > 1; --i)
    for (std::size_t k = 0; k < rows[i].size() && rows[i][k] == rows[i - 1][k]; ++k)
      rows[i][k].clear();
}

}  // namespace

Table::Table(const std::vector<std::string> &columns) {
  for (const std::string &column : columns) {
    for_people_.push_back(column.substr(0, 1) == "!");
    columns_.push_back(column.substr(for_people_.back() ? 1 : 0));
  }
}

Table::Table(std::string_view columns) : Table(names_in(columns)) {}

void Table::show(std::vector<Shown> columns) { shown_ = std::move(columns); }

void Table::comment(std::string_view text) {
  comments_.emplace_back(text);
  for (char &c : comments_.back())
    if (c == '\n' || c == '\r') c = ' ';
}

void Table::end_row() {
  const std::size_t fields = cells_.size() - static_cast<std::size_t>(rows_) * columns_.size();
  if (fields != columns_.size())
    throw std::logic_error(
        fmt::format("table: a row has {} fields, expected {}", fields, columns_.size()));
  ++rows_;
}

std::string Table::csv() const {
  std::string out;
  for (const std::string &comment : comments_) out += "# " + comment + '\n';
  std::string separator;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    if (for_people_[k]) continue;
    out += separator + columns_[k];
    separator = ",";
  }
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    if (k % columns_.size() == 0) separator = "\n";
    if (for_people_[k % columns_.size()]) continue;
    out += separator;
    out += std::visit([](const auto &value) { return csv_field(value); }, cells_[k]);
    separator = ",";
  }
  return out + '\n';
}

nlohmann::ordered_json Table::json() const {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    const std::size_t column = k % columns_.size();
    if (column == 0) rows.push_back(nlohmann::ordered_json::object());
    if (for_people_[column]) continue;
    std::visit([&](const auto &value) { rows.back()[columns_[column]] = value; }, cells_[k]);
  }
  return rows;
}

std::vector<std::vector<std::string>> Table::shown_cells(std::string_view plus_minus) const {
  const auto place_of = [this](const std::string &name) {
    return static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), name) -
                                    columns_.begin());
  };
  Rows rows(static_cast<std::size_t>(rows_) + 1);
  std::vector<Shown> all;
  for (const std::string &column : columns_) all.push_back({column, column, 4, ""});
  for (const Shown &shown : shown_.empty() ? all : shown_) {
    rows[0].push_back(shown.heading);
    const std::size_t place = place_of(shown.column), error = place_of(shown.error);
    if (place == columns_.size()) throw std::logic_error("table: no column " + shown.column);
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const Cell *const cells = &cells_[(i - 1) * columns_.size()];
      const double *const number = std::get_if<double>(cells + place);
      const double *const scatter =
          error < columns_.size() ? std::get_if<double>(cells + error) : nullptr;
      rows[i].push_back(!number                     ? plain(cells[place])
                        : scatter && *scatter > 0.0 ? with_error(*number, *scatter, plus_minus)
                                                    : short_number(*number, shown.digits));
    }
  }
  return rows;
}

std::string Table::text() const {
  if (rows_ == 0 || shown_.empty()) return {};
  std::string out;
  for (const std::string &comment : comments_) out += comment + '\n';
  constexpr std::size_t most = 160;
  Rows rows = without_empty_columns(shown_cells(" +- "));
  std::vector<std::size_t> widths = widths_of(rows);
  if (const Rows other = turned(rows); sum_of(widths) > most &&
                                       widths.size() > 6 * static_cast<std::size_t>(rows_) &&
                                       sum_of(widths_of(other)) < most) {
    rows = other;
    widths = widths_of(rows);
  } else {
    blank_repeated(rows);
  }
  for (const auto &row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      line += "  " + row[k];
      line.append(widths[k] - width_of(row[k]), ' ');
    }
    out += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return out;
}

std::string Table::html() const {
  Rows rows = shown_cells(" ± ");
  if (!shown_.empty()) rows = without_empty_columns(rows);
  std::string out = "<div class=\"wide\"><table>\n<thead><tr>";
  for (const std::string &head : rows[0]) out += "<th>" + html_escape(head) + "</th>";
  out += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 1; i < rows.size(); ++i) {
    out += "<tr><th scope=\"row\">" + html_escape(rows[i][0]) + "</th>";
    for (std::size_t k = 1; k < rows[i].size(); ++k)
      // Sentences may wrap, numbers not.
      out += fmt::format("<td{}>{}</td>", rows[i][k].size() > 32 ? " class=\"text\"" : "",
                         html_escape(rows[i][k]));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

void Table::write(const std::string &path) const { write_file(path, csv()); }

void add_bin(Table &table, const LogBin &bin) {
  table.add(bin.lo).add(bin.hi).add(bin.centre).add(bin.count).add(bin.density).add(bin.error);
}

std::string html_escape(std::string_view text) {
  constexpr std::string_view reserved = "&<>\"'";
  constexpr const char *entities[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
  std::string out;
  for (const char c : text) {
    const std::size_t which = reserved.find(c);
    which == std::string_view::npos ? out += c : out += entities[which];
  }
  return out;
}

}  // namespace LSM::postproc
