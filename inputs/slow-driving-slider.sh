#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# How do the statistics of the block-slider depend on the driving velocity? With leaps over slow loading (slider_cli --leap) and
# without; one table, one figure. Run it again to go on with the runs that are not done.
set -uo pipefail
export LC_ALL=C
root=$(cd "$(dirname "$0")/.." && pwd)
build=${LSM_BUILD_DIR:-$root/build}
output=$build/slow-driving-slider bin=$build/bin run=yes long=no begin=120
# blocks, seed, velocity, --leap, way of the plate
runs="256 1 1e-2 0 1200
256 1 1e-3 0 3720
256 2 1e-3 0 3720
256 1 1e-4 0 3720
256 1 1e-3 1e-3 3720
256 1 1e-4 1e-3 3720
256 1 1e-5 1e-3 3720
256 1 1e-6 1e-3 3720
256 1 1e-7 1e-3 3720
256 1 1e-5 1e-2 3720
256 1 1e-5 1e-4 3720
256 2 1e-3 1e-3 3720
256 2 1e-4 1e-3 3720
256 2 1e-5 1e-3 3720
256 2 1e-6 1e-3 3720
1928 1 1e-2 0 1120
1928 1 1e-3 0 1120
1928 1 1e-3 1e-3 1120
1928 1 1e-4 1e-3 1120
1928 1 1e-5 1e-3 1120
1928 1 1e-6 1e-3 1120"
# Minutes each; the last for a way to its second large event only.
long_runs="256 2 1e-4 0 1200
1928 1 1e-4 0 300
256 1 1e-5 0 500
256 1 1e-6 0 130"

usage() {
  cat <<END
usage: inputs/slow-driving-slider.sh [OPTIONS]
  --output DIR    folder of the runs, the table and the figure [$output]
  --bin DIR       folder of slider_cli and postproc [$bin]
  --long          also runs without leaps at 1e-4 to 1e-6 that take minutes
  --table         only make table and figure of the runs that are done
END
}
while [ $# -gt 0 ]; do
  case $1 in
    --help | -h) usage; exit 0 ;;
    --table) run=no; shift ;;
    --long) long=yes; shift ;;
    --output | --bin)
      [ $# -ge 2 ] || { echo "slow-driving-slider: $1 needs a value" >&2; exit 2; }
      declare "${1#--}=$2"; shift 2 ;;
    *) echo "slow-driving-slider: unknown option '$1' (--help lists the options)" >&2; exit 2 ;;
  esac
done
for program in slider_cli postproc; do
  [ -x "$bin/$program" ] || { echo "slow-driving-slider: no program $bin/$program" >&2; exit 2; }
done
mkdir -p "$output" && bin=$(cd "$bin" && pwd) && cd "$output" || exit 1

# one BLOCKS SEED VELOCITY LEAP WAY: a run is done when its .cpu is there, with the CPU seconds it took
one() {
  local name=$1_$2_$3_$4 TIMEFORMAT='%U %S' more=()
  [ ! -e "$name.cpu" ] || return 0
  [ "$4" = 0 ] || more=(--leap "$4")
  { time "$bin/slider_cli" --blocks "$1" --seed "$2" --velocity "$3" "${more[@]}" --time "$(awk -v v="$3" -v w="$5" 'BEGIN { printf "%.0f", w / v }')" \
    --warmup 0 --catalogue "$name.csv" --json "$name.json" --overwrite >"$name.txt" 2>&1; } 2>time.txt || {
    echo "slow-driving-slider: $name: $(head -n 1 "$name.txt")" >&2
    return 1
  }
  awk '{ print $1 + $2 }' time.txt >"$name.cpu"
}
if [ $run = yes ]; then
  while read -r blocks seed velocity leap way; do one "$blocks" "$seed" "$velocity" "$leap" "$way"; done <<<"$runs"
  [ $long = no ] || while read -r blocks seed velocity leap way; do one "$blocks" "$seed" "$velocity" "$leap" "$way"; done <<<"$long_runs"
fi

# shellcheck disable=SC2016
named='/^[^#]/ && !head { head = 1; for (i = 1; i <= NF; i++) c[$i] = i; next } /^#/ { next }'
number() { sed -n "s/^ *\"$1\": \([0-9.e+-]*\),*$/\1/p" "$2"; }
{
  echo "# Statistics of the block-slider against the driving velocity, from a way of $begin on; times between events as ways of the plate"
  echo "# events: per way of 1000; exponent: sizes 1 to 100; gamma: times between events of 1 (100) and more, delta = 1; share_small: of the events of"
  echo "# 0.01 and more those below 1; p: two-sample tests of sizes from 1 and of the ways between against the run of the same chain and velocity without"
  echo "# leaps, if there is one; steps: taken, neither jumped nor leapt over"
  echo -n "blocks,seed,velocity,leap,way,events_0.01,events_1,events_100,events_1000,largest,exponent,exponent_error,gamma,gamma_error,gamma_100,"
  echo "gamma_100_error,share_small,p_size,p_time,leaps,steps,steps_per_100,cpu_s,model_time_per_cpu_s"
  sort -u <<<"$runs
$long_runs" | sort -k1,1n -k2,2n -k3,3gr -k4,4g | while read -r blocks seed velocity leap _; do
    name=${blocks}_${seed}_${velocity}_$leap whole=${blocks}_${seed}_${velocity}_0
    [ -e "$name.cpu" ] || continue
    from=$(awk -v v="$velocity" -v b=$begin 'BEGIN { printf "%.0f", b / v }')
    "$bin/postproc" fit "$name.csv" --from "$from" --range 1:100 --replicas 0 --no-comparison --no-picture -o "$name.fit" >/dev/null 2>&1
    for size in 1 100; do
      "$bin/postproc" intervals "$name.csv" --from "$from" --threshold $size --method likelihood --delta 1 --replicas 0 --no-picture -o "$name.times_$size" >/dev/null 2>&1
    done
    p=,
    if [ "$leap" != 0 ] && [ -e "$whole.cpu" ]; then
      p=$("$bin/postproc" compare "$whole.csv" "$name.csv" --label without --label leaps --displacement --threshold 1 --from $begin -o "$name.compare" >/dev/null 2>&1 &&
        awk -F, "$named"' { p[$c["quantity"]] = $c["p"] } END { printf "%.2g,%.2g", p["size"], p["time"] }' "$name.compare.csv") || p=,
    fi
    awk -F, -v from="$from" -v begin=$begin -v v="$velocity" -v key="$blocks,$seed,$velocity,$leap" -v p="$p" -v time="$(number time "$name.json")" \
      -v steps="$(number steps "$name.json")" -v jumped="$(number steps_jumped "$name.json")" -v leapt="$(number steps_leapt "$name.json")" \
      -v leaps="$(number leaps "$name.json")" -v cpu="$(cat "$name.cpu")" \
      -v fits="$(awk -F, "$named"' { e = sprintf("%.3f,%.3f", $c["exponent"], $c["standard_error"]) } END { print e ? e : "," }' "$name.fit.fits.csv")" \
      -v gamma="$(for size in 1 100; do awk -F, "$named"' $1 == "ours" { e = sprintf("%.3f,%.3f", $c["gamma"], $c["gamma_error"]) } END { print e ? e : "," }' \
        "$name.times_$size.table1.csv" 2>/dev/null; done | paste -sd,)" \
      '/^[#e]/ { next }
      { if ($6 >= 100) n100++ }
      $2 >= from { if ($6 >= 0.01) small++; if ($6 >= 1) n1++; if ($6 >= 100) large++; if ($6 >= 1000) n1000++; if ($6 > most) most = $6 }
      END { way = time * v - begin; taken = steps - jumped - leapt; k = 1000 / way
        if (way > 50) printf "%s,%.0f,%.0f,%.0f,%.1f,%.1f,%.0f,%s,%s,%.3f,%s,%d,%d,%.0f,%.3g,%.3g\n", key, way, small * k, n1 * k, large * k, n1000 * k, most, fits, gamma,
          small ? (small - n1) / small : 0, p, leaps, taken, taken / n100, cpu, time / cpu
        else printf "%s,%.0f,,,,,%.0f,,,,,,,,,,%d,%d,%.0f,%.3g,%.3g\n", key, way, most, leaps, taken, taken / n100, cpu, time / cpu }' "$name.csv"
  done
} >slow-driving-slider.csv.new && mv slow-driving-slider.csv.new slow-driving-slider.csv || exit 1

cat >slow-driving-slider.gp <<'END'
# Draws slow-driving-slider.png and slow-driving-slider.svg from slow-driving-slider.csv
set datafile separator ","
$line << END_OF_LINE
1e-6,4.5e8
1e-2,4.5e4
END_OF_LINE
do for [kind in "png svg"] {
if (kind eq "png") { set terminal pngcairo size 1800,650 font "DejaVu Sans,21" linewidth 2 pointscale 2 background "#ffffff" } \
else { set terminal svg size 900,325 dynamic font "DejaVu Sans,10.5" background "#ffffff" }
set output "slow-driving-slider.".kind
set encoding utf8
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid xtics ytics lt 1 lw 0.5 lc rgb "#d8d8d8"
set multiplot layout 1,2 margins 0.095,0.98,0.17,0.88 spacing 0.11,0
is(n, c, leaps) = column(1) == n && (leaps ? abs(column(4) - 1e-3) < 1e-9 : column(4) == 0) ? column(c) : NaN
set logscale xy
set format x "10^{%L}"
set xrange [5e-8:2e-2]
set xlabel "driving velocity of the plate"
set format y "%g"
unset key
set title "Events for a way of 1000"
set ylabel "number of events" offset 0.5
set yrange [20:9999]
set key top right reverse Left samplen 1
plot "slow-driving-slider.csv" using 3:(is(256, 7, 1)) with points pt 7 lc rgb "#0072B2" title "256 blocks, from 1, leaps", "" using 3:(is(256, 7, 0)) with points pt 6 lc rgb "#0072B2" title "without leaps", \
  "" using 3:(is(256, 8, 1)) with points pt 5 lc rgb "#D55E00" title "from 100", "" using 3:(is(256, 8, 0)) with points pt 4 lc rgb "#D55E00" notitle, \
  "" using 3:(is(1928, 7, 1)) with points pt 9 lc rgb "#009E73" title "1928 blocks, from 1", "" using 3:(is(1928, 7, 0)) with points pt 8 lc rgb "#009E73" notitle, \
  "" using 3:(is(1928, 8, 1)) with points pt 13 lc rgb "#CC79A7" title "from 100", "" using 3:(is(1928, 8, 0)) with points pt 12 lc rgb "#CC79A7" notitle
set title "Cost of an event of 100 and more"
set ylabel "steps" offset 1
set yrange [1e3:1e10]
set format y "10^{%L}"
plot "slow-driving-slider.csv" using 3:(is(256, 22, 1)) with points pt 7 lc rgb "#0072B2" title "256 blocks, leaps", "" using 3:(is(256, 22, 0)) with points pt 6 lc rgb "#0072B2" title "without leaps", \
  "" using 3:(is(1928, 22, 1)) with points pt 9 lc rgb "#009E73" title "1928 blocks, leaps", "" using 3:(is(1928, 22, 0)) with points pt 8 lc rgb "#009E73" notitle, \
  $line using 1:2 with lines lc rgb "#0072B2" dt (4,4) title "as 1 / velocity"
unset multiplot
set output
}
END
LC_ALL=C.UTF-8 gnuplot slow-driving-slider.gp || { echo "slow-driving-slider: no figure without gnuplot" >&2; exit 1; }
echo "$output/slow-driving-slider.csv, .png, .svg"
