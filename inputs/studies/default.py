# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of a study that has no recipe NAME.py of its own. The first loading of faults is left out."""
from recipes import fit_command, times_command


def numbers(run):
    window = f"--from {run.loaded:.15g}" if run.loaded else ""
    return {
        "count": f"count {run.catalogue} {window}",
        "fit": fit_command(run.catalogue, window),
        "times": times_command(run.catalogue, window),
    }


def table(run, found):
    all_of, fit, times = found.count.catalogues[0], found.fit.fits[0], found.times.fits[0]
    return dict(events=all_of.events, from_time=run.loaded, last_time=all_of.last_end, largest=all_of.largest, share_in_events=all_of.share_in_events,
                exponent=fit.exponent, exponent_error=fit.standard_error, from_size=fit.lo, to_size=fit.hi, mean_time=found.times.times[0].mean,
                gamma=times.gamma, gamma_error=times.gamma_error)


def costs(run, found):
    return dict(steps=found.done.steps, cpu_s=found.done.cpu_s)


def pages(study):
    return {"report": dict(title="All runs", begin=lambda run: run.loaded)}
