// SPDX-License-Identifier: GPL-2.0-or-later
#include "magnitudes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "coverage.h"
#include "numerics/random.h"

using namespace LSM::postproc;

namespace {

const double ln10 = std::log(10.0);

/// Magnitudes above the completeness that follow the Gutenberg-Richter law.
std::vector<double> gutenberg_richter(double b, double completeness, int n, std::uint64_t seed) {
  LSM::Random random(seed);
  std::vector<double> out;
  for (int i = 0; i < n; ++i)
    out.push_back(completeness - std::log10(1.0 - random.uniform(0.0, 1.0)) / b);
  return out;
}

// The first 100 magnitudes of the first column of simulated_magnitudes.csv in the tests of
// SeismoStats (Swiss Seismological Service, 2025), to 6 decimals.
const std::vector<double> published = {
    -0.004056, -0.225414, 0.024663,  0.369362,  -0.155318, -0.162744, -0.159219, -0.124840,
    -0.157675, 0.116724,  0.063539,  -0.125563, 0.543107,  -0.216353, 0.560792,  -0.017805,
    0.881001,  0.140280,  0.781248,  0.040690,  -0.113408, -0.027858, -0.168285, -0.159762,
    0.802735,  0.098666,  0.508835,  0.195588,  -0.105816, -0.014058, -0.203084, -0.215910,
    0.106744,  -0.140871, 0.060249,  -0.009696, -0.154738, -0.058942, -0.242185, 0.207318,
    -0.167191, -0.101008, 0.518626,  0.074469,  -0.002204, -0.199668, -0.023874, 0.061535,
    -0.228070, -0.051022, -0.234200, -0.123478, -0.153368, 0.004495,  -0.084110, -0.222719,
    2.406523,  0.383782,  0.295185,  -0.243677, 0.567403,  0.464037,  0.509633,  -0.089360,
    0.228934,  -0.033933, 0.248206,  -0.227249, -0.162541, -0.007622, 0.935064,  0.468009,
    0.627432,  0.331659,  -0.060851, 0.569551,  0.438892,  -0.165339, 0.653683,  -0.200071,
    0.189269,  -0.217855, 0.516056,  0.317887,  -0.160481, 0.028968,  0.215581,  2.033461,
    -0.220661, 0.521036,  0.524800,  -0.082554, 0.135383,  0.550492,  0.077868,  -0.207885,
    0.203427,  -0.088574, 0.081362,  0.576132};

TEST(Magnitudes, OfSizes) {
  EXPECT_DOUBLE_EQ(magnitude_of_size(1000.0), 2.0);
  EXPECT_DOUBLE_EQ(MagnitudeBins{0.1}.binned(0.249), 0.2);
  EXPECT_DOUBLE_EQ(MagnitudeBins{0.5}.binned(0.25), 0.5);
  EXPECT_DOUBLE_EQ(MagnitudeBins{0.5}.binned(-0.25), 0.0);
  EXPECT_EQ(MagnitudeBins{0.0}.binned(0.123), 0.123);
}

// A half is a half, whatever the binary approximations of its decimals.
TEST(Magnitudes, HalvesGoUp) {
  for (int hundredths = -300; hundredths <= 900; ++hundredths) {
    const double m = hundredths / 100.0;
    const auto nearest = [hundredths](int width) {
      int bin = (2 * hundredths + width) / (2 * width);
      if ((2 * hundredths + width) % (2 * width) < 0) --bin;
      return bin * width / 100.0;
    };
    EXPECT_EQ(MagnitudeBins{0.1}.binned(m), nearest(10)) << m;
    EXPECT_EQ(MagnitudeBins{0.2}.binned(m), nearest(20)) << m;
    EXPECT_EQ(MagnitudeBins{0.01}.binned(m), m);
  }
}

// Of single precision, decimals of up to three places are left; others are as they are.
TEST(Magnitudes, AreAsTheyWereTyped) {
  for (int k = -3000; k < 10000; ++k) {
    const double m = k / 1000.0;
    EXPECT_EQ(as_typed(static_cast<double>(static_cast<float>(m))), m);
    EXPECT_EQ(as_typed(m), m);
  }
  EXPECT_EQ(as_typed(2.3456789), 2.3456789);
  EXPECT_EQ(as_typed(2.30001), 2.30001);
}

TEST(Magnitudes, BinsBeginWhereALimitLeavesThem) {
  const MagnitudeBins bins{0.1, 0.05};
  EXPECT_EQ(bins.first_from(4.05), 4.05);
  EXPECT_EQ(bins.first_from(4.06), 4.15);
  EXPECT_EQ(bins.first_from(-4.06), -4.05);
  EXPECT_EQ(bins.binned(4.1), 4.15);
  EXPECT_EQ(bins.binned(4.0999), 4.05);
  EXPECT_EQ(maximum_curvature({4.05, 4.15, 4.15, 4.25}, bins), 4.35);
  EXPECT_EQ(magnitude_counts({4.05, 4.15, 4.15, 4.35}, bins).back().magnitude, 4.35);
}

TEST(Magnitudes, SizesKeepTheirOrder) {
  for (int k = -1000; k < 10000; ++k) {
    const double m = k / 1000.0;
    EXPECT_LT(size_of_magnitude(m), size_of_magnitude((k + 1) / 1000.0));
    EXPECT_TRUE(reaches(magnitude_of_size(size_of_magnitude(m)), m));
    EXPECT_FALSE(reaches(magnitude_of_size(size_of_magnitude(m)), (k + 1) / 1000.0));
    EXPECT_EQ(nearest_decimal(magnitude_of_size(size_of_magnitude(m))), m);
  }
}

TEST(Magnitudes, BinsAreRecognized) {
  const std::vector<double> all = gutenberg_richter(1.0, 2.0, 5000, 5);
  const auto in_bins = [&all](double width, std::size_t n) {
    std::vector<double> out(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n));
    for (double &m : out) m = MagnitudeBins{width}.binned(m);
    return out;
  };
  for (const double width : {0.001, 0.01, 0.02, 0.1, 0.2, 0.5, 1.0})
    for (const std::size_t n : {20u, 100u, 5000u}) {
      const MagnitudeBins found = recognized_bins(in_bins(width, n));
      EXPECT_EQ(found.width, width) << n;
      EXPECT_EQ(found.share, 1.0);
    }
  EXPECT_EQ(recognized_bins(all).width, 0.0);
  EXPECT_EQ(recognized_bins({}).width, 0.0);
  // Few magnitudes may be multiples of 0.2 or 1 by chance.
  EXPECT_EQ(recognized_bins(in_bins(1.0, 19)).width, 0.1);
  EXPECT_EQ(recognized_bins({2.0}).width, 0.1);
  EXPECT_EQ(recognized_bins({2.0, 2.31}).width, 0.01);
  // Where practice changed, coarser bins are named. One in ten is a multiple of 0.1 by chance.
  for (const double share : {0.02, 0.1, 0.4, 0.9, 0.99}) {
    std::vector<double> mixed = in_bins(0.01, 5000);
    for (std::size_t i = 0; i < mixed.size(); ++i)
      if (static_cast<double>(i) < share * 5000.0) mixed[i] = MagnitudeBins{0.1}.binned(mixed[i]);
    const MagnitudeBins found = recognized_bins(mixed);
    const double multiples = share + 0.1 * (1.0 - share);
    EXPECT_EQ(found.width, share > 0.95 ? 0.1 : 0.01) << share;
    EXPECT_NEAR(found.share, share > 0.95 ? multiples : 1.0, 0.02);
    EXPECT_EQ(found.wider, share > 0.3 && share < 0.95 ? 0.1 : 0.0) << share;
    if (found.wider > 0.0) {
      EXPECT_NEAR(found.share_of_wider, multiples, 0.02);
    }
  }
  // Any step and offset, with the last of a share of 95 % off them.
  for (const std::size_t n : {60u, 5000u})
    for (const double width : {0.015, 0.03, 0.05, 0.125, 0.1, 0.15, 0.25, 0.3, 0.4, 0.5})
      for (const double offset : {0.0, 0.2 * width, 0.5 * width}) {
        std::vector<double> some = in_bins(0.0, n);
        for (double &m : some) m = MagnitudeBins{width, offset}.binned(m);
        for (const std::size_t off : {std::size_t{0}, n / 25}) {
          for (std::size_t i = 0; i < off; ++i)
            some[i * 25] = 2.0 + 0.1 * static_cast<double>(i % 7);
          const MagnitudeBins found = recognized_bins(some);
          EXPECT_NEAR(found.width, width, 1e-12) << n << " " << offset << " " << off;
          EXPECT_NEAR(found.offset, offset, 1e-12) << n << " " << width << " " << off;
          EXPECT_EQ(found.wider, 0.0) << n << " " << width << " " << offset;
        }
      }
  // Magnitudes of a narrow range are no bins of their own.
  std::vector<double> narrow(960, 2.0);
  narrow.insert(narrow.end(), {2.1, 2.1, 2.2, 2.3, 2.5, 2.7});
  EXPECT_EQ(recognized_bins(narrow).width, 0.1);
  EXPECT_EQ(recognized_bins(std::vector<double>(30, 2.3)).width, 0.1);
  narrow.assign(30, 2.3);
  narrow.insert(narrow.end(), 5, 2.7);
  EXPECT_EQ(recognized_bins(narrow).width, 0.1);
  // Numbers in single precision.
  std::vector<double> floats = in_bins(0.1, 200);
  for (double &m : floats) m = static_cast<double>(static_cast<float>(m));
  EXPECT_EQ(recognized_bins(floats).width, 0.1);
}

TEST(BValue, ErrorIsThatPublishedWithSeismoStats) {
  ASSERT_EQ(published.size(), 100u);
  const BValue result = b_value(published, -0.25);
  ASSERT_FALSE(result.degenerate);
  // The value published for these magnitudes with b = 1.
  EXPECT_NEAR(result.error / (result.b * result.b), 0.09776728958456313, 1e-6);
}

TEST(BValue, ErrorCoversTheTruth) {
  for (const double b : {0.1, 1.0, 1.5})
    for (const double width : {0.0, 0.1}) {
      Coverage coverage(b);
      for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        // Bins centred at multiples of width include values within half a bin.
        std::vector<double> magnitudes = gutenberg_richter(b, 2.0 - 0.5 * width, 300, seed);
        for (double &m : magnitudes) m = MagnitudeBins{width}.binned(m);
        const BValue result = b_value(magnitudes, 2.0, width);
        ASSERT_EQ(result.n, 300);
        coverage.add(result.b, result.error);
      }
      coverage.expect("b = " + std::to_string(b) + ", bins of " + std::to_string(width));
    }
}

TEST(BValue, PositiveDifferencesHaveTheSame) {
  Coverage coverage(1.0);
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    std::vector<double> magnitudes = gutenberg_richter(1.0, -0.05, 600, seed);
    for (double &m : magnitudes) m = MagnitudeBins{0.1}.binned(m);
    const BValue result = b_positive(magnitudes, 0.0, 0.1);
    ASSERT_GT(result.n, 200);
    coverage.add(result.b, result.error);
  }
  coverage.expect("b-positive");
}

TEST(BValue, PositiveDifferencesForgiveWhatIsMissedAfterLargeEvents) {
  // An event of magnitude m hides later ones below m - 1; this limit decreases from event to event.
  std::vector<double> seen;
  double hidden = -1.0;
  for (const double m : gutenberg_richter(1.0, 0.0, 200000, 7)) {
    hidden -= 0.05;
    if (m < hidden) continue;
    seen.push_back(m);
    hidden = std::max(hidden, m - 1.0);
  }
  ASSERT_LT(seen.size(), 180000u);
  const BValue classic = b_value(seen, 0.0), positive = b_positive(seen, 0.0);
  EXPECT_LT(classic.b, 0.9);
  EXPECT_NEAR(positive.b, 1.0, 4.0 * positive.error);
  EXPECT_LT(positive.error, 0.01);
}

TEST(BValue, FewOrEqualMagnitudesAreDegenerate) {
  const BValue none = b_value({}, 0.0), few = b_value(std::vector<double>(9, 1.0), 0.0),
               equal = b_value(std::vector<double>(50, 1.0), 0.0);
  for (const BValue &result : {none, few, equal}) {
    EXPECT_TRUE(result.degenerate);
    EXPECT_TRUE(std::isnan(result.b) && std::isnan(result.error));
  }
  EXPECT_EQ(few.why, "9 magnitudes, at least 10 needed");
  EXPECT_EQ(equal.why, "all magnitudes are equal");
}

TEST(MaximumCurvature, IsWhereTheCatalogueBeginsToMissEvents) {
  // Events are detected with a probability that rises from 0 to 1 between 0.4 and 1.
  LSM::Random random(3);
  std::vector<double> seen;
  for (const double m : gutenberg_richter(1.0, 0.0, 100000, 11))
    if (random.uniform(0.0, 1.0) < (m - 0.4) / 0.6) seen.push_back(m);
  EXPECT_NEAR(maximum_curvature(seen, {0.1}), 1.0, 0.11);
  EXPECT_NEAR(b_value(seen, maximum_curvature(seen, {0.1})).b, 1.0, 0.05);
  EXPECT_TRUE(std::isnan(maximum_curvature({}, {0.1})));
  // Of two equal maxima the lower magnitude counts.
  EXPECT_DOUBLE_EQ(maximum_curvature({1.0, 1.0, 2.0, 2.0, 3.0}, {0.5}), 1.2);
}

}  // namespace
