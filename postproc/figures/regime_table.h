// SPDX-License-Identifier: GPL-2.0-or-later
/// \file regime_table.h
/// Whether PE series stick and slip.
#ifndef LSM_POSTPROC_REGIME_TABLE_H
#define LSM_POSTPROC_REGIME_TABLE_H

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "regime.h"
#include "table.h"

namespace LSM::postproc {

/// One PE series.
struct SeriesRegime {
  std::string path, model;
  double length =
      std::numeric_limits<double>::quiet_NaN();  ///< or number of blocks; NaN: not given
  std::int64_t samples = 0, events = 0;
  double first = 0.0, last = 0.0;  ///< times of the samples used
  std::optional<Regime> regime;
  std::string why;  ///< reason if there is none

  void take(const RegimeMeter &meter);
};

Table regime_table(const std::vector<SeriesRegime> &series);

}  // namespace LSM::postproc

#endif
