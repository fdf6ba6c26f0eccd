#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# The package compiles without a warning with the headers of both versions of LAMMPS. Nothing is
# fetched: a version whose source is not in the cache, as a folder or an archive, is not tried, and
# with one of them only there is nothing to add to the build itself.
# usage: check-versions.sh COMPILER LAMMPS_CACHE PACKAGE_FOLDER FLAGS...
set -euo pipefail
compiler=$1 cache=$2 package=$3
shift 3
flags=(-std=c++17 -fsyntax-only -Wall -Wextra -Wsuggest-override -Werror "$@")
for folder in LSM LSM/support core; do flags+=(-I "$package/$folder"); done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
flags+=(-I "$work")
for header in "$package"/LSM/*.h; do echo "#include \"${header##*/}\""; done >"$work/lsm_styles.h"

# headers_of NAME: the folder src of a version, or nothing
headers_of() {
  local archive
  if [ -f "$cache/$1/src/version.h" ]; then
    echo "$cache/$1/src"
    return
  fi
  archive=$(find "$cache" -maxdepth 1 -name "$1.tar.*")
  [ -n "$archive" ] || return 0
  mkdir "$work/$1"
  tar -xf "$archive" -C "$work/$1" --wildcards '*src/*.h' '*src/*.hpp'
  find "$work/$1" -path '*/src/version.h' -printf '%h\n'
}

# compile HEADERS SOURCE...
compile() {
  local headers=$1 include=() part
  shift
  for part in "" /BPM /GRANULAR /MOLECULE /PLUGIN; do include+=(-isystem "$headers$part"); done
  printf '%s\0' "$@" | xargs -0 -n 1 -P "$(nproc)" "$compiler" "${flags[@]}" "${include[@]}"
}

found=()
for name in lammps-4Feb2025 lammps-4Jul2026; do
  headers=$(headers_of $name)
  if [ -n "$headers" ]; then found+=("$headers"); else echo "no $name in $cache"; fi
done
[ ${#found[@]} = 2 ] || { echo "skipped: the sources of both versions are needed"; exit 77; }

sed 's/get_variable_names(count)/get_variable_names()/' "$package/LSM/check_variable.cpp" >"$work/broken.cpp"
! cmp -s "$package/LSM/check_variable.cpp" "$work/broken.cpp" || { echo "FAILED: nothing to break"; exit 1; }
for headers in "${found[@]}"; do
  version=$(sed -n 's/.*LAMMPS_VERSION "\(.*\)"/\1/p' "$headers/version.h")
  compile "$headers" "$package"/LSM/*.cpp "$package"/LSM/*/*.cpp || { echo "FAILED: with LAMMPS $version"; exit 1; }
  if compile "$headers" "$work/broken.cpp" 2>/dev/null; then
    echo "FAILED: a call that LAMMPS $version does not have compiles"
    exit 1
  fi
  echo "LAMMPS $version: passed"
done
