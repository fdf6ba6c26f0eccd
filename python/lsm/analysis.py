# SPDX-License-Identifier: GPL-2.0-or-later
"""Events of a window of time, numbers that postproc finds, means with errors, and distances of samples."""
import json
import math
import subprocess
import tempfile
from pathlib import Path

import numpy as np

import lsm

__all__ = ["distance", "distance_of_counts", "events_of", "mean_and_error", "numbers_of", "over_mean"]


def numbers_of(postproc, command, *words):
    """The numbers (JSON) that a command of postproc finds. \\raises ValueError with its line of error"""
    with tempfile.TemporaryDirectory() as work:
        line = [postproc, command, *words, "-o", f"{work}/out", "--json", f"{work}/out.json"]
        done = subprocess.run([str(word) for word in line], capture_output=True, text=True)
        if done.returncode:
            raise ValueError(done.stderr.strip())
        return json.loads(Path(f"{work}/out.json").read_text())


def events_of(path, begin=-math.inf, end=math.inf):
    """The events that start at `begin` or later and before `end`, in order of their starts. \\raises ValueError"""
    events = lsm.read_catalogue(path)
    events = events[np.argsort(events["t_start"], kind="stable")]
    return events[(events["t_start"] >= begin) & (events["t_start"] < end)]


def over_mean(values):
    return values / np.mean(values)


def distance(a, b):
    """Kolmogorov-Smirnov distance of two samples."""
    return distance_of_counts(*np.unique(a, return_counts=True), *np.unique(b, return_counts=True))


def distance_of_counts(a, counts_a, b, counts_b):
    """The same of samples given as ascending values and how often each occurs."""
    below_a, below_b = (np.append(0.0, np.cumsum(counts) / np.sum(counts)) for counts in (counts_a, counts_b))
    at_a, at_b = below_a[1:] - below_b[np.searchsorted(b, a, "right")], below_a[np.searchsorted(a, b, "right")] - below_b[1:]
    return max(np.abs(at_a).max(), np.abs(at_b).max())


def mean_and_error(values, errors=()):
    """Mean of catalogues and its standard error: from their scatter, but not below what their own errors imply."""
    errors = np.resize(np.array(errors if len(errors) else [math.nan], float), len(values))
    values, errors = (np.array(one, float)[np.isfinite(values)] for one in (values, errors))
    n = len(values)
    if n < 2:
        return (values[0], errors[0]) if n else (math.nan, math.nan)
    return np.mean(values), math.sqrt(max(np.var(values, ddof=1) / n, np.nansum(errors**2) / n**2))
