# SPDX-License-Identifier: GPL-2.0-or-later
"""Misfits over ten stations: arrivals in s; slip at the end, and slip rates below 1 Hz, relative."""
import shlex

from default import costs
from recipes import joined
from run import INPUTS

REFERENCE = shlex.quote(str(INPUTS / "reference/tpv5.csv"))


def numbers(run):
    return {
        "beside": f"rupture_3d.py {run.folder}/rupture.slip.bin --reference {REFERENCE}",
        "count": f"count {run.catalogue}",
    }


def table(run, found):
    off = found.beside.convergence[0]
    return dict(ruptures=found.count.catalogues[0].events, arrival=off.arrival, arrival_mean=off.mean, slip=off.slip, slip_max=off.slip_max,
                rate=off.rate_l2, rate_low=off.rate_low_l2)


def _stations(study):
    return joined(study, lambda found: [{key: one[key] for key in one if key != "run"} for one in found.beside.stations])


tables = {"stations": _stations}
