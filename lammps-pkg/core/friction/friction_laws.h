// SPDX-License-Identifier: GPL-2.0-or-later
/// \file friction_laws.h
/// Every friction law, one line each: the list that the dispatch of pair style lsm/friction is
/// generated from. Include it with LSM_FRICTION_LAW(Law) defined to have that expanded for each
/// law, and without for the laws themselves; hence no include guard.
#include "coulomb.h"
#include "slip_weakening.h"
#include "velocity_weakening.h"
#include "rate_state.h"
