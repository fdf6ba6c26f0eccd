# SPDX-License-Identifier: GPL-2.0-or-later
"""Statements of the calibration, its prior and its surrogate."""
import math
import random
import sys

import numpy as np
import pytest
from programs import INPUTS, SOURCE

sys.path[:0] = [str(INPUTS / "studies"), str(SOURCE / "python")]
import calibrate  # noqa: E402
from lsm import LOADING, paper  # noqa: E402
from lsm.tables import write_table  # noqa: E402


def row(point, length="120", memory="1", **settings):
    """A point whose numbers follow known laws: gamma falls with the viscosity, B rises with the stress and the memory."""
    one = {
        "point": point, "stopped": "no", "length": length, "memory": memory, "hold": "stress", "mass": "r2", "contacts": "all", "loose": "remove",
        "faces": "random", "retardation": "0", "mus": "0.6", "kt": "0.2", "impedance": "0", **settings
    }
    u = calibrate.UNPRINTED["viscosity"].coordinate(one, "viscosity")
    one |= {f"exponent_{text}": "1.07" for text in paper.RANGES}
    one |= {f"share_{text}_0.0001": "0.1" for text in paper.WINDOWS}
    one |= {
        "gamma_0.0001": str(1.5 - u), "gamma_squares": "1", "B_0.0001": str(500 * float(one["stress"]) * float(memory)),
        "mean_time_0.0001": str(20 * float(memory)), "in_events": "0.3", "rise": "1", "one_bin": "0.1", "roll_off_gain": "10", "rate_between": "0.4",
        "loading": "0.7", "brief": "0", "excess": "0.1"
    }
    return one


def test_a_statement_is_an_interval_with_a_tolerance():
    one = paper.Statement("B", "", paper.of("B"), 10, 20, math.log(2), True)
    assert one.deviation({"B": "15"}) == 0
    assert one.deviation({"B": "5"}) == pytest.approx(1)
    assert one.deviation({"B": "80"}) == pytest.approx(2)
    assert one.deviation({"B": "1e9"}) == one.deviation({"B": ""}) == one.deviation({"B": "-1"}) == 10


def test_only_what_is_printed_counts():
    one = row("a", viscosity="0.001", stress="0.03")
    far = {**one, "excess": "-3", "rate_between": "9", "brief": "1"}
    assert paper.distance(one) == paper.distance(far) < paper.distance({**one, "gamma_0.0001": "0"})


def test_settings_of_a_run_are_those_of_its_preset():
    absorbing, reflecting, leaky = (calibrate.settings_in(words) for words in ({"preset": "absorbing"}, {"preset": "reflecting", "kt": "0.3"}, {}))
    keys = ("stress", "viscosity", "kt", "mus", "impedance", "dt", "massstep")
    assert [absorbing[key] for key in keys] == ["0.025", "0.05", "0.5", "0.6", "0.6", "0.12", "0.12"]
    assert [reflecting[key] for key in keys] == ["0.03", "5e-4", "0.3", "0.6", "0", "0.03", "0.03"]
    assert [leaky[key] for key in keys] == ["0.03", "5e-4", "0.12", "0.6", "0.4", "0.03", "0.03"]


def test_settings_go_to_the_surrogate_as_they_were_proposed():
    draw = random.Random(1)
    for _ in range(50):
        cube = [draw.random() for _ in calibrate.UNPRINTED]
        words = calibrate.settings_of(cube)
        at = calibrate.coordinates({"impedance": "", **words, "memory": "1", "length": "480"})
        assert at[-1] == 1
        for u, x, (key, one) in zip(cube, at, calibrate.UNPRINTED.items()):
            if isinstance(one, calibrate.Choice) and not (key == "loose discs" and "contacts" in words):
                assert x == (u >= one.share)
            elif isinstance(one, calibrate.Value) and key in words and u >= one.at_zero:
                assert x == pytest.approx((u - one.at_zero) / (1 - one.at_zero), abs=0.03)
    assert "impedance" not in calibrate.settings_of([0.5] * 5 + [0.9] * 6)
    assert "loose" not in calibrate.settings_of([0.5] * 5 + [0.1] + [0.9] * 5)


def test_the_posterior_finds_the_values_that_made_the_numbers(monkeypatch):
    pytest.importorskip("sklearn")
    monkeypatch.setattr(calibrate, "SAMPLES", 3000)
    draw, rows = random.Random(1), []
    for n in range(40):
        words = calibrate.settings_of([draw.random() for _ in calibrate.UNPRINTED])
        rows += [
            row(f"p{n:03d}", length, str(memory), **{**{"impedance": ""}, **words}) for memory in calibrate.MEMORIES for length in ("120", "480")
        ]
    _, memory, words, found, log, surrogate = calibrate.sampled(rows, 1, paper.printed())
    likely = [n for n in range(len(log)) if log[n] > max(log) - 1]
    # gamma 0.995 is a coordinate of 0.505, and B 15.21 a product of stress and memory
    for n in likely:
        assert calibrate.UNPRINTED["viscosity"].coordinate(words[n], "viscosity") == pytest.approx(0.505, abs=0.2)
        assert math.log(500 * float(words[n]["stress"]) * memory[n] / 15.21) == pytest.approx(0, abs=0.4)
    error, spread = surrogate.left_out["gamma"]
    assert error < 0.2 * spread


def test_points_are_added_to_a_table(tmp_path):
    table = tmp_path / "study.csv"
    table.write_text("run,program,length,seed,steps,settings\n")
    calibrate.propose(table, "120", 3)
    first = table.read_text()
    calibrate.propose(table, "480", 2)
    lines = table.read_text().splitlines()
    assert table.read_text().startswith(first)
    assert [line.split(",")[:4] for line in lines[1:]] == [[f"p{n:03d}", "fault", "120" if n < 3 else "480", "1"] for n in range(5)]
    assert len({line.split(",")[5] for line in lines[1:]}) == 5


def test_points_are_proposed_for_what_is_not_printed_as_well(tmp_path, monkeypatch):
    pytest.importorskip("sklearn")
    monkeypatch.setattr(calibrate, "SAMPLES", 3000)
    draw, rows, spring = random.Random(2), [], calibrate.UNPRINTED["kt"]
    for n in range(40):
        words = calibrate.settings_of([draw.random() for _ in calibrate.UNPRINTED])
        slip = 1 - spring.coordinate(words, "kt")  # soft springs alone make slip
        rows += [{**row(f"p{n:03d}", length, str(memory), **{**{"impedance": ""}, **words}), "excess": str(slip)} for memory in calibrate.MEMORIES
                 for length in ("120", "480")]
    points, table = tmp_path / "points.csv", tmp_path / "study.csv"
    write_table(points, ["points"], rows)
    calibrate.propose(table, "120", 60, points, "slip")
    lines = [line.split(",") for line in table.read_text().splitlines()]
    assert [line[0] for line in lines] == [f"s{n:03d}" for n in range(60)]
    found = [spring.coordinate(dict(word.split("=") for word in line[5].split()), "kt") for line in lines]
    # Slip needs a coordinate below 0.5; of the prior 40 % are above 0.6.
    assert sum(x > 0.6 for x in found) < 0.2 * len(found), found


def test_a_run_counts_when_it_is_loaded():
    """PE that rises for a time and falls back and rises again from then on; a fault that is loaded soon counts from the usual time on."""
    time = np.arange(0.0, 30000.0, 10.0)
    pe = np.where(time < 12000, time / 12000, 0.8 + 0.2 * ((time - 12000) % 2000) / 2000)
    last = pe[3 * len(pe) // 4:].mean()
    assert calibrate.loaded(time, pe) == pytest.approx(12000 * last, abs=20)
    assert calibrate.loaded(time / 2, pe) == LOADING
