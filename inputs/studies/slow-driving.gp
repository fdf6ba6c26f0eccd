# Draws slow-driving.png and slow-driving.svg from table.csv and around.csv
set datafile separator ","
set datafile columnheaders
do for [kind in "png svg"] {
if (kind eq "png") { set terminal pngcairo size 1800,1300 font "DejaVu Sans,21" linewidth 2 pointscale 2 background "#ffffff" } \
else { set terminal svg size 900,650 dynamic font "DejaVu Sans,10.5" background "#ffffff" }
set output "slow-driving.".kind
unset logscale
set format y "%g"
set encoding utf8
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid xtics ytics lt 1 lw 0.5 lc rgb "#d8d8d8"
set multiplot layout 2,2 margins 0.08,0.98,0.085,0.95 spacing 0.10,0.165
yes(c) = strcol("fast") eq "2.5e-4" ? column(c) : NaN
slower(c) = strcol("fast") eq "1e-4" ? column(c) : NaN
no(c) = strcol("leap") eq "no" ? column(c) : NaN
base = NaN # steps for a large event without leaps at 2.5e-5
stats "table.csv" using (strcol("run") eq "2.5e-5_no_leaps" ? column("steps_per_large") : NaN) nooutput
if (exists("STATS_mean")) { base = STATS_mean }
set logscale x
set format x "10^{%L}"
set xrange [1.2e-8:6e-4]
set xlabel "driving velocity of each plate"
set key top left Left reverse samplen 1
set title "Events while the plates move by 36 each"
set ylabel "number of events" offset 1
set yrange [0:3000]
plot "table.csv" using "velocity":(yes("events_3")*36/column("way")) with points pt 7 lc rgb "#0072B2" title "from 10^{-3}, leaps", "" using "velocity":(no("events_3")*36/column("way")) with points pt 6 lc rgb "#0072B2" title "without leaps", \
  "" using "velocity":(slower("events_3")*36/column("way")) with points pt 2 lc rgb "#0072B2" title "leaps with 10^{-4}", "" using "velocity":(slower("events_2")*36/column("way")) with points pt 2 lc rgb "#D55E00" notitle, "" using "velocity":(slower("events_1")*36/column("way")) with points pt 2 lc rgb "#009E73" notitle, \
  "" using "velocity":(yes("events_2")*36/column("way")) with points pt 5 lc rgb "#D55E00" title "from 10^{-2}", "" using "velocity":(no("events_2")*36/column("way")) with points pt 4 lc rgb "#D55E00" notitle, \
  "" using "velocity":(yes("events_1")*36/column("way")) with points pt 9 lc rgb "#009E73" title "from 10^{-1}", "" using "velocity":(no("events_1")*36/column("way")) with points pt 8 lc rgb "#009E73" notitle
set title "Exponents"
set ylabel "exponent, γ" offset 1
set yrange [0:3.6]
plot "table.csv" using "velocity":(yes("long")):"long_error" with yerrorbars pt 7 lc rgb "#0072B2" title "sizes 10^{-3} to 1, leaps", "" using "velocity":(no("long")):"long_error" with yerrorbars pt 6 lc rgb "#0072B2" title "without leaps", \
  "" using "velocity":(slower("long")):"long_error" with yerrorbars pt 2 lc rgb "#0072B2" title "leaps with 10^{-4}", "" using (column("velocity")*1.1):(slower("from_2")):"from_2_error" with yerrorbars pt 2 lc rgb "#D55E00" notitle, "" using (column("velocity")*0.9):(slower("gamma")):"gamma_error" with yerrorbars pt 2 lc rgb "#009E73" notitle, \
  "" using (column("velocity")*1.1):(yes("from_2")):"from_2_error" with yerrorbars pt 5 lc rgb "#D55E00" title "sizes 10^{-2} to 1", "" using (column("velocity")*1.1):(no("from_2")):"from_2_error" with yerrorbars pt 4 lc rgb "#D55E00" notitle, \
  "" using (column("velocity")*0.9):(yes("gamma")):"gamma_error" with yerrorbars pt 9 lc rgb "#009E73" title "γ of the times from 10^{-3}", "" using (column("velocity")*0.9):(no("gamma")):"gamma_error" with yerrorbars pt 8 lc rgb "#009E73" notitle, \
  "" using (column("velocity")*0.8):(yes("gamma_2")):"gamma_2_error" with yerrorbars pt 13 lc rgb "#CC79A7" title "γ from 10^{-2}", "" using (column("velocity")*0.8):(no("gamma_2")):"gamma_2_error" with yerrorbars pt 12 lc rgb "#CC79A7" notitle
set title "Events from 10^{-3} after a main shock (10^{-1} and more)"
set xrange [1:2e6]
set xlabel "time since its end (time units)"
set yrange [1e-8:3]
set logscale y
set format y "10^{%L}"
set ylabel "events per main shock and time unit" offset 1
set key top right
at(v, fast) = strcol("velocity") eq v && strcol("fast") eq fast && column("rate") > 0 ? column("rate") : NaN
plot "around.csv" using "time":(at("2.5e-4", "")) with points pt 6 lc rgb "#000000" title "2.5·10^{-4}, no leaps", \
  "" using "time":(at("2.5e-5", "")) with points pt 4 lc rgb "#D55E00" title "2.5·10^{-5}, no leaps", \
  "" using "time":(at("2.5e-5", "2.5e-4")) with points pt 5 lc rgb "#D55E00" title "2.5·10^{-5}, leaps", \
  "" using "time":(at("2.5e-6", "2.5e-4")) with points pt 9 lc rgb "#009E73" title "2.5·10^{-6}", \
  "" using "time":(at("2.5e-7", "2.5e-4")) with points pt 7 lc rgb "#0072B2" title "2.5·10^{-7}", \
  "" using "time":(at("2.5e-8", "2.5e-4")) with points pt 13 lc rgb "#CC79A7" title "2.5·10^{-8}"
set title "Cost of an event of 10^{-2} and more"
set xrange [1.2e-8:6e-4]
set xlabel "driving velocity of each plate"
set yrange [1e3:3e7]
set ylabel "steps" offset 1
set key top right
plot "table.csv" using "velocity":(yes("steps_per_large")) with points pt 7 lc rgb "#0072B2" title "leaps", "" using "velocity":(slower("steps_per_large")) with points pt 2 lc rgb "#0072B2" title "leaps with 10^{-4}", "" using "velocity":(no("steps_per_large")) with points pt 4 lc rgb "#D55E00" title "without", \
  [2.5e-8:2.5e-4] base*2.5e-5/x lc rgb "#D55E00" dt (4,4) title "as 1 / velocity"
unset multiplot
set output
}
