// SPDX-License-Identifier: GPL-2.0-or-later
// The geometry is checked by plain loops over pairs, not with the search of the packing itself.

#include "fault/packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "eigenvalues.h"
#include "unit_files.h"

namespace {

LSM::PackingSettings settings(double length, std::uint64_t seed = 1) {
  LSM::PackingSettings s;
  s.length = length;
  s.seed = seed;
  return s;
}

// Distance between the surfaces of two discs, the shortest over the periodic images in x.
double gap(const LSM::Disc &a, const LSM::Disc &b, double length) {
  double dx = std::fabs(a.x - b.x);
  dx = std::min(dx, length - dx);
  return std::hypot(dx, a.y - b.y) - a.r - b.r;
}

/// Discs lie inside their blocks and do not overlap, and all pairs of a block that are close are
/// linked.
void expect_valid(const LSM::Packing &p, const LSM::PackingSettings &s) {
  std::vector<std::pair<int, int>> links;
  for (int i = 0; i < static_cast<int>(p.discs.size()); ++i) {
    const LSM::Disc &a = p.disc(i);
    EXPECT_GE(a.x, 0.0);
    EXPECT_LT(a.x, s.length);
    EXPECT_GE(a.r, s.rmin);
    EXPECT_LE(a.r, s.rmax);
    ASSERT_TRUE(a.block == 0 || a.block == 1);
    const double low = a.block == 0 ? 0.0 : 0.5 * s.width;
    EXPECT_GE(a.y - a.r, low - 1e-8 * a.r);
    EXPECT_LE(a.y + a.r, low + 0.5 * s.width + 1e-8 * a.r);
    for (int j = i + 1; j < static_cast<int>(p.discs.size()); ++j) {
      const double radii = a.r + p.disc(j).r, between = gap(a, p.disc(j), s.length);
      ASSERT_GE(between, -1e-8 * radii) << "discs " << i << " and " << j;
      if (a.block == p.disc(j).block && between < std::max(1e-5, (s.link_ratio - 1.0) * radii))
        links.emplace_back(i, j);
    }
  }
  EXPECT_EQ(p.links, links);
}

class PackingOf40 : public testing::Test {
 protected:
  static void SetUpTestSuite() { packing_ = new LSM::Packing(LSM::make_packing(settings(length))); }
  static void TearDownTestSuite() {
    delete packing_;
    packing_ = nullptr;
  }
  static const LSM::Packing &packing() { return *packing_; }
  static const LSM::Disc &disc(int i) { return packing_->discs.at(static_cast<std::size_t>(i)); }
  static int count() { return static_cast<int>(packing_->discs.size()); }

  static constexpr double length = 40.0;
  static constexpr double width = 30.0;
  static LSM::Packing *packing_;
};
LSM::Packing *PackingOf40::packing_ = nullptr;

TEST_F(PackingOf40, FitsAndIsLinked) {
  expect_valid(packing(), settings(length));
  double smallest = 1e9, largest = 0.0;
  for (const auto &d : packing().discs) {
    smallest = std::min(smallest, d.r);
    largest = std::max(largest, d.r);
  }
  // The radii cover the range up to both ends.
  EXPECT_LT(smallest, 0.11);
  EXPECT_GT(largest, 0.95);
  EXPECT_EQ(smallest, packing().rmin_found);
  // Each disc placed by the filling stage touches three objects. Pairs that come closer than the
  // link gap by chance are rare; all others are tangent to rounding.
  int exact = 0;
  for (const auto &l : packing().links)
    if (std::fabs(gap(disc(l.first), disc(l.second), length)) < 1e-12) ++exact;
  EXPECT_GE(exact, static_cast<int>(packing().links.size()) - 2);
}

TEST_F(PackingOf40, SeamIsLikeTheInside) {
  // Compares the number of links across x = 0 with the mean over lines x = const inside.
  const auto crossing = [&](double at) {
    int n = 0;
    for (const auto &l : packing().links) {
      double a = disc(l.first).x - at, b = disc(l.second).x - at;
      a -= length * std::floor(a / length + 0.5);
      b -= length * std::floor(b / length + 0.5);
      if (a * b < 0.0 && std::fabs(a - b) < 0.5 * length) ++n;
    }
    return n;
  };
  double inside = 0.0;
  for (int i = 1; i < 40; ++i) inside += crossing(i) / 39.0;
  const int seam = crossing(0.0);
  EXPECT_GT(inside, 20.0);
  EXPECT_GT(seam, 0.6 * inside);
  EXPECT_LT(seam, 1.4 * inside);
}

TEST_F(PackingOf40, FlagsFollowTheGeometry) {
  int tangent[2] = {0, 0}, fault = 0, plate = 0;
  for (const auto &d : packing().discs) {
    const double to_fault = std::fabs(d.y - 15.0) - d.r;
    const double to_plate = std::min(d.y, width - d.y) - d.r;
    EXPECT_EQ(d.fault, to_fault < 0.25);
    EXPECT_EQ(d.plate, to_plate < 1e-5);
    EXPECT_FALSE(d.fault && d.plate);
    if (to_fault < 1e-5) ++tangent[d.block];
    fault += d.fault;
    plate += d.plate;
  }
  EXPECT_EQ(tangent[0], packing().fault_tangent[0]);
  EXPECT_EQ(tangent[1], packing().fault_tangent[1]);
  EXPECT_GT(tangent[0], 12);
  EXPECT_GT(tangent[1], 12);
  EXPECT_GT(fault, tangent[0] + tangent[1]);
  EXPECT_GT(plate, 80);
}

TEST_F(PackingOf40, FiguresAreThoseOfThePaper) {
  EXPECT_GT(packing().coordination, 4.95);
  EXPECT_LT(packing().coordination, 5.2);
  EXPECT_GT(packing().area_fraction, 0.89);
  EXPECT_LT(packing().area_fraction, 0.91);
  // about 7800 particles for length 120
  EXPECT_NEAR(count() / length, 65.0, 2.0);
  double area = 0.0;
  for (const auto &d : packing().discs) area += std::acos(-1.0) * d.r * d.r;
  EXPECT_NEAR(packing().area_fraction, area / (length * width), 1e-12);
  EXPECT_NEAR(packing().coordination, 2.0 * static_cast<double>(packing().links.size()) / count(),
              1e-12);
}

// Loose discs, found in another, slower way: remove any disc with fewer than three links until
// there is none.
TEST_F(PackingOf40, LooseDiscsAreExactlyThoseTakenOut) {
  LSM::PackingSettings s = settings(length);
  s.remove_loose = false;
  const LSM::Packing all = LSM::make_packing(s);
  std::vector<bool> there(all.discs.size(), true);
  int loose = 0, loose_tangent = 0, gone = 0, gone_tangent = 0;
  for (bool first = true, again = true; again; first = false) {
    std::vector<int> links(all.discs.size(), 0);
    for (const auto &[i, j] : all.links)
      if (there.at(static_cast<std::size_t>(i)) && there.at(static_cast<std::size_t>(j)))
        for (const int end : {i, j}) ++links[static_cast<std::size_t>(end)];
    again = false;
    for (std::size_t i = 0; i < all.discs.size(); ++i) {
      const LSM::Disc &d = all.discs[i];
      if (!there[i] || d.plate || links[i] >= 3) continue;
      there[i] = false;
      again = true;
      const bool tangent = std::fabs(d.y - 15.0) - d.r < 1e-5;
      ++gone;
      gone_tangent += tangent;
      if (!first) continue;
      ++loose;
      loose_tangent += tangent;
    }
  }
  EXPECT_EQ(all.loose, loose);
  EXPECT_EQ(all.loose_tangent, loose_tangent);
  EXPECT_GT(loose_tangent,
            30);  // most lie at the fault, where they were fitted to two discs and its line
  EXPECT_EQ(packing().loose, gone);
  EXPECT_EQ(packing().loose_tangent, gone_tangent);
  EXPECT_GT(gone, loose);  // some are held only by loose discs
  std::size_t at = 0;
  for (std::size_t i = 0; i < all.discs.size(); ++i) {
    if (!there[i]) continue;
    ASSERT_LT(at, packing().discs.size());
    EXPECT_EQ(packing().discs[at].x, all.discs[i].x);
    EXPECT_EQ(packing().discs[at].y, all.discs[i].y);
    ++at;
  }
  EXPECT_EQ(at, packing().discs.size());
}

TEST_F(PackingOf40, EachDiscIsHeldInEveryDirection) {
  // Work of the links of a disc when it alone moves by a unit length: the minimum over all
  // directions.
  std::vector<std::vector<std::pair<double, double>>> normals(packing().discs.size());
  for (const auto &l : packing().links) {
    double dx = disc(l.second).x - disc(l.first).x;
    dx -= length * std::floor(dx / length + 0.5);
    const double dy = disc(l.second).y - disc(l.first).y, d = std::hypot(dx, dy);
    for (const int i : {l.first, l.second})
      normals.at(static_cast<std::size_t>(i)).emplace_back(dx / d, dy / d);
  }
  double softest = 1e9;
  for (int i = 0; i < count(); ++i) {
    if (disc(i).plate) continue;
    ASSERT_GE(normals[static_cast<std::size_t>(i)].size(), 3u) << "disc " << i;
    for (int k = 0; k < 1800; ++k) {
      const double angle = k * std::acos(-1.0) / 1800.0, c = std::cos(angle), s = std::sin(angle);
      double sum = 0.0;
      for (const auto &n : normals[static_cast<std::size_t>(i)])
        sum += std::pow(n.first * c + n.second * s, 2);
      softest = std::min(softest, sum);
    }
  }
  EXPECT_GT(softest, 0.25);
  EXPECT_NEAR(packing().weakest, softest, 1e-5);
}

TEST(Packing, PiecesThatHangOnNothingAreTakenOut) {
  // So few discs are fitted that many seeds touch no other disc.
  LSM::PackingSettings s = settings(20.0);
  s.max_failures = 40;
  const LSM::Packing p = LSM::make_packing(s);
  s.remove_loose = false;
  const LSM::Packing all = LSM::make_packing(s);
  EXPECT_NEAR(all.weakest, 0.0, 1e-12);
  EXPECT_EQ(p.discs.size() + static_cast<std::size_t>(p.loose), all.discs.size());
  EXPECT_GT(p.loose, 10);
}

TEST(Packing, DiscsAreSortedBySectionAndKind) {
  const LSM::Packing p = LSM::make_packing(settings(150.0));
  const auto before = [](const LSM::Disc &a, const LSM::Disc &b) {
    const auto place = [](const LSM::Disc &d) {
      return std::make_tuple(std::floor(d.x / 64.0), d.fault ? 0 : d.plate ? 2 : 1, d.x);
    };
    return place(a) < place(b);
  };
  EXPECT_TRUE(std::is_sorted(p.discs.begin(), p.discs.end(), before));
}

LSM::PackingSettings without_faces(double length, bool random_seeds) {
  LSM::PackingSettings s = settings(length);
  s.random_faces = false;
  s.random_seeds = random_seeds;
  s.remove_loose = false;
  return s;
}

// 41 is not a multiple of the spacing of the grid, so that seeds of a row meet at its ends.
TEST(Packing, WithoutFacesDiscsAreFittedToTheFaultLine) {
  for (const double length : {40.0, 41.0})
    for (const bool random_seeds : {true, false}) {
      const LSM::Packing p = LSM::make_packing(without_faces(length, random_seeds));
      expect_valid(p, without_faces(length, random_seeds));
      EXPECT_GT(p.fault_tangent[0], 1.4 * length);
      EXPECT_GT(p.fault_tangent[1], 1.4 * length);
      EXPECT_NEAR(static_cast<double>(p.discs.size()) / length, 65.3, 1.5);
    }
}

TEST(Packing, SeedsStandOnAGridInAbsoluteCoordinates) {
  // Counts the discs of each row of the grid. The fault line, at 8.66 rows, leaves out some of
  // those of row 9, and the border some of row 17, which is at 17.32.
  const auto in_rows = [](const LSM::PackingSettings &s) {
    std::vector<int> rows(18, 0);
    for (const LSM::Disc &d : LSM::make_packing(s).discs) {
      const double j = std::round(d.y / std::sqrt(3.0)), i = 0.5 * d.x - 0.5 * std::fmod(j, 2.0);
      if (std::fabs(d.y - std::sqrt(3.0) * j) < 1e-12 && std::fabs(i - std::round(i)) < 1e-12)
        ++rows.at(static_cast<std::size_t>(j));
    }
    return rows;
  };
  const std::vector<int> grid = in_rows(without_faces(40.0, false));
  for (std::size_t j = 0; j < grid.size(); ++j)
    if (j == 0)
      EXPECT_EQ(grid[j], 0);  // its discs would cross the border
    else if (j == 9 || j == 17)
      EXPECT_TRUE(grid[j] > 0 && grid[j] < 20) << j;
    else
      EXPECT_EQ(grid[j], 20) << j;
  EXPECT_EQ(in_rows(without_faces(40.0, true)), std::vector<int>(18, 0));
  // Discs at the faces come first, so that a seed beside them may not fit.
  LSM::PackingSettings faces = without_faces(40.0, false);
  faces.random_faces = true;
  const std::vector<int> beside = in_rows(faces);
  EXPECT_EQ(beside[5], 20);
  EXPECT_EQ(beside[13], 20);
  EXPECT_LT(beside[8], 20);
}

TEST(Packing, CloseDiscsAreLinkedToo) {
  // At the smallest length and the largest ratio a disc sees the same cells from both sides.
  for (const auto &[length, ratio] : {std::pair(20.0, 1.05), std::pair(8.0, 1.25)}) {
    LSM::PackingSettings s = settings(length);
    s.remove_loose = false;
    const LSM::Packing tangent = LSM::make_packing(s);
    s.link_ratio = ratio;
    const LSM::Packing p = LSM::make_packing(s);
    expect_valid(p, s);
    EXPECT_EQ(p.discs.size(), tangent.discs.size());
    EXPECT_GT(p.links.size(), tangent.links.size() + 10);
  }
}

// If the faces are periodic, distant parts of a long fault slip in step. The structure factor of
// discs at random places without overlap is a smooth function of the wavelength, around which
// values are distributed exponentially; a period appears as a line. That of a grid of seeds
// (spacing 1 and 2) was 16 times its surroundings at length 480. A mean over n packings exceeds r
// times its expectation with probability exp(-n (r - 1 - ln r)) at most; the bounds are for 1e-9.
std::vector<double> face_places(const LSM::Packing &packing, int block) {
  std::vector<double> places;
  for (const LSM::Disc &d : packing.discs) {
    const double gap = block == 0 ? 15.0 - d.y - d.r : d.y - d.r - 15.0;
    if (gap < 1e-5 && d.block == block) places.push_back(d.x);
  }
  return places;
}

/// Largest ratio of a value to the mean of those around it.
double highest_line(const std::vector<double> &values, const std::vector<double> &means) {
  const std::size_t around = 20;
  double highest = 0.0;
  for (std::size_t k = around; k + around < values.size(); ++k) {
    const double *const at = means.data() + k;
    const double sum = std::accumulate(at - around, at + around + 1, -*at);
    highest = std::max(highest, values[k] * 2.0 * around / sum);
  }
  return highest;
}

void expect_no_period(double length, int packings, double highest) {
  std::vector<std::vector<double>> faces[3];  // lower, upper, both
  for (int seed = 1; seed <= packings; ++seed) {
    const LSM::Packing p = LSM::make_packing(settings(length, static_cast<std::uint64_t>(seed)));
    std::vector<double> lower = face_places(p, 0), upper = face_places(p, 1);
    EXPECT_GT(static_cast<double>(lower.size()), 0.3 * length);
    faces[0].push_back(lower);
    faces[1].push_back(upper);
    lower.insert(lower.end(), upper.begin(), upper.end());
    faces[2].push_back(lower);
  }
  for (const auto &some : faces) {
    std::vector<double> factors, coherent;  // from wavelength 5 to 0.2, and those around
    for (double m = std::ceil(length / 5.0) - 20.0; m <= length / 0.2 + 20.0; ++m) {
      std::complex<double> sum = 0.0;
      double factor = 0.0;
      for (const std::vector<double> &face : some) {
        std::complex<double> amplitude = 0.0;
        for (const double x : face) amplitude += std::polar(1.0, 2.0 * M_PI * m * x / length);
        amplitude /= std::sqrt(static_cast<double>(face.size()));
        factor += std::norm(amplitude) / packings;
        sum += amplitude;
      }
      factors.push_back(factor);
      coherent.push_back(std::norm(sum) / packings);
    }
    EXPECT_LT(highest_line(factors, factors), highest);
    // exponential distribution, with probability 1e-9 / (number of wavelengths)
    EXPECT_LT(highest_line(coherent, factors), 21.0 + std::log(5.0 * length));
  }
}

TEST(Packing, FacesHaveNoPeriodAndPackingsNothingInCommon) {
  expect_no_period(120.0, 24, 2.7);
  expect_no_period(480.0, 4, 8.5);
}

TEST(Packing, DoesNotDependOnTheUnitOfLength) {
  LSM::PackingSettings s = settings(20.0);
  const LSM::Packing p = LSM::make_packing(s);
  // The unit is a power of two, so that every digit must be the same.
  const double unit = 1024.0;
  for (double *length : {&s.length, &s.width, &s.rmin, &s.rmax, &s.link_gap, &s.fault_zone})
    *length *= unit;
  const LSM::Packing scaled = LSM::make_packing(s);
  ASSERT_EQ(scaled.discs.size(), p.discs.size());
  for (std::size_t i = 0; i < p.discs.size(); ++i) {
    EXPECT_EQ(scaled.discs[i].x, unit * p.discs[i].x);
    EXPECT_EQ(scaled.discs[i].y, unit * p.discs[i].y);
    EXPECT_EQ(scaled.discs[i].r, unit * p.discs[i].r);
  }
  EXPECT_EQ(scaled.links, p.links);
}

TEST(Packing, MirrorMakesTheUpperBlockAnImageOfTheLowerOne) {
  LSM::PackingSettings s = settings(24.0, 3);
  s.mirror = true;
  s.fault_zone = s.link_gap;
  const LSM::Packing p = LSM::make_packing(s);
  using Place = std::tuple<double, double, double, bool, bool>;
  const auto place = [&s](const LSM::Disc &d) {
    return Place(d.x, d.block == 0 ? s.width - d.y : d.y, d.r, d.fault, d.plate);
  };
  std::set<Place> blocks[2];
  std::set<std::pair<Place, Place>> links[2];
  int facing[2] = {0, 0};
  for (const LSM::Disc &d : p.discs) {
    blocks[d.block].insert(place(d));
    if (!d.fault) continue;
    ++facing[d.block];
    EXPECT_NEAR(std::fabs(d.y - 0.5 * s.width), d.r, 1e-9);
  }
  for (const auto &l : p.links)
    links[p.disc(l.first).block].insert(
        std::minmax(place(p.disc(l.first)), place(p.disc(l.second))));
  EXPECT_EQ(2 * blocks[0].size(), p.discs.size());
  EXPECT_EQ(2 * links[0].size(), p.links.size());
  EXPECT_TRUE(blocks[0] == blocks[1]);
  EXPECT_TRUE(links[0] == links[1]);
  EXPECT_GT(facing[0], 12);
  for (const int side : {0, 1}) EXPECT_EQ(facing[side], p.fault_tangent[side]);

  // The lower block is the same as without the mirror image.
  s.mirror = false;
  std::set<Place> below;
  for (const LSM::Disc &d : LSM::make_packing(s).discs)
    if (d.block == 0) below.insert(place(d));
  EXPECT_TRUE(below == blocks[0]);
}

// The smallest scenes leave the least room for the periodic search.
TEST(Packing, SmallestLengthAndOtherSizesHaveNoOverlap) {
  struct Case {
    double length, width, rmin, rmax;
  };
  const Case cases[] = {{8.0, 4.51, 0.1, 1.0},  {8.0, 30.0, 0.1, 1.0}, {9.99, 10.0, 0.3, 0.7},
                        {17.3, 12.0, 0.2, 2.0}, {20.0, 9.0, 0.9, 1.0}, {8.0, 20.0, 0.05, 0.5}};
  for (const Case &c : cases) {
    LSM::PackingSettings s;
    s.length = c.length;
    s.width = c.width;
    s.rmin = c.rmin;
    s.rmax = c.rmax;
    s.remove_loose = false;  // in some cases no disc would be left
    const LSM::Packing p = LSM::make_packing(s);
    ASSERT_GT(p.discs.size(), 10u);
    expect_valid(p, s);
  }
}

// Whether velocity Verlet is stable with the links, and the contacts (k = kt = 1) that exist when
// the upper block has been pushed down by `depth` and along the fault by `shift`: 4 / dt^2 is above
// all eigenvalues of stiffness over mass.
bool stable(LSM::Packing p, double length, const std::vector<double> &masses, double step,
            double depth, double shift) {
  for (LSM::Disc &d : p.discs)
    if (d.block == 1) {
      d.x += shift;
      d.y -= depth;
    }
  const std::set<std::pair<int, int>> linked(p.links.begin(), p.links.end());
  const std::size_t size = 2 * p.discs.size();
  unit::Matrix a(size, std::vector<double>(size, 0.0));
  for (std::size_t i = 0; i < p.discs.size(); ++i)
    for (std::size_t j = i + 1; j < p.discs.size(); ++j) {
      const auto [dx, dy] = LSM::link_vector(length, p.discs[i], p.discs[j]);
      const double d = std::hypot(dx, dy), n[2] = {dx / d, dy / d};
      const bool link = linked.count({static_cast<int>(i), static_cast<int>(j)}) > 0;
      if (!link && d > p.discs[i].r + p.discs[j].r) continue;
      for (std::size_t c = 0; c < 2; ++c)
        for (std::size_t e = 0; e < 2; ++e) {
          const double k = link ? n[c] * n[e] : (c == e ? 1.0 : 0.0);
          a[2 * i + c][2 * i + e] += k / masses[i];
          a[2 * j + c][2 * j + e] += k / masses[j];
          a[2 * i + c][2 * j + e] -= k / std::sqrt(masses[i] * masses[j]);
          a[2 * j + c][2 * i + e] -= k / std::sqrt(masses[i] * masses[j]);
        }
    }
  return unit::above_all(a, 4.0 / (step * step));
}

TEST(Packing, MassesForAStepAreEnoughWhateverTheContacts) {
  LSM::PackingSettings s = settings(24.0, 3);
  s.width = 8.0;
  s.remove_loose = false;  // small discs at the faces feel contacts most
  const LSM::Packing p = LSM::make_packing(s);
  std::vector<double> own;
  for (const LSM::Disc &d : p.discs) own.push_back(d.r * d.r);
  const double step = 0.115;
  EXPECT_TRUE(stable(p, s.length, own, step, -1.0, 0.0));  // no contact yet
  EXPECT_FALSE(stable(p, s.length, own, 1.1 * step, -1.0, 0.0));
  std::vector<double> enough = LSM::masses_for_step(p, s.length, step, 1.0, 1.0);
  for (std::size_t i = 0; i < own.size(); ++i) enough[i] = std::max(enough[i], own[i]);
  for (const double depth : {0.03, 0.2})
    for (const double shift : {0.0, 1.3, 11.0}) {
      EXPECT_FALSE(stable(p, s.length, own, step, depth, shift)) << depth << ' ' << shift;
      EXPECT_TRUE(stable(p, s.length, enough, step, depth, shift)) << depth << ' ' << shift;
    }
}

TEST(Packing, MassesForAStepCountTheRoomForNeighbours) {
  EXPECT_EQ(LSM::most_neighbours(1.0, 1.0), 6);
  EXPECT_EQ(LSM::most_neighbours(0.2, 0.1), 9);
  LSM::Packing p;
  p.discs = {{4.0, 3.0, 1.0, 0, false, false}, {6.0, 3.0, 1.0, 0, false, true}};
  p.links = {{0, 1}};
  // one link of stiffness 2, room for five contacts, each of at most 3
  const std::vector<double> masses = LSM::masses_for_step(p, 20.0, 0.1, 2.0, 3.0);
  EXPECT_NEAR(masses[0], 0.5 * 0.01 * (2.0 + 5.0 * 3.0), 1e-15);
  EXPECT_EQ(masses[1],
            masses[0]);  // discs of plates too, as the check of the step treats all as free
}

// Each bad setting is refused with a message that names it.
template <class Change>
void expect_refused(const std::string &name, Change change) {
  LSM::PackingSettings s = settings(20.0);
  change(s);
  const std::string what = unit::message_of<std::invalid_argument>([&s] { LSM::make_packing(s); });
  EXPECT_EQ(what.rfind(name + " = ", 0), 0u) << what;
  EXPECT_TRUE(unit::contains(what, "expected"));
  EXPECT_EQ(what.find('\n'), std::string::npos) << what;
}

TEST(Packing, DiscsAtTheFaultMayHaveARangeOfTheirOwn) {
  LSM::PackingSettings s = settings(24.0, 3);
  const LSM::Packing plain = LSM::make_packing(s);
  s.face_rmin = s.rmin;
  s.face_rmax = s.rmax;
  const LSM::Packing same = LSM::make_packing(s);
  EXPECT_EQ(same.links, plain.links);
  s.face_rmin = 0.5;
  s.face_rmax = 0.8;
  for (const bool mirror : {false, true}) {
    s.mirror = mirror;
    const LSM::Packing p = LSM::make_packing(s);
    EXPECT_GT(p.fault_tangent[0] + p.fault_tangent[1], 20);
    EXPECT_LT(p.rmin_found, 0.2);
    for (const LSM::Disc &d : p.discs) {
      if (std::fabs(d.y - 0.5 * s.width) - d.r >= s.link_gap) continue;
      EXPECT_GE(d.r, 0.5);
      EXPECT_LE(d.r, 0.8);
    }
  }
}

TEST(Packing, RefusesImpossibleSettings) {
  using S = LSM::PackingSettings;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused("rmin", [](S &s) { s.rmin = 1.0; });
  // Rubble: what is left does not cover the fault line.
  for (const double rmax : {0.5, 0.8})
    expect_refused("loose", [rmax](S &s) {
      s.length = 60.0;
      s.rmin = 0.2;
      s.rmax = rmax;
    });
  expect_refused("rmin", [](S &s) { s.rmin = 0.0; });
  expect_refused("length", [](S &s) { s.length = 7.99; });
  expect_refused("length", [&](S &s) { s.length = nan; });
  expect_refused("width", [](S &s) { s.width = 4.5; });
  expect_refused("failures", [](S &s) { s.max_failures = 0; });
  expect_refused("tolerance", [](S &s) { s.tolerance = 0.01; });
  expect_refused("linkgap", [](S &s) { s.link_gap = 0.02; });
  expect_refused("linkratio", [](S &s) { s.link_ratio = 1.26; });
  expect_refused("faceradii", [](S &s) { s.face_rmin = s.face_rmax = 1.1; });
  expect_refused("faceradii", [](S &s) { s.face_rmax = 0.5; });
  // discs so small that hardly one is held
  expect_refused("loose", [](S &s) {
    s.face_rmin = 0.1;
    s.face_rmax = 0.2;
  });
  // a hole from plate to fault
  expect_refused("rmin", [](S &s) {
    s.length = 8.0;
    s.width = 6.0;
    s.max_failures = 10;
    s.seed = 3;
  });
  expect_refused("faultzone", [&](S &s) { s.fault_zone = nan; });
}

}  // namespace
