# SPDX-License-Identifier: GPL-2.0-or-later
"""What the paper says about its fault in words, as numbers †: it prints none for these.

  rise           "The distribution of slip velocities was monotonic, decreasing for all slip velocities." (Sect. 4.1): the largest ratio of
                 the density of velocities in a bin to that in a bin of smaller ones
  one_bin        "Slip at a single contact will in most cases, trigger dynamic rupture of neighbouring contacts." (Sect. 5): share of the
                 ruptures that are no longer than one bin of the fault
  rate_between   "During intervals in which the fault is locked, the potential in the model increases due to loading at the boundaries."
  loading        (Sect. 4.1): slip rate between events over that of the plates; rise of PE between them over the work of the plates
  roll_off_gain  "Both LSM and block-slider simulations display an exponential roll-off in event numbers for the large event tail of the
                 distributions." (Sect. 4.2): 2 ln L of it over a power law without end
"""
import math

import numpy as np

from lsm.analysis import events_of, numbers_of
from lsm.history import History

PARTS = 20  # of the time, for errors by a jackknife, as events and slip are clustered
EDGES = np.concatenate([[0.0], 10.0**(0.2 * np.arange(251) - 1)])  # of bins of velocity: one below a tenth of the plates', then five per decade
BLOCK = 1 << 22  # slips of a history that are held in memory as numbers at a time


def log_ratio(a, b):
    """Logarithm of the sum of `a` over that of `b`, contents of each part of the time, and its error by a jackknife."""
    with np.errstate(divide="ignore", invalid="ignore"):
        others = np.log((a.sum() - a) / (b.sum() - b))
        return np.log(a.sum() / b.sum()), math.sqrt(np.var(others) * (len(a) - 1))


def largest_rise(edges, content):
    """The largest ratio of the density in a bin to that in a bin of smaller values, of those that exceed 1 significantly or, if none does, of
    all, and whether it does. content: one row for each part, one column for each bin. NaN if fewer than two bins have content in half of
    the parts. The level is 5 % (Student's t of the logarithm, one-sided) divided by the number of pairs (Bonferroni)."""
    from scipy.stats import t as student  # the rest of the module needs NumPy only
    usable = np.flatnonzero(2 * np.count_nonzero(content, axis=0) >= len(content))
    if len(usable) < 2:
        return math.nan, False
    least, widths = student.isf(0.05 / (len(usable) * (len(usable) - 1) // 2), len(content) - 1), np.diff(edges)
    found = []
    for n, high in enumerate(usable):
        for low in usable[:n]:
            log, error = log_ratio(content[:, high], content[:, low])
            log += math.log(widths[low] / widths[high])
            found.append((log > least * error, math.exp(log)))
    significant, ratio = max(found)
    return ratio, significant


def velocity_times(velocity, time, part):
    """Time in each bin of velocity over that of the plates, EDGES, part by part."""
    at = np.zeros(velocity.shape, int)
    fast, bins = velocity >= 0.1, len(EDGES) - 1
    at[fast] = np.minimum(1 + np.floor(5 * (np.log10(velocity[fast]) + 1)), bins - 1).astype(int)
    return np.bincount(part * bins + at, time, PARTS * bins).reshape(PARTS, bins)


def slip_numbers(drops, history):
    """The slip history of a fault compared with the drops of its PE. \\raises ValueError if these have no time in common"""
    if len(drops) < 2:
        raise ValueError("slip between drops of PE: fewer than two drops of this size")
    driving, begin, end = abs(history["driving"]), drops["t_start"][0], drops["t_end"][-1]
    history = history.kept((history.end > history.begin) & (history.middle >= begin) & (history.middle <= end))
    slip, bins, time = history.records, len(history.x), history.end - history.begin
    if not len(slip):
        raise ValueError("no slip history in the time of the drops of PE")
    part = np.minimum(PARTS - 1, ((history.middle - begin) / (end - begin) * PARTS).astype(int))
    # Share of each record in which a drop is open: drops do not overlap, so the time in drops until t is piecewise linear.
    corners = np.stack([drops["t_start"], drops["t_end"]], axis=1).ravel()
    open_until = np.concatenate([[0], np.cumsum(drops["t_end"] - drops["t_start"])])
    within_until = np.stack([open_until[:-1], open_until[1:]], axis=1).ravel()
    shut = 1 - np.clip((np.interp(history.end, corners, within_until) - np.interp(history.begin, corners, within_until)) / time, 0, 1)
    mean, stress = np.zeros((2, len(time)))
    content = np.zeros((PARTS, len(EDGES) - 1))
    for first in range(0, len(time), rows := max(1, BLOCK // bins)):
        of = slice(first, first + rows)
        amounts, stress[of] = slip["slip"][of].astype(float), slip["stress"][of].sum(axis=1, dtype=float)
        velocity, mean[of] = amounts / (time[of] * driving)[:, None], amounts.sum(axis=1) / bins
        record = first + np.nonzero(velocity >= 0)[0]
        content += velocity_times(velocity[velocity >= 0], time[record], part[record])
    rise = np.sum(drops["pe_start"][1:] - drops["pe_end"][:-1])
    return dict(rise=largest_rise(EDGES, content)[0], rate_between=np.sum(shut * mean) / (driving * np.sum(shut * time)),
                loading=rise / np.sum(shut * time * stress * history.bin * driving))


def statements_of(postproc, catalogue, begin, run):
    """These numbers of a catalogue, from a time on, and of the slip history and ruptures of its run in a folder. \\raises ValueError"""
    fit, = numbers_of(postproc, "fit", catalogue, "--from", begin, "--roll-off", "--replicas", 0, "--no-comparison", "--no-picture")["roll_off"]
    drops, ruptures = events_of(catalogue, begin), events_of(run / "fault.ruptures.csv", begin)
    one_bin = ruptures["rupture_length"] < 1.5 * float(ruptures.header["slip_bin"])
    return slip_numbers(drops[drops["size"] >= fit["threshold"]], History(run / "fault.slip.bin")) | dict(
        one_bin=np.mean(one_bin), roll_off_gain=fit["gain"])
