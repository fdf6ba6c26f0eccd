// SPDX-License-Identifier: GPL-2.0-or-later

#ifndef LMP_LSM_FIXES_H
#define LMP_LSM_FIXES_H

#include "fix.h"
#include "modify.h"

#include <vector>

namespace LAMMPS_NS {

/// All fixes of a class, in the order of the input.
template <class Kind> std::vector<Kind *> lsm_fixes(Modify *modify)
{
  std::vector<Kind *> all;
  for (const auto &fix : modify->get_fix_list())
    if (auto one = dynamic_cast<Kind *>(fix)) all.push_back(one);
  return all;
}

}    // namespace LAMMPS_NS

#endif
