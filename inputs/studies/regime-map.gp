# Draws regime-map.png and regime-map.svg from table.csv: the saw-tooth number over stress and
# viscosity, length 120; the ring marks the default
set datafile separator ","
set datafile columnheaders
set encoding utf8
if (!exists("table")) { table = "table.csv" }
stats table using (column("stress")) nooutput
least = STATS_min
most = STATS_max
ring(_) = column("stress") == 0.025 && column("viscosity") == 0.05
stats table using (strcol("settings") eq "" && ring(0) ? column(0) : NaN) nooutput
first = STATS_min # the settings of the ring may be there twice
do for [kind in "png svg"] {
if (kind eq "png") { set terminal pngcairo size 1800,1280 font "DejaVu Sans,24" pointscale 2 linewidth 2 background "#ffffff" } else { set terminal svg name "regime_map" size 900,640 font "DejaVu Sans,12" background "#ffffff" }
set output "regime-map.".kind
set logscale xy
set logscale cb
set xlabel "normal stress"
set ylabel "viscosity"
set xrange [least/1.35:most*1.4]
set yrange [0.0012:0.17]
set cblabel "saw-tooth number (rate of fall / rate of rise of PE)"
set cbrange [0.8:35]
set cbtics (1, 2, 3, 5, 10, 20)
set palette defined (0 "#f4a582", 0.35 "#f7f7f7", 1 "#92c5de")
set title "Saw-tooth number at length 120: creep below 3, stick-slip above; below each: exponent of the sizes"
set key off noautotitle
set xtics (0.003, 0.006, 0.01, 0.015, 0.025, 0.05)
set ytics (0.002, 0.005, 0.015, 0.05, 0.1)
viscosity(torn) = column("length") == 120 && strcol("settings") eq "" && !(ring(0) && column(0) > first) && (strlen(strcol("saw_tooth")) == 0) == torn ? column("viscosity") : NaN
plot table using "stress":(viscosity(0)):"saw_tooth" with points pt 7 ps 6 lc palette, \
     "" using "stress":(viscosity(0)):(sprintf("%.1f", column("saw_tooth"))) with labels font ",22", \
     "" using "stress":(viscosity(0)):(strlen(strcol("exponent_3")) ? sprintf("%.2f", column("exponent_3")) : "") with labels offset 0,-1.9 font ",18", \
     "" using "stress":(viscosity(1)) with points pt 2 ps 2 lw 2 lc rgb "#777777", \
     "" using "stress":(viscosity(1)):("links torn") with labels offset 0,-1.9 font ",18" tc rgb "#777777", \
     "+" using (0.025):(0.05) with points pt 6 ps 7.5 lw 2.5 lc rgb "black"
set output
}
