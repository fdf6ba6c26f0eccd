# SPDX-License-Identifier: GPL-2.0-or-later
"""lsm.ruptures: numbers, relations, slip histories and maps of ruptures with known answers, and their pictures."""
import json
import os
import re
import sys
from pathlib import Path

import numpy as np
import pytest
from data_files import edit, rows, write_catalogue, write_history
from figure_data import fault, pictures, ruptures, said
from programs import SOURCE, Program, refused, run

sys.path.insert(0, str(SOURCE / "python"))
import lsm.ruptures  # noqa: E402
from lsm.ruptures import Map, fit  # noqa: E402

pytestmark = pytest.mark.usefixtures("gnuplot")
SCRIPT = Program("lsm.ruptures", sys.executable, "-m", "lsm.ruptures", env={"PYTHONPATH": str(SOURCE / "python"), "LC_ALL": "C.UTF-8"})
DRAWN = ("csv", "png", "svg")


def do(*arguments):
    return run(SCRIPT, *arguments)


def no(pattern, arguments):
    return refused(SCRIPT, arguments, pattern)


def numbers(path):
    return np.array([[float(cell) for cell in row.split(",")] for row in rows(path)]).T


def test_ruptures():

    def slope(path, pattern, wanted):
        """Asserts that the line states this slope, and a scatter of 0, up to rounding."""
        line = next(line for line in Path(path).read_text().splitlines() if re.search(pattern, line))
        value, scatter = re.search(r"slope ([0-9.e-]+) .*, scatter ([0-9.e-]+) decades \(n", line).groups()
        assert float(value) == pytest.approx(wanted, abs=1e-12) and float(scatter) < 1e-12, line

    ruptures("a.csv")
    first = do("a.csv --label a -o r")
    pictures("r-lengths", "r-moments", "r-length", endings=DRAWN)
    # Lengths of 1 to 39 occur once each, and 40, 30, 25, 120: 43 in all, of which 8 from 25 to 30; T = 495.
    found = [[float(cell) for cell in row.split(",")[:8]] for row in rows("r-lengths.csv")]
    assert sum(row[5] for row in found) == 43 and [row[5] for row in found if row[2] == 24.5] == [8]
    for row in found:
        assert row[6] == pytest.approx(row[5] / (495 * 120 * (row[3] - row[2])), rel=1e-9)
        assert row[7] == pytest.approx(row[6] / np.sqrt(row[5]) if row[5] else 0)
    moments = [[float(cell) for cell in row.split(",")[:7]] for row in rows("r-moments.csv")]
    assert sum(row[5] for row in moments) == 43 and moments[0][2] <= 0.1 < moments[0][3]
    first.printed("^a: 43 ruptures")
    # For lengths below that of the fault, the slope is 2 without scatter.
    slope("r-length.csv", "^# fit, whole fault and short ones excluded: ", 2)
    flags = [row.split(",")[5] for row in rows("r-length.csv")]
    assert flags.count("1") == 1, "ruptures of the whole fault"
    do("a.csv a.csv --label one --label two --no-picture -o t")
    assert sum(row.split(",")[1] == "two" for row in rows("t-length.csv")) == 43 and not Path("t-length.png").exists()
    short = [line if line.startswith("#") else ",".join(line.split(",")[:11]) for line in Path("a.csv").read_text().splitlines()]
    Path("short.csv").write_text("\n".join(short) + "\n")
    no("short.csv: no catalogue of ruptures of a fault", "short.csv -o x")
    fault("plain.csv", [0.01], times=[5])
    no("plain.csv: no catalogue of ruptures of a fault", "plain.csv -o x")
    no("a.csv: no slip history", "a.csv --history a.csv -o x")
    Path("two.csv").write_text("".join(Path("a.csv").read_text().splitlines(True)[:7]))
    no("expected at least 3", "two.csv -o x")
    no("nowhere.csv", "nowhere.csv -o x")
    no("expected --from before --to", "a.csv --from 3 --to 2 -o x")
    no("--label 1 times, expected once for each of 2 catalogues", "a.csv a.csv --label one -o x")
    # What this program has not written is not replaced.
    os.rename("a.csv", "r-length.csv")
    no("r-length.csv exists and is not from an earlier run of this program", "r-length.csv -o r")


def test_logarithmic_fit():
    n = np.arange(1, 21)
    found = fit(n, 3.0 * n**2 * np.where(n % 2, 2.0, 0.5))  # up and down by log10(2)
    assert found.n == 20 and found.slope == pytest.approx(2, abs=0.15) and found.error > 0.01
    assert found.scatter == pytest.approx(np.log10(2), abs=0.02)
    exact = fit(n, 0.25 * n)
    assert (exact.slope, exact.intercept) == pytest.approx((1, np.log10(0.25))) and exact.scatter < 1e-9
    for x in [1, 2], [2, 2, 2]:
        with pytest.raises(ValueError, match="expected at least 3"):
            fit(np.array(x), np.array([1, 3, 5][:len(x)]))


def test_errors_of_slopes_hold():
    """Ruptures come in bursts in which all moments are off together, and the longer ones by more."""
    rng, slopes, errors = np.random.default_rng(2), [], []
    for _ in range(200):
        bursts = np.repeat(np.arange(60), 15)
        x = rng.uniform(0, 1.5, len(bursts))
        y = 2 * x + (0.2 * rng.normal(size=60)[bursts] + 0.1 * rng.normal(size=len(x))) * x
        one = fit(10**x, 10**y, bursts // 6)
        slopes.append(one.slope)
        errors.append(one.error)
        assert fit(10**x, 10**y).slope == pytest.approx(one.slope, rel=1e-12)
    assert np.std(slopes) == pytest.approx(np.sqrt(np.mean(np.square(errors))), rel=0.15)


def test_each_label_has_a_fit_of_long_ruptures():
    """Moments go as length^2 from 5 bins on, and twice as high in the second fault; those of one to four bins are far off the line."""
    rng = np.random.default_rng(1)
    for number, scale in enumerate((1.0, 1.0, 3.0)):
        length = np.concatenate([np.repeat([1.0, 2.0, 3.0, 4.0], 50), np.arange(5.0, 45.0)])
        rng.shuffle(length)
        moment = 0.1 * scale * length**(2 + (number == 2)) * np.where(length < 5, 30.0, 1.0)
        t = 10.0 * np.arange(len(length))
        head = dict(model="lsm", events="ruptures", length=120, slip_bin=1)
        more = dict(slip_moment=moment, rupture_length=length, x_hypocentre=0 * t, x_begin=0 * t, stress_drop=0.01 + 0 * t)
        write_catalogue(f"{number}.csv", t, 0.05 * moment, head, t_end=t + 1, pe_start=1 + 0 * t, pe_end=1 - 0.05 * moment, **more)
    words = "0.csv 1.csv 2.csv --label a --label a --label b --no-picture --json r.json -o r"
    do(words)
    a, b = json.loads(Path("r.json").read_text())["ruptures"]
    assert (a["label"], a["catalogues"], a["ruptures"], b["ruptures"], a["smallest_length"]) == ("a", 2, 480, 240, 5)
    assert a["rate"] == pytest.approx(480 / (2 * 2391 * 120)) and a["largest_moment"] == pytest.approx(0.1 * 44**2)
    for one, slope, n in (a, 2, 80), (b, 3, 40):
        assert (one["moment_by_length"]["n"], one["moment_by_length"]["slope"]) == (n, pytest.approx(slope, abs=1e-9))
    said("r-length.csv", "^# b, fit, whole fault and short ones excluded: slope 3 .*n = 40")
    do(words, "--min-length 1")
    assert json.loads(Path("r.json").read_text())["ruptures"][0]["moment_by_length"]["slope"] < 1.5
    do(words, "--min-length 44")
    assert json.loads(Path("r.json").read_text())["ruptures"][0]["moment_by_length"]["why"].startswith("2 ruptures for a fit")
    no("expected --from before --to, --min-length not below 0", "0.csv --min-length -1")


# ---- along a line: ten bins of width 2 and intervals of 4 steps of 0.25, which slip above 5 times the driving velocity of 0.001
PATTERN = ["..........", "1........2", ".........2", "....3.....", "..........", ".........."]


@pytest.fixture
def line():
    """One line of PATTERN per interval, one character per bin; a digit is the slip of the bin in hundredths. Two ruptures: one across the
    seam, and one of one bin."""
    slip = 0.01 * np.array([[0] * 10] + [[0 if c == "." else int(c) for c in row] for row in PATTERN])
    write_history("slip.bin", 4 * np.arange(7), slip, bin=2, interval=4, time0=50, dt=0.25, slip_velocity=0.005)
    columns = dict(step_start=[4, 12], step_end=[12, 16], slip_moment=[0.05 * 0.8, 0.03 * 0.8], rupture_length=[4, 2], x_hypocentre=[19, 9],
                   x_begin=[18, 8], stress_drop=[1, 1], pe_start=[1, 1])
    write_catalogue("r.csv", [51, 53], [1, 1], dict(model="lsm", events="ruptures", length=20, slip_bin=2, dt=0.25), t_end=[53, 54], **columns)
    history, one = lsm.ruptures.History("slip.bin"), lsm.ruptures.load("r.csv")
    return {figure.ending: figure for figure in lsm.ruptures.line_figures(history, one, -np.inf, np.inf, (2.0, 1.0))}


def test_space_and_time(line):
    found = line["-spacetime"].rows
    assert len(found) == 60
    slips = {(1, 51.5): 0.01, (19, 51.5): 0.02, (19, 52.5): 0.02, (9, 53.5): 0.03}
    for x, t, v in found:
        slip = slips.get((x, t), 0)
        assert v == pytest.approx(np.log10(slip / 0.001) if slip else 0, abs=1e-6), (x, t)
    # The outline across the seam is split into two closed lines of 5 points and a row that ends them.
    outlines = line["-spacetime-outlines"].rows
    assert len(outlines) == 18 and outlines[0] == [1, 18, 51] and outlines[2] == [1, 20, 53]
    assert outlines[5] == ["NaN"] * 3 and outlines[6] == [1, 0, 51] and outlines[8] == [1, 2, 52] and outlines[12][0] == 2


def test_detail_is_centred_on_the_first_place(line):
    middle = [(t, v) for x, t, v in line["-event"].rows if x == 0]
    assert min(middle, key=lambda pixel: abs(pixel[0] - 0.5))[1] == pytest.approx(np.log10(20), abs=1e-6)
    found = [row for row in line["-event-lines"].rows if row[0] != "NaN"]
    outline = [row for row in found if row[0] == 1]
    assert len(outline) == 9 and all(-1 <= x <= 3 for _, x, _ in outline)  # two bins in one closed line around the first place
    assert all(t * 2 == abs(x) for n, x, t in found if n == 2) and all(t == abs(x) for n, x, t in found if n == 3)
    assert next(slip for n, x, slip in found if n == 4 and x == 0) == pytest.approx(0.04, abs=1e-7)


def test_moment_rate_of_a_line(line):
    """The largest rupture slips by 0.03 in two intervals of 1, the second time by 0.02 in one of its two bins."""
    found = line["-momentrate"].rows
    assert [time for time, _ in found] == pytest.approx([0.5, 1.5])
    assert [rate for _, rate in found] == pytest.approx([0.4 * 2 * 0.03, 0.4 * 2 * 0.02])


def test_pictures_of_a_line(line):
    more = "3,53.5,54,12,16,1,1,0,0.008,6,9,8,1\n4,53.6,54,12,16,1,1,0,0.004,8,9,8,1\n"
    Path("three.csv").write_text(Path("r.csv").read_text() + more)
    do("three.csv --history slip.bin --p-speed 2 --s-speed 1 -o h --label", ["`touch marker` {a}_b"])
    pictures("h-spacetime", "h-event", "h-momentrate", "h-moments", endings=DRAWN)
    assert not Path("marker").exists()
    said("h-event.svg", "P-wave, speed 2")
    said("h-length.svg", re.escape("`touch marker` {a}_b (4 ruptures)"))
    no("slip.bin: nothing in the window of time", "three.csv --history slip.bin --from 60 --to 70 -o x")
    edit("three.csv", "other.csv", ("# dt = 0.25", "# dt = 0.5"))
    no("slip.bin: dt = 0.25, but 0.5 in other.csv: expected files of the same run", "other.csv --history slip.bin -o x")


# ---- on a plane


class Crack:
    """An elliptic crack that grows from a point at constant speeds along strike and dip, as Kostrov's, and stops everywhere at once: until
    then its slip is rate sqrt(t^2 - r^2), where r is the time at which it reaches a place. The hypocentre is in the middle of a cell."""
    speed, speed_dip, until, rate, modulus = 2.0, 1.0, 6.0, 0.5, 0.4
    direction = np.array([0.8, -0.6])

    def __init__(self, cell, shift=0):
        """shift: cells by which the hypocentre is moved along strike, on a ring"""
        bins, dip_bins = round(40 / cell), round(20 / cell)
        self.cell, self.duration = cell, 0.25 * cell
        self.x, self.z = ((bins // 2 + shift) % bins + 0.5) * cell, (dip_bins // 2 + 0.5) * cell
        x, z = (np.arange(bins) + 0.5) * cell, (np.arange(dip_bins) + 0.5) * cell
        dx = (x - self.x + 20) % 40 - 20 if shift else x - self.x
        self.reached = np.hypot(dx[:, None] / self.speed, (z - self.z) / self.speed_dip)
        count = round(self.until / self.duration)
        times = np.minimum(np.arange(-1, count + 1) * self.duration, self.until)[1:]
        slip = self.rate * np.sqrt(np.maximum(0, times[:, None, None]**2 - self.reached**2)) * (times[:, None, None] > 0)
        more = np.diff(slip, axis=0, prepend=0)
        write_history("c.slip.bin", 5 * np.arange(count + 1), more[..., None] * self.direction, bin=cell, bin_dip=cell, interval=5,
                      dt=self.duration / 5, slip_velocity=0.05, modulus=self.modulus)
        slid = self.reached < self.until
        strike, dip = np.flatnonzero(np.roll(slid, bins // 2 - int(self.x / cell), axis=0).any(axis=1)), np.flatnonzero(slid.any(axis=0))
        self.length, self.width = len(strike) * cell, len(dip) * cell
        begin = (strike[0] - bins // 2) * cell + self.x - 0.5 * cell
        write_catalogue("c.csv", [0], [1], dict(model="lsm", length=40, events="ruptures", slip_bin=cell, slip_bin_dip=cell), t_end=[self.until],
                        step_start=[0], step_end=[5 * count], slip_moment=[1], rupture_length=[self.length], x_hypocentre=[self.x],
                        x_begin=[begin % 40], stress_drop=[1], rupture_width=[self.width], z_hypocentre=[self.z], z_begin=[dip[0] * cell])
        self.map = Map(lsm.ruptures.History("c.slip.bin"), lsm.read_catalogue("c.csv")[0], 0.05)

    def moment(self, t):
        return self.modulus * self.rate * 2 / 3 * np.pi * self.speed * self.speed_dip * t**3

    def reached_in(self, plane):
        return np.hypot((plane.x - plane.x_first)[:, None] / self.speed, (plane.z - plane.z_first) / self.speed_dip)


def test_maps_of_an_elliptic_crack():
    late = None
    for cell in 0.5, 0.25:
        crack = Crack(cell)
        plane, reached = crack.map, crack.reached_in(crack.map)
        assert (plane.x_first, plane.z_first) == (crack.x, crack.z)
        came = reached < crack.until - 1e-9
        assert np.array_equal(np.isnan(plane.time), ~came)
        assert plane.slip[came] == pytest.approx(crack.rate * np.sqrt(crack.until**2 - reached[came]**2), abs=1e-5)
        assert (plane.rate[came] > 0.05).all()
        # The slip rate jumps within an interval; the middle of the one before is 1.5 before its end.
        worst = np.abs(plane.time - reached)[came].max()
        assert worst < 1.5 * crack.duration and (late is None or worst < 0.6 * late)
        late = worst
        # The moment rate adds up to the moment of the crack until then.
        time, along, down = plane.moment
        grown = np.cumsum(np.hypot(along, down)) * crack.duration
        assert grown == pytest.approx(crack.moment(time + 0.5 * crack.duration), abs=0.02 * cell * crack.moment(crack.until))
        assert down == pytest.approx(-0.75 * along, abs=1e-4 * along.max())


@pytest.mark.parametrize("cell", [39, -40, 1])
def test_map_across_the_seam(cell):
    crack = Crack(0.5, cell)
    plane = crack.map
    # The rectangle begins within the period, and may continue beyond its end.
    assert plane.x_first == pytest.approx(crack.x + 40 * (cell == -40)) and 0 <= plane.x[0] < 40
    assert plane.x.mean() == pytest.approx(plane.x_first, abs=1e-9)
    assert np.array_equal(np.isnan(plane.time), ~(crack.reached_in(plane) < crack.until - 1e-9))


def test_rupture_on_a_plane():
    # A rupture spreads from the middle of 21 x 11 cells of a half at a speed of 1; each cell slips by 0.3 along strike and -0.4 down dip,
    # evenly in the two time units from then on.
    x, z = np.meshgrid((np.arange(21) + 0.5) / 2, (np.arange(11) + 0.5) / 2, indexing="ij")
    begin, steps = np.hypot(x - 5.25, z - 2.75), np.arange(81)
    done = np.clip((0.1 * steps[:, None, None] - begin) / 2, 0, 1)
    write_history("p.slip.bin", steps, np.diff(done, axis=0, prepend=0)[..., None] * [0.3, -0.4], bin=0.5, bin_dip=0.5, dt=0.1)
    head = dict(model="lsm", length=10.5, events="ruptures", slip_bin=0.5, slip_bin_dip=0.5, dt=0.1, modulus=0.4)
    columns = dict(t_end=[8], step_start=[0], step_end=[80], slip_moment=[0.4 * 0.25 * 0.5 * 231], x_centroid=[5.25], rupture_length=[10.5],
                   x_hypocentre=[5.25], x_begin=[0], mean_slip=[0.5], stress_drop=[1], peak_slip=[0.5], moment_strike=[3], moment_dip=[-4],
                   z_centroid=[2.75], rupture_width=[5.5], rupture_area=[57.75], z_hypocentre=[2.75], z_begin=[0], peak_slip_rate=[0.25])
    write_catalogue("p.csv", [0], [1], head, **columns)
    do("p.csv --history p.slip.bin -o m").printed("no figures of all ruptures: 0 ruptures for a fit, expected at least 3")
    pictures("m-slip", "m-time", "m-rate", "m-momentrate", endings=DRAWN)
    for path, wanted, close in ("m-slip.csv", np.full((11, 21), 0.5), 1e-6), ("m-rate.csv", np.full((11, 21),
                                                                                                    0.25), 1e-6), ("m-time.csv", begin.T, 0.15):
        at_x, at_z, found = numbers(path)
        assert np.array_equal(at_x, x.T.ravel()) and np.array_equal(at_z, z.T.ravel())
        assert found == pytest.approx(wanted.ravel(), abs=close), path
    time, rate, along, down = numbers("m-momentrate.csv")
    assert rate == pytest.approx(np.hypot(along, down)) and along == pytest.approx(-0.75 * down)
    assert time[0] == pytest.approx(0.05) and rate.sum() * 0.1 == pytest.approx(0.4 * 0.25 * 0.5 * 231, rel=1e-6)
    for said_of in "m-time.svg", "m-slip.svg":
        said(said_of, "Along strike", "Along dip, upwards")
    # All cells slip at 0.25.
    do("p.csv --history p.slip.bin --arrival 0.24 --no-picture -o fast")
    assert (numbers("fast-time.csv")[2] > numbers("m-time.csv")[2]).all()
    no("p.slip.bin: rupture 1 slips at 0.25 at most, expected an arrival below it, not 0.26", "p.csv --history p.slip.bin --arrival 0.26 -o x")
    no("--arrival", "p.csv --history p.slip.bin --arrival 0 -o x")
    # What does not belong together is refused.
    write_history("line.slip.bin", steps, np.diff(done[:, :, 5], axis=0, prepend=0), dt=0.1, bin=0.5)
    no("p.csv: ruptures on a plane, expected its slip history, found that of a line", "p.csv --history line.slip.bin -o x")
    ruptures("a.csv")
    no("a.csv: ruptures along a line, expected its slip history, found that of a plane", "a.csv --history p.slip.bin -o x")
    write_history("short.slip.bin", steps[:40], np.diff(done[:40], axis=0, prepend=0)[..., None] * [0.3, -0.4], bin=0.5, bin_dip=0.5, dt=0.1)
    no("short.slip.bin: does not have all of rupture 1, expected its slip until step 80", "p.csv --history short.slip.bin -o x")
