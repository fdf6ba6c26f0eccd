#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# A fault in ESyS-Particle, for inputs/run.py: the scene that inputs/fault.in makes with these
# settings, sheared for `steps`; PE series and events (our picker) as of a run of ours, with the
# times of fault.in. It cannot be continued: if killed, it starts again.
# usage: esys_fault.sh BIN NAME=VALUE...     in the folder of the run
set -euo pipefail
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
die() {
  echo "ERROR: esys_fault.sh: $*" >&2
  exit 1
}
bin=$1 steps= scene=(-in "$here/../../inputs/fault.in" -log none -var prefix fault -var steps 1 -var series no -var overwrite yes)
for pair in "${@:2}"; do
  [[ $pair != steps=* ]] || {
    steps=${pair#*=}
    continue
  }
  scene+=(-var "${pair%%=*}" "${pair#*=}")
done
[[ $steps =~ ^[1-9][0-9]*$ ]] || die "steps '$steps', expected how many"
child=
trap '[ -z "$child" ] || kill "$child"; wait; exit 143' TERM INT HUP
call() {
  "$@" &
  child=$!
  wait "$child"
  child=
}

call "$bin/lmp" "${scene[@]}"
value() { sed -n "s/^$1 = //p" fault.restart.end.info; }
for pair in hold=position contacts=all mass=r2 massstep=0 "law=coulomb $(value mu) $(value mu)"; do
  [ "$(value "${pair%%=*}")" = "${pair#*=}" ] || die "${pair%%=*} '$(value "${pair%%=*}")', ESyS-Particle has '${pair#*=}'"
done
cat >data.in <<'END'
read_restart    fault.restart.end
bond_style      lsm/linked
bond_coeff      1 1.0
pair_style      lsm/friction
pair_coeff      * * off
pair_coeff      1*4 1*6 1.0 1.0 0.6
write_data      fault.data nocoeff
END
call "$bin/lmp" -in data.in -log none
"$here/convert.py" fault
call mpirun -np 2 esysparticle "$here/esys_fault.py" fault "$(value length)" "$(value dt)" "$(value viscosity)" "$(value velocity)" \
  "$(value mu)" "$(value kt)" "$steps"

# Writes PE of links and contacts as a series of this project; the first row is from before the
# first evaluation of forces
paste -d ' ' fault.esys.links fault.esys.contacts | python3 -c '
import struct, sys
dt, step = float(sys.argv[1]), int(sys.argv[2])
pe = [float(row[0]) + float(row[1]) for row in [line.split() for line in sys.stdin][2:] if len(row) == 2]
header = {"model": "lsm", "dt": dt, "step0": step, "time0": step * dt, "stride": 1, "completeness": sys.argv[3]}
lines = "".join(f"# {key} = {value}\n" for key, value in header.items()).encode()
with open("fault.pe.bin", "wb") as file:
    file.write(b"lsm-pe-series-1\n" + struct.pack("<q", len(lines)) + lines)
    file.writelines(struct.pack("<qd", step + n, one) for n, one in enumerate(pe))
' "$(value dt)" "$(value settle)" "$(value completeness)"
"$bin/postproc" pick fault.pe.bin --memory-time "$(value memory)" -o fault.catalogue.csv --overwrite
mv fault.esys.json summary.json
