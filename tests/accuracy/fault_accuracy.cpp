// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice solid fault: error against run time of one event, of waves and of long runs; picker
// readings; what rings; summation errors; agreement between numbers of ranks. Runs lmp and writes
// tables fault_*.csv. Usage: lsm_accuracy_fault FOLDER full|quick LMP INPUTS SCENES MPIEXEC...
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "event_statistics.h"
#include "friction_schemes.h"
#include "lsm_catalogue.h"
#include "lsm_event_picker.h"
#include "lsm_pe_series.h"
#include "lsm_sum.h"

namespace {

using Variables = std::vector<std::pair<std::string, std::string>>;

std::string folder, lmp, inputs, scenes, mpiexec;
bool quick = false;

constexpr double length = 60.0;  // of fault_event.in

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.12g", value);
  return buffer;
}
std::string work(const std::string &name) { return folder + "/work/" + name; }

/// Rows of a table of the report; fails if it cannot be written.
class Table {
 public:
  Table(const std::string &name, const char *columns)
      : file_(std::fopen((folder + "/" + name).c_str(), "w")) {
    if (!file_) throw std::runtime_error(folder + "/" + name + ": cannot be written");
    std::fprintf(file_, "%s\n", columns);
  }
  ~Table() { std::fclose(file_); }
  Table(const Table &) = delete;
  Table &operator=(const Table &) = delete;
  template <class... T>
  void row(const char *format, T... values) {
    std::fprintf(file_, format, values...);
    std::fflush(file_);
  }

 private:
  std::FILE *file_;
};

/// What one run of lmp printed.
struct Run {
  double seconds = 0.0;                   ///< of the last 'run' command, start and files left out
  std::map<std::string, double> last;     ///< last thermo row
  std::map<std::string, double> printed;  ///< lines "name = number"
};

/// Runs lmp in the folder of the report. \throws std::runtime_error with its line of error.
Run run(const std::string &script, const Variables &variables, int ranks = 1) {
  std::string command = "cd '" + folder + "/work' && ";
  if (ranks > 1) command += mpiexec + " " + std::to_string(ranks) + " ";
  command += "'" + lmp + "' -in '" + script + "' -log none";
  for (const auto &v : variables) command += " -var " + v.first + " '" + v.second + "'";
  command += " > output.txt 2>&1 < /dev/null";
  const int status = std::system(command.c_str());
  std::ifstream in(work("output.txt"));
  Run result;
  std::string error;
  std::vector<std::string> columns;
  for (std::string line; std::getline(in, line);) {
    if (line.find("ERROR") != std::string::npos && error.empty()) error = line;
    std::istringstream split(line);
    const std::vector<std::string> words{std::istream_iterator<std::string>(split), {}};
    if (words.empty()) continue;
    if (words[0] == "Step") {
      columns = words;
    } else if (words[0] == "Loop" && words.size() > 3) {
      result.seconds = std::strtod(words[3].c_str(), nullptr);
      columns.clear();
    } else if (words.size() == 3 && words[1] == "=") {
      result.printed[words[0]] = std::strtod(words[2].c_str(), nullptr);
    } else if (!columns.empty() && words.size() == columns.size()) {
      for (std::size_t n = 0; n < words.size(); ++n)
        result.last[columns[n]] = std::strtod(words[n].c_str(), nullptr);
    }
  }
  if (status != 0) throw std::runtime_error(error.empty() ? command + " failed" : error);
  return result;
}

Run event_run(Variables variables, int ranks = 1) {
  return run(scenes + "/fault_event.in", std::move(variables), ranks);
}

/// Rows of numbers of a dump with one snapshot.
std::vector<std::vector<double>> dumped(const std::string &file) {
  std::ifstream in(work(file));
  std::vector<std::vector<double>> rows;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("ITEM:", 0) == 0) {
      inside = line.rfind("ITEM: ATOMS", 0) == 0 || line.rfind("ITEM: ENTRIES", 0) == 0;
      continue;
    }
    std::istringstream split(line);
    if (inside)
      rows.emplace_back(std::istream_iterator<double>(split), std::istream_iterator<double>());
  }
  if (rows.empty()) throw std::runtime_error(work(file) + ": nothing in it");
  return rows;
}

/// Two columns of a dump with one snapshot, by particle.
std::map<int, std::array<double, 2>> snapshot(const std::string &file) {
  std::map<int, std::array<double, 2>> rows;
  for (const auto &row : dumped(file)) rows[static_cast<int>(row.at(0))] = {row.at(1), row.at(2)};
  return rows;
}

double around(double d) { return d - length * std::round(d / length); }

std::vector<LSM::Event> events_of(const std::string &file) {
  return LSM::read_catalogue(work(file)).events;
}

// ---- one event ----------------------------------------------------------------------------------

struct Variant {
  const char *name;
  double kt, viscosity, at_fault;  ///< at_fault: viscosity of the discs of the fault zone
};

/// A saved state before the first large event, and what to compare.
struct Saved {
  std::string state;
  double time = 0.0, station = 0.0;
};

/// Loads a fault until its first large event; the state lies 6 time units and more before its
/// begin.
Saved prepare(const Variant &v) {
  const std::string prefix = std::string("load_") + v.name;
  event_run({{"kt", text(v.kt)},
             {"viscosity", text(v.viscosity)},
             {"zoneviscosity", text(v.at_fault)},
             {"prefix", prefix},
             {"series", "no"},
             {"every", "512"}});
  for (const auto &e : events_of(prefix + ".csv"))
    if (e.size > 1e-3) {
      // records of the patch then fall on the same times for every time step
      const std::int64_t step = (e.step_start - 200) / 512 * 512;
      Saved saved;
      saved.state = prefix + ".state." + std::to_string(step);
      const double begin = static_cast<double>(step) * 0.03;
      // a multiple of every time step of the sweep
      saved.time = std::ceil((e.t_end + 4.0 - begin) / 0.24) * 0.24;
      saved.station = std::clamp(
          e.x_centroid + 8.0 > length ? e.x_centroid - 8.0 : e.x_centroid + 8.0, 2.0, length - 2.0);
      return saved;
    }
  throw std::runtime_error(prefix + ".csv: no event larger than 1e-3");
}

struct Outcome {
  Run run;
  std::map<int, std::array<double, 2>> begin, end;
  double size = NAN, arrival = NAN;
};

/// When the velocity of the patch has changed by half of its largest change, linear between
/// records.
double arrival_time(const std::string &file) {
  std::ifstream in(work(file));
  std::vector<std::array<double, 2>> change;
  double x0 = NAN, y0 = NAN, most = 0.0;
  for (double t, x, y; in >> t >> x >> y;) {
    if (change.empty()) {
      x0 = x;
      y0 = y;
    }
    change.push_back({t, std::hypot(x - x0, y - y0)});
    most = std::max(most, change.back()[1]);
  }
  for (std::size_t n = 1; n < change.size(); ++n)
    if (change[n][1] >= 0.5 * most) {
      const auto &a = change[n - 1], &b = change[n];
      return a[0] + (b[0] - a[0]) * (0.5 * most - a[1]) / (b[1] - a[1]);
    }
  return NAN;
}

Outcome one_event(const Saved &saved, const Variant &v, const char *onset, const char *treatment,
                  double dt) {
  const double steps = std::round(saved.time / dt);
  Outcome o;
  o.run = event_run({{"resume", "yes"},
                     {"state", saved.state},
                     {"kt", text(v.kt)},
                     {"viscosity", text(v.viscosity)},
                     {"zoneviscosity", text(v.at_fault)},
                     {"onset", onset},
                     {"treatment", treatment},
                     {"dt", text(dt)},
                     {"steps", text(steps)},
                     {"thermo", text(steps)},
                     {"prefix", "one"},
                     {"station", text(saved.station)},
                     {"sample", text(std::round(0.12 / dt))}});
  o.begin = snapshot("one.begin");
  o.end = snapshot("one.end");
  for (const auto &e : events_of("one.csv"))
    o.size = std::isnan(o.size) ? e.size : std::max(o.size, e.size);
  o.arrival = arrival_time("one.station");
  return o;
}

void single_events() {
  Table table(
      "fault_event.csv",
      "variant,kt,viscosity,method,dt,seconds,error_profile,error_size,error_ledger,error_arrival,"
      "viscosity_at_fault");
  const std::vector<Variant> all = {{"standard", 1.0, 0.02, 0.3},
                                    {"even", 1.0, 0.1, 0.1},
                                    {"weak", 1.0, 0.02, 0.02},
                                    {"soft", 0.1, 0.02, 0.3},
                                    {"stiff", 10.0, 0.02, 0.3}};
  for (const Variant &v : all) {
    if (quick && v.name != all[0].name) break;
    const Saved saved = prepare(v);
    const double finest = quick ? 0.06 / 32 : 0.06 / 64;
    const Outcome exact = one_event(saved, v, "located", "split", finest);
    double slip = 0.0;
    for (const auto &[id, x] : exact.end) slip += std::pow(around(x[0] - exact.begin.at(id)[0]), 2);
    table.row(
        "# %s: reference dt %g in %.1f s, time %g, size %.6g, rms displacement at the fault %.4g, "
        "arrival at "
        "x = %.1f after %.4g\n",
        v.name, finest, exact.run.seconds, saved.time, exact.size,
        std::sqrt(slip / static_cast<double>(exact.end.size())), saved.station,
        exact.arrival - exact.run.last.at("Time") + saved.time);
    for (const char *method : {"located", "step", "force"}) {
      const bool force = std::string(method) == "force";
      if (force && v.kt != 1.0) continue;
      for (double dt : {0.06, 0.03, 0.015, 0.0075, 0.00375}) {
        if (v.kt > 1.0 && dt > 0.03) continue;  // above the stability limit
        Outcome o;
        for (int n = 0; n < (dt > 0.01 ? 3 : 1); ++n) {
          Outcome again =
              one_event(saved, v, force ? "located" : method, force ? "force" : "split", dt);
          if (n > 0) again.run.seconds = std::min(again.run.seconds, o.run.seconds);
          o = again;
        }
        double off = 0.0;
        for (const auto &[id, x] : exact.end) off += std::pow(around(x[0] - o.end.at(id)[0]), 2);
        const double ledger =
            force ? NAN : std::fabs(o.run.last.at("c_again[13]")) / o.run.last.at("c_again[10]");
        table.row("%s,%g,%g,%s,%g,%.4g,%.4g,%.4g,%.4g,%.4g,%g\n", v.name, v.kt, v.viscosity, method,
                  dt, o.run.seconds, std::sqrt(off / slip), std::fabs(o.size / exact.size - 1.0),
                  ledger, std::fabs(o.arrival - exact.arrival), v.at_fault);
      }
    }
  }
}

// ---- ways of solving friction -------------------------------------------------------------------

/// The saved state as lmp has it.
Accuracy::Scene small_fault(const Saved &saved, const Variant &v) {
  using Accuracy::Side;
  event_run({{"resume", "yes"},
             {"state", saved.state},
             {"steps", "0"},
             {"listing", "yes"},
             {"prefix", "list"}});
  Accuracy::Scene scene;
  scene.constants = {length, 1.0, v.kt, 0.6, 0.006, 0.001, v.viscosity, v.at_fault};
  for (const auto &row : dumped("list.discs")) {  // by id
    constexpr std::array<Side, 7> side = {Side::block,      Side::block, Side::block,
                                          Side::below,      Side::above, Side::lower_plate,
                                          Side::upper_plate};
    Accuracy::Disc d;
    d.side = side.at(static_cast<std::size_t>(row.at(1)));
    d.r = row.at(2);
    d.m = row.at(3);
    d.x = {row.at(4), row.at(5)};
    d.v = {row.at(6), row.at(7)};
    scene.discs.push_back(d);
  }
  auto index = [](double id) { return static_cast<int>(id) - 1; };
  for (const auto &row : dumped("list.links"))
    scene.links.push_back({index(row.at(0)), index(row.at(1))});
  for (const auto &row : dumped("list.contacts")) {
    Accuracy::Contact c;
    c.i = index(row.at(0));
    c.j = index(row.at(1));
    const auto &i = scene.discs.at(static_cast<std::size_t>(c.i)),
               &j = scene.discs.at(static_cast<std::size_t>(c.j));
    // the elongation is the same seen from either disc
    if (i.side == Side::above) std::swap(c.i, c.j);
    const Accuracy::Vector d =
        scene.discs[static_cast<std::size_t>(c.i)].x - scene.discs[static_cast<std::size_t>(c.j)].x;
    c.before = {around(d.x), d.y};
    c.touches = std::hypot(c.before.x, c.before.y) < i.r + j.r;
    c.xi = row.at(2);
    scene.contacts.push_back(c);
  }
  return scene;
}

struct Small {
  std::vector<Accuracy::Disc> begin, end;
  double size = 0.0, seconds = 0.0;
};

/// Steps through the event; its size is the largest that the picker finds.
template <class Fault>
Small run_small(Fault &fault, double time, double dt) {
  LSM::PickerSettings settings;
  settings.lambda = LSM::lambda_from_memory_time(3.0, dt);
  LSM::EventPicker picker(settings);
  Small result;
  result.begin = fault.discs();
  LSM::Event e;
  picker.push(0, 0.0, fault.pe(), e);
  const auto start = std::chrono::steady_clock::now();
  const auto steps = static_cast<std::int64_t>(std::round(time / dt));
  for (std::int64_t n = 1; n <= steps; ++n) {
    fault.step();
    if (picker.push(n, static_cast<double>(n) * dt, fault.pe(), e))
      result.size = std::max(result.size, e.size);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.end = fault.discs();
  return result;
}

/// Rms distance at the fault between two ends, and of an end from its begin.
double apart(const std::vector<Accuracy::Disc> &a, const std::vector<Accuracy::Disc> &b) {
  double sum = 0.0, discs = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n)
    if (a[n].side == Accuracy::Side::below || a[n].side == Accuracy::Side::above) {
      sum += std::pow(around(a[n].x.x - b[n].x.x), 2);
      discs += 1.0;
    }
  return std::sqrt(sum / discs);
}

void friction_schemes() {
  const Variant v{"standard", 1.0, 0.02, 0.3};
  const Saved saved = prepare(v);
  const Accuracy::Scene state = small_fault(saved, v);
  Table table("fault_friction.csv",
              "scheme,kt,dt,seconds,sweeps_per_step,error_profile,error_size,profile_off_rigid,"
              "size_off_rigid");

  auto spring = [&](double kt, double dt) {
    Accuracy::Scene scene = state;
    scene.constants.kt = kt;
    for (auto &c : scene.contacts) c.xi *= v.kt / kt;  // the same force
    Accuracy::SpringFault fault(std::move(scene), dt);
    return run_small(fault, saved.time, dt);
  };
  double sweeps = 0.0;
  auto rigid = [&](double, double dt) {
    Accuracy::RigidFault fault(state, dt, 1e-12);
    Small s = run_small(fault, saved.time, dt);
    sweeps = fault.sweeps_per_step();
    return s;
  };

  const Small small = spring(v.kt, 0.03);
  const Outcome by_lmp = one_event(saved, v, "located", "split", 0.03);
  double off = 0.0;
  for (const auto &[id, x] : by_lmp.end)
    off += std::pow(around(x[0] - small.end.at(static_cast<std::size_t>(id) - 1).x.x), 2);
  const double finest = quick ? 0.06 / 32 : 0.06 / 64;
  const Small exact_rigid = rigid(0.0, finest);
  const double slip = apart(exact_rigid.end, exact_rigid.begin),
               off_lmp = std::sqrt(off / static_cast<double>(by_lmp.end.size())) / slip;
  table.row(
      "# with the spring and time step 0.03 the small program is off lmp by %.2g of the "
      "displacement "
      "and %.2g of the event size; displacement %.4g (rms at the fault), size without spring "
      "%.6g\n",
      off_lmp, std::fabs(small.size / by_lmp.size - 1.0), slip, exact_rigid.size);
  if (!(off_lmp < 1e-6))
    throw std::runtime_error("friction_schemes.h and lmp do not have the same fault");

  struct Way {
    const char *name;
    double kt, largest;  // time step, below the stability limit
    std::function<Small(double, double)> run;
  };
  for (const Way &w : {Way{"rigid", 0.0, 0.06, rigid}, Way{"spring", 1.0, 0.06, spring},
                       Way{"spring", 10.0, 0.03, spring}, Way{"spring", 100.0, 0.0075, spring}}) {
    if (quick && w.kt > 1.0) break;
    sweeps = 0.0;
    const Small exact = w.run(w.kt, finest);
    for (double dt : {0.06, 0.03, 0.015, 0.0075, 0.00375, finest}) {
      if (dt > w.largest) continue;
      Small s;
      for (int n = 0; n < (dt > 0.01 ? 3 : 1); ++n) {
        Small again = w.run(w.kt, dt);
        if (n > 0) again.seconds = std::min(again.seconds, s.seconds);
        s = std::move(again);
      }
      table.row("%s,%g,%g,%.4g,%.1f,%.4g,%.4g,%.4g,%.4g\n", w.name, w.kt, dt, s.seconds, sweeps,
                apart(s.end, exact.end) / slip, std::fabs(s.size / exact.size - 1.0),
                apart(s.end, exact_rigid.end) / slip, std::fabs(s.size / exact_rigid.size - 1.0));
    }
  }
}

// ---- waves --------------------------------------------------------------------------------------

void waves() {
  Table table("fault_wave.csv", "scene,dt,seconds,speed,error");
  struct Scene {
    const char *file;
    double finest;
  };
  for (const Scene &s :
       {Scene{"p_wave_lattice.in", 0.00625}, Scene{"p_wave_packing.in", 0.00375}}) {
    auto one = [&](double dt) { return run(inputs + "/" + s.file, {{"dt", text(dt)}}); };
    const double exact = one(s.finest).printed.at("p_wave_speed");
    for (double dt = 16 * s.finest; dt > s.finest; dt /= 2) {
      const Run r = one(dt);
      table.row("%s,%g,%.3g,%.8g,%.3g\n", s.file, dt, r.seconds, r.printed.at("p_wave_speed"),
                std::fabs(r.printed.at("p_wave_speed") / exact - 1.0));
    }
  }
}

// ---- long runs ----------------------------------------------------------------------------------

struct Sample {
  std::vector<double> sizes, intervals;
  double seconds = 0.0, duration = 0.0;
  int tiny = 0, brief = 0, large = 0;
};

constexpr double smallest = 1e-5,
                 warmup = 600.0;  // sizes compared; sliding is steady after the warm-up

Sample sample_of(const std::vector<LSM::Event> &events) {
  Sample s;
  double before = NAN;
  for (const auto &e : events) {
    if (e.t_start < warmup) continue;
    if (e.size > 1e-6) {
      ++s.tiny;
      if (e.t_end - e.t_start < 1.5) ++s.brief;
    }
    if (e.size > 1e-3) {
      ++s.large;
      s.duration += e.t_end - e.t_start;
    }
    if (e.size < smallest) continue;
    s.sizes.push_back(e.size);
    if (!std::isnan(before)) s.intervals.push_back(e.t_start - before);
    before = e.t_start;
  }
  s.duration /= s.large;
  return s;
}

Sample long_run(const std::string &prefix, Variables variables, double dt, double time,
                int ranks = 1) {
  const Variables common = {{"prefix", prefix},
                            {"dt", text(dt)},
                            {"every", "0"},
                            {"thermo", "100000"},
                            {"steps", text(std::round(time / dt))},
                            {"settle", text(std::round(360.0 / dt))}};
  variables.insert(variables.end(), common.begin(), common.end());
  const Run r = event_run(variables, ranks);
  Sample s = sample_of(events_of(prefix + ".csv"));
  s.seconds = r.seconds;
  return s;
}

void picker_readings(const std::string &prefix, double at_fault, double dt, Table &table) {
  struct Way {
    LSM::PickerReading reading;
    double memory;  // in time; 0: lambda = 0.99
  };
  using R = LSM::PickerReading;
  for (const Way &w : {Way{R::exponential, 0.0}, Way{R::exponential, 1.0}, Way{R::exponential, 3.0},
                       Way{R::exponential, 10.0}, Way{R::exponential, 30.0}, Way{R::average, 0.0},
                       Way{R::literal, 0.0}}) {
    LSM::PickerSettings settings;
    settings.reading = w.reading;
    settings.lambda = w.memory > 0.0 ? LSM::lambda_from_memory_time(w.memory, dt) : 0.99;
    LSM::EventPicker picker(settings);
    LSM::PeSeriesReader series(work(prefix + ".pe"));
    std::vector<LSM::Event> events;
    std::int64_t step;
    double time, pe;
    for (LSM::Event e; series.next(step, time, pe);)
      if (picker.push(step, time, pe, e)) events.push_back(e);
    const Sample s = sample_of(events);
    table.row("%g,%s,%s,%g,%d,%zu,%d,%.3g\n", at_fault, LSM::to_string(w.reading),
              w.memory > 0.0 ? text(w.memory).c_str() : "lambda_0.99", dt, s.tiny, s.sizes.size(),
              s.large, s.duration);
  }
}

void long_runs() {
  const double time = quick ? 2000.0 : 7000.0;
  Table table("fault_long.csv",
              "onset,viscosity,viscosity_at_fault,dt,ranks,seconds,events,mean_size,mean_error,"
              "star,star_error,alpha,"
              "alpha_error,ks_size,p_size,ks_interval,p_interval");
  table.row(
      "# length 60, width 20, velocity 0.001, time %g; events of size %g and more after the first "
      "%g of "
      "time; exponent from 1e-5 to 1e-2; KS against the first row of the same viscosity\n",
      time, smallest, warmup);
  Table pickers("fault_picker.csv",
                "viscosity_at_fault,reading,memory,dt,events_1e-6,events_1e-5,events_1e-3,mean_"
                "duration_1e-3");
  struct Way {
    const char *onset;
    double viscosity, at_fault, dt;
    int ranks;
  };
  std::vector<Way> ways = {{"located", 0.1, 0.1, 0.03, 1},
                           {"located", 0.1, 0.1, 0.03, 2},
                           {"located", 0.1, 0.1, 0.06, 1},
                           {"located", 0.02, 0.3, 0.03, 1},
                           {"located", 0.02, 0.3, 0.06, 1}};
  if (!quick)
    ways = {{"located", 0.1, 0.1, 0.03, 1},   {"located", 0.1, 0.1, 0.03, 2},
            {"located", 0.1, 0.1, 0.03, 4},   {"located", 0.1, 0.1, 0.015, 1},
            {"located", 0.1, 0.1, 0.045, 1},  {"located", 0.1, 0.1, 0.06, 1},
            {"step", 0.1, 0.1, 0.03, 1},      {"step", 0.1, 0.1, 0.06, 1},
            {"located", 0.02, 0.3, 0.03, 1},  {"located", 0.02, 0.3, 0.03, 2},
            {"located", 0.02, 0.3, 0.015, 1}, {"located", 0.02, 0.3, 0.045, 1},
            {"located", 0.02, 0.3, 0.06, 1}};
  double first_viscosity = NAN;
  Sample first;
  for (const Way &w : ways) {
    const Sample s = long_run(
        "long",
        {{"onset", w.onset}, {"viscosity", text(w.viscosity)}, {"zoneviscosity", text(w.at_fault)}},
        w.dt, time, w.ranks);
    if (w.viscosity != first_viscosity) first = s;
    first_viscosity = w.viscosity;
    const auto mean = Accuracy::mean(s.sizes), star = Accuracy::characteristic_size(s.sizes),
               alpha = Accuracy::exponent(s.sizes, 1e-5, 1e-2);
    const auto ks = Accuracy::two_sample(first.sizes, s.sizes),
               wait = Accuracy::two_sample(first.intervals, s.intervals);
    table.row("%s,%g,%g,%g,%d,%.3g,%zu,%.4g,%.2g,%.4g,%.2g,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f\n",
              w.onset, w.viscosity, w.at_fault, w.dt, w.ranks, s.seconds, s.sizes.size(),
              mean.value, mean.error, star.value, star.error, alpha.value, alpha.error, ks.distance,
              ks.p, wait.distance, wait.p);
    if (w.ranks == 1 && std::string(w.onset) == "located")
      picker_readings("long", w.at_fault, w.dt, pickers);
  }
}

// ---- what rings ---------------------------------------------------------------------------------

/// Largest release of PE per time over 5 time units, mean of the six largest stretches 60 and more
/// apart.
double release_rate(const std::string &prefix) {
  LSM::PeSeriesReader series(work(prefix + ".pe"));
  const double dt = series.info().dt;
  std::vector<double> pe;
  std::int64_t step;
  double time, value;
  while (series.next(step, time, value))
    if (time >= warmup) pe.push_back(value);
  const auto span = static_cast<std::size_t>(5.0 / dt), far = static_cast<std::size_t>(60.0 / dt);
  std::vector<std::pair<double, std::size_t>> drops;
  for (std::size_t n = 0; n + span < pe.size(); n += span / 4)
    drops.emplace_back((pe[n] - pe[n + span]) / 5.0, n);
  std::sort(drops.rbegin(), drops.rend());
  std::vector<std::size_t> taken;
  double sum = 0.0;
  for (const auto &[rate, at] : drops) {
    if (taken.size() == 6) break;
    bool free = true;
    for (std::size_t other : taken) free = free && (at > other ? at - other : other - at) >= far;
    if (!free) continue;
    taken.push_back(at);
    sum += rate;
  }
  return sum / static_cast<double>(taken.size());
}

void ringing() {
  const double time = quick ? 1500.0 : 3000.0;
  Table table("fault_ringing.csv",
              "kt,viscosity,viscosity_at_fault,seconds,events_1e-6,brief,events_1e-5,events_1e-3,"
              "mean_duration_1e-3,"
              "release_rate");
  table.row(
      "# length 60, width 20, velocity 0.001, time %g; events after the first %g of time; brief: "
      "above 1e-6 and "
      "shorter than 1.5; release_rate: fastest fall of PE over 5 time units, mean of the six "
      "fastest\n",
      time, warmup);
  auto one = [&](double kt, double viscosity, double at_fault) {
    const Sample s = long_run(
        "ring",
        {{"kt", text(kt)}, {"viscosity", text(viscosity)}, {"zoneviscosity", text(at_fault)}}, 0.03,
        time);
    table.row("%g,%g,%g,%.3g,%d,%d,%zu,%d,%.3g,%.3g\n", kt, viscosity, at_fault, s.seconds, s.tiny,
              s.brief, s.sizes.size(), s.large, s.duration, release_rate("ring"));
  };
  for (double kt : {0.1, 1.0, 3.0})
    for (double viscosity : {0.02, 0.05, 0.1})
      if (!quick || (kt == 1.0 && viscosity != 0.05)) one(kt, viscosity, viscosity);
  for (double at_fault : {0.1, 0.2, 0.3, 0.5, 1.0})
    if (!quick || at_fault == 0.3) one(1.0, 0.02, at_fault);

  // the discs that move most, averaged over a while
  event_run({{"viscosity", "0.02"},
             {"prefix", "lively"},
             {"steps", "34000"},
             {"lively", "0"},
             {"every", "33000"},
             {"series", "no"}});
  // the state was written at the first multiple of 'every' after the compression
  event_run({{"viscosity", "0.02"},
             {"prefix", "lively"},
             {"resume", "yes"},
             {"state", "lively.state.33000"},
             {"steps", "8000"},
             {"lively", "2"},
             {"series", "no"}});
  std::ifstream in(work("lively.lively"));
  struct Disc {
    double radius = 0.0, energy = 0.0, before = 0.0, turns = 0.0, records = 0.0, apart = 0.0,
           losses = 0.0;
    bool touched = false;
  };
  std::map<int, Disc> discs;
  double total = 0.0;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("ITEM:", 0) == 0) {
      inside = line.rfind("ITEM: ATOMS", 0) == 0;
      continue;
    }
    std::istringstream split(line);
    int id;
    int type;
    double radius, vx, vy, on_above, on_below;
    if (!inside || !(split >> id >> radius >> vx >> vy >> type >> on_above >> on_below)) continue;
    Disc &d = discs[id];
    d.radius = radius;
    const double e = 0.5 * radius * radius * (vx * vx + vy * vy);
    d.energy += e;
    total += e;
    if (d.before * vy < 0.0) d.turns += 1.0;
    d.before = vy;
    d.records += 1.0;
    const bool touches = (type == 3 ? on_above : on_below) > 0.0;
    if (!touches) d.apart += 1.0;
    if (d.touched && !touches) d.losses += 1.0;
    d.touched = touches;
  }
  std::vector<std::pair<double, int>> order;
  for (const auto &[id, d] : discs) order.emplace_back(-d.energy, id);
  std::sort(order.begin(), order.end());
  Table lively("fault_lively.csv",
               "disc,radius,share_of_kinetic_energy_at_fault,period,rms_speed,time_without_contact,"
               "contacts_lost_per_period");
  for (std::size_t n = 0; n < 8 && n < order.size(); ++n) {
    const Disc &d = discs[order[n].second];
    lively.row("%d,%.4g,%.3f,%.3g,%.3g,%.2f,%.2f\n", order[n].second, d.radius, d.energy / total,
               2.0 * d.records * 0.06 / d.turns, std::sqrt(2.0 * d.energy / d.records) / d.radius,
               d.apart / d.records, d.losses / (0.5 * d.turns));
  }
}

// ---- sums ---------------------------------------------------------------------------------------

/// Numbers in the last column of all snapshots of a local dump.
std::vector<std::vector<double>> local_dump(const std::string &file) {
  std::ifstream in(work(file));
  std::vector<std::vector<double>> all;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("ITEM:", 0) == 0) {
      inside = line.rfind("ITEM: ENTRIES", 0) == 0;
      if (inside) all.emplace_back();
      continue;
    }
    if (inside) all.back().push_back(std::strtod(line.c_str(), nullptr));
  }
  return all;
}

void sums() {
  const std::string fault = quick ? "240" : "1890";
  std::ofstream(work("sums.in")) << R"(units lj
dimension 2
boundary p f p
newton off
atom_style hybrid bond sphere
atom_modify map array
special_bonds lj/coul 0 1 1
create_lsm_fault length )" << fault
                                 << R"( width 30 seed 1
comm_modify mode single cutoff 3.6
neighbor 0.4 bin
group lower type 5
group upper type 6
group plates union lower upper
group blocks subtract all plates
bond_style lsm/linked
bond_coeff 1 1.0
pair_style lsm/friction
pair_coeff * * off
pair_coeff 3 4 1.0 1.0 0.6
timestep 0.03
fix move blocks lsm/nve viscosity 0.1
fix plates all lsm/plates lower upper stress 0.006 damping 0.1 velocity 0.00025
compute events all lsm/events
compute link all bond/local engpot
if "${write} == yes" then "dump link all local 100 sums.link c_link" "dump_modify link format float %.17g"
thermo_style custom step c_events[6]
thermo_modify norm no format float %.17g
thermo 100
run 300
)";
  Table table("precision.csv",
              "links,ranks,steps,pe_links,relative_error,change_over_100_steps,error_of_change");
  const std::string exact_file = "sums.link";
  for (int ranks : {1, 2, 4}) {
    // each number of ranks against the long double sum of its own energies
    run("sums.in", {{"write", "yes"}}, ranks);
    const auto energies = local_dump(exact_file);
    std::ifstream in(work("output.txt"));
    std::vector<double> printed;
    bool table_of_thermo = false;
    for (std::string line; std::getline(in, line);) {
      std::istringstream split(line);
      const std::vector<std::string> words{std::istream_iterator<std::string>(split), {}};
      if (words.size() == 2 && words[0] == "Step") {
        table_of_thermo = true;
      } else if (!words.empty() && words[0] == "Loop") {
        table_of_thermo = false;
      } else if (table_of_thermo && words.size() == 2) {
        printed.push_back(std::strtod(words[1].c_str(), nullptr));
      }
    }
    if (printed.size() != energies.size())
      throw std::runtime_error("sums.in: snapshots and thermo rows differ");
    long double before = 0.0L;
    for (std::size_t n = 0; n < energies.size(); ++n) {
      long double sum = 0.0L;
      for (double e : energies[n]) sum += e;
      if (n > 0)
        table.row("%zu,%d,%zu,%.17g,%.3g,%.4g,%.3g\n", energies[n].size(), ranks, 100 * n,
                  printed[n], static_cast<double>((printed[n] - sum) / sum),
                  static_cast<double>(sum - before),
                  static_cast<double>((printed[n] - printed[n - 1]) - (sum - before)));
      before = sum;
    }
  }

  // A series disturbed by far more than that gives the same catalogue.
  Table disturbed("precision_picker.csv",
                  "disturbance_relative_to_pe,events,same_begin_and_end,largest_change_of_size");
  auto pick = [&](double relative) {
    LSM::PickerSettings settings;
    settings.lambda = LSM::lambda_from_memory_time(3.0, 0.03);
    settings.min_size = 1e-9;
    LSM::EventPicker picker(settings);
    LSM::PeSeriesReader series(work("ring_series.pe"));
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-relative, relative);
    std::vector<LSM::Event> events;
    std::int64_t step;
    double time, pe;
    for (LSM::Event e; series.next(step, time, pe);)
      if (picker.push(step, time, pe * (1.0 + (relative > 0.0 ? uniform(random) : 0.0)), e))
        events.push_back(e);
    return events;
  };
  event_run({{"prefix", "ring_series"}, {"every", "0"}, {"steps", quick ? "40000" : "100000"}});
  const auto exact = pick(0.0);
  for (double relative : {1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-10}) {
    const auto other = pick(relative);
    std::size_t same = 0;
    double change = 0.0;
    for (std::size_t n = 0; n < std::min(exact.size(), other.size()); ++n)
      if (exact[n].step_start == other[n].step_start && exact[n].step_end == other[n].step_end) {
        ++same;
        change = std::max(change, std::fabs(exact[n].size - other[n].size));
      }
    disturbed.row("%g,%zu,%zu of %zu,%.3g\n", relative, other.size(), same, exact.size(), change);
  }
}

}  // namespace

int main(int argc, char **argv) {
  if (argc < 7 || (std::string(argv[2]) != "full" && std::string(argv[2]) != "quick")) {
    std::fprintf(stderr,
                 "usage: lsm_accuracy_fault FOLDER full|quick LMP INPUTS SCENES MPIEXEC...\n");
    return 2;
  }
  folder = argv[1];
  quick = std::string(argv[2]) == "quick";
  lmp = argv[3];
  inputs = argv[4];
  scenes = argv[5];
  for (int n = 6; n < argc; ++n) mpiexec += std::string(n > 6 ? " " : "") + argv[n];
  try {
    const std::vector<std::pair<const char *, std::function<void()>>> parts = {
        {"single events", single_events}, {"friction", friction_schemes}, {"waves", waves},
        {"long runs", long_runs},         {"ringing", ringing},           {"sums", sums}};
    for (const auto &[name, part] : parts) {
      const auto start = std::chrono::steady_clock::now();
      part();
      std::printf("%s: %.0f s\n", name,
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      std::fflush(stdout);
    }
  } catch (const std::exception &e) {
    std::fprintf(stderr, "lsm_accuracy_fault: %s\n", e.what());
    return 1;
  }
  return 0;
}
