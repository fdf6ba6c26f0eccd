# SPDX-License-Identifier: GPL-2.0-or-later
"""What the paper says about its fault in words, as numbers with errors †: it prints none for these.

    python3 -m lsm.statements POSTPROC CATALOGUE... [--from TIME] [--json FILE]

Slip history and ruptures are the files beside RUN.catalogue.csv, RUN.slip.bin and RUN.ruptures.csv. As events and slip are
clustered, errors are those of a jackknife over 20 equal parts of the time.
"""
import argparse
import math
from pathlib import Path

import numpy as np

import lsm
from lsm.analysis import events_of, numbers_of
from lsm.history import History
from lsm.program import run
from lsm.tables import plain, write_json

PARTS = 20
EDGES = np.concatenate([[0.0], 10.0**(0.2 * np.arange(251) - 1)])  # of bins of velocity: one below a tenth of the plates', then five per decade
BLOCK = 1 << 22  # slips of a history that are held in memory as numbers at a time
VELOCITIES = ("velocities", "The distribution of slip velocities was monotonic, decreasing for all slip velocities. (Sect. 4.1)")
NEIGHBOURS = ("neighbours", "Slip at a single contact will in most cases, trigger dynamic rupture of neighbouring contacts. (Sect. 5)")
LOCKED = ("locked",
          "During intervals in which the fault is locked, the potential in the model increases due to loading at the boundaries. (Sect. 4.1)")
ROLL_OFF = ("roll-off", "Both LSM and block-slider simulations display an exponential roll-off in event numbers for the large event tail of the "
            "distributions. (Sect. 4.2)")
NUMBERS = ("numbers",
           "1-3 x 10^7 time steps, resulting in the generation of between 3000 and 8000 events generated during each simulation (Sect. 2); "
           "LSM: B 15.21, C 0.0573 (Table 1)")
# Of Table 1, and the time step that follows from them if 1e7 steps have 3000 events.
PRINTED_B, PRINTED_C = 15.21, 0.0573
LONGEST_DT = 0.995 * PRINTED_B * 3000 / 1e7

# ---- estimates


def jackknife(function, *parts):
    """Value of a function of sums, and its error. parts: arrays of contents of each part of the time"""
    parts = np.array(parts, float)
    sums, n = parts.sum(axis=1)[:, None], parts.shape[1]
    with np.errstate(divide="ignore", invalid="ignore"):
        return function(*sums)[0], math.sqrt(np.var(function(*(sums - parts))) * (n - 1))


def ratio(above, below):
    return jackknife(lambda a, b: a / b, above, below)


def part_of(times, begin, end):
    """Index of the part of the run in which a time is; -1 outside."""
    index = np.minimum(PARTS - 1, ((times - begin) / (end - begin) * PARTS).astype(int))
    return np.where((times >= begin) & (times <= end), index, -1)


def student_quantile(level, freedom):
    """Value that Student's t exceeds with this probability."""
    t = np.linspace(0, 200, 200001)
    density = (1 + t**2 / freedom)**(-(freedom + 1) / 2)
    below = np.concatenate([[0], np.cumsum(density[1:] + density[:-1])])
    return np.interp(1 - 2 * level, below / below[-1], t)


def largest_rise(edges, content):
    """(ratio, error, from, to, significant): the largest ratio of the density in a bin to that in a bin of smaller values, of those that
    exceed 1 significantly or, if none does, of all. content: one row for each part, one column for each bin. NaN if fewer than two bins have content
    in half of the parts. The level is 5 % (Student's t of the logarithm, one-sided) divided by the number of pairs (Bonferroni).
    """
    usable = np.flatnonzero(2 * np.count_nonzero(content, axis=0) >= len(content))
    best, centres, widths = (math.nan, math.nan, math.nan, math.nan, False), 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)
    if len(usable) < 2:
        return best
    least = student_quantile(0.05 / (len(usable) * (len(usable) - 1) // 2), len(content) - 1)
    for n, high in enumerate(usable):
        for low in usable[:n]:
            log, error = jackknife(lambda a, b, w=widths[low] / widths[high]: np.log(w * a / b), content[:, high], content[:, low])
            found = (math.exp(log), math.exp(log) * error, centres[low], centres[high], log > least * error)
            if math.isnan(best[0]) or (found[4], found[0]) > (best[4], best[0]):
                best = found
    return best


def velocity_times(velocity, time, part):
    """Time in each bin of velocity over that of the plates, EDGES, part by part."""
    at = np.zeros(velocity.shape, int)
    fast, bins = velocity >= 0.1, len(EDGES) - 1
    at[fast] = np.minimum(1 + np.floor(5 * (np.log10(velocity[fast]) + 1)), bins - 1).astype(int)
    return np.bincount(part * bins + at, time, PARTS * bins).reshape(PARTS, bins)


# ---- statements. Each yields (statement, number, (value, error), expected, verdict, note)


def judge(value, error, limit, above):
    """Whether a number is above (or below) a limit; undecided unless by more than two errors."""
    if not abs(value - limit) > 2 * error:
        return "undecided"
    return "holds" if (value > limit) == above else "fails"


def slip_statements(drops, history):
    """The slip history of a fault compared with the drops of its PE. \\raises ValueError if these have no time in common"""
    if len(drops) < 2:
        raise ValueError("slip between drops of PE: fewer than two drops of this size")
    driving, run_begin, run_end = abs(history["driving"]), drops["t_start"][0], drops["t_end"][-1]
    part = part_of(history.middle, run_begin, run_end)
    kept = (history.end > history.begin) & (part >= 0)
    if not kept.any():
        raise ValueError("no slip history in the time of the drops of PE")
    history, part = history.kept(kept), part[kept]
    slip, begin, end, bins = history.records, history.begin, history.end, len(history.x)
    time = end - begin
    # Share of each record in which a drop is open: drops do not overlap, so the time in drops until t is piecewise linear.
    corners = np.stack([drops["t_start"], drops["t_end"]], axis=1).ravel()
    open_until = np.concatenate([[0], np.cumsum(drops["t_end"] - drops["t_start"])])
    within_until = np.stack([open_until[:-1], open_until[1:]], axis=1).ravel()
    share = np.clip((np.interp(end, corners, within_until) - np.interp(begin, corners, within_until)) / time, 0, 1)
    one = slip["step_end"] - slip["step_begin"] == history["interval"]
    mean, stress, backwards = np.zeros((3, len(time)))
    content = np.zeros((2, PARTS, len(EDGES) - 1))  # of velocities at all times, and in intervals of their own
    for first in range(0, len(time), rows := max(1, BLOCK // bins)):
        of = slice(first, first + rows)
        amounts, stress[of] = slip["slip"][of].astype(float), slip["stress"][of].sum(axis=1, dtype=float)
        velocity, mean[of] = amounts / (time[of] * driving)[:, None], amounts.sum(axis=1) / bins
        forward = velocity >= 0
        backwards[of] = bins - forward.sum(axis=1)
        for found, some in zip(content, (forward, forward & one[of, None])):
            record = first + np.nonzero(some)[0]
            found += velocity_times(velocity[some], time[record], part[record])

    def sums(values, at=part):
        return np.bincount(at, values, PARTS)

    within, between, time_within, time_between = sums(share * mean), sums((1 - share) * mean), sums(share * time), sums((1 - share) * time)
    work = sums((1 - share) * time * stress * history.bin * driving)
    middle = part_of(0.5 * (drops["t_end"][:-1] + drops["t_start"][1:]), run_begin, run_end)
    rise = sums(drops["pe_start"][1:] - drops["pe_end"][:-1], middle)
    for text, some in zip(("at all times", "while something slips"), content):
        value, error, low, high, rises = largest_rise(EDGES, some)
        note = "too few velocities" if math.isnan(value) else f"from {low:.2g} to {high:.2g} plate velocities" + ("" if rises else "; chance")
        verdict = "undecided" if math.isnan(value) else "fails" if rises else "holds"
        yield VELOCITIES, f"largest rise of the density, {text}", (value, error), "at most 1", verdict, note
    yield VELOCITIES, "share of the time with intervals of their own", (time[one].sum() / time.sum(), math.nan), "", "", ""
    yield VELOCITIES, "share of bins that slip backwards", (time @ backwards / (time.sum() * bins), math.nan), "", "", ""
    # In the long run this ratio is 1 if the history records all slip. If it does not, slip rates say nothing.
    recorded, locked = ratio(within + between, driving * (time_within + time_between)), ratio(between, driving * time_between)
    rates = jackknife(lambda a, b, c, d: (a / b) / (c / d), within, time_within, between, time_between)
    loading, complete = ratio(rise, work), abs(recorded[0] - 1) < 0.1
    yield LOCKED, "slip recorded over that of the plates", recorded, "1", "holds" if complete else "fails", ""
    yield LOCKED, "share of the time while no event is open", (time_between.sum() / time.sum(), math.nan), "", "", ""
    yield LOCKED, "share of the slip while no event is open", ratio(between, within + between), "", "", ""
    yield LOCKED, "slip rate within events over that between them", rates, "above 1", judge(*rates, 1.0, True), ""
    yield (LOCKED, "slip rate between events over that of the plates", locked, "below 0.5: locked",
           judge(*locked, 0.5, False) if complete else "undecided", "")
    yield LOCKED, "rise of PE between events over the work of the plates", loading, "above 0.5: by loading", judge(*loading, 0.5, True), ""


def rupture_statement(ruptures):
    """Share of the ruptures that are no longer than one bin of the fault. \\raises ValueError"""
    if "rupture_length" not in ruptures.dtype.names or "slip_bin" not in ruptures.header:
        raise ValueError("no column rupture_length, or no slip_bin in the header, expected a catalogue of ruptures")
    part = part_of(ruptures["t_start"], ruptures["t_start"].min(), ruptures["t_start"].max())
    one_bin = ruptures["rupture_length"] < 1.5 * float(ruptures.header["slip_bin"])
    share = ratio(np.bincount(part, one_bin, PARTS), np.bincount(part, minlength=PARTS))
    slipping = ruptures.header.get("slipping", "?")
    yield (NEIGHBOURS, f"share of ruptures of one bin (from {slipping} plate velocities on)", share, "below 0.5", judge(*share, 0.5, False), "")


def catalogue_statements(roll_off, fit, times):
    """Form of the roll-off, and numbers of events and times compared with what is printed, from numbers of postproc."""
    power, error, gain = (math.nan if roll_off[key] is None else roll_off[key] for key in ("power", "power_error", "gain"))
    verdict = "undecided" if math.isnan(power) else "holds" if abs(power - 1) <= 2 * error else "fails"
    yield ROLL_OFF, "power d of s^-a exp(-(s/c)^d)", (power, error), "1", verdict, roll_off["degenerate"]
    verdict = "undecided" if math.isnan(gain) else "holds" if gain > 3.84 else "fails"
    yield ROLL_OFF, "2 ln L of d = 1 over a power law without end", (gain, math.nan), "above 3.84", verdict, ""
    events = 1e7 * LONGEST_DT / times["mean"] if times["n"] else None
    numbers = [(f"events in 1e7 steps of {LONGEST_DT:.2g}", events, events and events / math.sqrt(times["n"]), 3000.0)]
    numbers += [(f"{key}, delta 1", fit[key], fit[f"{key}_error"], printed) for key, printed in (("B", PRINTED_B), ("C", PRINTED_C))]
    for text, value, error, printed in numbers:
        if value is None:
            yield NUMBERS, text, (math.nan, math.nan), f"{printed:.4g}", "undecided", ""
        else:
            verdict = "holds" if abs(math.log(value / printed)) <= math.log(2) else "fails"
            yield NUMBERS, text, (value, error), f"{printed:.4g}", verdict, f"{value / printed:.2g} times the paper's"


def statements_of(postproc, path, begin, run=None, threshold=None):
    """Rows of a run, fewer without the files beside its catalogue. run: that catalogue, if `path` was picked again; threshold: smallest
    size, by default that of postproc. \\raises ValueError"""
    path, run = Path(path), Path(run or path)
    drops = events_of(path, begin)
    if drops.header.get("events") == "ruptures":
        raise ValueError(f"{path}: no drops of PE, expected a catalogue of these")
    history, ruptures = (run.with_name(run.name.replace(".catalogue.csv", ending)) for ending in (".slip.bin", ".ruptures.csv"))
    from_size = ["--threshold", threshold] if threshold else []
    times = numbers_of(postproc, "intervals", path, *from_size, "--from", begin, "--method", "likelihood", "--delta", 1, "--replicas", 0,
                       "--shuffles", 0, "--no-picture")
    label, least = (times["times"][0][key] for key in ("label", "threshold"))
    found = []
    try:
        if history != run and history.exists():
            found += slip_statements(drops[drops["size"] >= least], History(history))
        if ruptures != run and ruptures.exists():
            found += rupture_statement(events_of(ruptures, begin))
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    fit = numbers_of(postproc, "fit", path, *from_size, "--from", begin, "--roll-off", "--replicas", 0, "--no-comparison", "--no-picture")
    found += catalogue_statements(fit["roll_off"][0], times["fits"][0], times["times"][0])
    return [
        plain(
            dict(statement=statement, catalogue=label, number=number, value=value, value_error=error, p=math.nan, expected=expected, verdict=verdict,
                 note=note, quote=quote)) for (statement, quote), number, (value, error), expected, verdict, note in found
    ]


def main(postproc, catalogues, begin, json_file):
    write_json(json_file, statements=[row for path in catalogues for row in statements_of(postproc, path, begin)])


def parser():
    parser = argparse.ArgumentParser(prog="python3 -m lsm.statements", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("postproc", metavar="POSTPROC", type=Path)
    parser.add_argument("catalogues", metavar="CATALOGUE", type=Path, nargs="+")
    parser.add_argument("--from", metavar="TIME", type=float, dest="begin", default=0.0)
    parser.add_argument("--json", metavar="FILE", dest="json_file")
    return parser


if __name__ == "__main__":
    run(main, parser())
