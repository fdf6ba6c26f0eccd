// SPDX-License-Identifier: GPL-2.0-or-later
#include "table.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "files/text.h"
#include "new_file.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string csv_field(double value) {
  return std::isnan(value) ? std::string() : text::number(value);
}

std::string csv_field(std::int64_t value) { return text::number(value); }

std::string csv_field(const std::string &text) {
  double number = 0.0;
  const bool formula =
      !text.empty() && std::string_view("=+-@\t\r").find(text[0]) < 6 && !text::parse(text, number);
  const std::string guard = formula ? "'" : "";
  if (text.find_first_of(",\"#\n\r") == std::string::npos) return guard + text;
  std::string quoted = "\"" + guard;
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quoted + '"';
}

std::string csv_field(const Measured &number) { return csv_field(number.value); }

/// Number of characters of UTF-8 text, each of which takes one column of a terminal.
std::size_t width_of(const std::string &text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & '\xc0') != '\x80'; }));
}

/// Lines of equal width, in which the cells of a column are aligned.
std::vector<std::string> aligned(const Rows &rows) {
  std::vector<std::string> lines(rows.size());
  for (std::size_t k = 0; k < rows.front().size(); ++k) {
    std::size_t width = 0;
    for (const auto &row : rows) width = std::max(width, width_of(row[k]));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      lines[i] += "  " + rows[i][k];
      lines[i].append(width - width_of(rows[i][k]), ' ');
    }
  }
  return lines;
}

/// Wraps a sentence into lines of at most `most` characters, as far as its words allow.
std::string wrapped(const std::string &text, std::size_t most) {
  std::string out, line, word;
  for (std::istringstream words(text); words >> word;) {
    if (!line.empty() && width_of(line) + 1 + width_of(word) > most) {
      out += line + '\n';
      line = "  " + word;
    } else {
      line += (line.empty() ? "" : " ") + word;
    }
  }
  return out + line + '\n';
}

/// Replaces sentences, which would make the table wide, by numbers.
/// \return the sentences in the order of their numbers
std::vector<std::string> take_notes(Rows &columns) {
  constexpr std::size_t longest = 32;
  std::vector<std::string> notes;
  for (std::size_t k = 1; k < columns.size(); ++k)
    for (std::size_t i = 1; i < columns[k].size(); ++i) {
      std::string &cell = columns[k][i];
      if (width_of(cell) <= longest) continue;
      const auto place = std::find(notes.begin(), notes.end(), cell) - notes.begin();
      if (place == static_cast<std::ptrdiff_t>(notes.size())) notes.push_back(cell);
      cell = fmt::format("[{}]", place + 1);
    }
  return notes;
}

Rows turned(const Rows &columns) {
  Rows rows(columns.front().size());
  for (const auto &column : columns)
    for (std::size_t i = 0; i < column.size(); ++i) rows[i].push_back(column[i]);
  return rows;
}

void blank_repeated(Rows &rows) {
  for (std::size_t i = rows.size() - 1; i > 1; --i)
    for (std::size_t k = 0; k < rows[i].size() && rows[i][k] == rows[i - 1][k]; ++k)
      rows[i][k].clear();
}

/// Whether the first of several columns names what the rows are about: it has no heading, or many
/// of its cells were blanked as repetitions.
bool is_heading(const Rows &rows) {
  const auto blank =
      std::count_if(rows.begin() + 1, rows.end(), [](const auto &row) { return row[0].empty(); });
  return rows[0].size() > 2 &&
         (rows[0][0].empty() || 3 * static_cast<std::size_t>(blank) >= rows.size());
}

/// Moves the first column of a table that is too wide to lines above the rows.
void take_headings(Rows &rows, std::vector<std::string> &headings) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::string &first = rows[i][0];
    if (!first.empty()) headings[i] += (headings[i].empty() ? "" : ", ") + first;
    rows[i].erase(rows[i].begin());
  }
}

}  // namespace

Table::Table(const std::vector<std::string> &names) {
  for (const std::string &name : names) columns_.push_back({name, {}});
}

Table::Table(std::string_view names) {
  std::vector<std::string_view> fields;
  text::split(names, fields);
  for (const std::string_view name : fields) columns_.push_back({std::string(name), {}});
}

Table &Table::add(const Measured &number) {
  if (columns_[cells_.size() % columns_.size()].measured) return put(number);
  return put(number.value).put(number.error);
}

void Table::comment(std::string_view text) {
  comments_.push_back(valid_utf8(text));
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

std::string Table::column_line() const {
  std::string out;
  for (const Column &column : columns_) {
    if (column.name.empty()) continue;
    out += (out.empty() ? "" : ",") + csv_field(column.name);
    if (column.measured) out += "," + csv_field(column.name + "_error");
  }
  return out;
}

bool Table::like(std::string_view head) const {
  while (!head.empty() && head.front() == '#') {
    const std::size_t end = head.find('\n');
    if (end == std::string_view::npos) return false;
    head.remove_prefix(end + 1);
  }
  return begins_with(column_line() + '\n')(head);
}

std::string Table::csv() const {
  std::string out;
  for (const std::string &comment : comments_) out += "# " + comment + '\n';
  out += column_line();
  std::string separator;
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    if (k % columns_.size() == 0) separator = "\n";
    if (columns_[k % columns_.size()].name.empty()) continue;
    out += separator;
    out += std::visit([](const auto &value) { return csv_field(value); }, cells_[k]);
    if (const auto *number = std::get_if<Measured>(&cells_[k]))
      out += ',' + csv_field(number->error);
    else if (columns_[k % columns_.size()].measured)
      out += ',';
    separator = ",";
  }
  return out + '\n';
}

nlohmann::ordered_json Table::json() const {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    if (k % columns_.size() == 0) rows.push_back(nlohmann::ordered_json::object());
    const std::string &name = columns_[k % columns_.size()].name;
    if (name.empty()) continue;
    nlohmann::ordered_json &row = rows.back();
    const auto *const measured = std::get_if<Measured>(&cells_[k]);
    if (measured)
      row[name] = measured->value;
    else if (const auto *text = std::get_if<std::string>(&cells_[k]))
      row[name] = *text;
    else if (const auto *count = std::get_if<std::int64_t>(&cells_[k]))
      row[name] = *count;
    else
      row[name] = std::get<double>(cells_[k]);
    if (columns_[k % columns_.size()].measured)
      row[name + "_error"] = measured ? measured->error : NAN;
  }
  return rows;
}

bool Table::for_people() const {
  return std::any_of(columns_.begin(), columns_.end(),
                     [](const Column &column) { return column.heading.has_value(); });
}

std::vector<std::vector<std::string>> Table::shown_columns() const {
  std::vector<std::vector<std::string>> out;
  for (std::size_t place = 0; place < columns_.size(); ++place) {
    const Column &shown = columns_[place];
    if (!shown.heading) continue;
    std::vector<std::string> column = {*shown.heading};
    bool content = out.empty();
    for (std::size_t k = place; k < cells_.size(); k += columns_.size()) {
      if (const auto *text = std::get_if<std::string>(&cells_[k]))
        column.push_back(*text);
      else if (const auto *count = std::get_if<std::int64_t>(&cells_[k]))
        column.push_back(text::number(*count));
      else if (const auto *number = std::get_if<double>(&cells_[k]))
        column.push_back(short_number(*number, shown.digits));
      else {
        const auto &[value, error] = std::get<Measured>(cells_[k]);
        column.push_back(error > 0.0 ? with_error(value, error)
                                     : short_number(value, shown.digits));
      }
      content = content || !(column.back().empty() || column.back() == "-");
    }
    if (content) out.push_back(std::move(column));
  }
  return out;
}

std::string Table::text() const {
  if (rows_ == 0 || !for_people()) return {};
  std::string out;
  constexpr std::size_t most = 160, of_text = 100;
  for (const std::string &comment : comments_) out += wrapped(comment, of_text);
  Rows columns = shown_columns();
  const Rows whole = turned(columns);
  std::vector<std::string> notes;
  const auto wide = [](const Rows &table) { return width_of(aligned(table)[0]) > most; };
  const auto add = [&out](const Rows &table, const std::vector<std::string> &headings) {
    const std::vector<std::string> lines = aligned(table);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (!headings[i].empty()) out += "  " + headings[i] + '\n';
      if (!headings[0].empty()) out += "  ";
      out += lines[i].substr(0, lines[i].find_last_not_of(' ') + 1) + '\n';
    }
  };
  if (wide(whole)) notes = take_notes(columns);
  Rows rows = turned(columns);
  blank_repeated(rows);
  std::vector<std::string> headings(rows.size());
  while (wide(rows) && is_heading(rows)) take_headings(rows, headings);
  if (!wide(rows) || columns.size() <= static_cast<std::size_t>(rows_)) {
    add(rows, headings);
    for (std::size_t i = 0; i < notes.size(); ++i)
      out += wrapped(fmt::format("[{}] {}", i + 1, notes[i]), of_text);
    return out;
  }
  // Each row becomes a column, with as many of them side by side as fit.
  const std::vector<std::string> none(columns.size());
  for (std::size_t next = 1; next < whole.size();) {
    Rows part = {whole[0], whole[next++]};
    for (; next < whole.size(); ++next) {
      part.push_back(whole[next]);
      if (!wide(turned(part))) continue;
      part.pop_back();
      break;
    }
    add(turned(part), none);
  }
  return out;
}

void Table::write(const std::string &path) const { write_file(path, csv()); }

std::string valid_utf8(std::string_view text) {
  // The writer of JSON is what repairs texts.
  const nlohmann::json as_json = text;
  return nlohmann::json::parse(
      as_json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string html_escape(std::string_view raw) {
  const std::string text = valid_utf8(raw);
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
