// SPDX-License-Identifier: GPL-2.0-or-later
#include "rupture_figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "input_file.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A row that ends a line: gnuplot draws on over fields that are empty.
void break_line(Table &table, int columns) {
  for (int k = 0; k < columns; ++k) table.add(std::string_view("NaN"));
  table.end_row();
}

double drop_of(const Event &event) { return event.pe_start - event.pe_end; }

std::string line_of(const LogFit &fit, const std::string &colour, const std::string &title) {
  return fmt::format("10**({} + {} * log10(x)) with lines lc rgb '{}' lw 1.6 dt 1 title {}",
                     text_io::number(fit.intercept), text_io::number(fit.slope), colour,
                     quote(title));
}

std::string fit_text(const LogFit &fit, const std::string &what) {
  return fmt::format("{}: slope {}, scatter {} decades (n = {})", what,
                     with_error(fit.slope, fit.slope_error, " ± "), short_number(fit.scatter, 2),
                     fit.n);
}

/// The same for a legend, which has less room.
std::string short_fit_text(const LogFit &fit, const std::string &what) {
  return fmt::format("{}: slope {}", what, with_error(fit.slope, fit.slope_error, " ± "));
}

/// Adds the columns that say which event of which catalogue a row is.
void add_event(Table &table, std::size_t curve, const RuptureTable &of, const Event &event) {
  table.add(static_cast<std::int64_t>(curve + 1)).add(of.head.label).add(event.id);
}

/// Which ruptures a scatter shows. Of very many that is the largest and some of the others:
/// pictures of a million points take minutes to draw and to look at.
class Shown {
 public:
  explicit Shown(const RuptureTable &of) : events_(of.events) {
    step_ = std::max<std::size_t>(1, (events_.size() + most - 1) / most);
    if (step_ == 1) return;
    std::vector<double> moments;
    for (const Event &event : events_) moments.push_back(event.slip_moment);
    std::nth_element(moments.begin(), moments.begin() + largest - 1, moments.end(),
                     std::greater<double>());
    large_ = moments[largest - 1];
  }
  bool operator()(std::size_t i) const {
    return i % step_ == 0 || events_[i].slip_moment >= large_;
  }
  /// For legends and tables, "" if all are shown.
  std::string text() const {
    if (step_ == 1) return {};
    return fmt::format(", shown: the largest {} and one of {}", largest, step_);
  }

 private:
  static constexpr std::size_t most = 20000, largest = 1000;

  const std::vector<Event> &events_;
  std::size_t step_ = 1;
  double large_ = 0.0;
};

/// Scatter of one curve per catalogue, from the columns x and y of the table. The curves are drawn
/// in turns, a fifth of each at a time, so that none hides the others.
std::string points(const std::vector<RuptureTable> &tables, int x, int y) {
  std::string out;
  const std::size_t layers = tables.size() > 1 ? 5 : 1;
  for (std::size_t layer = 0; layer < layers; ++layer)
    for (std::size_t k = 0; k < tables.size(); ++k)
      out += fmt::format(
          "{}table every {}::{} using ($1 == {} ? ${} : NaN):{} with points lt {} ps 0.6*point "
          "notitle",
          out.empty() ? "" : ", \\\n     ", layers, layer, k + 1, x, y, k % 16 + 1);
  for (std::size_t k = 0; k < tables.size(); ++k)
    out += fmt::format(", \\\n     keyentry with points lt {} title {}", k % 16 + 1,
                       quote(fmt::format("{} ({} ruptures{})", tables[k].head.label,
                                         tables[k].events.size(), Shown(tables[k]).text())));
  return out;
}

std::vector<std::string> titles_of(const std::vector<RuptureTable> &tables, std::size_t more) {
  std::vector<std::string> titles(more, std::string(60, ' '));
  for (const RuptureTable &table : tables)
    titles.push_back(table.head.label + " (10000 ruptures)" + Shown(table).text());
  return titles;
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
        table.add(x0 + (static_cast<double>(column) + 0.5) * width)
            .add(window_.from - t0 + (static_cast<double>(row) + 0.5) * height())
            .add(value > 0.0 ? std::max(0.0, std::log10(value)) : 0.0)
            .end_row();
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
    table.add(number).add(x0 + place * grid.width).add(time).end_row();
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

LogFit fit_logarithms(const std::vector<std::pair<double, double>> &points) {
  LogFit fit;
  fit.n = static_cast<std::int64_t>(points.size());
  const auto n = static_cast<double>(points.size());
  double mx = 0.0, my = 0.0;
  for (const auto &[x, y] : points) {
    mx += std::log10(x) / n;
    my += std::log10(y) / n;
  }
  double xx = 0.0, xy = 0.0, dd = 0.0;
  for (const auto &[x, y] : points) {
    const double u = std::log10(x) - mx, v = std::log10(y) - my;
    xx += u * u;
    xy += u * v;
    dd += (v - u) * (v - u);
  }
  if (points.size() < 3 || !(xx > 1e-12 * n))
    throw std::runtime_error(fmt::format(
        "{} ruptures for a fit, expected at least 3 of different sizes", points.size()));
  fit.slope = xy / xx;
  fit.intercept = my - fit.slope * mx;
  double rest = 0.0;
  for (const auto &[x, y] : points) {
    const double off = std::log10(y) - fit.intercept - fit.slope * std::log10(x);
    rest += off * off;
  }
  fit.scatter = std::sqrt(rest / n);
  fit.slope_error = std::sqrt(rest / (n - 2.0) / xx);
  fit.ratio = std::pow(10.0, my - mx);
  fit.ratio_scatter = std::sqrt(dd / n);
  return fit;
}

std::vector<bool> slips_by_itself(const std::vector<Event> &events) {
  std::vector<std::size_t> order(events.size());
  double longest = 0.0;
  for (std::size_t k = 0; k < events.size(); ++k) {
    order[k] = k;
    longest = std::max(longest, events[k].t_end - events[k].t_start);
  }
  std::sort(order.begin(), order.end(), [&events](std::size_t a, std::size_t b) {
    return events[a].t_start < events[b].t_start;
  });
  std::vector<bool> alone(events.size());
  std::size_t first = 0;
  for (const std::size_t k : order) {
    const Event &e = events[k];
    while (events[order[first]].t_start < e.t_start - longest) ++first;
    double others = 0.0;
    for (std::size_t m = first; m < order.size() && events[order[m]].t_start < e.t_end; ++m)
      if (order[m] != k && events[order[m]].t_end > e.t_start)
        others += std::fabs(events[order[m]].slip_moment);
    alone[k] = others < 0.1 * std::fabs(e.slip_moment);
  }
  return alone;
}

Figure moment_length_figure(const std::vector<RuptureTable> &tables) {
  Figure figure{
      Table({"catalogue", "label", "event_id", "length", "moment", "whole_fault"}), {}, {}};
  figure.table.comment(
      "Ruptures: slip moment (shear modulus x slip x length) against length; "
      "whole_fault: 1 where the whole fault slipped");
  Extent lengths, moments;
  std::vector<std::pair<double, double>> fitted;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const double whole = tables[k].head.length();
    const Shown shown(tables[k]);
    for (std::size_t n = 0; n < tables[k].events.size(); ++n) {
      const Event &e = tables[k].events[n];
      if (!(e.slip_moment > 0.0)) continue;
      const bool all = e.rupture_length > whole * (1.0 - 1e-9);
      if (shown(n)) {
        add_event(figure.table, k, tables[k], e);
        figure.table.add(e.rupture_length).add(e.slip_moment).add(std::int64_t{all}).end_row();
      }
      lengths.add(e.rupture_length);
      moments.add(e.slip_moment);
      if (!all) fitted.emplace_back(e.rupture_length, e.slip_moment);
    }
  }
  if (lengths.empty()) throw std::runtime_error("nothing to draw, no rupture of positive moment");
  figure.size = size_with_key(titles_of(tables, 2));
  figure.script = axis("x", "Length of the rupture (model units)", true, lengths.lo, lengths.hi) +
                  axis("y", "Slip moment (model units)", true, moments.lo, moments.hi) + "plot " +
                  points(tables, 4, 5);
  const LogFit fit = fit_logarithms(fitted);
  const std::string text = fit_text(fit, "fit, without those of the whole fault");
  figure.table.comment(text);
  figure.script += ", \\\n     " +
                   line_of(fit, "#000000", short_fit_text(fit, "fit, whole fault excluded")) +
                   fmt::format(
                       ", \\\n     {} * x**2 with lines lc rgb '#777777' dt (4,4) title "
                       "'slope 2: constant stress drop'\n",
                       text_io::number(std::pow(10.0, fit.intercept + fit.slope * 1.0) / 100.0));
  return figure;
}

Figure moment_pe_figure(const std::vector<RuptureTable> &tables) {
  Figure figure{Table({"catalogue", "label", "event_id", "moment", "pe_drop", "alone"}), {}, {}};
  figure.table.comment(
      "Ruptures: drop of the total PE from begin to end against slip moment; alone: "
      "1 where the others at the same time have less than a tenth of its moment");
  Extent moments, drops;
  std::vector<std::pair<double, double>> alone, all;
  std::int64_t negative = 0;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const std::vector<bool> is_alone = slips_by_itself(tables[k].events);
    const Shown shown(tables[k]);
    for (std::size_t n = 0; n < tables[k].events.size(); ++n) {
      const Event &e = tables[k].events[n];
      if (!(e.slip_moment > 0.0)) continue;
      if (shown(n)) {
        add_event(figure.table, k, tables[k], e);
        figure.table.add(e.slip_moment).add(drop_of(e)).add(std::int64_t{is_alone[n]}).end_row();
      }
      if (!(drop_of(e) > 0.0)) {
        ++negative;
        continue;
      }
      moments.add(e.slip_moment);
      drops.add(drop_of(e));
      all.emplace_back(e.slip_moment, drop_of(e));
      if (is_alone[n]) alone.emplace_back(e.slip_moment, drop_of(e));
    }
  }
  if (moments.empty())
    throw std::runtime_error("nothing to draw, no rupture of positive moment during which PE fell");
  const auto describe = [&figure](const LogFit &fit, const std::string &what) {
    figure.table.comment(fit_text(fit, what) +
                         fmt::format("; if proportional: ratio {}, scatter {} decades",
                                     short_number(fit.ratio, 3),
                                     short_number(fit.ratio_scatter, 2)));
  };
  figure.table.comment(fmt::format("PE rose during {} of {} ruptures, which are not drawn",
                                   negative, negative + static_cast<std::int64_t>(all.size())));
  const LogFit fit_all = fit_logarithms(all);
  describe(fit_all, "fit of all");
  figure.size = size_with_key(titles_of(tables, 4));
  figure.script = axis("x", "Slip moment (model units)", true, moments.lo, moments.hi) +
                  axis("y", "Drop of the total PE (model units)", true, drops.lo, drops.hi) +
                  "plot " + points(tables, 4, 5) +
                  ", \\\n     table using ($6 == 1 && $5 > 0 ? $4 : NaN):5 with points pt 6 ps "
                  "1.5*point lc rgb '#000000' title 'isolated in time', \\\n     " +
                  line_of(fit_all, "#777777", short_fit_text(fit_all, "all"));
  const LogFit *proportional = &fit_all;
  LogFit fit_alone;
  if (alone.size() >= 3) {
    fit_alone = fit_logarithms(alone);
    describe(fit_alone, "fit of those isolated in time");
    figure.script +=
        ", \\\n     " + line_of(fit_alone, "#000000", short_fit_text(fit_alone, "isolated"));
    proportional = &fit_alone;
  }
  figure.script += fmt::format(
      ", \\\n     {} * x with lines lc rgb '#D55E00' dt (6,4) title {}\n",
      text_io::number(proportional->ratio),
      quote(fmt::format("proportional: {} x moment", short_number(proportional->ratio, 2))));
  return figure;
}

Figure stress_drop_figure(const std::vector<RuptureTable> &tables) {
  Figure figure{
      Table({"catalogue", "label", "event_id", "moment", "stress_drop", "mean", "error"}), {}, {}};
  figure.table.comment(
      "Ruptures: mean stress drop against slip moment. Rows without event_id: means "
      "over two bins of the moment per decade, with their standard errors");
  Extent moments, drops;
  std::string means;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    struct Sums {
      double n = 0.0, y = 0.0, yy = 0.0;
    };
    std::map<long, Sums> bins;
    const Shown shown(tables[k]);
    for (std::size_t n = 0; n < tables[k].events.size(); ++n) {
      const Event &e = tables[k].events[n];
      if (!(e.slip_moment > 0.0)) continue;
      if (shown(n)) {
        add_event(figure.table, k, tables[k], e);
        figure.table.add(e.slip_moment).add(e.stress_drop).add(nan).add(nan).end_row();
      }
      moments.add(e.slip_moment);
      drops.add(e.stress_drop);
      Sums &bin = bins[std::lround(std::floor(2.0 * std::log10(e.slip_moment)))];
      bin.n += 1.0;
      bin.y += e.stress_drop;
      bin.yy += e.stress_drop * e.stress_drop;
    }
    for (const auto &[bin, s] : bins) {
      if (s.n < 3.0) continue;
      const double mean = s.y / s.n;
      const double variance = std::max(0.0, s.yy / s.n - mean * mean);
      figure.table.add(static_cast<std::int64_t>(k + 1)).add(tables[k].head.label).add(nan);
      figure.table.add(std::pow(10.0, 0.5 * (static_cast<double>(bin) + 0.5))).add(nan);
      figure.table.add(mean).add(std::sqrt(variance / (s.n - 1.0))).end_row();
    }
    means += fmt::format(
        ", \\\n     table using ($1 == {0} && $6 == $6 ? $4 : NaN):6 with lines lc "
        "rgb '#000000' lw 1.6 {1}, \\\n     table using ($1 == {0} ? $4 : "
        "NaN):($6-$7):(0):(2*$7) with vectors nohead lc rgb '#000000' lw 1.2 notitle",
        k + 1, k == 0 ? "title 'means of half decades'" : "notitle");
  }
  if (moments.empty()) throw std::runtime_error("nothing to draw, no rupture of positive moment");
  drops.add(0.0);
  const double room = 0.05 * (drops.hi - drops.lo);
  figure.size = size_with_key(titles_of(tables, 1));
  figure.script =
      axis("x", "Slip moment (model units)", true, moments.lo, moments.hi) +
      axis("y", "Mean stress drop (model units)", false, drops.lo - room, drops.hi + room) +
      "plot 0 with lines lt 8 lw 0.6 notitle, \\\n     " + points(tables, 4, 5) + means + "\n";
  return figure;
}

void Outline::absorb(const Outline &later) {
  slip += later.slip;
  for (const auto &[bin, span] : later.bins) {
    const auto [at, added] = bins.emplace(bin, span);
    if (added) continue;
    at->second.first = std::min(at->second.first, span.first);
    at->second.second = std::max(at->second.second, span.second);
  }
}

HistoryWindow load_history(const std::string &path, bool lenient, double from, double to) {
  SlipHistoryReader reader(path, lenient, open_input);
  HistoryWindow window;
  window.info = reader.info();
  if (reader.torn()) fmt::print(stderr, "postproc: {}: dropped a truncated last record: 1\n", path);
  const FaultGrid &grid = window.info.grid;
  if (!(window.info.driving > 0.0))
    throw std::runtime_error(path + ": the driving velocity in the header is not positive");
  const double least = slipping_above(grid, window.info.ruptures.velocity);
  SlipSets<Outline> sets(grid.bins, window.info.ruptures.gap + 1, window.info.ruptures.memory);
  const auto keep = [&window, &grid](const Outline &found) {
    Outline outline = found;
    outline.step_start = grid.step0 + found.step_start * grid.interval;
    outline.step_end = grid.step0 + found.step_end * grid.interval;
    for (auto &bin : outline.bins) {
      bin.second.first = grid.step0 + (bin.second.first - 1) * grid.interval;
      bin.second.second = grid.step0 + bin.second.second * grid.interval;
    }
    window.outlines.push_back(std::move(outline));
  };
  const auto nothing = [](Outline &) {};
  SlipRecord record;
  std::int64_t last = 0;
  while (reader.next(record)) {
    if (grid.time(record.step_end) < from) continue;
    if (grid.time(record.step_begin) > to) break;
    window.records.push_back(record);
    last = (record.step_end - grid.step0) / grid.interval;
    if (record.step_end - record.step_begin != grid.interval) continue;  // nothing slips in others
    sets.begin_step(last);
    for (int b = 0; b < grid.bins; ++b) {
      const double slip = record.row.slip[static_cast<std::size_t>(b)];
      if (!(std::fabs(slip) > least)) continue;
      Outline &outline = sets.slide(b, nothing);
      outline.slip += slip;
      outline.bins.emplace(b, std::make_pair(last, last)).first->second.second = last;
    }
    sets.end_step(nothing, keep);
  }
  // Open ones as well: a picture shows what there is.
  sets.begin_step(last + window.info.ruptures.memory + 1);
  sets.end_step(nothing, keep);
  if (window.records.empty() || window.records.front().step_begin == window.records.back().step_end)
    throw std::runtime_error(path + ": nothing in the window of time");
  window.from = std::max(from, grid.time(window.records.front().step_begin));
  window.to = std::min(to, grid.time(window.records.back().step_end));
  std::stable_sort(window.outlines.begin(), window.outlines.end(),
                   [](const Outline &a, const Outline &b) { return a.slip > b.slip; });
  return window;
}

Figure space_time_figure(const HistoryWindow &window, Table &outlines) {
  constexpr std::size_t most_outlines = 300;
  const FaultGrid &grid = window.info.grid;
  Figure figure{Table({"x", "time", "log10_velocity"}), {}, {1000, 800}};
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
  Figure figure{Table({"line", "time", "in_event", "x", "slip"}), {}, {1000, 640}};
  figure.table.comment(history_comment(window) +
                       fmt::format("; slip since then, a line each {} while locked, each {} while "
                                   "anything slips",
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
      quote(fmt::format("each {} time units while anything slips", short_number(slipping))),
      quote(fmt::format("each {} time units while the fault is locked", short_number(locked))));
  return figure;
}

Figure rupture_detail_figure(const HistoryWindow &window, const Event &event, double p_speed,
                             double s_speed, Table &lines) {
  const FaultGrid &grid = window.info.grid;
  const auto hypocentre =
      static_cast<std::int64_t>(std::floor((event.x_hypocentre - grid.x0) / grid.width));
  // The hypocentre's bin in the middle; x is reckoned from its centre.
  const std::int64_t half = grid.bins / 2;
  const std::int64_t shift = ((hypocentre - half) % grid.bins + grid.bins) % grid.bins;
  const double x0 = -(static_cast<double>(half) + 0.5) * grid.width;

  Figure figure{Table({"x", "time", "log10_velocity"}), {}, {900, 900}};
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
    for (const double x : {-reach, 0.0, reach})
      lines.add(number).add(x).add(std::fabs(x) / speed).end_row();
    break_line(lines, 3);
    ++number;
  }
  std::vector<double> slip(static_cast<std::size_t>(grid.bins), 0.0);
  for (const SlipRecord &record : window.records)
    if (record.step_begin >= event.step_start && record.step_end <= event.step_end)
      for (std::size_t b = 0; b < slip.size(); ++b)
        slip[b] += static_cast<double>(record.row.slip[b]);
  for (std::int64_t k = 0; k < grid.bins; ++k)
    lines.add(std::int64_t{4})
        .add(x0 + (static_cast<double>(k) + 0.5) * grid.width)
        .add(slip[static_cast<std::size_t>((k + shift) % grid.bins)])
        .end_row();
  lines.comment(
      "curve 1: outline; 2: P-wave, 3: S-wave from the first place (x, time); 4: slip "
      "between begin and end of the rupture (x, slip)");

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
