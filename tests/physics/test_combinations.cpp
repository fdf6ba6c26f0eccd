// SPDX-License-Identifier: GPL-2.0-or-later
// Styles of the package combined with others of LAMMPS: each combination works, or one line
// explains why it does not.
#include <cstdlib>

#include "disc_scene.h"
#include "lmp_runner.h"
#include "read_catalogue.h"

using namespace physics;

using Hybrid = Lmp;
using BetweenRuns = Lmp;
using Refused = Lmp;
using Works = Lmp;

namespace {

/// Two discs of types 1 (fixed) and 2 in contact, which are sheared against each other.
std::string shear_contact(
    const std::string &pair = "pair_style lsm/friction\npair_coeff * * 1.0 1.0 0.6\n") {
  return discs({{"0", "0"}, {"0", "1.9"}}, 1, 2) + "set atom 2 type 2\n" + pair + R"(
bond_style        lsm/linked
bond_coeff        1 1.0
timestep          0.01
group             top id 2
)";
}

std::string recorded(const std::string &options = "ledger yes") {
  return "compute events all lsm/events " + options + "\n" + disc_columns;
}

}  // namespace

// ---- hybrid styles ----

TEST_F(Hybrid, PairsThatAreOffDoNotTouch) {
  // As in stock LAMMPS, 'none' reverts '* *'.
  const std::string run = "fix move all lsm/nve\n" + recorded() + "thermo 50\nrun 50\n";
  for (const std::string &style : {std::string("lsm/free"), std::string("lsm/friction")}) {
    const std::string all = " " + style + (style == "lsm/free" ? " 1.0\n" : " 1.0 1.0 0.6\n");
    const std::pair<std::string, std::string> ways[] = {
        {"hybrid " + style + " lj/cut 1.0\npair_coeff 1 *" + all +
             "pair_coeff 2 2 lj/cut 0.0 1.0\n",
         "pair_coeff 1 2 " + style + " off\n"},
        {"hybrid/overlay " + style + " zero 1.0\npair_coeff * *" + all + "pair_coeff 1 1 zero\n",
         "pair_coeff 1 2 none\n"}};
    for (const auto &[on, off] : ways) {
      EXPECT_GT(ran(shear_contact("pair_style " + on) + run).last("c_events[7]"), 0.0) << on;
      const Result none = ran(shear_contact("pair_style " + on + off) + run);
      EXPECT_EQ(none.last("c_events[7]"), 0.0) << on;
      EXPECT_EQ(none.last("KinEng"), 0.0) << on;
    }
  }
}

namespace {

/// Three discs in a row; the first link is harmonic, the second lsm/linked.
std::string hybrid_bonds() {
  return discs({{"0", "0"}, {"2.0", "0"}, {"4.2", "0"}}, 2) + R"(
create_bonds      single/bond 1 1 2
create_bonds      single/bond 2 2 3
bond_style        hybrid harmonic lsm/linked
bond_coeff        1 harmonic 0.5 1.0
bond_coeff        2 lsm/linked 1.0
pair_style        lsm/free
pair_coeff        1 1 1.0
variable          dt index 0.01
timestep          ${dt}
fix               move all lsm/nve
)";
}

}  // namespace

TEST_F(Hybrid, TimeStepIsCheckedWithLinksUnderBondHybrid) {
  refused({"Time step 3", "limit"}, hybrid_bonds() + "run 1\n", {{"dt", "3"}});
  const Result r = ran(hybrid_bonds() + "run 1\nprint \"limit = $(f_move[2]:%.17g)\"\n");
  // For one link of stiffness 1 between two masses of 1, w^2 = 2.
  EXPECT_LE(r.value("limit"), std::sqrt(2.0));
  EXPECT_GT(r.value("limit"), 0.94 * std::sqrt(2.0));
  // The message names what the check leaves out.
  EXPECT_EQ(r.lines_with("WARNING: Fix lsm/nve").size(), 1u) << r.output;
  EXPECT_NE(r.output.find("bond harmonic"), std::string::npos);
}

TEST_F(Hybrid, ForeignBondsAreNamedAndDoNotCountAsStrain) {
  // The rest length of the harmonic bond is 1, half the sum of the radii.
  const Result r =
      ran(hybrid_bonds() + recorded("strainlimit 0.3 check 1 ledger yes") + "thermo 10\nrun 100\n");
  EXPECT_EQ(r.lines_with("WARNING: Compute lsm/events").size(), 1u) << r.output;
  const auto lines = r.lines_with("WARNING: Compute lsm/events");
  ASSERT_GE(lines.size(), 1u);
  EXPECT_NE(lines[0].find("bond harmonic"), std::string::npos) << lines[0];
  EXPECT_NEAR(r.thermo.front().at("c_events[6]"), 0.5 * 0.2 * 0.2, 1e-14);

  // The strain of links counts with bond_style hybrid, too.
  refused({"strained by"},
          hybrid_bonds() + recorded("strainlimit 0.05 check 1 ledger yes") + "run 100\n");
}

TEST_F(Hybrid, BreakableLinksUnderBondHybrid) {
  const std::string script = replaced(hybrid_bonds(), "2 lsm/linked 1.0", "2 lsm/linked 1.0 1.05") +
                             recorded("strainlimit 10 ledger yes") + "thermo 5\nrun 20\n";
  for (int ranks : {1, 2}) {
    const Result r = ran(script, {}, ranks);
    EXPECT_EQ(r.last("Bonds"), 1.0);
    EXPECT_NEAR(r.last("c_events[14]"), 0.5 * 0.2 * 0.2, 1e-14);
  }
}

TEST_F(Hybrid, TwoPairStylesOfThePackageAreBothRecordedAndChecked) {
  // Contacts between types 1 and 1 are lsm/free, those between 1 and 2 lsm/friction.
  const std::string scene = discs({{"0", "0"}, {"0", "1.9"}, {"5", "0"}, {"5", "1.8"}}, 1, 2) + R"(
set               atom 2 type 2
variable          dt index 0.01
pair_style        hybrid lsm/free lsm/friction
pair_coeff        1 1 lsm/free 1.0
pair_coeff        1 2 lsm/friction 1.0 1.0 0.6
pair_coeff        2 2 lsm/friction off
timestep          ${dt}
fix               move all lsm/nve
)";
  const Result r = ran(scene + recorded() + "thermo 10\nrun 100\n");
  EXPECT_NEAR(r.thermo.front().at("c_events[7]"), 0.5 * (0.1 * 0.1 + 0.2 * 0.2), 1e-14);
  EXPECT_NEAR(r.last("c_events[7]") + r.last("c_events[8]"), r.last("PotEng"), 1e-14);
  EXPECT_LT(std::fabs(r.last("c_events[13]")), 1e-5);
  EXPECT_TRUE(r.lines_with("WARNING: Compute lsm/events").empty()) << r.output;

  refused({"Time step 3", "limit"}, scene + "run 1\n", {{"dt", "3"}});
}

TEST_F(Hybrid, ForeignPairStylesAreNamed) {
  const Result r = ran(shear_contact("pair_style hybrid lsm/free lj/cut 1.0\npair_coeff 1 * "
                                     "lsm/free 1.0\npair_coeff 2 2 lj/cut 1.0 1.0\n") +
                       "fix move all lsm/nve\n" + recorded() + "run 1\n");
  const auto lines = r.lines_with("WARNING: Compute lsm/events");
  ASSERT_EQ(lines.size(), 1u) << r.output;
  EXPECT_NE(lines[0].find("pair lj/cut"), std::string::npos) << lines[0];
}

// ---- between two runs ----

TEST_F(BetweenRuns, DisplacedParticlesLoadTangentialSprings) {
  // Sheared by 0.01 at an overlap of 0.1, the contact sticks, as mu k 0.1 = 0.06.
  const std::string scene = shear_contact() + "fix move all lsm/nve\n" + recorded();
  for (int ranks : {1, 2}) {
    SCOPED_TRACE(ranks);
    const Result r =
        ran(scene + "run 0\ndisplace_atoms top move 0.01 0 0 units box\nrun 0\n", {}, ranks);
    EXPECT_NEAR(r.last("c_events[8]"), 0.5 * 0.01 * 0.01, 1e-8);
    // The model has done no work of friction, and the ledger starts anew, with one line that says
    // so.
    EXPECT_EQ(r.last("c_events[11]"), 0.0);
    EXPECT_NEAR(r.last("c_events[13]"), 0.0, 1e-15);
    EXPECT_EQ(r.lines_with("WARNING: Compute lsm/events").size(), 1u) << r.output;

    // Beyond mu F_n the contact slides: its spring keeps the elongation that friction supports.
    const Result far =
        ran(scene + "run 0\ndisplace_atoms top move 0.2 0 0 units box\nrun 0\n", {}, ranks);
    const double overlap = 2.0 - std::sqrt(1.9 * 1.9 + 0.2 * 0.2);
    EXPECT_NEAR(far.last("c_events[8]"), 0.5 * std::pow(0.6 * overlap, 2), 1e-12);
    EXPECT_EQ(far.last("c_events[11]"), 0.0);  // the slip was imposed, not dissipated in a step
  }
}

TEST_F(BetweenRuns, ParticlesThatAreNewInALoadedFaultHaveTheirOwnRadius) {
  // Atom 96 is the last of the upper border; a new disc of diameter 1 overlaps it by 0.1, and by
  // 0.35 once its diameter is 1.5.
  const std::string scene =
      discs_start +
      "create_lsm_fault lattice length 10 width 8 spacing 1 mass r2 $(2*sqrt(3)) margin 4\n"
      "bond_style lsm/linked\nbond_coeff * 1\npair_style lsm/friction\npair_coeff * * 1 1 0.6\n"
      "group lower type 3\ngroup upper type 4\nfix move all lsm/nve\n"
      "fix load all lsm/traction lower upper 0.01 0.0\ntimestep 0.1\n" +
      recorded() + "variable x equal x[96]\nvariable y equal y[96]\n";
  for (int ranks : {1, 2}) {
    const Result r = ran(scene +
                             "run 0\ncreate_atoms 1 single ${x} $(v_y+0.9) 0\n"
                             "set atom 97 diameter 1\nset atom 97 mass 1\nrun 0\n"
                             "set atom 97 diameter 1.5\nrun 0\n",
                         {}, ranks);
    ASSERT_EQ(r.thermo.size(), 3u);
    const auto contacts = [&r](int run) { return r.thermo[run].at("c_events[7]"); };
    EXPECT_NEAR(contacts(1) - contacts(0), 0.5 * 0.1 * 0.1, 1e-12);
    EXPECT_NEAR(contacts(2) - contacts(0), 0.5 * 0.35 * 0.35, 1e-12);
  }
}

TEST_F(BetweenRuns, CommandsThatChangeEnergyAreNoEventsAndNoResidual) {
  // Two contacts whose load rises throughout; each command removes or adds energy.
  const std::string scene = discs({{"0", "0"}, {"0", "1.9"}, {"5", "0"}, {"5", "1.9"}}) + R"(
pair_style        lsm/friction
pair_coeff        1 1 1.0 1.0 0.6
bond_style        lsm/linked
bond_coeff        1 1.0
timestep          0.01
group             pair id 3 4
group             one id 4
group             tops id 2 4
velocity          tops set 0 -0.3 0
fix               move all lsm/nve
)" + recorded("catalogue jump.csv lambda 0.5 ledger yes overwrite yes") +
                            "thermo 10\n";
  for (const char *command :
       {"delete_atoms group pair", "displace_atoms one move 0 0.1 0 units box",
        "velocity pair set 0 0 0", "velocity pair set 0.1 0 0", "set group pair mass 2.0",
        "pair_coeff 1 1 0.5 1.0 0.6"}) {
    SCOPED_TRACE(command);
    const Result r = ran(scene + "run 20\n" + command + "\nrun 20\n");
    EXPECT_LT(std::fabs(r.last("c_events[13]")), 1e-4);
    EXPECT_EQ(r.lines_with("WARNING: Compute lsm/events").size(), 1u) << r.output;
    // Otherwise there would be an event with the energy that the command removed as its size.
    for (const auto &event : unit::read_catalogue(path("jump.csv")).events)
      EXPECT_LT(event.size, 1e-3);
  }
}

/// Two linked discs that overlap by 0.1 and between which a contact is possible as well.
std::string linked_pair() {
  return discs({{"0", "0"}, {"1.9", "0"}}) +
         linked("create_bonds single/bond 1 1 2\n", "bond_coeff 1 1.0\n", "0.01");
}

TEST_F(BetweenRuns, LinksTurnedOffLeaveContacts) {
  // A pair without a link that is excluded from contacts interpenetrates: one line says so.
  const std::string scene = linked_pair() + recorded() + "thermo 10\n";
  const Result left = ran(scene + "run 10\ndelete_bonds all bond 1\nrun 10\n");
  EXPECT_EQ(left.lines_with("WARNING: Pair style lsm/").size(), 1u) << left.output;
  const Result right = ran(scene + "run 10\ndelete_bonds all bond 1 remove special\nrun 10\n");
  EXPECT_TRUE(right.lines_with("WARNING: Pair style lsm/").empty()) << right.output;
  EXPECT_GT(right.last("c_events[7]"), 0.0);
}

// ---- refused ----

TEST_F(Refused, InOneLine) {
  const std::string move = "fix move all lsm/nve\n",
                    free = "pair_style lsm/free\npair_coeff * * 1.0\n";
  refused({"lsm/friction", "once"},
          shear_contact("pair_style hybrid lsm/friction lsm/friction onset step\n"));
  refused({"lsm/", "hybrid/scaled"},
          shear_contact("pair_style hybrid/scaled 0.5 lsm/free 1.0 lj/cut 1.0\n"
                        "pair_coeff * * lsm/free 1.0\npair_coeff 1 1 lj/cut 0.0 1.0\n") +
              move + "run 1\n");
  refused({"lsm/", "pair_modify compute no"},
          shear_contact() + move + "pair_modify compute no\nrun 1\n");
  refused({"IDs"}, shear_contact() + move + "run 1\nreset_atoms id\n");
  refused({"lsm/events", "fix spread"}, shear_contact(free) +
                                            "fix spread all balance 1 1.0 shift x 5 1.0\n" + move +
                                            recorded() + "run 1\n");
  refused({"lsm/events", "events_record"},
          shear_contact(free) + move + recorded() + "run 1\nunfix events_record\nrun 1\n");
}

TEST_F(Refused, RerunOfWhatDependsOnThePath) {
  const std::string dump =
      "dump snap all custom 5 snap.dump id type x y z radius\ndump_modify snap format float "
      "%.17g\n";
  const std::string rerun = "undump snap\nrerun snap.dump dump x y\n";
  const std::string friction =
      shear_contact() + "velocity top set 0.05 0 0\nfix move all lsm/nve\n" + dump + "run 20\n";
  refused({"lsm/friction", "rerun"}, friction + rerun);

  const std::string free =
      shear_contact("pair_style lsm/free\npair_coeff * * 1.0\n") +
      "velocity top set 0.05 0 0\nfix move all lsm/nve\nthermo_style custom step pe\n"
      "thermo_modify norm no format float %.17g\nthermo 5\n" +
      dump + "run 20\n";
  refused({"lsm/events", "rerun"}, free + "compute events all lsm/events\n" + rerun);
  // Energies that depend only on positions are those of the run.
  const Result again = ran(free + rerun);
  ASSERT_EQ(again.thermo.size(), 10u) << again.output;
  EXPECT_GT(again.thermo[0].at("PotEng"), 0.0);
  for (std::size_t n = 0; n < 5; ++n)
    EXPECT_NEAR(again.thermo[n + 5].at("PotEng"), again.thermo[n].at("PotEng"), 1e-15);

  refused({"lsm/linked", "rerun"},
          two_link_types(5) + "uncompute events\nthermo_style one\n" + dump + "run 20\n" + rerun);
}

TEST_F(Refused, MinimizeWithFriction) {
  refused({"lsm/friction", "minimize"}, shear_contact() + "minimize 0 1e-10 100 1000\n");
  refused({"lsm/events", "minimize"},
          shear_contact("pair_style lsm/free\npair_coeff * * 1.0\n") +
              "compute events all lsm/events\nminimize 0 1e-10 100 1000\n");
  const Result free = ran(shear_contact("pair_style lsm/free\npair_coeff * * 1.0\n") +
                          "thermo_style custom step pe\nthermo_modify norm no format float "
                          "%.17g\nmin_modify line backtrack\nminimize 0 1e-10 100 1000\n");
  EXPECT_GT(free.thermo.front().at("PotEng"), 0.0);
  EXPECT_LT(free.last("PotEng"), 1e-15);
}

TEST_F(Refused, LinksHoldWhileEnergyIsMinimized) {
  // A trial step of the line search beyond the breaking distance breaks nothing; a link that is too
  // long at the end breaks then.
  const std::string scene =
      discs({{"0", "0"}, {"2.1", "0"}}) +
      linked("create_bonds single/bond 1 1 2\n", "bond_coeff 1 1.0 1.02\n", "0.1") +
      "thermo_style custom step bonds pe\nthermo_modify norm no format float %.17g\n";
  const Result r = ran(scene + "minimize 0 1e-12 100 1000\nrun 5\n");
  EXPECT_NEAR(r.thermo.front().at("PotEng"), 0.005, 1e-15);
  EXPECT_LT(r.last("PotEng"), 1e-15);
  EXPECT_EQ(r.last("Bonds"), 1.0);
  const Result held =
      ran(scene + "fix hold all setforce 0 0 0\nminimize 0 1e-12 100 1000\nrun 5\n");
  EXPECT_EQ(held.last("Bonds"), 0.0);
}

namespace {

/// A fixed floor of discs of radius 0.45, gravity, and a fix that drops discs of radius 0.5 on it.
std::string rain(const std::string &insert) {
  std::vector<std::pair<std::string, std::string>> floor;
  for (int n = 0; n < 60; ++n) floor.emplace_back(text(n - 29.5), "-8");
  return discs(floor) + R"(
set               group all diameter 0.9
group             floor id <= 60
pair_style        lsm/friction
pair_coeff        * * 1.0 1.0 0.6
timestep          0.02
region            sky block -28 28 -5 -1 -0.2 0.2
fix               down all gravity 0.05 vector 0 -1 0
fix               move all lsm/nve viscosity 0.05
)" + insert +
         "\nfix hold floor setforce 0 0 0\n";
}

const char *const rain_columns = R"(
variable          low equal bound(all,ymin)
variable          top equal bound(all,ymax)
thermo_style      custom step atoms ke c_events[7] c_events[8] v_low v_top
thermo_modify     norm no format float %.17g
)";

}  // namespace

TEST_F(Refused, RadiiThatChangeDuringARun) {
  const std::string scene =
      replaced(shear_contact("pair_style lsm/free\npair_coeff * * 1.0\n"), "hybrid bond sphere",
               "hybrid bond sphere 1") +
      "variable size equal 2.0+0.001*step\nfix grow all adapt 1 atom diameter v_size\n";
  refused({"lsm/", "fix grow"}, scene + "fix move all nve\nrun 10\n");
  refused({"lsm/linked", "fix grow"},
          scene +
              "pair_style zero 2.0\npair_coeff * *\ncreate_bonds single/bond 1 1 2\n"
              "fix move all nve\nrun 10\n");
  refused(
      {"lsm/nve", "fix grow"},
      scene +
          "bond_style none\npair_style zero 2.0\npair_coeff * *\nfix move all lsm/nve\nrun 10\n");
}

TEST_F(Refused, SpecialBonds) {
  const std::string scene = linked_pair();
  for (const char *setting :
       {"lj/coul 0 0 0", "lj/coul 0 0.5 1", "lj/coul 1 1 1", "lj/coul 0.5 1 1"})
    refused({"special_bonds", "0 1 1"}, scene + "special_bonds " + setting + "\nrun 1\n");
  // 1-2 neighbours stay in the list because of charges, but they must not interact as contacts.
  const Result r = ran(scene + "special_bonds lj 0 1 1 coul 1 1 1\n" + recorded() + "run 1\n");
  EXPECT_EQ(r.last("c_events[7]"), 0.0);
  EXPECT_GT(r.last("c_events[6]"), 0.0);
}

TEST_F(Refused, BoxSoSmallThatAPairMeetsTwice) {
  const std::string scene =
      replaced(replaced(shear_contact(), "boundary          f f p", "boundary          p f p"),
               "block -30 30", "block -2.3 2.3");
  refused({"lsm/friction", "period"}, scene + "fix move all lsm/nve\nrun 1\n");
}

// LAMMPS would make new room for contacts, and the old ones would be lost with a crash or in
// silence.
TEST_F(Refused, NewPagesOfNeighborListsForContactsThatAreKept) {
  const std::string start = shear_contact() + "fix move all lsm/nve\n";
  for (const char *change : {"one 4000 page 100000", "one 1000", "page 200000"}) {
    const std::string command = std::string("neigh_modify ") + change + "\n";
    refused({"lsm/friction", "neigh_modify one", "page"}, start + "run 1\n" + command + "run 1\n");
    ran(start + command + "run 1\nrun 1\n");
  }
  ran(shear_contact("pair_style lsm/free\npair_coeff * * 1.0\n") +
      "fix move all lsm/nve\nrun 1\nneigh_modify page 200000\nrun 1\n");
}

TEST_F(Refused, UnitsInWhichForceTimesDistanceIsNoEnergy) {
  for (const char *line :
       {"fix walls all lsm/plates bottom top stress 0.1\n", "fix border top lsm/absorb y 1 1 1\n",
        "fix move all lsm/nve viscosity 1\n", "compute events all lsm/events\n"}) {
    const std::string scene = shear_contact("pair_style lsm/free\npair_coeff * * 1.0\n") +
                              "group bottom id 1\n" + line + "run 0\n";
    refused({"units metal; use lj, si, cgs, micro or nano"},
            replaced(scene, "units             lj", "units metal"));
  }
}

TEST_F(Refused, FrictionWithNewtonOnAndTiledRanks) {
  const std::string scene =
      "variable newton index on\n" + shear_contact() + "fix move all lsm/nve\n";
  const std::string tiled = "comm_style tiled\nbalance 1.0 rcb\nrun 1\n";
  refused({"newton on", "comm_style tiled", "newton off"}, scene + tiled, {{"newton", "on"}}, 2);
  ran(scene + tiled, {{"newton", "off"}}, 2);
}

TEST_F(Refused, FixesThatBreakLinks) {
  // Another program (LSM_LMP) needs a plugin that was compiled for it.
  const char *other = std::getenv("LSM_FOREIGN_FIX");
  const std::string plugin = other ? other : LSM_FOREIGN_FIX;
  refused({"lsm/linked", "fix cut", "bond/break", "ratio"},
          (plugin.empty() ? "" : "plugin load " + plugin + "\n") + linked_pair() +
              "fix cut all bond/break 1 1 2.5\nrun 1\n");
}

TEST_F(Refused, LedgerOfParticlesThatCome) {
  const std::string scene = rain("fix drop all deposit 20 1 40 771 region sky near 1.2");
  for (const char *options : {"ledger yes", "tolerance 0.1"})
    refused({"lsm/events", "ledger", "fix drop"}, scene + recorded(options) + "run 1\n");
}

// ---- other commands that work ----

namespace {

/// Two linked pairs that rub against each other, with another contact across the periodic border.
std::string rubbing(
    const std::string &pair = "pair_style lsm/friction\npair_coeff * * 1.0 1.0 0.6\n") {
  return replaced(discs({{"-3", "0"},
                         {"-1", "0"},
                         {"-2", "1.7"},
                         {"0", "1.7"},
                         {"29.5", "0"},
                         {"29", "1.9"}},
                        2, 2),
                  "boundary          f f p", "boundary          p f p") +
         R"(
set               atom 3*4 type 2
set               atom 6 type 2
create_bonds      single/bond 1 1 2
create_bonds      single/bond 1 3 4
bond_style        lsm/linked
bond_coeff        * 1.0
)" + pair +
         R"(
timestep          0.02
group             top type 2
group             bottom type 1
velocity          top set 0.1 -0.02 0
velocity          bottom set -0.1 0.02 0
)" + recorded() +
         "thermo 50\n";
}

/// Largest difference between the energies at the end of two runs.
double energies_differ(const Result &a, const Result &b) {
  double worst = 0.0;
  for (const char *column : {"KinEng", "c_events[6]", "c_events[7]", "c_events[8]", "c_events[11]"})
    worst = std::max(worst, std::fabs(a.last(column) - b.last(column)));
  return worst;
}

}  // namespace

TEST_F(Works, ParticlesThatComeTouchWhatIsThere) {
  for (const char *insert : {"fix drop all deposit 20 1 40 771 region sky near 1.2 vy -0.2 -0.2",
                             "fix drop all pour 20 1 771 region sky diam one 1.0 vol 0.3 50"}) {
    std::vector<Result> runs;
    for (int ranks : {1, 2}) {
      runs.push_back(ran(rain(insert) + "compute events all lsm/events\n" + rain_columns +
                             "thermo 400\nrun 1200\n",
                         {}, ranks));
      // The discs are larger than those of the floor, but contacts are found: none falls through.
      EXPECT_EQ(runs.back().last("Atoms"), 80.0) << insert;
      EXPECT_EQ(runs.back().last("v_low"), -8.0) << insert;
    }
    EXPECT_LT(
        thermo_difference(runs[0], runs[1], {"KinEng", "c_events[7]", "c_events[8]", "v_top"}),
        1e-9)
        << insert;
  }
}

TEST_F(Works, BalanceRespaAndHybridGiveTheSameMotion) {
  const Result plain = ran(rubbing() + "fix move all lsm/nve\nrun 100\n");
  EXPECT_GT(plain.last("c_events[8]"), 1e-6);
  EXPECT_GT(plain.last("c_events[11]"), 1e-3);
  const std::string hybrid =
      "pair_style hybrid lsm/free lsm/friction\npair_coeff 1 1 lsm/free 1.0\npair_coeff 2 2 "
      "lsm/free 1.0\n"
      "pair_coeff 1 2 lsm/friction 1.0 1.0 0.6\n";
  const std::string others[] = {
      rubbing() + "fix move all lsm/nve\nrun 50\nbalance 1.0 shift x 5 1.0\nrun 50\n",
      rubbing() + "fix spread all balance 10 1.0 shift x 5 1.0\nfix move all lsm/nve\nrun 100\n",
      rubbing() + "fix move all nve\nrun_style respa 2 1 bond 1 pair 2\nrun 100\n",
      rubbing() + "fix move all lsm/nve\nchange_box all triclinic\nrun 100\n",
      rubbing() + "fix move all lsm/nve\nrun 30 post no\nrun 70 pre no\n",
      rubbing(hybrid) + "fix move all lsm/nve\nrun 100\n"};
  for (const std::string &other : others)
    for (int ranks : {1, 2}) {
      const Result r = ran(other, {}, ranks);
      EXPECT_LT(energies_differ(plain, r), 1e-12) << other;
    }
  for (const auto &[grid, ranks] : {std::pair<std::string, int>{"1 2 1", 2}, {"2 2 1", 4}})
    EXPECT_LT(energies_differ(plain, ran("processors " + grid + "\n" + others[4], {}, ranks)),
              1e-12)
        << grid;
}

TEST_F(Works, StaticFrictionFollowsAnAdaptedCoefficientUnlessItWasGiven) {
  const std::string adapted =
      rubbing() +
      "fix move all lsm/nve\nvariable less equal ramp(0.6,0.1)\n"
      "fix weaken all adapt 1 pair lsm/friction mu * * v_less\nrun 20\nunfix weaken\n";
  const Result follows = ran(adapted + "run 40\n");
  const Result given = ran(adapted + "pair_coeff * * 1.0 1.0 0.1\nrun 40\n");
  EXPECT_GT(given.last("c_events[11]"), 0.0);
  EXPECT_LT(energies_differ(follows, given), 1e-12);
}

TEST_F(Works, StaticFrictionThatWasNotGivenIsNotWritten) {
  for (const auto &[given, words] :
       {std::pair<std::string, std::size_t>{"0.6", 5}, {"0.6 0.8", 6}}) {
    const std::string pair = "pair_style lsm/friction\npair_coeff * * 1.0 1.0 " + given + "\n";
    ran(rubbing(pair) + "fix move all lsm/nve\nrun 0\nwrite_data out.data pair ij\n");
    std::ifstream file(path("out.data"));
    std::string line;
    while (std::getline(file, line) && line.rfind("PairIJ Coeffs", 0) != 0) continue;
    std::getline(file, line);
    std::getline(file, line);
    std::istringstream split(line);
    const std::vector<std::string> found(std::istream_iterator<std::string>(split), {});
    EXPECT_EQ(found.size(), words) << line;
  }
}
