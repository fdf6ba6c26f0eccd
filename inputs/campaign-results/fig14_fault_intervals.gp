# Draws fig14_fault_intervals.png and fig14_fault_intervals.svg from fig14_fault_intervals.csv: run `gnuplot fig14_fault_intervals.gp` in this folder.
base = 'fig14_fault_intervals'
table = base.".csv"
if (!exists("formats")) formats = "png svg"

do for [format in formats] {
if (format eq "png") {
point = 1.0
set terminal pngcairo size 1800,1330 enhanced font "DejaVu Sans,26" linewidth 2 pointscale 2 background "#ffffff"
} else {
point = 0.65
set terminal svg size 900,665 dynamic enhanced font "DejaVu Sans,13" background "#ffffff"
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
set xlabel 'inter-event time θ (model time units)'
set logscale x
set format x "10^{%L}"
set xtics 10
set mxtics 10
set xrange [1:1000]
set ylabel 'probability density f(θ) (1 / model time)'
set logscale y
set format y "10^{%L}"
set ytics 10
set mytics 10
set yrange [9.9999999999999995e-07:0.01]
row(k) = $1 == k && $7 > 0 ? $6 : NaN
low(y, e) = y - e > 0.1 * y ? y - e : 0.1 * y
set samples 400
plot table using (row(1)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 1 dt 1 lw 0.8 notitle, \
     table using (row(1)):8 with points lt 1 notitle, \
     keyentry with linespoints lt 1 title 'fault 120 (1563 times)', \
     table using (row(2)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 2 dt 1 lw 0.8 notitle, \
     table using (row(2)):8 with points lt 2 notitle, \
     keyentry with linespoints lt 2 title 'fault 240 (1690 times)', \
     table using (row(3)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 3 dt 1 lw 0.8 notitle, \
     table using (row(3)):8 with points lt 3 notitle, \
     keyentry with linespoints lt 3 title 'fault 480 (unfinished, step 4950000 of 10000000) (824 times)', \
     table using (row(4)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 4 dt 1 lw 0.8 notitle, \
     table using (row(4)):8 with points lt 4 notitle, \
     keyentry with linespoints lt 4 title 'fault 945 (unfinished, step 4700000 of 10000000) (965 times)', \
     table using (row(5)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 5 dt 1 lw 0.8 notitle, \
     table using (row(5)):8 with points lt 5 notitle, \
     keyentry with linespoints lt 5 title 'fault 1440 (unfinished, step 1150000 of 10000000) (224 times)', \
     table using (row(6)):(low($8,$9)):(0):($8+$9-low($8,$9)) with vectors heads size screen 0.003,90 lt 6 dt 1 lw 0.8 notitle, \
     table using (row(6)):8 with points lt 6 notitle, \
     keyentry with linespoints lt 6 title 'fault 1890 (unfinished, step 1700000 of 10000000) (314 times)', \
     [25.11886431509582:794.32823472428277] '+' using 1:(0.001023306925361135*$1**(0.48610661240693731)*exp(-$1**(1)/119.6129327173273)) with lines lt 1 notitle, \
     [10.000000000000005:1000.0000000000017] '+' using 1:(0.00046401850899699024*$1**(0.70980668345333053)*exp(-$1**(1)/97.806403214375123)) with lines lt 2 notitle, \
     [7.9432823472428193:794.32823472428277] '+' using 1:(0.00063628308833446341*$1**(0.62114725933345105)*exp(-$1**(1)/105.05046794115633)) with lines lt 3 notitle, \
     [7.9432823472428193:630.95734448019425] '+' using 1:(2.1866441721361518e-05*$1**(2.3484269009445149)*exp(-$1**(0.54166120161593667)/2.2514103807981662)) with lines lt 4 notitle, \
     [10.000000000000005:794.32823472428277] '+' using 1:(9.2683117634707822e-05*$1**(1.1663475012785169)*exp(-$1**(1)/70.118041797638654)) with lines lt 5 notitle, \
     [10.000000000000005:1000.0000000000017] '+' using 1:(0.0010505444703560955*$1**(0.55087857059117962)*exp(-$1**(1)/94.973931310818827)) with lines lt 6 notitle, \
     keyentry with lines lt 8 title 'lines: fitted generalised gamma'
unset output
}
