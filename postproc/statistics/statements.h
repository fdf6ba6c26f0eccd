// SPDX-License-Identifier: GPL-2.0-or-later
/// \file statements.h
/// Qualitative statements of the paper as numbers with errors † (it prints no numbers for these).
/// As events and slip are clustered, standard errors come from a jackknife over equal parts of the
/// time rather than from counts.
#ifndef LSM_POSTPROC_STATEMENTS_H
#define LSM_POSTPROC_STATEMENTS_H

#include <vector>

#include "event_table.h"
#include "files/slip_history.h"
#include "generalised_gamma.h"
#include "samples.h"

namespace LSM::postproc {

/// Number of parts of a run for the jackknife.
constexpr int run_parts = 20;

/// The time of a run between two ends, divided into equal parts.
struct RunParts {
  double from = 0.0, to = 0.0;
  /// Index of the part that contains a time; -1 outside the run.
  int of(double time) const;
};

/// Sum of `above` over sum of `below`, both given part by part, with its jackknife error; not
/// finite if `below` sums to 0.
Measured ratio_of_parts(const std::vector<double> &above, const std::vector<double> &below);

/// Whether a density decreases monotonically.
struct Monotony {
  std::vector<double> edges;      ///< edges of the bins, ascending; one more than bins
  std::vector<Measured> density;  ///< normalised to one
  /// Ratio of the density in a bin to that in a bin of smaller values: the largest of the ratios
  /// that exceed 1 significantly or, if none does, of all. NaN if fewer than two bins have content
  /// in half of the parts.
  Measured rise;
  double rises_from = NAN, rises_to = NAN;  ///< centres of these two bins
  bool rises = false;                       ///< whether the rise is significant
};

/// Tests for significant rises of a density. The level is 5 % (Student's t of the logarithm of the
/// ratio, one-sided) divided by the number of pairs of bins (Bonferroni).
/// \param edges edges of the bins, ascending
/// \param content content[part][bin]: content of each bin in each part
Monotony monotony(std::vector<double> edges, const std::vector<std::vector<double>> &content);

/// Comparison of the slip of a fault with the drops of its PE.
struct SlipStatements {
  double time = 0.0;  ///< from the start of the first drop to the end of the last
  /// Share of that time in records of one interval; other records are means over many.
  double single = 0.0;
  /// Slip velocity of each bin of the fault, over the plate velocity.
  Monotony velocities;
  Monotony while_slipping;    ///< the same for records of one interval only
  double backwards = 0.0;     ///< share of time and bins with backward slip
  Measured recorded;          ///< slip of the history over that of the plates: 1 in the long run
  double time_between = 0.0;  ///< share of the time without an open drop
  Measured slip_between;      ///< share of the slip in that time
  Measured rate_within;       ///< slip velocity during drops over that between them
  Measured rate_between;      ///< slip velocity between drops over the plate velocity
  Measured rise_over_work;    ///< rise of PE between drops over the work of the plates in that time
};

/// Compares a slip history with the drops of PE.
/// \param drops drops of PE with all columns, in order of time
/// \param least smallest drop that is used (energy)
/// \throws FileError if the history cannot be read
/// \throws std::runtime_error unless at least two drops are large enough and the history has a
/// record in their time
SlipStatements slip_statements(SlipHistoryReader &history, const std::vector<Event> &drops,
                               double least);

/// Share of the ruptures that are no longer than one bin of the fault.
/// \throws std::runtime_error if the table lacks the lengths of ruptures or bins, or has fewer than
/// two ruptures
Measured share_of_one_bin(const EventTable &ruptures);

/// Roll-off of the sizes, s^-alpha exp(-(s / s_c)^power), by maximum likelihood above `least`.
struct RollOff {
  GeneralisedGammaFit free;         ///< fit to the sizes: gamma = 1 - alpha, delta = power
  GeneralisedGammaFit exponential;  ///< the same with power 1
  /// Twice the gain in ln L of the exponential roll-off over a pure power law; NaN if either has no
  /// fit.
  double gain = NAN;
};
/// \param least smallest size that is used (energy)
RollOff roll_off(const EventTable &table, double least);

}  // namespace LSM::postproc

#endif
