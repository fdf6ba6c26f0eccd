#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The stations of the study `walk`, seeds put together: walk.py POSTPROC FOLDER walk.csv

FOLDER has the catalogues, as RUN/catalogue.csv (of the study) or RUN.catalogue.csv.xz (as published; of the stations that
results/nature.py uses); the fault is that of results/campaign. Each number is the mean over the seeds, with its standard error, of
  exponent_N   exponent of the sizes from 10^N to 10^(N+1) units, by maximum likelihood, of all seeds together, as one seed may have
               few events there; error by jackknife over the seeds. The unit is 1 for blocks and 1e-3 for faults
  gamma_N      of the times between events of at least 10^N units, delta held at 1
  to_fault     Kolmogorov-Smirnov distance of the times between events of at least one unit, over their mean, to those of the fault
  small        share of events of less than one unit
  short        share of events that slip in one to three blocks
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

RESULTS = Path(__file__).resolve().parent
DECADES, SIZES = (-1, 0, 1, 2), (0, 1, 2)
FEWEST = 20  # smallest number of events in a decade
# Lines of the table: what is added to the previous model, and its catalogues, NAME-BLOCKS and ruptures-NAME-BLOCKS
WALK = (("springs", "chain"), ("+ elastic blocks", "bulk"), ("+ radiation", "radiating"), ("+ roughness", "rough"), ("+ slow plate", "slow"))
LENGTHS = {"fault": 120, "fault-240": 240, "fault-480": 480}  # of the campaign
TABLE = {"gamma": "gamma_0", "distance to the fault": "to_fault", "events < 1": "small", "drops of 1 to 3 blocks": "short",
         "ruptures of 1 to 3 blocks": "local"}  # yapf: disable


def times(events, size):
    return np.diff(events["t_start"][events["size"] >= size])


def exponent(sizes, low, high, fewest=FEWEST):
    """Exponent of a power law between these sizes, as `postproc fit` finds it. NaN if there are too few events, or all at one end"""
    sizes = np.asarray(sizes)
    logs, width = np.log(sizes[(sizes >= low) & (sizes < high)] / low), math.log(high / low)

    def excess(b):
        """Of the mean of the logarithms of a law, which increases with b = 1 - exponent."""
        return (width / 2 if abs(b) < 1e-7 else width / -math.expm1(-b * width) - 1 / b) - logs.mean()

    return 1 - brentq(excess, -30.0, 30.0, xtol=1e-12) if len(logs) >= fewest and excess(-30.0) < 0 < excess(30.0) else math.nan


def exponents(sizes, unit):
    """{exponent_N: (exponent, error)} of the sizes of all catalogues together."""
    found = {}
    for n in DECADES:
        low, high, seeds = unit * 10.0**n, unit * 10.0**(n + 1), len(sizes)
        parts = [exponent(np.concatenate(sizes[:k] + sizes[k + 1:]), low, high, 5) for k in range(seeds)] if seeds > 1 else [math.nan]
        found[f"exponent_{n}"] = exponent(np.concatenate(sizes), low, high), math.sqrt((seeds - 1) * np.var(parts))
    return found


def share(of):
    return np.mean(of) if len(of) else math.nan


def numbers(unit, fault, events):
    """The numbers of the events of one catalogue, except gammas and exponents. fault: times of the fault over their mean"""
    t = times(events, unit)
    found = {"small": share(events["size"] < unit), "to_fault": distance(over_mean(t), fault) if len(t) > 1 else math.nan}
    return found | ({"short": share(events["rupture_length"] <= 3)} if "rupture_length" in events.dtype.names and unit == 1.0 else {})


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


def rows(postproc, folder):
    """Rows of walk.csv. \\raises FileNotFoundError if there are no catalogues"""
    places = stations(Path(folder))
    of_fault = np.concatenate([over_mean(times(events_of(path, LOADING), 1e-3)) for path in places["fault"]])
    for name, paths in sorted(places.items(), key=lambda one: (one[0].startswith("ruptures"), one[0].startswith("fault"))):
        begin, unit, least = (LOADING, 1e-3, 1e-3) if "fault" in name else (0.0, 1.0, 1e-2)
        catalogues = [events_of(path, begin) for path in paths]
        if name.startswith("ruptures"):
            some = [{key: share(events["rupture_length"][events["size"] >= size] <= 3) for key, size in (("local", least), ("local_10", 10 * least))}
                    for events in catalogues]  # yapf: disable
        else:
            sizes = [f"{unit * 10.0**n:g}" for n in SIZES]
            some = [numbers(unit, of_fault, events) | {f"gamma_{n}": number(row, f"gamma_{size}") for n, size in zip(SIZES, sizes)}
                    for events, row in zip(catalogues, rows_of(postproc, paths, sizes, begin=begin))]  # yapf: disable
        found = {key: mean_and_error([one.get(key, math.nan) for one in some]) for key in dict.fromkeys(key for one in some for key in one)}
        found |= exponents([events["size"] for events in catalogues], unit) if not name.startswith("ruptures") else {}
        yield dict(station=name, seeds=len(some)) | {key + end: f"{x:.10g}" if math.isfinite(x) else ""
                                                     for key, pair in found.items() for end, x in zip(("", "_error"), pair)}  # yapf: disable


def table(shown):
    """Head and rows of the table of the page, from walk.csv. shown: text of a number and its error"""
    found = {row["station"]: row for row in read(RESULTS / "walk.csv")}
    lines = [(text, f"{station}-512") for text, station in WALK] + [("*roughness, springs*", "rough-chain-512"), ("fault", "fault")]
    rows = []
    for text, station in lines:
        one = found[station] | {key: value for key, value in found.get(f"ruptures-{station}", {}).items() if key.startswith("local")}
        rows.append([text, *(shown(number(one, key), number(one, f"{key}_error")) for key in TABLE.values())])
    return ["station", *TABLE], rows


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__.splitlines()[0])
    write_table(sys.argv[3], [], list(rows(*sys.argv[1:3])))
