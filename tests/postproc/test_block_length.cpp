// SPDX-License-Identifier: GPL-2.0-or-later
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "block_length.h"
#include "numerics/random.h"

namespace {

using namespace LSM::postproc;

TEST(BlockLength, OfAnAutoregressiveSeries) {
  // x_i = rho x_(i-1) + noise has the covariances rho^|k|, from which the best length follows.
  const std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> rng(gsl_rng_alloc(gsl_rng_mt19937),
                                                              gsl_rng_free);
  const std::size_t n = 8000;
  for (const double rho : {0.0, 0.6, 0.9}) {
    double mean = 0.0;
    for (int i = 0; i < 40; ++i) {
      std::vector<double> x(n);
      double last = gsl_ran_gaussian(rng.get(), 1.0 / std::sqrt(1.0 - rho * rho));
      for (double &x_i : x) x_i = last = rho * last + gsl_ran_gaussian(rng.get(), 1.0);
      mean += block_length(x) / 40.0;
    }
    const double best =
        std::cbrt(1.5 * std::pow(2.0 * rho / (1.0 - rho * rho), 2) * static_cast<double>(n));
    EXPECT_NEAR(mean / std::max(best, 20.0), 1.0, 0.1) << rho;  // 20 is the cube root of n
  }
  EXPECT_EQ(block_length(std::vector<double>(10, 0.0)), 1.0);
  EXPECT_EQ(block_length(std::vector<double>(1000, 0.0)), 10.0);
}

TEST(BlockLength, OfASeriesWhoseCorrelationEnds) {
  // Sums of five successive numbers are correlated up to lag 4. The same rule (Politis & White
  // 2004), written out for this case: lags up to 4 count in full, 5 to 7 less and less, 8 not at
  // all.
  LSM::Random random(7);
  const std::size_t n = 4000;
  std::vector<double> noise(n + 4), x(n, 0.0);
  for (double &e : noise) e = random.uniform() - 0.5;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 5; ++k) x[i] += noise[i + k];
  std::vector<double> r(10, 0.0);
  for (std::size_t lag = 0; lag < r.size(); ++lag)
    for (std::size_t i = 0; i + lag < n; ++i) r[lag] += x[i] * x[i + lag] / static_cast<double>(n);
  const double noticed = 2.0 * std::sqrt(std::log10(4000.0) / 4000.0) * r[0];
  EXPECT_GT(r[4], noticed);
  for (std::size_t lag = 5; lag < r.size(); ++lag) EXPECT_LT(std::fabs(r[lag]), noticed) << lag;
  const double full = r[1] + r[2] + r[3] + r[4] + 0.75 * r[5] + 0.5 * r[6] + 0.25 * r[7];
  const double moment =
      r[1] + 2.0 * r[2] + 3.0 * r[3] + 4.0 * r[4] + 3.75 * r[5] + 3.0 * r[6] + 1.75 * r[7];
  const double ratio = 2.0 * moment / (r[0] + 2.0 * full);
  EXPECT_NEAR(block_length(x), std::cbrt(1.5 * ratio * ratio * 4000.0), 1e-9);
}

}  // namespace
