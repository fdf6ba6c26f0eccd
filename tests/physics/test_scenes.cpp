// SPDX-License-Identifier: GPL-2.0-or-later
// Compares the small scenes of the inputs folder with theory.
#include <cmath>
#include <string>
#include <vector>

#include "disc_scene.h"
#include "lmp_runner.h"

using namespace physics;

using Collision = Lmp;
using PWave = Lmp;
using Coulomb = Lmp;
using Tension = Lmp;

TEST_F(Collision, HeadOnAsInTheory) {
  // Disc 1 (radius and mass 1) hits disc 2 (radius 0.7, mass 0.49), which is at rest, at 0.1.
  const Result r = ran_scene("two_body_collision.in", {{"dt", "0.005"}});
  EXPECT_NEAR(r.value("velocity_1"), 0.1 * (1 - 0.49) / 1.49, 1e-6);
  EXPECT_NEAR(r.value("velocity_2"), 0.1 * 2 / 1.49, 1e-6);
  EXPECT_LT(std::fabs(r.value("energy_error")), 1e-5);
}

TEST_F(Collision, MomentumIsKeptOnAllRankCounts) {
  each_split([](Variables variables, int ranks) {
    variables.emplace_back("offset", "0.6");
    const Result r = ran_scene("two_body_collision.in", variables, ranks);
    EXPECT_NEAR(r.value("momentum_x"), 0.1, 1e-15);
    EXPECT_NEAR(r.value("momentum_y"), 0.0, 1e-15);
    EXPECT_GT(std::fabs(r.value("velocity_1") - 0.1), 0.01);  // they did collide
  });
}

TEST_F(Collision, EnergyErrorFallsWithTheTimeStep) {
  // The order is at least two; the error after a collision even falls as (w dt)^3. It depends on
  // when within a step the contact begins: the largest one over several gaps is compared.
  auto worst = [](double dt) {
    double most = 0.0;
    for (int n = 0; n < 8; ++n) {
      const Result r = ran_scene("two_body_collision.in",
                                 {{"dt", text(dt)}, {"gap", text(0.5 + n * 0.1 * dt / 8)}});
      most = std::max(most, std::fabs(r.value("energy_error")));
    }
    return most;
  };
  const double coarse = worst(0.08), fine = worst(0.02);
  const double order = std::log(coarse / fine) / std::log(4.0);
  const double w = std::sqrt(1.49 / 0.49);  // of the contact: k = 1, reduced mass
  EXPECT_GT(order, 2.0);
  EXPECT_LT(coarse, std::pow(w * 0.08, 3));
  EXPECT_LT(fine, std::pow(w * 0.02, 3));
}

TEST_F(PWave, LatticeAsInEquation4) {
  for (const Variables &variables :
       {Variables{{"direction", "x"}},
        {{"direction", "y"}},
        {{"k", "4"}, {"m0", "0.25"}, {"r", "0.5"}, {"sigma", "5"}, {"dt", "0.02"}}}) {
    // twice the speed for four times the stiffness, and for a quarter of the mass; half the spacing
    const double theory = std::sqrt(9.0 / 8.0) * (variables.size() > 1 ? 4.0 : 2.0);
    EXPECT_NEAR(ran_scene("p_wave_lattice.in", variables).value("p_wave_speed"), theory,
                0.01 * theory);
  }
}

TEST_F(PWave, RandomPacking) {
  const Result r = ran_scene("p_wave_packing.in");
  EXPECT_NEAR(r.value("p_wave_speed"), 2.1, 0.1);
}

TEST_F(Coulomb, SticksBelowTheStaticStrength) {
  for (const char *mus : {"0.6", "0.8"}) {
    const Result r = ran_scene("coulomb_block.in", {{"mus", mus}, {"pull", "0.98"}});
    EXPECT_EQ(r.value("friction_work"), 0.0);
    // The tangential spring holds the disc at force / kt, but for the oscillation left by the ramp.
    const double elastic = 0.98 * std::stod(mus) * 0.01;
    EXPECT_NEAR(r.value("slip"), elastic, 0.02 * elastic);
  }
}

// Once it slides, friction is dynamic.
TEST_F(Coulomb, SlidesAboveItWithTheRightAcceleration) {
  for (const auto &[mus, pull] : {std::pair(0.6, 1.02), {0.6, 1.3}, {0.8, 1.02}}) {
    const Result r = ran_scene("coulomb_block.in", {{"mus", text(mus)}, {"pull", text(pull)}});
    const double theory = pull * mus * 0.01 - 0.006;
    EXPECT_NEAR(r.value("acceleration"), theory, 0.005 * theory);
    EXPECT_GT(r.value("friction_work"), 0.0);
  }
}

TEST_F(Coulomb, RanksAndNewton) {
  const Result one = ran_scene("coulomb_block.in");
  each_split([&](const Variables &newton, int ranks) {
    const Result r = ran_scene("coulomb_block.in", newton, ranks);
    EXPECT_NEAR(r.value("slip"), one.value("slip"), 1e-9);
    EXPECT_NEAR(r.value("friction_work"), one.value("friction_work"), 1e-9);
  });
}

TEST_F(Coulomb, ContactsSeenFromTheOtherSide) {
  // Two discs, one beside the other and a little higher, are sheared while both drift upwards
  // through the bins with which LAMMPS finds pairs. It lists the left one first if both are in the
  // same row of bins, else the lower one, so that the order of the pair changes. Listed by ID it is
  // always the same. The border between two ranks lies across the path.
  auto run = [](const std::string &list, const std::string &newton, int ranks) {
    return ran("processors 1 * 1\n" + discs({{"-0.85", "0.45"}, {"0.85", "-0.45"}}) + R"in(
variable          list index bin
neighbor          0.4 ${list}
neigh_modify      delay 0 every 1 check no
bond_style        lsm/linked
bond_coeff        1 1.0
pair_style        lsm/friction
pair_coeff        1 1 1.0 1.0 0.6
velocity          all set 0 0.1 0
group             upper id 1
group             lower id 2
fix               up upper addforce 0.13 -0.05 0
fix               down lower addforce -0.13 0.05 0
fix               move all lsm/nve
compute           pairs all property/local patom1
compute           first all reduce max c_pairs inputs local
timestep          0.05
thermo_style      custom step ke pe c_first
thermo_modify     norm no format float %.17g
thermo            25
run               1200
variable          y equal xcm(upper,y)
print             "height = $(v_y:%.17g)"
)in",
               {{"list", list}, {"newton", newton}}, ranks);
  };
  const Result by_number = run("nsq", "on", 1);
  EXPECT_GT(by_number.value("height"), 5.0);  // over several borders of bins
  for (const auto &[newton, ranks] : {std::pair("on", 1), {"on", 2}, {"off", 2}}) {
    SCOPED_TRACE(std::string("newton ") + newton + ", ranks " + std::to_string(ranks));
    const Result r = run("bin", newton, ranks);
    EXPECT_NEAR(r.value("height"), by_number.value("height"), 1e-11);
    EXPECT_LT(thermo_difference(r, by_number, {"KinEng", "PotEng"}), 1e-11);
    int turns = 0;
    for (std::size_t n = 0; n < r.thermo.size(); ++n) {
      EXPECT_EQ(by_number.thermo[n].at("c_first"), by_number.thermo[0].at("c_first"));
      if (n > 0 && r.thermo[n].at("c_first") != r.thermo[n - 1].at("c_first")) ++turns;
    }
    if (ranks == 1) {
      EXPECT_GE(turns, 4);
    }
  }
}

TEST_F(Coulomb, SpringOfAStickingContactIsSecondOrder) {
  // A disc moves past another on a straight line, without slip. Each step adds the displacement
  // perpendicular to the line between the centres, in total the integral of c / r, where c is the
  // cross product of distance and velocity. As the discs approach each other throughout, an
  // increment computed at the end or the start of a step is wrong by half the change of the
  // distance in it, always with the same sign.
  const double x = 1.95, y = -0.4, vx = -0.15, vy = 0.05, time = 6.4;
  const double speed = std::hypot(vx, vy), cross = x * vy - y * vx;
  const double from = (x * vx + y * vy) / speed, to = from + speed * time;
  ASSERT_LT(to, 0.0);  // the point of closest approach is not reached
  const double h = std::fabs(cross) / speed;
  const double exact = h * (std::asinh(to / h) - std::asinh(from / h));
  std::vector<double> off;
  for (double dt : {0.16, 0.08, 0.04}) {
    const Result r = ran(discs({{"0", "0"}, {text(x), text(y)}}) + R"in(
bond_style        lsm/linked
bond_coeff        1 1.0
pair_style        lsm/friction
pair_coeff        1 1 1.0 1.0 1000
group             moved id 2
velocity          moved set )in" +
                         text(vx) + " " + text(vy) + R"in( 0
fix               hold all setforce 0 0 0
fix               move all lsm/nve
compute           events all lsm/events ledger yes
timestep          )in" + text(dt) +
                         "\n" + disc_columns + "thermo 1000\nrun " + text(std::round(time / dt)) +
                         "\n");
    EXPECT_EQ(r.last("c_events[11]"), 0.0);  // no slip
    off.push_back(std::sqrt(2.0 * r.last("c_events[8]")) - exact);
  }
  EXPECT_LT(std::fabs(off[2]), 1e-5 * exact);
  EXPECT_NEAR(std::log2(off[0] / off[2]) / 2.0, 2.0, 0.1);
}

// When pulled a second time, the pieces separate without resistance.
TEST_F(Tension, BreaksAndTurnsIntoContactsThatBearNoTension) {
  const Result r = ran(read_file(std::string(LSM_INPUTS) + "/tension_break.in") + R"lmp(
velocity        left set $(-v_speed) 0 0
velocity        right set ${speed} 0 0
run             $(ceil(v_back/v_dt):%.0f)
velocity        left set 0 0 0
velocity        right set 0 0 0
run             $(ceil(v_rest/v_dt):%.0f)
print           "tension_at_end = $(v_tension:%.10g)"
print           "links_at_end = $(v_links:%.0f)"
)lmp");
  EXPECT_LT(r.value("links_after_pull"), r.value("links_before"));
  double strongest = 0.0;
  for (const auto &row : r.thermo) strongest = std::max(strongest, row.at("v_tension"));
  EXPECT_GT(strongest, 0.05);
  EXPECT_LT(std::fabs(r.value("tension_after_pull")), 1e-6);  // two pieces
  EXPECT_LT(r.value("tension_after_push"), -0.05);            // contacts bear pressure
  EXPECT_EQ(r.value("links_at_end"), r.value("links_after_push"));
  EXPECT_LT(std::fabs(r.value("tension_at_end")), 1e-6);
}

TEST_F(Tension, SameOnAllRankCountsAndNewton) {
  const Result one = ran_scene("tension_break.in");
  each_split([&](const Variables &newton, int ranks) {
    const Result r = ran_scene("tension_break.in", newton, ranks);
    EXPECT_EQ(r.value("links_after_pull"), one.value("links_after_pull"));
    EXPECT_EQ(r.value("links_after_push"), one.value("links_after_push"));
    EXPECT_LT(thermo_difference(one, r, {"Bonds", "v_tension", "KinEng"}), 1e-7);
  });
}

// ---- plates on a lattice of discs of radius and mass 1 ------------------------------------------

/// A bar of the lattice between two plates that are loaded from time 0 on; its P-waves propagate
/// across the rows.
class Plates : public Lmp {
 protected:
  static Result pressed_bar(double impedance) {
    return ran(R"(
units             lj
dimension         2
boundary          p f p
newton            off
atom_style        hybrid bond sphere
atom_modify       map array
comm_modify       mode single cutoff 3.6
neighbor          0.3 bin
special_bonds     lj/coul 0 1 1
lattice           hex $(1/(2*sqrt(3)):%.17g)
region            box block 0 4 -40 40 -0.1 0.1
create_box        1 box bond/types 1 extra/bond/per/atom 6 extra/special/per/atom 6
create_atoms      1 box
change_box        all y delta -5 5 units box
set               type 1 diameter 2
set               type 1 mass 1
bond_style        lsm/linked
bond_coeff        1 1.0
pair_style        zero 2.2
pair_coeff        * *
create_bonds      many all all 1 1.99 2.01
variable          far equal bound(all,ymax)-0.5
variable          near equal bound(all,ymin)+0.5
region            above block INF INF ${far} INF INF INF units box
region            below block INF INF INF ${near} INF INF units box
group             upper region above
group             lower region below
group             bar subtract all upper lower
timestep          0.05
fix               move bar lsm/nve
fix               plates all lsm/plates lower upper stress 1e-4 impedance )" +
               text(impedance) + R"(
compute           moving all ke
thermo_style      custom step time c_moving f_plates[9]
thermo_modify     norm no format float %.17g
thermo            100
run               4000
)");
  }
};

TEST_F(Plates, ImpedanceAddsToThatOfTheBlocks) {
  // The impedance is Eq. 4 times the mass per area. A plate under a stress moves at the stress over
  // the sum of the impedances until the wave from the other side arrives, after 138 / 2.12 = 65
  // time units.
  const double blocks = std::sqrt(9.0 / 8.0) * 2.0 / (2.0 * std::sqrt(3.0));
  double rest = 0.0;
  for (const double impedance : {0.0, 0.3, blocks, 3.0}) {
    const Result r = pressed_bar(impedance);
    ASSERT_EQ(r.thermo.size(), 41u);
    const double speed =
        0.5 * (r.thermo.at(11).at("f_plates[9]") - r.thermo.at(4).at("f_plates[9]")) / 35.0;
    EXPECT_NEAR(speed / (1e-4 / (impedance + blocks)), 1.0, 0.02) << "impedance " << impedance;
    // Three crossings later reflected waves are still there, except with the matching plate.
    const double moving = r.thermo.at(40).at("c_moving");
    if (impedance == 0.0) rest = moving;
    if (impedance == blocks) {
      EXPECT_LT(moving, 0.01 * rest);
    } else {
      EXPECT_GT(moving, 0.01 * rest);
    }
  }
  EXPECT_GT(rest, 0.0);
}

TEST_F(Plates, WorkOfAStressThatIsRamped) {
  // Plates without blocks, of one disc each, start from rest under a growing force: the work is
  // half the square of the momentum over the mass. In a step, the trapezoidal rule differs from the
  // energy that velocity Verlet gives the plate by dt^2 (F_end^2 - F_begin^2) / (8 m), the sum of
  // which depends on the last force only; with the stress at the start or the end of a step the
  // work would be off by 2 dt / (3 t).
  const double stress = 1e-3, length = 4.0, ramp = 40.0, masses[] = {2.0, 3.0};
  for (double dt : {0.4, 0.1}) {
    const Result r = ran(R"in(
units             lj
dimension         2
boundary          p f p
atom_style        sphere
atom_modify       map array
region            box block 0 4 -10 10 -0.5 0.5
create_box        2 box
create_atoms      1 single 1 -5 0
create_atoms      2 single 1 5 0
set               type * diameter 1
set               type 1 mass 2
set               type 2 mass 3
pair_style        lsm/free
pair_coeff        * * 1
group             lower type 1
group             upper type 2
fix               plates all lsm/plates lower upper stress )in" +
                         text(stress) + " stressramp " + text(ramp) + R"in(
compute           events all lsm/events ledger yes
timestep          )in" + text(dt) +
                         R"in(
thermo_style      custom step time f_plates f_plates[9] f_plates[10] c_events[10] c_events[13]
thermo_modify     norm no format float %.17g
thermo            )in" + text(std::round(4.0 / dt)) +
                         "\nrun " + text(std::round(ramp / dt)) + "\n");
    ASSERT_EQ(r.thermo.size(), 11u);
    for (std::size_t n = 1; n < r.thermo.size(); ++n) {
      const auto &row = r.thermo[n];
      const double t = row.at("Time"), force = stress * length * t / ramp;
      double kinetic = 0.0, verlet = 0.0;
      for (double m : masses) {
        kinetic += 0.5 * std::pow(0.5 * force * t, 2) / m;
        verlet += dt * dt * force * force / (8.0 * m);
      }
      EXPECT_NEAR(row.at("f_plates[10]"), kinetic, 1e-12 * kinetic) << "t = " << t;
      EXPECT_NEAR(row.at("f_plates"), kinetic - verlet, 1e-12 * kinetic) << "t = " << t;
      EXPECT_NEAR(row.at("c_events[10]"), row.at("f_plates"), 1e-12 * kinetic) << "t = " << t;
      EXPECT_NEAR(row.at("c_events[13]"), verlet, 1e-12 * kinetic) << "t = " << t;
    }
  }
}
