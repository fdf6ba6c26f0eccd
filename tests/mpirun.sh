#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# mpirun with the settings of the scripts, for tests that run side by side.
. "$(dirname "$0")/../inputs/mpi-settings.sh"
mpirun "$@"
