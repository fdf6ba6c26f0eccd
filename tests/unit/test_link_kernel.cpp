// SPDX-License-Identifier: GPL-2.0-or-later
// Links in rows: each link occurs once, forces and energy are those of a plain loop, and all digits
// are the same whatever the order in memory and the instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "lsm_link_kernel.h"
#include "numerics/random.h"

namespace {

using namespace LAMMPS_NS;
using LSMLinkKernel::Breakable;
using LSMLinkKernel::Elastic;
using LSMLinkRows::Link;
using LSMLinkRows::Rows;

/// Particles on a disturbed grid with links between neighbours, up to nine for one particle.
/// Particles from nlocal on are ghosts.
struct Network {
  int nlocal, nall;
  std::vector<double> x;  // three per particle
  std::vector<Link> links;
  std::vector<int> owned;
};

Network make_network(int side, int dim, uint64_t seed) {
  LSM::Random random(seed);
  Network net;
  net.nlocal = side * side;
  net.nall = net.nlocal + side;
  for (int n = 0; n < net.nall; ++n) {
    const double z = dim == 3 ? random.uniform(-0.4, 0.4) : 0.0;
    net.x.insert(net.x.end(),
                 {n % side + random.uniform(-0.2, 0.2), n / side + random.uniform(-0.2, 0.2), z});
  }
  const int steps[][2] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 1}};
  for (int n = 0; n < net.nlocal; ++n)
    for (const auto &step : steps) {
      const int column = n % side + step[0], other = n + step[0] + side * step[1];
      if (column < 0 || column >= side || other >= net.nall || random.uniform() < 0.4) continue;
      net.links.push_back({n, other, random.uniform(0.7, 1.6)});
    }
  net.owned.resize(net.nlocal);
  std::iota(net.owned.begin(), net.owned.end(), 0);
  return net;
}

/// Keeps only the links that lead to ghosts, whose forces are not needed.
Network links_to_ghosts(Network net) {
  const auto is_owned = [&](const Link &link) { return link.j < net.nlocal; };
  net.links.erase(std::remove_if(net.links.begin(), net.links.end(), is_owned), net.links.end());
  return net;
}

/// A disturbed cubic lattice of 30 x 6 x 9 nodes, linked along edges and diagonals. The last plane
/// are ghosts.
/// \param missing share of the links that are not there
Network make_lattice(double missing) {
  const int size[] = {30, 6, 9};
  LSM::Random random(43);
  Network net;
  net.nlocal = size[0] * size[1] * (size[2] - 1);
  net.nall = net.nlocal + size[0] * size[1];
  const int steps[][3] = {{1, 0, 0},  {0, 1, 0},  {-1, 1, 0}, {1, 1, 0}, {0, 0, 1},
                          {0, -1, 1}, {-1, 0, 1}, {1, 0, 1},  {0, 1, 1}};
  for (int n = 0; n < net.nall; ++n) {
    const int at[] = {n % size[0], n / size[0] % size[1], n / (size[0] * size[1])};
    for (int c : at) net.x.push_back(c + random.uniform(-0.2, 0.2));
    for (const auto &step : steps) {
      int to[3], squares = 0;
      bool inside = n < net.nlocal && random.uniform() >= missing;
      for (int c = 0; c < 3; ++c) {
        to[c] = at[c] + step[c];
        squares += step[c] * step[c];
        inside = inside && to[c] >= 0 && to[c] < size[c];
      }
      if (inside)
        net.links.push_back(
            {n, to[0] + size[0] * (to[1] + size[1] * to[2]), std::sqrt(1.0 * squares)});
    }
  }
  net.owned.resize(net.nlocal);
  std::iota(net.owned.begin(), net.owned.end(), 0);
  return net;
}

/// Where particles are that change their places in memory.
std::vector<int> places(const Network &net) {
  std::vector<int> place(net.nall);
  std::iota(place.begin(), place.end(), 0);
  LSM::Random random(31);
  for (int n = net.nlocal - 1; n > 0; --n)
    std::swap(place[n], place[static_cast<int>(random.uniform() * (n + 1))]);
  return place;
}

/// The same with particles at other places. Links and owned particles stay in the order of IDs.
Network moved_to(const std::vector<int> &place, Network net) {
  const Network before = net;
  for (int n = 0; n < net.nall; ++n) std::copy_n(&before.x[3 * n], 3, &net.x[3 * place[n]]);
  for (Link &link : net.links) link = {place[link.i], place[link.j], link.rest};
  for (int &i : net.owned) i = place[i];
  return net;
}

Rows rows_of(const Network &net, bool mixed = false, bool share = false, int stride = 3,
             bool regular = false) {
  return make_rows(net.owned, net.links, net.nlocal, net.nall, mixed, share, stride, regular);
}

LSMLinkKernel::Windows all_of(const Rows &rows) {
  return {0, static_cast<int>(rows.windows.size()) - 1};
}

struct Evaluation {
  double energy;
  std::vector<double> f;
  std::vector<LSMLinkRows::Found> broken;
  double virial;       // change of the energy if each length is rounded once, over epsilon
  double power = 0.0;  // of dashpots
};

template <int DIM, class Law>
Evaluation evaluate(const Network &net, const Rows &rows, const Law &law, bool first_only = false,
                    bool avx2 = LSMLinkKernel::has_avx2()) {
  Evaluation e{0.0, std::vector<double>(net.x.size(), 0.0), {}, 0.0};
  e.energy = LSMLinkKernel::forces<DIM>(rows, all_of(rows), law, first_only, net.x.data(),
                                        e.f.data(), e.broken, avx2);
  return e;
}

/// The same by a plain loop over the links in long double.
/// \param ratio breaking distance over rest length; 0: links do not break
Evaluation plain(const Network &net, double k, double ratio, bool first_only = false,
                 double viscosity = 0.0, const std::vector<double> &v = {}) {
  std::vector<long double> f(net.x.size(), 0.0L);
  long double energy = 0.0L, virial = 0.0L, power = 0.0L;
  for (const Link &link : net.links) {
    long double d[3], rsq = 0.0L, rate = 0.0L;
    for (int c = 0; c < 3; ++c) {
      d[c] = static_cast<long double>(net.x[3 * link.i + c]) - net.x[3 * link.j + c];
      rsq += d[c] * d[c];
      if (!v.empty()) rate += d[c] * (v[3 * link.i + c] - v[3 * link.j + c]);
    }
    const long double r = std::sqrt(rsq), stretch = r - link.rest;
    if (ratio > 0.0 && r > ratio * link.rest) continue;
    rate /= r;
    virial += k * std::fabs(stretch) * r;
    energy += (first_only ? 0.25L : 0.5L) * k * stretch * stretch;
    power += (first_only ? 0.5L : 1.0L) * viscosity * rate * rate;
    for (int c = 0; c < 3; ++c) {
      f[3 * link.i + c] -= (k * stretch + viscosity * rate) / r * d[c];
      if (!first_only) f[3 * link.j + c] += (k * stretch + viscosity * rate) / r * d[c];
    }
  }
  return {static_cast<double>(energy),
          {f.begin(), f.end()},
          {},
          static_cast<double>(virial),
          static_cast<double>(power)};
}

void expect_near(const Evaluation &got, const Evaluation &expected) {
  EXPECT_NEAR(got.energy, expected.energy, 2e-16 * expected.virial);
  double worst = 0.0;
  ASSERT_EQ(got.f.size(), expected.f.size());
  for (std::size_t n = 0; n < got.f.size(); ++n)
    worst = std::max(worst, std::fabs(got.f[n] - expected.f[n]));
  EXPECT_LT(worst, 1e-14);
}

std::multiset<std::pair<int, int>> pairs_of(const Rows &rows) {
  std::multiset<std::pair<int, int>> all;
  for (const auto &stack : rows.stacks)
    for (int n = 0; n < stack.slices * stack.length * LSMLinkRows::LANES; ++n) {
      const auto link = rows.link(stack, n);
      if (rows.rest[link.rest] != LSMLinkRows::NO_LINK) all.insert(std::minmax(link.i, link.j));
    }
  return all;
}

TEST(LinkRows, HoldEachLinkOnce) {
  for (int side : {1, 2, 3, 5, 40}) {
    const Network net = make_network(side, 2, 7);
    std::multiset<std::pair<int, int>> expected;
    for (const Link &link : net.links) expected.insert(std::minmax(link.i, link.j));
    for (bool mixed : {false, true}) EXPECT_EQ(pairs_of(rows_of(net, mixed)), expected) << side;
  }
}

TEST(LinkRows, KeepOneRestLengthOnce) {
  const auto each = make_network(40, 3, 7);
  Network same = each;
  for (Link &link : same.links) link.rest = 1.25;
  for (const Network &net : {each, same}) {
    const Rows rows = rows_of(net, false, true), plain = rows_of(net);
    EXPECT_EQ(pairs_of(rows), pairs_of(plain));
    const Evaluation a = evaluate<3>(net, rows, Elastic{0.7}),
                     b = evaluate<3>(net, plain, Elastic{0.7});
    EXPECT_EQ(a.energy, b.energy);
    EXPECT_EQ(a.f, b.f);
    const bool once = rows.rest.size() < 0.2 * plain.rest.size();
    EXPECT_EQ(once, net.links[0].rest == net.links[1].rest);
  }
}

TEST(LinkRows, AreOfOwnedParticles) {
  const Network net = make_network(40, 2, 3);
  const auto to_ghost = [&](const Link &link) { return link.j >= net.nlocal; };
  ASSERT_GT(std::count_if(net.links.begin(), net.links.end(), to_ghost), 20);
  for (const int place : rows_of(net).particle) ASSERT_LT(place, 3 * net.nlocal);
}

TEST(LinkRows, FillFewPlacesUp) {
  const Network net = make_network(100, 2, 11);
  const Rows rows = rows_of(net);
  EXPECT_LT(rows.other.size(), 1.05 * net.links.size());
  EXPECT_LT(rows.particle.size(), 1.1 * net.nlocal);
}

TEST(LinkRows, FetchEachPlaceOfALaterWindow) {
  const Network net = make_network(100, 2, 5);
  const Rows rows = rows_of(net);
  int at = 0;
  for (const auto &stack : rows.stacks) {
    EXPECT_GE(stack.fetch_end, stack.fetch);
    if (stack.fetch_end > stack.fetch) {
      EXPECT_EQ(stack.fetch, at);
      at = stack.fetch_end;
    }
  }
  EXPECT_GT(at, 2 * net.nlocal / 8);  // three doubles each, eight in a cache line
  EXPECT_EQ(at, static_cast<int>(rows.to_fetch.size()));
}

TEST(LinkKernel, BrokenLinksAreNamedOnce) {
  const Network net = make_network(40, 2, 19);
  std::multiset<std::pair<int, int>> expected, got;
  for (const Link &link : net.links) {
    const double r = std::hypot(net.x[3 * link.i] - net.x[3 * link.j],
                                net.x[3 * link.i + 1] - net.x[3 * link.j + 1]);
    if (r > 1.2 * link.rest) expected.insert(std::minmax(link.i, link.j));
  }
  ASSERT_GT(expected.size(), 100u);
  for (bool mixed : {false, true}) {
    const Rows rows = rows_of(net, mixed);
    got.clear();
    for (const auto &link : evaluate<2>(net, rows, Breakable{{1.0}, 1.2}, mixed).broken) {
      EXPECT_GT(std::hypot(net.x[3 * link.i] - net.x[3 * link.j],
                           net.x[3 * link.i + 1] - net.x[3 * link.j + 1]),
                1.2 * rows.rest[link.rest]);
      got.insert(std::minmax(link.i, link.j));
    }
    EXPECT_EQ(got, expected);
  }
}

TEST(LinkKernel, LinksThatMayBreakPullLikeOthers) {
  const Network net = make_network(40, 2, 23);
  const Rows rows = rows_of(net);
  const Evaluation far = evaluate<2>(net, rows, Breakable{{1.0}, 100.0});
  const Evaluation never = evaluate<2>(net, rows, Elastic{1.0});
  EXPECT_TRUE(far.broken.empty());
  EXPECT_EQ(far.energy, never.energy);
  EXPECT_EQ(far.f, never.f);
}

TEST(LinkKernel, SameDigitsInAnyOrderInMemory) {
  const Network net = make_network(50, 2, 29);
  const std::vector<int> place = places(net);
  const Network other = moved_to(place, net);
  const Evaluation a = evaluate<2>(net, rows_of(net), Elastic{1.0});
  const Evaluation b = evaluate<2>(other, rows_of(other), Elastic{1.0});
  EXPECT_EQ(a.energy, b.energy);
  for (int n = 0; n < net.nall; ++n)
    for (int c = 0; c < 2; ++c) ASSERT_EQ(a.f[3 * n + c], b.f[3 * place[n] + c]) << n;
}

using LSMLinkKernel::KelvinVoigt;

std::vector<double> velocities_of(const Network &net) {
  LSM::Random random(41);
  std::vector<double> v(net.x.size());
  for (double &one : v) one = random.uniform(-0.5, 0.5);
  return v;
}

template <int DIM>
std::vector<double> motion_of(const Network &net, const std::vector<double> &v) {
  using Motion = LSMLinkKernel::Motion<DIM>;
  std::vector<double> all(net.x.size() / 3 * Motion::SIZE, 0.0);
  for (std::size_t i = 0; i < net.x.size() / 3; ++i) {
    std::copy_n(&v[3 * i], DIM, &all[Motion::SIZE * i]);
    if (Motion::HAS_POSITION)
      std::copy_n(&net.x[3 * i], DIM, &all[Motion::SIZE * i + Motion::POSITION]);
  }
  return all;
}

template <int DIM, class Spring>
Evaluation with_dashpots(const Network &net, const Spring &spring, double viscosity,
                         const std::vector<double> &v, bool first_only, double &lost,
                         bool avx2 = LSMLinkKernel::has_avx2(), bool regular = false) {
  const std::vector<double> motion = motion_of<DIM>(net, v);
  const Rows rows = rows_of(net, first_only, false, LSMLinkKernel::Motion<DIM>::SIZE, regular);
  return evaluate<DIM>(net, rows, KelvinVoigt<Spring>{spring, viscosity, &lost, motion.data()},
                       first_only, avx2);
}

template <int DIM, class Spring>
void forces_agree(const Network &net, const Spring &spring, double ratio, bool first_only) {
  const Rows rows = rows_of(net, first_only);
  const Evaluation elastic = evaluate<DIM>(net, rows, spring, first_only);
  expect_near(elastic, plain(net, 0.7, ratio, first_only));

  const std::vector<double> v = velocities_of(net);
  double lost = 1.0;
  const Evaluation got = with_dashpots<DIM>(net, spring, 0.3, v, first_only, lost),
                   expected = plain(net, 0.7, ratio, first_only, 0.3, v);
  expect_near(got, expected);
  EXPECT_NEAR(lost, 1.0 + expected.power, 1e-12 * expected.power);
  if (net.links.size() > 1000) {
    EXPECT_GT(expected.power, 10.0);
  }

  // Without velocities the dashpots change nothing, to the last bit.
  const std::vector<double> rest(net.x.size(), 0.0);
  double none = 0.0;
  const Evaluation still = with_dashpots<DIM>(net, spring, 0.3, rest, first_only, none);
  EXPECT_EQ(still.energy, elastic.energy);
  EXPECT_EQ(still.f, elastic.f);
  EXPECT_EQ(none, 0.0);

  // All instruction sets give the same digits.
  if (!LSMLinkKernel::has_avx2()) return;
  const Evaluation narrow = evaluate<DIM>(net, rows, spring, first_only, false);
  EXPECT_EQ(narrow.energy, elastic.energy);
  EXPECT_EQ(narrow.f, elastic.f);
  EXPECT_EQ(narrow.broken.size(), elastic.broken.size());
  double lost_narrow = 1.0;
  EXPECT_EQ(with_dashpots<DIM>(net, spring, 0.3, v, first_only, lost_narrow, false).f, got.f);
  EXPECT_EQ(lost_narrow, lost);
}

template <int DIM>
void forces_agree() {
  for (int side : {1, 2, 3, 6, 40, 70}) {
    SCOPED_TRACE(side);
    const Network net = make_network(side, DIM, 17), out = links_to_ghosts(net);
    forces_agree<DIM>(net, Elastic{0.7}, 0.0, false);
    forces_agree<DIM>(net, Breakable{{0.7}, 1.2}, 1.2, false);
    forces_agree<DIM>(out, Elastic{0.7}, 0.0, true);
    forces_agree<DIM>(out, Breakable{{0.7}, 1.2}, 1.2, true);
  }
}

TEST(LinkKernel, DashpotsAndSpringsOfAPlainLoopInTwoDimensions) { forces_agree<2>(); }
TEST(LinkKernel, DashpotsAndSpringsOfAPlainLoopInThreeDimensions) { forces_agree<3>(); }

TEST(LinkRows, OfALatticeAreRegular) {
  for (const double missing : {0.0, 0.01}) {
    const Network net = make_lattice(missing);
    const Network moved = moved_to(places(net), net);
    const auto regular = [](const Rows &rows) {
      int links = 0;
      for (const auto &stack : rows.stacks)
        if (stack.regular) links += stack.slices * stack.length * LSMLinkRows::LANES;
      return links;
    };
    const Rows rows = rows_of(net, false, true, 3, true);
    const double share = 1.0 * regular(rows) / static_cast<double>(net.links.size());
    EXPECT_GT(share, missing > 0.0 ? 0.4 : 0.6);  // the rest are borders, and links to ghosts
    EXPECT_LT(static_cast<double>(rows.other.size()),
              (1.1 - 0.7 * share) * static_cast<double>(net.links.size()));
    EXPECT_EQ(pairs_of(rows), pairs_of(rows_of(net)));
    const Rows single = rows_of(moved, false, true, 3, true);
    EXPECT_EQ(regular(single), 0);
    EXPECT_EQ(pairs_of(single), pairs_of(rows_of(moved)));
  }
}

TEST(LinkKernel, RegularSlicesGiveTheDigitsOfSingleLinks) {
  for (const double missing : {0.0, 0.01})
    for (const bool avx2 : {false, LSMLinkKernel::has_avx2()}) {
      const Network net = make_lattice(missing);
      const std::vector<int> place = places(net);
      const Network moved = moved_to(place, net);
      const auto expect_same = [&](const Evaluation &a, const Evaluation &b) {
        EXPECT_EQ(a.energy, b.energy);
        for (int n = 0; n < net.nall; ++n)
          for (int c = 0; c < 3; ++c) ASSERT_EQ(a.f[3 * n + c], b.f[3 * place[n] + c]) << n;
        ASSERT_EQ(a.broken.size(), b.broken.size());
        for (std::size_t n = 0; n < a.broken.size(); ++n) {
          EXPECT_EQ(place[a.broken[n].i], b.broken[n].i);
          EXPECT_EQ(place[a.broken[n].j], b.broken[n].j);
        }
      };
      const Rows rows = rows_of(net, false, true, 3, true),
                 each = rows_of(net, false, false, 3, true);
      const Evaluation springs = evaluate<3>(net, rows, Elastic{0.7}, false, avx2);
      const Evaluation broken = evaluate<3>(net, each, Breakable{{0.7}, 1.2}, false, avx2);
      expect_near(springs, plain(net, 0.7, 0.0));
      expect_near(broken, plain(net, 0.7, 1.2));
      EXPECT_GT(broken.broken.size(), 100u);
      expect_same(springs, evaluate<3>(moved, rows_of(moved, false, true, 3, true), Elastic{0.7},
                                       false, avx2));
      expect_same(broken, evaluate<3>(moved, rows_of(moved, false, false, 3, true),
                                      Breakable{{0.7}, 1.2}, false, avx2));

      const std::vector<double> v = velocities_of(net);
      std::vector<double> v_moved(v.size());
      for (int n = 0; n < net.nall; ++n) std::copy_n(&v[3 * n], 3, &v_moved[3 * place[n]]);
      double lost[2] = {0.0, 0.0};
      const auto dashpots = [&](const Network &of, const std::vector<double> &velocities,
                                double &power) {
        return with_dashpots<3>(of, Elastic{0.7}, 0.3, velocities, false, power, avx2, true);
      };
      expect_same(dashpots(net, v, lost[0]), dashpots(moved, v_moved, lost[1]));
      EXPECT_EQ(lost[0], lost[1]);
      EXPECT_GT(lost[0], 10.0);
    }
}

TEST(LinkKernel, WindowsOneByOneGiveTheSameForces) {
  const Network net = make_lattice(0.0);
  const Rows rows = rows_of(net, false, true, 3, true);
  ASSERT_GT(all_of(rows).last, 1);
  Evaluation e{0.0, std::vector<double>(net.x.size(), 0.0), {}, 0.0};
  for (int n = 0; n < all_of(rows).last; ++n)
    e.energy += LSMLinkKernel::forces<3>(rows, {n, n + 1}, Elastic{0.7}, false, net.x.data(),
                                         e.f.data(), e.broken, LSMLinkKernel::has_avx2());
  const Evaluation whole = evaluate<3>(net, rows, Elastic{0.7});
  EXPECT_EQ(e.f, whole.f);
  EXPECT_NEAR(e.energy, whole.energy, 1e-14 * whole.energy);
}

}  // namespace
