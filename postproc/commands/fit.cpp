// SPDX-License-Identifier: GPL-2.0-or-later
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.h"
#include "numbers.h"
#include "size_figures.h"

namespace LSM::postproc {

namespace {

class Fit : public Statistic {
  SizeFitSettings settings_;
  std::vector<std::string> ranges_;
  bool scaling_ = false, no_comparison_ = false, roll_off_ = false;
  Resampling bootstrap_;

  const char *help() const override {
    return "Exponents of the event sizes by maximum likelihood, goodness of fit of a power law, "
           "and, with --scaling, whether the roll-off moves with the length † (the paper "
           "fitted binned densities: 1.07 for the fault, 0.5 and 1.0 for the block-slider)";
  }

  void add_options(CLI::App *command) override {
    add_usual(command, "fit");
    catalogues.add_magnitude_bin(command);
    OptionGroup group(command, "Fit");
    group.add("--range", ranges_,
              "LO:HI, sizes that are fitted, several allowed; without it three decades, as in the "
              "paper, from --threshold on. "
              "LO is raised to the smallest size in the catalogue (--min-size, or min_size in "
              "its header)",
              kind("LO:HI"), shown(""), one_each());
    add_threshold(group, settings_.threshold, "the range, the search, the picture and the scaling");
    group.flag("--search", settings_.search,
               "Also the range with the smallest Kolmogorov-Smirnov distance, a line of its own "
               "marked 'searched' †");
    group.add("--replicas", settings_.replicas,
              "Synthetic samples of the Monte Carlo p-value; 0: none", zero_or_more());
    add_seed(group, settings_.seed);
    group.flag("--no-comparison", no_comparison_, "Leave out the rival laws");
    group.flag(
        "--roll-off", roll_off_,
        "Also the power d of the roll-off s^-a exp(-(s/c)^d) of the sizes from --threshold "
        "on, taken as continuous also where magnitudes are in bins, and 2 ln L of d = 1 over "
        "a power law without end †");
    group.flag("--scaling", scaling_,
               "Characteristic size <s^2>/<s> against length for each model: a power law, no "
               "dependence, or growth that ends at a length †");
    group.add("--bootstrap", bootstrap_.replicas,
              "Resampled catalogues for the errors of --scaling", between(2, 1000000));
    group.call<std::string>(
        "--block",
        [this](const std::string &text) {
          if (text != "auto" && !(text::parse(text, bootstrap_.block) && bootstrap_.block >= 0.0))
            throw std::invalid_argument("--block " + text::in_quotes(text) +
                                        ", expected 'auto' or a time of 0 or more");
        },
        "Length of the blocks of time that are resampled for these errors, since events cluster "
        "(model time): auto, from the correlation of each catalogue (Politis and White 2004); or "
        "0, single events as if independent",
        shown("auto"));
  }

  std::vector<std::string> endings() const override {
    std::vector<std::string> files = picture_files({".scaling"});
    files.insert(files.end(), {".fits.csv", ".rolloff.csv"});
    return files;
  }

  /// The form of the roll-off of each catalogue.
  Table roll_offs(const std::vector<EventTable> &tables) const {
    struct Line {
      const EventTable &table;
      double least;
      RollOff found;
    };
    TableOf<Line> out;
    out.column("label", "roll-off", [](auto &line) { return line.table.label; });
    out.column("threshold", "sizes from", &Line::least);
    out.column("n", "events", [](auto &line) { return line.found.exponential.n; });
    out.column("power", "power d", [](auto &line) {
      return Measured{line.found.free.delta, line.found.free.se_delta};
    });
    out.column("gain", "2 ln L of d = 1", [](auto &line) { return line.found.gain; });
    out.column("degenerate", "degenerate", [](auto &line) { return line.found.free.why; });
    for (const EventTable &table : tables) {
      const double least = settings_.threshold.of(table).size;
      out.row({table, least, roll_off(table, least)});
    }
    return Table(std::move(out));
  }

  /// The densities of all catalogues, with the laws fitted to them.
  Figure densities(const std::vector<EventTable> &tables, const std::vector<SizeFit> &fits) const {
    DensitySettings settings;
    double least = settings_.threshold.given.value_or(paper_threshold);
    for (const Range &range : settings_.ranges) least = std::min(least, range.lo);
    settings.threshold = settings_.ranges.empty() ? settings_.threshold : Threshold(least);
    const std::vector<SizeDensity> densities = size_densities(tables, settings);
    std::vector<PowerLine> lines;
    for (const SizeFit &fit : fits)
      if (!fit.fit.degenerate) lines.push_back(fitted_line(fit, densities[fit.catalogue]));
    Figure figure = size_density_figure(densities, lines);
    figure.table.comment(texts(settings.threshold, tables));
    return figure;
  }

  Results of(const std::vector<EventTable> &tables) override {
    for (const std::string &text : ranges_) {
      settings_.ranges.push_back(parse_range("--range", text));
      if (!(settings_.ranges.back().lo > 0.0))
        throw std::invalid_argument("--range '" + text + "', expected LO above 0");
    }
    settings_.compare = !no_comparison_;
    const std::vector<SizeFit> fits = fit_sizes(tables, settings_);
    std::vector<Scaling> scalings;
    if (scaling_) {
      bootstrap_.seed = settings_.seed;
      scalings = scale_sizes(tables, settings_.threshold, bootstrap_);
      if (scalings.empty())
        throw DegenerateData("--scaling: no catalogue gives its length or number of blocks");
    }
    Results results;
    if (settings_.ranges.empty()) results.say(texts(settings_.threshold, tables));
    results.say(completeness_notes(fits));
    results.say(bin_notes(tables));
    results.numbers("fits", nlohmann::json(fits));
    for (const Scaling &scaling : scalings) results.say(scaling_text(scaling));
    if (scaling_) results.numbers("scaling", nlohmann::json(scalings));
    if (scaling_) results.table("", scaling_table(scalings));
    results.table("", size_fit_table(fits), ".fits");
    if (roll_off_) results.table("roll_off", roll_offs(tables), ".rolloff");
    results.figure("", densities(tables, fits));
    if (std::any_of(scalings.begin(), scalings.end(), [](const auto &s) { return s.drawable(); }))
      results.figure("", scaling_figure(scalings), ".scaling");
    else if (scaling_)
      results.warn("no catalogue gives a characteristic size, no picture of the scaling");
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_fit() { return std::make_shared<Fit>(); }

}  // namespace LSM::postproc
