// SPDX-License-Identifier: GPL-2.0-or-later
// Ways of solving friction (friction_schemes.h) over one event of a fault, whose state lmp has
// listed: error against run time. In C++ as it takes millions of steps; fault_accuracy.py starts
// it. Usage: lsm_accuracy_friction WORK TABLE full|quick TIME SIZE LENGTH KT STRESS VELOCITY
// VISCOSITY
//   IMPEDANCE MEMORY
// WORK has the dumps list.discs, list.links and list.contacts of the state, and one.end, the places
// of the discs at the fault after TIME by lmp with time step 0.03; SIZE is its largest event.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "events/event_picker.h"
#include "friction_schemes.h"

namespace {

std::string work;
Accuracy::Constants constants;
double memory = 0.0;

/// Rows of numbers of a dump with one snapshot.
std::vector<std::vector<double>> dumped(const std::string &file) {
  std::ifstream in(work + "/" + file);
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
  if (rows.empty()) throw std::runtime_error(work + "/" + file + ": nothing in it");
  return rows;
}

double around(double d) { return d - constants.length * std::round(d / constants.length); }

/// The state that lmp has listed.
Accuracy::Scene small_fault() {
  using Accuracy::Side;
  Accuracy::Scene scene;
  scene.constants = constants;
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
  double size = 0.0, seconds = 0.0, sweeps = 0.0;
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

void friction_schemes(std::FILE *table, bool quick, double time, double size_by_lmp) {
  const Accuracy::Scene state = small_fault();
  auto spring = [&](double kt, double dt) {
    Accuracy::Scene scene = state;
    scene.constants.kt = kt;
    for (auto &c : scene.contacts) c.xi *= constants.kt / kt;  // the same force
    Accuracy::SpringFault fault(std::move(scene), dt);
    return run_small(fault, time, dt);
  };
  auto rigid = [&](double, double dt) {
    Accuracy::RigidFault fault(state, dt, 1e-12);
    Small s = run_small(fault, time, dt);
    s.sweeps = fault.sweeps_per_step();
    return s;
  };

  const Small small = spring(constants.kt, 0.03);
  double off = 0.0;
  const auto by_lmp = dumped("one.end");
  for (const auto &row : by_lmp)
    off +=
        std::pow(around(row.at(1) - small.end.at(static_cast<std::size_t>(row.at(0)) - 1).x.x), 2);
  const double finest = 0.06 / 32;
  const Small exact_rigid = rigid(0.0, finest);
  const double slip = apart(exact_rigid.end, exact_rigid.begin),
               off_lmp = std::sqrt(off / static_cast<double>(by_lmp.size())) / slip;
  std::fprintf(table,
               "# with the spring and time step 0.03 the small program is off lmp by %.2g of the "
               "displacement and %.2g of the event size; displacement %.4g (rms at the fault), "
               "size without spring %.6g\n",
               off_lmp, std::fabs(small.size / size_by_lmp - 1.0), slip, exact_rigid.size);
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
    const Small exact = w.kt == 0.0 ? exact_rigid : w.run(w.kt, finest);
    auto row = [&](double dt, const Small &s) {
      std::fprintf(table, "%s,%g,%g,%.4g,%.1f,%.4g,%.4g,%.4g,%.4g\n", w.name, w.kt, dt, s.seconds,
                   s.sweeps, apart(s.end, exact.end) / slip, std::fabs(s.size / exact.size - 1.0),
                   apart(s.end, exact_rigid.end) / slip,
                   std::fabs(s.size / exact_rigid.size - 1.0));
    };
    row(finest, exact);
    for (double dt : {0.00375, 0.0075, 0.015, 0.03, 0.06}) {
      if (dt > w.largest) continue;
      Small s = w.run(w.kt, dt);
      for (int n = 1; n < (dt > 0.01 ? 3 : 1); ++n)
        s.seconds = std::min(s.seconds, w.run(w.kt, dt).seconds);
      row(dt, s);
    }
  }
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 13) {
    std::fprintf(stderr, "lsm_accuracy_friction: expected 12 arguments, see fault_accuracy.py\n");
    return 2;
  }
  const auto number = [argv](int n) { return std::strtod(argv[n], nullptr); };
  work = argv[1];
  constants = {number(6), 1.0, number(7), 0.6, number(8), number(9), number(10), number(11)};
  memory = number(12);
  std::FILE *const table = std::fopen(argv[2], "w");
  try {
    if (!table) throw std::runtime_error(std::string(argv[2]) + ": cannot be written");
    std::fprintf(table,
                 "scheme,kt,dt,seconds,sweeps_per_step,error_profile,error_size,profile_off_rigid,"
                 "size_off_rigid\n");
    friction_schemes(table, std::string(argv[3]) == "quick", number(4), number(5));
  } catch (const std::exception &e) {
    std::fprintf(stderr, "lsm_accuracy_friction: %s\n", e.what());
    return 1;
  }
  return std::fclose(table) == 0 ? 0 : 1;
}
