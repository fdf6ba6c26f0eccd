#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# The dump scene: frames at the given steps, in a form that OVITO reads, and the same when read back.
# usage: fault-dump.sh LMP SOURCE_DIR
set -euo pipefail
export LC_ALL=C
lmp=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*" >&2; [ -f out ] && tail -n 20 out >&2; exit 1; }

scene=(-in "$source/inputs/fault.in" -var length 120 -var settle 100 -var steps 60 -var prefix d -var series no)
"$lmp" "${scene[@]}" -var extra fault_dump -var from 120 -var to 160 -var every 20 </dev/null >out 2>&1 || fail "fault_dump.in"
[ "$(echo d.*.dump)" = "d.000000120.dump d.000000140.dump d.000000160.dump" ] || fail "frames: $(echo d.*.dump)"
particles=$(sed -n 's/^Created \([0-9]*\) particles.*/\1/p' log.lammps)

# The form of LAMMPS' text dumps, checked number by number: every disc once, within the box, of an
# existing type and radius.
for frame in d.*.dump; do
  awk -v step="$((10#${frame:2:9}))" -v n="$particles" '
    NR == 1 { if ($0 != "ITEM: TIMESTEP") exit bad = 1 }
    NR == 2 && $1 != step { exit bad = 2 }
    NR == 4 && $1 != n { exit bad = 3 }
    NR == 5 && $0 != "ITEM: BOX BOUNDS pp ff pp" { exit bad = 4 }
    NR == 6 { lo = $1; hi = $2; if (hi - lo != 120) exit bad = 5 }
    NR == 9 && $0 != "ITEM: ATOMS id type x y z radius vx vy " && $0 != "ITEM: ATOMS id type x y z radius vx vy" { exit bad = 6 }
    NR > 9 {
      if (NF != 8 || $1 <= last || $2 < 1 || $2 > 6 || $3 < lo || $3 > hi || $5 != 0 || $6 < 0.1 || $6 > 1) exit bad = 7
      last = $1; ++count; ++types[$2]; moving += $7 != 0 }
    END {
      if (!bad && (count != n || moving < 0.9 * n)) bad = 8
      for (t = 1; t <= 6; ++t) if (!bad && !types[t]) bad = 9
      exit bad }' "$frame" || fail "$frame: check $?"
done

# Read into another state of the same fault, the frame comes out as it went in.
cat > back.in << 'END'
units lj
dimension 2
boundary p f p
newton off
atom_style hybrid bond sphere
atom_modify map array
create_lsm_fault length 120 width 30 seed 1 loose remove mass r2 1.0
bond_style zero
bond_coeff *
pair_style zero 3.6
pair_coeff * *
comm_modify mode single cutoff 3.6
read_dump d.000000160.dump 160 x y vx vy box yes
write_dump all custom back.dump id type x y z radius vx vy modify sort id format float %.9g
END
"$lmp" -in back.in -log none </dev/null >out 2>&1 || fail "read_dump"
# Positions outside the box come back wrapped: none is.
cmp <(sed 1,9d d.000000160.dump) <(sed 1,9d back.dump) || fail "the frame that was read back differs"
cmp -s <(sed 1,9d d.000000120.dump) <(sed 1,9d back.dump) && fail "all frames are the same"

# The dump does not change the run.
cp d.catalogue.csv with.csv
"$lmp" "${scene[@]}" -var overwrite yes -log none </dev/null >out 2>&1 || fail "fault.in"
cmp with.csv d.catalogue.csv || fail "the dump changes the catalogue"
echo "3 frames of $particles discs"
