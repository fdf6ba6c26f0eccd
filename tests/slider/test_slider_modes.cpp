// SPDX-License-Identifier: GPL-2.0-or-later
// The coupling of blocks by a stiffness per mode, and strengths that vary with displacement.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scalar_chain.h"
#include "slider_chain.h"
#include "slider_ways.h"

namespace Slider {
namespace {

constexpr Coupling strips[] = {Coupling::antiplane, Coupling::inplane};

// K(q) in plane of two blocks with Lame constants 1 and 1, by integrating Navier's equations from
// the plate to the fault. u_x = U cos q x, u_y = V sin q x; the state is U, V, U', V'.
double inplane_by_shooting(double q, double width) {
  gsl_odeiv2_system navier{[](double, const double *y, double *dy, void *wavenumber) {
                             const double k = *static_cast<double *>(wavenumber);
                             dy[0] = y[2];
                             dy[1] = y[3];
                             dy[2] = 3.0 * k * k * y[0] - 2.0 * k * y[3];
                             dy[3] = (k * k * y[1] + 2.0 * k * y[2]) / 3.0;
                             return int{GSL_SUCCESS};
                           },
                           nullptr, 4, &q};
  const auto from_plate = [&](std::array<double, 4> y) {
    double at = 0.0;
    gsl_odeiv2_driver *const driver =
        gsl_odeiv2_driver_alloc_y_new(&navier, gsl_odeiv2_step_rk8pd, 1e-3, 0.0, 1e-12);
    EXPECT_EQ(gsl_odeiv2_driver_apply(driver, &at, width, y.data()), GSL_SUCCESS);
    gsl_odeiv2_driver_free(driver);
    return y;
  };
  const auto a = from_plate({0.0, 0.0, 1.0, 0.0}), b = from_plate({0.0, 0.0, 0.0, 1.0});
  // The fault has no change of the normal stress.
  const double mixed = -(3.0 * a[3] - q * a[0]) / (3.0 * b[3] - q * b[0]);
  return 0.5 * ((a[2] + mixed * b[2]) + q * (a[1] + mixed * b[1])) / (a[0] + mixed * b[0]);
}

TEST(SliderStiffness, ClosedFormsSolveTheEquationsOfElasticity) {
  for (const double width : {1.0, 5.0, 20.0})
    for (const double q : {0.01, 0.1, 0.3, 0.7}) {
      EXPECT_NEAR(strip_stiffness(Coupling::antiplane, q, width), q / std::tanh(q * width), 1e-12);
      const double inplane = inplane_by_shooting(q, width);
      EXPECT_NEAR(0.5 * strip_stiffness(Coupling::inplane, q, width) / inplane, 1.0, 1e-6)
          << q << " " << width;
    }
}

TEST(SliderStiffness, LimitsOfThinAndThickBlocks) {
  for (const Coupling coupling : strips) {
    for (const double q : {0.0, 1e-9, 1e-7, 1e-5})
      EXPECT_NEAR(strip_stiffness(coupling, q, 7.0), 1.0 / 7.0, 1e-5) << q;
    const double half_space = coupling == Coupling::inplane ? 1.0 / (1.0 - poisson) : 1.0;
    for (const double q : {0.1, 1.0, 3.0})
      EXPECT_NEAR(strip_stiffness(coupling, q, 1e4), half_space * q, 1e-12) << q;
  }
}

TEST(SliderStiffness, ABlockAloneFeelsWhatItFeelsInTheChain) {
  for (const Coupling coupling : strips)
    for (const double kl : {0.01, 0.1, 1.0}) {
      const Strip strip = strip_of_leaf_spring(coupling, 1.0, kl);
      EXPECT_NEAR(strip.modulus / strip.width, kl, 1e-12);
      const Strip again = strip_of_width(coupling, 1.0, strip.width);
      EXPECT_NEAR(again.modulus, strip.modulus, 1e-9);
      const int n = 2000;
      const std::vector<double> modes = modes_of(coupling, strip, n);
      double alone = modes.front() + modes.back();
      for (std::size_t k = 1; k + 1 < modes.size(); ++k) alone += 2.0 * modes[k];
      EXPECT_NEAR(alone / n, 2.0 + kl, 1e-5) << to_string(coupling) << " " << kl;
    }
  EXPECT_NEAR(strip_of_leaf_spring(Coupling::antiplane, 1.0, 0.01).modulus, 2.01 * 2.0 / LSM::pi,
              1e-4);
}

TEST(SliderModes, ForcesAreThoseOfTheSumOverAllPairs) {
  for (const int n : {1, 2, 3, 5, 7, 64, 101, 512, 1009}) {
    const Parameters p = coupled(Coupling::inplane, n);
    const std::vector<double> c = coupling_of(p);
    LSM::Random random(3);
    std::vector<double> u(static_cast<std::size_t>(n));
    for (double &x : u) x = 1000.0 + random.uniform(-10.0, 10.0);
    ModeForces forces(p.modes, n);
    const double *const force = forces.find(u.data());
    for (std::size_t i = 0; i < u.size(); ++i)
      ASSERT_NEAR(force[i], coupling_force(p, c, u.data(), i), 1e-11) << n << " " << i;
  }
}

TEST(SliderModes, StiffnessOfSpringsGivesTheChain) {
  Parameters springs;
  springs.blocks = 60;
  springs.kl = 0.1;
  springs.velocity = 0.1;
  Parameters modes = springs;
  for (int n = 0; n <= 30; ++n)
    modes.modes.push_back(stiffness_of_springs(springs, 2.0 * LSM::pi * n / 60));
  const auto mu = random_friction(60, 0.5, 1.0, 4);
  Chain chain(springs, mu, false), bulk(modes, mu, false);
  // It takes some 300 time units for chaos to amplify a difference in the last digit.
  for (int n = 0; n < 3000; ++n) {
    chain.advance();
    bulk.advance();
  }
  EXPECT_GT(chain.moved(), 1000);
  const auto a = chain.displacements(), b = bulk.displacements();
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-7);
  EXPECT_NEAR(chain.pe(), bulk.pe(), 1e-7 * chain.pe());
}

TEST(SliderModes, StrengthsAreDrawnAnewAlongTheWay) {
  Parameters p;
  p.blocks = 1;
  p.kl = 1.0;
  p.friction = {Law::coulomb, 1.0};
  p.landscape = {0.25, 0.6, 0.9, 5};
  Chain chain(p, {0.75}, false);
  // The strength is the force of the leaf spring at which the block starts.
  std::vector<double> strengths;
  bool rested = true;
  for (int n = 0; n < 400000; ++n) {
    const double before = chain.slip_sum(), force = p.kl * (chain.plate() - before);
    chain.advance();
    const bool slides = chain.slip_sum() > before;
    if (slides && rested) strengths.push_back(force);
    rested = !slides;
  }
  ASSERT_GT(strengths.size(), 100U);
  const auto [low, high] = std::minmax_element(strengths.begin(), strengths.end());
  EXPECT_GT(*low, 0.59);
  EXPECT_LT(*high, 0.91);
  EXPECT_GT(*high - *low, 0.25);
  EXPECT_GT(chain.slip_sum(), 100.0);
}

}  // namespace
}  // namespace Slider
