# SPDX-License-Identifier: GPL-2.0-or-later
"""slip_or_exchange.py: runs whose friction, spectrum and load are known."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest
from data_files import read_catalogue, write_catalogue, write_history, write_series
from programs import SOURCE, Program, refused, run

sys.path.insert(0, str(SOURCE / "results"))
import slip_or_exchange  # noqa: E402
from lsm import slip as lsm_slip  # noqa: E402
from lsm.tables import read as table  # noqa: E402


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
    run(script, "kinds", "kinds.csv", "run.events.csv.xz", "quiet.events.csv.xz")
    rows = table("kinds.csv")
    assert [(row["run"], row["events"]) for row in rows] == [("run", "400"), ("quiet", "400")]
    chance = [float(row["chance"]) for row in rows]
    assert [float(row["slip"]) for row in rows] == pytest.approx([1.0, -chance[1] / (1 - chance[1])], abs=1e-9)
    for folder, name in ("slip", "run"), ("damping", "quiet"):
        Path(folder).mkdir()
        Path(f"{name}.events.csv.xz").rename(f"{folder}/fault.csv.xz")
    run(script, "rates", "rates", "slip/fault.csv.xz", "damping/fault.csv.xz")
    ringing, slipping = table("rates.csv")
    assert (ringing["fault"], slipping["fault"]) == ("hardly damped", "preset slip")
    whole = (steps[-1] - 9000) / cycles
    assert [float(row["all_0.01"]) for row in (ringing, slipping)] == pytest.approx([whole, whole], rel=0.01)
    assert float(slipping["slip_0.001"]) == pytest.approx(whole, rel=0.01) and ringing["slip_0.001"] == "" and slipping["all_0.1"] == ""


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
    assert lsm_slip.friction_share(found["size"], excess, loaded) == pytest.approx(1.0)


def test_random_phases_keep_the_spectrum():
    rng = np.random.default_rng(3)
    series = np.cumsum(rng.exponential(1.0, 4096) - 1.0)
    other = slip_or_exchange.with_phases(series, rng)
    spectra = [np.abs(np.fft.rfft(np.diff(one))) for one in (series, other)]
    # That at the highest frequency has no phase of its own.
    np.testing.assert_allclose(spectra[0][:-1], spectra[1][:-1], rtol=1e-6, atol=1e-6 * spectra[0].max())
    assert abs(np.corrcoef(np.diff(series), np.diff(other))[0, 1]) < 0.1


def test_an_oscillator_falls_once_in_each_period():
    """Its changes have the mean and the variance of those of the series, and a correlation that decays as the viscosity says."""
    rng, dt, viscosity = np.random.default_rng(3), 0.5, 0.01
    series = np.cumsum(rng.exponential(1.0, 400001) - 0.9)
    shaken = [slip_or_exchange.with_phases(series, rng, slip_or_exchange.oscillator(len(series) - 1, dt, v)) for v in (viscosity, viscosity / 10)]
    changes = np.diff(shaken[0])
    assert [changes.mean(), changes.std()] == pytest.approx([np.diff(series).mean(), np.diff(series).std()], rel=1e-6)
    assert slip_or_exchange.mean_return(shaken[1], dt) == pytest.approx(33.0, rel=0.03)
    changes -= changes.mean()
    later = round(66.0 / dt)
    assert np.mean(changes[later:] * changes[:-later]) / np.var(changes) == pytest.approx(math.exp(-viscosity * 66.0 / 2), abs=0.05)


def test_mean_return_of_an_oscillation():
    """An oscillation falls through zero once in each period; two of them as Rice's formula has it."""
    dt, time = 0.1, np.arange(200000) * 0.1
    one = np.sin(2 * math.pi * time / 25.0)
    assert slip_or_exchange.mean_return(one, dt) == pytest.approx(25.0, rel=0.01)
    low, high = 2 * math.pi / 50.0, 2 * math.pi / 5.0
    both = np.sin(low * time) / low + np.sin(high * time) / high  # changes of equal size
    gain = [1 / (1 + (w * slip_or_exchange.MEMORY)**2) for w in (low, high)]
    expected = 2 * math.pi * math.sqrt(sum(gain) / (gain[0] * low**2 + gain[1] * high**2))
    assert slip_or_exchange.mean_return(both, dt) == pytest.approx(expected, rel=0.02)


def test_surrogates_and_energies(script, postproc, work):
    """Springs that lend their energy to the load: drops of their energy, none of the sum."""
    dt, n = 0.1, 200001
    time = np.arange(n) * dt + 9000
    load, period = 0.03 * 120, 30.0
    approach = 0.01 * np.sin(2 * math.pi * time / period)
    write_series("run.pe.bin", 5.0 + 1e-6 * (time - 9000) + load * approach, dict(dt=dt, time0=9000, viscosity=0.001))
    # One event that counts as slip: friction takes up all that the springs lose in the first 200 steps.
    header = {"model": "lsm", "length": 120, "stress": 0.03, "dt": dt, "lambda": math.exp(-dt)}  # a memory of 1
    write_catalogue("run.catalogue.csv", [9001.0], [0.1], header, t_end=[9021.0], step_start=[10], step_end=[210])
    work_done = np.where(np.arange(n) < 211, 0.1 / 200, 0.0)
    write_history("run.slip.bin", np.arange(n), np.zeros((n, 4)), work=np.repeat(work_done[:, None] / 4, 4, axis=1), dt=dt)
    steps = np.arange(0, n, 4)
    np.savetxt("run.energy.txt", np.stack([steps, np.zeros(len(steps)), approach[::4], np.zeros(len(steps))], axis=1))
    run(script, "energies", postproc.path, "energies.csv", "run")
    springs, both, moving = table("energies.csv")
    drops = (time[-1] - time[0]) / period
    assert abs(float(springs["events"]) - drops) <= 2 and both["events"] == moving["events"] == "0", (springs, both)
    run(script, "surrogates", postproc.path, "surrogates.csv", "run")
    rows = table("surrogates.csv")
    assert [row["series"] for row in rows] == ["run", "without slip", "phases 1", "phases 2", "phases 3", "oscillator"]
    assert all(abs(float(row["one_in"]) - (33 if row["series"] == "oscillator" else period)) < 2 for row in rows), rows
    pe = 5.0 + 1e-6 * (time - 9000) + load * approach
    changes, left = np.diff(pe), np.diff(slip_or_exchange.without_slip("run", np.arange(n), pe))
    others = np.r_[0:10, 210:n - 1]
    np.testing.assert_allclose(left[others], changes[others], atol=1e-12)
    np.testing.assert_allclose(left[10:210], np.mean(changes[others]), atol=1e-12)


def test_kinetic_energy_in_stretches_of_time(script, work):
    steps = np.arange(0, 9001, 100)
    write_series("run.pe.bin", np.zeros(9001), dict(dt=1.0, step0=0, time0=0.0, stride=1))
    np.savetxt("run.energy.txt", np.column_stack([steps, np.where(steps < 4000, 1.0, 3.0), steps, steps]))
    run(script, "kinetic", "kinetic.csv", "run")
    assert [(float(row["begin"]), float(row["kinetic"])) for row in table("kinetic.csv")] == [(0, 1), (2000, 1), (4000, 3), (6000, 3)]


def test_brief_events_at_one_place(script, work):
    """Brief events at one place of ten, as a disc that snaps, which the long ones and random times do not show."""
    steps = np.arange(9000, 13001)
    slip = np.random.default_rng(2).uniform(0.0, 1.0, (len(steps), 10))
    begin, lasting = np.arange(9010, 12990, 20), np.where(np.arange(199) % 2, 2, 8)
    slip[begin[lasting == 2] - 8999, 4] = 9.0
    Path("one").mkdir()
    write_history("one/fault.slip.bin", steps, slip, dt=1.0, time0=9000)
    write_catalogue("one/fault.catalogue.csv", begin * 1.0, [0.01] * 199, dict(model="lsm", length=10, seed=1), t_end=(begin + lasting) * 1.0,
                    step_start=begin, step_end=begin + lasting)
    run(script, "places", "places.csv", "one/fault")
    row, = table("places.csv")
    assert (row["run"], row["events"], row["brief"]) == ("one", "199", "99")
    assert float(row["commonest"]) == 1.0 and float(row["at_random_times"]) < 0.4, row


def test_motion_of_two_discs(script, work):
    """A large disc swings with a period of 30 and a small one with 0.75; the kinetic energy of each is known."""
    dt, frames, discs = 0.1, 1200, ((1.0, 30.0, 2.0), (0.11, 0.75, 5.0))  # radius, period, speed
    write_catalogue("run.catalogue.csv", [1.0], [0.1], dict(model="lsm", length=10, seed=1, dt=dt))
    for n in range(frames):
        speeds = [speed * math.cos(2 * math.pi * n * dt / period) for _, period, speed in discs]
        lines = [f"{k} 1 0 0 0 {radius} {v} 0" for k, ((radius, _, _), v) in enumerate(zip(discs, speeds), 1)]
        Path(f"run.{n:09d}.dump").write_text("\n".join(["ITEM: TIMESTEP", str(n), "ITEM: ATOMS id type x y z radius vx vy", *lines, ""]))
    run(script, "motion", "motion.csv", "run")
    *periods, mass = table("motion.csv")
    found = {float(row["shortest"]): row for row in periods}
    small = 0.11**2 * 25 / (0.11**2 * 25 + 4)
    assert float(found[0.5]["share"]) == pytest.approx(small, abs=0.01)
    assert float(found[20]["share"]) == pytest.approx(1 - small, abs=0.01)
    assert float(found[0.5]["to_0.12"]) > 0.99 and float(found[20]["to_1.01"]) > 0.99
    assert float(mass["to_0.12"]) == pytest.approx(0.0121 / 1.0121)


def test_a_figure_over_viscosity_and_impedance(script, work):
    head = "point,stopped,memory,length,viscosity,impedance,mean_time_0.0001,gamma_0.0001,exponent_1e-4:1e-1,excess,in_events,roll_off_gain\n"
    Path("points.csv").write_text(head + "".join(f"d_{n},no,1,120,{v},{i},15,1,1.1,0.5,0.3,{'' if i else 20}\n"
                                                 for n, (v, i) in enumerate((v, i) for v in (1e-3, 1e-2) for i in (0, 0.6))))
    run(script, "decides", "out", "points.csv")
    assert "impedance 0.6, length 120" in Path("out.svg").read_text()
    assert Path("out.png").stat().st_size > 10000


def test_bad_input(script, work):
    refused(script, "events nowhere out.csv.xz", r"nowhere\.catalogue\.csv")
    assert not Path("out.csv.xz").exists()
    run(script, "unknown a b", status=1)


def test_quality_of_a_damped_oscillation(tmp_path):
    """An oscillation of period 33 whose amplitude decays as exp(-t / 200), above a drift and a small one that nothing damps."""
    dt = 0.1
    time = dt * np.arange(20000)
    pe = 1 + 1e-4 * time + np.exp(-time / 200) * np.sin(2 * np.pi * time / 33) + 1e-3 * np.sin(2 * np.pi * time / 22)
    write_series(tmp_path / "glued.pe.bin", pe, dict(dt=dt, viscosity=0.01, impedance=0))
    slip_or_exchange.quality(tmp_path / "q.csv", tmp_path / "glued")
    row = dict(zip(*(line.split(",") for line in (tmp_path / "q.csv").read_text().splitlines()[1:3])))
    assert float(row["rate"]) == pytest.approx(1 / 200, rel=0.02)
    assert float(row["quality"]) == pytest.approx(np.pi * 200 / 33, rel=0.02)
    assert row["stretches"] == "8"  # exp(-33 n / 200) < 0.3 from n = 8 on
