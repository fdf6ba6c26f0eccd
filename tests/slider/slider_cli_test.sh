#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Tests of slider_cli from outside: slider_cli_test.sh PROGRAM CASE
# shellcheck source=tests/from_outside.sh
source "$(dirname "${BASH_SOURCE[0]}")/../from_outside.sh" "$1"

# Most cases write the same files again and again.
run() { "$program" --overwrite "$@" > out.txt 2> err.txt; }

# refused PATTERN ARGUMENTS...: non-zero exit, one line that matches, no output file.
refused() {
  local pattern=$1
  shift
  rm -f bad.csv
  run --catalogue bad.csv --blocks 16 --time 100 "$@" && fail "accepted: $*"
  [ "$(wc -l < err.txt)" = 1 ] || fail "not one line for $*: $(cat err.txt)"
  grep -q -e "$pattern" err.txt || fail "message for $* is '$(cat err.txt)', expected '$pattern'"
  [ ! -e bad.csv ] || fail "output left behind by $*"
}

# same A B: equal files with at least MIN events
same() {
  cmp "$1" "$2" || fail "$1 and $2 differ"
  [ "$(grep -vc '^[#e]' "$1")" -ge "${3:-10}" ] || fail "$1 has too few events to test anything"
}

# until_checkpoint: the run ${part[@]} in the background, as child, resumed if it was begun before; returns as soon as
# it has written a checkpoint, or ended
until_checkpoint() {
  local more=() before
  [ -e part.chk ] && more=(--resume)
  before=$(stat -c %Y%i part.chk 2> /dev/null)
  "$program" "${part[@]}" "${more[@]}" > out.txt 2> err.txt &
  child=$!
  while [ "$(stat -c %Y%i part.chk 2> /dev/null)" = "$before" ] && kill -0 $child 2> /dev/null; do
    :
  done
}

# interrupt_often N: starts the part N times, killed by turns by KILL and TERM
interrupt_often() {
  local round interrupted=0
  for ((round = 1; round <= $1; ++round)); do
    until_checkpoint
    if [ $((round % 2)) = 0 ]; then
      kill -TERM $child 2> /dev/null
    else
      kill -9 $child 2> /dev/null
    fi
    wait $child 2> /dev/null
    case $? in 137 | 143) interrupted=$((interrupted + 1)) ;; esac
  done
  [ $interrupted -ge 1 ] || fail "the run was never interrupted"
}

short=(--blocks 100 --dt 0.05 --velocity 0.05 --warmup 0 --seed 3)

case $2 in
kernels)
  for scheme in semi-implicit verlet; do
    for picker in exponential literal; do
      for kernel in active dense; do
        must_run "${short[@]}" --steps 500000 --scheme $scheme --picker $picker --kernel $kernel \
          --catalogue $kernel.csv --columns centroid,length
      done
      same active.csv dense.csv
    done
  done
  for kernel in active dense; do
    must_run "${short[@]}" --dt 0.01 --steps 1000000 --scheme printed --kernel $kernel \
      --catalogue $kernel.csv
  done
  same active.csv dense.csv
  ;;
resume | terminate | kill)
  settings=("${short[@]}" --steps 6000000 --pe-stride 1000 --columns centroid,length)
  [ "$2" = resume ] && settings=("${short[@]}" --steps 1000000 --pe-stride 7 --columns length)
  must_run "${settings[@]}" --catalogue whole.csv --pe-series whole.pe
  part=("${settings[@]}" --catalogue part.csv --pe-series part.pe --checkpoint part.chk
        --checkpoint-interval 50000)
  if [ "$2" = resume ]; then
    # Finished, then resumed: nothing changes. Refused with other parameters, damaged or none.
    must_run "${part[@]}"
    same whole.csv part.csv
    must_run "${part[@]}" --resume
    same whole.csv part.csv
    cmp whole.pe part.pe || fail "PE series differ"
    cp part.csv keep.csv
    # The other kernel, killed and resumed by either.
    more=(--velocity 0.05 --blocks 24 --dt 0.05 --warmup 0 --seed 3 --steps 100000)
    must_run "${more[@]}" --kernel dense --catalogue whole2.csv
    rm -f part2.chk
    "$program" "${more[@]}" --kernel dense --overwrite --catalogue part2.csv --checkpoint part2.chk \
      --checkpoint-interval 1000 > out.txt 2> err.txt &
    child=$!
    while [ ! -e part2.chk ] && kill -0 $child 2> /dev/null; do :; done
    kill -9 $child 2> /dev/null
    wait $child 2> /dev/null
    [ $? = 137 ] || fail "the dense kernel was never interrupted"
    must_run "${more[@]}" --kernel dense --catalogue part2.csv --checkpoint part2.chk \
      --checkpoint-interval 1000 --resume
    same whole2.csv part2.csv 5
    must_run "${more[@]}" --kernel active --catalogue part2.csv --checkpoint part2.chk --resume
    run "${part[@]}" --resume --kl 0.02 && fail "resumed with another --kl"
    grep -q "kl = 0.01.*expected.*kl = 0.02" err.txt || fail "message: $(cat err.txt)"
    cmp keep.csv part.csv || fail "a refused resume changed the catalogue"
    # What does not fit is found before any file is cut, as that torn line would be.
    cp part.pe keep.pe
    printf '999,1' >> part.csv
    sed -i 's/^# seed = 3$/# seed = 4/' part.pe
    before=$(cksum part.csv part.pe part.chk)
    run "${part[@]}" --resume && fail "resumed with the PE series of another run"
    grep -q "part.pe: cannot resume: parameter 'seed' is '4'" err.txt || fail "message: $(cat err.txt)"
    [ "$before" = "$(cksum part.csv part.pe part.chk)" ] || fail "a refused resume changed files"
    cp keep.pe part.pe
    must_run "${part[@]}" --resume
    cmp keep.csv part.csv || fail "the torn line was not cut"
    head -c 500 part.chk > short.chk
    run "${part[@]}" --checkpoint short.chk --resume && fail "resumed from a torn checkpoint"
    grep -q "short.chk: damaged" err.txt || fail "message: $(cat err.txt)"
    # One byte of a number changed, the file as long as it was.
    cp part.chk flipped.chk
    printf '\x55' | dd of=flipped.chk bs=1 seek=$(($(stat -c %s part.chk) / 2)) conv=notrunc 2> dd.txt
    cmp -s part.chk flipped.chk && printf '\xaa' | dd of=flipped.chk bs=1 seek=$(($(stat -c %s part.chk) / 2)) conv=notrunc 2> dd.txt
    run "${part[@]}" --checkpoint flipped.chk --resume && fail "resumed from a checkpoint with a wrong byte"
    grep -q "flipped.chk: damaged" err.txt || fail "message: $(cat err.txt)"
    # Those of older programs had a format of their own.
    printf 'slider-checkpoint-1\n0123456789abcdef' > old.chk
    run "${part[@]}" --checkpoint old.chk --resume && fail "resumed from an old checkpoint"
    [ "$(cat err.txt)" = "slider_cli: old.chk: checkpoint of version 1, expected version 2: finish that run with the program that started it, or start anew" ] || fail "message: $(cat err.txt)"
    cmp keep.csv part.csv || fail "a refused resume changed the catalogue"
    run "${part[@]}" --checkpoint none.chk --resume && fail "resumed from nothing"
    grep -q "none.chk: cannot be read" err.txt || fail "message: $(cat err.txt)"
  else
    # Interrupted as soon as there is a checkpoint, again and again.
    interrupted=0
    for round in 1 2 3; do
      until_checkpoint
      if [ "$2" = kill ]; then
        kill -9 $child 2> /dev/null
        wait $child 2> /dev/null
        [ $? = 137 ] && interrupted=$((interrupted + 1))
      else
        kill -TERM $child 2> /dev/null
        wait $child
        [ $? = 143 ] && interrupted=$((interrupted + 1))
      fi
    done
    [ $interrupted -ge 1 ] || fail "the run was never interrupted"
    must_run "${part[@]}" --resume
    same whole.csv part.csv
    cmp whole.pe part.pe || fail "PE series differ"
  fi
  ;;
ensemble)
  must_run "${short[@]}" --steps 300000 --ensemble 3 --threads 2 --catalogue 'run{run}.csv'
  for k in 1 2 3; do
    must_run "${short[@]}" --steps 300000 --seed $((k + 2)) --catalogue alone.csv
    same run$k.csv alone.csv 5
  done
  # Stopped by a signal while several run at a time, it goes on as if it had not been.
  stopped=("${short[@]}" --steps 300000 --ensemble 3 --threads 3 --catalogue 'part{run}.csv'
           --checkpoint 'part{run}.chk' --checkpoint-interval 1000)
  for round in 1 2 3 4 5; do
    rm -f part*
    "$program" "${stopped[@]}" > out.txt 2> err.txt &
    child=$!
    while kill -0 $child 2> /dev/null; do
      [ -e part1.chk ] && [ -e part2.chk ] && [ -e part3.chk ] && break
    done
    kill -TERM $child 2> /dev/null
    wait $child
    code=$?
    [ $code = 143 ] && break
  done
  [ $code = 143 ] || fail "the ensemble was never interrupted: $(cat err.txt)"
  must_run "${stopped[@]}" --resume
  for k in 1 2 3; do same run$k.csv part$k.csv 5; done
  printf '%s\n' '# two stiffnesses' '--kl 0.02' '--kl 0.05 --catalogue named.csv' > sets.txt
  must_run "${short[@]}" --steps 300000 --ensemble sets.txt --catalogue set.csv --json all.json
  must_run "${short[@]}" --steps 300000 --kl 0.05 --catalogue alone.csv
  same named.csv alone.csv 5
  grep -q '^# kl = 0.02$' set-1.csv || fail "set-1.csv lacks its kl"
  refused "run 2 of the ensemble: .*--kl" --ensemble <(printf '%s\n' '--seed 1' '--kl -1')
  refused "are the same file" --ensemble <(printf '%s\n' '--catalogue bad.csv --seed 1' \
    '--catalogue bad.csv --seed 2')
  ;;
laws)
  # One block: period of its events between a third of the run and the end, against closed forms.
  # period ARGUMENTS...: sets $period
  one=(--blocks 1 --velocity 0.001 --warmup 0 --friction-range 0.8 0.8 --picker literal --min-size 1e-7)
  period() {
    must_run "${one[@]}" --catalogue one.csv "$@"
    period=$(awk -F, '!/^[#e]/ { t[n++] = $2 } END { a = int(n / 3); if (n - a > 2) printf "%.6g", (t[n - 1] - t[a]) / (n - 1 - a)
                                                     else print 0 }' one.csv)
  }
  # near WHAT EXPRESSION TOLERANCE: the period against an expression of awk
  near() {
    awk -v p="$period" -v tolerance="$3" "BEGIN { pi = atan2(0, -1); theory = $2; d = p / theory - 1
      printf \"%s: period %.5g, theory %.5g\\n\", \"$1\", p, theory
      exit !(d < tolerance && d > -tolerance) }" || fail "$1: period $period, expected $2"
  }
  # Coulomb: loading over twice the drop of strength, D = 0.8 - 0.6, then half a swing and a little: (Fs - Fd) w / (K V)
  for scheme in verlet semi-implicit; do
    period --law coulomb --dynamic-friction 0.75 --kl 0.05 --time 80000 --dt 0.05 --scheme $scheme
    near "coulomb, $scheme" "2 * 0.2 / (0.05 * 0.001) + 2 / sqrt(0.05) * (pi - atan2(0.2 * sqrt(0.05), 0.05 * 0.001))" 1e-4
  done
  # Without a drop the block follows the plate, and swings by V / w: PE falls by no more than 2 Fs V / w each time.
  largest() { awk -F, '!/^[#e]/ && $6 > most { most = $6 } END { print most + 0 }' one.csv; }
  awk -v s="$(largest)" 'BEGIN { exit !(s > 4) }' || fail "Coulomb slips of $(largest), expected (0.8^2 - 0.4^2) / (2 K) = 4.8"
  period --law coulomb --dynamic-friction 1 --kl 0.05 --time 20000 --dt 0.05
  awk -v s="$(largest)" 'BEGIN { exit !(s < 1.01 * 2 * 0.8 * 0.001 / sqrt(0.05)) }' ||
    fail "events of $(largest) although friction never falls"
  # Slip weakening by W = 0.8 (1 - 0.75) / 0.5 = 0.4 per slip. Above this stiffness a slip swings about a slow drift,
  # y = K V / (K - W) (t - sin(w t) / w) with w^2 = K - W, and PE falls while it is faster than the plate; below it a
  # slip is that of the whole drop.
  for kl in 0.5 0.8; do
    period --law slip-weakening --dynamic-friction 0.75 --slip-distance 0.5 --kl $kl --time 4000 --dt 0.01
    awk -v K=$kl -v W=0.4 -v V=0.001 -v s="$(largest)" 'function force(a) { return 0.8 + K * V * (a - K / (K - W) * (a - sin(a))) / w }
      BEGIN { w = sqrt(K - W); a = atan2(sqrt(1 - W * W / K / K), W / K); first = force(a); last = force(8 * atan2(1, 1) - a)
        theory = (first ^ 2 - last ^ 2) / (2 * K); d = s / theory - 1
        printf "slip weakening, stiffness %s: largest slip %.5g, theory %.5g\n", K, s, theory; exit !(d < 0.01 && d > -0.01) }' ||
      fail "slip weakening, stiffness $kl: slips of $(largest)"
  done
  stable=$(largest)
  period --law slip-weakening --dynamic-friction 0.75 --slip-distance 0.5 --kl 0.1 --time 100000 --dt 0.05
  # The drop less what the weakening takes, 0.2 x 0.5 / 2, decides how far: 0.2 D - K D^2 / 2 = 0.05.
  near "slip weakening, stiffness 0.1" "(0.2 + sqrt(0.2 ^ 2 - 2 * 0.1 * 0.05)) / 0.1 / 0.001" 0.02
  awk -v s="$stable" -v most="$(largest)" 'BEGIN { exit !(most > 100 * s) }' ||
    fail "slips below the critical stiffness are no larger than above"
  # Eq. 6 is the default.
  must_run "${short[@]}" --steps 100000 --catalogue default.csv
  must_run "${short[@]}" --steps 100000 --law velocity-weakening --catalogue named.csv
  same default.csv named.csv
  # A chain, interrupted and resumed; the header has the law.
  for law in coulomb slip-weakening; do
    chain=("${short[@]}" --law $law --steps 200000 --scheme verlet)
    must_run "${chain[@]}" --catalogue active.csv --checkpoint whole.chk
    must_run "${chain[@]}" --catalogue dense.csv --kernel dense
    same active.csv dense.csv
    grep -q "^# law = $law" active.csv || fail "no law in the header"
    rm -f part.chk
    "$program" --overwrite "${chain[@]}" --catalogue part.csv --checkpoint part.chk --checkpoint-interval 20000 > out.txt 2> err.txt &
    child=$!
    while [ ! -e part.chk ] && kill -0 $child 2> /dev/null; do :; done
    kill -INT $child 2> /dev/null
    wait $child
    must_run "${chain[@]}" --catalogue part.csv --checkpoint part.chk --checkpoint-interval 20000 --resume
    same active.csv part.csv
  done
  refused "--law = 'rate-state-ageing', expected velocity-weakening, coulomb or slip-weakening" --law rate-state-ageing
  refused "--dynamic-friction needs --law coulomb or slip-weakening" --dynamic-friction 0.5
  refused "--slip-distance needs --law slip-weakening" --law coulomb --slip-distance 0.5
  refused "--dynamic-friction = 1.5, expected at least 0 and at most 1" --law coulomb --dynamic-friction 1.5
  refused "--slip-distance = 0, expected a positive" --law slip-weakening --slip-distance 0
  ;;
bad_input)
  refused "frobnicate" --frobnicate 3
  refused "--kc = -1, expected" --kc -1
  refused "--kl = 0, expected" --kl 0
  refused "--mass" --mass nan
  refused "--velocity" --velocity -0.01
  refused "--blocks" --blocks 0
  refused "--blocks" --blocks many
  refused "--steps" --steps 10.5 --time 1
  refused "--dt = 1.5, expected at most 0.998" --dt 1.5
  refused "--dt = 0.12, expected less than 0.12" --scheme printed --dt 0.12
  refused "--scheme = 'euler', expected printed" --scheme euler
  refused "--picker = 'best', expected" --picker best
  refused "--picker-lambda = 1, expected" --picker-lambda 1
  refused "--friction-range" --friction-range 1.0 0.5
  for number in -1 18446744073709551616 1e3 0x10 ' 7'; do
    refused "seed: expected a whole number from 0 to 18446744073709551615, not '$number'" "--seed=$number"
    refused "threads: expected a whole number from 0 to 4096, not '$number'" "--threads=$number"
  done
  must_run --blocks 16 --steps 100 --seed 18446744073709551615 --catalogue largest.csv
  grep -q '^# seed = 18446744073709551615$' largest.csv || fail "the largest seed: $(head -12 largest.csv)"
  refused "no/such/folder" --catalogue no/such/folder/c.csv
  refused "no/such/folder" --pe-series no/such/folder/pe.txt
  refused "no/such/folder" --checkpoint no/such/folder/c.chk
  refused "no/such/folder" --json no/such/folder/s.json
  refused "--resume requires --checkpoint" --resume
  refused "--paper" --paper --scheme verlet
  refused "--friction-range" --friction-range 0.5 1.0 --friction-range 0.8 0.7
  refused "none.ini" --config none.ini
  # refused_file FORMAT PATTERN: a file with this text
  refused_file() { printf "$1" > wrong.ini; refused "$2" --config wrong.ini; }
  refused_file 'blocsk = 12\n' "blocsk"
  refused_file 'seed = 3\ndt = 0.05\nseed = 4\n' "wrong.ini:3: 'seed' given twice, expected once"
  refused_file 'seed = 3\nseed=3\n' "wrong.ini:2: 'seed' given twice, expected once"
  refused_file 'steps = 100 200\n' "wrong.ini:1: 'steps' is '100 200', expected one value"
  refused_file 'seed = -1\n' "not '-1'"
  refused_file '\357\273\277seed = 1\n' "wrong.ini: begins with a byte order mark"
  refused_file 's\0e\0e\0d\0' "wrong.ini: not a text file"
  refused "/bin/sh: not a text file" --config /bin/sh
  gzip -c wrong.ini > wrong.gz
  refused "wrong.gz: compressed by gzip, expected a file that is not" --config wrong.gz
  # Above dt 0.01 the printed scheme runs, with a warning.
  must_run --blocks 16 --steps 100 --scheme printed --dt 0.05 --catalogue warned.csv
  grep -q 'warning: --dt = 0.05' err.txt || fail "no warning: $(cat err.txt)"
  must_run --blocks 16 --steps 100 --scheme printed --dt 0.01 --catalogue quiet.csv
  [ ! -s err.txt ] || fail "unexpected: $(cat err.txt)"
  # Forced, it blows up sooner or later: an error, not an endless run of NaN.
  run --blocks 64 --steps 3000000 --scheme printed --dt 0.9 --velocity 1 --force --warmup 0 \
    --friction-range 0 0.1 --catalogue burst.csv && fail "the printed scheme survived dt 0.9"
  grep -q "not a finite number" err.txt || fail "message: $(cat err.txt)"
  ;;
header)
  must_run "${short[@]}" --steps 300000 --catalogue c.csv --json -
  [ "$(head -n 1 c.csv)" = '# lsm-catalogue 1' ] || fail "first line"
  [ "$(sed -n 2p c.csv)" = '# model = block-slider' ] || fail "second line"
  for key in blocks kc kl mass velocity friction_low friction_high seed scheme dt steps picker \
    lambda warmup; do
    grep -q "^# $key = " c.csv || fail "no $key in the header"
    grep -q "\"$key\": " out.txt || fail "no $key in the summary"
  done
  events=$(grep -vc '^[#e]' c.csv)
  grep -q "\"events\": $events," out.txt || fail "the summary counts other events"
  ;;
paper)
  must_run --paper --steps 20000 --blocks 16 --catalogue p.csv
  for line in 'scheme = printed' 'dt = 0.01' 'picker = literal' 'lambda = 0.99' 'kl = 0.01' \
    'velocity = 0.01' 'warmup = 0' 'friction_low = 0.5' 'friction_high = 1'; do
    grep -q "^# $line\$" p.csv || fail "--paper does not give '$line'"
  done
  grep -q -- '--friction-range' <<<"$("$program" --help)" || fail "--help"
  ;;
overwrite)
  # Without --overwrite nothing that holds something is replaced, and the refusal leaves no file.
  # kept PATTERN ARGUMENTS...: refused with one line that matches; all files stay as they are
  kept() {
    local pattern=$1 before
    shift
    before=$(ls; cksum ./*.csv ./*.pe ./*.chk 2> /dev/null)
    "$program" "${short[@]}" --steps 300000 "$@" > out.txt 2> ../err.txt && fail "replaced: $*"
    [ "$(wc -l < ../err.txt)" = 1 ] || fail "not one line for $*: $(cat ../err.txt)"
    grep -q -e "$pattern" ../err.txt || fail "message is '$(cat ../err.txt)', expected '$pattern'"
    [ "$before" = "$(ls; cksum ./*.csv ./*.pe ./*.chk 2> /dev/null)" ] || fail "files changed by $*"
  }
  mkdir one && cd one || exit 1
  : > out.txt
  from_the_start() { "$program" "${short[@]}" --steps 300000 "$@" > out.txt 2> ../err.txt; }
  from_the_start --catalogue a.csv --pe-series a.pe --pe-stride 100 --checkpoint a.chk ||
    fail "$(cat ../err.txt)"
  same a.csv a.csv 5
  kept "a.csv: exists, expected a new file for --catalogue; --overwrite replaces it, --resume" \
    --catalogue a.csv --pe-series b.pe --checkpoint b.chk
  kept "a.pe: exists, expected a new file for --pe-series; --overwrite" --catalogue b.csv \
    --pe-series a.pe
  kept "a.chk: exists, expected a new file for --checkpoint; --overwrite" --catalogue b.csv \
    --checkpoint a.chk
  kept "a.csv: exists" --catalogue a.csv --events ruptures
  # Asked to, it does; the new files are those of a first run.
  cp a.csv first.csv
  from_the_start --catalogue a.csv --overwrite --seed 4 || fail "$(cat ../err.txt)"
  cmp -s a.csv first.csv && fail "--overwrite did not replace the catalogue"
  from_the_start --catalogue a.csv --overwrite || fail "$(cat ../err.txt)"
  same a.csv first.csv 5
  # An ensemble looks at all files before the first run; --resume without a checkpoint is a fresh
  # start.
  from_the_start --ensemble 3 --catalogue 'r{run}.csv' --checkpoint 'r{run}.chk' || fail "$(cat ../err.txt)"
  rm r1.csv r1.chk r2.chk
  kept "run 2 of the ensemble: r2.csv: exists" --ensemble 3 --catalogue 'r{run}.csv' \
    --checkpoint 'r{run}.chk'
  kept "run 2 of the ensemble: r2.csv: exists" --ensemble 3 --catalogue 'r{run}.csv' \
    --checkpoint 'r{run}.chk' --resume
  cp r2.csv first.csv
  cp -p r3.csv third.csv
  from_the_start --ensemble 3 --catalogue 'r{run}.csv' --checkpoint 'r{run}.chk' --resume --overwrite ||
    fail "$(cat ../err.txt)"
  same r2.csv first.csv 5
  same r3.csv third.csv 5
  [ -s r1.csv ] || fail "run 1 did not start"
  # What holds nothing, and what is no file, is no reason to refuse.
  : > empty.csv
  from_the_start --catalogue empty.csv --pe-series /dev/null || fail "$(cat ../err.txt)"
  same empty.csv a.csv 5
  ;;
config)
  printf 'blocks = 100\ndt = 0.05\nvelocity = 0.05\nwarmup = 0\nseed = 3\nsteps = 300000\n' > s.ini
  must_run --config s.ini --catalogue a.csv
  must_run "${short[@]}" --steps 300000 --catalogue b.csv
  same a.csv b.csv 5
  # Line ends of Windows, comments, two values where two are expected, text with blanks.
  printf '# a chain\r\nblocks = 100\r\ndt = 0.05\r\n; slow\r\nvelocity = 0.05\r\nwarmup = 0\r\nseed = 3\r\nsteps = 300000\r\n' > s.ini
  printf 'friction-range = 0.5 1.0\r\ncatalogue = "a b.csv"\r\n' >> s.ini
  must_run --config s.ini
  same 'a b.csv' b.csv 5
  ;;
faults)
  # Killed at each system call that has to do with files, or refused it: nothing is lost, nothing silently wrong.
  need_strace
  settings=(--blocks 100 --dt 0.05 --velocity 0.05 --warmup 0 --seed 3 --steps 50000 --pe-stride 50 --checkpoint-interval 20000)
  must_run "${settings[@]}" --catalogue whole.csv --pe-series whole.pe --checkpoint whole.chk
  part=("${settings[@]}" --catalogue part.csv --pe-series part.pe --checkpoint part.chk)
  system_calls part. --overwrite "${part[@]}" > calls
  [ "$(grep -c '^write' calls)" -ge 8 ] && [ "$(grep -c '^rename' calls)" -ge 5 ] && grep -q '^fsync' calls ||
    fail "not the calls of a run: $(cat calls)"
  complete() { # goes on where it can, and compares
    if [ -e part.chk ]; then
      "$program" "${part[@]}" --resume > out.txt 2> err.txt || fail "$1: --resume: $(cat err.txt)"
    else
      must_run "${part[@]}"
    fi
    cmp part.csv whole.csv && cmp part.pe whole.pe && cmp part.chk whole.chk || fail "$1: other bytes"
    for left in part.*; do
      case $left in part.csv | part.pe | part.chk) ;; *) fail "$1: $left is left behind" ;; esac
    done
  }
  while read -r name n; do
    rm -f part.*
    with_fault "$name" "$n" signal=KILL "${part[@]}" && fail "not killed at $name $n"
    complete "killed at $name $n"
    case $name in
    write | openat | fsync | pwrite64) error=ENOSPC ;;
    rename | unlink | truncate | ftruncate) error=EACCES ;;
    *) continue ;;
    esac
    rm -f part.*
    if with_fault "$name" "$n" error=$error "${part[@]}"; then
      cmp part.csv whole.csv && cmp part.pe whole.pe && cmp part.chk whole.chk ||
        fail "$error at $name $n without a word"
    else
      [ "$(wc -l < err.txt)" = 1 ] && grep -q '^slider_cli: ' err.txt ||
        fail "$error at $name $n: '$(cat err.txt)'"
    fi
    complete "$error at $name $n"
  done < calls
  ;;
outputs)
  # One file for one purpose, whatever its names; nothing is begun.
  both() { # ARGUMENTS...: refused, all files as they were
    local before
    before=$(cksum ./* 2> /dev/null)
    "$program" --blocks 16 --time 100 "$@" > ../out.txt 2> ../err.txt && fail "accepted: $*"
    [ "$(wc -l < ../err.txt)" = 1 ] || fail "not one line for $*: $(cat ../err.txt)"
    grep -q "$pattern" ../err.txt || fail "message for $* is '$(cat ../err.txt)', expected '$pattern'"
    [ "$(cksum ./* 2> /dev/null)" = "$before" ] || fail "files changed by $*"
  }
  mkdir here && cd here || exit 1
  printf 'blocks = 16\n' > s.ini
  printf -- '--seed 1\n--seed 2\n' > runs.txt
  ln -s a.csv link.csv
  ln s.ini hard.csv
  pattern='are the same file'
  for overwrite in "" --overwrite; do
    # shellcheck disable=SC2086
    for words in "--catalogue a.csv --pe-series a.csv" "--catalogue a.csv --pe-series ./a.csv" \
      "--catalogue a.csv --pe-series ../here/a.csv" "--catalogue a.csv --checkpoint $PWD/a.csv" \
      "--catalogue a.csv --json a.csv" "--catalogue link.csv --json a.csv" "--pe-series a --checkpoint a" \
      "--checkpoint x --json x" "--ensemble 2 --catalogue a.csv --json a-1.csv" \
      "--ensemble 2 --catalogue a-1.csv --pe-series a{run}-1.csv --catalogue a{run}-1.csv"; do
      both $words $overwrite
    done
  done
  pattern='is read by this run'
  both --config s.ini --catalogue hard.csv --overwrite
  both --config s.ini --json s.ini
  both --ensemble runs.txt --json ./runs.txt
  pattern='reserved for temporary files'
  both --catalogue a.csv.new
  # Two runs of the same files at a time: the second is told who writes them, and changes nothing.
  part=(--blocks 100 --time 1e9 --catalogue p.csv --pe-series p.pe --pe-stride 1000 --checkpoint p.chk --checkpoint-interval 1000)
  "$program" "${part[@]}" 2> /dev/null &
  child=$!
  for _ in $(seq 300); do [ -s p.chk ] && break; sleep 0.1; done
  [ -s p.chk ] || fail "no checkpoint"
  for words in --resume --overwrite "--catalogue other.csv --overwrite"; do
    # shellcheck disable=SC2086
    "$program" "${part[@]}" $words > ../out.txt 2> ../err.txt && fail "a second run beside the first: $words"
    grep -q "is being written by another run: process $child on $(hostname) since" ../err.txt || fail "$(cat ../err.txt)"
    [ "$(wc -l < ../err.txt)" = 1 ] && [ ! -e other.csv ] || fail "$(cat ../err.txt)"
  done
  kill -9 $child
  wait $child 2> /dev/null
  # Lock files that a killed run leaves behind block no other run.
  part=(--blocks 100 --steps 200000 --dt 0.05 --velocity 0.05 --warmup 0 --catalogue q.csv --checkpoint q.chk --checkpoint-interval 1000)
  "$program" "${part[@]}" > ../out.txt 2> ../err.txt || fail "$(cat ../err.txt)"
  ls ./*.lock > /dev/null 2>&1 && rm p.csv.lock p.pe.lock p.chk.lock 2> /dev/null
  ls ./*.lock > /dev/null 2>&1 && fail "a run that ended left a lock: $(ls ./*.lock)"
  cd .. || exit 1
  ;;
ruptures)
  # The same motion: PE and the state of the chain do not depend on the kind of events.
  must_run "${short[@]}" --steps 300000 --catalogue pe.csv --pe-series pe.pe --pe-stride 3
  must_run "${short[@]}" --steps 300000 --events ruptures --catalogue r.csv --pe-series r.pe \
    --pe-stride 3
  cmp <(grep -v '^#' pe.pe) <(grep -v '^#' r.pe) || fail "the kind of events changes PE"
  grep -q '^# events = ruptures$' r.csv || fail "no kind of events in the header"
  grep -q '^# rupture_gap = 0$' r.csv || fail "no gap in the header"
  grep -q '^# events\|^# rupture' pe.csv && fail "the header of pe events has changed"
  must_run "${short[@]}" --steps 300000 --events pe --catalogue pe2.csv
  same pe.csv pe2.csv
  # Both kernels, with ruptures that join over a gap.
  for more in "" "--rupture-gap 0.5" "--scheme semi-implicit" "--scheme printed --dt 0.01"; do
    for kernel in active dense; do
      # shellcheck disable=SC2086
      must_run "${short[@]}" --events ruptures --columns centroid,length --steps 300000 $more \
        --kernel $kernel --catalogue $kernel.csv
    done
    same active.csv dense.csv 100
  done
  # Sizes that are not written.
  must_run "${short[@]}" --steps 300000 --events ruptures --min-size 0.5 --catalogue large.csv
  awk -F, '/^[0-9]/ && $6 >= 0.5 { sub(/^[0-9]*,/, ""); print }' r.csv > expected.txt
  sed -n '/^[0-9]/s/^[0-9]*,//p' large.csv > found.txt
  cmp expected.txt found.txt || fail "--min-size does not keep the ruptures of that size"
  [ -s found.txt ] || fail "no rupture is large enough to test anything"
  # Killed at any moment, and resumed, again and again.
  settings=("${short[@]}" --steps 2000000 --events ruptures --columns centroid,length
            --rupture-gap 0.2 --pe-stride 500)
  must_run "${settings[@]}" --catalogue whole.csv --pe-series whole.pe --checkpoint whole.chk
  part=("${settings[@]}" --catalogue part.csv --pe-series part.pe --checkpoint part.chk
        --checkpoint-interval 20011)
  interrupt_often 5
  must_run "${part[@]}" --resume
  same whole.csv part.csv 1000
  cmp whole.pe part.pe || fail "PE series differ"
  cmp whole.chk part.chk || fail "checkpoints differ"
  # From the one kind of events there is no way to the other.
  run "${settings[@]}" --events pe --catalogue part.csv --checkpoint part.chk --resume &&
    fail "resumed with other events"
  must_run "${short[@]}" --steps 1000 --catalogue pe.csv --checkpoint pe.chk
  run "${short[@]}" --steps 1000 --events ruptures --catalogue pe.csv --checkpoint pe.chk \
    --resume && fail "resumed with other events"
  grep -q "cannot resume: .*expected 'events = ruptures'" err.txt || fail "message: $(cat err.txt)"
  same whole.csv part.csv 1000
  refused "--events = 'slips', expected pe or ruptures" --events slips
  refused "--rupture-gap needs --events ruptures" --rupture-gap 1
  refused "--rupture-gap = -1, expected" --events ruptures --rupture-gap -1
  refused "--rupture-gap = nan, expected" --events ruptures --rupture-gap nan
  run --blocks 64 --steps 3000000 --scheme printed --dt 0.9 --velocity 1 --force --warmup 0 \
    --friction-range 0 0.1 --events ruptures --catalogue burst.csv &&
    fail "the printed scheme survived dt 0.9"
  grep -q "not a finite number" err.txt || fail "message: $(cat err.txt)"
  ;;
leap)
  slow=(--blocks 256 --velocity 1e-3 --warmup 0 --seed 3 --time 250000 --leap 1e-3)
  must_run "${slow[@]}" --catalogue active.csv --json leap.json
  must_run "${slow[@]}" --catalogue dense.csv --kernel dense
  same active.csv dense.csv
  grep -q '^# leap = 0.001$' active.csv || fail "no leap in the header"
  grep -q '^# leap_calm = 50$' active.csv || fail "no calm in the header"
  number() { sed -n "s/^ *\"$1\": \([0-9]*\),*$/\1/p" leap.json; }
  [ "$(number leaps)" -ge 20 ] || fail "$(number leaps) leaps"
  [ $((10 * ($(number steps) - $(number steps_jumped) - $(number steps_leapt)))) -lt "$(number steps)" ] ||
    fail "leaps save too little: $(cat leap.json)"
  # Off, nothing knows of them.
  must_run "${short[@]}" --steps 300000 --catalogue none.csv --checkpoint none.chk --json none.json
  must_run "${short[@]}" --steps 300000 --leap 0 --catalogue off.csv --checkpoint off.chk
  same none.csv off.csv
  cmp none.chk off.chk || fail "--leap 0 changes the checkpoint"
  grep -q leap none.csv none.json && fail "a run without leaps speaks of them"
  # Other laws and schemes. Under Coulomb friction that falls nothing creeps: the leaps end where a block starts.
  for way in "--scheme semi-implicit" "--scheme printed --dt 0.01 --velocity 1e-2 --time 25000" "--law coulomb" \
    "--law coulomb --dynamic-friction 1" "--law slip-weakening" "--law slip-weakening --slip-distance 0.5"; do
    # shellcheck disable=SC2086
    must_run "${slow[@]}" $way --catalogue active.csv
    # shellcheck disable=SC2086
    must_run "${slow[@]}" $way --catalogue dense.csv --kernel dense
    [ "$way" = "--law coulomb --dynamic-friction 1" ] && min=0 || min=3
    same active.csv dense.csv $min
  done
  # Killed and resumed again and again; a series with samples within leaps.
  for events in pe ruptures; do
    settings=("${slow[@]}" --events $events --min-size 1e-3 --columns centroid,length --pe-stride 700)
    must_run "${settings[@]}" --catalogue whole.csv --pe-series whole.pe --checkpoint whole.chk
    must_run "${settings[@]}" --catalogue alone.csv
    same whole.csv alone.csv
    rm -f part.csv part.pe part.chk
    part=("${settings[@]}" --catalogue part.csv --pe-series part.pe --checkpoint part.chk --checkpoint-interval 3001)
    interrupt_often 6
    must_run "${part[@]}" --resume
    same whole.csv part.csv
    cmp whole.pe part.pe || fail "PE series differ"
    cmp whole.chk part.chk || fail "checkpoints differ"
    run "${part[@]}" --leap 1e-2 --resume && fail "resumed with other leaps"
    grep -q "leap = 0.001.*expected.*leap = 0.01" err.txt || fail "message: $(cat err.txt)"
  done
  must_run "${slow[@]}" --ensemble 2 --catalogue 'run{run}.csv'
  must_run "${slow[@]}" --seed 4 --catalogue alone.csv
  same run2.csv alone.csv 5
  refused "--leap = -1, expected a finite number >= 0" --leap -1
  refused "--leap = nan, expected" --leap nan
  refused "--kernel = 'scalar', expected active or dense" --kernel scalar
  ;;
*)
  fail "no case $2"
  ;;
esac
exit 0
