#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The stations of the study `walk`, seeds put together: walk.py POSTPROC FOLDER walk.csv

FOLDER has the catalogues, as RUN/catalogue.csv (of the study) or RUN.catalogue.csv.xz (as published); the fault is that of
results/campaign. Each number is the mean over the seeds, with its standard error, of
  exponent_N   exponent of the sizes from 10^N to 10^(N+1) times the unit, by `postproc fit`; the unit is 1 for blocks
               and 1e-3 for faults
  gamma_N      of the times between events of at least 10^N units, by `postproc intervals` with delta = 1
  burstiness   (s - m) / (s + m) of the times between events of at least one unit, mean m, standard deviation s
  to_X         Kolmogorov-Smirnov distance of these times, over their mean, to those of X
  small        share of events of less than one unit
  short        share of events of one to three blocks (ruptures only), and that of events of at least 0.1
"""
import csv
import datetime
import json
import lzma
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent.parent
DECADES = (-2, -1, 0, 1, 2)
SIZES = (0, 1, 2)


def text(path):
    raw = path.read_bytes()
    return (lzma.decompress(raw) if path.suffix == ".xz" else raw).decode()


def columns(path):
    rows = list(csv.reader(line for line in text(path).splitlines() if not line.startswith("#")))
    return {name: np.array(values, float) for name, values in zip(rows[0], zip(*rows[1:]))}


def times(path, size, begin=0.0):
    events = columns(path)
    start = events["t_start"][(events["size"] >= size) & (events["t_start"] >= begin)]
    return np.diff(np.sort(start))


def over_mean(samples):
    return np.concatenate([sample / sample.mean() for sample in samples if len(sample) > 1])


def distance(a, b):
    both = np.concatenate([a, b])
    return np.abs(np.searchsorted(np.sort(a), both, "right") / len(a) - np.searchsorted(np.sort(b), both, "right") / len(b)).max()


def earthquakes():
    """Times between those of Southern California of the paper's Table 1: M >= 2, 1984.0 to 1986.5."""
    path = ROOT / "inputs/seismicity/southern-california.csv.xz"
    found = []
    for row in csv.DictReader(line for line in text(path).splitlines() if not line.startswith("#")):
        if float(row["mag"]) >= 2.0 and "1984-01-01" <= row["time"] < "1986-07-02T12":
            day, clock = row["time"].rstrip("Z").split("T")
            hours, minutes, seconds = map(float, clock.split(":"))  # the catalogue has seconds of 60
            found.append(86400 * datetime.date.fromisoformat(day).toordinal() + 3600 * hours + 60 * minutes + seconds)
    return np.diff(np.sort(found))


def asked(postproc, *words):
    """The JSON of a command; nothing if it cannot determine its numbers."""
    with tempfile.TemporaryDirectory() as folder:
        out = f"{folder}/out.json"
        done = subprocess.run([postproc, *words, "--no-picture", "-o", f"{folder}/out", "--json", out], capture_output=True, check=False)
        return json.loads(Path(out).read_text()) if done.returncode == 0 else None


def number(postproc, key, *words):
    found = asked(postproc, *words)
    value = found["fits"][0].get(key) if found and found["fits"] else None
    return np.nan if value is None else float(value)


def numbers(postproc, path, unit, begin, others):
    size = unit * 10.0**np.array(DECADES)
    found = {}
    for decade, low in zip(DECADES, size):
        found[f"exponent_{decade}"] = number(postproc, "exponent", "fit", str(path), "--from", str(begin), "--range", f"{low:g}:{10 * low:g}",
                                             "--replicas", "0", "--no-comparison")
    for n in SIZES:
        found[f"gamma_{n}"] = number(postproc, "gamma", "intervals", str(path), "--from", str(begin), "--threshold", f"{unit * 10 ** n:g}", "--delta",
                                     "1", "--method", "likelihood", "--replicas", "0")
    t = times(path, unit, begin)
    found["burstiness"] = (t.std() - t.mean()) / (t.std() + t.mean())
    for name, other in others.items():
        found[f"to_{name}"] = distance(over_mean([t]), other)
    found["events"] = len(t) + 1
    sizes = columns(path)["size"]
    found["small"] = (sizes < unit).mean()
    return found


def short(path):
    events = columns(path)
    few, large = events["rupture_length"] <= 3, events["size"] >= 0.1
    return {"events": len(few), "short": few.mean(), "short_large": few[large].mean()}


def stations(folder):
    """Catalogues by the name of a station."""
    found = {}
    for path in sorted([*folder.glob("*/catalogue.csv"), *folder.glob("*.catalogue.csv.xz")]):
        run = path.name.split(".")[0] if path.suffix == ".xz" else path.parent.name
        if path.suffix == ".xz" or (path.parent / "done.json").exists():
            found.setdefault(run.rsplit("_", 1)[0], []).append(path)
    return {**found, "fault": sorted((ROOT / "results/campaign").glob("fault_120_?.catalogue.csv.xz"))}


def main(postproc, folder, out):
    results, places = ROOT / "results", stations(Path(folder))
    others = {
        "slider": over_mean([times(path, 1.0, 12000) for path in sorted((results / "catalogues").glob("slider_ours_1928_seed_*.xz"))]),
        "fault": over_mean([times(path, 1e-3, 4500) for path in places["fault"]]),
        "california": over_mean([earthquakes()]),
    }
    lines = []
    for name, paths in places.items():
        fault = name == "fault"
        found = [
            short(path) if name.startswith("ruptures") else numbers(postproc, path, 1e-3 if fault else 1.0, 4500 if fault else 0, others)
            for path in paths
        ]
        line = {"station": name, "seeds": len(paths)}
        for key in found[0]:
            values = [one[key] for one in found if np.isfinite(one[key])]
            line[key] = f"{statistics.mean(values):.4g}" if values else ""
            line[f"{key}_error"] = f"{statistics.stdev(values) / len(values) ** 0.5:.2g}" if len(values) > 1 else ""
        lines.append(line)
    names = list(dict.fromkeys(key for line in lines for key in line))
    with open(out, "w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, names, lineterminator="\n")
        table.writeheader()
        table.writerows(lines)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__.splitlines()[0])
    main(*sys.argv[1:])
