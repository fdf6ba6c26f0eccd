// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_documents.h
/// Earthquakes in GeoJSON.
#ifndef LSM_POSTPROC_EVENT_DOCUMENTS_H
#define LSM_POSTPROC_EVENT_DOCUMENTS_H

#include <string_view>

#include "event_collector.h"

namespace LSM::postproc {

/// A collection of GeoJSON as ComCat writes it: times in milliseconds since 1970, places as
/// coordinates. The names of properties are those of columns.
void read_geojson(std::string_view content, Collector &out);

}  // namespace LSM::postproc

#endif
