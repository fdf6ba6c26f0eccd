// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_catalogue.h
/// Event catalogues: text files with one event per line, written and read by all programs.
///
///     # lsm-catalogue 1
///     # model = lsm | block-slider
///     # key = value ...
///     event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end[,slip_moment][,x_centroid]...
///
/// Times in model time, sizes in model energy, 17 significant digits. Events are in order of time
/// and do not overlap; identifiers increase. (The format is ours.)
#ifndef LSM_CATALOGUE_H
#define LSM_CATALOGUE_H

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lsm_event_picker.h"
#include "lsm_text_io.h"

namespace LSM {

/// Unreadable or unwritable catalogue; the message is "file:line: what, expected ...".
class CatalogueError : public FileError {
 public:
  using FileError::FileError;
};

/// Header of a catalogue.
struct CatalogueInfo {
  std::string model;                                            ///< "lsm" or "block-slider"
  std::vector<std::pair<std::string, std::string>> parameters;  ///< in the order of the file
  bool slip_moment = false, x_centroid = false, rupture_length = false;  ///< optional columns

  /// Value of a parameter, or nullptr.
  const std::string *find(std::string_view key) const { return text_io::find(parameters, key); }
};

namespace catalogue_detail {

constexpr std::string_view first_line = "# lsm-catalogue 1";
constexpr std::string_view magic = "# lsm-catalogue ";
constexpr std::array<std::string_view, 8> columns = {
    "event_id", "t_start", "t_end", "step_start", "step_end", "size", "pe_start", "pe_end"};
constexpr std::array<std::string_view, 3> optional_columns = {"slip_moment", "x_centroid",
                                                              "rupture_length"};

inline std::array<bool, 3> optional_flags(const CatalogueInfo &info) {
  return {info.slip_moment, info.x_centroid, info.rupture_length};
}

inline std::string column_line(const CatalogueInfo &info) {
  std::string out;
  for (std::string_view column : columns) {
    if (!out.empty()) out += ',';
    out += column;
  }
  const auto flags = optional_flags(info);
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (!flags[i]) continue;
    out += ',';
    out += optional_columns[i];
  }
  return out;
}

inline bool known_model(std::string_view model) {
  return model == "lsm" || model == "block-slider";
}

/// What forbids event to follow the event before (nullptr: none), or "".
inline std::string fault(const Event &event, const Event *before) {
  const std::pair<std::string_view, double> numbers[] = {{"t_start", event.t_start},
                                                         {"t_end", event.t_end},
                                                         {"size", event.size},
                                                         {"pe_start", event.pe_start},
                                                         {"pe_end", event.pe_end},
                                                         {"slip_moment", event.slip_moment},
                                                         {"x_centroid", event.x_centroid},
                                                         {"rupture_length", event.rupture_length}};
  for (const auto &[column, value] : numbers)
    if (!std::isfinite(value))
      return "column '" + std::string(column) + "' is not finite, expected a finite number";
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
}

}  // namespace catalogue_detail

/// Reads a catalogue event by event.
///
/// Strict (the default): anything unexpected throws. Lenient: bad lines below the first are skipped
/// and counted; a wrong first line, model or column line, without which nothing can be read, throw.
class CatalogueReader {
 public:
  /// \throws CatalogueError if the header cannot be read.
  explicit CatalogueReader(const std::string &path, bool lenient = false)
      : CatalogueReader(path, lenient, false) {}

  const CatalogueInfo &info() const { return info_; }

  /// Next event; false at the end of the file. \throws CatalogueError (strict).
  bool next(Event &event) {
    while (reader_.next(line_)) {
      if (resuming_ && !reader_.complete()) {
        torn_ = true;
        return false;
      }
      Event candidate;
      std::string problem = parse_row(candidate);
      if (problem.empty())
        problem = catalogue_detail::fault(candidate, has_last_ ? &last_ : nullptr);
      if (!problem.empty()) {
        report(problem);
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
  std::int64_t skipped() const { return skipped_; }     ///< bad lines passed over (lenient)
  /// Message of the first bad line passed over, or "" (lenient).
  const std::string &first_problem() const { return first_problem_; }

 private:
  friend class CatalogueWriter;

  CatalogueReader(const std::string &path, bool lenient, bool resuming)
      : reader_(path), lenient_(lenient), resuming_(resuming) {
    read_header();
  }

  void report(const std::string &problem) {
    if (!lenient_) reader_.fail(problem);
    if (skipped_++ == 0) first_problem_ = text_io::where(reader_.path(), reader_.line()) + problem;
  }

  void read_header() {
    using namespace catalogue_detail;
    if (!reader_.next(line_))
      throw CatalogueError(text_io::where(reader_.path(), 1) + "empty file, expected '" +
                           std::string(first_line) + "'");
    if (line_ != first_line) {
      if (std::string_view(line_).substr(0, magic.size()) == magic)
        reader_.fail("catalogue version " + text_io::in_quotes(line_.substr(magic.size())) +
                     ", expected version 1");
      reader_.fail("not a catalogue, expected '" + std::string(first_line) + "'");
    }
    while (reader_.next(line_)) {
      if (!line_.empty() && line_.front() == '#') {
        read_parameter();
        continue;
      }
      read_columns();
      if (info_.model.empty())
        reader_.fail(
            "no model in the header, expected '# model = lsm' or '# model = block-slider'");
      return;
    }
    throw CatalogueError(text_io::where(reader_.path(), reader_.line()) +
                         "file ends within the header, expected a line of column names '" +
                         column_line(CatalogueInfo()) + "'");
  }

  void read_parameter() {
    std::pair<std::string, std::string> parameter;
    if (!text_io::parse_parameter(line_, parameter)) {
      report("header line " + text_io::in_quotes(line_) + ", expected '# key = value'");
      return;
    }
    if (parameter.first == "model" && info_.model.empty()) {
      if (!catalogue_detail::known_model(parameter.second))
        reader_.fail("model is " + text_io::in_quotes(parameter.second) +
                     ", expected 'lsm' or 'block-slider'");
      info_.model = parameter.second;
      return;
    }
    if (parameter.first == "model" || info_.find(parameter.first)) {
      report("parameter " + text_io::in_quotes(parameter.first) + " given twice, expected once");
      return;
    }
    info_.parameters.push_back(std::move(parameter));
  }

  void read_columns() {
    using namespace catalogue_detail;
    if (!reader_.complete()) reader_.fail("truncated line of column names, expected a line end");
    text_io::split(line_, fields_);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (i >= fields_.size())
        reader_.fail("column " + std::to_string(i + 1) + " is missing, expected '" +
                     std::string(columns[i]) + "'");
      if (fields_[i] != columns[i])
        reader_.fail("column " + std::to_string(i + 1) + " is " + text_io::in_quotes(fields_[i]) +
                     ", expected '" + std::string(columns[i]) + "'");
    }
    std::size_t candidate = 0;
    for (std::size_t i = columns.size(); i < fields_.size(); ++i) {
      while (candidate < optional_columns.size() && optional_columns[candidate] != fields_[i])
        ++candidate;
      if (candidate == optional_columns.size())
        reader_.fail("column " + std::to_string(i + 1) + " is " + text_io::in_quotes(fields_[i]) +
                     ", expected slip_moment, x_centroid, rupture_length, in this order");
      if (candidate == 0) info_.slip_moment = true;
      if (candidate == 1) info_.x_centroid = true;
      if (candidate == 2) info_.rupture_length = true;
      ++candidate;
    }
    count_ = fields_.size();
    names_ = column_line(info_);
  }

  /// Numbers of line_ into event; returns what is wrong, or "".
  std::string parse_row(Event &event) {
    using namespace catalogue_detail;
    if (!reader_.complete())
      return "truncated last line, expected " + std::to_string(count_) + " columns and a line end";
    text_io::split(line_, fields_);
    if (fields_.size() != count_)
      return std::to_string(line_.empty() ? 0 : fields_.size()) + " columns, expected " +
             std::to_string(count_) + " (" + names_ + ")";
    std::array<double *, 11> numbers = {nullptr, &event.t_start, &event.t_end,    nullptr,
                                        nullptr, &event.size,    &event.pe_start, &event.pe_end,
                                        nullptr, nullptr,        nullptr};
    std::array<std::int64_t *, 11> integers{};
    integers[0] = &event.id;
    integers[3] = &event.step_start;
    integers[4] = &event.step_end;
    std::array<std::string_view, 11> names{};
    std::size_t column = 0;
    for (; column < columns.size(); ++column) names[column] = columns[column];
    double *const extra[] = {&event.slip_moment, &event.x_centroid, &event.rupture_length};
    const auto flags = optional_flags(info_);
    for (std::size_t i = 0; i < flags.size(); ++i) {
      if (!flags[i]) continue;
      numbers[column] = extra[i];
      names[column++] = optional_columns[i];
    }
    for (std::size_t i = 0; i < count_; ++i) {
      const bool good = integers[i] ? text_io::parse(fields_[i], *integers[i])
                                    : text_io::parse(fields_[i], *numbers[i]);
      if (!good)
        return "column '" + std::string(names[i]) + "' is " + text_io::in_quotes(fields_[i]) +
               ", expected " + (integers[i] ? "an integer" : "a finite number");
    }
    return {};
  }

  text_io::LineReader<CatalogueError> reader_;
  bool lenient_ = false;
  bool resuming_ = false;  // a torn last line ends the file quietly
  bool torn_ = false;
  CatalogueInfo info_;
  std::string line_, names_, first_problem_;
  std::vector<std::string_view> fields_;  // views into line_
  std::size_t count_ = 0;
  Event last_;
  bool has_last_ = false;
  std::int64_t skipped_ = 0;
};

/// A whole catalogue in memory.
struct Catalogue {
  CatalogueInfo info;
  std::vector<Event> events;
  std::int64_t skipped = 0;   ///< bad lines passed over (lenient)
  std::string first_problem;  ///< message of the first of them
};

/// \throws CatalogueError, see CatalogueReader.
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
  /// \throws CatalogueError; std::invalid_argument for a header that could not be read back.
  void create(const std::string &path, const CatalogueInfo &info) {
    catalogue_detail::check_info(info);
    std::string text(catalogue_detail::first_line);
    text += "\n# model = " + info.model + "\n";
    std::string parameters = text_io::header_text("", info.parameters);
    text.append(parameters, 1, std::string::npos);
    text += catalogue_detail::column_line(info);
    text += '\n';
    file_.create(path, text);
    flags_ = catalogue_detail::optional_flags(info);
    has_last_ = false;
    rows_ = 0;
  }

  /// Goes on with the catalogue of a run restarted from last_step: checks that the header says what
  /// create() would write (parameters named in ignore may differ; their old values stay), drops
  /// every event that ended after last_step and a torn last line. Returns the number of events
  /// kept. The file is left as it was if this throws. \throws CatalogueError naming the first
  /// parameter that differs or the first bad line.
  std::int64_t resume(const std::string &path, const CatalogueInfo &info, std::int64_t last_step,
                      const std::vector<std::string> &ignore = {}) {
    catalogue_detail::check_info(info);
    file_.close();
    CatalogueReader reader(path, false, true);
    const CatalogueInfo &found = reader.info();
    std::string problem;
    if (found.model != info.model)
      problem = "model is '" + found.model + "' in the file, expected '" + info.model + "'";
    else if (catalogue_detail::optional_flags(found) != catalogue_detail::optional_flags(info))
      problem = "columns are '" + catalogue_detail::column_line(found) +
                "' in the file, expected '" + catalogue_detail::column_line(info) + "'";
    else
      problem = text_io::difference(found.parameters, info.parameters, ignore);
    if (!problem.empty()) throw CatalogueError(path + ": cannot resume: " + problem);

    std::int64_t kept = 0;
    std::int64_t length = reader.reader_.end();
    Event event, last;
    // Events are in order, so the first one to drop is where the file is cut.
    while (reader.next(event) && event.step_end <= last_step) {
      last = event;
      ++kept;
      length = reader.reader_.end();
    }
    file_.append(path, length);
    flags_ = catalogue_detail::optional_flags(info);
    last_ = last;
    has_last_ = kept > 0;
    rows_ = kept;
    return kept;
  }

  /// Appends one line and hands it to the system.
  /// \throws CatalogueError if that fails, or if the event is not one a reader would accept after
  /// the one before (NaN, order).
  void write(const Event &event) {
    const std::string problem = catalogue_detail::fault(event, has_last_ ? &last_ : nullptr);
    if (!problem.empty())
      throw CatalogueError(file_.path() + ": cannot write event " + text_io::number(event.id) +
                           ": " + problem);
    line_.clear();
    text_io::append(line_, event.id);
    put(event.t_start);
    put(event.t_end);
    put(event.step_start);
    put(event.step_end);
    put(event.size);
    put(event.pe_start);
    put(event.pe_end);
    if (flags_[0]) put(event.slip_moment);
    if (flags_[1]) put(event.x_centroid);
    if (flags_[2]) put(event.rupture_length);
    line_ += '\n';
    file_.write(line_);
    last_ = event;
    has_last_ = true;
    ++rows_;
  }

  /// \throws CatalogueError if the system reports a late failure. Also done on destruction,
  /// silently.
  void close() { file_.close(); }

  bool is_open() const { return file_.is_open(); }
  std::int64_t rows() const { return rows_; }  ///< events in the file, kept ones included

 private:
  template <class T>
  void put(T value) {
    line_ += ',';
    text_io::append(line_, value);
  }

  text_io::OutputFile<CatalogueError> file_;
  std::array<bool, 3> flags_{};
  Event last_;
  bool has_last_ = false;
  std::int64_t rows_ = 0;
  std::string line_;
};

}  // namespace LSM

#endif
