// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "benchmark_figure.h"
#include "command.h"
#include "lsm_slip_history.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

[[noreturn]] void refuse(const std::string &path, std::int64_t line, const std::string &what) {
  throw FileError(text_io::where(path, line) + what);
}

void put(BenchmarkCurves &curves, const std::string &name, double x, double t, double slip,
         double rate) {
  auto found = std::find_if(curves.begin(), curves.end(),
                            [&name](const NamedCurves &c) { return c.name == name; });
  if (found == curves.end()) found = curves.insert(curves.end(), {name, 0.0, {}});
  if (found->stations.empty() || found->stations.back().x != x)
    found->stations.push_back({x, {}, {}, {}});
  StationCurve &station = found->stations.back();
  station.t.push_back(t);
  station.slip.push_back(slip);
  station.rate.push_back(rate);
}

/// Table with the columns curve, x, t, slip, slip_rate.
void read_reference(const std::string &path, BenchmarkCurves &curves) {
  text_io::LineReader in(path);
  std::string_view line;
  std::vector<std::string_view> fields;
  bool named = false;
  double last_t = 0.0, last_x = 0.0;
  std::string last_name;
  while (in.next(line)) {
    line = text_io::trim(line);
    if (line.empty() || line.front() == '#') continue;
    if (!named) {
      if (line != "curve,x,t,slip,slip_rate")
        refuse(path, in.line(), "expected the columns 'curve,x,t,slip,slip_rate'");
      named = true;
      continue;
    }
    text_io::split(line, fields);
    double v[4];
    bool good = fields.size() == 5 && !fields[0].empty();
    for (std::size_t n = 0; good && n < 4; ++n) good = text_io::parse(fields[n + 1], v[n]);
    if (!good)
      refuse(path, in.line(), text_io::in_quotes(line) + ", expected a name and four numbers");
    const std::string name(fields[0]);
    if (name == last_name && v[0] == last_x && !(v[1] > last_t))
      refuse(path, in.line(), "time " + text_io::number(v[1]) + ", expected increasing times");
    last_name = name;
    last_x = v[0];
    last_t = v[1];
    put(curves, name, v[0], v[1], v[2], v[3]);
  }
  if (!named) throw FileError(path + ": no rows, expected the columns 'curve,x,t,slip,slip_rate'");
}

/// X=FILE or NAME:X=FILE; the file has columns t, slip and slip rate between blanks, and maybe
/// more.
void read_curve(const std::string &given, BenchmarkCurves &curves) {
  const auto equals = given.find('=');
  const std::string place = given.substr(0, equals == std::string::npos ? 0 : equals);
  const auto colon = place.rfind(':');
  const std::string name = colon == std::string::npos ? "reference" : place.substr(0, colon);
  double x = 0.0;
  if (!text_io::parse(place.substr(colon == std::string::npos ? 0 : colon + 1), x))
    throw std::invalid_argument("--curve is " + text_io::in_quotes(given) +
                                ", expected X=FILE or NAME:X=FILE with the place X of the station");
  const std::string path = given.substr(equals + 1);
  text_io::LineReader in(path);
  std::string_view line;
  double last = -std::numeric_limits<double>::infinity();
  while (in.next(line)) {
    line = text_io::trim(line);
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words{std::string(line)};
    std::string word;
    double v[3];
    for (double &value : v)
      if (!(words >> word) || !text_io::parse(word, value))
        refuse(path, in.line(), "expected time, slip and slip rate");
    if (!(v[0] > last)) refuse(path, in.line(), "expected increasing times");
    last = v[0];
    put(curves, name, x, v[0], v[1], v[2]);
  }
  if (std::isinf(last)) throw FileError(path + ": no rows, expected time, slip and slip rate");
}

/// Slip at the end of each record, slip rate in its middle. A parameter `scale` of the header says
/// by what the stresses, and with them the slip, were multiplied.
NamedCurves read_history(const std::string &path, bool lenient, const std::string &label) {
  SlipHistoryReader reader(path, lenient);
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
      // slip of the middle, so that both are of one time
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

std::string cell(double value, const char *format) {
  return std::isnan(value) ? "-" : fmt::format(fmt::runtime(format), value);
}

std::string stations_text(const NamedCurves &run, const NamedCurves &reference,
                          const std::vector<StationMisfit> &stations) {
  std::string out = fmt::format("\n{} against {}\n", run.name, reference.name);
  out += fmt::format("{:>10} {:>9} {:>9} {:>8} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "x",
                     "arrival", "ref.", "late", "slip", "ref.", "more %", "L2 %", "peak V", "ref.",
                     "L2(V) %");
  for (const StationMisfit &m : stations)
    out += fmt::format(
        "{:10g} {:>9} {:>9} {:>8} {:9.4f} {:9.4f} {:8.3f} {:8.3f} {:8.3f} {:8.3f} {:8.2f}\n", m.x,
        cell(m.arrival, "{:.4f}"), cell(m.reference_arrival, "{:.4f}"),
        cell(m.arrival - m.reference_arrival, "{:.4f}"), m.end_slip, m.reference_end_slip,
        100.0 * (m.end_slip / m.reference_end_slip - 1.0), 100.0 * m.slip_l2, m.peak,
        m.reference_peak, 100.0 * m.rate_l2);
  return out;
}

std::string summary_text(const std::vector<std::pair<const NamedCurves *, MisfitSummary>> &runs,
                         const std::string &reference) {
  std::string out = fmt::format(
      "\nagainst {}, over all stations\n{:>24} {:>9} {:>16} {:>16} {:>12} {:>10} {:>10}\n",
      reference, "run", "spacing", "arrival (max)", "slip % (max)", "L2(slip) %", "peak V %",
      "L2(V) %");
  for (const auto &[run, s] : runs)
    out += fmt::format(
        "{:>24} {:9g} {:>7.4f} ({:>6.4f}) {:>7.3f} ({:>6.3f}) {:12.3f} {:10.2f} {:10.2f}\n",
        run->name, run->spacing, s.arrival, s.largest_arrival, 100.0 * s.end_slip,
        100.0 * s.largest_end_slip, 100.0 * s.slip_l2, 100.0 * s.peak, 100.0 * s.rate_l2);
  for (std::size_t n = 1; n < runs.size(); ++n) {
    const auto &[a, coarse] = runs[n - 1];
    const auto &[b, fine] = runs[n];
    if (!(a->spacing > 0.0) || !(b->spacing > 0.0) || a->spacing == b->spacing) continue;
    const double h = a->spacing, k = b->spacing;
    out += fmt::format("order from {:g} to {:g}: arrival {:.2f}, slip {:.2f}, L2(V) {:.2f}\n", h, k,
                       order(coarse.arrival, fine.arrival, h, k),
                       order(coarse.end_slip, fine.end_slip, h, k),
                       order(coarse.rate_l2, fine.rate_l2, h, k));
  }
  return out;
}

class Benchmark : public Analysis {
  std::vector<std::string> histories_, references_, curves_, labels_;
  std::vector<double> stations_;
  double rate_ = 1.0, until_ = std::numeric_limits<double>::infinity();
  bool lenient_ = false;

  const char *help() const override {
    return "Compares ruptures, as slip histories of compute lsm/events, with curves of slip and "
           "slip rate at places of the fault (ours): arrival times, slip at the end, peak slip "
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
              kind("FILE"), shown("none"));
    group.add("--curve", curves_,
              "X=FILE or NAME:X=FILE: columns time, slip, slip rate, separated by blanks, at "
              "place X",
              shown("none"));
    group.add("--station", stations_,
              "Places that are compared and drawn (default: all; drawn: up to six that all "
              "references have)");
    group.add("--arrival", rate_,
              "Slip rate above which the rupture has arrived, units of the reference", positive());
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

  /// The places of a reference that are compared.
  std::vector<StationMisfit> misfits(const NamedCurves &run, const NamedCurves &reference) const {
    std::vector<StationMisfit> stations;
    for (const StationCurve &station : reference.stations) {
      if (!stations_.empty() && !near_one_of(stations_, station.x)) continue;
      const StationMisfit found = misfit(at_place(run, station.x), station, rate_, until_);
      // else the reference ends before it
      if (found.reference_end_slip > 0.0) stations.push_back(found);
    }
    if (stations.empty())
      throw std::invalid_argument(reference.name + ": no place of --station slips in it");
    return stations;
  }

  Findings find() override {
    const std::vector<std::string> labels = labels_of(histories_, labels_, "history");
    BenchmarkCurves references, runs;
    for (const std::string &path : references_) read_reference(path, references);
    for (const std::string &given : curves_) read_curve(given, references);
    if (references.empty())
      throw std::invalid_argument("no reference, expected --reference FILE or --curve X=FILE");
    for (std::size_t n = 0; n < histories_.size(); ++n)
      runs.push_back(read_history(histories_[n], lenient_, labels[n]));
    std::stable_sort(runs.begin(), runs.end(), [](const NamedCurves &a, const NamedCurves &b) {
      return a.spacing > b.spacing;
    });

    Findings found;
    Table table = misfit_table();
    for (const NamedCurves &reference : references) {
      std::vector<std::pair<const NamedCurves *, MisfitSummary>> summaries;
      for (const NamedCurves &run : runs) {
        const std::vector<StationMisfit> stations = misfits(run, reference);
        for (const StationMisfit &m : stations) add_misfit(table, run, reference.name, m);
        found.say(stations_text(run, reference, stations));
        summaries.emplace_back(&run, summary(stations));
      }
      found.say(summary_text(summaries, reference.name));
    }
    found.table("stations", std::move(table), "-stations");
    found.figure("", benchmark_figure(runs, references, stations_, rate_, until_));
    return found;
  }
};

}  // namespace

std::shared_ptr<Command> make_benchmark() { return std::make_shared<Benchmark>(); }

}  // namespace LSM::postproc
