# SPDX-License-Identifier: GPL-2.0-or-later
"""What is kept of each point; calibrate.py picks its PE with several memories."""
from default import costs


def numbers(run):
    return {"count": f"count {run.catalogue} --size 1e-3 --size 1e-2"}


def table(run, found):
    return dict(events=found.count.catalogues[0].events, largest=found.count.catalogues[0].largest)
