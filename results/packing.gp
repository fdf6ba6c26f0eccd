# SPDX-License-Identifier: GPL-2.0-or-later
# Draws packing.png from packing/faces.csv.xz: places of the discs of a face within a unit of length
set datafile separator ","
set encoding utf8
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid ytics lt 1 lw 0.5 lc rgb "#d8d8d8"
set terminal pngcairo size 1500,640 font "DejaVu Sans,20" linewidth 2 background "#ffffff"
set output "packing.png"
set xlabel "place along the fault, modulo 1"
set xrange [0:1]
set yrange [0:2]
width = 0.05
place(x) = width * (floor((x - floor(x)) / width) + 0.5)
face(seeds, side) = sprintf("< xz -dc packing/faces.csv.xz | awk -F, '$1 == \"%s\" && $2 == 1890 && $3 == 1 && $4 == %d'", seeds, side)
discs(seeds, side) = system(face(seeds, side)[3:]." | wc -l") + 0
set key top right samplen 2
set multiplot layout 1,2
do for [seeds in "grid random"] {
  set title seeds eq "grid" ? "Seeds on a grid" : "Seeds at random places"
  set ylabel seeds eq "grid" ? "discs of a face over their mean number" : ""
  first = 1 / (width * discs(seeds, 0))
  second = 1 / (width * discs(seeds, 1))
  plot 1 with lines lc rgb "#999999" dt 2 notitle, \
    face(seeds, 0) using (place($5)):(first) smooth frequency with histeps lc rgb "#0072B2" title "one face", \
    face(seeds, 1) using (place($5)):(second) smooth frequency with histeps lc rgb "#D55E00" title "the other"
}
unset multiplot
