// SPDX-License-Identifier: GPL-2.0-or-later
// A short sheared fault: energy ledger, restart, picking during and after the run, numbers of
// ranks.
#include <cmath>
#include <fstream>

#include "fault_scene.h"
#include "events/event_filter.h"
#include "events/event_picker.h"
#include "files/pe_series.h"
#include "read_catalogue.h"

using namespace physics;

using Ledger = Fault;
using Restart = Fault;
using Events = Fault;
using Ranks = Fault;
using MassStep = Fault;

template <class Kind>
static void expect_same_events(const std::vector<Kind> &a, const std::vector<Kind> &b,
                               double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    EXPECT_EQ(a[n].id, b[n].id);
    EXPECT_EQ(a[n].step_start, b[n].step_start);
    EXPECT_EQ(a[n].step_end, b[n].step_end);
    EXPECT_NEAR(a[n].size, b[n].size, tolerance * a[n].pe_start);
    EXPECT_NEAR(a[n].pe_start, b[n].pe_start, tolerance * a[n].pe_start);
    EXPECT_NEAR(a[n].t_end, b[n].t_end, 1e-9 * a[n].t_end);
  }
}

TEST_F(Ledger, BalancesAndFallsWithTheTimeStep) {
  std::vector<double> off;
  for (double dt : {0.04, 0.02, 0.01}) {
    const std::string steps = text(std::round(80.0 / dt));
    const Result r = run_text(fault_read() + fault_shear("") + "thermo " +
                                  text(std::round(4.0 / dt)) + "\nrun " + steps + "\n",
                              {{"dt", text(dt)}});
    ASSERT_TRUE(succeeded(r));
    double most = 0.0;
    for (const auto &row : r.thermo) most = std::max(most, std::fabs(row.at("c_events[13]")));
    off.push_back(most / r.last("f_plates"));
    std::printf("dt %g: residual %.3g of the plates' work %.4g; friction %.4g, viscosity %.4g\n",
                dt, off.back(), r.last("f_plates"), r.last("c_events[11]"), r.last("c_events[12]"));
    EXPECT_GT(r.last("c_events[11]"), 0.0);
    EXPECT_GT(r.last("c_events[12]"), 0.0);
  }
  EXPECT_LT(off[0], 2e-4);
  EXPECT_LT(off[2], 1e-5);
  EXPECT_LT(off[2], off[0] / 4);
}

TEST_F(Ledger, SecondOrderBeforeTheFaultSlips) {
  // At first the plates approach each other: contacts stick and do not change their state.
  std::vector<double> off;
  for (double dt : {0.04, 0.02, 0.01}) {
    const Result r =
        run_text(fault_read() + fault_shear("") + "thermo " + text(std::round(0.8 / dt)) +
                     "\nrun " + text(std::round(8.0 / dt)) + "\n",
                 {{"dt", text(dt)}, {"mus", "100"}, {"velocity", "0.001"}});
    ASSERT_TRUE(succeeded(r));
    double most = 0.0;
    for (const auto &row : r.thermo) most = std::max(most, std::fabs(row.at("c_events[13]")));
    off.push_back(most);
  }
  std::printf("residual without slip: %.3g %.3g %.3g\n", off[0], off[1], off[2]);
  EXPECT_NEAR(std::log2(off[0] / off[2]) / 2, 2.0, 0.3);
}

static const char *const recording =
    "catalogue ${prefix}.csv series ${prefix}.pe resume yes location yes";

static std::string shear_from_data() {
  return "variable prefix index whole\n" + fault_read() + fault_shear(recording) + "thermo 100\n";
}

TEST_F(Restart, EqualsTheUninterruptedRun) {
  for (int ranks : {1, 2}) {
    const std::string tag = std::to_string(ranks);
    // The state is written during the run, which then continues.
    const Result whole = run_text(shear_from_data() + "restart 3000 half." + tag + ".*\nrun 5000\n",
                                  {{"prefix", "whole" + tag}}, ranks);
    ASSERT_TRUE(succeeded(whole));
    const Result first = run_text(shear_from_data() + "restart 3000 half." + tag + ".*\nrun 3500\n",
                                  {{"prefix", "resumed" + tag}}, ranks);
    ASSERT_TRUE(succeeded(first));
    const std::string again = "variable prefix index resumed" + tag +
                              "\nnewton off\natom_style hybrid bond sphere\natom_modify map array\n"
                              "comm_modify mode single cutoff 3.6\n"
                              "read_restart half." +
                              tag +
                              ".3000\n"
                              "neighbor 0.4 bin\nneigh_modify delay 0 every 10 check yes\n" +
                              fault_shear(recording) + "thermo 100\nrun 2000\n";
    Result second = run_text(again, {}, ranks);
    ASSERT_TRUE(succeeded(second));

    Result tail = whole;
    tail.thermo.erase(tail.thermo.begin(), tail.thermo.end() - 21);
    ASSERT_EQ(second.thermo.size(), 21u);
    EXPECT_EQ(second.thermo.front().at("Step"), tail.thermo.front().at("Step"));
    const double off = thermo_difference(tail, second, compared);
    std::printf("restart on %d ranks: thermo differs by %.2g\n", ranks, off);
    EXPECT_LT(off, 1e-7);
    EXPECT_EQ(tail.last("c_events"), second.last("c_events"));

    const auto a = unit::read_catalogue<LSM::Drop>(path("whole" + tag + ".csv"));
    const auto b = unit::read_catalogue<LSM::Drop>(path("resumed" + tag + ".csv"));
    EXPECT_GT(a.events.size(), 3u);
    expect_same_events(a.events, b.events, 1e-9);
    for (std::size_t n = 0; n < std::min(a.events.size(), b.events.size()); ++n)
      EXPECT_NEAR(a.events[n].slip_moment, b.events[n].slip_moment,
                  1e-6 * std::fabs(a.events[n].slip_moment) + 1e-12);

    LSM::PeSeriesReader x(LSM::files::open_plain(path("whole" + tag + ".pe")));
    LSM::PeSeriesReader y(LSM::files::open_plain(path("resumed" + tag + ".pe")));
    std::int64_t step = 0, other = 0;
    double time = 0, pe = 0, other_time = 0, other_pe = 0;
    std::int64_t samples = 0;
    while (x.next(step, time, pe)) {
      ASSERT_TRUE(y.next(other, other_time, other_pe));
      ASSERT_EQ(step, other);
      ASSERT_NEAR(pe, other_pe, 1e-9 * pe);
      ++samples;
    }
    EXPECT_EQ(samples, 5001);
    EXPECT_FALSE(y.next(other, other_time, other_pe));
  }
}

static std::string sheared_state(const std::string &dt, const std::string &events) {
  return "newton off\natom_style hybrid bond sphere\natom_modify map array\n"
         "comm_modify mode single cutoff 3.6\nread_restart ${state}\ntimestep " +
         dt +
         "\n"
         "neighbor 0.4 bin\nneigh_modify delay 0 every 10 check yes\n" +
         fault_shear(events);
}

// Files that a continued run begins are continued in turn.
TEST_F(Restart, GoesOnWithFilesOfAContinuedRun) {
  const auto shear = [](const std::string &files, const std::string &resume) {
    return "variable velocity index 0.03\n" +
           fault_shear("stride 1000 resume " + resume + " catalogue " + files + ".csv series " +
                       files + ".pe ruptures " + files + ".ruptures") +
           "thermo 1000\n";
  };
  const auto again = [](const std::string &restart) {
    return "newton off\natom_style hybrid bond sphere\natom_modify map array\ncomm_modify mode "
           "single cutoff 3.6\nread_restart " +
           restart + "\nneighbor 0.4 bin\nneigh_modify delay 0 every 10 check yes\n";
  };
  ASSERT_TRUE(succeeded(run_text(fault_read() + shear("one", "no") +
                                 "run 3500\nwrite_restart one.restart\nrun 3000\n")));
  ASSERT_TRUE(succeeded(run_text(again("one.restart") + shear("two", "no") +
                                 "run 200\nwrite_restart two.restart\nrun 800\nwrite_restart "
                                 "three.restart\nrun 10\n")));
  // at a step before its first sample, and after some events
  for (const auto &[restart, steps] : {std::pair{"two.restart", "2800"}, {"three.restart", "2000"}})
    ASSERT_TRUE(succeeded(run_text(again(restart) + shear("two", "yes") + "run " + steps + "\n")));
  std::vector<std::int64_t> whole, parts;
  for (const auto &event : unit::read_catalogue(path("one.csv")).events)
    if (event.step_end > 3500) whole.push_back(event.step_end);
  for (const auto &event : unit::read_catalogue(path("two.csv")).events)
    parts.push_back(event.step_end);
  EXPECT_EQ(parts, whole);
  EXPECT_GE(whole.size(), 5u);
}

// A is the change of PE per step, so half a time step means half an A.
TEST_F(Restart, PickerFollowsTheTimeStep) {
  for (int ranks : {1, 2})
    for (const char *memory : {"lambda 0.99", "memory 3.0"}) {
      SCOPED_TRACE(std::to_string(ranks) + " ranks, " + memory);
      const Variables variables = {{"state", "slow.2000"}};
      for (const char *name : {"fast.csv", "fast.pe"}) std::filesystem::remove(path(name));
      const Result before =
          run_text(fault_read() + fault_shear(std::string("catalogue slow.csv ") + memory) +
                       "thermo 1000\nrestart 2000 slow.*\nrun 2000\n",
                   {}, ranks);
      ASSERT_TRUE(succeeded(before));
      const double rate = before.last("c_events[3]");
      ASSERT_NE(rate, 0.0);

      const bool by_time = std::string(memory) == "memory 3.0";
      const double lambda = by_time ? std::exp(-0.015 / 3.0) : 0.99;
      const Result resumed = run_text(
          sheared_state("0.015",
                        std::string("resume yes catalogue fast.csv series fast.pe ") + memory) +
              "thermo 1\nrun 12000\n",
          variables, ranks);
      ASSERT_TRUE(succeeded(resumed));
      const Result between =
          run_text(sheared_state("0.03", memory) + "thermo 1\nrun 0\ntimestep 0.015\nrun 1\n",
                   variables, ranks);
      ASSERT_TRUE(succeeded(between));
      ASSERT_EQ(between.thermo.size(), 3u);
      EXPECT_EQ(between.thermo[0].at("c_events[3]"), rate);
      EXPECT_EQ(between.thermo[1].at("c_events[3]"), 0.5 * rate);
      EXPECT_EQ(resumed.thermo[0].at("c_events[3]"), 0.5 * rate);
      for (const auto &[first, second] : {std::pair(resumed.thermo[0], resumed.thermo[1]),
                                          std::pair(between.thermo[1], between.thermo[2])})
        EXPECT_NEAR(second.at("c_events[3]"),
                    lambda * 0.5 * rate +
                        (1.0 - lambda) * (second.at("c_events[5]") - first.at("c_events[5]")),
                    1e-9 * std::fabs(rate));

      // Times continue from 60, and the numbering of events continues as well.
      const double old_events = before.last("c_events");
      const auto fast = unit::read_catalogue(path("fast.csv"));
      ASSERT_GT(fast.events.size(), 1u);
      EXPECT_EQ(static_cast<double>(fast.events[0].id), old_events + 1.0);
      EXPECT_NEAR(std::stod(*fast.info.find("dt")), 0.015, 1e-15);
      EXPECT_NEAR(std::stod(*fast.info.find("lambda")), lambda, 1e-15);
      for (const auto &e : fast.events)
        EXPECT_NEAR(e.t_end, 60.0 + 0.015 * static_cast<double>(e.step_end - 2000), 1e-9);
      LSM::PeSeriesReader series(LSM::files::open_plain(path("fast.pe")));
      std::int64_t step = 0;
      double time = 0, pe = 0;
      ASSERT_TRUE(series.next(step, time, pe));
      EXPECT_EQ(step, 2001);
      EXPECT_NEAR(time, 60.015, 1e-12);
    }
}

// A PE series that does not match is found before the catalogue is cut back, and vice versa.
TEST_F(Restart, NothingIsCutWhereOneFileDoesNotFit) {
  const std::string events = "resume yes catalogue pair.csv series pair.pe";
  const std::string again = sheared_state("0.03", events) + "run 1\n";
  for (int ranks : {1, 2})
    for (const char *wrong : {"pair.pe", "pair.csv"}) {
      SCOPED_TRACE(std::to_string(ranks) + " ranks, " + wrong);
      for (const char *name : {"pair.csv", "pair.pe"}) std::filesystem::remove(path(name));
      ASSERT_TRUE(succeeded(run_text(
          fault_read() + fault_shear(events) + "restart 1000 pair.*\nrun 1900\n", {}, ranks)));
      std::string text = read_file(path(wrong));
      const std::string key = "# length = 40\n";
      ASSERT_NE(text.find(key), std::string::npos);
      text.replace(text.find(key), key.size(), "# length = 41\n");
      std::ofstream(path(wrong)) << text;
      const std::string catalogue = read_file(path("pair.csv")),
                        series = read_file(path("pair.pe"));
      ASSERT_GT(series.size(), 1500u * 16);
      EXPECT_TRUE(failed_with(run_text(again, {{"state", "pair.1000"}}, ranks),
                              {wrong, "length", "41", "40"}));
      EXPECT_TRUE(read_file(path("pair.csv")) == catalogue);
      EXPECT_TRUE(read_file(path("pair.pe")) == series);
    }
}

// Plates take over velocities that are set before the first run, whatever looked at the system.
TEST_F(Restart, PlatesTakeVelocitiesThatAreSetBeforeTheFirstRun) {
  const auto moved = [](const std::string &before) {
    const Result r =
        run_text(fault_read() +
                 "fix move blocks lsm/nve\nfix plates all lsm/plates lower upper stress 0.006\n" +
                 before + "velocity all set 0 0.01 0\nthermo_style custom step ke f_plates[10]\n" +
                 "thermo_modify norm no format float %.17g\nrun 10\n");
    EXPECT_TRUE(succeeded(r));
    return r;
  };
  const Result plain = moved("");
  EXPECT_GT(plain.last("f_plates[10]"), 1e-4);
  EXPECT_EQ(moved("write_data early.data\n").thermo, plain.thermo);
}

// The header of a file has only one time step.
TEST_F(Restart, TimeStepOfOpenFilesIsKept) {
  const std::string shear = fault_read() + fault_shear("${files}") + "thermo 100\nrun 200\n";
  for (const char *files : {"catalogue one.csv", "series one.pe"})
    for (const char *change :
         {"timestep 0.015\nrun 200\n", "fix adapt all dt/reset 10 NULL NULL 1e-6\nrun 200\n"}) {
      SCOPED_TRACE(std::string(files) + ", " + change);
      for (int ranks : {1, 2})
        EXPECT_TRUE(failed_with(run_text(shear + change, {{"files", files}}, ranks),
                                {"time step", "from 0.03 to", "one."}));
    }

  const Variables variables = {{"state", "one.restart"}};
  ASSERT_TRUE(succeeded(run_text(shear + "write_restart one.restart\n",
                                 {{"files", "catalogue one.csv series one.pe"}})));
  const std::string catalogue = read_file(path("one.csv")), series = read_file(path("one.pe"));
  for (const char *files : {"catalogue one.csv", "series one.pe"})
    EXPECT_TRUE(failed_with(
        run_text(sheared_state("0.015", std::string("resume yes ") + files) + "run 100\n",
                 variables),
        {"one.", "'dt' is '0.0299", "expected '0.0149"}));
  EXPECT_TRUE(read_file(path("one.csv")) == catalogue);
  EXPECT_TRUE(read_file(path("one.pe")) == series);
}

TEST_F(Events, PickedOnlineEqualThosePickedLater) {
  for (int ranks : {1, 2})
    for (const char *picker : {"exponential", "average", "literal"}) {
      const Result r = run_text(
          fault_read() +
              fault_shear("catalogue online.csv series online.pe picker ${picker} block 37") +
              "thermo 1000\nrun 2500\nrun 1500\n",
          {{"picker", picker}}, ranks);
      ASSERT_TRUE(succeeded(r));
      const auto catalogue = unit::read_catalogue(path("online.csv"));
      LSM::PickerSettings settings;
      ASSERT_TRUE(LSM::from_string(picker, settings.reading));
      LSM::EventPicker later(settings);
      LSM::PeSeriesReader series(LSM::files::open_plain(path("online.pe")));
      std::vector<LSM::Event> events;
      std::int64_t step = 0;
      double time = 0, pe = 0;
      LSM::Event event;
      LSM::EventFilter filter;
      while (series.next(step, time, pe)) {
        if (!later.push(step, time, pe, event) || !filter.passes(event)) continue;
        filter.number(event);
        events.push_back(event);
      }
      EXPECT_GT(events.size(), 3u);
      EXPECT_EQ(r.last("c_events"), static_cast<double>(events.size()));
      expect_same_events(catalogue.events, events, 0.0);
    }
}

// Compares slip, place and length of the events with the work lost to friction and the definitions
// of the columns.
TEST_F(Events, SlipAndCentroidLieOnTheFault) {
  const std::string script = fault_read() + fault_shear("catalogue located.csv location yes") +
                             "thermo ${thermo}\nrun 5000\n";
  const Result r = run_text(script, {{"thermo", "1"}});
  ASSERT_TRUE(succeeded(r));
  const auto catalogue = unit::read_catalogue<LSM::Drop>(path("located.csv"));
  ASSERT_GT(catalogue.events.size(), 2u);
  std::size_t elsewhere = 0;
  double lost = 0.0, moment = 0.0;
  const double first = catalogue.events[0].x_centroid;
  for (const auto &e : catalogue.events) {
    // Row n of the thermo table is that of step n.
    ASSERT_EQ(r.thermo[static_cast<std::size_t>(e.step_end)].at("Step"),
              static_cast<double>(e.step_end));
    lost += r.thermo[static_cast<std::size_t>(e.step_end)].at("c_events[11]") -
            r.thermo[static_cast<std::size_t>(e.step_start)].at("c_events[11]");
    moment += e.slip_moment;
    // The length is a whole number of bins, of which the largest slip is at least the mean.
    EXPECT_EQ(e.rupture_length, std::round(e.rupture_length));
    EXPECT_GE(e.rupture_length, 1.0);
    EXPECT_LE(e.rupture_length, 40.0);
    EXPECT_GE(e.peak_slip * 40.0,
              std::fabs(e.slip_moment) / std::stod(*catalogue.info.find("modulus")));
    EXPECT_GT(e.x_centroid, 0.0);
    EXPECT_LT(e.x_centroid, 40.0);
    if (std::fabs(e.x_centroid - first) > 1.0) ++elsewhere;
  }
  EXPECT_GT(elsewhere, 0u) << "every event is at the same place";
  // The work is stress times slip times length, and the stress about 0.6 times 0.006.
  const double slip = moment / std::stod(*catalogue.info.find("modulus"));
  std::printf("work of the events over their slip %.3g, strength %.3g\n", lost / slip, 0.6 * 0.006);
  EXPECT_GT(lost, 0.3 * 0.6 * 0.006 * slip);
  EXPECT_LT(lost, 2.0 * 0.6 * 0.006 * slip);

  // The slip gathered from two ranks is the same.
  ASSERT_TRUE(succeeded(run_text(script, {{"thermo", "1000"}}, 2)));
  const auto two = unit::read_catalogue<LSM::Drop>(path("located.csv"));
  expect_same_events(catalogue.events, two.events, 1e-9);
  for (std::size_t n = 0; n < std::min(two.events.size(), catalogue.events.size()); ++n) {
    const LSM::Drop &a = catalogue.events[n], &b = two.events[n];
    EXPECT_NEAR(a.slip_moment, b.slip_moment, 1e-5 * a.peak_slip);
    EXPECT_NEAR(a.peak_slip, b.peak_slip, 1e-6 * a.peak_slip);
    EXPECT_NEAR(std::remainder(a.x_centroid - b.x_centroid, 40.0), 0.0, 1e-3);
    EXPECT_EQ(a.rupture_length, b.rupture_length);
  }
}

TEST_F(Ranks, ThermoAndFirstEventsAgree) {
  const std::string script = "variable prefix index one\n" + fault_read() +
                             fault_shear("catalogue ${prefix}.csv") + "thermo 100\nrun 1500\n";
  const Result one = run_text(script);
  ASSERT_TRUE(succeeded(one));
  const auto events = unit::read_catalogue(path("one.csv")).events;
  EXPECT_GE(events.size(), 1u);
  for (int ranks : {1, 2, 4})
    for (const char *newton : {"on", "off"}) {
      const Result r = run_text(script, {{"newton", newton}, {"prefix", "several"}}, ranks);
      ASSERT_TRUE(succeeded(r));
      const double off = thermo_difference(one, r, compared);
      std::printf("%d ranks, newton %s: thermo differs by %.2g\n", ranks, newton, off);
      EXPECT_LT(off, 1e-9);
      expect_same_events(events, unit::read_catalogue(path("several.csv")).events, 1e-9);
    }
}

// With a neigh_modify exclude, here of no pair at all, LAMMPS' own search builds the lists.
TEST_F(Ranks, ListsAreThoseOfLammps) {
  const std::string script = fault_read() + R"(
pair_coeff        * * 1.0 0.5 0.6
neigh_modify      every 20 check no
group             nobody empty
)" + fault_shear("");
  const std::string run = "thermo 20\nrun 600\n";
  for (int ranks : {1, 2}) {
    const Result ours = run_text(script + run, {}, ranks);
    const Result theirs =
        run_text(script + "neigh_modify exclude group nobody nobody\n" + run, {}, ranks);
    ASSERT_TRUE(succeeded(ours));
    ASSERT_TRUE(succeeded(theirs));
    EXPECT_GT(ours.last("c_events[11]"), 0.0);
    EXPECT_EQ(thermo_difference(ours, theirs, compared), 0.0) << ranks;
    const auto listed = ours.lines_with("Total # of neighbors");
    ASSERT_EQ(listed.size(), 1u);
    EXPECT_EQ(listed[0].find("= 0"), std::string::npos) << listed[0];
    EXPECT_EQ(listed, theirs.lines_with("Total # of neighbors"));
  }
}

TEST_F(Ranks, StaticFrictionToo) {
  const std::string script = fault_read() + fault_shear("") + "thermo 100\nrun 1000\n";
  const Result one = run_text(script, {{"mus", "0.8"}});
  ASSERT_TRUE(succeeded(one));
  EXPECT_GT(one.last("c_events[11]"), 0.0);
  for (int ranks : {2, 4})
    for (const char *newton : {"on", "off"}) {
      const Result r = run_text(script, {{"newton", newton}, {"mus", "0.8"}}, ranks);
      ASSERT_TRUE(succeeded(r));
      EXPECT_LT(thermo_difference(one, r, compared), 1e-9) << ranks << " ranks, newton " << newton;
    }
}

TEST_F(Ranks, GeometryDoesNotDependOnThem) {
  const std::string script = fault_start() +
                             "create_lsm_fault length 40 width 20 seed 3 failures 500\n" +
                             "write_dump all custom ${file} id type x y radius mass modify sort id "
                             "format float %.17g\n";
  ASSERT_TRUE(succeeded(run_text(script, {{"file", "one.dump"}})));
  ASSERT_TRUE(succeeded(run_text(script, {{"file", "four.dump"}}, 4)));
  EXPECT_GT(read_file(path("one.dump")).size(), 10000u);
  EXPECT_EQ(read_file(path("one.dump")), read_file(path("four.dump")));
}

TEST_F(Ranks, NorDoesThatOfAPackingOnAGrid) {
  // The lines of a data file are in the order of the owners of the particles, and the first word of
  // a bond is its place in this order.
  const auto lines = [this](int ranks) {
    const Result r =
        run_text(fault_start() +
                     "create_lsm_fault length 41 width 20 seed 3 failures 500 faces none "
                     "seeds grid linkratio 1.05 loose keep\n"
                     "bond_style zero\nbond_coeff *\n"
                     "write_data grid.data nocoeff nofix\n",
                 {}, ranks);
    EXPECT_TRUE(succeeded(r));
    std::vector<std::string> found;
    std::istringstream in(read_file(path("grid.data")));
    bool bonds = false;
    for (std::string line; std::getline(in, line);) {
      bonds = bonds || line == "Bonds";
      found.push_back(bonds ? line.substr(line.find(' ') + 1) : line);
    }
    std::sort(found.begin(), found.end());
    return found;
  };
  const std::vector<std::string> one = lines(1);
  EXPECT_GT(one.size(), 1500u);
  for (const int ranks : {2, 3}) EXPECT_EQ(lines(ranks), one) << ranks << " ranks";
}

TEST_F(Ranks, LinksOfCloseDiscsPullTheBlocksTogether) {
  // Without stress the plates stay where they are, unless links begin under tension.
  const std::string script = fault_start() +
                             "create_lsm_fault length 40 width 20 seed 3 failures 500 linkratio "
                             "${ratio}\n" +
                             fault_groups() + fault_forces() + R"(
fix move blocks lsm/nve viscosity 0.2
fix plates all lsm/plates lower upper stress 0 damping 0.2
compute guard all lsm/events strainlimit 0.75
thermo_style custom step pe f_plates[9]
thermo_modify norm no format float %.17g
timestep 0.03
run 3000
)";
  const Result tangent = run_text(script, {{"ratio", "1"}}),
               close = run_text(script, {{"ratio", "1.05"}});
  ASSERT_TRUE(succeeded(tangent));
  ASSERT_TRUE(succeeded(close));
  EXPECT_NEAR(tangent.last("f_plates[9]"), 0.0, 1e-6);
  EXPECT_GT(close.last("f_plates[9]"), 1e-3);
  EXPECT_LT(close.last("PotEng"), close.thermo.front().at("PotEng"));
  const Result two = run_text(script, {{"ratio", "1.05"}}, 2);
  ASSERT_TRUE(succeeded(two));
  EXPECT_NEAR(two.last("f_plates[9]"), close.last("f_plates[9]"), 1e-9);
}

TEST_F(MassStep, IsStableWithContacts) {
  // The upper block is pressed into the lower one: there are many contacts at once, equally stiff
  // in both directions.
  const std::string script = fault_start() +
                             "create_lsm_fault length 40 width 20 seed 3 failures 500 massstep "
                             "${step} 1.0\n" +
                             fault_groups() + fault_forces() + R"(
group above type 2 4 6
displace_atoms above move 1.3 -0.1 0
fix move blocks lsm/nve dtcheck warn
fix plates all lsm/plates lower upper position
thermo_style custom step f_move[2]
thermo_modify format float %.17g
timestep 0.12
run 0
)";
  const Result own = run_text(script, {{"step", "0"}});
  const Result raised = run_text(script, {{"step", "0.12"}});
  ASSERT_TRUE(succeeded(own));
  ASSERT_TRUE(succeeded(raised));
  EXPECT_LT(own.last("f_move[2]"), 0.12);
  EXPECT_GE(raised.last("f_move[2]"), 0.12);
  const Result two = run_text(script, {{"step", "0.12"}}, 2);
  ASSERT_TRUE(succeeded(two));
  EXPECT_NEAR(two.last("f_move[2]"), raised.last("f_move[2]"), 1e-9);
  EXPECT_EQ(raised.lines_with("time step 0.12 stable with any contacts: ").size(), 1u);
}
