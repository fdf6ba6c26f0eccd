// SPDX-License-Identifier: GPL-2.0-or-later
// Stiff and extreme cases: each is either correct (ledger, momentum, bounds) or refused with a
// clear message. The lines "EXTREME case outcome", separated by tabs, become a table of the
// accuracy report.
#include <cstdlib>

#include "fault_scene.h"
#include "read_catalogue.h"

using namespace physics;

using Extremes = Lmp;
using Reproducible = Fault;

namespace {

void outcome(const std::string &name, const std::string &what) {
  std::printf("EXTREME\t%s\t%s\n", name.c_str(), what.c_str());
}

std::string brief(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.2g", value);
  return buffer;
}

/// A fault of a few hundred discs, some of them loose, compressed and sheared fast. The time step
/// is a fraction of the limit that fix lsm/nve finds.
std::string small_fault() {
  return R"(
variable rmin      index 0.1
variable klink     index 1.0
variable k         index 1.0
variable kt        index 1.0
variable mu        index 0.6
variable stress    index 0.006
variable velocity  index 0.002
variable viscosity index 0.1
variable part      index 0.25    # of the stability limit
variable ramp      index 3
variable settle    index 2000
variable steps     index 4000
variable check     index error
variable failures  index 300
variable every     index 1       # steps between samples of the PE series
variable thermo    index 100
)" + fault_start() +
         R"(
create_lsm_fault  length 16 width 10 seed 8 failures ${failures} rmin ${rmin} loose keep
bond_style        lsm/linked
bond_coeff        1 ${klink}
pair_style        lsm/friction
pair_coeff        * * off
pair_coeff        3 4 ${k} ${kt} ${mu}
)" + fault_groups() +
         R"(
fix               limit blocks lsm/nve
timestep          1e-9
run               0
timestep          $(v_part*f_limit[2]:%.15g)
unfix             limit
compute           guard all lsm/events check 5
fix               press blocks lsm/nve viscosity 0.2 dtcheck ${check}
fix               hold all lsm/plates lower upper stress ${stress} stressramp ${ramp} damping 0.2
run               ${settle}
unfix             press
unfix             hold
uncompute         guard
fix               move blocks lsm/nve viscosity ${viscosity} dtcheck ${check}
fix               plates all lsm/plates lower upper stress ${stress} damping ${viscosity} velocity ${velocity} ramp ${ramp}
compute           events all lsm/events overwrite yes catalogue extreme.csv series extreme.pe stride ${every} ledger yes check 50 emergency extreme.restart
)" + fault_columns +
         R"(
thermo            ${thermo}
run               ${steps}
)";
}

/// Largest residual of the ledger during the run, relative to the largest energy.
double ledger_error(const Result &r) {
  double most = 0.0, scale = 0.0;
  for (const auto &row : r.thermo) {
    if (!row.count("c_events[13]")) continue;
    most = std::max(most, std::fabs(row.at("c_events[13]")));
    for (const char *energy :
         {"c_events[5]", "c_events[9]", "c_events[10]", "c_events[11]", "c_events[12]"})
      scale = std::max(scale, std::fabs(row.at(energy)));
  }
  return scale > 0.0 ? most / scale : most;
}

bool finite(const Result &r) {
  for (const auto &row : r.thermo)
    for (const auto &one : row)
      if (!std::isfinite(one.second)) return false;
  return true;
}

}  // namespace

TEST_F(Extremes, RadiiStiffnessFrictionLoad) {
  struct Case {
    const char *name;
    Variables variables;
    double tolerance;
  };
  const std::vector<Case> cases = {
      {"radius ratio 10:1", {}, 1e-3},
      {"radius ratio 100:1", {{"rmin", "0.01"}, {"failures", "100"}}, 1e-3},
      {"contacts 1e6 times stiffer than links", {{"k", "1e6"}, {"kt", "1e6"}}, 1e-3},
      {"links 1e6 times stiffer than contacts", {{"klink", "1e6"}}, 1e-3},
      {"kt/k = 0.01", {{"kt", "0.01"}}, 1e-3},
      {"kt/k = 100", {{"kt", "100"}}, 1e-3},
      {"mu = 0", {{"mu", "0"}}, 1e-3},
      {"mu = 10", {{"mu", "10"}}, 1e-3},
      {"normal stress 1e-6", {{"stress", "1e-6"}}, 1e-3},
      {"normal stress 0.05", {{"stress", "0.05"}}, 1e-3},
      {"driving velocity 0", {{"velocity", "0"}}, 1e-3},
      {"driving velocity 0.1 of the P-wave speed", {{"velocity", "0.21"}}, 1e-2},
      {"viscosity 0", {{"viscosity", "0"}}, 1e-3},
      {"viscosity 1e4 (overdamped)", {{"viscosity", "1e4"}}, 1e-3},
      {"time step 0.01 of the limit", {{"part", "0.01"}}, 1e-5},
      {"time step 0.5 of the limit", {{"part", "0.5"}}, 1e-2},
      {"time step 0.9 of the limit", {{"part", "0.9"}}, 1e-1},
      {"zero-length ramps", {{"ramp", "0"}}, 1e-3}};
  for (const auto &one : cases) {
    const Result r = ran(small_fault(), one.variables);
    EXPECT_TRUE(finite(r)) << one.name;
    EXPECT_LT(ledger_error(r), one.tolerance) << one.name;
    const auto events = unit::read_catalogue(path("extreme.csv")).events.size();
    outcome(one.name, "right; ledger to " + brief(ledger_error(r)) + "; " + std::to_string(events) +
                          " events");
  }
}

TEST_F(Extremes, RefusedOrStopped) {
  refused({"Time step", "stability limit"}, small_fault(), {{"part", "1.2"}});
  outcome("time step 1.2 of the limit", "refused: time step above the stability limit");

  // With a time step above the limit and its check off, and under a stress that crushes the discs,
  // the check of the strain stops the compression, before there is a catalogue.
  for (const auto &[name, variables] : std::vector<std::pair<std::string, Variables>>{
           {"time step 2 of the limit, check off", {{"part", "2"}, {"check", "off"}}},
           {"normal stress 0.1", {{"stress", "0.1"}}},
           {"normal stress 2", {{"stress", "2"}}}}) {
    for (const char *file : {"extreme.csv", "extreme.pe"}) std::filesystem::remove(path(file));
    const Result r = run_text(small_fault(), variables);
    EXPECT_TRUE(
        failed_with(r, {"Run stopped at step ", "a link is strained by ", "above strainlimit 0.5"}))
        << name;
    EXPECT_FALSE(std::filesystem::exists(path("extreme.csv"))) << name;
    EXPECT_TRUE(finite(r)) << name;
    const auto lines = r.lines_with("ERROR");
    ASSERT_EQ(lines.size(), 1U);
    // Under stress the strain grows slowly, and the run is stopped as soon as it exceeds the limit.
    if (name.find("stress") != std::string::npos) {
      EXPECT_LT(std::stod(lines[0].substr(lines[0].find(" by ") + 4)), 0.7) << name;
    }
    outcome(name, "stopped: " + lines[0].substr(0, lines[0].find(" (/")));
  }

  refused({"lower", "particles"}, replaced(small_fault(), "type 5", "empty"));
  outcome("a plate without particles", "refused: the plate has no particles");
}

// LSM_REST_STEPS: number of steps, 1e8 in the accuracy report.
TEST_F(Extremes, LongRestDoesNotDrift) {
  const char *asked = std::getenv("LSM_REST_STEPS");
  const std::string steps = asked ? asked : "100000";
  const std::string samples = std::to_string(std::stoll(steps) / 4000);
  const Result r = ran(small_fault(), {{"velocity", "0"},
                                       {"viscosity", "0"},
                                       {"settle", "30000"},
                                       {"steps", steps},
                                       {"every", samples},
                                       {"thermo", samples},
                                       {"part", "0.5"}});
  const auto &rows = r.thermo;
  const double pe_end = rows.back().at("c_events[5]");
  double kinetic = 0.0, spread = 0.0;
  for (const auto &row : rows)
    if (row.count("c_events[5]")) {
      kinetic = std::max(kinetic, row.at("KinEng"));
      spread = std::max(spread, std::fabs(row.at("c_events[5]") / pe_end - 1.0));
    }
  EXPECT_LT(kinetic, 1e-9 * pe_end);
  EXPECT_LT(spread, 1e-6);
  outcome(steps + " steps of rest without viscosity", "right; PE within " + brief(spread) +
                                                          "; kinetic energy below " +
                                                          brief(kinetic / pe_end) + " of PE");
}

namespace {

/// Single discs of radius 1 and mass 1 in a box that is periodic along x.
std::string single_discs(const std::string &atoms) {
  return fault_start() +
         R"(
neigh_modify      every 1
region            box block 0 10 -6 6 -0.5 0.5
create_box        1 box bond/types 1 extra/bond/per/atom 2 extra/special/per/atom 4
)" + atoms +
         R"(
set               type 1 diameter 2.0
set               type 1 mass 1.0
bond_style        lsm/linked
bond_coeff        1 1.0 1.01
pair_style        lsm/friction
pair_coeff        1 1 1.0 1.0 0.6
timestep          0.05
fix               move all lsm/nve
compute           events all lsm/events overwrite yes catalogue single.csv ledger yes
variable          px equal mass(all)*vcm(all,x)
variable          py equal mass(all)*vcm(all,y)
variable          links equal bonds
thermo_style      custom step ke c_events c_events[5] c_events[9] c_events[10] c_events[11] c_events[12] c_events[13] &
                  v_px v_py v_links
thermo_modify     norm no lost error format float %.17g
)";
}

}  // namespace

TEST_F(Extremes, ContactsThatMayCloseRefuseAStartButNotARunThatGoesOn) {
  // Two discs of mass 1, k = kt = 1: the limit is the square root of 2 once they touch.
  const auto discs = [](const char *distance) {
    return single_discs(std::string("create_atoms 1 single 3 0 0\ncreate_atoms 1 single $(3+") +
                        distance + ":%.17g) 0 0\n") +
           "thermo_style one\nuncompute events\n";
  };
  const std::string start = "timestep 2.0\nrun 0\n",
                    on = "timestep 1.0\nrun 1\ntimestep 2.0\nrun 1\n";
  refused({"Time step 2", "stability limit 1.4"}, discs("2.04") + start);
  const Result went_on = ran(discs("2.04") + on);
  EXPECT_NE(went_on.output.find("nearly closed"), std::string::npos);
  refused({"Time step 2", "stability limit 1.4"}, discs("1.99") + on);
  const Result far = ran(discs("2.2") + on);
  EXPECT_EQ(far.output.find("nearly closed"), std::string::npos);
  // A run from a restart file continues as well.
  const std::string rest = "timestep 1.0\nrun 1\nwrite_restart two.restart\n";
  ran(discs("2.04") + rest);
  const std::string again =
      replaced(discs("2.04"), "region ", "bond_style", "read_restart two.restart\n");
  const Result restarted = ran(again + start);
  EXPECT_NE(restarted.output.find("nearly closed"), std::string::npos);
}

TEST_F(Extremes, NearlyCoincidentDiscs) {
  for (const char *gap : {"1e-3", "1e-10", "0"}) {
    const std::string at = std::string("create_atoms 1 single 5 0 0\ncreate_atoms 1 single $(5+") +
                           gap + ":%.17g) 0 0\n";
    const Result r = ran(single_discs(at) + "thermo 10\nrun 400\n");
    EXPECT_TRUE(finite(r));
    EXPECT_NEAR(r.last("v_px"), 0.0, 1e-13);
    EXPECT_NEAR(r.last("v_py"), 0.0, 1e-13);
    EXPECT_LT(ledger_error(r), 1e-2);
    outcome(std::string("two discs ") + gap + " apart",
            "right; ledger to " + brief(ledger_error(r)) + "; kinetic energy at the end " +
                brief(r.last("KinEng")));
  }
}

TEST_F(Reproducible, LinksAreSummedInTheOrderOfTheirNumbers) {
  // Particles are sorted in memory as they move, and a run from a restart file begins with the
  // order of the file: the forces of many links on a disc, and their energy, have the same digits
  // in any order.
  const std::string script = R"(
variable          sort index 0
units             lj
dimension         2
boundary          f f p
newton            on
atom_style        hybrid bond sphere
atom_modify       map array sort ${sort} 1.5
comm_modify       mode single cutoff 4.5
neighbor          0.4 bin
neigh_modify      delay 0 every 1 check no
special_bonds     lj/coul 0 1 1
lattice           hex $(1/(2*sqrt(3)):%.17g)
region            box block -5 5 -3 3 -0.1 0.1
create_box        1 box bond/types 1 extra/bond/per/atom 6 extra/special/per/atom 6
region            blob block -3 2 -2 1 -0.1 0.1
create_atoms      1 region blob
set               group all diameter 2
set               group all mass 1
bond_style        lsm/linked
bond_coeff        1 1.0
pair_style        lsm/free
pair_coeff        1 1 off
create_bonds      many all all 1 1.99 2.01
velocity          all create 0.01 4711 mom yes rot yes
velocity          all set 0.1 0.1 0 sum yes
fix               move all lsm/nve
compute           events all lsm/events
timestep          0.05
thermo_style      custom step bonds c_events[5]
thermo_modify     norm no format float %.17g
thermo            10
run               300
write_dump        all custom order.${sort} id modify sort off
write_dump        all custom state.${sort} id x y vx vy modify sort id format float %.17g
)";
  std::vector<Result> runs;
  for (const char *sort : {"0", "1"}) {
    runs.push_back(ran(script, {{"sort", sort}}));
  }
  EXPECT_GT(runs[0].last("Bonds"), 80.0);
  EXPECT_FALSE(read_file(path("order.0")) == read_file(path("order.1")));
  EXPECT_TRUE(read_file(path("state.0")) == read_file(path("state.1")));
  ASSERT_EQ(runs[0].thermo.size(), runs[1].thermo.size());
  for (std::size_t n = 0; n < runs[0].thermo.size(); ++n)
    EXPECT_EQ(runs[0].thermo[n].at("c_events[5]"), runs[1].thermo[n].at("c_events[5]")) << n;
}

// Fix lsm/nve sets forces to 0 while it moves the particles; if a fix of another package acts on
// forces, the integrator does so before the interactions. Either way forces are complete when they
// are read, and in later runs.
TEST_F(Reproducible, ForcesAreClearedByEither) {
  const std::string runs = fault_read() + R"(
fix               move blocks lsm/nve viscosity 0.02
fix               plates all lsm/plates lower upper stress 0.006 damping 0.02 velocity 0.005 ramp 3
OTHER
run               300
run               200
write_dump        all custom forces.FILE id x y fx fy fz tqx tqz modify sort id format float %.17g
run               50 pre no
neigh_modify      delay 0 every 1 check no
run               20
unfix             plates
unfix             move
fix               move blocks nve
run               50
write_dump        all custom after.FILE id x y fx fy fz tqx tqz modify sort id format float %.17g
)";
  const auto with = [&](std::string text, const std::string &other, const std::string &file) {
    text = replaced(text, "OTHER", other);
    for (std::size_t at; (at = text.find("FILE")) != std::string::npos;) text.replace(at, 4, file);
    return text;
  };
  for (int ranks : {1, 2}) {
    ran(with(runs, "", "fix"), {}, ranks);
    ran(with(runs, "fix idle blocks addforce 0.0 0.0 0.0", "integrator"), {}, ranks);
    for (const char *name : {"forces", "after"}) {
      const std::string ours = read_file(path(name + std::string(".fix")));
      EXPECT_GT(ours.size(), 1000u);
      EXPECT_TRUE(ours == read_file(path(name + std::string(".integrator"))))
          << name << ", " << ranks << " ranks";
    }
  }
}

TEST_F(Reproducible, PairsThatAreNotLookedAtDoNotTouch) {
  // In a gas of discs, all pairs are examined if the list is built in each step, but only those
  // that may touch soon if lists last longer. nsq lists pairs in the same order each time.
  for (const char *pair : {"lsm/friction", "lsm/friction onset step", "lsm/free"}) {
    const std::string script = R"(
variable          check index yes
units             lj
dimension         2
boundary          f f p
newton            off
atom_style        hybrid bond sphere
atom_modify       map array sort 0 0
neighbor          0.9 nsq
neigh_modify      delay 0 every 1 check ${check}
lattice           sq $(1/2.3^2:%.17g)
region            box block -4 4 -4 4 -0.1 0.1
create_box        1 box
create_atoms      1 box
set               group all diameter 2
set               group all mass 1
pair_style        )" + std::string(pair) +
                               R"(
pair_coeff        1 1 1.0)" + (pair == std::string("lsm/free") ? "" : " 1.0 0.6") +
                               R"(
velocity          all create 0.05 4711 mom yes rot no
fix               walls all wall/reflect xlo EDGE xhi EDGE ylo EDGE yhi EDGE
fix               move all lsm/nve
compute           events all lsm/events
timestep          0.05
thermo_style      custom step ke c_events[7] c_events[8] nbuild
thermo_modify     norm no format float %.17g
thermo            100
run               3000
)";
    std::vector<Result> runs;
    for (const char *check : {"yes", "no"}) {
      runs.push_back(ran(script, {{"check", check}}));
    }
    EXPECT_EQ(runs[1].last("Nbuild"), 3000.0);
    EXPECT_LT(runs[0].last("Nbuild"), 300.0);
    ASSERT_EQ(runs[0].thermo.size(), runs[1].thermo.size());
    int touching = 0;
    for (std::size_t n = 0; n < runs[0].thermo.size(); ++n) {
      for (const char *column : {"KinEng", "c_events[7]", "c_events[8]"})
        EXPECT_EQ(runs[0].thermo[n].at(column), runs[1].thermo[n].at(column))
            << pair << ", " << column << " in row " << n;
      if (runs[0].thermo[n].at("c_events[7]") > 0.0) ++touching;
    }
    EXPECT_GT(touching, 25);
  }
}

// Fix lsm/nve combines the second half kick of a time step with the first one of the next step,
// unless velocities may be read in between.
TEST_F(Reproducible, OnlookersChangeNothingAndSeeWholeSteps) {
  const std::string shear = fault_read() + R"(
fix               move blocks lsm/nve viscosity 0.02
fix               plates all lsm/plates lower upper stress 0.006 damping 0.02 velocity 0.005 ramp 3
compute           events all lsm/events overwrite yes catalogue seen.csv series seen.pe
compute           moving blocks ke
thermo_style      custom step c_moving
thermo_modify     norm no format float %.17g
)";
  for (int ranks : {1, 2}) {
    ran(shear + "thermo 0\nrun 3000\n", {}, ranks);
    const std::string catalogue = read_file(path("seen.csv")), series = read_file(path("seen.pe"));
    EXPECT_GT(unit::read_catalogue(path("seen.csv")).events.size(), 2u);

    const Result each = ran(shear + "thermo 1\nrun 3000\n", {}, ranks);
    ASSERT_EQ(each.thermo.size(), 3001u);
    EXPECT_TRUE(read_file(path("seen.csv")) == catalogue) << ranks << " ranks";
    EXPECT_TRUE(read_file(path("seen.pe")) == series) << ranks << " ranks";

    const std::string onlookers[] = {
        "fix look all ave/time 1 1 1 c_moving file seen.ke format ' %.17g'\n",
        "fix look all ave/time 7 1 7 c_moving file seen.ke format ' %.17g'\n",
        "fix look all print 7 '$(step) $(c_moving:%.17g)' file seen.ke screen no title '# step "
        "ke'\n"};
    for (const std::string &look : onlookers) {
      if (ranks == 2 && &look != onlookers) continue;
      SCOPED_TRACE(std::to_string(ranks) + " ranks, " + look);
      ran(shear + look + "thermo 0\nrun 3000\n", {}, ranks);
      EXPECT_TRUE(read_file(path("seen.csv")) == catalogue);
      EXPECT_TRUE(read_file(path("seen.pe")) == series);

      std::ifstream in(path("seen.ke"));
      std::size_t rows = 0, wrong = 0;
      for (std::string line; std::getline(in, line);) {
        std::size_t step = 0;
        double kinetic = 0.0;
        if (line[0] == '#' || !(std::istringstream(line) >> step >> kinetic)) continue;
        ASSERT_LT(step, each.thermo.size());
        if (kinetic != each.thermo[step].at("c_moving")) ++wrong;
        ++rows;
      }
      EXPECT_EQ(wrong, 0u);
      EXPECT_GT(rows, 400u);
    }
  }
}
