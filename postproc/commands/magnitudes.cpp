// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "magnitude_figure.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

class Magnitudes : public Statistic {
  Threshold threshold_;
  std::string complete_ = "header";

  const char *help() const override {
    return "Frequencies of magnitudes, b-value with its error, b-positive and completeness by "
           "maximum curvature †; the paper has sizes only. Magnitudes are those of the file for "
           "earthquakes, and for models a convention, M = (2/3) log10(size)";
  }

  void add_options(CLI::App *command) override {
    add_usual(command, "magnitudes");
    add_magnitude_bin(command, catalogues);
    OptionGroup group(command, "Magnitudes †");
    group.add("--complete-from", complete_,
              "Magnitude above which the catalogue is complete: header, that of --threshold; "
              "curvature, centre of the fullest bin + 0.2; or a magnitude");
    add_threshold(group, threshold_);
  }

  std::vector<std::string> endings() const override { return {".bvalues.csv"}; }

  /// Magnitudes of one catalogue, in the order of its events.
  static std::vector<double> magnitudes_in(const EventTable &table) {
    std::vector<double> out;
    if (table.earthquakes())
      for (const double magnitude : table.magnitudes) out.push_back(table.bins.binned(magnitude));
    else
      for (const EventSummary &event : table.events)
        if (event.size > 0.0) out.push_back(magnitude_of_size(event.size));
    return out;
  }

  /// Sets the magnitude of completeness of a curve and its description.
  void set_completeness(MagnitudeCurve &curve, const EventTable &table) const {
    if (text::parse(complete_, curve.completeness)) {
      curve.completeness_text = "as given";
    } else if (complete_ == "curvature") {
      curve.completeness = curve.curvature;
      curve.completeness_text = "by maximum curvature";
    } else if (complete_ == "header") {
      const SmallestSize smallest = threshold_.of(table);
      if (!(smallest.size > 0.0) && threshold_.given)
        throw std::invalid_argument("--threshold 0 has no magnitude, expected a larger size");
      curve.completeness = magnitude_of_size(smallest.size);
      // The sizes of earthquakes come from decimal magnitudes.
      if (table.earthquakes()) curve.completeness = nearest_decimal(curve.completeness);
      curve.completeness_text = "sizes >= " + text(smallest);
    } else {
      throw std::invalid_argument("--complete-from " + text::in_quotes(complete_) +
                                  ", expected 'header', 'curvature' or a magnitude");
    }
    // Rounds the completeness up to the centre of a bin, which b_value() requires.
    curve.completeness = curve.bins.first_from(curve.completeness);
  }

  Results of(const std::vector<EventTable> &tables) override {
    expect_events(tables);
    std::vector<MagnitudeCurve> curves;
    Results results;
    results.say(bin_notes(tables));
    for (const EventTable &table : tables) {
      MagnitudeCurve curve;
      curve.label = table.label;
      curve.model = table.info.model;
      curve.magnitudes = magnitudes_in(table);
      curve.bins = curve.counting = table.bins;
      // Fine bins that were only recognized have too few events each to show where they are most.
      double &width = curve.counting.width;
      if (!(width > 0.0))
        width = 0.1;
      else if (!catalogues.magnitude_bins)
        width = MagnitudeBins{width}.first_from(0.1);
      curve.curvature = maximum_curvature(curve.magnitudes, curve.counting);
      set_completeness(curve, table);
      curve.b = b_value(curve.magnitudes, curve.completeness, curve.bins.width);
      curve.positive = b_positive(curve.magnitudes, curve.completeness, curve.bins.width);
      if (const auto left_out = table.events.size() - curve.magnitudes.size())
        results.warn(fmt::format("{}: left out {} of {} events, whose size is 0 or less",
                                 table.path, left_out, table.events.size()));
      curves.push_back(std::move(curve));
    }
    results.table("b_values", magnitude_table(curves), ".bvalues");
    results.figure("frequencies", magnitude_figure(curves));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_magnitudes() { return std::make_shared<Magnitudes>(); }

}  // namespace LSM::postproc
