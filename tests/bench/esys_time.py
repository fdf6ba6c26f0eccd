# SPDX-License-Identifier: GPL-2.0-or-later
"""Times the steps of a simulation by ESyS-Particle."""
import time


def time_steps(simulation, warmup, steps):
    """Runs the steps to its end, and prints how long those after the warm-up took, as LAMMPS does."""
    simulation.setNumTimeSteps(warmup + steps)
    for step in range(warmup):
        simulation.runTimeStep()
    start = time.time()
    for step in range(steps):
        simulation.runTimeStep()
    print("Loop time of %.6f for %d steps with %d atoms" % (time.time() - start, steps, simulation.getNumParticles()), flush=True)
    simulation.exit()
