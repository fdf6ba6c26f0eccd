// SPDX-License-Identifier: GPL-2.0-or-later
#include "explore_page.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "numbers.h"
#include "packed_numbers.h"
#include "table.h"
#include "thinner.h"

namespace LSM::postproc {

namespace {

using nlohmann::json;

/// The elements of the page with its data. Small data are JSON; long columns are packed,
/// each column in an element of its own, whose id stands in the JSON.
class PageData {
 public:
  std::string packed_element(const std::string &id, const std::string &text) {
    elements_ += fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, text);
    return id;
  }

  /// Headers of catalogues may contain anything: none of their text ends the element or begins
  /// another.
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
};

std::string_view bytes_of(const std::vector<std::int8_t> &values) {
  return {reinterpret_cast<const char *>(values.data()), values.size()};
}

json series_json(const ExploreSeries &series, const std::string &id, PageData &data) {
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
              {"bytes", data.packed_element(id + "-pe", packed(bytes_of(code.bytes)))}};
  if (!series.times.empty()) {
    out["begin"] = series.times.front();
    // Each number continues from the rounded ones before it, so that rounding does not add up.
    std::vector<float> gaps;
    double time = series.times.front();
    for (std::size_t i = 1; i < series.times.size(); ++i) {
      gaps.push_back(static_cast<float>(series.times[i] - time));
      time += static_cast<double>(gaps.back());
    }
    out["gaps"] = data.packed_element(id + "-times", packed(gaps));
  }
  return out;
}

json history_json(const SlipImage &image, const std::string &path, const std::string &id,
                  PageData &data) {
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
          {"ends", data.packed_element(id + "-slip-times", packed(image.ends))},
          {"cells", data.packed_element(id + "-slip", packed(bytes_of(image.cells)))}};
}

json bins_json(const std::vector<LogBin> &bins) {
  json out = json::array();
  for (const LogBin &bin : bins)
    if (bin.count > 0) out.push_back({bin.lo, bin.hi, bin.density, bin.error, bin.count});
  return out;
}

/// Adds a number to what is known of it, as the commands print it, or why there is none.
template <class Fit>
void add_number(json &out, const Fit &fit, double value, double error) {
  if (fit.degenerate) {
    out["why"] = fit.why;
    return;
  }
  out["value"] = value;
  out["error"] = error;
  out["text"] = with_error(value, error, " ± ");
}

json exponent_json(const PowerLawFit &fit) {
  json out = {{"lo", fit.lo}, {"hi", fit.hi}, {"n", fit.n}};
  add_number(out, fit, fit.alpha, fit.standard_error);
  return out;
}

json gamma_json(const IntervalFit &fit) {
  const GeneralisedGammaFit &law = fit.fit;
  json out = {{"method", fit.method},
              {"deltaHeld", !std::isnan(fit.held)},
              {"C", law.C},
              {"delta", law.delta},
              {"B", law.B}};
  add_number(out, law, law.gamma, law.se_gamma);
  return out;
}

json threshold_json(const ThresholdResult &result) {
  const IntervalCurve &curve = result.intervals;
  json gammas = json::array();
  for (const IntervalFit &fit : curve.fits) gammas.push_back(gamma_json(fit));
  return {{"size", result.threshold},
          {"times", curve.n},
          {"mean", curve.mean},
          {"meanText", short_number(curve.mean, 6)},
          {"variation", curve.variation},
          {"variationText", short_number(curve.variation)},
          {"burstiness", curve.burstiness()},
          {"burstinessText", short_number(curve.burstiness())},
          {"searched", exponent_json(result.searched)},
          {"toLargest", exponent_json(result.to_largest)},
          {"gammas", gammas},
          {"bins", bins_json(curve.bins)}};
}

json events_json(const ExploreEvents &kind, const std::string &id, PageData &data) {
  const CatalogueInfo &info = kind.table.info;
  std::vector<double> numbers;
  json names = json::array();
  for (const catalogue_detail::Column &column : catalogue_detail::columns_of(info)) {
    names.push_back(column.name);
    for (const Event &event : kind.table.details)
      numbers.push_back(column.number ? event.*column.number
                                      : static_cast<double>(event.*column.integer));
  }
  json thresholds = json::array();
  for (const ThresholdResult &result : kind.thresholds)
    thresholds.push_back(threshold_json(result));
  const SmallestSize usual = Threshold().complete_in(kind.table);
  json parameters = json::array();
  for (const auto &[key, value] : info.parameters) parameters.push_back({key, value});
  return {{"kind", kind.table.kind() == "pe" ? "drops" : kind.table.kind()},
          {"file", kind.table.path},
          {"count", kind.table.events.size()},
          {"listed", kind.table.details.size()},
          {"columns", names},
          {"numbers", data.packed_element(id + "-events", packed(numbers))},
          {"densities", bins_json(log_histogram(column(kind.table.events, &Event::size)))},
          {"usual", usual.size},
          {"usualText", text(usual)},
          {"thresholds", thresholds},
          {"parameters", parameters},
          {"repairs", kind.table.repairs}};
}

json run_json(const ExploreRun &run, const std::string &id, PageData &data) {
  const EventTable &table = run.kinds.front().table;
  const double length = table.length();
  json out = {{"label", table.label}, {"model", table.info.model}, {"length", length}};
  for (const ExploreEvents &kind : run.kinds)
    out["kinds"].push_back(events_json(kind, fmt::format("{}-{}", id, out["kinds"].size()), data));
  out["series"] = run.series ? series_json(*run.series, id, data) : json();
  out["history"] = run.history ? history_json(*run.history, run.history_path, id, data) : json();
  return out;
}

/// What stands between begin and end, from position at on; moves at behind it.
std::string_view between(std::string_view text, std::string_view begin, std::string_view end,
                         std::size_t &at) {
  const std::size_t first = at + begin.size(), last = text.find(end, first);
  if (last == std::string_view::npos)
    throw std::logic_error("explore.html: no '" + std::string(end) + "'");
  at = last + end.size();
  return text.substr(first, last - first);
}

std::string element(std::string_view name, std::string_view file) {
  const std::string_view text = explore_file(file);
  if (text.find(fmt::format("</{}", name)) != std::string_view::npos)
    throw std::logic_error(std::string(file) + " ends its element");
  return fmt::format("<{0}>\n{1}</{0}>", name, text);
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
  for (const ExploreRun &run : runs)
    root["runs"].push_back(run_json(run, fmt::format("run{}", root["runs"].size()), data));

  constexpr std::string_view style = "<link rel=\"stylesheet\" href=\"", style_end = "\">";
  constexpr std::string_view script = "<script src=\"", script_end = "\"></script>";
  const std::string_view page = explore_file("explore.html");
  std::string out;
  for (std::size_t at = 0; at < page.size();) {
    const std::string_view rest = page.substr(at);
    const auto begins = [rest](std::string_view what) {
      return rest.substr(0, what.size()) == what;
    };
    if (begins(style)) {
      out += element("style", between(page, style, style_end, at));
    } else if (begins(script)) {
      out += element("script", between(page, script, script_end, at));
    } else if (begins("{{")) {
      const std::string_view name = between(page, "{{", "}}", at);
      if (name == "title")
        out += html_escape(title);
      else if (name == "data")
        out += data.html(root);
      else
        out += html_escape(explore_file(name));
    } else {
      out += page[at++];
    }
  }
  return out;
}

}  // namespace LSM::postproc
