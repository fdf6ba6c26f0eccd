// SPDX-License-Identifier: GPL-2.0-or-later
#include "aftershock_figure.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "lsm_text_io.h"
#include "numbers.h"

namespace LSM::postproc {

std::string aftershocks_text(const std::vector<AftershockCurve> &curves) {
  std::string out;
  for (const AftershockCurve &curve : curves) {
    const Aftershocks &a = curve.aftershocks;
    out += fmt::format(
        "{}: {} main shocks of size {} or larger (largest event of all that start within {} before "
        "and after), {} events of size {} or larger from {} to {} after their ends\n",
        curve.label, a.sequences.main_shocks, short_number(a.rule.main_size),
        short_number(a.rule.window), a.fit.n, short_number(a.rule.least_size),
        short_number(a.rule.first), short_number(a.rule.window));
    out += fmt::format("  {} events in the same time before their starts\n",
                       a.sequences.before.size());
    if (a.fit.n > 0)
      out += fmt::format("  constant rate: {} per time unit\n",
                         with_error(a.fit.constant, a.fit.se_constant));
    if (a.fit.degenerate)
      out += "  Omori-Utsu, n(t) = K (t + c)^-p + background: degenerate: " + a.fit.why + "\n";
    else
      out += fmt::format(
          "  Omori-Utsu, n(t) = K (t + c)^-p + background: p = {}, c = {}{}, K = {}, background = "
          "{}\n",
          with_error(a.fit.p, a.fit.se_p), with_error(a.fit.c, a.fit.se_c),
          a.fit.se_c > 0.0 ? "" : " (held)", with_error(a.fit.K, a.fit.se_K),
          with_error(a.fit.background, a.fit.se_background));
    if (!std::isnan(a.fit.likelihood_ratio))
      out += fmt::format("  against a constant rate: 2 ln L ratio {}",
                         short_number(a.fit.likelihood_ratio));
    if (!std::isnan(a.p))
      out += fmt::format("; as large in a fraction {} of Poisson catalogues of the same events",
                         short_number(a.p, 2));
    if (!std::isnan(a.fit.likelihood_ratio)) out += '\n';
  }
  return out;
}

Table aftershocks_csv(const std::vector<AftershockCurve> &curves) {
  Table table(
      "model,main_size,least_size,window,first,main_shocks,events,constant,"
      "constant_error,p,p_error,c,c_error,K,K_error,background,background_error,"
      "likelihood_ratio,poisson_p,label,degenerate,before");
  table.comment("before: events as long before the main shocks");
  table.comment("n(t) = K (t + c)^-p + background after the end of a main shock, model time");
  table.comment("poisson_p: share of Poisson catalogues whose likelihood ratio is as large");
  for (const AftershockCurve &curve : curves) {
    const Aftershocks &a = curve.aftershocks;
    const OmoriFit &f = a.fit;
    table.row(curve.model, a.rule.main_size, a.rule.least_size, a.rule.window, a.rule.first,
              a.sequences.main_shocks, f.n, f.constant, f.se_constant, f.p, f.se_p, f.c, f.se_c,
              f.K, f.se_K, f.background, f.se_background, f.likelihood_ratio, a.p, curve.label,
              f.why, a.sequences.before.size());
  }
  return table;
}

Figure aftershock_figure(const std::vector<AftershockCurve> &curves) {
  Figure figure{
      Table("curve,model,bin_lo,bin_hi,time,count,rate,error,poisson_rate,poisson_scatter,"
            "label,before"),
      {},
      {}};
  figure.table.comment(
      "rate of events per main shock and model time, from the end of the main shock");
  figure.table.comment("before: events as long before the start of a main shock, by their ends");
  figure.table.comment(
      "error: Poisson; poisson_*: mean and standard deviation in Poisson catalogues");
  Extent times, rates;
  std::string bands, points, lines;
  std::vector<std::string> titles;
  std::int64_t number = 0;
  for (const AftershockCurve &curve : curves) {
    const Aftershocks &a = curve.aftershocks;
    if (a.bins.empty()) continue;
    ++number;
    for (const RateBin &bin : a.bins) {
      figure.table.row(number, curve.model, bin.lo, bin.hi, bin.centre, bin.count, bin.rate,
                       bin.error, bin.poisson, bin.scatter, curve.label, bin.before);
      times.add(bin.lo);
      times.add(bin.hi);
      if (bin.count > 0) rates.add(bin.rate);
      if (bin.poisson > 0.0) rates.add(bin.poisson);
    }
    const std::string row = fmt::format("row({})", number);
    // A band of two standard deviations, down to a tenth where it would reach zero.
    bands += fmt::format(
        "{0} table using ({1}):($9 > 0 ? ($9-2*$10 > 0.1*$9 ? $9-2*$10 : 0.1*$9) : NaN):($9 > 0 ? "
        "$9+2*$10 : NaN) with filledcurves fs solid {2} noborder lt {3} notitle",
        bands.empty() ? "plot" : ", \\\n    ", row, "0.15", number);
    points += fmt::format(
        ", \\\n     {}, \\\n     table using ($6 > 0 ? {} : NaN):7 with points lt {} notitle, \\\n"
        "     keyentry with linespoints lt {} title {}",
        error_bars(fmt::format("($6 > 0 ? {} : NaN)", row), "$7", "$8", number), row, number,
        number,
        quote(fmt::format("{} ({} events, {} main shocks)", curve.label, a.fit.n,
                          a.sequences.main_shocks)));
    titles.push_back(curve.label + " (00000 events, 000 main shocks)");
    const std::string where =
        fmt::format(", \\\n     [{}:{}] '+' using 1:", text_io::number(a.bins.front().lo),
                    text_io::number(a.bins.back().hi));
    if (a.fit.degenerate)
      lines += fmt::format("{}({}) with lines lt {} dt 2 notitle", where,
                           text_io::number(a.fit.constant), number);
    else
      lines += fmt::format("{}({}*($1+{})**(-{})+{}) with lines lt {} dt 1 notitle", where,
                           text_io::number(a.fit.K), text_io::number(a.fit.c),
                           text_io::number(a.fit.p), text_io::number(a.fit.background), number);
  }
  if (number == 0)
    throw std::runtime_error("no event after a main shock in any catalogue, nothing to draw");
  lines +=
      ", \\\n     keyentry with lines lt 8 title 'lines: Omori-Utsu law; dashed: constant rate', "
      "\\\n"
      "     keyentry with boxes fs solid 0.15 noborder lt 8 title 'bands: Poisson catalogues, mean "
      "± "
      "2 standard deviations'";
  titles.insert(titles.end(), 2, std::string(60, ' '));
  figure.size = size_with_key(titles);
  figure.script =
      axis("x", "time after the end of a main shock (model time)", true, times.lo, times.hi) +
      axis("y", "events per main shock and time unit", true, 0.5 * rates.lo, 1.5 * rates.hi) +
      "row(k) = $1 == k ? $5 : NaN\n" + std::string(error_bar_function) + "set samples 400\n" +
      bands + points + lines + "\n";
  return figure;
}

}  // namespace LSM::postproc
