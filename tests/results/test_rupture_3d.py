# SPDX-License-Identifier: GPL-2.0-or-later
"""rupture_3d.py: slip of a plane at places by hand, orders of convergence, what is refused, and the published orders."""
import csv
import json
import math
import sys

import numpy as np
import pytest
from data_files import write_history
from programs import SOURCE, Program, refused, run

RESULTS = SOURCE / "results"
sys.path.insert(0, str(RESULTS))
import rupture_3d  # noqa: E402

SCRIPT = Program("rupture_3d.py", sys.executable, RESULTS / "rupture_3d.py")
HEAD = dict(x0=-4, z0=-4, bin=2, bin_dip=2, dt=0.1, scale=0.01)


def stations(path="out-stations.csv"):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def front(path):
    """A rupture from the middle of a plane of 4 by 2 bins of 2: slip rate is 3 for 2, from the time |x| on, or 1 later in the lower row."""
    steps = np.arange(0, 101)
    slip = np.zeros((len(steps), 4, 2, 2))
    for n, x in enumerate((-3, -1, 1, 3)):
        for m, z in enumerate((-3, -1)):
            since = 0.1 * steps - (abs(x) + (0 if z == -1 else 1))
            slip[(since > 1e-9) & (since < 2 + 1e-9), n, m] = 0.01 * 0.1 * np.array([3.0, 0.5])
    write_history(path, steps, slip, **HEAD)


def reference(path, factor=1.0, late=0.0):
    """The same at three places, one of them between bins."""
    lines = ["x,z,t,slip,slip_rate,slip_dip"]
    for x, z, starts in ((1, -1, (1,)), (3, -3, (4,)), (2, -1, (1, 3))):
        for t in np.arange(0, 10, 0.05):
            slid = np.mean([np.clip(t - one - late, 0, 2) for one in starts])
            rate = np.mean([3.0 * (0 < t - one - late <= 2) for one in starts])
            lines.append(f"{x},{z},{t:.17g},{factor * 3 * slid:.17g},{factor * rate:.17g},{0.5 * slid:.17g}")
    path.write_text("\n".join(lines) + "\n")


def test_the_same_rupture(work):
    front("a.slip.bin")
    reference(work / "same.csv")
    out = run(SCRIPT, "a.slip.bin --reference same.csv -o out --no-picture").out
    assert "a, spacing 2: arrival" in out
    table = stations()
    assert [float(row["end_slip"]) for row in table] == pytest.approx([6, 6, 6], rel=1e-6)
    assert [float(row["end_dip"]) for row in table] == pytest.approx([1, 1, 1], rel=1e-6)
    assert [float(row["arrival"]) for row in table] == pytest.approx([float(row["reference_arrival"]) for row in table], abs=1e-5)
    plane = rupture_3d.Plane("a.slip.bin")
    assert plane.arrivals() == pytest.approx(np.array([[4, 3], [2, 1], [2, 1], [4, 3]]), abs=0.06)
    assert plane.at(2, -2)[0][1][-1] == pytest.approx(6) and plane.at(2, -2)[0][1][25] == pytest.approx(3 * 1.5 / 4 + 3 * 0.5 / 4, abs=0.1)


def test_misfits_by_hand(work):
    front("a.slip.bin")
    reference(work / "more.csv", factor=1.25, late=0.5)
    run(SCRIPT, "a.slip.bin --reference more.csv -o out --no-picture")
    for row in stations():
        assert float(row["arrival"]) - float(row["reference_arrival"]) == pytest.approx(-0.5, abs=0.08)
        assert float(row["end_slip"]) / float(row["reference_end_slip"]) == pytest.approx(0.8, rel=1e-4)


def test_low_pass():
    """Half of the power is left at its frequency, hardly any of waves of a lattice, and all of what changes slowly; there is no delay."""
    times = np.arange(0, 20, 0.01)
    inner = slice(200, -200)
    for frequency, gain in ((1.0, math.sqrt(0.5)), (0.1, 0.5**0.005), (4.0, 0.5**8)):
        wave = np.sin(2 * math.pi * frequency * times)
        assert rupture_3d.low_pass(wave, 0.01)[inner] == pytest.approx(gain * wave[inner], abs=2e-3)


def test_parts_of_the_misfit_of_slip_rates():
    """An oscillation, and a delay, each by itself: the low pass takes away only the first."""
    times = np.arange(0, 12, 0.02)
    rate = np.where(times > 3, 4 * np.exp(-(times - 3.5)**2 / 2), 0.0)
    one = np.array([times, 0 * times, rate])
    ringing = np.array([times, 0 * times, rate + 3 * np.exp(-(times - 6)**2 / 2) * np.sin(2 * math.pi * 5 * times)])
    late = np.array([times + 0.3, 0 * times, rate])
    found = rupture_3d.rate_misfit(ringing, one, 12.0)
    assert rupture_3d.misfit(ringing, one, 12.0)["rate_l2"] > 0.5 and found < 0.02
    assert rupture_3d.rate_misfit(late, one, 12.0) > 0.25


def test_orders_of_convergence():
    """Arrivals of second order, slip of first, in a series of three runs; a run of another kind between them does not count."""
    rows = []
    for name, spacing, factor in (("400 m", 400.0, 1.0), ("200 m", 200.0, 1.0), ("200 m kt 1.5", 200.0, 7.0), ("100 m", 100.0, 1.0)):
        off = factor * spacing / 400
        rows += [
            dict(run=name, spacing=spacing, reference="r", arrival=2 + sign * off**2, reference_arrival=2.0, end_slip=3 + off, reference_end_slip=3.0,
                 slip_l2=off, peak_rate=1.0, reference_peak_rate=1.0, rate_l2=off**3, rate_low_l2=off) for sign in (1, -1)
        ]
    table = {row["run"]: row for row in rupture_3d.convergence_of(rows)}
    for name in ("200 m", "100 m"):
        assert [table[name][f"order_{key}"] for key in ("arrival", "slip", "rate_l2")] == pytest.approx([2, 1, 3])
    assert all(math.isnan(table[name]["order_arrival"]) for name in ("400 m", "200 m kt 1.5"))
    assert table["100 m"]["mean"] == pytest.approx(0) and table["100 m"]["scatter"] == pytest.approx(1 / 16)


def test_numbers_for_a_study(work):
    front("rupture.slip.bin")
    reference(work / "same.csv")
    run(SCRIPT, "rupture.slip.bin --reference same.csv --json out.json")
    found = json.loads((work / "out.json").read_text())
    assert len(found["stations"]) == 3 and found["convergence"][0]["run"] == work.name.replace("_", " ")
    assert not list(work.glob("*.csv")) == [] and not (work / "out.csv").exists()


def test_what_is_wrong_is_named(work):
    front("a.slip.bin")
    write_history("line.slip.bin", [0, 1], np.zeros((2, 4)))
    reference(work / "same.csv")
    refused(SCRIPT, "line.slip.bin --reference same.csv -o out", "line.slip.bin: the slip history of a line, expected that of a plane")
    for text, said in (("x,z,t\n", "expected the columns"), ("x,z,t,slip,slip_rate,slip_dip\n1,1,0,0,0\n",
                                                             "b.csv:2: '1,1,0,0,0', expected six numbers"),
                       ("x,z,t,slip,slip_rate,slip_dip\n99,-1,0,0,0,0\n99,-1,1,1,1,0\n", "no slip at 99, -1, expected a place of the plane")):
        (work / "b.csv").write_text(text)
        refused(SCRIPT, "a.slip.bin --reference b.csv -o out --no-picture", said)


def test_published_orders(work):
    """The published stations give the published misfits and orders, from which the tables of validation.md are made."""
    for name in ("rupture_3d-stations.csv", "rupture_3d.csv"):
        (work / name).write_bytes((RESULTS / name).read_bytes())
    run(SCRIPT, "-o rupture_3d --no-picture")
    assert (work / "rupture_3d-convergence.csv").read_bytes() == (RESULTS / "rupture_3d-convergence.csv").read_bytes()
