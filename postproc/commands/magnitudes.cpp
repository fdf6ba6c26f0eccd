// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <stdexcept>

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
    return "Frequencies of magnitudes, b-value with its error (Aki 1965; in bins Tinti and "
           "Mulargia 1987; error Shi and Bolt 1982), b-positive (van der Elst 2021) and "
           "completeness by maximum curvature. † The paper has sizes only. Magnitudes are "
           "a convention, M = slope log10(size) + constant, unless the model has SI units "
           "(--unit-length, --p-speed, --density); a power law of sizes with exponent a gives b = "
           "(a - 1) / slope";
  }

  void add_options(CLI::App *command) override {
    add_usual(command, "magnitudes");
    OptionGroup group(command, "Magnitudes †");
    magnitudes_.add_to(group);
    group.add(
        "--complete-from", complete_,
        "Magnitude above which the catalogue is complete: header, that of --threshold (of "
        "sizes only); curvature, centre of the fullest bin + 0.2 (Wiemer and Wyss 2000; Woessner and "
        "Wiemer 2005); or a magnitude",
        shown("header, of moments curvature"));
    add_threshold(group, threshold_, "--complete-from header");
  }

  std::vector<std::string> endings() const override { return {".bvalues.csv"}; }

  /// Magnitudes of one catalogue, in the order of its events.
  std::vector<double> magnitudes_in(const EventTable &table, const MagnitudeScale &scale) const {
    std::vector<double> out;
    for (const double quantity : magnitudes_.of_moment()
                                     ? column(table.details, &Event::slip_moment)
                                     : column(table.events, &Event::size))
      if (quantity > 0.0) out.push_back(binned(scale.of(quantity), magnitudes_.bin));
    return out;
  }

  /// Sets the magnitude of completeness of a curve and its description.
  void set_completeness(MagnitudeCurve &curve, const EventTable &table,
                        const MagnitudeScale &scale) const {
    const std::string from = !complete_.empty()        ? complete_
                             : magnitudes_.of_moment() ? "curvature"
                                                       : "header";
    if (text_io::parse(from, curve.completeness)) {
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
      if (!(smallest.size > 0.0))
        throw std::invalid_argument("--threshold 0 has no magnitude, expected a larger size");
      curve.completeness = scale.of(smallest.size);
      curve.completeness_text = "sizes >= " + text(smallest);
    } else {
      throw std::invalid_argument("--complete-from " + text_io::in_quotes(from) +
                                  ", expected 'header', 'curvature' or a magnitude");
    }
    // Rounds the completeness up to the centre of a bin, which b_value() requires.
    const double bin = magnitudes_.bin;
    if (bin > 0.0) curve.completeness = bin * std::ceil(curve.completeness / bin - 1e-9);
  }

  Results find() override {
    magnitudes_.check();
    if (magnitudes_.of_moment()) catalogues.details = CatalogueOptions::all_events;
    return Statistic::find();
  }

  Results of(const std::vector<EventTable> &tables) override {
    const double bin = magnitudes_.bin, width = bin > 0.0 ? bin : 0.1;
    std::vector<MagnitudeCurve> curves;
    for (const EventTable &table : tables) {
      MagnitudeCurve curve;
      curve.label = table.label;
      curve.model = table.info.model;
      const MagnitudeScale scale = magnitudes_.scale(table.path, table.info);
      curve.magnitudes = magnitudes_in(table, scale);
      curve.curvature = maximum_curvature(curve.magnitudes, width);
      set_completeness(curve, table, scale);
      curve.b = b_value(curve.magnitudes, curve.completeness, bin);
      curve.positive = b_positive(curve.magnitudes, curve.completeness, bin);
      curves.push_back(std::move(curve));
    }
    Results results;
    results.table("b_values",
                  magnitude_table(curves, magnitudes_.slope_used(), magnitudes_.text(), bin),
                  ".bvalues");
    results.figure("frequencies", magnitude_figure(curves, width));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_magnitudes() { return std::make_shared<Magnitudes>(); }

}  // namespace LSM::postproc
