# SPDX-License-Identifier: GPL-2.0-or-later
"""Magnitudes of earthquakes: the file's decimals are compared, binned and written as they are. The reference is exact arithmetic, of decimals."""
import collections
import datetime
import functools
import json
import lzma
import math
import re
from decimal import Decimal, getcontext
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from data_files import table, write_catalogue
from programs import SOURCE, refused, run

CALIFORNIA = SOURCE / "inputs/seismicity/southern-california.csv.xz"
getcontext().prec = 40


def quakes(path, magnitudes, hours=1.0, place="30,-120"):
    """Writes earthquakes with these magnitudes (texts), one after another."""
    start = datetime.datetime(1980, 1, 1)
    lines = [f"{(start + datetime.timedelta(hours=hours * k)).isoformat()}Z,{place},{m}" for k, m in enumerate(magnitudes)]
    Path(path).write_text("time,latitude,longitude,mag\n" + "\n".join(lines) + "\n")
    return path


def gutenberg_richter(n, width, b=1.0, least=2.0, seed=1):
    """Texts of magnitudes with this b, rounded to multiples of width from least on."""
    u = np.random.default_rng(seed).exponential(1 / (b * math.log(10)), n) + least - width / 2
    return [f"{Decimal(int(math.floor(m / width + 0.5))) * Decimal(str(width))}" for m in u]


fraction = functools.lru_cache(None)(Fraction)


class Exact:
    """b, b-positive, completeness and counts of decimal magnitudes, in exact arithmetic up to the logarithms."""

    def __init__(self, magnitudes, width):
        self.width = Fraction(width)
        self.all = [self.binned(m, self.width) if self.width else m for m in map(fraction, magnitudes)]

    @staticmethod
    @functools.lru_cache(None)
    def binned(m, width):
        return math.floor(m / width + Fraction(1, 2)) * width

    def curvature(self, width):
        counts = collections.Counter(self.binned(m, Fraction(width)) for m in self.all)
        return min(m for m in counts if counts[m] == max(counts.values())) + Fraction(1, 5)

    def b_of(self, excess):
        """b of values above the least possible one."""
        mean, w = sum(m * n for m, n in collections.Counter(excess).items()) / len(excess), self.width
        ln10 = Decimal(10).ln()
        mean, w = (Decimal(x.numerator) / Decimal(x.denominator) for x in (mean, w))
        return float((1 + w / mean).ln() / (w * ln10) if w else 1 / (mean * ln10)), len(excess)

    def b(self, least):
        least = Fraction(least)
        if self.width:  # the lowest bin whose centre is complete
            least = math.ceil(least / self.width) * self.width
        kept = [m for m in self.all if m >= least]
        up = [after - before for before, after in zip(kept, kept[1:]) if after > before]
        return self.b_of([m - least for m in kept]), self.b_of([step - self.width for step in up]), least


@pytest.fixture(scope="module")
def california():
    """Texts of the magnitudes, in order of time."""
    lines = lzma.open(CALIFORNIA, "rt").read().splitlines()
    names = lines[0].split(",")
    time, mag = names.index("time"), names.index("mag")
    fields = [line.split(",") for line in lines[1:]]
    return [f[mag] for f in sorted(fields, key=lambda f: f[time])]


def b_values(postproc, *words):
    run(postproc, "magnitudes", *words, "--no-picture -o m --overwrite")
    found = table("m.bvalues.csv")[0]
    numbers = "completeness", "maximum_curvature", "n", "b", "n_positive", "b_positive"
    return {key: float(found[key]) if found[key] not in ("", "nan") else None for key in numbers}


# ---------------------------------------------------------------- bins and limits


@pytest.mark.parametrize("width", ["0", "0.01", "0.1", "0.2"])
def test_southern_california_is_exact(postproc, work, california, width):
    exact = Exact(california, width)
    curvature = exact.curvature(width if width != "0" else "0.1")
    (b, n), (positive, n_positive), least = exact.b(curvature)
    found = b_values(postproc, CALIFORNIA, f"--complete-from curvature --magnitude-bin {width}")
    assert found == {
        "completeness": float(least), "maximum_curvature": float(curvature), "n": n, "b": pytest.approx(b, rel=1e-12), "n_positive": n_positive,
        "b_positive": pytest.approx(positive, rel=1e-12)
    }
    page = (SOURCE / "postproc/statistics.md").read_text()
    assert f"| {width} | {float(least):g} | {n} | {b:.3f} | {positive:.3f} |" in page


def test_what_is_complete_depends_on_the_events_in_the_window_only(postproc, work):
    """The older half has smaller earthquakes; in the window it is as if they were not in the file."""
    older, newer = gutenberg_richter(3000, 0.1, least=1.0, seed=2), gutenberg_richter(3000, 0.1, least=2.0, seed=3)
    quakes("both.csv", older + newer)
    lines = Path("both.csv").read_text().splitlines(keepends=True)
    Path("late.csv").write_text("".join(line for line in lines if not line[0].isdigit() or line >= "1980-05-05"))
    for command in "magnitudes {} --no-picture -o out --overwrite --json b.json", "fit {} --overwrite --json b.json":
        found = []
        for file in "both.csv --from 1980-05-05", "late.csv":
            run(postproc, command.format(file))
            told = json.loads(Path("b.json").read_text())
            found.append([{key: value for key, value in row.items() if key != "label"} for row in told.get("b_values", told.get("fits"))])
        assert found[0] == found[1] and found[0]


def test_the_page_has_the_densities_of_histograms(postproc, work):
    quakes("tenths.csv", gutenberg_richter(2000, 0.1))
    run(postproc, "explore tenths.csv -o page.html")
    run(postproc, "histograms tenths.csv --no-picture -o sizes")
    page = json.loads(re.search(r"<script[^>]*json[^>]*>(.*?)</script>", Path("page.html").read_text(encoding="utf-8"), re.S)[1])
    shown = page["runs"][0]["kinds"][0]["densities"]
    rows = [row for row in table("sizes.csv") if int(row["count"]) > 0]
    assert [row[4] for row in shown] == [int(row["count"]) for row in rows] and len(rows) > 15
    assert [row[2] for row in shown] == pytest.approx([float(row["density"]) for row in rows], rel=1e-5)


def test_bins_wider_than_the_step_begin_with_a_whole_one(postproc, work, california):
    """Half of the bin of M 2 is below the smallest magnitude."""
    found = b_values(postproc, CALIFORNIA, "--magnitude-bin 0.1")
    (b, n), _, _ = Exact(california, "0.1").b("2.1")
    assert (found["completeness"], found["n"]) == (2.1, n) and found["b"] == pytest.approx(b, rel=1e-12)
    assert b_values(postproc, CALIFORNIA, "--magnitude-bin 0.1 --complete-from 2")["completeness"] == 2
    assert b_values(postproc, CALIFORNIA, "--magnitude-bin 0.1 --min-magnitude 2.3")["completeness"] == 2.4
    found = b_values(postproc, CALIFORNIA)
    (b, n), _, _ = Exact(california, "0.01").b("2")
    assert (found["completeness"], found["maximum_curvature"], found["n"]) == (2, 2.3, n) and found["b"] == pytest.approx(b, rel=1e-12)


def test_law_is_drawn_from_the_edge_at_which_it_begins(postproc, work):
    """The first bin holds all events, and so does the line at its lower edge."""
    quakes("q.csv", gutenberg_richter(500, 0.5))
    run(postproc, "magnitudes q.csv --magnitude-bin 0.5 -o m")
    assert "500*10**" in Path("m.gp").read_text() and "($1-(1.75))" in Path("m.gp").read_text()


# ---------------------------------------------------------------- recognized bins


@pytest.mark.parametrize("width,offset", [("0.3", "0"), ("0.25", "0.125")])
def test_bins_of_any_step_and_offset(postproc, work, width, offset):
    """Recognized, or given as they are: bins that begin with a whole one, counted, fitted and drawn about their centres."""
    magnitudes = [str(Decimal(m) + Decimal(offset)) for m in gutenberg_richter(20000, float(width), least=3 * float(width))]
    shifted = [str(Decimal(m) - Decimal(offset)) for m in magnitudes]
    exact = Exact(shifted, width)
    quakes("q.csv", magnitudes)
    quakes("plain.csv", shifted)
    centre = f"{width} around {offset} \\+ n {width}, of which all are centres" if float(offset) else f"{width}, of which all are multiples"
    run(postproc, "magnitudes q.csv --no-picture -o m").printed("magnitudes in bins of " + centre)
    (b, n), (positive, n_positive), least = exact.b(min(map(Fraction, shifted)))
    first = float(least + Fraction(offset))
    given = f"--magnitude-bin {width}:{float(offset) + 7 * float(width)}"
    for bins in "", given, f"--complete-from {first - 0.01}", f"--complete-from {first} {given}":
        found = b_values(postproc, f"q.csv {bins}")
        assert (found["completeness"], found["n"], found["n_positive"]) == (first, n, n_positive)
        assert found["b"] == pytest.approx(b, rel=1e-12) and found["b_positive"] == pytest.approx(positive, rel=1e-12)
    # A power law has no scale: the exponent is that of the magnitudes without the offset, and all that has a unit is shifted.
    found = {}
    for name, shift in ("q.csv", float(offset)), ("plain.csv", 0.0):
        run(postproc, f"fit {name} --range M{first - float(offset) + shift}:M{9 + shift} --replicas 20 -o f --overwrite --json f.json")
        found[name] = json.loads(Path("f.json").read_text())["fits"][0]
    fit, plain, unit = found["q.csv"], found["plain.csv"], 10**(1.5 * float(offset))
    for key in "exponent", "standard_error", "n", "ks", "log_likelihood", "p":
        assert fit[key] == pytest.approx(plain[key], rel=1e-9), key
    assert fit["lo"] == pytest.approx(plain["lo"] * unit) and fit["hi"] == pytest.approx(plain["hi"] * unit)
    assert fit["degenerate"] == "only without bins of magnitudes (--magnitude-bin 0)", "a rival of sizes in bins"
    # The line is drawn through the bins.
    run(postproc, f"histograms q.csv --threshold M{first} --no-picture -o h --overwrite")
    rows = table("h.csv")
    assert [int(row["count"]) for row in rows][0] == sum(1 for m in shifted if Fraction(m) == least)
    assert float(rows[0]["bin_lo"]) == pytest.approx(10**(1.5 * (first - float(width) / 2)))


@pytest.mark.parametrize("given", ["0:0.05", "0.1:", "0.1:x", ":0.1", "nan", "inf", "0.1:0.05:1", "-0.1:0"])
def test_bins_that_are_none(postproc, work, given):
    quakes("q.csv", ["2.0", "2.1"] * 20)
    refused(postproc, f"magnitudes q.csv -o o --magnitude-bin={given}", f"--magnitude-bin '{given}', expected a width of 0 or more")


@pytest.mark.parametrize("width", [0.1, 0.2])
def test_sizes_in_bins_have_the_right_exponent(postproc, work, width):
    """1 + b / 1.5, by fit and explore; the law is not rejected."""
    magnitudes = gutenberg_richter(20000, width)
    quakes("q.csv", magnitudes)
    # The likelihood of a geometric series over the bins from M2 to M9 has its maximum where its mean is that of the data.
    k = np.array([round((float(m) - 2) / width) for m in magnitudes])
    bins = np.arange(round(7 / width) + 1)
    low, high = -5.0, 0.0
    for _ in range(200):
        z = 0.5 * (low + high)
        weights = np.exp(z * bins)
        low, high = (z, high) if (weights * bins).sum() / weights.sum() < k[k <= bins[-1]].mean() else (low, z)
    exponent = 1 - z / (width * 1.5 * math.log(10))
    assert exponent == pytest.approx(1 + 1 / 1.5, abs=0.02)
    run(postproc, "fit q.csv --range M2:M9 --threshold M2 --replicas 200 --no-picture -o f")
    found = table("f.fits.csv")
    assert {row["rival"] for row in found} == {"exponential", "log-normal", "power law with exponential cut-off"}
    assert float(found[0]["exponent"]) == pytest.approx(exponent, rel=1e-9)
    # Cramer and Rao: the variance of the number of the bin, in units of the logarithm of sizes.
    share = np.exp(z * bins) / np.exp(z * bins).sum()
    deviation = math.sqrt((share * bins**2).sum() - (share * bins).sum()**2) * width * 1.5 * math.log(10)
    assert float(found[0]["standard_error"]) == pytest.approx(1 / (deviation * math.sqrt(len(k))), rel=1e-6)
    assert float(found[0]["p"]) > 0.02
    run(postproc, "explore q.csv -o explore.html")
    data = json.loads(re.search(r'id="data">(.*?)</script>', Path("explore.html").read_text(), re.S).group(1))
    laws = [one["law"] for one in data["runs"][0]["kinds"][0]["thresholds"] if one["law"]["n"] > 5000]
    assert laws and all(abs(law["value"] - exponent) < 4 * law["error"] for law in laws)


# ---------------------------------------------------------------- empty and tied


def test_no_events(postproc, work):
    Path("empty.csv").write_text("time,latitude,longitude,mag\n")
    quakes("q.csv", ["2.0", "2.1"] * 20)
    assert re.search(r"complete from +0\n", run(postproc, "magnitudes q.csv -o m --no-picture --complete-from -0.04 --magnitude-bin 0.1").out)
    for command in "magnitudes", "fit", "histograms", "intervals":
        refused(postproc, f"{command} empty.csv -o o --no-picture", "empty.csv: no events, nothing to draw")
        refused(postproc, f"{command} q.csv -o o --no-picture --min-magnitude 5", r"q.csv: no events \(0 left out by time, 40 by size\)")


def test_ties(postproc, work):
    Path("ties.csv").write_text("time,latitude,longitude,mag\n" + "2020-01-01T00:00:00Z,0,0,3\n" * 3)
    for bins in "", "--magnitude-bin 0":
        refused(postproc, f"fit ties.csv -o o --no-picture {bins}", "all sizes are equal")
    refused(postproc, "intervals ties.csv -o o --no-picture", "all times are 0")


def test_times_of_0_are_counted(postproc, work):
    quakes("q.csv", ["3.0"] * 40)
    lines = Path("q.csv").read_text().splitlines(keepends=True)
    Path("q.csv").write_text("".join(lines + lines[-1:] * 2))
    run(postproc,
        "intervals q.csv -o o --no-picture --replicas 0 --shuffles 0").warned("^postproc: .*: 2 of 41 times are 0, left out of densities and fits$")


# ---------------------------------------------------------------- times that are computed and typed


def test_times_at_a_typed_limit(postproc, work):
    """0.57 x 100 is 56.99999999999999: an event that starts at a step and a limit typed as its time are the same time."""
    lines = [f"{k + 1},{0.57 * (100 + k)!r},{0.57 * (100 + k) + 0.1!r},{100 + k},{100 + k},0.5,1,0.5" for k in range(10)]
    Path("c.csv").write_text("# lsm-catalogue 1\n# model = lsm\n# dt = 0.57\nevent_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end\n" +
                             "\n".join(lines) + "\n")
    assert 0.57 * 100 < 57
    for k in range(10):
        typed = f"{57 + 0.57 * k:.2f}"
        found = json.loads(run(postproc, f"count c.csv --from {typed} --json -").out)["catalogues"][0]["events"]
        until = json.loads(run(postproc, f"count c.csv --to {typed} --json -").out)["catalogues"][0]["events"]
        assert (found, until) == (10 - k, k), typed


def test_the_format_that_is_given(postproc, work):
    """A line that may be of several formats is one of that which --format names."""
    Path("a.txt").write_text("-120 34 1994 1 17 4.5 10 12 30\n")
    found = json.loads(run(postproc, "count a.txt --format zmap --size M4.5 --json -").out)
    assert found["sizes"][0]["events"] == 1 and found["catalogues"][0]["first_start"] == pytest.approx(8782.5208333)
    refused(postproc, "count a.txt --format csv", "a.txt.*expected")
