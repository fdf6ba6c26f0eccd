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
import difflib
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


# ---- cells


def turned(head, rows):
    """The same table with a column for each of these rows."""
    head, *rows = zip(head, *rows)
    return head, rows


def shown(value, error=math.nan):
    """A value as 0.667 ± 0.021. The error has one digit, or two if it begins with less than 3.5; without an error there are three."""
    if value is None or not math.isfinite(value):
        return "-"
    places = max(0, values.digits(value, error))
    return f"{value:.{places}f} ± {error:.{places}f}" if error > 0 else f"{value:.{min(4, places)}f}"


def spread(values, error=math.nan):
    """Mean and standard deviation between packings; two numbers as they are, as two show no deviation; of one its own error, if given."""
    values = [x for x in values if x is not None and math.isfinite(x)]
    if len(values) == 2:
        return ", ".join(map(shown, values))
    return shown(statistics.mean(values), statistics.stdev(values) if len(values) > 1 else error) if values else "-"


def of(row, key):
    """A number with its error, which is in another column of the row."""
    return shown(number(row, key), number(row, f"{key}_error"))


def rms(numbers):
    return math.sqrt(statistics.fmean(x * x for x in numbers))


# ---- tables, as head and rows: of the rows of a file, and of numbers of values.csv


def rows_table(rows, columns):
    """columns: {head: function of a row, or the key of a number}"""
    rows = read(FOLDER / rows) if isinstance(rows, str) else rows
    return list(columns), [[of(row, cell) if isinstance(cell, str) else cell(row) for cell in columns.values()] for row in rows]


def keyed_table(head, rows, columns):
    """A row for each of these texts, which are put into the keys; those without any number are left out. columns: {head: "KEY FORM", as in pages}"""
    found = values.read()

    def cell(row, key, form):
        one = found.get(key.format(row))
        return values.text_of(one.value, one.error, form) if one else "-"

    cells = {row: [cell(row, *column.split()) for column in columns.values()] for row in rows}
    return [head, *columns], [[row.replace(".", ", ", 1), *some] for row, some in cells.items() if set(some) != {"-"}]


def text_in(key):
    return lambda row: row[key]


# ---- the fault


def agreement():
    rows = [f"{fault}.{length}" for fault in article.FAULTS for length in (120, 480, 1890)]
    head, cells = keyed_table(
        "fault, length", rows, {
            "drops >= 1e-4 in 1000 time units": "rate.drops.{}.0.0001 ()", "slips >= 0.1 (ours)": "rate.slips.{}.0.1 ()",
            "exponent": "exponent.all.{} ()", "gamma": "gamma.all.{} ()", "B": "B.all.{} ()"
        })
    found = values.read()
    packings = [f"{found[f'exponent.all.{row}'].n}, {article.FITTED.get(row, 0)}" for row in rows]
    paper_says = ["paper, all lengths", f"{article.PAPER:.0f}", "", "1.07", "0.995", "15.2", ""]
    return [*head, "packings, of which fitted"], [paper_says, *([*row, some] for row, some in zip(cells, packings))]


def widths():
    """Ruptures in blocks of several widths, once they are loaded."""
    found = {}
    for folder in CAMPAIGN, VALIDATION:
        for path in (path for length, paths in faults("ruptures", folder).items() if length <= 480 for path in paths):
            header = lsm.read_catalogue(path).header
            if header["dt"] == "0.12":
                size = analysis.events_of(path, LOADING * float(header["width"]) / 30)["size"]  # wider blocks are loaded later
                size = size[size >= 1e-2]
                found.setdefault((float(header["length"]), float(header["width"])), []).append((len(size), np.sum(size**2) / np.sum(size)))
    return ["length, width", "packings", "ruptures >= 0.01",
            "characteristic size"], [[f"{length:g}, {width:g}", f"{len(some)}", *(spread([float(x) for x in one]) for one in zip(*some))]
                                     for (length, width), some in sorted(found.items(), key=lambda one: one[0][::-1])]


# ---- calibration


def tolerance_of(statement):
    return f"a factor of {math.exp(statement.tolerance):.3g}" if statement.log else f"{statement.tolerance:.2g}"


def statements():
    """Tolerances, and what points of the calibration and samples of its posterior meet."""
    found, rows = {row["statement"]: row for row in read(FOLDER / "calibration.statements.csv")}, page_values.calibrated()

    def shares(one, length):
        row = found[one.name]
        return f"{100 * number(row, f'prior_{length}'):.0f}, {100 * number(row, f'posterior_{length}'):.0f}" if row.get(f"prior_{length}") else "-"

    return rows_table(
        paper.STATEMENTS, {
            "what the paper says, or † we ask": lambda one: one.text, "tolerance": tolerance_of,
            f"met by, of {len(rows)} points": lambda one: str(sum(one.deviation(row) <= 1 for row in rows)),
            "% of prior, posterior at 120": lambda one: shares(one, 120), "at 480": lambda one: shares(one, 480)
        })


def slider():
    """Of the settings of the block-slider that were tried, the one nearest to the paper over all lengths."""
    groups = grouped((row for row in read(SLIDERS) if float(row["dt"]) >= 0.005), lambda row: tuple(row[key] for key in paper.SLIDER_KEYS))
    key, rows = min(groups.items(), key=lambda one: sum(paper.distance(row, paper.SLIDER_STATEMENTS)**2 for row in one[1]))
    rows.sort(key=lambda row: int(row["blocks"]))
    fitted = f"fitted: the nearest of {len(groups)} settings ({key[0]} scheme, {key[2]} reading, time step {key[1]}, velocity {key[5]})"
    head, cells = rows_table(
        paper.SLIDER_STATEMENTS, {
            fitted: lambda one: one.name, "paper (our tolerance)": lambda one: f"{one.text} ({tolerance_of(one)})",
            "here": lambda one: ", ".join(shown(one.value(row)) for row in rows),
            "agrees at": lambda one: f"{sum(one.deviation(row) <= 1.0 for row in rows)} of {len(rows)} lengths"
        })
    return head, [["blocks", "", ", ".join(row["blocks"] for row in rows), ""], *cells]


def slider_velocity():
    """The block-slider over the velocity of its plate, at all lengths."""
    fixed = {"scheme": "printed", "dt": "0.01", "picker": "exponential", "picker-lambda": "0.99", "warmup": "0", "smallest": "0.0001"}
    rows = [row for row in read(SLIDERS) if fixed.items() <= row.items()]
    groups = grouped(sorted(rows, key=lambda row: (float(row["velocity"]), int(row["blocks"]))), text_in("velocity"))
    told = [one for one in paper.SLIDER_STATEMENTS if one.name != "large"]
    head = [f"velocity, each for {', '.join(map(text_in('blocks'), groups['0.01']))} blocks", *(one.name for one in told)]
    return head, [["paper", *(one.text for one in told)],
                  *([velocity, *(", ".join(shown(one.value(row)) for row in rows) for one in told)] for velocity, rows in groups.items())]


def ground():
    """Periodicity of the faces, and of the events, with seeds on a grid and at random places."""
    places, now = {}, faults()
    for row in read(FOLDER / "packing/faces.csv.xz"):
        places.setdefault((row["seeds"], row["length"]), {}).setdefault((row["packing"], row["side"]), []).append(float(row["x"]))

    def factors(seeds, length):
        k = 2 * math.pi * 2 * math.floor(float(length) / 2) / float(length)  # at half the spacing of the grid, rounded to fit in
        return ", ".join(f"{abs(np.exp(1j * k * np.array(face)).sum())**2 / len(face):.1f}" for face in places[seeds, length].values())

    def z(paths):
        return ", ".join(f"{periods.rayleigh_z(*periods.slips_of(path, LOADING, 1e-2), 1.0):.1f}" for path in paths)

    return turned(*rows_table(
        "packing/grid.csv", {
            "length": text_in("length"), "structure factor of the faces, grid": lambda row: factors("grid", row["length"]),
            "random places": lambda row: factors("random", row["length"]), "Z at a slip of 1, grid": text_in(
                "z"), "Z, random places": lambda row: z(now.get(int(row["length"]), []))
        }))


def rupture_packing():
    """TPV3 in the random packing compared with the boundary integral method, from the stations of all packings."""
    groups = {}
    for row in read(FOLDER / "rupture_packing-stations.csv"):
        _, spacing, seed = row["run"].split(".")  # p.SPACING.SEED
        groups.setdefault(int(spacing), {}).setdefault(seed, {})[float(row["x"])] = {key: float(row[key]) for key in list(row)[3:]}

    def late(packed):
        times = [rms(at["arrival"] - at["reference_arrival"] for at in stations.values()) for stations in packed]
        return " to ".join(dict.fromkeys(f"{t:.2f}" for t in (min(times), max(times))))

    def scatter(packed):
        return math.sqrt(statistics.fmean(statistics.variance(stations[x]["arrival"] for stations in packed) for x in packed[0]))

    def fast(packed):
        times = [stations[side * 12000]["arrival"] - stations[side * 3000]["arrival"] for stations in packed for side in (-1, 1)]
        return f"{sum(9000 / time > 3464 for time in times)} of {len(times)}"

    def slips(packed):
        slip = [100 * (at["end_slip"] / at["reference_end_slip"] - 1) for stations in packed for x, at in stations.items() if abs(x) <= 12000]
        return f"{rms(slip):.1f}; {statistics.fmean(slip):.1f}"

    return rows_table([(spacing, list(packed.values())) for spacing, packed in sorted(groups.items(), reverse=True)], {
        "spacing (largest radius)": lambda one: f"{one[0]} m ({1.374 * one[0]:.0f} m)", "packings": lambda one: str(len(one[1])),
        "arrival, rms of each (s)": lambda one: late(one[1]),
        "scatter between packings (s)": lambda one: f"{scatter(one[1]):.2f}",
        "fronts faster than S-waves from 3 to 12 km": lambda one: fast(one[1]), "slip, rms; mean (%)": lambda one: slips(one[1])
    })  # yapf: disable


# ---- the article


def default_fault():
    """The default fault at packings to which nothing was fitted."""
    rows = sorted((key.removeprefix("run.exponent.leaky.") for key in values.read() if key.startswith("run.exponent.leaky.")),
                  key=lambda row: [int(number) for number in row.split(".")])
    names = {"exponent": "exponent", "gamma": "gamma", "B": "B", "one drop in": "mean_time"}
    return keyed_table("length, packing", rows, {name: f"run.{key}.leaky.{{}} ()" for name, key in names.items()})


def variants():
    """Length 120 with other time steps and widths."""
    names = {"drops >= 1e-4": "drops", "slips >= 0.1": "slips", "ruptures >= 0.01": "ruptures", "exponent": "exponent", "gamma": "gamma", "B": "B"}
    columns = {"": text_in("fault"), "packing": text_in("packing"), "time step": text_in("dt"), "width": text_in("width")}
    columns |= {name: lambda row, key=key: values.text_of(float(row[key]), number(row, f"{key}_error"), "()") for name, key in names.items()}
    return rows_table(sorted(read(article.VARIANTS), key=lambda row: article.FAULTS.index(row["fault"])), columns)


def three_faults():
    """Values in which the faults differ."""
    meaning = {"dt": "time step", "stress": "normal stress", "kt": "tangential stiffness of contacts", "impedance": "impedance of the plates"}
    meaning |= {"viscosity": "viscosity", "retardation": "retardation time of links", "memory": "memory of the picker"}
    found = [defaults(fault) for fault in article.FAULTS]
    names = [one.name for one in declared() if len({values[one.name] for values in found}) > 1 and one.name not in ("steps", "preset")]
    return ["value",
            *article.FAULTS], [[f"{meaning.get(name, name)} (`{name}`)", *(f"{float(values[name]):g}" for values in found)] for name in names]


# ---- studies


def slow_driving():

    def per(row, *keys):
        return ", ".join(f"{18 * number(row, key) / number(row, 'displacement'):.0f}" for key in keys)

    return turned(*rows_table([row for row in read(FOLDER / "slow-driving.csv") if row["fast"] in ("", "2.5e-4")], {
        "velocity": lambda row: row["velocity"] + (", leaps" if row["fast"] else ""),
        "events >= 1e-3, 1e-2, 0.1": lambda row: per(row, "events_3", "events_2", "events_1"), "exponent 1e-3 to 1": "long", "1e-2 to 1": "from_2",
        "gamma >= 1e-3": "gamma", ">= 1e-2": "gamma_2",
        "events within 100 time units after, before a main shock": lambda row: f"{of(row, 'after_100')}, {of(row, 'before_100')}",
        "large events matched, by chance": lambda row: f"{row['same']} of {row['of']}, {of(row, 'chance')}" if row["same"] else "",
        "steps per large event": "steps_per_large"
    }))  # yapf: disable


def ranking():
    """Earthquakes, and for each model the smallest size with which it is nearest to them."""
    rows = {}
    for row in read(FOLDER / "nature.table.csv"):
        rows.setdefault((row["label"], row["threshold"] if row["label"] == nature.NATURE else ""), row)

    def named(row):
        size = float(row["threshold"])
        return f"{row['label']}, " + (f"M >= {math.log10(size) / 1.5:.3g}" if row["label"] == nature.NATURE else f">= {size:g}")

    def one_or_both(key):
        """A number, or those of two catalogues: their error is half of their difference."""

        def cell(row):
            value, half = number(row, key), number(row, f"{key}_error")
            return spread([value - half, value + half]) if row["catalogues"] == "2" and half > 0 else of(row, key)

        return cell

    return rows_table(rows.values(), {
        "": named, "catalogues, events": lambda row: f"{row['catalogues']}, {row['events']}", "distance": one_or_both("distance"),
        "gamma": one_or_both("gamma"), "after large events": one_or_both("after"), "b-value": one_or_both("b")
    })  # yapf: disable


def laws():
    """Each law over its packings."""

    def all_of(*keys):
        return lambda rows: ", ".join(spread([number(row, key) for row in rows]) for key in keys)

    return rows_table(grouped(read(FOLDER / "laws.csv"), lambda row: row["run"].rsplit("_", 1)[0]).values(), {
        "law": lambda rows: rows[0]["run"].rsplit("_", 1)[0], "exponent": all_of("exponent"), "gamma": all_of("gamma"), "distance": all_of("distance"),
        "events before, after a main shock, to 300": all_of("before_near", "after_near"),
        "events before, after a main shock, 300 to 3e4": all_of("before_far", "after_far")
    })  # yapf: disable


TABLES = speed_tables.TABLES | validation_tables.TABLES | {
    "agreement": agreement, "widths": widths, "statements": statements, "slider": slider, "slider-velocity": slider_velocity, "ground": ground,
    "rupture-packing": rupture_packing, "default-fault": default_fault, "variants": variants, "three-faults": three_faults,
    "slow-driving": slow_driving, "ranking": ranking, "laws": laws,
    "threshold": lambda: keyed_table("fault", article.FAULTS, {
        f"{slipping} plate velocities, interval {0.6 * merged:g}": f"ruptures.test.{{}}.{slipping}.{merged}.rate_0.01 ()"
        for slipping, merged in article.TESTS}),
    "beside": lambda: keyed_table("length 120, in 1000 time units", article.FAULTS, {
        "drops >= 1e-4": "rate.drops.{}.120.0.0001 ()", "slips >= 0.1 †": "rate.slips.{}.120.0.1 ()",
        **{f"ruptures >= {size} †": f"ruptures.rate.{{}}.120.{size} ()" for size in ("0.001", "0.01", "0.1")},
        "work of friction": "budget.work.{}.120 ()", "of it in slips >= 0.1, %": "budget.share.{}.120 %()"}),
    "bursts": lambda: keyed_table("fault, packing", [f"{row['fault']}.{row['packing']}" for row in read(article.BURSTS)], {
        "stretches with bursts": "burst.bursts.{} .0f", "of": "burst.stretches.{} .0f", "drops in them": "burst.rate_in_bursts.{} .0f",
        "elsewhere": "burst.rate_else.{} .0f", "gamma": "burst.gamma.{} .2f", "gamma without bursts": "burst.gamma_else.{} .2f",
        "exponent": "burst.exponent.{} .2f", "exponent without bursts": "burst.exponent_else.{} .2f"}),
    "work-precision": lambda: rows_table("accuracy_catalogues.csv", {
        "time step; masses; onset": lambda row: f"{row['dt']}; {'raised' if float(row['massstep']) else 'r^2'}; {row['onset']}",
        "model time per core-hour": lambda row: f"{number(row, 'time_per_core_hour'):.3g}",
        "events >= 1e-3": "rate", "exponent": "exponent", "gamma": "gamma", "energy released": "released"}),
    "walk": lambda: walk.table(shown), "files": index.files_table,
}  # yapf: disable


def text_of_table(head, rows):
    lines = ["| " + " | ".join(row) + " |" for row in (head, *rows)]
    return "\n".join([lines[0], "|---" * len(head) + "|", *lines[1:]])


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
                made = text_of_table(*TABLES[match[1]]())
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
    measured = {row["station"]: row for row in walk.rows(POSTPROC, FOLDER / "walk")}
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
