#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the tables of the pages about results from the data in this folder.

tables.py POSTPROC            says which tables are not what the data give; exit status 1 if there is one
tables.py POSTPROC --write    writes them into the pages
tables.py POSTPROC --values   writes the numbers of sentences into values.csv, from which the pages take them
tables.py POSTPROC --csv      says which numbers of the CSV files that the published catalogues give are others, likewise

A table stands between the lines <!-- table NAME --> and <!-- end -->, in a page of this folder or the project's README.md, and numbers
of sentences before <!--n KEY-->, see values.py. Statistics are those of postproc; here are means over packings. A study whose data are
not in this folder has a line in place of its table.
"""
import cmath
import difflib
import functools
import itertools
import math
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER.parent / "python"), str(FOLDER.parent / "inputs"), str(FOLDER / "speed")]
import faults as article  # noqa: E402
import lsm  # noqa: E402
import nature  # noqa: E402
import page_values  # noqa: E402
import periods  # noqa: E402
import slip_or_exchange  # noqa: E402
import speed_tables  # noqa: E402
import validation_tables  # noqa: E402
import values  # noqa: E402
import walk  # noqa: E402
from lsm import LOADING, analysis, paper, scaling, slip, statements, summary  # noqa: E402
from lsm.tables import memory_of, number, read, text_of  # noqa: E402
from variables import defaults  # noqa: E402

POSTPROC = "postproc"  # the program, set by main()
POINTS, SLIDERS = FOLDER / "calibration/points.csv.xz", FOLDER / "calibration/sliders.csv.xz"
DEFAULT = FOLDER / "calibration/default.csv.xz"  # points from which the default was chosen
CAMPAIGN, VALIDATION, DAMPING, SLIP, RECIPES = (FOLDER / name for name in ("campaign", "validation", "damping", "slip", "packing"))
PRESETS = {"default": CAMPAIGN, "preset paper": DAMPING, "preset slip": SLIP}
JUDGED = {folder: slip_or_exchange.FAULTS[folder.name] for folder in (DAMPING, SLIP)}  # events of which are said to be slip or not
HALF_STEP_UNTIL = 57800  # of the run at length 480 with half the time step
BURST = 0.6  # events that follow another faster are those of short waves
SIZES = ("1e-4", "1e-3", "1e-2")
EXPONENTS = {text.replace(":", " to "): f"exponent_{text}" for text in paper.RANGES}

# ---- numbers of postproc


@functools.cache
def numbers_of(command, *words):
    """The numbers (JSON) that a command of postproc finds."""
    return analysis.numbers_of(POSTPROC, command, *words)


def grouped(rows, key):
    groups = {}
    for row in rows:
        groups.setdefault(key(row), []).append(row)
    return groups


def faults(kind="catalogue", folder=CAMPAIGN):
    """{length: paths by seed}. \\raises FileNotFoundError if there are none"""
    groups = grouped(sorted(folder.glob(f"fault_*.{kind}.csv.xz")), lambda path: int(path.name.split("_")[1].split(".")[0]))
    if not groups:
        raise FileNotFoundError
    return dict(sorted(groups.items()))


@functools.cache
def loaded(path):
    """Time from which a catalogue counts: wider blocks are loaded later."""
    return LOADING * float(lsm.read_catalogue(path).header["width"]) / 30


@functools.cache
def summaries(folder=CAMPAIGN):
    """A row of lsm.summary for each catalogue, with the numbers of lsm.statements if these were measured."""
    paths, worded = [path for some in faults(folder=folder).values() for path in some], {}
    rows = []
    for begin, some in itertools.groupby(paths, loaded):
        rows += summary.rows_of(POSTPROC, list(some), ranges=paper.RANGES, windows=paper.WINDOWS, begin=begin,
                                parameters=("length", "seed", "width", "dt", "lambda", "mass"))
    for row in read(folder / "statements.csv") if (folder / "statements.csv").exists() else []:
        worded.setdefault(row["run"], {})[row["number"]] = row["value"]
    for path, row in zip(paths, rows):
        row["memory"] = str(memory_of(row))
        row |= {key: worded.get(path.name.split(".")[0], {}).get(text, "") for key, text in paper.WORDED.items()}
    return rows


@functools.cache
def use(length, seed):
    """Whether the values of the fault were fitted to this packing, or it is predicted."""
    return "fitted" if any((row.get("length") or "120", row["seed"]) == (length, seed) for row in read(DEFAULT)) else "predicted"


def by_length(rows=None):
    """Rows of the campaign: {"120, fitted": rows, "120, predicted": rows, ...}."""
    rows = sorted(rows or summaries(), key=lambda row: (float(row["length"]), use(row["length"], row["seed"]) == "predicted"))
    return grouped(rows, lambda row: f"{row['length']}, {use(row['length'], row['seed'])}")


# ---- cells


def table(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|---" * len(head) + "|"] + ["| " + " | ".join(row) + " |" for row in rows])


def turned(head, rows):
    """The same table with a column for each of these rows."""
    lines = list(zip(head, *rows))
    return table(lines[0], lines[1:])


def shown(value, error=math.nan):
    """A value as 0.667 ± 0.021. The error has one digit, or two if it begins with less than 3.5; without an error there are three."""
    if value is None or not math.isfinite(value):
        return "-"
    if not error > 0:
        return f"{value:.{min(4, max(0, 2 - math.floor(math.log10(abs(value)))))}f}" if value else "0"
    last = math.floor(math.log10(error))
    places = max(0, -last + (1 if error / 10**last < 3.5 else 0))
    return f"{value:.{places}f} ± {error:.{places}f}"


def spread(values, error=math.nan):
    """Mean and standard deviation between packings; two numbers as they are, as two show no deviation; of one its own error, if given."""
    values = [x for x in values if x is not None and math.isfinite(x)]
    if len(values) == 2:
        return ", ".join(map(shown, values))
    return shown(statistics.mean(values), statistics.stdev(values) if len(values) > 1 else error) if values else "-"


def of(row, key):
    """A number with its error, which is in another column of the row."""
    names = (f"{key}_error", f"{key}_sd", key.replace("exponent_", "error_"), key.replace("gamma_", "gamma_error_"))
    return shown(number(row, key), next((number(row, name) for name in names if name != key and name in row), math.nan))


def over(rows, key):
    """A number over packings, of a single one with its own error."""
    return of(rows[0], key) if len(rows) == 1 else spread([number(row, key) for row in rows])


# ---- the fault


def judged(rows, statement):
    """Mean and deviation of a statement over packings, in bold if it misses the tolerance by two standard errors."""
    values = [x for x in map(statement.value, rows) if math.isfinite(x)] or [math.nan]
    mean = statistics.mean(values)
    slack = 2 * statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else 0.0
    met = math.isnan(mean) or min(statement.deviation_of(x) for x in (mean - slack, mean, mean + slack) if x > 0 or mean <= 0) <= 1
    return spread(values) if met else f"**{spread(values)}**"


def tolerance_of(statement):
    return f"a factor of {math.exp(statement.tolerance):.3g}" if statement.log else f"{statement.tolerance:.2g}"


@functools.cache
def slip_shares():
    """Share of the events of 0.001 to 0.1 that are slip, beyond chance, of each packing: {(preset, length): {seed: share}}."""
    found, shares = {}, {}
    for preset in "preset paper", "preset slip":
        for row in read(PRESETS[preset] / "kinds.csv"):
            if float(row["smallest"]) in (0.001, 0.01):
                name = "default" if row["run"].startswith("damped") else preset
                found.setdefault((name, row["length"], row["seed"]), []).append((float(row["events"]), float(row["slip"])))
    for (name, length, seed), some in found.items():
        shares.setdefault((name, length), {})[seed] = sum(n * x for n, x in some) / sum(n for n, _ in some)
    return shares


def paper_table():
    """Each statement for the three faults."""
    groups, slip = {}, slip_shares()
    for name, folder in PRESETS.items():
        rows = grouped(of_all_times(folder), lambda row: row["length"])
        groups |= {(name, length): rows[length] for length in (("120",) if name == "default" else ("120", "480"))}
    shares = [spread(slip.get(key, {}).values()) for key in groups]
    out = [["share of events of 0.001 to 0.1 that are slip, beyond chance †", *shares]]
    out += [[f"{one.text} ({tolerance_of(one)})", *(judged(rows, one) for rows in groups.values())] for one in paper.STATEMENTS]
    return table(["statement of the paper, or † (tolerance)", *map(", ".join, groups)],
                 [row for row in out if set(row[1:]) != {"-"}] + [["packings", *(str(len(rows)) for rows in groups.values())]])


def agreement_table():
    """The first numbers of the README."""
    columns = {"drops >= 1e-4 in 1000 time units": ("rate.drops.{}.0.0001", "()"), "slips >= 0.1 (ours)": ("rate.slips.{}.0.1", "()")}
    columns |= {"exponent": ("exponent.all.{}", "()"), "gamma": ("gamma.all.{}", "()"), "B": ("B.all.{}", "()")}
    rows = [f"{fault}.{length}" for fault in article.FAULTS for length in (120, 480, 1890)]
    head, line, *rest = keyed_table("fault, length", rows, columns).split("\n")
    packings = [f"{values.read()[f'exponent.all.{row}'].n}, {article.FITTED.get(row, 0)} |" for row in rows]
    lines = [head + " packings, of which fitted |", line + "---|", f"| paper, all lengths | {article.PAPER:.0f} |  | 1.07 | 0.995 | 15.2 |  |"]
    return "\n".join(lines + [f"{cells} {packing}" for cells, packing in zip(rest, packings)])


def scaling_of(kind, least, folder=CAMPAIGN):
    """Exponent and characteristic size of each catalogue, {length: [(fit, point)]}, and how the size depends on the length."""
    groups = faults(kind, folder)
    paths = [path for some in groups.values() for path in some]
    fits = numbers_of("fit", *paths, "--threshold", least, "--from", LOADING, "--range", f"{least}:1", "--replicas", 0, "--no-comparison",
                      "--no-picture")["fits"]
    found, = scaling.scalings([scaling.load(path, loaded(path)) for path in paths], float(least))
    each = iter(zip(fits, found.points))
    return {length: [next(each) for _ in some] for length, some in groups.items()}, found.fit


def roll_off_table():
    """Scaling of the largest events with the length, as drops of the total PE and as ruptures."""
    found = {}
    for what, kind, least in (("s* of drops of PE >= 1e-3", "catalogue", "1e-3"), ("s* of ruptures >= 1e-2", "ruptures", "1e-2")):
        groups, fit = scaling_of(kind, least)
        found[what] = [spread([point.s_star for _, point in some], some[0][1].error) for some in groups.values()]
        found[what] += [
            f"L^({shown(fit['D'], fit['D_error'])})", f"{fit['chi2']:.0f}, {fit['n'] - 2}", f"{fit['aicc']:.1f}, {fit['aicc_constant']:.1f}"
        ]
    found["largest drop"] = [spread([number(row, "largest") for row in summaries() if row["length"] == str(length)]) for length in groups]
    lines = [*map(str, groups), "power law", "chi^2, degrees of freedom", "AICc of it, of a constant"]
    return table(["length", *found], [[line, *cells] for line, *cells in itertools.zip_longest(lines, *found.values(), fillvalue="")])


def lengths_table():
    """The paper's numbers at each length, and the characteristic size of drops of PE and of ruptures."""
    columns = {"exponent 1e-4 to 0.1": EXPONENTS["1e-4 to 1e-1"], "gamma": "gamma_0.0001", "one event in": "mean_time_0.0001"}
    columns |= {"characteristic size of energy drops": "drops", "of ruptures": "ruptures"}
    groups = by_length(with_sizes(with_sizes(summaries(), "catalogue", "1e-3", "drops"), "ruptures", "1e-2", "ruptures"))
    rows = [[name, *(over(rows, key) for key in columns.values())] for name, rows in groups.items()]
    return table(["length", *columns], [["paper", "1.07", "0.995", "15.1", "grows with the length", "-"], *rows])


def packing_of(row):
    return f"{row['length']}, {row['seed']}, {use(row['length'], row['seed'])}"


def catalogues_table():
    """The catalogues one by one."""
    columns = {
        "length, packing": packing_of, f"events >= {', '.join(SIZES)}": lambda row: ", ".join(row[f"events_{float(size):g}"] for size in SIZES)
    }
    columns |= {f"gamma >= {size}": f"gamma_{float(size):g}" for size in SIZES}
    return study_table("", columns | {"largest": "largest"}, summaries())


def decades_table():
    """Exponents of the catalogues one by one."""
    return study_table("", {"length, packing": packing_of} | EXPONENTS, summaries())


def ruptures_table():
    """Ruptures >= 1e-2 of each run."""
    paths, out = faults("ruptures"), []
    for length, some in scaling_of("ruptures", "1e-2")[0].items():
        for path, (fit, point) in zip(paths[length], some):
            rows = [row for row in read(path) if number(row, "t_start") >= LOADING and number(row, "size") >= 1e-2]
            time, lengths = max(number(row, "t_end") for row in rows) - LOADING, [number(row, "rupture_length") for row in rows]
            frequent = sum(x > 10 for x in lengths) / time / length * 1e5
            whole = sum(x >= length for x in lengths)
            numbers = shown(fit["exponent"], fit["standard_error"]), shown(point.s_star, point.error)
            out.append([str(length), f"{frequent:.1f}", *numbers, f"{max(lengths):.0f}", str(whole)])
    return table(["length", "longer than 10, per 1e5 time units and unit of length", "exponent 1e-2 to 1", "s*", "longest", "of the whole fault"],
                 out)


def same_times_table():
    """Tests whether inter-event times over their mean have the same distribution at all lengths."""
    groups = faults()
    base = next(iter(groups.values()))

    def text(paths, size):
        p = []
        for n, path in enumerate(paths):
            others = base[:n] if paths is base else base
            words = (path, *others, "--from", LOADING, "--rescale", "--replicas", 400, "--threshold", size)
            p += [test["p"] for test in numbers_of("compare", *words)["tests"] if test["quantity"] == "time"] if others else []
        return f"{sum(x < 0.05 for x in p)} of {len(p)}, {statistics.median(p):.2f}" if p else "-"

    return table(["length", *(f"events >= {size}" for size in SIZES)],
                 [[str(length), *(text(paths, size) for size in SIZES)] for length, paths in groups.items()])


def worded_table(kept):
    """Numbers of lsm.statements whose names begin so, over the packings of each length."""
    rows = [row for row in read(CAMPAIGN / "statements.csv") if row["number"].startswith(kept)]
    columns = grouped(rows, lambda row: row["number"])
    lengths = [length for length in faults() if any(row["length"] == str(length) for row in rows)]
    cells = [[spread([number(row, "value") for row in some if row["length"] == str(length)]) for some in columns.values()] for length in lengths]
    printed = [some[0]["expected"] for some in columns.values()]
    return table(["length", *columns], [["paper", *printed], *([str(length), *line] for length, line in zip(lengths, cells))])


def numbers_table():
    return worded_table(("events in", "B,", "C,", "power d"))


def slip_shares_table():
    return worded_table(("slip rate within", "share of the slip"))


def with_sizes(rows, kind, least, key, folder=CAMPAIGN):
    """These summaries of a folder with the characteristic size of the drops of PE or of the ruptures of each run."""
    points = (point for pairs in scaling_of(kind, least, folder)[0].values() for _, point in pairs)
    return [{**row, key: str(point.s_star), f"{key}_error": str(point.error)} for row, point in zip(rows, points)]


def validation_table():
    """Other widths and time steps compared with the campaign's runs of the same length."""
    keys = EXPONENTS | {
        "gamma >= 1e-4": "gamma_0.0001", "one event in": "mean_time_0.0001", "largest": "largest", "s* of ruptures >= 1e-2": "ruptures"
    }
    others, ours = (with_sizes(summaries(folder), "ruptures", "1e-2", "ruptures", folder) for folder in (VALIDATION, CAMPAIGN))
    rows = [row for row in ours + others if row["length"] == "120"]
    groups = grouped(sorted(rows, key=lambda row: float(row["width"])), lambda row: (row["length"], row["width"], f"{float(row['dt']):g}"))
    names = [f"width {width}, time step {dt} ({len(some)} packing{'s' * (len(some) > 1)})" for (_, width, dt), some in groups.items()]
    return turned(["", *keys], [[name, *(over(some, key) for key in keys.values())] for name, some in zip(names, groups.values())])


def widths_table():
    """Ruptures in blocks of several widths, once they are loaded, and what those of the whole fault are of them."""
    found = {}
    for folder in CAMPAIGN, VALIDATION:
        for path in (path for length, paths in faults("ruptures", folder).items() if length <= 480 for path in paths):
            header = lsm.read_catalogue(path).header
            length, width = float(header["length"]), float(header["width"])
            if header["dt"] == "0.12":
                events = analysis.events_of(path, loaded(path))
                events = events[events["size"] >= 1e-2]
                size, whole = events["size"], events["rupture_length"] >= length
                numbers = len(size), np.sum(size**2) / np.sum(size), np.sum(whole), 100 * np.sum(size[whole]**2) / np.sum(size**2)
                found.setdefault((width, length), []).append([float(one) for one in numbers])
    rows = [[f"{length:g}, {width:g}", f"{len(some)}", *(spread(one) for one in zip(*some))] for (width, length), some in sorted(found.items())]
    return table(["length, width", "packings", "ruptures >= 0.01", "s*", "of the whole fault", "their share of the sum of s^2, %"], rows)


def variance_table():
    """Variance of the changes of PE over that for independent stretches, and the correlation of neighbours."""
    groups = {}
    for row in read(FOLDER / "stretches.variance.csv"):
        groups.setdefault(f"length {row['length']}, {row['stretches']} stretches", {})[row["lag"]] = f"{row['ratio']}, {row['correlation_1']}"
    return turned(["over a time of", *next(iter(groups.values()))], [[name, *cells.values()] for name, cells in groups.items()])


def stretches_table():
    """Events of the whole fault, of its stretches shifted in time, and of each with a picker of its own."""
    columns = {"length: energy of": lambda row: f"{row['length']}: {row['what']}", "one event in": "mean_time", "gamma": "gamma"}
    return study_table("stretches.events.csv", columns | {"gamma >= 1e-3": "gamma_1e-3", "exponent": "exponent", "largest": "largest"})


# ---- damping


def apart(starts):
    """Of each event but the first, whether it does not follow at once."""
    return np.diff(starts) >= BURST


@functools.cache
def of_all_times(folder):
    """summaries() with gamma and B of all inter-event times, as in the calibration, and the mean time without events that follow at once."""
    paths = [path for some in faults(folder=folder).values() for path in some]
    all_times = summary.rows_of(POSTPROC, paths, ["1e-4"], begin=LOADING, shortest=0)
    rows = []
    for path, row, one in zip(paths, summaries(folder), all_times):
        starts = [number(event, "t_start") for event in read(path)]
        own = {key: one[key] for key in ("gamma_0.0001", "gamma_error_0.0001", "B_0.0001")}
        rows.append({**row, **own, "gamma_longer": row["gamma_0.0001"], "apart": str((starts[-1] - starts[0]) / (1 + apart(starts).sum()))})
    return rows


def decades_of(row):
    """The exponents of the single decades."""
    return ", ".join(shown(number(row, key)) for key in list(EXPONENTS.values())[1:])


def of_preset(preset):
    """Catalogues of a preset, one by one."""
    shares = slip_shares()
    columns = {"length, packing": lambda row: f"{row['length']}, {row['seed']}", "exponent 1e-4 to 0.1": EXPONENTS["1e-4 to 1e-1"]}
    columns |= {"gamma": "gamma_0.0001", "B": "B_0.0001", "one event in": lambda row: shown(number(row, "mean_time_0.0001"))}
    columns |= {"slip of 0.001 to 0.1, % †": lambda row: f"{100 * shares[preset, row['length']][row['seed']]:.0f}"}
    return study_table("", columns, of_all_times(PRESETS[preset]))


def preset_details_table():
    """Of the same catalogues: each decade, and what is left without bursts."""
    rows = [{**row, "fault": name} for folder, name in JUDGED.items() for row in of_all_times(folder)]
    columns = {"fault, length, packing": lambda row: f"{row['fault']}, {row['length']}, {row['seed']}", "exponent in each decade": decades_of}
    columns |= {"distance": lambda row: f"{number(row, 'ks_1e-4:1e-1'):.2g}"}
    columns |= {"gamma of times above 2.5 memories": lambda row: shown(number(row, "gamma_longer"))}
    columns |= {"one event in, without those within 0.6": lambda row: shown(number(row, "apart"))}
    return study_table("", columns, rows)


def preset_paper_table():
    return of_preset("preset paper")


def preset_slip_table():
    return of_preset("preset slip")


def slip_rates_table():

    def slip_time(row, least):
        return shown(number(row, f"slip_{least}")) if number(row, f"share_{least}") > 0.03 else "-"  # as many as by chance

    columns = {"fault, length, packing": lambda row: f"{row['fault']}, {row['length']}, {row['seed']}"}
    for least in ("0.001", "0.01", "0.1"):
        columns[f">= {least}: one slip in"] = lambda row, least=least: slip_time(row, least)
        columns[f"of all >= {least}, %"] = lambda row, least=least: f"{round(100 * number(row, f'share_{least}'))}"
    return study_table("slip_rates.csv", columns)


def wandering_table():
    """Numbers of consecutive stretches, each as long as a run of the calibration."""
    out, long = [], paper.STEPS * 0.12 - LOADING
    for folder, name in JUDGED.items():
        for length, path in ((length, path) for length, paths in faults(folder=folder).items() for path in paths):
            ends = np.arange(LOADING + long, max(number(row, "t_end") for row in read(path)), long)
            if len(ends) < 2:
                continue
            rows = [summary.rows_of(POSTPROC, [path], ["1e-4"], ["1e-4:1e-1"], begin=end - long, end=end, shortest=0)[0] for end in ends]
            gammas = [number(row, "gamma_0.0001") for row in rows]
            cells = [
                f"{shown(statistics.stdev(value(row) for row in rows))}, {shown(statistics.mean(error(row) for row in rows))}"
                for value, error in ((lambda row: number(row, "gamma_0.0001"), lambda row: number(row, "gamma_error_0.0001")),
                                     (lambda row: number(row, EXPONENTS["1e-4 to 1e-1"]), lambda row: number(row, "error_1e-4:1e-1")),
                                     (lambda row: math.log(number(row, "mean_time_0.0001")), lambda row: number(row, "events_0.0001")**-0.5))
            ]
            out.append(
                [f"{name}, {length}, {path.name.split('_')[2].split('.')[0]}",
                 str(len(rows)), f"{shown(min(gammas))}, {shown(max(gammas))}", *cells])
    return table([
        "fault, length, packing", "stretches", "gamma: least, largest", "gamma: deviation, error of a fit", "exponent: the same",
        "ln of the mean time: deviation, if by chance"
    ], out)


def short_waves_table():
    """The hardly damped fault, packing 4, with retardation of links; without, in as much time."""
    rows = [row for row in read(DAMPING / "points.csv") if row["point"].startswith("t_") and row["memory"] == "1" and row["retardation"] != "0"]
    without = []
    for length, some in grouped(rows, lambda row: row["length"]).items():
        end = LOADING + statistics.median(number(row, "time") for row in some)
        without += in_window(f"fault_{length}_4", LOADING, end)
    without = [{**row, "retardation": "0"} for row in without]
    columns = {"length, retardation": lambda row: f"{row['length']}, {float(row['retardation']):g}", "one event in": "mean_time_0.0001"}
    columns |= {"exponent 1e-4 to 0.1": EXPONENTS["1e-4 to 1e-1"], "gamma of all times": "gamma_0.0001", "B": "B_0.0001"}
    return study_table("", columns, sorted(without + rows, key=lambda row: (int(row["length"]), float(row["retardation"]))))


def recipes_table():
    """Preset paper in packings of two recipes."""
    out, folders = [], {"random places": DAMPING, "grid, loose discs removed": RECIPES / "removed", "grid, loose discs kept": RECIPES / "kept"}
    for recipe, folder in folders.items():
        rows = with_sizes(of_all_times(folder), "catalogue", "1e-3", "s*", folder)
        for row in (row for row in rows if row["seed"] == "4"):
            out.append([
                f"{recipe}, {row['length']}", f"{of(row, EXPONENTS['1e-4 to 1e-1'])} ({decades_of(row)})",
                of(row, "gamma_0.0001"),
                of(row, "B_0.0001"),
                of(row, "mean_time_0.0001"), f"{of(row, 's*')}, {shown(number(row, 'largest'))}"
            ])
    return table(["recipe, length", "exponent (in each decade)", "gamma of all times", "B", "one event in", "s*, largest event"], out)


def in_window(name, begin, end, folder=DAMPING):
    """Numbers of the events of a fault within a time."""
    path = folder / f"{name}.catalogue.csv.xz"
    return summary.rows_of(POSTPROC, [path], ["1e-4"], ["1e-4:1e-1"], (), ("length", "dt"), begin, end, shortest=0)


def half_step_table():
    """The same with shorter time steps, in the same time; at length 480 of the hardly damped fault from the same state on."""
    out, whole, half = [], (LOADING, 108000, DAMPING), (LOADING, 58000, DAMPING)
    keys = "mean_time_0.0001", EXPONENTS["1e-4 to 1e-1"], "gamma_0.0001", "B_0.0001"
    runs = [(f"{step}_120_{seed}", f"hardly damped, 120, {seed}", whole) for seed in "456" for step in ("fault", "half")]
    runs += [(f"{step}_120_{seed}", f"hardly damped, 120, {seed}, half as long", half) for seed in "46" for step in ("fault", "half", "quarter")]
    for step in "fault", "half":
        runs.append((f"{step}_480_4", "hardly damped, 480, 4", (37300, HALF_STEP_UNTIL, DAMPING)))
    for step in "fault", "half":
        runs.append((f"{step}_120_4", "preset slip, 120, 4", (LOADING, 15000, SLIP)))
    for name, fault, (begin, end, folder) in runs:
        row, = in_window(name, begin, end, folder)
        events = lsm.read_catalogue(folder / f"{name}.catalogue.csv.xz")
        starts = events["t_start"][(events["size"] >= 1e-4) & (events["t_start"] >= begin) & (events["t_end"] <= end)]
        out.append([f"{fault}, {float(row['dt']):g}", *(of(row, key) for key in keys), shown(100 * np.mean(~apart(starts)))])
    names = {"k_120_0.6_": "kt 0.6", "d_120_5e-4_0.6_2": "impedance 0.6", "f_120_0.6_2": "impedance 0.6", "position_120_2": "plates in place"}
    names["f_120_position_2"] = "plates in place"
    points = [(next((name for start, name in names.items() if row["point"].startswith(start)), ""), row) for row in read(DAMPING / "points.csv")]
    for name, row in sorted(points, key=lambda one: (one[0], -number(one[1], "dt"))):
        if name and row["memory"] == "1":
            out.append([f"{name}, 120, {float(row['dt']):g}", *(of(row, key) for key in keys), "-"])
    return table(["fault, length, packing, time step", "one in", "exponent 1e-4 to 0.1", "gamma of all times", "B", "within 0.6 of another, %"], out)


def motion_table():
    """Kinetic energy by period and by radius of the disc."""
    rows, retarded = read(DAMPING / "motion.csv"), {row["shortest"]: row for row in read(DAMPING / "motion_retarded.csv")}

    def cells(row):
        return [
            shown(100 * number(row, "share")),
            shown(100 * number(retarded[row["shortest"]], "share")),
            *(f"{100 * sum(number(row, f'to_{r}') for r in some):.0f}" for some in (("0.12",), ("0.2", "0.4"))),
            shown(100 * number(row, "largest_disc"))
        ]

    return table(
        ["period", "% of the kinetic energy", "with retardation 0.001", "% of the first in discs up to 0.12", "0.12 to 0.4", "in one disc, at most"],
        [["all: mass" if row["shortest"] == "mass" else f"{float(row['shortest']):.2g} to {row['longest']}", *cells(row)] for row in rows])


def kinetic_table():
    """Kinetic energy in stretches of time, for each retardation of links, width and preset, divided by the width in units of 30."""
    columns = {"e_120_paper_4": "preset paper", "t_120_1e-3_0.03_4": "retardation 0.001", "t_120_4e-3_0.03_4": "0.004", "e_120_30_1": "width 30"}
    columns |= {"e_120_60_1": "60", "e_120_120_1": "120", "e_120_slip_4": "preset slip", "e_120_statistics_1": "default"}
    found = {(row["run"], int(row["begin"])): number(row, "kinetic") for row in read(DAMPING / "kinetic.csv")}
    widths = {"e_120_60_1": 60, "e_120_120_1": 120}
    begins = *range(0, 14000, 2000), 16000, 20000, 28000, 36000

    def text(run, begin):
        return f"{found[run, begin] * 30 / widths.get(run, 30):.2g}" if (run, begin) in found else "-"

    return table(["from time, on the mean of 2000", *columns.values()], [[str(begin), *(text(run, begin) for run in columns)] for begin in begins])


def width_table():
    """Blocks of other widths and masses, plates of other velocities and in place, packing by packing."""
    rows, keys = [row for row in read(DAMPING / "points.csv") if row["memory"] == "1"], {"one event in": "mean_time_0.0001"}
    rows = [row for row in rows if row["point"].startswith(("w_120", "v_120", "d_120_5e-4_0_", "r3_120", "position_120"))]

    def changed(row):
        return ", masses r^3" * (row["mass"] == "r3") + ", plates in place" * (row["hold"] == "position")

    rows.sort(key=lambda row: (changed(row), number(row, "velocity"), number(row, "width"), row["seed"]))
    groups = grouped(rows, lambda row: f"{row['width']}, {row['velocity']}{changed(row)}")
    keys |= {"B of all times": "B_0.0001", "gamma of all times": "gamma_0.0001", "exponent 1e-4 to 0.1": EXPONENTS["1e-4 to 1e-1"], "from": "begin"}
    return table(["width, velocity of the plates", *keys], [[name, *(over(rows, key) for key in keys.values())] for name, rows in groups.items()])


def quality_table():
    """How fast glued blocks stop ringing."""
    columns = {"viscosity, impedance": lambda row: f"{float(row['viscosity']):g}, {float(row['impedance']):g}"}
    columns |= {f"amplitude in the first {slip_or_exchange.RINGING:g} time units": "first", "second": "second", "fourth": "fourth", "Q": "quality"}
    ringing = 2 * math.pi / slip_or_exchange.RINGING
    columns |= {"by its viscosity": lambda row: shown(ringing / float(row["viscosity"])) if float(row["viscosity"]) else "-"}
    return study_table("damping/quality.csv", columns)


def crossing_table():
    """Events that begin while waves of an earlier, larger one cross the blocks."""
    out, crossing = [], 30 / paper.WAVE_SPEED["r2"]
    for name, folder, packing in (("hardly damped", DAMPING, "4"), ("preset slip", SLIP, "4"), ("damped, plates absorb", CAMPAIGN, "1")):
        for length in ("120", "240", "480", "945", "1890"):
            found = lsm.read_catalogue(folder / f"fault_{length}_{packing}.catalogue.csv.xz")
            found = found[(found["size"] >= 1e-4) & (found["t_start"] >= LOADING)]
            ends, span = found["t_end"][found["size"] >= 1e-2], found["t_end"][-1] - found["t_start"][0]
            after = ends.searchsorted(found["t_start"], "right")
            near = sum(bool(k) and start - ends[k - 1] < crossing for k, start in zip(after, found["t_start"]))
            by_chance = 1 - math.exp(-crossing * len(ends) / span)
            out.append([f"{name}, {length}, {packing}", str(len(found)), shown(span / len(ends)), shown(near / len(found)), shown(by_chance)])
    return table(["fault, length, packing", "events", "one of 0.01 or more in", "share that begins within a crossing after one", "by chance"], out)


def of_kinds(text, chosen=lambda row: True):
    """Events by size, a column for each decade."""
    groups = {}
    for folder, name in JUDGED.items():
        groups |= grouped(
            filter(chosen, read(folder / "kinds.csv")),
            lambda row, name=name: f"{'damped, plates absorb' if row['run'].startswith('damped') else name}, {row['length']}, {row['seed']}")
    cells = {name: {float(row["smallest"]): text(row) for row in rows} for name, rows in groups.items()}
    return table(["fault, length, packing", "1e-4 to 1e-3", "1e-3 to 1e-2", "1e-2 to 0.1", "above"],
                 [[name, *(found.get(size, "-") for size in (1e-4, 1e-3, 1e-2, 0.1))]
                  for name, found in sorted(cells.items(), key=lambda one: (one[0].split(",")[0], *map(int, one[0].split(",")[-2:])))])


def kinds_table():
    """Share of the events that are slip, and number of events."""
    return of_kinds(lambda row: f"{round(100 * number(row, 'slip'))} ({row['events']})")


def ranks_table():
    """What friction does in the events, how far the place slips that slips farthest, and whether the slip lies together."""
    return of_kinds(lambda row: ", ".join(f"{number(row, key):.2f}" for key in ("friction", "rank", "together")),
                    lambda row: row["run"].startswith("damped") or row["seed"] == "4" and row["length"] in ("120", "480", "945", "1890"))


def apart_table():
    """Events that count as slip, and the others, as catalogues of their own."""
    out = []
    for folder, name, length in [(*one, length) for one in JUDGED.items() for length in ("120", "480", "1890")]:
        with tempfile.TemporaryDirectory() as work:
            paths = [Path(work, kind) for kind in ("slip.csv", "others.csv")]
            for path, kind in zip(paths, (">", "<=")):
                command = [POSTPROC, "select", folder / f"fault_{length}_4.catalogue.csv.xz", "--where", f"excess {kind} {slip.SLIP}"]
                subprocess.run([*command, "-o", path], check=True, stdout=subprocess.DEVNULL)
            rows = summary.rows_of(POSTPROC, paths, ["1e-4"], paper.RANGES[:1], begin=LOADING, shortest=0)
        cells = [", ".join(shown(number(row, key)) for key in ("mean_time_0.0001", EXPONENTS["1e-4 to 1e-1"], "gamma_0.0001")) for row in rows]
        out.append([f"{name}, {length}, 4", *cells])
    return table(["one in, exponent, gamma", "events that count as slip", "the others"], out)


def energies_table():
    keys = {"events": lambda row: row["events"], "one in": "one_in", "exponent": "exponent", "gamma of all times": "gamma"}
    names = {"e_120_statistics_1": "damped, plates absorb", "e_120_paper_4": "hardly damped", "e_120_slip_4": "preset slip"}
    return study_table("damping/energies.csv", {"fault": lambda row: names[row["run"]], "drops of": lambda row: row["energy"]} | keys)


def surrogates_table():
    columns = {
        "fault": lambda row: row["run"].replace("fault", "hardly damped").replace("_", " "), "series": lambda row: row["series"], "one in": "one_in",
        "by its spectrum": "by_spectrum"
    }
    rows = [row for folder in JUDGED for row in read(folder / "surrogates.csv")]
    return study_table("", columns | {"exponent": "exponent", "gamma, B of all times": lambda row: f"{of(row, 'gamma')}, {of(row, 'B')}"}, rows)


def switched_table():
    groups = grouped(read(DAMPING / "switched.csv"), lambda row: row["run"])
    return table(["from then on, time units after it", *(str(1000 * n) for n in range(5))],
                 [[f"switched {name.replace('_', ', packing ')}", *(row["events"] for row in rows[:5])] for name, rows in groups.items()])


# ---- calibration


def statements_table():
    """What points of the calibration and samples of its posterior meet."""
    found, rows = {row["statement"]: row for row in read(FOLDER / "calibration.statements.csv")}, paper.completed(POINTS)

    def shares(row, length):
        return f"{100 * number(row, f'prior_{length}'):.0f}, {100 * number(row, f'posterior_{length}'):.0f}" if row.get(f"prior_{length}") else "-"

    def points(one):
        return len({row["point"] for row in rows if one.deviation(row) <= 1})

    out = [[one.text, tolerance_of(one),
            str(points(one)), *(shares(found[one.name], length) for length in ("120", "480"))] for one in paper.STATEMENTS]
    head = ["fitted, but for †", "tolerance", f"of {len({row['point'] for row in rows})} points", "% of prior, posterior at 120", "at 480"]
    stopped = sum(row["stopped"] == "yes" for row in read(POINTS))
    return table(head, out) + (f"\n\nMore that stopped, as a link was strained by half its length: {stopped}." if stopped else "")


def surrogate_table():
    """Error of the surrogate at points that it was not given, beside what these differ by."""
    rows = [row for row in read(FOLDER / "calibration.statements.csv") if row["left_out"]]
    units = {name: "ln of it" if one.log else "" for name, one in paper.STATEMENTS_BY_NAME.items()}
    return table(["number", "left out", "standard deviation of the points"],
                 [[", ".join(filter(None, (row["statement"], units[row["statement"]]))), row["left_out"], row["spread"]] for row in rows])


def nearest_table():
    """The points nearest to what is printed, at each length."""
    rows, out = paper.nearest(paper.completed(POINTS)), []
    values, silent = paper.STATEMENTS_BY_NAME, defaults("absorbing")

    def text(row, *names):
        return ", ".join(shown(values[name].value(row)) for name in names)

    slip = [row for row in rows if values["slip"].deviation(row) <= 0]
    for row in [row for row in rows if row["length"] == "120"][:4] + [row for row in rows if row["length"] == "480"][:3] + slip[:3]:
        words = []
        for key in ("stress", "viscosity", "kt", "mus", "retardation", "impedance", "hold", "mass", "contacts", "seeds", "loose", "memory"):
            if row[key] and row[key] != silent.get(key):
                words.append(f"{key} {row[key]}")
        out.append([
            f"{row['point']}, {row['length']}", ", ".join(words),
            text(row, "exponent", "decades"),
            text(row, "gamma", "B"),
            text(row, "slip"),
            shown(paper.distance(row))
        ])
    return table(["fitted: point, length", "values", "exponent, rms of decades", "gamma, B", "excess †", "distance"], out)


def scale_and_time(row):
    """B and the mean time between events."""
    return f"{shown(number(row, 'B_0.0001'))}, {shown(number(row, 'mean_time_0.0001'))}"


def others_table():
    """Preset slip, the same with another width, velocity and memory, other sets of values, and those with which contacts let go at once."""

    def used(header):
        keys = ("width", "velocity", "stress", "viscosity", "kt", "law", "kelvin_voigt", "impedance", "loose")
        texts = {key: header.get(key, "0") for key in keys}
        texts["memory"] = f"{memory_of(header):.3g}"
        return {key: f"{float(text):g}" if text.replace(".", "").isdigit() else text for key, text in texts.items()}

    base = [SLIP / f"fault_{length}_4.catalogue.csv.xz" for length in ("120", "240", "480")]
    paths, preset = base + sorted((SLIP / "others").glob("*.catalogue.csv.xz")), used(lsm.read_catalogue(base[0]).header)
    rows, out = summary.rows_of(POSTPROC, paths, ["1e-4"], ranges=paper.RANGES, begin=LOADING, shortest=0), []
    for path, row in zip(paths, rows):
        found = lsm.read_catalogue(path)
        size, (excess, loaded) = found["size"], slip.excess_of(found)
        small, middle = (size >= 1e-3) & (size < 0.1), (size >= 1e-3) & (size < 1e-2)
        friction = slip.friction_share(size[small], excess[small], loaded[small])
        at_once = np.mean(found["jump"][middle] > slip.AT_ONCE)
        changed = {key: value for key, value in used(found.header).items() if value != preset[key]}
        other = not changed.keys() <= {"width", "velocity", "memory"}
        differs = [
            f"{key} {value}".replace("kelvin_voigt", "retardation").replace("law coulomb 0.6", "static friction") for key, value in changed.items()
        ]
        out.append((at_once > 0.01, other, float(found.header["length"]), friction, [
            f"{found.header['length']}, {found.header['seed']}: {', '.join(differs) or 'nothing'}",
            shown(friction), f"{100 * at_once:.0f}", f"{shown(number(row, EXPONENTS['1e-4 to 1e-1']))} ({decades_of(row)})",
            shown(number(row, "gamma_0.0001")),
            scale_and_time(row)
        ]))
    head = ["length, packing: what differs", "friction's share †", "at once, % †", "exponent (in each decade)", "gamma", "B, one event in"]
    return table(head, [cells for *_, cells in sorted(out)])


def velocity_table():
    """Preset slip, packing 4, with plates of the paper's velocity and of half of it: how often there are drops, and those that are slip."""
    out = []
    for length in ("120", "240", "480"):
        for path in SLIP / f"fault_{length}_4.catalogue.csv.xz", SLIP / f"others/slow_{length}_4.catalogue.csv.xz":
            found = lsm.read_catalogue(path)
            size, (excess, _) = found["size"], slip.excess_of(found)
            times = [slip.time_and_share(found, excess, size >= low)[0] for low in (1e-4, 2e-3, 1e-2, 0.1)]
            time, share = slip.time_and_share(found, excess, (size >= 1e-3) & (size < 1e-2))
            out.append([f"{length}, {float(found.header['velocity']):g}", *(shown(one) for one in (*times, time / share, time / (1 - share)))])
    return table(["length, velocity", ">= 1e-4", ">= 0.002", ">= 0.01", ">= 0.1", "0.001 to 0.01: slips", "others"], out)


def slider_table():
    """Of the settings of the block-slider that were tried, the one nearest to the paper over all lengths."""
    statements, rows = paper.SLIDER_STATEMENTS, [row for row in read(SLIDERS) if float(row["dt"]) >= 0.005]  # below: loading only
    groups = grouped(rows, lambda row: tuple(row[key] for key in paper.SLIDER_KEYS))
    key, rows = min(groups.items(), key=lambda one: sum(paper.distance(row, statements)**2 for row in one[1]))
    rows.sort(key=lambda row: int(row["blocks"]))
    met = [sum(one.deviation(row) <= 1.0 for row in rows) for one in statements]
    head = [
        f"fitted: the nearest of {len(groups)} settings ({key[0]} scheme, {key[2]} reading, time step {key[1]}, velocity {key[5]})",
        "paper (our tolerance)", "here", "agrees at"
    ]
    blocks = ["blocks", "", ", ".join(row["blocks"] for row in rows), ""]
    return table(head, [blocks] +
                 [[one.name, f"{one.text} ({tolerance_of(one)})", ", ".join(shown(one.value(row)) for row in rows), f"{n} of {len(rows)} lengths"]
                  for one, n in zip(statements, met)])


def slider_velocity_table():
    """The block-slider over the velocity of its plate, at all lengths."""
    fixed = {"scheme": "printed", "dt": "0.01", "picker": "exponential", "picker-lambda": "0.99", "warmup": "0", "smallest": "0.0001"}
    rows = [row for row in read(SLIDERS) if all(row[key] == value for key, value in fixed.items())]
    groups = grouped(sorted(rows, key=lambda row: (float(row["velocity"]), int(row["blocks"]))), lambda row: row["velocity"])

    told = [one for one in paper.SLIDER_STATEMENTS if one.name != "large"]
    blocks = ", ".join(row["blocks"] for row in groups["0.01"])
    return table([f"velocity, each for {blocks} blocks", *(one.name for one in told)],
                 [["paper", *(one.text for one in told)]] + [[velocity, *(", ".join(shown(one.value(row)) for row in rows) for one in told)]
                                                             for velocity, rows in groups.items()])


def ground_table():
    """Periodicity of the faces, and recorded slip, with seeds on a grid and at random places."""
    places, now = {}, faults()
    for row in read(FOLDER / "packing/faces.csv.xz"):
        places.setdefault((row["seeds"], row["length"]), {}).setdefault((row["packing"], row["side"]), []).append(float(row["x"]))

    def factors(seeds, length):
        k = 2 * math.pi * 2 * math.floor(float(length) / 2) / float(length)  # at half the spacing of the grid, rounded to fit in
        return ", ".join(f"{abs(sum(cmath.exp(1j * k * x) for x in face))**2 / len(face):.1f}" for face in places[seeds, length].values())

    def z(paths):
        return ", ".join(f"{periods.rayleigh_z(*periods.slips_of(path, LOADING, 1e-2), 1.0):.1f}" for path in paths)

    columns = {
        "length": lambda row: row["length"], "structure factor of the faces, grid": lambda row: factors("grid", row["length"]),
        "random places": lambda row: factors("random", row["length"]), "Z at a slip of 1, grid": lambda row: row["z"],
        "Z, random places": lambda row: z(now.get(int(row["length"]), [])),
        "slip recorded over that of the plates, before": lambda row: row["slip_recorded"] or "-",
        "now": lambda row: spread([number(one, "recorded") for one in summaries() if one["length"] == row["length"]])
    }
    return study_table("packing/grid.csv", columns, across=True)


def rupture_packing_table():
    """TPV3 in the random packing compared with the boundary integral method, from the stations of all packings."""

    def rms(numbers):
        return math.sqrt(statistics.fmean(x * x for x in numbers))

    spacings, out, keys = {}, [], ("x", "arrival", "reference_arrival", "end_slip", "reference_end_slip")
    for row in read(FOLDER / "rupture_packing-stations.csv"):
        _, spacing, seed = row["run"].split(".")  # p.SPACING.SEED
        spacings.setdefault(int(spacing), {}).setdefault(seed, {})[float(row["x"])] = {key: float(row[key]) for key in keys}
    for spacing, packed in sorted(spacings.items(), reverse=True):
        every = [at for stations in packed.values() for at in stations.values()]
        late = [rms(at["arrival"] - at["reference_arrival"] for at in stations.values()) for stations in packed.values()]
        scattered = math.sqrt(
            statistics.fmean(statistics.variance(stations[x]["arrival"] for stations in packed.values()) for x in next(iter(packed.values()))))
        slip = [100 * (at["end_slip"] / at["reference_end_slip"] - 1) for at in every if abs(at["x"]) <= 12000]
        fast = sum(9000 / (stations[side * 12000]["arrival"] - stations[side * 3000]["arrival"]) > 3464 for stations in packed.values()
                   for side in (-1, 1))
        out.append([
            f"{spacing} m ({1.374 * spacing:.0f} m)",
            str(len(packed)), " to ".join(dict.fromkeys(f"{t:.2f}" for t in (min(late), max(late)))), f"{scattered:.2f}",
            f"{fast} of {2 * len(packed)}", f"{rms(slip):.1f}; {statistics.fmean(slip):.1f}"
        ])
    return table([
        "spacing (largest radius)", "packings", "arrival, rms of each (s)", "scatter between packings (s)",
        "fronts faster than S-waves from 3 to 12 km", "slip, rms; mean (%)"
    ], out)


# ---- the article: from values.csv


def keyed_table(head, rows, columns):
    """A row for each of these texts, made of the keys that `columns` give for it; those without any number are left out. columns: {head: (key, form)}"""
    found = values.read()

    def cell(key, form):
        return values.text_of(found[key].value, found[key].error, form) if key in found else "-"

    cells = {row: [cell(key.format(row), form) for key, form in columns.values()] for row in rows}
    return table([head, *columns], [[row.replace(".", ", ", 1), *some] for row, some in cells.items() if set(some) != {"-"}])


FAULTS_AND_LENGTHS = [f"{fault}.{length}" for fault in article.FAULTS for length in article.LENGTHS]


def drops_table():
    """Drops of the three faults at all lengths."""
    columns = {"drops >= 1e-4 in 1000 time units": ("rate.drops.{}.0.0001", "()"), "slips >= 0.1": ("rate.slips.{}.0.1", "()")}
    columns |= {"exponent": ("exponent.all.{}", "()"), "gamma": ("gamma.all.{}", "()"), "B": ("B.all.{}", "()")}
    columns |= {"slip of 0.001 to 0.1, %, random null": ("share.random.{}", "%()"), "mirror null": ("share.mirror.{}", "%()")}
    return keyed_table("fault, length", FAULTS_AND_LENGTHS, columns)


def default_fault_table():
    """The default fault at packings to which nothing was fitted."""
    rows = sorted((key.removeprefix("run.exponent.leaky.") for key in values.read() if key.startswith("run.exponent.leaky.")),
                  key=lambda row: [int(number) for number in row.split(".")])
    columns = {key if key != "mean_time" else "one drop in": (f"run.{key}.leaky.{{}}", "()") for key in ("exponent", "gamma", "B", "mean_time")}
    return keyed_table("length, packing", rows, columns)


def connected_slip_table():
    """Ruptures by friction."""
    columns = {f"ruptures >= {size}": (f"ruptures.rate.{{}}.{size}", "()") for size in ("0.001", "0.01", "0.1")}
    columns |= {
        "longest": ("ruptures.longest.{}", ".0f"), "mean time at one place": ("place.mean.{}", ".0f"), "variation": ("place.variation.{}", "()")
    }
    return keyed_table("fault, length", FAULTS_AND_LENGTHS, columns)


def threshold_table():
    """Ruptures >= 0.01 with other thresholds, at length 120."""
    columns = {
        f"{slipping} plate velocities, interval {0.6 * merged:g}": (f"ruptures.test.{{}}.{slipping}.{merged}.rate_0.01", "()")
        for slipping, merged in article.TESTS
    }
    return keyed_table("fault", article.FAULTS, columns)


def beside_table():
    """The three faults beside each other, at the shortest length."""
    columns = {"drops >= 1e-4": ("rate.drops.{}.120.0.0001", "()"), "slips >= 0.1 †": ("rate.slips.{}.120.0.1", "()")}
    columns |= {f"ruptures >= {size} †": (f"ruptures.rate.{{}}.120.{size}", "()") for size in ("0.001", "0.01", "0.1")}
    columns |= {"work of friction": ("budget.work.{}.120", "()"), "of it in slips >= 0.1, %": ("budget.share.{}.120", "%()")}
    return keyed_table("length 120, in 1000 time units", article.FAULTS, columns)


def bursts_table():
    """Stretches in which single discs ring."""
    rows = [f"{row['fault']}.{row['packing']}" for row in read(article.BURSTS)]
    columns = {"stretches with bursts": ("burst.bursts.{}", ".0f"), "of": ("burst.stretches.{}", ".0f")}
    columns |= {"drops in them": ("burst.rate_in_bursts.{}", ".0f"), "elsewhere": ("burst.rate_else.{}", ".0f")}
    columns |= {"gamma": ("burst.gamma.{}", ".2f"), "gamma without bursts": ("burst.gamma_else.{}", ".2f")}
    columns |= {"exponent": ("burst.exponent.{}", ".2f"), "exponent without bursts": ("burst.exponent_else.{}", ".2f")}
    return keyed_table("fault, packing", rows, columns)


# ---- tables of studies


def study_table(file, columns, rows=None, across=False):
    """A table of a study. columns: {head: function of a row, or the key of a number}; across: a column for each row."""
    rows = rows if rows is not None else read(FOLDER / file)
    return (turned if across else table)(list(columns),
                                         [[of(row, cell) if isinstance(cell, str) else cell(row) for cell in columns.values()] for row in rows])


def slow_driving_table():

    def per(row, *keys):
        return ", ".join(f"{18 * number(row, key) / number(row, 'displacement'):.0f}" for key in keys)

    columns = {
        "velocity": lambda row: row["velocity"] + (", leaps" if row["fast"] else ""),
        "events >= 1e-3, 1e-2, 0.1": lambda row: per(row, "events_3", "events_2", "events_1"), "exponent 1e-3 to 1": "long", "1e-2 to 1": "from_2",
        "gamma >= 1e-3": "gamma", ">= 1e-2": "gamma_2",
        "events within 100 time units after, before a main shock": lambda row: f"{of(row, 'after_100')}, {of(row, 'before_100')}",
        "large events matched, by chance": lambda row: f"{row['same']} of {row['of']}, {of(row, 'chance')}"
        if row["same"] else "", "steps per large event": "steps_per_large"
    }
    rows = [row for row in read(FOLDER / "slow-driving.csv") if row["fast"] in ("", "2.5e-4")]
    return study_table("", columns, rows, across=True)


def slow_driving_slider_table():
    """Chains with seed 1, displaced far enough, without leaps and with those of 1e-3."""
    rows = [row for row in read(FOLDER / "slow-driving-slider.csv") if row["seed"] == "1" and float(row["displacement"]) >= 400]
    columns = {"blocks, velocity": lambda row: f"{row['blocks']}, {row['velocity']}{', leaps' if row['leap'] != '0' else ''}"}
    columns |= {"events >= 1, 100, 1000": lambda row: ", ".join(f"{number(row, f'events_{size}'):.0f}" for size in (1, 100, 1000))}
    columns |= {
        "exponent 1 to 100": "exponent", "gamma >= 1": "gamma", "p of sizes, times": lambda row: f"{row['p_size']}, {row['p_time']}".strip(", ")
    }
    columns |= {"steps per event >= 100": lambda row: f"{float(row['steps_per_100']):.0f}"}
    return study_table("", columns, [row for row in rows if row["leap"] in ("0", "1e-3")])


def work_precision_table():
    columns = {"time step; masses; onset": lambda row: f"{row['dt']}; {'raised' if float(row['massstep']) else 'r^2'}; {row['onset']}"}
    columns |= {"model time per core-hour": lambda row: f"{number(row, 'time_per_core_hour'):.3g}"}
    return study_table("accuracy_catalogues.csv",
                       columns | {"events >= 1e-3": "rate", "exponent": "exponent", "gamma": "gamma", "energy released": "released"})


def named(label, size):
    return f"{label}, M >= {math.log10(float(size)) / 1.5:.3g}" if label == "Southern California" else f"{label}, >= {float(size):g}"


def one_or_both(row, key, two):
    """A number, or those of two catalogues: their error is half of their difference."""
    value, half = number(row, key), number(row, f"{key}_error")
    return spread([value - half, value + half]) if two and half > 0 else of(row, key)


def ranking_table():
    """Earthquakes, and for each model the smallest size with which it is nearest to them."""
    rows = {}
    for row in read(FOLDER / "nature.table.csv"):
        rows.setdefault((row["label"], row["threshold"] if row["label"] == "Southern California" else ""), row)

    columns = {"": lambda row: named(row["label"], row["threshold"]), "catalogues, events": lambda row: f"{row['catalogues']}, {row['events']}"}
    keys = {"distance": "distance", "gamma": "gamma", "after large events": "after", "b-value": "b"}
    columns |= {name: lambda row, key=key: one_or_both(row, key, row["catalogues"] == "2") for name, key in keys.items()}
    return study_table("", columns, rows.values())


def table1_table():
    """The paper's Table 1, its columns beside ours with the smallest sizes."""
    columns = {}
    for row in read(FOLDER / "nature.table1.csv"):
        printed = row["origin"] == "printed"
        name = f"{row['source']} (printed)" if printed else named(row["source"], row["threshold"])
        if printed or not row["degenerate"] and (row["source"].split()[0], row["threshold"]) in (("Southern", "1000"), ("fault", "0.0001"),
                                                                                                 ("slider", "1")):
            cells = {key: row[key] if printed else one_or_both(row, key, "2 catalogues" in row["method"]) for key in ("gamma", "delta", "B", "C")}
            columns.setdefault(name, cells | ({"delta": "1 (held)"} if "held" in row["method"] else {}))
    keys = ("gamma", "delta", "B", "C")
    return table(["", *keys], [[name, *(column[key] for key in keys)] for name, column in columns.items()])


def laws_table():
    """Each law over its packings."""
    groups = grouped(read(FOLDER / "laws.csv"), lambda row: row["run"].rsplit("_", 1)[0])

    def all_of(*keys):
        return lambda rows: ", ".join(spread([number(row, key) for row in rows]) for key in keys)

    keys = {"exponent": ["exponent"], "gamma": ["gamma"], "distance": ["distance"]}
    keys |= {
        f"events before, after a main shock, {text}": [f"before_{part}", f"after_{part}"]
        for text, part in (("to 300", "near"), ("300 to 3e4", "far"))
    }
    columns = {"law": lambda rows: rows[0]["run"].rsplit("_", 1)[0]} | {head: all_of(*some) for head, some in keys.items()}
    return study_table("", columns, groups.values())


TABLES = {name.removesuffix("_table").replace("_", "-"): made for name, made in list(globals().items()) if name.endswith("_table")}
TABLES |= {name: lambda made=made: table(*made()) for name, made in (speed_tables.TABLES | validation_tables.TABLES).items()}
TABLES |= {name: lambda name=name: table(*walk.table(shown, name)) for name in walk.TABLES} | {"lattice": lambda: turned(*walk.lattice(shown))}

NEW_FORM = ("article", "validation", "beyond", "methods", "speed")


def check(write):
    wrong, keyed = 0, values.read()
    for page in sorted(FOLDER.glob("*.md")) + [FOLDER.parent / "README.md"]:
        text = page.read_text()

        def replace(match):
            if match[1] not in TABLES:
                sys.exit(f"{page.name}: table {match[1]}, expected one of {', '.join(TABLES)}")
            try:
                made = TABLES[match[1]]()
            except FileNotFoundError:
                made = "Not measured with this model yet."
            return f"<!-- table {match[1]} -->\n\n{made}\n\n<!-- end -->"

        new = re.sub(r"<!-- table (\S+) -->.*?<!-- end -->", replace, text, flags=re.S)
        try:
            new = values.filled(new, keyed)
        except ValueError as error:
            sys.exit(f"{page.name}: {error}")
        numbers = values.bare(new) if page.stem in NEW_FORM else []
        if numbers:
            wrong = 1
            print(f"{page.name}: {', '.join(numbers)}: numbers without a key, expected <!--n KEY--> after each, or a constant of values.py")
        if write:
            page.write_text(new)
        elif new != text:
            wrong = 1
            print("\n".join(difflib.unified_diff(text.splitlines(), new.splitlines(), page.name, "from the data", lineterm="")))
    return wrong


def differing(path, rows, there=None, least=1e-6):
    """Says which cells of a CSV file, or of these rows of it, differ from those made again, numbers relatively by more than `least`."""
    wrong, there = [], read(path) if there is None else there
    for n, (old, new) in enumerate(zip(there, rows), 1):
        for key in new:
            a, b = old[key], text_of(new[key] if new[key] is not None else math.nan)
            try:
                same = math.isclose(float(a), float(b), rel_tol=least, abs_tol=1e-12)
            except ValueError:
                same = a == b
            wrong += [] if same else [f"{path.name}: row {n}, {key}: {a}, from the data {b}"]
    wrong += [f"{path.name}: {len(there)} rows, from the data {len(rows)}"] if len(there) != len(rows) else []
    print("\n".join(wrong[:20] + ([f"{path.name}: {len(wrong)} differences"] if wrong else [f"{path.name}: {len(there)} rows are the same"])))
    return bool(wrong)


def all_values():
    """Numbers of sentences."""
    return article.all_values(POSTPROC) + page_values.all_values(POSTPROC)


def check_csv():
    """The numbers of sentences, files of faults.py and nature.py, the statements of each fault that rest on its catalogue only, and stations of the walk with all their seeds."""
    wrong = [differing(values.TABLE, values.rows(all_values()))]
    for name, made in ("rates", article.rates), ("estimators", article.estimators), ("ruptures", article.rupture_rows):
        wrong.append(differing(FOLDER / f"{name}.csv", made()))
    rows = nature.published(POSTPROC)
    wrong += [
        differing(FOLDER / f"nature{ending}.csv", made)
        for ending, made in (("", nature.curves(rows)), (".table", nature.table(rows)), (".table1", nature.table1(rows)))
    ]
    # The headers of the campaign's runs gave 1e-4 as their completeness. Published ruptures lack those that are smaller than 1e-3.
    for folder, threshold in (CAMPAIGN, 1e-4), (VALIDATION, None):
        again = {}
        for path in (path for paths in faults(folder=folder).values() for path in paths):
            for row in statements.statements_of(POSTPROC, path, LOADING, run="none", threshold=threshold):
                again[path.name.split(".")[0], row["number"]] = row
        there = [row for row in read(folder / "statements.csv") if (row["run"], row["number"]) in again]
        made = [again[row["run"], row["number"]] for row in there]
        wrong.append(len(made) != len(again) or differing(folder / "statements.csv", made, there))
    measured = {row["station"]: row for row in walk.lines_of(walk.measured(POSTPROC, FOLDER / "walk"))}
    there = read(FOLDER / "walk.csv")
    both = [row["station"] for row in there if str(measured.get(row["station"], {"seeds": ""})["seeds"]) == row["seeds"]]
    wrong.append(
        len(both) < 12 or differing(FOLDER / "walk.csv", [measured[name] for name in both], [row for row in there if row["station"] in both]))
    return any(wrong)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--write"], ["--csv"], ["--values"]):
        sys.exit(__doc__)
    POSTPROC = sys.argv[1]
    if sys.argv[2:] == ["--values"]:
        sys.exit(values.write(all_values()))
    sys.exit(check_csv() if sys.argv[2:] == ["--csv"] else check(len(sys.argv) == 3))
