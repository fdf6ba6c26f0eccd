// SPDX-License-Identifier: GPL-2.0-or-later
// Internal helper of pair style lsm/friction: contact history that is not
// changed by a write_restart command between two runs, and that records the
// friction law it belongs to

#ifdef FIX_CLASS
// clang-format off
FixStyle(LSM_HISTORY,FixLSMHistory);
// clang-format on
#else

#ifndef LMP_FIX_LSM_HISTORY_H
#define LMP_FIX_LSM_HISTORY_H

#include "fix_neigh_history.h"
#include "lsm_contacts.h"

#include <functional>
#include <unordered_map>

namespace LAMMPS_NS {

class FixLSMHistory : public FixNeighHistory, public LSMContactStore {
 public:
  FixLSMHistory(class LAMMPS *, int, char **);
  void init() override;
  void pre_exchange() override;
  void post_neighbor() override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  void unpack_restart(int, int) override;

  int *touch_of(int i, int jj) override { return &firstflag[i][jj]; }
  double *values_of(int i, int jj) override { return &firstvalue[i][dnum * jj]; }
  void add_pair(int i, int jj) override;

  // Writes the states of contacts here if they have changed, and says so; set by the pair style.
  std::function<bool()> gather_states;

 private:
  struct Row {
    std::vector<int> touch;
    std::vector<double> values;
  };
  std::unordered_map<int, Row> rows;    // of particles to whose neighbors pairs were added
  const std::string law;    // friction law of the contacts, "" if it has no state of its own
  const char *law_of_file;
};

}    // namespace LAMMPS_NS

#endif
#endif
