#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a fault repeats itself †: a period in the times of its events, and energy released at the same times in two catalogues.

periods.py CATALOGUE... [--from TIME] [--threshold SIZE] [--period SLIP] [--bin SLIP]

Times are slips of one plate past the other. Z = |sum s exp(2 pi i t / P)|^2 / sum s^2 of the sizes s is 1 on average for random
phases (Rayleigh's test of directions, Mardia & Jupp 2000). p: share of random phases, or of shifts in time, with as much.
"""
import argparse
import itertools
import math
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from lsm.analysis import events_of  # noqa: E402
from lsm.program import run  # noqa: E402

FEWEST = 10


def slips_of(path, begin, least):
    """Times of the events of at least a size, as slips of the plates, and their sizes. \\raises ValueError"""
    events = events_of(path, begin)
    events = events[events["size"] >= least]
    velocity = abs(float(events.header.get("driving", events.header.get("velocity", 0))))
    if "driving" not in events.header and events.header.get("model") == "lsm":
        velocity *= 2  # there are two plates
    if not velocity > 0:
        raise ValueError(f"{path}: no velocity of the plates in the header, expected one")
    if len(events) < FEWEST:
        raise ValueError(f"{path}: {len(events)} events of this size, expected at least {FEWEST}")
    return events["t_start"] * velocity, events["size"]


def rayleigh_z(times, weights, period):
    return abs(np.sum(weights * np.exp(2j * np.pi * np.fmod(times, period) / period)))**2 / np.sum(weights**2)


def chance_of(z, weights, replicas=2000, seed=1):
    """Share of random phases that give as large a Z."""
    phases = np.random.default_rng(seed).uniform(0, 1, (replicas, len(weights)))
    return (1 + sum(rayleigh_z(one, weights, 1.0) >= z for one in phases)) / (replicas + 1)


def coincidence(first, second, width):
    """Correlation of the energies of two catalogues (times, weights) in bins of time, and the share of cyclic shifts with as large a one.
    \\raises ValueError unless they have 20 bins in common"""
    begin, end = max(first[0][0], second[0][0]), min(first[0][-1], second[0][-1])
    bins = math.floor((end - begin) / width)
    if bins < 20:
        raise ValueError(f"two catalogues at equal times: fewer than 20 bins of {width:g} in common, expected more")
    a, b = (np.histogram(times, bins, (begin, begin + bins * width), weights=weights)[0] for times, weights in (first, second))
    a, b = a - a.mean(), b - b.mean()
    shifted = np.fft.irfft(np.conj(np.fft.rfft(a)) * np.fft.rfft(b), bins) / math.sqrt(np.sum(a**2) * np.sum(b**2))
    return shifted[0], np.mean(shifted >= shifted[0] - 1e-12)


def main(catalogues, begin, threshold, period, width):
    series = {path: slips_of(path, begin, threshold) for path in catalogues}
    for path, (times, weights) in series.items():
        z = rayleigh_z(times, weights, period)
        print(f"{path}: period {period:g}, {len(times)} events: Z {z:.3g}, p {chance_of(z, weights):.2g}")
    found = [coincidence(series[a], series[b], width) for a, b in itertools.combinations(catalogues, 2)]
    for (a, b), (correlation, p) in zip(itertools.combinations(catalogues, 2), found):
        print(f"{a} and {b}: energy at equal times: correlation {correlation:.3g}, p {p:.2g}")
    if len(found) > 1:
        print(f"mean correlation of {len(found)} pairs: {np.mean(found, axis=0)[0]:.3g}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("catalogues", metavar="CATALOGUE", nargs="+")
    parser.add_argument("--from", metavar="TIME", type=float, dest="begin", default=-math.inf)
    parser.add_argument("--threshold", metavar="SIZE", type=float, default=1e-2, help="smallest size (1e-2)")
    parser.add_argument("--period", metavar="SLIP", type=float, default=1.0, help="period that is tested (1)")
    parser.add_argument("--bin", metavar="SLIP", type=float, dest="width", default=0.05, help="width of the bins of energy (0.05)")
    run(main, parser)
