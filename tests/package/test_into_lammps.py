# SPDX-License-Identifier: GPL-2.0-or-later
"""A LAMMPS source tree into which the package was installed: LAMMPS' own checks of sources and pages, and examples."""
import os
import re
import shutil
import sys
from pathlib import Path

import pytest
from programs import SOURCE, Program, run, scene

INSTALL = Program("install-into-lammps", SOURCE / "lammps-pkg/install-into-lammps.sh")
PAGES = {page.name for page in (SOURCE / "lammps-pkg/doc").glob("*.rst")} - {"index.rst"}
SCENES = {path.stem for path in (SOURCE / "inputs").glob("*.in")}


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """The parts of LAMMPS' source that the script changes or the checks read, with the package."""
    if "LSM_LAMMPS_SRC" not in os.environ:
        pytest.skip("no source of LAMMPS")
    work = tmp_path_factory.mktemp("tree")
    source, tree = Path(os.environ["LSM_LAMMPS_SRC"]).parent, work / "lammps"
    for part, endings in ("src", ("*.h",)), ("cmake", ("CMakeLists.txt", "all_o*.cmake")), ("tools/coding_standard", ("*.py",)):
        for path in (path for ending in endings for path in (source / part).rglob(ending) if "LSM" not in path.parts):
            target = tree / path.relative_to(source)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, target)
    if (source / "doc/utils").is_dir():
        shutil.copytree(source / "doc", tree / "doc")
    else:  # the cache leaves it out when it unpacks the archive
        archive, *_ = [*source.parent.glob(f"{source.name}.tar.*"), None]
        if not archive:
            pytest.skip(f"no pages of LAMMPS in {source}, and no archive beside it")
        run(Program("tar", "tar"), "-xf", archive, "-C", work, "--wildcards --no-anchored doc/src/*.rst doc/utils/*")
        unpacked, = (path.parent for path in (work / "doc", *work.glob("lammps-*/doc")) if path.is_dir())
        (unpacked / "doc").rename(tree / "doc")
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


def test_form_of_a_contribution(tree):
    for name in PAGES:
        text = (tree / "doc/src" / name).read_text()
        assert name.startswith("Howto") or re.search(r'\nDescription\n"+\n\n\.\. versionadded:: \w+\n\n\S', text), name
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
    run(lmp, scene(folder / "in.fault_120", length=20, settle=10, steps=20, prefix="fault"))
    assert Path("fault.catalogue.csv").is_file()


def test_tree_without_lists(work):
    """Entries that cannot be made are named; the package is there nevertheless."""
    for name in "src", "cmake", "doc/src":
        (work / "lammps" / name).mkdir(parents=True)
    (work / "lammps/src/version.h").write_text('#define LAMMPS_VERSION "4 Feb 2025"\n')
    (work / "lammps/cmake/CMakeLists.txt").write_text("set(STANDARD_PACKAGES\n  MOLECULE)\n")
    (work / "lammps/doc/src/Packages_list.rst").write_text("")
    said = run(INSTALL, work / "lammps").err.splitlines()
    assert all(line.startswith("install-into-lammps: warning: ") and ": no entry made, as there is no " in line for line in said)
    assert sum("Packages_list.rst" in line for line in said) == 1 and sum("all_on.cmake" in line for line in said) == 1
    version = re.search(r"^  VERSION ([0-9.]+)$", (SOURCE / "CMakeLists.txt").read_text(), re.M)[1]
    assert f'#define LSM_VERSION "{version}"\n' in (work / "lammps/src/LSM/lsm_version.h").read_text()
    list_file = ("set(STANDARD_PACKAGES\n  LSM\n  MOLECULE)\nif(PKG_LSM)\n  find_package(ZLIB REQUIRED)\n"
                 "  target_link_libraries(lammps PRIVATE ZLIB::ZLIB)  # LSM\nendif()\n")
    assert (work / "lammps/cmake/CMakeLists.txt").read_text() == list_file
