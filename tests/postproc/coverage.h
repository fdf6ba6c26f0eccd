// SPDX-License-Identifier: GPL-2.0-or-later
// How often an interval contains the true value, for the statistical tests.
#ifndef LSM_TESTS_POSTPROC_COVERAGE_H
#define LSM_TESTS_POSTPROC_COVERAGE_H

#include <gtest/gtest.h>

#include <cmath>
#include <string>

// Expects the number of hits to be within 3 standard deviations of trials * probability, as a
// binomial variate is.
inline void expect_binomial(int hits, int trials, double probability, const std::string &what) {
  const double sigma = std::sqrt(trials * probability * (1.0 - probability));
  EXPECT_NEAR(hits, trials * probability, 3.0 * sigma) << what;
}

// Counts how many estimates lie within one and two standard errors of the true value.
class Coverage {
 public:
  explicit Coverage(double truth) : truth_(truth) {}

  void add(double estimate, double standard_error) {
    const double pull = std::fabs(estimate - truth_) / standard_error;
    if (pull <= 1.0) ++one_;
    if (pull <= 1.959963984540054) ++two_;
    ++trials_;
  }

  // Expects the nominal coverage of the intervals of 68.27 % and 95 %.
  void expect(const std::string &what) const {
    expect_binomial(one_, trials_, 0.6826894921370859, what + ", 68 % interval");
    expect_binomial(two_, trials_, 0.95, what + ", 95 % interval");
  }
  int trials() const { return trials_; }
  int within_two() const { return two_; }  // in the interval of 95 %

 private:
  double truth_;
  int one_ = 0, two_ = 0, trials_ = 0;
};

#endif
