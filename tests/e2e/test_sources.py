# SPDX-License-Identifier: GPL-2.0-or-later
"""Sources of real runs: a rupture in a closed box whose blocks come to rest, and a drop of PE beside its ruptures."""
import sys

import numpy as np
import pytest
from data_files import read_catalogue
from programs import INPUTS, SOURCE, Program, run, scene

SCRIPT = Program("lsm.sources", sys.executable, "-m", "lsm.sources", env={"PYTHONPATH": str(SOURCE / "python"), "LC_ALL": "C.UTF-8"})
BOX = f"""
variable length index 16000
variable width index 12000
variable damping index 0.1
variable kt index 3
variable scale index 1e-5
include {INPUTS}/rupture_lattice.in
variable strong atom "abs(x)>3000-0.5*v_dx"
variable lower atom 3+4*v_strong
variable upper atom v_lower+1
set group face_lower type v_lower
set group face_upper type v_upper
pair_style lsm/friction slip-weakening
pair_coeff * * off
pair_coeff 3 4 $(v_k:%.17g) $(v_kt*v_k:%.17g) mu 0.525 mu_static 0.677 dc $(0.05*v_scale:%.17g)
pair_coeff 7 8 $(v_k:%.17g) $(v_kt*v_k:%.17g) mu 1e4 mu_static 1e4 dc 1
variable shear atom (76+7*(abs(x)<1300))*1e6*v_scale
fix traction all lsm/traction face_lower face_upper $(120e6*v_scale:%.17g) v_shear
fix move all lsm/nve viscosity 1
timestep 1e-9
run 0 post no
timestep $(0.5*f_move[2]:%.17g)
compute ruptures all lsm/events sides below above faces face_lower face_upper history box.slip.bin ruptures box.ruptures.csv bin ${{dx}} &
  interval 2 driving $(1e-3*v_scale) slipping 1 modulus $(v_mu:%.17g) pause 0.5 unfinished yes ledger yes progress no overwrite yes
thermo_style custom step c_ruptures[6] c_ruptures[9] c_ruptures[11] c_ruptures[12] c_ruptures[15]
variable steps equal round(30/dt)
run ${{steps}}
variable all equal c_ruptures[9]+c_ruptures[12]
print "waves ${{all}} work $(c_ruptures[15]-c_ruptures[6]) friction $(c_ruptures[11])"
"""


def sources(path, *more):
    run(SCRIPT, path, "--no-picture --overwrite", *more)
    return read_catalogue(path.replace(".ruptures.", ".sources."))


@pytest.mark.parametrize("dx", [400, 200])
def test_energies_of_a_rupture_are_those_of_the_ledger(lmp, work, dx):
    """At the end the blocks rest: what waves had went to viscosity, and work of the prescribed stresses less that stored in links is the
    work of stress on the slip."""
    (work / "box.in").write_text(BOX)
    said = run(lmp, ["-in", "box.in", "-var", "dx", dx]).printed(r"^waves (\S+) work (\S+) friction (\S+)$")
    waves, done, friction = map(float, said.groups())
    found = {name: values[0] for name, values in sources("box.ruptures.csv")[1].items()}
    assert found["stress_work"] == pytest.approx(done, rel=0.003) and found["friction_work"] == pytest.approx(friction, rel=1e-3)
    assert found["radiated_energy"] == pytest.approx(waves, rel=0.02)
    # The law takes up 0.5 (0.677 - 0.525) 120e6 Dc on 6 km, scaled.
    assert found["fracture_energy"] == pytest.approx(0.5 * 0.152 * 1200 * 0.05e-5 * 6000, rel=0.2)
    assert found["source_duration"] == pytest.approx(3.6, rel=0.05)


def test_drops_of_pe_are_the_work_of_their_ruptures(lmp, work):
    """On the mean; single ruptures begin before a drop or end after it."""
    run(lmp, scene("fault.in", prefix="a", preset="absorbing", length=30, width=15, seed=3, steps=80000, ruptures="yes", velocity=0.002))
    drops, ruptures = read_catalogue("a.catalogue.csv")[1], sources("a.ruptures.csv")[1]
    work_of = np.array([ruptures["stress_work"][(ruptures["t_end"] > begin) & (ruptures["t_start"] < end)].sum()
                        for begin, end in zip(drops["t_start"], drops["t_end"])])  # yapf: disable
    large = drops["size"] > 0.1
    ratio = work_of[large] / drops["size"][large]
    assert len(ratio) > 20 and 0.6 < ratio.min() and ratio.max() < 1.7
    assert work_of[large].sum() == pytest.approx(drops["size"][large].sum(), rel=0.05)
