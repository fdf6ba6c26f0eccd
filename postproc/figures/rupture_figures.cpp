// SPDX-License-Identifier: GPL-2.0-or-later
#include "rupture_figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "numbers.h"

namespace LSM::postproc {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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
void add_event(Table &table, std::size_t curve, const EventTable &of, const Event &event) {
  table.add(static_cast<std::int64_t>(curve + 1)).add(of.label).add(event.id);
}

/// Which ruptures a scatter shows. Of very many that is the largest and some of the others:
/// pictures of a million points take minutes to draw and to look at.
class Shown {
 public:
  explicit Shown(const EventTable &of) : events_(of.events) {
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
std::string points(const std::vector<EventTable> &tables, int x, int y) {
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
                       quote(fmt::format("{} ({} ruptures{})", tables[k].label,
                                         tables[k].events.size(), Shown(tables[k]).text())));
  return out;
}

std::vector<std::string> titles_of(const std::vector<EventTable> &tables, std::size_t more) {
  std::vector<std::string> titles(more, std::string(60, ' '));
  for (const EventTable &table : tables)
    titles.push_back(table.label + " (10000 ruptures)" + Shown(table).text());
  return titles;
}

/// Moment of a rupture of one bin that slips at the threshold velocity for one interval: modulus,
/// slip velocity, time and width; 0 if the header lacks any of them.
double smallest_moment(const CatalogueInfo &info) {
  double moment = 1.0;
  for (const char *const key : {"modulus", "slip_velocity", "interval", "dt", "slip_bin"}) {
    const std::string *const text = info.find(key);
    double value = 0.0;
    if (!text || !text_io::parse(*text, value) || !(value > 0.0)) return 0.0;
    moment *= value;
  }
  return moment;
}

}  // namespace

Figure rupture_density_figure(const std::vector<EventTable> &tables, RuptureQuantity quantity) {
  const bool length = quantity == RuptureQuantity::length;
  Figure figure{Table("curve,length,bin_lo,bin_hi,centre,count,density,error,label"), {}, {}};
  figure.table.comment(
      fmt::format("Ruptures per unit of model time, length of the fault and {}; "
                  "errors: Poisson",
                  length ? "length of the rupture" : "slip moment"));
  Extent values, heights;
  std::string plots;
  std::vector<std::string> titles;
  std::int64_t number = 0;
  for (const EventTable &table : tables) {
    const std::vector<LogBin> bins = rupture_densities(table, quantity);
    if (bins.empty()) continue;
    ++number;
    std::int64_t count = 0;
    for (const LogBin &bin : bins) {
      figure.table.add(number).add(table.length());
      add_bin(figure.table, bin);
      figure.table.add(table.label).end_row();
      count += bin.count;
      if (bin.count == 0) continue;
      values.add(bin.centre);
      heights.add(bin.density);
    }
    titles.push_back(fmt::format("{} ({} ruptures)", table.label, count));
    const std::string row = fmt::format("row({})", number);
    plots += fmt::format("{0}{1}, \\\n     table using ({2}):7 with points lt {3} title {4}",
                         plots.empty() ? "plot " : ", \\\n     ",
                         error_bars(row, "$7", "$8", number), row, number, quote(titles.back()));
  }
  if (number == 0) throw std::runtime_error("no ruptures in any catalogue, nothing to draw");
  const double limit = length ? 0.0 : smallest_moment(tables.front().info);
  if (limit > values.lo) {
    plots += fmt::format(
        ", \\\n     '+' using ({0}):({1}):(0):({2}) every ::::0 with vectors nohead lc rgb "
        "'#777777' lw 1.6 dt (6,4) notitle, \\\n     keyentry with lines lc rgb '#777777' lw 1.6 "
        "dt "
        "(6,4) title 'detection limit: one bin in one interval'",
        text_io::number(limit), text_io::number(heights.lo),
        text_io::number(heights.hi - heights.lo));
    titles.emplace_back("detection limit: one bin in one interval");
    figure.table.comment(fmt::format("detection limit, one bin in one interval: {}", limit));
  }
  figure.size = size_with_key(titles);
  figure.script =
      axis("x", length ? "Length of the rupture (model units)" : "Slip moment (model units)", true,
           values.lo, values.hi) +
      axis("y",
           length ? "Ruptures per time, fault length and length"
                  : "Ruptures per time, fault length and moment",
           true, heights.lo, heights.hi) +
      "row(k) = $1 == k && $6 > 0 ? $5 : NaN\n" + std::string(error_bar_function) + plots + "\n";
  return figure;
}

Figure moment_length_figure(const std::vector<EventTable> &tables) {
  Figure figure{Table("catalogue,label,event_id,length,moment,whole_fault"), {}, {}};
  figure.table.comment(
      "Ruptures: slip moment (shear modulus x slip x length) against length; "
      "whole_fault: 1 where the whole fault slipped");
  Extent lengths, moments;
  std::vector<std::pair<double, double>> fitted;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const double whole = tables[k].length();
    const Shown shown(tables[k]);
    for (std::size_t n = 0; n < tables[k].events.size(); ++n) {
      const Event &e = tables[k].events[n];
      if (!(e.slip_moment > 0.0)) continue;
      const bool all = e.rupture_length > whole * (1.0 - 1e-9);
      if (shown(n)) {
        add_event(figure.table, k, tables[k], e);
        figure.table.row(e.rupture_length, e.slip_moment, all);
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

Figure moment_pe_figure(const std::vector<EventTable> &tables) {
  Figure figure{Table("catalogue,label,event_id,moment,pe_drop,alone"), {}, {}};
  figure.table.comment(
      "Ruptures: drop of the total PE from beginning to end against slip moment; alone: 1 if the "
      "others at the same time have less than a tenth of its moment");
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
        figure.table.row(e.slip_moment, drop_of(e), is_alone[n]);
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

Figure stress_drop_figure(const std::vector<EventTable> &tables) {
  Figure figure{Table("catalogue,label,event_id,moment,stress_drop,mean,error"), {}, {}};
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
        figure.table.row(e.slip_moment, e.stress_drop, nan, nan);
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
      figure.table.row(k + 1, tables[k].label, nan,
                       std::pow(10.0, 0.5 * (static_cast<double>(bin) + 0.5)), nan, mean,
                       std::sqrt(variance / (s.n - 1.0)));
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

}  // namespace LSM::postproc
