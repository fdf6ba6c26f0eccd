// SPDX-License-Identifier: GPL-2.0-or-later
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "intervals.h"
#include "numerics/sum.h"
#include "numbers.h"
#include "two_sample.h"

namespace LSM::postproc {

namespace {

class Compare : public Statistic {
  Threshold threshold_;
  int replicas_ = 2000;
  std::uint64_t seed_ = 1;

  const char *help() const override {
    return "Do catalogues agree? Sizes, and times from start to start, of each catalogue against "
           "the first: Kolmogorov-Smirnov distance with its p-value by random permutation of "
           "blocks of consecutive events † (events cluster), ratio of the means with its "
           "error";
  }

  void add_options(CLI::App *command) override {
    add_catalogues(command, catalogues);
    json.add_to(command);
    add_displacement(command, catalogues);
    OptionGroup group(command);
    add_table(group, "compare");
    add_threshold(group, threshold_);
    group.add("--replicas", replicas_, "Random permutations for each p-value", positive());
    add_seed(group, seed_);
  }

  TwoSampleTest test(const EventTable &first, const EventTable &second, const std::string &quantity,
                     double threshold) const {
    const auto values = [&](const EventTable &table) {
      if (quantity == "size") return column_from(table, threshold, &Event::size);
      return inter_event_times(table, threshold);
    };
    try {
      return two_sample_test(values(first), values(second), replicas_, seed_);
    } catch (const std::invalid_argument &e) {
      throw std::runtime_error(
          fmt::format("{} and {}: {}s: {}", first.path, second.path, quantity, e.what()));
    }
  }

  Results of(const std::vector<EventTable> &tables) override {
    if (tables.size() < 2)
      throw std::invalid_argument("one catalogue, expected at least two to compare");
    struct Line {
      const EventTable &first, &second;
      double threshold;
      std::string quantity;
      TwoSampleTest test;
    };
    const EventTable &first = tables.front();
    TableOf<Line> out;
    out.column("first", "first", [](auto &line) { return line.first.label; });
    out.column("second", "second", [](auto &line) { return line.second.label; });
    out.column("quantity", "", &Line::quantity);
    out.data("smallest_size", [](auto &line) { return line.threshold; });
    out.column("n_first", "events", [](auto &line) { return line.test.n[0]; });
    out.column("n_second", "events", [](auto &line) { return line.test.n[1]; });
    out.column("mean_first", "mean", [](auto &line) { return line.test.means[0]; });
    out.column("mean_second", "mean", [](auto &line) { return line.test.means[1]; });
    out.column("ratio", "ratio", [](auto &line) { return line.test.ratio; });
    out.column(
        "ks_distance", "distance", [](auto &line) { return line.test.distance; }, 3);
    out.column("p", "p", [](auto &line) { return line.test.p; });
    out.column("block", "blocks of", [](auto &line) { return line.test.block; });
    out.show("", [](auto &line) {
      return line.test.p.value < 0.05 ? "they differ" : "no difference seen";
    });
    out.comment(
        "p: share of random divisions of the two series, by blocks of consecutive values, "
        "whose Kolmogorov-Smirnov distance is as large");
    Results results;
    results.say(texts(threshold_, tables));
    for (std::size_t i = 1; i < tables.size(); ++i) {
      // both from the size on from which both are complete
      const double least = std::max(threshold_.of(first).size, threshold_.of(tables[i]).size);
      for (const std::string quantity : {"size", "time"})
        out.row({first, tables[i], least, quantity, test(first, tables[i], quantity, least)});
    }
    results.table("tests", std::move(out), "");
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_compare() { return std::make_shared<Compare>(); }

}  // namespace LSM::postproc
