#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Discs of one block cannot pass through those of the other, whether they are at the fault or behind
# it: the upper block is pushed into the lower one and the face of the latter into the discs behind
# it, and each overlapping pair of both blocks has to repel; those of one block too, unless contacts
# are those of the fault only, and with friction unless they are smooth. With a retardation time
# links and contacts have dashpots.
# usage: fault-contacts.sh LMP SOURCE_DIR
set -euo pipefail
export LC_ALL=C
lmp=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*" >&2; tail -n 20 out >&2; exit 1; }
cp -r "$source/inputs" scene
cat >scene/probe.in <<'END'
group above type 2 4 6
displace_atoms above move 0 -0.5 0
group face type 3
displace_atoms face move 0.02 -0.05 0
compute types all property/local ptype1 ptype2 cutoff radius
compute push all pair/local force p2 cutoff radius
dump probe all local 1 ${prefix}.pairs c_types[1] c_types[2] c_push[1] c_push[2]
END
# pairs NAME VARIABLES...: rows "types, overlapping pairs, those that repel", of the first step
pairs() {
  local name=$1
  shift
  "$lmp" -in scene/fault.in -var length 30 -var settle 0 -var steps 1 -var prefix "$name" -var extra probe "$@" </dev/null >out 2>&1 ||
    fail "lmp of $name"
  awk '/^ITEM: TIMESTEP/ { if (++steps > 1) exit } /^ITEM/ { on = /ITEM: ENTRIES/; next }
    on { a = $1 < $2 ? $1 : $2; b = $1 < $2 ? $2 : $1; n[a "-" b]++; if ($3 > 0) f[a "-" b]++ }
    END { for (k in n) print k, n[k], f[k] + 0 }' "$name.pairs" >"$name.rows"
  sort "$name.rows"
}
pairs fault -var contacts fault
for types in 1-4 2-3 3-4; do
  awk -v t=$types '$1 == t && $2 > 0 { found = 1; if ($3 != $2) bad = 1 } END { exit bad || !found }' fault.rows || fail "pairs of types $types"
done
awk '$1 == "1-3" && $2 > 0 && $3 == 0 { good = 1 } END { exit !good }' fault.rows || fail "discs of one block, contacts fault"
pairs all
awk '$1 == "1-3" && $2 > 0 { found = 1 } $3 != $2 { bad = 1 } END { exit bad || !found }' all.rows || fail "contacts all"
# Smooth: as many repel; with friction those of both blocks only.
pairs smooth -var contacts smooth
awk '$1 == "1-3" && $2 > 0 { found = 1 } $3 != $2 { bad = 1 } END { exit bad || !found }' smooth.rows || fail "contacts smooth"
# friction NAME: rows "within or between the blocks, pairs with a tangential force", of the last
# step
friction() {
  awk '/^ITEM: TIMESTEP/ { split("", n) } /^ITEM/ { on = /ITEM: ENTRIES/; next }
    on && $4 != 0 { n[($1 - $2) % 2 ? "between" : "within"]++ }
    END { print "within", n["within"] + 0; print "between", n["between"] + 0 }' "$1.pairs"
}
friction all >rows
awk '$2 == 0 { bad = 1 } END { exit bad }' rows || fail "friction, contacts all: $(cat rows)"
friction smooth >rows
awk '($1 == "within") != ($2 == 0) { bad = 1 } END { exit bad }' rows || fail "friction, contacts smooth: $(cat rows)"
# Further input is found by any name, also one with a path.
printf 'print "this was read"\n' >scene/on-board_2.in
for name in on-board_2 ./on-board_2 ../scene/on-board_2 "$work/scene/on-board_2"; do
  "$lmp" -in scene/fault.in -var length 30 -var settle 0 -var steps 0 -var prefix named -var overwrite yes -var extra "$name" </dev/null >out 2>&1 ||
    fail "extra $name"
  grep -q "^this was read" out || fail "extra $name was not read"
done
# Dashpots: in all links and contacts, also after a restart, and not with too long a time step.
printf 'write_coeff ${prefix}.coeff\n' >scene/coefficients.in
damped() { "$lmp" -in scene/fault.in -var settle 0 -var prefix damped -var extra coefficients "$@" </dev/null >out 2>&1; }
dashpots() {
  awk '/^(pair|bond)_coeff/ && !/off$/ { n[$1]++; if (!/ kelvin-voigt 0\.05/) bad = 1 }
    END { exit bad || !n["pair_coeff"] || !n["bond_coeff"] }' damped.coeff
}
for contacts in all smooth fault; do
  damped -var length 30 -var steps 10 -var overwrite yes -var retardation 0.05 -var dt 0.03 -var contacts $contacts ||
    fail "dashpots, contacts $contacts"
  dashpots || fail "a link or contact without dashpot, contacts $contacts: $(cat damped.coeff)"
done
grep -q "^# kelvin_voigt = 0.05" damped.catalogue.csv || fail "the header does not say the dashpots"
damped -var steps 20 -var restart damped.restart.end || fail "dashpots, going on"
dashpots || fail "a restart loses dashpots"
if damped -var length 30 -var steps 10 -var overwrite yes -var retardation 0.5; then fail "a time step too long for the dashpots was accepted"; fi
grep -q "above the stability limit .* with kelvin-voigt" out || fail "no clear message about the time step"
