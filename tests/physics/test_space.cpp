// SPDX-License-Identifier: GPL-2.0-or-later
// Friction in three dimensions: spheres that slide over each other, on any number of ranks.
#include <cmath>
#include <string>
#include <vector>

#include "lmp_runner.h"

using namespace physics;

using Space = Lmp;

namespace {

const std::vector<std::string> energies = {"KinEng",      "c_events[5]",  "c_events[7]",
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
      const double x = 2.0 * (n % 6) + (type == 1 ? 0.1 : 0.8),
                   z = 2.0 * (n / 6) + (type == 1 ? 0.1 : 0.5);
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
    const Result one = ran(script);
    EXPECT_GT(one.last("c_events[11]"), 0.05);
    EXPECT_GT(one.last("c_events[8]"), 1e-5);
    // what the ledger misses is the work of the pressing force
    const double more = one.thermo.front().at("f_press") - one.last("f_press");
    EXPECT_GT(more, 1e-2);
    EXPECT_NEAR(one.last("c_events[13]"), more, 1e-3 * one.last("c_events[11]"));
    each_split([&](const Variables &newton, int ranks) {
      if (ranks > 1 && style.find("slip-weakening") == std::string::npos) return;
      const Result r = ran(script, newton, ranks);
      for (const auto &column : energies) EXPECT_NEAR(r.last(column), one.last(column), 1e-9);
    });
  }
}

// Coefficients that particles have, and the same from a restart file.
TEST_F(Space, PropertiesOfParticles) {
  const std::string fix = "fix own all property/atom d_mus d_dc ghost yes\n";
  const auto script = [&fix](const std::string &factor) {
    return slide("lsm/friction slip-weakening", "mu 0.2 mu_static d_mus dc d_dc") + fix +
           "variable own atom " + factor + "\nvariable mus atom 0.4*v_own\n" +
           "variable dc atom 0.3*v_own\nset group all d_mus v_mus\nset group all d_dc v_dc\n";
  };
  const std::string halves = "run 300\nwrite_restart half.restart\nrun 300\n";
  const Result types = ran(slide() + halves), same = ran(script("1") + halves);
  EXPECT_EQ(thermo_difference(types, same, energies), 0.0);

  const std::string varied = script("1+0.2*sin(7*id)");
  std::string after =
      replaced(varied, "region ", "group             above", "read_restart half.restart\n");
  after = replaced(after, "velocity ", "pair_style", "");
  after.erase(after.find("variable own"));
  const Result one = ran(varied + halves);
  EXPECT_GT(std::fabs(one.last("c_events[11]") - types.last("c_events[11]")), 1e-4);
  for (int ranks : {1, 2}) {
    const Variables newton = {{"newton", ranks == 2 ? "on" : "off"}};
    const Result r = ran(varied + halves, newton, ranks);
    const Result rest = ran(after + "run 300\n", newton, ranks);
    for (const auto &column : energies) EXPECT_NEAR(r.last(column), one.last(column), 1e-9);
    for (const char *column : {"KinEng", "c_events[5]", "c_events[8]"})
      EXPECT_EQ(rest.last(column), r.last(column)) << column << ", " << ranks << " ranks";
    refused({"dc of particle 41 in contacts of types 1 2 is 0"},
            varied + "set atom 41 d_dc 0\nset atom 60 d_dc -1\nrun 1\n", {}, ranks);
  }
}

// Under hybrid contacts are taken one by one; what compute pair/local prints is the elongation, and
// the force along it and along the axes.
TEST_F(Space, HybridAndSingle) {
  const Result one = ran(slide() + "run 600\n");
  const Result hybrid =
      ran(replaced(slide("hybrid lsm/friction slip-weakening"), "pair_coeff        * *",
                   "pair_coeff        * * lsm/friction") +
          "run 600\n");
  for (const auto &column : energies) EXPECT_NEAR(hybrid.last(column), one.last(column), 1e-9);

  const Result local = ran(slide() + R"(
compute           local all pair/local eng p1 p2 p3 p4 p5
compute           sums all reduce sum c_local[1] c_local[2] c_local[3] inputs local
compute           most all reduce max c_local[4] c_local[5] c_local[6] inputs local
compute           least all reduce min c_local[4] c_local[5] c_local[6] inputs local
thermo_style      custom step ke c_events[7] c_events[8] c_sums[*] c_most[*] c_least[*]
thermo_modify     norm no format float %.17g
run               100
)");
  EXPECT_NEAR(local.last("c_sums[1]"), local.last("c_events[7]") + local.last("c_events[8]"),
              1e-12);
  EXPECT_GT(local.last("c_sums[2]"), 0.1);
  EXPECT_NEAR(local.last("c_sums[3]"), -0.7 * local.last("c_sums[2]"), 1e-12);
  for (int c : {1, 3}) {
    const std::string at = "[" + std::to_string(c) + "]";
    EXPECT_GT(local.last("c_most" + at) - local.last("c_least" + at), 1e-3);
  }
}

namespace {

/// A cubic lattice of unit density, modulus and spacing: S-waves run at 1. Its fault is loaded
/// along both axes by `load`, for all of it or a patch.
std::string lattice(const std::string &boundary, const std::string &law, const std::string &load,
                    const std::string &created =
                        "create_lsm_fault lattice cubic length 12 width 16 depth 6 spacing 1 "
                        "mass r3 8") {
  return "variable newton index off\nunits lj\ndimension 3\nboundary " + boundary +
         "\nnewton ${newton}\natom_style hybrid bond sphere\natom_modify map array\n"
         "comm_modify mode single cutoff 1.8\nneighbor 0.1 bin\nspecial_bonds lj/coul 0 1 1\n" +
         created + R"(
bond_style      lsm/linked
bond_coeff      1 1.0 kelvin-voigt 0.02
bond_coeff      2 0.5 kelvin-voigt 0.02
bond_coeff      3 0.25 kelvin-voigt 0.02
bond_coeff      4 1.0 rest $(sqrt(2):%.17g) kelvin-voigt 0.02
bond_coeff      5 0.5 rest $(sqrt(2):%.17g) kelvin-voigt 0.02
pair_style      lsm/friction )" +
         law + R"(
group           lower type 3
group           upper type 4
group           caps type 5 6
)" + load +
         R"(
fix             caps caps lsm/absorb y $(sqrt(3)) 1.0 per/mass 2
fix             move all lsm/nve
timestep        0.1
compute         events all lsm/events ledger yes
variable        strike equal xcm(upper,x)-xcm(lower,x)
variable        dip equal xcm(upper,z)-xcm(lower,z)
thermo_style    custom step ke c_events[5] c_events[7] c_events[8] c_events[11] c_events[13] c_events[15] c_events[16] v_strike v_dip
thermo_modify   norm no format float %.17g
thermo          50
)";
}

/// Part of the fault slips, and the waves reach free and absorbing borders.
std::string patch(const std::string &created = "") {
  const std::string law =
      "slip-weakening\npair_coeff * * off\npair_coeff 3 4 1.0 1.5 mu 0.5 mu_static 0.7 dc 1e-4";
  const std::string load =
      "variable shear atom 5.5e-4+3e-4*(abs(x)<3)*(abs(z+3)<2)\n"
      "fix load all lsm/traction lower upper 1e-3 v_shear dip 1e-4 per/mass 2";
  return created.empty() ? lattice("f f f", law, load) : lattice("f f f", law, load, created);
}

}  // namespace

// A fault under the same stress everywhere slips along it at twice the stress drop over the
// impedance of S-waves, whatever the direction. (Slip is small compared with an overlap here.)
TEST_F(Space, AUniformStressDropGivesTheSlipRateOfPlaneWaves) {
  for (const auto &[strike, dip] : {std::pair<double, double>{6e-6, 4.5e-6}, {0.0, -7.5e-6}}) {
    const Result r = ran(lattice("p f p", "\npair_coeff * * off\npair_coeff 3 4 1.0 1.5 0.5",
                                 "fix load all lsm/traction lower upper 1e-5 " + text(strike) +
                                     " dip " + text(dip)) +
                             "run 200\n",
                         {}, 2);
    const double rate = 2.0 * (7.5e-6 - 5e-6), share = 1.0 / 7.5e-6;
    const auto &half = r.thermo.at(2), &end = r.thermo.back();
    const double time = 10.0;
    EXPECT_NEAR((end.at("v_strike") - half.at("v_strike")) / time, rate * strike * share,
                0.005 * rate);
    EXPECT_NEAR((end.at("v_dip") - half.at("v_dip")) / time, rate * dip * share, 0.005 * rate);
    EXPECT_LT(std::fabs(r.last("c_events[13]")), 1e-3 * r.last("c_events[11]"));
    EXPECT_GT(r.last("c_events[16]"), 0.01 * r.last("c_events[11]")) << "through the borders";
  }
}

// Until waves come back from the fault, a driven plate feels the impedance of S-waves, and one
// under stress moves against that of P-waves.
TEST_F(Space, PlatesRadiatePlaneWaves) {
  const Result r = ran(
      lattice("p f p", "\npair_coeff * * off\npair_coeff 3 4 1.0 1.0 0.6",
              "group bottom type 5\ngroup top type 6\ngroup rest subtract all bottom top\n"
              "fix plates all lsm/plates bottom top velocity 1e-4 ramp 4 stress 2e-4 stressramp 3\n"
              "thermo_style custom step f_plates[1] f_plates[9]") +
          "unfix move\nunfix caps\nfix move rest lsm/nve\n"
          "thermo_style custom step f_plates[1] f_plates[9] c_events[13]\n"
          "thermo_modify norm no format float %.17g\nthermo 10\nrun 80\n",
      {}, 2);
  EXPECT_NEAR(r.last("f_plates[1]"), 1e-4, 0.01 * 1e-4);
  const double approach = r.thermo.at(8).at("f_plates[9]") - r.thermo.at(5).at("f_plates[9]");
  EXPECT_NEAR(approach, 2.0 * 2e-4 / std::sqrt(3.0) * 3.0, 0.01 * approach);
}

TEST_F(Space, AFaultOnRanksAndFromARestartFile) {
  const std::vector<std::string> columns = {"KinEng",       "c_events[7]",  "c_events[8]",
                                            "c_events[11]", "c_events[15]", "c_events[16]",
                                            "v_strike",     "v_dip"};
  const std::string half = patch() + "run 100\nwrite_restart half.restart\nrun 100\n";
  const Result one = ran(half);
  EXPECT_GT(one.last("c_events[11]"), 1e-5);
  EXPECT_GT(one.last("v_strike"), 1e-4);
  EXPECT_GT(one.last("v_dip"), 1e-5);
  EXPECT_LT(std::fabs(one.last("c_events[13]")), 1e-3 * one.last("c_events[11]"));
  for (const auto &[newton, ranks] : {std::pair<const char *, int>{"off", 2}, {"on", 4}}) {
    SCOPED_TRACE(std::string("newton ") + newton + ", ranks " + std::to_string(ranks));
    const Result whole = ran(half, {{"newton", newton}}, ranks);
    const Result rest =
        ran(patch("read_restart half.restart") + "run 100\n", {{"newton", newton}}, ranks);
    for (const auto &column : columns) {
      EXPECT_NEAR(whole.last(column), one.last(column), 1e-9 * std::fabs(one.last(column)));
      EXPECT_NEAR(rest.last(column), whole.last(column), 1e-13) << column;
    }
    for (const char *column : {"KinEng", "c_events[8]", "v_strike", "v_dip"})
      EXPECT_EQ(rest.last(column), whole.last(column)) << column;
  }
}

TEST_F(Space, WhatIsWrongIsNamed) {
  const auto wrong = [](const std::string &script, const std::string &from, const std::string &to,
                        const std::string &what) {
    refused({what}, replaced(script, from, to) + "run 1\n");
  };
  const std::string create = "lattice cubic length 12 width 16 depth 6";
  wrong(patch(), create, "lattice cubic length 12.3 width 16 depth 6",
        "length = 12.300000, expected a multiple of the spacing");
  wrong(patch(), create, "lattice cubic length 12 width 16", "depth");
  wrong(patch(), "boundary f f f", "boundary f p f", "not periodic in y");
  wrong(patch(), "dimension 3", "dimension 2", "requires dimension 3, found dimension 2");
  wrong(patch(), create, "length 120 width 30 seed 1 ", "requires dimension 2, found dimension 3");
  wrong(patch(), "per/mass 2\nfix             move", "2 2\nfix             move",
        "[per/mass] LENGTH");
  wrong(patch(), "absorb y", "absorb xz", "must be x, y or z");
  wrong(patch(), "dip 1e-4", "share spacing", "share needs dimension 2, found dimension 3");
  wrong(patch(), "timestep        0.1", "timestep        0.7", "above the stability limit");
  wrong(patch(), "fix             caps", "fix leap all lsm/leap plates\nfix             caps",
        "Fix lsm/leap needs dimension 2, found dimension 3");
  wrong(patch(), "group           caps type 5 6",
        "region none block 99 100 INF INF INF INF units box\ngroup caps region none",
        "Fix lsm/absorb caps: group caps has no particles, expected those of a border");
  wrong(patch(), "group           lower type 3", "group lower type 4 3\ngroup lower clear",
        "Fix lsm/traction lower group 'lower' has no particles, expected a face");
  wrong(patch(), "rest $(sqrt(2):%.17g)", "rest 0", "rest");
  wrong(patch(), "fix             caps",
        "fix plates all lsm/plates lower upper position\nfix             caps",
        "Fix lsm/plates needs a box that is periodic in x and z");
}
