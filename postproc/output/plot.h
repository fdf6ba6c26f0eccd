// SPDX-License-Identifier: GPL-2.0-or-later
/// \file plot.h
/// Figures drawn by gnuplot. A command writes its table BASE.csv, then draws BASE.png and BASE.svg
/// with the script BASE.gp, which is kept: `gnuplot BASE.gp` in that folder draws them again.
#ifndef LSM_POSTPROC_PLOT_H
#define LSM_POSTPROC_PLOT_H

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "files/file_error.h"
#include "files/output_claim.h"
#include "table.h"

namespace LSM::postproc {

/// gnuplot cannot draw; the message is one line.
class PlotError : public FileError {
 public:
  using FileError::FileError;
};

/// Where the files of a figure go.
struct PictureOptions {
  std::string output;       ///< BASE: path of the files without extension
  bool no_picture = false;  ///< write the table and the script only
  bool overwrite = false;   ///< also replace files that are no earlier version

  std::string table() const { return output + ".csv"; }

  /// Checks the names of all outputs. Call it before anything is read or written.
  /// \param inputs files that the command reads
  /// \param more endings of further files of BASE, besides .csv, .gp, .png and .svg
  /// \param others outputs of other options; empty paths are skipped
  /// \throws FileError if BASE is no file name, an output would replace an input, or two outputs
  /// are the same file
  void check(const std::vector<std::string> &inputs, const std::vector<std::string> &more = {},
             const std::vector<Output> &others = {}) const;
};

/// gnuplot string literal that shows the text unchanged: the markup of enhanced mode is escaped.
std::string quote(std::string_view text);
/// gnuplot string literal without escapes for enhanced mode: for file names, and for texts with
/// markup of our own.
std::string quote_plain(std::string_view text);

/// gnuplot commands for the label and the range of one axis. A logarithmic range is widened to
/// whole decades, with ticks at 10^n; one of less than a factor of 30 is widened to the next ticks,
/// at 1, 2 and 5 times 10^n or at more digits if these are too few.
/// \param name 'x', 'y' or another axis that gnuplot knows
/// \param label gnuplot enhanced text, with the unit
/// \param lo,hi ends of the range; gnuplot chooses an end that is NaN or infinite
std::string axis(std::string_view name, std::string_view label, bool logarithmic, double lo,
                 double hi);

/// Size of a picture in units of the SVG. The PNG has twice as many pixels in each direction.
struct PictureSize {
  int width = 900, height = 640;
};

/// A table and the gnuplot script that draws it.
struct Figure {
  Table table;
  /// gnuplot commands that end with a plot (or multiplot); they run once per format. Before them
  /// are set: the string variables `base` ("./" and the name without folder, so that gnuplot does
  /// not take a name for a pipe) and `table` (base.".csv"); comma as the separator of data files;
  /// line types `lt 1` to `lt 58` with Okabe and Ito's colours and different point types, from the
  /// seventh on letters (lt 8 is black); and the key below the picture.
  std::string script;
  PictureSize size;
};

/// Writes BASE.csv and BASE.gp and, unless options.no_picture, runs gnuplot in the folder of BASE
/// and checks that it wrote BASE.png and BASE.svg. Reports on standard output what was written.
/// \throws FileError
/// \throws PlotError if gnuplot fails or is missing; table and script have been written by then
void make(const Figure &figure, const PictureOptions &options);

/// Checks whether make() may write its files. Call it before anything is written.
/// \throws FileError if make() would replace a file that is not from an earlier figure of the same
/// kind, unless options.overwrite
void check_outputs(const Figure &figure, const PictureOptions &options);

/// Builds a plot command and its key. Later layers are drawn over earlier ones.
class Curves {
 public:
  enum Layer { areas, data, laws, legend };

  /// Defines the gnuplot function row(k): the value of `x` in the rows of curve k (column 1), and
  /// NaN in other rows.
  /// \param x gnuplot expression, such as "$5"
  /// \param condition gnuplot condition that the rows have to fulfil as well
  explicit Curves(std::string_view x, std::string_view condition = "");

  /// Adds an element of the plot command.
  /// \param title in the key; empty: none
  void add(Layer layer, const std::string &element, const std::string &title = "");
  /// Adds the points of a curve of the table with error bars.
  /// \param y,error numbers of the columns, from 1
  void add_data(std::int64_t curve, int y, int error);
  /// Adds the curve y = formula from lo to hi.
  /// \param formula gnuplot expression in $1
  void add_law(double lo, double hi, const std::string &formula, const std::string &style,
               const std::string &title = "");
  /// Returns the figure, whose height leaves the same room for the axes however long the key is.
  /// \param axes gnuplot commands before the plot command
  Figure figure(Table table, const std::string &axes) const;

 private:
  std::string functions_;
  std::array<std::vector<std::string>, 4> layers_;
  std::vector<std::string> titles_;
};

}  // namespace LSM::postproc

#endif
