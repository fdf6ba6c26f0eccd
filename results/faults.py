#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The three faults beside each other: what the article says of them, from the published catalogues and the CSV files beside this file. †

faults.py                           writes the CSV files of the published catalogues, and all figures
faults.py publish POSTPROC RUN...   of runs (folders FAULT_LENGTH_PACKING): catalogue and ruptures into faults; those of length 120 are picked again,
                                 into picked.csv and ruptures_tests.csv, in which the rows of other runs stay; of slow ones only this.
                                 FAULT_fine_LENGTH_PACKING, FAULT_wide_...: another time step or width, into variants.csv
faults.py discs PACKING.dump RUN    which discs ring, and how they are held, from frames RUN.STEP.dump (extra=fault_dump) of a run with contacts of
                                 stiffness 0.2, and one of its packing before compression (settle=1): rows of trapped.csv

Leaky: soft contacts, and plates that let part of the waves out. Reflecting: plates that reflect, hardly any damping. Absorbing:
blocks that take up waves. All rates are of 1000 time units; errors are standard errors over packings, of one packing those of ten
parts of its time. A drop counts as slip if its excess (lsm.slip) is above 0.5.
"""
import functools
import math
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree
from scipy.stats import gamma as gamma_law

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent / "python"))
sys.path.append(str(FOLDER.parent / "inputs/studies"))  # its recipes may have names of scripts of this folder
import lsm  # noqa: E402
import slip_or_exchange  # noqa: E402
from lsm import LOADING, scaling, slip, summary  # noqa: E402
from lsm.analysis import mean_and_error  # noqa: E402
from lsm.drawing import draw  # noqa: E402
from lsm.history import History  # noqa: E402
from lsm.tables import memory_of, number, read, update_table, write_table  # noqa: E402
from publish import compressed, publish  # noqa: E402
from values import Value  # noqa: E402

LENGTHS = (120, 240, 480, 945, 1440, 1890)
SIZES = (1e-4, 1e-3, 1e-2, 1e-1)
PARTS = 10  # of the time of a run, for errors of single packings
PAPER = 1000 / 15.2  # drops in 1000 time units, of its B
PUBLISHED = {"leaky": ("faults/leaky",), "reflecting": ("faults/reflecting",), "absorbing": ("faults/absorbing", "campaign/fault")}
FAULTS = tuple(PUBLISHED)
FITTED = {"leaky.120": 2, "leaky.480": 1, "absorbing.120": 3, "absorbing.480": 1}  # packings by which values were chosen, of those published


class Run(NamedTuple):
    path: Path
    fault: str
    length: int
    packing: int
    events: lsm.Table  # from LOADING on

    @property
    def time(self):
        """Time counted, in 1000 units."""
        return float(self.events.header.get("time_span", self.events["t_end"].max() - LOADING)) / 1000

    def number(self, key):
        return float(self.events.header[key])


@functools.cache
def loaded(path):
    events = lsm.read_catalogue(path)
    return events[events["t_start"] >= LOADING]


@functools.cache
def runs_of(fault, length, kind="catalogue", column="size"):
    """Runs that recorded this column, of each packing the longest."""
    found = {}
    for prefix in PUBLISHED[fault]:
        for path in FOLDER.glob(f"{prefix}_{length}_*.{kind}.csv.xz"):
            events, packing = loaded(path), int(path.name.split(".")[0].split("_")[-1])
            if column in events.dtype.names:
                run = Run(path, fault, length, packing, events)
                found[packing] = max(found.get(packing, run), run, key=lambda one: one.time)
    return [found[packing] for packing in sorted(found)]


def parts_of(run):
    """The part of the time in which each event begins."""
    return np.minimum((run.events["t_start"] - LOADING) / (1000 * run.time / PARTS), PARTS - 1).astype(int)


def rate_of(run, chosen):
    """Of the events that are chosen, in 1000 time units, with the error that its parts show."""
    counts = np.bincount(parts_of(run)[chosen], minlength=PARTS) * PARTS / run.time
    return np.mean(counts), np.std(counts, ddof=1) / math.sqrt(PARTS)


def over(runs, measure):
    """Mean and standard error over packings of a measure of runs that gives a number, or a number and its error."""
    found = [np.append(measure(run), math.nan)[:2] for run in runs]
    return mean_and_error(*zip(*found)) if found else (math.nan, math.nan)


def quotient(one, other):
    """A number with its error over another."""
    (value, error), (base, of_base) = one, other
    return value / base, value / base * math.hypot(error / value, of_base / base)


@functools.cache
def excess_of(path):
    return slip.excess_of(loaded(path))


def drops(run, least):
    return rate_of(run, run.events["size"] >= least)


def slips(run, least):
    return rate_of(run, (run.events["size"] >= least) & (excess_of(run.path) > slip.SLIP))


def sources(runs):
    return " ".join(str(run.path.relative_to(FOLDER)) for run in runs)


# ---- rates over length


def rates():
    """A row for each fault and length: rates of drops, and of those that are slip, of at least each size, and of ruptures per 120 length."""
    rows = []
    for fault in FAULTS:
        for length in LENGTHS:
            every, worked = runs_of(fault, length), runs_of(fault, length, column="friction_work")
            row = dict(fault=fault, length=length, packings=len(every), time=float(sum(run.time for run in every)), packings_slip=len(worked))
            for name, runs, measure in ("drops", every, drops), ("slips", worked, slips):
                for least in SIZES:
                    row[f"{name}_{least:g}"], row[f"{name}_{least:g}_error"] = over(runs, lambda run: measure(run, least))
            slipped = runs_of(fault, length, **RUPTURES)
            row["packings_ruptures"] = len(slipped)
            row["ruptures_0.01"], row["ruptures_0.01_error"] = over(slipped, ruptures_of(0.01))
            rows += [row] if every else []
    return rows


# Points of each fault: name, number of its colour, shape. row(fault, x, y) is a point of a table that has the fault in its first column.
STYLES = (("leaky", 2, 7), ("reflecting", 6, 5), ("absorbing", 3, 9))
PANELS = """set key Left reverse
set bars small
row(name, y) = strcol(1) eq name ? y : NaN
set xtics out nomirror
"""


def panel(columns, more="", apart=0.05):
    """gnuplot's command that draws a panel. columns: of x, y and its error in a table that begins with the fault; more: further curves;
    apart: the faults, as a share of x"""
    x, y, error = columns
    curves = [
        f"table u (row('{name}', ${x})*{1 + apart * (number - 1)}):{y}:{error} w yerrorbars lc {lc} pt {pt} ps point t '{name}'"
        for number, (name, lc, pt) in enumerate(STYLES)
    ]
    return "plot " + ", ".join([*([more] if more else []), *curves]) + "\n"


LENGTH_AXES = """set logscale xy
set xrange [100:2300]
set yrange [1:200]
set xtics (120, 240, 480, 945, '' 1440, 1890)
set xlabel 'length of the fault'
set ylabel 'number in 1000 time units'
"""


def rates_figure(base=FOLDER / "rates"):
    rows = rates()
    write_table(f"{base}.csv", [
        "Rates in 1000 time units of drops of energy, and of those that are slip, of at least each size, and of ruptures of at least a work,",
        "for 120 of the length (faults.py)"
    ], rows)
    column = {name: 1 + number for number, name in enumerate(rows[0])}
    script = PANELS + "set multiplot layout 1,3\n" + LENGTH_AXES + "set title 'all drops of 10^{-4} and more'\nset key bottom right\n"
    script += panel((2, column["drops_0.0001"], column["drops_0.0001_error"]), f"{PAPER} w l lw 2 dt 2 lc rgb '#666666' t 'paper'")
    script += "set title 'slips of 0.1 and more'\nset key top left\n"
    script += panel((2, column["slips_0.1"], column["slips_0.1_error"]), "1.5*x/120 w l lw 1 dt 3 lc rgb '#666666' t 'in proportion to the length'")
    script += "set title 'ruptures of 0.01 and more, per 120'\n" + panel((2, column["ruptures_0.01"], column["ruptures_0.01_error"]))
    draw(base, script + "unset multiplot\n", 1400, 480)


# ---- series picked again

PICKED = FOLDER / "picked.csv"
MEMORIES = (0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 4.0)
SMALLEST = ("1e-4", "3e-4", "1e-3", "3e-3")
SHORTEST = (0.02, 0.05, 0.1, 0.2)  # times that are left out, over the mean
RANGE = "1e-4:1e-1"
USUAL = 0.00025  # velocity of a plate


def picked_again(postproc, pe, dt, memory, path):
    """Picks a series, with times from its beginning."""
    lsm.write_series(path.with_suffix(".bin"), dt * np.arange(len(pe)), pe, overwrite=True)
    subprocess.run([postproc, "pick", path.with_suffix(".bin"), "-o", path, "--memory-time", str(memory)], check=True, capture_output=True)
    path.with_suffix(".bin").unlink()
    return path


def rows_of_run(postproc, folder):
    """Rows of picked.csv of a run: of each memory, and with what the loading lacks if its plates are slow."""
    header = lsm.read_catalogue(folder / "fault.catalogue.csv").header
    series, events = lsm.read_series(folder / "fault.pe.bin"), lsm.read_catalogue(folder / "fault.catalogue.csv")
    events = events[events["t_start"] >= LOADING]
    own, velocity, start = round(memory_of(header), 3), float(header["velocity"]), series["time"][0]
    power = (events["friction_total"][-1] - events["friction_total"][0]) / (events["t_end"][-1] - events["t_end"][0])
    lacking = power * (USUAL / velocity - 1)
    begin, span, rows = LOADING - start, (series["time"][-1] - LOADING) / 1000, []
    with tempfile.TemporaryDirectory() as work:
        kinds = [(memory, ramp) for ramp in ((0.0, lacking) if lacking > 0 else (0.0,)) for memory in sorted({*MEMORIES, own})]
        paths = [
            picked_again(postproc, series["pe"] + ramp * (series["time"] - start), float(header["dt"]), memory,
                         Path(work) / f"{n}.csv") for n, (memory, ramp) in enumerate(kinds)
        ]

        def measured(**options):
            return summary.rows_of(postproc, paths, SMALLEST, [RANGE], begin=begin, **options)

        fits = [("likelihood", shortest, measured(shortest=shortest)) for shortest in (0.0, *SHORTEST)]
        fits.append(("least-squares", 0.0, measured(method="least-squares")))
        for n, ((memory, ramp), path) in enumerate(zip(kinds, paths)):
            events = lsm.read_catalogue(path)
            counts = {
                least: np.histogram(events["t_start"][events["size"] >= least], PARTS, (begin, begin + 1000 * span))[0] * PARTS / span
                for least in SIZES
            }
            row = dict(run=folder.name, fault=folder.name.split("_")[0], length=float(header["length"]), packing=header["seed"], velocity=velocity,
                       own_memory=own, memory=memory, ramp=ramp, time=span)
            for least, found in counts.items():
                row |= {f"rate_{least:g}": np.mean(found), f"rate_{least:g}_error": np.std(found, ddof=1) / math.sqrt(PARTS)}
            row |= {"exponent": fits[0][2][n][f"exponent_{RANGE}"]}
            for method, shortest, some in fits:
                name = "density" if method == "least-squares" else f"{shortest:g}"
                for least in SMALLEST:
                    row |= {f"{key}_{name}_{least}": some[n][f"{key}_{float(least):g}"] for key in ("gamma", "gamma_error", "B")}
            rows.append(row)
    return rows


# ---- ruptures by what friction takes up

# A place slips while friction takes up more than that of so many plate velocities: waves move the faces past each other without it.
SLIPPING = 50
TESTS = tuple((slipping, merged) for slipping, merged in ((20, 1), (50, 1), (100, 1), (50, 4)))
GAP, PAUSE = 1, 3  # places, intervals, as of compute lsm/events
SMALLEST_RUPTURE = 1e-3
TESTED = FOLDER / "ruptures_tests.csv"


class Intervals(NamedTuple):
    """Slip and work of each place in the intervals of a run from LOADING on that have records of their own."""
    header: dict
    interval: np.ndarray  # of each record
    slip: np.ndarray
    work: np.ndarray
    span: float  # of one interval
    count: int  # of intervals


def intervals_of(folder):
    history = History(folder / "fault.slip.bin")
    history = history.kept((history.end > history.begin) & (history.begin >= LOADING))
    begin, end = (np.asarray((history.records[key] - history.records["step_begin"][0]) // int(history["interval"]))
                  for key in ("step_begin", "step_end"))
    # Records of several intervals, in which no place moves as fast as five plate velocities, hold no rupture.
    one = end - begin == 1
    slip, work = (np.asarray(history.records[key])[one] for key in ("slip", "work"))
    return Intervals(lsm.read_catalogue(folder / "fault.catalogue.csv").header, begin[one], slip, work, history.span, int(end[-1]))


def ruptures_in(history, slipping=SLIPPING, merged=1):
    """Connected sets of slipping places: arrays of start and end (time from LOADING on), work, slip, first place and number of places.

    merged: intervals that are taken together
    """
    number = history.interval // merged
    begins = np.flatnonzero(np.diff(number, prepend=-1))
    number, span, bins = number[begins], history.span * merged, history.work.shape[1]
    work, slip = (np.add.reduceat(one, begins, axis=0) for one in (history.work, history.slip))
    friction = 0.6 * float(history.header["stress"]) * 2 * float(history.header["velocity"]) * span  # of the plates' slip, at one place
    record, place = np.nonzero(work > slipping * friction)
    if not len(record):
        return (np.zeros(0),) * 6
    near = cKDTree(np.column_stack([place, number[record] * ((GAP + 1) / PAUSE)]),
                   boxsize=[bins, 0]).query_pairs(GAP + 1.001, p=np.inf, output_type="ndarray")
    count, of = connected_components(coo_matrix((np.ones(len(near), bool), near.T), shape=(len(record), len(record))), directed=False)
    sums = [np.bincount(of, one[record, place], count) for one in (work, slip)]
    order = np.lexsort((place, of))
    place, first = place[order], np.flatnonzero(np.diff(of[order], prepend=-1))
    ahead = np.append(place[1:], 0) - place  # to the next place of the rupture, from its last one round the fault to its first
    last = np.append(first[1:], len(place)) - 1
    ahead[last] = place[first] + bins - place[last]
    longest = np.maximum.reduceat(ahead, first)
    start = np.array([(place[a:z + 1][np.argmax(ahead[a:z + 1])] + m) % bins for a, z, m in zip(first, last, longest)])
    begin, end = np.full(count, np.inf), np.zeros(count)
    np.minimum.at(begin, of, number[record] * span)
    np.maximum.at(end, of, (number[record] + 1) * span)
    return begin, end, *sums, start, np.maximum(1, bins - longest + 1)


def find_ruptures(*folders):
    tests = []
    for folder in folders:
        history = intervals_of(folder)
        name, length, time = folder.name, float(history.header["length"]), history.count * history.span / 1000
        for slipping, merged in TESTS if length == 120 else ((SLIPPING, 1),):
            begin, end, work, slip, start, places = ruptures_in(history, slipping, merged)
            row = dict(run=name, fault=name.split("_")[0], length=length, packing=history.header["seed"], slipping=slipping, merged=merged, time=time,
                       share=work.sum() / history.work.sum())
            for least in SIZES:
                row |= {f"rate_{least:g}": np.sum(work >= least) / time, f"share_{least:g}": work[work >= least].sum() / history.work.sum()}
            tests.append(row)
            if (slipping, merged) == (SLIPPING, 1):
                kept = np.flatnonzero(work >= SMALLEST_RUPTURE)
                kept = kept[np.argsort(begin[kept], kind="stable")]
                lines = ["# lsm-catalogue 1\n", *(f"# {key} = {value}\n" for key, value in history.header.items())]
                lines += [f"# events = ruptures by friction\n# slipping_work = {SLIPPING}\n# time_span = {1000 * time:.9g}\n"]
                lines += [f"# thinned = sizes below {SMALLEST_RUPTURE:g} left out\nevent_id,t_start,t_end,size,slip,x_begin,rupture_length\n"]
                lines += [
                    f"{n},{LOADING + begin[k]:.7g},{LOADING + end[k]:.7g},{work[k]:.6g},{slip[k]:.6g},{start[k]},{places[k]}\n"
                    for n, k in enumerate(kept, 1)
                ]
                (FOLDER / f"faults/{name}.slips.csv.xz").write_bytes(compressed("".join(lines)))
    update_table(TESTED, [
        "Ruptures of at least a work of friction, in 1000 time units, and their share of all work: found with other thresholds (in",
        "velocities of the plates) and with intervals merged (faults.py publish)"
    ], tests, lambda row: (row["fault"], float(row["length"]), row["run"], float(row["slipping"]), float(row["merged"])))


VARIANTS, VARIED = FOLDER / "variants.csv", ("fine", "coarse", "wide")
USUAL_RUNS = (*(f"{fault}_120_{packing}" for fault in ("leaky", "reflecting") for packing in (4, 11, 12)), "absorbing_120_1")  # beside them
NUMBERS = (("exponent", f"exponent_{RANGE}", f"error_{RANGE}"), ("gamma", "gamma_0.0001", "gamma_error_0.0001"), ("B", "B_0.0001", None),
           ("mean_time", "mean_time_0.0001", None))


def variant_of(postproc, folder):
    """A row of variants.csv: rates with errors from ten parts of the time, exponent, gamma and B of a run."""
    path, history = folder / "fault.catalogue.csv", intervals_of(folder)
    fault, number = folder.name.split("_")[0], {key: float(history.header[key]) for key in ("dt", "width", "length", "seed")}
    run = Run(path, fault, int(number["length"]), int(number["seed"]), loaded(path))
    begin, _, work, *_ = ruptures_in(history)
    found = lsm.Table(np.rec.fromarrays([LOADING + begin, LOADING + begin, work], names="t_start,t_end,size"),
                      history.header | {"time_span": 1000 * run.time})
    row = dict(run=folder.name, fault=fault, packing=run.packing, dt=f"{number['dt']:g}", width=f"{number['width']:g}", time=run.time)
    rates = dict(drops=drops(run, 1e-4), slips=slips(run, 0.1), ruptures=per_length(run._replace(events=found), work >= 1e-2))
    fits, = summary.rows_of(postproc, [path], ["1e-4"], [RANGE], begin=LOADING, shortest=0)
    for name, (rate, error) in (rates | {key: (fits[column], fits.get(error, "")) for key, column, error in NUMBERS}).items():
        row |= {name: rate, f"{name}_error": error}
    return row


TRAPPED, RINGING, KT = FOLDER / "trapped.csv", 1.0, 0.2  # RINGING: discs that move with shorter periods are single ones
MOST_DISCS = 3


def frame_of(path):
    """id, type, x, y, z, radius, vx, vy of each disc."""
    return np.array(Path(path).read_text().split("vx vy", 1)[1].split(), float).reshape(-1, 8)


def stiffness_of(count, pairs, along, across, stiffness):
    """Sums over pairs of springs along their line, and across it by a factor: what holds each of so many discs if all others are fixed."""
    out = np.zeros((count, 2, 2))
    for n, tangent in (along, 1.0), (across, stiffness):
        if tangent:
            each = tangent * n[:, :, None] * n[:, None, :]
            np.add.at(out, pairs[:, 0], each)
            np.add.at(out, pairs[:, 1], each)
    return out


def discs(packing, run):
    frames = sorted(Path(run).parent.glob(f"{Path(run).name}.*.dump"))
    header = lsm.read_catalogue(f"{run}.catalogue.csv").header
    dt, length = float(header["dt"]), float(header["length"])
    steps = [int(path.name.split(".")[-2]) for path in frames]
    columns = [frame_of(path) for path in frames]
    first, velocity = columns[0], np.array([frame[:, 6:8] for frame in columns])
    radius, kind, mass = first[:, 5], first[:, 1].astype(int) % 2, first[:, 5]**2
    power = (np.abs(np.fft.rfft((velocity - velocity.mean(axis=0)) * np.hanning(len(frames))[:, None, None], axis=0))**2).sum(axis=2) * mass
    frequency = np.fft.rfftfreq(len(frames), (steps[1] - steps[0]) * dt)
    short = frequency > 1 / RINGING
    line = int(np.argmax(power.sum(axis=1) * short))

    near = cKDTree(np.column_stack([first[:, 2] % length, first[:, 3]]), boxsize=[length, 0]).query_pairs(2.1, output_type="ndarray")

    def gaps(frame):
        apart = frame[near[:, 1], 2:4] - frame[near[:, 0], 2:4]
        apart[:, 0] -= length * np.round(apart[:, 0] / length)
        distance = np.hypot(*apart.T)
        return distance - radius[near].sum(axis=1), apart / distance[:, None]

    linked = (np.abs(gaps(frame_of(packing))[0]) < 2e-5) & (kind[near[:, 0]] == kind[near[:, 1]])
    gap, along = gaps(first)
    pressed = ~linked & (gap < 0)
    across = along[:, ::-1] * [-1, 1]
    held = stiffness_of(len(radius), near[linked], along[linked], across[linked], 0.0)
    held += stiffness_of(len(radius), near[pressed], along[pressed], across[pressed], KT)
    softest = np.linalg.eigvalsh(held)[:, 0]
    rows = []
    for disc in np.argsort(-power[line])[:MOST_DISCS]:
        rows.append(
            dict(run=Path(run).name, seed=header["seed"], begin=steps[0] * dt, end=steps[-1] * dt, period=1 / frequency[line],
                 line_of_short=power[line - 2:line + 3].sum() / power[short].sum(), disc=int(first[disc, 0]), radius=radius[disc],
                 share_of_line=power[line, disc] / power[line].sum(), links=int(np.sum(near[linked] == disc)),
                 pressed=int(np.sum(near[pressed] == disc)), softest=softest[disc], softer_discs=np.mean(softest < softest[disc]),
                 own_period=2 * math.pi * math.sqrt(mass[disc] / softest[disc])))
    update_table(TRAPPED, [
        "Discs that have most of the kinetic energy of the strongest line of periods below 1; softest: smallest stiffness against displacement",
        "while all others are fixed, softer_discs: share of discs for which it is smaller (faults.py discs)"
    ], rows)


# ---- series that have the spectrum of a run and nothing else of it

SPECTRUM, SURROGATES = FOLDER / "spectrum.csv", 3


def spectrum_of(postproc, folder):
    """Rows of spectrum.csv: rates of drops of the series of a run, and of series whose changes have its spectrum with random phases."""
    series, header = lsm.read_series(folder / "fault.pe.bin"), lsm.read_catalogue(folder / "fault.catalogue.csv").header
    pe, dt, rng = np.asarray(series["pe"][series["time"] >= LOADING]), float(header["dt"]), np.random.default_rng(1)
    with tempfile.TemporaryDirectory() as work:
        for number in range(1 + SURROGATES):
            path = picked_again(postproc,
                                slip_or_exchange.with_phases(pe, rng) if number else pe, dt, memory_of(header),
                                Path(work) / f"{number}.csv")
            sizes, time = lsm.read_catalogue(path)["size"], len(pe) * dt / 1000
            yield dict(run=folder.name, fault=folder.name.split("_")[0], series=f"phases {number}" if number else "run", time=time,
                       **{f"rate_{least:g}": np.sum(sizes >= least) / time
                          for least in SIZES})


# ---- bursts of single discs

BURSTS = FOLDER / "bursts.csv"
STRETCH, SHORT = 250.0, 2.0  # time units: of the stretches, and period below which motion is that of single discs


def bursts_of(postproc, folder):
    """A row of bursts.csv: stretches of the series of a run in which short periods have more than half of the variance of dPE/dt."""
    series, catalogue = lsm.read_series(folder / "fault.pe.bin"), lsm.read_catalogue(folder / "fault.catalogue.csv")
    events = catalogue[(catalogue["size"] >= 1e-4) & (catalogue["t_start"] >= LOADING)]
    dt = float(catalogue.header["dt"])
    samples, first = round(STRETCH / dt), int(np.searchsorted(series["time"], LOADING))
    frequency, window = np.fft.rfftfreq(samples, dt), np.hanning(samples)
    short, found = frequency > 1 / SHORT, []
    for begin in range(first, len(series) - samples, samples):
        change = np.diff(series["pe"][begin:begin + samples + 1])
        power = np.abs(np.fft.rfft((change - change.mean()) * window))**2 * (frequency > 0)
        start = float(series["time"][begin])
        number = np.sum((events["t_start"] >= start) & (events["t_start"] < start + STRETCH))
        found.append((start, number * 1000 / STRETCH, power[short].sum() / power.sum()))
    start, rate, share = np.array(found).T
    noisy = share > 0.5
    of = np.minimum((events["t_start"] - start[0]) // STRETCH, len(start) - 1).astype(int)
    quiet = ~noisy[of]
    times = np.diff(events["t_start"])
    calm = quiet[1:] & (np.diff(np.cumsum(noisy)[of]) == 0)  # no burst between the two drops
    lines = (folder / "fault.catalogue.csv").read_text().splitlines(keepends=True)
    kept = set(np.asarray(events["event_id"])[quiet])
    with tempfile.TemporaryDirectory() as work:
        path = Path(work) / "quiet.csv"
        path.write_text("".join(line for line in lines if not line[0].isdigit() or int(line.split(",", 1)[0]) in kept))
        rows = summary.rows_of(postproc, [folder / "fault.catalogue.csv", path], ["1e-4"], [RANGE], begin=LOADING, shortest=0)
    return dict(run=folder.name, fault=folder.name.split("_")[0], packing=catalogue.header["seed"], stretches=len(start), bursts=int(noisy.sum()),
                rate_in_bursts=np.mean(rate[noisy]) if noisy.any() else math.nan, rate_else=np.mean(rate[~noisy]), rate_largest=rate.max(),
                gamma=rows[0]["gamma_0.0001"], gamma_else=gamma_law.fit(times[calm], floc=0)[0], exponent=rows[0][f"exponent_{RANGE}"],
                exponent_else=rows[1][f"exponent_{RANGE}"])


def publish_runs(postproc, *names):
    folders = [Path(name).resolve() for name in names]
    variants = [folder for folder in folders if folder.name.split("_")[1] in VARIED]
    usual = [folder for folder in folders if folder not in variants]
    full = [folder for folder in usual if "slow" not in folder.name]
    (FOLDER / "faults").mkdir(exist_ok=True)
    for folder in full:
        new, published = folder / "fault.catalogue.csv", FOLDER / f"faults/{folder.name}.catalogue.csv.xz"
        if not published.exists() or lsm.read_catalogue(published)["t_end"].max() < lsm.read_catalogue(new)["t_end"].max():  # a longer one stays
            publish(new, published)
    find_ruptures(*full)
    update_table(VARIANTS, [
        "Runs of length 120 with another time step or width, and the usual ones of the same packings: drops >= 1e-4, slips >= 0.1 and ruptures",
        "of a work >= 0.01 in 1000 time units, exponent, gamma and B as in the article (faults.py publish)"
    ], [variant_of(postproc, folder) for folder in (*variants, *(one for one in full if one.name in USUAL_RUNS))], lambda row: row["run"])
    update_table(PICKED, [
        "Series picked again (faults.py publish): ramp, a steady rise of PE in a time unit that was added to it; rates in 1000 time units;",
        "gamma, B: by likelihood of the times above so many means, or by least squares on their density, of events of at least a size"
    ], [row for folder in usual if "_120_" in folder.name for row in rows_of_run(postproc, folder)])
    update_table(BURSTS, [
        "Stretches of 250 time units; bursts: those in which periods below 2 have more than half of the variance of dPE/dt; rates of drops >= 1e-4",
        "in 1000 time units; else: without bursts (faults.py publish)"
    ], [bursts_of(postproc, folder) for folder in full if "_120_" in folder.name], lambda row: (FAULTS.index(row["fault"]), int(row["packing"])))
    update_table(
        SPECTRUM,
        ["Drops in 1000 time units of the series of a run, and of series whose changes have its spectrum with random phases (faults.py publish)"],
        [row for folder in full if folder.name.endswith("_120_4") for row in spectrum_of(postproc, folder)])


# ---- figures of what was picked again


def of_picked(fault, velocity=USUAL, ramp=False, memory=None, packings=("11", "12", "13")):
    """Rows of picked.csv; memory: by default each run's own."""
    return [
        row for row in read(PICKED) if row["fault"] == fault and float(row["velocity"]) == velocity and
        (float(row["ramp"]) > 0) == ramp and float(row["memory"]) == (memory or float(row["own_memory"])) and row["packing"] in packings
    ]


def mean_of(rows, name, error=None):
    """Mean over rows that have this number, with its standard error, and how many these are."""
    found = [(float(row[name]), float(row[error]) if error else math.nan) for row in rows if row[name]]
    return (*(mean_and_error(*zip(*found)) if found else (math.nan, math.nan)), len(found))


def estimators():
    """Gamma and B of two faults over smallest size, memory and smallest time: a row for each, of both estimators."""
    rows = []
    for fault in ("leaky", "reflecting"):
        own = of_picked(fault)
        cells = [("smallest size", float(least), own, name, least) for name in ("0", "density") for least in SMALLEST]
        cells += [("memory", memory, of_picked(fault, memory=memory), name, "1e-4") for name in ("0", "density") for memory in MEMORIES]
        cells += [("smallest time", shortest, own, f"{shortest:g}", "1e-4") for shortest in (0, *SHORTEST)]
        for over_what, x, some, name, least in cells:
            gamma, error, n = mean_of(some, f"gamma_{name}_{least}")
            scale, scale_error, _ = mean_of(some, f"B_{name}_{least}")
            rows.append(
                dict(fault=fault, over=over_what, x=x, estimator="density" if name == "density" else "likelihood", gamma=gamma, gamma_error=error,
                     B=scale, B_error=scale_error, n=n))
    return rows


def estimators_figure(base=FOLDER / "estimators"):
    rows = estimators()
    write_table(f"{base}.csv", [
        "Gamma and B (delta 1) of drops of at least 1e-4 at length 120, packings 11 to 13: by likelihood of the times, or least squares on",
        "the density of their logarithms; smallest time: over the mean; n: packings in which the fit has one solution (faults.py)"
    ], rows)
    script = """set key Left reverse
set bars small
set yrange [-0.6:2.6]
set ylabel 'gamma'
row(name, over, way, y) = strcol(1) eq name && strcol(2) eq over && strcol(4) eq way ? y : NaN
set multiplot layout 1,3
"""
    names = (("leaky", 2, 7, 6), ("reflecting", 6, 5, 4))
    for over_what, label, axis, key in (("smallest size", "smallest drop counted",
                                         "set logscale x\nset xrange [0.7e-4:5e-3]\nset xtics ('10^{-4}' 1e-4, '10^{-3}' 1e-3)", ""),
                                        ("memory", "memory of the picker (time units)", "set xrange [0.08:5]\nset xtics (0.1, 0.3, 1, 3)",
                                         ""), ("smallest time", "smallest time fitted, over the mean",
                                               "unset logscale x\nset xrange [-0.02:0.22]\nset xtics 0.1", "top left samplen 2")):
        bars, curves = [], ["0.995 w l lw 2 dt 2 lc rgb '#666666' " + ("t 'paper'" if key else "notitle")]
        for name, lc, full, empty in names:
            for way, pt, text in ("likelihood", full, "likelihood"), ("density", empty, "least squares"):
                title = f"t '{name}, {text}'" if key else "notitle"
                if over_what == "smallest time" and way == "density":
                    curves.append(f"keyentry w lp lc {lc} lw 0.8 dt 3 pt {pt} ps point {title}")
                    continue
                where = f"table u (row('{name}','{over_what}','{way}',$3))"
                curves += [f"{where}:5 w lp lc {lc} lw 0.8 dt {1 if pt == full else 3} pt {pt} ps point {title}"]
                bars.append(f"{where}:5:6 w yerrorbars lc {lc} pt {pt} ps 0 notitle")
        script += f"{axis}\nset xlabel '{label}'\n" + (f"set key {key}\n"
                                                       if key else "unset key\n") + "plot " + ", ".join(bars + curves) + "\nunset ylabel\n"
    draw(base, script + "unset multiplot\n", 1200, 460)


# ---- ruptures: rates over size

RUPTURE_SIZES = tuple(10**(k / 4) for k in range(-12, 3))
RUPTURE_PLACES = (1, 2, 3, 4, 5, 7, 10, 14, 20, 28, 40, 56, 80, 113)


def per_length(run, chosen):
    rate, error = rate_of(run, chosen)
    return rate * 120 / run.length, error * 120 / run.length


def rupture_rows():
    rows = []
    for fault in FAULTS:
        for length in LENGTHS:
            runs = runs_of(fault, length, "slips")
            for what, column, least in [("work", "size", x) for x in RUPTURE_SIZES] + [("places", "rupture_length", x) for x in RUPTURE_PLACES]:
                if runs and least <= length:
                    # ruptures that are published have a work of 1e-3; all of them that are longer than a few places do
                    rate, error = over(
                        runs, lambda run: per_length(run, (run.events[column] >= least * (1 - 1e-9)) & (run.events["size"] >= SMALLEST_RUPTURE)))
                    rows.append(dict(fault=fault, length=length, over=what, x=least, rate=rate, error=error, packings=len(runs)))
    return rows


def ruptures_figure(base=FOLDER / "ruptures"):
    rows = rupture_rows()
    leaky = {(row["length"], row["over"], row["x"]): row for row in rows if row["fault"] == "leaky"}
    for row in rows:
        beside = leaky[row["length"], row["over"], row["x"]]
        row |= dict.fromkeys(("ratio", "ratio_error"), math.nan)
        if row is not beside and beside["rate"] and row["rate"]:
            row["ratio"], row["ratio_error"] = quotient(*((one["rate"], one["error"]) for one in (row, beside)))
    write_table(f"{base}.csv", [
        "Ruptures, in 1000 time units and 120 of the length, of at least a work of friction, or of at least so many places and a work of",
        "0.001; ratio: to those of the leaky fault of this length (faults.py)"
    ], rows)
    script = PANELS + """set key bottom left
set logscale xy
set xrange [0.8e-3:0.5]
set format x '10^{%L}'
set xlabel 'work of friction in the rupture'
row(name, y) = strcol(1) eq name && $2 == 120 && strcol(3) eq 'work' && $5 > 0 ? y : NaN
set multiplot layout 1,2
set title 'ruptures of at least this work in 1000 time units'
set yrange [0.03:100]
"""
    script += panel((4, 5, 6)) + "set title 'the same over those of the leaky fault'\nset yrange [0.2:5]\nset ytics (0.25, 0.5, 1, 2, 4)\nunset key\n"
    draw(base, script + panel((4, 8, 9), "1 w l lw 1 dt 2 lc rgb '#666666' notitle") + "unset multiplot\n", 1000, 480)


# ---- half the velocity of the plates


def velocity_rows():
    """Rates at half the velocity over those at the full one, as the picker finds them and with the loading that lacks."""
    found = {one.key: one for one in velocity_values()}
    return [{"fault": fault, "size": least} | {
        f"{kind}{ending}": x
        for kind in ("slow", "loaded") for ending, x in zip(("", "_error"), found[f"velocity.ratio.{kind}.{fault}.{least:g}"][1:3])
    } for fault in FAULTS for least in SIZES]


def velocity_figure(base=FOLDER / "velocity"):
    write_table(f"{base}.csv", [
        "Rates of drops of at least a size at half the velocity of the plates over those at the full one, length 120: as they are picked (slow),",
        "and with the loading that lacks (loaded); errors from ten parts of the time (faults.py)"
    ], velocity_rows())
    script = PANELS + """set multiplot layout 1,2
set logscale x
set xrange [0.6e-4:0.2]
set yrange [0:1.1]
set format x '10^{%L}'
set xtics 10
set xlabel 'drops of at least this size'
set ylabel 'rate over that at the full velocity'
unset key
set title 'as the picker finds them'
"""
    guides = "1 w l lw 1 dt 2 lc rgb '#666666' notitle, 0.5 w l lw 1 dt 3 lc rgb '#666666' notitle"
    script += panel((2, 3, 4), guides, 0.2) + "unset ylabel\nset key bottom left\nset title 'with the missing loading added'\n"
    script += panel((2, 5, 6), guides, 0.2)
    draw(base, script + "unset multiplot\n", 1000, 480)


# ---- the numbers of sentences


def values_of(form, measure, unit="", lengths=LENGTHS, **recorded):
    """A number for each fault and length with runs that recorded what runs_of() asks for; {} in the form of the keys is both."""
    for fault in FAULTS:
        for length in lengths:
            if runs := runs_of(fault, length, **recorded):
                yield Value(form.format(f"{fault}.{length}"), *over(runs, measure), unit, len(runs), sources(runs))


SLIPS, RUPTURES = dict(column="friction_work"), dict(kind="slips")


def ruptures_of(least):
    return lambda run: per_length(run, run.events["size"] >= least)


def ratio_values():
    """How much the faults differ, the largest rate over the smallest: at the length at which they differ most, of those where several have a rate."""
    for name, least, measure, recorded in ("slips", 0.1, lambda run: slips(run, 0.1), SLIPS), ("ruptures", 0.01, ruptures_of(0.01), RUPTURES):
        rates = [[over(runs, measure)[0] for fault in FAULTS if (runs := runs_of(fault, length, **recorded))] for length in LENGTHS]
        ratios = [max(some) / min(some) for some in rates if len(some) > 1]
        yield Value(f"ratio.{name}.most.{least}", max(ratios), n=len(ratios), source="values.csv")


def scaling_values():
    """How the characteristic size of drops and of ruptures goes with the length."""
    for fault in FAULTS:
        for name, recorded, least in ("drops", {}, 1e-3), ("ruptures", RUPTURES, 1e-2):
            paths = [run.path for length in LENGTHS for run in runs_of(fault, length, **recorded)]
            fit = scaling.scalings([scaling.load(path, LOADING) for path in paths], least)[0].fit
            yield Value(f"scaling.{name}.{fault}", fit["D"], fit["D_error"], "", len(paths), f"{Path(PUBLISHED[fault][-1]).parent}/*")


def growth_values():
    """Rate of drops of the longest faults over that of the shortest."""
    for fault in FAULTS:
        long, short = (over(runs_of(fault, length), lambda run: drops(run, 1e-4)) for length in (LENGTHS[-1], LENGTHS[0]))
        yield Value(f"ratio.drops.lengths.{fault}", *quotient(long, short), source="values.csv")


def fit_values(postproc):
    """Exponent, gamma and B of all times of drops >= 1e-4, over all packings, and of those that nobody fitted also the mean time, of each."""
    printed = {"exponent": (f"exponent_{RANGE}", 1.07, 0.07), "gamma": ("gamma_0.0001", 0.995, 0.1)}
    for fault in FAULTS:
        every = [run for length in LENGTHS for run in runs_of(fault, length)]
        rows = summary.rows_of(postproc, [run.path for run in every], ["1e-4"], [RANGE], begin=LOADING, shortest=0)
        for key, column, error in NUMBERS:
            unit = "time" if key in ("B", "mean_time") else ""
            for length in LENGTHS if key != "mean_time" else ():
                some = [(run, row) for run, row in zip(every, rows) if run.length == length]
                value, own, n = mean_of([row for _, row in some], column, error)
                if n:
                    yield Value(f"{key}.all.{fault}.{length}", value, own, unit, n, sources(run for run, _ in some))
            for run, row in zip(every, rows):
                if run.packing > 10:
                    yield Value(f"run.{key}.{fault}.{run.length}.{run.packing}", number(row, column), number(row, error), unit, 1, sources([run]))
        # the project's own tolerances, of single runs
        met = {key: [abs(float(row[column]) - value) <= by for row in rows] for key, (column, value, by) in printed.items()}
        met["B"] = [abs(math.log(float(row["B_0.0001"]) / 15.21)) <= 0.2 for row in rows]
        for key, some in {**met, "together": [all(three) for three in zip(*met.values())]}.items():
            new = [near for run, near in zip(every, some) if run.packing > 10]
            yield Value(f"within.{key}.{fault}", sum(some), n=len(rows), source="values.csv")
            yield Value(f"within.new.{key}.{fault}", sum(new), n=len(new), source="values.csv")
        yield Value(f"within.runs.{fault}", len(rows))
        yield Value(f"within.new.runs.{fault}", sum(run.packing > 10 for run in every))


def velocity_values():
    """Rates at half the velocity of the plates over those at the full one: as picked (slow), and with the loading that lacks (loaded)."""
    for fault in FAULTS:
        packings = [row["packing"] for row in read(PICKED) if row["fault"] == fault]
        full, slow, loaded = ({row["packing"]: row
                               for row in of_picked(fault, velocity, ramp, packings=packings)}
                              for velocity, ramp in ((USUAL, False), (USUAL / 2, False), (USUAL / 2, True)))
        paired = sorted(full.keys() & slow.keys() & loaded.keys(), key=int)
        for least in SIZES if paired else ():
            for kind, rows in ("slow", slow), ("loaded", loaded):
                ratios = [quotient(*([float(of[k][f"rate_{least:g}{end}"]) for end in ("", "_error")] for of in (rows, full))) for k in paired]
                yield Value(f"velocity.ratio.{kind}.{fault}.{least:g}", *mean_and_error(*zip(*ratios)), "", len(paired), "picked.csv")


def estimator_values():
    """Least and largest gamma over the smallest size, by likelihood."""
    cells = {}
    for row in estimators():
        if (row["over"], row["estimator"]) == ("smallest size", "likelihood"):
            cells.setdefault(row["fault"], []).append(row["gamma"])
    for fault, some in cells.items():
        for name, choose in ("least", min), ("most", max):
            yield Value(f"estimator.gamma.{fault}.smallest_size.likelihood.{name}", choose(some), n=len(some), source="estimators.csv")


def burst_values():
    for row in read(BURSTS):
        for key in "stretches bursts rate_in_bursts rate_else rate_largest gamma gamma_else exponent exponent_else".split():
            if row[key]:
                yield Value(f"burst.{key}.{row['fault']}.{row['packing']}", float(row[key]), source="bursts.csv")
    disc = read(TRAPPED)[0]
    for key in ("period", "share_of_line"):
        yield Value(f"trapped.1.{key}", number(disc, key), source="trapped.csv")


def threshold_values():
    """Ruptures >= 0.01 of length 120 with other thresholds."""
    tests = [row for row in read(TESTED) if float(row["length"]) == 120]
    for fault in FAULTS:
        for slipping, merged in TESTS:
            of = [row for row in tests if (row["fault"], float(row["slipping"]), float(row["merged"])) == (fault, slipping, merged)]
            value, error, n = mean_of(of, "rate_0.01")
            yield Value(f"ruptures.test.{fault}.{slipping}.{merged}.rate_0.01", value, error, "", n, "ruptures_tests.csv")


def variant_values():
    """Drops >= 1e-4 with blocks twice as wide over those of the usual width."""
    rows, ratios = {row["run"]: row for row in read(VARIANTS)}, {}
    for usual in USUAL_RUNS:
        fault, length, packing = usual.split("_")
        if wide := rows.get(f"{fault}_wide_{length}_{packing}"):
            ratios.setdefault(fault, []).append(quotient(*((float(row["drops"]), float(row["drops_error"])) for row in (wide, rows[usual]))))
    for fault, some in ratios.items():
        yield Value(f"variant.drops.wide.{fault}", *mean_and_error(*zip(*some)), "", len(some), "variants.csv")


def work(run):
    """Work of friction in 1000 time units."""
    total = run.events["friction_total"]
    return float(total[-1] - total[0]) / run.time


def share_of_large(run):
    """The share of slips >= 0.1 in it."""
    of = (run.events["size"] >= 0.1) & (excess_of(run.path) > slip.SLIP)
    return float(np.sum(run.events["friction_work"][of])) / work(run) / run.time


def slip_of_middle(run, null=None):
    """Share of the drops of 0.001 to 0.1 that are slip, beyond what a null has: random stretches of the run, or, without it, as many as
    have an excess below -0.5, since waves take as often as they give."""
    of = (run.events["size"] >= 1e-3) & (run.events["size"] < 0.1)
    excess = excess_of(run.path)[of]
    return slip.slip_share(excess, run.events[null][of]) if null else np.mean(excess > slip.SLIP) - np.mean(excess < -slip.SLIP)


def spectrum_values():
    """Rates of series with the spectrum of a run over those of the run."""
    rows = read(SPECTRUM)
    for fault in ("leaky", "reflecting"):
        own, others = ([row for row in rows if row["fault"] == fault and (row["series"] == "run") == is_run] for is_run in (True, False))
        for least in SIZES:
            value, error, n = mean_of(others, f"rate_{least:g}")
            full = float(own[0][f"rate_{least:g}"])
            yield Value(f"spectrum.ratio.{fault}.{least:g}", value / full, error / full, "", n, "spectrum.csv")


CROSSING = 15  # time of a P-wave through the blocks


def after_crossings(run):
    """Share of drops that begin within a crossing after one of at least 0.01, over that with sizes shuffled."""
    events, rng = run.events[run.events["size"] >= 1e-4], np.random.default_rng(1)
    starts, large = events["t_start"], events["size"] >= 1e-2
    rng.uniform(size=40000)  # the published numbers come after these

    def near(large):
        ends = np.sort(events["t_end"][large])
        return np.mean(starts - np.append(-np.inf, ends)[np.searchsorted(ends, starts, "right")] < CROSSING)

    return near(large) / np.mean([near(rng.permutation(large)) for _ in range(20)])


def cut_values(postproc):
    """Gamma of times above 2.5 memories of the picker."""
    for fault in FAULTS:
        for length in (120, 945):
            runs, rows = runs_of(fault, length), []
            for run in runs:
                mean = 1000 / drops(run, 1e-4)[0]
                rows += summary.rows_of(postproc, [run.path], ["1e-4"], begin=LOADING, shortest=2.5 * memory_of(run.events.header) / mean)
            yield Value(f"cut.gamma.{fault}.{length}", *mean_of(rows, "gamma_0.0001", "gamma_error_0.0001")[:2], "", len(runs), sources(runs))


def all_values(postproc):
    return [
        *values_of("rate.drops.{}.0.0001", lambda run: drops(run, 1e-4), "1/1000"),
        *values_of("rate.slips.{}.0.1", lambda run: slips(run, 0.1), "1/1000", **SLIPS),
        *(value for least in SIZES[1:] for value in values_of(f"ruptures.rate.{{}}.{least:g}", ruptures_of(least), "1/1000/120", **RUPTURES)),
        *values_of("budget.work.{}", work, "energy/1000", **SLIPS), *values_of("budget.share.{}", share_of_large, **SLIPS),
        *values_of("share.mirror.{}", slip_of_middle, **SLIPS),
        *values_of("share.random.{}", lambda run: slip_of_middle(run, "chance"), column="chance"),
        *values_of("crossing.shuffled.{}", after_crossings), *ratio_values(), *growth_values(), *scaling_values(), *fit_values(postproc),
        *velocity_values(), *estimator_values(), *burst_values(), *threshold_values(), *variant_values(), *spectrum_values(), *cut_values(postproc)
    ]


if __name__ == "__main__":
    if sys.argv[1:2] == ["publish"] and len(sys.argv) > 3:
        sys.exit(publish_runs(*sys.argv[2:]))
    if sys.argv[1:2] == ["discs"] and len(sys.argv) == 4:
        sys.exit(discs(*sys.argv[2:]))
    if len(sys.argv) != 1:
        sys.exit(__doc__)
    for figure in rates_figure, velocity_figure, estimators_figure, ruptures_figure:
        figure()
