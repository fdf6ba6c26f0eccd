# SPDX-License-Identifier: GPL-2.0-or-later
"""rupture_3d.py: slip of a plane at places by hand, what is refused, and the numbers of the page."""
import csv
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
    assert "spacing 2, against boundary integral" in out
    table = stations()
    assert [float(row["end_slip"]) for row in table] == pytest.approx([6, 6, 6], rel=1e-6)
    assert [float(row["end_dip"]) for row in table] == pytest.approx([1, 1, 1], rel=1e-6)
    assert all(abs(float(row["arrival"]) - float(row["reference_arrival"])) < 0.06 for row in table)
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


def test_the_table_of_the_page():
    """The published stations give the numbers of rupture-3d.md."""
    table = stations(RESULTS / "rupture_3d-stations.csv")
    page = (RESULTS / "rupture-3d.md").read_text()
    for run, arrival, slip in (("500 m", "0.645", "1.1; 2.1"), ("300 m", "0.153", "1.5; 2.1"), ("200 m", "0.073", "1.8; 2.5"),
                               ("150 m", "0.075", None), ("200 m kt 3", "0.036", "1.5; 2.2"), ("150 m kt 3", "0.013", "0.6; 1.2")):
        some = [{key: value if key in ("run", "reference") else float(value) for key, value in row.items()} for row in table if row["run"] == run]
        assert len(some) == 10
        s = rupture_3d.summary(some)
        assert f"{s['arrival']:.3f}" == arrival and f" {arrival}" in page
        if slip:
            assert f"{100 * s['slip']:.1f}; {100 * s['slip_max']:.1f}" == slip and f" {slip} " in page
