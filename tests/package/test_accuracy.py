# SPDX-License-Identifier: GPL-2.0-or-later
"""Statistics of the accuracy report (tests/accuracy/event_statistics.py), and how it reads what lmp prints. The report takes minutes and is not
made here."""
import math
import sys

import numpy as np
import pytest
from programs import SOURCE

pytest.importorskip("scipy")
sys.path.insert(0, str(SOURCE / "tests/accuracy"))
import event_statistics as statistics  # noqa: E402
import fault_accuracy as accuracy  # noqa: E402
from event_statistics import Estimate  # noqa: E402


@pytest.mark.parametrize("gamma", [0.6, 1.0, 2.0])
def test_gamma_density_and_its_errors(gamma):
    """Fits to 200 samples: unbiased but for 3 / n, and their scatter is the stated standard error."""
    draw, n, fits = np.random.default_rng(1), 300, 200
    found = np.array([statistics.gamma_density(draw.gamma(gamma, 150.0, n)) for _ in range(fits)])  # fit, parameter, value or error
    for k, true in enumerate((gamma, 150.0)):
        scatter = found[:, k, 0].std()
        assert abs(found[:, k, 0].mean() - true) < true * 3 / n + 4 * scatter / math.sqrt(fits)
        assert found[:, k, 1].mean() / scatter == pytest.approx(1, abs=0.2)
    assert math.isnan(statistics.gamma_density([1.0, 2.0])[0].value)
    with pytest.raises(ValueError):
        statistics.gamma_density([0.0] * 20)


def test_exponent_and_its_error():
    draw, fits = np.random.default_rng(1), 200
    for alpha in 0.6, 1.5:
        # s^-alpha from 1 to 100
        found = np.array(
            [statistics.exponent((1 + draw.random(400) * (100**(1 - alpha) - 1))**(1 / (1 - alpha)), 1.0, 100.0 * (1 + 1e-12)) for _ in range(fits)])
        scatter = found[:, 0].std()
        assert abs(found[:, 0].mean() - alpha) < 4 * scatter / math.sqrt(fits) and found[:, 1].mean() / scatter == pytest.approx(1, abs=0.2)


def test_agreement_finds_a_scatter_and_a_trend():
    dt = (0.015, 0.03, 0.06, 0.06)
    same, trend = statistics.agreement(dt, [Estimate(x, 0.1) for x in (1.0, 1.05, 0.95, 1.0)])
    assert same > 0.5 and trend > 0.3
    same, trend = statistics.agreement(dt, [Estimate(x, 0.1) for x in (1.0, 1.5, 1.0, 1.0)])
    assert same < 1e-3 and trend > 0.05
    # A slope that the test of the scatter alone does not detect.
    same, trend = statistics.agreement(dt, [Estimate(x, 0.1) for x in (1.0, 1.1, 1.3, 1.3)])
    assert trend < 0.02 and same > 0.05
    # For two estimates with equal errors, scatter and trend are the same two-sided normal test.
    assert statistics.agreement((0.03, 0.06), [Estimate(0.0, 1.0), Estimate(1.96 * math.sqrt(2), 1.0)]) == pytest.approx((0.05, 0.05), abs=1e-3)
    # Values that could not be estimated are ignored.
    assert statistics.agreement((0.03, 0.06), [Estimate(), Estimate(1.0, 0.1)]) == (1.0, 1.0)


def test_pairs_one_to_one():
    assert statistics.paired([1.0, 2.0, 2.1, 9.0], [1.05, 2.05, 5.0], 0.2) == (2, 2, 1), "the partner of 2.1 belongs to 2.0"
    assert statistics.paired([], [1.0], 1.0) == (0, 0, 1) and statistics.unpaired_p(2, 1) == 1.0
    # 1 against 16 events without a partner: (15 - 1)^2 / 17 = 11.53
    assert statistics.unpaired_p(1, 16) == statistics.unpaired_p(16, 1) == pytest.approx(6.85e-4, abs=1e-5)


def test_what_lmp_prints():
    said = ["Step Time c_a", "0 0 1.5", "100 3 2.5", "Loop time of 2.0 on 1 procs", "50.0% CPU use with 1 MPI tasks", "p_wave_speed = 2.12", "1 2 3"]
    ran = accuracy.Run(said, 7.0)
    assert (ran.seconds, ran.cpu, ran.last, ran.second, ran.printed) == (1.0, 7.0, {"Step": 100, "Time": 3, "c_a": 2.5}, [0,
                                                                                                                          3], {"p_wave_speed": 2.12})


def test_partners_are_near_and_of_like_size():
    kind = [("t_end", "<f8"), ("size", "<f8")]
    first = np.array([(10, 1), (20, 1), (30, 1), (40, 1)], kind)
    second = np.array([(11, 1.5), (21, 3), (33, 0.6), (60, 1)], kind)
    assert accuracy.partners(first, second) == [0, None, 2, None]
