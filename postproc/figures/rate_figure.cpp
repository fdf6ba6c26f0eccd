// SPDX-License-Identifier: GPL-2.0-or-later
#include "rate_figure.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace LSM::postproc {

Figure release_figure(const std::vector<ReleaseCurve> &curves, const ReleaseNames &names) {
  Table table("curve,model,from,to,events,event_rate,released,release_rate,label");
  table.comment({"event_rate: events with starts in [from, to) over to - from",
                 "release_rate: what they release over to - from: " + names.released});
  Extent times;
  std::int64_t number = 0;
  std::string plots[2];
  for (const ReleaseCurve &curve : curves) {
    if (curve.bins.empty()) continue;
    ++number;
    for (const ReleaseBin &bin : curve.bins) {
      times.add(bin.from);
      times.add(bin.to);
      table.row(number, curve.model, bin.from, bin.to, bin.events, bin.event_rate(), bin.released,
                bin.release_rate(), curve.label);
    }
    for (int panel = 0; panel < 2; ++panel)
      plots[panel] += fmt::format(
          "{} table using ($1 == {} && ${} > 0 ? 0.5*($3+$4) : NaN):{} with points lt {} {}",
          plots[panel].empty() ? "plot" : ",", number, panel == 0 ? 6 : 8, panel == 0 ? 6 : 8,
          number, panel == 0 ? "title " + quote(curve.label) : "notitle");
  }
  if (number == 0) throw DegenerateData("no event in any catalogue, nothing to draw");
  const std::string time = axis("x", names.time, false, times.lo, times.hi);
  std::string script = "set multiplot\n" + panel(0.1, 0.97, 0.6, 0.95) + time +
                       axis("y", names.events, true, NAN, NAN) + plots[0] + "\n" +
                       panel(0.1, 0.97, 0.12, 0.48) + time +
                       axis("y", names.released, true, NAN, NAN) + plots[1] + "\nunset multiplot\n";
  return {std::move(table), std::move(script), {900, 720}};
}

}  // namespace LSM::postproc
