// SPDX-License-Identifier: GPL-2.0-or-later
// Dashpots of links and contacts (kelvin-voigt): closed forms, order, stability limit, energy, and
// their use in runs.
#include <cmath>
#include <string>
#include <vector>

#include "disc_scene.h"
#include "lmp_runner.h"

using namespace physics;

using Viscosity = Lmp;

namespace {

constexpr double stiffness = 1.5;

/// Two discs of mass 1 that touch and separate with the velocity `apart`.
std::string two_discs(const std::string &apart, bool linked) {
  std::string text = discs({{"-1", "0.3"}, {"1", "0.3"}});
  if (linked) text += "create_bonds single/bond 1 1 2\nbond_style lsm/linked\n";
  return text + "group left id 1\ngroup right id 2\nvelocity left set $(-0.5*" + apart +
         ") 0 0\nvelocity right set $(0.5*" + apart + ") 0 0\n";
}

const char *const two_end = R"(
timestep          ${dt}
fix               move all lsm/nve
variable          s equal x[2]-x[1]-2
variable          limit equal f_move[2]
compute           events all lsm/events ledger yes progress no
thermo_style      custom step v_s v_limit ke c_events[5] c_events[11] c_events[12] c_events[13]
thermo_modify     norm no format float %.17g
run               0
run               $(round(v_end/v_dt):%.0f)
)";

/// Elongation of an oscillator of two masses of 1 that starts at 0 with the given velocity.
double damped(double velocity, double retardation, double t) {
  const double w2 = 2.0 * stiffness, half = 0.5 * w2 * retardation, turn = w2 - half * half;
  const double decay = velocity * std::exp(-half * t);
  if (turn > 0.0) return decay * std::sin(std::sqrt(turn) * t) / std::sqrt(turn);
  return decay * std::sinh(std::sqrt(-turn) * t) / std::sqrt(-turn);
}

std::string linked(const std::string &apart = "0.02") {
  return two_discs(apart, true) +
         "bond_coeff 1 1.5 ${retardation}\npair_style lsm/free\npair_coeff * * 1.0\n" + two_end;
}

}  // namespace

TEST_F(Viscosity, TwoLinkedDiscsAsInTheClosedForm) {
  // underdamped and overdamped
  for (const char *time : {"0.2", "2.0"}) {
    std::vector<double> off, residual;
    for (const double dt : {0.08, 0.04, 0.02}) {
      const Result r = ran(
          linked(),
          {{"dt", text(dt)}, {"end", "3.2"}, {"retardation", "kelvin-voigt " + std::string(time)}});
      off.push_back(r.last("v_s") - damped(0.02, std::stod(time), 3.2));
      residual.push_back(r.last("c_events[13]"));
      EXPECT_GT(r.last("c_events[12]"), 1e-5);
    }
    EXPECT_NEAR(std::log2(off[1] / off[2]), 2.0, 0.15);
    EXPECT_LT(std::fabs(off[2]), 1e-3 * 0.02);
    // relative to the initial energy of the discs, 1e-4
    EXPECT_LT(std::fabs(residual[2]), 5e-3 * 1e-4);
    EXPECT_NEAR(std::log2(residual[1] / residual[2]), 2.0, 0.3);
  }
}

TEST_F(Viscosity, BesideThatOfTheParticles) {
  // With both viscosities, the mass-proportional one adds its rate of decay.
  std::vector<double> off;
  const double t = 3.2, nu = 0.3, time = 0.2;
  const double w2 = 2.0 * stiffness, half = 0.5 * (w2 * time + nu);
  const double turn = std::sqrt(w2 - half * half);
  for (const double dt : {0.04, 0.02}) {
    const Result r = ran(replaced(linked(), "all lsm/nve", "all lsm/nve viscosity 0.3"),
                         {{"dt", text(dt)}, {"end", "3.2"}, {"retardation", "kelvin-voigt 0.2"}});
    off.push_back(r.last("v_s") - 0.02 * std::exp(-half * t) * std::sin(turn * t) / turn);
  }
  EXPECT_LT(std::fabs(off[1]), 1e-3 * 0.02);
  EXPECT_NEAR(std::log2(off[0] / off[1]), 2.0, 0.2);
}

TEST_F(Viscosity, LimitOfTheTimeStepIsSharp) {
  for (const double time : {0.1, 1.0, 20.0}) {
    const double w = std::sqrt(2.0 * stiffness), g = w * w * time;
    const double limit = 2.0 / (std::sqrt(w * w + g * g) + g);
    for (const double share : {0.99, 1.01}) {
      const Variables variables = {{"dt", text(share * limit)},
                                   {"end", text(3000.0 * share * limit)},
                                   {"retardation", "kelvin-voigt " + text(time)}};
      const Result limited = run_text(linked("1e-9"), variables);
      if (share < 1.0) {
        EXPECT_NEAR(limited.last("v_limit"), limit, 1e-6 * limit);
        EXPECT_LT(std::fabs(limited.last("v_s")), 1e-9);
        continue;
      }
      EXPECT_TRUE(failed_with(limited, {"above the stability limit", "kelvin-voigt"}));
      const Result grown = run_text(
          replaced(linked("1e-9"), "all lsm/nve", "all lsm/nve dtcheck off") + "thermo 1\n",
          variables);
      double most = 0.0;
      for (const auto &row : grown.thermo) most = std::max(most, std::fabs(row.at("v_s")));
      EXPECT_TRUE(grown.exit_code != 0 || most > 1e-6) << most;
    }
  }
}

TEST_F(Viscosity, ContactsAsLinksButTheyDoNotPull) {
  // Two discs collide and separate: while they touch they act as a link, with both pair styles.
  for (const char *style :
       {"lsm/free\npair_coeff * * 1.5", "lsm/friction\npair_coeff * * 1.5 1.0 0.5"}) {
    const std::string begin = two_discs("-0.02", false) + "pair_style " + style;
    std::vector<double> off;
    for (const double dt : {0.04, 0.02}) {
      const Result r =
          ran(begin + " kelvin-voigt 0.2\n" + two_end, {{"dt", text(dt)}, {"end", "1.2"}});
      off.push_back(r.last("v_s") - damped(-0.02, 0.2, 1.2));
      EXPECT_LT(std::fabs(r.last("c_events[13]")), 5e-3 * 1e-4);
    }
    // The first step begins with the force of a dashpot that was not there before: order one.
    EXPECT_LT(std::fabs(off[1]), 5e-3 * 0.02) << style;
    EXPECT_GT(std::log2(off[0] / off[1]), 0.8) << style;

    // They separate when the dashpot would exceed the spring, and the remaining energy is kinetic.
    const Result parted =
        ran(begin + " kelvin-voigt 1.0\n" + two_end, {{"dt", "0.01"}, {"end", "8"}});
    EXPECT_GT(parted.last("v_s"), 0.0) << style;
    EXPECT_GT(parted.last("KinEng"), 0.0) << style;
    EXPECT_LT(parted.last("KinEng"), 0.1 * 1e-4) << style;
    EXPECT_NEAR(parted.last("KinEng") + parted.last("c_events[12]"), 1e-4, 2e-3 * 1e-4) << style;
    // Not faster than the dashpot allows: the overlap decreases no faster than exp(-t/time).
    EXPECT_LT(parted.last("v_s"), 0.02 * 8) << style;
  }
}

namespace {

/// A fault whose links and contacts have dashpots.
std::string fault(const std::string &begin = lattice_of_41) {
  return lattice_fault(begin, "f f p", " kelvin-voigt 0.1", " 1.5 kelvin-voigt 0.2",
                       " kelvin-voigt 0.05");
}
const std::vector<std::string> energies = {"KinEng",       "c_events[6]",  "c_events[11]",
                                           "c_events[12]", "c_events[15]", "c_events[16]"};

}  // namespace

TEST_F(Viscosity, RanksAndNewtonAgree) {
  const Result one = ran(fault() + "run 400\n");
  EXPECT_GT(one.last("c_events[11]"), 1e-6);
  EXPECT_GT(one.last("c_events[12]"), 1e-2 * one.last("c_events[11]"));
  EXPECT_LT(std::fabs(one.last("c_events[13]")), 1e-3 * one.last("c_events[11]"));
  each_split([&](const Variables &newton, int ranks) {
    EXPECT_LT(thermo_difference(one, ran(fault() + "run 400\n", newton, ranks), energies), 1e-10);
  });
}

TEST_F(Viscosity, InPiecesAndFromARestartFile) {
  for (const int ranks : {1, 2}) {
    SCOPED_TRACE(std::to_string(ranks) + " ranks");
    const Result whole = ran(fault() + "run 400\n", {}, ranks);
    expect_near(ran(fault() + "run 133\nrun 67\nrun 200\n", {}, ranks), whole, energies, 1e-11);
    ran(fault() + "run 200\nwrite_restart half.restart\n", {}, ranks);
    // Once with the coefficients of the script, once with those of the file.
    const std::string again = fault("read_restart half.restart");
    for (const std::string &script : {again, replaced(again, "bond_style", "variable shear", "")})
      expect_near(ran(script + "run 200\n", {}, ranks), whole, energies, 1e-11);
  }
}

TEST_F(Viscosity, VelocitiesSetBetweenRunsCount) {
  // As in a run that begins with these velocities: no forces of the previous dashpots are left.
  const Variables variables = {{"dt", "0.02"}, {"end", "0.4"}, {"retardation", "kelvin-voigt 0.5"}};
  const Result begun = ran(linked("0.05"), variables);
  const Result changed = ran(linked("0.02") +
                                 "velocity left set -0.025 0 0\nvelocity right set 0.025 0 0\n"
                                 "set atom 1 x -1\nset atom 2 x 1\nrun 20\n",
                             variables);
  EXPECT_NEAR(changed.last("v_s"), begun.last("v_s"), 1e-12);
}

TEST_F(Viscosity, VelocitiesSetBeforeARestartFileCount) {
  // As in a run without a restart file: the former velocities do not matter.
  const std::string set = fault() + "run 200\nvelocity lower set 1e-3 0 0 sum yes units box\n";
  const Result whole = ran(set + "run 5\n");
  const Result written = ran(set + "write_restart set.restart\nrun 5\n");
  const Result rest = ran(fault("read_restart set.restart") + "run 5\n");
  EXPECT_EQ(thermo_difference(whole, written, energies), 0.0);
  expect_near(rest, whole, energies, 1e-11);
}

TEST_F(Viscosity, OtherCommandsKnowIt) {
  const Variables variables = {{"dt", "0.02"}, {"end", "0.4"}, {"retardation", "kelvin-voigt 0.5"}};
  // The force of compute bond/local and the virial include the dashpot.
  std::string script =
      two_discs("0.02", true) +
      "bond_coeff 1 1.5 kelvin-voigt 0.5\npair_style lsm/free\npair_coeff * * 1\n"
      "timestep 0.02\nfix move all lsm/nve\ncompute p all bond/local force\n"
      "compute f all reduce max c_p inputs local\ncompute pull right reduce max fx\n"
      "compute virial all pressure NULL virial\n"
      "variable virial equal c_virial[1]*vol\nvariable r equal x[2]-x[1]\n"
      "thermo_style custom step c_f c_pull v_virial v_r\n"
      "thermo_modify norm no format float %.17g\nrun 30\n";
  const Result r = ran(script, variables);
  EXPECT_GT(std::fabs(r.last("c_pull")), 1e-4);
  EXPECT_NEAR(r.last("c_f"), r.last("c_pull"), 1e-15);
  EXPECT_NEAR(r.last("v_virial"), r.last("c_pull") * r.last("v_r"), 1e-12);

  // Data files contain the retardation time.
  const Result data = ran(linked() + "write_data viscous.data\n", variables);
  EXPECT_NE(read_file(path("viscous.data")).find("1 1.5 kelvin-voigt 0.5"), std::string::npos);

  // A minimisation ignores the dashpots, and the run after it has them again.
  const auto minimized = [&](const std::string &time) {
    Variables with = variables;
    with.back().second = time;
    return ran(linked() +
                   "uncompute events\nthermo_style custom step v_s pe\n"
                   "displace_atoms right move 0.1 0 0\nminimize 0 1e-12 100 100\n",
               with);
  };
  const Result with = minimized("kelvin-voigt 0.5"), without = minimized("1000");
  EXPECT_NEAR(with.last("v_s"), 0.0, 1e-9);
}

TEST_F(Viscosity, UnderHybridStyles) {
  const Variables variables = {{"dt", "0.02"}, {"end", "2"}, {"retardation", "kelvin-voigt 0.5"}};
  const Result plain = ran(linked(), variables);
  std::string script = replaced(linked(), "bond_style lsm/linked", "bond_style hybrid lsm/linked");
  script = replaced(script, "bond_coeff 1 1.5", "bond_coeff 1 lsm/linked 1.5");
  script = replaced(script, "pair_style lsm/free\npair_coeff * * 1.0",
                    "pair_style hybrid/overlay lsm/free zero 1.0\npair_coeff * * zero\n"
                    "pair_coeff * * lsm/free 1.0");
  const Result hybrid = ran(script, variables);
  EXPECT_LT(thermo_difference(plain, hybrid, {"v_s", "KinEng", "c_events[12]"}), 1e-14);
}

TEST_F(Viscosity, WrongInputIsNamed) {
  const auto with = [&](const std::string &words, const std::string &fix = "") {
    std::string script = linked();
    if (!fix.empty()) script = replaced(script, "fix               move all lsm/nve", fix);
    return run_text(script, {{"dt", "0.02"}, {"end", "0.2"}, {"retardation", words}});
  };
  EXPECT_TRUE(failed_with(with("kelvin-voigt -1"), {"kelvin-voigt is -1", ">= 0"}));
  EXPECT_TRUE(failed_with(with("kelvin-voigt 0.1", "fix move all nve\nvariable x index 0"),
                          {"kelvin-voigt need fix lsm/nve"}));
  EXPECT_TRUE(
      failed_with(with("kelvin-voigt 0.1", "fix LSM_VELOCITY all nve\nfix move all lsm/nve"),
                  {"LSM_VELOCITY must be of style LSM_VELOCITY"}));
}
