# Draws work-precision.png and work-precision.svg from differences.csv
set datafile separator ","
set datafile columnheaders
if (!exists("table")) { table = "differences.csv" }
if (!exists("name")) { name = "work-precision" }
stats table using "time_per_core_hour" nooutput
most = STATS_max
do for [kind in "png svg"] {
if (kind eq "png") { set terminal pngcairo size 1800,860 font "DejaVu Sans,20" linewidth 2 pointscale 2 background "#ffffff" } \
else { set terminal svg name "work_precision" size 900,430 dynamic font "DejaVu Sans,10" background "#ffffff" }
set output name.".".kind
set encoding utf8
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid xtics ytics lt 1 lw 0.5 lc rgb "#d8d8d8"
set multiplot layout 1,3 margins 0.06,0.985,0.36,0.92 spacing 0.065,0
unset logscale
set logscale x
set xrange [most/12.:most*2]
set xlabel "model time per core-hour"
set xtics format "10^{%L}"
# rows of the table, named by their settings
rows = STATS_records
label(n) = system(sprintf("awk -F, '/^#/ { next } !h { h = 1; for (i = 1; i <= NF; i++) c[$i] = i; next } k++ == %d {" \
  ." printf(\"dt %%s, masses %%s%%s\", $c[\"dt\"], $c[\"massstep\"] > 0 ? \"raised\" : \"r^2\"," \
  ." $c[\"onset\"] == \"step\" ? \", onset step\" : \"\") }' %s", n, table))
one(n, c) = int(column(0)) == n ? column(c) : NaN
set for [n=0:7] linetype n + 1 lc rgb word("#000000 #0072B2 #D55E00 #009E73 #CC79A7 #E69F00 #56B4E9 #7A6A00", n + 1) pt 7
set key at screen 0.06,0.20 left top Left reverse samplen 1 maxrows 3 width -2
set title "Events ≥ 10^{-3}, relative difference"
set yrange [-0.1:0.1]
plot 0 lc rgb "#888888" dt 2 notitle, for [n=0:rows-1] table using "time_per_core_hour":(one(n, "rate")):"rate_error" with yerrorbars lt n + 1 notitle, \
  for [n=0:rows-1] keyentry with points lt n + 1 title label(n)
set key noautotitle
unset key
set title "Exponent (10^{-3} to 1), difference"
plot 0 lc rgb "#888888" dt 2, for [n=0:rows-1] table using "time_per_core_hour":(one(n, "exponent")):"exponent_error" with yerrorbars lt n + 1
set title "γ of inter-event times, difference"
set yrange [-0.3:0.3]
plot 0 lc rgb "#888888" dt 2, for [n=0:rows-1] table using "time_per_core_hour":(one(n, "gamma")):"gamma_error" with yerrorbars lt n + 1
unset multiplot
set output
}
