#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# The pair styles compile with the Pair of LAMMPS 4 Feb 2025, which has atom2cut and radii2cut, and
# with that of 4 Jul 2026, which has not. No warning either way, whatever is said about 'override'.
# usage: check-other-pair.sh COMPILER LAMMPS_SRC PACKAGE_FOLDER FLAGS...
set -euo pipefail
compiler=$1 source=$2 package=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/with" "$work/without"
sed '/virtual double atom2cut(int)\|virtual double radii2cut(double, double)/d' "$source/pair.h" >"$work/without/pair.h"
if cmp -s "$source/pair.h" "$work/without/pair.h"; then
  # The source is that of a version without them.
  sed 's/^  virtual void compute(int, int) = 0;/&\n  virtual double atom2cut(int) { return 0.0; }\n  virtual double radii2cut(double, double) { return 0.0; }/' \
    "$source/pair.h" >"$work/with/pair.h"
else
  cp "$source/pair.h" "$work/with/pair.h"
fi
[ "$(grep -c 'virtual double \(atom2cut\|radii2cut\)' "$work/with/pair.h")" = 2 ] || { echo "FAILED: no pair.h with the two functions"; exit 1; }
! grep -q 'atom2cut\|radii2cut' "$work/without/pair.h" || { echo "FAILED: no pair.h without the two functions"; exit 1; }
for way in with without; do
  "$compiler" -std=c++17 -fsyntax-only -Wall -Wextra -Wsuggest-override -Werror "$@" -I "$package/LSM" -I "$package/LSM/support" -I "$package/core" \
    -isystem "$work/$way" -isystem "$source" "$package/LSM/pair_lsm_free.cpp" ||
    { echo "FAILED: pair_lsm_free.cpp $way Pair::atom2cut and radii2cut"; exit 1; }
done
echo "Pair with and without atom2cut and radii2cut: passed"
