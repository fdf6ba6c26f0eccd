// SPDX-License-Identifier: GPL-2.0-or-later
#include "rupture_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "numbers.h"

namespace LSM::postproc {

namespace {

/// Describes a fit for a key, where there is little room.
std::string short_text_of(const LogFit &fit, const std::string &what) {
  return fmt::format("{}: slope {}", what, with_error(fit.slope, fit.slope_error, " ± "));
}
std::string text_of(const LogFit &fit, const std::string &what) {
  return fmt::format("{}, scatter {} decades (n = {})", short_text_of(fit, what),
                     short_number(fit.scatter, 2), fit.n);
}
std::string ratio_text_of(const LogFit &fit, const std::string &what) {
  return fmt::format("{}; if proportional: ratio {}, scatter {} decades", text_of(fit, what),
                     short_number(fit.ratio, 3), short_number(fit.ratio_scatter, 2));
}

void add_line(Curves &plot, const LogFit &fit, const std::string &colour, const std::string &what) {
  plot.add(Curves::laws,
           fmt::format("10**({} + {} * log10(x)) with lines lc rgb '{}' lw 1.6 dt 1",
                       text::number(fit.intercept), text::number(fit.slope), colour),
           short_text_of(fit, what));
}

/// Adds a scatter plot of the table's columns 4 and 5, a colour per catalogue. Catalogues are drawn
/// in turns, a fifth of each at a time, so that none hides the others.
void add_scatter(Curves &plot, const RuptureRelations &relations) {
  const std::vector<RuptureScatter> &all = relations.catalogues;
  const std::size_t layers = all.size() > 1 ? 5 : 1;
  for (std::size_t layer = 0; layer < layers; ++layer)
    for (std::size_t k = 1; k <= all.size(); ++k)
      plot.add(Curves::data,
               fmt::format("table every {}::{} using (row({})):5 with points lt {} ps 0.6*point",
                           layers, layer, k, (k - 1) % 16 + 1));
  for (std::size_t k = 0; k < all.size(); ++k)
    plot.add(Curves::data, fmt::format("keyentry with points lt {}", k % 16 + 1),
             fmt::format("{} ({} ruptures{})", all[k].label, all[k].ruptures,
                         all[k].one_of == 1 ? std::string()
                                            : fmt::format(", shown: the largest {} and one of {}",
                                                          RuptureScatter::largest, all[k].one_of)));
}

/// Adds a row for each rupture that is shown: its catalogue and id, and the cells that `use` adds.
template <class Use>
void add_rows(Table &table, const RuptureRelations &relations, const Use &use) {
  std::int64_t number = 0;
  for (const RuptureScatter &one : relations.catalogues) {
    ++number;
    for (const RupturePoint &point : one.shown)
      use(table.add(number).add(one.label).add(point.event_id), point);
  }
}

void add_limit(Curves &plot, double limit, const Extent &heights) {
  const std::string style = "lc rgb '#777777' lw 1.6 dt (6,4)";
  plot.add(Curves::laws,
           fmt::format("'+' using ({}):({}):(0):({}) every ::::0 with vectors nohead {}",
                       text::number(limit), text::number(heights.lo),
                       text::number(heights.hi - heights.lo), style));
  plot.add(Curves::laws, "keyentry with lines " + style,
           "detection limit: one bin in one interval");
}

}  // namespace

Figure rupture_density_figure(const std::vector<RuptureDensity> &densities,
                              RuptureQuantity quantity, double limit) {
  const bool length = quantity == RuptureQuantity::length;
  Table table("curve,length,bin_lo,bin_hi,centre,count,density,error,label");
  table.comment(
      fmt::format("Ruptures per unit of model time, length of the fault and {}; errors: Poisson",
                  length ? "length of the rupture" : "slip moment"));
  Curves plot("$5", "$6 > 0");
  Extent values, heights;
  std::int64_t number = 0;
  for (const RuptureDensity &density : densities) {
    if (density.bins.empty()) continue;
    ++number;
    std::int64_t count = 0;
    for (const LogBin &bin : density.bins) {
      table.row(number, density.fault, bin, density.label);
      count += bin.count;
      if (bin.count == 0) continue;
      values.add(bin.centre);
      heights.add(bin.density);
    }
    plot.add_data(number, 7, 8, fmt::format("{} ({} ruptures)", density.label, count));
  }
  if (number == 0) throw DegenerateData("no ruptures in any catalogue, nothing to draw");
  if (limit > values.lo) {
    add_limit(plot, limit, heights);
    table.comment(fmt::format("detection limit, one bin in one interval: {}", limit));
  }
  return plot.figure(
      std::move(table),
      axis("x", length ? "Length of the rupture (model units)" : "Slip moment (model units)", true,
           values.lo, values.hi) +
          axis("y",
               length ? "Ruptures per time, fault length and length"
                      : "Ruptures per time, fault length and moment",
               true, heights.lo, heights.hi));
}

Figure moment_length_figure(const RuptureRelations &relations) {
  Table table("catalogue,label,event_id,length,moment,whole_fault");
  table.comment(
      "Ruptures: slip moment (shear modulus x slip x length) against length; "
      "whole_fault: 1 where the whole fault slipped");
  add_rows(table, relations, [](Table &row, const RupturePoint &point) {
    row.row(point.length, point.moment, point.whole_fault);
  });
  const LogFit &fit = relations.moment_of_length;
  table.comment(text_of(fit, "fit, without those of the whole fault"));
  Curves plot("$4");
  add_scatter(plot, relations);
  add_line(plot, fit, "#000000", "fit, whole fault excluded");
  plot.add(Curves::laws,
           fmt::format("{} * x**2 with lines lc rgb '#777777' dt (4,4)",
                       text::number(std::pow(10.0, fit.intercept + fit.slope * 1.0) / 100.0)),
           "slope 2: constant stress drop");
  return plot.figure(std::move(table), axis("x", "Length of the rupture (model units)", true,
                                            relations.lengths.lo, relations.lengths.hi) +
                                           axis("y", "Slip moment (model units)", true,
                                                relations.moments.lo, relations.moments.hi));
}

Figure moment_pe_figure(const RuptureRelations &relations) {
  Table table("catalogue,label,event_id,moment,pe_drop,alone");
  table.comment(
      "Ruptures: drop of the total PE from beginning to end against slip moment; alone: 1 if the "
      "others at the same time have less than a tenth of its moment");
  add_rows(table, relations, [](Table &row, const RupturePoint &point) {
    row.row(point.moment, point.pe_drop, point.alone);
  });
  const LogFit &all = relations.pe_of_moment, &alone = relations.pe_of_moment_alone;
  table.comment(fmt::format("PE rose during {} of {} ruptures, which are not drawn",
                            relations.pe_rose, relations.pe_rose + all.n));
  table.comment(ratio_text_of(all, "fit of all"));
  Curves plot("$4");
  add_scatter(plot, relations);
  plot.add(Curves::laws,
           "table using ($6 == 1 && $5 > 0 ? $4 : NaN):5 with points pt 6 ps 1.5*point lc rgb "
           "'#000000'",
           "isolated in time");
  add_line(plot, all, "#777777", "all");
  const bool any_alone = alone.n >= 3;
  if (any_alone) {
    table.comment(ratio_text_of(alone, "fit of those isolated in time"));
    add_line(plot, alone, "#000000", "isolated");
  }
  const double ratio = any_alone ? alone.ratio : all.ratio;
  plot.add(Curves::laws, text::number(ratio) + " * x with lines lc rgb '#D55E00' dt (6,4)",
           fmt::format("proportional: {} x moment", short_number(ratio, 2)));
  return plot.figure(std::move(table), axis("x", "Slip moment (model units)", true,
                                            relations.pe_moments.lo, relations.pe_moments.hi) +
                                           axis("y", "Drop of the total PE (model units)", true,
                                                relations.pe_drops.lo, relations.pe_drops.hi));
}

Figure stress_drop_figure(const RuptureRelations &relations) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Table table("catalogue,label,event_id,moment,stress_drop,mean,error");
  table.comment(
      "Ruptures: mean stress drop against slip moment. Rows without event_id: means "
      "over two bins of the moment per decade, with their standard errors");
  Curves plot("$4");
  plot.add(Curves::areas, "0 with lines lt 8 lw 0.6");
  add_scatter(plot, relations);
  std::int64_t number = 0;
  for (const RuptureScatter &one : relations.catalogues) {
    ++number;
    for (const RupturePoint &point : one.shown)
      table.row(number, one.label, point.event_id, point.moment, point.stress_drop, nan, nan);
    for (const StressMean &mean : one.means)
      table.row(number, one.label, nan, mean.moment, nan, mean.mean, mean.error);
    plot.add(Curves::laws,
             fmt::format("table using ($6 == $6 ? row({}) : NaN):6 with lines lt 8 lw 1.6", number),
             number == 1 ? "means of half decades" : "");
    plot.add(Curves::laws,
             fmt::format("table using (row({})):($6-$7):(0):(2*$7) with vectors nohead lt 8 lw 1.2",
                         number));
  }
  Extent drops = relations.stress_drops;
  drops.add(0.0);
  const double room = 0.05 * (drops.hi - drops.lo);
  return plot.figure(
      std::move(table),
      axis("x", "Slip moment (model units)", true, relations.moments.lo, relations.moments.hi) +
          axis("y", "Mean stress drop (model units)", false, drops.lo - room, drops.hi + room));
}

namespace {

/// Adds a row of NaN, which ends a line. gnuplot ignores empty fields and would continue the line.
void break_line(Table &table, int columns) {
  for (int k = 0; k < columns; ++k) table.add(std::string_view("NaN"));
  table.end_row();
}

constexpr std::string_view colours = R"(set datafile columnheaders
set palette defined (0 '#ffffff', 0.5 '#fff3c4', 1 '#fdc86b', 1.5 '#f3883c', 2 '#c7443c', 2.5 '#7a1f63', 3 '#1d0b3a')
set cbrange [0:3]
set cbtics ('1' 0, '10' 1, '100' 2, '1000' 3)
set cblabel 'Slip velocity / driving velocity' offset 1.5
unset grid
)";

void add_image(Table &table, const VelocityImage &image, std::int64_t shift, double x0, double t0) {
  for (std::int64_t row = 0; row < image.rows; ++row)
    for (std::int64_t column = 0; column < image.columns; ++column) {
      const double value = image.at(row, column, shift);
      table.row(x0 + (static_cast<double>(column) + 0.5) * image.column_width,
                t0 + (static_cast<double>(row) + 0.5) * image.row_height,
                value > 0.0 ? std::max(0.0, std::log10(value)) : 0.0);
    }
}

void add_outline(Table &table, const FaultGrid &grid, const Outline &outline, std::int64_t number,
                 std::int64_t shift, double x0, double t0) {
  for (const ClosedLine &line : closed_lines(grid, outline, shift)) {
    for (const auto &[place, time] : line) table.row(number, x0 + place * grid.width, time - t0);
    break_line(table, 3);
  }
}

std::string history_comment(const HistoryWindow &window) {
  return fmt::format("slip history, times {} to {}; slips: above {} times the driving velocity {}",
                     short_number(window.from, 8), short_number(window.to, 8),
                     short_number(window.info.ruptures.velocity / window.info.driving),
                     short_number(window.info.driving));
}

}  // namespace

Figure space_time_figure(const HistoryWindow &window, Table &outlines) {
  constexpr std::int64_t most_outlines = 300;
  const FaultGrid &grid = window.info.grid;
  Table table("x,time,log10_velocity");
  table.comment(history_comment(window) +
                "; the largest slip velocity in each pixel, over the driving velocity");
  add_image(table, VelocityImage(window, 700), 0, grid.x0, window.from);
  std::int64_t number = 0;
  for (const Outline &outline : window.outlines)
    if (number < most_outlines) add_outline(outlines, grid, outline, ++number, 0, grid.x0, 0.0);
  outlines.comment(
      fmt::format("outlines of the {} largest of {} ruptures", number, window.outlines.size()));
  return {std::move(table),
          std::string(colours) +
              axis("x", "Position along the fault (model units)", false, grid.x0,
                   grid.x0 + grid.length()) +
              axis("y", "Time (model units)", false, window.from, window.to) +
              "set format y '%.7g'\nset key off\n"
              "plot table using 1:2:3 with image, \\\n"
              "     base.'-outlines.csv' using 2:3 with lines lc rgb '#0072B2' lw 0.8 dt 1\n",
          {1000, 800}};
}

Figure slip_lines_figure(const HistoryWindow &window, double locked, double slipping) {
  const FaultGrid &grid = window.info.grid;
  Table table("line,time,in_event,x,slip");
  table.comment(history_comment(window) +
                fmt::format("; slip since then, a line every {} while locked, every {} while "
                            "anything slips",
                            short_number(locked), short_number(slipping)));
  std::int64_t number = 0;
  double highest = 0.0;
  for (const SlipLine &line : slip_lines(window, locked, slipping)) {
    ++number;
    for (int b = 0; b < grid.bins; ++b) {
      const double slip = line.slip[static_cast<std::size_t>(b)];
      table.row(number, line.time, line.slipping, grid.centre(b), slip);
      highest = std::max(highest, slip);
    }
    break_line(table, 5);
  }
  const auto lines = [](bool in_event, const char *style, double every, const char *while_text) {
    return fmt::format(
        "table using ($3 == {} ? $4 : NaN):5 with lines {} dt 1 title {}", in_event ? 1 : 0, style,
        quote(fmt::format("every {} time units while {}", short_number(every), while_text)));
  };
  return {
      std::move(table),
      axis("x", "Position along the fault (model units)", false, grid.x0, grid.x0 + grid.length()) +
          axis("y", fmt::format("Slip since time {} (model units)", short_number(window.from, 8)),
               false, 0.0, highest > 0.0 ? 1.02 * highest : 1.0) +
          "plot " + lines(true, "lc rgb '#D55E00' lw 0.6", slipping, "anything slips") +
          ", \\\n     " + lines(false, "lc rgb '#0072B2' lw 1.2", locked, "the fault is locked") +
          "\n",
      {1000, 640}};
}

namespace {

/// Adds the lines of the figure of one rupture, which begins in the middle bin: its outline (curve
/// 1), the fronts of the P-wave (2) and the S-wave (3), and its slip (4).
void add_detail_lines(Table &lines, const HistoryWindow &window, const Event &event,
                      std::int64_t shift, double x0, const std::array<double, 2> &speeds) {
  const FaultGrid &grid = window.info.grid;
  for (const Outline &outline : window.outlines)
    if (outline.step_start == event.step_start && outline.step_end == event.step_end &&
        std::fabs(static_cast<double>(outline.length) * grid.width - event.rupture_length) <
            0.5 * grid.width)
      add_outline(lines, grid, outline, 1, shift, x0, event.t_start);
  std::int64_t number = 2;
  for (const double speed : speeds) {
    const double reach = std::min(0.5 * grid.length(), (window.to - event.t_start) * speed);
    for (const double x : {-reach, 0.0, reach}) lines.row(number, x, std::fabs(x) / speed);
    break_line(lines, 3);
    ++number;
  }
  const std::vector<double> slip = slip_between(window, event.step_start, event.step_end);
  for (std::int64_t k = 0; k < grid.bins; ++k)
    lines.row(4, x0 + (static_cast<double>(k) + 0.5) * grid.width,
              slip[static_cast<std::size_t>((k + shift) % grid.bins)]);
  lines.comment(
      "curve 1: outline; 2: P-wave, 3: S-wave from the first place (x, time); 4: slip from "
      "beginning to end of the rupture (x, slip)");
}

constexpr std::string_view detail_panels = R"(set format x ''
set key at screen 0.47,0.985 center top horizontal maxcols 2
plot table using 1:2:3 with image notitle, \
     lines using ($1 == 1 ? $2 : NaN):3 with lines lc rgb '#0072B2' lw 1 dt 1 title 'rupture', \
     lines using ($1 == 2 ? $2 : NaN):3 with lines lc rgb '#000000' lw 1.6 dt 1 title {}, \
     lines using ($1 == 3 ? $2 : NaN):3 with lines lc rgb '#009E73' lw 1.8 dt (6,4) title {}
set tmargin at screen 0.33
set bmargin at screen 0.09
set format x '%g'
set xlabel 'Distance from the hypocentre along the fault (model units)'
set ylabel 'Slip (model units)'
set yrange [*:*]
unset key
plot 0 with lines lt 8 lw 0.6, lines using ($1 == 4 ? $2 : NaN):3 with histeps lc rgb '#0072B2' lw 1.4 dt 1
unset multiplot
)";

}  // namespace

Figure rupture_detail_figure(const HistoryWindow &window, const Event &event, double p_speed,
                             double s_speed, Table &lines) {
  const FaultGrid &grid = window.info.grid;
  const auto hypocentre =
      static_cast<std::int64_t>(std::floor((event.x_hypocentre - grid.x0) / grid.width));
  // The bin of the hypocentre is in the middle, and x is measured from its centre.
  const std::int64_t half = grid.bins / 2;
  const std::int64_t shift = ((hypocentre - half) % grid.bins + grid.bins) % grid.bins;
  const double x0 = -(static_cast<double>(half) + 0.5) * grid.width;
  Table table("x,time,log10_velocity");
  table.comment(history_comment(window) +
                fmt::format("; rupture {} from its first place {} and time {}", event.id,
                            short_number(event.x_hypocentre, 6), short_number(event.t_start, 8)));
  add_image(table, VelocityImage(window, 600), shift, x0, window.from - event.t_start);
  add_detail_lines(lines, window, event, shift, x0, {p_speed, s_speed});
  const auto wave = [](const char *name, double speed) {
    return quote(fmt::format("{}-wave, speed {}", name, short_number(speed)));
  };
  return {std::move(table),
          std::string(colours) + "lines = base.'-lines.csv'\nset multiplot\n" +
              panel(0.12, 0.83, 0.36, 0.915) + axis("x", "", false, x0, x0 + grid.length()) +
              axis("y", "Time since the rupture began (model units)", false,
                   window.from - event.t_start, window.to - event.t_start) +
              fmt::format(fmt::runtime(detail_panels), wave("P", p_speed), wave("S", s_speed)),
          {900, 900}};
}

namespace {

/// Colours of values from 0 to the largest, readable without colour vision and in print.
constexpr std::string_view map_palette =
    "set palette defined (0 '#ffffff', 1 '#fff3c4', 2 '#fdc86b', 3 '#f3883c', 4 '#c7443c', "
    "5 '#7a1f63', 6 '#1d0b3a')\n";

/// A map of the values of the cells, with the hypocentre. Very large and very small values are
/// drawn as multiples of a power of 1000, as numbers with exponents have no room beside the
/// colours. \param label of the values, in model units \param more elements of the plot command,
/// beginning with a comma
Figure map_figure(const SlipMap &map, const Event &event, const std::vector<double> &values,
                  const std::string &column, const std::string &label, const std::string &settings,
                  const std::string &more = "") {
  Table table("x,z," + column);
  table.comment(fmt::format("rupture {} from its first place {}, {} and time {}: {}", event.id,
                            short_number(map.x_first, 6), short_number(map.z_first, 6),
                            short_number(event.t_start, 8), label));
  for (std::size_t k = 0; k < values.size(); ++k)
    if (std::isnan(values[k]))
      table.row(map.x(k), map.z(k), std::string_view("NaN"));
    else
      table.row(map.x(k), map.z(k), values[k]);
  double most = 0.0;
  for (const double value : values) most = std::fmax(most, value);
  const int power = most > 0.0 ? 3 * static_cast<int>(std::floor(std::log10(most) / 3.0)) : 0;
  const std::string unit = power == 0 ? "model units" : fmt::format("10^{{{}}} model units", power);
  const double length = map.strike.length(), width = map.dip.length();
  // The map fills the room between the axes and the scale of the colours, if it is not very narrow.
  const int height = static_cast<int>(std::clamp(740.0 * width / length, 200.0, 900.0));
  return {
      std::move(table),
      "set datafile columnheaders\nset size ratio -1\nunset grid\nset key off\n" +
          axis("x", "Along strike (model units)", false, map.strike.begin,
               map.strike.begin + length) +
          axis("y", "Along dip, upwards (model units)", false, map.dip.begin,
               map.dip.begin + width) +
          "set cblabel " + quote_plain(label + " (" + unit + ")") + " offset 1\n" + settings +
          fmt::format("plot table using 1:2:($3*1e{}) with image", -power) + more +
          fmt::format(", \\\n     '+' using ({}):({}) every ::::0 with points pt 3 ps 1.6*point "
                      "lw 1.6 lc rgb '#0072B2'\n",
                      text::number(map.x_first), text::number(map.z_first)),
      {1000, height + 160}};
}

/// The first of 1, 2 and 5 times 10^n that divides a length into at most 12 parts.
double contour_spacing(double length) {
  const double least = length / 12.0, ten = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * ten >= least) return digit * ten;
  return 10.0 * ten;
}

}  // namespace

Figure slip_map_figure(const SlipMap &map, const Event &event) {
  return map_figure(map, event, map.slip, "slip", "Slip",
                    std::string(map_palette) + "set cbrange [0:*]\n");
}

Figure rupture_time_figure(const SlipMap &map, const Event &event, Table &lines) {
  double last = 0.0;
  for (const double time : map.time) last = std::fmax(last, time);
  const double spacing = contour_spacing(last > 0.0 ? last : 1.0);
  lines.comment(
      fmt::format("contours of the time since the rupture began, every {}", short_number(spacing)));
  // Each contour has its time where it is farthest along strike.
  std::map<double, std::pair<double, double>> labels;
  for (const ContourPiece &piece : contours(map, map.time, spacing)) {
    lines.row(piece.level, piece.x[0], piece.z[0], piece.x[1], piece.z[1]);
    const auto at = labels.emplace(piece.level, std::make_pair(piece.x[0], piece.z[0])).first;
    for (std::size_t end = 0; end < 2; ++end)
      at->second = std::max(at->second, std::make_pair(piece.x[end], piece.z[end]));
  }
  std::string settings =
      "set palette defined (0 '#f7fbff', 1 '#9ecae1', 2 '#3182bd', 3 '#08306b')\n"
      "set style textbox opaque noborder margins 0.3,0.3\n";
  for (const auto &[level, at] : labels)
    settings += fmt::format("set label {} at {},{} center front boxed\n",
                            quote_plain("{/*0.8 " + short_number(level) + "}"),
                            text::number(at.first), text::number(at.second));
  return map_figure(map, event, map.time, "time", "Time since the rupture began", settings,
                    ", \\\n     base.'-contours.csv' using 2:3:($4-$2):($5-$3) with vectors nohead "
                    "lc rgb '#000000' lw 1 dt 1");
}

Figure slip_rate_figure(const SlipMap &map, const Event &event) {
  return map_figure(map, event, map.rate, "peak_slip_rate", "Largest slip velocity",
                    std::string(map_palette) + "set cbrange [0:*]\n");
}

Figure moment_rate_figure(const SlipMap &map, const Event &event) {
  Table table("time,moment_rate,along_strike,along_dip");
  table.comment(fmt::format("rupture {}: time since it began, {}, moment per time", event.id,
                            short_number(event.t_start, 8)));
  for (const MomentRate &one : map.moment)
    table.row(one.time, one.rate.size(), one.rate.strike, one.rate.dip);
  return {
      std::move(table),
      "set datafile columnheaders\n" +
          axis("x", "Time since the rupture began (model units)", false, 0.0,
               event.t_end - event.t_start) +
          axis("y", "Moment rate (model units)", false, std::numeric_limits<double>::quiet_NaN(),
               std::numeric_limits<double>::quiet_NaN()) +
          "plot table using 1:2 with lines lc rgb '#bbbbbb' lw 5 dt 1 title 'length of both', "
          "\\\n     table using 1:3 with lines lt 1 title 'along strike', \\\n"
          "     table using 1:4 with lines lt 2 title 'along dip'\n",
      {}};
}

}  // namespace LSM::postproc
