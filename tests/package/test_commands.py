# SPDX-License-Identifier: GPL-2.0-or-later
"""The commands of the README on machines without apt or without root. PATH is a folder of dummy programs."""
import os
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest

from programs import SOURCE, Program, refused, run, snapshot, start

PACKAGES = SOURCE / "lammps-pkg/cmake/debian-packages.sh"


def dummies(folder, scripts):
    """Makes a folder of programs, each of which is a script."""
    folder.mkdir(exist_ok=True)
    for name, script in scripts.items():
        (folder / name).write_text(f"#!/bin/bash\n{script}\n")
        (folder / name).chmod(0o755)
    return folder


def only(folder, *programs):
    """Adds a few programs of coreutils that have no dummy."""
    for name in programs:
        if not (folder / name).exists():
            os.symlink(f"/usr/bin/{name}", folder / name)
    return {"PATH": str(folder)}


# A candidate exceeds the capacity of a pipe: a reader that stopped at it would end apt-cache with an error.
DEBIAN = {"apt-get": "exit 0", "dpkg-query": 'case $1 in -W) echo -n installed ;; -L) printf "/usr/include\\n/usr/lib/any/liblammps.so\\n" ;; esac'}


@pytest.mark.parametrize("line, scripts, out, err", [
    ("install_debian_packages cmake libgsl-dev; echo went on", {}, "went on\n",
     "^No apt here. Expected to be installed, by their names in Debian: cmake libgsl-dev\n$"),
    ("install_debian_packages cmake libgsl-dev; echo went on",
     {"apt-get": "exit 0", "id": "echo 1000", "dpkg-query": '[ "${@: -1}" != cmake ] || echo -n installed'}, "went on\n",
     "^Neither root nor sudo here. Expected to be installed, and missing as Debian packages: libgsl-dev\n$"),
    ("install_debian_packages libgsl-dev >&2",
     {"apt-get": "exit 1", "id": "echo 1000", "dpkg-query": "exit 1", "sudo": 'echo "sudo $*" >&2'}, "", r"sudo .* install -y .* libgsl-dev\n"),
    *(("debian_lammps; echo library=$lammps_library", {**DEBIAN, "apt-cache": f"echo '  Candidate: {version}'; printf '%999999s\\n' versions"},
       f"library={library}\n", "^$") for version, library in (("20250204+dfsg.1-2", "/usr/lib/any/liblammps.so"),
                                                              ("20220106.git7586adbb6a+ds1-2", "")))])  # yapf: disable
def test_packages_of_debian(work, line, scripts, out, err):
    path = only(dummies(work / "bin", scripts), "bash", "env", "grep", "id", "cat")
    ran = subprocess.run(["/bin/bash", "-c", f"set -euo pipefail; . {PACKAGES}; {line}"], env=path, capture_output=True, text=True)
    assert (ran.returncode, ran.stdout) == (0, out) and re.search(err, ran.stderr), ran


@pytest.mark.parametrize("command", ["inputs/first-catalogue.sh", "tests/run-all.sh"])
def test_a_command_without_its_tools_says_so(work, command):
    path = only(dummies(work / "bin", {}), "bash", "dirname", "cat")
    ran = subprocess.run(["/bin/bash", SOURCE / command], env={**path, "LSM_BUILD_DIR": str(work / "build")}, capture_output=True, text=True)
    assert ran.returncode == 1
    expected, missing = ran.stderr.splitlines()
    assert expected.startswith("No apt here.") and " cmake " in expected and missing.startswith("Not found: cmake ninja c++ mpirun")
    assert not (work / "build").exists()


THERE = "install_debian_packages() { :; }; need_programs() { :; }; debian_lammps() { lammps_library=; }"


def test_a_configuration_that_failed_is_repeated(work):
    """For example after a network failure: what is there then is no build folder yet."""
    if not shutil.which("cmake") or not shutil.which("ninja"):
        pytest.skip("no cmake, or no ninja")
    (work / "source").mkdir()
    (work / "source/CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.16)\nproject(p NONE)\n"
                                                "if(NOT EXISTS ${PROJECT_SOURCE_DIR}/there)\n  message(FATAL_ERROR missing)\nendif()\n")
    configure = Program("bash", "bash", "-c", f"set -eu; . {PACKAGES}; {THERE}; configure_programs source build")
    assert run(configure, status=None).status != 0
    assert Path("build/CMakeCache.txt").exists() and not Path("build/build.ninja").exists()
    (work / "source/there").touch()
    run(configure)
    assert Path("build/build.ninja").exists()
    # An existing build folder is left alone.
    (work / "source/there").unlink()
    run(configure)


def test_a_build_folder_of_others_is_refused(work):
    """Its build.ninja would silently build another checkout."""
    for name in "source", "other", "build":
        (work / name).mkdir()
    line = f"set -eu; . ./packages.sh; {THERE}; cmake() {{ echo called; }}; build_programs source build lmp"
    shutil.copy(PACKAGES, "packages.sh")
    configure = Program("bash", "bash", "-c", line)
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
    other = Program("bash", "setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "bash", "-c", line)
    other.errors_begin = "cannot write to build"
    refused(other, "", "which is of root, expected a folder of one user")


def waits(name, more=""):
    """Words of a script that says that it has begun, and waits while there is a file NAME.wait."""
    return f"{more}echo $$ >>{name}.begun; while [ -e {name}.wait ]; do sleep 0.02; done"


@pytest.fixture
def first(work):
    """first-catalogue.sh with dummy programs, each of which may wait at its beginning."""
    events = "\\n".join(f"{k},{k}.0,{k}.5,1,2,0.1,1,0" for k in range(1, 101))
    columns = "event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end"
    by_int = 'trap "trap - INT; kill -INT \\$\\$" INT; '
    lmp = f"{waits(work / 'lmp', by_int)}; printf '{columns}\\n{events}\\n' >first.catalogue.csv; echo series >first.pe.bin"
    postproc = waits(work / "postproc", by_int) + "; echo figure >first.$1"
    folder = dummies(work / "bin", {"mpirun": 'exec "${@:3}"', "lmp": lmp, "lmp_fault": lmp, "postproc": postproc})
    return Program("first-catalogue.sh", SOURCE / "inputs/first-catalogue.sh", 100,
                   env={"PATH": f"{folder}:{os.environ['PATH']}", "LSM_BIN": str(folder), "LSM_OUTPUT": str(work / "out")})


@pytest.fixture
def building(work):
    """The same before anything is built: a dummy package manager and compiler, which may wait."""
    alone = f"mkdir {work}/busy || echo $0 >>{work}/two; trap 'rmdir {work}/busy' EXIT; trap exit INT; "
    configure = "if [ $1 = -S ]; then mkdir -p $4; touch $4/build.ninja; exit; fi; "
    folder = dummies(
        work / "tools", {
            "apt-get": f"{waits(work / 'apt-get', alone)}; touch {work}/installed", "dpkg-query": f"[ ! -e {work}/installed ] || echo -n installed",
            "apt-cache": "exit 0", "id": "echo 0", "ninja": "", "gnuplot": "",
            "cmake": f"{configure}{waits(work / 'cmake', alone)}; mkdir -p $2/bin; cp {work}/bin/* $2/bin"
        })
    return {"LSM_BIN": "", "LSM_BUILD_DIR": str(work / "build"), "PATH": f"{folder}:{work}/bin:{os.environ['PATH']}"}


def begun(name):
    """Whether the program that waits has begun; its number."""
    return Path(f"{name}.begun").exists() and Path(f"{name}.begun").read_text()


def end(child, by):
    """Sends a signal, as a terminal does if it is an interrupt."""
    (os.killpg if by == signal.SIGINT else os.kill)(child.pid, by)
    child.wait(60)


@pytest.mark.parametrize("tool, by", [("apt-get", signal.SIGKILL), ("cmake", signal.SIGTERM), ("cmake", signal.SIGINT)])
def test_first_catalogue_interrupted_while_programs_are_made(first, building, tool, by):
    """It waits for programs that still run, as two compilers must not write the same files, and package managers must not overlap."""
    Path(f"{tool}.wait").touch()
    with start(first, env=building, start_new_session=True) as child:
        assert child.until(lambda: begun(tool))
        end(child, by)
    with start(first, env=building) as child:
        if by != signal.SIGINT:
            assert child.until(lambda: "Waiting until another start has built the programs" in child.said())
        Path(f"{tool}.wait").unlink()
        assert child.wait(60) == 0, child.said()
    assert not Path("two").exists() and Path("out/first.explore").exists()


def test_first_catalogue_again(first):
    """It replaces what it made, and removes nothing else."""
    Path("out").mkdir()
    Path("out/first.notes").write_text("of somebody\n")
    refused(first, "", r"out holds first\.notes, which this script did not write, expected another folder \(LSM_OUTPUT\)")
    Path("out/first.notes").rename("out/second.notes")
    run(first)
    files = snapshot("out")
    run(first).printed("^100 events. The ten largest:")
    assert snapshot("out") == files and {"out/first.explore", "out/second.notes"} <= set(files)


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
def test_first_catalogue_interrupted(first, program, by):
    """It starts again, unless the interrupted one is still running: then it says so and removes nothing."""
    Path(f"{program}.wait").touch()
    with start(first, start_new_session=True) as child:
        assert child.until(lambda: begun(program))
        refused(first, "", "a first-catalogue.sh works in .*/out already, expected its end or another folder", but="begun$")
        end(child, by)
    at_work = int(begun(program).split()[0])
    if program == "lmp":  # a run ends with the script that began it
        await_end(at_work)
    Path(f"{program}.wait").unlink()
    await_end(at_work)  # postproc outlives the script and holds its lock
    run(first).printed("^100 events. The ten largest:")
    assert Path("out/first.explore").exists()
