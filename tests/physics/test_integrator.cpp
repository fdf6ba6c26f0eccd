// SPDX-License-Identifier: GPL-2.0-or-later
// Order of convergence of fix lsm/nve in a smooth problem: a vibrating patch of linked discs.
#include "lmp_runner.h"

using namespace physics;

using Integrator = Lmp;

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
      const Result r = run_text(patch, {{"dt", text(dt)}, {"viscosity", viscosity}});
      ASSERT_TRUE(succeeded(r));
      place.push_back(r.last("v_d"));
      kinetic.push_back(r.last("KinEng"));
    }
    const double of_place = std::log2((place[0] - place[1]) / (place[1] - place[2]));
    const double of_kinetic = std::log2((kinetic[0] - kinetic[1]) / (kinetic[1] - kinetic[2]));
    std::printf("viscosity %s: order %.3f (positions), %.3f (kinetic energy)\n", viscosity,
                of_place, of_kinetic);
    EXPECT_NEAR(of_place, 2.0, 0.1);
    EXPECT_NEAR(of_kinetic, 2.0, 0.1);
  }
}

TEST_F(Integrator, ConservesEnergyWithoutViscosity) {
  const Result r = run_text(patch, {{"dt", "0.01"}, {"viscosity", "0"}});
  ASSERT_TRUE(succeeded(r));
  const double e = r.thermo.front().at("v_e");
  EXPECT_NEAR(r.last("v_e"), e, 1e-4 * e);
}

TEST_F(Integrator, ViscosityIsExactForFreeParticles) {
  // Without links velocities decay as exp(-nu t) for any time step, and the ledger has the loss.
  std::string script = patch;
  const std::string links = "create_bonds    many all all 1 1.99 2.01";
  script.erase(script.find(links), links.size());
  const std::string energy = "compute         energy all pe", column = "v_d";
  script.replace(script.find(energy), energy.size(),
                 energy + "\ncompute events all lsm/events ledger yes");
  script.replace(script.find(column + "\n"), column.size(), column + " f_move");
  const Result r = run_text(script, {{"dt", "0.1"}, {"viscosity", "0.3"}});
  ASSERT_TRUE(succeeded(r));
  const double begin = r.thermo.front().at("KinEng");
  EXPECT_NEAR(r.last("KinEng"), begin * std::exp(-2 * 0.3 * 12.8), 1e-12 * begin);
  // In each step the loss is the work of the viscosity.
  EXPECT_NEAR(r.last("f_move"), begin - r.last("KinEng"), 1e-12 * begin);
}
