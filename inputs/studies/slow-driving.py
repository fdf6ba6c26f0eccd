# SPDX-License-Identifier: GPL-2.0-or-later
"""exponent: sizes 1e-3 to 1e-1, long: 1e-3 to 1, from_2: 1e-2 to 1; gamma: inter-event times of events >= 1e-3 (>= 1e-2), delta = 1;
p: two-sample tests against the first run, times as displacements of the plates; after_100, before_100: events >= 1e-3 within 100
time units of a main shock, per main shock; after_displacement, before_displacement: those later or earlier than that, up to a
displacement of 0.04; same: how many of the events >= 1e-2 of the first run (of) are matched here within a displacement of 0.02 and
a factor of 2 in size, and how many by chance."""
from recipes import fit_command, joined, ratio, times_command

reference = "2.5e-4_no_leaps"
drawings = ["slow-driving"]


def numbers(run):
    end = f"--to {1200 + 18 / run.shorten / run['velocity']:.15g}"  # compression; then the plates move, over 150 time units up to their velocity
    window = f"--window {0.04 / run['velocity']:.15g} --first 1"
    return {
        "count": f"count {run.catalogue} {end}",
        "fit": fit_command(run.catalogue, end, "--range 1e-3:1e-1 --range 1e-3:1 --range 1e-2:1"),
        "times_small": times_command(run.catalogue, end, "--threshold 1e-3"),
        "times_large": times_command(run.catalogue, end, "--threshold 1e-2"),
        "around": f"sequences.py {run.catalogue} {end} --threshold 1e-3 --main-size 0.1 {window}",
    }


def comparisons(run, reference):
    end = f"--to {18 / run.shorten + 1200 * run['velocity']:.15g}"
    return {
        "compare": f"compare {reference} {run.catalogue} --displacement --threshold 1e-3 {end} -o OUT",
        "match": f"match.py {reference} {run.catalogue} --origin 1200 --threshold 1e-2 --within 0.02 {end}",
    }


def table(run, found):
    all_of, sizes, fits, tests, match = found.count.catalogues[0], found.count.sizes, found.fit.fits, found.compare.tests, found.match.matches[0]
    small, large, shocks = found.times_small.fits[0], found.times_large.fits[0], found.around.sequences[0].main_shocks
    early, late = ([one for one in found.around.rates if (one.bin_hi < 101) == soon] for soon in (True, False))
    near = {f"{side}_100": ratio(sum(one[key] for one in early), shocks) for side, key in (("after", "count"), ("before", "before"))}
    far = {f"{side}_displacement": ratio(sum(one[key] for one in late), shocks) for side, key in (("after", "count"), ("before", "before"))}
    return dict(displacement=run["velocity"] * (all_of.last_end - 1200), steps_taken=all_of.last_step, events_4=sizes[0].events,
                events_3=sizes[1].events, events_2=sizes[2].events, events_1=sizes[3].events, largest=all_of.largest, released=sizes[1].released,
                exponent=fits[0].exponent, exponent_error=fits[0].standard_error, long=fits[1].exponent, long_error=fits[1].standard_error,
                from_2=fits[2].exponent, from_2_error=fits[2].standard_error, gamma=small.gamma, gamma_error=small.gamma_error, gamma_2=large.gamma,
                gamma_2_error=large.gamma_error, share_small=1 - ratio(sizes[2].events, sizes[1].events), share_in_events=all_of.share_in_events,
                p_size=tests[0].p, p_time=tests[1].p, of=match.n_first, same=match.same, chance=match.chance, main_shocks=shocks, **near, **far,
                steps_per_large=ratio(all_of.last_step, sizes[2].events))


def costs(run, found):
    cpu, last = found.done.cpu_s, found.count.catalogues[0].last_end
    return dict(cpu_s=cpu, cpu_s_per_large=ratio(cpu, found.count.sizes[2].events), model_time_per_cpu_s=ratio(last, cpu))


tables = {"around": lambda study: joined(study, lambda found: found.around.rates)}
