#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Speed of the block-slider on one core: the straightforward loop over all blocks and the active set,
# run in turn so that both see the same machine; then the cost against the number of blocks. Usage: bench_slider.sh SLIDER_CLI PLAIN_LOOP [STEPS [ROUNDS]]
set -eu
export LC_ALL=C
program=$1
plain_loop=$2
steps=${3:-1e7}
rounds=${4:-3}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
seconds() {
  "$program" "$@" --overwrite --catalogue "$folder/c.csv" --json - | awk '/"seconds"/ {print $2 + 0}'
}
echo "N = 1928, $steps steps, dt 0.01, PE every step; seconds"
for scheme in printed verlet; do
  rm -f "$folder/scalar" "$folder/active"
  for ((round = 1; round <= rounds; ++round)); do
    "$plain_loop" $scheme 1928 0.01 "$steps" >>"$folder/scalar"
    seconds --blocks 1928 --dt 0.01 --steps "$steps" --picker-lambda 0.99 --scheme $scheme \
      >>"$folder/active"
  done
  paste "$folder/scalar" "$folder/active" | awk -v scheme=$scheme '
    {printf "%-14s scalar %8.2f  active %8.2f  scalar/active %6.2f\n", scheme, $1, $2, $1 / $2}'
done
# Loading up to the first slip, near t = 5000, is skipped.
echo "cost of the active set against N, verlet, dt 0.01, the first 500 time units of slip"
for blocks in 1000 10000 100000 1000000; do
  "$program" --blocks $blocks --dt 0.01 --steps 550000 --warmup 0 \
    --overwrite --catalogue "$folder/n.csv" \
    --json "$folder/a.json" >/dev/null
  awk -v n=$blocks '/"nanosec/ {t = $2 + 0} /"moving_f/ {m = $2 * n}
    END {printf "N %8d  %10.1f ns/step  %10.1f blocks moving on average  %6.2f ns per moving block\n",
         n, t, m, (m > 0 ? t / m : 0)}' "$folder/a.json"
done
