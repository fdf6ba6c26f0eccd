# SPDX-License-Identifier: GPL-2.0-or-later
"""slip_or_exchange.py: runs whose friction, spectrum and load are known."""

import sys
from pathlib import Path

import numpy as np
import pytest
from data_files import read_catalogue, write_catalogue, write_history
from programs import SOURCE, Program, refused, run

sys.path.insert(0, str(SOURCE / "results"))
import slip_or_exchange  # noqa: E402
from lsm import slip as lsm_slip  # noqa: E402


@pytest.fixture
def script():
    return Program("slip_or_exchange.py", sys.executable, SOURCE / "results/slip_or_exchange.py")


def test_excess_and_chance(script, postproc, work):
    """Every 100 steps the fault slips for one step at one place, and friction takes up 0.01; the events are these or lie between them."""
    dt, bins, cycles, first = 1.0, 10, 400, 9000
    steps = first + np.arange(100 * cycles + 1)
    slip, friction = np.full((len(steps), bins), 1e-5), np.full((len(steps), bins), 1e-6)
    slips = np.arange(50, len(steps), 100)
    slip[slips, 3], friction[slips, 3] = 0.01, 0.01
    write_history("run.slip.bin", steps, slip, work=friction, dt=dt)
    # Of 100 steps the first event leaves those in which nothing happens, the second leaves the slip.
    quiet = (1e-5 - (friction.sum() / cycles - 1e-5) / 99) / 0.01
    for name, begin, excess in (("run", steps[slips] - 1, 1.0), ("quiet", steps[slips] + 20, quiet)):
        write_catalogue(f"{name}.catalogue.csv", begin * dt, [0.01] * cycles, dict(model="lsm", length=10, width=30, seed=1), t_end=(begin + 1) * dt,
                        step_start=begin, step_end=begin + 1)
        Path(f"{name}.slip.bin").write_bytes(Path("run.slip.bin").read_bytes())
        run(script, "events", name, f"{name}.events.csv.xz")
        _, found = read_catalogue(f"{name}.events.csv.xz")
        assert len(found["size"]) == cycles
        np.testing.assert_allclose(lsm_slip.excess_of(found), excess, atol=2e-4)
        run(postproc, "select", f"{name}.events.csv.xz", "--where", "excess>0.5", "-o", f"{name}.slip.csv")
        assert len(read_catalogue(f"{name}.slip.csv")[1]["size"]) == (cycles if name == "run" else 0)
        # A random stretch of a step has more than half of the work in one position of a hundred, or in none outside the events.
        assert np.mean(found["chance"]) == pytest.approx(0.0 if name == "run" else 0.01, abs=0.005)


def test_random_stretches_keep_clear_of_events_as_large(work):
    """Four events that fill 0.2 of the time: stretches for the small one meet none, those for the largest may meet all others."""
    write_history("run.slip.bin", np.arange(1001), np.full((1001, 2), 1e-3))
    kinds = [("step_start", float), ("step_end", float), ("size", float)]
    events = np.array([(100.0, 150.0, 1.0), (400.0, 402.0, 0.1), (500.0, 550.0, 2.0), (700.0, 798.0, 5.0)], kinds)
    starts = np.array(list(lsm_slip.random_starts(lsm_slip.Friction("run.slip.bin"), events, 0.0)))
    lasting = events["step_end"] - events["step_start"]
    assert starts.min() >= 0 and np.all(starts.max(axis=0) + lasting <= 1000)
    met = [[np.any((start < other["step_end"]) & (start + long > other["step_start"])) for other in events] for start, long in zip(starts.T, lasting)]
    smaller = events["size"][None, :] < events["size"][:, None]
    assert not np.any(np.array(met) & ~smaller) and met[3][0] and met[3][2], met


def test_as_many_as_by_chance_are_no_slip():
    """Events of which half are slip, in a fault where three tenths of all stretches would count as slip: these are left out."""
    excess = np.concatenate([np.full(500, 0.9), np.where(np.arange(500) % 10 < 3, 0.7, -0.2)])
    chance = np.full(1000, 0.3)
    assert lsm_slip.slip_share(excess, chance) == pytest.approx(0.5)
    assert lsm_slip.slip_share(excess[500:], chance[500:]) == pytest.approx(0.0)


def test_springs_are_loaded_while_they_slip():
    """Plates put in 0.01 a time; friction takes that up in events of 2 in each 10, which it leaves with nothing but these, while
    springs are loaded by 0.02 more."""
    t = 10.0 * np.arange(1, 101)
    kinds = [("t_start", float), ("t_end", float), ("size", float), ("friction_work", float), ("friction_total", float)]
    found = np.array([(a, a + 2, 0.08, 0.1, 0.1 * n) for n, a in enumerate(t)], kinds)
    np.testing.assert_allclose(lsm_slip.excess_of(found), 1.25)


def test_random_phases_keep_the_spectrum():
    rng = np.random.default_rng(3)
    series = np.cumsum(rng.exponential(1.0, 4096) - 1.0)
    other = slip_or_exchange.with_phases(series, rng)
    spectra = [np.abs(np.fft.rfft(np.diff(one))) for one in (series, other)]
    # That at the highest frequency has no phase of its own.
    np.testing.assert_allclose(spectra[0][:-1], spectra[1][:-1], rtol=1e-6, atol=1e-6 * spectra[0].max())
    assert abs(np.corrcoef(np.diff(series), np.diff(other))[0, 1]) < 0.1


def test_bad_input(script, work):
    refused(script, "events nowhere out.csv.xz", r"nowhere\.catalogue\.csv")
    assert not Path("out.csv.xz").exists()
    run(script, "unknown a b", status=1)
