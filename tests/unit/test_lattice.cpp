// SPDX-License-Identifier: GPL-2.0-or-later
#include "fault/lattice.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fault/cubic_lattice.h"
#include "unit_files.h"

using namespace LSM;

namespace {

LatticeSettings settings(bool ring) {
  LatticeSettings s;
  s.length = 12.0;
  s.width = 12.0;
  s.spacing = 1.5;
  s.ring = ring;
  return s;
}

double distance(const Packing &p, const std::pair<int, int> &link, double period) {
  const Disc &a = p.discs[static_cast<std::size_t>(link.first)];
  const Disc &b = p.discs[static_cast<std::size_t>(link.second)];
  double dx = a.x - b.x;
  if (period > 0.0) dx -= period * std::round(dx / period);
  return std::hypot(dx, a.y - b.y);
}

}  // namespace

TEST(Lattice, LinksAreAllNeighboursOfABlock) {
  for (const bool ring : {true, false}) {
    const Packing p = make_lattice(settings(ring));
    const double period = ring ? 12.0 : 0.0;
    std::size_t touching = 0;
    for (int i = 0; i < static_cast<int>(p.discs.size()); ++i)
      for (int j = i + 1; j < static_cast<int>(p.discs.size()); ++j)
        if (p.discs[static_cast<std::size_t>(i)].block ==
                p.discs[static_cast<std::size_t>(j)].block &&
            distance(p, {i, j}, period) < 1.5 + 1e-9)
          ++touching;
    EXPECT_EQ(p.links.size(), touching) << ring;
    for (const auto &link : p.links) {
      EXPECT_NEAR(distance(p, link, period), 1.5, 1e-12);
      EXPECT_LT(link.first, link.second);
    }
  }
}

TEST(Lattice, FacesAreMirrorImages) {
  const LatticeSettings s = settings(false);
  const Packing p = make_lattice(s);
  const std::size_t n = p.discs.size();
  int facing = 0, borders = 0;
  for (std::size_t i = 0; i < n / 2; ++i)
    for (std::size_t j = n / 2; j < n; ++j)
      if (p.discs[i].x == p.discs[j].x && p.discs[i].y == -p.discs[j].y) {
        EXPECT_EQ(p.discs[i].fault, p.discs[j].fault);
        EXPECT_EQ(p.discs[i].plate, p.discs[j].plate);
        if (p.discs[i].fault) {
          EXPECT_DOUBLE_EQ(p.discs[j].y - p.discs[i].y, 1.5);
          // Each pair is in the middle of a bin whose width is the spacing.
          const double bin = (p.discs[i].x + s.half_length()) / 1.5 - 0.5;
          EXPECT_NEAR(bin, std::round(bin), 1e-12);
        }
        facing += p.discs[i].fault;
      }
  EXPECT_EQ(facing, 8);
  for (const auto &link : p.links) borders += in_border(p, link);
  EXPECT_EQ(borders, 2 * 7 + 2 * (s.rows() % 2 ? 7 : 6));
}

TEST(Lattice, SettingsOutOfRange) {
  for (double LatticeSettings::*one :
       {&LatticeSettings::length, &LatticeSettings::width, &LatticeSettings::spacing})
    for (const double value : {0.0, -1.0, std::nan(""), 1e9}) {
      LatticeSettings s = settings(true);
      s.*one = value;
      EXPECT_THROW(make_lattice(s), std::invalid_argument) << value;
    }
}

namespace {

CubicLattice::Sizes cubic(bool ring) {
  CubicLattice::Sizes s;
  s.length = 9.0;
  s.width = 12.0;
  s.depth = 6.0;
  s.spacing = 1.5;
  s.ring_x = s.ring_z = ring;
  return s;
}

template <class Act>
void for_nodes(const CubicLattice &nodes, const Act &act) {
  CubicLattice::Node n{};
  for (n.y = 0; n.y < nodes.count(1); ++n.y)
    for (n.z = 0; n.z < nodes.count(2); ++n.z)
      for (n.x = 0; n.x < nodes.count(0); ++n.x) act(n);
}

}  // namespace

TEST(CubicLattice, NodesAndTheirNumbers) {
  for (const bool ring : {true, false}) {
    const CubicLattice nodes(cubic(ring));
    EXPECT_EQ(nodes.count(0), ring ? 6 : 7);
    EXPECT_EQ(nodes.count(1), 10);
    EXPECT_EQ(nodes.count(2), ring ? 4 : 5);
    std::int64_t id = 0;
    double mass = 0.0, highest = -1e9;
    int facing = 0;
    for_nodes(nodes, [&](const CubicLattice::Node &n) {
      EXPECT_EQ(nodes.id(n), ++id);
      mass += nodes.share(n);
      const auto x = nodes.place(n);
      highest = std::max(highest, x[2]);
      for (int c = 0; c < 3; ++c) {
        EXPECT_GE(x[static_cast<std::size_t>(c)], nodes.limits(c)[0]);
        EXPECT_LT(x[static_cast<std::size_t>(c)], nodes.limits(c)[1]);
      }
      EXPECT_EQ(nodes.block(n), x[1] > 0.0 ? 1 : 0);
      EXPECT_EQ(nodes.in_fault(n), std::fabs(x[1]) < 1.5);
      facing += nodes.in_fault(n);
    });
    EXPECT_EQ(id, nodes.size());
    EXPECT_EQ(highest, 0.0);
    EXPECT_EQ(facing, 2 * nodes.count(0) * nodes.count(2));
    // one node for each cube of a block
    EXPECT_DOUBLE_EQ(mass, 6.0 * 8.0 * 4.0);
    for (int c : {0, 2})
      EXPECT_DOUBLE_EQ(nodes.limits(c)[1] - nodes.limits(c)[0], (c ? 6.0 : 9.0) + (ring ? 0 : 1.5));
  }
}

// Each cube has shares of its edges and diagonals, so that the energy of a homogeneous strain is
// that of the isotropic continuum with lambda = mu = k / a: for any strain, and also with borders.
TEST(CubicLattice, EnergyOfAHomogeneousStrainIsExact) {
  const double strains[][3][3] = {{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                                  {{0, 1, 0}, {1, 0, 0}, {0, 0, 0}},
                                  {{0.3, -0.2, 0.5}, {-0.2, 0.7, 0.1}, {0.5, 0.1, -0.4}}};
  for (const bool ring : {true, false})
    for (const auto &e : strains) {
      const CubicLattice nodes(cubic(ring));
      const double a = 1.5, share[] = {0.0, 1.0, 0.5, 0.25, 1.0, 0.5};
      double energy = 0.0, backward = 0.0;
      int links = 0, all = 0;
      for_nodes(nodes, [&](const CubicLattice::Node &n) {
        const auto sum = [&](double &to, int &count, bool forward) {
          nodes.for_links(n, forward, [&](const CubicLattice::Node &m, int type) {
            std::array<double, 3> d{};
            for (std::size_t c = 0; c < 3; ++c) {
              d[c] = nodes.place(m)[c] - nodes.place(n)[c];
              const double period = ring && c != 1 ? (c ? 6.0 : 9.0) : 1e9;
              d[c] -= period * std::round(d[c] / period);
            }
            const double r = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            EXPECT_NEAR(r, type < CubicLattice::DIAGONAL ? a : a * std::sqrt(2.0), 1e-12);
            EXPECT_EQ(nodes.block(m), nodes.block(n));
            double stretch = 0.0;
            for (std::size_t c = 0; c < 3; ++c)
              for (std::size_t b = 0; b < 3; ++b) stretch += e[c][b] * d[c] * d[b] / r;
            to += 0.5 * share[type] * stretch * stretch;
            ++count;
          });
        };
        sum(energy, links, true);
        sum(backward, all, false);
      });
      double trace = 0.0, square = 0.0;
      for (int c = 0; c < 3; ++c) {
        trace += e[c][c];
        for (int b = 0; b < 3; ++b) square += e[c][b] * e[c][b];
      }
      const double mu = 1.0 / a, volume = 6.0 * 8.0 * 4.0 * a * a * a;
      EXPECT_NEAR(energy, volume * (0.5 * mu * trace * trace + mu * square), 1e-9 * energy);
      EXPECT_NEAR(backward, 2.0 * energy, 1e-9 * energy);
      EXPECT_EQ(all, 2 * links);
    }
}

TEST(CubicLattice, WrongSizesAreNamed) {
  const auto refused = [](auto change, const std::string &what) {
    CubicLattice::Sizes s = cubic(false);
    change(s);
    unit::expect_error<std::invalid_argument>([&s] { CubicLattice nodes(s); }, what);
  };
  refused([](auto &s) { s.length = 10.0; },
          "length = 10.000000, expected a multiple of the spacing");
  refused([](auto &s) { s.width = 4.5; }, "half width = 2.250000, expected 3 to 1e6 times");
  refused([](auto &s) { s.depth = NAN; }, "depth = nan");
  refused([](auto &s) { s.spacing = 0.0; }, "spacing = 0");
  refused([](auto &s) { s.length = s.width = s.depth = 1.5e5; }, "too many particles");
}
