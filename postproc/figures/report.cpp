// SPDX-License-Identifier: GPL-2.0-or-later
#include "report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "interval_figure.h"
#include "lsm_text_io.h"
#include "numbers.h"
#include "plot.h"
#include "report_template.h"
#include "size_densities.h"
#include "size_fit_tables.h"
#include "table1.h"

namespace LSM::postproc {

namespace {

constexpr int picture_width = 720;

/// An HTML table row by row; cells are HTML.
class HtmlTable {
 public:
  explicit HtmlTable(const std::vector<std::string> &heads) : columns_(heads.size()) {
    out_ = "<div class=\"wide\"><table>\n<thead><tr>";
    for (const std::string &head : heads) out_ += "<th>" + head + "</th>";
    out_ += "</tr></thead>\n<tbody>\n";
  }
  /// First cell: the row's head. Cells beyond the first that are missing are filled by the last.
  void row(const std::string &head, const std::vector<std::string> &cells) {
    out_ += "<tr><th scope=\"row\">" + head + "</th>";
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool last = i + 1 == cells.size();
      const std::size_t span = last ? columns_ - 1 - i : 1;
      // Sentences may wrap, numbers not.
      const char *const kind = cells[i].size() > 32 ? " class=\"text\"" : "";
      out_ +=
          span > 1 ? fmt::format("<td{} colspan=\"{}\">", kind, span) : fmt::format("<td{}>", kind);
      out_ += cells[i] + "</td>";
    }
    out_ += "</tr>\n";
  }
  void section(const std::string &head) {
    out_ += fmt::format("<tr class=\"head\"><th colspan=\"{}\">{}</th></tr>\n", columns_, head);
  }
  std::string text() const { return out_ + "</tbody></table></div>\n"; }

 private:
  std::size_t columns_;
  std::string out_;
};

std::string degenerate(const std::string &why) {
  return "<span class=\"bad\">degenerate: " + html_escape(why) + "</span>";
}

const char *model_name(const std::string &model) {
  return model == "lsm" ? "Fault" : "Block-slider";
}

std::string kind_name(const std::string &kind) { return kind == "pe" ? "drops of PE" : kind; }

/// Description of a kind of events, if the page has one.
std::string kind_part(const std::string &kind, const std::string &of) {
  return kind == "ruptures" ? report_part("ruptures" + of) : std::string();
}

std::string catalogue_section(const std::vector<EventTable> &tables, const Threshold &least) {
  HtmlTable table({"catalogue", "model", "kind of event", "events", "from the smallest size used",
                   "first to last start (model time)", "share of the time within events",
                   "smallest to largest size (model energy)", "lines skipped"});
  for (const EventTable &events : tables) {
    const double threshold = least.of(events);
    const std::int64_t above = events_from(events, threshold);
    Extent sizes;
    for (const Event &event : events.events) sizes.add(event.size);
    const bool any = !events.events.empty();
    table.row(html_escape(events.label),
              {model_name(events.info.model), kind_name(events.kind()),
               std::to_string(events.events.size()),
               fmt::format("{} from {}", above, short_number(threshold)),
               any ? fmt::format("{} to {}", short_number(events.events.front().t_start, 6),
                                 short_number(events.events.back().t_start, 6))
                   : "no events",
               short_number(events.share_in_events(), 2),
               any ? fmt::format("{} to {}", short_number(sizes.lo, 3), short_number(sizes.hi, 3))
                   : "no events",
               std::to_string(events.skipped_lines)});
  }
  std::string out = table.text();
  for (const std::string &line : texts(least, tables))
    out += "<p>" + html_escape("S" + line.substr(1)) + ".</p>\n";
  for (const EventTable &events : tables)
    for (const std::string &repair : events.repairs)
      out += "<p>" + html_escape(events.label + ": " + repair) + "</p>\n";
  return out;
}

std::string series_section(const std::vector<SeriesRegime> &series) {
  HtmlTable table({"PE series", "model", "length or blocks", "times", "regime", "saw-tooth",
                   "stick-slip above", "fastest fall / load", "share of the time within events",
                   "mean duration of events (model time)"});
  double window = regime_window;
  for (const SeriesRegime &one : series) {
    std::vector<std::string> cells = {
        model_name(one.model), std::isnan(one.length) ? "–" : short_number(one.length, 6),
        fmt::format("{} to {}", short_number(one.first, 6), short_number(one.last, 6))};
    if (one.regime) {
      const Regime &r = *one.regime;
      window = r.window;
      for (const std::string &cell :
           {name_of(r), short_number(r.saw_tooth, 3), short_number(r.above, 3),
            short_number(r.drop_over_load, 3), short_number(r.time_in_events, 2),
            short_number(r.mean_duration, 3)})
        cells.push_back(cell);
    } else {
      cells.push_back(degenerate(one.why));
    }
    table.row(html_escape(one.path), cells);
  }
  return report_part("regimes", {{"table", table.text()},
                                 {"window", short_number(window)},
                                 {"limit", short_number(stick_slip_above(120))}});
}

std::string parameter_section(const std::vector<const EventTable *> &tables) {
  std::vector<std::string> keys, heads = {"parameter"};
  for (const EventTable *table : tables) {
    heads.push_back(html_escape(table->label));
    for (const auto &parameter : table->info.parameters)
      if (std::find(keys.begin(), keys.end(), parameter.first) == keys.end())
        keys.push_back(parameter.first);
  }
  HtmlTable out(heads);
  for (const std::string &key : keys) {
    std::vector<std::string> cells;
    for (const EventTable *table : tables) {
      const std::string *text = table->info.find(key);
      double value = 0.0;
      if (!text)
        cells.emplace_back("–");
      else if (text->size() > 8 && text_io::parse(*text, value))
        cells.push_back(short_number(value, 10));  // 17 digits are for programs
      else
        cells.push_back(html_escape(*text));
    }
    out.row(html_escape(key), cells);
  }
  return out.text();
}

/// Numbers the pictures of the page.
class Figures {
 public:
  std::string add(const Figure &figure, const std::string &title, const std::string &caption) {
    const std::string prefix = fmt::format("f{}-", ++count_);
    return fmt::format(
        "<figure>\n<div class=\"wide\">{}</div>\n<figcaption><b>{}.</b> "
        "{}</figcaption>\n</figure>\n",
        inline_svg(svg_text(figure), prefix, title), html_escape(title), caption);
  }

 private:
  int count_ = 0;
};

/// Runs draw; an impossible picture becomes a paragraph that says why. Errors about files and
/// gnuplot go through: they are not about the data.
template <class Draw>
std::string drawn_or_why(Draw &&draw) {
  try {
    return draw();
  } catch (const FileError &) {
    throw;
  } catch (const std::runtime_error &error) {
    return "<p>" + degenerate(error.what()) + "</p>\n";
  }
}

std::string size_fit_table(const std::vector<SizeFit> &fits, bool lsm) {
  HtmlTable table({"catalogue", "sizes", "events", "exponent", "KS distance", "p",
                   "against exponential", "against log-normal", "against cut-off"});
  table.section("printed in the paper (Sect. 4.2; how it was fitted is not stated)");
  if (lsm) {
    table.row("LSM", {"about 3 decades", "", "1.07", ""});
  } else {
    table.row("Block-Slider, moderate sizes", {"about 3 decades", "", "about 1.0", ""});
    table.row("Block-Slider, small sizes", {"not stated", "", "about 0.5", ""});
  }
  table.section("ours (maximum likelihood on a range with both ends)");
  for (const SizeFit &fit : fits) {
    const PowerLawFit &law = fit.fit;
    const std::string range = range_text(law);
    if (law.degenerate) {
      table.row(html_escape(fit.label), {range, std::to_string(law.n), degenerate(law.why)});
      continue;
    }
    std::vector<std::string> cells = {
        range, std::to_string(law.n), with_error(law.alpha, law.standard_error, " ± "),
        short_number(law.ks, 3), std::isnan(fit.p) ? "–" : with_error(fit.p, fit.p_error, " ± ")};
    for (const Comparison &comparison : fit.comparisons)
      cells.push_back(comparison.degenerate ? degenerate(comparison.why)
                                            : fmt::format("{}<br>p = {}", favoured(comparison),
                                                          short_number(comparison.p, 2)));
    table.row(html_escape(fit.label), cells);
  }
  return table.text();
}

std::string scaling_section(const Scaling &scaling, Figures &figures) {
  HtmlTable table({"catalogue", "length L", "events", "s* (model energy)",
                   "error if events were independent", "blocks, length (model time)"});
  for (std::size_t i = 0; i < scaling.points.size(); ++i) {
    const SizePoint &point = scaling.points[i];
    if (point.degenerate) {
      table.row(html_escape(scaling.labels[i]),
                {short_number(point.length, 6), std::to_string(point.n), degenerate(point.why)});
      continue;
    }
    table.row(
        html_escape(scaling.labels[i]),
        {short_number(point.length, 6), std::to_string(point.n),
         with_error(point.s_star, point.error, " ± "), short_number(point.error_independent, 2),
         point.blocks > 0 ? fmt::format("{} of {}", point.blocks, short_number(point.block, 3))
                          : "–"});
  }
  std::string figure;
  if (!scaling.fit.degenerate)
    figure = figures.add(scaling_figure({scaling}, picture_width),
                         "Characteristic size against length", report_part("scaling caption"));
  return report_part(
      "scaling",
      {{"figure", figure},
       {"table", table.text()},
       {"events", scaling.kind == "pe" ? report_part("drops of PE") : kind_part(scaling.kind, "")},
       {"verdict",
        scaling.fit.degenerate ? degenerate(scaling.fit.why) : html_escape(verdict(scaling))}});
}

std::string table1_section(const std::vector<IntervalCurve> &curves) {
  HtmlTable table({"", "γ", "δ", "B", "C", "goodness of fit"});
  table.section("printed in the paper (unit of θ, threshold and errors not stated)");
  std::string head;
  bool ours = false;
  for (const Table1Row &row : table1(curves, " ± ")) {
    if (!row.printed && !ours) {
      ours = true;
      table.section("ours (θ in model time, from start to start; standard errors)");
    }
    const auto &p = row.parameters;
    if (row.printed) {
      table.row(html_escape(row.source), {p[0], p[1], p[2], p[3], ""});
      continue;
    }
    const std::string name =
        fmt::format("{}<br>{} (n = {})", html_escape(row.source), html_escape(row.method), row.n);
    if (row.why.empty())
      table.row(name, {p[0], p[1], p[2], p[3], row.goodness(" ± ")});
    else
      table.row(name, {degenerate(row.why)});
  }
  return table.text();
}

/// Header value as text, or "".
std::string parameter(const EventTable &table, std::string_view key) {
  const std::string *text = table.info.find(key);
  return text ? *text : "";
}

/// The catalogues of block-sliders by their leaf springs: `same` have the commonest value; `fig7`,
/// as in the paper's Fig. 7, has one number of blocks and every value, and is empty if all are the
/// same.
void split_by_stiffness(const std::vector<EventTable> &tables, std::vector<EventTable> &same,
                        std::vector<EventTable> &fig7) {
  std::map<std::string, int> counts;
  for (const EventTable &table : tables) ++counts[parameter(table, "kl")];
  const std::string common = std::max_element(counts.begin(), counts.end(), [](auto &a, auto &b) {
                               return a.second < b.second;
                             })->first;
  for (const EventTable &table : tables)
    (parameter(table, "kl") == common ? same : fig7).push_back(table);
  if (fig7.empty()) return;
  const std::string blocks = parameter(fig7.front(), "blocks");
  for (const EventTable &table : same)
    if (parameter(table, "blocks") == blocks) fig7.push_back(table);
}

std::string size_figure(const std::vector<EventTable> &tables, const SizeDensitySettings &settings,
                        const std::string &caption, Figures &figures) {
  return drawn_or_why([&] {
    std::vector<std::string> empty;
    const Figure figure = size_density_figure(tables, settings, empty);
    std::string whole = caption + " " + report_part("densities caption");
    for (const std::string &label : empty)
      whole += " No event in range: " + html_escape(label) + ".";
    return figures.add(figure, "Densities of event sizes", whole);
  });
}

/// What a statistic found: its tables and pictures.
std::string section_html(const ReportSection &section, const std::vector<EventTable> &tables,
                         Figures &figures) {
  std::string out = "<h3>" + html_escape(section.heading) + "</h3>\n";
  return out + drawn_or_why([&] {
           std::string body;
           const Findings found = section.find(tables);
           for (const Finding &one : found.all()) {
             if (const auto *table = std::get_if<Table>(&one.what)) {
               HtmlTable html(table->columns());
               for (std::vector<std::string> row : table->texts()) {
                 for (std::string &cell : row) cell = html_escape(cell);
                 html.row(row[0], {row.begin() + 1, row.end()});
               }
               body += html.text();
             } else if (const auto *figure = std::get_if<Figure>(&one.what)) {
               body += figures.add(*figure, section.heading, "");
             }
           }
           return body;
         });
}

/// \param all_curves those of the page, for Table 1
std::string times_section(const std::vector<EventTable> &tables, bool lsm,
                          const ReportSettings &settings, Figures &figures,
                          std::vector<IntervalCurve> &all_curves) {
  const double threshold = settings.threshold.of(tables.front());
  IntervalSettings intervals;
  if (settings.threshold.given()) intervals.thresholds = {threshold};
  intervals.replicas = settings.interval_replicas;
  intervals.seed = settings.seed;
  const std::vector<IntervalCurve> curves = interval_curves(tables, intervals);
  std::string times = drawn_or_why([&] {
    return figures.add(
        interval_figure(curves, false, picture_width), "Densities of inter-event times",
        report_part("intervals caption",
                    {{"figure", lsm ? "14" : "15"}, {"threshold", short_number(threshold)}}));
  });
  intervals.rescale = true;
  intervals.replicas = 0;  // the same fits in another unit
  const std::vector<IntervalCurve> rescaled = interval_curves(tables, intervals);
  times += drawn_or_why([&] {
    return figures.add(interval_figure(rescaled, true, picture_width),
                       "Inter-event times divided by their mean", report_part("rescaled caption"));
  });
  all_curves.insert(all_curves.end(), curves.begin(), curves.end());
  return times;
}

std::string model_section(const std::vector<EventTable> &all, bool lsm, const std::string &kind,
                          const ReportSettings &settings, Figures &figures,
                          std::vector<IntervalCurve> &all_curves) {
  std::vector<EventTable> tables, fig7;
  if (lsm)
    tables = all;
  else
    split_by_stiffness(all, tables, fig7);
  const double threshold = settings.threshold.of(all.front());  // the same for all of a kind
  SizeDensitySettings densities;
  densities.threshold = settings.threshold;
  densities.width = picture_width;
  SizeFitSettings ranges;
  ranges.replicas = settings.replicas;
  ranges.seed = settings.seed;
  ranges.threshold = settings.threshold;
  ranges.search.upper = true;
  // The paper prints no ranges. Ours: where its exponents are seen.
  const auto add_range = [&](double slope, const char *title, double lo, double hi) {
    lo = std::max(lo, threshold);
    if (!(lo < hi)) return;
    ranges.ranges.push_back({lo, hi});
    PowerLine line;
    line.slope = slope;
    line.lo = lo;
    line.hi = hi;
    line.title = title;
    line.dash = 1 + static_cast<int>(ranges.ranges.size());
    densities.lines.push_back(line);
  };
  if (lsm) {
    add_range(-1.07, "paper: slope -1.07", 1e-4, 1e-2);
  } else {
    add_range(-0.5, "paper: slope -0.5", 1e-2, 1.0);
    add_range(-1.0, "paper: slope -1.0", 1.0, 100.0);
  }
  std::string sizes = kind_part(kind, lsm ? " of a fault" : " of a chain");
  sizes += size_figure(tables, densities,
                       report_part("sizes caption", {{"figure", lsm ? "12" : "13"},
                                                     {"threshold", short_number(threshold)}}),
                       figures);
  if (!fig7.empty()) {
    SizeDensitySettings every;
    every.threshold = 0.0;
    every.width = picture_width;
    sizes += size_figure(fig7, every, report_part("stiffness caption"), figures);
  }
  std::vector<SizeFit> fits;
  if (!ranges.ranges.empty()) fits = fit_sizes(all, ranges);
  SizeFitSettings searched = ranges;
  searched.ranges.clear();
  for (SizeFit &fit : fit_sizes(all, searched)) fits.push_back(std::move(fit));

  std::string scaling;
  Resampling bootstrap = settings.bootstrap;
  bootstrap.seed = settings.seed;
  const std::vector<Scaling> scalings = scale_sizes(tables, settings.threshold, bootstrap);
  for (const Scaling &one : scalings) scaling += scaling_section(one, figures);
  if (scalings.empty())
    scaling = "<p>" + degenerate("no catalogue gives its length or number of blocks") + "</p>\n";

  std::string times = times_section(tables, lsm, settings, figures, all_curves);
  for (const ReportSection &section : settings.sections)
    times += section_html(section, all, figures);
  return report_part("model", {{"name", std::string(model_name(lsm ? "lsm" : "block-slider")) +
                                            (kind == "pe" ? "" : ": " + kind)},
                               {"sizes", sizes},
                               {"fits", size_fit_table(fits, lsm)},
                               {"scaling", scaling},
                               {"intervals", times}});
}

}  // namespace

std::string html_escape(std::string_view text) {
  constexpr std::string_view reserved = "&<>\"'";
  constexpr const char *entities[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
  std::string out;
  for (const char c : text) {
    const std::size_t which = reserved.find(c);
    which == std::string_view::npos ? out += c : out += entities[which];
  }
  return out;
}

std::string inline_svg(std::string_view svg, const std::string &prefix, const std::string &title) {
  const std::size_t begin = svg.find("<svg"), end = svg.find("</svg>");
  if (begin == std::string_view::npos || end == std::string_view::npos)
    throw std::invalid_argument("not an SVG picture");
  std::string out(svg.substr(begin, end + 6 - begin));
  const auto replace_all = [&out](std::string_view from, const std::string &to) {
    for (std::size_t at = 0; (at = out.find(from, at)) != std::string::npos; at += to.size())
      out.replace(at, from.size(), to);
  };
  for (const char *const reference : {" id='", " id=\"", "href='#", "href=\"#", "url(#"})
    replace_all(reference, reference + prefix);
  replace_all("<title>Gnuplot</title>", "<title>" + html_escape(title) + "</title>");
  const std::size_t description = out.find("<desc>"), behind = out.find("</desc>");
  if (description != std::string::npos && behind != std::string::npos)
    out.erase(description, behind + 7 - description);
  // Text between the elements may hold the same words as an attribute; the background is the first.
  const std::string background = "fill=\"#ffffff\"";
  const std::size_t at = out.find(background);
  if (at != std::string::npos) out.replace(at, background.size(), "fill=\"none\"");
  out.insert(4, " role=\"img\"");
  return out;
}

std::string report_html(const std::vector<EventTable> &tables, const ReportSettings &settings,
                        const std::vector<SeriesRegime> &series) {
  Figures figures;
  std::vector<IntervalCurve> curves;
  std::string models, parameters;
  std::vector<std::string> kinds = {"pe"};
  for (const EventTable &table : tables)
    if (std::find(kinds.begin(), kinds.end(), table.kind()) == kinds.end())
      kinds.push_back(table.kind());
  for (const bool lsm : {true, false})
    for (const std::string &kind : kinds) {
      std::vector<EventTable> chosen;
      for (const EventTable &table : tables)
        if ((table.info.model == "lsm") == lsm && table.kind() == kind) chosen.push_back(table);
      if (chosen.empty()) continue;
      std::vector<const EventTable *> views;
      for (const EventTable &table : chosen) views.push_back(&table);
      parameters += fmt::format("<h3>{}{}</h3>\n{}", model_name(views.front()->info.model),
                                kind == "pe" ? "" : ": " + kind, parameter_section(views));
      models += model_section(chosen, lsm, kind, settings, figures, curves);
    }
  const auto count = [](std::int64_t n) { return std::to_string(n); };
  return report_part("page", {{"title", html_escape(settings.title)},
                              {"catalogues", catalogue_section(tables, settings.threshold)},
                              {"regimes", series.empty() ? "" : series_section(series)},
                              {"models", models},
                              {"table1", table1_section(curves)},
                              {"rejection_rule", std::string(rejection_rule)},
                              {"replicas", count(settings.replicas)},
                              {"interval_replicas", count(settings.interval_replicas)},
                              {"bootstrap", count(settings.bootstrap.replicas)},
                              {"seed", std::to_string(settings.seed)},
                              {"parameters", parameters}});
}

}  // namespace LSM::postproc
