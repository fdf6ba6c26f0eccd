# SPDX-License-Identifier: GPL-2.0-or-later
"""A LAMMPS source tree into which the package was installed: LAMMPS' own checks of sources and pages, and examples."""
import os
import re
import shutil
import sys
from fnmatch import fnmatch
from pathlib import Path

import pytest
from programs import SOURCE, Program, refused, run

INSTALL = Program("install-into-lammps", SOURCE / "lammps-pkg/install-into-lammps.sh")
PAGES = {page.name for page in (SOURCE / "lammps-pkg/doc").glob("*.rst")} - {"index.rst"}
SCENES = {path.stem for path in (SOURCE / "inputs").glob("*.in")}

# What the script changes and the checks read.
PARTS = ["src/*.h", "src/.clang-format", "cmake/*", "tools/coding_standard/*.py", "doc/src/*.rst", "doc/utils/*"]


@pytest.fixture(scope="module", params=("lammps-4Feb2025", "lammps-4Jul2026"))
def tree(request, tmp_path_factory):
    """Those parts of LAMMPS' source, with the package: of the build's version, and of the other one if it is in the cache."""
    if "LSM_LAMMPS_SRC" not in os.environ:
        pytest.skip("no source of LAMMPS")
    source = Path(os.environ["LSM_LAMMPS_SRC"]).parent
    own = re.search(r'LAMMPS_VERSION "(.*)"', (source / "src/version.h").read_text())[1].replace(" ", "")
    tree = tmp_path_factory.mktemp("tree")
    if request.param == f"lammps-{own}" and (source / "doc/utils").is_dir():
        for path in (path.relative_to(source) for path in source.rglob("*") if path.is_file()):
            if any(fnmatch(path, part) for part in PARTS) and "LSM" not in path.parts:
                (tree / path).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(source / path, tree / path)
    else:  # the cache leaves pages out when it unpacks the archive
        archive, *_ = [*source.parent.glob(f"{request.param}.tar.*"), None]
        if not archive:
            pytest.skip(f"no {request.param}.tar.* in {source.parent}")
        run(Program("tar", "tar"), "-xf", archive, "-C", tree, "--wildcards --no-anchored", PARTS)
        tree, = (path for path in (tree, *tree.iterdir()) if (path / "doc").is_dir())
    assert run(INSTALL, tree).err == ""
    return tree


def test_lammps_own_checks(tree):
    python = Program("python", sys.executable)
    for check in "whitespace", "permissions", "homepage", "errordocs", "fmtlib", "versiontags":
        if (tree / f"tools/coding_standard/{check}.py").exists():
            assert run(python, tree / f"tools/coding_standard/{check}.py", tree).out == ""
    # those that 'make html' runs in doc
    os.chdir(tree / "doc")
    pages = sorted(Path("src").glob("*.rst"))
    for check in "styles", "packages":
        assert "issue" not in run(python, f"utils/check-{check}.py -s ../src -d src").out
    run(python, "utils/converters/lammpsdoc/rst_anchor_check.py", pages)
    wrong = " :[a-z]+`", " `[^`]+<[a-z][^`]+`[^_]", ":(ref|doc):[^`]", "(ref|doc)`[^`]", "[^ -~]"
    for page in pages:
        for number, line in enumerate(page.read_text().splitlines(), 1):
            assert not any(re.search(pattern, line) for pattern in wrong), f"{page}:{number}: {line}"


def test_format(tree):
    if not shutil.which("clang-format"):
        pytest.skip("no clang-format")
    format = Program("clang-format", "clang-format", "--dry-run", "-Werror")
    Path("probe.cpp").write_text("int  a ;")
    assert run(format, "probe.cpp", status=None).status != 0
    styles = [path for path in (tree / "src/LSM").glob("*.*") if not path.name.startswith("lsm_core_")]
    assert len(styles) > 70
    run(format, styles)


def test_form_of_a_contribution(tree):
    for name in PAGES:
        text = (tree / "doc/src" / name).read_text()
        assert name.startswith("Howto") or re.search(r'\nDescription\n"+\n\n\.\. versionadded:: \w+\n\n\S', text), name
    assert "\n   Howto_lsm_ruptures\n" in (tree / "doc/src/Howto.rst").read_text()
    sources = [path for path in (tree / "src/LSM").rglob("*") if path.is_file()]
    assert len(sources) > 100 and (tree / "src/LSM/README").is_file()
    for path in sources:
        text = path.read_text()
        assert text.isascii(), path
        assert path.name == "README" or "LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator" in text.splitlines()[1], path
    # A second time nothing changes.
    before = {path: path.read_bytes() for path in tree.rglob("*") if path.is_file()}
    assert run(INSTALL, tree).err == ""
    assert before == {path: path.read_bytes() for path in tree.rglob("*") if path.is_file()}


def test_examples(tree, lmp):
    folder = tree / "examples/PACKAGES/lsm"
    assert SCENES == {path.name[3:] for path in folder.glob("in.*")}
    for path in folder.glob("in.*"):
        for name in re.findall(r"^\s*include_beside\s+(in\.\w+)$", path.read_text(), re.M):
            assert (folder / name).is_file(), f"{path.name} includes {name}"
    if (tree / "src/version.h").read_text() != Path(os.environ["LSM_LAMMPS_SRC"], "version.h").read_text():
        return  # lmp is of the other version
    assert run(INSTALL, tree, lmp.path).err == ""
    for log in "fault_120", "p_wave_lattice":
        tables = []
        for ranks in 1, 4:
            path, = folder.glob(f"log.*.{log}.g++.{ranks}")
            text = path.read_text()
            assert "Total wall time" in text and f"on {ranks} procs" in text and "/tmp" not in text and str(tree) not in text
            tables.append([[float(word) for word in line.split()] for line in text.splitlines() if re.fullmatch(r"(\s+[-+.e\d]+){4,}\s*", line)])
        assert len(tables[0]) > 3 and [row[0] for row in tables[0]] == [row[0] for row in tables[1]]
    assert {path.name.split(".")[1] for path in folder.glob("log.*")} <= {"4Feb2025", "4Jul2026"}
    refused(INSTALL, [tree, tree / "nothing"], "nothing is not a program")


def test_tree_without_lists(work):
    """Entries that cannot be made are named; the package is there nevertheless."""
    for name in "src", "cmake", "doc/src":
        (work / "lammps" / name).mkdir(parents=True)
    (work / "lammps/src/version.h").write_text('#define LAMMPS_VERSION "4 Feb 2025"\n')
    (work / "lammps/cmake/CMakeLists.txt").write_text("set(STANDARD_PACKAGES\n  MOLECULE)\n")
    (work / "lammps/doc/src/Commands_all.rst").write_text("")
    said = run(INSTALL, work / "lammps").err.splitlines()
    assert all(line.startswith("install-into-lammps: warning: ") and ": no entry made, as there is no " in line for line in said)
    assert sum("Packages.rst" in line for line in said) == 1 and sum("all_on.cmake" in line for line in said) == 1
    version = re.search(r"^  VERSION ([0-9.]+)$", (SOURCE / "CMakeLists.txt").read_text(), re.M)[1]
    assert f'#define LSM_VERSION "{version}"\n' in (work / "lammps/src/LSM/lsm_version.h").read_text()
    list_file = ("set(STANDARD_PACKAGES\n  LSM\n  MOLECULE)\nif(PKG_LSM)\n  find_package(ZLIB REQUIRED)\n"
                 "  target_link_libraries(lammps PRIVATE ZLIB::ZLIB)  # LSM\nendif()\n")
    assert (work / "lammps/cmake/CMakeLists.txt").read_text() == list_file
