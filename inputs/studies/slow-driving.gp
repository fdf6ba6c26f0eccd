# Draws slow-driving.png and slow-driving.svg from table.csv and around.csv
set datafile separator ","
set datafile columnheaders
if (!exists("table")) { table = "table.csv" }
if (!exists("around")) { around = "around.csv" }
# steps per large event without leaps at 2.5e-5; before anything is drawn, as stats obeys ranges
base = NaN
stats table using (strcol("leap") eq "no" && strcol("velocity") eq "2.5e-4" ? column("steps_per_large") : NaN) nooutput
if (exists("STATS_mean")) { base = STATS_mean }
do for [kind in "png svg"] {
if (kind eq "png") { set terminal pngcairo size 1800,1440 font "DejaVu Sans,24" linewidth 2 pointscale 2 background "#ffffff" } \
else { set terminal svg name "slow_driving" size 900,720 dynamic font "DejaVu Sans,12" background "#ffffff" }
set output "slow-driving.".kind
unset logscale
set format y "%g"
set encoding utf8
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid xtics ytics lt 1 lw 0.5 lc rgb "#d8d8d8"
set multiplot layout 2,3 margins 0.085,0.985,0.1,0.945 spacing 0.095,0.19
# filled: leaps with plates of 2.5e-4, crosses: of 1e-4, open: no leaps
yes(c) = strcol("fast") eq "2.5e-4" ? column(c) : NaN
slower(c) = strcol("fast") eq "1e-4" ? column(c) : NaN
no(c) = strcol("leap") eq "no" ? column(c) : NaN
set logscale x
set format x "10^{%L}"
set xrange [1.2e-8:6e-4]
set xtics 10
set xlabel "driving velocity of each plate"
set key noautotitle
unset key
set title "Events per displacement of 18"
set ylabel "number of events" offset 0.5
set logscale y
set yrange [40:2000]
set ytics (50, 100, 200, 500, 1000)
plot table using "velocity":(yes("events_3")*18/column("displacement")) with points pt 7 lc rgb "#0072B2", "" using "velocity":(no("events_3")*18/column("displacement")) with points pt 6 lc rgb "#0072B2", \
  "" using "velocity":(slower("events_3")*18/column("displacement")) with points pt 2 lc rgb "#0072B2", "" using "velocity":(slower("events_2")*18/column("displacement")) with points pt 2 lc rgb "#D55E00", "" using "velocity":(slower("events_1")*18/column("displacement")) with points pt 2 lc rgb "#009E73", \
  "" using "velocity":(yes("events_2")*18/column("displacement")) with points pt 7 lc rgb "#D55E00", "" using "velocity":(no("events_2")*18/column("displacement")) with points pt 6 lc rgb "#D55E00", \
  "" using "velocity":(yes("events_1")*18/column("displacement")) with points pt 7 lc rgb "#009E73", "" using "velocity":(no("events_1")*18/column("displacement")) with points pt 6 lc rgb "#009E73"
unset logscale y
set ytics auto
set title "Exponent of the sizes up to 1"
set ylabel "exponent" offset 0.5
set yrange [0.7:1.4]
plot table using "velocity":(yes("long")):"long_error" with yerrorbars pt 7 lc rgb "#0072B2", "" using "velocity":(no("long")):"long_error" with yerrorbars pt 6 lc rgb "#0072B2", \
  "" using "velocity":(slower("long")):"long_error" with yerrorbars pt 2 lc rgb "#0072B2", "" using (column("velocity")*1.15):(slower("from_2")):"from_2_error" with yerrorbars pt 2 lc rgb "#D55E00", \
  "" using (column("velocity")*1.15):(yes("from_2")):"from_2_error" with yerrorbars pt 7 lc rgb "#D55E00", "" using (column("velocity")*1.15):(no("from_2")):"from_2_error" with yerrorbars pt 6 lc rgb "#D55E00"
set title "γ of the inter-event times"
set ylabel "γ" offset 0.5
set yrange [0:2]
plot table using "velocity":(yes("gamma")):"gamma_error" with yerrorbars pt 7 lc rgb "#0072B2", "" using "velocity":(no("gamma")):"gamma_error" with yerrorbars pt 6 lc rgb "#0072B2", \
  "" using "velocity":(slower("gamma")):"gamma_error" with yerrorbars pt 2 lc rgb "#0072B2", "" using "velocity":(slower("gamma_2")):"gamma_2_error" with yerrorbars pt 2 lc rgb "#D55E00", \
  "" using "velocity":(yes("gamma_2")):"gamma_2_error" with yerrorbars pt 7 lc rgb "#D55E00", "" using "velocity":(no("gamma_2")):"gamma_2_error" with yerrorbars pt 6 lc rgb "#D55E00"
set title "Events ≥ 10^{-3} after a main shock"
set xrange [1:2e6]
set xtics 100
set xlabel "time since its end (time units)"
set yrange [1e-8:3]
set logscale y
set format y "10^{%L}"
set ytics 100
set ylabel "per main shock and time unit" offset 0.5
at(v, fast) = strcol("velocity") eq v && strcol("fast") eq fast && column("rate") > 0 ? column("rate") : NaN
plot around using "time":(at("2.5e-4", "")) with points pt 6 lc rgb "#000000", \
  "" using "time":(at("2.5e-5", "")) with points pt 6 lc rgb "#E69F00", \
  "" using "time":(at("2.5e-5", "2.5e-4")) with points pt 7 lc rgb "#E69F00", \
  "" using "time":(at("2.5e-6", "2.5e-4")) with points pt 7 lc rgb "#56B4E9", \
  "" using "time":(at("2.5e-7", "2.5e-4")) with points pt 7 lc rgb "#CC79A7", \
  "" using "time":(at("2.5e-8", "2.5e-4")) with points pt 7 lc rgb "#7A6A00"
set title "Cost of an event ≥ 10^{-2}"
set xrange [1.2e-8:6e-4]
set xtics 10
set xlabel "driving velocity of each plate"
set yrange [1e3:3e7]
set ytics 10
set ylabel "steps" offset 0.5
plot table using "velocity":(yes("steps_per_large")) with points pt 7 lc rgb "#0072B2", "" using "velocity":(slower("steps_per_large")) with points pt 2 lc rgb "#0072B2", "" using "velocity":(no("steps_per_large")) with points pt 6 lc rgb "#0072B2", \
  [2.5e-8:2.5e-4] base*2.5e-4/x lc rgb "#777777" dt (4,4)
# the last panel is the key of the others
unset title
unset border
unset tics
unset grid
unset xlabel
unset ylabel
unset logscale
set xrange [0:1]
set yrange [0:1]
set key at graph 0.98,1 top right Left reverse samplen 1 spacing 1.05 maxcols 1
plot NaN with points pt 7 lc rgb "#000000" title "leaps (plates of 2.5·10^{-4})", NaN with points pt 2 lc rgb "#000000" title "leaps (plates of 10^{-4})", \
  NaN with points pt 6 lc rgb "#000000" title "no leaps", NaN with points pt 5 lc rgb "#0072B2" title "sizes ≥ 10^{-3}", \
  NaN with points pt 5 lc rgb "#D55E00" title "sizes ≥ 10^{-2}", NaN with points pt 5 lc rgb "#009E73" title "sizes ≥ 10^{-1}", \
  NaN with lines lc rgb "#777777" dt (4,4) title "as 1 / velocity", NaN with points pt 6 lc rgb "#000000" title "after main shocks: 2.5·10^{-4}", \
  NaN with points pt 5 lc rgb "#E69F00" title "2.5·10^{-5}", NaN with points pt 5 lc rgb "#56B4E9" title "2.5·10^{-6}", \
  NaN with points pt 5 lc rgb "#CC79A7" title "2.5·10^{-7}", NaN with points pt 5 lc rgb "#7A6A00" title "2.5·10^{-8}"
set tics
set grid
set border
set ytics auto
unset multiplot
set output
}
