#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Checks one way of using the package, or that a plugin that does not match is not loaded.
# usage: check-package.sh built-in|plugin|refused LMP STOCK_LMP PLUGIN [PLUGIN_OF_OTHER_INTEGERS]
set -euo pipefail
way=$1 lmp=$2 stock=$3 plugin=$4 other_integers=${5:-}
styles="bond_style:lsm/linked pair_style:lsm/free pair_style:lsm/friction fix:lsm/nve fix:lsm/plates fix:lsm/leap fix:lsm/absorb fix:lsm/traction
  compute:lsm/events create_lsm_fault include_beside check_variable save_restart check_restart"
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
  refused)
    # not_loaded PROGRAM PLUGIN PATTERN: one line that matches, no style registered, and the program
    # continues
    not_loaded() {
      { echo "plugin load $2"; echo "plugin list"; echo 'print "went on"'; } >in.refused
      "$1" -in in.refused -log none >out 2>&1 || fail "plugin load ends with an error"
      [ "$(grep -c "Plugin of the LSM package not loaded" out)" = 1 ] || fail "not one line about it"
      grep -q -- "$3" out || fail "expected a line with '$3'"
      ! grep -q 'Loading plugin\|style plugin' out || fail "styles were registered"
      grep -q '^went on' out || fail "the program did not go on"
    }
    # The same file for another version of LAMMPS, of the same length.
    version=$(sed -n 's/.*Large-scale Atomic\/Molecular Massively Parallel Simulator - \(.*[0-9]\).*/\1/p' \
      <<<"$("$stock" -h)" | head -n 1)
    [ "$version" = "4 Feb 2025" ] || [ "$version" = "4 Jul 2026" ] || fail "the stock lmp is of version '$version'"
    LC_ALL=C sed "s/$version/5 Mar 2019/g" "$plugin" >other.so
    ! cmp -s "$plugin" other.so || fail "the plugin does not hold its version"
    not_loaded "$stock" ./other.so "compiled for LAMMPS 5 Mar 2019, but this is LAMMPS $version;"
    bits="64, 32 and 32" other="64, 64 and 64"
    if grep -q 'LAMMPS_BIGBIG' <<<"$("$stock" -h)"; then
      bits="64, 64 and 64" other="64, 32 and 32"
    fi
    not_loaded "$stock" "$other_integers" "tagint and imageint of $other bits, but this LAMMPS has .* $bits bits;"
    not_loaded "$lmp" "$plugin" "the package is compiled into this LAMMPS already"
    # Loaded twice by the stock program: LAMMPS' own message.
    printf 'plugin load %s\nplugin load %s\n' "$plugin" "$plugin" >in.twice
    "$stock" -in in.twice -log none >out 2>&1 || fail "loading twice ends with an error"
    grep -q 'must unload existing' out || fail "no message when loaded twice"
    ! grep -q 'not loaded' out || fail "the plugin takes itself for a package that is compiled in"
    echo "plugins that do not fit: passed"
    exit
    ;;
  *) fail "unknown way '$way', expected built-in, plugin or refused" ;;
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
# A sheared fault with friction, plates and events; a restart in the middle of it gives the same
# files. fault LOAD NAME GEOMETRY RUNS: lines of the input
fault() {
  local name=$2
  echo "$1"
  cat <<EOF
units lj
dimension 2
boundary p f p
newton off
atom_style hybrid bond sphere
atom_modify map array
special_bonds lj/coul 0 1 1
$3
comm_modify mode single cutoff 3.6
neighbor 0.4 bin
neigh_modify delay 0 every 10 check yes
group lower type 5
group upper type 6
group plates union lower upper
group blocks subtract all plates
bond_style lsm/linked
bond_coeff 1 1.0
pair_style lsm/friction
pair_coeff * * off
pair_coeff 3 4 1.0 1.0 0.6
timestep 0.03
fix move blocks lsm/nve viscosity 0.05
fix plates all lsm/plates lower upper stress 0.02 stressramp 6 damping 0.05 velocity 0.02 ramp 6
compute events all lsm/events catalogue $name.csv series $name.pe ledger yes location yes resume yes
thermo 1000
thermo_style custom step c_events c_events[5] c_events[11]
$4
EOF
}
geometry="create_lsm_fault length 20 width 14 seed 3 failures 300"
# Pieces, as in fault.in: each run sorts the particles, so that a restart between two gives the same
# digits.
two_runs="run 2000
write_restart state
run"
fault "$load" whole "$geometry" "$two_runs 2000" >in.whole
fault "$load" part "$geometry" "$two_runs 500" >in.first
fault "$load" part "read_restart state" "run 2000" >in.second
for part in whole first second; do
  "$program" -in in.$part -log none >out 2>&1 || fail "the fault ends with an error ($way, $part)"
done
cmp whole.csv part.csv || fail "the catalogue after a restart differs"
cmp whole.pe part.pe || fail "the series after a restart differs"
[ "$(grep -vc '^[#e]' whole.csv)" -ge 3 ] || fail "too few events to test anything"
awk -F, '!/^[#e]/ && $9 > 0 { n++ } END { exit n < 1 }' whole.csv || fail "nothing slid in any event"
if [ "$way" = plugin ]; then
  # The same bytes as the program that has the package compiled in.
  fault "" other "$geometry" "$two_runs 2000" >in.other
  "$lmp" -in in.other -log none >out 2>&1 || fail "the fault ends with an error (built-in)"
  cmp whole.csv other.csv || fail "plugin and built-in give other catalogues"
  cmp whole.pe other.pe || fail "plugin and built-in give other series"
fi
echo "package as $way: passed"
