#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The three faults beside each other: what the article says of them, from the published catalogues and the CSV files beside this file. †

faults.py                  writes values.csv, the CSV files of the published catalogues, and their figures

Leaky: soft contacts, and plates that let part of the waves out. Reflecting: plates that reflect, hardly any damping. Absorbing:
blocks that take up waves. All rates are of 1000 time units; errors are standard errors over packings, of one packing those of ten
parts of its time. A drop counts as slip if its excess (lsm.slip) is above 0.5.
"""
import functools
import math
import re
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent / "python"))
import lsm  # noqa: E402
import values  # noqa: E402
from lsm import LOADING, slip  # noqa: E402
from lsm.analysis import mean_and_error  # noqa: E402
from lsm.drawing import draw  # noqa: E402
from lsm.tables import write_table  # noqa: E402
from values import Value  # noqa: E402

LENGTHS = (120, 240, 480, 945, 1440, 1890)
SIZES = (1e-4, 1e-3, 1e-2, 1e-1)
PARTS = 10  # of the time of a run, for errors of single packings
PAPER = 1000 / 15.2  # drops in 1000 time units, of its B
PUBLISHED = {
    "leaky": ("faults/leaky", "slip/fault"), "reflecting": ("faults/reflecting", "damping/fault"),
    "absorbing": ("faults/absorbing", "damping/damped", "campaign/fault")
}
FAULTS = tuple(PUBLISHED)


class Run(NamedTuple):
    path: Path
    fault: str
    length: int
    packing: int
    events: lsm.Table  # from LOADING on

    @property
    def time(self):
        """Time counted, in 1000 units."""
        return (self.events["t_end"].max() - LOADING) / 1000

    def number(self, key):
        return float(self.events.header[key])


@functools.cache
def loaded(path):
    events = lsm.read_catalogue(path)
    return events[events["t_start"] >= LOADING]


@functools.cache
def runs_of(fault, length, kind="catalogue", column="size"):
    """Runs that recorded this column, of each packing the longest."""
    found = {}
    for prefix in PUBLISHED[fault]:
        for path in FOLDER.glob(f"{prefix}_{length}_*.{kind}.csv.xz"):
            events, packing = loaded(path), int(path.name.split(".")[0].split("_")[-1])
            if column in events.dtype.names:
                run = Run(path, fault, length, packing, events)
                found[packing] = max(found.get(packing, run), run, key=lambda one: one.time)
    return [found[packing] for packing in sorted(found)]


def parts_of(run):
    """The part of the time in which each event begins."""
    return np.minimum((run.events["t_start"] - LOADING) / (1000 * run.time / PARTS), PARTS - 1).astype(int)


def rate_of(run, chosen):
    """Of the events that are chosen, in 1000 time units, with the error that its parts show."""
    counts = np.bincount(parts_of(run)[chosen], minlength=PARTS) * PARTS / run.time
    return np.mean(counts), np.std(counts, ddof=1) / math.sqrt(PARTS)


def over(runs, measure):
    """Mean and standard error over packings of a measure of runs that gives a number and its error."""
    found = [measure(run) for run in runs]
    return mean_and_error(*zip(*found)) if found else (math.nan, math.nan)


@functools.cache
def excess_of(path):
    return slip.excess_of(loaded(path))[0]


def drops(run, least):
    return rate_of(run, run.events["size"] >= least)


def slips(run, least):
    return rate_of(run, (run.events["size"] >= least) & (excess_of(run.path) > slip.SLIP))


def sources(runs):
    return " ".join(str(run.path.relative_to(FOLDER)) for run in runs)


# ---- rates over length


def rates():
    """A row for each fault and length: rates of drops, and of those that are slip, of at least each size."""
    rows = []
    for fault in FAULTS:
        for length in LENGTHS:
            every, worked = runs_of(fault, length), runs_of(fault, length, column="friction_work")
            row = dict(fault=fault, length=length, packings=len(every), time=sum(run.time for run in every), packings_slip=len(worked))
            for name, runs, measure in ("drops", every, drops), ("slips", worked, slips):
                for least in SIZES:
                    row[f"{name}_{least:g}"], row[f"{name}_{least:g}_error"] = over(runs, lambda run: measure(run, least))
            rows += [row] if every else []
    return rows


# Points of each fault: name, number of its colour, shape. row(fault, x, y) is a point of a table that has the fault in its first column.
STYLES = (("leaky", 2, 7), ("reflecting", 6, 5), ("absorbing", 3, 9))
PANELS = """set key Left reverse
set bars small
row(name, y) = strcol(1) eq name ? y : NaN
set xtics out nomirror
set multiplot layout 1,2
"""


def panel(columns, more=""):
    """gnuplot's command that draws a panel. columns: of x, y and its error in a table that begins with the fault; more: further curves"""
    x, y, error = columns
    curves = [
        f"table u (row('{name}', ${x})*{1 + 0.03*(number - 1)}):{y}:{error} w yerrorbars lc {lc} pt {pt} ps point t '{name}'"
        for number, (name, lc, pt) in enumerate(STYLES)
    ]
    return "plot " + ", ".join([*([more] if more else []), *curves]) + "\n"


LENGTH_AXES = """set logscale xy
set xrange [100:2300]
set yrange [1:200]
set xtics (120, 240, 480, 945, '' 1440, 1890)
set xlabel 'length of the fault'
set ylabel 'number in 1000 time units'
"""


def rates_figure(base=FOLDER / "rates"):
    rows = rates()
    write_table(f"{base}.csv", ["Rates in 1000 time units of drops of energy, and of those that are slip, of at least each size (faults.py)"], rows)
    column = {name: 1 + number for number, name in enumerate(rows[0])}
    script = PANELS + LENGTH_AXES + "set title 'all drops of 10^{-4} and more'\nset key bottom right\n"
    script += panel((2, column["drops_0.0001"], column["drops_0.0001_error"]), f"{PAPER} w l lw 2 dt 2 lc rgb '#666666' t 'paper'")
    script += "set title 'slips of 0.1 and more'\nset key top left\n"
    script += panel((2, column["slips_0.1"], column["slips_0.1_error"]), "1.5*x/120 w l lw 1 dt 3 lc rgb '#666666' t 'in proportion to the length'")
    draw(base, script + "unset multiplot\n", 1000, 480)
    return rows


# ---- the numbers of sentences


def rate_values():
    for fault in FAULTS:
        for length in LENGTHS:
            every, worked = runs_of(fault, length), runs_of(fault, length, column="friction_work")
            for name, runs, measure in ("drops", every, drops), ("slips", worked, slips):
                for least in SIZES if runs else ():
                    value = over(runs, lambda run: measure(run, least))
                    yield Value(f"rate.{name}.{fault}.{length}.{least:g}", *value, "1/1000", len(runs), sources(runs))


def all_values():
    return [*rate_values()]


if __name__ == "__main__":
    if sys.argv[1:]:
        sys.exit(__doc__)
    rates_figure()
    values.write(all_values())
