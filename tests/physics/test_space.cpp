// SPDX-License-Identifier: GPL-2.0-or-later
// Friction in three dimensions: spheres that slide over each other, on any number of ranks.
#include <cmath>
#include <string>
#include <vector>

#include "lmp_runner.h"

using namespace physics;

using Space = Lmp;

namespace {

const std::vector<std::string> energies = {"KinEng",       "c_events[5]",  "c_events[7]",
                                           "c_events[8]", "c_events[11]", "c_events[13]"};

/// 36 spheres slide over 36 that are fixed, along no axis, and are pressed onto them.
std::string slide(const std::string &style = "lsm/friction slip-weakening",
                  const std::string &law = "mu 0.2 mu_static 0.4 dc 0.3") {
  std::string text = R"(
variable          newton index off
units             lj
dimension         3
boundary          p f p
newton            ${newton}
atom_style        hybrid bond sphere
atom_modify       map array sort 0 0
comm_modify       mode single cutoff 4.5
neighbor          0.4 bin
neigh_modify      delay 0 every 1 check yes
region            box block 0 12 -10 10 0 12
create_box        2 box
)";
  for (int type : {1, 2})
    for (int n = 0; n < 36; ++n) {
      const double x = 2.0 * (n % 6) + (type == 1 ? 0.1 : 0.8), z = 2.0 * (n / 6) + (type == 1 ? 0.1 : 0.5);
      text += "create_atoms " + std::to_string(type) + " single " + std::to_string(x) +
              (type == 1 ? " -1 " : " 0.71 ") + std::to_string(z) + "\n";
    }
  return text + R"(
set               group all diameter 2.0
set               group all mass 1.0
group             above type 2
velocity          above set 0.8 -0.05 0.47
pair_style        )" +
         style + R"(
pair_coeff        * * 1.0 0.7 )" +
         law + R"(
fix               press above addforce 0 -0.1 0
fix               move above lsm/nve
timestep          0.02
compute           events all lsm/events ledger yes
thermo_style      custom step ke c_events[5] c_events[7] c_events[8] c_events[11] c_events[13] f_press
thermo_modify     norm no format float %.17g
thermo            100
)";
}

}  // namespace

TEST_F(Space, EnergyRanksAndNewton) {
  for (const auto &[style, law] :
       {std::pair<std::string, std::string>{"lsm/friction", "0.3"},
        {"lsm/friction", "0.2 0.4"},
        {"lsm/friction slip-weakening", "mu 0.2 mu_static 0.4 dc 0.3"},
        {"lsm/friction velocity-weakening", "mu 0.3 vc 0.5"},
        {"lsm/friction rate-state-ageing", "mu 0.3 a 0.01 b 0.02 dc 0.1 v0 0.1"}}) {
    SCOPED_TRACE(style + " " + law);
    const std::string script = slide(style, law) + "run 600\n";
    const Result one = run_text(script);
    ASSERT_TRUE(succeeded(one));
    EXPECT_GT(one.last("c_events[11]"), 0.05);
    EXPECT_GT(one.last("c_events[8]"), 1e-5);
    // what the ledger misses is the work of the pressing force
    const double more = one.thermo.front().at("f_press") - one.last("f_press");
    EXPECT_GT(more, 1e-2);
    EXPECT_NEAR(one.last("c_events[13]"), more, 1e-3 * one.last("c_events[11]"));
    for (const auto &[newton, ranks] :
         {std::pair<const char *, int>{"on", 1}, {"on", 2}, {"off", 2}, {"off", 4}}) {
      const Result r = run_text(script, {{"newton", newton}}, ranks);
      ASSERT_TRUE(succeeded(r));
      for (const auto &column : energies)
        EXPECT_NEAR(r.last(column), one.last(column), 1e-9) << column << ", newton " << newton;
    }
  }
}

TEST_F(Space, InPiecesAndFromARestartFile) {
  const std::string half = slide() + "run 300\nwrite_restart half.restart\n";
  std::string after = slide();
  const auto from = after.find("region "), to = after.find("group             above");
  after.replace(from, to - from, "read_restart half.restart\n");
  after.erase(after.find("velocity "), after.find("pair_style") - after.find("velocity "));
  for (int ranks : {1, 2}) {
    const Result whole = run_text(slide() + "run 600\n", {}, ranks);
    const Result pieces = run_text(half + "run 300\n", {}, ranks);
    const Result rest = run_text(after + "run 300\n", {}, ranks);
    for (const Result *one : {&whole, &pieces, &rest}) ASSERT_TRUE(succeeded(*one));
    EXPECT_GT(whole.last("c_events[8]"), 1e-5) << "in contact";
    for (const char *column : {"KinEng", "c_events[5]", "c_events[8]"}) {
      EXPECT_NEAR(pieces.last(column), whole.last(column), 1e-10);
      EXPECT_EQ(pieces.last(column), rest.last(column)) << column << ", " << ranks << " ranks";
    }
  }
}

// Under hybrid contacts are taken one by one; what compute pair/local prints is the elongation, and
// the force along it and along the axes.
TEST_F(Space, HybridAndSingle) {
  const Result one = run_text(slide() + "run 600\n");
  std::string text = slide("hybrid lsm/friction slip-weakening");
  text.replace(text.find("pair_coeff        * *"), 21, "pair_coeff        * * lsm/friction");
  const Result hybrid = run_text(text + "run 600\n");
  ASSERT_TRUE(succeeded(one));
  ASSERT_TRUE(succeeded(hybrid));
  for (const auto &column : energies) EXPECT_NEAR(hybrid.last(column), one.last(column), 1e-9);

  const Result local = run_text(slide() + R"(
compute           local all pair/local eng p1 p2 p3 p4 p5
compute           sums all reduce sum c_local[1] c_local[2] c_local[3] inputs local
compute           most all reduce max c_local[4] c_local[5] c_local[6] inputs local
compute           least all reduce min c_local[4] c_local[5] c_local[6] inputs local
thermo_style      custom step ke c_events[7] c_events[8] c_sums[*] c_most[*] c_least[*]
thermo_modify     norm no format float %.17g
run               100
)");
  ASSERT_TRUE(succeeded(local));
  EXPECT_NEAR(local.last("c_sums[1]"), local.last("c_events[7]") + local.last("c_events[8]"), 1e-12);
  EXPECT_GT(local.last("c_sums[2]"), 0.1);
  EXPECT_NEAR(local.last("c_sums[3]"), -0.7 * local.last("c_sums[2]"), 1e-12);
  for (int c : {1, 3}) {
    const std::string at = "[" + std::to_string(c) + "]";
    EXPECT_GT(local.last("c_most" + at) - local.last("c_least" + at), 1e-3);
  }
}
