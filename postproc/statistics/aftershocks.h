// SPDX-License-Identifier: GPL-2.0-or-later
/// \file aftershocks.h
/// Tests whether large events have aftershocks: the events after all main shocks are stacked and
/// the Omori-Utsu law is fitted to their times. The paper does not address this question (†).
///
/// Sources: Utsu 1961, Geophys. Mag. 30, 521 (n(t) = K (t + c)^-p); Ogata 1983, J. Phys. Earth 31,
/// 115 (maximum likelihood, errors from the information matrix); Utsu, Ogata & Matsu'ura 1995,
/// ibid. 43, 1 (review; constant background).
#ifndef LSM_POSTPROC_AFTERSHOCKS_H
#define LSM_POSTPROC_AFTERSHOCKS_H

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "event_table.h"
#include "samples.h"

namespace LSM::postproc {

/// Defines main shocks and which events count as their aftershocks or foreshocks. Times are in the
/// unit of the catalogue's times, sizes are energies.
struct SequenceRule {
  double main_size = 0.0;   ///< smallest size of a main shock
  double least_size = 0.0;  ///< smallest size of an event that is counted
  double window = 0.0;      ///< length of the window before the start and after the end, > 0
  double first = 0.0;       ///< events closer than this to the main shock are not counted
};

/// Stack of the events before and after all main shocks of a catalogue.
struct Sequences {
  /// Start times relative to the end of the main shock, ascending.
  std::vector<double> times;
  /// Times from the end of an earlier event to the start of the main shock, ascending.
  std::vector<double> before;
  std::int64_t main_shocks = 0;
  double first = 0.0, window = 0.0;  ///< range of the times that are counted
};

/// Finds the main shocks and stacks the events around them. A main shock is an event of at least
/// main_size that is the largest (among equal ones, the first) of all events that start between
/// `window` before its start and `window` after its end, all of which must lie within the
/// catalogue. Windows after main shocks therefore do not overlap.
/// \param events in order of their start times
/// \throws std::invalid_argument for an impossible window or first time
Sequences stack_sequences(const std::vector<EventSummary> &events, const SequenceRule &rule);

/// Omori-Utsu law fitted to a stack: n(t) = K (t + c)^-p + background events per time and main
/// shock.
struct OmoriFit {
  Measured K;
  Measured c;  ///< model time; its error is 0 if c was held
  Measured p;
  Measured background;  ///< NaN error: the best value is 0, on the boundary
  std::int64_t n = 0;   ///< number of events
  Measured constant;    ///< rate of the constant law; known whenever n > 0
  /// Twice the gain in ln L over a constant rate, not negative.
  double likelihood_ratio = NAN;
  /// Only the constant rate is given if there are fewer than 20 events; the likelihood ratio is
  /// below 7.81 (the 95 % point of chi square for the 3 additional parameters; 5.99 for 2, with c
  /// held); c lies at an end of its range, from 1e-3 of the first time to the window; p is not
  /// positive; or K, c and p are too strongly correlated (standard error of p above 0.5 or of ln c
  /// above 1.5).
  bool degenerate = true;
  std::string why;

  /// Rate at time t after a main shock; the constant rate if the fit is degenerate.
  double rate(double t) const;
};

/// Fits the law by maximum likelihood, each sequence being a Poisson process with this rate.
/// Standard errors come from the curvature of ln L at the maximum.
/// \param hold_c value at which c is held; NaN: c is fitted; 0 is only possible with first > 0
/// \throws std::invalid_argument for any other value of hold_c
OmoriFit fit_omori(const Sequences &sequences, double hold_c = NAN);

/// Surrogate catalogue without clustering: the same events in random order at the times of a
/// Poisson process. The waiting times from the end of one event to the start of the next are
/// independent and exponential with the mean of the catalogue; where events may overlap, start
/// times are uniform over the catalogue. Any decay that remains after main shocks is due to the way
/// they are selected and to the durations of events.
/// \param overlapping whether events of this catalogue may overlap in time
std::vector<EventSummary> poisson_catalogue(const std::vector<EventSummary> &events,
                                            bool overlapping, std::uint64_t seed);

/// Rate of events after a main shock in one bin of time.
struct RateBin {
  double lo, hi;
  double centre;             ///< geometric mean of the edges
  std::int64_t count;        ///< events of all sequences together
  double rate;               ///< count / (main shocks (hi - lo))
  double error;              ///< Poisson error of rate
  double poisson = NAN;      ///< mean rate in Poisson catalogues
  double scatter = poisson;  ///< its standard deviation over these catalogues
  std::int64_t before = 0;   ///< events in the same bin of time before main shocks
};

/// Aftershocks of a catalogue, compared with those of Poisson catalogues of the same events.
struct Aftershocks {
  SequenceRule rule;
  Sequences sequences;
  OmoriFit fit;
  std::vector<RateBin> bins;  ///< edges factor^n between first and window
  /// Share of Poisson catalogues whose likelihood ratio is at least as large, (k + 1) /
  /// (replicas + 1); NaN without replicas or with too few events to fit.
  double p = NAN;
};

/// Stacks, fits and bins the aftershocks of a catalogue and repeats this for Poisson catalogues.
/// \param hold_c as in fit_omori()
/// \param factor ratio of the edges of a bin
/// \param replicas number of Poisson catalogues; 0: none
/// \throws std::invalid_argument for impossible settings
Aftershocks aftershocks_of(const EventTable &table, const SequenceRule &rule, double hold_c,
                           double factor, int replicas, std::uint64_t seed);

}  // namespace LSM::postproc

#endif
