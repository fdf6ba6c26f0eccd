# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether the roll-off of the event sizes moves with the length of the model †. The paper (Sect. 4.2) suspects so and leaves it open.

    python3 -m lsm.scaling fault_*.catalogue.csv --from 8000 --threshold 1e-3 -o BASE

Of each catalogue the characteristic size s* = <s^2>/<s> of the events of at least a smallest size, which follows the roll-off of a power
law with an exponent below 3. Of the catalogues of each model, with the same leaf springs and kind of events, a power law s* = A L^D of
the length L (or the number of blocks), and a constant. Results: BASE.csv, its picture .png and .svg, and --json.
"""
import argparse
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

import lsm
from lsm.drawing import KEY, Figure, axis, draw_all, quote
from lsm.program import add_time_window, run
from lsm.tables import write_json

PAPER_THRESHOLD = 1e-4  # smallest size in the paper's Figs. 12 and 13
POWER_LAW, NONE, UNDECIDED = "power law in the length", "no dependence on the length", "undecided"

# ---- characteristic sizes


class Point(NamedTuple):
    """Characteristic size of one catalogue; without numbers there is a reason."""
    length: float
    n: int  # events
    s_star: float = math.nan
    error: float = math.nan
    error_independent: float = math.nan  # if the events were independent, from their moments
    block: float = math.nan  # length of the blocks of time that are resampled (model time); 0: single events
    blocks: int = 0  # as many make up the catalogue
    why: str = ""


def block_length(values):
    """Length (in values) of the blocks with the least mean-square error of the variance of the mean in a circular block bootstrap, of
    values with mean 0: Politis & White 2004 (Econometric Reviews 23, 53) as corrected by Patton, Politis & White 2009 (ibid. 28, 372).
    Ours: at least the cube root of their number, for correlations that are not significant lag by lag, and at most a tenth of it."""
    n = len(values)
    longest = max(1.0, n / 10)
    shortest = min(np.cbrt(n), longest)
    last = min(math.ceil(math.sqrt(n)) + 5, n // 2)
    r = np.array([np.dot(values[:n - lag], values[lag:]) / n for lag in range(last + 1)])
    if not r[0] > 0:
        return shortest
    # The correlation ends where five lags in a row are not significant.
    significant = [0, *np.flatnonzero(np.abs(r[1:]) >= 2 * math.sqrt(math.log10(n) / n) * r[0]) + 1]
    end = next(a for a, b in zip(significant, [*significant[1:], math.inf]) if b - a > 5)
    width = min(2 * max(end, 1), last)
    lag = np.arange(1, width + 1)
    weighted = 2 * np.minimum(1, 2 * (1 - lag / width)) * r[1:width + 1]  # flat-top lag window
    spectrum = r[0] + weighted.sum()
    if not spectrum > 0:  # a small spectrum hidden by noise
        return longest
    return float(np.clip(np.cbrt(1.5 * (np.dot(lag, weighted) / spectrum)**2 * n), shortest, longest))


def too_few_or_equal(starts, sizes):
    """Why these events have no meaningful characteristic size, or ''."""
    if len(sizes) < 10:
        return f"{len(sizes)} events above the threshold, at least 10 needed"
    if sizes.min() == sizes.max():
        return "all events have the same size"
    if not (sizes.min() > 1e-150 and sizes.max() < 1e150):
        return "the squares of sizes are too small or too large for numbers"
    return "" if starts[-1] > starts[0] else "all events begin at the same time"


def characteristic_size(starts, sizes, threshold, length, replicas=200, seed=1, block=None):
    """s* of the events of at least a size. As events cluster, its error comes from a circular block bootstrap in time (Politis & Romano
    1992): the catalogue is closed to a ring, of which stretches that begin anywhere are drawn until they are as long as the catalogue.

    starts: in ascending order; block: length of the stretches (model time), block_length() without it, 0: single events as if independent
    \\raises ValueError for a block that is longer than half the catalogue or shorter than a hundredth of the mean interval
    """
    used = (sizes > 0) & (sizes >= threshold)
    starts, sizes = np.asarray(starts[used], float), np.asarray(sizes[used], float)
    n, why = len(sizes), too_few_or_equal(starts, sizes)
    if why:
        return Point(length, n, why=why)
    duration = (starts[-1] - starts[0]) * n / (n - 1)  # the gap that closes the ring is a mean interval
    sums = np.concatenate([np.zeros((1, 2)), np.cumsum(np.column_stack([sizes, sizes**2]), axis=0)])
    s_star = sums[-1, 1] / sums[-1, 0]
    influences = (sizes**2 - s_star * sizes) / sums[-1, 0]  # of each event on the ratio, to first order
    if block is None:  # in as many bins as events
        bins = np.minimum(((starts - starts[0]) / duration * n).astype(int), n - 1)
        block = block_length(np.bincount(bins, influences, n)) * duration / n
    blocks = 0
    if block > 0:
        shortest = 0.01 * duration / n  # shorter ones would hardly ever hold two events
        if not shortest <= block <= duration / 2:
            raise ValueError(f"block of {block:g}, expected 0 or {shortest:g} to half of the catalogue, which is {duration:g} long")
        blocks = math.floor(duration / block + 0.5)
        block = duration / blocks

    def before(times):
        """Sums over the events before these times."""
        return sums[np.searchsorted(starts, starts[0] + times)]

    def drawn():
        """Sums over one sample."""
        if not blocks:
            some = sizes[random.randint(0, n, n)]
            return some.sum(), (some**2).sum()
        begin = random.randint(0, 2**32, blocks, dtype=np.uint32) / 2**32 * duration
        end, round_the_ring = begin + block, begin + block > duration
        return np.sum(before(np.where(round_the_ring, end - duration, end)) + np.outer(round_the_ring, sums[-1]) - before(begin), axis=0)

    random = np.random.RandomState(seed)  # its stream is the same in all versions of NumPy, hence the published errors are
    ratios = []
    while len(ratios) < replicas:
        s, s2 = drawn()
        ratios += [s2 / s] if s > 0 else []  # a sample without events has no ratio
    return Point(length, n, s_star, np.std(ratios, ddof=1), math.sqrt(np.sum(influences**2)), block, blocks)


# ---- laws


def chi2_probability(chi2, freedom):
    """Probability of a chi2 at least as large."""
    half, odd = chi2 / 2, freedom % 2
    if not half > 0:
        return 1.0
    terms = ((k + odd / 2) * math.log(half) - half - math.lgamma(k + odd / 2 + 1) for k in range(freedom // 2))
    return sum(map(math.exp, terms)) + (math.erfc(math.sqrt(half)) if odd else 0.0)


def error_scale(chi2, freedom):
    """Factor for the errors of a law that fits poorly (p < 0.01), sqrt(chi2 / freedom): the points scatter by more than their errors."""
    return math.sqrt(chi2 / freedom) if freedom > 0 and chi2_probability(chi2, freedom) < 0.01 else 1.0


def corrected_aic(chi2, k, points):
    """chi2 + 2 k with the correction for few points (Hurvich & Tsai 1989, Biometrika 76, 297)."""
    return chi2 + 2 * k + 2 * k * (k + 1) / (points - k - 1)


def line(x, y, weight):
    """Weighted straight line: ordinate at 0, slope, their standard errors, chi2."""
    (slope, ordinate), covariance = np.polyfit(x, y, 1, w=np.sqrt(weight), cov="unscaled")
    error_of_slope, error = np.sqrt(np.diag(covariance))
    return ordinate, slope, error, error_of_slope, np.sum(weight * (y - ordinate - slope * x)**2)


def fit_scaling(points):
    """A power law and a constant by weighted least squares of ln s* on ln L, a dict; `why` says why there is none.

    preferred: the power law or the constant, if its AICc is lower than the other's by more than 2; the constant only if D = 0 is also
    within the 95 % confidence interval of D, since with few points AICc alone accepts it up to 2.2 errors away.
    """
    used = [point for point in points if not point.why and point.error > 0]
    n = len(used)
    if n < 4:
        return dict(why=f"{n} usable lengths, at least 4 needed")
    length, s_star, error = np.array([(point.length, point.s_star, point.error) for point in used]).T
    x, y, weight = np.log(length), np.log(s_star), (s_star / error)**2
    if not np.ptp(x) > 1e-9:
        return dict(why="all models have the same length")
    log_a, D, error_a, error_d, chi2 = line(x, y, weight)
    scale = error_scale(chi2, n - 2)
    mean = np.average(y, weights=weight)
    chi2_constant = np.sum(weight * (y - mean)**2)
    aicc, aicc_constant = corrected_aic(chi2, 2, n), corrected_aic(chi2_constant, 1, n)
    preferred = UNDECIDED
    if aicc < aicc_constant - 2:
        preferred = POWER_LAW
    elif aicc_constant < aicc - 2 and abs(D) < 1.96 * error_d:
        preferred = NONE
    return dict(n=n, A=math.exp(log_a), A_error=scale * math.exp(log_a) * error_a, D=D, D_error=scale * error_d, chi2=chi2, error_scale=scale,
                constant=math.exp(mean), constant_error=error_scale(chi2_constant, n - 1) * math.exp(mean) / math.sqrt(np.sum(weight)),
                chi2_constant=chi2_constant, aicc=aicc, aicc_constant=aicc_constant, preferred=preferred)


# ---- models


class Catalogue(NamedTuple):
    path: str
    label: str
    length: float
    model: tuple  # name, kl of the leaf springs, kind of events
    events: lsm.Table
    completeness: float  # as its header says; 0: does not
    complete_from: float  # smaller events are missing


class Scaling(NamedTuple):
    """The catalogues of one model."""
    model: tuple
    threshold: float
    threshold_from: str
    labels: list
    points: list
    fit: dict

    @property
    def name(self):
        model, kl, kind = self.model
        return ("fault" if model == "lsm" else "block-slider") + (f", Kl = {kl}" if kl else "") + (f", {kind}" if kind != "pe" else "")


def load(path, begin=-math.inf, end=math.inf, lenient=False):
    """A catalogue, with the events that start at `begin` or later and before `end`. \\raises ValueError"""
    events = lsm.read_catalogue(path, lenient)
    head = events.header
    key = next((key for key in ("length", "blocks") if key in head), None)
    length = lsm._number(path, head, key) if key else 0.0
    if not length > 0:
        raise ValueError(f"{path}: neither length nor blocks above 0 in the header, expected one")
    model = head.get("model", ""), head.get("kl", ""), head.get("events", "pe")
    label = f"fault, length {length:g}" if model[0] == "lsm" else f"block-slider, N = {length:g}"
    completeness, least = (lsm._number(path, head, key) if key in head else 0.0 for key in ("completeness", "min_size"))
    events = events[np.argsort(events["t_start"], kind="stable")]
    events = events[(events["t_start"] >= begin) & (events["t_start"] < end)]
    return Catalogue(str(path), label, length, model, events, completeness, least)


def with_labels(catalogues, labels=()):
    """The catalogues with these labels, or with the names of their files added to labels that others have, too."""
    if labels and len(labels) != len(catalogues):
        raise ValueError(f"--label {len(labels)} times, expected once for each of {len(catalogues)} catalogues")
    names = labels or [one.label for one in catalogues]
    if not labels:
        runs = [Path(one.path).name.removesuffix(".gz").removesuffix(".xz").removesuffix(".csv").removesuffix(".catalogue") for one in catalogues]
        runs = runs if len(set(runs)) == len(runs) else [one.path for one in catalogues]
        names = [f"{name} ({run})" if names.count(name) > 1 else name for name, run in zip(names, runs)]
    return [one._replace(label=name) for one, name in zip(catalogues, names)]


def smallest_size(catalogues, model, given):
    """The smallest size that is used of a model, at which all its catalogues are complete, and where it comes from."""
    alike = [one for one in catalogues if (one.model[0], one.model[2]) == (model[0], model[2])]
    size, source = (PAPER_THRESHOLD, "that of the paper's Figs. 12 and 13") if given is None else (given, "as given")
    known = max(alike, key=lambda one: one.completeness)
    if given is None and known.completeness > size:
        size, source = known.completeness, f"completeness in the header of {known.path}"
    begins = max(alike, key=lambda one: one.complete_from)
    return (begins.complete_from, f"where {begins.label} begins") if begins.complete_from > size else (size, source)


def scalings(catalogues, threshold=None, replicas=200, seed=1, block=None):
    """The dependence on the length of each model. \\raises ValueError for a block that does not suit a catalogue"""
    found = []
    for model in dict.fromkeys(one.model for one in catalogues):
        least, source = smallest_size(catalogues, model, threshold)
        of_model = [one for one in catalogues if one.model == model]
        # Each catalogue has its own seed, so that the samples are independent.
        points = [
            characteristic_size(one.events["t_start"], one.events["size"], least, one.length, replicas, seed + k, block)
            for k, one in enumerate(of_model)
        ]
        found.append(Scaling(model, least, f"{least:.4g}, {source}", [one.label for one in of_model], points, fit_scaling(points)))
    return found


# ---- results


def measured(fit, key, digits=4):
    return f"{key} = {fit[key]:.{digits}g} ± {fit[f'{key}_error']:.2g}"


def poorly(chi2, freedom):
    scale = error_scale(chi2, freedom)
    return f"χ² {chi2:.4g} on {freedom} degrees of freedom" + (f" (errors times {scale:.2g})" if scale > 1 else "")


def verdict(fit):
    """Says in one sentence whether the characteristic size depends on the length."""
    if "why" in fit:
        return f"degenerate: {fit['why']}"
    n, D, half = fit["n"], fit["D"], 1.96 * fit["D_error"]
    statement = "may or may not depend on the length"
    if fit["preferred"] == NONE:
        statement = "shows no significant dependence on the length"
    elif fit["preferred"] == POWER_LAW:
        statement = "grows with the length" if D > 0 else "shrinks with the length, which no finite-size effect explains"
        statement += ", but not as a power law" if fit["error_scale"] > 1 else ""
    return (f"Over {n} catalogues the characteristic size of the roll-off {statement} (s* ~ L^D with {measured(fit, 'D')}, at 95 % from "
            f"{D - half:.2g} to {D + half:.2g}, {poorly(fit['chi2'], n - 2)}; AICc {fit['aicc']:.4g} for this power law, {fit['aicc_constant']:.4g} "
            "for no dependence on L).")


def figure(found):
    """Characteristic sizes against the length with the laws fitted; an empty frame that says so if there are none."""
    rows, curves, laws, lengths, heights = [], [], [], [], []
    for number, scaling in enumerate(found, 1):
        drawn = [point for point in scaling.points if not point.why]
        rows += [[number, scaling.model[0], float(p.length), p.s_star, p.error, p.n, p.error_independent, p.block, p.blocks, label, p.why]
                 for p, label in zip(scaling.points, scaling.labels)]  # yapf: disable
        if not drawn:
            continue
        own = [point.length for point in drawn]
        lengths += own
        heights += [height for p in drawn for height in (max(p.s_star - p.error, 0.1 * p.s_star), p.s_star + p.error)]
        mine = f"table using ($1 == {number} ? $3 : NaN)"
        curves += [f"{mine}:(low($4, $5)):(0):($4+$5-low($4, $5)) with vectors heads size screen 0.003,90 lt {number} lw 0.8 notitle",
                   f"{mine}:4 with points lt {number} title {quote(f'{scaling.name}: s*')}"]  # yapf: disable
        fit, over = scaling.fit, f"[{0.85 * min(own)}:{max(own) / 0.85}] '+' using 1:"
        if "why" in fit:
            continue
        laws += [f"{over}({fit['A']}*$1**({fit['D']})) with lines lt {number} title {quote('A L^D with ' + measured(fit, 'D', 3), True)}",
                 f"{over}({fit['constant']}) with lines lt 8 dt 2 title 'constant'"]  # yapf: disable
    script = "unset tics\nset label 'no catalogue gives a characteristic size' at graph 0.5,0.5 center\nplot [0:1] [0:1] NaN notitle"
    if curves:
        kinds = {scaling.model[0] == "lsm" for scaling in found}
        what = "Length of the fault, or number of blocks" if len(kinds) > 1 else "Length of the fault" if kinds.pop() else "Number of blocks"
        script = (KEY + axis("x", what, 0.9 * min(lengths), 1.1 * max(lengths), True)
                  + axis("y", "Characteristic size s* (energy)", min(heights), max(heights), True)
                  + f"low(y, e) = y - e > 0.1 * y ? y - e : 0.1 * y\nset samples 400\nplot {', '.join(curves + laws)}")  # yapf: disable
    return Figure("", ["characteristic size <s^2>/<s> in model energy units; errors: bootstrap",
                       "block: length of the blocks of the catalogue that are resampled, model time; 0: single events; error_independent: if the "
                       "events were independent"], "curve,model,length,s_star,error,events,error_independent,block,blocks,label,degenerate", rows,
                  script, (900, 504 + 23 * ((len(curves) // 2 + len(laws) + 1) // 2)))  # yapf: disable


def as_json(scaling):
    """A dict of the numbers, without those that there are not."""
    points = [{"label": label} | {key: value for key, value in point._asdict().items() if value == value and value != ""}
              for label, point in zip(scaling.labels, scaling.points)]  # yapf: disable
    model, kl, kind = scaling.model
    return dict(model=model, kl=kl, events=kind, threshold=scaling.threshold, threshold_from=scaling.threshold_from, points=points,
                verdict=verdict(scaling.fit), **scaling.fit)


def main(catalogues, label, begin, end, threshold, bootstrap, block, seed, lenient, json_file, output, no_picture):
    if not begin < end or not bootstrap >= 2 or not (block is None or block >= 0):
        raise ValueError("expected --from before --to, --bootstrap of 2 or more, and --block of 0 or more")
    found = scalings(with_labels([load(path, begin, end, lenient) for path in catalogues], label), threshold, bootstrap, seed, block)
    for scaling in found:
        errors = "blocks of time" if any(point.blocks for point in scaling.points) else "single events as if independent"
        print(
            f"finite-size scaling, {scaling.name}: characteristic size s* = <s^2>/<s>, sizes >= {scaling.threshold_from} (bootstrap errors, {errors})"
        )
        for name, one in zip(scaling.labels, scaling.points):
            size = f"s* = {one.s_star:.4g} ± {one.error:.2g} (± {one.error_independent:.2g} if events were independent), {one.blocks} blocks"
            print(f"  {name}: {one.n} events, {one.why or size}")
        print(f"  {verdict(scaling.fit)}")
    draw_all("lsm.scaling", output, [figure(found)], catalogues, not no_picture)
    if json_file:
        write_json(json_file, scaling=[as_json(scaling) for scaling in found])


def parser():
    options = argparse.ArgumentParser(prog="python3 -m lsm.scaling", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("catalogues", nargs="+", metavar="CATALOGUE")
    options.add_argument("--label", action="append", help="name of a catalogue, once per catalogue")
    add_time_window(options)
    options.add_argument(
        "--threshold", type=float, metavar="SIZE", help="smallest size, raised to where all catalogues of a model are complete; without it "
        "1e-4, as in the paper, or the largest completeness in their headers")
    options.add_argument("--bootstrap", type=int, default=200, metavar="N", help="resampled catalogues for the errors (%(default)s)")
    options.add_argument(
        "--block", type=float, metavar="TIME", help="length of the blocks of time that are resampled, since events cluster; without it from "
        "the correlation of each catalogue (Politis and White 2004); 0: single events as if independent")
    options.add_argument("--seed", type=int, default=1, help="of the random numbers (%(default)s)")
    options.add_argument("--lenient", action="store_true", help="leave out lines that cannot be read")
    options.add_argument("--json", dest="json_file", metavar="FILE", help="the numbers")
    options.add_argument("-o", "--output", default="scaling", metavar="BASE", help="files are BASE.csv, .png and .svg")
    options.add_argument("--no-picture", action="store_true", help="table only")
    return options


if __name__ == "__main__":
    run(main, parser())
