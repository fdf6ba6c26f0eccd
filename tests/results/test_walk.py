# SPDX-License-Identifier: GPL-2.0-or-later
"""Statistics of the study walk that are computed without postproc, compared with those of postproc."""
import math
import random
import sys

import pytest
from programs import SOURCE

sys.path.insert(0, str(SOURCE / "results"))
import walk  # noqa: E402
from lsm import summary  # noqa: E402

CATALOGUES = sorted((walk.RESULTS / "walk").glob("chain-512_?.catalogue.csv.xz"))


def test_exponents_are_those_of_postproc(postproc):
    assert CATALOGUES
    row, = summary.rows_of(postproc.path, CATALOGUES[:1], ranges=("1:10", "10:100"))
    found = walk.exponents([walk.events_of(CATALOGUES[0])["size"]], 1.0)
    assert found["exponent_0"][0] == pytest.approx(float(row["exponent_1:10"]), abs=1e-4)
    assert found["exponent_1"][0] == pytest.approx(float(row["exponent_10:100"]), abs=1e-4)


def test_exponent_of_a_known_density():
    draw = random.Random(1)
    sizes = [(1 + draw.random() * (10**-0.5 - 1))**-2 for _ in range(20000)]  # s^-1.5 from 1 to 10
    assert walk.exponent(sizes, 1.0, 10.0) == pytest.approx(1.5, abs=0.05)
    assert math.isnan(walk.exponent(sizes[:10], 1.0, 10.0))


def test_distance_is_that_of_kolmogorov_and_smirnov():
    assert walk.distance([1, 2, 3, 4], [1, 2, 3, 4]) == 0
    assert walk.distance([1, 2], [3, 4]) == 1
    assert walk.distance([1, 3], [2, 4, 5, 6]) == pytest.approx(0.75)
