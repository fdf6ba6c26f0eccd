# SPDX-License-Identifier: GPL-2.0-or-later
# The same fault in ESyS-Particle without normal stress and viscosity; writes PE at every step.
# Arguments: NAME.geo, workers, steps.
import sys
from esys.lsm import (InteractionScalarFieldSaverPrms, LsmMpi, NRotBondPrms, NRotFrictionPrms)
from esys.lsm.util import BoundingBox, Vec3
from esys_time import time_steps

name, workers, length, steps, warmup = sys.argv[1], *map(int, sys.argv[2:6])
simulation = LsmMpi(numWorkerProcesses=workers, mpiDimList=[workers, 1, 1])
simulation.initNeighbourSearch(particleType="NRotSphere", gridSpacing=2.5, verletDist=0.2)
simulation.setSpatialDomain(BoundingBox(Vec3(0, -10, -5), Vec3(length, 40, 5)), circDimList=[True, False, False])
simulation.force2dComputations(True)
simulation.setTimeStepSize(0.03)
simulation.readGeometry(name + ".geo")
for tag in range(1, 7):
    simulation.setParticleDensity(tag, -1, 0.75)
for tag, velocity in ((5, -0.00025), (6, 0.00025)):
    simulation.setParticleNonDynamic(tag)
    simulation.setTaggedParticleVelocity(tag, Vec3(velocity, 0, 0))
simulation.createInteractionGroup(NRotBondPrms(name="links", normalK=1.0, breakDistance=10.0, tag=0, scaling=False))
# createInteractionGroupTagged ignores tags with this friction (version 2.3.5): without the
# exclusion linked discs would have contacts as well.
simulation.createInteractionGroup(NRotFrictionPrms(name="contacts", normalK=1.0, dynamicMu=0.6, shearK=1.0, scaling=False))
simulation.createExclusion("links", "contacts")
for group in ("links", "contacts"):
    simulation.createFieldSaver(
        InteractionScalarFieldSaverPrms(interactionName=group, fieldName="potential_energy", fileName=name + ".esys." + group, fileFormat="SUM",
                                        beginTimeStep=0, endTimeStep=warmup + steps, timeStepIncr=1))
time_steps(simulation, warmup, steps)
