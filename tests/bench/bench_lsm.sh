#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Speed of the fault in LAMMPS beside other programs, cost of its parts and features, cost against
# length, set-up. Runs that are compared take turns, in rounds; tables hold medians over the rounds,
# and medians of the ratios within each round. --help has the options.
set -euo pipefail
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../../inputs/mpi-settings.sh"

usage() {
  cat <<END
usage: bench_lsm.sh LMP STOCK_LMP FOLDER [OPTIONS]
LMP has the styles of this package, STOCK_LMP is LAMMPS of the same version with BPM, GRANULAR and MOLECULE.
FOLDER takes the scenes, which are made once for each LMP, all timings (timings.csv) and the tables (tables.md).
  --quick            some three minutes: shorter runs, fewer rounds
  --rounds N         rounds of peers and of recording on or off [7, quick 2]; others have half as many, but at least 2
  --seconds S        a run takes about so long [1, quick 0.3]
  --length L         fault of the comparisons and of causes [1890; causes 480]
  --only WHAT,...    peers, parts, features, lengths, scale, setup, analysis, causes, campaign [all]; scale runs up to 8
                     ranks, whatever the cores; analysis: postproc beside LMP, 1e7 events (quick 1e5); causes: why a step
                     of a run of RUNS takes longer than one of these scenes; campaign: slices of all runs of RUNS
  --runs RUNS        folder of a study with runs fault_LENGTH_1, done or under way (inputs/study.sh campaign); causes and
                     campaign begin with the newest restart file of each, and are left out without RUNS
END
}

rounds=0 seconds=0 length=1890 cause_length=480 only=peers,parts,features,lengths,scale,setup,analysis,causes,campaign quick=no runs=
arguments=()
while (($#)); do
  if [[ $1 =~ ^--(rounds|seconds|length|only|runs)$ ]] && (($# < 2)); then
    echo "bench_lsm.sh: $1 needs a value, see --help" >&2
    exit 1
  fi
  case $1 in
    --quick) quick=yes ;;
    --rounds)
      rounds=$2
      shift
      ;;
    --seconds)
      seconds=$2
      shift
      ;;
    --length)
      length=$2 cause_length=$2
      shift
      ;;
    --only)
      only=$2
      shift
      ;;
    --runs)
      runs=$(realpath "$2")
      shift
      ;;
    --help)
      usage
      exit
      ;;
    -*)
      echo "bench_lsm.sh: unknown option $1, see --help" >&2
      exit 1
      ;;
    *) arguments+=("$1") ;;
  esac
  shift
done
if ((${#arguments[@]} != 3)); then
  usage >&2
  exit 1
fi
lmp=$(realpath "${arguments[0]}") stock=$(realpath "${arguments[1]}") folder=${arguments[2]}
if ((rounds == 0)); then if [ $quick = yes ]; then rounds=2; else rounds=7; fi; fi
if [ "$seconds" = 0 ]; then if [ $quick = yes ]; then seconds=0.3; else seconds=1; fi; fi
few=$(((rounds + 1) / 2))
if ((few < 2)); then few=$((rounds < 2 ? rounds : 2)); fi
cores=$(env -u OMP_NUM_THREADS nproc) # nproc follows OMP_NUM_THREADS
ranks_in_turn=1
if ((cores > 1)); then ranks_in_turn="1 2"; fi
most=${ranks_in_turn##* }

mkdir -p "$folder"
cd "$folder"
folder=$PWD
timings=timings.csv
echo "table,label,length,ranks,round,atoms,steps,seconds,cpu_percent,pair,bond,neigh,comm,output,modify,other,resident" >$timings
measure=() # largest resident memory of each rank, if there is GNU time
if [ -x /usr/bin/time ]; then measure=(/usr/bin/time -f "resident %M"); fi

die() {
  echo "bench_lsm.sh: $*" >&2
  exit 1
}

# scene LENGTH [VARIABLES]: fault_LENGTH.restart and .data, and what other programs read; with
# VARIABLES fault_LENGTH_all
scene() {
  local name=fault_$1${2:+_all}
  if [ "$name.restart" -nt "$lmp" ] && [ "$name.geo" -nt "$here/convert.awk" ]; then return; fi
  echo "making the fault of length $1" >&2
  mpirun -np "$most" "$lmp" -in "$here/make.in" -var length "$1" -var name "$name" "${@:2}" -log make.log -screen none ||
    die "making the fault failed, see $folder/make.log"
  awk -v name="$name" -f "$here/convert.awk" "$name.data"
}

# steps LENGTH MILLIONS: number of steps of a run with so many million particle-steps per second
steps() {
  awk -v length_of_fault="$1" -v rate="$2" -v s="$seconds" 'BEGIN {
    n = int(rate * 1e6 * s / (65.2 * length_of_fault)); print n < 20 ? 20 : n }'
}

# note TABLE LABEL LENGTH RANKS ROUND LOG OUTPUT: one line of timings.csv from what a program
# printed
note() {
  awk -v start="$1,$2,$3,$4,$5" '
    /^Loop time of/ { seconds = $4; for (i = 5; i < NF; i++) if ($(i + 1) == "steps") steps = $i
                      atoms = $(NF - 1) }
    /CPU use with/ { cpu = $1 + 0 }
    /^resident / { resident += $2 }
    /^(Pair|Bond|Neigh|Comm|Output|Modify|Other) +\|/ { split($0, cell, "|"); part[$1] = cell[3] + 0 }
    END {
      if (!seconds) exit 1
      printf "%s,%d,%d,%s,%s", start, atoms, steps, seconds, cpu
      n = split("Pair Bond Neigh Comm Output Modify Other", name, " ")
      for (i = 1; i <= n; i++) printf ",%s", part[name[i]]
      print "," resident + 0
    }' "$6" "$7" >>$timings || die "no timing of $2 in $folder/$6"
}

# ours TABLE LABEL LENGTH RANKS ROUND VARIABLES...; of fault_LENGTH, or of $fault
ours() {
  local table=$1 label=$2 size=$3 ranks=$4 round=$5
  shift 5
  mpirun -np "$ranks" "${measure[@]}" "$lmp" -in "$here/ours.in" -var name "${fault:-fault_$size}" -var steps "$(steps "$size" $((60 * ranks)))" "$@" \
    -log ours.log -screen none >ours.out 2>&1 || die "$label failed, see $folder/ours.log"
  note "$table" "$label" "$size" "$ranks" "$round" ours.log ours.out
}

# others LABEL RANKS ROUND LINKS MILLIONS
others() {
  mpirun -np "$2" "${measure[@]}" "$stock" -in "$here/stock.in" -var name "fault_$length" -var steps "$(steps "$length" $(($5 * $2)))" \
    -var links "$4" -log stock.log -screen none >stock.out 2>&1 || die "$1 failed, see $folder/stock.log"
  note peers "$1" "$length" "$2" "$3" stock.log stock.out
}

# In addition to its workers ESyS-Particle has a process that directs them and never sleeps.
esys() {
  rm -f "fault_$length".esys.*
  mpirun -np $(($1 + 1)) "${measure[@]}" esysparticle "$here/esys_particle.py" "fault_$length" "$1" "$length" "$(steps "$length" 10)" 3 \
    >esys.out 2>&1 || return 1
  note peers "ESyS-Particle" "$length" "$1" "$2" esys.out /dev/null
}

wanted() { [[ ,$only, == *,$1,* ]]; }
say() { echo "$(date +%H:%M:%S) $*" >&2; }

steal() { awk '/^cpu / {t = 0; for (i = 2; i <= 9; i++) t += $i; print $9, t}' /proc/stat; }
steal_before=$(steal)
load_before=$(cut -d ' ' -f 1-3 /proc/loadavg)
begin=$SECONDS

if wanted peers; then
  scene "$length"
  have_esys=yes
  if ! command -v esysparticle >/dev/null; then
    have_esys=no
    echo "ESyS-Particle is not installed and left out (Debian package esys-particle)" >&2
  fi
  for ((round = 1; round <= rounds; ++round)); do
    say "peers, round $round of $rounds"
    for ranks in $ranks_in_turn; do
      ours peers "ours" "$length" "$ranks" "$round"
      others "bond harmonic" "$ranks" "$round" harmonic 25
      others "bond bpm/spring" "$ranks" "$round" bpm 15
      others "bond harmonic with contacts" "$ranks" "$round" contacts 20
      if [ $have_esys = yes ] && ((round <= few && ranks < cores)) && ! esys "$ranks" "$round"; then
        have_esys=no
        echo "ESyS-Particle failed and is left out, see $folder/esys.out" >&2
      fi
    done
  done
fi

if wanted parts; then
  scene "$length"
  for ((round = 1; round <= few; ++round)); do
    say "parts, round $round of $few"
    for ranks in $ranks_in_turn; do
      # Each run leaves out one more feature; particles do not move, so that the contacts are the
      # same.
      without=()
      ours parts "everything" "$length" "$ranks" "$round"
      for part in events plates integration contacts links; do
        case $part in
          contacts) without+=(-var pairs none) ;;
          integration) without+=(-var move no) ;;
          *) without+=(-var $part no) ;;
        esac
        ours parts $part "$length" "$ranks" "$round" "${without[@]}"
      done
    done
  done
fi

if wanted features; then
  scene "$length"
  scene "$length" -var contacts all
  # Each feature takes turns with the base.
  feature() {
    local label=$1
    shift
    ours features "base of $label" "$length" "$most" "$round"
    ours features "$label" "$length" "$most" "$round" "$@"
  }
  # With another law some contacts slip at first. The cost of the law is timed, and not that of
  # lists that are rebuilt until the discs are at rest again.
  calm=(-var warmup 3000 -var viscosity 0.2)
  for ((round = 1; round <= rounds; ++round)); do
    say "features, round $round of $rounds"
    feature "nothing recorded" -var events no
    if ((round > few)); then continue; fi
    feature "PE and picking without files" -var files "progress yes"
    feature "catalogue without PE series" -var files "catalogue ours.catalogue.csv overwrite yes"
    feature "location of events" -var location yes
    feature "energy ledger" -var ledger yes
    feature "ranks sum PE every step" -var block 1
    feature "no friction (lsm/free)" -var pairs lsm/free "${calm[@]}"
    # This needs its own fault, as overlapping discs would fly apart.
    ours features "base of contacts of all discs" "$length" "$most" "$round"
    fault=fault_${length}_all ours features "contacts of all discs" "$length" "$most" "$round" -var contacts all
    feature "static friction above dynamic" -var mus 0.7
    feature "slip weakening" -var otherlaw yes -var law "slip-weakening mu 0.5 mu_static 0.6 dc 0.002 heal 5" "${calm[@]}"
    feature "velocity weakening" -var otherlaw yes -var law "velocity-weakening mu 0.6 vc 0.02" "${calm[@]}"
    feature "rate and state (ageing)" -var otherlaw yes -var law "rate-state-ageing mu 0.6 a 0.01 b 0.015 dc 0.001 v0 0.0005" "${calm[@]}"
    feature "rate and state (slip)" -var otherlaw yes -var law "rate-state-slip mu 0.6 a 0.01 b 0.015 dc 0.001 v0 0.0005" "${calm[@]}"
    feature "links that can break" -var ratio 1.5
    feature "dashpots of links and contacts" -var delay 0.02
    feature "no viscosity" -var viscosity 0
    feature "pressure every 100 steps" -var pressure 100
    feature "pressure every step" -var pressure 1
    feature "fix that looks at each end of step" -var foreign yes
    feature "velocities of ghosts sent" -var vel yes
    feature "all lists rebuilt every 100 steps" -var rebuild 100
  done
fi

if wanted lengths; then
  for size in 120 240 480 945 1440 1890 3780; do scene $size; done
  for ((round = 1; round <= few; ++round)); do
    say "lengths, round $round of $few"
    for size in 120 240 480 945 1440 1890 3780; do
      for ranks in $ranks_in_turn; do ours lengths "ours" "$size" "$ranks" "$round"; done
    done
  done
fi

# Bandwidth of caches and memory for the same amount of data.
echo "ranks,megabytes,gb_per_second" >triad.csv
if wanted lengths; then
  if mpicc -O3 -march=native -o triad "$here/triad.c" 2>triad.err; then
    for ranks in $ranks_in_turn; do
      say "triad, $ranks ranks"
      mpirun -np "$ranks" ./triad 0.25 0.5 1 2 4 8 16 32 64 2>triad.err | awk -v ranks="$ranks" '/^triad / {print ranks "," $2 "," $3}' >>triad.csv ||
        die "triad failed, see $folder/triad.err"
    done
  else
    echo "mpicc failed, the bandwidth is left out, see $folder/triad.err" >&2
  fi
fi

# slice TABLE LABEL FOLDER RANKS ROUND [CHANGE]: a part of the run of inputs/fault.in in FOLDER,
# from its newest restart file, with everything that it records; CHANGE is a file of commands before
# it.
slice() {
  local table=$1 label=$2 ranks=$4 round=$5 info file prefix size
  info=$(for file in "$3"/*.restart.*.info; do echo "$(awk '/^step = / {print $3}' "$file") $file"; done | sort -g | tail -1)
  info=${info#* }
  [ -e "$info" ] || die "$3: no restart file"
  file=${info%.info}
  prefix=${file%.restart.*}
  rm -rf slice
  mkdir slice
  cp "$here"/../../inputs/fault.{in,variables} "$here/slice.in" "$info" "$file" slice
  for file in "$prefix".{catalogue.csv,pe.bin,ruptures.csv,slip.bin}; do [ ! -e "$file" ] || cp "$file" slice; done
  file=${info##*/}
  size=$(sed -n 's/^length = //p' "$info")
  (cd slice && SLICE_WARM=50 SLICE_STEPS=$(steps "$size" $((60 * ranks))) SLICE_CHANGE=${6:-/dev/null} \
    mpirun -np "$ranks" "${measure[@]}" "$lmp" -in fault.in -var restart "${file%.info}" -var extra slice -log slice.log \
    -screen none >slice.out 2>&1) || die "$label failed, see $folder/slice/slice.log"
  note "$table" "$label" "$size" "$ranks" "$round" slice/slice.log slice/slice.out
}

if wanted causes && [ -n "$runs" ]; then
  size=$cause_length
  scene "$size"
  scene "$size" -var contacts all
  if ! [ "before_$size/fault.restart.end.info" -nt "$lmp" ]; then
    say "making the default fault of length $size, before the shear"
    rm -rf "before_$size"
    mkdir "before_$size"
    (cd "before_$size" && mpirun -np "$most" "$lmp" -in "$here/../../inputs/fault.in" -var length "$size" -var steps 0 -var prefix fault \
      -log make.log -screen none) || die "making the default fault failed, see $folder/before_$size/make.log"
  fi
  cat >changes.blocks <<'END'
pair_coeff * * off
pair_coeff 1 2 1.0 ${kt}
pair_coeff 1 4 1.0 ${kt}
pair_coeff 2 3 1.0 ${kt}
pair_coeff 3 4 1.0 ${kt}
END
  cat >changes.recording <<'END'
thermo_style custom step
uncompute events
if "$(is_defined(compute,ruptures))" then "uncompute ruptures"
END
  cat >changes.place <<'END'
thermo_style custom step
uncompute events
if "$(is_defined(compute,ruptures))" then "uncompute ruptures"
compute events all lsm/events catalogue slice.catalogue.csv series slice.pe.bin
END
  echo 'neigh_modify delay 0 every 1000000 check no' >changes.lists
  for ((round = 1; round <= few; ++round)); do
    say "causes, round $round of $few"
    ours causes "scene of the comparisons" "$size" 1 "$round"
    fault=fault_${size}_all ours causes "with contacts of all discs" "$size" 1 "$round" -var contacts all
    slice causes "default scene before the shear" "before_$size" 1 "$round"
    run=$runs/fault_${size}_1
    slice causes "in shear as in the campaign" "$run" 1 "$round"
    slice causes "contacts between the blocks only" "$run" 1 "$round" ../changes.blocks
    slice causes "neither location nor ruptures" "$run" 1 "$round" ../changes.place
    slice causes "nothing recorded" "$run" 1 "$round" ../changes.recording
    slice causes "lists never rebuilt" "$run" 1 "$round" ../changes.lists
  done
fi

if wanted campaign && [ -n "$runs" ]; then
  for ((round = 1; round <= few; ++round)); do
    say "campaign, round $round of $few"
    for run in "$runs"/fault_*_1; do
      for ranks in $ranks_in_turn; do slice campaign "slice" "$run" "$ranks" "$round"; done
    done
  done
fi

# Messages between ranks are counted, not timed, as the difference between two runs, so that set-up
# does not count.
echo "length,ranks,particles,largest_share,ghosts,messages,bytes,collectives,nonblocking,pe" >scale.csv
if wanted scale; then
  if mpicc -O2 -shared -fPIC -o count_mpi.so "$here/count_mpi.c" 2>count_mpi.err; then
    for size in 120 480 "$length"; do
      scene "$size"
      for ranks in 1 2 4 8; do
        say "scale, length $size, $ranks ranks"
        for count in 100 200; do
          mpirun -np "$ranks" -x LD_PRELOAD="$PWD/count_mpi.so" "$lmp" -in "$here/ours.in" -var name "fault_$size" -var steps $count \
            -log "scale.$count.log" -screen none >"scale.$count.out" 2>&1 || die "counting messages failed, see $folder/scale.$count.log"
        done
        awk -v size="$size" -v ranks="$ranks" '
          FILENAME ~ /200.log$/ && /^Nlocal:/ {share = $4 / $2}
          FILENAME ~ /200.log$/ && /^Nghost:/ {ghosts = $2}
          FILENAME ~ /200.log$/ && /^Loop time of/ {particles = $(NF - 1)}
          FILENAME ~ /200.log$/ && /^PE / {pe = $2}
          /^count_mpi / {sign = FILENAME ~ /200.out$/ ? 1 : -1; for (i = 3; i <= 6; i++) n[i] += sign * $i}
          END {printf "%d,%d,%d,%.4f,%.1f", size, ranks, particles, share, ghosts
               for (i = 3; i <= 6; i++) printf ",%.3f", n[i] / ranks / 100
               print "," pe}' scale.100.out scale.200.out scale.200.log >>scale.csv
      done
    done
  else
    echo "mpicc failed, what ranks send is left out, see $folder/count_mpi.err" >&2
  fi
fi

echo "ranks,round,create,first_step,read_restart,write_restart" >setup.csv
if wanted setup; then
  for ((round = 1; round <= few; ++round)); do
    say "setup, round $round of $few"
    for ranks in $ranks_in_turn; do
      mpirun -np "$ranks" "$lmp" -in "$here/make.in" -var length "$length" -var name setup -var settle 1 -log setup.log \
        -screen none >setup.out 2>&1 || die "set-up failed, see $folder/setup.log"
      awk -v start="$ranks,$round" '/^setup create/ {print start "," $3 "," $5 "," $7 "," $9}' setup.log >>setup.csv
    done
  done
  rm -f setup.restart setup.data
fi

echo "events,command,seconds,kilobytes" >analysis.csv
if wanted analysis; then
  postproc=$(dirname "$lmp")/postproc
  if [ -x "$postproc" ] && [ -x /usr/bin/time ]; then
    events=10000000
    if [ $quick = yes ]; then events=100000; fi
    awk -v n=$events -f "$here/catalogue.awk" >analysis.catalogue.csv
    for ((round = 1; round <= few; ++round)); do
      say "analysis, round $round of $few"
      for command in histograms magnitudes "fit --replicas 0 --no-comparison" "intervals --replicas 0 --shuffles 0"; do
        # shellcheck disable=SC2086
        /usr/bin/time -o analysis.time -f "%e,%M" "$postproc" $command analysis.catalogue.csv --no-picture -o analysed >analysis.out 2>&1 ||
          die "postproc $command failed, see $folder/analysis.out"
        echo "$events,$command,$(tail -1 analysis.time)" >>analysis.csv
      done
    done
    say "analysis, random series"
    /usr/bin/time -o analysis.time -f "%e,%M" "$postproc" intervals --replicas 0 analysis.catalogue.csv --no-picture -o analysed >analysis.out 2>&1 ||
      die "postproc intervals failed, see $folder/analysis.out"
    echo "$events,intervals with random series,$(tail -1 analysis.time)" >>analysis.csv
    rm -f analysis.catalogue.csv
  else
    echo "no $postproc or no GNU time, the analysis is left out" >&2
  fi
fi

{
  echo "$(date -u +'%Y-%m-%d %H:%M') UTC, $(awk -F ': *' '/^model name/ {print $2; exit}' /proc/cpuinfo), $cores cores," \
    "load before $load_before, $(echo "$steal_before $(steal)" | awk '{printf "%.1f", ($3 - $1) / ($4 - $2) * 100}') %" \
    "of the time taken by other machines, fault of length $length, $rounds rounds of the comparisons and $few of the rest," \
    "$(((SECONDS - begin) / 60)) min $(((SECONDS - begin) % 60)) s."
  awk -v most="$most" -f "$here/tables.awk" $timings setup.csv scale.csv analysis.csv triad.csv
} >tables.md
cat tables.md
