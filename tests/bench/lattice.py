#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Time of a node and step of the cubic lattice without friction, in LAMMPS with our and its own links, and in ESyS-Particle.

lattice.py LMP FOLDER [--side NODES] [--rounds N] [-o FILE.csv]

LMP has the packages LSM, BPM and MOLECULE. One rank each; the programs take turns, in rounds, and medians are written: ns of a node
and step, and the median over the rounds of the ratio to ours. ESyS-Particle (Debian package esys-particle) is left out where it is
missing.
"""
import argparse
import csv
import re
import shutil
import statistics
import sys
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent.parent / "inputs")]
from programs import Program, run  # noqa: E402
from run import MPI  # noqa: E402

# steps: shares of --steps, so that each takes about as long
PROGRAMS = {
    "linked": ("lsm/linked, springs", 4), "dashpots": ("lsm/linked, springs and dashpots", 3), "harmonic": ("LAMMPS, bond harmonic", 1),
    "bpm": ("LAMMPS, bond bpm/spring", 1), "esys": ("ESyS-Particle, NRotBond", 0.25)
}


def convert(source, target, side):
    """The lattice for ESyS-Particle."""
    section, atoms, links = "", [], []
    for line in Path(source).read_text().splitlines():
        cells = line.split()
        if line[:1].isupper():
            section = cells[0]
        elif section == "Atoms" and len(cells) > 7:
            atoms.append(f"{cells[2]} {cells[3]} {cells[4]} {float(cells[6]) / 2:.6g} {cells[0]} {cells[1]}")
        elif section == "Bonds" and len(cells) == 4:
            links.append(f"{cells[2]} {cells[3]} {cells[1]}")
    head = [
        "LSMGeometry 1.2", f"BoundingBox {-side} {-side} {-side} {side} {side} {side}", "PeriodicBoundaries 0 0 0", "Dimension 3D", "BeginParticles",
        "Simple"
    ]
    Path(target).write_text("\n".join([*head, f"{len(atoms)}", *atoms, "EndParticles", "BeginConnect", f"{len(links)}", *links, "EndConnect", ""]))


def main(lmp, folder, side, steps, rounds, output):
    folder.mkdir(parents=True, exist_ok=True)
    lammps = Program("lmp", lmp.resolve(), "-log", "none", "-in", HERE / "lattice.in", env=MPI)
    run(lammps, ["-var", "links", "made", "-var", "side", side], cwd=folder)
    esys = shutil.which("esysparticle")
    if esys:
        convert(folder / "lattice.data", folder / "lattice.geo", side)
    else:
        print("no ESyS-Particle (Debian package esys-particle), left out", file=sys.stderr)
    took = {name: [] for name in PROGRAMS if name != "esys" or esys}
    for _ in range(rounds):
        for name in took:
            many = max(2, round(steps * PROGRAMS[name][1]))
            if name == "esys":
                program = Program("esys", "mpirun", "-np", "2", esys, HERE / "esys_lattice.py", env={**MPI, "OMPI_MCA_orte_create_session_dirs": "1"})
                said = run(program, ["lattice.geo", side, many, 2], cwd=folder).out
            else:
                said = run(lammps, ["-var", "links", name, "-var", "steps", many], cwd=folder).out
            loop = re.findall(r"^Loop time of (\S+) .*for (\d+) steps with (\d+) atoms", said, re.M)[-1]
            took[name].append(1e9 * float(loop[0]) / int(loop[1]) / int(loop[2]))
    rows = [
        dict(program=PROGRAMS[name][0], nodes=loop[2], ns=f"{statistics.median(times):.4g}", least=f"{min(times):.4g}",
             over_ours=f"{statistics.median(a / b for a, b in zip(times, took['linked'])):.3g}") for name, times in took.items()
    ]
    with open(output, "w", newline="") if output else sys.stdout as file:
        table = csv.DictWriter(file, rows[0], lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lmp", metavar="LMP", type=Path)
    parser.add_argument("folder", metavar="FOLDER", type=Path)
    parser.add_argument("--side", type=int, default=48)
    parser.add_argument("--steps", type=int, default=100)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("-o", "--output", metavar="FILE")
    main(**vars(parser.parse_args()))
