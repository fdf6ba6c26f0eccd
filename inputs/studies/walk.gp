# Draws walk.png and walk.svg from walk.csv (results/walk.py)
set datafile separator ","
set datafile columnheaders
if (!exists("table")) { table = "walk.csv" }
do for [kind in "png svg"] {
if (kind eq "png") { set terminal pngcairo size 1800,760 font "DejaVu Sans,20" linewidth 2 pointscale 2 background "#ffffff" } \
else { set terminal svg name "walk" size 900,380 dynamic font "DejaVu Sans,10" background "#ffffff" }
set output "walk.".kind
set encoding utf8
set border lw 1.0 lc rgb "#333333"
set tics out nomirror
set grid ytics lt 1 lw 0.5 lc rgb "#d8d8d8"
is(s, name) = s eq name || s eq "ruptures-".name
place(s) = is(s, "chain-512") ? 1 : is(s, "bulk-512") ? 2 : is(s, "radiating-512") ? 3 : is(s, "rough-512") ? 4 : is(s, "slow-512") ? 5 : is(s, "fault-viscous") ? 6 : is(s, "fault-weakening") ? 7 : is(s, "fault") ? 8 : NaN
drops(s) = strstrt(s, "ruptures") ? NaN : place(s)
local(s) = strstrt(s, "ruptures") ? place(s) : NaN
set xrange [0.5:8.5]
set xtics ("springs" 1, "+ elastic blocks" 2, "+ radiation" 3, "+ roughness" 4, "+ slow plate" 5, "fault, viscous" 6, "fault, weakening" 7, "fault" 8) rotate by 40 right font kind eq "png" ? ",17" : ",9"
set multiplot layout 1,3 margins 0.055,0.99,0.42,0.91 spacing 0.065,0
set key at graph 0.5,-0.5 center top vertical maxrows 2 samplen 1
set title "Exponent of the sizes, per decade"
set yrange [-0.3:2]
plot table using (drops(strcol("station"))-0.15):"exponent_-1":"exponent_-1_error" with yerrorbars pt 4 lc rgb "#999999" title "0.1 to 1", \
  "" using (drops(strcol("station"))-0.05):"exponent_0":"exponent_0_error" with yerrorbars pt 7 lc rgb "#56B4E9" title "1 to 10", \
  "" using (drops(strcol("station"))+0.05):"exponent_1":"exponent_1_error" with yerrorbars pt 9 lc rgb "#0072B2" title "10 to 100", \
  "" using (drops(strcol("station"))+0.15):"exponent_2":"exponent_2_error" with yerrorbars pt 5 lc rgb "#000000" title "100 to 1000"
set title "γ of the inter-event times"
set yrange [-1:5]
plot table using (drops(strcol("station"))-0.1):"gamma_0":"gamma_0_error" with yerrorbars pt 7 lc rgb "#56B4E9" title "events ≥ 1", \
  "" using (drops(strcol("station"))):"gamma_1":"gamma_1_error" with yerrorbars pt 9 lc rgb "#0072B2" title "≥ 10", \
  "" using (drops(strcol("station"))+0.1):"gamma_2":"gamma_2_error" with yerrorbars pt 5 lc rgb "#000000" title "≥ 100"
set title "Share of small events"
set key maxrows 4
set yrange [0:0.7]
plot table using (drops(strcol("station"))-0.15):"small":"small_error" with yerrorbars pt 7 lc rgb "#56B4E9" title "drops < 1", \
  "" using (drops(strcol("station"))-0.05):"short":"short_error" with yerrorbars pt 9 lc rgb "#0072B2" title "drops of 1 to 3 blocks", \
  "" using (local(strcol("station"))+0.05):"local":"local_error" with yerrorbars pt 4 lc rgb "#999999" title "ruptures of 1 to 3, ≥ 0.01", \
  "" using (local(strcol("station"))+0.15):"local_10":"local_10_error" with yerrorbars pt 5 lc rgb "#D55E00" title "≥ 0.1"
unset multiplot
set output
}
