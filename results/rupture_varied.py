#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Ruptures of a flat fault whose friction varies along it †: TPV101-2D, and TPV3-2D with a barrier from 6 to 9 km.

rupture_varied.py FOLDER --reference FILE -o BASE

FOLDER is that of tests/accuracy/ruptures.sh, with slip histories and boundary integrals tpv101.SPACING.slip.bin, tpv101.SPACING.csv,
barrier.FACTOR.SPACING.slip.bin and barrier.FACTOR.SPACING.csv. A barrier takes FACTOR^2 of the fracture energy; one of 1000 holds.
Writes BASE-convergence.csv, what boundary integrals of TPV101 differ by from the reference, the finest one; BASE-barrier.csv, how far ruptures come and the
energy release rate at a tip that is held; BASE.csv, and its pictures BASE.png and BASE.svg.
"""
import argparse
import math
from pathlib import Path

import numpy as np

import rupture_benchmark as benchmark
from lsm.drawing import draw
from lsm.program import run
from lsm.tables import write_table

UNTIL = 7.0  # s, of TPV101
EDGE, HELD = 6000.0, 1000.0  # of the barrier, in m; the factor that holds
MODULUS, POISSON = 2670 * 6000.0**2 / 3, 0.25
DROP, NUCLEUS = 7e6, 11.6e6  # stress drop, and more of it within 1500 m
ENERGY = 0.5 * 0.152 * 120e6 * 0.4  # fracture energy outside the barrier, J/m^2


def name_of(path):
    return path.name.removesuffix(".csv").removesuffix(".slip.bin")


def spacing_of(path):
    return float(name_of(path).rsplit(".", 1)[1])


def factor_of(path):
    return float(name_of(path).split(".", 1)[1].rsplit(".", 1)[0])


def found(folder, pattern):
    """{path: curves} of slip histories, then of boundary integrals, the finest last. \\raises ValueError if there are none"""
    out = {}
    for ending in ("slip.bin", "csv"):
        paths = [path for path in Path(folder).glob(f"{pattern}.{ending}") if not path.name.endswith(".ruptures.csv")]
        paths.sort(key=lambda path: -spacing_of(path))
        if not paths:
            raise ValueError(f"{folder}: no {pattern}.{ending}")
        out |= {path: benchmark.history_of(path)[1] if ending == "slip.bin" else next(iter(benchmark.references_of(path).values())) for path in paths}
    return out


def method_of(path):
    return "boundary integral" if path.suffix == ".csv" else "lattice"


def convergence(curves, references):
    """What boundary integrals differ by from the finest, over all its places that slip."""
    runs = {path.stem: (spacing_of(path), places) for path, places in curves.items() if path.suffix == ".csv"}
    rows = benchmark.stations_of(runs, references, UNTIL)
    return [dict(spacing=spacing) | benchmark.summary([row for row in rows if row["run"] == name]) for name, (spacing, _) in runs.items()]


def static_rate():
    """Energy release rate of a static crack that ends at the barrier."""
    intensity = math.sqrt(math.pi * EDGE) * (DROP + NUCLEUS * 2 / math.pi * math.asin(1500 / EDGE))
    return (1 - POISSON) * intensity**2 / (2 * MODULUS)


def held_rate(curves, spacing):
    """Times, and energy release rate at the tip that a barrier holds: next to it slip is 4 (1 - nu) / mu K sqrt(r / (2 pi)), with its next
    term, which is linear in r."""
    near = {x: curve for x, curve in curves.items() if 300 <= EDGE - x <= 1500}
    times = max(near.values(), key=lambda curve: len(curve[0]))[0]
    r = np.array([EDGE - 0.5 * spacing - x for x in near])
    over = np.array([np.interp(times, curve[0], curve[1]) for curve in near.values()]) / np.sqrt(r)[:, None]
    leading = np.polyfit(r, over, 1)[1]
    intensity = leading * MODULUS * math.sqrt(2 * math.pi) / (4 * (1 - POISSON))
    return times, (1 - POISSON) * intensity**2 / (2 * MODULUS)


def reach(curves):
    """How far the rupture comes, in m."""
    return max((abs(x) for x, curve in curves.items() if math.isfinite(benchmark.arrival(curve))), default=0.0)


def barriers(curves):
    rows = []
    for path, places in curves.items():
        factor, spacing = factor_of(path), spacing_of(path)
        row = dict(method=method_of(path), spacing=spacing, factor=factor, energy=factor**2 * ENERGY / 1e6, reach=reach(places) / 1000)
        if factor == HELD:
            times, rate = held_rate(places, spacing)
            row |= dict(held=rate.max() / 1e6, time=times[rate.argmax()], last=rate[-1] / 1e6, static=static_rate() / 1e6)
        rows.append(row)
    return sorted(rows, key=lambda row: (row["method"], -row["spacing"], row["factor"]))


PLACES = (3000.0, 9000.0, 16500.0)


def picture(base, tpv101, references, rows):
    shown = [*references.items(), *((f"lattice {spacing_of(path):g} m", one) for path, one in tpv101.items() if path.suffix != ".csv")]
    places, cells = next(iter(references.values())), []
    for n, (name, curves) in enumerate(shown):
        for k, x in enumerate(PLACES):
            t, _, rate = benchmark.at_place(curves, x, name)
            cells += [dict(panel=f"rate {n} {k}", x=at, y=v) for at, v in zip(t, rate) if at <= UNTIL]
        late = sorted((x, benchmark.arrival(benchmark.at_place(curves, x, name)) - benchmark.arrival(one)) for x, one in places.items() if x >= 0)
        cells += [dict(panel=f"late {n}", x=x / 1000, y=late) for x, late in late if n]
    series = sorted({(row["method"], row["spacing"]) for row in rows}, key=lambda one: (one[0], -one[1]))
    for n, one in enumerate(series):
        cells += [
            dict(panel=f"reach {n}", x=row["energy"], y=row["reach"]) for row in rows
            if (row["method"], row["spacing"]) == one and row["factor"] < HELD
        ]
    write_table(f"{base}.csv", [
        "panel rate N K: slip rate (m/s) over time (s) of curve N at place K; late N: how much later it arrives than the first (s) over place (km); reach N: "
        "how far the rupture comes (km) over the fracture energy of the barrier (MJ/m^2)"
    ], cells)
    held = [row["held"] for row in rows if row.get("held") and row["method"] == "boundary integral"][-1]
    style = ["lc rgb '#999999' lw 3", *(f"lt {n} lw 1.3" for n in range(1, len(shown)))]

    def of(panel):
        return f"table using (strcol(1) eq '{panel}' ? $2 : NaN):3"

    curves = ", ".join(f"{of(f'rate {n} {k}')} with lines {style[n]} notitle" for n in range(len(shown)) for k in range(len(PLACES)))
    late = ", ".join(f"{of(f'late {n}')} with linespoints {style[n]} title '{name}'" if n else f"0 with lines {style[n]} title '{name}'"
                     for n, (name, _) in enumerate(shown))
    points = ", ".join(f"{of(f'reach {n}')} with linespoints lt {n + 1} title '{method} {spacing:g} m'" for n, (method, spacing) in enumerate(series))
    draw(
        base, f"""set multiplot layout 1,3 margins 0.07,0.975,0.38,0.90 spacing 0.1,0.1
set key at graph 0.5,-0.28 top center samplen 2 spacing 1.1 noreverse Right
set xlabel 'time (s)'; set ylabel 'slip rate (m/s)' offset 1,0; set title 'TPV101: 3, 9, 16.5 km'; set yrange [0:20]
plot {curves}
set xlabel 'place (km)'; set ylabel 'arrival, later by (s)'; set title 'TPV101: front'; set yrange [*:*]
plot {late}
set xlabel 'fracture energy (MJ/m^2)'; set ylabel 'reach (km)'; set title 'barrier from 6 to 9 km'; set xrange [17:28]; set yrange [5:16]
set arrow from {static_rate() / 1e6:g}, graph 0 to {static_rate() / 1e6:g}, graph 1 nohead lc rgb '#333333' dt 2
set arrow from {held:g}, graph 0 to {held:g}, graph 1 nohead lc rgb '#333333'
plot {points}
unset multiplot""", 1100, 460)


def main(folder, reference, output, no_picture):
    tpv101, references = found(folder, "tpv101.*"), benchmark.references_of(reference)
    write_table(f"{output}-convergence.csv", [f"boundary integrals of TPV101-2D, until {UNTIL:g} s: differences from the finest"],
                convergence(tpv101, references))
    rows = barriers(found(folder, "barrier.*"))
    write_table(f"{output}-barrier.csv", [
        "energies in MJ/m^2, reach in km; held: largest energy release rate at the edge of a barrier that holds, "
        "last: in the end, static: of a static crack"
    ], rows)
    if not no_picture:
        picture(output, tpv101, references, rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="FOLDER")
    parser.add_argument("--reference", metavar="FILE", required=True)
    parser.add_argument("-o", "--output", metavar="BASE", required=True)
    parser.add_argument("--no-picture", action="store_true")
    run(main, parser)
