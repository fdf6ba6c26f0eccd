// SPDX-License-Identifier: GPL-2.0-or-later
#include "aftershock_figure.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace LSM::postproc {

Table aftershock_table(const std::vector<AftershockCurve> &curves) {
  Table table(
      "model,main_size,least_size,window,first,main_shocks,events,constant,"
      "constant_error,p,p_error,c,c_error,K,K_error,background,background_error,"
      "likelihood_ratio,poisson_p,label,degenerate,before,quiet_rate,quiet_rate_error,"
      "excess_after,excess_after_error,excess_before,excess_before_error,after_to_before,"
      "after_to_before_error");
  table.show({{"catalogue", "label"},
              {"smallest main shock", "main_size"},
              {"largest for so long before and after", "window"},
              {"main shocks", "main_shocks"},
              {"smallest event", "least_size"},
              {"counted from", "first"},
              {"events after main shocks", "events"},
              {"events as long before", "before"},
              {"rate far from main shocks", "quiet_rate"},
              {"beyond it after", "excess_after"},
              {"beyond it before", "excess_before"},
              {"after / before", "after_to_before"},
              {"constant rate", "constant"},
              {"p", "p"},
              {"c", "c"},
              {"K", "K"},
              {"background", "background"},
              {"degenerate", "degenerate"},
              {"2 ln L ratio against a constant rate", "likelihood_ratio"},
              {"share of Poisson catalogues as large", "poisson_p", 2}});
  table.comment(
      "before: events as long before the main shocks; quiet_rate: of events outside of the windows "
      "of all main shocks; excess_*: events beyond it; after_to_before: their ratio");
  table.comment("n(t) = K (t + c)^-p + background after the end of a main shock, model time");
  table.comment("poisson_p: share of Poisson catalogues whose likelihood ratio is as large");
  for (const AftershockCurve &curve : curves) {
    const Aftershocks &a = curve.aftershocks;
    const OmoriFit &f = a.fit;
    table.row(curve.model, a.rule.main_size, a.rule.least_size, a.rule.window, a.rule.first,
              a.sequences.main_shocks, f.n, f.constant, f.se_constant, f.p, f.se_p, f.c, f.se_c,
              f.K, f.se_K, f.background, f.se_background, f.likelihood_ratio, a.p, curve.label,
              f.why, a.sequences.before.size(), a.sequences.background(),
              a.sequences.excess_after(), a.sequences.excess_before(),
              a.sequences.after_to_before());
  }
  return table;
}

Table aftershock_means(const std::vector<AftershockCurve> &curves) {
  Table table("label,catalogues,p,p_error,after_to_before,after_to_before_error");
  table.show({{"catalogues of one label", "label"},
              {"number", "catalogues"},
              {"p, mean", "p"},
              {"after / before, mean", "after_to_before"}});
  table.comment("means of the catalogues of one label, errors from their scatter");
  std::vector<std::string> labels;
  for (const AftershockCurve &curve : curves)
    if (std::find(labels.begin(), labels.end(), curve.label) == labels.end())
      labels.push_back(curve.label);
  for (const std::string &label : labels) {
    std::vector<Measured> p, ratio;
    for (const AftershockCurve &curve : curves) {
      if (curve.label != label) continue;
      p.push_back({curve.aftershocks.fit.p, curve.aftershocks.fit.se_p});
      ratio.push_back(curve.aftershocks.sequences.after_to_before());
    }
    if (p.size() > 1) table.row(label, p.size(), mean_of_catalogues(p), mean_of_catalogues(ratio));
  }
  return table;
}

Figure aftershock_figure(const std::vector<AftershockCurve> &curves) {
  Table table(
      "curve,model,bin_lo,bin_hi,time,count,rate,error,poisson_rate,poisson_scatter,label,before");
  table.comment("rate of events per main shock and model time, from the end of the main shock");
  table.comment("before: events as long before the start of a main shock, by their ends");
  table.comment("error: Poisson; poisson_*: mean and standard deviation in Poisson catalogues");
  Curves plot("$5");
  Extent times, rates;
  std::int64_t number = 0;
  for (const AftershockCurve &curve : curves) {
    const Aftershocks &a = curve.aftershocks;
    if (a.bins.empty()) continue;
    ++number;
    for (const RateBin &bin : a.bins) {
      table.row(number, curve.model, bin.lo, bin.hi, bin.centre, bin.count, bin.rate, bin.error,
                bin.poisson, bin.scatter, curve.label, bin.before);
      times.add(bin.lo);
      times.add(bin.hi);
      if (bin.count > 0) rates.add(bin.rate);
      if (bin.poisson > 0.0) rates.add(bin.poisson);
    }
    // A band of two standard deviations, down to a tenth where it would reach zero.
    plot.add(Curves::areas,
             fmt::format("table using (row({0})):($9 > 0 ? ($9-2*$10 > 0.1*$9 ? $9-2*$10 : 0.1*$9) "
                         ": NaN):($9 > 0 ? $9+2*$10 : NaN) with filledcurves fs solid 0.15 "
                         "noborder lt {0}",
                         number));
    plot.add_data(number, 7, 8);
    plot.add(Curves::data, fmt::format("keyentry with linespoints lt {}", number),
             fmt::format("{} ({} events, {} main shocks)", curve.label, a.fit.n,
                         a.sequences.main_shocks));
    const auto exact = [](double value) { return text_io::number(value); };
    const OmoriFit &fit = a.fit;
    plot.add_law(a.bins.front().lo, a.bins.back().hi,
                 fit.degenerate ? exact(fit.constant)
                                : fmt::format("{}*($1+{})**(-{})+{}", exact(fit.K), exact(fit.c),
                                              exact(fit.p), exact(fit.background)),
                 fmt::format("lt {} dt {}", number, fit.degenerate ? 2 : 1));
  }
  if (number == 0)
    throw std::runtime_error("no event after a main shock in any catalogue, nothing to draw");
  plot.add(Curves::legend, "keyentry with lines lt 8",
           "lines: Omori-Utsu law; dashed: constant rate");
  plot.add(Curves::legend, "keyentry with boxes fs solid 0.15 noborder lt 8",
           "bands: Poisson catalogues, mean ± 2 standard deviations");
  return plot.figure(
      std::move(table),
      axis("x", "time after the end of a main shock (model time)", true, times.lo, times.hi) +
          axis("y", "events per main shock and time unit", true, 0.5 * rates.lo, 1.5 * rates.hi));
}

}  // namespace LSM::postproc
