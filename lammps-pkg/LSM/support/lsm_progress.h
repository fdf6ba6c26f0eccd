// SPDX-License-Identifier: GPL-2.0-or-later
// One line about a run on a terminal, rewritten every few seconds

#ifndef LMP_LSM_PROGRESS_H
#define LMP_LSM_PROGRESS_H

#include "platform.h"
#include "update.h"

#include <cstdint>
#include <cstdio>
#include <unistd.h>

namespace LAMMPS_NS {

class LSMProgress {
 public:
  void begin() { shown_at = started_at = platform::walltime(); }
  /// Prints nothing if the output is not a terminal.
  void show(const Update *update, bigint step, std::int64_t events)
  {
    const double now = platform::walltime();
    if (now - shown_at < 5.0) return;
    shown_at = now;
    if (!isatty(STDERR_FILENO)) return;
    const double done = static_cast<double>(step - update->firststep);
    const double left = static_cast<double>(update->laststep - step);
    const double seconds = done > 0.0 ? (now - started_at) * left / done : 0.0;
    fprintf(stderr, "\rstep " BIGINT_FORMAT " of " BIGINT_FORMAT ", %lld events, %.0f s left   ",
            step, update->laststep, static_cast<long long>(events), seconds);
  }

 private:
  double shown_at = 0.0, started_at = 0.0;
};

}    // namespace LAMMPS_NS

#endif
