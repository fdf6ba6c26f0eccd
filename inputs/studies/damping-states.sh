#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Faults of length 120 whose damping changes (results/damping.md), from the values of preset
# reflecting on with the time step of preset absorbing: glued_*, whose contacts never slip and which
# ring after a jump of the normal stress, for each viscosity and impedance; on_* and off_*, which go
# on for 5000 time units after a viscosity of 0.05 was switched on or off. Then slip_or_exchange.py
# quality and switched.
# usage: damping-states.sh BIN OUT       (BIN: folder of the programs; 3 minutes)
set -euo pipefail
[ $# = 2 ] || {
  sed -n '8s/^# //p' "$0" >&2
  exit 2
}
inputs=$(cd "$(dirname "$0")/.." && pwd) bin=$(realpath "$1")
. "$inputs/mpi-settings.sh"
mkdir -p "$2"
cd "$2"
fault() { # PREFIX NAME VALUE...
  local words=()
  for ((n = 2; n < $#; n += 2)); do words+=(-var "${@:n:2}"); done
  "$bin/lmp" -in "$inputs/fault_120.in" -log none -var prefix "$1" -var preset absorbing -var kt 0.2 "${words[@]}" </dev/null >"$1.out"
}

fault glue steps 0 mu 1000 velocity 1e-12 stress 0.029 impedance 0
for viscosity in 5e-4 2e-3 5e-3 2e-2 5e-2; do
  for impedance in 0 0.1 0.6; do
    fault "glued_${viscosity}_$impedance" restart glue.restart.end steps 30000 stress 0.03 viscosity $viscosity impedance $impedance
  done
done
for seed in 1 2 3; do
  for change in 'on 5e-4 5e-2' 'off 5e-2 5e-4'; do
    read -r name before after <<<"$change"
    fault "before_${name}_$seed" seed $seed steps 100000 stress 0.03 impedance 0 viscosity $before
    fault "${name}_$seed" restart "before_${name}_$seed.restart.end" steps 142000 viscosity $after
  done
done
