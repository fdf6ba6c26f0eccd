#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the tables of the pages about results from the catalogues in this folder.

tables.py POSTPROC            says which tables are not what the catalogues give; exit status 1 if there is one
tables.py POSTPROC --write    writes them into the pages
tables.py POSTPROC --figures  draws the figures of calibration.md and faults.md from the same numbers

A table stands between the lines <!-- table NAME --> and <!-- end -->, in a page of this folder or the project's README.md. Numbers
of catalogues are those of postproc; here are means over packings, and what stands beside what. A folder without catalogues leaves
its lines out.
"""
import cmath
import csv
import difflib
import functools
import json
import lzma
import math
import random
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent / "inputs/studies"))
import calibrate  # noqa: E402
import superpose  # noqa: E402
from calibrate import number, table  # noqa: E402

POSTPROC = "postproc"  # the program, set by main()
POINTS, SLIDERS = FOLDER / "calibration/points.csv.xz", FOLDER / "calibration/sliders.csv.xz"
PACKING = FOLDER / "packing"  # faults with faces and seeds at random places; those of the folders below had them on a grid
CAMPAIGN = FOLDER / "campaign"  # the faults of the paper; those of the validation are shorter runs of more packings
VALIDATION, SUPERPOSED, LOADED = FOLDER / "validation", FOLDER / "superposed", FOLDER / "loading"
LOADING, SETTLE = 4500, 1200  # time units that are left out: compression (SETTLE of them), and PE rising for the first time
PAPER = {"exponent": 1.07, "gamma": 0.995}
USED = {"120": 3}  # lengths at which the default was calibrated, and with how many packings of each
MEMORY, VELOCITY = 2.0, 2.5e-4  # of the picker, time units; of each plate
SIGNIFICANT, FEWEST = 0.05, 15  # events whose times are fitted
SIZES = ("1e-4", "1e-3", "1e-2", "0.1")
DECADES = calibrate.RANGES[1:]
RANGES = ("1e-4:1e-1", "1e-3:1", "1e-3:1e-1", *DECADES)

# ---- numbers of postproc


def told(done):
    """What postproc printed. \\raises ValueError with its message"""
    if done.returncode:
        raise ValueError(done.stderr.strip())
    return done.stdout


@functools.cache
def rows_of(paths, *words, begin=LOADING):
    """Rows of postproc summary, one for each catalogue (a tuple of paths), with its path."""
    if not paths:
        return []
    ranges = () if "--range" in words else ("--range", *RANGES[:2])
    said = told(
        subprocess.run([POSTPROC, "summary", *map(str, paths), "--from",
                        str(begin), "--parameter", "length", "seed", "width", "dt", *ranges, *words], capture_output=True, text=True))
    rows = csv.DictReader(line for line in said.splitlines() if not line.startswith("#"))
    return [dict(row, path=path) for path, row in zip(paths, rows)]


def numbers_of(command, *words):
    """JSON of a command of postproc that also writes files."""
    with tempfile.TemporaryDirectory() as work:
        told(subprocess.run([POSTPROC, command, *map(str, words), "-o", f"{work}/out", "--json", f"{work}/out.json"], capture_output=True, text=True))
        return json.loads(Path(f"{work}/out.json").read_text())


def found(folder, *patterns):
    """Catalogues, by length and seed."""
    return tuple(sorted((path for pattern in patterns for path in folder.glob(pattern)), key=length_and_seed))


def length_and_seed(path):
    words = re.findall(r"\d+", path.name.split(".")[0])
    return int(words[0]), int(words[1]) if len(words) > 1 else 1


def at(key, size):
    """Name of a column of postproc summary."""
    return f"{key}_{float(size):g}"


def values(rows, key):
    return [x for x in (number(row, key) for row in rows) if math.isfinite(x)]


def grouped(rows, key="length"):
    groups = {}
    for row in sorted(rows, key=lambda row: float(row[key])):
        groups.setdefault(row[key], []).append(row)
    return groups


# ---- cells: functions of the rows of a line, one catalogue or packings of one kind


def spread(numbers, digits=2, error=math.nan, end=""):
    """Mean with the standard deviation between packings; of one catalogue with the error of its fit, if given."""
    if not numbers:
        return "-"
    if len(numbers) > 1:
        error = statistics.stdev(numbers)
    return f"{statistics.mean(numbers):.{digits}f}" + (f" ± {error:.{digits}f}" if math.isfinite(error) else "") + end


def cell(key, digits=2, error=None):
    return lambda rows: spread(values(rows, key), digits, number(rows[0], error) if error else math.nan)


def mean(key, digits=0, times=1, end=""):
    return lambda rows: f"{times * statistics.mean(values(rows, key)):.{digits}f}{end}" if values(rows, key) else "-"


def gammas(*sizes, error=True):
    return [("gamma >= " * (n == 0) + size, cell(at("gamma", size), 2, at("gamma_error", size) if error else None)) for n, size in enumerate(sizes)]


BRIEF = ("of 3 steps or less", mean("brief", 1, 100, " %"))
TIME, EVENTS, LARGEST = ("time units", mean("time")), ("events >= 1e-4", mean("events_0.0001")), ("largest", cell("largest"))
EXPONENTS = [("exponent 1e-4 to 0.1", cell("exponent_1e-4:1e-1", 2, "error_1e-4:1e-1")), ("1e-3 to 1", cell("exponent_1e-3:1", 2, "error_1e-3:1"))]
SHAPE = [("", lambda rows: str(len(rows))), *gammas("1e-4", "1e-3", error=False), ("mean time", cell("mean_time_0.0001", 0)), BRIEF,
         ("exponent 1e-4 to 0.1", cell("exponent_1e-4:1e-1")), LARGEST]


def lines(head, columns, groups):
    """A table: what a line begins with, and the cells of its rows. Lines without rows are left out."""
    return table([*head, *(name for name, _ in columns)], [[*begin, *(text(rows) for _, text in columns)] for begin, rows in groups if rows])


def each(rows):
    return [([row["length"], row["seed"]], [row]) for row in rows]


# ---- faults


def packings():
    """Rows of the validation, one for each length and packing; without one, of the campaign."""
    return rows_of(found(VALIDATION, "fault_*[0-9]_[0-9].catalogue.csv.xz"), "--range", *RANGES) or full_length()


def full_length():
    """Rows of the campaign."""
    return rows_of(found(CAMPAIGN, "fault_*[0-9]_[0-9].catalogue.csv.xz"), "--range", *RANGES)


def longest():
    """Rows of the longest run of each length and packing."""
    rows = {length_and_seed(row["path"]): row for row in [*packings(), *full_length()]}
    return [rows[key] for key in sorted(rows)]


def by_use(rows):
    """(length, rows, were they used to calibrate?): the packings of the calibration apart from others of that length."""
    for length, rows in grouped(rows).items():
        used = [row for row in rows if int(row["seed"]) <= USED.get(length, 0)]
        for part in (used, [row for row in rows if row not in used]):
            if part:
                yield length, part, part is used


def enough(rows, size):
    return [row for row in rows if number(row, at("events", size)) >= FEWEST]


def sizes_and_times(rows):
    columns = [
        TIME, EVENTS, *((size, mean(at("events", size))) for size in SIZES[1:3]), BRIEF, *EXPONENTS, LARGEST, *gammas(*SIZES),
        *(("mean time >= " * (n == 0) + size, mean(at("mean_time", size))) for n, size in enumerate(SIZES))
    ]
    return lines(["length", "seed"], columns, each(rows))


def random_packings():
    """Rows of the faults with faces and seeds at random places."""
    return rows_of(found(PACKING, "fault_*.catalogue.csv.xz"), "--range", *RANGES)


def face_factors():
    """Structure factor of the discs that touch the fault line, at half the spacing of the grid (1, or as near as fits into the
    length): (seeds, length) -> one for each face of each packing."""
    places = {}
    with lzma.open(PACKING / "faces.csv.xz", "rt") as file:
        for row in csv.DictReader(file):
            places.setdefault((row["seeds"], row["length"]), {}).setdefault((row["packing"], row["side"]), []).append(float(row["x"]))

    def factor(face, length):
        k = 2 * math.pi * 2 * math.floor(float(length) / 2) / float(length)
        return abs(sum(cmath.exp(1j * k * x) for x in face))**2 / len(face)

    return {(seeds, length): [factor(face, length) for face in faces.values()] for (seeds, length), faces in places.items()}


def ground_table():
    """What the period of the faces did, and what is recorded of the slip: grid and random places beside each other."""
    factors = face_factors()
    statements = {}
    for row in calibrate.read(PACKING / "statements.csv"):
        if row["number"].startswith("slip recorded over"):
            statements.setdefault(("grid" if row["run"].startswith("grid") else "random", row["length"]), []).append(float(row["value"]))

    def periods(folder, length):
        rows = [numbers_of("periods", path, "--from", LOADING, "--no-picture") for path in found(folder, f"fault_{length}_[0-9].catalogue.csv.xz")]
        return [float(row["periods"][0]["z"]) for row in rows]

    def text(numbers, digits=1):
        return ", ".join(f"{value:.{digits}f}" for value in numbers) or "-"

    out = []
    for length in sorted({length for _, length in factors}, key=float):
        out.append([
            length, *(text(factors[seeds, length]) for seeds in ("grid", "random")),
            text(periods(CAMPAIGN, length)),
            text(periods(PACKING, length)), *(text(statements.get((seeds, length), []), 2) for seeds in ("grid", "random"))
        ])
    return table([
        "length", "structure factor of each face at wavelength 1, grid (two packings)", "random places", "Z at a slip of 1, grid", "random places",
        "slip recorded over that of the plates, before", "now"
    ], out)


def decades_table(rows=None):
    """Is it one power law? Exponents of each decade of the long runs."""
    columns = [(text.replace(":", " to "), cell(f"exponent_{text}", 2, f"error_{text}")) for text in DECADES]
    columns += [("1e-3 to 0.1", cell("exponent_1e-3:1e-1", 2, "error_1e-3:1e-1")),
                ("deviation from 1.07", lambda rows: f"{calibrate.decades(rows[0]):.2f}")]
    return lines(["length", "seed"], columns, each(full_length() if rows is None else rows))


def steady_table(parts=4):
    """Do the long runs change with time? Their parts beside each other."""
    out = []
    for row in full_length():
        bounds = [LOADING + float(row["time"]) * n / parts for n in range(parts + 1)]
        quarters = [rows_of((row["path"],), "--to", f"{b:.17g}", begin=a)[0] for a, b in zip(bounds, bounds[1:])]
        counts = values(quarters, "events_0.0001")
        chi2 = sum((count - statistics.mean(counts))**2 for count in counts) / statistics.mean(counts)
        keys = ("exponent_1e-4:1e-1", "gamma_0.0001", "gamma_0.001", "largest")
        out.append([
            row["length"], row["seed"], ", ".join(f"{count:.0f}" for count in counts), f"{chi2:.1f}",
            *(", ".join(cell(key)([quarter]) for quarter in quarters) for key in keys)
        ])
    return table(
        ["length", "seed", "events >= 1e-4 in each quarter", f"chi^2 of {parts - 1}", "exponent 1e-4 to 0.1", "gamma >= 1e-4", ">= 1e-3", "largest"],
        out)


def validation_table():
    columns = [("packings", lambda rows: str(len(rows))), ("time units each", TIME[1]), EVENTS, BRIEF,
               ("exponent 1e-4 to 0.1", cell("exponent_1e-4:1e-1")), ("1e-3 to 1", cell("exponent_1e-3:1")), LARGEST,
               ("gamma >= 1e-4", cell("gamma_0.0001")), (">= 1e-3", cell("gamma_0.001")), ("mean time", cell("mean_time_0.0001", 0)),
               ("", lambda rows: "used" if rows[0] in used else "predicted")]
    groups = list(by_use(packings()))
    used = [row for _, rows, was in groups if was for row in rows]
    return lines(["length"], columns, [([length], rows) for length, rows, _ in groups])


def thresholds_table():
    """gamma and B against the smallest size."""

    def both(size):
        return lambda rows: "; ".join(spread(values(enough(rows, size), at(key, size)), digits)
                                      for key, digits in (("gamma", 2), ("B", 0))) if enough(rows, size) else "-"

    return lines(["gamma; B at length"], [((">= 1e-4" if size == "1e-4" else size), both(size)) for size in SIZES],
                 [([length], rows) for length, rows in grouped(longest()).items()])


def collapse_table():
    """Do the times of each length, over their mean, have the law of those of the shortest? Do they depend on the one before?"""
    groups = grouped(longest())
    base = next(iter(groups.values()))

    def tests(size):

        def text(rows):
            p, chosen = [], enough(rows, size)
            for n, row in enumerate(chosen):
                others = enough(base[:n] if rows is base else base, size)
                if others:
                    tests = numbers_of("compare", row["path"], *(other["path"] for other in others), "--from", LOADING, "--rescale", "--replicas",
                                       400, "--threshold", size)["tests"]
                    p += [test["p"] for test in tests if test["quantity"] == "time"]
            dependent = sum(p < SIGNIFICANT for p in values(chosen, at("spearman_p", size)))
            return f"{statistics.median(p):.2f} ({sum(x < SIGNIFICANT for x in p)} of {len(p)}); " \
                   f"{statistics.mean(values(chosen, at('spearman', size))):.2f} ({dependent} of {len(chosen)})" if p else "-"

        return text

    return lines(["p; Spearman at length"], [((">= 1e-4" if size == "1e-4" else size), tests(size)) for size in SIZES],
                 [([length], rows) for length, rows in groups.items()])


def widths_table():
    rows = rows_of(found(VALIDATION, "fault_120_1.catalogue.csv.xz", "fault_120_width_*.xz"))
    columns = [
        TIME, EVENTS, BRIEF, *EXPONENTS, LARGEST, *gammas("1e-4", "1e-3"), ("mean time >= 1e-4", mean("mean_time_0.0001")),
        ("1e-2", mean("mean_time_0.01"))
    ]
    return lines(["width"], columns, [([width], rows) for width, rows in grouped(rows, "width").items()])


def steps_table(sizes=("1e-4", "2e-4", "3e-4", "1e-3")):
    """Time step 0.06 with all masses r^2 beside the default of 0.12, and picked at every second step; the same packings."""

    def total(size):
        return lambda rows: f"{sum(values(rows, at('events', size))):.0f}"

    columns = [("packings", lambda rows: str(len(rows))), *(("events >= " * (n == 0) + size, total(size)) for n, size in enumerate(sizes)),
               ("exponent 1e-4 to 0.1", cell("exponent_1e-4:1e-1")), *gammas(*sizes, error=False)]
    groups = []
    for length in ("120", "480"):
        seeds = [path.name.split("_")[3][0] for path in found(VALIDATION, f"fault_{length}_step_*.catalogue.csv.xz")]
        for what, kind in (("0.12", ""), ("0.06", "step_"), ("0.06, picked at every second step", "every_")):
            paths = tuple(VALIDATION / f"fault_{length}_{kind}{seed}.catalogue.csv.xz" for seed in seeds)
            groups.append(([length, what], rows_of(paths, "--threshold", *sizes)))
    return lines(["length", "time step"], columns, groups)


def picker_steps_table(sizes=("1e-4", "2e-4", "3e-4", "5e-4", "1e-3", "2e-3", "5e-3")):
    """The long runs picked at each step and at every second one: from which size on do counts not depend on the steps of the picker?"""
    groups = []
    for path in found(CAMPAIGN, "fault_*_every_*.catalogue.csv.xz"):
        length, seed = length_and_seed(path)
        groups.append(([str(length), str(seed)], rows_of((CAMPAIGN / f"fault_{length}_{seed}.catalogue.csv.xz", path), "--threshold", *sizes)))
    return lines(["length", "seed"], [("events >= " * (n == 0) + size, lambda rows, size=size: ", ".join(row[at("events", size)] for row in rows))
                                      for n, size in enumerate(sizes)], groups)


# ---- ruptures


def characteristic_sizes(paths, least, begin, highest="1"):
    """Of postproc fit: exponents of these catalogues, and their characteristic sizes; with the law of growth."""
    order = sorted(paths)  # that of pictures.sh, on which the random numbers of the errors depend
    numbers = numbers_of("fit", *order, "--scaling", "--threshold", least, "--from", begin, "--range", f"{least}:{highest}", "--replicas", 0,
                         "--no-comparison", "--no-picture")
    scaling = numbers["scaling"][0]
    return [(numbers["fits"][n], scaling["points"][n]) for n in map(order.index, paths)], scaling


def growth(scaling):
    """How the characteristic size depends on the length, in a line."""
    return "" if "D" not in scaling else (
        f"\n\ns* goes as L^({scaling['D']:.3f} ± {scaling['D_error']:.3f}), chi^2 {scaling['chi2']:.0f} on {len(scaling['points']) - 2} "
        f"degrees of freedom; AICc {scaling['aicc']:.1f}, of a constant {scaling['aicc_constant']:.1f}.")


def returns(rows, length, places):
    """Times after which a place ruptures again, of so many places."""
    for n in range(places):
        place = (n + 0.5) * length / places
        times = sorted(number(row, "t_start") for row in rows if (place - number(row, "x_begin")) % length < number(row, "rupture_length"))
        yield from (b - a for a, b in zip(times, times[1:]))


def single_ruptures(paths, begin, places=8):
    """Ruptures >= 1e-2 of each fault."""

    def scatter(times):
        return f"{statistics.mean(times):.0f}, {statistics.stdev(times) / statistics.mean(times):.2f}"

    found, scaling = characteristic_sizes(paths, "1e-2", begin)
    out = []
    for path, (fit, point) in zip(paths, found):
        length, seed = length_and_seed(path)
        rows = [row for row in calibrate.read(path) if number(row, "t_start") >= begin and number(row, "size") >= 1e-2]
        time, lengths = max(values(rows, "t_end")) - begin, values(rows, "rupture_length")
        starts = sorted(values(rows, "t_start"))
        out.append([
            f"{length}, {seed}", f"{time:.0f}", f"{sum(x > 10 for x in lengths) / time / length * 1e5:.1f}",
            f"{fit['exponent']:.2f} ± {fit['standard_error']:.2f}", f"{point['s_star']:.3f} ± {point['error']:.3f}", f"{max(lengths):.0f}",
            str(sum(x >= length for x in lengths)), f"{max(values(rows, 'slip_moment')):.0f}",
            scatter(list(returns(rows, length, places))),
            scatter([b - a for a, b in zip(starts, starts[1:])])
        ])
    return table([
        "length, seed", "time units", "longer than 10, per 1e5 time units and unit of length", "exponent 1e-2 to 1", "s*", "longest",
        "of the whole fault", "largest moment", f"time until one of {places} places ruptures again: mean, deviation over it",
        "the same of the whole fault"
    ], out) + growth(scaling)


def rupture_laws(paths):
    """Moment against length, and drop of the total PE against moment, of ruptures that did not break the whole fault."""
    numbers = numbers_of("rupture", *paths, "--no-picture")
    lengths = [(row["length"], row["moment"]) for row in numbers["length"] if not row["whole_fault"] and row["moment"] > 0]
    drops = [(row["moment"], row["pe_drop"], row["alone"]) for row in numbers["pe"] if row["moment"] > 0 and (row["pe_drop"] or 0) > 0]

    def law(points):
        x, y = ([math.log10(point[n]) for point in points] for n in (0, 1))
        slope, begin = statistics.linear_regression(x, y)
        off = math.sqrt(math.fsum((b - begin - slope * a)**2 for a, b in zip(x, y)) / (len(x) - 2))
        return [str(len(x)), f"{slope:.3f} ± {off / math.sqrt(len(x)) / statistics.pstdev(x):.3f}", f"{off:.2f}"]

    return table(["", "ruptures", "exponent", "scatter in decades"],
                 [["moment against length", *law(lengths)], ["of ruptures of 30 or longer", *law([one for one in lengths if one[0] >= 30])],
                  ["drop of PE against moment, isolated ruptures", *law([one for one in drops if one[2]])], ["all for which PE drops", *law(drops)]])


def drops(paths):
    """Characteristic sizes of drops of the total PE."""
    found, scaling = characteristic_sizes(paths, "1e-3", LOADING)
    groups = {}
    for path, (_, point) in zip(paths, found):
        groups.setdefault(str(length_and_seed(path)[0]), []).append(f"{point['s_star']:.2f} ± {point['error']:.2f}")
    return table(["length", *groups], [["s* (sizes >= 1e-3)", *("; ".join(one) for one in groups.values())]]) + growth(scaling)


# ---- why gamma falls


def superposition_table():
    faults = grouped(packings())
    groups = [(["120", "the fault"], faults.get("120"))]
    for length, other in (("240", "240"), ("480", "480"), ("960", "945"), ("1920", "1890")):
        count = int(length) // 120
        groups.append(([other, "the fault"], faults.get(other)))
        for name, what in (("sum", f"{count} stretches of 120 together"), ("load", f"one stretch of 120 with the load of {count - 1} more")):
            groups.append(([length, what], rows_of(found(SUPERPOSED, f"{name}_{length}_*.xz"), begin=0)))
    return lines(["length", ""], SHAPE, groups)


def events_of(path, begin=0.0, end=math.inf):
    """[begin, end, size] of the events >= 1e-4 within these times, which are counted from `begin`."""
    return [[number(row, "t_start") - begin, number(row, "t_end") - begin,
             number(row, "size")] for row in calibrate.read(path)
            if number(row, "size") >= 1e-4 and begin <= number(row, "t_start") and number(row, "t_end") <= end]


def gammas_of(catalogues, *sizes):
    """gamma of the times of lists of [begin, end, size] above these sizes, by postproc."""
    head = "# lsm-catalogue 1\n# model = lsm\n# length = 1\nevent_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end\n"
    with tempfile.TemporaryDirectory() as work:
        paths = tuple(Path(work) / f"{n}.csv" for n in range(len(catalogues)))
        for path, events in zip(paths, catalogues):
            path.write_text(head + "".join(f"{n},{begin!r},{begin!r},0,0,{size!r},{size!r},0\n" for n, (begin, _, size) in enumerate(events, 1)))
        rows = rows_of(paths, "--shortest", "0", "--threshold", *sizes, begin=0)  # all times: no picker has kept these apart
    return [spread(values(rows, at("gamma", size))) for size in sizes]


def from_ends(events):
    """The same events without the time that they take."""
    taken, out = 0.0, []
    for begin, end, size in events:
        out.append([begin - taken, begin - taken, size])
        taken += end - begin
    return out


def shuffled(events):
    sizes = [size for _, _, size in events]
    random.Random(1).shuffle(sizes)
    return [[begin, end, size] for (begin, end, _), size in zip(events, sizes)]


def gaps_table():
    """Why gamma >= 1e-3 is above one: times from the end of an event, sizes shuffled, and a picker for each of several faults."""
    parts = [(n, row["path"]) for row in packings() if row["length"] == "120" for n in range(int(number(row, "time") / superpose.DURATION))]
    parts = [(path, superpose.LOADING + n * superpose.DURATION) for n, path in sorted(parts)]  # as superpose.stretches() has them
    out = []

    def line(length, what, catalogues):
        if not catalogues:
            return
        large = [[event for event in events if event[2] >= 1e-3] for events in catalogues]
        between = statistics.mean(statistics.mean(b[0] - a[0] for a, b in zip(events, events[1:])) for events in large)
        lasting = statistics.mean(statistics.mean(end - begin for begin, end, _ in events) for events in large)
        ends = ["-"] if "each" in what else gammas_of([from_ends(events) for events in large], "1e-3")  # with a picker each they overlap
        out.append([
            length, what,
            str(len(catalogues)), *gammas_of(catalogues, "1e-4", "1e-3"), *ends, *gammas_of(map_of(shuffled, catalogues), "1e-3"), f"{between:.0f}",
            f"{lasting:.0f}"
        ])

    for length, rows in grouped(longest()).items():
        line(length, "the fault", [events_of(row["path"], LOADING) for row in rows])
    for count in superpose.NUMBERS:
        length = str(count * 120)
        groups = [parts[n * count:(n + 1) * count] for n in range(min(superpose.GROUPS, len(parts) // count))]
        line(length, f"{count} stretches of 120, one picker", [events_of(path) for path in found(SUPERPOSED, f"sum_{length}_*.xz")])
        line(length, f"{count} stretches of 120, a picker each",
             [sorted(event for path, begin in group for event in events_of(path, begin, begin + superpose.DURATION)) for group in groups])
    return table([
        "length", "", "packings or sums", "gamma >= 1e-4", ">= 1e-3", ">= 1e-3, from end to begin", ">= 1e-3, sizes shuffled", "mean time >= 1e-3",
        "mean duration"
    ], out)


def map_of(change, catalogues):
    return [change(events) for events in catalogues]


def remedies_table():
    """What a longer memory of the picker, or a larger smallest size, does to gamma and exponent of longer faults."""
    groups = []
    for length, memory, size in (("120", 2, "1e-4"), ("480", 2, "1e-4"), ("480", 4, "1e-4"), ("480", 2, "2e-4"), ("1890", 2, "1e-4"),
                                 ("1890", 8, "1e-4"), ("1890", 2, "5e-4")):
        paths = found(SUPERPOSED, f"memory_{length}_{memory}_*.xz") if memory != MEMORY else tuple(row["path"] for row in packings()
                                                                                                   if row["length"] == length)
        rows = rows_of(paths, "--threshold", "1e-4", size, "--range", f"{float(size):g}:1e-1")
        groups.append(([length, f"{memory:g}",
                        size], [dict(row, gamma=row[at("gamma", size)], exponent=row[f"exponent_{float(size):g}:1e-1"]) for row in rows]))
    return lines(["length", "memory", "events above"], [("packings", lambda rows: str(len(rows))), ("gamma", cell("gamma")),
                                                        ("exponent, to 0.1", cell("exponent"))], groups)


def other_velocities():
    """(length, velocity, rows) of the faults whose plates move at another velocity."""
    for name, velocity in (("fast_120", 1e-3), ("slow_240", 1.25e-4)):
        rows = rows_of(found(LOADED, f"{name}_*.xz"), begin=SETTLE + (LOADING - SETTLE) * VELOCITY / velocity)
        if rows:
            yield float(rows[0]["length"]), velocity, rows


def loading_table():
    """The same length times velocity has the same statistics?"""
    faults = [(float(length), VELOCITY, rows) for length, rows in grouped(packings()).items() if length in ("120", "240", "480")]
    chosen = sorted([*faults, *other_velocities()], key=lambda line: (line[0] * line[1], line[0]))
    return lines(["length", "velocity of each plate", "length times velocity"], SHAPE,
                 [([f"{length:g}", f"{velocity:g}", f"{length * velocity:.3g}"], rows) for length, velocity, rows in chosen])


# ---- beside the paper


def weighted(rows, of, error=None):
    """Mean of the packings, weighted by their events, their standard deviation and the error of the mean, not below that of the fits."""
    some = [(of(row), number(row, "events_0.0001"), number(row, error) if error else math.nan) for row in rows]
    some = [one for one in some if math.isfinite(one[0])]
    total = sum(weight for _, weight, _ in some)
    mean = sum(x * weight for x, weight, _ in some) / total
    own = math.sqrt(sum((weight * e)**2 for _, weight, e in some if math.isfinite(e))) / total
    if len(some) < 2:
        return mean, math.nan, own
    deviation = math.sqrt(sum(weight * (x - mean)**2 for x, weight, _ in some) / total * len(some) / (len(some) - 1))
    return mean, deviation, max(own, deviation * math.sqrt(sum(weight**2 for _, weight, _ in some)) / total)


def verdict(groups, of, low, high, error=None):
    """Are the means of all groups between these, within two of their standard errors?"""
    off = []
    for name, rows in groups.items():
        mean, _, slack = weighted(rows, of, error)
        if not low - 2 * slack <= mean <= high + 2 * slack:
            off.append(name)
    return "predicted, agrees" if not off else "predicted, **differs**" + ("" if len(off) == len(groups) else f" at {'; '.join(off)}")


def slider_rows():
    """Settings of the block-slider nearest to the paper over all lengths, as calibrate.slider_table() has them."""
    groups = {}
    for row in calibrate.read(SLIDERS):
        if float(row["dt"]) >= 0.005:
            groups.setdefault(tuple(row[key] for key in calibrate.SLIDER_KEYS), []).append(row)
    nearest = min(groups.values(), key=lambda rows: sum(calibrate.distance(row, calibrate.SLIDER_STATEMENTS)**2 for row in rows))
    return sorted(nearest, key=lambda row: int(row["blocks"]))


def paper_table():
    tolerance = {name: bound for name, _, _, _, bound in calibrate.STATEMENTS}
    every, long = grouped(longest()), grouped(full_length())
    groups = {(f"{length}, other packings" if length in USED else length): rows for length, rows, was in by_use(longest()) if not was}

    def of(key):
        return lambda row: number(row, key)

    def with_deviation(rows, of, digits=2):
        mean, deviation, _ = weighted(rows, of)
        return f"{mean:.{digits}f}" + (f" ± {deviation:.{digits}f}" if math.isfinite(deviation) else "")

    def by_length(groups, of, digits=2, end=""):
        return "; ".join(f"{length}: {with_deviation(rows, of, digits)}{end}" for length, rows in groups.items())

    def falling(row):
        return 100 * number(row, "in_events")

    def apart(row):
        return number(row, "mean_time_0.0001") / MEMORY

    def predicted(text, printed, groups, key, error, name):
        target = PAPER[name]
        return [text, printed, by_length(groups, of(key)), verdict(groups, of(key), target - tolerance[name], target + tolerance[name], error)]

    exponent, gamma = "exponent_1e-4:1e-1", "gamma_0.0001"
    largest = [statistics.mean(values(rows, "largest")) for rows in long.values()]
    out = []
    for length, used in ((length, rows) for length, rows, was in by_use(longest()) if was):
        out += [[f"fault of {length}: {text}", printed, shown, "used to calibrate"]
                for text, printed, shown in (("exponent >= 1e-4 over three decades", "1.07", with_deviation(used, of(exponent))),
                                             ("gamma of the inter-event times >= 1e-4", "0.995", with_deviation(used, of(gamma))),
                                             ("time from one event to the next, in memories of the picker (100 steps)", "12.5 to 100",
                                              with_deviation(used, apart, 0)), ("PE falls in less than a third of the time (stick-slip)", "yes",
                                                                                with_deviation(used, falling, 0) + " % of the time"))]
    out += [
        ["speed of P-waves", "2.1", f"{calibrate.WAVE_SPEED['r2']:g}", "used to calibrate"],
        predicted("others: exponent >= 1e-4", "1.07 at all lengths", groups, exponent, "error_1e-4:1e-1", "exponent"),
        [
            "others: deviation from 1.07 in each of these decades (root mean square)", "0 (tolerance 0.3)",
            by_length(groups, calibrate.decades),
            verdict(groups, calibrate.decades, 0.0, 0.3)
        ],
        predicted("others: exponent 1e-3 to 0.1", "1.07 at all lengths", groups, "exponent_1e-3:1e-1", "error_1e-3:1e-1", "exponent"),
        predicted("others: gamma >= 1e-4", "0.995 at all lengths", groups, gamma, "gamma_error_0.0001", "gamma"),
        predicted("gamma >= 1e-3", "0.995 at all lengths, if events begin there", every, "gamma_0.001", "gamma_error_0.001", "gamma"),
        ["others: memories of the picker from one event to the next", "12.5 to 100",
         by_length(groups, apart, 0),
         verdict(groups, apart, 12.5, 100)],
        [
            "roll-off recedes with the length: largest event in 1.4e5 time units", "yes",
            "; ".join(f"{length}: {cell('largest')(rows)}" for length, rows in long.items()),
            "predicted, " + ("agrees" if all(a < b for a, b in zip(largest, largest[1:])) else "**differs**")
        ],
        [
            "others: PE falls in less than a third of the time", "yes",
            by_length(groups, falling, 0, " %"),
            verdict(groups, falling, 0.0, 100 * (0.33 + tolerance["stick-slip"]))
        ],
    ]
    rows = slider_rows()
    texts = (("events in 1e7 steps", "3000 to 5000"), ("exponent below size 1", "0.5"), ("exponent above", "1.0"), ("gamma", "0.0"), ("B", "100"),
             ("C", "0.25"))
    for n, ((text, printed), (_, _, of_row, _, _)) in enumerate(zip(texts, calibrate.SLIDER_STATEMENTS)):
        met = sum(calibrate.deviations(row, calibrate.SLIDER_STATEMENTS)[n] <= 1.0 for row in rows)
        found = ", ".join("-" if math.isnan(of_row(row)) else calibrate.short(of_row(row)) for row in rows)
        out.append([
            f"block-slider: {text}", printed, found + (f" ({rows[0]['scheme']}, time step {rows[0]['dt']})" if n == 0 else ""),
            "agrees" if met == len(rows) else f"agrees at {met} of {len(rows)} lengths" if met else "**differs**"
        ])
    return table(["", "paper", "here (mean and standard deviation between packings, weighted by events)", ""], out)


def words_table():
    """What the paper says about its fault in words: mean and standard deviation of the packings, and in how many it holds."""
    rows = [row for row in calibrate.read(PACKING / "statements.csv") if row["run"].startswith("fault")]
    lengths, out = sorted({row["length"] for row in rows}, key=float), {}
    for row in rows:
        out.setdefault((row["statement"], row["number"], row["expected"]), {}).setdefault(row["length"], []).append(row)

    def text(some):
        judged, numbers = [row["verdict"] for row in some if row["verdict"]], values(some, "value")
        digits = max(0, 2 - math.floor(math.log10(abs(statistics.mean(numbers))))) if any(numbers) else 2
        return spread(numbers, digits) + (f"; holds in {judged.count('holds')} of {len(judged)}" if judged else "")

    return table(["statement", "", "expected", *lengths],
                 [[*key, *(text(found[length]) if length in found else "-" for length in lengths)] for key, found in out.items()])


# ---- beside nature, from tables of studies


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
    return brief(number(row, key), number(row, f"{key}_error"))


def size_text(label, size):
    return f"M >= {math.log10(float(size)) / 1.5:.3g}" if label == "Southern California" else f">= {float(size):g}"


def ranking():
    """Earthquakes, and of each model the smallest size that is nearest to them."""
    seen, out = set(), []
    for row in calibrate.read(FOLDER / "nature.table.csv"):
        if row["label"] in seen:
            continue
        seen |= {row["label"]} - {"Southern California"}
        out.append([
            f"{row['label']}, {size_text(row['label'], row['threshold'])}", f"{row['catalogues']}, {row['events']}",
            *(measured(row, key) for key in ("distance", "gamma", "burstiness", "memory", "after", "b"))
        ])
    return table(["times ranked by distance", "catalogues, events", "distance", "gamma", "burstiness", "memory", "after large", "b"], out)


TABLE1 = (("Southern California", "1000"), ("fault 120", "0.0001"), ("fault 1440", "0.0001"), ("slider 1928", "1"))


def table1():
    """The paper's Table 1, its columns and four of ours."""
    rows = calibrate.read(FOLDER / "nature.table1.csv")
    printed, ours = [row for row in rows if row["origin"] == "printed"], []
    for label, size in TABLE1:
        both = [row for row in rows if (row["source"], row["threshold"]) == (label, size)]
        ours.append(next((row for row in both if not row["degenerate"]), both[-1]))
    return table(
        ["", *(row["source"] for row in printed), *(f"{row['source']}, {size_text(row['source'], row['threshold'])}" for row in ours)],
        [[key, *(row[key] for row in printed), *("1 (held)" if key == "delta" and "held" in row["method"] else measured(row, key) for row in ours)]
         for key in ("gamma", "delta", "B", "C")])


LAWS = {
    "coulomb": "Coulomb, 0.6", "static": "static 0.7 above 0.6", "slip-weakening": "slip weakening, 0.7 to 0.6, heals in 5",
    "velocity-weakening": "velocity weakening, vc 0.1", "slip-law": "rate and state, slip law", "ageing": "rate and state, ageing",
    "default-coulomb": "Coulomb, present default", "default-ageing": "ageing, present default"
}


def over_packings(key, digits=2):
    """Mean over the packings; its error from their scatter, and not below that of their own errors."""

    def text(rows):
        some = [(number(row, key), number(row, f"{key}_error")) for row in rows if row[key]]
        if len(some) < 2:
            return brief(*(some[0] if some else (math.nan,)), digits=digits)
        own = math.sqrt(sum(error**2 for _, error in some if error > 0)) / len(some)
        return brief(statistics.mean(x for x, _ in some), max(own, statistics.stdev(x for x, _ in some) / math.sqrt(len(some))), digits)

    return text


def laws():
    """Each law over its packings, p of each of them."""
    runs = calibrate.read(FOLDER / "laws.csv")
    columns = [
        ("packings, events", lambda rows: f"{len(rows)}, {sum(int(row['events']) for row in rows)}"),
        *((name, over_packings(key, 1))
          for name, key in (("saw-tooth", "saw_tooth"), *((key, key) for key in ("exponent", "gamma", "burstiness", "memory")))),
        *((f"before, after, {name}", lambda rows, part=part: f"{over_packings(f'before_{part}')(rows)}, {over_packings(f'after_{part}')(rows)}")
          for name, part in (("to 300", "near"), ("300 to 3e4", "far"))),
        ("aftershocks", lambda rows: ", ".join(row["aftershocks"] or "0" for row in rows)),
        ("Omori p", lambda rows: ", ".join(measured(row, "omori_p") if row["omori_p"] else "none" for row in rows)),
        ("distance", over_packings("distance"))
    ]
    return lines(["law"], columns, [([text], [row for row in runs if row["run"].rsplit("_", 1)[0] == name]) for name, text in LAWS.items()])


def rupture_packing_table():
    """TPV3 in the random packing beside the boundary integral, from the stations of all packings."""

    def rms(numbers):
        return math.sqrt(statistics.fmean(x * x for x in numbers))

    spacings, out = {}, []
    for row in calibrate.read(FOLDER / "rupture_packing-stations.csv"):
        _, spacing, seed = row["run"].split(".")  # p.SPACING.SEED
        spacings.setdefault(int(spacing), {}).setdefault(seed, []).append(
            {key: float(row[key])
             for key in ("x", "arrival", "reference_arrival", "end_slip", "reference_end_slip")})
    for spacing, packed in sorted(spacings.items(), reverse=True):
        late = [rms(at["arrival"] - at["reference_arrival"] for at in stations) for stations in packed.values()]
        at_place = zip(*(sorted((at["x"], at["arrival"]) for at in stations) for stations in packed.values()))
        scattered = math.sqrt(statistics.fmean(statistics.variance(arrival for _, arrival in place) for place in at_place))
        slip = [100 * (at["end_slip"] / at["reference_end_slip"] - 1) for stations in packed.values() for at in stations if abs(at["x"]) <= 12000]
        arrivals = [{at["x"]: at["arrival"] for at in stations} for stations in packed.values()]
        fast = sum(9000 / (arrival[side * 12000] - arrival[side * 3000]) > 3464 for arrival in arrivals for side in (-1, 1))
        out.append([
            f"{spacing} m ({1.374 * spacing:.0f} m)",
            str(len(packed)), " to ".join(dict.fromkeys(f"{t:.2f}" for t in (min(late), max(late)))), f"{scattered:.2f}",
            f"{fast} of {2 * len(packed)}", f"{rms(slip):.1f}; {statistics.fmean(slip):.1f}"
        ])
    return table([
        "spacing (largest radius)", "packings", "arrival, rms of each (s)", "scatter between packings (s)",
        "fronts faster than S-waves from 3 to 12 km", "slip, rms; mean (%)"
    ], out)


# ---- speed


@functools.cache
def timings(name):
    """Wall and CPU ns for a particle and step, parts and memory of the rounds of each (label, length, ranks)."""
    out = {}
    for row in calibrate.read(FOLDER / "speed/timings.csv"):
        if row["table"] == name:
            per = 1e9 / float(row["atoms"]) / float(row["steps"])
            one = {key: float(row[key] or 0) * per for key in ("seconds", "pair", "bond", "neigh", "comm", "modify")}
            one |= {
                "cpu": one["seconds"] * float(row["cpu_percent"] or 100) / 100, "atoms": float(row["atoms"]),
                "bytes": float(row["resident"] or 0) * 1024 / float(row["atoms"])
            }
            out.setdefault((row["label"], int(row["length"]), int(row["ranks"])), {})[row["round"]] = one
    return out


def middle(rounds, key="seconds"):
    return statistics.median(row[key] for row in rounds.values())


def ratio_of(rounds, base):
    """Median over the rounds of the ratio within each."""
    return statistics.median(row["seconds"] / base[number]["seconds"] for number, row in rounds.items() if number in base)


def speed_peers_table():
    found, out = {(label, ranks): rounds for (label, _, ranks), rounds in timings("peers").items()}, []
    for label in dict.fromkeys(label for label, _ in found):
        row = [label]
        for ranks in (1, 2):
            at, ours = found.get((label, ranks)), found["ours", ranks]
            row += [f"{1e3 / middle(at):.3g}", "" if at is ours else f"{ratio_of(at, ours):.3g}"] if at else ["", ""]
            last = at or last
        out.append(row + [f"{middle(last, 'bytes'):.0f}"])
    return table([
        "PE at every step, length 1890", "million particle-steps/s, 1 rank", "ours is faster", "2 ranks", "ours is faster",
        "bytes for a particle, most ranks"
    ], out)


def speed_lengths_table():
    found = {key[1:]: rounds for key, rounds in timings("lengths").items()}
    return table(["length", "particles", "ns, 1 rank", "2 ranks", "links", "contacts", "integration, plates, events", "communication", "lists"], [[
        str(length), f"{middle(found[length, 2], 'atoms'):.0f}", *(f"{middle(found[length, ranks]):.1f}"
                                                                   for ranks in (1, 2)), *(f"{middle(found[length, 2], key):.2f}"
                                                                                           for key in ("bond", "pair", "modify", "comm", "neigh"))
    ] for length in sorted({one
                            for one, _ in found})])


def speed_changes_table():
    names = {key[0]: rounds for key, rounds in timings("features").items()}
    ratio = {label: f"{ratio_of(rounds, names['base of ' + label]):.2f}" for label, rounds in names.items() if "base of " + label in names}
    changes = [["contacts of all discs"], ["nothing recorded", "location of events", "energy ledger"],
               ["static friction above dynamic", "slip weakening", "velocity weakening"],
               ["rate and state (ageing)", "rate and state (slip)", "no friction (lsm/free)"],
               ["links that can break", "no viscosity", "dashpots of links and contacts"],
               ["pressure every 100 steps", "pressure every step", "all lists rebuilt every 100 steps"]]
    return table(["one thing changed, length 1890, 2 ranks", "time of a step, ratio"],
                 [["; ".join(change), "; ".join(ratio[label] for label in change)] for change in changes])


def speed_slices_table():
    """What 1.2e6 steps of each fault of the campaign take, from slices of them."""
    found = {key[1:]: rounds for key, rounds in timings("campaign").items()}
    seconds = {key: middle(rounds) * 1e-9 * middle(rounds, "atoms") * 1.2e6 for key, rounds in found.items()}
    out = [[str(length), *(text for ranks in (1, 2) for text in (f"{middle(found[length, ranks]):.1f}", f"{seconds[length, ranks]:.0f}"))]
           for length in sorted({one
                                 for one, _ in found})]
    hours = [f"{sum(time for (_, ranks), time in seconds.items() if ranks == number) / 3600:.2f} h" for number in (1, 2)]
    return table(["length", "ns, 1 rank", "s for 1.2e6 steps", "ns, 2 ranks", "s for 1.2e6 steps"], [*out, ["all six", "", hours[0], "", hours[1]]])


TABLES = {
    "paper": paper_table,
    "words": words_table,
    "statements": lambda: calibrate.statements_table(POINTS),
    "pairs": lambda: calibrate.pairs_table(POINTS),
    "ranges": lambda: calibrate.ranges_table(POINTS),
    "accepted": lambda: calibrate.accepted_table(POINTS),
    "ringing": lambda: calibrate.ringing_table(POINTS),
    "lines": lambda: calibrate.lines_table(POINTS),
    "twice": lambda: calibrate.twice_table(POINTS),
    "sliders": lambda: calibrate.slider_table(SLIDERS),
    "ground": ground_table,
    "random": lambda: sizes_and_times(random_packings()),
    "random-drops": lambda: drops(found(PACKING, "fault_*.catalogue.csv.xz")),
    "random-decades": lambda: decades_table(random_packings()),
    "campaign": lambda: sizes_and_times(full_length()),
    "packings": lambda: sizes_and_times(packings()),
    "decades": decades_table,
    "steady": steady_table,
    "validation": validation_table,
    "thresholds": thresholds_table,
    "collapse": collapse_table,
    "drops": lambda: drops(found(CAMPAIGN, "fault_*[0-9]_[0-9].catalogue.csv.xz")),
    "ruptures-long": lambda: single_ruptures(found(CAMPAIGN, "fault_*.ruptures.csv.xz"), LOADING),
    "widths": widths_table,
    "steps": steps_table,
    "picker-steps": picker_steps_table,
    "superposition": superposition_table,
    "gaps": gaps_table,
    "loading": loading_table,
    "remedies": remedies_table,
    "laws": laws,
    "ranking": ranking,
    "table1": table1,
    "rupture-packing": rupture_packing_table,
    "speed-peers": speed_peers_table,
    "speed-lengths": speed_lengths_table,
    "speed-changes": speed_changes_table,
    "speed-causes": lambda: table(["why a step of a run takes longer, length 480, one rank", "CPU ns"],
                                  [[key[0], f"{middle(rounds, 'cpu'):.1f}"] for key, rounds in timings("causes").items()]),
    "speed-slices": speed_slices_table,
    # Of the choices before the calibration; nothing else reads their catalogues.
    "campaign-before": lambda: sizes_and_times(rows_of(found(FOLDER, "catalogues/fault_[0-9]*.catalogue.csv.xz"))),
    "drops-before": lambda: drops(found(FOLDER, "catalogues/fault_[0-9]*.catalogue.csv.xz")),
    "ruptures-before": lambda: single_ruptures(found(FOLDER, "catalogues/fault_ruptures_*.catalogue.csv.xz"), 6000),
    "rupture-laws-before": lambda: rupture_laws(
        [path for path in found(FOLDER, "catalogues/fault_ruptures_*.catalogue.csv.xz") if "seed" not in path.name]),
}


def check(write):
    wrong = 0
    for page in sorted(FOLDER.glob("*.md")) + [FOLDER.parent / "README.md"]:
        text = page.read_text()

        def replace(match):
            if match[1] not in TABLES:
                sys.exit(f"{page.name}: table {match[1]}, expected one of {', '.join(TABLES)}")
            try:
                return f"<!-- table {match[1]} -->\n\n{TABLES[match[1]]()}\n\n<!-- end -->"
            except (ValueError, OSError) as error:  # of statistics as well, for want of events
                sys.exit(f"tables.py: {page.name}: table {match[1]}: {error}")

        new = re.sub(r"<!-- table (\S+) -->.*?<!-- end -->", replace, text, flags=re.S)
        if write and new != text:
            page.write_text(new)
        elif new != text:
            wrong = 1
            print("\n".join(difflib.unified_diff(text.splitlines(), new.splitlines(), page.name, "from the catalogues", lineterm="")))
    return wrong


# ---- figures


def length_figure(base):
    """gamma, exponent and share of brief events against length times velocity: faults, sums, other velocities."""

    def points(key, scale, groups):
        for n, members in enumerate(groups):
            yield f"$d{n} << EOD\n"
            for x, rows in members:
                some = [scale * value for value in values(rows, key)]
                if some:
                    yield f"{x * 1.03 ** (n - 1):.6g} {statistics.mean(some):.6g} {statistics.stdev(some) if len(some) > 1 else 0:.6g}\n"
            yield "nan nan nan\nEOD\n"

    sums = {float(length) for length in (path.name.split("_")[1] for path in found(SUPERPOSED, "sum_*.xz"))}
    groups = [[(float(length) * VELOCITY, rows) for length, rows in grouped(packings()).items()],
              [(length * velocity, rows) for length, velocity, rows in other_velocities()],
              [(length * VELOCITY, rows_of(found(SUPERPOSED, f"sum_{length:g}_*.xz"), begin=0)) for length in sorted(sums)]]
    looks = ("pt 7 ps 1.2 lw 1.5 lc rgb '#0072b2' title 'faults, plates at 2.5e-4'",
             "pt 5 ps 1.2 lw 1.5 lc rgb '#d55e00' title 'faults, plates at other velocities'",
             "pt 6 ps 1.2 lw 1.5 lc rgb '#999999' title 'PE of faults of 120 added up'")
    script = "set multiplot layout 1,3\nset tics nomirror\nset border 3\nset logscale x\nset xlabel 'length times velocity'\n" \
             "set xrange [0.02:0.7]\nset xtics (0.03, 0.06, 0.12, 0.24, 0.48)\nset key bottom left Left reverse samplen 1\n"
    for label, key, of_paper, scale, span in (("gamma >= 1e-4", "gamma_0.0001", PAPER["gamma"], 1,
                                               "[0:1.2]"), ("exponent, 1e-4 to 0.1", "exponent_1e-4:1e-1", PAPER["exponent"], 1, "[0.8:1.4]"),
                                              ("events of 3 steps or less, %", "brief", None, 100, "[0:20]")):
        plots = [f"$d{n} with yerrorbars {look}"
                 for n, look in enumerate(looks)] + [f"{of_paper} with lines dt 2 lc rgb 'black' title 'paper'"] * (of_paper is not None)
        script += "".join(points(key, scale, groups)) + f"set ylabel '{label}'\nset yrange {span}\nplot " + ", ".join(plots) + "\nunset key\n"
    for head in (f"set terminal pngcairo size 1500,480 font 'DejaVu Sans,13'\nset output '{base}.png'\n",
                 f"set terminal svg size 1200,400 font 'DejaVu Sans,11'\nset output '{base}.svg'\n"):
        subprocess.run(["gnuplot"], input=head + script + "unset multiplot\n", text=True, check=True)


def figures():
    one_each = [path for path in found(CAMPAIGN, "fault_*[0-9]_1.catalogue.csv.xz")]
    common = [*map(str, one_each), "--from", str(LOADING), "--threshold", "1e-4"]
    subprocess.run([POSTPROC, "histograms", *common, "--guide=-1.07:1e-4:0.1", "-o", FOLDER / "fig12_fault_sizes"], check=True)
    subprocess.run([POSTPROC, "intervals", *common, "--delta", "1", "--shortest", "0", "--shuffles", "0", "-o", FOLDER / "fig14_fault_intervals"],
                   check=True)
    for name in ("fig12_fault_sizes.svg", "fig14_fault_intervals.svg", "fig14_fault_intervals.clustering.csv"):
        (FOLDER / name).unlink(missing_ok=True)
    length_figure(FOLDER / "gamma-length")
    calibrate.figure(POINTS, FOLDER / "calibration")
    return 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--write"], ["--figures"]):
        sys.exit(__doc__)
    POSTPROC = sys.argv[1]
    sys.exit(figures() if sys.argv[2:] == ["--figures"] else check(len(sys.argv) == 3))
