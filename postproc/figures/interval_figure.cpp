// SPDX-License-Identifier: GPL-2.0-or-later
#include "interval_figure.h"

#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "lsm_text_io.h"
#include "numbers.h"

namespace LSM::postproc {

Figure interval_figure(const std::vector<IntervalCurve> &curves, bool rescaled, int width) {
  Figure figure{
      Table("curve,model,threshold,bin_lo,bin_hi,theta,count,density,error,label"), {}, {}};
  figure.table.comment(
      rescaled
          ? "inter-event times from start to start, divided by their mean"
          : "inter-event times from start to start in model time (earthquakes: days), densities "
            "in 1 / model time; errors: Poisson");
  std::set<std::string> sources;
  for (const IntervalCurve &curve : curves)
    sources.insert(curve.earthquakes ? curve.from() : "sizes >= " + text(curve.threshold));
  for (const std::string &source : sources) figure.table.comment(source);
  std::string points, lines;
  std::vector<std::string> titles;
  Extent range, heights;
  std::set<double> thresholds;
  for (const IntervalCurve &curve : curves) thresholds.insert(curve.threshold.size);
  std::int64_t number = 0;
  bool any_accepted = false, any_rejected = false;
  for (const IntervalCurve &curve : curves) {
    if (curve.bins.empty()) continue;
    ++number;
    for (const LogBin &bin : curve.bins) {
      figure.table.add(number).add(curve.model).add(curve.threshold.size);
      add_bin(figure.table, bin);
      figure.table.add(curve.label).end_row();
      if (bin.count == 0) continue;
      heights.add(bin.density);
      range.add(bin.lo);
      range.add(bin.hi);
    }
    std::string title = curve.label;
    if (thresholds.size() > 1) title += ", " + curve.from();
    const std::string row = fmt::format("row({})", number);
    points += fmt::format(
        "{0}{1}, \\\n     table using ({2}):8 with points lt {3} notitle, \\\n"
        "     keyentry with linespoints lt {3} title {4}",
        points.empty() ? "plot " : ", \\\n     ", error_bars(row, "$8", "$9", number), row, number,
        quote(fmt::format("{} ({} times)", title, curve.n)));
    titles.push_back(title + " (00000 times)");
    const GeneralisedGammaFit *const fit = curve.drawn();
    bool rejected = false;
    for (const IntervalFit &candidate : curve.fits)
      if (&candidate.fit == fit) rejected = candidate.p < 0.05;
    any_rejected = any_rejected || rejected;
    any_accepted = any_accepted || (fit && !rejected);
    if (fit)
      lines += fmt::format(
          ", \\\n     [{}:{}] '+' using 1:({}*$1**({})*exp(-$1**({})/{})) with lines lt {}{} "
          "notitle",
          text_io::number(curve.bins.front().lo), text_io::number(curve.bins.back().hi),
          text_io::number(fit->C), text_io::number(fit->gamma - 1.0), text_io::number(fit->delta),
          text_io::number(fit->B), number, rejected ? " dt 3 lw 0.7" : "");
  }
  if (rescaled) {
    lines += fmt::format(
        ", \\\n     [{}:{}] '+' using 1:(0.5*$1**(-0.33)*exp(-$1/1.58)) with lines lt 8 dt (6,4) "
        "lw 2 "
        "title 'earthquakes, Corral (2004)'",
        text_io::number(range.lo), text_io::number(range.hi));
    titles.emplace_back("earthquakes, Corral (2004)");
  }
  if (any_accepted)
    lines += ", \\\n     keyentry with lines lt 8 title 'lines: fitted generalised gamma'";
  if (any_rejected) {
    lines += ", \\\n     keyentry with lines lt 8 dt 3 lw 0.7 title 'fit rejected (p < 0.05)'";
    titles.emplace_back();
  }
  titles.emplace_back();
  figure.size = size_with_key(titles, width);
  if (number == 0)
    throw std::runtime_error("no catalogue has two events above the threshold, nothing to draw");
  figure.script =
      axis("x",
           rescaled ? "inter-event time θ (mean = 1)" : "inter-event time θ (model time units)",
           true, range.lo, range.hi) +
      axis("y", rescaled ? "probability density f(θ)" : "probability density f(θ) (1 / model time)",
           true, 0.3 * heights.lo, heights.hi) +
      "row(k) = $1 == k && $7 > 0 ? $6 : NaN\n" + std::string(error_bar_function) +
      "set samples 400\n" + points + lines + "\n";
  return figure;
}

}  // namespace LSM::postproc
