// SPDX-License-Identifier: GPL-2.0-or-later
// Dynamic ruptures of a flat fault in the regular lattice, compared with a boundary integral method
// and a closed form.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "disc_scene.h"
#include "lmp_runner.h"
#include "read_series.h"

using namespace physics;

namespace {

/// Settings for small blocks and a rupture that runs for one second.
Variables small(const std::string &prefix) {
  return {{"dx", "500"},   {"length", "20000"}, {"width", "8000"},
          {"tend", "1.5"}, {"weak", "6000"},    {"prefix", prefix}};
}

}  // namespace

using Benchmark = Lmp;

TEST_F(Benchmark, SelfSimilarCrack) {
  const Result r = ran_scene("rupture_crack.in", {{"dx", "200"}, {"speed", "0.5"}});
  const auto [info, records] = unit::read_history(path("crack_200.slip.bin"));
  const double vs = 6000.0 / std::sqrt(3.0), mu = 2670.0 * vs * vs;
  const double tip = 0.5 * vs * info.grid.time(records.back().step_end);
  EXPECT_NEAR(tip, 6000.0, 1e-6);
  double measured = 0.0, shape = 0.0;
  for (int b = 0; b < info.grid.bins; ++b) {
    const double x = info.grid.centre(b);
    if (std::fabs(x) > 0.7 * tip) continue;
    double slip = 0.0;
    for (const LSM::SlipRecord &record : records)
      slip += static_cast<double>(record.row.slip[static_cast<std::size_t>(b)]);
    const double one = 7e6 / mu * std::sqrt(tip * tip - x * x);
    measured += one * slip / std::stod(*info.find("scale"));
    shape += one * one;
  }
  // Freund (1990), section 6.3.3, for vp / vs = sqrt 3
  EXPECT_NEAR(measured / shape, 1.2977, 0.015 * 1.2977);
}

TEST_F(Benchmark, EnergyIsBalanced) {
  for (const char *blocks : {"lattice", "packing"}) {
    Variables variables = small("balance");
    variables.insert(variables.end(), {{"blocks", blocks}, {"overwrite", "yes"}});
    const Result r = ran_scene("rupture_tpv205.in", variables);
    const double friction = r.last("c_ruptures[11]");
    EXPECT_GT(r.last("c_ruptures[15]"), friction);         // the load outside does the work
    EXPECT_GT(r.last("c_ruptures[16]"), 1e-3 * friction);  // and waves have reached the borders
    EXPECT_LT(std::fabs(r.last("c_ruptures[13]")), 2e-4 * friction) << blocks;
    // Nothing is strained before the run.
    const auto first = std::find_if(r.thermo.begin(), r.thermo.end(),
                                    [](const auto &row) { return row.count("c_ruptures[6]") > 0; });
    ASSERT_NE(first, r.thermo.end());
    EXPECT_LT(first->at("c_ruptures[6]"), 1e-9 * friction);
  }
}

// Rate-and-state friction between borders that strengthen, with a stress that still grows when the
// restart file is written.
TEST_F(Benchmark, RateAndStateRuptureGoesOnByteForByte) {
  const auto script = [](const std::string &begin, const std::string &set) {
    return replaced(
        lattice_fault(begin), "pair_style", "fix caps",
        "fix own all property/atom d_a d_theta ghost yes\n" + set +
            "pair_style lsm/friction rate-state-ageing mu 0.6 a d_a b 0.012 dc 1e-6 v0 1e-9 "
            "theta d_theta\npair_coeff * * off\npair_coeff 3 4 1.0 10.0\n"
            "variable more atom 2e-5*(abs(x)<5)*(time*(time<15)+15*(time>=15))\n"
            "fix load all lsm/traction lower upper 1e-3 6e-4 added v_more\n");
  };
  const std::string set =
      "variable a atom 0.008+0.008*(abs(x)>12)\nset group all d_a v_a\nset group all d_theta 1e3\n";
  const std::string end =
      "run 100\nwrite_dump all custom end.dump id vx vy x y modify sort id format float %.17g\n";
  Result one;
  for (const int ranks : {1, 2}) {
    const Result whole =
        ran(script(lattice_of_41, set) + "run 100\nwrite_restart half.restart\n" + end, {}, ranks);
    const std::string expected = read_file(path("end.dump"));
    EXPECT_GT(expected.size(), 10000u);
    ran(script("read_restart half.restart", "") + end, {}, ranks);
    EXPECT_EQ(read_file(path("end.dump")), expected) << ranks << " ranks";
    if (ranks == 1) one = whole;
    EXPECT_LT(thermo_difference(one, whole, {"KinEng", "c_events[11]", "c_events[15]"}), 1e-9);
  }
  EXPECT_GT(one.last("c_events[11]"), 1e-6);  // friction of the rupture
}

TEST_F(Benchmark, PeriodicLatticeSlidesAsAWhole) {
  // The stress exceeds the strength everywhere on the fault: it drops to the dynamic friction, and
  // nothing depends on x, not even across the border of the box.
  const Result r =
      ran(lattice_fault("create_lsm_fault lattice length 40 width 16 spacing 1.0 mass r2 4.0",
                        "p f p") +
          "unfix load\nfix load all lsm/traction lower upper 1e-3 7.5e-4\nrun 200\n"
          "compute least all reduce min vx\ncompute most all reduce max vx\n"
          "group top type 4\ncompute a top reduce min vx\ncompute b top reduce max vx\n"
          "thermo_style custom step c_a c_b c_events[11]\nrun 0\n");
  EXPECT_GT(r.last("c_events[11]"), 1e-6);
  EXPECT_GT(r.last("c_a"), 1e-6);
  EXPECT_NEAR(r.last("c_a"), r.last("c_b"), 1e-9 * r.last("c_b"));
}

TEST_F(Benchmark, AbsorbsPlaneWaves) {
  // A pulse of velocity normal to or along the border in a periodic strip: the energy left at the
  // end is that of the reflections.
  for (const char *component : {"x", "y"}) {
    const std::string along = component;
    const Result r = ran(
        "units lj\ndimension 2\nboundary p f p\nnewton off\natom_style hybrid bond sphere\n"
        "atom_modify map array\nspecial_bonds lj/coul 0 1 1\n"
        "create_lsm_fault lattice length 8 width 160 spacing 1.0 mass r2 4.0\n"
        "comm_modify mode single cutoff 1.8\nneighbor 0.1 bin\nbond_style lsm/linked\n"
        "bond_coeff 1 1.0\nbond_coeff 2 0.5\npair_style lsm/friction\n"
        "pair_coeff * * 1.0 1.0 0.0\ngroup caps type 5 6\n"
        // density 2 / sqrt 3; vp = sqrt(9/8), vs = sqrt(3/8) for mass, k and spacing of 1
        "fix caps caps lsm/absorb y $(2/sqrt(3)*sqrt(9/8):%.17g) $(2/sqrt(3)*sqrt(3/8):%.17g) 1.0\n"
        "variable pulse atom 1e-6*exp(-0.02*(y-40)^2)*(y>0)\n"
        "velocity all set " +
        (along == "x" ? std::string("v_pulse 0 0") : std::string("0 v_pulse 0")) +
        "\nfix move all lsm/nve\ntimestep 0.2\nthermo_style custom step ke f_caps\n"
        "thermo_modify norm no format float %.12g\nrun 0\nrun " +
        (along == "x" ? "1150" : "680") + "\n");
    const double begin = r.thermo.front().at("KinEng");
    // Both halves of the pulse have reached a border: the free fault reflects the one from above.
    EXPECT_LT(r.last("KinEng"), 2e-3 * begin);
    EXPECT_NEAR(r.last("f_caps"), begin, 3e-3 * begin);
  }
}

// A mirrored packing in model units, loaded by the spacing of its discs. Only types 3 and 4 have
// contacts, and nothing else holds the blocks together.
static std::string packing(const std::string &shear, const std::string &share = "share spacing",
                           const std::string &options = "mirror yes faultzone 1e-10") {
  return "units lj\ndimension 2\nboundary p f p\nnewton off\natom_style hybrid bond sphere\n"
         "atom_modify map array\nspecial_bonds lj/coul 0 1 1\n"
         "create_lsm_fault length 30 width 16 seed 4 failures 500 tolerance 1e-11 linkgap 1e-10 " +
         options +
         "\ncomm_modify mode single cutoff 2.3\nneighbor 0.1 bin\n"
         "group lower type 3\ngroup upper type 4\ngroup caps type 5 6\n"
         "bond_style lsm/linked\nbond_coeff 1 1.0\n"
         "pair_style lsm/friction slip-weakening\npair_coeff * * off\n"
         "pair_coeff 3 4 1.0 3.0 mu 0.5 mu_static 0.7 dc 3e-8\n"
         "variable shear atom " +
         shear + "\nfix load all lsm/traction lower upper 1e-6 v_shear " + share +
         "\nfix caps caps lsm/absorb y 0.6 0.3 0.5\nfix move all lsm/nve\ntimestep 0.02\n";
}

TEST_F(Benchmark, CornersAndViscousParticlesAreAbsorbedWithSecondOrder) {
  // A free disc of mass 1 with an impedance of 1 across each border, 0.6 along it and viscosity nu:
  // its velocity decays with the sum of all three.
  for (const auto &[corner, nu] : {std::pair<bool, double>{false, 0.5}, {true, 0.0}, {true, 0.5}}) {
    std::vector<double> error, residual;
    for (const double dt : {0.05, 0.025}) {
      const Result r = ran(
          discs({{"0", "0"}}) +
          "velocity all set 0.1 0 0\npair_style lsm/free\n"
          "pair_coeff * * 1\nbond_style lsm/linked\nbond_coeff 1 1\nfix move all lsm/nve viscosity " +
          text(nu) + "\nfix x all lsm/absorb x 1.0 0.6 1.0\n" +
          (corner ? "fix y all lsm/absorb y 1.0 0.6 1.0\n" : "") + "timestep " + text(dt) +
          "\ncompute events all lsm/events ledger yes\nvariable v equal vcm(all,x)\n" +
          "thermo_style custom step v_v c_events[13]\nthermo_modify norm no format float %.17g\nrun " +
          std::to_string(std::lround(1.0 / dt)) + "\n");
      error.push_back(std::fabs(r.last("v_v") - 0.1 * std::exp(-(corner ? 1.6 : 1.0) - nu)));
      residual.push_back(std::fabs(r.last("c_events[13]")));
    }
    for (const auto &halved : {error, residual})
      EXPECT_NEAR(halved[0] / halved[1], 4.0, 0.4) << corner << " " << nu;
  }
}

TEST_F(Benchmark, MirroredPackingIsLoadedAsAWhole) {
  const char *const run =
      "compute loads all property/atom d_lsm_normal d_lsm_shear\n"
      "compute carried lower reduce sum c_loads[1] c_loads[2]\n"
      "thermo_style custom step ke c_carried[1] c_carried[2]\n"
      "thermo_modify norm no format float %.17g\nrun 200\n";
  for (const int ranks : {1, 2}) {
    // Below the strength nothing moves, and the tractions act on the whole length.
    const Result r = ran(packing("6e-7") + run, {}, ranks);
    EXPECT_NEAR(r.last("c_carried[1]"), 30.0 * 1e-6, 1e-15);
    EXPECT_NEAR(r.last("c_carried[2]"), 30.0 * 6e-7, 1e-15);
    EXPECT_LT(r.last("KinEng"), 1e-24);
  }
  // With share diameter they act only on the part of the line that discs cover.
  const Result r = ran(packing("6e-7", "share diameter") + run);
  EXPECT_LT(r.last("c_carried[1]"), 0.95 * 30.0 * 1e-6);
  EXPECT_GT(r.last("c_carried[1]"), 0.5 * 30.0 * 1e-6);
}

TEST_F(Benchmark, MirroredPackingSlipsAsItsMirrorImage) {
  // A patch above the strength breaks: the motion of one block is the mirror image of that of the
  // other, so that the fault neither opens nor closes.
  for (const int ranks : {1, 2}) {
    const Result r = ran(packing("6.5e-7+1e-7*(abs(x-15)<5)") +
                             "group low type 1 3 5\ngroup high type 2 4 6\n"
                             "compute v1 low reduce sum vx vy\ncompute v2 high reduce sum vx vy\n"
                             "variable size atom abs(vx)\ncompute v3 low reduce sum v_size\n"
                             "thermo_style custom step ke c_v1[1] c_v1[2] c_v2[1] c_v2[2] c_v3\n"
                             "thermo_modify norm no format float %.17g\nrun 300\n",
                         {}, ranks);
    const double size = r.last("c_v3");
    EXPECT_GT(size, 1e-6);
    EXPECT_LT(r.last("c_v1[1]"), -0.1 * size);
    EXPECT_NEAR(r.last("c_v2[1]"), -r.last("c_v1[1]"), 1e-4 * size);
    EXPECT_NEAR(r.last("c_v2[2]"), r.last("c_v1[2]"), 1e-4 * size);
  }
}

TEST_F(Benchmark, WrongInputIsNamed) {
  const std::string begin = lattice_fault();
  refused({"types is 5, but must be at least 6"}, packing("0", "", "types 5"));
  // Refused are blocks with a gap between them, discs near the line that do not touch it, and
  // blocks that are not mirror images.
  refused({"the faces do not touch"},
          packing("0") + "displace_atoms upper move 0 0.05 0 units box\nrun 0\n");
  refused({"faces none of the other side"},
          packing("0", "share spacing", "mirror yes") + "run 0\n");
  refused({"Fix lsm/traction: particle"},
          packing("0", "share spacing", "faultzone 1e-10") + "run 0\n");
  refused({"share spacing", "at the same x"},
          packing("0") + "displace_atoms upper move 0.001 0 0 units box\nrun 0\n");
  refused({"would overlap its partner", "give a larger skin"},
          begin + "neighbor 1e-4 bin\nrun 0\n");
  refused({"'z'", "x or y"}, begin + "fix a caps lsm/absorb z 1.0 1.0 1.0\n");
  refused({"faces none"},
          begin + "unfix load\nfix load all lsm/traction lower caps 1e-3 0\nrun 0\n");
  const std::string added = "unfix load\nfix load all lsm/traction lower upper 1e-3 0 added ";
  refused({"added", "share diameter"}, begin + added + "1e-4 share spacing\n");
  refused({"added traction of particle", "inf", "finite"},
          begin + "variable more atom exp(1000+abs(x))\n" + added + "v_more\nrun 0\n");
  refused({"variable nothing does not exist"},
          begin + "unfix load\nfix load all lsm/traction lower upper 1e-3 v_nothing\nrun 0\n");
  refused({"would overlap"},
          begin + "unfix load\nfix load all lsm/traction lower upper 0.5 0\nrun 0\n");
  refused({"Fix lsm/traction load needs its fix load_store"}, begin + "unfix load_store\nrun 0\n");
}
