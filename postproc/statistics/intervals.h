// SPDX-License-Identifier: GPL-2.0-or-later
/// \file intervals.h
/// Inter-event times, their densities and fits of generalised gamma densities (paper: Sect. 4.3).
#ifndef LSM_POSTPROC_INTERVALS_H
#define LSM_POSTPROC_INTERVALS_H

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clustering.h"
#include "event_table.h"
#include "generalised_gamma.h"
#include "log_histogram.h"
#include "samples.h"

namespace LSM::postproc {

/// What interval_curves() computes.
struct IntervalSettings {
  /// Smallest sizes (model energy), one curve each; empty: Threshold().
  std::vector<double> thresholds;
  bool rescale = false;            ///< divide the times by their mean
  std::optional<double> shortest;  ///< see shortest_time()
  bool least_squares = true, maximum_likelihood = true;
  int replicas = 1000;  ///< for the Monte Carlo p-values of maximum likelihood; 0: none
  std::uint64_t seed = 1;
  /// Number of random series for clustering() and steadiness(); 0: these are left out; negative:
  /// shuffles_for().
  int shuffles = 0;
  std::vector<double> deltas = {1.0, NAN};  ///< values at which delta is held; NaN: free
};

/// Number of random series for so many times: 200, and fewer for more than 1e5 times, as statistics
/// of longer series scatter less (2e7 times in all, but at least 19 series, so that p can be 0.05).
int shuffles_for(std::size_t times);

/// Shortest time that maximum likelihood uses: a given multiple of the mean or, if none is given,
/// the shortest one that carries information about the fault †. Least squares uses it only if it is
/// given, and all times otherwise, as in the paper. A picker with a memory merges events
/// that are closer than that: of series with gamma from 0.7 to 1 and a dead time of one memory, the
/// times above 2.5 memories recover gamma, whereas all times overestimate it by 0.1 to 0.4 (a test
/// has these series). Times below 0.05 of the mean lie within sequences, where earthquake
/// catalogues are incomplete.
/// \param given multiple of the mean
/// \param memory memory of the picker; NaN: none
/// \param mean mean inter-event time in the same unit
inline double shortest_time(std::optional<double> given, double memory, double mean) {
  return given ? *given * mean : std::fmax(2.5 * memory, 0.05 * mean);
}

/// One fit to the inter-event times of a curve.
struct IntervalFit {
  std::string method;  ///< "least squares" or "maximum likelihood"
  double held = 0.0;   ///< value at which delta was held; NaN: free
  GeneralisedGammaFit fit;
  /// p_value() of the fit, NaN for a degenerate fit or without replicas. The error is that of the
  /// Monte Carlo estimate, NaN for least squares, which needs none.
  Measured p = {};

  bool rejected() const { return p.value < 0.05; }
};

/// Describes the events used: "sizes >= 0.001", or "magnitudes >= 2" for earthquakes.
std::string events_from_text(bool earthquakes, double least);

/// Inter-event times of one catalogue above one threshold.
struct IntervalCurve {
  std::string label, model;
  bool earthquakes = false;  ///< sizes are 10^(1.5 M)
  std::string unit;          ///< of the times before rescaling
  bool rescaled = false;     ///< bins and fits are of times divided by their mean
  SmallestSize threshold;
  double memory = 0.0;       ///< memory of the picker in the unit of the fitted times; NaN: none
  std::vector<LogBin> bins;  ///< density of the times
  std::int64_t n = 0;        ///< number of inter-event times
  std::int64_t zeros = 0;    ///< those of 0, which are left out of densities and fits
  double mean = 0.0;         ///< mean inter-event time before rescaling; NaN if there is none
  /// Coefficient of variation of the times: 1 for independent events, 0 for periodic ones, above 1
  /// for clustered ones; NaN for fewer than two times.
  double variation = 0.0;
  /// The same on a scale from -1 (periodic) to 1; 0 for independent events (Goh & Barabasi 2008).
  double burstiness() const { return burstiness_of(variation); }
  double shortest = 0.0;  ///< shortest_time() in the unit of the fitted times
  std::vector<IntervalFit> fits;
  Clustering clustering;  ///< if requested, for times between any two events
  Steadiness steadiness;  ///< under the same conditions

  /// Mean of the fitted times.
  double fitted_mean() const { return rescaled ? 1.0 : mean; }
  std::string from() const { return events_from_text(earthquakes, threshold.size); }
  /// The fit to draw: the first one that is not degenerate, or nullptr. The fit to quote is the
  /// first: maximum likelihood with delta = 1.
  const IntervalFit *drawn() const;
};

/// Times from the start of an event to the start of the next one (model time); events smaller than
/// the threshold are left out.
std::vector<double> inter_event_times(const EventTable &events, double threshold);

/// Computes one curve for each catalogue and threshold.
/// \throws std::invalid_argument for impossible settings
std::vector<IntervalCurve> interval_curves(const std::vector<EventTable> &tables,
                                           const IntervalSettings &settings);

}  // namespace LSM::postproc

#endif
