#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# The lines of Python in inputs/python.md read catalogues and series: pandas_test.sh SLIDER_CLI PAGE
# shellcheck source=tests/from_outside.sh
source "$(dirname "${BASH_SOURCE[0]}")/../from_outside.sh" "$1"
page=$2
# Debian's package belongs to Debian's Python, which need not be the first one found.
for python in python3 /usr/bin/python3 none; do
  "$python" -c 'import pandas' 2> /dev/null && break
done
if [ $python = none ]; then
  echo "skipped: no pandas (Debian package python3-pandas)"
  exit 77
fi
settings=(--blocks 100 --dt 0.05 --velocity 0.05 --warmup 0 --steps 100000 --pe-stride 10 --columns centroid,length)
must_run "${settings[@]}" --catalogue fault.catalogue.csv --pe-series fault.pe.bin
# The block of Python behind the comment that names this script
sed -n '/^<!-- run by .*pandas_test.sh/,/^```$/{/^<!--/d;/^```/d;p}' "$page" > lines.py
grep -q '^series = ' lines.py || fail "no lines of Python for this test in $page"
cat lines.py - > read.py << 'END'
import struct

def rows(path):
    lines = [line.rstrip("\n") for line in open(path) if not line.startswith("#")]
    return lines[0].split(","), [line.split(",") for line in lines[1:]]
names, values = rows("fault.catalogue.csv")
assert list(events.columns) == names, events.columns
assert len(events) == len(values) >= 10, len(events)
for i, name in enumerate(names):
    assert [float(row[i]) for row in values] == [float(x) for x in events[name]], name
values = list(struct.iter_unpack("<qd", records))
assert sorted(series.columns) == ["pe", "step", "time"] and len(series) == len(values) == 10001, len(series)
assert values == list(zip(series["step"], series["pe"])), "series"
assert np.allclose([0.05 * step for step, pe in values], series["time"], rtol=1e-12)
print(len(events), "events,", len(series), "samples: passed")
END
"$python" read.py || fail "the lines of the page"
