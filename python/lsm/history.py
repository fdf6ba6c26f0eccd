# SPDX-License-Identifier: GPL-2.0-or-later
"""Slip histories with the times and places of what they record."""
import numpy as np

import lsm

__all__ = ["History"]


class History:
    """records: as lsm.read_slip() has them; begin, end: their times; x and, of a plane, z: middles of the bins. history["dt"]: a number of the
    header. Of a run that continues another, and at the beginning, a record may be empty."""

    def __init__(self, path, records=None):
        self.path, self.records = path, lsm.read_slip(path) if records is None else records
        self.header, self.plane = self.records.header, self.records["slip"].ndim == 4
        self.bin, shape = self["bin"], self.records["slip"].shape
        self.length = shape[1] * self.bin
        self.x = self["x0"] + (np.arange(shape[1]) + 0.5) * self.bin
        self.z = self["z0"] + (np.arange(shape[2]) + 0.5) * self["bin_dip"] if self.plane else None
        self.begin, self.end = (self.time(self.records[key]) for key in ("step_begin", "step_end"))

    def __getitem__(self, key):
        return lsm._number(self.path, self.header, key)

    def time(self, step):
        return self["time0"] + (step - self["step0"]) * self["dt"]

    def step(self, time):
        return (time - self.time(0)) / self["dt"]

    @property
    def middle(self):
        return 0.5 * (self.begin + self.end)

    @property
    def span(self):
        """Time of an interval; quiet ones are put together into longer records."""
        return self["interval"] * self["dt"]

    def of(self, event):
        """Which records are those of an event."""
        return (self.records["step_begin"] >= event["step_start"]) & (self.records["step_end"] <= event["step_end"])

    def kept(self, which):
        """The same with these records only."""
        return History(self.path, self.records[which])
