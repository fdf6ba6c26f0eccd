#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Pictures of these pages and a report page (report.html, not in git) from the published data, and
# pictures from two short runs of the fault of length 120: the default (PE, ruptures, tutorial, page
# of postproc explore, a film frame) and more static friction (tutorial). POSTPROC and LMP: the
# programs, those of build/bin by default. Needs gnuplot, and chromium for the page.
# usage: pictures.sh [catalogues|run|studies|report]...
set -euo pipefail
cd "$(dirname "$0")"
root=$(cd .. && pwd)
postproc=${POSTPROC:-$root/build/bin/postproc} lmp=${LMP:-$root/build/bin/lmp}
loading=$(sed -n "s/^LOADING = \([0-9]*\).*/\1/p" "$root/python/lsm/__init__.py") # as in the tables
[ $# -gt 0 ] || set -- catalogues run studies report
new=$(mktemp -d)
trap 'rm -rf "$new"' EXIT

mapfile -t faults < <(ls campaign/fault_*_1.catalogue.csv.xz | sort -t_ -k2n)
sliders=(catalogues/slider_ours_{256,614,972,1450,1928}_seed_1.catalogue.csv.xz)

for part; do
  case $part in
    report)
      python3 ../inputs/studies/report.py --postproc "$postproc" "${faults[@]}" "${sliders[@]}" --from "$loading" \
        -o "$new/report.html" --title "Faults with the calibrated values, block-sliders in the default settings"
      cp "$new/report.html" .
      ;;
    catalogues)
      "$postproc" histograms "${sliders[@]}" --guide=-0.5:1e-2:1 --guide=-1:1:100 -o "$new/fig13_slider_sizes"
      for kind in csv gp png svg; do cp "$new/fig13_slider_sizes.$kind" .; done
      python3 faults.py
      python3 nature.py "$postproc"
      ;;
    run)
      # Runs the first command of the README; the pictures show its largest event.
      LSM_BIN=$(dirname "$lmp") LSM_OUTPUT=$new ../inputs/first-catalogue.sh >"$new/out"
      . ../inputs/mpi-settings.sh
      cd "$new"
      read -r begin end time steps <<<"$(awk -F, '/^# dt = / { split($0, dt, " = ") } /^[0-9]/ && $6 > most { most = $6; t = $2; a = $4; b = $5 }
        END { print a, b, t, int(b - 1200 / dt[2]) }' first.catalogue.csv)"
      "$postproc" histograms first.catalogue.csv --threshold 1e-4 --guide=-1.07:1e-4:0.1 -o sizes
      mpirun -np 2 "$lmp" -in "$root/inputs/fault_120.in" -var steps 300000 -var mus 0.8 -var prefix mus_0.8 </dev/null >out
      "$postproc" histograms first.catalogue.csv mus_0.8.catalogue.csv --threshold 1e-4 --label "mus 0.6" --label "mus 0.8" -o compare
      chromium --headless --no-sandbox --hide-scrollbars --window-size=1400,2760 --virtual-time-budget=20000 \
        --screenshot=page.png "file://$new/first.html" >out 2>&1
      PYTHONPATH=$root/python python3 -m lsm.ruptures first.ruptures.csv --history first.slip.bin --from $((${time%.*} - 3000)) \
        --to $((${time%.*} + 3000)) -o rupture
      look=$((begin + (end - begin) / 3))
      mpirun -np 2 "$lmp" -in "$root/inputs/fault_120.in" -var extra fault_image -var prefix look -var steps "$steps" \
        -var from "$look" -var to "$look" -var every 1000 </dev/null >out
      cd - >/dev/null
      gnuplot -e "frame = '$(echo "$new"/look.*.png)'" fault_event.gp
      cp "$new/first.largest.png" tutorial_series.png
      cp "$new/sizes.png" tutorial_sizes.png
      cp "$new/compare.png" tutorial_compare.png
      cp "$new/page.png" explore.png
      for kind in png svg; do cp "$new/rupture-event.$kind" "rupture_event.$kind"; done
      ;;
    studies)
      # Those of the fault, if the study has been run
      [ ! -e slow-driving.csv ] || gnuplot -e "table = 'slow-driving.csv'; around = 'slow-driving-around.csv'" ../inputs/studies/slow-driving.gp
      [ ! -e accuracy_catalogues.csv ] ||
        gnuplot -e "table = 'accuracy_catalogues.csv'; name = 'accuracy_catalogues'" ../inputs/studies/work-precision.gp
      gnuplot packing.gp
      PYTHONPATH=.:../inputs/studies python3 speed/speed_tables.py speed
      gnuplot ../inputs/studies/walk.gp
      ;;
    *)
      echo "pictures.sh: part '$part', expected catalogues, run, studies or report" >&2
      exit 2
      ;;
  esac
done
