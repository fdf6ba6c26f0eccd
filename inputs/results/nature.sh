#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Tables and figure of nature.md from the published catalogues. POSTPROC: the program,
# build/bin/postproc by default.
set -euo pipefail
cd "$(dirname "$0")"
postproc=${POSTPROC:-../../build/bin/postproc}
stretch=(--from 1984-01-01 --to 1986-07-02T12:00)
start() { files=(../seismicity/southern-california.csv.xz) labels=(--label "Southern California"); }
# add LABEL NAME...: catalogues that are samples of one model
add() {
  local label=$1 name
  shift
  for name in "$@"; do files+=("catalogues/$name.catalogue.csv.xz") labels+=(--label "$label"); done
}
start
add "fault 120" fault_120 fault_120_seed_{2,3}
add "fault 1890" fault_1890
add "ruptures, fault 120" fault_ruptures_120 fault_ruptures_120_seed_{2,3}
add "ruptures, fault 1890" fault_ruptures_1890
add "slider 1928" slider_ours_1928_seed_{1,2,3}
add "ruptures, slider 1928" slider_ruptures_1928_seed_{1,2,3}
add "fault 120, slow plates" law_coulomb_seed_{1,2}
add "fault 120, slow, ageing" law_ageing_seed_{1,2}
"$postproc" nature "${files[@]}" "${labels[@]}" "${stretch[@]}" --from 4200 --reference M2 --reference M2.5 --reference M3 \
  --threshold 1e-3 --threshold 1e-2 --threshold 1 -o "${OUTPUT:-.}/nature"

start
for law in static slip-weakening velocity-weakening slip-law; do add "$law" law_${law}_seed_1; done
add coulomb law_coulomb_seed_{1,2}
add ageing law_ageing_seed_{1,2}
"$postproc" nature "${files[@]}" "${labels[@]}" "${stretch[@]}" --threshold 1e-3 --no-picture -o "${OUTPUT:-.}/laws"
for one in catalogues/law_*.xz; do
  echo "$one"
  "$postproc" aftershocks "$one" --threshold 1e-3 --main-size 0.1 --window 3e4 --first 300 --hold-c 0 --replicas 0 --no-picture \
    -o "${OUTPUT:-.}/omori" 2>&1 | grep -E "main shocks|p =|no event" || true
  rm -f "${OUTPUT:-.}"/omori.*
done
