// SPDX-License-Identifier: GPL-2.0-or-later
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.h"
#include "input_file.h"
#include "json_output.h"
#include "picture_options.h"
#include "plot.h"
#include "series_input.h"
#include "option_values.h"
#include "spectrum.h"
#include "spectrum_figure.h"

namespace LSM::postproc {

namespace {

struct Options {
  std::vector<std::string> series, labels;
  SeriesOptions samples;
  JsonOutput json;
  SpectrumSettings spectrum;
  PictureOptions picture;
  std::string of = "pe";
  std::int64_t segment = 0;
  int per_decade = 50;
};

/// An eighth of the samples in the window, as a power of two, so that some 15 segments average.
std::size_t default_segment(const std::string &path, const SeriesOptions &options) {
  const std::int64_t samples = read_series(path, options, [](std::int64_t, double, double) {});
  std::size_t segment = 8;
  while (segment < (1 << 16) && 16 * static_cast<std::int64_t>(segment) <= samples) segment *= 2;
  return segment;
}

SpectrumCurve measure(const std::string &path, const Options &options) {
  const PeSeriesInfo info = PeSeriesReader(path, options.samples.lenient, open_input).info();
  SpectrumSettings settings = options.spectrum;
  settings.segment = options.segment > 0 ? static_cast<std::size_t>(options.segment)
                                         : default_segment(path, options.samples);
  WelchSpectrum spectrum(settings, info.dt * static_cast<double>(info.stride));
  std::int64_t last_step = 0;
  double before = 0.0;
  bool has_before = false;
  read_series(path, options.samples, [&](std::int64_t step, double time, double pe) {
    if (time < options.samples.from_time) return;
    if (has_before && step - last_step != info.stride)
      throw FileError(fmt::format("{}: step {} after step {}, expected a sample every {} steps",
                                  path, step, last_step, info.stride));
    if (options.of == "pe") {
      spectrum.add(pe);
    } else if (has_before) {
      spectrum.add(pe - before);
    }
    last_step = step;
    before = pe;
    has_before = true;
  });
  if (spectrum.segments() == 0)
    throw std::runtime_error(
        fmt::format("{}: {} samples in the window of time, expected at least "
                    "one segment of {} (--segment)",
                    path, spectrum.samples(), settings.segment));
  return {{},
          averaged(spectrum.points(), options.per_decade),
          spectrum.samples(),
          spectrum.segments(),
          spectrum.effective_segments()};
}

void run(Options &options) {
  options.json.check(options.series);
  options.picture.check(options.series, {}, {options.json.output()});
  if (!options.labels.empty() && options.labels.size() != options.series.size())
    throw std::invalid_argument(fmt::format("--label given {} times, expected once per series ({})",
                                            options.labels.size(), options.series.size()));
  std::vector<SpectrumCurve> curves;
  Table averages({"label", "samples", "segments", "averages", "variance"});
  for (std::size_t i = 0; i < options.series.size(); ++i) {
    curves.push_back(measure(options.series[i], options));
    SpectrumCurve &curve = curves.back();
    curve.label = options.labels.empty()
                      ? std::filesystem::path(options.series[i]).filename().string()
                      : options.labels[i];
    fmt::print(
        "{}: {} samples, {} segments (as good as {:.1f} independent ones), variance {:.6g}\n",
        curve.label, curve.samples, curve.segments, curve.averages, variance(curve));
    averages.add(curve.label).add(curve.samples).add(curve.segments).add(curve.averages);
    averages.add(variance(curve)).end_row();
  }
  const Figure figure = spectrum_figure(curves, options.of == "pe");
  make(figure, options.picture);
  options.json.add("series", averages);
  options.json.add("spectra", figure.table);
  options.json.write();
}

}  // namespace

void add_spectrum(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "spectrum",
      "Power spectral density of PE series by Welch's method: one-sided, the integral over "
      "frequency is the variance (ours; the paper shows no spectra). A last segment that is not "
      "full is left out");
  auto options = std::make_shared<Options>();
  command
      ->add_option("series", options->series,
                   "PE series, text or binary, one curve each; a sample is needed at every stride")
      ->required();
  command->add_option("--label", options->labels,
                      "Name of a curve, once per series and in their order (default: file name)");
  options->samples.add_to(command, true);
  options->json.add_to(command);
  command
      ->add_option("--of", options->of, "pe: the potential energy; change: its change per sample")
      ->check(CLI::IsMember({"pe", "change"}));
  const std::string group = "Spectrum (ours)";
  command
      ->add_option("--segment", options->segment,
                   "Samples in a segment; the lowest frequency is 1 / (segment x interval)")
      ->check(CLI::Range(std::int64_t{8}, std::int64_t{1} << 28))
      ->default_str("power of two, at most 1/8 of the series and 65536")
      ->group(group);
  command
      ->add_option("--overlap", options->spectrum.overlap,
                   "Part of a segment that the next one shares, 0 to less than 1")
      ->group(group);
  command->add_option("--window", options->spectrum.window, "hann, hamming, blackman, rectangular")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Window>{{"hann", Window::hann},
                                        {"hamming", Window::hamming},
                                        {"blackman", Window::blackman},
                                        {"rectangular", Window::rectangular}}))
      ->default_str("hann")
      ->group(group);
  command
      ->add_option(
          "--per-decade", options->per_decade,
          "Neighbouring frequencies are averaged to at most so many points in a decade; 0: "
          "all frequencies. Errors take neighbours as independent")
      ->check(zero_or_more())
      ->group(group);
  add_picture_options(command, options->picture, "spectrum");
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
