# SPDX-License-Identifier: GPL-2.0-or-later
"""Robustness of the fault: damaged restart files, kills while these are written, two runs with the same files, and values that
a run continued from a restart file refuses."""
import fcntl
import os
import re
import shutil
import signal
import subprocess
from pathlib import Path

import pytest
from data_files import header, info, same_bytes
from programs import refused, run, scene, start
from variables import declared

SMALL = dict(length=20, width=15, settle=100, velocity=0.01, checkpoint=400, location="yes")


def small(**variables):
    return scene(**{**SMALL, **variables})


def restart_steps(folder="."):
    """Steps of the complete restart files, in order."""
    return sorted(int(path.name.split(".")[2]) for path in Path(folder).glob("a.restart.*.info") if path.name.split(".")[2].isdigit())


def test_values(lmp):
    run(lmp, small(prefix="a", seed=7, massstep=0.05, stress=0.03, steps=500))
    kept = {one.name for one in declared() if one.restart != "-"}
    assert len(kept) > 20 and kept <= set(info("a.restart.end.info")), kept - set(info("a.restart.end.info"))
    for name, value, was in (("seed", 8, 7), ("mass", "r3", "r2"), ("massstep", 0, 0.05), ("preset", "absorbing", "leaky"), ("mu", 0.5, 0.6)):
        refused(lmp, scene(restart="a.restart.end", **{name: value}),
                f"Variable {name} is {value}, but restart file a.restart.end was written with {name} = {was}")
    refused(lmp, scene(restart="a.restart.end", steps=300), "steps = 300, but 500 of them are done; give as many or more")
    # Nothing has to be given again, and a value given again with other digits is the same.
    run(lmp, scene(restart="a.restart.end", steps=900, massstep="5e-2"))
    run(lmp, small(prefix="b", seed=7, massstep=0.05, stress=0.03, steps=500))
    run(lmp, small(prefix="b", seed=7, massstep=0.05, stress=0.03, steps=900, restart="b.restart.end"))
    same_bytes("a.catalogue.csv", "b.catalogue.csv")
    same_bytes("a.pe.bin", "b.pe.bin")
    # With another prefix, the header still says what the fault is.
    run(lmp, scene(restart="a.restart.end", steps=1000, prefix="look", velocity=0.02))
    said = header("look.catalogue.csv")
    wanted = dict(seed="7", massstep="0.05", stress="0.03", velocity="0.02", width="15")
    assert {name: said.get(name) for name in wanted} == wanted


def test_damaged(lmp):
    """Each kind of damage is refused (unit/test_restart_info.cpp); here the scene is."""
    run(lmp, small(prefix="a", steps=900))
    newest, beside = Path("a.restart.900").read_bytes(), Path("a.restart.900.info").read_text()
    Path("flipped").write_bytes(newest[:-20] + bytes([newest[-20] ^ 4]) + newest[-19:])
    Path("flipped.info").write_text(beside)
    refused(lmp, scene(restart="flipped", steps=1500), "flipped: is damaged, its checksum is not that in flipped.info")
    refused(lmp, scene(restart="none", steps=1500), "none: cannot open: No such file")
    # For a restart file of another origin the last line suffices, as made by the command on the page of lsm_variables.
    Path("bare").write_bytes(newest)
    subprocess.run("gzip -c bare | tail -c 8 | od -An -tu4 > bare.info", shell=True, check=True)
    said = run(lmp, small(restart="bare", prefix="a", steps=1000))
    assert "WARNING: Restart file bare has no value of seed" in said.out


def go_on():
    """Words of the next part, from the newest complete restart file or from the beginning."""
    steps = restart_steps()
    return dict(restart=f"a.restart.{steps[-1]}") if steps else dict(overwrite="yes")


FILES = "a.catalogue.csv", "a.pe.bin", "a.ruptures.csv", "a.slip.bin"
CALLS = "write", "rename", "unlink", "fsync"


@pytest.mark.parametrize("call", CALLS)
def test_walk(lmp, work, faults, call):
    """System calls on the run's files kill the run or report a full disk, a few calls of each kind."""
    words = small(checkpoint=100, prefix="a", steps=300, ruptures="yes")
    part = work / "part"
    traced = faults(lmp, [
        name for file in (*FILES, *(f"a.restart.{at}" for at in (200, 300, 400, "end"))) for end in ("", ".new", ".info", ".info.new")
        for name in (f"{part}/{file}{end}", f"{file}{end}")
    ], call)

    def empty():
        shutil.rmtree(part, ignore_errors=True)
        part.mkdir()
        os.chdir(part)

    os.mkdir("whole")
    run(lmp, words, cwd="whole")
    empty()
    number = len(traced.calls(words))
    assert number >= 4, f"{number} calls on the run's files"
    for at in 1, number // 2 + 1, number:
        for fault in "signal=KILL", "error=ENOSPC":
            what = f"{fault} at {call} {at}"
            empty()
            result = traced.inject(fault, call, at, words)
            if fault == "error=ENOSPC" and result.status != 0:
                lines = [line for line in lmp.errors(result) if re.search(r"cannot .* a\.|a\..*cannot|writing restart", line)]
                assert len(lines) == 1, f"{what}: {result}"
            # A file that cannot be removed does no harm.
            assert result.status != 0 or (call, fault) == ("unlink", "error=ENOSPC"), f"{what}: no word"
            if not Path("a.restart.end.info").exists():
                run(lmp, words, [word for name, value in go_on().items() for word in ("-var", name, value)])
            for name in FILES:
                assert Path(name).read_bytes() == (work / "whole" / name).read_bytes(), f"{name} differs after {what}"


def test_twice(lmp):
    """Two runs cannot use the same files; a killed run keeps no lock."""
    run(lmp, small(prefix="a", steps=400))
    shutil.copytree(".", "whole")
    more = scene(restart="a.restart.end", steps=6000)

    def locked():
        with open("a.catalogue.csv") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
            except BlockingIOError:
                return True
        return False

    with start(lmp, scene(restart="a.restart.end", steps=600000)) as killed:
        assert killed.until(locked, pause=0.01)
        killed.send_signal(signal.SIGSTOP)
        refused(lmp, more, "a.catalogue.csv: is being written by another run")
    for path in Path("whole").glob("a.*"):
        shutil.copy(path, path.name)
    run(lmp, more)
    run(lmp, more, cwd="whole")
    for name in "a.catalogue.csv", "a.pe.bin":
        same_bytes(name, f"whole/{name}")
