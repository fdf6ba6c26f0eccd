# SPDX-License-Identifier: GPL-2.0-or-later
# A fault in ESyS-Particle like that of inputs/fault.in with hold = position: masses r^2, viscosity,
# friction between the blocks, plates driven at constant speed. Arguments: NAME.geo, length, time
# step, viscosity, driving velocity of each plate, friction, its spring, steps. PE of links and
# contacts at every step is written to NAME.esys.links and NAME.esys.contacts, CPU time to
# NAME.esys.json.
import json
import math
import os
import sys
from esys.lsm import (DampingPrms, InteractionScalarFieldSaverPrms, LsmMpi, NRotBondPrms, NRotFrictionPrms)
from esys.lsm.util import BoundingBox, Vec3

name = sys.argv[1]
length, dt, viscosity, velocity, mu, kt = map(float, sys.argv[2:8])
steps = int(sys.argv[8])
ramp = 150


def worker_time():
    """CPU time (s) of the other process of this run, which does the computation."""
    for entry in os.listdir("/proc"):
        if not entry.isdigit() or int(entry) == os.getpid():
            continue
        try:
            with open("/proc/%s/stat" % entry) as stat:
                text = stat.read()
        except OSError:
            continue
        fields = text[text.rindex(")") + 2:].split()
        if fields[1] == str(os.getppid()) and "esysparticle" in text:
            return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    return 0.0


simulation = LsmMpi(numWorkerProcesses=1, mpiDimList=[1, 1, 1])
simulation.initNeighbourSearch(particleType="NRotSphere", gridSpacing=2.5, verletDist=0.2)
simulation.setSpatialDomain(BoundingBox(Vec3(0, -10, -5), Vec3(length, 40, 5)), circDimList=[True, False, False])
simulation.force2dComputations(True)
simulation.setTimeStepSize(dt)
simulation.readGeometry(name + ".geo")
# The mass of a disc of radius r is density pi r^2. Plates are so heavy that no force moves them:
# non-dynamic particles do not move whatever their velocity (version 2.3.5), and with
# moveTaggedParticlesBy a step takes ten times as long.
for tag in range(1, 7):
    simulation.setParticleDensity(tag, -1, (1 if tag < 5 else 1e12) / math.pi)
simulation.createInteractionGroup(NRotBondPrms(name="links", normalK=1.0, breakDistance=10.0, tag=0, scaling=False))
# createInteractionGroupTagged ignores tags with this friction (version 2.3.5), so that all discs
# not joined by a link have contacts, as with contacts = all in inputs/fault.in.
simulation.createInteractionGroup(NRotFrictionPrms(name="contacts", normalK=1.0, dynamicMu=mu, shearK=kt, scaling=False))
simulation.createExclusion("links", "contacts")
simulation.createInteractionGroup(DampingPrms(type="Damping", name="viscosity", viscosity=viscosity, maxIterations=50))
for group in ("links", "contacts"):
    simulation.createFieldSaver(
        InteractionScalarFieldSaverPrms(interactionName=group, fieldName="potential_energy", fileName=name + ".esys." + group, fileFormat="SUM",
                                        beginTimeStep=0, endTimeStep=steps, timeStepIncr=1))
simulation.setNumTimeSteps(steps)
for step in range(steps):
    if step % 5 == 0:  # damping slows the plates down, too
        share = min(1.0, step * dt / ramp) * (1 + 2.5 * viscosity * dt)
        for tag, side in ((5, -1), (6, 1)):
            simulation.setTaggedParticleVelocity(tag, Vec3(side * share * velocity, 0, 0))
    if step % 1000 == 0:
        print("step %d of %d" % (step, steps), flush=True)
    simulation.runTimeStep()
with open(name + ".esys.json", "w") as summary:
    json.dump({"steps": steps, "cpu_s": worker_time()}, summary)
simulation.exit()
