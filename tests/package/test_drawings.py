# SPDX-License-Identifier: GPL-2.0-or-later
"""The gnuplot scripts of studies draw their tables, in PNG and SVG alike."""
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from programs import SOURCE

TABLES = {
    "slow-driving": {
        "table.csv": """velocity,leap,fast,displacement,events_3,events_2,events_1,long,long_error,from_2,from_2_error,gamma,gamma_error,gamma_2,gamma_2_error,steps_per_large
2.5e-4,no,,36,620,390,190,1.06,0.02,1.05,0.04,0.94,0.05,1.67,0.11,3100
2.5e-5,no,,36,1270,550,236,1.29,0.01,1.17,0.03,0.39,0.02,1.06,0.05,21600
2.5e-5,yes,2.5e-4,36,1080,490,226,1.26,0.02,1.08,0.03,0.38,0.02,1.23,0.07,3300
2.5e-6,yes,1e-4,36,1500,620,250,1.34,0.02,1.26,0.03,0.26,0.02,0.89,0.05,6300
""", "around.csv": """velocity,leap,fast,time,rate
2.5e-4,no,,1.5,0.07
2.5e-5,no,,1.5,0.1
2.5e-5,yes,2.5e-4,15,0.04
2.5e-6,yes,2.5e-4,15,0.04
2.5e-7,yes,2.5e-4,150,0.002
2.5e-8,yes,2.5e-4,1500,2e-5
"""
    },
    "work-precision": {
        "differences.csv": """dt,massfloor,onset,kt,time_per_core_hour,rate,rate_error,exponent,exponent_error,gamma,gamma_error
""" + "".join(f"{0.03 * n},0,located,1,{1e6 * n},0.01,0.005,0.01,0.005,0.02,0.01\n" for n in range(1, 9))
    },
}


@pytest.mark.parametrize("name", TABLES)
def test_drawings(name, work):
    if not shutil.which("gnuplot"):
        pytest.skip("no gnuplot")
    for table, text in TABLES[name].items():
        Path(table).write_text(text)
    drawn = subprocess.run(["gnuplot", SOURCE / f"inputs/studies/{name}.gp"], env={**os.environ, "LC_ALL": "C.UTF-8"}, capture_output=True, text=True,
                           check=True)
    assert drawn.stderr == "", "a curve without points in one of the formats"
    assert Path(f"{name}.png").stat().st_size > 10000
    titles = re.findall(r"<title>(.*?)</title>", Path(f"{name}.svg").read_text())
    assert titles[0].replace("_", "-") == name, "what browsers and screen readers call the picture"
    assert not any("using" in title for title in titles), "a command as the name of a curve"
