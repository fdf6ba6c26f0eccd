# SPDX-License-Identifier: GPL-2.0-or-later
"""lsm.statements: a run with known numbers, and the estimates by themselves."""
import json
import sys

import numpy as np
import pytest
from data_files import write_catalogue, write_history
from programs import SOURCE, Program, refused, run

sys.path.insert(0, str(SOURCE / "python"))
from lsm import statements  # noqa: E402
from lsm.history import History  # noqa: E402


@pytest.fixture
def script(postproc):
    return Program("lsm.statements", sys.executable, "-m", "lsm.statements", postproc.path, env={"PYTHONPATH": SOURCE / "python"})


@pytest.fixture
def made_run(work):
    """RUN.catalogue.csv, RUN.ruptures.csv and RUN.slip.bin of a fault that slips 240 times as fast within drops as between them."""
    rng = np.random.default_rng(1)
    cycles, bins, dt = 400, 10, 0.5
    # Each cycle has two long quiet records and eight of one interval with a drop.
    quiet, slipping = 100, 8
    starts = np.arange(cycles) * (2 * quiet + slipping) + 2 * quiet
    sizes = 10**rng.uniform(-4, -1, cycles)
    t = starts * dt
    write_catalogue("RUN.catalogue.csv", t, sizes, dict(model="lsm", length=bins, dt=dt), t_end=t + slipping * dt, pe_start=[1.0] * cycles,
                    pe_end=[1.0 - 0.01 * 10 * 5e-4 * 2 * quiet * dt] * cycles)
    steps, slip = [0], [np.zeros(bins)]
    for start in starts:
        for count in (quiet, quiet, *[1] * slipping):
            steps.append(steps[-1] + count)
            slip.append(5e-4 * dt * count * rng.exponential(24 if count == 1 else 0.1, bins))
        assert steps[-1] == start + slipping
    write_history("RUN.slip.bin", steps, slip, stress=0.01, dt=dt, driving=5e-4, interval=1, quiet=quiet)
    n = 600
    write_catalogue("RUN.ruptures.csv", np.sort(rng.uniform(0, t[-1], n)), [1e-3] * n,
                    dict(model="lsm", length=bins, events="ruptures", slipping=5, slip_bin=1), slip_moment=[1e-3] * n,
                    rupture_length=[1.0 if k % 3 else 4.0 for k in range(n)])
    return "RUN.catalogue.csv"


def test_of_a_run(script, made_run, work):
    run(script, made_run, "--json all.json")
    rows = {(row["statement"], row["number"]): row for row in json.load(open("all.json"))["statements"]}

    def row(statement, number, value, tolerance, verdict):
        found = rows[statement, number]
        assert abs(found["value"] - value) < tolerance and found["verdict"] == verdict, found
        assert found["quote"]

    row("velocities", "largest rise of the density, while something slips", 1.0, 0.4, "holds")
    row("neighbours", "share of ruptures of one bin (from 5 plate velocities on)", 2 / 3, 0.01, "fails")
    row("locked", "slip recorded over that of the plates", 1.02, 0.03, "holds")
    row("locked", "slip rate between events over that of the plates", 0.1, 0.01, "holds")
    row("locked", "slip rate within events over that between them", 240, 12, "holds")
    row("locked", "rise of PE between events over the work of the plates", 1.0, 0.001, "holds")
    row("numbers", "events in 1e7 steps of 0.0045", 1e7 * 0.00454 / 104, 10, "fails")
    # Without the other files there are only the statements that the catalogue allows.
    for name in "RUN.slip.bin", "RUN.ruptures.csv":
        (work / name).rename(f"other.{name}")
    run(script, made_run, "--json short.json")
    assert {row["statement"] for row in json.load(open("short.json"))["statements"]} == {"roll-off", "numbers"}
    refused(script, "other.RUN.ruptures.csv", "no drops of PE, expected a catalogue of these")
    refused(script, "none.csv", "none.csv")
    (work / "RUN.ruptures.csv").write_text((work / made_run).read_text())
    refused(script, made_run, "RUN.catalogue.csv: .*expected a catalogue of ruptures")


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

    def found(least):
        return {number: value for _, number, (value, _), *_ in statements.slip_statements(drops[drops["size"] >= least], History("slip.bin"))}

    all_drops = found(0.5)
    between, within = 99 * 8 * 1e-4, 200 * 0.02
    for number, value in (("share of the time while no event is open", 99 * 8 / 992), ("share of the time with intervals of their own", 200 / 992),
                          ("slip rate between events over that of the plates", 0.1), ("slip rate within events over that between them", 200),
                          ("share of the slip while no event is open",
                           between / (between + within)), ("rise of PE between events over the work of the plates",
                                                           0.9), ("slip recorded over that of the plates", (between + within) / 0.992)):
        assert all_drops[number] == pytest.approx(value, rel=1e-5), number
    assert all_drops["share of bins that slip backwards"] == 0
    # Half of the drops are too small, which doubles the time between drops.
    assert found(1.5)["share of the time while no event is open"] == pytest.approx(49 * 18 / 982)
    with pytest.raises(ValueError, match="fewer than two drops"):
        found(3.0)


def content(expected, rng):
    return np.array([[rng.poisson(mean) for mean in expected] for _ in range(statements.PARTS)])


def test_rises_that_are_no_chance_are_found():
    rng, edges = np.random.default_rng(3), np.arange(9.0)
    falling = [8, 7, 6, 5, 4, 3, 2, 1]
    alarms = sum(statements.largest_rise(edges, content(falling, rng))[4] for _ in range(200))
    assert alarms <= 20  # 5 % at most, plus three standard errors
    value, error, low, high, significant = statements.largest_rise(edges, content([80, 70, 60, 20, 40, 30, 20, 10], rng))
    assert significant and (low, high) == (3.5, 4.5) and value == pytest.approx(2, abs=3 * error)


def test_a_rise_is_one_of_densities_and_needs_content():
    parts = np.tile([1.0, 2.0], (statements.PARTS, 1))
    edges = np.array([0.0, 1.0, 4.0])
    value, *_, significant = statements.largest_rise(edges, parts)  # twice the content in a bin of three times the width
    assert value == pytest.approx(2 / 3) and not significant
    parts[1:, 1], parts[0, 1] = 0, 1000  # a bin with content in a single part is ignored
    assert np.isnan(statements.largest_rise(edges, parts)[0])


def test_errors_of_ratios_cover():
    rng, covered = np.random.default_rng(11), 0
    for _ in range(300):
        many = 1 + 4 * rng.uniform(size=statements.PARTS)  # a part has few or many events, of which 0.3 on average count
        value, error = statements.ratio(many * (0.2 + 0.2 * rng.uniform(size=statements.PARTS)), many)
        covered += abs(value - 0.3) < error
    assert covered / 300 == pytest.approx(0.67, abs=0.09)  # Student's t of 19 degrees: 0.67


def test_quantiles_of_student():
    for level, freedom, quantile in ((0.05, 19, 1.729133), (0.001, 19, 3.579400), (0.025, 5, 2.570582)):  # tables
        assert statements.student_quantile(level, freedom) == pytest.approx(quantile, rel=1e-5)
