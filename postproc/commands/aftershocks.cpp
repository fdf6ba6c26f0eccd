// SPDX-License-Identifier: GPL-2.0-or-later
#include <optional>

#include <fmt/format.h>

#include "aftershock_figure.h"
#include "command.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

class AftershockRates : public Statistic {
  Threshold threshold_;
  std::optional<double> main_size_, window_;
  double share_ = 0.02, first_ = 0.0;
  double hold_c_ = std::numeric_limits<double>::quiet_NaN();
  double factor_ = 1.5848931924611136;  // five bins a decade
  int replicas_ = 100;
  std::uint64_t seed_ = 1;

  const char *help() const override {
    return "Rate of events after main shocks, all sequences stacked, the Omori-Utsu law n(t) = K "
           "(t + c)^-p + background fitted to it by maximum likelihood (Utsu 1961, Ogata 1983), "
           "and the same for Poisson catalogues of the same events. A main shock is the largest "
           "of all events that start within a window before its start to a window after its end. "
           "Events before main shocks are counted, too. † The paper does not look for aftershocks";
  }

  void add_options(CLI::App *command) override {
    add_usual(command, "aftershocks");
    OptionGroup group(command, "Sequences");
    add_threshold(group, threshold_, "the events that are counted");
    CLI::Option *const main_size =
        group.add("--main-size", main_size_, "Smallest main shock (model energy)",
                  size_or_magnitude(), positive(), shown("from --main-share"));
    group.add("--main-share", share_,
              "Fraction of the counted events that are large enough for a main shock",
              between(0.0, 1.0), excludes(main_size));
    group.add("--window", window_,
              "Time before and after a main shock without a larger event; events are counted for "
              "as long after it (model time)",
              positive(), shown("1/5 of the mean time between events of the main size"));
    group.add("--first", first_,
              "Events sooner than this after the end of a main shock are not counted (model time)",
              zero_or_more());
    group.add("--hold-c", hold_c_, "Fixed value of c (model time; 0 needs --first above 0)",
              zero_or_more(), shown("fitted"));
    group.add("--bin-factor", factor_,
              "Ratio of the edges of a bin of the picture: five bins a decade");
    group.add("--replicas", replicas_, "Poisson catalogues; 0: none", zero_or_more());
    add_seed(group, seed_);
  }

  std::vector<std::string> endings() const override { return {".omori.csv"}; }

  SequenceRule rule_for(const EventTable &table) const {
    SequenceRule rule;
    rule.least_size = threshold_.of(table).size;
    rule.first = first_;
    std::vector<double> sizes = column_from(table, rule.least_size, &Event::size);
    if (sizes.size() < 2)
      throw DegenerateData(fmt::format("{}: {} of size {} or larger, expected at least 2",
                                       table.path, sizes.empty() ? "no events" : "one event",
                                       short_number(rule.least_size)));
    std::sort(sizes.begin(), sizes.end(), std::greater<double>());
    const auto many =
        static_cast<std::size_t>(std::lround(share_ * static_cast<double>(sizes.size())));
    rule.main_size = main_size_.value_or(sizes[std::clamp(many, std::size_t{1}, sizes.size()) - 1]);
    const auto large = events_from(table, std::max(rule.main_size, rule.least_size));
    if (large == 0)
      throw DegenerateData(
          fmt::format("{}: no event of size {} or larger, expected a smaller --main-size",
                      table.path, short_number(rule.main_size)));
    const double span = table.events.back().t_start - table.events.front().t_start;
    if (!(span > 0.0))
      throw DegenerateData(table.path + ": all times are 0: the events start together");
    rule.window = window_.value_or(0.2 * span / static_cast<double>(large));
    return rule;
  }

  /// Why a catalogue has no main shock.
  static std::string no_main_shock(const EventTable &table, const SequenceRule &rule) {
    std::int64_t large = 0, early = 0, late = 0;
    for (const EventSummary &event : table.events) {
      if (!(event.size >= rule.main_size)) continue;
      ++large;
      if (event.t_start - rule.window < table.events.front().t_start)
        ++early;
      else if (event.t_end + rule.window > table.events.back().t_start)
        ++late;
    }
    return fmt::format(
        "{}: no main shock, of which the times before and after have to be in the catalogue: of {} "
        "of size {} or larger, {} come less than {} {} after the first event, {} less than that "
        "before the last, and {} with one as large within that time; expected a shorter --window",
        table.path, large, short_number(rule.main_size), early, short_number(rule.window),
        table.time_unit(), late, large - early - late);
  }

  Results of(const std::vector<EventTable> &tables) override {
    std::vector<AftershockCurve> curves;
    Results results;
    for (const EventTable &table : tables) {
      try {
        const SequenceRule rule = rule_for(table);
        curves.push_back({table.label, table.info.model,
                          aftershocks_of(table, rule, hold_c_, factor_, replicas_, seed_)});
        if (curves.back().aftershocks.sequences.main_shocks == 0)
          results.warn(no_main_shock(table, rule));
      } catch (const DegenerateData &few) {
        if (tables.size() == 1) throw;
        results.warn(few.what());
      }
    }
    if (curves.empty()) throw DegenerateData("none of the catalogues has main shocks");
    // Having no aftershocks is a result as well, but there is nothing to draw.
    const bool none = std::all_of(curves.begin(), curves.end(), [](const AftershockCurve &curve) {
      return curve.aftershocks.bins.empty();
    });
    results.say(texts(threshold_, tables));
    results.table("laws", aftershock_table(curves), ".omori");
    if (!none || !picture.no_picture) results.figure("rates", aftershock_figure(curves));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_aftershocks() { return std::make_shared<AftershockRates>(); }

}  // namespace LSM::postproc
