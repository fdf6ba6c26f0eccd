// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over contacts with friction, without LAMMPS: rough rows of discs slide past each other.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "friction/friction_laws.h"
#include "lsm_friction_loop.h"

namespace {

using namespace LAMMPS_NS;
using LSMFriction::Loop;
using LSMFriction::Scene;
using LSMFriction::Step;

constexpr double stiffness = 1.0, kt = 0.5, mu = 0.3, dt = 0.05;

/// Nothing is left out. Counts the calls.
struct Host : LSMFriction::Host {
  bool is_left_out(int) const override { return false; }
  double drag(const LSMContacts::Pair &, double, double, double) override { return 0.0; }
  void tally(const LSMContacts::Pair &, double energy, double fx, double fy, double delx,
             double dely) override {
    energies += energy;
    virial += fx * delx + fy * dely;
  }
  double energies = 0.0, virial = 0.0;
};

/// Two rows of discs, all pairs between which are kept. The upper row is pushed along the lower
/// one and up and down, so that contacts begin, slide, stick and end.
struct Rows {
  static constexpr int each = 60;
  std::vector<double> x, f, radius;
  LSMContacts contacts;
  LSMTypePairs<double> k, coefficients[LSM::CoulombStatic::state_size + 8];
  LSMEnergySource energies;
  Host host;
  int n = 0;
  double turns = 2.0 * std::acos(-1.0);

  explicit Rows(int state_size) : x(6 * each), f(6 * each) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(0.8, 1.0);
    for (int i = 0; i < 2 * each; ++i) radius.push_back(any(random));
    k.create(2);
    k[1][1] = stiffness;
    energies.record_what = LSMEnergySource::ENERGY | LSMEnergySource::SLIP_RATE;
    contacts.begin(state_size);
    for (int i = 0; i < each; ++i)
      for (int j = each; j < 2 * each; ++j)
        if (std::abs(i - (j - each)) < 6)
          contacts.add({i, j, 0, k.place(1, 1), 0, radius[i] + radius[j],
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
    for (int i = 0; i < each; ++i) {
      x[3 * i] = 1.9 * i;
      x[3 * (each + i)] = 1.9 * i + 3.0 * std::sin(turns * step / 4000.0) + 0.02 * std::sin(i);
      x[3 * (each + i) + 1] = 1.68 + 0.06 * std::sin(turns * step / 370.0 + i);
    }
  }
  template <class Law, class Recorder = LSMRecordEnergies>
  void evaluate(bool one_by_one = false, bool setup = false) {
    std::fill(f.begin(), f.end(), 0.0);
    contacts.find(x.data());
    const Scene scene = {contacts,
                         host,
                         energies,
                         x.data(),
                         f.data(),
                         2 * each,
                         false,
                         Step{setup, 1e-12, dt, true},
                         LSM::friction_contact::NEAR_REACH,
                         k,
                         coefficients,
                         one_by_one,
                         false};
    Loop<Law, Recorder>(scene).run();
  }
};

template <class Law>
Rows rows_of(const std::vector<double> &values) {
  Rows rows(LSM::friction_contact::LAW_STATE + Law::state_size);
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

/// Contacts are computed side by side, or one by one where the scene is screened: to the last bit,
/// forces, states and sums are the same.
template <class Law>
void side_by_side(const std::vector<double> &values) {
  Rows together = rows_of<Law>(values), one_by_one = rows_of<Law>(values);
  for (int n = 0; n < 1500; ++n) {
    for (Rows *rows : {&together, &one_by_one}) {
      rows->move_to(n);
      rows->evaluate<Law>(rows == &one_by_one);
    }
    ASSERT_EQ(together.f, one_by_one.f) << "step " << n;
    ASSERT_EQ(together.energies.work_friction, one_by_one.energies.work_friction) << "step " << n;
  }
  EXPECT_GT(together.energies.work_friction, 0.1);
  for (int p = 0; p < together.contacts.count(); ++p)
    ASSERT_EQ(together.contacts.is_touching(p), one_by_one.contacts.is_touching(p));
}

TEST(FrictionLoop, GivesTheSameDigitsSideBySideAndOneByOne) {
  side_by_side<LSM::Coulomb>({kt, mu, mu});
  side_by_side<LSM::CoulombStatic>({kt, mu, 0.5});
  side_by_side<LSM::VelocityWeakening>({kt, mu, 0.5});
}

// The setup of a run evaluates a step that was done.
TEST(FrictionLoop, ASetupChangesNothing) {
  for (const bool again : {false, true}) {
    Rows rows = rows_of<LSM::CoulombStatic>({kt, mu, 0.5});
    double lost = 0.0;
    std::vector<double> f;
    for (int n = 0; n < 800; ++n) {
      rows.move_to(n);
      rows.evaluate<LSM::CoulombStatic>();
      if (n != 400) continue;
      f = rows.f;
      lost = rows.energies.work_friction;
      if (!again) continue;
      rows.evaluate<LSM::CoulombStatic>(false, true);
      EXPECT_EQ(rows.f, f);
      EXPECT_EQ(rows.energies.work_friction, lost);
    }
    static double first = 0.0;
    if (!again) first = rows.energies.work_friction;
    EXPECT_EQ(rows.energies.work_friction, first);
    EXPECT_GT(first, 1.1 * lost);
  }
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

}  // namespace
