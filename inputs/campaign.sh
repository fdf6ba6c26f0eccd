#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# The whole study: the runs of campaign.txt, then report pages and figures. Run it again to go on where it was stopped;
# --help has the options.
#
# Each run has a folder of its own below the output folder:
#   settings.txt    what the run was begun with; other settings need another folder
#   output.txt      what the program said
#   catalogue.csv   (sliders) or fault.catalogue.csv, fault.pe.bin (faults)
#   checkpoint.bin, summary.json  (sliders) or fault.restart.STEP with its .info (faults)
# What is done is found out from these files each time.
set -uo pipefail
export LC_ALL=C
root=$(cd "$(dirname "$0")/.." && pwd)
build=${LSM_BUILD_DIR:-$root/build}

usage() {
  cat <<END
usage: inputs/campaign.sh [OPTIONS]
Runs, or goes on with, the campaign, and ends with report pages and the folder figures. Defaults in brackets.
  --output DIR        folder of the results [\$LSM_BUILD_DIR/campaign or build/campaign]
  --only KIND         sliders or faults [both]
  --table FILE        table of the runs [inputs/campaign.txt]
  --lengths L,L...    lengths of the faults [as in the table]
  --blocks N,N...     numbers of blocks of the sliders [as in the table]
  --kl K,K...         leaf springs of the runs after Fig. 7, 1928 blocks [as in the table; none without 1928 blocks]
  --seeds S           seeds 1 to S where the table has 1-N [1-N]
  --steps N           time steps of each run [as in the table]
  --quick             a trial of some minutes: --table inputs/campaign-quick.txt
  --hours H           stop after so many hours (faults lose the steps since the last checkpoint) [no limit]
  --jobs J            cores in use at a time [all: $(nproc)]
  --ranks R           MPI ranks of each fault [as many as have 60 units of length each, at most J]
  --checkpoint N      steps between checkpoints of the faults [50000]
  --series WHAT       PE series of the faults, every step: compress (when a run is done), keep or no [compress]
  --fault NAME=VALUE  any further variable of fault.in, for all faults; may be repeated
  --slider NAME=VALUE any further option of slider_cli, for all sliders; may be repeated
  --bin DIR           folder of lmp, slider_cli and postproc [built in \$LSM_BUILD_DIR or build]
  --no-report         no report pages and figures at the end
  --list              only say how far each run is
END
}
die() { echo "campaign: $*" >&2; exit 2; }

# ---- options

output=$build/campaign only=both bin= list=no report=yes series=compress table=$root/inputs/campaign.txt
lengths= blocks= kl= seeds= hours= jobs=$(nproc) ranks= checkpoint=50000 steps=
fault_more=() slider_more=()
while [ $# -gt 0 ]; do
  case $1 in
    --help | -h) usage; exit 0 ;;
    --quick) table=$root/inputs/campaign-quick.txt; shift; continue ;;
    --no-report) report=no; shift; continue ;;
    --list) list=yes; shift; continue ;;
    --output | --only | --lengths | --blocks | --kl | --seeds | --steps | --hours | --jobs | --ranks | --checkpoint | \
      --series | --bin | --fault | --slider | --table) ;;
    *) die "unknown option '$1' (--help lists the options)" ;;
  esac
  [ $# -ge 2 ] || die "$1 needs a value"
  case $1 in
    --output) output=$2 ;; --table) table=$2 ;; --only) only=$2 ;; --lengths) lengths=$2 ;; --blocks) blocks=$2 ;; --kl) kl=$2 ;;
    --seeds) seeds=$2 ;; --steps) steps=$2 ;; --hours) hours=$2 ;; --jobs) jobs=$2 ;; --ranks) ranks=$2 ;;
    --checkpoint) checkpoint=$2 ;; --series) series=$2 ;; --bin) bin=$2 ;;
    --fault) fault_more+=("$2") ;; --slider) slider_more+=("$2") ;;
  esac
  shift 2
done

# whole OPTION VALUE: the value as digits; 1e7 is a whole number, too
whole() {
  [[ $2 =~ ^[0-9]+([.][0-9]+)?(e[+]?[0-9]+)?$ ]] && awk -v x="$2" 'BEGIN { if (x != int(x) || x < 1 || x > 9e15) exit 1
    printf "%.0f", x }' || die "$1 = '$2', expected a whole number of at least 1"
}
# numbers OPTION LIST: refuses anything else than numbers with commas
numbers() {
  [[ $2 =~ ^[0-9.]+(,[0-9.]+)*$ ]] || die "$1 = '$2', expected numbers with commas between them"
}
[[ $only =~ ^(both|sliders|faults)$ ]] || die "--only = '$only', expected sliders or faults"
[[ $series =~ ^(compress|keep|no)$ ]] || die "--series = '$series', expected compress, keep or no"
[[ -z $hours || $hours =~ ^[0-9]*[.]?[0-9]+$ ]] || die "--hours = '$hours', expected a number of hours"
for setting in ${fault_more[@]+"${fault_more[@]}"} ${slider_more[@]+"${slider_more[@]}"}; do
  [[ $setting =~ ^[a-z_-]+=[^\ ]+$ ]] || die "'$setting', expected NAME=VALUE after --fault and --slider"
  case $setting in
    steps=* | length=* | checkpoint=* | prefix=* | series=* | restart=* | run=* | blocks=* | catalogue=* | json=* | resume=* | \
      config=* | ensemble=*) die "'${setting%%=*}' is set by the campaign itself, expected no --fault or --slider for it" ;;
  esac
done
for setting in ${fault_more[@]+"${fault_more[@]}"}; do
  [[ $setting != seed=* ]] || die "'seed' of the faults is set by the campaign itself (--seeds), expected no --fault for it"
done
[ -z "$steps" ] || steps=$(whole --steps "$steps") || exit 2
[ -z "$seeds" ] || seeds=$(whole --seeds "$seeds") || exit 2
jobs=$(whole --jobs "$jobs") && checkpoint=$(whole --checkpoint "$checkpoint") || exit 2
[ -z "$ranks" ] || ranks=$(whole --ranks "$ranks") || exit 2
[ -z "$lengths" ] || numbers --lengths "$lengths"
[ -z "$blocks" ] || numbers --blocks "$blocks"
[ -z "$kl" ] || numbers --kl "$kl"

# ---- the table

# One line for each run: program, name, size, seed, steps, NAME=VALUE or none, settings
read_table() {
  awk -v file="$table" -v lengths="$lengths" -v blocks="$blocks" -v kl="$kl" -v most="$seeds" -v steps="$steps" '
    function stop(what) { print "campaign: " file ":" NR ": " what >"/dev/stderr"; failed = 1; exit 2 }
    function is_list(text) { return text ~ /^[0-9.]+(,[0-9.]+)*$/ }
    function is_among(size, sizes, n,   i) { for (i = 1; i <= n; i++) if (sizes[i] == size) return 1; return 0 }
    /^ *(#|$)/ { next }
    $2 == "=" { text = $0; sub(/^[^=]*= */, "", text); known[$1] = text; next }
    {
      if (NF < 8) stop(NF " columns, expected program, name, sizes, others, seeds, steps, each and settings")
      if ($1 != "fault" && $1 != "slider") stop("program \"" $1 "\", expected fault or slider")
      if ($3 != "none" && !is_list($3)) stop("sizes \"" $3 "\", expected numbers with commas between them, or none")
      if ($4 != "none" && $4 !~ /^[0-9.]+-[0-9.]*$/) stop("others \"" $4 "\", expected A-B, A- or none")
      if ($5 !~ /^(1-)?[1-9][0-9]*$/) stop("seeds \"" $5 "\", expected 1-N or a seed")
      if ($6 + 0 != int($6 + 0) || $6 + 0 < 1) stop("steps \"" $6 "\", expected a whole number of at least 1")
      if ($7 != "none" && $7 !~ /^[a-z_-]+=[^,]+(,[^,]+)*$/) stop("each \"" $7 "\", expected NAME=V,V... or none")
      settings = ""
      for (i = 8; i <= NF; i++) {
        word = $i
        if (word ~ /^@/) {
          if (!(substr(word, 2) in known)) stop(word " stands for nothing, expected a line " substr(word, 2) " = ... before")
          word = known[substr(word, 2)]
        }
        settings = settings (i > 8 ? " " : "") word
      }
      first = last = $5
      if (sub(/^1-/, "", last)) { first = 1; if (most != "") last = most }
      key = $7; sub(/=.*/, "", key)
      list = $7; sub(/^[^=]*=/, "", list)
      if (key == "kl" && kl != "") list = kl
      values = $7 == "none" ? 1 : split(list, value, ",")
      usual = $3 == "none" ? 0 : split($3, own, ",")
      wanted = $1 == "fault" ? lengths : blocks
      sizes = wanted != "" ? split(wanted, size, ",") : usual
      if (wanted == "") for (i = 1; i <= usual; i++) size[i] = own[i]
      low = $4 == "none" ? 1 : $4 + 0
      high = $4; sub(/.*-/, "", high)
      if ($4 == "none") high = 0; else if (high == "") high = 1e300
      for (i = 1; i <= sizes; i++) {
        if (!is_among(size[i], own, usual) && !(size[i] + 0 > low && size[i] + 0 <= high + 0)) continue
        for (seed = first + 0; seed <= last + 0; seed++)
          for (v = 1; v <= values; v++) {
            name = $2
            seeded = gsub(/SEED/, seed, name)
            gsub(/SIZE/, size[i], name); gsub(/VALUE/, value[v], name)
            if (!seeded && seed > 1) name = name "_seed_" seed
            if (name in used) stop("there is a run " name " already (line " used[name] "), expected another name")
            used[name] = NR
            printf "%s\t%s\t%s\t%d\t%.0f\t%s\t%s\n", $1, name, size[i], seed, steps != "" ? steps : $6, \
              $7 == "none" ? "none" : key "=" value[v], settings
          }
      }
    }
    END { if (!failed && !NR) { print "campaign: " file ": empty, expected a table of runs" >"/dev/stderr"; exit 2 } }
  ' "$table"
}
[ -r "$table" ] || die "cannot read $table, expected a table of the runs"
runs=$(read_table) || exit 2

# ---- programs

if [ -z "$bin" ]; then
  bin=$build/bin
  if [ $list = no ]; then
    . "$root/lammps-pkg/cmake/debian-packages.sh"
    # The lists are words on purpose.
    install_debian_packages $lammps_packages $plot_packages $postproc_packages || exit 1
    cmake -S "$root" -B "$build" -G Ninja -DLSM_BUILD_LAMMPS=ON -DLSM_BUILD_SLIDER=ON -DLSM_BUILD_POSTPROC=ON &&
      cmake --build "$build" --target lmp slider_cli postproc || die "the programs could not be built"
  fi
fi
bin=$(cd "$bin" 2>/dev/null && pwd) || die "no folder '$bin', expected one with lmp, slider_cli and postproc"
needed=()
[ "$only" = sliders ] || needed+=(lmp)
[ "$only" = faults ] || needed+=(slider_cli)
for program in "${needed[@]}"; do [ -x "$bin/$program" ] || die "no program $bin/$program"; done
[ "$only" = sliders ] || lammps_version=$("$bin/lmp" -h 2>/dev/null | sed -n 's/^Large-scale.*Parallel Simulator - *//p')
[ "$only" = faults ] || slider_version=$("$bin/slider_cli" --version 2>/dev/null)
[ "$only" = sliders ] || [ -n "$lammps_version" ] || die "$bin/lmp does not tell its version"
[ "$only" = faults ] || [ -n "$slider_version" ] || die "$bin/slider_cli does not tell its version"
. "$root/inputs/mpi-settings.sh"

# ---- folder and lock

if [ $list = no ]; then
  mkdir -p "$output" 2>/dev/null && output=$(cd "$output" && pwd) && [ -w "$output" ] ||
    die "cannot write to folder '$output'"
  { exec 9>>"$output/lock"; } 2>/dev/null || die "cannot write to folder '$output'"
  # What a killed campaign had just begun, packing a series for example, holds the lock until it ends.
  flock -w 5 9 || die "another campaign works in $output"
fi

# ---- the runs: name, kind, cores, settings (the command without what may change), estimated core seconds

names=() kinds=() cores=() goals=() settings=() costs=()
add_run() {
  names+=("$1") kinds+=("$2") cores+=("$3") goals+=("$4") settings+=("$5") costs+=("$6")
}
series_word=yes
[ "$series" != no ] || series_word=no
add_fault() { # NAME LENGTH SEED STEPS EACH SETTINGS
  local length=$2 seed=$3 steps=$4 r=$ranks words
  [ -n "$r" ] || r=$(awk -v l="$length" -v j="$jobs" 'BEGIN { r = int(l / 60); if (r < 1) r = 1; if (r > j) r = j; print r }')
  [ "$r" -le "$jobs" ] || die "--ranks = $r, expected at most --jobs = $jobs"
  words="length=$length seed=$seed checkpoint=$checkpoint $6 series=${series_word}"
  [ "$5" = none ] || words+=" $5"
  words+="${fault_more[*]:+ ${fault_more[*]}}"
  fault_steps=$steps
  # about 65 discs per unit of length, 44 million steps of one disc per second and core
  add_run "$1" fault "$r" "$steps" "program = lmp $lammps_version
$(tr " =" "\n " <<<"$words")" "$(awk -v l="$length" -v n="$steps" 'BEGIN { print 65 * l * n / 44e6 }')"
}
add_slider() { # NAME BLOCKS SEED STEPS EACH SETTINGS
  local words="$6 --blocks $2" setting
  [ "$5" = none ] || words+=" --${5%%=*} ${5#*=}"
  words+=" --seed $3 --steps $4"
  for setting in ${slider_more[@]+"${slider_more[@]}"}; do words+=" --${setting%%=*} ${setting#*=}"; done
  add_run "$1" slider 1 "$4" "program = slider_cli $slider_version
${words// --/$'\n'--}" "$(awk -v b="$2" -v n="$4" 'BEGIN { print n * (2e-7 + 3e-10 * b) }')"
}
fault_steps=0
while IFS=$'\t' read -r program words; do
  IFS=$'\t' read -r -a row <<<"$words"
  case $program,$only in
    fault,both | fault,faults) add_fault "${row[@]}" ;;
    slider,both | slider,sliders) add_slider "${row[@]}" ;;
  esac
done <<<"$runs"
[ ${#names[@]} -gt 0 ] || die "$table has no run of these sizes, expected one at least"

# ---- how far a run is; nothing is written here
# progress NAME KIND GOAL SETTINGS: sets at (steps), done (yes or no) and, for a fault, restart (file to go on from, or
# empty); returns 1 with a line in why if the files do not fit together

events_before() { # FILE STEP: whole lines of events that ended before STEP
  { [ -z "$(tail -c 1 "$1")" ] && cat "$1" || sed '$d' "$1"; } |
    awk -F, -v step="$2" '!/^[#e]/ && $5 < step { n++ } END { print n + 0 }'
}
value() { sed -n "s/^$2 = //p" "$1"; } # FILE KEY: from lines "KEY = value"

identity() { cksum <<<"$1" | cut -d ' ' -f 1; }

newest_restart() { # FOLDER: step of the newest restart file that was written to its end
  local f best=-1 step
  for f in "$1"/fault.restart.*.info; do
    step=${f%.info} step=${step##*.}
    if [[ $step =~ ^[0-9]+$ ]] && [ "$step" -gt "$best" ]; then best=$step; fi
  done
  [ "$best" -ge 0 ] && echo "$best"
}

progress() {
  local folder=$output/$1 text=$4 info step kept events settle found wanted
  at=0 done=no restart= why=
  [ -e "$folder" ] || return 0
  [ -d "$folder" ] || { why="$folder is no folder"; return 1; }
  if [ ! -e "$folder/settings.txt" ]; then
    if [ -n "$(find "$folder" -mindepth 1 ! -name settings.txt.new ! -name lock | head -n 1)" ]; then
      why="$folder holds files, but no settings.txt of a campaign; move it away or choose another --output"
      return 1
    fi
    return 0
  fi
  if [ "$(cat "$folder/settings.txt")" != "$text" ]; then
    # a run that was refused before it began
    [ -n "$(find "$folder" -name "*catalogue.csv" -o -name "checkpoint.bin" -o -name "*.info")" ] || return 0
    found=$(diff <(echo "$text") "$folder/settings.txt" | sed -n "s/^> //p" | head -n 1)
    wanted=$(diff <(echo "$text") "$folder/settings.txt" | sed -n "s/^< //p" | head -n 1)
    why="$folder was begun with other settings: '${found:-nothing}', expected '${wanted:-nothing}'"
    why+="; move it away or choose another --output"
    return 1
  fi
  if [ "$2" = slider ]; then
    [ -e "$folder/checkpoint.bin" ] || return 0
    if [ ! -e "$folder/catalogue.csv" ]; then
      why="$folder/catalogue.csv is missing, but there is a checkpoint; move the folder away to begin again"
      return 1
    fi
    # the checkpoint itself is checked by slider_cli; a summary without it or of other events does not count
    if [ -e "$folder/summary.json" ]; then
      at=$(sed -n 's/^  "steps": \([0-9]*\),$/\1/p' "$folder/summary.json")
      at=${at:-0}
      events=$(sed -n 's/^  "events": \([0-9]*\),$/\1/p' "$folder/summary.json")
      [ "$at" = "$3" ] && [ "$events" = "$(events_before "$folder/catalogue.csv" 9e18)" ] && done=yes
    fi
    return 0
  fi
  step=$(newest_restart "$folder") || return 0
  restart=fault.restart.$step
  info=$folder/$restart.info
  if [ "$(tail -n 1 "$info")" != "$(cd "$folder" && cksum "$restart" 2>/dev/null)" ]; then
    why="$folder/$restart is damaged (its checksum is not the one in $restart.info); remove both to go on from the \
restart file before it"
    return 1
  fi
  if [ "$(value "$info" run)" != "$(identity "$text")" ]; then
    why="$folder/$restart was written by a run with other settings; remove it and its .info"
    return 1
  fi
  if [ ! -e "$folder/fault.catalogue.csv" ]; then
    why="$folder/fault.catalogue.csv is missing, but there is a checkpoint; move the folder away to begin again"
    return 1
  fi
  events=$(value "$info" events)
  kept=$(events_before "$folder/fault.catalogue.csv" "$step")
  if [ "$kept" != "$events" ]; then
    why="$folder/fault.catalogue.csv has $kept events before step $step, expected $events as in $restart.info"
    return 1
  fi
  settle=$(value "$info" settle)
  at=$((step - settle))
  [ "$at" -ge "$3" ] && done=yes
  return 0
}

# ---- one line per change, and one on a terminal that is written over

terminal=no
[ -t 1 ] && terminal=yes
say() {
  [ $terminal = yes ] && printf '\r\033[K'
  printf '%s %s\n' "$(date '+%F %T')" "$*"
}

# nobody_works_in FOLDER: the ranks of a campaign that was killed may live a little longer; each holds this lock
nobody_works_in() {
  [ ! -e "$1/lock" ] || flock -n -x "$1/lock" true || flock -w 60 -x "$1/lock" true 9>&- ||
    { why="a program of an earlier campaign still works in $1"; return 1; }
}

states=() ats=() starts=() begins=() pids=() reasons=()
for i in "${!names[@]}"; do
  at=0
  # Nobody may write while the files are compared with each other.
  if { [ $list = yes ] || nobody_works_in "$output/${names[i]}"; } &&
    progress "${names[i]}" "${kinds[i]}" "${goals[i]}" "${settings[i]}"; then
    [ $done = yes ] && states[i]=done || states[i]=waiting
  else
    states[i]=failed reasons[i]=$why
  fi
  ats[i]=$at
done
if [ $list = yes ]; then
  for i in "${!names[@]}"; do
    printf '%-24s %-8s %10s of %s steps%s\n' "${names[i]}" "${states[i]}" "${ats[i]}" "${goals[i]}" \
      "${reasons[i]:+: ${reasons[i]}}"
  done
  exit 0
fi
for i in "${!names[@]}"; do [ "${states[i]}" != failed ] || say "${names[i]}: cannot go on: ${reasons[i]}"; done

# ---- starting a run

# run_in_folder NAME COMMAND...: takes the place of this process. The end of the campaign, kill -9 included, ends the
# command.
run_in_folder() {
  cd "$output/$1" || exit 1
  shift
  exec 9>&- >>output.txt 2>&1 </dev/null
  exec setpriv --pdeathsig TERM "$@"
}

start() {
  local i=$1 name=${names[$1]} folder=$output/${names[$1]} text=${settings[$1]} words word
  mkdir -p "$folder" 2>/dev/null || { why="cannot create $folder"; return 1; }
  nobody_works_in "$folder" || return 1
  progress "$name" "${kinds[i]}" "${goals[i]}" "$text" || return 1
  if [ "$(cat "$folder/settings.txt" 2>/dev/null)" != "$text" ]; then
    { echo "$text" >"$folder/settings.txt.new" && mv "$folder/settings.txt.new" "$folder/settings.txt"; } 2>/dev/null ||
      { why="cannot write $folder/settings.txt"; return 1; }
  fi
  begins[i]=$(stat -c %s "$folder/output.txt" 2>/dev/null || echo 0)
  if [ "${kinds[i]}" = slider ]; then
    word=$(tail -n +2 <<<"$text")
    words=($word --catalogue catalogue.csv --checkpoint checkpoint.bin --json summary.json --progress)
    # a checkpoint takes long chains some 30 s of steps, short ones less
    [[ $word =~ "--blocks "[0-9]{6} ]] && words+=(--checkpoint-interval 1e5)
    # what a run of these settings wrote before its first checkpoint is replaced
    if [ -e "$folder/checkpoint.bin" ]; then words+=(--resume); else words+=(--overwrite); fi
    run_in_folder "$name" flock -n -s -F lock "$bin/slider_cli" "${words[@]}" &
  else
    unpack_series "$folder" || { why="cannot unpack $folder/fault.pe.bin.gz"; return 1; }
    words=(-in "$root/inputs/fault.in" -log none -var prefix fault -var steps "${goals[i]}" -var run "$(identity "$text")")
    while read -r word; do words+=(-var ${word}); done < <(tail -n +2 <<<"$text")
    if [ -n "$restart" ]; then words+=(-var restart "$restart"); else words+=(-var overwrite yes); fi
    run_in_folder "$name" mpirun -np "${cores[i]}" flock -n -s -F lock "$bin/lmp" "${words[@]}" &
  fi
  pids[i]=$!
  states[i]=running ats[i]=$at starts[i]="$SECONDS $at"
  if [ -e "$folder/checkpoint.bin" ] || [ -n "$restart" ]; then word="goes on from its checkpoint"
    [ -z "$restart" ] || word+=" at step $at of ${goals[i]}"
  else word="starts, ${goals[i]} steps"; fi
  [ "${cores[i]}" = 1 ] || word+=", ${cores[i]} ranks"
  [ -z "$restart" ] || [ "$(value "$folder/$restart.info" ranks)" = "${cores[i]}" ] ||
    word+=" (another number than before: the same model, not the same digits)"
  say "$name: $word"
}

# A packed series is complete before the other one goes, in both directions.
pack_series() { # RUN
  local file=$output/${names[$1]}/fault.pe.bin
  [ "$series" = compress ] && [ -e "$file" ] || return 0
  gzip -1 -c "$file" >"$file.gz.new" && mv "$file.gz.new" "$file.gz" && rm "$file" ||
    say "${names[$1]}: the PE series could not be compressed"
}
unpack_series() { # FOLDER
  local file=$1/fault.pe.bin
  [ -e "$file.gz" ] || return 0
  if [ ! -e "$file" ]; then
    gzip -dc "$file.gz" >"$file.new" && mv "$file.new" "$file" || return 1
  fi
  rm "$file.gz"
}

finish() {
  local i=$1 name=${names[$1]} folder=$output/${names[$1]} code said
  wait "${pids[i]}"
  code=$?
  pids[i]=
  if progress "$name" "${kinds[i]}" "${goals[i]}" "${settings[i]}" && [ $done = yes ]; then
    states[i]=done ats[i]=$at
    pack_series "$i"
    say "$name: done, $(events_before "$folder"/*catalogue.csv 9e18) events"
  elif [ -n "$stopping" ]; then
    look "$i"
    states[i]=stopped
    say "$name: stopped at about step ${ats[i]}"
  else
    said=$(tail -c +$((begins[i] + 1)) "$folder/output.txt" 2>/dev/null | grep -a '^ERROR\|^slider_cli: ' | head -n 1)
    [ -n "$why" ] || why=${said:-"its program ended with $code, see $folder/output.txt"}
    [ "$(df --output=avail -k "$output" | tail -n 1)" -gt 1024 ] || why+="; no space left on the disk of $output"
    states[i]=failed reasons[i]=$why
    say "$name: failed: $why"
  fi
}

# ---- time left

# steps before the shear, which do not count: 1200 time units of 0.15, see fault.in
settle_steps=8000
for word in ${fault_more[@]+"${fault_more[@]}"}; do [[ $word != settle=* ]] || settle_steps=${word#*=}; done

# look I: steps done by a running run, from what it says
look() {
  local text
  text=$(tail -c 2000 "$output/${names[$1]}/output.txt" 2>/dev/null)
  if [ "${kinds[$1]}" = slider ]; then
    text=$(sed -n 's/^step \([0-9]*\) of.*/\1/p' <<<"$text" | tail -n 1)
  else
    text=$(awk -v settle="$settle_steps" 'NF == 8 && /^ *[0-9 ]/ { s = $1 } END { if (s != "") print s - settle }' <<<"$text")
  fi
  [ -n "$text" ] && [ "$text" -gt "${ats[$1]}" ] && ats[$1]=$text
}

# status: one line with the share done and the time left. Left: estimated core seconds, corrected by how the estimates
# of the same kind did in this session.
status() {
  local i numbers= line=
  for i in "${!names[@]}"; do
    [ "${states[i]}" = running ] && look "$i" && line+=" ${names[i]} $((100 * ats[i] / goals[i])) %,"
    numbers+="${kinds[i]} ${states[i]} ${cores[i]} ${costs[i]} ${ats[i]} ${goals[i]} ${starts[i]:-0 0}"$'\n'
  done
  awk -v now=$SECONDS -v jobs="$jobs" -v line="$line" '
    NF { k[NR] = $1; state[NR] = $2; c[NR] = $3; cost[NR] = $4; f[NR] = $5 / $6; n = NR
      if ($2 == "done") f[NR] = 1
      if ($2 == "running") { spent[$1] += (now - $7) * $3; made[$1] += ($5 - $8) / $6 * $4 } }
    END {
      for (i = 1; i <= n; i++) {
        all++; if (state[i] == "done") ready++
        if (state[i] != "running" && state[i] != "waiting") continue
        factor = made[k[i]] > 0 && spent[k[i]] > 5 ? spent[k[i]] / made[k[i]] : 1
        one = (1 - f[i]) * cost[i] * factor; left += one
        if (one / c[i] > longest) longest = one / c[i]
      }
      left /= jobs; if (longest > left) left = longest
      t = left >= 172800 ? sprintf("%.0f days", left / 86400) : left >= 7200 ? sprintf("%.1f h", left / 3600) : \
          left >= 120 ? sprintf("%.0f min", left / 60) : sprintf("%.0f s", left)
      printf "%d of %d runs done;%s about %s left", ready, all, line, t }' <<<"$numbers"
}

# ---- the loop

stopping=
stop() {
  [ -z "$stopping" ] || return 0
  stopping=$1
  local i
  for i in "${!names[@]}"; do [ "${states[i]}" != running ] || kill -TERM "${pids[i]}" 2>/dev/null; done
}
trap 'stop "interrupted"' INT TERM HUP
exec {never}<> <(:)

deadline=
[ -z "$hours" ] || deadline=$(awk -v h="$hours" 'BEGIN { printf "%.0f", h * 3600 }')
shown=-10
say "campaign in $output: ${#names[@]} runs, $jobs cores, $(status)"
while :; do
  used=0 active=0
  for i in "${!names[@]}"; do
    [ "${states[i]}" = running ] || continue
    if kill -0 "${pids[i]}" 2>/dev/null; then
      used=$((used + cores[i])) active=$((active + 1))
    else
      finish "$i"
    fi
  done
  if [ -n "$deadline" ] && [ $SECONDS -ge "$deadline" ]; then stop "its $hours hours are over"; fi
  for i in "${!names[@]}"; do
    [ -z "$stopping" ] && [ "${states[i]}" = waiting ] && [ $((used + cores[i])) -le "$jobs" ] || continue
    if start "$i"; then
      used=$((used + cores[i])) active=$((active + 1))
    else
      states[i]=failed reasons[i]=$why
      say "${names[i]}: cannot go on: $why"
    fi
  done
  [ $active -gt 0 ] || break
  if [ $terminal = yes ] && [ $((SECONDS - shown)) -ge 2 ]; then
    printf '\r\033[K%s' "$(status | cut -c "1-$((${COLUMNS:-$(tput cols 2>/dev/null || echo 80)} - 1))")"
    shown=$SECONDS
  fi
  read -r -t 0.2 -u "$never"
done
[ -z "$stopping" ] || say "stopped: $stopping; run the same command again to go on"

# ---- reports

failed=0 unfinished=0 code=0
for i in "${!names[@]}"; do
  [ "${states[i]}" != failed ] || failed=$((failed + 1))
  if [ "${states[i]}" = "done" ]; then pack_series "$i"; else unfinished=$((unfinished + 1)); fi
done

# chosen PATTERN: words (catalogues) and labels of the runs whose names match
chosen() {
  local i label file
  words=() labels=()
  for i in "${!names[@]}"; do
    [[ ${names[i]} =~ $1 ]] || continue
    for file in "$output/${names[i]}"/*catalogue.csv; do
      [ -e "$file" ] || continue
      label=$(sed -E -e 's/_/ /g; s/^slider kl /slider 1928, K_l /; s/^slider (paper|ours) ([0-9]*) /slider \2, seed /' \
        -e 's/^slider ruptures ([0-9]*) (.*)/slider \1, seed \2, ruptures/' <<<"${names[i]}")
      [ "${states[i]}" = done ] || label+=" (unfinished, step ${ats[i]} of ${goals[i]})"
      words+=("$file") labels+=(--label "$label")
    done
  done
  [ ${#words[@]} -gt 0 ]
}

# page FILE TITLE PATTERN: one page on these runs
page() {
  local words labels
  chosen "$3" || return 0
  say "$1: $2"
  "$bin/postproc" report --lenient --title "$2" --output "$output/$1" "${words[@]}" "${labels[@]}" || code=1
}

# figure NAME PATTERN COMMAND OPTIONS...: picture (PNG, SVG) of these runs, its table and script, and what was printed
figure() {
  local words labels base=$output/figures/$1 name=$1
  chosen "$2" || return 0
  [ "$name" != fig7_leaf_springs ] || labels=("${labels[@]/seed 1/K_l 0.01}")
  shift 2
  "$bin/postproc" "$1" "${words[@]}" --lenient "${labels[@]}" --output "$base" "${@:2}" >"$base.txt" 2>&1 || {
    say "figure $name: $(tail -n 1 "$base.txt")"
    code=1
  }
}
figures() {
  mkdir -p "$output/figures" 2>/dev/null || { say "cannot create $output/figures"; code=1; return; }
  say "figures: Figs. 7, 12 to 15 and the scaling of the roll-off"
  local ours="^slider_ours_${five}_1\$" faults='--range 1e-3:1e-1 --range 1e-3:1' sliders='--range 0.01:1 --range 1:100'
  figure fig7_leaf_springs '^slider_kl|^slider_ours_1928_1$' histograms
  # The faults are loaded from nothing until time 3000 or so; below 1e-3 their counts depend on the time step.
  local loaded=0
  [ "$fault_steps" -lt 50000 ] || loaded=3000
  figure fig12_fault_sizes '^fault_[0-9]*$' histograms --from $loaded --threshold 1e-4 --guide=-1.07:1e-3:1
  figure fig13_slider_sizes "$ours" histograms --guide=-0.5:1e-2:1 --guide=-1:1:100
  figure fig14_fault_intervals '^fault_[0-9]*$' intervals --from $loaded --threshold 1e-3
  figure fig15_slider_intervals "$ours" intervals
  # The ranges are words on purpose.
  figure fault_fit '^fault' fit --from $loaded --threshold 1e-3 --scaling $faults
  figure slider_fit "$ours" fit --scaling $sliders
  # steady from time 40000 on in our settings
  figure rupture_fit '^slider_ruptures' fit --scaling --range 1:100 --from 40000 --threshold 0.1 --replicas 0
}
if [ $report = yes ] && [ "$stopping" != interrupted ]; then
  if [ -x "$bin/postproc" ]; then
    five='(256|614|972|1450|1928)'
    most_seeds=$(cut -f 4 <<<"$runs" | sort -n | tail -n 1)
    figures
    page report.html "Faults, and block-sliders in our settings" "^fault|^slider_ours_${five}_1\$|^slider_kl"
    page report_ruptures.html "Block-sliders, ruptures as events, our settings" '^slider_ruptures_[0-9]*_1$'
    page report_paper_settings.html "Block-sliders as printed in the paper" "^slider_paper_${five}_1\$"
    page report_long_chains.html "Block-sliders longer than the paper's, our settings" '^slider_ours_[0-9]*_1$'
    for ((s = 2; s <= most_seeds; s++)); do
      page "report_seed_$s.html" "Block-sliders in our settings, seed $s" "^slider_ours_[0-9]*_$s\$"
    done
  else
    say "no report: there is no program $bin/postproc"
    code=1
  fi
fi
say "$((${#names[@]} - unfinished)) of ${#names[@]} runs done, $failed failed; results in $output"
[ "$stopping" != interrupted ] || code=130
[ $failed -eq 0 ] || code=1
exit $code
