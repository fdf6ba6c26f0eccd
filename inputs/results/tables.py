#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the tables of the pages about results from the catalogues in this folder.

tables.py POSTPROC            says which tables are not what the catalogues give; exit status 1 if there is one
tables.py POSTPROC --write    writes them into the pages
tables.py POSTPROC --figures  draws the figures of calibration.md and faults.md from the same numbers

A table stands between the lines <!-- table NAME --> and <!-- end -->, in a page of this folder or the project's README.md.
"""
import csv
import difflib
import functools
import json
import math
import random
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent / "studies"))
import calibrate  # noqa: E402
import superpose  # noqa: E402

POINTS, SLIDERS = FOLDER / "calibration/points.csv.xz", FOLDER / "calibration/sliders.csv.xz"
VALIDATION, SUPERPOSED, LOADED = FOLDER / "validation", FOLDER / "superposed", FOLDER / "loading"
CAMPAIGN = FOLDER / "campaign"  # faults of the validation that ran on to 1.2e6 steps
LOADING = 4500  # time units that are left out: compression, and PE rising for the first time
SETTLE = 1200  # of them: compression
SIZES = ("0.0001", "0.001", "0.01", "0.1")
PAPER = {"exponent": 1.07, "gamma": 0.995}
USED, USED_SEEDS = 120, 3  # length and packings at which the default was calibrated
SIGNIFICANT = 0.05
MEMORY = 2.0  # time units, of the picker


# ---- numbers of catalogues


def summary(postproc, paths, *words, begin=LOADING):
    """Rows of postproc summary, with the path of each catalogue."""
    paths = [str(path) for path in paths]
    if not paths:
        return []
    said = subprocess.run([postproc, "summary", *paths, "--from", str(begin), "--parameter", "length", "seed", "width", "dt", *words],
                          check=True, capture_output=True, text=True).stdout
    rows = list(csv.DictReader(line for line in said.splitlines() if not line.startswith("#")))
    for path, row in zip(paths, rows):
        row["path"] = path
    return rows


def value(row, key, digits):
    return f"{float(row[key]):.{digits}f}" if row[key] else "-"


def with_error(row, key, error, digits=2):
    return f"{value(row, key, digits)} ± {value(row, error, digits)}" if row[key] else "-"


def number(row, key):
    return float(row[key]) if row.get(key) else math.nan


def values(rows, key):
    return [x for x in (number(row, key) for row in rows) if math.isfinite(x)]


def spread(found, digits):
    """Mean and standard deviation between the packings."""
    if not found:
        return "-"
    mean = f"{statistics.mean(found):.{digits}f}"
    return f"{mean} ± {statistics.stdev(found):.{digits}f}" if len(found) > 1 else mean


def gamma_of(times):
    """Maximum likelihood of gamma with delta = 1, as postproc summary has it, of times that need not begin with events."""
    times = [time for time in times if time > 0]
    if len(times) < 2:
        return math.nan
    wanted = math.log(statistics.mean(times)) - statistics.mean(map(math.log, times))  # = log(gamma) - digamma(gamma)
    low, high, h = 1e-3, 1e3, 1e-4
    while high / low > 1 + 1e-9:
        middle = math.sqrt(low * high)
        digamma = (math.lgamma(middle * (1 + h)) - math.lgamma(middle * (1 - h))) / (2 * middle * h)
        low, high = (middle, high) if math.log(middle) - digamma > wanted else (low, middle)
    return low


def enough(rows, size, least=15):
    """Rows with so many events of this size, for their times to be fitted."""
    return [row for row in rows if number(row, f"events_{size}") >= least]


def order(row):
    return float(row["length"]), int(row["seed"])


def grouped(rows, key="length"):
    groups = {}
    for row in sorted(rows, key=lambda row: float(row[key])):
        groups.setdefault(row[key], []).append(row)
    return groups


# ---- faults


def sizes_and_times(rows):
    head = ["length", "seed", "time units", "events >= 1e-4", "1e-3", "1e-2", "of 3 steps or less", "exponent 1e-4 to 0.1",
            "1e-3 to 1", "largest", "gamma >= 1e-4", "1e-3", "1e-2", "0.1", "mean time >= 1e-4", "1e-3", "1e-2", "0.1"]
    return calibrate.table(head, [[row["length"], row["seed"], value(row, "time", 0)] + [row[f"events_{s}"] for s in SIZES[:3]] +
                        [f"{100 * float(row['brief']):.1f} %", with_error(row, "exponent_1e-4:1e-1", "error_1e-4:1e-1"),
                         with_error(row, "exponent_1e-3:1", "error_1e-3:1"), value(row, "largest", 2)] +
                        [with_error(row, f"gamma_{s}", f"gamma_error_{s}") for s in SIZES] +
                        [value(row, f"mean_time_{s}", 0) for s in SIZES] for row in sorted(rows, key=order)])


def campaign_before_table(postproc):
    return sizes_and_times(summary(postproc, sorted(FOLDER.glob("catalogues/fault_[0-9]*.catalogue.csv.xz"))))


DECADES = calibrate.RANGES[1:]
RANGES = ("1e-4:1e-1", "1e-3:1", "1e-3:1e-1", *DECADES)


@functools.cache
def packings(postproc):
    """Rows of the faults with the default choices, one for each length and packing."""
    return sorted(summary(postproc, sorted(VALIDATION.glob("fault_*[0-9]_[0-9].catalogue.csv.xz")), "--range", *RANGES), key=order)


def packings_table(postproc):
    return sizes_and_times(packings(postproc))


@functools.cache
def full_length(postproc):
    """Rows of the runs of 1.2e6 steps."""
    return sorted(summary(postproc, sorted(CAMPAIGN.glob("fault_*[0-9]_[0-9].catalogue.csv.xz")), "--range", *RANGES), key=order)


@functools.cache
def longest(postproc):
    """Rows of the longest run of each length and packing."""
    rows = {order(row): row for row in packings(postproc)}
    rows.update({order(row): row for row in full_length(postproc)})
    return [rows[key] for key in sorted(rows)]


def campaign_table(postproc):
    return sizes_and_times(full_length(postproc))


def decades_table(postproc):
    """Is it one power law? Exponents of each decade of the long runs."""
    def exponent(row, text):
        return with_error(row, f"exponent_{text}", f"error_{text}")
    return calibrate.table(["length", "seed", *(text.replace(":", " to ") for text in DECADES), "1e-3 to 0.1", "deviation from 1.07"],
                           [[row["length"], row["seed"], *(exponent(row, text) for text in DECADES), exponent(row, "1e-3:1e-1"),
                             f"{calibrate.decades(row):.2f}"] for row in full_length(postproc)])


PARTS = 4


def steady_table(postproc):
    """Do the long runs change with time? Their parts beside each other."""
    out = []
    for row in full_length(postproc):
        end, parts = LOADING + float(row["time"]), []
        for n in range(PARTS):
            bounds = [LOADING + (end - LOADING) * k / PARTS for k in (n, n + 1)]
            parts += summary(postproc, [row["path"]], "--to", f"{bounds[1]:.17g}", begin=bounds[0])
        counts = [int(part["events_0.0001"]) for part in parts]
        mean = statistics.mean(counts)
        chi2 = sum((count - mean) ** 2 for count in counts) / mean
        out.append([row["length"], row["seed"], ", ".join(map(str, counts)), f"{chi2:.1f}"] +
                   [", ".join(value(part, key, 2) for part in parts) for key in ("exponent_1e-4:1e-1", "gamma_0.0001", "gamma_0.001", "largest")])
    return calibrate.table(["length", "seed", "events >= 1e-4 in each quarter", f"chi^2 of {PARTS - 1}", "exponent 1e-4 to 0.1", "gamma >= 1e-4", ">= 1e-3",
                            "largest"], out)


def by_use(rows):
    """(length, rows, were they used to calibrate?): the packings of the calibration apart from others of that length."""
    for length, rows in grouped(rows).items():
        used = [row for row in rows if float(length) == USED and int(row["seed"]) <= USED_SEEDS]
        for part in (used, [row for row in rows if row not in used]):
            if part:
                yield length, part, part is used


def validation_table(postproc):
    out = []
    for length, part, used in by_use(packings(postproc)):
        out.append([length, str(len(part)), f"{statistics.mean(values(part, 'time')):.0f}",
                    f"{statistics.mean(values(part, 'events_0.0001')):.0f}",
                    f"{100 * statistics.mean(values(part, 'brief')):.1f} %", spread(values(part, "exponent_1e-4:1e-1"), 2),
                    spread(values(part, "exponent_1e-3:1"), 2), spread(values(part, "largest"), 2),
                    spread(values(part, "gamma_0.0001"), 2), spread(values(part, "gamma_0.001"), 2),
                    spread(values(part, "mean_time_0.0001"), 0), "used" if used else "predicted"])
    head = ["length", "packings", "time units each", "events >= 1e-4", "of 3 steps or less", "exponent 1e-4 to 0.1", "1e-3 to 1",
            "largest", "gamma >= 1e-4", ">= 1e-3", "mean time", ""]
    return calibrate.table(head, out)


def thresholds_table(postproc):
    """gamma and B against the smallest size."""
    out = []
    for length, rows in grouped(longest(postproc)).items():
        both = [(values(enough(rows, s), f"gamma_{s}"), values(enough(rows, s), f"B_{s}")) for s in SIZES]
        out.append([length, *(f"{spread(gamma, 2)}; {spread(b, 0)}" if gamma else "-" for gamma, b in both)])
    return calibrate.table(["gamma; B at length", ">= 1e-4", "1e-3", "1e-2", "0.1"], out)


# ---- ruptures


def characteristic_sizes(postproc, paths, least, begin, highest="1"):
    """Of `postproc fit --scaling`: exponents of these catalogues, and their characteristic sizes with the law of growth."""
    with tempfile.TemporaryDirectory() as work:
        said = subprocess.run([postproc, "fit", *map(str, paths), "--scaling", "--threshold", least, "--from", str(begin), "--range",
                               f"{least}:{highest}", "--replicas", "0", "--no-comparison", "--no-picture", "-o", f"{work}/fit", "--json",
                               f"{work}/fit.json"], capture_output=True, text=True)
        if said.returncode:
            raise RuntimeError(said.stderr)
        told = json.loads(Path(f"{work}/fit.json").read_text())
    return told["fits"], told["scaling"][0]


def growth(scaling, what="s*"):
    """How the characteristic size depends on the length, in a line."""
    return (f"{what} goes as L^({scaling['D']:.3f} ± {scaling['D_error']:.3f}), chi^2 {scaling['chi2']:.0f} on {len(scaling['points']) - 2} "
            f"degrees of freedom; AICc {scaling['aicc']:.1f}, of a constant {scaling['aicc_constant']:.1f}.")


def scatter(times):
    """Mean of these times, and their standard deviation over it."""
    mean = statistics.mean(times)
    return f"{mean:.0f}, {statistics.stdev(times) / mean:.2f}"


PLACES = 8  # on each fault, at which ruptures are counted


def returns(rows, length):
    """Times after which a place ruptures again."""
    found = []
    for n in range(PLACES):
        place = (n + 0.5) * length / PLACES
        times = sorted(float(row["t_start"]) for row in rows if (place - float(row["x_begin"])) % length < float(row["rupture_length"]))
        found += [b - a for a, b in zip(times, times[1:])]
    return found


def single_ruptures(postproc, paths, begin):
    """Ruptures >= 1e-2 of each fault, of whatever choices."""
    paths = sorted(paths)  # as pictures.sh has them
    fits, scaling = characteristic_sizes(postproc, paths, "1e-2", begin)
    out = []
    for path, fit, point in sorted(zip(paths, fits, scaling["points"]), key=lambda one: length_and_seed(one[0])):
        length, seed = length_and_seed(path)
        rows = [row for row in calibrate.read(path) if float(row["t_start"]) >= begin and float(row["size"]) >= 1e-2]
        time = max(float(row["t_end"]) for row in rows) - begin
        lengths = [float(row["rupture_length"]) for row in rows]
        starts = sorted(float(row["t_start"]) for row in rows)
        out.append([f"{length}, {seed}", f"{time:.0f}", f"{sum(x > 10 for x in lengths) / time / length * 1e5:.1f}",
                    f"{fit['exponent']:.2f} ± {fit['standard_error']:.2f}", f"{point['s_star']:.3f} ± {point['error']:.3f}",
                    f"{max(lengths):.0f}", str(sum(x >= length for x in lengths)), f"{max(float(row['slip_moment']) for row in rows):.0f}",
                    scatter(returns(rows, length)), scatter([b - a for a, b in zip(starts, starts[1:])])])
    head = ["length, seed", "time units", "longer than 10, per 1e5 time units and unit of length", "exponent 1e-2 to 1", "s*", "longest",
            "of the whole fault", "largest moment", f"time until one of {PLACES} places ruptures again: mean, deviation over it", "the same of the whole fault"]
    return calibrate.table(head, out) + ("\n\n" + growth(scaling) if "D" in scaling else "")


def length_and_seed(path):
    words = re.findall(r"\d+", path.name.split(".")[0])
    return int(words[0]), int(words[1]) if len(words) > 1 else 1


def ruptures_before_table(postproc):
    return single_ruptures(postproc, FOLDER.glob("catalogues/fault_ruptures_*.catalogue.csv.xz"), 6000)


def power_law(points):
    """Number of points, exponent with its error and scatter in decades of y = a x^b by least squares on the logarithms."""
    logs = [(math.log10(x), math.log10(y)) for x, y in points]
    n, mx, my = len(logs), statistics.mean(x for x, _ in logs), statistics.mean(y for _, y in logs)
    sxx = math.fsum((x - mx) ** 2 for x, _ in logs)
    b = math.fsum((x - mx) * (y - my) for x, y in logs) / sxx
    off = math.sqrt(math.fsum((y - my - b * (x - mx)) ** 2 for x, y in logs) / (n - 2))
    return [str(n), f"{b:.3f} ± {off / math.sqrt(sxx):.3f}", f"{off:.2f}"]


def laws_of_ruptures(postproc, paths):
    """Moment against length, and drop of the total PE against moment, of ruptures that did not break the whole fault."""
    with tempfile.TemporaryDirectory() as work:
        subprocess.run([postproc, "rupture", *map(str, paths), "--no-picture", "-o", f"{work}/rupture", "--json", f"{work}/rupture.json"],
                       check=True, capture_output=True)
        told = json.loads(Path(f"{work}/rupture.json").read_text())
    lengths = [(row["length"], row["moment"]) for row in told["length"] if not row["whole_fault"] and row["moment"] > 0]
    drops = [(row["moment"], row["pe_drop"], row["alone"]) for row in told["pe"] if row["moment"] > 0 and (row["pe_drop"] or 0) > 0]
    rows = [["moment against length", *power_law(lengths)],
            ["of ruptures of 30 or longer", *power_law([one for one in lengths if one[0] >= 30])],
            ["drop of PE against moment, isolated ruptures", *power_law([one[:2] for one in drops if one[2]])],
            ["all for which PE drops", *power_law([one[:2] for one in drops])]]
    return calibrate.table(["", "ruptures", "exponent", "scatter in decades"], rows)


def rupture_laws_before_table(postproc):
    return laws_of_ruptures(postproc, [path for path in FOLDER.glob("catalogues/fault_ruptures_*.catalogue.csv.xz") if "seed" not in path.name])


def drops_before_table(postproc):
    return drops(postproc, FOLDER.glob("catalogues/fault_[0-9]*.catalogue.csv.xz"))


def drops_table(postproc):
    return drops(postproc, CAMPAIGN.glob("fault_*[0-9]_[0-9].catalogue.csv.xz"))


def ruptures_long_table(postproc):
    return single_ruptures(postproc, CAMPAIGN.glob("fault_*.ruptures.csv.xz"), LOADING)


def drops(postproc, paths):
    """Characteristic sizes of drops of the total PE."""
    paths = sorted(paths)
    _, scaling = characteristic_sizes(postproc, paths, "1e-3", LOADING)
    groups = {}
    for path, point in sorted(zip(paths, scaling["points"]), key=lambda one: length_and_seed(one[0])):
        groups.setdefault(str(length_and_seed(path)[0]), []).append(f"{point['s_star']:.2f} ± {point['error']:.2f}")
    return calibrate.table(["length", *groups], [["s* (sizes >= 1e-3)", *("; ".join(found) for found in groups.values())]]) + "\n\n" + growth(scaling)


def compare(postproc, first, others, size):
    """p-values of the times, each divided by its mean, of the first catalogue against the others."""
    with tempfile.TemporaryDirectory() as work:
        said = subprocess.run([postproc, "compare", first, *others, "--from", str(LOADING), "--rescale", "--replicas", "400",
                               "--threshold", size, "-o", f"{work}/compare", "--json", f"{work}/compare.json"],
                              capture_output=True, text=True)
        if said.returncode:
            raise RuntimeError(said.stderr)
        return [test["p"] for test in json.loads(Path(f"{work}/compare.json").read_text())["tests"] if test["quantity"] == "time"]


def collapse_table(postproc):
    """Do the times of each length, over their mean, have the law of those of the length that was used? Do they depend on the one before?"""
    groups, out = grouped(longest(postproc)), []
    base = groups[str(USED)]
    for length, rows in groups.items():
        cells = []
        for size in SIZES:
            found, chosen = [], enough(rows, size)
            for n, row in enumerate(chosen):
                others = enough(base[:n] if rows is base else base, size)
                if others:
                    found += compare(postproc, row["path"], [other["path"] for other in others], size)
            few = sum(p < SIGNIFICANT for p in values(chosen, f"spearman_p_{size}"))
            cells.append(f"{statistics.median(found):.2f} ({sum(p < SIGNIFICANT for p in found)} of {len(found)}); "
                         f"{statistics.mean(values(chosen, f'spearman_{size}')):.2f} ({few} of {len(chosen)})" if found else "-")
        out.append([length, *cells])
    return calibrate.table(["p; Spearman at length", ">= 1e-4", "1e-3", "1e-2", "0.1"], out)


def widths_table(postproc):
    rows = summary(postproc, sorted(VALIDATION.glob("fault_120_width_*.xz")) + [VALIDATION / "fault_120_1.catalogue.csv.xz"])
    head = ["width", "time units", "events >= 1e-4", "of 3 steps or less", "exponent 1e-4 to 0.1", "1e-3 to 1", "largest", "gamma >= 1e-4", "1e-3",
            "mean time >= 1e-4", "1e-2"]
    return calibrate.table(head, [[row["width"], value(row, "time", 0), row["events_0.0001"], f"{100 * float(row['brief']):.1f} %",
                                   with_error(row, "exponent_1e-4:1e-1", "error_1e-4:1e-1"), with_error(row, "exponent_1e-3:1", "error_1e-3:1"),
                                   value(row, "largest", 2), with_error(row, "gamma_0.0001", "gamma_error_0.0001"),
                                   with_error(row, "gamma_0.001", "gamma_error_0.001"), value(row, "mean_time_0.0001", 0),
                                   value(row, "mean_time_0.01", 0)] for row in sorted(rows, key=lambda row: float(row["width"]))])


def steps_table(postproc):
    """Time step 0.06 with all masses r^2 beside the default of 0.12, and picked at every second step; the same packings."""
    sizes, out = ("1e-4", "2e-4", "3e-4", "1e-3"), []
    for length in ("120", "480"):
        halved = sorted(VALIDATION.glob(f"fault_{length}_step_*.catalogue.csv.xz"))
        seeds = [path.name.split("_")[3][0] for path in halved]
        for what, names in (("0.12", [f"fault_{length}_{seed}" for seed in seeds]), ("0.06", [f"fault_{length}_step_{seed}" for seed in seeds]),
                            ("0.06, picked at every second step", [f"fault_{length}_every_{seed}" for seed in seeds])):
            rows = summary(postproc, [VALIDATION / f"{name}.catalogue.csv.xz" for name in names], "--threshold", *sizes)
            if rows:
                out.append([length, what, str(len(rows)), *(str(sum(int(row[f"events_{float(s):g}"]) for row in rows)) for s in sizes),
                            spread(values(rows, "exponent_1e-4:1e-1"), 2), *(spread(values(rows, f"gamma_{float(s):g}"), 2) for s in sizes)])
    return calibrate.table(["length", "time step", "packings", *(f"{'events >= ' if s == sizes[0] else ''}{s}" for s in sizes),
                            "exponent 1e-4 to 0.1", *(f"{'gamma >= ' if s == sizes[0] else ''}{s}" for s in sizes)], out)


def picker_steps_table(postproc):
    """The long runs picked at each step and at every second one: from which size on do counts not depend on the steps of the picker?"""
    sizes, out = ("1e-4", "2e-4", "3e-4", "5e-4", "1e-3", "2e-3", "5e-3"), []
    for path in sorted(CAMPAIGN.glob("fault_*_every_*.catalogue.csv.xz"), key=length_and_seed):
        length, seed = length_and_seed(path)
        both = summary(postproc, [CAMPAIGN / f"fault_{length}_{seed}.catalogue.csv.xz", path], "--threshold", *sizes)
        out.append([str(length), str(seed), *(f"{both[0][f'events_{float(s):g}']}, {both[1][f'events_{float(s):g}']}" for s in sizes)])
    return calibrate.table(["length", "seed", *(f"{'events >= ' if s == sizes[0] else ''}{s}" for s in sizes)], out)


# ---- why gamma falls


def shape(rows):
    return [str(len(rows)), spread(values(rows, "gamma_0.0001"), 2), spread(values(rows, "gamma_0.001"), 2),
            spread(values(rows, "mean_time_0.0001"), 0), f"{100 * statistics.mean(values(rows, 'brief')):.1f} %",
            spread(values(rows, "exponent_1e-4:1e-1"), 2), spread(values(rows, "largest"), 2)]


SHAPE = ["", "gamma >= 1e-4", "1e-3", "mean time", "of 3 steps or less", "exponent 1e-4 to 0.1", "largest"]


def superposition_table(postproc):
    faults = grouped(packings(postproc))
    out = [[str(USED), "the fault", *shape(faults[str(USED)])]]
    near = {"240": "240", "480": "480", "960": "945", "1920": "1890"}
    for length, other in near.items():
        if other in faults:
            out.append([other, "the fault", *shape(faults[other])])
        for name, what in (("sum", f"{int(length) // USED} stretches of 120 together"),
                           ("load", f"one stretch of 120 with the load of {int(length) // USED - 1} more")):
            paths = sorted(SUPERPOSED.glob(f"{name}_{length}_*.xz"))
            if paths:
                out.append([length, what, *shape(summary(postproc, paths, begin=0))])
    return calibrate.table(["length", "", *SHAPE], out)


def events(path, least, begin=0.0, end=math.inf):
    """(begin, end, size) of the events of a catalogue from this size on and within these times, which are counted from `begin`."""
    return [(float(row["t_start"]) - begin, float(row["t_end"]) - begin, float(row["size"])) for row in calibrate.read(path)
            if float(row["size"]) >= least and begin <= float(row["t_start"]) and float(row["t_end"]) <= end]


def from_begin(found):
    return [b[0] - a[0] for a, b in zip(found, found[1:])]


def from_end(found):
    return [b[0] - a[1] for a, b in zip(found, found[1:])]


def shuffled(found, least):
    """Times between the events that are this large once all sizes have been dealt out again."""
    sizes = [size for _, _, size in found]
    random.Random(1).shuffle(sizes)
    return from_begin([one for one, size in zip(found, sizes) if size >= least])


def stretches(number):
    """Events of the faults that each superposed/sum_*_GROUP has together, (path, begin): superpose.py adds the same stretches up."""
    parts = [(path, superpose.LOADING + n * superpose.DURATION) for n in range(2) for path in sorted(VALIDATION.glob("fault_120_[0-9].catalogue.csv.xz"))]
    return [parts[group * number:(group + 1) * number] for group in range(min(superpose.GROUPS, len(parts) // number))]


def gaps_table(postproc):
    """Why gamma >= 1e-3 is above one: times from the end of an event, sizes shuffled, and a picker for each of several faults."""
    least, all_sizes, out = 1e-3, 1e-4, []

    def line(length, what, catalogues):
        chosen = [[one for one in found if one[2] >= least] for found in catalogues]
        gamma = [spread([gamma_of(times(found)) for found in group], 2) for times, group in
                 ((from_begin, catalogues), (from_begin, chosen), (from_end, chosen), (lambda found: shuffled(found, least), catalogues))]
        mean = [statistics.mean(statistics.mean(x) for x in group) for group in
                ([from_begin(found) for found in chosen], [[end - begin for begin, end, _ in found] for found in chosen])]
        if "each" in what:
            gamma[2] = "-"  # these overlap
        out.append([length, what, str(len(catalogues)), *gamma, *(f"{x:.0f}" for x in mean)])
    for length, rows in grouped(longest(postproc)).items():
        line(length, "the fault", [events(row["path"], all_sizes, LOADING) for row in rows])
    for number in superpose.NUMBERS:
        length, groups = str(number * USED), stretches(number)
        line(length, f"{number} stretches of 120, one picker", [events(path, all_sizes) for path in sorted(SUPERPOSED.glob(f"sum_{length}_*.xz"))])
        apart = [sorted(one for path, begin in group for one in events(path, all_sizes, begin, begin + superpose.DURATION)) for group in groups]
        line(length, f"{number} stretches of 120, a picker each", apart)
    return calibrate.table(["length", "", "packings or sums", "gamma >= 1e-4", ">= 1e-3", ">= 1e-3, from end to begin",
                            ">= 1e-3, sizes shuffled", "mean time >= 1e-3", "mean duration"], out)


def remedies_table(postproc):
    """What a longer memory of the picker, or a larger smallest size, does to gamma and exponent of longer faults."""
    def line(length, memory, size, paths):
        rows = summary(postproc, paths, "--threshold", "1e-4", size, "--range", f"{float(size):g}:1e-1")
        return [length, f"{memory:g}", size, str(len(rows)), spread(values(rows, f"gamma_{float(size):g}"), 2),
                spread(values(rows, f"exponent_{float(size):g}:1e-1"), 2)]
    out = []
    for length, memory, size in (("120", 2, "1e-4"), ("480", 2, "1e-4"), ("480", 4, "1e-4"), ("480", 2, "2e-4"), ("1890", 2, "1e-4"),
                                 ("1890", 8, "1e-4"), ("1890", 2, "5e-4")):
        paths = sorted(SUPERPOSED.glob(f"memory_{length}_{memory}_*.xz")) if memory != MEMORY else [
            Path(row["path"]) for row in packings(postproc) if row["length"] == length]
        out.append(line(length, memory, size, paths))
    return calibrate.table(["length", "memory", "events above", "packings", "gamma", "exponent, to 0.1"], out)


VELOCITY = 2.5e-4  # of each plate, in the paper
OTHERS = (("fast_120", 1e-3), ("slow_240", 1.25e-4), ("slow_480", 6.25e-5))


@functools.cache
def other_velocities(postproc):
    """(length, velocity, rows) of the faults whose plates move at another velocity."""
    found = []
    for name, velocity in OTHERS:
        rows = summary(postproc, sorted(LOADED.glob(f"{name}_*.xz")), begin=SETTLE + (LOADING - SETTLE) * VELOCITY / velocity)
        if rows:
            found.append((float(rows[0]["length"]), velocity, rows))
    return found


def loading_table(postproc):
    """The same length times velocity has the same statistics?"""
    faults = grouped(packings(postproc))
    lines = [(float(length), VELOCITY, faults[length]) for length in ("120", "240", "480") if length in faults] + other_velocities(postproc)
    lines.sort(key=lambda line: (line[0] * line[1], line[0]))
    return calibrate.table(["length", "velocity of each plate", "length times velocity", *SHAPE],
                           [[f"{length:g}", f"{velocity:g}", f"{length * velocity:.3g}", *shape(rows)] for length, velocity, rows in lines])


# ---- beside the paper


def weighted(rows, of, error=None):
    """Mean of the packings, weighted by their events, their standard deviation and the error of the mean, not below that of the fits."""
    found = [(of(row), number(row, "events_0.0001"), number(row, error) if error else math.nan) for row in rows]
    found = [one for one in found if math.isfinite(one[0])]
    total = sum(weight for _, weight, _ in found)
    mean = sum(x * weight for x, weight, _ in found) / total
    own = math.sqrt(sum((weight * e) ** 2 for _, weight, e in found if math.isfinite(e))) / total
    if len(found) < 2:
        return mean, math.nan, own
    deviation = math.sqrt(sum(weight * (x - mean) ** 2 for x, weight, _ in found) / total * len(found) / (len(found) - 1))
    return mean, deviation, max(own, deviation * math.sqrt(sum(weight**2 for _, weight, _ in found)) / total)


def within(groups, of, low, high, error=None):
    """Are the means of all groups between these, within two of their standard errors?"""
    off = []
    for name, rows in groups.items():
        mean, _, slack = weighted(rows, of, error)
        if not low - 2 * slack <= mean <= high + 2 * slack:
            off.append(name)
    if not off:
        return "predicted, agrees"
    return "predicted, **differs**" + ("" if len(off) == len(groups) else f" at {'; '.join(off)}")


def verdict(groups, key, error, target, tolerance):
    return within(groups, lambda row: number(row, key), target - tolerance, target + tolerance, error)


def with_deviation(rows, of, digits=2):
    mean, deviation, _ = weighted(rows, of)
    return f"{mean:.{digits}f}" + (f" ± {deviation:.{digits}f}" if math.isfinite(deviation) else "")


def by_length(groups, key, digits=2):
    return "; ".join(f"{length}: {with_deviation(rows, lambda row: number(row, key), digits)}" for length, rows in groups.items())


def slider_rows():
    """Settings of the block-slider nearest to the paper over all lengths, as calibrate.slider_table() has them."""
    groups = {}
    for row in calibrate.read(SLIDERS):
        if float(row["dt"]) >= 0.005:
            groups.setdefault(tuple(row[key] for key in calibrate.SLIDER_KEYS), []).append(row)
    return min(groups.values(), key=lambda rows: sum(calibrate.distance(row, calibrate.SLIDER_STATEMENTS) ** 2 for row in rows))


def paper_table(postproc):
    every = grouped(longest(postproc))
    used = next(rows for _, rows, was in by_use(longest(postproc)) if was)
    groups = {(f"{length}, other packings" if float(length) == USED else length): rows for length, rows, was in by_use(longest(postproc)) if not was}
    long = grouped(full_length(postproc))
    tolerance = {name: bound for name, _, _, _, bound in calibrate.STATEMENTS}

    def falling(row):
        return 100 * number(row, "in_events")

    def apart(row):
        return number(row, "mean_time_0.0001") / MEMORY

    def one(rows, key):
        return with_deviation(rows, lambda row: number(row, key))
    exponent, gamma = ("exponent_1e-4:1e-1", "error_1e-4:1e-1"), ("gamma_0.0001", "gamma_error_0.0001")
    out = [
        ["fault of 120: exponent >= 1e-4 over three decades", "1.07", one(used, exponent[0]), "used to calibrate"],
        ["fault of 120: gamma of the inter-event times >= 1e-4", "0.995", one(used, gamma[0]), "used to calibrate"],
        ["fault of 120: time from one event to the next, in memories of the picker (100 steps)", "12.5 to 100", with_deviation(used, apart, 0),
         "used to calibrate"],
        ["fault of 120: PE falls in less than a third of the time (stick-slip)", "yes", with_deviation(used, falling, 0) + " % of the time",
         "used to calibrate"],
        ["speed of P-waves", "2.1", f"{calibrate.WAVE_SPEED['r2']:g}", "used to calibrate"],
        ["others: exponent >= 1e-4", "1.07 at all lengths", by_length(groups, exponent[0]), verdict(groups, *exponent, PAPER["exponent"], tolerance["exponent"])],
        ["others: deviation from 1.07 in each of these decades (root mean square)", "0 (tolerance 0.3)",
         "; ".join(f"{length}: {with_deviation(rows, calibrate.decades)}" for length, rows in groups.items()), within(groups, calibrate.decades, 0.0, 0.3)],
        ["others: exponent 1e-3 to 0.1", "1.07 at all lengths", by_length(groups, "exponent_1e-3:1e-1"),
         verdict(groups, "exponent_1e-3:1e-1", "error_1e-3:1e-1", PAPER["exponent"], tolerance["exponent"])],
        ["others: gamma >= 1e-4", "0.995 at all lengths", by_length(groups, gamma[0]), verdict(groups, *gamma, PAPER["gamma"], tolerance["gamma"])],
        ["gamma >= 1e-3", "0.995 at all lengths, if events begin there", by_length(every, "gamma_0.001"),
         verdict(every, "gamma_0.001", "gamma_error_0.001", PAPER["gamma"], tolerance["gamma"])],
        ["others: memories of the picker from one event to the next", "12.5 to 100",
         "; ".join(f"{length}: {with_deviation(rows, apart, 0)}" for length, rows in groups.items()), within(groups, apart, 12.5, 100)],
        ["roll-off recedes with the length: largest event in 1.4e5 time units", "yes",
         "; ".join(f"{length}: {spread(values(rows, 'largest'), 2)}" for length, rows in long.items()),
         "predicted, agrees" if rises(long, "largest") else "predicted, **differs**"],
        ["others: PE falls in less than a third of the time", "yes",
         "; ".join(f"{length}: {with_deviation(rows, falling, 0)} %" for length, rows in groups.items()),
         within(groups, falling, 0.0, 100 * (0.33 + tolerance["stick-slip"]))],
    ]
    rows = sorted(slider_rows(), key=lambda row: int(row["blocks"]))
    setting = f"{rows[0]['scheme']}, time step {rows[0]['dt']}"
    texts = {"events": "events in 1e7 steps", "small": "exponent below size 1", "large": "exponent above", "gamma": "gamma", "B": "B",
             "C": "C"}
    printed = {"events": "3000 to 5000", "small": "0.5", "large": "1.0", "gamma": "0.0", "B": "100", "C": "0.25"}
    for n, (name, _, of, _, _) in enumerate(calibrate.SLIDER_STATEMENTS):
        met = sum(calibrate.deviations(row, calibrate.SLIDER_STATEMENTS)[n] <= 1.0 for row in rows)
        out.append([f"block-slider: {texts[name]}", printed[name],
                    ", ".join("-" if math.isnan(of(row)) else calibrate.short(of(row)) for row in rows) + (f" ({setting})" if n == 0 else ""),
                    "agrees" if met == len(rows) else f"agrees at {met} of {len(rows)} lengths" if met else "**differs**"])
    return calibrate.table(["", "paper", "here (mean and standard deviation between packings, weighted by events)", ""], out)


def rises(groups, key):
    means = [statistics.mean(values(rows, key)) for rows in groups.values()]
    return all(a < b for a, b in zip(means, means[1:]))


# ---- beside nature


def rows_of(name):
    with open(FOLDER / name) as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def as_number(text):
    return float(text) if text else math.nan


def brief(value, error=math.nan, digits=2):
    """0.667 ± 0.021: the error with one digit, or two below 3.5; without one this many digits."""
    if math.isnan(value):
        return "-"
    if not error > 0:
        return f"{value:.{digits}f}"
    last = math.floor(math.log10(error))
    places = max(0, -last + (1 if error / 10**last < 3.5 else 0))
    return f"{value:.{places}f} ± {error:.{places}f}"


def measured(row, key):
    return brief(as_number(row[key]), as_number(row[f"{key}_error"]))


def size_text(row):
    size = float(row["threshold"])
    return f"M >= {math.log10(size) / 1.5:.3g}" if row["label"] == "Southern California" else f">= {size:g}"


def nearest_of_each(rows):
    """Earthquakes, and of each model the smallest size that is nearest to them."""
    seen = set()
    return [row for row in rows if row["label"] == "Southern California" or not (row["label"] in seen or seen.add(row["label"]))]


def ranking(_):
    head = ["times ranked by distance", "catalogues, events", "distance", "gamma", "burstiness", "memory", "after large", "b"]
    return calibrate.table(head, [[f"{row['label']}, {size_text(row)}", f"{row['catalogues']}, {row['events']}"] +
                                  [measured(row, key) for key in ("distance", "gamma", "burstiness", "memory", "after", "b")]
                                  for row in nearest_of_each(rows_of("nature.table.csv"))])


def table1(_):
    """The paper's Table 1, its columns and four of ours."""
    rows = rows_of("nature.table1.csv")
    ours = []
    for label, size in TABLE1:
        both = [row for row in rows if (row["source"], row["threshold"]) == (label, size)]
        ours.append(next((row for row in both if not row["degenerate"]), both[-1]))
    head = [""] + [f"{row['source']}" for row in rows if row["origin"] == "printed"]
    head += [f"{row['source']}, " + size_text(dict(row, label=row["source"])) for row in ours]
    lines = []
    for key in ("gamma", "delta", "B", "C"):
        lines.append([key] + [row[key] for row in rows if row["origin"] == "printed"] + ["1 (held)" if key == "delta" and "held" in row["method"] else measured(row, key) for row in ours])
    return calibrate.table(head, lines)


TABLE1 = (("Southern California", "1000"), ("fault 120", "0.0001"), ("fault 1440", "0.0001"), ("slider 1928", "1"))


LAWS = {"coulomb": "Coulomb, 0.6", "static": "static 0.7 above 0.6", "slip-weakening": "slip weakening, 0.7 to 0.6, heals in 5",
        "velocity-weakening": "velocity weakening, vc 0.1", "slip-law": "rate and state, slip law", "ageing": "rate and state, ageing",
        "default-coulomb": "Coulomb, present default", "default-ageing": "ageing, present default"}


def over_packings(rows, key, digits=2):
    """Mean over the packings; its error from their scatter, and not below that of their own errors."""
    values = [(as_number(row[key]), as_number(row.get(f"{key}_error", ""))) for row in rows if row[key]]
    if len(values) < 2:
        return brief(*(values[0] if values else (math.nan,)), digits=digits)
    n, mean = len(values), sum(value for value, _ in values) / len(values)
    scatter = sum((value - mean) ** 2 for value, _ in values) / (n - 1) / n
    own = sum(error**2 for _, error in values if error > 0) / n**2
    return brief(mean, math.sqrt(max(scatter, own)), digits)


def laws(_):
    """Each law over its packings, p of each of them."""
    runs, out = rows_of("laws.csv"), []
    for name, text in LAWS.items():
        rows = [row for row in runs if row["run"].rsplit("_", 1)[0] == name]
        if not rows:
            continue
        p = ", ".join(measured(row, "omori_p") if row["omori_p"] else "none" for row in rows)
        out.append([text, f"{len(rows)}, {sum(int(row['events']) for row in rows)}"] +
                   [over_packings(rows, key, 1) for key in ("saw_tooth", "exponent", "gamma", "burstiness", "memory")] +
                   [f"{over_packings(rows, f'before_{part}')}, {over_packings(rows, f'after_{part}')}" for part in ("near", "far")] +
                   [", ".join(row["aftershocks"] or "0" for row in rows), p, over_packings(rows, "distance")])
    head = ["law", "packings, events", "saw-tooth", "exponent", "gamma", "burstiness", "memory", "before, after, to 300",
            "before, after, 300 to 3e4", "aftershocks", "Omori p", "distance"]
    return calibrate.table(head, out)


def root_mean_square(numbers):
    return math.sqrt(statistics.fmean(x * x for x in numbers))


def rupture_packing_table(_):
    """TPV3 in the random packing beside the boundary integral, from the stations of all packings."""
    spacings, out = {}, []
    with open(FOLDER / "rupture_packing-stations.csv", newline="") as file:
        for row in csv.DictReader(file):
            _, spacing, seed = row["run"].split(".")  # p.SPACING.SEED
            spacings.setdefault(int(spacing), {}).setdefault(seed, []).append({key: float(row[key]) for key in (
                "x", "arrival", "reference_arrival", "end_slip", "reference_end_slip")})
    for spacing, packed in sorted(spacings.items(), reverse=True):
        late = [root_mean_square([at["arrival"] - at["reference_arrival"] for at in stations]) for stations in packed.values()]
        at_place = zip(*(sorted((at["x"], at["arrival"]) for at in stations) for stations in packed.values()))
        scattered = math.sqrt(statistics.fmean(statistics.variance(arrival for _, arrival in place) for place in at_place))
        slip = [100 * (at["end_slip"] / at["reference_end_slip"] - 1) for stations in packed.values() for at in stations if abs(at["x"]) <= 12000]
        fast = 0
        for stations in packed.values():
            arrival = {at["x"]: at["arrival"] for at in stations}
            fast += sum(9000 / (arrival[side * 12000] - arrival[side * 3000]) > 3464 for side in (-1, 1))
        out.append([f"{spacing} m ({1.374 * spacing:.0f} m)", str(len(packed)), " to ".join(dict.fromkeys(f"{t:.2f}" for t in (min(late), max(late)))),
                    f"{scattered:.2f}", f"{fast} of {2 * len(packed)}",
                    f"{root_mean_square(slip):.1f}; {statistics.fmean(slip):.1f}"])
    return calibrate.table(["spacing (largest radius)", "packings", "arrival, rms of each (s)", "scatter between packings (s)",
                            "fronts faster than S-waves from 3 to 12 km", "slip, rms; mean (%)"], out)


def timings(table):
    """Wall and CPU ns for a particle and step, parts and memory of the rounds of each (label, length, ranks)."""
    out = {}
    with open(FOLDER / "speed/timings.csv", newline="") as file:
        for row in csv.DictReader(file):
            if row["table"] != table:
                continue
            per = 1e9 / float(row["atoms"]) / float(row["steps"])
            at = out.setdefault((row["label"], int(row["length"]), int(row["ranks"])), {})
            at[row["round"]] = {key: float(row[key] or 0) * per for key in ("seconds", "pair", "bond", "neigh", "comm", "modify")} | {
                "cpu": float(row["seconds"]) * per * float(row["cpu_percent"] or 100) / 100,
                "atoms": float(row["atoms"]), "bytes": float(row["resident"] or 0) * 1024 / float(row["atoms"])}
    return out


def middle(rounds, key="seconds"):
    return statistics.median(row[key] for row in rounds.values())


def ratio_of(rounds, base):
    """Median over the rounds of the ratio within each."""
    return statistics.median(row["seconds"] / base[number]["seconds"] for number, row in rounds.items() if number in base)


def speed_peers_table(_):
    found, out = {(label, ranks): rounds for (label, _, ranks), rounds in timings("peers").items()}, []
    for label in dict.fromkeys(label for label, _ in found):
        row = [label]
        for ranks in (1, 2):
            at, ours = found.get((label, ranks)), found["ours", ranks]
            row += [f"{1e3 / middle(at):.3g}", "" if at is ours else f"{ratio_of(at, ours):.3g}"] if at else ["", ""]
            last = at or last
        out.append(row + [f"{middle(last, 'bytes'):.0f}"])
    return calibrate.table(["PE at every step, length 1890", "million particle-steps/s, 1 rank", "ours is faster", "2 ranks", "ours is faster",
                            "bytes for a particle, most ranks"], out)


def speed_lengths_table(_):
    found, out = {key[1:]: rounds for key, rounds in timings("lengths").items()}, []
    for length in sorted({length for length, _ in found}):
        one, two = found[length, 1], found[length, 2]
        parts = [f"{middle(two, key):.2f}" for key in ("bond", "pair", "modify", "comm", "neigh")]
        out.append([str(length), f"{middle(two, 'atoms'):.0f}", f"{middle(one):.1f}", f"{middle(two):.1f}", *parts])
    return calibrate.table(["length", "particles", "ns, 1 rank", "2 ranks", "links", "contacts", "integration, plates, events", "communication",
                            "lists"], out)


def speed_changes_table(_):
    names = {key[0]: rounds for key, rounds in timings("features").items()}
    ratio = {label: f"{ratio_of(rounds, names['base of ' + label]):.2f}" for label, rounds in names.items() if "base of " + label in names}
    lines = [["contacts of all discs"], ["nothing recorded", "location of events", "energy ledger"],
             ["static friction above dynamic", "slip weakening", "velocity weakening"],
             ["rate and state (ageing)", "rate and state (slip)", "no friction (lsm/free)"],
             ["links that can break", "no viscosity", "dashpots of links and contacts"],
             ["pressure every 100 steps", "pressure every step", "all lists rebuilt every 100 steps"]]
    return calibrate.table(["one thing changed, length 1890, 2 ranks", "time of a step, ratio"],
                           [["; ".join(line), "; ".join(ratio[label] for label in line)] for line in lines])


def speed_causes_table(_):
    return calibrate.table(["why a step of a run takes longer, length 480, one rank", "CPU ns"],
                           [[key[0], f"{middle(rounds, 'cpu'):.1f}"] for key, rounds in timings("causes").items()])


def speed_slices_table(_):
    """What 1.2e6 steps of each fault of the campaign take, from slices of them."""
    found, out, hours = {key[1:]: rounds for key, rounds in timings("campaign").items()}, [], {1: 0.0, 2: 0.0}
    for length in sorted({length for length, _ in found}):
        row = [str(length)]
        for ranks in (1, 2):
            at = found[length, ranks]
            seconds = middle(at) * 1e-9 * middle(at, "atoms") * 1.2e6
            hours[ranks] += seconds / 3600
            row += [f"{middle(at):.1f}", f"{seconds:.0f}"]
        out.append(row)
    out.append(["all six", "", f"{hours[1]:.2f} h", "", f"{hours[2]:.2f} h"])
    return calibrate.table(["length", "ns, 1 rank", "s for 1.2e6 steps", "ns, 2 ranks", "s for 1.2e6 steps"], out)


TABLES = {
    "laws": laws,
    "ranking": ranking,
    "table1": table1,
    "paper": paper_table,
    "statements": lambda _: calibrate.statements_table(POINTS),
    "pairs": lambda _: calibrate.pairs_table(POINTS),
    "ranges": lambda _: calibrate.ranges_table(POINTS),
    "accepted": lambda _: calibrate.accepted_table(POINTS),
    "ringing": lambda _: calibrate.ringing_table(POINTS),
    "lines": lambda _: calibrate.lines_table(POINTS),
    "twice": lambda _: calibrate.twice_table(POINTS),
    "sliders": lambda _: calibrate.slider_table(SLIDERS),
    "campaign": campaign_table,
    "campaign-before": campaign_before_table,
    "steady": steady_table,
    "decades": decades_table,
    "packings": packings_table,
    "validation": validation_table,
    "thresholds": thresholds_table,
    "collapse": collapse_table,
    "ruptures-before": ruptures_before_table,
    "rupture-laws-before": rupture_laws_before_table,
    "drops-before": drops_before_table,
    "drops": drops_table,
    "ruptures-long": ruptures_long_table,
    "widths": widths_table,
    "steps": steps_table,
    "picker-steps": picker_steps_table,
    "superposition": superposition_table,
    "gaps": gaps_table,
    "loading": loading_table,
    "remedies": remedies_table,
    "rupture-packing": rupture_packing_table,
    "speed-peers": speed_peers_table,
    "speed-lengths": speed_lengths_table,
    "speed-changes": speed_changes_table,
    "speed-causes": speed_causes_table,
    "speed-slices": speed_slices_table,
}


def pages():
    return sorted(FOLDER.glob("*.md")) + [FOLDER.parent.parent / "README.md"]


def main(postproc, write):
    wrong = 0
    for page in pages():
        text = page.read_text()

        def replace(match):
            if match[1] not in TABLES:
                sys.exit(f"{page.name}: table {match[1]}, expected one of {', '.join(TABLES)}")
            return f"<!-- table {match[1]} -->\n\n{TABLES[match[1]](postproc)}\n\n<!-- end -->"
        new = re.sub(r"<!-- table (\S+) -->.*?<!-- end -->", replace, text, flags=re.S)
        if new == text:
            continue
        if write:
            page.write_text(new)
            continue
        wrong = 1
        print("\n".join(difflib.unified_diff(text.splitlines(), new.splitlines(), page.name, "from the catalogues", lineterm="")))
    return wrong


# ---- figures


def length_figure(postproc, base):
    """gamma, exponent and share of brief events against length times velocity: faults, sums, other velocities."""
    faults = [(float(length), rows) for length, rows in grouped(packings(postproc)).items()]
    sums = {}
    for path in sorted(SUPERPOSED.glob("sum_*.xz")):
        sums.setdefault(float(path.name.split("_")[1]), []).append(path)
    groups = [("faults, plates at 2.5e-4", "#0072b2", 7, [(length * VELOCITY, rows) for length, rows in faults]),
              ("faults, plates at other velocities", "#d55e00", 5, [(length * v, rows) for length, v, rows in other_velocities(postproc)]),
              ("PE of faults of 120 added up", "#999999", 6,
               [(length * VELOCITY, summary(postproc, paths, begin=0)) for length, paths in sorted(sums.items())])]
    script = "set multiplot layout 1,3\nset tics nomirror\nset border 3\nset logscale x\nset xlabel 'length times velocity'\n"
    script += "set xrange [0.02:0.7]\nset xtics (0.03, 0.06, 0.12, 0.24, 0.48)\nset key bottom left Left reverse samplen 1\n"
    for label, key, of_paper, scale, span in (("gamma >= 1e-4", "gamma_0.0001", PAPER["gamma"], 1, "[0:1.2]"),
                                              ("exponent, 1e-4 to 0.1", "exponent_1e-4:1e-1", PAPER["exponent"], 1, "[0.8:1.4]"),
                                              ("events of 3 steps or less, %", "brief", None, 100, "[0:20]")):
        blocks, plots = "", []
        for n, (name, colour, point, members) in enumerate(groups):
            lines = [f"{x * 1.03 ** (n - 1):.6g} {scale * statistics.mean(found):.6g} {scale * (statistics.stdev(found) if len(found) > 1 else 0):.6g}"
                     for x, rows in members if (found := values(rows, key))]
            blocks += f"$d{n} << EOD\n" + "\n".join(lines or ["nan nan nan"]) + "\nEOD\n"
            plots.append(f"$d{n} with yerrorbars pt {point} ps 1.2 lw 1.5 lc rgb '{colour}' title '{name}'")
        if of_paper is not None:
            plots.append(f"{of_paper} with lines dt 2 lc rgb 'black' title 'paper'")
        script += blocks + f"set ylabel '{label}'\nset yrange {span}\nplot " + ", ".join(plots) + "\nunset key\n"
    script += "unset multiplot\n"
    heads = [f"set terminal pngcairo size 1500,480 font 'DejaVu Sans,13'\nset output '{base}.png'\n",
             f"set terminal svg size 1200,400 font 'DejaVu Sans,11'\nset output '{base}.svg'\n"]
    subprocess.run(["gnuplot"], input="".join(head + script + "unset output\nreset\n" for head in heads), text=True, check=True)


def figures(postproc):
    one_each = sorted(CAMPAIGN.glob("fault_*[0-9]_1.catalogue.csv.xz"), key=length_and_seed)
    common = [*map(str, one_each), "--from", str(LOADING), "--threshold", "1e-4"]
    subprocess.run([postproc, "histograms", *common, "--guide=-1.07:1e-4:0.1", "-o", FOLDER / "fig12_fault_sizes"], check=True)
    subprocess.run([postproc, "intervals", *common, "--delta", "1", "--shortest", "0", "--shuffles", "0", "-o",
                    FOLDER / "fig14_fault_intervals"], check=True)
    for name in ("fig12_fault_sizes.svg", "fig14_fault_intervals.svg", "fig14_fault_intervals.clustering.csv"):
        (FOLDER / name).unlink(missing_ok=True)
    length_figure(postproc, FOLDER / "gamma-length")
    calibrate.figure(POINTS, FOLDER / "calibration")
    return 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--write"], ["--figures"]):
        sys.exit(__doc__)
    sys.exit(figures(sys.argv[1]) if sys.argv[2:] == ["--figures"] else main(sys.argv[1], len(sys.argv) == 3))
