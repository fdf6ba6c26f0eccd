#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# The default fault sticks and slips, and the measure of it distinguishes a creeping one.
# usage: stick-slip.sh LMP POSTPROC SOURCE_DIR
set -euo pipefail
export LC_ALL=C
lmp=$1 postproc=$2 source=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*" >&2; tail -n 20 out >&2; exit 1; }

# regime NAME VARIABLES...: runs half the shortest fault of the paper; word, saw_tooth and in_events
# from postproc series
regime() {
  local name=$1
  shift
  "$lmp" -in "$source/inputs/fault.in" -var length 60 -var steps 90000 -var prefix "$name" "$@" </dev/null >out 2>&1 ||
    fail "lmp of $name"
  "$postproc" series "$name.pe.bin" --from 3000 -o "$name" --json "$name.json" >out 2>&1 || fail "postproc series of $name"
  number() { sed -n "s/^ *\"$1\": \"*\([a-z0-9.e+-]*\)\"*,*$/\1/p" "$name.json"; }
  word=$(number regime) saw_tooth=$(number saw_tooth) in_events=$(number time_in_events)
  [ -n "$word" ] && [ -n "$saw_tooth" ] && [ -n "$in_events" ] || fail "no regime of $name"
  echo "$name: $word, saw-tooth $saw_tooth, $in_events of the time in events"
}
regime default
[ "$word" = stick-slip ] || fail "the default fault is called $word"
# Seed 1 has 6.6 and 0.26.
awk -v s="$saw_tooth" -v t="$in_events" 'BEGIN { exit !(s > 5 && t < 0.3) }' || fail "the default fault hardly sticks"
# A disc for which the time step is too large oscillates from step to step, each time an event.
brief=$(awk -F, '!/^[#e]/ && $5 - $4 <= 3 && $6 >= 1e-4' default.catalogue.csv | wc -l)
[ "$brief" = 0 ] || fail "$brief events from 1e-4 within 3 steps: the time step of the preset is unstable"
regime creeping -var stress 0.004
[ "$word" = creep ] || fail "the fault at stress 0.004 is called $word"
awk -v s="$saw_tooth" -v t="$in_events" 'BEGIN { exit !(s < 3 && t > 0.3) }' || fail "the fault at stress 0.004 does not creep"
