# SPDX-License-Identifier: GPL-2.0-or-later
"""What the paper prints about its models, as statements about rows of numbers (lsm.summary, lsm.statements), and how far a model is from them.

Only statements that the paper prints count; those of our own (†) are reported beside them.
"""
import math
from typing import Callable, NamedTuple

from lsm.tables import number, read

RANGES = ("1e-4:1e-1", "1e-4:1e-3", "1e-3:1e-2", "1e-2:1e-1")
WINDOWS = ("16:22", "22:28", "30:36", "38:44")
WAVE_SPEED = {"r2": 2.00, "r3": 2.5}  # of long P-waves, results/waves_packing.csv; r3: of pulses, p_wave_packing.in


def decades(row):
    parts = [number(row, f"exponent_{text}") - 1.07 for text in RANGES[1:]]
    return math.sqrt(sum(part * part for part in parts) / len(parts))


def swings(row):
    """Share of inter-event times that are near a period of the blocks between the plates, less the share of times beside it."""
    beside = 0.5 * (number(row, "share_16:22_0.0001") + number(row, "share_38:44_0.0001"))
    return max(number(row, "share_22:28_0.0001"), number(row, "share_30:36_0.0001")) - beside


def memories(row):
    """Mean inter-event time in memories of the picker (the paper: 3000 to 8000 events in 1e7 to 3e7 steps, a memory being 100 steps)."""
    return number(row, "mean_time_0.0001") / float(row["memory"])


class Statement(NamedTuple):
    """A number that has to be within an interval; its deviation is the distance to that in units of a tolerance."""
    name: str
    text: str  # with † if it is not the paper's
    value: Callable
    low: float
    high: float
    tolerance: float
    log: bool = False  # of the number, the interval and the tolerance

    def scaled(self, row):
        return self.scale(self.value(row))

    def scale(self, value):
        return (math.log(value) if value > 0 else math.nan) if self.log else value

    def interval(self):
        return (math.log(self.low), math.log(self.high)) if self.log else (self.low, self.high)

    def deviation(self, row):
        return self.deviation_of(self.value(row))

    def deviation_of(self, value):
        """At most ten, which it is if the number cannot be had for lack of events."""
        (low, high), value = self.interval(), self.scale(value)
        return min(10.0, max(low - value, 0.0, value - high) / self.tolerance) if math.isfinite(value) else 10.0


def of(key):
    return lambda row: number(row, key)


def roll_off_gain(row):
    """0 where points.csv has none though it has an exponent: postproc gave none below 3.84 when these points were collected."""
    return 0.0 if row.get("exponent_1e-4:1e-1") and not row.get("roll_off_gain") else number(row, "roll_off_gain")


ANY = math.inf
STATEMENTS = (
    Statement("exponent", "sizes go as s^-1.07 from 1e-4 over three decades: exponent", of("exponent_1e-4:1e-1"), 1.07, 1.07, 0.07),
    Statement("decades", "so in each of these decades (no second population): rms distance of their exponents from 1.07", decades, 0, 0, 0.3),
    Statement("gamma", "inter-event times >= 1e-4: gamma 0.995, delta 1", of("gamma_0.0001"), 0.995, 0.995, 0.1),
    Statement("rate", "mean time between events, in memories of the picker: 12.5 to 100", memories, 12.5, 100, 0.3, True),
    Statement("B", "B 15.21 time units", of("B_0.0001"), 15.21, 15.21, 0.2, True),
    Statement("stick-slip", "PE rises while the fault is locked: share of the time in which it falls, below a third", of("in_events"), -ANY, 0.33,
              0.03),
    Statement("velocities", "the density of slip velocities falls all the way: largest ratio of a bin to one of smaller velocities, 1 or less",
              of("rise"), -ANY, 1, 0.5),
    Statement("neighbours", "slip at one contact mostly triggers its neighbours: share of the ruptures that stay within one bin, below a half",
              of("one_bin"), -ANY, 0.5, 0.1),
    Statement("roll-off", "sizes roll off: 2 ln L of an exponential roll-off over a power law without end, above 3.84", roll_off_gain, 3.84, ANY, 1),
    Statement("waves", "velocity of P-waves: 2.12 (Eq. 4)", lambda r: WAVE_SPEED[r["mass"]], 2.12, 2.12, 0.1),
    Statement("least squares", "gamma by least squares on the density †", of("gamma_squares"), 0.995, 0.995, 0.1),
    Statement("locked", "the fault is locked between events: slip velocity there over that of the plates, below a half †", of("rate_between"), -ANY,
              0.5, 0.1),
    Statement("loading", "PE rises there by loading: its rise over the work of the plates, above a half †", of("loading"), 0.5, ANY, 0.1),
    Statement("steps", "events are resolved: share of those of 3 steps or less, at most 0.02 †", of("brief"), -ANY, 0.02, 0.02),
    Statement("swings", "inter-event times are no oscillations of the blocks: share of times at their periods beyond that beside, at most 0.02 †",
              swings, -ANY, 0.02, 0.03),
    Statement("slip", "events of 0.001 to 0.1 are slip: share of what the springs lose that friction takes up, above a half †", of("excess"), 0.5,
              ANY, 0.1),
)
STATEMENTS_BY_NAME = {one.name: one for one in STATEMENTS}


def printed(statements=STATEMENTS):
    return tuple(one for one in statements if "†" not in one.text)


def distance(row, statements=None):
    """Root mean square of the deviations from what is printed."""
    parts = [one.deviation(row) for one in statements or printed()]
    return math.sqrt(sum(part * part for part in parts) / len(parts))


# Statements about the block-slider, each of which is evaluated at each of the five lengths.
SLIDER_STATEMENTS = (
    Statement("events", "3000 to 5000 in 1e7 steps", of("events"), 3000, 5000, 0.3, True),
    Statement("small", "exponent 0.5 below size 1", of("exponent_1e-2:1"), 0.5, 0.5, 0.1),
    Statement("large", "exponent 1.0 above", of("exponent_1:1e2"), 1, 1, 0.1),
    Statement("gamma", "0.0", of("gamma"), 0, 0, 0.1),
    Statement("B", "100", of("B"), 100, 100, math.log(2), True),
    Statement("C", "0.25", of("C"), 0.25, 0.25, 0.05),
)

# ---- points of a calibration, as inputs/studies/calibrate.py collects them

STEPS = 110000  # of each point
SLIDER_SETTINGS = {"blocks": "", "scheme": "", "dt": "", "picker": "", "picker-lambda": "", "picker-memory-time": "", "velocity": "0.01"}
SLIDER_KEYS = (*list(SLIDER_SETTINGS)[1:], "warmup", "smallest")


def completed(path):
    return [row for row in read(path) if row["stopped"] == "no"]
