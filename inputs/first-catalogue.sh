#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# From a fresh Debian 12 or 13 to a first earthquake catalogue: installs what is missing, builds
# LAMMPS with the package (on Debian 13 with the distribution's LAMMPS), runs the fault of length
# 120 on two ranks, prints its largest events, draws the potential energy with the picked events,
# and makes a page on which one explores the run.
#
# usage: inputs/first-catalogue.sh [STEPS]      (default 300000)
# Build folder: build (LSM_BUILD_DIR replaces it), in which 'cmake --build build' makes the rest.
# Results: first-catalogue/ in the build folder (LSM_OUTPUT replaces it). LSM_BIN is the folder of
# programs that are built already. Interrupted, it goes on with what is built, and begins the run
# anew; the files first.* of an earlier time are removed before.
set -euo pipefail
export LC_ALL=C
root=$(cd "$(dirname "$0")/.." && pwd)
for folder in LSM_BIN LSM_BUILD_DIR LSM_OUTPUT; do # seen from here, not from the folder of the run
  [[ -z ${!folder:-} || ${!folder} = /* ]] || printf -v $folder %s "$PWD/${!folder}"
done
steps=${1:-300000}
[[ $steps =~ ^[1-9][0-9]*$ ]] || {
  echo "usage: $0 [STEPS]; '$steps' is not a number of steps" >&2
  exit 2
}
build=${LSM_BUILD_DIR:-$root/build}

bin=${LSM_BIN:-$build/bin} lmp=lmp
if [ -z "${LSM_BIN:-}" ]; then
  . "$root/lammps-pkg/cmake/debian-packages.sh"
  lmp=lmp_fault # a third of LAMMPS' objects
  build_programs "$root" "$build" $lmp postproc
fi
packages_took=${packages_took:-$SECONDS}
programs_took=$((SECONDS - packages_took))

. "$root/inputs/mpi-settings.sh"
run=${LSM_OUTPUT:-$build/first-catalogue}
mkdir -p "$run"
cd "$run"
refuse() {
  echo "first-catalogue.sh: $*" >&2
  exit 1
}
# The lock file also shows that files first.* are from this script.
others=(first.*)
[ -e .first-catalogue.lock ] || [ ! -e "${others[0]}" ] ||
  refuse "$run holds ${others[0]}, which this script did not write, expected another folder (LSM_OUTPUT)"
{ exec 9>>.first-catalogue.lock; } 2>/dev/null || refuse "cannot write to $run"
# Programs of a killed script hold the lock as well; they end within moments.
flock -w 2 9 || refuse "a first-catalogue.sh works in $run already, expected its end or another folder (LSM_OUTPUT)"
rm -f first.*
echo "Running the fault of length 120 for $steps steps of shear in $run"
mpirun -np 2 "$bin/$lmp" -in "$root/inputs/fault_120.in" -var steps "$steps" -var prefix first -var ruptures yes </dev/null
fault_took=$((SECONDS - packages_took - programs_took))

catalogue=first.catalogue.csv
series=first.pe.bin
[ -f $catalogue ] || {
  echo "$run/$catalogue has not been written" >&2
  exit 1
}
[ -f $series ] || {
  echo "$run/$series has not been written" >&2
  exit 1
}

table() { awk -F, '/^#/ { next } !head { head = 1; for (i = 1; i <= NF; i++) c[$i] = i; next }
  { print $c["event_id"], $c["t_start"], $c["t_end"], $c["size"], $c["pe_start"] }' $catalogue; }
count=$(table | wc -l)
echo
echo "$count events. The ten largest:"
printf '%8s %12s %10s %12s\n' event start duration size
table | sort -g -r -k 4,4 |
  awk 'NR <= 10 { printf "%8d %12.2f %10.2f %12.3e\n", $1, $2, $3 - $2, $4 }'
echo
echo "Events by size:"
table | awk '$4 > 0 { d = int(log($4) / log(10) + 1000) - 1000; n[d]++; if (!k++ || d < lo) lo = d; if (k == 1 || d > hi) hi = d }
  END { if (k) for (d = lo; d <= hi; d++) printf "  1e%+03d to 1e%+03d %7d\n", d, d + 1, n[d] }'
echo

# The whole run, and the dozen events around the largest one.
"$bin/postproc" series $series --output first.run --title "Fault of length 120: $count events"
if [ "$count" -gt 1 ]; then
  read -r from to <<<"$(table | awk '
    { s[NR] = $2; e[NR] = $3; if (NR == 1 || $4 > big) { big = $4; at = NR } }
    END { a = at > 6 ? at - 6 : 1; b = at + 5 < NR ? at + 5 : NR
          margin = 0.03 * (e[b] - s[a]); from = s[a] - margin; printf "%.6f %.6f", (from < 0 ? 0 : from), e[b] + margin }')"
  "$bin/postproc" series $series --output first.largest --from "$from" --to "$to" \
    --title "Fault of length 120: around the largest event"
fi
"$bin/postproc" explore $catalogue --output first.html --title "Fault of length 120"
echo "Catalogue, series and pictures are in $run"
echo "Open in a browser to explore the run: file://$run/first.html"
echo "Time: packages $packages_took s, source and programs $programs_took s, the fault $fault_took s," \
  "figures $((SECONDS - packages_took - programs_took - fault_took)) s"
if [ "$count" -lt 100 ]; then
  echo "Only $count events, expected at least 100: give more than $steps steps" >&2
  exit 1
fi
