#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Work-precision of catalogues: what do time step, smallest mass, onset of contacts and tangential stiffness cost, and what do they
# change in the statistics? Length 120, several packings; one table, one figure. Run it again to go on with the runs that are not done.
set -euo pipefail
export LC_ALL=C
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${LSM_BUILD_DIR:-$root/build}
output=$build/work-precision bin=$build/bin time=72000 seeds="1 2 3" run=yes
# time step, smallest mass, onset, kt: the first is the one that the others are compared with
ways="0.03 0 located 1
0.06 0 located 1
0.12 0.04 located 1
0.15 0.04 located 1
0.18 0.09 located 1
0.12 0.04 step 1
0.12 0.04 located 0.3
0.09 0.04 located 3"

usage() {
  cat <<END
usage: tests/accuracy/catalogues.sh [OPTIONS]
  --output DIR    folder of the runs, the table and the figure [$output]
  --bin DIR       folder of lmp and postproc [$bin]
  --time T        time units of shear of each run [$time]
  --seeds "N ..." packings [$seeds]
  --table         only make table and figure of the runs that are done
END
}
while [ $# -gt 0 ]; do
  case $1 in
    --help | -h) usage; exit 0 ;;
    --table) run=no; shift ;;
    --output | --bin | --time | --seeds)
      [ $# -ge 2 ] || { echo "catalogues: $1 needs a value" >&2; exit 2; }
      declare "${1#--}=$2"; shift 2 ;;
    *) echo "catalogues: unknown option '$1' (--help lists the options)" >&2; exit 2 ;;
  esac
done
[[ $time =~ ^[0-9.e+]+$ ]] || { echo "catalogues: --time = '$time', expected a number above 0" >&2; exit 2; }
[[ $seeds =~ ^[0-9\ ]+$ ]] || { echo "catalogues: --seeds = '$seeds', expected numbers" >&2; exit 2; }
for program in lmp postproc; do
  [ -x "$bin/$program" ] || { echo "catalogues: no program $bin/$program" >&2; exit 2; }
done
mkdir -p "$output" && output=$(cd "$output" && pwd) && bin=$(cd "$bin" && pwd)

# one SEED DT FLOOR ONSET KT: a run is done when cpu.txt is there, with the CPU seconds it took
one() {
  local folder=$output/$2_$3_$4_$5/seed_$1 TIMEFORMAT='%U %S'
  [ ! -e "$folder/cpu.txt" ] || return 0
  rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
  { time "$bin/lmp" -in "$root/inputs/fault_120.in" -log none -var prefix fault -var seed "$1" -var dt "$2" -var massfloor "$3" -var onset "$4" \
    -var kt "$5" -var steps "$(awk -v t="$time" -v dt="$2" 'BEGIN { printf "%.0f", t / dt }')" -var series no >output.txt 2>&1 </dev/null; } 2>time.txt || {
    echo "catalogues: $folder: $(grep -m 1 ERROR output.txt || echo "lmp failed, see output.txt")" >&2
    return 1
  }
  awk '{ print $1 + $2 }' time.txt >cpu.txt
}
if [ $run = yes ]; then
  for seed in $seeds; do
    while read -r dt floor onset kt; do (one "$seed" "$dt" "$floor" "$onset" "$kt"); done <<<"$ways"
  done
fi

cd "$output"
to=$(awk -v t="$time" 'BEGIN { printf "%.10g", 1200 + t }')
# shellcheck disable=SC2016
named='/^[^#]/ && !head { head = 1; for (i = 1; i <= NF; i++) c[$i] = i; next } /^#/ { next }'
echo "dt,massfloor,onset,kt,seed,cpu_s,events_1e-4,events_1e-3,events_1e-2,events_1e-1,largest,released,exponent,exponent_error,gamma,gamma_error,p_size,p_time,bursts" >runs.csv
while read -r dt floor onset kt; do
  for seed in $seeds; do
    folder=${dt}_${floor}_${onset}_$kt/seed_$seed
    [ -e "$folder/cpu.txt" ] || continue
    # Bursts, events of 1e-3 and more that end within 3 steps of their begin, are numbers gone wrong and left out of the rest.
    awk -F, '/^[#e]/ || !($6 >= 1e-3 && $5 - $4 <= 3)' "$folder/fault.catalogue.csv" >"$folder/clean.csv"
    "$bin/postproc" fit "$folder/clean.csv" --to "$to" --range 1e-3:1 --replicas 0 --no-comparison --no-picture -o "$folder/fit" >/dev/null
    "$bin/postproc" intervals "$folder/clean.csv" --to "$to" --threshold 1e-3 --method likelihood --delta 1 --replicas 0 --no-picture \
      -o "$folder/times" >/dev/null
    against=$(head -1 <<<"$ways" | tr ' ' _)/seed_$seed p=,
    if [ "$folder" != "$against" ] && [ -e "$against/clean.csv" ]; then
      "$bin/postproc" compare "$against/clean.csv" "$folder/clean.csv" --label first --label second --threshold 1e-3 --to "$to" -o "$folder/compare" >/dev/null
      p=$(awk -F, "$named"' { p[$c["quantity"]] = $c["p"] } END { printf "%.2g,%.2g", p["size"], p["time"] }' "$folder/compare.csv")
    fi
    awk -F, -v to="$to" -v start="$dt,$floor,$onset,$kt,$seed,$(cat "$folder/cpu.txt")" -v p="$p" \
      -v all="$(awk -F, '!/^[#e]/' "$folder/fault.catalogue.csv" | wc -l)" \
      -v fit="$(awk -F, "$named"' { e = sprintf("%.4f,%.4f", $c["exponent"], $c["standard_error"]) } END { print e }' "$folder/fit.fits.csv")" \
      -v gamma="$(awk -F, "$named"' $1 == "ours" { printf "%.4f,%.4f", $c["gamma"], $c["gamma_error"] }' "$folder/times.table1.csv")" \
      '/^[#e]/ { next } { n++ } $2 < to { for (k = 1; k <= 4; k++) if ($6 >= 10 ^ (k - 5)) m[k]++; if ($6 >= 1e-3) sum += $6; if ($6 > most) most = $6 }
      END { printf "%s,%d,%d,%d,%d,%.4g,%.4g,%s,%s,%s,%d\n", start, m[1], m[2], m[3], m[4], most, sum, fit, gamma, p, all - n }' "$folder/clean.csv" >>runs.csv
  done
done <<<"$ways"

# Means over the packings, each beside the same packing of the first way; the error is that of the mean of these differences.
awk -F, -v time="$time" '
  NR == 1 { next }
  { w = $1 "," $2 "," $3 "," $4
    if (!(w in n)) { order[++ways] = w; if (ways == 1) first = w }
    s = $5; n[w]++; seed[w, n[w]] = s; cpu[w] += $6; large[w] += $9; lost[w] += $19
    v[w, s, 1] = log($8); v[w, s, 2] = log($9); v[w, s, 3] = $13; v[w, s, 4] = $15; v[w, s, 5] = log($12)
    if ($17 != "") { if (!(w in ps) || $17 < ps[w]) ps[w] = $17; if (!(w in pt) || $18 < pt[w]) pt[w] = $18 } }
  END {
    print "# Statistics of the fault of length 120 against time step, smallest mass, onset of contacts and tangential stiffness, " time " time units for each packing"
    print "# Differences from the first line, mean over packings with its error; rate: numbers of events of 1e-3 (1e-2) and more, released: their sizes, as shares;"
    print "# exponent: sizes 1e-3 to 1, gamma: times between events of 1e-3 and more; p: least of the two-sample tests of a packing; bursts: left out"
    print "dt,massfloor,onset,kt,packings,time_per_core_hour,large_per_core_hour,rate,rate_error,rate_1e-2,rate_1e-2_error,exponent,exponent_error,gamma,gamma_error,released,released_error,p_size,p_time,bursts"
    for (k = 1; k <= ways; k++) { w = order[k]
      printf "%s,%d,%.4g,%.4g", w, n[w], time * n[w] / cpu[w] * 3600, large[w] / cpu[w] * 3600
      for (q = 1; q <= 5; q++) { sum = squares = m = 0
        for (i = 1; i <= n[w]; i++) { s = seed[w, i]; if (!((first, s, q) in v)) continue
          d = v[w, s, q] - v[first, s, q]; m++; sum += d; squares += d * d }
        if (!m) { printf ",,"; continue }
        mean = sum / m
        rest = squares - m * mean * mean
        printf ",%.4f,%s", mean, (m > 1 ? sprintf("%.4f", sqrt((rest > 0 ? rest : 0) / (m - 1) / m)) : "") }
      printf ",%s,%s,%d\n", ps[w], pt[w], lost[w] } }' runs.csv >catalogues.csv.new && mv catalogues.csv.new catalogues.csv

cat >catalogues.gp <<'END'
# Draws catalogues.png and catalogues.svg from catalogues.csv
set datafile separator ","
do for [kind in "png svg"] {
if (kind eq "png") { set terminal pngcairo size 1800,750 font "DejaVu Sans,20" linewidth 2 pointscale 2 background "#ffffff" } \
else { set terminal svg size 900,375 dynamic font "DejaVu Sans,10" background "#ffffff" }
set output "catalogues.".kind
set encoding utf8
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid xtics ytics lt 1 lw 0.5 lc rgb "#d8d8d8"
set multiplot layout 1,3 margins 0.06,0.985,0.19,0.9 spacing 0.065,0
set logscale x
set xrange [most/12.:most*2]
set xlabel "model time for a core-hour"
set xtics format "10^{%L}"
# rows of the table by number
row(n) = sprintf("%d", n + 1)
set key off
set title "Number of events from 10^{-3}, share off"
set yrange [-0.1:0.1]
plot 0 lc rgb "#888888" dt 2, "catalogues.csv" using 6:8:9 every ::1 with yerrorbars pt 7 lc rgb "#0072B2", "" using 6:8:(row($0)) every ::1 with labels offset 1,0.6
set title "Exponent (10^{-3} to 1), off"
plot 0 lc rgb "#888888" dt 2, "catalogues.csv" using 6:12:13 every ::1 with yerrorbars pt 5 lc rgb "#D55E00", "" using 6:12:(row($0)) every ::1 with labels offset 1,0.6
set title "γ of the times between events, off"
set yrange [-0.3:0.3]
plot 0 lc rgb "#888888" dt 2, "catalogues.csv" using 6:14:15 every ::1 with yerrorbars pt 9 lc rgb "#009E73", "" using 6:14:(row($0)) every ::1 with labels offset 1,0.6
unset multiplot
set output
}
END
LC_ALL=C.UTF-8 gnuplot -e "most = $(awk -F, '/^[#d]/ { next } $6 > m { m = $6 } END { print m }' catalogues.csv)" catalogues.gp
cat catalogues.csv
