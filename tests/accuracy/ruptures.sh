#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Error against run time of the rupture benchmarks TPV205-2D and TPV3-2D, and the self-similar crack: some minutes of CPU
# time.
# At last TPV3-2D in three random packings, spacings of 100 m and more.
# usage: ruptures.sh LMP POSTPROC INPUTS [SPACING ...]   in an empty folder; spacings 200 100 50
set -euo pipefail
export LC_ALL=C
lmp=$1 postproc=$2 inputs=$3
shift 3
[ $# -gt 0 ] || set -- 200 100 50
for dx in "$@"; do
  for scene in tpv205 tpv3 crack; do
    limits=()
    [ "$scene" = crack ] || limits=(-var length 60000 -var width 36000 -var tend 6)
    "$lmp" -in "$inputs/rupture_$scene.in" -log "$scene.$dx.log" -screen none -var dx "$dx" "${limits[@]}" \
      -var prefix "$scene.$dx" -var overwrite yes </dev/null
    awk -v scene="$scene" -v dx="$dx" '/^Loop time of/ { t += $4; n = $(NF - 1) }
      END { printf "%s, spacing %g m: %d discs, %.1f s\n", scene, dx, n, t }' "$scene.$dx.log"
  done
done
for scene in tpv205 tpv3; do
  histories=("${@/#/$scene.}")
  "$postproc" benchmark "${histories[@]/%/.slip.bin}" --reference "$inputs/reference/$scene.csv" --until 6 -o "$scene"
done
packings=()
for dx in "$@"; do
  [ "$dx" -ge 100 ] || continue
  for seed in 1 2 3; do
    "$lmp" -in "$inputs/rupture_tpv3.in" -log "packing.$dx.log" -screen none -var blocks packing -var seed "$seed" \
      -var dx "$dx" -var length 60000 -var width 36000 -var tend 6 -var prefix "packing.$dx.$seed" -var overwrite yes </dev/null
    packings+=("packing.$dx.$seed.slip.bin")
  done
done
# that of the packing: its ratio of wave speeds
"$(dirname "$lmp")/lsm_boundary_integral" tpv3 50 6 1500 1.913 >packing.csv
"$postproc" benchmark "${packings[@]}" --reference packing.csv --until 6 -o packing
