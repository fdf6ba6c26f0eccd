#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the tables of this folder's pages from the catalogues in it.

tables.py POSTPROC          says which tables are not what the catalogues give; exit status 1 if there is one
tables.py POSTPROC --write  writes them into the pages

A table stands between the lines <!-- table NAME --> and <!-- end -->.
"""
import csv
import difflib
import re
import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent / "studies"))
import calibrate  # noqa: E402

POINTS, SLIDERS = FOLDER / "calibration/points.csv.xz", FOLDER / "calibration/sliders.csv.xz"
LOADING = "4500"  # time units that are left out: compression, and PE rising for the first time
SIZES = ("0.0001", "0.001", "0.01", "0.1")


def summary(postproc, paths, *words):
    """Rows of postproc summary, with the path of each catalogue."""
    said = subprocess.run([postproc, "summary", *paths, "--from", LOADING, "--parameter", "length", "seed", *words],
                          check=True, capture_output=True, text=True).stdout
    rows = list(csv.DictReader(line for line in said.splitlines() if not line.startswith("#")))
    for path, row in zip(paths, rows):
        row["path"] = path
    return rows


def value(row, key, digits):
    return f"{float(row[key]):.{digits}f}" if row[key] else "-"


def with_error(row, key, error, digits=2):
    return f"{value(row, key, digits)} ± {value(row, error, digits)}" if row[key] else "-"


def order(row):
    return float(row["length"]), int(row["seed"])


def sizes_and_times(rows):
    head = ["length", "seed", "time units", "events from 1e-4", "1e-3", "1e-2", "of 3 steps or less", "exponent 1e-4 to 0.1",
            "1e-3 to 1", "largest", "gamma from 1e-4", "1e-3", "1e-2", "0.1", "mean time from 1e-4", "1e-3", "1e-2", "0.1"]
    return calibrate.table(head, [[row["length"], row["seed"], value(row, "time", 0)] + [row[f"events_{s}"] for s in SIZES[:3]] +
                        [f"{100 * float(row['brief']):.1f} %", with_error(row, "exponent_1e-4:1e-1", "error_1e-4:1e-1"),
                         with_error(row, "exponent_1e-3:1", "error_1e-3:1"), value(row, "largest", 2)] +
                        [with_error(row, f"gamma_{s}", f"gamma_error_{s}") for s in SIZES] +
                        [value(row, f"mean_time_{s}", 0) for s in SIZES] for row in sorted(rows, key=order)])


def faults(postproc, pattern):
    return sizes_and_times(summary(postproc, sorted(map(str, FOLDER.glob(pattern)))))


TABLES = {
    "statements": lambda _: calibrate.statements_table(POINTS),
    "pairs": lambda _: calibrate.pairs_table(POINTS),
    "ranges": lambda _: calibrate.ranges_table(POINTS),
    "accepted": lambda _: calibrate.accepted_table(POINTS),
    "sliders": lambda _: calibrate.slider_table(SLIDERS),
    "campaign": lambda postproc: faults(postproc, "catalogues/fault_[0-9]*.catalogue.csv.xz"),
    "validation": lambda postproc: faults(postproc, "calibration/fault_*.catalogue.csv.xz"),
}


def main(postproc, write):
    wrong = 0
    for page in sorted(FOLDER.glob("*.md")):
        text = page.read_text()

        def replace(match):
            if match[1] not in TABLES:
                sys.exit(f"{page.name}: table {match[1]}, expected one of {', '.join(TABLES)}")
            return f"<!-- table {match[1]} -->\n\n{TABLES[match[1]](postproc)}\n\n<!-- end -->"
        new = re.sub(r"<!-- table (\S+) -->.*?<!-- end -->", replace, text, flags=re.S)
        if new == text:
            continue
        if write:
            page.write_text(new)
            continue
        wrong = 1
        print("\n".join(difflib.unified_diff(text.splitlines(), new.splitlines(), page.name, "from the catalogues", lineterm="")))
    return wrong


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--write"]):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], len(sys.argv) == 3))
