#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The stations of the study `walk`, seeds put together: walk.py POSTPROC FOLDER walk.csv

FOLDER has the catalogues, as RUN/catalogue.csv (of the study) or RUN.catalogue.csv.xz (as published; of the stations that
results/nature.py uses); the fault is that of results/campaign. Each number is the mean over the seeds, with its standard error, of
  exponent_N   exponent of the sizes from 10^N to 10^(N+1) units, by maximum likelihood, of all seeds together, as one seed may have
               few events there; error by jackknife over the seeds. The unit is 1 for blocks and 1e-3 for faults
  gamma_N      of the times between events of at least 10^N units, delta held at 1
  burstiness   (s - m) / (s + m) of the times between events of at least one unit, mean m, standard deviation s
  to_X         Kolmogorov-Smirnov distance of these times, over their mean, to those of X
  events       of at least one unit
  small        share of events of less than one unit
  short        share of events that slip in one to three blocks, and of all in half of the blocks or more: whole
  local, local_10  of ruptures of at least 0.01 (a fault: 1e-3), and ten times that: share of those of one to three blocks (units of
               length)
gamma is that of `postproc intervals`.
"""
import csv
import itertools
import json
import math
import statistics
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from lsm import LOADING  # noqa: E402
from lsm.analysis import distance, mean_and_error, over_mean  # noqa: E402
from lsm.summary import rows_of  # noqa: E402
from lsm.tables import number, read  # noqa: E402
from nature import earthquakes  # noqa: E402

RESULTS = Path(__file__).resolve().parent
DECADES, SIZES = (-2, -1, 0, 1, 2), (0, 1, 2)
FEWEST = 20  # smallest number of events in a decade
# Lines of the table: what is added to the previous model, and its catalogues, NAME-BLOCKS and ruptures-NAME-BLOCKS
WALK = (("springs", "chain"), ("+ elastic blocks", "bulk"), ("+ radiation", "radiating"), ("+ roughness", "rough"), ("+ slow plate", "slow"))
LENGTHS = {"fault": 120, "fault-240": 240, "fault-480": 480}  # of the campaign
TABLE = {"gamma": "gamma_0", "distance to the fault": "to_fault", "events < 1": "small", "drops of 1 to 3 blocks": "short",
         "ruptures of 1 to 3 blocks": "local"}  # yapf: disable


def is_fault(name):
    return name.startswith("fault")


def times(rows, size, begin=0.0):
    start = sorted(number(row, "t_start") for row in rows if number(row, "size") >= size and number(row, "t_start") >= begin)
    return [b - a for a, b in zip(start, start[1:])]


def all_over_mean(samples):
    """Times of several catalogues over the mean of each."""
    return np.concatenate([over_mean(sample) for sample in samples if sample])


def exponent(sizes, low, high, fewest=FEWEST):
    """Exponent of a power law between these sizes, as `postproc fit` finds it. NaN if there are too few events"""
    logs, width = [math.log(size / low) for size in sizes if low <= size < high], math.log(high / low)
    if len(logs) < fewest:
        return math.nan
    mean, below, above = statistics.fmean(logs), -30.0, 30.0
    while above - below > 1e-9:  # the mean of the logarithms increases with b = 1 - exponent
        b = 0.5 * (below + above)
        expected = width / 2 if abs(b) < 1e-7 else width / -math.expm1(-b * width) - 1 / b
        below, above = (b, above) if expected < mean else (below, b)
    return 1 - below


def exponents(paths, unit, begin):
    """{exponent_N: (exponent, error)} of the events of all paths together."""
    sizes = [[number(row, "size") for row in read(path) if number(row, "t_start") >= begin] for path in paths]
    found = {}
    for n in DECADES:
        low, high, seeds = unit * 10.0**n, unit * 10.0**(n + 1), len(sizes)
        parts = [exponent(itertools.chain(*sizes[:k], *sizes[k + 1:]), low, high, 5) for k in range(seeds)] if seeds > 1 else [math.nan]
        error = math.sqrt((seeds - 1) * statistics.pvariance(parts)) if all(map(math.isfinite, parts)) else math.nan
        found[f"exponent_{n}"] = exponent(itertools.chain(*sizes), low, high), error
    return found


def share(rows, of):
    return sum(map(of, rows)) / len(rows) if rows else math.nan


def gammas(postproc, paths, unit, begin):
    """The values gamma_N of each catalogue."""
    if not paths:
        return []
    rows = rows_of(postproc, paths, [f"{unit * 10.0**n:g}" for n in SIZES], begin=begin)
    return [{f"gamma_{n}": number(row, f"gamma_{unit * 10.0**n:g}") for n in SIZES} for row in rows]


def numbers(path, unit, begin, others):
    """The numbers of one catalogue, except gammas and exponents."""
    rows = [row for row in read(path) if number(row, "t_start") >= begin]
    t = times(rows, unit)
    found = {"events": len(t) + 1, "small": share(rows, lambda row: number(row, "size") < unit)}
    if len(t) > 1:
        mean, deviation = statistics.fmean(t), statistics.pstdev(t)
        found |= {"burstiness": (deviation - mean) / (deviation + mean)}
        found |= {f"to_{name}": distance(over_mean(t), other) for name, other in others.items()}
    if rows and "rupture_length" in rows[0] and unit == 1.0:
        blocks = int(path.name.split("-")[-1].split("_")[0] if path.suffix == ".xz" else path.parent.name.split("-")[-1].split("_")[0])
        found |= {"short": share(rows, lambda row: number(row, "rupture_length") <= 3)}
        found |= {"whole": share(rows, lambda row: number(row, "rupture_length") >= blocks / 2)}
    return found


def ruptures(path, least, begin):
    rows = [row for row in read(path) if number(row, "t_start") >= begin and number(row, "size") >= least]

    def few(size):
        return share([row for row in rows if number(row, "size") >= size], lambda row: number(row, "rupture_length") <= 3)

    return {"events": len(rows), "local": few(least), "local_10": few(10 * least)}


def stations(folder):
    """Catalogues by the name of a station. \\raises FileNotFoundError if there are none"""
    found = {}
    for path in sorted([*folder.glob("*/catalogue.csv"), *folder.glob("*/fault.catalogue.csv"), *folder.glob("*.catalogue.csv.xz")]):
        run = path.name.split(".")[0] if path.suffix == ".xz" else path.parent.name
        done = path.with_name("done.json")
        if path.suffix == ".xz" or done.exists() and "failed" not in json.loads(done.read_text()):
            found.setdefault(run.rsplit("_", 1)[0], []).append(path)
    if not found:
        raise FileNotFoundError(f"{folder}: no catalogues")
    for name, length in LENGTHS.items():
        for kind, text in (("catalogue", ""), ("ruptures", "ruptures-")):
            found[text + name] = sorted((RESULTS / "campaign").glob(f"fault_{length}_?.{kind}.csv.xz"))
    return found


def measured(postproc, folder):
    """{station: {"seeds": number, key: (mean, standard error)}}. \\raises FileNotFoundError if there are no catalogues"""
    places = stations(Path(folder))
    others = {
        "slider": all_over_mean([times(read(path), 1.0, 12000) for path in sorted((RESULTS / "catalogues").glob("slider_ours_1928_seed_*.xz"))]),
        "fault": all_over_mean([times(read(path), 1e-3, LOADING) for path in places["fault"]]),
        "california": over_mean(np.diff(earthquakes()[0])),
    }
    found = {}
    for unit, begin, fault in ((1.0, 0.0, False), (1e-3, LOADING, True)):
        names = [name for name in places if is_fault(name) == fault and not name.startswith("ruptures")]
        rows = iter(gammas(postproc, [path for name in names for path in places[name]], unit, begin))
        for name in names:
            found[name] = [numbers(path, unit, begin, others) | next(rows) for path in places[name]]
    for name, paths in places.items():
        if name.startswith("ruptures"):
            found[name] = [ruptures(path, *((1e-3, LOADING) if "fault" in name else (1e-2, 0.0))) for path in paths]
    result = {}
    for name, some in found.items():
        keys = dict.fromkeys(key for one in some for key in one)
        result[name] = {"seeds": len(some)} | {key: mean_and_error([one.get(key, math.nan) for one in some]) for key in keys}
        if not name.startswith("ruptures"):
            result[name] |= exponents(places[name], *((1e-3, LOADING) if is_fault(name) else (1.0, 0.0)))
    return result


def table(shown):
    """Head and rows of the table of the page, from walk.csv. shown: text of a number and its error"""
    found = {row["station"]: row for row in read(RESULTS / "walk.csv")}
    lines = [(text, f"{station}-512") for text, station in WALK] + [("*roughness, springs*", "rough-chain-512"), ("fault", "fault")]
    rows = []
    for text, station in lines:
        one = found[station] | {key: value for key, value in found.get(f"ruptures-{station}", {}).items() if key.startswith("local")}
        rows.append([text, *(shown(number(one, key), number(one, f"{key}_error")) for key in TABLE.values())])
    return ["station", *TABLE], rows


def lines_of(found):
    """Rows of walk.csv."""
    lines = []
    for name, one in found.items():
        line = {"station": name, "seeds": one["seeds"]}
        for key, (mean, error) in ((key, pair) for key, pair in one.items() if key != "seeds"):
            line |= {key: f"{mean:.10g}" if math.isfinite(mean) else "", f"{key}_error": f"{error:.10g}" if math.isfinite(error) else ""}
        lines.append(line)
    return lines


def main(postproc, folder, out):
    lines = lines_of(measured(postproc, folder))
    names = list(dict.fromkeys(key for line in lines for key in line))
    with open(out, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, names, lineterminator="\n")
        writer.writeheader()
        writer.writerows(lines)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__.splitlines()[0])
    main(*sys.argv[1:])
