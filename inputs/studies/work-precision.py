# SPDX-License-Identifier: GPL-2.0-or-later
"""exponent: sizes 1e-3 to 1; gamma: inter-event times of events >= 1e-3; p: two-sample tests against the same packing in the first
line; bursts: events >= 1e-3 of at most 3 steps, a sign of an unstable time step. differences.csv: means over the packings; relative
for rate, rate_2 and released."""
from recipes import fit_command, log, over_seeds, ratio, times_command

reference = "0.03_0_located_{seed}"
drawings = ["work-precision"]


def _end(run):
    return f"--to {1200 + 72000 / run.shorten:.15g}"


def numbers(run):
    return {
        "count": f"count {run.catalogue} {_end(run)} --brief 3",
        "fit": fit_command(run.catalogue, _end(run), "--range 1e-3:1"),
        "times": times_command(run.catalogue, _end(run), "--threshold 1e-3"),
    }


def comparisons(run, reference):
    return {"compare": f"compare {reference} {run.catalogue} {_end(run)} --threshold 1e-3 -o OUT"}


def table(run, found):
    sizes, fit, times, tests = found.count.sizes, found.fit.fits[0], found.times.fits[0], found.compare.tests
    return dict(events_4=sizes[0].events, events_3=sizes[1].events, events_2=sizes[2].events, events_1=sizes[3].events,
                largest=found.count.catalogues[0].largest, released=sizes[1].released, exponent=fit.exponent, exponent_error=fit.standard_error,
                gamma=times.gamma, gamma_error=times.gamma_error, p_size=tests[0].p, p_time=tests[1].p, bursts=sizes[1].brief)


def costs(run, found):
    return dict(cpu_s=found.done.cpu_s)


def _means(run, found):
    sizes, cpu = found.count.sizes, found.done.cpu_s
    return dict(time_per_core_hour=ratio(3600 * 72000 / run.shorten, cpu), large_per_core_hour=ratio(3600 * sizes[2].events, cpu),
                bursts=sizes[1].brief)


def _differences(run, found):
    sizes = found.count.sizes
    return dict(rate=log(sizes[1].events), rate_2=log(sizes[2].events), exponent=found.fit.fits[0].exponent, gamma=found.times.fits[0].gamma,
                released=log(sizes[1].released))


tables = {"differences": lambda study: over_seeds(study, _means, _differences)}
