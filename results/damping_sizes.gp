# Draws damping_sizes.png and damping_sizes.svg from
# damping_sizes.csv: run `gnuplot ./damping_sizes.gp` in this folder.
base = "./damping_sizes"
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
set xlabel "event size s (energy, model units)"
set logscale x
set format x "10^{%L}"
set xtics 10
set mxtics 10
set xrange [0.0001:10]
set ylabel "probability density p(s) (1 / energy)"
set logscale y
set format y "10^{%L}"
set ytics 10
set mytics 10
set yrange [1.0000000000000001e-05:10000]
row(k) = $1 == k && $7 > 0 ? $6 : NaN
low(y, e) = y - e > 0.1 * y ? y - e : 0.1 * y
set samples 400
plot table using (row(1)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 1 dt 1 lw 0.8 notitle, \
     table using (row(1)):8 with points lt 1 notitle, \
     table using (row(1)):8 with lines lt 1 lw 1.2 notitle, \
     keyentry with linespoints lt 1 title "fault, length 120 (7281 events)", \
     table using (row(2)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 2 dt 1 lw 0.8 notitle, \
     table using (row(2)):8 with points lt 2 notitle, \
     table using (row(2)):8 with lines lt 2 lw 1.2 notitle, \
     keyentry with linespoints lt 2 title "fault, length 240 (7196 events)", \
     table using (row(3)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 3 dt 1 lw 0.8 notitle, \
     table using (row(3)):8 with points lt 3 notitle, \
     table using (row(3)):8 with lines lt 3 lw 1.2 notitle, \
     keyentry with linespoints lt 3 title "fault, length 480 (10611 events)", \
     table using (row(4)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 4 dt 1 lw 0.8 notitle, \
     table using (row(4)):8 with points lt 4 notitle, \
     table using (row(4)):8 with lines lt 4 lw 1.2 notitle, \
     keyentry with linespoints lt 4 title "fault, length 945 (9836 events)", \
     table using (row(5)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 5 dt 1 lw 0.8 notitle, \
     table using (row(5)):8 with points lt 5 notitle, \
     table using (row(5)):8 with lines lt 5 lw 1.2 notitle, \
     keyentry with linespoints lt 5 title "fault, length 1440 (9451 events)", \
     table using (row(6)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 6 dt 1 lw 0.8 notitle, \
     table using (row(6)):8 with points lt 6 notitle, \
     table using (row(6)):8 with lines lt 6 lw 1.2 notitle, \
     keyentry with linespoints lt 6 title "fault, length 1890 (9492 events)", \
     [0.0001:0.10000000000000001] '+' using 1:(0.26179520933182288*$1**(-1.0700000000000001)) with lines lt 8 dt 2 lw 2.2 title "slope -1.07"
unset output
}
