# SPDX-License-Identifier: GPL-2.0-or-later
"""The package compiles without a warning with the headers of other versions of LAMMPS."""
import os
import re
import tarfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from programs import SOURCE, Program, run

PACKAGE = SOURCE / "lammps-pkg"


@pytest.fixture
def compiler(work):
    """Compiles a source without output. Warnings are errors, except those about 'override'."""
    if "LSM_STYLE_DEFINITIONS" not in os.environ:
        pytest.skip("LSM_STYLE_DEFINITIONS, LSM_MPI_INCLUDES: how the package is compiled is not known")
    words = [f"-D{word}" for word in os.environ["LSM_STYLE_DEFINITIONS"].split("|")]
    words += [word for folder in os.environ["LSM_MPI_INCLUDES"].split("|") for word in ("-isystem", folder)]
    for folder in "LSM", "LSM/scene", "LSM/speed", "LSM/support", "core":
        words += ["-I", PACKAGE / folder]
    # CMake makes these files otherwise.
    Path("lsm_styles.h").write_text("".join(f'#include "{path.name}"\n' for path in sorted((PACKAGE / "LSM").glob("*.h"))))
    Path("lsm_version.h").write_text('#define LSM_VERSION "of a test"\n')
    return Program("compiler", os.environ["LSM_CXX"], "-std=c++17", "-fsyntax-only", "-Wall", "-Wextra", "-Wsuggest-override", "-Werror", *words,
                   "-I", work)


def headers_of(name):
    """The folder src of a version in the cache, or None; nothing is downloaded."""
    cache = Path(os.environ["LSM_LAMMPS_CACHE"])
    if (cache / name / "src/version.h").exists():
        return cache / name / "src"
    for archive in cache.glob(f"{name}.tar.*"):
        with tarfile.open(archive) as content:
            content.extractall(name, [one for one in content if re.search(r"src/.*\.(h|hpp)$", one.name) and one.isfile()])
        return next(Path(name).rglob("src/version.h")).parent
    return None


VERSIONS = "lammps-4Feb2025", "lammps-4Jul2026"


@pytest.mark.parametrize("name", VERSIONS)
def test_versions(compiler, name):
    """Runs if the sources of both versions are in the cache; one of them is that of the build itself."""
    sources_of = {version: headers_of(version) for version in VERSIONS}
    if not all(sources_of.values()):
        pytest.skip("the sources of both versions are needed")
    source = sources_of[name]
    folders = [word for part in ("", "BPM", "GRANULAR", "MOLECULE", "PLUGIN") for word in ("-isystem", source / part)]
    # A call that this version does not have must be detected, or the rest proves nothing.
    text = (PACKAGE / "LSM/lsm_variables.cpp").read_text()
    broken = text.replace("get_variable_names(count)", "get_variable_names()")
    assert broken != text
    Path("broken.cpp").write_text(broken)
    assert run(compiler, folders, "broken.cpp", status=None).status != 0
    sources = sorted(PACKAGE.glob("LSM/*.cpp")) + sorted(PACKAGE.glob("LSM/*/*.cpp"))
    assert len(sources) > 20
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        list(pool.map(lambda path: run(compiler, folders, path), sources))
