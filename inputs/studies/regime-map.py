# SPDX-License-Identifier: GPL-2.0-or-later
"""long: events picked with a memory of 3 time units; those of the run are picked with the default. exponents: sizes 1e-4 to 1e-1 and
1e-3 to 1e-1; gamma and B: inter-event times of events >= 1e-3, delta = 1 (maximum likelihood)."""
from lsm import LOADING
from recipes import fit_command, times_command

drawings = ["regime-map"]


def numbers(run):
    begin = f"--from {LOADING / run.shorten:.15g}"
    ranges, threshold = "--range 1e-4:1e-1 --range 1e-3:1e-1", "--threshold 1e-3"
    long = f"pick {run.folder}/fault.pe.bin --memory-time 3 --overwrite -o OUT.picked.csv && {run.postproc}"
    return {
        "shape": f"lsm.regime {run.folder}/fault.pe.bin --catalogue {run.catalogue} {begin}",
        "count": f"count {run.catalogue} {begin}",
        "fit": fit_command(run.catalogue, begin, ranges),
        "times": times_command(run.catalogue, begin, threshold),
        "long_count": f"{long} count OUT.picked.csv {begin}",
        "long_fit": f"{long} {fit_command('OUT.picked.csv', begin, ranges)}",
        "long_times": f"{long} {times_command('OUT.picked.csv', begin, threshold)}",
    }


def _statistics(count, fit, times):
    return {
        "events": count.catalogues[0].events,
        "from_1e-4": count.sizes[0].events,
        "from_1e-3": count.sizes[1].events,
        "exponent_4": fit.fits[0].exponent,
        "error_4": fit.fits[0].standard_error,
        "exponent_3": fit.fits[1].exponent,
        "error_3": fit.fits[1].standard_error,
        "gamma": times.fits[0].gamma,
        "gamma_error": times.fits[0].gamma_error,
        "B": times.fits[0].B,
    }


def table(run, found):
    shape = found.shape
    row = dict(
        torn=found.done.get("failed"),
        saw_tooth=shape.saw_tooth or (1 if shape else shape),  # PE only rises: nothing slips
        drop_over_load=shape.drop_over_load,
        time_in_events=shape.time_in_events,
        mean_duration=shape.mean_duration)
    long = _statistics(found.long_count, found.long_fit, found.long_times)
    return row | _statistics(found.count, found.fit, found.times) | {f"long_{key}": value for key, value in long.items() if key != "from_1e-4"}
