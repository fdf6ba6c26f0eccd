// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "friction/force_laws.h"

namespace {

using LSM::Coulomb;
using LSM::CoulombStatic;
using LSM::friction_step;

constexpr Coulomb::Coefficients kOne{2.0, 0.5, 0.5};
constexpr Coulomb::Coefficients kStatic{2.0, 0.5, 0.8};

TEST(Spring, ForceIsTheSlopeOfTheEnergy) {
  const double k = 3.0, h = 1e-5;
  for (double stretch : {-0.2, 0.0, 0.1}) {
    const double slope =
        (LSM::Spring::energy(k, stretch + h) - LSM::Spring::energy(k, stretch - h)) / (2.0 * h);
    EXPECT_NEAR(LSM::Spring::force(k, stretch), slope, 1e-10);
  }
  EXPECT_GT(LSM::Spring::force(k, 0.1), 0.0);  // attraction when stretched
}

TEST(Link, BreaksBeyondTheBreakingDistanceOnly) {
  EXPECT_FALSE(LSM::link_is_broken(1.1, 1.0, 1.1));  // Eq. (1): r <= r_cut holds
  EXPECT_TRUE(LSM::link_is_broken(std::nextafter(1.1, 2.0), 1.0, 1.1));
  EXPECT_FALSE(LSM::link_is_broken(0.1, 1.0, 1.1));
}

TEST(Contact, RepulsiveOnly) {
  EXPECT_DOUBLE_EQ(LSM::contact_normal_force(2.0, 0.9, 1.0), 2.0 * (1.0 - 0.9));
  EXPECT_EQ(LSM::contact_normal_force(2.0, 1.0, 1.0), 0.0);
  EXPECT_EQ(LSM::contact_normal_force(2.0, 1.5, 1.0), 0.0);
}

TEST(Contact, ShareOfTheStepItBeginsIn) {
  EXPECT_EQ(LSM::share_in_contact(1.0, 0.9, 1.0), 1.0);
  EXPECT_NEAR(LSM::share_in_contact(1.3, 0.9, 1.0), 0.25, 1e-15);
  EXPECT_EQ(LSM::share_in_contact(1.3, 1.0, 1.0), 0.0);
  EXPECT_EQ(LSM::share_in_contact(0.9, 0.9, 1.0), 0.0);  // nothing moved: no contact begins
}

// A contact with mu 0.5 and kt 2 sticks below the limit mu fn, Eq. (3), slides at it in both
// directions, and slips the way its spring pulls where it is the load that falls.
TEST(Friction, SticksOrSlides) {
  const struct {
    double fn, xi, dxi, left, slip;
  } steps[] = {{1.0, 0.1, 0.1, 0.2, 0.0},
               {1.0, 0.2, 0.15, 0.25, 0.1},
               {1.0, -0.2, -0.15, -0.25, -0.1},
               {0.1, 0.4, -0.01, 0.025, 0.365}};
  for (const auto &step : steps) {
    const auto s = friction_step<Coulomb>(kOne, {step.fn, step.xi, step.dxi, 0.0, false});
    EXPECT_DOUBLE_EQ(s.xi, step.left);
    EXPECT_DOUBLE_EQ(s.force, 2.0 * step.left);
    EXPECT_NEAR(s.slip, step.slip, 1e-15);
    EXPECT_EQ(s.sliding, step.slip != 0.0);
    EXPECT_EQ(s.dissipated > 0.0, step.slip != 0.0);
  }
}

TEST(StaticFriction, HoldsUpToTheStaticLimitThenDropsToTheDynamicOne) {
  auto s = friction_step<CoulombStatic>(kStatic, {1.0, 0.0, 0.39, 0.0, false});  // pull 0.78 < 0.8
  EXPECT_FALSE(s.sliding);
  EXPECT_DOUBLE_EQ(s.force, 0.78);
  s = friction_step<CoulombStatic>(kStatic, {1.0, s.xi, 0.02, 0.0, s.sliding});  // 0.82
  EXPECT_TRUE(s.sliding);
  EXPECT_DOUBLE_EQ(s.force, 0.5);
  s = friction_step<CoulombStatic>(
      kStatic, {1.0, s.xi, 0.02, 0.0, s.sliding});  // continues to slide below 0.8
  EXPECT_TRUE(s.sliding);
  EXPECT_DOUBLE_EQ(s.force, 0.5);
  s = friction_step<CoulombStatic>(kStatic,
                                   {1.0, s.xi, -0.01, 0.0, s.sliding});  // reversal: sticks again
  EXPECT_FALSE(s.sliding);
  EXPECT_DOUBLE_EQ(s.force, 0.48);
}

TEST(StaticFriction, EqualCoefficientsGiveTheSameAsTheCheaperLaw) {
  double a = 0.0, b = 0.0;
  bool sliding = false;
  for (int step = 0; step < 300; ++step) {
    const double dxi = 0.04 * std::sin(0.13 * step), fn = 1.0 + 0.3 * std::sin(0.05 * step);
    const auto one = friction_step<Coulomb>(kOne, {fn, a, dxi, 0.0, false});
    const auto two = friction_step<CoulombStatic>(kOne, {fn, b, dxi, 0.0, sliding});
    ASSERT_EQ(one.force, two.force);
    ASSERT_EQ(one.dissipated, two.dissipated);
    a = one.xi;
    b = two.xi;
    sliding = two.sliding;
  }
}

TEST(ContactSize, TwiceTheReducedRadius) {
  EXPECT_DOUBLE_EQ(LSM::contact_size(1.0, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(LSM::contact_size(0.1, 1.0), LSM::contact_size(1.0, 0.1));
}

}  // namespace
