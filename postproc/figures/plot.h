// SPDX-License-Identifier: GPL-2.0-or-later
/// \file plot.h
/// Pictures by gnuplot. A command writes its table BASE.csv, then draws BASE.png and BASE.svg with
/// a script BASE.gp that stays beside them, so that `gnuplot BASE.gp` in that folder draws them
/// again.
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

/// Where a picture goes.
struct PictureOptions {
  std::string output;       ///< BASE: path of the files without extension
  bool no_picture = false;  ///< write the table and the script only
  bool overwrite = false;   ///< replace files of others

  std::string table() const { return output + ".csv"; }

  /// Call before anything is read or written.
  /// \param inputs files that the command reads
  /// \param more what it writes besides BASE.csv, .gp, .png and .svg, as "BASE" + text
  /// \param others files of other options; empty paths are skipped
  /// \throws FileError if BASE is no file name, an output would replace an input, or two are one
  void check(const std::vector<std::string> &inputs, const std::vector<std::string> &more = {},
             const std::vector<Output> &others = {}) const;
};

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

/// A table and the picture of it.
struct Figure {
  Table table;
  /// gnuplot commands that end with a plot (or multiplot); run once per format. They find the
  /// string variables `base` ("./" and the name without folder, so that no name begins a pipe) and
  /// `table` (base.".csv"), comma as the separator of data files, line types 1 to 16 with Okabe and
  /// Ito's colours, twice, and different point types and dashes (`lt K`), and the key below the
  /// picture. lt 8 is black.
  std::string script;
  PictureSize size;
};

/// Writes BASE.csv, BASE.gp and, unless options.no_picture, runs gnuplot in the folder of BASE and
/// checks that BASE.png and BASE.svg came out; says on standard output what was written.
/// \throws FileError; PlotError, also when gnuplot is missing (table and script are there by then)
void make(const Figure &figure, const PictureOptions &options);

/// Before anything is written. \throws FileError if make() would replace a file that is none of an
/// earlier figure of the same kind, unless options.overwrite
void check_outputs(const Figure &figure, const PictureOptions &options);

/// The picture as SVG text, without leaving a file. \throws FileError
std::string svg_text(const Figure &figure);

/// Begins a panel of a multiplot with linear axes; its place as shares of the picture.
std::string panel(double left, double right, double bottom, double top);

/// A plot command with its key. Later layers are drawn above earlier ones.
class Curves {
 public:
  enum Layer { areas, data, laws, legend };

  /// A function row(k) that gives column x in the rows of curve k, where `condition` holds.
  explicit Curves(std::string_view x, std::string_view condition = "");

  /// \param title empty: not in the key
  void add(Layer layer, const std::string &element, const std::string &title = "",
           std::string (*quoted)(std::string_view) = quote);
  /// Points of a curve of the table with error bars, y and error being the numbers of columns.
  void add_data(std::int64_t curve, int y, int error, const std::string &title = "");
  /// The law y = formula, gnuplot's in $1, from lo to hi.
  void add_law(double lo, double hi, const std::string &formula, const std::string &style,
               const std::string &title = "", std::string (*quoted)(std::string_view) = quote);
  /// The picture, whose size leaves the same room for the axes whatever the key holds.
  /// \param axes gnuplot lines before the plot command
  Figure figure(Table table, const std::string &axes, int width = 900) const;

 private:
  std::string functions_;
  std::array<std::vector<std::string>, 4> layers_;
  std::vector<std::string> titles_;
};

}  // namespace LSM::postproc

#endif
