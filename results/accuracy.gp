# Draws accuracy_fault.png and accuracy_slider.png from accuracy_fault.csv and accuracy_slider.csv
set datafile separator ","
set encoding utf8
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid xtics ytics lt 1 lw 0.5 lc rgb "#d8d8d8"
set linetype 1 lc rgb "#0072B2" pt 7 dt 1
set linetype 2 lc rgb "#D55E00" pt 5 dt 2
set linetype 3 lc rgb "#009E73" pt 9 dt 3
set linetype 4 lc rgb "#CC79A7" pt 11 dt 4
set logscale xy
set format "10^{%L}"
set terminal pngcairo size 1500,960 enhanced font "DejaVu Sans,20" linewidth 2 pointscale 2 background "#ffffff"
set key below center maxrows 2 samplen 2 spacing 1.1
# rows of FILE that meet an awk condition
rows(file, condition) = sprintf("< awk -F, '!/^#/ && NR > 1 && (%s)' %s", condition, file)

set output "accuracy_fault.png"
set title "Fault, one event: error of its size (time steps beside the points)"
set xlabel "CPU time (s)" offset 0,0.4
set ylabel "relative error of the event size" offset 0.5
set xrange [0.04:10]
set yrange [5e-6:1e-2]
fault(method) = rows("accuracy_fault.csv", sprintf("$1 == \"standard\" && $4 == \"%s\"", method))
plot fault("located") using 6:8 with linespoints lt 1 title "onset located", \
  "" using 6:8:(sprintf("%g", $5)) with labels right offset -0.7,0.5 font ",15" tc lt 1 notitle, \
  fault("step") using 6:8 with linespoints lt 2 title "onset at the end of the step", \
  "" using 6:8:(sprintf("%g", $5)) with labels left offset 0.8,-0.4 font ",15" tc lt 2 notitle, \
  fault("force") using 6:8 with linespoints lt 3 title "viscosity as a force", \
  "" using 6:8:(sprintf("%g", $5)) with labels left offset 0.8,0.4 font ",15" tc lt 3 notitle
set output

set output "accuracy_slider.png"
set title "Block-slider, one event: slip profile (time steps beside the points)"
set xlabel "run time (s)" offset 0,0.4
set ylabel "largest error of the slip / largest slip" offset 0.5
set xrange [1e-5:2e-2]
set yrange [1e-10:1e1]
slider(scheme) = rows("accuracy_slider.csv", sprintf("$1 == \"%s\"", scheme))
scheme = "printed semi-implicit verlet rk4"
array title[4] = ["printed", "semi-implicit Euler", "velocity Verlet", "rk4, located switches"]
plot for [n=1:4] slider(word(scheme, n)) using 3:4 with linespoints lt n title title[n], \
  for [n=1:4] slider(word(scheme, n)) using 3:4:(sprintf("%g", $2)) with labels left offset 0.8,0.4 font ",15" tc lt n notitle
set output
