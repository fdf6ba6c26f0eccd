// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice solid fault: error against run time of one event and of waves; the size above which the
// catalogue of long runs depends neither on the time step nor on the number of ranks; loose discs;
// picker readings; summation errors. Runs lmp and writes tables fault_*.csv.
// In C++, as friction is solved in other ways over millions of steps (friction_schemes.h), sums are
// compared with those in long double, and statistics are shared with the block-slider's.
// Usage: lsm_accuracy_fault FOLDER full|quick LMP INPUTS SCENES MPIEXEC...
// LSM_ACCURACY_PARTS: names of the parts to run, separated by commas; long runs that were completed
// in FOLDER/work with the same command are not repeated then.
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "event_statistics.h"
#include "friction_schemes.h"
#include "events/event_filter.h"
#include "events/event_picker.h"
#include "files/pe_series.h"
#include "numerics/sum.h"
#include "read_catalogue.h"

namespace {

using Variables = std::vector<std::pair<std::string, std::string>>;

std::string folder, lmp, inputs, scenes, mpiexec;
bool quick = false;

// The same values as in fault_event.in and fault.in.
constexpr double length = 60.0, width = 30.0, stress = 0.02, velocity = 0.00025, memory = 0.5,
                 impedance = 0.6, compression = 1200.0;

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.12g", value);
  return buffer;
}
std::string work(const std::string &name) { return folder + "/work/" + name; }

/// Writes the rows of a table of the report; throws if it cannot be written.
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

/// Output of one run of lmp.
struct Run {
  double seconds = 0.0;                ///< CPU time of the last 'run' command on one rank
  double cpu = 0.0;                    ///< CPU time of the whole run on all ranks, if it has a name
  std::map<std::string, double> last;  ///< last thermo row
  std::vector<double> second;          ///< second column of all thermo rows
  std::map<std::string, double> printed;  ///< lines "name = number"
};

/// Runs lmp in the folder of the report.
/// \param name if given, the output is in NAME.out and the command in NAME.command, and a run that
/// was completed with the same command is not repeated
/// \throws std::runtime_error with the error line of lmp
Run run(const std::string &script, const Variables &variables, int ranks = 1,
        const std::string &name = "") {
  std::string command;
  if (ranks > 1) command += mpiexec + " " + std::to_string(ranks) + " ";
  command += "'" + lmp + "' -in '" + script + "' -log none";
  for (const auto &v : variables) command += " -var " + v.first + " '" + v.second + "'";
  const std::string output = name.empty() ? "output.txt" : name + ".out",
                    mark = work(name + ".command");
  std::string done;
  if (!name.empty()) std::getline(std::ifstream(mark) >> std::ws, done);
  int status = 0;
  if (done.empty() || done != command) {
    const std::string all = command + " > " + output + " 2>&1 < /dev/null",
                      there = "cd '" + folder + "/work' && ";
    if (name.empty()) {
      status = std::system((there + all).c_str());
    } else {
      std::ofstream(work(name + ".sh")) << all << '\n';
      status = std::system(
          (there + "TIMEFORMAT='%U %S' bash -c 'time bash " + name + ".sh' 2> " + name + ".cpu")
              .c_str());
    }
    if (!name.empty() && status == 0) std::ofstream(mark) << command << '\n';
  }
  std::ifstream in(work(output));
  Run result;
  if (!name.empty()) {
    double user = 0.0, system = 0.0;
    std::ifstream(work(name + ".cpu")) >> user >> system;
    result.cpu = user + system;
  }
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
    } else if (words.size() > 2 && words[1] == "CPU" && words[2] == "use") {
      result.seconds *= 0.01 * std::strtod(words[0].c_str(), nullptr);
    } else if (words.size() == 3 && words[1] == "=") {
      result.printed[words[0]] = std::strtod(words[2].c_str(), nullptr);
    } else if (!columns.empty() && words.size() == columns.size()) {
      for (std::size_t n = 0; n < words.size(); ++n)
        result.last[columns[n]] = std::strtod(words[n].c_str(), nullptr);
      if (words.size() > 1) result.second.push_back(result.last[columns[1]]);
    }
  }
  if (status != 0) throw std::runtime_error(error.empty() ? command + " failed" : error);
  return result;
}

Run event_run(Variables variables, int ranks = 1) {
  return run(scenes + "/fault_event.in", std::move(variables), ranks);
}

using Rows = std::vector<std::vector<double>>;

/// Rows of numbers of a dump, by snapshot.
std::vector<Rows> all_dumped(const std::string &file) {
  std::ifstream in(work(file));
  std::vector<Rows> all;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("ITEM:", 0) == 0) {
      inside = line.rfind("ITEM: ATOMS", 0) == 0 || line.rfind("ITEM: ENTRIES", 0) == 0;
      if (inside) all.emplace_back();
      continue;
    }
    std::istringstream split(line);
    if (inside)
      all.back().emplace_back(std::istream_iterator<double>(split),
                              std::istream_iterator<double>());
  }
  if (all.empty() || all.front().empty()) throw std::runtime_error(work(file) + ": nothing in it");
  return all;
}
Rows dumped(const std::string &file) { return all_dumped(file).front(); }

/// Two columns of a dump with one snapshot, by particle.
std::map<int, std::array<double, 2>> snapshot(const std::string &file) {
  std::map<int, std::array<double, 2>> rows;
  for (const auto &row : dumped(file)) rows[static_cast<int>(row.at(0))] = {row.at(1), row.at(2)};
  return rows;
}

double around(double d) { return d - length * std::round(d / length); }

std::vector<LSM::Event> events_of(const std::string &file) {
  return unit::read_catalogue(work(file)).events;
}

// ---- one event ----------------------------------------------------------------------------------

struct Variant {
  const char *name;
  double kt, viscosity;
};
constexpr Variant standard = {"standard", 1.0, 0.015};

/// A saved state before the first large event, and the quantities to compare.
struct Saved {
  std::string state;
  double time = 0.0, station = 0.0, duration = 0.0;
};

/// Loads a fault until its first event of 0.01 or more; the state is at least 6 time units before
/// its start.
Saved prepare(const Variant &v) {
  static std::map<std::string, Saved> known;
  if (known.count(v.name)) return known[v.name];
  const std::string prefix = std::string("load_") + v.name;
  const double large = 1e-2, dt = 0.03;
  // States are saved rarely at first, then often from the last of these on.
  const std::int64_t seldom = 8192, often = 512;
  Variables variables = {{"kt", text(v.kt)},
                         {"viscosity", text(v.viscosity)},
                         {"dt", text(dt)},
                         {"prefix", prefix},
                         {"series", "no"}};
  auto with = [&](const Variables &more) {
    Variables all = variables;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  event_run(with({{"every", text(seldom)}, {"steps", "400000"}, {"enough", text(large)}}));
  for (const auto &e : events_of(prefix + ".csv"))
    if (e.size >= large) {
      // With this, the records of the patch are at the same times for every time step.
      const std::int64_t step = (e.step_start - 200) / often * often,
                         before = step / seldom * seldom;
      if (step > before)
        event_run(with({{"resume", "yes"},
                        {"state", prefix + ".state." + std::to_string(before)},
                        {"every", text(often)},
                        {"steps", text(static_cast<double>(step - before))}}));
      Saved saved;
      saved.state = prefix + ".state." + std::to_string(step);
      const double begin = static_cast<double>(step) * dt;
      // a multiple of every time step of the sweep
      saved.time = std::ceil((e.t_end + 4.0 - begin) / 0.24) * 0.24;
      saved.station = std::clamp(
          e.x_centroid + 8.0 > length ? e.x_centroid - 8.0 : e.x_centroid + 8.0, 2.0, length - 2.0);
      saved.duration = e.t_end - e.t_start;
      return known[v.name] = saved;
    }
  throw std::runtime_error(prefix + ".csv: no event of 0.01 or more");
}

struct Outcome {
  Run run;
  std::map<int, std::array<double, 2>> begin, end;
  double size = NAN, arrival = NAN;
};

/// Time at which the velocity of the patch has changed by half of its largest change, interpolated
/// linearly between records.
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
                  double dt, double mass_floor = 0.0) {
  const double steps = std::round(saved.time / dt);
  Outcome o;
  o.run = event_run({{"resume", "yes"},
                     {"state", saved.state},
                     {"kt", text(v.kt)},
                     {"viscosity", text(v.viscosity)},
                     {"onset", onset},
                     {"treatment", treatment},
                     {"dt", text(dt)},
                     {"massfloor", text(mass_floor)},
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
      "variant,kt,viscosity,method,dt,seconds,error_profile,error_size,error_ledger,error_arrival");
  const std::vector<Variant> all = {standard,
                                    {"damped", 1.0, 0.05},
                                    {"light", 1.0, 0.005},
                                    {"soft", 0.1, 0.015},
                                    {"stiff", 10.0, 0.015}};
  for (const Variant &v : all) {
    if (quick && v.name != standard.name) break;
    Saved saved = prepare(v);
    const double finest = quick ? 0.06 / 32 : 0.06 / 64;
    Outcome exact = one_event(saved, v, "located", "split", finest);
    auto slip_of = [](const Outcome &o) {
      double slip = 0.0;
      for (const auto &[id, x] : o.end) slip += std::pow(around(x[0] - o.begin.at(id)[0]), 2);
      return slip;
    };
    double slip = slip_of(exact);
    table.row(
        "# %s: reference dt %g in %.1f s, time %g, size %.6g, duration %.3g, rms displacement at "
        "the fault %.4g, arrival at x = %.1f after %.4g\n",
        v.name, finest, exact.run.seconds, saved.time, exact.size, saved.duration,
        std::sqrt(slip / static_cast<double>(exact.end.size())), saved.station,
        exact.arrival - exact.run.last.at("Time") + saved.time);
    auto sweep = [&](const std::string &method, const char *onset, const char *treatment,
                     const std::vector<double> &time_steps, double mass_floor = 0.0) {
      for (double dt : time_steps) {
        if (v.kt > 1.0 && dt > 0.03) continue;  // above the stability limit
        Outcome o;
        for (int n = 0; n < (dt > 0.01 ? 3 : 1); ++n) {
          Outcome again = one_event(saved, v, onset, treatment, dt, mass_floor);
          if (n > 0) again.run.seconds = std::min(again.run.seconds, o.run.seconds);
          o = again;
        }
        double off = 0.0;
        for (const auto &[id, x] : exact.end) off += std::pow(around(x[0] - o.end.at(id)[0]), 2);
        const double ledger = method == "force" ? NAN
                                                : std::fabs(o.run.last.at("c_again[13]")) /
                                                      o.run.last.at("c_again[10]");
        table.row("%s,%g,%g,%s,%g,%.4g,%.4g,%.4g,%.4g,%.4g\n", v.name, v.kt, v.viscosity,
                  method.c_str(), dt, o.run.seconds, std::sqrt(off / slip),
                  std::fabs(o.size / exact.size - 1.0), ledger,
                  std::fabs(o.arrival - exact.arrival));
      }
    };
    const std::vector<double> time_steps = {0.06, 0.03, 0.015, 0.0075, 0.00375};
    sweep("located", "located", "split", time_steps);
    sweep("step", "step", "split", time_steps);
    if (v.name != standard.name) continue;
    sweep("force", "located", "force", time_steps);  // several times the run time
    // Effect of the preset for statistics on one event, which is recorded for longer, as larger
    // masses delay it.
    saved.time += 24.0;
    exact = one_event(saved, v, "located", "split", finest);
    slip = slip_of(exact);
    table.row("# floor: up to time %g, rms displacement at the fault %.4g\n", saved.time,
              std::sqrt(slip / static_cast<double>(exact.end.size())));
    sweep("floor 0.04", "located", "split", {0.12, 0.06, 0.03, 0.015}, 0.04);
    sweep("floor 0.09", "located", "split", {0.12, 0.06, 0.03, 0.015}, 0.09);
  }
}

// ---- ways of solving friction -------------------------------------------------------------------

/// Reads the state that lmp has saved.
Accuracy::Scene small_fault(const Saved &saved, const Variant &v) {
  using Accuracy::Side;
  event_run({{"resume", "yes"},
             {"state", saved.state},
             {"steps", "0"},
             {"listing", "yes"},
             {"prefix", "list"}});
  Accuracy::Scene scene;
  scene.constants = {length, 1.0, v.kt, 0.6, stress, velocity, v.viscosity, impedance};
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
    // The elongation is the same for either order of the discs.
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

/// Computes the event step by step; its size is the largest that the picker finds.
template <class Fault>
Small run_small(Fault &fault, double time, double dt) {
  LSM::PickerSettings settings;
  settings.lambda = LSM::lambda_from_memory_time(memory, dt);
  LSM::EventPicker picker(settings);
  Small result;
  result.begin = fault.discs();
  LSM::Event e;
  picker.push(0, 0.0, fault.pe(), e);
  const std::clock_t start = std::clock();
  const auto steps = static_cast<std::int64_t>(std::round(time / dt));
  for (std::int64_t n = 1; n <= steps; ++n) {
    fault.step();
    if (picker.push(n, static_cast<double>(n) * dt, fault.pe(), e))
      result.size = std::max(result.size, e.size);
  }
  result.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  result.end = fault.discs();
  return result;
}

/// Rms distance of the discs at the fault between two states.
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
  const Variant v = standard;
  Saved saved = prepare(v);
  saved.time += 12.0;  // the rupture comes later with other laws
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
  const double finest = 0.06 / 32;
  const Small exact_rigid = rigid(0.0, finest);
  const double sweeps_rigid = sweeps;
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
                       Way{"spring", 10.0, 0.03, spring}}) {
    if (quick && w.kt > 1.0) break;
    const bool is_rigid = w.kt == 0.0;
    sweeps = is_rigid ? sweeps_rigid : 0.0;
    const Small exact = is_rigid ? exact_rigid : w.run(w.kt, finest);
    auto row = [&](double dt, const Small &s) {
      table.row("%s,%g,%g,%.4g,%.1f,%.4g,%.4g,%.4g,%.4g\n", w.name, w.kt, dt, s.seconds, sweeps,
                apart(s.end, exact.end) / slip, std::fabs(s.size / exact.size - 1.0),
                apart(s.end, exact_rigid.end) / slip, std::fabs(s.size / exact_rigid.size - 1.0));
    };
    row(finest, exact);
    for (double dt : {0.00375, 0.0075, 0.015, 0.03, 0.06}) {
      if (dt > w.largest) continue;
      Small s;
      for (int n = 0; n < (dt > 0.01 ? 3 : 1); ++n) {
        Small again = w.run(w.kt, dt);
        if (n > 0) again.seconds = std::min(again.seconds, s.seconds);
        s = std::move(again);
      }
      row(dt, s);
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

constexpr double warmup = 3000.0;   // time of shear after which the stress has reached its level
constexpr double near_start = 5.0;  // largest time between the starts of an event in two runs
const std::vector<double> thresholds = {1e-5, 1e-4, 3e-4, 1e-3, 1e-2};

/// A run of inputs/fault.in.
struct LongRun {
  const char *loose;
  double dt;
  int ranks;
  bool series;
  double mass_floor = 0.0;  ///< smaller masses are raised to this
  double time = 0.0;
  double seconds = 0.0;                 ///< CPU time of all ranks
  std::vector<LSM::Event> events = {};  ///< after the warm-up
  std::string prefix() const {
    return std::string("long_") + loose + "_" + text(dt) + "_" + std::to_string(ranks);
  }
};

void start(LongRun &w) {
  const Variables variables = {{"length", text(length)},
                               {"memory", text(memory)},
                               {"massstep", "0"},
                               {"prefix", w.prefix()},
                               {"loose", w.loose},
                               {"dt", text(w.dt)},
                               {"massfloor", text(w.mass_floor)},
                               {"settle", text(std::round(compression / w.dt))},
                               {"steps", text(std::round(w.time / w.dt))},
                               {"checkpoint", "1000000000"},
                               {"overwrite", "yes"},
                               {"thermo", "100000"},
                               {"series", w.series ? "yes" : "no"}};
  w.seconds = run(inputs + "/fault.in", variables, w.ranks, w.prefix()).cpu;
  w.events = events_of(w.prefix() + ".catalogue.csv");
  w.events.erase(
      std::remove_if(w.events.begin(), w.events.end(),
                     [](const LSM::Event &e) { return e.t_start < compression + warmup; }),
      w.events.end());
}

/// Statistics of the events of a catalogue from a threshold on.
struct Sample {
  std::vector<double> starts, sizes, intervals;
  Accuracy::Estimate count, exponent;
  double dispersion =
      NAN;  ///< variance / mean of counts in 30 equal stretches; 1 for a Poisson process
  Accuracy::GammaDensity times;
  int brief = 0;  ///< number of events shorter than the memory of the picker
};

/// \param shortest shortest duration (time units) of events that count
Sample sample_of(const LongRun &w, double threshold, double shortest = 0.0) {
  Sample s;
  constexpr int stretches = 30;
  std::array<double, stretches> counts{};
  const double span = (w.time - warmup) / stretches;
  double before = NAN;
  for (const auto &e : w.events) {
    const double duration = e.t_end - e.t_start;
    if (e.size < threshold || duration < shortest) continue;
    if (duration < memory) ++s.brief;
    s.starts.push_back(e.t_start);
    s.sizes.push_back(e.size);
    if (!std::isnan(before)) s.intervals.push_back(e.t_start - before);
    before = e.t_start;
    const double at = (e.t_start - compression - warmup) / span;
    counts.at(std::min(static_cast<std::size_t>(at), counts.size() - 1)) += 1.0;
  }
  const double n = static_cast<double>(s.sizes.size()), mean = n / stretches;
  double squares = 0.0;
  for (double c : counts) squares += (c - mean) * (c - mean);
  s.dispersion = squares / (stretches - 1) / mean;
  s.count = {n, std::sqrt(n)};
  s.exponent = Accuracy::exponent(s.sizes, threshold, threshold < 1e-2 ? 1e-1 : 1.0);
  s.times = Accuracy::gamma_density(s.intervals);
  return s;
}

/// The smallest p of several tests, times their number.
class LeastOf {
 public:
  void add(double p) {
    least_ = std::min(least_, p);
    ++n_;
  }
  double value() const { return std::min(1.0, least_ * n_); }

 private:
  double least_ = 1.0;
  int n_ = 0;
};

/// Compares runs that differ only in time step and ranks, the finest first: one row of a table for
/// each run and threshold.
void compare(const std::vector<const LongRun *> &runs, Table &table) {
  for (const double threshold : thresholds) {
    const Sample finest = sample_of(*runs.front(), threshold);
    for (const LongRun *w : runs) {
      const Sample s = sample_of(*w, threshold);
      const auto pairs = Accuracy::paired(finest.starts, s.starts, near_start);
      table.row(
          "%s,%g,%d,%g,%.0f,%.1f,%.2f,%.3f,%d,%d,%d,%d,%.3f,%.3f,%.3f,%.3f,%.1f,%.1f,%.3f,%.3f\n",
          w->loose, w->dt, w->ranks, threshold, s.count.value, s.count.error, s.dispersion,
          s.count.value / finest.count.value, pairs.both, pairs.only_first, pairs.only_second,
          s.brief, s.exponent.value, s.exponent.error, s.times.gamma.value, s.times.gamma.error,
          s.times.b.value, s.times.b.error, Accuracy::two_sample(finest.sizes, s.sizes).p,
          Accuracy::two_sample(finest.intervals, s.intervals).p);
    }
  }
}

/// Determines the size above which these runs agree.
void judge(const std::vector<const LongRun *> &runs, double up_to, double shortest,
           Table &verdicts) {
  constexpr std::size_t least_events = 30;
  double from = NAN;  // the smallest threshold above all those at which the runs differ
  bool any_depends = false;
  const char *loose = runs.front()->loose;
  for (const double threshold : thresholds) {
    std::vector<double> dt;
    std::vector<Accuracy::Estimate> count, exponent, gamma, scale;
    const Sample finest = sample_of(*runs.front(), threshold, shortest);
    LeastOf size, interval, pairs, all;
    bool enough = true;
    for (const LongRun *w : runs) {
      const Sample s = sample_of(*w, threshold, shortest);
      enough = enough && s.sizes.size() >= least_events;
      dt.push_back(w->dt);
      // Events are clustered: the error of a count is at least that from the counts in stretches.
      count.push_back(
          {std::log(s.count.value), std::sqrt(std::max(1.0, s.dispersion) / s.count.value)});
      exponent.push_back(s.exponent);
      gamma.push_back(s.times.gamma);
      scale.push_back(s.times.b);
      if (w == runs.front()) continue;
      pairs.add(Accuracy::paired(finest.starts, s.starts, near_start).p());
      size.add(Accuracy::two_sample(finest.sizes, s.sizes).p);
      interval.add(Accuracy::two_sample(finest.intervals, s.intervals).p);
    }
    std::vector<double> p;
    for (const auto *estimates : {&count, &exponent, &gamma, &scale}) {
      LeastOf least;
      const auto a = Accuracy::agreement(dt, *estimates);
      least.add(a.p_same);
      least.add(a.p_trend);
      p.push_back(least.value());
    }
    for (const LeastOf &least : {size, interval, pairs}) p.push_back(least.value());
    for (double value : p) all.add(value);
    const bool depends = all.value() < 0.05;
    verdicts.row("%s,%g,%g,%g,%.3g,%.3g,%.3g,%.3g,%.3g,%.3g,%.3g,%s\n", loose, up_to, shortest,
                 threshold, p[0], p[1], p[2], p[3], p[4], p[5], p[6],
                 !enough   ? "too few events"
                 : depends ? "yes"
                           : "no");
    if (!enough) continue;
    any_depends = any_depends || depends;
    if (depends)
      from = NAN;
    else if (std::isnan(from))
      from = threshold;
  }
  const std::string which =
      shortest > 0.0 ? "events not shorter than the memory of the picker" : "all events";
  std::string verdict = "too few to tell";
  if (!std::isnan(from))
    verdict = "from size " + text(from) + " on nothing is seen to depend on it";
  else if (any_depends)
    verdict = "they depend on it up to the largest size looked at";
  verdicts.row("# loose discs %s, time steps up to %g, %s: %s\n", loose, up_to, which.c_str(),
               verdict.c_str());
}

void picker_readings(const LongRun &w, Table &table) {
  struct Way {
    LSM::PickerReading reading;
    double memory;  // in time; 0: lambda = 0.99
  };
  using R = LSM::PickerReading;
  for (const Way &way : {Way{R::exponential, 0.0}, Way{R::exponential, 0.45},
                         Way{R::exponential, 1.0}, Way{R::exponential, 3.0},
                         Way{R::exponential, 10.0}, Way{R::average, 0.0}, Way{R::literal, 0.0}}) {
    LSM::PickerSettings settings;
    settings.reading = way.reading;
    settings.lambda = way.memory > 0.0 ? LSM::lambda_from_memory_time(way.memory, w.dt) : 0.99;
    LSM::EventPicker picker(settings);
    LSM::PeSeriesReader series(LSM::text_io::open_plain(work(w.prefix() + ".pe.bin")));
    std::vector<int> counts(thresholds.size(), 0);
    double duration = 0.0;
    std::int64_t step;
    double time, pe;
    for (LSM::Event e; series.next(step, time, pe);) {
      if (!picker.push(step, time, pe, e) || e.t_start < compression + warmup) continue;
      for (std::size_t n = 0; n < thresholds.size(); ++n)
        if (e.size >= thresholds[n]) ++counts[n];
      if (e.size >= 1e-3) duration += e.t_end - e.t_start;
    }
    table.row("%s,%s,%g,%d,%d,%d,%d,%d,%.3g\n", LSM::to_string(way.reading),
              way.memory > 0.0 ? text(way.memory).c_str() : "lambda 0.99", w.dt, counts[0],
              counts[1], counts[2], counts[3], counts[4], duration / counts[3]);
  }
}

void long_runs() {
  std::vector<LongRun> ways = {{"remove", 0.03, 1, true},
                               {"remove", 0.06, 1, true},
                               {"remove", 0.15, 1, true, 0.04},
                               {"remove", 0.15, 2, false, 0.04}};
  if (!quick)
    ways = {{"remove", 0.015, 1, true},       {"remove", 0.03, 1, false},
            {"remove", 0.06, 1, true},        {"remove", 0.09, 1, false},
            {"remove", 0.12, 1, false, 0.04}, {"remove", 0.15, 1, true, 0.04},
            {"remove", 0.15, 2, false, 0.04}, {"remove", 0.18, 1, false, 0.09},
            {"keep", 0.03, 1, false},         {"keep", 0.06, 1, false}};
  for (LongRun &w : ways) {
    w.time = quick ? 15000.0 : 90000.0;
    if (std::string(w.loose) == "keep") w.time /= 2.0;
  }
  // Two runs on one rank are done at a time, those on more ranks one after the other.
  std::atomic<std::size_t> next{0};
  std::array<std::string, 2> errors;
  auto lane = [&](std::string &error) {
    try {
      for (std::size_t n; (n = next++) < ways.size();)
        if (ways[n].ranks == 1) start(ways[n]);
    } catch (const std::exception &e) {
      error = e.what();
    }
  };
  {
    std::thread other(lane, std::ref(errors[1]));
    lane(errors[0]);
    other.join();
  }
  for (const std::string &e : errors)
    if (!e.empty()) throw std::runtime_error(e);
  for (LongRun &w : ways)
    if (w.ranks > 1) start(w);

  Table runs("fault_long_runs.csv",
             "loose,dt,massfloor,ranks,time,events,time_in_events,after_30_to_40,largest,released,"
             "seconds,time_per_core_hour");
  runs.row(
      "# inputs/fault.in at length %g, events after the first %g time units of shear, by their "
      "begin. after_30_to_40: share of the events of 1e-3 and more that begin 30 to 40 time units "
      "after the one before (the blocks swing with a period near 34). released: sum of the sizes; "
      "seconds: CPU time of all ranks\n",
      length, warmup);
  for (const LongRun &w : ways) {
    double inside = 0.0;
    for (const auto &e : w.events) inside += e.t_end - e.t_start;
    const Sample s = sample_of(w, 1e-3);
    const auto echoes = std::count_if(s.intervals.begin(), s.intervals.end(),
                                      [](double t) { return t > 30.0 && t < 40.0; });
    LSM::NeumaierSum released;
    double largest = 0.0;
    for (const auto &e : w.events) {
      released.add(e.size);
      largest = std::max(largest, e.size);
    }
    runs.row("%s,%g,%g,%d,%g,%zu,%.3f,%.3f,%.4g,%.4g,%.0f,%.3g\n", w.loose, w.dt, w.mass_floor,
             w.ranks, w.time, w.events.size(), inside / (w.time - warmup),
             static_cast<double>(echoes) / static_cast<double>(s.intervals.size()), largest,
             released.value(), w.seconds, 3600.0 * w.time / w.seconds);
  }
  Table table(
      "fault_long.csv",
      "loose,dt,ranks,threshold,events,poisson_error,dispersion,ratio,in_both,only_in_first,"
      "only_here,brief,exponent,exponent_error,gamma,gamma_error,B,B_error,p_size,p_interval");
  Table verdicts(
      "fault_completeness.csv",
      "loose,up_to_dt,shortest,threshold,p_counts,p_exponent,p_gamma,p_B,p_size,p_interval,"
      "p_pairs,depends");
  for (const char *loose : {"remove", "keep"}) {
    std::vector<const LongRun *> same;
    for (const LongRun &w : ways)
      if (std::string(w.loose) == loose) same.push_back(&w);
    if (same.empty()) continue;
    compare(same, table);
    while (same.size() > 1) {
      const double coarsest = same.back()->dt;
      for (const double shortest : {0.0, memory}) judge(same, coarsest, shortest, verdicts);
      while (same.back()->dt == coarsest) same.pop_back();
    }
  }
  Table pickers("fault_picker.csv",
                "reading,memory,dt,events_1e-5,events_1e-4,events_3e-4,events_1e-3,events_1e-2,"
                "mean_duration_1e-3");
  for (const LongRun &w : ways)
    if (w.series) picker_readings(w, pickers);
}

// ---- leaps --------------------------------------------------------------------------------------

constexpr double large = 1e-2, paper_velocity = 0.00025;

/// A run with slow plates, without leaps if fast = 0.
struct SlowRun {
  double velocity, fast, steps;
  std::vector<LSM::Event> events = {}, large_events = {};
  double seconds = 0.0;
  std::string name() const { return "slow_" + text(velocity) + "_" + text(fast); }
  /// Factor that converts times to displacements of the plates, in time units of the paper's
  /// driving.
  double unit() const { return velocity / paper_velocity; }
};

/// For each large event of one run, the index of the nearest event of the other run within half the
/// mean inter-event time whose size differs by at most a factor of 2, or SIZE_MAX. Events near the
/// end of the run are left out.
std::vector<std::size_t> partners(const std::vector<LSM::Event> &first,
                                  const std::vector<LSM::Event> &second) {
  const double near =
      0.5 * (first.back().t_end - first.front().t_end) / static_cast<double>(first.size() - 1);
  std::vector<std::size_t> all;
  std::vector<char> taken(second.size(), 0);
  for (const LSM::Event &e : first) {
    if (e.t_end > second.back().t_end - near) break;
    all.push_back(SIZE_MAX);
    double least = 1e300;
    for (std::size_t n = 0; n < second.size(); ++n) {
      const double apart = std::fabs(second[n].t_end - e.t_end) / near,
                   other = std::fabs(std::log(second[n].size / e.size));
      if (taken[n] || apart > 1.0 || other > std::log(2.0) || apart + other > least) continue;
      least = apart + other;
      all.back() = n;
    }
    if (all.back() != SIZE_MAX) taken[all.back()] = 1;
  }
  return all;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return static_cast<double>(NAN);
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

/// Sizes of at least `smallest`, and the inter-event times in time units of the paper's driving.
std::pair<std::vector<double>, std::vector<double>> sizes_and_times(const SlowRun &w,
                                                                    double smallest) {
  std::vector<double> sizes, times;
  double before = NAN;
  for (const LSM::Event &e : w.events) {
    if (e.size < smallest) continue;
    sizes.push_back(e.size);
    if (std::isfinite(before)) times.push_back((e.t_start - before) * w.unit());
    before = e.t_start;
  }
  return {sizes, times};
}

bool same_events(const std::vector<LSM::Event> &a, const std::vector<LSM::Event> &b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto &x, const auto &y) {
    return x.step_start == y.step_start && x.step_end == y.step_end && x.size == y.size;
  });
}

/// Compares large events with and without leaps, and long catalogues by two-sample tests, and
/// measures the cost per large event.
void leaps() {
  // The first run is without leaps; others of the same velocity are compared with it. Pairs of runs
  // at other velocities follow, without and with leaps.
  std::vector<SlowRun> runs = {{2.5e-5, 0.0, 350000},   {2.5e-5, 2.5e-4, 60000},
                               {2.5e-5, 5e-5, 200000},  {2.5e-4, 0.0, 60000},
                               {2.5e-4, 2.5e-4, 60000}, {2.5e-8, 2.5e-4, 60000}};
  if (!quick)
    runs = {{2.5e-5, 0.0, 1600000},   {2.5e-5, 2.5e-4, 210000}, {2.5e-5, 1e-4, 440000},
            {2.5e-5, 5e-5, 950000},   {2.5e-4, 0.0, 300000},    {2.5e-4, 2.5e-4, 300000},
            {2.5e-6, 2.5e-4, 200000}, {2.5e-7, 2.5e-4, 200000}, {2.5e-8, 2.5e-4, 200000}};
  Table table(
      "fault_leaps.csv",
      "velocity,fast,events,steps_per_event,model_time_per_event,seconds_per_event,paired,of,"
      "shift,scatter_of_shift,median_size_error,p_size,p_time");
  table.row(
      "# inputs/fault.in at length %g, events of %g and more; paired: with the run without leaps, "
      "by end and size; "
      "shift of the ends: times velocity / %g, so in time units of the paper's driving; p: that of "
      "two-sample tests (Kolmogorov-Smirnov) of sizes from 1e-3 on and of the times between them "
      "against the first run, times in the same units\n",
      length, large, paper_velocity);
  Table one_by_one("fault_leaps_first.csv",
                   "event,start,size,centroid,fast,late,size_error,centroid_off");
  one_by_one.row(
      "# the first ten events of %g and more at %g without leaps, and the same with them; start, "
      "late: times velocity / %g\n",
      large, runs.front().velocity, paper_velocity);
  for (SlowRun &w : runs) {
    const std::string name = w.name();
    Variables variables = {
        {"length", text(length)},     {"prefix", name},     {"velocity", text(w.velocity)},
        {"steps", text(w.steps)},     {"series", "no"},     {"location", "yes"},
        {"checkpoint", "1000000000"}, {"overwrite", "yes"}, {"thermo", "100000"}};
    if (w.fast > 0.0) variables.insert(variables.end(), {{"leap", "yes"}, {"fast", text(w.fast)}});
    w.seconds = run(inputs + "/fault.in", variables, 1, name).cpu;
    w.events = events_of(name + ".catalogue.csv");
    for (const LSM::Event &e : w.events)
      if (e.size >= large) w.large_events.push_back(e);
    if (w.large_events.size() < 3)
      throw std::runtime_error(name + ": fewer than three large events");

    std::vector<double> shifts, errors;
    const SlowRun &slow = runs.front();
    std::size_t of = 0;
    if (&w != &slow && w.velocity == slow.velocity) {
      const std::vector<std::size_t> pairs = partners(slow.large_events, w.large_events);
      of = pairs.size();
      for (std::size_t n = 0; n < pairs.size(); ++n) {
        const LSM::Event &e = slow.large_events[n];
        if (n < 10)
          one_by_one.row("%zu,%.6g,%.4g,%.4g,%g,", n + 1, e.t_start * w.unit(), e.size,
                         e.x_centroid, w.fast);
        if (pairs[n] == SIZE_MAX) {
          if (n < 10) one_by_one.row("-,-,-\n");
          continue;
        }
        const LSM::Event &same = w.large_events[pairs[n]];
        shifts.push_back((same.t_end - e.t_end) * w.unit());
        errors.push_back(std::fabs(same.size / e.size - 1.0));
        if (n < 10)
          one_by_one.row("%.4g,%.3g,%.3g\n", (same.t_start - e.t_start) * w.unit(),
                         same.size / e.size - 1.0,
                         std::fabs(around(same.x_centroid - e.x_centroid)));
      }
    }
    const auto mine = sizes_and_times(w, 1e-3), first = sizes_and_times(slow, 1e-3);
    const double intervals = static_cast<double>(w.large_events.size() - 1);
    const LSM::Event &begin = w.large_events.front(), &end = w.large_events.back();
    const double steps = static_cast<double>(end.step_end - begin.step_end) / intervals;
    table.row("%g,%g,%zu,%.0f,%.4g,%.3g,%zu,%zu,%.3g,%.3g,%.3g,%.3g,%.3g\n", w.velocity, w.fast,
              w.large_events.size(), steps, (end.t_end - begin.t_end) / intervals,
              w.seconds * steps / w.steps, shifts.size(), of, quantile(shifts, 0.5),
              0.5 * (quantile(shifts, 0.75) - quantile(shifts, 0.25)), quantile(errors, 0.5),
              Accuracy::two_sample(first.first, mine.first).p,
              Accuracy::two_sample(first.second, mine.second).p);
  }
  // Plates that always move at the fast velocity never leap.
  for (const SlowRun &a : runs)
    for (const SlowRun &b : runs)
      if (a.velocity == b.velocity && a.fast == 0.0 && b.fast == b.velocity)
        table.row("# at %g with leaps %s of %zu events are those without, to the last digit\n",
                  b.velocity, same_events(a.events, b.events) ? "all" : "NOT all", a.events.size());
}

// ---- sums ---------------------------------------------------------------------------------------

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
fix move blocks lsm/nve viscosity 0.015
fix plates all lsm/plates lower upper stress 0.02 damping 0.015 impedance 0.6 velocity 0.00025
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
  for (int ranks : {1, 2, 4}) {
    // The run on each number of ranks is compared with the long double sum of its own energies.
    const std::vector<double> printed = run("sums.in", {{"write", "yes"}}, ranks).second;
    const std::vector<Rows> energies = all_dumped("sums.link");
    if (printed.size() != energies.size())
      throw std::runtime_error("sums.in: snapshots and thermo rows differ");
    long double before = 0.0L;
    for (std::size_t n = 0; n < energies.size(); ++n) {
      long double sum = 0.0L;
      for (const std::vector<double> &row : energies[n]) sum += row.back();
      if (n > 0)
        table.row("%zu,%d,%zu,%.17g,%.3g,%.4g,%.3g\n", energies[n].size(), ranks, 100 * n,
                  printed[n], static_cast<double>((printed[n] - sum) / sum),
                  static_cast<double>(sum - before),
                  static_cast<double>((printed[n] - printed[n - 1]) - (sum - before)));
      before = sum;
    }
  }

  // A series that is disturbed by much more than these errors gives the same catalogue.
  Table disturbed("precision_picker.csv",
                  "disturbance_relative_to_pe,events,same_begin_and_end,largest_change_of_size");
  auto pick = [&](double relative) {
    LSM::PickerSettings settings;
    settings.lambda = LSM::lambda_from_memory_time(memory, 0.06);
    LSM::EventPicker picker(settings);
    LSM::EventFilter filter({1e-9});
    LSM::PeSeriesReader series(LSM::text_io::open_plain(work("long_remove_0.06_1.pe.bin")));
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-relative, relative);
    std::vector<LSM::Event> events;
    std::int64_t step;
    double time, pe;
    for (LSM::Event e; series.next(step, time, pe);)
      if (picker.push(step, time, pe * (1.0 + (relative > 0.0 ? uniform(random) : 0.0)), e) &&
          filter.passes(e))
        events.push_back(e);
    return events;
  };
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
        {"single events", single_events},
        {"friction", friction_schemes},
        {"waves", waves},
        {"long runs", long_runs},
        {"leaps", leaps},
        {"sums", sums}};
    const char *wanted = std::getenv("LSM_ACCURACY_PARTS");
    for (const auto &[name, part] : parts) {
      if (wanted && ("," + std::string(wanted) + ",").find("," + std::string(name) + ",") ==
                        std::string::npos)
        continue;
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
