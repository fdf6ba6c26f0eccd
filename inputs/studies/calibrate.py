#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Which values of what the paper does not print give the statements that it does.

calibrate.py propose OUT.csv LENGTH N [POINTS.csv [NAME,...]]   adds N points to the table of a study, from the prior or, with the numbers of
                                             points that were run, a quarter from it and the others from the posterior of a surrogate;
                                             with names of statements, all from what these make likely, whether printed or not
calibrate.py collect BIN POINTS.csv FOLDER...   numbers of runs of a study, one row for each run and memory of the picker; rows of other runs
                                             that the file has stay
calibrate.py posterior POINTS.csv OUT.csv    what samples of prior and posterior predict of each statement
calibrate.py sliders BIN OUT.csv FOLDER...   the same numbers of block-sliders, one row for each run, smallest size and warm-up; rows of other
                                             runs that the file has stay

The statements are those of lsm.paper. Approximate Bayesian computation with a
surrogate: each number is interpolated between the points that were run by a Gaussian process (Rasmussen & Williams 2006) with a length
scale for each value, of which scikit-learn finds the likeliest. A set of values is as likely as the deviations of its predicted
numbers from the paper's are, in units of the tolerance and of the surrogate's own error; it has to meet them at lengths 120 and 480.
"""
import json
import math
import re
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.stats import qmc

INPUTS = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(INPUTS), str(INPUTS.parent / "python")]
import lsm  # noqa: E402
from lsm import LOADING, summary  # noqa: E402
from lsm.paper import RANGES, SLIDER_SETTINGS, STATEMENTS, STATEMENTS_BY_NAME, STEPS, WINDOWS, completed, printed  # noqa: E402
from lsm.slip import Friction, judged, recorded  # noqa: E402
from lsm.statements import statements_of  # noqa: E402
from lsm.tables import read, write_table  # noqa: E402
from variables import defaults  # noqa: E402

# Time units. 0.99 a step is a memory of 100 steps; printed numbers imply steps of 0.0045, a benchmark of the same code has 0.02.
MEMORIES = (0.4, 0.7, 1, 1.6)
SETTINGS = ("length", "width", "seed", "stress", "viscosity", "kt", "mus", "retardation", "impedance", "hold", "mass", "contacts", "loose", "faces",
            "seeds", "linkratio", "velocity", "dt", "massstep", "steps")  # of a point

SLIDER_WARMUPS, SLIDER_SIZES = (0, 12000), ("0.0001", "0.01")

# ---- prior


class Value(NamedTuple):
    """What the paper does not print: where a number of [0, 1] leads, and back to a coordinate of [0, 1] for the surrogate."""
    low: float
    high: float
    log: bool = False
    at_zero: float = 0.0  # share of the prior at zero (log) or at the low end
    digits: int = 3

    def text(self, u):
        if u < self.at_zero:
            return "0" if self.log else f"{self.low:g}"
        v = (u - self.at_zero) / (1 - self.at_zero)
        return f"{self.low * (self.high / self.low)**v if self.log else self.low + (self.high - self.low) * v:.{self.digits}g}"

    def coordinate(self, row, key):
        value = float(row[key] or 0.0)
        if not self.log:
            return (value - self.low) / (self.high - self.low)
        return math.log(max(value, 0.5 * self.low) / self.low) / math.log(self.high / self.low)


class Choice(NamedTuple):
    """The default of some settings, or another way."""
    other: dict
    share: float  # of the default

    def settings(self, u):
        return {} if u < self.share else self.other

    def coordinate(self, row, _):
        return float(any(row.get(key) == value for key, value in self.other.items()))


# In the order of the coordinates of a point
UNPRINTED = {
    "stress": Value(0.01, 0.05, True, digits=4),
    "viscosity": Value(1e-4, 0.05, True, 0.1),
    "kt": Value(0.03, 1, True),
    "mus": Value(0.6, 0.85, at_zero=0.4),
    "retardation": Value(0, 0.004, at_zero=0.5, digits=2),
    "plates in place": Choice({"hold": "position"}, 0.8),
    "impedance": Value(0, 0.6, at_zero=0.5),
    "masses r3": Choice({"mass": "r3"}, 0.6),
    "contacts of the fault": Choice({"contacts": "fault"}, 0.75),
    "grid of seeds": Choice({"faces": "none", "seeds": "grid", "linkratio": "1.05"}, 0.6),
    "loose discs": Choice({"loose": "keep"}, 0.75),
}
MEMORY = Value(0.3, 2, True)
RUN = "preset=absorbing memory=0.7 ruptures=yes"  # in each run; its series are picked with other memories
SAMPLES = 20000
LEARNT = 200  # numbers of each kind from which length scales are learnt


def settings_of(cube):
    """Settings of a point of the unit cube, as words of run.py."""
    row = {}
    for (key, one), u in zip(UNPRINTED.items(), cube):
        row |= {key: one.text(u)} if isinstance(one, Value) else one.settings(u)
    if row.get("hold") == "position":
        del row["impedance"]  # has no effect there
    if row.get("contacts") == "fault":
        row.pop("loose", None)  # nothing would hold a disc that is not linked
    return row


def coordinates(row):
    """Of a point with a memory, for the surrogate."""
    own = [one.coordinate(row, key) for key, one in UNPRINTED.items()]
    return [*own, MEMORY.coordinate(row, "memory"), math.log(float(row["length"]) / 120) / math.log(4)]


# ---- collect


def loaded(time, pe):
    """Time from which a run counts: when its PE first reaches its mean of the last quarter of the time, and not before LOADING.

    The first loading lasts the longer the larger stress, friction and width are and the slower the plates.
    """
    return max(LOADING, float(time[(pe >= pe[3 * len(pe) // 4:].mean()).argmax()]))


def numbers_of_point(postproc, folder, memory, work):
    picked = work / "picked.csv"
    common = dict(check=True, capture_output=True, text=True)
    series = next(folder.glob("*.pe.bin"))
    subprocess.run([postproc, "pick", series, "-o", picked, "--overwrite", "--memory-time", str(memory)], **common)
    samples = lsm.read_series(series)
    begin = loaded(samples["time"], samples["pe"])

    def fitted(*more, **options):
        return summary.rows_of(postproc, [picked], ["1e-4"], *more, begin=begin, **options)[0]

    numbers = {"begin": f"{begin:.6g}"} | fitted(RANGES, WINDOWS, shortest=0)
    squares, longer = fitted(shortest=0, method="least-squares"), fitted()
    try:
        numbers |= {key: summary.told(value) for key, value in statements_of(postproc, picked, begin, folder).items()}
    except ValueError:  # too few events or velocities: these statements have no number
        pass
    numbers |= {"gamma_squares": squares["gamma_0.0001"], "gamma_longer": longer["gamma_0.0001"]}
    events, history = lsm.read_catalogue(picked), Friction(folder / "fault.slip.bin")
    events = recorded(events, history, begin)
    size, of = events["size"], (events["size"] >= 1e-3) & (events["size"] < 0.1)
    if np.sum(of) >= 5:
        excess, _ = judged(history, events, history.step(begin))
        numbers["excess"] = f"{np.sum((excess * size)[of]) / np.sum(size[of]):.4g}"
    return numbers


def settings_in(words):
    """SETTINGS of a run of which `words` were set."""
    there = defaults(words.get("preset", "leaky")) | words
    there = {key: there[text[2:-1]] if text in ("${mu}", "${dt}") else text for key, text in there.items()}
    there["impedance"] = "" if there["hold"] == "position" else there["impedance"]
    return {key: there[key] for key in SETTINGS}


def collect(binaries, output, folders):
    rows = read(output) if Path(output).exists() else []
    there = {row["point"] for row in rows}
    with tempfile.TemporaryDirectory() as work:
        for folder in (one for one in map(Path, folders) if one.name not in there and (one / "done.json").exists()):
            words = dict(line.split("=", 1) for line in (folder / "settings.txt").read_text().split("\n") if "=" in line)
            settings = {"point": folder.name, **settings_in(words)}
            if "failed" in json.loads((folder / "done.json").read_text()):
                rows.append({**settings, "memory": "", "stopped": "yes"})
                continue
            for memory in MEMORIES:
                numbers = numbers_of_point(Path(binaries) / "postproc", folder, memory, Path(work))
                rows.append({**settings, "memory": str(memory), "stopped": "no", **numbers})
    write_table(output, ["One row for each point and memory of the picker; stopped: a link was strained by half its length"], rows)


def collect_sliders(binaries, output, folders):
    rows = read(output) if Path(output).exists() else []
    there = {tuple(row[key] for key in SLIDER_SETTINGS) for row in rows}
    for folder in map(Path, folders):
        words = dict(line.split("=", 1) for line in (folder / "settings.txt").read_text().split("\n") if "=" in line)
        settings = {key: words.get(key, silent) for key, silent in SLIDER_SETTINGS.items()}
        done = folder / "done.json"
        if tuple(settings.values()) in there or not done.exists() or "failed" in json.loads(done.read_text()):
            continue
        for warmup in SLIDER_WARMUPS:
            numbers, = summary.rows_of(
                Path(binaries) / "postproc", [folder / "catalogue.csv"], SLIDER_SIZES, ("1e-2:1", "1:1e2"), begin=warmup, method="least-squares")
            for size in SLIDER_SIZES:
                own = {key: numbers[f"{key}_{size}"] for key in ("events", "mean_time", "gamma", "gamma_error", "B", "C")}
                rows.append({
                    **settings, "warmup": str(warmup), "smallest": size, "exponent_1e-2:1": numbers["exponent_1e-2:1"],
                    "exponent_1:1e2": numbers["exponent_1:1e2"], **own
                })
    write_table(output, ["One row for each run, smallest size of the events and warm-up; 1e7 steps each"], rows)


# ---- surrogate and posterior


class Surrogate:
    """Each number of the statements over the coordinates, with its error where it was not run."""

    def __init__(self, rows, statements):
        from sklearn.gaussian_process import GaussianProcessRegressor
        from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel
        from threadpoolctl import threadpool_limits
        threadpool_limits(1)  # threads that wait for each other beside running simulations take many times as long
        warnings.filterwarnings("ignore", module="sklearn")  # of convergence
        self.statements, self.fits, self.left_out = statements, {}, {}
        at = np.array([coordinates(row) for row in rows])
        names = sorted({row["point"] for row in rows})
        # Two memories of each point suffice, as numbers change smoothly with it; their turn makes all of them occur.
        turn = {name: {MEMORIES[n % len(MEMORIES)], MEMORIES[(n + 2) % len(MEMORIES)]} for n, name in enumerate(names)}
        used = np.array([float(row["memory"]) in turn[row["point"]] for row in rows])
        for one in statements:
            y = np.array([one.scaled(row) for row in rows])
            low, high = np.nanpercentile(y, [2, 98])
            some = used & np.isfinite(y)
            where, value = at[some], np.clip(y[some], low, high)
            kernel = ConstantKernel(1.0) * RBF(np.full(at.shape[1], 1.0), (0.1, 30)) + WhiteKernel(0.1, (1e-3, 1))
            learn = slice(None, None, 1 + len(value) // LEARNT)
            scales = GaussianProcessRegressor(kernel, normalize_y=True).fit(where[learn], value[learn]).kernel_
            # The last fifth of the points, left out, says how well others are predicted.
            held = np.array([names.index(row["point"]) % 5 == 4 for row, use in zip(rows, some) if use])
            fit = GaussianProcessRegressor(scales, optimizer=None, normalize_y=True)
            miss = value[held] - fit.fit(where[~held], value[~held]).predict(where[held])
            self.left_out[one.name] = float(np.sqrt(np.mean(miss**2))), float(np.std(value[held]))
            self.fits[one.name] = fit.fit(where, value)

    def predict(self, at):
        return {one.name: self.fits[one.name].predict(at, return_std=True) for one in self.statements}


def likelihood(predicted, statements):
    """Logarithm of the likelihood of the numbers that are predicted at one length."""
    log = 0.0
    for one in statements:
        (mean, error), (low, high) = predicted[one.name], one.interval()
        off, tolerance = np.maximum(0.0, np.maximum(low - mean, mean - high)), np.hypot(one.tolerance, error)
        log = log - 0.5 * (off / tolerance)**2 - np.log(tolerance / one.tolerance)
    return log


def sampled(rows, seed, statements=STATEMENTS, count=None, wanted=None):
    """(cube, memory, settings, predictions at the two lengths, logarithm of the likelihood) of samples of the prior, and the surrogate."""
    statements, count = [one for one in statements if one.name != "waves"], count or SAMPLES
    surrogate, rng = Surrogate(rows, statements), np.random.default_rng(seed)
    cube = rng.random((count, len(UNPRINTED)))
    memory = MEMORY.low * (MEMORY.high / MEMORY.low)**rng.random(count)
    words = [settings_of(one) for one in cube]
    found, log = {}, np.zeros(count)
    for length in ("120", "480"):
        at = np.array([coordinates({"impedance": "", **one, "memory": m, "length": length}) for one, m in zip(words, memory)])
        found[length] = surrogate.predict(at)
        log += likelihood(found[length], wanted or printed(statements))
        log += np.array([-0.5 * STATEMENTS_BY_NAME["waves"].deviation({"mass": one.get("mass", "r2")})**2 for one in words])
    for name, tolerance in (("B", math.log(1.5)), ("gamma", 0.2)):  # one fit for all lengths
        if name not in surrogate.fits:
            continue
        (a, x), (b, y) = (found[length][name] for length in found)
        log += -0.5 * (a - b)**2 / (tolerance**2 + x**2 + y**2)
    return cube, memory, words, found, log, surrogate


def propose(output, length, count, points=None, names=None):
    output, count = Path(output), int(count)
    lines = output.read_text().splitlines() if output.exists() else []
    wanted = names and [STATEMENTS_BY_NAME[name] for name in names.split(",")]
    kind = "s" if wanted else "p"
    n = 1 + max((int(line[1:4]) for line in lines if re.match(kind + r"\d{3}", line)), default=-1)  # numbers that are missing are not used again
    cubes = [] if wanted else list(qmc.Sobol(len(UNPRINTED), seed=2026).random(1024)[n:n + (count // 4 if points else count)])
    if points:
        cube, *_, log, _ = sampled(completed(points), n, wanted or printed(), wanted=wanted)
        weight = np.exp(0.5 * (log - log.max()))  # a wider one, since the surrogate is not exact
        cubes += list(cube[np.random.default_rng(n).choice(len(cube), count - len(cubes), replace=False, p=weight / weight.sum())])
    for k, one in enumerate(cubes):
        words = " ".join(f"{key}={value}" for key, value in settings_of(one).items())
        lines.append(f"{kind}{n + k:03d},fault,{length},1,{STEPS},{RUN} {words}")
    output.write_text("\n".join(lines) + "\n")


# ---- posterior

KEPT = 500  # samples of the posterior


def posterior(path, out):
    *_, found, log, surrogate = sampled(completed(path), 1, count=4 * SAMPLES)
    weight = np.exp(log - log.max())
    print(f"effective samples: {weight.sum()**2 / (weight**2).sum():.0f} of {len(weight)}", file=sys.stderr)
    kept, lines = np.random.default_rng(1).choice(len(weight), KEPT, p=weight / weight.sum()), []
    for one in STATEMENTS:
        line = {"statement": one.name}
        for length, predicted in found.items():
            if one.name in predicted:
                low, high = one.interval()
                met = np.maximum(low - predicted[one.name][0], predicted[one.name][0] - high) <= one.tolerance
                line |= {f"prior_{length}": f"{met.mean():.3f}", f"posterior_{length}": f"{met[kept].mean():.3f}"}
        if one.name in surrogate.left_out:
            line |= {"left_out": f"{surrogate.left_out[one.name][0]:.3g}", "spread": f"{surrogate.left_out[one.name][1]:.3g}"}
        lines.append(line)
    write_table(out, [
        "Shares of prior and posterior that are predicted to; left_out:"
        " error of the surrogate at points that it was not given, of the number or its logarithm, and their standard deviation"
    ], lines)


if __name__ == "__main__":
    if sys.argv[1:2] == ["propose"] and 5 <= len(sys.argv) <= 7:
        propose(*sys.argv[2:])
    elif sys.argv[1:2] == ["collect"] and len(sys.argv) > 4:
        collect(*sys.argv[2:4], sys.argv[4:])
    elif sys.argv[1:2] == ["posterior"] and len(sys.argv) == 4:
        posterior(*sys.argv[2:])
    elif sys.argv[1:2] == ["sliders"] and len(sys.argv) > 4:
        collect_sliders(*sys.argv[2:4], sys.argv[4:])
    else:
        sys.exit(__doc__)
