#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Installs what is missing, builds everything and runs all tests.
# usage: tests/run-all.sh [CTEST OPTIONS]       (for example -R picker)
# Build folder: build (LSM_BUILD_DIR replaces it).
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
build=${LSM_BUILD_DIR:-$root/build}

. "$root/lammps-pkg/cmake/debian-packages.sh"
install_debian_packages $lammps_packages $plot_packages $postproc_packages $test_packages \
  libbenchmark-dev help2man python3-sphinx clang-format yapf3 shfmt shellcheck file strace chromium chromium-driver python3-selenium \
  snakemake slurm-wlm munge python3-sklearn python3-scipy

need_programs cmake ninja c++ mpirun gnuplot python3
# All ways of using the package need a LAMMPS of our own.
cmake -S "$root" -B "$build" -G Ninja -DLSM_BUILD_LAMMPS=ON -DLSM_BUILD_SLIDER=ON -DLSM_BUILD_POSTPROC=ON \
  -DLSM_BUILD_TESTS=ON -DLSM_JOIN_SOURCES=ON -DLSM_LAMMPS_LIBRARY=
cmake --build "$build"
exec ctest --test-dir "$build" --output-on-failure --no-tests=error -j "$(nproc)" "$@"
