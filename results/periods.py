# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a fault repeats itself †: a period in the times of its events, which are slips of one plate past the other."""
import numpy as np

from lsm.analysis import events_of


def slips_of(path, begin, least):
    """Times of the events of at least a size, as slips of the plates, and their sizes."""
    events = events_of(path, begin)
    events = events[events["size"] >= least]
    return events["t_start"] * 2 * float(events.header["velocity"]), events["size"]  # there are two plates


def rayleigh_z(times, weights, period):
    """|sum s exp(2 pi i t / P)|^2 / sum s^2 of the sizes s: 1 on average for random phases (Rayleigh's test of directions, Mardia & Jupp 2000)"""
    return abs(np.sum(weights * np.exp(2j * np.pi * np.fmod(times, period) / period)))**2 / np.sum(weights**2)
