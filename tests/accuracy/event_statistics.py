# SPDX-License-Identifier: GPL-2.0-or-later
"""Statistics of event sizes and times, and tests of whether samples agree, with standard errors."""
import math
from typing import NamedTuple

from scipy.special import polygamma
from scipy.stats import chi2, ks_2samp

NAN = math.nan


class Estimate(NamedTuple):
    value: float = NAN
    error: float = NAN


def bisected(low, high, is_low, middle=lambda a, b: 0.5 * (a + b), rounds=100):
    for _ in range(rounds):
        mid = middle(low, high)
        low, high = (mid, high) if is_low(mid) else (low, mid)
    return middle(low, high)


def exponent(sizes, lo, hi):
    """Exponent of a density x^-alpha on [lo, hi] by maximum likelihood; NaN with fewer than 10 values."""
    logs = [math.log(x / lo) for x in sizes if lo <= x <= hi]
    if len(logs) < 10:
        return Estimate()
    width, mean = math.log(hi / lo), math.fsum(logs) / len(logs)

    # y = log(x / lo) has density ~ exp(b y) on [0, width], b = 1 - alpha; its mean grows with b.
    def expected(b):
        return width * (0.5 + b * width / 12) if abs(b * width) < 1e-4 else width / (1 - math.exp(-b * width)) - 1 / b

    b, step = bisected(-50.0, 50.0, lambda b: expected(b) < mean), 1e-3
    return Estimate(1 - b, 1 / math.sqrt(len(logs) * (expected(b + step) - expected(b - step)) / (2 * step)))


def two_sample(a, b):
    """Probability of a larger Kolmogorov-Smirnov distance if both samples come from the same distribution."""
    return ks_2samp(a, b).pvalue if len(a) and len(b) else 1.0


def gamma_density(times):
    """gamma and b of a density ~ t^(gamma - 1) exp(-t / b) by maximum likelihood; NaN with fewer than 10 times."""
    n = len(times)
    if n < 10:
        return Estimate(), Estimate()
    if not min(times) > 0:
        raise ValueError("gamma_density: a time is not above 0")
    mean = math.fsum(times) / n
    spread = math.log(mean) - math.fsum(map(math.log, times)) / n
    # log(gamma) - digamma(gamma) = spread; the left side falls with gamma
    gamma = bisected(1e-6, 1e6, lambda g: math.log(g) - polygamma(0, g) > spread, lambda a, b: math.sqrt(a * b), 200)
    second, b = polygamma(1, gamma), mean / gamma
    return (Estimate(gamma, math.sqrt(gamma / (n * (gamma * second - 1)))), Estimate(b, b * math.sqrt(second / (n * (gamma * second - 1)))))


def agreement(dt, estimates):
    """Do estimates from several time steps agree? If all have the same true value, the probabilities of a larger scatter (chi-square) and
    of a larger slope against the time step. Both are 1 with fewer than two estimates or time steps."""
    known = [(x, y.value, 1 / y.error**2) for x, y in zip(dt, estimates) if math.isfinite(y.value) and y.error > 0]
    if len(known) < 2:
        return 1.0, 1.0
    weight = sum(w for _, _, w in known)
    x0, y0 = (sum(one[i] * one[2] for one in known) / weight for i in (0, 1))
    chi, xx, xy = (sum(w * f(x - x0, y - y0) for x, y, w in known) for f in (lambda x, y: y * y, lambda x, y: x * x, lambda x, y: x * y))
    return chi2.sf(chi, len(known) - 1), chi2.sf(xy * xy / xx, 1) if xx > 0 else 1.0


def paired(first, second, near):
    """Numbers of events of two runs that are paired one to one by their starts (both in order of time), and only in one of them."""
    both = i = j = 0
    while i < len(first) and j < len(second):
        if abs(first[i] - second[j]) <= near:
            both, i, j = both + 1, i + 1, j + 1
        elif first[i] < second[j]:
            i += 1
        else:
            j += 1
    return both, len(first) - both, len(second) - both


def unpaired_p(only_first, only_second):
    """Probability of a larger difference if an event is equally likely to be missing in either run (McNemar's test with correction for
    continuity)."""
    off = abs(only_first - only_second)
    return chi2.sf((off - 1)**2 / (only_first + only_second), 1) if off > 1 else 1.0
