# SPDX-License-Identifier: GPL-2.0-or-later
"""The fault scenes as the README describes them, with small settings."""
import json
import os
import re
import shutil
import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from data_files import header, read_catalogue, read_dump, read_series, rows, same_bytes
from programs import INPUTS, SOURCE, Program, refused, run, scene

sys.path.insert(0, str(SOURCE / "python"))
import lsm  # noqa: E402
from lsm.regime import of_run  # noqa: E402


def last_line(result):
    """The last line of the last thermo table of the scene."""
    table = re.findall(r"^ *Step .*Events.*?\n(.*?)^Loop", result.out, re.S | re.M)[-1]
    return np.array([line.split() for line in table.splitlines() if len(line.split()) == 8][-1], float)


def particles(result):
    return int(re.search("^Created ([0-9]+) particles", result.out, re.M)[1])


def test_fault_120(on_ranks, postproc):
    """On two ranks, from another folder, there are events, and a shear stress that friction can bear."""
    said = run(on_ranks(2), scene("fault_120.in", settle=10000, steps=35000, velocity=0.003, prefix="short", location="yes"))
    for name in "short.catalogue.csv", "short.pe.bin", "short.restart.end":
        assert Path(name).exists()
    _, events = read_catalogue("short.catalogue.csv")
    columns = list(events.values())
    assert len(events["size"]) >= 3
    # Sizes are positive, large drops slip forwards (small ones of waves may slip back), and the rupture is no longer than the fault.
    large = events["size"] >= 0.01
    assert (events["size"] > 0).all() and large.sum() >= 3 and (columns[8][large] > 0).all() and (columns[9] >= 0).all()
    assert (columns[9] <= 120).all() and (columns[10] <= 120).all()
    assert 0.5 < last_line(said)[6] < 0.8, "shear/normal stress"
    # Picking the series gives the events that the run picked, and it can be drawn.
    run(postproc, "pick short.pe.bin -o picked.csv")
    assert rows("picked.csv") == [",".join(row.split(",")[:8]) for row in rows("short.catalogue.csv")]
    if shutil.which("gnuplot"):
        run(postproc, "series short.pe.bin -o picture")
        assert os.path.getsize("picture.png") > 0 and os.path.getsize("picture.svg") > 0


def test_the_first_command_has_enough_of_lammps(lmp, work):
    """lmp_fault, for which a third of LAMMPS is compiled, gives the bytes of lmp, and says what it lacks."""
    small = Program.built("lmp_fault", "-log", "none", env=lmp.env, errors=lmp.errors)
    for name, program in ("whole", lmp), ("small", small):
        (work / name).mkdir()
        run(program, scene(length=24, settle=400, steps=3000, velocity=0.005, ruptures="yes"), cwd=work / name)
    for path in sorted((work / "whole").iterdir()):
        same_bytes(path, work / "small" / path.name)
    refused(small, scene(length=24, extra="fault_image"), "Unrecognized dump style 'image'; lmp_fault has only what a fault needs, use lmp")
    for line, said in ("fix 1 all langevin 1 1 1 1", "fix style 'langevin'"), ("write_data none", "command: write_data"), ("region 1 sphere 0 0 0 1",
                                                                                                                           "region style 'sphere'"):
        Path("more.in").write_text(f"region box block 0 1 0 1 0 1\ncreate_box 1 box\n{line}\n")
        refused(small, "-in more.in", f"Un.* {said}.*; lmp_fault has only what a fault needs, use lmp")


def test_lists_that_are_added_to_do_not_change_the_motion(lmp, work):
    """The fault moves as with lists that LAMMPS builds anew in each step in which a disc has moved by half the skin: ghosts that do not reach
    farther leave no room for adding. As the order of sums differs and rounding grows, both begin anew from the same state in intervals. In a
    contact that is found late (checks every 10 steps, no adding) energies differ by 4e-6 at once."""
    Path("added.in").write_text("thermo_modify format float %.15g\n")
    Path("built.in").write_text("comm_modify mode single cutoff 2.45\nneigh_modify every 1\ninclude added.in\n")
    piece, first, last, worst = 5000, 5000, 55000, []

    def at_the_end(way, at, **more):
        return last_line(run(lmp, scene("fault_120.in", steps=at, prefix=f"{way}{at}", extra=work / way, **more)))

    settings = dict(preset="absorbing", checkpoint=1000000, velocity=0.002, series="no")
    at_the_end("added", first, **settings)
    for at in range(first + piece, last + 1, piece):
        start = f"added{at - piece}.restart.end"
        added, built = (at_the_end(way, at, restart=start) for way in ("added", "built"))
        worst.append((np.abs(added - built)[3:] / np.abs(built[3:])).max())
        Path(start).unlink()
    assert max(worst) < 1e-6 and np.median(worst) < 1e-10, worst


def regime(name):
    return of_run(lsm.read_series(f"{name}.pe.bin"), 3000, events=lsm.read_catalogue(f"{name}.catalogue.csv"))


def test_a_creeping_fault_is_told_apart(lmp):
    run(lmp, scene(preset="absorbing", length=60, steps=90000, stress=0.004, prefix="creeping"))
    found = regime("creeping")
    assert found["regime"] == "creep" and found["saw_tooth"] < 3 and found["time_in_events"] > 0.3


# Mean and standard deviation over 10 seeds
BANDS = (1.03, 0.09), (0.64, 0.14), (78, 13)


def test_statistics_of_a_short_fault(lmp, postproc):
    """Within 2.8 standard deviations of 10 seeds. A change of the last digits changes the events, but
    hardly ever this test: by chance once in 60 times. There is stick-slip."""
    run(lmp, scene("fault.in", preset="absorbing", length=60, steps=300000, seed=1, checkpoint=1000000, prefix="short"))
    events = read_catalogue("short.catalogue.csv")[1]
    found = regime("short")
    assert found["regime"] == "stick-slip" and found["saw_tooth"] > 5 and found["time_in_events"] < 0.3
    # A disc for which the time step is too large would oscillate from step to step, with an event each time.
    brief = (events["step_end"] - events["step_start"] <= 3) & (events["size"] >= 1e-4) & (events["step_end"] < 90000)
    assert not brief.any(), "the time step of the preset is unstable"
    run(postproc, "fit short.catalogue.csv --replicas 0 --no-comparison --no-picture --json fit.json")
    run(postproc, "intervals short.catalogue.csv --delta 1 --method likelihood --shortest 0 --replicas 0 --shuffles 0 "
        "--no-picture --json intervals.json")
    exponent, gamma = (json.loads(Path(name).read_text())["fits"][0] for name in ("fit.json", "intervals.json"))
    values = exponent["exponent"], gamma["gamma"], (events["size"] >= 1e-3).sum()
    for name, value, (mean, deviation) in zip(("exponent", "gamma", "events >= 1e-3"), values, BANDS):
        assert abs(value - mean) < 4 * deviation / 2**0.5, f"{name} is {value:.3g}, expected about {mean:.3g}"


@pytest.mark.parametrize("length", [120, 240, 480, 945, 1440, 1890])
def test_lengths(lmp, work, length):
    """Every length exists, and its scene can be read from its own folder as well. The paper has "about
    7800" particles for length 120; ours lacks the 260 loose ones. Their number is proportional to the
    length."""
    said = run(lmp, scene(f"fault_{length}.in", settle=0, steps=2, prefix=work / "l"), cwd=INPUTS)
    assert 61 * length < particles(said) < 65 * length


# ---- dumps and pictures


def test_dump(lmp):
    """Frames are written at the given steps, in a form that OVITO reads."""
    small = dict(length=120, settle=100, steps=60, prefix="d", series="no")
    discs = particles(run(lmp, scene(extra="fault_dump", **{"from": 120, "to": 160, "every": 20}, **small)))
    frames = sorted(Path().glob("d.*.dump"))
    assert [frame.name for frame in frames] == ["d.000000120.dump", "d.000000140.dump", "d.000000160.dump"]
    # Every disc occurs once, within the box, with a valid type and radius.
    for frame in frames:
        head = frame.read_text().splitlines()[:9]
        assert head[4] == "ITEM: BOX BOUNDS pp ff pp" and head[8].split() == "ITEM: ATOMS id type x y z radius vx vy".split()
        low, high = map(float, head[5].split())
        (step, _, values), = read_dump(frame)
        number, kind, x, _, z, radius, vx, _ = values.T
        assert step == int(frame.name.split(".")[1]) and len(values) == discs and high - low == 120
        assert (np.diff(number) > 0).all() and (x >= low).all() and (x <= high).all() and (z == 0).all()
        assert set(kind) == {1, 2, 3, 4, 5, 6} and (radius >= 0.1).all() and (radius <= 1).all()
        assert np.count_nonzero(vx) >= 0.9 * discs
    assert len({frame.read_text().split("\n", 9)[9] for frame in frames}) == 3, "frames are the same"
    # The dump does not change the run.
    os.rename("d.catalogue.csv", "with.csv")
    run(lmp, scene(overwrite="yes", **small))
    same_bytes("with.csv", "d.catalogue.csv")


def test_image(lmp):
    """Pictures of every fourth of 20 steps, and a single one."""
    small = dict(length=20, width=15, settle=100, steps=20, extra="fault_image", pixels=400, high=300)
    run(lmp, scene(prefix="film", **{"from": 102, "to": 118, "every": 4}, **small))
    run(lmp, scene(prefix="one", **{"from": 110, "to": 111, "every": 9}, **small))
    pictures = sorted(path.name for path in Path().glob("*.png"))
    assert pictures == [f"film.{step:09d}.png" for step in (102, 106, 110, 114, 118)] + ["one.000000110.png"]
    for name in pictures:
        assert Path(name).read_bytes()[1:4] == b"PNG" and os.path.getsize(name) > 5000


def test_energy(lmp, work):
    """Without friction and damping the springs exchange energy with motion and with the load only."""
    run(
        lmp,
        scene(preset="absorbing", length=20, width=15, settle=200, steps=4000, viscosity=0, impedance=0, velocity=0, law="coulomb 0 0", prefix="e",
              extra="fault_energy", sample=8))
    step, kinetic, approach, worked = np.loadtxt("e.energy.txt").T
    _, steps, _, pe = read_series("e.pe.bin")
    assert list(step) == list(range(200, 4201, 8))
    pe = pe[np.isin(steps, step)]
    exchanged, load = np.ptp(pe), 0.025 * 20 * approach
    assert np.ptp(kinetic) > 0.01 * exchanged
    assert np.ptp(worked - load) < 1e-4 * exchanged, "work of the plates is not that of the load"
    assert np.ptp(pe + kinetic - worked) < 0.02 * exchanged


# ---- links
LINKS = """compute links all property/local batom1 batom2
dump links all local 1 a.links c_links[1] c_links[2]
dump discs all custom 1 a.discs id type x y radius
dump_modify discs sort id format float %.15g
"""


def pulled(strain):
    """Chooses a disc of a.discs and a displacement along the fault that gives one of its links this strain."""
    (_, _, discs), = [frame for frame in read_dump("a.discs") if frame[0] == 0]
    (_, _, links), = [frame for frame in read_dump("a.links") if frame[0] == 0]
    at, radius = discs[:, 2:4], discs[:, 4]
    ends = links.astype(int) - 1  # IDs are 1 to the number of discs
    for disc in np.flatnonzero((discs[:, 1] == 1) & (abs(at[:, 0] - 10) < 2)):
        partners = ends[(ends == disc).any(axis=1)].sum(axis=1) - disc
        for far in np.arange(0, 6, 1e-3):
            apart = np.hypot(*(at[disc] + [far, 0] - at[partners]).T)
            most = abs(apart / (radius[disc] + radius[partners]) - 1).max()
            if most >= strain:
                assert most < strain + 0.02
                return disc + 1, far
    pytest.fail("no disc in the middle of the lower block")


def test_strained_links(lmp, work):
    """A link may be strained by up to 0.75, whatever is recorded; beyond, the run stops."""
    small = dict(length=20, width=15, settle=0, steps=3, dt=1e-4, prefix="a", ruptures="yes", overwrite="yes")
    Path("pull.in").write_text(LINKS)
    run(lmp, scene(extra=work / "pull", **small))
    for strain, status in (0.72, 0), (0.76, 1):
        disc, far = pulled(strain)
        Path("pull.in").write_text(f"group one id {disc}\ndisplace_atoms one move {far} 0 0\n")
        said = run(lmp, scene(extra=work / "pull", **small), status=status)
        stopped = re.findall(r"Run stopped at step .*: a link is strained by ([0-9.]+), above strainlimit 0\.75", said.out)
        assert len(stopped) == status and all(0.75 < float(by) < 0.79 for by in stopped), str(said)


# ---- contacts
PROBE = """group above type 2 4 6
displace_atoms above move 0 -0.5 0
group face type 3
displace_atoms face move 0.02 -0.05 0
compute types all property/local ptype1 ptype2 cutoff radius
compute push all pair/local force p2 cutoff radius
dump probe all local 1 ${prefix}.pairs c_types[1] c_types[2] c_push[1] c_push[2]
"""


@pytest.fixture
def probed(work):
    """A copy of the scenes with further input."""
    shutil.copytree(INPUTS, "scene")
    Path("scene/probe.in").write_text(PROBE)
    Path("scene/coefficients.in").write_text("write_coeff ${prefix}.coeff\n")
    return work / "scene/fault.in"


def test_contacts(lmp, probed):
    """Discs of one block cannot pass through those of the other, whether they are at the fault or behind it.
    The upper block is pushed into the lower one, and the face of the latter into the discs behind it: each
    overlapping pair of different blocks has to repel. So do pairs of the same block, unless only those at the
    fault have contacts, and they have friction unless they are smooth."""

    def pairs(contacts):
        run(lmp, scene(probed, length=60, settle=0, steps=1, prefix=contacts, extra="probe", contacts=contacts))
        frames = list(read_dump(f"{contacts}.pairs"))
        overlapping, repelling = Counter(), Counter()
        for one, other, push, _ in frames[0][2]:
            overlapping[tuple(sorted((int(one), int(other))))] += 1
            repelling[tuple(sorted((int(one), int(other))))] += push > 0
        last = frames[-1][2]
        within = (last[:, 0] - last[:, 1]) % 2 == 0
        tangential = last[:, 3] != 0
        return overlapping, repelling, np.count_nonzero(within & tangential), np.count_nonzero(~within & tangential)

    overlapping, repelling, _, _ = pairs("fault")
    for types in (1, 4), (2, 3), (3, 4):
        assert repelling[types] == overlapping[types] > 0, types
    assert overlapping[1, 3] > 0 and repelling[1, 3] == 0, "discs of one block"
    for contacts in "all", "smooth":
        overlapping, repelling, within, between = pairs(contacts)
        assert overlapping[1, 3] > 0 and repelling == overlapping, contacts
        assert between > 0 and (within > 0) == (contacts == "all"), contacts


def test_further_input(lmp, probed, work):
    """Further input is found by any name, also one with a path."""
    Path("scene/on-board_2.in").write_text('print "this was read"\n')
    for name in "on-board_2", "./on-board_2", "../scene/on-board_2", f"{work}/scene/on-board_2":
        said = run(lmp, scene(probed, length=30, settle=0, steps=0, prefix="named", overwrite="yes", extra=name))
        assert re.search("^this was read", said.out, re.M), name


def test_dashpots(lmp, probed):
    """All links and contacts have dashpots, also after a restart, and too long a time step is refused."""

    def damped(status=0, **more):
        said = run(lmp, scene(probed, settle=0, prefix="damped", extra="coefficients", **more), status=status)
        if status == 0:
            lines = [
                line for line in Path("damped.coeff").read_text().splitlines()
                if line.startswith(("pair_coeff", "bond_coeff")) and not line.endswith("off")
            ]
            assert len({line.split()[0] for line in lines}) == 2, lines
            assert all(" kelvin-voigt 0.05" in line for line in lines), f"a link or contact without dashpot: {lines}"
        return said

    for contacts in "all", "smooth", "fault":
        damped(length=30, steps=10, overwrite="yes", retardation=0.05, dt=0.03, contacts=contacts)
    assert header("damped.catalogue.csv")["kelvin_voigt"].startswith("0.05")
    damped(steps=20, restart="damped.restart.end")
    said = damped(length=30, steps=10, overwrite="yes", retardation=0.5, status=1)
    assert re.search("above the stability limit .* with kelvin-voigt", said.out)
