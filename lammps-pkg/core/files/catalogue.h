// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/catalogue.h
/// Event catalogues: text files with one event per line, written and read by all programs.
///
///     # lsm-catalogue 1
///     # model = lsm | block-slider
///     # key = value ...
///     event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end[,slip_moment][,x_centroid]...
///
/// The columns that may follow are in the tables of files/event.h, for each kind of events; the
/// program that writes them defines them. A reader finds columns by name and ignores those it does
/// not know. Times in model time, sizes in model energy, 17 significant digits. Events are in order
/// of time and do not overlap; identifiers increase. Events of another kind than drops of PE, named
/// by the parameter `events`, may overlap in time and are in order of their ends. The parameter
/// `completeness` is a size: smaller events may depend on the time step.
#ifndef LSM_CATALOGUE_H
#define LSM_CATALOGUE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "files/event.h"
#include "files/input_bytes.h"
#include "files/line_reader.h"
#include "files/output_file.h"
#include "files/parameters.h"

namespace LSM {

/// A row of a catalogue of any kind.
struct EventRow : Event {
  /// The numbers of the columns that not all catalogues have, in the order of CatalogueInfo.
  std::array<double, std::size(slip_of_drops) + std::size(friction_of_drops) +
                         std::size(columns_of_ruptures) + std::size(columns_of_planes)>
      more{};
};

/// Header of a catalogue.
struct CatalogueInfo : files::FileHeader {
  /// Names, in the tables of files/event.h, of the columns that not all catalogues have.
  std::vector<std::string_view> columns;

  bool has(std::string_view column) const;
  /// The number of an event in one of these columns; 0 if the catalogue does not have it.
  double number(const EventRow &event, std::string_view column) const;

  /// Whether events may overlap in time; if so, they are sorted by their ends.
  bool overlapping() const;

  /// Size below which events may depend on the time step; 0 if the header does not give one.
  double completeness() const;

  /// All parameters, the model first.
  files::Parameters header() const;
};

constexpr std::string_view catalogue_magic = "# lsm-catalogue ";

/// A column of a catalogue: a member of all events or, if it is none, one of EventRow::more.
struct CatalogueColumn {
  std::string_view name;
  double Event::*number = nullptr;
  std::int64_t Event::*integer = nullptr;
  std::size_t more = SIZE_MAX;  ///< its place there; SIZE_MAX: of a column that is not known

  /// Where a row has the number; nullptr for an integer, or a column that is not known.
  double *place(EventRow &row) const {
    return number ? &(row.*number) : more < row.more.size() ? &row.more[more] : nullptr;
  }
  double of(const EventRow &row) const {
    return number ? row.*number : integer ? static_cast<double>(row.*integer) : row.more.at(more);
  }
};

/// The columns of a catalogue, in the order of the file.
std::vector<CatalogueColumn> columns_of(const CatalogueInfo &info);

/// Reads a catalogue event by event.
///
/// A strict reader (the default) throws at anything unexpected. A lenient one skips bad lines and
/// counts them by kind; it still throws if the first line, the model or the column line is wrong,
/// as nothing can be read without them.
class CatalogueReader {
 public:
  /// \throws FileError if the header cannot be read.
  explicit CatalogueReader(std::unique_ptr<files::Bytes> bytes, bool lenient = false);

  const CatalogueInfo &info() const { return info_; }

  /// Reads the next event. Returns false at the end of the file.
  /// \throws FileError (strict)
  bool next(EventRow &event);

  std::int64_t skipped() const { return skipped_; }  ///< bad lines skipped (lenient)
  /// Message of the first bad line skipped, or "" (lenient).
  const std::string &first_problem() const { return first_problem_; }

  /// One line of text for each kind of bad line skipped so far, with its number (lenient).
  std::vector<std::string> repairs() const;

 private:
  friend class CatalogueWriter;

  enum Kind : std::size_t { header, truncated, columns, number, order };
  static constexpr std::size_t kinds = 5;

  void report(Kind kind, const std::string &problem);

  void read_header();
  void read_parameter(files::ParameterList &parameters);

  void read_columns();

  /// Converts line_ to an event. Reports the problem and returns false if the line does not match
  /// the columns.
  bool parse_row(EventRow &event);

  /// Reports why parse_row() refused line_. `rest` begins with the first column that could not be
  /// read.
  void report_row(const CatalogueColumn &column, std::string_view rest);

  files::LineReader reader_;
  bool lenient_ = false;
  bool resuming_ = false;  // an incomplete last line ends the file silently
  CatalogueInfo info_;
  bool overlapping_ = false;
  std::string column_line_;
  std::vector<CatalogueColumn> columns_;  // in the order of the file
  std::string_view line_;                 // valid until the next one is read
  Event last_;
  bool has_last_ = false;
  std::array<std::int64_t, kinds> counts_{};
  std::int64_t skipped_ = 0;
  std::string first_problem_;
};

/// Writes a catalogue. Each event has been handed to the operating system when write() returns, so
/// that it survives if the process is killed.
class CatalogueWriter : public files::ResumableFile {
 public:
  /// Starts a new catalogue, replacing an older one (which stays if the new one cannot be written).
  /// \param whole the file gets its name by close() only, see OutputFile
  /// \throws FileError
  /// \throws std::invalid_argument for a header that could not be read back
  void create(const std::string &path, const CatalogueInfo &info, bool whole = false);

  /// Inspects the catalogue of a run that continues, which cut() will continue: checks that the
  /// header is what create() would write, and finds the first event that was written later, or a
  /// truncated last line.
  /// \param written number of the last event until then, 0 if there was none; the file may have
  /// been begun by a continued run, with a later event than the first \throws FileError naming the
  /// first parameter that differs, the first bad line, or the number of events.
  void find_cut(const std::string &path, const CatalogueInfo &info, std::int64_t written);

  /// Appends one line and hands it to the operating system.
  /// \throws FileError if that fails, or if a reader would not accept the event after the previous
  /// one (NaN, order)
  void write(const EventRow &event);
  /// The same for an event of a kind that has the columns of the catalogue.
  /// \throws std::invalid_argument if it has not
  template <class Kind>
  void write(Kind event) {
    static_assert(!std::is_base_of_v<EventRow, Kind>, "a row has its columns in its own order");
    EventRow row{event, {}};
    for (const CatalogueColumn &column : columns_) {
      if (column.number || column.integer) continue;
      const double *const number = number_in(event, column.name);
      if (!number) throw std::invalid_argument("events without column " + std::string(column.name));
      row.more[column.more] = *number;
    }
    write(row);
  }

  std::int64_t rows() const { return rows_; }  ///< events in the file, kept ones included

 private:
  void start(const CatalogueInfo &info);

  bool overlapping_ = false;
  std::vector<CatalogueColumn> columns_;
  Event last_;
  std::int64_t rows_ = 0;
  std::string line_;
};

}  // namespace LSM

#endif
