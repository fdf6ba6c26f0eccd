// SPDX-License-Identifier: GPL-2.0-or-later
#include "slip_figures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "lsm_text_io.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

/// A row that ends a line: gnuplot ignores empty fields and would continue it.
void break_line(Table &table, int columns) {
  for (int k = 0; k < columns; ++k) table.add(std::string_view("NaN"));
  table.end_row();
}

constexpr std::string_view colours = R"(set datafile columnheaders
set palette defined (0 '#ffffff', 0.5 '#fff3c4', 1 '#fdc86b', 1.5 '#f3883c', 2 '#c7443c', 2.5 '#7a1f63', 3 '#1d0b3a')
set cbrange [0:3]
set cbtics ('1' 0, '10' 1, '100' 2, '1000' 3)
set cblabel 'Slip velocity / driving velocity'
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

/// Lines over the picture of one rupture that begins in the middle bin: its outline (1), P (2) and
/// S (3), and its slip (4).
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
  // The hypocentre's bin in the middle; x is relative to its centre.
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
              axis("y", "Time since its beginning (model units)", false,
                   window.from - event.t_start, window.to - event.t_start) +
              fmt::format(fmt::runtime(detail_panels), wave("P", p_speed), wave("S", s_speed)),
          {900, 900}};
}

}  // namespace LSM::postproc
