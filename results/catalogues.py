# SPDX-License-Identifier: GPL-2.0-or-later
"""What the scripts of these pages share: events as arrays, numbers of postproc, means with errors, CSV and pictures."""
import csv
import datetime
import json
import lzma
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "inputs/studies")]
import lsm  # noqa: E402
from calibrate import LOADING, roll_off_gain  # noqa: E402, F401
from lsm.drawing import draw  # noqa: E402, F401
from text_tables import memory_of, rows_of  # noqa: E402, F401

CALIFORNIA = ROOT / "inputs/seismicity/southern-california.csv.xz"
PERIOD = ("1984-01-01", "1986-07-02T12:00")  # of the paper's Table 1: 1984.0 to 1986.5


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


def numbers_in(header, *keys):
    """Parameters of a header as numbers, by name. \\raises ValueError if one is missing"""
    missing = [key for key in keys if key not in header]
    if missing:
        raise ValueError(f"no {missing[0]} in the header, expected one")
    return {key: float(header[key]) for key in keys}


def earthquakes():
    """Times (days) and magnitudes of Southern California in PERIOD, in order of time."""
    found = []
    with lzma.open(CALIFORNIA, "rt") as lines:
        for row in rows_of(lines):
            if PERIOD[0] <= row["time"] < PERIOD[1]:
                day, clock = row["time"].rstrip("Z").split("T")
                hours, minutes, seconds = map(float, clock.split(":"))  # the catalogue has seconds of 60
                seconds += 3600 * hours + 60 * minutes
                found.append((datetime.date.fromisoformat(day).toordinal() + seconds / 86400, float(row["mag"])))
    return np.array(sorted(found, key=lambda one: one[0])).T  # in the order of the file where times are equal


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


def text_of(value):
    """A cell of a CSV file; empty if there is no number."""
    if isinstance(value, (float, np.floating)):
        return f"{value:.17g}" if math.isfinite(value) else ""
    return str(value)


def write_table(path, comments, rows):
    """Writes rows (dicts) as CSV with lines of comments before them."""
    with open(path, "w", newline="") as file:
        file.writelines(f"# {line}\n" for line in comments)
        table = csv.DictWriter(file, rows[0], lineterminator="\n")
        table.writeheader()
        table.writerows({key: text_of(value) for key, value in row.items()} for row in rows)


def plain(row):
    """A row with numbers of Python, and None where there is none."""
    numbers = {key: value.item() if isinstance(value, (np.generic, np.ndarray)) else value for key, value in row.items()}
    return {key: None if isinstance(value, float) and not math.isfinite(value) else value for key, value in numbers.items()}


def write_json(path, **tables):
    """Writes tables, lists of rows, as those of postproc: null where there is no number. path: None is standard output"""
    text = json.dumps({name: [plain(row) for row in rows] for name, rows in tables.items()}, indent=1) + "\n"
    Path(path).write_text(text) if path else print(text, end="")


def run(main, parser):
    """Runs a script; what it refuses ends it with one line of error."""
    try:
        main(**vars(parser.parse_args()))
    except (OSError, ValueError) as error:
        sys.exit(f"{Path(sys.argv[0]).name}: {error}")
