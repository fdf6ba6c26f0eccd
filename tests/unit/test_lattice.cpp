// SPDX-License-Identifier: GPL-2.0-or-later
#include "fault/lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

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
