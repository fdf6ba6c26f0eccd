#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# How do the statistics of the fault depend on the driving velocity? Length 120, the plates move as far in each run, with leaps
# over the loading (fix lsm/leap) and without; one table, one figure. Run it again to go on with the runs that are not done.
set -uo pipefail
export LC_ALL=C
root=$(cd "$(dirname "$0")/.." && pwd)
build=${LSM_BUILD_DIR:-$root/build}
output=$build/slow-driving bin=$build/bin way=36 run=yes
# velocity, leaps (no, or how fast the plates move in them), steps: the first is the paper's, to which the others are compared
runs="2.5e-4 no 1200000
2.5e-5 2.5e-4 2200000
2.5e-6 2.5e-4 2200000
2.5e-7 2.5e-4 2200000
2.5e-8 2.5e-4 2200000
2.5e-5 1e-4 3500000
2.5e-6 1e-4 3500000
2.5e-5 no 12000000"

usage() {
  cat <<END
usage: inputs/slow-driving.sh [OPTIONS]
  --output DIR    folder of the runs, the table and the figure [$output]
  --bin DIR       folder of lmp and postproc [$bin]
  --way D         way of each plate that counts, in all runs [$way]
  --table         only make table and figure of the runs that are done
END
}
while [ $# -gt 0 ]; do
  case $1 in
    --help | -h) usage; exit 0 ;;
    --table) run=no; shift ;;
    --output | --bin | --way)
      [ $# -ge 2 ] || { echo "slow-driving: $1 needs a value" >&2; exit 2; }
      declare "${1#--}=$2"; shift 2 ;;
    *) echo "slow-driving: unknown option '$1' (--help lists the options)" >&2; exit 2 ;;
  esac
done
[[ $way =~ ^[0-9.]+$ ]] || { echo "slow-driving: --way = '$way', expected a number above 0" >&2; exit 2; }
for program in lmp postproc; do
  [ -x "$bin/$program" ] || { echo "slow-driving: no program $bin/$program" >&2; exit 2; }
done
mkdir -p "$output" && output=$(cd "$output" && pwd) && bin=$(cd "$bin" && pwd) || exit 1

# one VELOCITY LEAP STEPS: a run is done when cpu.txt is there, with the CPU seconds it took
one() {
  local folder=$output/$1_leap_$2
  [ ! -e "$folder/cpu.txt" ] || return 0
  rm -rf "$folder" && mkdir -p "$folder" && cd "$folder" || return 1
  local TIMEFORMAT='%U %S' leaps=(-var leap no)
  [ "$2" = no ] || leaps=(-var leap yes -var fast "$2")
  { time "$bin/lmp" -in "$root/inputs/fault_120.in" -log none -var prefix fault -var velocity "$1" "${leaps[@]}" -var steps "$3" \
    -var series no >output.txt 2>&1 </dev/null; } 2>time.txt || {
    echo "slow-driving: $folder: $(grep -m 1 ERROR output.txt || echo "lmp failed, see output.txt")" >&2
    return 1
  }
  awk '{ print $1 + $2 }' time.txt >cpu.txt
}
if [ $run = yes ]; then
  while read -r velocity leap steps; do one "$velocity" "$leap" "$steps"; done <<<"$runs"
fi

cd "$output" || exit 1
begin=1200 # compression; the plates move from then on, over 150 time units up to their velocity
paper=2.5e-4_leap_no/fault.catalogue.csv
# shellcheck disable=SC2016
named='/^[^#]/ && !head { head = 1; for (i = 1; i <= NF; i++) c[$i] = i; next } /^#/ { next }'
# A main shock is the largest event of all within the way 0.04 before and after it, and 0.1 at least; around it events of 1e-3
# and more are counted, by the time after its end and before its start.
around='!/^[#e]/ && $2 < to && $6 >= 1e-3 { n++; a[n] = $2; b[n] = $3; s[n] = $6 }
  END { w = 0.04 / v
    for (m = 1; m <= n; m++) { if (s[m] < 0.1) continue
      largest = 1
      for (i = m - 1; i > 0 && a[i] > a[m] - w; i--) if (s[i] >= s[m]) largest = 0
      for (i = m + 1; i <= n && a[i] < b[m] + w; i++) if (s[i] >= s[m]) largest = 0
      if (!largest) continue
      mains++
      for (i = m - 1; i > 0 && a[m] - a[i] < w; i--) count["before", bin(a[m] - b[i])]++
      for (i = m + 1; i <= n && a[i] - b[m] < w; i++) count["after", bin(a[i] - b[m])]++ }
    for (k = 0; edge(k + 1) <= w * 1.0001; k++)
      printf "%s,%s,%g,%g,%d,%d,%g,%d,%g\n", v, leap, edge(k), edge(k + 1), mains, count["after", k],
        count["after", k] / mains / (edge(k + 1) - edge(k)), count["before", k], count["before", k] / mains / (edge(k + 1) - edge(k)) }
  function edge(k) { return k == 0 ? 0 : 10 ^ (k / 2) }
  function bin(t) { return t < edge(1) ? 0 : int(2 * log(t) / log(10)) }'
# Events of 1e-2 and more of the first run that have one in the other whose begin lies within the way 0.02 and whose size within a
# factor of 2, each counted once; then how many had if the first run were shifted along the way, mean of 7 shifts.
pairs='FNR == 1 { file++; v = file == 1 ? v1 : v2 }
  !/^[#e]/ && $6 >= 1e-2 { w = v * ($2 - begin); if (w < way) { n[file]++; at[file, n[file]] = w; s[file, n[file]] = log($6) } }
  END { for (k = 0; k < 8; k++) { c = same(way * k / 8); if (k == 0) first = c; else chance += c / 7 }
    printf "%d,%d,%.0f", n[1], first, chance }
  function same(shift, i, j, w, d, best, least, found, taken) { split("", taken); found = 0
    for (i = 1; i <= n[1]; i++) { w = at[1, i] + shift; if (w >= way) w -= way
      best = 0; least = 0.02
      for (j = 1; j <= n[2]; j++) { d = at[2, j] - w; if (d < 0) d = -d
        if (d < least && !(j in taken) && s[2, j] - s[1, i] < log(2) && s[1, i] - s[2, j] < log(2)) { least = d; best = j } }
      if (best) { taken[best]; found++ } }
    return found }'
echo "velocity,leaps,from,to,mains,after,after_per_time,before,before_per_time" >around.csv
{
  echo "# Statistics of the fault of length 120 against the driving velocity; plates have moved by $way, or as far as the run went (way)"
  echo "# exponent: sizes 1e-3 to 1e-1, long: 1e-3 to 1, from_1e-2: 1e-2 to 1; gamma: times between events of 1e-3 (1e-2) and more, delta = 1; share_small: of the"
  echo "# events of 1e-3 and more those below 1e-2; in_events: share of the model time; p: two-sample tests against the first run, times"
  echo "# as ways of the plates; after_100, before_100: events of 1e-3 and more within 100 time units of a main shock, per main shock;"
  echo "# after_way, before_way: those later or earlier than that, up to a way of 0.04; gap: shortest time above 100 from the end of a"
  echo "# main shock to an event of 1e-3 and more; large: of 1e-2 and more; same: of the large events of the first run (of) so many have one"
  echo "# here within the way 0.02 and a factor of 2 in size, by chance so many (chance)"
  echo -n "velocity,leaps,way,steps,cpu_s,events_1e-4,events_1e-3,events_1e-2,events_1e-1,largest,released,exponent,exponent_error,long,long_error,"
  echo -n "gamma,gamma_error,share_small,in_events,p_size,p_time,of,same,chance,mains,after_100,before_100,after_way,before_way,gap,steps_per_large,"
  echo "cpu_s_per_large,model_time_per_cpu_s,from_1e-2,from_1e-2_error,gamma_1e-2,gamma_1e-2_error"
  while read -r velocity leap _; do
    folder=${velocity}_leap_$leap file=$folder/fault.catalogue.csv
    [ -e "$folder/cpu.txt" ] || continue
    cpu=$(cat "$folder/cpu.txt")
    # the way that counts: that asked for, or that of the last event
    went=$(awk -F, -v v="$velocity" -v w="$way" -v b=$begin '!/^[#e]/ { t = $3 } END { d = v * (t - b); printf "%.4g", (d > w * 0.99) ? w : d }' "$file")
    to=$(awk -v v="$velocity" -v w="$went" -v b=$begin 'BEGIN { printf "%.10g", b + w / v }')
    awk -F, -v v="$velocity" -v leap="$leap" -v to="$to" "$around" "$file" >"$folder/around.csv" && cat "$folder/around.csv" >>around.csv
    "$bin/postproc" fit "$file" --to "$to" --range 1e-3:1e-1 --range 1e-3:1 --range 1e-2:1 --replicas 0 --no-comparison --no-picture -o "$folder/fit" >/dev/null
    for size in 1e-3 1e-2; do
      "$bin/postproc" intervals "$file" --to "$to" --threshold $size --method likelihood --delta 1 --replicas 0 --no-picture -o "$folder/times_$size" >/dev/null
    done
    p=, same=,,
    if [ "$file" != "$paper" ] && [ -e "$paper" ]; then
      p=$("$bin/postproc" compare "$paper" "$file" --label first --label second --displacement --threshold 1e-3 \
        --to "$(awk -v v="$velocity" -v w="$went" -v b=$begin 'BEGIN { print w + b * v }')" -o "$folder/compare" >/dev/null &&
        awk -F, "$named"' { p[$c["quantity"]] = $c["p"] } END { printf "%.2g,%.2g", p["size"], p["time"] }' "$folder/compare.csv") || p=,
      same=$(awk -F, -v v1="${paper%%_*}" -v v2="$velocity" -v begin=$begin -v way="$went" "$pairs" "$paper" "$file")
    fi
    awk -F, -v v="$velocity" -v leap="$leap" -v to="$to" -v b=$begin -v cpu="$cpu" -v went="$went" -v p="$p,$same" \
      -v fits="$(awk -F, "$named"' { e[++n] = sprintf("%.3f,%.3f", $c["exponent"], $c["standard_error"]) } END { print e[1] "," e[2] }' "$folder/fit.fits.csv")" \
      -v gamma="$(awk -F, "$named"' $1 == "ours" { printf "%.3f,%.3f", $c["gamma"], $c["gamma_error"] }' "$folder/times_1e-3.table1.csv")" \
      -v larger="$(awk -F, "$named"' { e = sprintf("%.3f,%.3f", $c["exponent"], $c["standard_error"]) } END { print e }' "$folder/fit.fits.csv"),$(awk -F, "$named"' $1 == "ours" { printf "%.3f,%.3f", $c["gamma"], $c["gamma_error"] }' "$folder/times_1e-2.table1.csv")" \
      -v near="$(awk -F, '{ mains = $5; if ($4 <= 100) { a += $6; b += $8 } else { c += $6; d += $8 } } END { printf "%d,%.3g,%.3g,%.3g,%.3g", mains, a / mains, b / mains, c / mains, d / mains }' "$folder/around.csv")" \
      '/^# dt = / { sub(/.*= /, ""); dt = $0 }
      !/^[#e]/ { all_steps = $5; all_time = $3 }
      !/^[#e]/ && $2 < to { steps = $5; inside += $3 - $2; if ($6 >= 1e-4) n4++; if ($6 > most) most = $6
        if ($6 < 1e-3) next
        released += $6; n3++
        if (main && $2 - main > 100 && (gap == "" || $2 - main < gap)) gap = $2 - main
        if ($6 >= 1e-2) n2++
        if ($6 >= 0.1) { n1++; main = $3 } }
      END { cpu *= steps / all_steps # that of the steps that count
        printf "%s,%s,%s,%d,%.0f,%d,%d,%d,%d,%.3g,%.3g,%s,%s,%.3f,%.3g,%s,%s,%.4g,%.0f,%.3g,%.4g,%s\n", v, leap, went, steps, cpu, n4, n3, n2, n1, most,
          released, fits, gamma, (n3 - n2) / n3, inside / (to - b), p, near, gap, steps / n2, cpu / n2, (to - b) / cpu, larger }' "$file"
  done <<<"$runs"
} >slow-driving.csv.new && mv slow-driving.csv.new slow-driving.csv || exit 1

cat >slow-driving.gp <<'END'
# Draws slow-driving.png and slow-driving.svg from slow-driving.csv and around.csv
set datafile separator ","
do for [kind in "png svg"] {
if (kind eq "png") { set terminal pngcairo size 1800,1300 font "DejaVu Sans,21" linewidth 2 pointscale 2 background "#ffffff" } \
else { set terminal svg size 900,650 dynamic font "DejaVu Sans,10.5" background "#ffffff" }
set output "slow-driving.".kind
unset logscale
set format y "%g"
set encoding utf8
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid xtics ytics lt 1 lw 0.5 lc rgb "#d8d8d8"
set multiplot layout 2,2 margins 0.08,0.98,0.085,0.95 spacing 0.10,0.165
yes(c) = strcol(2) eq "2.5e-4" ? column(c) : NaN
slower(c) = strcol(2) eq "1e-4" ? column(c) : NaN
no(c) = strcol(2) eq "no" ? column(c) : NaN
set logscale x
set format x "10^{%L}"
set xrange [1.2e-8:6e-4]
set xlabel "driving velocity of each plate"
set key top left Left reverse samplen 1
set title "Events while the plates move by 36 each"
set ylabel "number of events" offset 1
set yrange [0:3000]
plot "slow-driving.csv" using 1:(yes(7)*36/$3) with points pt 7 lc rgb "#0072B2" title "from 10^{-3}, leaps", "" using 1:(no(7)*36/$3) with points pt 6 lc rgb "#0072B2" title "without leaps", \
  "" using 1:(slower(7)*36/$3) with points pt 2 lc rgb "#0072B2" title "leaps with 10^{-4}", "" using 1:(slower(8)*36/$3) with points pt 2 lc rgb "#D55E00" notitle, "" using 1:(slower(9)*36/$3) with points pt 2 lc rgb "#009E73" notitle, \
  "" using 1:(yes(8)*36/$3) with points pt 5 lc rgb "#D55E00" title "from 10^{-2}", "" using 1:(no(8)*36/$3) with points pt 4 lc rgb "#D55E00" notitle, \
  "" using 1:(yes(9)*36/$3) with points pt 9 lc rgb "#009E73" title "from 10^{-1}", "" using 1:(no(9)*36/$3) with points pt 8 lc rgb "#009E73" notitle
set title "Exponents"
set ylabel "exponent, γ" offset 1
set yrange [0:3.6]
plot "slow-driving.csv" using 1:(yes(14)):15 with yerrorbars pt 7 lc rgb "#0072B2" title "sizes 10^{-3} to 1, leaps", "" using 1:(no(14)):15 with yerrorbars pt 6 lc rgb "#0072B2" title "without leaps", \
  "" using 1:(slower(14)):15 with yerrorbars pt 2 lc rgb "#0072B2" title "leaps with 10^{-4}", "" using ($1*1.1):(slower(34)):35 with yerrorbars pt 2 lc rgb "#D55E00" notitle, "" using ($1*0.9):(slower(16)):17 with yerrorbars pt 2 lc rgb "#009E73" notitle, \
  "" using ($1*1.1):(yes(34)):35 with yerrorbars pt 5 lc rgb "#D55E00" title "sizes 10^{-2} to 1", "" using ($1*1.1):(no(34)):35 with yerrorbars pt 4 lc rgb "#D55E00" notitle, \
  "" using ($1*0.9):(yes(16)):17 with yerrorbars pt 9 lc rgb "#009E73" title "γ of the times from 10^{-3}", "" using ($1*0.9):(no(16)):17 with yerrorbars pt 8 lc rgb "#009E73" notitle, \
  "" using ($1*0.8):(yes(36)):37 with yerrorbars pt 13 lc rgb "#CC79A7" title "γ from 10^{-2}", "" using ($1*0.8):(no(36)):37 with yerrorbars pt 12 lc rgb "#CC79A7" notitle
set title "Events from 10^{-3} after a main shock (10^{-1} and more)"
set xrange [1:2e6]
set xlabel "time since its end (time units)"
set yrange [1e-8:3]
set logscale y
set format y "10^{%L}"
set ylabel "events per main shock and time unit" offset 1
set key top right
mid(a, b) = a > 0 ? sqrt(a*b) : 0.5*b
at(v, leap) = strcol(1) eq v && strcol(2) eq leap && column(7) > 0 ? column(7) : NaN
plot "around.csv" using (mid($3, $4)):(at("2.5e-4", "no")) with points pt 6 lc rgb "#000000" title "2.5·10^{-4}, no leaps", \
  "" using (mid($3, $4)):(at("2.5e-5", "no")) with points pt 4 lc rgb "#D55E00" title "2.5·10^{-5}, no leaps", \
  "" using (mid($3, $4)):(at("2.5e-5", "2.5e-4")) with points pt 5 lc rgb "#D55E00" title "2.5·10^{-5}, leaps", \
  "" using (mid($3, $4)):(at("2.5e-6", "2.5e-4")) with points pt 9 lc rgb "#009E73" title "2.5·10^{-6}", \
  "" using (mid($3, $4)):(at("2.5e-7", "2.5e-4")) with points pt 7 lc rgb "#0072B2" title "2.5·10^{-7}", \
  "" using (mid($3, $4)):(at("2.5e-8", "2.5e-4")) with points pt 13 lc rgb "#CC79A7" title "2.5·10^{-8}"
set title "Cost of an event of 10^{-2} and more"
set xrange [1.2e-8:6e-4]
set xlabel "driving velocity of each plate"
set yrange [1e3:3e7]
set ylabel "steps" offset 1
set key top right
plot "slow-driving.csv" using 1:(yes(31)) with points pt 7 lc rgb "#0072B2" title "leaps", "" using 1:(slower(31)) with points pt 2 lc rgb "#0072B2" title "leaps with 10^{-4}", "" using 1:(no(31)) with points pt 4 lc rgb "#D55E00" title "without", \
  [2.5e-8:2.5e-4] base*2.5e-5/x lc rgb "#D55E00" dt (4,4) title "as 1 / velocity"
unset multiplot
set output
}
END
base=$(awk -F, '/^#/ { next } $2 == "no" && $1 < 1e-4 { b = $31 } $2 == "no" && $1 > 1e-4 { a = 10 * $31 } END { print b != "" ? b : a }' slow-driving.csv)
LC_ALL=C.UTF-8 gnuplot -e "base = $base" slow-driving.gp || exit 1
echo "slow-driving: $(grep -vc '^#' slow-driving.csv) lines in $output/slow-driving.csv"
