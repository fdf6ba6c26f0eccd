// SPDX-License-Identifier: GPL-2.0-or-later
/// \file statements.h
/// What the paper says in words, as numbers with errors † (it prints no number for these).
/// Events and slip come in clusters, so that errors are those of a jackknife over equal parts of
/// the time, not of counts.
#ifndef LSM_POSTPROC_STATEMENTS_H
#define LSM_POSTPROC_STATEMENTS_H

#include <vector>

#include "event_table.h"
#include "files/slip_history.h"
#include "generalised_gamma.h"
#include "samples.h"

namespace LSM::postproc {

/// Parts of a run from whose scatter errors are found.
constexpr int run_parts = 20;

/// The run between two times, in parts.
struct RunParts {
  double from = 0.0, to = 0.0;
  /// Which part a time is in, -1 if in none.
  int of(double time) const;
};

/// Sum of `above` over sum of `below`, part by part; NaN if there is nothing below.
Measured ratio_of_parts(const std::vector<double> &above, const std::vector<double> &below);

/// Does a density fall all the way?
struct Monotony {
  std::vector<double> edges;      ///< of the bins, ascending; one more than bins
  std::vector<Measured> density;  ///< normalised to one
  /// The density of a bin over that of one at smaller values: the largest that differs from 1 by
  /// more than chance, or, if none does, the largest of all. NaN: fewer than two bins with content
  /// in half of the parts.
  Measured rise;
  double rises_from = NAN, rises_to = NAN;  ///< centres of these two bins
  bool rises = false;                       ///< beyond chance
};

/// \param content content of each bin in each part: content[part][bin]
/// Beyond chance: 5 % (Student's t of the logarithm of the ratio, one-sided), divided by the number
/// of pairs of bins.
Monotony monotony(std::vector<double> edges, const std::vector<std::vector<double>> &content);

/// Slip of a fault against the drops of its PE.
struct SlipStatements {
  double time = 0.0;          ///< from the start of the first drop to the end of the last
  double single = 0.0;        ///< share of it in records of one interval; others are means of many
  Monotony velocities;        ///< slip velocity over that of the plates, of each bin of the fault
  Monotony while_slipping;    ///< the same of records of one interval
  double backwards = 0.0;     ///< share of time and bins that slip backwards
  Measured recorded;          ///< slip of the history over that of the plates: 1 in the long run
  double time_between = 0.0;  ///< share of the time in which no drop is open
  Measured slip_between;      ///< share of the slip then
  Measured rate_within;       ///< slip velocity within drops over that between them
  Measured rate_between;      ///< slip velocity between drops over that of the plates
  Measured rise_over_work;    ///< rise of PE between drops over the work of the plates then
};

/// \param drops all columns of the drops of PE, in order of time \param least smallest drop
/// \throws FileError; std::runtime_error unless the history has at least one record in the time of
/// two drops
SlipStatements slip_statements(SlipHistoryReader &history, const std::vector<Event> &drops,
                               double least);

/// Share of the ruptures that are not longer than one bin of the fault. \throws std::runtime_error
/// if the table does not say how long ruptures and bins are, or is empty
Measured share_of_one_bin(const EventTable &ruptures);

/// How the sizes roll off: s^-alpha exp(-(s / s_c)^power), by maximum likelihood above `least`.
struct RollOff {
  GeneralisedGammaFit free;         ///< of the sizes: gamma = 1 - alpha, delta = power
  GeneralisedGammaFit exponential;  ///< power 1
  /// Twice the gain in ln L of the exponential roll-off over a power law without one; NaN if that
  /// has no fit.
  double gain = NAN;
};
RollOff roll_off(const EventTable &table, double least);

}  // namespace LSM::postproc

#endif
