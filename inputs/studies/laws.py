# SPDX-License-Identifier: GPL-2.0-or-later
"""Events >= 1e-3, once the fault is loaded. Main shocks: >= 0.1, the largest within the time in which the plates move by 0.0075 (3e4
time units at a thousandth of the paper's velocity) before and after. omori: from 300 time units on, when the ringing of the blocks
is over; around: from 1 on. near, far: events per main shock within 300 time units and beyond. distance: of the times over their
mean to those of Southern California. saw_tooth: from PE against steps."""
from default import costs
from recipes import fit_command, ratio, times_command


def _loaded(run):
    return 1200 + 1.7 / run["velocity"] / run.shorten  # PE rises while the plates move by this


def numbers(run):
    begin = f"--from {_loaded(run):.15g}"
    shocks = f"sequences.py {run.catalogue} {begin} --threshold 1e-3 --main-size 0.1 --window {0.0075 / run['velocity']}"
    return {
        "shape": f"lsm.regime {run.folder}/fault.pe.bin {begin}",
        "count": f"count {run.catalogue} {begin} --size 1e-4 --size 1e-3 --size 1e-2 --size 0.1",
        "fit": fit_command(run.catalogue, begin, "--range 1e-3:1"),
        "times": times_command(run.catalogue, begin, "--threshold 1e-3"),
        "omori": f"{shocks} --first 300",
        "around": f"{shocks} --first 1",
        "beside": f"nature.py {run.postproc} {run.catalogue} {begin} --threshold 1e-3",
    }


def table(run, found):
    all_of, sizes, fit, times, clustering = (found.count.catalogues[0], found.count.sizes, found.fit.fits[0], found.times.fits[0],
                                             found.times.clustering[0])
    nature, far, near = found.beside.models[1], found.omori.sequences[0], found.around.sequences[0]
    return dict(span=all_of.last_end - _loaded(run), events=sizes[1].events, large=sizes[3].events, largest=all_of.largest,
                saw_tooth=found.shape.saw_tooth, exponent=fit.exponent, exponent_error=fit.standard_error, gamma=times.gamma,
                gamma_error=times.gamma_error, burstiness=clustering.finite_burstiness, memory=clustering.memory, memory_p=clustering.memory_p,
                distance=nature.distance, distance_error=nature.distance_error, b=nature.b, b_error=nature.b_error, main_shocks=far.main_shocks,
                after_near=ratio(near.events - far.events, far.main_shocks), before_near=ratio(near.before - far.before, far.main_shocks),
                after_far=ratio(far.events, far.main_shocks), before_far=ratio(far.before, far.main_shocks), aftershocks=far.events, omori_p=far.p)
