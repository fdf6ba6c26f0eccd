// SPDX-License-Identifier: GPL-2.0-or-later
#include "report_page.h"

#include <fmt/format.h>

#include "command.h"
#include "new_file.h"
#include "page.h"
#include "numbers.h"
#include "run_files.h"
#include "series_input.h"

namespace LSM::postproc {

namespace {

/// Reads a PE series in one pass, and picks its events with the settings in its header.
/// \throws FileError unless it is from the run of one of the catalogues
SeriesRegime series_regime(const std::string &path, const SeriesOptions &options,
                           const std::vector<EventTable> &catalogues) {
  SeriesInput series(path, options);
  const PeSeriesInfo &info = series.info();
  check_same_run(catalogues, {path, info.header()});
  SeriesRegime result = series.about();
  EventPicker picker(picker_settings({}, info));
  EventFilter filter(filter_settings({}, info));
  RegimeMeter meter(regime_window, series.spacing(), length_of(info));
  Event event;
  Extent times;
  result.samples = series.read_some([&](std::int64_t step, double time, double pe) {
    const bool picked = picker.push(step, time, pe, event) && filter.passes(event);
    if (is_before(time, options.from_time)) return;
    times.add(time);
    meter.add(pe);
    if (!picked) return;
    meter.event(std::max(event.t_start, times.lo), event.t_end);
    ++result.events;
  });
  result.first = times.lo;
  result.last = times.hi;
  result.take(meter);
  return result;
}

class Report : public Command {
  CatalogueOptions catalogues_;
  ReportSettings report_;
  std::string output_ = "report.html", block_ = "auto";
  std::vector<std::string> series_;

  const char *help() const override {
    return "One self-contained HTML page on a set of catalogues: parameters, counts, figures "
           "(SVG), fits, finite-size scaling, Table 1, and what of it is "
           "not in the paper";
  }

  void add_options(CLI::App *command) override {
    catalogues_.add_to(command);
    catalogues_.add_magnitude_bin(command);
    OptionGroup group(command);
    group.add("-o,--output", output_, "The page");
    group.add("--title", report_.title, "Heading of the page");
    add_threshold(group, report_.threshold, "the events");
    group.add("--replicas", report_.replicas,
              "Synthetic samples of the Monte Carlo p-values of fitted sizes; 0: none",
              zero_or_more());
    group.add("--interval-replicas", report_.interval_replicas,
              "Synthetic samples of the Monte Carlo p-values of fitted inter-event times; 0: none",
              zero_or_more());
    group.add("--bootstrap", report_.bootstrap.replicas,
              "Resampled catalogues for the errors of the characteristic sizes",
              between(2, 1000000));
    add_block(group, block_);
    add_seed(group, report_.seed);
    group.add(
        "--series", series_,
        "PE series of the runs of the catalogues, whose regime, stick-slip or creep, the page "
        "states †, several allowed; --from, --to and --lenient apply to them as well",
        kind("FILE"), shown(""), one_each());
  }

  void run() override {
    refuse_input(output_, catalogues_.paths);
    refuse_input(output_, series_);
    check_replaced(output_, overwrite, is_page_of("report"));
    report_.bootstrap.block = parse_block(block_);
    const std::vector<EventTable> tables = load_catalogues(catalogues_);
    const SeriesOptions samples{catalogues_.lenient, catalogues_.from_time, catalogues_.to_time};
    std::vector<SeriesRegime> series;
    for (const std::string &path : series_) series.push_back(series_regime(path, samples, tables));
    // Statistics with a heading have a section for each model.
    for (auto &[name, command] : all_commands()) {
      const auto statistic = std::dynamic_pointer_cast<Statistic>(command);
      if (!statistic || !statistic->heading()) continue;
      report_.sections.push_back(
          {statistic->heading(), [statistic](const auto &of) { return statistic->of(of); }});
    }
    write_file(output_, report_html(tables, report_, series));
    fmt::print("wrote {}\n", output_);
  }
};

}  // namespace

std::shared_ptr<Command> make_report() { return std::make_shared<Report>(); }

}  // namespace LSM::postproc
