#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# usage: inputs/study.sh TABLE [NAME=VALUE...] [SNAKEMAKE OPTIONS]      (studies.md)
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd) build=${LSM_BUILD_DIR:-}
build=${build:-$root/build}
[ $# -gt 0 ] || {
  sed -n '3s/^# //p' "$0" >&2
  ls "$root/inputs/studies" | sed -n 's/\.csv$//p' >&2
  exit 2
}
refuse() {
  echo "study.sh: $*" >&2
  exit 1
}
[[ -z ${LSM_BIN:-} || $LSM_BIN = /* ]] || LSM_BIN=$PWD/$LSM_BIN # Snakemake changes its folder
table=$1 settings=() hours=
[ -f "$table" ] || table=$root/inputs/studies/$1.csv
[ -f "$table" ] || refuse "$1: no such table, expected a file or one of $(ls "$root/inputs/studies" | sed -n 's/\.csv$//p' | xargs)"
shift
while [[ ${1:-} =~ ^[A-Za-z_]+=.*$ ]]; do
  [[ $1 != hours=* ]] || hours=${1#*=}
  settings+=("$1")
  shift
done
# On a cluster each job has the cores that it requests, and `hours` is its time limit; here all runs
# share the cores of this machine, and run.py stops within that time.
options=("$@") where=(--cores all)
for ((i = 0; i < $#; i++)); do
  if [ "${options[i]}" = --profile ]; then
    where=()
    [ ! -d "${options[i + 1]:-}" ] || options[i + 1]=$(realpath "${options[i + 1]}")                 # Snakemake changes its folder
    [ ! -f "${options[i + 1]:-}/config.yaml" ] || export LSM_PROFILE="${options[i + 1]}/config.yaml" # what -n says
  fi
done
[[ -z $hours || ${#where[@]} = 0 ]] || LSM_UNTIL=$(awk -v now="$(date +%s)" -v h="$hours" 'BEGIN { printf "%.0f", now + 3600 * h }')
export LSM_UNTIL
. "$root/lammps-pkg/cmake/debian-packages.sh"
command -v snakemake >/dev/null || install_debian_packages snakemake python3-numpy
[ -n "${LSM_BIN:-}" ] || build_programs "$root" "$build" lmp slider_cli postproc
output=${LSM_OUTPUT:-$build/studies/$(basename "$table" .csv)}
[[ $root$table$output${LSM_BIN:-} != *$'\n'* ]] || refuse "a folder or a table has a line break in its name, expected none"
mkdir -p "$output" 2>/dev/null || refuse "cannot make the folder $output"
[ -w "${HOME:-}" ] || export XDG_CACHE_HOME=$output/.cache # of Snakemake
# Programs of a study that was killed end within seconds.
{ exec 9>>"$output/.lock"; } 2>/dev/null || refuse "cannot write to $output"
flock -w 5 9 || refuse "a study works in $output already, expected another folder (LSM_OUTPUT)"
# Files may be those of another user, or of a start with sudo. Links are left out: the catalogues to
# which they lead are only read.
other=$(find "$output" ! -type l ! -writable -printf '%p, which is of %u' -quit)
[ -z "$other" ] || refuse "cannot write to $other, expected a folder of one user (LSM_OUTPUT)"
# Files written while a clock was ahead would be newer than what is made from them from now on.
find "$output" ! -type l -newermt now -exec touch -d "@$(date +%s)" {} +
exec snakemake --snakefile "$root/inputs/Snakefile" --directory "$output" "${where[@]}" \
  --quiet rules --rerun-triggers mtime params input --nolock --keep-going --keep-incomplete --rerun-incomplete "${options[@]}" \
  --config table="$(realpath "$table")" bin="${LSM_BIN:-$build/bin}" ${settings[@]+"${settings[@]}"}
