// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "numerics/random.h"
#include "unit_files.h"

namespace {

// The C++ standard prescribes the 10000th value of the default seed; the first two, below, are
// those of the authors' mt19937-64.c seeded by init_genrand64(5489).
constexpr std::uint64_t default_seed = 5489;

TEST(Random, TenThousandthValueOfTheDefaultSeed) {
  LSM::Random random(default_seed);
  for (int i = 1; i < 10000; ++i) random.next();
  EXPECT_EQ(random.next(), 9981545732273789042ULL);
}

TEST(Random, UniformTakesTheUpper53Bits) {
  LSM::Random random(default_seed);
  EXPECT_EQ(random.uniform(), std::ldexp(static_cast<double>(14514284786278117030ULL >> 11), -53));
  EXPECT_EQ(random.uniform(2.0, 4.0),
            2.0 + 2.0 * std::ldexp(static_cast<double>(4620546740167642908ULL >> 11), -53));
}

TEST(Random, UpperEndIsNeverReachedByRounding) {
  // The closed interval has only two doubles: half of the products round up to the excluded end.
  const double hi = std::nextafter(1.0, 2.0);
  LSM::Random random(3);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(random.uniform(1.0, hi), 1.0);
  EXPECT_EQ(random.uniform(2.0, 2.0), 2.0);
}

}  // namespace
