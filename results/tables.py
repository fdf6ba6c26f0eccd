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
import math
import re
import statistics
import sys
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER.parent / "python"), str(FOLDER.parent / "inputs"), str(FOLDER / "speed")]
import faults as article  # noqa: E402
import index  # noqa: E402
import lsm  # noqa: E402
import nature  # noqa: E402
import page_values  # noqa: E402
import periods  # noqa: E402
import sources  # noqa: E402
import speed_tables  # noqa: E402
import validation_tables  # noqa: E402
import values  # noqa: E402
import walk  # noqa: E402
from lsm import LOADING, analysis, paper  # noqa: E402
from lsm.tables import number, read, text_of  # noqa: E402
from variables import declared, defaults  # noqa: E402

POSTPROC = "postproc"  # the program, set by main()
SLIDERS = FOLDER / "calibration/sliders.csv.xz"
CAMPAIGN, VALIDATION = FOLDER / "campaign", FOLDER / "validation"

# ---- catalogues


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


# ---- the fault


def tolerance_of(statement):
    return f"a factor of {math.exp(statement.tolerance):.3g}" if statement.log else f"{statement.tolerance:.2g}"


def agreement_table():
    """The first numbers of the README."""
    columns = {"drops >= 1e-4 in 1000 time units": ("rate.drops.{}.0.0001", "()"), "slips >= 0.1 (ours)": ("rate.slips.{}.0.1", "()")}
    columns |= {"exponent": ("exponent.all.{}", "()"), "gamma": ("gamma.all.{}", "()"), "B": ("B.all.{}", "()")}
    rows = [f"{fault}.{length}" for fault in article.FAULTS for length in (120, 480, 1890)]
    head, line, *rest = keyed_table("fault, length", rows, columns).split("\n")
    found = values.read()
    packings = [f"{found[f'exponent.all.{row}'].n}, {article.FITTED.get(row, 0)} |" for row in rows]
    lines = [head + " packings, of which fitted |", line + "---|", f"| paper, all lengths | {article.PAPER:.0f} |  | 1.07 | 0.995 | 15.2 |  |"]
    return "\n".join(lines + [f"{cells} {packing}" for cells, packing in zip(rest, packings)])


def widths_table():
    """Ruptures in blocks of several widths, once they are loaded."""
    found = {}
    for folder in CAMPAIGN, VALIDATION:
        for path in (path for length, paths in faults("ruptures", folder).items() if length <= 480 for path in paths):
            header = lsm.read_catalogue(path).header
            if header["dt"] == "0.12":
                size = analysis.events_of(path, loaded(path))["size"]
                size = size[size >= 1e-2]
                found.setdefault((float(header["width"]), float(header["length"])), []).append((len(size), np.sum(size**2) / np.sum(size)))
    return table(["length, width", "packings", "ruptures >= 0.01", "characteristic size"],
                 [[f"{length:g}, {width:g}", f"{len(some)}", *(spread([float(x) for x in one]) for one in zip(*some))]
                  for (width, length), some in sorted(found.items())])


# ---- calibration


def statements_table():
    """Tolerances, and what points of the calibration and samples of its posterior meet."""
    found = {row["statement"]: row for row in read(FOLDER / "calibration.statements.csv")}
    rows = page_values.calibrated()

    def shares(row, length):
        return f"{100 * number(row, f'prior_{length}'):.0f}, {100 * number(row, f'posterior_{length}'):.0f}" if row.get(f"prior_{length}") else "-"

    head = ["what the paper says, or † we ask", "tolerance", f"met by, of {len(rows)} points", "% of prior, posterior at 120", "at 480"]
    return table(head, [[
        one.text,
        tolerance_of(one),
        str(sum(one.deviation(row) <= 1 for row in rows)), *(shares(found[one.name], length) for length in ("120", "480"))
    ] for one in paper.STATEMENTS])


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
    """Periodicity of the faces, and of the events, with seeds on a grid and at random places."""
    places, now = {}, faults()
    for row in read(FOLDER / "packing/faces.csv.xz"):
        places.setdefault((row["seeds"], row["length"]), {}).setdefault((row["packing"], row["side"]), []).append(float(row["x"]))

    def factors(seeds, length):
        k = 2 * math.pi * 2 * math.floor(float(length) / 2) / float(length)  # at half the spacing of the grid, rounded to fit in
        return ", ".join(f"{abs(sum(cmath.exp(1j * k * x) for x in face))**2 / len(face):.1f}" for face in places[seeds, length].values())

    def z(paths):
        return ", ".join(f"{periods.rayleigh_z(*periods.slips_of(path, LOADING, 1e-2), 1.0):.1f}" for path in paths)

    columns = {
        "length": lambda row: row["length"],
        "structure factor of the faces, grid": lambda row: factors("grid", row["length"]),
        "random places": lambda row: factors("random", row["length"]),
        "Z at a slip of 1, grid": lambda row: row["z"],
        "Z, random places": lambda row: z(now.get(int(row["length"]), [])),
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


def default_fault_table():
    """The default fault at packings to which nothing was fitted."""
    rows = sorted((key.removeprefix("run.exponent.leaky.") for key in values.read() if key.startswith("run.exponent.leaky.")),
                  key=lambda row: [int(number) for number in row.split(".")])
    columns = {key if key != "mean_time" else "one drop in": (f"run.{key}.leaky.{{}}", "()") for key in ("exponent", "gamma", "B", "mean_time")}
    return keyed_table("length, packing", rows, columns)


def threshold_table():
    """Ruptures >= 0.01 with other thresholds, at length 120."""
    columns = {
        f"{slipping} plate velocities, interval {0.6 * merged:g}": (f"ruptures.test.{{}}.{slipping}.{merged}.rate_0.01", "()")
        for slipping, merged in article.TESTS
    }
    return keyed_table("fault", article.FAULTS, columns)


def variants_table():
    """Length 120 with other time steps and widths."""
    rows, columns = sorted(read(article.VARIANTS), key=lambda row: article.FAULTS.index(row["fault"])), {"": lambda row: row["fault"]}
    columns |= {"packing": lambda row: row["packing"], "time step": lambda row: row["dt"], "width": lambda row: row["width"]}
    names = {"drops": "drops >= 1e-4", "slips": "slips >= 0.1", "ruptures": "ruptures >= 0.01", "exponent": "exponent", "gamma": "gamma", "B": "B"}
    for key, name in names.items():
        columns[name] = lambda row, key=key: values.text_of(float(row[key]), float(row[f"{key}_error"] or "nan"), "()")
    return study_table("", columns, rows)


def beside_table():
    """The three faults beside each other, at the shortest length."""
    columns = {"drops >= 1e-4": ("rate.drops.{}.120.0.0001", "()"), "slips >= 0.1 †": ("rate.slips.{}.120.0.1", "()")}
    columns |= {f"ruptures >= {size} †": (f"ruptures.rate.{{}}.120.{size}", "()") for size in ("0.001", "0.01", "0.1")}
    columns |= {"work of friction": ("budget.work.{}.120", "()"), "of it in slips >= 0.1, %": ("budget.share.{}.120", "%()")}
    return keyed_table("length 120, in 1000 time units", article.FAULTS, columns)


def three_faults_table():
    """Values in which the faults differ."""
    found = {fault: defaults(fault) for fault in article.FAULTS}
    names = [one for one in declared() if len({values[one.name] for values in found.values()}) > 1 and one.name not in ("steps", "preset")]
    meaning = {"dt": "time step", "stress": "normal stress", "kt": "tangential stiffness of contacts", "impedance": "impedance of the plates"}
    meaning |= {"viscosity": "viscosity", "retardation": "retardation time of links", "memory": "memory of the picker"}
    return table(["value", *article.FAULTS],
                 [[f"{meaning.get(one.name, one.name)} (`{one.name}`)", *(f"{float(values[one.name]):g}" for values in found.values())]
                  for one in names])


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
TABLES |= {"walk": lambda: table(*walk.table(shown)), "index": lambda: table(*index.keys_table()), "files": lambda: table(*index.files_table())}

NEW_FORM = ("article", "validation", "beyond", "methods", "speed")


def check(write):
    unsaid, keyed = index.wrong(), values.read()
    wrong = int(bool(unsaid))
    print("\n".join(unsaid), end="\n" * wrong)
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
    """The numbers of sentences, files of faults.py, sources.py and nature.py, and stations of the walk with all their seeds."""
    wrong = [differing(values.TABLE, values.rows(all_values()))]
    for name, made in (("rates", article.rates), ("estimators", article.estimators), ("ruptures", article.rupture_rows), ("sources", sources.bins)):
        wrong.append(differing(FOLDER / f"{name}.csv", list(made())))
    rows = nature.published(POSTPROC)
    wrong += [differing(FOLDER / f"nature{ending}.csv", made) for ending, made in (("", nature.curves(rows)), (".table", nature.table(rows)))]
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
