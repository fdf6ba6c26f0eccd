// SPDX-License-Identifier: GPL-2.0-or-later
// How long a run is going to take: one line at its start, and one on a terminal, rewritten every
// few seconds

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
  /// \param screen of LAMMPS, null for none: the line at the start goes there, not into log files
  /// \param rewritten whether there is a line on a terminal
  void show(const Update *update, FILE *screen, bool rewritten, bigint step, std::int64_t events)
  {
    const double now = platform::walltime();
    if (first_step < 0) {    // what comes before is the set-up
      shown_at = started_at = now;
      first_step = step;
    }
    // all pieces of a run end at endstep
    const bigint steps = update->endstep - step;
    const double seconds_of_step = (now - started_at) / static_cast<double>(step - first_step);
    const double left = seconds_of_step * static_cast<double>(steps);
    if (!said && now - started_at > 2.0) {
      said = true;
      if (screen) {
        fprintf(screen, "About %.*f %s to go: " BIGINT_FORMAT " steps of %.3g ms\n",
                left < 6000 ? 0 : 1, left < 120 ? left : left / (left < 6000 ? 60 : 3600),
                left < 120        ? "seconds"
                    : left < 6000 ? "minutes"
                                  : "hours",
                steps, 1000.0 * seconds_of_step);
        fflush(screen);
      }
    }
    if (now - shown_at < 5.0) return;
    shown_at = now;
    if (rewritten && isatty(STDERR_FILENO))
      fprintf(stderr, "\rstep " BIGINT_FORMAT " of " BIGINT_FORMAT ", %lld events, %.0f s left   ",
              step, update->endstep, static_cast<long long>(events), left);
  }

 private:
  double shown_at = 0.0, started_at = 0.0;
  bigint first_step = -1;
  bool said = false;
};

}    // namespace LAMMPS_NS

#endif
