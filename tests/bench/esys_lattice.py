# SPDX-License-Identifier: GPL-2.0-or-later
# The same lattice in ESyS-Particle. Arguments: NAME.geo, side, steps, warm-up; the tags of its links are those of lattice.in.
import sys
from esys.lsm import LsmMpi, NRotBondPrms
from esys.lsm.util import BoundingBox, Vec3
from esys_time import time_steps

name, side, steps, warmup = sys.argv[1], *map(int, sys.argv[2:5])
simulation = LsmMpi(numWorkerProcesses=1, mpiDimList=[1, 1, 1])
simulation.initNeighbourSearch(particleType="NRotSphere", gridSpacing=1.5, verletDist=0.2)
simulation.setSpatialDomain(BoundingBox(Vec3(-side, -side, -side), Vec3(side, side, side)))
simulation.setTimeStepSize(0.3)
simulation.readGeometry(name)
for tag, k in ((1, 1.0), (2, 0.5), (3, 0.25), (4, 1.0), (5, 0.5)):
    simulation.createInteractionGroup(NRotBondPrms(name="links%d" % tag, normalK=k, breakDistance=10.0, tag=tag, scaling=False))
time_steps(simulation, warmup, steps)
