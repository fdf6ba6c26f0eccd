#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# All C++ sources are formatted as the .clang-format next to them says (that of lammps-pkg/LSM is
# LAMMPS' own). Formatted with clang-format 14, that of Debian 12.
# usage: check-format.sh [--fix] [FILE...]     (all files of the project without names; --fix formats)
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(command -v clang-format-14 || command -v clang-format) || {
  echo "skipped: clang-format is not installed (Debian package clang-format)" >&2
  exit 77
}

# What is not formatted must be found, or the rest says nothing.
for file in lammps-pkg/LSM/probe.cpp slider/probe.cpp; do
  if echo 'int  a ;' | "$program" --dry-run -Werror --assume-filename=$file 2> /dev/null; then
    echo "$program does not find an unformatted line" >&2
    exit 1
  fi
done

fix=
[ "${1:-}" = --fix ] && { fix=yes; shift; }
if [ $# = 0 ]; then
  mapfile -t files < <(find cli lammps-pkg slider postproc tests inputs -name '*.cpp' -o -name '*.h' | sort)
  if [ ${#files[@]} -lt 50 ]; then
    echo "only ${#files[@]} C++ sources found in $PWD" >&2
    exit 1
  fi
  set -- "${files[@]}"
fi
[ -z "$fix" ] || "$program" -i "$@"
if ! "$program" --dry-run -Werror "$@"; then
  echo "Not formatted (with $("$program" --version)); tests/check-format.sh --fix does it" >&2
  exit 1
fi
echo "$# files are formatted"
