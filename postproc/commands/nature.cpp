// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <optional>
#include <stdexcept>

#include "command.h"
#include "interval_figures.h"
#include "nature_figure.h"

namespace LSM::postproc {

namespace {

class Nature : public Statistic {
  NatureSettings settings_;
  std::optional<double> shortest_;

  const char *help() const override {
    return "Models compared with nature: catalogues of models ranked by the distance of their "
           "inter-event times, over their mean, to those of earthquakes, with sizes, clustering "
           "and the events around large ones. The first catalogue is that of the earthquakes. "
           "Catalogues of the same --label are samples of one model, whose scatter gives the "
           "errors †";
  }

  void add_options(CLI::App *command) override {
    add_usual(command, "nature");
    OptionGroup group(command, "Comparison †");
    add_thresholds(group, settings_.thresholds, "the models' events");
    group.add("--reference", settings_.reference,
              "Smallest size of the earthquakes, such as M2.5; several allowed, and models are "
              "compared with the smallest",
              one_each(), size_or_magnitude(), zero_or_more(), shown("all events"));
    group.add("--shortest", shortest_,
              "Leave times shorter than this multiple of their mean out of the fits of gamma; "
              "without it as postproc intervals",
              shown(""), zero_or_more());
    group.add("--main-share", settings_.share, "Fraction of the events that count as large",
              between(0.0, 1.0));
    group.add("--replicas", settings_.replicas,
              "Resamplings of the errors of distances, in blocks of consecutive events",
              positive());
    add_seed(group, settings_.seed);
  }

  std::vector<std::string> endings() const override { return {".table.csv", ".table1.csv"}; }

  Results of(const std::vector<EventTable> &tables) override {
    if (tables.size() < 2)
      throw std::invalid_argument("one catalogue, expected that of nature and at least one other");
    if (!tables.front().earthquakes())
      throw std::invalid_argument(tables.front().path +
                                  ": catalogue of a model, expected one of earthquakes first");
    settings_.shortest = shortest_.value_or(NAN);
    const std::vector<NatureRow> rows = nature_rows(tables, settings_);
    Results results;
    results.table("models", nature_table(rows), ".table");
    results.table("table1", table1(nature_table1(rows), true), ".table1");
    results.figure("", nature_figure(rows));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_nature() { return std::make_shared<Nature>(); }

}  // namespace LSM::postproc
