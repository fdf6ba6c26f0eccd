#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What the parts of a long fault have to do with each other.

stretches.py [--memory TIME] [--stretch LENGTH] [--from TIME] POSTPROC OUT FOLDER...

Each FOLDER has a run with `-var extra fault_stretches`: fault.catalogue.csv and fault.stretches.txt. Its fault is cut into
stretches of about 120, fixed in space, whose energies add up to PE (weights fall linearly over one piece, so that blocks move from
one to the next without jumps). Writes, of all runs,
  OUT.variance.csv   variance of the changes of PE over a time, over the sum of those of the stretches (1: independent), and the
                     correlation of the changes of stretches, by their distance in stretches
  OUT.events.csv     numbers of lsm.summary for the events of the whole, of sums of its stretches shifted in time at random
                     (no interaction left), and of each stretch with a picker of its own (mean over stretches)
"""
import argparse
import array
import csv
import itertools
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "python"))
from lsm import LOADING  # noqa: E402
from lsm.summary import rows_of  # noqa: E402
from lsm.tables import header_of, memory_of  # noqa: E402
from superpose import write  # noqa: E402

LAGS = (1, 3, 10, 30, 100, 300, 1000)  # time units
SHIFTS = 5  # number of sums with different shifts
NUMBERS = {
    "events": "events_0.0001", "mean_time": "mean_time_0.0001", "gamma": "gamma_0.0001", "gamma_1e-3": "gamma_0.001",
    "exponent": "exponent_1e-4:1e-1", "largest": "largest"
}


class Refused(Exception):
    pass


def parts_of(path):
    """Steps and energies [sample, piece, block] of each part of a run. A part begins with comments, and its pieces have the discs that
    were in them then. It ends where the next part begins, as a killed run repeats its last steps. \\raises Refused"""
    parts = []
    with open(path, encoding="utf-8") as file:
        try:
            for comment, lines in itertools.groupby(file, lambda line: "#" in line):
                if comment:
                    continue
                lines = [line for line in lines if line[-1] == "\n"]  # a killed run leaves incomplete lines and samples
                pieces = int(lines[0].split()[1])
                table = [lines[n:n + pieces + 1] for n in range(0, len(lines) - pieces, pieces + 1)]
                if not table:
                    continue
                steps = np.array([int(rows[0].split()[0]) for rows in table])
                parts.append((steps, np.array([[row.split()[1:] for row in rows[1:]] for rows in table], float)))
                pieces, blocks = parts[-1][1].shape[1:]
            parts = [(steps[steps < end], energy[steps < end])
                     for (steps, energy), end in zip(parts, [*(int(steps[0]) for steps, _ in parts[1:]), math.inf])]
            every = set(np.diff(np.concatenate([steps for steps, _ in parts])))
        except (IndexError, ValueError):
            raise Refused(f"{path}: not what fault_stretches.in writes") from None
    if blocks != 2 or len({energy.shape[1] for _, energy in parts}) != 1 or len(every) != 1:
        raise Refused(f"{path}: expected energies of two blocks at steps with one distance")
    return parts


def stretches_of(folder, stretch, begin=0.0):
    """Header, and PE of each stretch of about this length at evenly spaced times from `begin` on. \\raises Refused"""
    with open(folder / "fault.catalogue.csv", encoding="utf-8") as lines:
        info = header_of(lines)
    missing = {"length", "dt", "velocity", "lambda", "seed"} - info.keys()
    if missing:
        raise Refused(f"{folder / 'fault.catalogue.csv'}: the header has no {min(missing)}, expected a catalogue of fault.in")
    parts = parts_of(folder / "fault.stretches.txt")
    length, dt = float(info["length"]), float(info["dt"])
    count, pieces = max(1, round(length / stretch)), parts[0][1].shape[1]
    size, piece = length / count, length / pieces
    places = (np.arange(pieces) + 0.5) * piece
    pes = []
    for steps, energy in parts:
        moved = float(info["velocity"]) * dt * (steps - steps[0])
        pe = np.zeros((count, len(steps)))
        for block, way in ((0, -1), (1, 1)):  # the lower plate moves towards smaller x
            x = places[None, :] + way * moved[:, None]
            for n in range(count):
                away = np.abs((x - (n + 0.5) * size + 0.5 * length) % length - 0.5 * length)
                pe[n] += (np.clip((0.5 * size + 0.5 * piece - away) / piece, 0, 1) * energy[:, :, block]).sum(axis=1)
        pes.append(pe)
    steps = np.concatenate([steps for steps, _ in parts])
    late = steps * dt >= begin
    if late.sum() < 2:
        raise Refused(f"{folder / 'fault.stretches.txt'}: ends at time {steps[-1] * dt:g}, expected samples from {begin:g} on")
    return info, int(steps[1] - steps[0]), np.concatenate(pes, axis=1)[:, late]


def variance(pe, every, dt):
    for lag in LAGS:
        by = max(1, round(lag / (every * dt)))
        if by + 1 >= pe.shape[1]:  # the run is too short for it
            break
        change = pe[:, by:] - pe[:, :-by]
        whole, parts = change.sum(axis=0).var(), change.var(axis=1).sum()
        r = np.corrcoef(change)
        count = len(pe)
        apart = [np.mean([r[n, (n + k) % count] for n in range(count)]) for k in range(1, count // 2 + 1)]
        yield {"lag": lag, "ratio": f"{whole / parts:.4g}", **{f"correlation_{k}": f"{c:.3g}" for k, c in enumerate(apart[:3], 1)}}


def write_series(path, info, every, pe):
    """Writes a PE series in which each sample counts as a step."""
    info = {**info, "dt": repr(float(info["dt"]) * every), "step0": "0", "time0": "0", "stride": "1"}
    write(path, info, array.array("d", pe))


def asked(*words):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True)
    if done.returncode:
        raise Refused(done.stderr.strip())
    return done.stdout


def events(postproc, info, every, pe, memory):
    with tempfile.TemporaryDirectory() as work:
        series, picked = Path(work) / "sum.pe.bin", Path(work) / "picked.csv"
        write_series(series, info, every, pe)
        asked(postproc, "pick", series, "-o", picked, "--memory-time", memory)
        row, = rows_of(postproc, [picked], ranges=["1e-4:1e-1"])
    return {name: row.get(key) for name, key in NUMBERS.items()}


def mean_row(rows):
    out = {}
    for name in NUMBERS:
        values = [float(row[name]) for row in rows if row[name] not in (None, "")]
        out[name] = f"{np.mean(values):.4g}" if values else ""
        out[f"{name}_sd"] = f"{np.std(values, ddof=1):.3g}" if len(values) > 1 else ""
    return out


def main(postproc, out, memory, stretch, begin, folders):
    changes, counted = [], []
    random = np.random.default_rng(1)
    for folder in map(Path, folders):
        info, every, pe = stretches_of(folder, stretch, begin)
        picker = memory_of(info) if memory is None else memory
        run = {"length": info["length"], "seed": info["seed"], "stretches": len(pe)}
        changes += [{**run, **row} for row in variance(pe, every, float(info["dt"]))]
        shifted = [sum(np.roll(one, random.integers(len(one))) for one in pe - pe.mean(axis=1)[:, None]) for _ in range(SHIFTS)]
        for what, series in (("whole", [pe.sum(axis=0)]), ("shifted", shifted), ("each", pe)):
            counted.append({**run, "what": what, "series": len(series), **mean_row([events(postproc, info, every, one, picker) for one in series])})
    for ending, rows in (("variance", changes), ("events", counted)):
        with open(f"{out}.{ending}.csv", "w", encoding="utf-8", newline="") as file:
            table = csv.DictWriter(file, list(dict.fromkeys(key for row in rows for key in row)), lineterminator="\n")
            table.writeheader()
            table.writerows(rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("postproc", metavar="POSTPROC")
    parser.add_argument("out", metavar="OUT")
    parser.add_argument("--memory", type=float, metavar="TIME", help="of the picker (default: that of the run)")
    parser.add_argument("--stretch", type=float, default=120, metavar="LENGTH", help="of a stretch, about (%(default)s)")
    parser.add_argument("--from", dest="begin", type=float, default=LOADING, metavar="TIME",
                        help="leave out what is before: all stretches are loaded together at first (%(default)s)")
    parser.add_argument("folders", metavar="FOLDER", nargs="+")
    try:
        main(**vars(parser.parse_args()))
    except (Refused, OSError) as error:
        sys.exit(f"stretches.py: {error}")
