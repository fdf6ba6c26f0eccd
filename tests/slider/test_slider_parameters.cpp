// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "slider_parameters.h"

namespace Slider {
namespace {

std::string message(const Parameters &p, bool force = false) {
  try {
    check(p, force);
  } catch (const std::invalid_argument &e) {
    return e.what();
  }
  return "";
}

TEST(SliderParameters, StabilityLimits) {
  Parameters p;
  EXPECT_NEAR(stability_limit(p), 2.0 / std::sqrt(4.01), 1e-12);
  p.dt = 1.0;
  const std::string text = message(p);
  EXPECT_NE(text.find("--dt = 1,"), std::string::npos) << text;
  EXPECT_NE(text.find("0.998"), std::string::npos) << text;
  p.dt = 0.998;
  EXPECT_EQ(message(p), "");
  p.blocks = 1;  // no coupling spring is stretched
  EXPECT_NEAR(stability_limit(p), 20.0, 1e-12);
  p.blocks = 3;  // the shortest wave has a length of three blocks
  EXPECT_NEAR(stability_limit(p), 2.0 / std::sqrt(3.01), 1e-12);
}

TEST(SliderParameters, RandomFrictionDependsOnSeedOnly) {
  const auto a = random_friction(100, 0.5, 1.0, 1), b = random_friction(200, 0.5, 1.0, 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i], b[i]);
    EXPECT_GE(a[i], 0.5);
    EXPECT_LT(a[i], 1.0);
  }
  EXPECT_NE(a, random_friction(100, 0.5, 1.0, 2));
}

}  // namespace
}  // namespace Slider
