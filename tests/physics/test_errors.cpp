// SPDX-License-Identifier: GPL-2.0-or-later
// Mistakes in the input, and runs that go bad.
#include "fault_scene.h"
#include "lsm_catalogue.h"

using namespace physics;

using BadInput = Fault;
using BlowUp = Fault;

TEST_F(BadInput, TimeStepAboveTheLimitIsRefusedWithBothNumbers) {
  const std::string script = fault_read() + fault_shear("catalogue none.csv") + "run 10\n";
  const Result r = run_text(script, {{"dt", "0.3"}});
  EXPECT_TRUE(failed_with(r, {"Time step 0.3", "stability limit 0."}));
  const Result below = run_text(script, {{"dt", "0.05"}});
  EXPECT_TRUE(succeeded(below));
}

TEST_F(BadInput, OneLineOfError) {
  struct Case {
    const char *lines;
    std::vector<std::string> parts;
  };
  const std::vector<Case> cases = {
      {"fix a all lsm/nve viscous 1", {"viscous", "viscosity"}},
      {"fix a all lsm/nve viscosity -1", {"viscosity", "-1"}},
      {"fix a all lsm/nve viscosity", {"viscosity", "value"}},
      {"bond_coeff 1 -2.0", {"stiffness", "-2"}},
      {"bond_coeff 1 1.0 0.9", {"ratio", "0.9"}},
      {"bond_coeff 1", {"bond_coeff"}},
      {"pair_coeff 3 4 -1 1 0.6", {"k is -1"}},
      {"pair_coeff 3 4 1 1 -0.6", {"mu", "-0.6"}},
      {"pair_coeff 3 4 1 1 0.6 0.5", {"mu_static", "0.5"}},
      {"compute a all lsm/events lamda 0.9", {"lamda", "lambda"}},
      {"compute a all lsm/events lambda 1.5", {"lambda", "1.5"}},
      {"compute a all lsm/events picker best", {"picker", "best", "exponential"}},
      {"compute a all lsm/events series f.pe", {"series"}},
      {"fix a all lsm/plates lower nowhere stress 1", {"nowhere"}},
      {"fix a all lsm/plates lower upper velocity 1", {"stress", "position"}},
      {"fix a all lsm/plates lower upper stress -1", {"stress", "-1"}},
      {"fix a all lsm/plates lower upper stress 1 pressure 2", {"pressure"}},
      {"group none empty\nfix a all lsm/plates lower none stress 1\nrun 1", {"none", "particles"}},
      {"fix b all lsm/nve\nfix a all lsm/plates lower upper stress 1\nrun 1", {"fix b"}},
      {"create_lsm_fault length 40 width 20 seed 1", {"box"}}};
  for (const auto &one : cases)
    EXPECT_TRUE(failed_with(run_text(fault_read() + one.lines + "\n"), one.parts)) << one.lines;

  const std::vector<Case> geometry = {
      {"length 40 width 20 seed 1 rmin 1 rmax 0.5", {"rmin", "rmax"}},
      {"length -40 width 20 seed 1", {"length", "-40"}},
      {"length 40 width 20", {"seed", "missing"}},
      {"length 40 width 20 seed 1 colour 3", {"colour"}},
      {"length 40 width 20 seed -1", {"seed", "-1"}}};
  for (const auto &one : geometry)
    EXPECT_TRUE(failed_with(run_text(fault_start() + "create_lsm_fault " + one.lines + "\n"),
                            one.parts))
        << one.lines;
}

TEST_F(BadInput, OneLineOfErrorOnTwoRanks) {
  EXPECT_TRUE(failed_with(run_text(fault_read() + "fix a all lsm/nve viscosity -1\n", {}, 2),
                          {"viscosity", "-1"}));
  EXPECT_TRUE(failed_with(
      run_text(fault_read() + fault_shear("") + "run 10\n", {{"dt", "0.3"}}, 2),
      {"stability limit"}));
}

TEST_F(BlowUp, StopsWithAMessageAndACleanCatalogue) {
  std::string script = fault_read() + fault_shear("catalogue blown.csv series blown.pe text emergency "
                                                  "blown.restart");
  const std::string fix = "viscosity ${viscosity}\n";
  script.replace(script.find(fix), fix.size(), "viscosity ${viscosity} dtcheck off\n");
  for (int ranks : {1, 2})
    for (const char *dt : {"0.13", "0.2"}) {
      const Result r =
          run_text(script + "thermo 100\nthermo_modify lost ignore\nrun 20000\n", {{"dt", dt}}, ranks);
      EXPECT_NE(r.exit_code, 0);
      const auto lines = r.lines_with("ERROR");
      ASSERT_GE(lines.size(), 1u) << r.output;
      EXPECT_TRUE(lines[0].find("strained") != std::string::npos ||
                  lines[0].find("not finite") != std::string::npos)
          << lines[0];
      // the strict reader refuses anything that is not finite
      EXPECT_NO_THROW(LSM::read_catalogue(path("blown.csv")));
    }
}

TEST_F(BlowUp, LedgerOutOfBalanceStopsTheRun) {
  // a tolerance far below what the time step allows
  const Result r = run_text(fault_read() + fault_shear("catalogue off.csv tolerance 1e-12 check 100 "
                                                       "emergency off.restart") +
                            "run 2000\n");
  EXPECT_TRUE(failed_with(r, {"ledger", "off.restart"}));
  EXPECT_TRUE(std::filesystem::exists(path("off.restart")));
  EXPECT_NO_THROW(LSM::read_catalogue(path("off.csv")));
}
