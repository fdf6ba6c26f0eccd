# SPDX-License-Identifier: GPL-2.0-or-later
"""The package compiled into LAMMPS, linked to its library, and as a plugin of the stock lmp; a plugin that
does not match is not loaded."""
import os
import re
from pathlib import Path

import pytest
from conftest import MPI, lammps_errors
from data_files import read_catalogue, same, same_bytes
from programs import BUILD, Program, run
from test_pages import SCENE

STYLES = ("lsm/linked lsm/free lsm/friction lsm/nve lsm/plates lsm/leap lsm/absorb lsm/traction lsm/events create_lsm_fault include_beside "
          "lsm_variables lsm_run").split()
PLUGIN = BUILD / "lib/lsmplugin.so"


@pytest.fixture(scope="module")
def stock():
    if not os.environ.get("LSM_STOCK_LMP"):
        pytest.skip("no stock lmp: LSM_STOCK_LMP is not set")
    return Program("lmp", os.environ["LSM_STOCK_LMP"], "-log", "none", env=MPI, errors=lammps_errors)


# Two discs that are linked and two that collide use bond, pair and integrator in one small run, in which the
# total energy must not change. A second scene after 'clear' finds the styles again (a plugin has to be
# loaded again).
COLLISION = """units lj
dimension 2
boundary p p p
newton on
atom_style hybrid bond sphere
region box block 0 40 0 40 -0.5 0.5
create_box 1 box bond/types 1 extra/bond/per/atom 2
create_atoms 1 single 10 10 0
create_atoms 1 single 11.05 10 0
create_atoms 1 single 20 20 0
create_atoms 1 single 23 20 0
set group all diameter 1.0
set group all mass 0.25
set atom 3 vx 0.1
set atom 4 vx -0.1
special_bonds lj/coul 0 1 1
bond_style lsm/linked
bond_coeff 1 1.0
pair_style lsm/free
pair_coeff * * 1.0
create_bonds single/bond 1 1 2
fix move all lsm/nve
thermo 50
thermo_style custom step ke pe etotal
thermo_modify norm no format float %.12g
timestep 0.02
run 2000
variable e equal etotal
print "ENERGY $e"
clear
"""


def fault(program, load, name, runs, geometry="create_lsm_fault length 20 width 14 seed 7 failures 300"):
    """A sheared fault with friction, plates and events."""
    words = dict(fix_lsm_nve=" viscosity 0.05", driving=" stressramp 6 damping 0.05 velocity 0.02 ramp 6", fix_lsm_plates="", leap="",
                 events=f"faces lowerface upperface catalogue {name}.csv series {name}.pe ledger yes location yes resume yes",
                 compute_lsm_events="\nthermo_style custom step c_events c_events[5] c_events[11]")
    Path("in.fault").write_text(load + SCENE.format(geometry=geometry, runs=runs, **words))
    return run(program, "-in in.fault")


# The run is in pieces, as in fault.in: each sorts the particles, so that a restart in between gives the same digits.
WHOLE = "run 2000\nwrite_restart state\nrun {}"


def works(program, load=""):
    """Runs both scenes; a restart in the middle of that of the fault gives the same files."""
    Path("in.scene").write_text(2 * (load + COLLISION))
    energies = re.findall("^ENERGY (.*)", run(program, "-in in.scene").out, re.M)
    # Kinetic 2 * 0.5 * 0.25 * 0.1^2 plus link 0.5 * 0.05^2.
    assert len(energies) == 2 and [float(e) for e in energies] == pytest.approx([0.00375] * 2, abs=1e-5)
    fault(program, load, "whole", WHOLE.format(2000))
    fault(program, load, "part", WHOLE.format(500))
    fault(program, load, "part", "run 2000", "read_restart state")
    same("whole.csv", "part.csv", 3)
    same_bytes("whole.pe", "part.pe")
    columns = list(read_catalogue("whole.csv")[1].values())
    assert (columns[8] > 0).any(), "nothing slid in any event"


def test_built_in(lmp):
    listed = run(lmp, "-h").out
    for style in [*STYLES, "LSM"]:
        assert re.search(rf"(?<![\w/]){style}(?![\w/])", listed), f"lmp -h does not list {style}"
    works(lmp)


def test_linked(lmp):
    """The output of -h is fixed when LAMMPS itself is compiled, so that the styles are missing there."""
    works(lmp)


def test_plugin(lmp, stock):
    assert not re.search(r"(?<!\S)lsm/", run(stock, "-h").out), "the stock lmp has the styles already"  # nor is it about its folder
    load = f"plugin load {PLUGIN}\n"
    Path("in.load").write_text(load)
    said = run(stock, "-in in.load").out
    for style in STYLES:
        assert re.search(f"Loading plugin: .*{style}", said), f"the plugin does not register {style}"
    works(stock, load)
    # No command is needed if LAMMPS loads what is in these folders at its start, and after 'clear'.
    by_path = Program("lmp", os.environ["LSM_STOCK_LMP"], "-log", "none", env={**stock.env, "LAMMPS_PLUGIN_PATH": str(PLUGIN.parent)},
                      errors=lammps_errors)
    Path("in.path").write_text(2 * COLLISION)
    assert len(re.findall("^ENERGY ", run(by_path, "-in in.path").out, re.M)) == 2
    # The same bytes as the program that has the package compiled in.
    fault(lmp, "", "other", WHOLE.format(2000))
    same_bytes("whole.csv", "other.csv")
    same_bytes("whole.pe", "other.pe")


def test_refused(lmp, stock):
    """For a plugin that does not match there is one line, no style is registered, and the program continues."""

    def not_loaded(program, plugin, pattern):
        Path("in.refused").write_text(f'plugin load {plugin}\nplugin list\nprint "went on"\n')
        said = run(program, "-in in.refused").out
        assert said.count("Plugin of the LSM package not loaded") == 1 and re.search(pattern, said), said
        assert "Loading plugin" not in said and "style plugin" not in said, "styles were registered"
        assert re.search("^went on", said, re.M)

    # The same file for another version of LAMMPS, of the same length.
    about = run(stock, "-h").out
    version = re.search(r"Large-scale Atomic/Molecular Massively Parallel Simulator - (.*\d)", about)[1]
    assert version in ("4 Feb 2025", "4 Jul 2026"), version
    content = PLUGIN.read_bytes()
    assert version.encode() in content
    Path("other.so").write_bytes(content.replace(version.encode(), b"5 Mar 2019"))
    not_loaded(stock, "./other.so", f"compiled for LAMMPS 5 Mar 2019, but this is LAMMPS {version};")
    bits, other = ("64, 32 and 32", "64, 64 and 64")[::-1 if "LAMMPS_BIGBIG" in about else 1]
    not_loaded(stock, BUILD / "lib/lsmplugin_other_integers.so", f"tagint and imageint of {other} bits, but this LAMMPS has .* {bits} bits;")
    not_loaded(lmp, PLUGIN, "the package is compiled into this LAMMPS already")
    # If the stock program loads it twice, the message is that of LAMMPS.
    Path("in.twice").write_text(2 * f"plugin load {PLUGIN}\n")
    said = run(stock, "-in in.twice").out
    assert "must unload existing" in said and "not loaded" not in said
