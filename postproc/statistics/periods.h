// SPDX-License-Identifier: GPL-2.0-or-later
/// \file periods.h
/// Does a fault repeat itself? Periods in the times of events, with their energy as weights, and
/// energy released at equal times in two catalogues †. A period in the slip of the plates is
/// one of the fault's own geometry: it goes when that is random.
///
/// Source: Rayleigh's test of directions, as in Mardia & Jupp 2000, Directional Statistics, Wiley.
#ifndef LSM_POSTPROC_PERIODS_H
#define LSM_POSTPROC_PERIODS_H

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "samples.h"

namespace LSM::postproc {

/// Events at times t with weights w against one period.
struct PeriodTest {
  double period = NAN;
  /// Rayleigh's Z = |sum w exp(2 pi i t / period)|^2 / sum w^2. Random phases: 1 on average.
  double z = NAN;
  double phase = NAN;  ///< where in the period most of the weight lies, 0 to 1
  /// Probability of a Z as large with random phases, by random ones for these weights.
  Measured p;
  /// Weight in each tenth of the period over its mean.
  std::array<double, 10> tenths{};
};

/// (sum w)^2 / sum w^2: as many events of equal weight would scatter as much.
double effective_number(const std::vector<double> &weights);

double rayleigh_z(const std::vector<double> &times, const std::vector<double> &weights,
                  double period);

/// \param replicas random phases, at least 1
/// \throws std::invalid_argument for a period that is not positive, or fewer than 10 events
PeriodTest test_period(const std::vector<double> &times, const std::vector<double> &weights,
                       double period, int replicas, std::uint64_t seed);

/// Z at the periods between two that fit a whole number of times into the time from the first event
/// to the last: random phases make them independent.
struct PeriodScan {
  std::vector<double> periods, z;
  /// Z that the largest of so many exceeds by chance in 5 % of all scans of many equal weights.
  double by_chance = NAN;
};
PeriodScan scan_periods(const std::vector<double> &times, const std::vector<double> &weights,
                        double shortest, double longest);

/// Do two catalogues release energy at the same times?
struct Coincidence {
  double correlation = NAN;  ///< of the energy in bins of time
  /// Share of shifts of one against the other in a ring, by random numbers of bins, whose
  /// correlation is as large.
  Measured p;
  std::int64_t bins = 0;
};
/// \throws std::invalid_argument unless both have at least 20 bins in common
Coincidence coincidence(const std::vector<double> &first_times,
                        const std::vector<double> &first_weights,
                        const std::vector<double> &second_times,
                        const std::vector<double> &second_weights, double bin, int replicas,
                        std::uint64_t seed);

}  // namespace LSM::postproc

#endif
