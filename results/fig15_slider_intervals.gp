# Draws fig15_slider_intervals.png and fig15_slider_intervals.svg from
# fig15_slider_intervals.csv: run `gnuplot ./fig15_slider_intervals.gp` in this folder.
base = "./fig15_slider_intervals"
table = base.".csv"
if (!exists("formats")) formats = "png svg"

do for [format in formats] {
if (format eq "png") {
point = 1.0
set terminal pngcairo size 1800,1146 enhanced font "DejaVu Sans,26" linewidth 2 pointscale 2 background "#ffffff"
} else {
point = 0.65
set terminal svg size 900,573 dynamic enhanced font "DejaVu Sans,13" background "#ffffff"
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
set yrange [1e-08:1]
row(k) = $1 == k && $7 > 0 ? $6 : NaN
low(y, e) = y - e > 0.1 * y ? y - e : 0.1 * y
set samples 400
plot table using (row(1)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 1 dt 1 lw 0.8 notitle, \
     table using (row(1)):8 with points lt 1 notitle, \
     keyentry with linespoints lt 1 title "block-slider, N = 256 (1459 times)", \
     table using (row(2)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 2 dt 1 lw 0.8 notitle, \
     table using (row(2)):8 with points lt 2 notitle, \
     keyentry with linespoints lt 2 title "block-slider, N = 614 (2483 times)", \
     table using (row(3)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 3 dt 1 lw 0.8 notitle, \
     table using (row(3)):8 with points lt 3 notitle, \
     keyentry with linespoints lt 3 title "block-slider, N = 972 (3918 times)", \
     table using (row(4)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 4 dt 1 lw 0.8 notitle, \
     table using (row(4)):8 with points lt 4 notitle, \
     keyentry with linespoints lt 4 title "block-slider, N = 1450 (5413 times)", \
     table using (row(5)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 5 dt 1 lw 0.8 notitle, \
     table using (row(5)):8 with points lt 5 notitle, \
     keyentry with linespoints lt 5 title "block-slider, N = 1928 (8231 times)", \
     [16.685738519533928:7943.2823472428327] '+' using 1:(0.43663824965165882*$1**(-1.4022731744490455)*exp(-$1**(1)/33953.439663680248)) with lines lt 1 dt 3 lw 2 notitle, \
     [9.7943596455900135:7943.2823472428327] '+' using 1:(1.4036383032572388*$1**(-1.6365026197315311)*exp(-$1**(1)/74038.400814570909)) with lines lt 2 dt 3 lw 2 notitle, \
     [6.1891302960694237:6309.5734448019457] '+' using 1:(1.8521852139304871*$1**(-1.7264396353308995)*exp(-$1**(1)/79432.712977448027)) with lines lt 3 dt 3 lw 2 notitle, \
     [4.4866557361906514:6309.5734448019457] '+' using 1:(1.6350634634224743*$1**(-1.7068179475360381)*exp(-$1**(1)/25208.405727912843)) with lines lt 4 dt 3 lw 2 notitle, \
     [2.9607517312598715:5011.8723362727333] '+' using 1:(1.0890113602003622*$1**(-1.6081958711699045)*exp(-$1**(1)/3945.1306308444869)) with lines lt 5 dt 3 lw 2 notitle, \
     keyentry with lines lt 8 dt 3 lw 2 title "fit rejected (p < 0.05)"
unset output
}
