// SPDX-License-Identifier: GPL-2.0-or-later
// With LAMMPS as a library: the reader of the keywords of all styles, what it takes and refuses;
// and forces that are found again within a run, as by the package MDI.
#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "exceptions.h"
#include "force.h"
#include "input.h"
#include "integrate.h"
#include "lammps.h"
#include "lsm_keyword_reader.h"
#include "pair.h"
#include "update.h"

namespace {

using LSM::Must;

MPI_Comm world;

/// Reads words as the keywords of a fix.
struct Read {
  double number = 0.0, above = 0.0, least = 0.0, part = 0.0, two = 0.0, second = 0.0, own = 0.0;
  int whole = 0, word = -1;
  std::uint64_t seed = 0;
  bool flag = false;
  std::string name, error;

  explicit Read(std::vector<std::string> words, const std::vector<const char *> &required = {}) {
    std::vector<char *> arg;
    for (std::string &one : words) arg.push_back(one.data());
    const char *options[] = {"lmp", "-log", "none", "-screen", "none"};
    LAMMPS_NS::LAMMPS lammps(5, const_cast<char **>(options), world);
    LAMMPS_NS::LSMKeywordReader in(&lammps, "Fix x", 0, static_cast<int>(arg.size()), arg.data());
    const LSM::Action takes_last{2, [&] { own = in.number(Must::positive); }};
    try {
      in.read_all({{"number", &number},
                   {"above", &above, Must::positive},
                   {"least", &least, Must::not_negative},
                   {"part", &part, Must::fraction},
                   {"two", &two, Must::not_negative, &second},
                   {"whole", &whole, Must::positive},
                   {"seed", &seed},
                   {"flag", &flag},
                   {"name", &name},
                   {"word", LSM::Words{&word, {"a", "b", "c"}}},
                   {"own", takes_last}});
      in.require(required);
    } catch (const LAMMPS_NS::LAMMPSException &e) {
      error = e.what();
    }
  }
};

TEST(Keywords, ValuesGoToTheirPlaces) {
  const Read all({"number", "-1e-3", "above", "2",     "least", "0",    "part",        "0.9",
                  "two",    "1",     "3",     "whole", "7",     "seed", "99999999999", "flag",
                  "on",     "name",  "a b",   "word",  "b",     "own",  "-1",          "5"},
                 {"seed", "name"});
  EXPECT_EQ(all.error, "");
  EXPECT_EQ(all.number, -1e-3);
  EXPECT_EQ(all.above, 2.0);
  EXPECT_EQ(all.least, 0.0);
  EXPECT_EQ(all.part, 0.9);
  EXPECT_EQ(all.two, 1.0);
  EXPECT_EQ(all.second, 3.0);
  EXPECT_EQ(all.whole, 7);
  EXPECT_EQ(all.seed, 99999999999U);
  EXPECT_TRUE(all.flag);
  EXPECT_EQ(all.name, "a b");
  EXPECT_EQ(all.word, 1);
  EXPECT_EQ(all.own, 5.0);
  EXPECT_EQ(Read({"number", "1", "number", "2"}).number, 2.0) << "the last one counts";
}

TEST(Keywords, WhatIsWrongIsNamed) {
  struct Case {
    std::vector<std::string> words;
    const char *error;
  };
  const Case cases[] = {
      {{"number"}, "fix x number (a value) command: missing argument"},
      {{"number", "thick"}, "Fix x number is thick, but must be a number"},
      {{"number", ""}, "Fix x number is , but must be a number"},
      {{"above", "0"}, "Fix x above is 0, but must be > 0"},
      {{"least", "-1"}, "Fix x least is -1, but must be >= 0"},
      {{"part", "1"}, "Fix x part is 1, but must be at least 0 and less than 1"},
      {{"part", "-0.1"}, "Fix x part is -0.1, but must be at least 0 and less than 1"},
      {{"two", "1"}, "fix x two (2 values) command: missing argument"},
      {{"two", "-1", "1"}, "Fix x two value 1 is -1, but must be >= 0"},
      {{"two", "1", "-1"}, "Fix x two value 2 is -1, but must be >= 0"},
      {{"whole", "0"}, "Fix x whole is 0, but must be a whole number of at least 1"},
      {{"whole", "1.5"}, "Fix x whole is 1.5, but must be a whole number of at least 1"},
      {{"whole", "3e9"}, "Fix x whole is 3e9, but must be a whole number of at least 1"},
      {{"seed", "-1"}, "Fix x seed is -1, but must be a whole number of at least 0"},
      {{"seed", "1.5"}, "Fix x seed is 1.5, but must be a whole number of at least 0"},
      {{"flag", "perhaps"}, "Fix x flag is 'perhaps', but must be yes or no"},
      {{"word", "d"}, "Fix x word is 'd', but must be a, b or c"},
      {{"own", "1"}, "fix x own (2 values) command: missing argument"},
      {{"own", "1", "0"}, "Fix x own value 2 is 0, but must be > 0"},
      {{"number", "1", "nunber", "1"},
       "Unknown fix x keyword 'nunber'; accepted are number, above, least, part, two, whole, seed, "
       "flag, name, word, own"}};
  const auto refused = [](const Read &read, const std::string &error) {
    EXPECT_NE(read.error.find(error), std::string::npos) << read.error;
  };
  for (const Case &one : cases) refused(Read(one.words), one.error);
  refused(Read({"number", "1"}, {"number", "seed"}),
          "Fix x seed is missing; needed are number and seed");
}

// A disc flies through a lane between discs at rest, which are added to its lists.
TEST(ForcesAgain, UseTheListsThatWereAddedTo) {
  const char *options[] = {"lmp", "-log", "none", "-screen", "none"};
  LAMMPS_NS::LAMMPS lammps(5, const_cast<char **>(options), world);
  for (const char *command : {"dimension 2",
                              "boundary p f p",
                              "newton off",
                              "atom_style hybrid bond sphere",
                              "atom_modify map array",
                              "neighbor 0.4 bin",
                              "neigh_modify delay 0 every 1 check yes",
                              "comm_modify mode single cutoff 7",
                              "processors * 1 1",
                              "lattice hex 0.2385 origin 0 0.25 0",
                              "region box block 0 24 0 10 -0.5 0.5",
                              "create_box 2 box bond/types 1",
                              "region lane block INF INF 4.9 5.1 INF INF",
                              "region rows intersect 2 box lane side out",
                              "create_atoms 1 region rows",
                              "create_atoms 2 single 6.71 19.13 0 units box",
                              "set group all diameter 2.0",
                              "set group all mass 1.0",
                              "pair_style lsm/free",
                              "pair_coeff * * 1.0",
                              "group thrown type 2",
                              "velocity thrown set 0.9 0.1 0",
                              "timestep 0.01",
                              "fix move thrown lsm/nve"})
    lammps.input->one(command);
  double most = 0.0;
  for (int n = 0; n < 20; ++n) {
    lammps.input->one("run 50 pre no post no");
    const double energy = lammps.force->pair->eng_vdwl;
    for (int again = 0; again < 2; ++again) lammps.update->integrate->setup_minimal(0);
    EXPECT_NEAR(lammps.force->pair->eng_vdwl, energy, 1e-12) << n;
    most = std::max(most, energy);
  }
  EXPECT_GT(most, 1e-3) << "the disc has to touch others";
}

}  // namespace

int main(int argc, char **argv) {
  testing::InitGoogleTest(&argc, argv);
  MPI_Init(&argc, &argv);
  world = MPI_COMM_WORLD;
  const int failed = RUN_ALL_TESTS();
  MPI_Finalize();
  return failed;
}
