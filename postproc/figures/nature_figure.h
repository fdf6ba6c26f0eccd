// SPDX-License-Identifier: GPL-2.0-or-later
/// \file nature_figure.h
/// Catalogues of models beside one of earthquakes: one table, ranked, and one picture.
#ifndef LSM_POSTPROC_NATURE_FIGURE_H
#define LSM_POSTPROC_NATURE_FIGURE_H

#include <vector>

#include "nature.h"
#include "plot.h"
#include "interval_figures.h"

namespace LSM::postproc {

Table nature_table(const std::vector<NatureRow> &rows);
/// Rows for the paper's Table 1, delta free and held at 1; errors as in the rows.
std::vector<Table1Row> nature_table1(const std::vector<NatureRow> &rows);
Figure nature_figure(const std::vector<NatureRow> &rows);

}  // namespace LSM::postproc

#endif
