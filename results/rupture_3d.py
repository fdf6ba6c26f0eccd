#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Ruptures of a plane, as slip histories of compute lsm/events, compared with curves at places of the fault †.

rupture_3d.py HISTORY... --reference FILE [--until TIME] [--label NAME]... -o BASE | --json FILE
rupture_3d.py -o BASE    (from BASE-stations.csv and BASE.csv alone)

The reference is a table x,z,t,slip,slip_rate,slip_dip of one curve for each place; the parameter `scale` of the header of a history
divides its slip. A run has the name of its history, or of its folder if that is rupture.slip.bin, or its label; runs whose names
differ in numbers only are a series. Writes BASE-stations.csv, BASE.csv (curves of the first series at the places shown, and when the
rupture arrived in its last history); from these it prints and writes BASE-convergence.csv, misfits over all places and the orders of
convergence in a series, and the pictures BASE.png and BASE.svg (--no-picture: none). --json FILE: misfits only, for a study.
"""
import argparse
import csv
import math
import re
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from lsm.drawing import draw  # noqa: E402
from lsm.history import History  # noqa: E402
from lsm.program import run  # noqa: E402
from lsm.tables import write_json, write_table  # noqa: E402
from rupture_benchmark import ARRIVED, arrival, curves_in, misfit, same_place, scale_of, summary, tick  # noqa: E402

COLUMNS = ["x", "z", "t", "slip", "slip_rate", "slip_dip"]
SHOWN = [(0, -7500), (4500, -7500), (-12000, -7500), (4500, 0), (12000, 0)]  # those of TPV5 that differ most from each other
MOST_POINTS = 3000  # of the map
LOW = 1.0  # frequency at which the low pass of slip rates halves the power, in the unit of the references
ORDERS = ("arrival", "slip", "slip_l2", "rate_l2", "rate_low_l2")


def reference_of(path):
    """{(x, z): (times, slips, slip rates, slips along dip)}. \\raises ValueError"""
    return {place: np.array(rows).T for place, rows in curves_in(path, COLUMNS, float, "six numbers").items()}


class Plane:
    """Slip of a plane: strike, dip: places of its bins; time: middles of the records, to which slip and mean slip rate belong."""

    def __init__(self, path):
        history = History(path)
        if not history.plane:
            raise ValueError(f"{path}: the slip history of a line, expected that of a plane")
        history = history.kept(history.end > history.begin)  # the first is the state at the beginning
        if not len(history.records):
            raise ValueError(f"{path}: one record, expected a slip history")
        self.path, self.spacing, self.strike, self.dip, self.time = path, history.bin, history.x, history.z, history.middle
        self.more, self.duration, self.scale = history.records["slip"], history.end - history.begin, scale_of(history)

    def curve(self, more):
        """Times, slips and mean slip rates from the slips of the records of a place."""
        return np.array([self.time, np.cumsum(more) - 0.5 * more, more / self.duration])

    def seen(self, reference):
        """When a reference arrived, had its slip been recorded in these intervals."""
        ends = self.time[:, None] + 0.5 * self.duration[:, None] * [-1, 1]
        return arrival([self.time, None, np.diff(np.interp(ends, reference[0], reference[1]))[:, 0] / self.duration])

    def at(self, x, z):
        """Curve and slip along dip at a place, linear between the four bins around it. \\raises ValueError beyond the plane"""
        parts = []
        for axis, place in ((self.strike, x), (self.dip, z)):
            right = next((n for n, one in enumerate(axis) if one >= place or same_place(one, place)), 0)
            if same_place(axis[right], place):
                parts.append([(right, 1.0)])
            elif right:
                share = (place - axis[right - 1]) / (axis[right] - axis[right - 1])
                parts.append([(right - 1, 1.0 - share), (right, share)])
            else:
                raise ValueError(f"{self.path}: no slip at {x:g}, {z:g}, expected a place of the plane")
        more = sum(a * b * self.more[:, n, m].astype(float) for n, a in parts[0] for m, b in parts[1]) / self.scale
        return self.curve(more[:, 0]), np.cumsum(more[:, 1])

    def arrivals(self):
        """When the rupture arrived, of each bin; NaN where it did not."""
        found = np.full(self.more.shape[1:3], math.nan)
        for n in range(found.shape[0]):
            for m in np.flatnonzero((self.more[:, n, :, 0] / self.scale / self.duration[:, None]).max(axis=0) > ARRIVED):
                found[n, m] = arrival(self.curve(self.more[:, n, m, 0].astype(float) / self.scale))
        return found


def low_pass(values, step, frequency=LOW):
    """Values at times with this step, after a low pass without delay, a Gaussian window."""
    width = math.sqrt(math.log(2)) / (2 * math.pi * frequency)
    half = math.ceil(4 * width / step)
    window = np.exp(-0.5 * (np.arange(-half, half + 1) * step / width)**2)
    return np.convolve(np.pad(values, half, mode="edge"), window / window.sum(), mode="valid")


def rate_misfit(curve, reference, end):
    """What of the misfit of slip rates (relative L2) is below the frequency LOW, in the time in which both may arrive."""
    late = arrival(curve) - arrival(reference)
    late = late if math.isfinite(late) else 0.0
    step = min(0.02, np.diff(reference[0]).min())
    times = np.arange(max(curve[0][0], curve[0][0] - late, reference[0][0]), min(end, end - late), step)
    wanted, found = (low_pass(np.interp(times, one[0], one[2]), step) for one in (reference, curve))
    return math.sqrt(np.sum((found - wanted)**2) / total) if (total := np.sum(wanted**2)) > 0 else math.inf


def stations_of(planes, reference, until):
    """A row for each run and place. planes: {name: Plane}. \\raises ValueError"""
    rows = []
    for name, plane in planes.items():
        for (x, z), one in reference.items():
            curve, dip = plane.at(x, z)
            end = min(until, plane.time[-1], one[0][-1])
            rows.append(
                dict(run=name, spacing=plane.spacing, reference="boundary integral", x=x, z=z) | misfit(curve, one[:3], until)
                | dict(rate_low_l2=rate_misfit(curve, one[:3], end)) | dict(reference_arrival=plane.seen(one))
                | dict(end_dip=np.interp(end, plane.time, dip), reference_end_dip=np.interp(end, one[0], one[3])))
    return rows


def series_of(name):
    return re.sub(r"[\d.]+", "0", name, count=1)


def convergence_of(stations):
    """A row for each run: misfits over the places, and orders of convergence from the run before it in its series."""
    groups, rows, before = {}, [], {}
    for row in stations:
        groups.setdefault(row["run"], []).append(row)
    for name, of_run in groups.items():
        late = np.array([row["arrival"] - row["reference_arrival"] for row in of_run])
        row = dict(run=name, spacing=of_run[0]["spacing"]) | summary(of_run) | dict(mean=late.mean(), scatter=late.std())
        row["rate_low_l2"] = math.sqrt(np.mean([one["rate_low_l2"]**2 for one in of_run]))
        last = before.get(series_of(name))
        for key in ORDERS:
            row[f"order_{key}"] = math.log(last[key] / row[key]) / math.log(last["spacing"] / row["spacing"]) if last else math.nan
        before[series_of(name)] = row
        rows.append(row)
    return rows


def rounded(value):
    return float(f"{value:.5g}")


def write_curves(planes, reference, until, path):
    """Curves at the places shown, and when the rupture arrived in the last history, in a table from which the picture is drawn."""
    planes = {name: plane for name, plane in planes.items() if series_of(name) == series_of(next(iter(planes)))}
    shown = [place for place in SHOWN if place in reference] or list(reference)[:5]
    last = list(planes.values())[-1]
    curves = [("boundary integral", {place: reference[place][:3] for place in shown})]
    curves += [(name, {place: plane.at(*place)[0] for place in shown}) for name, plane in planes.items()]
    rows = [
        dict(number=number, x=x, z=z, t=rounded(t), slip=rounded(slip), slip_rate=rounded(rate)) for number, (_, one) in enumerate(curves, 1)
        for x, z in shown for t, slip, rate in one[x, z].T if t <= until
    ]
    times = last.arrivals()
    slipped = np.argwhere(np.isfinite(times))
    stride = next(n for n in range(1, 100) if len(slipped) <= MOST_POINTS * n * n)
    rows += [
        dict(number=0, x=rounded(last.strike[n]), z=rounded(last.dip[m]), t=rounded(times[n, m]), slip=math.nan, slip_rate=math.nan)
        for n, m in slipped if n % stride == 0 and (len(last.dip) - 1 - m) % stride == 0
    ]
    comments = ["number n > 0: curve n at x, z; 0: when the rupture arrived, in the last curve's run, at squares of this side: "
                f"{stride * last.spacing:g}"]  # yapf: disable
    write_table(path, comments + [f"curve {n}: {name}" for n, (name, _) in enumerate(curves, 1)], rows)


def stations_in(path):
    """The rows of BASE-stations.csv. \\raises ValueError"""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    try:
        if not rows or "rate_low_l2" not in rows[0]:
            raise ValueError
        return [{key: value if key in ("run", "reference") else float(value or "nan") for key, value in row.items()} for row in rows]
    except ValueError:
        raise ValueError(f"{path}: expected a table of this script, with numbers") from None


def conclude(base, no_picture):
    """Prints and writes what follows from BASE-stations.csv, and draws BASE.csv. \\raises ValueError"""
    rows = convergence_of(stations_in(f"{base}-stations.csv"))
    write_table(f"{base}-convergence.csv", [], rows)
    for row in rows:
        print(f"{row['run']}, spacing {row['spacing']:g}: arrival {row['arrival']:.3g}, mean {row['mean']:.3g}, at most {row['arrival_max']:.3g}; "
              f"slip {100 * row['slip']:.3g} %, at most {100 * row['slip_max']:.3g} %; slip rate {100 * row['rate_l2']:.3g} %, "
              f"below {LOW:g} Hz {100 * row['rate_low_l2']:.3g} %")
    if not no_picture:
        picture(base)


def picture(base):
    """Draws BASE.png and BASE.svg from the table BASE.csv alone. \\raises ValueError"""
    with open(f"{base}.csv", newline="") as file:
        lines = list(file)
    names = [line.split(": ", 1)[1].strip() for line in lines if line.startswith("# curve ")]
    side = [line.rsplit(": ", 1)[1] for line in lines if line.startswith("# number n > 0")]
    table = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    if not names or not side or not table:
        raise ValueError(f"{base}.csv: expected a table of this script, with its names of curves")
    number, x, z, t = (np.array([float(row[key]) for row in table]) for key in ("number", "x", "z", "t"))
    slip, rate = (np.array([float(row[key] or "nan") for row in table]) for key in ("slip", "slip_rate"))
    shown = list(dict.fromkeys((a, b) for n, a, b in zip(number, x, z) if n == 1))
    styles = ["lc rgb '#999999' lw 2.6", *(f"lt {n} lw 1.1" for n in range(1, len(names)))]
    height = 150 * len(shown) + 482
    high = 150 / height
    script = f"set multiplot\nset xrange [0:{t[number > 1].max():g}]\nunset key\n"
    for k, (a, b) in enumerate(shown):
        here = (number > 0) & (x == a) & (z == b)
        for column, (title, cell, values) in enumerate((("Slip (m)", 5, slip), ("Slip rate (m/s)", 6, rate))):
            left, top, limit = 0.075 + 0.5 * column, 0.985 - high * k, 1.1 * values[here].max()
            script += f"""set lmargin at screen {left}; set rmargin at screen {left + 0.405}
set tmargin at screen {top:.4f}; set bmargin at screen {top - 0.86 * high:.4f}
set format x "{'%g' if k + 1 == len(shown) else ''}"; set ylabel "{title}" offset 1,0; set yrange [0:{limit}]; set ytics {tick(limit):g}
set label 1 "{'' if column else f'{a / 1000:g} km, {abs(b) / 1000:g} km deep'}" at graph 0.97,0.14 right
plot """ + ", ".join(f"table using ($1 == {n} && $2 == {a:.17g} && $3 == {b:.17g} ? $4 : NaN):{cell} with lines {style} notitle"
                     for n, style in enumerate(styles, 1)) + "\n"
    on_map, half = number == 0, 0.5 * float(side[0]) / 1000
    longest, deepest, colours = abs(x[on_map]).max() / 1000, -z[on_map].min() / 1000, max(2, round(2 * t[on_map].max()))
    script += f"""unset label 1; set key at screen 0.5,{0.985 - high * len(shown) - 32 / height:.4f} center top horizontal maxrows 1 samplen 3
set lmargin at screen 0.075; set rmargin at screen 0.9; set format x "%g"
set tmargin at screen {0.985 - high * len(shown) - 84 / height:.4f}; set bmargin at screen {70 / height:.4f}
set xrange [{-longest - 0.5:g}:{longest + 0.5:g}]; set yrange [{deepest + 0.5:g}:-0.5]; set ytics autofreq; set ylabel "Depth (km)" offset 1.5,0
set xlabel "Along strike (km); colours: arrival (s), {names[-1]}"; unset grid
set palette maxcolors {colours} defined (0 '#fde725', 1 '#5ec962', 2 '#21918c', 3 '#3b528b', 4 '#440154')
set cbrange [0:{0.5 * colours:g}]; set cbtics 1; set style fill solid noborder
plot table using ($1 == 0 ? $2 / 1000 : NaN):(-$3 / 1000):({half:g}):({half:g}):4 with boxxyerror lc palette notitle, \\
  table using ($1 == 1 ? $2 / 1000 : NaN):(-$3 / 1000) with points pt 6 lc rgb '#ffffff' notitle, \\
  """ + ", ".join(f"keyentry with lines {style} title '{name}'" for name, style in zip(names, styles)) + "\n"
    draw(base, script + "unset multiplot", 1000, height)


def name_of(path):
    name = Path(path).name.removesuffix(".slip.bin")
    return (Path(path).absolute().parent.name if name == "rupture" else name).replace("_", " ")


def main(histories, reference, until, label, output, json_file, no_picture):
    if not (output or json_file and histories):
        raise ValueError("no -o, expected one, or --json with histories")
    if not histories:
        conclude(output, no_picture)
        return
    if not reference:
        raise ValueError("no --reference, expected one with histories")
    names = label or [name_of(path) for path in histories]
    if len(names) != len(histories) or len(set(names)) != len(names):
        raise ValueError(f"{len(set(names))} labels of {len(histories)} histories, expected one of each")
    known = reference_of(reference)
    planes = dict(sorted(zip(names, map(Plane, histories)), key=lambda one: -one[1].spacing))
    stations = stations_of(planes, known, until)
    if json_file:
        write_json(json_file, stations=stations, convergence=convergence_of(stations))
    if output:
        write_table(f"{output}-stations.csv", [], stations)
        write_curves(planes, known, until, f"{output}.csv")
        conclude(output, no_picture)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("histories", metavar="HISTORY", nargs="*")
    parser.add_argument("--reference", metavar="FILE")
    parser.add_argument("--until", metavar="TIME", type=float, default=math.inf)
    parser.add_argument("--label", metavar="NAME", action="append")
    parser.add_argument("-o", "--output", metavar="BASE")
    parser.add_argument("--json", metavar="FILE", dest="json_file")
    parser.add_argument("--no-picture", action="store_true")
    run(main, parser)
