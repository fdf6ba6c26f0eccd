# SPDX-License-Identifier: GPL-2.0-or-later
"""lsm.sources: ruptures whose moment rates, energies and spectra are known in closed form, and those of the files of 1.0."""
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
from data_files import edit, read_catalogue, write_catalogue, write_history
from programs import SOURCE, Program, refused, run

sys.path.insert(0, str(SOURCE / "python"))
import lsm.ruptures  # noqa: E402
import lsm.sources  # noqa: E402

DATA = SOURCE / "tests/data/1.0"
SCRIPT = Program("lsm.sources", sys.executable, "-m", "lsm.sources", env={"PYTHONPATH": str(SOURCE / "python"), "LC_ALL": "C.UTF-8"})
HEAD = dict(model="lsm", events="ruptures", length=100, slip_bin=1)
LAW = dict(law="slip-weakening")
UNTIL, COUNT, MODULUS = 20.0, 400, 0.4


def write_run(slip, stress, work=0.0, plane=False, law=LAW, **columns):
    """A rupture, a.ruptures.csv and a.slip.bin. slip: more of it in each interval; stress: at the beginning of the first, and in each"""
    shape, count = np.shape(slip), len(slip)
    first, *_, last = np.flatnonzero(np.reshape(slip, (count, -1)).any(axis=1))
    none = np.zeros((1, *shape[1:]))
    write_history("a.slip.bin", 2 * np.arange(count + 1), np.concatenate([none, slip]), stress=stress,
                  work=np.concatenate([none[..., 0] if plane else none, np.broadcast_to(work, shape[:-1] if plane else shape)]), interval=2,
                  dt=0.5 * UNTIL / COUNT, time0=50, slip_velocity=1e-9, modulus=MODULUS, **columns.pop("head", {}))  # yapf: disable
    known = dict(slip_moment=[1], rupture_length=[shape[1]], x_hypocentre=[0.5 * shape[1] + 0.5 * (shape[1] % 2 == 0)], x_begin=[0], stress_drop=[1])
    write_catalogue("a.ruptures.csv", [50 + first * UNTIL / COUNT], [1], {**HEAD, **(dict(slip_bin_dip=1) if plane else {}), **law}, t_end=[50 + UNTIL], step_start=[2 * first],
                    step_end=[2 * last + 2], **{**known, **columns})  # yapf: disable


def sources(*more):
    """The columns that the program adds."""
    run(SCRIPT, "a.ruptures.csv --no-picture", *more)
    return {name: values[0] for name, values in read_catalogue("a.sources.csv")[1].items() if name in lsm.sources.COLUMNS}


def crack(plane, fine=10):
    """Slip of a self-similar crack of speed 2, and 1 along dip, up to UNTIL, in each interval and one more in which nothing moves: means over
    the bins."""
    times = np.append(np.linspace(0, UNTIL, COUNT + 1), UNTIL)
    x, z = ((np.arange(bins * fine) + 0.5) / fine - 0.5 * bins for bins in (90, 50))
    reached = np.hypot(x[:, None] / 2, z) if plane else np.abs(x) / 2
    mean = [0.5 * np.sqrt(np.maximum(0, t**2 - reached**2)) for t in times]
    for axis in range(reached.ndim):
        mean = [one.reshape(*one.shape[:axis], -1, fine, *one.shape[axis + 1:]).mean(axis=axis + 1) for one in mean]
    return np.diff(mean, axis=0)


def test_self_similar_crack(work):
    """Kostrov 1964, mode II: slip 0.5 sqrt(t^2 - (x/2)^2), and stress falls from 0.03 to 0.01 at the tip. The moment grows as t^2, and half
    of stress drop times slip goes to tips and waves."""
    slip = crack(False)
    touched = np.cumsum(slip, axis=0) > 0
    stress = np.concatenate([np.full((1, 90), 0.03), np.where(touched, 0.01, 0.03)])
    write_run(slip, stress, 0.01 * slip)
    found = sources()
    potency = 0.5 * 2 * 0.5 * np.pi * UNTIL**2
    wanted = dict(source_duration=UNTIL * (np.sqrt(0.95) - np.sqrt(0.05)), peak_moment_rate=2 * MODULUS * potency / UNTIL,
                  centroid_time=50 + 2 / 3 * UNTIL, stress_work=0.02 * potency, friction_work=0.01 * potency, contact_energy=0,
                  radiated_energy=0.01 * potency, apparent_stress=0.01, fracture_energy=0, weighted_stress_drop=0.02)  # yapf: disable
    for name, value in wanted.items():
        assert found[name] == pytest.approx(value, rel=0.01, abs=1e-4 * potency * 0.01), name
    event_id, time, rate = np.loadtxt("a-moment-rates.csv", delimiter=",", skiprows=1 + sum(l[0] == "#" for l in open("a-moment-rates.csv"))).T
    assert set(event_id) == {1} and len(time) == COUNT and time[0] == pytest.approx(50 + 0.5 * UNTIL / COUNT)
    assert rate[40:] == pytest.approx(2 * MODULUS * potency * (time[40:] - 50) / UNTIL**2, rel=0.02)
    assert rate.sum() * UNTIL / COUNT == pytest.approx(MODULUS * potency, rel=5e-3)


def test_self_similar_crack_of_a_plane(work):
    """An ellipse, whose moment grows as t^3, along 0.8 of the strike and 0.6 down dip."""
    along = np.array([0.8, -0.6])
    slip = crack(True, 4)[..., None] * along
    stress = np.concatenate([np.full((1, 90, 50), 0.03), np.where(np.cumsum(slip[..., 0], axis=0) > 0, 0.01, 0.03)])[..., None] * along
    write_run(slip, stress, 0.01 * np.abs(slip[..., 0]) / 0.8, True, rupture_width=[50], z_hypocentre=[25.5], z_begin=[0])
    found = sources()
    potency = 0.5 * 2 / 3 * np.pi * 2 * UNTIL**3
    wanted = dict(source_duration=UNTIL * (0.95**(1 / 3) - 0.05**(1 / 3)), peak_moment_rate=3 * MODULUS * potency / UNTIL,
                  centroid_time=50 + 0.75 * UNTIL, stress_work=0.02 * potency, friction_work=0.01 * potency, radiated_energy=0.01 * potency,
                  apparent_stress=0.01, weighted_stress_drop=0.02)  # yapf: disable
    for name, value in wanted.items():
        assert found[name] == pytest.approx(value, rel=0.01), name


def test_fracture_energy_and_elastic_contacts(work):
    """Each of four places of stress 0.05 slips by 2: contacts of stiffness 0.5 are loaded to 0.08, strength falls to 0.02 over 0.4, and the
    faces move less than the contacts slip, as these go back."""
    slid = np.linspace(0, 2, COUNT + 1)
    strength = np.maximum(0.02, 0.08 - 0.06 * slid / 0.4)
    stress = np.append(np.interp(np.linspace(0, 1, 41), [0, 1], [0.05, 0.08]), strength[1:COUNT - 39])
    slip = np.append(np.zeros(41), slid[1:COUNT - 39])
    face = slip + (stress - 0.05) / 0.5
    middle, rest = 0.5 * (stress[1:] + stress[:-1]), np.full((1, 1), stress[-1])
    work_done = np.append(middle * np.diff(slip), 0.0)
    columns = np.ones((1, 4))
    write_run(np.append(np.diff(face), 0.0)[:, None] * columns, np.concatenate([np.full((1, 1), 0.05), middle[:, None], rest]) * columns,
              work_done[:, None] * columns, x_hypocentre=[0.5])  # yapf: disable
    found = sources()
    assert found["fracture_energy"] == pytest.approx(4 * 0.5 * 0.06 * 0.4, rel=0.01)
    assert found["contact_energy"] == pytest.approx(4 * (0.02**2 - 0.05**2) / (2 * 0.5), rel=0.02)
    assert found["friction_work"] == pytest.approx(4 * work_done.sum(), rel=1e-6)
    moved = face[-1]
    assert found["radiated_energy"] == pytest.approx(4 * (0.5 * 0.07 * moved) - found["friction_work"] - found["contact_energy"], rel=1e-6)
    write_run(np.append(np.diff(face), 0.0)[:, None] * columns, 0.05, law=dict(law="coulomb 0.6 0.6"), x_hypocentre=[0.5])
    assert "fracture_energy" not in sources("--overwrite")


def test_corner_of_brunes_pulse():
    for corner in 0.05, 0.2, 1.0:
        omega, t = 2 * np.pi * corner, np.linspace(0, 3 / corner, 601)
        done = 1 - (1 + omega * t) * np.exp(-omega * t)  # the integral of omega^2 t exp(-omega t)
        assert lsm.sources.corner_frequency(np.diff(done), t[1]) == pytest.approx(corner, rel=0.03)
    assert lsm.sources.corner_frequency(np.ones(2), 0.1) == lsm.sources.corner_frequency(-np.ones(50), 0.1) == 0
    assert lsm.sources.corner_frequency(np.array([0, 1, 0, 0, 0.0]), 0.1) == 0, "it is above the frequencies that are there"


@pytest.mark.parametrize("gap, ring", [(0, True), (1, True), (1, False), (2, False)])
def test_slip_belongs_together_as_in_the_definition(work, gap, ring):
    """By the pairs of all slips, in a fault of nine bins and of three rows."""
    rng = np.random.default_rng(3)
    for rows in 0, 3:
        slip = np.where(rng.random((150, 9, *[rows] * bool(rows))) < 0.04, 1.0, 0.0)
        all_slip = np.concatenate([0 * slip[:1], slip])
        ends = dict.fromkeys(["ends", "ends_dip"], "ring" if ring else "open")
        write_history("b.slip.bin", np.arange(151), all_slip[..., None] * [1, 0] if rows else all_slip, slip_velocity=0.5, gap=gap,
                      memory_intervals=2, **ends)
        record, cell, rupture = lsm.sources.replayed(lsm.ruptures.History("b.slip.bin"))
        assert len(record) == slip.sum() > 40 and len(set(rupture)) > 1
        x, z = np.divmod(cell, rows or 1)

        def apart(at, bins):
            distance = np.abs(at[:, None] - at)
            return np.minimum(distance, bins - distance) if ring else distance

        close = (apart(x, 9) <= gap + 1) & (np.abs(record[:, None] - record) <= 2)
        if rows:
            close &= apart(z, rows) <= gap + 1
        for _ in range(8):
            close = close.astype(np.float32) @ close > 0
        assert ((rupture[:, None] == rupture) == close).all()


def test_ruptures_of_1_0(work):
    """Those that the program found and recorded: each is found again, with its moment and its stress drop."""
    one, history = lsm.ruptures.load(DATA / "fault.ruptures.csv"), lsm.ruptures.History(DATA / "fault.slip.bin")
    found = list(lsm.sources.of_run(history, one))
    assert len(found) == len(one.events) > 10
    assert [source.moment for source in found] == pytest.approx(one.events["slip_moment"], rel=1e-9, abs=1e-12)
    for event, source in zip(one.events, found):
        assert len(source.rate) * history.span == pytest.approx(event["t_end"] - event["t_start"])
        if event["rupture_length"] == history.bin:  # of more than one bin it is a mean over the row
            assert source.numbers["weighted_stress_drop"] == pytest.approx(event["stress_drop"] * np.sign(event["slip_moment"]), abs=1e-8)


def test_postproc_reads_the_columns(postproc):
    for name in "ruptures.csv", "slip.bin":
        shutil.copy(DATA / f"fault.{name}", f"b.{name}")
    run(SCRIPT, "b.ruptures.csv --no-picture")
    before, after = (Path(f"b.{name}.csv").read_text().splitlines() for name in ("ruptures", "sources"))
    assert len(before) == len(after) and all(new.startswith(old) for old, new in zip(before, after))
    energy = read_catalogue("b.sources.csv")[1]["radiated_energy"]
    for name in lsm.sources.COLUMNS:
        if name != "fracture_energy":
            run(postproc, ["select", "b.sources.csv", "--where", f"{name} > -1e9", "-o", "all.csv", "--overwrite"])
    run(postproc, ["select", "b.sources.csv", "--where", "radiated_energy > 0", "-o", "some.csv"])
    shutil.copy(DATA / "fault.catalogue.csv", "b.catalogue.csv")
    run(postproc, "explore b.catalogue.csv --ruptures b.sources.csv -o page.html")
    assert "radiated_energy" in Path("page.html").read_text().split('id="data"')[1]
    assert 0 < len(read_catalogue("some.csv")[1]["size"]) == (energy > 0).sum() < len(energy)


def test_what_is_no_source_is_refused(work):
    slip = crack(False)[:, 40:50]
    write_run(slip, 0.01)
    refused(SCRIPT, "a.ruptures.csv --history nowhere.slip.bin", "nowhere.slip.bin: No such file")
    refused(SCRIPT, "a.ruptures.csv --history a.ruptures.csv", "a.ruptures.csv: no slip history")
    refused(SCRIPT, "a.slip.bin", "a.slip.bin: no catalogue")
    edit("a.ruptures.csv", "b.csv", ("# length = 100", "# length = 100\n# seed = 4"))
    write_history("b.slip.bin", [0, 1], np.zeros((2, 10)), seed=5)
    refused(SCRIPT, "b.csv", "b.slip.bin: seed = 5, but 4 in b.csv: expected files of the same run")
    write_history("c.slip.bin", 2 * np.arange(COUNT + 2), np.zeros((COUNT + 2, 10)), interval=2)
    refused(SCRIPT, "a.ruptures.csv --history c.slip.bin", "c.slip.bin: does not have all of rupture 1, expected its slip from step 0 to 800")
    Path("none.ruptures.csv").write_text("".join(Path("a.ruptures.csv").read_text().splitlines(True)[:-1]))
    refused(SCRIPT, "none.ruptures.csv --history a.slip.bin", "none.ruptures.csv: no ruptures, expected at least one")
    sources()
    refused(SCRIPT, "a.ruptures.csv", "a.sources.csv exists, expected --overwrite or another -o")
    refused(SCRIPT, "a.sources.csv --history a.slip.bin -o b", "a.sources.csv: has column source_duration, expected the catalogue that the run wrote")
