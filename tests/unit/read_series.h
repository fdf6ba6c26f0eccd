// SPDX-License-Identifier: GPL-2.0-or-later
// Reads whole series of PE and slip histories into memory.
#ifndef LSM_UNIT_READ_SERIES_H
#define LSM_UNIT_READ_SERIES_H

#include <cstdint>
#include <string>
#include <vector>

#include "events/event_picker.h"
#include "files/pe_series.h"
#include "files/slip_history.h"

namespace unit {

struct Sample {
  std::int64_t step = 0;
  double time = 0.0, pe = 0.0;
};

inline std::vector<Sample> read_series(const std::string &path) {
  LSM::PeSeriesReader reader(LSM::files::open_plain(path));
  std::vector<Sample> samples;
  for (Sample one; reader.next(one.step, one.time, one.pe);) samples.push_back(one);
  return samples;
}

/// The events that a picker finds in a series.
inline std::vector<LSM::Event> picked(const std::vector<Sample> &series,
                                      const LSM::PickerSettings &settings) {
  LSM::EventPicker picker(settings);
  std::vector<LSM::Event> events;
  LSM::Event event;
  for (const Sample &one : series)
    if (picker.push(one.step, one.time, one.pe, event)) events.push_back(event);
  return events;
}

struct History {
  LSM::SlipHistoryInfo info;
  std::vector<LSM::SlipRecord> records;
};

inline History read_history(const std::string &path, bool lenient = false) {
  LSM::SlipHistoryReader reader(LSM::files::open_plain(path), lenient);
  History history{reader.info(), {}};
  for (LSM::SlipRecord record; reader.next(record);) history.records.push_back(record);
  return history;
}

}  // namespace unit

#endif
