// SPDX-License-Identifier: GPL-2.0-or-later
/// \file periods.h
/// Whether a fault repeats itself: periods in the times of events, weighted with their energy, and
/// energy released at the same times in two catalogues †. A period in terms of the slip of the
/// plates stems from the geometry of the fault and disappears if that is random.
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

/// Test of events at times t with weights w for one period.
struct PeriodTest {
  double period = NAN;
  /// Rayleigh's Z = |sum w exp(2 pi i t / period)|^2 / sum w^2; 1 on average for random phases.
  double z = NAN;
  double phase = NAN;  ///< phase at which most of the weight lies, 0 to 1
  /// Probability of as large a Z with random phases and these weights, by Monte Carlo.
  Measured p;
  /// Weight in each tenth of the period, over the mean of the tenths.
  std::array<double, 10> tenths{};
};

/// Effective number of events, (sum w)^2 / sum w^2: as many events of equal weight scatter as much.
double effective_number(const std::vector<double> &weights);

/// Rayleigh's Z, see PeriodTest::z.
double rayleigh_z(const std::vector<double> &times, const std::vector<double> &weights,
                  double period);

/// Tests for one period.
/// \param replicas number of sets of random phases, at least 1
/// \throws std::invalid_argument for a period that is not positive, or fewer than 10 events
PeriodTest test_period(const std::vector<double> &times, const std::vector<double> &weights,
                       double period, int replicas, std::uint64_t seed);

/// Z at all periods between two limits that fit a whole number of times into the time from the
/// first to the last event, for which values with random phases are independent.
struct PeriodScan {
  std::vector<double> periods, z;
  /// The largest Z of so many periods exceeds this by chance in 5 % of all scans (for many equal
  /// weights).
  double by_chance = NAN;
};
/// Scans the periods from shortest to longest.
/// \throws std::invalid_argument unless shortest is positive and there are at least 10 events
PeriodScan scan_periods(const std::vector<double> &times, const std::vector<double> &weights,
                        double shortest, double longest);

/// Whether two catalogues release energy at the same times.
struct Coincidence {
  double correlation = NAN;  ///< correlation of the energies in bins of time
  /// Share of cyclic shifts of one series against the other, by random numbers of bins, with as
  /// large a correlation.
  Measured p;
  std::int64_t bins = 0;
};
/// Correlates the energy released in two catalogues.
/// \param bin width of the bins of time, > 0
/// \param replicas number of random shifts
/// \throws std::invalid_argument if a catalogue has no events, or unless they have at least 20 bins
/// in common
Coincidence coincidence(const std::vector<double> &first_times,
                        const std::vector<double> &first_weights,
                        const std::vector<double> &second_times,
                        const std::vector<double> &second_weights, double bin, int replicas,
                        std::uint64_t seed);

}  // namespace LSM::postproc

#endif
