#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Pictures of these pages from the published catalogues, and from three short runs of the fault of
# length 120: the default (PE, tutorial, page of postproc explore, a film frame), more static
# friction (tutorial), and the choices before the calibration (ruptures). POSTPROC and LMP: the
# programs, those of build/bin by default. Needs gnuplot, and chromium for the page.
# usage: pictures.sh [catalogues|run|studies]...
set -euo pipefail
cd "$(dirname "$0")"
root=$(cd .. && pwd)
postproc=${POSTPROC:-$root/build/bin/postproc} lmp=${LMP:-$root/build/bin/lmp}
[ $# -gt 0 ] || set -- catalogues run studies
new=$(mktemp -d)
trap 'rm -rf "$new"' EXIT

for part; do
  case $part in
    catalogues)
      ruptures=() labels=()
      for length in 120 240 480 945 1440 1890 3780; do
        ruptures+=(catalogues/fault_ruptures_$length.catalogue.csv.xz) labels+=(--label "fault $length")
      done
      "$postproc" rupture "${ruptures[@]}" "${labels[@]}" -o "$new/rupture"
      for name in lengths moments length pe stress; do cp "$new/rupture-$name.png" rupture_$name.png; done
      sliders=()
      for blocks in 256 614 972 1450 1928; do sliders+=(catalogues/slider_ours_${blocks}_seed_1.catalogue.csv.xz); done
      "$postproc" intervals "${sliders[@]}" -o "$new/fig15_slider_intervals"
      "$postproc" fit "${sliders[@]}" --scaling --range 0.01:1 --range 1:100 --replicas 0 --no-comparison -o "$new/slider_fit"
      "$postproc" fit catalogues/slider_ruptures_*.xz --scaling --range 1:100 --from 40000 --threshold 1 --replicas 0 \
        --no-comparison -o "$new/rupture_fit"
      "$postproc" fit catalogues/fault_[0-9]*.xz --scaling --threshold 1e-3 --from 4500 --range 1e-3:1 --replicas 0 \
        --no-comparison -o "$new/fault_first_fit"
      "$postproc" fit campaign/fault_*[0-9]_[0-9].catalogue.csv.xz --scaling --threshold 1e-3 --from 4500 --range 1e-3:1 --replicas 0 \
        --no-comparison -o "$new/fault_fit"
      "$postproc" fit catalogues/fault_ruptures_*.xz --scaling --threshold 1e-2 --from 6000 --range 1e-2:1 --replicas 0 \
        --no-comparison -o "$new/fault_rupture_fit"
      faults=()
      for length in 120 240 480 945 1440 1890; do faults+=(campaign/fault_${length}_1.catalogue.csv.xz); done
      "$postproc" report "${faults[@]}" "${sliders[@]}" --from 4500 -o "$new/report.html" \
        --title "Faults with the calibrated values, block-sliders in the default settings"
      cp "$new/report.html" .
      for fit in slider_fit rupture_fit fault_fit fault_first_fit fault_rupture_fit; do
        for kind in csv gp png; do cp "$new/$fit.scaling.$kind" .; done
      done
      for kind in csv gp png table1.csv; do cp "$new/fig15_slider_intervals.$kind" .; done
      ;;
    run)
      . ../inputs/mpi-settings.sh
      cd "$new"
      mpirun -np 2 "$lmp" -in "$root/inputs/fault_120.in" -var steps 240000 -var prefix first -var ruptures yes </dev/null >out
      "$lmp" -in "$root/inputs/fault_120.in" -var steps 80000 -var prefix before -var ruptures yes -var choices first </dev/null >out
      "$postproc" series first.pe.bin --from 15000 --to 21000 --title "Fault of length 120" -o series
      "$postproc" series first.pe.bin --from 6475 --to 7857 --title "Fault of length 120: around the largest event" -o largest
      "$postproc" histograms first.catalogue.csv --guide=-1.07:1e-4:0.1 -o sizes
      "$lmp" -in "$root/inputs/fault_120.in" -var steps 240000 -var mus 0.8 -var prefix mus_0.8 </dev/null >out
      "$postproc" histograms first.catalogue.csv mus_0.8.catalogue.csv --label "mus 0.6" --label "mus 0.8" -o compare
      "$postproc" explore first.catalogue.csv --p-speed 2.08 --s-speed 1.06 --title "Fault of length 120" -o page.html
      chromium --headless --no-sandbox --hide-scrollbars --window-size=1400,2335 --virtual-time-budget=20000 \
        --screenshot=page.png "file://$new/page.html" >out 2>&1
      "$postproc" rupture before.ruptures.csv --history before.slip.bin --from 4000 --to 10800 --p-speed 2.08 --s-speed 1.06 \
        -o rupture
      "$lmp" -in "$root/inputs/fault.in" -var extra fault_image -var restart first.restart.210000 -var prefix look -var ruptures no \
        -var steps 206000 -var from 214900 -var to 214900 -var every 1000 </dev/null >out
      cd - >/dev/null
      gnuplot -e "frame = '$new/look.000214900.png'" fault_event.gp
      cp "$new/series.png" fig8_to_11_series.png
      cp "$new/largest.png" tutorial_series.png
      cp "$new/sizes.png" tutorial_sizes.png
      cp "$new/compare.png" tutorial_compare.png
      cp "$new/page.png" explore.png
      for name in event spacetime; do cp "$new/rupture-$name.png" rupture_$name.png; done
      ;;
    studies)
      gnuplot -e "table = 'slow-driving.csv'; around = 'slow-driving-aftershocks.csv'" ../inputs/studies/slow-driving.gp
      gnuplot -e "table = 'slow-driving-slider.csv'" ../inputs/studies/slow-driving-slider.gp
      gnuplot -e "table = 'accuracy_catalogues.csv'; name = 'accuracy_catalogues'" ../inputs/studies/work-precision.gp
      gnuplot -e "table = 'regime-map.csv'" ../inputs/studies/regime-map.gp
      gnuplot accuracy.gp
      rm -f regime-map.svg
      ;;
    *)
      echo "pictures.sh: part '$part', expected catalogues, run or studies" >&2
      exit 2
      ;;
  esac
done
