// SPDX-License-Identifier: GPL-2.0-or-later
#include "periods.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "numbers.h"
#include "period_figure.h"

namespace LSM::postproc {

namespace {

class Periods : public Statistic {
  Threshold threshold_{1e-2};
  std::vector<double> periods_ = {1.0};
  std::string scan_ = "0.2:5", unit_ = "slip";
  double bin_ = 0.05;
  int replicas_ = 2000;
  std::uint64_t seed_ = 1;

  const char *help() const override {
    return "Does a fault repeat itself? Periods in the times of events, weighted with their sizes: "
           "Rayleigh's Z (1 on average by chance) at given periods of the slip of the plates and "
           "at all between two, and whether catalogues release energy at equal times †";
  }

  void add_options(CLI::App *command) override {
    add_usual(command, "periods");
    OptionGroup group(command, "Periods †");
    group.call<double>(
        "--threshold", [this](double size) { threshold_ = Threshold(size); },
        "Smallest size of the events (model energy; M2.5: magnitude 2.5)", size_or_magnitude(),
        zero_or_more(), shown("1e-2"));
    group.add("--unit", unit_,
              "Unit of periods and bins: slip, of one plate against the other (of a block-slider, "
              "of its plate), by the velocity in the header; or time",
              among({"slip", "time"}));
    group.add("--period", periods_, "Periods that are tested, several allowed", one_each(),
              positive());
    group.add("--scan", scan_, "LO:HI, periods of the picture", kind("LO:HI"));
    group.add("--bin", bin_, "Width of the bins of energy of several catalogues", positive());
    group.add("--replicas", replicas_, "Random phases, or shifts, for each p-value", positive());
    add_seed(group, seed_);
  }

  std::vector<std::string> endings() const override {
    return {".tests.csv", ".pairs.csv", ".tenths.csv"};
  }

  struct Sample {
    std::string label;
    std::vector<double> times, weights;  ///< times in the unit of --unit
  };

  Sample sample_of(const EventTable &table) const {
    double scale = 1.0;
    if (unit_ == "slip") {
      scale = table.plate_velocity();
      if (!(scale > 0.0))
        throw std::runtime_error(table.path +
                                 ": no velocity of the plates in the header, expected one for "
                                 "--unit slip");
    }
    Sample sample{table.label, {}, {}};
    for (const EventSummary &event : table.events) {
      if (!(event.size >= threshold_.complete_in(table).size)) continue;
      sample.times.push_back(event.t_start / table.model_time * scale);
      sample.weights.push_back(event.size);
    }
    if (sample.times.size() < 10)
      throw std::runtime_error(fmt::format("{}: {} events of this size, expected at least 10",
                                           table.path, sample.times.size()));
    return sample;
  }

  Results of(const std::vector<EventTable> &tables) override {
    const Range range = parse_range("--scan", scan_);
    if (!(range.lo > 0.0) || !std::isfinite(range.hi))
      throw std::invalid_argument("--scan '" + scan_ + "', expected LO:HI, both positive");
    std::vector<Sample> samples;
    for (const EventTable &table : tables) samples.push_back(sample_of(table));
    struct Line {
      const Sample &sample;
      double period, largest_z, at_period, by_chance;
      PeriodTest test;
    };
    TableOf<Line> tests;
    tests.column("label", "catalogue", [](auto &line) { return line.sample.label; });
    tests.column("period", "period", &Line::period);
    tests.column("n", "events", [](auto &line) { return line.sample.times.size(); });
    tests.column(
        "effective_n", "as many of equal weight",
        [](auto &line) { return effective_number(line.sample.weights); }, 3);
    tests.column(
        "z", "Z", [](auto &line) { return line.test.z; }, 3);
    tests.column(
        "p", "p", [](auto &line) { return line.test.p; }, 2);
    tests.show("", [](auto &line) { return line.test.p.value < 0.01 ? "a period" : "none seen"; });
    tests.data("phase", [](auto &line) { return line.test.phase; });
    tests.column("largest_z", "largest Z of the scan", &Line::largest_z, 3);
    tests.column("at_period", "at period", &Line::at_period);
    tests.column("by_chance", "by chance", &Line::by_chance, 3);
    tests.comment(
        "Z: energy-weighted Rayleigh statistic, 1 on average for random phases; periods "
        "in units of " +
        unit_);
    Table tenths("label,period,tenth,weight");
    tenths.comment("weight in each tenth of a period, over its mean");
    std::vector<PeriodScan> scans;
    std::vector<std::string> labels;
    for (const Sample &one : samples) {
      scans.push_back(scan_periods(one.times, one.weights, range.lo, range.hi));
      labels.push_back(one.label);
      const PeriodScan &scan = scans.back();
      const auto top = std::max_element(scan.z.begin(), scan.z.end());
      const bool any = top != scan.z.end();
      for (const double period : periods_) {
        const PeriodTest test = test_period(one.times, one.weights, period, replicas_, seed_);
        tests.row({one, period, any ? *top : NAN,
                   any ? scan.periods[static_cast<std::size_t>(top - scan.z.begin())] : NAN,
                   scan.by_chance, test});
        for (std::size_t k = 0; k < test.tenths.size(); ++k)
          tenths.row(one.label, period, k + 1, test.tenths[k]);
      }
    }
    Results results;
    results.table("periods", std::move(tests), ".tests");
    results.table("tenths", std::move(tenths), ".tenths");
    if (samples.size() > 1) add_pairs(results, samples);
    results.figure("scan", period_figure(scans, labels,
                                         unit_ == "slip" ? "slip of the plates" : "model time"));
    return results;
  }

  void add_pairs(Results &results, const std::vector<Sample> &samples) const {
    Table pairs(Columns{{"first", "energy at equal times"},
                        {"second", "and"},
                        {"bins", "bins"},
                        {"correlation", "correlation", 3},
                        {"p", "p", 2, true}});
    pairs.comment(
        "correlation of the energy in bins; p: share of shifts in time that give as much");
    std::vector<double> all;
    for (std::size_t j = 1; j < samples.size(); ++j)
      for (std::size_t i = 0; i < j; ++i) {
        const Sample &a = samples[i], &b = samples[j];
        const Coincidence one =
            coincidence(a.times, a.weights, b.times, b.weights, bin_, replicas_, seed_);
        all.push_back(one.correlation);
        pairs.row(a.label, b.label, one.bins, one.correlation, one.p);
      }
    results.table("pairs", std::move(pairs), ".pairs");
    if (all.size() > 1)
      results.say(fmt::format("mean correlation of {} pairs: {}\n", all.size(),
                              short_number(mean_of(all), 3)));
  }
};

}  // namespace

std::shared_ptr<Command> make_periods() { return std::make_shared<Periods>(); }

}  // namespace LSM::postproc
