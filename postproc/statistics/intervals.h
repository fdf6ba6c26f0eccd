// SPDX-License-Identifier: GPL-2.0-or-later
/// \file intervals.h
/// Inter-event times, their densities, and generalised gamma fits (paper: Sect. 4.3).
#ifndef LSM_POSTPROC_INTERVALS_H
#define LSM_POSTPROC_INTERVALS_H

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "clustering.h"
#include "event_table.h"
#include "generalised_gamma.h"
#include "log_histogram.h"

namespace LSM::postproc {

struct IntervalSettings {
  /// Smallest sizes (model energy); none: Threshold().
  std::vector<double> thresholds;
  /// Places along the fault, equally spaced: times between events that rupture the same one, those
  /// of all places together; 0: times between any two events.
  int places = 0;
  bool rescale = false;              ///< times divided by their mean
  double factor = usual_bin_factor;  ///< ratio of the edges of a bin
  /// Times shorter than this multiple of their mean are not fitted; NaN: maximum likelihood leaves
  /// out those below shortest_time(), least squares none, as in the paper.
  double shortest = NAN;
  bool cuts = false;  ///< gamma_of_cuts(), too
  bool least_squares = true, maximum_likelihood = true;
  int replicas = 1000;  ///< of the Monte Carlo p-values of maximum likelihood; 0: none
  std::uint64_t seed = 1;
  /// Random series that clustering() and steadiness() compare with; 0: without these, negative:
  /// shuffles_for().
  int shuffles = 0;
  double steady = 0.05;                     ///< departure that a steady stretch may have
  std::int64_t steady_events = 500;         ///< and its smallest number of events
  std::vector<double> deltas = {1.0, NAN};  ///< NaN: free
};

/// Random series beside this many times: 200, fewer of more than 1e5 times (2e7 times in all, at
/// least 19, so that p can be 0.05), as the random numbers of longer series scatter less.
int shuffles_for(std::size_t times);

/// The shortest time that says something about the fault †. A picker with a memory joins
/// events closer than that: with times of any gamma from 0.7 to 1 and a dead time of one memory,
/// those above 2.5 memories give gamma back, all times give 0.1 to 0.4 too much (a test has them).
/// Below 0.05 of the mean lie the times within sequences, where catalogues of earthquakes miss
/// events. \param memory of the picker; NaN: none
inline double shortest_time(double memory, double mean) {
  return std::fmax(2.5 * memory, 0.05 * mean);
}

/// gamma with delta = 1 by maximum likelihood of the times from `cut` on.
struct GammaOfCut {
  double cut = 0.0;  ///< in the unit of the times
  GeneralisedGammaFit fit;
};

struct IntervalFit {
  std::string method;  ///< "least squares" or "maximum likelihood"
  double held = 0.0;   ///< delta if it was held, NaN if it was free
  GeneralisedGammaFit fit;
  /// p_value(); NaN: degenerate, no replicas. The error of its Monte Carlo estimate; NaN: least
  /// squares, which needs none.
  Measured p = {};
};

/// "sizes >= 0.001", of earthquakes "magnitudes >= 2"
std::string events_from_text(bool earthquakes, double least);

/// One catalogue above one threshold.
struct IntervalCurve {
  std::string label, model;
  bool earthquakes = false;  ///< sizes are 10^(1.5 M)
  std::string unit;          ///< of the times, unless rescaled
  bool rescaled = false;     ///< bins and fits are of times over their mean
  SmallestSize threshold;
  std::int64_t n = 0;  ///< inter-event times
  double mean = 0.0;   ///< of the inter-event times, model time; NaN if there is none
  /// Standard deviation of the times over their mean: 1 for independent events, 0 for periodic
  /// ones, above 1 for clusters; NaN if there are fewer than two times.
  double variation = 0.0;
  /// The same from -1, periodic, to 1: 0 for independent events (Goh & Barabasi 2008).
  double burstiness() const { return burstiness_of(variation); }
  double memory = 0.0;    ///< of the picker, in the unit of the times fitted; NaN: none
  double shortest = 0.0;  ///< time that is fitted by maximum likelihood, likewise
  std::vector<LogBin> bins;
  std::vector<IntervalFit> fits;
  std::vector<GammaOfCut> cuts;  ///< in ascending order; if asked for
  Clustering clustering;         ///< if asked for, and times are those between any two events
  Steadiness steadiness;         ///< likewise
  std::vector<double> starts;    ///< likewise, of the events
  /// Likewise: densities, over the mean, of the times that follow the shortest, the middle and the
  /// longest third.
  std::array<std::vector<LogBin>, thirds> after;

  /// The fit that is drawn: the first that is not degenerate, or nullptr. The first of all is the
  /// one to quote: maximum likelihood with delta = 1.
  const IntervalFit *drawn() const;
  std::string from() const { return events_from_text(earthquakes, threshold.size); }
};

/// Times from the start of an event to the start of the next one, events smaller than threshold
/// left out (model time).
std::vector<double> inter_event_times(const EventTable &events, double threshold);

/// Do successive times depend on each other? Spearman's correlation of each time with the next one,
/// which tells clusters and regular sequences from independent events whatever their density is,
/// and the share of independent series with one as far from 0 (Student's t). Fewer than 4 pairs, or
/// times that are all equal: NaN.
struct RankCorrelation {
  double rho = NAN, p = rho;
};
RankCorrelation successive_rank_correlation(const std::vector<double> &times);

/// Times between events that rupture a place, for `places` of them, equally spaced along the fault
/// from half a space on, one after the other. Places closer to each other than events are long
/// share events, so that their times are not independent. \throws std::invalid_argument if the
/// table does not say where its events ruptured
std::vector<double> times_at_places(const EventTable &events, double threshold, int places);

/// fit_maximum_likelihood() with C such that the density is that of all times: over those from
/// `shortest` on it integrates to their share.
GeneralisedGammaFit fit_with_share(const std::vector<double> &times, double shortest, double delta);

/// gamma against the shortest time used: all times; 0.5, 1, 2.5, 5 and 10 memories of the picker if
/// it has one; 0.05, 0.1 and 0.2 of the mean.
std::vector<GammaOfCut> gamma_of_cuts(const std::vector<double> &times, double memory, double mean);

/// The bins of times from `shortest` on.
std::vector<LogBin> bins_from(std::vector<LogBin> bins, double shortest);

/// \throws std::invalid_argument for impossible settings
std::vector<IntervalCurve> interval_curves(const std::vector<EventTable> &tables,
                                           const IntervalSettings &settings);

}  // namespace LSM::postproc

#endif
