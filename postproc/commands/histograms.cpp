// SPDX-License-Identifier: GPL-2.0-or-later

#include "command.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

class Histograms : public Statistic {
  Threshold threshold_;
  std::vector<std::string> guides_;

  const char *help() const override {
    return "Densities of event sizes over logarithmic bins, count / (N width), with Poisson error "
           "bars, one curve per catalogue (paper: Figs. 7, 12, 13)";
  }

  void add_options(CLI::App *command) override {
    add_usual(command, "histograms");
    add_magnitude_bin(command, catalogues);
    OptionGroup group(command, "Densities");
    add_threshold(group, threshold_);
    group.add("--guide", guides_,
              "SLOPE or SLOPE:LO:HI, a straight line above the points, e.g. -1.07 (paper, fault) "
              "or -0.5:1e-3:1 (paper, small events of the block-slider)",
              kind("LINE"), shown(""), one_each());
  }

  Results of(const std::vector<EventTable> &tables) override {
    std::vector<PowerLine> lines;
    for (const std::string &guide : guides_) {
      lines.push_back(parse_guide(guide));
      lines.back().dash = 1 + static_cast<int>(lines.size());
    }
    const std::vector<SizeDensity> densities = size_densities(tables, threshold_);
    Figure figure = size_density_figure(densities, lines);
    figure.table.comment(texts(threshold_, tables));
    Results results;
    results.say(texts(threshold_, tables));
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
