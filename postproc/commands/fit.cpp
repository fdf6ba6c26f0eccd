// SPDX-License-Identifier: GPL-2.0-or-later
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "numbers.h"
#include "size_figures.h"

namespace LSM::postproc {

namespace {

class Fit : public Statistic {
  SizeFitSettings settings_;
  std::vector<std::string> ranges_;
  bool no_comparison_ = false, roll_off_ = false;

  const char *help() const override {
    return "Exponents of the event sizes by maximum likelihood, and goodness of fit of a power law "
           "(the paper fitted binned densities: 1.07 for the fault, 0.5 and 1.0 for the "
           "block-slider)";
  }

  void add_options(CLI::App *command) override {
    add_usual(command, "fit");
    add_magnitude_bin(command, catalogues);
    OptionGroup group(command, "Fit");
    group.add("--range", ranges_,
              "Sizes that are fitted; without it three decades, as in the paper, from --threshold "
              "on. LO is raised to the smallest size in the catalogue (--min-size, or min_size in "
              "its header)",
              kind("LO:HI"), shown(""), one_each());
    add_threshold(group, settings_.threshold);
    group.add("--replicas", settings_.replicas,
              "Synthetic samples of the Monte Carlo p-value; 0: none", zero_or_more());
    add_seed(group, settings_.seed);
    group.flag("--no-comparison", no_comparison_, "Leave out the rival laws");
    group.flag(
        "--roll-off", roll_off_,
        "Also the power d of the roll-off s^-a exp(-(s/c)^d) of the sizes from --threshold on, "
        "and 2 ln L of d = 1 over a power law without end †");
  }

  std::vector<std::string> endings() const override { return {".fits.csv", ".rolloff.csv"}; }

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
    double least = settings_.threshold.given.value_or(paper_threshold);
    for (const Range &range : settings_.ranges) least = std::min(least, range.lo);
    const Threshold from = settings_.ranges.empty() ? settings_.threshold : Threshold(least);
    const std::vector<SizeDensity> densities = size_densities(tables, from);
    std::vector<PowerLine> lines;
    for (const SizeFit &fit : fits)
      if (!fit.fit.degenerate) lines.push_back(fitted_line(fit, densities[fit.catalogue]));
    Figure figure = size_density_figure(densities, lines);
    figure.table.comment(texts(from, tables));
    return figure;
  }

  Results of(const std::vector<EventTable> &tables) override {
    for (const std::string &text : ranges_) {
      settings_.ranges.push_back(parse_range("--range", text));
      if (!(settings_.ranges.back().lo > 0.0))
        throw std::invalid_argument("--range '" + text + "', expected LO above 0");
    }
    expect_events(tables);
    if (roll_off_ || (settings_.ranges.empty() && settings_.threshold.given))
      for (const EventTable &table : tables)
        if (!(settings_.threshold.of(table).size > 0.0))
          throw std::invalid_argument("sizes from 0 on, expected --threshold above 0");
    settings_.compare = !no_comparison_;
    const std::vector<SizeFit> fits = fit_sizes(tables, settings_);
    Results results;
    if (settings_.ranges.empty()) results.say(texts(settings_.threshold, tables));
    results.say(completeness_notes(fits));
    results.say(bin_notes(tables));
    results.table("fits", size_fit_table(fits), ".fits");
    if (roll_off_) results.table("roll_off", roll_offs(tables), ".rolloff");
    results.figure("", densities(tables, fits));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_fit() { return std::make_shared<Fit>(); }

}  // namespace LSM::postproc
