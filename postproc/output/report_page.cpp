// SPDX-License-Identifier: GPL-2.0-or-later
#include "report_page.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "interval_figures.h"
#include "numbers.h"
#include "page.h"
#include "size_figures.h"
#include "size_fits.h"

namespace LSM::postproc {

namespace {

constexpr int picture_width = 720;

/// Description of a kind of events from report.html; empty if it has none.
std::string kind_part(const std::string &kind, const std::string &of) {
  return kind == "ruptures" ? report_part("ruptures" + of) : std::string();
}

std::string catalogue_section(const std::vector<EventTable> &tables, const Threshold &least) {
  Table table({"catalogue", "model", "kind of event", "events", "from the smallest size used",
               "first to last start (model time)", "share of the time within events",
               "smallest to largest size (model energy)", "lines skipped"});
  std::string below;
  for (const EventTable &events : tables) {
    const double threshold = least.of(events).size;
    std::string starts = "no events", range = starts;
    if (!events.events.empty()) {
      Extent sizes;
      for (const EventSummary &event : events.events) sizes.add(event.size);
      range = fmt::format("{} to {}", short_number(sizes.lo, 3), short_number(sizes.hi, 3));
      starts = fmt::format("{} to {}", short_number(events.events.front().t_start, 6),
                           short_number(events.events.back().t_start, 6));
    }
    table.row(events.label, model_name(events.info.model),
              events.kind() == "pe" ? "drops of PE" : events.kind(), events.events.size(),
              fmt::format("{} ≥ {}", events_from(events, threshold), short_number(threshold)),
              starts, short_number(events.share_in_events(), 2), range, events.skipped_lines);
    for (const std::string &note : bin_notes({events}))
      below += "<p>" + html_escape(note) + ".</p>\n";
    for (const std::string &repair : events.repairs)
      below += "<p>" + html_escape(events.label + ": " + repair) + "</p>\n";
  }
  std::string out = table.html();
  for (const std::string &line : texts(least, tables))
    out += "<p>S" + html_escape(line.substr(1)) + ".</p>\n";
  return out + below;
}

std::string series_section(const std::vector<SeriesRegime> &series) {
  double window = regime_window;
  for (const SeriesRegime &one : series)
    if (one.regime) window = one.regime->window;
  return report_part("regimes", {{"table", regime_table(series).html()},
                                 {"window", short_number(window)},
                                 {"limit", short_number(stick_slip_above(120))}});
}

std::string parameter_section(const std::vector<EventTable> &tables) {
  std::vector<std::string> keys, heads = {"parameter"};
  for (const EventTable &table : tables) {
    heads.push_back(table.label);
    for (const auto &parameter : table.info.parameters)
      if (std::find(keys.begin(), keys.end(), parameter.first) == keys.end())
        keys.push_back(parameter.first);
  }
  Table out(heads);
  for (const std::string &key : keys) {
    out.add(key);
    for (const EventTable &table : tables) {
      const std::string *text = table.info.find(key);
      double value = 0.0;
      if (text && text->size() > 8 && text::parse(*text, value))
        out.add(short_number(value, 10));  // numbers in headers have up to 17 digits
      else
        out.add(text ? *text : "–");
    }
    out.end_row();
  }
  return out.html();
}

/// Returns what `draw` returns or, if the data cannot be drawn, a paragraph with the reason. Errors
/// that do not concern the data, about files, folders or gnuplot, are not caught.
template <class Draw>
std::string drawn_or_why(Draw &&draw) {
  try {
    return draw();
  } catch (const DegenerateData &error) {
    return "<p>" + degenerate_html(error.what()) + "</p>\n";
  }
}

/// Value of a parameter in the header, "" if it is missing.
std::string parameter(const EventTable &table, std::string_view key) {
  const std::string *text = table.info.find(key);
  return text ? *text : "";
}

/// Replaces "+-" of terminals by "±".
std::string with_signs(std::string text) {
  constexpr std::string_view typed = " +- ";
  for (std::size_t at = 0; (at = text.find(typed, at)) != std::string::npos;)
    text.replace(at, typed.size(), " ± ");
  return text;
}

/// Groups catalogues of block-sliders by the stiffness of their leaf springs.
/// \param same gets those with the most frequent stiffness
/// \param fig7 gets, as in the paper's Fig. 7, those with other stiffnesses, and of `same` those
/// with the number of blocks of the first of these; empty if all have the same stiffness
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

/// Writes the page of a set of catalogues, model by model.
class ReportPage {
 public:
  explicit ReportPage(const ReportSettings &settings) : settings_(settings) {}

  /// The section about the catalogues of one model and kind of events.
  std::string model(const std::vector<EventTable> &all, const std::string &heading,
                    const std::string &id);
  /// The numbers to quote for all models so far, and whether their roll-off depends on the length.
  std::string in_short() const;
  /// Our rows of Table 1 for all models so far, after the printed ones.
  std::string table1_section() const { return table1(table1_rows(curves_), false).html(); }

 private:
  /// A figure with its caption.
  /// \param title plain text
  /// \param caption HTML
  std::string picture(const Figure &figure, const std::string &title, const std::string &caption) {
    return fmt::format(
        "<figure>\n<div class=\"wide\">{}</div>\n<figcaption><b>{}.</b> {}</figcaption>\n"
        "</figure>\n",
        inline_svg(svg_text(figure), fmt::format("f{}-", ++pictures_), title), html_escape(title),
        caption);
  }
  std::string densities(const std::vector<EventTable> &tables, const Threshold &threshold,
                        const std::vector<PowerLine> &lines, const std::string &caption);
  std::string sizes(const std::vector<EventTable> &all, const std::vector<EventTable> &tables,
                    const std::vector<EventTable> &fig7);
  std::string scaling(const std::vector<EventTable> &tables);
  std::string times(const std::vector<EventTable> &tables);
  std::string section(const ReportSection &section, const std::vector<EventTable> &tables);

  const ReportSettings &settings_;
  int pictures_ = 0;
  std::vector<IntervalCurve> curves_;
  std::vector<SizeFit> fits_;  ///< fits on paper_range()
  std::string verdicts_;
};

std::string ReportPage::in_short() const {
  struct Line {
    const SizeFit &sizes;
    IntervalFit times;
    const char *rejected() const {
      return times.fit.degenerate        ? "not determined"
             : std::isnan(times.p.value) ? ""
             : times.p.value < 0.05      ? "rejected"
                                         : "not rejected";
    }
  };
  TableOf<Line> table;
  table.show("catalogue", [](auto &line) { return line.sizes.label; });
  table.show("sizes", [](auto &line) {
    const PowerLawFit &fit = line.sizes.fit;
    return fmt::format("{} to {}", short_number(fit.lo, 3), short_number(fit.hi, 3));
  });
  table.show("events", [](auto &line) { return line.sizes.fit.n; });
  table.show("exponent", [](auto &line) {
    return Measured{line.sizes.fit.alpha, line.sizes.fit.standard_error};
  });
  table.show("times", [](auto &line) { return line.times.fit.n; });
  table.show(
      "from", [](auto &line) { return line.times.fit.lo; }, 3);
  table.show("γ (δ = 1)", [](auto &line) {
    return Measured{line.times.fit.gamma, line.times.fit.se_gamma};
  });
  table.show("this law of the times", &Line::rejected);
  for (const SizeFit &fit : fits_) {
    const auto curve =
        std::find_if(curves_.begin(), curves_.end(),
                     [&fit](const IntervalCurve &one) { return one.sample.label == fit.label; });
    IntervalFit times;
    if (curve != curves_.end() && !curve->fits.empty()) times = curve->fits.front();
    table.row({fit, times});
  }
  return table.html() + verdicts_;
}

std::string ReportPage::densities(const std::vector<EventTable> &tables, const Threshold &threshold,
                                  const std::vector<PowerLine> &lines, const std::string &caption) {
  return drawn_or_why([&] {
    DensitySettings settings;
    settings.threshold = threshold;
    const std::vector<SizeDensity> all_densities = size_densities(tables, settings);
    std::string whole = caption + " " + report_part("densities caption");
    for (const SizeDensity &density : all_densities)
      if (density.bins.empty()) whole += " No event in range: " + html_escape(density.label) + ".";
    return picture(size_density_figure(all_densities, lines, picture_width),
                   "Densities of event sizes", whole);
  });
}

std::string ReportPage::sizes(const std::vector<EventTable> &all,
                              const std::vector<EventTable> &tables,
                              const std::vector<EventTable> &fig7) {
  struct Printed {
    double slope;
    const char *title;
    Range range;  // The paper prints no ranges. Ours are where its exponents are seen.
  };
  const bool fault = all.front().info.model == "lsm", quakes = all.front().earthquakes();
  const std::vector<Printed> printed =
      quakes  ? std::vector<Printed>{}
      : fault ? std::vector<Printed>{{-1.07, "paper: slope -1.07", paper_range(paper_threshold)}}
              : std::vector<Printed>{{-0.5, "paper: slope -0.5", {1e-2, 1.0}},
                                     {-1.0, "paper: slope -1.0", {1.0, 100.0}}};
  const double threshold =
      settings_.threshold.of(all.front()).size;  // is the same for all of a kind
  SizeFitSettings fits;
  fits.replicas = settings_.replicas;
  fits.seed = settings_.seed;
  fits.threshold = settings_.threshold;
  std::vector<SizeFit> size_fits = fit_sizes(all, fits);
  fits_.insert(fits_.end(), size_fits.begin(), size_fits.end());
  std::vector<PowerLine> lines;
  for (const auto &[slope, title, range] : printed) {
    const double lo = std::max(range.lo, threshold);
    if (!(lo < range.hi)) continue;
    if (!fault) fits.ranges.push_back({lo, range.hi});
    PowerLine line;
    line.slope = slope;
    line.lo = lo;
    line.hi = range.hi;
    line.title = title;
    line.dash = 2 + static_cast<int>(lines.size());
    lines.push_back(line);
  }
  if (!fits.ranges.empty()) {
    const std::vector<SizeFit> between = fit_sizes(all, fits);
    size_fits.insert(size_fits.end(), between.begin(), between.end());
  }
  std::string out =
      kind_part(all.front().kind(), fault ? " of a fault" : " of a chain") +
      densities(tables, settings_.threshold, lines,
                quakes ? "Sizes 10<sup>1.5 M</sup> of the magnitudes M of the files."
                       : report_part("sizes caption", {{"figure", fault ? "12" : "13"},
                                                       {"threshold", short_number(threshold)}}));
  if (!fig7.empty()) out += densities(fig7, 0.0, {}, report_part("stiffness caption"));
  if (!quakes) out += report_part(fault ? "printed fault exponents" : "printed slider exponents");
  return out + "\n" + size_fit_table(size_fits).html();
}

std::string ReportPage::scaling(const std::vector<EventTable> &tables) {
  Resampling bootstrap = settings_.bootstrap;
  bootstrap.seed = settings_.seed;
  std::string out;
  for (const Scaling &one : scale_sizes(tables, settings_.threshold, bootstrap)) {
    std::string figure;
    if (!one.fit.degenerate)
      figure = picture(scaling_figure({one}, picture_width), "Characteristic size against length",
                       report_part("scaling caption"));
    const std::string said =
        one.fit.degenerate ? degenerate_html(one.fit.why) : html_escape(with_signs(verdict(one)));
    verdicts_ += "<p class=\"verdict\">" + html_escape(name_of(one)) + ": " + said + "</p>\n";
    out += report_part("scaling", {{"figure", figure},
                                   {"table", scaling_table({one}).html()},
                                   {"events", one.kind == "pe" ? report_part("drops of PE")
                                                               : kind_part(one.kind, "")},
                                   {"verdict", said}});
  }
  if (!out.empty()) return out;
  return "<p>" + degenerate_html("no catalogue gives its length or number of blocks") + "</p>\n";
}

std::string ReportPage::times(const std::vector<EventTable> &tables) {
  const double threshold = settings_.threshold.of(tables.front()).size;
  IntervalSettings intervals;
  if (settings_.threshold.given) intervals.thresholds = {threshold};
  intervals.replicas = settings_.interval_replicas;
  intervals.seed = settings_.seed;
  const std::vector<IntervalCurve> curves = interval_curves(tables, intervals);
  std::string out = drawn_or_why([&] {
    return picture(interval_figure(curves, false, picture_width), "Densities of inter-event times",
                   report_part("intervals caption",
                               {{"figure", tables.front().info.model == "lsm" ? "14" : "15"},
                                {"threshold", short_number(threshold)}}));
  });
  curves_.insert(curves_.end(), curves.begin(), curves.end());
  intervals.rescale = true;
  intervals.replicas = 0;  // p-values do not change with the unit, and are known already
  return out + drawn_or_why([&] {
           return picture(interval_figure(interval_curves(tables, intervals), true, picture_width),
                          "Inter-event times divided by their mean",
                          report_part("rescaled caption"));
         });
}

/// A section with the tables and figures of a statistic.
std::string ReportPage::section(const ReportSection &section,
                                const std::vector<EventTable> &tables) {
  return "<h3>" + html_escape(section.heading) + "</h3>\n" + drawn_or_why([&] {
           std::string body;
           const Results results = section.find(tables);
           for (const Result &one : results.all()) {
             if (const auto *table = std::get_if<Table>(&one.what))
               body += table->html();
             else if (const auto *figure = std::get_if<Figure>(&one.what))
               body += picture(*figure, section.heading, "");
           }
           return body;
         });
}

std::string ReportPage::model(const std::vector<EventTable> &all, const std::string &heading,
                              const std::string &id) {
  std::vector<EventTable> tables, fig7;
  if (all.front().info.model == "lsm")
    tables = all;
  else
    split_by_stiffness(all, tables, fig7);
  // Called in the order of the page, as figures are numbered in the order in which they are made.
  const std::string of_sizes = sizes(all, tables, fig7);
  const std::string of_lengths = scaling(tables);
  std::string of_times = times(tables);
  for (const ReportSection &one : settings_.sections) of_times += section(one, all);
  return report_part("model", {{"name", heading},
                               {"id", id},
                               {"sizes", of_sizes},
                               {"scaling", of_lengths},
                               {"intervals", of_times}});
}

}  // namespace

std::string report_html(const std::vector<EventTable> &tables, const ReportSettings &settings,
                        const std::vector<SeriesRegime> &series) {
  ReportPage page(settings);
  std::string models, parameters, contents;
  int number = 0;
  std::vector<std::string> kinds = {"pe"};
  for (const EventTable &table : tables)
    if (std::find(kinds.begin(), kinds.end(), table.kind()) == kinds.end())
      kinds.push_back(table.kind());
  for (const char *const of : {"lsm", "block-slider", "seismicity"})
    for (const std::string &kind : kinds) {
      std::vector<EventTable> chosen;
      for (const EventTable &table : tables)
        if (model_name(table.info.model) == std::string_view(model_name(of)) &&
            table.kind() == kind)
          chosen.push_back(table);
      if (chosen.empty()) continue;
      std::string heading = model_name(of) + (kind == "pe" ? "" : ": " + kind);
      heading[0] = static_cast<char>(std::toupper(heading[0]));
      parameters += "<h3>" + heading + "</h3>\n" + parameter_section(chosen);
      const std::string id = fmt::format("model-{}", ++number);
      contents += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", id, heading);
      models += page.model(chosen, heading, id);
    }
  return report_part("page", {{"title", html_escape(settings.title)},
                              {"contents", contents},
                              {"in_short", page.in_short()},
                              {"catalogues", catalogue_section(tables, settings.threshold)},
                              {"regimes", series.empty() ? "" : series_section(series)},
                              {"models", models},
                              {"table1", page.table1_section()},
                              {"rejection_rule", std::string(rejection_rule)},
                              {"replicas", std::to_string(settings.replicas)},
                              {"interval_replicas", std::to_string(settings.interval_replicas)},
                              {"bootstrap", std::to_string(settings.bootstrap.replicas)},
                              {"seed", std::to_string(settings.seed)},
                              {"parameters", parameters}});
}

}  // namespace LSM::postproc
