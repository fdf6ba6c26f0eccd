# SPDX-License-Identifier: GPL-2.0-or-later
"""TPV205-2D and TPV3-2D at 200 m until 6 s compared with the references: slip, arrivals, table and picture."""
import os
import shutil
import sys
from collections import Counter
from pathlib import Path

import pytest
from data_files import table
from programs import INPUTS, SOURCE, Program, refused, run, scene

COMPARE = Program("rupture_benchmark.py", sys.executable, SOURCE / "results/rupture_benchmark.py")


@pytest.fixture
def ruptured(lmp):
    """ruptured(benchmark): runs it and compares it at stations up to 12 km. Returns the number of stations of
    each reference, and the largest differences of arrivals (s) and slip (relative)."""

    def compare(name, *more):
        run(lmp, scene(f"rupture_{name}.in", dx=200, length=60000, width=30000, tend=6, prefix=name))
        run(COMPARE, Path(f"{name}.slip.bin"), "--reference", INPUTS / f"reference/{name}.csv", "-o beside", *more)
        near = [cells for cells in map(lambda row: list(row.values()), table("beside-stations.csv")) if abs(float(cells[3])) <= 12000]
        late = max(abs(float(cells[4]) - float(cells[5])) for cells in near)
        return Counter(cells[2] for cells in near), late, max(abs(float(cells[6]) / float(cells[7]) - 1) for cells in near)

    return compare


def test_tpv205(ruptured):
    drawn = bool(shutil.which("gnuplot"))
    stations, late, slip = ruptured("tpv205", *([] if drawn else ["--no-picture"]))
    if drawn:
        assert os.path.getsize("beside.png") > 0
        svg = Path("beside.svg").read_text()
        assert "right: slip less that of boundary integral 25 m" in svg and svg.count("<title>PyLith 200 m</title>") == 1
    curves = table("beside.csv")
    of_run = [row for row in curves if row["number"] == "3" and row["difference"]]
    largest = max(abs(float(row["difference"])) for row in of_run)
    assert 0.001 < largest < 0.05 * max(float(row["slip"]) for row in of_run)
    assert all(float(row["difference"]) == 0 for row in curves if row["number"] == "2" and row["difference"])
    # Slip agrees within 1.5 % and arrivals within 0.15 s with both references.
    assert stations == {"PyLith 200 m": 5, "boundary integral 25 m": 17} and late < 0.15 and slip < 0.015

    # A place between two bins is accepted; others are refused.
    def reference(place, *times):
        Path("columns").write_text("curve,x,t,slip,slip_rate\n" + "".join(f"by hand,{place},{t},{t},1.5\n" for t in times))

    command = "tpv205.slip.bin --reference columns --no-picture -o "
    reference(1234, 0, 3, 6)
    run(COMPARE, command + "one").printed("by hand")
    reference(99999, 0, 3, 6)
    refused(COMPARE, command + "two", "no slip at x = 99999")
    reference(0, 1, 1)
    refused(COMPARE, command + "two", "columns:3: time 1, expected increasing times")


def test_tpv3(ruptured):
    stations, late, slip = ruptured("tpv3", "--no-picture")
    assert sum(stations.values()) == 17 and late < 0.08 and slip < 0.015
