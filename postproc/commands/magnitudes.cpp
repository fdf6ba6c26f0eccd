// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "magnitude_figure.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

class Magnitudes : public Statistic {
  MagnitudeOptions magnitudes_;
  Threshold threshold_;
  std::string complete_;

  const char *help() const override {
    return "Frequencies of magnitudes, b-value with its error, b-positive and completeness by "
           "maximum curvature †; the paper has sizes only. Magnitudes are those of the file for "
           "earthquakes, and for models a convention, M = (2/3) log10(size) + constant, unless the "
           "model has SI units (--unit-length, --p-speed, --density)";
  }

  void add_options(CLI::App *command) override {
    add_usual(command, "magnitudes");
    catalogues.bins_for_models = true;
    add_magnitude_bin(command, catalogues,
                      "none for models; for earthquakes the step of the magnitudes in the file");
    OptionGroup group(command, "Magnitudes †");
    magnitudes_.add_to(group);
    group.add("--complete-from", complete_,
              "Magnitude above which the catalogue is complete: header, that of --threshold (of "
              "sizes only); curvature, centre of the fullest bin + 0.2; or a magnitude",
              shown("header, of moments curvature"));
    add_threshold(group, threshold_);
  }

  std::vector<std::string> endings() const override { return {".bvalues.csv"}; }

  /// Magnitudes of one catalogue, in the order of its events.
  std::vector<double> magnitudes_in(const EventTable &table, const MagnitudeScale &scale) const {
    std::vector<double> out;
    const MagnitudeBins &bins = table.bins;
    const auto add = [&](double quantity) {
      if (quantity > 0.0) out.push_back(bins.binned(scale.of(quantity)));
    };
    if (table.earthquakes())
      for (const double magnitude : table.magnitudes) out.push_back(bins.binned(magnitude));
    else if (magnitudes_.of_moment())
      for (const EventRow &event : table.details) add(magnitudes_.quantity(event, table.info));
    else
      for (const EventSummary &event : table.events) add(event.size);
    return out;
  }

  /// Sets the magnitude of completeness of a curve and its description.
  void set_completeness(MagnitudeCurve &curve, const EventTable &table,
                        const MagnitudeScale &scale) const {
    const std::string from = !complete_.empty()        ? complete_
                             : magnitudes_.of_moment() ? "curvature"
                                                       : "header";
    if (text::parse(from, curve.completeness)) {
      curve.completeness_text = "as given";
    } else if (from == "curvature") {
      curve.completeness = curve.curvature;
      curve.completeness_text = "by maximum curvature";
    } else if (from == "header" && magnitudes_.of_moment()) {
      throw std::invalid_argument(
          "--complete-from header holds for sizes only, expected 'curvature' or a magnitude for "
          "magnitudes of moments");
    } else if (from == "header") {
      const SmallestSize smallest = threshold_.of(table);
      if (!(smallest.size > 0.0) && threshold_.given)
        throw std::invalid_argument("--threshold 0 has no magnitude, expected a larger size");
      // The sizes of earthquakes come from decimal magnitudes.
      curve.completeness = table.earthquakes() ? nearest_decimal(magnitude_of_size(smallest.size))
                                               : scale.of(smallest.size);
      curve.completeness_text = "sizes >= " + text(smallest);
      // The catalogue has nothing of the part of a bin that is below it; of earthquakes the reader
      // has seen to this.
      if (!table.earthquakes() && smallest.size == table.complete_from)
        curve.completeness += 0.5 * curve.bins.width;
    } else {
      throw std::invalid_argument("--complete-from " + text::in_quotes(from) +
                                  ", expected 'header', 'curvature' or a magnitude");
    }
    // Rounds the completeness up to the centre of a bin, which b_value() requires.
    curve.completeness = curve.bins.first_from(curve.completeness);
  }

  /// Where the magnitudes come from, for readers.
  std::string formula(const std::vector<EventTable> &tables) const {
    const auto quakes = std::count_if(tables.begin(), tables.end(),
                                      [](auto &table) { return table.earthquakes(); });
    if (quakes == 0) return magnitudes_.text();
    const std::string of_file = "M of earthquakes as in the file";
    return quakes == std::ptrdiff_t(tables.size()) ? of_file : of_file + "; " + magnitudes_.text();
  }

  Results find() override {
    magnitudes_.check();
    if (magnitudes_.of_moment()) catalogues.details = CatalogueOptions::all_events;
    return Statistic::find();
  }

  Results of(const std::vector<EventTable> &tables) override {
    expect_events(tables);
    std::vector<MagnitudeCurve> curves;
    for (const EventTable &table : tables) {
      MagnitudeCurve curve;
      curve.label = table.label;
      curve.model = table.info.model;
      const MagnitudeScale scale = table.earthquakes() && !magnitudes_.of_moment()
                                       ? MagnitudeScale()
                                       : magnitudes_.scale(table.path, table.info);
      curve.magnitudes = magnitudes_in(table, scale);
      curve.bins = curve.counting = table.bins;
      // Fine bins that were only recognized have too few events each to show where they are most.
      double &width = curve.counting.width;
      if (!(width > 0.0))
        width = 0.1;
      else if (!catalogues.magnitude_bins)
        width = MagnitudeBins{width}.first_from(0.1);
      curve.curvature = maximum_curvature(curve.magnitudes, curve.counting);
      set_completeness(curve, table, scale);
      curve.b = b_value(curve.magnitudes, curve.completeness, curve.bins.width);
      curve.positive = b_positive(curve.magnitudes, curve.completeness, curve.bins.width);
      curves.push_back(std::move(curve));
    }
    Results results;
    results.say(bin_notes(tables));
    for (std::size_t i = 0; i < tables.size(); ++i)
      if (const auto left_out = tables[i].events.size() - curves[i].magnitudes.size())
        results.warn(fmt::format("{}: left out {} of {} events, whose {} is 0 or less",
                                 tables[i].path, left_out, tables[i].events.size(),
                                 magnitudes_.of()));
    if (magnitudes_.for_models() &&
        std::all_of(tables.begin(), tables.end(), [](auto &table) { return table.earthquakes(); }))
      results.warn(
          "earthquakes keep their magnitudes: --magnitude-constant and SI units are for models");
    results.table("b_values", magnitude_table(curves, formula(tables)), ".bvalues");
    results.figure("frequencies", magnitude_figure(curves));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_magnitudes() { return std::make_shared<Magnitudes>(); }

}  // namespace LSM::postproc
