# SPDX-License-Identifier: GPL-2.0-or-later
"""What the runs have; results/walk.py puts their seeds together."""


def numbers(run):
    return {"count": f"count {run.catalogue} --size 1e-4"}


def table(run, found):
    return dict(events=found.count.catalogues[0].events, largest=found.count.catalogues[0].largest)


def costs(run, found):
    return dict(cpu_s=found.done.cpu_s)
