// SPDX-License-Identifier: GPL-2.0-or-later
// Waves of the regular lattice compared with closed forms: dispersion of P- and S-waves, Rayleigh
// waves of a free straight border.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lattice_waves.h"
#include "lmp_runner.h"

using namespace physics;

using Waves = Lmp;

namespace {

const std::string scenes = std::string(LSM_INPUTS) + "/../tests/accuracy/";

}  // namespace

TEST_F(Waves, DispersionAsInTheClosedForm) {
  // number of cells, and of waves, along and across the rows
  struct Box {
    int nx, ny, px, py;
  };
  for (const Box &b : {Box{10, 2, 1, 0}, Box{2, 6, 0, 1}, Box{12, 7, 1, 1}, Box{4, 2, 1, 0}})
    for (const bool p : {true, false}) {
      const double kx = 2.0 * lattice_waves::pi * b.px / b.nx;
      const double ky = 2.0 * lattice_waves::pi * b.py / (std::sqrt(3.0) * b.ny);
      const auto mode = lattice_waves::plane_wave(kx, ky, p);
      const Result r =
          ran("include " + scenes + "standing_wave.in\n", {{"nx", std::to_string(b.nx)},
                                                           {"ny", std::to_string(b.ny)},
                                                           {"px", std::to_string(b.px)},
                                                           {"py", std::to_string(b.py)},
                                                           {"ux", text(mode.polarisation[0])},
                                                           {"uy", text(mode.polarisation[1])},
                                                           {"w", text(mode.frequency)}});
      EXPECT_NEAR(r.value("frequency"), mode.frequency, 1e-7 * mode.frequency)
          << b.nx << " " << b.ny << (p ? " P" : " S");
    }
}

TEST_F(Waves, DispersionAtTenSpacings) {
  // As stated in results/validation.md: slower than long waves by 1.5 % (P) and 0.4 % (S)
  // along the rows, and by 1.2 % across them.
  const double k = 0.2 * lattice_waves::pi;
  const auto slow = [k](double kx, double ky, bool p) {
    const double speed = p ? lattice_waves::vp : lattice_waves::vs;
    return 1.0 - lattice_waves::plane_wave(kx, ky, p).frequency / (k * speed);
  };
  EXPECT_NEAR(slow(k, 0.0, true), 0.015, 5e-4);
  EXPECT_NEAR(slow(k, 0.0, false), 0.004, 5e-4);
  EXPECT_NEAR(slow(0.0, k, true), 0.012, 5e-4);
  EXPECT_NEAR(slow(0.0, k, false), 0.012, 5e-4);
}

TEST_F(Waves, RayleighWavesOfAFreeBorder) {
  const double exact = lattice_waves::rayleigh(std::sqrt(3.0));
  EXPECT_NEAR(exact, 0.9194, 5e-5);
  const auto measured = [](int wave, const std::string &border) {
    const Result r = ran("include " + scenes + "rayleigh_wave.in\n",
                         {{"wave", std::to_string(wave)}, {"border", border}});
    std::vector<std::pair<double, double>> samples;
    for (const auto &row : r.thermo) samples.emplace_back(row.at("Time"), row.at("v_a"));
    const auto zeros = lattice_waves::zeros(samples);
    EXPECT_GE(zeros.size(), 8U);
    if (zeros.size() < 2) return 0.0;
    return lattice_waves::frequency(zeros) * wave / (2.0 * lattice_waves::pi) / lattice_waves::vs;
  };
  // The row at the border has half the mass (create_lsm_fault) and half the stiffness.
  const double coarse = measured(10, "0.5") / exact - 1.0, fine = measured(20, "0.5") / exact - 1.0;
  EXPECT_LT(std::fabs(coarse), 2.5e-3);
  EXPECT_LT(std::fabs(fine), 1e-3);
  // with whole links there, the border stiffens and the waves are faster
  EXPECT_GT(measured(20, "1.0") / exact - 1.0, 0.01);
}
