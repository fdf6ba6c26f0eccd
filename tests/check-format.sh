#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# All sources are formatted: C++ as the .clang-format next to them says (that of lammps-pkg/LSM is
# LAMMPS' own), Python as .style.yapf says, shell with two blanks; shellcheck has no warning, and
# scripts may be executed.
# With the programs of Debian 12: clang-format-14, yapf3, shfmt, shellcheck.
# usage: check-format.sh [--fix] [FILE...]     (all files of the project without names; --fix formats)
set -euo pipefail
cd "$(dirname "$0")/.."
fix=
[ "${1:-}" = --fix ] && {
  fix=yes
  shift
}
bad=0

# files_of PATTERN [FILE...]: the files that match, out of all files if no names are given
files_of() {
  local pattern=$1 file
  shift
  if [ $# = 0 ]; then
    git ls-files --cached --others --exclude-standard -- cli lammps-pkg slider postproc tests inputs python results | grep -E "$pattern" |
      while read -r file; do [ ! -e "$file" ] || echo "$file"; done
  else
    printf '%s\n' "$@" | grep -E "$pattern" || true
  fi
}
missing() {
  echo "skipped: $1 is not installed (Debian package ${2:-$1})" >&2
  skipped=77
}
not_formatted() {
  echo "Not formatted: $1; tests/check-format.sh --fix does it" >&2
  bad=1
}
# An unformatted line must be detected, or the rest proves nothing.
blind() {
  echo "$1 does not find an unformatted line" >&2
  exit 1
}
skipped=0

cpp=$(command -v clang-format-14 || command -v clang-format || true)
mapfile -t files < <(files_of '\.(cpp|h)$' "$@")
if [ -z "$cpp" ]; then missing clang-format; elif [ ${#files[@]} -gt 0 ]; then
  for file in lammps-pkg/LSM/probe.cpp slider/probe.cpp; do
    ! echo 'int  a ;' | "$cpp" --dry-run -Werror --assume-filename=$file 2>/dev/null || blind "$cpp"
  done
  [ -z "$fix" ] || "$cpp" -i "${files[@]}"
  "$cpp" --dry-run -Werror "${files[@]}" || not_formatted C++
  echo "${#files[@]} C++ files"
fi

mapfile -t files < <(files_of '\.py$' "$@")
if ! command -v yapf3 >/dev/null; then missing yapf3; elif [ ${#files[@]} -gt 0 ]; then
  [ "$(echo 'a  =1' | yapf3)" = 'a = 1' ] || blind yapf3
  [ -z "$fix" ] || yapf3 --parallel -i "${files[@]}"
  yapf3 --parallel --diff "${files[@]}" || not_formatted Python
  echo "${#files[@]} Python files"
fi

# jobscript.sh for Slurm is a template of Snakemake.
mapfile -t files < <(files_of '\.sh$' "$@" | grep -v /jobscript.sh)
if ! command -v shfmt >/dev/null; then missing shfmt; elif [ ${#files[@]} -gt 0 ]; then
  ! echo 'if  a; then b; fi' | shfmt -i 2 -ci -d >/dev/null || blind shfmt
  [ -z "$fix" ] || shfmt -i 2 -ci -w "${files[@]}"
  shfmt -i 2 -ci -d "${files[@]}" || not_formatted shell
  echo "${#files[@]} shell files"
fi
if ! command -v shellcheck >/dev/null; then missing shellcheck; elif [ ${#files[@]} -gt 0 ]; then
  # shellcheck disable=SC2016
  ! echo 'cd $1' | shellcheck -s bash - >/dev/null || blind shellcheck
  shellcheck -s bash -x -S warning -e SC2034,SC2206,SC1007 "${files[@]}" || bad=1
fi

mapfile -t files < <(files_of '\.(py|sh)$' "$@")
mapfile -t files < <(awk 'FNR == 1 && /^#!/ { print FILENAME } { nextfile }' "${files[@]}" /dev/null)
for file in "${files[@]}"; do
  [ -x "$file" ] || {
    echo "$file begins with #!, expected the permission to execute it" >&2
    bad=1
  }
done

[ $bad = 0 ] || exit 1
exit $skipped
