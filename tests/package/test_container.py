# SPDX-License-Identifier: GPL-2.0-or-later
"""The image of the Containerfile, built on a Debian made by debootstrap, runs the first catalogue."""
import os
import shutil
import subprocess
from pathlib import Path

import pytest
from programs import SOURCE

STEPS = "400000"


def must(*command, **more):
    ran = subprocess.run([str(word) for word in command], capture_output=True, text=True, **more)
    assert ran.returncode == 0, f"{command}: {ran.stdout[-2000:]}{ran.stderr[-2000:]}"
    return ran.stdout


def mirror():
    """The source of Debian packages that this machine uses."""
    for path in [*Path("/etc/apt/sources.list.d").glob("*.sources"), Path("/etc/apt/sources.list"), *Path("/etc/apt/sources.list.d").glob("*.list")]:
        for line in path.read_text().splitlines() if path.exists() else []:
            words = [word for word in line.split() if not word.startswith("[")]
            if words[:1] == ["URIs:"] or words[:1] == ["deb"] and "main" in words:
                return words[1]
    pytest.skip("no source of Debian packages in /etc/apt")


def test_container_runs_the_first_catalogue(work, monkeypatch):
    if os.geteuid():
        pytest.skip("needs root, for debootstrap")
    for name in "debootstrap", "buildah":
        if not shutil.which(name):
            pytest.skip(f"no {name}")
    tried = subprocess.run(["buildah", "from", "scratch"], capture_output=True, text=True)
    if tried.returncode:
        pytest.skip(f"buildah cannot work here: {tried.stderr.strip().splitlines()[-1]}")
    base = tried.stdout.strip()
    must("debootstrap", "--variant=minbase", "trixie", work / "root", mirror())
    must("buildah", "add", base, work / "root", "/")
    # The simplest command shows whether containers can run here at all, whatever the Containerfile says. Within another
    # container often only those without namespaces of their own can.
    for isolation in "oci", "chroot":
        monkeypatch.setenv("BUILDAH_ISOLATION", isolation)
        tried = subprocess.run(["buildah", "run", base, "--", "/bin/true"], capture_output=True, text=True)
        if not tried.returncode:
            break
    else:
        must("buildah", "rm", base)
        pytest.skip(f"no container runs here, not even /bin/true: {' '.join(tried.stderr.split())}")
    must("buildah", "commit", base, "lsm-test-base")
    made = [base]
    try:
        must("buildah", "build", "--build-arg", "BASE=localhost/lsm-test-base", "-t", "lsm-test", SOURCE)
        made.append(must("buildah", "from", "--pull-never", "localhost/lsm-test").strip())
        (work / "out").mkdir()

        def in_container(*command):
            return must("buildah", "run", "-v", f"{work}/out:/data", made[-1], "--", *command)

        said = in_container("/usr/share/lsm-fault/inputs/first-catalogue.sh", STEPS)
        assert "Open in a browser" in said and (work / "out/first-catalogue/first.catalogue.csv").exists()
        said = in_container("python3", "-c", "import lsm, lammps; print(len(lsm.read_catalogue('/data/first-catalogue/first.catalogue.csv')))")
        assert int(said) >= 100
    finally:
        subprocess.run(["buildah", "rm", *made], capture_output=True)
        subprocess.run(["buildah", "rmi", "-f", "lsm-test", "lsm-test-base"], capture_output=True)
