// SPDX-License-Identifier: GPL-2.0-or-later
// Errors in the input, and runs that fail.
#include "fault_scene.h"
#include "files/output_claim.h"
#include "read_catalogue.h"
#include "read_series.h"
#include "same_events.h"

using namespace physics;

using BadInput = Fault;
using BlowUp = Fault;

TEST_F(BadInput, TimeStepAboveTheLimitIsRefusedWithBothNumbers) {
  const std::string script = fault_read() + fault_shear("catalogue none.csv") + "run 10\n";
  refused({"Time step 0.3", "stability limit 0."}, script, {{"dt", "0.3"}});
  refused({"stability limit 0."}, script, {{"dt", "0.3"}}, 2);
  ran(script, {{"dt", "0.05"}});
}

TEST_F(BadInput, OneLineOfError) {
  struct Case {
    const char *lines;
    std::vector<std::string> parts;
  };
  const std::vector<Case> cases = {
      {"fix a all lsm/nve viscosity -1", {"viscosity", "-1"}},
      {"fix a all lsm/nve viscosity/type 2 -0.5", {"viscosity/type", "-0.5", ">= 0"}},
      {"bond_coeff 1 -2.0", {"stiffness", "-2"}},
      {"bond_coeff 1 1.0 0.9", {"ratio", "0.9"}},
      {"bond_coeff 1", {"bond_coeff"}},
      {"pair_coeff 3 4 -1 1 0.6", {"k is -1"}},
      {"pair_coeff 3 4 1 1 -0.6", {"mu", "-0.6"}},
      {"pair_coeff 3 4 1 1 0.6 0.5", {"mu_static", "0.5"}},
      {"pair_coeff 3 4 1 1", {"pair_coeff I J k kt mu [mu_static]"}},
      {"pair_style lsm/friction coulomb offset step", {"offset", "onset"}},
      {"pair_style lsm/friction cuolomb", {"cuolomb", "coulomb, slip-weakening"}},
      {"compute a all lsm/events lambda 1.5", {"lambda", "1.5"}},
      {"compute a all lsm/events memory 1e300\nrun 1", {"lambda"}},  // 1 to the last digit
      {"compute a all lsm/events picker best", {"picker", "best", "exponential"}},
      {"fix a_record all lsm/nve\ncompute a all lsm/events", {"a_record", "in use"}},
      {"fix a all lsm/plates lower nowhere stress 1", {"nowhere"}},
      {"fix a all lsm/plates lower upper velocity 1", {"stress", "position"}},
      {"fix a all lsm/plates lower upper stress -1", {"stress", "-1"}},
      {"group none empty\nfix a all lsm/plates lower none stress 1\nrun 1", {"none", "particles"}},
      {"fix b all lsm/nve\nfix a all lsm/plates lower upper stress 1\nrun 1", {"fix b"}},
      {"create_lsm_fault length 40 width 20 seed 1", {"box"}}};
  for (const auto &one : cases) refused(one.parts, fault_read() + one.lines + "\n");

  const std::vector<Case> geometry = {
      {"length 40 width 20 seed 1 rmin 1 rmax 0.5", {"rmin", "rmax"}},
      {"length -40 width 20 seed 1", {"length", "-40"}},
      {"length 40 width 20", {"seed", "missing"}},
      {"length 40 width 20 seed 1 linkgap 0.05", {"linkgap = 0.05", "less than rmin/10"}},
      {"length 40 width 20 seed 1 linkratio 1.5", {"linkratio = 1.5", "1 to 1.25"}}};
  for (const auto &one : geometry)
    refused(one.parts, fault_start() + "create_lsm_fault " + one.lines + "\n");
}

// As LAMMPS' own messages do; those of a run quote no line, as their cause is earlier.
TEST_F(BadInput, MessagesPointToTheWord) {
  const std::string line = "Last input line: fix a all lsm/nve viscosity ";
  const Result word = run_text(fault_read() + "fix a all lsm/nve viscosity -1\n");
  EXPECT_NE(word.output.find(line + "-1 \n" + std::string(line.size(), ' ') + "^^\n"),
            std::string::npos)
      << word.output;
  const Result run = run_text(fault_read() + fault_shear("") + "run 10\n", {{"dt", "0.3"}});
  EXPECT_TRUE(failed_with(run, {"stability limit"}));
  EXPECT_EQ(run.output.find("Last input line"), std::string::npos) << run.output;
}

TEST_F(BlowUp, StopsWithAMessageAndACleanCatalogue) {
  const std::string script =
      replaced(fault_read() + fault_shear("catalogue blown.csv series blown.pe emergency "
                                          "blown.restart nonpositive yes picker literal"),
               "viscosity ${viscosity}\n", "viscosity ${viscosity} dtcheck off\n");
  for (int ranks : {1, 2})
    for (const char *dt : {"0.13", "0.2"}) {
      for (const char *file : {"blown.csv", "blown.pe"}) std::filesystem::remove(path(file));
      const Result r = run_text(script + "thermo 100\nthermo_modify lost ignore\nrun 20000\n",
                                {{"dt", dt}}, ranks);
      EXPECT_NE(r.exit_code, 0);
      const auto lines = r.lines_with("ERROR");
      ASSERT_GE(lines.size(), 1u) << r.output;
      EXPECT_TRUE(lines[0].find("strained") != std::string::npos ||
                  lines[0].find("not finite") != std::string::npos)
          << lines[0];
      // The strict readers refuse anything that is not finite; the catalogue agrees with the
      // series.
      const auto found = unit::read_catalogue(path("blown.csv")).events;
      const auto series = unit::read_series(path("blown.pe"));
      for (std::size_t n = 0; n < series.size(); ++n)
        EXPECT_EQ(series[n].step, static_cast<std::int64_t>(n));
      LSM::PickerSettings settings;
      settings.reading = LSM::PickerReading::literal;
      unit::expect_same_events(found, unit::picked(series, settings));
      // With a step far above the limit the run fails before the first event.
      EXPECT_GT(series.size(), 5U) << dt;
      EXPECT_TRUE(found.size() > 0 || dt == std::string("0.2"));
    }
}

TEST_F(BadInput, StiffnessThatFixAdaptMakesNegative) {
  refused({"k of type 1 is -1", "> 0"}, fault_read() + fault_shear("") +
                                            "variable a equal -1.0\n"
                                            "fix a all adapt 1 bond lsm/linked k 1 v_a\nrun 3\n");
}

// If the name of an output leads, in any spelling, to the file of another one, nothing is written.
TEST_F(BadInput, OneFileForTwoOutputs) {
  const std::string shear = fault_read() + fault_shear("emergency e.state ${files}");
  std::ofstream(path("there.csv")) << "somebody's data\n";
  std::filesystem::create_hard_link(path("there.csv"), path("hard.csv"));
  std::filesystem::create_symlink("one.csv", path("soft.csv"));
  struct Case {
    const char *files, *more;
    std::vector<std::string> parts;
  };
  const std::vector<Case> cases = {
      {"catalogue one.csv ruptures one.csv", "", {"catalogue one.csv and ruptures one.csv"}},
      {"catalogue there.csv series hard.csv", "", {"the same file"}},
      {"catalogue one.csv series e.state", "", {"e.state", "the same file"}},
      {"catalogue one.csv", "restart 100 one.csv two.csv", {"restart one.csv", "the same file"}},
      {"catalogue one.csv", "log soft.csv", {"catalogue one.csv: this run writes that file"}},
      {"catalogue one.csv", "dump d all atom 100 one.csv", {"this run writes that file"}},
      {"catalogue one.csv",
       "compute r all lsm/events catalogue one.csv overwrite yes",
       {"one.csv", "this run"}}};
  for (const auto &one : cases) {
    std::filesystem::remove(path("one.csv"));
    refused(one.parts, shear + one.more + "\nrun 10\n", {{"files", one.files}});
    EXPECT_EQ(read_file(path("there.csv")), "somebody's data\n") << one.files;
  }
  ran(shear + "run 10\n", {{"files", "catalogue /dev/null series /dev/null"}});
}

TEST_F(BadInput, AnotherRunWritesTheFile) {
  const std::string shear = fault_read() + fault_shear("catalogue held.csv series held.pe");
  for (int ranks : {1, 2})
    for (const char *file : {"held.csv", "held.pe"}) {
      const LSM::FileLock held(path(file));
      refused({file, "is being written by another run"}, shear + "run 10\n", {}, ranks);
      EXPECT_FALSE(std::filesystem::exists(path("held.csv"))) << file;
    }
  ran(shear + "run 10\nuncompute events\n");
  EXPECT_FALSE(std::filesystem::exists(path("held.csv.new")));
}

// Builds new neighbour lists from time to time, in the middle of a step.
static const std::string often = "neigh_modify delay 0 every 10 check no\n";

// A tolerance that no step exceeds never stops the run, whether it is checked in every step or only
// when lists are built; a tenth of the error of the worst step does.
TEST_F(BlowUp, LedgerIsCheckedForWholeSteps) {
  for (int ranks : {1, 2})
    for (const char *viscosity : {"0", "0.02"}) {
      if (ranks == 2 && viscosity == std::string("0.02")) continue;
      SCOPED_TRACE(std::string(viscosity) + ", ranks " + std::to_string(ranks));
      const std::string start =
          fault_read() + often + fault_shear("${check} emergency off.restart");
      const Variables free = {{"viscosity", viscosity}, {"check", "check 1000"}};
      const Result all = ran(start + "thermo 1\nrun 1000\n", free, ranks);
      double worst = 0.0;
      for (const auto &row : all.thermo) {
        const double scale = row.at("c_events[11]") + row.at("c_events[12]") +
                             row.at("c_events[9]") + std::fabs(row.at("c_events[5]"));
        worst = std::max(worst, std::fabs(row.at("c_events[13]")) / scale);
      }
      ASSERT_GT(worst, 0.0);
      for (const char *every : {"1", "7"}) {
        if (ranks == 2 && every[0] == '7') continue;
        std::filesystem::remove(path("off.restart"));
        ran(start + "thermo 10000\nrun 1000\n",
            {{"viscosity", viscosity},
             {"check", "tolerance " + text(1.01 * worst) + " check " + every}},
            ranks);
        EXPECT_FALSE(std::filesystem::exists(path("off.restart")));
      }
      refused({"ledger", "off.restart"}, start + "thermo 10000\nrun 1000\n",
              {{"viscosity", viscosity}, {"check", "tolerance " + text(0.1 * worst) + " check 1"}},
              ranks);
    }
}

// The restart file of a stopped run holds a complete step, whatever has stopped it.
TEST_F(BlowUp, EmergencyRestartHoldsAWholeStep) {
  const std::string dump =
      "write_dump all custom ${file} id x y vx vy modify sort id format float %.17g\n";
  // Particles in restart files are inside the periodic box, which they need not be between two
  // neighbour lists.
  const std::string wrap = "displace_atoms all move 0 0 0\n";
  for (const auto &[ranks, why] : {std::pair<int, std::string>{1, "tolerance 1e-12 check 100"},
                                   {1, "tolerance 1e-12 check 133"},
                                   {1, "strainlimit 0.1 check 1000000"},
                                   {2, "tolerance 1e-12 check 133"}}) {
    // Without viscosity, fix lsm/nve defers the second half of a step.
    const bool by_ledger = why[0] == 't';
    const std::string viscosity = by_ledger ? "0.02" : "0", velocity = by_ledger ? "0.005" : "0.05";
    SCOPED_TRACE(why + ", ranks " + std::to_string(ranks));
    std::filesystem::remove(path("off.restart"));
    const Result r = run_text(fault_read() + often +
                                  fault_shear("catalogue off.csv emergency off.restart " + why) +
                                  "thermo 10000\nrun 4000\n",
                              {{"viscosity", viscosity}, {"velocity", velocity}}, ranks);
    ASSERT_TRUE(failed_with(r, {by_ledger ? "ledger" : "strained", "off.restart", "at step "}));
    const std::string line = r.lines_with("ERROR")[0];
    const std::string step = std::to_string(std::stoi(line.substr(line.find("at step ") + 8)));
    ASSERT_GT(std::stoi(step), 10);
    ASSERT_TRUE(std::filesystem::exists(path("off.restart")));
    ran(fault_read() + often + fault_shear("") + "thermo 10000\nrun " + step + "\n" + wrap + dump,
        {{"file", "whole.dump"}, {"viscosity", viscosity}, {"velocity", velocity}}, ranks);
    ran(fault_restart("off.restart") + dump, {{"file", "off.dump"}}, ranks);
    const std::string whole = read_file(path("whole.dump")), off = read_file(path("off.dump"));
    EXPECT_GT(whole.size(), 10000u);
    EXPECT_TRUE(whole == off) << "step " << step;
  }
}

// No file with events is replaced without `overwrite yes`; what else may be in the way is tested by
// tests/unit/test_event_stream.cpp.
TEST_F(BadInput, OlderFilesAreKept) {
  const std::string shear = fault_shear("${files}"), again = "run 1000\nwrite_restart kept.state\n",
                    both = "catalogue kept.csv series kept.pe";
  const std::string first = replaced(fault_read() + shear, "overwrite yes ", "") + again,
                    restarted = replaced(fault_restart("kept.state") + "timestep 0.03\n" + shear,
                                         "overwrite yes ", "") +
                                again;
  for (int ranks : {1, 2}) {
    for (const char *file : {"kept.csv", "kept.pe"}) std::filesystem::remove(path(file));
    ran(first, {{"files", both}}, ranks);
    const std::string catalogue = read_file(path("kept.csv")), series = read_file(path("kept.pe"));
    ASSERT_GT(series.size(), 10000u);
    const auto kept = [&](const std::string &script, const std::string &files,
                          const std::vector<std::string> &parts) {
      refused(parts, script, {{"files", files}}, ranks);
      EXPECT_EQ(read_file(path("kept.csv")), catalogue);
      EXPECT_EQ(read_file(path("kept.pe")), series);
      for (const char *file : {"new.csv", "kept.csv.new"})
        EXPECT_FALSE(std::filesystem::exists(path(file))) << file;
    };
    kept(first, "catalogue new.csv series kept.pe", {"kept.pe", "exists", "overwrite yes"});
    // The same holds for a run from a restart file without `resume yes`.
    kept(restarted, both, {"kept.csv", "exists", "resume yes"});
    kept(first, "catalogue new.csv series no/folder/s.pe", {"no/folder/s.pe"});
    ran(restarted, {{"files", both + " overwrite yes"}}, ranks);
    EXPECT_NE(read_file(path("kept.pe")), series);
  }
}
