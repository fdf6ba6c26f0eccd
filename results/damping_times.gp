# Draws damping_times.png and damping_times.svg from
# damping_times.csv: run `gnuplot ./damping_times.gp` in this folder.
base = "./damping_times"
table = base.".csv"
if (!exists("formats")) formats = "png svg"

do for [format in formats] {
if (format eq "png") {
point = 1.0
set terminal pngcairo size 1800,1192 enhanced font "DejaVu Sans,26" linewidth 2 pointscale 2 background "#ffffff"
} else {
point = 0.65
set terminal svg size 900,596 dynamic enhanced font "DejaVu Sans,13" background "#ffffff"
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
set xlabel "inter-event time θ (model time)"
set logscale x
set format x "10^{%L}"
set xtics 10
set mxtics 10
set xrange [0.01:1000]
set ylabel "probability density f(θ) (1 / model time)"
set logscale y
set format y "10^{%L}"
set ytics 10
set mytics 10
set yrange [9.9999999999999995e-08:10]
row(k) = $1 == k && $7 > 0 ? $6 : NaN
low(y, e) = y - e > 0.1 * y ? y - e : 0.1 * y
set samples 400
plot table using (row(1)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 1 dt 1 lw 0.8 notitle, \
     table using (row(1)):8 with points lt 1 notitle, \
     keyentry with linespoints lt 1 title "fault, length 120 (7280 times)", \
     table using (row(2)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 2 dt 1 lw 0.8 notitle, \
     table using (row(2)):8 with points lt 2 notitle, \
     keyentry with linespoints lt 2 title "fault, length 240 (7195 times)", \
     table using (row(3)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 3 dt 1 lw 0.8 notitle, \
     table using (row(3)):8 with points lt 3 notitle, \
     keyentry with linespoints lt 3 title "fault, length 480 (10610 times)", \
     table using (row(4)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 4 dt 1 lw 0.8 notitle, \
     table using (row(4)):8 with points lt 4 notitle, \
     keyentry with linespoints lt 4 title "fault, length 945 (9835 times)", \
     table using (row(5)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 5 dt 1 lw 0.8 notitle, \
     table using (row(5)):8 with points lt 5 notitle, \
     keyentry with linespoints lt 5 title "fault, length 1440 (9450 times)", \
     table using (row(6)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 6 dt 1 lw 0.8 notitle, \
     table using (row(6)):8 with points lt 6 notitle, \
     keyentry with linespoints lt 6 title "fault, length 1890 (9491 times)", \
     [0.09999999999999995:398.10717055349784] '+' using 1:(0.076272075026757147*$1**(-0.056303451014927175)*exp(-$1**(1)/14.727364931540402)) with lines lt 1 dt 3 lw 2 notitle, \
     [0.079432823472428096:398.10717055349784] '+' using 1:(0.073322864961261558*$1**(-0.028900425681842368)*exp(-$1**(1)/14.479700931364068)) with lines lt 2 dt 3 lw 2 notitle, \
     [0.079432823472428096:199.52623149688822] '+' using 1:(0.12673678394259333*$1**(-0.36926038940452932)*exp(-$1**(1)/15.119886927401783)) with lines lt 3 dt 3 lw 2 notitle, \
     [0.079432823472428096:199.52623149688822] '+' using 1:(0.11927121519559769*$1**(-0.33605590284969677)*exp(-$1**(1)/15.496266701413752)) with lines lt 4 dt 3 lw 2 notitle, \
     [0.079432823472428096:251.18864315095834] '+' using 1:(0.11861430137619933*$1**(-0.38699908574778941)*exp(-$1**(1)/17.466868483006895)) with lines lt 5 dt 3 lw 2 notitle, \
     [0.079432823472428096:158.48931924611153] '+' using 1:(0.11750577891121419*$1**(-0.35594742951474023)*exp(-$1**(1)/16.551249240458052)) with lines lt 6 dt 3 lw 2 notitle, \
     keyentry with lines lt 8 dt 3 lw 2 title "fit rejected (p < 0.05)"
unset output
}
