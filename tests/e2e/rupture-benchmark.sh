#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# TPV205-2D and TPV3-2D at 200 m until 6 s compared with the references: slip, arrivals, table and
# picture.
# usage: rupture-benchmark.sh LMP POSTPROC SOURCE_DIR
set -euo pipefail
export LC_ALL=C
lmp=$1 postproc=$2 source=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*" >&2; [ -f out ] && tail -n 20 out >&2; exit 1; }

"$lmp" -in "$source/inputs/rupture_tpv205.in" -log none -var dx 200 -var length 60000 -var width 30000 -var tend 6 \
  -var prefix run </dev/null >out 2>&1 || fail "rupture_tpv205.in"
command -v gnuplot >/dev/null && picture= || picture=--no-picture
"$postproc" benchmark run.slip.bin --reference "$source/inputs/reference/tpv205.csv" -o beside $picture >out 2>&1 ||
  fail "postproc benchmark"
[ -n "$picture" ] || { [ -s beside.png ] && [ -s beside.svg ]; } || fail "no picture"

# Slip within 1.5 % and arrivals within 0.15 s, up to 12 km, against both references.
awk -F, '/^#|^run,/ { next }
  $4 >= -12000 && $4 <= 12000 {
    late = $5 - $6; more = $7 / $8 - 1; n[$3]++
    if (late < 0) late = -late
    if (more < 0) more = -more
    if (late > worst_late) worst_late = late
    if (more > worst_more) worst_more = more
  }
  END {
    printf "arrivals within %.4f s, slip within %.3f %%\n", worst_late, 100 * worst_more
    exit !(n["PyLith 200 m"] == 5 && n["boundary integral 25 m"] == 17 && worst_late < 0.15 && worst_more < 0.015)
  }' beside-stations.csv || fail "arrivals or slip are off"

# TPV3-2D, within 0.08 s
"$lmp" -in "$source/inputs/rupture_tpv3.in" -log none -var dx 200 -var length 60000 -var width 30000 -var tend 6 \
  -var prefix tpv3 </dev/null >out 2>&1 || fail "rupture_tpv3.in"
"$postproc" benchmark tpv3.slip.bin --reference "$source/inputs/reference/tpv3.csv" -o three --no-picture >out 2>&1 ||
  fail "postproc benchmark of TPV3"
awk -F, '/^#|^run,/ { next }
  $4 >= -12000 && $4 <= 12000 {
    late = $5 - $6; more = $7 / $8 - 1; n++
    if (late < 0) late = -late
    if (more < 0) more = -more
    if (late > worst_late) worst_late = late
    if (more > worst_more) worst_more = more
  }
  END {
    printf "TPV3: arrivals within %.4f s, slip within %.3f %%\n", worst_late, 100 * worst_more
    exit !(n == 17 && worst_late < 0.08 && worst_more < 0.015)
  }' three-stations.csv || fail "arrivals or slip of TPV3 are off"

# A place between two bins, and what is refused.
reference() { # PLACE TIME...
  local place=$1 t
  shift
  echo curve,x,t,slip,slip_rate
  for t; do echo "by hand,$place,$t,$t,1.5"; done
}
reference 1234 0 3 6 >columns
"$postproc" benchmark run.slip.bin --reference columns -o one --no-picture >out || fail "a place between two bins"
grep -q "by hand" out || fail "a reference without a name"
reference 99999 0 3 6 >columns
! "$postproc" benchmark run.slip.bin --reference columns -o two --no-picture >out 2>&1 || fail "a place beyond the fault"
grep -q "no slip at x = 99999" out || fail "message of a place beyond the fault"
reference 0 1 1 >columns
! "$postproc" benchmark run.slip.bin --reference columns -o two --no-picture >out 2>&1 || fail "times that stand"
grep -q "columns:3: time 1, expected increasing times" out || fail "message of times that stand: $(cat out)"
[ ! -e two.csv ] || fail "half-written output"
