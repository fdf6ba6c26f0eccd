// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/catalogue.h
/// Event catalogues: text files with one event per line, written and read by all programs.
///
///     # lsm-catalogue 1
///     # model = lsm | block-slider
///     # key = value ...
///     event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end[,slip_moment][,x_centroid]...
///
/// Columns that may follow: slip_moment, x_centroid, rupture_length, x_hypocentre, x_begin,
/// mean_slip, stress_drop. The program that writes them defines them. They are written in this
/// order; a reader finds columns by name and ignores those it does not know. Times in model time,
/// sizes in model energy, 17 significant digits. Events are in order of time and do not overlap;
/// identifiers increase. Events of another kind than drops of PE, named by the parameter `events`,
/// may overlap in time and are in order of their ends. The parameter `completeness` is a size:
/// smaller events may depend on the time step.
#ifndef LSM_CATALOGUE_H
#define LSM_CATALOGUE_H

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "events/event_picker.h"
#include "files/header_values.h"
#include "files/text_io.h"

namespace LSM {

/// Header of a catalogue.
struct CatalogueInfo : text_io::FileHeader {
  bool slip_moment = false, x_centroid = false, rupture_length = false;  ///< optional columns
  /// Further ones, of ruptures.
  bool x_hypocentre = false, x_begin = false, mean_slip = false, stress_drop = false;

  /// Whether events may overlap in time; they are in order of their ends then.
  bool overlapping() const {
    const std::string *events = find("events");
    return events && *events != "pe";
  }

  /// Size below which events may depend on the time step; 0: not given.
  double completeness() const {
    double size = 0.0;
    if (const std::string *text = find("completeness")) text_io::parse(*text, size);
    return size;
  }
};

namespace catalogue_detail {

constexpr std::string_view first_line = "# lsm-catalogue 1";
constexpr std::string_view magic = "# lsm-catalogue ";

/// A column of the table: its member of an event, a number, an integer or none, and whether a
/// catalogue has it, nullptr if each does.
struct Column {
  std::string_view name;
  double Event::*number = nullptr;
  std::int64_t Event::*integer = nullptr;
  bool CatalogueInfo::*optional = nullptr;
};

/// In the order in which they are written.
constexpr Column all_columns[] = {
    {"event_id", nullptr, &Event::id},
    {"t_start", &Event::t_start},
    {"t_end", &Event::t_end},
    {"step_start", nullptr, &Event::step_start},
    {"step_end", nullptr, &Event::step_end},
    {"size", &Event::size},
    {"pe_start", &Event::pe_start},
    {"pe_end", &Event::pe_end},
    {"slip_moment", &Event::slip_moment, nullptr, &CatalogueInfo::slip_moment},
    {"x_centroid", &Event::x_centroid, nullptr, &CatalogueInfo::x_centroid},
    {"rupture_length", &Event::rupture_length, nullptr, &CatalogueInfo::rupture_length},
    {"x_hypocentre", &Event::x_hypocentre, nullptr, &CatalogueInfo::x_hypocentre},
    {"x_begin", &Event::x_begin, nullptr, &CatalogueInfo::x_begin},
    {"mean_slip", &Event::mean_slip, nullptr, &CatalogueInfo::mean_slip},
    {"stress_drop", &Event::stress_drop, nullptr, &CatalogueInfo::stress_drop}};

/// The columns of a catalogue, in the order of the file.
inline std::vector<Column> columns_of(const CatalogueInfo &info) {
  std::vector<Column> columns;
  for (const Column &column : all_columns)
    if (!column.optional || info.*column.optional) columns.push_back(column);
  return columns;
}

inline std::string column_line(const CatalogueInfo &info) {
  std::string out;
  for (const Column &column : columns_of(info)) {
    if (!out.empty()) out += ',';
    out += column.name;
  }
  return out;
}

inline text_io::Parameters header(const CatalogueInfo &info) {
  text_io::Parameters all = {{"model", info.model}};
  all.insert(all.end(), info.parameters.begin(), info.parameters.end());
  return all;
}

/// What is wrong with the model, without which nothing can be read, or "".
inline std::string bad_model(const std::string &model) {
  if (model == "lsm" || model == "block-slider") return {};
  return "model is " + text_io::in_quotes(model) + ", expected 'lsm' or 'block-slider'";
}

/// The first number of event that is not finite, or "".
inline std::string not_finite(const Event &event) {
  for (const Column &column : all_columns)
    if (column.number && !std::isfinite(event.*column.number))
      return "column '" + std::string(column.name) + "' is not finite, expected a finite number";
  return {};
}

/// Why an event of finite numbers must not follow the previous one (nullptr: none), or "".
inline std::string out_of_order(const Event &event, const Event *before, bool overlapping) {
  using text_io::number;
  constexpr const char *earlier = " is before the end of the previous event ";
  if (event.t_end < event.t_start)
    return "t_end " + number(event.t_end) + " is before t_start " + number(event.t_start) +
           ", expected t_end >= t_start";
  if (event.step_end < event.step_start)
    return "step_end " + number(event.step_end) + " is before step_start " +
           number(event.step_start) + ", expected step_end >= step_start";
  if (!before) return {};
  if (event.id <= before->id)
    return "event_id " + number(event.id) + " after event_id " + number(before->id) +
           ", expected increasing event_id";
  if (overlapping && (event.t_end < before->t_end || event.step_end < before->step_end))
    return "end at t_end " + number(event.t_end) + ", step_end " + number(event.step_end) +
           earlier + number(before->t_end) + ", " + number(before->step_end) +
           ", expected ruptures in order of their ends";
  if (overlapping) return {};
  if (event.t_start < before->t_end)
    return "t_start " + number(event.t_start) + earlier + number(before->t_end) +
           ", expected events in order of time";
  if (event.step_start < before->step_end)
    return "step_start " + number(event.step_start) + earlier + number(before->step_end) +
           ", expected events in order of time";
  return {};
}

/// Checks what a program wants to write; same rules as for reading.
inline void check_info(const CatalogueInfo &info) {
  text_io::check_parameters(header(info));
  std::string problem = bad_model(info.model);
  for (const auto &[key, value] : info.parameters)
    if (problem.empty()) problem = bad_value(key, value);
  if (!problem.empty()) throw std::invalid_argument("catalogue header: " + problem);
}

}  // namespace catalogue_detail

/// Reads a catalogue event by event.
///
/// Strict (the default): anything unexpected throws. Lenient: bad lines after the first are skipped
/// and counted by kind; a wrong first line, model or column line, without which nothing can be
/// read, throws.
class CatalogueReader {
 public:
  /// \throws FileError if the header cannot be read.
  explicit CatalogueReader(std::unique_ptr<text_io::Bytes> bytes, bool lenient = false)
      : reader_(std::move(bytes)), lenient_(lenient) {
    read_header();
  }

  const CatalogueInfo &info() const { return info_; }

  /// Next event; false at the end of the file. \throws FileError (strict).
  bool next(Event &event) {
    while (reader_.next(line_)) {
      if (resuming_ && !reader_.complete()) return false;
      if (!reader_.complete()) {
        report(truncated, "truncated last line, expected " + std::to_string(columns_.size()) +
                              " columns and a line end");
        continue;
      }
      Event candidate;
      if (!parse_row(candidate)) continue;
      const std::string problem =
          catalogue_detail::out_of_order(candidate, has_last_ ? &last_ : nullptr, overlapping_);
      if (!problem.empty()) {
        report(order, problem);
        continue;
      }
      last_ = candidate;
      has_last_ = true;
      event = candidate;
      return true;
    }
    return false;
  }

  std::int64_t skipped() const { return skipped_; }  ///< bad lines skipped (lenient)
  /// Message of the first bad line skipped, or "" (lenient).
  const std::string &first_problem() const { return first_problem_; }

  /// One line of text for each kind of bad line skipped so far, with its number (lenient).
  std::vector<std::string> repairs() const {
    static constexpr std::array<const char *, kinds> texts = {
        "bad header lines", "a truncated last line", "lines with too few or too many columns",
        "lines with something else than finite numbers", "events out of order"};
    std::vector<std::string> out;
    for (std::size_t kind = 0; kind < kinds; ++kind)
      if (counts_[kind] > 0)
        out.push_back(reader_.path() + ": passed over " + texts[kind] + ": " +
                      std::to_string(counts_[kind]));
    return out;
  }

 private:
  friend class CatalogueWriter;

  enum Kind : std::size_t { header, truncated, columns, number, order };
  static constexpr std::size_t kinds = 5;

  void report(Kind kind, const std::string &problem) {
    if (!lenient_) reader_.fail(problem);
    ++counts_[kind];
    if (skipped_++ == 0) first_problem_ = text_io::where(reader_.path(), reader_.line()) + problem;
  }

  void read_header() {
    using namespace catalogue_detail;
    if (!reader_.next(line_))
      throw FileError(text_io::where(reader_.path(), 1) + "empty file, expected '" +
                      std::string(first_line) + "'");
    if (line_ != first_line) {
      if (line_.substr(0, magic.size()) == magic)
        reader_.fail("catalogue version " + text_io::in_quotes(line_.substr(magic.size())) +
                     ", expected version 1");
      reader_.fail("not a catalogue, expected '" + std::string(first_line) + "'");
    }
    text_io::ParameterList parameters;
    while (reader_.next(line_)) {
      if (reader_.begin() > text_io::longest_header)
        reader_.fail("header longer than " + std::to_string(text_io::longest_header) +
                     " bytes, expected a line of column names");
      if (!line_.empty() && line_.front() == '#') {
        read_parameter(parameters);
        continue;
      }
      read_columns();
      if (info_.model.empty())
        reader_.fail(
            "no model in the header, expected '# model = lsm' or '# model = block-slider'");
      return;
    }
    throw FileError(text_io::where(reader_.path(), reader_.line()) +
                    "file ends within the header, expected a line of column names '" +
                    column_line(CatalogueInfo()) + "'");
  }

  void read_parameter(text_io::ParameterList &parameters) {
    std::string problem = parameters.add_line(line_, bad_value);
    if (!problem.empty()) return report(header, problem);
    const auto &[key, value] = parameters.all().back();
    if (key != "model") {
      info_.parameters.emplace_back(key, value);
      return;
    }
    problem = catalogue_detail::bad_model(value);
    if (!problem.empty()) reader_.fail(problem);
    info_.model = value;
  }

  void read_columns() {
    using namespace catalogue_detail;
    if (!reader_.complete()) reader_.fail("truncated line of column names, expected a line end");
    std::vector<std::string_view> names;
    text_io::split(line_, names);
    column_line_ = line_;
    for (const std::string_view name : names) {
      const auto *known = std::find_if(std::begin(all_columns), std::end(all_columns),
                                       [name](const Column &c) { return c.name == name; });
      columns_.push_back(known == std::end(all_columns) ? Column{} : *known);
      if (known != std::end(all_columns) && known->optional) info_.*known->optional = true;
    }
    for (const Column &column : all_columns) {
      const auto there = std::count(names.begin(), names.end(), column.name);
      if (there > 1)
        reader_.fail("column " + text_io::in_quotes(column.name) +
                     " is there twice, expected once");
      if (there == 0 && !column.optional)
        reader_.fail("column " + text_io::in_quotes(column.name) + " is missing, expected '" +
                     column_line(CatalogueInfo()) + "'");
    }
    overlapping_ = info_.overlapping();
  }

  /// Numbers of line_ into event; false, and reports why, if they do not fit the columns.
  bool parse_row(Event &event) {
    const char *at = line_.data();
    const char *const end = at + line_.size();
    for (const catalogue_detail::Column &column : columns_) {
      const char *const begin = at;
      std::from_chars_result parsed{};
      if (column.number) {
        parsed = std::from_chars(at, end, event.*column.number);
        if (!std::isfinite(event.*column.number)) parsed.ec = std::errc::result_out_of_range;
      } else if (column.integer) {
        parsed = std::from_chars(at, end, event.*column.integer);
      } else {
        parsed.ptr = std::find(at, end, ',');
      }
      at = parsed.ptr;
      // A comma behind each field but the last.
      const bool last = &column == &columns_.back();
      if (parsed.ec != std::errc() || (last ? at != end : at == end || *at != ',')) {
        report_row(column, std::string_view(begin, static_cast<std::size_t>(end - begin)));
        return false;
      }
      if (!last) ++at;
    }
    return true;
  }

  /// Says why parse_row() refused line_: the first column that it could not read, which rest begins
  /// with.
  void report_row(const catalogue_detail::Column &column, std::string_view rest) {
    const auto commas = std::count(line_.begin(), line_.end(), ',');
    const auto fields = line_.empty() ? 0 : static_cast<std::size_t>(commas) + 1;
    if (fields != columns_.size())
      return report(columns, std::to_string(fields) + " columns, expected " +
                                 std::to_string(columns_.size()) + " (" + column_line_ + ")");
    report(number, "column '" + std::string(column.name) + "' is " +
                       text_io::in_quotes(rest.substr(0, rest.find(','))) + ", expected " +
                       (column.number ? "a finite number" : "an integer"));
  }

  text_io::LineReader reader_;
  bool lenient_ = false;
  bool resuming_ = false;  // an incomplete last line ends the file silently
  CatalogueInfo info_;
  bool overlapping_ = false;
  std::string column_line_;
  std::vector<catalogue_detail::Column> columns_;  // in the order of the file
  std::string_view line_;                          // valid until the next one is read
  Event last_;
  bool has_last_ = false;
  std::array<std::int64_t, kinds> counts_{};
  std::int64_t skipped_ = 0;
  std::string first_problem_;
};

/// Writes a catalogue. Each event is on its way to disk when write() returns, so that a process
/// killed later keeps it.
class CatalogueWriter : public text_io::ResumableFile {
 public:
  /// Starts a new catalogue, replacing an older one (which stays if the new one cannot be written).
  /// \throws FileError; std::invalid_argument for a header that could not be read back.
  /// whole: the file gets its name by close() only, see OutputFile.
  void create(const std::string &path, const CatalogueInfo &info, bool whole = false) {
    catalogue_detail::check_info(info);
    file_.create(path,
                 std::string(catalogue_detail::first_line) + "\n" +
                     text_io::lines_of(catalogue_detail::header(info)) +
                     catalogue_detail::column_line(info) + "\n",
                 whole);
    start(info);
  }

  /// Looks at the catalogue of a run restarted from last_step, which cut() goes on with: checks
  /// that the header says what create() would write (parameters named in ignore may differ; their
  /// old values stay), and finds the first event that ended after last_step, or a torn last line.
  /// expected: number of events before the cut, if not negative. \throws FileError naming the first
  /// parameter that differs, the first bad line, or the number of events.
  void find_cut(const std::string &path, const CatalogueInfo &info, std::int64_t last_step,
                const std::vector<std::string> &ignore = {}, std::int64_t expected = -1) {
    using namespace catalogue_detail;
    check_info(info);
    file_.close();
    CatalogueReader reader(text_io::open_plain(path));
    reader.resuming_ = true;
    const std::string problem = text_io::difference(header(reader.info()), header(info), ignore);
    if (!problem.empty()) refuse(path, problem);
    const std::string columns = column_line(info);
    if (reader.column_line_ != columns)
      refuse(path,
             "columns are '" + reader.column_line_ + "' in the file, expected '" + columns + "'");

    std::int64_t length = reader.reader_.end();
    start(info);
    // Events are in order of their ends, so the first one to drop is where the file is cut.
    Event event;
    while (reader.next(event) && event.step_end <= last_step) {
      last_ = event;
      ++rows_;
      length = reader.reader_.end();
    }
    if (reader.reader_.foreign())
      refuse(path, "Windows line ends or a byte order mark, expected the file as the run wrote it");
    if (expected >= 0 && rows_ != expected)
      refuse(path, std::to_string(rows_) + " events up to the checkpoint, expected " +
                       std::to_string(expected));
    file_.keep(path, length);
  }

  /// Appends one line and hands it to the system.
  /// \throws FileError if that fails, or if the event is not one a reader would accept after
  /// the one before (NaN, order).
  void write(const Event &event) {
    std::string problem = catalogue_detail::not_finite(event);
    if (problem.empty())
      problem = catalogue_detail::out_of_order(event, rows_ > 0 ? &last_ : nullptr, overlapping_);
    if (!problem.empty())
      throw FileError(file_.path() + ": cannot write event " + text_io::number(event.id) + ": " +
                      problem);
    line_.clear();
    for (const catalogue_detail::Column &column : columns_) {
      if (!line_.empty()) line_ += ',';
      if (column.number)
        text_io::append(line_, event.*column.number);
      else
        text_io::append(line_, event.*column.integer);
    }
    line_ += '\n';
    file_.write(line_);
    last_ = event;
    ++rows_;
  }

  std::int64_t rows() const { return rows_; }  ///< events in the file, kept ones included

 private:
  void start(const CatalogueInfo &info) {
    columns_ = catalogue_detail::columns_of(info);
    overlapping_ = info.overlapping();
    rows_ = 0;
  }

  bool overlapping_ = false;
  std::vector<catalogue_detail::Column> columns_;
  Event last_;
  std::int64_t rows_ = 0;
  std::string line_;
};

}  // namespace LSM

#endif
