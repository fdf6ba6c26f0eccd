# SPDX-License-Identifier: GPL-2.0-or-later
"""Fixtures of all tests of programs. programs.py runs programs, data_files.py reads and writes files."""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

sys.dont_write_bytecode = True
from programs import INPUTS, SOURCE, Faults, Program  # noqa: E402

sys.path.insert(0, str(INPUTS))
from run import MPI  # noqa: E402


def pytest_sessionfinish(session, exitstatus):
    """If all tests were skipped, ctest has to report this as skipped and not as passed."""
    reporter = session.config.pluginmanager.getplugin("terminalreporter")
    if exitstatus == 0 and "skipped" in reporter.stats and "passed" not in reporter.stats:
        session.exitstatus = 77


@pytest.fixture(autouse=True)
def work(monkeypatch):
    """Every test runs in a folder of its own, which is removed afterwards."""
    with tempfile.TemporaryDirectory(prefix="lsm-test-", ignore_cleanup_errors=True) as folder:
        monkeypatch.chdir(folder)
        yield Path(folder)


@pytest.fixture(scope="session")
def slider():
    return Program.built("slider_cli")


@pytest.fixture(scope="session")
def postproc():
    return Program.built("postproc")


def lammps_errors(result):
    return [line for line in result.out.splitlines() if "ERROR" in line]


@pytest.fixture(scope="session")
def lmp():
    """lmp on one rank, without a log file."""
    return Program.built("lmp", "-log", "none", env=MPI, errors=lammps_errors)


@pytest.fixture(scope="session")
def on_ranks(lmp):
    """on_ranks(n): lmp on n ranks."""
    return lambda ranks: Program("lmp", SOURCE / "tests/mpirun.sh", "-np", ranks, *lmp.command, env=lmp.env, errors=lmp.errors)


@pytest.fixture(scope="session")
def faults():
    """faults(program): injects faults into its system calls (programs.Faults)."""
    return Faults


@pytest.fixture
def small_disk(work):
    """small_disk(megabytes): a folder with no more space than this; another call changes its size."""
    folder = work / "small"

    def mount(megabytes):
        again = os.path.ismount(folder)
        folder.mkdir(exist_ok=True)
        options = f"size={megabytes}m" + (",remount" if again else "")
        if subprocess.run(["mount", "-t", "tmpfs", "-o", options, "none", folder], capture_output=True).returncode:
            pytest.skip("mounting a small disk is not allowed")
        return folder

    yield mount
    if os.path.ismount(folder):
        subprocess.run(["umount", folder], check=True)


@pytest.fixture(scope="session")
def gnuplot():
    if not shutil.which("gnuplot"):
        pytest.skip("no gnuplot")
