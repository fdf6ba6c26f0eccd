// SPDX-License-Identifier: GPL-2.0-or-later
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "series_input.h"
#include "spectrum.h"
#include "spectrum_figure.h"

namespace LSM::postproc {

namespace {

/// An eighth of the samples in the window, as a power of two, so that some 15 segments average.
std::size_t default_segment(const std::string &path, const SeriesOptions &options) {
  const std::int64_t samples = SeriesInput(path, options).read();
  std::size_t segment = 8;
  while (segment < (1 << 16) && 16 * static_cast<std::int64_t>(segment) <= samples) segment *= 2;
  return segment;
}

class Spectrum : public Analysis {
  std::vector<std::string> series_, labels_;
  SeriesOptions samples_;
  SpectrumSettings spectrum_;
  std::string of_ = "pe";
  std::int64_t segment_ = 0;
  int per_decade_ = 50;

  const char *help() const override {
    return "Power spectral density of PE series by Welch's method: one-sided, the integral over "
           "frequency is the variance (ours; the paper shows no spectra). An incomplete last "
           "segment is left out";
  }

  void add_options(CLI::App *command) override {
    OptionGroup own(command), group(command, "Spectrum (ours)");
    own.add("series", series_, "PE series, text or binary, one curve each, without missing samples",
            required());
    own.add("--label", labels_,
            "Name of a curve, once per series and in their order (default: file name)");
    samples_.add_to(own, true);
    json.add_to(command);
    own.add("--of", of_, "pe: the potential energy; change: its change per sample",
            among({"pe", "change"}));
    group.add("--segment", segment_,
              "Samples in a segment; the lowest frequency is 1 / (segment x interval)",
              between(std::int64_t{8}, std::int64_t{1} << 28),
              shown("power of two, at most 1/8 of the series and 65536"));
    group.add("--overlap", spectrum_.overlap,
              "Fraction of a segment shared with the next one, 0 to less than 1");
    group.choice<Window>("--window", spectrum_.window,
                         {{"hann", Window::hann},
                          {"hamming", Window::hamming},
                          {"blackman", Window::blackman},
                          {"rectangular", Window::rectangular}},
                         "hann, hamming, blackman, rectangular", "hann");
    group.add("--per-decade", per_decade_,
              "Neighbouring frequencies are averaged to at most so many points per decade; 0: "
              "all frequencies. Errors assume independent neighbours",
              zero_or_more());
    add_picture(command, "spectrum");
  }

  std::vector<std::string> inputs() const override { return series_; }

  SpectrumCurve measure(const std::string &path) const {
    SpectrumSettings settings = spectrum_;
    settings.segment =
        segment_ > 0 ? static_cast<std::size_t>(segment_) : default_segment(path, samples_);
    SeriesInput series(path, samples_);
    const std::int64_t stride = series.info().stride;
    WelchSpectrum spectrum(settings, series.spacing());
    std::int64_t last_step = 0;
    double before = 0.0;
    bool has_before = false;
    series.read([&](std::int64_t step, double time, double pe) {
      if (time < samples_.from_time) return;
      if (has_before && step - last_step != stride)
        throw FileError(fmt::format("{}: step {} after step {}, expected a sample every {} steps",
                                    path, step, last_step, stride));
      if (of_ == "pe") {
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
          fmt::format("{}: {} samples in the window of time, expected at least one segment of {} "
                      "(--segment)",
                      path, spectrum.samples(), settings.segment));
    return {{},
            averaged(spectrum.points(), per_decade_),
            spectrum.samples(),
            spectrum.segments(),
            spectrum.effective_segments()};
  }

  Findings find() override {
    const std::vector<std::string> labels = labels_of(series_, labels_, "series");
    std::vector<SpectrumCurve> curves;
    Table averages("label,samples,segments,averages,variance");
    Findings found;
    for (std::size_t i = 0; i < series_.size(); ++i) {
      SpectrumCurve curve = measure(series_[i]);
      curve.label = labels[i];
      found.say(fmt::format(
          "{}: {} samples, {} segments (as good as {:.1f} independent ones), variance {:.6g}\n",
          curve.label, curve.samples, curve.segments, curve.averages, variance(curve)));
      averages.row(curve.label, curve.samples, curve.segments, curve.averages, variance(curve));
      curves.push_back(std::move(curve));
    }
    found.numbers("series", averages);
    found.figure("spectra", spectrum_figure(curves, of_ == "pe"));
    return found;
  }
};

}  // namespace

std::shared_ptr<Command> make_spectrum() { return std::make_shared<Spectrum>(); }

}  // namespace LSM::postproc
