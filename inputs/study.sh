#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# usage: inputs/study.sh TABLE [NAME=VALUE...] [SNAKEMAKE OPTIONS]      (studies.md)
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd) build=${LSM_BUILD_DIR:-}
build=${build:-$root/build}
[ $# -gt 0 ] || { sed -n '3s/^# //p' "$0" >&2; ls "$root/inputs/studies" | sed -n 's/\.csv$//p' >&2; exit 2; }
table=$1 settings=() hours=
[ -e "$table" ] || table=$root/inputs/studies/$1.csv
shift
while [[ ${1:-} =~ ^[a-z]+=.*$ ]]; do
  [[ $1 != hours=* ]] || hours=${1#*=}
  settings+=("$1")
  shift
done
# On a cluster that is the limit of each job; here run.py stops by then.
[ -z "$hours" ] || [ "${1:-}" = --profile ] || export LSM_UNTIL=$(awk -v now="$(date +%s)" -v h="$hours" 'BEGIN { printf "%.0f", now + 3600 * h }')
[ "${1:-}" != --profile ] || [ ! -d "${2:-}" ] || set -- --profile "$(realpath "$2")" "${@:3}" # Snakemake leaves this folder
. "$root/lammps-pkg/cmake/debian-packages.sh"
command -v snakemake >/dev/null || install_debian_packages snakemake
[ -n "${LSM_BIN:-}" ] || {
  install_debian_packages $lammps_packages $plot_packages $postproc_packages
  cmake -S "$root" -B "$build" -G Ninja -DLSM_BUILD_LAMMPS=ON -DLSM_BUILD_SLIDER=ON -DLSM_BUILD_POSTPROC=ON
  cmake --build "$build" --target lmp slider_cli postproc
}
output=${LSM_OUTPUT:-$build/studies/$(basename "$table" .csv)}
mkdir -p "$output"
exec flock -n -F "$output/lock" snakemake --snakefile "$root/inputs/Snakefile" --directory "$output" --cores all \
  --quiet rules --rerun-triggers mtime --nolock --keep-going --keep-incomplete --rerun-incomplete "$@" \
  --config table="$(realpath "$table")" bin="${LSM_BIN:-$build/bin}" "${settings[@]}"
