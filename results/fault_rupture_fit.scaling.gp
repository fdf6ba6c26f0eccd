# Draws fault_rupture_fit.scaling.png and fault_rupture_fit.scaling.svg from
# fault_rupture_fit.scaling.csv: run `gnuplot ./fault_rupture_fit.scaling.gp` in this folder.
base = "./fault_rupture_fit.scaling"
table = base.".csv"
if (!exists("formats")) formats = "png svg"

do for [format in formats] {
if (format eq "png") {
point = 1.0
set terminal pngcairo size 1800,1100 enhanced font "DejaVu Sans,26" linewidth 2 pointscale 2 background "#ffffff"
} else {
point = 0.65
set terminal svg size 900,550 dynamic enhanced font "DejaVu Sans,13" background "#ffffff"
}

set datafile separator comma
set encoding utf8
set linetype 1 lc rgb "#0072B2" pt 7  dt 1 lw 1.6 ps 0.8*point
set linetype 2 lc rgb "#D55E00" pt 5  dt (14,6) lw 1.6 ps 0.75*point
set linetype 3 lc rgb "#009E73" pt 9  dt (4,4) lw 1.8 ps 0.95*point
set linetype 4 lc rgb "#CC79A7" pt 13 dt (14,4,3,4) lw 1.6 ps 1.0*point
set linetype 5 lc rgb "#E69F00" pt 4  dt (20,4,3,4,3,4) lw 1.6 ps 0.8*point
set linetype 6 lc rgb "#56B4E9" pt 6  dt (8,3) lw 1.6 ps 0.85*point
set linetype 7 lc rgb "#7A6A00" pt 8  dt (2,3) lw 1.8 ps 0.95*point
set linetype 8 lc rgb "#000000" pt 12 dt 1 lw 1.2 ps 0.95*point
set linetype 9 lc rgb "#0072B2" pt 6 dt (3,5) lw 1.4 ps 0.9*point
set linetype 10 lc rgb "#D55E00" pt 4 dt (3,5) lw 1.4 ps 0.9*point
set linetype 11 lc rgb "#009E73" pt 8 dt (3,5) lw 1.4 ps 0.9*point
set linetype 12 lc rgb "#CC79A7" pt 12 dt (3,5) lw 1.4 ps 0.9*point
set linetype 13 lc rgb "#E69F00" pt 5 dt (3,5) lw 1.4 ps 0.9*point
set linetype 14 lc rgb "#56B4E9" pt 7 dt (3,5) lw 1.4 ps 0.9*point
set linetype 15 lc rgb "#7A6A00" pt 9 dt (3,5) lw 1.4 ps 0.9*point
set linetype 16 lc rgb "#000000" pt 13 dt (3,5) lw 1.4 ps 0.9*point
set linetype cycle 16
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid xtics ytics lt 1 dt 1 lw 0.5 lc rgb "#d8d8d8"
set key outside bottom center horizontal samplen 3 spacing 1.15 maxcols 2 width -3 Left reverse height 1
set output base.".".format
set xlabel "length of the fault"
set logscale x
set xtics ("100" 100, "200" 200, "500" 500, "1000" 1000, "2000" 2000, "5000" 5000)
set xrange [100:5000]
set ylabel "characteristic size s* (energy)"
set logscale y
set ytics ("0.5" 0.5, "0.7" 0.7, "1" 1, "2" 2)
set yrange [0.5:2]
row(k) = $1 == k ? $3 : NaN
low(y, e) = y - e > 0.1 * y ? y - e : 0.1 * y
set samples 400
plot table using (row(1)):(low($4,$5)):(0):($4+$5-low($4,$5)) with vectors heads size screen 0.003,90 lt 1 dt 1 lw 0.8 notitle, \
     table using (row(1)):4 with points lt 1 title "fault, ruptures: s*", \
     [102:2223.5294117647059] '+' using 1:(0.88263671921595077*$1**(-0.028478715373439295)) with lines lt 1 title "A L^D with D = -0.028 ± 0.021", \
     [102:2223.5294117647059] '+' using 1:(0.72602056071169241) with lines lt 8 dt 2 title "constant"
unset output
}
