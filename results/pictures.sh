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

# in the order of the tables, so that the bootstrap has the same random numbers
mapfile -t every < <(ls campaign/fault_*.catalogue.csv.xz | sort -t_ -k2n -k3n)
mapfile -t faults < <(printf '%s\n' "${every[@]}" | grep _1.catalogue)
sliders=(catalogues/slider_ours_{256,614,972,1450,1928}_seed_1.catalogue.csv.xz)

for part; do
  case $part in
    report)
      python3 ../inputs/studies/report.py --postproc "$postproc" "${faults[@]}" "${sliders[@]}" --from "$loading" \
        -o "$new/report.html" --title "Faults with the calibrated values, block-sliders in the default settings"
      cp "$new/report.html" .
      ;;
    catalogues)
      ruptures=() labels=()
      for file in "${faults[@]}"; do
        length=${file#*fault_}
        ruptures+=("${file/catalogue/ruptures}") labels+=(--label "fault ${length%%_*}")
      done
      PYTHONPATH=$root/python python3 -m lsm.ruptures "${ruptures[@]}" "${labels[@]}" -o "$new/rupture"
      for name in lengths moments length pe; do cp "$new/rupture-$name.png" rupture_$name.png; done
      "$postproc" intervals "${sliders[@]}" -o "$new/fig15_slider_intervals"
      scaling() { PYTHONPATH=$root/python python3 -m lsm.scaling "$@"; }
      scaling "${sliders[@]}" -o "$new/slider_fit.scaling"
      scaling catalogues/slider_ruptures_*.xz --from 40000 --threshold 1 -o "$new/rupture_fit.scaling"
      scaling "${every[@]}" --threshold 1e-3 --from "$loading" -o "$new/fault_fit.scaling"
      scaling "${every[@]/catalogue/ruptures}" --threshold 1e-2 --from "$loading" -o "$new/fault_rupture_fit.scaling"
      common=(--from "$loading" --threshold 1e-4)
      both() { # sizes and inter-event times of catalogues, as in Figs. 12 and 14
        "$postproc" histograms "${@:3}" "${common[@]}" --guide=-1.07:1e-4:0.1 -o "$new/$1"
        "$postproc" intervals "${@:3}" "${common[@]}" --delta 1 --shortest 0 --shuffles 0 -o "$new/$2"
      }
      both fig12_fault_sizes fig14_fault_intervals "${faults[@]}"
      both damping_sizes damping_times damping/fault_{120,240,480,945,1440,1890}_4.catalogue.csv.xz
      both slip_sizes slip_times slip/fault_{120,240,480,945,1890}_4.catalogue.csv.xz
      for fit in slider_fit rupture_fit fault_fit fault_rupture_fit; do
        for kind in csv png; do cp "$new/$fit.scaling.$kind" .; done
      done
      "$postproc" histograms "${sliders[@]}" --guide=-0.5:1e-2:1 --guide=-1:1:100 -o "$new/fig13_slider_sizes"
      for name in fig12_fault_sizes fig13_slider_sizes damping_sizes damping_times slip_sizes slip_times; do
        for kind in csv gp png svg; do cp "$new/$name.$kind" .; done
      done
      for name in fig14_fault_intervals fig15_slider_intervals; do
        for kind in csv gp png table1.csv; do cp "$new/$name.$kind" .; done
      done
      python3 ../inputs/studies/calibrate.py posterior calibration/points.csv.xz calibration
      python3 slip_or_exchange.py decides damping_decides damping/points.csv
      python3 slip_or_exchange.py rates slip_rates damping/fault_*.catalogue.csv.xz slip/fault_*.catalogue.csv.xz
      ;;
    run)
      # Runs the first command of the README; the pictures show its largest event.
      LSM_BIN=$(dirname "$lmp") LSM_OUTPUT=$new ../inputs/first-catalogue.sh >"$new/out"
      . ../inputs/mpi-settings.sh
      cd "$new"
      read -r begin end time steps <<<"$(awk -F, '/^# dt = / { split($0, dt, " = ") } /^[0-9]/ && $6 > most { most = $6; t = $2; a = $4; b = $5 }
        END { print a, b, t, int(b - 1200 / dt[2]) }' first.catalogue.csv)"
      "$postproc" series first.pe.bin --from $((${time%.*} - 3000)) --to $((${time%.*} + 3000)) --title "Fault of length 120" -o series
      "$postproc" histograms first.catalogue.csv --threshold 1e-4 --guide=-1.07:1e-4:0.1 -o sizes
      mpirun -np 2 "$lmp" -in "$root/inputs/fault_120.in" -var steps 380000 -var mus 0.8 -var prefix mus_0.8 </dev/null >out
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
      for kind in png svg; do cp "$new/series.$kind" "fig8_to_11_series.$kind"; done
      cp "$new/first.largest.png" tutorial_series.png
      cp "$new/sizes.png" tutorial_sizes.png
      cp "$new/compare.png" tutorial_compare.png
      cp "$new/page.png" explore.png
      for name in event.png event.svg spacetime.png; do cp "$new/rupture-$name" "rupture_$name"; done
      ;;
    studies)
      gnuplot -e "table = 'slow-driving-slider.csv'" ../inputs/studies/slow-driving-slider.gp
      # Those of the fault, if the study has been run
      [ ! -e slow-driving.csv ] || gnuplot -e "table = 'slow-driving.csv'; around = 'slow-driving-around.csv'" ../inputs/studies/slow-driving.gp
      [ ! -e accuracy_catalogues.csv ] ||
        gnuplot -e "table = 'accuracy_catalogues.csv'; name = 'accuracy_catalogues'" ../inputs/studies/work-precision.gp
      [ ! -e regime-map.csv ] || gnuplot -e "table = 'regime-map.csv'" ../inputs/studies/regime-map.gp
      gnuplot packing.gp
      PYTHONPATH=.:../inputs/studies python3 speed/speed_tables.py speed
      gnuplot ../inputs/studies/walk.gp
      rm -f regime-map.svg
      ;;
    *)
      echo "pictures.sh: part '$part', expected catalogues, run, studies or report" >&2
      exit 2
      ;;
  esac
done
