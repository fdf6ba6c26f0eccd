# SPDX-License-Identifier: GPL-2.0-or-later
"""The program slider_cli: coupling of the blocks, radiation, strengths of each block."""
import json
import math
import re
import signal
from pathlib import Path

import pytest
from data_files import header, rows, same_bytes, table
from programs import INPUTS, changed, interrupt, refused, run

SHORT = "--blocks 64 --kl 0.05 --velocity 0.05 --warmup 0 --seed 3 --steps 200000 "


@pytest.fixture
def ran(slider):
    return lambda *arguments, **more: run(slider, "--overwrite", *arguments, **more)


@pytest.fixture
def no(slider):
    return lambda arguments, pattern: refused(slider, "--overwrite --catalogue bad.csv --blocks 16 --time 100 " + arguments, pattern)


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


def test_file_of_stiffness(ran, no):
    """The stiffness of the springs, given as modes, gives the same chain."""
    blocks, kl = 64, 0.05
    lines = [f"{2 * math.pi * n / blocks:.17g},{2 - 2 * math.cos(2 * math.pi * n / blocks) + kl:.17g}" for n in range(blocks // 2 + 1)]
    Path("springs.csv").write_text("# wavenumber,stiffness\n" + "\n".join(lines) + "\n")
    # The run ends before chaos amplifies the last digit.
    early = "--blocks 64 --velocity 0.05 --warmup 0 --seed 3 --time 330 "
    ran(early, "--kl 0.05 --catalogue chain.csv --events ruptures")
    ran(early, "--coupling springs.csv --catalogue modes.csv --events ruptures")
    chain, modes = table("chain.csv"), table("modes.csv")
    assert len(chain) == len(modes) >= 5
    for a, b in zip(chain, modes):
        assert a["step_start"] == b["step_start"] and float(a["size"]) == pytest.approx(float(b["size"]), rel=1e-6)
    assert header("modes.csv")["coupling"].startswith("springs.csv ")
    no("--coupling springs.csv --kl 0.1", "--kl and --coupling springs.csv exclude each other")
    no("--coupling springs.csv --width 10", "--width needs --coupling antiplane or inplane")
    no("--coupling none.csv", "--coupling = 'none.csv', expected chain, antiplane or inplane, or a readable file")
    no("--coupling springs.csv --json springs.csv", "is read by this run")
    for text, said in (("0,1\n0.5\n", "bad.txt:2: '0.5', expected wavenumber,stiffness"), ("0.1,1\n4,2\n", "bad.txt:1: wavenumber 0.1"),
                       ("0,1\n2,2\n1,2\n", "bad.txt:3: wavenumber 1"), ("0,1\n4,-2\n", "bad.txt:2: .*stiffness -2"),
                       ("0,1\n3,2\n", "bad.txt: ends at wavenumber 3, expected lines up to pi"), ("", "ends at wavenumber none")):
        Path("bad.txt").write_text(text)
        no("--coupling bad.txt", said)


def test_strength_of_each_block(ran, no):
    strengths = [0.5 + 0.5 * (n % 7) / 7 for n in range(64)]
    Path("mu.txt").write_text("# an asperity\n" + "\n".join(f"{s:.17g}" for s in strengths) + "\n")
    ran(SHORT, "--friction-file mu.txt --catalogue file.csv")
    assert header("file.csv")["friction_file"].startswith("mu.txt ")
    # The weakest block starts first, when the leaf spring pulls with its strength.
    ran(SHORT, "--friction-file mu.txt --events ruptures --catalogue first.csv")
    first = min(float(row["t_start"]) for row in table("first.csv"))
    assert first == pytest.approx(min(strengths) / (0.05 * 0.05), abs=0.1)
    for text, said in (("0.5\n" * 15, "bad.txt: 15 strengths, expected 16"), ("0.5\n" * 17, "bad.txt:17: more strengths, expected 16"),
                       ("0.5\nx\n", "bad.txt:2: 'x', expected one strength"), ("0.5\n-1\n", "bad.txt:2: -1, expected one strength")):
        Path("bad.txt").write_text(text)
        no("--friction-file bad.txt", said)
    no("--friction-file none.txt", "none.txt")
    no("--friction-file mu.txt --friction-range 0.5 1", "--friction-(file|range)")
    no("--friction-file mu.txt --correlation-length 1", "--(friction-file|correlation-length)")


def test_limits(no):
    no("--radiation -1", "--radiation = -1, expected a finite number >= 0")
    no("--mass 0", "--mass = 0, expected a positive number, or --radiation")
    no("--mass 0 --radiation 1 --scheme verlet", "--scheme = verlet, expected adams-bashforth with --mass 0")
    no("--scheme adams-bashforth", "--scheme adams-bashforth needs --mass 0")
    no("--mass 0 --radiation 1 --dt 0.5", "--dt = 0.5, expected at most 0.249")
    no("--radiation 10 --mass 0.1", "--dt = 0.05, expected at most 0.02")
    no("--coupling antiplane --kl 0.1 --width 5", "--(kl|width)")
    no("--width 5", "--width needs --coupling antiplane or inplane")
    no("--coupling inplane --width -5", "--width = -5, expected a positive finite number")
    no("--coupling inplane --kc 0", "--kc = 0, expected a positive finite number")
    for more in "--coupling antiplane", "--radiation 0.1", "--correlation-length 1":
        no("--leap 1e-3 " + more, "--leap needs --coupling chain without")
    for length in "nan", "1e-19":  # cells that short could not be counted
        no(f"--correlation-length {length}", f"--correlation-length = {length}, expected 0, or a finite number of at least 1e-9")
    no("--leap 1e-3 --events ruptures --rupture-gap 51", "--rupture-gap = 51, expected at most 50 with --leap")


@pytest.mark.parametrize("way", [
    "--coupling antiplane --radiation 0.1", "--coupling inplane --mass 0 --radiation 1.5 --law coulomb",
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


def test_ensembles_of_threads(ran):
    settings = SHORT + "--coupling antiplane --radiation 0.1 "
    ran(settings, "--ensemble 4 --threads 4 --catalogue run{run}.csv")
    for k in range(4):
        ran(settings, "--seed", k + 3, "--catalogue alone.csv")
        assert rows("alone.csv") == rows(f"run{k + 1}.csv")
        assert len(rows("alone.csv")) > 5


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
