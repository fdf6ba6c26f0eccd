# Draws fig14_fault_intervals.png and fig14_fault_intervals.svg from
# fig14_fault_intervals.csv: run `gnuplot ./fig14_fault_intervals.gp` in this folder.
base = "./fig14_fault_intervals"
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
set xrange [0.10000000000000001:10000]
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
     keyentry with linespoints lt 1 title "fault, length 120 (539 times)", \
     table using (row(2)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 2 dt 1 lw 0.8 notitle, \
     table using (row(2)):8 with points lt 2 notitle, \
     keyentry with linespoints lt 2 title "fault, length 240 (1247 times)", \
     table using (row(3)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 3 dt 1 lw 0.8 notitle, \
     table using (row(3)):8 with points lt 3 notitle, \
     keyentry with linespoints lt 3 title "fault, length 480 (1357 times)", \
     table using (row(4)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 4 dt 1 lw 0.8 notitle, \
     table using (row(4)):8 with points lt 4 notitle, \
     keyentry with linespoints lt 4 title "fault, length 945 (2340 times)", \
     table using (row(5)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 5 dt 1 lw 0.8 notitle, \
     table using (row(5)):8 with points lt 5 notitle, \
     keyentry with linespoints lt 5 title "fault, length 1440 (2896 times)", \
     table using (row(6)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 6 dt 1 lw 0.8 notitle, \
     table using (row(6)):8 with points lt 6 notitle, \
     keyentry with linespoints lt 6 title "fault, length 1890 (3306 times)", \
     [0.19952623149688789:2511.8864315095848] '+' using 1:(0.017550926644401815*$1**(-0.39513175237596698)*exp(-$1**(1)/418.83065690219149)) with lines lt 1 dt 1 lw 1.6 notitle, \
     [0.19952623149688789:1584.8931924611163] '+' using 1:(0.055384237583145847*$1**(-0.68100512133871072)*exp(-$1**(1)/342.84864122166738)) with lines lt 2 dt 3 lw 2 notitle, \
     [0.19952623149688789:1258.9254117941693] '+' using 1:(0.024319980640924214*$1**(-0.30901100886529576)*exp(-$1**(1)/146.18245088611596)) with lines lt 3 dt 3 lw 2 notitle, \
     [0.19952623149688789:630.95734448019425] '+' using 1:(0.041489383091198047*$1**(-0.38298331077594339)*exp(-$1**(1)/94.994396794742244)) with lines lt 4 dt 3 lw 2 notitle, \
     [0.19952623149688789:501.18723362727303] '+' using 1:(0.044990466305443039*$1**(-0.35603481211293919)*exp(-$1**(1)/73.513934068348277)) with lines lt 5 dt 3 lw 2 notitle, \
     [0.19952623149688789:398.10717055349784] '+' using 1:(0.045753020809317244*$1**(-0.3181716254485788)*exp(-$1**(1)/60.82806585704737)) with lines lt 6 dt 3 lw 2 notitle, \
     keyentry with lines lt 8 dt 1 lw 1.6 title "fit not rejected", \
     keyentry with lines lt 8 dt 3 lw 2 title "fit rejected (p < 0.05)"
unset output
}
