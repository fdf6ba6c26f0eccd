#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Builds and runs the package with other versions of LAMMPS, compilers and integers, and in each way it can be used, and
compares a short fault with the reference, byte by byte. README.md in this folder tells what each column does.

Columns run in the given order; those with a fault, except in a Debian of its own, need the reference done before; debian-* need
root. LSM_LAMMPS_CACHE is used as by the build; default FOLDER/cache. LSM_MATRIX_FLAGS are the flags for LAMMPS' own sources in all
columns but the reference (default -O1). LSM_MATRIX_CTEST are arguments for ctest in debian-*-tests, such as -L unit. Each row is
written into FOLDER and into README.md under "Last run".
"""
import argparse
import datetime
import filecmp
import os
import re
import resource
import shlex
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent.parent / "inputs")]
from programs import INPUTS, SOURCE, Program, run, scene  # noqa: E402
from run import MPI  # noqa: E402

HEAD = "| column | LAMMPS | compiler | integers | build | tests | fault beside the reference | date |\n|---|---|---|---|---|---|---|---|\n"
HOURS = 24 * 3600  # no step takes as long
FLAGS = f"-DCMAKE_CXX_FLAGS_RELEASE={os.environ.get('LSM_MATRIX_FLAGS', '-O1')} -DNDEBUG"
CTEST = os.environ.get("LSM_MATRIX_CTEST", "")
# The fault of every column: short, fast plates, with events, energies and the places of events.
SCENE = dict(preset="absorbing", length=30, width=16, seed=3, settle=2000, steps=6000, checkpoint=3000, velocity=0.01, thermo=3000, location="yes",
             ledger="yes")
LIBRARIES = ("libgsl-dev libfftw3-dev libfmt-dev liblzma-dev libexpat1-dev libcli11-dev nlohmann-json3-dev libhowardhinnant-date-dev "
             "libjs-dygraphs")
# Runs on ARM and on this machine. Positions of ruptures depend on sines and logarithms of the C library.
SLIDERS = {
    "verlet": "--time 9000", "printed": "--scheme printed --dt 0.01 --time 7000", "coulomb": "--law coulomb --time 6000",
    "ruptures": "--events ruptures --columns centroid,length --time 6000", "leaps": "--velocity 1e-4 --leap 1e-3 --time 1e6",
    "long": "--blocks 20000 --time 80 --velocity 1"
}
POSTPROCS = ("histograms {one} {chain} --no-picture -o o", "intervals {one} {chain} --replicas 2 --no-picture -o o",
             "intervals {chain} --method likelihood --replicas 2 --no-picture -o o", "fit {one} --range 1e-4:0.1 --replicas 2 --no-picture -o o",
             "magnitudes {one} --no-picture -o o", "count {one}", "compare {one} {chain} --replicas 10 -o o", "series {series} --no-picture -o o",
             "pick {series} -o o.csv", "select {one} --min-size 1e-3 -o o.csv")

COLUMNS = {}


class Failure(Exception):
    """A column that cannot go on; the message says why."""


class Row:
    """Cells of a row, and whether the column passed. Default: what most columns have."""

    def __init__(self, lammps="4 Feb 2025", compiler=None, integers="smallbig", build="no warning", tests="-", fault="-", ok=True):
        self.cells, self.ok = [lammps, compiler or compiler_of("g++"), integers, build, tests, fault], ok

    def text(self, name):
        return f"| {' | '.join([name, *self.cells, datetime.date.today().isoformat()])} |\n"


def column(*names):

    def add(function):
        COLUMNS.update((name, function) for name in names)
        return function

    return add


def command(*line, log=None, append=False, status=0, **more):
    """Runs a command; what it prints goes to the log. Fails with its last lines unless it ends with that status (None: any)."""
    log = log or FOLDER / "command.log"
    with open(log, "a" if append else "w") as out:
        begun = out.tell()
        done = subprocess.run([str(word) for word in line], stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, **more).returncode
    if status is not None and done != status:
        text = log.read_text(errors="replace")[begun:]
        raise Failure("\n".join([*text.splitlines()[-30:], f"{shlex.join(map(str, line))} ended with {done}, expected {status}: {log}"]))
    return done


def compiler_of(program):
    return run(Program(program, program), "--version").out.splitlines()[0]


def install(*packages):
    subprocess.run([
        "bash", "-euc", '. "$1"; shift; install_debian_packages $lammps_packages "$@"', "install", SOURCE / "lammps-pkg/cmake/debian-packages.sh",
        *packages
    ], check=True)


def configure(name, *options):
    command("cmake", "-S", SOURCE, "-B", FOLDER / name, "-G", "Ninja", "-DLSM_BUILD_SLIDER=OFF", "-DLSM_BUILD_POSTPROC=OFF", *options,
            log=FOLDER / f"{name}.configure.log")


def refuse_warnings(log, pattern):
    found = [line for line in log.read_text(errors="replace").splitlines() if re.search(pattern, line)]
    if found:
        raise Failure("\n".join(found))


def build(name, *targets):
    """Appends to the log, so that no warning is lost if only a part is built again."""
    log = FOLDER / f"{name}.build.log"
    command("cmake", "--build", FOLDER / name, "--parallel", JOBS, "--target", *targets, log=log, append=True)
    refuse_warnings(log, f"^{re.escape(str(SOURCE))}/(lammps-pkg|slider|postproc|tests)/.*warning:")


def counted(log):
    """The summary of ctest, in words."""
    found = re.search(r"^\d+% tests passed, (\d+) tests failed out of (\d+)", log.read_text(errors="replace"), re.M)
    return f"{found[2]} run, {found[1]} failed" if found else "no tests"


def run_tests(name, pattern, log=None, but=None, **env):
    """How many passed, in words, and whether all did."""
    log = FOLDER / f"{log or name}.tests.log"
    status = command("ctest", "--test-dir", FOLDER / name, "-R", pattern, *(["-E", but] if but else []), "--no-tests=error", "--output-on-failure",
                     "--repeat", "after-timeout:3", log=log, status=None, env={**os.environ, **env})
    return counted(log), status == 0


def run_fault(name, lmp, plugin=None):
    """On 1 and 2 ranks, in FOLDER/NAME/fault."""
    at = FOLDER / name / "fault"
    shutil.rmtree(at, ignore_errors=True)
    at.mkdir(parents=True)
    (at / "in.fault").write_text((f"plugin load {plugin}\n" if plugin else "") + f"include {INPUTS}/fault_120.in\n")
    for ranks in 1, 2:
        words = scene("fault_120.in", **SCENE, prefix=f"on_{ranks}")
        command(HERE.parent / "mpirun.sh", "-np", ranks, lmp, "-in", "in.fault", "-log", "none", *words[2:], log=at / f"out_{ranks}.txt", cwd=at,
                env={**os.environ, **MPI})


def compare_fault(name, other="reference"):
    """What a fault has in common with that of another column, in words, and whether all bytes are the same."""
    words = []
    for ranks in 1, 2:
        ours, theirs = (FOLDER / one / "fault" / f"on_{ranks}" for one in (name, other))
        events = len(re.findall(r"(?m)^[^#e]", Path(f"{ours}.catalogue.csv").read_text()))
        if events < 5:
            return f"FAILED: {events} events on {ranks} ranks say nothing", False
        # The headers name the version of LAMMPS.
        differ = [
            ending for ending in ("catalogue.csv", "pe.bin")
            if Path(f"{ours}.{ending}").read_bytes().replace(b"LAMMPS 4 Jul 2026", b"LAMMPS 4 Feb 2025") != Path(f"{theirs}.{ending}").read_bytes()
        ]
        words.append(f"{ranks} rank{'s' if ranks > 1 else ''}: {events} events, " + (" and ".join(differ) + " differ" if differ else "same bytes"))
    return "; ".join(words), "differ" not in "".join(words)


def whole(name, *options, targets=None, **cells):
    """Project, tests and fault."""
    configure(name, *options)
    if targets is None:
        build(name, "all")
        tests, ok = run_tests(name, r"^(unit|physics|package)\.")
        tests = f"unit, physics, package: {tests}"
    else:
        # Unit tests do not depend on LAMMPS; those of physics start the program of this column.
        build(name, *targets)
        tests, ok = run_tests(name, r"^(package\.|physics\.library)")
        at = FOLDER / name
        physics, good = run_tests("reference", r"^physics\.[A-Z]", f"{name}.physics", LSM_LMP=f"{at}/bin/lmp",
                                  LSM_FOREIGN_FIX=f"{at}/lib/lsm_foreign_fix.so")
        tests, ok = f"package, library: {tests}; physics: {physics}", ok and good
    run_fault(name, FOLDER / name / "bin/lmp")
    fault, same = compare_fault(name)
    return Row(tests=tests, fault=fault, ok=ok and same, **cells)


PROGRAMS = ("lmp", "lsmplugin", "lsmplugin_other_integers", "lammps_shared", "lsm_library_errors", "lsm_foreign_fix")


@column("reference")
def reference(name):
    return whole(name)


@column("clang")
def clang(name):
    return whole(name, "-DCMAKE_CXX_COMPILER=clang++", f"-DLSM_LAMMPS_OPTIONS={FLAGS}", compiler=compiler_of("clang++"))


@column("bigbig")
def bigbig(name):
    return whole(name, "-DLSM_LAMMPS_SIZES=bigbig", f"-DLSM_LAMMPS_OPTIONS={FLAGS}", targets=PROGRAMS, integers="bigbig")


@column("jul2026")
def jul2026(name):
    return whole(name, "-DLSM_LAMMPS_VERSION=4 Jul 2026", f"-DLSM_LAMMPS_OPTIONS={FLAGS}", targets=PROGRAMS, lammps="4 Jul 2026")


@column("plugin")
def plugin(name):
    stock = re.search(r"^LSM_STOCK_LMP:INTERNAL=(.*)", (FOLDER / "reference/CMakeCache.txt").read_text(), re.M)[1]
    if "lsm/" in run(Program("lmp", stock, env=MPI), "-h").out:
        raise Failure("the stock lmp has the styles already")
    run_fault(name, stock, FOLDER / "reference/lib/lsmplugin.so")
    fault, same = compare_fault(name)
    return Row("4 Feb 2025, stock lmp", build="that of the reference", tests="those of the reference (package.plugin)", fault=fault, ok=same)


@column("installed")
def installed(name):
    """The package is installed into a copy of the source; LAMMPS' own CMake builds the program, with warnings shown."""
    tree, at, log = FOLDER / "installed-lammps", FOLDER / name, FOLDER / "installed.build.log"
    if not tree.is_dir():
        part = FOLDER / "installed-lammps.part"
        shutil.rmtree(part, ignore_errors=True)
        # Links are copied as they are, as one of them, in an example, is dangling.
        shutil.copytree(CACHE / "lammps-4Feb2025", part, symlinks=True)
        part.rename(tree)
    command(SOURCE / "lammps-pkg/install-into-lammps.sh", tree, log=FOLDER / "installed.configure.log")
    off = ("BUILD_OMP", "WITH_JPEG", "WITH_FFMPEG", "DOWNLOAD_POTENTIALS")
    command("cmake", "-S", tree / "cmake", "-B", at, "-G", "Ninja", f"-DCMAKE_PROJECT_INCLUDE={SOURCE}/lammps-pkg/cmake/PrecompileLammps.cmake",
            "-DCMAKE_BUILD_TYPE=Release", FLAGS, "-DCMAKE_CXX_FLAGS=-ffp-contract=off -fno-math-errno -Wall -Wextra",
            *(f"-DPKG_{one}=on" for one in ("LSM", "MOLECULE", "GRANULAR", "BPM")), *(f"-D{one}=off" for one in off),
            log=FOLDER / "installed.configure.log", append=True)
    command("cmake", "--build", at, "--parallel", JOBS, log=log, append=True)
    refuse_warnings(log, "src/LSM/.*warning:")
    if not re.search(r"\bLSM\b", run(Program("lmp", at / "lmp", env=MPI), "-h").out):
        raise Failure("lmp -h does not name the package")
    run_fault(name, at / "lmp")
    fault, same = compare_fault(name)
    return Row("4 Feb 2025, package copied into its tree", build="full link, no warning", tests="none: LAMMPS' own build", fault=fault, ok=same)


@column("testers", "testers-jul2026")
def testers(name):
    """LAMMPS' own testers, from the source of its version."""
    base, version, tarball = (("reference", "4 Feb 2025", "lammps-4Feb2025.tar.xz") if name == "testers" else
                              ("jul2026", "4 Jul 2026", "lammps-4Jul2026.tar.gz"))
    if not (CACHE / tarball).is_file():
        raise Failure(f"no {tarball} in {CACHE}: it holds the testers")
    at = FOLDER / f"unittest-{base}"
    if not (at / "force-styles").is_dir():
        part = FOLDER / f"unittest-{base}.part"
        shutil.rmtree(part, ignore_errors=True)
        part.mkdir()
        command("tar", "-xf", CACHE / tarball, "-C", part, "--wildcards", "*unittest/*")
        next(path for path in (part / "unittest", *part.glob("*/unittest")) if path.is_dir()).rename(at)
        shutil.rmtree(part)
    configure(base, f"-DLSM_LAMMPS_UNITTEST={at}")
    build(base, "test_bond_style", "test_pair_style", "test_fix_timestep")
    tests, ok = run_tests(base, r"^force-styles\.", name)
    return Row(f"{version}, its own testers of styles", tests=tests, ok=ok)


def arm_libraries(at):
    """Installs the libraries of 64-bit ARM in a folder, with an apt that is independent of this system: some could not be installed
    next to those of the system. Absolute links would lead out of the folder."""
    if at.is_dir():
        return
    apt, part = at.with_suffix(".apt"), at.with_suffix(".part")
    for needed in "state/lists/partial", "cache/archives/partial":
        (apt / needed).mkdir(parents=True, exist_ok=True)
    (apt / "status").touch()
    options = ("APT::Architecture=arm64", "APT::Architectures=arm64", "APT::Install-Recommends=0", "Debug::NoLocking=1", f"Dir::State={apt}/state",
               f"Dir::State::status={apt}/status", f"Dir::Cache={apt}/cache")
    words = ["apt-get", "-q", "-q", "-y", *(word for option in options for word in ("-o", option))]
    command(*words, "update")
    command(*words, "--download-only", "install", "zlib1g-dev", "libgtest-dev", "libgmock-dev", *LIBRARIES.split())
    shutil.rmtree(part, ignore_errors=True)
    for package in sorted((apt / "cache/archives").glob("*.deb")):
        command("dpkg-deb", "-x", package, part)
    for link in part.rglob("*"):
        if link.is_symlink() and os.readlink(link).startswith("/"):
            target = os.path.relpath(f"{part}{os.readlink(link)}", link.parent)
            link.unlink()
            link.symlink_to(target)
    part.rename(at)


def largest_difference(a, b):
    """Largest relative difference of the numbers in two texts; "text" if anything else differs."""
    number = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
    a, b = (path.read_text(errors="replace") for path in (a, b))
    if re.sub(number, "0", a).split() != re.sub(number, "0", b).split():
        return "text"
    pairs = zip(map(float, re.findall(number, a)), map(float, re.findall(number, b)))
    return f"{max(abs(x - y) / max(abs(x), abs(y), 1e-300) for x, y in pairs):.1e}"


def compare_runs(ours, theirs, at, lines):
    """Runs two programs with the same arguments, each in FOLDER/NUMBER. Returns the number of files with the same bytes, and the others."""
    shutil.rmtree(at, ignore_errors=True)
    same, other = 0, []
    for number, line in enumerate(lines):
        for side, path in (("ours", ours), ("theirs", theirs)):
            folder = at / side / str(number)
            folder.mkdir(parents=True)
            (folder / "out").write_text(run(Program(path.name, path), line, cwd=folder, timeout=HOURS).out)
        for file in sorted(folder.iterdir()):
            mine = at / "ours" / str(number) / file.name
            if mine.exists() and filecmp.cmp(mine, file, shallow=False):
                same += 1
            else:
                other.append((line.split()[0], mine, file))
    return same, other


def run_pytest(file, expression, **env):
    """Tests of the programs given in the environment, in words."""
    log = FOLDER / "aarch64.pytest.log"
    status = command("/usr/bin/python3", "-m", "pytest", "-q", SOURCE / "tests" / file, "-k", expression, log=log, append=True, status=None,
                     env={**os.environ, **env})
    return f"{Path(file).name}: {log.read_text().splitlines()[-1].split(' in ')[0]}", status == 0


@column("aarch64")
def aarch64(name):
    """Without LAMMPS."""
    install("g++-aarch64-linux-gnu", "qemu-user", *LIBRARIES.split())
    on = ("-DLSM_BUILD_LAMMPS=OFF", "-DLSM_BUILD_SLIDER=ON", "-DLSM_BUILD_POSTPROC=ON")
    libraries = FOLDER / "aarch64-libraries"
    os.environ["LSM_ARM_SYSROOT"] = str(libraries)
    arm_libraries(libraries)
    configure("aarch64-native", *on, "-DLSM_BUILD_TESTS=OFF")
    build("aarch64-native", "slider_cli", "postproc")
    configure(name, f"-DCMAKE_TOOLCHAIN_FILE={HERE}/aarch64.cmake", *on)
    build(name, "slider_cli", "postproc", "lsm_unit_tests", "lsm_slider_tests", "lsm_postproc_tests")
    native, arm = FOLDER / "aarch64-native/bin", FOLDER / name / "by-qemu"
    arm.mkdir(exist_ok=True)
    for program in "slider_cli", "postproc":
        (arm / program).write_text(f'#!/bin/sh\nexec qemu-aarch64 -L "{libraries}" "{FOLDER}/{name}/bin/{program}" "$@"\n')
        (arm / program).chmod(0o755)
    # Only the faster tests: others take many minutes.
    parts = [
        run_tests(name, r"^(unit|postproc\.[A-Z]|SliderParameters|SliderKernels\.(OtherLaws|ActiveSet|InstructionSets))"),
        run_pytest("slider/test_slider_cli.py", "header or paper or config or bad", LSM_SLIDER_CLI=f"{arm}/slider_cli"),
        run_pytest("postproc/test_postproc_cli.py", "not pictures and not faults and not progress", LSM_POSTPROC=f"{arm}/postproc",
                   LSM_SLIDER_CLI=f"{arm}/slider_cli")
    ]
    sliders = [
        f"--blocks 100 --velocity 0.02 --warmup 0 --pe-stride 20 {words} --catalogue {run_name}.csv --pe-series {run_name}.pe --checkpoint {run_name}.chk"
        for run_name, words in SLIDERS.items()
    ]
    same, other = compare_runs(arm / "slider_cli", native / "slider_cli", FOLDER / name / "sliders", sliders)
    other = [file for _, _, file in other if file.name != "out"]  # which states the time taken
    fault = f"slider on ARM beside x86-64: {same} files of {len(sliders)} runs with the same bytes"
    fault += f", other bytes: {' '.join(file.name for file in other)}" if other else ""
    catalogues = SOURCE / "results/catalogues"
    names = dict(one=catalogues / "fault_120.catalogue.csv.xz", chain=catalogues / "slider_ours_256_seed_1.catalogue.csv.xz",
                 series=FOLDER / name / "sliders/theirs/0/verlet.pe")
    same, others = compare_runs(arm / "postproc", native / "postproc", FOLDER / name / "postprocs", [line.format(**names) for line in POSTPROCS])
    fault += f"; postproc: {same} files of {len(POSTPROCS)} commands with the same bytes"
    if others:
        fault += f", {len(others)} others by: " + " ".join(f"{what}/{b.name} ({largest_difference(a, b)})" for what, a, b in others)
    machine = run(Program("qemu-aarch64", "qemu-aarch64"), "--version").out.splitlines()[0]
    return Row("none", f"{compiler_of('aarch64-linux-gnu-g++')}, run by {machine}", "-",
               tests="unit, slider, postproc: " + "; ".join(w for w, _ in parts), fault=fault, ok=all(ok for _, ok in parts) and not other)


def in_debian(debian, build_name, line, log, status=0):
    """Runs a command in the Debian of a column, with the sources in /lsm and the build folder /build/NAME."""
    script = '''at=$1 root=$2
mkdir -p "$at/lsm" "$at/build"
mount -t proc proc "$at/proc"
mount --rbind /dev "$at/dev"
mount --bind "$root" "$at/lsm"
exec chroot "$at" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LSM_BUILD_DIR="/build/$3" bash -c "cd /lsm; $4"'''
    return command("unshare", "--mount", "--pid", "--fork", "--kill-child", "bash", "-euc", script, "in_debian", FOLDER / f"{debian}-root", SOURCE,
                   build_name, line, log=log, status=status)


def in_bare_debian(name, debian, build_name, line):
    """Runs a command, and the short fault with the programs it has built. Returns the time it took, in words, and the row's further cells."""
    log, at = FOLDER / f"{name}.log", FOLDER / name
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    status = in_debian(debian, build_name, line, log, status=None)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    took = f"{time.monotonic() - begun:.0f} s, {after.ru_utime - before.ru_utime:.0f} + {after.ru_stime - before.ru_stime:.0f} s of CPU"
    print(f"{line}: {took}")
    warned = re.search(r"warning: |CMake [A-Za-z() ]*Warning", log.read_text(errors="replace"))
    shutil.rmtree(at, ignore_errors=True)
    at.mkdir()
    words = " ".join(f"-var {key} {value}" for key, value in SCENE.items())
    for ranks in 1, 2:
        in_debian(
            debian, build_name, f". inputs/mpi-settings.sh; mkdir -p /build/{build_name}/fault; cd /build/{build_name}/fault; mpirun -np {ranks} "
            f"../bin/lmp -in /lsm/inputs/fault_120.in -log none {words} -var overwrite yes -var prefix on_{ranks}", at / f"out_{ranks}.txt")
    shutil.copytree(FOLDER / f"{debian}-root/build/{build_name}/fault", at / "fault")
    version = FOLDER / "command.log"
    in_debian(debian, build_name, "g++ --version", version)
    return took, dict(compiler=version.read_text().splitlines()[0], build="**warnings**" if warned else "no warning"), status == 0 and not warned


@column("debian-12", "debian-13")
def debian(name):
    """A Debian in which nothing is installed, from the mirror of this machine."""
    install("debootstrap")
    at, suite = FOLDER / f"{name}-root", "bookworm" if name == "debian-12" else "trixie"
    targets = Program("apt-get", "apt-get")
    mirror = run(targets, ["indextargets", "--format", "$(REPO_URI)", "Created-By: Packages", "Label: Debian"]).out.split()[:1]
    command("rm", "-rf", "--one-file-system", at)
    command("debootstrap", "--variant=minbase", suite, at, *mirror, log=FOLDER / f"{name}.debootstrap.log")
    for file in "resolv.conf", "hosts":
        shutil.copy(f"/etc/{file}", at / "etc")
    took, cells, ok = in_bare_debian(name, name, "first", "inputs/first-catalogue.sh")
    fault, same = compare_fault(name) if (FOLDER / "reference/fault").is_dir() else ("the reference was not built", True)
    return Row("4 Feb 2025" + (" of the distribution" if name == "debian-13" else ""),
               tests=f"`inputs/first-catalogue.sh` where nothing is installed: {took}", fault=fault, ok=ok and same, **cells)


@column("debian-12-tests", "debian-13-tests")
def debian_tests(name):
    """With our own build of LAMMPS, and in debian-13 also the distribution's."""
    first = name[:-len("-tests")]
    if not (FOLDER / first / "fault").is_dir():
        raise Failure(f"{name} is compared with {first}, which is not done yet")
    line = f"tests/run-all.sh {CTEST}".strip()
    took, cells, ok = in_bare_debian(name, first, "all", line)
    fault, same = compare_fault(name, first)
    return Row(tests=f"`{line}`: {counted(FOLDER / f'{name}.log')}, {took}", fault=f"beside {first}: {fault}", ok=ok and same, **cells)


@column("sanitize")
def sanitize(name):
    """Folders and environment are those of CMakePresets.json."""
    log = FOLDER / f"{name}.log"
    command("cmake", "--preset", name, log=log, cwd=SOURCE)
    command("cmake", "--build", "--preset", name, "--parallel", JOBS, log=log, append=True, cwd=SOURCE)
    tests = FOLDER / f"{name}.tests.log"
    status = command("ctest", "--preset", name, "--repeat", "after-timeout:3", log=tests, status=None, cwd=SOURCE)
    return Row(build="with its checks", tests=counted(tests), ok=status == 0)


@column("mutations")
def mutations(name):
    log = FOLDER / "mutations.log"
    status = command(SOURCE / "tests/mutations/run.sh", log=log, status=None,
                     env={**os.environ, "LSM_MUTATIONS_DIR": f"{FOLDER}/mutations", "LSM_MUTATIONS_JOBS": str(JOBS)})
    return Row(build="one for each mutation", tests=log.read_text().splitlines()[-1], ok=status == 0)


ORDER = (
    "reference clang bigbig jul2026 plugin installed testers testers-jul2026 aarch64 debian-12 debian-12-tests debian-13 debian-13-tests sanitize "
    "mutations").split()
ALONE = ("reference", "aarch64", "sanitize", "mutations")  # not compared with the reference


def with_row(page, name, row):
    """The page with a row, in place of that of the same column under "Last run" or at its end; what precedes it is kept."""
    before, heading, after = page.partition("## Last run")
    lines = after.splitlines(keepends=True)
    places = [n for n, line in enumerate(lines) if line.startswith(f"| {name} |")] or [len(lines)]
    lines[places[0]:places[0] + 1] = [row]
    return before + heading + "".join(lines)


def do(name):
    print(f"== {name} ({datetime.datetime.now():%F %T})", flush=True)
    try:
        row = COLUMNS[name](name)
    except (Failure, AssertionError, OSError, subprocess.CalledProcessError) as error:
        print(error, file=sys.stderr)
        row = Row("", " ", "", "**failed**", "", "", ok=False)
    (FOLDER / f"{name}.row").write_text(row.text(name))
    page = HERE / "README.md"
    page.write_text(with_row(page.read_text(), name, row.text(name)))
    return row.ok


def main():
    global FOLDER, JOBS, CACHE
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=Path, default=SOURCE / "build-matrix", help="where everything is built (default build-matrix; some GB)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes for compiling (default: number of cores)")
    parser.add_argument("columns", nargs="+", choices=("all", *ORDER), metavar="all|COLUMN", help=", ".join(ORDER))
    given = parser.parse_args()
    if given.jobs < 1:
        parser.error(f"--jobs {given.jobs}, expected at least 1")
    columns = ORDER if "all" in given.columns else given.columns
    FOLDER, JOBS = given.folder.resolve(), given.jobs
    FOLDER.mkdir(parents=True, exist_ok=True)
    CACHE = Path(os.environ.setdefault("LSM_LAMMPS_CACHE", str(FOLDER / "cache")))
    if any(not name.startswith("debian-") for name in columns):
        install("clang", "libgtest-dev", "libgmock-dev", "libyaml-dev")
    bad = []
    for name in columns:
        if not name.startswith("debian-") and name not in ALONE and not (FOLDER / "reference.row").is_file():
            sys.exit(f"run_matrix: {name} is compared with the reference, which is not done yet")
        if not do(name):
            bad.append(name)
    print(HEAD + "".join((FOLDER / f"{name}.row").read_text() for name in ORDER if (FOLDER / f"{name}.row").is_file()), end="")
    if bad:
        sys.exit(f"run_matrix: failed: {', '.join(bad)}")


if __name__ == "__main__":
    main()
