# SPDX-License-Identifier: GPL-2.0-or-later
"""LAMMPS with the package as a Python module: the fault run from Python writes the same files as lmp, errors
are exceptions, and files are unlocked again."""
import os
import sys
from pathlib import Path

from data_files import same_bytes
from programs import BUILD, INPUTS, SOURCE, Program, run

MODULES = os.environ.get("LSM_PYTHON_MODULES", BUILD / "python")

FAULT = """
import sys
from lammps import lammps

words = ["-log", "none", "-screen", "none"]
settings = dict(length=20, width=15, settle=100, steps=600, velocity=0.01)


def fault(**more):
    run = lammps(cmdargs=words + [word for key, value in {**settings, **more}.items() for word in ("-var", key, str(value))])
    run.file(sys.argv[1] + "/fault.in")
    return run


run = fault(prefix="python")
assert "LSM" in run.installed_packages and run.has_style("compute", "lsm/events")
assert run.extract_global("natoms") > 500
assert run.extract_compute("events", 0, 0) == run.extract_variable("events")
links = run.extract_compute("events", 0, 1)[5]
assert 0.0 < links < 1.0, links
# Still being written by that object.
try:
    fault(prefix="python", overwrite="yes")
except Exception as error:
    assert "python.catalogue.csv: this run writes that file already" in str(error), error
    assert "give each output a name of its own" in str(error), "not the whole message: " + str(error)
else:
    raise AssertionError("two objects write one catalogue")
run.close()
run = fault(prefix="again")
run.close()
run.finalize()
"""


def python(lmp, *launcher):
    return Program("python", *launcher, sys.executable, env={**lmp.env, "PYTHONPATH": str(MODULES)})


def test_module(lmp):
    Path("fault.py").write_text(FAULT)
    run(python(lmp), "fault.py", INPUTS)
    run(lmp, "-in", INPUTS / "fault.in", "-var length 20 -var width 15 -var settle 100 -var steps 600 -var velocity 0.01 -var prefix lmp")
    for name in "python", "again":
        assert not list(Path().glob(f"{name}.*.new")), f"{name} left a temporary file"
        same_bytes(f"{name}.catalogue.csv", "lmp.catalogue.csv")
        same_bytes(f"{name}.pe.bin", "lmp.pe.bin")


def test_module_on_two_ranks(lmp):
    Path("fault.py").write_text(FAULT)
    run(python(lmp, SOURCE / "tests/mpirun.sh", "--oversubscribe", "-np", 2), "fault.py", INPUTS)
