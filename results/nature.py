#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Models ranked by the distance of their inter-event times, over their mean, to those of earthquakes.

nature.py POSTPROC                                      makes nature.csv, .png, .svg and .table.csv
nature.py POSTPROC CATALOGUE --threshold SIZE... [--from TIME] --json FILE   the numbers of one catalogue, for a study

Rows are labels above a smallest size: those of earthquakes first, then by distance. Numbers are means over the catalogues of a
label with their standard errors; those of one catalogue have its own errors.
  distance       Kolmogorov-Smirnov, of the times over their mean to those of the first row; error: circular block bootstrap
  gamma          of the generalised gamma density with delta = 1, of `postproc intervals --rescale`
  burstiness     (r - 1) / (r + 1) of the standard deviation over the mean r, in the form for a finite number of times
  memory         correlation of each time with the next
  after          events within a mean time after the end of the largest 2 %, over that of all others
  b              Aki's, of the magnitudes above the smallest one, (2/3) log10 of the size
"""
import argparse
import csv
import datetime
import functools
import lzma
import math
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from lsm import LOADING  # noqa: E402
from lsm.analysis import distance, distance_of_counts, events_of, mean_and_error, numbers_of, over_mean  # noqa: E402
from lsm.drawing import draw  # noqa: E402
from lsm.program import run  # noqa: E402
from lsm.scaling import block_length  # noqa: E402
from lsm.tables import read, write_json, write_table  # noqa: E402

HERE = Path(__file__).resolve().parent
NATURE = "Southern California"
CALIFORNIA = HERE.parent / "inputs/seismicity/southern-california.csv.xz"
PERIOD = ("1984-01-01", "1986-07-02T12:00")  # of the paper's Table 1: 1984.0 to 1986.5
MAGNITUDES, SIZES = (2.0, 2.5, 3.0), ("1e-4", "1e-3", "1e-2", "1")
FEWEST = 50  # events of a catalogue that is used
LARGE = 0.02  # share of the events that count as large
REPLICAS = 200
CATALOGUES = [(f"fault {length}", f"campaign/fault_{length}_{{}}.catalogue", 2 if length > 945 else 3) for length in (120, 240, 480, 945, 1440, 1890)]
CATALOGUES += [(f"ruptures of fault {length}", f"campaign/fault_{length}_{{}}.ruptures", 3) for length in (120, 480, 945)]
CATALOGUES += [("slider 1928", "catalogues/slider_ours_1928_seed_{}.catalogue", 3),
               ("ruptures of slider 1928", "catalogues/slider_ruptures_1928_seed_{}.catalogue", 3)]
CATALOGUES += [(f"slider {text}", f"walk/{name}-512_{{}}.catalogue", 5)
               for text, name in (("springs", "chain"), ("elastic blocks", "bulk"), ("and radiation", "radiating"), ("and roughness", "rough"),
                                  ("and slow plate", "slow"))]
CATALOGUES += [(f"fault 120 {name}", f"walk/fault-{name}_{{}}.catalogue", 5) for name in ("viscous", "weakening")]
SUMS = {"3 faults 480 apart": (480, 3), "2 faults 945 apart": (945, 2)}  # of independent faults, as long together as those of 1440 and 1890
MODELS = {label: [HERE / f"{name.format(n + 1)}.csv.xz" for n in range(many)] for label, name, many in CATALOGUES}


def earthquakes():
    """Times (days) and magnitudes of Southern California in PERIOD, in order of time."""
    found = []
    for row in read(CALIFORNIA):
        if PERIOD[0] <= row["time"] < PERIOD[1]:
            day, clock = row["time"].rstrip("Z").split("T")
            hours, minutes, seconds = map(float, clock.split(":"))  # the catalogue has seconds of 60
            seconds += 3600 * hours + 60 * minutes
            found.append((datetime.date.fromisoformat(day).toordinal() + seconds / 86400, float(row["mag"])))
    return np.array(sorted(found, key=lambda one: one[0])).T  # in the order of the file where times are equal


# ---- error of a distance


@functools.cache
def random_numbers(count):
    """Uniform numbers of the 64-bit Mersenne Twister (Nishimura and Matsumoto 2004) with seed 1, those of the published errors."""
    n, m = 312, 156
    state = [1]
    for i in range(1, n):
        state.append((6364136223846793005 * (state[-1] ^ (state[-1] >> 62)) + i) % 2**64)
    x, blocks = np.array(state, np.uint64), []
    upper, one = np.uint64(0xffffffff80000000), np.uint64(1)
    for _ in range(-(-count // n)):
        for part, other in ((slice(0, m), slice(m, n)), (slice(m, n), slice(0, m))):
            y = (x[part] & upper) | (np.roll(x, -1)[part] & ~upper)
            x[part] = x[other] ^ (y >> one) ^ np.where(y & one, np.uint64(0xb5026f5aa96619e9), np.uint64(0))
        y = x ^ ((x >> np.uint64(29)) & np.uint64(0x5555555555555555))
        y ^= (y << np.uint64(17)) & np.uint64(0x71d67fffeda60000)
        y ^= (y << np.uint64(37)) & np.uint64(0xfff7eee000000000)
        blocks.append(((y ^ (y >> np.uint64(43))) >> np.uint64(11)) * 2.0**-53)
    return np.concatenate(blocks)[:count]


def distance_and_error(first, second, replicas):
    """Distance of two series over their means, and its error by resampling circular blocks of consecutive values."""
    pair = [(*np.unique(one, return_inverse=True), max(1, int(block_length(one - np.mean(one))))) for one in (first, second)]
    again, used = [], 0
    uniform = random_numbers(2**19)
    for _ in range(replicas):
        parts = []
        for values, place, length in pair:
            n, draws = len(place), -(-len(place) // length)
            at = ((uniform[used:used + draws] * n).astype(int)[:, None] + np.arange(length)).ravel()[:n] % n
            used += draws
            counts = np.bincount(place[at], minlength=len(values))
            parts += [values / (values @ counts / n), counts]
        again.append(distance_of_counts(*parts))
    return distance(over_mean(first), over_mean(second)), np.std(again, ddof=1) if replicas > 1 else math.nan


# ---- rows


def sample_of(starts, ends, sizes, least):
    """Times over their mean, magnitudes above the smallest one, and numbers of one catalogue: {name: (value, error)}."""
    starts, ends, sizes = (one[sizes >= least] for one in (starts, ends, sizes))
    if not starts[-1] > starts[0]:
        raise ValueError("all events start at the same time")
    times, magnitudes = over_mean(np.diff(starts)), np.log10(sizes / least) / 1.5
    n, r, mean = len(times), np.std(times), np.mean(np.diff(starts))
    up, down = math.sqrt(n + 1), math.sqrt(n - 1)
    large = sizes >= np.sort(sizes)[::-1][int(LARGE * n)]
    after = np.searchsorted(starts, ends + mean, "left") - np.maximum(np.searchsorted(starts, ends, "left"), np.arange(n + 1) + 1)
    b = 1 / (math.log(10) * np.mean(magnitudes))
    numbers = dict(burstiness=(up * r - down) / ((up - 2) * r + down), memory=np.corrcoef(times[:-1], times[1:])[0, 1],
                   after=np.mean(after[large]) / np.mean(after[~large]) if after[~large].any() else math.nan)  # yapf: disable
    numbers = {key: (value, math.nan) for key, value in numbers.items()}
    return times, magnitudes, numbers | {"b": (b, math.log(10) * b**2 * np.std(magnitudes, ddof=1) / math.sqrt(len(magnitudes)))}


def fits_of(postproc, paths, sizes, *words):
    """Of each catalogue, the fit for each smallest size, where events are complete."""
    thresholds = [word for size in sizes for word in ("--threshold", size)]
    numbers = numbers_of(postproc, "intervals", *paths, *words, *thresholds, "--rescale", "--method", "likelihood", "--delta", 1, "--replicas", 0,
                         "--shuffles", 0, "--no-picture")
    fits = iter(numbers["fits"])
    return [[next(fits) for _ in sizes] for _ in paths]


def row_of(label, fits, samples, reference, replicas):
    """A row of samples: label, number of catalogues, their times and magnitudes, and numbers with errors."""
    row = dict(label=label, threshold=fits[0]["threshold"], catalogues=len(samples), events=sum(len(one[1]) for one in samples))
    numbers = []
    for fit, (times, magnitudes, own) in zip(fits, samples):
        gamma = [math.nan if fit[key] is None else fit[key] for key in ("gamma", "gamma_error")]
        numbers.append(own | dict(gamma=gamma, distance=distance_and_error(reference[0], times, replicas) if reference else (math.nan, math.nan)))
    for key in numbers[0]:
        values, errors = zip(*(one[key] for one in numbers))
        row[key] = mean_and_error(values, errors if len(values) != 2 else ())  # of two, half of the difference: both numbers are known
    return row | {key: np.concatenate([one[k] for one in samples]) for k, key in enumerate(("times", "magnitudes"))}


def rows_of(postproc, models, sizes=SIZES, magnitudes=MAGNITUDES, begin=LOADING, replicas=REPLICAS):
    """All rows. models: {label: paths}. \\raises ValueError if the earthquakes are too few, or a smallest size is 0"""
    if not all(float(size) > 0 for size in sizes):
        raise ValueError("--threshold 0 has no magnitude, expected a larger size")
    days, above = earthquakes()
    sizes_of = np.array([10**(1.5 * m) for m in above])  # as postproc has them, to the last digit
    groups = {NATURE: ([(days, days, sizes_of)], fits_of(postproc, [CALIFORNIA], [f"M{m:g}" for m in magnitudes], "--from", PERIOD[0], "--to",
                                                            PERIOD[1]))}  # yapf: disable
    fits = iter(fits_of(postproc, [path for paths in models.values() for path in paths], sizes, "--from", begin))
    for label, paths in models.items():
        some = [events_of(path, begin) for path in paths]
        groups[label] = [(events["t_start"], events["t_end"], events["size"]) for events in some], [next(fits) for _ in paths]
    rows, reference = [], None
    for label, (catalogues, fits) in groups.items():
        least = [one["threshold"] for one in fits[0]]
        counts = [np.count_nonzero(catalogues[0][-1] >= size) for size in least]
        for k, size in enumerate(least):
            # Where the catalogue begins above this smallest size, the next one selects the same events.
            if k + 1 < len(least) and counts[k] == counts[k + 1]:
                continue
            used = [n for n, (*_, all_sizes) in enumerate(catalogues) if np.count_nonzero(all_sizes >= size) >= FEWEST]
            if used:
                samples = [sample_of(*catalogues[n], size) for n in used]
                rows.append(row_of(label, [fits[n][k] for n in used], samples, reference, replicas))
                reference = reference or samples[0]
            elif not rows:
                raise ValueError(f"{label}: fewer than {FEWEST} events to compare with")
    return rows[:1] + sorted(rows[1:], key=lambda row: math.inf if math.isnan(row["distance"][0]) else row["distance"][0])


# ---- tables and picture


def from_text(row):
    return f"magnitudes >= {math.log10(row['threshold']) / 1.5:.3g}" if row["label"] == NATURE else f"sizes >= {row['threshold']:.4g}"


def table(rows):
    return [{key: row[key] for key in ("label", "threshold", "catalogues", "events")}
            | {key + end: x for key in ("distance", "gamma", "burstiness", "memory", "after", "b") for end, x in zip(("", "_error"), row[key])}
            for row in rows]  # yapf: disable


def curves(rows):
    """The points of the picture, as (panel, number of the row, x, y, error, name), of the nearest row of each label."""
    out, seen = [], set()
    for number, row in enumerate(rows, 1):
        name = f"{row['label']}, {from_text(row)}"

        def add(panel, x, y, error):
            error = 0.0 if math.isnan(error) else error  # gnuplot skips points without one
            out.append(dict(panel=panel, curve=number, x=x, y=y, error=error, label=name))

        if number > 1:
            add("distance", row["distance"][0], -number, row["distance"][1])  # y: rank among all rows; the picture has fewer
        if row["label"] in seen:
            continue
        seen.add(row["label"])
        times = row["times"][row["times"] > 0]
        edges = 10.0**(0.2 * np.arange(math.floor(5 * math.log10(times.min())), math.floor(5 * math.log10(times.max())) + 2))
        counts, width = np.histogram(times, edges)[0], np.diff(edges)
        for low, high, count, wide in zip(edges, edges[1:], counts, width):
            if count > 2:
                add("times", math.sqrt(low * high), count / (len(times) * wide), math.sqrt(count) / (len(times) * wide))
        magnitudes = np.sort(row["magnitudes"])
        for k in range(int(magnitudes[-1] / 0.1 + 1e-9) + 1):
            add("sizes", 0.1 * k, 1 - np.searchsorted(magnitudes, 0.1 * k - 1e-9) / len(magnitudes), 0.0)
        add("plane", row["memory"][0], *row["burstiness"])
    return out


CURVES = (NATURE, "fault 1890", "fault 120", "ruptures of fault 480", "slider 1928", "ruptures of slider 1928")


def picture(rows, base):
    """Distances of the nearest row of each label and of all earthquakes; times, magnitudes and clustering of some of them, in colour."""
    drawn, seen = [], set()
    for number, row in enumerate(rows, 1):
        label = row["label"]
        first = label not in seen
        if not first and label != NATURE:
            continue
        seen.add(label)
        name = label + (", M " if label == NATURE else ", ") + from_text(row).split(" ", 1)[1]
        style = f"lc rgb '#000000' lw {2 if first else 1} dt 1 pt {7 if first else 6}" if label == NATURE else (
            f"lt {CURVES.index(label)} lw 1.5 pt {(7, 5, 9, 11, 13)[CURVES.index(label) - 1]}" if label in CURVES else "lc rgb '#888888' pt 6")
        drawn.append((number, name, style, first and label in CURVES))
    height = max(900, 130 + 34 * len(drawn))
    entries = [(name, style) for _, name, style, shown in drawn if shown]
    legend, top = 26 * (1 + len(entries)) / height + 0.01, 0.97  # the key is below the panels on the right
    high = (top - 0.09 - legend) / 0.77

    def panel(left, right, bottom, above, x, y, more):
        return f"""unset logscale; set format '%g'; set xtics autofreq; set ytics autofreq; set autoscale; {more}
set lmargin at screen {left}; set rmargin at screen {right}; set bmargin at screen {bottom}; set tmargin at screen {above}
set xlabel "{x}"; set ylabel "{y}"
"""

    place = {number: -n for n, (number, *_) in enumerate(drawn, 1)}

    def plot(name, values, style):
        return "plot " + ", \\\n".join(f"table using (at('{name}', {number})):{values.format(place[number])} with {style.format(own)} notitle"
                                       for number, _, own, shown in drawn if (number > 1 if name == "distance" else shown))

    ticks = ", ".join(f'"{name}" {place[number]}' for number, name, *_ in drawn[1:])
    logs = "set logscale y; set format y '10^{%L}'; set yrange "
    corral = "[0.003:10] '+' using 1:(0.5*$1**(-0.33)*exp(-$1/1.58)) with lines lt 8 dt (6,4) lw 2 notitle"
    keys = "".join(f", keyentry with linespoints {style} title \"{name}\"" for name, style in entries)
    draw(base, "\n".join([
        "at(p, k) = strcol(1) eq p && $2 == k ? $3 : NaN\nset multiplot\nset key off",
        panel(0.36, 0.58, 0.1, 0.97, "distance of the inter-event times", "",
              f"set xrange [0:*]; set yrange [{-len(drawn) - 0.7}:-1.3]; set xtics 0.2; set ytics ({ticks})"),
        plot("distance", "({}):5", "xerrorbars {} ps 1.3"),
        panel(0.68, 0.98, top - 0.17 * high, top, "inter-event time / mean", "probability density",
              f"{logs}[1e-4:1e2]; set logscale x; set format x '10^{{%L}}'; set xrange [1e-3:1e2]"),
        plot("times", "4", "linespoints {} ps 0.7") + ", " + corral,
        panel(0.68, 0.98, top - 0.47 * high, top - 0.30 * high, "magnitude above the smallest", "share of the events",
              f"{logs}[1e-4:1]; set xrange [0:4]"),
        plot("sizes", "4", "linespoints {} pi 3 ps 0.8"),
        panel(0.68, 0.98, top - 0.77 * high, top - 0.60 * high, "memory coefficient", "burstiness (finite form)",
              "set xrange [-0.3:0.4]; set yrange [-0.4:1]"),
        f"set key on at screen 0.99, screen {legend} right top horizontal maxcols 1 Left reverse samplen 3 spacing 1.15",
        plot("plane", "4:5", "yerrorbars {} ps 1.4") + keys + ", keyentry with lines lt 8 dt (6,4) lw 2 title 'earthquakes, Corral (2004)'",
        "unset multiplot"
    ]), 1150, height)  # yapf: disable


def write(rows, base):
    """The tables BASE.csv and BASE.table.csv."""
    write_table(f"{base}.table.csv", [
        "distance: Kolmogorov-Smirnov distance of the inter-event times over their mean to those of the first row; after: events within a mean time "
        "after the end of large ones, over that of all others; b: Aki",
        "errors: from the scatter between catalogues of a label (of two, half of their difference), or for one catalogue its own (distances: blocks of "
        "consecutive values resampled)"
    ], table(rows))
    write_table(f"{base}.csv", [
        "panels: distance (rank), and of the nearest row of each label times (density over time / mean), sizes (share of the events with magnitudes "
        "of at least x above the smallest), plane (burstiness, memory)"
    ], curves(rows))


def together(paths, out):
    """A catalogue of the events of several faults, each at its time, up to the end of the shortest. As those of ruptures, they overlap."""
    tables = []
    for path in paths:
        with lzma.open(path, "rt") as file:
            lines = file.read().splitlines()
        head = [line for line in lines if line.startswith("#")]
        tables.append(list(csv.DictReader(lines[len(head):])))
    end = min(float(table[-1]["t_start"]) for table in tables)
    events = sorted((row for row in sum(tables, []) if float(row["t_start"]) <= end), key=lambda row: (float(row["t_end"]), int(row["step_end"])))
    rows = [",".join((row | {"event_id": str(number)}).values()) for number, row in enumerate(events)]
    out.write_text("\n".join([*head, "# events = ruptures", ",".join(events[0]), *rows, ""]))
    return [out]


def published(postproc):
    """The rows of the published catalogues."""
    with tempfile.TemporaryDirectory() as folder:
        sums = {label: together(MODELS[f"fault {length}"][:many], Path(folder) / f"{length}.csv") for label, (length, many) in SUMS.items()}
        return rows_of(postproc, MODELS | sums)


def main(postproc, catalogue, threshold, begin, json_file):
    if catalogue is None:
        rows = published(postproc)
        write(rows, HERE / "nature")
        picture(rows, HERE / "nature")
    else:
        rows = rows_of(postproc, {catalogue.name: [catalogue]}, threshold or SIZES, MAGNITUDES[:1], begin)
        write_json(json_file, models=table(rows))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("postproc", metavar="POSTPROC", type=Path)
    parser.add_argument("catalogue", metavar="CATALOGUE", type=Path, nargs="?")
    parser.add_argument("--threshold", metavar="SIZE", action="append")
    parser.add_argument("--from", metavar="TIME", type=float, dest="begin", default=LOADING)
    parser.add_argument("--json", metavar="FILE", dest="json_file")
    run(main, parser)
