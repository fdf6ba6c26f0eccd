// SPDX-License-Identifier: GPL-2.0-or-later
#include "size_densities.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "lsm_text_io.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

struct Curve {
  std::string title;
  std::vector<LogBin> bins;
};

}  // namespace

Figure size_density_figure(const std::vector<EventTable> &tables,
                           const SizeDensitySettings &settings, std::vector<std::string> &empty) {
  for (const EventTable &table : tables)
    if (const double lo = settings.threshold.of(table); !(lo >= 0.0) || !(settings.upto > lo))
      throw std::invalid_argument(
          fmt::format("sizes from {} to {}: expected 0 <= lower end < upper end",
                      text(settings.threshold.in(table)), settings.upto));
  // Labels may contain commas, so they come last: awk -F, finds the numbers without them.
  Figure figure{Table({"curve", "model", "length", "bin_lo", "bin_hi", "size", "count",
                       settings.counts ? "events" : "density", "error", "label"}),
                {},
                {}};
  figure.table.comment(
      "units: sizes in model energy, densities in 1 / model energy; errors: Poisson");
  for (const std::string &line : texts(settings.threshold, tables)) figure.table.comment(line);

  std::vector<Curve> curves;
  std::vector<std::size_t> catalogues;  // index of each curve's table
  Extent sizes, heights;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const EventTable &table = tables[i];
    const LogHistogram histogram(column(table.events, &Event::size), settings.factor);
    // The range applies to the sizes as they are in the catalogue.
    Curve curve{{}, histogram.bins(settings.threshold.of(table), settings.upto)};
    std::int64_t events = 0;
    for (LogBin &bin : curve.bins) {
      events += bin.count;
      if (settings.counts) {
        bin.density = static_cast<double>(bin.count);
        bin.error = std::sqrt(bin.density);
      }
    }
    if (curve.bins.empty()) {
      empty.push_back(table.label);
      continue;
    }
    curve.title = fmt::format("{} ({} events)", table.label, events);
    curves.push_back(std::move(curve));
    catalogues.push_back(i);
    for (const LogBin &bin : curves.back().bins) {
      figure.table.add(static_cast<std::int64_t>(curves.size()))
          .add(table.info.model)
          .add(table.length());
      add_bin(figure.table, bin);
      figure.table.add(table.label).end_row();
      if (bin.count == 0) continue;
      sizes.add(bin.lo);
      sizes.add(bin.hi);
      heights.add(bin.density);
    }
  }
  if (curves.empty()) {
    double least = std::numeric_limits<double>::infinity();
    for (const EventTable &table : tables) least = std::min(least, settings.threshold.of(table));
    throw std::runtime_error(fmt::format(
        "no event of size {} or larger in any catalogue, nothing to draw", short_number(least)));
  }

  const std::string x_label = "event size s (energy, model units)";
  const std::string y_label =
      settings.counts ? "events per bin" : "probability density p(s) (1 / energy)";

  std::string plots;
  std::vector<std::string> titles;
  const auto add_plot = [&plots](const std::string &what) {
    plots += (plots.empty() ? "plot " : ", \\\n     ") + what;
  };
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto number = static_cast<std::int64_t>(i + 1);
    add_plot(error_bars(fmt::format("row({})", number), "$8", "$9", number));
    // Together, `with linespoints` would surround each point with white in an SVG.
    add_plot(fmt::format("table using (row({0})):8 with lines lt {0} lw 1.2 notitle", number));
    add_plot(fmt::format("table using (row({0})):8 with points lt {0} notitle", number));
    add_plot(
        fmt::format("keyentry with linespoints lt {} title {}", number, quote(curves[i].title)));
    titles.push_back(curves[i].title);
  }
  double top = heights.hi;
  for (PowerLine line : settings.lines) {
    if (std::isnan(line.lo)) line.lo = sizes.lo;
    if (std::isnan(line.hi)) line.hi = sizes.hi;
    if (std::isnan(line.amplitude)) {
      line.amplitude = 0.0;
      for (const Curve &curve : curves)
        for (const LogBin &bin : curve.bins)
          if (bin.centre >= line.lo && bin.centre <= line.hi)
            line.amplitude =
                std::max(line.amplitude, 2.0 * bin.density * std::pow(bin.centre, -line.slope));
      if (line.amplitude == 0.0) continue;
    }
    for (const double end : {line.lo, line.hi})
      top = std::max(top, line.amplitude * std::pow(end, line.slope));
    // Colours go by the curves that are drawn.
    const auto curve = std::find(catalogues.begin(), catalogues.end(), line.catalogue);
    const auto line_type = curve == catalogues.end() ? 8 : curve - catalogues.begin() + 1;
    add_plot(fmt::format("[{}:{}] '+' using 1:({}*$1**({})) with lines lt {} dt {} lw 2.2 {}",
                         text_io::number(line.lo), text_io::number(line.hi),
                         text_io::number(line.amplitude), text_io::number(line.slope), line_type,
                         line.dash, line.title.empty() ? "notitle" : "title " + quote(line.title)));
    if (!line.title.empty()) titles.push_back(line.title);
  }
  figure.size = size_with_key(titles, settings.width);
  figure.script = axis("x", x_label, true, sizes.lo, sizes.hi) +
                  axis("y", y_label, true, 0.3 * heights.lo, top) +
                  "row(k) = $1 == k && $7 > 0 ? $6 : NaN\n" + std::string(error_bar_function) +
                  plots + "\n";
  return figure;
}

}  // namespace LSM::postproc
