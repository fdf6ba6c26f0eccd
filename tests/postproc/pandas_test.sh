#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# The lines of Python in postproc/README.md read what the programs write: pandas_test.sh SLIDER_CLI README
# shellcheck source=tests/from_outside.sh
source "$(dirname "${BASH_SOURCE[0]}")/../from_outside.sh" "$1"
readme=$2
# Debian's package belongs to Debian's Python, which need not be the first one found.
for python in python3 /usr/bin/python3 none; do
  "$python" -c 'import pandas' 2> /dev/null && break
done
if [ $python = none ]; then
  echo "skipped: no pandas (Debian package python3-pandas)"
  exit 77
fi
settings=(--blocks 100 --dt 0.05 --velocity 0.05 --warmup 0 --steps 100000 --pe-stride 10 --columns centroid,length)
must_run "${settings[@]}" --catalogue catalogue.csv --pe-series series.txt
must_run "${settings[@]}" --catalogue again.csv --pe-series series.bin --pe-format binary
sed -n '/^```python$/,/^```$/{/^```/!p}' "$readme" > lines.py
[ "$(wc -l < lines.py)" = 5 ] || fail "$(wc -l < lines.py) lines of Python in $readme, expected 5"
cat lines.py - > read.py << 'END'
def rows(path):
    lines = [line.rstrip("\n") for line in open(path) if not line.startswith("#")]
    return lines[0].split(","), [line.split(",") for line in lines[1:]]
names, values = rows("catalogue.csv")
assert list(events.columns) == names, events.columns
assert len(events) == len(values) >= 10, len(events)
for i, name in enumerate(names):
    assert [float(row[i]) for row in values] == [float(x) for x in events[name]], name
names, values = rows("series.txt")
assert list(series.columns) == names and len(series) == len(values) == 10001, len(series)
assert [float(row[2]) for row in values] == list(series["pe"])
assert list(binary["step"]) == list(series["step"]) and list(binary["pe"]) == list(series["pe"])
print(len(events), "events,", len(series), "samples: passed")
END
"$python" read.py || fail "the lines of the README"
