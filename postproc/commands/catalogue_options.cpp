// SPDX-License-Identifier: GPL-2.0-or-later
#include "catalogue_options.h"

#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "event_time.h"
#include "files/text.h"

namespace LSM::postproc {

namespace {

/// Adds --from or --to. A number is a model time, and a date applies to earthquakes.
void add_time(OptionGroup group, const char *option, double &time, double &day,
              const std::string &help) {
  const auto read = [option, &time, &day](const std::vector<std::string> &texts) {
    std::int64_t times = 0, days = 0;
    for (const std::string &text : texts) {
      const std::optional<double> date = parse_date(text);
      if (date)
        day = *date;
      else if (!text::parse(text, time))
        throw std::invalid_argument(fmt::format(
            "{} {}: expected a model time, or for earthquakes a date such as 1984-01-01", option,
            text::in_quotes(text)));
      if (++(date ? days : times) > 1)
        throw std::invalid_argument(
            fmt::format("{} {}: a second {}, expected one for all catalogues", option,
                        text::in_quotes(text), date ? "date" : "model time"));
    }
  };
  group.call<std::vector<std::string>>(option, read, help, one_each(), kind("TIME"),
                                       shown(time < 0.0 ? "start" : "end"));
}

const std::string threshold_help =
    "Smallest size of events (model energy; M2.5: magnitude 2.5); without it 1e-4, as in the "
    "paper's Figs. 12 and 13, or the largest 'completeness' in the headers of a model if that is "
    "larger †";

}  // namespace

void add_catalogues(CLI::App *command, CatalogueOptions &of) {
  OptionGroup group(command, "Catalogues");
  group.add("catalogues", of.paths,
            "Catalogue files, one curve each: of a model, or of earthquakes, with times in days "
            "since 1970 UTC and sizes 10^(1.5 M)",
            required(), kind("FILE"), shown(""));
  group.add("--label", of.labels,
            "Name of a curve, once per catalogue and in their order (default: the model and its "
            "length)",
            kind("TEXT"), shown(""));
  group.flag("--lenient", of.lenient,
             "Skip and count lines that cannot be read (truncated last line, missing columns, NaN, "
             "events out of order); without it the first of them is an error");
  CLI::Option *const smallest = group.add(
      "--min-size", of.min_size, "Leave out events smaller than this (energy; M2.5: magnitude 2.5)",
      size_or_magnitude(), finite());
  group.call<double>(
      "--min-magnitude", [&of](double magnitude) { of.min_size = size_of_magnitude(magnitude); },
      "The same, as a magnitude", shown(""), excludes(smallest));
  add_time(group, "--from", of.from_time, of.from_day,
           "Leave out events that start before this time (model time; for earthquakes an ISO 8601 "
           "date, such as 1984-01-01 or 1984-01-01T12:00Z)");
  add_time(group, "--to", of.to_time, of.to_day,
           "Leave out events that start at this time or later (as --from)");
  group.add(
      "--where", of.where,
      "Of a model only events for which this holds: a column, one of < <= > >= = != and a number "
      "(units of the file), such as 'peak_slip > 0.001'; may be repeated, and all have to hold. "
      "'excess > 0.5': drops of PE that are slip †: excess is what friction takes up within the "
      "event, less that in as much time between events from --from to --to, over its size",
      one_each(), kind("CONDITION"), shown(""));
  group.add(
      "--format", of.format,
      "Format of the files; detect: by the first bytes. Events whose type says that they are no "
      "earthquakes (blasts, ...) are left out and counted on standard error; if they are most, "
      "that is an error unless --lenient",
      among({"detect", "models", "csv", "quakeml", "geojson", "zmap", "scedc"}));
  group.add("--region", of.regions,
            "Only earthquakes within W/E/S/N (degrees); may be repeated, for one curve each",
            one_each(), kind("W/E/S/N"), shown(""));
}

void add_displacement(CLI::App *command, CatalogueOptions &of) {
  OptionGroup(command, "Catalogues")
      .flag("--displacement", of.displacement,
            "Times as displacements of the driving plate, model time times the 'velocity' in the "
            "header, also those of --from and --to †");
}

void add_magnitude_bin(CLI::App *command, CatalogueOptions &of) {
  const auto read = [&of](const std::string &given) {
    MagnitudeBins bins;
    const std::size_t colon = given.find(':');
    bool good = text::parse(given.substr(0, colon), bins.width) && bins.width >= 0.0 &&
                std::isfinite(bins.width);
    if (good && colon != std::string::npos) {
      double centre = 0.0;
      good =
          text::parse(given.substr(colon + 1), centre) && std::isfinite(centre) && bins.width > 0.0;
      bins.offset = nearest_decimal(
          centre - bins.width * std::floor(centre / bins.width + magnitude_tolerance));
    }
    if (!good)
      throw std::invalid_argument(
          "--magnitude-bin " + text::in_quotes(given) +
          ", expected a width of 0 or more, or one above 0 and a centre, such as 0.1:0.05");
    of.magnitude_bins = bins;
  };
  OptionGroup(command, "Catalogues")
      .call<std::string>(
          "--magnitude-bin", read,
          "Width of the bins to whose centres magnitudes are rounded, halves upwards; centres are "
          "multiples of the width unless another one is given, as in 0.1:0.05; 0: none. Without "
          "it the step of the magnitudes in the file",
          kind("WIDTH[:CENTRE]"), shown(""));
}

void add_threshold(OptionGroup group, Threshold &threshold) {
  group.call<double>(
      "--threshold", [&threshold](double size) { threshold = Threshold(size); }, threshold_help,
      size_or_magnitude(), zero_or_more(), shown("1e-4"));
}

void add_thresholds(OptionGroup group, std::vector<double> &thresholds) {
  group.add("--threshold", thresholds, threshold_help, one_each(), size_or_magnitude(),
            zero_or_more(), shown("1e-4"));
}

}  // namespace LSM::postproc
