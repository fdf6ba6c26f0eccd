// SPDX-License-Identifier: GPL-2.0-or-later

#include "command.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

class Histograms : public Statistic {
  DensitySettings settings_;
  std::string range_;
  std::vector<std::string> guides_;

  const char *help() const override {
    return "Densities of event sizes over logarithmic bins, count / (N width), with Poisson error "
           "bars, one curve per catalogue (paper: Figs. 7, 12, 13)";
  }

  void add_options(CLI::App *command) override {
    add_usual(command, "histograms");
    add_magnitude_bin(command, catalogues);
    OptionGroup group(command, "Densities");
    add_threshold(group, settings_.threshold, "the densities");
    group.add("--range", range_, "LO:HI, only bins within this range of sizes");
    group.add("--bin-factor", settings_.factor,
              "Ratio of the edges of a bin, c of the paper's c^n († ten bins a "
              "decade); for earthquakes the nearest whole number of bins of magnitudes");
    group.add("--guide", guides_,
              "SLOPE or SLOPE:LO:HI, a straight line above the points, e.g. -1.07 (paper, fault) "
              "or -0.5:1e-3:1 (paper, small events of the block-slider)",
              kind("LINE"), shown(""), one_each());
  }

  Results of(const std::vector<EventTable> &tables) override {
    if (!range_.empty()) {
      const Range range = parse_range("--range", range_);
      if (range.lo > -std::numeric_limits<double>::infinity())
        settings_.threshold = std::max(range.lo, settings_.threshold.given.value_or(range.lo));
      settings_.upto = range.hi;
    }
    std::vector<PowerLine> lines;
    for (const std::string &guide : guides_) {
      lines.push_back(parse_guide(guide));
      lines.back().dash = 1 + static_cast<int>(lines.size());
    }
    const std::vector<SizeDensity> densities = size_densities(tables, settings_);
    Figure figure = size_density_figure(densities, lines);
    figure.table.comment(texts(settings_.threshold, tables));
    Results results;
    results.say(texts(settings_.threshold, tables));
    results.say(bin_notes(tables));
    for (const SizeDensity &density : densities)
      if (density.bins.empty())
        results.warn(density.label + ": no bin within the range of sizes has an event, no curve");
    results.figure("densities", std::move(figure));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_histograms() { return std::make_shared<Histograms>(); }

}  // namespace LSM::postproc
