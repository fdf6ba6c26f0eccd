# SPDX-License-Identifier: GPL-2.0-or-later
"""The gnuplot scripts of studies draw their published tables, in PNG and SVG alike."""
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from programs import SOURCE

TABLES = {
    "slow-driving": {"table": "slow-driving", "around": "slow-driving-around"},
    "slow-driving-slider": {"table": "slow-driving-slider"},
    "work-precision": {"differences": "accuracy_catalogues"},
}  # yapf: disable


@pytest.mark.parametrize("name", TABLES)
def test_drawings(gnuplot, name):
    for table, published in TABLES[name].items():
        shutil.copy(SOURCE / f"results/{published}.csv", f"{table}.csv")
    drawn = subprocess.run(["gnuplot", SOURCE / f"inputs/studies/{name}.gp"], env={**os.environ, "LC_ALL": "C.UTF-8"}, capture_output=True, text=True,
                           check=True)
    assert drawn.stderr == "", "a curve without points in one of the formats"
    assert Path(f"{name}.png").stat().st_size > 10000
    titles = re.findall(r"<title>(.*?)</title>", Path(f"{name}.svg").read_text())
    assert titles[0].replace("_", "-") == name, "what browsers and screen readers call the picture"
    assert not any("using" in title for title in titles), "a command as the name of a curve"
