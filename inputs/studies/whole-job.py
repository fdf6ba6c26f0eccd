# SPDX-License-Identifier: GPL-2.0-or-later
"""Events from 2500 time units of shear on, when the stress has reached its level. Plates that hold their position press more and more,
so that only the same span can be compared. p: two-sample tests against ours_0.06, events >= 1e-2; same: how many of these events
(of) have a match in ours_0.06 within 80 time units and a factor of 2 in size, and how many by chance. CPU time of ESyS-Particle:
that of the process that computes."""
from recipes import ratio

reference = "ours_0.06"


def _span(run):
    return 1200 + 2500 / run.shorten, 1200 + 27570 / run.shorten


def numbers(run):
    begin, end = _span(run)
    return {"count": f"count {run.catalogue} --from {begin:.15g} --to {end:.15g}"}


def comparisons(run, reference):
    begin, end = _span(run)
    return {
        "compare": f"compare {reference} {run.catalogue} --from {begin:.15g} --to {end:.15g} --threshold 1e-2 -o OUT",
        "match": f"match.py {run.catalogue} {reference} --from {begin:.15g} --to {2.5e-4 * end:.15g} --threshold 1e-2 --within {2.5e-4 * 80:.15g}",
    }


def table(run, found):
    sizes, tests, match = found.count.sizes, found.compare.tests, found.match.matches[0]
    return dict(events_3=sizes[1].events, events_2=sizes[2].events, events_1=sizes[3].events, released=sizes[1].released, p_size=tests[0].p,
                p_time=tests[1].p, of=match.n_first, same=match.same, chance=match.chance)


def costs(run, found):
    (begin, end), done = _span(run), found.done
    time = run["dt"] * done.steps
    return dict(steps=done.steps, cpu_s=done.cpu_s, time_per_core_hour=ratio(3600 * time, done.cpu_s),
                large_per_core_hour=ratio(3600 * found.count.sizes[2].events / (end - begin) * time, done.cpu_s))
