# SPDX-License-Identifier: GPL-2.0-or-later
"""The commands of the README on machines without apt or without root. PATH is a folder of dummy programs."""
import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest

from programs import SOURCE, Program, refused, run, snapshot, start

PACKAGES = SOURCE / "lammps-pkg/cmake/debian-packages.sh"


@pytest.fixture
def machine(work):
    """machine(LINE, NAME, ...): runs a line of bash after debian-packages.sh, with only these programs and a few of coreutils."""
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


@pytest.mark.parametrize("candidate, library", [("20250204+dfsg.1-2", "/usr/lib/any/liblammps.so"), ("20220106.git7586adbb6a+ds1-2", "")])
def test_debians_lammps_is_taken_where_it_is_the_reference(machine, candidate, library):
    # The output exceeds the capacity of a pipe: a reader that stopped at the candidate would end apt-cache with an error.
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


def test_a_configuration_that_failed_is_repeated(work):
    """For example after a network failure: what is there then is no build folder yet."""
    if not shutil.which("cmake") or not shutil.which("ninja"):
        pytest.skip("no cmake, or no ninja")
    (work / "source").mkdir()
    (work / "source/CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.16)\nproject(p NONE)\n"
                                                "if(NOT EXISTS ${PROJECT_SOURCE_DIR}/there)\n  message(FATAL_ERROR missing)\nendif()\n")
    there = "install_debian_packages() { :; }; need_programs() { :; }; debian_lammps() { lammps_library=; }"
    line = f"set -eu; . {PACKAGES}; {there}; configure_programs source build"
    assert subprocess.run(["bash", "-c", line], capture_output=True).returncode != 0
    assert Path("build/CMakeCache.txt").exists() and not Path("build/build.ninja").exists()
    (work / "source/there").touch()
    assert subprocess.run(["bash", "-c", line], capture_output=True).returncode == 0
    assert Path("build/build.ninja").exists()
    # An existing build folder is left alone.
    (work / "source/there").unlink()
    assert subprocess.run(["bash", "-c", line], capture_output=True).returncode == 0


def test_a_build_folder_of_others_is_refused(work):
    """Its build.ninja would silently build another checkout."""
    for name in "source", "other", "build":
        (work / name).mkdir()
    there = "install_debian_packages() { :; }; need_programs() { :; }; debian_lammps() { :; }; cmake() { echo called; }"
    configure = Program("bash", "bash", "-c", f"set -eu; . {PACKAGES}; {there}; build_programs source build lmp")
    cache = f"CMAKE_CACHEFILE_DIR:INTERNAL={work}/build\nCMAKE_HOME_DIRECTORY:INTERNAL={work}/source\n"
    Path("build/build.ninja").touch()
    Path("build/CMakeCache.txt").write_text(cache)
    run(configure)
    configure.errors_begin = "build is a build folder for "
    for name, said in ("source", f"{work}/other, expected one of source"), ("build", f"{work}/moved, expected one of source"):
        Path("build/CMakeCache.txt").write_text(cache.replace(f"{work}/{name}", said.split(",")[0]))
        refused(configure, "", said)
    Path("build/CMakeCache.txt").write_text(cache)
    if os.getuid() != 0 or not shutil.which("setpriv"):
        return
    work.chmod(0o755)
    shutil.copy(PACKAGES, "packages.sh")
    line = f"set -eu; . ./packages.sh; {there}; build_programs source build lmp"
    other = Program("bash", "setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "bash", "-c", line)
    other.errors_begin = "cannot write to build"
    refused(other, "", "which is of root, expected a folder of one user")


@pytest.fixture
def building(work):
    """The same before anything is built: a dummy package manager and compiler, which wait while there is a file NAME.wait."""
    folder = work / "tools"
    folder.mkdir()
    alone = f"mkdir {work}/busy || echo $0 >>{work}/two; trap 'rmdir {work}/busy' EXIT; trap exit INT"
    wait = "echo $$ >>{0}.begun; while [ -e {0}.wait ]; do sleep 0.02; done"
    configure = "if [ $1 = -S ]; then mkdir -p $4; touch $4/build.ninja; exit; fi"
    for name, script in (("apt-get", f"{alone}; {wait.format(work / 'apt-get')}; touch {work}/installed"),
                         ("dpkg-query", f"[ ! -e {work}/installed ] || echo -n installed"), ("apt-cache", "exit 0"), ("id", "echo 0"), ("ninja", ""),
                         ("gnuplot", ""), ("cmake", f"{configure}; {alone}; {wait.format(work / 'cmake')}; mkdir -p $2/bin; cp {work}/bin/* $2/bin")):
        (folder / name).write_text(f"#!/bin/bash\n{script}\n")
        (folder / name).chmod(0o755)
    return {"LSM_BIN": "", "LSM_BUILD_DIR": str(work / "build"), "PATH": f"{folder}:{work}/bin:{os.environ['PATH']}"}


@pytest.mark.parametrize("tool, by", [("apt-get", signal.SIGKILL), ("cmake", signal.SIGTERM), ("cmake", signal.SIGINT)])
def test_first_catalogue_interrupted_while_programs_are_made(first, building, tool, by):
    """It waits for programs that still run, as two compilers must not write the same files, and package managers must not overlap."""
    Path(f"{tool}.wait").touch()
    with start(first, env=building, start_new_session=True) as child:
        assert child.until(lambda: Path(f"{tool}.begun").exists() and Path(f"{tool}.begun").read_text())
        (os.killpg if by == signal.SIGINT else os.kill)(child.pid, by)
        child.wait(60)
    with start(first, env=building) as child:
        if by != signal.SIGINT:
            assert child.until(lambda: "Waiting until another start has built the programs" in child.said())
        Path(f"{tool}.wait").unlink()
        assert child.wait(60) == 0, child.said()
    assert not Path("two").exists() and Path("out/first.explore").exists()


@pytest.fixture
def first(work):
    """first-catalogue.sh with dummy programs, each of which waits at its beginning while there is a file NAME.wait."""
    folder = work / "bin"
    folder.mkdir()
    events = "\\n".join(f"{k},{k}.0,{k}.5,1,2,0.1,1,0" for k in range(1, 101))
    columns = "event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end"
    wait = 'trap "trap - INT; kill -INT \\$\\$" INT; echo $$ >{0}.begun; while [ -e {0}.wait ]; do sleep 0.02; done'
    for name, script in (("mpirun", 'exec "${@:3}"'), ("lmp", f"{wait.format(work / 'lmp')}; printf '{columns}\\n{events}\\n' >first.catalogue.csv; "
                                                       "echo series >first.pe.bin"), ("postproc",
                                                                                      wait.format(work / "postproc") + "; echo figure >first.$1")):
        (folder / name).write_text(f"#!/bin/bash\n{script}\n")
        (folder / name).chmod(0o755)
    shutil.copy(folder / "lmp", folder / "lmp_fault")
    return Program("first-catalogue.sh", SOURCE / "inputs/first-catalogue.sh", 100,
                   env={"PATH": f"{folder}:{os.environ['PATH']}", "LSM_BIN": str(folder), "LSM_OUTPUT": str(work / "out")})


def test_first_catalogue_again(first):
    run(first)
    files = snapshot("out")
    run(first).printed("^100 events. The ten largest:")
    assert snapshot("out") == files and "out/first.explore" in files


def test_first_catalogue_removes_what_it_made_only(first):
    Path("out").mkdir()
    Path("out/first.notes").write_text("of somebody\n")
    refused(first, "", r"out holds first\.notes, which this script did not write, expected another folder \(LSM_OUTPUT\)")
    Path("out/first.notes").rename("out/second.notes")
    run(first)
    assert Path("out/second.notes").read_text() == "of somebody\n"


def await_end(process):
    """Waits until a process holds no lock any more; it may remain as a zombie."""
    for _ in range(3000):
        try:
            if Path(f"/proc/{process}/stat").read_text().rpartition(") ")[2].startswith("Z"):
                return
        except (FileNotFoundError, ProcessLookupError):
            return
        time.sleep(0.02)
    raise AssertionError(f"process {process} does not end")


@pytest.mark.parametrize("program, by", [("lmp", signal.SIGKILL), ("postproc", signal.SIGTERM), ("lmp", signal.SIGINT)])
def test_first_catalogue_interrupted(first, work, program, by):
    """It starts again, unless the interrupted one is still running: then it says so and removes nothing."""
    Path(f"{program}.wait").touch()
    with start(first, start_new_session=True) as child:
        assert child.until(lambda: Path(f"{program}.begun").exists() and Path(f"{program}.begun").read_text())
        refused(first, "", "a first-catalogue.sh works in .*/out already, expected its end or another folder", but="begun$")
        (os.killpg if by == signal.SIGINT else os.kill)(child.pid, by)
        child.wait(60)
    at_work = int(Path(f"{program}.begun").read_text())
    if program == "lmp":  # a run ends with the script that began it
        await_end(at_work)
    Path(f"{program}.wait").unlink()
    await_end(at_work)  # postproc outlives the script and holds its lock
    run(first).printed("^100 events. The ten largest:")
    assert Path("out/first.explore").exists()
