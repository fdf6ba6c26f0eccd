# SPDX-License-Identifier: GPL-2.0-or-later
"""match.py, sequences.py, periods.py, nature.py and rupture_benchmark.py: examples by hand, chance, and what is refused."""
import json
import math
import sys

import numpy as np
import pytest
from data_files import power_law, rows, write_catalogue
from programs import SOURCE, Program, refused, run

RESULTS = SOURCE / "results"
sys.path.insert(0, str(RESULTS))
import match  # noqa: E402
import nature  # noqa: E402
import periods  # noqa: E402
import rupture_benchmark as benchmark  # noqa: E402
import rupture_varied  # noqa: E402
import sequences  # noqa: E402
from lsm.analysis import mean_and_error  # noqa: E402

# ---- match.py


def catalogue(starts, sizes):
    return np.array(starts, float), np.array(sizes, float), starts[-1]


def test_matches_by_hand():
    # 10 matches 10.5, which is nearer than 9.2; nothing is left for 10.8; 20 is three times as large, 30 is too far, 40 matches, 50 is
    # too small, 60 and 90 are not in both.
    first = catalogue([0, 10, 10.8, 20, 30, 40, 50, 60], [9, 1, 1, 3, 1, 1, 0.5, 1])
    second = catalogue([5, 9.2, 10.5, 20, 31.5, 40, 50, 55], [1, 1, 1, 1, 1, 1.9, 1, 1])
    found = match.matches(first, second, 1.0, 1.0)
    assert (found["n_first"], found["n_second"], found["same"]) == (5, 7, 2)
    assert match.matches(first, first, 1.0, 1.0)["same"] == 6
    with pytest.raises(ValueError, match="no time in common"):
        match.matches(catalogue([0, 1], [1, 1]), catalogue([5, 6], [1, 1]), 1.0, 1.0)


def test_matches_by_chance():
    rng = np.random.default_rng(1)
    first, second = (catalogue(np.cumsum(2 * rng.uniform(size=20000)), np.ones(20000)) for _ in range(2))
    found = match.matches(first, second, 1.0, 0.1)
    # Both have a rate of 1: there is an event within 0.1 on either side in a share of 0.18 to 0.2 of the cases, with and without a shift.
    assert found["chance"] / found["n_first"] == pytest.approx(0.18, abs=0.02)
    assert found["same"] == pytest.approx(found["chance"], abs=4 * 60)


def test_match_of_files(work):
    """The second catalogue is at a tenth of the velocity, its plates begin to move at time 100 as well, and every other event is the
    same. From 1.3 to 40 the first has 39 events (2 to 40), of which the second has the even ones. Of the seven shifts by eighths of
    38.7 the second, fourth and sixth find 5, 10 and 19."""
    k = np.arange(1, 41)
    for path, velocity, factor in ("a.csv", "1e-3", 1), ("b.csv", "1e-4", 10):
        t = 100 + factor * (1000.0 * k + np.where((factor > 1) & (k % 2 == 1), 300, 0))
        write_catalogue(path, t, [1] * 40, dict(model="lsm", length=40, velocity=velocity), t_end=t + 1, pe_start=[2] * 40, pe_end=[1] * 40)
    script = Program("match.py", sys.executable, RESULTS / "match.py")
    run(script, "a.csv b.csv --origin 100 --threshold 0.5 --within 0.1 --json m.json")
    found, = json.load(open("m.json"))["matches"]
    assert [found[key] for key in ("smallest_size", "n_first", "n_second", "same")] == [0.5, 39, 40, 20]
    assert found["chance"] == pytest.approx(34 / 7)
    run(script, "a.csv b.csv --origin 100 --from 11000 --threshold 0.5 --within 0.1 --json m.json")
    later, = json.load(open("m.json"))["matches"]
    assert (later["n_first"], later["same"]) == (30, 15), "from the eleventh on"
    refused(script, "a.csv b.csv --threshold 0.5 --within 0.1 --to 0.01", "a.csv: a catalogue without events")
    write_catalogue("still.csv", [1, 2], [1, 1])
    refused(script, "a.csv still.csv --threshold 0.5 --within 0.1", "still.csv: no velocity in the header")


# ---- sequences.py


def test_sequences_by_hand(work):
    """Main shocks at 100, 320 and 500. One at 20 has too little time before it, that at 905
    too little after it, and 300 is followed by a larger one. Around 100, which ends at 102: 58 is too early, 70 and 96 come before, as
    does 85, which ends at 99.5, too late to be counted; 100.5 is within, 102.5 too soon, 112 and 142 come after, 143 too late."""
    starts = [0, 20, 58, 70, 85, 96, 100, 100.5, 102.5, 112, 142, 143, 300, 320, 499, 500, 540, 905, 910]
    sizes = [1, 9, 1, 1, 1, 1, 9, 1, 1, 1, 1, 1, 9, 10, 0.1, 9, 1, 9, 1]
    lasts = {85.0: 14.5, 100.0: 2, 58.0: 1}
    ends = [t + lasts.get(t, 0) for t in map(float, starts)]
    write_catalogue("a.csv", starts, sizes, t_end=ends)
    script = Program("sequences.py", sys.executable, RESULTS / "sequences.py")
    run(script, "a.csv --threshold 0.5 --main-size 9 --window 40 --first 1 --json s.json")
    found = json.load(open("s.json"))
    # 320 and 500 are main shocks, too; 540 is at the end of the window of the latter.
    assert found["sequences"] == [dict(main_shocks=3, events=3, before=3, why="3 events after main shocks, at least 20 needed")]
    assert [(round(row["bin_hi"], 3), row["count"], row["before"]) for row in found["rates"]] == [(3.162, 0, 0), (10.0, 0, 1), (31.623, 1, 2)]
    assert found["rates"][2]["rate"] == pytest.approx(1 / 3 / (10**1.5 - 10))
    refused(script, "a.csv --threshold 0.5 --main-size 9 --window 40 --first 40", "expected 0 < --first < --window")
    refused(script, "a.csv --threshold 0.5 --main-size 9 --window 40 --first 1 --from 1e6", "a.csv: a catalogue without events")


def test_decay_of_known_laws():
    """Omori's law with p = 0.8 alone and with as many events at a constant rate; a constant rate; a rate that rises."""
    decaying, even = power_law(0.8, 1, 1000, 3000), 1 + 999 * (np.arange(3000) + 0.5) / 3000
    assert sequences.decay(decaying, 1, 1000)["p"] == pytest.approx(0.8, abs=0.01)
    both = sequences.decay(np.concatenate([decaying, even]), 1, 1000)
    assert both["p"] == pytest.approx(0.8, abs=0.05) and both["gain"] > 100
    assert sequences.decay(even, 1, 1000) == dict(why="no decay: a constant rate fits as well")
    assert sequences.decay(power_law(-1, 1, 1000, 300), 1, 1000) == dict(why="the rate rises with time")


# ---- periods.py


def test_rayleigh_by_hand():
    # The phases differ by a quarter of a period: the resultant is the diagonal of the weights.
    times, weights = np.array([0, 0.25]), np.array([3.0, 4.0])
    for period, z in (1.0, 1.0), (0.25, 49 / 25), (0.5, 1 / 25):
        assert periods.rayleigh_z(times, weights, period) == pytest.approx(z)


def test_periods_of_files(work):
    rng, cycles = np.random.default_rng(3), np.arange(1, 81)
    for tied in True, False:
        slip = np.sort((cycles[:, None] + (0.1 if tied else 1.0) * rng.uniform(size=(80, 5))).ravel())
        write_catalogue("a.csv", slip / 5e-4, [0.1] * 400, dict(model="lsm", length=40, velocity=2.5e-4))  # two plates
        times, sizes = periods.slips_of("a.csv", 0, 1e-2)
        assert times == pytest.approx(slip) and set(sizes) == {0.1}
        assert (periods.rayleigh_z(times, sizes, 1.0) > 300) == tied


# ---- nature.py


def test_random_numbers_are_those_of_the_mersenne_twister():
    """The first of std::mt19937_64 with seed 1."""
    assert list((nature.random_numbers(1000)[:3] * 2**53).astype(int)) == [2469588189546311528 >> 11, 2516265689700432462 >> 11,
                                                                           8323445853463659930 >> 11]  # yapf: disable


def test_mean_and_error():
    assert mean_and_error([2.0, math.nan], [0.3, 0.1]) == (2.0, 0.3)
    assert mean_and_error([1.5, 1.5], [0.3, 0.4]) == pytest.approx((1.5, 0.25))
    assert mean_and_error([1.0, 3.0], [0.3, 0.4]) == pytest.approx((2.0, 1.0))
    assert math.isnan(mean_and_error([math.nan])[0])


def test_distance_sees_the_law_and_not_the_unit():
    rng = np.random.default_rng(4)
    a, b = rng.exponential(size=1000), 50 * rng.exponential(size=1000)
    value, error = nature.distance_and_error(a, b, 100)
    assert value < 0.07 and 0.005 < error < 0.03
    assert nature.distance_and_error(a, b**2, 100)[0] > 0.15


def test_events_around_large_ones():
    # Every tenth event is large, and is soon followed by three others while it lasts or not; others by 2, 1, 0, five times 1, 0.
    starts = np.array([100.0 * k + (0.01 * i if i < 4 else 9.0 * i) for k in range(50) for i in range(10)])
    sizes = np.where(np.arange(500) % 10, 1.0, 10.0)
    numbers = nature.sample_of(starts, starts, sizes, 1.0)[2]
    assert numbers["after"][0] == pytest.approx(3.0 / (8 / 9))
    lasting = nature.sample_of(starts, starts + np.where(sizes > 1, 0.015, 0.0), sizes, 1.0)[2]
    assert lasting["after"][0] == pytest.approx(2.0 / (8 / 9))
    with pytest.raises(ValueError, match="all events start at the same time"):
        nature.sample_of(np.ones(9), np.ones(9), np.ones(9), 1.0)


def test_nature_of_a_catalogue(postproc, work):
    script = Program("nature.py", sys.executable, RESULTS / "nature.py", postproc.path)
    chain = RESULTS / "catalogues/slider_ours_256_seed_1.catalogue.csv.xz"
    run(script, chain, "--from 12000 --threshold 1 --json n.json")
    quakes, model = json.load(open("n.json"))["models"]
    assert quakes["label"] == "Southern California" and quakes["distance"] is None and quakes["events"] == 6621
    assert 0.1 < model["distance"] and 0 < model["distance_error"] < model["distance"]
    # The fits are those of intervals.
    run(postproc, "intervals", chain, "--from 12000 --threshold 1 --rescale --method likelihood --delta 1 --replicas 0 --no-picture --json i.json")
    fit = json.load(open("i.json"))["fits"][0]
    assert (model["gamma"], model["gamma_error"]) == (fit["gamma"], fit["gamma_error"])
    refused(script, [chain, "--threshold", "0"], "--threshold 0 has no magnitude")
    # Thrice the same catalogue: no scatter, and errors of a third of the variance. Of two, errors are half of the difference.
    thrice = nature.rows_of(postproc.path, {"thrice": [chain] * 3}, ["1"], [2.0], 12000, 20)[1]
    twice = nature.rows_of(postproc.path, {"twice": [chain, chain]}, ["1"], [2.0], 12000, 20)[1]
    once = nature.rows_of(postproc.path, {"once": [chain]}, ["1"], [2.0], 12000, 20)[1]
    assert twice["catalogues"] == 2 and twice["distance"][0] == once["distance"][0]
    assert thrice["catalogues"] == 3 and thrice["distance"][0] == pytest.approx(once["distance"][0]) and twice["distance"][1] == 0
    assert thrice["distance"][1] == pytest.approx(once["distance"][1] / math.sqrt(3))


# ---- rupture_benchmark.py


def ramp(top, h, end=4.0):
    """Slip rate that rises from 0 to `top` between the times 1 and 2, sampled at intervals of h."""
    t = np.arange(0, end + 1e-9, h)
    up = np.clip(t - 1, 0, 1)
    return np.array([t, top * (0.5 * up * up + np.maximum(t - 2, 0)), top * up])


def test_arrival_is_between_samples(monkeypatch):
    monkeypatch.setattr(benchmark, "ARRIVED", 1.1)
    assert benchmark.arrival(ramp(2.0, 0.25)) == pytest.approx(1.55)
    assert math.isnan(benchmark.arrival(ramp(1.0, 0.25)))


def test_misfit_of_a_multiple():
    m = benchmark.misfit(ramp(2.2, 0.01), ramp(2.0, 0.05), 100.0)
    assert (m["slip_l2"], m["rate_l2"]) == pytest.approx((0.1, 0.1), abs=1e-3)
    assert m["end_slip"] / m["reference_end_slip"] == pytest.approx(1.1) and m["peak_rate"] / m["reference_peak_rate"] == pytest.approx(1.1)
    assert m["arrival"] - m["reference_arrival"] == pytest.approx(1 / 2.2 - 1 / 2.0)
    # Only times that both have count.
    m = benchmark.misfit(ramp(2.0, 0.01, 2.5), ramp(2.0, 0.05), 100.0)
    assert (m["end_slip"], m["reference_end_slip"]) == pytest.approx((2.0, 2.0))
    assert benchmark.misfit(ramp(2.0, 0.01), ramp(2.0, 0.05), 1.5)["end_slip"] == pytest.approx(0.25)
    with pytest.raises(ValueError, match="no time in common"):
        benchmark.misfit(ramp(2.0, 0.01), ramp(2.0, 0.05), -1.0)


def test_summary_is_root_mean_square():
    a = dict(arrival=1.3, reference_arrival=0.9, end_slip=1.1, reference_end_slip=1.0, slip_l2=0.1, rate_l2=0.3, peak_rate=1.0,
             reference_peak_rate=1.0)
    b = a | dict(arrival=1.0, end_slip=1.9, reference_end_slip=2.0, rate_l2=0.4, peak_rate=0.8)
    s = benchmark.summary([a, b])
    assert (s["arrival"], s["arrival_max"]) == pytest.approx((math.sqrt((0.16 + 0.01) / 2), 0.4))
    assert (s["slip"], s["slip_max"], s["slip_l2"]) == pytest.approx((math.sqrt(0.02 / 5), 0.1, 0.1))
    assert (s["rate_l2"], s["peak"]) == pytest.approx((math.sqrt(0.125), math.sqrt(0.04 / 2)))


def test_energy_release_rate_of_a_static_crack(monkeypatch):
    """From the slip of a crack under uniform stress, 2 (1 - nu) / mu times the stress times sqrt(a^2 - x^2)."""
    monkeypatch.setattr(rupture_varied, "NUCLEUS", 0.0)
    a, t = rupture_varied.EDGE - 50, np.array([0.0, 1.0])
    factor = 2 * (1 - rupture_varied.POISSON) / rupture_varied.MODULUS * rupture_varied.DROP
    curves = {x: np.array([t, t * factor * math.sqrt(a * a - x * x), 0 * t]) for x in np.arange(0, a, 100)}
    rate = rupture_varied.held_rate(curves, 100.0)[1]
    assert rate[0] == 0 and rate[1] == pytest.approx(rupture_varied.static_rate() * a / rupture_varied.EDGE, rel=2e-3)
    # Fast enough to have arrived up to 4 km
    moving = {x: np.array([t, t, t * (2 if abs(x) <= 4000 else 0)]) for x in np.arange(-6000, 6001, 500)}
    assert rupture_varied.reach(moving) == 4000


def test_references_that_are_none_are_refused(work):
    script = Program("rupture_benchmark.py", sys.executable, RESULTS / "rupture_benchmark.py")
    (work / "run.slip.bin").write_bytes(b"")
    for text, said in (("curve,x,t,slip,slip_rate\n", "reference.csv: no rows, expected those of the columns 'curve,x,t,slip,slip_rate'"),
                       ("a,b\n", "reference.csv: expected the columns"), ("curve,x,t,slip,slip_rate\na,0,1,x,1\n",
                                                                          "reference.csv:2: 'a,0,1,x,1', expected a name and four numbers"),
                       ("curve,x,t,slip,slip_rate\na,0,1,1,1\na,0,1,1,1\n", "reference.csv:3: time 1, expected increasing times"),
                       ("curve,x,t,slip,slip_rate\na,0,1,1,1\n", "run.slip.bin: no slip history")):
        (work / "reference.csv").write_text(text)
        refused(script, "run.slip.bin --reference reference.csv -o out --no-picture", said)
