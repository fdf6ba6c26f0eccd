#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Error against run time of the rupture benchmarks TPV205-2D and TPV3-2D, and the self-similar crack: some minutes of CPU
# time.
# At last TPV3-2D in three random packings, spacings of 100 m and more.
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
  for scene in tpv205 tpv3 crack; do
    settings=()
    [ "$scene" = crack ] || settings=("${block[@]}")
    run "$scene" "$scene.$dx" "$dx" "${settings[@]}"
    awk -v scene="$scene" -v dx="$dx" '/^Loop time of/ { t += $4; n = $(NF - 1) }
      END { printf "%s, spacing %g m: %d discs, %.1f s\n", scene, dx, n, t }' "$scene.$dx.log"
  done
done
for scene in tpv205 tpv3; do
  histories=("${@/#/$scene.}")
  "${compare[@]}" "${histories[@]/%/.slip.bin}" --reference "$inputs/reference/$scene.csv" --until 6 -o "$scene"
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
"$(dirname "$lmp")/lsm_boundary_integral" tpv3 50 6 1500 1.913 >packing-reference.csv
"${compare[@]}" "${packings[@]}" --reference packing-reference.csv --until 6 -o packing
