# Draws regime-map.png and regime-map.svg from table.csv: the saw-tooth number over stress and viscosity, length 120, nothing else changed
set datafile separator ","
set datafile columnheaders
set encoding utf8
do for [kind in "png svg"] {
if (kind eq "png") { set terminal pngcairo size 900,640 font "DejaVu Sans,12" background "#ffffff" } else { set terminal svg size 900,640 font "DejaVu Sans,12" background "#ffffff" }
set output "regime-map.".kind
set logscale xy
set logscale cb
set xlabel "normal stress"
set ylabel "viscosity"
set xrange [0.0022:0.068]
set yrange [0.0012:0.17]
set cblabel "saw-tooth number (speed of fall / speed of rise of PE)"
set cbrange [1:12]
set palette defined (0 "#b2182b", 0.44 "#f7f7f7", 1 "#2166ac")
set title "Where the fault creeps (below 3) and where it sticks and slips; exponent of the sizes below"
set key off
set xtics (0.003, 0.006, 0.01, 0.015, 0.02, 0.03, 0.05)
set ytics (0.002, 0.005, 0.015, 0.05, 0.1)
viscosity(torn) = column("length") == 120 && strcol("settings") eq "choices=first" && (strcol("torn") ne "") == torn ? column("viscosity") : NaN
plot "table.csv" using "stress":(viscosity(0)):"saw_tooth" with points pt 7 ps 7 lc palette, \
     "" using "stress":(viscosity(0)):(sprintf("%.1f", column("saw_tooth"))) with labels font ",11", \
     "" using "stress":(viscosity(0)):(sprintf("%.2f", column("exponent_3"))) with labels offset 0,-2.1 font ",9", \
     "" using "stress":(viscosity(1)) with points pt 2 ps 3 lw 2 lc rgb "#777777", \
     "" using "stress":(viscosity(1)):("links torn") with labels offset 0,-2.1 font ",9" tc rgb "#777777", \
     "+" using (0.02):(0.015) with points pt 6 ps 8.5 lw 2.5 lc rgb "black"
set output
}
