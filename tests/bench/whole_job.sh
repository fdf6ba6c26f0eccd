#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# The whole job, a catalogue: ESyS-Particle on the packing, stress and damping of inputs/fault_120.in for some CPU time, its PE
# series through the picker of this project, and our run of the same scene; large events for a core-hour.
# Plates hold their position across the fault, as ESyS-Particle has no servo that absorbs waves.
set -euo pipefail
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
inputs=$(cd "$here/../../inputs" && pwd)
. "$inputs/mpi-settings.sh"
usage() {
  cat <<END
usage: whole_job.sh LMP POSTPROC FOLDER [OPTIONS]
  --seconds S   CPU time of the computing process of ESyS-Particle [3600]
  --steps N     but not more steps than that [1500000]
  --table       only make the table of the runs that are there, ended or not
END
}
seconds=3600 steps=1500000 run=yes arguments=()
while (($#)); do
  case $1 in
    --help) usage; exit ;;
    --table) run=no ;;
    --seconds | --steps)
      (($# > 1)) || { echo "whole_job.sh: $1 needs a value, see --help" >&2; exit 2; }
      declare "${1#--}=$2"; shift ;;
    -*) echo "whole_job.sh: unknown option $1, see --help" >&2; exit 2 ;;
    *) arguments+=("$1") ;;
  esac
  shift
done
if ((${#arguments[@]} != 3)); then usage >&2; exit 2; fi
lmp=$(realpath "${arguments[0]}") postproc=$(realpath "${arguments[1]}")
mkdir -p "${arguments[2]}"
cd "${arguments[2]}"
die() { echo "whole_job.sh: $*" >&2; exit 1; }
dt=0.06 # all masses r^2: ESyS-Particle cannot raise some of them
scene=(-in "$inputs/fault_120.in" -log none -var prefix fault -var hold position -var contacts all)

if [ $run = yes ]; then
  command -v esysparticle >/dev/null || die "no esysparticle (Debian package esys-particle)"
  mkdir -p esys
  (
    cd esys
    "$lmp" "${scene[@]}" -var dt $dt -var massfloor 0 -var steps 1 -var series no -var overwrite yes >make.txt 2>&1 ||
      die "making the scene failed, see $PWD/make.txt"
    cat >data.in <<'END'
read_restart    fault.restart.end
bond_style      lsm/linked
bond_coeff      1 1.0
pair_style      lsm/friction
pair_coeff      * * off
pair_coeff      1*4 1*6 1.0 1.0 0.6
write_data      fault.data nocoeff
END
    "$lmp" -in data.in -log none >data.txt 2>&1 || die "writing the scene failed, see $PWD/data.txt"
    awk -v name=fault -f "$here/convert.awk" fault.data
    mpirun -np 2 esysparticle "$here/esys_fault.py" fault 120 $dt 0.015 0.00025 "$seconds" "$steps" >esys.txt 2>&1 ||
      die "ESyS-Particle failed, see $PWD/esys.txt"
    sed -n 's/^worker \([0-9.]*\) s.*/\1/p' esys.txt >cpu.txt
  )
  for way in "0.06 0" "0.12 0.04"; do
    folder=ours_${way% *}
    rm -rf "$folder" && mkdir "$folder"
    (
      cd "$folder"
      TIMEFORMAT='%U %S'
      { time "$lmp" "${scene[@]}" -var dt "${way% *}" -var massfloor "${way#* }" >output.txt 2>&1 </dev/null; } 2>time.txt ||
        die "our run failed, see $PWD/output.txt"
      awk '{ print $1 + $2 }' time.txt >cpu.txt
    )
  done
fi

# PE of links and contacts as a series of this project; the first row is from before the forces are there, the last may be cut off
paste -d ' ' esys/fault.esys.links esys/fault.esys.contacts | awk -v dt=$dt '
  BEGIN { print "# lsm-pe-series 1\n# model = lsm\n# dt = " dt "\n# step0 = 0\n# time0 = 0\n# stride = 1\n# completeness = 0.001\nstep,time,pe" }
  NR > 2 && NF == 2 && length($1) == 16 && length($2) == 16 { printf "%d,%.10g,%.11g\n", n, n * dt, $1 + $2; n++ }' >esys/fault.pe.csv
"$postproc" pick esys/fault.pe.csv --memory-time 0.5 -o esys/fault.catalogue.csv --force >/dev/null
echo "program,dt,time,cpu_s,events_1e-3,events_1e-2,events_1e-1,released,time_per_core_hour,large_per_core_hour" >whole_job.csv
# row PROGRAM DT FOLDER START SPAN LENGTH: events from 2500 time units of shear on, when the stress is at its level, up to SPAN
# time units; the run was LENGTH time units long
row() {
  awk -F, -v start="$4" -v span="$5" -v whole="$6" -v cpu="$(cat "$3/cpu.txt")" -v what="$1,$2" '
    /^[#e]/ || $2 < start + 2500 || $2 >= start + span { next }
    { if ($6 >= 1e-3) { n++; sum += $6 } if ($6 >= 1e-2) large++; if ($6 >= 0.1) largest++ }
    END { printf "%s,%.0f,%.0f,%d,%d,%d,%.3g,%.4g,%.3g\n", what, span, cpu * span / whole, n, large, largest, sum, whole / cpu * 3600,
            large / (span - 2500) * whole / cpu * 3600 }' "$3/fault.catalogue.csv" >>whole_job.csv
}
# Plates that hold their position press more and more, so that only the same span can be compared.
span=$(tail -1 esys/fault.pe.csv | cut -d, -f2)
row ESyS-Particle $dt esys 0 "$span" "$span"
for dt in 0.06 0.12; do row ours $dt ours_$dt 1200 "$span" 144000; done
for dt in 0.06 0.12; do row "ours, whole run" $dt ours_$dt 1200 144000 144000; done
cat whole_job.csv
# the same span of ours, for the two-sample tests
awk -F, -v end="$span" '/^[#e]/ || $3 < 1200 + end' ours_0.06/fault.catalogue.csv >ours_0.06.same_span.csv
"$postproc" compare ours_0.06.same_span.csv esys/fault.catalogue.csv --label ours --label ESyS-Particle --threshold 1e-2 -o compare || true
