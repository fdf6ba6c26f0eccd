// SPDX-License-Identifier: GPL-2.0-or-later
// Keywords of compute lsm/events

#ifndef LMP_LSM_EVENT_OPTIONS_H
#define LMP_LSM_EVENT_OPTIONS_H

#include "events/event_headers.h"
#include "fault/watchdog.h"
#include "files/keywords.h"

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
class LSMKeywordReader;

struct LSMEventOptions {
  LSM::EventSettings events;
  LSM::WatchdogSettings watchdog;
  std::string emergency_file = "lsm_emergency.restart";
  double memory_time = 0.0;    ///< of the picker; > 0: lambda follows from it and the time step
  int block = 100;             ///< steps collected before ranks talk to each other
  bool ledger = false;
  bool progress = true;
  bool unfinished = false;    ///< write events that are open at the end

  /// Reads the words after the style's name, which begin at arg[first]. Stops at the first error.
  LSMEventOptions(LAMMPS *, int first, int narg, char **arg);

 private:
  /// \param prefix of the files that are only said to be written, with *yes*
  LSM::Keywords keywords(LSMKeywordReader &, std::string &prefix);
};

}    // namespace LAMMPS_NS

#endif
