// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_catalogue.h
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
/// smaller events may depend on the time step. (The format is ours.)
#ifndef LSM_CATALOGUE_H
#define LSM_CATALOGUE_H

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "lsm_event_picker.h"
#include "lsm_text_io.h"

namespace LSM {

/// Header of a catalogue.
struct CatalogueInfo {
  std::string model;                                            ///< "lsm" or "block-slider"
  std::vector<std::pair<std::string, std::string>> parameters;  ///< in the order of the file
  bool slip_moment = false, x_centroid = false, rupture_length = false;  ///< optional columns
  /// Further ones, of ruptures.
  bool x_hypocentre = false, x_begin = false, mean_slip = false, stress_drop = false;

  /// Value of a parameter, or nullptr.
  const std::string *find(std::string_view key) const { return text_io::find(parameters, key); }

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

/// A column of the table and its member of an event: a number, an integer or none.
struct Column {
  std::string_view name;
  double Event::*number;
  std::int64_t Event::*integer;
};

/// In the order in which they are written; those after the first `required` are optional.
constexpr std::array<Column, 15> all_columns = {
    {{"event_id", nullptr, &Event::id},
     {"t_start", &Event::t_start, nullptr},
     {"t_end", &Event::t_end, nullptr},
     {"step_start", nullptr, &Event::step_start},
     {"step_end", nullptr, &Event::step_end},
     {"size", &Event::size, nullptr},
     {"pe_start", &Event::pe_start, nullptr},
     {"pe_end", &Event::pe_end, nullptr},
     {"slip_moment", &Event::slip_moment, nullptr},
     {"x_centroid", &Event::x_centroid, nullptr},
     {"rupture_length", &Event::rupture_length, nullptr},
     {"x_hypocentre", &Event::x_hypocentre, nullptr},
     {"x_begin", &Event::x_begin, nullptr},
     {"mean_slip", &Event::mean_slip, nullptr},
     {"stress_drop", &Event::stress_drop, nullptr}}};
constexpr std::size_t required = 8;

/// Whether a catalogue has the optional columns, in their order.
constexpr std::array<bool CatalogueInfo::*, 7> optional_columns = {
    &CatalogueInfo::slip_moment,  &CatalogueInfo::x_centroid, &CatalogueInfo::rupture_length,
    &CatalogueInfo::x_hypocentre, &CatalogueInfo::x_begin,    &CatalogueInfo::mean_slip,
    &CatalogueInfo::stress_drop};
static_assert(required + optional_columns.size() == all_columns.size(), "a flag for each column");

/// The columns of a catalogue, in the order of the file.
inline std::vector<Column> columns_of(const CatalogueInfo &info) {
  std::vector<Column> columns(all_columns.begin(), all_columns.begin() + required);
  for (std::size_t i = required; i < all_columns.size(); ++i)
    if (info.*optional_columns[i - required]) columns.push_back(all_columns[i]);
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

inline bool known_model(std::string_view model) {
  return model == "lsm" || model == "block-slider";
}

/// What is wrong with the value of a parameter, or "".
inline std::string bad_value(const std::string &key, const std::string &value) {
  double size = 0.0;
  if (key != "completeness" || (text_io::parse(value, size) && size >= 0.0)) return {};
  return "completeness is " + text_io::in_quotes(value) + ", expected a finite size of at least 0";
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
  if (event.t_end < event.t_start)
    return "t_end " + text_io::number(event.t_end) + " is before t_start " +
           text_io::number(event.t_start) + ", expected t_end >= t_start";
  if (event.step_end < event.step_start)
    return "step_end " + text_io::number(event.step_end) + " is before step_start " +
           text_io::number(event.step_start) + ", expected step_end >= step_start";
  if (!before) return {};
  if (event.id <= before->id)
    return "event_id " + text_io::number(event.id) + " after event_id " +
           text_io::number(before->id) + ", expected increasing event_id";
  if (overlapping) {
    if (event.t_end < before->t_end || event.step_end < before->step_end)
      return "end at t_end " + text_io::number(event.t_end) + ", step_end " +
             text_io::number(event.step_end) + " is before the end of the previous event " +
             text_io::number(before->t_end) + ", " + text_io::number(before->step_end) +
             ", expected ruptures in order of their ends";
    return {};
  }
  if (event.t_start < before->t_end)
    return "t_start " + text_io::number(event.t_start) +
           " is before the end of the previous event " + text_io::number(before->t_end) +
           ", expected events in order of time";
  if (event.step_start < before->step_end)
    return "step_start " + text_io::number(event.step_start) +
           " is before the end of the previous event " + text_io::number(before->step_end) +
           ", expected events in order of time";
  return {};
}

/// Checks what a program wants to write; same rules as for reading.
inline void check_info(const CatalogueInfo &info) {
  if (!known_model(info.model))
    throw std::invalid_argument("catalogue header: model is " + text_io::in_quotes(info.model) +
                                ", expected 'lsm' or 'block-slider'");
  text_io::check_parameters(info.parameters);
  if (info.find("model"))
    throw std::invalid_argument("catalogue header: parameter 'model' given twice");
  for (const auto &[key, value] : info.parameters) {
    const std::string problem = bad_value(key, value);
    if (!problem.empty()) throw std::invalid_argument("catalogue header: " + problem);
  }
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
  explicit CatalogueReader(const std::string &path, bool lenient = false,
                           text_io::OpenBytes open = text_io::open_plain)
      : CatalogueReader(path, lenient, open, false) {}
  /// Of an open file, as a pipe can be opened only once. \throws the same
  CatalogueReader(std::unique_ptr<text_io::Bytes> bytes, bool lenient)
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
      if (!parse_row(candidate)) {
        report_row();
        continue;
      }
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

  std::int64_t line() const { return reader_.line(); }  ///< line of the last event read
  std::int64_t skipped() const { return skipped_; }     ///< bad lines skipped (lenient)
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

  CatalogueReader(const std::string &path, bool lenient, text_io::OpenBytes open, bool resuming)
      : reader_(path, open), lenient_(lenient), resuming_(resuming) {
    read_header();
  }

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
      if (!line_.empty() && line_.front() == '#') {
        read_parameter(parameters);
        continue;
      }
      info_.parameters = parameters.all();
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
    std::pair<std::string, std::string> parameter;
    if (!text_io::parse_parameter(line_, parameter)) {
      report(header, "header line " + text_io::in_quotes(line_) + ", expected '# key = value'");
      return;
    }
    if (parameter.first == "model" && info_.model.empty()) {
      if (!catalogue_detail::known_model(parameter.second))
        reader_.fail("model is " + text_io::in_quotes(parameter.second) +
                     ", expected 'lsm' or 'block-slider'");
      info_.model = parameter.second;
      return;
    }
    std::string problem = catalogue_detail::bad_value(parameter.first, parameter.second);
    if (parameter.first == "model")
      problem = "parameter 'model' given twice, expected once";
    else if (problem.empty())
      problem = parameters.add(std::move(parameter));
    if (!problem.empty()) report(header, problem);
  }

  void read_columns() {
    using namespace catalogue_detail;
    if (!reader_.complete()) reader_.fail("truncated line of column names, expected a line end");
    text_io::split(line_, fields_);
    column_line_ = line_;
    std::array<bool, all_columns.size()> found{};
    for (const std::string_view name : fields_) {
      const auto known = std::find_if(all_columns.begin(), all_columns.end(),
                                      [name](const Column &column) { return column.name == name; });
      columns_.push_back(known == all_columns.end() ? Column{"", nullptr, nullptr} : *known);
      if (known == all_columns.end()) continue;
      const auto i = static_cast<std::size_t>(known - all_columns.begin());
      if (found[i])
        reader_.fail("column " + text_io::in_quotes(name) + " is there twice, expected once");
      found[i] = true;
      if (i >= required) info_.*optional_columns[i - required] = true;
    }
    for (std::size_t i = 0; i < required; ++i)
      if (!found[i])
        reader_.fail("column " + text_io::in_quotes(all_columns[i].name) +
                     " is missing, expected '" + column_line(CatalogueInfo()) + "'");
    overlapping_ = info_.overlapping();
  }

  /// Numbers of line_ into event; false if they do not fit the columns.
  bool parse_row(Event &event) const {
    const char *at = line_.data();
    const char *const end = at + line_.size();
    for (const catalogue_detail::Column &column : columns_) {
      // A comma before each field but the first.
      if (&column != columns_.data()) {
        if (at == end || *at != ',') return false;
        ++at;
      }
      std::from_chars_result parsed{};
      if (column.number) {
        parsed = std::from_chars(at, end, event.*column.number);
        if (parsed.ec != std::errc() || !std::isfinite(event.*column.number)) return false;
      } else if (column.integer) {
        parsed = std::from_chars(at, end, event.*column.integer);
        if (parsed.ec != std::errc()) return false;
      } else {
        parsed.ptr = std::find(at, end, ',');
      }
      at = parsed.ptr;
    }
    return at == end;
  }

  /// Says why parse_row() refused line_.
  void report_row() {
    text_io::split(line_, fields_);
    if (fields_.size() != columns_.size()) {
      report(columns, std::to_string(line_.empty() ? 0 : fields_.size()) + " columns, expected " +
                          std::to_string(columns_.size()) + " (" + column_line_ + ")");
      return;
    }
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      double any_number = 0.0;
      std::int64_t any_integer = 0;
      if (columns_[i].number    ? text_io::parse(fields_[i], any_number)
          : columns_[i].integer ? text_io::parse(fields_[i], any_integer)
                                : true)
        continue;
      report(number, "column '" + std::string(columns_[i].name) + "' is " +
                         text_io::in_quotes(fields_[i]) + ", expected " +
                         (columns_[i].number ? "a finite number" : "an integer"));
      return;
    }
  }

  text_io::LineReader reader_;
  bool lenient_ = false;
  bool resuming_ = false;  // an incomplete last line ends the file silently
  CatalogueInfo info_;
  bool overlapping_ = false;
  std::string column_line_;
  std::vector<catalogue_detail::Column> columns_;  // in the order of the file
  std::string_view line_;                          // valid until the next one is read
  std::vector<std::string_view> fields_;           // views into line_
  Event last_;
  bool has_last_ = false;
  std::array<std::int64_t, kinds> counts_{};
  std::int64_t skipped_ = 0;
  std::string first_problem_;
};

/// A whole catalogue in memory.
struct Catalogue {
  CatalogueInfo info;
  std::vector<Event> events;
  std::int64_t skipped = 0;   ///< bad lines passed over (lenient)
  std::string first_problem;  ///< message of the first of them
};

/// \throws FileError, see CatalogueReader.
inline Catalogue read_catalogue(const std::string &path, bool lenient = false) {
  CatalogueReader reader(path, lenient);
  Catalogue catalogue;
  Event event;
  while (reader.next(event)) catalogue.events.push_back(event);
  catalogue.info = reader.info();
  catalogue.skipped = reader.skipped();
  catalogue.first_problem = reader.first_problem();
  return catalogue;
}

/// Writes a catalogue. Each event is on its way to disk when write() returns, so that a process
/// killed later keeps it.
class CatalogueWriter {
 public:
  /// Starts a new catalogue, replacing an older one (which stays if the new one cannot be written).
  /// \throws FileError; std::invalid_argument for a header that could not be read back.
  /// whole: the file gets its name by close() only, see OutputFile.
  void create(const std::string &path, const CatalogueInfo &info, bool whole = false) {
    catalogue_detail::check_info(info);
    std::string text(catalogue_detail::first_line);
    text += "\n# model = " + info.model + "\n";
    std::string parameters = text_io::header_text("", info.parameters);
    text.append(parameters, 1, std::string::npos);
    text += catalogue_detail::column_line(info);
    text += '\n';
    file_.create(path, text, whole);
    columns_ = catalogue_detail::columns_of(info);
    overlapping_ = info.overlapping();
    has_last_ = false;
    rows_ = 0;
  }

  /// Goes on with the catalogue of a run restarted from last_step: checks that the header says what
  /// create() would write (parameters named in ignore may differ; their old values stay), drops
  /// every event that ended after last_step and a torn last line. Returns the number of events
  /// kept, which has to be expected unless that is negative. The file is left as it was if this
  /// throws. \throws FileError naming the first parameter that differs, the first bad line, or
  /// the number of events.
  std::int64_t resume(const std::string &path, const CatalogueInfo &info, std::int64_t last_step,
                      const std::vector<std::string> &ignore = {}, std::int64_t expected = -1) {
    find_cut(path, info, last_step, ignore, expected);
    return cut();
  }

  /// All of resume() but the change of the file, which cut() does: where more than one file goes
  /// on, nothing is cut before all of them are found to fit.
  void find_cut(const std::string &path, const CatalogueInfo &info, std::int64_t last_step,
                const std::vector<std::string> &ignore = {}, std::int64_t expected = -1) {
    catalogue_detail::check_info(info);
    file_.close();
    CatalogueReader reader(path, false, text_io::open_plain, true);
    const CatalogueInfo &found = reader.info();
    std::string problem;
    if (found.model != info.model)
      problem = "model is '" + found.model + "' in the file, expected '" + info.model + "'";
    else if (const std::string columns = catalogue_detail::column_line(info);
             reader.column_line_ != columns)
      problem = "columns are '" + reader.column_line_ + "' in the file, expected '" + columns + "'";
    else
      problem = text_io::difference(found.parameters, info.parameters, ignore);
    if (!problem.empty()) throw FileError(path + ": cannot resume: " + problem);

    std::int64_t kept = 0;
    std::int64_t length = reader.reader_.end();
    Event event, last;
    // Events are in order of their ends, so the first one to drop is where the file is cut.
    while (reader.next(event) && event.step_end <= last_step) {
      last = event;
      ++kept;
      length = reader.reader_.end();
    }
    if (reader.reader_.foreign())
      throw FileError(path + ": cannot resume: " + std::string(text_io::foreign_lines));
    if (expected >= 0 && kept != expected)
      throw FileError(path + ": cannot resume: " + std::to_string(kept) +
                      " events up to the checkpoint, expected " + std::to_string(expected));
    cut_path_ = path;
    cut_length_ = length;
    columns_ = catalogue_detail::columns_of(info);
    overlapping_ = info.overlapping();
    last_ = last;
    has_last_ = kept > 0;
    rows_ = kept;
  }

  /// Continues the file that find_cut() checked. Returns the number of events kept.
  std::int64_t cut() {
    file_.append(cut_path_, cut_length_);
    return rows_;
  }

  /// Appends one line and hands it to the system.
  /// \throws FileError if that fails, or if the event is not one a reader would accept after
  /// the one before (NaN, order).
  void write(const Event &event) {
    std::string problem = catalogue_detail::not_finite(event);
    if (problem.empty())
      problem = catalogue_detail::out_of_order(event, has_last_ ? &last_ : nullptr, overlapping_);
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
    has_last_ = true;
    ++rows_;
  }

  /// \throws FileError if the system reports a late failure. Also done on destruction,
  /// silently.
  void close() { file_.close(); }

  bool is_open() const { return file_.is_open(); }
  std::int64_t rows() const { return rows_; }  ///< events in the file, kept ones included

 private:
  text_io::OutputFile file_;
  bool overlapping_ = false;
  std::vector<catalogue_detail::Column> columns_;
  Event last_;
  bool has_last_ = false;
  std::int64_t rows_ = 0;
  std::string line_;
  std::string cut_path_;
  std::int64_t cut_length_ = 0;
};

}  // namespace LSM

#endif
