# SPDX-License-Identifier: GPL-2.0-or-later
"""Catalogues for the tests of commands that draw, and what their files hold."""
import os
import re
from pathlib import Path

import numpy as np
from data_files import write_catalogue


def pictures(*bases, endings=("csv", "gp", "png", "svg")):
    """Asserts that all files of each picture exist and are not empty."""
    for base in bases:
        for ending in endings:
            assert os.path.getsize(f"{base}.{ending}") > 0, f"{base}.{ending} is empty"


def fault(path, sizes, length=120, times=None, **head):
    n = len(sizes)
    write_catalogue(path, np.arange(n) * 10 if times is None else times, sizes, dict(model="lsm", **head, length=length))


def slider(path, sizes, **head):
    write_catalogue(path, np.arange(len(sizes)) * 10, sizes, dict(model="block-slider", **head, blocks=256))


def said(path, *patterns):
    """The text of a file, which must contain all these patterns."""
    text = Path(path).read_text()
    for pattern in patterns:
        assert re.search(pattern, text, re.M), f"no '{pattern}' in {path}"
    return text


def ruptures(path="r.csv"):
    """Writes ruptures, one after the other, with a moment of 0.1 L^2 and drops of PE of 0.05 times the moment;
    two more overlap with the largest one."""
    i = np.arange(1, 40)
    lines = [(10 * n, 10 * n + 5, n, 0.005 * n * n) for n in i] + [(402, 404.5, 30, 0.4), (400, 405, 40, 8), (401, 405, 25, -0.2),
                                                                   (500, 505, 120, 72)]
    t, end, long, drop = np.array(lines, float).T
    moment, n = 0.1 * long**2, len(lines)
    write_catalogue(path, t, moment / 100, dict(model="lsm", length=120, events="ruptures"), t_end=end, pe_start=[100] * n, pe_end=100 - drop,
                    slip_moment=moment, x_centroid=[60] * n, rupture_length=long.astype(int), x_hypocentre=[60.5] * n, x_begin=[60] * n,
                    mean_slip=0.1 * long, stress_drop=[0.003] * n)
