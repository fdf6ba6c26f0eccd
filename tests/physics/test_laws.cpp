// SPDX-License-Identifier: GPL-2.0-or-later
// The friction laws of pair lsm/friction: steady sliding as in closed forms (tests/unit has more of
// them), then restart, ranks, ledger, hybrid and refusals for every law.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "disc_scene.h"
#include "fault_scene.h"
#include "read_catalogue.h"

using namespace physics;

using Laws = Lmp;

// A disc that is pressed on a flat surface with a force of 1 slides at a given velocity.
TEST_F(Laws, SlideAsAtTheVelocityOfTheDisc) {
  const std::string rate_state = " mu 0.6 a 0.01 b 0.015 dc 0.005 v0 0.01";
  const std::pair<std::string, std::function<double(double)>> laws[] = {
      {"coulomb 0.5 0.6", [](double) { return 0.5; }},
      {"slip-weakening mu 0.5 mu_static 0.6 dc 0.05", [](double) { return 0.5; }},
      {"velocity-weakening mu 0.6 vc 0.1", [](double v) { return 0.6 / (1.0 + v / 0.1); }},
      {"rate-state-ageing" + rate_state, [](double v) { return 0.6 - 0.005 * std::log(v / 0.01); }},
      {"rate-state-slip" + rate_state, [](double v) { return 0.6 - 0.005 * std::log(v / 0.01); }}};
  for (const auto &[law, friction] : laws)
    for (const double v : {0.02, 0.2}) {
      const Result r =
          ran(R"(
units             lj
dimension         2
boundary          f f p
atom_style        sphere
atom_modify       map array
neighbor          0.3 nsq
region            box block -40 40 -100010 10 -0.5 0.5
create_box        2 box
create_atoms      1 single 0 -100000 0
create_atoms      2 single 0 0.99 0
group             disc type 2
set               type 1 diameter 200000
set               type 2 diameter 2
set               group all mass 1
pair_style        lsm/friction )" +
              law.substr(0, law.find(' ')) + "\npair_coeff * * off\npair_coeff 1 2 100 200 " +
              law.substr(law.find(' ')) + "\nvelocity disc set " + text(v) + R"( 0 0
fix               move disc lsm/nve
fix               press disc addforce 0 -1 0
fix               pull disc setforce 0 NULL NULL
compute           events all lsm/events
thermo_style      custom step c_events[8]
thermo_modify     norm no format float %.17g
timestep          0.02
run               )" +
              text(std::round(2.0 / v / 0.02)) + "\n");
      EXPECT_NEAR(std::sqrt(2.0 * 200.0 * r.last("c_events[8]")), friction(v), 1e-5) << law;
    }
}

// ---- every law on a fault ----

namespace {

struct FaultLaw {
  const char *name, *coefficients;  // after k kt
};
const std::vector<FaultLaw> fault_laws = {
    {"coulomb", "0.5 0.6"},
    {"slip-weakening", "mu 0.5 mu_static 0.6 dc 2e-3 heal 5"},
    {"velocity-weakening", "mu 0.6 vc 0.02"},
    {"rate-state-ageing", "mu 0.6 a 0.01 b 0.015 dc 1e-3 v0 1e-3"},
    {"rate-state-slip", "mu 0.6 a 0.01 b 0.015 dc 1e-3 v0 1e-3 theta 2"}};

std::string with_law(const std::string &pairs) {
  return "bond_style lsm/linked\nbond_coeff 1 1.0\n" + pairs;
}

std::string plain(const FaultLaw &law) {
  return with_law(std::string("pair_style lsm/friction ") + law.name +
                  "\npair_coeff * * off\npair_coeff 3 4 1.0 1.0 " + law.coefficients + "\n");
}

std::string under_hybrid(const FaultLaw &law) {
  return with_law(std::string("pair_style hybrid lsm/free lsm/friction ") + law.name +
                  "\npair_coeff * * lsm/free off\npair_coeff 3 4 lsm/friction 1.0 1.0 " +
                  law.coefficients + "\n");
}

std::string from_data(const std::string &forces, const std::string &files) {
  return "variable velocity index 0.03\n" + fault_start() + "read_data settled.data\n" +
         fault_groups() + forces + "timestep ${dt}\n" + fault_shear(files) +
         "thermo_style custom step ke epair c_events[5] c_events[6] c_events[7] c_events[8] "
         "c_events[11] c_events[12] "
         "c_events[13] f_plates\nthermo_modify norm no format float %.17g\nthermo 500\n";
}

std::string from_restart(const std::string &file, const std::string &forces) {
  return fault_restart(file) + "special_bonds lj/coul 0 1 1\n" + forces +
         "variable velocity index 0.03\ntimestep 0.03\n" + fault_shear("") + "thermo 500\n";
}

const std::vector<std::string> law_columns = {"KinEng",      "c_events[6]",  "c_events[7]",
                                              "c_events[8]", "c_events[11]", "c_events[12]"};

}  // namespace

using LawsOnFault = Fault;

TEST_F(LawsOnFault, BalanceTheirEnergyOnAnyRanksUnderHybridAndFromRestartFiles) {
  std::vector<double> lost;
  for (const FaultLaw &law : fault_laws) {
    const std::string name = law.name;
    const Result whole = ran(from_data(plain(law), "location yes catalogue " + name + ".csv") +
                             "restart 1500 " + name + ".*\nrun 2000\n");
    lost.push_back(whole.last("c_events[11]"));
    EXPECT_GT(lost.back(), 1e-4) << name;
    for (const auto &row : whole.thermo)
      EXPECT_LT(std::fabs(row.at("c_events[13]")), 3e-4 * whole.last("f_plates")) << name;
    EXPECT_NEAR(whole.last("E_pair"), whole.last("c_events[7]") + whole.last("c_events[8]"), 1e-12)
        << name;
    double moment = 0.0;
    for (const auto &event : unit::read_catalogue<LSM::Drop>(path(name + ".csv")).events)
      moment += event.slip_moment;
    EXPECT_GT(moment, 0.0) << name;

    const Result two = ran(from_data(plain(law), "") + "run 2000\n", {{"newton", "on"}}, 2);
    EXPECT_LT(thermo_difference(whole, two, law_columns), 1e-7) << name;
    const Result hybrid =
        ran(from_data(under_hybrid(law), "") + "restart 1500 hybrid." + name + ".*\nrun 2000\n");
    EXPECT_LT(thermo_difference(whole, hybrid, law_columns), 1e-9) << name;

    // A restart file contains the law, but with hybrid it does not contain the coefficients.
    const Result tail = whole.tail(2);
    const std::string again = "pair_coeff * * lsm/free off\npair_coeff 3 4 lsm/friction 1.0 1.0 " +
                              std::string(law.coefficients) + "\n";
    std::vector<std::pair<std::string, std::string>> files = {{name + ".1500", ""},
                                                              {"hybrid." + name + ".1500", again}};
    if (law.name == std::string("coulomb"))
      files.insert(files.end(),
                   {{name + ".1500", plain(law)}, {"hybrid." + name + ".1500", under_hybrid(law)}});
    for (const auto &[file, forces] : files) {
      const Result second = ran(from_restart(file, forces) + "run 500\n");
      EXPECT_LT(
          thermo_difference(tail, second, {"KinEng", "c_events[6]", "c_events[7]", "c_events[8]"}),
          1e-9)
          << file;
    }
    // A data file contains the coefficients, too.
    const Result data = ran(fault_start() + "read_data settled.data\n" + plain(law) +
                            "run 0\nwrite_data written.data pair ij\n");
    const Result read =
        ran(fault_start() + "bond_style lsm/linked\npair_style lsm/friction " + name +
            "\nread_data written.data\nrun 0\nwrite_data again.data pair ij\n");
    const auto coefficients = [](const std::string &text) {
      const std::size_t from = text.find("PairIJ Coeffs");
      return text.substr(from, text.find("Bond Coeffs") - from);
    };
    EXPECT_EQ(coefficients(read_file(path("written.data"))),
              coefficients(read_file(path("again.data"))))
        << name;
  }
  for (std::size_t n = 0; n < lost.size(); ++n)
    for (std::size_t m = 0; m < n; ++m) EXPECT_NE(lost[n], lost[m]);

  // A restart file of another law is refused.
  const auto not_continued = [](const std::string &file, const FaultLaw &law, bool hybrid,
                                std::vector<std::string> parts) {
    parts.emplace_back("lsm/friction");
    refused(parts, from_restart(file, hybrid ? under_hybrid(law) : plain(law)) + "run 0\n");
  };
  ran(from_restart("coulomb.1500", "pair_style none\nrun 0\n" + plain(fault_laws[3])) + "run 0\n");
  not_continued("coulomb.1500", fault_laws[3], false, {"coulomb", "restart", "rate-state-ageing"});
  not_continued("slip-weakening.1500", fault_laws[0], false,
                {"slip-weakening", "restart", "coulomb"});
  not_continued("hybrid.slip-weakening.1500", fault_laws[3], true,
                {"slip-weakening", "restart", "rate-state-ageing"});
  not_continued("hybrid.coulomb.1500", fault_laws[1], true,
                {"restart", "slip-weakening", "4 numbers", "5"});
  not_continued("hybrid.rate-state-slip.1500", fault_laws[0], true, {"restart", "5 numbers", "4"});
}

TEST_F(LawsOnFault, WithoutLawOrWithCoulombItIsTheSameToTheLastDigit) {
  const Result without = ran(from_data(plain({"", "0.6"}), "") + "run 500\n");
  const Result with = ran(from_data(plain({"coulomb onset located", "0.6 0.6"}), "") + "run 500\n");
  EXPECT_EQ(thermo_difference(without, with, law_columns), 0.0);
}

TEST_F(LawsOnFault, MistakesAreNamedInOneLine) {
  struct Case {
    const char *law, *coefficients;
    std::vector<std::string> parts;
  };
  const std::vector<Case> cases = {
      {"viscous",
       "0.6",
       {"viscous",
        "coulomb, slip-weakening, velocity-weakening, rate-state-ageing, rate-state-slip"}},
      {"slip-weakening onset late", "", {"late", "located"}},
      {"slip-weakening",
       "0.6 0.7 0.1",
       {"slip-weakening", "mu VALUE mu_static VALUE dc VALUE [heal VALUE]"}},
      {"slip-weakening", "mu 0.6 mu_static 0.7 d_c 0.1", {"slip-weakening", "'d_c'"}},
      {"slip-weakening", "mu 0.6 mu_static 0.7 mu 0.5", {"a second 'mu'"}},
      {"slip-weakening", "mu 0.6 mu_static 0.7 heal 0.5", {"dc is missing"}},
      {"slip-weakening", "mu 0.6 mu_static 0.5 dc 0.1", {"mu_static is 0.5", "at least mu = 0.6"}},
      {"slip-weakening", "mu 0.6 mu_static 0.7 dc 0", {"dc is 0", "> 0"}},
      {"slip-weakening", "mu 0.6 mu_static 0.7 dc 1 heal -1", {"heal is -1", ">= 0"}},
      {"velocity-weakening", "mu 0.6 vc x", {"x"}}};
  for (const Case &one : cases)
    refused(one.parts,
            fault_start() + "read_data settled.data\n" + plain({one.law, one.coefficients}));

  // Contacts cannot be handed over from one law to another.
  const FaultLaw other = fault_laws[3];
  refused({"lsm/friction", "coulomb", "rate-state-ageing", "none"},
          from_data(plain(fault_laws[0]), "") + "run 5\n" + plain(other) + "run 0\n");
  ran(from_data(plain(fault_laws[0]), "") + "run 5\npair_style none\n" + plain(other) + "run 5\n");
  // Before the first run there are no contacts.
  ran(from_data(plain(fault_laws[0]) + plain(other), "") + "run 5\n");
  refused({"pair coeffs are not set"}, from_data(plain(fault_laws[0]), "") +
                                           "pair_style lsm/friction " + other.name + "\nrun 5\n");
  // Values set by fix adapt are checked as well.
  const auto adapted = [&](const std::string &what) {
    return run_text(from_data(plain(other), "") +
                    "variable a equal -0.001*(step+1)\nfix a all adapt 1 pair lsm/friction " +
                    what + " 3 4 v_a\nrun 3\n");
  };
  EXPECT_TRUE(failed_with(adapted("b"), {"b of types 3 4 is -", ">= 0"}));
  EXPECT_TRUE(failed_with(adapted("k"), {"k of types 3 4 is -", "> 0"}));
  EXPECT_TRUE(failed_with(adapted("on"), {"not compatible"}));
  EXPECT_TRUE(failed_with(adapted("kelvin-voigt"), {"not supported"}));
}

// ---- coefficients that particles have ----

namespace {

/// A law whose coefficients are properties of particles.
struct OwnLaw {
  std::string coefficients, fix, set;

  /// \param factor of the numbers of the law, as the formula of an atom-style variable
  OwnLaw(const FaultLaw &law, const std::string &factor) : fix("fix own all property/atom") {
    const bool named = law.name != std::string("coulomb");
    std::istringstream in(law.coefficients);
    std::string name = "mu", value;
    while (named ? in >> name >> value : in >> value) {
      coefficients += (named ? name + " d_" : "d_") + name + " ";
      fix += " d_" + name;
      set += "variable own atom " + value + "*(" + factor + ")\nset group all d_" + name +
             " v_own\nvariable own delete\n";
      name = "mu_static";
    }
    fix += " ghost yes\n";
  }
  std::string with(std::string (*pairs)(const FaultLaw &), const FaultLaw &law) const {
    return pairs({law.name, coefficients.c_str()}) + fix + set;
  }
};

}  // namespace

TEST_F(LawsOnFault, PropertiesOfParticlesActLikeTheNumbersOfTypes) {
  for (const FaultLaw &law : fault_laws) {
    SCOPED_TRACE(law.name);
    const Result types = ran(from_data(plain(law), "") + "run 400\n");
    const Result same = ran(from_data(OwnLaw(law, "1").with(plain, law), "") + "run 400\n");
    EXPECT_EQ(thermo_difference(types, same, law_columns), 0.0);

    // Now each particle has other numbers.
    const OwnLaw own(law, "1+0.2*sin(7*id)");
    const std::string half = "half." + std::string(law.name);
    const std::string halves = "run 200\nwrite_restart " + half + "\nrun 200\n";
    const std::string script = from_data(own.with(plain, law), "") + halves;
    const Result one = ran(script);
    EXPECT_NE(one.last("c_events[11]"), types.last("c_events[11]"));
    if (law.name == std::string("coulomb")) {
      const Result two = ran(script, {{"newton", "on"}}, 2);
      EXPECT_LT(thermo_difference(one, two, law_columns), 1e-7);
      const Result hybrid = ran(from_data(own.with(under_hybrid, law), "") + "run 200\nrun 200\n");
      EXPECT_LT(thermo_difference(one, hybrid, law_columns), 1e-9);
    }

    // A restart file has the numbers of particles and the names of the properties.
    const Result rest = ran(from_restart(half, own.fix) + "run 200\n");
    for (const char *column : {"KinEng", "c_events[6]", "c_events[7]", "c_events[8]"})
      EXPECT_NEAR(rest.last(column), one.last(column), 1e-9 * one.last(column)) << column;
  }
}

TEST_F(LawsOnFault, PropertiesOfParticlesMayChangeBetweenRuns) {
  const FaultLaw before = {"coulomb", "0.5 0.6"}, after = {"coulomb", "0.4 0.7"};
  const auto types = [&](const std::string &change, const std::string &pairs) {
    return ran(from_data(pairs, "") + "run 400\n" + change + "run 400\n");
  };
  const OwnLaw own(before, "1");
  const std::string mine = own.with(plain, before), changed = OwnLaw(after, "1").set;
  const Result wanted = types("pair_coeff 3 4 1.0 1.0 0.4 0.7\n", plain(before));
  EXPECT_EQ(thermo_difference(wanted, types(changed, mine), law_columns), 0.0);
  EXPECT_GT(thermo_difference(wanted, types("", mine), law_columns), 1e-3);

  // Without a static coefficient, friction is the property alone; other coefficients may be
  // adapted.
  const auto run = [&](const std::string &pairs) {
    return ran(from_data(pairs, "") + "run 800\n");
  };
  EXPECT_EQ(thermo_difference(run(plain({"coulomb", "0.5"})),
                              run(plain({"coulomb", "d_mu"}) + own.fix + own.set), law_columns),
            0.0);
  const std::string ramp =
      "variable a equal 0.5-1e-4*step\nfix a all adapt 10 pair lsm/friction mu 3 4 v_a\n";
  EXPECT_EQ(thermo_difference(run(plain({"coulomb", "0.5 0.6"}) + ramp),
                              run(plain({"coulomb", "0.5 d_mu_static"}) + own.fix + own.set + ramp),
                              law_columns),
            0.0);
  refused({"mu of types 3 4 is d_mu, a property of particles", "fix adapt"},
          from_data(plain({"coulomb", "d_mu 0.6"}) + own.fix + own.set + ramp, "") + "run 20\n");
}

TEST_F(LawsOnFault, MistakesInPropertiesAreNamedInOneLine) {
  const FaultLaw law = {"slip-weakening", "mu d_mu mu_static 0.6 dc d_dc"};
  const std::string set = "set group all d_mu 0.5\nset group all d_dc 0.1\n";
  struct Case {
    std::string more;
    std::vector<std::string> parts;
  };
  const std::string ghosts = "fix own all property/atom d_mu d_dc ghost yes\n" + set;
  for (
      const Case &one : std::vector<Case>{
          {"", {"mu of types 3 4 is d_mu", "no such property", "property/atom d_mu ghost yes"}},
          {"fix own all property/atom d_mu i_dc ghost yes\nset group all d_mu 0.5\n",
           {"dc of types 3 4 is d_dc", "no such property"}},
          {"fix own all property/atom d_mu d_dc\n" + set, {"d_mu", "ghosts"}},
          {ghosts + "set group upperface d_dc 0\n", {"dc of particle ", "types 3 4 is 0", "> 0"}},
          {ghosts + "set group upperface d_mu 0.7\n",
           {"mu_static of particle ", "types 3 4 is 0.6", "at least mu = 0.7"}},
          {ghosts + "set group upperface d_mu -0.1\n", {"mu of particle ", "is -0.1", ">= 0"}},
          // one particle that nothing touches, and one of other types
          {ghosts +
               "set group all d_mu 9\nset group lowerface d_mu 0.5\nset group upperface d_mu 0.5\n",
           {}}})
    for (int ranks : {1, 2}) {
      if (ranks == 2 && one.more.find("upperface d_dc") == std::string::npos) continue;
      const std::string script =
          from_data(plain(law) + one.more, "catalogue wrong.csv") + "run 1\n";
      if (one.parts.empty())
        ran(script, {}, ranks);
      else
        refused(one.parts, script, {}, ranks);
      EXPECT_EQ(std::filesystem::exists(path("wrong.csv")), one.parts.empty());
      std::filesystem::remove(path("wrong.csv"));
    }
  refused({"d_kt"}, fault_start() + "read_data settled.data\n" +
                        with_law("pair_style lsm/friction\npair_coeff * * 1.0 d_kt 0.6\n"));
}
