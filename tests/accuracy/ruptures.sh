#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Error against run time of the rupture benchmarks TPV205-2D, TPV3-2D and TPV101-2D, and the self-similar crack: some
# minutes of CPU time. Then, for results/rupture_varied.py, TPV3-2D with barriers at spacings of 100 m and more, and
# boundary integrals of both. At last TPV3-2D in three random packings, spacings of 100 m and more.
# usage: ruptures.sh LMP INPUTS [SPACING ...]   in an empty folder; spacings 200 100 50
set -euo pipefail
export LC_ALL=C
lmp=$1 inputs=$2 compare=("${LSM_PYTHON:-python3}" "$2/../results/rupture_benchmark.py") # a Python with NumPy
shift 2
[ $# -gt 0 ] || set -- 200 100 50
block=(-var length 60000 -var width 36000 -var tend 6)
run() { # SCENE PREFIX SPACING [SETTINGS]
  "$lmp" -in "$inputs/rupture_$1.in" -log "$2.log" -screen none -var prefix "$2" -var dx "$3" -var overwrite yes "${@:4}" </dev/null
}
for dx in "$@"; do
  for scene in tpv205 tpv3 tpv101 crack; do
    settings=()
    [ "$scene" = crack ] || settings=("${block[@]}")
    [ "$scene" != tpv101 ] || settings=("${block[@]/%6/7}")
    run "$scene" "$scene.$dx" "$dx" "${settings[@]}"
    awk -v scene="$scene" -v dx="$dx" '/^Loop time of/ { t += $4; n = $(NF - 1) }
      END { printf "%s, spacing %g m: %d discs, %.1f s\n", scene, dx, n, t }' "$scene.$dx.log"
  done
done
for scene in tpv205 tpv3 tpv101; do
  histories=("${@/#/$scene.}") until=6
  [ "$scene" != tpv101 ] || until=7
  "${compare[@]}" "${histories[@]/%/.slip.bin}" --reference "$inputs/reference/$scene.csv" --until "$until" -o "$scene"
done
integral=$(dirname "$lmp")/lsm_boundary_integral
for dx in 100 50 25; do "$integral" tpv101 "$dx" 7 1500 >"tpv101.$dx.csv"; done
for factor in 2.2 2.3 2.4 2.5 2.6 1000; do
  for dx in 100 50; do "$integral" tpv3 "$dx" 8 100 barrier="$factor" >"barrier.$factor.$dx.csv"; done
  for dx in "$@"; do
    [ "$dx" -lt 100 ] || run tpv3 "barrier.$factor.$dx" "$dx" "${block[@]/%6/8}" -var barrier "$factor"
  done
done
packings=()
for dx in "$@"; do
  [ "$dx" -ge 100 ] || continue
  for seed in 1 2 3; do
    run tpv3 "packing.$dx.$seed" "$dx" -var blocks packing -var seed "$seed" "${block[@]}"
    packings+=("packing.$dx.$seed.slip.bin")
  done
done
[ ${#packings[@]} -gt 0 ] || exit 0
# The reference for the packing has its ratio of wave speeds.
"$integral" tpv3 50 6 1500 ratio=1.913 >packing-reference.csv
"${compare[@]}" "${packings[@]}" --reference packing-reference.csv --until 6 -o packing
