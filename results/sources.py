#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Ruptures of the leaky fault as sources of waves: duration, energies and stress drop over moment.

sources.py                          makes sources.csv, .png and .svg from sources.csv.xz
sources.py publish SOURCES...       makes sources.csv.xz from the catalogues of python3 -m lsm.sources, NAME_LENGTH_PACKING.sources.csv

Ruptures from the end of the loading on, of a moment of at least LEAST.
"""
import functools
import sys
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent / "python"))
import lsm  # noqa: E402
from lsm.analysis import mean_and_error  # noqa: E402
from lsm.drawing import draw  # noqa: E402
from lsm.ruptures import fit  # noqa: E402
from lsm.tables import read, write_table  # noqa: E402
from values import Value  # noqa: E402

DATA = FOLDER / "sources.csv.xz"
LEAST, FITTED, LARGE = 0.01, 0.3, 10.0  # moments: of a rupture that is published, that is in fits, and that counts as large
COLUMNS = "slip_moment source_duration stress_work radiated_energy weighted_stress_drop".split()
FEWEST = 3  # ruptures of a bin
STYLES = (("120", "#0072B2", 7), ("240", "#D55E00", 5), ("480", "#009E73", 9))


def publish(*paths):
    rows = []
    for path in paths:
        length, packing = Path(path).name.split(".")[0].split("_")[1:]
        events = lsm.read_catalogue(path)
        for event in events[(events["t_start"] >= lsm.LOADING) & (events["slip_moment"] >= LEAST)]:
            rows.append(
                dict(length=length, packing=packing) | {name: f"{event[name]:.4g}"
                                                        for name in COLUMNS} | dict(modulus=f"{float(events.header['modulus']):.6g}"))
    write_table(DATA, [f"Ruptures of the leaky fault of a moment of {LEAST} and more, from time {lsm.LOADING} on (sources.py publish)"], rows)


@functools.cache
def runs():
    """Columns of each run, {(length, packing): {name: array}}."""
    found = {}
    for row in read(DATA):
        found.setdefault((row["length"], row["packing"]), []).append([float(row[name]) for name in (*COLUMNS, "modulus")])
    return {key: dict(zip((*COLUMNS, "modulus"), np.array(rows).T)) for key, rows in found.items()}


def apparent_stress(run, chosen):
    """Of ruptures together: energies are added, so that those of many small ruptures do not hide that waves also bring energy."""
    return run["modulus"][0] * run["radiated_energy"][chosen].sum() / run["slip_moment"][chosen].sum()


def bins():
    """Half decades of the moment, of all packings of a length."""
    for length, _, _ in STYLES:
        some = [run for (of, _), run in runs().items() if of == length]
        run = {name: np.concatenate([one[name] for one in some]) for name in (*COLUMNS, "modulus")}
        number = np.floor(np.round(2 * np.log10(run["slip_moment"]), 9)).astype(int)
        for bin in range(number.min(), number.max() + 1):
            chosen = number == bin
            if chosen.sum() < FEWEST:
                continue
            low, middle, high = np.quantile(run["source_duration"][chosen], [0.25, 0.5, 0.75])
            yield dict(length=length, moment=10**((bin + 0.5) / 2), ruptures=int(chosen.sum()), duration=middle, duration_low=low, duration_high=high,
                       apparent_stress=apparent_stress(run, chosen),
                       stress_drop=np.average(run["weighted_stress_drop"][chosen], weights=run["slip_moment"][chosen]))  # yapf: disable


def figure(base=FOLDER / "sources"):
    rows = list(bins())
    write_table(f"{base}.csv", ["Half decades of the moment: median and quartiles of the duration, apparent stress and stress drop of its ruptures together "
                                "(sources.py)"], rows)  # yapf: disable
    column = {name: 1 + number for number, name in enumerate(rows[0])}
    duration = f"{column['duration']}:{column['duration_low']}:{column['duration_high']}"
    curves = [[f"table using (row('{name}', $2)*{1 + 0.06*(n - 1)}):{what} lc rgb '{colour}' pt {point} ps point title 'length {name}'"
               for n, (name, colour, point) in enumerate(STYLES)] for what in (f"{duration} with yerrorbars", f"(1000*${column['apparent_stress']}) with points")]  # yapf: disable
    draw(
        base, f"""row(name, y) = strcol(1) eq name ? y : NaN
set key Left reverse top left
set multiplot layout 1,2
set logscale x
set format x '10^{{%L}}'
set xrange [0.008:400]
set bars small
set xlabel 'slip moment'
set title 'duration (5 to 95 % of the moment)'
set logscale y
set yrange [1:2000]
plot 40*sqrt(x) with lines lc rgb '#666666' dt 2 title 'slope 1/2', {', '.join(curves[0])}
set title 'apparent stress, thousandths'
unset logscale y
set yrange [-0.5:3]
plot 0 with lines lc rgb '#666666' notitle, {', '.join(curves[1])}
unset multiplot""", 1000, 480)


def source_values():
    """Fits of duration and energy over moment, and apparent stress and its share of the stress drop; means over the runs."""
    per_run = {}
    for run in runs().values():
        moment, energy = run["slip_moment"], run["radiated_energy"]
        fitted, large = moment >= FITTED, moment >= LARGE
        middle = (moment >= 1) & ~large
        drop = np.average(run["weighted_stress_drop"][large], weights=moment[large])
        found = dict(duration=fit(moment[fitted], run["source_duration"][fitted]).slope, middle=apparent_stress(run, middle), large=apparent_stress(run, large),
                     efficiency=2 * apparent_stress(run, large) / drop, share=energy[large].sum() / run["stress_work"][large].sum())  # yapf: disable
        for name, value in found.items():
            per_run.setdefault(name, []).append(value)
    for name, found in per_run.items():
        yield Value(f"sources.{name}", *mean_and_error(found), "", len(found), DATA.name)
    yield Value("sources.ruptures", sum(int((run["slip_moment"] >= FITTED).sum()) for run in runs().values()), n=len(runs()), source=DATA.name)


if __name__ == "__main__":
    if sys.argv[1:2] == ["publish"] and len(sys.argv) > 2:
        publish(*sys.argv[2:])
    elif len(sys.argv) > 1:
        sys.exit(__doc__)
    figure()
