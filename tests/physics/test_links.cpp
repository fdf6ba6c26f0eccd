// SPDX-License-Identifier: GPL-2.0-or-later
// Links that break, links that do not, and restart files written when a link breaks.
#include "disc_scene.h"
#include "lmp_runner.h"

using namespace physics;

using LinkTypes = Lmp;
using BrokenLinks = Lmp;
using LatticeLinks = Lmp;

// ---- link types that can break and link types that cannot ----

TEST_F(LinkTypes, UnbreakableLinksStayWhereOthersCanBreak) {
  // 21 discs have ten links of each type, which do not fill the lanes of a chunk of 16.
  each_split([](const Variables &newton, int ranks) {
    const Result rest = ran(two_link_types(21) + "thermo 10\nrun 10\n", newton, ranks);
    EXPECT_EQ(rest.last("Bonds"), 20.0);

    // Pulled suddenly, the last link (type 2) breaks, and no other.
    const Result pulled =
        ran(two_link_types(21) + "velocity last set 0.1 0 0\nthermo 10\nrun 200\n", newton, ranks);
    EXPECT_EQ(pulled.last("Bonds"), 19.0);
    EXPECT_GT(pulled.last("c_events[14]"), 0.0);
    // the force of 0.04 vanishes within a step of length 0.1 * 0.02
    EXPECT_LT(std::fabs(pulled.last("c_events[13]")), 0.04 * 0.1 * 0.02);
  });
}

// ---- a link that breaks, and restart files ----

TEST_F(BrokenLinks, RestartOfTheStepInWhichALinkBreaksCountsItOnce) {
  const std::string pulled = two_link_types(5) + "velocity last set 0.1 0 0\nthermo 1\n";
  const Result whole = ran(pulled + "run 60\nprint \"count = $(f_LSM_BREAK:%.0f)\"\n");
  ASSERT_EQ(whole.value("count"), 1.0);
  const double lost = whole.last("c_events[14]");
  ASSERT_GT(lost, 0.0);
  int step = -1;  // of the break
  for (const auto &row : whole.thermo)
    if (step < 0 && row.at("c_events[14]") > 0.0) step = static_cast<int>(row.at("Step"));
  ASSERT_GT(step, 0);

  const std::string go_on = "timestep 0.02\nfix move all lsm/nve\n" + recorded_discs +
                            "thermo 1\nrun 60 upto\nprint \"count = $(f_LSM_BREAK:%.0f)\"\n";
  // The restart file is written before, in and after the step: by the run itself, or by a command
  // after it.
  for (int at : {step - 1, step, step + 1})
    for (bool within : {true, false})
      for (int ranks = 1; ranks <= (at == step ? 2 : 1); ++ranks) {
        SCOPED_TRACE("step " + std::to_string(at) + (within ? " within" : " after") +
                     " the run, ranks " + std::to_string(ranks));
        const std::string n = std::to_string(at);
        ran(within ? pulled + "restart " + n + " broken.*.restart\nrun " + n + "\n"
                   : pulled + "run " + n + "\nwrite_restart broken." + n + ".restart\n",
            {}, ranks);
        const Result r =
            ran("atom_modify map array\ncomm_modify mode single cutoff 4.5\nread_restart broken." +
                    n + ".restart\n" + go_on,
                {}, ranks);
        EXPECT_EQ(r.last("c_events[14]"), lost);
        EXPECT_EQ(r.last("Bonds"), 3.0);
        EXPECT_EQ(r.value("count"), 1.0);
        EXPECT_NEAR(r.last("c_events[13]"), whole.last("c_events[13]"), 1e-12);
      }
}

TEST_F(BrokenLinks, TooLongAtTheBeginBreaksOnce) {
  // A link that is too long at the first force evaluation is absent from lists and files after a
  // run of 0 steps. On two ranks the link lies across their border; with newton off both have it,
  // each with half of its energy.
  each_split([](const Variables &newton, int ranks) {
    const Result r =
        ran(discs({{"-1.05", "0"}, {"1.05", "0"}}) +
                linked("create_bonds single/bond 1 1 2\n", "bond_coeff 1 1.0 1.02\n", "0.1") +
                recorded_discs + R"(
thermo            1
run               0
write_restart     long.restart
variable          links equal bonds
print             "links = ${links}"
run               5
)",
            newton, ranks);
    EXPECT_EQ(r.value("links"), 0.0);
    EXPECT_EQ(r.thermo.front().at("c_events[6]"),
              0.0);  // the energy of the link that has just broken
    EXPECT_NEAR(r.last("c_events[14]"), 0.005, 1e-15);
  });
}

TEST_F(BrokenLinks, AnotherLinkOfThePairKeepsItOutOfContact) {
  // Of two links between the same discs one breaks; the other pulls them together again.
  each_split([](const Variables &newton, int ranks) {
    const Result r =
        ran(discs({{"-1.05", "0"}, {"1.05", "0"}}, 2) +
                linked("create_bonds single/bond 1 1 2\ncreate_bonds single/bond 2 1 2\n",
                       "bond_coeff 1 1.0\nbond_coeff 2 1.0 1.02\n", "0.05") +
                recorded_discs + "thermo 45\nrun 45\n",
            newton, ranks);
    EXPECT_EQ(r.last("Bonds"), 1.0);
    EXPECT_EQ(r.last("c_events[7]"), 0.0);
    // Half a period of w^2 = 2 takes 44.4 steps: then it is compressed as far as it was
    // stretched.
    EXPECT_NEAR(r.last("c_events[6]"), 0.5 * 0.1 * 0.1, 1e-4);
  });
}

TEST_F(BrokenLinks, PartnersOfTheFormerPartnerAreTouched) {
  // One disc of a bent chain breaks away from the middle one and meets the last one, which was the
  // partner of its partner until then. With 'lj 0 1 1', without coul, LAMMPS lists partners of
  // partners after partners: the last disc moves up in the list, but must not be taken for a
  // partner. Which of the two lists the other depends on the IDs with nsq, and on the positions
  // with bins.
  for (const char *list : {"nsq", "bin"})
    for (bool reversed : {false, true})
      for (int ranks : {1, 2}) {
        SCOPED_TRACE(std::string(list) + (reversed ? ", reversed" : "") + ", ranks " +
                     std::to_string(ranks));
        std::vector<std::pair<std::string, std::string>> chain = {
            {"-1.05", "0"}, {"1.05", "0"}, {"-0.1", "1.9"}};
        if (reversed) std::swap(chain.front(), chain.back());
        const std::string loose = reversed ? "3" : "1", last = reversed ? "1" : "3";
        const Result r = ran(discs(chain, 2) + R"(
neighbor          0.4 )" + list + R"(
special_bonds     lj 0 1 1
create_bonds      single/bond 1 2 )" +
                                 loose +
                                 R"(
create_bonds      single/bond 2 2 )" +
                                 last +
                                 R"(
bond_style        lsm/linked
bond_coeff        1 1.0 1.02
bond_coeff        2 1.0
pair_style        lsm/free
pair_coeff        1 1 1.0
group             loose id )" + loose +
                                 R"(
group             last id )" + last +
                                 R"(
velocity          loose set 0.02 0.1 0
timestep          0.05
fix               move all lsm/nve
group             middle id 2
variable          r equal sqrt((xcm(loose,x)-xcm(last,x))^2+(xcm(loose,y)-xcm(last,y))^2)
variable          s equal sqrt((xcm(loose,x)-xcm(middle,x))^2+(xcm(loose,y)-xcm(middle,y))^2)
compute           events all lsm/events ledger yes
thermo_style      custom step bonds v_r v_s c_events[7]
thermo_modify     norm no format float %.17g
thermo            10
run               80
run               10
)",
                             {}, ranks);
        EXPECT_EQ(r.last("Bonds"), 1.0);
        int touching = 0;
        for (const auto &row : r.thermo) {
          const double overlap = std::max(0.0, 2.0 - row.at("v_r"));
          const double other = std::max(0.0, 2.0 - row.at("v_s"));
          EXPECT_NEAR(row.at("c_events[7]"), 0.5 * (overlap * overlap + other * other), 1e-15);
          if (overlap > 0.05) ++touching;
        }
        EXPECT_GE(touching, 2);
        EXPECT_TRUE(r.lines_with("kept from touching").empty()) << r.output;
      }
}

// ---- links of a lattice, which are stored as a pattern where particles lie in order ----

TEST_F(LatticeLinks, SameDigitsInAnyOrderInMemory) {
  const auto shaken = [](const std::string &dashpots, const std::string &order) {
    return R"(
variable          newton index off
dimension         3
boundary          f f p
newton            ${newton}
atom_style        hybrid bond sphere
atom_modify       map array
comm_modify       mode single cutoff 2.3
neighbor          0.1 bin
special_bonds     lj/coul 0 1 1
create_lsm_fault  lattice cubic length 20 width 10 depth 8 spacing 1 mass r3 8
bond_style        lsm/linked
bond_coeff        * 1.0 )" +
           dashpots + "\nbond_coeff 4*5 1.0 1.05 rest $(sqrt(2):%.17g) " + dashpots + R"(
fix               move all lsm/nve
velocity          all create 0.003 7 loop geom
compute           events all lsm/events ledger yes
thermo_style      custom step ke c_events[6] c_events[14] bonds
thermo_modify     norm no
timestep          0.1
)" + order +
           "\nthermo 20\nrun 60\nprint 'links = $(c_events[6]:%.17g)'\n" +
           "print 'broken = $(c_events[14]:%.17g)'\n";
  };
  for (const std::string dashpots : {"", "kelvin-voigt 0.05"}) {
    const Result pattern = ran(shaken(dashpots, ""));
    const double before = pattern.thermo.at(0).at("Bonds"), after = pattern.last("Bonds");
    EXPECT_LT(after, before - 20.0);
    EXPECT_GT(after, 0.9 * before);
    EXPECT_GT(pattern.value("broken"), 0.1);
    const Result list = ran(shaken(dashpots, "atom_modify sort 20 1.5"));
    for (const char *value : {"links", "broken"})
      EXPECT_EQ(list.value(value), pattern.value(value));
    for (const char *newton : {"off", "on"}) {
      const Result ranks = ran(shaken(dashpots, ""), {{"newton", newton}}, 2);
      EXPECT_EQ(ranks.last("Bonds"), after) << newton;
      for (const char *value : {"links", "broken"})
        EXPECT_NEAR(ranks.value(value), pattern.value(value), 1e-12 * pattern.value(value));
    }
  }
}
