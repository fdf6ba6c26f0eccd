# SPDX-License-Identifier: GPL-2.0-or-later
"""TPV205-2D and TPV3-2D at 200 m until 6 s compared with the references: slip, arrivals, table and picture."""
import os
import shutil
import sys
import xml.etree.ElementTree as ElementTree
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from data_files import edit, read_catalogue, read_series, same_bytes, table
from programs import INPUTS, SOURCE, Program, refused, run, scene

sys.path.insert(0, str(SOURCE / "results"))
from rupture_3d import Plane  # noqa: E402

TPV5 = dict(dx=1000, length=36000, width=12000, depth=16000, checkpoint=20)  # 80 steps in 4 s
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


def tpv5(program, prefix, **variables):
    """The scene TPV5, which writes a catalogue of drops and a PE series as well."""
    shutil.copy(INPUTS / "rupture_tpv5.variables", ".")
    edit(INPUTS / "rupture_tpv5.in", "tpv5.in", ("lsm/events sides", "lsm/events catalogue ${prefix}.catalogue.csv series ${prefix}.pe.bin sides"))
    run(program, ["-in", "tpv5.in", *scene(**TPV5, prefix=prefix, **variables)[2:]])


def test_tpv5_goes_on_byte_for_byte_and_on_ranks(on_ranks):
    """The restart file is written within an interval of the catalogue, with a rupture that goes on; the next one repeats it. Sums over ranks
    have another order, so that numbers agree to rounding; the history holds floats."""
    for ranks in 1, 2:
        tpv5(on_ranks(ranks), f"whole{ranks}", tend=4)
        tpv5(on_ranks(ranks), f"part{ranks}", tend=2)
        tpv5(on_ranks(ranks), f"part{ranks}", tend=4, restart=f"part{ranks}.restart.20")
        for ending in "catalogue.csv", "pe.bin", "ruptures.csv", "slip.bin":
            same_bytes(f"part{ranks}.{ending}", f"whole{ranks}.{ending}")
    one, two = (read_catalogue(f"whole{ranks}.ruptures.csv")[1] for ranks in (1, 2))
    assert one["step_start"][0] < 20 < one["step_end"][0] and one["rupture_area"][0] > 3e7
    for name, values in one.items():
        assert two[name] == pytest.approx(values, rel=1e-6, abs=1e-6 * np.abs(values).max()), name
    slip = [Plane(f"whole{ranks}.slip.bin").more.astype(float).sum(axis=0) for ranks in (1, 2)]
    assert np.abs(slip[0] - slip[1]).max() < 1e-6 * slip[0].max() and slip[0].max() > 1e-5
    assert read_series("whole2.pe.bin")[3] == pytest.approx(read_series("whole1.pe.bin")[3], rel=1e-9)


@pytest.mark.parametrize("name, variable, value, said", [("tpv205", "patches", "maybe", "yes or no"), ("tpv205", "dx", 0, "a number above 0"),
                                                         ("tpv205", "barrier", 0.5, "a number of at least 1"),
                                                         ("tpv101", "tend", 0, "a number above 0"), ("tpv3", "blocks", "grid", "lattice or packing"),
                                                         ("crack", "speed", 1.5, "a number of at least 0 and less than 1"),
                                                         ("tpv5", "pictures", 0.5, "a whole number of at least 0"),
                                                         ("tpv5", "surface", "miror", "free or mirror")])
def test_variables_of_ruptures_are_checked(lmp, name, variable, value, said):
    refused(lmp, scene(f"rupture_{name}.in", **{variable: value}), f"Variable {variable} is '{value}', but must be {said}")
    refused(lmp, scene(f"rupture_{name}.in", dx="100 200"), "Variable dx is '100 200', but must be a number above 0")


def test_a_rupture_keeps_its_variables(lmp):
    """What is misspelt or has no effect is told; a run that continues cannot have another plane."""
    refused(lmp, scene("rupture_tpv3.in", seed=2), "Variable seed is '2', but has no effect, as blocks is lattice; leave it out")
    tpv5(lmp, "part", tend=1)
    refused(lmp, ["-in", "tpv5.in", *scene(restart="part.restart.20", dx=900, checkpoint=20)[2:]],
            "Variable dx is 900, but restart file part.restart.20 was written with dx = 1000, which it cannot change")
    for checkpoint in 0, 20:
        early = {**TPV5, "prefix": "part", "restart": "part.restart.20", "tend": 0.5, "checkpoint": checkpoint}
        refused(lmp, ["-in", "tpv5.in", *scene(**early)[2:]],
                "Variable tend is 0.5, but must be at least 1, the time of restart file part.restart.20")


def test_tpv5_in_paraview(lmp):
    """The slip rates written for ParaView are those of the slip history, of which all bytes are as without them."""
    tpv5(lmp, "plain", tend=3)
    tpv5(lmp, "shown", tend=3, pictures=20)
    same_bytes("shown.slip.bin", "plain.slip.bin")
    plane, grid = Plane("shown.slip.bin"), ElementTree.parse("shown.40.vtr").getroot().find("RectilinearGrid")
    strike, across, dip = (np.array(one.text.split(), float) for one in grid.find("Piece/Coordinates"))
    assert len(across) == 2 and 0.5 * (strike[1:] + strike[:-1]) == pytest.approx(plane.strike) and 0.5 * (dip[1:] + dip[:-1]) == pytest.approx(
        plane.dip)
    rate = np.array(grid.find("Piece/CellData/DataArray").text.split(), float).reshape(len(dip) - 1, len(strike) - 1, 3)
    n = int(np.flatnonzero(plane.time < 2)[-1])  # records before and after step 40
    means = (plane.more[n:n + 2].astype(float) / plane.scale / plane.duration[n:n + 2, None, None, None]).mean(axis=0)
    assert means[..., 0].max() > 0.5
    for component, found in ((0, rate[..., 0].T), (1, rate[..., 2].T)):
        assert np.abs(found - means[..., component]).max() < 0.05 * means[..., 0].max()
    assert np.abs(rate[..., 0]).max() == pytest.approx(means[..., 0].max(), rel=0.05)
