# SPDX-License-Identifier: GPL-2.0-or-later
"""lsm.regime: saw-tooth numbers with known answers, and the program."""
import json
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from data_files import write_catalogue, write_series
from programs import SOURCE, Program, refused, run

sys.path.insert(0, str(SOURCE / "python"))
from lsm.regime import regime, stick_slip_above  # noqa: E402

SCRIPT = Program("lsm.regime", sys.executable, "-m", "lsm.regime", env={"PYTHONPATH": str(SOURCE / "python"), "LC_ALL": "C.UTF-8"})


def saw_tooth(up, n, m, times):
    """Rises by `up` per sample for n samples and then falls back within m samples, again and again."""
    tooth = np.concatenate([up * np.arange(n), up * n * (1 - np.arange(m) / m)])
    return np.append(np.tile(tooth, times), 0.0)


def test_a_saw_tooth_is_the_ratio_of_its_slopes():
    # With windows of 5 samples and flanks of 200 and 10, no window contains a turning point.
    found = regime(saw_tooth(1e-3, 200, 10, 50), 0.1, 120, 0.5)
    assert found["regime"] == "stick-slip" and found["windows"] == 50 * 210 / 5
    assert [found[key] for key in ("rise", "fall", "saw_tooth", "drop_over_load")] == pytest.approx([1e-2, 0.2, 20, 20], rel=1e-11)


def test_a_symmetric_series_is_one():
    i = np.arange(300000)
    found = regime(np.sin(0.002 * i) + np.sin(0.0071 * i), 0.1, 120, 0.3)
    assert found["saw_tooth"] == pytest.approx(1, abs=0.01) and found["regime"] == "creep"


def test_it_does_not_grow_with_the_length_of_the_series():
    """With events of many sizes, the fastest fall grows with their number, but the mean does not."""

    def of(cycles):
        falls = 10 / (1 - 0.9999 * np.random.default_rng(1).uniform(size=cycles))**0.45
        return regime(np.cumsum(np.column_stack([np.ones((cycles, 20)), -falls])), 1.0, 120, 1.0)

    brief, longer = of(300), of(30000)
    assert longer["drop_over_load"] > 2 * brief["drop_over_load"] and longer["saw_tooth"] / brief["saw_tooth"] == pytest.approx(1, abs=0.5)


def test_a_long_fault_is_judged_by_its_length():
    """n faults of length 120 side by side, with different phases, each of which is a sawtooth that falls 12 times as fast as it rises."""
    t = np.arange(50000)
    for n in 1, 4, 16:
        periods = [130 * (1 + 0.37 * k / n) for k in range(n)]
        phases = [(t + 71 * k**2) % period / period for k, period in enumerate(periods)]
        found = regime(sum(np.where(phase < 12 / 13, phase, 12 * (1 - phase)) for phase in phases), 1.0, 120 * n, 1.0)
        assert found["regime"] == "stick-slip" and found["stick_slip_above"] == pytest.approx(1 + 2 / math.sqrt(n)), n
    assert stick_slip_above(40) == stick_slip_above(math.nan) == 3


def test_the_fastest_fall_is_measured_by_the_largest_rises():
    """There are rises of 1 to 101 in any order, 99 % of them up to 100, and one fall of 200."""
    rises = [1 + 37 * k % 101 for k in range(101)]
    assert regime(np.cumsum([0, *rises, -200]), 1.0, 120, 1.0)["drop_over_load"] == 2


def test_without_a_fall_or_a_rise_there_is_none():
    for pe, why in ((np.arange(100), "PE only rises"), (-np.arange(100), "PE only falls"), ([2] * 9, "PE does not change"),
                    ([0], "shorter than two windows of 1 time units")):
        found = regime(np.array(pe), 1.0, 120, 1.0)
        assert found["saw_tooth"] is None and why in found["why"]


def test_program(work):
    """101 samples, 100 time units; the first event began before the window."""
    write_series("run.pe.bin", saw_tooth(1.0, 90, 10, 1), {"dt": 1, "length": 120})
    write_catalogue("run.csv", [10, 90, 300], [1, 1, 1], t_end=[25, 95, 310])
    run(SCRIPT, "run.pe.bin --catalogue run.csv --window 1 --json r.json").printed("run.pe.bin: stick-slip, saw tooth 9,")
    found = json.loads(Path("r.json").read_text())
    assert found["time_in_events"] == 0.2 and found["mean_duration"] == 10
    run(SCRIPT, "run.pe.bin --catalogue run.csv --from 20 --window 1 --json r.json")
    assert json.loads(Path("r.json").read_text())["mean_duration"] == 5
    write_catalogue("over.csv", [10, 12, 60], [1, 1, 1], t_end=[30, 20, 70])  # ruptures overlap
    run(SCRIPT, "run.pe.bin --catalogue over.csv --window 1 --json r.json")
    assert json.loads(Path("r.json").read_text())["time_in_events"] == 0.3
    run(SCRIPT, "run.pe.bin --to 80 --json r.json").printed("run.pe.bin: degenerate: PE only rises over 26 windows of 3 time units")
    assert json.loads(Path("r.json").read_text())["saw_tooth"] is None
    refused(SCRIPT, "run.pe.bin --from 1e6", "0 samples in the window of time, expected at least 3")
    refused(SCRIPT, "run.pe.bin --from 3 --to 2", "expected --from before --to")
    refused(SCRIPT, "run.pe.bin --window inf", "a finite --window above 0")
    refused(SCRIPT, "run.pe.bin --json /dev/full", "/dev/full: No space left on device")
    refused(SCRIPT, "nowhere.pe.bin", "nowhere.pe.bin: No such file")
    refused(SCRIPT, "run.csv", "run.csv: no PE series")
