# SPDX-License-Identifier: GPL-2.0-or-later
"""lsm.scaling: characteristic sizes and their errors, block lengths, laws with known answers, and the program."""
import json
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from data_files import power_law, rows, write_catalogue
from figure_data import fault, pictures, slider
from programs import SOURCE, Program, refused, run

sys.path.insert(0, str(SOURCE / "python"))
import lsm.scaling as scaling  # noqa: E402
from lsm.drawing import axis  # noqa: E402
from lsm.scaling import NONE, POWER_LAW, Point, block_length, characteristic_size, error_scale, fit_scaling  # noqa: E402

SCRIPT = Program("lsm.scaling", sys.executable, "-m", "lsm.scaling", env={"PYTHONPATH": str(SOURCE / "python"), "LC_ALL": "C.UTF-8"})
DRAWN = ("csv", "png", "svg")
LENGTHS = 120, 240, 480, 945, 1440, 1890


def binomial(found, trials, p):
    """Asserts a count within three standard deviations of what is expected."""
    assert abs(found - trials * p) <= 3 * math.sqrt(trials * p * (1 - p)) + 1, (found, trials * p)


class Coverage:
    """How often an interval of one and of two standard errors holds the truth."""

    def __init__(self, truth):
        self.truth, self.off = truth, []

    def add(self, value, error):
        self.off.append(abs(value - self.truth) / error)

    def check(self):
        for width, p in (1, 0.6827), (2, 0.9545):
            binomial(sum(off < width for off in self.off), len(self.off), p)


# ---- characteristic sizes


def test_small_example_by_hand():
    sizes = np.array([1e-9, 0.5, -2.0, *range(1, 11)])
    point = characteristic_size(np.arange(13.0), sizes, 1.0, 120.0)
    # For independent events the error is sqrt(sum (s^2 - 7 s)^2) / 55.
    assert (point.n, point.length, point.s_star) == (10, 120.0, 385 / 55)
    assert point.error_independent == pytest.approx(math.sqrt(1848) / 55, abs=1e-12)


def test_errors_cover_the_truth():
    """Exponential sizes, <s^2> / <s> = 2, are resampled by events; uniform ones, 2 / 3, by blocks of time."""
    rng, by_event, by_block, times = np.random.default_rng(1), Coverage(2.0), Coverage(2 / 3), np.arange(2000.0)
    for seed in range(100):
        single = characteristic_size(times, rng.exponential(size=2000), 0.0, 1.0, 100, seed, 0.0)
        by_event.add(single.s_star, single.error)
        assert single.blocks == 0 and 0.6 < single.error / single.error_independent < 1.4
        point = characteristic_size(times, rng.uniform(size=2000), 0.0, 1.0, 200, seed)
        by_block.add(point.s_star, point.error)
        assert point.blocks > 100
    by_event.check()
    by_block.check()


TRUTH, PAUSE, DELAY = 2.5 * 13 / 12, 100.0, 30.0


def sequences(duration, rng):
    """Sequences that begin at random times, with 10 events on average. Their sizes are uniform from a/2 to 3a/2, where a is 1 or 3 for a
    whole sequence, so that <s> = 2, <s^2> = 5 * 13/12."""
    begin = np.cumsum(rng.exponential(PAUSE, int(2 * duration / PAUSE) + 100)) - 20 * DELAY
    begin = begin[begin < duration]
    many = rng.geometric(0.1, len(begin))
    mean = np.repeat(np.where(rng.uniform(size=len(begin)) < 0.5, 1.0, 3.0), many)
    at = np.repeat(begin, many) + rng.exponential(DELAY, many.sum())
    sizes = mean * rng.uniform(0.5, 1.5, many.sum())
    order = np.argsort(at)
    inside = (at[order] >= 0) & (at[order] < duration)
    return at[order][inside], sizes[order][inside]


def test_errors_cover_the_truth_though_events_come_in_sequences():
    # The error follows from the moments of a sequence: the number K of events is geometric, and with z = s^2 - truth s, the deviation
    # is the sum of z over the catalogue divided by that of s.
    number, variance = 300, 0.0
    for a in 1.0, 3.0:
        s2, s3, s4 = 13 / 12 * a**2, 1.25 * a**3, 1.5125 * a**4
        mean, square = s2 - TRUTH * a, s4 - 2 * TRUTH * s3 + TRUTH**2 * s2
        variance += 0.5 * (10 * (square - mean**2) + 190 * mean**2)
    known = math.sqrt(number * variance) / (number * 20)
    rng, blocks, by_event, found = np.random.default_rng(2), Coverage(TRUTH), Coverage(TRUTH), []
    for seed in range(120):
        times, sizes = sequences(number * PAUSE, rng)
        point, single = (characteristic_size(times, sizes, 0.0, 1.0, 100, seed, block) for block in (None, 0.0))
        assert single.s_star == point.s_star
        blocks.add(point.s_star, point.error)
        by_event.add(single.s_star, single.error)
        found.append((point.error, single.error, point.block))
    blocks.check()
    error, error_by_event, length = np.mean(found, axis=0)
    assert error / known == pytest.approx(1, abs=0.07) and error_by_event / known < 0.5
    assert np.mean(np.array(by_event.off) < 2) < 0.7, "independent events would not cover"
    assert 2 * DELAY < length < 40 * DELAY


def test_blocks_of_time():
    times, sizes = sequences(2e4, np.random.default_rng(3))

    def at(block):
        return characteristic_size(times, sizes, 0.0, 1.0, 400, 1, block)

    assert at(1000.0).blocks == 20 and at(1000.0).block == pytest.approx(1000, abs=30)
    # The shortest blocks contain at most one event, which is the same as resampling events.
    assert at(0.5).error / at(0.0).error == pytest.approx(1, abs=0.15) and at(1000.0).error / at(0.0).error > 1.3
    for block in 1.1e4, 0.05:
        with pytest.raises(ValueError, match="expected 0 or .* to half of the catalogue"):
            at(block)


def test_blocks_go_round_the_ring():
    """The pattern is periodic: every half of the ring contains five periods, wherever it begins."""
    point = characteristic_size(np.arange(40.0), 1.0 + np.arange(40) % 4, 0.0, 1.0, 200, 1, 20.0)
    assert point.blocks == 2 and point.error < 1e-9


def test_same_seed_same_error():
    for block in 0.0, 2.0:
        errors = [characteristic_size(np.arange(11.0), np.arange(1.0, 12.0), 0.0, 1.0, 50, seed, block).error for seed in (7, 7, 8)]
        assert errors[0] == errors[1] != errors[2] and errors[0] > 0


def test_no_characteristic_size():
    for times, sizes, why in ((9, np.ones(9), "9 events"), (50, np.ones(50), "the same size"), (50, np.arange(50) * 1e-200, "too small or too large"),
                              (50, np.arange(50) * 1e160, "too small or too large")):
        point = characteristic_size(np.arange(float(times)), sizes, 0.0, 1.0)
        assert why in point.why and math.isnan(point.s_star)
    assert "at the same time" in characteristic_size(np.full(50, 3.0), np.arange(50.0), 0.0, 1.0).why


# ---- lengths of blocks


def test_block_length_of_an_autoregressive_series():
    """x_i = rho x_(i-1) + noise has the covariances rho^|k|, from which the best length follows."""
    rng, n = np.random.default_rng(4), 8000
    for rho in 0.0, 0.6, 0.9:
        found = []
        for _ in range(40):
            noise, x = rng.normal(size=n), np.empty(n)
            last = rng.normal() / math.sqrt(1 - rho**2)
            for i in range(n):
                x[i] = last = rho * last + noise[i]
            found.append(block_length(x))
        best = max(np.cbrt(1.5 * (2 * rho / (1 - rho**2))**2 * n), 20)  # the cube root of n
        assert np.mean(found) / best == pytest.approx(1, abs=0.1), rho
    assert block_length(np.zeros(10)) == 1 and block_length(np.zeros(1000)) == pytest.approx(10)


def test_block_length_of_a_series_whose_correlation_ends():
    """Sums of five successive numbers are correlated up to lag 4. The same rule (Politis & White 2004), written out for this case: lags
    up to 4 count in full, 5 to 7 less and less, 8 not at all."""
    noise, n = np.random.default_rng(7).uniform(-0.5, 0.5, 4004), 4000
    x = sum(noise[k:k + n] for k in range(5))
    r = [np.dot(x[:n - lag], x[lag:]) / n for lag in range(10)]
    noticed = 2 * math.sqrt(math.log10(n) / n) * r[0]
    assert r[4] > noticed and max(np.abs(r[5:])) < noticed
    full = sum(r[1:5]) + 0.75 * r[5] + 0.5 * r[6] + 0.25 * r[7]
    moment = r[1] + 2 * r[2] + 3 * r[3] + 4 * r[4] + 3.75 * r[5] + 3 * r[6] + 1.75 * r[7]
    assert block_length(x) == pytest.approx(np.cbrt(1.5 * (2 * moment / (r[0] + 2 * full))**2 * n), abs=1e-9)


# ---- laws


def point(length, s_star, error):
    return Point(length, 1000, s_star, error)


def points_of(law, lengths, relative=0.01):
    return [point(length, law(length), relative * law(length)) for length in lengths]


def noisy(length, s, relative, rng):
    measured = s * math.exp(rng.normal(0, relative))
    return point(length, measured, relative * measured)


def test_probability_of_chi2():
    # Closed forms: e^-x/2, erfc((x/2)^1/2); percentiles of tables
    assert scaling.chi2_probability(3.0, 2) == pytest.approx(math.exp(-1.5))
    assert scaling.chi2_probability(3.0, 1) == pytest.approx(math.erfc(math.sqrt(1.5)))
    for freedom, value in (4, 13.276704), (5, 15.086272), (20, 37.566235):
        assert scaling.chi2_probability(value, freedom) == pytest.approx(0.01, rel=1e-6)
    assert scaling.chi2_probability(0.0, 3) == 1


def test_exact_power_law():
    fit = fit_scaling(points_of(lambda length: 0.02 * length**1.5, LENGTHS))
    assert (fit["D"], fit["A"], fit["chi2"]) == pytest.approx((1.5, 0.02, 0), abs=1e-12)
    assert fit["n"] == 6 and fit["preferred"] == POWER_LAW
    # For equal relative errors, the error is 0.01 / sqrt(sum (x - mean)^2).
    x = np.log(LENGTHS)
    assert fit["D_error"] == pytest.approx(0.01 / math.sqrt(np.sum((x - x.mean())**2)), abs=1e-12)
    assert fit["aicc"] == pytest.approx(2 * 2 + 12 / 3, abs=1e-12) and fit["aicc_constant"] == pytest.approx(fit["chi2_constant"] + 2 + 4 / 4)
    # The weights are those of the errors: a point that is off hardly counts if its error is large.
    off = points_of(lambda length: 0.02 * length**1.5, LENGTHS[:-1]) + [point(1890, 1.0, 1e3)]
    assert fit_scaling(off)["D"] == pytest.approx(1.5, abs=1e-6)


def test_errors_of_a_poor_law_grow_with_its_scatter():
    """Points scatter by a tenth but have stated errors of a hundredth: the errors of D cover nevertheless."""
    assert error_scale(6.0, 4) == 1 and error_scale(400.0, 4) == 10 and error_scale(5.0, 0) == 1
    rng, covered = np.random.default_rng(8), 0
    for _ in range(120):
        points = [noisy(length, length**0.5, 0.1, rng) for length in LENGTHS]
        fit = fit_scaling([one._replace(error=0.1 * one.error) for one in points])
        covered += abs(fit["D"] - 0.5) < fit["D_error"]
    assert covered / 120 == pytest.approx(0.63, abs=0.13)  # Student's t of 4 degrees


@pytest.mark.parametrize("truth", [0.0, 0.5])
def test_errors_cover_and_the_right_law_is_preferred(truth):
    rng, coverage, preferred, trials = np.random.default_rng(5), Coverage(truth), [], 150
    for _ in range(trials):
        fit = fit_scaling([noisy(length, 3 * length**truth, 0.1 if length < 1000 else 0.05, rng) for length in LENGTHS])
        coverage.add(fit["D"], fit["D_error"])
        preferred.append(fit["preferred"])
    coverage.check()
    if truth:
        assert preferred.count(POWER_LAW) == trials
    else:
        # AICc of 6 points: the power law has a penalty of 8 - 3 = 5. It is preferred if chi square falls by more than 7, and rejected if
        # by less than 3.
        binomial(preferred.count(POWER_LAW), trials, math.erfc(math.sqrt(7 / 2)))
        binomial(preferred.count(NONE), trials, math.erf(math.sqrt(3 / 2)))


def test_too_few_points():
    few = fit_scaling([point(1, 2, 0.1), point(2, 3, 0.1), point(3, 5, 0.1), Point(4, 3, why="3 events")])
    assert few == {"why": "3 usable lengths, at least 4 needed"}
    assert fit_scaling([point(120, 2, 0.1)] * 5) == {"why": "all models have the same length"}


def test_ticks_of_near_ends():
    """Powers of ten alone would be too few."""
    assert "set ytics (0.7, 0.8, 0.9, 1, 1.2, 1.4, 1.6, 1.8, 2)\nset yrange [0.7:2]\n" in axis("y", "s", 0.72, 1.9, True)
    assert "set xtics (100, 200, 500, 1000, 2000, 5000)\nset xrange [100:5000]\n" in axis("x", "L", 108, 2079, True)
    assert "set xtics 10\nset xrange [100:10000]\n" in axis("x", "L", 108, 7000, True)


# ---- the program

GROWING = 100, 200, 400, 800, 1600


def do(*arguments):
    return run(SCRIPT, *arguments)


@pytest.fixture
def growing(gnuplot):
    """Writes g*.csv with a roll-off at a size proportional to the length, and n*.csv, at the same size."""
    for length in GROWING:
        fault(f"g{length}.csv", power_law(1.2, 1e-3, length / 100, 3000), length)
        fault(f"n{length}.csv", power_law(1.2, 1e-3, 1, 3000), length)


def files(kind, lengths=GROWING):
    return " ".join(f"{kind}{length}.csv" for length in lengths)


def numbers(path):
    return json.loads(Path(path).read_text())["scaling"]


def test_program(growing):
    do(files("g"), "--json g.json -o g").printed(r"grows with the length \(")
    pictures("g", endings=DRAWN)
    assert numbers("g.json")[0]["D"] == pytest.approx(1, rel=0.1)
    do(files("n"), "--json n.json -o n").printed("shows no significant dependence")
    assert numbers("n.json")[0]["preferred"] == "no dependence on the length"
    # Errors are by blocks of time, the length of which can be given, or event by event.
    do(files("n"), "--no-picture -o n").printed("bootstrap errors, blocks of time")
    two = files("g", (100, 200))
    do(two, "--block 1000 --json b.json -o b --no-picture")
    for row in rows("b.csv"):
        cells = row.split(",")
        assert 990 < float(cells[7]) < 1010 and cells[8] == "30", row
    do(two, "--block 0 -o b --no-picture").printed("single events as if independent")
    for row in rows("b.csv"):
        error, independent, block = (float(row.split(",")[k]) for k in (4, 6, 7))
        assert block == 0 and 0.8 * independent < error < 1.2 * independent, row
    refused(SCRIPT, "g100.csv --block 20000 -o x", "block of 20000, expected 0 or .* to half of the catalogue")


def test_kinds_and_smallest_sizes():
    """Models, kinds of events and leaf springs are apart; a completeness and a smallest size in a header hold for a model's kind."""
    sizes = power_law(1, 1e-3, 1, 1000)
    above = int(np.sum(sizes >= 0.01))
    fault("plain.csv", sizes)
    fault("known.csv", sizes, 240, completeness=0.01)
    fault("ruptures.csv", sizes, events="ruptures")
    for kl in 0.01, 0.1:
        slider(f"s{kl}.csv", sizes, kl=kl)
    names = "plain.csv known.csv ruptures.csv s0.01.csv s0.1.csv"
    said = do(names, "--no-picture --json k.json -o k")
    found = numbers("k.json")
    assert [(one["model"], one["events"], one["kl"]) for one in found] == [("lsm", "pe", ""), ("lsm", "ruptures", ""), ("block-slider", "pe", "0.01"),
                                                                          ("block-slider", "pe", "0.1")]  # yapf: disable
    assert [one["threshold_from"]
            for one in found[:2]] == ["0.01, completeness in the header of known.csv", "0.0001, that of the paper's Figs. 12 and 13"]
    assert [point["n"] for point in found[0]["points"]] == [above, above] and found[1]["points"][0]["n"] == 1000
    said.printed("finite-size scaling, fault, ruptures: ")
    said.printed("block-slider, N = 256 .s0.1.: 1000 events")
    do(names, "--threshold 1e-3 --no-picture --json k.json -o k")
    assert numbers("k.json")[0]["threshold_from"] == "0.001, as given"
    fault("picked.csv", sizes, 480, min_size=0.02)
    do("plain.csv picked.csv --threshold 1e-3 --label a --label b --no-picture --json k.json -o k")
    assert numbers("k.json")[0]["threshold_from"] == "0.02, where b begins"
    do("plain.csv --from 1000 --to 3000 --no-picture -o k").printed("length 120: 200 events")


def test_what_is_refused(gnuplot):
    fault("none.csv", [])
    fault("few.csv", 0.01 * np.arange(1, 7), 240, times=np.arange(6)**2)
    few = do("none.csv few.csv -o z")
    few.printed("few.csv|length 240: 6 events, 6 events above the threshold, at least 10 needed")
    assert "no catalogue gives a characteristic size" in Path("z.svg").read_text() and len(rows("z.csv")) == 2
    write_catalogue("short.csv", [1], [1], dict(model="lsm"))
    refused(SCRIPT, "short.csv -o x", "short.csv: neither length nor blocks above 0 in the header")
    fault("bad.csv", [1], completeness="small")
    refused(SCRIPT, "bad.csv -o x", "bad.csv: parameter 'completeness' is 'small', expected a number")
    refused(SCRIPT, "few.csv --label a --label b -o x", "--label 2 times, expected once for each of 1 catalogues")
    refused(SCRIPT, "few.csv --from 3 --to 2 -o x", "expected --from before --to")
    refused(SCRIPT, "nowhere.csv -o x", "nowhere.csv")
    Path("broken.csv").write_text(Path("few.csv").read_text() + "broken\n")
    refused(SCRIPT, "broken.csv -o x", "broken.csv:11: 'broken', expected 8 numbers")
    do("broken.csv --lenient --no-picture -o x").printed("length 240: 6 events")
    # What this program has not written is not replaced.
    Path("mine.csv").write_text("a,b\n")
    refused(SCRIPT, "few.csv -o mine", "mine.csv exists and is not from an earlier run of this program")


def test_published_table():
    """The numbers of the first version of this analysis, by which a length of 120 has 411 events and blocks of 2485.448 time units."""
    paths = sorted((SOURCE / "results/campaign").glob("fault_120_*.catalogue.csv.xz"))
    one = scaling.scalings(scaling.with_labels([scaling.load(path, 8000) for path in paths]), 1e-3)[0].points[0]
    assert (one.n, one.blocks) == (411, 55)
    assert (one.s_star, one.error, one.error_independent, one.block) == pytest.approx(
        (0.93915177268061567, 0.075154294438572966, 0.082581610583789961, 2485.448046119734), rel=1e-12)
