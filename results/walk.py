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
import json
import math
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from lsm import LOADING  # noqa: E402
from lsm.analysis import distance, events_of, mean_and_error, over_mean  # noqa: E402
from lsm.summary import rows_of  # noqa: E402
from lsm.tables import number, read, write_table  # noqa: E402
from nature import earthquakes  # noqa: E402

RESULTS = Path(__file__).resolve().parent
DECADES, SIZES = (-2, -1, 0, 1, 2), (0, 1, 2)
FEWEST = 20  # smallest number of events in a decade
# Lines of the table: what is added to the previous model, and its catalogues, NAME-BLOCKS and ruptures-NAME-BLOCKS
WALK = (("springs", "chain"), ("+ elastic blocks", "bulk"), ("+ radiation", "radiating"), ("+ roughness", "rough"), ("+ slow plate", "slow"))
LENGTHS = {"fault": 120, "fault-240": 240, "fault-480": 480}  # of the campaign
TABLE = {"gamma": "gamma_0", "distance to the fault": "to_fault", "events < 1": "small", "drops of 1 to 3 blocks": "short",
         "ruptures of 1 to 3 blocks": "local"}  # yapf: disable


def times(events, size):
    return np.diff(events["t_start"][events["size"] >= size])


def all_over_mean(samples):
    """Times of several catalogues over the mean of each."""
    return np.concatenate([over_mean(sample) for sample in samples if len(sample)])


def exponent(sizes, low, high, fewest=FEWEST):
    """Exponent of a power law between these sizes, as `postproc fit` finds it. NaN if there are too few events, or all at one end"""
    sizes = np.asarray(sizes)
    logs, width = np.log(sizes[(sizes >= low) & (sizes < high)] / low), math.log(high / low)

    def excess(b):
        """Of the mean of the logarithms of a law, which increases with b = 1 - exponent."""
        return (width / 2 if abs(b) < 1e-7 else width / -math.expm1(-b * width) - 1 / b) - logs.mean()

    return 1 - brentq(excess, -30.0, 30.0, xtol=1e-12) if len(logs) >= fewest and excess(-30.0) < 0 < excess(30.0) else math.nan


def exponents(paths, unit, begin):
    """{exponent_N: (exponent, error)} of the events of all paths together."""
    sizes, found = [events_of(path, begin)["size"] for path in paths], {}
    for n in DECADES:
        low, high, seeds = unit * 10.0**n, unit * 10.0**(n + 1), len(sizes)
        parts = [exponent(np.concatenate(sizes[:k] + sizes[k + 1:]), low, high, 5) for k in range(seeds)] if seeds > 1 else [math.nan]
        found[f"exponent_{n}"] = exponent(np.concatenate(sizes), low, high), math.sqrt((seeds - 1) * np.var(parts))
    return found


def share(of):
    return np.mean(of) if len(of) else math.nan


def gammas(postproc, paths, unit, begin):
    """The values gamma_N of each catalogue."""
    if not paths:
        return []
    rows = rows_of(postproc, paths, [f"{unit * 10.0**n:g}" for n in SIZES], begin=begin)
    return [{f"gamma_{n}": number(row, f"gamma_{unit * 10.0**n:g}") for n in SIZES} for row in rows]


def numbers(path, unit, begin, others):
    """The numbers of one catalogue, except gammas and exponents."""
    events = events_of(path, begin)
    t = times(events, unit)
    found = {"events": len(t) + 1, "small": share(events["size"] < unit)}
    if len(t) > 1:
        found |= {"burstiness": (np.std(t) - np.mean(t)) / (np.std(t) + np.mean(t))}
        found |= {f"to_{name}": distance(over_mean(t), other) for name, other in others.items()}
    if "rupture_length" in events.dtype.names and unit == 1.0:
        found |= {"short": share(events["rupture_length"] <= 3), "whole": share(events["rupture_length"] >= float(events.header["blocks"]) / 2)}
    return found


def ruptures(path, least, begin):
    events = events_of(path, begin)
    local, local_10 = (share(events["rupture_length"][events["size"] >= size] <= 3) for size in (least, 10 * least))
    return {"events": np.count_nonzero(events["size"] >= least), "local": local, "local_10": local_10}


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
        "slider": all_over_mean([times(events_of(path, 12000), 1.0) for path in sorted((RESULTS / "catalogues").glob("slider_ours_1928_seed_*.xz"))]),
        "fault": all_over_mean([times(events_of(path, LOADING), 1e-3) for path in places["fault"]]),
        "california": over_mean(np.diff(earthquakes()[0])),
    }
    found = {}
    for unit, begin, fault in ((1.0, 0.0, False), (1e-3, LOADING, True)):
        names = [name for name in places if name.startswith("fault") == fault and not name.startswith("ruptures")]
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
            result[name] |= exponents(places[name], *((1e-3, LOADING) if name.startswith("fault") else (1.0, 0.0)))
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
    write_table(out, [], lines_of(measured(postproc, folder)))


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__.splitlines()[0])
    main(*sys.argv[1:])
