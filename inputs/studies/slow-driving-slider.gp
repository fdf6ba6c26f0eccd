# Draws slow-driving-slider.png and slow-driving-slider.svg from table.csv, runs of seed 1 with a
# displacement of at least 400
set datafile separator ","
set datafile columnheaders
if (!exists("table")) { table = "table.csv" }
$line << END_OF_LINE
velocity,steps
1e-6,4.5e8
1e-2,4.5e4
END_OF_LINE
do for [kind in "png svg"] {
if (kind eq "png") { set terminal pngcairo size 2100,820 font "DejaVu Sans,21" linewidth 2 pointscale 2 background "#ffffff" } \
else { set terminal svg name "slow_driving_slider" size 1050,410 dynamic font "DejaVu Sans,10.5" background "#ffffff" }
set output "slow-driving-slider.".kind
set encoding utf8
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid xtics ytics lt 1 lw 0.5 lc rgb "#d8d8d8"
set multiplot layout 1,3 margins 0.065,0.985,0.34,0.91 spacing 0.075,0
is(n, c, leaps) = column("blocks") == n && column("seed") == 1 && column("displacement") >= 400 && strcol("leap") eq (leaps ? "1e-3" : "0") ? column(c) : NaN
set logscale xy
set format x "10^{%L}"
set xrange [5e-8:2e-2]
set xlabel "driving velocity of the plate"
set format y "%g"
set key at screen 0.02,0.155 left top Left reverse samplen 1 maxrows 2 width -1
set title "Events per displacement of 1000"
set ylabel "number of events" offset 0.5
set yrange [20:3000]
set ytics (20, 50, 100, 200, 500, 1000, 2000)
plot table using "velocity":(is(256, "events_1", 1)) with points pt 7 lc rgb "#0072B2" title "256 blocks, ≥ 1", "" using "velocity":(is(256, "events_1", 0)) with points pt 6 lc rgb "#0072B2" notitle, \
  "" using "velocity":(is(256, "events_100", 1)) with points pt 5 lc rgb "#0072B2" title "256 blocks, ≥ 100", "" using "velocity":(is(256, "events_100", 0)) with points pt 4 lc rgb "#0072B2" notitle, \
  "" using "velocity":(is(1928, "events_1", 1)) with points pt 7 lc rgb "#D55E00" title "1928 blocks, ≥ 1", "" using "velocity":(is(1928, "events_1", 0)) with points pt 6 lc rgb "#D55E00" notitle, \
  "" using "velocity":(is(1928, "events_100", 1)) with points pt 5 lc rgb "#D55E00" title "1928 blocks, ≥ 100", "" using "velocity":(is(1928, "events_100", 0)) with points pt 4 lc rgb "#D55E00" notitle
set title "γ of the times between events ≥ 1"
set ylabel "γ" offset 1
set yrange [0.05:0.5]
set ytics (0.05, 0.1, 0.2, 0.4)
set key at screen 0.40,0.155 left top Left reverse samplen 1 maxrows 2 width -1
plot table using "velocity":(is(256, "gamma", 1)) with points pt 7 lc rgb "#0072B2" title "256 blocks", "" using "velocity":(is(256, "gamma", 0)) with points pt 6 lc rgb "#0072B2" notitle, \
  "" using "velocity":(is(1928, "gamma", 1)) with points pt 7 lc rgb "#D55E00" title "1928 blocks", "" using "velocity":(is(1928, "gamma", 0)) with points pt 6 lc rgb "#D55E00" notitle
set title "Cost of an event ≥ 100"
set ylabel "steps" offset 1
set yrange [1e3:1e10]
set ytics auto
set format y "10^{%L}"
set key at screen 0.72,0.155 left top Left reverse samplen 1 maxrows 2 width -4
plot table using "velocity":(is(256, "steps_per_100", 1)) with points pt 7 lc rgb "#0072B2" title "256 blocks", "" using "velocity":(is(256, "steps_per_100", 0)) with points pt 6 lc rgb "#0072B2" notitle, \
  "" using "velocity":(is(1928, "steps_per_100", 1)) with points pt 7 lc rgb "#D55E00" title "1928 blocks", "" using "velocity":(is(1928, "steps_per_100", 0)) with points pt 6 lc rgb "#D55E00" notitle, \
  $line using 1:2 with lines lc rgb "#777777" dt (4,4) title "as 1 / velocity"
unset multiplot
set output
}
