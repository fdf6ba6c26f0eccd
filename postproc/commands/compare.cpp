// SPDX-License-Identifier: GPL-2.0-or-later
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "commands.h"
#include "intervals.h"
#include "json_output.h"
#include "lsm_sum.h"
#include "new_file.h"
#include "numbers.h"
#include "option_values.h"
#include "plot.h"
#include "two_sample.h"

namespace LSM::postproc {

namespace {

struct Options {
  CatalogueOptions catalogues;
  JsonOutput json;
  Threshold threshold;
  std::string output = "compare";
  int replicas = 2000, block = 0;
  bool rescale = false;
  std::uint64_t seed = 1;
};

void run(Options &options) {
  options.json.check(options.catalogues.paths);
  if (options.catalogues.paths.size() < 2)
    throw std::invalid_argument("one catalogue, expected at least two to compare");
  const PictureOptions files{options.output, true};
  files.check(options.catalogues.paths, {}, {options.json.output()});
  const std::vector<EventTable> tables = load_catalogues(options.catalogues);
  Table out({"first", "second", "quantity", "smallest_size", "n_first", "n_second", "ks_distance",
             "p", "p_error", "block", "mean_first", "mean_first_error", "mean_second",
             "mean_second_error", "ratio", "ratio_error"});
  out.comment(
      "p: share of random divisions of the two series, by blocks of consecutive values, "
      "whose Kolmogorov-Smirnov distance is as large");
  const double threshold = options.threshold.complete_in(tables.front()).size;
  const auto sizes_of = [threshold](const EventTable &table) {
    std::vector<double> sizes;
    for (const double size : table.size)
      if (size >= threshold) sizes.push_back(size);
    return sizes;
  };
  const auto times_of = [threshold, &options](const EventTable &table) {
    std::vector<double> times = inter_event_times(table, threshold);
    const double mean =
        sum_pairwise(times.data(), times.size()) / static_cast<double>(times.size());
    if (options.rescale)
      for (double &time : times) time /= mean;
    return times;
  };
  for (const std::string &line : texts(options.threshold, tables)) fmt::print("{}\n", line);
  for (std::size_t i = 1; i < tables.size(); ++i) {
    const EventTable &first = tables.front(), &second = tables[i];
    for (const std::string quantity : {"size", "time"}) {
      TwoSampleTest test;
      try {
        test = quantity == "size" ? two_sample_test(sizes_of(first), sizes_of(second),
                                                    options.replicas, options.seed, options.block)
                                  : two_sample_test(times_of(first), times_of(second),
                                                    options.replicas, options.seed, options.block);
      } catch (const std::invalid_argument &e) {
        throw std::runtime_error(
            fmt::format("{} and {}: {}s: {}", first.path, second.path, quantity, e.what()));
      }
      fmt::print(
          "{} and {}: {}s: {} and {}, means {} and {}, ratio {}; distance {}, p = {} (blocks of "
          "{}){}\n",
          first.label, second.label, quantity, test.n[0], test.n[1],
          with_error(test.means[0].mean, test.means[0].error),
          with_error(test.means[1].mean, test.means[1].error),
          with_error(test.ratio, test.ratio_error), short_number(test.distance, 3),
          with_error(test.p, test.p_error), test.block,
          test.p < 0.05 ? ": they differ" : ": no difference seen");
      out.add(first.label).add(second.label).add(quantity).add(threshold);
      out.add(test.n[0]).add(test.n[1]).add(test.distance).add(test.p).add(test.p_error);
      out.add(std::int64_t{test.block});
      for (const BlockMean &mean : test.means) out.add(mean.mean).add(mean.error);
      out.add(test.ratio).add(test.ratio_error).end_row();
    }
  }
  out.write(files.table());
  fmt::print("wrote {}\n", files.table());
  options.json.add("tests", out);
  options.json.write();
}

}  // namespace

void add_compare(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "compare",
      "Do catalogues agree? Sizes, and times from start to start, of each catalogue against the "
      "first: Kolmogorov-Smirnov distance with its p-value by random divisions in blocks of "
      "consecutive events (ours; events come in sequences), ratio of the means with its error");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  options->json.add_to(command);
  options->catalogues.add_displacement(command);
  command->add_option("--output,-o", options->output, "BASE: the table is written to BASE.csv");
  add_threshold(command, options->threshold, "the events that are compared");
  command->add_flag("--rescale", options->rescale,
                    "Divide the times of each catalogue by their mean (as Corral 2004 does): do "
                    "they have the same form?");
  command->add_option("--replicas", options->replicas, "Random divisions of each p-value")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--block", options->block,
                   "Consecutive events that change sides together; 0: as many as the correlation "
                   "of the series asks for; 1: as if events were independent")
      ->check(zero_or_more());
  add_seed(command, options->seed);
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
