#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Ruptures, as slip histories of compute lsm/events, compared with curves of slip and slip rate at places of the fault †.

rupture_benchmark.py HISTORY... --reference FILE [--until TIME] [--label NAME]... -o BASE

The reference is a table curve,x,t,slip,slip_rate of several curves at several places. Slip is divided by the parameter `scale` of
the header of the history, by which the stresses were multiplied. Prints the misfits over all stations; writes BASE-stations.csv,
BASE.csv (curves and fronts) and their pictures, BASE.png and BASE.svg (--no-picture: none).
"""
import argparse
import csv
import math
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from lsm.drawing import draw  # noqa: E402
from lsm.history import History  # noqa: E402
from lsm.program import run  # noqa: E402
from lsm.tables import write_table  # noqa: E402

ARRIVED = 1.0  # slip rate above which the rupture has arrived, in the units of the references
COLUMNS = ["curve", "x", "t", "slip", "slip_rate"]

# ---- curves: {place: (times, slips, slip rates)}; between the times they are linear


def curves_in(path, columns, first, expected):
    """{place: rows} of a table with these columns: two that say the place, of which `first` reads the first, and a curve from its time on.
    \\raises ValueError"""
    with open(path, newline="") as file:
        lines = [(n, row) for n, row in enumerate(csv.reader(file), 1) if row and not row[0].startswith("#")]
    if not lines or lines[0][1] != columns:
        raise ValueError(f"{path}: expected the columns '{','.join(columns)}'")
    found = {}
    for n, row in lines[1:]:
        try:
            if len(row) != len(columns):
                raise ValueError
            place, one = (first(row[0]), float(row[1])), tuple(map(float, row[2:]))
        except ValueError:
            raise ValueError(f"{path}:{n}: '{','.join(row)}', expected {expected}") from None
        curve = found.setdefault(place, [])
        if curve and not one[0] > curve[-1][0]:
            raise ValueError(f"{path}:{n}: time {one[0]:g}, expected increasing times")
        curve.append(one)
    if not found:
        raise ValueError(f"{path}: no rows, expected those of the columns '{','.join(columns)}'")
    return found


def references_of(path):
    """{name: curves} of a table. \\raises ValueError"""
    found = {}
    for (name, x), rows in curves_in(path, COLUMNS, str, "a name and four numbers").items():
        found.setdefault(name, {})[x] = np.array(rows).T
    return found


def scale_of(history):
    scale = history["scale"] if "scale" in history.header else 1.0
    if not scale > 0:
        raise ValueError(f"{history.path}: parameter 'scale' is {scale:g}, expected a positive number")
    return scale


def history_of(path):
    """Distance of the places and curves of a slip history; slip and mean slip rate belong to the middle of each record. \\raises ValueError"""
    history = History(path)
    if len(history.records) < 2:
        raise ValueError(f"{path}: one record, expected a slip history")
    more, time = history.records["slip"].astype(float) / scale_of(history), (history.end - history.begin)[:, None]
    slip = np.cumsum(more, axis=0) - 0.5 * more
    rate = np.divide(more, time, out=np.zeros_like(more), where=time > 0)
    return history.bin, {x: np.array([history.middle, slip[:, n], rate[:, n]]) for n, x in enumerate(history.x)}


def same_place(a, b):
    return abs(a - b) <= 1e-9 * max(1.0, abs(b))


def at_place(curves, x, name):
    """The curves of a run at x, between its two nearest places. \\raises ValueError beyond its ends"""
    places = list(curves)
    right = next((n for n, place in enumerate(places) if place >= x or same_place(place, x)), None)
    if right is not None and same_place(places[right], x):
        return curves[places[right]]
    if not right:
        raise ValueError(f"{name}: no slip at x = {x:.8g}, which runs from {places[0]:.8g} to {places[-1]:.8g}")
    a, b = places[right - 1], places[right]
    return curves[a] + (x - a) / (b - a) * (curves[b] - curves[a])


def arrival(curve):
    """First time at which the rupture has arrived; NaN if it never does."""
    t, _, rate = curve
    n = np.argmax(rate > ARRIVED)
    if not rate[n] > ARRIVED:
        return math.nan
    return np.interp(ARRIVED, rate[n - 1:n + 1], t[n - 1:n + 1]) if n else t[0]


# ---- misfits


def misfit(curve, reference, until):
    """Misfit of a curve and a reference over the time that they have in common; L2: root of the sum of squared differences over that of
    the reference. \\raises ValueError"""
    begin, end = max(curve[0][0], reference[0][0]), min(curve[0][-1], reference[0][-1], until)
    if not end > begin:
        raise ValueError("no time in common with the reference")
    # At the times of the finer curve, so that no detail of either is missed.
    times = curve[0] if len(curve[0]) > len(reference[0]) else reference[0]
    times = times[(times > begin) & (times <= end)]
    share = np.diff(times, prepend=begin)
    (slip, rate), (wanted_slip, wanted_rate) = ([np.interp(times, one[0], one[k]) for k in (1, 2)] for one in (curve, reference))

    def l2(wanted, found):
        return math.sqrt(share @ (found - wanted)**2 / total) if (total := share @ wanted**2) > 0 else math.inf

    return dict(arrival=arrival(curve), reference_arrival=arrival(reference), end_slip=np.interp(end, curve[0], curve[1]),
                reference_end_slip=np.interp(end, reference[0], reference[1]), slip_l2=l2(wanted_slip, slip), peak_rate=rate.max(),
                reference_peak_rate=wanted_rate.max(), rate_l2=l2(wanted_rate, rate))


def summary(stations):
    """Root mean squares, and largest differences, over the stations; slip and rates relative."""
    of = {key: np.array([one[key] for one in stations]) for key in stations[0] if key not in ("run", "reference")}
    late = of["arrival"] - of["reference_arrival"]
    late, more = np.abs(late[np.isfinite(late)]), of["end_slip"] - of["reference_end_slip"]

    def rms(values):
        return math.sqrt(np.mean(values**2)) if len(values) else math.nan

    return dict(arrival=rms(late), arrival_max=late.max(initial=0), slip=rms(more) / rms(of["reference_end_slip"]),
                slip_max=np.abs(more / of["reference_end_slip"]).max(), slip_l2=rms(of["slip_l2"]),
                peak=rms(of["peak_rate"] / of["reference_peak_rate"] - 1), rate_l2=rms(of["rate_l2"]))


def stations_of(runs, references, until):
    """A row for each run, reference and place that slips in it before the end. runs: {name: (spacing, curves)}. \\raises ValueError"""
    rows = []
    for name, places in references.items():
        for run_name, (spacing, curves) in runs.items():
            found = [
                dict(run=run_name, spacing=spacing, reference=name, x=x) | misfit(at_place(curves, x, run_name), one, until)
                for x, one in places.items()
            ]
            found = [one for one in found if one["reference_end_slip"] > 0]  # 0: the rupture arrives later
            if not found:
                raise ValueError(f"{name}: no place slips in it")
            rows += found
    return rows


def report(stations):
    """Prints the misfits over all stations."""
    groups = {}
    for row in stations:
        groups.setdefault((row["reference"], row["run"]), []).append(row)
    for (reference, name), rows in groups.items():
        spacing, s = rows[0]["spacing"], summary(rows)
        print(f"{name}, spacing {spacing:g}, against {reference}: arrival {s['arrival']:.3g}, at most {s['arrival_max']:.3g}; "
              f"slip {100 * s['slip']:.3g} %, at most {100 * s['slip_max']:.3g} %, L2 {100 * s['slip_l2']:.3g} %; "
              f"slip rate: peak {100 * s['peak']:.3g} %, L2 {100 * s['rate_l2']:.3g} %")


# ---- picture


def shown_places(references):
    """Up to six places that all references have, evenly chosen."""
    first, *others = references.values()
    common = sorted(x for x in first if all(any(same_place(x, y) for y in one) for one in others))
    return [common[k] for k in np.unique(np.linspace(0, len(common) - 1, min(6, len(common))).astype(int))] if common else []


def tick(most):
    """Distance of the ticks of an axis from 0 to `most`, for about three."""
    decade = 10.0**math.floor(math.log10(most / 3))
    return decade * (1 if most / 3 < 2 * decade else 2 if most / 3 < 5 * decade else 5)


def rows_and_picture(runs, references, until, base, no_picture):
    """BASE.csv: curves at the places shown, and fronts, numbered: the references first; and its picture."""
    places, last = shown_places(references), list(references)[-1]
    curves = [*((name, one, None) for name, one in references.items()), *((name, one, spacing) for name, (spacing, one) in runs.items())]
    rows, most = [], np.zeros((len(places), 3))
    for number, (name, one, spacing) in enumerate(curves, 1):
        for k, x in enumerate(places):
            t, slip, rate = at_place(one, x, name) if spacing else next(curve for y, curve in one.items() if same_place(x, y))
            known = next(curve for y, curve in references[last].items() if same_place(x, y))
            off = np.where((t >= known[0][0]) & (t <= known[0][-1]), slip - np.interp(t, known[0], known[1]), math.nan)
            rows += [dict(number=number, x=x, t=at, slip=s, slip_rate=v, difference=d) for at, s, v, d in zip(t, slip, rate, off) if at <= until]
            most[k] = np.fmax(most[k], [slip.max(), rate.max(), 100 * np.nanmax(np.abs(off), initial=0)])
        rows += [dict(number=-number, x=x, t=arrival(curve), slip=math.nan, slip_rate=math.nan, difference=math.nan) for x, curve in one.items()]
    comments = ["number n > 0: curve n at x; -n: arrival of curve n at x", f"difference: slip less that of {last}"]
    write_table(f"{base}.csv", comments + [f"curve {n}: {name}" for n, (name, *_) in enumerate(curves, 1)], rows)
    if no_picture:
        return
    lines = [f"lt {n - len(references)} lw 1.1" for n in range(1, len(curves) + 1)]
    lines[:len(references)] = ["lc rgb '#999999' lw 2.6", *["lt 8 dt (8,4) lw 1.6"] * (len(references) - 1)]
    height = 150 * len(places) + 400
    high, end = 150 / height, min(until, max(one[next(iter(one))][0][-1] for _, one, spacing in curves if spacing))
    script = f"set multiplot\nset xrange [0:{end:g}]\nunset key\n"
    for k, x in enumerate(places):
        for column, (title, cell) in enumerate((("Slip (m)", "4"), ("Slip rate (m/s)", "5"), ("Difference (cm)", "(100*$6)"))):
            left, top, limit = 0.065 + 0.335 * column, 0.985 - high * k, max(1.1 * most[k][column], 1e-9)
            script += f"""set lmargin at screen {left}; set rmargin at screen {left + 0.25}
set tmargin at screen {top:.4f}; set bmargin at screen {top - 0.86 * high:.4f}
set format x "{'%g' if k + 1 == len(places) else ''}"; set ylabel "{title}" offset {0.5 if column == 2 else 1.5},0
set yrange [{-limit if column == 2 else 0}:{limit}]; set ytics {tick(2.5 * limit if column == 2 else limit):g}
set label 1 "{'' if column == 2 else f'x = {x / 1000:g} km'}" at graph {0.98 if column else 0.03},0.86 {'right' if column else 'left'}
plot """ + ", ".join(f"table using ($1 == {n} && $2 == {x:.17g} ? $3 : NaN):{cell} with lines {line} notitle"
                     for n, line in enumerate(lines, 1)) + "\n"
    script += f"""unset label 1; set lmargin at screen 0.065; set rmargin at screen 0.985; set xrange [*:*]; set yrange [*:*]; set format x "%g"
set tmargin at screen {0.985 - high * len(places) - 30 / height:.4f}; set bmargin at screen {high:.4f}; set ylabel "Arrival (s)" offset 1.5,0; set ytics autofreq
set xlabel "Place along the fault (km); above: time (s); right: slip less that of {last}"
set key at screen 0.5,0.004 bottom center horizontal maxcols 4 samplen 3 spacing 1.15 noreverse Right
plot """
    parts = []
    for n, ((name, _, spacing), line) in enumerate(zip(curves, lines), 1):
        data, mark = f"table using ($1 == {-n} ? $2 / 1000 : NaN):3 with ", f"pt {12 if n == 1 else 6} ps 1.1*point"
        if spacing:
            parts.append(f'{data}lines {line} title "{name}"')
        else:  # the key combines the line of the panels above with the mark of this one
            parts += [
                f"{data}points {line.split(' dt')[0].split(' lw')[0]} {mark} notitle", f'keyentry with linespoints {line} {mark} title "{name}"'
            ]
    draw(base, script + ", ".join(parts) + "\nunset multiplot", 1000, height)


def main(histories, reference, until, label, output, no_picture):
    names = label or [Path(path).name.removesuffix(".slip.bin") for path in histories]
    if len(names) != len(histories) or len(set(names)) != len(names):
        raise ValueError(f"{len(set(names))} labels of {len(histories)} histories, expected one of each")
    references = {}
    for path in reference:
        references |= references_of(path)
    runs = dict(sorted(zip(names, map(history_of, histories)), key=lambda one: -one[1][0]))
    stations = stations_of(runs, references, until)
    write_table(f"{output}-stations.csv", [], stations)
    report(stations)
    rows_and_picture(runs, references, until, output, no_picture)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("histories", metavar="HISTORY", nargs="+")
    parser.add_argument("--reference", metavar="FILE", nargs="+", required=True)
    parser.add_argument("--until", metavar="TIME", type=float, default=math.inf)
    parser.add_argument("--label", metavar="NAME", action="append")
    parser.add_argument("-o", "--output", metavar="BASE", required=True)
    parser.add_argument("--no-picture", action="store_true")
    run(main, parser)
