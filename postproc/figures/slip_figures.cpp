// SPDX-License-Identifier: GPL-2.0-or-later
#include "slip_figures.h"

#include <algorithm>
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

/// Rows of an image: the largest slip velocity over the driving one in each pixel, as a logarithm.
class Image {
 public:
  Image(const HistoryWindow &window, std::int64_t most_rows)
      : window_(window), bins_(window.info.grid.bins) {
    const double duration = window.info.grid.duration();
    const double intervals = std::max(1.0, std::ceil((window.to - window.from) / duration - 1e-9));
    rows_ = static_cast<std::int64_t>(std::min(intervals, static_cast<double>(most_rows)));
    columns_ = std::min<std::int64_t>(bins_, 1000);
    values_.assign(static_cast<std::size_t>(rows_ * columns_), 0.0);
    for (const SlipRecord &record : window.records) fill(record);
  }

  /// \param shift bins by which the picture is shifted along the fault
  void write(Table &table, std::int64_t shift, double x0, double t0) const {
    const double width = window_.info.grid.length() / static_cast<double>(columns_);
    for (std::int64_t row = 0; row < rows_; ++row)
      for (std::int64_t column = 0; column < columns_; ++column) {
        const std::int64_t from = (column + shift * columns_ / bins_) % columns_;
        const double value = values_[static_cast<std::size_t>(row * columns_ + from)];
        table.row(x0 + (static_cast<double>(column) + 0.5) * width,
                  window_.from - t0 + (static_cast<double>(row) + 0.5) * height(),
                  value > 0.0 ? std::max(0.0, std::log10(value)) : 0.0);
      }
  }

  double height() const { return (window_.to - window_.from) / static_cast<double>(rows_); }

 private:
  void fill(const SlipRecord &record) {
    const FaultGrid &grid = window_.info.grid;
    const double begin = grid.time(record.step_begin), end = grid.time(record.step_end);
    if (!(end > begin)) return;
    const auto row_of = [this](double time) { return (time - window_.from) / height(); };
    const auto first =
        std::max<std::int64_t>(0, static_cast<std::int64_t>(std::floor(row_of(begin) + 1e-6)));
    const auto last = std::min<std::int64_t>(
        rows_ - 1, static_cast<std::int64_t>(std::ceil(row_of(end) - 1e-6)) - 1);
    for (int b = 0; b < bins_; ++b) {
      const double velocity = std::fabs(record.row.slip[static_cast<std::size_t>(b)]) /
                              (end - begin) / window_.info.driving;
      for (std::int64_t row = first; row <= last; ++row) {
        double &value = values_[static_cast<std::size_t>(row * columns_ + b * columns_ / bins_)];
        value = std::max(value, velocity);
      }
    }
  }

  const HistoryWindow &window_;
  std::int64_t bins_, rows_ = 0, columns_ = 0;
  std::vector<double> values_;
};

/// The outline of a rupture as closed lines, split where the picture ends.
/// \param shift bins by which the picture is shifted along the fault
void add_outline(Table &table, const SlipHistoryInfo &info, const Outline &outline,
                 std::int64_t number, std::int64_t shift, double x0, double t0) {
  const FaultGrid &grid = info.grid;
  struct Column {
    std::int64_t place;
    double begin, end;
  };
  std::vector<Column> columns;
  std::pair<std::int64_t, std::int64_t> span = outline.bins.begin()->second;
  const std::int64_t begin = outline.length == grid.bins ? shift : outline.begin;
  for (std::int64_t k = 0; k < outline.length; ++k) {
    const std::int64_t bin = (begin + k) % grid.bins;
    const auto found = outline.bins.find(bin);
    if (found != outline.bins.end()) span = found->second;  // else in a gap: as beside it
    columns.push_back({(bin - shift + grid.bins) % grid.bins, grid.time(span.first) - t0,
                       grid.time(span.second) - t0});
  }
  const auto point = [&](double place, double time) {
    table.row(number, x0 + place * grid.width, time);
  };
  for (std::size_t first = 0; first < columns.size();) {
    std::size_t last = first;
    while (last + 1 < columns.size() && columns[last + 1].place > columns[last].place) ++last;
    for (std::size_t k = first; k <= last; ++k) {
      point(static_cast<double>(columns[k].place), columns[k].begin);
      point(static_cast<double>(columns[k].place + 1), columns[k].begin);
    }
    for (std::size_t k = last + 1; k-- > first;) {
      point(static_cast<double>(columns[k].place + 1), columns[k].end);
      point(static_cast<double>(columns[k].place), columns[k].end);
    }
    point(static_cast<double>(columns[first].place), columns[first].begin);
    break_line(table, 3);
    first = last + 1;
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
  constexpr std::size_t most_outlines = 300;
  const FaultGrid &grid = window.info.grid;
  Figure figure{Table("x,time,log10_velocity"), {}, {1000, 800}};
  figure.table.comment(history_comment(window) +
                       "; the largest slip velocity in each pixel, over the driving velocity");
  Image(window, 700).write(figure.table, 0, grid.x0, 0.0);
  std::int64_t number = 0;
  for (const Outline &outline : window.outlines) {
    if (outlines.rows() > 0 && static_cast<std::size_t>(number) == most_outlines) break;
    add_outline(outlines, window.info, outline, ++number, 0, grid.x0, 0.0);
  }
  outlines.comment(
      fmt::format("outlines of the {} largest of {} ruptures", number, window.outlines.size()));
  figure.script = std::string(colours) +
                  fmt::format(
                      "set xlabel 'Position along the fault (model units)'\n"
                      "set ylabel 'Time (model units)'\n"
                      "set xrange [{}:{}]\nset yrange [{}:{}]\nset format y '%.7g'\n"
                      "set key off\n"
                      "plot table using 1:2:3 with image, \\\n"
                      "     base.'-outlines.csv' using 2:3 with lines lc rgb '#0072B2' lw "
                      "0.8 dt 1\n",
                      text_io::number(grid.x0), text_io::number(grid.x0 + grid.length()),
                      text_io::number(window.from), text_io::number(window.to));
  return figure;
}

Figure slip_lines_figure(const HistoryWindow &window, double locked, double slipping) {
  const FaultGrid &grid = window.info.grid;
  Figure figure{Table("line,time,in_event,x,slip"), {}, {1000, 640}};
  figure.table.comment(history_comment(window) +
                       fmt::format("; slip since then, a line every {} while locked, every {} "
                                   "while anything slips",
                                   short_number(locked), short_number(slipping)));
  std::vector<double> slip(static_cast<std::size_t>(grid.bins), 0.0);
  const double least = slipping_above(grid, window.info.ruptures.velocity);
  std::int64_t line = 0;
  double next_locked = window.from, next_slipping = window.from, highest = 0.0;
  const auto draw = [&](double time, bool in_event) {
    ++line;
    for (int b = 0; b < grid.bins; ++b) {
      const double value = slip[static_cast<std::size_t>(b)];
      highest = std::max(highest, value);
      figure.table.add(line).add(time).add(std::int64_t{in_event}).add(grid.centre(b)).add(value);
      figure.table.end_row();
    }
    break_line(figure.table, 5);
  };
  for (const SlipRecord &record : window.records) {
    bool slips = false;
    for (std::size_t b = 0; b < slip.size(); ++b) {
      slip[b] += static_cast<double>(record.row.slip[b]);
      slips = slips || std::fabs(static_cast<double>(record.row.slip[b])) > least;
    }
    slips = slips && record.step_end - record.step_begin == grid.interval;
    const double time = grid.time(record.step_end);
    if (!slips && time >= next_locked) {
      draw(time, false);
      while (next_locked <= time) next_locked += locked;
    } else if (slips && time >= next_slipping) {
      draw(time, true);
      next_slipping = time + slipping;
    }
  }
  figure.script = fmt::format(
      "set xlabel 'Position along the fault (model units)'\n"
      "set ylabel 'Slip since time {} (model units)'\n"
      "set xrange [{}:{}]\nset yrange [0:{}]\n"
      "plot table using ($3 == 1 ? $4 : NaN):5 with lines lc rgb '#D55E00' lw 0.6 dt 1 title {}, "
      "\\\n"
      "     table using ($3 == 0 ? $4 : NaN):5 with lines lc rgb '#0072B2' lw 1.2 dt 1 title {}\n",
      short_number(window.from, 8), text_io::number(grid.x0),
      text_io::number(grid.x0 + grid.length()),
      text_io::number(highest > 0.0 ? 1.02 * highest : 1.0),
      quote(fmt::format("every {} time units while anything slips", short_number(slipping))),
      quote(fmt::format("every {} time units while the fault is locked", short_number(locked))));
  return figure;
}

Figure rupture_detail_figure(const HistoryWindow &window, const Event &event, double p_speed,
                             double s_speed, Table &lines) {
  const FaultGrid &grid = window.info.grid;
  const auto hypocentre =
      static_cast<std::int64_t>(std::floor((event.x_hypocentre - grid.x0) / grid.width));
  // The hypocentre's bin in the middle; x is relative to its centre.
  const std::int64_t half = grid.bins / 2;
  const std::int64_t shift = ((hypocentre - half) % grid.bins + grid.bins) % grid.bins;
  const double x0 = -(static_cast<double>(half) + 0.5) * grid.width;

  Figure figure{Table("x,time,log10_velocity"), {}, {900, 900}};
  figure.table.comment(history_comment(window) +
                       fmt::format("; rupture {} from its first place {} and time {}", event.id,
                                   short_number(event.x_hypocentre, 6),
                                   short_number(event.t_start, 8)));
  Image(window, 600).write(figure.table, shift, x0, event.t_start);

  // Outline (1), P (2), S (3), and the slip of the event (4).
  for (const Outline &outline : window.outlines)
    if (outline.step_start == event.step_start && outline.step_end == event.step_end &&
        std::fabs(static_cast<double>(outline.length) * grid.width - event.rupture_length) <
            0.5 * grid.width)
      add_outline(lines, window.info, outline, 1, shift, x0, event.t_start);
  const double most = window.to - event.t_start;
  std::int64_t number = 2;
  for (const double speed : {p_speed, s_speed}) {
    const double reach = std::min(0.5 * grid.length(), most * speed);
    for (const double x : {-reach, 0.0, reach}) lines.row(number, x, std::fabs(x) / speed);
    break_line(lines, 3);
    ++number;
  }
  std::vector<double> slip(static_cast<std::size_t>(grid.bins), 0.0);
  for (const SlipRecord &record : window.records)
    if (record.step_begin >= event.step_start && record.step_end <= event.step_end)
      for (std::size_t b = 0; b < slip.size(); ++b)
        slip[b] += static_cast<double>(record.row.slip[b]);
  for (std::int64_t k = 0; k < grid.bins; ++k)
    lines.row(4, x0 + (static_cast<double>(k) + 0.5) * grid.width,
              slip[static_cast<std::size_t>((k + shift) % grid.bins)]);
  lines.comment(
      "curve 1: outline; 2: P-wave, 3: S-wave from the first place (x, time); 4: slip from "
      "beginning to end of the rupture (x, slip)");

  figure.script =
      std::string(colours) +
      fmt::format(
          R"(lines = base.'-lines.csv'
set multiplot
set lmargin at screen 0.12
set rmargin at screen 0.83
set xrange [{x0}:{x1}]
set tmargin at screen 0.915
set bmargin at screen 0.36
set format x ''
set ylabel 'Time since its beginning (model units)'
set yrange [{t0}:{t1}]
set key at screen 0.47,0.985 center top horizontal maxcols 2
plot table using 1:2:3 with image notitle, \
     lines using ($1 == 1 ? $2 : NaN):3 with lines lc rgb '#0072B2' lw 1 dt 1 title 'rupture', \
     lines using ($1 == 2 ? $2 : NaN):3 with lines lc rgb '#000000' lw 1.6 dt 1 title {p}, \
     lines using ($1 == 3 ? $2 : NaN):3 with lines lc rgb '#009E73' lw 1.8 dt (6,4) title {s}
set tmargin at screen 0.33
set bmargin at screen 0.09
set format x '%g'
set xlabel 'Distance from the hypocentre along the fault (model units)'
set ylabel 'Slip (model units)'
set yrange [*:*]
unset key
plot 0 with lines lt 8 lw 0.6, lines using ($1 == 4 ? $2 : NaN):3 with histeps lc rgb '#0072B2' lw 1.4 dt 1
unset multiplot
)",
          fmt::arg("x0", text_io::number(x0)), fmt::arg("x1", text_io::number(x0 + grid.length())),
          fmt::arg("t0", text_io::number(window.from - event.t_start)),
          fmt::arg("t1", text_io::number(most)),
          fmt::arg("p", quote(fmt::format("P-wave, speed {}", short_number(p_speed)))),
          fmt::arg("s", quote(fmt::format("S-wave, speed {}", short_number(s_speed)))));
  return figure;
}

}  // namespace LSM::postproc
