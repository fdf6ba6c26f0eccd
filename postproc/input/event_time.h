// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_time.h
/// Dates and times of day as text.
#ifndef LSM_POSTPROC_EVENT_TIME_H
#define LSM_POSTPROC_EVENT_TIME_H

#include <optional>
#include <string>
#include <string_view>

#include "event_record.h"

namespace LSM::postproc {

/// Days since 1970-01-01T00:00 UTC of a date and time in ISO 8601 (or with '/' and a blank instead
/// of '-' and 'T'), such as 1994-01-17, 1994-01-17T12:30:55.39Z, 1994-01-17 04:30:55-08:00. A time
/// without a zone is UTC.
/// \return nothing if the text is not such a date
std::optional<double> parse_date(std::string_view text);

/// ISO 8601 date and time, rounded to minutes, of days since 1970: 1994-01-17T12:30Z
std::string date_text(double days);

/// Days since 1970 of year, month, day, and the time of day if it is known; the year may have a
/// fraction, which only repeats the others. Years of two digits are refused, as nobody knows their
/// century.
std::optional<double> time_in_parts(const Record &record);

/// Days since 1970, from what a record has.
std::optional<double> time_of(const Record &record);

}  // namespace LSM::postproc

#endif
