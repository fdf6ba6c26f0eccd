// SPDX-License-Identifier: GPL-2.0-or-later
#include "explore_page.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "densities.h"
#include "numbers.h"
#include "packed_numbers.h"
#include "table.h"
#include "thinner.h"

namespace LSM::postproc {

using nlohmann::json;

namespace {

/// Returns the text with each {{key}} replaced by value(key).
template <class Value>
std::string filled(std::string_view text, const Value &value) {
  std::string out;
  for (std::size_t open = 0; (open = text.find("{{")) != std::string_view::npos;) {
    const std::size_t close = text.find("}}", open);
    out += text.substr(0, open);
    out += value(text.substr(open + 2, close - open - 2));
    text.remove_prefix(close + 2);
  }
  return out += text;
}

/// The elements of the page that hold its data. Small data are JSON. Each long column is packed in
/// an element of its own, whose id is in the JSON.
class PageData {
 public:
  /// Adds a long column.
  /// \return id of its element
  template <class Number>
  std::string add(const std::vector<Number> &values) {
    std::string id = fmt::format("packed{}", count_++);
    elements_ +=
        fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, packed(values));
    return id;
  }

  /// Returns all elements. Headers of catalogues may contain any text, so '<', '>' and '&' are
  /// escaped: otherwise text could end the element or begin another one.
  std::string html(const json &root) const {
    std::string text;
    for (const char c : root.dump(-1, ' ', true, json::error_handler_t::replace))
      text += c == '<'   ? "\\u003c"
              : c == '>' ? "\\u003e"
              : c == '&' ? "\\u0026"
                         : std::string(1, c);
    return elements_ + "<script type=\"application/json\" id=\"data\">" + text + "</script>\n";
  }

 private:
  std::string elements_;
  int count_ = 0;
};

json series_json(const ExploreSeries &series, PageData &data) {
  const SeriesCode code = encode(series.pe);
  json out = {{"file", series.path},
              {"samples", series.samples},
              {"kept", series.pe.size()},
              {"firstStep", series.first_step},
              {"stride", series.info.stride},
              {"begin", series.info.time(series.first_step)},
              {"spacing", series.info.dt * static_cast<double>(series.info.stride)},
              {"first", code.first},
              {"second", code.second},
              {"off", code.off},
              {"bytes", data.add(code.bytes)}};
  if (!series.times.empty()) {
    out["begin"] = series.times.front();
    // Each gap starts from the rounded time before it, so that rounding errors do not accumulate.
    std::vector<float> gaps;
    double time = series.times.front();
    for (std::size_t i = 1; i < series.times.size(); ++i) {
      gaps.push_back(static_cast<float>(series.times[i] - time));
      time += static_cast<double>(gaps.back());
    }
    out["gaps"] = data.add(gaps);
  }
  return out;
}

json history_json(const SlipImage &image, const std::string &path, PageData &data) {
  const FaultGrid &grid = image.info.grid;
  return {{"file", path},
          {"columns", image.columns},
          {"rows", image.ends.size()},
          {"x0", grid.x0},
          {"length", grid.length()},
          {"columnWidth", grid.width * image.bins_per_column},
          {"binsPerColumn", image.bins_per_column},
          {"recordsPerRow", image.records_per_row},
          {"driving", image.info.driving},
          {"slipping", image.info.ruptures.velocity / image.info.driving},
          {"begin", image.begin},
          {"velocity", image.velocity},
          {"ends", data.add(image.ends)},
          {"cells", data.add(image.cells)}};
}

json bins_json(const std::vector<LogBin> &bins) {
  json out = json::array();
  for (const LogBin &bin : bins)
    if (bin.count > 0) out.push_back({bin.lo, bin.hi, bin.density, bin.error, bin.count});
  return out;
}

/// Adds a fitted number to its JSON object, also as text, or the reason why there is none.
template <class Fit>
void add_number(json &out, const Fit &fit, double value, double error) {
  if (fit.degenerate)
    out["why"] = fit.why;
  else
    out.update({{"value", value}, {"error", error}, {"text", with_error(value, error, " ± ")}});
}

}  // namespace

// The JSON library finds these functions by their name, also for vectors of these types.
static void to_json(json &out, const PowerLawFit &fit) {
  out = {{"lo", fit.lo}, {"hi", fit.hi}, {"n", fit.n}};
  add_number(out, fit, fit.alpha, fit.standard_error);
}

static void to_json(json &out, const IntervalFit &fit) {
  const GeneralisedGammaFit &law = fit.fit;
  out = {{"method", fit.method},
         {"deltaHeld", !std::isnan(fit.held)},
         {"C", law.C},
         {"delta", law.delta},
         {"B", law.B}};
  add_number(out, law, law.gamma, law.se_gamma);
}

static void to_json(json &out, const ThresholdResult &result) {
  const IntervalCurve &curve = result.intervals;
  out = {{"size", result.threshold},
         {"times", curve.n},
         {"mean", curve.mean},
         {"meanText", short_number(curve.mean, 6)},
         {"variation", curve.variation},
         {"variationText", short_number(curve.variation)},
         {"burstiness", curve.burstiness()},
         {"burstinessText", short_number(curve.burstiness())},
         {"law", result.law},
         {"gammas", curve.fits},
         {"bins", bins_json(curve.bins)}};
}

namespace {

std::vector<LogBin> densities_of(const EventTable &table) {
  return table.size_step() > 0.0 ? size_density(table).bins
                                 : log_histogram(column(table.events, &Event::size));
}

json events_json(const ExploreEvents &kind, PageData &data) {
  const EventTable &table = kind.table;
  std::vector<double> cells;
  json names = json::array();
  for (const CatalogueColumn &column : columns_of(table.info)) {
    names.push_back(column.name);
    for (const EventRow &event : table.details) cells.push_back(column.of(event));
  }
  const SmallestSize usual = Threshold().of(table);
  return {{"kind", table.kind() == "pe" ? "drops" : table.kind()},
          {"file", table.path},
          {"count", table.events.size()},
          {"listed", table.details.size()},
          {"columns", names},
          {"numbers", data.add(cells)},
          {"densities", bins_json(densities_of(table))},
          {"usual", usual.size},
          {"usualText", text(usual)},
          {"thresholds", kind.thresholds},
          {"parameters", table.info.parameters},
          {"repairs", table.repairs}};
}

json run_json(const ExploreRun &run, PageData &data) {
  const EventTable &table = run.kinds.front().table;
  json out = {{"label", table.label}, {"model", table.info.model}, {"length", table.length()}};
  for (const ExploreEvents &kind : run.kinds) out["kinds"].push_back(events_json(kind, data));
  out["series"] = run.series ? series_json(*run.series, data) : json();
  out["history"] = run.history ? history_json(*run.history, run.history_path, data) : json();
  return out;
}

}  // namespace

void ExploreSeries::thin(std::int64_t most) {
  if (static_cast<std::int64_t>(pe.size()) <= most) return;
  std::vector<double> some, some_times;
  for (const std::size_t i : smallest_and_largest(pe, static_cast<std::size_t>(most))) {
    some.push_back(pe[i]);
    some_times.push_back(times.empty()
                             ? info.time(first_step + static_cast<std::int64_t>(i) * info.stride)
                             : times[i]);
  }
  pe = std::move(some);
  times = std::move(some_times);
}

std::string_view head_of_page() {
  const std::string_view page = page_file("explore.html");
  return page.substr(0, page.find("<title>"));
}

std::string explore_html(const std::vector<ExploreRun> &runs, const ExploreSettings &settings) {
  std::string title = settings.title;
  if (title.empty())
    title =
        runs.size() > 1 ? fmt::format("{} runs", runs.size()) : runs.at(0).kinds.at(0).table.label;
  PageData data;
  json root = {{"title", title},
               {"program", settings.program},
               {"pSpeed", settings.p_speed},
               {"sSpeed", settings.s_speed},
               {"runs", json::array()}};
  for (const ExploreRun &run : runs) root["runs"].push_back(run_json(run, data));
  return filled(page_file("explore.html"), [&](std::string_view name) {
    return name == "title"                  ? html_escape(title)
           : name == "data"                 ? data.html(root)
           : name == "dygraphs-licence.txt" ? html_escape(page_file(name))
                                            : std::string(page_file(name));
  });
}

}  // namespace LSM::postproc
