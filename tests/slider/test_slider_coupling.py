# SPDX-License-Identifier: GPL-2.0-or-later
"""The program slider_cli: coupling of the blocks, radiation."""
import json
import math
import re
import signal
from pathlib import Path

import pytest
from data_files import header, rows, same_bytes
from programs import INPUTS, changed, interrupt, run

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


@pytest.mark.parametrize("way", [
    "--coupling inplane --mass 0 --radiation 1.5 --law coulomb",
    "--coupling antiplane --law coulomb --dynamic-friction 1 --correlation-length 0.5 --radiation 0.1"
])
def test_killed_and_resumed(slider, ran, way):
    settings = SHORT.replace("200000", "1000000") + way + " --columns centroid,length --pe-stride 100 "
    ran(settings, "--catalogue whole.csv --pe-series whole.pe --json whole.json")
    part = settings + "--catalogue part.csv --pe-series part.pe --checkpoint part.chk --checkpoint-interval 30011 --json part.json "
    count = 0
    for _ in range(3):
        more = "--resume" if Path("part.chk").exists() else "--overwrite"
        count += interrupt(slider, part, more, when=changed("part.chk"), by=signal.SIGKILL)
    assert count >= 1
    ran(part, "--resume")
    same_bytes("whole.csv", "part.csv")
    same_bytes("whole.pe", "part.pe")
    assert len(rows("whole.csv")) >= 10
    whole, again = (json.loads(Path(name).read_text()) for name in ("whole.json", "part.json"))
    assert whole["radiated"] == again["radiated"] > 0


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
