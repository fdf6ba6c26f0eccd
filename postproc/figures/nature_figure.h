// SPDX-License-Identifier: GPL-2.0-or-later
/// \file nature_figure.h
/// Catalogues of models compared with one of earthquakes, as a table and a figure.
#ifndef LSM_POSTPROC_NATURE_FIGURE_H
#define LSM_POSTPROC_NATURE_FIGURE_H

#include <vector>

#include "nature.h"
#include "plot.h"
#include "interval_figures.h"

namespace LSM::postproc {

/// The statistics that are compared, a row for each label and smallest size.
/// \param rows as returned by nature_rows(): the reference first, then by distance from it
Table nature_table(const std::vector<NatureRow> &rows);
/// Rows for the paper's Table 1: for each row one with delta free and one with delta held at 1,
/// with the errors of the row.
std::vector<Table1Row> nature_table1(const std::vector<NatureRow> &rows);
/// Distances of all rows; and for the nearest row of each label the density of its inter-event
/// times, its magnitudes, and its burstiness against its memory coefficient.
Figure nature_figure(const std::vector<NatureRow> &rows);

}  // namespace LSM::postproc

#endif
