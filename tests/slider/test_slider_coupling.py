# SPDX-License-Identifier: GPL-2.0-or-later
"""The program slider_cli: coupling of the blocks, radiation."""
import math
import re

import pytest
from data_files import header, rows, same_bytes
from programs import INPUTS, run

SHORT = "--blocks 64 --kl 0.05 --velocity 0.05 --warmup 0 --seed 3 --steps 200000 "


@pytest.fixture
def ran(slider):
    return lambda *arguments, **more: run(slider, "--overwrite", *arguments, **more)


def test_header_has_what_couples(ran):
    ran(SHORT, "--coupling antiplane --catalogue a.csv")
    found = header("a.csv")
    assert found["coupling"] == "antiplane" and found["kl"] == "0.05"
    assert float(found["modulus"]) / float(found["width"]) == pytest.approx(0.05)
    ran(SHORT.replace("--kl 0.05", ""), "--coupling antiplane --width", found["width"], "--catalogue b.csv")
    assert float(header("b.csv")["modulus"]) == pytest.approx(float(found["modulus"]), rel=1e-9)
    ran(SHORT, "--coupling chain --catalogue c.csv")
    ran(SHORT, "--catalogue d.csv")
    same_bytes("c.csv", "d.csv")
    assert not {"coupling", "radiation", "width"} & set(header("d.csv"))


def test_stiffness_of_the_lattice(lmp, ran):
    """It is measured mode by mode. For long waves it is that of an elastic block, and the file can couple the blocks."""
    said = run(lmp, ["-in", INPUTS / "lattice_stiffness.in", "-var", "long", 32, "-var", "rows", 17])
    differences = {float(w): float(d) for w, d in re.findall(r"^wavelength ([\d.]+): .* difference (\S+)$", said.out, re.M)}
    assert 0.0 < differences[32.0] < 0.012 and 0.0 < differences[16.0] < 0.045
    # The difference is of second order in the wavenumber.
    assert 3.5 < differences[16.0] / differences[32.0] < 4.5
    ran("--blocks 32 --coupling lattice.stiffness.csv --dt 0.02 --time 20000 --warmup 0 --catalogue lattice.csv")
    width = 16 * math.sqrt(3) / 2
    assert float(header("lattice.csv")["kl"]) == pytest.approx(math.sqrt(3) / 8 / width, rel=1e-12)
    assert len(rows("lattice.csv")) > 5
