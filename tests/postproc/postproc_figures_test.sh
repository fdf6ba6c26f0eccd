#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Tests of the commands that draw, from outside: postproc_figures_test.sh PROGRAM CASE
# shellcheck source=tests/postproc/postproc_shell.sh
source "$(dirname "${BASH_SOURCE[0]}")/postproc_shell.sh" "$1"

pictures() { # BASE: all four files, none empty
  local extension
  for extension in csv gp png svg; do
    [ -s "$1.$extension" ] || fail "$1.$extension is missing or empty"
  done
}
# catalogue FILE LENGTH [MODEL]: from lines "t_start size" on stdin
catalogue() {
  awk -v length_="$2" -v model="${3:-lsm}" '
    BEGIN { print "# lsm-catalogue 1\n# model = " model
            print "# " (model == "lsm" ? "length" : "blocks") " = " length_
            print "event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end" }
    { printf "%d,%.17g,%.17g,%d,%d,%.17g,%.17g,0\n", NR, $1, $1, NR, NR, $2, $2 }' > "$1"
}
# near A B RELATIVE
near() { awk -v a="$1" -v b="$2" -v r="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(d <= r * (b < 0 ? -b : b)) }'; }
# power ALPHA LO HI N: "t size" of a sample whose cumulative distribution is that of the power law
power() {
  awk -v a="$1" -v lo="$2" -v hi="$3" -v n="$4" 'BEGIN {
    srand(1)
    for (i = 0; i < n; ++i) order[i] = i
    for (i = n - 1; i > 0; --i) { j = int(rand() * (i + 1)); k = order[i]; order[i] = order[j]; order[j] = k }
    for (i = 0; i < n; ++i) {
      u = (order[i] + 0.5) / n # in random order, as neighbours in time must not depend on each other
      if (a == 1) s = lo * (hi / lo) ^ u
      else s = (lo ^ (1 - a) + u * (hi ^ (1 - a) - lo ^ (1 - a))) ^ (1 / (1 - a))
      printf "%d %.17g\n", 10 * i, s } }'
}

# Moment 0.1 L^2 and drops of PE 0.05 of the moment, one after the other; two more
# at the same time as the largest.
ruptures() {
  printf '# lsm-catalogue 1\n# model = lsm\n# length = 120\n# events = ruptures\n'
  echo event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end,slip_moment,x_centroid,rupture_length,x_hypocentre,x_begin,mean_slip,stress_drop
  awk 'BEGIN { for (i = 1; i <= 39; ++i) print 10 * i, 10 * i + 5, i, 0.005 * i * i
         print "402 404.5 30 0.4\n400 405 40 8\n401 405 25 -0.2\n500 505 120 72" }' |
    awk '{ m = 0.1 * $3 * $3
       printf "%d,%s,%s,%d,%d,%.17g,100,%.17g,%.17g,60,%d,60.5,60,%g,0.003\n", NR, $1, $2, NR, NR, m / 100, 100 - $4, m, $3, 0.1 * $3 }'
}

case $2 in
histograms)
  # 90 events in the bin from 1e-3 to 10^-2.9, 10 in the one from 1e-2 to 10^-1.9, 7 too small.
  awk 'BEGIN { for (i = 0; i < 107; ++i) print i, (i < 90 ? 1.1e-3 : i < 100 ? 1.1e-2 : 5e-5) }' |
    catalogue a.csv 120
  power 1 1e-3 1 1000 | catalogue b.csv 256 block-slider
  must_run histograms a.csv b.csv --guide -1.07 --guide -1:1e-2:1e-1 -o h
  pictures h
  awk -F, '/^#/ || /^curve/ { next }
    $1 == 1 && $7 > 0 {
      ++n; w = $5 - $4; d = $7 / (100 * w); e = sqrt($7) / (100 * w)
      if (($8 / d - 1) ^ 2 > 1e-18 || ($9 / e - 1) ^ 2 > 1e-18) exit 1
      edge = n == 1 ? 1e-3 : 1e-2; count = n == 1 ? 90 : 10
      if (($4 / edge - 1) ^ 2 > 1e-18 || $7 != count) exit 1
      if (($5 / $4 / 10 ^ 0.1 - 1) ^ 2 > 1e-18) exit 1 }
    $1 == 1 { rows++ }
    END { exit !(n == 2 && rows == 11) }' h.csv || fail "densities of a.csv: $(cat h.csv)"
  # Ten bins a decade over three decades, density 1 / (ln 1000 s), integral 1.
  awk -F, '$1 == 2 && !/^#/ { sum += $8 * ($5 - $4); flat = $8 * $6 * log(1000); if ((flat - 1) ^ 2 > 0.05 ^ 2) exit 1; ++n }
    END { exit !(n == 30 && (sum - 1) ^ 2 < 1e-18) }' h.csv || fail "densities of b.csv: $(cat h.csv)"
  grep -q 'fault, length 120 (100 events)' h.svg || fail "no legend for a.csv"
  grep -q 'block-slider, N = 256 (1000 events)' h.svg || fail "no legend for b.csv"
  must_run histograms a.csv --threshold 0 -o c --no-picture
  [ -e c.png ] && fail "--no-picture drew a picture"
  awk -F, '{ total += $7 } END { exit total != 107 }' c.csv ||
    fail "counts: $(cat c.csv)"
  refused 'expected SLOPE' histograms a.csv --guide steep -o x
  refused 'expected LO:HI' histograms a.csv --range 3 -o x
  refused 'nothing to draw' histograms a.csv --threshold 1 -o x
  [ -e x.csv ] && fail "a refused command left a file"
  ;;
intervals)
  # 100 times of 5, then 50 of 50.
  awk 'BEGIN { t = 0; for (i = 0; i <= 150; ++i) { print t, (i % 2 ? 1 : 2); t += i < 100 ? 5 : 50 } }' |
    catalogue a.csv 120
  must_run intervals a.csv -o i
  pictures i
  pictures i.rate
  pictures i.conditional
  # The cumulative number ends with all events; the first hundred times are a steady stretch on their own.
  awk -F, '$2 == "count" { n = $5; t = $3 } END { exit !(n == 151 && t == 3000) }' i.rate.csv || fail "$(tail -n 3 i.rate.csv)"
  must_run intervals a.csv --steady-events 60 --no-picture -o steady
  awk -F, '$2 == "steady" && $3 == 0 && $4 >= 450 && $4 <= 550 && $5 > 90 { found = 1 } END { exit !found }' steady.rate.csv ||
    fail "$(grep steady steady.rate.csv)"
  awk -F, '/^#/ || /^curve/ || !($7 > 0) { next }
    { ++n; d = $7 / (150 * ($5 - $4)); if (($8 / d - 1) ^ 2 > 1e-18) exit 1
      if ($7 != (n == 1 ? 100 : 50)) exit 1
      t = n == 1 ? 5 : 50; if (!($4 <= t && t < $5)) exit 1 }
    END { exit n != 2 }' i.csv || fail "densities: $(cat i.csv)"
  told ' 150 20 model time 1.061 0.02944$' ||
    fail "mean: $(cat out.txt)"
  grep -q 'LSM .*0.995 .*1.00 .*15.21 .*0.0573' out.txt || fail "printed Table 1: $(cat out.txt)"
  grep -q '^printed,,,0.0,,1.00,,100.0,,0.25,,,,,,,Block-Slider,' i.table1.csv || fail "$(cat i.table1.csv)"
  # Every second event is large: times of 10 and 100.
  must_run intervals a.csv --threshold 0 --threshold 1.5 --rescale -o r --no-picture
  awk -F, '!/^#/ && $1 == 2 && $7 == 50 && $4 <= 10 / 40 && 10 / 40 < $5 { good = 1 } END { exit !good }' r.csv ||
    fail "rescaled: $(cat r.csv)"
  # Exponential times: gamma = delta = 1, B = 7, C = 1 / 7.
  awk 'BEGIN { t = 0; n = 4000; for (i = 0; i < n; ++i) { printf "%.17g 1\n", t; t += -7 * log(1 - ((i * 7919) % n + 0.5) / n) } }' |
    catalogue e.csv 120
  must_run intervals e.csv -o x --delta 1
  awk -F, '$1 == "ours" { ++n; if ($12 > 3) exit 1
      if (($4 - 1) ^ 2 > 0.03 ^ 2 || ($8 / 7 - 1) ^ 2 > 0.03 ^ 2 || ($10 * 7 - 1) ^ 2 > 0.03 ^ 2) exit 1 }
    END { exit n != 2 }' x.table1.csv || fail "exponential times: $(cat x.table1.csv)"
  # p-values: from the seed, with as many replicas as asked for.
  told 'maximum likelihood, .* 1 no$' || fail "times without scatter fit too well: $(cat out.txt)"
  awk -F, '$1 == "ours" && $13 != "" { ++n; if (!($14 == 1 && $15 == 0 && $16 == "no")) exit 1 } END { exit n != 1 }' x.table1.csv ||
    fail "p-value: $(cat x.table1.csv)"
  must_run intervals a.csv --delta 1 --method likelihood --replicas 20 --seed 3 -o p --no-picture
  told ' 0.048 +- 0.04[0-9] yes' || fail "two times only are no gamma density: $(cat out.txt)"
  grep -q 'rejected: p below 0.05' out.txt || fail "no rule: $(cat out.txt)"
  must_run intervals a.csv --delta 1 --method likelihood --replicas 0 --shuffles 0 -o p --no-picture
  grep 'γ' out.txt | grep -q rejected && fail "a p-value without replicas: $(cat out.txt)"
  refused 'replicas' intervals a.csv --replicas -1 -o x
  refused "expected 'free' or a positive number" intervals a.csv --delta x -o x
  ;;
fit)
  power 1 1e-3 1 2000 | catalogue a.csv 120
  must_run fit a.csv --range 1e-3:1 --range 1e-3:0.1 --replicas 20 --json f.json -o f
  pictures f
  awk -F, '$1 == "lsm" { ++n; if ($6 < 0.99 || $6 > 1.01 || !($7 > 0.005 && $7 < 0.05)) exit 1 }
    END { exit n != 6 }' f.fits.csv || fail "exponents: $(cat f.fits.csv)"
  grep -q '"exponent": \(1.00\|0.99\)' f.json || fail "$(cat f.json)"
  grep -q '"rival": "log-normal"' f.json || fail "no rivals in $(cat f.json)"
  # The same seed gives the same answer.
  cp out.txt first.txt
  must_run fit a.csv --range 1e-3:1 --range 1e-3:0.1 --replicas 20 --json f.json -o f
  cmp first.txt out.txt || fail "two runs differ"
  must_run fit a.csv --replicas 0 --no-comparison -o s --no-picture
  grep -q 'searched' out.txt || fail "$(cat out.txt)"
  grep -q 'one line per rival' f.fits.csv || fail "rivals are not explained: $(cat f.fits.csv)"
  grep -q 'one line per rival' s.fits.csv && fail "rivals are explained, but there are none: $(cat s.fits.csv)"
  # The bin that contains the smallest size is no whole one.
  [ "$(awk -F, '/^[0-9]/ && $6 >= 0.8' a.csv | wc -l)" -gt 0 ] || fail "no large event to test with"
  refused 'no bin of sizes from 0.8 on has an event' fit a.csv --threshold 0.8 --replicas 0 --no-picture -o x
  # Roll-off at a size proportional to the length.
  for l in 100 200 400 800 1600; do
    power 1.2 1e-3 "$(awk -v l=$l 'BEGIN { print l / 100 }')" 3000 | catalogue g$l.csv $l
    power 1.2 1e-3 1 3000 | catalogue n$l.csv $l
  done
  must_run fit g100.csv g200.csv g400.csv g800.csv g1600.csv --range 1e-3:0.1 --replicas 0 --scaling --json g.json -o g
  pictures g.scaling
  grep -q 'grows with the length (' out.txt || fail "growth: $(cat out.txt)"
  d=$(awk '/"D":/ { gsub(/[",]/, ""); print $2 }' g.json)
  near "$d" 1 0.1 || fail "s* grows as L^$d, expected 1"
  must_run fit n100.csv n200.csv n400.csv n800.csv n1600.csv --range 1e-3:0.1 --replicas 0 --scaling --json n.json -o n
  grep -q 'shows no significant dependence' out.txt || fail "no growth: $(cat out.txt)"
  grep -q '"preferred": "no dependence on the length"' n.json || fail "$(cat n.json)"
  # Errors by blocks of time, of a length that can be given, or event by event.
  grep -q 'bootstrap errors, blocks of time' out.txt && told 'error if events were independent blocks' || fail "$(cat out.txt)"
  must_run fit g100.csv g200.csv --range 1e-3:0.1 --replicas 0 --scaling --block 1000 --json b.json -o b --no-picture
  awk -F, '!/^#/ && $1 == 1 && !($8 > 990 && $8 < 1010 && $9 == 30) { exit 1 }' b.scaling.csv || fail "--block: $(cat b.scaling.csv)"
  grep -q '"blocks": 30' b.json && grep -q '"error_independent": ' b.json || fail "$(cat b.json)"
  must_run fit g100.csv g200.csv --range 1e-3:0.1 --replicas 0 --scaling --block 0 -o b --no-picture
  grep -q 'single events as if independent' out.txt || fail "--block 0: $(cat out.txt)"
  awk -F, '!/^#/ && $1 == 1 && !($8 == 0 && $9 == 0 && $5 > 0.8 * $7 && $5 < 1.2 * $7) { exit 1 }' b.scaling.csv || fail "--block 0: $(cat b.scaling.csv)"
  refused "block 'long', expected 'auto' or a time of 0 or more" fit g100.csv --scaling --block long -o x
  refused 'block of 20000, expected 0 or .* to half of the catalogue' fit g100.csv --scaling --block 20000 -o x
  # Growth that does not follow a power law: s* of 1, 1, 1, 1, 16.
  sed 's/^# length.*/# length = 3200/' g1600.csv > n3200.csv
  must_run fit n100.csv n200.csv n400.csv n800.csv n3200.csv --range 1e-3:0.1 --replicas 0 --scaling -o p --no-picture
  grep -q 'grows with the length, but not as a power law' out.txt || fail "growth at the end: $(cat out.txt)"
  # Growth that ends: s* of 1, 2, 4, 4, 4, 4, 4.
  for l in 800 1600 3200 6400; do sed "s/^# length.*/# length = $l/" g400.csv > s$l.csv; done
  must_run fit g100.csv g200.csv g400.csv s800.csv s1600.csv s3200.csv s6400.csv --range 1e-3:0.1 --replicas 0 --scaling --json s.json -o s
  pictures s.scaling
  grep -q "growth up to L_c = " s.scaling.gp || fail "no curve of growth that ends: $(cat s.scaling.gp)"
  grep -q "growth up to L_c" g.scaling.gp n.scaling.gp && fail "a curve of growth that ends without such growth"
  grep -q 'grows with the length up to L_c only (' out.txt || fail "growth that ends: $(cat out.txt)"
  grep -q '"preferred": "growth that ends at a length"' s.json || fail "$(cat s.json)"
  near "$(awk '/"L_c":/ { gsub(/[",]/, ""); print $2 }' s.json)" 350 0.25 || fail "L_c: $(cat s.json)"
  near "$(awk '/"s_inf":/ { gsub(/[",]/, ""); print $2 }' s.json)" "$(awk -F, '$3 == 6400 { print $4 }' s.scaling.csv)" 0.03 || fail "s_inf: $(cat s.json)"
  must_run fit a.csv --range 1e-3:1 --replicas 0 --scaling -o o --no-picture
  grep -q 'degenerate: ' out.txt || fail "scaling of one catalogue: $(cat out.txt)"
  refused 'expected LO above 0' fit a.csv --range :1 -o x
  # Events left out below a size do not make the law flatter: the fit begins there.
  must_run fit a.csv --min-size 0.01 --range 1e-3:1 --range 1e-3:0.01 --replicas 0 --no-comparison -o m --no-picture
  awk -F, '$1 == "lsm" && $2 == 0.01 && $5 > 1300 { exit !($6 > 0.98 && $6 < 1.02) }' m.fits.csv || fail "$(cat m.fits.csv)"
  grep -q '^lsm,0.01,1,' m.fits.csv && grep -q 'only has events from 0.01' m.fits.csv || fail "$(cat m.fits.csv)"
  sed 's/^# length/# min_size = 0.01\n&/' a.csv | awk -F, '/^[#e]/ || $6 >= 0.01' > picked.csv
  must_run fit picked.csv --range 1e-3:1 --replicas 0 --no-comparison -o m --no-picture
  grep -q '^lsm,0.01,1,' m.fits.csv || fail "min_size of the header: $(cat m.fits.csv)"
  ;;
completeness)
  power 1 1e-3 1 1000 | catalogue plain.csv 120
  sed 's/^# length/# completeness = 0.01\n&/' plain.csv > known.csv
  sed 's/^# length = 120/# length = 240/' plain.csv > long.csv
  power 1 1e-3 1 1000 | catalogue s.csv 256 block-slider
  above=$(awk -F, '!/^[#e]/ && $6 >= 0.01 { ++n } END { print n }' plain.csv)
  [ "$above" -gt 600 ] && [ "$above" -lt 700 ] || fail "$above events from 0.01"
  # Without it as before.
  must_run histograms plain.csv -o p --no-picture
  grep -q "smallest size, fault: 0.0001, that of the paper" out.txt || fail "$(cat out.txt)"
  counts() { awk -F, -v curve="$2" '!/^#/ && $1 == curve { n += $7 } END { print n }' "$1"; }
  [ "$(counts p.csv 1)" = 1000 ] || fail "$(counts p.csv 1) events"
  # With it, for all faults and no slider.
  must_run histograms long.csv known.csv s.csv -o h --no-picture
  for place in out.txt h.csv; do
    grep -q 'smallest size, fault: 0.01, completeness in the header of known.csv' $place &&
      grep -q 'smallest size, block-slider: 0.0001, that of the paper' $place || fail "$(cat $place)"
  done
  [ "$(counts h.csv 1) $(counts h.csv 2) $(counts h.csv 3)" = "$above $above 1000" ] || fail "$(cat h.csv)"
  # A given value takes precedence.
  must_run histograms known.csv -o h --no-picture --threshold 0.001
  [ "$(counts h.csv 1)" = 1000 ] && grep -q '0.001, as given' out.txt || fail "--threshold: $(cat out.txt h.csv)"
  must_run histograms known.csv -o h --no-picture --range 0.001:
  [ "$(counts h.csv 1)" = 1000 ] || fail "--range 0.001: $(cat h.csv)"
  must_run histograms known.csv -o h --no-picture --range :1
  [ "$(counts h.csv 1)" = "$above" ] || fail "--range :1 $(cat h.csv)"
  must_run intervals known.csv -o i --no-picture --replicas 0
  told "sizes >= 0.01, completeness in the header of known.csv $((above - 1)) " || fail "$(cat out.txt)"
  grep -q '^# sizes >= 0.01, completeness in the header' i.csv && grep -q "^ours,0.01,$((above - 1))," i.table1.csv || fail "$(cat i.csv)"
  must_run intervals known.csv -o i --no-picture --replicas 0 --threshold 1e-4
  told "sizes >= 0.0001, as given 999 " || fail "$(cat out.txt)"
  must_run fit known.csv --replicas 0 --scaling -o f --no-picture --json f.json
  grep -q 'smallest size, fault: 0.01, completeness in the header' out.txt || fail "$(cat out.txt)"
  awk -F, '$1 == "lsm" && !($2 >= 0.01) { exit 1 }' f.fits.csv || fail "the search begins too low: $(cat f.fits.csv)"
  told "fault, length 120 120 $above " && grep -q '"threshold_from": "0.01, completeness' f.json || fail "scaling: $(cat out.txt f.json)"
  grep -q 'may depend on the time step' out.txt && fail "a note without a reason: $(cat out.txt)"
  must_run fit known.csv --replicas 0 --no-comparison --range 1e-3:1 -o f --no-picture
  grep -q '^lsm,0.001,1,no,1000,' f.fits.csv && grep -q 'below its completeness of 0.01' out.txt || fail "--range: $(cat out.txt)"
  must_run report known.csv s.csv --replicas 0 --interval-replicas 0 -o r.html
  grep -q "<td>$above from 0.01</td>" r.html && grep -q '<td>1000 from 0.0001</td>' r.html &&
    grep -q 'Smallest size, fault: 0.01, completeness in the header of known.csv' r.html || fail "the page"
  grep -q 'Sizes from 0.01\.' r.html && ! grep -q '<td>0.0001 to' r.html || fail "ranges of the page"
  sed 's/^# length/# completeness = small\n&/' plain.csv > bad.csv
  for command in histograms intervals fit report; do
    refused "bad.csv:3: completeness is 'small', expected a finite size of at least 0" $command bad.csv -o x
  done
  ;;
report)
  power 1 1e-3 1 500 | catalogue 'a<b&c.csv' 120
  power 1.2 1e-2 100 500 | catalogue s.csv 256 block-slider
  must_run report 'a<b&c.csv' s.csv --label 'x<y&"z"' --label s --replicas 5 -o r.html
  [ "$(grep -c '<svg' r.html)" -ge 4 ] || fail "fewer than four pictures"
  grep -q 'x&lt;y&amp;&quot;z&quot;' r.html || fail "label not escaped"
  grep -q 'x<y' r.html && fail "label let through"
  grep -Eq '(src|href)=.?(https?:|//)|@import|url\((https?:)?//' r.html && fail "the page asks for something outside it"
  for word in 'Fig. 12' 'Fig. 13' 'Fig. 14' 'Fig. 15' 'Table 1' '15.21' '100.0' '0.0573' '1.07'; do
    grep -q "$word" r.html || fail "no $word in the page"
  done
  # Identifiers are unique, references lead to one.
  grep -o " id=['\"][^'\"]*" r.html | sed "s/.*['\"]//" | sort > ids
  [ -s ids ] && [ -z "$(uniq -d ids)" ] || fail "identifiers: $(uniq -d ids)"
  grep -o "href=['\"]#[^'\"]*" r.html | sed 's/.*#//' | sort -u > references
  [ -z "$(comm -23 references <(sort -u ids))" ] || fail "references to nothing: $(comm -23 references ids)"
  for tag in table figure svg tr td th section div p ul li h2 h3; do
    [ "$(grep -o "<$tag[ >]" r.html | wc -l)" = "$(grep -o "</$tag>" r.html | wc -l)" ] || fail "<$tag> not closed"
  done
  # Each kind of event has its own words.
  grep -q 'Sizes are drops of the potential energy of the whole model' r.html || fail "no words on drops of PE"
  grep -q 'are ruptures' r.html && fail "words on ruptures about drops of PE"
  sed 's/^# length/# events = ruptures\n&/' 'a<b&c.csv' > r.csv
  must_run report r.csv --replicas 0 --interval-replicas 0 -o p.html
  grep -q 'Sizes are drops of the potential energy' p.html && fail "words on drops of PE about ruptures"
  grep -q '<h2>Fault: ruptures</h2>' p.html && grep -q 'those at the same time at different places stay apart' p.html &&
    grep -q 'that friction took on its part of the fault' p.html || fail "no words on ruptures"
  # Both kinds on one page: a section each.
  must_run report r.csv 'a<b&c.csv' --replicas 0 --interval-replicas 0 -o p.html
  grep -q '<h2>Fault</h2>' p.html && grep -q '<h2>Fault: ruptures</h2>' p.html && grep -q '<td>drops of PE</td>' p.html &&
    grep -q '<td>ruptures</td>' p.html || fail "not both kinds"
  # PE series: 90 steps up by 1 and 9 down by 10, or as many down as up; one that only rises.
  pe() { # FILE LENGTH UP DOWN
    awk -v length_="$2" -v up="$3" -v down="$4" 'BEGIN {
      print "# model = lsm\n# dt = 1\n# step0 = 0\n# time0 = 0\n# stride = 1"
      print "# length = " length_ "\n# picker = literal\n# lambda = 0\nstep,time,pe"
      for (i = 0; i <= 20 * (up + down) + 1; ++i) {
        printf "%d,%d,%.17g\n", i, i, x
        x += i % (up + down) < up ? 1 : down ? -up / down : 0 } }' | packed > "$1"
  }
  pe tooth.pe 120 90 9
  pe creep.pe 240 60 60
  pe rise.pe 480 10 0
  must_run report s.csv --series tooth.pe --series creep.pe --series rise.pe --replicas 0 --interval-replicas 0 -o p.html
  row() { grep "^<tr><th scope=\"row\">$1<" p.html | sed 's/<[^>]*>/|/g; s/||*/|/g'; }
  [ "$(row tooth.pe)" = '|tooth.pe|fault|120|0 to 1981|1982|20|stick-slip|10|3|10|0.09086|9|' ] || fail "row of tooth.pe: $(row tooth.pe)"
  [ "$(row creep.pe)" = '|creep.pe|fault|240|0 to 2401|2402|20|creep|1|2.41|1|0.4998|60|' ] || fail "row of creep.pe: $(row creep.pe)"
  row rise.pe | grep -q '480|0 to 201|202|.*|PE only rises' || fail "row of rise.pe: $(row rise.pe)"
  grep -q 'Stick-slip or creep' r.html && fail "a section without a series"
  # The window of time holds for the series, too.
  must_run report s.csv --series tooth.pe --from 495 --to 1485 --replicas 0 --interval-replicas 0 -o p.html
  row tooth.pe | grep -q '|495 to 1485|991|.*|stick-slip|10|' || fail "--from, --to: $(row tooth.pe)"
  refused 'samples in the window of time' report s.csv --series tooth.pe --from 5000 -o x.html
  refused 'is read by this command' report s.csv --series tooth.pe -o tooth.pe
  refused 'nowhere.pe: cannot open' report s.csv --series nowhere.pe -o x.html
  # Leaf springs of several stiffnesses have a picture of their own and no part in the scaling.
  for kl in 0.01 0.1; do sed "s/^# blocks.*/&\n# kl = $kl/" s.csv > "kl$kl.csv"; done
  must_run report kl0.01.csv kl0.1.csv kl0.01.csv --replicas 0 --label a --label b --label c -o k.html
  grep -q 'Fig. 7' k.html || fail "no Fig. 7"
  [ "$(grep -c '<th scope="row">b</th><td>256</td>' k.html)" = 0 ] || fail "another stiffness in the scaling"
  [ "$(grep -c '<th scope="row">c</th><td>256</td>' k.html)" = 1 ] || fail "no scaling of the common stiffness"
  grep -q 'Fig. 7' r.html && fail "Fig. 7 of one stiffness"
  # Each kind of event has its own words, and a scaling of its own.
  sed 's/^# blocks.*/&\n# events = ruptures/' s.csv > ruptures.csv
  must_run report ruptures.csv --replicas 0 -o u.html
  grep -q 'Events are ruptures: connected in space and time' u.html || fail "no words on ruptures"
  grep -q 'drops of the potential energy' u.html && fail "words on drops of PE on a page of ruptures"
  grep -q 'drops of the potential energy' r.html || fail "no words on drops of PE"
  must_run report s.csv ruptures.csv --replicas 0 --label a --label b -o u.html
  [ "$(grep -c 'Events are ruptures: connected' u.html) $(grep -c 'drops of the potential energy' u.html)" = "1 1" ] ||
    fail "both kinds of event in one scaling"
  # No range begins below the threshold.
  must_run report 'a<b&c.csv' --threshold 2e-3 --replicas 0 -o t.html
  grep -q '<td>0.002 to 0.01</td>' t.html || fail "range of the fault"
  grep -q '<td>0.0001 to' t.html && fail "a range below the threshold"
  must_run report 'a<b&c.csv' --threshold 0.1 --replicas 0 -o t.html
  grep -q ' to 0.01</td>' t.html && fail "a range below the threshold"
  # Without gnuplot an older page stays.
  cp r.html before.html
  PATH=/nonexistent "$program" report s.csv -o r.html 2> err.txt && fail "a report without gnuplot"
  grep -q 'gnuplot not found' err.txt || fail "$(cat err.txt)"
  cmp r.html before.html || fail "the older page is gone"
  ;;
seismology)
  power 1.7 1e-3 1e3 2000 | catalogue a.csv 120
  power 1.2 1e-3 1e3 2000 | catalogue b.csv 240
  must_run magnitudes a.csv b.csv --threshold 1e-3 --label 'a_{x}' --label b -o m
  pictures m
  grep -q 'b = 1.' m.gp && grep -qF 'a_{x} (2000 events)' m.svg || fail "titles: $(grep title m.gp)"
  must_run aftershocks a.csv b.csv -o s --replicas 10
  pictures s
  grep -q filledcurves s.gp || fail "no band of Poisson catalogues"
  refused 'nothing to draw' magnitudes a.csv --min-size 1e9 -o x
  refused 'expected at least 2' aftershocks a.csv --min-size 1e9 -o x
  ;;
few)
  # No event, one, and a few: what cannot be said is said to be degenerate.
  : | catalogue none.csv 120
  echo 5 0.01 | catalogue one.csv 120
  awk 'BEGIN { for (i = 0; i < 6; ++i) print i * i, 0.01 * (i + 1) }' | catalogue few.csv 240
  refused 'nothing to draw' histograms none.csv -o x
  refused 'nothing to draw' intervals none.csv -o x
  refused 'nothing to draw' intervals one.csv -o x
  must_run histograms one.csv -o h1
  pictures h1
  must_run histograms few.csv none.csv -o h
  grep -q 'no curve' err.txt || fail "nothing is said of the empty catalogue: $(cat err.txt)"
  must_run intervals few.csv one.csv -o i
  pictures i
  [ "$(grep -c '^ours' i.table1.csv)" = 8 ] || fail "$(cat i.table1.csv)"
  grep -q '^"fault, length 120",0.0001,0,,,' i.clustering.csv || fail "times of no events: $(cat i.clustering.csv)"
  awk -F, '$1 == "ours" && ($4 $6 $8 $10 != "" || $NF == "") { exit 1 }' i.table1.csv || fail "numbers of degenerate fits"
  must_run fit few.csv --range 1e-3:1 -o f
  grep -q 'degenerate' out.txt || fail "$(cat out.txt)"
  # No characteristic size in any catalogue: no picture of the scaling, the rest is there.
  must_run fit one.csv few.csv --scaling -o z
  pictures z
  grep -q 'no picture of the scaling' err.txt || fail "nothing is said of the scaling: $(cat err.txt)"
  [ "$(grep -c 'at least 10 needed' out.txt)" = 2 ] || fail "$(cat out.txt)"
  [ -e z.scaling.csv ] && fail "a table without a picture"
  must_run report none.csv one.csv few.csv -o r.html
  grep -q 'degenerate: ' r.html || fail "no degenerate fit in the page"
  grep -Eq '>-?nan|>inf' r.html && fail "NaN or infinity in the page"
  must_run report none.csv -o e.html
  grep -q 'no events' e.html || fail "the empty catalogue is not said to be empty"
  ;;
names)
  # Whatever a name or a label holds, nothing is run and all is drawn.
  power 1.2 1e-3 10 300 | catalogue a.csv 120
  power 1.2 1e-3 10 300 | catalogue b.csv 240
  ruptures > r.csv
  awk 'BEGIN { print "# model = lsm\n# dt = 1\n# step0 = 0\n# time0 = 0\n# stride = 1"
    print "# length = 40\n# picker = literal\n# lambda = 0\nstep,time,pe"
    for (i = 0; i <= 2000; ++i) { printf "%d,%d,%.17g\n", i, i, x; x += i % 99 < 90 ? 1 : -10 } }' | packed > pe.bin
  draw() { # COMMAND OUTPUT [OPTION...]: every command that draws, with as little work as it can do
    local command=$1 output=$2
    shift 2
    case $command in
    histograms) must_run histograms a.csv b.csv "--output=$output" "$@" ;;
    intervals) must_run intervals a.csv b.csv --replicas 0 "--output=$output" "$@" ;;
    fit) must_run fit a.csv b.csv --replicas 0 --scaling --bootstrap 2 --range 1e-2:1 "--output=$output" "$@" ;;
    magnitudes) must_run magnitudes a.csv b.csv --threshold 1e-3 "--output=$output" "$@" ;;
    aftershocks) must_run aftershocks a.csv b.csv --replicas 0 "--output=$output" "$@" ;;
    rupture) must_run rupture r.csv r.csv "--output=$output" "$@" ;;
    spectrum) must_run spectrum pe.bin "--output=$output" ;;
    series) must_run series pe.bin "--output=$output" ;;
    esac
  }
  commands="histograms intervals fit magnitudes aftershocks rupture spectrum series"
  for command in $commands; do
    outputs=("<touch marker;cat y" "|touch marker")
    [ $command != histograms ] || outputs+=(-x --version "-e '1'" + - "a'b" 'a"b' '`touch marker`' '$(touch marker)' "#a" '~' "a\\" '{' 'ä b')
    for output in "${outputs[@]}"; do
      before=$(ls -A | wc -l)
      draw $command "$output"
      [ -e marker ] && fail "$command -o '$output' ran a command"
      case $command in
      rupture) pictures "$output-length" ;;
      series) pictures "$output"; [ -s "$output-events.csv" ] || fail "no events of series -o '$output'" ;;
      *) pictures "$output" ;;
      esac
      [ "$(ls -A | wc -l)" -gt "$before" ] || fail "$command -o '$output' wrote nothing here"
      rm -f -- "$output".* "$output"-*
    done
  done
  # The first is 'old' as a quotation; the others are what else strings, markup and tables stumble over.
  for label in "'old' run" "run ''" "''" '"q" "' '#1' '}{' '`touch marker`' "a\\" '@a &b ~c ^{d}_e' '%d $1 \n'; do
    for command in histograms intervals fit magnitudes aftershocks rupture; do
      [ "$label" = "'old' run" ] || [ $command = histograms ] || continue
      draw $command l --label "$label" --label other
      [ -e marker ] && fail "label $label of $command ran a command"
      page=l.svg
      [ $command != rupture ] || page=l-length.svg
      sed 's/&lt;/</g; s/&gt;/>/g; s/&quot;/"/g; s/&amp;/\&/g' $page | grep -qF -- "$label" || fail "label $label is not in $page"
    done
    must_run report a.csv --label "$label" --replicas 0 --interval-replicas 0 --bootstrap 2 -o l.html
    sed 's/&lt;/</g; s/&gt;/>/g; s/&quot;/"/g; s/&#39;/'"'"'/g; s/&amp;/\&/g' l.html | grep -qF -- "$label" || fail "label $label is not on the page"
  done
  ;;
rupture)
  # slope VALUE LINE FILE: the line says that slope, to rounding, and a scatter of as little
  slope() {
    grep "$2" "$3" | sed -E 's/.*slope ([0-9.e-]+) .*, scatter ([0-9.e-]+) decades \(n.*/\1 \2/' |
      awk -v slope="$1" '{ ok = ($1 - slope) ^ 2 < 1e-24 && $2 < 1e-12 } END { exit !ok }'
  }
  ruptures > a.csv
  must_run rupture a.csv --label a -o r
  for name in lengths moments length pe stress; do pictures r-$name; done
  # Lengths 1 to 39 once each, and 40, 30, 25, 120: 43 in all; 8 from 25 to 30; T = 495.
  awk -F, '!/^#/ && !/^curve/ { n += $6; if ($3 == 24.5 && $6 != 8) exit 1
    d = $6 / (495 * 120 * ($4 - $3)); if (($7 - d) ^ 2 > 1e-18 * d * d) exit 1 } END { exit n != 43 }' r-lengths.csv ||
    fail "densities of lengths: $(cat r-lengths.csv)"
  told '^ a 43 ' || fail "$(cat out.txt)"
  # Of the lengths below that of the fault: slope 2 without scatter.
  slope 2 '^# fit, without those of the whole fault: ' r-length.csv || fail "$(head -3 r-length.csv)"
  [ "$(awk -F, '$6 == 1' r-length.csv | wc -l)" = 1 ] || fail "ruptures of the whole fault"
  # PE rose during one; of the others but those with another one beside them the drop is 0.05 times the moment.
  grep -q '^# PE rose during 1 of 43 ruptures' r-pe.csv || fail "$(head -5 r-pe.csv)"
  slope 1 '^# fit of those isolated in time: .*n = 40.*ratio 0.05, scatter' r-pe.csv || fail "$(head -5 r-pe.csv)"
  awk -F, '!/^#/ && $6 == 0 { ++n; if ($4 != 160 && $4 != 90 && $4 != 62.5) exit 1 } END { exit n != 3 }' r-pe.csv ||
    fail "ruptures at the same time: $(awk -F, '$6 == 0' r-pe.csv)"
  grep -q 'means of half decades' r-stress.svg || fail "no means"
  must_run rupture a.csv a.csv --label one --label two --no-picture -o t
  [ "$(awk -F, '$2 == "two"' t-length.csv | wc -l)" = 43 ] || fail "two catalogues"
  cut -d, -f1-11 a.csv > short.csv
  refused 'short.csv: no catalogue of ruptures of a fault' rupture short.csv -o x
  echo 5 0.01 | catalogue plain.csv 120
  refused 'plain.csv: no catalogue of ruptures of a fault' rupture plain.csv -o x
  # Of the places 15, 45, 75 and 105 only 75 is reached by more than the one rupture of the whole fault: by 28.
  must_run intervals a.csv --threshold 0 --places 4 --no-picture -o p
  told ' 27 [0-9.]* model time' && grep -q 'times at 4 places each' out.txt || fail "$(cat out.txt)"
  refused 'plain.csv: times at places: no columns x_begin and rupture_length' intervals plain.csv --places 4 -o x
  refused '--places' intervals a.csv --places -1 -o x
  refused 'a.csv: not a slip history' rupture a.csv --history a.csv -o x
  head -6 a.csv > two.csv
  refused 'expected at least 3' rupture two.csv -o x
  ;;
*) fail "no case '$2'" ;;
esac
echo "$2: passed"
