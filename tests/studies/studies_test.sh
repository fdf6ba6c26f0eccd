#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Tests of the studies: studies_test.sh SOURCE_DIR BIN_DIR CASE
set -u
export LC_ALL=C LSM_BIN=$2
source=$1
. "$source/tests/studies/slurm.sh"
work=$(mktemp -d)
trap 'kill_all; slurm_end; umount "$work/small" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1

fail() {
  echo "FAILED: $*" >&2
  [ ! -f out.txt ] || tail -n 30 out.txt >&2
  exit 1
}

printf '%s\n' 'run,program,length,blocks,steps,ranks,settings' \
  'one,fault,40,,150000,1,width=20 settle=500 velocity=0.01 thermo=1000' \
  'two,fault,40,,600000,2,width=20 settle=500 velocity=0.01 thermo=1000' \
  'short,fault,40,,6000,1,width=20 settle=500 velocity=0.01' \
  'chain,slider,,100,20000000,,velocity=0.05 dt=0.05 warmup=0 checkpoint-interval=50000 pe-series=series.bin pe-stride=100' >runs.csv
# study FOLDER WORDS...: the study of runs.csv, or of $table
study() { LSM_OUTPUT=$work/$1 "$source/inputs/study.sh" "${table:-runs.csv}" "${@:2}" >out.txt 2>&1; }
# run FOLDER PROGRAM WORDS...: a run without Snakemake
run() { "$source/inputs/run.py" "$1" "$2" 1 "${checkpoint:-1500}" "$LSM_BIN" "${@:3}" >out.txt 2>&1; }
events() { grep -vc '^[#e]' "$1"; }

# Programs that work in the given folder or below; snakemake itself does, too.
programs_in() {
  find /proc -maxdepth 2 -name cwd \( -lname "$1" -o -lname "$1/*" \) 2>/dev/null | sed 's,/proc/\([0-9]*\)/cwd,\1,' | grep -vx $$
}
kill_all() {
  local p
  for p in $(programs_in "$work"); do [ "$p" = $BASHPID ] || kill -9 "$p" 2>/dev/null; done
}

# same A B EVENTS: the same bytes, at least so many events
same() {
  cmp "$1" "$2" || fail "$1 and $2 differ"
  [ "$(events "$1")" -ge "$3" ] || fail "$1 has too few events to test anything"
}

# killed RUN TOUCHED: one run of the study is killed at random moments, in four ways, until it has gone on from a checkpoint four times;
# then it runs to its end. TOUCHED: a file that is there once there is a checkpoint
killed() {
  local name=$1 round child p begun resumed=0 start whole_ms
  start=$(date +%s%N)
  study whole checkpoint=4000 "$name/done.json" || fail "the uninterrupted study ended with $?"
  whole_ms=$((($(date +%s%N) - start) / 1000000))
  RANDOM=7
  for ((round = 0; round < 12 && resumed < 4; round++)); do
    begun=$(compgen -G "part/$name/$2" >/dev/null && echo 1 || echo 0)
    LSM_OUTPUT=$work/part "$source/inputs/study.sh" runs.csv checkpoint=4000 minutes=9 "$name/done.json" >said.txt 2>&1 &
    child=$!
    # Most moments are after the program has begun, some before.
    [ $((round % 5)) = 4 ] ||
      for ((p = 0; p < 400; p++)); do [ -z "$(programs_in "$work/part/$name")" ] || break; sleep 0.05; done
    p=$((whole_ms * (RANDOM % 25 + 3) / 100))
    sleep "$((p / 1000)).$(printf %03d $((p % 1000)))"
    if ! kill -0 $child 2>/dev/null; then wait $child || fail "ended with $? on its own"; break; fi
    case $((round % 4)) in
      0) kill -9 $child ;; # Snakemake: its programs end, too
      1) for p in $(programs_in "$work/part/$name"); do kill -9 "$p"; done ;; # the programs
      3) kill -TERM $child; for p in $(programs_in "$work/part/$name"); do kill -TERM "$p"; done ;;
      2) # all in one moment
        kill -STOP $child
        for p in $child $(programs_in "$work/part"); do kill -9 "$p"; done
        ;;
    esac 2>/dev/null
    wait $child 2>/dev/null && break
    # Programs may live a little longer; now and then the next round meets them.
    [ $((round % 3)) = 2 ] || for ((p = 0; p < 100; p++)); do [ -n "$(programs_in "$work/part/$name")" ] || break; sleep 0.05; done
    resumed=$((resumed + begun))
  done
  echo "killed in $round rounds, $resumed of them after a checkpoint"
  [ $resumed -ge 2 ] || fail "gone on only $resumed times"
  study part checkpoint=4000 "$name/done.json" || fail "the last round ended with $?"
}

# refused PATTERN FOLDER COMMAND...: ends with an error that matches, and leaves all files as they are but what the program said
refused() {
  local pattern=$1 folder=$2 before
  shift 2
  sums() { (cd "$folder" && find . -type f ! -name output.txt ! -name '*lock' ! -name cpu.txt ! -path '*/.snakemake/*' | sort | xargs cksum); }
  before=$(sums)
  "$@" && fail "accepted, expected '$pattern'"
  grep -q -e "$pattern" out.txt || fail "expected a message with '$pattern'"
  [ "$(sums)" = "$before" ] || fail "files were changed, message '$pattern'"
}

fault=(length=40 width=20 settle=500 velocity=0.01 location=yes)
chain=(blocks=100 velocity=0.05 dt=0.05 warmup=0 steps=300000)

case $3 in
kill_slider)
  killed chain checkpoint.bin
  same whole/chain/catalogue.csv part/chain/catalogue.csv 100
  cmp whole/chain/series.bin part/chain/series.bin || fail "PE series differ"
  ;;
kill_fault_*)
  name=one
  [ $3 = kill_fault_1_rank ] || name=two
  killed $name 'fault.restart.*.info'
  same whole/$name/fault.catalogue.csv part/$name/fault.catalogue.csv 15
  cmp whole/$name/fault.pe.bin part/$name/fault.pe.bin || fail "PE series differ"
  ;;
stop)
  # SIGTERM: the run ends with its next restart file, and says that it is to go on.
  checkpoint=3000 run whole fault "${fault[@]}" steps=60000 || fail "ended with $?"
  "$source/inputs/run.py" part fault 1 3000 "$LSM_BIN" "${fault[@]}" steps=60000 >out.txt 2>&1 &
  for ((p = 0; p < 400; p++)); do compgen -G 'part/fault.restart.*.info' >/dev/null && break; sleep 0.05; done
  kill -TERM $!
  wait $!
  [ $? = 75 ] || fail "not stopped, or not as if to go on"
  [ "$(events part/fault.catalogue.csv)" -lt "$(events whole/fault.catalogue.csv)" ] || fail "ran to its end"
  at=$(ls part/fault.restart.*.info | sed 's/[^0-9]*\([0-9]*\).info/\1/' | sort -n | tail -n 1)
  grep -q "^ *$at " part/output.txt || fail "restart file $at is not that of the last step"
  checkpoint=3000 run part fault "${fault[@]}" steps=60000 || fail "not gone on: $?"
  same whole/fault.catalogue.csv part/fault.catalogue.csv 15
  cmp whole/fault.pe.bin part/fault.pe.bin || fail "PE series differ"
  # The same at a time that was set, and nothing is begun after it.
  LSM_UNTIL=$(($(date +%s) + 4)) "$source/inputs/run.py" timed fault 1 3000 "$LSM_BIN" "${fault[@]}" steps=6000000 >out.txt 2>&1
  [ $? = 75 ] && [ -e timed/fault.catalogue.csv ] || fail "not stopped in time"
  LSM_UNTIL=1 "$source/inputs/run.py" late fault 1 3000 "$LSM_BIN" "${fault[@]}" steps=60000 >out.txt 2>&1
  [ $? = 75 ] && [ ! -e late/output.txt ] || fail "begun after its time"
  # Once more: nothing is left to do, and a folder of its own for the sessions of Open MPI is gone.
  checkpoint=3000 run part fault "${fault[@]}" steps=60000 || fail "not done"
  [ -z "$(find "${TMPDIR:-/tmp}" -maxdepth 1 -name "lsm-$(id -u)-$(printf %s "$work/part" | sha256sum | cut -c 1-12)")" ] ||
    fail "a session folder is left"
  ;;
refuse)
  run a slider "${chain[@]}" && run b slider "${chain[@]}" seed=2 || fail "ended with $?"
  refused "begun with other settings (.*), expected .*steps=400000" a run a slider "${chain[@]/steps=300000/steps=400000}"
  rm a/done.json a/summary.json
  cp -r a keep
  cp b/checkpoint.bin a
  refused "cannot resume: checkpoint has 'seed = 2', expected 'seed = 1'" a run a slider "${chain[@]}"
  head -c 1000 keep/checkpoint.bin >a/checkpoint.bin
  refused "damaged checkpoint" a run a slider "${chain[@]}"
  cp keep/checkpoint.bin a
  sed -i '$d' a/catalogue.csv
  refused "events up to the checkpoint, expected" a run a slider "${chain[@]}"
  rm a/catalogue.csv
  refused "catalogue.csv is missing, but there is a checkpoint" a run a slider "${chain[@]}"
  run f fault "${fault[@]}" steps=6000 || fail "ended with $?"
  newest=fault.restart.6500
  rm f/done.json f/fault.restart.end*
  cp -r f whole
  printf x | dd of=f/$newest bs=1 seek=200000 conv=notrunc status=none
  refused "$newest" f run f fault "${fault[@]}" steps=6000
  # Without it the run goes on from the one before.
  rm f/$newest f/$newest.info
  run f fault "${fault[@]}" steps=6000 || fail "not gone on from the restart file before it"
  same f/fault.catalogue.csv whole/fault.catalogue.csv 5
  # Two at a time
  (flock 8 && sleep 100) 8>>f/lock &
  rm f/done.json
  (timeout 5 "$source/inputs/run.py" f fault 1 1500 "$LSM_BIN" "${fault[@]}" steps=6000) && fail "two runs in one folder"
  kill $!
  study one short/done.json || fail "ended with $?"
  exec 8>>one/lock && flock 8
  study one short/done.json && fail "two studies in one folder"
  ;;
disk_full)
  mkdir small
  mount -t tmpfs -o size=1m none small 2>/dev/null || { echo "skipped: mounting a small disk is not allowed"; exit 77; }
  run whole fault "${fault[@]}" steps=30000 || fail "ended with $?"
  run small/part fault "${fault[@]}" steps=30000 && fail "done on a full disk"
  grep -q "no space left on the disk\|No space left" out.txt || fail "no message about the disk"
  mount -o remount,size=64m "$work/small"
  run small/part fault "${fault[@]}" steps=30000 || fail "not gone on once there was space"
  same small/part/fault.catalogue.csv whole/fault.catalogue.csv 15
  ;;
tables)
  # The runs that a table asks for, and lines that name what is wrong
  python3 - "$source/inputs/studies" <<'END' || fail "tables"
import sys
sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
from studies import TableError, read_runs
def runs(text, **config):
    open("t.csv", "w").write(text)
    return read_runs("t.csv", config)
head = "run,program,blocks,seed,steps,settings\n"
found = runs(head + "# comment\ns_{blocks}_{seed},slider,100 200,1-3,1e5,paper=yes\n", seeds="2", shorten="10")
assert list(found) == ["s_100_1", "s_100_2", "s_200_1", "s_200_2"], list(found)
assert found["s_200_2"].words == ["blocks=200", "seed=2", "steps=10000", "paper=yes"], found["s_200_2"].words
found = runs("program,length,ranks\nfault,40 240 1890,\nfault,50,3\n", only="length-[245]")
assert {name: run.ranks for name, run in found.items()} == {"fault_length-40": 1, "fault_length-240": 4, "fault_length-50": 3}, found
# Values of several words are quoted; a run without a name is called by them without blanks.
words = "leap=yes 'leaping=slip 1.5 grow 60'"
found = runs(f"run,program,law,settings\nl_{{law}},fault,coulomb,{words}\n,fault,'coulomb 0.6 0.7' 'velocity-weakening mu 0.6',{words}\n".replace("l_{law}", "l"))
assert list(found) == ["l", "fault_law-coulomb-0.6-0.7_leap-yes_leaping-slip-1.5-grow-60",
                       "fault_law-velocity-weakening-mu-0.6_leap-yes_leaping-slip-1.5-grow-60"], list(found)
assert found["l"].words == ["law=coulomb", "leap=yes", "leaping=slip 1.5 grow 60"], found["l"].words
assert list(found.values())[2].words[0] == "law=velocity-weakening mu 0.6"
for text, said in [
        ("", "t.csv: empty, expected a table of runs"),
        ("run,steps\n", "t.csv:1: no column 'program', expected one"),
        (head + "s,slider,100\n", "t.csv:2: 3 cells, expected 6 as in the first line"),
        (head + "s,chain,100,1,1e5,\n", "t.csv:2: program 'chain', expected fault, slider, esys or catalogue"),
        (head + "s,slider,100 200,1,1e5,\n", "t.csv:2: there is a run 's' already, expected another name"),
        (head + "s_{size},slider,100,1,1e5,\n", "t.csv:2: run 's_{size}', expected a name with columns in braces (not 'size')"),
        (head + "a/b,slider,100,1,1e5,\n", "t.csv:2: run 'a/b', expected letters, digits, '.', '_', '+' and '-'"),
        (head + "s,slider,100,1,many,\n", "t.csv:2: could not convert string to float: 'many'"),
        (head + "s,slider,100,1,1e5,kl\n", "t.csv:2: settings 'kl', expected NAME=VALUE")]:
    try:
        runs(text)
        sys.exit(f"accepted: {text}")
    except TableError as error:
        assert str(error) == said, (str(error), said)
END
  table=none.csv study one -n && fail "a table that is not there"
  # A study of one's own, without a recipe
  printf '%s\n' 'run,program,blocks,seed,steps,settings' 'c_{seed},slider,100,1-2,1e6,velocity=0.05 warmup=0' >own.csv
  table=own.csv study own || fail "ended with $?"
  [ "$(wc -l <own/table.csv)" = 3 ] && [ -s own/report.html ] || fail "table: $(cat own/table.csv)"
  python3 - <<'END' 2>err.txt || fail "$(cat err.txt)"
import csv
for row in csv.DictReader(open("own/table.csv")):
    lines = [line for line in open(f"own/{row['run']}/catalogue.csv") if line[0] not in "#e"]
    assert int(row["events"]) == len(lines) and 0.3 < float(row["exponent"]) < 2, row
END
  # Settings of several words reach the program, also where the run goes on.
  printf '%s\n' 'run,program,length,steps,velocity,law,settings' \
    "l,fault,40,3000,1e-3,'slip-weakening mu 0.5 mu_static 0.6 dc 0.002 heal 5',width=20 settle=500 leap=yes fast=0.01 'leaping=slip 1.5 grow 60'" >laws.csv
  table=laws.csv study laws checkpoint=1000 l/done.json || fail "ended with $?"
  grep -q '^# law = slip-weakening mu 0.5 mu_static 0.6 dc 0.002 heal 5$' laws/l/fault.catalogue.csv &&
    grep -q '^# leap = fast 0.01 slip 1.5 .* grow 60 ' laws/l/fault.catalogue.csv || fail "header: $(grep '^#' laws/l/fault.catalogue.csv)"
  cp laws/l/fault.catalogue.csv whole.csv
  rm laws/l/done.json laws/l/fault.restart.end* laws/l/fault.restart.3500*
  table=laws.csv study laws checkpoint=1000 l/done.json || fail "gone on with $?"
  cmp whole.csv laws/l/fault.catalogue.csv || fail "another catalogue after going on"
  # Catalogues that are there: the same numbers as of the runs they came from.
  xz -k <own/c_1/catalogue.csv >c_1.csv.xz
  printf '%s\n' 'run,program,file' "again,catalogue,$work/c_1.csv.xz" "nowhere,catalogue,$work/nowhere.csv" >published.csv
  table=published.csv study published && fail "a catalogue that is not there"
  grep -q "nowhere.csv: no such catalogue, expected one in the column 'file'" out.txt || fail "no message about the missing file"
  sed -i '$d' published.csv
  table=published.csv study published || fail "ended with $?"
  python3 - <<'END' 2>err.txt || fail "$(cat err.txt)"
import csv
first, again = (next(csv.DictReader(open(f"{name}/table.csv"))) for name in ("own", "published"))
for key in ("events", "exponent", "gamma", "last_time"):
    assert first[key] == again[key] != "", (key, first, again)
END
  table=own.csv study own -n && grep -q 'Nothing to be done' out.txt || fail "done, but to be done again"
  ;;
recipes)
  # Every study that ships can be planned, and asks postproc for what it has.
  for table in "$source"/inputs/studies/*.csv; do
    name=$(basename "$table" .csv)
    study "plan_$name" -n --quiet || fail "$name cannot be planned"
  done
  unset table
  table=quick study quick shorten=2 'only=fault_120|_256' || fail "quick ended with $?"
  for file in figures/fig12_fault_sizes.png figures/fig13_slider_sizes.svg figures/fault_fit.json report.html table.csv costs.csv; do
    [ -s "quick/$file" ] || fail "no $file"
  done
  [ ! -e quick/figures/fig7_leaf_springs.png ] || fail "a figure of nothing"
  # ESyS-Particle is missed by name before anything is begun.
  mkdir programs && ln -s /usr/bin/* programs && rm -f programs/esysparticle
  PATH=$work/programs table=whole-job study whole_job && fail "done without ESyS-Particle"
  grep -q 'run ESyS-Particle needs ESyS-Particle, no program esysparticle was found (Debian package esys-particle)' out.txt ||
    fail "ESyS-Particle is not missed"
  [ ! -e whole_job/ours_0.06 ] || fail "begun without ESyS-Particle"
  ;;
esys)
  command -v esysparticle >/dev/null || { echo "skipped: no ESyS-Particle (Debian package esys-particle)"; exit 77; }
  table=whole-job study whole_job shorten=4000 || fail "ended with $?"
  python3 - <<'END' 2>err.txt || fail "$(cat err.txt)"
import csv, struct
rows = {row["run"]: row for row in csv.DictReader(open("whole_job/costs.csv"))}
assert list(rows) == ["ESyS-Particle", "ours_0.06", "ours_0.12"] and rows["ESyS-Particle"]["steps"] == "115", rows
assert all(float(row["time_per_core_hour"]) > 0 for row in rows.values()), rows
# The same scene: its PE where the shear begins is that of ours.
raw = open("whole_job/ESyS-Particle/fault.pe.bin", "rb").read()
series = list(struct.iter_unpack("<qd", raw[24 + struct.unpack("<q", raw[16:24])[0]:]))
assert len(series) == 114 and series[0][0] == 20000, (len(series), series[0])
ours = [line.split() for line in open("whole_job/ours_0.06/output.txt") if line.split()[:1] == ["20000"]][-1]
assert abs(series[0][1] / float(ours[3]) - 1) < 0.02, (series[0], ours)
END
  ! run odd esys length=40 choices=first massfloor=0 dt=0.06 steps=10 && grep -q "hold 'stress', ESyS-Particle has 'position'" out.txt ||
    fail "a scene that ESyS-Particle cannot have is taken"
  ;;
slurm)
  slurm_begin "$work/slurm" || { echo "skipped: $slurm_missing"; exit 77; }
  printf '%s\n' 'run,program,length,blocks,seed,steps,settings' 'fault_{seed},fault,40,,1-2,150000,width=20 settle=500 velocity=0.01' \
    'chain,slider,,100,1,20000000,velocity=0.05 warmup=0' >runs.csv
  study here checkpoint=5000 ranks=1 || fail "the study on this machine ended with $?"
  # The queue is full of another's job at first.
  other=$(sbatch --parsable --exclusive --output=/dev/null --wrap 'sleep 100') || fail "sbatch"
  LSM_OUTPUT=$work/there "$source/inputs/study.sh" runs.csv checkpoint=5000 ranks=1 --profile "$source/inputs/slurm" >out.txt 2>&1 &
  child=$!
  waiting() { squeue -h -t "$1" -o %j | grep -c "$2"; }
  for ((p = 0; p < 300; p++)); do [ "$(waiting PD 'fault\|slider')" = 3 ] && break; sleep 0.1; done
  [ "$(waiting PD 'fault\|slider')" = 3 ] || fail "three jobs do not wait"
  scancel "$other"
  # The fault that Slurm begins first is cancelled by hand, the other is told to end as before its time limit.
  begun() { # the first of the faults named that runs and has a restart file
    for ((p = 0; p < 600; p++)); do
      for fault in "$@"; do compgen -G "there/$fault/fault.restart.*.info" >/dev/null && return; done
      sleep 0.1
    done
    fail "no restart file of $*"
  }
  job() { squeue -h -o '%i %j' | sed -n "s/ fault.$1$//p"; }
  begun fault_1 fault_2
  first=$fault
  scancel "$(job "$first")" || fail "$first has ended before it was cancelled"
  [ "$first" = fault_1 ] && begun fault_2 || begun fault_1
  second=$(job "$fault")
  scancel --signal=TERM --batch "$second" || fail "$fault has ended before it was told to"
  for ((p = 0; p < 300; p++)); do [ "$(squeue -h -j "$second" -o %T)" = PENDING ] && break; sleep 0.1; done
  [ "$(squeue -h -j "$second" -o %T)" = PENDING ] || fail "not queued again"
  [ ! -e "there/$fault/done.json" ] || fail "told to end, but ended by itself"
  scontrol update JobId="$second" StartTime=now # Slurm waits for two minutes otherwise
  wait $child || fail "the study through Slurm ended with $?"
  grep -q 'Trying to restart job' out.txt || fail "the cancelled job was not queued again"
  same here/fault_1/fault.catalogue.csv there/fault_1/fault.catalogue.csv 15
  same here/fault_2/fault.catalogue.csv there/fault_2/fault.catalogue.csv 15
  same here/chain/catalogue.csv there/chain/catalogue.csv 100
  same here/table.csv there/table.csv 3
  ;;
*) fail "no case $3" ;;
esac
exit 0
