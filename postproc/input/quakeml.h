// SPDX-License-Identifier: GPL-2.0-or-later
/// \file quakeml.h
/// Earthquakes in QuakeML, whose files may be of any length.
#ifndef LSM_POSTPROC_QUAKEML_H
#define LSM_POSTPROC_QUAKEML_H

#include "event_collector.h"
#include "files/input_bytes.h"

namespace LSM::postproc {

/// Reads the preferred origin and magnitude of each event, or the first ones. A file may be several
/// documents, one after the other.
/// \throws FileError
void read_quakeml(files::Bytes &bytes, Collector &out);

}  // namespace LSM::postproc

#endif
