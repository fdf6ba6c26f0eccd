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

TEST(SliderParameters, DefaultsAreSound) { EXPECT_EQ(message(Parameters()), ""); }

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

TEST(SliderParameters, PrintedSchemeIsRefusedUnlessForced) {
  Parameters p;
  p.scheme = Scheme::printed;
  p.dt = 0.12;
  EXPECT_NE(message(p), "");
  EXPECT_EQ(message(p, true), "");
  p.dt = 0.119;
  EXPECT_EQ(message(p), "");
  p.radiation = 0.1;
  EXPECT_EQ(message(p), scheme_needs);
}

TEST(SliderParameters, BadValuesNameTheOption) {
  Parameters p;
  p.kc = -1.0;
  EXPECT_NE(message(p).find("--kc = -1"), std::string::npos);
  p = Parameters();
  p.kl = 0.0;
  EXPECT_NE(message(p).find("--kl"), std::string::npos);
  p = Parameters();
  p.mass = std::nan("");
  EXPECT_NE(message(p).find("--mass"), std::string::npos);
  p = Parameters();
  p.blocks = 0;
  EXPECT_NE(message(p).find("--blocks"), std::string::npos);
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
