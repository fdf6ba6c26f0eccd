# Draws fig14_fault_intervals.png and fig14_fault_intervals.svg from fig14_fault_intervals.csv: run `gnuplot ./fig14_fault_intervals.gp` in this folder.
base = "./fig14\137fault\137intervals"
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
set xlabel "inter-event time θ (model time units)"
set logscale x
set format x "10^{%L}"
set xtics 10
set mxtics 10
set xrange [0.10000000000000001:10000]
set ylabel "probability density f(θ) (1 / model time)"
set logscale y
set format y "10^{%L}"
set ytics 10
set mytics 10
set yrange [9.9999999999999995e-08:1]
row(k) = $1 == k && $7 > 0 ? $6 : NaN
low(y, e) = y - e > 0.1 * y ? y - e : 0.1 * y
set samples 400
plot table using (row(1)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 1 dt 1 lw 0.8 notitle, \
     table using (row(1)):8 with points lt 1 notitle, \
     keyentry with linespoints lt 1 title "fault 120 (623 times)", \
     table using (row(2)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 2 dt 1 lw 0.8 notitle, \
     table using (row(2)):8 with points lt 2 notitle, \
     keyentry with linespoints lt 2 title "fault 240 (712 times)", \
     table using (row(3)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 3 dt 1 lw 0.8 notitle, \
     table using (row(3)):8 with points lt 3 notitle, \
     keyentry with linespoints lt 3 title "fault 480 (942 times)", \
     table using (row(4)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 4 dt 1 lw 0.8 notitle, \
     table using (row(4)):8 with points lt 4 notitle, \
     keyentry with linespoints lt 4 title "fault 945 (1138 times)", \
     table using (row(5)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 5 dt 1 lw 0.8 notitle, \
     table using (row(5)):8 with points lt 5 notitle, \
     keyentry with linespoints lt 5 title "fault 1440 (1247 times)", \
     table using (row(6)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 6 dt 1 lw 0.8 notitle, \
     table using (row(6)):8 with points lt 6 notitle, \
     keyentry with linespoints lt 6 title "fault 1890 (1419 times)", \
     [1:1584.8931924611163] '+' using 1:(0.0099671634956845466*$1**(-0.20114363293151905)*exp(-$1**(1)/277.11515065559479)) with lines lt 1 notitle, \
     [1.99526231496888:1258.9254117941693] '+' using 1:(0.0010215171040128829*$1**(0.44288051866850342)*exp(-$1**(0.93745306316542742)/90.860315088451472)) with lines lt 2 notitle, \
     [0.63095734448019314:1584.8931924611163] '+' using 1:(0.0012501210650633242*$1**(0.45063409719320457)*exp(-$1**(1.0567623406531013)/147.7335850527819)) with lines lt 3 notitle, \
     [0.31622776601683783:1000.0000000000017] '+' using 1:(0.0078101580416718493*$1**(-0.038184568220568371)*exp(-$1**(1.1962978986486879)/434.35130821858218)) with lines lt 4 notitle, \
     [0.19952623149688789:1000.0000000000017] '+' using 1:(0.013044865476967737*$1**(-0.14728715831000516)*exp(-$1**(1.089754480104558)/230.23352864227823)) with lines lt 5 notitle, \
     [0.31622776601683783:794.32823472428277] '+' using 1:(0.0096989988341181898*$1**(0.10522167340626676)*exp(-$1**(0.79938704820038509)/26.486096837933449)) with lines lt 6 notitle, \
     keyentry with lines lt 8 title 'lines: fitted generalised gamma'
unset output
}
