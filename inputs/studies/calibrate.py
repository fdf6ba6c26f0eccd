#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Which values of what the paper does not print give the statements that it does.

calibrate.py collect BIN OUT.csv FOLDER...   numbers of the runs of a study, one row for each run and memory of the picker; other
                                             rows that OUT.csv has stay
calibrate.py sliders BIN OUT.csv FOLDER...   the same numbers of block-sliders, one row for each run, smallest size and warm-up
calibrate.py figure POINTS.csv OUT           distances over what is not printed: OUT.png and OUT.svg

results/tables.py makes the tables of results/calibration.md of the same statements.

Approximate Bayesian computation by rejection (Pritchard et al. 1999): points of the prior are run, each statement gives a
deviation in units of its tolerance, the distance is their root mean square, and the points nearest to the paper are kept.
"""
import csv
import json
import lzma
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from text_tables import rows_of

sys.path.append(str(Path(__file__).resolve().parent.parent.parent / "results"))

# Time units. 0.99 a step is a memory of 100 steps; printed numbers imply steps of 0.0045, a benchmark of the same code has 0.02.
MEMORIES = (0.5, 1, 2)
LOADING = 8000  # time units that are left out: compression, and the first loading, in which PE rises
SETTINGS = ("length", "seed", "stress", "viscosity", "kt", "impedance", "hold", "contacts", "mass", "dt", "steps")  # of a point
RANGES = ("1e-4:1e-1", "1e-4:1e-3", "1e-3:1e-2", "1e-2:1e-1")
WINDOWS = ("16:22", "22:28", "30:36", "38:44")
WAVE_SPEED = {"r2": 2.08, "r3": 2.53}  # of P-waves in the packing, see p_wave_packing.in

SLIDER_KEYS = ("scheme", "dt", "picker", "picker-lambda", "picker-memory-time", "warmup", "smallest")
SLIDER_WARMUPS, SLIDER_SIZES = (0, 12000), ("0.0001", "0.01")


def defaults():
    """Defaults of the variables of fault.in, for what a table does not set."""
    lines = (Path(__file__).resolve().parent.parent / "fault.variables").read_text().splitlines()
    cells = [[cell.strip() for cell in line.split("|")] for line in lines if line.count("|") > 4]
    return {row[0]: row[1] for row in cells}


def number(row, key):
    return float(row[key]) if row.get(key) else math.nan


def outside(value, low, high):
    """How far a value is from an interval; 0 within."""
    return max(low - value, 0.0, value - high) if math.isfinite(value) else math.nan


def decades(row):
    parts = [number(row, f"exponent_{text}") - 1.07 for text in RANGES[1:]]
    return math.sqrt(sum(part * part for part in parts) / len(parts))


def swings(row):
    """Share of inter-event times that are near a period of the blocks between the plates, less the share of times beside it."""
    beside = 0.5 * (number(row, "share_16:22_0.0001") + number(row, "share_38:44_0.0001"))
    return max(number(row, "share_22:28_0.0001"), number(row, "share_30:36_0.0001")) - beside


def memories(row):
    """Mean inter-event time in memories of the picker, which are 100 steps, and thus independent of the unit of time."""
    return number(row, "mean_time_0.0001") / float(row["memory"])


# What results/statements.py measures: {column: name of the number in its table}
WORDED = {
    "rise": "largest rise of the density, at all times",
    "rise_slipping": "largest rise of the density, while something slips",
    "recorded": "slip recorded over that of the plates",
    "one_bin": "share of ruptures of one bin (from 5 plate velocities on)",
    "slip_between": "share of the slip while no event is open",
    "rate_within": "slip rate within events over that between them",
    "rate_between": "slip rate between events over that of the plates",
    "loading": "rise of PE between events over the work of the plates",
    "roll_off_power": "power d of s^-a exp(-(s/c)^d)",
    "roll_off_gain": "2 ln L of d = 1 over a power law without end",
    "B": "B, delta 1",
    "C": "C, delta 1",
}

# name, statement of the paper (or †), value of a row, its deviation, tolerance
STATEMENTS = (
    ("exponent", "sizes go as s^-1.07 from 1e-4 over three decades", lambda r: number(r, "exponent_1e-4:1e-1"), lambda v: abs(v - 1.07), 0.07),
    ("decades", "so in each of these decades (no second population)", decades, abs, 0.3),
    ("gamma", "inter-event times >= 1e-4: gamma 0.995, delta 1", lambda r: number(r, "gamma_0.0001"), lambda v: abs(v - 0.995), 0.1),
    ("rate", "3000 to 8000 events in 1e7 to 3e7 steps, a memory being 100 steps: 12.5 to 100 memories from one to the next", memories,
     lambda v: outside(math.log(v), math.log(12.5), math.log(100)), 0.3),
    ("stick-slip", "PE rises while the fault is locked: it falls in less than a third of the time", lambda r: number(r, "in_events"),
     lambda v: outside(v, 0.0, 0.33), 0.03),
    ("locked", "the fault is locked between events: it slips there at less than half of the plates' velocity †", lambda r: number(r, "rate_between"),
     lambda v: outside(v, 0.0, 0.5), 0.1),
    ("loading", "PE rises there by loading: by more than half of the work of the plates †", lambda r: number(r, "loading"),
     lambda v: outside(v, 0.5, math.inf), 0.1),
    ("velocities", "the density of slip velocities falls all the way", lambda r: number(r, "rise"), lambda v: outside(v, 0.0, 1.0), 0.5),
    ("neighbours", "slip at one contact mostly triggers its neighbours: less than half of the ruptures stay within one bin",
     lambda r: number(r, "one_bin"), lambda v: outside(v, 0.0, 0.5), 0.1),
    ("roll-off", "sizes roll off exponentially: 2 ln L over a power law without end above 3.84", lambda r: number(r, "roll_off_gain"),
     lambda v: outside(v, 3.84, math.inf), 3.84),
    ("waves", "P-waves run at 2.1", lambda r: WAVE_SPEED[r["mass"]], lambda v: abs(v - 2.12), 0.1),
    ("steps", "events are resolved †: at most 2 % last 3 steps or less", lambda r: number(r, "brief"), lambda v: outside(v, 0.0, 0.02), 0.02),
    ("swings", "events are slip †: few inter-event times are oscillations of the blocks", swings, lambda v: outside(v, 0.0, 0.02), 0.03),
)


def deviations(row, statements=STATEMENTS):
    """Deviations in units of the tolerances; ten if a statement cannot be evaluated for lack of events."""
    result = []
    for name, _, value, off, tolerance in statements:
        v = value(row)
        z = off(v) / tolerance if math.isfinite(v) and not (name in ("B", "events") and v <= 0) else math.nan
        result.append(min(z, 10.0) if math.isfinite(z) else 10.0)
    return result


def distance(row, statements=STATEMENTS):
    parts = deviations(row, statements)
    return math.sqrt(sum(part * part for part in parts) / len(parts))


def read(path):
    path = Path(path)
    with (lzma.open if path.suffix == ".xz" else open)(path, "rt") as lines:
        return list(rows_of(lines))


# Statements about the block-slider, each of which is evaluated at each of the five lengths.
SLIDER_STATEMENTS = (
    ("events", "3000 to 5000 in 1e7 steps", lambda r: number(r, "events"), lambda v: outside(math.log(v), math.log(3000), math.log(5000)), 0.3),
    ("small", "exponent 0.5 below size 1", lambda r: number(r, "exponent_1e-2:1"), lambda v: abs(v - 0.5), 0.1),
    ("large", "exponent 1.0 above", lambda r: number(r, "exponent_1:1e2"), lambda v: abs(v - 1.0), 0.1),
    ("gamma", "0.0", lambda r: number(r, "gamma"), abs, 0.1),
    ("B", "100 (a factor of 2)", lambda r: number(r, "B"), lambda v: abs(math.log(v / 100)), math.log(2)),
    ("C", "0.25", lambda r: number(r, "C"), lambda v: abs(v - 0.25), 0.05),
)

# ---- collect


def summary(postproc, folder, memory, work):
    from statements import statements_of  # needs NumPy
    picked = work / "picked.csv"
    common = dict(check=True, capture_output=True, text=True)
    series = next(folder.glob("*.pe.bin"))
    subprocess.run([postproc, "pick", series, "-o", picked, "--overwrite", "--memory-time", str(memory)], **common)
    words = [word for text in RANGES for word in ("--range", text)] + [word for text in WINDOWS for word in ("--window", text)]
    said = subprocess.run([postproc, "summary", picked, "--from", str(LOADING), *words], **common).stdout
    numbers = next(rows_of(said.splitlines()))
    values = {row["number"]: row["value"] for row in statements_of(postproc, picked, LOADING, folder / "fault.catalogue.csv")}
    return {**numbers, **{key: "" if values.get(name) is None else f"{values[name]:.6g}" for key, name in WORDED.items()}}


def collect(binaries, output, folders):
    rows, silent = [], defaults()
    if Path(output).exists():
        names = {Path(folder).name for folder in folders}
        rows = [row for row in read(output) if row["point"] not in names]
    with tempfile.TemporaryDirectory() as work:
        for folder in map(Path, folders):
            words = dict(line.split("=", 1) for line in (folder / "settings.txt").read_text().split("\n") if "=" in line)
            settings = {"point": folder.name, **{key: words.get(key, silent[key]) for key in SETTINGS}}
            if "failed" in json.loads((folder / "done.json").read_text()):
                rows.append({**settings, "memory": "", "stopped": "yes"})
                continue
            for memory in MEMORIES:
                numbers = summary(Path(binaries) / "postproc", folder, memory, Path(work))
                numbers.pop("label")
                rows.append({**settings, "memory": str(memory), "stopped": "no", **numbers})
    write(output, "# One row for each point and memory of the picker; stopped: a link was strained by half its length", rows)


def write(output, comment, rows):
    columns = list(dict.fromkeys(key for row in rows for key in row))
    with (lzma.open if str(output).endswith(".xz") else open)(output, "wt") as file:
        file.write(comment + "\n")
        table = csv.DictWriter(file, columns, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def collect_sliders(binaries, output, folders):
    rows = []
    for folder in map(Path, folders):
        words = dict(line.split("=", 1) for line in (folder / "settings.txt").read_text().split("\n") if "=" in line)
        settings = {key: words.get(key, "") for key in ("blocks", "scheme", "dt", "picker", "picker-lambda", "picker-memory-time")}
        for warmup in SLIDER_WARMUPS:
            said = subprocess.run([
                Path(binaries) / "postproc", "summary", folder / "catalogue.csv", "--from",
                str(warmup), "--method", "least-squares", "--range", "1e-2:1", "--range", "1:1e2", "--threshold", *SLIDER_SIZES
            ], check=True, capture_output=True, text=True).stdout
            numbers = next(rows_of(said.splitlines()))
            for size in SLIDER_SIZES:
                own = {key: numbers[f"{key}_{size}"] for key in ("events", "mean_time", "gamma", "gamma_error", "B", "C")}
                rows.append({
                    **settings, "warmup": str(warmup), "smallest": size, "exponent_1e-2:1": numbers["exponent_1e-2:1"],
                    "exponent_1:1e2": numbers["exponent_1:1e2"], **own
                })
    write(output, "# One row for each run, smallest size of the events and warm-up; 1e7 steps each", rows)


# ---- points


def nearest(rows, share=0.1):
    """The given share of the points, each with its best memory, that is nearest to the paper."""
    best = {}
    for row in rows:
        if row["point"] not in best or distance(row) < distance(best[row["point"]]):
            best[row["point"]] = row
    ordered = sorted(best.values(), key=distance)
    return ordered[:max(1, round(share * len(ordered)))], ordered


def points(path, length="120"):
    """Rows of the points of this length whose runs were completed, and the number of those stopped."""
    rows = [row for row in read(path) if row["length"] == length]
    return [row for row in rows if row["stopped"] == "no"], sum(row["stopped"] == "yes" for row in rows)


def figure(path, base):
    accepted, ordered = nearest(points(path)[0])
    taken = {row["point"] for row in accepted}

    def block(x, y, which):
        lines = [f"{x(row):.6g} {y(row):.6g}" for row in ordered if (row["point"] in taken) == which]
        return "\n".join(lines or ["nan nan"]) + "\ne\n"

    panels = [("exponent, 1e-4 to 0.1", "gamma >= 1e-4", lambda r: number(r, "exponent_1e-4:1e-1"), lambda r: number(r, "gamma_0.0001"),
               "unset logscale; set xrange [0.4:2.4]; set yrange [0:2]; "
               "set object 1 rect from 1.0,0.895 to 1.14,1.095 fs empty border rgb 'black' lw 2")]
    for key, label in (("stress", "normal stress"), ("viscosity", "viscosity"), ("kt", "tangential stiffness"),
                       ("impedance", "impedance of the plates"), ("memory", "memory of the picker")):
        scale = "unset logscale; " if key == "impedance" else "set logscale x; "
        low = {"viscosity": 5e-4}.get(key, 0.0)
        panels.append((label, "distance", lambda r, key=key, low=low: max(float(r[key]), low), distance,
                       f"unset object 1; {scale}set xrange [*:*]; set yrange [0:*]"))
    script = "set multiplot layout 2,3\nunset key\nset tics nomirror\nset border 3\n"
    for x, y, fx, fy, how in panels:
        script += f"{how}\nset xlabel '{x}'\nset ylabel '{y}'\n"
        script += "plot '-' w p pt 6 ps 0.6 lc rgb '#999999', '-' w p pt 7 ps 1 lc rgb '#d55e00'\n"
        script += block(fx, fy, False) + block(fx, fy, True)
    script += "unset multiplot\n"
    heads = [
        f"set terminal pngcairo size 1500,900 font 'DejaVu Sans,13'\nset output '{base}.png'\n",
        f"set terminal svg size 1000,600 font 'DejaVu Sans,11'\nset output '{base}.svg'\n"
    ]
    subprocess.run(["gnuplot"], input="".join(head + script + "unset output\nreset\n" for head in heads), text=True, check=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["collect"] and len(sys.argv) > 4:
        collect(*sys.argv[2:4], sys.argv[4:])
    elif sys.argv[1:2] == ["figure"] and len(sys.argv) == 4:
        figure(*sys.argv[2:])
    elif sys.argv[1:2] == ["sliders"] and len(sys.argv) > 4:
        collect_sliders(*sys.argv[2:4], sys.argv[4:])
    else:
        sys.exit(__doc__)
