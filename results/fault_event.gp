# Draws fault_event.png from a picture of fault_image.in (frame), with the scale of its colours: the
# speed of the discs from slowest to fastest, logarithmic, in the upper and in the lower block
if (!exists("frame")) { frame = "look.000214900.png" }
slowest = 0.0003
fastest = 0.004
set terminal pngcairo size 1600,610 font "DejaVu Sans,16" background "#ffffff"
set output "fault_event.png"
set multiplot
set lmargin at screen 0
set rmargin at screen 1
set bmargin at screen 150./610
set tmargin at screen 1
unset tics
unset border
unset key
unset colorbox
set xrange [0:1599]
set yrange [0:459]
plot frame binary filetype=png with rgbimage
# colours of fault_image.in against the share of the logarithm
mix(s, a, b, p, q) = a + (b - a) * (s - p) / (q - p)
ramp(s, g, c1, c2, c3) = s < 0.01 ? g : s < 0.1 ? mix(s, g, c1, 0.01, 0.1) : s < 0.5 ? mix(s, c1, c2, 0.1, 0.5) : mix(s, c2, c3, 0.5, 1)
red(s, up) = up ? ramp(s, 0.84, 1.00, 0.93, 0.50) : ramp(s, 0.62, 0.60, 0.00, 0.00)
green(s, up) = up ? ramp(s, 0.83, 0.87, 0.35, 0.00) : ramp(s, 0.64, 0.80, 0.30, 0.00)
blue(s, up) = up ? ramp(s, 0.80, 0.35, 0.05, 0.05) : ramp(s, 0.67, 0.97, 0.85, 0.35)
set lmargin at screen 0.25
set rmargin at screen 0.75
set bmargin at screen 75./610
set tmargin at screen 135./610
set border
set xrange [0.0002:fastest]
set logscale x
set xtics ("0.0003" slowest, "0.0005" 0.0005, "0.001" 0.001, "0.002" 0.002, "0.004" fastest)
set xlabel "speed of the discs (model units; grey: below 0.0003), above: upper block, below: lower block" offset 0,0.3
set yrange [-0.5:1.5]
unset ytics
share(x) = log(x / slowest) / log(fastest / slowest)
set samples 300
set style fill solid noborder
N = 300
x(i) = 0.0002 * (fastest / 0.0002)**(real(i) / N)
plot for [up=0:1] "+" using (x(column(0))):(up):(x(column(0))):(x(column(0) + 1)):(up - 0.5):(up + 0.5):(int(255 * red(share(x(column(0))), up)) * 65536 \
  + int(255 * green(share(x(column(0))), up)) * 256 + int(255 * blue(share(x(column(0))), up))) with boxxyerror lc rgb variable notitle
unset multiplot
set output
