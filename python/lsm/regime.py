# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a fault shows stick-slip or creep †: the paper only shows its Fig. 8, in which PE rises steadily and drops at once.

    python3 -m lsm.regime fault.pe.bin --catalogue fault.catalogue.csv --from 8000

The saw-tooth number is the rate at which PE falls over the rate at which it rises, in windows of time, each weighted by its change: 1 for a
series that falls as it rises, large for a saw-tooth. With the catalogue also the share of the time within events, and their mean duration.
"""
import argparse
import math

import numpy as np

import lsm
from lsm.program import run
from lsm.tables import write_json

WINDOW = 3.0  # time units: long against the periods of single discs (about 1), short against large events (10 and more)


def stick_slip_above(length):
    """Saw-tooth number above which a fault is said to stick-slip: 3 up to length 120, chosen from runs of the fault over stress and viscosity. A longer one
    has n = length / 120 parts that slip independently and whose PE adds up, so that the number falls about as 1/sqrt(n) towards the 1
    of a creeping fault; the limit does likewise. length: NaN if it is not known"""
    return 1 + 2 * math.sqrt(120 / length) if length > 120 else 3.0


def regime(pe, spacing, length=math.nan, window=WINDOW):
    """Numbers of samples of PE that are `spacing` apart (model time), a dict; without a saw-tooth number, `why`, unless PE both rose and fell"""
    per_window = max(1, math.floor(window / spacing + 0.5))
    changes = np.diff(pe[::per_window])
    rises, falls, window = changes[changes > 0], -changes[changes < 0], per_window * spacing
    if not len(changes):
        return dict(saw_tooth=None, why=f"the series is shorter than two windows of {window:g} time units: too short to tell a regime by")
    if not len(rises) or not len(falls):
        does = "only rises" if len(rises) else "only falls" if len(falls) else "does not change"
        what = f"PE {does} over {len(changes)} windows of {window:g} time units"
        return dict(saw_tooth=None, why=f"{what}: no events to tell a regime by")
    rise, fall = (np.sum(some**2) / np.sum(some) / window for some in (rises, falls))
    above, largest = stick_slip_above(length), np.sort(rises)[int(0.99 * (len(rises) - 1))]
    return dict(regime="stick-slip" if fall / rise > above else "creep", saw_tooth=fall / rise, stick_slip_above=above, rise=rise, fall=fall,
                drop_over_load=falls.max() / largest, windows=len(changes))  # the fastest fall grows with the length of the series


def of_run(series, begin=-math.inf, end=math.inf, window=WINDOW, events=None):
    """regime() of a series that was read, from `begin` to `end`, with the events of its catalogue. \\raises ValueError"""
    inside = series[(series["time"] >= begin) & (series["time"] <= end)]
    if len(inside) < 3:
        raise ValueError(f"{len(inside)} samples in the window of time, expected at least 3")
    first, last = (float(inside["time"][k]) for k in (0, -1))
    found = regime(np.asarray(inside["pe"]), (last - first) / (len(inside) - 1), float(series.header.get("length", math.nan)), window)
    if events is not None:
        events = events[(events["t_end"] >= first) & (events["t_end"] <= last)]
        begun = np.maximum(events["t_start"], first)
        durations = np.asarray(events["t_end"] - begun)
        order = np.argsort(begun)  # ruptures overlap
        ended = np.maximum.accumulate(np.concatenate([[first], events["t_end"][order]]))
        covered = np.maximum(ended[1:] - np.maximum(begun[order], ended[:-1]), 0).sum()
        found |= dict(time_in_events=float(covered) / (last - first), mean_duration=durations.mean() if len(events) else 0.0)
    return found


def main(series, catalogue, begin, end, window, json_file):
    if not begin < end or not 0 < window < math.inf:
        raise ValueError("expected --from before --to, and a finite --window above 0")
    found = of_run(lsm.read_series(series), begin, end, window, lsm.read_catalogue(catalogue) if catalogue else None)
    told = (f"{key.replace('_', ' ')} {value:.4g}" for key, value in found.items() if key not in ("regime", "why") and value is not None)
    print(f"{series}: {', '.join([found.get('regime') or 'degenerate: ' + found['why'], *told])}")
    if json_file:
        write_json(json_file, **found)


def parser():
    options = argparse.ArgumentParser(prog="python3 -m lsm.regime", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("series", metavar="SERIES", help="PE series")
    options.add_argument("--catalogue", metavar="FILE", help="the events of the series")
    options.add_argument("--from", dest="begin", type=float, default=-math.inf, metavar="TIME", help="first time used (model time)")
    options.add_argument("--to", dest="end", type=float, default=math.inf, metavar="TIME", help="last time used")
    options.add_argument("--window", type=float, default=WINDOW, metavar="TIME", help="over which rise and fall are measured (%(default)s)")
    options.add_argument("--json", dest="json_file", metavar="FILE", help="the numbers")
    return options


if __name__ == "__main__":
    run(main, parser())
