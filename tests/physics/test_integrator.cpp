// SPDX-License-Identifier: GPL-2.0-or-later
// Order of convergence of fix lsm/nve in a smooth problem, a vibrating patch of linked discs; its
// bound of the highest frequency.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "lmp_runner.h"
#include "eigenvalues.h"
#include "numerics/random.h"

using namespace physics;

using Integrator = Lmp;
using TimeStep = Lmp;

static const char *const patch = R"(
units           lj
dimension       2
boundary        p p p
atom_style      hybrid bond sphere
atom_modify     map array
comm_modify     cutoff 4
special_bonds   lj/coul 0 1 1
lattice         hex $(1/(2*sqrt(3)):%.17g)
region          box block -4 8 -4 8 -0.1 0.1
region          patch block -0.1 3.9 -0.1 1.9 -0.2 0.2
create_box      1 box bond/types 1 extra/bond/per/atom 6 extra/special/per/atom 6
create_atoms    1 region patch
set             type 1 diameter 2.0
set             type 1 mass 1.0
bond_style      lsm/linked
bond_coeff      1 1.0
pair_style      zero 2.2
pair_coeff      * *
create_bonds    many all all 1 1.99 2.01
variable        vx atom 0.1*sin(3*x+y)
variable        vy atom 0.1*cos(x-2*y)
velocity        all set v_vx v_vy 0
timestep        ${dt}
fix             move all lsm/nve viscosity ${viscosity}
compute         energy all pe
variable        e equal c_energy+ke
variable        d equal x[3]+2*y[7]-x[12]
thermo_style    custom step v_e ke v_d
thermo_modify   norm no format float %.17g
run             0
run             $(round(12.8/v_dt):%.0f)
)";

TEST_F(Integrator, SecondOrder) {
  for (const char *viscosity : {"0", "0.05", "0.5"}) {
    std::vector<double> place, kinetic;
    for (double dt : {0.05, 0.025, 0.0125}) {
      const Result r = ran(patch, {{"dt", text(dt)}, {"viscosity", viscosity}});
      place.push_back(r.last("v_d"));
      kinetic.push_back(r.last("KinEng"));
    }
    const double of_place = std::log2((place[0] - place[1]) / (place[1] - place[2]));
    const double of_kinetic = std::log2((kinetic[0] - kinetic[1]) / (kinetic[1] - kinetic[2]));
    EXPECT_NEAR(of_place, 2.0, 0.1);
    EXPECT_NEAR(of_kinetic, 2.0, 0.1);
  }
}

TEST_F(Integrator, ConservesEnergyWithoutViscosity) {
  const Result r = ran(patch, {{"dt", "0.01"}, {"viscosity", "0"}});
  const double e = r.thermo.front().at("v_e");
  EXPECT_NEAR(r.last("v_e"), e, 1e-4 * e);
}

TEST_F(Integrator, ViscosityIsExactForFreeParticles) {
  // Without links velocities decay as exp(-nu t) for any time step, and the ledger has the loss.
  std::string script = replaced(patch, "create_bonds    many all all 1 1.99 2.01", "");
  script = replaced(script, "all pe", "all pe\ncompute events all lsm/events ledger yes");
  script = replaced(script, "v_d\n", "v_d f_move\n");
  const Result r = ran(script, {{"dt", "0.1"}, {"viscosity", "0.3"}});
  const double begin = r.thermo.front().at("KinEng");
  EXPECT_NEAR(r.last("KinEng"), begin * std::exp(-2 * 0.3 * 12.8), 1e-12 * begin);
  // In each step the loss is the work of the viscosity.
  EXPECT_NEAR(r.last("f_move"), begin - r.last("KinEng"), 1e-12 * begin);
}

// ---- bound of the time step ----

namespace {

/// Particles at random places, with random masses, links (k = 3) between some and contacts (k = 1;
/// in two dimensions kt = 2) between all others that are close.
struct Network {
  static constexpr double box = 8.0;
  int dim;
  std::vector<std::array<double, 3>> place;
  std::vector<double> mass;
  std::vector<std::pair<std::size_t, std::size_t>> links;

  Network(int dim_, std::uint64_t seed) : dim(dim_) {
    LSM::Random random(seed);
    for (int i = 0; i < (dim == 2 ? 40 : 90); ++i) {
      place.push_back({random.uniform(0.0, box), random.uniform(0.0, box),
                       dim == 3 ? random.uniform(0.0, box) : 0.0});
      mass.push_back(std::exp(random.uniform(-3.0, 0.0)));
    }
    for (std::size_t i = 0; i < place.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (distance(i, j) < 2.1 && random.uniform() < 0.5) links.emplace_back(j, i);
  }

  std::array<double, 3> between(std::size_t i, std::size_t j) const {
    std::array<double, 3> d;
    for (std::size_t c = 0; c < 3; ++c) d[c] = std::remainder(place[i][c] - place[j][c], box);
    return d;
  }
  double distance(std::size_t i, std::size_t j) const {
    const auto d = between(i, j);
    return std::hypot(d[0], d[1], d[2]);
  }
  std::size_t index(std::size_t i, int c) const {
    return i * static_cast<std::size_t>(dim) + static_cast<std::size_t>(c);
  }

  /// Stiffness over mass, M^-1/2 K M^-1/2.
  std::vector<std::vector<double>> matrix() const {
    return matrix([this](std::size_t i, std::size_t) { return 1.0 / mass[i]; }, true);
  }
  /// Stiffness times factor(i, j) in the part of particle i that is due to j; with or without the
  /// parts that connect both.
  template <class Factor>
  std::vector<std::vector<double>> matrix(Factor &&factor, bool connected) const {
    const std::size_t size = place.size() * static_cast<std::size_t>(dim);
    std::vector<std::vector<double>> a(size, std::vector<double>(size, 0.0));
    for (std::size_t i = 0; i < place.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const bool link = std::count(links.begin(), links.end(), std::pair(j, i)) > 0;
        const double r = distance(i, j), k = link ? 3.0 : 1.0, kt = link || dim == 3 ? 0.0 : 2.0;
        if (r > 2.1) continue;
        const auto d = between(i, j);
        for (int c = 0; c < dim; ++c)
          for (int e = 0; e < dim; ++e) {
            const double n =
                d[static_cast<std::size_t>(c)] * d[static_cast<std::size_t>(e)] / (r * r);
            const double s = k * n + kt * ((c == e ? 1.0 : 0.0) - n);
            a[index(i, c)][index(i, e)] += s * factor(i, j);
            a[index(j, c)][index(j, e)] += s * factor(j, i);
            if (!connected) continue;
            a[index(i, c)][index(j, e)] -= s / std::sqrt(mass[i] * mass[j]);
            a[index(j, c)][index(i, e)] -= s / std::sqrt(mass[i] * mass[j]);
          }
      }
    return a;
  }

  void write(const std::string &file) const {
    std::ofstream out(file);
    out.precision(17);
    out << "network\n\n"
        << place.size() << " atoms\n"
        << links.size() << " bonds\n1 atom types\n"
        << "1 bond types\n0 8 xlo xhi\n0 8 ylo yhi\n"
        << (dim == 3 ? "0 8" : "-0.5 0.5") << " zlo zhi\n\nMasses\n\n1 1\n\nAtoms # hybrid\n\n";
    for (std::size_t i = 0; i < place.size(); ++i)
      out << i + 1 << " 1 " << place[i][0] << ' ' << place[i][1] << ' ' << place[i][2] << " 1 2 "
          << mass[i] / (4.0 * M_PI / 3.0) << '\n';
    out << "\nBonds\n\n";
    for (std::size_t n = 0; n < links.size(); ++n)
      out << n + 1 << " 1 " << links[n].first + 1 << ' ' << links[n].second + 1 << '\n';
  }
};

std::string network_scene(int dim, const std::string &begin, const std::string &links = "") {
  return "variable newton index on\nunits lj\ndimension " + std::to_string(dim) +
         "\nboundary p p p\nnewton ${newton}\natom_style hybrid bond sphere\n"
         "atom_modify map array\nspecial_bonds lj/coul 0 1 1\n"
         "comm_modify mode single cutoff 3.6\nneighbor 0.4 bin\n" +
         begin + "\nbond_style lsm/linked\nbond_coeff 1 3.0\n" +
         (dim == 2 ? "pair_style lsm/friction\npair_coeff * * 1.0 2.0 0.6\n"
                   : "pair_style lsm/free\npair_coeff * * 1.0\n") +
         links +
         "timestep 1e-9\nfix move all lsm/nve\nrun 0\nprint \"omega = $(f_move[1]:%.17g)\"\n";
}

}  // namespace

TEST_F(TimeStep, BoundIsThatOfParticlesAlone) {
  for (const int dim : {2, 3}) {
    const Network network(dim, 4);
    ASSERT_GT(network.links.size(), 30U);
    network.write(path("network.data"));
    const auto equal =
        network.matrix([&](std::size_t i, std::size_t) { return 2.0 / network.mass[i]; }, false);
    const auto by_mass = network.matrix(
        [&](std::size_t i, std::size_t j) {
          return 1.0 / network.mass[i] + 1.0 / std::sqrt(network.mass[i] * network.mass[j]);
        },
        false);
    each_split([&](const Variables &newton, int ranks) {
      const Result r = ran(network_scene(dim, "read_data network.data"), newton, ranks);
      const double bound = std::pow(r.value("omega"), 2);
      EXPECT_TRUE(unit::above_all(network.matrix(), bound)) << dim << "-D";
      EXPECT_TRUE(unit::above_all(by_mass, bound * (1.0 + 1e-9))) << dim << "-D";
      EXPECT_FALSE(unit::above_all(by_mass, bound * (1.0 - 1e-9))) << dim << "-D";
      EXPECT_FALSE(unit::above_all(equal, bound)) << dim << "-D";
    });
  }
}

TEST_F(TimeStep, SmallerOfBothBounds) {
  // A heavy particle in the middle of a ring of 24 of mass 1, to which it is linked (k = 3): it
  // feels 36, and equal shares make 2 * 36 / m of it, shares by mass 36 (1 + sqrt(m)) / m; the
  // others feel 3, of which equal shares make 6, and those by mass 3 (1 + sqrt(1 / m)).
  std::string script =
      "region box block 0 8 0 8 -0.5 0.5\n"
      "create_box 1 box bond/types 1 extra/bond/per/atom 24 extra/special/per/atom 60\n"
      "create_atoms 1 single 4 4 0\n";
  std::string links;
  for (int n = 0; n < 24; ++n) {
    script += "create_atoms 1 single " + text(4.0 + 3.0 * std::cos(n * M_PI / 12.0)) + " " +
              text(4.0 + 3.0 * std::sin(n * M_PI / 12.0)) + " 0\n";
    links += "create_bonds single/bond 1 1 " + std::to_string(n + 2) + "\n";
  }
  script += "set group all diameter 0.5\nset group all mass 1.0\nset atom 1 mass ${m}";
  const std::pair<double, double> bounds[] = {{10.0, 7.2}, {100.0, 36.0 * 11.0 / 100.0}};
  for (const auto &[m, bound] : bounds) {
    const Result r = ran(network_scene(2, script, links), {{"m", text(m)}});
    EXPECT_NEAR(std::pow(r.value("omega"), 2), bound, 1e-9) << m;
  }
}

TEST_F(TimeStep, BoundIsExactForRegularLattices) {
  // Links 1.5 long, k = 3, m = 2: the highest frequencies of the triangular and of the fcc lattice
  // are 6 k / m and 8 k / m.
  const std::string lattices[] = {
      "lattice hex $(2/sqrt(3)/1.5^2:%.17g)\nregion box block 0 6 0 4 -0.5 0.5\n",
      "lattice fcc $(sqrt(2)/1.5^3:%.17g)\nregion box block 0 3 0 3 0 3\n"};
  for (const int dim : {2, 3}) {
    const Result r = ran(network_scene(
        dim,
        lattices[dim - 2] +
            "create_box 1 box bond/types 1 extra/bond/per/atom 12 extra/special/per/atom 60\n"
            "create_atoms 1 box\nset group all diameter 1.5\nset group all mass 2.0",
        "create_bonds many all all 1 1.45 1.55\n"));
    EXPECT_NEAR(std::pow(r.value("omega"), 2), (dim == 2 ? 6.0 : 8.0) * 3.0 / 2.0, 1e-9);
  }
}
