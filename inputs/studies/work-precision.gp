# Draws work-precision.png and work-precision.svg from differences.csv
set datafile separator ","
set datafile columnheaders
stats "differences.csv" using "time_per_core_hour" nooutput
most = STATS_max
do for [kind in "png svg"] {
if (kind eq "png") { set terminal pngcairo size 1800,750 font "DejaVu Sans,20" linewidth 2 pointscale 2 background "#ffffff" } \
else { set terminal svg size 900,375 dynamic font "DejaVu Sans,10" background "#ffffff" }
set output "work-precision.".kind
set encoding utf8
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid xtics ytics lt 1 lw 0.5 lc rgb "#d8d8d8"
set multiplot layout 1,3 margins 0.06,0.985,0.19,0.9 spacing 0.065,0
set logscale x
set xrange [most/12.:most*2]
set xlabel "model time per core-hour"
set xtics format "10^{%L}"
# rows of the table by number
row(n) = sprintf("%d", n + 1)
set key off
set title "Events ≥ 10^{-3}, relative difference"
set yrange [-0.1:0.1]
plot 0 lc rgb "#888888" dt 2, "differences.csv" using "time_per_core_hour":"rate":"rate_error" with yerrorbars pt 7 lc rgb "#0072B2", "" using "time_per_core_hour":"rate":(row($0)) with labels offset 1,0.6
set title "Exponent (10^{-3} to 1), difference"
plot 0 lc rgb "#888888" dt 2, "differences.csv" using "time_per_core_hour":"exponent":"exponent_error" with yerrorbars pt 5 lc rgb "#D55E00", "" using "time_per_core_hour":"exponent":(row($0)) with labels offset 1,0.6
set title "γ of inter-event times, difference"
set yrange [-0.3:0.3]
plot 0 lc rgb "#888888" dt 2, "differences.csv" using "time_per_core_hour":"gamma":"gamma_error" with yerrorbars pt 9 lc rgb "#009E73", "" using "time_per_core_hour":"gamma":(row($0)) with labels offset 1,0.6
unset multiplot
set output
}
