#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Publishes catalogues in results: compressed and, as their header says, without the smallest events.

publish.py [--ruptures SIZE] OUT FOLDER...

OUT/NAME.catalogue.csv.xz has the events >= 1e-4 of each folder NAME of a study of faults,
OUT/NAME.ruptures.csv.xz the ruptures >= SIZE (1e-3) if there are any. The header of a long fault has the size from
which it is complete, which is larger than that in fault.in.
"""
import lzma
import sys
from pathlib import Path

EVENTS, RUPTURES = 1e-4, 1e-3
# Length of a fault, and size from which the number of its events does not depend on the steps of the picker: results/calibration-tables.md
COMPLETE = ((900, "1e-3"), (480, "3e-4"))


def complete(line, length):
    """Header line with the size above which the catalogue of a fault of this length is complete."""
    for shortest, size in COMPLETE:
        if length >= shortest and float(line.split("=")[1]) < float(size):
            return f"# completeness = {size}\n"
    return line


def publish(source, out, least=EVENTS):
    """A catalogue without events smaller than `least`; all other lines are unchanged."""
    kept, length = [], 0.0
    for line in Path(source).read_text().splitlines(keepends=True):
        if line.startswith("# min_size = "):
            line = f"# min_size = {least:g}\n# thinned = sizes below {least:g} left out\n"
        elif line.startswith("# length = "):
            length = float(line.split("=")[1])
        elif line.startswith("# completeness = "):
            line = complete(line, length)
        elif line[0] not in "#e" and float(line.split(",")[5]) < least:
            continue
        kept.append(line)
    Path(out).write_bytes(lzma.compress("".join(kept).encode(), preset=9))


def main(out, folders, ruptures=RUPTURES):
    Path(out).mkdir(parents=True, exist_ok=True)
    for folder in map(Path, folders):
        publish(folder / "fault.catalogue.csv", Path(out) / f"{folder.name}.catalogue.csv.xz")
        if (folder / "fault.ruptures.csv").exists():
            publish(folder / "fault.ruptures.csv", Path(out) / f"{folder.name}.ruptures.csv.xz", ruptures)


if __name__ == "__main__":
    words, least = sys.argv[1:], RUPTURES
    if words[:1] == ["--ruptures"] and len(words) > 1:
        words, least = words[2:], float(words[1])
    if len(words) < 2:
        sys.exit(__doc__)
    main(words[0], words[1:], least)
