// SPDX-License-Identifier: GPL-2.0-or-later
/// \file aftershocks.h
/// Do large events have aftershocks? Times of events after main shocks, stacked, and the Omori-Utsu
/// law fitted to them. The paper does not ask (†).
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

/// What a main shock is, and which events are counted after it.
struct SequenceRule {
  double main_size = 0.0;   ///< smallest main shock
  double least_size = 0.0;  ///< smallest event that is counted
  double window = 0.0;      ///< time after the end of a main shock, and before its start, > 0
  double first = 0.0;       ///< events sooner than this after the end are not counted
};

/// Events after and before main shocks, all sequences on top of each other.
struct Sequences {
  std::vector<double> times;  ///< starts, since the end of the main shock; ascending
  /// From the end of an earlier event to the start of the main shock; ascending.
  std::vector<double> before;
  std::int64_t main_shocks = 0;
  double first = 0.0, window = 0.0;  ///< from and to which times are counted
  /// Events outside of the windows before and after all main shocks, and the time there.
  std::int64_t quiet_events = 0;
  double quiet_time = 0.0;

  /// Of events far from main shocks; NaN: there is no such time.
  Measured background() const;
  /// Events beyond those of the background in the windows after and before main shocks.
  Measured excess_after() const { return excess(times.size()); }
  Measured excess_before() const { return excess(before.size()); }
  /// The first over the second: how many aftershocks there are for a foreshock. The error is that
  /// of counts; that between catalogues is larger where few main shocks have most of them.
  Measured after_to_before() const;

 private:
  Measured excess(std::size_t count) const;
};

/// Mean of the catalogues of one label and its error from their scatter; of one, its own.
Measured mean_of_catalogues(const std::vector<Measured> &numbers);

/// Main shock: an event of at least main_size that is the largest (of equals the first) of all that
/// start from window before its start to window after its end; all of that time has to lie within
/// the catalogue. So the windows after main shocks do not overlap. \throws std::invalid_argument
Sequences stack_sequences(const std::vector<EventSummary> &events, const SequenceRule &rule);

/// Rate of events after a main shock: n(t) = K (t + c)^-p + background.
struct OmoriFit {
  double K = NAN, se_K = K;
  double c = K, se_c = K;  ///< model time; error 0 if it was held
  double p = K, se_p = K;
  double background = K, se_background = K;  ///< error NaN: 0 is best, at the border
  std::int64_t n = 0;                        ///< events
  double constant = K, se_constant = K;      ///< rate of the constant alone, always there if n > 0
  /// 2 (ln L - ln L of a constant rate), 0 or more.
  double likelihood_ratio = K;
  /// No numbers but those of the constant: fewer than 20 events; a ratio below 7.81 (95 % of chi
  /// square with the 3 more parameters; 2: 5.99 with c held); c at an end of its range, from 1e-3
  /// of the first time to the window; or K, c and p that trade against each other (error of p above
  /// 0.5, of ln c above 1.5).
  bool degenerate = true;
  std::string why;

  double rate(double t) const;  ///< at time t after a main shock
};

/// Maximum likelihood of a Poisson process with that rate in each sequence; standard errors from
/// the curvature of ln L. \param hold_c value c is held at; NaN: fitted; 0 needs first > 0
/// \throws std::invalid_argument for another c
OmoriFit fit_omori(const Sequences &sequences, double hold_c = NAN);

/// The same events in random order at the times of a Poisson process: independent exponential times
/// from the end of one to the start of the next with the mean of the catalogue; where events
/// overlap, starts that are uniform over the catalogue. What is left of a decay in it
/// comes from the choice of the main shocks and from the durations.
std::vector<EventSummary> poisson_catalogue(const std::vector<EventSummary> &events,
                                            bool overlapping, std::uint64_t seed);

/// Rate after a main shock over one bin of time.
struct RateBin {
  double lo, hi;
  double centre;             ///< geometric mean of the edges
  std::int64_t count;        ///< events, all sequences together
  double rate;               ///< count / (main shocks (hi - lo))
  double error;              ///< Poisson error of rate
  double poisson = NAN;      ///< mean rate in Poisson catalogues
  double scatter = poisson;  ///< standard deviation of the rate from one of them to the next
  std::int64_t before = 0;   ///< events as long before the main shocks
};

/// The aftershocks of one catalogue beside those of Poisson catalogues of the same events.
struct Aftershocks {
  SequenceRule rule;
  Sequences sequences;
  OmoriFit fit;
  std::vector<RateBin> bins;  ///< edges factor^n within first to window
  /// Share of Poisson catalogues whose likelihood ratio is as large, (k + 1) / (replicas + 1); NaN
  /// without replicas, or with too few events to fit.
  double p = NAN;
};

/// \param factor ratio of the edges of a bin \param replicas Poisson catalogues, 0: none
/// \throws std::invalid_argument for impossible settings
Aftershocks aftershocks_of(const EventTable &table, const SequenceRule &rule, double hold_c,
                           double factor, int replicas, std::uint64_t seed);

}  // namespace LSM::postproc

#endif
