# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the ruptures of faults †: catalogues of compute lsm/events with ruptures, and slip histories.

    python3 -m lsm.ruptures fault.ruptures.csv --history fault.slip.bin -o BASE

Of all catalogues: ruptures by length (BASE-lengths) and moment (BASE-moments), and moment against length (BASE-length) with a fit for each
label, so that runs of one model share a label. With the slip history of the first catalogue's run: the slip velocity in space and time
with the ruptures outlined (BASE-spacetime), and the rupture of the largest moment in detail (BASE-event); of a plane, maps of that
rupture, of its slip (BASE-slip), the time at which it came (BASE-time) and its largest slip velocity (BASE-rate); of both its moment
rate (BASE-momentrate). Moment rates of all ruptures, and their energies: lsm.sources. Each is a table, BASE-NAME.csv, and its picture,
.png and .svg. Quantities are in model units.
"""
import argparse
import math
from typing import NamedTuple

import numpy as np

import lsm
from lsm.drawing import KEY, Figure, axis, draw_all, quote
from lsm.history import History
from lsm.program import add_time_window, run
from lsm.tables import write_json

COLUMNS = ["slip_moment", "rupture_length", "x_hypocentre", "x_begin", "stress_drop"]
FEWEST = 3  # ruptures for a fit
FEWEST_BINS = 5  # of a rupture in fits of moment against length: shorter ones lie off the line of the others
PARTS = 10  # of the time of each catalogue, of which one at a time is left out for the errors of fits
MOST_ROWS, MOST_COLUMNS, MOST_OUTLINES = 700, 1000, 300  # of the picture of slip velocities
FLAME = "set palette defined (0 '#ffffff', 1 '#fff3c4', 2 '#fdc86b', 3 '#f3883c', 4 '#c7443c', 5 '#7a1f63', 6 '#1d0b3a')\n"
VELOCITIES = FLAME + """set cbrange [0:3]
set cbtics ('1' 0, '10' 1, '100' 2, '1000' 3)
set cblabel 'Slip velocity / driving velocity' offset 1.5
unset grid
"""
MOMENT, LENGTH, PLACE = "Slip moment (model units)", "Length of the rupture (model units)", "Position along the fault (model units)"


class Catalogue(NamedTuple):
    path: str
    label: str
    events: lsm.Table
    length: float  # of the fault

    def number(self, key, otherwise=math.nan):
        """A positive number of the header."""
        try:
            value = float(self.events.header[key])
        except (KeyError, ValueError):
            return otherwise
        return value if value > 0 else otherwise

    @property
    def plane(self):
        return "slip_bin_dip" in self.events.header

    def whole(self, events):
        """Whether each slipped along the whole fault."""
        return np.asarray(events["rupture_length"] > self.length * (1 - 1e-9))


def load(path, label=None, begin=-math.inf, end=math.inf):
    """A catalogue of ruptures, those that start at `begin` or later and before `end`. \\raises ValueError"""
    events = lsm.read_catalogue(path)
    head = events.header
    if head.get("model") != "lsm" or head.get("events") != "ruptures" or not set(COLUMNS) <= set(events.dtype.names):
        raise ValueError(f"{path}: no catalogue of ruptures of a fault, expected one of compute lsm/events with ruptures")
    events = events[(events["t_start"] >= begin) & (events["t_start"] < end)]
    one = Catalogue(path, label, events, math.nan)
    length = one.number("length")
    return one._replace(length=length, label=label or f"fault, length {length:g}")


# ---- numbers by length and moment


def time_of(one):
    """From the first start to the last end."""
    return one.events["t_end"].max(initial=-math.inf) - one.events["t_start"].min(initial=math.inf)


def densities(one, column):
    """lo, hi, centre, count and density of the bins: ruptures per time, length of the fault, and length or moment.

    Moments are counted in ten bins a decade. Lengths are whole numbers of bins of the fault, of which a bin of the density covers as
    many as its width allows.
    """
    values = one.events[column][one.events[column] > 0]
    unit = time_of(one) * one.length
    if not len(values) or not unit > 0:
        return np.zeros((5, 0))
    if column == "slip_moment":
        number = np.floor(np.round(10 * np.log10(values), 9)).astype(int)
        edges = 10.0**((number.min() + np.arange(np.ptp(number) + 2)) / 10)
        centre, count = np.sqrt(edges[:-1] * edges[1:]), np.bincount(number - number.min())
    else:
        bin, edges = one.number("slip_bin", 1.0), [1]
        whole = np.maximum(1, np.rint(values / bin))
        while edges[-1] <= whole.max():
            edges.append(max(edges[-1] + 1, round(10**0.1 * edges[-1])))
        edges = np.array(edges)
        centre = np.sqrt(edges[:-1] * (edges[1:] - 1.0)) * bin
        edges = (edges - 0.5) * bin
        count = np.histogram(whole * bin, edges)[0]
    return edges[:-1], edges[1:], centre, count, count / (unit * np.diff(edges))


def smallest_moment(one):
    """Moment of one bin that slips at the threshold velocity for one interval; NaN: not known."""
    return math.prod(one.number(key) for key in ("modulus", "slip_velocity", "interval", "dt", "slip_bin")) * one.number("slip_bin_dip", 1.0)


def density_figure(catalogues, ending, column):
    rows, curves, x, y = [], [], [], []
    for number, one in enumerate(catalogues, 1):
        bins = densities(one, column)
        lo, hi, centre, count, density = bins
        error = np.sqrt(count) * np.divide(density, count, out=np.zeros_like(density), where=count > 0)
        rows += [[number, one.length, *row, one.label] for row in zip(lo, hi, centre, count.astype(int), density, error)]
        x, y = [*x, *centre[count > 0]], [*y, *density[count > 0]]
        if len(lo):
            bar = f"table using (row({number})):($7-$8 > 0.1*$7 ? $7-$8 : 0.1*$7):(0):($7+$8-($7-$8 > 0.1*$7 ? $7-$8 : 0.1*$7))"
            curves.append(f"{bar} with vectors heads size screen 0.003,90 lt {number} lw 0.8 notitle")
            curves.append(f"table using (row({number})):7 with points lt {number} title {quote(f'{one.label} ({int(count.sum())} ruptures)')}")
    if not rows:
        raise ValueError("no ruptures in any catalogue, nothing to draw")
    what, unit = ("moment", MOMENT) if column == "slip_moment" else ("length", LENGTH)
    limit = smallest_moment(catalogues[0])
    if column == "slip_moment" and limit > min(x):
        curves.append(f"'+' using ({limit}):({min(y)}):(0):({max(y) - min(y)}) every ::::0 with vectors nohead lc rgb '#777777' lw 1.6 dt (6,4) "
                      "title 'detection limit: one bin in one interval'")
    script = KEY + axis("x", unit, min(x), max(x), True) + axis("y", f"Ruptures / (time, fault length, {what})", min(y), max(y), True)
    return Figure(ending, [f"ruptures per time, length of the fault and {what}; errors: Poisson"],
                  "curve,length,bin_lo,bin_hi,centre,count,density,error,label", rows,
                  f"{script}row(k) = $1 == k && $6 > 0 ? $5 : NaN\nplot {', '.join(curves)}", (900, 530 + 23 * len(catalogues)))


# ---- moment against length


class Fit(NamedTuple):
    """Least-squares line through logarithms, y = 10^intercept x^slope; scatter in decades. error: of the slope, by a jackknife over parts of
    the data, or as if these were independent"""
    n: int
    slope: float
    error: float
    intercept: float
    scatter: float

    def text(self, what):
        return f"{what}: slope {self.slope:.4g} ± {self.error:.2g}, scatter {self.scatter:.2g} decades (n = {self.n})"

    def line(self, colour, what):
        title = quote(f"{what}: slope {self.slope:.3g} ± {self.error:.1g}")
        return f"10**({self.intercept:.15g} + {self.slope:.15g} * log10(x)) with lines lc rgb '{colour}' lw 1.6 title {title}"


def fit(x, y, part=None):
    """part: number of the part of the data to which each pair belongs \\raises ValueError for too few different values"""
    x, y = np.log10(x), np.log10(y)
    n = len(x)
    spread = np.sum((x - np.mean(x))**2) if n else 0.0
    if n < FEWEST or not spread > 1e-12 * n:
        raise ValueError(f"{n} ruptures for a fit, expected at least {FEWEST} of different sizes")
    slope, intercept = np.polyfit(x, y, 1)
    rest = np.sum((y - intercept - slope * x)**2)
    error, parts = math.sqrt(rest / (n - 2) / spread), [] if part is None else np.unique(part)
    if len(parts) > 2:
        others = [np.polyfit(x[part != one], y[part != one], 1)[0] for one in parts]
        error = math.sqrt(np.var(others) * (len(others) - 1))
    return Fit(n, slope, error, intercept, math.sqrt(rest / n))


class Relation(NamedTuple):
    """The ruptures of positive moment of all catalogues with one label; whole: those of the whole fault. fit: or why there is none"""
    label: str
    catalogues: list
    length: np.ndarray
    moment: np.ndarray
    whole: np.ndarray
    smallest: float  # length in the fit
    fit: Fit | str


def relations_of(catalogues, smallest=None):
    """A Relation for each label. smallest: length, or FEWEST_BINS bins of each catalogue"""
    for label in dict.fromkeys(one.label for one in catalogues):
        some, columns = [one for one in catalogues if one.label == label], []
        for number, one in enumerate(some):
            events = one.events[one.events["slip_moment"] > 0]
            start = events["t_start"]
            begin, lasting = start.min(initial=math.inf), np.ptp(start) if len(start) else 0.0
            part = PARTS * number + np.minimum(PARTS - 1, (start - begin) / (lasting or 1.0) * PARTS).astype(int)
            columns.append((events["rupture_length"], events["slip_moment"], one.whole(events), part))
        length, moment, whole, part = (np.concatenate(column) for column in zip(*columns))
        least = max(FEWEST_BINS * one.number("slip_bin", 1.0) for one in some) if smallest is None else smallest
        used = ~whole & (length >= least * (1 - 1e-9))
        try:
            found = fit(length[used], moment[used], part[used])
        except ValueError as error:
            found = str(error)
        yield Relation(label, some, length, moment, whole, least, found)


def as_json(relation):
    """The numbers of a label, a dict: of all its ruptures, and of the fit, null with `why` where there is none."""
    some = relation.catalogues
    events, unit = np.concatenate([one.events["slip_moment"] for one in some]), sum(time_of(one) * one.length for one in some)
    row = dict(label=relation.label, catalogues=len(some), ruptures=len(events), rate=len(events) / unit if unit > 0 else math.nan,
               moment=events.sum(), moment_rate=events.sum() / unit if unit > 0 else math.nan, largest_moment=events.max(initial=0.0),
               longest=max(one.events["rupture_length"].max(initial=0.0) for one in some), smallest_length=relation.smallest)
    found = {"why": relation.fit} if isinstance(relation.fit, str) else relation.fit._asdict()
    return row | {"moment_by_length": dict.fromkeys(Fit._fields) | found}


def length_figure(catalogues, smallest=None):
    """\\raises ValueError if there are too few ruptures"""
    labels, rows = list(relations_of(catalogues, smallest)), []
    parts = sum(int((~one.whole).sum()) for one in labels)
    if parts < FEWEST:
        raise ValueError(f"{parts} ruptures for a fit, expected at least {FEWEST} of different sizes")
    for number, one in enumerate(catalogues, 1):
        events = one.events[one.events["slip_moment"] > 0]
        rows += [[number, one.label, *row] for row in zip(*(events[key] for key in ("event_id", "rupture_length", "slip_moment")), one.whole(events).astype(int))]  # yapf: disable
    curves = [f"table using ($1 == {k} ? $4 : NaN):5 with points lt {k} ps 0.6*point title {quote(f'{one.label} ({len(one.events)} ruptures)')}"
              for k, one in enumerate(catalogues, 1)]  # yapf: disable
    colours, what = ["#000000", "#777777", "#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00",
                     "#56B4E9"], "fit, whole fault and short ones excluded"
    named = [(f"{one.label}, {what}" if len(labels) > 1 else what, one.fit) for one in labels]
    lines = [one.line(colours[n % len(colours)], text) for n, (text, one) in enumerate(named) if not isinstance(one, str)]
    curves += lines + [f"{10**(one.intercept + one.slope - 2):.15g} * x**2 with lines lc rgb '#777777' dt (4,4) title 'slope 2: constant stress drop'"
                       for one in [one for _, one in named if not isinstance(one, str)][:1]]  # yapf: disable
    length, moment = (np.concatenate([getattr(one, key) for one in labels]) for key in ("length", "moment"))
    return Figure("-length", ["slip moment (shear modulus x slip x length) against length; whole_fault: 1 where the whole fault slipped; errors: "
                              f"jackknife over {PARTS} parts of the time; fits from length " + ", ".join(f"{one.smallest:.4g}" for one in labels),
                              *(f"{text}: {one}" if isinstance(one, str) else one.text(text) for text, one in named)],
                  "catalogue,label,event_id,length,moment,whole_fault", rows,
                  KEY + axis("x", LENGTH, length.min(), length.max(), True) + axis("y", MOMENT, moment.min(), moment.max(), True)
                  + f"plot {', '.join(curves)}", (900, 530 + 23 * (len(catalogues) + 1 + len(lines))))  # yapf: disable


# ---- the slip history


def check(history, one):
    """\\raises ValueError unless it is that of the run of a catalogue"""
    if history.plane != one.plane:
        kinds = ("on a plane", "line") if one.plane else ("along a line", "plane")
        raise ValueError(f"{one.path}: ruptures {kinds[0]}, expected its slip history, found that of a {kinds[1]}")
    mine, theirs = history.header, one.events.header
    for key in ("seed", "length", "dt", "velocity"):
        if key in mine and key in theirs and mine[key] != theirs[key]:
            raise ValueError(f"{history.path}: {key} = {mine[key]}, but {theirs[key]} in {one.path}: expected files of the same run")


def largest(one):
    if not len(one.events):
        raise ValueError(f"{one.path}: no events, expected at least one")
    return one.events[np.argmax(one.events["slip_moment"])]


def image(history, kept, begin, end, most_rows):
    """Largest slip velocity over the driving velocity in each pixel between two times: rows of time x columns of places."""
    rows = max(1, min(most_rows, math.ceil((end - begin) / history.span - 1e-9)))
    height, columns = (end - begin) / rows, min(len(history.x), MOST_COLUMNS)
    values, first = np.zeros((rows, columns)), np.arange(columns) * len(history.x) // columns
    for k in kept[history.end[kept] > history.begin[kept]]:
        low = max(0, math.floor((history.begin[k] - begin) / height + 1e-6))
        high = min(rows, math.ceil((history.end[k] - begin) / height - 1e-6))
        speed = np.maximum.reduceat(np.abs(history.records["slip"][k].astype(float)), first) / (history.end[k] - history.begin[k])
        values[low:high] = np.maximum(values[low:high], speed / history["driving"])
    return values, height, history.length / columns


def pixels(values, x0, width, t0, height):
    with np.errstate(divide="ignore"):
        shades = np.maximum(0.0, np.log10(values))
    return [[x0 + (c + 0.5) * width, t0 + (r + 0.5) * height, shade] for r, row in enumerate(shades.tolist()) for c, shade in enumerate(row)]


def places_of(history, event):
    """Numbers of the bins of a rupture of a line, from its first one on."""
    bins = len(history.x)
    return (round((event["x_begin"] - history["x0"]) / history.bin) + np.arange(min(bins, round(event["rupture_length"] / history.bin)))) % bins


def outline(history, event, shift=0):
    """Closed lines of (place in bins from the left end, time) around where and when a rupture slipped: of each bin from its first to
    its last interval. shift: bins by which the picture is shifted along the fault"""
    slip = history.records["slip"]
    inside = history.of(event) & (history.end > history.begin)
    places = places_of(history, event)
    slides = np.abs(slip[inside][:, places]) > history["slip_velocity"] * history.span
    begin, end = history.begin[inside], history.end[inside]
    parts, span = [], None
    for place, when in zip((places - shift) % len(history.x), slides.T):
        at = np.flatnonzero(when)
        span = (begin[at[0]], end[at[-1]]) if len(at) else span  # a bin in a gap has the times of the one before
        if span is None:
            continue
        if not parts or place < parts[-1][-1][0]:  # it continues at the other end
            parts.append([])
        parts[-1].append((place, *span))
    for part in parts:
        line = [(place + right, low) for place, low, _ in part for right in (0, 1)]
        line += [(place + right, high) for place, _, high in reversed(part) for right in (1, 0)]
        yield line + line[:1]


def line_figures(history, one, begin, end, speeds):
    """\\raises ValueError without records or ruptures between these times"""
    kept = np.flatnonzero((history.end >= begin) & (history.begin <= end))
    if not len(kept) or history.begin[kept[0]] == history.end[kept[-1]]:
        raise ValueError(f"{history.path}: nothing in the window of time")
    begin, end = max(begin, history.begin[kept[0]]), min(end, history.end[kept[-1]])
    inside = one._replace(events=one.events[(one.events["t_start"] >= begin) & (one.events["t_end"] <= end)])
    event, x0, bin = largest(inside), history["x0"], history.bin
    along = axis("x", PLACE, x0, x0 + history.length)

    order = np.argsort(-inside.events["slip_moment"], kind="stable")[:MOST_OUTLINES]
    rows = []
    for number, k in enumerate(order, 1):
        for line in outline(history, inside.events[k]):
            rows += [[number, x0 + place * bin, time] for place, time in line] + [["NaN"] * 3]
    yield Figure("-spacetime-outlines", [f"outlines of the {len(order)} largest of {len(inside.events)} ruptures"], "curve,x,y", rows)
    values, height, width = image(history, kept, begin, end, MOST_ROWS)
    yield Figure("-spacetime", ["the largest slip velocity in each pixel, over the driving velocity"], "x,time,log10_velocity",
                 pixels(values, x0, width, begin, height),
                 "set datafile columnheaders\n" + VELOCITIES + along + axis("y", "Time (model units)", begin, end) + "set format y '%.7g'\nset key off\n"
                 "plot table using 1:2:3 with image, base.'-outlines.csv' using 2:3 with lines lc rgb '#0072B2' lw 0.8", (1000, 800))  # yapf: disable
    yield from detail(history, event, speeds)


def momentrate_figure(event, what, columns):
    """columns: times, moment rates, and of a plane those along strike and along dip"""
    curves = [f"table using 1:2 with lines lc rgb '#bbbbbb' lw 5 title '{what}'", "table using 1:3 with lines lt 1 title 'along strike'",
              "table using 1:4 with lines lt 2 title 'along dip'"] if len(columns) > 2 else [f"table using 1:2 with lines lt 1 title '{what}'"]  # yapf: disable
    return Figure("-momentrate", [f"rupture {event['event_id']}: time since it began, {event['t_start']:.8g}, moment per time"],
                  ",".join(["time", "moment_rate", "along_strike", "along_dip"][:len(columns)]), list(zip(*columns)), "set datafile columnheaders\n" + KEY
                  + axis("x", "Time since the rupture began (model units)", 0.0, event["t_end"] - event["t_start"])
                  + axis("y", "Moment rate (model units)") + f"plot {', '.join(curves)}")  # yapf: disable


def detail(history, event, speeds):
    """One rupture: the slip velocity around its first place, the fronts of P- and S-waves from there, and its slip along the fault."""
    bins, bin = len(history.x), history.bin
    shift = (math.floor((event["x_hypocentre"] - history["x0"]) / bin) - bins // 2) % bins  # the first place is in the middle
    x0, start = -(bins // 2 + 0.5) * bin, event["t_start"]
    room = 0.15 * (event["t_end"] - start)
    kept = np.flatnonzero((history.end >= start - room) & (history.begin <= event["t_end"] + room))
    begin, end = max(start - room, history.begin[kept[0]]), min(event["t_end"] + room, history.end[kept[-1]])
    rows = []
    for line in outline(history, event, shift):
        rows += [[1, x0 + place * bin, time - start] for place, time in line] + [["NaN"] * 3]
    for number, speed in enumerate(speeds, 2):
        reach = min(0.5 * history.length, (end - start) * speed)
        rows += [[number, x, abs(x) / speed] for x in (-reach, 0.0, reach)] + [["NaN"] * 3]
    inside = history.of(event)
    slip = np.roll(history.records["slip"][inside].sum(axis=0, dtype=float), -shift)
    rows += [[4, x0 + (b + 0.5) * bin, value] for b, value in enumerate(slip.tolist())]
    yield Figure("-event-lines", ["curve 1: outline; 2: P-wave, 3: S-wave from the first place (x, time); 4: slip of the rupture (x, slip)"],
                 "curve,x,y", rows)
    moved = history.records["slip"][inside][:, places_of(history, event)].astype(float)
    moved[np.abs(moved) <= history["slip_velocity"] * history.span] = 0.0
    lasting = (history.end - history.begin)[inside]
    yield momentrate_figure(event, "along the fault", [(history.middle[inside] - start).tolist(),
                                                       (history["modulus"] * bin * moved.sum(axis=1) / lasting).tolist()])  # yapf: disable
    values, height, width = image(history, kept, begin, end, 600)
    values = np.roll(values, -(shift * values.shape[1] // bins), axis=1)
    yield Figure(
        "-event", [f"rupture {event['event_id']} from its first place {event['x_hypocentre']:.6g} and time {start:.8g}"], "x,time,log10_velocity",
        pixels(values, x0, width, begin - start, height), f"""set datafile columnheaders
{VELOCITIES}lines = base.'-lines.csv'
set multiplot
set lmargin at screen 0.12
set rmargin at screen 0.83
set bmargin at screen 0.36
set tmargin at screen 0.915
{axis("x", "", x0, x0 + history.length)}{axis("y", "Time since the rupture began (model units)", begin - start, end - start)}set format x ''
set key at screen 0.47,0.985 center top horizontal maxcols 2
plot table using 1:2:3 with image notitle, \\
     lines using ($1 == 1 ? $2 : NaN):3 with lines lc rgb '#0072B2' lw 1 title 'rupture', \\
     lines using ($1 == 2 ? $2 : NaN):3 with lines lc rgb '#000000' lw 1.6 title 'P-wave, speed {speeds[0]:g}', \\
     lines using ($1 == 3 ? $2 : NaN):3 with lines lc rgb '#009E73' lw 1.8 dt (6,4) title 'S-wave, speed {speeds[1]:g}'
set tmargin at screen 0.33
set bmargin at screen 0.09
set format x '%g'
{axis("x", "Distance from the hypocentre along the fault (model units)")}{axis("y", "Slip (model units)")}set yrange [*:*]
unset key
plot 0 with lines lt 8 lw 0.6, lines using ($1 == 4 ? $2 : NaN):3 with histeps lc rgb '#0072B2' lw 1.4
unset multiplot""", (900, 900))


# ---- maps of a plane


class Map:
    """What one rupture did in the cells of the rectangle in which it slipped, (strike, dip): slip from begin to end; time since the begin
    at which the slip velocity exceeds `least` for the first time, linear between the middles of the records, NaN where it never
    does; rate: largest slip velocity; moment: (times, moment rates along strike and dip)."""

    def __init__(self, history, event, least):
        records, mine = history.records, history.of(event) & (history.end > history.begin)
        if not mine.any() or records["step_end"][mine][-1] != event["step_end"]:
            raise ValueError(f"{history.path}: does not have all of rupture {event['event_id']}, expected its slip until step {event['step_end']}")
        axes = []
        for along, begin, size, hypocentre, key in ((history.x, "x_begin", "rupture_length", "x_hypocentre", "bin"),
                                                    (history.z, "z_begin", "rupture_width", "z_hypocentre", "bin_dip")):
            width, bins = history[key], len(along)
            places = event[begin] + (np.arange(min(bins, max(1, round(event[size] / width)))) + 0.5) * width
            first = event[hypocentre] + bins * width * (event[hypocentre] < event[begin])  # across the seam
            axes.append((places, np.rint((places - along[0]) / width).astype(int) % bins, first, width))
        (self.x, strike, self.x_first, self.width), (self.z, dip, self.z_first, self.height) = axes
        slip = records["slip"][mine][:, strike][:, :, dip].astype(float)
        duration = (history.end - history.begin)[mine]
        middle = history.middle[mine] - event["t_start"]
        rates = np.hypot(slip[..., 0], slip[..., 1]) / duration[:, None, None]
        total = slip.sum(axis=0)
        self.slip, self.rate = np.hypot(total[..., 0], total[..., 1]), rates.max(axis=0)
        if not self.rate.max() > least:
            raise ValueError(f"{history.path}: rupture {event['event_id']} slips at {self.rate.max():.6g} at most, expected an arrival below it, "
                             f"not {least:.6g}")
        fast = rates > least
        at = np.argmax(fast, axis=0)
        # Before it began the rupture slipped nowhere, in the middle of the interval before it.
        padded, times = np.concatenate([np.zeros_like(rates[:1]), rates]), np.concatenate([[-0.5 * history.span], middle])
        before, now = (np.take_along_axis(padded, (at + k)[None], axis=0)[0] for k in (0, 1))
        with np.errstate(divide="ignore", invalid="ignore"):
            part = np.where(before < least, (least - before) / (now - before), 1.0)
        self.time = np.where(fast.any(axis=0), np.maximum(0.0, times[at] + part * (times[at + 1] - times[at])), math.nan)
        unit = history["modulus"] * self.width * self.height / duration
        self.moment = middle, unit * slip[..., 0].sum(axis=(1, 2)), unit * slip[..., 1].sum(axis=(1, 2))


def map_figure(plane, event, ending, values, column, label, script):
    """A map with the hypocentre, in multiples of a power of 1000, as numbers with exponents have no room beside the colours."""
    top = np.nanmax(values, initial=0.0)
    power = 3 * math.floor(math.log10(top) / 3) if top > 0 else 0
    unit = f"10^{{{power}}} model units" if power else "model units"
    rows = [[plane.x[i], plane.z[k], "NaN" if math.isnan(values[i, k]) else values[i, k]] for k in range(len(plane.z)) for i in range(len(plane.x))]
    length, width = len(plane.x) * plane.width, len(plane.z) * plane.height
    x, z = plane.x[0] - 0.5 * plane.width, plane.z[0] - 0.5 * plane.height
    return Figure(ending, [f"rupture {event['event_id']} from its first place {plane.x_first:.6g}, {plane.z_first:.6g} and time {event['t_start']:.8g}: {label}"],
                  f"x,z,{column}", rows, "set datafile columnheaders\nset size ratio -1\nunset grid\nset key off\n"
                  + axis("x", "Along strike (model units)", x, x + length) + axis("y", "Along dip, upwards (model units)", z, z + width)
                  + f"set cblabel {quote(f'{label} ({unit})', True)} offset 1\n{script}plot table using 1:2:($3*1e{-power}) with image, "
                  f"'+' using ({plane.x_first}):({plane.z_first}) every ::::0 with points pt 3 ps 1.6*point lw 1.6 lc rgb '#0072B2'",
                  (1000, 160 + int(np.clip(740 * width / length, 200, 900))))  # yapf: disable


def plane_figures(history, one, begin, end, arrival):
    event = largest(one._replace(events=one.events[(one.events["t_start"] >= begin) & (one.events["t_end"] <= end)]))
    plane = Map(history, event, arrival or history["slip_velocity"])
    yield map_figure(plane, event, "-slip", plane.slip, "slip", "Slip", FLAME + "set cbrange [0:*]\n")
    yield map_figure(plane, event, "-time", plane.time, "time", "Time since the rupture began",
                     "set palette maxcolors 12 defined (0 '#f7fbff', 1 '#9ecae1', 2 '#3182bd', 3 '#08306b')\n")  # steps show the front
    yield map_figure(plane, event, "-rate", plane.rate, "peak_slip_rate", "Largest slip velocity", FLAME + "set cbrange [0:*]\n")
    time, along, down = plane.moment
    yield momentrate_figure(event, "length of both", [time, np.hypot(along, down), along, down])


# ---- the program


def main(catalogues, label, history, begin, end, smallest, p_speed, s_speed, arrival, json_file, output, no_picture):
    if label and len(label) != len(catalogues):
        raise ValueError(f"--label {len(label)} times, expected once for each of {len(catalogues)} catalogues")
    if not begin < end or not (smallest is None or smallest >= 0) or not (arrival is None or arrival > 0) or not (p_speed > 0 and s_speed > 0):
        raise ValueError("expected --from before --to, --min-length not below 0, and --arrival, --p-speed and --s-speed above 0")
    loaded = [load(path, label[n] if label else None, begin, end) for n, path in enumerate(catalogues)]
    for one in loaded:
        moments, lengths = one.events["slip_moment"], one.events["rupture_length"]
        print(f"{one.label}: {len(moments)} ruptures, moments in all {moments.sum():.6g}, largest {moments.max(initial=0):.4g}, "
              f"longest {lengths.max(initial=0):.4g}")
    if json_file:
        write_json(json_file, ruptures=[as_json(one) for one in relations_of(loaded, smallest)])
    figures = []
    if history:
        slip = History(history)
        check(slip, loaded[0])
        figures += plane_figures(slip, loaded[0], begin, end, arrival) if slip.plane else line_figures(slip, loaded[0], begin, end,
                                                                                                       (p_speed, s_speed))
    try:
        figures += [
            density_figure(loaded, "-lengths", "rupture_length"),
            density_figure(loaded, "-moments", "slip_moment"),
            length_figure(loaded, smallest)
        ]
    except ValueError as error:
        if not json_file and not (history and slip.plane):  # a rupture of a plane is often the only one of its run
            raise
        print(f"no figures of all ruptures: {error}")
    draw_all("lsm.ruptures", output, figures, [*catalogues, *([history] if history else [])], not no_picture)


def parser():
    options = argparse.ArgumentParser(prog="python3 -m lsm.ruptures", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("catalogues", nargs="+", metavar="CATALOGUE")
    options.add_argument("--label", action="append", help="name of a curve, once per catalogue")
    options.add_argument("--history", metavar="FILE", help="slip history of the first catalogue's run")
    add_time_window(options)
    options.add_argument(
        "--min-length", type=float, dest="smallest", metavar="LENGTH", help="shortest rupture in fits of moment against length; default: "
        f"{FEWEST_BINS} bins of the fault, as shorter ones lie off the line of the others")
    options.add_argument("--p-speed", type=float, default=lsm.P_SPEED, help="speed of P-waves (%(default)s; paper, Eq. 4: 2.12, the regular lattice)")
    options.add_argument("--s-speed", type=float, default=lsm.S_SPEED, help="speed of S-waves (%(default)s; not printed)")
    options.add_argument(
        "--arrival", type=float, help="slip velocity above which the rupture has come to a place of a plane, for the map of times; "
        "default: that above which places slip")
    options.add_argument("--json", dest="json_file", metavar="FILE", help="numbers of each label: counts, rates, moments, and the fits")
    options.add_argument("-o", "--output", default="ruptures", metavar="BASE", help="files are BASE-NAME.csv, .png and .svg")
    options.add_argument("--no-picture", action="store_true", help="tables only")
    return options


if __name__ == "__main__":
    run(main, parser())
