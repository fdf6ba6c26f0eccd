#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""convert.py NAME: from NAME.data, NAME.types.data and NAME.types.in, where links have one of 256 types by rest length, and NAME.geo for
ESyS-Particle."""
import sys
from pathlib import Path

TYPES, SHORTEST, WIDTH = 256, 0.2, 1.8


def convert(name):
    radius, particles, links, types, section, length = {}, [], [], [], "", "0"
    for number, line in enumerate(Path(f"{name}.data").read_text().splitlines()):
        cells = line.split()
        if line.endswith(" xhi"):
            length = cells[1]
        if number and line[:1].isupper():
            section = cells[0]
        if line.endswith("bond types"):
            line = f"{TYPES} bond types"
        elif section == "Atoms" and len(cells) > 7:
            radius[cells[0]] = float(cells[6]) / 2
            particles.append(f"{cells[2]} {cells[3]} 0 {radius[cells[0]]:.6g} {cells[0]} {cells[1]}")
        elif section == "Bonds" and len(cells) == 4:
            rest = radius[cells[2]] + radius[cells[3]]
            line = f"{cells[0]} {min(TYPES, 1 + int((rest - SHORTEST) / WIDTH * TYPES))} {cells[2]} {cells[3]}"
            links.append(f"{cells[2]} {cells[3]} 0")
        types.append(line)
    Path(f"{name}.types.data").write_text("\n".join(types) + "\n")
    Path(f"{name}.types.in").write_text("".join(f"bond_coeff {t} 0.5 {SHORTEST + (t - 0.5) / TYPES * WIDTH:.9f}\n" for t in range(1, TYPES + 1)))
    Path(f"{name}.geo").write_text("\n".join([
        "LSMGeometry 1.2", f"BoundingBox 0 -10 -5 {float(length):g} 40 5", "PeriodicBoundaries 1 0 0", "Dimension 2D", "BeginParticles", "Simple",
        f"{len(particles)}", *particles, "EndParticles", "BeginConnect", f"{len(links)}", *links, "EndConnect", ""
    ]))  # yapf: disable


if __name__ == "__main__":
    convert(sys.argv[1])
