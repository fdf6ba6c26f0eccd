# SPDX-License-Identifier: GPL-2.0-or-later
"""SI units of the fault: the same conversion in magnitudes and lsm.units."""
import json
import math
import re
import sys
from pathlib import Path

import numpy as np
import pytest
from data_files import write_catalogue
from programs import SOURCE, refused, run

sys.path.insert(0, str(SOURCE / "python"))
import lsm  # noqa: E402

ROCK = "--unit-length 100 --p-speed 6000 --density 2700"
# Computed by hand from the speeds of P-waves, 2.00, and S-waves, 1.05, and the density 0.286 in model units.
VELOCITY = 6000 / 2.00
TIME = 100 / VELOCITY
MODULUS = 2700 * (1.05 * VELOCITY)**2
MOMENT = MODULUS * 100**3
ENERGY = 2700 / 0.286 * VELOCITY**2 * 100**3


@pytest.fixture
def catalogue():
    """catalogue(path, ...): 60 events with moments 1, 0.1, 10 in turn."""

    def write(path, model="lsm", **header):
        t = np.arange(60.0)
        write_catalogue(path, t, np.tile([0.5, 0.05, 2.0], 20), dict(model=model, length=40, stress=0.022, velocity=0.00025, **header), t_end=t + 0.5,
                        pe_start=[3] * 60, pe_end=[2] * 60, slip_moment=np.tile([1.0, 0.1, 10.0], 20))

    return write


def mw(moment):
    return 2 / 3 * (math.log10(moment) - 9.1)


def test_units():
    unit = lsm.units(length=100, p_speed=6000, density=2700)
    assert unit["time"] == pytest.approx(TIME) and unit["velocity"] == pytest.approx(VELOCITY) and unit["length"] == 100
    assert unit["stress"] == pytest.approx(2700 / 0.286 * VELOCITY**2)
    assert unit["energy"] == pytest.approx(ENERGY) and unit["moment"] == pytest.approx(MOMENT)
    # A normal stress of 0.022, and the plates of the paper: 1.9 GPa, 0.75 m/s
    assert 0.022 * unit["stress"] == pytest.approx(1869e6, rel=1e-3) and 0.00025 * unit["velocity"] == pytest.approx(0.75, abs=1e-3)
    assert lsm.units(100, 6000, 2700, thickness=5000)["moment"] == pytest.approx(50 * MOMENT)


def test_speeds_are_those_of_the_packing_everywhere(postproc, catalogue):
    catalogue("c.csv")
    run(postproc, "explore c.csv -o c.html")
    page = Path("c.html").read_text(encoding="utf-8")
    assert [float(re.search(rf'"{name}":([0-9.]+)', page)[1]) for name in ("pSpeed", "sSpeed")] == [lsm.P_SPEED, lsm.S_SPEED]


def magnitudes_of(postproc, path, *words):
    """The mean magnitude, by Aki's b = 1 / (ln 10 (mean - Mc)) of all of them."""
    found = json.loads(run(postproc, f"magnitudes {path} --complete-from 0 --no-picture --overwrite -o m --json -", *words).out)["b_values"][0]
    return 1 / (found["b"] * math.log(10))


def test_magnitudes_in_si(postproc, catalogue):
    catalogue("c.csv")
    assert magnitudes_of(postproc, "c.csv", ROCK) == pytest.approx(np.mean([mw(m * MOMENT) for m in (1, 0.1, 10)]))
    assert magnitudes_of(postproc, "c.csv", ROCK, "--magnitude-of size --thickness 5000") == pytest.approx(
        np.mean([2 / 3 * (math.log10(size * 50 * ENERGY) - 4.4) for size in (0.5, 0.05, 2)]))


def test_moments_of_ruptures_contain_the_modulus(postproc, catalogue):
    catalogue("c.csv")
    catalogue("r.csv", events="ruptures", modulus=0.5)
    assert magnitudes_of(postproc, "r.csv", ROCK) == pytest.approx(magnitudes_of(postproc, "c.csv", ROCK) + 2 / 3 * math.log10(2))
    run(postproc, "magnitudes r.csv -o m --no-picture", ROCK).printed("Mw = \\(2/3\\) \\(log10 M0 - 9.1\\)")


def test_units_are_given_once_and_whole(postproc, catalogue):
    catalogue("c.csv")
    catalogue("slider.csv", model="block-slider")
    for left_out in "--unit-length 100", "--p-speed 6000", "--density 2700":
        refused(postproc, "magnitudes c.csv -o x " + ROCK.replace(left_out, ""), f"no {left_out.split()[0]}: expected all of")
    refused(postproc, f"magnitudes c.csv -o x {ROCK} --magnitude-constant 1", "magnitude-constant with --unit-length, from which it follows")
    refused(postproc, f"magnitudes slider.csv -o x {ROCK}", "slider.csv: model is 'block-slider', expected 'lsm' for SI units")


def test_catalogue_without_moments_says_how_to_record_them(postproc):
    t = np.array([0.0, 10.0])
    write_catalogue("c.csv", t, np.array([0.5, 0.05]), dict(model="lsm", length=40), t_end=t + 1, pe_start=[3] * 2, pe_end=[2] * 2)
    refused(postproc, f"magnitudes c.csv -o x {ROCK}", "c.csv: has no column slip_moment.*-var location yes")
