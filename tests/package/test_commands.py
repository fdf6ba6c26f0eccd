# SPDX-License-Identifier: GPL-2.0-or-later
"""The commands of the README on machines without apt or without root; PATH is a folder of made-up programs."""
import os
import subprocess

import pytest

from programs import SOURCE

PACKAGES = SOURCE / "lammps-pkg/cmake/debian-packages.sh"


@pytest.fixture
def machine(work):
    """machine(NAME, ...): runs a line of bash after debian-packages.sh, where only these programs and a few of coreutils are."""
    folder = work / "bin"
    folder.mkdir()

    def run(line, *programs, **scripts):
        for name in ("bash", "env", "grep", "id", "echo", "cat"):
            if name not in scripts and not (folder / name).exists():
                os.symlink(f"/usr/bin/{name}", folder / name)
        for name, script in {**{name: "exit 0" for name in programs}, **scripts}.items():
            file = folder / name.replace("_", "-")
            file.write_text(f"#!/bin/bash\n{script}\n")
            file.chmod(0o755)
        return subprocess.run(["/bin/bash", "-c", f"set -euo pipefail; . {PACKAGES}; {line}"], env={"PATH": str(folder)}, capture_output=True,
                              text=True)

    return run


def test_without_apt_one_line_says_what_is_expected_and_it_goes_on(machine):
    ran = machine("install_debian_packages cmake libgsl-dev zlib1g-dev; echo went on")
    assert (ran.returncode, ran.stdout) == (0, "went on\n")
    assert ran.stderr == "No apt here. Expected to be installed, by their names in Debian: cmake libgsl-dev zlib1g-dev\n"


def test_without_root_only_what_is_missing_is_named(machine):
    ran = machine("install_debian_packages cmake libgsl-dev; echo went on", "apt-get", id="echo 1000",
                  dpkg_query='[ "${@: -1}" != cmake ] || echo -n installed')
    assert (ran.returncode, ran.stdout) == (0, "went on\n")
    assert ran.stderr.splitlines() == ["Neither root nor sudo here. Expected to be installed, and missing as Debian packages: libgsl-dev"]


def test_with_sudo_it_is_used(machine):
    ran = machine("install_debian_packages libgsl-dev", id="echo 1000", dpkg_query="exit 1", apt_get="exit 1", sudo='echo "sudo $*" >&2')
    assert ran.returncode == 0
    assert [line for line in ran.stderr.splitlines() if "install -y" in line and line.endswith(" libgsl-dev")], ran.stderr


def test_a_missing_program_ends_it_in_one_line(machine):
    ran = machine("need_programs cmake ninja mpirun; echo went on", "cmake", "mpirun")
    assert (ran.returncode, ran.stdout) == (1, "")
    assert ran.stderr == "Not found: ninja; see above for what is expected\n"


@pytest.mark.parametrize("candidate, library", [("20250204+dfsg.1-2", "/usr/lib/any/liblammps.so"), ("20220106.git7586adbb6a+ds1-2", "")])
def test_debians_lammps_is_taken_where_it_is_the_reference(machine, candidate, library):
    # More than a pipe holds: a reader that stops at the candidate would end it with an error.
    policy = f"echo '  Candidate: {candidate}'; printf '%999999s\\n' versions"
    ran = machine('debian_lammps; echo "library=$lammps_library"', "apt-get", apt_cache=policy,
                  dpkg_query='case $1 in -W) echo -n installed ;; -L) printf "/usr/include\\n/usr/lib/any/liblammps.so\\n" ;; esac')
    assert (ran.returncode, ran.stdout) == (0, f"library={library}\n"), ran.stderr


@pytest.mark.parametrize("command", ["inputs/first-catalogue.sh", "tests/run-all.sh"])
def test_a_command_without_its_tools_says_so(work, command):
    folder = work / "bin"
    folder.mkdir()
    for name in ("bash", "dirname", "cat"):
        os.symlink(f"/usr/bin/{name}", folder / name)
    ran = subprocess.run(["/bin/bash", SOURCE / command], env={"PATH": str(folder), "LSM_BUILD_DIR": str(work / "build")}, capture_output=True,
                         text=True)
    assert ran.returncode == 1
    expected, missing = ran.stderr.splitlines()
    assert expected.startswith("No apt here.") and " cmake " in expected and missing.startswith("Not found: cmake ninja c++ mpirun")
    assert not (work / "build").exists()
