#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Ruptures of inputs/fault_3d.in in fault_3d/: numbers of sentences (page_values.py), and the figure fault_3d.png, .svg.

fault_3d.py                         draws the figure
fault_3d.py HISTORY EVENT RUPTURES  writes fault_3d/event.csv: slip of a rupture, by its number, from the slip history of its run

fault_3d/patches.csv: places and radii of the patches of each seed, as the logs of the runs print them.
"""
import math
import sys
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent / "python"))
import lsm  # noqa: E402
from lsm.drawing import draw  # noqa: E402
from lsm.history import History  # noqa: E402
from values import Value  # noqa: E402

DATA, SEEDS = FOLDER / "fault_3d", (1, 2)
LOWER = 1e-5, 3e-5, 1e-4, 3e-4  # beside LEAST, to see how much it decides
LEAST = 1e-3  # moment from which magnitudes count: above that of the smallest patch
PATCH = math.pi * 4**2  # area of the smallest patches
NODES = 10  # smallest area of ruptures that are drawn as lines
CIRCLE = 16 / 7 / math.pi**1.5  # moment of a circular crack over stress drop and area^1.5, for a Poisson ratio of 1/4


def ruptures(seed):
    return lsm.read_catalogue(DATA / f"seed_{seed}.ruptures.csv.xz")


def b_value(moment, least):
    """Of magnitudes of moments from `least` on (Aki 1965), and of how many."""
    large = moment[moment >= least]
    return 1.5 / np.log(large / least).mean(), len(large)


def all_values():
    """Counts, b of magnitudes of moments, and moment over that of a circular crack; half: those of patches of one size at half the spacing."""
    source, lower = "fault_3d/seed_*.ruptures.csv.xz", []
    for seed in SEEDS:
        rows = ruptures(seed)
        moment, area = rows["slip_moment"], rows["rupture_area"]
        yield Value(f"plane.ruptures.{seed}", len(rows), source=source)
        b, n = b_value(moment, LEAST)
        yield Value(f"plane.b.{seed}", b, b / math.sqrt(n), n=n, source=source)
        lower += [b_value(moment, least)[0] for least in LOWER]
        some = area >= PATCH
        over = moment[some] / (CIRCLE * rows["stress_drop"][some] * area[some]**1.5)
        yield Value(f"plane.crack.{seed}", np.median(over), n=int(some.sum()), source=source)
    yield Value("plane.b_lower.least", min(lower), n=len(lower), source=source)
    yield Value("plane.b_lower.most", max(lower), n=len(lower), source=source)
    source = "fault_3d/spacing_*.ruptures.csv.xz"
    half, whole = (lsm.read_catalogue(DATA / f"spacing_{name}.ruptures.csv.xz") for name in ("half", "whole"))
    over, under = (np.median(rows["slip_moment"][rows["rupture_area"] >= PATCH]) for rows in (half, whole))
    yield Value("plane.half.moment", 1 - over / under, source=source)
    yield Value("plane.whole.small", int((whole["rupture_area"] < PATCH).sum()), n=len(whole), source=source)


def write_event(history, number, path):
    """Slip of the rupture in each bin."""
    one = next(row for row in lsm.read_catalogue(path) if row["event_id"] == int(number))
    history = History(history)
    slip = history.records["slip"][history.of(one), ..., 0].sum(axis=0)
    with open(DATA / "event.csv", "w", encoding="utf-8") as out:
        out.write("x,z,slip\n")
        out.writelines(f"{x:g},{z:g},{value:.4g}\n" for x, row in zip(history.x, slip) for z, value in zip(history.z, row))


SCRIPT = """set multiplot layout 2,2 spacing 0.12,0.13
unset key
set size ratio -1
set xrange [-32:32]; set yrange [-64:0]
set xlabel 'along strike'; set ylabel 'along dip'; set cblabel 'slip'
set palette defined (0 '#ffffff', 0.3 '#fdd49e', 0.6 '#ef6548', 1 '#7f0000')
set cbrange [0:*]; set format cb '%.0e'
set title 'slip of one rupture; circles: patches'
set datafile separator comma
plot base.'/event.csv' skip 1 using 1:2:3 with image, base.'/patches.csv' skip 1 using ($1 == 1 ? $2 : 1/0):3:4 with circles lc rgb '#444444', \\
 for [s in '-64 64'] base.'/patches.csv' skip 1 using ($1 == 1 ? $2+s : 1/0):3:4 with circles lc rgb '#444444', \\
 for [s in '-64 64'] base.'/patches.csv' skip 1 using ($1 == 1 ? $2 : 1/0):($3+s):4 with circles lc rgb '#444444'
set size noratio
set autoscale
set logscale xy; set format xy '10^{%L}'
set xlabel 'area'; set ylabel 'moment'; set title 'line: circular crack, median stress drop'
plot table index 0 using 3:4 with points lt 1 ps 0.5, table index 1 using 3:4 with points lt 2 ps 0.5, [30:4096] DROP*x**1.5 lc black
set xlabel 'moment'; set ylabel 'ruptures of at least this moment'; set title 'broken line: b = 1'
plot table index 0 using 4:5 smooth unique with steps lt 1, table index 1 using 4:5 smooth unique with steps lt 2, [1e-3:0.06] x**(-2./3) lc black dt 2
unset logscale; set format xy '%g'
set xlabel 'time'; set ylabel 'along strike'; set title 'seed 1; lines: ruptures of 10 nodes and more'
set yrange [-32:32]; set xtics 1000; set clip two
plot for [s in '0 -64'] table index 0 using 1:($3 >= NODES ? $2+s : 1/0):(0):6 with vectors nohead lt 1, table index 0 using 1:2 with dots lt 2
unset multiplot"""


def figure():
    drops, path = [], DATA.parent / "fault_3d.csv"
    with open(path, "w", encoding="utf-8") as out:
        out.write("# time,begin along strike,area,moment,ruptures of at least this moment,length along strike\n")
        for seed in SEEDS:
            rows = ruptures(seed)
            rank = len(rows) - np.argsort(np.argsort(rows["slip_moment"], kind="stable"), kind="stable")
            for row, n in zip(rows, rank):
                begin = row["x_hypocentre"] if row["rupture_area"] < NODES else row["x_begin"]
                cells = (row["t_start"], begin, row["rupture_area"], row["slip_moment"], n, row["rupture_length"])
                out.write(",".join(f"{cell:.5g}" for cell in cells) + "\n")
            drops += list(rows["stress_drop"][rows["rupture_area"] >= 50])
            out.write("\n\n")
    script = SCRIPT.replace("DROP", f"{CIRCLE * float(np.median(drops)):.4g}").replace("NODES", str(NODES))
    draw(DATA.parent / "fault_3d", script, 1000, 850)


if __name__ == "__main__":
    if len(sys.argv) not in (1, 4):
        sys.exit(__doc__)
    if len(sys.argv) == 4:
        write_event(*sys.argv[1:])
    else:
        figure()
