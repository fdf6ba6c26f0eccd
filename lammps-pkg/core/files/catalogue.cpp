// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/catalogue.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "files/file_error.h"
#include "files/header_keys.h"

namespace LSM {

namespace {

constexpr std::string_view first_line = "# lsm-catalogue 1";

/// Those of all catalogues.
constexpr CatalogueColumn first_columns[] = {{"event_id", nullptr, &Event::id},
                                             {"t_start", &Event::t_start},
                                             {"t_end", &Event::t_end},
                                             {"step_start", nullptr, &Event::step_start},
                                             {"step_end", nullptr, &Event::step_end},
                                             {"size", &Event::size},
                                             {"pe_start", &Event::pe_start},
                                             {"pe_end", &Event::pe_end}};

/// The names of all other columns.
const std::set<std::string_view> &further_columns() {
  static const std::set<std::string_view> all = [] {
    std::vector<std::string_view> names;
    add_names(names, slip_of_drops);
    add_names(names, friction_of_drops);
    add_names(names, columns_of_ruptures);
    add_names(names, columns_of_planes);
    names.insert(names.end(), std::begin(columns_of_sources), std::end(columns_of_sources));
    return std::set<std::string_view>(names.begin(), names.end());
  }();
  return all;
}

std::string column_line(const CatalogueInfo &info) {
  std::string out;
  for (const CatalogueColumn &column : columns_of(info)) {
    if (!out.empty()) out += ',';
    out += column.name;
  }
  return out;
}

/// Returns what is wrong with the model, or "".
std::string bad_model(const std::string &model) {
  if (model == "lsm" || model == "block-slider") return {};
  return "model is " + text::in_quotes(model) + ", expected 'lsm' or 'block-slider'";
}

/// Names the first number of the event that is not finite, or returns "".
std::string not_finite(const std::vector<CatalogueColumn> &columns, const EventRow &event) {
  for (const CatalogueColumn &column : columns)
    if (!column.integer && !std::isfinite(column.of(event)))
      return "column '" + std::string(column.name) + "' is not finite, expected a finite number";
  return {};
}

/// Returns why an event must not follow the previous one, or "". The first event has no predecessor
/// (nullptr).
std::string out_of_order(const Event &event, const Event *before, bool overlapping) {
  using text::number;
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

/// Refuses a header that CatalogueReader would refuse.
void check_info(const CatalogueInfo &info) {
  files::check_parameters(info.header());
  std::string problem = bad_model(info.model);
  for (const auto &[key, value] : info.parameters)
    if (problem.empty()) problem = bad_value(key, value);
  if (!problem.empty()) throw std::invalid_argument("catalogue header: " + problem);
}

}  // namespace

std::vector<CatalogueColumn> columns_of(const CatalogueInfo &info) {
  std::vector<CatalogueColumn> columns(std::begin(first_columns), std::end(first_columns));
  for (std::size_t n = 0; n < info.columns.size(); ++n)
    columns.push_back({info.columns[n], nullptr, nullptr, n});
  return columns;
}

bool CatalogueInfo::has(std::string_view column) const {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

double CatalogueInfo::number(const EventRow &event, std::string_view column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  return found == columns.end() ? 0.0
                                : event.more.at(static_cast<std::size_t>(found - columns.begin()));
}

bool CatalogueInfo::overlapping() const {
  const std::string *events = find("events");
  return events && *events != "pe";
}

double CatalogueInfo::completeness() const {
  double size = 0.0;
  if (const std::string *text = find("completeness")) text::parse(*text, size);
  return size;
}

files::Parameters CatalogueInfo::header() const {
  files::Parameters all = {{"model", model}};
  all.insert(all.end(), parameters.begin(), parameters.end());
  return all;
}

CatalogueReader::CatalogueReader(std::unique_ptr<files::Bytes> bytes, bool lenient)
    : reader_(std::move(bytes)), lenient_(lenient) {
  read_header();
}

bool CatalogueReader::next(EventRow &event) {
  while (reader_.next(line_)) {
    if (resuming_ && !reader_.complete()) return false;
    if (!reader_.complete()) {
      report(truncated, "truncated last line, expected " + std::to_string(columns_.size()) +
                            " columns and a line end");
      continue;
    }
    EventRow candidate;
    if (!parse_row(candidate)) continue;
    const std::string problem = out_of_order(candidate, has_last_ ? &last_ : nullptr, overlapping_);
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

std::vector<std::string> CatalogueReader::repairs() const {
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

void CatalogueReader::report(Kind kind, const std::string &problem) {
  if (!lenient_) reader_.fail(problem);
  ++counts_[kind];
  if (skipped_++ == 0) first_problem_ = text::where(reader_.path(), reader_.line()) + problem;
}

void CatalogueReader::read_header() {
  if (!reader_.next(line_))
    throw FileError(text::where(reader_.path(), 1) + "empty file, expected '" +
                    std::string(first_line) + "'");
  if (line_ != first_line) {
    if (line_.substr(0, catalogue_magic.size()) == catalogue_magic)
      reader_.fail("catalogue version " + text::in_quotes(line_.substr(catalogue_magic.size())) +
                   ", expected version 1");
    reader_.fail("not a catalogue, expected '" + std::string(first_line) + "'");
  }
  files::ParameterList parameters;
  while (reader_.next(line_)) {
    if (reader_.begin() > files::longest_header)
      reader_.fail("header longer than " + std::to_string(files::longest_header) +
                   " bytes, expected a line of column names");
    if (!line_.empty() && line_.front() == '#') {
      read_parameter(parameters);
      continue;
    }
    read_columns();
    if (info_.model.empty())
      reader_.fail("no model in the header, expected '# model = lsm' or '# model = block-slider'");
    return;
  }
  throw FileError(text::where(reader_.path(), reader_.line()) +
                  "file ends within the header, expected a line of column names '" +
                  column_line(CatalogueInfo()) + "'");
}

void CatalogueReader::read_parameter(files::ParameterList &parameters) {
  std::string problem = parameters.add_line(line_, bad_value);
  if (!problem.empty()) return report(header, problem);
  const auto &[key, value] = parameters.all().back();
  if (key != "model") {
    info_.parameters.emplace_back(key, value);
    return;
  }
  problem = bad_model(value);
  if (!problem.empty()) reader_.fail(problem);
  info_.model = value;
}

void CatalogueReader::read_columns() {
  if (!reader_.complete()) reader_.fail("truncated line of column names, expected a line end");
  std::vector<std::string_view> names;
  text::split(line_, names);
  column_line_ = line_;
  for (const std::string_view name : names) {
    const auto first = std::find_if(std::begin(first_columns), std::end(first_columns),
                                    [name](const CatalogueColumn &c) { return c.name == name; });
    const auto further = further_columns().find(name);
    const bool known = first != std::end(first_columns) || further != further_columns().end();
    if (known && std::count(names.begin(), names.end(), name) > 1)
      reader_.fail("column " + text::in_quotes(name) + " is there twice, expected once");
    if (further != further_columns().end()) {
      columns_.push_back({*further, nullptr, nullptr, info_.columns.size()});
      info_.columns.push_back(*further);
    } else {
      columns_.push_back(known ? *first : CatalogueColumn{});
    }
  }
  for (const CatalogueColumn &column : first_columns)
    if (std::find(names.begin(), names.end(), column.name) == names.end())
      reader_.fail("column " + text::in_quotes(column.name) + " is missing, expected '" +
                   column_line(CatalogueInfo()) + "'");
  overlapping_ = info_.overlapping();
}

bool CatalogueReader::parse_row(EventRow &event) {
  const char *at = line_.data();
  const char *const end = at + line_.size();
  for (const CatalogueColumn &column : columns_) {
    const char *const begin = at;
    std::from_chars_result parsed{};
    if (double *const place = column.place(event)) {
      parsed = std::from_chars(at, end, *place);
      if (!std::isfinite(*place)) parsed.ec = std::errc::result_out_of_range;
    } else if (column.integer) {
      parsed = std::from_chars(at, end, event.*column.integer);
    } else {
      parsed.ptr = std::find(at, end, ',');
    }
    at = parsed.ptr;
    // A comma follows each field but the last.
    const bool last = &column == &columns_.back();
    if (parsed.ec != std::errc() || (last ? at != end : at == end || *at != ',')) {
      report_row(column, std::string_view(begin, static_cast<std::size_t>(end - begin)));
      return false;
    }
    if (!last) ++at;
  }
  return true;
}

void CatalogueReader::report_row(const CatalogueColumn &column, std::string_view rest) {
  const auto commas = std::count(line_.begin(), line_.end(), ',');
  const auto fields = line_.empty() ? 0 : static_cast<std::size_t>(commas) + 1;
  if (fields != columns_.size())
    return report(columns, std::to_string(fields) + " columns, expected " +
                               std::to_string(columns_.size()) + " (" + column_line_ + ")");
  report(number, "column '" + std::string(column.name) + "' is " +
                     text::in_quotes(rest.substr(0, rest.find(','))) + ", expected " +
                     (column.integer ? "an integer" : "a finite number"));
}

void CatalogueWriter::create(const std::string &path, const CatalogueInfo &info, bool whole) {
  check_info(info);
  start(info);
  file_.create(path, header_, whole);
}

void CatalogueWriter::find_cut(const std::string &path, const CatalogueInfo &info,
                               std::int64_t written) {
  check_info(info);
  file_.close();
  CatalogueReader reader(files::open_plain(path));
  reader.resuming_ = true;
  const std::string problem = files::difference(reader.info().header(), info.header());
  if (!problem.empty()) refuse(path, problem);
  const std::string columns = column_line(info);
  if (reader.column_line_ != columns)
    refuse(path,
           "columns are '" + reader.column_line_ + "' in the file, expected '" + columns + "'");

  std::int64_t length = old_header_ = reader.reader_.end();
  start(info);
  EventRow event;
  std::int64_t earlier = written;  // events before a file that was begun by a continued run
  while (reader.next(event) && event.id <= written) {
    if (rows_ == 0) earlier = event.id - 1;
    last_ = event;
    ++rows_;
    length = reader.reader_.end();
  }
  if (reader.reader_.foreign())
    refuse(path, "Windows line ends or a byte order mark, expected the file as the run wrote it");
  if (earlier + rows_ != written)
    refuse(path, std::to_string(earlier + rows_) + " events up to the checkpoint, expected " +
                     std::to_string(written));
  file_.keep(path, length);
}

void CatalogueWriter::write(const EventRow &event) {
  std::string problem = not_finite(columns_, event);
  if (problem.empty()) problem = out_of_order(event, rows_ > 0 ? &last_ : nullptr, overlapping_);
  if (!problem.empty())
    throw FileError(file_.path() + ": cannot write event " + text::number(event.id) + ": " +
                    problem);
  line_.clear();
  for (const CatalogueColumn &column : columns_) {
    if (!line_.empty()) line_ += ',';
    if (column.integer)
      text::append(line_, event.*column.integer);
    else
      text::append(line_, column.of(event));
  }
  line_ += '\n';
  file_.write(line_);
  last_ = event;
  ++rows_;
}

void CatalogueWriter::start(const CatalogueInfo &info) {
  header_ =
      std::string(first_line) + "\n" + files::lines_of(info.header()) + column_line(info) + "\n";
  columns_ = columns_of(info);
  overlapping_ = info.overlapping();
  rows_ = 0;
}

}  // namespace LSM
