// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "numerics/sum.h"

namespace {

TEST(NeumaierSum, KeepsWhatLargeTermsSwallow) {
  // Kahan's sum gives 0 here.
  LSM::NeumaierSum sum;
  for (double term : {1.0, 1e100, 1.0, -1e100}) sum.add(term);
  EXPECT_EQ(sum.value(), 2.0);
}

TEST(NeumaierSum, LoadingAndDropsOfASmallPartOfTheEnergy) {
  // 1e6 changes of 1e-9 up and down on 1e4 must cancel to the last digit.
  LSM::NeumaierSum sum(1e4);
  for (int i = 0; i < 1000000; ++i) sum.add(i % 2 ? -1e-9 : 1e-9);
  EXPECT_EQ(sum.value(), 1e4);
  sum.add(1e-9);
  sum.add(-1e4);
  EXPECT_EQ(sum.value(), 1e-9);
}

TEST(NeumaierSum, RestartsExactly) {
  LSM::NeumaierSum sum;
  for (int i = 1; i < 1000; ++i) sum.add(1.0 / i);
  LSM::NeumaierSum restored(sum.sum(), sum.compensation());
  for (int i = 1000; i < 2000; ++i) {
    sum.add(1.0 / i);
    restored.add(1.0 / i);
  }
  EXPECT_EQ(restored.sum(), sum.sum());
  EXPECT_EQ(restored.compensation(), sum.compensation());
}

TEST(NeumaierSum, NotFiniteTermsShow) {
  const double infinity = std::numeric_limits<double>::infinity();
  LSM::NeumaierSum sum;
  EXPECT_EQ(sum.value(), 0.0);
  sum.add(1.0);
  sum.add(infinity);
  EXPECT_EQ(sum.value(), infinity);
  sum.add(1.0);
  EXPECT_EQ(sum.value(), infinity);
  sum.add(-infinity);
  EXPECT_TRUE(std::isnan(sum.value()));
}

TEST(SumPairwise, AnyLengthAddsEachTermOnce) {
  std::vector<double> values;
  double expected = 0.0;
  EXPECT_EQ(LSM::sum_pairwise(values.data(), 0), 0.0);
  for (int i = 1; i <= 300; ++i) {
    values.push_back(static_cast<double>(i * i));
    expected += i * i;
    ASSERT_EQ(LSM::sum_pairwise(values.data(), values.size()), expected) << i;
  }
}

TEST(SumPairwise, ErrorGrowsWithTheLogarithmOfTheLength) {
  const std::vector<double> values(std::size_t(1) << 20, 0.1);
  const double exact = 0.1 * static_cast<double>(values.size());  // exact: a power of two
  double plain = 0.0;
  for (double value : values) plain += value;
  // The error is half an ulp for each of 32 additions in the innermost loop and of 15 halvings.
  const double bound = (32 + 15) * 0.5 * std::numeric_limits<double>::epsilon() * exact;
  EXPECT_LE(std::fabs(LSM::sum_pairwise(values.data(), values.size()) - exact), bound);
  EXPECT_GT(std::fabs(plain - exact), bound);
}

}  // namespace
