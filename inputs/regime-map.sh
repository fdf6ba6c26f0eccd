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
    grep -m 1 ERROR output.txt >failed.txt
    return 1
  fi
  "$bin/postproc" series fault.pe.bin --from "$skip" -o shape >shape.txt 2>&1
  "$bin/postproc" pick fault.pe.bin --memory-time 0.45 -o fault.short.csv >/dev/null 2>&1
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
