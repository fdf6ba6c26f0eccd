#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# The accuracy report: tables, work-precision diagrams and a text, all from runs made here.
# Usage: accuracy.sh full|quick FOLDER SLIDER_PROGRAM FAULT_PROGRAM PHYSICS_TESTS LMP INPUTS SCENES MPIEXEC...
# full takes some 20 minutes on 2 cores, quick about 3. The report is FOLDER/report.md.
# LSM_ACCURACY_PARTS="long runs,sums" runs only those parts (slider, single events, friction, waves, long runs, leaps,
# sums, ruptures, extremes, or text: none) and keeps what is in FOLDER: tables of the other parts, long runs that have ended. The report
# says what is missing.
set -euo pipefail
export LC_ALL=C
if [ $# -lt 9 ]; then
  sed -n '/^# Usage/,/^# says/s/^# //p' "$0" >&2
  exit 2
fi
mode=$1 out=$2 slider=$3 fault=$4 tests=$5 lmp=$6 inputs=$7 scenes=$8
shift 8
command -v gnuplot >/dev/null || {
  echo "accuracy: gnuplot not found (Debian package gnuplot-nox)" >&2
  exit 1
}
fault_parts="single events,friction,waves,long runs,leaps,sums"
parts=${LSM_ACCURACY_PARTS:-slider,$fault_parts,ruptures,extremes}
IFS=, read -ra names <<<"$parts"
for name in "${names[@]}"; do
  [[ ,slider,$fault_parts,ruptures,extremes,text, == *",$name,"* ]] || {
    echo "accuracy: LSM_ACCURACY_PARTS: no part is called '$name'; there are slider,$fault_parts,ruptures,extremes,text" >&2
    exit 2
  }
done
wanted() { [[ ,$parts, == *",$1,"* ]]; }
[ -n "${LSM_ACCURACY_PARTS:-}" ] || rm -rf "$out"
mkdir -p "$out/work"
began=$SECONDS

if wanted slider; then
  echo "== block-slider"
  "$slider" "$out" "$mode"
fi
echo "== lattice solid fault"
"$fault" "$out" "$mode" "$lmp" "$inputs" "$scenes" "$@"
if wanted waves; then
  echo "== waves"
  "$(dirname "$fault")/lsm_accuracy_waves" "$out" "$mode" "$lmp" "$scenes"
fi
if wanted ruptures; then
  echo "== ruptures of a flat fault"
  spacings=(200 100 50)
  [ "$mode" = full ] || spacings=(200)
  mkdir -p "$out/work/ruptures"
  (cd "$out/work/ruptures" && bash "$scenes/ruptures.sh" "$lmp" "$inputs" "${spacings[@]}") \
    >"$out/ruptures.txt"
  for scene in tpv205 tpv3; do cp "$out/work/ruptures/$scene".{png,svg} "$out/"; done
fi
if wanted extremes; then
  echo "== extreme cases"
  [ "$mode" = quick ] || export LSM_REST_STEPS=100000000
  "$tests" --gtest_filter='Extremes.*:Reproducible.*' >"$out/work/extremes.txt" || {
    grep -A5 Failure "$out/work/extremes.txt" >&2
    exit 1
  }
  {
    printf "case\toutcome\n"
    sed -n "s/^EXTREME\t//p" "$out/work/extremes.txt"
  } >"$out/extremes.tsv"
fi

# The tables of the study work-precision, if they exist
study=$out/../studies/work-precision
[ ! -e "$study/differences.csv" ] || cp "$study/differences.csv" "$out/fault_catalogues.csv"
for suffix in png svg; do
  [ ! -e "$study/work-precision.$suffix" ] || cp "$study/work-precision.$suffix" "$out/fault_catalogues.$suffix"
done

# ---- diagrams -----------------------------------------------------------------------------------
# Okabe-Ito colours; each line has its own point type and dash as well.
cd "$out"
style='
set datafile separator ","
set grid lc rgb "#cccccc"
set key outside right top
set pointsize 1.1
set linetype 1 lc rgb "#0072B2" pt 7 dt 1 lw 1.5
set linetype 2 lc rgb "#D55E00" pt 5 dt 2 lw 1.5
set linetype 3 lc rgb "#009E73" pt 9 dt 3 lw 1.5
set linetype 4 lc rgb "#CC79A7" pt 11 dt 4 lw 1.5
set linetype 5 lc rgb "#E69F00" pt 13 dt 5 lw 1.5
set linetype 6 lc rgb "#000000" pt 1 dt 1 lw 1
set format "10^{%T}"
set logscale xy
'
draw() { # NAME GNUPLOT-COMMANDS; nothing if a table is missing
  local table
  while read -r table; do [ -e "$table" ] || return 0; done < <(grep -o '[a-z_]*\.csv' <<<"$2")
  printf '%s\n%s\n' "$style" "$2" >"work/$1.gp"
  gnuplot -e "set terminal pngcairo size 1000,600 font 'sans,13'; set output '$1.png'; load 'work/$1.gp'"
  gnuplot -e "set terminal svg size 1000,600 font 'sans,13'; set output '$1.svg'; load 'work/$1.gp'"
}
# A line of a diagram: FILE 'awk condition' X-COLUMN Y-COLUMN TITLE STYLE [COLUMN OF THE TIME STEP, written beside the points]
line() {
  local rows="'< awk -F, '\''!/^#/ && FNR > 1 && ($2)'\'' $1'" up=0.5
  [ $(($6 % 2)) = 1 ] || up=-0.5 # labels of two lines that lie close together
  printf '%s' "$rows using $3:$4 with linespoints lt $6 title '$5'"
  [ -z "${7:-}" ] || printf '%s' ", $rows using $3:$4:(sprintf('%g', \$$7)) with labels left offset 0.7,$up font ',9' tc lt $6 notitle"
}
quoted() { printf '%s' "${1//\'\\\'\'/\'\'}"; }
join() {
  local text="plot " first=1 l
  for l in "$@"; do
    [ $first = 1 ] || text+=", "
    text+=$(quoted "$l")
    first=0
  done
  printf '%s' "$text"
}
schemes=(printed semi-implicit verlet rk4)
lines=() sizes=()
for n in 0 1 2 3; do
  s=${schemes[$n]}
  lines+=("$(line slider_event.csv "\$1 == \"$s\"" 3 4 "$s" $((n + 1)) 2)")
  sizes+=("$(line slider_event.csv "\$1 == \"$s\"" 3 5 "$s" $((n + 1)))")
done
draw slider_event_profile "set title 'Block-slider, one event: slip profile'
set xlabel 'run time (s)'; set ylabel 'largest error of slip / largest slip'; set yrange [1e-11:10]; set xrange [1e-5:1e-1]
$(join "${lines[@]}")"
draw slider_event_size "set title 'Block-slider, one event: drop of potential energy'
set xlabel 'run time (s)'; set ylabel 'relative error of the drop of PE'; set yrange [1e-11:10]
$(join "${sizes[@]}")"
draw slider_growth "set title 'Growth of an undamped oscillation'
set xlabel 'time step'; set ylabel 'growth rate of the amplitude (1/time)'; set yrange [1e-9:1]
plot '< grep ^printed slider_growth.csv' using 2:3 with points lt 1 title 'printed', '' using 2:4 with lines lt 6 title 'h w^2 / 4', '< grep ^semi slider_growth.csv' using 2:(abs(\$3)) with points lt 2 title 'semi-implicit, absolute', '< grep ^verlet slider_growth.csv' using 2:(abs(\$3)) with points lt 3 title 'verlet, absolute'"
long=()
for n in 0 1 2 3; do
  s=${schemes[$n]}
  long+=("'< grep ^$s slider_long.csv' using 3:7:8 with yerrorbars lt $((n + 1)) title '$s'")
done
draw slider_long "set title 'Block-slider, long runs'
unset logscale y; set format y '%g'
set xlabel 'run time (s)'; set ylabel 'characteristic size <s^2> / <s>'
$(join "${long[@]}")"

variants=
[ ! -e fault_event.csv ] || variants=$(awk -F, '!/^#/ && FNR > 1 && !seen[$1]++ {print $1}' fault_event.csv)
methods=(located step force "floor 0.04" "floor 0.09")
declare -A label=([located]="onset located" [step]="onset at the step" [force]="viscosity as a force"
  ["floor 0.04"]="masses of at least 0.04" ["floor 0.09"]="masses of at least 0.09")
for quantity in profile:7:'rms error of displacement at the fault / rms displacement' size:8:'relative error of event size' \
  ledger:9:'residual of the ledger / work of the plates' arrival:10:'error of arrival time at a station'; do
  IFS=: read -r name column axis <<<"$quantity"
  for v in $variants; do
    lines=()
    for n in "${!methods[@]}"; do
      m=${methods[$n]}
      awk -F, -v v="$v" -v m="$m" -v c="$column" '$1 == v && $4 == m && $c != "nan" {found = 1} END {exit !found}' \
        fault_event.csv || continue
      lines+=("$(line fault_event.csv "\$1 == \"$v\" && \$4 == \"$m\"" 6 "$column" "${label[$m]}" $((n + 1)) 5)")
    done
    draw "fault_event_${name}_$v" "set title 'Fault, one event ($v)'
set xlabel 'CPU time (s)'; set ylabel '$axis'
$(join "${lines[@]}")"
  done
done
for quantity in own:6:'displacement at the fault off that of the same law, small step' \
  rigid:8:'displacement at the fault off that without spring, small step'; do
  IFS=: read -r name column axis <<<"$quantity"
  lines=("$(line fault_friction.csv "\$1 == \"rigid\" && \$$column > 0" 4 "$column" 'half steps, no spring' 1)")
  n=1
  [ -e fault_friction.csv ] || continue
  for kt in $(awk -F, '$1 == "spring" && !seen[$2]++ {print $2}' fault_friction.csv); do
    n=$((n + 1))
    lines+=("$(line fault_friction.csv "\$1 == \"spring\" && \$2 == $kt && \$$column > 0" 4 "$column" "spring kt $kt" $n)")
  done
  draw "fault_friction_$name" "set title 'Fault, one event: ways of solving friction'
set xlabel 'CPU time (s)'; set ylabel '$axis'
$(join "${lines[@]}")"
done
waves=()
n=0
for s in p_wave_lattice.in p_wave_packing.in; do
  n=$((n + 1))
  waves+=("$(line fault_wave.csv "\$1 == \"$s\"" 3 5 "${s%.in}" $n)")
done
draw fault_wave "set title 'P-wave speed'; set xlabel 'CPU time (s)'; set ylabel 'relative error'; set key noenhanced
$(join "${waves[@]}")"
long=() n=0
for run in remove:0.03:1 remove:0.06:1 remove:0.09:1 remove:0.12:1 remove:0.15:1 remove:0.15:2 remove:0.18:1 keep:0.06:1; do
  IFS=: read -r loose dt ranks <<<"$run"
  [ -e fault_long.csv ] && awk -F, -v l="$loose" -v d="$dt" -v r="$ranks" \
    '$1 == l && $2 == d && $3 == r && $8 != 1 {found = 1} END {exit !found}' fault_long.csv || continue
  n=$((n + 1))
  title="dt $dt"
  [ "$ranks" = 1 ] || title+=", $ranks ranks"
  [ "$loose" = remove ] || title+=", loose discs kept (against 0.03)"
  long+=("'< awk -F, '\\''\$1 == \"$loose\" && \$2 == $dt && \$3 == $ranks'\\'' fault_long.csv' using (\$4 * 1.$(printf %02d $((4 * n)))):8:(sqrt(\$10 + \$11) * \$8 / \$5) with yerrorlines lt $n title '$title'")
done
[ ${#long[@]} = 0 ] || draw fault_long "set title 'Fault, long runs: number of events against that at the smallest time step'
unset logscale y; set format y '%g'; set offsets 0, 0, 0.05, 0.05; set key inside top right; set xrange [8e-6:2e-2]
set xlabel 'smallest size counted'; set ylabel 'ratio of the numbers of events'
$(join "${long[@]}"), 1 with lines lt 6 notitle"

# ---- text ---------------------------------------------------------------------------------------
markdown() { # FILE [SEPARATOR]
  [ -e "$1" ] || {
    echo "(not run: $1)"
    return
  }
  awk -F"${2:-,}" '/^#/ { next }
    { gsub(/\|/, "\\|"); line = "|"; for (i = 1; i <= NF; i++) line = line " " $i " |"; print line }
    FNR == 1 || !ruled { line = "|"; for (i = 1; i <= NF; i++) line = line "---|"; print line; ruled = 1 }' "$1"
}
remarks() { [ ! -e "$1" ] || sed -n 's/^# /- /p' "$1"; }
order() { # FILE 'awk condition' DT-COLUMN ERROR-COLUMN: slope of log error over log step
  [ -e "$1" ] || {
    printf '(not run)'
    return
  }
  awk -F, '!/^#/ && FNR > 1 && ('"$2"') && $'"$4"' > 0 && $'"$4"' != "nan" {
      x = log($'"$3"'); y = log($'"$4"'); n++; sx += x; sy += y; sxx += x * x; sxy += x * y }
    END { if (n > 1) printf "%.2f", (n * sxy - sx * sy) / (n * sxx - sx * sx); else printf "-" }' "$1"
}
value() { # FILE 'awk condition' COLUMN
  [ -e "$1" ] || {
    printf '(not run)'
    return
  }
  awk -F, '!/^#/ && FNR > 1 && ('"$2"') {print $'"$3"'; exit}' "$1"
}
friction() { value fault_friction.csv "\$1 == \"$1\" && \$2 == $2 && \$3 == $3" "$4"; }
event() { value fault_event.csv "\$1 == \"standard\" && \$4 == \"$1\" && \$5 == $2" "$3"; }
{
  cat <<TEXT
# Accuracy against run time

Made by \`cmake --build <build> --target accuracy\` ($mode) on $(awk -F': ' '/model name/ {print $2; exit}' /proc/cpuinfo), $(nproc --all) cores.
Every number comes from a run made for this report. Times of the block-slider are wall-clock, those of the fault CPU time of one rank.

## Block-slider: one event

All schemes from one state of a chain that slides, without located switches except rk4.

$(remarks slider_event.csv)

Orders of the slip profile, time steps up to 0.1: printed $(order slider_event.csv '$1 == "printed" && $2 <= 0.1' 2 4), \
semi-implicit $(order slider_event.csv '$1 == "semi-implicit" && $2 <= 0.1' 2 4), \
velocity Verlet $(order slider_event.csv '$1 == "verlet" && $2 <= 0.1' 2 4), \
rk4 with located switches $(order slider_event.csv '$1 == "rk4" && $2 <= 0.1' 2 4).

![slip profile](slider_event_profile.png)
![size](slider_event_size.png)

$(markdown slider_event.csv)

## Block-slider: growth of the printed scheme

Theory: an undamped oscillation of frequency w grows with the rate h w^2 / 4 at time step h.

![growth](slider_growth.png)

$(markdown slider_growth.csv)

## Block-slider: long runs

$(remarks slider_long.csv)

![long runs](slider_long.png)

$(markdown slider_long.csv)

## Fault: one event

From one saved state shortly before the event, through it, with other time steps; the reference is the same run with a
much smaller step. *located*: a contact that begins within a step gets the part of the step's tangential displacement
that follows its begin; *step*: it begins with elongation 0 at the end of the step; *force*: located, but viscosity is
a force evaluated with the velocity of the half step instead of exact decay around the step. *standard*: kt = k, viscosity
0.015; *floor 0.04*, *floor 0.09*: smaller masses raised to that; *damped*, *light*: viscosity 0.05 and 0.005; *soft*, *stiff*: kt = 0.1 and 10. What differs from
\`fault.in\`: length 60, stress 0.02, viscosity 0.015, kt = k and contacts between the blocks only, which are harder to integrate; all masses r^2 (as with \`-var preset single\`); and that
ledger and places of events are on, which moves no disc. The event is the
first of size 0.01 or more. It speeds up slowly over most of its duration, so that a small error of its begin grows into one of
its time: the arrival is when the velocity of a patch of the upper block has changed by half of its largest change.

$(remarks fault_event.csv)

TEXT
  for v in $variants; do
    echo "Orders ($v): displacement located $(order fault_event.csv "\$1 == \"$v\" && \$4 == \"located\"" 5 7)," \
      "step $(order fault_event.csv "\$1 == \"$v\" && \$4 == \"step\"" 5 7);" \
      "size located $(order fault_event.csv "\$1 == \"$v\" && \$4 == \"located\"" 5 8)," \
      "step $(order fault_event.csv "\$1 == \"$v\" && \$4 == \"step\"" 5 8)."
    echo
    for q in profile size ledger arrival; do echo "![$q]($(echo "fault_event_${q}_$v.png"))"; done
    echo
  done
  cat <<TEXT
$(markdown fault_event.csv)

## Fault: friction without a spring

Place & Mora (1999) solve static friction at half steps instead of giving the contact a tangential spring. Tried here in
a small program that has the same fault without LAMMPS (\`friction_schemes.h\`): impulses at each half step that stop the
tangential motion of every contact, or as much of it as mu F_n dt can, by projected Gauss-Seidel sweeps until no velocity
changes by more than 1e-12, beside the tangential spring with the onset of contacts located.

$(remarks fault_friction.csv)

Orders of the displacement: without spring $(order fault_friction.csv '$1 == "rigid" && $3 > 0.002' 3 6), \
spring kt = 1 $(order fault_friction.csv '$1 == "spring" && $2 == 1 && $3 > 0.002' 3 6). error: against the same law with a much smaller
step; off_rigid: against no spring with a much smaller step.

![own](fault_friction_own.png)
![rigid](fault_friction_rigid.png)

$(markdown fault_friction.csv)

## P-waves

Speed in the triangular lattice and in the random packing against that with a much smaller time step.

![waves](fault_wave.png)

$(markdown fault_wave.csv)

P- and S-waves of the regular lattice against their length and direction, as standing waves beside the closed dispersion
relation (k h: wave number times spacing):

$(markdown waves_lattice.csv)

Rayleigh waves of a free straight border beside those of a half-space:

$(markdown waves_rayleigh.csv)

Standing waves of the random packing, model units:

$(markdown waves_packing.csv)

## Fault: long runs, from which size the catalogue is complete

$(remarks fault_long_runs.csv)

$(markdown fault_long_runs.csv)

Each catalogue from several sizes (threshold) on, beside that of the first run, the one with the smallest time step: number of events with
the error of a Poisson process; dispersion, the variance of the counts in 30 equal stretches of time over their mean (1 for a Poisson
process); ratio to the number in the first run; events whose start has a partner in the first run within 5 time units (in_both), events without
one there (only_in_first) and here (only_here); events shorter than the memory of the picker, half a time unit (brief); exponent of the sizes from the threshold to 0.1 (from 0.01 on: to 1) and density
t^(gamma - 1) exp(-t / B) of the times between starts, both by maximum likelihood; probability of the two-sample Kolmogorov-Smirnov
test of sizes and of times against the first run. Errors of exponents and times hold for independent events.
Error bars of the diagram: square root of the number of events without partner.

![ratios](fault_long.png)

$(markdown fault_long.csv)

Do runs with time steps up to some size, on one and two ranks, agree? p_counts to p_B: probability of a larger scatter or a larger trend
with the time step (the smaller of the two, doubled) if all were independent runs of one process; counts have the larger of the error of a Poisson process and
that of the dispersion. p_size, p_interval: the least likely pair with the first run (times the number of pairs). Runs that make the same
events are not independent, so these six are too mild; p_pairs is not: probability of a larger difference between events without partner here and
there, if either is as likely (McNemar; the least, times the number of pairs). shortest: only events of this duration (time units) and more. depends: the least of the seven, times seven, is below 0.05;
with fewer than 30 events in a run nothing is said.

$(markdown fault_completeness.csv)

$(remarks fault_completeness.csv)

Readings of the picker on the same series (memory in time units, or the printed lambda per step):

$(markdown fault_picker.csv)

## Fault: catalogues, error against run time

By \`inputs/study.sh work-precision\`, which takes 40 minutes of CPU time and is no part of this report's own runs.

$(remarks fault_catalogues.csv)

![catalogues](fault_catalogues.png)

$(markdown fault_catalogues.csv)

## Fault: leaps between events

The same large events with plates slower than the paper's, with and without \`fix lsm/leap\`, and what each costs.

$(remarks fault_leaps.csv)

$(markdown fault_leaps.csv)

$(remarks fault_leaps_first.csv)

$(markdown fault_leaps_first.csv)

## Ruptures of a flat fault

The community benchmarks TPV205-2D and TPV3-2D until 6 s beside a boundary integral, and the self-similar crack
(\`tests/accuracy/ruptures.sh\`, one rank).

![TPV205-2D](tpv205.png)
![TPV3-2D](tpv3.png)

\`\`\`
$(cat ruptures.txt 2>/dev/null || echo '(not run)')
\`\`\`

## Sums

PE of all links against the sum of the same energies in long double.

$(markdown precision.csv)

A series disturbed at random by more than that, picked again (events above 1e-9):

$(markdown precision_picker.csv)

## Extreme cases

$(markdown extremes.tsv '\t')

## What follows

- Block-slider: at time step 0.05 velocity Verlet has a profile error of $(value slider_event.csv '$1 == "verlet" && $2 == 0.05' 4) \
in $(value slider_event.csv '$1 == "verlet" && $2 == 0.05' 3) s, semi-implicit Euler $(value slider_event.csv '$1 == "semi-implicit" && $2 == 0.05' 4) \
in $(value slider_event.csv '$1 == "semi-implicit" && $2 == 0.05' 3) s, the printed scheme $(value slider_event.csv '$1 == "printed" && $2 == 0.05' 4). \
rk4 with located switches reaches $(value slider_event.csv '$1 == "rk4" && $2 == 0.05' 4) in $(value slider_event.csv '$1 == "rk4" && $2 == 0.05' 3) s: for references, not for catalogues.
- Fault, one event (error of size, of displacement, of arrival; run time), onset located:
  time step 0.06: $(event located 0.06 8), $(event located 0.06 7), $(event located 0.06 10); $(event located 0.06 6) s.
  0.03: $(event located 0.03 8), $(event located 0.03 7), $(event located 0.03 10); $(event located 0.03 6) s.
  0.015: $(event located 0.015 8), $(event located 0.015 7), $(event located 0.015 10); $(event located 0.015 6) s.
- Fault: with the onset at the step, 0.06: $(event step 0.06 8), $(event step 0.06 7), $(event step 0.06 10); 0.03: $(event step 0.03 8), $(event step 0.03 7), $(event step 0.03 10);
  0.00375: $(event step 0.00375 8), $(event step 0.00375 7), $(event step 0.00375 10), located $(event located 0.00375 8), $(event located 0.00375 7), $(event located 0.00375 10).
- Fault: friction solved at half steps without a spring takes $(friction rigid 0 0.03 5) sweeps per step and $(friction rigid 0 0.03 4) s at time step 0.03
  beside $(friction spring 1 0.03 4) s with the spring; its displacement is off by $(friction rigid 0 0.03 6) beside $(friction spring 1 0.03 6), its event size by
  $(friction rigid 0 0.03 7) beside $(friction spring 1 0.03 7), at 0.00375 by $(friction rigid 0 0.00375 6) beside $(friction spring 1 0.00375 6) and
  $(friction rigid 0 0.00375 7) beside $(friction spring 1 0.00375 7). The spring kt = k itself moves the displacement by $(friction spring 1 0.00375 8) and
  the size by $(friction spring 1 0.00375 9) away from friction without spring.
- Fault, statistics:
$(remarks fault_completeness.csv | sed 's/^/  /')

Made in $((SECONDS - began)) s.
TEXT
} >report.md
[ -n "${LSM_ACCURACY_PARTS:-}" ] || rm -rf work
echo "report: $out/report.md ($((SECONDS - began)) s)"
