# SPDX-License-Identifier: GPL-2.0-or-later
"""The command postproc statements."""
import json

import numpy as np
import pytest
from data_files import table, write_catalogue, write_history
from programs import refused, run


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


def test_statements(postproc, made_run):
    done = run(postproc, "statements", made_run, "-o found --json all.json")
    rows = {(row["statement"], row["number"]): row for row in table("found.csv")}
    assert len(rows) == len(json.load(open("all.json"))["statements"]) == len(table("found.csv"))

    def row(statement, number, value, tolerance, verdict):
        found = rows[statement, number]
        assert abs(float(found["value"]) - value) < tolerance and found["verdict"] == verdict, found
        assert found["quote"]

    row("velocities", "largest rise of the density, while something slips", 1.0, 0.4, "holds")
    row("neighbours", "share of ruptures of one bin (from 5 plate velocities on)", 2 / 3, 0.01, "fails")
    row("locked", "slip recorded over that of the plates", 1.02, 0.03, "holds")
    row("locked", "slip rate between events over that of the plates", 0.1, 0.01, "holds")
    row("locked", "slip rate within events over that between them", 240, 12, "holds")
    row("locked", "rise of PE between events over the work of the plates", 1.0, 0.001, "holds")
    row("numbers", "events in 1e7 steps of 0.0045", 1e7 * 0.00454 / 104, 10, "fails")
    done.printed('velocities: "The distribution of slip velocities was monotonic')
    # Without the other files there are only the statements that the catalogue allows.
    short = run(postproc, "statements", made_run, "--ruptures none --history none -o short")
    short.warned("no slip history beside it")
    assert {row["statement"] for row in table("short.csv")} == {"roll-off", "numbers"}


def test_statements_of_several(postproc, work):
    rng = np.random.default_rng(2)
    for name, mean in ("a", 10), ("b", 10), ("c", 15):
        write_catalogue(f"{name}.csv", np.cumsum(rng.exponential(mean, 800)), 10**rng.uniform(-4, -1, 800))
    run(postproc, "statements a.csv b.csv c.csv --label a --label b --label c -o found")
    verdicts = {(row["catalogue"], row["number"]): row["verdict"] for row in table("found.csv") if row["statement"] == "times"}
    assert [verdicts[pair, "distance of the times"] for pair in ("a and b", "a and c", "b and c")] == ["holds", "fails", "fails"]
    assert {verdict for (_, number), verdict in verdicts.items() if "means" in number} == {"holds"}


def test_statements_refused(postproc, made_run):
    refused(postproc, "statements RUN.ruptures.csv --ruptures none --history none", "no drops of PE, expected a catalogue of these")
    refused(postproc, "statements RUN.catalogue.csv --history RUN.ruptures.csv", "expected")
    refused(postproc, "statements RUN.catalogue.csv --ruptures none --ruptures none", "--ruptures")
    refused(postproc, "statements RUN.catalogue.csv --threshold 1", "fewer than two drops")
    refused(postproc, "statements RUN.catalogue.csv -o RUN.catalogue", "RUN.catalogue.csv")


def test_periods(postproc, work):
    """Slip of 1 is 2000 time units at the paper's velocity: half of the events lie in one tenth of it."""
    rng = np.random.default_rng(3)
    head = dict(model="lsm", length=120, velocity=0.00025)
    at = rng.uniform(0, 70, 800)
    tied = np.where(rng.random(800) < 0.5, np.floor(at) + 0.3 + 0.1 * rng.random(800), at)
    write_catalogue("tied.csv", np.sort(tied) * 2000, rng.uniform(0.01, 1, 800), head)
    write_catalogue("free.csv", np.sort(at) * 2000, rng.uniform(0.01, 1, 800), head)
    run(postproc, "periods tied.csv free.csv --label tied --label free -o p --no-picture --json p.json")
    found = {row["label"]: row for row in table("p.tests.csv")}
    assert float(found["tied"]["z"]) > 50 and float(found["tied"]["p"]) < 0.01 and abs(float(found["tied"]["at_period"]) - 1) < 0.02
    assert float(found["free"]["z"]) < 6 and float(found["free"]["p"]) > 0.001
    assert [row["tenth"] for row in table("p.tenths.csv") if float(row["weight"]) > 3] == ["4"]
    assert len(table("p.pairs.csv")) == 1 and len(json.load(open("p.json"))["periods"]) == 2
    run(postproc, "periods tied.csv --unit time --period 2000 --scan 1000:5000 -o t --no-picture")
    assert float(table("t.tests.csv")[0]["z"]) == pytest.approx(float(found["tied"]["z"]), rel=1e-5)
    write_catalogue("still.csv", [1, 2, 3], [1, 1, 1])
    refused(postproc, "periods still.csv", "no velocity of the plates in the header")
    refused(postproc, "periods tied.csv --threshold 2", "0 events of this size, expected at least 10")
    refused(postproc, "periods tied.csv --scan 0:1", "--scan '0:1', expected LO:HI, both positive")
