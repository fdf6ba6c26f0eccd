// SPDX-License-Identifier: GPL-2.0-or-later
#include <stdexcept>

#include <fmt/format.h>

#include "benchmark_figure.h"
#include "command.h"
#include "files/slip_history.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

/// The station of a curve to which rows are added; a new one where the curve or the place changes.
StationCurve &station_of(std::vector<NamedCurves> &curves, std::string_view name, double x) {
  auto found = std::find_if(curves.begin(), curves.end(),
                            [&name](const NamedCurves &c) { return c.name == name; });
  if (found == curves.end()) found = curves.insert(curves.end(), {std::string(name), 0.0, {}});
  if (found->stations.empty() || found->stations.back().x != x)
    found->stations.push_back({x, {}, {}, {}});
  return found->stations.back();
}

/// Reads a table with the columns curve, x, t, slip, slip_rate, and adds its curves.
/// \throws FileError
void read_reference(const std::string &path, std::vector<NamedCurves> &curves) {
  constexpr std::string_view columns = "curve,x,t,slip,slip_rate";
  text_io::LineReader in(path);
  const std::size_t before = curves.size();
  std::string_view line;
  std::vector<std::string_view> fields;
  bool named = false;
  const auto refuse = [&](const std::string &what) {
    throw FileError(text_io::where(path, in.line()) + what);
  };
  while (in.next(line)) {
    line = text_io::trim(line);
    if (line.empty() || line.front() == '#') continue;
    if (!named) {
      if (line != columns) refuse(fmt::format("expected the columns '{}'", columns));
      named = true;
      continue;
    }
    text_io::split(line, fields);
    double x = 0.0, t = 0.0, slip = 0.0, rate = 0.0;
    if (fields.size() != 5 || fields[0].empty() || !text_io::parse(fields[1], x) ||
        !text_io::parse(fields[2], t) || !text_io::parse(fields[3], slip) ||
        !text_io::parse(fields[4], rate))
      refuse(text_io::in_quotes(line) + ", expected a name and four numbers");
    StationCurve &station = station_of(curves, fields[0], x);
    if (!station.t.empty() && !(t > station.t.back()))
      refuse("time " + text_io::number(t) + ", expected increasing times");
    station.t.push_back(t);
    station.slip.push_back(slip);
    station.rate.push_back(rate);
  }
  if (curves.size() == before)
    throw FileError(fmt::format("{}: no rows, expected those of the columns '{}'", path, columns));
}

/// Reads slip and slip rate in the middle of each record. The parameter `scale` of the header is
/// the factor by which the stresses, and with them the slip, were multiplied.
/// \throws FileError
NamedCurves read_history(const std::string &path, bool lenient, const std::string &label) {
  SlipHistoryReader reader(text_io::open_plain(path), lenient);
  const SlipHistoryInfo &info = reader.info();
  const std::string *text = info.find("scale");
  double scale = 1.0;
  if (text && (!text_io::parse(*text, scale) || !(scale > 0.0)))
    throw FileError(path + ": parameter 'scale' is " + text_io::in_quotes(*text) +
                    ", expected a positive number");
  NamedCurves run{label, info.grid.width, {}};
  for (int b = 0; b < info.grid.bins; ++b)
    run.stations.push_back({info.grid.centre(b), {}, {}, {}});
  std::vector<double> slip(run.stations.size(), 0.0);
  SlipRecord record;
  while (reader.next(record)) {
    const double begin = info.grid.time(record.step_begin), end = info.grid.time(record.step_end);
    for (std::size_t b = 0; b < slip.size(); ++b) {
      StationCurve &station = run.stations[b];
      const double more = static_cast<double>(record.row.slip[b]) / scale;
      // Slip is interpolated to the middle, the time to which the mean slip rate belongs.
      station.t.push_back(0.5 * (begin + end));
      station.slip.push_back(slip[b] + 0.5 * more);
      station.rate.push_back(end > begin ? more / (end - begin) : 0.0);
      slip[b] += more;
    }
  }
  if (run.stations.front().t.size() < 2)
    throw FileError(path + ": one record, expected a slip history");
  return run;
}

/// Orders of convergence: how the misfits to a reference fall with the spacing, from each run to
/// the next one in the list.
std::vector<std::string> orders(const std::vector<Misfits> &all) {
  std::vector<std::string> lines;
  for (std::size_t n = 1; n < all.size(); ++n) {
    const Misfits &one = all[n - 1], &finer = all[n];
    if (one.reference != finer.reference) continue;
    const MisfitSummary &a = one.summary, &b = finer.summary;
    const double h = one.run->spacing, k = finer.run->spacing;
    if (!(h > 0.0) || !(k > 0.0) || h == k) continue;
    lines.push_back(fmt::format(
        "against {}: order from {:g} to {:g}: arrival {:.2f}, slip {:.2f}, L2(V) {:.2f}",
        one.reference, h, k, order(a.arrival, b.arrival, h, k), order(a.end_slip, b.end_slip, h, k),
        order(a.rate_l2, b.rate_l2, h, k)));
  }
  return lines;
}

class Benchmark : public Analysis {
  // The rupture has arrived above this slip rate, in the units of the references.
  static constexpr double arrived = 1.0;

  std::vector<std::string> histories_, references_, labels_;
  double until_ = std::numeric_limits<double>::infinity();
  bool lenient_ = false;

  const char *help() const override {
    return "Compares ruptures, as slip histories of compute lsm/events, with curves of slip and "
           "slip rate at places of the fault †: arrival times, slip at the end, peak slip "
           "rate, relative L2 differences, and the order of convergence over histories of several "
           "spacings. Slip is divided by the parameter 'scale' of the history's header. Writes the "
           "numbers (BASE-stations.csv) and a picture of the curves and fronts";
  }

  void add_options(CLI::App *command) override {
    json.add_to(command);
    OptionGroup own(command), group(command, "Reference");
    own.add("histories", histories_, "Slip histories, one run each", required());
    own.add("--label", labels_,
            "Name of a run, once per history and in their order (default: file name)");
    group.add("--reference", references_,
              "Table with the columns curve,x,t,slip,slip_rate; several curves of several places "
              "in one file",
              kind("FILE"), required());
    group.add("--until", until_, "End of the comparison (model time)", positive(),
              shown("end of the shorter record"));
    own.flag("--lenient", lenient_, "Drop a truncated last record");
    add_picture(command, "benchmark");
  }

  std::vector<std::string> inputs() const override {
    std::vector<std::string> inputs = histories_;
    inputs.insert(inputs.end(), references_.begin(), references_.end());
    return inputs;
  }
  std::vector<std::string> endings() const override { return {"-stations.csv"}; }

  /// Misfits at all places of a reference that slip in it before the end of the comparison.
  std::vector<StationMisfit> misfits(const NamedCurves &run, const NamedCurves &reference) const {
    std::vector<StationMisfit> stations;
    for (const StationCurve &station : reference.stations) {
      const StationMisfit found = misfit(at_place(run, station.x), station, arrived, until_);
      // The end slip is 0 where the rupture arrives only after the end of the reference.
      if (found.reference_end_slip > 0.0) stations.push_back(found);
    }
    if (stations.empty()) throw std::invalid_argument(reference.name + ": no place slips in it");
    return stations;
  }

  Results find() override {
    const std::vector<std::string> labels = labels_of(histories_, labels_, "history");
    std::vector<NamedCurves> references, runs;
    for (const std::string &path : references_) read_reference(path, references);
    for (std::size_t n = 0; n < histories_.size(); ++n)
      runs.push_back(read_history(histories_[n], lenient_, labels[n]));
    std::stable_sort(runs.begin(), runs.end(), [](const NamedCurves &a, const NamedCurves &b) {
      return a.spacing > b.spacing;
    });

    Results results;
    std::vector<Misfits> all;
    for (const NamedCurves &reference : references)
      for (const NamedCurves &run : runs) {
        std::vector<StationMisfit> stations = misfits(run, reference);
        const MisfitSummary over_all = summary(stations);
        all.push_back({&run, reference.name, std::move(stations), over_all});
      }
    results.table("stations", misfit_table(all), "-stations");
    results.table("", misfit_summary_table(all));
    results.say(orders(all));
    results.figure("", benchmark_figure(runs, references, arrived, until_));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_benchmark() { return std::make_shared<Benchmark>(); }

}  // namespace LSM::postproc
