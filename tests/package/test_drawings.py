# SPDX-License-Identifier: GPL-2.0-or-later
"""The gnuplot scripts of studies draw the published tables, in PNG and SVG alike."""
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from programs import SOURCE

RESULTS = SOURCE / "results"
TABLES = {
    "slow-driving": f"table = '{RESULTS}/slow-driving.csv'; around = '{RESULTS}/slow-driving-aftershocks.csv'",
    "slow-driving-slider": f"table = '{RESULTS}/slow-driving-slider.csv'",
    "work-precision": f"table = '{RESULTS}/accuracy_catalogues.csv'",
    "regime-map": f"table = '{RESULTS}/regime-map.csv'",
}


@pytest.mark.parametrize("name", TABLES)
def test_drawings(name, work):
    if not shutil.which("gnuplot"):
        pytest.skip("no gnuplot")
    told = subprocess.run(["gnuplot", "-e", TABLES[name], SOURCE / f"inputs/studies/{name}.gp"], capture_output=True, text=True, check=True)
    assert told.stderr == "", "a curve without points in one of the formats"
    pictures = [path for path in Path(".").iterdir()]
    assert sorted(path.suffix for path in pictures) == [".png", ".svg"]
    for svg in (path.read_text() for path in pictures if path.suffix == ".svg"):
        titles = re.findall(r"<title>(.*?)</title>", svg)
        assert titles[0].replace("_", "-") == name, "what browsers and screen readers call the picture"
        assert not any("using" in title for title in titles), "a command as the name of a curve"
