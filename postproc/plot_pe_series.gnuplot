# SPDX-License-Identifier: GPL-2.0-or-later
# Called by plot-pe-series.sh: FOLDER OUT FORMAT T0 T1 TITLE LAMBDA READING
# FOLDER holds the curves pe, change, smooth (time value) and events (start end pe_start pe_end size).
dir = ARG1
t0 = real(ARG4)
t1 = real(ARG5)

if (ARG3 eq "svg") {
  set terminal svg size 1100,900 dynamic enhanced font "DejaVu Sans,13" background "#ffffff"
} else {
  set terminal pngcairo size 1650,1350 enhanced font "DejaVu Sans,17" linewidth 1.5 background "#ffffff"
}
set output ARG2

# Okabe and Ito's colours, told apart with any kind of colour vision.
blue = "#0072B2"
orange = "#D55E00"
green = "#009E73"
grey = "#c4c4c4"

events = dir . "/events"
stats dir . "/pe" using 2 nooutput name "PE"
stats dir . "/change" using 2 nooutput name "CH"
stats dir . "/smooth" using 2 nooutput name "SM"
have_events = int(system("wc -l < '" . events . "'")) > 0
pad(lo, hi) = (hi > lo ? 0.06 * (hi - lo) : (abs(hi) > 0 ? 0.1 * abs(hi) : 1.0))

set style fill solid 1.0 noborder
set xrange [t0:t1]
set border lw 1.2 lc rgb "#333333"
set tics nomirror out
set grid front ytics lt 1 lw 0.5 lc rgb "#dddddd"
unset grid
set key at graph 1.0,1.03 right bottom horizontal samplen 2.2 spacing 1.1 width 1 textcolor rgb "#222222"
set lmargin 15
set rmargin 3
set format y "%.3g"

set multiplot layout 3,1 title ARG6 margins 0.12,0.97,0.075,0.90 spacing 0.0,0.085
box_lo = PE_min - pad(PE_min, PE_max)
box_hi = PE_max + pad(PE_min, PE_max)
set yrange [box_lo:box_hi]
set format x ""
set ylabel "Potential energy" offset -1,0
# Rounded numbers hide small changes on a large offset: label the distance from the lowest value then.
if ((PE_max - PE_min) < 0.01 * abs(PE_max)) {
  set ylabel sprintf("Potential energy - %.6g", PE_min) offset -1,0
  shift = PE_min
} else {
  shift = 0.0
}
set yrange [box_lo - shift:box_hi - shift]
if (have_events) {
  plot events using 1:(box_lo - shift):1:2:(box_lo - shift):(box_hi - shift) with boxxyerror lc rgb grey title "event", \
       dir . "/pe" using 1:($2 - shift) with lines lw 1.5 lc rgb blue title "potential energy", \
       events using 2:($3 - shift):(0):(-$5) with vectors head filled size screen 0.006,18 lw 1.6 lc rgb orange \
         title "size of the event"
} else {
  plot dir . "/pe" using 1:($2 - shift) with lines lw 1.5 lc rgb blue title "potential energy"
}

box_lo = CH_min - pad(CH_min, CH_max)
box_hi = CH_max + pad(CH_min, CH_max)
set yrange [box_lo:box_hi]
set ylabel "Change per sample" offset -1,0
if (have_events) {
  plot events using 1:(box_lo):1:2:(box_lo):(box_hi) with boxxyerror lc rgb grey notitle, \
       0 with lines lw 0.8 lc rgb "#555555" notitle, \
       dir . "/change" with lines lw 1 lc rgb green title "change of potential energy"
} else {
  plot 0 with lines lw 0.8 lc rgb "#555555" notitle, \
       dir . "/change" with lines lw 1 lc rgb green title "change of potential energy"
}

box_lo = SM_min - pad(SM_min, SM_max)
box_hi = SM_max + pad(SM_min, SM_max)
set yrange [box_lo:box_hi]
set format x "%.6g"
set xlabel "Time (model units)"
set ylabel "Smoothed change" offset -1,0
label = sprintf("smoothed (%s, {/Symbol l} = %.6g); events where negative", ARG8, real(ARG7))
if (have_events) {
  plot events using 1:(box_lo):1:2:(box_lo):(box_hi) with boxxyerror lc rgb grey notitle, \
       0 with lines lw 0.8 lc rgb "#555555" notitle, \
       dir . "/smooth" with lines lw 1.5 lc rgb blue title label
} else {
  plot 0 with lines lw 0.8 lc rgb "#555555" notitle, \
       dir . "/smooth" with lines lw 1.5 lc rgb blue title label
}
unset multiplot
set output
