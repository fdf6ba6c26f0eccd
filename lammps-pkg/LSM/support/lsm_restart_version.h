// SPDX-License-Identifier: GPL-2.0-or-later
// The version of the package's data in restart files

#ifndef LMP_LSM_RESTART_VERSION_H
#define LMP_LSM_RESTART_VERSION_H

#include "error.h"

namespace LAMMPS_NS {

/// To be raised with every change of what a style writes.
constexpr int LSM_RESTART_VERSION = 5;
/// Of force styles in three dimensions, where links have a factor of their rest length.
constexpr int LSM_RESTART_VERSION_3D = 6;

inline void lsm_check_version(Error *error, int found, int expected = LSM_RESTART_VERSION)
{
  if (found != expected)
    error->all(FLERR,
               "The restart file was written by another version of package LSM, expected "
               "version {} of its data; begin anew, or use that version",
               expected);
}

}    // namespace LAMMPS_NS

#endif
