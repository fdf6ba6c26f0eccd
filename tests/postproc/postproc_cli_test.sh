#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Tests of postproc from outside: postproc_cli_test.sh PROGRAM CASE [SLIDER_CLI]
export LC_ALL=C
slider=${3:-}
# shellcheck source=tests/postproc/postproc_shell.sh
source "$(dirname "${BASH_SOURCE[0]}")/postproc_shell.sh" "$1"

# series FILE [ROWS]: loading with drops, and the same as text, FILE.txt
series() {
  awk -v rows="${2:-5000}" 'BEGIN {
    print "# model = lsm\n# dt = 0.03\n# step0 = 0\n# time0 = 0\n# stride = 1"
    print "# length = 40\n# picker = literal\n# lambda = 0.5\n# min_size = 0\nstep,time,pe"
    pe = 1
    for (i = 0; i < rows; i++) {
      printf "%d,%.17g,%.17g\n", i, i * 0.03, pe
      pe += i % 97 < 80 ? 1e-3 * (1 + i % 7) : -2e-3 * (1 + i % 11)
    }
  }' > "$1.txt"
  packed < "$1.txt" > "$1"
}

# What the picker has to find, written a second time in awk: reference READING LAMBDA MIN FILE
reference() {
  awk -F, -v reading="$1" -v lambda="$2" -v least="$3" '
    /^#/ || /^step/ { next }
    n++ {
      x = $3 - pe
      if (reading == "exponential") a = lambda * a + (1 - lambda) * x
      if (reading == "average") a = (x + lambda * a) / (1 + lambda)
      if (reading == "literal") a = (x + lambda * a) / (1 + lambda * (n - 2))
      if (!open && a < 0) { open = 1; s0 = step; t0 = time; p0 = pe }
      else if (open && a > 0) {
        open = 0
        if (p0 - pe > 0 && p0 - pe >= least)
          printf "%d,%.17g,%.17g,%d,%d,%.17g,%.17g,%.17g\n", ++id, t0, time, s0, step, p0 - pe, p0, pe
      }
    }
    { step = $1; time = $2; pe = $3 }' "$4"
}
rows() { grep -v '^[#e]' "$1"; }

# catalogue FILE: five events with a centroid, one of negative size
catalogue() {
  {
    printf '# lsm-catalogue 1\n# model = lsm\n# length = 40\n'
    echo event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end,slip_moment,x_centroid
    echo 1,0,1.5,0,50,1,2,1,3,10
    echo 2,2,3,60,90,0.001,2,1.999,3,20
    echo 3,86400.25,86401,100,190,1000,2000,1000,3,30
    echo 5,86402,86403,200,290,-1,2,3,3,40
    echo 6,86404.0000005,86405,300,390,1e-6,2,2,3,0
  } > "$1"
}

case $2 in
pick)
  series pe.bin
  for setting in "exponential 0.99 0" "exponential 0.9 0.01" "average 0.99 0" "literal 0.99 0.02"; do
    read -r reading lambda least <<< "$setting"
    must_run pick pe.bin -o picked.csv --force --picker "$reading" --lambda "$lambda" --min-size "$least"
    reference "$reading" "$lambda" "$least" pe.bin.txt > expected
    [ "$(wc -l < expected)" -ge 10 ] || fail "too few events to test anything: $setting"
    rows picked.csv | diff - expected > /dev/null || fail "$setting: not the events of the reference"
    grep -q "^# picker = $reading$" picked.csv && grep -q "^# lambda = $lambda$" picked.csv ||
      fail "$setting: header does not say so"
  done
  # What is not given comes from the header of the series; its parameters are carried over.
  must_run pick pe.bin -o picked.csv --force
  reference literal 0.5 0 pe.bin.txt | diff - <(rows picked.csv) > /dev/null || fail "settings of the header not used"
  # dt stands where the run has it.
  sed 's/^# length = 40/&\n# viscosity = 0.1/' pe.bin.txt | packed > fault.bin
  must_run pick fault.bin -o fault_picked.csv
  [ "$(grep -A 1 '^# dt' fault_picked.csv | tail -n 1)" = "# viscosity = 0.1" ] || fail "$(head -n 9 fault_picked.csv)"
  grep -q '^# length = 40$' picked.csv && grep -q '^# dt = 0.029999999999999999$' picked.csv ||
    fail "parameters are not carried over"
  # Memory in time; lambda = exp(-0.03/3)
  must_run pick pe.bin -o a.csv --picker exponential --memory-time 3
  grep -q '^# lambda = 0.99004983374916' a.csv || fail "--memory-time gives $(grep lambda a.csv)"
  # Warm-up: identifiers begin with 1 behind it.
  must_run pick pe.bin -o c.csv --warmup 75
  reference literal 0.5 0 pe.bin.txt | awk -F, '$2 >= 75' | cut -d, -f2- | diff - <(rows c.csv | cut -d, -f2-) > /dev/null ||
    fail "--warmup 75"
  [ "$(rows c.csv | head -n 1 | cut -d, -f1)" = 1 ] || fail "identifiers with --warmup"
  # Completeness: carried over.
  grep -q completeness c.csv && fail "completeness that nobody gave"
  sed 's/^# length/# completeness = 0.002\n&/' pe.bin.txt | packed > known.bin
  must_run pick known.bin -o e.csv
  grep -q '^# completeness = 0.002$' e.csv || fail "completeness of the series is lost: $(grep '^#' e.csv)"
  sed 's/^# length/# completeness = small\n&/' pe.bin.txt | packed > known.bin
  refused "known.bin: completeness is 'small', expected a finite size of at least 0" pick known.bin -o x.csv
  # The catalogue is one that the other commands read.
  must_run export c.csv -o table.csv
  # An older file stays unless --force is given; nothing is left of a series that ends badly.
  cp c.csv before
  refused "c.csv: exists already" pick pe.bin -o c.csv
  sed '4000s/,[^,]*$/,nan/' pe.bin.txt | packed > bad.bin
  refused "bad.bin: record 3990: pe is not finite, expected a finite number" pick bad.bin -o new.csv
  refused "bad.bin: record 3990: pe is not finite, expected a finite number" pick bad.bin -o c.csv --force
  cmp c.csv before || fail "an older catalogue was touched"
  head -c -5 pe.bin > torn.bin
  refused "torn.bin: truncated record 5000 at the end" pick torn.bin -o new.csv
  must_run pick torn.bin -o new.csv --lenient
  grep -q "torn.bin: dropped a truncated last sample: 1" err.txt || fail "a repair is not stated"
  refused "is read by this command" pick pe.bin -o ./pe.bin --force
  refused "lambda = 1, expected at least 0 and less than 1" pick pe.bin -o x.csv --lambda 1
  sed 's/^# lambda = .*/# lambda = 1.5/' pe.bin.txt | packed > leaky.bin
  refused "lambda in the header of the series is 1.5, expected at least 0" pick leaky.bin -o x.csv
  refused "memory-time with the reading 'literal', expected 'exponential'" pick pe.bin -o x.csv --memory-time 3
  refused "lambda excludes" pick pe.bin -o x.csv --memory-time 10 --lambda 0.5
  refused "min-size = -1, expected a finite size of at least 0" pick pe.bin -o x.csv --min-size -1
  refused "picker = .median., expected exponential, average or literal" pick pe.bin -o x.csv --picker median
  ;;
online)
  # The same rows as the program that ran picked, from its series.
  [ -x "$slider" ] || exit 77
  for picker in exponential literal; do
    "$slider" --overwrite --blocks 100 --dt 0.05 --velocity 0.05 --warmup 300 --steps 300000 --picker $picker \
      --catalogue online.csv --pe-series pe > /dev/null || fail "slider_cli"
    must_run pick pe -o picked.csv --force
    rows online.csv | cut -d, -f1-8 > expected
    [ "$(wc -l < expected)" -ge 10 ] || fail "too few events to test anything"
    rows picked.csv | cmp - expected || fail "$picker: not the same rows"
    diff <(grep '^#' online.csv | sort) <(grep '^#' picked.csv | grep -v picked_by | sort) > /dev/null ||
      fail "$picker: headers differ"
  done
  ;;
series)
  series pe.bin
  must_run series pe.bin -o all --no-picture --picker exponential --lambda 0.9 --columns 600
  # 5000 samples in groups of 8, as 4 would make more than 2 x 600: 2 rows for each, the extremes among them.
  [ "$(grep -vc '^[#t]' all.csv)" = 1250 ] || fail "$(grep -vc '^[#t]' all.csv) rows, expected 1250"
  extremes() { sort -g | sed -n '1p;$p'; }
  [ "$(grep -v '^[#t]' all.csv | cut -d, -f2 | extremes)" = "$(grep -v '^[#s]' pe.bin.txt | cut -d, -f3 | extremes)" ] ||
    fail "an extreme is lost"
  reference exponential 0.9 0 pe.bin.txt | cut -d, -f2,3,7,8,6 > expected
  grep -v '^[#t]' all-events.csv | awk -F, '$5 != "" { print $1 "," $2 "," $5 "," $3 "," $4 }' |
    diff - expected > /dev/null || fail "not the events of the reference"
  # Few samples are there one by one; the smoothed change has the memory of what was before.
  must_run series pe.bin -o part --no-picture --from 30 --to 60 --picker exponential --lambda 0.9
  awk -F, '/^[#s]/ { next } n++ { x = $3 - pe; a = 0.9 * a + (1 - 0.9) * x } { pe = $3 }
    $2 >= 30 && $2 <= 60 { printf "%.17g,%.17g,%.17g,%.17g\n", $2, $3, x, a }' pe.bin.txt > expected
  [ "$(wc -l < expected)" -gt 900 ] && grep -v '^[#t]' part.csv | diff - expected > /dev/null || fail "window"
  if command -v gnuplot > /dev/null; then
    must_run series pe.bin -o drawn --from 30 --to 60
    for extension in png svg gp csv; do [ -s drawn.$extension ] || fail "no drawn.$extension"; done
    [ -s drawn-events.csv ] || fail "no drawn-events.csv"
    grep -q '</svg>' drawn.svg || fail "the SVG is not whole"
    # A window without an event, too.
    must_run series pe.bin -o quiet --from 0 --to 1
    [ -s quiet.svg ] || fail "no picture without events"
  fi
  # As text: the samples of the window, to the last digit.
  must_run series pe.bin -o part --no-picture --from 30 --to 60 --export part-samples.csv
  grep '^#' part-samples.csv | diff - <(echo '# PE series'; sed -n 's|= 0.03$|= 0.029999999999999999|; /^# .* = /p' pe.bin.txt) ||
    fail "header of the samples: $(head -n 12 part-samples.csv)"
  awk -F, '/^s/ || (!/^#/ && $2 >= 30 && $2 <= 60)' pe.bin.txt | cmp - <(grep -v '^#' part-samples.csv) || fail "--export"
  refused "is read by this command" series pe.bin --no-picture -o x --export pe.bin
  refused "expected --from before --to" series pe.bin --from 5 --to 5 --no-picture -o x
  refused "pe.bin: 0 samples in the window of time, expected at least 3" series pe.bin --from 1e6 -o x
  refused "columns" series pe.bin --columns 2 -o x
  ;;
spectrum)
  # A sine of amplitude 2 and period 25.6 steps of 0.5: variance 2, frequency 1/12.8
  awk 'BEGIN {
    print "# model = lsm\n# dt = 0.5\n# step0 = 0\n# time0 = 0\n# stride = 1\nstep,time,pe"
    for (i = 0; i < 4096; i++) printf "%d,%.17g,%.17g\n", i, i * 0.5, 5 + 2 * sin(8 * atan2(1, 1) * i / 25.6) }' > sine.txt
  packed < sine.txt > sine
  must_run spectrum sine --segment 1024 --per-decade 0 --no-picture -o sine_spectrum
  awk -F, '/^[#c]/ { next } { v += $4 * $5; if ($5 > big) { big = $5; at = $3 } }
    END { exit !(v > 1.999 && v < 2.001 && at > 0.07812 && at < 0.07813) }' sine_spectrum.csv || fail "variance or frequency"
  told ' sine 4096 7 ' || fail "segments: $(cat out.txt)"
  # Without a length: an eighth of 4096, from a pipe, too.
  must_run spectrum sine --no-picture -o usual
  told ' sine 4096 15 ' || fail "segments: $(cat out.txt)"
  cp usual.csv file.csv
  must_run spectrum <(cat sine) --label sine --no-picture -o usual
  cmp usual.csv file.csv || fail "another spectrum from a pipe"
  if command -v gnuplot > /dev/null; then
    must_run spectrum sine sine --label one --label 'two & <2>' -o drawn
    for extension in png svg gp csv; do [ -s drawn.$extension ] || fail "no drawn.$extension"; done
  fi
  refused "4096 samples in the window of time, expected at least one segment of 8192" spectrum sine --segment 8192 -o x
  sed '99d' sine.txt | packed > gap
  refused "gap: step 93 after step 91, expected a sample every 1 steps" spectrum gap -o x
  refused "label given 1 times, expected once per series (2)" spectrum sine sine --label a -o x
  ;;
compare)
  # Times of 4 and 6, sizes 1 to 7; the same with other numbers; times twice as long; few events.
  made() { # NAME TIME COUNT [SHIFT]
    awk -v time="$2" -v count="$3" -v shift="${4:-0}" 'BEGIN {
      print "# lsm-catalogue 1\n# model = lsm\n# length = 120"
      print "event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end"
      for (i = 1; i <= count; i++) {
        t += time * (0.8 + 0.4 * (int((i + shift) * 0.618034 * 7) % 2)); s = 1 + (i + shift) * 11 % 7
        printf "%d,%g,%g,%d,%d,%g,10,%g\n", i, t, t + 1, 10 * i, 10 * i + 1, s, 10 - s } }' > "$1"
  }
  made a.csv 5 400; made b.csv 5 300 3; made c.csv 10 300 3; made few.csv 5 9
  must_run compare a.csv b.csv c.csv -o d
  told 'size 400 300 .*no difference seen$' || fail "$(cat out.txt)"
  [ "$(grep -c 'no difference seen' out.txt) $(grep -c 'they differ' out.txt)" = "3 1" ] || fail "$(cat out.txt)"
  told 'time 399 299 .* 2.0[0-9]* +- [0-9.]* 1 (5.0 +- 5.0)e-04 .*they differ' || fail "$(cat out.txt)"
  [ "$(grep -vc '^#' d.csv)" = 5 ] || fail "$(cat d.csv)"
  cp d.csv before.csv
  must_run compare a.csv b.csv c.csv -o d
  cmp d.csv before.csv || fail "not the same twice"
  # Times twice as long have the same form.
  made twice.csv 10 400
  must_run compare a.csv twice.csv --rescale -o d
  [ "$(grep -c 'no difference seen' out.txt)" = 2 ] || fail "--rescale: $(cat out.txt)"
  # Half the velocity, so twice the time for the same way.
  for velocity in 0.5 -1; do
    f=a.csv; [ "$velocity" = -1 ] || f=c.csv
    sed "s/^# length.*/&\n# velocity = $velocity/" "$f" > "way$velocity.csv"
  done
  must_run compare way-1.csv way0.5.csv --displacement --from 250 --to 1250 -o d
  [ "$(grep -c 'no difference seen' out.txt) $(grep -c 'they differ' out.txt)" = "2 0" ] || fail "$(cat out.txt)"
  told 'time 199 199 .* 1.0[0-9]* ' || fail "$(cat out.txt)"
  refused 'a.csv: no velocity in the header, expected' compare a.csv c.csv --displacement -o x
  sed 's/velocity = .*/velocity = 0/' way-1.csv > rest.csv
  refused 'rest.csv: velocity = 0 in the header, expected' compare rest.csv c.csv --displacement -o x
  refused 'one catalogue, expected at least two' compare a.csv -o x
  refused 'few.csv: sizes: two-sample test of 9 values' compare a.csv few.csv -o x
  refused 'no such file\|cannot open' compare a.csv none.csv -o x
  ;;
export)
  catalogue c.csv
  must_run export c.csv -o s.csv
  grep -q "^4 events; left out: 0 of size <= 0" out.txt || fail "counts: $(cat out.txt)"
  cat > expected << 'END'
longitude,latitude,depth,time,magnitude,event_id,catalog_id,duration,size
0,0,0,2000-01-01T00:00:00.000000,0,1,0,1.5,1
0,0,0,2000-01-01T00:00:02.000000,-2,2,0,1,0.001
0,0,0,2000-01-02T00:00:00.250000,2,3,0,0.75,1000
0,0,0,2000-01-02T00:00:04.000001,-4,6,0,0.9999995,1e-06
END
  sed 's/0.9999994999[0-9]*/0.9999995/; s/0.9999995000[0-9]*/0.9999995/' s.csv | diff - expected || fail "seismostats"
  must_run export c.csv -o p.csv --format csep --magnitude-constant 4.5 --time-unit day --start-date 1999-12-31T12:00:00 \
    --degrees-per-length 0.5 --to 1000 --min-size -10
  cat > expected << 'END'
lon,lat,mag,time_string,depth,catalog_id,event_id
5,0,4.5,1999-12-31T12:00:00.000000,0,0,1
10,0,2.5,2000-01-02T12:00:00.000000,0,0,2
END
  diff p.csv expected || fail "csep"
  must_run export c.csv c.csv -o two.csv --min-size -10
  grep -q "^8 events; left out: 2 of size <= 0" out.txt || fail "two catalogues: $(cat out.txt)"
  [ "$(cut -d, -f7 two.csv | sort | uniq -c | tr -s ' ' | tr '\n' ';')" = " 4 0; 4 1; 1 catalog_id;" ] || fail "catalog_id"
  refused "s.csv: exists already" export c.csv -o s.csv
  refused "event 3 starts at time 86400.25, a date outside the years 1700 to 2261" export c.csv -o x.csv --time-unit year
  for date in 2000-13-01 2001-02-29 yesterday 2000-01-01T12; do
    refused "start-date '$date': expected a date" export c.csv -o x.csv --start-date $date
  done
  refused "time-unit" export c.csv -o x.csv --time-unit -1
  sed 's/,[^,]*$//; s/,slip_moment//' c.csv | sed 's/\(,pe_end\).*/\1,slip_moment/' > plain.csv
  refused "plain.csv: has no column x_centroid" export plain.csv -o x.csv --degrees-per-length 1
  ;;
magnitudes)
  # Sizes 10^(-3 + 3 q) for magnitudes from -2 on, exponential with b = 1: M = -2 - log10(1 - q), evenly spaced q.
  awk 'BEGIN {
    print "# lsm-catalogue 1\n# model = lsm\n# length = 40\n# completeness = 1e-3"
    print "event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end,slip_moment"
    for (i = 0; i < 2000; i++) {
      k = (i * 7919) % 2000
      m = -2 - log(1 - (k + 0.5) / 2000) / log(10)
      printf "%d,%d,%d,%d,%d,%.17g,1,1,%.17g\n", i + 1, 2 * i, 2 * i + 1, 2 * i, 2 * i + 1, 10 ^ (1.5 * m), 10 ^ m }
  }' > gr.csv
  must_run magnitudes gr.csv -o m --no-picture
  awk -F, '/^lsm/ { n++; if (!($4 == 2000 && $2 == -2 && $5 > 0.99 && $5 < 1.01 && $6 > 0.018 && $6 < 0.026)) exit 1 }
    END { exit n != 1 }' m.bvalues.csv || fail "b: $(cat m.bvalues.csv)"
  grep -q 'M = 0.6667 log10(size) + 0, bins of 0 (0: none)' out.txt && grep -q 'completeness in the header of gr.csv' out.txt &&
    told 'exponent of the sizes 1 + 0.6667 b 1.66' || fail "$(cat out.txt)"
  # The same b of the table that is exported, by the textbook's formula: with and without bins.
  for bin in 0 0.1; do
    must_run magnitudes gr.csv -o m --no-picture --magnitude-bin $bin --complete-from -1.5
    must_run export gr.csv -o table.csv --force --magnitude-bin $bin
    awk -F, -v w=$bin 'FNR > 1 && FILENAME == "table.csv" && $5 >= -1.5 - w / 2 - 1e-9 { sum += $5 + 1.5; ++n }
      FILENAME == "m.bvalues.csv" && /^lsm/ { b = $5; found = $4 }
      END { mean = sum / n; want = w ? log(1 + w / mean) / (w * log(10)) : 1 / (mean * log(10))
        exit !(n == found && b / want > 1 - 1e-12 && b / want < 1 + 1e-12) }' table.csv m.bvalues.csv ||
      fail "bins of $bin: $(cat m.bvalues.csv)"
  done
  # The smallest size that a magnitude begins with is given, found, or that of the header.
  must_run magnitudes gr.csv -o m --no-picture --complete-from curvature
  awk -F, '/^lsm/ && !($2 > -1.91 && $2 < -1.69 && $2 == $3) { exit 1 }' m.bvalues.csv || fail "curvature: $(cat m.bvalues.csv)"
  must_run magnitudes gr.csv -o m --no-picture --threshold 0.01
  awk -F, '/^lsm/ && !($2 > -1.3334 && $2 < -1.3333) { exit 1 }' m.bvalues.csv || fail "--threshold: $(cat m.bvalues.csv)"
  # Of the moment, and as plain logarithm.
  must_run magnitudes gr.csv -o m --no-picture --magnitude-of moment --magnitude-slope 1 --complete-from -2
  awk -F, '/^lsm/ && !($5 > 0.99 && $5 < 1.01) { exit 1 }' m.bvalues.csv || fail "moment: $(cat m.bvalues.csv)"
  grep -q 'M = 1 log10(slip_moment) + 0' out.txt || fail "$(cat out.txt)"
  [ "$(awk -F, '!/^[#c]/ { n += $4 } END { print n }' m.csv)" = 2000 ] || fail "counts: $(cat m.csv)"
  refused "header holds for sizes only, expected 'curvature' or a magnitude" magnitudes gr.csv -o x --magnitude-of moment
  refused "complete-from 'nowhere', expected 'header', 'curvature' or a magnitude" magnitudes gr.csv -o x --complete-from nowhere
  refused "magnitude-slope: Value 0 not in range" magnitudes gr.csv -o x --magnitude-slope 0
  refused "magnitude-bin: expected a number of 0 or more, not '-1'" magnitudes gr.csv -o x --magnitude-bin -1
  sed 's/,[^,]*$//; s/,slip_moment//' gr.csv > plain.csv
  refused "plain.csv: has no column slip_moment, expected one for --magnitude-of moment" magnitudes plain.csv -o x --magnitude-of moment --complete-from -2
  refused "plain.csv: has no column slip_moment" export plain.csv -o x.csv --magnitude-of moment
  ;;
aftershocks)
  # 42 main shocks 5000 apart, the first of which has no time before it, each followed by 50 events at t = 2 (1 / (1 - q) - 1), which is p = 2 with c = 2, and 50 evenly.
  awk 'BEGIN {
    print "# lsm-catalogue 1\n# model = lsm\n# length = 40"
    print "event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end"
    for (m = 0; m < 42; m++) {
      printf "%.6f 100\n", 5000 * m | "sort -g > rows.txt"
      for (k = 0; k < 50; k++) {
        printf "%.6f 0.01\n", 5000 * m + 10 + 2 * (1 / (1 - (k + (m + 0.5) / 42) / 50) - 1) | "sort -g > rows.txt"
        printf "%.6f 0.01\n", 5000 * m + 10 + 97.3 * (k + (m + 0.5) / 42) | "sort -g > rows.txt" } }
    close("sort -g > rows.txt")
    while ((getline line < "rows.txt") > 0) {
      split(line, f, " ")
      end = f[2] == 100 ? f[1] + 10 : f[1]
      printf "%d,%.6f,%.6f,%d,%d,%s,1,1\n", ++id, f[1], end, id, id, f[2] } }' > omori.csv
  must_run aftershocks omori.csv -o a --no-picture --main-size 50 --window 1000 --replicas 19
  # p = 2, c = 2, K = 100, background 1/97.3
  awk -F, '/^lsm/ { n++; if (!($6 == 41 && $10 > 1.9 && $10 < 2.1 && $12 > 1.7 && $12 < 2.3 && $14 > 75 && $14 < 130 && $16 > 0.0098 &&
    $16 < 0.0108 && $18 > 1000 && $19 == 0.05)) exit 1 } END { exit n != 1 }' a.omori.csv || fail "$(cat a.omori.csv)"
  told '^ smallest main shock 50$' && told '^ largest for so long before and after 1000$' && told '^ main shocks 41$' &&
    told '^ share of Poisson catalogues as large 0.05$' || fail "$(cat out.txt)"
  # Stacked rate: counts in the bins, per main shock and time unit.
  awk -F, '/^1,/ { if ($7 < 0.9999 * $6 / (41 * ($4 - $3)) || $7 > 1.0001 * $6 / (41 * ($4 - $3))) exit 1; ++n }
    END { exit !(n > 8) }' a.csv || fail "$(cat a.csv)"
  must_run aftershocks omori.csv -o a --no-picture --main-size 50 --window 1000 --replicas 0 --hold-c 2
  told '^ c 2$' || fail "$(cat out.txt)"
  # Events at one place in each stretch of 10 have no aftershocks.
  sed 's/^[0-9]*,.*//' omori.csv | sed '/^$/d' > even.csv
  awk 'BEGIN { for (i = 0; i < 5000; i++) { t = 10 * (i + i * 0.618034 % 1)
    printf "%d,%.6f,%.6f,%d,%d,%s,1,1\n", i + 1, t, t, i, i, i % 100 == 50 ? 100 : 0.01 } }' >> even.csv
  must_run aftershocks even.csv -o a --no-picture --main-size 50 --window 300 --replicas 0
  told 'degenerate no decay' || fail "$(cat out.txt)"
  awk -F, '/^lsm/ && !($8 > 0.095 && $8 < 0.101 && $10 == "" && $12 == "") { exit 1 }' a.omori.csv || fail "$(cat a.omori.csv)"
  # By default a share of the events are large enough.
  must_run aftershocks omori.csv -o a --no-picture --replicas 0
  told '^ smallest main shock 0.01$' || fail "$(cat out.txt)"
  refused "no event of size 1000 or larger, expected a smaller --main-size" aftershocks omori.csv -o x --main-size 1000
  refused "first time after main shocks: expected 0 or more, below the window" aftershocks omori.csv -o x --first 20 --window 10
  refused "c held at 0.000000, expected 0 or more (0 needs a first time above 0)" aftershocks omori.csv -o x --hold-c 0 --main-size 50
  refused "excludes --main-s" aftershocks omori.csv -o x --main-size 1 --main-share 0.1
  ;;
compressed)
  # What comes out is the same however the file lies there, whatever its name.
  catalogue events.csv
  series pe.bin
  must_run pick pe.bin -o picked.csv
  must_run export events.csv -o plain.csv
  for way in "gzip -c" "xz -c" "gzip -1c" "xz --check=crc32 -c" "sed s/$/\r/" "printf \\xef\\xbb\\xbf"; do
    for file in events.csv pe.bin; do
      case $way in
      printf*) { $way; cat $file; } > packed-$file ;;
      *) $way < $file > packed-$file ;;
      esac
    done
    must_run export packed-events.csv -o other.csv --force
    cmp plain.csv other.csv || fail "$way: another table"
    must_run histograms packed-events.csv --no-picture -o other
    case $way in
    *z*)
      must_run pick packed-pe.bin -o other.csv --force
      cmp picked.csv other.csv || fail "$way: other events"
      # Two halves compressed one after the other are one file.
      { head -n 7 events.csv | $way; tail -n +8 events.csv | $way; } > halves
      must_run export halves -o other.csv --force
      cmp plain.csv other.csv || fail "$way: halves"
      # Through a pipe.
      must_run export <($way < events.csv) -o other.csv --force
      cmp plain.csv other.csv || fail "$way: pipe"
      ;;
    esac
  done
  for packer in gzip xz; do
    $packer -c events.csv > whole
    head -c -5 whole > torn
    refused "^postproc: torn: truncated $packer file" export torn -o x
    head -c 40 whole > torn
    refused "^postproc: torn: truncated $packer file" histograms torn -o x --lenient
    # A bit within the data or its checksum.
    for at in 60 $(($(stat -c %s whole) - 10)); do
      { head -c "$at" whole; printf '\125'; tail -c +$((at + 2)) whole; } > flipped
      refused "^postproc: flipped: \(damaged\|truncated\) $packer file" export flipped -o x
    done
    head -c -5 pe.bin | $packer > torn
    refused "torn: truncated record 5000" pick torn -o x
    must_run pick torn -o other.csv --force --lenient
    grep -q "dropped a truncated last sample" err.txt || fail "$(cat err.txt)"
  done
  printf 'BZh91AY' > other
  refused "other: compressed by bzip2, expected gzip, xz or a file that is not compressed" export other -o x
  ;;
explore)
  # A run as a simulation leaves it: the catalogue is picked from the series, whose files are found by their names.
  series run.pe.bin
  must_run pick run.pe.bin -o run.catalogue.csv
  must_run explore run.catalogue.csv -o page.html --title 'A < B'
  grep -q 'run.pe.bin: 5000 samples' out.txt || fail "the series was not found: $(cat out.txt)"
  grep -q '<title>A &lt; B</title>' page.html || fail "no title"
  grep -q '"samples":5000' page.html || fail "no samples in the page"
  [ "$(grep -c '^<script type="text/plain"' page.html)" = 2 ] || fail "not the elements of events and series"
  must_run explore run.catalogue.csv --series none -o bare.html
  ! grep -q samples out.txt || fail "--series none: $(cat out.txt)"
  grep -q '"series":null' bare.html || fail "--series none: a series in the page"
  mv run.pe.bin moved.bin
  must_run explore run.catalogue.csv --series moved.bin -o moved.html
  grep -q 'moved.bin: 5000 samples' out.txt || fail "--series: $(cat out.txt)"
  xz -k moved.bin && mv moved.bin.xz run.pe.bin.xz
  must_run explore run.catalogue.csv -o page.html
  grep -q 'run.pe.bin.xz: 5000 samples' out.txt || fail "the compressed series was not found: $(cat out.txt)"
  rm run.pe.bin.xz
  # Two runs, one of them without a series.
  mv moved.bin run.pe.bin
  catalogue other.csv
  must_run explore run.catalogue.csv other.csv -o two.html
  grep -q 'other.csv: .* events' out.txt || fail "two runs: $(cat out.txt)"
  refused "--series given 1 times, expected once per catalogue (2)" explore run.catalogue.csv other.csv --series run.pe.bin -o x
  refused "is read by this command" explore run.catalogue.csv -o run.pe.bin
  refused "is read by this command" explore run.catalogue.csv -o run.catalogue.csv
  refused "nowhere.bin: cannot open" explore run.catalogue.csv --history nowhere.bin -o x
  refused "nowhere.csv: cannot open" explore run.catalogue.csv --ruptures nowhere.csv -o x
  refused "no events, expected at least one" explore run.catalogue.csv --from 1e9 -o x
  head -c -3 run.pe.bin > torn.bin
  refused "torn.bin: truncated record" explore run.catalogue.csv --series torn.bin -o x
  must_run explore run.catalogue.csv --series torn.bin --lenient -o page.html
  ;;
match)
  # The second catalogue at a tenth of the velocity, its plates begin to move at time 100, too; every other event is the same.
  table() { # VELOCITY FACTOR
    printf '# lsm-catalogue 1\n# model = lsm\n# length = 40\n# velocity = %s\n' "$1"
    echo event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end
    awk -v f="$2" 'BEGIN { for (k = 1; k <= 40; k++) { t = 100 + f * (1000 * k + (f > 1 && k % 2 ? 300 : 0))
      printf "%d,%.6f,%.6f,%d,%d,1,2,1\n", k, t, t + 1, k, k } }'
  }
  table 1e-3 1 > a.csv
  table 1e-4 10 > b.csv
  must_run match a.csv b.csv --displacement --origin 100 --threshold 0.5 --within 0.1 --json m.json
  # From 1.3 to 40: 39 of the first (2 to 40), of which the even ones are there. Of the seven shifts by eighths of 38.7 the second,
  # fourth and sixth find 5, 10 and 19.
  told ' 0.5 39 40 20 4.857$' || fail "$(cat out.txt)"
  grep -q '"same": 20' m.json || fail "$(cat m.json)"
  must_run match a.csv a.csv --threshold 0.5 --within 0.1
  told ' 40 40 40 ' || fail "$(cat out.txt)"
  refused "at least two" match a.csv --threshold 0.5 --within 0.1
  refused "threshold is required" match a.csv b.csv --within 0.1
  refused "a catalogue without events" match a.csv b.csv --threshold 0.5 --within 0.1 --displacement --to 0.01
  ;;
json)
  catalogue c.csv
  # Twice the same numbers: in the table as text and in JSON.
  same_numbers() { # CSV JSON TABLE
    python3 - "$@" << 'END' || fail "$1 and $2 differ"
import csv, json, sys
rows = list(csv.DictReader(line for line in open(sys.argv[1]) if line[0] != "#"))
found = json.load(open(sys.argv[2]))[sys.argv[3]]
rows = [row for row in rows if row.get("origin") != "printed"]
assert len(rows) == len(found) > 0, (len(rows), len(found))
for row, other in zip(rows, found):
    assert list(row) == list(other)
    for key, text in row.items():
        value = other[key]
        assert (value is None and text == "") or value == text or float(text) == value, (key, text, value)
END
  }
  command -v python3 > /dev/null || { echo "skipped: no python3"; exit 77; }
  must_run histograms c.csv --no-picture -o h --json h.json
  same_numbers h.csv h.json densities
  must_run intervals c.csv --no-picture -o i --replicas 0 --json i.json
  same_numbers i.table1.csv i.json fits
  same_numbers i.csv i.json densities
  must_run magnitudes c.csv --no-picture -o m --json m.json
  same_numbers m.bvalues.csv m.json b_values
  series pe.bin
  must_run spectrum pe.bin --no-picture -o s --json s.json
  same_numbers s.csv s.json spectra
  must_run series pe.bin --no-picture -o r --json r.json
  same_numbers r-events.csv r.json events
  must_run pick pe.bin -o picked.csv --json p.json
  [ "$(rows picked.csv | wc -l)" = "$(sed -n 's/.*"events": \([0-9]*\).*/\1/p' p.json)" ] || fail "$(cat p.json)"
  must_run compare picked.csv picked.csv --threshold 1e-7 --replicas 10 -o v --json v.json
  same_numbers v.csv v.json tests
  must_run export c.csv -o e.csv --json e.json
  grep -q '"events": 4' e.json && grep -q '"without_magnitude": 0' e.json || fail "$(cat e.json)"
  # With - JSON is all there is on standard output.
  must_run count c.csv --size 0.001 --size 1 --brief 50 --json -
  python3 - << 'END' || fail "$(cat out.txt)"
import json
found = json.load(open("out.txt"))
sizes, one = found["sizes"], found["catalogues"][0]
assert [row["events"] for row in sizes] == [3, 2], sizes
assert [row["brief"] for row in sizes] == [2, 1], sizes
assert abs(sizes[0]["released"] - 1001.001) < 1e-9 and one["events"] == 4 and one["largest"] == 1000 and one["last_step"] == 390, found
END
  refused "is read by this command" count c.csv --json c.csv
  ;;
faults)
  # Killed at each system call that has to do with files, or refused it: what was there stays, or the new file is whole.
  need_strace
  catalogue events.csv
  series pe.bin 500
  sed 's/$/ of before/' events.csv > before
  for words in "export events.csv --force -o" "pick pe.bin --force -o" "fit events.csv --replicas 0 --range 1e-7:1e4 --no-picture -o fit --json"; do
    # shellcheck disable=SC2086
    must_run $words whole
    cp before part
    # shellcheck disable=SC2086
    system_calls part $words part > calls
    grep -q '^rename' calls && grep -q '^write' calls || fail "not the calls of $words: $(cat calls)"
    while read -r name n; do
      for fault in signal=KILL error=ENOSPC; do
        cp before part
        # shellcheck disable=SC2086
        with_fault "$name" "$n" $fault $words part
        status=$?
        case $name$fault in closeerror* | flockerror*) continue ;; esac
        cmp -s part whole || { cmp -s part before && [ $status != 0 ]; } || fail "$words: $fault at $name $n: status $status, half a file"
        [ $fault = signal=KILL ] || [ $status = 0 ] || { [ "$(wc -l < err.txt)" = 1 ] && grep -q '^postproc: ' err.txt; } ||
          fail "$words: $fault at $name $n: '$(cat err.txt)'"
        # shellcheck disable=SC2086
        must_run $words part
        cmp part whole || fail "$words: again, after $fault at $name $n"
      done
    done < calls
  done
  ;;
progress)
  # A terminal shows how far a test that takes long is; a file or a pipe is not filled with that.
  command -v script > /dev/null || { echo "skipped: no script(1), which makes a terminal"; exit 77; }
  {
    printf '# lsm-catalogue 1\n# model = lsm\n# length = 40\n'
    echo event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end
    awk 'BEGIN { srand(3); for (i = 1; i <= 2000; ++i) { t -= log(1 - rand()); printf "%d,%.17g,%.17g,%d,%d,1,2,1\n", i, t, t, i, i } }'
  } > many.csv
  must_run intervals many.csv --no-picture --replicas 50 -o x
  [ ! -s err.txt ] || fail "on standard error: $(cat err.txt)"
  script -qefc "exec '$program' intervals many.csv --no-picture --replicas 100000000 -o y" terminal.log > /dev/null &
  child=$!
  for _ in $(seq 600); do grep -q 'Monte Carlo replica [0-9]* of 100000000' terminal.log 2> /dev/null && break; sleep 0.1; done
  kill $child
  wait $child 2> /dev/null
  grep -q 'Monte Carlo replica [0-9]* of 100000000' terminal.log || fail "no progress: $(cat terminal.log)"
  ;;
summary)
  # Sizes over four decades, uneven times; every seventh event lasts one step.
  awk 'BEGIN {
    print "# lsm-catalogue 1\n# model = lsm\n# dt = 0.5\n# length = 40\n# kt = 0.2"
    print "event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end"
    srand(3)
    for (i = 1; i <= 400; i++) {
      t += 1 + int(-40 * log(1 - rand())) / 2
      long = i % 7 ? 8 : 1
      s = 1e-5 * exp(9.2 * rand())
      printf "%d,%.17g,%.17g,%d,%d,%.17g,%.17g,2\n", i, t, t + long * 0.5, t * 2, t * 2 + long, s, 2 + s
      t += long * 0.5
    }
  }' > c.csv
  must_run summary c.csv --threshold 0 1e-3 --range 1e-4:1e-2 --parameter kt seed --window 10:20 -o s.csv
  # field NAME: of the only row
  field() {
    awk -F, -v name="$1" '/^#/ { next } !n++ { for (i = 1; i <= NF; i++) if ($i == name) at = i; next }
      at { gsub("\"", "", $at); print $at }' rows.csv
  }
  sed 's/"fault, length 40"/fault/' s.csv > rows.csv
  [ "$(field kt)" = 0.2 ] && [ -z "$(field seed)" ] || fail "parameters: $(cat s.csv)"
  rows c.csv | awk -F, -v events="$(field events_0.001)" -v mean="$(field mean_time_0.001)" -v share="$(field share_10:20_0.001)" \
    -v brief="$(field brief)" -v largest="$(field largest)" -v released="$(field released)" '
    function off(a, b) { return a == "" || (a - b) ^ 2 > (1e-5 * b) ^ 2 }
    { all++; sum += $6; few += $5 - $4 <= 3; if ($6 > top) top = $6 }
    $6 >= 1e-3 { if (n++) { d = $2 - before; total += d; inside += d >= 10 && d < 20 } before = $2 }
    END {
      exit off(events, n) || off(mean, total / (n - 1)) || off(share, inside / (n - 1)) || off(brief, few / all) ||
        off(largest, top) || off(released, sum)
    }' || fail "numbers: $(cat s.csv)"
  # The estimators are those of fit and intervals.
  must_run fit c.csv --range 1e-4:1e-2 --replicas 0 --no-comparison --json fit.json --no-picture
  must_run intervals c.csv --threshold 1e-3 --method likelihood --delta 1 --shortest 0 --replicas 0 -o times --no-picture
  near() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a != "" && (a - b) ^ 2 < (1e-5 * b) ^ 2) }'; }
  near "$(field exponent_1e-4:1e-2)" "$(grep -m 1 -oP '"exponent": \K[-0-9.e]+' fit.json)" || fail "exponent: $(cat s.csv fit.json)"
  gamma=$(awk -F, '/^#/ { next } !n++ { for (i = 1; i <= NF; i++) if ($i == "gamma") at = i; next } /^ours/ { print $at }' times.table1.csv)
  near "$(field gamma_0.001)" "$gamma" || fail "gamma: $(field gamma_0.001), intervals say $gamma"
  refused "c.csv: is read by this command" summary c.csv -o c.csv
  refused "--range '2', expected LO:HI" summary c.csv --range 2
  ;;
bad_input)
  catalogue good.csv
  # What is read is not replaced, whichever of the outputs would do it.
  cp good.csv own.fits.csv
  cp good.csv own.table1.csv
  cp good.csv own.bvalues.csv
  cp good.csv own.omori.csv
  for words in "magnitudes own.bvalues.csv -o own" "aftershocks own.omori.csv -o own" "histograms good.csv -o ./good" "intervals own.table1.csv -o own" "fit own.fits.csv -o own" \
    "fit good.csv -o x --json good.csv" "report good.csv -o good.csv" "export good.csv -o ../$(basename "$PWD")/good.csv --force"; do
    # shellcheck disable=SC2086
    refused "is read by this command, expected another name" $words
  done
  series pe.csv 50
  cp pe.csv own-events.csv
  refused "is read by this command" series pe.csv -o pe
  refused "is read by this command" series own-events.csv -o own
  refused "is read by this command" spectrum pe.csv -o pe
  for path in x.csv ./x.fits.csv "$PWD/x.gp"; do
    refused "are the same file" fit good.csv -o x --json "$path"
  done
  for seed in -1 18446744073709551616 1.5; do
    refused "seed: expected a whole number from 0 to 18446744073709551615, not '$seed'" intervals good.csv "--seed=$seed" -o x
  done
  cp good.csv part.csv.new
  refused "is read by this command" export part.csv.new -o part.csv
  for command in histograms intervals fit magnitudes aftershocks; do
    refused "ends with a folder, expected a file name" $command good.csv -o ./
    refused "threshold: expected a number of 0 or more, not '-1'" $command good.csv --threshold -1 -o x
    refused "threshold: expected a number of 0 or more, not 'nan'" $command good.csv --threshold nan -o x
  done
  refused "new/: is a directory, expected a file name" report good.csv -o new/
  refused "subcommand" # none
  refused "help lists the options" smooth good.csv
  refused "is required" pick good.csv
  for command in pick histograms intervals fit series spectrum magnitudes aftershocks export report explore; do
    run $command --help || fail "$command --help"
    grep -q -- "--output" out.txt || fail "$command --help does not tell of --output"
    refused "nowhere.csv: cannot open" $command nowhere.csv -o x
    refused "is a directory, expected a file" $command / -o x
    : > empty.csv
    empty="empty.csv:1: empty file" other="version.csv:1: .*version '2', expected version 1"
    printf '# lsm-catalogue 2\n' > version.csv
    case $command in pick | series | spectrum)
      empty="empty.csv: not a PE series" other="version.csv: PE series of another version, expected version 1"
      printf 'lsm-pe-series-2\n' > version.csv ;;
    esac
    refused "$empty" $command empty.csv -o x
    for lenient in "" --lenient; do
      refused "$other" $command version.csv -o x $lenient
    done
  done
  run --version && grep -q '^postproc [0-9]' out.txt || fail "--version"
  head -c -3 good.csv > torn.csv
  refused "torn.csv:9: truncated last line" export torn.csv -o x
  sed 's/^2,2,3/2,nan,3/; s/^3,/1,/' good.csv > bad.csv
  refused "bad.csv:6: column 't_start' is 'nan', expected a finite number" export bad.csv -o x
  must_run export bad.csv -o repaired.csv --lenient
  grep -q "passed over lines with something else than finite numbers: 1" err.txt &&
    grep -q "passed over events out of order: 1" err.txt || fail "repairs are not stated: $(cat err.txt)"
  [ "$(wc -l < repaired.csv)" = 3 ] || fail "$(wc -l < repaired.csv) lines, expected 3"
  refused "from 3 --to 2: expected --from before --to" export good.csv -o x --from 3 --to 2
  ;;
select)
  catalogue c.csv
  must_run select c.csv -o all.csv
  paste -d, <(rows c.csv) <(rows all.csv) | awk -F, '{ for (i = 1; i <= 10; i++) if ($i + 0 != $(i + 10) + 0) exit 1; n++ }
    END { exit n != 5 || NF != 20 }' || fail "all events: $(cat all.csv)"
  grep -q '^# selected = all events$' all.csv || fail "header: $(head all.csv)"
  must_run select c.csv --from 2 --to 86404 --min-size 1e-3 -o part.csv
  [ "$(rows part.csv | cut -d, -f1 | paste -sd' ')" = "2 3" ] || fail "$(cat part.csv)"
  grep -q '2 events; left out: 2 by time, 1 by size' out.txt || fail "$(cat out.txt)"
  grep -q '^# selected = t_start from 2, t_start below 86404, size from 0.001$' part.csv && grep -q '^# min_size = 0.001$' part.csv &&
    grep -q '^# length = 40$' part.csv || fail "header: $(head part.csv)"
  rows all.csv | grep -Fxq "$(rows part.csv | tail -n 1)" || fail "numbers are not those of the original"
  # twice: the header says both
  must_run select part.csv --min-size 1 -o twice.csv
  grep -q '^# selected = t_start from 2, .*size from 0.001; size from 1$' twice.csv || fail "header: $(head twice.csv)"
  # ruptures stay in order of their ends
  sed 's/^# length = 40/&\n# events = ruptures/; s/^2,2,3/2,0.5,3/; s/^1,0,1.5/1,1,1.5/' c.csv > ruptures.csv
  must_run select ruptures.csv --min-size 1e-3 -o r.csv
  [ "$(rows r.csv | cut -d, -f1 | paste -sd' ')" = "1 2 3" ] || fail "$(cat r.csv)"
  refused "exists" select c.csv -o part.csv
  refused "is read by this command" select c.csv -o c.csv --force
  refused "2 catalogues, expected one" select c.csv part.csv -o x.csv
  refused "earthquakes, expected a catalogue of a model" select "$(dirname "${BASH_SOURCE[0]}")/../../inputs/seismicity/southern-california.csv.xz" -o x.csv
  ;;
earthquakes)
  inputs=$(dirname "${BASH_SOURCE[0]}")/../../inputs
  california=$inputs/seismicity/southern-california.csv.xz
  # Values and errors measured on the same data by another program, from the first release of this extract on.
  while read -r from to magnitude times gamma error b; do
    must_run intervals "$california" --from "$from" --to "$to" --min-magnitude "$magnitude" --rescale --delta 1 \
      --method likelihood --replicas 0 --shuffles 20 --no-picture -o times
    told " magnitudes >= $magnitude $times " || fail "$from: $(head -n 1 out.txt)"
    awk -F, -v gamma="$gamma" -v error="$error" -v b="$b" '/^ours/ { found = 1
      if ($4 < gamma - error || $4 > gamma + error || $5 < 0.9 * error || $5 > 1.1 * error || $8 < b - 0.03 || $8 > b + 0.03) bad = 1 }
      END { exit bad || !found }' times.table1.csv || fail "$from: $(grep ^ours times.table1.csv), expected gamma $gamma, B $b"
  done <<'END'
1984-01-01 1986-07-02T12:00 2 6620 0.667 0.021 1.51
1988-01-01 1992-01-01 2.5 3560 0.647 0.028 1.59
2011-01-01 2019-01-01 2 10377 0.659 0.016 1.60
END
  # clustered: variation 1.23, memory 0.13 in the first stretch
  must_run intervals "$california" --from 1984-01-01 --to 1986-07-02T12:00 --shuffles 50 --method likelihood --delta 1 --replicas 0 --no-picture -o times
  awk -F, '/^#/ { next } !head { head = 1; for (i = 1; i <= NF; i++) c[$i] = i; next }
    { v = $c["variation"]; m = $c["memory"]; exit !(v > 1.225 && v < 1.235 && m > 0.125 && m < 0.135 && $c["memory_p"] < 0.05) }' \
    times.clustering.csv || fail "clustering: $(tail -n 1 times.clustering.csv)"
  # through a pipe, whatever the format: what it is, the first bytes tell there, too
  xzcat "$california" | head -n 3000 > part.csv
  printf '%s\n' '1984/01/01 00:00:01.00 eq l 2.10 l 33.0 -116.0 5.0 A' '1984/01/03 00:00:01.00 eq l 2.30 l 33.0 -116.0 5.0 A' > part.scedc
  printf '%s\n' '-116 33 1984 1 1 2.1 5 0 0 1' '-116 33 1984 1 3 2.3 5 0 0 1' > part.zmap
  quake() { echo "<event><origin><time><value>$1</value></time><latitude><value>33</value></latitude><longitude><value>-116</value></longitude></origin><magnitude><mag><value>2</value></mag></magnitude></event>"; }
  { echo '<quakeml><eventParameters>'; quake 1984-01-01T00:00:01; quake 1984-01-03T00:00:01; echo '</eventParameters></quakeml>'; } > part.xml
  for file in part.csv part.scedc part.zmap part.xml; do
    must_run count $file --json whole.json
    must_run count <(cat $file) --label "${file%.*}" --json piped.json
    sed 's/"label": "[^"]*"/"label": ""/' whole.json > a.json
    sed 's/"label": "[^"]*"/"label": ""/' piped.json | cmp a.json - || fail "$file through a pipe: $(cat piped.json)"
    grep -q '"events": [1-9]' whole.json || fail "$file: $(cat whole.json)"
    must_run count <(xz < $file) --json packed.json
    sed 's/"label": "[^"]*"/"label": ""/' packed.json | cmp a.json - || fail "$file through a pipe, compressed: $(cat packed.json)"
  done
  must_run count <(xzcat "$inputs/results/catalogues/fault_120.catalogue.csv.xz")
  # the rank of models; a catalogue is no way off from itself
  must_run nature "$california" "$inputs/results/catalogues/fault_120.catalogue.csv.xz" \
    "$inputs/results/catalogues/fault_120_seed_2.catalogue.csv.xz" "$california" --label nature --label fault --label fault --label again \
    --from 1984-01-01 --to 1986-07-02T12:00 --from 4200 --reference M2 --reference M2.5 --threshold 1e-2 --replicas 20 --no-picture -o beside
  awk -F, '/^#/ { next } !head { head = 1; for (i = 1; i <= NF; i++) c[$i] = i; next }
    { n++; name[n] = $1; d[n] = $c["distance"]; k[n] = $c["catalogues"]; e[n] = $c["distance_error"] }
    END { exit !(n == 5 && name[1] == "nature" && d[1] == "" && name[2] == "again" && d[2] == 0 && d[3] < 0.05 && name[5] == "fault" &&
                 k[5] == 2 && d[5] > 0.1 && e[5] > 0 && e[5] < d[5]) }' beside.table.csv || fail "ranks: $(cat beside.table.csv)"
  # Table 1: gamma, delta, B and C of each, as intervals has them
  must_run intervals "$california" --from 1984-01-01 --to 1986-07-02T12:00 --min-magnitude 2 --rescale --method likelihood --replicas 0 --no-picture -o times
  for method in 'maximum likelihood' 'maximum likelihood, δ = 1 held'; do
    values() { awk -F, -v q='"' -v m="$2" -v n="$3" '/^ours/ { line = $0; gsub(q, "", line); if (index(line, n "," m)) { print $4, $6, $8, $10; exit } }' "$1"; }
    [ "$(values times.table1.csv "$method" southern-california)" = "$(values beside.table1.csv "$method, 1 catalogue" nature)" ] &&
      [ -n "$(values times.table1.csv "$method" southern-california)" ] || fail "Table 1, $method: $(cat times.table1.csv beside.table1.csv)"
  done
  refused "fault_120.catalogue.csv.xz: catalogue of a model, expected one of earthquakes first" nature \
    "$inputs/results/catalogues/fault_120.catalogue.csv.xz" "$california" -o x
  refused "is a date, but no catalogue is of earthquakes" intervals "$inputs/results/catalogues/fault_120.catalogue.csv.xz" --from 1984-01-01 -o x
  refused "is a number, but all catalogues are of earthquakes, expected a date" intervals "$california" --from 1984 -o x
  refused "from 'monday': expected a model time, or for earthquakes a date" intervals "$california" --from monday -o x
  refused "expected W/E/S/N in degrees" intervals "$california" --region 1/2/3 -o x
  ;;
*)
  fail "no case $2"
  ;;
esac
echo passed
