#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Draws a potential energy series with the picked events, after Figs. 8 to 11 of Weatherley and Abe
# (2004): potential energy, its change per step, the smoothed change; events shaded, and an arrow
# for the size of each.
#
# usage: plot-pe-series.sh CATALOGUE SERIES OUT [T0 T1]
#   CATALOGUE  catalogue file of the run
#   SERIES     PE series of the run, text or binary
#   OUT        name of the pictures without extension: OUT.png and OUT.svg are written
#   T0 T1      time window; the whole series when left out
# LSM_PLOT_TITLE in the environment replaces the title.
set -euo pipefail
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
if [ $# -ne 3 ] && [ $# -ne 5 ]; then
  sed -n 's/^# \{0,1\}//; /^usage/,/^LSM_PLOT/p' "$0" >&2
  exit 2
fi
fail() { echo "plot-pe-series: $*" >&2; exit 1; }
catalogue=$1 series=$2 out=$3 t0=${4:-} t1=${5:-}
for f in "$catalogue" "$series"; do
  [ -r "$f" ] || fail "$f: cannot be read"
done
number='^[+-]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)?$'
for t in ${t0:+"$t0"} ${t1:+"$t1"}; do
  [[ $t =~ $number ]] || fail "time window: '$t' is not a number"
done
command -v gnuplot >/dev/null || fail "gnuplot not found (Debian package gnuplot-nox)"
head -c 15 "$catalogue" | grep -q '^# lsm-catalogue' || fail "$catalogue:1: expected '# lsm-catalogue 1'"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# ---- the series as rows "time pe" ---------------------------------------------------------------
# Binary: 16 bytes "lsm-pe-series-1\n", length of the header (8 bytes), header text, then records of
# step (8-byte integer) and PE (8-byte float).
rows() {
  if [ "$(head -c 15 "$series" | tr -d '\0')" = "lsm-pe-series-1" ]; then
    local bytes
    bytes=$(od -A n -t d8 -j 16 -N 8 "$series" | tr -d ' ')
    [ -n "$bytes" ] && [ "$bytes" -ge 0 ] || fail "$series: the header is torn"
    tail -c +25 "$series" | head -c "$bytes" | tr -d '\0' >"$work/header" || true
    local dt step0 time0
    value() { sed -n "s/^#\{0,1\} *$1 *= *//p" "$work/header" | head -n 1; }
    dt=$(value dt) step0=$(value step0) time0=$(value time0)
    [ -n "$dt" ] || fail "$series: the header does not give dt"
    # od prints each record twice, as integers on one line and as floats on the next.
    od -A n -v -w16 -t d8 -t f8 -j $((24 + bytes)) "$series" |
      awk -v dt="$dt" -v s0="${step0:-0}" -v tm="${time0:-0}" '
        NR % 2 { step = $1; next } NF == 2 { printf "%.12g %s\n", tm + (step - s0) * dt, $2 }'
  else
    head -n 1 "$series" | grep -q '^# lsm-pe-series' ||
      fail "$series:1: expected '# lsm-pe-series 1' or a binary series"
    awk -F, '/^#/ { next }
      !seen { seen = 1; if ($1 != "step" || $2 != "time" || $3 != "pe") {
                print "plot-pe-series: line " FNR ": expected the columns step,time,pe" > "/dev/stderr"; exit 1 }
              next }
      { print $2, $3 }' "$series"
  fi
}

# The smoothing of the picture is the one the events were picked with, read from the catalogue.
parameter() {
  awk -v names=" $* " '!/^#/ { exit }
    match($0, /^# *[A-Za-z_]+ *= */) {
      name = substr($0, 2, RLENGTH - 1); gsub(/[ =]/, "", name)
      if (index(names, " " name " ")) { print substr($0, RLENGTH + 1); exit } }' "$catalogue"
}
lambda=$(parameter picker_lambda lambda)
[[ $lambda =~ $number ]] || lambda=0.99
reading=$(parameter picker picker_reading reading)
case $reading in
  exponential | average | literal) ;;
  *) reading=exponential ;;
esac

# ---- curves, thinned to a few thousand points that keep every extreme --------------------------
rows >"$work/rows"
[ -s "$work/rows" ] || fail "$series: no samples"
range=$(awk -v a="$t0" -v b="$t1" '
  NR == 1 { first = $1 } { last = $1 }
  END { print (a == "" ? first : a), (b == "" ? last : b) }' "$work/rows")
read -r t0 t1 <<<"$range"
awk -v a="$t0" -v b="$t1" 'BEGIN { exit !(b > a) }' || fail "time window: end $t1 is not after start $t0"
awk -v a="$t0" -v b="$t1" -v lambda="$lambda" -v reading="$reading" -v bins=1500 -v dir="$work" '
  # Each bin gives its smallest and largest value, in the order in which they came.
  function put(c, t, v,    k) {
    k = int((t - a) / (b - a) * bins)
    if (!(c in bin) || k != bin[c]) { flush(c); bin[c] = k; lo[c] = hi[c] = v; tlo[c] = thi[c] = t }
    if (v < lo[c]) { lo[c] = v; tlo[c] = t }
    if (v > hi[c]) { hi[c] = v; thi[c] = t }
  }
  function flush(c,    file) {
    if (!(c in bin)) return
    file = dir "/" c
    if (tlo[c] < thi[c]) printf "%.12g %.17g\n%.12g %.17g\n", tlo[c], lo[c], thi[c], hi[c] > file
    else printf "%.12g %.17g\n%.12g %.17g\n", thi[c], hi[c], tlo[c], lo[c] > file
  }
  NR > 1 {
    x = $2 - pe
    if (reading == "average") smooth = (x + lambda * smooth) / (1 + lambda)
    else if (reading == "literal") smooth = (x + lambda * smooth) / (1 + lambda * (NR - 2))
    else smooth = lambda * smooth + (1 - lambda) * x
  }
  { pe = $2 }
  $1 >= a && $1 <= b {
    n++
    put("pe", $1, pe)
    if (NR > 1) { put("change", $1, x); put("smooth", $1, smooth) }
  }
  END { flush("pe"); flush("change"); flush("smooth"); exit n < 3 }
' "$work/rows" || fail "$series: fewer than 3 samples between $t0 and $t1"

# ---- events: start, end, PE at start and end, size ----------------------------------------------
awk -F, -v a="$t0" -v b="$t1" '
  /^#/ { next }
  !n { for (i = 1; i <= NF; i++) col[$i] = i
       n = 1
       if (!("t_start" in col) || !("t_end" in col) || !("size" in col) || !("pe_start" in col)) {
         print "plot-pe-series: line " FNR ": expected the columns t_start, t_end, size, pe_start" > "/dev/stderr"
         exit 1 }
       next }
  $col["t_end"] >= a && $col["t_start"] <= b {
    print $col["t_start"], $col["t_end"], $col["pe_start"], $col["pe_start"] - $col["size"], $col["size"] }
' "$catalogue" >"$work/events" || fail "$catalogue: the table cannot be read"

title=${LSM_PLOT_TITLE:-}
[ -n "$title" ] || title="$(wc -l <"$work/events") events, time $(printf '%.6g to %.6g' "$t0" "$t1")"
mkdir -p "$(dirname "$out")"
for format in png svg; do
  gnuplot -c "$here/plot_pe_series.gnuplot" "$work" "$work/picture.$format" "$format" "$t0" "$t1" "$title" "$lambda" "$reading" \
    </dev/null || fail "gnuplot cannot draw $out.$format"
  mv "$work/picture.$format" "$out.$format"
done
echo "$out.png"
echo "$out.svg"
