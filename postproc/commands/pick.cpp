// SPDX-License-Identifier: GPL-2.0-or-later
#include <optional>

#include <fmt/format.h>

#include "command.h"
#include "new_file.h"
#include "series_options.h"

namespace LSM::postproc {

namespace {

/// The parameters that the run itself writes to its catalogue: those of the series, dt, and the
/// settings of the picker. A value that has not changed keeps its text.
files::Parameters catalogue_parameters(const PeSeriesInfo &info, const PickerSettings &picker,
                                       const FilterSettings &filter) {
  // all drops are picked, whatever the run counted as events
  files::Parameters parameters =
      files::without(info.parameters, {"events", "rupture_gap", "plate_drops"});
  // dt is where the runs write it: before `viscosity` (fault) or `picker` (block-slider).
  const auto after_dt =
      std::find_if(parameters.begin(), parameters.end(), [](const auto &parameter) {
        return parameter.first == "viscosity" || parameter.first == "picker";
      });
  parameters.insert(
      after_dt, {"dt", info.model == "lsm" ? text::number(info.dt) : fmt::format("{}", info.dt)});
  set_parameter(parameters, "picker", to_string(picker.reading));
  const auto set_number = [&parameters](const std::string &key, double value) {
    double there = 0.0;
    const std::string *text = files::find(parameters, key);
    if (!text || !text::parse(*text, there) || there != value)
      set_parameter(parameters, key, fmt::format("{}", value));
  };
  set_number("lambda", picker.lambda);
  set_number("min_size", filter.min_size);
  if (filter.keep_nonpositive || files::find(parameters, "keep_nonpositive"))
    set_parameter(parameters, "keep_nonpositive", filter.keep_nonpositive ? "yes" : "no");
  if (filter.warmup > 0.0 || files::find(parameters, "warmup")) set_number("warmup", filter.warmup);
  if (info.stride > 1) set_parameter(parameters, "stride", text::number(info.stride));
  set_parameter(parameters, "picked_by", "postproc " POSTPROC_VERSION);
  return parameters;
}

class Pick : public Analysis {
  std::string series_;
  SeriesOptions samples_;
  PickerOptions picker_;
  std::optional<double> warmup_;

  const char *help() const override {
    return "Picks the events of a PE series and writes their catalogue (paper: Sect. 4.1). The "
           "rows are those that the run itself writes with the same settings, without the "
           "columns on slip; next to a leap of the block-slider starts and ends may differ by less "
           "than the memory of the picker";
  }

  void add_options(CLI::App *command) override {
    OptionGroup group(command);
    add_series(group, series_, samples_, false);
    add_file(group, "Catalogue to write");
    json.add_to(command);
    group.add("--warmup", warmup_,
              "Leave out events that start before this time (model time) † (default: as in the "
              "header of the series, or 0)");
    add_picker_options(command, picker_);
  }

  std::vector<std::string> inputs() const override { return {series_}; }

  Results find() override {
    SeriesInput series(series_, samples_);
    const PeSeriesInfo &info = series.info();
    EventPicker picker(picker_settings(picker_, info));
    FilterSettings settings = filter_settings(picker_, info);
    settings.warmup = 0.0;
    if (const std::string *text = info.find("warmup")) text::parse(*text, settings.warmup);
    if (warmup_) settings.warmup = *warmup_;
    EventFilter filter(settings);

    CatalogueInfo header;
    header.model = info.model;
    header.parameters = catalogue_parameters(info, picker.settings(), settings);
    const auto file = std::make_shared<ClaimedFile<CatalogueWriter>>(file_, overwrite);
    CatalogueWriter &catalogue = file->writer;
    catalogue.create(file_, header, true);
    Event event;
    const std::int64_t samples = series.read([&](std::int64_t step, double time, double pe) {
      if (!picker.push(step, time, pe, event) || !filter.passes(event)) return;
      filter.number(event);
      catalogue.write(event);
    });
    const FilterCounts &out = filter.counts();
    Results results;
    results.say(fmt::format(
        "{} samples, {} events; not written: {} of size <= 0, {} below the minimum size, {} "
        "before the warm-up ended{}\n",
        samples, catalogue.rows(), out.dropped_nonpositive, out.dropped_small, out.before_warmup,
        picker.in_event() ? ", 1 that had not ended" : ""));
    results.file(file_, [file] { file->writer.close(); });
    Table counts("samples,events,nonpositive,small,before_warmup,unfinished");
    counts.row(samples, catalogue.rows(), out.dropped_nonpositive, out.dropped_small,
               out.before_warmup, picker.in_event());
    results.table("counts", std::move(counts));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_pick() { return std::make_shared<Pick>(); }

}  // namespace LSM::postproc
