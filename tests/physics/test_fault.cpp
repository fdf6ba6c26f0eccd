// SPDX-License-Identifier: GPL-2.0-or-later
// A short sheared fault: energy ledger, restart, picking during and after the run, numbers of
// ranks.
#include <cmath>
#include <fstream>

#include "fault_scene.h"
#include "read_catalogue.h"
#include "read_series.h"
#include "same_events.h"

using namespace physics;

using Ledger = Fault;
using Restart = Fault;
using Ranks = Fault;
using MassStep = Fault;

TEST_F(Ledger, BalancesAndFallsWithTheTimeStep) {
  std::vector<double> off;
  for (double dt : {0.04, 0.02, 0.01}) {
    const std::string steps = text(std::round(80.0 / dt));
    const Result r = ran(fault_read() + fault_shear("") + "thermo " + text(std::round(4.0 / dt)) +
                             "\nrun " + steps + "\n",
                         {{"dt", text(dt)}});
    double most = 0.0;
    for (const auto &row : r.thermo) most = std::max(most, std::fabs(row.at("c_events[13]")));
    off.push_back(most / r.last("f_plates"));
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
    const Result r = ran(fault_read() + fault_shear("") + "thermo " + text(std::round(0.8 / dt)) +
                             "\nrun " + text(std::round(8.0 / dt)) + "\n",
                         {{"dt", text(dt)}, {"mus", "100"}, {"velocity", "0.001"}});
    double most = 0.0;
    for (const auto &row : r.thermo) most = std::max(most, std::fabs(row.at("c_events[13]")));
    off.push_back(most);
  }
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
    const Result whole = ran(shear_from_data() + "restart 3000 half." + tag + ".*\nrun 5000\n",
                             {{"prefix", "whole" + tag}}, ranks);
    ran(shear_from_data() + "restart 3000 half." + tag + ".*\nrun 3500\n",
        {{"prefix", "resumed" + tag}}, ranks);
    const std::string again = "variable prefix index resumed" + tag + "\n" +
                              fault_restart("half." + tag + ".3000") + fault_shear(recording) +
                              "thermo 100\nrun 2000\n";
    const Result second = ran(again, {}, ranks);
    const Result tail = whole.tail(21);
    ASSERT_EQ(second.thermo.size(), 21u);
    EXPECT_EQ(second.thermo.front().at("Step"), tail.thermo.front().at("Step"));
    EXPECT_LT(thermo_difference(tail, second, compared), 1e-7);
    EXPECT_EQ(tail.last("c_events"), second.last("c_events"));

    const auto a = unit::read_catalogue<LSM::Drop>(path("whole" + tag + ".csv"));
    const auto b = unit::read_catalogue<LSM::Drop>(path("resumed" + tag + ".csv"));
    EXPECT_GT(a.events.size(), 3u);
    unit::expect_same_events(unit::read_catalogue(path("whole" + tag + ".csv")).events,
                             unit::read_catalogue(path("resumed" + tag + ".csv")).events, 1e-9);
    unit::expect_same_events(a.events, b.events, 1e-6, 1e-6, 40.0);

    const auto x = unit::read_series(path("whole" + tag + ".pe")),
               y = unit::read_series(path("resumed" + tag + ".pe"));
    ASSERT_EQ(x.size(), 5001U);
    ASSERT_EQ(y.size(), x.size());
    for (std::size_t n = 0; n < x.size(); ++n) {
      ASSERT_EQ(x[n].step, y[n].step);
      ASSERT_NEAR(x[n].pe, y[n].pe, 1e-9 * x[n].pe);
    }
  }
}

static std::string sheared_state(const std::string &dt, const std::string &events) {
  return fault_restart("${state}") + "timestep " + dt + "\n" + fault_shear(events);
}

// Files that a continued run begins are continued in turn.
TEST_F(Restart, GoesOnWithFilesOfAContinuedRun) {
  const auto shear = [](const std::string &files, const std::string &resume) {
    return "variable velocity index 0.03\n" +
           fault_shear("stride 1000 resume " + resume + " catalogue " + files + ".csv series " +
                       files + ".pe ruptures " + files + ".ruptures") +
           "thermo 1000\n";
  };
  ran(fault_read() + shear("one", "no") + "run 3500\nwrite_restart one.restart\nrun 3000\n");
  ran(fault_restart("one.restart") + shear("two", "no") +
      "run 200\nwrite_restart two.restart\nrun 800\nwrite_restart "
      "three.restart\nrun 10\n");
  // at a step before its first sample, and after some events
  for (const auto &[restart, steps] : {std::pair{"two.restart", "2800"}, {"three.restart", "2000"}})
    ran(fault_restart(restart) + shear("two", "yes") + "run " + steps + "\n");
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
  for (const std::string memory : {"lambda 0.99", "memory 3.0"}) {
    SCOPED_TRACE(memory);
    const Variables variables = {{"state", "slow.2000"}};
    std::filesystem::remove(path("fast.csv"));
    const Result before = ran(fault_read() + fault_shear("catalogue slow.csv " + memory) +
                              "thermo 1000\nrestart 2000 slow.*\nrun 2000\n");
    const double rate = before.last("c_events[3]");
    ASSERT_NE(rate, 0.0);

    const double lambda = memory == "memory 3.0" ? std::exp(-0.015 / 3.0) : 0.99;
    const Result resumed = ran(
        sheared_state("0.015", "resume yes catalogue fast.csv " + memory) + "thermo 1\nrun 12000\n",
        variables);
    const Result between =
        ran(sheared_state("0.03", memory) + "thermo 1\nrun 0\ntimestep 0.015\nrun 1\n", variables);
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

    // The numbering of events continues.
    const auto fast = unit::read_catalogue(path("fast.csv"));
    ASSERT_GT(fast.events.size(), 1u);
    EXPECT_EQ(static_cast<double>(fast.events[0].id), before.last("c_events") + 1.0);
    EXPECT_NEAR(std::stod(*fast.info.find("lambda")), lambda, 1e-15);
    EXPECT_GT(fast.events[0].t_end, 60.0);
  }
}

// A PE series that does not match is found before the catalogue is cut back, and vice versa.
TEST_F(Restart, NothingIsCutWhereOneFileDoesNotFit) {
  const std::string events = "resume yes catalogue pair.csv series pair.pe";
  const std::string again = sheared_state("0.03", events) + "run 1\n";
  for (const auto &[ranks, wrong] : {std::pair(1, "pair.pe"), {2, "pair.csv"}}) {
    SCOPED_TRACE(std::to_string(ranks) + " ranks, " + wrong);
    for (const char *name : {"pair.csv", "pair.pe"}) std::filesystem::remove(path(name));
    ran(fault_read() + fault_shear(events) + "restart 1000 pair.*\nrun 1900\n", {}, ranks);
    const std::string longer = replaced(read_file(path(wrong)), "length = 40\n", "length = 41\n");
    std::ofstream(path(wrong)) << longer;
    const std::string catalogue = read_file(path("pair.csv")), series = read_file(path("pair.pe"));
    ASSERT_GT(series.size(), 1500u * 16);
    refused({wrong, "length", "41", "40"}, again, {{"state", "pair.1000"}}, ranks);
    EXPECT_TRUE(read_file(path("pair.csv")) == catalogue);
    EXPECT_TRUE(read_file(path("pair.pe")) == series);
  }
}

// Plates take over velocities that are set before the first run, whatever looked at the system.
TEST_F(Restart, PlatesTakeVelocitiesThatAreSetBeforeTheFirstRun) {
  const auto moved = [](const std::string &before) {
    const Result r =
        ran(fault_read() +
            "fix move blocks lsm/nve\nfix plates all lsm/plates lower upper stress 0.006\n" +
            before + "velocity all set 0 0.01 0\nthermo_style custom step ke f_plates[10]\n" +
            "thermo_modify norm no format float %.17g\nrun 10\n");
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
      refused({"time step", "from 0.03 to", "one."}, shear + change, {{"files", files}},
              files[0] == 'c' ? 2 : 1);
    }

  const Variables variables = {{"state", "one.restart"}};
  ran(shear + "write_restart one.restart\n", {{"files", "catalogue one.csv series one.pe"}});
  const std::string catalogue = read_file(path("one.csv")), series = read_file(path("one.pe"));
  for (const char *files : {"catalogue one.csv", "series one.pe"})
    refused({"one.", "'dt' is '0.0299", "expected '0.0149"},
            sheared_state("0.015", std::string("resume yes ") + files) + "run 100\n", variables);
  EXPECT_TRUE(read_file(path("one.csv")) == catalogue);
  EXPECT_TRUE(read_file(path("one.pe")) == series);
}

TEST_F(Ranks, ThermoAndFirstEventsAgree) {
  const std::string script = "variable prefix index one\n" + fault_read() +
                             fault_shear("catalogue ${prefix}.csv") + "thermo 100\nrun 1500\n";
  const Result one = ran(script);
  const auto events = unit::read_catalogue(path("one.csv")).events;
  EXPECT_GE(events.size(), 1u);
  each_split([&](Variables variables, int ranks) {
    variables.emplace_back("prefix", "several");
    EXPECT_LT(thermo_difference(one, ran(script, variables, ranks), compared), 1e-9);
    unit::expect_same_events(events, unit::read_catalogue(path("several.csv")).events, 1e-9);
  });
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
    const Result ours = ran(script + run, {}, ranks);
    const Result theirs =
        ran(script + "neigh_modify exclude group nobody nobody\n" + run, {}, ranks);
    EXPECT_GT(ours.last("c_events[11]"), 0.0);
    EXPECT_EQ(thermo_difference(ours, theirs, compared), 0.0) << ranks;
    const auto listed = ours.lines_with("Total # of neighbors");
    ASSERT_EQ(listed.size(), 1u);
    EXPECT_EQ(listed[0].find("= 0"), std::string::npos) << listed[0];
    EXPECT_EQ(listed, theirs.lines_with("Total # of neighbors"));
  }
}

TEST_F(Ranks, NorDoesThatOfAPackingOnAGrid) {
  // The lines of a data file are in the order of the owners of the particles, and the first word of
  // a bond is its place in this order.
  const auto lines = [this](int ranks) {
    const Result r = ran(fault_start() +
                             "create_lsm_fault length 41 width 20 seed 3 failures 500 faces none "
                             "seeds grid linkratio 1.05 loose keep\n"
                             "bond_style zero\nbond_coeff *\n"
                             "write_data grid.data nocoeff nofix\n",
                         {}, ranks);
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
  const Result own = ran(script, {{"step", "0"}});
  const Result raised = ran(script, {{"step", "0.12"}});
  EXPECT_LT(own.last("f_move[2]"), 0.12);
  EXPECT_GE(raised.last("f_move[2]"), 0.12);
  const Result two = ran(script, {{"step", "0.12"}}, 2);
  EXPECT_NEAR(two.last("f_move[2]"), raised.last("f_move[2]"), 1e-9);
  EXPECT_EQ(raised.lines_with("time step 0.12 stable with any contacts: ").size(), 1u);
}
