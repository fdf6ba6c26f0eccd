#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Events after and before main shocks, all sequences stacked, for the studies laws and slow-driving †.

sequences.py CATALOGUE --threshold SIZE --main-size SIZE --window TIME --first TIME [--from TIME] [--to TIME] [--json FILE]

A main shock is the largest event from --window before its start to --window after its end; both have to be in the catalogue. Events
count whose start is --first to --window after its end, or whose end is as long before its start. p: of the rate K t^-p + background
after a main shock, by maximum likelihood (Utsu 1961, Geophys. Mag. 30, 521; Ogata 1983, J. Phys. Earth 31, 115). rates: in two bins
a decade.
"""
import argparse
import math
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from lsm.analysis import events_of  # noqa: E402
from lsm.program import add_time_window, run  # noqa: E402
from lsm.tables import write_json  # noqa: E402

FEWEST = 20  # events that are fitted
LEAST_GAIN = 5.99  # in 2 ln L over a constant rate: the 95 % point of chi square for two more parameters


def stacked(events, least, main_size, window, first):
    """The number of main shocks, and the times after and before them, ascending."""
    start, end, size = (events[name] for name in ("t_start", "t_end", "size"))
    shocks, after, before = 0, [np.empty(0)], [np.empty(0)]
    for k in np.flatnonzero(size >= main_size):
        slack = 4 * np.spacing(start[k])  # times are computed and limits are typed
        begin, last = start[k] - window, end[k] + window
        near = (start >= begin - slack) & (start <= last + slack)
        if begin < start[0] or last > start[-1] or np.argmax(np.where(near, size, 0)) != k:
            continue
        shocks += 1
        # Which of two that start together came first is not known.
        for times, since in (after, (start - end[k])[(size >= least) & (start > start[k])]), (before,
                                                                                              (start[k] - end)[(size >= least) & (start < start[k])]):
            times.append(np.minimum(since[(since >= first - slack) & (since <= window + slack)], window))
    return shocks, np.sort(np.concatenate(after)), np.sort(np.concatenate(before))


def decay(times, first, window):
    """Exponent of the decay and twice its gain in ln L over a constant rate, or why there is none."""
    from scipy.optimize import minimize  # takes longer than the rest
    if len(times) < FEWEST:
        return dict(why=f"{len(times)} events after main shocks, at least {FEWEST} needed")
    low, high = math.log(first), math.log(window)

    # The expected number of events is that observed, so that only the density matters: a share of it decays.
    def loss(variables):
        share, p = 1 / (1 + math.exp(-variables[0])), variables[1]
        z = (1 - p) * (high - low)
        integral = math.exp((1 - p) * low) * (high - low) * (math.expm1(z) / z if z else 1)
        return -2 * np.sum(np.log((share * times**-p / integral + (1 - share) / (window - first)) * (window - first)))

    best = min((minimize(loss, (share, 1.1), method="Nelder-Mead", options=dict(xatol=1e-7, fatol=1e-9)) for share in (-1, 1.4)),
               key=lambda one: one.fun)
    if -best.fun < LEAST_GAIN:
        return dict(why="no decay: a constant rate fits as well")
    return dict(p=best.x[1], gain=-best.fun) if best.x[1] > 0 else dict(why="the rate rises with time")


def rates(shocks, after, before, first, window):
    """Rows of bins with edges 10^(n/2) between the first and the last time."""
    edges = 10**(np.arange(math.ceil(2 * math.log10(first) - 1e-9), math.floor(2 * math.log10(window) + 1e-9) + 1) / 2)
    counts = [np.histogram(times, edges)[0] for times in (after, before)]
    return [dict(bin_lo=lo, bin_hi=hi, time=math.sqrt(lo * hi), count=count, rate=count / (shocks * (hi - lo)) if shocks else math.nan, before=early)
            for lo, hi, count, early in zip(edges, edges[1:], *counts)]  # yapf: disable


def main(catalogue, threshold, main_size, window, first, begin, end, json_file):
    if not 0 < first < window:
        raise ValueError(f"--first {first:g} --window {window:g}: expected 0 < --first < --window")
    events = events_of(catalogue, begin, end)
    if not len(events):
        raise ValueError(f"{catalogue}: a catalogue without events, expected some")
    shocks, after, before = stacked(events, threshold, main_size, window, first)
    found = dict(main_shocks=shocks, events=len(after), before=len(before)) | decay(after, first, window)
    write_json(json_file, sequences=[found], rates=rates(shocks, after, before, first, window))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("catalogue", metavar="CATALOGUE")
    parser.add_argument("--threshold", metavar="SIZE", type=float, required=True)
    parser.add_argument("--main-size", metavar="SIZE", type=float, required=True)
    parser.add_argument("--window", metavar="TIME", type=float, required=True)
    parser.add_argument("--first", metavar="TIME", type=float, required=True)
    parser.add_argument("--json", metavar="FILE", dest="json_file")
    add_time_window(parser)
    run(main, parser)
