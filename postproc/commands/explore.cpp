// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "command.h"
#include "explore_page.h"
#include "input_file.h"
#include "new_file.h"
#include "files/header_keys.h"
#include "series_input.h"

namespace LSM::postproc {

namespace {

/// Removes an ending from a path if the path has it.
bool take_off(std::string &path, std::string_view ending) {
  if (path.size() <= ending.size() ||
      path.compare(path.size() - ending.size(), ending.size(), ending) != 0)
    return false;
  path.resize(path.size() - ending.size());
  return true;
}

/// Path of the file with this ending beside a catalogue, or "" if there is none.
std::string file_beside(const std::string &catalogue, const std::string &ending) {
  std::string base = catalogue;
  for (const std::string_view packed : {".gz", ".xz"})
    if (take_off(base, packed)) break;
  for (const std::string_view kind : {".catalogue.csv", ".ruptures.csv", ".csv"})
    if (take_off(base, kind)) break;
  for (const char *const packed : {"", ".gz", ".xz"}) {
    const std::string path = base + ending + packed;
    if (path != catalogue && std::filesystem::exists(path)) return path;
  }
  return {};
}

// The page is limited so that browsers open it at once: 2^24 samples take some 11 MB.
constexpr std::int64_t most_samples = std::int64_t{1} << 24;
constexpr std::size_t most_events = 100'000;

// Speeds of long waves in packings of create_lsm_fault with its defaults, as measured.
constexpr double p_speed = 2.00, s_speed = 1.05;

// Files of one kind, one for each catalogue.
struct RunFiles {
  const char *option, *what, *ending;
  std::vector<std::string> given = {};

  /// A path for each catalogue: as given, or beside it; "": it has none.
  std::vector<std::string> of(const std::vector<std::string> &catalogues) const {
    expect_each(option, given.size(), "catalogue", catalogues.size());
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < catalogues.size(); ++i)
      paths.push_back(given.empty()        ? file_beside(catalogues[i], ending)
                      : given[i] == "none" ? std::string()
                                           : given[i]);
    return paths;
  }
};

/// Checks that a file is from the same run as a catalogue, as files with the same prefix may not
/// be. Settings of what is recorded may differ. \throws FileError if another setting that is in
/// both headers differs
void check_same_run(const EventTable &of, const std::string &path,
                    const files::Parameters &parameters) {
  for (const auto &[key, value] : of.info.header()) {
    const std::string *const there = files::find(parameters, key);
    double a = 0.0, b = 0.0;
    const HeaderKey *const known = header_key(key);
    if (!there || *there == value || (known && known->of == HeaderKey::Of::recording) ||
        (text::parse(value, a) && text::parse(*there, b) && a == b))
      continue;
    throw FileError(fmt::format("{}: {} = {}, but {} in {}: expected a file of the same run", path,
                                key, *there, value, of.path));
  }
}

/// Checks that series and catalogue count steps and times from the same start.
/// \throws FileError otherwise
void check_same_start(const EventTable &table, const ExploreSeries &series) {
  if (table.details.empty() || series.info.explicit_times) return;
  const Event &event = table.details.front();
  const double expected = series.info.time(event.step_start);
  if (std::fabs(event.t_start - expected) > 1e-9 * std::fabs(expected) + 1e-6 * series.info.dt)
    throw FileError(
        fmt::format("{}: step {} is at time {}, but at {} in {}: expected a file of the same run",
                    series.path, event.step_start, expected, event.t_start, table.path));
}

ExploreSeries load_series(const std::string &path, const CatalogueOptions &which) {
  const SeriesOptions options{which.lenient, which.from_time, which.to_time};
  SeriesInput input(path, options);
  ExploreSeries series;
  series.path = path;
  series.info = input.info();
  const std::int64_t stride = series.info.stride;
  bool even = !series.info.explicit_times;
  series.samples = input.read_some([&](std::int64_t step, double time, double pe) {
    if (is_before(time, options.from_time)) return;
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
  series.thin(most_samples);
  return series;
}

ExploreEvents load_kind(EventTable table) {
  if (table.events.empty())
    throw std::runtime_error(table.path + ": no events, expected at least one");
  ExploreEvents kind;
  kind.thresholds = scan_thresholds(table, threshold_grid(table));
  kind.table = std::move(table);
  return kind;
}

class Explore : public Command {
  CatalogueOptions catalogues_;
  ExploreSettings page_;
  RunFiles series_ = {"--series", "PE series of the run", ".pe.bin"},
           ruptures_ = {"--ruptures", "Catalogue of the ruptures of the run", ".ruptures.csv"},
           histories_ = {"--history", "Slip history of the run", ".slip.bin"};
  std::string output_ = "explore.html";

  const char *help() const override {
    return "One self-contained page to explore runs in a browser †: PE, a table of the events, each "
           "event with its slip, and statistics against a smallest size that can be dragged";
  }

  void add_options(CLI::App *command) override {
    add_catalogues(command, catalogues_);
    add_magnitude_bin(command, catalogues_);
    catalogues_.details = most_events;
    page_ = {"", p_speed, s_speed, "postproc " POSTPROC_VERSION};
    OptionGroup own(command);
    own.add("-o,--output", output_, "The page");
    own.add("--title", page_.title, "Heading of the page", shown("label of the run"));
    OptionGroup beside(command,
                       "Files of the runs, in the order of their catalogues; none: leave it out");
    for (RunFiles *files : {&series_, &ruptures_, &histories_})
      beside.add(files->option, files->given, files->what, kind("FILE"),
                 shown(fmt::format("RUN{} beside RUN.catalogue.csv", files->ending)), one_each());
  }

  /// Loads the runs with their drops of PE, and with the ruptures where a run has a catalogue of
  /// them.
  std::vector<ExploreRun> load_events(const std::vector<std::string> &ruptures) const {
    std::vector<ExploreRun> runs;
    for (EventTable &table : load_catalogues(catalogues_)) {
      runs.emplace_back();
      runs.back().kinds.push_back(load_kind(std::move(table)));
    }
    CatalogueOptions which = catalogues_;
    which.paths.clear();
    which.labels.clear();
    std::vector<std::size_t> with_ruptures;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (ruptures[i].empty()) continue;
      with_ruptures.push_back(i);
      which.paths.push_back(ruptures[i]);
      which.labels.push_back(runs[i].kinds.front().table.label);
    }
    if (which.paths.empty()) return runs;
    which.where.clear();  // of the drops; ruptures have other columns
    std::vector<EventTable> tables = load_catalogues(which);
    for (std::size_t k = 0; k < tables.size(); ++k) {
      ExploreRun &run = runs[with_ruptures[k]];
      const EventTable &drops = run.kinds.front().table;
      if (!tables[k].info.overlapping())
        throw FileError(tables[k].path + ": no catalogue of ruptures, expected one");
      check_same_run(drops, tables[k].path, tables[k].info.header());
      // Short runs may have no ruptures, which is an error only in a catalogue that was asked for.
      if (tables[k].events.empty() && ruptures_.given.empty())
        fmt::print(stderr, "postproc: {}: no ruptures, left out\n", tables[k].path);
      else
        run.kinds.push_back(load_kind(std::move(tables[k])));
    }
    return runs;
  }

  void run() override {
    const std::vector<std::string> &paths = catalogues_.paths;
    const auto series = series_.of(paths), histories = histories_.of(paths),
               ruptures = ruptures_.of(paths);
    for (const auto &files : {paths, series, histories, ruptures}) refuse_input(output_, files);
    check_replaced(output_, overwrite, begins_with(std::string(head_of_page())));
    std::vector<ExploreRun> runs = load_events(ruptures);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const EventTable &drops = runs[i].kinds.front().table;
      if (!series[i].empty()) {
        runs[i].series = load_series(series[i], catalogues_);
        check_same_run(drops, series[i], runs[i].series->info.header());
        check_same_start(drops, *runs[i].series);
      }
      if (histories[i].empty()) continue;
      SlipHistoryReader history = open_history(histories[i], catalogues_.lenient);
      check_same_run(drops, histories[i], history.info().header());
      runs[i].history = slip_image(history, catalogues_.from_time, catalogues_.to_time);
      runs[i].history_path = histories[i];
    }
    const std::string page = explore_html(runs, page_);
    write_file(output_, page);
    for (const ExploreRun &one : runs) {
      for (const ExploreEvents &kind : one.kinds)
        fmt::print("{}: {} events, {} thresholds\n", kind.table.path, kind.table.events.size(),
                   kind.thresholds.size());
      if (one.series) fmt::print("{}: {} samples\n", one.series->path, one.series->samples);
      if (one.history)
        fmt::print("{}: {} places, {} times\n", one.history_path, one.history->columns,
                   one.history->ends.size());
    }
    fmt::print("wrote {} ({:.1f} MB)\n", output_, static_cast<double>(page.size()) * 1e-6);
  }
};

}  // namespace

std::shared_ptr<Command> make_explore() { return std::make_shared<Explore>(); }

}  // namespace LSM::postproc
