// SPDX-License-Identifier: GPL-2.0-or-later
// The friction laws of core/friction: properties that all of them have, and a comparison of each
// with a closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

#include "friction/friction_laws.h"
#include "friction/linear_spring.h"

namespace {

using namespace LSM;

/// A contact whose displacements are prescribed.
template <class Law>
struct Driven {
  typename Law::Coefficients c;
  double fn = 1.0, xi = 0.0, slipped = 0.0, moved = 0.0, lost = 0.0, force = 0.0;
  bool sliding = false;
  double state[2] = {0.0, 0.0};

  explicit Driven(const typename Law::Coefficients &coefficients, double normal = 1.0)
      : c(coefficients), fn(normal) {
    Law::begin(c, state);
  }
  void move(double dxi, double time) {
    const FrictionStep s = friction_step<Law>(c, {fn, xi, dxi, time, sliding}, state);
    xi = s.xi;
    force = s.force;
    sliding = s.sliding;
    slipped += s.slip;
    moved += dxi;
    lost += s.dissipated;
  }
  /// Slides at speed v over a distance, in steps of equal length.
  void slide(double v, double distance, int steps) {
    for (int n = 0; n < steps; ++n) move(distance / steps, std::fabs(distance / v) / steps);
  }
};

/// Valid coefficients of a law.
Coulomb::Coefficients example(Coulomb) { return {2.0, 0.5, 0.5}; }
CoulombStatic::Coefficients example(CoulombStatic) { return {2.0, 0.5, 0.8}; }
SlipWeakening::Coefficients example(SlipWeakening) { return {2.0, 0.5, 0.8, 0.3, 0.0}; }
VelocityWeakening::Coefficients example(VelocityWeakening) { return {2.0, 0.7, 0.5}; }
template <class Evolution>
typename RateState<Evolution>::Coefficients example(RateState<Evolution>) {
  return {2.0, 0.5, 0.01, 0.015, 0.02, 1e-3, 0.0};
}

/// Calls act(law) for each law of the list.
template <class Act>
int for_each_law(Act act) {
  int count = 0;
#define LSM_FRICTION_LAW(Law) act(LSM::Law()), ++count;
#include "friction/friction_laws.h"
#undef LSM_FRICTION_LAW
  return count;
}

TEST(EveryLaw, ClosesTheEnergyBalanceAndLosesWork) {
  const int count = for_each_law([](auto law) {
    using Law = decltype(law);
    Driven<Law> contact(example(law));
    double total = 0.0;
    for (int step = 0; step < 400; ++step) {
      contact.fn = 1.0 + 0.5 * std::cos(0.37 * step);
      const double before = contact.xi, lost = contact.lost, dxi = 0.05 * std::sin(0.1 * step);
      contact.move(dxi, 0.03);
      const double work = 0.5 * contact.c.kt * (before + contact.xi) * dxi;
      const double stored =
          Spring::energy(contact.c.kt, contact.xi) - Spring::energy(contact.c.kt, before);
      ASSERT_NEAR(work, stored + contact.lost - lost, 1e-15) << Law::name;
      ASSERT_NEAR(contact.moved, contact.xi + contact.slipped, 1e-13) << Law::name;
      total += contact.lost - lost;
    }
    EXPECT_GT(total, 0.1) << Law::name;
  });
  EXPECT_GE(count, 6);
}

TEST(EveryLaw, ReleasesALostContactAndIsTheSameBothWays) {
  for_each_law([](auto law) {
    using Law = decltype(law);
    Driven<Law> right(example(law)), left(example(law));
    for (int step = 0; step < 100; ++step) {
      right.move(0.02, 0.03);
      left.move(-0.02, 0.03);
      ASSERT_EQ(right.xi, -left.xi) << Law::name;
      ASSERT_EQ(right.state[0], left.state[0]) << Law::name;
    }
    ASSERT_GT(right.xi, 0.01) << Law::name;
    const double before = right.xi, lost = right.lost;
    right.fn = 0.0;
    right.move(0.0, 0.03);
    EXPECT_EQ(right.xi, 0.0) << Law::name;
    EXPECT_NEAR(right.lost - lost, Spring::energy(right.c.kt, before), 1e-14) << Law::name;
  });
}

TEST(EveryLaw, WithoutTimeAndDisplacementNothingChanges) {
  for_each_law([](auto law) {
    using Law = decltype(law);
    Driven<Law> contact(example(law));
    contact.slide(0.01, 0.1, 50);
    const double xi = contact.xi, state = contact.state[0];
    contact.move(0.0, 0.0);
    EXPECT_EQ(contact.xi, xi) << Law::name;
    EXPECT_EQ(contact.state[0], state) << Law::name;
    EXPECT_EQ(contact.state[1], 0.0) << Law::name;  // no state variables beyond those declared
  });
}

TEST(EveryLaw, NamesItsParameters) {
  for_each_law([](auto law) {
    using Law = decltype(law);
    EXPECT_STREQ(Law::parameters[0].name, "kt") << Law::name;
    EXPECT_EQ(sizeof(typename Law::Coefficients) / sizeof(double), std::size(Law::parameters));
    EXPECT_TRUE((std::is_empty<Law>::value)) << Law::name;
    for (const Parameter &p : Law::parameters)
      if (p.otherwise == Parameter::as_least) {
        EXPECT_GE(p.least, 0) << Law::name << " " << p.name;
      }
  });
  EXPECT_TRUE(Coulomb::fits({1.0, 0.6, 0.6}));
  EXPECT_FALSE(Coulomb::fits({1.0, 0.6, 0.7}));
  EXPECT_TRUE(CoulombStatic::fits({1.0, 0.6, 0.7}));
}

// ---- slip weakening ----

TEST(SlipWeakening, FallsLinearlyWithTheSlip) {
  Driven<SlipWeakening> contact({20.0, 0.5, 0.8, 0.3, 0.0}, 2.0);
  for (int n = 0; n < 60; ++n) {
    contact.move(0.01, 0.1);
    if (!contact.sliding) continue;
    const double mu = contact.slipped < 0.3 ? 0.8 - 0.3 * contact.slipped / 0.3 : 0.5;
    EXPECT_NEAR(contact.force, 2.0 * mu, 1e-14);
  }
  EXPECT_GT(contact.slipped, 0.3);
  EXPECT_EQ(contact.state[0], 0.3);
  // The fracture energy is the work lost in excess of that at the dynamic strength.
  EXPECT_NEAR(contact.lost - 2.0 * 0.5 * contact.slipped, 0.5 * 2.0 * 0.3 * 0.3, 2e-3);
}

TEST(SlipWeakening, DropsAtOnceWhereTheSpringIsSofterThanTheWeakening) {
  Driven<SlipWeakening> contact({1.9, 0.5, 0.8, 0.3, 0.0}, 2.0);  // weakening 2.0 x 0.3 / 0.3
  contact.move(0.84, 0.1);                                        // 1.596 < 1.6
  EXPECT_FALSE(contact.sliding);
  contact.move(0.01, 0.1);
  EXPECT_TRUE(contact.sliding);
  EXPECT_DOUBLE_EQ(contact.force, 1.0);
  EXPECT_NEAR(contact.slipped, 0.85 - 1.0 / 1.9, 1e-15);
}

TEST(SlipWeakening, HealsAtRestWithItsTimeOrNever) {
  for (double heal : {0.0, 4.0}) {
    Driven<SlipWeakening> contact({20.0, 0.5, 0.8, 0.3, heal});
    contact.slide(0.1, 1.0, 100);
    EXPECT_EQ(contact.state[0], 0.3);
    for (int n = 0; n < 70; ++n) contact.move(n == 0 ? -0.001 : 0.0, 0.1);
    EXPECT_FALSE(contact.sliding);
    EXPECT_NEAR(contact.state[0], heal > 0.0 ? 0.3 * std::exp(-7.0 / 4.0) : 0.3, 1e-14);
  }
}

// ---- velocity weakening ----

TEST(VelocityWeakening, IsEquation6) {
  for (double v : {1e-6, 0.01, 0.3, 5.0}) {
    Driven<VelocityWeakening> contact({2.0, 0.7, 0.5}, 1.5);
    contact.slide(v, 4.0, 100);
    EXPECT_NEAR(contact.force, 0.7 * 1.5 / (1.0 + v / 0.5), 1e-14);
  }
  EXPECT_DOUBLE_EQ(VelocityWeakening::friction(0.8, 0.25), 0.8 / 1.25);
}

TEST(VelocityWeakening, SticksBelowTheStrengthAtRest) {
  Driven<VelocityWeakening> contact({2.0, 0.7, 1.0});
  contact.slide(1e-9, 0.349, 10);
  EXPECT_EQ(contact.slipped, 0.0);
  EXPECT_NEAR(contact.force, 0.698, 1e-15);
}

// ---- rate and state ----

template <class Law>
class RateStateLaw : public ::testing::Test {};
using Evolutions = ::testing::Types<RateStateAgeing, RateStateSlip>;
TYPED_TEST_SUITE(RateStateLaw, Evolutions, );  // clang wants the last comma

// The springs are stiff, so that the contact slips at the imposed velocity.
constexpr RateStateAgeing::Coefficients kAgeing{1e6, 0.6, 0.01, 0.015, 0.02, 1e-3, 0.0};
template <class Law>
typename Law::Coefficients stiff() {
  return {kAgeing.kt, kAgeing.mu, kAgeing.a, kAgeing.b, kAgeing.dc, kAgeing.v0, 0.0};
}

TYPED_TEST(RateStateLaw, SteadyStateAsInTheClosedForm) {
  for (double v : {1e-9, 1e-5, 1e-3, 0.1}) {
    Driven<TypeParam> contact(stiff<TypeParam>(), 0.7);
    contact.slide(v, 1.0, 20000);
    EXPECT_NEAR(contact.force / 0.7, 0.6 - 0.005 * std::log(v / 1e-3), 1e-6) << v;
    EXPECT_NEAR(contact.state[0], 0.02 / v, 1e-6 * 0.02 / v);
  }
}

TYPED_TEST(RateStateLaw, VelocityStepAsInTheClosedForm) {
  // The direct effect is a ln 10; then theta evolves with slip, in closed form for either law.
  Driven<TypeParam> contact(stiff<TypeParam>());
  contact.slide(1e-3, 1.0, 20000);
  const double v = 1e-2, before = contact.slipped;
  for (int n = 0; n < 8000; ++n) {
    contact.move(2e-5, 2e-5 / v);
    const double s = (contact.slipped - before) / 0.02, q = std::exp(-s);
    const double theta = std::is_same<TypeParam, RateStateAgeing>::value
                             ? 1.0 + 9.0 * q  // v theta / dc: 10 at first, 1 in the end
                             : std::exp(std::log(10.0) * q);
    EXPECT_NEAR(contact.force, 0.6 + 0.01 * std::log(10.0) + 0.015 * std::log(theta / 10.0), 6e-5);
  }
  EXPECT_NEAR(contact.force, 0.6 - 0.005 * std::log(10.0), 1e-4);
}

TYPED_TEST(RateStateLaw, AnswersHoldsAsItsEvolutionLaw) {
  Driven<TypeParam> contact(stiff<TypeParam>());
  contact.slide(1e-3, 1.0, 20000);
  const double theta = contact.state[0];
  contact.c.kt = 1.0;  // unloaded, so that nothing creeps
  contact.xi = 0.0;
  for (int n = 0; n < 1000; ++n) contact.move(0.0, 1.0);
  if (std::is_same<TypeParam, RateStateAgeing>::value)
    EXPECT_NEAR(contact.state[0], theta + 1000.0, 1e-9 * theta);
  else
    EXPECT_EQ(contact.state[0], theta);
}

TYPED_TEST(RateStateLaw, StateOfASteadySlipIsExactForAnyStep) {
  // Steps range from far below to far above dc/v, and begin below and above the steady state.
  const double dc = 0.02, v = 0.3, steady = dc / v;
  for (double theta : {1e-3 * steady, 0.5 * steady, 20.0 * steady})
    for (double time : {1e-4 * steady, 0.1 * steady, 2.0 * steady, 30.0 * steady}) {
      const double q = std::exp(-time / steady);
      if (std::is_same<TypeParam, RateStateAgeing>::value) {
        const double exact = steady + (theta - steady) * q;
        EXPECT_NEAR(LSM::AgeingEvolution::evolved(theta, v, dc, time), exact,
                    1e-15 * (steady + theta));  // rounding of the two parts
      } else {
        const double exact = steady * std::pow(theta / steady, q);
        EXPECT_NEAR(LSM::SlipEvolution::evolved(theta, v, dc, time), exact, 1e-13 * exact);
      }
    }
}

TYPED_TEST(RateStateLaw, BeginsWithTheStateGivenOrThatOfSteadySlip) {
  auto c = stiff<TypeParam>();
  double theta = 0.0;
  TypeParam::begin(c, &theta);
  EXPECT_EQ(theta, c.dc / c.v0);
  c.theta = 3.0;
  TypeParam::begin(c, &theta);
  EXPECT_EQ(theta, 3.0);
}

TYPED_TEST(RateStateLaw, ForceSpringAndVelocityAgreeForAnyStep) {
  // The solution satisfies the equation, from creep to steps much longer than dc, also with
  // coefficients for which the straightforward formula overflows.
  for (double a : {0.0008, 0.01, 0.3})
    for (double dxi : {1e-12, 1e-6, 1e-3, 0.5})
      for (double xi : {0.0, 0.2, 0.4})
        for (double kt : {0.01, 2.0, 1e4}) {
          const double fn = 1.3, time = 0.03, theta = 5.0;
          double state[1] = {theta};
          const typename TypeParam::Coefficients c{kt, 0.6, a, 0.015, 0.02, 1e-3, 0.0};
          const FrictionStep s = friction_step<TypeParam>(c, {fn, xi, dxi, time, false}, state);
          const double E = (0.6 + 0.015 * std::log(1e-3 * theta / 0.02)) / a,
                       q = s.force / (fn * a);
          const double v = 1e-3 * (std::exp(q - E) - std::exp(-q - E));
          EXPECT_NEAR(s.xi + v * time, xi + dxi, 1e-11 * (xi + dxi) + 1e-19)
              << a << " " << dxi << " " << xi << " " << kt;
          EXPECT_GE(s.xi, 0.0);
          EXPECT_GT(state[0], 0.0);
          EXPECT_TRUE(std::isfinite(state[0]));
        }
}

}  // namespace
