// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over contacts with friction, without LAMMPS: rough rows of discs slide past each other,
// also as a plane of space; single contacts in space.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "friction/friction_laws.h"
#include "lsm_friction_loop.h"

namespace {

using namespace LAMMPS_NS;
using LSM::friction_contact::Step;
using LSM::friction_contact::Vector;
using LSMFriction::Loop;
using LSMFriction::Scene;

constexpr double stiffness = 1.0, kt = 0.5, mu = 0.3, dt = 0.05;

/// Counts the calls.
struct Host : LSMFriction::Host {
  void tally(const LSMContacts::Pair &, double energy, const Vector &force,
             const Vector &del) override {
    energies += energy;
    virial += LSM::friction_contact::dot(force, del);
  }
  double energies = 0.0, virial = 0.0;
};

/// Two rows of discs, all pairs between which are kept. The upper row is pushed along the lower
/// one and up and down, so that contacts begin, slide, stick and end.
struct Rows {
  static constexpr int each = 60;
  const int dim;
  std::array<Vector, 3> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // of the rows, in space
  std::vector<double> x, f, radius;
  LSMContacts contacts;
  LSMTypePairs<double> k, delay, coefficients[LSM::CoulombStatic::state_size + 8];
  double power = 0.0;  // of dashpots, all evaluations
  LSMEnergySource energies;
  Host host;
  int n = 0;
  double turns = 2.0 * std::acos(-1.0);
  std::vector<double> before;  // positions of the step before

  explicit Rows(int state_size, int dimension = 2) : dim(dimension), x(6 * each), f(6 * each) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(0.8, 1.0);
    for (int i = 0; i < 2 * each; ++i) radius.push_back(any(random));
    k.create(2);
    k[1][1] = stiffness;
    delay.create(2);
    energies.record_what = LSMEnergySource::ENERGY | LSMEnergySource::SLIP_RATE;
    contacts.begin(state_size, dim);
    for (int i = 0; i < each; ++i)
      for (int j = each; j < 2 * each; ++j)
        if (std::abs(i - (j - each)) < 6)
          contacts.add({i, j, k.place(1, 1), 0, radius[i] + radius[j],
                        LSM::contact_size(radius[i], radius[j])},
                       false);
    move_to(0);
  }
  void set(int p, double value) {
    coefficients[p].create(2);
    coefficients[p][1][1] = value;
  }
  void move_to(int step) {
    n = step;
    before = x;
    for (int i = 0; i < each; ++i) {
      x[3 * i] = 1.9 * i;
      x[3 * (each + i)] = 1.9 * i + 3.0 * std::sin(turns * step / 4000.0) + 0.02 * std::sin(i);
      x[3 * (each + i) + 1] = 1.68 + 0.06 * std::sin(turns * step / 370.0 + i);
    }
  }
  template <class Law, class Recorder = LSMRecordEnergies>
  void evaluate(bool setup = false) {
    std::fill(f.begin(), f.end(), 0.0);
    std::vector<double> in_space(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int c = 0; c < 3; ++c)
        in_space[i - i % 3 + static_cast<std::size_t>(c)] += x[i] * axes[i % 3][c];
    contacts.find(in_space.data());
    using Motion = LSMLinkKernel::Motion<2>;
    std::vector<double> motion(Motion::SIZE * x.size() / 3, 0.0);
    for (std::size_t i = 0; i < x.size() / 3; ++i)
      for (std::size_t c = 0; c < 2; ++c)
        motion[Motion::SIZE * i + c] = (x[3 * i + c] - before[3 * i + c]) / dt;
    const Scene scene = {contacts,
                         host,
                         energies,
                         in_space.data(),
                         f.data(),
                         2 * each,
                         false,
                         Step{setup, 1e-12, dt, true},
                         LSM::friction_contact::NEAR_REACH,
                         k,
                         coefficients,
                         delay,
                         delay[1][1] > 0.0 ? motion.data() : nullptr,
                         &power};
    if (dim == 2) return Loop<Law, Recorder, 2>(scene).run();
    Loop<Law, Recorder, 3>(scene).run();
    for (std::size_t i = 0; i < f.size(); i += 3) {
      const Vector force = {f[i], f[i + 1], f[i + 2]};
      for (std::size_t c = 0; c < 3; ++c) f[i + c] = LSM::friction_contact::dot(force, axes[c]);
    }
  }
};

template <class Law, int DIM = 2>
Rows rows_of(const std::vector<double> &values) {
  Rows rows(LSM::friction_contact::Kept<DIM>::LAW_STATE + Law::state_size, DIM);
  for (std::size_t p = 0; p < values.size(); ++p) rows.set(static_cast<int>(p), values[p]);
  return rows;
}

/// Force on the upper row and energies by a second, slow implementation of Coulomb's law, which
/// keeps the path of each pair.
struct Slow {
  struct Contact {
    double dx = 0.0, dy = 0.0, xi = 0.0;
    bool known = false, touches = false;
  };
  std::vector<Contact> all;
  double fx = 0.0, fy = 0.0, normal = 0.0, tangential = 0.0, lost = 0.0, moment = 0.0;
  int began = 0, ended = 0, slid = 0, stuck = 0;

  void step(const Rows &rows) {
    all.resize(rows.contacts.count());
    fx = fy = normal = tangential = 0.0;
    for (int p = 0; p < rows.contacts.count(); ++p) {
      const LSMContacts::Pair &pair = rows.contacts.pair(p);
      Contact &c = all[p];
      const double dx = rows.x[3 * pair.i] - rows.x[3 * pair.j],
                   dy = rows.x[3 * pair.i + 1] - rows.x[3 * pair.j + 1];
      const double r = std::hypot(dx, dy), before = std::hypot(c.dx, c.dy);
      const bool touches = r < pair.r0;
      const double push = touches ? stiffness * (pair.r0 - r) : 0.0;
      if (touches || c.touches) {
        double share = 1.0;
        if (!c.touches) {
          ++began;
          c.xi = 0.0;
          share = c.known && before <= 1.05 * pair.r0 ? (pair.r0 - r) / (before - r) : 0.0;
        }
        // Along the tangent in the middle of the step, (-ny, nx).
        const double mx = dx + c.dx, my = dy + c.dy, m = std::hypot(mx, my);
        const double along = c.known ? (-my * (dx - c.dx) + mx * (dy - c.dy)) / m * share : 0.0;
        const double trial = c.xi + along, most = mu * push / kt;
        const double xi = std::copysign(std::min(std::fabs(trial), most), trial);
        lost += 0.5 * kt * (c.xi + xi) * (trial - xi);
        moment += std::fabs(trial - xi) * pair.size;
        if (touches) ++(xi != trial ? slid : stuck);
        ended += !touches;
        c.xi = touches ? xi : 0.0;
        if (touches) {
          fx -= push * dx / r + kt * xi * dy / r;
          fy -= push * dy / r - kt * xi * dx / r;
          normal += 0.5 * stiffness * (pair.r0 - r) * (pair.r0 - r);
          tangential += 0.5 * kt * xi * xi;
        }
      }
      c.dx = dx;
      c.dy = dy;
      c.touches = touches;
      c.known = true;
    }
  }
};

TEST(FrictionLoop, IsThatOfASlowSecondImplementation) {
  Rows rows = rows_of<LSM::Coulomb>({kt, mu, mu});
  Slow slow;
  double most = 0.0;
  for (int n = 0; n < 3000; ++n) {
    rows.move_to(n);
    rows.evaluate<LSM::Coulomb>();
    slow.step(rows);
    double fx = 0.0, fy = 0.0, sum = 0.0;
    for (int i = 0; i < 2 * Rows::each; ++i) {
      sum += rows.f[3 * i];
      if (i < Rows::each) continue;
      fx += rows.f[3 * i];
      fy += rows.f[3 * i + 1];
    }
    most = std::max(most, std::fabs(fx));
    ASSERT_NEAR(fx, slow.fx, 1e-11) << "step " << n;
    ASSERT_NEAR(fy, slow.fy, 1e-11) << "step " << n;
    ASSERT_NEAR(sum, 0.0, 1e-11) << "action and reaction";
    ASSERT_NEAR(rows.energies.pe_contact, slow.normal, 1e-11);
    ASSERT_NEAR(rows.energies.pe_tangential, slow.tangential, 1e-11);
    ASSERT_NEAR(rows.energies.work_friction, slow.lost, 1e-10);
    ASSERT_NEAR(rows.energies.slip_moment, slow.moment, 1e-10);
  }
  EXPECT_GT(most, 0.05);
  for (const int count : {slow.began, slow.ended, slow.slid, slow.stuck}) EXPECT_GT(count, 250);
}

/// Contacts are computed side by side, or one by one where LAMMPS' own sums are tallied: to the
/// last bit, forces, states and sums are the same.
template <class Law>
void side_by_side(const std::vector<double> &values, double delay = 0.0) {
  Rows together = rows_of<Law>(values), one_by_one = rows_of<Law>(values);
  together.delay[1][1] = one_by_one.delay[1][1] = delay;
  for (int n = 0; n < 1500; ++n) {
    for (Rows *rows : {&together, &one_by_one}) {
      rows->move_to(n);
      rows == &together ? rows->evaluate<Law>() : rows->evaluate<Law, LSMRecordAndTally>();
    }
    ASSERT_EQ(together.f, one_by_one.f) << "step " << n;
    ASSERT_EQ(together.energies.work_friction, one_by_one.energies.work_friction) << "step " << n;
    ASSERT_EQ(together.power, one_by_one.power) << "step " << n;
  }
  EXPECT_EQ(together.power > 1e-3, delay > 0.0);
  EXPECT_GT(together.energies.work_friction, 0.1);
  for (int p = 0; p < together.contacts.count(); ++p)
    ASSERT_EQ(together.contacts.is_touching(p), one_by_one.contacts.is_touching(p));
}

TEST(FrictionLoop, GivesTheSameDigitsSideBySideAndOneByOne) {
  side_by_side<LSM::Coulomb>({kt, mu, mu});
  side_by_side<LSM::CoulombStatic>({kt, mu, 0.5});
  side_by_side<LSM::VelocityWeakening>({kt, mu, 0.5});
  side_by_side<LSM::Coulomb>({kt, mu, mu}, 0.1);
}

// The setup of a run evaluates a step that was done.
TEST(FrictionLoop, ASetupChangesNothing) {
  Rows once = rows_of<LSM::CoulombStatic>({kt, mu, 0.5}), again = once;
  double lost = 0.0;
  for (int n = 0; n < 800; ++n) {
    for (Rows *rows : {&once, &again}) {
      rows->move_to(n);
      rows->evaluate<LSM::CoulombStatic>();
    }
    if (n != 400) continue;
    lost = once.energies.work_friction;
    again.evaluate<LSM::CoulombStatic>(true);
    EXPECT_EQ(again.f, once.f);
    EXPECT_EQ(again.energies.work_friction, lost);
  }
  EXPECT_EQ(again.energies.work_friction, once.energies.work_friction);
  EXPECT_GT(once.energies.work_friction, 1.1 * lost);
}

// LAMMPS' own sums are those of the energies, and the virial that of the forces.
TEST(FrictionLoop, TalliesWhatItRecords) {
  Rows rows = rows_of<LSM::Coulomb>({kt, mu, mu});
  for (int n = 0; n < 500; ++n) {
    rows.move_to(n);
    rows.host.energies = rows.host.virial = 0.0;
    rows.evaluate<LSM::Coulomb, LSMRecordAndTally>();
    double virial = 0.0;
    for (std::size_t i = 0; i < rows.x.size(); ++i) virial += rows.f[i] * rows.x[i];
    ASSERT_NEAR(rows.host.energies, rows.energies.pe_contact + rows.energies.pe_tangential, 1e-11);
    ASSERT_NEAR(rows.host.virial, virial, 1e-9);
  }
  EXPECT_GT(rows.host.energies, 0.0);
}

// ---- three dimensions

/// An orthonormal frame at random.
std::array<Vector, 3> any_frame(std::mt19937_64 &random) {
  using namespace LSM::friction_contact;
  std::normal_distribution<double> any;
  const Vector a = unit({any(random), any(random), any(random)});
  Vector b = {any(random), any(random), any(random)};
  const double along = dot(a, b);
  for (int c = 0; c < 3; ++c) b[c] -= along * a[c];
  b = unit(b);
  return {a, b, {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

/// Motion in a plane of space, at any angle, gives the digits of two dimensions within rounding.
template <class Law>
void embedded(const std::vector<double> &values) {
  std::mt19937_64 random(3);
  for (int frame = 0; frame < 3; ++frame) {
    Rows plane = rows_of<Law>(values), space = rows_of<Law, 3>(values);
    if (frame) space.axes = any_frame(random);
    double most = 0.0;
    for (int n = 0; n < 1500; ++n) {
      for (Rows *rows : {&plane, &space}) {
        rows->move_to(n);
        rows->evaluate<Law>(n == 700);
      }
      for (std::size_t i = 0; i < plane.f.size(); ++i) {
        most = std::max(most, std::fabs(plane.f[i]));
        ASSERT_NEAR(plane.f[i], space.f[i], 1e-11) << Law::name << ", step " << n << ", " << i;
      }
      ASSERT_NEAR(plane.energies.pe_tangential, space.energies.pe_tangential, 1e-11);
    }
    EXPECT_GT(most, 0.01);
    EXPECT_NEAR(plane.energies.work_friction, space.energies.work_friction, 1e-9);
    EXPECT_NEAR(plane.energies.slip_moment, space.energies.slip_moment, 1e-9);
    EXPECT_GT(space.energies.work_friction, 0.1);
  }
}

TEST(FrictionInSpace, APlaneGivesTheDigitsOfTwoDimensions) {
  embedded<LSM::Coulomb>({kt, mu, mu});
  embedded<LSM::CoulombStatic>({kt, mu, 0.5});
  embedded<LSM::SlipWeakening>({kt, mu, 0.5, 0.1, 20.0});
  embedded<LSM::VelocityWeakening>({kt, mu, 0.5});
  embedded<LSM::RateStateAgeing>({kt, mu, 0.02, 0.03, 0.1, 0.01, 1.0});
  embedded<LSM::RateStateSlip>({kt, mu, 0.02, 0.03, 0.1, 0.01, 1.0});
}

/// One contact in space: a particle beyond another, which is so large that it is a plane across the
/// third axis of the frame, unless r is small.
template <class Law>
struct Contact {
  using Is = LSM::friction_contact::Kept<3>;
  typename Law::Coefficients c;
  double fn, dt = 0.05, r = 1e7, lost = 0.0, slip = 0.0;
  std::array<Vector, 3> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  double h[Is::LAW_STATE + Law::state_size + 1] = {};
  bool touch = false;

  Contact(const typename Law::Coefficients &of, double normal) : c(of), fn(normal) {}
  /// Moves to a place on the plane and returns the elongation along the first two axes.
  std::array<double, 2> to(double a, double b) {
    Vector d{};
    for (int n = 0; n < 3; ++n) d[n] = a * axes[0][n] + b * axes[1][n] + r * axes[2][n];
    LSM::FrictionContact contact{fn, 0.0, 0.0, 0.0, false};
    LSM::friction_contact::Along<3> dxi{};
    const LSM::friction_contact::Step step{false, 0.0, dt, true};
    const bool moved = LSM::friction_contact::follow<Law, 3>(step, c, d.data(), r, r + 1.0, touch,
                                                             h, contact, dxi);
    const auto done = LSM::friction_contact::next<Law, 3>(moved, c, contact, d.data(), dxi, h);
    LSM::friction_contact::keep<Law, 3>(done, d.data(), h);
    lost += done.dissipated;
    slip += done.slip;
    return {LSM::friction_contact::dot(done.xi, axes[0]),
            LSM::friction_contact::dot(done.xi, axes[1])};
  }
};

// A particle that is driven around a circle of radius R: its spring, of length e = mu fn / kt,
// leads to a point that slides in its direction, hence around a circle of radius sqrt(R^2 - e^2) to
// which the spring is tangent.
TEST(FrictionInSpace, ASphereDrivenInACircle) {
  const double R = 2.0, fn = 1.0, e = mu * fn / kt, inner = std::sqrt(R * R - e * e);
  std::mt19937_64 random(8);
  double error[2];
  for (int k = 0; k < 2; ++k) {
    const int turn = 2000 << k;
    Contact<LSM::Coulomb> contact({kt, mu, mu}, fn);
    contact.axes = any_frame(random);
    double before = 0.0, slip = 0.0;
    std::array<double, 2> xi{};
    for (int n = 0; n <= 3 * turn; ++n) {
      const double angle = 2.0 * std::acos(-1.0) * n / turn;
      xi = contact.to(R * std::cos(angle), R * std::sin(angle));
      if (n == 2 * turn) before = contact.lost, slip = contact.slip;
    }
    EXPECT_NEAR(std::hypot(xi[0], xi[1]), e, 1e-9);
    // in the end the particle is at angle 0, and moves along the second axis
    EXPECT_NEAR(xi[0], e * e / R, 2e-3);
    EXPECT_NEAR(xi[1], e * inner / R, 2e-3);
    const double around = 2.0 * std::acos(-1.0) * inner;
    EXPECT_NEAR(contact.slip - slip, around, 1e-3 * around);
    error[k] = std::fabs(contact.lost - before - mu * fn * around);
    EXPECT_LT(error[k], 1e-3 * mu * fn * around);
  }
  EXPECT_LT(error[1], 0.6 * error[0]);
}

/// Along any path on a plane, the work of the spring's force, by the trapezoidal rule, is what it
/// stores and what friction takes.
template <class Law>
void balances(const typename Law::Coefficients &c) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> any;
  Contact<Law> contact(c, 0.8);
  contact.axes = any_frame(random);
  std::array<double, 2> place{}, xi = contact.to(0, 0);
  double work = 0.0;
  for (int n = 0; n < 4000; ++n) {
    const double wide = n % 40 < 20 ? 0.3 : 0.003;  // slides and sticks
    const std::array<double, 2> by = {wide * any(random), wide * any(random)}, before = xi;
    xi = contact.to(place[0] += by[0], place[1] += by[1]);
    for (int a : {0, 1}) work += 0.5 * c.kt * (xi[a] + before[a]) * by[a];
  }
  const double stored = 0.5 * c.kt * (xi[0] * xi[0] + xi[1] * xi[1]);
  EXPECT_NEAR(work, stored + contact.lost, 1e-5 * work) << Law::name;
  EXPECT_GT(contact.lost, 100.0 * stored);
  EXPECT_GT(contact.slip, 10.0);
}

TEST(FrictionInSpace, EnergyIsBalancedOnAnyPath) {
  balances<LSM::Coulomb>({kt, mu, mu});
  balances<LSM::CoulombStatic>({kt, mu, 0.5});
  balances<LSM::SlipWeakening>({kt, mu, 0.5, 0.1, 20.0});
  balances<LSM::VelocityWeakening>({kt, mu, 0.5});
  balances<LSM::RateStateAgeing>({kt, mu, 0.02, 0.03, 0.1, 0.01, 1.0});
}

// Around a circle of latitude a vector in the tangent plane turns by the solid angle.
TEST(FrictionInSpace, ASpringIsCarriedAroundASphere) {
  using namespace LSM::friction_contact;
  const double pi = std::acos(-1.0);
  std::mt19937_64 random(6);
  for (const double latitude : {0.2, 0.9, 1.5}) {
    const auto axes = any_frame(random);
    const auto normal = [&](double angle) {
      Vector n{};
      for (int c = 0; c < 3; ++c)
        n[c] = std::sin(latitude) * (std::cos(angle) * axes[0][c] + std::sin(angle) * axes[1][c]) +
               std::cos(latitude) * axes[2][c];
      return n;
    };
    double error[2];
    for (int k = 0; k < 2; ++k) {
      const int steps = 400 << k;
      const Vector begun = axes[1];  // to the east at angle 0
      Vector v = begun;
      for (int n = 0; n < steps; ++n)
        v = turned(v, normal(2.0 * pi * n / steps), normal(2.0 * pi * (n + 1) / steps));
      EXPECT_NEAR(dot(v, v), 1.0, 1e-12);
      EXPECT_NEAR(dot(v, normal(0)), 0.0, 1e-12);
      error[k] = std::fabs(dot(v, begun) - std::cos(2.0 * pi * (1.0 - std::cos(latitude))));
      EXPECT_LT(error[k], 1e-3);
    }
    EXPECT_LT(error[1], 0.3 * error[0] + 1e-12) << "of second order";
  }
}

// A pair that sticks and turns as a whole is displaced by the arc, in the direction in which it
// turns in the end, however wide the steps are.
TEST(FrictionInSpace, APairThatTurnsIsDisplacedByTheArc) {
  std::mt19937_64 random(9);
  const double pi = std::acos(-1.0), r = 1.5;
  for (const int steps : {6, 48}) {
    Contact<LSM::Coulomb> contact({kt, 1e9, 1e9}, 1.0);
    contact.axes = any_frame(random);
    std::array<double, 2> xi{};
    for (int n = 0; n <= steps; ++n) {  // a quarter turn from the third axis to the first
      contact.r = r * std::cos(0.5 * pi * n / steps);
      xi = contact.to(r * std::sin(0.5 * pi * n / steps), 0.0);
    }
    const double chords = 2.0 * steps * r * std::sin(0.25 * pi / steps);
    EXPECT_NEAR(std::sqrt(LSM::friction_contact::square_of<3>(contact.h)), chords, 1e-12);
    EXPECT_NEAR(
        LSM::friction_contact::dot({contact.h[0], contact.h[1], contact.h[2]}, contact.axes[2]),
        -chords, 1e-12);
    EXPECT_NEAR(xi[0], 0.0, 1e-12);
    EXPECT_NEAR(xi[1], 0.0, 1e-12);
  }
}

}  // namespace
