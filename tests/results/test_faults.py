# SPDX-License-Identifier: GPL-2.0-or-later
"""faults.py: ruptures by friction, and rates with errors."""
import sys
from pathlib import Path

import numpy as np
import pytest
from programs import SOURCE

sys.path.insert(0, str(SOURCE / "results"))
import faults  # noqa: E402
import lsm  # noqa: E402

FRICTION = 0.6 * 0.03 * 2 * 0.00025  # of the plates' slip, in one time unit at one place


def history(cells, bins=10, count=40):
    """One with this work, in units of FRICTION, at (interval, place)."""
    work = np.zeros((count, bins))
    for at, value in cells.items():
        work[at] = value * FRICTION
    return faults.Intervals(dict(stress="0.03", velocity="0.00025"), np.arange(count), work / 0.018, work, 1.0, count)


def test_a_rupture_runs_on_over_one_place_three_intervals_and_the_ends_of_the_fault():
    begin, end, work, slip, start, places = faults.ruptures_in(history({(3, 9): 100, (4, 1): 60, (7, 2): 70}))
    assert (begin, end, start, places) == (pytest.approx([3.0]), pytest.approx([8.0]), [9], [4])
    assert work == pytest.approx([230 * FRICTION]) and slip == pytest.approx(work / 0.018)


@pytest.mark.parametrize("other", [(3, 4), (7, 1), (4, 8)])
def test_what_is_farther_away_is_another_rupture(other):
    assert len(faults.ruptures_in(history({(3, 1): 100, other: 100}))[0]) == 2


def test_what_is_slower_than_the_threshold_is_left_out():
    found = faults.ruptures_in(history({(3, 1): 100, (3, 2): 49}))
    assert found[2] == pytest.approx([100 * FRICTION]) and found[5] == [1]
    assert faults.ruptures_in(history({(3, 1): 100, (3, 2): 49}), slipping=20)[5] == [2]


def test_a_rupture_of_the_whole_fault_is_as_long_as_it():
    assert faults.ruptures_in(history({(3, place): 100 for place in range(10)}))[5] == [10]


def test_merged_intervals_are_compared_with_the_slip_of_their_time():
    assert len(faults.ruptures_in(history({(4, 1): 60}), merged=4)[0]) == 0
    assert faults.ruptures_in(history({(4, 1): 150, (5, 1): 100}), merged=4)[1] == pytest.approx([8.0])


def run_of(starts, begins, lengths, length=10, span=1000.0):
    events = np.zeros(len(starts), [("t_start", float), ("t_end", float), ("size", float), ("x_begin", float), ("rupture_length", float)])
    events["t_start"], events["x_begin"], events["rupture_length"], events["size"] = np.array(starts) + faults.LOADING, begins, lengths, 0.1
    return faults.Run(Path("x"), "leaky", length, 11, lsm.Table(events, dict(time_span=str(span))))


def test_a_rate_has_the_error_of_its_parts():
    every = run_of(np.arange(50.0, 1000.0, 100.0), 0, 1)
    assert faults.rate_of(every, np.ones(10, bool)) == pytest.approx((10.0, 0.0))
    half = run_of([50.0, 51.0, 250.0, 251.0, 450.0, 451.0, 650.0, 651.0, 850.0, 851.0], 0, 1)
    assert faults.rate_of(half, np.ones(10, bool)) == pytest.approx((10.0, 10 * np.std([2, 0] * 5, ddof=1) / np.sqrt(10)))
    assert faults.per_length(half, np.ones(10, bool))[0] == pytest.approx(120.0)


def test_a_disc_is_as_stiff_as_its_springs():
    """Two springs along x, one along y, and a contact along y whose tangential spring acts along x."""
    pairs, along = np.array([[0, 1], [0, 2], [0, 3]]), np.array([[1.0, 0], [-1, 0], [0, 1]])
    across = along[:, ::-1] * [-1, 1]
    links = faults.stiffness_of(4, pairs, along, across, 0.0)
    assert links[0] == pytest.approx(np.diag([2.0, 1.0])) and links[3] == pytest.approx(np.diag([0.0, 1.0]))
    contact = faults.stiffness_of(4, pairs[2:], along[2:], across[2:], 0.2)
    assert contact[0] == pytest.approx(np.diag([0.2, 1.0]))


def test_drops_after_large_ones_are_told_from_chance():
    """Each large drop is followed at once by a small one; shuffled sizes are not."""
    rng = np.random.default_rng(2)
    large = np.sort(rng.uniform(0, 1e5, 100))
    starts = np.sort(np.concatenate([large, large + 5]))
    run = run_of(starts, 0, 1, span=1e5)
    run.events["size"], run.events["t_end"] = np.where(np.isin(starts, large), 0.1, 1e-3), run.events["t_start"] + 1
    assert 1.3 < faults.after_crossings(run) < 2.5
