#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Tests of postproc from outside: postproc_cli_test.sh PROGRAM CASE [SLIDER_CLI]
export LC_ALL=C
slider=${3:-}
# shellcheck source=tests/postproc/postproc_shell.sh
source "$(dirname "${BASH_SOURCE[0]}")/postproc_shell.sh" "$1"

# series FILE [ROWS]: loading with drops, as text.
series() {
  awk -v rows="${2:-5000}" 'BEGIN {
    print "# lsm-pe-series 1\n# model = lsm\n# dt = 0.03\n# step0 = 0\n# time0 = 0\n# stride = 1"
    print "# length = 40\n# picker = literal\n# lambda = 0.5\n# min_size = 0\nstep,time,pe"
    pe = 1
    for (i = 0; i < rows; i++) {
      printf "%d,%.17g,%.17g\n", i, i * 0.03, pe
      pe += i % 97 < 80 ? 1e-3 * (1 + i % 7) : -2e-3 * (1 + i % 11)
    }
  }' > "$1"
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
  series pe.csv
  for setting in "exponential 0.99 0" "exponential 0.9 0.01" "average 0.99 0" "literal 0.99 0.02"; do
    read -r reading lambda least <<< "$setting"
    must_run pick pe.csv -o picked.csv --force --picker "$reading" --lambda "$lambda" --min-size "$least"
    reference "$reading" "$lambda" "$least" pe.csv > expected
    [ "$(wc -l < expected)" -ge 10 ] || fail "too few events to test anything: $setting"
    rows picked.csv | diff - expected > /dev/null || fail "$setting: not the events of the reference"
    grep -q "^# picker = $reading$" picked.csv && grep -q "^# lambda = $lambda$" picked.csv ||
      fail "$setting: header does not say so"
  done
  # What is not given comes from the header of the series; its parameters are carried over.
  must_run pick pe.csv -o picked.csv --force
  reference literal 0.5 0 pe.csv | diff - <(rows picked.csv) > /dev/null || fail "settings of the header not used"
  # dt stands where the run has it.
  sed 's/^# length = 40/&\n# viscosity = 0.1/' pe.csv > fault.csv
  must_run pick fault.csv -o fault_picked.csv
  [ "$(grep -A 1 '^# dt' fault_picked.csv | tail -n 1)" = "# viscosity = 0.1" ] || fail "$(head -n 9 fault_picked.csv)"
  grep -q '^# length = 40$' picked.csv && grep -q '^# dt = 0.029999999999999999$' picked.csv ||
    fail "parameters are not carried over"
  # Memory, in time and in samples; lambda = exp(-0.03/3), 1 - 1/100
  must_run pick pe.csv -o a.csv --picker exponential --memory-time 3
  grep -q '^# lambda = 0.99004983374916' a.csv || fail "--memory-time gives $(grep lambda a.csv)"
  must_run pick pe.csv -o b.csv --picker exponential --memory-steps 100
  grep -q '^# lambda = 0.99$' b.csv || fail "--memory-steps gives $(grep lambda b.csv)"
  # Warm-up: identifiers begin with 1 behind it.
  must_run pick pe.csv -o c.csv --warmup 75
  reference literal 0.5 0 pe.csv | awk -F, '$2 >= 75' | cut -d, -f2- | diff - <(rows c.csv | cut -d, -f2-) > /dev/null ||
    fail "--warmup 75"
  [ "$(rows c.csv | head -n 1 | cut -d, -f1)" = 1 ] || fail "identifiers with --warmup"
  # Completeness: said on request, carried over, replaced.
  grep -q completeness c.csv && fail "completeness that nobody gave"
  must_run pick pe.csv -o d.csv --completeness 0.003
  [ "$(grep -c '^# completeness = 0.003$' d.csv)" = 1 ] || fail "--completeness: $(grep '^#' d.csv)"
  rows d.csv | diff - <(rows picked.csv) > /dev/null || fail "--completeness changes the events"
  sed 's/^# length/# completeness = 0.002\n&/' pe.csv > known.csv
  must_run pick known.csv -o e.csv
  grep -q '^# completeness = 0.002$' e.csv || fail "completeness of the series is lost: $(grep '^#' e.csv)"
  must_run pick known.csv -o e.csv --force --completeness 0.004
  [ "$(grep '^# completeness' e.csv)" = '# completeness = 0.004' ] || fail "completeness: $(grep '^#' e.csv)"
  refused "completeness: expected a number of 0 or more, not '-1'" pick pe.csv -o x.csv --completeness -1
  sed 's/^# length/# completeness = small\n&/' pe.csv > known.csv
  refused "known.csv: completeness is 'small', expected a finite size of at least 0" pick known.csv -o x.csv
  # The catalogue is one that the other commands read.
  must_run export c.csv -o table.csv
  # An older file stays unless --force is given; nothing is left of a series that ends badly.
  cp c.csv before
  refused "c.csv: exists already" pick pe.csv -o c.csv
  sed '4000s/,[^,]*$/,nan/' pe.csv > bad.csv
  refused "bad.csv:4000: column 'pe' is 'nan', expected a finite number" pick bad.csv -o new.csv
  refused "bad.csv:4000: column 'pe' is 'nan', expected a finite number" pick bad.csv -o c.csv --force
  cmp c.csv before || fail "an older catalogue was touched"
  head -c -5 pe.csv > torn.csv
  refused "torn.csv:5011: truncated last line" pick torn.csv -o new.csv
  must_run pick torn.csv -o new.csv --lenient
  grep -q "torn.csv: dropped a truncated last sample: 1" err.txt || fail "a repair is not stated"
  refused "is read by this command" pick pe.csv -o ./pe.csv --force
  refused "lambda = 1, expected at least 0 and less than 1" pick pe.csv -o x.csv --lambda 1
  sed 's/^# lambda = .*/# lambda = 1.5/' pe.csv > leaky.csv
  refused "lambda in the header of the series is 1.5, expected at least 0" pick leaky.csv -o x.csv
  refused "memory-steps = 0.5, expected at least 1 sample" pick pe.csv -o x.csv --picker exponential --memory-steps 0.5
  refused "memory-time with the reading 'literal', expected 'exponential'" pick pe.csv -o x.csv --memory-time 3
  refused "lambda excludes" pick pe.csv -o x.csv --memory-steps 10 --lambda 0.5
  refused "min-size = -1, expected a finite size of at least 0" pick pe.csv -o x.csv --min-size -1
  refused "picker = .median., expected exponential, average or literal" pick pe.csv -o x.csv --picker median
  ;;
online)
  # The same rows as the program that ran picked, from its series.
  [ -x "$slider" ] || exit 77
  for picker in exponential literal; do
    for format in text binary; do
      "$slider" --overwrite --blocks 100 --dt 0.05 --velocity 0.05 --warmup 300 --steps 300000 --picker $picker \
        --catalogue online.csv --pe-series pe --pe-format $format > /dev/null || fail "slider_cli"
      must_run pick pe -o picked.csv --force
      rows online.csv | cut -d, -f1-8 > expected
      [ "$(wc -l < expected)" -ge 10 ] || fail "too few events to test anything"
      rows picked.csv | cmp - expected || fail "$picker, $format: not the same rows"
      diff <(grep '^#' online.csv | sort) <(grep '^#' picked.csv | grep -v picked_by | sort) > /dev/null ||
        fail "$picker: headers differ"
    done
  done
  ;;
series)
  series pe.csv
  must_run series pe.csv -o all --no-picture --picker exponential --lambda 0.9
  # 5000 samples are more than 2 x 2000: 2 rows for each of the columns, the extremes among them.
  [ "$(grep -vc '^[#t]' all.csv)" = 4000 ] || fail "$(grep -vc '^[#t]' all.csv) rows, expected 4000"
  extremes() { sort -g | sed -n '1p;$p'; }
  [ "$(grep -v '^[#t]' all.csv | cut -d, -f2 | extremes)" = "$(grep -v '^[#s]' pe.csv | cut -d, -f3 | extremes)" ] ||
    fail "an extreme is lost"
  reference exponential 0.9 0 pe.csv | cut -d, -f2,3,7,8,6 > expected
  grep -v '^[#t]' all-events.csv | awk -F, '$5 != "" { print $1 "," $2 "," $5 "," $3 "," $4 }' |
    diff - expected > /dev/null || fail "not the events of the reference"
  # Few samples are there one by one; the smoothed change has the memory of what was before.
  must_run series pe.csv -o part --no-picture --from 30 --to 60 --picker exponential --lambda 0.9
  awk -F, '/^[#s]/ { next } n++ { x = $3 - pe; a = 0.9 * a + (1 - 0.9) * x } { pe = $3 }
    $2 >= 30 && $2 <= 60 { printf "%.17g,%.17g,%.17g,%.17g\n", $2, $3, x, a }' pe.csv > expected
  [ "$(wc -l < expected)" -gt 900 ] && grep -v '^[#t]' part.csv | diff - expected > /dev/null || fail "window"
  if command -v gnuplot > /dev/null; then
    must_run series pe.csv -o drawn --from 30 --to 60
    for extension in png svg gp csv; do [ -s drawn.$extension ] || fail "no drawn.$extension"; done
    [ -s drawn-events.csv ] || fail "no drawn-events.csv"
    grep -q '</svg>' drawn.svg || fail "the SVG is not whole"
    # A window without an event, too.
    must_run series pe.csv -o quiet --from 0 --to 1
    [ -s quiet.svg ] || fail "no picture without events"
  fi
  refused "expected --from before --to" series pe.csv --from 5 --to 5 --no-picture -o x
  refused "pe.csv: 0 samples in the window of time, expected at least 3" series pe.csv --from 1e6 -o x
  refused "columns" series pe.csv --columns 2 -o x
  ;;
spectrum)
  # A sine of amplitude 2 and period 25.6 steps of 0.5: variance 2, frequency 1/12.8
  awk 'BEGIN {
    print "# lsm-pe-series 1\n# model = lsm\n# dt = 0.5\n# step0 = 0\n# time0 = 0\n# stride = 1\nstep,time,pe"
    for (i = 0; i < 4096; i++) printf "%d,%.17g,%.17g\n", i, i * 0.5, 5 + 2 * sin(8 * atan2(1, 1) * i / 25.6) }' > sine
  must_run spectrum sine --segment 1024 --per-decade 0 --no-picture -o sine_spectrum
  awk -F, '/^[#c]/ { next } { v += $4 * $5; if ($5 > big) { big = $5; at = $3 } }
    END { exit !(v > 1.999 && v < 2.001 && at > 0.07812 && at < 0.07813) }' sine_spectrum.csv || fail "variance or frequency"
  grep -q "4096 samples, 7 segments" out.txt || fail "segments: $(cat out.txt)"
  must_run spectrum sine --segment 1024 --of change --window blackman --detrend mean --no-picture -o change
  # change: amplitude 4 sin(pi/25.6), variance 0.11982 (8 sin^2)
  awk -F, '/^[#c]/ { next } { v += $4 * $5 } END { exit !(v > 0.1197 && v < 0.1200) }' change.csv || fail "variance of the change"
  if command -v gnuplot > /dev/null; then
    must_run spectrum sine sine --label one --label 'two & <2>' -o drawn
    for extension in png svg gp csv; do [ -s drawn.$extension ] || fail "no drawn.$extension"; done
  fi
  refused "4096 samples in the window of time, expected at least one segment of 8192" spectrum sine --segment 8192 -o x
  sed '100d' sine > gap
  refused "gap: step 93 after step 91, expected a sample every 1 steps" spectrum gap -o x
  refused "overlap of segments is 1, expected at least 0 and less than 1" spectrum sine --overlap 1 -o x
  refused "window" spectrum sine --window tukey -o x
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
  grep -q 'sizes: 400 and 300.*no difference seen$' out.txt || fail "$(cat out.txt)"
  [ "$(grep -c 'no difference seen' out.txt) $(grep -c 'they differ' out.txt)" = "3 1" ] || fail "$(cat out.txt)"
  grep 'they differ' out.txt | grep -q 'times: 399 and 299.*ratio 2.0.*distance 1, p = (5.0 +- 5.0)e-04' || fail "$(cat out.txt)"
  [ "$(grep -vc '^#' d.csv)" = 5 ] || fail "$(cat d.csv)"
  cp d.csv before.csv
  must_run compare a.csv b.csv c.csv -o d
  cmp d.csv before.csv || fail "not the same twice"
  # Half the velocity, so twice the time for the same way.
  for velocity in 0.5 -1; do
    f=a.csv; [ "$velocity" = -1 ] || f=c.csv
    sed "s/^# length.*/&\n# velocity = $velocity/" "$f" > "way$velocity.csv"
  done
  must_run compare way-1.csv way0.5.csv --displacement --from 250 --to 1250 -o d
  [ "$(grep -c 'no difference seen' out.txt) $(grep -c 'they differ' out.txt)" = "2 0" ] || fail "$(cat out.txt)"
  grep -q 'times: 199 and 199.*ratio 1.0' out.txt || fail "$(cat out.txt)"
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
  grep -q 'M = 0.6667 log10(size) + 0 (a convention, ours)' out.txt && grep -q 'completeness in the header of gr.csv' out.txt &&
    grep -q 'exponent of the sizes 1 + 0.6667 b = 1.66' out.txt || fail "$(cat out.txt)"
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
  refused "magnitude-slope: expected a positive finite number" magnitudes gr.csv -o x --magnitude-slope 0
  refused "magnitude-bin: expected a finite number of 0 or more" magnitudes gr.csv -o x --magnitude-bin -1
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
  grep -q '41 main shocks of size 50 or larger (largest event of all that start within 1000 before and after)' out.txt &&
    grep -q 'as large in a share of 0.05 of Poisson catalogues' out.txt || fail "$(cat out.txt)"
  # Stacked rate: counts in the bins, per main shock and time unit.
  awk -F, '/^1,/ { if ($7 < 0.9999 * $6 / (41 * ($4 - $3)) || $7 > 1.0001 * $6 / (41 * ($4 - $3))) exit 1; ++n }
    END { exit !(n > 8) }' a.csv || fail "$(cat a.csv)"
  must_run aftershocks omori.csv -o a --no-picture --main-size 50 --window 1000 --replicas 0 --hold-c 2
  grep -q 'c = 2 (held)' out.txt || fail "$(cat out.txt)"
  # Events at one place in each stretch of 10 have no aftershocks.
  sed 's/^[0-9]*,.*//' omori.csv | sed '/^$/d' > even.csv
  awk 'BEGIN { for (i = 0; i < 5000; i++) { t = 10 * (i + i * 0.618034 % 1)
    printf "%d,%.6f,%.6f,%d,%d,%s,1,1\n", i + 1, t, t, i, i, i % 100 == 50 ? 100 : 0.01 } }' >> even.csv
  must_run aftershocks even.csv -o a --no-picture --main-size 50 --window 300 --replicas 0
  grep -q 'degenerate: no decay' out.txt || fail "$(cat out.txt)"
  awk -F, '/^lsm/ && !($8 > 0.095 && $8 < 0.101 && $10 == "" && $12 == "") { exit 1 }' a.omori.csv || fail "$(cat a.omori.csv)"
  # By default a share of the events are large enough.
  must_run aftershocks omori.csv -o a --no-picture --replicas 0
  grep -q 'main shocks of size 0.01 or larger' out.txt || fail "$(cat out.txt)"
  refused "no event of size 1000 or larger, expected a smaller --main-size" aftershocks omori.csv -o x --main-size 1000
  refused "first time after main shocks: expected 0 or more, below the window" aftershocks omori.csv -o x --first 20 --window 10
  refused "c held at 0.000000, expected 0 or more (0 needs a first time above 0)" aftershocks omori.csv -o x --hold-c 0 --main-size 50
  refused "excludes --main-s" aftershocks omori.csv -o x --main-size 1 --main-share 0.1
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
  for command in histograms intervals fit magnitudes aftershocks; do
    refused "ends with a folder, expected a file name" $command good.csv -o ./
    refused "threshold: expected a number of 0 or more, not '-1'" $command good.csv --threshold -1 -o x
    refused "threshold: expected a number of 0 or more, not 'nan'" $command good.csv --threshold nan -o x
  done
  refused "new/: is a directory, expected a file name" report good.csv -o new/
  refused "subcommand" # none
  refused "help lists the options" smooth good.csv
  refused "is required" pick good.csv
  for command in pick histograms intervals fit series spectrum magnitudes aftershocks export report; do
    run $command --help || fail "$command --help"
    grep -q -- "--output" out.txt || fail "$command --help does not tell of --output"
    refused "nowhere.csv: cannot open" $command nowhere.csv -o x
    refused "is a directory, expected a file" $command / -o x
    : > empty.csv
    refused "empty.csv:1: empty file" $command empty.csv -o x
    printf '# lsm-catalogue 2\n' > version.csv
    case $command in pick | series | spectrum) printf '# lsm-pe-series 2\n' > version.csv ;; esac
    for lenient in "" --lenient; do
      refused "version.csv:1: .*version '2', expected version 1" $command version.csv -o x $lenient
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
*)
  fail "no case $2"
  ;;
esac
echo passed
