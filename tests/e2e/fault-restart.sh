#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Robustness: damaged restart files, kills while they are written, two runs with the same files, and
# words and values that a run refuses.
# usage: fault-restart.sh words|values|damaged|killed|walk|twice LMP SOURCE_DIR
set -euo pipefail
export LC_ALL=C
lmp=$2 source=$3
work=$(mktemp -d)
child=""
trap '[ -z "$child" ] || kill -9 $child 2>/dev/null; rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*" >&2; [ ! -f out ] || tail -n 20 out >&2; exit 1; }

# Of several -var the first counts.
small=(-log none -var length 20 -var width 15 -var settle 100 -var velocity 0.01 -var checkpoint 400 -var location yes)
fault() { "$lmp" -in "$source/inputs/fault.in" "$@" </dev/null >out 2>&1; }
begin() { fault "${small[@]}" "$@" || fail "the run $*"; }
# refused PATTERN OPTIONS...: one line of error that matches
refused() {
  local pattern=$1
  shift
  ! fault "$@" || fail "accepted: $*"
  [ "$(grep -c ERROR out)" = 1 ] || fail "not one line of error for $*"
  grep ERROR out | grep -q -e "$pattern" || fail "expected '$pattern' for $*"
}
header() { sed -n "s/^# $2 = //p" "$1"; }

case $1 in
  words)
    while read -r name value accepted; do
      refused "Variable $name is '$value', but must be $accepted" -var $name "$value" "${small[@]}" -var steps 5
    done <<'EOF'
preset Single statistics or single
hold Position stress or position
contacts ALL fault, all or smooth
ruptures Yes no or yes
leap on no or yes
series foo yes or no
history foo yes or no
overwrite 1 no or yes
location true no or yes
ledger true no or yes
loose removed remove or keep
mass r4 r2 or r3
onset Step located or step
picker median exponential, average or literal
dt 0 a number above 0
dt fast a number above 0
checkpoint 0 a whole number of at least 1
steps 10.5 a whole number of at least 0
settle -1 a whole number of at least 0
EOF
    refused "Variable prefix is 'a b', but must be a file name without blanks" "${small[@]}" -var prefix 'a b'
    # One that nothing reads.
    fault -var stres 0.03 "${small[@]}" -var prefix known -var steps 1 || fail "a variable more"
    [ "$(grep -c 'WARNING: Variable .* is not used' out)" = 1 ] && grep -q 'Variable stres is not used by this script' out ||
      fail "no warning about stres"
    rm known.*
    # LAMMPS itself takes a word with '-' for an option; a script may set the variable.
    printf 'variable prefix string -x\ninclude %s/inputs/fault.in\n' "$source" >in.dash
    ! "$lmp" -in in.dash "${small[@]}" </dev/null >out 2>&1 || fail "accepted: a prefix that begins with -"
    grep -q "ERROR: Variable prefix is '-x', but must be .* not beginning with -" out || fail "no clear line about -x"
    [ -z "$(ls | grep -v '^out$\|^in.dash$')" ] || fail "files left behind: $(ls)"
    ;;
  values)
    begin -var prefix a -var seed 7 -var massfloor 0.05 -var stress 0.03 -var steps 500
    cp a.catalogue.csv first.csv
    # A variable that is in none of the lists of fault.in would not be read from the restart file.
    for name in $(sed -n '/^variable preset/,/^check_variable *loose/p' "$source/inputs/fault.in" | awk '/^variable/ && $3 == "index" { print $2 }'); do
      case $name in overwrite | thermo | extra | quote) continue ;; esac
      grep -q "^$name = " a.restart.end.info || fail "$name is not in the restart file; add it to fault or settings in fault.in"
    done
    while read -r name value was; do
      refused "Variable $name is $value, but restart file a.restart.end was written with $name = $was" -log none \
        -var restart a.restart.end -var $name $value
    done <<'EOF'
seed 8 7
length 30 20
width 20 15
mass r3 r2
loose keep remove
massfloor 0 0.05
preset single statistics
settle 50 100
mu 0.5 0.6
EOF
    refused "steps = 300, but restart file a.restart.end is at step 500 of the shear" -log none -var restart a.restart.end -var steps 300
    cmp a.catalogue.csv first.csv || fail "the catalogue was changed"
    # Nothing has to be given again, and a value given again with other digits is the same.
    fault -log none -var restart a.restart.end -var steps 900 -var massfloor 5e-2 || fail "going on without the settings"
    begin -var prefix b -var seed 7 -var massfloor 0.05 -var stress 0.03 -var steps 500
    fault "${small[@]}" -var prefix b -var seed 7 -var massfloor 0.05 -var stress 0.03 -var steps 900 -var restart b.restart.end ||
      fail "going on with the settings"
    cmp a.catalogue.csv b.catalogue.csv && cmp a.pe.bin b.pe.bin || fail "other files"
    # Under another name: the header says what the fault is.
    fault -log none -var restart a.restart.end -var steps 1000 -var prefix look -var velocity 0.02 || fail "a second look"
    for pair in seed=7 massfloor=0.05 stress=0.03 velocity=0.02 width=15; do
      [ "$(header look.catalogue.csv ${pair%=*})" = "${pair#*=}" ] || fail "${pair%=*} = $(header look.catalogue.csv ${pair%=*})"
    done
    ;;
  damaged)
    begin -var prefix a -var steps 900
    cp a.catalogue.csv first.csv
    cp a.pe.bin first.bin
    newest=a.restart.900
    unchanged() { cmp -s a.catalogue.csv first.csv && cmp -s a.pe.bin first.bin || fail "files were changed by $*"; }
    size=$(stat -c %s $newest)
    for length in 0 1 100 $((size / 2)) $((size - 1)); do
      head -c $length $newest >cut
      cp $newest.info cut.info
      refused "cut: is damaged, it has $length bytes, expected $size" -log none -var restart cut -var steps 1500
      unchanged "a restart file of $length bytes"
    done
    for place in 0 17 $((size / 7)) $((size / 3)) $((size - 20)); do
      cp $newest flipped
      cp $newest.info flipped.info
      byte=$(od -An -tu1 -j $place -N 1 $newest)
      printf "$(printf '\\%03o' $((byte ^ 4)))" | dd of=flipped bs=1 seek=$place conv=notrunc status=none
      refused "flipped: is damaged, its checksum is not that in flipped.info" -log none -var restart flipped -var steps 1500
      unchanged "a flipped bit at $place"
    done
    head -c "$size" /dev/urandom >noise
    cp $newest.info noise.info
    refused "noise: is damaged" -log none -var restart noise -var steps 1500
    cp $newest bare
    refused "bare: its checksum file bare.info is missing" -log none -var restart bare -var steps 1500
    refused "none: cannot open: No such file" -log none -var restart none -var steps 1500
    sed 's/seed = 1/seed = 2/' $newest.info >bare.info
    refused "bare.info: is damaged" -log none -var restart bare -var steps 1500
    unchanged "a restart file"
    # For a file of another origin the line of cksum will do.
    cksum bare >bare.info
    fault "${small[@]}" -var restart bare -var prefix a -var steps 1000 || fail "with a line of cksum"
    grep -q "WARNING: Restart file bare has no value of seed" out || fail "no warning"
    ;;
  killed)
    # Most of the time goes into restart files.
    often=(-var checkpoint 2 -var prefix a -var steps 300 "${small[@]}")
    mkdir whole && cd whole
    fault "${often[@]}" || fail "the run on its own"
    cd ..
    rounds=0
    while [ ! -f a.restart.end.info ]; do
      rounds=$((rounds + 1))
      [ $rounds -lt 60 ] || fail "no end in 60 rounds"
      newest=$(ls a.restart.*.info 2>/dev/null | sort -t . -k 3n | tail -n 1 || true)
      # A file without .info is refused; one with it is whole.
      for file in a.restart.*; do
        case $file in *.info | *.new | *.info.new | 'a.restart.*') continue ;; esac
        [ -f "$file.info" ] || refused "its checksum file $file.info is missing" "${often[@]}" -var restart "$file"
      done
      words=(-var overwrite yes)
      [ -z "$newest" ] || words=(-var restart "${newest%.info}")
      "$lmp" -in "$source/inputs/fault.in" "${often[@]}" "${words[@]}" </dev/null >out 2>&1 &
      child=$!
      # Killed once there are some more restart files.
      until=$(($(sed -n 's/^step = //p' "${newest:-/dev/null}" | grep . || echo 100) + 40 + RANDOM % 20))
      while kill -0 $child 2>/dev/null; do
        for file in a.restart.[0-9]*.info; do
          step=${file#a.restart.} step=${step%.info}
          if [[ $step =~ ^[0-9]+$ ]] && [ "$step" -ge $until ] && [ "$step" -lt 396 ]; then kill -9 $child 2>/dev/null || true; fi
        done
      done
      wait $child || true
      child=""
    done
    [ $rounds -ge 4 ] || fail "killed $((rounds - 1)) times only"
    for file in a.catalogue.csv a.pe.bin; do cmp $file whole/$file || fail "$file differs after $rounds rounds"; done
    echo "killed $((rounds - 1)) times"
    ;;
  walk)
    # Killed at, or told that the disk is full by, system calls on the run's files, a few of each
    # kind.
    one=(-var checkpoint 100 -var prefix a -var steps 300 -var ruptures yes "${small[@]}")
    calls=write,pwrite64,rename,unlink,ftruncate,fsync
    paths=()
    for file in a.catalogue.csv a.pe.bin a.ruptures.csv a.slip.bin a.restart.{200,300,400,end}; do
      for end in '' .new .info .info.new .lock; do paths+=(-P "$work/part/$file$end" -P "$file$end"); done
    done
    # traced INJECTION...: the run in an empty folder
    traced() {
      rm -rf "$work/part"
      mkdir "$work/part"
      cd "$work/part"
      strace -f -o ../trace -e trace=$calls "$@" "${paths[@]}" "$lmp" -in "$source/inputs/fault.in" "${one[@]}" </dev/null >out 2>&1
    }
    mkdir whole && cd whole
    fault "${one[@]}" || fail "the run on its own"
    cd ..
    command -v strace >/dev/null && traced || { echo "skipped: strace does not work here"; exit 77; }
    cp ../trace ../counted
    walked=0
    for call in ${calls//,/ }; do
      number=$(grep -c " $call(" ../counted || true)
      [ "$number" -ge 4 ] || fail "$number calls of $call on the run's files"
      for at in 1 $((number / 2 + 1)) $number; do
        for injected in signal=KILL error=ENOSPC; do
          status=0
          traced -e inject=$call:$injected:when=$at 2>/dev/null || status=$?
          if [ $injected = error=ENOSPC ] && [ $status -ne 0 ]; then
            [ "$(grep ERROR out | grep -c 'cannot .* a\.\|a\..*cannot\|writing restart')" = 1 ] || fail "not one line about $call $at"
          fi
          # A file that cannot be removed does no harm.
          [ $status -ne 0 ] || [ $call$injected = unlinkerror=ENOSPC ] || fail "$call $at, $injected: no word"
          if [ ! -f a.restart.end.info ]; then
            newest=$(ls a.restart.*.info 2>/dev/null | sort -t . -k 3n | tail -n 1 || true)
            words=(-var overwrite yes)
            [ -z "$newest" ] || words=(-var restart "${newest%.info}")
            fault "${words[@]}" "${one[@]}" || fail "going on after $call $at, $injected"
          fi
          for file in a.catalogue.csv a.pe.bin a.ruptures.csv a.slip.bin; do
            cmp -s $file ../whole/$file || fail "$file differs after $call $at, $injected"
          done
          walked=$((walked + 1))
        done
      done
    done
    echo "walked through $walked"
    ;;
  twice)
    begin -var prefix a -var steps 400
    mkdir whole && cp a.* whole
    more=(-var restart a.restart.end -log none -var steps)
    (cd whole && fault "${more[@]}" 6000) || fail "the run on its own"
    "$lmp" -in "$source/inputs/fault.in" "${more[@]}" 6000 </dev/null >first.out 2>&1 &
    child=$!
    while [ ! -s a.catalogue.csv.lock ] && kill -0 $child; do sleep 0.01; done
    kill -STOP $child
    refused "a.catalogue.csv: is being written by another run: process $child on $(hostname) since 20" "${more[@]}" 6000
    kill -CONT $child
    wait $child || { cat first.out; fail "the first run"; }
    child=""
    for file in a.catalogue.csv a.pe.bin; do cmp $file whole/$file || fail "$file differs"; done
    # A killed run keeps no lock.
    cp whole/a.* .
    "$lmp" -in "$source/inputs/fault.in" "${more[@]}" 600000 </dev/null >first.out 2>&1 &
    child=$!
    while [ ! -s a.catalogue.csv.lock ] && kill -0 $child; do sleep 0.01; done
    kill -9 $child
    wait $child || true
    child=""
    fault "${more[@]}" 6000 || fail "going on after a kill"
    ;;
  *) fail "no case $1" ;;
esac
