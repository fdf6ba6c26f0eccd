// SPDX-License-Identifier: GPL-2.0-or-later
// What our programs write into headers is in the table of keys. Those of slider and postproc are
// compared with it by tests/slider/test_slider_cli.py and tests/postproc/test_postproc_cli.py.
#include "files/header_keys.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "events/event_headers.h"

namespace {

using LSM::bad_value;
using LSM::header_key;

TEST(HeaderKeys, EachStandsOnce) {
  std::set<std::string_view> keys;
  for (const LSM::HeaderKey &one : LSM::header_keys())
    EXPECT_TRUE(keys.insert(one.key).second) << one.key;
  EXPECT_GT(keys.size(), 50u);
}

TEST(HeaderKeys, NumberedKeysAreThoseOfTheFirst) {
  ASSERT_NE(header_key("viscosity_2"), nullptr);
  EXPECT_EQ(header_key("viscosity_2"), header_key("viscosity"));
  EXPECT_EQ(header_key("step0")->key, "step0");
  EXPECT_EQ(header_key("something"), nullptr);
  EXPECT_EQ(header_key("2"), nullptr);
}

TEST(HeaderKeys, ValuesOutOfRangeAreNamed) {
  const auto bad = [](const std::string &key, const std::vector<const char *> &values,
                      const std::vector<const char *> &good) {
    for (const std::string value : values)
      EXPECT_EQ(bad_value(key, value).find(key + " is '" + value + "', expected "), 0u) << key;
    for (const char *value : good) EXPECT_EQ(bad_value(key, value), "") << key;
  };
  bad("completeness", {"-1", "inf"}, {"0"});
  bad("min_size", {"x"}, {});
  bad("lambda", {"1"}, {"0"});
  bad("warmup", {"nan"}, {"-5"});
  bad("length", {"0"}, {});
  bad("length_2", {}, {"none"});
  bad("dt", {"0"}, {});
  bad("blocks", {"0", "16.5"}, {});
  bad("seed", {"one"}, {});
  bad("stride", {"1.5"}, {});
  bad("checkpoint", {}, {"1e5"});
  bad("velocity", {"0.02-0.05"}, {"-0.5"});
  bad("modulus", {"inf"}, {});
  bad("picker", {"best"}, {"literal"});
  bad("keep_nonpositive", {"perhaps"}, {"no"});
  bad("something", {}, {"else"});
}

void expect_known(const LSM::files::Parameters &header) {
  EXPECT_GT(header.size(), 8u);
  for (const auto &one : header) EXPECT_NE(header_key(one.first), nullptr) << one.first;
}

TEST(HeaderKeys, HaveWhatAFaultWrites) {
  LSM::EventSettings settings;
  settings.ruptures_file = "r.csv";
  settings.no_series = settings.no_history = settings.explicit_times = true;
  LSM::SceneInfo scene;
  for (const char *key : {"program", "particles", "links", "length", "dt", "viscosity",
                          "viscosity_2", "kelvin_voigt", "leap"})
    scene.parameters.emplace_back(key, "1");
  LSM::FaultGrid grid;
  grid.ring = false;
  grid.plane = true;
  expect_known(LSM::drops_header(settings, scene, grid).header());
  expect_known(LSM::ruptures_header(settings, scene, grid).header());
  expect_known(LSM::series_header(settings, scene, {0.0, 0, 1.0}).header());
  expect_known(LSM::history_header(settings, scene, grid).header());
}

}  // namespace
