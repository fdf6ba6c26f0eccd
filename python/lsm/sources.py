# SPDX-License-Identifier: GPL-2.0-or-later
"""What each rupture of a fault was as a source of waves †: moment rate, duration, energies, stress drop and corner frequency.

    python3 -m lsm.sources fault.ruptures.csv                     # and fault.slip.bin beside it

Writes BASE.sources.csv, the catalogue with further columns, which postproc reads in its place; BASE-moment-rates.csv, the moment rate of
each rupture, which postproc explore shows; and, of three ruptures or more, their scaling with moment: BASE-source-duration and
BASE-source-energy, tables with pictures. The columns, in model units (of a line: energies and moments per length):
  source_duration       time from 5 to 95 % of the moment
  peak_moment_rate      largest moment rate of an interval
  centroid_time         mean time, weighted by the moment rate
  stress_work           half the sum of the stresses before and after, times slip
  friction_work         what friction took up
  contact_energy        what contacts stored: the work of stress on slip, interval by interval, less friction_work; below 0
                        where stress falls
  radiated_energy       stress_work less friction_work and contact_energy
  apparent_stress       modulus times radiated_energy over slip_moment
  fracture_energy       what friction took up above the strength, that at which half of the slip of a place was done; not of Coulomb friction;
                        too low where strength falls within an interval or two
  weighted_stress_drop  mean of the places, weighted by their slip
  corner_frequency      of Brune's spectrum, M / (1 + (f / corner)^2), fitted to that of the moment rate; 0 if intervals are too long
Stresses before and after are those of stress_drop. Moment rates are along the moment and count slip as the catalogue does; energies count
all slip of the places that slipped, from the beginning to the end of the rupture.
"""
import argparse
import itertools
import math
from pathlib import Path

import numpy as np

import lsm
from lsm.drawing import KEY, Figure, axis, draw_all, quote
from lsm.history import History
from lsm.program import run
from lsm.ruptures import FEWEST, MOMENT, check, fit, load

__all__ = ["COLUMNS", "corner_frequency", "of_run", "replayed"]

COLUMNS = ("source_duration peak_moment_rate centroid_time stress_work friction_work contact_energy radiated_energy apparent_stress fracture_energy "
           "weighted_stress_drop corner_frequency").split()
BANDS, IN_BAND = 16, 8  # of a spectrum, from a tenth to ten times the inverse of the duration, and frequencies in each

# ---- which slip belongs together, as compute lsm/events finds it


def together(pairs, n):
    """The least number among those that are connected with each of n numbers, by pairs (2 x any)."""
    label = np.arange(n)
    while True:
        ends = np.sort(label[pairs], axis=0)
        pairs, ends = pairs[:, ends[0] != ends[1]], ends[:, ends[0] != ends[1]]
        if not ends.size:
            return label
        np.minimum.at(label, ends[1], ends[0])
        while (label[label] != label).any():
            label = label[label]


def neighbours(shape, rings, gap):
    """For each direction to a neighbour, one of each pair of opposite ones: the cell there, -1 for none, by the number of the cell."""
    reaches = [min(gap + 1, max(1 - n, (bins + (0 if ring else gap + 1)) // 2)) for n, (bins, ring) in enumerate(zip(shape, rings))]
    cells = np.indices(shape)
    for step in itertools.product(*(range(-reach, reach + 1) for reach in reaches)):
        if step <= (0,) * len(shape):
            continue
        there, inside = 0, True
        for at, move, bins, ring in zip(cells, step, shape, rings):
            to = at + move
            inside = inside & (ring | (0 <= to) & (to < bins))
            there = there * bins + to % bins
        yield np.where(inside, there, -1).ravel()


def replayed(history):
    """Where and when the fault slipped: record, cell and rupture of each slip, these by numbers of their own. The cells of a plane are
    counted along dip first."""
    records, head = history.records, history.header
    shape = records["slip"].shape[1:3]
    shape = shape[:2 if history.plane else 1]
    rings = [head.get(key) != "open" for key in ("ends", "ends_dip")]
    gap, memory = int(head["gap"]), int(head["memory_intervals"])
    least = history["slip_velocity"] * history.span
    slip = records["slip"].reshape(len(records), math.prod(shape), -1)
    slides = np.zeros(slip.shape[:2], bool)
    for part in np.array_split(np.arange(len(records)), max(1, slip.size >> 22)):
        own = records["step_end"][part] - records["step_begin"][part] == history["interval"]
        slides[part] = (np.hypot.reduce(slip[part].astype(float), axis=2, initial=0.0) > least) & own[:, None]
    cell, record = np.nonzero(slides.T)
    when = ((records["step_end"][record] - history["step0"]) // history["interval"]).astype(np.int64)
    # Spells: the slips of a cell without a pause between them. Those of neighbours are connected if no pause lies between the two.
    new = np.concatenate([[True], (cell[1:] != cell[:-1]) | (when[1:] - when[:-1] > memory)])[:len(cell)]
    spell, at = np.cumsum(new) - 1, np.flatnonzero(new)
    begin, end, place = when[at], when[np.append(at[1:], len(cell)) - 1] if len(at) else when, cell[at]
    length = int(when.max(initial=0)) + 2 * memory + 2
    begins, ends, pairs = place * length + begin, place * length + end, [np.zeros((2, 0), int)]
    for there in neighbours(shape, rings, gap):
        mine = np.flatnonzero(there[place] >= 0)
        other = there[place[mine]] * length
        first = np.searchsorted(ends, other + np.maximum(0, begin[mine] - memory))
        count = np.maximum(0, np.searchsorted(begins, other + end[mine] + memory, "right") - first)
        pairs.append(np.stack([np.repeat(mine, count), np.repeat(first - np.cumsum(count) + count, count) + np.arange(count.sum())]))
    return record, cell, together(np.concatenate(pairs, axis=1), len(at))[spell]


# ---- one rupture


def corner_frequency(rate, interval):
    """Corner of Brune's spectrum (1970) for moment rates in intervals, by least squares of logarithms in bands; 0 if it is not within the
    frequencies that they have."""
    moment = rate.sum()
    if len(rate) < 4 or not moment > 0:
        return 0.0
    part = np.cumsum(rate) / moment
    lasting = (np.argmax(part >= 0.95) - np.argmax(part >= 0.05) + 1) * interval
    edge = min(10 / lasting, 0.25 / interval)
    frequency = np.exp(np.linspace(math.log(0.1 / lasting), math.log(edge), BANDS * IN_BAND))
    wave = np.exp(-2j * math.pi * interval * np.outer(frequency, np.arange(len(rate))))
    power = np.abs(wave @ rate / moment / np.sinc(frequency * interval))**2  # the mean over an interval takes away high frequencies
    level = 0.5 * np.log(power.reshape(BANDS, IN_BAND).mean(axis=1))
    middle = np.exp(np.log(frequency).reshape(BANDS, IN_BAND).mean(axis=1))
    corners = np.exp(np.linspace(math.log(frequency[0]), math.log(edge), 1000))
    misfit = ((level + np.log(1 + (middle / corners[:, None])**2))**2).sum(axis=1)
    best = int(np.argmin(misfit))
    return float(corners[best]) if 0 < best < len(corners) - 1 else 0.0


def fracture_energy(stress, slip, friction, before, after):
    """What friction took up above the strength of most of the slip of each place; its slip is that of the faces (intervals x places) less
    what contacts, which are linear, have gone back."""
    order = np.argsort(stress, axis=0)
    done = np.cumsum(np.take_along_axis(np.maximum(slip, 0.0), order, axis=0), axis=0)
    half = np.minimum((done < 0.5 * done[-1]).sum(axis=0), len(stress) - 1)
    strength = np.take_along_axis(stress, np.take_along_axis(order, half[None], axis=0), axis=0)[0]
    stored, mean = (stress * slip).sum(axis=0) - friction, 0.5 * (before + after)
    back = np.divide(stored, mean, out=np.zeros_like(mean), where=mean > 1e-3 * np.abs(before))
    return (friction - strength * (slip.sum(axis=0) - back)).sum()


class Source:
    """A rupture: moment `rate` in the intervals from its begin to its end, and `numbers`, those of COLUMNS."""

    def __init__(self, history, event, records, cells):
        """records, cells: of each of its slips"""
        table, modulus, interval = history.records, history["modulus"], history.span
        area = history.bin * (history["bin_dip"] if history.plane else 1.0)
        shape = (len(table), -1, 2 if history.plane else 1)
        first, last = records.min(), records.max()
        inside, places = slice(first, last + 1), np.unique(cells)

        def of(name, at):
            rows = np.asarray(table[name][at], float)
            return rows.reshape(len(rows), -1, shape[2] if name != "work" else 1)[:, places]

        slip, stress = of("slip", inside), of("stress", inside)
        moved = np.zeros(slip.shape)
        at = records - first, np.searchsorted(places, cells)
        moved[at] = slip[at]
        total = moved.sum(axis=(0, 1))
        size = np.hypot.reduce(total)
        along = total / size if history.plane and size > 0 else np.eye(1, shape[2])[0]
        self.rate = modulus * area / interval * (moved @ along).sum(axis=1)
        self.moment = float(self.rate.sum() * interval)
        before, after = of("stress", [max(first - 1, 0)])[0], of("stress", [min(last + 1, len(table) - 1)])[0]
        slipped, work = slip.sum(axis=0), of("work", inside).sum(axis=(0, 2))
        friction = work.sum()
        stress_work = 0.5 * ((before + after) * slipped).sum() * area
        fault_work = (stress * slip).sum() * area
        weight = np.hypot.reduce(slipped, axis=-1).sum()
        part = np.cumsum(self.rate) * interval / self.moment if self.moment else np.ones(1)

        def reached(level):
            """Time at which the moment reaches a part of itself, linear within the interval."""
            n = int(np.argmax(part >= level))
            low = part[n - 1] if n else 0.0
            return interval * (n + (level - low) / (part[n] - low)) if part[n] > low else 0.0

        middle = event["t_start"] + (np.arange(len(self.rate)) + 0.5) * interval
        sign = math.copysign(1.0, self.moment)
        radiated = stress_work - fault_work
        self.numbers = dict(
            source_duration=reached(0.95) - reached(0.05), peak_moment_rate=sign * (sign * self.rate).max(),
            centroid_time=(middle * self.rate).sum() * interval / self.moment if self.moment else middle.mean(), stress_work=stress_work,
            friction_work=friction, contact_energy=fault_work - friction, radiated_energy=radiated,
            apparent_stress=modulus * radiated / abs(self.moment) if self.moment else 0.0,
            fracture_energy=fracture_energy(stress @ along, slip @ along, work / area, before @ along, after @ along) * area,
            weighted_stress_drop=((before - after) * slipped).sum() / weight if weight else 0.0,
            corner_frequency=corner_frequency(sign * self.rate, interval))  # yapf: disable


def of_run(history, one):
    """The Source of each rupture of a catalogue, in its order. \\raises ValueError if the history does not have one of them"""
    check(history, one)
    record, cell, rupture = replayed(history)
    order = np.argsort(rupture, kind="stable")
    record, cell, rupture = record[order], cell[order], rupture[order]
    begins = np.append(np.flatnonzero(np.diff(rupture, prepend=-1)), len(rupture))
    # A rupture is known by a place that slipped first, and by its first and last step.
    first = np.minimum.reduceat(record, begins[:-1]) if len(record) else record
    last = np.maximum.reduceat(record, begins[:-1]) if len(record) else record
    number = np.repeat(np.arange(len(first)), np.diff(begins))
    of_first = record == first[number]
    known = {key: n for *key, n in zip(record[of_first], cell[of_first], number[of_first]) for key in [tuple(key)]}
    record_of = {step: n for n, step in enumerate(history.records["step_begin"].tolist())}
    axes = [("x_hypocentre", history.x, history.bin)] + ([("z_hypocentre", history.z, history["bin_dip"])] if history.plane else [])
    for event in one.events:
        at = 0
        for name, along, width in axes:
            at = at * len(along) + round((event[name] - along[0]) / width) % len(along)
        n = known.get((record_of.get(int(event["step_start"])), at))
        if n is None or history.records["step_end"][last[n]] != event["step_end"]:
            raise ValueError(
                f"{history.path}: does not have all of rupture {event['event_id']}, expected its slip from step {event['step_start']} to "
                f"{event['step_end']}")
        mine = slice(begins[n], begins[n + 1])
        yield Source(history, event, record[mine], cell[mine])


# ---- the program


def catalogue_with(path, sources, columns):
    """The lines of a catalogue and the columns of its ruptures, as text."""
    lines = lsm.lines_of(path)
    first = next(n for n, line in enumerate(lines) if not line.startswith("#"))
    rows = [line + "".join(f",{one.numbers[name]:.17g}" for name in columns) for line, one in zip(lines[first + 1:], sources)]
    return "\n".join([*lines[:first], ",".join([lines[first], *columns]), *rows, ""])


def scaling(one, sources):
    """Duration and energies over moment, with fits of the ruptures that have both."""
    rows = [[event["event_id"], source.moment, *(source.numbers[name] for name in ("source_duration", "radiated_energy", "apparent_stress"))]
            for event, source in zip(one.events, sources) if source.moment > 0]  # yapf: disable
    values = np.array(rows)[:, 1:].T if rows else np.zeros((4, 0))
    for ending, column, name, label in (("-source-duration", 1, "source_duration", "Duration, 5 to 95 % of the moment"),
                                        ("-source-energy", 2, "radiated_energy", "Radiated energy")):
        moment, value = values[0], values[column]
        used = value > 0
        try:
            line = fit(moment[used], value[used])
        except ValueError as error:
            print(f"no figure {ending[1:]}: {error}")
            continue
        yield Figure(ending, [f"{name} against moment, of {used.sum()} of {len(used)} ruptures of positive moment", f"fit: {line.text(name)}"],
                     "event_id,moment,source_duration,radiated_energy,apparent_stress", [row for row, use in zip(rows, used) if use],
                     "set datafile columnheaders\n" + KEY + axis("x", MOMENT, moment[used].min(), moment[used].max(), True)
                     + axis("y", f"{label} (model units)", value[used].min(), value[used].max(), True)
                     + f"plot table using 2:{column + 2} with points lt 1 ps 0.6*point title {quote(one.label)}, {line.line('#000000', 'fit')}")  # yapf: disable


def main(catalogue, history, output, overwrite, no_picture):
    base = catalogue
    for ending in (".gz", ".xz", ".csv", ".ruptures"):
        base = base.removesuffix(ending)
    base, history = output or base, history or f"{base}.slip.bin"
    one = load(catalogue)
    if not len(one.events):
        raise ValueError(f"{catalogue}: no ruptures, expected at least one")
    twice = [name for name in COLUMNS if name in one.events.dtype.names]
    if twice:
        raise ValueError(f"{catalogue}: has column {twice[0]}, expected the catalogue that the run wrote")
    written = Path(f"{base}.sources.csv")
    if written.exists() and not overwrite:
        raise ValueError(f"{written} exists, expected --overwrite or another -o")
    record = History(history)
    sources = list(of_run(record, one))
    columns = [name for name in COLUMNS if name != "fracture_energy" or not one.events.header.get("law", "").startswith("coulomb")]
    rates = [[event["event_id"], event["t_start"] + (n + 0.5) * record.span,
              float(rate)] for event, source in zip(one.events, sources) for n, rate in enumerate(source.rate)]
    comments = ["moment rate of each rupture: its number, the middle of each interval, and moment per time, along its moment",
                *(f"{key} = {one.events.header[key]}" for key in ("model", "length", "dt", "seed") if key in one.events.header), f"spacing = {record.span:.17g}"]  # yapf: disable
    text = catalogue_with(catalogue, sources, columns)
    draw_all("lsm.sources", base, [Figure("-moment-rates", comments, "event_id,time,moment_rate", rates), *scaling(one, sources)],
             [catalogue, history], not no_picture)
    written.write_text(text, encoding="utf-8")
    print(f"wrote {written}")


def parser():
    options = argparse.ArgumentParser(prog="python3 -m lsm.sources", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("catalogue", metavar="CATALOGUE", help="ruptures, as compute lsm/events writes them")
    options.add_argument("--history", metavar="FILE", help="slip history of the same run; default: RUN.slip.bin beside RUN.ruptures.csv")
    options.add_argument("-o", "--output", metavar="BASE", help="beginning of the names of the files; default: RUN")
    options.add_argument("--overwrite", action="store_true", help="replace BASE.sources.csv")
    options.add_argument("--no-picture", action="store_true", help="tables only")
    return options


if __name__ == "__main__":
    run(main, parser())
