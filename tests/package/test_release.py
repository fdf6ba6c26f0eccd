# SPDX-License-Identifier: GPL-2.0-or-later
"""The same version everywhere, and a valid citation file."""
import re

import pytest

from data_files import header
from programs import SOURCE, run

VERSION = re.search(r"^  VERSION ([0-9]+\.[0-9]+\.[0-9]+)$", (SOURCE / "CMakeLists.txt").read_text(), re.M)[1]


def test_version_of_the_programs(slider, postproc):
    for program in (slider, postproc):
        assert run(program, "--version").out.split()[-1] == VERSION
    run(slider, "--blocks 16 --steps 100 --warmup 0 --catalogue a.csv")
    assert header("a.csv")["program"] == f"slider_cli {VERSION}"


def test_version_and_citation_of_the_fault(lmp):
    run(lmp, ["-cite", "log.cite", "-in", SOURCE / "inputs/fault.in"], "-var length 20 -var width 15 -var settle 10 -var steps 100 -var prefix a")
    assert header("a.catalogue.csv")["program"].endswith(f" package LSM {VERSION}")
    cited = open("log.cite").read()
    assert f"package LSM {VERSION}" in cited and "10.5194/npg-11-553-2004" in cited and "@Article{Weatherley2004" in cited


def test_changes_and_citation_are_of_this_version():
    assert re.findall(r"^## (\S+)", (SOURCE / "CHANGELOG.md").read_text(), re.M)[0] == VERSION
    yaml = pytest.importorskip("yaml")
    cff = yaml.safe_load((SOURCE / "CITATION.cff").read_text())
    # what the schema of CFF 1.2.0 requires
    assert cff["cff-version"] == "1.2.0" and cff["version"] == VERSION and {"message", "title", "authors"} <= set(cff)
    assert all({"type", "title", "authors", "doi"} <= set(reference) for reference in cff["references"])
    readme = (SOURCE / "README.md").read_text()
    assert f"*lsm-fault*, version {VERSION}" in readme and all(reference["doi"] in readme for reference in cff["references"])
