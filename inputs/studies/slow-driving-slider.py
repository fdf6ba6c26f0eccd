# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers from a plate displacement of 120 on. events: per displacement of 1000; exponent: sizes 1 to 100; gamma: inter-event times
of events >= 1 (>= 100), delta = 1; p: two-sample tests of sizes >= 1 and of the displacements between them against the run without
leaps of the same chain and velocity, if there is one; steps: those computed, neither jumped nor leapt over."""
from recipes import fit_command, ratio, times_command

reference = "{blocks}_{seed}_{velocity}_0"
drawings = ["slow-driving-slider"]


def numbers(run):
    begin = f"--from {120 / run.shorten / run['velocity']:.15g}"
    return {
        "whole": f"count {run.catalogue} --size 100",
        "count": f"count {run.catalogue} {begin} --size 0.01 --size 1 --size 100 --size 1000",
        "fit": fit_command(run.catalogue, begin, "--range 1:100"),
        "times_1": times_command(run.catalogue, begin, "--threshold 1"),
        "times_100": times_command(run.catalogue, begin, "--threshold 100"),
    }


def comparisons(run, reference):
    return {"compare": f"compare {reference} {run.catalogue} --displacement --threshold 1 --from {120 / run.shorten:.15g} -o OUT"}


def table(run, found):
    sizes, summary = found.count.sizes, found.summary
    displacement = summary.time * run["velocity"] - 120 / run.shorten
    steps = summary.steps - summary.steps_jumped - summary.get("steps_leapt", 0)
    events = {f"events_{size}": ratio(1000 * sizes[n].events, displacement) for n, size in enumerate((0.01, 1, 100, 1000))}
    return dict(displacement=displacement, **events, largest=found.count.catalogues[0].largest, exponent=found.fit.fits[0].exponent,
                exponent_error=found.fit.fits[0].standard_error, gamma=found.times_1.fits[0].gamma, gamma_error=found.times_1.fits[0].gamma_error,
                gamma_100=found.times_100.fits[0].gamma, gamma_100_error=found.times_100.fits[0].gamma_error,
                share_small=1 - ratio(sizes[1].events, sizes[0].events), p_size=found.compare.tests[0].p, p_time=found.compare.tests[1].p,
                leaps=summary.get("leaps", 0), steps=steps, steps_per_100=ratio(steps, found.whole.sizes[0].events))


def costs(run, found):
    return dict(cpu_s=found.done.cpu_s, model_time_per_cpu_s=ratio(found.summary.time, found.done.cpu_s))
