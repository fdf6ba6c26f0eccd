# SPDX-License-Identifier: GPL-2.0-or-later
"""lsm.statements: a run with known numbers, and the estimates by themselves."""
import sys

import numpy as np
import pytest
from data_files import write_catalogue, write_history
from programs import SOURCE

sys.path.insert(0, str(SOURCE / "python"))
from lsm import statements  # noqa: E402
from lsm.history import History  # noqa: E402


def test_of_a_run(postproc, work):
    """A fault that slips 240 times as fast within drops as between them."""
    rng = np.random.default_rng(1)
    cycles, bins, dt = 400, 10, 0.5
    # Each cycle has two long quiet records and eight of one interval with a drop.
    quiet, slipping = 100, 8
    starts = np.arange(cycles) * (2 * quiet + slipping) + 2 * quiet
    t = starts * dt
    write_catalogue("picked.csv", t, 10**rng.uniform(-4, -1, cycles), dict(model="lsm", length=bins, dt=dt), t_end=t + slipping * dt,
                    pe_start=[1.0] * cycles, pe_end=[1.0 - 0.01 * 10 * 5e-4 * 2 * quiet * dt] * cycles)  # yapf: disable
    steps, slip = [0], [np.zeros(bins)]
    for start in starts:
        for count in (quiet, quiet, *[1] * slipping):
            steps.append(steps[-1] + count)
            slip.append(5e-4 * dt * count * rng.exponential(24 if count == 1 else 0.1, bins))
        assert steps[-1] == start + slipping
    write_history("fault.slip.bin", steps, slip, stress=0.01, dt=dt, driving=5e-4, interval=1, quiet=quiet)
    n = 600
    write_catalogue("fault.ruptures.csv", np.sort(rng.uniform(0, t[-1], n)), [1e-3] * n, dict(model="lsm", length=bins, events="ruptures", slip_bin=1),
                    rupture_length=[1.0 if k % 3 else 4.0 for k in range(n)])  # yapf: disable
    found = statements.statements_of(postproc.path, "picked.csv", 0.0, work)
    assert found["one_bin"] == pytest.approx(2 / 3, abs=0.01) and found["rate_between"] == pytest.approx(0.1, abs=0.01)
    assert found["loading"] == pytest.approx(1, abs=0.001) and found["roll_off_gain"] is None or found["roll_off_gain"] >= 0


def test_slip_and_drops_add_up_by_hand(work):
    """100 cycles of 8 quiet intervals of one time unit, at a tenth of the plate velocity, and a drop that lasts 2 intervals, at 10 and
    30 plate velocities in the two bins of width 3."""
    slips = np.arange(1000) % 10 >= 8
    slip = np.where(slips[:, None], [0.01, 0.03], 1e-4)
    # Quiet intervals are merged.
    last = np.concatenate([[0], 1 + np.flatnonzero(slips | (np.arange(1000) % 10 == 7))])
    merged = [np.zeros(2), *(slip[a:b].sum(axis=0) for a, b in zip(last, last[1:]))]
    write_history("slip.bin", 4 * last, merged, stress=[0.01, 0.03], bin=3, interval=4, dt=0.25, slip_velocity=0.005, driving=0.001, quiet=8)
    start = np.flatnonzero(slips)[::2].astype(float)
    drops = np.zeros(100, [(key, float) for key in ("t_start", "t_end", "size", "pe_start", "pe_end")])
    drops["t_start"], drops["t_end"], drops["size"] = start, start + 2, np.where(np.arange(100) % 2, 2.0, 1.0)
    drops["pe_start"], drops["pe_end"] = 5.0, 5.0 - 8 * 0.9 * 0.02 * 6 * 0.001  # rises again by 0.9 of the work
    found = statements.slip_numbers(drops, History("slip.bin"))
    assert [found[key] for key in ("rate_between", "loading")] == pytest.approx([0.1, 0.9], rel=1e-5)
    # Half of the drops are too small: between the others lie 49 of their slips of 0.04 on average, and twice as much time.
    found = statements.slip_numbers(drops[drops["size"] > 1.5], History("slip.bin"))
    assert found["rate_between"] == pytest.approx((49 * (16 * 1e-4 + 2 * 0.02)) / (49 * 18) / 0.001, rel=1e-5)
    with pytest.raises(ValueError, match="fewer than two drops"):
        statements.slip_numbers(drops[:1], History("slip.bin"))


def content(expected, rng):
    return np.array([[rng.poisson(mean) for mean in expected] for _ in range(statements.PARTS)])


def test_rises_that_are_no_chance_are_found():
    rng, edges = np.random.default_rng(3), np.arange(9.0)
    falling = [8, 7, 6, 5, 4, 3, 2, 1]
    alarms = sum(statements.largest_rise(edges, content(falling, rng))[1] for _ in range(200))
    assert alarms <= 20  # 5 % at most, plus three standard errors
    value, significant = statements.largest_rise(edges, content([80, 70, 60, 20, 40, 30, 20, 10], rng))
    assert significant and value == pytest.approx(2, abs=0.3)  # from the fourth bin to the fifth


def test_a_rise_is_one_of_densities_and_needs_content():
    parts = np.tile([1.0, 2.0], (statements.PARTS, 1))
    edges = np.array([0.0, 1.0, 4.0])
    value, significant = statements.largest_rise(edges, parts)  # twice the content in a bin of three times the width
    assert value == pytest.approx(2 / 3) and not significant
    parts[1:, 1], parts[0, 1] = 0, 1000  # a bin with content in a single part is ignored
    assert np.isnan(statements.largest_rise(edges, parts)[0])


def test_errors_of_ratios_cover():
    rng, covered = np.random.default_rng(11), 0
    for _ in range(300):
        many = 1 + 4 * rng.uniform(size=statements.PARTS)  # a part has few or many events, of which 0.3 on average count
        value, error = statements.log_ratio(many * (0.2 + 0.2 * rng.uniform(size=statements.PARTS)), many)
        covered += abs(value - np.log(0.3)) < error
    assert covered / 300 == pytest.approx(0.67, abs=0.09)  # Student's t of 19 degrees: 0.67
