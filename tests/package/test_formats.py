# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that version 1.0 wrote, in tests/data/1.0, are read by every reader (lammps-pkg/doc/formats.md).
contents.json says what is in them; neither it nor they are ever changed."""
import copy
import json
import math
import pickle
import sys
from pathlib import Path

import numpy as np
import pytest
from data_files import table, write_history
from programs import SOURCE, refused, run

sys.path.insert(0, str(SOURCE / "python"))
import lsm.ruptures  # noqa: E402

DATA = SOURCE / "tests/data/1.0"
CONTENTS = json.loads((DATA / "contents.json").read_text())
CATALOGUES = [name for name in CONTENTS if name.endswith(".csv")]
SERIES = [name for name in CONTENTS if name.endswith(".pe.bin")]


@pytest.mark.parametrize("name", CONTENTS)
def test_python_reads_1_0(name):
    read, quantity, last = ((lsm.read_catalogue, "size", "t_end") if name in CATALOGUES else (lsm.read_series, "pe", "time") if name in SERIES else
                            (lsm.read_slip, "slip", "step_end"))
    found, wanted = read(DATA / name), CONTENTS[name]
    assert list(found.dtype.names) == wanted["columns"] and len(found) == wanted["rows"]
    assert found[quantity].sum(dtype=float) == pytest.approx(wanted["sum"], rel=1e-12) and found[last][-1] == wanted["last"]
    assert found.header["model"] == wanted["model"]


@pytest.mark.parametrize("name", CATALOGUES + ["fault.catalogue.csv.xz"])
def test_postproc_reads_catalogues_of_1_0(postproc, name):
    run(postproc, "count", DATA / name, "--size 0 --json n.json")
    found, wanted = json.loads(Path("n.json").read_text()), CONTENTS[name.removesuffix(".xz")]
    assert found["catalogues"][0]["events"] == wanted["rows"] and found["catalogues"][0]["last_end"] == wanted["last"]
    assert found["sizes"][0]["released"] == pytest.approx(wanted["sum"], rel=1e-12)


@pytest.mark.parametrize("name", SERIES)
def test_postproc_reads_series_of_1_0(postproc, name):
    run(postproc, "series", DATA / name, "-o s --no-picture --columns 1000000")
    rows = table("s.csv")
    assert len(rows) == CONTENTS[name]["rows"] and sum(float(row["pe"]) for row in rows) == pytest.approx(CONTENTS[name]["sum"], rel=1e-12)
    assert float(rows[-1]["time"]) == CONTENTS[name]["last"]


def test_picking_the_series_of_1_0_gives_its_catalogue(postproc):
    run(postproc, "pick", DATA / "fault.pe.bin", "-o picked.csv")
    assert table("picked.csv") == table(DATA / "picked.catalogue.csv")


def test_pages_of_files_of_1_0(postproc):
    run(postproc, "explore", DATA / "fault.catalogue.csv", "-o page.html")
    page = Path("page.html").read_text()
    assert "fault" in page
    begin, end = -math.inf, math.inf
    drawn = [
        *lsm.ruptures.line_figures(lsm.ruptures.History(DATA / "fault.slip.bin"), lsm.ruptures.load(DATA / "fault.ruptures.csv"), begin, end, (2, 1))
    ]
    assert all(len(figure.rows) > 10 for figure in drawn)


def test_a_later_1_x_may_add_lines_and_columns(postproc):
    lines = (DATA / "fault.catalogue.csv").read_text().splitlines()
    later = ["# lsm-catalogue 1", "# of_later = yes", *lines[1:]]
    later = [line if line.startswith("#") else line + (",later" if line.startswith("event_id") else ",0.5") for line in later]
    Path("later.csv").write_text("\n".join(later) + "\n")
    run(postproc, "count later.csv --size 0 --json n.json")
    wanted = CONTENTS["fault.catalogue.csv"]
    assert json.loads(Path("n.json").read_text())["catalogues"][0]["events"] == len(lsm.read_catalogue("later.csv")) == wanted["rows"]


def test_python_reads_slip_of_a_plane():
    slip = np.arange(3 * 4 * 5 * 2).reshape(3, 4, 5, 2)
    work, stress = slip[..., 0] + 0.25, -slip
    write_history("plane.slip.bin", [100, 110, 120], slip, stress=stress, work=work)
    found = lsm.read_slip("plane.slip.bin")
    assert found.header["bins_dip"] == "5" and list(found["step_end"]) == [100, 110, 120]
    for name, wanted in ("slip", slip), ("work", work), ("stress", stress):
        assert np.array_equal(found[name], wanted), name
    raw = Path("plane.slip.bin").read_bytes()
    Path("plane.slip.bin").write_bytes(raw.replace(b"# bins_dip = 5", b"# bins_dip = 0"))
    with pytest.raises(ValueError, match="plane.slip.bin: parameter 'bins_dip' is 0, expected at least 1"):
        lsm.read_slip("plane.slip.bin")


def test_python_keeps_the_header_in_other_processes(postproc):
    events = lsm.read_catalogue(DATA / CATALOGUES[0])
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        for table in events, events[:2], copy.deepcopy(events):
            again = pickle.loads(pickle.dumps(table, protocol))
            assert isinstance(again, lsm.Table) and again.header == events.header and again.header["model"]
            assert again.dtype == events.dtype and again.tobytes() == table.tobytes()


@pytest.mark.parametrize("number", [0, -1, math.nan, math.inf, -math.inf])
def test_python_refuses_widths_and_units_that_are_none(postproc, number):
    events = lsm.read_catalogue(DATA / CATALOGUES[0])
    with pytest.raises(ValueError, match="^width is .*, expected a number above 0$"):
        lsm.rates(events, number)
    for name in "length", "p_speed", "density", "thickness":
        with pytest.raises(ValueError, match=f"^{name} is .*, expected a number above 0$"):
            lsm.units(**{**dict(length=100, p_speed=6000, density=2700), name: number})
    assert lsm.units(100, 6000, 2700) == lsm.units(100, 6000, 2700, thickness=100)


def test_another_number_is_refused(postproc):
    for name, old in ("fault.catalogue.csv", b"lsm-catalogue 1"), ("fault.pe.bin", b"lsm-pe-series-1"), ("fault.slip.bin", b"lsm-slip-hist-1"):
        raw = (DATA / name).read_bytes()
        Path(name).write_bytes(raw.replace(old, old[:-1] + b"3", 1))
    refused(postproc, "count fault.catalogue.csv", "version '3', expected version 1")
    refused(postproc, "series fault.pe.bin -o x", "of another version, expected version 1")
    refused(postproc, ["explore", DATA / "fault.catalogue.csv", "--history", "fault.slip.bin", "-o", "x"],
            "of another version, expected version 1 to 2")
    for name, read in ("fault.catalogue.csv", lsm.read_catalogue), ("fault.pe.bin", lsm.read_series), ("fault.slip.bin", lsm.read_slip):
        with pytest.raises(ValueError, match=f"{name}: "):
            read(name)
