// SPDX-License-Identifier: GPL-2.0-or-later
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "series_input.h"
#include "spectrum.h"
#include "series_figures.h"

namespace LSM::postproc {

namespace {

/// Welch's spectrum of a series in one pass. By default, the length of a segment is an eighth of
/// the series, rounded down to a power of two, so that some 15 segments are averaged, and at most
/// 65536. Samples wait until the series ends or is eight times that long.
class SpectrumOfSeries {
 public:
  SpectrumOfSeries(std::int64_t segment, double spacing)
      : segment_(static_cast<std::size_t>(segment)), spacing_(spacing) {}

  void add(double pe) {
    waiting_.push_back(pe);
    if (segment_ > 0 || waiting_.size() == 8 * most) hand_over();
  }
  /// Returns the spectrum, after the last sample.
  /// \throws std::runtime_error unless there is a whole segment
  const WelchSpectrum &result(const std::string &path) {
    hand_over();
    if (spectrum_->segments() == 0)
      throw std::runtime_error(
          fmt::format("{}: {} samples in the window of time, expected at least one segment of {} "
                      "(--segment)",
                      path, spectrum_->samples(), segment_));
    return *spectrum_;
  }

 private:
  static constexpr std::size_t most = 1 << 16;

  void hand_over() {
    if (segment_ == 0)
      for (segment_ = 8; segment_ < most && 16 * segment_ <= waiting_.size();) segment_ *= 2;
    if (!spectrum_) spectrum_.emplace(segment_, spacing_);
    for (const double value : waiting_) spectrum_->add(value);
    waiting_.clear();
  }

  std::size_t segment_;
  double spacing_;
  std::optional<WelchSpectrum> spectrum_;
  std::vector<double> waiting_;
};

class Spectrum : public Analysis {
  std::vector<std::string> series_, labels_;
  SeriesOptions samples_;
  std::int64_t segment_ = 0;
  int per_decade_ = 50;

  const char *help() const override {
    return "Power spectral density of PE series by Welch's method: one-sided, the integral over "
           "frequency is the variance † (the paper shows no spectra). An incomplete last "
           "segment is left out";
  }

  void add_options(CLI::App *command) override {
    OptionGroup own(command), group(command, "Spectrum †");
    own.add("series", series_, "PE series, one curve each, without missing samples", required());
    own.add("--label", labels_,
            "Name of a curve, once per series and in their order (default: file name)");
    samples_.add_to(own, true);
    json.add_to(command);
    group.add("--segment", segment_,
              "Samples in a segment; the lowest frequency is 1 / (segment x interval)",
              between(std::int64_t{8}, std::int64_t{1} << 28),
              shown("power of two, at most 1/8 of the series and 65536"));
    group.add("--per-decade", per_decade_,
              "Neighbouring frequencies are averaged to at most this many points per decade; 0: "
              "all frequencies. Errors assume independent neighbours",
              zero_or_more());
    add_picture(command, "spectrum");
  }

  std::vector<std::string> inputs() const override { return series_; }

  SpectrumCurve measure(const std::string &path, const std::string &label) const {
    SeriesInput series(path, samples_);
    const std::int64_t stride = series.info().stride;
    SpectrumOfSeries spectrum(segment_, series.spacing());
    std::int64_t last_step = -1;
    series.read([&](std::int64_t step, double time, double pe) {
      if (is_before(time, samples_.from_time)) return;
      if (last_step >= 0 && step - last_step != stride)
        throw FileError(fmt::format("{}: step {} after step {}, expected a sample every {} steps",
                                    path, step, last_step, stride));
      spectrum.add(pe);
      last_step = step;
    });
    const WelchSpectrum &results = spectrum.result(path);
    return {label, averaged(results.points(), per_decade_), results.samples(), results.segments(),
            results.effective_segments()};
  }

  Results find() override {
    const std::vector<std::string> labels = labels_of(series_, labels_, "series");
    std::vector<SpectrumCurve> curves;
    Table averages(Columns{{"label", "series"},
                           {"samples", "samples"},
                           {"segments", "segments"},
                           {"averages", "independent segments"},
                           {"variance", "variance", 6}});
    for (std::size_t i = 0; i < series_.size(); ++i) {
      curves.push_back(measure(series_[i], labels[i]));
      const SpectrumCurve &curve = curves.back();
      averages.row(curve.label, curve.samples, curve.segments, curve.averages,
                   variance(curve.points));
    }
    Results results;
    results.table("series", std::move(averages));
    results.figure("spectra", spectrum_figure(curves));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_spectrum() { return std::make_shared<Spectrum>(); }

}  // namespace LSM::postproc
