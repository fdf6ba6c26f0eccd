// SPDX-License-Identifier: GPL-2.0-or-later
/// \file plot.h
/// Pictures by gnuplot. A command writes its table BASE.csv, then draws BASE.png and BASE.svg with
/// a script BASE.gp that stays beside them, so that `gnuplot BASE.gp` in that folder draws them
/// again.
#ifndef LSM_POSTPROC_PLOT_H
#define LSM_POSTPROC_PLOT_H

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "log_histogram.h"
#include "lsm_output_claim.h"
#include "lsm_text_io.h"

namespace LSM::postproc {

/// gnuplot cannot draw; the message is one line.
class PlotError : public FileError {
 public:
  using FileError::FileError;
};

/// Where a picture goes.
struct PictureOptions {
  std::string output;       ///< BASE: path of the files without extension
  bool no_picture = false;  ///< write the table and the script only

  std::string table() const { return output + ".csv"; }

  /// Call before anything is read or written.
  /// \param inputs files that the command reads
  /// \param more what it writes besides BASE.csv, .gp, .png and .svg, as "BASE" + text
  /// \param others files of other options; empty paths are skipped
  /// \throws FileError if BASE is no file name, an output would replace an input, or two are one
  void check(const std::vector<std::string> &inputs, const std::vector<std::string> &more = {},
             const std::vector<Output> &others = {}) const;
};

/// Numbers and texts in named columns. As a comma-separated table: comment lines, one line of
/// column names, rows; text is quoted where it has to be; numbers have all their digits; NaN is an
/// empty field. As JSON: an array of objects; NaN is null.
class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}
  explicit Table(std::string_view columns);  ///< names separated by commas

  void comment(std::string_view text);  ///< a "# text" line above the column names
  Table &add(double value) { return put(value); }
  Table &add(std::int64_t value) { return put(value); }
  Table &add(std::string_view text) { return put(std::string(text)); }
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
  const std::vector<std::string> &columns() const { return columns_; }
  /// Each row as text: numbers are short, NaN is a dash.
  std::vector<std::vector<std::string>> texts() const;
  std::string text() const;             ///< the whole file
  nlohmann::ordered_json json() const;  ///< without the comments
  /// See write_file(). \throws FileError
  void write(const std::string &path) const;

 private:
  template <class Cell>
  Table &put(Cell cell) {
    cells_.emplace_back(std::move(cell));
    return *this;
  }

  std::string comments_;
  std::vector<std::string> columns_;
  std::vector<std::variant<double, std::int64_t, std::string>> cells_;  ///< row by row
  std::int64_t rows_ = 0;
};

/// Adds the fields bin_lo, bin_hi, centre, count, density and error of a bin.
void add_bin(Table &table, const LogBin &bin);

/// gnuplot string literal that prints text as it is (enhanced mode's markup escaped).
std::string quote(std::string_view text);
/// gnuplot string literal for a file name or a value that enhanced mode never sees.
std::string quote_plain(std::string_view text);

/// gnuplot lines for one axis ('x' or 'y', or another that gnuplot knows): label and range.
/// Logarithmic: ticks 10^n, range widened to whole decades; a range shorter than a factor of 30 has
/// ticks at 1, 2 and 5 times 10^n. NaN or infinity leaves an end to gnuplot.
/// \param label gnuplot enhanced text, with the unit
std::string axis(std::string_view name, std::string_view label, bool logarithmic, double lo,
                 double hi);

/// Size of a picture in units of the SVG; the PNG has twice as many pixels.
struct PictureSize {
  int width = 900, height = 640;
};

/// A size that leaves the same room for the axes whatever the number of titles in the key.
PictureSize size_with_key(const std::vector<std::string> &titles, int width = 900);

/// Writes BASE.gp and, unless options.no_picture, runs gnuplot on it in the folder of BASE and
/// checks that BASE.png and BASE.svg came out.
///
/// body: gnuplot commands that end with a plot (or multiplot); run once per format. They find the
/// string variables `base` ("./" and the name without folder, so that no name begins a pipe) and
/// `table` (base.".csv"), comma as the separator of data files, line types 1 to 16 with Okabe and
/// Ito's colours, twice, and different point types and dashes (`lt K`), and the key below the
/// picture. lt 8 is black. \throws FileError; PlotError, also when gnuplot is missing (table and
/// script are there by then)
void draw(const PictureOptions &options, std::string_view body, PictureSize size = {});

/// A table and the picture of it.
struct Figure {
  Table table;
  std::string script;  ///< body for draw()
  PictureSize size;
};

/// Writes table, script and pictures, and says on standard output what was written.
/// \throws FileError, see draw()
void make(const Figure &figure, const PictureOptions &options);

/// The picture as SVG text, without leaving a file. \throws FileError
std::string svg_text(const Figure &figure);

/// gnuplot function that error_bars() needs. Logarithmic axes have no place for zero: the lower end
/// of a bar is one decade down where the error reaches the value.
constexpr std::string_view error_bar_function = "low(y, e) = y - e > 0.1 * y ? y - e : 0.1 * y\n";

/// Element of a plot command: error bars from the table, x, y and error being gnuplot expressions.
/// (gnuplot's own yerrorbars surround each point with white in an SVG.)
std::string error_bars(std::string_view x, std::string_view y, std::string_view error,
                       std::int64_t line_type);

/// Files as `wrote BASE.csv, BASE.gp, ...` on standard output.
void print_written(const PictureOptions &options);

}  // namespace LSM::postproc

#endif
