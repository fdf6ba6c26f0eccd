// SPDX-License-Identifier: GPL-2.0-or-later
#include "period_figure.h"

#include <stdexcept>

#include <fmt/format.h>

namespace LSM::postproc {

Figure period_figure(const std::vector<PeriodScan> &scans, const std::vector<std::string> &labels,
                     const std::string &unit) {
  Table table("curve,period,z,by_chance,label");
  table.comment("Rayleigh's Z of the events, weighted with their sizes; 1 on average by chance");
  table.comment("by_chance: Z that the largest of a scan exceeds by chance in 5 % of all scans");
  Curves plot("$2", "$3 > 0");
  Extent periods, heights;
  heights.add(0.5);
  std::int64_t number = 0;
  double by_chance = 0.0;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    const PeriodScan &scan = scans[k];
    ++number;
    for (std::size_t i = 0; i < scan.periods.size(); ++i) {
      table.row(number, scan.periods[i], scan.z[i], scan.by_chance, labels[k]);
      periods.add(scan.periods[i]);
      heights.add(scan.z[i]);
    }
    if (scan.periods.empty()) continue;
    by_chance = std::max(by_chance, scan.by_chance);
    plot.add(Curves::data, fmt::format("table using (row({0})):3 with lines lt {0} lw 1.2", number),
             labels[k]);
  }
  if (periods.empty())
    throw std::runtime_error("periods: none fits into the time of a catalogue, nothing to draw");
  heights.add(1.5 * by_chance);
  plot.add_law(periods.lo, periods.hi, "1", "lt 8 dt 3", "chance, on average");
  plot.add_law(periods.lo, periods.hi, fmt::format("{}", by_chance), "lt 8 dt 2",
               "largest by chance, in 5 % of all scans");
  return plot.figure(std::move(table),
                     axis("x", "period (" + unit + ")", true, periods.lo, periods.hi) +
                         axis("y", "Rayleigh's Z, weighted with the sizes", true, 0.1, heights.hi),
                     900);
}

}  // namespace LSM::postproc
