# SPDX-License-Identifier: GPL-2.0-or-later
"""slip_or_exchange.py: runs whose friction, spectrum and load are known."""

import sys
from pathlib import Path

import numpy as np
import pytest
from data_files import read_catalogue, write_catalogue, write_history, write_series
from programs import SOURCE, Program, refused, run

sys.path.insert(0, str(SOURCE / "results"))
import slip_or_exchange  # noqa: E402
from lsm import slip as lsm_slip  # noqa: E402


@pytest.fixture
def script():
    return Program("slip_or_exchange.py", sys.executable, SOURCE / "results/slip_or_exchange.py")


def test_excess_rank_and_chance(script, postproc, work):
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
        write_series(f"{name}.pe.bin", np.zeros(len(steps)), dict(dt=dt, step0=first, time0=first * dt))
        run(script, "events", name, f"{name}.events.csv.xz")
        _, found = read_catalogue(f"{name}.events.csv.xz")
        assert len(found["size"]) == cycles
        np.testing.assert_allclose(lsm_slip.excess_of(found)[0], excess, atol=2e-4)
        run(postproc, "select", f"{name}.events.csv.xz", "--where", "excess>0.5", "-o", f"{name}.slip.csv")
        assert len(read_catalogue(f"{name}.slip.csv")[1]["size"]) == (cycles if name == "run" else 0)
        rank = np.mean(found["rank"])
        assert rank > 0.95 if name == "run" else rank < 0.05, rank
        # A random stretch of a step has more than half of the work in one position of a hundred, or in none outside the events.
        assert np.mean(found["chance"]) == pytest.approx(0.0 if name == "run" else 0.01, abs=0.005)


def test_random_stretches_keep_clear_of_events_as_large(work):
    """Four events that fill 0.2 of the time: stretches for the small one meet none, those for the largest may meet all others."""
    write_history("run.slip.bin", np.arange(1001), np.full((1001, 2), 1e-3))
    kinds = [("step_start", float), ("step_end", float), ("size", float)]
    events = np.array([(100.0, 150.0, 1.0), (400.0, 402.0, 0.1), (500.0, 550.0, 2.0), (700.0, 798.0, 5.0)], kinds)
    starts = np.array(list(lsm_slip.random_starts(lsm_slip.History("run.slip.bin"), events, 0.0, 1)))
    lasting = events["step_end"] - events["step_start"]
    assert starts.min() >= 0 and np.all(starts.max(axis=0) + lasting <= 1000)
    met = [[np.any((start < other["step_end"]) & (start + long > other["step_start"])) for other in events] for start, long in zip(starts.T, lasting)]
    smaller = events["size"][None, :] < events["size"][:, None]
    assert not np.any(np.array(met) & ~smaller) and met[3][0] and met[3][2], met


def test_half_of_the_slip_lies_together_or_is_scattered(work):
    """Half of the slip in two neighbouring places of a ring of ten, the first and the last; the same slip everywhere; all in one place."""
    slip = np.full((201, 10), 0.01)
    slip[1], slip[200] = [4, 1, 1, 1, 1, 1, 1, 1, 1, 4], [0, 0, 7, 0, 0, 0, 0, -1, 0, 0]
    write_history("run.slip.bin", np.arange(201), slip)
    history, begin = lsm_slip.History("run.slip.bin"), np.array([0.0, 1.0, 199.0])
    assert list(history.half(begin, begin + 1)) == [2, 5, 1]
    events = np.array([(1.0, 2.0, 1.0), (199.0, 200.0, 1.0)], [("step_start", float), ("step_end", float), ("size", float)])
    scattered, together = lsm_slip.gathered(history, events, 0.0)
    assert together > 0.9 and scattered == 0.0, (together, scattered)


def test_as_many_as_by_chance_are_no_slip():
    """Events of which half are slip, in a fault where three tenths of all stretches would count as slip: these are left out."""
    excess = np.concatenate([np.full(500, 0.9), np.where(np.arange(500) % 10 < 3, 0.7, -0.2)])
    chance = np.full(1000, 0.3)
    assert lsm_slip.slip_share(excess, chance) == pytest.approx(0.5)
    assert lsm_slip.slip_share(excess[500:], chance[500:]) == pytest.approx(0.0)


def test_a_spring_that_lets_go_is_a_jump():
    """PE oscillates smoothly; one event is half of an oscillation, the other is almost all one step."""
    steps = np.arange(1001)
    pe = 0.01 * np.cos(2 * np.pi * steps / 200)
    pe[651:] -= 0.005
    events = np.array([(100 * n, 100 * n + 100, pe[100 * n] - pe[100 * n + 100]) for n in (0, 2, 6)] + [(650, 651, pe[650] - pe[651])],
                      [("step_start", float), ("step_end", float), ("size", float)])
    found = lsm_slip.jumps(pe, steps, events)
    assert list(found[:2]) == [0, 0] and 0.2 < found[2] < 0.25 and found[3] == pytest.approx(1.0), found


def test_springs_are_loaded_while_they_slip():
    """Plates put in 0.01 a time; friction takes that up in events of 2 in each 10, which it leaves with nothing but these."""
    t = 10.0 * np.arange(1, 101)
    kinds = [("t_start", float), ("t_end", float), ("size", float), ("friction_work", float), ("friction_total", float)]
    found = np.array([(a, a + 2, 0.08, 0.1, 0.1 * n) for n, a in enumerate(t)], kinds)
    excess, loaded = lsm_slip.excess_of(found)
    np.testing.assert_allclose(excess, 1.25)
    np.testing.assert_allclose(excess * found["size"] / (found["size"] + loaded), 1.0)


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
