// SPDX-License-Identifier: GPL-2.0-or-later
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "explore_page.h"
#include "input_file.h"
#include "new_file.h"
#include "series_input.h"

namespace LSM::postproc {

namespace {

// Limits of the page, so that it opens at once: 2^24 samples take some 11 MB.
constexpr std::int64_t most_samples = std::int64_t{1} << 24;
constexpr std::size_t most_events = 100'000;

/// Takes an ending off a path if it has it.
bool take_off(std::string &path, std::string_view ending) {
  if (path.size() <= ending.size() ||
      path.compare(path.size() - ending.size(), ending.size(), ending) != 0)
    return false;
  path.resize(path.size() - ending.size());
  return true;
}

/// A file of the run of a catalogue, or "" if there is none.
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

/// Paths of one kind of file for each catalogue: those given ("none": there is none), or those that
/// are found beside the catalogues; "" for none.
std::vector<std::string> files_beside(const std::vector<std::string> &catalogues,
                                      const std::vector<std::string> &given, const char *option,
                                      const std::string &ending) {
  expect_each(option, given.size(), "catalogue", catalogues.size());
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < catalogues.size(); ++i)
    paths.push_back(given.empty()        ? file_beside(catalogues[i], ending)
                    : given[i] == "none" ? std::string()
                                         : given[i]);
  return paths;
}

ExploreSeries load_series(const std::string &path, const CatalogueOptions &which) {
  const SeriesOptions options{which.lenient, which.from_time, which.to_time};
  SeriesInput input(path, options);
  ExploreSeries series;
  series.path = path;
  series.info = input.info();
  const std::int64_t stride = series.info.stride;
  bool even = !series.info.own_times;
  series.samples = input.read_some([&](std::int64_t step, double time, double pe) {
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
  std::vector<std::string> series_, ruptures_, histories_;
  std::string output_ = "explore.html";

  const char *help() const override {
    return "One self-contained page to explore runs in a browser (ours): PE with its events from "
           "the whole run to single steps, a table of the events, each event with its slip, and "
           "exponent, gamma and burstiness against a smallest size that can be dragged";
  }

  void add_options(CLI::App *command) override {
    catalogues_.add_to(command);
    catalogues_.details = most_events;
    page_.program = "postproc " POSTPROC_VERSION;
    OptionGroup own(command);
    own.add("-o,--output", output_, "The page");
    own.add("--title", page_.title, "Heading of the page", shown("label of the run"));
    OptionGroup group(command,
                      "Files of the runs, in the order of their catalogues; none: leave it out");
    const auto add_files = [&group](const char *name, std::vector<std::string> &paths,
                                    const char *what, const char *where) {
      group.add(name, paths, what, kind("FILE"), shown(where), one_each());
    };
    add_files("--series", series_, "PE series of the run", "RUN.pe.bin beside RUN.catalogue.csv");
    add_files("--ruptures", ruptures_, "Catalogue of the ruptures of the run", "RUN.ruptures.csv");
    add_files("--history", histories_, "Slip history of the run", "RUN.slip.bin");
    add_wave_speeds(OptionGroup(command, "Slip"), page_.p_speed, page_.s_speed);
  }

  /// The runs with their drops of PE, and with their ruptures where there is a catalogue of them.
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
    std::vector<EventTable> tables = load_catalogues(which);
    for (std::size_t k = 0; k < tables.size(); ++k)
      runs[with_ruptures[k]].kinds.push_back(load_kind(std::move(tables[k])));
    return runs;
  }

  void run() override {
    const std::vector<std::string> &paths = catalogues_.paths;
    const auto series = files_beside(paths, series_, "--series", ".pe.bin");
    const auto histories = files_beside(paths, histories_, "--history", ".slip.bin");
    const auto ruptures = files_beside(paths, ruptures_, "--ruptures", ".ruptures.csv");
    for (const auto &files : {paths, series, histories, ruptures}) refuse_input(output_, files);
    std::vector<ExploreRun> runs = load_events(ruptures);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (!series[i].empty()) runs[i].series = load_series(series[i], catalogues_);
      if (histories[i].empty()) continue;
      SlipHistoryReader history = open_history(histories[i], catalogues_.lenient);
      runs[i].history = with_path(histories[i], [&] {
        return slip_image(history, catalogues_.from_time, catalogues_.to_time);
      });
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
