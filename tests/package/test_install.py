# SPDX-License-Identifier: GPL-2.0-or-later
"""The Debian package, unpacked into an empty root and used from there: programs, plugin, scenes, headers,
manual pages."""
import gzip
import importlib.util
import os
import re
import shutil
import sys
from pathlib import Path

import pytest
from conftest import MPI, lammps_errors
from data_files import rows
from programs import BUILD, SOURCE, Program, run, scene
from test_python import FAULT

PROGRAM = """#include <lsm/events/event_picker.h>
#include <lsm/fault/packing.h>
int main() {
  LSM::EventPicker picker({});
  LSM::Event event;
  int events = 0;
  for (int step = 0; step < 400; ++step) events += picker.push(step, step, step < 200 ? step : 400 - step, event);
  LSM::PackingSettings small;
  small.length = small.width = 20.0;
  return picker.in_event() && events == 0 && LSM::make_packing(small).loose_tangent >= 0 ? 0 : 1;
}
"""


def test_install(work):
    if not shutil.which("dpkg-deb"):
        pytest.skip("no dpkg-deb")
    version = os.environ["LSM_VERSION"]
    run(Program("cpack", "cpack"), "--config", BUILD / "CPackConfig.cmake", "-B packages")
    deb, = Path("packages").glob("*.deb")
    fields = run(Program("dpkg-deb", "dpkg-deb"), "-f", deb).out
    assert f"\nVersion: {version}\n" in fields
    for library in "libgsl", "libopenmpi", "libfftw3":
        assert re.search(f"^Depends: .*{library}", fields, re.M), library
    run(Program("dpkg-deb", "dpkg-deb"), "-x", deb, "root")
    root = work / "root/usr"
    assert os.listdir("root") == ["usr"], "files outside /usr"
    for path in root.rglob("*"):
        if path.is_file() and not path.is_symlink():
            content = path.read_bytes()
            assert b"\0" in content or str(BUILD).encode() not in content, f"{path} names the build folder"

    # Programs run as installed, without the build folder in the environment.
    def installed(path, *options):
        program = Program(Path(path).name, path, *options, errors=lammps_errors)
        program.env = {**MPI, "PATH": f"{root}/bin:/usr/bin:/bin", "HOME": str(work)}
        return program

    for name in "slider_cli", "postproc":
        assert re.search(f"(^| ){re.escape(version)}$", run(installed(root / "bin" / name), "--version").out.strip())
        page, = root.glob(f"share/man/man1/{name}.1*")
        text = (gzip.decompress(page.read_bytes()) if page.suffix == ".gz" else page.read_bytes()).decode()
        assert "options" in text.lower() and f"{name} \\- " in text, f"manual page of {name}"
    run(installed(root / "bin/slider_cli"), "--blocks 64 --steps 400000 --catalogue slider.csv")
    assert len(rows("slider.csv")) > 2
    inputs = root / "share/lsm-fault/inputs"
    lmp = installed(root / "bin/lmp", "-log", "none")
    run(lmp, scene(inputs / "fault_120.in", length=20, settle=100, steps=200, prefix="fault"))
    assert os.path.getsize("fault.catalogue.csv") > 0 and os.path.getsize("fault.pe.bin") > 0
    postproc = installed(root / "bin/postproc")
    run(postproc, "select slider.csv -o table.csv")
    assert len(rows("table.csv")) > 1
    run(postproc, "explore slider.csv -o page.html")
    assert "Dygraph" in Path("page.html").read_text(), "the page is without its library"

    # The plugin is loaded by a stock lmp if one was built.
    if os.environ.get("LSM_STOCK_LMP"):
        plugin, = root.rglob("lsmplugin.so")
        Path("in.plugin").write_text(f"plugin load {plugin}\ninclude {inputs}/two_body_collision.in\n")
        assert re.search("Loading plugin: .*lsm/free", run(installed(os.environ["LSM_STOCK_LMP"]), "-in in.plugin -log none").out)

    # LAMMPS as a library, from Python
    Path("fault.py").write_text(FAULT)
    python = installed(sys.executable)
    python.env["PYTHONPATH"] = str(root / "lib/python3/dist-packages")
    run(python, "fault.py", inputs)

    # headers of the core, and its library, which takes checksums by zlib
    Path("program.cpp").write_text(PROGRAM)
    library, = root.rglob("liblsm_core.a")
    run(Program("compiler", os.environ.get("LSM_CXX", "c++")), "-std=c++17",
        f"-I{root}/include -I{root}/include/lsm -o program program.cpp {library} -lz")
    run(Program("program", work / "program"))


def test_others_may_use_what_is_installed(work):
    """Programs, scenes and pages; a umask that would exclude others causes a warning, as CMake applies it to folders."""
    cmake = Program("cmake", "cmake", "--install", BUILD)
    assert "umask" not in run(cmake, "--prefix", work / "root", umask=0o022).err
    found = [work / "root", *(work / "root").rglob("*")]
    closed = [
        str(path) for path in found if not path.is_symlink() and path.stat().st_mode & (0o055 if path.is_dir() else 0o044) not in (0o055, 0o044)
    ]
    assert len(found) > 300 and not closed, closed[:5]
    inputs = work / "root/share/lsm-fault/inputs"
    for program in work / "root/bin/postproc", inputs / "study.sh", inputs / "run.py", inputs / "studies/publish.py":
        assert program.stat().st_mode & 0o777 == 0o755, program
    assert (inputs / "fault.in").stat().st_mode & 0o777 == 0o644
    # Its pages have no dead links.
    documents = work / "root/share/doc/lsm-fault"
    for name in "README.md", "CHANGELOG.md", "inputs/tutorial.md", "inputs/studies.md", "lammps-pkg/doc/formats.md", "results/README.md":
        assert (documents / name).is_file(), name
    spec = importlib.util.spec_from_file_location("check_documents", SOURCE / "tests/check-documents.py")
    check = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(check)
    check.check_markdown(documents.resolve())
    assert check.PROBLEMS == []
    run(cmake, "--prefix", work / "closed", umask=0o077).warned("The umask is 0077: new folders are closed to other users, expected 022")
