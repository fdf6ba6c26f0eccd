// SPDX-License-Identifier: GPL-2.0-or-later
// Compares the bound of the highest frequency with all eigenvalues, found by Jacobi rotations.
#include "fault/frequency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fault/packing.h"
#include "numerics/random.h"

namespace {

/// Masses and springs in dim dimensions.
struct Network {
  int dim = 2;
  std::vector<double> mass;
  std::vector<LSM::PairSpring> springs;

  std::size_t size() const { return mass.size() * static_cast<std::size_t>(dim); }
  double root_mass(std::size_t n) const {
    return std::sqrt(mass[n / static_cast<std::size_t>(dim)]);
  }
  /// M^-1/2 K M^-1/2 x
  void multiply(const std::vector<double> &x, std::vector<double> &y) const {
    std::vector<double> u(size());
    for (std::size_t n = 0; n < size(); ++n) u[n] = x[n] / root_mass(n);
    y.assign(size(), 0.0);
    LSM::add_spring_forces(springs, dim, u, y);
    for (std::size_t n = 0; n < size(); ++n) y[n] /= root_mass(n);
  }
};

std::vector<double> random_start(const Network &network, std::uint64_t offset) {
  std::vector<double> start(network.size());
  const auto dim = static_cast<std::size_t>(network.dim);
  for (std::size_t i = 0; i < network.mass.size(); ++i)
    for (std::size_t c = 0; c < dim; c += 2) {
      const auto pair = LSM::normal_pair(offset + i, c);
      start[i * dim + c] = pair.first;
      if (c + 1 < dim) start[i * dim + c + 1] = pair.second;
    }
  return start;
}

LSM::LargestEigenvalue by_lanczos(const Network &network, std::uint64_t offset = 1) {
  return LSM::largest_eigenvalue(
      random_start(network, offset), static_cast<double>(network.size()),
      [&](const std::vector<double> &x, std::vector<double> &y) { network.multiply(x, y); },
      [](double mine) { return mine; });
}

/// The dense matrix, assembled from the springs independently of the code under test.
std::vector<std::vector<double>> dense(const Network &network) {
  const std::size_t size = network.size(), dim = static_cast<std::size_t>(network.dim);
  std::vector<std::vector<double>> a(size, std::vector<double>(size, 0.0));
  for (const LSM::PairSpring &s : network.springs)
    for (std::size_t c = 0; c < dim; ++c)
      for (std::size_t d = 0; d < dim; ++d) {
        const double k = s.k * s.n[c] * s.n[d] + s.kt * ((c == d ? 1.0 : 0.0) - s.n[c] * s.n[d]);
        const std::size_t i = static_cast<std::size_t>(s.i) * dim;
        const std::size_t j = static_cast<std::size_t>(s.j) * dim;
        a[i + c][i + d] += k;
        a[j + c][j + d] += k;
        a[i + c][j + d] -= k;
        a[j + c][i + d] -= k;
      }
  for (std::size_t n = 0; n < size; ++n)
    for (std::size_t m = 0; m < size; ++m) a[n][m] /= network.root_mass(n) * network.root_mass(m);
  return a;
}

/// Largest eigenvalue by cyclic Jacobi rotations until the matrix is diagonal.
double exact(const Network &network) {
  auto a = dense(network);
  const std::size_t size = a.size();
  double scale = 0.0;
  for (std::size_t n = 0; n < size; ++n) scale = std::max(scale, a[n][n]);
  for (int sweep = 0; sweep < 60; ++sweep) {
    double most = 0.0;
    for (std::size_t p = 0; p < size; ++p)
      for (std::size_t q = p + 1; q < size; ++q) {
        if (std::fabs(a[p][q]) < 1e-15 * scale) continue;
        most = std::max(most, std::fabs(a[p][q]));
        const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::fabs(theta) + std::hypot(theta, 1.0));
        const double c = 1.0 / std::hypot(t, 1.0), s = t * c;
        for (std::size_t k = 0; k < size; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < size; ++k) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
        }
      }
    if (most == 0.0) break;
  }
  double largest = 0.0;
  for (std::size_t n = 0; n < size; ++n) largest = std::max(largest, a[n][n]);
  return largest;
}

void link(Network &network, int i, int j, double dx, double dy, double dz, double k, double kt) {
  const double r = std::sqrt(dx * dx + dy * dy + dz * dz);
  network.springs.push_back({i, j, true, k, kt, {dx / r, dy / r, dz / r}});
}

/// Links and contacts (with tangential springs) of a small fault.
Network packing(std::uint64_t seed, double mass_power, double contact, double kt,
                double length = 12.0, double width = 8.0) {
  LSM::PackingSettings settings;
  settings.length = length;
  settings.width = width;
  settings.seed = seed;
  settings.max_failures = 200;
  const LSM::Packing p = LSM::make_packing(settings);
  Network network;
  for (const LSM::Disc &d : p.discs) network.mass.push_back(std::pow(d.r, mass_power));
  for (std::size_t i = 0; i < p.discs.size(); ++i)
    for (std::size_t j = i + 1; j < p.discs.size(); ++j) {
      const LSM::Disc &a = p.discs[i], &b = p.discs[j];
      double dx = a.x - b.x;
      dx -= settings.length * std::round(dx / settings.length);
      const double r = std::hypot(dx, a.y - b.y);
      if (r > 1.05 * (a.r + b.r)) continue;
      const bool same = a.block == b.block;
      link(network, static_cast<int>(i), static_cast<int>(j), dx, a.y - b.y, 0.0,
           same ? 1.0 : contact, same ? 0.0 : kt);
    }
  return network;
}

/// Whether a value is above all eigenvalues, that is, value - matrix has a Cholesky factor.
bool above_all(const Network &network, double value) {
  auto a = dense(network);
  for (std::size_t n = 0; n < a.size(); ++n) {
    for (std::size_t m = 0; m < a.size(); ++m) a[n][m] *= -1.0;
    a[n][n] += value;
  }
  for (std::size_t n = 0; n < a.size(); ++n) {
    if (!(a[n][n] > 0.0)) return false;
    for (std::size_t m = n + 1; m < a.size(); ++m) {
      if (a[n][m] == 0.0) continue;
      const double factor = a[n][m] / a[n][n];
      for (std::size_t k = m; k < a.size(); ++k) a[m][k] -= factor * a[n][k];
    }
  }
  return true;
}

void expect_bounded(const Network &network, const std::string &name) {
  for (std::uint64_t offset : {1, 1000, 123456}) {
    const LSM::LargestEigenvalue lanczos = by_lanczos(network, offset);
    ASSERT_GT(lanczos.found, 0.0) << name;
    EXPECT_TRUE(above_all(network, lanczos.bound)) << name << ", start " << offset;
    EXPECT_FALSE(above_all(network, lanczos.found * (1.0 - 1e-12))) << name << ", start " << offset;
    // The limit of the time step, 2 / sqrt(eigenvalue), is at most 5 % below the true one.
    EXPECT_FALSE(above_all(network, lanczos.bound * 0.95 * 0.95)) << name << ", start " << offset;
  }
}

/// As expect_bounded(), with a comparison with all eigenvalues.
void expect_bounded_by_all(const Network &network, const std::string &name) {
  expect_bounded(network, name);
  const double largest = exact(network);
  EXPECT_TRUE(above_all(network, largest * (1.0 + 1e-9))) << name;
  EXPECT_FALSE(above_all(network, largest * (1.0 - 1e-9))) << name;
  const LSM::LargestEigenvalue lanczos = by_lanczos(network);
  EXPECT_GE(lanczos.bound, largest) << name;
  EXPECT_GE(std::sqrt(largest / lanczos.bound), 0.95) << name;
}

TEST(Frequency, TwoMasses) {
  Network network;
  network.mass = {1.0, 4.0};
  link(network, 0, 1, 3.0, 4.0, 0.0, 2.0, 0.0);
  EXPECT_NEAR(exact(network), 2.0 * (1.0 + 0.25), 1e-14);
  const LSM::LargestEigenvalue lanczos = by_lanczos(network);
  EXPECT_NEAR(lanczos.bound, 2.5, 1e-8);
  EXPECT_GE(lanczos.bound, 2.5);
  EXPECT_LE(lanczos.steps, 6);
}

TEST(Frequency, ChainAsInTextbooks) {
  Network network;
  const int n = 60;
  network.mass.assign(n, 1.0);
  for (int i = 0; i < n; ++i) link(network, i, (i + 1) % n, 1.0, 0.0, 0.0, 1.0, 0.0);
  EXPECT_NEAR(exact(network), 4.0, 1e-12);
  expect_bounded_by_all(network, "chain");
}

TEST(Frequency, ModesThatSitOnFewDiscs) {
  // A triangular lattice in which one disc is light.
  for (const double light : {0.94, 0.9, 0.8, 0.5}) {
    Network network;
    const int n = 12;
    network.mass.assign(n * n, 1.0);
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const int i = y * n + x;
        link(network, i, y * n + (x + 1) % n, 1.0, 0.0, 0.0, 1.0, 0.0);
        const int up = (y + 1) % n * n;
        link(network, i, up + x, 0.5, std::sqrt(0.75), 0.0, 1.0, 0.0);
        link(network, i, up + (x + n - 1) % n, -0.5, std::sqrt(0.75), 0.0, 1.0, 0.0);
      }
    network.mass[57] = light;
    expect_bounded(network, "mass " + std::to_string(light));
  }
}

TEST(Frequency, OneModeAmongTwentyThousand) {
  // A light mass m in a long chain of masses 1 has a local mode at 4 / (m (2 - m)). A power
  // iteration that stopped at a change of 0.1 % found the 4 of the chain, 10 % less.
  for (const double light : {0.5, 0.65, 0.7, 0.8}) {
    Network network;
    const int n = 20000;
    network.mass.assign(n, 1.0);
    network.mass[n / 3] = light;
    for (int i = 0; i < n; ++i) link(network, i, (i + 1) % n, 1.0, 0.0, 0.0, 1.0, 0.0);
    const double largest = 4.0 / (light * (2.0 - light));
    for (std::uint64_t offset : {1, 777777}) {
      const LSM::LargestEigenvalue lanczos = by_lanczos(network, offset);
      EXPECT_GE(lanczos.bound, largest) << light << ", start " << offset;
      EXPECT_LE(lanczos.found, largest * (1.0 + 1e-12)) << light << ", start " << offset;
      EXPECT_GE(std::sqrt(largest / lanczos.bound), 0.95) << light << ", start " << offset;
    }
  }
}

TEST(Frequency, SmallFaults) {
  for (std::uint64_t seed : {1, 2, 3})
    expect_bounded(packing(seed, 2.0, 1.0, 1.0), "seed " + std::to_string(seed));
  expect_bounded_by_all(packing(7, 2.0, 1.0, 1.0, 8.0, 5.0), "seed 7, all eigenvalues");
  expect_bounded(packing(4, 3.0, 1.0, 1.0), "m = r^3");
  expect_bounded(packing(5, 2.0, 1e3, 1e4), "stiff contacts");
  expect_bounded(packing(6, 2.0, 1e-6, 0.0), "soft contacts");
}

TEST(Frequency, ThreeDimensionsAndRandomStiffness) {
  LSM::Random random(9);
  Network network;
  network.dim = 3;
  for (int i = 0; i < 50; ++i) network.mass.push_back(std::exp(random.uniform(-4.0, 0.0)));
  for (int i = 0; i < 50; ++i)
    for (int j = 0; j < i; ++j)
      if (random.uniform() < 0.12)
        link(network, i, j, random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
             std::exp(random.uniform(-6.0, 6.0)), std::exp(random.uniform(-6.0, 6.0)));
  expect_bounded_by_all(network, "3-D");
}

/// The network of a rank that owns all particles but has the second end of every other spring as a
/// ghost.
/// \param newton whether ghosts return their forces; if not, both ends of a spring have it
LSM::LargestEigenvalue with_ghosts(const Network &network, bool newton) {
  LSM::SpringNetwork rank;
  rank.dim = network.dim;
  rank.mass = network.mass;
  std::vector<std::size_t> owner;
  const auto ghost_of = [&](int i) {
    owner.push_back(static_cast<std::size_t>(i));
    return static_cast<int>(network.mass.size() + owner.size() - 1);
  };
  for (std::size_t i = 0; i < network.mass.size(); ++i) rank.id.push_back(i + 1);
  for (std::size_t n = 0; n < network.springs.size(); ++n) {
    LSM::PairSpring s = network.springs[n];
    if (n % 2 == 1) {
      LSM::PairSpring other = s;
      s.j = ghost_of(s.j);
      s.both = newton;
      std::swap(other.i, other.j);
      other.j = ghost_of(other.j);
      other.both = false;
      if (!newton) rank.springs.push_back(other);
    }
    rank.springs.push_back(s);
  }
  rank.ghosts = owner.size();
  const auto dim = static_cast<std::size_t>(network.dim);
  std::vector<double> displacement, force;
  const auto each_ghost = [&](auto &&exchange) {
    for (std::size_t g = 0; g < owner.size(); ++g)
      for (std::size_t c = 0; c < dim; ++c)
        exchange((network.mass.size() + g) * dim + c, owner[g] * dim + c);
  };
  return LSM::highest_frequency_squared(
      rank, static_cast<double>(network.size()), displacement, force,
      [&] { each_ghost([&](std::size_t g, std::size_t o) { displacement[g] = displacement[o]; }); },
      [&] {
        if (newton) each_ghost([&](std::size_t g, std::size_t o) { force[o] += force[g]; });
      },
      [](double mine) { return mine; });
}

TEST(Frequency, ParticlesOfOtherRanksAndBeyondTheBoundary) {
  LSM::Random random(31);
  Network three;
  three.dim = 3;
  for (int i = 0; i < 30; ++i) three.mass.push_back(random.uniform(0.04, 1.0));
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < i; ++j)
      if (random.uniform() < 0.2)
        link(three, i, j, random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
             random.uniform(0.5, 2.0), random.uniform(0.0, 1.0));
  for (const Network &network : {packing(7, 2.0, 1.0, 1.0, 8.0, 5.0), three}) {
    const double largest = exact(network);
    const LSM::LargestEigenvalue plain = by_lanczos(network);
    for (const bool newton : {false, true}) {
      const LSM::LargestEigenvalue found = with_ghosts(network, newton);
      EXPECT_GE(found.bound, largest);
      EXPECT_LE(found.found, largest * (1.0 + 1e-12));
      EXPECT_GE(std::sqrt(largest / found.bound), 0.95);
      EXPECT_NEAR(found.bound, plain.bound, 1e-9 * largest);  // the same start vector
    }
  }
}

TEST(Frequency, NothingToSwing) {
  Network network;
  network.mass.assign(5, 1.0);
  EXPECT_EQ(by_lanczos(network).bound, 0.0);
}

TEST(Frequency, StartVectorIsNormal) {
  const int pairs = 200000;
  double sum = 0.0, squares = 0.0, fourth = 0.0, mixed = 0.0, next = 0.0, before = 0.0;
  for (int i = 0; i < pairs; ++i) {
    const auto [a, b] = LSM::normal_pair(static_cast<std::uint64_t>(i), 0);
    sum += a + b;
    squares += a * a + b * b;
    fourth += a * a * a * a + b * b * b * b;
    mixed += a * b;
    next += a * before;
    before = a;
  }
  const double n = 2.0 * pairs;
  // within five standard deviations
  EXPECT_NEAR(sum / n, 0.0, 5.0 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1.0, 5.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourth / n, 3.0, 5.0 * std::sqrt(96.0 / n));
  EXPECT_NEAR(mixed / pairs, 0.0, 5.0 / std::sqrt(pairs));
  EXPECT_NEAR(next / pairs, 0.0, 5.0 / std::sqrt(pairs));
}

}  // namespace
