// SPDX-License-Identifier: GPL-2.0-or-later
// Slip, ruptures and places of drops of compute lsm/events: prescribed slip, a short fault,
// restart.
#include <cmath>
#include <numeric>
#include <tuple>

#include "facing_spheres.h"
#include "fault_scene.h"
#include "read_catalogue.h"
#include "read_series.h"
#include "same_events.h"
#include "slow_ruptures.h"

using namespace physics;

using Ruptures = Fault;
using Located = Lmp;

/// Twenty upper discs (IDs 21 to 40), each right above a lower one (IDs 1 to 20) with an overlap of
/// 0.01. The period is 40.
static std::string upper_and_lower(const std::string &compute) {
  return facing_spheres(20, 0, "dimension         2\nboundary          p f p",
                        "0 40 -10 10 -0.5 0.5") +
         R"(compute           events all lsm/events sides below above faces lowerface upperface overwrite yes )" +
         compute + "\nthermo_style      custom step c_events c_events[2] c_events[5]\n";
}

/// Moves the upper disc of each given bin along x at its velocity for the given number of steps.
static std::string moved(const std::vector<std::pair<int, double>> &bins, int steps) {
  std::string script, after;
  for (const auto &[bin, velocity] : bins) {
    const std::string name = "m" + std::to_string(bin);
    script += "group " + name + " id " + std::to_string(21 + bin) + "\nfix " + name + " " + name +
              " move linear " + text(velocity) + " 0 NULL\n";
    after += "unfix " + name + "\ngroup " + name + " delete\n";
  }
  return script + "run " + std::to_string(steps) + "\n" + after;
}

TEST_F(Ruptures, ParticlesThatAreNewHaveNotMoved) {
  const std::string script =
      upper_and_lower("history new.slip driving 0.001 bin 2 interval 10 modulus 0.5");
  const Result r =
      ran(script + moved({{3, 0.01}}, 55) +
          "create_atoms 2 single 30.5 8 0\nset atom 41 diameter 2\nset atom 41 mass 1\n"
          "group upperface type 2\nrun 45\n");
  for (const LSM::SlipRecord &record : unit::read_history(path("new.slip")).records)
    for (const float slip : record.row.slip) EXPECT_LT(std::fabs(slip), 0.011f);
}

TEST_F(Ruptures, OfATriclinicBoxAreRefused) {
  const std::string script = upper_and_lower("history none.slip driving 0.001 bin 2 modulus 0.5");
  refused({"lsm/events", "triclinic", "history"}, script + "change_box all triclinic\nrun 1\n");
}

// The driving velocity is 0.001, so that bins slip above 0.005; an interval lasts 1.
TEST_F(Ruptures, PrescribedSlipIsFoundOnAnyNumberOfRanks) {
  const std::string script =
      upper_and_lower(
          "ruptures ${name}.csv history ${name}.slip driving 0.001 slipping 5 "
          "interval 10 "
          "bin 2 gap 0 pause 1 modulus 0.5 quiet 4 block 7") +
      moved({{19, 0.02}, {0, 0.02}, {5, 0.002}}, 10) +              // 1
      moved({{19, 0.02}, {0, 0.02}, {5, 0.002}, {10, 0.03}}, 10) +  // 2
      moved({{1, 0.04}, {10, 0.03}, {5, 0.002}}, 10) +              // 3
      moved({{12, -0.05}, {5, 0.002}}, 10) +  // 4: 10 and 12 are not neighbours
      moved({{5, 0.002}}, 60);
  const double close = 1e-6;
  std::vector<LSM::Rupture> first;
  const auto check = [&](Variables variables, int ranks) {
    variables.emplace_back("name", "moved");
    ran(script, variables, ranks);
    const auto catalogue = unit::read_catalogue<LSM::Rupture>(path("moved.csv"));
    ASSERT_EQ(catalogue.events.size(), 3u);
    const auto &a = catalogue.events[0], &b = catalogue.events[1], &c = catalogue.events[2];
    // Both ended with step 30; the one that began first comes first.
    EXPECT_EQ(a.step_start, 0);
    EXPECT_EQ(a.step_end, 30);
    EXPECT_EQ(b.step_start, 10);
    EXPECT_EQ(b.step_end, 30);
    EXPECT_EQ(c.step_start, 30);
    EXPECT_EQ(c.step_end, 40);
    EXPECT_NEAR(a.t_end, 3.0, 1e-12);
    // The rupture crosses the seam: bins 19, 0 and 1 slipped by 0.04 each.
    EXPECT_NEAR(a.slip_moment, 0.5 * 2.0 * 3.0 * 0.04, close * 0.12);
    EXPECT_NEAR(a.mean_slip, 0.04, close * 0.04);
    EXPECT_NEAR(a.peak_slip, 0.04, close * 0.04);
    EXPECT_NEAR(c.peak_slip, 0.05, close * 0.05);
    EXPECT_EQ(a.rupture_length, 6.0);
    EXPECT_EQ(a.x_begin, 38.0);
    EXPECT_NEAR(std::remainder(a.x_centroid - 1.0, 40.0), 0.0, 1e-3);
    EXPECT_NEAR(b.slip_moment, 0.06, close * 0.06);
    EXPECT_EQ(b.rupture_length, 2.0);
    EXPECT_EQ(b.x_hypocentre, 21.0);
    EXPECT_NEAR(b.x_centroid, 21.0, 1e-9);
    // This slip was against the driving direction.
    EXPECT_NEAR(c.slip_moment, -0.05, close * 0.05);
    // The work of friction is mu fn slip, with fn = 0.0097 during the motion, and half of that in
    // the first of 20 steps.
    EXPECT_NEAR(b.size, 1e-5 * 0.0097 * 0.06 * 0.975, 0.01 * 6e-9);
    // An upper disc that has moved by d is pushed back by fn d / 2, over bins of width 2.
    EXPECT_NEAR(a.stress_drop, 0.5 * 0.01 * 0.04 / 2.0, 0.05 * 1e-4);
    EXPECT_NEAR(c.stress_drop, -0.5 * 0.01 * 0.05 / 2.0, 0.1 * 1.25e-4);
    EXPECT_GT(a.pe_start, a.pe_end);

    // All slip of the fault belongs to ruptures, or is below the velocity, as in bin 5.
    const auto [info, records] = unit::read_history(path("moved.slip"));
    const auto slow = unit::slow_ruptures(info, records);
    EXPECT_NEAR(slow.slip_in_ruptures, 3.0 * 0.04 + 0.06 - 0.05, close * 0.23);
    // The last of the ten intervals belongs to an incomplete record.
    EXPECT_NEAR(slow.slip_elsewhere, 0.018, close * 0.018);
    EXPECT_NEAR(a.slip_moment + b.slip_moment + c.slip_moment, 0.5 * 2.0 * slow.slip_in_ruptures,
                1e-12);

    std::vector<LSM::Rupture> events = catalogue.events;
    if (first.empty()) first = events;
    for (std::size_t n = 0; n < 3; ++n) {
      EXPECT_NEAR(events[n].pe_start, first[n].pe_start, 1e-13 * first[n].pe_start);
      EXPECT_NEAR(events[n].pe_end, first[n].pe_end, 1e-13 * first[n].pe_end);
      events[n].pe_start = first[n].pe_start;
      events[n].pe_end = first[n].pe_end;
    }
    unit::expect_same_events(events, first);
  };
  check({}, 1);
  each_split(check);
}

static const char *const found =
    "ruptures ${prefix}.csv catalogue ${prefix}.drops series ${prefix}.pe history ${prefix}.slip "
    "slipping 2 interval 7 "
    "pause 1.5 quiet 5 resume yes ";

static std::string sheared(const std::string &events) {
  return "variable prefix index whole\n" + fault_read() + fault_shear(events) + "thermo 1000\n";
}

// The trajectory and the drops are those without ruptures, to the last bit, and the ruptures are
// those found by a search through the history.
TEST_F(Ruptures, OfAFaultAreThoseOfItsSlipHistory) {
  ran(sheared("catalogue plain.csv series plain.pe") + "run 6000\n");
  const Result r = ran(sheared(found) +
                           "thermo_style custom step c_events c_events[18] c_events[19] "
                           "c_events[20] f_plates[8]\nthermo_modify format float %.17g\nrun 6000\n",
                       {{"prefix", "found"}});
  EXPECT_TRUE(read_file(path("plain.pe")) == read_file(path("found.pe")));
  const auto plain = unit::read_catalogue(path("plain.csv")).events,
             drops = unit::read_catalogue(path("found.drops")).events;
  ASSERT_GT(plain.size(), 3u);
  unit::expect_same_events(plain, drops);

  const auto catalogue = unit::read_catalogue<LSM::Rupture>(path("found.csv"));
  EXPECT_EQ(r.last("c_events"), static_cast<double>(drops.size()));
  EXPECT_EQ(r.last("c_events[18]"), static_cast<double>(catalogue.events.size()));
  EXPECT_EQ(r.last("c_events[19]"), catalogue.events.back().size);
  const auto [info, records] = unit::read_history(path("found.slip"));
  const unit::SlowRuptures slow = unit::slow_ruptures(info, records);
  std::vector<LSM::Rupture> expected;
  std::size_t large = 0;
  for (const auto &e : slow.events)
    if (e.size > 0.0) {
      expected.push_back(e);
      if (e.rupture_length > 3.0) ++large;
    }
  EXPECT_GT(large, 5u);
  unit::expect_same_events(catalogue.events, expected, 1e-9, 1e-9, 40.0);
}

/// Part of a record's steps that is between two steps.
static double part_within(const LSM::SlipRecord &record, std::int64_t from, std::int64_t to) {
  const auto inside = std::min(to, record.step_end) - std::max(from, record.step_begin);
  return inside <= 0 ? 0.0
                     : static_cast<double>(inside) /
                           static_cast<double>(record.step_end - record.step_begin);
}

// One definition of slip: what the history has during a drop is that of the drop, and what ruptures
// have and what slips too slowly is all of the history. The work of friction is that of the steps
// of a drop, which a history with intervals of one step has as well.
TEST_F(Ruptures, DropsRupturesAndHistoryAgreeOnTheSlip) {
  for (int ranks : {1, 2}) {
    SCOPED_TRACE(ranks);
    const std::string prefix = "agree" + std::to_string(ranks);
    ran(sheared(found + std::string("quiet 1 ")) + "run 6000\n", {{"prefix", prefix}}, ranks);
    const auto [info, records] = unit::read_history(path(prefix + ".slip"));
    ran(sheared(replaced(found, "interval 7", "interval 1") + "quiet 1 ") + "run 6000\n",
        {{"prefix", prefix + "steps"}}, ranks);
    const auto each_step = unit::read_history(path(prefix + "steps.slip")).records;
    const double factor = info.ruptures.modulus * info.grid.width;
    const auto slip_between = [&records = records](std::int64_t from, std::int64_t to,
                                                   std::size_t bin) {
      double slip = 0.0;
      for (const LSM::SlipRecord &record : records)
        slip += part_within(record, from, to) * static_cast<double>(record.row.slip[bin]);
      return slip;
    };
    const auto work_between = [&each_step](std::int64_t from, std::int64_t to) {
      double work = 0.0;
      for (const LSM::SlipRecord &record : each_step)
        work += part_within(record, from, to) *
                std::accumulate(record.row.work.begin(), record.row.work.end(), 0.0);
      return work;
    };
    const auto bins = records.front().row.slip.size();
    double whole = 0.0;
    for (std::size_t b = 0; b < bins; ++b) whole += factor * slip_between(0, 6000, b);

    const auto drops = unit::read_catalogue<LSM::Drop>(path(prefix + ".drops"));
    EXPECT_EQ(*drops.info.find("modulus"), LSM::text::number(info.ruptures.modulus));
    ASSERT_GT(drops.events.size(), 3u);
    double in_drops = 0.0;
    for (const auto &e : drops.events) {
      if (e.step_end > records.back().step_end) continue;  // in the interval that is not complete
      double moment = 0.0, most = 0.0;
      for (std::size_t b = 0; b < bins; ++b) {
        const double slip = slip_between(e.step_start, e.step_end, b);
        moment += factor * slip;
        most = std::max(most, std::fabs(slip));
      }
      EXPECT_NEAR(e.slip_moment, moment, 1e-9 * most) << "drop " << e.id;
      const double work = work_between(e.step_start, e.step_end);
      EXPECT_GT(work, 0.0);
      EXPECT_NEAR(e.friction_work, work, 1e-7 * work) << "drop " << e.id;  // a history has floats
      const double until = work_between(0, e.step_end);
      EXPECT_NEAR(e.friction_total, until, 1e-7 * until) << "drop " << e.id;
      EXPECT_NEAR(e.peak_slip, most, 1e-9 * most) << "drop " << e.id;
      in_drops += e.slip_moment;
    }
    const unit::SlowRuptures slow = unit::slow_ruptures(info, records);
    double in_ruptures = 0.0;
    for (const auto &e : slow.events) in_ruptures += e.slip_moment;
    EXPECT_NEAR(factor * (slow.slip_in_ruptures + slow.slip_elsewhere), whole, 1e-9 * whole);
    EXPECT_LE(in_ruptures, factor * slow.slip_in_ruptures * (1.0 + 1e-9));
    // Most slip is in large events, which are both drops and ruptures.
    EXPECT_GT(in_drops, 0.5 * in_ruptures);
    EXPECT_LT(in_drops, whole);
    EXPECT_LT(in_ruptures, whole);
  }
}

// Whatever else is in contact, the fault slips as far as the plates move, and its work is the
// friction in the ledger less what is lost within the blocks. After a slip of half the period,
// discs behind the faces touch the other block, too.
TEST_F(Ruptures, SlipAndWorkOfTheFaultAddUp) {
  const std::string across =
      "pair_coeff 1 2 1.0 1.0 0.6\npair_coeff 1 4 1.0 1.0 0.6\n"
      "pair_coeff 2 3 1.0 1.0 0.6\n";
  const struct {
    const char *contacts;
    std::string coefficients;
    bool within;
  } scenes[] = {{"smooth", "pair_coeff 1*4 1*6 1.0 1.0 0\n", false},
                {"all", "pair_coeff 1*4 1*6 1.0 1.0 0.6\n", true}};
  for (const auto &scene : scenes) {
    SCOPED_TRACE(scene.contacts);
    const Result r =
        ran("variable prefix index " + std::string(scene.contacts) + "\n" + fault_read() +
            scene.coefficients + across + "pair_coeff 3 4 1.0 1.0 0.6\n" + fault_shear(found) +
            "thermo_style custom step c_events[11] c_events[17] f_plates[8]\n"
            "thermo_modify format float %.17g\nthermo 100000\nrun 140000\n");
    double slip = 0.0, work = 0.0;
    const auto records = unit::read_history(path(std::string(scene.contacts) + ".slip")).records;
    for (const auto &record : records)
      for (std::size_t n = 0; n < record.row.slip.size(); ++n) {
        slip += static_cast<double>(record.row.slip[n]);
        work += static_cast<double>(record.row.work[n]);
      }
    slip /= static_cast<double>(records.front().row.slip.size());
    const double plates = r.last("f_plates[8]"), friction = r.last("c_events[11]"),
                 within = r.last("c_events[17]");
    EXPECT_GT(plates, 20.0);
    EXPECT_NEAR(slip, plates, 0.01 * plates);
    EXPECT_NEAR(work, friction - within, 1e-4 * friction);
    if (scene.within)
      EXPECT_GT(within, 0.001 * friction);
    else
      EXPECT_EQ(within, 0.0);
  }
}

// Runs that go on with their ruptures are tested on a plane.
TEST_F(Ruptures, BeginAfterARestartFileWithoutThem) {
  // A compute without ruptures has left neither a state nor a file to continue.
  const std::string state = fault_read() + fault_shear("catalogue bare.csv") +
                            "thermo 1000\nrun 100\nwrite_restart bare\n";
  ran(state);
  const std::string from = "variable prefix index found\n" + fault_restart("bare");
  ran(sheared(found) + "run 100\n", {{"prefix", "there"}});
  refused({"exists", "no slip of compute events"}, from + fault_shear(found) + "run 10\n",
          {{"prefix", "there"}});
  ran(from + fault_shear(found) + "run 100\n", {{"prefix", "begun"}});
  EXPECT_EQ(unit::read_history(path("begun.slip")).info.grid.step0, 100);
}

TEST_F(Ruptures, OneLineOfError) {
  const auto with = [](const std::string &compute) { return upper_and_lower(compute) + "run 0\n"; };
  for (const auto &[compute, parts] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"gap 2", {"keyword gap needs ruptures or history"}},
           {"location yes unfinished yes", {"keyword unfinished needs ruptures or history"}},
           {"ruptures r.csv modulus 0.4", {"needs fix lsm/plates, or the keyword driving"}},
           {"ruptures r.csv driving 0.001",
            {"needs bond style lsm/linked, or the keyword modulus"}},
           {"ruptures r.csv sides below nobody driving 0.001 modulus 1",
            {"sides has the group nobody, which does not exist"}},
           {"ruptures r.csv driving 0.001 modulus 1\ngroup below clear",
            {"sides has the group below, which has no particles"}},
           {"ruptures r.csv sides below below", {"sides needs two different groups, got below"}},
           {"ruptures r.csv faces nobody above driving 0.001 modulus 1",
            {"faces has the group nobody, which does not exist"}},
           {"ruptures r.csv driving 0.001 modulus 1 history missing/h.slip",
            {"missing/h.slip", "No such file"}}})
    refused(parts, with(compute));
  for (const auto &[given, asked, missing] :
       {std::tuple("location yes", "location", "faces"),
        std::tuple("history h.slip faces lowerface upperface", "history", "sides"),
        std::tuple("ruptures r.csv sides below above", "ruptures", "faces")})
    refused({asked, "needs the keyword " + std::string(missing) +
                        " with the groups below and above the fault"},
            fault_read() + fault_shear("") + "uncompute events\ncompute one all lsm/events " +
                given + "\nthermo_style one\nrun 0\n");
  refused({"history: file h.slip exists"},
          with("driving 0.001 modulus 1 history h.slip overwrite no") +
              "thermo_style one\nuncompute events\ncompute events all lsm/events "
              "sides below above faces lowerface upperface driving 0.001 "
              "modulus 1 history h.slip\nrun 0\n");
}

// Discs that move off those below them reduce PE; moving back raises it, which ends the event.
static std::string located(const std::string &more = "") {
  return upper_and_lower(
             "catalogue located.csv location yes bin 2 fraction 0.05 lambda 0 modulus 0.5\n" +
             more) +
         moved({}, 10) +                                              // at rest
         moved({{19, 0.03}, {0, 0.04}, {1, 0.01}, {7, 0.001}}, 20) +  // 7 is below the fraction
         moved({{19, -0.03}, {0, -0.04}, {1, -0.01}}, 10);
}

TEST_F(Located, MomentCentroidAndLengthOfAPrescribedEvent) {
  for (int ranks : {1, 4}) {
    SCOPED_TRACE(ranks);
    ran(located(), {}, ranks);
    const auto catalogue = unit::read_catalogue<LSM::Drop>(path("located.csv"));
    ASSERT_EQ(catalogue.events.size(), 1u);
    const auto &e = catalogue.events[0];
    EXPECT_EQ(e.step_start, 10);
    EXPECT_EQ(e.step_end, 30);
    // Slips are 0.06, 0.08, 0.02 and 0.002, of bins of width 2.
    EXPECT_NEAR(e.slip_moment, 0.5 * 0.162 * 2.0, 1e-6 * 0.162);
    EXPECT_NEAR(e.peak_slip, 0.08, 1e-6 * 0.08);
    EXPECT_EQ(e.rupture_length, 6.0);
    EXPECT_NEAR(e.x_centroid, 0.55, 0.05);  // the mean place of the slip beside the seam is 0.5
    // The drop is the energy that the springs of the four contacts lost.
    double drop = 0.0;
    for (const double d : {0.06, 0.08, 0.02, 0.002})
      drop += 0.5 * (0.01 * 0.01 - std::pow(2.0 - std::hypot(d, 1.99), 2));
    EXPECT_NEAR(e.size, drop, 1e-3 * drop);
  }
}

// Contacts are recorded once, and each compute sorts them into its own bins.
TEST_F(Located, EachComputeHasItsOwnBins) {
  ran(located());
  const std::string alone = read_file(path("located.csv"));
  ASSERT_EQ(unit::read_catalogue(path("located.csv")).events.size(), 1u);
  for (
      const char *other :
      {"compute other all lsm/events",
       "compute other all lsm/events faces lowerface upperface location yes bin 7 lambda 0 modulus 1",
       "compute other all lsm/events sides below above faces lowerface upperface ruptures other.csv "
       "overwrite yes driving 0.001 modulus 0.5 bin 5"}) {
    ran(located(other));
    EXPECT_EQ(read_file(path("located.csv")), alone) << other;
  }
}

TEST_F(Ruptures, UncomputeLeavesTheOtherCompute) {
  const std::string pe = "compute events all lsm/events overwrite yes catalogue pe.csv\n";
  const std::string other =
      "compute other all lsm/events sides below above faces lowerface upperface overwrite yes "
      "ruptures r.csv\n";
  const std::string fixes =
      fault_read() + fault_shear("") + "uncompute events\nthermo_style custom step ke\n";
  ran(fixes + pe + "run 1000\nrun 2000\n");
  const std::string alone = read_file(path("pe.csv"));
  ASSERT_GE(unit::read_catalogue(path("pe.csv")).events.size(), 3u);
  for (const std::string &both : {pe + other, other + pe})
    for (const char *words : {"", " pre no"})
      for (int ranks : {1, 2}) {
        if (ranks == 2 && !*words) continue;
        ran(fixes + both + "run 1000\nuncompute other\nrun 2000" + words + "\n", {}, ranks);
        if (ranks == 1) {
          EXPECT_EQ(read_file(path("pe.csv")), alone) << both << words;
        }
      }
}

TEST_F(Ruptures, StepsThatDoNotFollowEachOtherAreRefused) {
  const std::string run = sheared(found) + "run 100\n";
  refused({"the step was 100 and is 1003 now, but ruptures"}, run + "reset_timestep 1003\nrun 10\n",
          {{"prefix", "steps"}});
  const std::string respa = sheared(found) +
                            "unfix move\nunfix plates\nfix move all nve\nrun_style respa 2 4 bond "
                            "1 pair 1\nrun 1\n";
  refused({"ruptures need one force of contacts a step"}, respa, {{"prefix", "respa"}});
  refused({"fixes one and two are both lsm/plates, expected one"},
          sheared(found) +
              "unfix plates\ngroup left id 1:200\ngroup a intersect lower "
              "left\ngroup b subtract lower a\ngroup c intersect upper "
              "left\ngroup d subtract upper c\nfix one all lsm/plates a c "
              "stress 0.006\nfix two all lsm/plates b d stress 0.006\nrun 1\n",
          {{"prefix", "two"}});
}

TEST_F(Ruptures, BoxThatChangesIsRefused) {
  const std::string start = fault_read() + fault_shear("");
  const std::string ruptures =
      "compute r all lsm/events sides below above faces lowerface upperface overwrite yes "
      "ruptures box.csv\n";
  const std::string longer = "change_box all x scale 1.001 remap\nrun 100\n";
  refused({"lsm/events r: the box along x was 0 to 40", "places of events"},
          start + ruptures + "run 100\n" + longer);
  refused({"lsm/events r: fix d changes the box along x, which ruptures cannot follow"},
          start + ruptures + "fix d all deform 1 x scale 1.001 remap x\nrun 100\n");
  refused({"the header of file l.csv"},
          start + "compute l all lsm/events overwrite yes catalogue l.csv\nrun 100\n" + longer);
  ran(start + "run 100\n" + longer);
}
