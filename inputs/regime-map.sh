#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Where does the fault stick and slip, and where does it creep? One run for each line of a list of points (variables of
# fault.in), then one table: the numbers of the shape of PE, counts, size exponents and inter-event times of each.
# Run it again to go on where it was stopped.
set -uo pipefail
export LC_ALL=C
root=$(cd "$(dirname "$0")/.." && pwd)
build=${LSM_BUILD_DIR:-$root/build}
points=$root/inputs/regime-map.txt output=$build/regime-map jobs=$(nproc) bin=$build/bin run=yes skip=3000

usage() {
  cat <<END
usage: inputs/regime-map.sh [OPTIONS]
  --points FILE   list of points [inputs/regime-map.txt]
  --output DIR    folder of the runs and the table [$output]
  --jobs J        runs at a time, one core each [$jobs]
  --bin DIR       folder of lmp and postproc [$bin]
  --skip T        time units left out at the begin of each run [$skip]
  --table         only make the table of the runs that are done
END
}
while [ $# -gt 0 ]; do
  case $1 in
    --help | -h) usage; exit 0 ;;
    --table) run=no; shift ;;
    --points | --output | --jobs | --bin | --skip)
      [ $# -ge 2 ] || { echo "regime-map: $1 needs a value" >&2; exit 2; }
      declare "${1#--}=$2"; shift 2 ;;
    *) echo "regime-map: unknown option '$1' (--help lists the options)" >&2; exit 2 ;;
  esac
done
[[ $jobs =~ ^[1-9][0-9]*$ ]] || { echo "regime-map: --jobs = '$jobs', expected a whole number above 0" >&2; exit 2; }
[ -r "$points" ] || { echo "regime-map: cannot read the list of points '$points'" >&2; exit 2; }
for program in lmp postproc; do
  [ -x "$bin/$program" ] || { echo "regime-map: no program $bin/$program" >&2; exit 2; }
done
mkdir -p "$output" && output=$(cd "$output" && pwd) && bin=$(cd "$bin" && pwd) || exit 1

# one NAME=VALUE at least, no comments
list() { sed 's/#.*//; s/[[:space:]]*$//; /^$/d' "$points"; }
bad=$(list | grep -nvE '^[a-z]+=[^ =]+( [a-z]+=[^ =]+)*$' | head -n 1)
[ -z "$bad" ] || { echo "regime-map: $points: '$bad', expected NAME=VALUE words" >&2; exit 2; }

# point FOLDER WORD...: the run, then its numbers; a point is done when numbers.txt is there
point() {
  local folder=$output/$1 word vars=()
  shift
  [ ! -e "$folder/numbers.txt" ] || return 0
  for word in "$@"; do vars+=(-var "${word%%=*}" "${word#*=}"); done
  rm -rf "$folder" && mkdir -p "$folder" && cd "$folder" || return 1
  if ! "$bin/lmp" -in "$root/inputs/fault.in" "${vars[@]}" -var prefix fault >output.txt 2>&1 </dev/null; then
    echo "regime-map: $folder: $(grep -m 1 ERROR output.txt || echo "lmp failed, see output.txt")" >&2
    grep -m 1 'a link is strained' output.txt >failed.txt || rm -f failed.txt
    return 1
  fi
  "$bin/postproc" series fault.pe.bin --from "$skip" -o shape >shape.txt 2>&1
  "$bin/postproc" pick fault.pe.bin --memory-time 3 -o fault.long.csv >/dev/null 2>&1
  rm -f fault.restart.*
  cp shape.txt numbers.txt
}

if [ $run = yes ]; then
  while read -r words; do
    while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n; done
    # shellcheck disable=SC2086
    point "$(tr ' =' '_-' <<<"$words")" $words &
  done < <(list)
  wait
fi

# ---- table: one row for each point that is done

# of POINT-FOLDER CATALOGUE: events, from 1e-4, from 1e-3; exponent with error from 1e-4 and from 1e-3 to 1e-1; gamma with
# error and B of the times from 1e-3 (delta = 1); mean time between events; with commas between them
statistics() {
  local folder=$1 file=$2
  awk -F, -v from="$skip" '!/^[#e]/ && $2 >= from { n++; if (a == "") a = $2; b = $2; if ($6 >= 1e-4) n4++; if ($6 >= 1e-3) n3++ }
    END { printf "%d,%d,%d,", n, n4, n3; mean = n > 1 ? (b - a) / (n - 1) : "" ; print mean }' "$folder/$file" >"$folder/count"
  "$bin/postproc" fit "$folder/$file" --from "$skip" --range 1e-4:1e-1 --range 1e-3:1e-1 --replicas 0 --no-comparison \
    -o "$folder/fit" >/dev/null 2>&1
  "$bin/postproc" intervals "$folder/$file" --from "$skip" --threshold 1e-3 --method likelihood --delta 1 \
    -o "$folder/times" >/dev/null 2>&1
  # shellcheck disable=SC2016
  local named='/^[^#]/ && !head { head = 1; for (i = 1; i <= NF; i++) c[$i] = i; next } /^#/ { next }'
  printf '%s' "$(cut -d, -f1-3 "$folder/count"),"
  awk -F, "$named"' { e[$c["lo"]] = $c["exponent"] "," $c["standard_error"] }
    END { printf "%s,%s,", ("0.0001" in e) ? e["0.0001"] : ",", ("0.001" in e) ? e["0.001"] : "," }' "$folder/fit.fits.csv" 2>/dev/null ||
    printf ',,,,'
  awk -F, "$named"' $1 == "ours" { r = $c["gamma"] "," $c["gamma_error"] "," $c["B"] } END { printf "%s,", r == "" ? ",," : r }' \
    "$folder/times.table1.csv" 2>/dev/null || printf ',,,'
  cut -d, -f4 "$folder/count"
}
echo "-1,-1" >"$output/torn.csv" # gnuplot wants a row
default() { sed -n "s/^variable $1 *index *\([^ ]*\).*/\1/p" "$root/inputs/fault.in"; }
{
  echo "# Regime map of the fault; runs of inputs/regime-map.txt, times below $skip left out. long_: picked with a memory of 3"
  echo "# exponents: 1e-4 to 1e-1 and 1e-3 to 1e-1; gamma and B: times between events of 1e-3 and more, delta = 1 (likelihood)"
  echo -n "length,stress,viscosity,others,saw_tooth,drop_over_load,time_in_events,mean_duration"
  for kind in "" long_; do
    for name in events from_1e-4 from_1e-3 exponent_4 error_4 exponent_3 error_3 gamma gamma_error B mean_time; do
      echo -n ",$kind$name"
    done
  done
  echo
  while read -r words; do
    folder=$output/$(tr ' =' '_-' <<<"$words")
    length=$(default length) stress=$(default stress) viscosity=$(default viscosity) others=
    for word in $words; do
      case $word in
        length=* | stress=* | viscosity=*) declare "$word" ;;
        steps=*) ;;
        *) others+="${others:+ }$word" ;;
      esac
    done
    if [ -e "$folder/failed.txt" ]; then
      echo "regime-map: $words: $(cut -c 1-100 "$folder/failed.txt")" >&2
      [ -n "$others" ] || [ "$length" != 120 ] || echo "$stress,$viscosity" >>"$output/torn.csv"
      continue
    fi
    [ -e "$folder/numbers.txt" ] || continue
    shape=$(sed -n 's/.*(saw-tooth \([^;]*\);.*fastest fall . load \([^,]*\), time in events \([^,]*\), mean duration \(.*\)/\1,\2,\3,\4/p' \
      "$folder/numbers.txt")
    [ -n "$shape" ] || shape=1,,, # PE only rises: nothing slips
    echo "$length,$stress,$viscosity,$others,$shape,$(statistics "$folder" fault.catalogue.csv),$(statistics "$folder" fault.long.csv)"
  done < <(list)
} >"$output/regime-map.csv.new" && mv "$output/regime-map.csv.new" "$output/regime-map.csv" || exit 1

# ---- picture: the saw-tooth number over stress and viscosity, length 120, nothing else changed

cat >"$output/regime-map.gp" <<'END'
set datafile separator ","
set logscale xy
set logscale cb
set xlabel "normal stress"
set ylabel "viscosity"
set xrange [0.0022:0.068]
set yrange [0.0012:0.17]
set cblabel "saw-tooth number (speed of fall / speed of rise of PE)"
set cbrange [1:12]
set palette defined (0 "#b2182b", 0.44 "#f7f7f7", 1 "#2166ac")
set title "Where the fault creeps (below 3) and where it sticks and slips; exponent of the sizes below"
set key off
set xtics (0.003, 0.006, 0.01, 0.015, 0.02, 0.03, 0.05)
set ytics (0.002, 0.005, 0.015, 0.05, 0.1)
plot data using 2:3:5 with points pt 7 ps 7 lc palette, \
     "" using 2:3:(sprintf("%.1f", $5)) with labels font ",11", \
     "" using 2:3:(sprintf("%.2f", $14)) with labels offset 0,-2.1 font ",9", \
     torn using 1:2 with points pt 2 ps 3 lw 2 lc rgb "#777777", \
     "" using 1:2:("links torn") with labels offset 0,-2.1 font ",9" tc rgb "#777777", \
     "< echo ".default using 1:2 with points pt 6 ps 8.5 lw 2.5 lc rgb "black"
END
sed -n '/^#/!p' "$output/regime-map.csv" | awk -F, 'NR > 1 && $1 == 120 && $4 == ""' >"$output/grid.csv"
if [ -s "$output/grid.csv" ]; then
  (cd "$output" && for kind in png svg; do
    terminal="pngcairo size 900,640 font 'sans,12'"
    [ $kind = png ] || terminal="svg size 900,640 font 'sans,12'"
    gnuplot -e "set terminal $terminal; set output 'regime-map.$kind'; data = 'grid.csv'; torn = 'torn.csv'; default = '$(default stress),$(default viscosity)'; load 'regime-map.gp'" || exit 1
  done) || exit 1
fi
echo "regime-map: $(sed '/^#/d' "$output/regime-map.csv" | tail -n +2 | wc -l) points in $output/regime-map.csv"
