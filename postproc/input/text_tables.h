// SPDX-License-Identifier: GPL-2.0-or-later
/// \file text_tables.h
/// Earthquakes on lines of text.
#ifndef LSM_POSTPROC_TEXT_TABLES_H
#define LSM_POSTPROC_TEXT_TABLES_H

#include <string_view>

#include "event_collector.h"

namespace LSM::postproc {

/// Reads columns with names.
void read_columns(std::string_view content, Collector &out);

/// Columns: date, time of day, type of event, geographic type (not in the yearly files of 2003),
/// magnitude, its type, latitude, longitude, ... The type 'n' says that there is no magnitude.
void read_scedc(std::string_view content, Collector &out);

/// Columns: longitude, latitude, year, month, day, magnitude, depth, hour, minute[, second], and
/// others that are not used; NaN for what is missing.
void read_zmap(std::string_view content, Collector &out);

}  // namespace LSM::postproc

#endif
