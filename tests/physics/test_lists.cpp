// SPDX-License-Identifier: GPL-2.0-or-later
// Neighbor lists that are added to, instead of being built anew, when single particles move far.

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "disc_scene.h"
#include "lmp_runner.h"

namespace physics {
namespace {

class Lists : public Lmp {};

const char *const free_pairs = "pair_style lsm/free\npair_coeff * * 1.0\n";
// of single discs only
const char *const few_pairs = "pair_style lsm/free\npair_coeff * * 1.0\npair_coeff 1 1 off\n";
const char *const friction_pairs = "pair_style lsm/friction\npair_coeff * * 1.0 0.5 0.02\n";

// Discs at rest, and two linked ones that bounce through a lane between their rows, where they
// touch new ones all the time, also over the periodic border.
std::string lane(const std::string &pair, const std::string &runs = "run 3000\n") {
  return discs_start + std::string(R"(
variable          cutoff index 7.0
variable          check index yes
boundary          p f p
newton            off
processors        * 1 1
comm_modify       cutoff ${cutoff}
neigh_modify      check ${check}
lattice           hex 0.2385 origin 0 0.25 0
region            box block 0 24 0 10 -0.5 0.5
create_box        2 box bond/types 1 extra/bond/per/atom 1 extra/special/per/atom 1
region            lane block INF INF 4.9 5.1 INF INF
region            rows intersect 2 box lane side out
create_atoms      1 region rows
create_atoms      2 single 6.71 19.13 0 units box
create_atoms      2 single 8.71 18.98 0 units box
group             bullet type 2
set               group all diameter 2.0
set               group all mass 1.0
bond_style        lsm/linked
bond_coeff        1 1.0
pair_style        zero 2.4
pair_coeff        * *
create_bonds      many bullet bullet 1 1.9 2.1
)") + pair +
         R"(
velocity          bullet set 0.9 0.1 0
timestep          0.01
fix               move bullet lsm/nve
variable          x equal xcm(bullet,x)
variable          y equal xcm(bullet,y)
thermo_style      custom step ke pe v_x v_y
thermo_modify     norm no format float %.17g
thermo            500
)" + runs;
}

int builds(const Result &result) {
  const std::vector<std::string> lines = result.lines_with("Neighbor list builds = ");
  EXPECT_EQ(lines.size(), 1u) << result.output;
  return lines.empty() ? 0 : std::atoi(lines[0].substr(lines[0].rfind('=') + 1).c_str());
}

TEST_F(Lists, AParticleThatMovesFarMeetsOthers) {
  for (const char *pair : {free_pairs, few_pairs, friction_pairs}) {
    const Result exact = ran(lane(pair), {{"check", "no"}});
    EXPECT_EQ(builds(exact), 3000);
    const double went = exact.last("v_x") - exact.thermo.front().at("v_x");
    EXPECT_GT(went, 10.0) << "the discs have to pass many others";
    EXPECT_EQ(exact.lines_with("Added 1 bonds").size(), 1u) << exact.output;
    // without a margin of the ghosts LAMMPS builds the lists whenever the disc has moved by 0.2
    const Result without = ran(lane(pair), {{"cutoff", "2.4"}});
    EXPECT_GT(builds(without), 40);
    for (int ranks : {1, 2}) {
      const Result r = ran(lane(pair), {}, ranks);
      EXPECT_LT(builds(r), builds(without) / 4);
      EXPECT_LT(thermo_difference(exact, r, {"KinEng", "v_x", "v_y"}), 1e-9) << pair << ranks;
    }
  }
}

// Their lists are not added to, or they may rely on particles moving by less than half the skin, so
// LAMMPS has to build all lists.
TEST_F(Lists, AreBuiltWhereOthersMayRelyOnThem) {
  for (const char *other : {"compute neighbours all coord/atom cutoff 2.0\n",
                            "fix flow all ave/grid 10 10 100 48 20 1 vx\n"}) {
    const Result r = ran(lane(free_pairs + std::string(other)));
    EXPECT_GT(builds(r), 40) << other;
  }
}

TEST_F(Lists, AnObserverChangesNothing) {
  const Result alone = ran(lane(friction_pairs));
  const Result seen =
      ran(lane(friction_pairs + std::string("fix see all ave/time 1 10 20 c_thermo_temp\n")));
  EXPECT_EQ(builds(seen), builds(alone));
  EXPECT_EQ(thermo_difference(alone, seen, {"KinEng", "v_x", "v_y"}), 0.0);
}

// Ghosts reach over several ranks here, but particles may change to the next rank only.
TEST_F(Lists, ParticlesReachTheRankBesideTheirsAtMost) {
  const Result exact = ran(lane(free_pairs), {{"check", "no"}});
  const Result r = ran(lane(free_pairs), {{"cutoff", "40"}}, 4);
  EXPECT_LT(builds(r), 40);
  EXPECT_LT(thermo_difference(exact, r, {"KinEng", "v_x", "v_y"}), 1e-9);
}

TEST_F(Lists, AreNewForEachSnapshotOfARerun) {
  const Result r =
      ran(lane(free_pairs,
               "dump snap all custom 500 snap.dump id x y\ndump_modify snap format float %.17g\n"
               "run 3000\nundump snap\nrerun snap.dump dump x y\n"));
  ASSERT_EQ(r.thermo.size(), 14u) << r.output;
  for (std::size_t n = 0; n < 7; ++n)
    EXPECT_NEAR(r.thermo[n + 7].at("PotEng"), r.thermo[n].at("PotEng"), 1e-12) << n;
  EXPECT_GT(r.last("PotEng"), 0.0);
}

// A patch of discs at rest, and two free ones, the first of which has a velocity.
std::string field(const std::string &bullet, const std::string &target, const std::string &runs) {
  return discs_start + std::string(R"(
boundary          p f p
newton            off
processors        * 1 1
comm_modify       cutoff 3.6
lattice           hex 0.2385
region            box block -20 20 -30 30 -0.5 0.5 units box
create_box        2 box bond/types 1 extra/bond/per/atom 1 extra/special/per/atom 1
region            patch block -18 -8 -7 10 INF INF units box
create_atoms      1 region patch
lattice           none 1.0
create_atoms      2 single )") +
         bullet + R"( 0
group             bullet type 2
create_atoms      2 single )" +
         target + R"( 0
group             moving type 2
group             target subtract moving bullet
set               group all diameter 2.0
set               group all mass 1.0
pair_style        lsm/free
pair_coeff        * * 1.0
velocity          bullet set 0.9 0 0
timestep          0.01
fix               move moving lsm/nve
variable          bullet equal vcm(bullet,x)
variable          target equal vcm(target,x)
thermo_style      custom step pe v_bullet v_target
thermo_modify     norm no format float %.17g
)" + runs;
}

// In which cell the lowest disc is must not depend on rounding, for any position.
TEST_F(Lists, TheLowestParticleMovesFar) {
  const Result r = ran("variable n loop 120\nlabel again\nclear\n" +
                       field("-8 $(-14.0+0.05*v_n)", "15 8",
                             "comm_modify cutoff 7.0\nrun 100\nnext n\njump SELF again\n"));
  EXPECT_EQ(r.thermo.size(), 240u);
  EXPECT_NEAR(r.last("v_bullet"), 0.9, 1e-12) << "the disc touches no other";
}

// Commands may move particles between two runs, also without a setup.
TEST_F(Lists, ParticlesMovedAfterRunZeroAreFound) {
  const Result r =
      ran(field("-6 0", "-3.9 0",
                "velocity moving set 0 0 0\nrun 0\ndisplace_atoms bullet move 0.12 0 0\n"
                "run 20 pre no\n"));
  EXPECT_GT(r.last("PotEng"), 1e-4);
}

// A disc of the first rank, where many pairs are listed, hits one of the second, where there are no
// others.
TEST_F(Lists, ARankWithFewPairsSeesWhatComesFromBesideIt) {
  const Result r = ran(field("-1.5 0", "1.5 0", "comm_modify cutoff 7.0\nrun 1000\n"), {}, 2);
  // equal masses exchange their velocities, but for the error of the time step
  EXPECT_NEAR(r.last("v_target"), 0.9, 1e-4);
  EXPECT_NEAR(r.last("v_bullet"), 0.0, 1e-4);
}

}  // namespace
}  // namespace physics
