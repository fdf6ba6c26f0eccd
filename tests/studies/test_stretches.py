# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/studies/stretches.py: parts of a fault, with synthetic energies."""
import csv
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from data_files import loading_with_drops, pick, read_catalogue, write_catalogue
from programs import INPUTS, Program, refused, run

sys.path.insert(0, str(INPUTS / "studies"))
import stretches  # noqa: E402

EVERY, DT, LENGTH, PIECES, SIZE = 8, 0.1, 40, 16, 10
MEMORY = 5.0


def write_run(folder, energy, velocity=0.0, steps=None, **head):
    """Writes a run with energies [sample, piece, block], as fault.in and fault_stretches.in do."""
    Path(folder).mkdir()
    given = dict(model="lsm", program="made up", length=LENGTH, dt=DT, velocity=velocity, seed=1, **{"lambda": math.exp(-DT / MEMORY)})
    write_catalogue(f"{folder}/fault.catalogue.csv", [1.0], [1e-3], {**given, **head})
    steps = 100 + EVERY * np.arange(len(energy)) if steps is None else steps
    lines = ["# Time-averaged data for fix pieces", "# TimeStep Number-of-rows", "# Row c_belowenergy c_aboveenergy"]
    for step, table in zip(steps, energy):
        lines += [f"{step} {len(table)}", *(f"{n} {below!r} {above!r}" for n, (below, above) in enumerate(table.tolist(), 1))]
    Path(folder, "fault.stretches.txt").write_text("\n".join(lines) + "\n")
    return Path(folder)


@pytest.fixture
def script(postproc):
    return Program("stretches.py", sys.executable, INPUTS / "studies/stretches.py", "--stretch", SIZE, "--from", 0, postproc.path, "out")


def in_stretches(series):
    """Energies of pieces: the first piece of each stretch, below the fault, has one of the series."""
    energy = np.zeros((len(series[0]), PIECES, 2))
    for n, one in enumerate(series):
        energy[:, n * PIECES // len(series), 0] = one
    return energy


def test_stretches_add_up():
    """Every piece is in one stretch, or in two with weights that add up to 1, wherever the blocks are."""
    energy = np.random.default_rng(1).uniform(0, 1, (60, PIECES, 2))
    info, every, pe = stretches.stretches_of(write_run("a", energy, velocity=0.3), SIZE)
    assert info["seed"] == "1" and every == EVERY and pe.shape == (4, 60)
    assert pe.sum(axis=0) == pytest.approx(energy.sum(axis=(1, 2)), rel=1e-12)


@pytest.mark.parametrize("block, ends_in", [(0, 0), (1, 2)])
def test_blocks_carry_their_energy(block, ends_in):
    """Blocks move from the middle of stretch 1 by its length: the lower one to the previous stretch, the upper one to the next."""
    energy = np.zeros((41, PIECES, 2))
    energy[:, 5:7, block] = 1, 2
    moved = EVERY * DT * np.arange(41)
    _, _, pe = stretches.stretches_of(write_run("a", energy, velocity=SIZE / moved[-1]), SIZE)
    assert pe[:, 0] == pytest.approx([0, 3, 0, 0]) and pe[:, -1] == pytest.approx(3 * (np.arange(4) == ends_in))
    # Half-way, the edge of the stretch is between the two pieces, one of which has just left.
    left = energy[0, 6 if block else 5, block]
    assert pe[ends_in, 20] == pytest.approx(left) and pe[1, 20] == pytest.approx(3 - left)
    # There are no jumps: a piece leaves while the blocks move by its length, a tenth of it at a time.
    assert np.abs(np.diff(pe, axis=1)).max() == pytest.approx(0.2)


def test_continued():
    """In a run that was killed within a sample and continued from two samples before it, each part has its own pieces."""
    energy = np.random.default_rng(1).uniform(0, 1, (10, PIECES, 2))
    whole, begun, rest = (write_run(name, part, steps=100 + EVERY * np.arange(first, first + len(part)), velocity=0.3) / "fault.stretches.txt"
                          for name, part, first in (("a", energy, 0), ("b", energy[:8], 0), ("c", energy[6:], 6)))
    begun.write_text(begun.read_text()[:-7] + rest.read_text())
    (first, kept), (second, appended) = stretches.parts_of(begun)
    assert list(first) == list(100 + EVERY * np.arange(6)) and list(second) == list(100 + EVERY * np.arange(6, 10))
    assert (kept == energy[:6]).all() and (appended == energy[6:]).all()
    short = begun.with_name("short.txt")  # killed within its first sample
    short.write_text("".join(begun.read_text().splitlines(keepends=True)[:4]) + rest.read_text())
    assert [list(steps) for steps, _ in stretches.parts_of(short)] == [list(100 + EVERY * np.arange(6, 10))]
    _, every, pe = stretches.stretches_of(begun.parent, SIZE)
    assert every == EVERY and pe.shape == (4, 10) and pe.sum(axis=0) == pytest.approx(energy.sum(axis=(1, 2)), rel=1e-12)
    assert (pe[:, 6:] == stretches.stretches_of(rest.parent, SIZE)[2]).all()
    assert (pe[:, :6] == stretches.stretches_of(whole.parent, SIZE)[2][:, :6]).all()


def test_what_is_left_out(script):
    """Stretches are loaded together at first, and vary independently from then on."""
    random = np.random.default_rng(3)
    own = random.normal(size=(4, 4000))
    together = np.where(np.arange(4000) < 400, np.linspace(0, 4000, 4000), 400.0)
    folder = write_run("a", in_stretches(own + together))
    begin = (100 + 400 * EVERY) * DT
    _, _, pe = stretches.stretches_of(folder, SIZE, begin)
    assert pe.shape == (4, 3600) and pe == pytest.approx(own[:, 400:] + 400)
    refused(script, f"--from 1e6 {folder}", "a/fault.stretches.txt: ends at time 3209.2, expected samples from 1e.06 on")


def changes(series):
    folder = write_run("a", in_stretches(series))
    info, every, pe = stretches.stretches_of(folder, SIZE)
    return list(stretches.variance(pe, every, float(info["dt"])))


def test_the_same_everywhere():
    """If stretches change together, the variance of the sum is four times the sum of the variances."""
    rows = changes([np.random.default_rng(2).normal(size=4000)] * 4)
    assert [row["lag"] for row in rows] == list(stretches.LAGS)
    assert all(float(row["ratio"]) == pytest.approx(4) and float(row["correlation_1"]) == float(row["correlation_2"]) == 1 for row in rows)


def test_nothing_to_do_with_each_other():
    """With the same noise at different times in all stretches, the ratio is 1 and the correlation 0, within three standard errors."""
    samples = 20000
    noise = np.random.default_rng(3).normal(size=samples)
    first = changes([np.roll(noise, shift) for shift in (0, 3000, 6000, 9000)])[0]
    # Successive changes of noise have a correlation of -1/2, so that the variance of a correlation is 1.5 / samples. Three pairs
    # of stretches have one shift, two another, one a third; pairs with the same shift have the same correlation.
    error = 2 / 4 * math.sqrt((3**2 + 2**2 + 1) * 1.5 / samples)
    assert abs(float(first["ratio"]) - 1) < 3 * error
    assert abs(float(first["correlation_1"])) < 3 * math.sqrt(1.5 / samples)


def test_lags_longer_than_the_run():
    """They are left out."""
    rows = changes(np.random.default_rng(4).normal(size=(4, 50)))
    assert [row["lag"] for row in rows] == [1, 3, 10, 30] and all(math.isfinite(float(row["ratio"])) for row in rows)


def test_events(script):
    """Events of the whole and of each stretch, with the memory of the run or the one given."""
    saw = 1e-2 * loading_with_drops(4000)
    series = [np.roll(np.diff(saw), 40 * n).cumsum() + 50 for n in range(4)]
    write_run("a", in_stretches(series))
    run(script, "a")
    rows = {row["what"]: row for row in csv.DictReader(open("out.events.csv"))}
    assert list(rows) == ["whole", "shifted", "each"] and [rows[what]["series"] for what in rows] == ["1", "5", "4"]
    assert {row["length"] for row in csv.DictReader(open("out.variance.csv"))} == {str(LENGTH)}

    def events(pe, memory):
        step = np.arange(len(pe))
        return sum(row[5] >= 1e-4 for row in pick("exponential", math.exp(-EVERY * DT / memory), 0, step, step * EVERY * DT, pe))

    assert float(rows["whole"]["events"]) == events(sum(series), MEMORY) > 10
    assert float(rows["each"]["events"]) == pytest.approx(np.mean([events(one, MEMORY) for one in series]), rel=1e-3)
    assert events(sum(series), 50) != events(sum(series), MEMORY)
    run(script, "--memory 50 a")
    assert float(next(csv.DictReader(open("out.events.csv")))["events"]) == events(sum(series), 50)


def test_a_killed_run():
    """Parts of a sample, and of a line, are left out."""
    energy = np.random.default_rng(5).uniform(0, 1, (12, PIECES, 2))
    path = write_run("a", energy) / "fault.stretches.txt"
    said = path.read_text()
    for end in len(said) - 4, said.rindex("\n", 0, -1) + 1, said.rindex(f"\n{100 + 11 * EVERY} ") + 4:
        path.write_text(said[:end])
        assert (stretches.parts_of(path)[0][1] == energy[:11]).all()


def test_refusals(script):
    energy = np.ones((5, PIECES, 2))
    write_run("uneven", energy, steps=[0, 8, 16, 25, 32])
    write_run("one", energy[:1])
    write_run("empty", energy[:0])
    Path(write_run("text", energy), "fault.stretches.txt").write_text("one\ntwo\nthree\n")
    Path(write_run("columns", energy), "fault.stretches.txt").write_text("0 1\n1 0.5\n8 1\n1 0.5\n")
    Path(write_run("none", energy), "fault.stretches.txt").unlink()
    for folder, said in (("uneven", "expected energies of two blocks at steps with one distance"), ("one", "expected energies of two blocks"),
                         ("empty", "not what fault_stretches.in writes"), ("text", "not what fault_stretches.in writes"),
                         ("columns", "expected energies of two blocks")):
        refused(script, folder, f"{folder}/fault.stretches.txt: {said}")
    refused(script, "none", "No such file or directory: 'none/fault.stretches.txt'")
    write_run("lost", energy)
    Path("lost/fault.catalogue.csv").unlink()
    refused(script, "lost", "No such file or directory: 'lost/fault.catalogue.csv'")
    catalogue = Path(write_run("bare", energy), "fault.catalogue.csv")
    catalogue.write_text(catalogue.read_text().replace("# velocity = 0.0\n", ""))
    refused(script, "bare", "bare/fault.catalogue.csv: the header has no velocity, expected a catalogue of fault.in")
