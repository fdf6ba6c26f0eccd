#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Tests of the campaign: campaign_test.sh SOURCE_DIR BIN_DIR CASE
set -u
export LC_ALL=C
source=$1 bin=$2
work=$(mktemp -d)
trap 'kill_all; umount "$work/small" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1

fail() {
  echo "FAILED: $*" >&2
  [ ! -f out.txt ] || tail -n 20 out.txt >&2
  exit 1
}

fault=(--bin "$bin" --only faults --lengths 40 --seeds 1 --no-report --series keep --jobs 2 --steps 30000 --checkpoint 1500
  --fault width=20 --fault settle=500 --fault velocity=0.01 --fault thermo=1000)
slider=(--bin "$bin" --only sliders --blocks 100 --seeds 1 --no-report --jobs 1 --steps 20000000 --slider velocity=0.05
  --slider dt=0.05 --slider warmup=0 --slider checkpoint-interval=50000 --slider pe-series=series.bin
  --slider pe-stride=100 --slider pe-format=binary)
# campaign FOLDER OPTIONS...
campaign() { "$source/inputs/campaign.sh" --output "$1" "${@:2}" >out.txt 2>&1; }

# Programs that work in a run's folder below the given one.
programs_in() {
  local p
  for p in /proc/[0-9]*; do
    [[ $(readlink "$p/cwd" 2>/dev/null) != "$1"/* ]] || echo "${p#/proc/}"
  done
}
kill_all() {
  local p
  for p in $(programs_in "$work"); do kill -9 "$p" 2>/dev/null; done
}

# whole OPTIONS...: the uninterrupted campaign; takes its time, since moments to kill at have to fit the machine
whole() {
  local start=$(date +%s%N)
  campaign whole "$@" || fail "the uninterrupted campaign ended with $?"
  whole_ms=$((($(date +%s%N) - start) / 1000000))
}

# killed FOLDER OPTIONS...: the campaign is killed at random moments, in four ways, until it has gone on from a
# checkpoint eight times; then it runs to its end.
killed() {
  local folder=$1 round child resumed=0 p
  shift
  RANDOM=7
  for ((round = 0; round < 40 && resumed < 8; round++)); do
    "$source/inputs/campaign.sh" --output "$folder" "$@" >out.txt 2>&1 &
    child=$!
    # Most moments are after the programs have begun, some before.
    [ $((round % 5)) = 4 ] ||
      for ((p = 0; p < 200; p++)); do grep -q 'starts\|goes on' out.txt 2>/dev/null && break; sleep 0.02; done
    # 1 to 10 % of the whole run, later longer, so that a machine that became busy gets to a checkpoint as well
    p=$((whole_ms * (RANDOM % 90 + 10) * (10 + round) / 10000))
    sleep "$((p / 1000)).$(printf %03d $((p % 1000)))"
    if ! kill -0 $child 2>/dev/null; then
      wait $child || fail "ended with $? on its own"
      break
    fi
    case $((round % 4)) in
      0) kill -9 $child ;; # the campaign: its programs end, too
      1) # the programs: the campaign says so
        p=$(programs_in "$work/$folder")
        # None but passing ones before they have begun. The process ids are words on purpose.
        [ $((round % 5)) != 4 ] || p=$child
        kill -9 ${p:-$child}
        ;;
      2) kill -TERM $child ;;
      3)
        kill -STOP $child # all in one moment
        for p in $child $(programs_in "$work/$folder"); do kill -9 "$p"; done
        ;;
    esac 2>/dev/null
    wait $child 2>/dev/null
    [ $? -ne 0 ] || break
    grep -q 'goes on from its checkpoint' out.txt && resumed=$((resumed + 1))
  done
  echo "killed in $round rounds, $resumed of them after a checkpoint"
  [ $resumed -ge 4 ] || fail "gone on only $resumed times"
  campaign "$folder" "$@" || fail "the last round ended with $?"
}

# same A B EVENTS: the same bytes, at least so many events
same() {
  cmp "$1" "$2" || fail "$1 and $2 differ"
  [ "$(grep -vc '^[#e]' "$1")" -ge "$3" ] || fail "$1 has too few events to test anything"
}

# settings_are FILE PROGRAM WORDS...: a campaign goes on only with runs of these settings, line by line, so that their
# text must stay what it was when a campaign began.
settings_are() {
  local file=$1 program=$2
  shift 2
  diff <(printf '%s\n' "$@") <(tail -n +2 "$file") >&2 || fail "$file: other settings"
  [[ $(head -n 1 "$file") == "program = $program "* ]] || fail "$file begins with $(head -n 1 "$file")"
}

sums() { (cd "$1" && find . -type f ! -name output.txt ! -name lock | sort | xargs cksum); }

# refused PATTERN FOLDER OPTIONS...: ends with an error that matches, and leaves all files as they are
refused() {
  local pattern=$1 before
  before=$(sums "$2")
  campaign "${@:2}" && fail "accepted, expected '$pattern'"
  grep -q -e "$pattern" out.txt || fail "expected a message with '$pattern'"
  [ "$(sums "$2")" = "$before" ] || fail "files were changed, message '$pattern'"
}

case $3 in
kill_slider)
  whole "${slider[@]}"
  killed part "${slider[@]}"
  same whole/*/catalogue.csv part/*/catalogue.csv 100
  cmp whole/*/series.bin part/*/series.bin || fail "PE series differ"
  ;;
kill_fault_*)
  r=${3//[^0-9]/}
  # Long enough for the kills to fall into the run and not into its start.
  longer=("${fault[@]}" --steps 400000 --checkpoint 10000 --ranks "$r")
  whole "${longer[@]}"
  killed part "${longer[@]}"
  same whole/fault_40/fault.catalogue.csv part/fault_40/fault.catalogue.csv 15
  cmp whole/fault_40/fault.pe.bin part/fault_40/fault.pe.bin || fail "PE series differ"
  ;;
refuse_slider)
  short=("${slider[@]}" --steps 300000)
  campaign one "${short[@]}" || fail "ended with $?"
  campaign one "${short[@]}" && grep -q '1 of 1 runs done' out.txt && ! grep -q starts out.txt || fail "done, but begun again"
  campaign other "${short[@]}" --slider seed=2 || fail "ended with $?"
  run=$(echo one/slider*)
  settings_are "$run/settings.txt" slider_cli '--scheme verlet' '--dt 0.05' '--picker exponential' \
    '--picker-memory-time 1' '--warmup 12000' '--blocks 100' '--seed 1' '--steps 300000' '--velocity 0.05' '--dt 0.05' \
    '--warmup 0' '--checkpoint-interval 50000' '--pe-series series.bin' '--pe-stride 100' '--pe-format binary'
  refused "begun with other settings: '--steps 300000', expected '--steps 400000'" one "${short[@]}" --steps 4e5
  cp -r one keep
  sed -i 's/^program = slider_cli .*/program = slider_cli 0.0/' "$run/settings.txt"
  refused "begun with other settings: 'program = slider_cli 0.0'" one "${short[@]}"
  cp "keep/${run#*/}/settings.txt" "$run"
  # Not done any more; each of these checkpoints is looked at by slider_cli.
  rm "$run/summary.json"
  cp "other/${run#*/}/checkpoint.bin" "$run"
  refused "cannot resume: checkpoint has 'seed = 2', expected 'seed = 1'" one "${short[@]}"
  printf 'slider-checkpoint-1\nand so on' >"$run/checkpoint.bin"
  refused "checkpoint of version 1, expected version 2" one "${short[@]}"
  head -c -1 "keep/${run#*/}/checkpoint.bin" >"$run/checkpoint.bin"
  refused "damaged checkpoint" one "${short[@]}"
  head -c 1000 "keep/${run#*/}/checkpoint.bin" >"$run/checkpoint.bin"
  refused "damaged checkpoint" one "${short[@]}"
  cp "keep/${run#*/}/checkpoint.bin" "$run"
  sed -i '$d' "$run/catalogue.csv"
  refused "events up to the checkpoint, expected" one "${short[@]}"
  mv "$run/catalogue.csv" away.csv
  refused "catalogue.csv is missing, but there is a checkpoint" one "${short[@]}"
  cp "keep/${run#*/}/catalogue.csv" "$run"
  campaign one "${short[@]}" || fail "not mended"
  same "$run/catalogue.csv" "keep/${run#*/}/catalogue.csv" 10
  # Folders
  : >file
  campaign file/sub "${short[@]}" && fail "a folder below a file"
  grep -q "cannot write to folder 'file/sub'" out.txt || fail "no message about the folder"
  if [ "$(id -u)" != 0 ]; then
    mkdir closed && chmod a-w closed
    campaign closed "${short[@]}" && fail "a folder without the right to write"
    grep -q "cannot write to folder" out.txt || fail "no message about the right to write"
  fi
  mkdir -p strange/slider_ours_100_1 && echo data >strange/slider_ours_100_1/catalogue.csv
  refused "holds files, but no settings.txt" strange "${short[@]}"
  campaign one "${short[@]}" --list && grep -q "slider_ours_100_1 *done *300000 of 300000 steps" out.txt || fail "the list"
  exec 8>>one/lock && flock 8
  campaign one "${short[@]}" && fail "two campaigns in one folder"
  grep -q "another campaign works in" out.txt || fail "no message about the other campaign"
  # Tables: the runs that they ask for, and lines that name what is wrong
  runs_of() { # TABLE OPTIONS...
    printf '%s\n' "$1" >table.txt
    campaign none "${slider[@]}" --blocks 100,300 --table table.txt --list "${@:2}" && cut -d ' ' -f 1 out.txt | xargs
  }
  row='slider s_SIZE_SEED 200 50-150 1-2 1e5 none --dt 0.05'
  [ "$(runs_of "$row")" = s_100_1 ] || fail "others of a table: $(cat out.txt)"
  [ "$(runs_of "$row" --seeds 3 --blocks 200,150,50)" = "s_200_1 s_200_2 s_200_3 s_150_1 s_150_2 s_150_3" ] ||
    fail "seeds of a table: $(cat out.txt)"
  [ "$(runs_of "slider k_VALUE 100 none 4 1e5 kl=1,2 --dt 0.05")" = "k_1_seed_4 k_2_seed_4" ] ||
    fail "values of a table: $(cat out.txt)"
  while IFS='|' read -r bad said; do
    runs_of "$bad" && fail "accepted: $bad"
    [ "$(cat out.txt)" = "campaign: table.txt:1: $said" ] || fail "expected '$said' for $bad"
  done <<'END'
slider s_SIZE 100 none 1 1e5 none|7 columns, expected program, name, sizes, others, seeds, steps, each and settings
chain s_SIZE 100 none 1 1e5 none --dt 1|program "chain", expected fault or slider
slider s_SIZE 100;300 none 1 1e5 none --dt 1|sizes "100;300", expected numbers with commas between them, or none
slider s_SIZE 100 all 1 1e5 none --dt 1|others "all", expected A-B, A- or none
slider s_SIZE 100 none 2-3 1e5 none --dt 1|seeds "2-3", expected 1-N or a seed
slider s_SIZE 100 none 1 1.5 none --dt 1|steps "1.5", expected a whole number of at least 1
slider s_SIZE 100 none 1 1e5 kl --dt 1|each "kl", expected NAME=V,V... or none
slider s_SIZE 100 none 1 1e5 none @ours|@ours stands for nothing, expected a line ours = ... before
slider s 100,300 none 1 1e5 none --dt 1|there is a run s already (line 1), expected another name
END
  runs_of '# nothing' && fail "accepted: a table without runs"
  # Options
  for bad in '--steps 1.5' '--only chains' '--lengths 12,x' '--jobs 0' '--frobnicate' '--slider velocity' '--hours'; do
    # The words of an option are words on purpose.
    campaign none "${short[@]}" $bad && fail "accepted: $bad"
    [ "$(wc -l <out.txt)" = 1 ] || fail "not one line for $bad"
    [ ! -e none ] || fail "output left behind by $bad"
  done
  ;;
refuse_fault)
  short=("${fault[@]}" --steps 4500)
  campaign whole "${fault[@]}" --steps 6000 || fail "ended with $?"
  campaign one "${short[@]}" || fail "ended with $?"
  campaign other "${short[@]}" --fault mu=0.5 || fail "ended with $?"
  settings_are one/fault_40/settings.txt lmp 'length 40' 'seed 1' 'checkpoint 1500' 'location yes' 'series yes' 'width 20' \
    'settle 500' 'velocity 0.01' 'thermo 1000'
  longer=("${fault[@]}" --steps 6000)
  refused "begun with other settings: 'checkpoint 1500', expected 'checkpoint 2000'" one "${longer[@]}" --checkpoint 2000
  cp -r one keep
  newest=fault.restart.5000
  printf 'x' | dd of=one/fault_40/$newest bs=1 seek=200000 conv=notrunc status=none
  refused "$newest is damaged (its checksum is not the one in $newest.info)" one "${longer[@]}"
  # As the message says: without it the run goes on from the one before.
  cp -r one mended
  rm mended/fault_40/$newest mended/fault_40/$newest.info
  campaign mended "${longer[@]}" || fail "not gone on from the restart file before it"
  grep -q 'goes on from its checkpoint at step 3000' out.txt || fail "not gone on from step 3000"
  same mended/fault_40/fault.catalogue.csv whole/fault_40/fault.catalogue.csv 5
  # A program of a killed campaign still writes its catalogue: waited for.
  cp -r one busy && cp keep/fault_40/$newest busy/fault_40
  mv busy/fault_40/fault.catalogue.csv away.csv
  (flock -s 7 && : >held && sleep 2 && mv away.csv busy/fault_40/fault.catalogue.csv) 7>>busy/fault_40/lock &
  while [ ! -e held ]; do sleep 0.02; done
  campaign busy "${short[@]}" && grep -q '1 of 1 runs done' out.txt || fail "files looked at while somebody writes"
  cp other/fault_40/$newest other/fault_40/$newest.info one/fault_40
  refused "$newest was written by a run with other settings" one "${longer[@]}"
  cp keep/fault_40/$newest keep/fault_40/$newest.info one/fault_40
  sed -i '$d' one/fault_40/fault.catalogue.csv
  refused "events before step 5000, expected" one "${longer[@]}"
  rm one/fault_40/fault.catalogue.csv
  refused "fault.catalogue.csv is missing, but there is a checkpoint" one "${longer[@]}"
  # By hand, without the campaign: LAMMPS and the compute refuse a file that is cut, and other parameters.
  cp -r keep hand && cd hand/fault_40 || exit 1
  before=$(cksum fault.catalogue.csv fault.pe.bin)
  by_hand() {
    "$bin/lmp" -in "$source/inputs/fault.in" -log none -var prefix fault -var length 40 -var width 20 -var settle 500 \
      -var velocity 0.01 -var location yes -var checkpoint 1500 -var steps 6000 "$@" >../../out.txt 2>&1 </dev/null
  }
  head -c 100000 $newest >cut
  for words in "-var restart cut" "-var restart none" "-var restart $newest -var seed 2" \
    "-var restart $newest -var mu 0.5"; do
    by_hand $words && { cd ../..; fail "LAMMPS went on with $words"; }
    grep -q ERROR ../../out.txt || { cd ../..; fail "no message for $words"; }
    [ "$before" = "$(cksum fault.catalogue.csv fault.pe.bin)" ] || { cd ../..; fail "files were changed by $words"; }
  done
  by_hand -var restart $newest || { cd ../..; fail "by hand"; }
  cd ../..
  same hand/fault_40/fault.catalogue.csv whole/fault_40/fault.catalogue.csv 5
  ;;
disk_full)
  mkdir small
  said="failed: .*(cannot write.*No space left on device|cannot write restart file|I/O error while writing restart).*no space left on the disk"
  mount -t tmpfs -o size=1m none small 2>/dev/null || { echo "skipped: mounting a small disk is not allowed"; exit 77; }
  campaign whole "${fault[@]}" || fail "the uninterrupted campaign ended with $?"
  campaign small "${fault[@]}" && fail "done on a full disk"
  grep -qE "$said" out.txt || fail "no message about the disk"
  mv out.txt first.txt
  campaign small "${fault[@]}" && fail "done on a full disk"
  mount -o remount,size=64m "$work/small"
  campaign small "${fault[@]}" || fail "not gone on once there was space"
  same small/fault_40/fault.catalogue.csv whole/fault_40/fault.catalogue.csv 15
  cmp small/fault_40/fault.pe.bin whole/fault_40/fault.pe.bin || fail "PE series differ"
  ;;
report)
  # Ends with pages and figures of the runs that are there, and with none of those that are not.
  drawn() {
    local name
    for name in "$@"; do
      for file in one/figures/$name.{png,svg,csv,gp,txt}; do [ -s "$file" ] || fail "no $file"; done
    done
    [ "$(grep -c '<svg' one/report.html)" -ge 3 ] || fail "report.html has no figures"
  }
  campaign one --bin "$bin" --only sliders --blocks 256 --seeds 1 --steps 1200000 || fail "ended with $?"
  drawn fig13_slider_sizes fig15_slider_intervals slider_fit rupture_fit
  grep -q '"slider 256, seed 1"' one/figures/fig13_slider_sizes.csv || fail "no label in fig13_slider_sizes.csv"
  grep -q '"slider 256, seed 1, ruptures"' one/figures/rupture_fit.csv || fail "no label in rupture_fit.csv"
  [ -z "$(ls one/figures | grep 'fault\|fig7')" ] || fail "figures of nothing"
  options=()
  for word in "${fault[@]}"; do [ "$word" = --no-report ] || options+=("$word"); done
  campaign one "${options[@]}" || fail "ended with $?"
  drawn fig12_fault_sizes fig14_fault_intervals fault_fit
  ;;
image)
  # Pictures of every fourth of 20 steps, and one on its own.
  picture() {
    "$bin/lmp" -in "$source/inputs/fault.in" -log none -var length 20 -var width 15 -var settle 100 -var steps 20 \
      -var extra fault_image -var pixels 400 -var high 300 "$@" >out.txt 2>&1 </dev/null || fail "$*"
  }
  picture -var prefix film -var from 102 -var to 118 -var every 4
  [ "$(echo film.*.png)" = "$(printf " film.%09d.png" 102 106 110 114 118 | cut -c 2-)" ] || fail "pictures: $(echo *.png)"
  picture -var prefix one -var from 110 -var to 111 -var every 9
  [ "$(echo one.*.png)" = one.000000110.png ] || fail "pictures: $(echo *.png)"
  for file in *.png; do
    [ "$(head -c 4 "$file" | tail -c 3)" = PNG ] && [ "$(stat -c %s "$file")" -gt 5000 ] || fail "$file is no picture"
  done
  ;;
*) fail "no case $3" ;;
esac
exit 0
