# SPDX-License-Identifier: GPL-2.0-or-later
"""The commands of postproc that draw."""
import os
import re
from pathlib import Path

import numpy as np
import pytest
from data_files import power_law, rows, table, write_catalogue, write_history, write_series
from figure_data import fault, pictures, ruptures, said, slider
from programs import refused, run

pytestmark = pytest.mark.usefixtures("gnuplot")


@pytest.fixture
def do(postproc):
    return lambda *arguments, **more: run(postproc, *arguments, **more)


@pytest.fixture
def no(postproc):
    """no(pattern, arguments): expects that postproc refuses the arguments."""
    return lambda pattern, arguments: refused(postproc, arguments, pattern)


def curve(path, number=1):
    """Rows of one curve, as dicts of numbers by column, counted from 1."""
    return [dict(enumerate(map(float_or_text, row.split(",")), 1)) for row in rows(path) if row.startswith(f"{number},")]


def float_or_text(cell):
    try:
        return float(cell)
    except ValueError:
        return cell


def count(path, number):
    return sum(row[7] for row in curve(path, number))


# ---- densities
def test_histograms(do):
    # 90 events are in the bin from 1e-3 to 10^-2.9, 10 in that from 1e-2 to 10^-1.9, and 7 are too small.
    fault("a.csv", [1.1e-3] * 90 + [1.1e-2] * 10 + [5e-5] * 7)
    slider("b.csv", power_law(1, 1e-3, 1, 1000))
    do("histograms a.csv b.csv --guide -1.07 --guide -1:1e-2:1e-1 -o h")
    pictures("h")
    found = curve("h.csv", 1)
    filled = [row for row in found if row[7] > 0]
    assert len(found) == 11 and len(filled) == 2
    for row, edge, events in zip(filled, (1e-3, 1e-2), (90, 10)):
        width = row[5] - row[4]
        assert row[7] == events and row[4] == pytest.approx(edge, rel=1e-9)
        assert row[8] == pytest.approx(row[7] / (100 * width), rel=1e-9) and row[9] == pytest.approx(row[7]**0.5 / (100 * width), rel=1e-9)
        assert row[5] / row[4] == pytest.approx(10**0.1, rel=1e-9)
    # Ten bins per decade over three decades, density 1 / (ln 1000 s), integral 1.
    found = curve("h.csv", 2)
    assert len(found) == 30 and sum(row[8] * (row[5] - row[4]) for row in found) == pytest.approx(1, abs=1e-9)
    for row in found:
        assert row[8] * row[6] * np.log(1000) == pytest.approx(1, abs=0.05)
    said("h.svg", r"fault, length 120 \(100 events\)", r"block-slider, N = 256 \(1000 events\)")
    do("histograms a.csv --threshold 0 -o c --no-picture")
    assert not Path("c.png").exists(), "--no-picture drew a picture"
    assert count("c.csv", 1) == 107


def test_intervals(do):
    # There are 100 times of 5, then 50 of 50.
    times = np.concatenate([[0], np.cumsum([5] * 100 + [50] * 50)])
    fault("a.csv", np.where(np.arange(151) % 2, 1, 2), times=times)
    first = do("intervals a.csv -o i")
    pictures("i")
    filled = [row for row in curve("i.csv") if row[7] > 0]
    assert len(filled) == 2
    for row, time, events in zip(filled, (5, 50), (100, 50)):
        assert row[7] == events and row[4] <= time < row[5]
        assert row[8] == pytest.approx(row[7] / (150 * (row[5] - row[4])), rel=1e-9)
    first.printed(" 150 20 model time 1.061$")
    # Every second event is large, with times of 10 and 100.
    do("intervals a.csv --threshold 0 --threshold 1.5 --rescale -o r --no-picture")
    assert any(row[7] == 50 and row[4] <= 10 / 40 < row[5] for row in curve("r.csv", 2))
    # p-values depend on the seed and the given number of replicas.
    few = do("intervals a.csv --delta 1 --method likelihood --replicas 20 --seed 3 -o p --no-picture")
    few.printed(r" 0.048 \+- 0.04[0-9] yes")
    few.printed("rejected: p below 0.05")
    none = do("intervals a.csv --delta 1 --method likelihood --replicas 0 --shuffles 0 -o p --no-picture")
    assert not [line for line in none.out.splitlines() if "γ" in line and "rejected" in line], "a p-value without replicas"


def exponents(path):
    return [[float_or_text(cell) for cell in row.split(",")] for row in rows(path) if row.startswith("lsm")]


def test_fit(do, no):
    fault("a.csv", power_law(1, 1e-3, 1, 2000))
    command = "fit a.csv --range 1e-3:1 --range 1e-3:0.1 --replicas 20 --json f.json -o f"
    first = do(command)
    pictures("f")
    found = exponents("f.fits.csv")
    assert len(found) == 6
    for row in found:
        assert 0.99 <= row[4] <= 1.01 and 0.005 < row[5] < 0.05
    said("f.json", '"exponent": (1.00|0.99)', '"rival": "log-normal"')
    said("f.fits.csv", "one line per rival")
    assert do(command).out == first.out, "the same seed gives another answer"
    # The range is that of the paper unless another is given.
    do("fit a.csv --replicas 0 --no-comparison -o s --no-picture --json s.json")
    assert [row[:3] for row in exponents("s.fits.csv")] == [["lsm", 1e-4, 0.1]]
    said("s.json", '"name": "exponent_0.0001:0.1"')
    assert "one line per rival" not in Path("s.fits.csv").read_text(), "rivals are explained, but there are none"
    # The bin that contains the smallest size is incomplete and does not count.
    assert max(float(row["size"]) for row in table("a.csv")) >= 0.8
    no("no bin of sizes from 0.8 on has an event", "fit a.csv --threshold 0.8 --replicas 0 --no-picture -o x")
    # Events left out below a size do not make the law flatter, as the fit begins there.
    do("fit a.csv --min-size 0.01 --range 1e-3:1 --range 1e-3:0.01 --replicas 0 --no-comparison -o m --no-picture")
    whole = [row for row in exponents("m.fits.csv") if row[1] == 0.01 and row[3] > 1300]
    assert whole and 0.98 < whole[0][4] < 1.02
    said("m.fits.csv", "^lsm,0.01,1,", "only has events from 0.01")
    large = [row for row in table("a.csv") if float(row["size"]) >= 0.01]
    write_catalogue("picked.csv", [row["t_start"] for row in large], [row["size"] for row in large], dict(model="lsm", min_size=0.01, length=120),
                    event_id=[row["event_id"] for row in large])
    do("fit picked.csv --range 1e-3:1 --replicas 0 --no-comparison -o m --no-picture")
    said("m.fits.csv", "^lsm,0.01,1,")


def test_seismology(do):
    fault("a.csv", power_law(1.7, 1e-3, 1e3, 2000))
    fault("b.csv", power_law(1.2, 1e-3, 1e3, 2000), 240)
    do("magnitudes a.csv b.csv --threshold 1e-3 --label 'a_{x}' --label b -o m")
    pictures("m")
    said("m.gp", "b = 1.")
    said("m.svg", re.escape("a_{x} (2000 events)"))


def test_tables_of_many_catalogues_fit_a_terminal(do):
    for k in range(6):
        fault(f"{k}.csv", 10**np.random.default_rng(k).uniform(-4, 0, 300), length=120 * (k + 1))
    paths = " ".join(f"{k}.csv" for k in range(6))
    for command in "intervals --shuffles 20 --replicas 20", "fit --replicas 20", "magnitudes", "count", "compare --replicas 20":
        shown = do(*command.split(), paths,
                   *([f"--no-picture -o {command.split()[0]}"] if command.split()[0] not in ("count", "compare") else [])).out
        assert max(map(len, shown.splitlines())) <= 160, shown
        for k in range(6):
            assert shown.count(f"fault, length {120 * (k + 1)}") >= 1


def test_few(do, no):
    """With no event, one, or a few, numbers that cannot be determined are reported as degenerate."""
    fault("none.csv", [])
    fault("one.csv", [0.01], times=[5])
    fault("few.csv", 0.01 * np.arange(1, 7), 240, times=np.arange(6)**2)
    no("nothing to draw", "histograms none.csv -o x")
    no("nothing to draw", "intervals none.csv -o x")
    no("nothing to draw", "intervals one.csv -o x")
    do("histograms one.csv -o h1")
    pictures("h1")
    do("histograms few.csv none.csv -o h").warned("no curve")
    do("intervals few.csv one.csv -o i")
    pictures("i")
    degenerate = table("i.fits.csv")
    assert len(degenerate) == 8
    for row in degenerate:
        assert row["gamma"] == row["delta"] == row["B"] == row["C"] == "" != row["degenerate"], "numbers of degenerate fits"
    said("i.clustering.csv", '^"fault, length 120",0.0001,0,,,')
    do("fit few.csv --range 1e-3:1 -o f").printed("degenerate")


# ---- whatever a name or a label holds, nothing is run and all is drawn
DRAW = {
    "histograms": "histograms a.csv b.csv", "intervals": "intervals a.csv b.csv --replicas 0", "fit": "fit a.csv b.csv --replicas 0 --range 1e-2:1",
    "magnitudes": "magnitudes a.csv b.csv --threshold 1e-3", "series": "series pe.bin"
}


@pytest.fixture
def drawable():
    fault("a.csv", power_law(1.2, 1e-3, 10, 300))
    fault("b.csv", power_law(1.2, 1e-3, 10, 300), 240)
    pe = np.cumsum(np.concatenate([[0], np.where(np.arange(2000) % 99 < 90, 1, -10)]))
    write_series("pe.bin", pe, {"dt": 1, "length": 40, "picker": "literal", "lambda": 0})


NAMES = ["-x", "--version", "-e '1'", "+", "-", "a'b", 'a"b', "`touch marker`", "$(touch marker)", "#a", "~", "a\\", "{", "ä b"]


@pytest.mark.parametrize("command", DRAW)
def test_names(do, drawable, command):
    for output in ["<touch marker;cat y", "|touch marker"] + NAMES * (command == "histograms"):
        before = set(os.listdir())
        do(DRAW[command], [f"--output={output}"])
        assert not Path("marker").exists(), f"{command} -o '{output}' ran a command"
        pictures(output)
        if command == "series":
            assert os.path.getsize(f"{output}-events.csv") > 0
        new = set(os.listdir()) - before
        assert new, f"{command} -o '{output}' wrote nothing here"
        for name in new:
            os.remove(name)


# Labels that break careless quoting in strings, markup and tables.
LABELS = ["run ''", "''", "'\"q\"", "' '#1' '}{'", "`touch marker`", "a\\", "@a &b ~c ^{d}_e'", "%d $1 \\n"]


def shows(page, label):
    assert not Path("marker").exists(), f"label {label} ran a command"
    text = Path(page).read_text()
    for name, sign in ("&lt;", "<"), ("&gt;", ">"), ("&quot;", '"'), ("&#39;", "'"), ("&amp;", "&"):
        text = text.replace(name, sign)
    assert label in text, f"label {label} is not in {page}"


@pytest.mark.parametrize("command", ["histograms", "intervals", "fit", "magnitudes"])
def test_labels(do, drawable, command):
    for label in ["'old' run"] + LABELS * (command == "histograms"):
        do(DRAW[command], ["--overwrite", "--output=l", "--label", label, "--label", "other"])
        shows("l.svg", label)


def test_explore_of_a_plane(no):
    ruptures("a.csv")
    write_history("p.slip.bin", [0, 1], np.zeros((2, 3, 2, 2)), bin=0.5, bin_dip=0.5)
    no("p.slip.bin: slip history of a plane, expected that of a line", "explore a.csv --history p.slip.bin -o x.html")
