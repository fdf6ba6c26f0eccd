// SPDX-License-Identifier: GPL-2.0-or-later
#include "statements.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "input_file.h"
#include "intervals.h"
#include "numbers.h"
#include "run_files.h"
#include "two_sample.h"

namespace LSM::postproc {

namespace {

constexpr const char *holds = "holds", *fails = "fails", *undecided = "undecided";

struct Statement {
  const char *name, *quote;
};

constexpr Statement
    velocities = {"velocities",
                  "The distribution of slip velocities was monotonic, decreasing for all slip "
                  "velocities. (Sect. 4.1)"},
    neighbours = {"neighbours",
                  "Slip at a single contact will in most cases, trigger dynamic rupture of "
                  "neighbouring contacts. (Sect. 5)"},
    locked = {"locked",
              "During intervals in which the fault is locked, the potential in the model increases "
              "due to loading at the boundaries. (Sect. 4.1)"},
    rolling_off = {"roll-off",
                   "Both LSM and block-slider simulations display an exponential roll-off in event "
                   "numbers for the large event tail of the distributions. (Sect. 4.2)"},
    numbers = {"numbers",
               "1-3 x 10^7 time steps, resulting in the generation of between 3000 and 8000 events "
               "generated during each simulation (Sect. 2); LSM: B 15.21, C 0.0573 (Table 1)"},
    same_times = {"times",
                  "different simulations from a given model all display the same inter-event time "
                  "distribution (Sect. 4.3)"};

/// Parameters of the paper's Table 1, and the time step that follows from them and the numbers of
/// events in the paper: 1e7 steps for 3000 events give 0.0045, 3e7 steps for 8000 give 0.0040.
constexpr double printed_b = 15.21, printed_c = 0.0573, printed_mean = 0.995 * printed_b;
constexpr double longest_dt = printed_mean * 3000.0 / 1e7,
                 shortest_dt = printed_mean * 8000.0 / 3e7;

class Statements : public CatalogueAnalysis {
  Threshold threshold_;
  RunFiles ruptures_ = RunFiles::ruptures(), histories_ = RunFiles::history();
  int replicas_ = 2000;
  std::uint64_t seed_ = 1;

  const char *help() const override {
    return "What the paper says about its fault in words, as numbers: whether the density of slip "
           "velocities falls all the way, ruptures that reach no neighbour, slip and PE while no "
           "event is open, form of the roll-off, events and times against its steps and Table 1, "
           "and whether catalogues have the same inter-event times. The statements are printed; "
           "numbers, errors and criteria are not (†)";
  }

  void add_options(CLI::App *command) override {
    catalogues.add_to(command);
    catalogues.details = CatalogueOptions::all_events;
    json.add_to(command);
    OptionGroup group(command);
    add_table(group, "statements");
    add_threshold(group, threshold_, "the events");
    group.add("--replicas", replicas_, "Random permutations for the p-values of inter-event times",
              positive());
    add_seed(group, seed_);
    ruptures_.add_to(command);
    histories_.add_to(command);
  }

  std::vector<std::string> inputs() const override {
    std::vector<std::string> all = catalogues.paths;
    for (const RunFiles *files : {&ruptures_, &histories_})
      for (const std::string &path : files->of(catalogues.paths))
        if (!path.empty()) all.push_back(path);
    return all;
  }
  std::vector<std::string> endings() const override { return {".velocities.csv"}; }

  static Table empty_table() {
    return Table(Columns{{"statement", "statement"},
                         {"catalogue", "catalogue"},
                         {"number", ""},
                         {"value", "", 4, true},
                         {"p", "p", 2},
                         {"expected", "expected"},
                         {"verdict", ""},
                         {"note", ""},
                         {"quote", {}}});
  }

  static void row(Table &out, const Statement &statement, const std::string &catalogue,
                  const std::string &number, const Measured &value, const std::string &expected,
                  const char *verdict, const std::string &note = {}, double p = NAN) {
    out.row(statement.name, catalogue, number, value, p, expected, verdict, note, statement.quote);
  }

  /// Whether a number is above a limit; undecided unless by more than two standard errors.
  static const char *above(const Measured &number, double limit) {
    if (!(std::fabs(number.value - limit) > 2.0 * number.error)) return undecided;
    return number.value > limit ? holds : fails;
  }
  static const char *below(const Measured &number, double limit) {
    return above({-number.value, number.error}, -limit);
  }

  static void add_velocities(Table &out, Table &curves, const std::string &label,
                             const std::string &which, const Monotony &m) {
    for (std::size_t b = 0; b < m.density.size(); ++b)
      curves.row(label, which, m.edges[b], m.edges[b + 1], m.density[b]);
    const bool known = !std::isnan(m.rise.value);
    row(out, velocities, label, "largest rise of the density, " + which, m.rise, "at most 1",
        !known    ? undecided
        : m.rises ? fails
                  : holds,
        known ? fmt::format("from {} to {} plate velocities{}", short_number(m.rises_from, 2),
                            short_number(m.rises_to, 2), m.rises ? "" : "; chance")
              : "too few velocities");
  }

  void add_slip(Table &out, Table &curves, const EventTable &table, const std::string &path) const {
    SlipHistoryReader history = open_history(path, catalogues.lenient);
    check_same_run(header_of(table), {path, history.info().header()});
    const SlipStatements s = with_path(path, [&] {
      return slip_statements(history, table.details, threshold_.complete_in(table).size);
    });
    add_velocities(out, curves, table.label, "at all times", s.velocities);
    add_velocities(out, curves, table.label, "while something slips", s.while_slipping);
    row(out, velocities, table.label, "share of the time with intervals of their own",
        {s.single, NAN}, "", "");
    row(out, velocities, table.label, "share of bins that slip backwards", {s.backwards, NAN}, "",
        "");
    // In the long run this ratio is 1 if the history records all slip. If it does not, slip rates
    // say nothing.
    const bool complete = std::fabs(s.recorded.value - 1.0) < 0.1;
    row(out, locked, table.label, "slip recorded over that of the plates", s.recorded, "1",
        complete ? holds : fails);
    row(out, locked, table.label, "share of the time while no event is open", {s.time_between, NAN},
        "", "");
    row(out, locked, table.label, "share of the slip while no event is open", s.slip_between, "",
        "");
    row(out, locked, table.label, "slip rate within events over that between them", s.rate_within,
        "above 1", above(s.rate_within, 1.0));
    row(out, locked, table.label, "slip rate between events over that of the plates",
        s.rate_between, "below 0.5: locked", complete ? below(s.rate_between, 0.5) : undecided);
    row(out, locked, table.label, "rise of PE between events over the work of the plates",
        s.rise_over_work, "above 0.5: by loading", above(s.rise_over_work, 0.5));
  }

  void add_ruptures(Table &out, const EventTable &table, const std::string &path) const {
    CatalogueOptions which = catalogues;
    which.paths = {path};
    const EventTable ruptures = load_catalogue(path, which);
    check_same_run(header_of(table), header_of(ruptures));
    state_repairs(ruptures);
    const Measured share = share_of_one_bin(ruptures);
    const std::string *const slipping = ruptures.info.find("slipping");
    row(out, neighbours, table.label,
        fmt::format("share of ruptures of one bin (from {} plate velocities on)",
                    slipping ? *slipping : "?"),
        share, "below 0.5", below(share, 0.5));
  }

  void add_roll_off(Table &out, const EventTable &table) const {
    const RollOff fit = roll_off(table, threshold_.complete_in(table).size);
    const GeneralisedGammaFit &free = fit.free;
    const Measured power = {free.delta, free.se_delta};
    row(out, rolling_off, table.label, "power d of s^-a exp(-(s/c)^d)", power, "1",
        free.degenerate                                     ? undecided
        : std::fabs(power.value - 1.0) <= 2.0 * power.error ? holds
                                                            : fails,
        free.why);
    row(out, rolling_off, table.label, "2 ln L of d = 1 over a power law without end",
        {fit.gain, NAN}, "above 3.84",
        fit.gain > 3.84    ? holds
        : fit.gain <= 3.84 ? fails
                           : undecided);
  }

  void add_numbers(Table &out, const EventTable &table) const {
    const double least = threshold_.complete_in(table).size;
    const std::vector<double> times = positive_ones(inter_event_times(table, least));
    const auto factor = [&](const std::string &number, const Measured &value, double printed) {
      const double off = value.value / printed;
      const std::string in_words = fmt::format("{} times the paper's", short_number(off, 2));
      row(out, numbers, table.label, number, value, short_number(printed),
          std::isnan(off)                             ? undecided
          : std::fabs(std::log(off)) <= std::log(2.0) ? holds
                                                      : fails,
          std::isnan(off) ? "" : in_words);
    };
    const double mean = times.empty() ? NAN : mean_of(times);
    const auto n = static_cast<double>(times.size());
    const double per_run = 1e7 * longest_dt / mean;
    factor(fmt::format("events in 1e7 steps of {}", short_number(longest_dt, 2)),
           {per_run, per_run / std::sqrt(n)}, 3000.0);
    const GeneralisedGammaFit fit =
        times.empty() ? GeneralisedGammaFit{}
                      : fit_with_share(times, shortest_time(table.picker_memory(), mean), 1.0);
    factor("B, delta 1", {fit.B, fit.se_B}, printed_b);
    factor("C, delta 1", {fit.C, fit.se_C}, printed_c);
  }

  void add_times(Table &out, const std::vector<EventTable> &tables) const {
    struct Pair {
      std::size_t first, second;
    };
    std::vector<Pair> pairs;
    for (std::size_t j = 1; j < tables.size(); ++j)
      for (std::size_t i = 0; i < j; ++i)
        if (tables[i].info.model == tables[j].info.model) pairs.push_back({i, j});
    // The level of 5 % is divided among the pairs that are tested (Bonferroni).
    const double least = 0.05 / static_cast<double>(pairs.size());
    for (const bool rescaled : {false, true})
      for (const Pair &pair : pairs) {
        std::vector<double> times[2];
        for (const std::size_t k : {0, 1}) {
          const EventTable &table = tables[k == 0 ? pair.first : pair.second];
          times[k] = inter_event_times(table, threshold_.complete_in(table).size);
          if (times[k].size() < 10)
            throw std::runtime_error(fmt::format("{}: {} inter-event times, expected at least 10",
                                                 table.path, times[k].size()));
          if (rescaled) times[k] = over_mean(std::move(times[k]));
        }
        const TwoSampleTest test = two_sample_test(times[0], times[1], replicas_, seed_);
        row(out, same_times,
            fmt::format("{} and {}", tables[pair.first].label, tables[pair.second].label),
            rescaled ? "distance of the times over their means" : "distance of the times",
            {test.distance, NAN}, fmt::format("p >= {}", short_number(least, 2)),
            test.p.value < least ? fails : holds, {}, test.p.value);
      }
  }

  Results find() override {
    const std::vector<std::string> histories = histories_.of(catalogues.paths),
                                   ruptures = ruptures_.of(catalogues.paths);
    const std::vector<EventTable> tables = load_catalogues(catalogues);
    for (const EventTable &table : tables)
      if (table.earthquakes() || table.info.overlapping())
        throw std::runtime_error(table.path + ": no drops of PE, expected a catalogue of these");
    Table out = empty_table(), curves("label,times,velocity_lo,velocity_hi,density,density_error");
    curves.comment(
        "density of the slip velocity of a bin of the fault, over that of the plates, by time");
    Results results;
    results.say(texts(threshold_, tables));
    for (std::size_t i = 0; i < tables.size(); ++i) {
      if (histories[i].empty())
        results.warn(
            tables[i].path +
            ": no slip history beside it, expected one (--history) for slip velocities and "
            "locked intervals");
      else
        add_slip(out, curves, tables[i], histories[i]);
      if (ruptures[i].empty())
        results.warn(
            tables[i].path +
            ": no catalogue of ruptures beside it, expected one (--ruptures) for neighbours");
      else
        add_ruptures(out, tables[i], ruptures[i]);
      add_roll_off(out, tables[i]);
      add_numbers(out, tables[i]);
    }
    add_times(out, tables);
    for (const Statement &one : {velocities, neighbours, locked, rolling_off, numbers, same_times})
      results.say(fmt::format("{}: \"{}\"\n", one.name, one.quote));
    results.table("statements", std::move(out), "");
    if (curves.rows() > 0) results.table("velocities", std::move(curves), ".velocities");
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_statements() { return std::make_shared<Statements>(); }

}  // namespace LSM::postproc
