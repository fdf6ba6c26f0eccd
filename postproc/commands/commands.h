// SPDX-License-Identifier: GPL-2.0-or-later
/// \file commands.h
/// The commands of postproc. Each function adds one to the program; its work is done, and its
/// errors (std::exception with one clear line) are thrown, while the command line is parsed.
#ifndef LSM_POSTPROC_COMMANDS_H
#define LSM_POSTPROC_COMMANDS_H

#include <CLI/CLI.hpp>

namespace LSM::postproc {

void add_pick(CLI::App &app);         ///< PE series to catalogue
void add_series(CLI::App &app);       ///< PE, its change, picked events (paper: Figs. 8 to 11)
void add_histograms(CLI::App &app);   ///< event-size densities (Figs. 7, 12, 13)
void add_intervals(CLI::App &app);    ///< inter-event times (Figs. 14, 15, Table 1)
void add_fit(CLI::App &app);          ///< size exponents, finite-size scaling
void add_magnitudes(CLI::App &app);   ///< frequencies of magnitudes, b-values (ours)
void add_aftershocks(CLI::App &app);  ///< rates after main shocks, Omori-Utsu law (ours)
void add_count(CLI::App &app);        ///< numbers of events (ours)
void add_match(CLI::App &app);        ///< the same events in two catalogues (ours)
void add_compare(CLI::App &app);      ///< do catalogues agree? (ours)
void add_nature(CLI::App &app);       ///< models ranked by their distance to earthquakes (ours)
void add_spectrum(CLI::App &app);     ///< power spectrum of PE (ours)
void add_export(CLI::App &app);       ///< tables for earthquake catalogue tools
void add_select(CLI::App &app);       ///< part of a catalogue as a catalogue (ours)
void add_report(CLI::App &app);       ///< one page about a set of catalogues
void add_rupture(CLI::App &app);      ///< ruptures of a fault in space and time (ours)
void add_explore(CLI::App &app);      ///< a page on which a person explores runs (ours)
void add_benchmark(CLI::App &app);    ///< ruptures beside reference curves (ours)
void add_summary(CLI::App &app);      ///< one row of numbers for each catalogue (ours)

}  // namespace LSM::postproc

#endif
