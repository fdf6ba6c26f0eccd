# SPDX-License-Identifier: GPL-2.0-or-later
"""SI units of the fault, and the speeds from which they follow."""
import re
import sys
from pathlib import Path

import numpy as np
import pytest
from data_files import write_catalogue
from programs import SOURCE, run

sys.path.insert(0, str(SOURCE / "python"))
import lsm  # noqa: E402

# Computed by hand from the speeds of P-waves, 2.00, and S-waves, 1.05, and the density 0.286 in model units.
VELOCITY = 6000 / 2.00
TIME = 100 / VELOCITY
MODULUS = 2700 * (1.05 * VELOCITY)**2
MOMENT = MODULUS * 100**3
ENERGY = 2700 / 0.286 * VELOCITY**2 * 100**3


def test_units():
    unit = lsm.units(length=100, p_speed=6000, density=2700)
    assert unit["time"] == pytest.approx(TIME) and unit["velocity"] == pytest.approx(VELOCITY) and unit["length"] == 100
    assert unit["stress"] == pytest.approx(2700 / 0.286 * VELOCITY**2)
    assert unit["energy"] == pytest.approx(ENERGY) and unit["moment"] == pytest.approx(MOMENT)
    # A normal stress of 0.022, and the plates of the paper: 1.9 GPa, 0.75 m/s
    assert 0.022 * unit["stress"] == pytest.approx(1869e6, rel=1e-3) and 0.00025 * unit["velocity"] == pytest.approx(0.75, abs=1e-3)
    assert lsm.units(100, 6000, 2700, thickness=5000)["moment"] == pytest.approx(50 * MOMENT)


def test_speeds_are_those_of_the_packing_everywhere(postproc, work):
    write_catalogue("c.csv", np.arange(30.0), np.ones(30))
    run(postproc, "explore c.csv -o c.html")
    page = Path("c.html").read_text(encoding="utf-8")
    assert [float(re.search(rf'"{name}":([0-9.]+)', page)[1]) for name in ("pSpeed", "sSpeed")] == [lsm.P_SPEED, lsm.S_SPEED]
