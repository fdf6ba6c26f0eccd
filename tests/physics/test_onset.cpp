// SPDX-License-Identifier: GPL-2.0-or-later
// Onset of a contact within a time step: an oblique bounce with friction.
#include <cmath>

#include "lmp_runner.h"

using namespace physics;

class Onset : public Lmp {
 protected:
  /// A disc hits an equal one at rest. Returns the state after the bounce.
  static Result bounce(const std::string &onset, double dt, double gap, int ranks = 1,
                       const std::string &skin = "0.3") {
    return ran(R"lmp(
units             lj
dimension         2
boundary          f f p
atom_style        sphere
atom_modify       map array
neighbor          ${skin} bin
region            box block -8 8 -6 6 -0.5 0.5
create_box        1 box
create_atoms      1 single 0 0 0
create_atoms      1 single ${x} -0.5 0
set               type 1 diameter 2.0
set               type 1 mass 1.0
group             two id 2
velocity          two set -0.1 0.05 0
pair_style        lsm/friction onset ${onset}
pair_coeff        1 1 1.0 0.3 3.0
timestep          ${dt}
fix               move all lsm/nve
thermo            1000000
run               ${steps}
variable          vx equal vcm(two,x)
variable          vy equal vcm(two,y)
variable          py equal 2*vcm(all,y)
print             "vx = $(v_vx:%.17g)"
print             "vy = $(v_vy:%.17g)"
print             "py = $(v_py:%.17g)"
)lmp",
               {{"onset", onset},
                {"skin", skin},
                {"dt", text(dt)},
                {"x", text(2.0 + gap)},
                {"steps", text(std::round(16.0 / dt))}},
               ranks);
  }
};

TEST_F(Onset, LocatedIsSecondOrderAtTheStepFirst) {
  // The exact bounce does not depend on when within a step it begins: the error is the root mean
  // square over several starts.
  auto error = [](const std::string &onset, double dt) {
    double sum = 0.0;
    for (int n = 0; n < 4; ++n) {
      const double gap = 0.1 + n * 0.1 * dt / 4;
      const Result r = bounce(onset, dt, gap), exact = bounce("located", 0.0025, gap);
      EXPECT_NEAR(r.value("py"), 0.05, 1e-15);
      EXPECT_GT(std::fabs(exact.value("vy") - 0.05), 0.005);  // friction acted
      sum += std::pow(r.value("vx") - exact.value("vx"), 2) +
             std::pow(r.value("vy") - exact.value("vy"), 2);
    }
    return std::sqrt(sum / 4);
  };
  const double located = error("located", 0.16), located_fine = error("located", 0.04);
  const double step = error("step", 0.16), step_fine = error("step", 0.04);
  const double order = std::log(located / located_fine) / std::log(4.0);
  const double order_step = std::log(step / step_fine) / std::log(4.0);
  EXPECT_GT(order, 1.7);
  EXPECT_NEAR(order_step, 1.0, 0.3);
  EXPECT_LT(located_fine, 0.2 * step_fine);
}

// Without a skin no pair is listed before it touches.
TEST_F(Onset, AListWithoutSkinIsWarnedOf) {
  for (const char *skin : {"0.3", "0.0"})
    for (const char *onset : {"located", "step"}) {
      const Result r = bounce(onset, 0.16, 0.1, 1, skin);
      const bool lost = skin[2] == '0' && onset[0] == 'l';
      EXPECT_EQ(r.lines_with("acts as 'onset step'").size(), lost ? 1u : 0u) << skin << onset;
    }
  EXPECT_EQ(bounce("located", 0.16, 0.1, 1, "0.0").value("vy"),
            bounce("step", 0.16, 0.1, 1, "0.3").value("vy"));
}
