// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "commands.h"
#include "explore_page.h"
#include "input_file.h"
#include "new_file.h"
#include "option_values.h"
#include "series_input.h"

namespace LSM::postproc {

namespace {

// What the page holds at most, so that it opens at once: 2^24 samples take some 11 MB.
constexpr std::int64_t most_samples = std::int64_t{1} << 24;
constexpr std::size_t most_events = 100'000;

struct Options {
  CatalogueOptions catalogues;
  ExploreSettings page;
  std::vector<std::string> series, ruptures, histories;
  std::string output = "explore.html";
};

/// Takes an ending off a path if it has it.
bool take_off(std::string &path, std::string_view ending) {
  if (path.size() <= ending.size() ||
      path.compare(path.size() - ending.size(), ending.size(), ending) != 0)
    return false;
  path.resize(path.size() - ending.size());
  return true;
}

/// A file of the run of a catalogue, or "" if there is none.
std::string file_beside(const std::string &catalogue, const std::vector<std::string> &endings) {
  std::string base = catalogue;
  for (const std::string_view ending : {".gz", ".xz"})
    if (take_off(base, ending)) break;
  for (const std::string_view ending : {".catalogue.csv", ".ruptures.csv", ".csv"})
    if (take_off(base, ending)) break;
  for (const std::string &ending : endings)
    for (const std::string_view packed : {"", ".gz", ".xz"}) {
      std::string path = base + ending;
      path += packed;
      if (path != catalogue && std::filesystem::exists(path)) return path;
    }
  return {};
}

/// Paths of one kind of file for each catalogue: those given ("none": there is none), or those that
/// are found beside the catalogues; "" for none.
std::vector<std::string> files_beside(const std::vector<std::string> &catalogues,
                                      const std::vector<std::string> &given,
                                      const std::string &option,
                                      const std::vector<std::string> &endings) {
  if (!given.empty() && given.size() != catalogues.size())
    throw std::invalid_argument(fmt::format("{} given {} times, expected once per catalogue ({})",
                                            option, given.size(), catalogues.size()));
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < catalogues.size(); ++i)
    paths.push_back(given.empty()        ? file_beside(catalogues[i], endings)
                    : given[i] == "none" ? std::string()
                                         : given[i]);
  return paths;
}

ExploreSeries load_series(const std::string &path, const CatalogueOptions &which) {
  ExploreSeries series;
  series.path = path;
  series.info = PeSeriesReader(path, which.lenient, open_input).info();
  SeriesOptions options;
  options.lenient = which.lenient;
  options.from_time = which.from_time;
  options.to_time = which.to_time;
  const std::int64_t stride = series.info.stride;
  bool even = !series.info.own_times;
  series.samples = read_series(path, options, [&](std::int64_t step, double time, double pe) {
    if (time < options.from_time) return;
    const auto count = static_cast<std::int64_t>(series.pe.size());
    if (count == 0) series.first_step = step;
    if (even && step != series.first_step + count * stride) {
      even = false;
      for (std::int64_t k = 0; k < count; ++k)
        series.times.push_back(series.info.time(series.first_step + k * stride));
    }
    series.pe.push_back(pe);
    if (!even) series.times.push_back(time);
  });
  if (series.samples < 3)
    throw std::runtime_error(fmt::format(
        "{}: {} samples in the window of time, expected at least 3", path, series.samples));
  series.thin(most_samples);
  return series;
}

ExploreEvents load_kind(EventTable table, const CatalogueOptions &which) {
  ExploreEvents kind;
  read_events(table.path, which, [&kind](const Event &event) { kind.events.push_back(event); });
  if (kind.events.empty())
    throw std::runtime_error(table.path + ": no events, expected at least one");
  std::stable_sort(kind.events.begin(), kind.events.end(),
                   [](const Event &a, const Event &b) { return a.t_start < b.t_start; });
  kind.thin(most_events);
  kind.thresholds = scan_thresholds(table, threshold_grid(table));
  kind.table = std::move(table);
  return kind;
}

void run(const Options &options) {
  const CatalogueOptions &which = options.catalogues;
  const std::vector<std::string> &paths = which.paths;
  const std::vector<std::string> series =
      files_beside(paths, options.series, "--series", {".pe.bin", ".pe.csv"});
  const std::vector<std::string> histories =
      files_beside(paths, options.histories, "--history", {".slip.bin"});
  CatalogueOptions ruptures = which;
  ruptures.paths = files_beside(paths, options.ruptures, "--ruptures", {".ruptures.csv"});
  for (const auto &files : {paths, series, histories, ruptures.paths})
    refuse_input(options.output, files);

  std::vector<ExploreRun> runs;
  for (EventTable &table : load_catalogues(which)) {
    runs.emplace_back();
    runs.back().kinds.push_back(load_kind(std::move(table), which));
  }
  std::vector<std::size_t> with_ruptures;
  ruptures.labels.clear();
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (!ruptures.paths[i].empty()) {
      with_ruptures.push_back(i);
      ruptures.labels.push_back(runs[i].kinds.front().table.label);
    }
  ruptures.paths.erase(std::remove(ruptures.paths.begin(), ruptures.paths.end(), ""),
                       ruptures.paths.end());
  std::vector<EventTable> tables = load_catalogues(ruptures);
  for (std::size_t k = 0; k < tables.size(); ++k)
    runs[with_ruptures[k]].kinds.push_back(load_kind(std::move(tables[k]), ruptures));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!series[i].empty()) runs[i].series = load_series(series[i], which);
    if (histories[i].empty()) continue;
    runs[i].history = load_slip_image(histories[i], which.lenient, which.from_time, which.to_time);
    runs[i].history_path = histories[i];
  }
  const std::string page = explore_html(runs, options.page);
  write_file(options.output, page);
  for (const ExploreRun &one : runs) {
    for (const ExploreEvents &kind : one.kinds)
      fmt::print("{}: {} events, {} thresholds\n", kind.table.path, kind.table.size.size(),
                 kind.thresholds.size());
    if (one.series) fmt::print("{}: {} samples\n", one.series->path, one.series->samples);
    if (one.history)
      fmt::print("{}: {} places, {} times\n", one.history_path, one.history->columns,
                 one.history->ends.size());
  }
  fmt::print("wrote {} ({:.1f} MB)\n", options.output, static_cast<double>(page.size()) * 1e-6);
}

}  // namespace

void add_explore(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "explore",
      "One self-contained page to explore runs in a browser (ours): PE with its "
      "events from the whole run to single steps, a table of the events, each event with its slip, "
      "and size exponent, gamma and burstiness against a threshold that is dragged");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  options->page.program = "postproc " POSTPROC_VERSION;
  command->add_option("-o,--output", options->output, "The page");
  command->add_option("--title", options->page.title, "Heading of the page")
      ->default_str("label of the run");
  const std::string group = "Files of the runs, in the order of their catalogues; none: without";
  const auto add_files = [&](const char *name, std::vector<std::string> &paths, const char *what,
                             const char *where) {
    command->add_option(name, paths, what)
        ->type_name("FILE")
        ->default_str(where)
        ->allow_extra_args(false)
        ->group(group);
  };
  add_files("--series", options->series, "PE series of the run",
            "RUN.pe.bin or RUN.pe.csv beside RUN.catalogue.csv");
  add_files("--ruptures", options->ruptures, "Catalogue of the ruptures of the run",
            "RUN.ruptures.csv");
  add_files("--history", options->histories, "Slip history of the run", "RUN.slip.bin");
  add_wave_speeds(command, options->page.p_speed, options->page.s_speed, "Slip");
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
