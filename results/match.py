#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""How many events of one catalogue are found in another, with about the same start and size, each counted once †.

match.py FIRST SECOND --threshold SIZE --within SLIP [--from TIME] [--origin TIME] [--to SLIP] [--json FILE]

Times are displacements of one plate, velocity times the time since --origin. In order of time each event of the first takes the
nearest one of the second that is still free, starts within --within and differs in size by less than a factor of 2. By chance:
mean over cyclic shifts of the first by 1 to 7 eighths of the time that both have. Events that start before --from are left out. For the
studies slow-driving and whole-job.
"""
import argparse
import math
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from lsm.analysis import events_of  # noqa: E402
from lsm.program import run  # noqa: E402
from lsm.tables import write_json  # noqa: E402

SHIFTS = 7


def displacements_of(path, origin=0.0, end=math.inf, begin=-math.inf):
    """Starts and sizes of the events, and the end of the last, as displacements. \\raises ValueError"""
    events = events_of(path)
    velocity = abs(float(events.header.get("velocity", 0)))
    if not velocity > 0:
        raise ValueError(f"{path}: no velocity in the header, expected one")
    events = events[(events["t_start"] * velocity < end) & (events["t_start"] >= begin)]
    if not len(events):
        raise ValueError(f"{path}: a catalogue without events, expected some")
    return (events["t_start"] - origin) * velocity, events["size"], (events["t_end"].max() - origin) * velocity


def count_matches(first, second, within):
    """first, second: starts and sizes, in order of time."""
    taken, found = set(), 0
    for start, size in zip(*first):
        near = range(*np.searchsorted(second[0], [start - within, start + within]))
        near = [k for k in near if k not in taken and abs(second[0][k] - start) < within and abs(math.log(second[1][k] / size)) < math.log(2)]
        if near:
            found += 1
            taken.add(min(near, key=lambda k: abs(second[0][k] - start)))
    return found


def matches(first, second, least, within):
    """Numbers of events in the time that both have, and of those in both. first, second: as displacements_of(). \\raises ValueError"""
    begin, end = max(first[0][0], second[0][0]), min(first[2], second[2])
    if not end > begin:
        raise ValueError("the catalogues have no time in common")
    pair = []
    for starts, sizes, _ in first, second:
        used = (sizes >= least) & (starts >= begin) & (starts < end)
        pair.append((starts[used], sizes[used]))
    (starts, sizes), other = pair
    chance = 0.0
    for k in range(1, SHIFTS + 1):
        shifted = starts + (end - begin) * k / (SHIFTS + 1)
        shifted = np.where(shifted >= end, shifted - (end - begin), shifted)
        order = np.argsort(shifted, kind="stable")
        chance += count_matches((shifted[order], sizes[order]), other, within) / SHIFTS
    return dict(smallest_size=least, n_first=len(starts), n_second=len(other[0]), same=count_matches(*pair, within), chance=chance)


def main(first, second, threshold, within, origin, begin, end, json_file):
    found = matches(*(displacements_of(path, origin, end, begin) for path in (first, second)), threshold, within)
    write_json(json_file, matches=[dict(first=first, second=second) | found])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first", metavar="FIRST")
    parser.add_argument("second", metavar="SECOND")
    parser.add_argument("--threshold", metavar="SIZE", type=float, required=True)
    parser.add_argument("--within", metavar="SLIP", type=float, required=True)
    parser.add_argument("--from", metavar="TIME", type=float, dest="begin", default=-math.inf)
    parser.add_argument("--origin", metavar="TIME", type=float, default=0.0)
    parser.add_argument("--to", metavar="SLIP", type=float, dest="end", default=math.inf)
    parser.add_argument("--json", metavar="FILE", dest="json_file")
    run(main, parser)
