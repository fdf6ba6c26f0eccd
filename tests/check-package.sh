#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Checks one way of using the package.
# usage: check-package.sh built-in|plugin LMP STOCK_LMP PLUGIN
set -euo pipefail
way=$1 lmp=$2 stock=$3 plugin=$4
styles="bond_style:lsm/linked pair_style:lsm/free pair_style:lsm/friction fix:lsm/nve fix:lsm/plates
  compute:lsm/events create_lsm_fault include_beside"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*"; [ ! -f out ] || tail -n 40 out; exit 1; }

# Two discs that are linked and two that collide: bond, pair and integrator in one small run, in
# which the total energy must not change.
scene() {
  cat <<'EOF'
units lj
dimension 2
boundary p p p
newton on
atom_style hybrid bond sphere
region box block 0 40 0 40 -0.5 0.5
create_box 1 box bond/types 1 extra/bond/per/atom 2
create_atoms 1 single 10 10 0
create_atoms 1 single 11.05 10 0
create_atoms 1 single 20 20 0
create_atoms 1 single 23 20 0
set group all diameter 1.0
set group all mass 0.25
set atom 3 vx 0.1
set atom 4 vx -0.1
EOF
}

case $way in
  built-in)
    "$lmp" -h >out 2>&1 || fail "lmp -h ends with an error"
    for style in $styles; do
      grep -q -w -- "${style#*:}" out || fail "lmp -h does not list ${style#*:}"
    done
    grep -q '\bLSM\b' out || fail "lmp -h does not name the package LSM"
    program=$lmp load=""
    ;;
  plugin)
    "$stock" -h >out 2>&1 || fail "stock lmp -h ends with an error"
    ! grep -q 'lsm/' out || fail "the stock lmp has the styles already, so the plugin is not what is tested"
    program=$stock load="plugin load $plugin"
    echo "$load" >in.load
    "$stock" -in in.load -log none >out 2>&1 || fail "plugin load ends with an error"
    for style in $styles; do
      grep -q -- "Loading plugin: .*${style#*:}" out || fail "the plugin does not register ${style#*:}"
    done
    ;;
  *) fail "unknown way '$way', expected built-in or plugin" ;;
esac

# The second scene after 'clear' finds the styles again (a plugin has to be loaded again).
{
  for round in 1 2; do
    echo "$load"
    scene
    cat <<EOF
special_bonds lj/coul 0 1 1
bond_style lsm/linked
bond_coeff 1 1.0
pair_style lsm/free
pair_coeff * * 1.0
create_bonds single/bond 1 1 2
fix move all lsm/nve
thermo 50
thermo_style custom step ke pe etotal
thermo_modify norm no format float %.12g
timestep 0.02
run 2000
variable e$round equal etotal
print "ENERGY round $round \${e$round}"
clear
EOF
  done
} >in.scene
"$program" -in in.scene -log none >out 2>&1 || fail "the scene ends with an error ($way)"
[ "$(grep -c '^ENERGY' out)" = 2 ] || fail "expected two rounds"
# Kinetic 2 * 0.5 * 0.25 * 0.1^2 plus link 0.5 * 0.05^2.
awk '/^ENERGY/ { d = $4 - 0.00375; if (d < -1e-5 || d > 1e-5) bad = 1; n++ }
     END { exit bad || n != 2 }' out || fail "the energy of the scene is not 0.00375"
echo "package as $way: passed"
