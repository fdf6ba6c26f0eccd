// SPDX-License-Identifier: GPL-2.0-or-later
// What LAMMPS users expect: runs in pieces, data files, local computes.
#include "fault_scene.h"
#include "read_catalogue.h"

using namespace physics;

using Output = Fault;

TEST_F(Output, RunAfterRunEqualsOneRun) {
  for (const char *mus : {"0.6", "0.8"}) {
    const std::string start = fault_read() + fault_shear("") + "thermo 200\n";
    const Result one = ran(start + "run 2000\n", {{"mus", mus}});
    const Result many = ran(start + "run 400\nrun 400\nrun 0\nrun 1200\n", {{"mus", mus}});
    EXPECT_EQ(one.last("Step"), many.last("Step"));
    EXPECT_LT(thermo_difference(one.tail(1), many.tail(1), compared), 1e-9);
    EXPECT_EQ(one.last("c_events"), many.last("c_events"));
  }
}

// LAMMPS' quit destroys no style.
TEST_F(Output, QuitWritesWhatIsHeldBack) {
  for (int ranks : {1, 2}) {
    const std::string shear =
        fault_read() +
        fault_shear(
            "catalogue ${prefix}.csv ruptures ${prefix}.ruptures unfinished yes interval "
            "200 slipping 0.1") +
        "thermo 1000\nrun 2950\n";
    ran(shear, {{"prefix", "end"}}, ranks);
    ran(shear + "quit\n", {{"prefix", "quit"}}, ranks);
    ran(shear + "uncompute events\nquit\n", {{"prefix", "gone"}}, ranks);
    for (const char *file : {".csv", ".ruptures"}) {
      const std::string whole = read_file(path(std::string("end") + file));
      EXPECT_EQ(read_file(path(std::string("quit") + file)), whole) << file;
      EXPECT_EQ(read_file(path(std::string("gone") + file)), whole) << file;
    }
    const auto ruptures = unit::read_catalogue(path("end.ruptures")).events;
    ASSERT_FALSE(ruptures.empty());
    EXPECT_GE(ruptures.back().step_end, 2800) << "no rupture was open at the end";
  }
}

// fix halt, or a time limit, makes LAMMPS leave out all further runs.
TEST_F(Output, PiecesEndWithAFixHalt) {
  const Result r = run_text(fault_read() + fault_shear("") +
                            "variable steps equal step\nfix enough all halt 10 v_steps >= 250 "
                            "error soft\nlsm_run 500 prefix halted every 100\n");
  EXPECT_EQ(r.exit_code, 75);
  EXPECT_EQ(r.lines_with("Stopped at step 250 by a time limit or fix halt").size(), 1u);
  EXPECT_TRUE(std::filesystem::exists(path("halted.restart.250")));
  EXPECT_FALSE(std::filesystem::exists(path("halted.restart.end")));

  const Result before = run_text(fault_read() + fault_shear("") +
                                 "variable steps equal step\nfix enough all halt 10 v_steps >= 50 "
                                 "error soft\nrun 100\nlsm_run 500 prefix before every 100\n");
  EXPECT_EQ(before.exit_code, 75);
  EXPECT_EQ(before.lines_with("stopped before its first step").size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(path("before.restart.50")));
}

// Contacts across the borders of ranks, of which four meet, and of the box keep their springs.
TEST_F(Output, RestartFileBetweenRunsChangesNothing) {
  for (int ranks : {1, 4}) {
    const std::string start = fault_read() + fault_shear("") + "thermo 500\nrun 2000\n";
    const Result without = ran(start + "run 2000\n", {}, ranks);
    const Result with = ran(start + "write_restart between.restart\nrun 2000\n", {}, ranks);
    const Result resumed = ran(
        fault_restart("between.restart") + fault_shear("") + "thermo 500\nrun 2000\n", {}, ranks);
    EXPECT_LT(thermo_difference(without, with, compared), 1e-9) << ranks << " ranks";
    EXPECT_LT(thermo_difference(without.tail(5), resumed, compared), 1e-9) << ranks << " ranks";
  }
}

TEST_F(Output, DataFileRoundTrip) {
  const std::string energies = R"(
fix               move blocks lsm/nve
compute           events all lsm/events
variable          links equal bonds
thermo_style      custom step atoms bonds c_events[5] c_events[6] c_events[7] ke
thermo_modify     norm no format float %.17g
run               0
)";
  for (const char *newton : {"on", "off"}) {
    const Result before =
        ran(fault_read() + energies + "write_data again.data\n", {{"newton", newton}});
    const std::string again = fault_start() + R"(
bond_style        lsm/linked
pair_style        lsm/friction
read_data         again.data
pair_coeff        * * off
pair_coeff        3 4 1.0 1.0 0.6
)" + fault_groups() + energies;
    const Result after = ran(again, {{"newton", newton}}, 2);
    EXPECT_GT(before.last("c_events[6]"), 0.0);
    EXPECT_GT(before.last("c_events[7]"), 0.0);
    EXPECT_LT(thermo_difference(
                  before, after,
                  {"Atoms", "Bonds", "c_events[5]", "c_events[6]", "c_events[7]", "KinEng"}),
              1e-12);
  }
}

TEST_F(Output, LocalComputesGiveTheRecordedEnergies) {
  const std::string script = fault_read() + fault_shear("") + R"(
compute           links all bond/local engpot force dist
compute           contacts all pair/local eng force dist
compute           link_sum all reduce sum c_links[1] inputs local
compute           contact_sum all reduce sum c_contacts[1] inputs local
compute           pe all pe
variable          pe equal c_pe
thermo_style      custom step c_events[5] c_events[6] c_events[7] c_events[8] c_link_sum c_contact_sum v_pe
thermo_modify     norm no format float %.17g
thermo            500
run               1000
)";
  for (const auto &[ranks, newton] : {std::pair(1, "on"), {2, "off"}}) {
    const Result r = ran(script, {{"newton", newton}}, ranks);
    const double link = r.last("c_events[6]");
    const double contact = r.last("c_events[7]") + r.last("c_events[8]");
    EXPECT_GT(r.last("c_events[8]"), 0.0);
    EXPECT_NEAR(r.last("c_link_sum"), link, 1e-10 * link);
    EXPECT_NEAR(r.last("c_contact_sum"), contact, 1e-10 * contact);
    EXPECT_NEAR(r.last("v_pe"), link + contact, 1e-10 * (link + contact));
  }
}
