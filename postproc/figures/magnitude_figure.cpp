// SPDX-License-Identifier: GPL-2.0-or-later
#include "magnitude_figure.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "lsm_text_io.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

std::string scale_text(const MagnitudeScale &scale, const std::string &of) {
  return fmt::format("M = {} log10({}) + {}", short_number(scale.slope), of,
                     short_number(scale.constant));
}

std::string b_text(const BValue &b) {
  return b.degenerate ? "degenerate: " + b.why
                      : fmt::format("{} (n = {})", with_error(b.b, b.error), b.n);
}

}  // namespace

std::string magnitudes_text(const std::vector<MagnitudeCurve> &curves, const MagnitudeScale &scale,
                            const std::string &of) {
  std::string out = scale_text(scale, of) + " (a convention, ours)\n";
  for (const MagnitudeCurve &curve : curves) {
    out += fmt::format("{}: {} magnitudes, complete from {} ({}); maximum curvature gives {}\n",
                       curve.label, curve.magnitudes.size(), short_number(curve.completeness),
                       curve.completeness_text, short_number(curve.curvature));
    out += "  b = " + b_text(curve.b);
    if (!curve.b.degenerate)
      out += fmt::format(", exponent of the sizes 1 + {} b = {}", short_number(scale.slope),
                         with_error(1.0 + scale.slope * curve.b.b, scale.slope * curve.b.error));
    out += "\n  b-positive = " + b_text(curve.positive) + "\n";
  }
  return out;
}

Table magnitudes_csv(const std::vector<MagnitudeCurve> &curves, const MagnitudeScale &scale,
                     const std::string &of, double width) {
  Table table(
      "model,completeness,maximum_curvature,n,b,b_error,n_positive,b_positive,"
      "b_positive_error,label,degenerate,degenerate_positive");
  table.comment(scale_text(scale, of) + fmt::format(", bins of {} (0: none)", width));
  table.comment(
      "b: Aki, in bins Tinti and Mulargia; errors: Shi and Bolt; b_positive: van der Elst");
  for (const MagnitudeCurve &curve : curves) {
    table.row(curve.model, curve.completeness, curve.curvature, curve.b.n, curve.b.b, curve.b.error,
              curve.positive.n, curve.positive.b, curve.positive.error, curve.label, curve.b.why,
              curve.positive.why);
  }
  return table;
}

Figure magnitude_figure(const std::vector<MagnitudeCurve> &curves, double width) {
  Figure figure{Table("curve,model,magnitude,count,from_here_on,label"), {}, {}};
  figure.table.comment(
      "count: events in the bin centred at magnitude; from_here_on: in it and above");
  Extent magnitudes;
  double most = 0.0;
  std::string plots;
  std::vector<std::string> titles;
  std::int64_t number = 0;
  for (const MagnitudeCurve &curve : curves) {
    if (curve.magnitudes.empty()) continue;
    ++number;
    std::map<std::int64_t, std::int64_t> counts;
    for (const double m : curve.magnitudes)
      ++counts[static_cast<std::int64_t>(std::floor(m / width + 0.5))];
    std::int64_t rest = static_cast<std::int64_t>(curve.magnitudes.size());
    most = std::max(most, static_cast<double>(rest));
    for (std::int64_t bin = counts.begin()->first; bin <= std::prev(counts.end())->first; ++bin) {
      const auto found = counts.find(bin);
      const std::int64_t count = found == counts.end() ? 0 : found->second;
      const double centre = width * static_cast<double>(bin);
      magnitudes.add(centre);
      figure.table.row(number, curve.model, centre, count, rest, curve.label);
      rest -= count;
    }
    std::string title = fmt::format("{} ({} events)", curve.label, curve.magnitudes.size());
    if (!curve.b.degenerate)
      title += fmt::format(": b = {}", with_error(curve.b.b, curve.b.error, " ± "));
    // Half a bin down: the first bin of the sum begins there.
    plots += fmt::format(
        "{0} table using ($1 == {1} ? $3-{2} : NaN):5 with points lt {1} notitle, \\\n"
        "     table using ($1 == {1} && $4 > 0 ? $3 : NaN):4 with points lt {1} ps 0.45*point "
        "notitle"
        ", \\\n     keyentry with linespoints lt {1} title {3}",
        plots.empty() ? "plot" : ", \\\n    ", number, text_io::number(0.5 * width), quote(title));
    titles.push_back(title);
    if (curve.b.degenerate) continue;
    const double last = *std::max_element(curve.magnitudes.begin(), curve.magnitudes.end());
    plots += fmt::format(
        ", \\\n     [{}:{}] '+' using 1:({}*10**(-({})*($1-({})))) with lines lt {} "
        "notitle",
        text_io::number(curve.completeness), text_io::number(last), curve.b.n,
        text_io::number(curve.b.b), text_io::number(curve.completeness), number);
  }
  if (number == 0)
    throw std::runtime_error("no event with a magnitude in any catalogue, nothing to draw");
  plots +=
      ", \\\n     keyentry with points lt 8 pt 7 title 'large: events from M on; lines: the fitted "
      "laws', \\\n     keyentry with points lt 8 pt 7 ps 0.45*point title 'small: events in a bin'";
  titles.insert(titles.end(), 2, std::string(60, ' '));
  figure.size = size_with_key(titles);
  const double margin = 0.03 * (magnitudes.hi - magnitudes.lo) + width;
  figure.script = axis("x", "magnitude M", false, magnitudes.lo - margin, magnitudes.hi + margin) +
                  axis("y", "events", true, 0.8, most) + "set samples 200\n" + plots + "\n";
  return figure;
}

}  // namespace LSM::postproc
