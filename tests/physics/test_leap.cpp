// SPDX-License-Identifier: GPL-2.0-or-later
// Leaps between events: model time, unchanged results without leaps, restart, ranks, refusals.
#include <cmath>

#include "fault_scene.h"
#include "read_catalogue.h"
#include "read_series.h"

using namespace physics;

using Leap = Fault;

// Slow plates on the settled fault; LEAP stands for the fix under test.
static std::string slow(const std::string &leap,
                        const std::string &columns = "c_events[5] f_plates[8]") {
  return fault_read() + R"(
variable          velocity index 0.0005
variable          viscosity index 0.02
fix               move blocks lsm/nve viscosity ${viscosity}
fix               plates all lsm/plates lower upper stress 0.006 damping ${viscosity} velocity ${velocity}
)" + leap +
         R"(
compute           events all lsm/events ledger yes overwrite yes catalogue ${prefix}.csv
thermo_style      custom step time )" +
         columns + R"(
thermo_modify     norm no format float %.17g
thermo            100
)";
}

// With neither a faster velocity nor viscosity there are no leaps, whether or not the blocks are at
// rest.
TEST_F(Leap, WithoutAFasterVelocityNothingChanges) {
  for (const char *velocity : {"0.0005", "0"}) {
    const Variables variables = {{"prefix", "nothing"}, {"dt", "0.03"}, {"velocity", velocity}};
    const Result without = ran(slow("") + "run 1500\n", variables);
    const Result with =
        ran(slow("fix leap all lsm/leap plates fast 0.0005 calm 1 rest 1e-9 viscosity 0.1\n") +
                "run 1500\n",
            variables);
    ASSERT_EQ(without.thermo.size(), with.thermo.size());
    EXPECT_EQ(without.last("f_plates[8]") > 0.01, velocity != std::string("0"));
    for (std::size_t n = 0; n < with.thermo.size(); ++n)
      EXPECT_EQ(without.thermo[n], with.thermo[n]) << velocity;
    EXPECT_EQ(with.lines_with("nothing to leap over").size(),
              velocity == std::string("0") ? 1u : 0u);
  }
}

// At 1.99 times the velocity of the plates, the slip of a fault that follows them would end leaps.
TEST_F(Leap, WarnsOfPlatesThatAreHardlyFaster) {
  for (const auto &[settings, warns] : {std::pair{"fast 0.00199", 1u},
                                        {"fast 0.002", 0u},
                                        {"fast 0.001 slip 0.99", 1u},
                                        {"fast 0.001 slip 1", 0u},
                                        {"fast 0.0005", 0u}}) {
    const Result r =
        ran(slow(std::string("fix leap all lsm/leap plates ") + settings + "\n") + "run 0\n",
            {{"prefix", "hardly"}, {"dt", "0.03"}});
    EXPECT_EQ(r.lines_with("less than twice the driving velocity").size(), warns) << settings;
  }
}

TEST_F(Leap, PlatesMayMoveTheOtherWay) {
  const Result r =
      ran(slow("fix leap all lsm/leap plates fast 0.005 calm 3 viscosity 0.1 ramp 6 look 0.6\n",
               "f_plates[1] f_plates[8] f_leap f_leap[4] c_events[13] f_plates") +
              "run 3000\n",
          {{"prefix", "back"}, {"dt", "0.03"}, {"velocity", "-0.0005"}});
  EXPECT_GT(r.last("f_leap[4]"), 10.0);  // it leapt
  EXPECT_LT(r.last("f_plates[8]"), -0.3);
  for (const auto &row : r.thermo)
    EXPECT_NEAR(row.at("f_plates[8]"),
                -2 * 0.0005 * (row.at("f_leap") - r.thermo.front().at("f_leap")), 1e-12);
  EXPECT_GT(r.last("f_plates"), 1e-3);  // the plates do work
  EXPECT_LT(std::fabs(r.last("c_events[13]")), 2e-3 * r.last("f_plates"));
}

// The displacement of the plates is their velocity times the model time. Without slip, PE at the
// same model time is the same, the more exactly the slower the plates are during leaps.
TEST_F(Leap, LoadsAsSlowPlatesDo) {
  const std::string columns =
      "c_events[5] f_plates[8] f_leap f_leap[1] f_leap[2] c_events[13] f_plates";
  const auto loaded = [&](const std::string &fast, double steps) {
    // Friction is so high that nothing slips.
    const Result r = ran(
        slow("fix leap all lsm/leap plates calm 3 rest 1e9 viscosity 0 ramp 6 fast " + fast + "\n",
             columns) +
            "run " + text(steps) + "\n",
        {{"prefix", "loaded"}, {"dt", "0.04"}, {"mus", "100"}, {"velocity", "0.00001"}});
    EXPECT_NEAR(r.last("f_leap[1]"), std::stod(fast) / 1e-5, 1e-9);
    EXPECT_EQ(r.last("f_leap[2]"), 2.0);
    EXPECT_NEAR(r.last("f_plates[8]") / (2e-5 * r.last("f_leap")), 1.0, 1e-11);
    EXPECT_LT(std::fabs(r.last("c_events[13]")), 2e-3 * std::fabs(r.last("f_plates")));
    return r;
  };
  const Result slowest = loaded("0.0001", 9000), faster = loaded("0.0004", 2400);
  // Returns PE at a displacement that both runs reach.
  const auto pe_at = [](const Result &r, double displacement) {
    for (std::size_t n = 1; n < r.thermo.size(); ++n) {
      const double a = r.thermo[n - 1].at("f_plates[8]"), b = r.thermo[n].at("f_plates[8]");
      if (a <= displacement && displacement < b)
        return r.thermo[n - 1].at("c_events[5]") +
               (displacement - a) / (b - a) *
                   (r.thermo[n].at("c_events[5]") - r.thermo[n - 1].at("c_events[5]"));
    }
    ADD_FAILURE() << "displacement " << displacement << " is not reached";
    return 0.0;
  };
  const double begin = slowest.thermo.front().at("c_events[5]");
  const double a = pe_at(slowest, 0.06) - begin, b = pe_at(faster, 0.06) - begin;
  EXPECT_GT(a, 1e-3);
  EXPECT_NEAR(b / a, 1.0, 0.05);
}

// A velocity-strengthening fault creeps at the stress that belongs to slow plates,
// sigma (mu + a ln(v / v0)), also during leaps, as a law that depends on time gets the model time.
TEST_F(Leap, LawsOfTimeAreGivenModelTime) {
  const std::string law =
      "pair_style none\nrun 0\npair_style lsm/friction rate-state-ageing\npair_coeff * * off\n"
      "pair_coeff 3 4 1.0 1.0 mu 0.2 a 0.1 b 0 dc 1e-3 v0 1e-3\n";
  const auto stress = [&](const std::string &velocity, const std::string &leap,
                          const std::string &steps) {
    std::string scene = slow(leap, "c_events[5] f_plates[3] f_plates[8]");
    scene.insert(scene.find("\nfix               move"), "\n" + law);
    const Result r = ran(scene + "run " + steps + "\n",
                         {{"prefix", "time"}, {"dt", "0.04"}, {"velocity", velocity}});
    double sum = 0.0, n = 0.0;
    for (const auto &row : r.thermo) {
      if (row.count("f_plates[8]") == 0 || row.at("f_plates[8]") < 0.5 ||
          row.at("f_plates[8]") > 1.1)
        continue;
      sum += row.at("f_plates[3]");
      n += 1.0;
    }
    EXPECT_GT(n, 30.0);
    return std::fabs(sum / n);
  };
  const double slowly = stress("0.0005", "", "30000"), fast = stress("0.002", "", "8000"),
               leapt =
                   stress("0.0005", "fix leap all lsm/leap plates fast 0.002 slip 3\n", "10000");
  EXPECT_GT(fast - slowly, 0.06);  // a ln 4 = 0.14 if all contacts are parallel to the fault
  EXPECT_NEAR(leapt, slowly, 0.25 * (fast - slowly));
}

// With `grow` the factor is at most 1 + model time since the leap began / grow.
TEST_F(Leap, FactorGrowsWithTheTimeOfTheLeap) {
  const Result r =
      ran(slow("fix leap all lsm/leap plates fast 0.005 calm 3 rest 1e9 ramp 0 grow 50 look "
               "0.3\n",
               "f_leap f_leap[1] f_leap[2]") +
              "thermo 10\nrun 10000\n",
          {{"prefix", "grow"}, {"dt", "0.03"}, {"mus", "100"}, {"velocity", "0.00005"}});
  double began = NAN;
  for (const auto &row : r.thermo) {
    if (row.at("f_leap[2]") != 2.0) continue;
    if (std::isnan(began)) began = row.at("f_leap") - 0.3;
    EXPECT_LE(row.at("f_leap[1]"), 1.01 + (row.at("f_leap") - began) / 50) << row.at("Step");
    EXPECT_GE(row.at("f_leap[1]"), std::min(99.9, 0.98 * (1 + (row.at("f_leap") - began) / 50)));
  }
  EXPECT_NEAR(r.last("f_leap[1]"), 100.0, 1e-9);
}

TEST_F(Leap, RestartAndRanks) {
  const std::string leap =
      "fix leap all lsm/leap plates fast 0.005 calm 3 viscosity 0.1 ramp 6 look 0.6\n";
  const std::string columns =
      "c_events c_events[5] f_plates[8] f_leap f_leap[1] f_leap[3] f_leap[4]";
  const std::string head = slow(leap, columns);
  const Result whole =
      ran(head + "restart 1333 half.*\nrun 3000\n", {{"prefix", "whole"}, {"dt", "0.03"}});
  EXPECT_GT(whole.last("f_leap[4]"), 10.0);                            // it leapt
  EXPECT_LT(whole.last("f_leap[4]"), 0.99 * whole.last("f_leap[3]"));  // and it stopped
  EXPECT_GT(whole.last("f_leap"), 100.0);
  for (const auto &row : whole.thermo)
    EXPECT_NEAR(row.at("f_plates[8]"),
                2 * 0.0005 * (row.at("f_leap") - whole.thermo.front().at("f_leap")), 1e-12);

  const std::string again = replaced(head, "read_data", "\n", "read_restart half.1333");
  const Result second = ran(again + "run 1667\n", {{"prefix", "second"}, {"dt", "0.03"}});
  const std::vector<std::string> same = {"f_leap",    "f_leap[1]",   "f_leap[3]",
                                         "f_leap[4]", "f_plates[8]", "c_events[5]"};
  expect_near(second, whole, same, 1e-7);

  // The run may continue with another velocity, and no trace of the former one is left.
  const Result slower = ran(replaced(again, "fast 0.005", "fast 0.0005") + "run 300\n",
                            {{"prefix", "slower"}, {"dt", "0.03"}});
  EXPECT_EQ(slower.thermo.front().at("f_leap[1]"), 1.0);
  EXPECT_NEAR(slower.last("f_leap") - slower.thermo.front().at("f_leap"), 300 * 0.03, 1e-9);

  for (int ranks : {2, 4})
    expect_near(ran(head + "run 3000\n", {{"prefix", "ranks"}, {"dt", "0.03"}}, ranks), whole, same,
                1e-6);
}

// The plates leap only after the motion left by an event has decayed: the kinetic energy of the
// blocks must be below `rest` times that of a uniform shear between plates as fast as in leaps.
// That of the plates, 0.14 of the limit here, does not count, as they are always driven.
TEST_F(Leap, LeapsBeginAtRest) {
  const double rest = 0.06, fast = 0.005;
  const Result r = ran(
      slow(
          "fix leap all lsm/leap plates fast 0.005 slip 0.1 calm 0.6 rest 0.06 viscosity 0.3 ramp 6 "
          "look 0.6\ncompute kinetic blocks ke\nvariable mass equal mass(all)\n",
          "f_leap[1] f_leap[2] c_kinetic v_mass") +
          "thermo 20\nrun 12000\n",
      {{"prefix", "rest"}, {"dt", "0.03"}, {"velocity", "0.001"}});
  const double limit = rest * 0.5 * r.last("v_mass") * fast * fast / 3.0;
  int begun = 0, waits = 0;
  for (std::size_t n = 1; n < r.thermo.size(); ++n) {  // one row for each check by the fix
    if (r.thermo[n - 1].at("f_leap[2]") != 1.0) continue;
    const double kinetic = r.thermo[n].at("c_kinetic");
    if (r.thermo[n].at("f_leap[2]") == 2.0) {
      ++begun;
      EXPECT_LE(kinetic, limit * (1.0 + 1e-9)) << r.thermo[n].at("Step");
    } else if (r.thermo[n].at("f_leap[2]") == 1.0) {
      ++waits;
      EXPECT_GT(kinetic, limit * (1.0 - 1e-9)) << r.thermo[n].at("Step");
    }
  }
  EXPECT_GE(begun, 5);
  EXPECT_GE(waits, 50);
}

// Slip between two checks is found, though a run ends between them, and times are those of the
// steps, however late they are processed.
TEST_F(Leap, PiecesOfARunAndBlocksOfSamplesChangeNothing) {
  const std::string scene = slow(
      "fix leap all lsm/leap plates fast 0.005 slip 0.1 calm 0.6 rest 0.06 viscosity 0.3 ramp "
      "6 look 0.6\n",
      "f_leap f_leap[6] c_events");
  const auto variables = [](const char *prefix) {
    return Variables{{"prefix", prefix}, {"dt", "0.03"}, {"velocity", "0.001"}};
  };
  const Result whole = ran(scene + "run 8000\n", variables("whole"));
  EXPECT_GE(whole.last("f_leap[6]"), 2.0);  // leaps that ended
  const Result short_runs =
      ran(scene + "variable n loop 571\nlabel again\nrun 14 post no\nnext n\njump SELF again\n",
          variables("short"));
  EXPECT_NEAR(short_runs.last("f_leap[6]"), whole.last("f_leap[6]"), 1.0);
  EXPECT_NEAR(short_runs.last("f_leap"), whole.last("f_leap"), 0.1 * whole.last("f_leap"));
  ran(replaced(scene, "ledger yes", "ledger yes block 15000") + "thermo 0\nrun 8000\n",
      variables("late"));
  EXPECT_EQ(read_file(path("late.csv")), read_file(path("whole.csv")));
}

// A series has the time of each sample, ruptures have model times, and both continue unchanged.
TEST_F(Leap, SeriesAndRupturesHaveModelTimes) {
  const std::string recorded =
      slow("fix leap all lsm/leap plates fast 0.005 calm 3 viscosity 0.1 ramp 6 look 0.6\n",
           "c_events c_events[5] f_plates[8] f_leap") +
      "variable go index no\nuncompute events\n"
      "compute events all lsm/events resume ${go} catalogue ${prefix}.csv series ${prefix}.pe "
      "ruptures ${prefix}.ruptures sides below above faces lowerface upperface slipping 1 "
      "interval 10\nthermo 1\n";
  const Result r = ran(recorded + "run 4000\nwrite_restart samples.restart\nrun 4000\n",
                       {{"prefix", "samples"}, {"dt", "0.03"}});
  std::map<double, double> model;  // time of each step
  for (const auto &row : r.thermo) model[row.at("Step")] = row.at("f_leap");

  const auto series = unit::read_series(path("samples.pe"));
  EXPECT_EQ(series.size(), 8001U);
  for (const unit::Sample &one : series)
    ASSERT_NEAR(one.time, model.at(static_cast<double>(one.step)), 1e-12 * one.time) << one.step;
  EXPECT_GT(series.back().time, 1.5 * 8000 * 0.03);  // it leapt

  const auto drops = unit::read_catalogue(path("samples.csv")),
             ruptures = unit::read_catalogue(path("samples.ruptures"));
  ASSERT_GT(drops.events.size(), 2u);
  EXPECT_EQ(drops.info.find("leap")->substr(0, 10), "fast 0.005");
  ASSERT_GE(ruptures.events.size(), 3u);
  // Slip is compared with the largest velocity of the plates.
  EXPECT_EQ(*ruptures.info.find("driving"), LSM::text::number(0.01));
  for (const auto *events : {&drops.events, &ruptures.events})
    for (const auto &e : *events) {
      EXPECT_NEAR(e.t_start, model.at(static_cast<double>(e.step_start)), 1e-12 * e.t_start);
      EXPECT_NEAR(e.t_end, model.at(static_cast<double>(e.step_end)), 1e-12 * e.t_end);
    }

  // The second half, repeated from the restart file, gives the same bytes.
  const std::string whole_series = read_file(path("samples.pe")),
                    whole = read_file(path("samples.csv")),
                    whole_ruptures = read_file(path("samples.ruptures"));
  ran(replaced(recorded, "read_data", "\n", "read_restart samples.restart") + "run 4000\n",
      {{"prefix", "samples"}, {"dt", "0.03"}, {"go", "yes"}});
  EXPECT_EQ(read_file(path("samples.pe")), whole_series);
  EXPECT_EQ(read_file(path("samples.csv")), whole);
  EXPECT_EQ(read_file(path("samples.ruptures")), whole_ruptures);

  // Adding or removing fix lsm/leap while files are open, and a slip history, are refused.
  refused({"fix lsm/leap is gone"}, recorded + "run 1\nunfix leap\nrun 1\n",
          {{"prefix", "gone"}, {"dt", "0.03"}});
  refused({"history does not work with fix lsm/leap"},
          recorded +
              "thermo_style one\nuncompute events\ncompute events all lsm/events sides below "
              "above faces lowerface upperface history h.slip\nrun 1\n",
          {{"prefix", "history"}, {"dt", "0.03"}});
}

TEST_F(Leap, Refusals) {
  const struct {
    std::string lines;
    std::string says;
  } cases[] = {{"fix leap all lsm/leap\n", "expects 'fix ID group lsm/leap plates-ID"},
               {"fix leap all lsm/leap move\n", "'move' is not the ID of a fix lsm/plates"},
               {"fix leap all lsm/leap plates fast 0.0001\n",
                "fast is 0.0001, but must be at least the driving velocity 0.0005"},
               {"fix leap all lsm/leap plates fast 0.01\nfix more all lsm/leap plates fast 0.01\n",
                "More than one fix lsm/leap"}};
  for (const auto &one : cases)
    refused({one.says}, slow(one.lines) + "run 1\n", {{"prefix", "refused"}, {"dt", "0.03"}});
  refused({"the time step changed from 0.03 to 0.02"},
          slow("fix leap all lsm/leap plates fast 0.01\n") + "run 1\ntimestep 0.02\nrun 1\n",
          {{"prefix", "refused"}, {"dt", "0.03"}});
}
